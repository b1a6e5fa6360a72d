//! The influence function of a layered surface: displacement from pressure, in Abel's coordinates;
//! and the integral equation of one contact, in units of the layer.

use std::f64::consts::PI;
use std::sync::OnceLock;

use super::kernel::{Convolution, Kernel};
use crate::numeric::quadrature::{NODES, Variable, panels};

/// Above it kappa - 1 < 4 x^2 exp(-2 x) is below 1e-17.
const CUTOFF: f64 = 24.0;

/// Coefficients of a piece.
const TERMS: usize = 20;

/// m(y) = int_0^inf (kappa(x) - 1) cos(x y) dx for 0 <= y <= reach; lengths in layer thicknesses.
///
/// Its nearest singularities lie at y = +-2i, so that Chebyshev series on [0, 1], [1, 2] and from there on pieces half
/// as long as their distance from 0 meet rounding, 1e-15 of the largest |m|. A piece is computed when it is first
/// needed.
#[derive(Debug, Clone)]
pub struct Influence {
    kernel: Kernel,
    pieces: Vec<Piece>,
}

#[derive(Debug, Clone)]
struct Piece {
    from: f64,
    to: f64,
    coefficients: OnceLock<[f64; TERMS]>,
}

impl Influence {
    /// The influence function of a kernel, up to the distance `reach`.
    pub fn new(kernel: Kernel, reach: f64) -> Self {
        let mut ends = vec![0.0, 1.0, 2.0];
        while ends[ends.len() - 1] < reach {
            ends.push(1.5 * ends[ends.len() - 1]);
        }
        let piece = |ends: &[f64]| Piece { from: ends[0], to: ends[1], coefficients: OnceLock::new() };
        Self { kernel, pieces: ends.windows(2).map(piece).collect() }
    }

    /// m(y), 0 <= y <= reach.
    pub fn at(&self, y: f64) -> f64 {
        let piece = &self.pieces[self.pieces.partition_point(|piece| piece.to < y)];
        let coefficients = piece.coefficients.get_or_init(|| chebyshev(&self.kernel, piece.from, piece.to));
        let z = (2.0 * y - piece.from - piece.to) / (piece.to - piece.from);
        // Clenshaw's recurrence.
        let (mut next, mut second) = (0.0, 0.0);
        for &c in coefficients[1..].iter().rev() {
            (next, second) = (c + 2.0 * z * next - second, next);
        }
        coefficients[0] + z * next - second
    }
}

/// The Chebyshev series of m on [from, to].
fn chebyshev(kernel: &Kernel, from: f64, to: f64) -> [f64; TERMS] {
    let angle = |k: usize| (k as f64 + 0.5) * PI / TERMS as f64;
    let y: [f64; TERMS] = std::array::from_fn(|k| 0.5 * (from + to) + 0.5 * (to - from) * angle(k).cos());
    let mut values = [0.0; TERMS];
    integrate(kernel, to, |x, weight| {
        for (value, y) in values.iter_mut().zip(&y) {
            *value += weight * (x * y).cos();
        }
    });
    std::array::from_fn(|n| {
        let sum: f64 = (0..TERMS).map(|k| values[k] * (n as f64 * angle(k)).cos()).sum();
        sum * if n == 0 { 1.0 } else { 2.0 } / TERMS as f64
    })
}

/// Calls `node` with each abscissa and its weight times kappa - 1, of a quadrature for cosines up to x y.
///
/// Octaves extend down to where the kernel is smooth, below its feature from the stretching of a stiff layer at x ~
/// 1/alpha; each is divided so that a panel of 24 nodes covers at most 24 radians.
fn integrate(kernel: &Kernel, y: f64, mut node: impl FnMut(f64, f64)) {
    let least = 1.0 / (16.0 * (1.0 + kernel.shear_ratio()));
    let mut to = CUTOFF;
    while to > 0.0 {
        let from = if to > least { 0.5 * to } else { 0.0 };
        let count = ((to - from) * y / NODES as f64).ceil().max(1.0) as usize;
        for panel in panels(from, to, Variable::Linear, count) {
            for (x, weight) in panel.points.into_iter().zip(panel.weights) {
                node(x, weight * (kernel.kappa(x) - 1.0));
            }
        }
        to = from;
    }
}

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

    #[test]
    fn the_series_is_the_integral() {
        let body = |young, poisson| Material::new(young, poisson, None, None).unwrap();
        for ratio in [1e-3, 0.1, 2.0, 10.0, 1e3] {
            let kernel = Kernel::new(&body(ratio, 0.35), &body(1.0, 0.2));
            let influence = Influence::new(kernel, 500.0);
            // A rule with four times the nodes.
            let direct = |y: f64| {
                let mut sum = 0.0;
                integrate(&kernel, 4.0 * y + 100.0, |x, weight| sum += weight * (x * y).cos());
                sum
            };
            for y in [0.0, 1e-9, 0.1, 0.5, 0.99, 1.0, 1.3, 2.2, 3.0, 7.7, 30.0, 123.0, 499.9] {
                let error = (influence.at(y) - direct(y)).abs() / direct(0.0).abs();
                assert!(error < 1e-14, "{error:e} at {y} for {ratio}");
            }
        }
    }

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
