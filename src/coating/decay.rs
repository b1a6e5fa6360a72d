//! exp(-x) and 1 - exp(-x) together, for the hardness of a layered flat.

use std::sync::LazyLock;

use crate::numeric::lanes::Real;

/// Entries of the table a unit of x.
const PER_UNIT: f64 = 32.0;
/// Where the table ends: exp(-x) times the largest ratio of hardnesses is below rounding.
pub(super) const LAST: f64 = 180.0;

/// exp(-x) and 1 - exp(-x) at the entries.
static TABLE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let entry = |k: usize| -(k as f64) / PER_UNIT;
    (0..=(LAST * PER_UNIT) as usize).map(|k| [entry(k).exp(), -entry(k).exp_m1()]).collect()
});

/// exp(-x) and 1 - exp(-x) for each `x` >= 0, both to rounding: the nearest entry of a table, and a series in what is
/// left, at most 1/64. From x = 180 on nothing changes.
#[inline(always)]
pub(super) fn decay<N: Real>(x: N) -> (N, N) {
    /// Coefficients of (1 - exp(-r))/r, the highest power first.
    const SERIES: [f64; 7] = [1.0 / 5040.0, -1.0 / 720.0, 1.0 / 120.0, -1.0 / 24.0, 1.0 / 6.0, -0.5, 1.0];
    let table = &TABLE[..];
    let [left, gone, rest] = x.each(|x| {
        let x = x.min(LAST);
        let place = ((x * PER_UNIT + 0.5) as usize).min(table.len() - 1);
        let [left, gone] = table[place];
        [left, gone, x - place as f64 * PER_UNIT.recip()]
    });
    let step = left * (rest * rest.polynomial(&SERIES));
    (left - step, gone + step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_exp_and_exp_m1() {
        /// Of the largest ratio of two hardnesses, 1e60, below rounding.
        const NOTHING: f64 = 1e-78;
        for k in 0..200_000 {
            let x = f64::from(k) * 2.5e-4;
            let (left, gone) = decay(x);
            assert!((left / (-x).exp() - 1.0).abs() < 5e-16, "exp(-{x})");
            assert!(gone == -(-x).exp_m1() || (gone / -(-x).exp_m1() - 1.0).abs() < 7e-16, "1 - exp(-{x})");
        }
        for x in [1e-300, 1e-20, 1e-10, 1e-3, 50.0, 700.0, 800.0, 1e300] {
            let (left, gone) = decay(x);
            assert!(
                (left - (-x).exp()).abs() <= 4e-16 * (-x).exp() + NOTHING
                    && (gone + (-x).exp_m1()).abs() <= 4e-16 * gone
            );
        }
        assert_eq!([0.0, 1e300, f64::INFINITY].map(|x| decay(x).1), [0.0, 1.0, 1.0]);
    }
}
