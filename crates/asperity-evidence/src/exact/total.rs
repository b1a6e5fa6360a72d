//! Sums over asperities, and integrals over a height density by the tanh-sinh rule between the boundaries of the formulas.
//!
//! The stiffness of an integral is taken from the load alone, -dp/dd = -int P f' dz, so that jumps of a law are in it and no slope of a
//! law is.

use super::density::{Density, Window, density_of};
use super::{Exact, ExactFlat, Shape, ends};
use crate::wide::{Wide, integral};
use asperity::Population;
use rayon::prelude::*;

/// A population that an integral is taken over; lengths in m.
#[derive(Debug, Clone, Copy)]
pub struct Integral {
    /// Standard deviation of the heights, m.
    pub sigma: f64,
    /// Asperities per nominal area, 1/m^2.
    pub density: f64,
    pub heights: &'static Density,
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

/// What asperities add up to, SI; area and load by regime.
#[derive(Debug, Clone, Copy)]
pub struct Total {
    pub contacts: Wide,
    pub area: [Wide; 3],
    pub load: [Wide; 3],
    pub stiffness: Wide,
    /// Sums of the squares of areas and of loads.
    pub squares: [Wide; 2],
}

impl Total {
    const NONE: Self = Self {
        contacts: Wide::ZERO,
        area: [Wide::ZERO; 3],
        load: [Wide::ZERO; 3],
        stiffness: Wide::ZERO,
        squares: [Wide::ZERO; 2],
    };

    pub fn total_area(&self) -> Wide {
        self.area[0] + self.area[1] + self.area[2]
    }

    pub fn total_load(&self) -> Wide {
        self.load[0] + self.load[1] + self.load[2]
    }

    fn plus(mut self, other: &Self) -> Self {
        for regime in 0..3 {
            self.area[regime] += other.area[regime];
            self.load[regime] += other.load[regime];
        }
        for k in 0..2 {
            self.squares[k] += other.squares[k];
        }
        Self { contacts: self.contacts + other.contacts, stiffness: self.stiffness + other.stiffness, ..self }
    }
}

impl Exact {
    /// The asperities (height and radius, m) that stand above the flat at `separation` (m). The stiffness takes four
    /// more contacts per asperity; it is zero unless `stiff`.
    pub fn total(&self, asperities: &[(f64, f64)], separation: Wide, stiff: bool) -> Total {
        const CHUNK: usize = 4096;
        let parts: Vec<Total> = asperities
            .par_chunks(CHUNK)
            .map(|chunk| {
                let mut total = Total::NONE;
                for &(height, radius) in chunk {
                    let (w, shape) = (Wide::new(height) - separation, Shape::sphere(radius));
                    if w <= Wide::ZERO {
                        continue;
                    }
                    let branch = self.branch(w, &shape);
                    let (area, load, regime) = self.answer(w, &shape, branch);
                    let regime = regime as usize;
                    total.contacts += 1.0;
                    total.area[regime] += area;
                    total.load[regime] += load;
                    total.squares = [total.squares[0] + area * area, total.squares[1] + load * load];
                    if stiff {
                        total.stiffness += self.stiffness_by(w, &shape, branch);
                    }
                }
                total
            })
            .collect();
        parts.iter().fold(Total::NONE, Total::plus)
    }

    /// What the asperities of a population add up to per nominal area; `None` where the rule does not settle.
    pub fn integral(&self, of: &Integral, shape: &Shape) -> Option<Total> {
        let mut total = Total::NONE;
        let Some(window) = Window::above(of.separation, of.heights) else { return Some(total) };
        let (start, end) = (window.start, window.end);
        let mut ends = self.changes(of.sigma, end, shape);
        ends.extend(&window.cuts);
        if let ExactFlat::Layered(layer) = &self.flat {
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
        // The largest density itself would be denormal where the result is not.
        for factor in [Wide::new(of.density), window.root_of_peak(), window.root_of_peak()] {
            let parts = total.area.iter_mut().chain(&mut total.load);
            parts.chain([&mut total.contacts, &mut total.stiffness]).for_each(|part| *part *= factor);
        }
        Some(total)
    }

    /// Boundaries between formulas, as x = w/sigma up to `end`.
    fn changes(&self, sigma: f64, end: Wide, shape: &Shape) -> Vec<Wide> {
        if let ExactFlat::Homogeneous { .. } = self.flat {
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
                from = ends(|x| branch(x) == before, from, to, 110)[1];
                found.push(from);
                before = branch(from * (Wide::ONE + 1e-28));
            }
            from = to;
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Bodies, CoveredLaw};
    use asperity::{Heights, Material};

    fn half() -> Wide {
        Wide::new(3.0).sqrt()
    }

    /// Equally probable heights from -3^.5 to 3^.5, with a step at either end.
    static UNIFORM: Density = Density {
        heights: Heights::GAUSSIAN,
        ln: |_| -(half() * 2.0).ln(),
        steepness: |_| Wide::ZERO,
        support: || [Some(-half()), Some(half())],
        mode: || -half(),
    };

    /// Hertz's loads of uniform heights in closed form; the stiffness is that of the steps alone.
    #[test]
    fn steps_at_both_ends_of_a_density_count() {
        let body = Material::new(2.0, 0.0, None, None).unwrap();
        let hertz = CoveredLaw::named("hertz").unwrap();
        let exact = Exact::new(&Bodies { law: hertz, rough: body, flat: body, layer: None });
        for h in [-3.0, 0.25, 2.0] {
            let of = Integral { sigma: 1.0, density: 1.0, heights: &UNIFORM, separation: h };
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
