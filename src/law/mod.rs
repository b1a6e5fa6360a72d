//! Micro-contact laws: what one spherical asperity answers to an indentation. One file a law.
//!
//! A law sees the properties of the pair of bodies, an indentation and a radius, and nothing else:
//! no model, no surface, no coating. Whatever changes the properties from asperity to asperity does
//! so before the law is asked. An elliptic asperity is so many spheres: its [`Shape`].

mod elliptic;
mod hertz;
mod zmc;

pub use elliptic::Shape;
pub use hertz::Hertz;
pub use zmc::{Zmc, ZmcError};

use crate::contact::Contact;
use crate::literature::Paper;
use crate::numeric::interval::Interval;

/// The pair of bodies as a law sees it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pair {
    /// Reduced modulus E*, Pa (Pasaribu and Schipper 2005, Eq. 3).
    pub reduced_modulus: f64,
    /// Hardness of the softer body, Pa; infinite where neither body yields.
    pub hardness: f64,
}

/// One micro-contact law.
///
/// # Contract
/// For `w > 0`, `b > 0` every answer is finite and non-negative, and within a regime neither area
/// nor load decreases with `w`. A jump at a boundary is stated in the law's own documentation.
///
/// Contacts are similar: A = b w f(u) and P = E* b^.5 w^1.5 g(u), where u = (w/b) (E*/H)^2 is where w stands among the
/// critical indentations; an elastic contact does not depend on H, nor a plastic one on E*. So at a fixed w the load grows as E* does, but for drops at boundaries, and P/H falls
/// as H grows.
pub trait Law: Send + Sync + 'static {
    /// The papers that the law's equations are from.
    fn papers(&self) -> &'static [Paper];

    /// Area, load, stiffness and regime at indentation `w` (m) of a sphere of radius `b` (m).
    fn contact(&self, w: f64, b: f64, pair: &Pair) -> Contact;

    /// The indentations at which the regime changes, as ratios w/b, ascending; each is proportional to (H/E*)^2.
    /// Empty where the law has one regime only.
    fn critical_ratios(&self, pair: &Pair) -> Vec<f64>;

    /// Bounds of d ln P/d ln w within the regimes that `u` = (w/b) (E*/H)^2 passes, the pair being fixed; they close
    /// with `u`.
    fn load_exponents(&self, u: Interval) -> Interval;

    /// The load just above each boundary over that just below it.
    fn jumps(&self, pair: &Pair) -> Vec<f64> {
        let side = |ratio: f64| self.contact(ratio, 1.0, pair).load;
        let ratios = self.critical_ratios(pair).into_iter();
        ratios.map(|w| side(w * (1.0 + 2.0 * f64::EPSILON)) / side(w * (1.0 - f64::EPSILON))).collect()
    }

    /// An upper bound of the load at indentations from `from` to `to`, `from < to` (m), of a pair whose properties lie
    /// between those of `low` and of `high`; the least there is where they are the same, else closing with them.
    fn highest_load(&self, from: f64, to: f64, b: f64, low: &Pair, high: &Pair) -> f64 {
        let most = Pair { reduced_modulus: high.reduced_modulus, hardness: low.hardness };
        let least = Pair { reduced_modulus: low.reduced_modulus, hardness: high.hardness };
        let critical = self.critical_ratios(&most).into_iter().map(|ratio| ratio * b);
        let load = critical
            .clone()
            .filter(|w| (from..to).contains(w))
            .flat_map(|w| [w, w.next_down()])
            .chain([to])
            .map(|w| self.contact(w, b, &most).load)
            .fold(0.0, f64::max);
        if low == high {
            return load;
        }
        // A boundary that some of the pairs have on this range may be one where the load drops.
        let latest = self.critical_ratios(&least).into_iter().map(|ratio| ratio * b);
        let drops: f64 = (critical.zip(latest).zip(self.jumps(&most)))
            .filter(|((first, last), _)| *first <= to && *last >= from)
            .map(|(_, jump)| jump.min(1.0))
            .product();
        let hardness = if high.hardness > low.hardness { high.hardness / low.hardness } else { 1.0 };
        hardness * load / drops
    }
}
