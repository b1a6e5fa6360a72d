//! A rough body on a flat with a layer of finite thickness.

use super::{JUMP, LoadBounds, MicroContact};
use crate::coating::Coating;
use crate::contact::{Contact, Regime, Tally};
use crate::law::{Law, Pair};
use crate::literature::Paper;
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::root::sign_changes;

/// A homogeneous rough body on a layered flat under one law: the law sees the pair that each asperity feels at its
/// own indentation (Pasaribu and Schipper 2005, Eqs. 5, 9 with E_eff, nu_eff, H_eff).
#[derive(Debug, Clone)]
pub struct Layered<L> {
    law: L,
    coating: Coating,
    /// (1 - nu^2)/E of the rough body, 1/Pa.
    rough_compliance: f64,
    /// Of the rough body, Pa; infinite where it never yields.
    rough_hardness: f64,
    /// Without the layer.
    reference: Pair,
    /// The (w/b) (E*/H)^2 at which the load of the law jumps, and by what factor.
    jumps: Vec<(f64, f64)>,
}

/// Critical ratios stand with (H/E*)^2: of this pair they are the factors before it.
const UNIT: Pair = Pair { reduced_modulus: 1.0, hardness: 1.0 };

/// Asperities that are looked at side by side.
const SIDE_BY_SIDE: usize = 8;

/// The pair that an asperity feels, and how it changes with the indentation.
#[derive(Debug, Clone, Copy, Default)]
struct Felt {
    pair: Pair,
    /// d ln E*/d ln w.
    modulus_slope: f64,
    /// d ln H/d ln w.
    hardness_slope: f64,
}

/// The same over a range.
struct FeltRange {
    modulus: Interval,
    modulus_slope: Interval,
    hardness: Interval,
    hardness_slope: Interval,
}

impl<L: Law> Layered<L> {
    /// The contact of a rough body with `substrate` under `coating`.
    pub fn new(law: L, rough: &Material, substrate: &Material, coating: Coating) -> Self {
        let reference = Pair::of(rough, substrate);
        let places = law.critical_ratios(&UNIT).into_iter().zip(law.jumps(&UNIT));
        let jumps = places.filter(|(_, jump)| reference.hardness.is_finite() && (jump - 1.0).abs() > JUMP);
        Self {
            law,
            coating,
            rough_compliance: rough.plane_compliance(),
            rough_hardness: rough.hardness().unwrap_or(f64::INFINITY),
            reference,
            jumps: jumps.collect(),
        }
    }

    fn yields(&self) -> bool {
        self.rough_hardness.is_finite() || self.coating.hardness_range().high.is_finite()
    }

    #[inline(always)]
    fn felt<const LANES: usize>(&self, w: [f64; LANES], b: [f64; LANES]) -> [Felt; LANES] {
        self.coating.lanes(w, b).map(|flat| {
            let reduced_modulus = (self.rough_compliance + flat.compliance).recip();
            // The softer body yields.
            let is_flat = flat.hardness < self.rough_hardness;
            Felt {
                pair: Pair {
                    reduced_modulus,
                    hardness: if is_flat { flat.hardness } else { self.rough_hardness },
                },
                modulus_slope: -reduced_modulus * flat.compliance_slope,
                hardness_slope: if is_flat { flat.hardness_slope } else { 0.0 },
            }
        })
    }

    fn felt_over(&self, w: Interval, b: Interval) -> FeltRange {
        let of_flat = self.coating.over(w, b);
        let modulus = (of_flat.compliance + self.rough_compliance).recip();
        let (hardness, hardness_slope) = if of_flat.hardness.high < self.rough_hardness {
            (of_flat.hardness, of_flat.hardness_slope)
        } else if of_flat.hardness.low >= self.rough_hardness {
            (Interval::point(self.rough_hardness), Interval::point(0.0))
        } else {
            let hardness = Interval { low: of_flat.hardness.low, high: self.rough_hardness };
            (hardness, of_flat.hardness_slope.hull(Interval::point(0.0)))
        };
        FeltRange { modulus, modulus_slope: -(modulus * of_flat.compliance_slope), hardness, hardness_slope }
    }

