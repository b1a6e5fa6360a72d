//! Surface data files.

use asperity::topography::RoughnessParameters;
use std::f64::consts::TAU;

use super::instrument::assert_heights;
use super::*;

pub struct Sdf {
    version: &'static str,
    size: [u32; 2],
    scales: [f64; 3],
    codes: [u8; 3],
}

impl Sdf {
    pub const fn of(version: &'static str, data_type: u8) -> Self {
        Self {
            version,
            size: [NX as u32, NY as u32],
            scales: [PIXEL[0], PIXEL[1], 1e-9],
            codes: [0, data_type, 0],
        }
    }

    pub fn text(&self, numbers: &str) -> String {
        let Self { version, size: [nx, ny], scales: [x, y, z], codes: [compression, data_type, check] } =
            self;
        format!(
            "a{version}\r\nManufacID = TEST\r\nCreateDate = 010120260000\r\nModDate = 010120260000\r\n\
             NumPoints = {nx}\r\nNumProfiles = {ny}\r\nXscale = {x:e}\r\nYscale = {y:e}\r\nZscale = {z:E}\r\n\
             Zresolution = -1\r\nCompression = {compression}\r\nDataType = {data_type}\r\nCheckType = {check}\r\n\
             *\r\n{numbers}\r\n*\r\n<Comment>none</Comment>\r\n*\r\n"
        )
    }

    pub fn binary(&self, numbers: &[u8]) -> Vec<u8> {
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
                let missing: Option<$kind> = ($missing)(version);
                let of = |z: f64| 4.0 * z + 54.0;
                let number = |z: f64| if z.is_nan() { missing.unwrap_or(0 as $kind) } else { of(z) as $kind };
                let numbers: Vec<u8> = in_lines().flat_map(|z| number(z).to_le_bytes()).collect();
                let mut sdf = Sdf::of(version, $code);
                sdf.scales[2] = 0.25e-9;
                let trailed = [sdf.binary(&numbers), b"<Comment>after the numbers</Comment>".to_vec()].concat();
                // Without a mark the missing point is the number 0.
                let wanted = |ix, iy| 0.25e-9 * if missing.is_none() && z(ix, iy).is_nan() { 0.0 } else { of(z(ix, iy)) };
                for bytes in [sdf.binary(&numbers), trailed] {
                    assert_eq!(assert_heights(bytes, None, PIXEL, wanted).pixel, Some(PIXEL));
                }
            }
        )*};
    }
    check! {
        u8, 0, |_| Some(u8::MAX); u16, 1, |_| Some(u16::MAX); u32, 2, |_| Some(u32::MAX);
        f32, 3, |_| Some(f32::NAN); f32, 3, |_| Some(f32::MIN); f32, 3, |_| Some(f32::MAX);
        i8, 4, |version| Some(if version == "BCR-1.0" { i8::MAX } else { i8::MIN });
        i16, 5, |version| Some(if version == "BCR-1.0" { i16::MAX } else { i16::MIN });
        i32, 6, |version| Some(if version == "BCR-1.0" { i32::MAX } else { i32::MIN });
        f64, 7, |_| Some(f64::NAN); f64, 7, |_| Some(f64::MIN); f64, 7, |_| Some(f64::MAX); f64, 7, |_| Some(1e30);
        i16, 5, |_| None;
    }
    // Eight bytes more before the numbers.
    let numbers: Vec<u8> = in_lines().flat_map(f64::to_le_bytes).collect();
    let olympus = [&[5, 0, 0, 0, 1, 0, 0, 0], &numbers[..]].concat();
    for (version, numbers) in [("ISO-1.0", &numbers), ("ISO-2.0", &numbers), ("ISO-1.0", &olympus)] {
        assert_map(Sdf::of(version, 7).binary(numbers), ReadOptions::default(), 1e-9, PIXEL);
    }
}

