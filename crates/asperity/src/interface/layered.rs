//! A rough body on a flat with a layer of finite thickness.

use super::batch::{LaneContacts, accumulate, accumulate_weighted, contacts};
use super::{JUMP, LoadBounds, MicroContact, Reference, Shapes};
use crate::accumulator::Accumulator;
use crate::asperity::Asperities;
use crate::contact::{Contact, ContactColumns, Contacts, Regime};
use crate::law::{Inapplicable, Pair, Pairs, ScalableLaw, YieldLimits};
use crate::layer::{Bounds, LayeredFlat};
use crate::literature::Paper;
use crate::material::Material;
use crate::numeric::interval::Interval;
use crate::numeric::lanes::{Mask, Real};
use crate::numeric::root::sign_changes;
use crate::shape::Shape;

/// A homogeneous rough body on a layered flat under one law, evaluated with the effective properties of each asperity
/// at its own indentation (Pasaribu and Schipper 2005, Eqs. 5, 9 with E_eff, nu_eff, H_eff).
///
/// Nothing in it tells the rough body from the flat: with the roles exchanged it is a coated rough body on a homogeneous flat.
///
/// For the effective properties an elliptic asperity is replaced by the sphere of equal elastic contact area.
#[derive(Debug, Clone)]
pub struct LayeredInterface<L> {
    law: L,
    layered: LayeredFlat,
    /// (1 - nu^2)/E of the rough body, 1/Pa.
    rough_compliance: f64,
    /// Yield limits of the rough body.
    rough: YieldLimits,
    /// The least yield limits of both bodies at any indentation.
    least: YieldLimits,
    /// Contacts below (w/b) (E*/onset)^2 of this size are elastic.
    elastic_below: f64,
    reference: Reference,
    /// Load jumps of the law.
    jumps: Vec<Jump>,
    /// Ratio of strength to onset of one of the bodies; see [`Self::highest_load`].
    strength_over_onset: f64,
}

/// A boundary of the law at which its load jumps.
#[derive(Debug, Clone, Copy)]
struct Jump {
    /// (w/b) (E*/onset)^2.
    place: f64,
    /// Range of the load factor, whichever body yields.
    factor: Interval,
}

/// A pair with onset/E* = 1: its critical ratios are the coefficients of (onset/E*)^2.
fn unit(strength: f64) -> Pair {
    Pair { reduced_modulus: 1.0, yield_limits: YieldLimits { onset: 1.0, strength } }
}

/// The effective pairs of asperities on a layered flat, and how they change with the indentation.
#[derive(Clone, Copy)]
pub(super) struct EffectivePairs<N> {
    pairs: Pairs<N>,
    /// Whether all are elastic whatever the hardness at their indentations. The yield limits are then the least.
    are_elastic: bool,
    /// d ln E*/d ln w.
    modulus_slope: N,
    /// d ln onset/d ln w.
    onset_slope: N,
    /// d ln strength/d ln w.
    strength_slope: N,
    /// 1/w, 1/m.
    inverse: N,
}

/// Bounds of an effective pair over a range of indentations and radii.
struct EffectiveRange {
    modulus: Interval,
    modulus_slope: Interval,
    onset: Interval,
    onset_slope: Interval,
    strength_slope: Interval,
}

