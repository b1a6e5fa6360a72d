//! Integrals over a height density, by the tanh-sinh rule between the boundaries of the formulas.
//!
//! The stiffness is taken from the load alone, -dp/dd = -int P f' dz, so that jumps of a law are in it and no slope of
//! a law is.

use super::{Branch, Exact, Flat};
use crate::stability::exact::Shape;
use crate::stability::exact::Total;
use crate::stability::wide::{PI, Wide, integral};
use asperity::{Heights, Population};

/// A height distribution that an integral can be taken over in about 32 digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Density {
    /// Gaussian heights.
    Gaussian,
    /// Exponential heights.
    Exponential,
}

impl Density {
    /// The density of the heights, where it is covered.
    pub fn of(heights: &Heights) -> Option<Self> {
        let covered = [(Heights::GAUSSIAN, Self::Gaussian), (Heights::EXPONENTIAL, Self::Exponential)];
        covered.into_iter().find_map(|(covered, density)| (covered == *heights).then_some(density))
    }
}

/// A population that an integral is taken over; lengths in m.
#[derive(Debug, Clone, Copy)]
pub struct Integral {
    /// Standard deviation of the heights, m.
    pub sigma: f64,
    /// Asperities per nominal area, 1/m^2.
    pub density: f64,
    /// Their density.
    pub heights: Density,
    /// d/sigma.
    pub separation: f64,
}

/// E-foldings of the density that count: exp(-76) = 1e-33.
const FOLDINGS: f64 = 76.0;
/// Places between which the density is cut, as indentations over sigma from where it is largest.
const CUTS: [f64; 6] = [0.0, 1.0, 3.0, 6.0, 9.0, 12.0];
/// Smallest part of the window that is searched.
const NEGLIGIBLE: f64 = 1e-15;
/// Points per decade of w at which formulas are sampled under a layer.
const PER_DECADE: f64 = 40.0;
/// Two rules differ by less than this; the error is about its square.
const TOLERANCE: f64 = 1e-12;

impl Integral {
    /// The integral over a population at a separation d/sigma; `None` for heights that are not covered.
    pub fn of(population: &Population, separation: f64) -> Option<Self> {
        let &Population { sigma, density, ref heights, .. } = population;
        Some(Self { sigma, density, heights: Density::of(heights)?, separation })
    }

    /// ln of the density over its factor [`Self::scale`], turned over, at x = (z - d)/sigma.
    fn exponent(&self, x: Wide) -> Wide {
        let h = self.separation;
        match self.heights {
            Density::Gaussian if h >= 0.0 => x * (x * 0.5 + h),
            Density::Gaussian => (x + h) * (x + h) * 0.5,
            Density::Exponential if h >= -1.0 => x,
            Density::Exponential => x + h + 1.0,
        }
    }

    /// The square root of the factor of the density that does not depend on x: the factor itself would be denormal
    /// where the answer is not.
    fn scale(&self) -> Wide {
        let h = Wide::new(self.separation);
        match self.heights {
            Density::Gaussian => {
                let peak = if self.separation >= 0.0 { (h * h * -0.25).exp() } else { Wide::ONE };
                peak / (PI * 2.0).sqrt().sqrt()
            }
            Density::Exponential if self.separation >= -1.0 => (-(h + 1.0) * 0.5).exp(),
            Density::Exponential => Wide::ONE,
        }
    }

    fn window(&self) -> [f64; 2] {
        let (h, reach) = (self.separation, 2.0 * FOLDINGS);
        match self.heights {
            Density::Gaussian if h >= 0.0 => [0.0, reach / (h + (h * h + reach).sqrt())],
            Density::Gaussian => [(-h - reach.sqrt()).max(0.0), reach.sqrt() - h],
            Density::Exponential => {
                let start = (-1.0 - h).max(0.0);
                [start, start + FOLDINGS]
            }
        }
    }

    /// Places that part the window by how the density changes.
    fn cuts(&self) -> Vec<f64> {
        let h = self.separation;
        match self.heights {
            Density::Gaussian if h >= 0.0 => {
                let along = |foldings: f64| 2.0 * foldings / (h + (h * h + 2.0 * foldings).sqrt());
                [6.0, 24.0].map(along).to_vec()
            }
            Density::Gaussian => CUTS.iter().flat_map(|cut| [-h - cut, -h + cut]).collect(),
            Density::Exponential => [8.0, 30.0].map(|cut| (-1.0 - h).max(0.0) + cut).to_vec(),
        }
    }
}

