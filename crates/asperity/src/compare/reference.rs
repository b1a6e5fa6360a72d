//! The boundary element reference of a comparison, in the terms of the models: its results at loads, beside a
//! [`Comparison`](super::Comparison) of two models on the same surface.

use super::{ComparedQuantity, ContactResult, Control, State};
use crate::bem::Boundary;
use crate::model::Response;
use crate::spot::SpotValues;

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
    /// -dp/dd of its fixed contact points ([`Tangent`](crate::bem::Tangent)), Pa/m; `None` where there is no separation, and
    /// where no point may change its pressure.
    pub stiffness: Option<f64>,
    /// Conductances per nominal area (S/m^2, W/(m^2 K)) and shear stress (Pa), as in [`Response::spots`]; 0 where there is none.
    pub spots: SpotValues,
    /// The conductances of a finite map between half-spaces, electrical (S/m^2) and thermal (W/(m^2 K)), over its nominal area: the resistance
    /// holds that of the map as a whole, so that they do not compare with the models'. 0 where there is none.
    pub of_cluster: [f64; 2],
    /// Bounds of the errors of solver and discretisation, of d/sigma and the logarithms of the others.
    pub bounds: State,
    /// Relative dual gap.
    pub error: f64,
    /// Steps of the solver.
    pub steps: usize,
    /// Convolutions of the solver.
    pub convolutions: usize,
}

impl From<&ReferencePoint> for ContactResult {
    fn from(point: &ReferencePoint) -> Self {
        let &ReferencePoint { pressure, separation_over_sigma, area_ratio, stiffness, spots, .. } = point;
        Self { pressure, separation_over_sigma, area_ratio, stiffness, spots }
    }
}

impl ReferencePoint {
    /// A model's result over the reference's at the same load, as a [contrast](super::ComparedQuantity::contrast); `None` where
    /// one of them has none.
    pub fn contrast(&self, quantity: ComparedQuantity, model: &Response) -> Option<f64> {
        quantity.contrast_between(quantity.value(model), self.value(quantity))
    }

    /// Its value of a quantity.
    pub fn value(&self, quantity: ComparedQuantity) -> Option<f64> {
        quantity.value(self)
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
    /// The part of an increase of the load that it carries, hence of the stiffness: 1 over all blocks; 0 without a stiffness.
    pub stiffness_share: f64,
    /// Its part of the sums over spots.
    pub spots: SpotValues,
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
    /// The conductances per nominal area, electrical (S/m^2) and thermal (W/(m^2 K)), of the spots of the sum as a cluster
    /// ([`cluster_conductance`](crate::spot::cluster_conductance)) at each of the points, 0 where there is none; empty unless the map is finite.
    pub clusters: Vec<[f64; 2]>,
    /// Loads (Pa) at or above the largest pressure, which no contact carries.
    pub unreached: Vec<f64>,
}

impl ReferenceCurve {
    /// The result at the nominal pressure `pressure` (Pa).
    pub fn at_load(&self, pressure: f64) -> Option<&ReferencePoint> {
        self.points.iter().find(|point| point.pressure == pressure)
    }
}
