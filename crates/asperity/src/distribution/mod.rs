//! Distributions of heights, standardised: zero mean, unit standard deviation.
//!
//! Each distribution is one file and one line in [`REGISTRY`]; for one of another crate see [`Heights::new`]. The
//! statistical model integrates it, [`Population`](crate::asperity::Population) draws from it, and
//! [`generate`](crate::topography::generate) maps Gaussian surfaces to it.
//!
//! Heights z, separations h and indentations x = z - h are in units of sigma here.

mod exponential;
mod fitted;
mod gaussian;
pub mod johnson;
mod normal;
mod smoothed;
pub mod weibull;

use std::error::Error;
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::literature::Paper;
use crate::numeric::lanes::{Real, Work, run};
pub use exponential::Exponential;
pub use fitted::HeightModel;
pub use gaussian::{Gaussian, gaussian_moment};
pub use johnson::Johnson;
pub use normal::Moments;
pub(crate) use normal::normal_nodes;
pub use smoothed::{EqualHeights, Smoothed};
pub use weibull::Weibull;

/// E-foldings of a density that are integrated: to exp(-40) = 4e-18 of its largest value.
const FOLDINGS: f64 = 40.0;

/// E-foldings of a density that one panel resolves to full accuracy.
const FOLDINGS_PER_PANEL: f64 = 20.0;

/// The same where the segment of the panel contains the maximum of the density.
const FOLDINGS_PER_BELL: f64 = 8.0;

/// The panels for a number of them that is not rounded. A window holds [`FOLDINGS`] exactly, of which rounding must not make one panel more.
fn whole_panels(count: f64) -> usize {
    const ROUNDING: f64 = 1e-9;
    (count - ROUNDING).ceil().max(1.0) as usize
}

/// A distribution of heights of zero mean and unit standard deviation.
///
/// The integral over the heights z = h + x above a separation h runs over a variable v, in which the density is
/// smooth: x itself, unless a density is singular at an end of its support. The density in v is taken relative
/// to [`scale`](Self::scale), so that the far tail keeps full relative accuracy.
pub trait HeightDistribution: fmt::Debug + fmt::Display + Send + Sync {
    /// The name in specs and tables.
    fn name(&self) -> &'static str;

    /// The name in sentences.
    fn label(&self) -> &'static str;

    /// Names and values of the parameters of the family; empty by default.
    fn parameters(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// The sources of the distribution.
    fn papers(&self) -> &'static [Paper];

    /// Skewness: third standardised moment.
    fn skewness(&self) -> f64;

    /// Kurtosis: fourth standardised moment, 3 if Gaussian.
    fn kurtosis(&self) -> f64;

    /// The lowest and the highest height; either may be infinite.
    fn support(&self) -> [f64; 2];

    /// Density at the height `z`; 0 outside the support.
    fn density(&self, z: f64) -> f64;

    /// Survival function: the fraction of heights above `z`.
    fn survival(&self, z: f64) -> f64;

    /// Quantile function: the height below which a fraction `p` in (0, 1) of all heights lies.
    fn quantile(&self, p: f64) -> f64 {
        self.height_at_normal(Normal::standard().inverse_cdf(p))
    }

    /// The height T(g) of the same cumulative probability as the standard normal variable `g`.
    fn height_at_normal(&self, g: f64) -> f64;

    /// Replaces each standard normal value g of `field` by `scale` T(g).
    fn map_normals(&self, field: &mut [f64], scale: f64) {
        field.iter_mut().for_each(|z| *z = scale * self.height_at_normal(*z));
    }

    /// Replaces each probability of `field` by `scale` times its [`quantile`](Self::quantile).
    fn map_probabilities(&self, field: &mut [f64], scale: f64) {
        field.iter_mut().for_each(|z| *z = scale * self.quantile(*z));
    }

    /// Fills `heights` with independent draws.
    fn draw(&self, rng: &mut ChaCha8Rng, heights: &mut [f64]) {
        heights.iter_mut().for_each(|z| *z = self.height_at_normal(StandardNormal.sample(rng)));
    }

    /// A height above which the density does not increase: the mode of a unimodal density.
    fn decreasing_from(&self) -> f64;

    /// A separation from which on [`scale`](Self::scale) is 0.
    fn highest_separation(&self) -> f64;

    /// The factor of the density that does not depend on v; 0 if there are no heights above `h`.
    fn scale(&self, h: f64) -> f64;

    /// The range of v outside which density and load are negligible.
    fn window(&self, h: f64) -> [f64; 2];

    /// Number of panels of [`quadrature`](crate::numeric::quadrature) in v^.5 that resolve the density between two
    /// values of v.
    fn panels(&self, h: f64, from: f64, to: f64) -> usize;

    /// Values of v > 0, ascending, at which the density or its length scale changes. Above the first one, panels have
    /// ends of a bounded ratio.
    fn breakpoints(&self, _h: f64) -> Vec<f64> {
        Vec::new()
    }

    /// The variable v of the indentation `x`: at most 0 below the support, infinite above it.
    fn variable(&self, _h: f64, x: f64) -> f64 {
        x
    }

    /// Whether v is x at every separation, so that panels may stay the same; `false` by default.
    fn variable_is_indentation(&self) -> bool {
        false
    }

    /// The density in x at the height h + x, relative to [`scale`](Self::scale), for x within the window.
    fn relative_density(&self, h: f64, x: f64) -> f64;

    /// Multiplies the weight of each node by the density in v relative to [`scale`](Self::scale), and replaces its v in
    /// `nodes`, within the window, by the indentation x.
    fn apply_density(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]);
}

