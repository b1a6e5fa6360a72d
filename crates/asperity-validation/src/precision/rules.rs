//! Quadrature rules as nodes and weights; those of gauss-quad unchanged.

use std::num::{NonZeroU32, NonZeroUsize};

use gauss_quad::{
    FiniteAboveNegOneF64, GaussChebyshevFirstKind, GaussChebyshevSecondKind, GaussHermite, GaussJacobi,
    GaussLaguerre, GaussLegendre, Midpoint, Simpson, Trapezoid,
};

/// A family of quadrature rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Family {
    /// Gauss-Legendre, one panel per segment between breakpoints.
    Legendre,
    /// Gauss-Legendre in panels over which the density decreases by at most exp(-20).
    Panels,
    /// Gauss-Jacobi with the weight w^.5 for the load, Gauss-Legendre for the area, of the segment that
    /// begins at w = 0; Gauss-Legendre elsewhere.
    Jacobi,
    /// Gauss-Chebyshev of the first kind, divided by its weight.
    ChebyshevFirst,
    /// Gauss-Chebyshev of the second kind, divided by its weight.
    ChebyshevSecond,
    /// Gauss-Laguerre over all heights above the flat, or above the last breakpoint with Gauss-Legendre
    /// below it.
    Laguerre,
    /// Gauss-Hermite over all heights, without nodes below the flat.
    Hermite,
    /// The midpoint rule.
    Midpoint,
    /// The trapezoid rule.
    Trapezoid,
    /// Simpson's rule.
    Simpson,
    /// Adaptive Gauss-Kronrod (quad-rs), by its relative tolerance.
    Kronrod,
    /// The rule of the statistical model, with all its results.
    Shipped,
}

impl Family {
    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Legendre => "gauss-legendre",
            Self::Panels => "gauss-legendre in panels",
            Self::Jacobi => "gauss-jacobi",
            Self::ChebyshevFirst => "gauss-chebyshev, first kind",
            Self::ChebyshevSecond => "gauss-chebyshev, second kind",
            Self::Laguerre => "gauss-laguerre",
            Self::Hermite => "gauss-hermite",
            Self::Midpoint => "midpoint",
            Self::Trapezoid => "trapezoid",
            Self::Simpson => "simpson",
            Self::Kronrod => "adaptive gauss-kronrod",
            Self::Shipped => "shipped",
        }
    }
}

/// A node of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    /// Where: on [0, 1], from 0 on, or any number, as the rule's domain is.
    pub(super) at: f64,
    /// The weights of area and load.
    pub(super) weights: [f64; 2],
    /// The weight function of the rule is exp(-this) there, which the weights hold.
    pub(super) exponent: f64,
}

impl Node {
    fn plain(at: f64, weight: f64) -> Self {
        Self { at, weights: [weight; 2], exponent: 0.0 }
    }
}

/// The nodes of a family of `order` on [0, 1]: of the segment that begins at w = 0, and of any other.
pub(super) fn on_segments(family: Family, order: NonZeroUsize) -> [Vec<Node>; 2] {
    let both = |nodes: Vec<Node>| [nodes.clone(), nodes];
    // gauss-quad's domain is [-1, 1], its weight function f; divided by it, the weights are those of a plain integral.
    let divided = |pairs: &[(f64, f64)], f: fn(f64) -> f64| -> Vec<Node> {
        pairs.iter().map(|&(x, weight)| Node::plain(0.5 * (1.0 + x), 0.5 * weight / f(x))).collect()
    };
    let legendre = || divided(GaussLegendre::new(order).as_node_weight_pairs(), |_| 1.0);
    let steps = NonZeroU32::try_from(order).unwrap_or(NonZeroU32::MAX);
    match family {
        Family::Jacobi => {
            let half = FiniteAboveNegOneF64::new(0.5);
            let Some((zero, half)) = FiniteAboveNegOneF64::new(0.0).zip(half) else {
                return both(legendre());
            };
            let rule = GaussJacobi::new(order, zero, half);
            let of_load = divided(rule.as_node_weight_pairs(), |x| (1.0 + x).sqrt());
            let alone = |nodes: Vec<Node>, of: [f64; 2]| {
                nodes.into_iter().map(move |Node { at, weights: [weight, _], exponent }| Node {
                    at,
                    weights: of.map(|share| share * weight),
                    exponent,
                })
            };
            [alone(legendre(), [1.0, 0.0]).chain(alone(of_load, [0.0, 1.0])).collect(), legendre()]
        }
        Family::ChebyshevFirst => {
            let rule = GaussChebyshevFirstKind::new(order);
            both(divided(rule.as_node_weight_pairs(), |x| (1.0 - x * x).sqrt().recip()))
        }
        Family::ChebyshevSecond => {
            let rule = GaussChebyshevSecondKind::new(order);
            both(divided(rule.as_node_weight_pairs(), |x| (1.0 - x * x).sqrt()))
        }
        Family::Midpoint => both(as_nodes(|f| Midpoint::new(steps).integrate(0.0, 1.0, f))),
        Family::Trapezoid => both(as_nodes(|f| Trapezoid::new(steps).integrate(0.0, 1.0, f))),
        Family::Simpson => both(as_nodes(|f| Simpson::new(steps).integrate(0.0, 1.0, f))),
        _ => both(legendre()),
    }
}

