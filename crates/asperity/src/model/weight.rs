//! What weighs the micro-contacts over the indentation in the statistical integral, and its panels that are the same at all separations,
//! with the contacts at their nodes.

use std::f64::consts::{PI, SQRT_2};

use libm::erfc;

use crate::contact::ContactColumns;
use crate::distribution::{Gaussian, HeightDistribution, Heights};
use crate::interface::MicroContact;
use crate::numeric::quadrature::{Variable, panels};
use crate::shape::Shape;

/// A weight over the heights h + x above a separation h, in units of sigma, relative to its scale. The terms are those of
/// [`HeightDistribution`].
pub(super) trait Weight: Sync {
    fn decreasing_from(&self) -> f64;
    fn highest_separation(&self) -> f64;
    fn scale(&self, h: f64) -> f64;
    fn window(&self, h: f64) -> [f64; 2];
    fn panels(&self, h: f64, from: f64, to: f64) -> usize;
    fn breakpoints(&self, h: f64) -> Vec<f64>;
    fn variable(&self, h: f64, x: f64) -> f64;
    fn variable_is_indentation(&self) -> bool;
    fn relative_density(&self, h: f64, x: f64) -> f64;
    fn apply(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]);
}

impl Weight for Heights {
    fn decreasing_from(&self) -> f64 {
        (**self).decreasing_from()
    }

    fn highest_separation(&self) -> f64 {
        (**self).highest_separation()
    }

    fn scale(&self, h: f64) -> f64 {
        (**self).scale(h)
    }

    fn window(&self, h: f64) -> [f64; 2] {
        (**self).window(h)
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        (**self).panels(h, from, to)
    }

    fn breakpoints(&self, h: f64) -> Vec<f64> {
        (**self).breakpoints(h)
    }

    fn variable(&self, h: f64, x: f64) -> f64 {
        (**self).variable(h, x)
    }

    fn variable_is_indentation(&self) -> bool {
        (**self).variable_is_indentation()
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        (**self).relative_density(h, x)
    }

    fn apply(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        self.apply_density(h, nodes, weights);
    }
}

/// The survival function Q of standard normal heights, which falls as their density does.
pub(super) struct GaussianSurvival;

/// Q(t)/phi(t) for t >= 0: by the error function, and by Laplace's continued fraction where its exponential would lose digits.
fn mills_ratio(t: f64) -> f64 {
    const FROM: f64 = 4.0;
    /// The rest is below rounding from `FROM` on.
    const TERMS: u32 = 50;
    if t < FROM {
        return 0.5 * erfc(t / SQRT_2) * (2.0 * PI).sqrt() * (0.5 * t * t).exp();
    }
    let rest = (1..=TERMS).rev().fold(t, |rest, k| t + f64::from(k) / rest);
    rest.recip()
}

impl Weight for GaussianSurvival {
    fn decreasing_from(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn highest_separation(&self) -> f64 {
        Gaussian.highest_separation()
    }

    fn scale(&self, h: f64) -> f64 {
        Gaussian.scale(h)
    }

    /// Below zero it is not small anywhere.
    fn window(&self, h: f64) -> [f64; 2] {
        let [_, end] = Gaussian.window(h);
        [0.0, end]
    }

    fn panels(&self, h: f64, from: f64, to: f64) -> usize {
        Gaussian.panels(h, from, to)
    }

    fn breakpoints(&self, _h: f64) -> Vec<f64> {
        Vec::new()
    }

    fn variable(&self, _h: f64, x: f64) -> f64 {
        x
    }

    fn variable_is_indentation(&self) -> bool {
        true
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        let t = h + x;
        if h >= 0.0 {
            mills_ratio(t) * Gaussian.relative_density(h, x)
        } else {
            0.5 * erfc(t / SQRT_2) * (2.0 * PI).sqrt()
        }
    }

    fn apply(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        for (&mut x, weight) in nodes.iter_mut().zip(weights) {
            *weight *= self.relative_density(h, x);
        }
    }
}

/// Breakpoints below this fraction of the window are omitted.
pub(super) const NEGLIGIBLE: f64 = 1e-40;

/// The largest ratio of a panel's ends at which it resolves a logarithm in w to full accuracy.
const RATIO_PER_PANEL: f64 = 56.0;

/// One panel after the other from an indentation of 0 to the last breakpoint. Indentations are in units of sigma.
#[derive(Debug, Clone, Default)]
pub(super) struct FixedPanels {
    /// The upper end of each panel.
    ends: Vec<f64>,
    /// Nodes of all panels.
    pub(super) points: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// The contacts at the nodes.
    pub(super) contacts: ContactColumns,
}

impl FixedPanels {
    /// Panels between `breakpoints` up to `most`.
    pub(super) fn new(
        contact: &dyn MicroContact,
        shape: Shape,
        sigma: f64,
        breakpoints: &[f64],
        most: f64,
    ) -> Self {
        let mut fixed = Self::default();
        let is_used = |to: &f64| NEGLIGIBLE * most < *to && *to < most;
        for to in breakpoints.iter().copied().filter(is_used) {
            let from = fixed.end(fixed.ends.len());
            if to <= from {
                continue;
            }
            for [low, high] in spans(from, to, from > 0.0) {
                for panel in panels(low, high, Variable::SquareRoot, 1) {
                    fixed.points.extend(panel.points);
                    fixed.weights.extend(panel.weights);
                }
                fixed.ends.push(high);
            }
        }
        let indentations: Vec<f64> = fixed.points.iter().map(|x| x * sigma).collect();
        fixed.contacts = contact.contacts(&indentations, shape);
        fixed
    }

    /// The end of the first `count` panels.
    pub(super) fn end(&self, count: usize) -> f64 {
        if count == 0 { 0.0 } else { self.ends[count - 1] }
    }

    /// How many panels, from the first on, are within the window of `weight` at the separation `h` and resolve it.
    pub(super) fn resolved(&self, weight: &dyn Weight, h: f64) -> usize {
        let [start, end] = weight.window(h);
        let resolves = |k: usize| self.ends[k] <= end && weight.panels(h, self.end(k), self.ends[k]) == 1;
        if start > 0.0 { 0 } else { (0..self.ends.len()).take_while(|&k| resolves(k)).count() }
    }
}

/// Divides [from, to] into pieces, of a bounded ratio of their ends if the integrand contains a logarithm of w.
pub(super) fn spans(from: f64, to: f64, logarithmic: bool) -> impl Iterator<Item = [f64; 2]> {
    let ratio = to / from;
    let count = if logarithmic { (ratio.ln() / RATIO_PER_PANEL.ln()).ceil().max(1.0) as i32 } else { 1 };
    let end = move |k: i32| match k {
        0 => from,
        k if k == count => to,
        k => from * ratio.powf(f64::from(k) / f64::from(count)),
    };
    (0..count).map(move |k| [end(k), end(k + 1)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mills_ratio_keeps_its_digits() {
        // mpmath.
        for (t, exact) in [
            (0.0, 1.253_314_137_315_500_3),
            (1.0, 0.655_679_542_418_798_5),
            (3.999, 0.236_705_784_929_564_83),
            (4.0, 0.236_652_382_913_560_67),
            (12.0, 0.082_766_286_501_369_18),
        ] {
            assert!((mills_ratio(t) / exact - 1.0).abs() < 4e-15, "{t}: {}", mills_ratio(t));
        }
    }
}
