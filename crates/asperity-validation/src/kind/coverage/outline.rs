//! The page of `[coverage]`: how often claimed intervals hold the truth, by process and by quantity.

use asperity::INTERACTION;
use asperity::numeric::extremes;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{capitalised, count, input_number, input_quantity, percent};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use serde_json::{Map, Value};

use super::figures::{WRONG_VERDICTS, caption, coverage, wrong_verdicts};
use super::results::{CaseResults, CoverageResults, total};
use super::rows::{CheckRow, CoverageRow, ProcessRow, SpikeRow, VerdictRow, tables};
use super::spec::Intervals;
use crate::coverage::{CoveredQuantity, VerdictCount};

impl Outcome for CoverageResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        warnings(&self.cases)
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(self.intervals, &self.cases));
        page.figure("coverage.svg", coverage(self), &caption(self));
        sections::warnings(&mut page, &self.warnings());
        page.heading(2, "Coverage by process");
        page.view(&tables.view::<ProcessRow>().without(&SETUP[1..]));
        page.details(2, "Wrong verdicts", |page| {
            // Points that all lie at zero show nothing that the table does not say.
            if self.cases.iter().any(|case| case.verdicts.wrong + case.robust.wrong > 0) {
                page.figure("wrong-verdicts.svg", wrong_verdicts(self), WRONG_VERDICTS);
            }
            page.view(&tables.view::<VerdictRow>());
        });
        page.details(2, "Fitness checks of windows without faults", |page| {
            page.view(&tables.view::<CheckRow>().without(&["blocked"]));
        });
        if self.spikes.is_some() {
            page.details(2, "Planted spikes", |page| {
                page.view(&tables.view::<SpikeRow>());
            });
        }
        for quantity in CoveredQuantity::ALL {
            let title = format!("Coverage: {}", capitalised(&quantity.name().replace('-', " ")));
            page.details(2, &title, |page| {
                let rows = tables.view::<CoverageRow>().only("quantity", quantity.name());
                page.view(&rows.columns(COVERAGE));
            });
        }
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact, |page| {
            let windows = &self.windows;
            page.paragraph(&format!(
            "Law {}. Self-affine surfaces of standard deviation {}, Hurst exponent {} and cut-off {}, seen in windows of {} x {} points \
             at a distance of {}. Method: [theory](../../docs/theory.md#coverage).",
            escape(&self.law),
            input_quantity(windows.sigma, "m"),
            input_number(windows.hurst),
            input_quantity(windows.cut_off, "m"),
            windows.points,
            windows.points,
            input_quantity(windows.pixel, "m"),
        ));
            page.view(&tables.view::<ProcessRow>().columns(SETUP));
        });
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        fields(&ContactSummary::new(&self.contact))
    }
}

const SETUP: &[&str] =
    &["case", "heights", "roughness", "roll_off_m", "waves_per_block", "correlation_lengths_per_block"];

const COVERAGE: &[&str] = &[
    "case",
    "load_pa",
    "effective_contacts",
    "area_ratio",
    "intervals",
    "coverage",
    "coverage_standard_error",
    "stated_over_scatter",
    "independent_coverage",
];

/// How often claimed intervals hold the truth, and how many decided verdicts are wrong.
fn answer(intervals: Intervals, cases: &[CaseResults]) -> String {
    let (kind, least) = match intervals {
        Intervals::Blocks => ("95 % intervals", "90 %"),
        Intervals::ModelBased => ("Model-based 95 % intervals", "half"),
    };
    let wrong = wrong(cases);
    let coverages = || cases.iter().flat_map(CaseResults::claimed).map(|(_, coverage)| 100.0 * coverage);
    let Some([low, high]) = extremes(coverages()) else {
        return format!(
            "No combination of process, load and quantity has intervals in {least} of the windows. {wrong}"
        );
    };
    let claiming = cases.iter().filter(|case| case.claimed().next().is_some()).count();
    let outside = cases.iter().flat_map(CaseResults::outside).count();
    format!(
        "{kind} cover the truth in {low:.1} to {high:.1} % of the windows ({claiming} of {} processes have them). Outside {}: {outside} of {} \
         combinations of load and quantity with intervals in at least {least} of the windows. {wrong}",
        cases.len(),
        intervals.band_name(),
        coverages().count(),
    )
}

/// How many decided verdicts are wrong, and of those that are very likely and those that depend on no choice.
fn wrong(cases: &[CaseResults]) -> String {
    let share = |count: &VerdictCount| count.wrong_share().map_or_else(|| "none".to_owned(), percent);
    let decided = total(cases, |case| &case.verdicts);
    let others = [
        ("very likely ones", total(cases, |case| &case.likely)),
        ("decided ones that depend on no choice", total(cases, |case| &case.robust)),
    ];
    let others = others.iter().filter(|(_, count)| count.decided > 0);
    let others = others.map(|(name, of)| format!("; of {} {name}, {}", count(of.decided), share(of)));
    format!(
        "Of {} decided verdicts, {} are wrong{}.",
        count(decided.decided),
        share(&decided),
        others.collect::<String>()
    )
}

