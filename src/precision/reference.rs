//! Area and load in about 32 digits, from the equations alone.

use crate::asperity::Population;
use crate::material::Material;
use crate::numeric::wide::{PI, Wide, integral};

/// The laws that the reference knows, with their numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Equations {
    /// Hertz: P = (4/3) E* b^.5 w^1.5, A = pi b w.
    Hertz,
    /// Zhao, Maietta and Chang (Pasaribu and Schipper 2005, Eqs. 2, 4, 6-8, 10-12).
    Zmc {
        /// w1 E*^2/(b H^2); (0.3 pi)^2 if not given.
        onset: Option<f64>,
        /// w2/w1.
        transition_ratio: f64,
    },
}

/// One micro-contact of two homogeneous bodies.
pub struct Reference {
    equations: Equations,
    /// E*, Pa.
    modulus: Wide,
    /// Of the softer body, Pa; `None` if neither yields.
    hardness: Option<Wide>,
}

impl Reference {
    /// The contact of two bodies.
    pub fn new(equations: Equations, bodies: &[Material; 2]) -> Self {
        let compliance = |body: &Material| {
            let nu = Wide::new(body.poisson());
            (Wide::ONE - nu * nu) / Wide::new(body.young())
        };
        let hardness = bodies.iter().filter_map(Material::hardness).reduce(f64::min);
        Self {
            equations,
            modulus: (compliance(&bodies[0]) + compliance(&bodies[1])).recip(),
            hardness: hardness.map(Wide::new),
        }
    }

    /// w1 (m) of a sphere of radius `b` (m), w2/w1 and the hardness; `None` where nothing yields.
    fn onset(&self, b: Wide) -> Option<(Wide, Wide, Wide)> {
        let Equations::Zmc { onset, transition_ratio } = self.equations else { return None };
        let hardness = self.hardness?;
        let root = PI * 3.0 / 10.0;
        let onset = onset.map_or(root * root, Wide::new);
        let strain = hardness / self.modulus;
        Some((onset * strain * strain * b, Wide::new(transition_ratio), hardness))
    }

    /// Area (m^2) and load (N) at the indentation `w` (m) of a sphere of radius `b` (m).
    fn contact(&self, w: Wide, b: Wide) -> [Wide; 2] {
        let elastic = PI * b * w;
        match self.onset(b) {
            Some((w1, ratio, hardness)) if w >= w1 * ratio => [elastic * 2.0, hardness * elastic * 2.0],
            Some((w1, ratio, hardness)) if w > w1 => {
                let x = (w - w1) / (w1 * ratio - w1);
                let area = elastic * (Wide::ONE + x * x * (Wide::new(3.0) - x * 2.0));
                let fraction = (w1 * ratio / w).ln() / ratio.ln();
                [area, hardness * (Wide::ONE - fraction * 3.0 / 5.0) * area]
            }
            _ => [elastic, self.modulus * 4.0 / 3.0 * b.sqrt() * w * w.sqrt()],
        }
    }

    /// Area ratio and nominal pressure (Pa) of a population of Gaussian heights at the separation `h` = d/sigma:
    /// eta times the integral of the contact over the density, split where the equations change, by the
    /// tanh-sinh rule. `None` if that does not settle.
    pub fn integral(&self, population: &Population, h: f64) -> Option<[Wide; 2]> {
        /// The density falls by exp(-90) = 1e-39 of its largest value up to the end.
        const FOLDINGS: f64 = 90.0;
        /// Of two successive rules: the error is about its square.
        const TOLERANCE: f64 = 1e-14;
        let (sigma, b, h) = (Wide::new(population.sigma), Wide::new(population.radius), Wide::new(h));
        let reach = Wide::new(2.0 * FOLDINGS);
        // Where h x + x^2/2 = 90 if the flat lies above the mean, and |x + h|^2/2 = 90 if below.
        let end = if h.hi() >= 0.0 { (h * h + reach).sqrt() - h } else { reach.sqrt() - h };
        let start = if h.hi() >= 0.0 { Wide::ZERO } else { (-reach.sqrt() - h).max(Wide::ZERO) };
        let mode = (h.hi() < 0.0).then_some(-h);
        let changes = self.onset(b).map(|(w1, ratio, _)| [w1 / sigma, w1 * ratio / sigma]);
        let mut ends: Vec<Wide> =
            [start, end].into_iter().chain(mode).chain(changes.into_iter().flatten()).collect();
        ends.retain(|x| (start..=end).contains(x));
        ends.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        let mut sums = [Wide::ZERO; 2];
        for pair in ends.windows(2).filter(|pair| pair[0] < pair[1]) {
            let part = integral(pair[0], pair[1], TOLERANCE, |x| {
                let z = x + h;
                let density = (-(z * z) * 0.5).exp();
                self.contact(x * sigma, b).map(|value| value * density)
            })?;
            sums = [sums[0] + part[0], sums[1] + part[1]];
        }
        let scale = Wide::new(population.density) / (PI * 2.0).sqrt();
        Some(sums.map(|sum| sum * scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asperity::{HeightDensity, gaussian_moment};

    fn steel() -> Material {
        Material::new(210e9, 0.3, Some(7.6e9), None).unwrap()
    }

    const CASE: Population =
        Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: HeightDensity::Gaussian };

    #[test]
    fn hertz_is_the_closed_form() {
        let reference = Reference::new(Equations::Hertz, &[steel(), steel()]);
        for h in [-2.0, 0.0, 1.0, 2.0] {
            let [area, load] = reference.integral(&CASE, h).unwrap().map(Wide::hi);
            let exact = std::f64::consts::PI * 6e10 * 2e-5 * 4.8e-8 * gaussian_moment(1.0, h);
            assert!((area / exact - 1.0).abs() < 1e-11, "{area:e} {exact:e}");
            let modulus = 210e9 / 1.82;
            let exact = 4.0 / 3.0 * 6e10 * modulus * 2e-5f64.sqrt() * 4.8e-8f64.powf(1.5);
            assert!((load / exact / gaussian_moment(1.5, h) - 1.0).abs() < 1e-11);
        }
    }
}
