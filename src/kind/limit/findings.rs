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

    /// The slope that theory expects of the error.
    pub const fn expected_slope(self) -> f64 {
        match self {
            Self::Random => -0.5,
            Self::Quantiles => -1.0,
        }
    }

    /// Relative error of the sets of one size: root mean square of random ones.
    pub fn error(self, point: &LimitPoint, quantity: Quantity) -> f64 {
        match self {
            Self::Random => point.scatter(quantity).1,
            Self::Quantiles => point.quantile_error(quantity),
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
}

/// The slopes for one choice of heights.
#[derive(Debug, Clone, Copy)]
pub struct SlopeRange {
    /// How the heights were taken.
    pub heights: Heights,
    pub fits: usize,
    pub mean: f64,
    /// Steepest slope.
    pub lowest: f64,
    /// Flattest slope.
    pub highest: f64,
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
                    let points = series(points, law, separation).filter(|point| point.is_fitted());
                    let errors = points.map(|point| (point.count as f64, heights.error(point, quantity)));
                    if let Some(fit) = SlopeFit::through(errors) {
                        slopes.push(Slope { law: law.to_owned(), quantity, heights, separation, fit });
                    }
                }
            }
        }
    }
    slopes
}

/// The range of the slopes for each choice of heights.
pub fn ranges(slopes: &[Slope]) -> Vec<SlopeRange> {
    let range = |heights| {
        let of_heights = slopes.iter().filter(|slope| slope.heights == heights);
        let found: Vec<f64> = of_heights.map(|slope| slope.fit.slope).collect();
        (!found.is_empty()).then(|| SlopeRange {
            heights,
            fits: found.len(),
            mean: found.iter().sum::<f64>() / found.len() as f64,
            lowest: found.iter().copied().fold(f64::MAX, f64::min),
            highest: found.iter().copied().fold(f64::MIN, f64::max),
        })
    };
    Heights::ALL.into_iter().filter_map(range).collect()
}
