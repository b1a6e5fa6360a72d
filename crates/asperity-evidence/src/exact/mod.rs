//! Results in about 32 digits, from the equations of docs/theory.md: no formula, table or quadrature is shared with the models.

mod density;
mod laws;
mod layer;
mod total;

pub use density::{COVERED, Density, density_of};
pub use laws::CoveredLaw;
pub(crate) use laws::TWINS;
pub use total::{Integral, Total};

use crate::wide::{PI, Wide};
use asperity::{ContactError, Flat, Material, MicroContact, ModulusModel, Regime};
use laws::YieldLimits;
use layer::EffectiveLayer;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    pub material: Material,
    /// m; 0 and infinity are no layer and all layer.
    pub thickness: f64,
    pub rule: ModulusModel,
}

#[derive(Debug, Clone)]
pub struct Bodies {
    pub law: CoveredLaw,
    pub rough: Material,
    /// The flat, or what is below its layer.
    pub flat: Material,
    pub layer: Option<Layer>,
}

impl Bodies {
    pub fn contact(&self) -> Result<Box<dyn MicroContact>, ContactError> {
        let flat = match &self.layer {
            Some(layer) => Flat::with_layer(&layer.material, &self.flat, layer.thickness, layer.rule)?,
            None => Flat::Bare(self.flat),
        };
        Ok(self.law.chosen().interface(&self.rough, &flat)?)
    }
}

/// The pair that an asperity feels.
#[derive(Debug, Clone, Copy)]
struct EffectivePair {
    modulus: Wide,
    rough: Option<YieldLimits>,
    flat: Option<YieldLimits>,
}

/// The valid formula: the range of the law, and which body yields first and is weaker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Branch {
    range: usize,
    flat_yields_first: bool,
    flat_is_weaker: bool,
}

/// One contact, SI.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    pub area: Wide,
    pub load: Wide,
    pub stiffness: Wide,
    pub regime: Regime,
}

#[derive(Debug, Clone)]
pub struct Exact {
    law: CoveredLaw,
    rough_compliance: Wide,
    rough: Option<YieldLimits>,
    flat: ExactFlat,
    boundaries: Vec<Wide>,
}

#[derive(Debug, Clone)]
enum ExactFlat {
    Homogeneous { compliance: Wide, yield_limits: Option<YieldLimits> },
    Layered(EffectiveLayer),
}

/// How near to a boundary, relative to the place itself, the results of both sides are accepted: the rounding of the boundary.
const BESIDE: f64 = 16.0 * f64::EPSILON;
/// The same under a layer, whose effective properties go into it.
const BESIDE_LAYERED: f64 = 1e-13;

/// (1 - nu^2)/E, 1/Pa.
fn compliance(body: &Material) -> Wide {
    let nu = Wide::new(body.poisson());
    (Wide::ONE - nu * nu) / body.young()
}

impl Exact {
    pub fn new(bodies: &Bodies) -> Self {
        let yield_limits = |body: &Material| {
            let wide = |value: Option<f64>| value.map(Wide::new);
            let [hardness, strength] = [body.hardness(), body.yield_strength()].map(wide);
            (bodies.law.twin.yield_limits)(Wide::new(body.poisson()), hardness, strength)
        };
        let homogeneous = |body: &Material| ExactFlat::Homogeneous {
            compliance: compliance(body),
            yield_limits: yield_limits(body),
        };
        let flat = match &bodies.layer {
            Some(layer) if layer.thickness == f64::INFINITY => homogeneous(&layer.material),
            Some(layer) if layer.thickness > 0.0 => {
                ExactFlat::Layered(EffectiveLayer::new(layer, &bodies.flat))
            }
            _ => homogeneous(&bodies.flat),
        };
        Self {
            law: bodies.law.clone(),
            rough_compliance: compliance(&bodies.rough),
            rough: yield_limits(&bodies.rough),
            flat,
            boundaries: bodies.law.boundaries(),
        }
    }

