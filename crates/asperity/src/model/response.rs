//! The response of a model at one separation: the plane that this is measured from, and the medium in the gap.

use std::ops::Deref;

use super::Model;
use super::validity::{INTERACTION, LoadSharing};
use crate::accumulator::Total;
use crate::asperity::{Asperities, Population, Statistics, mean_and_sigma};
use crate::contact::ByRegime;
use crate::spot::{GapMedium, SpotQuantity, SpotValues};

/// The response of a rough surface at one separation, per nominal area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// d/sigma.
    pub separation_over_sigma: f64,
    /// d, m, from the mean asperity height.
    pub separation: f64,
    /// Contacts per nominal area, 1/m^2.
    pub contact_density: f64,
    /// Real over nominal contact area, by regime.
    pub area_ratio: ByRegime,
    /// Nominal pressure, Pa, by regime.
    pub pressure: ByRegime,
    /// -dp/dd, Pa/m.
    pub stiffness: f64,
    /// By [`SpotQuantity`](crate::spot::SpotQuantity), per nominal area: conductances (S/m^2 and W/(m^2 K)) and shear stress (Pa); 0 where they are not asked for.
    pub spots: SpotValues,
    /// Standard errors of a sum; `None` for an integral.
    pub sampling: Option<SamplingError>,
    /// How the contacts of a sum share the load; `None` for an integral, and without contact.
    pub sharing: Option<LoadSharing>,
}

/// Standard errors of a sum at a fixed separation, with its asperities taken as a fixed number of independent draws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SamplingError {
    /// Standard error of the nominal pressure, Pa.
    pub pressure: f64,
    /// Standard error of the area ratio.
    pub area_ratio: f64,
}

impl Response {
    /// Standard error of d/sigma at a fixed load, if the response has standard errors; `sigma` (m) is the unit of d.
    pub fn separation_error(&self, sigma: f64) -> Option<f64> {
        self.sampling.map(|error| error.pressure / (self.stiffness * sigma))
    }

    /// The response at separation `h` = d/sigma from the sums `total` times `per_area` (1/m^2).
    pub(super) fn new(h: f64, plane: ReferencePlane, total: &Total, per_area: f64) -> Self {
        Self {
            separation_over_sigma: h,
            separation: h * plane.sigma,
            contact_density: total.contacts() * per_area,
            area_ratio: ByRegime(total.area().0.map(|area| area * per_area)),
            pressure: ByRegime(total.load().0.map(|load| load * per_area)),
            stiffness: total.stiffness() * per_area,
            spots: total.spots().unwrap_or_default().map(|sum| sum * per_area),
            sampling: None,
            sharing: None,
        }
    }

    /// The response at separation `h` = d/sigma of the sum `total` over `count` asperities on a `nominal_area` (m^2).
    pub fn of_sum(h: f64, plane: ReferencePlane, total: &Total, count: usize, nominal_area: f64) -> Self {
        let per_area = nominal_area.recip();
        let sampling = SamplingError {
            pressure: total.load_error(count) * per_area,
            area_ratio: total.area_error(count) * per_area,
        };
        let sharing = LoadSharing::new(total);
        Self { sampling: Some(sampling), sharing, ..Self::new(h, plane, total, per_area) }
    }

    /// Mean pressure on the real contact area, Pa; `None` without contact.
    pub fn mean_real_pressure(&self) -> Option<f64> {
        let area = self.area_ratio.total();
        (area > 0.0).then(|| self.pressure.total() / area)
    }

    /// Radius of a circular contact of the mean area, m; `None` without contact.
    pub fn mean_contact_radius(&self) -> Option<f64> {
        let area = self.area_ratio.total() / self.contact_density;
        area.is_finite().then(|| (area / std::f64::consts::PI).sqrt())
    }

    /// Whether the area ratio exceeds [`INTERACTION`].
    pub fn is_beyond_model(&self) -> bool {
        self.area_ratio.total() > INTERACTION
    }
}

/// A medium in the gap above one surface: a layer as thick as the mean gap of the deformed surfaces, in parallel with the spots. On a surface
/// without end that is the separation and the height of its plane above the mean plane. Since 1 over the gap is larger in the mean than 1 over
/// the mean gap, it is a lower bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// The medium.
    pub gap: GapMedium,
    /// Height of the plane that separations are measured from above the mean plane of the surface, m.
    pub offset: f64,
}

impl Medium {
    /// Conductance per nominal area (W/(m^2 K)) at a separation (m); 0 where the planes overlap, which no gap describes.
    pub fn conductance(&self, separation: f64) -> f64 {
        let gap = separation + self.offset;
        if gap > 0.0 { self.gap.conductance(gap) } else { 0.0 }
    }

    /// Adds it to a response.
    pub(crate) fn add_to(&self, response: &mut Response) {
        response.spots[SpotQuantity::ThermalConductance as usize] += self.conductance(response.separation);
    }
}

/// A model with a medium in the gap.
pub(crate) struct WithMedium<M> {
    pub(crate) model: M,
    pub(crate) medium: Medium,
}

impl<M: Deref<Target: Model> + Sync> Model for WithMedium<M> {
    fn plane(&self) -> ReferencePlane {
        self.model.plane()
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        let mut responses = self.model.respond_all(separations);
        responses.iter_mut().for_each(|response| self.medium.add_to(response));
        responses
    }

    fn respond_without_spots(&self, separations: &[f64]) -> Vec<Response> {
        self.model.respond_without_spots(separations)
    }

    fn may_decrease(&self) -> bool {
        self.model.may_decrease()
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        self.model.separations_at(pressures)
    }
}

/// The plane from which separations are measured, and the unit in which they are reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferencePlane {
    /// The height of separation 0, m: the mean asperity height.
    pub mean: f64,
    /// Standard deviation of the asperity heights, m.
    pub sigma: f64,
}

impl From<&Statistics> for ReferencePlane {
    fn from(statistics: &Statistics) -> Self {
        Self { mean: statistics.mean_height, sigma: statistics.sigma }
    }
}

/// The same as of the [`Statistics`] of the asperities, without the rest of these.
impl From<Asperities<'_>> for ReferencePlane {
    fn from(asperities: Asperities<'_>) -> Self {
        let (mean, sigma) = mean_and_sigma(asperities.heights());
        Self { mean, sigma }
    }
}

/// The nominal mean height and sigma of a population.
impl From<&Population> for ReferencePlane {
    fn from(population: &Population) -> Self {
        Self { mean: 0.0, sigma: population.sigma }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn air_conducts_over_the_mean_gap_and_the_jump() {
        let gap = GapMedium::new(0.026, 4e-7).unwrap();
        let medium = Medium { gap, offset: 1e-6 };
        assert!((medium.conductance(6e-7) / (0.026 / 2e-6) - 1.0).abs() < 1e-12);
        assert_eq!(medium.conductance(-1e-6), 0.0);
        assert!(GapMedium::new(0.0, 0.0).is_err() && GapMedium::new(1.0, -1.0).is_err());
    }
}
