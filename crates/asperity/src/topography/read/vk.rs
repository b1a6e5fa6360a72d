//! Keyence `.vk3`, `.vk4`, `.vk6`, `.vk7`: a table of places, measurement conditions, then pictures of light and height as integers. The
//! last two hold such a file in a zip archive. Described in <https://www.osti.gov/biblio/1419732>.

use std::sync::Arc;

use zip::ZipArchive;

use super::channel::{Channel, Numbers, Quantity, Stored, UNPACKED};
use super::error::{ReadError, too_large};
use super::source::{Fields, MAX_COMPRESSION, Source, read_counted};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{self, U8, U16, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Keyence VK file",
    endings: &["vk3", "vk4", "vk6", "vk7"],
    is: |source| version(source.begin()).is_some(),
    read: Reader::Channels(channels),
};

/// The version of a file.
fn version(begin: &[u8]) -> Option<u8> {
    match begin {
        [b'V', b'K', digit @ (b'3' | b'4'), b'_', _, _, _, _, 0, 0, 0, 0, ..] => Some(digit - b'0'),
        [b'V', b'K', digit @ (b'6' | b'7'), ..] => Some(digit - b'0'),
        _ => None,
    }
}

/// Where the table of places begins, bytes, and how many it has in version 3; version 4 has one more.
const TABLE: u64 = 12;
const PLACES: u64 = 17;
/// The places of pictures in that table.
const PICTURES: [(&str, usize); 6] =
    [("Height", 6), ("Height 2", 7), ("Height 3", 8), ("Light", 3), ("Light 2", 4), ("Light 3", 5)];
/// Where lengths along x, y and z stand in the conditions, bytes; in picometres.
const LENGTHS: usize = 168;
const PICOMETRE: f64 = 1e-12;
/// Bytes of the sizes of a picture, and of the palette behind them.
const SIZES: u64 = 28;
const PALETTE: u64 = 768;

/// The file within a zip archive.
const INNER: &str = "Vk4File";

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let version = version(source.begin()).unwrap_or_default();
    if version < 5 {
        let numbers = |start, kind, _| Ok(Numbers::Stored(Stored::new(start, kind)));
        return pictures(version, &|start, count| source.fields(start, count), &numbers);
    }
    let bytes: Arc<[u8]> = inner(source)?.into();
    let part = |start: u64, count: u64| {
        let range = usize::try_from(start)
            .ok()
            .zip(start.checked_add(count).and_then(|end| usize::try_from(end).ok()));
        let part = range.and_then(|(start, end)| bytes.get(start..end));
        part.ok_or_else(|| corrupt!("is truncated: its {INNER} ends too early"))
    };
    let fields = |start, count| Ok(Fields { bytes: part(start, count)?.to_vec(), big_endian: false });
    let numbers = |start: u64, kind: NumberType, count: u64| {
        part(start, count)?;
        let (bytes, start, end) = (Arc::clone(&bytes), start as usize, (start + count) as usize);
        let unpacked =
            move |source: &Source| Ok(source.values(kind, false, &bytes[start..end], 0.5 * UNPACKED));
        Ok(Numbers::Packed(kind, Box::new(unpacked)))
    };
    pictures(4, &fields, &numbers)
}

/// The file within the archive.
fn inner(source: &Source) -> Result<Vec<u8>, ReadError> {
    let damaged = |error: &dyn std::fmt::Display| corrupt!("is an invalid zip archive: {error}");
    let mut archive = ZipArchive::new(source.reader()?).map_err(|error| damaged(&error))?;
    let entry = archive.by_name(INNER).map_err(|error| damaged(&error))?;
    let most = source.length().saturating_mul(MAX_COMPRESSION);
    let mut count = source.count(0.5 * UNPACKED, usize::try_from(entry.size()).unwrap_or(usize::MAX));
    let bytes = read_counted(entry, Vec::new(), most + 1, &mut count).map_err(|error| damaged(&error))?;
    count.end();
    if bytes.len() as u64 > most {
        return Err(damaged(&format!(
            "{INNER} unpacks to more than {MAX_COMPRESSION} times the bytes of the file"
        )));
    }
    Ok(bytes)
}

/// The pictures of a file of this version, of which `fields` reads parts and `numbers` finds numbers.
fn pictures(
    version: u8,
    fields: &dyn Fn(u64, u64) -> Result<Fields, ReadError>,
    numbers: &dyn Fn(u64, NumberType, u64) -> Result<Numbers, ReadError>,
) -> Result<Vec<Channel>, ReadError> {
    let places = PLACES + u64::from(version == 4);
    let header = fields(TABLE, 4 * places + LENGTHS as u64 + 12)?;
    let length = |axis: usize| {
        Ok::<_, ReadError>(header.number(4 * places as usize + LENGTHS + 4 * axis, U32)? * PICOMETRE)
    };
    let (pixel, height) = ([length(0)?, length(1)?], length(2)?);
    let mut channels = Vec::new();
    for (name, place) in PICTURES {
        let start = header.count(4 * place, U32)?;
        if start == 0 {
            continue;
        }
        let sizes = fields(start, SIZES)?;
        let points = [sizes.count(0, U32)?, sizes.count(4, U32)?];
        let kind = match sizes.count(8, U32)? {
            8 => U8,
            16 => U16,
            32 => U32,
            // Colours.
            _ => continue,
        };
        let bytes = points[0].checked_mul(points[1]).and_then(|count| count.checked_mul(kind.bytes()));
        let bytes = bytes.ok_or_else(too_large)?;
        // What the compression of a picture says is not used.
        let stored = sizes.count(16, U32)?;
        if stored != bytes {
            return Err(unsupported!(
                "holds a picture of {} x {} points in {stored} bytes; allowed: {bytes}",
                points[0],
                points[1]
            ));
        }
        let numbers = numbers(start + SIZES + PALETTE, kind, bytes)?;
        let channel = Channel { pixel: Some(pixel), ..Channel::new(name, points, numbers) };
        channels.push(if name.starts_with("Height") {
            Channel { factor: height, ..channel }
        } else {
            Channel { quantity: Quantity::Other("grey".to_owned()), ..channel }
        });
    }
    Ok(channels)
}