    /// What an asperity feels at the indentation `w` (m).
    fn effective(&self, w: Wide, shape: &Shape) -> EffectivePair {
        let (compliance, flat) = match &self.flat {
            ExactFlat::Homogeneous { compliance, yield_limits } => (*compliance, *yield_limits),
            ExactFlat::Layered(layer) => {
                let contact_radius = (shape.spheres * shape.radius * w).sqrt();
                let (compliance, poisson, hardness) = layer.effective(w, contact_radius);
                (compliance, (self.law.twin.yield_limits)(poisson, hardness, None))
            }
        };
        EffectivePair { modulus: (self.rough_compliance + compliance).recip(), rough: self.rough, flat }
    }

    /// (w/b) (E*/onset)^2; `None` where nothing yields.
    fn place(w: Wide, shape: &Shape, effective: &EffectivePair, flat_yields_first: bool) -> Option<Wide> {
        let strain = effective.modulus / effective.body(flat_yields_first)?.onset;
        Some(w / shape.radius * strain * strain)
    }

    fn branch(&self, w: Wide, shape: &Shape) -> Branch {
        self.branches(w, shape, -1.0)[0]
    }

    /// The branch at `w`, and those whose boundary is relatively nearer than `beside`.
    fn branches(&self, w: Wide, shape: &Shape, beside: f64) -> Vec<Branch> {
        let near = |place: Wide, boundary: Wide| (place - boundary).abs() <= boundary * beside;
        let effective = self.effective(w, shape);
        let sides = |of: fn(&YieldLimits) -> Wide| match (&effective.rough, &effective.flat) {
            (Some(rough), Some(flat)) if near(of(flat), of(rough)) => vec![false, true],
            _ => vec![effective.flat_has_smaller(of)],
        };
        let mut found = Vec::new();
        for flat_yields_first in sides(|yield_limits| yield_limits.onset) {
            let place = Self::place(w, shape, &effective, flat_yields_first);
            let ranges: Vec<usize> = place.map_or(vec![0], |u| {
                let range = self.boundaries.iter().filter(|&&boundary| u >= boundary).count();
                let before = range > 0 && near(u, self.boundaries[range - 1]);
                let behind = self.boundaries.get(range).is_some_and(|&boundary| near(u, boundary));
                [(true, range), (before, range.wrapping_sub(1)), (behind, range + 1)]
                    .into_iter()
                    .filter_map(|(is_it, range)| is_it.then_some(range))
                    .collect()
            });
            for flat_is_weaker in sides(|yield_limits| yield_limits.strength) {
                found.extend(ranges.iter().map(|&range| Branch { range, flat_yields_first, flat_is_weaker }));
            }
        }
        found
    }

    /// Area, load and regime by one formula.
    fn answer(&self, w: Wide, shape: &Shape, branch: Branch) -> (Wide, Wide, Regime) {
        let effective = self.effective(w, shape);
        let yield_limits = effective
            .body(branch.flat_yields_first)
            .zip(effective.body(branch.flat_is_weaker))
            .map(|(first, weaker)| YieldLimits { onset: first.onset, strength: weaker.strength });
        let (area, load, regime) =
            self.law.answer(branch.range, w, shape.radius, effective.modulus, yield_limits);
        (shape.spheres * area, shape.spheres * load, regime)
    }

    /// dP/dw by central differences of the fourth order, with the formula held: good to 1e-24.
    fn stiffness_by(&self, w: Wide, shape: &Shape, branch: Branch) -> Wide {
        const STEP: f64 = 1e-6;
        let load = |steps: f64| self.answer(w * (Wide::ONE + steps * STEP), shape, branch).1;
        let (near, far) = (load(1.0) - load(-1.0), load(2.0) - load(-2.0));
        (near * 8.0 - far) / (w * 12.0 * STEP)
    }

