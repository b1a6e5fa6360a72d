//! Names of the columns x, y and z of a text, and the units in them: `x [um] y [um] z [nm]`, `x (µm), y (µm), height (nm)`,
//! `x_um,y_um,z_nm`, `X/mm;Y/mm;Z/um`.

use super::content::{LengthUnits, NamedUnits};
use super::error::shortened;
use crate::units::Dimension;

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
