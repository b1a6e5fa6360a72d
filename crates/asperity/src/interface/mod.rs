//! The micro-contact of two bodies under a law, which both models sum.

/// Methods of a [`MicroContact`] that are those of the one in a field.
macro_rules! forward {
    ($field:ident: $(fn $name:ident(&self $(, $argument:ident: $type:ty)*) -> $out:ty;)*) => {$(
        fn $name(&self $(, $argument: $type)*) -> $out {
            self.$field.$name($($argument),*)
        }
    )*};
}
pub(crate) use forward;

mod averaged;
mod bare;
mod batch;
mod flat;
mod layered;
mod with_spots;

pub(crate) use averaged::{AveragedContact, RadiusShare};
pub use bare::Interface;
pub(crate) use batch::accumulate_columns;
pub use flat::Flat;
pub use layered::LayeredInterface;
pub use with_spots::WithSpots;

use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, ContactColumns};
use crate::law::Inapplicable;
use crate::layer::LayerError;
use crate::literature::Paper;
use crate::material::{Material, reduced_modulus, softer_hardness};
use crate::numeric::interval::Interval;
use crate::shape::Shape;
use crate::spot::{SpotProperties, SpotValues};

/// Properties of the uncoated pair, to which load ratios and the plasticity index refer.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Reference {
    /// E*, Pa.
    modulus: f64,
    /// Hardness of the softer body, Pa; infinite if neither has one.
    hardness: f64,
}

impl Reference {
    fn new(rough: &Material, flat: &Material) -> Self {
        Self { modulus: reduced_modulus(rough, flat), hardness: softer_hardness(rough, flat) }
    }
}

/// Bodies and a law that form no micro-contact.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The layered flat has no effective properties.
    #[error(transparent)]
    LayeredFlat(#[from] LayerError),
    /// The law does not apply to the bodies.
    #[error(transparent)]
    Law(#[from] Inapplicable),
}

/// Ranges of asperity shapes.
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

/// Bounds of the load of an asperity and of its slope over a range of indentations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadBounds {
    /// An upper bound of the load, N.
    pub highest: f64,
    /// Bounds of dP/dw, N/m; unbounded where the load may jump.
    pub slopes: Interval,
}

impl LoadBounds {
    /// Bounds with unknown slopes.
    fn any(highest: f64) -> Self {
        Self { highest, slopes: Interval { low: f64::NEG_INFINITY, high: f64::INFINITY } }
    }

    /// Bounds from the `loads` at the ends of the range `w` and the range of d ln P/d ln w in it.
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

/// Area, load, stiffness and regime of one asperity as a function of its indentation `w` and shape. The models use only
/// this trait; they do not depend on the law or on a layer.
///
/// The provided methods work on blocks of asperities: through `dyn MicroContact` the law is dispatched once per block,
/// not per asperity.
pub trait MicroContact: Send + Sync {
    /// The contact of an asperity at indentation `w > 0` (m).
    fn contact(&self, w: f64, shape: Shape) -> Contact;

    /// All indentations (m, ascending) at which the law changes from one formula to another, as at a change of regime.
    /// A regime may be entered more than once.
    fn regime_changes(&self, shape: Shape) -> Vec<f64>;

    /// The indentations (m, ascending) at which an integral over w is split. Area and load are smooth in w^.5 from 0 to
    /// the first, and smooth on the scale of w between the others.
    fn breakpoints(&self, shape: Shape) -> Vec<f64>;

    /// The disjoint ranges of indentation (m), ascending, within which the load may decrease with increasing
    /// indentation for an asperity within `shapes`. If there is one, a pressure may be reached more than once on
    /// approach.
    fn may_decrease(&self, shapes: Shapes) -> Vec<Interval>;

    /// Bounds of the load at indentations from `from` to `to`, `from < to` (m), which tighten as the range shrinks.
    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds;

    /// Reduced modulus of the uncoated pair, Pa, to which load ratios refer.
    fn reference_modulus(&self) -> f64;

