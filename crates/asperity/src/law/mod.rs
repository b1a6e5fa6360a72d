//! Micro-contact laws: what one spherical asperity answers to an indentation. One file a law.
//!
//! A law sees the properties of the pair of bodies, an indentation and a radius, and nothing else:
//! no model, no surface, no coating. Whatever changes the properties from asperity to asperity does
//! so before the law is asked. An elliptic asperity is a number of equal spheres: its [`Shape`].
//!
//! | file | law | regimes |
//! |---|---|---|
//! | `hertz` | Hertz, as Greenwood and Williamson use it | elastic |
//! | `zmc` | Zhao, Maietta and Chang | elastic, elastic-plastic, plastic |
//! | `ceb` | Chang, Etsion and Bogy | elastic, elastic-plastic |
//! | `kogut_etsion` | Kogut and Etsion | elastic, elastic-plastic in two ranges, plastic |
//! | `jackson_green` | Jackson and Green | elastic, elastic-plastic |
//! | `fully_plastic` | Abbott and Firestone | plastic |

mod ceb;
mod fully_plastic;
mod hertz;
mod jackson_green;
mod kogut_etsion;
mod option;
mod regimes;
mod zmc;

pub use ceb::Ceb;
pub use fully_plastic::FullyPlastic;
pub use hertz::Hertz;
pub use jackson_green::JacksonGreen;
pub use kogut_etsion::KogutEtsion;
pub use option::{LawOption, OptionError};
pub use zmc::Zmc;

use crate::contact::{Contact, Contacts};
use crate::literature::Paper;
use crate::material::{Material, reduced_modulus};
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;
pub use crate::shape::Shape;

/// What a body sets against yielding, as a law sees it. Of a pair, the onset is that of the body that yields first, the
/// strength that of the weaker one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldLimits<N = f64> {
    /// The pressure that sets where yield begins, Pa: H, K(nu) H or C(nu) Y, as the law has it.
    pub onset: N,
    /// What limits the mean pressure of a plastic contact, Pa: H, or Y.
    pub strength: N,
}

impl YieldLimits {
    /// Of a body that never yields.
    pub const NEVER_YIELDS: Self = Self { onset: f64::INFINITY, strength: f64::INFINITY };

    /// Of two bodies in contact.
    #[inline(always)]
    pub fn with(self, other: Self) -> Self {
        Self { onset: self.onset.min(other.onset), strength: self.strength.min(other.strength) }
    }
}

/// The pair of bodies as a law sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<N = f64> {
    /// Reduced modulus E*, Pa (Pasaribu and Schipper 2005, Eq. 3).
    pub reduced_modulus: N,
    /// What they set against yielding; infinite where neither body yields.
    pub yield_limits: YieldLimits<N>,
}

impl Pair {
    /// What a rough and a homogeneous flat body are to `law`.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn between(law: &dyn Law, rough: &Material, flat: &Material) -> Result<Self, Inapplicable> {
        let of = |material, body| law.yield_limits(material).map_err(|key| law.lacks(key, Some(body)));
        let (rough_resistance, flat_resistance) = (of(rough, Body::Rough)?, of(flat, Body::Flat)?);
        let yield_limits = rough_resistance.with(flat_resistance);
        if let Some(key) = law.needs().filter(|_| yield_limits == YieldLimits::NEVER_YIELDS) {
            return Err(law.lacks(key, None));
        }
        let pair = Self { reduced_modulus: reduced_modulus(rough, flat), yield_limits };
        law.check(&pair).map(|()| pair)
    }

    /// The same pair for every lane of a number such as `zero`.
    #[inline(always)]
    pub fn splat<N: Real>(&self, zero: N) -> Pair<N> {
        let YieldLimits { onset, strength } = self.yield_limits;
        let yield_limits = YieldLimits { onset: zero.splat(onset), strength: zero.splat(strength) };
        Pair { reduced_modulus: zero.splat(self.reduced_modulus), yield_limits }
    }
}

impl<N: Real> Pair<N> {
    /// (w/b) (E*/onset)^2 = `u` at the indentation w = ratio b.
    #[inline(always)]
    pub fn ratio(&self, u: f64) -> N {
        let strain = self.yield_limits.onset / self.reduced_modulus;
        strain * u * strain
    }
}

