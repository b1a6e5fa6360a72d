//! Reading a list of asperities: CSV with the columns `height` and `radius`, or an n x 2 `.npy`; for ellipses, followed
//! by `kx` and `ky`.

use std::fs::File;
use std::path::Path;

use rayon::prelude::*;

use super::{AsperitySet, Ellipse, SetError};
use crate::memory::zeros;
use crate::npy::{self, NpyError};
use crate::numeric::{LARGEST, is_positive};

/// An error in reading a list of asperities.
#[derive(Debug, thiserror::Error)]
pub enum ListError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The file is a `.npy` whose array cannot be read.
    #[error(transparent)]
    Npy(#[from] NpyError),
    /// The `.npy` array has too few or too many columns.
    #[error("holds an array of shape {rows} x {columns}; allowed: n x {}, with the columns {}", needed.len(), ListColumn::names(needed))]
    Shape {
        /// Rows found.
        rows: usize,
        /// Columns found.
        columns: usize,
        /// The columns that are needed.
        needed: &'static [ListColumn],
    },
    /// A column is missing.
    #[error(
        "has no column `{}` (found: {found}); allowed: a header line with the columns {}",
        column.name(),
        ListColumn::names(needed)
    )]
    Column {
        /// The column that is missing.
        column: ListColumn,
        /// The header that was found.
        found: String,
        /// The columns that are needed.
        needed: &'static [ListColumn],
    },
    /// A line is not valid CSV.
    #[error("{0}")]
    Csv(#[from] csv::Error),
    /// A cell holds no number, or one out of range.
    #[error("{place}, column `{}`: found {found}; allowed: {}", column.name(), column.allowed())]
    Cell {
        /// The row or line of the file.
        place: String,
        /// The column.
        column: ListColumn,
        /// The text found.
        found: String,
    },
    /// The list has no row.
    #[error("has no asperity: the list has no rows")]
    Empty,
}

/// A column of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ListColumn {
    /// Height, m.
    Height,
    /// Radius, m.
    Radius,
    /// One principal curvature, 1/m.
    Kx,
    /// The other one, 1/m.
    Ky,
}

impl ListColumn {
    /// All columns in the order of an array; the first two suffice for spheres.
    const ALL: &'static [Self] = &[Self::Height, Self::Radius, Self::Kx, Self::Ky];

    /// The name in a header.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Height => "height",
            Self::Radius => "radius",
            Self::Kx => "kx",
            Self::Ky => "ky",
        }
    }

    const fn unit(self) -> &'static str {
        match self {
            Self::Height | Self::Radius => "m",
            Self::Kx | Self::Ky => "1/m",
        }
    }

    fn names(columns: &[Self]) -> String {
        let named: Vec<String> =
            columns.iter().map(|column| format!("{} [{}]", column.name(), column.unit())).collect();
        named.join(", ")
    }

    fn allows(self, value: f64) -> bool {
        match self {
            Self::Height => value.abs() <= LARGEST,
            Self::Radius | Self::Kx | Self::Ky => is_positive(value),
        }
    }

    const fn allowed(self) -> &'static str {
        match self {
            Self::Height => "a finite number of metres",
            Self::Radius => "a positive finite number of metres",
            Self::Kx | Self::Ky => "a positive finite number of 1/m",
        }
    }
}

/// The values of each of [`ListColumn::ALL`], per asperity; empty if not requested.
type Columns = [Vec<f64>; ListColumn::ALL.len()];

/// A list of asperities as read from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct AsperityList {
    heights: Vec<f64>,
    radii: Vec<f64>,
    /// kx and ky.
    curvatures: Option<[Vec<f64>; 2]>,
}

impl AsperityList {
    /// Reads heights and radii (m), and if `as_ellipses` principal curvatures kx and ky (1/m), from a CSV or `.npy`
    /// file with these columns; the first bytes of the file decide which. Lines of a CSV that begin with `#` are
    /// comments; further columns are ignored. An `.npy` is memory-mapped: memory is used only for the columns returned.
    ///
    /// # Errors
    /// See [`ListError`]; an invalid value is reported with its row.
    pub fn read(path: &Path, as_ellipses: bool) -> Result<Self, ListError> {
        let needed = needed(as_ellipses);
        let is_npy = npy::is_npy(path)?;
        let [heights, radii, kx, ky] = if is_npy { read_npy(path, needed)? } else { read_csv(path, needed)? };
        if heights.is_empty() {
            return Err(ListError::Empty);
        }
        Ok(Self { heights, radii, curvatures: as_ellipses.then_some([kx, ky]) })
    }

