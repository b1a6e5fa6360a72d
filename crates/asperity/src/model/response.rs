//! The response of a model at one separation.

use super::plane::ReferencePlane;
use super::validity::{INTERACTION, LoadSharing};
use crate::accumulator::Total;
use crate::contact::ByRegime;
use crate::spot::SpotValues;

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
