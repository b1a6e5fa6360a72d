//! Fitness checks of windows that have no fault.

use asperity::topography::fitness::{Check, Finding};
use statrs::distribution::{Beta, ContinuousCDF};

/// How often a check finds a fault where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CheckCount {
    /// The check.
    pub check: Check,
    /// Windows.
    pub windows: usize,
    /// Windows in which it fails.
    pub failed: usize,
    /// Windows in which it fails so that no verdict is given.
    pub blocked: usize,
}

impl CheckCount {
    /// Of the findings of some windows: every check, in their order.
    pub fn all(windows: &[Vec<Finding>]) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        for finding in windows.iter().flatten() {
            let place = all.iter().position(|count| count.check == finding.check).unwrap_or_else(|| {
                all.push(Self { check: finding.check, windows: 0, failed: 0, blocked: 0 });
                all.len() - 1
            });
            let count = &mut all[place];
            count.windows += 1;
            count.failed += usize::from(!finding.has_passed());
            count.blocked += usize::from(finding.is_blocking());
        }
        all
    }

    /// The upper 95 % limit of the share of windows in which it fails: the share at which as few would fail in 5 % of the
    /// experiments.
    pub fn upper_limit(&self) -> f64 {
        upper_limit(self.failed, self.windows)
    }
}

/// The share at which at most `count` of `of` are found with a probability of 5 % (Clopper and Pearson 1934): a quantile of the beta
/// distribution.
pub fn upper_limit(count: usize, of: usize) -> f64 {
    let distribution = Beta::new(count as f64 + 1.0, of as f64 - count as f64);
    distribution.map_or(1.0, |distribution| distribution.inverse_cdf(0.95))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::topography::fitness::Measure;

    #[test]
    fn upper_limits_are_those_of_the_binomial_distribution() {
        // Without a find 1 - 0.05^(1/n); tables of Clopper and Pearson for 2 of 10 and 3 of 50.
        assert!((upper_limit(0, 2000) - (1.0 - 0.05f64.powf(1.0 / 2000.0))).abs() < 1e-12);
        assert!((upper_limit(2, 10) - 0.506_901).abs() < 1e-5, "{}", upper_limit(2, 10));
        assert!((upper_limit(3, 50) - 0.147_840).abs() < 1e-4, "{}", upper_limit(3, 50));
        assert_eq!(upper_limit(5, 5), 1.0);
    }

    #[test]
    fn finds_are_counted_check_by_check() {
        let lines = |value| Finding { check: Check::Lines, measure: Measure::LineOffsets, value };
        let slope = |value| Finding { check: Check::Slope, measure: Measure::Slope, value };
        let all =
            CheckCount::all(&[vec![lines(0.0), slope(0.5)], vec![lines(0.1), slope(0.1)], vec![lines(0.0)]]);
        let of = |k: usize| (all[k].check, all[k].windows, all[k].failed, all[k].blocked);
        assert_eq!(of(0), (Check::Lines, 3, 1, 1));
        assert_eq!(of(1), (Check::Slope, 2, 1, 0));
    }
}
