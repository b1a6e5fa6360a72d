//! Materials, layer and law together: the micro-contact that both models sum.

mod bare;
mod batch;
mod flat;
mod layered;

pub use bare::Interface;
pub use flat::Flat;
pub use layered::LayeredInterface;

use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::Contact;
use crate::law::Inapplicable;
use crate::layer::LayerError;
use crate::literature::Paper;
use crate::material::{Material, reduced_modulus, softer_hardness};
use crate::numeric::interval::Interval;
use crate::shape::Shape;

/// The pair that load ratios and the plasticity index refer to: without a layer, whatever the law.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Reference {
    /// E*, Pa.
    modulus: f64,
    /// Of the softer body, Pa; infinite where neither has one.
    hardness: f64,
}

impl Reference {
    fn of(rough: &Material, flat: &Material) -> Self {
        Self { modulus: reduced_modulus(rough, flat), hardness: softer_hardness(rough, flat) }
    }
}

/// No micro-contact exists for these bodies under this law.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The layered flat has no effective properties.
    #[error(transparent)]
    LayeredFlat(#[from] LayerError),
    /// The law does not apply to the bodies.
    #[error(transparent)]
    Law(#[from] Inapplicable),
}

/// Ranges of shapes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shapes {
    /// Radii, m.
    pub radii: Interval,
    /// Numbers of spheres.
    pub spheres: Interval,
}

impl From<Shape> for Shapes {
    fn from(shape: Shape) -> Self {
        Self { radii: Interval::point(shape.radius), spheres: Interval::point(shape.spheres) }
    }
}

/// What the load of an asperity does over a range of indentations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadBounds {
    /// An upper bound of the load, N.
    pub highest: f64,
    /// All dP/dw, N/m; every number where the load may jump.
    pub slopes: Interval,
}

impl LoadBounds {
    /// Where nothing is known of the slopes.
    fn any(highest: f64) -> Self {
        Self { highest, slopes: Interval { low: f64::NEG_INFINITY, high: f64::INFINITY } }
    }

    /// From the `loads` at the ends of the range `w` and all d ln P/d ln w on it.
    fn between(w: Interval, loads: [f64; 2], exponents: Interval) -> Self {
        let [first, last] = loads;
        let ratio = w.high / w.low;
        let highest = if exponents.low >= 0.0 {
            last
        } else if exponents.high <= 0.0 {
            first
        } else {
            (first * ratio.powf(exponents.high)).min(last * ratio.powf(-exponents.low))
        };
        let lowest = if exponents.low >= 0.0 {
            first
        } else if exponents.high <= 0.0 {
            last
        } else {
            0.0
        };
        // P/w grows with w where the exponent is above 1.
        let steepest = highest / if exponents.low >= 1.0 { w.high } else { w.low };
        let steep = Interval { low: lowest / w.high, high: steepest };
        Self { highest, slopes: steep * exponents }
    }
}

/// What the models know of a contact: at indentation `w` and of a shape, what area, what load,
/// which regime? Neither model knows which law it is, or whether there is a layer on the flat.
///
/// The provided methods work on blocks of asperities: through `dyn MicroContact` the law is chosen
/// once a block, never once an asperity.
pub trait MicroContact: Send + Sync {
    /// The contact of an asperity at indentation `w > 0` (m).
    fn contact(&self, w: f64, shape: Shape) -> Contact;

    /// The indentations (m, ascending) at which one formula of the law gives way to another, as it does where the regime
    /// changes: all of them, a regime that is entered again included.
    fn regime_changes(&self, shape: Shape) -> Vec<f64>;

    /// The indentations (m, ascending) that an integral over w splits at: between them area and load of an asperity
    /// are smooth in w^.5, up to the first as far as 0, behind it on the scale of w itself.
    fn breakpoints(&self, shape: Shape) -> Vec<f64>;

    /// The ranges of indentation (m), ascending and apart, within which the load of an asperity may fall as the
    /// indentation grows, of asperities whose shapes lie within `shapes`. Where there is one, a pressure may be reached
    /// more than once on approach.
    fn may_decrease(&self, shapes: Shapes) -> Vec<Interval>;

    /// Bounds of the load at indentations from `from` to `to`, `from < to` (m), that close with the range.
    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds;

    /// Reduced modulus that load ratios refer to, Pa: that of the uncoated pair.
    fn reference_modulus(&self) -> f64;

    /// Hardness that the plasticity index refers to, Pa: that of the softer body of the uncoated
    /// pair, infinite where neither has one.
    fn reference_hardness(&self) -> f64;

    /// The papers behind the law and the layer.
    fn papers(&self) -> Vec<Paper>;

    /// Why its results may be inaccurate for this pair, if there is a reason; see [`crate::law::Law::caveat`].
    fn caveat(&self) -> Option<String> {
        None
    }

    /// Whether there is a layer of finite thickness, so that each contact needs its effective properties.
    fn is_layered(&self) -> bool {
        false
    }

    /// Adds `weights[i]` contacts of one shape at `indentations[i]` to the accumulator.
    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        for (&w, &weight) in indentations.iter().zip(weights) {
            accumulator.accumulate_weighted(&self.contact(w, shape), weight);
        }
    }

    /// Adds the contacts of asperities that all stand above the flat at `separation` (m, in the
    /// frame of their heights) to the accumulator.
    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        asperities.each().for_each(|(z, shape)| accumulator.add(&self.contact(z - separation, shape)));
    }
}

/// Plasticity index psi = (E*/H) (sigma/R)^.5 (Greenwood and Williamson 1966) of asperities of mean
/// radius `radius` (m) and height deviation `sigma` (m); `None` where nothing yields.
pub fn plasticity_index(contact: &dyn MicroContact, sigma: f64, radius: f64) -> Option<f64> {
    let hardness = contact.reference_hardness();
    hardness.is_finite().then(|| contact.reference_modulus() / hardness * (sigma / radius).sqrt())
}

/// Wider than the rounding of a load, narrower than any jump that a law states.
const JUMP: f64 = 1e-12;
