//! Rows and columns of a `.npy` array that stays in its file, which may be larger than memory.
//!
//! They are read, not mapped into memory: a file that another program writes anew or shortens meanwhile gives an error, where
//! access to a map would end the process.

use std::fs::File;
use std::io::{self, ErrorKind};
use std::path::Path;

use bytemuck::cast_slice_mut;

use super::error::NpyError;
use super::header::Header;
use crate::numeric::LARGEST;
use crate::numeric::stored::NumberType;

/// A two-dimensional array in its file; rows may be read from any thread.
#[derive(Debug)]
pub struct OnDisk {
    header: Header,
    file: File,
}

impl OnDisk {
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
        let mut file = File::open(path)?;
        let length = file.metadata()?.len();
        Ok(Self { header: Header::parse(&mut file, length)?, file })
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
    /// # Errors
    /// A file that cannot be read any more, or is shorter than when it was opened.
    ///
    /// # Panics
    /// If `ix` is out of range, or the length of `out` is not the number of points along y.
    pub fn row(&self, ix: usize, out: &mut [f64]) -> Result<(), NpyError> {
        let [rows, columns] = self.points();
        assert!(ix < rows && out.len() == columns, "row {ix} of {rows}, {} of {columns} points", out.len());
        self.decode(ix * columns, out)?;
        // Every value is stored, so that none needs a branch.
        out.iter_mut().for_each(|z| *z = if z.abs() > LARGEST { f64::NAN } else { *z });
        Ok(())
    }

    /// Copies a range of rows, from `first` on, of the first columns to `out`, one slice per column.
    ///
    /// # Errors
    /// As of [`Self::row`].
    ///
    /// # Panics
    /// If there are fewer rows or columns.
    pub fn columns(&self, first: usize, out: &mut [&mut [f64]]) -> Result<(), NpyError> {
        let [rows, columns] = self.points();
        let count = out.first().map_or(0, |piece| piece.len());
        assert!(first + count <= rows && out.len() <= columns, "{count} rows from {first} of {rows}");
        if self.header.is_fortran() {
            for (column, piece) in out.iter_mut().enumerate() {
                self.decode(column * rows + first, piece)?;
            }
        } else {
            let mut values = vec![0.0; count * columns];
            self.decode(first * columns, &mut values)?;
            for (row, values) in values.chunks_exact(columns).enumerate() {
                out.iter_mut().zip(values).for_each(|(piece, value)| piece[row] = *value);
            }
        }
        Ok(())
    }

    /// Reads the numbers from the place `first` on.
    fn decode(&self, first: usize, out: &mut [f64]) -> Result<(), NpyError> {
        /// Read at a time.
        const BYTES: usize = 1 << 15;
        let Header { number_type, big_endian, .. } = self.header;
        let size = number_type.bytes() as usize;
        if matches!(number_type, NumberType::F64) && big_endian == cfg!(target_endian = "big") {
            // The bytes are the numbers.
            return self.read(first, cast_slice_mut(out));
        }
        let mut bytes = [0; BYTES];
        for (k, out) in out.chunks_mut(BYTES / size).enumerate() {
            let bytes = &mut bytes[..out.len() * size];
            self.read(first + k * (BYTES / size), bytes)?;
            number_type.decode(bytes, big_endian, out);
        }
        Ok(())
    }

    /// Reads the bytes of the numbers from the place `first` on.
    fn read(&self, first: usize, bytes: &mut [u8]) -> Result<(), NpyError> {
        let start = self.header.data_start + first as u64 * self.header.number_type.bytes();
        read_exact_at(&self.file, bytes, start).map_err(|error| match error.kind() {
            ErrorKind::UnexpectedEof => NpyError::Shortened,
            _ => NpyError::Io(error),
        })
    }
}

/// Reads bytes of a file that other threads read too.
#[cfg(unix)]
fn read_exact_at(file: &File, bytes: &mut [u8], start: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, bytes, start)
}

#[cfg(windows)]
fn read_exact_at(file: &File, mut bytes: &mut [u8], mut start: u64) -> io::Result<()> {
    while !bytes.is_empty() {
        match std::os::windows::fs::FileExt::seek_read(file, bytes, start) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => {
                bytes = &mut bytes[count..];
                start += count as u64;
            }
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
