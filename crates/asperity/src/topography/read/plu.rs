//! Sensofar `.plu`: a header of fixed length, then a layer of heights of single precision in µm.

use super::channel::{Channel, Numbers, Stored};
use super::content::LengthUnits;
use super::error::ReadError;
use super::source::{Fields, Source};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{F32, U8, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Sensofar PLU file",
    endings: &["plu"],
    is: |source| is_plu(source).unwrap_or(false),
    read: Reader::Channels(channels),
};

/// Where the sizes, the pixel, the kind of measurement, the number of layers and the layers stand, bytes.
const SIZES: usize = 388;
const PIXEL: usize = 404;
const KIND: usize = 428;
const LAYERS: usize = 489;
const DATA: usize = 500;
/// A height that marks a missing point, µm.
const MISSING: f64 = 1_000_001.0;
const MICRON: f64 = 1e-6;

/// It has no signature: it begins with a date as in "Mon Apr 19 11:40:13 2021", and the sizes of the header are those of the first
/// layer, except in profiles.
fn is_plu(source: &Source) -> Result<bool, ReadError> {
    let header = Fields { bytes: source.begin().to_vec(), big_endian: false };
    let date = header.text(0, 128)?;
    let is_date = date.len() == 24
        && date.is_char_boundary(3)
        && ["Mon", "Tue", "Wed", "Thu", "Fri", "Sat", "Sun"].contains(&&date[..3])
        && date.bytes().filter(|&byte| byte == b':').count() == 2;
    Ok(is_date && header.number(KIND, U32)? <= 6.0)
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let header = source.fields(0, DATA as u64)?;
    let kind = match header.count(KIND, U32)? {
        0 => "an image",
        1 | 2 | 5 => "a profile",
        3 => "",
        4 => "coordinates",
        _ => "an unknown measurement",
    };
    if !kind.is_empty() {
        return Err(unsupported!("holds {kind}; allowed: a topography"));
    }
    let pixel = [header.number(PIXEL, F32)? * MICRON, header.number(PIXEL + 4, F32)? * MICRON];
    let mut channels = Vec::new();
    let mut start = DATA as u64;
    for layer in 0..header.count(LAYERS, U8)?.max(1) {
        let sizes = source.fields(start, 8)?;
        let points = [sizes.count(4, U32)?, sizes.count(0, U32)?];
        channels.push(Channel {
            pixel: Some(pixel),
            stated: LengthUnits::same(MICRON),
            factor: MICRON,
            missing: Box::new(|value| value == MISSING),
            ..Channel::new(
                format!("Layer {}", layer + 1),
                points,
                Numbers::Stored(Stored::new(start + 8, F32)),
            )
        });
        // The least and the greatest height follow.
        start = points[0].saturating_mul(points[1]).saturating_mul(4).saturating_add(start + 16);
    }
    let is_same = channels
        .first()
        .is_some_and(|first| [4, 0].map(|at| header.count(SIZES + at, U32).ok()) == first.points.map(Some));
    if !is_same {
        return Err(corrupt!("has other sizes in its header than before its heights"));
    }
    Ok(channels)
}
