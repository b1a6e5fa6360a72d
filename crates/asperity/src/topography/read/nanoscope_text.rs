//! Texts that Nanoscope exports: the header of its files, with or without quotes, then for each image a line with its unit and lines of
//! numbers. Without a header there is the unit alone.

use super::channel::{Channel, Numbers, UNPACKED};
use super::error::ReadError;
use super::nanoscope::{pixel, sections};
use super::source::{self, OF_BYTES, Source};
use super::table::{Table, with_marks};
use super::{Format, Reader};
use crate::numeric::stored::NumberType::F64;
use crate::progress::Share;

pub(super) const FORMAT: Format = Format {
    name: "a text of Nanoscope",
    endings: &[],
    is: |source| is_export(source).unwrap_or(false),
    read: Reader::Channels(channels),
};

/// What stands before the unit of an image.
const UNIT: &str = "\\Exported image units:";
/// Bytes in which the first unit must stand.
const HEADER: u64 = 1 << 20;

fn is_export(source: &Source) -> Result<bool, ReadError> {
    let begin = source.begin();
    let begin = begin.strip_prefix(b"\xef\xbb\xbf").unwrap_or(begin);
    let begin = begin.strip_prefix(b"\"").unwrap_or(begin);
    if !begin.starts_with(b"\\") && !begin.starts_with(b"?*") {
        return Ok(false);
    }
    Ok(source.at_most(0, HEADER)?.windows(UNIT.len()).any(|bytes| bytes == UNIT.as_bytes()))
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let bytes = source.all()?;
    let count = source.count(0.0, bytes.len());
    let text = source::text(bytes, count);
    let text = with_marks(text.trim_start_matches('\u{feff}'), &[]);
    let mut parts = text.split(UNIT);
    let header = parts.next().unwrap_or_default().lines().map(|line| {
        let line = line.trim().trim_matches('"');
        line.strip_prefix('?').map_or_else(|| line.to_owned(), |line| format!("\\{line}"))
    });
    let header = header.collect::<Vec<_>>().join("\n");
    let sections = sections(&header);
    let global =
        |key: &str| sections.iter().find_map(|section| section.get(key).filter(|_| !section.is_image()));
    let images: Vec<_> = sections.iter().filter(|section| section.is_image()).collect();
    let parts: Vec<&str> = parts.collect();
    let mut channels = Vec::new();
    for (number, part) in parts.iter().enumerate() {
        let (unit, numbers) = part.split_once('\n').unwrap_or((part, ""));
        let units = (UNPACKED - OF_BYTES) / parts.len() as f64;
        let Table { rows, columns, values, .. } =
            Table::parse(numbers, &Share { progress: source.progress(), units })?;
        let image = images.get(number);
        // S [Sens] "Name", the quotes of which may be doubled.
        let title = image.and_then(|image| image.get("Image Data")).unwrap_or_default();
        let name = title.rsplit_once("] ").map_or(title, |(_, name)| name).replace('"', "");
        let name = if name.is_empty() { format!("Image {}", number + 1) } else { name.trim().to_owned() };
        let points = [columns as u64, rows as u64];
        let numbers = Numbers::Packed(F64, Box::new(move |_| Ok(values.clone())));
        let channel = Channel {
            pixel: image.and_then(|image| pixel(image, points, points, &global).ok()),
            ..Channel::new(name, points, numbers)
        };
        channels.push(channel.in_unit(unit.trim().trim_matches('"')));
    }
    Ok(channels)
}
