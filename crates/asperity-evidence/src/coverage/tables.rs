//! Tables: how often intervals hold the truth, and verdicts are wrong.

use asperity::compare::{
    Accepted, ByQuantity, ComparedQuantity, Estimate, GROUPS, Verdict, jackknife_quantile,
};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};
use statrs::distribution::{Beta, ContinuousCDF};

use super::window::{QuantityEstimate, WindowVerdict};

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct IntervalCount {
    pub intervals: usize,
    /// Intervals that hold the truth.
    pub covered: usize,
    /// Mean of the stated standard errors.
    error: f64,
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

    pub fn coverage_error(&self) -> Option<f64> {
        let share = self.coverage()?;
        Some((share * (1.0 - share) / self.intervals as f64).sqrt())
    }
}

/// Coverage of one quantity at one load of one case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    pub case: &'static str,
    /// Pa.
    pub load: f64,
    pub quantity: ComparedQuantity,
    /// Windows in which the quantity has a value.
    pub windows: usize,
    /// Mean over these windows.
    pub truth: f64,
    /// Standard deviation over them.
    pub scatter: f64,
    pub contacts: f64,
    /// Mean of the larger area ratio of both models.
    pub area_ratio: f64,
    /// Intervals that the library claims.
    pub claimed: IntervalCount,
    /// Intervals from asperities taken as independent.
    pub independent: IntervalCount,
}

impl Coverage {
    /// From the windows in which a quantity has a value; `None` of fewer than two.
    pub fn new(
        case: &'static str,
        load: f64,
        quantity: ComparedQuantity,
        windows: &[QuantityEstimate],
    ) -> Option<Self> {
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
            case,
            load,
            quantity,
            windows: windows.len(),
            truth,
            scatter: (squares / (count - 1.0)).sqrt(),
            contacts: mean(|window| window.contacts),
            area_ratio: mean(|window| window.area_ratio),
            claimed: IntervalCount::new(windows.iter().map(|window| window.estimate), truth),
            independent: IntervalCount::new(windows.iter().map(as_independent), truth),
        })
    }

    /// The share of windows in which an interval is claimed.
    pub fn claimed_share(&self) -> f64 {
        self.claimed.intervals as f64 / self.windows as f64
    }

    /// The stated standard error of some intervals over the scatter of the windows; `None` without an interval.
    pub fn error_over_scatter(&self, counted: &IntervalCount) -> Option<f64> {
        (counted.intervals > 0).then(|| counted.error / self.scatter)
    }
}

impl Row for &Coverage {
    const FILE: &'static str = "coverage.csv";
    const ROWS: &'static str =
        "One row for each case, load and quantity: how often 95 % intervals hold the mean over all windows.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case: the random process of which windows are seen.";
            load_pa["Pa", prefix("M")] = row.load, "Nominal pressure.";
            quantity["text"] = row.quantity.name(), "Difference between both models at equal load in `separation` (in sigma), or in `area`, `stiffness` or `thermal-conductance` (logarithm of the ratio).";
            effective_contacts["1"] = row.contacts, "Mean number of effective contacts of the sum.";
            area_ratio["1", percent] = row.area_ratio, "Mean of the larger area ratio of both models.";
            windows["count"] = row.windows, "Windows in which the quantity has a value.";
            truth["1"] = row.truth, "Mean of the quantity over these windows.";
            scatter["1"] = row.scatter, "Standard deviation of the quantity over these windows.";
            intervals["count"] = row.claimed.intervals, "Windows in which the program claims an interval.";
            covered["count"] = row.claimed.covered, "Windows whose claimed interval holds the truth.";
            coverage["1", percent] = row.claimed.coverage(), "Share of the claimed intervals that hold the truth; empty where none is claimed.";
            coverage_standard_error["1", label("± s.e."), percent] = row.claimed.coverage_error(), "Binomial standard error of the coverage.";
            stated_over_scatter["1", label("stated error over scatter")] = row.error_over_scatter(&row.claimed), "Mean stated standard error over the scatter.";
            independent_intervals["count"] = row.independent.intervals, "Windows with an interval from asperities taken as independent: of one window of each map, those with enough contacts.";
            independent_covered["count"] = row.independent.covered, "Those of them whose interval holds the truth.";
            independent_coverage["1", label("coverage, asperities as independent"), percent] = row.independent.coverage(), "Share of these intervals that hold the truth.";
            independent_stated_over_scatter["1"] = row.error_over_scatter(&row.independent), "Mean standard error for independent asperities over the scatter.";
        }
    }
}

