//! Nanosurf `.nid`: sections of `key=value`, the mark `#!`, then the channels one behind the other as integers.

use std::collections::HashMap;

use super::channel::{Channel, Numbers, Order, Stored, length};
use super::error::{ReadError, shortened};
use super::source::{Source, text};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{self, I8, I16, I32, U8, U16, U32};

pub(super) const FORMAT: Format = Format {
    name: "a Nanosurf NID file",
    endings: &["nid"],
    is: |source| source.begin().starts_with(b"[DataSet]"),
    read: Reader::Channels(channels),
};

/// The most bytes of the text.
const MOST: u64 = 4 << 20;
/// The most channels that are listed.
const MOST_CHANNELS: usize = 1000;
const MARK: &[u8] = b"\n#!";

/// A section of the text.
struct Section<'a>(&'a str, HashMap<&'a str, &'a str>);

impl Section<'_> {
    fn text(&self, key: &str) -> Result<&str, ReadError> {
        let Self(name, entries) = self;
        let missing = || corrupt!("has no {key} in its section [{name}]");
        entries.get(key).copied().ok_or_else(missing)
    }

    fn number<T: std::str::FromStr>(&self, key: &str) -> Result<T, ReadError> {
        let text = self.text(key)?;
        text.parse().map_err(|_| {
            let (name, text) = (self.0, shortened(text));
            corrupt!("has {key}={text} in its section [{name}]; allowed: a number")
        })
    }

    /// The type of the numbers, and whether their most significant byte stands first.
    fn stored(&self) -> Result<(NumberType, bool), ReadError> {
        let (mode, bits, sign) = (self.text("SaveMode")?, self.text("SaveBits")?, self.text("SaveSign")?);
        let kind = match (bits, sign) {
            ("8", "Signed") => I8,
            ("16", "Signed") => I16,
            ("32", "Signed") => I32,
            ("8", _) => U8,
            ("16", _) => U16,
            ("32", _) => U32,
            _ => {
                return Err(unsupported!("holds numbers of {bits} bits; allowed: 8, 16, 32"));
            }
        };
        if mode != "Binary" {
            return Err(unsupported!("holds numbers as {mode}; allowed: Binary"));
        }
        Ok((kind, self.text("SaveOrder")? != "Intel"))
    }
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let mut bytes = source.at_most(0, MOST)?;
    let end = bytes.windows(MARK.len()).position(|window| window == MARK);
    let end = end.ok_or_else(|| corrupt!("is truncated: no #! ends its text"))?;
    bytes.truncate(end);
    let text = text(bytes, source.count(0.0, end));
    let mut sections: HashMap<&str, Section> = HashMap::new();
    let mut name = "";
    for line in text.lines().map(str::trim) {
        if let Some(section) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            name = section;
            sections.entry(name).or_insert_with(|| Section(name, HashMap::new()));
        } else if let (Some(section), Some((key, value))) = (sections.get_mut(name), line.split_once('=')) {
            section.1.insert(key.trim(), value.trim());
        }
    }
    let Some(groups) = sections.get("DataSet") else { return Ok(Vec::new()) };
    let mut start = (end + MARK.len()) as u64;
    let mut channels = Vec::new();
    for group in 0..groups.number::<u8>("GroupCount")? {
        for channel in 0..groups.number::<u8>(&format!("Gr{group}-Count")).unwrap_or(0) {
            // Channels that were not saved have no entry.
            let name = groups.text(&format!("Gr{group}-Ch{channel}")).ok();
            let Some(section) = name.and_then(|name| sections.get(name)) else { continue };
            let points: [u64; 2] = [section.number("Points")?, section.number("Lines")?];
            let (kind, big_endian) = section.stored()?;
            let numbers = Numbers::Stored(Stored { big_endian, ..Stored::new(start, kind) });
            let bytes = points[0].checked_mul(points[1]).and_then(|count| count.checked_mul(kind.bytes()));
            start = bytes.and_then(|bytes| bytes.checked_add(start)).ok_or_else(super::error::too_large)?;
            if channels.len() == MOST_CHANNELS {
                return Err(corrupt!("holds more than {MOST_CHANNELS} channels"));
            }
            if points[1] > 1 && section.text("Dim1Unit").is_ok_and(|unit| length(unit).is_some()) {
                channels.push(image(section, points, kind, numbers)?);
            }
        }
    }
    Ok(channels)
}

fn image(
    section: &Section,
    points: [u64; 2],
    kind: NumberType,
    numbers: Numbers,
) -> Result<Channel, ReadError> {
    let side = |axis: usize| {
        let unit = length(section.text(&format!("Dim{axis}Unit"))?);
        let range: f64 = section.number(&format!("Dim{axis}Range"))?;
        Ok::<_, ReadError>(unit.map(|unit| range * unit / points[axis] as f64))
    };
    let pixel: [Option<f64>; 2] = [side(0)?, side(1)?];
    // The numbers of the type span the range.
    let (range, least): (f64, f64) = (section.number("Dim2Range")?, section.number("Dim2Min")?);
    let [from, to] = kind.range();
    let factor = range / (to - from + 1.0);
    let name = format!("{} ({})", section.text("Frame")?, section.text("Dim2Name")?);
    let channel = Channel {
        pixel: pixel[0].zip(pixel[1]).map(|(x, y)| [x, y]),
        factor,
        offset: least - factor * from,
        order: Order::LinesUpwards,
        ..Channel::new(name, points, numbers)
    };
    Ok(channel.in_unit(section.text("Dim2Unit")?).pixel_in(length(section.text("Dim0Unit")?)))
}