/// Processes with area ratios beyond the admissible ones.
fn warnings(cases: &[CaseResults]) -> Vec<String> {
    let area =
        |case: &CaseResults| case.coverages().map(|(_, coverage)| coverage.area_ratio).fold(0.0, f64::max);
    let beyond: Vec<f64> = cases.iter().map(area).filter(|area| *area > INTERACTION).collect();
    let most = beyond.iter().copied().fold(0.0, f64::max);
    let warning = || {
        let [limit, most] = [INTERACTION, most].map(percent);
        format!(
            "Mean area ratios of {} of {} processes exceed {limit} (at most {most})",
            beyond.len(),
            cases.len()
        )
    };
    (!beyond.is_empty()).then(warning).into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::super::results::{BAND, LoadCoverage, NEARLY_ALL, RARELY};
    use super::*;
    use crate::coverage::{Coverage, IntervalCount, WINDOWS_PER_MAP};
    use asperity::Heights;
    use asperity::compare::{CONTACTS_PER_GROUP, GROUPS};
    use asperity::study::GENERATED_SURFACES;
    use asperity::topography::{BLOCK_LENGTHS, MIN_BLOCKS};

    /// A case whose only quantity has intervals in `intervals` of 1000 windows, of which `covered` hold the truth.
    fn case(name: &str, intervals: usize, covered: usize, area_ratio: f64) -> CaseResults {
        let coverage = Coverage {
            windows: 1000,
            truth: 0.0,
            scatter: 1.0,
            contacts: 100.0,
            area_ratio,
            claimed: IntervalCount { intervals, covered, error: 1.0 },
            independent: IntervalCount::default(),
        };
        let load = LoadCoverage {
            load: 1e6,
            separation: 2.0,
            coverages: vec![(CoveredQuantity::AreaOfSum, coverage)],
        };
        let (roll_off, correlation, heights) = (1e-5, 1e-6, Heights::GAUSSIAN);
        CaseResults {
            name: name.to_owned(),
            intervals: Intervals::Blocks,
            likely: VerdictCount::default(),
            far_beyond: VerdictCount::default(),
            roll_off,
            roughness: String::new(),
            heights,
            windows: 1000,
            patchy: 0.0,
            correlation,
            loads: vec![load],
            verdicts: VerdictCount::default(),
            studied: VerdictCount::default(),
            robust: VerdictCount::default(),
            blocked: 0,
            checks: Vec::new(),
        }
    }

    #[test]
    fn coverage_outside_the_band_is_counted() {
        let cases =
            [case("good", 1000, 950, 0.01), case("poor", 1000, 920, 0.01), case("wide", 950, 945, 0.2)];
        let lead = answer(Intervals::Blocks, &cases);
        let expected = "95 % intervals cover the truth in 92.0 to 99.5 % of the windows (3 of 3 processes have them). Outside 93 to 97 %: 2 of 3 \
                        combinations of load and quantity with intervals in at least 90 % of the windows. ";
        assert!(lead.starts_with(expected), "{lead}");
        assert!(answer(Intervals::Blocks, &cases[..1]).contains("Outside 93 to 97 %: 0 of "));
    }

    #[test]
    fn area_ratios_beyond_the_admissible_are_counted() {
        let cases = [case("good", 1000, 950, 0.01), case("wide", 950, 945, 0.2)];
        assert_eq!(warnings(&cases[..1]), [""; 0]);
        assert_eq!(warnings(&cases), ["Mean area ratios of 1 of 2 processes exceed 5 % (at most 20 %)"]);
    }

    #[test]
    fn wrong_verdicts_are_stated_with_robustness_where_it_was_examined() {
        let counted = |decided, wrong| VerdictCount { decided, wrong, ..VerdictCount::default() };
        let mut cases = [case("a", 1000, 950, 0.01), case("b", 1000, 950, 0.01)];
        cases.iter_mut().for_each(|case| case.verdicts = counted(200, 10));
        assert_eq!(wrong(&cases), "Of 400 decided verdicts, 5 % are wrong.");
        cases[0].robust = counted(30, 0);
        cases[1].likely = counted(50, 1);
        assert!(wrong(&cases).ends_with(
            "5 % are wrong; of 50 very likely ones, 2 %; of 30 decided ones that depend on no choice, 0 %."
        ));
    }

    #[test]
    fn intervals_in_a_part_of_the_windows_are_kept_apart() {
        let cases = [case("part", 500, 400, 0.01), case("few", 40, 10, 0.01), case("none", 0, 0, 0.01)];
        assert!(answer(Intervals::Blocks, &cases).starts_with("No combination of process"));
        let both = [case("all", 1000, 950, 0.01), case("part", 500, 400, 0.01)];
        assert!(
            answer(Intervals::Blocks, &both)
                .contains("(1 of 2 processes have them). Outside 93 to 97 %: 0 of 1 combinations")
        );
        let in_part = cases.iter().flat_map(CaseResults::claimed_in_part);
        assert!(in_part.map(|(_, coverage)| coverage).eq([0.8]));
    }

    #[test]
    fn the_theory_states_the_constants() {
        let theory = include_str!("../../../../../docs/theory.md");
        let (_, method) = theory.split_once("\n### Coverage\n").unwrap();
        assert_eq!((WINDOWS_PER_MAP, MIN_BLOCKS), (4, 16));
        // In sentences and the meanings of columns.
        assert_eq!((BAND, NEARLY_ALL, RARELY), ([0.93, 0.97], 0.9, 0.05));
        assert!(method.contains("Four windows are cut from each"));
        assert!(theory.contains(&format!("each at least {BLOCK_LENGTHS} correlation")));
        assert!(method.contains(&format!("{} effective contacts", CONTACTS_PER_GROUP * MIN_BLOCKS as f64)));
        assert!(method.contains(&format!("{GROUPS} random groups")));
        assert!(theory.contains(&format!("{GENERATED_SURFACES} surfaces are generated")));
    }
}
