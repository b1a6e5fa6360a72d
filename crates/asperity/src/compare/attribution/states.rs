//! The states between both models.

use rayon::prelude::*;

use crate::asperity::{Asperities, AsperitySet, ByHeight, Draw, Population};
use crate::interface::{AveragedContact, MicroContact, RadiusShare, jumps};
use crate::memory::{collected, filled};
use crate::model::{Deterministic, Medium, Mixture, Model, ReferencePlane, Statistical, WithMedium};
use crate::numeric::condensed::{Node, condensed, condensed_logarithms};
use crate::numeric::sort::ascending;
use crate::shape::Shape;

/// Up to this many asperities all pairs of heights and radii are summed.
const FEW: usize = 256;

/// Width of the bins of heights, in sigma, where a sphere stands for radii that scatter.
const HEIGHT_BIN: f64 = 2e-3;

/// The same where all asperities have one shape, so that their law changes at one indentation: loads and areas are within 1e-9, a
/// stiffness within 5e-5.
const FINE_HEIGHT_BIN: f64 = 1e-4;

/// Width of the bins of ln(radius); also the half of the step of the averaged contact in ln w.
const RADIUS_BIN: f64 = 5e-3;

/// Bins are wider by this under a layer, where a contact costs more, and with a group left out.
const COARSE: f64 = 4.0;

/// The same for the classes of radii of an integral, which is smooth in the radius under any law.
const CLASS: f64 = 0.05;

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
    /// Condensed heights with their weights, and the same in finer bins.
    heights: Sample,
    fine_heights: Sample,
    /// Width of the bins of ln(radius).
    radius_bin: f64,
    /// Quantiles of the density of the statistical model relative to its mean, with the radii in the order of the own heights: ascending
    /// heights are summed faster.
    paired: ByRank,
    /// Whether every asperity has the mean shape.
    is_uniform: bool,
}

/// Nodes of a sample.
#[derive(Debug, Default)]
struct Sample {
    values: Vec<f64>,
    weights: Vec<f64>,
}

impl Sample {
    /// Ascending values condensed in bins of a `width`; all of them for a width of zero.
    fn condensed(values: &[f64], width: f64) -> Self {
        if width == 0.0 {
            return Self { values: values.to_vec(), weights: vec![1.0; values.len()] };
        }
        let nodes = condensed(values, width);
        let column = |of: fn(&Node) -> f64| nodes.iter().map(of).collect();
        Self { values: column(|node| node.value), weights: column(|node| node.weight) }
    }

    /// As heights of asperities of one shape.
    fn asperities(&self, shape: Shape) -> EqualAsperities<'_> {
        EqualAsperities {
            heights: &self.values,
            radii: vec![shape.radius; self.values.len()],
            spheres: Some(self.weights.iter().map(|weight| weight * shape.spheres).collect()),
        }
    }
}

