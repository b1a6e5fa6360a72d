//! Scatter over realisations of one surface; slopes of errors: power laws of a number of points or asperities.

use super::limit::{HeightSampling, LimitPoint, LimitQuantity};
use super::{Pair, Pairing};

/// Mean and scatter of a quantity over realisations, or over other samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of one realisation, with divisor n - 1.
    pub deviation: f64,
}

impl Scatter {
    /// Of at least two values.
    pub(crate) fn new(values: &[f64]) -> Self {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        Self { mean, deviation: (squares / (count - 1.0)).sqrt() }
    }
}

/// Both models at one load that all realisations reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// The load, Pa.
    pub target: f64,
    /// d/sigma of the statistical model, whose population is that of each realisation.
    pub statistical_separation: Scatter,
    /// d/sigma of the deterministic model.
    pub deterministic_separation: Scatter,
    /// Statistical minus deterministic.
    pub difference: Scatter,
    /// Mean sampling error of d/sigma of the sums. Scatter beyond it comes from long wavelengths, which correlate
    /// neighbouring asperities.
    pub sampling_error: f64,
    /// A/A_nom of the statistical model.
    pub statistical_area: Scatter,
    /// A/A_nom of the deterministic model.
    pub deterministic_area: Scatter,
}

/// One realisation: its pairs, and the standard deviation of heights (m) that is the unit of d.
pub type Realisation<'a> = (&'a [Pair], f64);

/// Both models at the loads common to all realisations, ascending; empty for fewer than two realisations.
pub fn spread(realisations: &[Realisation]) -> Vec<Spread> {
    let Some(((first, _), others)) = realisations.split_first() else { return Vec::new() };
    if others.is_empty() {
        return Vec::new();
    }
    let mut targets: Vec<f64> =
        first.iter().filter(|pair| pair.pairing == Pairing::Load).map(|pair| pair.target).collect();
    targets.sort_unstable_by(f64::total_cmp);
    targets.dedup();
    targets.into_iter().filter_map(|target| at(target, realisations)).collect()
}

/// `None` where a realisation lacks the load.
fn at(target: f64, realisations: &[Realisation]) -> Option<Spread> {
    let is_it = |pair: &&Pair| pair.pairing == Pairing::Load && pair.target == target;
    let found: Option<Vec<(&Pair, f64)>> = realisations
        .iter()
        .map(|&(pairs, sigma)| pairs.iter().find(is_it).map(|pair| (pair, sigma)))
        .collect();
    let found = found?;
    let scatter = |value: &dyn Fn(&Pair) -> f64| {
        Scatter::new(&found.iter().map(|(pair, _)| value(pair)).collect::<Vec<_>>())
    };
    let errors = found.iter().filter_map(|(pair, sigma)| pair.deterministic.separation_error(*sigma));
    Some(Spread {
        target,
        statistical_separation: scatter(&|pair| pair.statistical.separation_over_sigma),
        deterministic_separation: scatter(&|pair| pair.deterministic.separation_over_sigma),
        difference: scatter(&|pair| {
            pair.statistical.separation_over_sigma - pair.deterministic.separation_over_sigma
        }),
        sampling_error: errors.sum::<f64>() / found.len() as f64,
        statistical_area: scatter(&|pair| pair.statistical.area_ratio.total()),
        deterministic_area: scatter(&|pair| pair.deterministic.area_ratio.total()),
    })
}

/// A power law fitted to errors: ln(error) = constant + slope ln(count).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlopeFit {
    /// The exponent.
    pub slope: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Points fitted.
    pub points: usize,
}

impl SlopeFit {
    /// Least squares through (count, error); `None` with fewer than three positive errors.
    pub fn through(points: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let logs: Vec<(f64, f64)> =
            points.filter(|(_, error)| *error > 0.0).map(|(count, error)| (count.ln(), error.ln())).collect();
        let n = logs.len() as f64;
        if logs.len() < 3 {
            return None;
        }
        let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
        let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
        let xx: f64 = logs.iter().map(|p| (p.0 - x0).powi(2)).sum();
        let xy: f64 = logs.iter().map(|p| (p.0 - x0) * (p.1 - y0)).sum();
        let slope = xy / xx;
        let residual: f64 = logs.iter().map(|p| (p.1 - y0 - slope * (p.0 - x0)).powi(2)).sum();
        let standard_error = (residual / (n - 2.0) / xx).sqrt();
        slope.is_finite().then_some(Self { slope, standard_error, points: logs.len() })
    }
}

