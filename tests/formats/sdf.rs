//! Surface data files.

use super::*;

struct Sdf {
    version: &'static str,
    size: [u32; 2],
    scales: [f64; 3],
    codes: [u8; 3],
}

impl Sdf {
    const fn of(version: &'static str, data_type: u8) -> Self {
        Self {
            version,
            size: [NX as u32, NY as u32],
            scales: [PIXEL[0], PIXEL[1], 1e-9],
            codes: [0, data_type, 0],
        }
    }

    fn text(&self, numbers: &str) -> String {
        let Self { version, size: [nx, ny], scales: [x, y, z], codes: [compression, data_type, check] } =
            self;
        format!(
            "a{version}\r\nManufacID = TEST\r\nCreateDate = 010120260000\r\nModDate = 010120260000\r\n\
             NumPoints = {nx}\r\nNumProfiles = {ny}\r\nXscale = {x:e}\r\nYscale = {y:e}\r\nZscale = {z:E}\r\n\
             Zresolution = -1\r\nCompression = {compression}\r\nDataType = {data_type}\r\nCheckType = {check}\r\n\
             *\r\n{numbers}\r\n*\r\n<Comment>none</Comment>\r\n*\r\n"
        )
    }

    fn binary(&self, numbers: &[u8]) -> Vec<u8> {
        let mut bytes = format!("b{}TEST      010120260000010120260000", self.version).into_bytes();
        for count in self.size {
            bytes.extend(&count.to_le_bytes()[..if self.version == "ISO-2.0" { 4 } else { 2 }]);
        }
        bytes.extend(self.scales.iter().chain(&[-1.0]).flat_map(|scale| scale.to_le_bytes()));
        bytes.extend(self.codes);
        bytes.extend(numbers);
        bytes
    }
}

#[test]
fn sdf_binary_of_every_data_type() {
    // In units of a quarter nanometre, and 18 of them higher, so that unsigned integers hold it.
    macro_rules! check {
        ($($kind:ty, $code:literal, $missing:expr;)*) => {$(
            for version in ["ISO-1.0", "ISO-2.0", "BCR-1.0"] {
                let missing: Option<$kind> = $missing;
                let stored = |z: f64| if z.is_nan() { missing.unwrap_or(0 as $kind) } else { (4.0 * z + 54.0) as $kind };
                let numbers: Vec<u8> = in_lines().flat_map(|z| stored(z).to_le_bytes()).collect();
                let mut sdf = Sdf::of(version, $code);
                sdf.scales[2] = 0.25e-9;
                let mut trailed = sdf.binary(&numbers);
                trailed.extend(b"<Comment>after the numbers</Comment>");
                for bytes in [sdf.binary(&numbers), trailed] {
                    let (_folder, path) = file(bytes);
                    assert_eq!(head(&path).unwrap().pixel, Some(PIXEL));
                    let map = height_map(&path, Given::default()).unwrap();
                    assert_eq!((map.points(), map.pixel()), ([NX, NY], PIXEL));
                    for (k, found) in map.heights().iter().enumerate() {
                        let wanted = z(k / NY, k % NY);
                        let wanted = if missing.is_none() && wanted.is_nan() { -13.5 } else { wanted };
                        let far = (found - (wanted + 13.5) * 1e-9).abs() > 1e-22;
                        assert!(!far && found.is_nan() == wanted.is_nan(), "{version} {k}: {found} {wanted}");
                    }
                }
            }
        )*};
    }
    check! {
        u8, 0, None; u16, 1, Some(u16::MAX); u32, 2, Some(u32::MAX); f32, 3, Some(f32::NAN); f32, 3, Some(f32::MIN);
        i8, 4, Some(i8::MIN); i16, 5, Some(i16::MIN); i32, 6, Some(i32::MIN); f64, 7, Some(f64::NAN);
        f64, 7, Some(f64::MIN); f64, 7, Some(1e30);
    }
    // Eight bytes more before the numbers.
    let numbers: Vec<u8> = in_lines().flat_map(f64::to_le_bytes).collect();
    let olympus = [&[5, 0, 0, 0, 1, 0, 0, 0], &numbers[..]].concat();
    for (version, numbers) in [("ISO-1.0", &numbers), ("ISO-2.0", &numbers), ("ISO-1.0", &olympus)] {
        assert_map(Sdf::of(version, 7).binary(numbers), Given::default(), 1e-9, PIXEL);
    }
}

