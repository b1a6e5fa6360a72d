//! The page of `[stability]`: rounding errors of `f64`.

mod figures;

use crate::kind::stability::findings::KindFindings;
use crate::kind::stability::run::StabilityResults;
use crate::stability::{GroupFindings, Kind, Quantity, Worst, uncovered_heights};
use asperity_framework::report::format::{capitalised, count};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;

/// An error to two digits: more would differ between machines.
fn error(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.0e}") }
}

pub fn page(results: &StabilityResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::findings(&mut page, summary_lines(results));
    sections::warnings(&mut page, &results.warnings());
    error_maps(&mut page, results);
    sections::notes(&mut page, &results.metadata);
    page.paragraph(
        "All results of the models are compared with values of about 32 digits from an independent evaluation of the \
         equations: other formulas, no tables, double-double arithmetic, the tanh-sinh rule for integrals, slopes by \
         differences. Half an ulp is at most 1.1e-16.",
    );
    groups(&mut page, results);
    page.heading(2, "Method");
    page.bullets(METHOD);
    let uncovered = uncovered_heights();
    if !uncovered.is_empty() {
        page.paragraph(&format!(
            "Not covered, because there is no evaluation in 32 digits: integrals over the heights {}. Tests compare them \
             with dense quadrature, within 1e-12.",
            uncovered.join(", ")
        ));
    }
    page.heading(2, "Worst cases");
    page.paragraph("For each kind, the case closest to its bound. `stability.csv` has the worst case of every quantity of \
    every group, and the medians.");
    for KindFindings { kind, worst, group, .. } in &results.kinds {
        page.paragraph(&format!(
            "**{}**: {} of {}, case {} of \"{}\".",
            kind.name(),
            worst.quantity.name(),
            error(worst.checked),
            worst.case.index,
            group.name(),
        ));
        page.code("", &worst.case.inputs());
    }
    page.paragraph(&sections::provenance(&results.metadata));
    sections::run_again(&mut page, &results.metadata, None);
    sections::sources(&mut page, &results.metadata);
    page
}

fn error_maps(page: &mut Page, results: &StabilityResults) {
    page.heading(2, "Error maps");
    for map in &results.maps {
        page.figure(&format!("{}-errors.svg", map.name), figures::map(map), figures::caption(map));
    }
}

const METHOD: [&str; 6] = [
    "An indentation, and d/σ of an integral, are used without prior rounding.",
    "For a sum, the separation d = mean + h σ is rounded once, which changes w = z − d, (1 + mean/σ) times as much where \
     heights lie far from zero. A result is therefore correct if it lies between the exact results for d minus and plus \
     one rounding; \"plain\" errors are relative to the exact result for the unrounded d.",
    "Within the rounding of a boundary (16 ulp uncoated, 1e-13 under a layer) the results of both sides are accepted, \
     because the law may jump there.",
    "Where c − 1 is small, the area of ZMC doubles within so narrow a range that the rounding of w₁ alone changes it by \
     1/(c − 1) roundings (see the map). \
     The bounds increase by c/(c − 1), and cases have c from 1.01 on.",
    "Sampling errors are checked as variances over the mean square, because the variance of equal asperities is a \
     difference of equal numbers.",
    "Stiffnesses under a layer and under Jackson and Green are slopes of tables: their bound is 1e-11.",
];

fn summary_lines(results: &StabilityResults) -> Vec<String> {
    let beyond = results.beyond().count();
    let mut lines = vec![format!(
        "**{} cases** in {} groups: {}; {}.",
        count(results.cases() as usize),
        results.groups.len(),
        if beyond == 0 {
            "all within their bounds".to_owned()
        } else {
            format!("{beyond} of them beyond their bounds")
        },
        match (results.not_finite(), results.failures()) {
            (0, 0) => "no NaN, no infinity, no failure, and all cases checked".to_owned(),
            (infinite, failures) =>
                format!("{infinite} with a NaN or an infinity, {failures} failed or unchecked"),
        },
    )];
    lines.extend(results.kinds.iter().map(|found| {
        let KindFindings { kind, largest_error, worst, group } = found;
        format!(
            "**{}**: relative errors of at most {}; closest to its bound of {}: {} in \"{}\", {}.",
            kind.name(),
            error(*largest_error),
            error(worst.bound(*group)),
            worst.quantity.name(),
            group.name(),
            error(worst.checked),
        )
    }));
    if !results.not_covered.is_empty() {
        lines.push(format!(
            "**Not covered**: {}. Equations in extended precision are missing for these laws.",
            escape(&results.not_covered.join(", "))
        ));
    }
    lines
}

/// Two tables per kind: the groups, and their worst errors.
fn groups(page: &mut Page, results: &StabilityResults) {
    for kind in Kind::ALL {
        page.heading(2, &capitalised(kind.name()));
        let of_kind: Vec<&GroupFindings> =
            results.groups.iter().filter(|findings| findings.group.kind() == kind).collect();
        page.table(
            ["group", "description", "cases", "failures"],
            of_kind.iter().map(|findings| {
                vec![
                    findings.group.name().to_owned(),
                    findings.group.about().to_owned(),
                    count(findings.cases as usize),
                    match findings.failures.len() {
                        0 => "none".to_owned(),
                        several => count(several),
                    },
                ]
            }),
        );
        page.paragraph("The worst errors:");
        errors(page, &of_kind, true, |worst| worst.checked);
        if kind == Kind::Sum {
            page.paragraph("Plain errors, including the rounding of the separation:");
            errors(page, &of_kind, false, |worst| worst.error);
        }
    }
}

/// Groups by quantities.
fn errors(page: &mut Page, groups: &[&GroupFindings], bounded: bool, of: impl Fn(&Worst) -> f64) {
    let is_there = |quantity: &Quantity| {
        groups.iter().any(|findings| findings.quantities.iter().any(|worst| worst.quantity == *quantity))
    };
    let quantities: Vec<Quantity> = Quantity::ALL.into_iter().filter(is_there).collect();
    let mut header = vec!["group"];
    header.extend(bounded.then_some("bound"));
    header.extend(quantities.iter().map(|quantity| quantity.name()));
    let row = |findings: &&GroupFindings| {
        let mut row = vec![findings.group.name().to_owned()];
        row.extend(bounded.then(|| error(findings.group.bound(Quantity::Load))));
        row.extend(quantities.iter().map(|quantity| {
            let found = findings.quantities.iter().find(|worst| worst.quantity == *quantity);
            found.map_or_else(String::new, |worst| error(of(worst)))
        }));
        row
    };
    page.table(header, groups.iter().map(row));
}
