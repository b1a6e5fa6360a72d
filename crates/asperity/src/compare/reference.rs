//! The boundary element reference of a comparison, in the terms of the models: its results at loads, beside a
//! [`Comparison`](super::Comparison) of two models on the same surface.

use super::{ComparedQuantity, Control, State};
use crate::bem::Boundary;
use crate::model::Response;

/// The reference at one load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferencePoint {
    /// What prescribes the load; the loads of a separation sweep count as prescribed pressures.
    pub control: Control,
    /// Its value, Pa or N.
    pub target: f64,
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// Mean gap between the deformed surfaces, zero at points in contact, m.
    pub mean_gap: f64,
    /// Distance of the flat from the mean plane of the undeformed heights, m.
    pub undeformed_gap: f64,
    /// The mean gap from the plane that the models measure separations from, m; `None` where it includes the compliance of
    /// a finite patch and does not compare with the models'.
    pub separation: Option<f64>,
    /// The same in the unit of the models' separations, the standard deviation of the heights.
    pub separation_over_sigma: Option<f64>,
    /// Real over nominal contact area, corrected for the perimeter of the contacts.
    pub area_ratio: f64,
    /// Points in contact over all points.
    pub raw_area_ratio: f64,
    /// Points at the largest pressure over all points.
    pub capped_area_ratio: f64,
    /// -dp/dd, Pa/m, from the neighbouring loads; `None` where these are not close enough, see [`stiffnesses`].
    pub stiffness: Option<f64>,
    /// Bounds of the errors of solver and discretisation, of d/sigma, ln(area) and ln(stiffness).
    pub bounds: State,
    /// Relative dual gap.
    pub error: f64,
    /// Steps of the solver.
    pub steps: usize,
    /// Convolutions of the solver.
    pub convolutions: usize,
}

impl ReferencePoint {
    /// A model's result over the reference's at the same load, as a [contrast](super::ComparedQuantity::contrast); `None` where
    /// one of them has none.
    pub fn contrast(&self, quantity: ComparedQuantity, model: &Response) -> Option<f64> {
        let log_ratio = |model: f64, own: f64| (model > 0.0 && own > 0.0).then(|| (model / own).ln());
        match quantity {
            ComparedQuantity::Separation => Some(model.separation_over_sigma - self.separation_over_sigma?),
            ComparedQuantity::Area => log_ratio(model.area_ratio.total(), self.area_ratio),
            ComparedQuantity::Stiffness => log_ratio(model.stiffness, self.stiffness?),
        }
    }

    /// Load over real contact area, Pa; `None` without contact.
    pub fn mean_real_pressure(&self) -> Option<f64> {
        (self.area_ratio > 0.0).then(|| self.pressure / self.area_ratio)
    }
}

/// What a block of the map contributes to the contact at one load.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BlockShare {
    /// Its part of the nominal pressure, Pa.
    pub pressure: f64,
    /// Its part of the area ratio.
    pub area_ratio: f64,
}

/// The reference on one surface under one law and thickness.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceCurve {
    /// What lies beyond the edge of the map.
    pub boundary: Boundary,
    /// The largest pressure, Pa; `None` for an elastic contact.
    pub cap: Option<f64>,
    /// Missing points of the map that were interpolated.
    pub interpolated: usize,
    /// The results, in the order of the prescribed loads.
    pub points: Vec<ReferencePoint>,
    /// What each block of the map contributes to each of these; empty where the map is not divided.
    pub blocks: Vec<Vec<BlockShare>>,
    /// Loads (Pa) at or above the largest pressure, which no contact carries.
    pub unreached: Vec<f64>,
}

impl ReferenceCurve {
    /// The result at the nominal pressure `pressure` (Pa).
    pub fn at_load(&self, pressure: f64) -> Option<&ReferencePoint> {
        self.points.iter().find(|point| point.pressure == pressure)
    }
}

/// The largest ratio of neighbouring loads between which a stiffness is formed: d is nearly straight over ln p, but not over
/// decades.
pub const LARGEST_LOAD_RATIO: f64 = 3.0;

/// The part of the logarithm of the slopes towards both neighbours that bounds the error of the slope between them: that of
/// a parabola is none.
const SLOPE_ERROR: f64 = 0.25;

