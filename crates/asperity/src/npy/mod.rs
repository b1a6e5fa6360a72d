//! NumPy's `.npy`: two-dimensional arrays of real numbers in either byte order and either memory order
//! (numpy.lib.format, versions 1.0 to 3.0).
//!
//! | function | what it does |
//! |---|---|
//! | [`matrix`] | reads an entire array |
//! | [`OnDisk`] | reads rows or columns of an array that stays in its file |
//! | [`write()`] | writes an array of float64 |

mod error;
mod header;
mod on_disk;

use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use crate::memory::zeros;
use crate::progress::{Count, Progress, Silent};
pub use error::{HeaderError, NpyError};
pub use header::Header;
pub(crate) use header::MAGIC;
pub use on_disk::OnDisk;

/// A two-dimensional array.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    /// Length along the first index.
    pub rows: usize,
    /// Length along the second index.
    pub columns: usize,
    /// Values, the second index running fastest.
    pub values: Vec<f64>,
    /// Relative precision of the stored numbers; 0 for integers.
    pub precision: f64,
}

/// Whether a file begins with the magic bytes of `.npy`.
///
/// # Errors
/// A file that cannot be read.
pub fn is_npy(path: &Path) -> io::Result<bool> {
    let mut begin = Vec::new();
    File::open(path)?.take(MAGIC.len() as u64).read_to_end(&mut begin)?;
    Ok(begin == MAGIC)
}

/// Reads a two-dimensional array.
///
/// # Errors
/// See [`NpyError`]; a truncated file is rejected before memory is allocated.
pub fn matrix(path: &Path) -> Result<Matrix, NpyError> {
    Matrix::read(File::open(path)?, std::fs::metadata(path)?.len(), &Silent)
}

impl Matrix {
    /// Reads the array of a file of `length` bytes: one unit of work.
    pub(crate) fn read(
        mut file: impl Read + Seek,
        length: u64,
        progress: &dyn Progress,
    ) -> Result<Self, NpyError> {
        let header = Header::parse(&mut file, length)?;
        file.seek(SeekFrom::Start(header.data_start))?;
        let Header { rows, columns, .. } = header;
        let count = |work: f64| Count::new(progress, work, rows * columns);
        let (read, mut sorted) = if header.is_fortran() { (0.5, count(0.5)) } else { (1.0, count(0.0)) };
        let stored = stored_values(file, &header, count(read)).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof => NpyError::Shortened,
            _ => NpyError::Io(error),
        })?;
        let mut values = stored;
        if header.is_fortran() {
            let stored = std::mem::take(&mut values);
            values.reserve_exact(stored.len());
            for row in 0..rows {
                values.extend(stored.iter().skip(row).step_by(rows));
                sorted.add(columns);
            }
        }
        sorted.end();
        Ok(Self { rows, columns, values, precision: header.precision() })
    }
}

/// The numbers of an array in file order, counted; the header has been checked against the file length.
fn stored_values(mut file: impl Read, header: &Header, mut count: Count) -> io::Result<Vec<f64>> {
    /// Numbers read at a time.
    const NUMBERS: usize = 1 << 16;
    let size = header.number_type.bytes() as usize;
    let mut values = zeros(header.rows * header.columns);
    let mut bytes = vec![0; size * NUMBERS.min(values.len())];
    for values in values.chunks_mut(NUMBERS) {
        let bytes = &mut bytes[..size * values.len()];
        file.read_exact(bytes)?;
        header.number_type.decode(bytes, header.big_endian, values);
        count.add(values.len());
    }
    count.end();
    Ok(values)
}

/// Writes a two-dimensional array of float64 of the shape `[rows, columns]`, version 1.0, little-endian; the second
/// index of `values` runs fastest.
///
/// # Errors
/// A file that cannot be written; a number of values that does not match the shape ([`io::ErrorKind::InvalidInput`]).
pub fn write(
    out: impl Write,
    [rows, columns]: [usize; 2],
    values: impl IntoIterator<Item = f64>,
) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    out.write_all(&header::of_float64([rows, columns]))?;
    let mut count = 0usize;
    for value in values {
        out.write_all(&value.to_le_bytes())?;
        count += 1;
    }
    if rows.checked_mul(columns) != Some(count) {
        let message = format!("{count} values for an array of {rows} x {columns}");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    out.flush()
}
