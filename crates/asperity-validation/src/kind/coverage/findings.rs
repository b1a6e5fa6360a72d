//! Which combinations of case, load and quantity have intervals that hold the truth as often as they state.

use std::ops::Range;

use super::run::CaseCoverage;
use crate::coverage::{Coverage, Quantity};
use asperity::INTERACTION;
use asperity_framework::report::format::{count, number, percent};

/// The coverage that intervals of 95 % may have.
pub const BAND: [f64; 2] = [0.93, 0.97];

/// Where intervals are claimed in a smaller share of the windows, these are not typical of all.
pub const NEARLY_ALL: f64 = 0.9;

/// Where intervals are claimed in a smaller share of the windows, their coverage is not known.
pub const RARELY: f64 = 0.05;

/// Coverage at one load.
#[derive(Debug, Clone)]
pub struct LoadCoverage {
    /// The load, Pa.
    pub load: f64,
    /// The d/sigma at which loads are compared.
    pub separation: f64,
    /// In the order of [`Quantity::ALL`]; `None` where a quantity has values in fewer than two windows.
    pub coverages: [Option<Coverage>; 5],
}

impl LoadCoverage {
    /// Quantities with their coverage.
    pub fn each(&self) -> impl Iterator<Item = (Quantity, &Coverage)> {
        let pairs = Quantity::ALL.into_iter().zip(&self.coverages);
        pairs.filter_map(|(quantity, coverage)| Some((quantity, coverage.as_ref()?)))
    }
}

/// One quantity at one load of one case.
#[derive(Debug, Clone)]
pub struct Combination {
    /// Name of the case.
    pub case: String,
    pub quantity: Quantity,
    pub coverage: Coverage,
    /// Share of the claimed intervals that hold the truth.
    pub share: f64,
    /// Its binomial standard error.
    pub error: f64,
}

impl Combination {
    fn of(case: &CaseCoverage, quantity: Quantity, coverage: &Coverage) -> Option<Self> {
        Some(Self {
            case: case.name.clone(),
            quantity,
            coverage: *coverage,
            share: coverage.claimed.coverage()?,
            error: coverage.claimed.coverage_error()?,
        })
    }

    /// Whether the coverage is within [`BAND`].
    pub fn holds(&self) -> bool {
        (BAND[0]..=BAND[1]).contains(&self.share)
    }
}

/// A case in which intervals are claimed in few windows or none.
#[derive(Debug, Clone, PartialEq)]
pub struct Unclaimed {
    /// Name of the case.
    pub case: String,
    /// The largest share of windows in which an interval is claimed, over loads and quantities.
    pub share: f64,
}

/// Findings over all combinations.
#[derive(Debug, Clone)]
pub struct CoverageFindings {
    /// Combinations in which an interval is claimed in at least [`NEARLY_ALL`] of the windows.
    pub quantity: Vec<Combination>,
    /// Those in which it is claimed in fewer, but at least in [`RARELY`].
    pub partial: Vec<Combination>,
    /// Cases without either.
    pub unclaimed: Vec<Unclaimed>,
    /// Smallest and largest coverage of intervals from asperities taken as independent, over all combinations.
    pub independent: Option<[f64; 2]>,
}

/// Smallest and largest; `None` without values.
pub fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

impl CoverageFindings {
    /// Findings over cases.
    pub fn of(cases: &[CaseCoverage]) -> Self {
        let all = || cases.iter().flat_map(|case| case.loads.iter().map(move |load| (case, load)));
        let each = || all().flat_map(|(case, load)| load.each().map(move |(of, found)| (case, of, found)));
        let within = |shares: Range<f64>| -> Vec<Combination> {
            let claimed = each().filter(|(.., coverage)| shares.contains(&coverage.claimed_share()));
            claimed.filter_map(|(case, of, found)| Combination::of(case, of, found)).collect()
        };
        let unclaimed = cases.iter().filter_map(|case| {
            let coverages = case.loads.iter().flat_map(LoadCoverage::each);
            let share = coverages.map(|(_, coverage)| coverage.claimed_share()).fold(0.0, f64::max);
            (share < RARELY).then(|| Unclaimed { case: case.name.clone(), share })
        });
        Self {
            quantity: within(NEARLY_ALL..f64::INFINITY),
            partial: within(RARELY..NEARLY_ALL),
            unclaimed: unclaimed.collect(),
            independent: range(each().filter_map(|(.., coverage)| coverage.independent.coverage())),
        }
    }

