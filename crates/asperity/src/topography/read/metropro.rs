//! Zygo MetroPro `.dat`: a long header, intensities, then phases as integers of four bytes, the most significant first.

use super::channel::{Channel, Numbers, Stored};
use super::error::ReadError;
use super::source::Source;
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{F32, I16, I32, U16, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Zygo MetroPro file",
    endings: &["dat"],
    is: |source| matches!(source.begin(), [0x88, 0x1b, 0x03, 0x6f..=0x71, ..]),
    read: Reader::Channels(channels),
};

/// Bytes of the shortest header.
const HEADER: u64 = 834;
/// A phase from here on marks a missing point.
const MISSING: f64 = 2_147_483_640.0;

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let mut header = source.fields(0, HEADER)?;
    header.big_endian = true;
    let intensities = (52..58).step_by(2).map(|at| header.count(at, U16)).product::<Result<u64, _>>()?;
    let points = [header.count(68, U16)?, header.count(70, U16)?];
    let start = header.count(6, U32)?.saturating_add(2 * intensities);
    let steps = match header.count(218, U16)? {
        0 => 4096.0,
        1 => 32_768.0,
        2 => 131_072.0,
        found => {
            return Err(unsupported!("has the phase resolution {found}; allowed: 0, 1, 2"));
        }
    };
    if points.contains(&0) {
        return Err(unsupported!("holds intensities only; allowed: a file with phases"));
    }
    let float = |at: usize| header.number(at, F32);
    let (scale, wavelength, obliquity) = (float(164)?, float(168)?, float(176)?);
    let sign = if header.number(232, I16)? == 0.0 { 1.0 } else { -1.0 };
    // A lateral resolution of zero is none.
    let pixel = Some(float(184)?).filter(|&size| size > 0.0).map(|size| [size; 2]);
    Ok(vec![Channel {
        pixel,
        factor: sign * scale * obliquity * wavelength / steps,
        missing: Box::new(|value| value >= MISSING),
        ..Channel::new(
            "Phase",
            points,
            Numbers::Stored(Stored { big_endian: true, ..Stored::new(start, I32) }),
        )
    }])
}
