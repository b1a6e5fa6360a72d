//! Labels of a text that are no heights: a line of names or numbers of the columns of a matrix, and a column of numbers or names of its
//! lines, as tables of other programs have them; names of the columns x, y and z, and the units in them: `x [um] y [um] z [nm]`,
//! `x (µm), y (µm), height (nm)`, `x_um,y_um,z_nm`, `X/mm;Y/mm;Z/um`.

use super::content::{LengthUnits, NamedUnits};
use super::error::shortened;
use super::table::{Separation, is_missing, significant_digits};
use crate::progress::Count;
use crate::units::Dimension;

/// Fewer in a line may be heights by chance.
const FEWEST: usize = 4;

/// Fewer equally spaced numbers other than 0, 1, 2, ... may be heights by chance.
const FEWEST_COORDINATES: usize = 8;

/// The first word of a line that is neither a number nor a mark of a missing point.
pub(super) fn first_name(line: &str) -> Option<&str> {
    let mut words = line.split([' ', '\t', ',', ';']).map(|word| word.trim_matches('"'));
    words.find(|word| {
        !is_missing(word) && !word.contains(|c: char| c.is_ascii_digit()) && word.parse::<f64>().is_err()
    })
}

/// The number of the first line where it names the columns of the lines below it, which hold numbers, and whether the first
/// column holds numbers or names of lines; `count` is of their bytes.
pub(super) fn names(lines: &[(usize, &str)], count: Count) -> Option<(usize, bool)> {
    let [(number, header), below @ ..] = lines else { return None };
    let separation = Separation::new(below, count).ok()?;
    let name = |word: &str| separation.value(word).is_none();
    let header: Vec<&str> = separation.words(header).collect();
    let first: Vec<&str> = separation.words(below.first()?.1).collect();
    let has_corner = has_corner(header.len(), first.len(), header.first()?.is_empty())?;
    let columns = if header.len() == first.len() && has_corner { &header[1..] } else { &header[..] };
    let numbers: Vec<f64> =
        columns.iter().filter_map(|word| separation.value(word)).filter(|number| !number.is_nan()).collect();
    // One word several times stands for missing points.
    let is_named = columns.iter().all(|word| name(word)) && columns.windows(2).all(|pair| pair[0] != pair[1]);
    // A name in the corner, numbers beside it.
    let is_numbered = || {
        columns.len() >= FEWEST
            && name(columns[0])
            && numbers.len() + 1 == columns.len()
            && (is_count(&numbers) || spacing(&columns[1..], &separation).is_some())
    };
    let has_numbers = || first[1..].iter().all(|word| !name(word));
    if columns.len() < FEWEST || !has_numbers() {
        None
    } else if is_named {
        Some((*number, has_corner))
    } else {
        is_numbered().then_some((*number, true))
    }
}

/// The same where it numbers them: 0, 1, 2, ... or 1, 2, 3, ..., unlike the line below it.
pub(super) fn numbers(lines: &[(usize, &str)], separation: &Separation) -> Option<(usize, bool)> {
    let [(number, header), (_, below), ..] = lines else { return None };
    let values = |line: &str| separation.words(line).map(|word| separation.value(word)).collect();
    let (header, below): (Option<Vec<f64>>, Option<Vec<f64>>) = (values(header), values(below));
    let (header, below) = (header?, below?);
    let has_corner = has_corner(header.len(), below.len(), header.first()?.is_nan())?;
    let columns = if header.len() == below.len() && has_corner { &header[1..] } else { &header[..] };
    let heights = &below[below.len() - columns.len()..];
    (is_count(columns) && !resembles(heights, 1.0)).then_some((*number, has_corner))
}

/// Coordinates of the columns in the first line, and of the lines in the first column.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Coordinates {
    /// Distance of the columns, where the first line holds their coordinates.
    pub columns: Option<f64>,
    /// Whether the first column holds no heights.
    pub index_column: bool,
    /// Distance of the lines, where the first column holds their coordinates.
    pub lines: Option<f64>,
}

