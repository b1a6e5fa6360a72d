//! The mean radius of the asperities above a height.

use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::Asperities;

/// The mean radius of the asperities above each height of a set.
#[derive(Debug)]
pub struct RadiiAbove {
    /// Heights, descending, m, and the mean radius of the asperities down to each, m.
    down_to: Vec<(f64, f64)>,
}

impl RadiiAbove {
    /// Of `asperities`, at least one.
    pub fn new(asperities: Asperities<'_>) -> Self {
        let each = asperities.heights().par_iter().copied().zip(asperities.radii().par_iter().copied());
        let mut down_to: Vec<(f64, f64)> = each.collect();
        down_to.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
        let mut sum = 0.0;
        for (index, (_, radius)) in down_to.iter_mut().enumerate() {
            sum += *radius;
            *radius = sum / (index + 1) as f64;
        }
        Self { down_to }
    }

    /// That of the asperities above `height` (m, in the frame of the heights), m; above all of them the radius of the highest one.
    pub fn mean(&self, height: f64) -> f64 {
        let count = self.down_to.partition_point(|(z, _)| *z > height);
        self.down_to[count.max(1) - 1].1
    }
}

/// Those of a set, found when they are first asked for. They follow from the set: two sets are compared without them.
#[derive(Debug, Clone, Default)]
pub(super) struct OnDemand(Arc<OnceLock<RadiiAbove>>);

impl OnDemand {
    pub(super) fn of(&self, asperities: Asperities<'_>) -> &RadiiAbove {
        self.0.get_or_init(|| RadiiAbove::new(asperities))
    }
}

impl PartialEq for OnDemand {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
