//! Plain text: a matrix of heights, one line per y, with or without the header of a program.
//!
//! A header gives the size of the map, which is divided by the number of points, or the pixel. Without one, or with Zygo's, three
//! columns of more than three lines are coordinates, see [`xyz`](super::xyz). Other lines above the table are left out, with a note.

use super::content::{LengthUnits, Measured, Metadata, transposed};
use super::error::ReadError;
use super::source::{OF_BYTES, Source};
use super::table::{Table, with_marks};
use super::{Format, Reader, source, xyz};
use crate::numeric::is_positive;
use crate::progress::Share;
use crate::units::Dimension;

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

/// What a header states.
pub(super) struct Header {
    format: &'static str,
    /// Lengths along x and y, m: of a pixel, or of the map.
    size: Option<[f64; 2]>,
    is_of_map: bool,
    /// Of heights, where it is one of length.
    unit: Option<f64>,
    /// Of the size.
    unit_xy: f64,
}

impl Header {
    /// The map with what the header states.
    pub(super) fn applied(self, mut measured: Measured) -> Measured {
        let metadata = &mut measured.metadata;
        // Coordinates count pixels.
        let steps = metadata.pixel.unwrap_or([1.0; 2]);
        let step = |k: usize| if self.is_of_map { 1.0 / metadata.points[k] as f64 } else { steps[k] };
        metadata.pixel = self.size.map(|[x, y]| [x * step(0), y * step(1)]);
        (metadata.format, metadata.pixel_has_unit, metadata.has_unit) =
            (self.format, true, self.unit.is_some());
        metadata.stated = LengthUnits { xy: self.unit_xy, z: self.unit.unwrap_or(1.0) };
        if let Some(unit) = self.unit {
            measured.heights.iter_mut().for_each(|z| *z *= unit);
            measured.scale = unit;
        }
        measured
    }
}

/// The header of Gwyddion, in comments: `# Width: 12.5 µm`, `# Height: 10 µm`, `# Value units: nm`, in the language of the program. Those of other
/// languages are known by two lengths that follow each other, and a unit behind them.
pub(super) fn gwyddion(text: &str) -> Result<Option<Header>, ReadError> {
    let comments = text.lines().map_while(|line| line.trim().strip_prefix('#'));
    // Full-width in Japanese.
    let entries: Vec<(&str, &str)> = comments
        .filter_map(|line| line.split_once([':', '\u{ff1a}']))
        .map(|(key, value)| (key.trim(), value.trim()))
        .collect();
    let entry = |key: &str| entries.iter().find(|(found, _)| *found == key).map(|&(_, value)| value);
    let is_unit = |word: &str| word.chars().count() <= 8 && !word.contains(|c: char| c.is_ascii_digit());
    let translated = || {
        let mut triples = entries.windows(3).map(|lines| [lines[0].1, lines[1].1, lines[2].1]);
        triples.find(|[x, y, unit]| length(x).is_some() && length(y).is_some() && is_unit(unit))
    };
    let [width, height, unit] = match [entry("Width"), entry("Height"), entry("Value units")] {
        [Some(width), Some(height), Some(unit)] => [width, height, unit],
        found => match translated() {
            Some(found) => found,
            None if found == [None; 3] => return Ok(None),
            None => {
                let [x, y, z] = found.map(|value| if value.is_some() { "there" } else { "missing" });
                return Err(unsupported!(
                    "has a header with Width {x}, Height {y}, Value units {z}; allowed: all three, or none"
                ));
            }
        },
    };
    let allowed = Dimension::Length.documented().join(", ");
    let metres = length_unit(unit);
    if metres.is_none() && !unit.is_empty() {
        let message = format!("holds values in \"{unit}\"; allowed: heights in {allowed}");
        return Err(ReadError::Unsupported(message));
    }
    let side = |key: &str, words: &str| {
        let message = || format!("has the {key} \"{words}\"; allowed: a number and one of {allowed}");
        length(words).ok_or_else(|| ReadError::Unsupported(message()))
    };
    let ([x, unit_xy], [y, _]) = (side("Width", width)?, side("Height", height)?);
    let format = "a text with a header of sizes";
    Ok(Some(Header { format, size: Some([x, y]), is_of_map: true, unit: metres, unit_xy }))
}

/// The header of a Keyence VK or VR, which stands above the table, in the language and the encoding of the computer: `"XY Calibration","1.5","um"`
/// and `"Unit","um"`. Only XY, numbers and units are the same in all of them.
pub(super) fn keyence(heading: &[String]) -> Option<Header> {
    let cells = |line: &String| -> Vec<String> {
        let separator = [';', '\t'].into_iter().find(|&separator| line.contains(separator)).unwrap_or(',');
        let cells = line.split(separator).map(|cell| cell.trim().trim_matches('"').trim().to_owned());
        cells.filter(|cell| !cell.is_empty()).collect()
    };
    let lines: Vec<Vec<String>> = heading.iter().map(cells).collect();
    let (pixel, unit_xy) = lines.iter().find_map(|line| match &line[..] {
        [label, number, unit] if label.contains("XY") => {
            let unit = length_unit(unit)?;
            let number = number.replace(',', ".").parse::<f64>().ok()?;
            is_positive(number).then_some((number * unit, unit))
        }
        _ => None,
    })?;
    let unit = lines.iter().find_map(|line| match &line[..] {
        [_, unit] => length_unit(unit),
        _ => None,
    });
    let format = "a text of a Keyence microscope";
    Some(Header { format, size: Some([pixel; 2]), is_of_map: false, unit, unit_xy })
}

/// The header of points of Zygo's MetroPro and Mx, 13 or 14 lines, and the points below it: lines "column row height", heights in µm.
pub(super) fn zygo(text: &str) -> Result<Option<(Header, &str)>, ReadError> {
    if !text.starts_with("Zygo ") || !text.lines().next().is_some_and(|line| line.contains(" Data File")) {
        return Ok(None);
    }
    let mut sections = text.split("\n#");
    let (Some(head), Some(points), true) = (sections.next(), sections.next(), text.starts_with("Zygo XYZ"))
    else {
        return Err(unsupported!(
            "is a text of Zygo without points; allowed: \"Zygo XYZ Data File\", or the binary file"
        ));
    };
    let resolution = head.lines().nth(7).and_then(|line| line.split_whitespace().nth(6)?.parse().ok());
    // A lateral resolution of zero is none.
    let size = resolution.filter(|&size| is_positive(size)).map(|size| [size; 2]);
    let format = "a text of Zygo";
    Ok(Some((Header { format, size, is_of_map: false, unit: Some(1e-6), unit_xy: 1.0 }, points)))
}

/// A length such as "12.5 µm", and its unit, m.
fn length(words: &str) -> Option<[f64; 2]> {
    let (number, unit) = words.split_once([' ', '\t', '\u{a0}', '\u{202f}']).unwrap_or((words, ""));
    let number = number.replace(',', ".").parse::<f64>().ok().filter(|number| number.is_finite());
    number.zip(length_unit(unit.trim())).map(|(number, unit)| [number * unit, unit])
}

/// A unit of length (m), with a µ in any encoding.
fn length_unit(word: &str) -> Option<f64> {
    let micro =
        |prefix: &str| (1..=2).contains(&prefix.chars().count()) && !prefix.contains(|c: char| c.is_ascii());
    let word = if word.strip_suffix('m').is_some_and(micro) { "um" } else { word };
    Dimension::Length.documented_factor(word)
}
