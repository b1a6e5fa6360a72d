//! Rows and columns of a `.npy` array that is too large to be read as a whole, taken from a memory map.
//!
//! Mapping is unsafe: the compiler cannot know that no other process cuts the file while it is mapped.
//! Here the bytes are only ever copied out and any bytes make a number, so that another process that
//! writes can change heights but break no rule of the language; one that cuts the file ends this
//! program with a bus error, as any reader of a map.

use std::fs::File;
use std::ops::Range;
use std::path::Path;

use memmap2::Mmap;

use super::error::NpyError;
use super::header::Header;
use crate::numeric::LARGEST;

/// A two-dimensional array, opened once; its rows may be taken from any thread.
#[derive(Debug)]
pub struct Mapped {
    header: Header,
    begin: usize,
    map: Mmap,
}

impl Mapped {
    /// Opens a `.npy` file, to take its rows.
    ///
    /// # Errors
    /// See [`NpyError`]; an array in Fortran order is unsupported, its rows being scattered.
    pub fn open(path: &Path) -> Result<Self, NpyError> {
        let array = Self::in_either_order(path)?;
        if array.header.is_fortran() { Err(NpyError::FortranOrder) } else { Ok(array) }
    }

    /// Opens a `.npy` file in C or Fortran order, to take its columns.
    ///
    /// # Errors
    /// See [`NpyError`].
    pub fn in_either_order(path: &Path) -> Result<Self, NpyError> {
        let header = Header::read(path)?;
        let file = File::open(path)?;
        // SAFETY: the map is read only and private to this value, see the head of this module.
        #[allow(unsafe_code)]
        let map = unsafe { Mmap::map(&file) }?;
        // The file may have been changed since its head was read.
        let begin = usize::try_from(header.data_start).unwrap_or(usize::MAX);
        let count = header.rows.checked_mul(header.columns);
        let length = count.and_then(|count| count.checked_mul(header.number_type.bytes() as usize));
        if length.and_then(|length| begin.checked_add(length)).is_none_or(|end| end > map.len()) {
            return Err(NpyError::Shortened);
        }
        Ok(Self { header, begin, map })
    }

    /// Points along x, which is the first index, and y.
    pub fn points(&self) -> [usize; 2] {
        [self.header.rows, self.header.columns]
    }

    /// Relative precision of the stored numbers; 0 for integers.
    pub fn precision(&self) -> f64 {
        self.header.precision()
    }

    /// Copies the heights at the index `ix` along x to `out`, in the unit of the file. Missing points,
    /// and what is too large to be a height, are NaN.
    ///
    /// # Panics
    /// If `ix` is no row, or `out` has another length than the points along y.
    pub fn row(&self, ix: usize, out: &mut [f64]) {
        let [rows, columns] = self.points();
        assert!(ix < rows && out.len() == columns, "row {ix} of {rows}, {} of {columns} points", out.len());
        self.decode(ix * columns..(ix + 1) * columns, out);
        for z in out.iter_mut().filter(|z| z.abs() > LARGEST) {
            *z = f64::NAN;
        }
    }

    /// Copies a piece of each of the first columns to `out`, from the row `first` on, as they are in the file.
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
        // All are there, since the file was opened.
        let bytes = &self.map[self.begin + places.start * size..self.begin + places.end * size];
        self.header.number_type.decode(bytes, self.header.big_endian, out);
    }
}
