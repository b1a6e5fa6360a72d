//! TIFF files as instruments write them.

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
    let two = |value: u16| if big_endian { value.to_be_bytes() } else { value.to_le_bytes() };
    let four = |value: usize| {
        let value = value as u32;
        if big_endian { value.to_be_bytes() } else { value.to_le_bytes() }
    };
    let mut bytes = [if big_endian { b"MM" } else { b"II" }, &two(42)[..], &[0; 4]].concat();
    let mut link = 4;
    for directory in directories {
        let mut entries = Vec::new();
        for (tag, value) in directory {
            match value {
                Value::Short(value) => entries.push((*tag, 3, 1, two(*value).to_vec())),
                Value::Long(value) => entries.push((*tag, 4, 1, four(*value as usize).to_vec())),
                Value::Double(value) => {
                    let value = if big_endian { value.to_be_bytes() } else { value.to_le_bytes() };
                    entries.push((*tag, 12, 1, value.to_vec()));
                }
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
                    entries.push((259, 3, 1, two(*method).to_vec()));
                    entries.push((273, 4, strips.len(), places));
                    entries.push((279, 4, strips.len(), lengths));
                }
            }
        }
        entries.sort_by_key(|entry| entry.0);
        let mut table = two(entries.len() as u16).to_vec();
        for (tag, kind, count, mut value) in entries {
            table.extend([two(tag), two(kind)].concat());
            table.extend(four(count));
            if value.len() > 4 {
                let place = four(bytes.len()).to_vec();
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

/// Bytes as they are, in a block of zlib that only stores them, or in runs of PackBits.
fn packed(method: u16, bytes: &[u8]) -> Vec<u8> {
    match method {
        8 => {
            let length = bytes.len() as u16;
            let [a, b] = bytes.iter().fold([1u32, 0], |[a, b], &byte| {
                let a = (a + u32::from(byte)) % 65521;
                [a, (a + b) % 65521]
            });
            let stored = [&[0x78, 0x01, 0x01][..], &length.to_le_bytes(), &(!length).to_le_bytes(), bytes];
            [stored.concat(), (b << 16 | a).to_be_bytes().to_vec()].concat()
        }
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

#[test]
fn a_picture_holds_no_heights() {
    for big_endian in [false, true] {
        let bytes = tiff(big_endian, &[thumbnail()]);
        assert_refused!(Unsupported, bytes.clone());
        assert_refused!(Corrupt, &bytes[..bytes.len() - 6]);
        // The second directory, of nine entries, is its own next one.
        let mut circle = tiff(big_endian, &[thumbnail(), thumbnail()]);
        let end = circle.len() - 4;
        let second = (end - 9 * 12 - 2) as u32;
        circle[end..].copy_from_slice(&if big_endian { second.to_be_bytes() } else { second.to_le_bytes() });
        assert_refused!(Corrupt, circle);
    }
    assert_refused!(Mismatch, b"II*");
}
