//! Spellings of units that are accepted, with their values.

use asperity::units::Dimension;

/// Units whose factor uom rounded twice.
const ROUNDED_TWICE: [&str; 4] =
    ["gf/cm²", "gf/cm^2", "gram-force per square centimeter", "grams-force per square centimeter"];

#[test]
fn spellings_keep_their_values() {
    let mut checked = 0;
    for line in include_str!("units.csv").lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let is_named = |dimension: &Dimension| format!("{dimension:?}") == cells[0];
        let dimension = Dimension::ALL.into_iter().find(is_named).unwrap();
        let tolerance = if ROUNDED_TWICE.contains(&cells[1]) { 1.5 * f64::EPSILON } else { 0.0 };
        for (number, value) in ["1.2", "12.345e-3"].into_iter().zip(&cells[2..]) {
            let found = dimension.parse(&format!("{number} {}", cells[1])).unwrap_or(f64::NAN);
            let known: f64 = value.parse().unwrap();
            assert!((found - known).abs() <= tolerance * known, "{line}: {found:e}");
            checked += 1;
        }
    }
    assert_eq!(checked, 2 * 508);
}
