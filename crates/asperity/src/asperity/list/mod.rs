//! Reading a list of asperities: a text with the columns `height` and `radius`, or an n x 2 `.npy`; for ellipses,
//! followed by `kx` and `ky`. A text may have their places `x` and `y` besides.

mod header;
mod text;

use std::ops::Range;
use std::path::Path;

use rayon::prelude::*;

use super::{AsperitySet, Ellipse, SetError};
use crate::legible::legible;
use crate::memory::zeros;
use crate::npy::{self, NpyError};
use crate::progress::{Progress, Silent};
pub use header::ListColumn;
use header::per_metre;

/// An error in reading a list of asperities.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum ListError {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// The file is a `.npy` whose array cannot be read.
    #[error(transparent)]
    Npy(#[from] NpyError),
    /// The `.npy` array has too few or too many columns.
    #[error("holds an array of shape {rows} x {columns}; allowed: n x {}, with the columns {}", needed.len(), ListColumn::names(needed))]
    Shape { rows: usize, columns: usize, needed: &'static [ListColumn] },
    /// A column is missing.
    #[error(
        "has no column `{}` (found: {}); allowed: a header line with the columns {}",
        column.name(),
        legible(found, 200),
        ListColumn::names(needed)
    )]
    Column { column: ListColumn, found: String, needed: &'static [ListColumn] },
    /// The header names more columns than a list has.
    #[error("line {line} names more than {MOST_COLUMNS} columns; allowed: at most {MOST_COLUMNS}")]
    Wide { line: usize },
    /// The first line holds numbers.
    #[error(
        "line {line} holds numbers, but no line before it names the columns; allowed: a header line with the columns {}",
        ListColumn::names(needed)
    )]
    NoHeader { line: usize, needed: &'static [ListColumn] },
    /// The header names a column twice.
    #[error(
        "line {line} names the column `{}` twice, as columns {} and {}; allowed: once",
        column.name(), places[0], places[1]
    )]
    Duplicate { column: ListColumn, line: usize, places: [usize; 2] },
    /// The header gives a column a unit that is not supported.
    #[error("line {line}: the column `{}` has the unit \"{}\"; allowed: {}", column.name(), legible(unit, 40), column.allowed_units())]
    Unit { column: ListColumn, line: usize, unit: String },
    /// Both the header and the options give a unit.
    #[error("holds units in its header, line {line}; allowed: leave unit out")]
    UnitHeld { line: usize },
    /// A row has more or fewer cells than the header.
    #[error(
        "line {line} holds {found} value{} (\"{}\"); allowed: {allowed}, as in the header, line {header}{}",
        if *found == 1 { "" } else { "s" },
        legible(text, 40),
        if *may_be_decimal_commas { "; with decimal commas the values must be separated by semicolons or tabs" } else { "" }
    )]
    Ragged {
        line: usize,
        found: usize,
        allowed: usize,
        header: usize,
        text: String,
        may_be_decimal_commas: bool,
    },
    /// Decimal points and decimal commas in one file.
    #[error(
        "holds a decimal point in line {point} and a decimal comma in line {comma}; allowed: one of them in all lines, and \
         no separators of thousands"
    )]
    DecimalMarks { point: usize, comma: usize },
    /// The text is encoded in UTF-16.
    #[error("is a text in UTF-16; allowed: UTF-8 or Latin-1")]
    Encoding,
    /// A cell holds no number, or one out of range.
    #[error("{place}, column `{}`: found {}; allowed: {}", column.name(), legible(found, 60), column.allowed())]
    Cell { place: String, column: ListColumn, found: String },
    /// The list has no row.
    #[error("has no asperity: the list has no rows")]
    Empty,
}

/// The most columns of a text.
const MOST_COLUMNS: usize = 10_000;

/// How a list is read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ListOptions {
    /// Whether principal curvatures are read too.
    pub as_ellipses: bool,
    /// Unit of heights and radii, and reciprocal unit of curvatures, m; a metre if it is not given. Only for a file that
    /// names no units.
    pub unit: Option<f64>,
}

impl ListOptions {
    /// The columns that are needed.
    fn needed(self) -> &'static [ListColumn] {
        &ListColumn::OF_ARRAY[..if self.as_ellipses { 4 } else { 2 }]
    }
}

/// The values of each [`ListColumn`], per asperity; empty if not requested.
type Columns = [Vec<f64>; ListColumn::ALL.len()];

