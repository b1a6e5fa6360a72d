//! Micro-contact laws: area, load and regime of one spherical asperity at an indentation. One file per law.
//!
//! A law depends on the properties of the pair of bodies, an indentation and a radius only, not on a model, surface or
//! layer. Properties that differ between asperities are computed before the law is evaluated. An elliptic asperity is a
//! number of equal spheres: its [`Shape`].
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
use crate::named_enum;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::Real;
pub use crate::shape::Shape;

/// The pressures at which a body, or a pair of bodies, yields under a law. For a pair, the onset is that of the body
/// that yields first, the strength that of the weaker one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YieldLimits<N = f64> {
    /// The pressure that determines the onset of yield, Pa: H, K(nu) H or C(nu) Y, depending on the law.
    pub onset: N,
    /// The limit of the mean pressure of a plastic contact, Pa: H or Y.
    pub strength: N,
}

impl YieldLimits {
    /// The limits of a body that never yields.
    pub const NEVER_YIELDS: Self = Self { onset: f64::INFINITY, strength: f64::INFINITY };

    /// The same limits in every lane; `zero` gives the type of register.
    #[inline(always)]
    pub fn splat<N: Real>(self, zero: N) -> YieldLimits<N> {
        YieldLimits { onset: zero.splat(self.onset), strength: zero.splat(self.strength) }
    }

    /// The limits of two bodies in contact.
    #[inline(always)]
    pub fn with(self, other: Self) -> Self {
        Self { onset: self.onset.min(other.onset), strength: self.strength.min(other.strength) }
    }
}

/// The properties of a pair of bodies that a law needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Reduced modulus E*, Pa (Pasaribu and Schipper 2005, Eq. 3).
    pub reduced_modulus: f64,
    /// Yield limits; infinite if neither body yields.
    pub yield_limits: YieldLimits,
}

/// The pair of one asperity per lane.
#[derive(Debug, Clone, Copy)]
pub struct Pairs<N> {
    /// Reduced modulus E*, Pa.
    pub reduced_modulus: N,
    /// Yield limits.
    pub yield_limits: YieldLimits<N>,
    /// onset/E*.
    pub onset_strain: N,
}

impl Pair {
    /// The pair of a rough and a homogeneous flat body under `law`.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn between(law: &dyn Law, rough: &Material, flat: &Material) -> Result<Self, Inapplicable> {
        let of = |material, body| law.yield_limits(material).map_err(|key| law.missing(key, Some(body)));
        let (rough_resistance, flat_resistance) = (of(rough, Body::Rough)?, of(flat, Body::Flat)?);
        let yield_limits = rough_resistance.with(flat_resistance);
        if let Some(key) = law.needs().filter(|_| yield_limits == YieldLimits::NEVER_YIELDS) {
            return Err(law.missing(key, None));
        }
        let pair = Self { reduced_modulus: reduced_modulus(rough, flat), yield_limits };
        law.check(&pair).map(|()| pair)
    }

    /// The same pair in every lane; `zero` gives the type of register.
    #[inline(always)]
    pub fn splat<N: Real>(&self, zero: N) -> Pairs<N> {
        Pairs {
            reduced_modulus: zero.splat(self.reduced_modulus),
            yield_limits: self.yield_limits.splat(zero),
            onset_strain: zero.splat(self.yield_limits.onset / self.reduced_modulus),
        }
    }

    /// The ratio w/b at which (w/b) (E*/onset)^2 = `u`.
    pub fn ratio(&self, u: f64) -> f64 {
        self.splat(0.0).ratio(u)
    }
}

impl<N: Real> Pairs<N> {
    /// The ratio w/b at which (w/b) (E*/onset)^2 = `u`.
    #[inline(always)]
    pub fn ratio(&self, u: f64) -> N {
        self.onset_strain * u * self.onset_strain
    }
}

/// Relative distance from a boundary at which both of its sides are evaluated: above the rounding of the boundary.
const OFFSET: f64 = 8.0 * f64::EPSILON;

named_enum! {
    /// A property of a body, by its key in a spec.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Property {
        /// Indentation hardness.
        Hardness = "hardness",
        /// The 0.2 % proof stress.
        YieldStrength = "yield-strength",
    }
}

named_enum! {
    /// One of the two bodies.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum Body {
        /// The rough one.
        Rough = "rough",
        /// The flat one.
        Flat = "flat",
    }
}