impl<L: ScalableLaw> LayeredInterface<L> {
    /// The contact of a rough body with `substrate` under `coating`.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn new(
        law: L,
        rough: &Material,
        substrate: &Material,
        layered: LayeredFlat,
    ) -> Result<Self, Inapplicable> {
        Pair::between(&law, rough, substrate)?;
        let poisson = layered.poisson_range().hull(Interval::point(rough.poisson()));
        let [low, high] = [poisson.low, poisson.high].map(|nu| unit(L::ONSET.at(nu).recip()));
        let factors = law.jumps(&low).into_iter().zip(law.jumps(&high)).map(|(a, b)| Interval::between(a, b));
        let jumps = law.critical_ratios(&low).into_iter().zip(factors);
        let jumps = jumps.map(|(place, factor)| Jump { place, factor });
        let reference = Reference::new(rough, substrate);
        let yields_at = law.yield_limits_by_hardness(rough);
        let of_flat = law.limits_at(layered.hardness_range().low, poisson.low);
        let elastic_below = if law.is_hertz() {
            f64::INFINITY
        } else {
            law.critical_ratios(&low).first().copied().unwrap_or(0.0)
        };
        let is_jump = |jump: &Jump| jump.factor.low < 1.0 - JUMP || jump.factor.high > 1.0 + JUMP;
        Ok(Self {
            rough_compliance: rough.plane_compliance(),
            rough: yields_at,
            least: yields_at.with(of_flat),
            elastic_below,
            jumps: jumps.filter(|jump| reference.hardness.is_finite() && is_jump(jump)).collect(),
            strength_over_onset: low.yield_limits.strength,
            law,
            layered,
            reference,
        })
    }

    fn yields(&self) -> bool {
        self.rough.onset.is_finite() || self.layered.hardness_range().high.is_finite()
    }

    /// The effective pairs of asperities, each `spheres` spheres of `radius` (m), at indentations `w` (m).
    #[inline(always)]
    fn effective<N: Real>(&self, w: N, radius: N, spheres: N) -> EffectivePairs<N> {
        let b = spheres * radius;
        let (of_flat, compliance_slope) = self.layered.compliance(w, b);
        let compliance = of_flat + self.rough_compliance;
        let (nothing, one) = (w.splat(0.0), w.splat(1.0));
        let yield_limits = self.least.splat(w);
        let least =
            Pairs { reduced_modulus: one, yield_limits, onset_strain: yield_limits.onset * compliance };
        if w.lt(least.ratio(self.elastic_below) * radius).all() {
            let reduced_modulus = one / compliance;
            return EffectivePairs {
                pairs: Pairs { reduced_modulus, ..least },
                are_elastic: true,
                modulus_slope: -(reduced_modulus * compliance_slope),
                onset_slope: nothing,
                strength_slope: nothing,
                inverse: nothing,
            };
        }
        // One reciprocal for three: a division takes as long as a dozen products.
        let (hardness, hardness_slope, reduced_modulus, inverse) = match self.layered.hardness(w) {
            Some((hardness, slope)) => {
                let of_all = one / (compliance * hardness * w);
                let slope = slope * (of_all * (compliance * w));
                (hardness, slope, of_all * (hardness * w), of_all * (compliance * hardness))
            }
            None => {
                let of_both = one / (compliance * w);
                (w.splat(f64::INFINITY), nothing, of_both * w, of_both * compliance)
            }
        };
        let (poisson, poisson_slope) =
            if L::depends_on_poisson() { self.layered.poisson(w, b) } else { (nothing, nothing) };
        let of_flat = self.law.limits_at(hardness, poisson);
        let rough = w.splat(self.rough.onset);
        let yields_first = of_flat.onset.lt(rough);
        let onset = N::select(yields_first, of_flat.onset, rough);
        // If the onset equals the strength, one comparison suffices.
        let (mut strength, mut onset_slope, mut is_weaker) = (onset, hardness_slope, yields_first);
        if L::depends_on_poisson() {
            let rough = w.splat(self.rough.strength);
            is_weaker = of_flat.strength.lt(rough);
            strength = N::select(is_weaker, of_flat.strength, rough);
            onset_slope = onset_slope + w.splat(L::ONSET.slope) / L::ONSET.of(poisson) * poisson_slope;
        }
        let yield_limits = YieldLimits { onset, strength };
        EffectivePairs {
            pairs: Pairs { reduced_modulus, yield_limits, onset_strain: onset * compliance },
            are_elastic: false,
            modulus_slope: -(reduced_modulus * compliance_slope),
            onset_slope: N::select(yields_first, onset_slope, nothing),
            strength_slope: N::select(is_weaker, hardness_slope, nothing),
            inverse,
        }
    }

    fn effective_over(&self, w: Interval, b: Interval) -> EffectiveRange {
        let of_flat = self.layered.over(w, b);
        let modulus = (of_flat.compliance + self.rough_compliance).recip();
        let (onset, onset_slope) = Self::flat_onset(&of_flat);
        let (onset, onset_slope) = weaker(onset, onset_slope, self.rough.onset);
        let (_, strength_slope) = weaker(of_flat.hardness, of_flat.hardness_slope, self.rough.strength);
        let modulus_slope = -(modulus * of_flat.compliance_slope);
        EffectiveRange { modulus, modulus_slope, onset, onset_slope, strength_slope }
    }

    /// The onset of the flat, Pa, and d/d ln w of its logarithm.
    fn flat_onset(of_flat: &Bounds) -> (Interval, Interval) {
        let Bounds { hardness, hardness_slope, poisson, poisson_slope, .. } = *of_flat;
        let factor = Interval { low: L::ONSET.at(poisson.low), high: L::ONSET.at(poisson.high) };
        (hardness * factor, hardness_slope + poisson_slope * factor.recip() * L::ONSET.slope)
    }

    /// With P = E* b^.5 w^1.5 g(u), u = (w/b) (E*/onset)^2, and e = d ln P/d ln w of the fixed pair, the load is
    /// proportional to E*^(2e - 2) onset^(3 - 2e), with the strength in place of the onset in a plastic contact. An elastic
    /// contact has e = 3/2.
    #[inline(always)]
    fn contacts_of<N: Real>(&self, w: N, radius: N, effective: &EffectivePairs<N>) -> Contacts<N> {
        let contacts = self.law.contacts(w, radius, &effective.pairs);
        if effective.are_elastic {
            let stiffness = contacts.stiffness * (effective.modulus_slope * (2.0 / 3.0) + 1.0);
            return Contacts { stiffness, ..contacts };
        }
        let mut slope = effective.onset_slope;
        if L::depends_on_poisson() {
            slope = N::select(contacts.plastic, effective.strength_slope, slope);
        }
        let stiffness = contacts.stiffness * ((effective.modulus_slope - slope) * 2.0 + 1.0)
            + contacts.load * effective.inverse * (slope * 3.0 - effective.modulus_slope * 2.0);
        Contacts { stiffness, ..contacts }
    }

    /// (w/b) (E*/onset)^2.
    fn place(w: Interval, b: Interval, effective: &EffectiveRange) -> Interval {
        let strain = effective.modulus * effective.onset.recip();
        w * strain * strain * b.recip()
    }

    /// d ln P/d ln w = e + (2e - 2) d ln E*/d ln w + (3 - 2e) d ln(onset or strength)/d ln w (see
    /// [`Self::contacts_of`]) is linear in each of the three: its extremes are at corners of their ranges.
    fn exponents(e: Interval, effective: &EffectiveRange) -> Interval {
        let slope = effective.onset_slope.hull(effective.strength_slope);
        let at = |e: f64| effective.modulus_slope * (2.0 * e - 2.0) + slope * (3.0 - 2.0 * e) + e;
        at(e.low).hull(at(e.high))
    }

    /// All roots of w = `ratio` b (onset/E*)^2: sign changes of ln w - 2 ln onset + 2 ln E* - ln(ratio b) in ln w.
    fn crossings(&self, ratio: f64, shape: Shape) -> Vec<f64> {
        let level = (ratio * shape.radius).ln();
        let b = shape.spheres * shape.radius;
        let radius = Interval::point(b);
        let all = self.effective_over(Interval { low: 0.0, high: f64::MAX.sqrt() / b.max(1.0) }, radius);
        let bound = |onset: f64, modulus: f64| level + 2.0 * (onset / modulus).ln();
        let low = bound(all.onset.low, all.modulus.high) - 1e-9;
        let high = bound(all.onset.high, all.modulus.low) + 1e-9;
        let value = |v: f64| {
            let w = v.exp();
            let compliance = self.layered.compliance(w, b).0 + self.rough_compliance;
            v - 2.0 * (self.limits_of_flat(w, b).with(self.rough).onset * compliance).ln() - level
        };
        let over = |from: f64, to: f64| {
            let effective = self.effective_over(Interval { low: from.exp(), high: to.exp() }, radius);
            let values = Interval { low: from, high: to }
                + (effective.modulus.ln() - effective.onset.ln()) * 2.0
                + -level;
            [values, (effective.modulus_slope - effective.onset_slope) * 2.0 + 1.0]
        };
        sign_changes(&value, &over, low, high).into_iter().map(f64::exp).collect()
    }

    fn limits_of_flat(&self, w: f64, b: f64) -> YieldLimits {
        let poisson = if L::depends_on_poisson() { self.layered.poisson(w, b).0 } else { 0.0 };
        let hardness = self.layered.hardness(w).map_or(f64::INFINITY, |(hardness, _)| hardness);
        self.law.limits_at(hardness, poisson)
    }

    /// Indentations at which the body that yields first changes.
    fn onset_switches(&self, b: f64) -> Vec<f64> {
        /// Range of ln w, w in m.
        const RANGE: [f64; 2] = [-100.0, 50.0];
        if !(L::depends_on_poisson() && self.rough.onset.is_finite()) {
            return Vec::new();
        }
        let level = self.rough.onset.ln();
        let value = |v: f64| self.limits_of_flat(v.exp(), b).onset.ln() - level;
        let over = |from: f64, to: f64| {
            let w = Interval { low: from.exp(), high: to.exp() };
            let (onset, slope) = Self::flat_onset(&self.layered.over(w, Interval::point(b)));
            [onset.ln() + -level, slope]
        };
        sign_changes(&value, &over, RANGE[0], RANGE[1]).into_iter().map(f64::exp).collect()
    }

    /// An upper bound of the load at indentations from `from` to `to` (m) for any pair within `effective`. For a fixed
    /// ratio of strength to onset, load/onset decreases with increasing onset except for drops at boundaries; for
    /// another strength it differs by at most the jumps.
    fn highest_load(&self, from: f64, to: f64, shape: Shape, effective: &EffectiveRange) -> f64 {
        let w = Interval { low: from, high: to };
        let u = Self::place(w, Interval::point(shape.radius), effective);
        let possible = || self.jumps.iter().filter(|jump| u.contains(jump.place));
        let drops: f64 = possible().map(|jump| jump.factor.low.min(1.0)).product();
        let spread: f64 = self.jumps.iter().map(|jump| jump.factor.high / jump.factor.low).product();
        let strength = self.strength_over_onset * effective.onset.low;
        let yield_limits = YieldLimits { onset: effective.onset.low, strength };
        let most = Pair { reduced_modulus: effective.modulus.high, yield_limits };
        let growth = if effective.onset.high > effective.onset.low {
            effective.onset.high / effective.onset.low
        } else {
            1.0
        };
        shape.spheres * self.law.highest_load(from, to, shape.radius, &most) * growth * spread / drops
    }
}

