//! The statistical model: a height density and one mean radius (Zhao, Maietta and Chang 2000).

use super::load_control::{LOWEST_SEPARATION, search_missing};
use super::weight::{FixedPanels, GaussianSurvival, NEGLIGIBLE, Weight, spans};
use super::{Model, ReferencePlane, Response, separations_of};
use crate::accumulator::{Accumulator, Total};
use crate::asperity::{Population, Statistics};
use crate::interface::{MicroContact, accumulate_columns, jumps};
use crate::named_enum;
use crate::numeric::lanes::{Real, Work, run};
use crate::numeric::parallel;
use crate::numeric::quadrature::{NODES, Piece, Variable, pieces};
use crate::numeric::root::last_reaching;
use crate::shape::Shape;

named_enum! {
    /// The mean radius used by the statistical model.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum MeanRadius {
        /// The arithmetic mean (Pasaribu and Schipper 2005, Table 1).
        #[default]
        Arithmetic = "arithmetic",
        /// 1/(mean curvature).
        InverseMeanCurvature = "inverse-mean-curvature",
        /// The arithmetic mean of the asperities in contact, at each separation.
        InContact = "in-contact",
    }
}

impl MeanRadius {
    /// The other convention for one mean radius.
    pub const fn other(self) -> Self {
        match self {
            Self::Arithmetic => Self::InverseMeanCurvature,
            Self::InverseMeanCurvature | Self::InContact => Self::Arithmetic,
        }
    }

    /// The mean radius of a set with these statistics, m; of those that touch, the limit where all do.
    pub fn radius(self, statistics: &Statistics) -> f64 {
        match self {
            Self::Arithmetic | Self::InContact => statistics.mean_radius,
            Self::InverseMeanCurvature => statistics.radius_of_mean_curvature,
        }
    }
}

/// The micro-contact integrated over a height density:
///
/// ```text
/// A/A_nom = eta int A(z - d) f(z) dz,   p = eta int P(z - d) f(z) dz,   z from d
/// ```
///
/// by Gauss-Legendre panels in w between the breakpoints of the micro-contact, with the density relative to its value
/// at d, so that the far tail keeps full relative accuracy. Under a layer, contacts on the panels between breakpoints, which are the
/// same at all separations, are evaluated once.
#[derive(Clone)]
pub struct Statistical<'a> {
    contact: &'a dyn MicroContact,
    population: Population,
    /// Shape of every asperity.
    shape: Shape,
    plane: ReferencePlane,
    /// Breakpoints of the micro-contact, in units of sigma.
    breakpoints: Vec<f64>,
    fixed: FixedPanels,
    /// Breakpoints at which the load jumps, and the jump (N).
    jumps: Vec<(f64, f64)>,
    /// Whether the survival function of Gaussian heights takes the place of the density.
    weighs_by_survival: bool,
}

impl<'a> Statistical<'a> {
    /// The model of a population of spheres, with separations measured from its mean asperity height in units of its
    /// sigma.
    pub fn new(contact: &'a dyn MicroContact, population: Population) -> Self {
        let shape = Shape::sphere(population.radius);
        Self::of_shape(contact, population, shape)
    }

    /// The model of a population of asperities of `shape`, in place of spheres of its radius.
    pub fn of_shape(contact: &'a dyn MicroContact, population: Population, shape: Shape) -> Self {
        let sigma = population.sigma;
        let breakpoints: Vec<f64> = contact.breakpoints(shape).into_iter().map(|w| w / sigma).collect();
        let jump = |&x: &f64| (x, jumps(contact, shape, x * sigma)[0]);
        let jumps = breakpoints.iter().map(jump).filter(|(_, load)| *load != 0.0).collect();
        let plane = ReferencePlane { mean: 0.0, sigma };
        let fixed = if contact.is_layered() && population.heights.variable_is_indentation() {
            let [_, end] = population.heights.window(0.0);
            FixedPanels::new(contact, shape, sigma, &breakpoints, end)
        } else {
            FixedPanels::default()
        };
        Self { contact, population, shape, plane, breakpoints, fixed, jumps, weighs_by_survival: false }
    }

    /// The same model with the survival function of Gaussian heights in the place of their density: int A(w) Q((d + w)/sigma) dw/sigma.
    pub(crate) fn weighed_by_survival(self) -> Self {
        Self { weighs_by_survival: true, ..self }
    }

