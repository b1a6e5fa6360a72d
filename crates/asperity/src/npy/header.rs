//! The header of a `.npy` file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::error::{HeaderError, MAX_HEADER_BYTES, NpyError};
use crate::numeric::stored::NumberType;

/// The first bytes of a `.npy` file.
pub(crate) const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// Shape and type of an array, checked against the length of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// Length along the first index.
    pub rows: usize,
    /// Length along the second index.
    pub columns: usize,
    pub(super) number_type: NumberType,
    pub(super) big_endian: bool,
    fortran_order: bool,
    /// Bytes before the first number.
    pub(super) data_start: u64,
}

impl Header {
    /// Reads the header of a file.
    ///
    /// # Errors
    /// See [`NpyError`].
    pub fn read(path: &Path) -> Result<Self, NpyError> {
        let length = std::fs::metadata(path)?.len();
        Self::parse(File::open(path)?, length)
    }

    /// Reads the header of a file of `length` bytes.
    ///
    /// # Errors
    /// See [`NpyError`].
    pub fn parse(mut file: impl Read, length: u64) -> Result<Self, NpyError> {
        let begin = Beginning::read(&mut file, length)?;
        let mut text = Vec::new();
        file.take(begin.text_length).read_to_end(&mut text)?;
        let text = std::str::from_utf8(&text).map_err(|_| HeaderError::Encoding)?;
        let entries = entries(text).ok_or(HeaderError::Syntax)?;
        let entry = |key: &'static str| {
            let found = entries.iter().find(|(name, _)| *name == key).map(|(_, value)| *value);
            found.ok_or(HeaderError::Missing(key))
        };
        let wrong = |entry, allowed| HeaderError::Entry { entry, allowed };
        let (number_type, big_endian) = number_type(entry("descr")?)?;
        let fortran_order = match entry("fortran_order")? {
            "True" => true,
            "False" => false,
            _ => return Err(wrong("fortran_order", "True or False").into()),
        };
        let shape = lengths(entry("shape")?).ok_or(wrong("shape", "a tuple of whole numbers"))?;
        let data_start = begin.text_start + begin.text_length;
        let [rows, columns] = checked_shape(shape, number_type, length.saturating_sub(data_start))?;
        Ok(Self { rows, columns, number_type, big_endian, fortran_order, data_start })
    }

    /// Whether the array is in Fortran order: the first index runs fastest.
    pub fn is_fortran(&self) -> bool {
        self.fortran_order
    }

    /// Relative precision of the stored numbers; 0 for integers.
    pub fn precision(&self) -> f64 {
        self.number_type.precision()
    }
}

/// The fixed part before the text of a header.
struct Beginning {
    text_start: u64,
    text_length: u64,
}

impl Beginning {
    fn read(file: &mut impl Read, length: u64) -> Result<Self, NpyError> {
        if length == 0 {
            return Err(NpyError::Empty);
        }
        let mut bytes = Vec::new();
        file.take(10).read_to_end(&mut bytes)?;
        if !bytes.starts_with(MAGIC) {
            return Err(NpyError::NotNpy);
        }
        let Ok([.., major, minor, low, high]) = <[u8; 10]>::try_from(bytes) else {
            return Err(NpyError::TruncatedHeader);
        };
        let (text_start, text_length) = match (major, minor) {
            (1, 0) => (10, u64::from(u16::from_le_bytes([low, high]))),
            (2 | 3, 0) => {
                let mut rest = [0; 2];
                file.read_exact(&mut rest).map_err(|_| NpyError::TruncatedHeader)?;
                (12, u64::from(u32::from_le_bytes([low, high, rest[0], rest[1]])))
            }
            _ => return Err(HeaderError::Version(major, minor).into()),
        };
        if text_start + text_length > length {
            return Err(NpyError::TruncatedHeader);
        }
        if text_length > MAX_HEADER_BYTES {
            return Err(HeaderError::TooLong(text_length).into());
        }
        Ok(Self { text_start, text_length })
    }
}