impl Exact {
    /// What the asperities of a population add up to per nominal area; `None` where the rule does not settle.
    pub fn integral(&self, of: &Integral, shape: &Shape) -> Option<Total> {
        let [start, end] = of.window().map(Wide::new);
        let h = of.separation;
        let mut ends = self.changes(of, shape);
        ends.extend(of.cuts().into_iter().map(Wide::new));
        if let Flat::Layered(layer) = &self.flat {
            let scales = layer.scales(shape.radius * shape.spheres).into_iter();
            ends.extend(scales.map(|w| w / of.sigma));
        }
        ends.retain(|x| *x > start && *x < end && *x > end * NEGLIGIBLE);
        ends.push(end);
        ends.sort_by(|a, b| a.hi().total_cmp(&b.hi()).then(a.lo().total_cmp(&b.lo())));
        let mut total = Total::NONE;
        let mut from = start;
        for to in ends {
            if to <= from {
                continue;
            }
            let middle = if from > Wide::ZERO { (from * to).sqrt() } else { to * 0.5 };
            let branch = self.branch(middle * of.sigma, shape);
            let regime = self.answer(middle * of.sigma, shape, branch).2 as usize;
            let [contacts, area, load, slope] = integral(from, to, TOLERANCE, |x| {
                let (area, load, _) = self.answer(x * of.sigma, shape, branch);
                let density = (-of.exponent(x)).exp();
                let steepness = match of.heights {
                    Density::Gaussian => x + h,
                    Density::Exponential => Wide::ONE,
                };
                [density, density * area, density * load, density * load * steepness]
            })?;
            total.contacts += contacts;
            total.area[regime] += area;
            total.load[regime] += load;
            total.stiffness += slope;
            from = to;
        }
        // An exponential density begins with a step, at which its slope has no bound.
        if of.heights == Density::Exponential && start > Wide::ZERO {
            let w = (Wide::new(-1.0) - h) * of.sigma;
            total.stiffness -= self.answer(w, shape, self.branch(w, shape)).1;
        }
        total.stiffness /= of.sigma;
        Some(total.times(Wide::new(of.density)).times(of.scale()).times(of.scale()))
    }

    /// Boundaries between formulas, as x = w/sigma within the window.
    fn changes(&self, of: &Integral, shape: &Shape) -> Vec<Wide> {
        let end = of.window()[1];
        if let Flat::Homogeneous { .. } = self.flat {
            let w = Wide::new(end * of.sigma);
            let effective = self.effective(w, shape);
            let first = effective.flat_has_smaller(|yield_limits| yield_limits.onset);
            let Some(u) = Self::place(w, shape, &effective, first) else { return Vec::new() };
            return self.boundaries.iter().map(|boundary| *boundary / u * end).collect();
        }
        let steps = (PER_DECADE * -NEGLIGIBLE.log10()) as i32;
        let ratio = NEGLIGIBLE.powf(1.0 / f64::from(steps));
        let branch = |x: Wide| self.branch(x * of.sigma, shape);
        let mut found = Vec::new();
        let mut from = Wide::new(end * NEGLIGIBLE);
        let mut before = branch(from);
        for k in (0..steps).rev() {
            let to = Wide::new(end * ratio.powi(k));
            let behind = branch(to);
            while before != behind {
                from = last_of(before, from, to, &branch);
                found.push(from);
                before = branch(from * (Wide::ONE + 1e-28));
            }
            from = to;
        }
        found
    }
}

/// Where the branch that holds at `from` ends, another holding at `to`.
fn last_of(held: Branch, from: Wide, to: Wide, branch: &impl Fn(Wide) -> Branch) -> Wide {
    let (mut low, mut high) = (from, to);
    for _ in 0..110 {
        let middle = (low + high) * 0.5;
        if branch(middle) == held {
            low = middle
        } else {
            high = middle
        }
        if (high - low).hi() <= 1e-30 * high.hi() {
            break;
        }
    }
    high
}
