//! Distributions of heights, standardised: zero mean, unit standard deviation.
//!
//! One file per distribution and one line in [`REGISTRY`]; a distribution of one's own needs neither, see [`Heights::new`].
//! The statistical model integrates it, [`Population`](crate::asperity::Population) draws from it, and
//! [`generate`](crate::topography::generate) maps Gaussian surfaces to it.
//!
//! Heights z, separations h and indentations x = z - h are in units of sigma here.

mod exponential;
mod gaussian;
mod hazard;
pub mod johnson;
mod moments;
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
pub use gaussian::{Gaussian, gaussian_moment};
pub use johnson::Johnson;
pub use moments::Moments;
pub(crate) use moments::normal_nodes;
pub use weibull::Weibull;

/// E-foldings of a density that count: exp(-40) = 4e-18 of its largest value.
const FOLDINGS: f64 = 40.0;

/// E-foldings of a density that one panel resolves to full accuracy.
const FOLDINGS_PER_PANEL: f64 = 20.0;

/// The same where the density rises and falls again within the panel's segment.
const FOLDINGS_PER_BELL: f64 = 8.0;

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

    /// What the members of its family differ by.
    fn parameters(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// Its sources.
    fn papers(&self) -> &'static [Paper];

    /// Third standardised moment.
    fn skewness(&self) -> f64;

    /// Fourth standardised moment, 3 if Gaussian.
    fn kurtosis(&self) -> f64;

    /// The lowest and the highest height, which may be infinite.
    fn support(&self) -> [f64; 2];

    /// Density at the height `z`; 0 outside the support.
    fn density(&self, z: f64) -> f64;

    /// The fraction of all heights above `z`.
    fn survival(&self, z: f64) -> f64;

    /// The height that a fraction `p` in (0, 1) of all heights lies below.
    fn quantile(&self, p: f64) -> f64 {
        self.height_at_normal(Normal::standard().inverse_cdf(p))
    }

    /// The height T(g) that as many heights lie below as standard normal numbers below `g`.
    fn height_at_normal(&self, g: f64) -> f64;

    /// Replaces every standard normal number of `field` by `scale` times its height.
    fn map_normals(&self, field: &mut [f64], scale: f64) {
        field.iter_mut().for_each(|z| *z = scale * self.height_at_normal(*z));
    }

    /// Fills `heights` with independent draws.
    fn draw(&self, rng: &mut ChaCha8Rng, heights: &mut [f64]) {
        heights.iter_mut().for_each(|z| *z = self.height_at_normal(StandardNormal.sample(rng)));
    }

    /// A height from which on the density does not increase: the mode of a density with one peak.
    fn decreasing_from(&self) -> f64;

    /// A separation at and beyond which [`scale`](Self::scale) is 0.
    fn highest_separation(&self) -> f64;

    /// The factor of the density that does not depend on v; 0 where no height above `h` is left.
    fn scale(&self, h: f64) -> f64;

    /// The range of v in which the density is not negligible, nor the load of the asperities there.
    fn window(&self, h: f64) -> [f64; 2];

    /// How many panels of [`quadrature`](crate::numeric::quadrature) in v^.5 resolve the density between two values of v.
    fn panels(&self, h: f64, from: f64, to: f64) -> usize;

    /// Values of v > 0, ascending, at which the density or its scale of length changes. Between those above the first one
    /// panels have ends of a bounded ratio.
    fn breakpoints(&self, _h: f64) -> Vec<f64> {
        Vec::new()
    }

    /// The variable v of the indentation `x`: at most 0 below the support, infinite above it.
    fn variable(&self, _h: f64, x: f64) -> f64 {
        x
    }

    /// The density at the height h + x, in x, relative to [`scale`](Self::scale), for x within the window.
    fn relative_density(&self, h: f64, x: f64) -> f64;

    /// Multiplies the weight of each node by the density in v relative to [`scale`](Self::scale), and replaces its v in
    /// `nodes`, within the window, by the indentation x.
    fn weigh(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]);
}

/// A distribution, shared. Two are equal that have name and parameters in common.
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

    /// Any distribution, be it of this library or not.
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

/// Why there is no distribution of the parameters asked for.
pub type NoSuchHeights = Box<dyn Error + Send + Sync>;

/// A family of distributions that input files can name.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// Its parameters by name, each with a common value.
    pub parameters: &'static [(&'static str, f64)],
    /// The member of the family with these values of the parameters, in their order.
    pub make: fn(&[f64]) -> Result<Heights, NoSuchHeights>,
}

impl Entry {
    /// The member of common values.
    ///
    /// # Errors
    /// None, in the entries of [`REGISTRY`].
    pub fn example(&self) -> Result<Heights, NoSuchHeights> {
        let values: Vec<f64> = self.parameters.iter().map(|(_, value)| *value).collect();
        (self.make)(&values)
    }
}

/// All distributions that input files can name.
pub const REGISTRY: &[Entry] = &[gaussian::ENTRY, exponential::ENTRY, weibull::ENTRY, johnson::ENTRY];

/// ln of a density over its scale, negated.
trait Exponent: Copy {
    /// At v, for the separation `h`.
    fn exponent<N: Real>(self, h: f64, v: N) -> N;

    /// Multiplies weights by exp(-exponent) at their nodes.
    fn weigh_nodes(self, h: f64, nodes: &[f64], weights: &mut [f64]) {
        run(Weigh { density: self, h, nodes, weights });
    }
}

struct Weigh<'a, E> {
    density: E,
    h: f64,
    nodes: &'a [f64],
    weights: &'a mut [f64],
}

impl<E: Exponent> Work for Weigh<'_, E> {
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
