//! Arithmetic of about 32 digits, to check what `f64` gives.
//!
//! The numbers are xprec's double-doubles (Joldes, Muller, Popescu 2017): against mpmath at 60 digits,
//! over 2000 arguments each, +, -, *, /, the square root, exp, ln, ln_1p and atan are within 6e-32.
//! (twofloat 0.8 was tried: its exp is off by 2e-11.) Their range is that of `f64`, less the last 53
//! binary orders at its lower end, so keep what is evaluated within 1e-270 to 1e300.

use std::sync::LazyLock;

/// A number of about 32 digits.
pub use xprec::Df64 as Wide;

pub const PI: Wide = Wide::new_full(std::f64::consts::PI, 1.224_646_799_147_353_2e-16);

/// The relative error of `value` against `exact`; the magnitude of `value` where `exact` is zero.
pub fn relative_error(value: f64, exact: Wide) -> f64 {
    if exact == Wide::ZERO {
        return value.abs();
    }
    ((exact - value) / exact).abs().hi()
}

/// The spacing of the nodes at level 0 in the variable of the tanh-sinh rule; every level halves it.
const SPACING: f64 = 0.5;

/// The last node: beyond it weights are below 1e-36.
const LAST: f64 = 4.0;

const LEVELS: usize = 7;

/// Nodes as their distance from the nearer end, and their weights, both of [0, 1]: those that each
/// level adds to the levels before it, on one side of the middle.
static NODES: LazyLock<Vec<Vec<(Wide, Wide)>>> = LazyLock::new(|| {
    (0..=LEVELS)
        .map(|level| {
            let spacing = SPACING / f64::from(1u32 << level);
            let last = (LAST / spacing) as usize;
            (1..=last)
                .filter(|k| level == 0 || k % 2 == 1)
                .map(|k| {
                    let t = Wide::new(spacing * k as f64);
                    let tail = (-PI * t.sinh()).exp();
                    let distance = tail / (tail + 1.0);
                    (distance, PI * t.cosh() * distance / (tail + 1.0))
                })
                .collect()
        })
        .collect()
});

/// The integrals of the N functions `f(x)` over [from, to] by the tanh-sinh rule (Takahasi and Mori
/// 1974). The spacing of the nodes is halved until two rules differ by less than `tolerance` of each
/// integral; where `f` is analytic within the interval the error is then about `tolerance` squared,
/// whatever power of x it begins with at the ends. Nodes near `from` keep their distance from it to
/// full precision only where `from` is zero.
///
/// `None` if the finest rule does not get there.
pub fn integral<const N: usize>(
    from: Wide,
    to: Wide,
    tolerance: f64,
    mut f: impl FnMut(Wide) -> [Wide; N],
) -> Option<[Wide; N]> {
    let length = to - from;
    let mut sums = [Wide::ZERO; N];
    let mut add = |sums: &mut [Wide; N], x: Wide, weight: Wide| {
        let values = f(x);
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += weight * value;
        }
    };
    add(&mut sums, from + length * 0.5, PI * 0.25);
    let mut before = [Wide::ZERO; N];
    for (level, nodes) in NODES.iter().enumerate() {
        for &(distance, weight) in nodes {
            add(&mut sums, from + length * distance, weight);
            add(&mut sums, to - length * distance, weight);
        }
        let spacing = SPACING / f64::from(1u32 << level);
        let now = sums.map(|sum| sum * length * spacing);
        let settled = |(now, before): (&Wide, &Wide)| (*now - *before).abs() <= now.abs() * tolerance;
        if now.iter().zip(&before).all(settled) {
            return Some(now);
        }
        before = now;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(value: Wide, exact: Wide) -> bool {
        ((value - exact) / exact).abs().hi() < 1e-29
    }

    #[test]
    fn pi_is_pi() {
        assert!(close(Wide::ONE.atan() * 4.0, PI));
    }

    #[test]
    fn functions_undo_each_other() {
        for k in 1..200 {
            let x = Wide::new(0.013 * f64::from(k)) / 7.0;
            assert!(close(x.ln().exp(), x) && close(x.sqrt() * x.sqrt(), x));
            assert!(close(x.atan().tan(), x) && close(x.ln_1p().exp_m1(), x));
        }
    }

    #[test]
    fn the_rule_takes_ends_of_any_power() {
        let of = |from: f64, to: f64, f: &dyn Fn(Wide) -> Wide| {
            integral(Wide::new(from), Wide::new(to), 1e-15, |x| [f(x)]).unwrap()[0]
        };
        assert!(close(of(0.0, 2.0, &|x| x * x.sqrt()), Wide::new(32.0).sqrt() * 2.0 / 5.0));
        assert!(close(of(0.0, 1.0, &|x| -x.ln()), Wide::ONE));
        assert!(close(of(0.0, 20.0, &|x| (-x).exp()), -Wide::new(-20.0).exp_m1()));
        assert!(close(of(1.0, 3.0, &|x| x.recip()), Wide::new(3.0).ln()));
    }

    #[test]
    fn errors_are_relative() {
        let third = Wide::ONE / 3.0;
        assert!(relative_error(1.0 / 3.0, third) < 1.2e-16);
        assert!(relative_error(1.0 / 3.0, third) > 1e-17);
        assert_eq!(relative_error(2.0, Wide::ZERO), 2.0);
    }
}
