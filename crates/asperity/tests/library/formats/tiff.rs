//! TIFF files as instruments write them.

use super::instrument::{Number, deflated};
use super::refused::Good;

#[derive(Clone)]
pub enum Value {
    Short(u16),
    Long(u32),
    Double(f64),
    Text(&'static str),
    Bytes(Vec<u8>),
    /// The strips of a picture, packed by a method of TIFF.
    Strips(u16, Vec<Vec<u8>>),
}

/// A file of directories, each a list of tags in ascending order.
pub fn tiff(big_endian: bool, directories: &[Vec<(u16, Value)>]) -> Vec<u8> {
    let two = |value: u16| value.bytes(big_endian);
    let four = |value: usize| (value as u32).bytes(big_endian);
    let mut bytes = [if big_endian { b"MM" } else { b"II" }, &two(42)[..], &[0; 4]].concat();
    let mut link = 4;
    for directory in directories {
        let mut entries = Vec::new();
        for (tag, value) in directory {
            match value {
                Value::Short(value) => entries.push((*tag, 3, 1, two(*value))),
                Value::Long(value) => entries.push((*tag, 4, 1, value.bytes(big_endian))),
                Value::Double(value) => entries.push((*tag, 12, 1, value.bytes(big_endian))),
                Value::Text(text) => {
                    entries.push((*tag, 2, text.len() + 1, [text.as_bytes(), &[0]].concat()))
                }
                Value::Bytes(content) => entries.push((*tag, 1, content.len(), content.clone())),
                Value::Strips(method, strips) => {
                    let (mut places, mut lengths) = (vec![], vec![]);
                    for strip in strips {
                        let strip = packed(*method, strip);
                        places.extend(four(bytes.len()));
                        lengths.extend(four(strip.len()));
                        bytes.extend(strip);
                    }
                    entries.push((259, 3, 1, two(*method)));
                    entries.push((273, 4, strips.len(), places));
                    entries.push((279, 4, strips.len(), lengths));
                }
            }
        }
        entries.sort_by_key(|entry| entry.0);
        let mut table = two(entries.len() as u16);
        for (tag, kind, count, mut value) in entries {
            table.extend([two(tag), two(kind)].concat());
            table.extend(four(count));
            if value.len() > 4 {
                let place = four(bytes.len());
                bytes.extend(std::mem::replace(&mut value, place));
            }
            value.resize(4, 0);
            table.extend(value);
        }
        let place = four(bytes.len());
        bytes[link..link + 4].copy_from_slice(&place);
        link = bytes.len() + table.len();
        bytes.extend(table);
        bytes.extend([0; 4]);
    }
    bytes
}

/// Bytes as they are, packed by zlib, or in runs of PackBits.
fn packed(method: u16, bytes: &[u8]) -> Vec<u8> {
    match method {
        8 => deflated(bytes),
        32773 => bytes.chunks(100).flat_map(|run| [&[run.len() as u8 - 1], run].concat()).collect(),
        _ => bytes.to_vec(),
    }
}

/// A small picture in grey.
pub fn thumbnail() -> Vec<(u16, Value)> {
    let sizes =
        [(256, Value::Short(2)), (257, Value::Short(1)), (258, Value::Short(8)), (262, Value::Short(1))];
    [
        sizes.to_vec(),
        vec![(277, Value::Short(1)), (278, Value::Short(1)), (273, Value::Strips(1, vec![vec![0, 9]]))],
    ]
    .concat()
}

pub fn good() -> Vec<Good> {
    let picture = |big_endian| tiff(big_endian, &[thumbnail()]);
    // The second directory, of nine entries, is its own next one.
    let circle = |big_endian| {
        let mut circle = tiff(big_endian, &[thumbnail(), thumbnail()]);
        let end = circle.len() - 4;
        let second = ((end - 9 * 12 - 2) as u32).bytes(big_endian);
        circle.splice(end.., second);
        circle
    };
    vec![
        Good::whole("tiff of a picture", picture(false)),
        Good::whole("tiff of a picture, big-endian", picture(true)),
        Good::whole("tiff of a circle", circle(false)),
        Good::whole("tiff of a circle, big-endian", circle(true)),
    ]
}
