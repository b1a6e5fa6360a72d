//! The page of `[coverage]`: how often claimed intervals hold the truth, by process and by quantity.

use asperity::INTERACTION;
use asperity::numeric::extremes;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{
    capitalised, count, input_number, input_quantity, number, percent,
};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use serde_json::{Map, Value};

use super::figures::{caption, coverage, wrong_verdicts, wrong_verdicts_caption};
use super::results::{CaseResults, CoverageResults};
use super::rows::{CheckRow, CoverageRow, ProcessRow, SpikeRow, VerdictRow, tables};
use super::spec::Intervals;
use crate::coverage::{Coverage, CoveredQuantity, VerdictCount};

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
        sections::notes(&mut page, &self.metadata);
        page.heading(2, "Wrong verdicts");
        page.paragraph(&wrong(&self.total(|case| &case.verdicts), &self.total(|case| &case.robust)));
        if self.intervals == Intervals::ModelBased {
            page.paragraph(&likely(self));
        }
        page.paragraph(&worst(&self.cases));
        // Points that all lie at zero show nothing that the sentence does not say.
        if self.cases.iter().any(|case| case.verdicts.wrong + case.robust.wrong > 0) {
            page.figure("wrong-verdicts.svg", wrong_verdicts(self), &wrong_verdicts_caption(self));
        }
        page.view(&tables.view::<VerdictRow>());
        page.heading(2, "Fitness checks of windows without faults");
        page.view(&tables.view::<CheckRow>().without(&["blocked"]));
        if self.spikes.is_some() {
            page.heading(2, "Planted spikes");
            page.view(&tables.view::<SpikeRow>());
        }
        for quantity in CoveredQuantity::ALL {
            let title = format!("Coverage: {}", capitalised(&quantity.name().replace('-', " ")));
            page.details(2, &title, |page| {
                let rows = tables.view::<CoverageRow>().only("quantity", quantity.name());
                page.view(&rows.columns(COVERAGE));
            });
        }
        sections::what_was_run(&mut page, &self.metadata, &self.contact);
        let windows = &self.windows;
        page.paragraph(&format!(
            "Law {}. Self-affine surfaces of standard deviation {}, Hurst exponent {} and cut-off {}, seen in windows of {} x {} points \
             at a distance of {}.",
            escape(&self.law),
            input_quantity(windows.sigma, "m"),
            input_number(windows.hurst),
            input_quantity(windows.cut_off, "m"),
            windows.points,
            windows.points,
            input_quantity(windows.pixel, "m"),
        ));
        page.view(&tables.view::<ProcessRow>().columns(SETUP));
        page.heading(2, "Method").note(include_str!("notes/method.md"));
        if self.intervals == Intervals::ModelBased {
            page.note(include_str!("notes/model_based.md"));
        }
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

/// How many decided verdicts are wrong, `alone` and where they are robust.
fn wrong(alone: &VerdictCount, robust: &VerdictCount) -> String {
    let share = |of: Option<f64>| of.map_or("none".to_owned(), percent);
    let first = format!(
        "Of {} decided verdicts {} are wrong; of the {} windows that decide anything {} have a wrong one.",
        count(alone.decided),
        share(alone.wrong_share()),
        count(alone.deciding_windows),
        share(alone.wrong_window_share()),
    );
    if robust.windows == 0 {
        return first;
    }
    format!(
        "{first} Where verdicts count only if they depend on no choice in the analysis, {} of {} are wrong, in {} of {} windows (upper 95 % \
         limit {}).",
        share(robust.wrong_share()),
        count(robust.decided),
        share(robust.wrong_window_share()),
        count(robust.deciding_windows),
        share(robust.wrong_window_limit()),
    )
}

