//! The quantities that are followed over the sampling interval.

use asperity::compare::{Accepted, ComparedQuantity, State};
use asperity::{Statistics, named_enum};

named_enum! {
    /// A quantity of the asperities, or of both models at a load.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum TrendQuantity {
        /// Asperities per nominal area.
        Density = "density",
        /// Arithmetic mean of the radii.
        MeanRadius = "mean-radius",
        /// 1/(mean curvature).
        RadiusOfMeanCurvature = "radius-of-mean-curvature",
        /// Standard deviation of the heights of the asperities.
        Sigma = "sigma",
        /// Nayak's bandwidth parameter of the map.
        Alpha = "nayak-alpha",
        /// Standard deviation of the radii over their mean.
        RadiusSpread = "radius-cv",
        /// Correlation of heights and radii.
        Correlation = "height-radius-correlation",
        /// Greenwood and Williamson's.
        PlasticityIndex = "plasticity-index",
        /// Real area over nominal area by the sum.
        DeterministicArea = "deterministic-area",
        /// Real area over nominal area by the integral.
        StatisticalArea = "statistical-area",
        /// d/sigma by the integral less that by the sum.
        SeparationGap = "separation-gap",
        /// Logarithm of the area by the integral over that by the sum.
        AreaGap = "area-gap",
    }
}

/// The asperities of a map, or of a part of it.
#[derive(Debug, Clone)]
pub struct Asperities {
    /// 1/m^2.
    pub density: f64,
    /// Of heights and radii.
    pub statistics: Statistics,
    /// Nayak's bandwidth parameter of the map, by differences at its interval; `None` of a flat one, and of a part.
    pub alpha: Option<f64>,
    /// Greenwood and Williamson's; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
}

impl TrendQuantity {
    /// Whether it is of both models at a load.
    pub const fn is_at_load(self) -> bool {
        matches!(self, Self::DeterministicArea | Self::StatisticalArea | Self::SeparationGap | Self::AreaGap)
    }

    /// Whether it is positive, so that it changes by a factor and may follow a power law.
    pub const fn is_positive(self) -> bool {
        !matches!(self, Self::Correlation | Self::SeparationGap | Self::AreaGap)
    }

    /// The largest change that does not matter: of a gap what the spec accepts, of a correlation 0.05, of anything else 5 %.
    pub fn tolerance(self, accepted: &Accepted) -> f64 {
        const SHARE: f64 = 0.05;
        match self {
            Self::SeparationGap => accepted.separation,
            Self::AreaGap => accepted.area.ln_1p(),
            Self::Correlation => SHARE,
            _ => SHARE.ln_1p(),
        }
    }

    /// A change relative to the quantity, of an area gap to the area by the sum; `None` of what is not changed by a factor.
    pub fn relative(self, change: f64) -> Option<f64> {
        (!matches!(self, Self::Correlation | Self::SeparationGap)).then(|| change.exp_m1())
    }

    /// Its value, or the logarithm of what is positive; `None` at a load, and of what is not defined.
    pub fn of_asperities(self, asperities: &Asperities) -> Option<f64> {
        let statistics = &asperities.statistics;
        let value = match self {
            Self::Density => Some(asperities.density),
            Self::MeanRadius => Some(statistics.mean_radius),
            Self::RadiusOfMeanCurvature => Some(statistics.radius_of_mean_curvature),
            Self::Sigma => Some(statistics.sigma),
            Self::Alpha => asperities.alpha,
            Self::RadiusSpread => Some(statistics.radius_cv),
            Self::Correlation => return statistics.height_radius_correlation,
            Self::PlasticityIndex => asperities.plasticity_index,
            Self::DeterministicArea | Self::StatisticalArea | Self::SeparationGap | Self::AreaGap => None,
        };
        value.filter(|value| *value > 0.0).map(f64::ln)
    }

    /// The same of both models at a load; `None` of a quantity of the asperities.
    pub fn of_models(self, [integral, sum]: [State; 2]) -> Option<f64> {
        let [separation, area] = [ComparedQuantity::Separation, ComparedQuantity::Area].map(|k| k as usize);
        match self {
            Self::DeterministicArea => Some(sum[area]),
            Self::StatisticalArea => Some(integral[area]),
            Self::SeparationGap => Some(integral[separation] - sum[separation]),
            Self::AreaGap => Some(integral[area] - sum[area]),
            _ => None,
        }
    }
}