/// The minimum of a constant and `value` with d ln value/d ln w = `slope`, and the slope of the minimum.
fn weaker(value: Interval, slope: Interval, constant: f64) -> (Interval, Interval) {
    if value.high < constant {
        (value, slope)
    } else if value.low >= constant {
        (Interval::point(constant), Interval::point(0.0))
    } else {
        (Interval { low: value.low, high: constant }, slope.hull(Interval::point(0.0)))
    }
}

impl<L: ScalableLaw> LaneContacts for &LayeredInterface<L> {
    type Local<N: Real> = EffectivePairs<N>;

    #[inline(always)]
    fn local<N: Real>(&self, w: N, radius: N, spheres: N) -> EffectivePairs<N> {
        self.effective(w, radius, spheres)
    }

    #[inline(always)]
    fn contacts<N: Real>(&self, w: N, radius: N, spheres: N, local: &EffectivePairs<N>) -> Contacts<N> {
        self.contacts_of(w, radius, local).times(spheres)
    }
}

impl<L: ScalableLaw> MicroContact for LayeredInterface<L> {
    #[inline]
    fn contact(&self, w: f64, shape: Shape) -> Contact {
        let Shape { radius, spheres } = shape;
        self.contacts_of(w, radius, &self.effective(w, radius, spheres)).times(spheres).into()
    }

