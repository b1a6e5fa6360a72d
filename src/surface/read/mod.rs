//! Reading measured surfaces: one file a format.

pub mod npy;

use std::path::Path;

use super::{HeightMap, MapError};

/// Why a file gives no heights. The caller says which file.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The file is of another format.
    #[error("{0}")]
    Mismatch(String),
    /// The format is known, what the file holds is not supported.
    #[error("{0}")]
    Unsupported(String),
    /// The file does not hold what it says it holds.
    #[error("{0}")]
    Corrupt(String),
    /// The heights make no map.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// A table of numbers as a file holds it.
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

/// The size of a map, from the head of its file; nothing else is read.
///
/// # Errors
/// As [`height_map`], as far as the head and the length of the file tell.
pub fn points(path: &Path) -> Result<[usize; 2], ReadError> {
    let head = npy::Head::read(path)?;
    Ok([head.rows, head.columns])
}

/// Reads a map of heights in metres; its pixel is `pixel` (m, along x and y).
///
/// # Errors
/// See [`ReadError`].
pub fn height_map(path: &Path, pixel: [f64; 2]) -> Result<HeightMap, ReadError> {
    let Matrix { rows, columns, values, precision } = npy::matrix(path)?;
    Ok(HeightMap::new([rows, columns], pixel, values, precision)?)
}

/// A file that is there and not empty, or why not.
///
/// # Errors
/// A path that is no file, or an empty one.
pub fn existing(path: &Path) -> Result<(), ReadError> {
    let metadata = std::fs::metadata(path)?;
    if !metadata.is_file() {
        return Err(ReadError::Mismatch("is no file".to_owned()));
    }
    if metadata.len() == 0 {
        return Err(ReadError::Corrupt("is empty".to_owned()));
    }
    Ok(())
}
