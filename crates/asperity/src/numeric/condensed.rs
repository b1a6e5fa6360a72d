//! Samples condensed to few weighted nodes: Gauss's rule of two nodes for the values in each of many narrow bins.

use std::ops::Range;

use super::lanes::Real;
use super::parallel;
use super::sum::{Terms, sums_of_present};

/// A weighted value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    pub value: f64,
    pub weight: f64,
}

/// Few nodes in place of ascending `values` of `weights`, or of the weight 1, with the sums of weight, weight times value, and its
/// second and third powers in every bin of at most `width`. Up to two values of a bin stay as they are. The sum of a
/// function over the nodes differs from that over the values by its fourth derivative times `width`^4/4320 at most, and in a bin
/// where it is not smooth by its change there times the weight of the bin.
pub(crate) fn condensed(values: &[f64], weights: Option<&[f64]>, width: f64) -> Vec<Node> {
    /// Bins per task.
    const BINS: usize = 64;
    let bins = bins(values, width);
    let of_bins = |task: usize| {
        let mut nodes = Vec::new();
        for bin in &bins[task * BINS..bins.len().min((task + 1) * BINS)] {
            if bin.len() <= 2 {
                let weight = |place: usize| weights.map_or(1.0, |weights| weights[place]);
                nodes.extend(bin.clone().map(|place| Node { value: values[place], weight: weight(place) }));
            } else {
                nodes.extend(two_nodes(&values[bin.clone()], weights.map(|weights| &weights[bin.clone()])));
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
fn two_nodes(values: &[f64], weights: Option<&[f64]>) -> impl Iterator<Item = Node> {
    let middle = values[values.len() / 2];
    let mut moments = Moments::about(middle, values, weights);
    if moments.mean * moments.mean > moments.variance {
        // Far from the mean the central moments are differences of larger ones.
        moments = Moments::about(middle + moments.mean, values, weights);
    }
    let Moments { origin, weight, mean, variance, third } = moments;
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
    fn about(origin: f64, values: &[f64], weights: Option<&[f64]>) -> Self {
        let (weight, [first, second, third]) = match weights {
            Some(weights) => {
                let ([weight, rest @ ..], _) = sums_of_present([values, weights], Powers { origin });
                (weight, rest)
            }
            None => {
                let (powers, count) = sums_of_present([values], Powers { origin });
                (count as f64, powers)
            }
        };
        let [mean, second, third] = [first, second, third].map(|sum| sum / weight);
        let variance = (second - mean * mean).max(0.0);
        let third = third - mean * (3.0 * variance + mean * mean);
        Self { origin, weight, mean, variance, third }
    }
}

/// The first three powers of the distance of values from an origin; of weighted ones the weight and these times the weight.
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

impl Terms<2, 4> for Powers {
    #[inline(always)]
    fn of<N: Real>(self, [value, weight]: [N; 2]) -> [N; 4] {
        let [first, second, third] = self.of([value]);
        [weight, weight * first, weight * second, weight * third]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(all: &[Node], width: f64) -> Vec<Node> {
        let values: Vec<f64> = all.iter().map(|node| node.value).collect();
        let weights: Vec<f64> = all.iter().map(|node| node.weight).collect();
        condensed(&values, Some(&weights), width)
    }

    fn sample(count: usize) -> Vec<Node> {
        let mut nodes: Vec<Node> = (0..count)
            .map(|k| Node { value: ((k * 7919) % 10_007) as f64 / 1e4, weight: 1.0 + (k % 3) as f64 })
            .collect();
        nodes.sort_by(|a, b| a.value.total_cmp(&b.value));
        nodes
    }

    #[test]
    fn moments_are_kept_and_smooth_functions_summed() {
        let all = sample(5000);
        let few = of(&all, 0.02);
        assert!(few.len() <= 102, "{}", few.len());
        let sum =
            |nodes: &[Node], of: fn(f64) -> f64| nodes.iter().map(|n| n.weight * of(n.value)).sum::<f64>();
        for of in [|_| 1.0, |x| x, |x: f64| x * x, |x: f64| x.powi(3)] {
            assert!((sum(&few, of) / sum(&all, of) - 1.0).abs() < 1e-13);
        }
        let of = |x: f64| (3.0 * x).exp();
        assert!((sum(&few, of) / sum(&all, of) - 1.0).abs() < 81.0 * 0.02f64.powi(4) / 4320.0);
        assert!(few.windows(2).all(|pair| pair[0].value <= pair[1].value));
    }

    /// Bins of any sizes in turn, against the search for each end among all.
    #[test]
    fn a_bin_ends_at_its_width() {
        let value = |k: i32| f64::from(k) * if k % 500 < 250 { 1e-3 } else { 1e-5 } + f64::from(k / 250);
        let mut all: Vec<Node> = (0..5000).map(|k| Node { value: value(k), weight: 1.0 }).collect();
        all.sort_by(|a, b| a.value.total_cmp(&b.value));
        for width in [0.0, 1e-5, 1.5e-3, 0.07, 10.0, 1e9] {
            let mut rest = &all[..];
            let values: Vec<f64> = all.iter().map(|node| node.value).collect();
            for bin in bins(&values, width) {
                let count = rest.iter().take_while(|node| node.value - rest[0].value <= width).count();
                assert_eq!(all[bin], rest[..count]);
                rest = &rest[count..];
            }
            assert!(rest.is_empty());
        }
    }

    #[test]
    fn few_values_stay_as_they_are() {
        let all = sample(20);
        assert_eq!(of(&all, 1e-4), all);
        let equal = vec![Node { value: 0.3, weight: 2.0 }; 9];
        assert_eq!(of(&equal, 0.1), [Node { value: 0.3, weight: 18.0 }]);
        assert_eq!(of(&[], 0.1), []);
    }
}