/// The contrasts of a process, for each load in the order of [`ComparedQuantity::ALL`]; `None` where one has no value.
pub type Truths = [ByQuantity<Option<f64>>];

impl WindowVerdict {
    /// Whether the verdict is wrong, if it decides; `None` where it does not, or where the truth is not known.
    pub fn is_wrong(&self, truths: &Truths) -> Option<bool> {
        let truth = truths[self.load][self.quantity as usize]?;
        let band = Accepted::DEFAULT.band(self.quantity);
        let is_inside = (band[0]..=band[1]).contains(&truth);
        match self.verdict {
            Verdict::Within | Verdict::VeryLikelyWithin => Some(!is_inside),
            // Beyond on the other side is wrong, too.
            Verdict::Beyond | Verdict::VeryLikelyBeyond => {
                Some(is_inside || (self.contrast < band[0]) != (truth < band[0]))
            }
            Verdict::CannotTell => None,
        }
    }
}

/// Decided and wrong verdicts over windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VerdictCount {
    pub windows: usize,
    pub deciding_windows: usize,
    pub wrong_windows: usize,
    /// Verdicts: quantities at admissible loads.
    pub verdicts: usize,
    pub decided: usize,
    pub wrong: usize,
}

impl VerdictCount {
    /// Over windows of these verdicts, of which those that are not `counted` count as not decided.
    pub fn over<'a>(
        windows: impl Iterator<Item = &'a [WindowVerdict]>,
        truths: &Truths,
        counted: impl Fn(&WindowVerdict) -> bool,
    ) -> Self {
        let mut count = Self::default();
        for verdicts in windows {
            let outcomes = verdicts.iter().filter(|verdict| counted(verdict));
            let outcomes: Vec<bool> = outcomes.filter_map(|verdict| verdict.is_wrong(truths)).collect();
            let wrong = outcomes.iter().filter(|is_wrong| **is_wrong).count();
            count.windows += 1;
            count.deciding_windows += usize::from(!outcomes.is_empty());
            count.wrong_windows += usize::from(wrong > 0);
            count.verdicts += verdicts.len();
            count.decided += outcomes.len();
            count.wrong += wrong;
        }
        count
    }

    /// The share of decided verdicts that are wrong; `None` where none decides.
    pub fn wrong_share(&self) -> Option<f64> {
        (self.decided > 0).then(|| self.wrong as f64 / self.decided as f64)
    }

    /// The share of the windows that decide something in which a verdict is wrong; `None` without such a window.
    pub fn wrong_window_share(&self) -> Option<f64> {
        (self.deciding_windows > 0).then(|| self.wrong_windows as f64 / self.deciding_windows as f64)
    }
}

/// The windows of one process, with one kind of verdicts in them.
#[derive(Debug, Clone)]
pub struct ProcessRow {
    pub case: &'static str,
    pub heights: String,
    pub roughness: String,
    /// m
    pub roll_off: f64,
    /// Median over the windows of the larger correlation length of x and y over the side; infinite where that of most does not decay.
    pub correlation: f64,
    pub windows: usize,
    /// Share of the windows whose roughness is found to be patchy.
    pub patchy: f64,
    pub kind: &'static str,
    pub count: VerdictCount,
}

