//! NumPy's `.npy`: two-dimensional arrays of real numbers in either byte order and either memory
//! order (format: numpy.lib.format, versions 1 to 3). The first index is x.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use npyz::{DType, Deserialize, NpyFile, Order, TypeChar};

pub use super::mapped::Mapped;
use super::stored::{Stored, with_type};
use super::{Matrix, Measured, ReadError, too_large};

/// How a `.npy` file begins.
pub(super) const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// What the head of a file says, checked against the file's length.
pub struct Head {
    /// Length along the first index.
    pub rows: usize,
    /// Length along the second index.
    pub columns: usize,
    pub(super) stored: Stored,
    pub(super) order: Order,
    pub(super) big_endian: bool,
    /// Bytes before the first number.
    pub(super) head_length: u64,
    file: NpyFile<BufReader<File>>,
}

/// Whether a file begins as a `.npy` does.
///
/// # Errors
/// A file that cannot be read.
pub fn is_npy(path: &Path) -> std::io::Result<bool> {
    let mut begin = Vec::new();
    File::open(path)?.take(MAGIC.len() as u64).read_to_end(&mut begin)?;
    Ok(begin == MAGIC)
}

/// Reads a two-dimensional array.
///
/// # Errors
/// See [`ReadError`]; a file that is shorter than its head says is refused before anything is
/// allocated.
pub fn matrix(path: &Path) -> Result<Matrix, ReadError> {
    let Head { rows, columns, stored, order, file, .. } = Head::read(path)?;
    let stored_values = with_type!(stored, T => values(file, |value: T| value as f64))?;
    let values = match order {
        Order::C => stored_values,
        Order::Fortran => {
            (0..rows * columns).map(|k| stored_values[k / columns + (k % columns) * rows]).collect()
        }
    };
    Ok(Matrix { rows, columns, values, precision: stored.precision() })
}

/// Reads a map, in the unit of the file.
///
/// # Errors
/// See [`matrix`].
pub(super) fn measured(path: &Path) -> Result<Measured, ReadError> {
    let head = Head::read(path)?.map();
    let Matrix { values, precision, .. } = matrix(path)?;
    Ok(Measured { head, heights: values, precision })
}

fn values<T: Deserialize>(
    file: NpyFile<BufReader<File>>,
    convert: impl Fn(T) -> f64,
) -> Result<Vec<f64>, ReadError> {
    let count = usize::try_from(file.len()).map_err(|_| too_large())?;
    let mut values = Vec::with_capacity(count);
    let stored = file.data::<T>().map_err(|error| ReadError::Unsupported(error.to_string()))?;
    for value in stored {
        values.push(convert(value?));
    }
    Ok(values)
}

impl Head {
    /// Reads the head of a file.
    ///
    /// # Errors
    /// See [`ReadError`].
    pub fn read(path: &Path) -> Result<Self, ReadError> {
        let length = std::fs::metadata(path)?.len();
        if length == 0 {
            return Err(ReadError::Corrupt("is empty".to_owned()));
        }
        if !is_npy(path)? {
            return Err(ReadError::Mismatch("is no .npy file: it does not begin with \\x93NUMPY".to_owned()));
        }
        let head_length = check_head(path, length)?;
        let file = NpyFile::new(BufReader::new(File::open(path)?))
            .map_err(|error| ReadError::Corrupt(format!("has a head that is no .npy head: {error}")))?;
        let stored = stored(&file.dtype())?;
        let &[rows, columns] = file.shape() else {
            let shape: Vec<String> = file.shape().iter().map(u64::to_string).collect();
            return Err(ReadError::Unsupported(format!(
                "holds an array of shape ({}); allowed: two dimensions",
                shape.join(", ")
            )));
        };
        let bytes = rows.checked_mul(columns).and_then(|count| count.checked_mul(stored.bytes()));
        let bytes = bytes.ok_or_else(too_large)?;
        if length - head_length < bytes {
            return Err(ReadError::Corrupt(format!(
                "is truncated: its head says {rows} x {columns} numbers in {bytes} bytes, {} bytes are there",
                length - head_length
            )));
        }
        let size = |length: u64| usize::try_from(length).map_err(|_| too_large());
        let (rows, columns) = (size(rows)?, size(columns)?);
        let big_endian = file.dtype().descr().contains('>');
        Ok(Self { rows, columns, stored, order: file.order(), big_endian, head_length, file })
    }

    /// What it says of a map.
    pub(super) fn map(&self) -> super::Head {
        super::Head { points: [self.rows, self.columns], pixel: None, has_unit: false, format: ".npy" }
    }
}

/// Looks at the head before npyz does, which allocates what the head claims as its length and
/// multiplies the shape without a check. Gives the length of the head, bytes.
fn check_head(path: &Path, length: u64) -> Result<u64, ReadError> {
    let truncated = || ReadError::Corrupt("is truncated: it ends within its head".to_owned());
    let mut file = BufReader::new(File::open(path)?);
    let mut begin = [0; 12];
    file.read_exact(&mut begin[..10]).map_err(|_| truncated())?;
    let head_length = if begin[6] == 1 {
        10 + u64::from(u16::from_le_bytes([begin[8], begin[9]]))
    } else {
        file.read_exact(&mut begin[10..]).map_err(|_| truncated())?;
        12 + u64::from(u32::from_le_bytes([begin[8], begin[9], begin[10], begin[11]]))
    };
    if head_length > length {
        return Err(truncated());
    }
    let mut head = Vec::new();
    let begin_length = if begin[6] == 1 { 10 } else { 12 };
    file.take(head_length - begin_length).read_to_end(&mut head)?;
    let head = String::from_utf8_lossy(&head);
    let shape =
        head.split("'shape'").nth(1).and_then(|rest| rest.split(['(', ')']).nth(1)).unwrap_or_default();
    let lengths = shape.split(',').filter_map(|length| length.trim().parse::<u64>().ok());
    lengths.map(|length| length.max(1)).try_fold(1, u64::checked_mul).ok_or_else(too_large)?;
    Ok(head_length)
}

fn stored(dtype: &DType) -> Result<Stored, ReadError> {
    let unsupported = || {
        ReadError::Unsupported(format!(
            "holds numbers of type {}; allowed: float32, float64 and integers",
            dtype.descr()
        ))
    };
    let DType::Plain(kind) = dtype else { return Err(unsupported()) };
    use Stored::{F32, F64, I8, I16, I32, I64, U8, U16, U32, U64};
    let all: &[Stored] = match kind.type_char() {
        TypeChar::Float => &[F32, F64],
        TypeChar::Int => &[I8, I16, I32, I64],
        TypeChar::Uint => &[U8, U16, U32, U64],
        _ => return Err(unsupported()),
    };
    all.iter().copied().find(|stored| stored.bytes() == kind.size_field()).ok_or_else(unsupported)
}