    /// Hardness of the softer body of the uncoated pair, Pa, to which the plasticity index refers; infinite if neither
    /// has one.
    fn reference_hardness(&self) -> f64;

    /// The sources of the law and of the layer.
    fn papers(&self) -> Vec<Paper>;

    /// A reason why results may be inaccurate for this pair, if any; see [`crate::law::Law::caveat`].
    fn caveat(&self) -> Option<String> {
        None
    }

    /// Whether the flat has a layer of finite thickness, so that each contact needs effective properties.
    fn is_layered(&self) -> bool {
        false
    }

    /// What the spot at indentation `w` (m) conducts and bears in shear; `None` where it is not asked for.
    fn spot_values(&self, _w: f64, _: Shape) -> Option<SpotValues> {
        None
    }

    /// What is asked of the spots; `None` where nothing is.
    fn spot_properties(&self) -> Option<&SpotProperties> {
        None
    }

    /// The contacts of an asperity at many indentations (m).
    fn contacts(&self, indentations: &[f64], shape: Shape) -> ContactColumns {
        indentations.iter().map(|&w| self.contact(w, shape)).collect()
    }

    /// Adds the contact at `indentations[i]` (m) of an asperity of one shape, times `weights[i]`, to the accumulator.
    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        accumulate_weighted_each(self, indentations, weights, shape, accumulator);
    }

    /// Adds the contacts of asperities at `separation` (m, in the frame of their heights) to the accumulator. All
    /// heights must be above it.
    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        for (z, shape) in asperities.each() {
            let w = z - separation;
            accumulator.add(&self.contact(w, shape), shape);
            if accumulator.wants_spots()
                && let Some(values) = self.spot_values(w, shape)
            {
                accumulator.add_spot(values, 1.0);
            }
        }
    }
}

/// [`MicroContact::accumulate_weighted`], contact by contact.
fn accumulate_weighted_each(
    contact: &(impl MicroContact + ?Sized),
    indentations: &[f64],
    weights: &[f64],
    shape: Shape,
    accumulator: &mut Accumulator,
) {
    for (&w, &weight) in indentations.iter().zip(weights) {
        accumulator.accumulate_weighted(&contact.contact(w, shape), weight);
        if accumulator.wants_spots()
            && let Some(values) = contact.spot_values(w, shape)
        {
            accumulator.add_spot(values, weight);
        }
    }
}

/// Plasticity index psi = (E*/H) (sigma/R)^.5 (Greenwood and Williamson 1966) of asperities of mean radius `radius` (m)
/// and standard deviation of heights `sigma` (m); `None` if neither body yields.
pub fn plasticity_index(contact: &dyn MicroContact, sigma: f64, radius: f64) -> Option<f64> {
    let hardness = contact.reference_hardness();
    hardness.is_finite().then(|| contact.reference_modulus() / hardness * (sigma / radius).sqrt())
}

/// The jumps of load (N) and area (m^2) at the indentation `w` (m); 0 where they are continuous.
pub(crate) fn jumps(contact: &dyn MicroContact, shape: Shape, w: f64) -> [f64; 2] {
    /// Relative distance from a breakpoint at which both of its sides are evaluated: above the rounding of the
    /// breakpoint.
    const OFFSET: f64 = 1e-12;
    /// Relative rounding error of the difference of two loads.
    const ROUNDING: f64 = 32.0 * f64::EPSILON;
    /// A continuous area changes less, relatively, over the two distances.
    const CONTINUOUS: f64 = 1e2 * OFFSET;
    let step = OFFSET * w;
    let [below, above] = [-step, step].map(|step| contact.contact(w + step, shape));
    let load = above.load - below.load - (below.stiffness + above.stiffness) * step;
    let area = above.area - below.area;
    let unless_below = |jump: f64, least: f64| if jump.abs() > least { jump } else { 0.0 };
    [unless_below(load, ROUNDING * above.load), unless_below(area, CONTINUOUS * above.area)]
}

/// Relative threshold of a jump of load or area: above rounding, below every jump of a law.
const JUMP: f64 = 1e-12;
