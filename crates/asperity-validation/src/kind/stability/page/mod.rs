//! The page of stability: how far `f64` is off, and where.

mod figures;

use crate::kind::stability::findings::KindFindings;
use crate::kind::stability::run::StabilityResults;
use crate::stability::{GroupFindings, Kind, Quantity, Worst, uncovered_heights};
use asperity_framework::report::format::{count, number};
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;

/// An error to two digits: more would differ between machines.
fn error(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.0e}") }
}

/// The page.
pub fn page(results: &StabilityResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::notes(&mut page, &results.metadata);
    for warning in results.warnings() {
        page.warning(&escape(&warning));
    }
    page.heading(2, "In short");
    page.bullets(in_short(results));
    page.paragraph(
        "Every number that the models give is held against one of about 32 digits, made from the equations alone: other formulas, no \
         tables, double-double arithmetic, the tanh-sinh rule for integrals, slopes by differences. Half an ulp is 1.1e-16 at most.",
    );
    groups(&mut page, results);
    page.heading(2, "Where the errors are");
    for map in &results.maps {
        page.figure(&format!("{}-errors.svg", map.name), figures::map(map), figures::caption(map));
    }
    page.heading(2, "How it is checked");
    page.bullets(JUDGED);
    let uncovered = uncovered_heights();
    if !uncovered.is_empty() {
        page.paragraph(&format!(
            "Not covered, for want of an evaluation of 32 digits: integrals over the heights {}. Tests hold them against dense \
             quadrature, within 1e-12.",
            uncovered.join(", ")
        ));
    }
    page.heading(2, "The worst cases");
    page.paragraph("Of each kind the case that uses most of its bound; `stability.csv` has that of every quantity of every group, and the medians.");
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
    sections::sources(&mut page, &results.metadata);
    page
}

const JUDGED: [&str; 6] = [
    "An indentation, and d/σ of an integral, go in as they are: nothing is rounded before the first formula.",
    "Of a sum, the separation d = mean + h σ is rounded once, and w = z − d feels it: by (1 + mean/σ) times as much where heights lie far from \
     zero. So the answer is right if it lies between the exact answers for d less and more one rounding; \"plain\" errors are from the exact answer to the \
     unrounded d.",
    "Within the rounding of a boundary (16 ulp of it bare, 1e-13 under a layer) either side's answer counts: laws that jump there cannot be told apart.",
    "Where c − 1 is small, the area of ZMC doubles within so narrow a range that the rounding of w₁ alone moves it by 1/(c − 1) roundings: see the map. \
     The bounds grow by c/(c − 1), and cases have c from 1.01 on.",
    "Sampling errors are checked as variances over the mean square: of equal asperities the variance is a difference of equal numbers.",
    "Stiffnesses under a layer and under Jackson and Green are slopes of tables: their bound is 1e-11.",
];

fn in_short(results: &StabilityResults) -> Vec<String> {
    let beyond = results.beyond().count();
    let mut lines = vec![format!(
        "**{} cases** in {} groups: {}; {}.",
        count(results.cases() as usize),
        results.groups.len(),
        if beyond == 0 {
            "every one within its bound".to_owned()
        } else {
            format!("{beyond} of them beyond their bounds")
        },
        match (results.not_finite(), results.failures()) {
            (0, 0) => "no NaN, no infinity, nothing refused and nothing left unjudged".to_owned(),
            (infinite, failures) =>
                format!("{infinite} with a NaN or an infinity, {failures} not right or not checked in all"),
        },
    )];
    lines.extend(results.kinds.iter().map(|found| {
        let KindFindings { kind, largest_error, worst, group } = found;
        format!(
            "**{}**: relative errors of {} at most; nearest to its bound of {}: {} in \"{}\", {}.",
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

/// Two tables a kind: what the groups are, and their worst errors.
fn groups(page: &mut Page, results: &StabilityResults) {
    for kind in Kind::ALL {
        page.heading(2, &capital(kind.name()));
        let of_kind: Vec<&GroupFindings> =
            results.groups.iter().filter(|findings| findings.group.kind() == kind).collect();
        page.table(
            ["group", "what", "cases", "not right"],
            of_kind.iter().map(|findings| {
                vec![
                    findings.group.name().to_owned(),
                    findings.group.about().to_owned(),
                    count(findings.cases as usize),
                    match findings.failures.len() {
                        0 => "none".to_owned(),
                        several => number(several as f64),
                    },
                ]
            }),
        );
        page.paragraph("The worst errors:");
        errors(page, &of_kind, true, |worst| worst.checked);
        if kind == Kind::Sum {
            page.paragraph("Plain errors, the rounding of the separation not counted as right:");
            errors(page, &of_kind, false, |worst| worst.error);
        }
    }
}

/// Families by quantities.
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

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
