//! Integrals over a height density, by the tanh-sinh rule between the boundaries of the formulas.
//!
//! The stiffness is taken from the load alone, -dp/dd = -int P f' dz, so that jumps of a law are in it and no slope of
//! a law is.

use super::density::{Density, Window, density_of};
use super::{Branch, Exact, Flat, Shape, Total};
use crate::stability::wide::{Wide, integral};
use asperity::Population;

/// A population that an integral is taken over; lengths in m.
#[derive(Debug, Clone, Copy)]
pub struct Integral {
    /// Standard deviation of the heights, m.
    pub sigma: f64,
    /// Asperities per nominal area, 1/m^2.
    pub density: f64,
    /// The density of their heights.
    pub heights: &'static dyn Density,
    /// d/sigma.
    pub separation: f64,
}

/// Smallest part of the window that is searched.
const NEGLIGIBLE: f64 = 1e-15;
/// Points per decade of w at which formulas are sampled under a layer.
const PER_DECADE: f64 = 40.0;
/// Two rules differ by less than this; the error is about its square.
const TOLERANCE: f64 = 1e-12;

impl Integral {
    /// The integral over a population at a separation d/sigma; `None` for heights that are not covered.
    pub fn new(population: &Population, separation: f64) -> Option<Self> {
        let &Population { sigma, density, ref heights, .. } = population;
        Some(Self { sigma, density, heights: density_of(heights)?, separation })
    }
}

impl Exact {
    /// What the asperities of a population add up to per nominal area; `None` where the rule does not settle.
    pub fn integral(&self, of: &Integral, shape: &Shape) -> Option<Total> {
        let mut total = Total::NONE;
        let Some(window) = Window::above(of.separation, of.heights) else { return Some(total) };
        let (start, end) = (window.start, window.end);
        let mut ends = self.changes(of.sigma, end, shape);
        ends.extend(&window.cuts);
        if let Flat::Layered(layer) = &self.flat {
            let scales = layer.scales(shape.radius * shape.spheres).into_iter();
            ends.extend(scales.map(|w| w / of.sigma));
        }
        ends.retain(|x| *x > start && *x < end && *x > end * NEGLIGIBLE);
        ends.push(end);
        ends.sort_by(|a, b| a.hi().total_cmp(&b.hi()).then(a.lo().total_cmp(&b.lo())));
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
                let density = window.relative(x);
                [density, density * area, density * load, density * load * window.steepness(x)]
            })?;
            total.contacts += contacts;
            total.area[regime] += area;
            total.load[regime] += load;
            total.stiffness += slope;
            from = to;
        }
        // At a step of the density its slope has no bound.
        for (step, sign) in window.steps.into_iter().zip([-1.0, 1.0]) {
            let Some(x) = step else { continue };
            let w = x * of.sigma;
            total.stiffness +=
                self.answer(w, shape, self.branch(w, shape)).1 * window.relative(x) * Wide::new(sign);
        }
        total.stiffness /= of.sigma;
        Some(total.times(Wide::new(of.density)).times(window.root_of_peak()).times(window.root_of_peak()))
    }

    /// Boundaries between formulas, as x = w/sigma up to `end`.
    fn changes(&self, sigma: f64, end: Wide, shape: &Shape) -> Vec<Wide> {
        if let Flat::Homogeneous { .. } = self.flat {
            let w = end * sigma;
            let effective = self.effective(w, shape);
            let first = effective.flat_has_smaller(|yield_limits| yield_limits.onset);
            let Some(u) = Self::place(w, shape, &effective, first) else { return Vec::new() };
            return self.boundaries.iter().map(|boundary| *boundary / u * end).collect();
        }
        let steps = (PER_DECADE * -NEGLIGIBLE.log10()) as i32;
        let ratio = NEGLIGIBLE.powf(1.0 / f64::from(steps));
        let branch = |x: Wide| self.branch(x * sigma, shape);
        let mut found = Vec::new();
        let mut from = end * NEGLIGIBLE;
        let mut before = branch(from);
        for k in (0..steps).rev() {
            let to = end * ratio.powi(k);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::bodies::Bodies;
    use crate::stability::laws::CoveredLaw;
    use asperity::{Heights, Material};

    /// Equally probable heights from -3^.5 to 3^.5, with a step at either end.
    #[derive(Debug)]
    struct Uniform;

    fn half() -> Wide {
        Wide::new(3.0).sqrt()
    }

    impl Density for Uniform {
        fn heights(&self) -> Heights {
            unreachable!("only what is covered is looked up")
        }
        fn ln(&self, _: Wide) -> Wide {
            -(half() * 2.0).ln()
        }
        fn steepness(&self, _: Wide) -> Wide {
            Wide::ZERO
        }
        fn support(&self) -> [Option<Wide>; 2] {
            [Some(-half()), Some(half())]
        }
        fn mode(&self) -> Wide {
            -half()
        }
    }

    /// Hertz's loads of uniform heights in closed form; the stiffness is that of the steps alone.
    #[test]
    fn steps_at_both_ends_of_a_density_count() {
        let body = Material::new(2.0, 0.0, None, None).unwrap();
        let hertz = CoveredLaw::named("hertz").unwrap();
        let exact = Exact::new(&Bodies { law: hertz, rough: body, flat: body, layer: None });
        for h in [-3.0, 0.25, 2.0] {
            let of = Integral { sigma: 1.0, density: 1.0, heights: &Uniform, separation: h };
            let total = exact.integral(&of, &Shape::sphere(1.0)).unwrap();
            // (z - h)^(n + 1/2).
            let power = |z: Wide, n: i32| {
                let w = (z - h).max(Wide::ZERO);
                (0..n).fold(w.sqrt(), |product, _| product * w)
            };
            let between = |n: i32| (power(half(), n) - power(-half(), n)) / (half() * 2.0);
            let [load, stiffness] = [between(2) * 8.0 / 15.0, between(1) * 4.0 / 3.0];
            assert!((total.total_load() - load).abs().hi() <= 1e-24 * load.hi(), "{h}");
            assert!((total.stiffness - stiffness).abs().hi() <= 1e-24 * stiffness.hi(), "{h}");
        }
    }
}
