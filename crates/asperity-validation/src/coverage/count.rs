//! How often intervals hold the truth.

use asperity::compare::{Estimate, GROUPS, jackknife_quantile};

use super::window::QuantityEstimate;

/// Intervals of one kind over the windows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct IntervalCount {
    /// Windows in which there is an interval.
    pub intervals: usize,
    /// Intervals that hold the truth.
    pub covered: usize,
    /// Mean of the stated standard errors.
    pub error: f64,
}

impl IntervalCount {
    fn new(estimates: impl Iterator<Item = Estimate>, truth: f64) -> Self {
        let mut counted = Self::default();
        let mut errors = 0.0;
        for estimate in estimates {
            let (Some([low, high]), Some(error)) = (estimate.interval(), estimate.error) else { continue };
            counted.intervals += 1;
            counted.covered += usize::from(low <= truth && truth <= high);
            errors += error;
        }
        if counted.intervals > 0 {
            counted.error = errors / counted.intervals as f64;
        }
        counted
    }

    /// The share of intervals that hold the truth; `None` without an interval.
    pub fn coverage(&self) -> Option<f64> {
        (self.intervals > 0).then(|| self.covered as f64 / self.intervals as f64)
    }

    /// Its binomial standard error.
    pub fn coverage_error(&self) -> Option<f64> {
        let share = self.coverage()?;
        Some((share * (1.0 - share) / self.intervals as f64).sqrt())
    }
}

/// Coverage of one quantity at one load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Windows in which the quantity has a value.
    pub windows: usize,
    /// Mean over these windows.
    pub truth: f64,
    /// Standard deviation over them.
    pub scatter: f64,
    /// Mean number of effective contacts.
    pub contacts: f64,
    /// Mean of the larger area ratio of both models.
    pub area_ratio: f64,
    /// Intervals that the program claims.
    pub claimed: IntervalCount,
    /// Intervals from asperities taken as independent.
    pub independent: IntervalCount,
}

impl Coverage {
    /// From the windows in which a quantity has a value; `None` of fewer than two.
    pub fn new(windows: &[QuantityEstimate]) -> Option<Self> {
        if windows.len() < 2 {
            return None;
        }
        let count = windows.len() as f64;
        let mean = |value: fn(&QuantityEstimate) -> f64| windows.iter().map(value).sum::<f64>() / count;
        let truth = mean(|window| window.estimate.contrast);
        let squares: f64 = windows.iter().map(|window| (window.estimate.contrast - truth).powi(2)).sum();
        let as_independent = |window: &QuantityEstimate| Estimate {
            error: window.independent_error,
            quantile: jackknife_quantile(GROUPS),
            bound: 0.0,
            ..window.estimate
        };
        Some(Self {
            windows: windows.len(),
            truth,
            scatter: (squares / (count - 1.0)).sqrt(),
            contacts: mean(|window| window.contacts),
            area_ratio: mean(|window| window.area_ratio),
            claimed: IntervalCount::new(windows.iter().map(|window| window.estimate), truth),
            independent: IntervalCount::new(windows.iter().map(as_independent), truth),
        })
    }

    /// The share of windows in which the program claims an interval.
    pub fn claimed_share(&self) -> f64 {
        self.claimed.intervals as f64 / self.windows as f64
    }

    /// The stated standard error of some intervals over the scatter of the windows; `None` without an interval.
    pub fn error_over_scatter(&self, counted: &IntervalCount) -> Option<f64> {
        (counted.intervals > 0).then(|| counted.error / self.scatter)
    }
}
