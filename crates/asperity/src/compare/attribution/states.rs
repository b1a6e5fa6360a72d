//! The states between both models.

use rayon::prelude::*;

use crate::asperity::{Asperities, AsperitySet, ByHeight, Draw, Population};
use crate::interface::{MicroContact, Shapes};
use crate::memory::{collected, filled};
use crate::model::{
    Deterministic, LOWEST_SEPARATION, Medium, Mixture, Model, ReferencePlane, Statistical, WithMedium,
};
use crate::numeric::condensed::condensed_logarithms;
use crate::shape::Shape;

use super::independent::{Independent, Step, WeightedHeights};

/// Up to this many asperities all pairs of heights and radii are summed.
const FEW: usize = 256;

/// Width of the bins of heights, in sigma: a normal density has about 4,000 nodes.
const HEIGHT_BIN: f64 = 2e-3;

/// Width of the bins of ln(radius): radii over a decade have about 200 nodes.
const RADIUS_BIN: f64 = 0.025;

/// Bins of ln(radius) are wider by this under a layer, where a contact costs more, and with a group left out.
const COARSE: f64 = 2.0;

/// What is compared: a set of asperities, and the statistical model of it.
#[derive(Debug, Clone)]
pub struct Inputs<'a> {
    /// The asperities as the law sees them.
    pub asperities: Asperities<'a>,
    /// The set that they are of.
    pub set: &'a AsperitySet,
    /// What separations of the sum are measured from, in the frame of the heights.
    pub plane: ReferencePlane,
    /// The population of the statistical model.
    pub population: Population,
    /// The shape of its asperities.
    pub mean_shape: Shape,
    /// The shape by the other convention of the mean radius; `None` where there is none.
    pub other_shape: Option<Shape>,
    /// What its separations are measured from, relative to the mean height of the population.
    pub reporting_plane: ReferencePlane,
    /// What conducts in the gap under contacts that are asked for it.
    pub medium: Option<Medium>,
}

/// The asperities of a surface rearranged, as the states between both models sum them.
#[derive(Debug)]
pub struct Rearranged<'a> {
    inputs: Inputs<'a>,
    /// Condensed heights.
    heights: WeightedHeights,
    /// Width of the bins of ln(radius).
    radius_bin: f64,
    /// Quantiles of the density of the statistical model relative to its mean, with the radii in the order of the own heights: ascending
    /// heights are summed faster.
    paired: ByRank,
    /// Whether every asperity has the mean shape.
    is_uniform: bool,
}

/// The own heights, ascending, as asperities of one shape.
struct EqualAsperities<'a> {
    heights: &'a [f64],
    radii: Vec<f64>,
    spheres: Option<Vec<f64>>,
}

impl EqualAsperities<'_> {
    fn on(&self, nominal_area: f64) -> Asperities<'_> {
        Asperities::new(self.heights, &self.radii, self.spheres.as_deref(), nominal_area)
    }
}

/// Ascending heights with the shapes of a set in the order of its own heights.
#[derive(Debug)]
struct ByRank {
    heights: Vec<f64>,
    radii: Vec<f64>,
    spheres: Option<Vec<f64>>,
}

impl ByRank {
    fn new(heights: Vec<f64>, by_height: &ByHeight, set: &Asperities) -> Self {
        let column = |values: &[f64]| collected(by_height.places().par_iter().map(|&place| values[place]));
        Self { heights, radii: column(set.radii()), spheres: set.spheres().map(column) }
    }

    fn asperities(&self, nominal_area: f64) -> Asperities<'_> {
        Asperities::new(&self.heights, &self.radii, self.spheres.as_deref(), nominal_area)
    }
}

/// A state; see the table of the module above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arrangement {
    Statistical,
    OwnHeights,
    OwnRadii,
    Independent,
    PairedByRank,
    Deterministic,
}

/// The number of states.
pub(super) const STATES: usize = Arrangement::Deterministic as usize + 1;

impl<'a> Rearranged<'a> {
    /// Rearranges the asperities.
    pub fn new(inputs: Inputs<'a>) -> Self {
        let Inputs { asperities, population, mean_shape, .. } = &inputs;
        let count = asperities.count();
        let width = |width: f64| if count > FEW { width } else { 0.0 };

        let heights = WeightedHeights::condensed(
            inputs.set.by_height().values(),
            width(HEIGHT_BIN * inputs.plane.sigma),
        );

        let quantiles = population.heights_of(count, Draw::Quantiles);
        let paired = ByRank::new(quantiles, inputs.set.by_height(), asperities);

        let is_uniform = asperities.each().all(|(_, shape)| shape == *mean_shape);
        let radius_bin = width(RADIUS_BIN);
        Self { heights, radius_bin, paired, is_uniform, inputs }
    }

    /// The same with fewer nodes: accurate enough for the change that a group left out makes.
    #[must_use]
    pub fn coarse(self) -> Self {
        Self { radius_bin: COARSE * self.radius_bin, ..self }
    }

    /// Evaluates something with the model of each state under one law, in the order of [`Arrangement`]. Searches of the sums begin at the
    /// separations d/sigma `near`.
    pub(super) fn with_models<T>(
        &self,
        contact: &dyn MicroContact,
        near: &[f64],
        of: impl FnOnce([&dyn Model; STATES]) -> T,
    ) -> T {
        let Some(medium) = self.inputs.medium else { return self.with_spots_alone(contact, near, of) };
        self.with_spots_alone(contact, near, |models| {
            let models = models.map(|model| WithMedium { model, medium });
            of(models.each_ref().map(|model| model as &dyn Model))
        })
    }

