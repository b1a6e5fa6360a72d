//! Reading a list of asperities: CSV with the columns `height` and `radius`, or an n x 2 `.npy`.

use std::path::Path;

use crate::numeric::{LARGEST, is_positive};
use crate::surface::read::{self, ReadError, npy};

/// Why a file gives no list of asperities.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// The file could not be read, or its array is not a table of numbers.
    #[error(transparent)]
    File(#[from] ReadError),
    /// The `.npy` array has other columns than height and radius.
    #[error("an array of shape {rows} x {columns}; allowed: n x 2, with the columns height and radius in m")]
    Shape {
        /// Rows found.
        rows: usize,
        /// Columns found.
        columns: usize,
    },
    /// A column is not there.
    #[error(
        "no column `{column}` (found: {found}); allowed: a header line with the columns height and radius, in m"
    )]
    Column {
        /// The column that is missing.
        column: &'static str,
        /// The header that was found.
        found: String,
    },
    /// A line is not CSV.
    #[error("{0}")]
    Csv(#[from] csv::Error),
    /// A cell holds no number that is allowed there.
    #[error("{place}, column `{column}`: found {found}; allowed: {allowed}")]
    Cell {
        /// The row, as its reader finds it.
        place: String,
        /// The column.
        column: &'static str,
        /// What stands there.
        found: String,
        /// What may stand there.
        allowed: &'static str,
    },
    /// The list has no row.
    #[error("no asperity: the list has no rows")]
    Empty,
}

const HEIGHT: &str = "a finite number of metres";
const RADIUS: &str = "a positive finite number of metres";

/// Reads heights and radii, m, from a CSV file or an n x 2 `.npy`, told apart by their first bytes.
/// Lines of a CSV that begin with `#` are comments; further columns are passed over.
///
/// # Errors
/// See [`ListError`]; a bad value is named with its row.
pub fn read_list(path: &Path) -> Result<(Vec<f64>, Vec<f64>), ListError> {
    let (heights, radii) =
        if npy::is_npy(path).map_err(ReadError::from)? { read_npy(path)? } else { read_csv(path)? };
    if heights.is_empty() {
        return Err(ListError::Empty);
    }
    Ok((heights, radii))
}

fn read_npy(path: &Path) -> Result<(Vec<f64>, Vec<f64>), ListError> {
    let read::Matrix { rows, columns, values, .. } = npy::matrix(path)?;
    if columns != 2 {
        return Err(ListError::Shape { rows, columns });
    }
    let cell = |row: usize, column, value: f64, allowed| ListError::Cell {
        place: format!("row {} of {rows}", row + 1),
        column,
        found: value.to_string(),
        allowed,
    };
    let (mut heights, mut radii) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    for (row, pair) in values.chunks_exact(2).enumerate() {
        if !is_height(pair[0]) {
            return Err(cell(row, "height", pair[0], HEIGHT));
        }
        if !is_radius(pair[1]) {
            return Err(cell(row, "radius", pair[1], RADIUS));
        }
        heights.push(pair[0]);
        radii.push(pair[1]);
    }
    Ok((heights, radii))
}

fn read_csv(path: &Path) -> Result<(Vec<f64>, Vec<f64>), ListError> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_path(path)?;
    let header = reader.headers()?.clone();
    let column = |name: &'static str| {
        header.iter().position(|found| found == name).ok_or_else(|| ListError::Column {
            column: name,
            found: if header.is_empty() {
                "an empty file".into()
            } else {
                header.iter().collect::<Vec<_>>().join(", ")
            },
        })
    };
    let (height_column, radius_column) = (column("height")?, column("radius")?);
    let (mut heights, mut radii) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |index: usize, column, is_allowed: fn(f64) -> bool, allowed| {
            let text = &record[index];
            text.parse().ok().filter(|&value| is_allowed(value)).ok_or_else(|| ListError::Cell {
                place: format!("line {line}"),
                column,
                found: format!("`{text}`"),
                allowed,
            })
        };
        heights.push(number(height_column, "height", is_height, HEIGHT)?);
        radii.push(number(radius_column, "radius", is_radius, RADIUS)?);
    }
    Ok((heights, radii))
}

fn is_height(value: f64) -> bool {
    value.abs() <= LARGEST
}

fn is_radius(value: f64) -> bool {
    is_positive(value)
}
