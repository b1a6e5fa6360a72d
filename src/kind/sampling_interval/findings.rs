//! What the variation of a surface shows of the gap between the models.

use asperity::compare::{ComparedQuantity, Contributions, Estimate};

use super::results::{Series, SurfaceResults};

/// The gap between the models at a scale admissible.
pub struct Gap<'a> {
    /// Sampling interval or nesting index, m.
    pub length: f64,
    /// Statistical minus deterministic.
    pub difference: Estimate,
    /// Its parts; `None` where too few contacts carry the load.
    pub parts: Option<&'a Contributions>,
}

/// The gaps in a quantity at the load of index `load`, from the finest scale.
pub fn gaps(series: &Series, load: usize, quantity: ComparedQuantity) -> Vec<Gap<'_>> {
    let gaps = series.results().filter_map(|(scale, results)| {
        let (difference, parts) = (results.difference(load, quantity)?, results.parts(load, quantity));
        Some(Gap { length: scale.length, difference, parts })
    });
    gaps.collect()
}

/// The load of a page, as an index: the highest of those at which most scales are admissible, and of these most have
/// intervals. `None` where no scale is valid at any load.
pub fn main_load(surface: &SurfaceResults, loads: &[f64]) -> Option<usize> {
    let rank = |load: usize| {
        let gaps = surface.series.iter().flat_map(|series| gaps(series, load, ComparedQuantity::Separation));
        let is_bounded: Vec<bool> = gaps.map(|gap| gap.difference.error.is_some()).collect();
        (is_bounded.len(), is_bounded.iter().filter(|bounded| **bounded).count())
    };
    (0..loads.len()).max_by_key(|&load| rank(load)).filter(|&load| rank(load).0 > 0)
}

/// Whether gaps are of one sign: `kept`; `changes` if two intervals lie on either side of zero; `cannot-tell` if one holds zero.
/// `None` of a single gap.
pub fn sign(gaps: &[Gap]) -> Option<&'static str> {
    let is_decided = |gap: &&Gap| gap.difference.contrast.abs() > gap.difference.half_width().unwrap_or(0.0);
    let signs: Vec<f64> =
        gaps.iter().filter(is_decided).map(|gap| gap.difference.contrast.signum()).collect();
    match signs.len() {
        _ if gaps.len() < 2 => None,
        _ if signs.contains(&-1.0) && signs.contains(&1.0) => Some("changes"),
        decided if decided < gaps.len() => Some("cannot-tell"),
        _ => Some("kept"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_is_kept_or_changes_only_beyond_the_intervals() {
        let gap = |&(contrast, error): &(f64, Option<f64>)| {
            let difference = Estimate {
                contrast,
                error,
                quantile: 1.0,
                bound: 0.0,
                independent_error: None,
                support: asperity::compare::Support::Sampled,
            };
            Gap { length: 1.0, difference, parts: None }
        };
        let sign = |gaps: &[(f64, Option<f64>)]| sign(&gaps.iter().map(gap).collect::<Vec<_>>());
        assert_eq!(sign(&[(0.2, Some(0.1)), (0.3, None)]), Some("kept"));
        assert_eq!(sign(&[(0.2, Some(0.1)), (-0.3, None), (-0.1, None)]), Some("changes"));
        assert_eq!(sign(&[(0.2, Some(0.1)), (-0.3, Some(0.4)), (0.1, None)]), Some("cannot-tell"));
        assert_eq!(sign(&[(0.2, None)]), None);
    }
}