/// How the error of sets decreases with the number of asperities, under one law at one separation.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorSlope {
    /// The law, as tables name it.
    pub law: String,
    /// d/sigma.
    pub separation: f64,
    /// Area or load.
    pub quantity: LimitQuantity,
    /// How the heights were taken.
    pub sampling: HeightSampling,
    /// Number of asperities and relative error of the sets with [enough contacts](LimitPoint::is_fitted).
    pub errors: Vec<(f64, f64)>,
    /// Through these errors.
    pub fit: SlopeFit,
    /// The slope that theory expects: -1/2 of random sets, and that of the leading term of sets at the quantiles.
    pub expected: f64,
}

impl ErrorSlope {
    /// Law by law, separation by separation: those of `points` that suffice for a fit.
    pub fn all(points: &[LimitPoint]) -> Vec<Self> {
        // All sets of one size follow each other.
        let series = points.iter().take_while(|point| point.count == points[0].count);
        let kinds =
            LimitQuantity::ALL.map(|quantity| HeightSampling::ALL.map(|sampling| (quantity, sampling)));
        let kinds = kinds.as_flattened();
        series.flat_map(|first| kinds.iter().filter_map(|kind| Self::through(points, first, *kind))).collect()
    }

    /// That of the points with the law and separation of `first`.
    fn through(
        points: &[LimitPoint],
        first: &LimitPoint,
        (quantity, sampling): (LimitQuantity, HeightSampling),
    ) -> Option<Self> {
        let (law, separation) = (first.law.clone(), first.separation_over_sigma());
        let fitted = points.iter().filter(|point| {
            point.law == law && point.separation_over_sigma() == separation && point.is_fitted()
        });
        let error = |point: &LimitPoint| (point.count as f64, point.error_of_sets(sampling, quantity));
        let errors: Vec<(f64, f64)> = fitted.clone().map(error).collect();
        let leading = fitted.map(|point| (point.count as f64, point.expected_quantile_error(quantity)));
        let expected = match sampling {
            HeightSampling::Random => -0.5,
            HeightSampling::Quantiles => SlopeFit::through(leading)?.slope,
        };
        let fit = SlopeFit::through(errors.iter().copied())?;
        Some(Self { law, separation, quantity, sampling, errors, fit, expected })
    }

    /// How far the slope is from the expected one.
    pub fn deviation(&self) -> f64 {
        (self.fit.slope - self.expected).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests;
    use crate::model::{Response, SamplingError};

    fn pair(target: f64, statistical: f64, deterministic: f64) -> Pair {
        let sampling = Some(SamplingError { pressure: 5.0, area_ratio: 1e-4 });
        let of = |h: f64| Response { stiffness: 1e9, sampling, ..tests::response(h, 0.1 * h, None) };
        tests::pair(target, of(statistical), of(deterministic))
    }

    #[test]
    fn loads_in_common_with_mean_and_scatter() {
        let pairs = [
            vec![pair(2.0, 3.0, 1.0), pair(1.0, 4.0, 2.0)],
            vec![pair(1.0, 4.0, 3.0)],
            vec![pair(1.0, 4.0, 4.0), pair(3.0, 1.0, 1.0)],
        ];
        let realisations: Vec<Realisation> = pairs.iter().map(|pairs| (&pairs[..], 1e-8)).collect();
        let [found] = spread(&realisations)[..] else { panic!("one load in common") };
        assert_eq!(found.target, 1.0);
        assert_eq!(found.statistical_separation, Scatter { mean: 4.0, deviation: 0.0 });
        assert_eq!(found.deterministic_separation, Scatter { mean: 3.0, deviation: 1.0 });
        assert_eq!(found.difference, Scatter { mean: 1.0, deviation: 1.0 });
        assert!((found.deterministic_area.deviation - 0.1).abs() < 1e-15);
        // 5 Pa over 1e9 Pa/m is 5e-9 m, half of sigma.
        assert!((found.sampling_error - 0.5).abs() < 1e-15);
        assert_eq!(spread(&realisations[..1]), []);
    }

    #[test]
    fn pairs_at_equal_separation_are_not_at_equal_load() {
        let separation = Pair { pairing: Pairing::Separation, ..pair(1.0, 9.0, 9.0) };
        let pairs = [vec![separation, pair(1.0, 4.0, 3.0)], vec![pair(1.0, 4.0, 3.0)], vec![separation]];
        let all: Vec<Realisation> = pairs.iter().map(|pairs| (&pairs[..], 1e-8)).collect();
        assert_eq!(spread(&all[..2])[0].difference, Scatter { mean: 1.0, deviation: 0.0 });
        assert_eq!(spread(&all), []);
    }
}
