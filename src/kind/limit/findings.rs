//! How fast the sum approaches the integral: power laws fitted to its errors.

use asperity::compare::{LimitPoint, Quantity, SlopeFit};

/// How the heights of a set are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heights {
    /// Independent draws.
    Random,
    /// At the quantiles.
    Quantiles,
}

impl Heights {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Random, Self::Quantiles];

    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Quantiles => "quantiles",
        }
    }

    /// Relative error of the sets of one size: root mean square of random ones.
    pub fn error(self, point: &LimitPoint, quantity: Quantity) -> f64 {
        match self {
            Self::Random => point.scatter(quantity).1,
            Self::Quantiles => point.quantile_error(quantity),
        }
    }

    /// The slope that theory expects of the errors at these points: n^-1/2 of random sets, and that of the leading
    /// term of sets at the quantiles.
    fn expected_slope<'a>(
        self,
        points: impl Iterator<Item = &'a LimitPoint>,
        quantity: Quantity,
    ) -> Option<f64> {
        match self {
            Self::Random => Some(-0.5),
            Self::Quantiles => {
                let errors =
                    points.map(|point| (point.count as f64, point.expected_quantile_error(quantity)));
                Some(SlopeFit::through(errors)?.slope)
            }
        }
    }
}

#[derive(Debug, Clone)]
pub struct Slope {
    /// The law, as tables name it.
    pub law: String,
    /// Area or load.
    pub quantity: Quantity,
    /// How the heights were taken.
    pub heights: Heights,
    /// d/sigma.
    pub separation: f64,
    pub fit: SlopeFit,
    /// The slope that theory expects over the fitted numbers of asperities.
    pub expected: f64,
}

/// The slopes for one choice of heights and one quantity.
#[derive(Debug, Clone, Copy)]
pub struct SlopeRange {
    /// How the heights were taken.
    pub heights: Heights,
    /// Area or load.
    pub quantity: Quantity,
    pub fits: usize,
    pub mean: f64,
    /// Steepest slope.
    pub lowest: f64,
    /// Flattest slope.
    pub highest: f64,
    /// Mean of the expected slopes.
    pub expected: f64,
    /// Largest difference between a slope and its expected one.
    pub largest_deviation: f64,
}

/// The points of one law at one separation (d/sigma), by growing size.
pub fn series<'a>(
    points: &'a [LimitPoint],
    law: &'a str,
    separation: f64,
) -> impl Iterator<Item = &'a LimitPoint> {
    points
        .iter()
        .filter(move |point| point.law == law && point.exact.statistical.separation_over_sigma == separation)
}

/// All slopes: law by law, separation by separation.
pub fn slopes<'a>(
    points: &[LimitPoint],
    laws: impl IntoIterator<Item = &'a str>,
    separations: &[f64],
) -> Vec<Slope> {
    let mut slopes = Vec::new();
    for law in laws {
        for &separation in separations {
            for quantity in Quantity::ALL {
                for heights in Heights::ALL {
                    let fitted = || series(points, law, separation).filter(|point| point.is_fitted());
                    let errors = fitted().map(|point| (point.count as f64, heights.error(point, quantity)));
                    let fit = SlopeFit::through(errors);
                    let expected = heights.expected_slope(fitted(), quantity);
                    if let (Some(fit), Some(expected)) = (fit, expected) {
                        let law = law.to_owned();
                        slopes.push(Slope { law, quantity, heights, separation, fit, expected });
                    }
                }
            }
        }
    }
    slopes
}

/// The range of the slopes for each choice of heights and each quantity.
pub fn ranges(slopes: &[Slope]) -> Vec<SlopeRange> {
    let range = |heights, quantity| {
        let is_of = |slope: &&Slope| slope.heights == heights && slope.quantity == quantity;
        let of_both: Vec<&Slope> = slopes.iter().filter(is_of).collect();
        let fits = of_both.len();
        let found = || of_both.iter().map(|slope| slope.fit.slope);
        let deviations = of_both.iter().map(|slope| (slope.fit.slope - slope.expected).abs());
        (fits > 0).then(|| SlopeRange {
            heights,
            quantity,
            fits,
            mean: found().sum::<f64>() / fits as f64,
            lowest: found().fold(f64::MAX, f64::min),
            highest: found().fold(f64::MIN, f64::max),
            expected: of_both.iter().map(|slope| slope.expected).sum::<f64>() / fits as f64,
            largest_deviation: deviations.fold(0.0, f64::max),
        })
    };
    let both = Heights::ALL.into_iter().flat_map(|heights| Quantity::ALL.map(|quantity| (heights, quantity)));
    both.filter_map(|(heights, quantity)| range(heights, quantity)).collect()
}
