//! Micro-contact laws: what one spherical asperity answers to an indentation. One file a law.
//!
//! A law sees the properties of the pair of bodies, an indentation and a radius, and nothing else:
//! no model, no surface, no coating. Whatever changes the properties from asperity to asperity does
//! so before the law is asked.

mod hertz;
mod zmc;

pub use hertz::Hertz;
pub use zmc::{Zmc, ZmcError};

use crate::contact::Contact;
use crate::literature::Paper;

/// The pair of bodies as a law sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
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
pub trait Law: Send + Sync + 'static {
    /// The papers that the law's equations are from.
    fn papers(&self) -> &'static [Paper];

    /// Area, load, stiffness and regime at indentation `w` (m) of a sphere of radius `b` (m).
    fn contact(&self, w: f64, b: f64, pair: &Pair) -> Contact;

    /// The indentations at which the regime changes, as ratios w/b, ascending; empty where the
    /// law has one regime only.
    fn critical_ratios(&self, pair: &Pair) -> Vec<f64>;
}
