//! Results of both models on one surface under one law: figures and tables.

use asperity::compare::{Comparison, Pair, Scatter, of_each_decade};
use asperity_framework::report::format::{
    count, input_quantity, listed, mean_and_deviation, number, percent, quantity,
};
use asperity_framework::report::page::Page;

use super::axes::Units;
use super::figures::{self, Setting, at_equal_load};
use super::lines;
use super::names::{stem, subject};
use super::single_load::is_single;
use super::verdict::headline;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// Results of both models under one law.
pub fn answers(page: &mut Page, results: &CompareResults, found: &SurfaceResults, index: usize) {
    let case = &found.first.cases[index];
    page.details(2, &format!("{}: curves and tables", subject(results, found, &case.law)), |page| {
        write(page, results, found, index);
    });
}

fn write(page: &mut Page, results: &CompareResults, found: &SurfaceResults, index: usize) {
    let case = &found.first.cases[index];
    let comparison = &case.comparison;
    if let Some(index) = case.plasticity_index {
        page.paragraph(&format!("Plasticity index ψ = (E*/H)(σ/R)^½ = {}.", number(index)));
    }
    // A figure of one point shows less than the tables.
    if !is_single(case) {
        curves(page, results, found, index);
    }
    lines::section(page, results, found, case);
    realisations(page, found, index);
    let pairs = of_each_decade(at_equal_load(comparison), |pair| pair.target, STEPS);
    if !pairs.is_empty() {
        page.paragraph(if found.others.is_empty() {
            "Both models at equal load:"
        } else {
            "Both models at equal load, first realisation:"
        });
        let area = found.surface.set.nominal_area();
        page.table(LOAD_TABLE, pairs.iter().map(|pair| load_row(pair)));
        page.table(CONTACT_TABLE, pairs.iter().map(|pair| contact_row(pair, area)));
        page.paragraph("\\* Beyond the valid range.");
    }
}

/// The figures of the curves over load.
fn curves(page: &mut Page, results: &CompareResults, found: &SurfaceResults, index: usize) {
    let case = &found.first.cases[index];
    let stem = stem(found, &case.law);
    let name = subject(results, found, &case.law);
    let others: Vec<&Comparison> =
        found.others.iter().map(|answered| &answered.cases[index].comparison).collect();
    let verdicts = &found.findings.cases[index].verdicts;
    let finding = if verdicts.differences.is_empty() {
        String::new()
    } else {
        headline(verdicts, found.surface.plane.sigma)
    };
    let units = Units::of(results, found);
    let setting = Setting { name: &name, case, valid: &verdicts.valid, units, finding: &finding };
    let [beside_separation, beside_area] = lines::layers(results, found, case);
    let file = |figure: &str| format!("{stem}-{figure}.svg");
    page.figure(
        &file("separation"),
        figures::separation(&setting, &others, beside_separation),
        "Separation against load. Bands: 95 % sampling uncertainty at fixed separation for independent asperities. Shaded: \
         beyond the valid range.",
    );
    page.figure(
        &file("area"),
        figures::area(&setting, beside_area),
        "Real contact area against load. Bands and shading as above.",
    );
    if case.comparison.curves.is_empty() {
        return;
    }
    match figures::regimes(&setting) {
        Some(figure) => {
            page.figure(
                &file("regimes"),
                figure,
                "Share of the load carried by elastic, elastic-plastic and plastic contacts, by model, at loads carried by at least 30 \
                 effective contacts; vertical lines: ends of the valid range.",
            );
        }
        None => {
            page.paragraph(
                "At all loads that at least 30 effective contacts carry, contacts of one regime carry more than 99.8 % of the load in both models.",
            );
        }
    }
}

/// Scatter over several realisations, and the sampling error estimated from a single sum.
fn realisations(page: &mut Page, found: &SurfaceResults, index: usize) {
    let spread = &found.findings.cases[index].spread;
    if spread.is_empty() {
        return;
    }
    let generation = found.surface.map.as_ref().and_then(|map| map.generation.as_ref());
    let is_targeted = generation.is_some_and(|made| made.target.is_some());
    page.paragraph(&format!(
        "Both models at equal load over {} realisations: mean ± standard deviation of one realisation, and the sampling \
         error estimated from a single sum for independent asperities.{}",
        found.count(),
        if is_targeted {
            " All realisations are scaled to the same radius, σ and density, which removes part of the scatter."
        } else {
            ""
        }
    ));
    let differences = &found.findings.cases[index].verdicts.differences;
    let is_valid =
        |load: f64| differences.iter().find(|at| at.load == load).is_none_or(|at| at.exceeded().is_none());
    let with_scatter = |scatter: &Scatter| mean_and_deviation(scatter.mean, scatter.deviation);
    page.table(
        ["p", "d/σ stat.", "d/σ det.", "estimated error", "difference", "A/A_nom stat.", "A/A_nom det."],
        of_each_decade(spread, |at| at.target, STEPS).into_iter().map(|at| {
            vec![
                marked(at.target, is_valid(at.target)),
                number(at.statistical_separation.mean),
                with_scatter(&at.deterministic_separation),
                number(at.sampling_error),
                with_scatter(&at.difference),
                number(at.statistical_area.mean),
                with_scatter(&at.deterministic_area),
            ]
        }),
    );
}

/// A load (Pa), with a mark beyond the valid range.
fn marked(load: f64, is_valid: bool) -> String {
    format!("{}{}", input_quantity(load, "Pa"), if is_valid { "" } else { " *" })
}

/// Rows per decade of load: the loads nearest to one and three.
const STEPS: f64 = 2.0;

const LOAD_TABLE: [&str; 8] =
    ["p", "d/σ stat.", "d/σ det.", "difference", "A/A_nom stat.", "A/A_nom det.", "± s.e.", "not valid"];

fn load_row(pair: &Pair) -> Vec<String> {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    vec![
        marked(pair.target, pair.is_valid()),
        number(s.separation_over_sigma),
        number(d.separation_over_sigma),
        number(s.separation_over_sigma - d.separation_over_sigma),
        number(s.area_ratio.total()),
        number(d.area_ratio.total()),
        d.sampling.map_or_else(|| "-".to_owned(), |error| number(error.area_ratio)),
        remark(pair),
    ]
}

/// The limits that a pair exceeds.
fn remark(pair: &Pair) -> String {
    listed(&pair.exceeded().limits().map(|limit| limit.name().replace('-', " ")).collect::<Vec<_>>())
}

const CONTACT_TABLE: [&str; 9] = [
    "p",
    "contacts stat.",
    "contacts det.",
    "effective",
    "largest load share",
    "mean contact p stat.",
    "mean contact p det.",
    "−dp/dd stat. [Pa/m]",
    "−dp/dd det. [Pa/m]",
];

fn contact_row(pair: &Pair, area: f64) -> Vec<String> {
    let (s, d) = (&pair.statistical, &pair.deterministic);
    let contact_pressure =
        |pressure: Option<f64>| pressure.map_or_else(|| "-".to_owned(), |p| quantity(p, "Pa"));
    vec![
        marked(pair.target, pair.is_valid()),
        number(s.contact_density * area),
        count((d.contact_density * area).round() as usize),
        d.sharing.map_or_else(|| "–".to_owned(), |sharing| number(sharing.effective_contacts)),
        d.sharing.map_or_else(|| "–".to_owned(), |sharing| percent(sharing.largest_share)),
        contact_pressure(s.mean_real_pressure()),
        contact_pressure(d.mean_real_pressure()),
        number(s.stiffness),
        number(d.stiffness),
    ]
}
