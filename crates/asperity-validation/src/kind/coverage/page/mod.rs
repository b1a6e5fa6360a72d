//! The page of `[coverage]`: how often claimed intervals hold the truth.

mod figures;

use super::findings::{BAND, Combination, LoadCoverage, NEARLY_ALL, range};
use super::run::{CaseCoverage, CoverageResults};
use crate::coverage::{Counted, Coverage, Quantity, WINDOWS_PER_MAP};
use asperity::compare::{CONTACTS_PER_GROUP, GROUPS};
use asperity::topography::{BLOCK_LENGTHS, MIN_BLOCKS};
use asperity_framework::report::format::{
    count, input_number, input_quantity, listed, number, percent, quantity, ratio,
};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;

pub fn page(results: &CoverageResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::findings(&mut page, summary_lines(results));
    page.figure("coverage.svg", figures::coverage(results), figures::CAPTION);
    sections::warnings(&mut page, &results.warnings());
    sections::notes(&mut page, &results.metadata);
    coverages(&mut page, results);
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    processes(&mut page, results);
    page.heading(2, "Method");
    page.bullets(method(results));
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

/// "93.4 to 96.1 %"
fn percent_range([low, high]: [f64; 2]) -> String {
    format!("{:.1} to {:.1} %", 100.0 * low, 100.0 * high)
}

fn band() -> String {
    format!("{} to {}", number(100.0 * BAND[0]), percent(BAND[1]))
}

fn summary_lines(results: &CoverageResults) -> Vec<String> {
    let findings = &results.findings;
    let mut lines = Vec::new();
    match findings.range() {
        Some(range) => {
            let outside: Vec<String> = findings.outside().map(named).collect();
            let verdict = if outside.is_empty() {
                format!("all are within {}", band())
            } else {
                format!("outside {}: {}", band(), listed(&outside))
            };
            lines.push(format!(
                "**95 % intervals cover the truth in {} of the windows** where nearly all have one, over {} combinations of case, load and \
                 quantity (standard error of a coverage: at most {}); {verdict}.",
                percent_range(range),
                findings.quantity.len(),
                percent(findings.largest_error()),
            ));
        }
        None => lines
            .push(format!("**No interval is claimed** in {} of the windows or more.", percent(NEARLY_ALL))),
    }
    let shares = range(findings.partial.iter().map(|one| one.coverage.claimed_share()));
    let partial = shares.zip(range(findings.partial.iter().map(|one| one.share)));
    lines.extend(partial.map(|(shares, range)| {
        format!(
            "**Where only {} of the windows have an interval**, because the others have too few contacts or too long waves, it \
             covers the truth in {} of them. Windows with more contacts than most at one load have smaller stated errors, and \
             results on one side of the mean.",
            percent_range(shares),
            percent_range(range)
        )
    }));
    lines.extend(findings.unclaimed.iter().map(|one| {
        let windows = if one.share > 0.0 {
            format!("in {} of the windows at most", percent(one.share))
        } else {
            "in no window".to_owned()
        };
        format!("**{}**: an interval is claimed {windows}.", escape(&one.case))
    }));
    lines.extend(findings.independent.map(|range| {
        format!(
            "**Asperities taken as independent** would give intervals that cover the truth in {} of the windows: neighbouring \
             asperities are on the same waves.",
            percent_range(range)
        )
    }));
    lines
}

fn named(one: &Combination) -> String {
    format!(
        "{}, {} at {} contacts ({:.1} ± {:.1} %)",
        escape(&one.case),
        quantity_name(one.quantity),
        number(one.coverage.contacts),
        100.0 * one.share,
        100.0 * one.error
    )
}

fn quantity_name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::AreaOfSum => "area of the sum",
        Quantity::LoadAtSeparation => "load at equal separation",
        Quantity::Difference(quantity) => quantity.name(),
    }
}

fn coverages(page: &mut Page, results: &CoverageResults) {
    page.heading(2, "Coverage");
    page.paragraph(
        "Share of the claimed 95 % intervals that hold the truth (%), by quantity. \"Claimed\" is the share of the windows in \
         which an interval is claimed at the load; `coverage.csv` has all counts.",
    );
    let shares = |counted: &Counted| counted.coverage().map(|share| format!("{:.1}", 100.0 * share));
    table(page, results, |coverage| shares(&coverage.claimed));
    page.paragraph("Mean stated standard error over the scatter of the windows:");
    table(page, results, |coverage| coverage.error_over_scatter(&coverage.claimed).map(ratio));
    page.paragraph("Coverage (%) of intervals that take asperities as independent:");
    table(page, results, |coverage| shares(&coverage.independent));
}

