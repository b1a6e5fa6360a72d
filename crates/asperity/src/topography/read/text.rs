//! Plain text: a matrix of heights, one line per y, with or without the header of Gwyddion.
//!
//! The header (`# Width: 12.5 µm`, `# Height: 10 µm`, `# Value units: nm`) gives the size of the map, which is divided
//! by the number of points. Without it three columns of more than three lines are coordinates, see [`xyz`](super::xyz).

use super::content::{Measured, Metadata, transposed};
use super::error::ReadError;
use super::source::{OF_BYTES, Source};
use super::table::Table;
use super::{Format, Reader, source, xyz};
use crate::progress::Share;
use crate::units::Dimension;

const WITH_HEADER: &str = "a text with a header of sizes";

pub(super) const FORMAT: Format = Format {
    name: "a matrix of numbers or columns x y z as text",
    endings: &["txt", "csv", "asc", "tsv", "xyz"],
    is: |source| source.begin().iter().all(|&byte| byte >= b' ' || byte.is_ascii_whitespace()),
    read: Reader::Map { metadata: |source| Ok(measured(source)?.metadata), measured },
};

/// Units of work of the grid, or of the order of the heights; the table is the rest.
const OF_ORDER: f64 = 0.1;

/// Reads a map: in metres with a header, in the unit of the file without.
///
/// # Errors
/// See [`ReadError`].
pub(super) fn measured(source: &Source) -> Result<Measured, ReadError> {
    // Without the text itself, which takes as much memory as the heights.
    let (header, grid, table) = {
        let bytes = source.all()?;
        let count = source.count(0.0, bytes.len());
        let text = source::text(bytes, count);
        let text = text.trim_start_matches('\u{feff}');
        let of_table = Share { progress: source.progress(), units: 1.0 - OF_BYTES - OF_ORDER };
        (Header::parse(text)?, xyz::Grid::parse(text), Table::parse(text, &of_table)?)
    };
    let Table { rows, columns, mut values, named, left_out, precision } = table;
    if header.is_none() && columns == 3 && rows > 3 {
        let of_order = Share { progress: source.progress(), units: OF_ORDER };
        let measured = xyz::measured(&values, grid?, precision, &of_order)?;
        return Ok(Measured { metadata: Metadata { named, left_out, ..measured.metadata }, ..measured });
    }
    let metadata = Metadata { left_out, ..Metadata::new([columns, rows], "a plain text") };
    let Some(header) = header else {
        let heights = transposed(&values, columns, source.count(OF_ORDER, values.len()));
        return Ok(Measured { metadata, heights, scale: 1.0, offset: 0.0, precision });
    };
    let pixel = Some([header.width / columns as f64, header.height / rows as f64]);
    values.iter_mut().for_each(|z| *z *= header.unit);
    let metadata = Metadata { pixel, has_unit: true, format: WITH_HEADER, ..metadata };
    let heights = transposed(&values, columns, source.count(OF_ORDER, values.len()));
    Ok(Measured { metadata, heights, scale: header.unit, offset: 0.0, precision })
}

/// The header of Gwyddion, in metres.
struct Header {
    width: f64,
    height: f64,
    unit: f64,
}

impl Header {
    /// Parses the header; `None` if there is none.
    fn parse(text: &str) -> Result<Option<Self>, ReadError> {
        let entry = |key: &str| {
            text.lines().map_while(|line| line.trim().strip_prefix('#')).find_map(|line| {
                let (found, value) = line.split_once(':')?;
                (found.trim() == key).then(|| value.trim())
            })
        };
        let (width, height, unit) = match (entry("Width"), entry("Height"), entry("Value units")) {
            (None, None, None) => return Ok(None),
            (Some(width), Some(height), Some(unit)) => (width, height, unit),
            found => {
                let word = |value: Option<&str>| if value.is_some() { "there" } else { "missing" };
                return Err(ReadError::Unsupported(format!(
                    "has a header with Width {}, Height {}, Value units {}; allowed: all three, or none",
                    word(found.0),
                    word(found.1),
                    word(found.2)
                )));
            }
        };
        let unit = length_unit(unit).ok_or_else(|| {
            ReadError::Unsupported(format!(
                "holds values in \"{unit}\"; allowed: heights in {}",
                allowed_units()
            ))
        })?;
        Ok(Some(Self { width: length("Width", width)?, height: length("Height", height)?, unit }))
    }
}

/// Converts a length such as "12.5 µm" to metres.
fn length(key: &str, words: &str) -> Result<f64, ReadError> {
    let (number, unit) = words.split_once([' ', '\t', '\u{a0}']).unwrap_or((words, ""));
    let number = number.replace(',', ".").parse::<f64>().ok().filter(|number| number.is_finite());
    number.zip(length_unit(unit.trim())).map(|(number, unit)| number * unit).ok_or_else(|| {
        ReadError::Unsupported(format!(
            "has the {key} \"{words}\"; allowed: a number and one of {}",
            allowed_units()
        ))
    })
}

fn length_unit(word: &str) -> Option<f64> {
    Dimension::Length.documented_factor(word)
}

fn allowed_units() -> String {
    Dimension::Length.documented().join(", ")
}