/// Heights as asperities of one shape.
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

        let [heights, fine_heights] = [HEIGHT_BIN, FINE_HEIGHT_BIN]
            .map(|bin| Sample::condensed(inputs.set.by_height().values(), width(bin * inputs.plane.sigma)));

        let quantiles = population.heights_of(count, Draw::Quantiles);
        let paired = ByRank::new(quantiles, inputs.set.by_height(), asperities);

        let is_uniform = asperities.each().all(|(_, shape)| shape == *mean_shape);
        let radius_bin = width(RADIUS_BIN);
        Self { heights, fine_heights, radius_bin, paired, is_uniform, inputs }
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
        let equal = self.equal_asperities(contact, *mean_shape);
        let own_heights = sum(contact, equal.on(area), *plane);
        let averaged = self.averaged(contact);
        // The contact is that of any radius.
        let any = self.heights.asperities(Shape::sphere(mean_shape.radius));
        let independent = Deterministic::new(&averaged, any.on(area), *plane).searched_near(near);
        let both = |own_radii: &dyn Model| {
            of([&statistical, &own_heights, own_radii, &independent, &paired, &deterministic])
        };
        if self.has_load_jumps(contact) {
            both(&Mixture::new(
                self.classes().map(|(share, shape)| (share, integral(contact, shape))).collect(),
            ))
        } else {
            both(&integral(&averaged, Shape::sphere(mean_shape.radius)))
        }
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
        let equal = self.equal_asperities(contact, shape);
        let statistical =
            Statistical::of_shape(contact, population.clone(), shape).reported_from(*reporting_plane);
        let own_heights =
            Deterministic::new(contact, equal.on(asperities.nominal_area()), *plane).searched_near(near);
        let Some(medium) = self.inputs.medium else { return Some(of([&statistical, &own_heights])) };
        let models: [&dyn Model; 2] = [&statistical, &own_heights];
        let models = models.map(|model| WithMedium { model, medium });
        Some(of(models.each_ref().map(|model| model as &dyn Model)))
    }

    /// The own heights as asperities of one shape. Under a layer all of them: its contacts are not proportional to the number of spheres.
    fn equal_asperities(&self, contact: &dyn MicroContact, shape: Shape) -> EqualAsperities<'_> {
        if !contact.is_layered() {
            return self.fine_heights.asperities(shape);
        }
        let heights = self.inputs.set.by_height().values();
        let spheres = (shape.spheres != 1.0).then(|| filled(heights.len(), shape.spheres));
        EqualAsperities { heights, radii: filled(heights.len(), shape.radius), spheres }
    }

    /// The largest indentation (m) of a state: from the highest asperity, and from where a density is negligible.
    fn deepest(&self) -> f64 {
        /// In sigma, the lowest separation searched and the height above which a density is negligible.
        const LOWEST: f64 = -10.0;
        const HIGHEST: f64 = 12.0;
        let Inputs { asperities, plane, population, .. } = &self.inputs;
        let of_set = asperities.highest() - (plane.mean + LOWEST * plane.sigma);
        of_set.max((HIGHEST - LOWEST) * population.sigma.max(plane.sigma))
    }

    /// Whether the load of an asperity on a homogeneous flat jumps.
    fn has_load_jumps(&self, contact: &dyn MicroContact) -> bool {
        let shape = Shape::sphere(self.inputs.mean_shape.radius);
        let jumps_at = |w: f64| jumps(contact, shape, w)[0] != 0.0;
        !contact.is_layered() && contact.regime_changes(shape).into_iter().any(jumps_at)
    }

    /// The contact averaged over all radii.
    fn averaged<'b>(&self, contact: &'b dyn MicroContact) -> AveragedContact<'b> {
        let bin = if contact.is_layered() { COARSE * self.radius_bin } else { self.radius_bin };
        let nodes = self.radii_in_bins(bin);
        if bin == 0.0 {
            return AveragedContact::exact(contact, nodes);
        }
        let all = || ascending(self.inputs.asperities.radii()).into_iter().map(|k| self.share(k)).collect();
        AveragedContact::tabulated(contact, nodes, all, 2.0 * bin, self.deepest())
    }

    /// The radius of an asperity with its share.
    fn share(&self, place: usize) -> RadiusShare {
        let asperities = &self.inputs.asperities;
        let Shape { radius, spheres } = asperities.shape(place);
        RadiusShare { radius, share: spheres / asperities.count() as f64 }
    }

    /// The radii in bins of a width in their logarithm, ascending, by number of spheres over number of asperities; for a width of zero
    /// all of them, as they are in the set.
    fn radii_in_bins(&self, width: f64) -> Vec<RadiusShare> {
        let asperities = &self.inputs.asperities;
        let count = asperities.count();
        if width == 0.0 {
            return (0..count).map(|k| self.share(k)).collect();
        }
        let nodes = condensed_logarithms(asperities.radii(), asperities.spheres(), width);
        let of = |node: Node| RadiusShare { radius: node.value.exp(), share: node.weight / count as f64 };
        nodes.into_iter().map(of).collect()
    }

    /// Classes of radii with their weights.
    fn classes(&self) -> impl Iterator<Item = (f64, Shape)> {
        let width = if self.radius_bin > 0.0 { CLASS } else { 0.0 };
        self.radii_in_bins(width).into_iter().map(|one| (one.share, Shape::sphere(one.radius)))
    }
}
