//! The largest thickness at which a layer has no effect.

/// The range searched, m.
const RANGE: [f64; 2] = [1e-12, 1.0];

/// Ratio of the two thicknesses that bracket the result.
const BRACKET_RATIO: f64 = 1.01;

/// The thickness (m) below which a layer does not matter. `listed` are ascending thicknesses and whether each matters;
/// a thickness of 0 does not. The search is between the thinnest listed thickness that matters and the one before, or
/// in decades beyond the list, and assumes a single transition in between. Infinite if no thickness matters, `None` if
/// a picometre still does.
pub fn threshold(listed: &[(f64, bool)], matters: impl Fn(f64) -> bool) -> Option<f64> {
    let first = listed.iter().position(|(_, matters)| *matters);
    let mut thick = first.map_or(f64::INFINITY, |first| listed[first].0);
    let below = &listed[..first.unwrap_or(listed.len())];
    let mut thin = below.iter().map(|(t, _)| *t).filter(|t| t.is_finite()).fold(0.0, f64::max);
    if thick == f64::INFINITY {
        // In decades, up from the last one that does not matter.
        let mut trial = if thin > 0.0 { 10.0 * thin } else { RANGE[0] };
        while !matters(trial) {
            thin = trial;
            trial *= 10.0;
            if trial > RANGE[1] {
                return Some(f64::INFINITY);
            }
        }
        thick = trial;
    }
    while thin == 0.0 {
        let trial = 0.1 * thick;
        if trial < RANGE[0] {
            return None;
        }
        if matters(trial) { thick = trial } else { thin = trial }
    }
    while thick > BRACKET_RATIO * thin {
        let middle = (thin * thick).sqrt();
        if matters(middle) { thick = middle } else { thin = middle }
    }
    Some((thin * thick).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_two_listed_thicknesses_or_beyond_them() {
        let matters = |t: f64| t > 3e-8;
        let lists: [&[f64]; 6] = [
            &[0.0, 1e-9],
            &[0.0, 1e-8, 1e-7, f64::INFINITY],
            &[0.0, 1e-6],
            &[0.0, 1e-9, f64::INFINITY],
            &[0.0, f64::INFINITY],
            &[1e-7, 1e-6],
        ];
        for list in lists {
            let listed: Vec<(f64, bool)> = list.iter().map(|&t| (t, matters(t))).collect();
            let found = threshold(&listed, matters).unwrap();
            assert!((found / 3e-8 - 1.0).abs() < 0.01, "{list:?}: {found:e}");
        }
    }

    #[test]
    fn none_matters_or_all_do() {
        assert_eq!(threshold(&[(0.0, false), (1e-7, false)], |_| false), Some(f64::INFINITY));
        assert_eq!(threshold(&[(0.0, false), (1e-7, true)], |_| true), None);
        assert_eq!(threshold(&[(0.0, false), (f64::INFINITY, true)], |_| false), Some(f64::INFINITY));
    }

    /// The first thickness that matters counts, also if thicker layers do not matter.
    #[test]
    fn the_thinnest_layer_that_matters_counts() {
        let listed = [(0.0, false), (1e-8, false), (1e-7, true), (1e-6, false), (1e-5, true)];
        let found = threshold(&listed, |t| (2e-8..5e-7).contains(&t) || t > 5e-6).unwrap();
        assert!((found / 2e-8 - 1.0).abs() < 0.01);
    }
}