/// Finds numbers that are equally spaced to their last digit, unlike those beside them, in a first line (unless it was left
/// out), in a first column, or in both behind a corner that may hold any number.
pub(super) fn coordinates(
    lines: &[(usize, &str)],
    separation: &Separation,
    has_header: bool,
) -> Option<Coordinates> {
    let words = |k: usize| lines.get(k).map(|(_, line)| separation.words(line).collect::<Vec<&str>>());
    let (header, below) = (words(0)?, words(1)?);
    if below.len() < FEWEST {
        return None;
    }
    let cells = |column: usize| lines.iter().filter_map(move |(_, line)| separation.words(line).nth(column));
    let cells = [0, 1].map(|column| cells(column).collect::<Vec<&str>>());
    let in_column = |from: usize| unlike(cells[0].get(from..)?, cells[1].get(from..)?, separation);
    let is_counted = |from: usize| {
        let numbers: Option<Vec<f64>> = cells[0][from..].iter().map(|word| separation.value(word)).collect();
        numbers.is_some_and(|numbers| is_count(&numbers))
    };
    if has_header {
        let lines = in_column(0).filter(|_| !is_counted(0));
        return Some(Coordinates { columns: None, index_column: lines.is_some(), lines });
    }
    let in_line =
        |from: usize| unlike(header.get(from..)?, &below[below.len() + from - header.len()..], separation);
    let has_empty_corner = || separation.value(header[0]).is_some_and(f64::is_nan);
    let (columns, has_corner) = match below.len().checked_sub(header.len())? {
        0 if has_empty_corner() || in_column(1).is_some() => {
            in_line(1).map_or_else(|| (in_line(0), false), |step| (Some(step), true))
        }
        0 => (in_line(0), false),
        1 => (in_line(0), true),
        _ => return None,
    };
    let from = usize::from(columns.is_some());
    let lines = in_column(from).filter(|_| !is_counted(from));
    Some(Coordinates { columns, index_column: columns.is_some() && has_corner || lines.is_some(), lines })
}

/// The spacing of coordinates that the heights `beside` them do not have.
fn unlike(words: &[&str], beside: &[&str], separation: &Separation) -> Option<f64> {
    let step = spacing(words, separation)?;
    let heights: Option<Vec<f64>> = beside.iter().map(|word| separation.value(word)).collect();
    (!resembles(&heights?, step) && spacing(beside, separation).is_none()).then_some(step.abs())
}

/// The step, which may be negative, of numbers that are equally spaced to their last digit.
fn spacing(words: &[&str], separation: &Separation) -> Option<f64> {
    /// A step of so many units of the last digit is told from its rounding.
    const RESOLVED: f64 = 4.0;
    /// Rounding of the numbers as they are read, relative to the largest.
    const ROUNDING: f64 = 1e-12;
    let numbers: Option<Vec<f64>> = words.iter().map(|word| separation.value(word)).collect();
    let numbers = numbers.filter(|numbers| numbers.len() >= FEWEST_COORDINATES)?;
    let (first, last) = (*numbers.first()?, *numbers.last()?);
    let step = (last - first) / (numbers.len() - 1) as f64;
    // Numbers with fewer digits may be written without the zeros at their end.
    let most = words.iter().map(|word| significant_digits(word)).max()?;
    let in_full = words.iter().filter(|word| significant_digits(word) == most);
    let digit = in_full.map(|word| last_digit(word)).fold(0.0, f64::max);
    let rounding = ROUNDING * first.abs().max(last.abs());
    let allowed = if step.abs() >= RESOLVED * digit { digit } else { 0.0 } + rounding;
    let is_spaced = |(z, k): (&f64, i32)| (z - (first + step * f64::from(k))).abs() <= allowed;
    (step.abs() > rounding && numbers.iter().zip(0..).all(is_spaced)).then_some(step)
}

/// The value of one in the last digit of a number as it is written.
fn last_digit(word: &str) -> f64 {
    let (mantissa, exponent) = word.split_once(['e', 'E']).unwrap_or((word, "0"));
    let decimals = mantissa.split_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
    10f64.powi(exponent.parse::<i32>().unwrap_or(0) - decimals as i32)
}

/// Whether the first of `columns` columns numbers the lines, unlike the column beside it.
pub(super) fn number_lines(values: &[f64], columns: usize) -> bool {
    let column = |k: usize| values.iter().skip(k).step_by(columns).copied().collect::<Vec<f64>>();
    columns >= FEWEST && is_count(&column(0)) && !resembles(&column(1), 1.0)
}

