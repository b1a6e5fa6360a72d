//! The cumulative hazard -ln Phi(-g) of the standard normal distribution: the standard exponential variable of equal
//! probability.

use std::array::from_fn;
use std::f64::consts::{PI, SQRT_2};
use std::sync::LazyLock;

use libm::erfc;

/// -ln Phi(-g), computed from the smaller tail without cancellation. The error function is that of libm, to an ulp;
/// that of statrs 0.19 is off by up to 2e-9 in the tail.
fn hazard(g: f64) -> f64 {
    let tail = 0.5 * erfc(g.abs() / SQRT_2);
    if g < 0.0 { -(-tail).ln_1p() } else { -tail.ln() }
}

/// Half the number of panels, and the largest |g|.
const HALF: usize = 36;
const END: f64 = 9.0;

/// Terms of a panel.
const TERMS: usize = 10;

/// Coefficients of all panels.
pub(super) type Panels = [[f64; TERMS]; 2 * HALF];

/// Chebyshev coefficients of ln(-ln Phi(-g)) on panels over [-9, 9]. The nearest complex zeros of Phi
/// are 2.8 away, 22 times the half width of a panel, so ten terms reach rounding, four times faster than
/// an error function, a logarithm and a power.
pub(super) static PANELS: LazyLock<Panels> = LazyLock::new(|| {
    let angle = |node: usize| PI * (node as f64 + 0.5) / TERMS as f64;
    from_fn(|panel| {
        let at = |t: f64| hazard((panel as f64 + 0.5 + 0.5 * t) * (END / HALF as f64) - END).ln();
        // Relative to the value in the middle: rounding errors are then relative to the change across a panel.
        let middle = at(0.0);
        let values: [f64; TERMS] = from_fn(|node| at(angle(node).cos()) - middle);
        from_fn(|order| {
            let sum: f64 = (0..TERMS).map(|node| values[node] * (order as f64 * angle(node)).cos()).sum();
            if order == 0 { middle + sum / TERMS as f64 } else { 2.0 * sum / TERMS as f64 }
        })
    })
});

/// ln(-ln Phi(-g)), by the panels of [`PANELS`].
#[inline]
pub(super) fn log_hazard(panels: &Panels, g: f64) -> f64 {
    let place = (g + END) * (HALF as f64 / END);
    // A negative place or a NaN becomes a panel whose t is out of range.
    let panel = place as usize;
    let t = 2.0 * (place - panel as f64) - 1.0;
    match panels.get(panel) {
        // Clenshaw's sum.
        Some(terms) if t >= -1.0 => {
            let (mut next, mut after) = (0.0, 0.0);
            for &term in terms[1..].iter().rev() {
                (next, after) = (term + 2.0 * t * next - after, next);
            }
            terms[0] + t * next - after
        }
        _ => hazard(g).ln(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_tails_keep_their_digits() {
        // The shape 1 is the exponential: T + 1 = -ln Phi(-g); mpmath.
        for (g, exact) in [
            (-9.0, 1.1285884059538406e-19),
            (-3.0, 0.0013508099647481938),
            (0.0, std::f64::consts::LN_2),
            (3.0, 6.607726221510343),
            (9.0, 43.628149113332115),
        ] {
            assert!((hazard(g) / exact - 1.0).abs() < 4e-15, "{g}: {}", hazard(g));
        }
    }

    #[test]
    fn panels_are_the_function_to_rounding() {
        for k in -95_000..=95_000 {
            let g = f64::from(k) * 1e-4;
            let exact = hazard(g).ln();
            let gap = (log_hazard(&PANELS, g) - exact).abs();
            assert!(gap <= 4e-15 * exact.abs().max(1.0), "{g}: {gap:e} of {exact}");
        }
        assert!(log_hazard(&PANELS, f64::NAN).is_nan());
    }
}