    /// What weighs the contacts over the indentation.
    fn weight(&self) -> &dyn Weight {
        if self.weighs_by_survival { &GaussianSurvival } else { &self.population.heights }
    }

    /// The same model with separations measured from and in units of `plane`, whose mean is relative to the mean
    /// asperity height.
    pub fn reported_from(self, plane: ReferencePlane) -> Self {
        Self { plane, ..self }
    }

    /// Converts a reported separation to the standardised one of the density.
    fn standardised(&self, h: f64) -> f64 {
        if self.is_standardised() {
            h
        } else {
            (self.plane.mean + h * self.plane.sigma) / self.population.sigma
        }
    }

    /// The inverse of [`Statistical::standardised`].
    fn reported(&self, h: f64) -> f64 {
        if self.is_standardised() {
            h
        } else {
            (h * self.population.sigma - self.plane.mean) / self.plane.sigma
        }
    }

    /// Whether reported and standardised separations are equal; the far tail needs d/sigma without rounding.
    fn is_standardised(&self) -> bool {
        self.plane == ReferencePlane { mean: 0.0, sigma: self.population.sigma }
    }

    /// The total at the standardised separation `h`, per asperity and without the density's factor
    /// [`HeightDistribution::scale`](crate::distribution::HeightDistribution::scale), with which it would underflow in
    /// the far tail.
    fn total(&self, h: f64, wants_spots: bool) -> Total {
        let heights = self.weight();
        let mut accumulator = Accumulator::empty(wants_spots);
        if heights.scale(h) == 0.0 {
            return accumulator.total();
        }
        let [start, end] = heights.window(h);
        // Below this the load is negligible, and the number of panels would be unbounded.
        let nearest = NEGLIGIBLE * end;
        let of_contact = self.breakpoints.iter().map(|&x| heights.variable(h, x));
        let breakpoints = merged(of_contact.skip_while(|&v| v <= nearest), heights.breakpoints(h));
        let ends = breakpoints.chain([end]);
        let mut samples = Samples::default();
        let fixed = self.fixed.resolved(heights, h);
        self.accumulate_fixed(h, fixed, &mut samples, &mut accumulator);
        let mut from = start.max(self.fixed.end(fixed));
        for (segment, to) in ends.enumerate() {
            let to = to.min(end);
            if to <= from {
                continue;
            }
            for [low, high] in spans(from, to, segment > 0) {
                for piece in pieces(low, high, Variable::SquareRoot, heights.panels(h, low, high)) {
                    if samples.count == Samples::MOST {
                        self.accumulate_weighted(h, &mut samples, &mut accumulator);
                    }
                    run(Sampled { piece, samples: &mut samples });
                }
            }
            from = to;
        }
        self.accumulate_weighted(h, &mut samples, &mut accumulator);
        // A load jump contributes to dp/dd.
        for &(x, load) in &self.jumps {
            let v = heights.variable(h, x);
            if v > nearest && (start..end).contains(&v) {
                accumulator.add_jump(load * heights.relative_density(h, x) / self.population.sigma);
            }
        }
        accumulator.total()
    }

    /// Adds the contacts on the first `count` of the panels that are the same at all separations.
    fn accumulate_fixed(&self, h: f64, count: usize, samples: &mut Samples, accumulator: &mut Accumulator) {
        for first in (0..count * NODES).step_by(Samples::MOST) {
            let nodes = first..(count * NODES).min(first + Samples::MOST);
            let points = &mut samples.points[..nodes.len()];
            let weights = &mut samples.weights[..nodes.len()];
            points.copy_from_slice(&self.fixed.points[nodes.clone()]);
            weights.copy_from_slice(&self.fixed.weights[nodes]);
            self.weight().apply(h, points, weights);
            accumulate_columns(&self.fixed.contacts, first, weights, accumulator);
            if accumulator.wants_spots() {
                for (&x, &weight) in points.iter().zip(&*weights) {
                    let values = self.contact.spot_values(x * self.population.sigma, self.shape);
                    accumulator.add_spot(values.unwrap_or_default(), weight);
                }
            }
        }
    }

