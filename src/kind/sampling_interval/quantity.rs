//! The quantities that are followed over the sampling interval.

use asperity::Statistics;
use asperity::compare::{Accepted, ComparedQuantity, State};

/// A quantity of the asperities, or of both models at a load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Asperities per nominal area.
    Density,
    /// Arithmetic mean of the radii.
    MeanRadius,
    /// 1/(mean curvature).
    RadiusOfMeanCurvature,
    /// Standard deviation of the heights of the asperities.
    Sigma,
    /// Nayak's bandwidth parameter of the map.
    Alpha,
    /// Standard deviation of the radii over their mean.
    RadiusSpread,
    /// Correlation of heights and radii.
    Correlation,
    /// Greenwood and Williamson's.
    PlasticityIndex,
    /// Real area over nominal area by the sum.
    DeterministicArea,
    /// Real area over nominal area by the integral.
    StatisticalArea,
    /// d/sigma by the integral less that by the sum.
    SeparationGap,
    /// Logarithm of the area by the integral over that by the sum.
    AreaGap,
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

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 12] = [
        Self::Density,
        Self::MeanRadius,
        Self::RadiusOfMeanCurvature,
        Self::Sigma,
        Self::Alpha,
        Self::RadiusSpread,
        Self::Correlation,
        Self::PlasticityIndex,
        Self::DeterministicArea,
        Self::StatisticalArea,
        Self::SeparationGap,
        Self::AreaGap,
    ];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::MeanRadius => "mean-radius",
            Self::RadiusOfMeanCurvature => "radius-of-mean-curvature",
            Self::Sigma => "sigma",
            Self::Alpha => "nayak-alpha",
            Self::RadiusSpread => "radius-cv",
            Self::Correlation => "height-radius-correlation",
            Self::PlasticityIndex => "plasticity-index",
            Self::DeterministicArea => "deterministic-area",
            Self::StatisticalArea => "statistical-area",
            Self::SeparationGap => "separation-gap",
            Self::AreaGap => "area-gap",
        }
    }

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
        let Asperities { density, statistics, alpha, plasticity_index } = asperities;
        let value = match self {
            Self::Correlation => return statistics.height_radius_correlation,
            Self::Density => *density,
            Self::MeanRadius => statistics.mean_radius,
            Self::RadiusOfMeanCurvature => statistics.radius_of_mean_curvature,
            Self::Sigma => statistics.sigma,
            Self::Alpha => (*alpha)?,
            Self::RadiusSpread => statistics.radius_cv,
            Self::PlasticityIndex => (*plasticity_index)?,
            Self::DeterministicArea | Self::StatisticalArea | Self::SeparationGap | Self::AreaGap => {
                return None;
            }
        };
        (value > 0.0).then(|| value.ln())
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
