//! Measured height maps in every format: known values, round trips, bad input of each kind.

use std::path::{Path, PathBuf};

use asperity::surface::level::Level;
use asperity::surface::read::{Given, GivenError, Head, ReadError, head, height_map};
use asperity::surface::summits::five_point;
use asperity::surface::{HeightMap, Moments};

const NX: usize = 5;
const NY: usize = 4;

/// Heights of the map that is written in every format, by its indices; one point is missing.
fn z(ix: usize, iy: usize) -> f64 {
    if (ix, iy) == (3, 1) { f64::NAN } else { [0.0, 1.25, -7.5, 3.0, 11.0][ix] - 2.0 * iy as f64 }
}

fn file(bytes: impl AsRef<[u8]>) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    // The name says nothing: formats are told apart by what is in them.
    let path = folder.path().join("map.dat");
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn refused(bytes: impl AsRef<[u8]>) -> ReadError {
    let (_folder, path) = file(bytes);
    let given = Given { pixel: Some([1e-6; 2]), unit: None };
    let from_head = head(&path).and_then(|head| Ok(head.pixel(&Given::default()).or(head.pixel(&given))?));
    from_head.and_then(|_| height_map(&path, Given::default())).unwrap_err()
}

macro_rules! assert_refused {
    ($kind:ident, $words:expr, $bytes:expr) => {
        let error = refused($bytes);
        assert!(matches!(error, ReadError::$kind(_)), "{error:?}");
        let text = error.to_string();
        assert!(text.contains($words), "{text}");
    };
}

/// Asserts that `bytes` hold the map above, its heights in units of `unit` and its pixel as given.
fn assert_map(bytes: impl AsRef<[u8]>, given: Given, unit: f64, pixel: [f64; 2]) -> Head {
    let (_folder, path) = file(&bytes);
    let head = head(&path).unwrap();
    let map = height_map(&path, given).unwrap();
    assert_eq!((head.points, map.points()), ([NX, NY], [NX, NY]));
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
    let [x, y] = map.pixel();
    assert!(close(x, pixel[0]) && close(y, pixel[1]), "{x} {y}");
    for (k, &found) in map.heights().iter().enumerate() {
        let wanted = z(k / NY, k % NY) * unit;
        assert!(close(found, wanted) || found.is_nan() && wanted.is_nan(), "{k}: {found} {wanted}");
    }
    head
}

/// The map as lines of text, x running along a line.
fn lines(separator: &str, missing: &str) -> String {
    let word = |ix, iy| if z(ix, iy).is_nan() { missing.to_owned() } else { z(ix, iy).to_string() };
    let line = |iy| (0..NX).map(|ix| word(ix, iy)).collect::<Vec<_>>().join(separator) + "\n";
    (0..NY).map(line).collect()
}

const PIXEL: [f64; 2] = [2e-6, 3e-6];
const IN_NM: Given = Given { pixel: Some(PIXEL), unit: Some(1e-9) };

#[test]
fn a_matrix_of_numbers_with_every_separator() {
    for (separator, missing) in [
        (" ", "NaN"),
        ("\t", "BAD"),
        ("\t", ""),
        (";", ""),
        ("; ", "nan"),
        (",", ""),
        (", ", "--"),
        ("  ", "n/a"),
    ] {
        let text = lines(separator, missing);
        let head = assert_map(&text, IN_NM, 1e-9, PIXEL);
        assert_eq!((head.pixel, head.has_unit), (None, false));
        assert_map(format!("\u{feff}# a comment\r\n\r\n{}", text.replace('\n', "\r\n")), IN_NM, 1e-9, PIXEL);
        if separator.trim() != "," {
            assert_map(text.replace('.', ","), IN_NM, 1e-9, PIXEL);
        }
        if ![" ", "  "].contains(&separator) {
            assert_map(
                text.replace('\n', &format!("{}\n", separator.trim_end_matches(' '))),
                IN_NM,
                1e-9,
                PIXEL,
            );
        }
    }
}

