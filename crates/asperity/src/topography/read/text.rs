//! Plain text: a matrix of heights, one line per y, with or without the header of a program.
//!
//! A [header](super::exports) gives the size of the map, which is divided by the number of points, or the pixel. Without one, or with Zygo's, three
//! columns of more than three lines are coordinates, see [`xyz`](super::xyz). Other lines above the table are left out, with a note.

use super::content::{Measured, Metadata, transposed};
use super::error::ReadError;
use super::exports::{gwyddion, keyence, zygo};
use super::source::{OF_BYTES, Source};
use super::table::{Table, with_marks};
use super::{Format, Reader, source, xyz};
use crate::progress::Share;

pub(super) const NAME: &str = "a matrix of numbers or columns x y z as text";

pub(super) const FORMAT: Format = Format {
    name: NAME,
    endings: &["txt", "csv", "asc", "tsv", "xyz"],
    is: |source| {
        let begin = source.begin();
        let is_wide = begin.starts_with(b"\xff\xfe") || begin.starts_with(b"\xfe\xff");
        is_wide || begin.iter().all(|&byte| byte >= b' ' || byte.is_ascii_whitespace())
    },
    read: Reader::Map { metadata: |source| Ok(measured(source)?.metadata), measured },
};

/// Units of work of the grid, or of the order of the heights; the table is the rest.
const OF_ORDER: f64 = 0.1;

/// Reads a map: in metres with a header that says the unit, in the unit of the file without.
///
/// # Errors
/// See [`ReadError`].
pub(super) fn measured(source: &Source) -> Result<Measured, ReadError> {
    // Without the text itself, which takes as much memory as the heights.
    let (header, is_matrix, grid, table) = {
        let bytes = source.all()?;
        let count = source.count(0.0, bytes.len());
        let text = source::text(bytes, count);
        let text = with_marks(text.trim_start_matches('\u{feff}'), &source.missing);
        let of_table = Share { progress: source.progress(), units: 1.0 - OF_BYTES - OF_ORDER };
        match zygo(&text)? {
            Some((header, points)) => (Some(header), false, Ok(None), Table::parse(points, &of_table)?),
            None => {
                let header = gwyddion(&text)?;
                let table = Table::parse(&text, &of_table)?;
                let header = header.or_else(|| keyence(&table.heading));
                (header, true, xyz::Grid::parse(&text), table)
            }
        }
    };
    if table.columns < 3 && table.rows > 3 {
        let columns = if table.columns == 1 { "one column" } else { "two columns" };
        return Err(mismatch!(
            "holds {columns} of {} numbers, a profile; allowed: a height map, as a matrix of numbers or as columns x y z",
            table.rows
        ));
    }
    let is_points = table.columns == 3 && table.rows > 3 && !(is_matrix && header.is_some());
    let mut notes = Vec::new();
    if header.is_none() {
        notes.extend(table.note());
    }
    let Table { rows, columns, values, named, left_out, precision, .. } = table;
    let measured = if is_points {
        let of_order = Share { progress: source.progress(), units: OF_ORDER };
        let measured = xyz::measured(&values, grid?, precision, &of_order)?;
        Measured { metadata: Metadata { named, left_out, notes, ..measured.metadata }, ..measured }
    } else {
        let metadata = Metadata { left_out, notes, ..Metadata::new([columns, rows], "a plain text") };
        let heights = transposed(&values, columns, source.count(OF_ORDER, values.len()));
        Measured { metadata, heights, scale: 1.0, offset: 0.0, precision }
    };
    Ok(match header {
        Some(header) => header.applied(measured),
        None => measured,
    })
}
