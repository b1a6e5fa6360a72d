//! Labels of a matrix in a text that are no heights: a line of names or numbers of its columns, and a column of numbers or
//! names of its lines, as tables of other programs have them.

use super::separation::Separation;
use super::table::is_missing;

/// Fewer in a line may be heights by chance.
const FEWEST: usize = 4;

/// The first word of a line that is neither a number nor a mark of a missing point.
pub(super) fn first_name(line: &str) -> Option<&str> {
    let mut words = line.split([' ', '\t', ',', ';']).map(|word| word.trim_matches('"'));
    words.find(|word| {
        !is_missing(word) && !word.contains(|c: char| c.is_ascii_digit()) && word.parse::<f64>().is_err()
    })
}

/// The number of the first line where it names the columns of the lines below it, which hold numbers, and whether the first
/// column holds numbers or names of lines.
pub(super) fn names(lines: &[(usize, &str)]) -> Option<(usize, bool)> {
    let [(number, header), below @ ..] = lines else { return None };
    let separation = Separation::new(below).ok()?;
    let name = |word: &str| separation.value(word).is_none();
    let header: Vec<&str> = separation.words(header).collect();
    let first: Vec<&str> = separation.words(below.first()?.1).collect();
    let has_corner = has_corner(header.len(), first.len(), header.first()?.is_empty())?;
    let columns = if header.len() == first.len() && has_corner { &header[1..] } else { &header[..] };
    let numbers: Vec<f64> = columns.iter().filter_map(|word| word.parse().ok()).collect();
    let is_named = columns.iter().all(|word| name(word));
    // A name in the corner, numbers beside it.
    let is_numbered = || {
        columns.len() >= FEWEST
            && name(columns[0])
            && numbers.len() + 1 == columns.len()
            && is_count(&numbers)
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
    (is_count(columns) && !resembles_count(heights)).then_some((*number, has_corner))
}

/// Whether the first of `columns` columns numbers the lines, unlike the column beside it.
pub(super) fn number_lines(values: &[f64], columns: usize) -> bool {
    let column = |k: usize| values.iter().skip(k).step_by(columns).copied().collect::<Vec<f64>>();
    columns >= FEWEST && is_count(&column(0)) && !resembles_count(&column(1))
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

/// Whether heights rise from one to the next by about one, as on an inclined plane of whole numbers.
fn resembles_count(heights: &[f64]) -> bool {
    let rises: Vec<f64> =
        heights.windows(2).map(|pair| pair[1] - pair[0]).filter(|rise| !rise.is_nan()).collect();
    let near = rises.iter().filter(|rise| (0.5..=1.5).contains(*rise)).count();
    !rises.is_empty() && 2 * near > rises.len()
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn heights_that_rise_like_a_count_are_heights() {
        assert!(resembles_count(&[1.0, 2.0, 3.1, 4.0]) && !resembles_count(&[0.3, 0.2, 1.4, 0.1]));
        assert!(!resembles_count(&[f64::NAN; 3]));
        let lines = [(1, "0 1 2 3 4"), (2, "1 2 3 4 5"), (3, "2 3 4 5 6")];
        assert_eq!(numbers(&lines, &Separation::new(&lines).unwrap()), None);
        let lines = [(1, "0 1 2 3 4"), (2, "5 2 9 4 5"), (3, "2 3 4 7 1")];
        assert_eq!(numbers(&lines, &Separation::new(&lines).unwrap()), Some((1, false)));
    }
}
