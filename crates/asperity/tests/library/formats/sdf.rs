//! Surface data files.

use asperity::topography::RoughnessParameters;

use super::instrument::{assert_heights, stored};
use super::refused::Good;
use super::*;

pub struct Sdf {
    pub version: &'static str,
    pub size: [u32; 2],
    pub scales: [f64; 3],
    pub data_type: u8,
}

impl Sdf {
    pub const fn of(version: &'static str, data_type: u8) -> Self {
        Self { version, size: [NX as u32, NY as u32], scales: [PIXEL[0], PIXEL[1], 1e-9], data_type }
    }

    pub fn text(&self, numbers: &str) -> String {
        let Self { version, size: [nx, ny], scales: [x, y, z], data_type } = self;
        format!(
            "a{version}\r\nManufacID = TEST\r\nCreateDate = 010120260000\r\nModDate = 010120260000\r\n\
             NumPoints = {nx}\r\nNumProfiles = {ny}\r\nXscale = {x:e}\r\nYscale = {y:e}\r\nZscale = {z:E}\r\n\
             Zresolution = -1\r\nCompression = 0\r\nDataType = {data_type}\r\nCheckType = 0\r\n\
             *\r\n{numbers}\r\n*\r\n<Comment>none</Comment>\r\n*\r\n"
        )
    }

    pub fn binary(&self, numbers: &[u8]) -> Vec<u8> {
        let mut bytes = format!("b{}TEST      010120260000010120260000", self.version).into_bytes();
        for count in self.size {
            bytes.extend(&count.to_le_bytes()[..if self.version == "ISO-2.0" { 4 } else { 2 }]);
        }
        bytes.extend(self.scales.iter().chain(&[-1.0]).flat_map(|scale| scale.to_le_bytes()));
        bytes.extend([0, self.data_type, 0]);
        bytes.extend(numbers);
        bytes
    }
}

pub fn good() -> Vec<Good> {
    let numbers = stored::<f64>(in_lines(), false);
    let whole = Sdf::of("ISO-1.0", 7).binary(&numbers);
    vec![
        Good::whole("sdf as text", Sdf::of("ISO-1.0", 7).text(&lines(" ", "BAD"))),
        Good::whole("sdf of ISO 2", Sdf::of("ISO-2.0", 7).binary(&numbers)),
        Good { truncated: 8..whole.len(), ..Good::whole("sdf", whole) },
    ]
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
}

#[test]
fn sdf_text_and_what_is_given_beside_it() {
    for (version, missing) in [("ISO-1.0", "BAD"), ("ISO-2.0", "NaN"), ("BCR-1.0", "-1.79769313486232e+308")]
    {
        let head = assert_map(Sdf::of(version, 7).text(&lines(" ", missing)), AS_IT_IS, 1e-9, PIXEL);
        assert!(head.has_unit);
    }
    let bare = Sdf::of("BCR-1.0", 7).text(&lines(" ", "NaN"));
    let commented = bare
        .replace("aBCR", "ABCR")
        .replace("\r\n", " ; a comment\n")
        .replace("DataType = 7", "DataType = DOUBLE");
    assert_map(commented.replace("Type = 0", "Type = NULL"), AS_IT_IS, 1e-9, PIXEL);
    let ones = Sdf::of("ISO-1.0", 1).text(&"1 65535 ".repeat(NX * NY / 2));
    let (_folder, path) = file(ones);
    assert_eq!(RoughnessParameters::new(&height_map(&path, AS_IT_IS).unwrap()).missing, 10);
    let given =
        height_map(&path, ReadOptions { pixel: Some([1e-6; 2]), unit: Some(LengthUnits::same(1e-3)) })
            .unwrap();
    assert_eq!((given.pixel(), given.heights()[0]), ([1e-6; 2], 1e-9 * 1e-3));
}

/// Only the two counts written by Olympus precede the numbers; other extra bytes follow them.
#[test]
fn eight_bytes_more_are_no_numbers() {
    let numbers = stored::<f64>(in_lines(), false);
    for more in [[&[5, 0, 0, 0, 1, 0, 0, 0], &numbers[..]].concat(), [&numbers[..], b"the end."].concat()] {
        assert_map(Sdf::of("ISO-1.0", 7).binary(&more), AS_IT_IS, 1e-9, PIXEL);
    }
}

#[test]
fn numbers_of_four_bytes_have_their_precision() {
    let (four, eight) = (stored::<f32>(in_lines(), false), stored::<f64>(in_lines(), false));
    for (data_type, numbers, precision) in [(3, four, f64::from(f32::EPSILON)), (7, eight, f64::EPSILON)] {
        assert_eq!(read_map(Sdf::of("ISO-1.0", data_type).binary(&numbers), AS_IT_IS).precision(), precision);
    }
}
