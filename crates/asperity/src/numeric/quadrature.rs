//! Gauss-Legendre panels for integrands that are smooth between known breakpoints.

use std::num::NonZeroUsize;
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;

use super::lanes::Real;

/// Nodes of one panel.
pub const NODES: usize = 24;

/// Nodes and weights on [-1, 1], from gauss-quad.
static LEGENDRE: LazyLock<([f64; NODES], [f64; NODES])> = LazyLock::new(|| {
    let degree = const { NonZeroUsize::new(NODES).unwrap() };
    let (mut nodes, mut weights) = ([0.0; NODES], [0.0; NODES]);
    for (k, (node, weight)) in GaussLegendre::new(degree).iter().enumerate() {
        (nodes[k], weights[k]) = (*node, *weight);
    }
    (nodes, weights)
});

/// The variable that a panel is sampled in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// x itself.
    Linear,
    /// s = x^.5, which removes a square-root singularity at x = 0.
    SquareRoot,
}

/// The abscissae and weights of one panel: the integral of f over it is the sum of
/// `weights[k] * f(points[k])`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Panel {
    /// Abscissae.
    pub points: [f64; NODES],
    /// Weights, including those of the substitution.
    pub weights: [f64; NODES],
}

/// The range of one panel in its variable.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    variable: Variable,
    centre: f64,
    half: f64,
}

impl Piece {
    /// Abscissae and weights of one register, from the `k`th on.
    #[inline(always)]
    pub fn sample<N: Real>(&self, k: usize, zero: N) -> [N; 2] {
        let (nodes, weights) = &*LEGENDRE;
        let s = zero.load(&nodes[k..]) * self.half + self.centre;
        let weight = zero.load(&weights[k..]) * self.half;
        match self.variable {
            Variable::Linear => [s, weight],
            Variable::SquareRoot => [s * s, s * 2.0 * weight],
        }
    }

    /// All abscissae and weights.
    pub fn panel(&self) -> Panel {
        let mut panel = Panel::default();
        for k in 0..NODES {
            [panel.points[k], panel.weights[k]] = self.sample(k, 0.0);
        }
        panel
    }
}

/// Divides [from, to], 0 <= from < to, into `count` pieces of equal length in `variable`.
pub fn pieces(from: f64, to: f64, variable: Variable, count: usize) -> impl Iterator<Item = Piece> {
    let (start, end) = match variable {
        Variable::Linear => (from, to),
        Variable::SquareRoot => (from.sqrt(), to.sqrt()),
    };
    let half = 0.5 * (end - start) / count as f64;
    (0..count).map(move |k| Piece { variable, centre: start + half * (2 * k + 1) as f64, half })
}

/// The panels of [`pieces`].
pub fn panels(from: f64, to: f64, variable: Variable, count: usize) -> impl Iterator<Item = Panel> {
    pieces(from, to, variable, count).map(|piece| piece.panel())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(f: impl Fn(f64) -> f64, variable: Variable, count: usize) -> f64 {
        panels(0.0, 2.0, variable, count)
            .flat_map(|panel| panel.points.into_iter().zip(panel.weights))
            .map(|(x, weight)| weight * f(x))
            .sum()
    }

    #[test]
    fn the_square_root_is_exact_only_under_its_substitution() {
        let exact = 2f64.powf(2.5) / 2.5;
        let error = |variable| (integral(|x| x.powf(1.5), variable, 1) / exact - 1.0).abs();
        assert!(error(Variable::SquareRoot) < 1e-15);
        assert!(error(Variable::Linear) > 1e-9);
    }

    #[test]
    fn panels_add_up() {
        for count in 1..5 {
            assert!((integral(f64::exp, Variable::Linear, count) / 2f64.exp_m1() - 1.0).abs() < 1e-15);
        }
    }
}
