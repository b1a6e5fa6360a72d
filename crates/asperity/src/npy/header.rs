//! The header of a `.npy` file.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::error::{HeaderError, MAX_HEADER_BYTES, NpyError};
use super::literal::Literal;
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
        let entries = Literal::dictionary(text).map_err(HeaderError::Syntax)?;
        let entry = |key: &'static str| {
            let found = entries.iter().find(|(name, _)| name == key).map(|(_, value)| value);
            found.ok_or(HeaderError::Missing(key))
        };
        let (number_type, big_endian) = number_type(entry("descr")?)?;
        let Literal::Bool(fortran_order) = *entry("fortran_order")? else {
            return Err(HeaderError::Entry { entry: "fortran_order", allowed: "True or False" }.into());
        };
        let shape = shape(entry("shape")?)?;
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
fn number_type(descr: &Literal) -> Result<(NumberType, bool), NpyError> {
    use NumberType::{F32, F64, I8, I16, I32, I64, U8, U16, U32, U64};
    let Literal::Text(name) = descr else {
        return Err(NpyError::NumberType("of records".to_owned()));
    };
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

fn shape(shape: &Literal) -> Result<Vec<u64>, HeaderError> {
    let fault = HeaderError::Entry { entry: "shape", allowed: "a tuple of whole numbers" };
    let Literal::Sequence(lengths) = shape else { return Err(fault) };
    let length = |length: &Literal| if let Literal::Integer(length) = length { *length } else { None };
    lengths.iter().map(length).collect::<Option<_>>().ok_or(fault)
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
