//! Samples condensed to few weighted nodes: Gauss's rule of two nodes for the values in each of many narrow bins.

use std::ops::Range;

use super::interval::Interval;
use super::lanes::{Real, Work, run};
use super::parallel;
use super::sum::{Terms, sums_of_present};

/// A weighted value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    pub value: f64,
    pub weight: f64,
}

/// Few nodes in place of ascending `values`, with their number and the sums of their first three powers in every bin of at most
/// `width`. Up to two values of a bin stay as they are. The sum of a function over the nodes differs from that over the values by its
/// fourth derivative times `width`^4/4320 at most, and in a bin where it is not smooth by its change there times the weight of the bin.
pub(crate) fn condensed(values: &[f64], width: f64) -> Vec<Node> {
    /// Bins per task.
    const BINS: usize = 64;
    let bins = bins(values, width);
    let of_bins = |task: usize| {
        let mut nodes = Vec::new();
        for bin in &bins[task * BINS..bins.len().min((task + 1) * BINS)] {
            if bin.len() <= 2 {
                nodes.extend(values[bin.clone()].iter().map(|&value| Node { value, weight: 1.0 }));
            } else {
                nodes.extend(two_nodes(&values[bin.clone()]));
            }
        }
        nodes
    };
    parallel::map(bins.len().div_ceil(BINS), of_bins).concat()
}

/// The places of ascending values in bins of at most `width`, each from its own first value on.
fn bins(values: &[f64], width: f64) -> Vec<Range<usize>> {
    let count = values.len();
    let mut bins: Vec<Range<usize>> = Vec::new();
    let mut first = 0;
    while first < count {
        let origin = values[first];
        let is_inside = |place: usize| values[place] - origin <= width;
        // A bin holds about as many as the one before: its end is sought from there.
        let mut near = bins.last().map_or(1, Range::len);
        let mut inside = first;
        while first + near < count && is_inside(first + near) {
            inside = first + near;
            near *= 2;
        }
        // The last place that is known to be inside, and the first that is known not to be.
        let mut outside = count.min(first + near);
        while outside - inside > 1 {
            let middle = inside.midpoint(outside);
            if is_inside(middle) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        bins.push(first..outside);
        first = outside;
    }
    bins
}

/// The rule of two nodes for the values of a bin; one node where they are equal.
fn two_nodes(values: &[f64]) -> impl Iterator<Item = Node> {
    let middle = values[values.len() / 2];
    let mut moments = Moments::about(middle, values);
    if moments.mean * moments.mean > moments.variance {
        // Far from the mean the central moments are differences of larger ones.
        moments = Moments::about(middle + moments.mean, values);
    }
    moments.nodes()
}

/// [`condensed`] for the logarithms of positive `values` in any order, of `weights` or of the weight 1, in the bins of a grid.
pub(crate) fn condensed_logarithms(values: &[f64], weights: Option<&[f64]>, width: f64) -> Vec<Node> {
    /// Values per task. Fixed, so that results do not depend on the number of threads.
    const TASK: usize = 1 << 16;
    /// Values whose logarithms are taken at a time.
    const SOME: usize = 512;
    let count = values.len();
    let tasks = count.div_ceil(TASK);
    let of_task = |task: usize| &values[task * TASK..count.min((task + 1) * TASK)];
    if count == 0 {
        return Vec::new();
    }
    let Interval { low, high } = Interval::new(values);
    let origin = low.ln();
    let bins = ((high.ln() - origin) / width) as usize + 1;
    let center = |bin: usize| origin + (bin as f64 + 0.5) * width;
    let powers = |task: usize| {
        let mut sums = vec![[0.0; 4]; bins];
        let mut logarithms = [0.0; SOME];
        for (piece, some) in of_task(task).chunks(SOME).enumerate() {
            run(Logarithms { values: some, logarithms: &mut logarithms });
            for (k, &logarithm) in logarithms[..some.len()].iter().enumerate() {
                let bin = (((logarithm - origin) / width) as usize).min(bins - 1);
                let from_center = logarithm - center(bin);
                let mut power = weights.map_or(1.0, |weights| weights[task * TASK + piece * SOME + k]);
                for sum in &mut sums[bin] {
                    *sum += power;
                    power *= from_center;
                }
            }
        }
        let present = |(bin, sums): (usize, [f64; 4])| (sums[0] > 0.0).then_some((bin, sums));
        sums.into_iter().enumerate().filter_map(present).collect::<Vec<_>>()
    };
    let mut total = vec![[0.0; 4]; bins];
    for (bin, sums) in parallel::map(tasks, powers).into_iter().flatten() {
        total[bin].iter_mut().zip(sums).for_each(|(total, sum)| *total += sum);
    }
    let present = total.into_iter().enumerate().filter(|(_, [weight, ..])| *weight > 0.0);
    present.flat_map(|(bin, sums)| Moments::new(center(bin), sums).rounded(width).nodes()).collect()
}

/// The logarithms of positive, normal values.
struct Logarithms<'a> {
    values: &'a [f64],
    logarithms: &'a mut [f64],
}

