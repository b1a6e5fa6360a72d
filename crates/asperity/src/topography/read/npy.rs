//! NumPy's `.npy` as a height map. The first index is x.

use std::sync::atomic::{AtomicBool, Ordering};

use super::content::{Measured, Metadata};
use super::error::ReadError;
use super::marks::mark_missing;
use super::source::Source;
use super::{Format, Reader};
use crate::npy::{Header, MAGIC, Matrix, OnDisk};
use crate::topography::{Boundary, Rows};

/// The name of the format.
pub(super) const NAME: &str = ".npy";

pub(super) const FORMAT: Format = Format {
    name: NAME,
    endings: &["npy"],
    is: |source| source.begin().starts_with(MAGIC),
    read: Reader::Map { metadata, measured },
};

/// Size and format of a map from its header.
pub(super) fn metadata(source: &Source) -> Result<Metadata, ReadError> {
    let Header { rows, columns, .. } = Header::parse(source.reader()?, source.length())?;
    Ok(Metadata::new([rows, columns], NAME))
}

/// Reads a map, in the unit of the file.
pub(super) fn measured(source: &Source) -> Result<Measured, ReadError> {
    let Matrix { rows, columns, values, precision } =
        Matrix::read(source.reader()?, source.length(), source.progress())?;
    let metadata = Metadata::new([rows, columns], NAME);
    Ok(Measured { metadata, heights: values, scale: 1.0, offset: 0.0, precision })
}

/// An array in its file as a height map.
#[derive(Debug)]
pub(super) struct MapOnDisk {
    array: OnDisk,
    pixel: [f64; 2],
    unit: f64,
    missing: Vec<f64>,
    /// Whether a row could not be read.
    has_failed: AtomicBool,
}

impl MapOnDisk {
    /// A map of this `pixel` (m), whose heights in `unit` (m) are missing where they are one of the marks in `missing`.
    pub(super) fn new(array: OnDisk, pixel: [f64; 2], unit: f64, missing: Vec<f64>) -> Self {
        Self { array, pixel, unit, missing, has_failed: AtomicBool::new(false) }
    }
}

impl Rows for MapOnDisk {
    fn points(&self) -> [usize; 2] {
        self.array.points()
    }

    fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    fn precision(&self) -> f64 {
        let precision = self.array.precision();
        if self.unit == 1.0 { precision } else { precision.max(f64::EPSILON) }
    }

    fn boundary(&self) -> Boundary {
        Boundary::Open
    }

    fn is_whole(&self) -> bool {
        !self.has_failed.load(Ordering::Relaxed)
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        if self.array.row(ix, row).is_err() {
            row.fill(f64::NAN);
            self.has_failed.store(true, Ordering::Relaxed);
        }
        mark_missing(row, &self.missing);
        if self.unit != 1.0 {
            row.iter_mut().for_each(|z| *z *= self.unit);
        }
    }
}