#[test]
fn a_header_gives_the_size_and_the_unit() {
    for (micro, unit, factor) in
        [("µm", "nm", 1e-9), ("μm", "µm", 1e-6), ("um", "m", 1.0), ("µm", "Å", 1e-10)]
    {
        let text = format!(
            "# Channel: Topography\n# Width: 10 {micro}\n# Height: 12 {micro}\n# Value units: {unit}\n{}",
            lines("\t", "NaN")
        );
        if factor < 1.0 {
            let head = assert_map(&text, Given::default(), factor, PIXEL);
            assert!(head.has_unit && head.pixel.is_some());
        } else {
            assert_refused!(Unsupported, "holds a height of 1.35e1 m", &text);
        }
        // The same in Latin-1.
        let latin: Vec<u8> =
            text.chars().filter_map(|character| u8::try_from(u32::from(character)).ok()).collect();
        if factor == 1e-9 {
            assert_map(latin, Given::default(), factor, PIXEL);
        }
    }
    let text = format!("# Width: 1,5 mm\n# Height: 0.012 mm\n# Value units: um\n{}", lines(" ", "NaN"));
    let (_folder, path) = file(&text);
    assert!((head(&path).unwrap().pixel.unwrap()[0] / 3e-4 - 1.0).abs() < 1e-15);
    let given = |pixel, unit| height_map(&path, Given { pixel, unit }).unwrap_err();
    assert!(matches!(given(Some(PIXEL), None), ReadError::Given(GivenError::PixelHeld { .. })));
    assert!(matches!(given(None, Some(1e-6)), ReadError::Given(GivenError::UnitHeld { .. })));
    // A mark of a missing point, where the unit is held.
    let marked = "# Width: 3 um\n# Height: 3 um\n# Value units: m\n1e-9 2e-9 1e10\n0 0 0\n0 0 3.4e38\n";
    let (_folder, path) = file(marked);
    assert_eq!(height_map(&path, Given::default()).unwrap().missing(), 2);
}

#[test]
fn bad_text_is_refused_with_its_place() {
    assert_refused!(Mismatch, "line 1 has \"this\" for a number", "this is no array\n");
    assert_refused!(Mismatch, "begins with \"\\x00\\x01", b"\0\x01\x02\x03 binary");
    assert_refused!(Corrupt, "is empty", "");
    assert_refused!(Corrupt, "holds no number", "# only a comment\n");
    assert_refused!(Corrupt, "line 3, column 2: found \"oops\"", "1 2 3 4\n1 2 3 4\n1 oops 3 4\n");
    assert_refused!(Corrupt, "is ragged: line 3 holds 3 numbers; allowed: 4", "1 2 3 4\n1 2 3 4\n1 2 3\n");
    assert_refused!(Unsupported, "UTF-16", b"\xff\xfe1\0 \x002\0");
    assert_refused!(Unsupported, "commas beside", "1,234.5;2,0;3,0\n");
    assert_refused!(Unsupported, "commas beside", "1, 2 3 4\n1 2 3 4\n1 2 3 4\n");
    assert_refused!(Unsupported, "commas that may", "0,05,1,10,2,15\n0,05,1,10,2,15\n0,05,1,10,2,15\n");
    let header = |lines: &str| format!("{lines}\n0 1 2\n3 4 5\n0 1 2\n");
    assert_refused!(Unsupported, "Value units missing", header("# Width: 3 um\n# Height: 3 um"));
    assert_refused!(
        Unsupported,
        "values in \"V\"",
        header("# Width: 3 um\n# Height: 3 um\n# Value units: V")
    );
    assert_refused!(
        Unsupported,
        "the Width \"3 ft\"",
        header("# Width: 3 ft\n# Height: 3 um\n# Value units: m")
    );
}

/// The map as points x y z, the missing one left out, in a mixed order.
fn points(step: [f64; 2], round: impl Fn(f64) -> f64) -> String {
    let place = |k: usize| ((k * 7 % (NX * NY)) / NY, (k * 7) % NY);
    (0..NX * NY)
        .map(place)
        .filter(|&(ix, iy)| !z(ix, iy).is_nan())
        .map(|(ix, iy)| {
            let [x, y] = [10.0 + step[0] * ix as f64, -3.0 + step[1] * iy as f64].map(&round);
            format!("{x} {y} {}\n", z(ix, iy))
        })
        .collect()
}

#[test]
fn points_of_a_grid_in_any_order() {
    let in_um = Given { pixel: None, unit: Some(1e-6) };
    let text = points([0.5, 0.25], |x| x);
    let head = assert_map(&text, in_um, 1e-6, [0.5e-6, 0.25e-6]);
    assert_eq!((head.pixel, head.has_unit), (Some([0.5, 0.25]), false));
    assert_map(format!("X;Y;Z\n{}", text.replace(' ', ";")), in_um, 1e-6, [0.5e-6, 0.25e-6]);
    assert_map(text.replace(' ', ","), in_um, 1e-6, [0.5e-6, 0.25e-6]);
    // Rounded to a tenth of a pixel, the steps are of different lengths.
    let rounded = points([0.337, 0.25], |x| (x * 30.0).round() / 30.0);
    let (_folder, path) = file(&rounded);
    let map = height_map(&path, in_um).unwrap();
    assert_eq!((map.points(), map.missing()), ([NX, NY], 1));
    assert!((map.pixel()[0] / 0.337e-6 - 1.0).abs() < 0.02);
    // Noise far below a pixel does not make lines of its own.
    let mut noise = 0.0;
    let noisy: String = points([0.5, 0.25], |x| x)
        .lines()
        .map(|line| {
            noise = (noise + 0.618) % 1.0;
            let (x, rest) = line.split_once(' ').unwrap();
            format!("{} {rest}\n", x.parse::<f64>().unwrap() + 1e-5 * noise)
        })
        .collect();
    let (_folder, path) = file(&noisy);
    assert_eq!(height_map(&path, in_um).unwrap().points(), [NX, NY]);
}