/// A stiffness from neighbouring loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// -dp/dd, Pa/m.
    pub stiffness: f64,
    /// Bound of the error of its logarithm.
    pub bound: f64,
}

/// Loads whose ratio is smaller are not neighbours: the error of the solver would be seen in the slope.
const SMALLEST_LOAD_RATIO: f64 = 1.05;

/// The stiffness -dp/dd (Pa/m) at each of the ascending `pressures` (Pa) reached at `separations` (m): the slope of the
/// parabola of d over ln p through the load and its neighbours. `None` where there is no neighbour within a factor of
/// [`LARGEST_LOAD_RATIO`] on both sides, as at the first and the last load, and where the separation does not decrease.
pub fn stiffnesses(pressures: &[f64], separations: &[f64]) -> Vec<Option<Stiffness>> {
    let points: Vec<(f64, f64)> = pressures.iter().copied().zip(separations.iter().copied()).collect();
    let is_neighbour = |ratio: f64| {
        const ROUNDING: f64 = 1e-12;
        (SMALLEST_LOAD_RATIO..=LARGEST_LOAD_RATIO * (1.0 + ROUNDING)).contains(&ratio)
    };
    let at = |(k, &(p, d)): (usize, &(f64, f64))| {
        let &(p0, d0) = points[..k].iter().rev().find(|(lower, _)| p / lower >= SMALLEST_LOAD_RATIO)?;
        let &(p1, d1) = points[k + 1..].iter().find(|(higher, _)| higher / p >= SMALLEST_LOAD_RATIO)?;
        if !(is_neighbour(p / p0) && is_neighbour(p1 / p)) {
            return None;
        }
        let (back, ahead) = ((p / p0).ln(), (p1 / p).ln());
        let slope = (ahead / back * (d - d0) + back / ahead * (d1 - d)) / (back + ahead);
        let steepening = ((d1 - d) / ahead) / ((d - d0) / back);
        (slope < 0.0 && steepening > 0.0)
            .then(|| Stiffness { stiffness: -p / slope, bound: SLOPE_ERROR * steepening.ln().abs() })
    };
    points.iter().enumerate().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stiffness_is_exact_for_a_parabola_in_the_logarithm_of_the_load() {
        let pressures = [1e6, 1.5e6, 2.5e6, 4e6, 1.3e7];
        let d = |p: f64| -1e-8 * p.ln() - 2e-10 * p.ln() * p.ln();
        let separations = pressures.map(d);
        let found = stiffnesses(&pressures, &separations);
        for (k, &p) in pressures.iter().enumerate() {
            let exact = p / (1e-8 + 4e-10 * p.ln());
            match found[k] {
                // The ends, and the neighbour of a wide step.
                None => assert!(k == 0 || k >= 3, "{k}"),
                Some(Stiffness { stiffness, .. }) => {
                    assert!((stiffness / exact - 1.0).abs() < 1e-9, "{k}: {stiffness} {exact}")
                }
            }
        }
        assert_eq!(found.iter().flatten().count(), 2);
        // A load beside another is no neighbour of it, and has the stiffness there.
        let close = [1e6, 1.5e6, 1.5e6 * (1.0 + 1e-9), 2.5e6];
        let found = stiffnesses(&close, &close.map(d));
        let exact = 1.5e6 / (1e-8 + 4e-10 * 1.5e6_f64.ln());
        assert!(
            [1, 2].iter().all(|&k| (found[k].unwrap().stiffness / exact - 1.0).abs() < 1e-6),
            "{found:?}"
        );
    }

    #[test]
    fn there_is_none_for_one_load_wide_steps_or_a_separation_that_grows() {
        assert_eq!(stiffnesses(&[1e6], &[1e-9]), [None]);
        assert_eq!(stiffnesses(&[1e6, 1e7, 1e8], &[3e-9, 2e-9, 1e-9]), [None; 3]);
        assert_eq!(stiffnesses(&[1e6, 2e6, 3e6], &[1e-9, 2e-9, 3e-9]), [None; 3]);
        assert!(stiffnesses(&[1e6, 2e6, 4e6], &[3e-9, 2e-9, 1e-9])[1].is_some());
    }
}
