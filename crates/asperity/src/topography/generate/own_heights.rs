//! The height distribution of a map, as a transform of a Gaussian field.

use statrs::distribution::{ContinuousCDF, Normal};

use super::super::HeightMap;
use crate::distribution::normal_nodes;
use crate::numeric::sort::sort;
use crate::progress::Silent;

/// The map from a standard normal g to a height of zero mean and unit standard deviation, from the heights of a map: a cubic through their
/// quantiles at equal steps of g; beyond those that hardly an independent height exceeds, slopes grow or shrink as they do there.
#[derive(Debug, Clone)]
pub(super) struct OwnHeights {
    /// The lowest g.
    start: f64,
    /// Heights from it on.
    nodes: Vec<f64>,
    mean: f64,
    deviation: f64,
}

/// Distance of the nodes in g.
const STEP: f64 = 0.25;

impl OwnHeights {
    /// Of the present heights of a map, which are worth `independent` independent ones; `None` of a flat map, and of
    /// one without heights, such as that of a file that became shorter.
    pub(super) fn new(map: &HeightMap, independent: f64) -> Option<Self> {
        /// Independent heights beyond the outermost nodes.
        const BEYOND: f64 = 0.5;
        let mut sorted: Vec<f64> = map.heights().iter().copied().filter(|z| !z.is_nan()).collect();
        sort(&mut sorted, &Silent);
        if sorted.first() == sorted.last() {
            return None;
        }
        let normal = Normal::standard();
        let last = -normal.inverse_cdf((BEYOND / independent).min(0.2));
        let half = (last / STEP).floor();
        let nodes = (0..=2 * half as usize).map(|k| {
            let share = normal.cdf(STEP * (k as f64 - half));
            sorted[((share * sorted.len() as f64) as usize).min(sorted.len() - 1)]
        });
        let raw = Self { start: -STEP * half, nodes: nodes.collect(), mean: 0.0, deviation: 1.0 };
        let moment = |of: &dyn Fn(f64) -> f64| {
            normal_nodes(0.01).map(|[g, weight]| weight * of(raw.at(g))).sum::<f64>()
        };
        let mean = moment(&|z| z);
        let deviation = moment(&|z| (z - mean).powi(2)).sqrt();
        (deviation > 0.0).then_some(Self { mean, deviation, ..raw })
    }

    /// The height at g.
    pub(super) fn at(&self, g: f64) -> f64 {
        let last = self.nodes.len() - 1;
        let place = (g - self.start) / STEP;
        let slope = |k: usize| {
            let (before, after) = (k.saturating_sub(1), (k + 1).min(last));
            (self.nodes[after] - self.nodes[before]) / (after - before) as f64
        };
        // Each step beyond an end, slopes change by the ratio that two steps before it have.
        let beyond = |from: usize, before: usize, steps: f64| {
            let (near, far) = (slope(from), slope(before));
            let change = if near > 0.0 && far > 0.0 { 0.5 * (near / far).clamp(0.1, 4.0).ln() } else { 0.0 };
            near * if change.abs() < 1e-3 { steps } else { (change * steps).exp_m1() / change }
        };
        let height = if place <= 0.0 {
            self.nodes[0] - beyond(1, 3, -place)
        } else if place >= last as f64 {
            self.nodes[last] + beyond(last - 1, last - 3, place - last as f64)
        } else {
            let k = (place as usize).min(last - 1);
            let (t, a, b) = (place - k as f64, self.nodes[k], self.nodes[k + 1]);
            let ends = [k, k + 1].map(|k| slope(k.clamp(1, last - 1)));
            let s = 1.0 - t;
            s * s * (a * (1.0 + 2.0 * t) + ends[0] * t) + t * t * (b * (1.0 + 2.0 * s) - ends[1] * s)
        };
        (height - self.mean) / self.deviation
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Heights;

    /// The heights of a map at the quantiles of a distribution give its transform, also beyond the outermost node at 2.5.
    #[test]
    fn the_transform_is_that_of_the_distribution() {
        for heights in [Heights::GAUSSIAN, Heights::EXPONENTIAL] {
            let quantile = |k: usize| heights.quantile(1.0 - (k as f64 + 0.5) / 40_000.0);
            let map = HeightMap::new([200; 2], [1.0; 2], (0..40_000).map(quantile).collect(), 0.0).unwrap();
            let own = OwnHeights::new(&map, 100.0).unwrap();
            for g in [-3.0, -2.0, -0.9, 0.0, 1.3, 2.4, 3.0] {
                let (found, exact) = (own.at(g), heights.height_at_normal(g));
                assert!(
                    (found - exact).abs() < 0.05 * exact.abs().max(1.0),
                    "{heights} {g}: {found} {exact}"
                );
            }
        }
    }

    /// Heights on few levels have quantiles that are equal.
    #[test]
    fn levels_give_no_nan() {
        let heights = (0..40_000).map(|k| f64::from(k % 3)).collect();
        let own = OwnHeights::new(&HeightMap::new([200; 2], [1.0; 2], heights, 0.0).unwrap(), 100.0).unwrap();
        assert!((-40..40).all(|k| own.at(0.2 * f64::from(k)).is_finite()));
        let flat = HeightMap::new([200; 2], [1.0; 2], vec![1.0; 40_000], 0.0).unwrap();
        assert!(OwnHeights::new(&flat, 100.0).is_none());
    }
}