/// A list of asperities as read from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct AsperityList {
    heights: Vec<f64>,
    radii: Vec<f64>,
    /// kx and ky.
    curvatures: Option<[Vec<f64>; 2]>,
    /// Places along x and y, m.
    places: Option<[Vec<f64>; 2]>,
    /// Whether its file was taken for metres because nothing names a unit.
    takes_metres: bool,
}

impl AsperityList {
    /// Reads heights and radii, and as ellipses principal curvatures kx and ky, from a text or `.npy` file with these
    /// columns; the first bytes of the file decide which.
    ///
    /// A text has a header such as `height [um]; radius [mm]`; without units its values are in m and 1/m, or in the unit
    /// of `options`. The separator is the first of semicolon, tab, comma and blank that the header contains; between
    /// others than commas, decimal commas are read too. Lines that begin with `#` are comments, the last of which is the
    /// header if no other line is; further columns are ignored. An `.npy` is read in pieces: memory is used only for the
    /// columns returned. One unit of work for `progress`.
    ///
    /// # Errors
    /// See [`ListError`]; an invalid value is reported with its row.
    pub fn read(path: &Path, options: ListOptions, progress: &dyn Progress) -> Result<Self, ListError> {
        let needed = options.needed();
        let mut found = Columns::default();
        let mut takes_metres = options.unit.is_none();
        if npy::is_npy(path)? {
            found = read_npy(path, needed, options, progress)?;
        } else {
            text::rows(path, needed, options, progress, |header, row| {
                takes_metres = header.takes_metres;
                header
                    .columns
                    .iter()
                    .zip(row)
                    .for_each(|(&column, &value)| found[column as usize].push(value));
            })?;
        }
        let [heights, radii, kx, ky, x, y] = found;
        if heights.is_empty() {
            return Err(ListError::Empty);
        }
        let places = (!x.is_empty()).then_some([x, y]);
        Ok(Self { heights, radii, curvatures: options.as_ellipses.then_some([kx, ky]), places, takes_metres })
    }

    /// Checks every row of a file without keeping it, and returns their number. Of an `.npy` of more than 1e8 rows only the
    /// shape is checked: its rows are as they are read. One unit of work for `progress`.
    ///
    /// # Errors
    /// Those of [`AsperityList::read`].
    pub fn check(path: &Path, options: ListOptions, progress: &dyn Progress) -> Result<usize, ListError> {
        let needed = options.needed();
        if npy::is_npy(path)? {
            check_npy(path, needed, options, progress)
        } else {
            text::rows(path, needed, options, progress, |_, _| {})
        }
    }

    /// The rows of an index range of an `.npy` file, as [`AsperityList::read`] reads all: memory is used only for these.
    ///
    /// # Errors
    /// Those of [`AsperityList::read`]; [`ListError::Empty`] of a range without rows.
    pub fn read_rows(path: &Path, rows: Range<usize>, options: ListOptions) -> Result<Self, ListError> {
        let array = npy::OnDisk::in_either_order(path)?;
        let needed = options.needed();
        check_shape(array.points()[0], array.points()[1], needed)?;
        let rows = rows.start..rows.end.min(array.points()[0]);
        if rows.is_empty() {
            return Err(ListError::Empty);
        }
        let [heights, radii, kx, ky, ..] = rows_of(&array, rows, needed, options, &Silent)?;
        Ok(Self {
            heights,
            radii,
            curvatures: options.as_ellipses.then_some([kx, ky]),
            places: None,
            takes_metres: options.unit.is_none(),
        })
    }

    /// The list with these columns, in m and 1/m: heights, radii, and the principal curvatures kx and ky of ellipses.
    /// [`Self::set`] checks them.
    pub fn new(heights: Vec<f64>, radii: Vec<f64>, curvatures: Option<[Vec<f64>; 2]>) -> Self {
        Self { heights, radii, curvatures, places: None, takes_metres: false }
    }

    /// The same list with the places of its asperities along x and y, m: as many as rows.
    #[must_use]
    pub fn at_places(self, places: [Vec<f64>; 2]) -> Self {
        Self { places: Some(places), ..self }
    }

    /// Whether its file was taken for metres because neither it nor the options name a unit.
    pub fn takes_metres(&self) -> bool {
        self.takes_metres
    }

    /// The places of its asperities along x and y, m, where they are known.
    pub fn places(&self) -> Option<[&[f64]; 2]> {
        self.places.as_ref().map(|places| places.each_ref().map(Vec::as_slice))
    }