/// Gauss-Laguerre from 0 on.
pub(super) fn laguerre(order: NonZeroUsize) -> Vec<Node> {
    let Some(zero) = FiniteAboveNegOneF64::new(0.0) else { return Vec::new() };
    let rule = GaussLaguerre::new(order, zero);
    let node = |&(at, weight): &(f64, f64)| Node { at, weights: [weight; 2], exponent: at };
    rule.as_node_weight_pairs().iter().map(node).collect()
}

/// Gauss-Hermite for the standard normal density.
pub(super) fn hermite(order: NonZeroUsize) -> Vec<Node> {
    let rule = GaussHermite::new(order);
    let root = std::f64::consts::PI.sqrt();
    let node = |&(x, weight): &(f64, f64)| Node {
        at: x * std::f64::consts::SQRT_2,
        weights: [weight / root; 2],
        exponent: x * x,
    };
    rule.as_node_weight_pairs().iter().map(node).collect()
}

/// The nodes of a rule that only integrates: positions and weights, found by integrating unit values.
fn as_nodes(integrate: impl Fn(&mut dyn FnMut(f64) -> f64) -> f64) -> Vec<Node> {
    let mut places = Vec::new();
    integrate(&mut |x| {
        places.push(x);
        0.0
    });
    let weight = |k: usize| {
        let mut calls = 0;
        integrate(&mut |_| {
            calls += 1;
            if calls == k + 1 { 1.0 } else { 0.0 }
        })
    };
    places.iter().enumerate().map(|(k, &at)| Node::plain(at, weight(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn order(n: usize) -> NonZeroUsize {
        NonZeroUsize::new(n).unwrap()
    }

    fn integral(nodes: &[Node], which: usize, f: impl Fn(f64) -> f64) -> f64 {
        nodes.iter().map(|node| node.weights[which] * f(node.at)).sum()
    }

    #[test]
    fn all_integrate_smooth_functions() {
        for family in [
            Family::Legendre,
            Family::Jacobi,
            Family::ChebyshevFirst,
            Family::ChebyshevSecond,
            Family::Midpoint,
            Family::Trapezoid,
            Family::Simpson,
        ] {
            let [first, other] = on_segments(family, order(64));
            for which in 0..2 {
                for nodes in [&first, &other] {
                    let found = integral(nodes, which, f64::exp);
                    assert!((found / 1f64.exp_m1() - 1.0).abs() < 4e-4, "{family:?}: {found}");
                }
            }
        }
    }

    #[test]
    fn jacobi_is_exact_where_a_load_begins() {
        let [first, _] = on_segments(Family::Jacobi, order(8));
        assert!((integral(&first, 1, |x| x.powf(1.5)) - 0.4).abs() < 1e-15);
        assert!((integral(&first, 0, |x| x) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn endless_rules_have_their_moments() {
        assert!((integral(&laguerre(order(20)), 0, |t| t * t) - 2.0).abs() < 1e-13);
        assert!((integral(&hermite(order(20)), 0, |z| z * z) - 1.0).abs() < 1e-13);
    }

    /// Simpson evaluates ends and middles of each interval.
    #[test]
    fn a_rule_that_only_integrates_is_its_nodes() {
        let nodes = as_nodes(|f| Simpson::new(NonZeroU32::new(2).unwrap()).integrate(0.0, 1.0, f));
        assert_eq!(nodes.len(), 5);
        assert!((integral(&nodes, 0, |x| x.powi(3)) - 0.25).abs() < 1e-15);
    }
}