    /// With P = E* b^.5 w^1.5 g(u), u = (w/b) (E*/H)^2, and e = d ln P/d ln w of the fixed pair, the load goes with the
    /// (2e - 2)th power of E* and the (3 - 2e)th of H.
    #[inline(always)]
    fn answer(&self, w: f64, b: f64, felt: &Felt) -> Contact {
        let contact = self.law.contact(w, b, &felt.pair);
        let stiffness = contact.stiffness * (1.0 + 2.0 * (felt.modulus_slope - felt.hardness_slope))
            + contact.load / w * (3.0 * felt.hardness_slope - 2.0 * felt.modulus_slope);
        Contact { stiffness, ..contact }
    }

    /// (w/b) (E*/H)^2.
    fn place(w: Interval, b: Interval, felt: &FeltRange) -> Interval {
        let strain = felt.modulus * felt.hardness.recip();
        w * strain * strain * b.recip()
    }

    /// d ln P/d ln w = e + (2e - 2) d ln E*/d ln w + (3 - 2e) d ln H/d ln w (see [`Self::answer`]) is linear in each of
    /// the three: it is least and greatest at corners of their ranges.
    fn exponents(e: Interval, modulus_slope: Interval, hardness_slope: Interval) -> Interval {
        let at = |e: f64| modulus_slope * (2.0 * e - 2.0) + hardness_slope * (3.0 - 2.0 * e) + e;
        at(e.low).hull(at(e.high))
    }

    /// Where w = `ratio` b (H/E*)^2: every root, by the sign of ln w - 2 ln H + 2 ln E* - ln(ratio b) over ln w.
    fn crossings(&self, ratio: f64, b: f64) -> Vec<f64> {
        let level = (ratio * b).ln();
        let radius = Interval::point(b);
        let all = self.felt_over(Interval { low: 0.0, high: f64::MAX.sqrt() / b.max(1.0) }, radius);
        let bound = |hardness: f64, modulus: f64| level + 2.0 * (hardness / modulus).ln();
        let low = bound(all.hardness.low, all.modulus.high) - 1e-9;
        let high = bound(all.hardness.high, all.modulus.low) + 1e-9;
        let value = |v: f64| {
            let [felt] = self.felt([v.exp()], [b]);
            v - 2.0 * (felt.pair.hardness / felt.pair.reduced_modulus).ln() - level
        };
        let over = |from: f64, to: f64| {
            let felt = self.felt_over(Interval { low: from.exp(), high: to.exp() }, radius);
            let ln = |range: Interval| Interval { low: range.low.ln(), high: range.high.ln() };
            let values =
                Interval { low: from, high: to } + (ln(felt.modulus) - ln(felt.hardness)) * 2.0 + -level;
            [values, (felt.modulus_slope - felt.hardness_slope) * 2.0 + 1.0]
        };
        sign_changes(&value, &over, low, high).into_iter().map(f64::exp).collect()
    }
}

impl<L: Law> MicroContact for Layered<L> {
    #[inline]
    fn contact(&self, w: f64, b: f64) -> Contact {
        let [felt] = self.felt([w], [b]);
        self.answer(w, b, &felt)
    }

    fn weigh(&self, indentations: &[f64], weights: &[f64], b: f64, tally: &mut Tally) {
        let (blocks, rest) = indentations.as_chunks::<SIDE_BY_SIDE>();
        let (block_weights, rest_weights) = weights.as_chunks::<SIDE_BY_SIDE>();
        for (w, weights) in blocks.iter().zip(block_weights) {
            for (felt, (&w, &weight)) in self.felt(*w, [b; SIDE_BY_SIDE]).iter().zip(w.iter().zip(weights)) {
                tally.weigh(&self.answer(w, b, felt), weight);
            }
        }
        for (&w, &weight) in rest.iter().zip(rest_weights) {
            tally.weigh(&self.contact(w, b), weight);
        }
    }