#[test]
fn sdf_text_and_what_is_given_beside_it() {
    for (version, missing) in [("ISO-1.0", "BAD"), ("ISO-2.0", "NaN"), ("BCR-1.0", "-1.79769313486232e+308")]
    {
        let head = assert_map(Sdf::of(version, 7).text(&lines(" ", missing)), Given::default(), 1e-9, PIXEL);
        assert!(head.has_unit);
    }
    let ones = Sdf::of("ISO-1.0", 1).text(&"1 65535 ".repeat(NX * NY / 2));
    let (_folder, path) = file(ones);
    assert_eq!(height_map(&path, Given::default()).unwrap().missing(), 10);
    let given = height_map(&path, Given { pixel: Some(PIXEL), unit: None }).unwrap_err();
    assert!(given.to_string().contains("holds its own pixel of 2e-6 x 3e-6 m; allowed: leave pixel out"));
    let given = height_map(&path, Given { pixel: None, unit: Some(1e-6) }).unwrap_err();
    assert!(given.to_string().contains("holds its own unit of length; allowed: leave unit out"));
}

#[test]
fn bad_sdf_is_refused() {
    let text = lines(" ", "BAD");
    let with = |change: fn(&mut Sdf)| {
        let mut sdf = Sdf::of("ISO-1.0", 7);
        change(&mut sdf);
        sdf
    };
    assert_refused!(Mismatch, "is no height map", "ISO-1.0 without its letter");
    assert_refused!(Unsupported, "version ISO-9.0; allowed: ISO-1.0", Sdf::of("ISO-9.0", 7).text(&text));
    assert_refused!(Unsupported, "DataType 8; allowed: 0 to 7", with(|sdf| sdf.codes[1] = 8).text(&text));
    assert_refused!(Unsupported, "Compression 1", with(|sdf| sdf.codes[0] = 1).binary(&[0; 160]));
    assert_refused!(Unsupported, "CheckType 2", with(|sdf| sdf.codes[2] = 2).text(&text));
    assert_refused!(Unsupported, "single profile", with(|sdf| sdf.size[1] = 1).text(&text));
    assert_refused!(Unsupported, "holds a height of 5.4e1 m", with(|sdf| sdf.scales[2] = 4.0).text(&text));
    assert_refused!(Corrupt, "has Yscale = 0e0", with(|sdf| sdf.scales[1] = 0.0).text(&text));
    assert_refused!(Corrupt, "has Zscale = NaN", with(|sdf| sdf.scales[2] = f64::NAN).binary(&[0; 160]));
    assert_refused!(Corrupt, "has no DataType", with(|_| ()).text(&text).replace("DataType", "Type"));
    assert_refused!(Corrupt, "NumPoints = \"five\"", with(|_| ()).text(&text).replace("= 5", "= five"));
    assert_refused!(Corrupt, "number 2: found \"x\"", with(|_| ()).text(&text.replacen("1.25", "x", 1)));
    assert_refused!(Corrupt, "says 20 points, 19 numbers", with(|_| ()).text(text.trim_end_matches("5\n")));
    assert_refused!(Corrupt, "holds 21 numbers; allowed: 20", with(|_| ()).text(&(text.clone() + "1")));
    // Counts that no file can hold.
    let huge = with(|_| ()).text(&text).replace("= 5", "= 1000000000").replace("= 4", "= 1000000000");
    assert_refused!(Corrupt, "is truncated: its header says 1000000000000000000 points", huge);
    let huge = Sdf { size: [u32::MAX; 2], ..Sdf::of("ISO-2.0", 7) };
    assert_refused!(Corrupt, "is truncated", huge.binary(&[0; 160]));
    let whole = with(|_| ()).binary(&[0; 160]);
    for length in 8..whole.len() {
        assert_refused!(Corrupt, "is truncated", &whole[..length]);
    }
}

#[test]
fn opd_1_as_sdf_is_the_same_surface() {
    let opd = opd();
    let [nx, ny] = opd.points();
    let mut sdf = Sdf::of("ISO-1.0", 7);
    (sdf.size, sdf.scales) = ([nx as u32, ny as u32], [opd.pixel()[0], opd.pixel()[1], 1e-6]);
    let numbers = || (0..nx * ny).map(|k| opd.heights()[k % nx * ny + k / nx] * 1e6);
    assert_opd(
        sdf.binary(&numbers().flat_map(f64::to_le_bytes).collect::<Vec<_>>()),
        Given::default(),
        1e-15,
    );
    let words: String =
        numbers().map(|z| if z.is_nan() { "BAD\n".to_owned() } else { format!("{z}\n") }).collect();
    assert_opd(sdf.text(&words), Given::default(), 1e-15);
    // 32 bits over the range of the heights.
    let step = 1e-15;
    sdf.scales[2] = step;
    sdf.codes[1] = 6;
    let integer = |z: f64| if z.is_nan() { i32::MIN } else { (z * 1e-6 / step).round() as i32 };
    let largest = opd.heights().iter().fold(0.0f64, |largest, z| largest.max(z.abs()));
    assert!(largest / step < 2e9, "{largest}");
    assert_opd(
        sdf.binary(&numbers().flat_map(|z| integer(z).to_le_bytes()).collect::<Vec<_>>()),
        Given::default(),
        1e-6,
    );
}
