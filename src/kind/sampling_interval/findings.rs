//! What the variation of a surface shows of the gap between the models: whether it keeps its sign, and which cause leads.

use asperity::compare::{Cause, ComparedQuantity};

use super::results::{ScaleResults, Series, SurfaceResults};

/// The load of a page, as an index: the highest of those at which most scales are within the valid range, and of these most have
/// intervals. `None` where no scale is valid at any load.
pub fn main_load(surface: &SurfaceResults) -> Option<usize> {
    let all = || surface.series.iter().flat_map(Series::results).map(|(_, results)| results);
    let rank = |load: usize| {
        let differences = all().filter_map(|results| results.difference(load, ComparedQuantity::Separation));
        let is_bounded: Vec<bool> = differences.map(|difference| difference.error.is_some()).collect();
        (is_bounded.len(), is_bounded.iter().filter(|bounded| **bounded).count())
    };
    let loads = all().map(|results| results.case.differences.len()).max()?;
    let best = (0..loads).max_by_key(|&load| rank(load))?;
    (rank(best).0 > 0).then_some(best)
}

/// The gap between the models in a quantity at a load over the scales.
#[derive(Debug)]
pub struct GapFindings {
    /// Scales within the valid range.
    pub scales: usize,
    /// The smallest and the largest gap, as they are reported.
    pub range: [f64; 2],
    /// See [`sign`].
    pub sign: Option<&'static str>,
    /// The causes that lead somewhere, from the finest scale.
    pub causes: Vec<Cause>,
    /// Scales at which a cause leads.
    pub scales_with_cause: usize,
}

impl GapFindings {
    /// Of a quantity at the load of index `load`; `None` where no scale is valid.
    pub fn new(series: &Series, load: usize, quantity: ComparedQuantity) -> Option<Self> {
        let gap = |results: &ScaleResults| {
            let estimate = results.difference(load, quantity)?;
            Some((estimate.contrast, estimate.half_width()))
        };
        let gaps: Vec<(f64, Option<f64>)> =
            series.results().filter_map(|(_, results)| gap(results)).collect();
        let reported = || gaps.iter().map(|(gap, _)| quantity.reported(*gap));
        let leading: Vec<Cause> =
            series.results().filter_map(|(_, results)| results.parts(load, quantity)?.leading()).collect();
        let mut causes: Vec<Cause> = Vec::new();
        for cause in &leading {
            if !causes.contains(cause) {
                causes.push(*cause);
            }
        }
        (!gaps.is_empty()).then(|| Self {
            scales: gaps.len(),
            range: [reported().fold(f64::INFINITY, f64::min), reported().fold(f64::NEG_INFINITY, f64::max)],
            sign: sign(&gaps),
            causes,
            scales_with_cause: leading.len(),
        })
    }
}

/// Whether gaps, each with the half-width of its interval, are of one sign: `kept`; `changes` if two intervals lie on either side of
/// zero; `cannot-tell` if one holds zero. `None` of a single gap.
fn sign(gaps: &[(f64, Option<f64>)]) -> Option<&'static str> {
    let beyond_zero: Vec<f64> =
        gaps.iter().filter(|(gap, half)| gap.abs() > half.unwrap_or(0.0)).map(|(gap, _)| *gap).collect();
    let has_both = beyond_zero.iter().any(|gap| *gap < 0.0) && beyond_zero.iter().any(|gap| *gap > 0.0);
    match beyond_zero.len() {
        _ if gaps.len() < 2 => None,
        _ if has_both => Some("changes"),
        decided if decided < gaps.len() => Some("cannot-tell"),
        _ => Some("kept"),
    }
}

#[cfg(test)]
mod tests {
    use super::sign;

    #[test]
    fn a_sign_is_kept_or_changes_only_beyond_the_intervals() {
        assert_eq!(sign(&[(0.2, Some(0.1)), (0.3, None)]), Some("kept"));
        assert_eq!(sign(&[(0.2, Some(0.1)), (-0.3, None), (-0.1, None)]), Some("changes"));
        assert_eq!(sign(&[(0.2, Some(0.1)), (-0.3, Some(0.4)), (0.1, None)]), Some("cannot-tell"));
        assert_eq!(sign(&[(0.2, None)]), None);
    }
}