/// A shared height distribution. Two are equal if their names and parameters are.
#[derive(Clone)]
pub struct Heights(Holder);

#[derive(Clone)]
enum Holder {
    Static(&'static dyn HeightDistribution),
    Shared(Arc<dyn HeightDistribution>),
}

impl Heights {
    /// Gaussian heights.
    pub const GAUSSIAN: Self = Self(Holder::Static(&Gaussian));

    /// Exponential heights.
    pub const EXPONENTIAL: Self = Self(Holder::Static(&Exponential));

    /// Wraps any distribution, also of another crate.
    pub fn new(distribution: impl HeightDistribution + 'static) -> Self {
        Self(Holder::Shared(Arc::new(distribution)))
    }
}

impl Deref for Heights {
    type Target = dyn HeightDistribution;

    fn deref(&self) -> &Self::Target {
        match &self.0 {
            Holder::Static(distribution) => *distribution,
            Holder::Shared(distribution) => &**distribution,
        }
    }
}

impl PartialEq for Heights {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name() && self.parameters() == other.parameters()
    }
}

impl fmt::Debug for Heights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&**self, f)
    }
}

impl fmt::Display for Heights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&**self, f)
    }
}

/// Parameters for which a family has no distribution.
pub type HeightsError = Box<dyn Error + Send + Sync>;

/// A named family of distributions.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Name of the family.
    pub name: &'static str,
    /// Names of the parameters, each with a typical value.
    pub parameters: &'static [(&'static str, f64)],
    /// Constructs a member of the family from parameter values in the order of `parameters`.
    pub make: fn(&[f64]) -> Result<Heights, HeightsError>,
}

impl Entry {
    /// The member with typical parameter values.
    ///
    /// # Errors
    /// None for the entries of [`REGISTRY`].
    pub fn example(&self) -> Result<Heights, HeightsError> {
        let values: Vec<f64> = self.parameters.iter().map(|(_, value)| *value).collect();
        (self.make)(&values)
    }
}

/// All families, by name.
pub const REGISTRY: &[Entry] = &[gaussian::ENTRY, exponential::ENTRY, weibull::ENTRY, johnson::ENTRY];

/// -ln of a density relative to its scale.
trait Exponent: Copy {
    /// The exponent at v for the separation `h`.
    fn exponent<N: Real>(self, h: f64, v: N) -> N;

    /// Multiplies each weight by exp(-exponent) at its node.
    fn apply_exponent(self, h: f64, nodes: &[f64], weights: &mut [f64]) {
        run(ApplyExponent { density: self, h, nodes, weights });
    }
}

struct ApplyExponent<'a, E> {
    density: E,
    h: f64,
    nodes: &'a [f64],
    weights: &'a mut [f64],
}

impl<E: Exponent> Work for ApplyExponent<'_, E> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let Self { density, h, nodes, weights } = self;
        let whole = nodes.len() - nodes.len() % N::LANES;
        for k in (0..whole).step_by(N::LANES) {
            let weight = zero.load(&weights[k..]);
            (weight * (-density.exponent(h, zero.load(&nodes[k..]))).exp()).store(&mut weights[k..]);
        }
        for k in whole..nodes.len() {
            weights[k] *= (-density.exponent(h, nodes[k])).exp();
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
