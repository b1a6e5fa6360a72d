//! Sorting of many numbers; smallest, middle and largest values.

use rayon::prelude::*;

use crate::memory::collected;
use crate::progress::{PIECE, Progress, Silent};

/// The places of `values` in ascending total order, equal ones in the order of their places, on all threads.
pub(crate) fn ascending(values: &[f64]) -> Vec<usize> {
    // The first bits of a value and its place in one integer: compared without a branch, several times as fast as by a look-up.
    let bits = usize::BITS - values.len().leading_zeros();
    let of_place = (1_u64 << bits) - 1;
    let keyed = |(place, value): (usize, &f64)| (ordered_bits(*value) & !of_place) | place as u64;
    let mut keys = collected(values.par_iter().enumerate().map(keyed));
    in_parts(&mut keys, |&key| key, &Silent);
    // Values that agree in these bits are next to each other.
    let place = |key: u64| (key & of_place) as usize;
    for alike in keys.chunk_by_mut(|a, b| a & !of_place == b & !of_place).filter(|alike| alike.len() > 1) {
        alike.sort_unstable_by_key(|&key| (ordered_bits(values[place(key)]), key));
    }
    // In their memory, which two threads would be no faster to get anew.
    keys.into_iter().map(place).collect()
}

/// An integer for each number, in the total order of the numbers.
fn ordered_bits(value: f64) -> u64 {
    let bits = value.to_bits();
    let is_negative = bits >> 63 == 1;
    if is_negative { !bits } else { bits | (1 << 63) }
}

/// The inverse of [`ordered_bits`].
fn unordered_bits(bits: u64) -> u64 {
    if bits >> 63 == 1 { bits & !(1 << 63) } else { !bits }
}

/// Sorts numbers by their total order, on all threads: one unit of work.
pub(crate) fn sort(values: &mut [f64], progress: &dyn Progress) {
    // As integers they are compared without a branch.
    values.par_iter_mut().for_each(|value| *value = f64::from_bits(ordered_bits(*value)));
    in_parts(values, |value| value.to_bits(), progress);
    values.par_iter_mut().for_each(|value| *value = f64::from_bits(unordered_bits(value.to_bits())));
}

/// Sorts by a key, on all threads: one unit of work. The halves are parted first, so that they are sorted in place and each by
/// itself, by the sort of the standard library, which takes half the time of rayon's.
fn in_parts<T: Send>(values: &mut [T], key: impl Fn(&T) -> u64 + Sync, progress: &dyn Progress) {
    /// Parts of up to 16 million values.
    const PARTS: usize = 16;
    const LEAST: usize = 1 << 13;
    let count = values.len();
    let done = |some: usize| progress.advance(some as f64 / count.max(1) as f64);
    halves(values, &key, (count / PARTS).clamp(LEAST, PIECE), &done);
}

fn halves<T: Send>(
    values: &mut [T],
    key: &(impl Fn(&T) -> u64 + Sync),
    part: usize,
    done: &(dyn Fn(usize) + Sync),
) {
    if values.len() <= part {
        done(values.len());
        return values.sort_unstable_by_key(key);
    }
    let middle = values.len() / 2;
    values.select_nth_unstable_by_key(middle, key);
    done(0);
    let (low, high) = values.split_at_mut(middle);
    rayon::join(|| halves(low, key, part, done), || halves(high, key, part, done));
}

/// The upper median, for which values are reordered; `None` of none.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The smallest and the largest value; `None` of none.
pub fn extremes(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let both = values.into_iter().map(|value| [value; 2]);
    both.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}

/// The width of a positive range on a logarithmic scale.
pub fn decades([from, to]: [f64; 2]) -> f64 {
    (to / from).log10()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    #[test]
    fn places_are_in_the_order_of_their_values_and_of_themselves() {
        let mut values: Vec<f64> = (0..3000).map(|k| f64::from((k * 7919) % 1009) - 500.0).collect();
        values.extend([-0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY, -1e-310, 1e-310]);
        let mut expected: Vec<usize> = (0..values.len()).collect();
        expected.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        assert_eq!(ascending(&values), expected);
        // They differ in their last bits only, or not at all.
        let near: Vec<f64> =
            (0..5000_u64).map(|k| f64::from_bits(1.0_f64.to_bits() + (k * 7919) % 97)).collect();
        let mut expected: Vec<usize> = (0..near.len()).collect();
        expected.sort_by(|&a, &b| near[a].total_cmp(&near[b]));
        assert_eq!(ascending(&near), expected);
        assert_eq!((ascending(&[]), ascending(&[2.0])), (vec![], vec![0]));
    }

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