    /// The same without what conducts in the gap.
    fn with_spots_alone<T>(
        &self,
        contact: &dyn MicroContact,
        near: &[f64],
        of: impl FnOnce([&dyn Model; STATES]) -> T,
    ) -> T {
        let Inputs { asperities, plane, population, mean_shape, reporting_plane, .. } = &self.inputs;
        let area = asperities.nominal_area();
        let integral = |contact, shape| {
            Statistical::of_shape(contact, population.clone(), shape).reported_from(*reporting_plane)
        };
        let statistical = integral(contact, *mean_shape);
        let sum =
            |contact, asperities, plane| Deterministic::new(contact, asperities, plane).searched_near(near);
        let deterministic = sum(contact, *asperities, *plane);
        let paired = sum(contact, self.paired.asperities(area), *reporting_plane);
        if self.is_uniform {
            let sum: &dyn Model = &deterministic;
            return of([&statistical, sum, &statistical, sum, &paired, sum]);
        }
        let equal = self.equal_asperities(*mean_shape);
        let own_heights = sum(contact, equal.on(area), *plane);
        let shapes = self.shapes(contact);
        let may_decrease = self.may_decrease(contact, &shapes);
        let own_radii = Mixture::new(
            shapes.iter().map(|&(share, shape)| (share, integral(contact, shape))).collect(),
            may_decrease,
        );
        let steps = if self.radius_bin > 0.0 { Step::all(contact, &shapes, asperities) } else { Vec::new() };
        let independent = Independent {
            contact,
            heights: &self.heights,
            shapes,
            steps,
            plane: *plane,
            nominal_area: area,
            may_decrease,
        };
        of([&statistical, &own_heights, &own_radii, &independent, &paired, &deterministic])
    }

    /// Evaluates something with the statistical model and that with the own heights, both with the other mean radius: no other state
    /// depends on it. `None` where there is no other.
    pub(super) fn with_other_radius<T>(
        &self,
        contact: &dyn MicroContact,
        near: &[f64],
        of: impl FnOnce([&dyn Model; 2]) -> T,
    ) -> Option<T> {
        let Inputs { asperities, plane, population, reporting_plane, other_shape, .. } = &self.inputs;
        let shape = (*other_shape)?;
        let equal = self.equal_asperities(shape);
        let statistical =
            Statistical::of_shape(contact, population.clone(), shape).reported_from(*reporting_plane);
        let own_heights =
            Deterministic::new(contact, equal.on(asperities.nominal_area()), *plane).searched_near(near);
        let Some(medium) = self.inputs.medium else { return Some(of([&statistical, &own_heights])) };
        let models: [&dyn Model; 2] = [&statistical, &own_heights];
        let models = models.map(|model| WithMedium { model, medium });
        Some(of(models.each_ref().map(|model| model as &dyn Model)))
    }

    /// The own heights as asperities of one shape.
    fn equal_asperities(&self, shape: Shape) -> EqualAsperities<'_> {
        let heights = self.inputs.set.by_height().values();
        let spheres = (shape.spheres != 1.0).then(|| filled(heights.len(), shape.spheres));
        EqualAsperities { heights, radii: filled(heights.len(), shape.radius), spheres }
    }

    /// The condensed radii as shapes with their shares. Under a layer load and area are not proportional to the number of spheres: the mean
    /// one stands for all.
    fn shapes(&self, contact: &dyn MicroContact) -> Vec<(f64, Shape)> {
        let asperities = &self.inputs.asperities;
        let count = asperities.count() as f64;
        let spheres = asperities.spheres().map_or(1.0, |all| all.iter().sum::<f64>() / count);
        let shape = |radius: f64, weight: f64| (weight / (count * spheres), Shape { radius, spheres });
        if self.radius_bin == 0.0 {
            return asperities.each().map(|(_, own)| shape(own.radius, own.spheres)).collect();
        }
        let bin = if contact.is_layered() { COARSE * RADIUS_BIN } else { self.radius_bin };
        let nodes = condensed_logarithms(asperities.radii(), asperities.spheres(), bin);
        nodes.into_iter().map(|node| shape(node.value.exp(), node.weight)).collect()
    }

    /// Whether the mean load of the `shapes` decreases anywhere with the indentation.
    fn may_decrease(&self, contact: &dyn MicroContact, shapes: &[(f64, Shape)]) -> bool {
        /// The smallest indentation over the largest, and the ratio of two.
        const SMALLEST: f64 = 1e-5;
        const STEP: f64 = 1.05;
        let Inputs { asperities, plane, .. } = &self.inputs;
        let ranges = Shapes { radii: asperities.radius_range(), spheres: asperities.sphere_range() };
        if contact.may_decrease(ranges).is_empty() {
            return false;
        }
        let deepest = asperities.highest() - (plane.mean + LOWEST_SEPARATION * plane.sigma);
        let indentations = std::iter::successors(Some(SMALLEST * deepest), |w| Some(STEP * w));
        let load =
            |w: f64| shapes.iter().map(|&(share, shape)| share * contact.contact(w, shape).load).sum::<f64>();
        !indentations.take_while(|w| *w < deepest).map(load).is_sorted()
    }
}