/// The processes with the largest shares of wrong verdicts, by themselves.
fn worst(cases: &[CaseResults]) -> String {
    let largest = |share: fn(&VerdictCount) -> Option<f64>| {
        let shares = cases.iter().filter_map(|case| Some((share(&case.verdicts)?, case)));
        shares.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    match (largest(VerdictCount::wrong_share), largest(VerdictCount::wrong_window_share)) {
        (Some((verdicts, of_verdicts)), Some((windows, of_windows))) if verdicts > 0.0 => format!(
            "Most are wrong: of verdicts {} ({}), of windows {} ({}).",
            percent(verdicts),
            escape(&of_verdicts.name),
            percent(windows),
            escape(&of_windows.name),
        ),
        _ => String::new(),
    }
}

/// How many of the verdicts that are very likely are wrong, of all and of the process with the largest share.
fn likely(results: &CoverageResults) -> String {
    let said = |name: &str, of: fn(&CaseResults) -> &VerdictCount| {
        let all = results.total(of);
        let share = all.wrong_share().map_or("none".to_owned(), percent);
        let worst = results.cases.iter().filter(|case| of(case).wrong > 0).max_by(|a, b| {
            let share = |case: &CaseResults| of(case).wrong_share().unwrap_or(0.0);
            share(a).total_cmp(&share(b))
        });
        let worst = worst.map_or_else(String::new, |case| {
            format!(" (most on {}: {} of {})", escape(&case.name), of(case).wrong, of(case).decided)
        });
        format!("{name}: {share} of {} are wrong{worst}", count(all.decided))
    };
    let by_interval = said("Very likely by a model-based interval", |case| &case.likely);
    let by_halves = said("without interval, by all halves of a window", |case| &case.far_beyond);
    format!("{by_interval}; {by_halves}.")
}

/// How often claimed intervals hold the truth, where at least 90 % of the windows have one.
fn answer(intervals: Intervals, cases: &[CaseResults]) -> String {
    let (kind, least) = match intervals {
        Intervals::Blocks => ("95 % intervals", "90 %"),
        Intervals::ModelBased => ("Model-based 95 % intervals", "half"),
    };
    let band = intervals.band_name();
    let claimed = || cases.iter().flat_map(CaseResults::claimed);
    let Some([low, high]) = extremes(claimed().map(|(_, coverage)| coverage)) else {
        return format!(
            "**No combination of process, load and quantity has intervals in {least} of the windows.**"
        );
    };
    let verdict = match cases.iter().flat_map(CaseResults::outside).count() {
        0 => format!("all are within {band}"),
        outside => format!("{outside} are outside {band}"),
    };
    let in_part = || cases.iter().flat_map(CaseResults::claimed_in_part).map(|(_, coverage)| coverage);
    let part = extremes(in_part()).map_or_else(String::new, |[low, high]| {
        format!(
            " Where fewer windows have one ({} combinations): {:.1} to {:.1} %.",
            in_part().count(),
            100.0 * low,
            100.0 * high
        )
    });
    let errors = claimed().filter_map(|((_, coverage), _)| coverage.claimed.coverage_error());
    format!(
        "**{kind} cover the truth in {:.1} to {:.1} % of the windows**: {verdict}. Counted: {} combinations of process, load and \
         quantity with intervals in at least {least} of the windows (standard error at most {}).{part}",
        100.0 * low,
        100.0 * high,
        claimed().count(),
        percent(errors.fold(0.0, f64::max)),
    )
}

/// Coverages outside the band, then cases without admissible loads.
fn warnings(cases: &[CaseResults]) -> Vec<String> {
    let outside = cases.iter().flat_map(|case| {
        case.outside().map(|((quantity, Coverage { contacts, claimed, .. }), coverage)| {
            format!(
                "{}, {} at {} effective contacts: {} of {} intervals hold the truth (standard error {})",
                case.name,
                quantity.name(),
                number(*contacts),
                percent(coverage),
                count(claimed.intervals),
                percent(claimed.coverage_error().unwrap_or(0.0)),
            )
        })
    });
    let beyond = cases.iter().filter_map(|case| {
        let area = case.coverages().map(|(_, coverage)| coverage.area_ratio).fold(0.0, f64::max);
        (area > INTERACTION).then(|| {
            let [area, limit] = [area, INTERACTION].map(percent);
            format!("{}: a mean area ratio of {area} is beyond {limit}", case.name)
        })
    });
    outside.chain(beyond).collect()
}

#[cfg(test)]
mod tests {
    use super::super::results::{BAND, LoadCoverage, NEARLY_ALL, RARELY};
    use super::*;
    use crate::coverage::{IntervalCount, WINDOWS_PER_MAP};
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
    fn coverage_outside_the_band_is_named() {
        let cases =
            [case("good", 1000, 950, 0.01), case("poor", 1000, 920, 0.01), case("wide", 950, 945, 0.2)];
        let lead = answer(Intervals::Blocks, &cases);
        assert!(
            lead.contains(
                "92.0 to 99.5 % of the windows**: 2 are outside 93 to 97 %. Counted: 3 combinations"
            ),
            "{lead}"
        );
        assert!(
            answer(Intervals::Blocks, &cases[..1]).contains("**: all are within 93 to 97 %. Counted: 1 ")
        );
        assert_eq!(warnings(&cases[..1]), [""; 0]);
        let warnings = warnings(&cases);
        assert_eq!(warnings.len(), 3);
        assert!(
            warnings[0].starts_with("poor, area-of-sum at 100 effective contacts: 92 % of 1,000 intervals")
        );
        assert_eq!(warnings[2], "wide: a mean area ratio of 20 % is beyond 5 %");
    }

    #[test]
    fn wrong_verdicts_are_stated_with_robustness_where_it_was_examined() {
        let alone = VerdictCount {
            windows: 100,
            deciding_windows: 80,
            wrong_windows: 8,
            verdicts: 900,
            decided: 400,
            wrong: 20,
        };
        let said = wrong(&alone, &VerdictCount::default());
        assert!(said.ends_with(
            "Of 400 decided verdicts 5 % are wrong; of the 80 windows that decide anything 10 % have a wrong one."
        ));
        let robust = VerdictCount {
            windows: 10,
            deciding_windows: 9,
            verdicts: 90,
            decided: 30,
            ..VerdictCount::default()
        };
        assert!(
            wrong(&alone, &robust)
                .ends_with("0 % of 30 are wrong, in 0 % of 9 windows (upper 95 % limit 28.3 %)."),
            "{said}"
        );
    }

    #[test]
    fn intervals_in_a_part_of_the_windows_are_kept_apart() {
        let cases = [case("part", 500, 400, 0.01), case("few", 40, 10, 0.01), case("none", 0, 0, 0.01)];
        assert!(answer(Intervals::Blocks, &cases).starts_with("**No combination of process"));
        let both = [case("all", 1000, 950, 0.01), case("part", 500, 400, 0.01)];
        assert!(
            answer(Intervals::Blocks, &both)
                .ends_with("Where fewer windows have one (1 combinations): 80.0 to 80.0 %.")
        );
        let in_part = cases.iter().flat_map(CaseResults::claimed_in_part);
        assert!(in_part.map(|(_, coverage)| coverage).eq([0.8]));
    }

    #[test]
    fn the_method_states_the_constants() {
        let method = include_str!("notes/method.md");
        assert_eq!((WINDOWS_PER_MAP, MIN_BLOCKS), (4, 16));
        // In sentences and the meanings of columns.
        assert_eq!((BAND, NEARLY_ALL, RARELY), ([0.93, 0.97], 0.9, 0.05));
        assert!(method.contains(&format!("of {BLOCK_LENGTHS} correlation lengths")));
        assert!(
            method.contains(&format!("and {} effective contacts", CONTACTS_PER_GROUP * MIN_BLOCKS as f64))
        );
        assert!(method.contains(&format!("{GROUPS} random groups")));
        assert!(
            include_str!("notes/model_based.md").contains(&format!("{GENERATED_SURFACES} surfaces with"))
        );
    }
}