    /// Smallest and largest coverage of the claimed intervals; `None` where none is counted.
    pub fn range(&self) -> Option<[f64; 2]> {
        range(self.quantity.iter().map(|one| one.share))
    }

    /// The largest standard error of a coverage.
    pub fn largest_error(&self) -> f64 {
        self.quantity.iter().map(|one| one.error).fold(0.0, f64::max)
    }

    /// Combinations whose coverage is outside [`BAND`].
    pub fn outside(&self) -> impl Iterator<Item = &Combination> {
        self.quantity.iter().filter(|one| !one.holds())
    }

    /// Combinations outside the band, and loads beyond the valid range, a line each.
    pub fn warnings(&self, cases: &[CaseCoverage]) -> Vec<String> {
        let outside = self.outside().map(|one| {
            format!(
                "{}, {} at {} effective contacts: {} of {} intervals hold the truth (standard error {})",
                one.case,
                one.quantity.name(),
                number(one.coverage.contacts),
                percent(one.share),
                count(one.coverage.claimed.intervals),
                percent(one.error),
            )
        });
        let beyond = cases.iter().filter_map(|case| {
            let coverages = case.loads.iter().flat_map(LoadCoverage::each);
            let area = coverages.map(|(_, coverage)| coverage.area_ratio).fold(0.0, f64::max);
            (area > INTERACTION).then(|| {
                format!(
                    "{}: a mean area ratio of {} is beyond {}",
                    case.name,
                    percent(area),
                    percent(INTERACTION)
                )
            })
        });
        outside.chain(beyond).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coverage::Counted;
    use asperity::Heights;

    /// A case whose only quantity has intervals in `intervals` of 1000 windows, of which `covered` hold the truth.
    fn case(name: &str, intervals: usize, covered: usize) -> CaseCoverage {
        let coverage = Coverage {
            windows: 1000,
            truth: 0.0,
            scatter: 1.0,
            contacts: 100.0,
            area_ratio: 0.01,
            claimed: Counted { intervals, covered, error: 1.0 },
            independent: Counted::default(),
        };
        let coverages = [Some(coverage), None, None, None, None];
        let load = LoadCoverage { load: 1e6, separation: 2.0, coverages };
        let (roll_off, correlation, heights) = (1e-5, 1e-6, Heights::GAUSSIAN);
        CaseCoverage { name: name.to_owned(), roll_off, heights, correlation, loads: vec![load] }
    }

    #[test]
    fn coverage_outside_the_band_is_named() {
        let cases = [case("good", 1000, 950), case("poor", 1000, 920), case("wide", 950, 945)];
        let findings = CoverageFindings::of(&cases);
        assert_eq!(findings.range(), Some([0.92, 945.0 / 950.0]));
        assert!(findings.outside().map(|one| one.case.as_str()).eq(["poor", "wide"]));
        assert_eq!(findings.warnings(&cases).len(), 2);
        assert_eq!(CoverageFindings::of(&cases[..1]).outside().count(), 0);
        assert_eq!(findings.independent, None);
    }

    #[test]
    fn intervals_in_a_part_of_the_windows_are_kept_apart() {
        let findings =
            CoverageFindings::of(&[case("part", 500, 400), case("few", 40, 10), case("none", 0, 0)]);
        assert!(findings.quantity.is_empty() && findings.range().is_none());
        assert!(findings.partial.iter().map(|one| one.share).eq([0.8]));
        let unclaimed = [("few", 0.04), ("none", 0.0)];
        let expected = unclaimed.map(|(case, share)| Unclaimed { case: case.to_owned(), share });
        assert_eq!(findings.unclaimed, expected);
    }
}
