//! Park Systems `.tiff`: a picture in colours, and in tags of its own a header and the measured numbers, lines from the bottom.

use super::channel::{Channel, Numbers, Order, UNPACKED};
use super::error::ReadError;
use super::source::{Fields, OF_BYTES, Source};
use super::tags::{Tags, has};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{F32, F64, I16, I32, U16, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Park TIFF file",
    endings: &["tiff"],
    is: |source| has(source, &[MAGIC, DATA, HEADER]),
    read: Reader::Channels(channels),
};

const MAGIC: u16 = 50432;
const VERSION: u16 = 50433;
const DATA: u16 = 50434;
const HEADER: u16 = 50435;
/// The header of curves, of force or current, that were measured at points of the picture.
const CURVES: u16 = 50438;
/// Bytes of the header of version 1.
const HEADER_BYTES: usize = 284;
/// The place of the number type, which version 2 has.
const KIND: usize = 348;
/// Lengths along x and y are in micrometres.
const MICROMETRE: f64 = 1e-6;

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let tags = Tags::open(source)?;
    let magic = tags.number(0, MAGIC)?.unwrap_or(0.0) as u64;
    let version = tags.number(0, VERSION)?.unwrap_or(0.0) as u64;
    if magic != 0x0e03_1301 || ![0x0100_0001, 0x0100_0002].contains(&version) {
        return Err(unsupported!("is a Park TIFF of version {version:x}; allowed: 1000001, 1000002"));
    }
    let bytes = tags.bytes(0, HEADER, KIND as u64 + 4)?.unwrap_or_default();
    let needed = if version == 0x0100_0001 { HEADER_BYTES } else { KIND + 4 };
    if bytes.len() < needed {
        return Err(corrupt!("has a header of {} bytes; allowed: at least {needed}", bytes.len()));
    }
    let header = Fields { bytes, big_endian: false };
    let kind_of_image = header.count(0, U32)?;
    if kind_of_image != 0 || tags.length(0, CURVES).is_some() {
        let what = if kind_of_image == 1 { "a line profile" } else { "force curves or other curves" };
        return Err(unsupported!(
            "holds {what} of a Park instrument, no height map; allowed: a file of an image"
        ));
    }
    let kind = match if version == 0x0100_0001 { 0 } else { header.count(KIND, U32)? } {
        0 => I16,
        1 => I32,
        2 => F32,
        other => {
            return Err(unsupported!("holds numbers of type {other}; allowed: 0, 1, 2"));
        }
    };
    let number = |at: usize| header.number(at, F64);
    let mut points = [header.count(100, U32)?, header.count(104, U32)?];
    let mut size = [number(140)?.abs() * MICROMETRE, number(148)?.abs() * MICROMETRE];
    let mut order = Order::LinesUpwards;
    let length = tags.length(0, DATA).unwrap_or(0);
    let [nx, ny] = points;
    if nx.saturating_mul(ny).saturating_mul(kind.bytes()) != length {
        return Err(corrupt!(
            "holds {length} bytes for a map of {nx} x {ny} points of {} bytes",
            kind.bytes()
        ));
    }
    source.check(0, length)?;
    // The fast axis of the scan is y.
    if header.count(136, U32)? != 0 {
        points.reverse();
        size.reverse();
        order = Order::ColumnsUpwardsFromRight;
    }
    let numbers = move |source: &Source| {
        let bytes = Tags::open(source)?.bytes(0, DATA, length)?.unwrap_or_default();
        Ok(source.values(kind, false, &bytes, UNPACKED - OF_BYTES))
    };
    let name = wide(&header, 4, 32)?;
    let name = if name.is_empty() { "Topography".to_owned() } else { name };
    let channel = Channel::new(name, points, Numbers::Packed(kind, Box::new(numbers)));
    let (gain, scale, offset) = (number(220)?, number(228)?, number(236)?);
    let scale = if scale == 0.0 { 1.0 } else { scale };
    let unit = wide(&header, 244, 8)?;
    Ok(vec![
        Channel {
            pixel: Some([size[0] / points[0] as f64, size[1] / points[1] as f64]),
            factor: gain * scale,
            // Not the negative zero of a negative gain.
            offset: gain * offset + 0.0,
            order,
            ..channel
        }
        .in_unit(if unit.is_empty() { "um" } else { &unit })
        .pixel_in(Some(MICROMETRE)),
    ])
}

/// A text of `count` characters of two bytes, up to its first zero.
fn wide(header: &Fields, at: usize, count: usize) -> Result<String, ReadError> {
    let character = |k: usize| Ok::<_, ReadError>(header.count(at + 2 * k, U16)? as u16);
    let characters = (0..count).map(character).collect::<Result<Vec<_>, _>>()?;
    let characters = characters.split(|&character| character == 0).next().unwrap_or_default();
    Ok(String::from_utf16_lossy(characters).trim().to_owned())
}
