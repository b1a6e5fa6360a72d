//! Spellings of units that are accepted, with their values.

use asperity::units::Dimension;

#[test]
fn spellings_keep_their_values() {
    let mut checked = 0;
    for line in include_str!("units.csv").lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let is_named = |dimension: &Dimension| format!("{dimension:?}") == cells[0];
        let dimension = Dimension::ALL.into_iter().find(is_named).unwrap();
        for (number, value) in ["1.2", "12.345e-3"].into_iter().zip(&cells[2..]) {
            let found = dimension.parse(&format!("{number} {}", cells[1])).unwrap_or(f64::NAN);
            let known: f64 = value.parse().unwrap();
            assert_eq!(found, known, "{line}");
            checked += 1;
        }
    }
    assert_eq!(checked, 2 * 172);
}

/// The longest beginning that is a number is looked for byte by byte.
#[test]
fn a_text_longer_than_any_quantity_is_none() {
    assert_eq!(Dimension::Length.parse(&format!("1.{} m", "0".repeat(300))), Some(1.0));
    let start = std::time::Instant::now();
    assert_eq!(Dimension::Length.parse(&("1".repeat(300_000) + &"x".repeat(300_000))), None);
    assert_eq!(Dimension::Length.factor(&"m".repeat(300_000)), None);
    assert!(start.elapsed().as_secs() < 1, "{:?}", start.elapsed());
}