impl Work for Logarithms<'_> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, zero: N) {
        let count = self.values.len();
        let whole = count - count % N::LANES;
        for at in (0..whole).step_by(N::LANES) {
            zero.load(&self.values[at..]).ln().store(&mut self.logarithms[at..]);
        }
        for at in whole..count {
            self.logarithms[at] = self.values[at].ln();
        }
    }
}

/// Moments of weighted values: the mean relative to an origin, and the second and third central ones.
struct Moments {
    origin: f64,
    weight: f64,
    mean: f64,
    variance: f64,
    third: f64,
}

impl Moments {
    /// In one pass with the powers of the distances from `origin`.
    fn about(origin: f64, values: &[f64]) -> Self {
        let ([first, second, third], count) = sums_of_present([values], Powers { origin });
        Self::new(origin, [count as f64, first, second, third])
    }

    /// From the sums of weights and of these times the first three powers of the distances from `origin`.
    fn new(origin: f64, [weight, first, second, third]: [f64; 4]) -> Self {
        let [mean, second, third] = [first, second, third].map(|sum| sum / weight);
        let variance = (second - mean * mean).max(0.0);
        let third = third - mean * (3.0 * variance + mean * mean);
        Self { origin, weight, mean, variance, third }
    }

    /// Without a variance that may be rounding, in a bin of a width.
    fn rounded(self, width: f64) -> Self {
        const ROUNDING: f64 = 1e-11;
        let is_point = self.variance <= ROUNDING * width * width;
        Self { variance: if is_point { 0.0 } else { self.variance }, ..self }
    }

    /// The rule of two nodes; one node without variance.
    fn nodes(self) -> impl Iterator<Item = Node> {
        let Self { origin, weight, mean, variance, third } = self;
        let sd = variance.sqrt();
        let half_skewness = if sd > 0.0 { 0.5 * third / (variance * sd) } else { 0.0 };
        let root = (1.0 + half_skewness * half_skewness).sqrt();
        let node = move |sign: f64| Node {
            value: origin + mean + sd * (half_skewness + sign * root),
            weight: 0.5 * weight * (1.0 - sign * half_skewness / root),
        };
        let one = (sd == 0.0).then_some(Node { value: origin + mean, weight });
        let two = (sd > 0.0).then(|| [node(-1.0), node(1.0)]);
        one.into_iter().chain(two.into_iter().flatten())
    }
}

/// The first three powers of the distance of values from an origin.
#[derive(Clone, Copy)]
struct Powers {
    origin: f64,
}

