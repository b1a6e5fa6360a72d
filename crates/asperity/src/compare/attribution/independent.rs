//! The sum of every height with every radius, both condensed: a few thousand nodes of heights times a few hundred of ln(radius).

use crate::accumulator::{Accumulator, Total};
use crate::asperity::Asperities;
use crate::interface::{MicroContact, jumps};
use crate::model::{Model, ReferencePlane, Response, separations_by_descent};
use crate::numeric::condensed::{Node, condensed};
use crate::numeric::parallel;
use crate::numeric::sort::ascending;
use crate::shape::Shape;

/// Ascending heights, m, with weights.
#[derive(Debug)]
pub(super) struct WeightedHeights {
    values: Vec<f64>,
    weights: Vec<f64>,
}

impl WeightedHeights {
    /// Ascending values condensed in bins of a `width`; all of them for a width of zero.
    pub(super) fn condensed(values: &[f64], width: f64) -> Self {
        if width == 0.0 {
            return Self { values: values.to_vec(), weights: vec![1.0; values.len()] };
        }
        let nodes = condensed(values, width);
        let column = |of: fn(&Node) -> f64| nodes.iter().map(of).collect();
        Self { values: column(|node| node.value), weights: column(|node| node.weight) }
    }

    /// The indentations (m) above a separation (m), with their weights.
    fn above(&self, separation: f64) -> (Vec<f64>, &[f64]) {
        let first = self.values.partition_point(|z| *z <= separation);
        (self.values[first..].iter().map(|z| z - separation).collect(), &self.weights[first..])
    }
}

/// The mean over shapes, by their shares, of the sums over heights.
pub(super) struct Independent<'a> {
    pub(super) contact: &'a dyn MicroContact,
    pub(super) heights: &'a WeightedHeights,
    /// Shares and shapes.
    pub(super) shapes: Vec<(f64, Shape)>,
    pub(super) steps: Vec<Step>,
    pub(super) plane: ReferencePlane,
    /// m^2.
    pub(super) nominal_area: f64,
    pub(super) may_decrease: bool,
}

impl Independent<'_> {
    fn responses(&self, separations: &[f64], wants_spots: bool) -> Vec<Response> {
        /// Shapes per task. Fixed, so that results do not depend on the number of threads.
        const TASK: usize = 4;
        let above = |&h: &f64| self.heights.above(self.plane.mean + h * self.plane.sigma);
        let touching: Vec<(Vec<f64>, &[f64])> = separations.iter().map(above).collect();
        let of_task = |task: usize| -> Vec<Total> {
            let shapes = &self.shapes[task * TASK..self.shapes.len().min((task + 1) * TASK)];
            let mut weighted = Vec::new();
            let sum = |(indentations, weights): &(Vec<f64>, &[f64])| {
                let mut accumulator = Accumulator::empty(wants_spots);
                for &(share, shape) in shapes.iter().filter(|_| !weights.is_empty()) {
                    weighted.clear();
                    weighted.extend(weights.iter().map(|weight| share * weight));
                    self.contact.accumulate_weighted(indentations, &weighted, shape, &mut accumulator);
                }
                accumulator.total()
            };
            touching.iter().map(sum).collect()
        };
        let parts = parallel::map(self.shapes.len().div_ceil(TASK), of_task);
        let response = |(k, &h): (usize, &f64)| {
            let mut total = Total::empty(wants_spots);
            parts.iter().for_each(|part| total.merge(&part[k]));
            let mut response = Response::new(h, self.plane, &total, self.nominal_area.recip());
            let (indentations, weights) = &touching[k];
            for (w, weight) in indentations.iter().zip(*weights) {
                for step in &self.steps {
                    let [load, area] = step.at(*w).map(|sum| weight * sum / self.nominal_area);
                    response.pressure.0[0] += load;
                    response.area_ratio.0[0] += area;
                }
            }
            response
        };
        separations.iter().enumerate().map(response).collect()
    }
}

impl Model for Independent<'_> {
    fn plane(&self) -> ReferencePlane {
        self.plane
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        self.responses(separations, self.contact.spot_properties().is_some())
    }

    fn respond_without_spots(&self, separations: &[f64]) -> Vec<Response> {
        self.responses(separations, false)
    }

    fn may_decrease(&self) -> bool {
        self.may_decrease
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        let highest = self.heights.values.last().map_or(f64::NEG_INFINITY, |z| z - self.plane.mean);
        separations_by_descent(self, pressures, highest / self.plane.sigma)
    }
}

/// What a jump of load and area at w = `ratio` b of asperities of radius b adds where the radii stand for themselves, over what it adds
/// where their nodes do. The law has no length scale of its own: both jumps are proportional to b^2.
pub(super) struct Step {
    ratio: f64,
    /// Ascending radii, m, and the load and area of the jumps of all up to each.
    radii: Vec<f64>,
    sums: Vec<[f64; 2]>,
}

impl Step {
    /// The steps of a homogeneous flat under a law whose load or area jumps up; empty for other laws, and under a layer, whose
    /// thickness is a scale. The `shapes` are the nodes of the radii of `asperities`.
    pub(super) fn all(
        contact: &dyn MicroContact,
        shapes: &[(f64, Shape)],
        asperities: &Asperities,
    ) -> Vec<Self> {
        if contact.is_layered() {
            return Vec::new();
        }
        // Any radius serves.
        const UNIT: f64 = 1e-6;
        let sphere = Shape::sphere(UNIT);
        let jumps = contact.regime_changes(sphere).into_iter().map(|w| (w / UNIT, jumps(contact, sphere, w)));
        let jumps: Vec<(f64, [f64; 2])> = jumps.filter(|(_, jump)| *jump != [0.0; 2]).collect();
        if jumps.is_empty() || jumps.iter().any(|(_, [load, _])| *load < 0.0) {
            return Vec::new();
        }
        let count = asperities.count() as f64;
        let own = asperities.each().map(|(_, shape)| (shape.radius, shape.spheres / count));
        let nodes = shapes.iter().map(|(share, shape)| (shape.radius, -share * shape.spheres));
        let (unsorted, shares): (Vec<f64>, Vec<f64>) = own.chain(nodes).unzip();
        let order = ascending(&unsorted);
        let radii: Vec<f64> = order.iter().map(|&k| unsorted[k]).collect();
        let step = |(ratio, jump): (f64, [f64; 2])| {
            let mut sum = [0.0; 2];
            let sums = order.iter().map(|&k| {
                let square = shares[k] * (unsorted[k] / UNIT).powi(2);
                sum = [sum[0] + square * jump[0], sum[1] + square * jump[1]];
                sum
            });
            Self { ratio, sums: sums.collect(), radii: radii.clone() }
        };
        jumps.into_iter().map(step).collect()
    }

    /// Load and area at an indentation.
    fn at(&self, w: f64) -> [f64; 2] {
        let reached = self.radii.partition_point(|radius| radius * self.ratio <= w);
        if reached == 0 { [0.0; 2] } else { self.sums[reached - 1] }
    }
}