/// The type of the numbers, and whether they are big-endian.
fn number_type(descr: &str) -> Result<(NumberType, bool), NpyError> {
    use NumberType::{F32, F64, I8, I16, I32, I64, U8, U16, U32, U64};
    let name = unquoted(descr).ok_or_else(|| NpyError::NumberType("of records".to_owned()))?;
    let number_type = match name.trim_start_matches(['<', '>', '|']) {
        "u1" => U8,
        "u2" => U16,
        "u4" => U32,
        "u8" => U64,
        "i1" => I8,
        "i2" => I16,
        "i4" => I32,
        "i8" => I64,
        "f4" => F32,
        "f8" => F64,
        _ => return Err(NpyError::NumberType(format!("'{name}'"))),
    };
    let has_one_byte = number_type.bytes() == 1;
    match name.as_bytes() {
        [b'<', _, _] => Ok((number_type, false)),
        [b'>', _, _] => Ok((number_type, true)),
        [b'|', _, _] if has_one_byte => Ok((number_type, false)),
        _ => Err(NpyError::NumberType(format!("'{name}'"))),
    }
}

/// The keys of a Python dictionary with the texts of their values; `None` of another text.
fn entries(text: &str) -> Option<Vec<(&str, &str)>> {
    let inner = text.trim().strip_prefix('{')?.strip_suffix('}')?;
    let entries = parts(inner, ',')?.into_iter().filter(|entry| !entry.is_empty());
    let pair = |entry| match parts(entry, ':')?[..] {
        [key, value] => Some((unquoted(key)?, value)),
        _ => None,
    };
    entries.map(pair).collect()
}

/// The parts of a text between separators that are in no string and no bracket; `None` where one of these does not end.
fn parts(text: &str, separator: char) -> Option<Vec<&str>> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0_usize);
    let (mut quote, mut is_escaped) = (None, false);
    for (at, character) in text.char_indices() {
        match quote {
            Some(_) if is_escaped => is_escaped = false,
            Some(end) if character == end => quote = None,
            Some(_) => is_escaped = character == '\\',
            None if "'\"".contains(character) => quote = Some(character),
            None if "([{".contains(character) => depth += 1,
            None if ")]}".contains(character) => depth = depth.checked_sub(1)?,
            None if character == separator && depth == 0 => {
                parts.push(text[start..at].trim());
                start = at + separator.len_utf8();
            }
            None => {}
        }
    }
    parts.push(text[start..].trim());
    (depth == 0 && quote.is_none()).then_some(parts)
}

/// The text of a Python string.
fn unquoted(text: &str) -> Option<&str> {
    ['\'', '"'].into_iter().find_map(|quote| text.strip_prefix(quote)?.strip_suffix(quote))
}

/// The lengths in a tuple, which has a comma, or in a list.
fn lengths(shape: &str) -> Option<Vec<u64>> {
    let tuple = shape.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    let inner = tuple.or_else(|| shape.strip_prefix('[')?.strip_suffix(']'))?;
    let mut lengths: Vec<&str> = inner.split(',').map(str::trim).collect();
    let is_closed = lengths.pop_if(|last| last.is_empty()).is_some();
    let is_sequence = tuple.is_none() || is_closed || lengths.len() > 1;
    lengths.into_iter().map(|length| length.parse().ok()).collect::<Option<_>>().filter(|_| is_sequence)
}

/// Rows and columns of an array whose numbers are in `found` bytes.
fn checked_shape(shape: Vec<u64>, number_type: NumberType, found: u64) -> Result<[usize; 2], NpyError> {
    let &[rows, columns] = &shape[..] else { return Err(NpyError::Dimensions(shape)) };
    let bytes = rows.checked_mul(columns).and_then(|count| count.checked_mul(number_type.bytes()));
    let bytes = bytes.ok_or(NpyError::TooLarge)?;
    if found < bytes {
        return Err(NpyError::Truncated { rows, columns, bytes, found });
    }
    if found > bytes {
        return Err(NpyError::Trailing { rows, columns, extra: found - bytes });
    }
    let size = |length: u64| usize::try_from(length).map_err(|_| NpyError::TooLarge);
    Ok([size(rows)?, size(columns)?])
}

/// The header, from the first byte of the file, of an array of float64 in C order.
pub(super) fn of_float64([rows, columns]: [usize; 2]) -> Vec<u8> {
    /// NumPy's alignment of the data.
    const ALIGNMENT: usize = 64;
    let mut text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let start = MAGIC.len() + 4;
    let length = (start + text.len() + 1).next_multiple_of(ALIGNMENT) - start;
    text.extend(std::iter::repeat_n(' ', length - text.len() - 1));
    text.push('\n');
    // At most 128 bytes.
    let length = (length as u16).to_le_bytes();
    [MAGIC, &[1, 0][..], &length, text.as_bytes()].concat()
}