impl Body {
    /// The body that it is pressed against.
    pub const fn other(self) -> Self {
        match self {
            Self::Rough => Self::Flat,
            Self::Flat => Self::Rough,
        }
    }
}

/// Bodies to which a law does not apply.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum Inapplicable {
    /// A property that the law needs is unknown.
    #[error("no {}, which law {law} needs of {}", property.name(), match body {
        Some(Body::Rough) => "the rough body",
        Some(Body::Flat) => "the flat body",
        None => "one of the two bodies at least",
    })]
    Lacking {
        law: &'static str,
        property: Property,
        /// `None` if neither has it and at least one must.
        body: Option<Body>,
    },
    /// The pair is outside the range of the law.
    #[error("a yield strength of {ratio:.3} E*, beyond the range of law {law}; allowed: at most {most} E*")]
    TooStrong { law: &'static str, ratio: f64, most: f64 },
    /// The law is not defined for a layer of finite thickness.
    #[error(
        "law {law} under a layer: it is defined for homogeneous bodies only; allowed: no layer, or thicknesses of 0 and \"inf\""
    )]
    Layer { law: &'static str },
}

impl Inapplicable {
    /// The same of bodies whose roles are exchanged.
    pub(crate) fn exchanged(self) -> Self {
        match self {
            Self::Lacking { law, property, body } => {
                Self::Lacking { law, property, body: body.map(Body::other) }
            }
            other => other,
        }
    }
}

/// One micro-contact law.
///
/// # Contract
/// For `w > 0`, `b > 0` area, load and stiffness are finite and non-negative, and between critical indentations neither
/// area nor load decreases with `w`. Jumps at a boundary are stated in the documentation of the law. Lengths scale:
/// doubling w and b multiplies area and load by four. Pressures scale: doubling E* and the yield limits doubles the
/// load.
///
/// `tests/library/conformance` checks this for every law of the registry ([`crate::contact_law`]).
///
/// Interfaces hold a law by its type; `dyn Law` evaluates single spheres.
pub trait Law: SingleContact + Send + Sync + 'static {
    /// The law's name in a spec.
    fn name(&self) -> &'static str;

    /// One-line description and range of validity, for reports.
    fn about(&self) -> &'static str;

    /// The options of the law, set by name; none by default.
    fn options(&self) -> &'static [LawOption] {
        &[]
    }

    /// The values of the options, in the order of [`Self::options`].
    fn option_values(&self) -> Vec<f64> {
        Vec::new()
    }

    /// The same law with other option values, in the order of [`Self::options`].
    ///
    /// # Errors
    /// A value outside the range of its option.
    fn with_options(self, _: &[f64]) -> Result<Self, OptionError>
    where
        Self: Sized,
    {
        Ok(self)
    }

    /// A reason to doubt results for a pair, such as properties outside the range of a fit; `None` by default.
    fn caveat(&self, _: &Pair) -> Option<String> {
        None
    }

    /// The sources of the law's equations.
    fn papers(&self) -> &'static [Paper];

    /// The yield limits of one body; [`YieldLimits::NEVER_YIELDS`] if it never yields.
    ///
    /// # Errors
    /// The missing property.
    fn yield_limits(&self, body: &Material) -> Result<YieldLimits, Property>;

    /// The property that at least one of the two bodies must have; `None` if the law also applies to bodies that never
    /// yield.
    fn needs(&self) -> Option<Property> {
        None
    }

    /// The property that determines yielding; `None` if contacts never yield.
    fn yields_by(&self) -> Option<Property> {
        self.needs()
    }

    /// Whether contacts are those of [`Hertz`] at any indentation, so that their sums over Gaussian heights have a
    /// closed form (Greenwood and Williamson 1966).
    fn is_hertz(&self) -> bool {
        false
    }

    /// Checks whether the law applies to a pair.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    fn check(&self, _: &Pair) -> Result<(), Inapplicable> {
        Ok(())
    }

    /// The same law with all quantities that depend on the pair only precomputed, for faster evaluation of this pair.
    fn tuned(self, _: &Pair) -> Self
    where
        Self: Sized,
    {
        self
    }

    /// Area, load, stiffness and regime at indentations `w` (m) of spheres of radii `b` (m), one per lane. Must be
    /// `#[inline(always)]`, see [`crate::numeric::lanes`].
    fn contacts<N: Real>(&self, w: N, b: N, pair: &Pairs<N>) -> Contacts<N>
    where
        Self: Sized;

    /// Area, load, stiffness and regime of one sphere at indentation `w` (m), radius `b` (m).
    #[inline]
    fn contact(&self, w: f64, b: f64, pair: &Pair) -> Contact {
        self.single_contact(w, b, pair)
    }

    /// The critical indentations, at which the law changes from one formula to another, as ratios w/b, ascending; each
    /// is proportional to (onset/E*)^2. Empty for a law of one range.
    fn critical_ratios(&self, pair: &Pair) -> Vec<f64>;

    /// The ratio of the loads just above and just below each critical indentation.
    fn jumps(&self, pair: &Pair) -> Vec<f64> {
        let [below, above] = [1.0 - OFFSET, 1.0 + OFFSET];
        let load = |w: f64| self.contact(w, 1.0, pair).load;
        self.critical_ratios(pair).into_iter().map(|w| load(w * above) / load(w * below)).collect()
    }

    /// The highest load (N) at indentations from `from` to `to`, `from < to` (m).
    fn highest_load(&self, from: f64, to: f64, b: f64, pair: &Pair) -> f64 {
        let ends = self.critical_ratios(pair).into_iter().map(|ratio| ratio * b * (1.0 - OFFSET));
        ends.filter(|w| (from..to).contains(w))
            .chain([from, to])
            .map(|w| self.contact(w, b, pair).load)
            .fold(0.0, f64::max)
    }

    /// The error of a missing property.
    fn missing(&self, property: Property, body: Option<Body>) -> Inapplicable {
        Inapplicable::Lacking { law: self.name(), property, body }
    }
}