    fn contacts(&self, indentations: &[f64], shape: Shape) -> ContactColumns {
        contacts(self, indentations, shape)
    }

    fn accumulate_weighted(
        &self,
        indentations: &[f64],
        weights: &[f64],
        shape: Shape,
        accumulator: &mut Accumulator,
    ) {
        accumulate_weighted(self, indentations, weights, shape, accumulator);
    }

    fn accumulate(&self, asperities: Asperities<'_>, separation: f64, accumulator: &mut Accumulator) {
        accumulate(self, asperities, separation, accumulator);
    }

    fn is_layered(&self) -> bool {
        true
    }

    fn regime_changes(&self, shape: Shape) -> Vec<f64> {
        let ratios = if self.yields() { self.law.critical_ratios(&unit(1.0)) } else { Vec::new() };
        let mut changes: Vec<f64> =
            ratios.into_iter().flat_map(|ratio| self.crossings(ratio, shape)).collect();
        changes.sort_unstable_by(f64::total_cmp);
        changes
    }

    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        let mut points = self.regime_changes(shape);
        let b = shape.spheres * shape.radius;
        // An elastic contact does not depend on the hardness, and a plastic one not on the modulus.
        let regime = |w: f64| self.contact(w, shape).regime;
        let modulus = self.layered.modulus_scales(b, self.rough_compliance);
        points.extend(modulus.filter(|&w| regime(w) != Regime::Plastic));
        let yields = |w: f64| {
            let flat = self.limits_of_flat(w, b);
            flat.onset < self.rough.onset || flat.strength < self.rough.strength
        };
        let hardness = self.layered.hardness_scales().into_iter();
        points.extend(hardness.filter(|&w| regime(w) != Regime::Elastic && yields(w)));
        points.extend(self.layered.indentation_of_hardness(self.rough.strength));
        points.extend(self.onset_switches(b));
        points.sort_unstable_by(f64::total_cmp);
        points
    }

    fn may_decrease(&self, shapes: Shapes) -> Vec<Interval> {
        /// Number of intervals of the depth over which the hardness changes.
        const PIECES: i32 = 400;
        let end = self.layered.depth();
        let wide = shapes.radii * shapes.spheres;
        // From a depth at which the hardness is still that of the layer, to infinity.
        let place = |k: i32| match k {
            0 => 0.0,
            k if k > PIECES => 1e200,
            k => end * 1e-12f64.powf(1.0 - f64::from(k) / f64::from(PIECES)),
        };
        let may_decrease = |w: &Interval| {
            let effective = self.effective_over(*w, wide);
            let u = Self::place(*w, shapes.radii, &effective);
            // A boundary crossed backwards turns an increase of the load into a decrease.
            let turns_back = (effective.modulus_slope - effective.onset_slope).low <= -0.5;
            let drops = |jump: &Jump| u.contains(jump.place) && (jump.factor.low < 1.0 || turns_back);
            Self::exponents(self.law.load_exponents(u), &effective).low <= 0.0 || self.jumps.iter().any(drops)
        };
        let pieces = (0..=PIECES).map(|k| Interval { low: place(k), high: place(k + 1) });
        Interval::union(pieces.filter(may_decrease))
    }

    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        let w = Interval { low: from, high: to };
        let effective = self.effective_over(w, Interval::point(shape.spheres * shape.radius));
        let u = Self::place(w, Interval::point(shape.radius), &effective);
        let exponents = Self::exponents(self.law.load_exponents(u), &effective);
        if self.jumps.iter().any(|jump| u.contains(jump.place)) || (from == 0.0 && exponents.low < 0.0) {
            return LoadBounds::any(self.highest_load(from, to, shape, &effective));
        }
        LoadBounds::between(w, [from, to].map(|w| self.contact(w, shape).load), exponents)
    }

    fn reference_modulus(&self) -> f64 {
        self.reference.modulus
    }

    fn reference_hardness(&self) -> f64 {
        self.reference.hardness
    }

    fn papers(&self) -> Vec<Paper> {
        self.law.papers().iter().copied().chain(self.layered.papers()).collect()
    }
}
