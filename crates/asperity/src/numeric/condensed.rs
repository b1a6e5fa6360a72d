//! Samples condensed to few weighted nodes: Gauss's rule of two nodes for the values in each of many narrow bins.

use super::parallel;

/// A weighted value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Node {
    pub value: f64,
    pub weight: f64,
}

/// Few nodes in place of the `sorted` values, with the sums of weight, weight times value, and its second and third
/// powers in every bin of at most `width`. Up to two values of a bin stay as they are. The sum of a function over the
/// nodes differs from that over the values by its fourth derivative times `width`^4/4320 at most, and in a bin where it
/// is not smooth by its change there times the weight of the bin.
pub(crate) fn condensed(sorted: &[Node], width: f64) -> Vec<Node> {
    /// Bins per task.
    const BINS: usize = 64;
    let bins = bins(sorted, width);
    let of_bin = |bin: &[Node], nodes: &mut Vec<Node>| match bin {
        [_] | [_, _] => nodes.extend_from_slice(bin),
        _ => nodes.extend(two_nodes(bin)),
    };
    let of_bins = |task: usize| {
        let mut nodes = Vec::new();
        bins[task * BINS..bins.len().min((task + 1) * BINS)].iter().for_each(|bin| of_bin(bin, &mut nodes));
        nodes
    };
    parallel::map(bins.len().div_ceil(BINS), of_bins).concat()
}

/// The values in bins of at most `width`, each from its own first value on.
fn bins(sorted: &[Node], width: f64) -> Vec<&[Node]> {
    let mut bins: Vec<&[Node]> = Vec::new();
    let mut rest = sorted;
    while let Some(first) = rest.first() {
        let is_inside = |node: &Node| node.value - first.value <= width;
        // A bin holds about as many as the one before: its end is sought from there.
        let mut near = bins.last().map_or(1, |bin| bin.len());
        let mut inside = 0;
        while near < rest.len() && is_inside(&rest[near]) {
            inside = near;
            near *= 2;
        }
        let within = &rest[inside..near.min(rest.len())];
        let count = (inside + within.partition_point(is_inside)).max(1);
        let (bin, after) = rest.split_at(count);
        bins.push(bin);
        rest = after;
    }
    bins
}

/// The rule of two nodes for the values of a bin; one node where they are equal.
fn two_nodes(bin: &[Node]) -> impl Iterator<Item = Node> {
    let origin = bin[0].value;
    let weight: f64 = bin.iter().map(|node| node.weight).sum();
    let mean = mean_of(bin, |node| node.value - origin, weight);
    let variance = mean_of(bin, |node| (node.value - origin - mean).powi(2), weight);
    let sd = variance.sqrt();
    let cube = |node: &Node| ((node.value - origin - mean) / sd).powi(3);
    let half_skewness = if sd > 0.0 { 0.5 * mean_of(bin, cube, weight) } else { 0.0 };
    let root = (1.0 + half_skewness * half_skewness).sqrt();
    let node = move |sign: f64| Node {
        value: origin + mean + sd * (half_skewness + sign * root),
        weight: 0.5 * weight * (1.0 - sign * half_skewness / root),
    };
    let one = (sd == 0.0).then_some(Node { value: origin + mean, weight });
    let two = (sd > 0.0).then(|| [node(-1.0), node(1.0)]);
    one.into_iter().chain(two.into_iter().flatten())
}

/// The mean of what is asked of each value, weighted; of all together the `weight`.
fn mean_of(bin: &[Node], of: impl Fn(&Node) -> f64, weight: f64) -> f64 {
    bin.iter().map(|node| node.weight * of(node)).sum::<f64>() / weight
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let few = condensed(&all, 0.02);
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
            for bin in bins(&all, width) {
                let count = rest.iter().take_while(|node| node.value - rest[0].value <= width).count();
                assert_eq!(bin, &rest[..count]);
                rest = &rest[count..];
            }
            assert!(rest.is_empty());
        }
    }

    #[test]
    fn few_values_stay_as_they_are() {
        let all = sample(20);
        assert_eq!(condensed(&all, 1e-4), all);
        let equal = vec![Node { value: 0.3, weight: 2.0 }; 9];
        assert_eq!(condensed(&equal, 0.1), [Node { value: 0.3, weight: 18.0 }]);
        assert_eq!(condensed(&[], 0.1), []);
    }
}