/// Cases and loads by quantities.
fn table(page: &mut Page, results: &CoverageResults, of: impl Fn(&Coverage) -> Option<String>) {
    let mut header = vec!["case", "load", "contacts", "A/A_nom", "claimed"];
    header.extend(Quantity::ALL.map(quantity_name));
    let none = || "–".to_owned();
    let row = |(case, load): (&CaseCoverage, &LoadCoverage)| {
        let at_load = |cell: &dyn Fn(&Coverage) -> String| load.coverages[0].as_ref().map_or_else(none, cell);
        let mut row = vec![
            case.name.clone(),
            quantity(load.load, "Pa"),
            at_load(&|coverage| number(coverage.contacts)),
            at_load(&|coverage| percent(coverage.area_ratio)),
            at_load(&|coverage| percent(coverage.claimed_share())),
        ];
        let cell = |coverage: &Option<Coverage>| coverage.as_ref().and_then(&of).unwrap_or_else(none);
        row.extend(load.coverages.iter().map(cell));
        row
    };
    let rows = results.cases.iter().flat_map(|case| case.loads.iter().map(move |load| (case, load)));
    page.table(header, rows.map(row));
}

fn processes(page: &mut Page, results: &CoverageResults) {
    let windows = &results.windows;
    page.paragraph(&format!(
        "Law {}. Self-affine surfaces of standard deviation {}, Hurst exponent {} and cut-off {}, seen in windows of {} x {} \
         points at a distance of {}.",
        escape(&results.law),
        input_quantity(windows.sigma, "m"),
        input_number(windows.hurst),
        input_quantity(windows.cut_off, "m"),
        windows.points,
        windows.points,
        input_quantity(windows.pixel, "m"),
    ));
    let blocks_along_side = (MIN_BLOCKS as f64).sqrt();
    page.table(
        ["case", "heights", "roll-off", "longest waves per block", "correlation lengths per block"],
        results.cases.iter().map(|case| {
            let block = windows.side() / blocks_along_side;
            vec![
                case.name.clone(),
                case.heights.to_string(),
                input_quantity(case.roll_off, "m"),
                number(block / case.roll_off),
                number(block / case.correlation),
            ]
        }),
    );
    page.paragraph(&format!(
        "Blocks are sixteenths of a window; correlation lengths are medians over the windows. An interval needs blocks of {} \
         correlation lengths and {} effective contacts.",
        number(BLOCK_LENGTHS),
        number(CONTACTS_PER_GROUP * MIN_BLOCKS as f64)
    ));
}

fn method(results: &CoverageResults) -> Vec<String> {
    let windows = &results.windows;
    vec![
        format!(
            "{} windows of each case, {WINDOWS_PER_MAP} from each of {} periodic maps of twice the side; each is levelled by a \
             plane and has open boundaries, as a measured map. Heights that are not Gaussian are those of a transformed Gaussian \
             field of the given spectrum.",
            count(windows.count()),
            count(windows.maps)
        ),
        "Asperities are five-point summits. The statistical model takes arithmetic mean radius, standard deviation and density of \
         the summits from each window, and Gaussian heights."
            .to_owned(),
        "Loads are those at which the windows of a pilot map, used for nothing else, have the given numbers of effective contacts \
         in the mean; the fixed separation is that of the pilot map at this load."
            .to_owned(),
        "Separation, area and stiffness: statistical against deterministic result at equal load (difference in σ, logarithm of \
         the ratio), with the intervals that `[compare]` claims. The area of the sum at the load and the ratio of the loads at the \
         fixed separation have intervals from the same blocks under the same conditions."
            .to_owned(),
        "The truth is the mean over all windows of a case, whether or not they have an interval. Shares of windows have binomial \
         standard errors."
            .to_owned(),
        format!(
            "Intervals that take asperities as independent come from {GROUPS} random groups of them, on one window of each map."
        ),
    ]
}