impl Row for &ProcessRow {
    const FILE: &'static str = "processes.csv";
    const ROWS: &'static str = "One row for each case, a random process, and kind of verdicts: its windows, and how often verdicts of one window (`within` or `beyond` at an admissible load) contradict the mean over all windows.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case, "Case.";
            heights["text"] = row.heights.as_str(), "Distribution of the heights of the field.";
            roughness["text"] = row.roughness.as_str(), "How the roughness differs from an isotropic, homogeneous one; empty where it does not.";
            roll_off_m["m", label("roll-off"), input] = row.roll_off, "Longest wavelength of the power law.";
            correlation_lengths_per_window["1"] = row.correlation.recip(), "Side of a window over the correlation length, which is the median over the windows.";
            patchy_share["1", label("windows found patchy"), percent] = row.patchy, "Share of the windows whose roughness is found to be patchy.";
            verdicts_counted["text", label("verdicts")] = row.kind, "Which verdicts are counted: `decided` ones (`within`, `beyond`); `very likely` ones by a model-based interval; `very likely, without interval`: a difference far beyond what is accepted on all halves of a window; `decided, windows studied`: those in the windows that were studied under other treatments; `decided, robust`: there, those that depend on no choice.";
            windows["count"] = row.count.windows, "Windows.";
            deciding_windows["count", label("windows that decide")] = row.count.deciding_windows, "Windows with a decided verdict.";
            verdicts["count"] = row.count.verdicts, "Verdicts: quantities at admissible loads.";
            decided["count"] = row.count.decided, "Verdicts of the kind that is counted.";
            wrong["count"] = row.count.wrong, "Decided verdicts that are wrong: the mean over all windows is on another side of what is accepted.";
            wrong_share["1", label("wrong, of decided"), percent] = row.count.wrong_share(), "Share of the decided verdicts that are wrong.";
            wrong_windows["count"] = row.count.wrong_windows, "Windows with a wrong verdict.";
            wrong_window_share["1", label("windows with a wrong verdict"), percent] = row.count.wrong_window_share(), "Their share of the windows that decide.";
            wrong_window_upper["1", label("upper 95 % limit"), percent] = (row.count.deciding_windows > 0).then(|| upper_limit(row.count.wrong_windows, row.count.deciding_windows)), "Upper 95 % limit of this share (binomial).";
        }
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
    use asperity::compare::ComparedQuantity;
    use asperity::study::Choice;

    fn verdict(verdict: Verdict, contrast: f64, depends_on: Vec<Choice>) -> WindowVerdict {
        WindowVerdict {
            load: 0,
            quantity: ComparedQuantity::Separation,
            contrast,
            verdict,
            is_on_halves: false,
            depends_on,
        }
    }

    /// 0.1 sigma are accepted.
    #[test]
    fn a_verdict_is_wrong_where_the_truth_is_on_another_side() {
        let wrong = |of: Verdict, contrast: f64, truth: Option<f64>| {
            verdict(of, contrast, Vec::new()).is_wrong(&[[truth, None, None, None, None, None]])
        };
        use Verdict::{Beyond, CannotTell, Within};
        assert_eq!(
            [wrong(Within, 0.0, Some(0.05)), wrong(Within, 0.0, Some(0.2))],
            [Some(false), Some(true)]
        );
        assert_eq!(
            [wrong(Beyond, 0.3, Some(0.2)), wrong(Beyond, 0.3, Some(0.05))],
            [Some(false), Some(true)]
        );
        assert_eq!(wrong(Beyond, -0.3, Some(0.2)), Some(true), "beyond on the other side");
        assert_eq!([wrong(CannotTell, 0.3, Some(0.05)), wrong(Within, 0.0, None)], [None, None]);
    }

    #[test]
    fn verdicts_that_do_not_count_are_not_decided() {
        let truths = [[Some(0.2), None, None, None, None, None]];
        let window = [
            verdict(Verdict::Within, 0.0, vec![Choice::Spikes]),
            verdict(Verdict::Beyond, 0.3, Vec::new()),
            verdict(Verdict::CannotTell, 0.1, Vec::new()),
        ];
        let count = |counted: fn(&WindowVerdict) -> bool| {
            VerdictCount::over([&window[..]].into_iter(), &truths, counted)
        };
        let all = count(|_| true);
        assert_eq!((all.wrong_share(), all.wrong_window_share()), (Some(0.5), Some(1.0)));
        let robust = count(|verdict| verdict.depends_on.is_empty());
        assert_eq!((robust.wrong_share(), robust.wrong_window_share()), (Some(0.0), Some(0.0)));
        assert_eq!((all.verdicts, all.decided, all.wrong), (3, 2, 1));
        assert_eq!(VerdictCount::default().wrong_share(), None);
        // A window that decides nothing cannot be wrong.
        let open = count(|_| false);
        assert_eq!((open.windows, open.deciding_windows, open.wrong_window_share()), (1, 0, None));
    }

    #[test]
    fn upper_limits_are_those_of_the_binomial_distribution() {
        // Without a find 1 - 0.05^(1/n); tables of Clopper and Pearson for 2 of 10 and 3 of 50.
        assert!((upper_limit(0, 2000) - (1.0 - 0.05f64.powf(1.0 / 2000.0))).abs() < 1e-12);
        assert!((upper_limit(2, 10) - 0.506_901).abs() < 1e-5, "{}", upper_limit(2, 10));
        assert!((upper_limit(3, 50) - 0.147_840).abs() < 1e-4, "{}", upper_limit(3, 50));
        assert_eq!(upper_limit(5, 5), 1.0);
    }
}
