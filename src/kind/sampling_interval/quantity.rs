//! The quantities that are followed over the sampling interval.

use asperity::Statistics;
use asperity::compare::Accepted;

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
    AreaOfSum,
    /// Real area over nominal area by the integral.
    AreaOfIntegral,
    /// d/sigma by the integral less that by the sum.
    SeparationGap,
    /// Logarithm of the area by the integral over that by the sum.
    AreaGap,
}

impl Quantity {
    /// Number of [`Self::ALL`].
    pub const COUNT: usize = 12;

    /// All quantities.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Density,
        Self::MeanRadius,
        Self::RadiusOfMeanCurvature,
        Self::Sigma,
        Self::Alpha,
        Self::RadiusSpread,
        Self::Correlation,
        Self::PlasticityIndex,
        Self::AreaOfSum,
        Self::AreaOfIntegral,
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
            Self::AreaOfSum => "deterministic-area",
            Self::AreaOfIntegral => "statistical-area",
            Self::SeparationGap => "separation-gap",
            Self::AreaGap => "area-gap",
        }
    }

    /// The name in sentences.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Density => "asperity density",
            Self::MeanRadius => "mean radius",
            Self::RadiusOfMeanCurvature => "1/(mean curvature)",
            Self::Sigma => "σ of the asperities",
            Self::Alpha => "Nayak's α",
            Self::RadiusSpread => "relative spread of radii",
            Self::Correlation => "height-radius correlation",
            Self::PlasticityIndex => "plasticity index",
            Self::AreaOfSum => "area of the sum",
            Self::AreaOfIntegral => "area of the integral",
            Self::SeparationGap => "gap in separation",
            Self::AreaGap => "gap in area",
        }
    }

    /// Whether it is of both models at a load.
    pub const fn is_at_load(self) -> bool {
        matches!(self, Self::AreaOfSum | Self::AreaOfIntegral | Self::SeparationGap | Self::AreaGap)
    }

    /// Whether it is positive, so that it changes by a factor and may follow a power law.
    pub const fn is_positive(self) -> bool {
        !matches!(self, Self::Correlation | Self::SeparationGap | Self::AreaGap)
    }

    /// The largest change that does not matter, on the scale of [`super::results::Found::value`]: of a gap what the spec accepts, of a
    /// correlation 0.05, of anything else 5 %.
    pub fn tolerance(self, accepted: &Accepted) -> f64 {
        const SHARE: f64 = 0.05;
        match self {
            Self::SeparationGap => accepted.separation,
            Self::AreaGap => accepted.area.ln_1p(),
            Self::Correlation => SHARE,
            _ => SHARE.ln_1p(),
        }
    }

    /// A value on the scale of changes as a person reads it: in m, 1/m^2 or as a number; an area gap relative.
    pub fn shown(self, value: f64) -> f64 {
        match self {
            Self::Correlation | Self::SeparationGap => value,
            Self::AreaGap => value.exp_m1(),
            _ => value.exp(),
        }
    }

    /// A change on that scale as a person reads it: relative of what is positive and of an area gap.
    pub fn change_shown(self, change: f64) -> f64 {
        if matches!(self, Self::Correlation | Self::SeparationGap) { change } else { change.exp_m1() }
    }

    /// Of asperities of `density` (1/m^2) with their `statistics`, on the scale of changes; `None` at a load, and of what is not
    /// defined.
    pub fn of_asperities(
        self,
        density: f64,
        statistics: &Statistics,
        alpha: Option<f64>,
        plasticity_index: Option<f64>,
    ) -> Option<f64> {
        let positive = |value: f64| (value > 0.0).then(|| value.ln());
        match self {
            Self::Density => positive(density),
            Self::MeanRadius => positive(statistics.mean_radius),
            Self::RadiusOfMeanCurvature => positive(statistics.radius_of_mean_curvature),
            Self::Sigma => positive(statistics.sigma),
            Self::Alpha => positive(alpha?),
            Self::RadiusSpread => positive(statistics.radius_cv),
            Self::Correlation => statistics.height_radius_correlation,
            Self::PlasticityIndex => positive(plasticity_index?),
            Self::AreaOfSum | Self::AreaOfIntegral | Self::SeparationGap | Self::AreaGap => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_quantity_is_at_its_place() {
        for (place, quantity) in Quantity::ALL.into_iter().enumerate() {
            assert_eq!(quantity as usize, place, "{}", quantity.name());
        }
    }
}
