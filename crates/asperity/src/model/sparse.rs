//! A compact copy of the asperities touched at a large separation.

use crate::asperity::Asperities;
use crate::numeric::parallel;

/// A subset of asperities, copied to its own arrays.
pub(super) struct SparseSubset {
    heights: Vec<f64>,
    radii: Vec<f64>,
    spheres: Option<Vec<f64>>,
    nominal_area: f64,
}

impl SparseSubset {
    /// The asperities of `all` above `lowest` (m), in their order; `None` if they are more than a small fraction, or if
    /// `all` is small. The result does not depend on the number of threads.
    pub(super) fn above(lowest: f64, all: &Asperities<'_>) -> Option<Self> {
        /// A small fraction is less than 1/64.
        const FRACTION: usize = 64;
        /// Heights sampled before all are scanned.
        const SAMPLE: usize = 4096;
        /// Asperities per task.
        const TASK: usize = 1 << 16;
        let heights = all.heights();
        let step = heights.len() / SAMPLE;
        let is_touched = |z: &&f64| **z > lowest;
        let enough = SAMPLE / FRACTION + 1;
        if step == 0 || heights.iter().step_by(step).filter(is_touched).take(enough).count() == enough {
            return None;
        }
        let touched = |task: usize| -> Vec<usize> {
            let part = task * TASK..heights.len().min((task + 1) * TASK);
            part.filter(|&place| is_touched(&&heights[place])).collect()
        };
        let parts = parallel::map(heights.len().div_ceil(TASK), touched);
        let column = |values: &[f64]| parts.iter().flatten().map(|&place| values[place]).collect();
        Some(Self {
            heights: column(heights),
            radii: column(all.radii()),
            spheres: all.spheres().map(column),
            nominal_area: all.nominal_area(),
        })
    }

    /// The asperities of the subset.
    pub(super) fn asperities(&self) -> Asperities<'_> {
        Asperities::new(&self.heights, &self.radii, self.spheres.as_deref(), self.nominal_area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_stand_in_their_order_with_their_shapes() {
        let heights: Vec<f64> = (0..200_000).map(|k| f64::from((k * 7919) % 200_000)).collect();
        let radii: Vec<f64> = heights.iter().map(|z| z + 0.5).collect();
        let spheres: Vec<f64> = heights.iter().map(|z| z + 0.25).collect();
        let all = Asperities::new(&heights, &radii, Some(&spheres), 3.0);
        let subset = SparseSubset::above(199_000.0, &all).unwrap();
        let found: Vec<_> = subset.asperities().each().collect();
        let expected: Vec<_> = all.each().filter(|(z, _)| *z > 199_000.0).collect();
        assert_eq!((found.len(), subset.asperities().nominal_area()), (999, 3.0));
        assert_eq!(found, expected);
        // Sorted or not, many asperities are no sparse subset.
        assert!(SparseSubset::above(150_000.0, &all).is_none());
        let mut sorted = heights.clone();
        sorted.sort_by(f64::total_cmp);
        assert!(SparseSubset::above(150_000.0, &Asperities::new(&sorted, &radii, None, 3.0)).is_none());
        assert!(SparseSubset::above(0.0, &all.part(0..4000)).is_none());
        assert_eq!(SparseSubset::above(1e6, &all).unwrap().asperities().count(), 0);
    }
}
