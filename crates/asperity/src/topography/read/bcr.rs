//! BCR-STM and BCRF of Image Metrology and Nanosurf: a header of `key = value` in Latin-1 or UTF-16, then integers of two bytes or
//! single precision.

use super::channel::{Channel, Numbers, Stored, length};
use super::error::{ReadError, shortened};
use super::source::Source;
use super::{Format, Reader};
use crate::numeric::stored::NumberType::{F32, I16};

pub(super) const FORMAT: Format = Format {
    name: "a BCR-STM or BCRF file",
    endings: &["bcr", "bcrf"],
    is: |source| {
        decoded(&source.begin()[..BEGIN.min(source.begin().len())]).0.starts_with("fileformat = bcr")
    },
    read: Reader::Channels(channels),
};

/// Bytes that hold the first line.
const BEGIN: usize = 64;
/// Characters of a header that does not state its length.
const HEADER: u64 = 2048;
/// The most characters of a header.
const MOST: u64 = 1 << 20;

/// A text in UTF-16 with the least significant byte first, or in Latin-1; and the bytes of a character.
fn decoded(bytes: &[u8]) -> (String, u64) {
    let bytes = bytes.strip_prefix(b"\xff\xfe").unwrap_or(bytes);
    if bytes.get(1) == Some(&0) {
        let (units, _) = bytes.as_chunks::<2>();
        let text = char::decode_utf16(units.iter().map(|&unit| u16::from_le_bytes(unit)));
        (text.map(|c| c.unwrap_or(' ')).collect(), 2)
    } else {
        (bytes.iter().map(|&byte| char::from(byte)).collect(), 1)
    }
}

/// Lines of `key = value`.
pub(super) struct Header(pub(super) String);

impl Header {
    /// The value of a key; `None` where it is missing or empty.
    pub(super) fn text(&self, key: &str) -> Option<&str> {
        let entries = self.0.lines().filter_map(|line| line.split_once('='));
        let mut values = entries.filter(|(found, _)| found.trim() == key).map(|(_, value)| value.trim());
        values.next().filter(|value| !value.is_empty())
    }

    pub(super) fn number<T: std::str::FromStr>(&self, key: &str) -> Result<Option<T>, ReadError> {
        let number = |text: &str| {
            text.parse()
                .map_err(|_| corrupt!("has {key} = \"{}\" in its header; allowed: a number", shortened(text)))
        };
        self.text(key).map(number).transpose()
    }

    /// A number of points, without which there is no map.
    pub(super) fn needed(&self, key: &str) -> Result<u64, ReadError> {
        self.number(key)?.ok_or_else(|| corrupt!("has no {key} in its header"))
    }

    /// The unit of a key, nm where there is none. No current is stored, so that "A" is the ångström.
    fn unit(&self, key: &str) -> &str {
        match self.text(key) {
            Some("A") => "Å",
            unit => unit.unwrap_or("nm"),
        }
    }

    /// A length: the number of one key in the unit of another.
    fn length(&self, key: &str, unit: &str) -> Result<Option<f64>, ReadError> {
        let metres = length(self.unit(unit));
        Ok(self.number::<f64>(key)?.zip(metres).map(|(number, metres)| number * metres))
    }
}

fn channels(source: &Source) -> Result<Vec<Channel>, ReadError> {
    let (begin, width) = decoded(&source.at_most(0, 2 * HEADER)?);
    let mark = if source.begin().starts_with(b"\xff\xfe") { 2 } else { 0 };
    let characters = Header(begin).number("headersize")?.unwrap_or(HEADER);
    if characters > MOST {
        return Err(corrupt!("has a header of {characters} characters; allowed: at most {MOST}"));
    }
    let start = mark + width * characters;
    let header = Header(decoded(&source.bytes(0, start)?).0);
    let points = [header.needed("xpixels")?, header.needed("ypixels")?];
    let is_float = header.text("fileformat").is_some_and(|format| format.starts_with("bcrf"));
    // `voidpixels` is a number of points or a mark, depending on the program.
    let (kind, missing) = if is_float { (F32, 1.7e38) } else { (I16, 32_767.0) };
    let sizes = [header.length("xlength", "xunit")?, header.length("ylength", "yunit")?];
    let pixel = match sizes {
        [Some(x), Some(y)] => Some([x / points[0] as f64, y / points[1] as f64]),
        _ => None,
    };
    let big_endian = header.number::<u8>("intelmode")? == Some(0);
    let channel = Channel {
        pixel,
        factor: header.number("bit2nm")?.unwrap_or(1.0),
        missing: Box::new(move |value| value >= missing),
        ..Channel::new("Heights", points, Numbers::Stored(Stored { big_endian, ..Stored::new(start, kind) }))
    };
    Ok(vec![channel.in_unit(header.unit("zunit")).pixel_in(length(header.unit("xunit")))])
}
