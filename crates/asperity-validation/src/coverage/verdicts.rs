//! Verdicts in windows, held against the truth.

use asperity::compare::{Accepted, ByQuantity, ComparedQuantity, Verdict};
use asperity::study::Choice;

use super::checks::upper_limit;

/// The verdict on one quantity at an admissible load of one window.
#[derive(Debug, Clone, PartialEq)]
pub struct WindowVerdict {
    /// Index of the load.
    pub load: usize,
    /// The quantity.
    pub quantity: ComparedQuantity,
    /// Its contrast in the window.
    pub contrast: f64,
    /// The verdict on it.
    pub verdict: Verdict,
    /// Whether it rests on differences on the halves of the window, without an interval.
    pub is_on_halves: bool,
    /// The choices in the analysis of the map that it depends on, where these were examined.
    pub depends_on: Vec<Choice>,
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
    /// Windows.
    pub windows: usize,
    /// Windows in which a verdict decides.
    pub deciding_windows: usize,
    /// Windows in which a verdict is wrong.
    pub wrong_windows: usize,
    /// Verdicts: quantities at admissible loads.
    pub verdicts: usize,
    /// Verdicts that decide.
    pub decided: usize,
    /// Those of them that are wrong.
    pub wrong: usize,
}

impl VerdictCount {
    /// Adds a window of these verdicts, of which those that are not `counted` count as not decided.
    pub fn add(
        &mut self,
        verdicts: &[WindowVerdict],
        truths: &Truths,
        counted: impl Fn(&WindowVerdict) -> bool,
    ) {
        let outcomes = verdicts.iter().filter(|verdict| counted(verdict));
        let outcomes: Vec<bool> = outcomes.filter_map(|verdict| verdict.is_wrong(truths)).collect();
        let wrong = outcomes.iter().filter(|is_wrong| **is_wrong).count();
        self.windows += 1;
        self.deciding_windows += usize::from(!outcomes.is_empty());
        self.wrong_windows += usize::from(wrong > 0);
        self.verdicts += verdicts.len();
        self.decided += outcomes.len();
        self.wrong += wrong;
    }

    /// Of both.
    #[must_use]
    pub fn plus(self, other: &Self) -> Self {
        Self {
            windows: self.windows + other.windows,
            deciding_windows: self.deciding_windows + other.deciding_windows,
            wrong_windows: self.wrong_windows + other.wrong_windows,
            verdicts: self.verdicts + other.verdicts,
            decided: self.decided + other.decided,
            wrong: self.wrong + other.wrong,
        }
    }

    /// The share of decided verdicts that are wrong; `None` where none decides.
    pub fn wrong_share(&self) -> Option<f64> {
        (self.decided > 0).then(|| self.wrong as f64 / self.decided as f64)
    }

    /// The share of the windows that decide something in which a verdict is wrong; `None` without such a window.
    pub fn wrong_window_share(&self) -> Option<f64> {
        (self.deciding_windows > 0).then(|| self.wrong_windows as f64 / self.deciding_windows as f64)
    }

    /// The upper 95 % limit of that share.
    pub fn wrong_window_limit(&self) -> Option<f64> {
        (self.deciding_windows > 0).then(|| upper_limit(self.wrong_windows, self.deciding_windows))
    }

    /// The share of verdicts that decide; `None` without a verdict.
    pub fn decided_share(&self) -> Option<f64> {
        (self.verdicts > 0).then(|| self.decided as f64 / self.verdicts as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let mut count = VerdictCount::default();
            count.add(&window, &truths, counted);
            count
        };
        let all = count(|_| true);
        assert_eq!((all.wrong_share(), all.wrong_window_share()), (Some(0.5), Some(1.0)));
        let robust = count(|verdict| verdict.depends_on.is_empty());
        assert_eq!((robust.wrong_share(), robust.wrong_window_share()), (Some(0.0), Some(0.0)));
        let both = all.plus(&robust);
        assert_eq!((both.windows, both.verdicts, both.decided, both.wrong), (2, 6, 3, 1));
        assert_eq!(both.decided_share(), Some(0.5));
        assert_eq!(VerdictCount::default().wrong_share(), None);
        // A window that decides nothing cannot be wrong.
        let open = count(|_| false);
        assert_eq!((open.windows, open.deciding_windows, open.wrong_window_share()), (1, 0, None));
        assert_eq!(all.plus(&open).wrong_window_share(), Some(1.0));
    }
}
