//! NumPy's `.npy` as a height map. The first index is x.

use std::path::Path;

use super::content::{Measured, Metadata};
use super::error::ReadError;
use super::marks::mark_missing;
use super::{Format, Reader};
use crate::npy::{Header, MAGIC, Mapped, Matrix, matrix};
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
pub(super) fn metadata(path: &Path) -> Result<Metadata, ReadError> {
    let Header { rows, columns, .. } = Header::read(path)?;
    Ok(Metadata::new([rows, columns], NAME))
}

/// Reads a map, in the unit of the file.
pub(super) fn measured(path: &Path) -> Result<Measured, ReadError> {
    let Matrix { rows, columns, values, precision } = matrix(path)?;
    let metadata = Metadata::new([rows, columns], NAME);
    Ok(Measured { metadata, heights: values, scale: 1.0, offset: 0.0, precision })
}

/// A mapped array as a height map.
#[derive(Debug)]
pub(super) struct MappedMap {
    /// The array.
    pub(super) array: Mapped,
    /// Distance of neighbouring points along x and y, m.
    pub(super) pixel: [f64; 2],
    /// Unit of the stored heights, m.
    pub(super) unit: f64,
    /// Heights that mark missing points, in that unit.
    pub(super) missing: Vec<f64>,
}

impl Rows for MappedMap {
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

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.array.row(ix, row);
        mark_missing(row, &self.missing);
        if self.unit != 1.0 {
            row.iter_mut().for_each(|z| *z *= self.unit);
        }
    }
}