    /// Its columns: heights, radii, and kx and ky, and x and y, where it has them.
    pub fn columns(&self) -> impl Iterator<Item = &[f64]> {
        let others = self.curvatures.iter().chain(&self.places).flatten().map(Vec::as_slice);
        [self.heights.as_slice(), &self.radii].into_iter().chain(others)
    }

    /// Whether it has principal curvatures.
    pub fn has_curvatures(&self) -> bool {
        self.curvatures.is_some()
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

    /// Heights, m.
    pub fn heights(&self) -> &[f64] {
        &self.heights
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

/// Rows of an array that are read at a time: they stay in the cache.
const ROWS: usize = 8192;

/// More are checked as they are read: a pass over them takes as long as a sum.
const MOST_CHECKED: usize = 100_000_000;

fn read_npy(
    path: &Path,
    needed: &'static [ListColumn],
    options: ListOptions,
    progress: &dyn Progress,
) -> Result<Columns, ListError> {
    let array = npy::OnDisk::in_either_order(path)?;
    let [rows, columns] = array.points();
    check_shape(rows, columns, needed)?;
    rows_of(&array, 0..rows, needed, options, progress)
}

/// The columns of an index range of rows.
fn rows_of(
    array: &npy::OnDisk,
    rows: Range<usize>,
    needed: &'static [ListColumn],
    options: ListOptions,
    progress: &dyn Progress,
) -> Result<Columns, ListError> {
    let mut found = Columns::default();
    let count = rows.len() as f64;
    let mut pieces: Vec<Vec<&mut [f64]>> = (0..rows.len().div_ceil(ROWS)).map(|_| Vec::new()).collect();
    for (column, _) in found.iter_mut().zip(needed) {
        *column = zeros(rows.len());
        pieces.iter_mut().zip(column.chunks_mut(ROWS)).for_each(|(pieces, piece)| pieces.push(piece));
    }
    let bad = pieces.par_iter_mut().enumerate();
    let bad = bad.find_map_first(|(k, pieces)| {
        let read = pieces.first().map_or(0, |piece| piece.len());
        progress.advance(read as f64 / count);
        piece(array, rows.start + k * ROWS, needed, options, pieces)
    });
    bad.map_or(Ok(found), Err)
}

/// The number of rows of an array that are all valid.
fn check_npy(
    path: &Path,
    needed: &'static [ListColumn],
    options: ListOptions,
    progress: &dyn Progress,
) -> Result<usize, ListError> {
    let array = npy::OnDisk::in_either_order(path)?;
    let [rows, columns] = array.points();
    check_shape(rows, columns, needed)?;
    if rows > MOST_CHECKED {
        return Ok(rows);
    }
    let bad = (0..rows.div_ceil(ROWS)).into_par_iter().find_map_first(|k| {
        let length = ROWS.min(rows - k * ROWS);
        let mut columns = vec![vec![0.0; length]; needed.len()];
        let mut pieces: Vec<&mut [f64]> = columns.iter_mut().map(Vec::as_mut_slice).collect();
        progress.advance(length as f64 / rows as f64);
        piece(&array, k * ROWS, needed, options, &mut pieces)
    });
    match bad {
        Some(error) => Err(error),
        None if rows == 0 => Err(ListError::Empty),
        None => Ok(rows),
    }
}

/// Reads the rows from `begin` on in SI; returns the first invalid value.
fn piece(
    array: &npy::OnDisk,
    begin: usize,
    needed: &'static [ListColumn],
    options: ListOptions,
    pieces: &mut [&mut [f64]],
) -> Option<ListError> {
    if let Err(error) = array.columns(begin, pieces) {
        return Some(error.into());
    }
    let per_metre = options.unit.map_or(1.0, per_metre);
    let bad = needed.iter().zip(pieces).filter_map(|(&column, piece)| {
        let mut bad = None;
        for (row, value) in piece.iter_mut().enumerate() {
            let si = column.si(*value, per_metre);
            if bad.is_none() && !column.allows(si) {
                bad = Some((row, column, *value));
            }
            *value = si;
        }
        bad
    });
    let (row, column, value) = bad.min_by_key(|(row, ..)| *row)?;
    let place = format!("row {} of {}", begin + row + 1, array.points()[0]);
    Some(ListError::Cell { place, column, found: format!("{value:?}") })
}

/// An array of ellipses may also be read as spheres.
fn check_shape(rows: usize, columns: usize, needed: &'static [ListColumn]) -> Result<(), ListError> {
    if columns == needed.len() || columns == ListColumn::OF_ARRAY.len() {
        return Ok(());
    }
    Err(ListError::Shape { rows, columns, needed })
}
