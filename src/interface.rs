//! Materials and a law together: the micro-contact that both models add up.

use crate::contact::{Contact, Tally};
use crate::law::{Law, Pair};
use crate::literature::Paper;
use crate::material::{Material, reduced_modulus, softer_hardness};

/// What the models know of a contact: at indentation `w` and radius `b`, what area, what load,
/// which regime? Neither model knows which law answers.
///
/// The provided methods work on blocks of asperities: through `dyn MicroContact` the law is chosen
/// once a block, never once an asperity.
pub trait MicroContact: Send + Sync {
    /// The answer at indentation `w > 0` (m) of an asperity of radius `b` (m).
    fn contact(&self, w: f64, b: f64) -> Contact;

    /// The indentations (m, ascending) at which the regime of an asperity of radius `b` changes.
    fn breakpoints(&self, b: f64) -> Vec<f64>;

    /// Whether the load falls anywhere as the indentation grows. Then a pressure may be reached
    /// more than once on approach.
    fn load_falls(&self) -> bool;

    /// Reduced modulus that load ratios refer to, Pa: that of the uncoated pair.
    fn reference_modulus(&self) -> f64;

    /// Hardness that the plasticity index refers to, Pa: that of the softer body of the uncoated
    /// pair, infinite where neither yields.
    fn reference_hardness(&self) -> f64;

    /// The papers behind the answers.
    fn papers(&self) -> Vec<Paper>;

    /// The highest load between the indentations `from` and `to`, `from < to` (m): at the end or
    /// just before a drop.
    fn highest_load(&self, from: f64, to: f64, b: f64) -> f64 {
        self.breakpoints(b)
            .into_iter()
            .filter(|w| (from..to).contains(w))
            .flat_map(|w| [w, w.next_down()])
            .chain([to])
            .map(|w| self.contact(w, b).load)
            .fold(0.0, f64::max)
    }

    /// Adds `weights[i]` contacts of radius `b` at `indentations[i]` to the tally.
    fn weigh(&self, indentations: &[f64], weights: &[f64], b: f64, tally: &mut Tally) {
        for (&w, &weight) in indentations.iter().zip(weights) {
            tally.weigh(&self.contact(w, b), weight);
        }
    }

    /// Adds the contacts of asperities that all stand above the flat at `separation` (m, in the
    /// frame of `heights`) to the tally.
    fn press(&self, heights: &[f64], radii: &[f64], separation: f64, tally: &mut Tally) {
        for (&z, &b) in heights.iter().zip(radii) {
            tally.add(&self.contact(z - separation, b));
        }
    }
}

/// Plasticity index psi = (E*/H) (sigma/R)^.5 (Greenwood and Williamson 1966) of asperities of mean
/// radius `radius` (m) and height deviation `sigma` (m); `None` where nothing yields.
pub fn plasticity_index(contact: &dyn MicroContact, sigma: f64, radius: f64) -> Option<f64> {
    let hardness = contact.reference_hardness();
    hardness.is_finite().then(|| contact.reference_modulus() / hardness * (sigma / radius).sqrt())
}

/// A rough and a flat body, both homogeneous, under one law.
#[derive(Debug, Clone, Copy)]
pub struct Interface<L> {
    law: L,
    pair: Pair,
}

impl<L: Law> Interface<L> {
    /// The contact of a rough body with a flat one.
    pub fn bare(law: L, rough: &Material, flat: &Material) -> Self {
        let pair =
            Pair { reduced_modulus: reduced_modulus(rough, flat), hardness: softer_hardness(rough, flat) };
        Self { law, pair }
    }
}

impl<L: Law> MicroContact for Interface<L> {
    #[inline]
    fn contact(&self, w: f64, b: f64) -> Contact {
        self.law.contact(w, b, &self.pair)
    }

    fn breakpoints(&self, b: f64) -> Vec<f64> {
        self.law.critical_ratios(&self.pair).into_iter().map(|ratio| ratio * b).collect()
    }

    /// Bare contacts of one law are similar whatever their radius, and within a regime no law
    /// falls: a look at both sides of each boundary of the unit sphere tells.
    fn load_falls(&self) -> bool {
        /// Wider than the rounding of a load, narrower than any jump that a law states.
        const ROUNDING: f64 = 1e-12;
        self.breakpoints(1.0).into_iter().any(|w| {
            let before = self.contact(w * (1.0 - f64::EPSILON), 1.0).load;
            let after = self.contact(w * (1.0 + 2.0 * f64::EPSILON), 1.0).load;
            after < before * (1.0 - ROUNDING)
        })
    }

    fn reference_modulus(&self) -> f64 {
        self.pair.reduced_modulus
    }

    fn reference_hardness(&self) -> f64 {
        self.pair.hardness
    }

    fn papers(&self) -> Vec<Paper> {
        self.law.papers().to_vec()
    }
}
