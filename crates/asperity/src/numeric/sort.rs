//! Sorting of many numbers.

use crate::progress::{PIECE, Progress};

/// Sorts numbers by their total order, on all threads: one unit of work. The halves are parted first, so that they sort in place and each by
/// itself.
pub(crate) fn sort(values: &mut [f64], progress: &dyn Progress) {
    let whole = values.len().max(1) as f64;
    halves(values, &|count| progress.advance(count as f64 / whole));
}

fn halves(values: &mut [f64], done: &(dyn Fn(usize) + Sync)) {
    if values.len() <= PIECE {
        done(values.len());
        return values.sort_unstable_by(f64::total_cmp);
    }
    let middle = values.len() / 2;
    values.select_nth_unstable_by(middle, f64::total_cmp);
    done(0);
    let (low, high) = values.split_at_mut(middle);
    rayon::join(|| halves(low, done), || halves(high, done));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    #[test]
    fn numbers_are_in_their_total_order_with_any_count_of_pieces() {
        for count in [0, 1, 1000, PIECE + 1, 3 * PIECE] {
            let value = |k: usize| ((k * 7919) % 10_007) as f64 - 5000.0;
            let mut values: Vec<f64> = (0..count).map(value).collect();
            values.extend([-0.0, 0.0, f64::NAN, f64::NEG_INFINITY]);
            let mut expected = values.clone();
            expected.sort_by(f64::total_cmp);
            sort(&mut values, &Silent);
            assert!(values.iter().zip(&expected).all(|(a, b)| a.to_bits() == b.to_bits()), "{count}");
        }
    }
}