impl Terms<1, 3> for Powers {
    #[inline(always)]
    fn of<N: Real>(self, [value]: [N; 1]) -> [N; 3] {
        let from_origin = value - self.origin;
        let square = from_origin * from_origin;
        [from_origin, square, square * from_origin]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(count: usize) -> Vec<f64> {
        let mut values: Vec<f64> = (0..count).map(|k| ((k * 7919) % 10_007) as f64 / 1e4).collect();
        values.sort_by(f64::total_cmp);
        values
    }

    #[test]
    fn moments_are_kept_and_smooth_functions_summed() {
        let all = sample(5000);
        let few = condensed(&all, 0.02);
        assert!(few.len() <= 102, "{}", few.len());
        let sum = |of: fn(f64) -> f64| few.iter().map(|n| n.weight * of(n.value)).sum::<f64>();
        let direct = |of: fn(f64) -> f64| all.iter().map(|&value| of(value)).sum::<f64>();
        for of in [|_| 1.0, |x| x, |x: f64| x * x, |x: f64| x.powi(3)] {
            assert!((sum(of) / direct(of) - 1.0).abs() < 1e-13);
        }
        let of = |x: f64| (3.0 * x).exp();
        assert!((sum(of) / direct(of) - 1.0).abs() < 81.0 * 0.02f64.powi(4) / 4320.0);
        assert!(few.windows(2).all(|pair| pair[0].value <= pair[1].value));
    }

    /// Bins of any sizes in turn, against the search for each end among all.
    #[test]
    fn a_bin_ends_at_its_width() {
        let value = |k: i32| f64::from(k) * if k % 500 < 250 { 1e-3 } else { 1e-5 } + f64::from(k / 250);
        let mut all: Vec<f64> = (0..5000).map(value).collect();
        all.sort_by(f64::total_cmp);
        for width in [0.0, 1e-5, 1.5e-3, 0.07, 10.0, 1e9] {
            let mut rest = &all[..];
            for bin in bins(&all, width) {
                let count = rest.iter().take_while(|value| *value - rest[0] <= width).count();
                assert_eq!(all[bin], rest[..count]);
                rest = &rest[count..];
            }
            assert!(rest.is_empty());
        }
    }

    /// With weights and without, against the sums over all.
    #[test]
    fn logarithms_in_any_order_are_condensed() {
        let all: Vec<f64> = (0..200_000).map(|k| 1e-6 * f64::from(1 + (k * 7919) % 10_007)).collect();
        let weights: Vec<f64> = (0..all.len()).map(|k| 1.0 + (k % 3) as f64).collect();
        for weights in [None, Some(&weights[..])] {
            let nodes = condensed_logarithms(&all, weights, 0.02);
            assert!(nodes.len() <= 2 * 462 && nodes.windows(2).all(|pair| pair[0].value <= pair[1].value));
            let direct = |of: fn(f64) -> f64| -> f64 {
                let weight = |k: usize| weights.map_or(1.0, |weights| weights[k]);
                all.iter().enumerate().map(|(k, value)| weight(k) * of(value.ln())).sum()
            };
            let sum = |of: fn(f64) -> f64| nodes.iter().map(|n| n.weight * of(n.value)).sum::<f64>();
            for of in [|_| 1.0, |x| x, |x: f64| x * x, |x: f64| x.powi(3)] {
                assert!((sum(of) / direct(of) - 1.0).abs() < 1e-12);
            }
            let of = |x: f64| (1.5 * x).exp();
            assert!((sum(of) / direct(of) - 1.0).abs() < 1.5f64.powi(4) * 0.02f64.powi(4) / 4320.0);
        }
        assert_eq!(condensed_logarithms(&[], None, 0.1), []);
        for count in [7, 200_000] {
            let equal = condensed_logarithms(&vec![3e-5; count], None, 5e-3);
            assert!(equal.len() == 1 && equal[0].weight == count as f64);
            assert!((equal[0].value - 3e-5f64.ln()).abs() < 1e-13);
        }
        // Two values a thousand powers of ten apart.
        let [low, high] = condensed_logarithms(&[1e3, 1e-297], None, 5e-3)[..] else { panic!() };
        assert!((low.value - 1e-297f64.ln()).abs() < 1e-12 && (high.value - 1e3f64.ln()).abs() < 1e-12);
    }

    #[test]
    fn few_values_stay_as_they_are() {
        let all = sample(20);
        let kept: Vec<Node> = all.iter().map(|&value| Node { value, weight: 1.0 }).collect();
        assert_eq!(condensed(&all, 1e-4), kept);
        assert_eq!(condensed(&[0.3; 9], 0.1), [Node { value: 0.3, weight: 9.0 }]);
        assert_eq!(condensed(&[], 0.1), []);
    }
}