#[test]
fn sdf_text_and_what_is_given_beside_it() {
    for (version, missing) in [("ISO-1.0", "BAD"), ("ISO-2.0", "NaN"), ("BCR-1.0", "-1.79769313486232e+308")]
    {
        let head =
            assert_map(Sdf::of(version, 7).text(&lines(" ", missing)), ReadOptions::default(), 1e-9, PIXEL);
        assert!(head.has_unit);
    }
    let bare = Sdf::of("BCR-1.0", 7).text(&lines(" ", "NaN"));
    let commented = bare
        .replace("aBCR", "ABCR")
        .replace("\r\n", " ; a comment\n")
        .replace("DataType = 7", "DataType = DOUBLE");
    assert_map(commented.replace("Type = 0", "Type = NULL"), ReadOptions::default(), 1e-9, PIXEL);
    let ones = Sdf::of("ISO-1.0", 1).text(&"1 65535 ".repeat(NX * NY / 2));
    let (_folder, path) = file(ones);
    assert_eq!(RoughnessParameters::new(&height_map(&path, ReadOptions::default()).unwrap()).missing, 10);
    let given =
        height_map(&path, ReadOptions { pixel: Some([1e-6; 2]), unit: Some(LengthUnits::same(1e-3)) })
            .unwrap();
    assert_eq!((given.pixel(), given.heights()[0]), ([1e-6; 2], 1e-9 * 1e-3));
}

#[test]
fn sdf_samples_hold_the_heights_they_were_made_of() {
    let wave = |x: f64, y: f64| {
        1e-6 * ((TAU * x / 40e-6).cos() * (TAU * y / 36e-6).cos() + 0.3 * (TAU * x / 14e-6).sin())
    };
    let [nx, ny] = [48, 32];
    for (name, step) in [
        ("iso1_surface_ascii", 1e-10),
        ("iso1_surface_binary", 1e-10),
        ("iso1_surface_int32_ascii", 1e-13),
        ("iso1_surface_int32_binary", 1e-13),
        ("iso1_surface_binary64_binary", 1e-21),
        ("iso2_surface_binary32_ascii", 2e-12),
        ("iso2_surface_binary32_binary", 2e-13),
        ("iso2_surface_int8_ascii", 2e-8),
        ("iso2_surface_int8_binary", 2e-8),
        ("bcr1_surface_ascii", 1e-10),
        ("bcr1_surface_binary", 1e-10),
        ("bcr1_surface_int32_binary", 1e-13),
        ("bcr1_surface_uint16_ascii", 1e-10),
        ("bcr1_surface_uint16_binary", 1e-10),
    ] {
        let path = super::sample(&format!("{name}.sdf"));
        assert_eq!(metadata(&path).unwrap().pixel, Some([2e-6, 3e-6]));
        let map = height_map(&path, ReadOptions::default()).unwrap();
        assert_eq!((map.points(), RoughnessParameters::new(&map).missing), ([nx, ny], 40), "{name}");
        // The first profile of the BCR files is that of the greatest y.
        let row = |iy: usize| if name.starts_with("bcr1") { ny - 1 - iy } else { iy };
        let exact: Vec<f64> =
            (0..nx * ny).map(|k| wave((k / ny) as f64 * 2e-6, row(k % ny) as f64 * 3e-6)).collect();
        // The unsigned surface lies above zero.
        let raised = if name.contains("uint16") { -exact.iter().copied().fold(0.0, f64::min) } else { 0.0 };
        for (k, (found, exact)) in map.heights().iter().zip(exact).enumerate() {
            let (ix, iy) = (k / ny, row(k % ny));
            let missing = (20..30).contains(&ix) && (10..14).contains(&iy);
            assert_eq!(found.is_nan(), missing, "{name} {ix} {iy}");
            assert!(
                missing || (found - exact - raised).abs() <= 0.51 * step,
                "{name} {ix} {iy}: {found} {exact}"
            );
        }
    }
    let error = metadata(&super::sample("iso1_profile_binary.sdf")).unwrap_err();
    assert!(matches!(error, ReadError::Unsupported(_)), "{error}");
}