/// Whether the first cell of lines is that of a label, with `header` cells above `below`; `None` if they do not fit.
fn has_corner(header: usize, below: usize, is_first_empty: bool) -> Option<bool> {
    if header == below { Some(is_first_empty) } else { (header + 1 == below).then_some(true) }
}

/// Whether these are 0, 1, 2, ... or 1, 2, 3, ...
fn is_count(values: &[f64]) -> bool {
    let first = values.first().copied().unwrap_or(f64::NAN);
    values.len() >= FEWEST
        && (first == 0.0 || first == 1.0)
        && values.iter().zip(0..).all(|(value, k)| *value == first + f64::from(k))
}

/// Whether heights rise from one to the next by about `step`, as on an inclined plane.
fn resembles(heights: &[f64], step: f64) -> bool {
    let rises: Vec<f64> =
        heights.windows(2).map(|pair| (pair[1] - pair[0]) / step).filter(|rise| !rise.is_nan()).collect();
    let near = rises.iter().filter(|rise| (0.5..=1.5).contains(*rise)).count();
    !rises.is_empty() && 2 * near > rises.len()
}

/// The units that the first line of numbers or the comment above it names; `first` is the first line that is no comment.
pub(super) fn units(text: &str, first: Option<(usize, &str)>) -> NamedUnits {
    let Some((number, line)) = first else { return NamedUnits::None };
    if are_named(line) {
        return units_of(number, line);
    }
    let above = text.lines().zip(1..number).last();
    let comment = above.and_then(|(line, number)| Some((number, line.trim().strip_prefix('#')?)));
    match comment {
        // A comment may be any sentence: it counts where it is three names, the units of which are clear.
        Some((number, line)) if are_named(line) && cells(line).is_some() => match units_of(number, line) {
            NamedUnits::Unclear { .. } => NamedUnits::None,
            named => named,
        },
        _ => NamedUnits::None,
    }
}

/// Whether a line contains the names x, y and z (or height) in this order and no number.
pub(super) fn are_named(line: &str) -> bool {
    let initials = line
        .split([' ', '\t', ',', ';'])
        .filter_map(|word| word.trim_matches('"').chars().next())
        .map(|initial| initial.to_ascii_lowercase());
    let mut wanted = ["x", "y", "zh"].into_iter().peekable();
    for initial in initials {
        if initial.is_ascii_digit() {
            return false;
        }
        wanted.next_if(|allowed| allowed.contains(initial));
    }
    wanted.next().is_none()
}

fn units_of(line: usize, text: &str) -> NamedUnits {
    let unclear = || NamedUnits::Unclear { line, found: shortened(text) };
    let Some(cells) = cells(text) else {
        return if text.contains(['[', '(', '/']) { unclear() } else { NamedUnits::None };
    };
    match cells.map(|cell| unit_of(&cell)) {
        [Unit::None, Unit::None, Unit::None] => NamedUnits::None,
        [Unit::Length(x), Unit::Length(y), Unit::Length(z)] if x == y => {
            NamedUnits::Known(LengthUnits { xy: x, z })
        }
        _ => unclear(),
    }
}

/// Whether the names of x, y and z follow that of an index of lines, which may be empty.
pub(super) fn have_index(line: &str) -> bool {
    let all = all_cells(line);
    all.len() == 4 && !all[0].starts_with(['x', 'X'])
}

/// The cells of the three columns; `None` of another number of columns.
fn cells(line: &str) -> Option<[String; 3]> {
    let mut cells = all_cells(line);
    if have_index(line) {
        cells.remove(0);
    }
    cells.try_into().ok()
}

fn all_cells(line: &str) -> Vec<String> {
    let plain = |cell: &str| cell.trim().trim_matches('"').to_owned();
    if let Some(separator) = [';', '\t', ','].into_iter().find(|&separator| line.contains(separator)) {
        return line.split(separator).map(plain).collect();
    }
    let mut cells: Vec<String> = Vec::new();
    for word in line.split_whitespace() {
        match cells.last_mut() {
            Some(last) if word.starts_with(['[', '(', '/']) || last.ends_with('/') => last.push_str(word),
            _ => cells.push(plain(word)),
        }
    }
    cells
}

enum Unit {
    None,
    Length(f64),
    Other,
}

