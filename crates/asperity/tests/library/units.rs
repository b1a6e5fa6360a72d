//! Every spelling of a unit that was ever accepted, with its value.

use asperity::units::Dimension;

#[test]
fn spellings_keep_their_values() {
    let mut checked = 0;
    for line in include_str!("units.csv").lines().filter(|line| !line.starts_with('#')).skip(1) {
        let [name, spelling, values @ ..] = &line.split(',').collect::<Vec<_>>()[..] else {
            panic!("{line}")
        };
        let dimension =
            Dimension::ALL.into_iter().find(|dimension| format!("{dimension:?}") == *name).unwrap();
        for (number, value) in ["1.2", "12.345e-3"].into_iter().zip(values) {
            let found = dimension.parse(&format!("{number} {spelling}"));
            let known: f64 = value.parse().unwrap();
            // The factor of this one was rounded twice.
            let rounding = if spelling.starts_with("gf/cm") { 1.5 * f64::EPSILON } else { 0.0 };
            assert!(
                found.is_some_and(|found| (found - known).abs() <= rounding * known),
                "{line}: {found:?}"
            );
            checked += 1;
        }
    }
    assert_eq!(checked, 2 * 670);
}