/// This part of a critical indentation lies between a place beside a boundary and the boundary: more than the rounding
/// of where a formula gives way to another.
const BESIDE: f64 = 8.0 * f64::EPSILON;

/// A property of a body, by its key in a spec.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Property {
    /// `hardness`
    Hardness,
    /// `yield-strength`
    YieldStrength,
}

impl Property {
    /// The key.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Hardness => "hardness",
            Self::YieldStrength => "yield-strength",
        }
    }
}

/// One of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Body {
    /// The rough one.
    Rough,
    /// The flat one.
    Flat,
}

/// Bodies that a law says nothing of.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Inapplicable {
    /// A property is not known that the law needs.
    #[error("no {}, which law {law} needs of {}", property.key(), match body {
        Some(Body::Rough) => "the rough body",
        Some(Body::Flat) => "the flat body",
        None => "one of the two bodies at least",
    })]
    Lacking {
        /// The law.
        law: &'static str,
        /// The property.
        property: Property,
        /// The body that lacks it; `None` where both do and one of them must have it.
        body: Option<Body>,
    },
    /// The pair lies beyond what the law was made for.
    #[error("a yield strength of {ratio:.3} E*, beyond the range of law {law}; allowed: at most {most} E*")]
    TooStrong {
        /// The law.
        law: &'static str,
        /// Yield strength over reduced modulus.
        ratio: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// The law does not say what a layer of finite thickness does to it.
    #[error(
        "law {law} under a layer: what it needs is known of a homogeneous body only; allowed: no layer, or thicknesses of 0 and \"inf\""
    )]
    Layer {
        /// The law.
        law: &'static str,
    },
}

/// One micro-contact law.
///
/// # Contract
/// For `w > 0`, `b > 0` every answer is finite and non-negative, and within a range between critical indentations
/// neither area nor load decreases with `w`. A jump at a boundary is stated in the law's own documentation. Lengths
/// scale: with w and b both doubled, area and load are four times as large; with E* and the yield_limits doubled, the load
/// is.
///
/// `tests/library/conformance` holds every law of the registry ([`crate::contact_law`]) to it.
///
/// Models hold a law by its type; `dyn Law` answers for single spheres.
pub trait Law: SingleContact + Send + Sync + 'static {
    /// The law's name in a spec.
    fn name(&self) -> &'static str;

    /// What the law is and where it holds, in a line of a report.
    fn about(&self) -> &'static str;

    /// The options that a user may set by name; none by default.
    fn options(&self) -> &'static [LawOption] {
        &[]
    }

    /// The values of its options, in their order.
    fn option_values(&self) -> Vec<f64> {
        Vec::new()
    }

    /// The same law with other values of its options.
    ///
    /// # Errors
    /// A value out of the range of its option.
    fn with_options(self, _: &[f64]) -> Result<Self, OptionError>
    where
        Self: Sized,
    {
        Ok(self)
    }

    /// What makes answers for a pair doubtful though the law gives them: beyond what it was fitted for.
    fn caveat(&self, _: &Pair) -> Option<String> {
        None
    }

    /// The papers that the law's equations are from.
    fn papers(&self) -> &'static [Paper];

    /// What one body sets against yielding; [`YieldLimits::NEVER_YIELDS`] if it never yields.
    ///
    /// # Errors
    /// The property that is needed to tell.
    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property>;

    /// The property that one of the two bodies must have at least; `None` where the law also says what bodies do that
    /// never yield.
    fn needs(&self) -> Option<Property> {
        None
    }

    /// The property of the bodies that yielding follows from; `None` where contacts never yield.
    fn yields_by(&self) -> Option<Property> {
        self.needs()
    }

    /// Whether contacts are those of [`Hertz`] at any indentation: their sums over Gaussian heights then have a closed form
    /// (Greenwood and Williamson 1966).
    fn is_hertz(&self) -> bool {
        false
    }

    /// Whether the law says anything of a pair.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    fn check(&self, _: &Pair) -> Result<(), Inapplicable> {
        Ok(())
    }

    /// The same law with everything worked out that only the pair decides: contacts of this pair then cost less.
    fn tuned(self, _: &Pair) -> Self
    where
        Self: Sized,
    {
        self
    }

    /// Area, load, stiffness and regime at indentations `w` (m) of spheres of radii `b` (m), one per lane. Must be
    /// `#[inline(always)]`, see [`crate::numeric::lanes`].
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pair<N>) -> Contacts<N>
    where
        Self: Sized;

    /// The same of one sphere.
    #[inline]
    fn contact(&self, w: f64, b: f64, pair: &Pair) -> Contact {
        self.single_contact(w, b, pair)
    }

    /// The indentations at which one formula gives way to another, as ratios w/b, ascending; each is proportional to
    /// (onset/E*)^2. Empty where the law has one range only.
    fn critical_ratios(&self, pair: &Pair) -> Vec<f64>;

    /// The load just above each boundary over that just below it.
    fn jumps(&self, pair: &Pair) -> Vec<f64> {
        let side = |ratio: f64| self.contact(ratio, 1.0, pair).load;
        let ratios = self.critical_ratios(pair).into_iter();
        ratios.map(|w| side(w * (1.0 + BESIDE)) / side(w * (1.0 - BESIDE))).collect()
    }

    /// The highest load at indentations from `from` to `to`, `from < to` (m): within a range it is at the end.
    fn highest_load(&self, from: f64, to: f64, b: f64, pair: &Pair) -> f64 {
        let ends = self.critical_ratios(pair).into_iter().map(|ratio| ratio * b * (1.0 - BESIDE));
        ends.filter(|w| (from..to).contains(w))
            .chain([from, to])
            .map(|w| self.contact(w, b, pair).load)
            .fold(0.0, f64::max)
    }

    /// A property that is missing.
    fn lacks(&self, property: Property, body: Option<Body>) -> Inapplicable {
        Inapplicable::Lacking { law: self.name(), property, body }
    }
}