    /// Adds the contacts at the nodes of `samples`, with the density above the separation `h` in units of its scale.
    fn accumulate_weighted(&self, h: f64, samples: &mut Samples, accumulator: &mut Accumulator) {
        let Samples { points, weights, count } = samples;
        let (points, weights) = (&mut points[..*count], &mut weights[..*count]);
        self.weight().apply(h, points, weights);
        points.iter_mut().for_each(|x| *x *= self.population.sigma);
        self.contact.accumulate_weighted(points, weights, self.shape, accumulator);
        *count = 0;
    }

    /// The reported separation from which on there are no contacts.
    pub(super) fn highest_separation(&self) -> f64 {
        self.reported(self.weight().highest_separation())
    }

    fn responses(&self, separations: &[f64], wants_spots: bool) -> Vec<Response> {
        /// The smallest number of integrals per task.
        const MANY: usize = 64;
        let (density, heights) = (self.population.density, self.weight());
        let respond = |&h: &f64| {
            let standardised = self.standardised(h);
            let per_area = density * heights.scale(standardised);
            Response::new(h, self.plane, &self.total(standardised, wants_spots), per_area)
        };
        let some: Vec<&[f64]> = separations.chunks(MANY).collect();
        let responses = parallel::map(some.len(), |k| some[k].iter().map(respond).collect::<Vec<_>>());
        responses.concat()
    }

    /// Nominal pressure at the reported separation `h`, Pa.
    fn pressure(&self, h: f64) -> f64 {
        self.respond_without_spots(&[h])[0].pressure.total()
    }
}

/// Quadrature nodes whose contacts are evaluated together.
struct Samples {
    /// Abscissae, in the variable of integration.
    points: [f64; Self::MOST],
    weights: [f64; Self::MOST],
    count: usize,
}

impl Samples {
    /// The nodes of four panels.
    const MOST: usize = 4 * NODES;
}

impl Default for Samples {
    fn default() -> Self {
        Self { points: [0.0; Self::MOST], weights: [0.0; Self::MOST], count: 0 }
    }
}

/// Appends the nodes of a piece.
struct Sampled<'a> {
    piece: Piece,
    samples: &'a mut Samples,
}

impl Work for Sampled<'_> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { piece, samples } = self;
        let points = &mut samples.points[samples.count..][..NODES];
        let weights = &mut samples.weights[samples.count..][..NODES];
        for k in (0..NODES).step_by(N::LANES) {
            let [x, weight] = piece.sample(k, zero);
            weight.store(&mut weights[k..]);
            x.store(&mut points[k..]);
        }
        samples.count += NODES;
    }
}

/// Merges two ascending sequences.
fn merged(a: impl Iterator<Item = f64>, b: Vec<f64>) -> impl Iterator<Item = f64> {
    let (mut a, mut b) = (a.peekable(), b.into_iter().peekable());
    std::iter::from_fn(move || match (a.peek(), b.peek()) {
        (Some(x), Some(y)) if y < x => b.next(),
        (None, _) => b.next(),
        _ => a.next(),
    })
}

impl Model for Statistical<'_> {
    fn plane(&self) -> ReferencePlane {
        self.plane
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        self.responses(separations, self.contact.spot_properties().is_some())
    }

    fn respond_without_spots(&self, separations: &[f64]) -> Vec<Response> {
        self.responses(separations, false)
    }

    /// Above the mode the pressure decreases with the separation for any load: -dp/dd = -int P f' dz with f' <= 0.
    /// Below the mode a load that decreases with w can make it increase. The density is smooth on the scale of sigma,
    /// so that within a small step the pressure has at most one extremum, which the slopes at both ends reveal.
    fn may_decrease(&self) -> bool {
        !self.contact.may_decrease(self.shape.into()).is_empty()
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        let highest = self.highest_separation();
        let mode = self.reported(self.weight().decreasing_from()).max(LOWEST_SEPARATION);
        let may_decrease = self.may_decrease();
        let low = if may_decrease { mode } else { LOWEST_SEPARATION };
        let mut found = separations_of(self.last_reaching(pressures, low, highest, &[]));
        if may_decrease {
            search_missing(&mut found, pressures, |pressure| self.last_reaching_below(mode, pressure));
        }
        found
    }
}