    /// The contact at `w` (m); next to a boundary between two formulas, both.
    pub fn contacts(&self, w: f64, shape: &Shape) -> Vec<Contact> {
        let w = Wide::new(w);
        let contact = |branch: Branch| {
            let (area, load, regime) = self.answer(w, shape, branch);
            Contact { area, load, stiffness: self.stiffness_by(w, shape, branch), regime }
        };
        let is_layered = matches!(self.flat, ExactFlat::Layered(_));
        let beside = if is_layered { BESIDE_LAYERED } else { BESIDE };
        self.branches(w, shape, beside).into_iter().map(contact).collect()
    }
}

impl EffectivePair {
    fn body(&self, flat: bool) -> Option<YieldLimits> {
        if flat { self.flat } else { self.rough }
    }

    fn flat_has_smaller(&self, of: impl Fn(&YieldLimits) -> Wide) -> bool {
        match (&self.rough, &self.flat) {
            (Some(rough), Some(flat)) => of(flat) < of(rough),
            (None, _) => true,
            (_, None) => false,
        }
    }
}

/// So many equal spheres side by side.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// b, m.
    pub radius: Wide,
    /// n, 1 of a sphere.
    pub spheres: Wide,
}

impl Shape {
    pub fn sphere(radius: f64) -> Self {
        Self { radius: Wide::new(radius), spheres: Wide::ONE }
    }

    /// A paraboloid of mean curvature `mean_curvature` (1/m) and `ratio` = kmax/kmin: m from [E/(1-m) - K]/(K - E) =
    /// `ratio`, by bisection of ln(1 - m) and then by secants.
    pub fn ellipse(mean_curvature: f64, ratio: f64) -> Self {
        let wanted = Wide::new(ratio).ln();
        // ln(ratio) decreases as v = ln(1 - m) grows, by 3/4 at a circle to 1.
        let value = |v: Wide| {
            let minor = v.exp();
            let [k, e] = complete(minor);
            ((e / minor - k) / (k - e)).ln() - wanted
        };
        let (low, high) = (-wanted * 4.0 / 3.0 - 1e-3, -wanted / 2.0);
        let [mut before, mut now] = ends(|v| value(v) > Wide::ZERO, low, high, 40);
        let (mut of_before, mut of_now) = (value(before), value(now));
        for _ in 0..6 {
            let change = of_now - of_before;
            if change == Wide::ZERO || of_now == Wide::ZERO {
                break;
            }
            let next = now - of_now * (now - before) / change;
            (before, of_before) = (now, of_now);
            (now, of_now) = (next, value(next));
        }
        let minor = now.exp();
        let [k, e] = complete(minor);
        let half = PI / (k * 2.0);
        Self { radius: k * e * 4.0 / (PI * PI * mean_curvature), spheres: half * half / minor.sqrt() }
    }
}

/// Places on both sides of where `holds` ends on the way from `inside`, where it holds, to `outside`, by so many bisections.
fn ends(holds: impl Fn(Wide) -> bool, mut inside: Wide, mut outside: Wide, steps: usize) -> [Wide; 2] {
    for _ in 0..steps {
        let middle = (inside + outside) * 0.5;
        if holds(middle) { inside = middle } else { outside = middle }
    }
    [inside, outside]
}

/// K(m) and E(m), given 1 - m, by the arithmetic-geometric mean.
fn complete(minor: Wide) -> [Wide; 2] {
    let (mut arithmetic, mut geometric) = (Wide::ONE, minor.sqrt());
    let mut sum = (Wide::ONE - minor) * 0.5;
    let mut power = Wide::new(0.5);
    for _ in 0..60 {
        let difference = (arithmetic - geometric) * 0.5;
        (arithmetic, geometric) = ((arithmetic + geometric) * 0.5, (arithmetic * geometric).sqrt());
        power *= 2.0;
        sum += power * difference * difference;
        if difference.abs() < Wide::new(1e-17) * arithmetic {
            break;
        }
    }
    let k = PI / (arithmetic * 2.0);
    [k, k * (Wide::ONE - sum)]
}
