//! The page of several laws: how they differ on a single asperity, and whether the contact law or the summation method
//! matters more on surfaces.

mod figures;
mod influence;
mod measures;
mod summary;

use crate::kind::compare::outline;
use crate::kind::laws::results::{LawOnOne, LawsResults};
use asperity::ContactLaw;
use asperity::contact_law::registry;
use asperity::sphere::{Boundary, LARGEST_SLOPE};
use asperity_framework::report::format::{input_number, input_quantity, listed, number, percent, quantity};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;
use asperity_framework::report::table::Tables;

pub fn page(results: &LawsResults, tables: &Tables) -> Page {
    let compared = &results.compare;
    let mut page = Page::new(&compared.metadata.title);
    summary::verdict(results).iter().for_each(|line| {
        page.lead(line);
    });
    page.table(summary::HEADER, summary::rows(results));
    sections::warnings(&mut page, &compared.warnings());
    outline::verdicts(&mut page, tables);
    for found in &compared.surfaces {
        influence::section(&mut page, results, found);
    }
    one_asperity(&mut page, results);
    laws(&mut page, results);
    for found in &compared.surfaces {
        crate::surface::section::section(&mut page, &found.surface, Some(&found.realisations[0].population));
        outline::inputs(&mut page, found);
    }
    sections::notes(&mut page, &compared.metadata);
    sections::what_was_run(&mut page, &compared.metadata, &compared.contact);
    outline::limits_note(&mut page);
    page.paragraph(
        "Agreement between laws does not validate them: this report shows how much the choice matters, not which law is best. The \
         finite-element fits were made for a sphere on a rigid flat.",
    );
    sections::run_again(&mut page, &compared.metadata, None);
    sections::sources(&mut page, &compared.metadata);
    page
}

/// Jumps of the laws, and the limit of small strains.
fn single_asperity_lines(results: &LawsResults) -> Vec<String> {
    let unit = results.critical.indentation;
    let jumps = |law: &LawOnOne, of: fn(&Boundary) -> f64| {
        let at = |at: &Boundary| format!("{} at {}", signed_percent(of(at)), number(at.indentation / unit));
        let large = law.boundaries.iter().filter(|at| of(at) != 0.0);
        let each: Vec<String> = large.map(at).collect();
        (!each.is_empty()).then(|| format!("{} {}", escape(&law.law), listed(&each)))
    };
    let all = |of: fn(&Boundary) -> f64| {
        let each: Vec<String> = results.laws.iter().filter_map(|law| jumps(law, of)).collect();
        if each.is_empty() { "none".to_owned() } else { each.join("; ") }
    };
    let mut lines = vec![
        format!("**Jumps of the load** per asperity, at w/wc: {}.", all(Boundary::load_jump)),
        format!("**Jumps of the area**: {}.", all(Boundary::area_jump)),
    ];
    if let Some(end) = &results.end_of_small_strains {
        lines.push(format!(
            "Strains are **small** up to about w/wc = {}, where the contact radius exceeds {LARGEST_SLOPE} of the asperity \
             radius under one of the laws ({}); at {} the indentation equals the radius. Beyond, the curves extrapolate \
             the laws and are not valid for contacts.",
            number(end.indentation / unit),
            escape(&end.law),
            number(results.radius / unit),
        ));
    }
    lines
}

/// The laws, their ranges of validity and sources.
fn laws(page: &mut Page, results: &LawsResults) {
    page.table(
        ["law", "description and range of validity", "source"],
        results.laws.iter().map(|law| {
            let papers: Vec<&str> = law.papers.iter().map(|paper| paper.short).collect();
            vec![law.law.clone(), law.about.to_owned(), papers.join("; ")]
        }),
    );
    let first = &results.laws[0].law;
    let of_one_regime = registry().iter().filter(|law| !law.has_ranges() && !law.is_elliptic());
    page.paragraph(&format!(
        "Reference law: {}, the first in the list. Laws of a single regime ({}) are limiting cases and are not counted \
         among the elastic-plastic laws. Equations and their numbers: docs/theory.md.",
        escape(first),
        of_one_regime.map(ContactLaw::name).collect::<Vec<String>>().join(", ")
    ));
}

/// The laws on a single asperity.
fn one_asperity(page: &mut Page, results: &LawsResults) {
    let critical = &results.critical;
    page.heading(2, "Single asperity");
    let ellipse = if results.curvature_ratio > 1.0 {
        format!(
            " Elliptic laws use the same mean curvature and a ratio of principal curvatures of {}.",
            input_number(results.curvature_ratio)
        )
    } else {
        String::new()
    };
    page.paragraph(&format!(
        "Radius R = {}. Indentations are normalised by the onset of yield of a sphere after Zhao, Maietta and Chang: wc = (0.3 π)² R (H/E*)² = {}; Pc = {} and Ac = {} are Hertz's load and area there. Laws \
         with another onset of yield start to yield at another w/wc.{ellipse}",
        input_quantity(results.radius, "m"),
        quantity(critical.indentation, "m"),
        quantity(critical.load, "N"),
        quantity(critical.area, "m²"),
    ));
    page.bullets(single_asperity_lines(results));
    page.figure(
        "asperity-curves.svg",
        figures::curves(results),
        "Load and real contact area of one asperity under every law. Circles mark both sides of each boundary between two \
         formulas.",
    );
    if let Some(hardness) = results.compare.contact.hardness {
        page.figure(
            "asperity-differences.svg",
            figures::differences(results, hardness),
            "Differences between the laws: mean contact pressure over hardness, and area over that of an elastic contact.",
        );
    }
    if let Some(svg) = figures::jumps(results) {
        let caption =
            "Jumps of the laws: load and area over those of an elastic contact at equal indentation.";
        page.figure("asperity-jumps.svg", svg, caption);
    }
    let unit = critical.indentation;
    let rows = results.laws.iter().flat_map(|law| {
        law.boundaries.iter().map(move |at| {
            vec![
                law.law.clone(),
                number(at.indentation / unit),
                quantity(at.indentation, "m"),
                at.below.regime.name().to_owned(),
                at.above.regime.name().to_owned(),
                signed_percent(at.load_jump()),
                signed_percent(at.area_jump()),
                strains(results, at).to_owned(),
            ]
        })
    });
    page.paragraph("All boundaries between two formulas, including those within a regime:");
    page.table(
        ["law", "w/wc", "w", "below", "above", "jump of the load", "jump of the area", "strains"],
        rows,
    );
}

/// Whether a boundary lies where strains are small.
fn strains(results: &LawsResults, at: &Boundary) -> &'static str {
    if at.indentation > results.radius {
        "w > R"
    } else if results.is_beyond_small_strains(&at.above) {
        "not small"
    } else {
        "small"
    }
}

/// "+50 %", or "none".
fn signed_percent(jump: f64) -> String {
    if jump == 0.0 {
        return "none".to_owned();
    }
    let sign = if jump > 0.0 { "+" } else { "" };
    format!("{sign}{}", percent(jump))
}