/// [`Law::contact`] by way of [`Law::contacts`]: implemented for every law, so that `dyn Law` has it.
pub trait SingleContact {
    /// See [`Law::contact`].
    fn single_contact(&self, w: f64, b: f64, pair: &Pair) -> Contact;
}

impl<L: Law> SingleContact for L {
    #[inline]
    fn single_contact(&self, w: f64, b: f64, pair: &Pair) -> Contact {
        self.contacts(w, b, pair).into()
    }
}

/// constant + slope nu: a factor before the hardness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfPoisson {
    /// At nu = 0.
    pub constant: f64,
    /// d/d nu, not negative.
    pub slope: f64,
}

impl OfPoisson {
    /// The hardness itself.
    pub const ONE: Self = Self { constant: 1.0, slope: 0.0 };

    /// At Poisson's ratio `nu`.
    #[inline(always)]
    pub const fn at(self, nu: f64) -> f64 {
        self.constant + self.slope * nu
    }

    /// The same for each lane.
    #[inline(always)]
    pub fn of<N: Real>(self, nu: N) -> N {
        nu * self.slope + self.constant
    }
}

/// A law whose contacts are similar, so that it can be asked with properties that change with the indentation: under a
/// layer.
///
/// # Contract
/// A = b w f(u) and P = E* b^.5 w^1.5 g(u), where u = (w/b) (E*/onset)^2 is where w stands among the critical
/// indentations. An elastic contact depends on E* alone, an elastic-plastic one on E* and the onset, a plastic one on
/// the strength alone. So at a fixed w the load grows as E* does, but for drops at boundaries, and P over the yield_limits
/// falls as that grows. The strength is the hardness, the onset a factor of it.
pub trait ScalableLaw: Law + Clone {
    /// The onset over the hardness.
    const ONSET: OfPoisson = OfPoisson::ONE;

    /// Bounds of d ln P/d ln w within the ranges that `u` = (w/b) (E*/onset)^2 passes, the pair being fixed; they close
    /// with `u`.
    fn load_exponents(&self, u: Interval) -> Interval;

    /// Whether the onset depends on Poisson's ratio.
    fn depends_on_poisson() -> bool {
        Self::ONSET.slope != 0.0
    }

    /// What a hardness (Pa) at a Poisson's ratio is to the law.
    #[inline(always)]
    fn limits_at<N: Real>(&self, hardness: N, poisson: N) -> YieldLimits<N> {
        YieldLimits { onset: Self::ONSET.of(poisson) * hardness, strength: hardness }
    }

    /// [`Law::yield_limits`] of such a law.
    fn yield_limits_by_hardness(&self, body: &Material) -> YieldLimits {
        body.hardness().map_or(YieldLimits::NEVER_YIELDS, |hardness| self.limits_at(hardness, body.poisson()))
    }
}
