//! Digital Surf `.sur` (MountainsMap and the software of many instruments): objects one behind the other, each a header of 512 bytes,
//! a comment, a private zone, and integers, plain or packed by zlib.

use super::channel::{Channel, Numbers, Stored, UNPACKED, length};
use super::error::{ReadError, too_large};
use super::source::{Fields, OF_BYTES, Source, check_packed, inflated};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{self, F32, I16, I32, U16, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Digital Surf SUR file",
    endings: &["sur"],
    is: |source| source.begin().starts_with(PLAIN) || source.begin().starts_with(PACKED),
    read: Reader::Channels(channels),
};

const PLAIN: &[u8; 12] = b"DIGITAL SURF";
const PACKED: &[u8; 12] = b"DSCOMPRESSED";
/// Bytes of a header.
const HEADER: u64 = 512;
/// The most objects that are listed.
const MOST: u64 = 256;

/// The kind of an object that holds no map; the empty text of one that does.
fn unread(kind: u64, lines: u64) -> &'static str {
    match kind {
        // Gwyddion gives surfaces the kind of profiles.
        1 if lines > 1 => "",
        1 | 4 | 6 | 7 | 9 | 17 => "profiles",
        14 | 15 => "force curves",
        18 => "a series of pictures",
        19..=21 => "spectra",
        _ => "",
    }
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let mut channels = Vec::new();
    let mut start = 0;
    let objects = Object::read(source, 0)?.header.count(14, U16)?.max(1);
    for _ in 0..objects.min(MOST) {
        // What follows the objects that are read is left.
        let object = match Object::read(source, start) {
            Ok(object) if object.is_known() => object,
            _ if start > 0 => break,
            Ok(_) => return Err(corrupt!("has no header of an object")),
            Err(error) => return Err(error),
        };
        let unread = unread(object.header.count(18, U16)?, object.points[1]);
        if !unread.is_empty() {
            return Err(unsupported!("holds {unread}; allowed: a surface"));
        }
        start = object.end().ok_or_else(too_large)?;
        channels.push(object.channel()?);
    }
    Ok(channels)
}

struct Object {
    header: Fields,
    is_packed: bool,
    points: [u64; 2],
    kind: NumberType,
    /// Where its numbers stand, bytes.
    start: u64,
}

impl Object {
    fn read(source: &Source, at: u64) -> Result<Self, ReadError> {
        let mut header = source.fields(at, HEADER)?;
        // A Macintosh writes the most significant byte first, and 257, which is the same in both orders.
        header.big_endian = header.number(12, U16)? == 257.0;
        let kind = match header.number(98, U16)? {
            16.0 => I16,
            32.0 => I32,
            bits => {
                return Err(unsupported!("holds numbers of {bits} bits; allowed: 16, 32"));
            }
        };
        let zones = header.count(334, U16)? + header.count(336, U16)?;
        Ok(Self {
            is_packed: header.bytes.starts_with(PACKED),
            points: [header.count(108, I32)?, header.count(112, I32)?],
            kind,
            start: at + HEADER + zones,
            header,
        })
    }

    fn is_known(&self) -> bool {
        self.is_packed || self.header.bytes.starts_with(PLAIN)
    }

    /// Bytes of the numbers, unpacked.
    fn bytes(&self) -> Option<u64> {
        self.points[0].checked_mul(self.points[1])?.checked_mul(self.kind.bytes())
    }

    fn end(&self) -> Option<u64> {
        let bytes = if self.is_packed { self.header.count(324, U32).ok()? } else { self.bytes()? };
        self.start.checked_add(bytes)
    }

    fn channel(self) -> Result<Channel, ReadError> {
        let Self { header, is_packed, points, kind, start } = &self;
        let big_endian = header.big_endian;
        let numbers = if *is_packed {
            let (start, kind, bytes) = (*start, *kind, self.bytes().ok_or_else(too_large)?);
            Numbers::Packed(
                kind,
                Box::new(move |source| {
                    let bytes = unpacked(source, start, bytes, big_endian)?;
                    Ok(source.values(kind, big_endian, &bytes, 0.5 * (UNPACKED - OF_BYTES)))
                }),
            )
        } else {
            Numbers::Stored(Stored { big_endian, ..Stored::new(*start, *kind) })
        };
        let side = |axis: usize| {
            let unit = length(&header.text(180 + 16 * axis, 16)?);
            Ok::<_, ReadError>(unit.map(|unit| unit * header.number(120 + 4 * axis, F32).unwrap_or(0.0)))
        };
        let pixel = side(0)?.zip(side(1)?).map(|(x, y)| [x.abs(), y.abs()]);
        // Points that were not measured lie two steps below the least height.
        let missing = (header.number(86, U16)? == 1.0).then_some(header.number(100, I32)? - 2.0);
        let name = [header.text(164, 16)?, header.text(20, 30)?].into_iter().find(|name| !name.is_empty());
        let channel = Channel {
            pixel,
            factor: header.number(128, F32)?,
            offset: header.number(474, F32)?,
            missing: Box::new(move |value| Some(value) == missing),
            ..Channel::new(name.unwrap_or_else(|| "Surface".to_owned()), *points, numbers)
        };
        Ok(channel.in_unit(&header.text(212, 16)?).pixel_in(length(&header.text(180, 16)?)))
    }
}

/// A directory of streams, then the streams.
fn unpacked(source: &Source, start: u64, bytes: u64, big_endian: bool) -> Result<Vec<u8>, ReadError> {
    check_packed("it", source.length().saturating_sub(start), bytes)?;
    let fields = |start, count| Ok::<_, ReadError>(Fields { big_endian, ..source.fields(start, count)? });
    let streams = fields(start, 4)?.count(0, U32)?;
    let directory = fields(start + 4, 8 * streams)?;
    let mut start = start + 4 + 8 * streams;
    let mut all = Vec::new();
    let mut count = source.count(0.5 * (UNPACKED - OF_BYTES), bytes as usize);
    for stream in 0..streams as usize {
        let [unpacked, packed] = [0, 4].map(|at| directory.count(8 * stream + at, U32));
        let (unpacked, packed) = (unpacked?, packed?);
        if unpacked.saturating_add(all.len() as u64) > bytes {
            break;
        }
        all.extend(inflated(&source.bytes(start, packed)?, unpacked, &mut count)?);
        start += packed;
    }
    if all.len() as u64 != bytes {
        return Err(corrupt!("unpacks to {} bytes; allowed: {bytes}", all.len()));
    }
    count.end();
    Ok(all)
}