    /// Checks that a file has the columns that [`AsperityList::read`] needs, without reading the rows, and returns
    /// the largest number of rows it may have.
    ///
    /// # Errors
    /// See [`ListError`].
    pub fn check(path: &Path, as_ellipses: bool) -> Result<usize, ListError> {
        /// The shortest row of a CSV: "0,1" and a line end.
        const BYTES_PER_ROW: u64 = 4;
        let needed = needed(as_ellipses);
        if npy::is_npy(path)? {
            let npy::Header { rows, columns, .. } = npy::Header::read(path)?;
            return check_shape(rows, columns, needed).map(|()| rows);
        }
        places(&mut csv_reader(path)?, needed)?;
        let bytes = std::fs::metadata(path)?.len();
        Ok(usize::try_from(bytes / BYTES_PER_ROW).unwrap_or(usize::MAX))
    }

    /// Number of rows whose radius does not lie between the principal radii of curvature 1/kx and 1/ky: their sphere
    /// and ellipse are different asperities.
    pub fn contradictions(&self) -> usize {
        /// The rounding of a radius in a file.
        const ROUNDING: f64 = 1e-3;
        let Some([kx, ky]) = &self.curvatures else { return 0 };
        let contradicts = |(radius, (kx, ky)): &(&f64, (&f64, &f64))| {
            *radius * kx.max(**ky) < 1.0 - ROUNDING || *radius * kx.min(**ky) > 1.0 + ROUNDING
        };
        self.radii.iter().zip(kx.iter().zip(ky)).filter(contradicts).count()
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.heights.len()
    }

    /// The asperities on a nominal area (m^2).
    ///
    /// # Errors
    /// See [`SetError`].
    pub fn set(self, nominal_area: f64) -> Result<AsperitySet, SetError> {
        let set = AsperitySet::new(self.heights, self.radii, nominal_area)?;
        let Some([kx, ky]) = self.curvatures else { return Ok(set) };
        set.with_ellipses(kx.iter().zip(&ky).map(|(&kx, &ky)| Ellipse::new(kx, ky)).collect())
    }
}

fn needed(as_ellipses: bool) -> &'static [ListColumn] {
    &ListColumn::ALL[..if as_ellipses { 4 } else { 2 }]
}

fn read_npy(path: &Path, needed: &'static [ListColumn]) -> Result<Columns, ListError> {
    /// Rows that are read at a time: they stay in the cache.
    const ROWS: usize = 8192;
    let array = npy::Mapped::in_either_order(path)?;
    let [rows, columns] = array.points();
    check_shape(rows, columns, needed)?;
    let mut found = Columns::default();
    let mut pieces: Vec<Vec<&mut [f64]>> = (0..rows.div_ceil(ROWS)).map(|_| Vec::new()).collect();
    for (column, _) in found.iter_mut().zip(needed) {
        *column = zeros(rows);
        pieces.iter_mut().zip(column.chunks_mut(ROWS)).for_each(|(pieces, piece)| pieces.push(piece));
    }
    let bad = pieces.par_iter_mut().enumerate().find_map_first(|(k, pieces)| {
        array.columns(k * ROWS, pieces);
        let bad = needed.iter().zip(&*pieces).filter_map(|(&column, piece)| {
            let row = piece.iter().position(|&value| !column.allows(value))?;
            Some((row, column, piece[row]))
        });
        let (row, column, value) = bad.min_by_key(|(row, ..)| *row)?;
        let place = format!("row {} of {rows}", k * ROWS + row + 1);
        Some(ListError::Cell { place, column, found: value.to_string() })
    });
    bad.map_or(Ok(found), Err)
}

/// An array of ellipses may also be read as spheres.
fn check_shape(rows: usize, columns: usize, needed: &'static [ListColumn]) -> Result<(), ListError> {
    if columns == needed.len() || columns == ListColumn::ALL.len() {
        return Ok(());
    }
    Err(ListError::Shape { rows, columns, needed })
}

fn csv_reader(path: &Path) -> Result<csv::Reader<File>, csv::Error> {
    csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_path(path)
}

/// The indices of the needed columns.
fn places(reader: &mut csv::Reader<File>, needed: &'static [ListColumn]) -> Result<Vec<usize>, ListError> {
    let header = reader.headers()?.clone();
    let place_of = |&column: &ListColumn| {
        header.iter().position(|found| found == column.name()).ok_or_else(|| ListError::Column {
            column,
            needed,
            found: if header.is_empty() {
                "an empty file".into()
            } else {
                header.iter().collect::<Vec<_>>().join(", ")
            },
        })
    };
    needed.iter().map(place_of).collect()
}

fn read_csv(path: &Path, needed: &'static [ListColumn]) -> Result<Columns, ListError> {
    let mut reader = csv_reader(path)?;
    let places = places(&mut reader, needed)?;
    let mut found = Columns::default();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(0, csv::Position::line);
        for ((&column, &index), values) in needed.iter().zip(&places).zip(&mut found) {
            let text = &record[index];
            let value = text.parse().ok().filter(|&value| column.allows(value));
            values.push(value.ok_or_else(|| ListError::Cell {
                place: format!("line {line}"),
                column,
                found: format!("`{text}`"),
            })?);
        }
    }
    Ok(found)
}