#[test]
fn bad_sdf_is_refused() {
    let text = lines(" ", "BAD");
    let with = |change: fn(&mut Sdf)| {
        let mut sdf = Sdf::of("ISO-1.0", 7);
        change(&mut sdf);
        sdf
    };
    assert_refused!(Mismatch, "ISO-1.0 without its letter");
    assert_refused!(Unsupported, Sdf::of("ISO-9.0", 7).text(&text));
    assert_refused!(Unsupported, with(|sdf| sdf.codes[1] = 8).text(&text));
    assert_refused!(Unsupported, with(|sdf| sdf.codes[0] = 1).binary(&[0; 160]));
    assert_refused!(Unsupported, with(|sdf| sdf.codes[2] = 2).text(&text));
    assert_refused!(Corrupt, with(|sdf| sdf.size[1] = 0).binary(&[0; 160]));
    assert_refused!(Unsupported, with(|sdf| sdf.size[1] = 1).text(&text));
    assert_refused!(TooTall, with(|sdf| sdf.scales[2] = 4.0).text(&text));
    assert_refused!(Corrupt, with(|sdf| sdf.scales[1] = 0.0).text(&text));
    assert_refused!(Corrupt, with(|sdf| sdf.scales[2] = f64::NAN).binary(&[0; 160]));
    assert_refused!(Corrupt, with(|_| ()).text(&text).replace("DataType", "Type"));
    assert_refused!(Corrupt, with(|_| ()).text(&text).replace("= 5", "= five"));
    assert_refused!(Corrupt, with(|_| ()).text(&text.replacen("1.25", "x", 1)));
    assert_refused!(Corrupt, with(|_| ()).text(text.trim_end_matches("5\n")));
    assert_refused!(Corrupt, with(|_| ()).text(&(text.clone() + "1")));
    // Counts that no file can hold.
    let huge = with(|_| ()).text(&text).replace("= 5", "= 1000000000").replace("= 4", "= 1000000000");
    assert_refused!(Corrupt, huge);
    let huge = Sdf { size: [u32::MAX; 2], ..Sdf::of("ISO-2.0", 7) };
    assert_refused!(Corrupt, huge.binary(&[0; 160]));
    let whole = with(|_| ()).binary(&[0; 160]);
    assert_truncated(&whole, 8..whole.len());
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
        ReadOptions::default(),
        1e-15,
    );
    let words: String =
        numbers().map(|z| if z.is_nan() { "BAD\n".to_owned() } else { format!("{z}\n") }).collect();
    assert_opd(sdf.text(&words), ReadOptions::default(), 1e-15);
    // 32 bits over the range of the heights.
    let step = 1e-15;
    sdf.scales[2] = step;
    sdf.codes[1] = 6;
    let integer = |z: f64| if z.is_nan() { i32::MIN } else { (z * 1e-6 / step).round() as i32 };
    let largest = opd.heights().iter().fold(0.0f64, |largest, z| largest.max(z.abs()));
    assert!(largest / step < 2e9, "{largest}");
    assert_opd(
        sdf.binary(&numbers().flat_map(|z| integer(z).to_le_bytes()).collect::<Vec<_>>()),
        ReadOptions::default(),
        1e-6,
    );
}

/// Only the two counts written by Olympus precede the numbers; other extra bytes follow them.
#[test]
fn eight_bytes_after_the_numbers_move_nothing() {
    let numbers: Vec<u8> = in_lines().flat_map(f64::to_le_bytes).chain(*b"the end.").collect();
    assert_map(Sdf::of("ISO-1.0", 7).binary(&numbers), ReadOptions::default(), 1e-9, PIXEL);
}

#[test]
fn numbers_of_four_bytes_have_their_precision() {
    let four: Vec<u8> = in_lines().flat_map(|z| (z as f32).to_le_bytes()).collect();
    let eight: Vec<u8> = in_lines().flat_map(f64::to_le_bytes).collect();
    for (data_type, numbers, precision) in [(3, four, f64::from(f32::EPSILON)), (7, eight, f64::EPSILON)] {
        let (_folder, path) = file(Sdf::of("ISO-1.0", data_type).binary(&numbers));
        assert_eq!(height_map(&path, ReadOptions::default()).unwrap().precision(), precision);
    }
}