    fn press(&self, heights: &[f64], radii: &[f64], separation: f64, tally: &mut Tally) {
        let (blocks, rest) = heights.as_chunks::<SIDE_BY_SIDE>();
        let (block_radii, rest_radii) = radii.as_chunks::<SIDE_BY_SIDE>();
        for (heights, b) in blocks.iter().zip(block_radii) {
            let w = heights.map(|z| z - separation);
            for ((felt, &w), &b) in self.felt(w, *b).iter().zip(&w).zip(b) {
                tally.add(&self.answer(w, b, felt));
            }
        }
        for (&z, &b) in rest.iter().zip(rest_radii) {
            tally.add(&self.contact(z - separation, b));
        }
    }

    fn regime_changes(&self, b: f64) -> Vec<f64> {
        let ratios = if self.yields() { self.law.critical_ratios(&UNIT) } else { Vec::new() };
        let mut changes: Vec<f64> = ratios.into_iter().flat_map(|ratio| self.crossings(ratio, b)).collect();
        changes.sort_unstable_by(f64::total_cmp);
        changes
    }

    fn breakpoints(&self, b: f64) -> Vec<f64> {
        let mut points = self.regime_changes(b);
        // An elastic contact does not feel the hardness, nor a plastic one the modulus.
        let regime = |w: f64| self.contact(w, b).regime;
        let modulus = self.coating.modulus_scales(b, self.rough_compliance);
        points.extend(modulus.filter(|&w| regime(w) != Regime::Plastic));
        let is_softer = |w: f64| self.coating.at(w, b).hardness < self.rough_hardness;
        let hardness = self.coating.hardness_scales().into_iter();
        points.extend(hardness.filter(|&w| regime(w) != Regime::Elastic && is_softer(w)));
        points.extend(self.coating.indentation_of_hardness(self.rough_hardness));
        points.sort_unstable_by(f64::total_cmp);
        points
    }

    fn load_rises_to(&self, radii: Interval) -> f64 {
        /// Pieces of the depth on which the hardness changes.
        const PIECES: i32 = 400;
        if self.jumps.iter().any(|&(_, jump)| jump < 1.0) {
            return 0.0;
        }
        let end = self.coating.depth();
        // From a depth at which next to nothing of the layer is gone, to any.
        let place = |k: i32| match k {
            0 => 0.0,
            k if k > PIECES => 1e200,
            k => end * 1e-12f64.powf(1.0 - f64::from(k) / f64::from(PIECES)),
        };
        let rises = |k: &i32| {
            let w = Interval { low: place(*k), high: place(k + 1) };
            let felt = self.felt_over(w, radii);
            let exponents = self.law.load_exponents(Self::place(w, radii, &felt));
            // Back over a boundary, a rise of the load is a fall.
            let turns_back = (felt.modulus_slope - felt.hardness_slope).low <= -0.5;
            Self::exponents(exponents, felt.modulus_slope, felt.hardness_slope).low > 0.0
                && (self.jumps.is_empty() || !turns_back)
        };
        (0..=PIECES).find(|k| !rises(k)).map_or(f64::INFINITY, place)
    }

    fn load_over(&self, from: f64, to: f64, b: f64) -> LoadBounds {
        let w = Interval { low: from, high: to };
        let radius = Interval::point(b);
        let felt = self.felt_over(w, radius);
        let u = Self::place(w, radius, &felt);
        let exponents = Self::exponents(self.law.load_exponents(u), felt.modulus_slope, felt.hardness_slope);
        if self.jumps.iter().any(|&(place, _)| u.holds(place)) || (from == 0.0 && exponents.low < 0.0) {
            let low = Pair { reduced_modulus: felt.modulus.low, hardness: felt.hardness.low };
            let high = Pair { reduced_modulus: felt.modulus.high, hardness: felt.hardness.high };
            return LoadBounds::any(self.law.highest_load(from, to, b, &low, &high));
        }
        LoadBounds::between(w, [from, to].map(|w| self.contact(w, b).load), exponents)
    }

    fn reference_modulus(&self) -> f64 {
        self.reference.reduced_modulus
    }

    fn reference_hardness(&self) -> f64 {
        self.reference.hardness
    }

    fn papers(&self) -> Vec<Paper> {
        self.law.papers().iter().copied().chain(self.coating.papers()).collect()
    }
}
