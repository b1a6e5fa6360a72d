//! The integral equation of one contact, in units of the layer.

use std::f64::consts::PI;

use super::convolution::Convolution;
use super::influence::Influence;

/// Width of a panel of 24 nodes. The solution is analytic within 2i of the contact, as is the influence function; the
/// quadrature error decreases by 2.4^2 per node, to below rounding.
const PANEL: f64 = 4.0;

/// A contact of given radius: lengths in t, w in t^2/R, P in E1* t^3/R, dP/dw in E1* t.
pub struct State {
    /// w.
    pub indentation: f64,
    /// P.
    pub load: f64,
    /// dP/dw.
    pub stiffness: f64,
    /// dw/da.
    pub slope: f64,
    /// d(dP/dw)/da.
    pub stiffening: f64,
}

impl State {
    /// Solves, for -a <= tau <= a and with the g that vanishes at both ends (no pressure at the edge),
    ///
    /// ```text
    /// shift g(tau) + (1/pi) int_-a^a m(|tau - tau'|) g(tau') dtau' = w - tau^2
    /// P = int_-a^a g,   g = w flat - round
    /// ```
    ///
    /// where the solutions `flat` and `round` of the right-hand sides 1 and tau^2 give w = round(a)/flat(a).
    /// A change of a moves the edge, where the pressure is zero, so that dg = flat dw: dP/dw is the stiffness
    /// of a flat punch, and g(a) = 0 for every a gives dw/da = -g'(a)/flat(a). The same argument for `flat`
    /// itself gives the change of the stiffness, 2 shift flat(a)^2.
    ///
    /// `None` if the iteration does not converge.
    pub fn solve(influence: &Influence, shift: f64, a: f64) -> Option<Self> {
        Self::on_panels(influence, shift, a, (2.0 * a / PANEL).ceil() as usize)
    }

    fn on_panels(influence: &Influence, shift: f64, a: f64, count: usize) -> Option<Self> {
        let kernel = |y: f64| influence.at(y) / PI;
        let operator = Convolution::new(shift, kernel, a, count);
        let flat = operator.solve(|_| 1.0)?;
        // In units of a^2, to avoid underflow.
        let round = operator.solve(|y| (y / a) * (y / a))?;
        // Nystrom's interpolation: the equation itself at its end.
        let end = |g: &[f64]| {
            let rest: f64 = operator.nodes().zip(g).map(|((y, weight), g)| weight * kernel(a - y) * g).sum();
            (1.0 - rest) / shift
        };
        let integral =
            |g: &[f64]| -> f64 { operator.nodes().zip(g).map(|((_, weight), g)| weight * g).sum() };
        let flat_end = end(&flat);
        let indentation = end(&round) / flat_end;
        let pressure: Vec<f64> =
            flat.iter().zip(&round).map(|(flat, round)| indentation * flat - round).collect();
        Some(Self {
            indentation: indentation * a * a,
            load: integral(&pressure) * a * a,
            stiffness: integral(&flat),
            slope: -operator.slope_at_end(&pressure) / flat_end * a * a,
            stiffening: 2.0 * shift * flat_end * flat_end,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layer::exact_sphere::kernel::Kernel;
    use crate::material::Material;

    fn influence(ratio: f64) -> Influence {
        let body = |young, poisson| Material::new(young, poisson, None, None).unwrap();
        Influence::new(Kernel::new(&body(ratio, 0.35), &body(1.0, 0.3)), 500.0)
    }

    #[test]
    fn twice_the_nodes_change_nothing() {
        for ratio in [1e-3, 0.1, 1.0, 10.0, 1e3] {
            let influence = influence(ratio);
            for a in [1e-60, 1e-5, 0.1, 1.0, 1.99, 2.01, 10.0, 210.0] {
                let state = State::solve(&influence, 1.0, a).unwrap();
                let count = 2 * (2.0 * a / PANEL).ceil() as usize;
                let fine = State::on_panels(&influence, 1.0, a, count).unwrap();
                let errors = [
                    state.indentation / fine.indentation - 1.0,
                    state.load / fine.load - 1.0,
                    state.stiffness / fine.stiffness - 1.0,
                ];
                assert!(errors.iter().all(|error| error.abs() < 1e-12), "{errors:?} at {a} for {ratio}");
            }
        }
    }

    #[test]
    fn slopes_are_those_of_indentation_and_stiffness() {
        for ratio in [1e-3, 0.1, 1.0, 10.0, 1e3] {
            let influence = influence(ratio);
            for a in [1e-5, 0.1, 1.0, 3.0, 10.0] {
                let at = |a| State::solve(&influence, 1.3, a).unwrap();
                let step = 1e-4 * a;
                let (below, state, above) = (at(a - step), at(a), at(a + step));
                let slope = (above.indentation - below.indentation) / (2.0 * step);
                let stiffening = (above.stiffness - below.stiffness) / (2.0 * step);
                assert!((state.slope / slope - 1.0).abs() < 1e-7, "at {a} for {ratio}");
                assert!((state.stiffening / stiffening - 1.0).abs() < 1e-7, "at {a} for {ratio}");
            }
        }
    }
}
