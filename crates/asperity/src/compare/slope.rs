//! Slopes of errors: power laws of a number of points or asperities.

use super::limit::{HeightSampling, LimitPoint, LimitQuantity};

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
