//! exp(-x) and 1 - exp(-x) together, for the hardness of a layered flat.

use std::sync::LazyLock;

/// Entries of the table a unit of x.
const PER_UNIT: f64 = 16.0;
/// Where the table ends.
const LAST: usize = 40;

/// exp(-x) and 1 - exp(-x) at the entries.
static TABLE: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let entry = |k: usize| -(k as f64) / PER_UNIT;
    (0..=LAST * PER_UNIT as usize).map(|k| [entry(k).exp(), -entry(k).exp_m1()]).collect()
});

/// exp(-x) and 1 - exp(-x) for `x` >= 0, both to rounding: the nearest entry of a table, and a series in what is
/// left, at most 1/32. A third of the time of `exp_m1`.
#[inline]
pub(super) fn decay(x: f64) -> (f64, f64) {
    /// 1/9, 1/8, ... 1/2: the series of 1 - exp(-r), each term over the one before.
    const RATIOS: [f64; 8] = [1.0 / 9.0, 1.0 / 8.0, 1.0 / 7.0, 1.0 / 6.0, 0.2, 0.25, 1.0 / 3.0, 0.5];
    let place = (x * PER_UNIT).round();
    let Some(&[left, gone]) = TABLE.get(place as usize) else {
        return ((-x).exp(), 1.0 - (-x).exp());
    };
    let rest = x - place / PER_UNIT;
    let series = rest * RATIOS.iter().fold(1.0, |sum, ratio| 1.0 - rest * ratio * sum);
    (left - left * series, gone + left * series)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_exp_and_exp_m1() {
        for k in 0..200_000 {
            let x = f64::from(k) * 2.5e-4;
            let (left, gone) = decay(x);
            assert!((left / (-x).exp() - 1.0).abs() < 5e-16, "exp(-{x})");
            assert!(gone == -(-x).exp_m1() || (gone / -(-x).exp_m1() - 1.0).abs() < 7e-16, "1 - exp(-{x})");
        }
        for x in [1e-300, 1e-20, 1e-10, 1e-3, 50.0, 700.0, 800.0, 1e300] {
            let (left, gone) = decay(x);
            assert!(
                (left - (-x).exp()).abs() <= 4e-16 * (-x).exp()
                    && (gone + (-x).exp_m1()).abs() <= 4e-16 * gone
            );
        }
        assert_eq!(decay(0.0), (1.0, 0.0));
    }
}