impl Statistical<'_> {
    /// The largest separation with at least `pressure` (Pa) below the mode of the density.
    fn last_reaching_below(&self, mode: f64, pressure: f64) -> Option<f64> {
        /// Step of the search, in sigma.
        const STEP: f64 = 1.0 / 16.0;
        let search = |low, high| last_reaching(|h| self.pressure(h), pressure, low, high);
        let steps = ((mode - LOWEST_SEPARATION) / STEP).ceil() as i32;
        let end = |k: i32| (mode - STEP * f64::from(k)).max(LOWEST_SEPARATION);
        (0..steps).find_map(|k| {
            let (low, high) = (end(k + 1), end(k));
            search(low, high).or_else(|| search(self.peak(low, high)?, high))
        })
    }

    /// The separation of highest pressure between `low` and `high`, if the pressure increases on approach at `high` and
    /// decreases at `low`.
    fn peak(&self, low: f64, high: f64) -> Option<f64> {
        /// Bisections of a step, down to rounding.
        const HALVINGS: usize = 50;
        let rises = |h: f64| self.respond(h).stiffness > 0.0;
        if rises(low) || !rises(high) {
            return None;
        }
        let (mut fallen, mut rising) = (low, high);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (fallen + rising);
            if rises(middle) {
                rising = middle;
            } else {
                fallen = middle;
            }
        }
        Some(rising)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::{Heights, Smoothed};
    use crate::interface::{Flat, WithSpots};
    use crate::law::{KogutEtsion, ScalableLaw, Zmc};
    use crate::layer::ModulusModel;
    use crate::material::Material;
    use crate::spot::{Conduction, SpotProperties};

    fn material(young: f64, hardness: f64) -> Material {
        Material::new(young, 0.3, Some(hardness), None).unwrap()
    }

    /// Spots under a soft layer or a hard one.
    fn coated(law: impl ScalableLaw, layer: &Material, thickness: f64) -> WithSpots {
        let steel = material(210e9, 7.6e9);
        let flat = Flat::with_layer(layer, &steel, thickness, ModulusModel::Gao).unwrap();
        let electrical = Some(Conduction::new([1.7e-8, 1.43e-7]).unwrap());
        let properties = SpotProperties { electrical, ..SpotProperties::default() };
        WithSpots::new(flat.under(law, &steel).unwrap(), properties)
    }

    /// Area, load, stiffness and conductance, by regime.
    fn values(response: &Response) -> [f64; 8] {
        let Response { area_ratio, pressure, stiffness, spots, .. } = response;
        let ([a, b, c], [d, e, f]) = (area_ratio.0, pressure.0);
        [a, b, c, d, e, f, *stiffness, spots[0]]
    }

    /// The contacts that are evaluated once are those of every separation.
    #[test]
    fn fixed_panels_change_nothing() {
        let mut fewest = usize::MAX;
        let mut see = |contact: &WithSpots, heights: &Heights, by_survival: bool| {
            let population =
                Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: heights.clone() };
            let model = Statistical::new(contact, population);
            let model = if by_survival { model.weighed_by_survival() } else { model };
            let without = Statistical { fixed: FixedPanels::default(), ..model.clone() };
            for h in [-12.0, -3.0, -0.5, 0.0, 0.3, 2.0, 5.0, 20.0, 38.0] {
                let [found, exact] = [&model, &without].map(|model| values(&model.respond(h)));
                for (found, exact) in found.into_iter().zip(exact) {
                    assert!((found - exact).abs() <= 1e-14 * exact.abs(), "{found:e} for {exact:e} at {h}");
                }
            }
            fewest = fewest.min(model.fixed.resolved(model.weight(), 2.0));
        };
        let smoothed = Smoothed::new(&[-2.0, -0.3, 0.1, 1.0, 1.2]).unwrap();
        let (lead, ceramic) = (material(18e9, 0.17e9), material(400e9, 21e9));
        for thickness in [1e-9, 1e-8, 1e-7, 1e-6] {
            for layer in [&lead, &ceramic] {
                let contact = coated(Zmc::default(), layer, thickness);
                see(&contact, &Heights::GAUSSIAN, false);
                see(&contact, &Heights::GAUSSIAN, true);
                see(&contact, &Heights::EXPONENTIAL, false);
                see(&contact, &Heights::new(smoothed.clone()), false);
                see(&coated(KogutEtsion, layer, thickness), &Heights::GAUSSIAN, false);
            }
        }
        assert!(fewest > 0);
    }
}