/// The unit in the name of a column: in brackets, behind a slash, or behind an underscore or a blank if it is one of length.
fn unit_of(cell: &str) -> Unit {
    let length = |word: &str| Dimension::Length.factor(word);
    let stated = |word: &str| length(word).map_or(Unit::Other, Unit::Length);
    if let Some((_, unit)) = cell.split_once(['[', '(']) {
        return stated(unit.trim_end().trim_end_matches([']', ')']));
    }
    if let Some((_, unit)) = cell.split_once('/') {
        return stated(unit);
    }
    let last = cell.rsplit_once(['_', ' ']).map(|(_, last)| last);
    last.and_then(length).map_or(Unit::None, Unit::Length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    fn separation(lines: &[(usize, &str)]) -> Separation {
        Separation::new(lines, Count::new(&Silent, 1.0, 1)).unwrap()
    }

    #[test]
    fn a_count_begins_at_zero_or_one() {
        assert!(is_count(&[0.0, 1.0, 2.0, 3.0]) && is_count(&[1.0, 2.0, 3.0, 4.0]));
        for values in
            [&[0.0, 1.0, 2.0][..], &[2.0, 3.0, 4.0, 5.0], &[0.0, 1.0, 2.0, 3.5], &[0.0, f64::NAN, 2.0, 3.0]]
        {
            assert!(!is_count(values), "{values:?}");
        }
    }

    #[test]
    fn coordinates_are_equally_spaced_to_their_last_digit() {
        let spaced = |words: &str| {
            let words: Vec<&str> = words.split(' ').collect();
            spacing(&words, &separation(&[(1, "0.5 1")]))
        };
        let close = |words: &str, step: f64| (spaced(words).unwrap() - step).abs() < 2e-3 * step.abs();
        assert!(close("0.00 0.80 1.60 2.40 3.20 4.00 4.80 5.60", 0.8));
        assert!(close("0 0.33 0.67 1 1.33 1.67 2 2.33", 1.0 / 3.0), "rounded");
        assert!(close("3.5e-3 3e-3 2.5e-3 2e-3 1.5e-3 1e-3 5e-4 0", -5e-4), "descending");
        for words in [
            "0.00 0.80 1.60 2.40 3.20 4.00 4.80",
            "0.00 0.80 1.60 2.40 3.22 4.00 4.80 5.60",
            "0 0.1 0.2 0.2 0.4 0.5 0.6 0.7",
            "1.0 1.0 1.0 1.0 1.0 1.0 1.0 1.0",
            "0 0.1 0.2 nan 0.4 0.5 0.6 0.7",
        ] {
            assert_eq!(spaced(words), None, "{words}");
        }
    }

    fn named(line: &str) -> NamedUnits {
        units(line, Some((1, line)))
    }

    #[test]
    fn units_stand_in_names_in_every_usual_way() {
        for line in [
            "x [um]  y [um]  z [nm]",
            "x[um] y[um] z[nm]",
            "x (µm), y (µm), height (nm)",
            "x_um,y_um,z_nm",
            ",x_um,y_um,z_nm",
            "\"X/um\";\"Y/um\";\"Z/nm\"",
            "X / um\tY / um\tZ / nm",
            "x um, y um, z nm",
            "x [micron] y [micron] z [nm]",
        ] {
            assert_eq!(named(line), NamedUnits::Known(LengthUnits { xy: 1e-6, z: 1e-9 }), "{line}");
        }
        let comment = "# made by us\n# x [um] y [um] z [nm]\n1 2 3\n";
        let known = units(comment, Some((3, "1 2 3")));
        assert_eq!(known, NamedUnits::Known(LengthUnits { xy: 1e-6, z: 1e-9 }));
    }

    #[test]
    fn names_without_units_and_units_that_are_not_clear() {
        for line in ["x y z", "X;Y;Z", "x_pos,y_pos,z_pos", "1 2 3"] {
            assert_eq!(named(line), NamedUnits::None, "{line}");
        }
        for line in ["x [um] y [um] z", "x [um] y [mm] z [nm]", "x [um] y [um] z [V]", "x y z [nm]"] {
            assert!(matches!(named(line), NamedUnits::Unclear { line: 1, .. }), "{line}");
        }
        let comment = "# xenon yields zero volts (in V)\n1 2 3\n";
        assert_eq!(units(comment, Some((2, "1 2 3"))), NamedUnits::None);
    }
}
