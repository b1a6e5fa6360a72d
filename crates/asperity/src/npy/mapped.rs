//! Rows and columns of a memory-mapped `.npy` array, which may be larger than memory.
//!
//! Mapping is unsafe because another process may change or truncate the file. Here bytes are only copied out, and every
//! bit pattern is a valid number: concurrent writes can change values but cause no undefined behaviour; truncation ends
//! the program with a bus error, as for any memory map.

use std::fs::File;
use std::ops::Range;
use std::path::Path;

use memmap2::Mmap;

use super::error::NpyError;
use super::header::Header;
use crate::numeric::LARGEST;

/// A memory-mapped two-dimensional array; rows may be read from any thread.
#[derive(Debug)]
pub struct Mapped {
    header: Header,
    begin: usize,
    map: Mmap,
}

impl Mapped {
    /// Opens a `.npy` file in C order, to read rows.
    ///
    /// # Errors
    /// See [`NpyError`]; Fortran order is not supported.
    pub fn open(path: &Path) -> Result<Self, NpyError> {
        let array = Self::in_either_order(path)?;
        if array.header.is_fortran() { Err(NpyError::FortranOrder) } else { Ok(array) }
    }

    /// Opens a `.npy` file in C or Fortran order, to read columns.
    ///
    /// # Errors
    /// See [`NpyError`].
    pub fn in_either_order(path: &Path) -> Result<Self, NpyError> {
        let header = Header::read(path)?;
        let file = File::open(path)?;
        // SAFETY: the map is read only and private to this value, see the head of this module.
        #[allow(unsafe_code)]
        let map = unsafe { Mmap::map(&file) }?;
        // The file may have changed since its header was read.
        let begin = usize::try_from(header.data_start).unwrap_or(usize::MAX);
        let count = header.rows.checked_mul(header.columns);
        let length = count.and_then(|count| count.checked_mul(header.number_type.bytes() as usize));
        if length.and_then(|length| begin.checked_add(length)).is_none_or(|end| end > map.len()) {
            return Err(NpyError::Shortened);
        }
        Ok(Self { header, begin, map })
    }

    /// Lengths along the first index (x of a map) and the second (y).
    pub fn points(&self) -> [usize; 2] {
        [self.header.rows, self.header.columns]
    }

    /// Relative precision of the stored numbers; 0 for integers.
    pub fn precision(&self) -> f64 {
        self.header.precision()
    }

    /// Copies the heights at the index `ix` along x to `out`, in the unit of the file. Missing points and values too
    /// large to be a height are NaN.
    ///
    /// # Panics
    /// If `ix` is out of range, or the length of `out` is not the number of points along y.
    pub fn row(&self, ix: usize, out: &mut [f64]) {
        let [rows, columns] = self.points();
        assert!(ix < rows && out.len() == columns, "row {ix} of {rows}, {} of {columns} points", out.len());
        self.decode(ix * columns..(ix + 1) * columns, out);
        for z in out.iter_mut().filter(|z| z.abs() > LARGEST) {
            *z = f64::NAN;
        }
    }

    /// Copies a range of rows, from `first` on, of the first columns to `out`, one slice per column.
    ///
    /// # Panics
    /// If there are fewer rows or columns.
    pub fn columns(&self, first: usize, out: &mut [&mut [f64]]) {
        let [rows, columns] = self.points();
        let count = out.first().map_or(0, |piece| piece.len());
        assert!(first + count <= rows && out.len() <= columns, "{count} rows from {first} of {rows}");
        if self.header.is_fortran() {
            for (column, piece) in out.iter_mut().enumerate() {
                self.decode(column * rows + first..column * rows + first + count, piece);
            }
        } else {
            let mut values = vec![0.0; count * columns];
            self.decode(first * columns..(first + count) * columns, &mut values);
            for (row, values) in values.chunks_exact(columns).enumerate() {
                out.iter_mut().zip(values).for_each(|(piece, value)| piece[row] = *value);
            }
        }
    }

    /// Copies the numbers at `places` in the file.
    fn decode(&self, places: Range<usize>, out: &mut [f64]) {
        let size = self.header.number_type.bytes() as usize;
        // The length was checked when the file was opened.
        let bytes = &self.map[self.begin + places.start * size..self.begin + places.end * size];
        self.header.number_type.decode(bytes, self.header.big_endian, out);
    }
}