#[test]
fn points_of_no_grid_are_refused() {
    let grid = points([0.5, 0.25], |x| x);
    assert_refused!(Unsupported, "two points at 10 -3", format!("{grid}10 -3 1\n"));
    assert_refused!(Unsupported, "no equidistant lines along x", format!("{grid}10.17 -3 1\n"));
    assert_refused!(Unsupported, "all at y = 1", "1 1 0\n2 1 0\n3 1 0\n4 1 0\n");
    assert_refused!(Unsupported, "more than three in four missing", {
        (0..100).map(|k| format!("{k} {k} 0\n")).collect::<String>()
    });
    assert_refused!(Unsupported, "two points", "0 0 0\n1 1 0\n1e9 1e9 0\n3 3 0\n");
    assert_refused!(Unsupported, "names columns with units", format!("x [um] y [um] z [um]\n{grid}"));
    assert_refused!(Corrupt, "point 5 of", "0 0 0\n1 0 0\n0 1 0\n1 1 0\nnan 2 0\n");
}

fn opd() -> HeightMap {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("experiments/surfaces/opd-1.npy");
    height_map(&path, Given { pixel: Some([1.9673303177114576e-7; 2]), unit: None }).unwrap()
}

/// Asserts that a file gives the heights of opd-1 to the relative precision of its largest height.
fn assert_opd(bytes: impl AsRef<[u8]>, given: Given, precision: f64) {
    let (_folder, path) = file(bytes);
    let (opd, map) = (opd(), height_map(&path, given).unwrap());
    assert_eq!((opd.points(), opd.missing()), (map.points(), map.missing()));
    assert!(map.pixel().iter().all(|size| (size / opd.pixel()[0] - 1.0).abs() < 1e-9), "{:?}", map.pixel());
    let largest = opd.heights().iter().fold(0.0f64, |largest, z| largest.max(z.abs()));
    let far = |(a, b): (&f64, &f64)| (a - b).abs() > precision * largest;
    assert_eq!(opd.heights().iter().zip(map.heights()).filter(|&pair| far(pair)).count(), 0);
    let levelled = Level::Plane.apply(&map).unwrap();
    let moments = Moments::of(&levelled);
    let found = [moments.sq * 1e9, moments.ssk.unwrap(), moments.sku.unwrap()];
    for (found, exact) in found.into_iter().zip([6.711, -0.367, 4.538]) {
        assert!((found - exact).abs() <= 5e-4, "{found} for {exact}");
    }
    assert_eq!(five_point(&levelled).heights.len(), 24714);
}

#[test]
fn opd_1_as_text_and_as_points_is_the_same_surface() {
    let opd = opd();
    let [nx, ny] = opd.points();
    let (mut matrix, mut points) = (String::new(), String::new());
    let size = |count: usize| count as f64 * opd.pixel()[0] * 1e6;
    matrix += &format!("# Width: {} µm\n# Height: {} µm\n# Value units: nm\n", size(nx), size(ny));
    for iy in 0..ny {
        for ix in 0..nx {
            let z = opd.heights()[ix * ny + iy];
            matrix += &format!("{}\t", z * 1e9);
            if !z.is_nan() {
                points += &format!("{:.4}\t{:.4}\t{}\n", size(ix), size(iy), z * 1e6);
            }
        }
        matrix += "\n";
    }
    assert_opd(matrix, Given::default(), 1e-15);
    // Coordinates with four decimals of a micrometre; the unit goes for all three columns.
    let in_um = Given { pixel: None, unit: Some(1e-6) };
    let (_folder, path) = file(&points);
    let pixel = height_map(&path, in_um).unwrap().pixel();
    assert!(pixel.iter().all(|size| (size / opd.pixel()[0] - 1.0).abs() < 1e-5), "{pixel:?}");
    let exact: String = (0..nx * ny)
        .filter(|&k| !opd.heights()[k].is_nan())
        .map(|k| format!("{} {} {}\n", size(k / ny), size(k % ny), opd.heights()[k] * 1e6))
        .collect();
    assert_opd(exact, in_um, 1e-15);
}

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

/// Heights in lines along x, as SDF and X3P store them.
fn in_lines() -> impl Iterator<Item = f64> {
    (0..NX * NY).map(|k| z(k % NX, k / NX))
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
