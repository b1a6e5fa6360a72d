//! A medium in the gap between the bodies, which conducts heat beside the spots.

use std::ops::Deref;

use super::{Model, ReferencePlane, Response};
use crate::spot::{GapMedium, SpotQuantity};

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
