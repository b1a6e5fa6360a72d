//! Samples condensed to few weighted nodes: Gauss's rule of two nodes for the values in each of many narrow bins.

/// A weighted value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub value: f64,
    pub weight: f64,
}

/// Few nodes in place of the `sorted` values, with the sums of weight, weight times value, and its second and third
/// powers in every bin of at most `width`. Up to two values of a bin stay as they are. The sum of a function over the
/// nodes differs from that over the values by its fourth derivative times `width`^4/4320 at most, and in a bin where it
/// is not smooth by its change there times the weight of the bin.
pub(super) fn condensed(sorted: &[Node], width: f64) -> Vec<Node> {
    let mut nodes = Vec::new();
    let mut rest = sorted;
    while let Some(first) = rest.first() {
        let count = rest.partition_point(|node| node.value - first.value <= width).max(1);
        let (bin, after) = rest.split_at(count);
        rest = after;
        match bin {
            [_] | [_, _] => nodes.extend_from_slice(bin),
            _ => nodes.extend(two_nodes(bin)),
        }
    }
    nodes
}

/// The rule of two nodes for the values of a bin; one node where they are equal.
fn two_nodes(bin: &[Node]) -> impl Iterator<Item = Node> {
    let origin = bin[0].value;
    let weight: f64 = bin.iter().map(|node| node.weight).sum();
    let mean_of = |of: &dyn Fn(f64) -> f64| {
        bin.iter().map(|node| node.weight * of(node.value - origin)).sum::<f64>() / weight
    };
    let mean = mean_of(&|x| x);
    let variance = mean_of(&|x| (x - mean).powi(2));
    let sd = variance.sqrt();
    let half_skewness = if sd > 0.0 { 0.5 * mean_of(&|x| ((x - mean) / sd).powi(3)) } else { 0.0 };
    let root = (1.0 + half_skewness * half_skewness).sqrt();
    let node = move |sign: f64| Node {
        value: origin + mean + sd * (half_skewness + sign * root),
        weight: 0.5 * weight * (1.0 - sign * half_skewness / root),
    };
    let one = (sd == 0.0).then_some(Node { value: origin + mean, weight });
    let two = (sd > 0.0).then(|| [node(-1.0), node(1.0)]);
    one.into_iter().chain(two.into_iter().flatten())
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

    #[test]
    fn few_values_stay_as_they_are() {
        let all = sample(20);
        assert_eq!(condensed(&all, 1e-4), all);
        let equal = vec![Node { value: 0.3, weight: 2.0 }; 9];
        assert_eq!(condensed(&equal, 0.1), [Node { value: 0.3, weight: 18.0 }]);
        assert_eq!(condensed(&[], 0.1), []);
    }
}