/// [`Law::contact`] by means of [`Law::contacts`], implemented for every law, so that `dyn Law` has it.
pub trait SingleContact {
    /// See [`Law::contact`].
    fn single_contact(&self, w: f64, b: f64, pair: &Pair) -> Contact;
}

impl<L: Law> SingleContact for L {
    #[inline]
    fn single_contact(&self, w: f64, b: f64, pair: &Pair) -> Contact {
        self.contacts(w, b, &pair.splat(0.0)).into()
    }
}

/// A factor of the hardness that is linear in Poisson's ratio: constant + slope nu.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfPoisson {
    /// Value at nu = 0.
    pub constant: f64,
    /// d/d nu, not negative.
    pub slope: f64,
}

impl OfPoisson {
    /// The factor 1: the hardness itself.
    pub const ONE: Self = Self { constant: 1.0, slope: 0.0 };

    /// The factor at Poisson's ratio `nu`.
    #[inline(always)]
    pub const fn at(self, nu: f64) -> f64 {
        self.constant + self.slope * nu
    }

    /// The factor at Poisson's ratio `nu` per lane.
    #[inline(always)]
    pub fn of<N: Real>(self, nu: N) -> N {
        nu * self.slope + self.constant
    }
}

/// A dimensionally similar law, which also applies to properties that change with the indentation, as under a layer.
///
/// # Contract
/// A = b w f(u) and P = E* b^.5 w^1.5 g(u), where u = (w/b) (E*/onset)^2 is the normalised indentation. An elastic
/// contact depends on E* alone, an elastic-plastic one on E* and the onset, a plastic one on the strength alone. Hence
/// at fixed w the load increases with E*, and P/onset decreases with increasing onset, both except for drops at
/// boundaries. The strength is the hardness, the onset proportional to it.
pub trait ScalableLaw: Law + Clone {
    /// The onset over the hardness.
    const ONSET: OfPoisson = OfPoisson::ONE;

    /// Bounds of d ln P/d ln w for a fixed pair over a range of `u` = (w/b) (E*/onset)^2, which tighten as the range
    /// shrinks.
    fn load_exponents(&self, u: Interval) -> Interval;

    /// Whether the onset depends on Poisson's ratio.
    fn depends_on_poisson() -> bool {
        Self::ONSET.slope != 0.0
    }

    /// The yield limits of a hardness (Pa) and a Poisson's ratio.
    #[inline(always)]
    fn limits_at<N: Real>(&self, hardness: N, poisson: N) -> YieldLimits<N> {
        YieldLimits { onset: Self::ONSET.of(poisson) * hardness, strength: hardness }
    }

    /// Implements [`Law::yield_limits`] for a scalable law.
    fn yield_limits_by_hardness(&self, body: &Material) -> YieldLimits {
        body.hardness().map_or(YieldLimits::NEVER_YIELDS, |hardness| self.limits_at(hardness, body.poisson()))
    }
}
