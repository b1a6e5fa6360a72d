//! What a reader sees first: the verdict in a sentence, in a table and in a figure.

use asperity::compare::{ComparedQuantity, Verdict};
use asperity_framework::report::page::{Page, escape_around_code};

use super::axes::Units;
use super::differences;
use super::layer::Series;
use super::names::stem;
use super::single_load::is_single;
use super::verdict::{Case, Overview, loads, name, over_all_cases, signed, stretches};
use super::{reference, sentences, verdict_of};
use crate::kind::compare::findings::Verdicts;
use crate::kind::compare::results::CompareResults;

const ORDER: [ComparedQuantity; 3] = ComparedQuantity::REPORTED;

/// The head of the page. `series` are the surfaces and laws where several thicknesses are compared, else none; `overview` is that of
/// several cases with a reference.
pub fn head(
    page: &mut Page,
    results: &CompareResults,
    cases: &[Case],
    series: &[Series],
    overview: Option<&Overview>,
) {
    let compared: Vec<&Case> = cases.iter().filter(|case| !case.verdicts.differences.is_empty()).collect();
    match &compared[..] {
        [] => {
            let alone: Vec<String> = if series.is_empty() {
                results.surfaces.iter().flat_map(|found| sentences(results, found)).map(named).collect()
            } else {
                reference::alone(results).collect()
            };
            alone.iter().for_each(|sentence| {
                page.lead(sentence);
            });
        }
        [_] if cases.len() == 1 => one(page, results),
        several => many(page, results, several, series, overview),
    }
}

fn named((name, sentence): (String, String)) -> String {
    format!("{}: {}", asperity_framework::report::page::escape(&name), escape_around_code(&sentence))
}

/// One surface under one law.
fn one(page: &mut Page, results: &CompareResults) {
    let found = &results.surfaces[0];
    let (case, verdicts) = (&found.first.cases[0], &found.findings.cases[0].verdicts);
    for sentence in verdict_of(found, 0) {
        page.lead(&sentence);
    }
    stretches(page, verdicts, found.surface.plane.sigma);
    if !is_single(case) {
        page.figure(
            &format!("{}-differences.svg", stem(found, &case.law)),
            differences::differences(
                &found.surface.name,
                verdicts,
                &Units::of(results, found),
                &super::finding(found, 0),
            ),
            &differences_caption(&found.surface.name),
        );
    }
}

/// The caption of the figure behind the verdicts on `name`.
pub fn differences_caption(name: &str) -> String {
    format!(
        "{name}: statistical minus deterministic model at equal load, with 95 % intervals. Green: accepted; grey: beyond the valid \
         range; what leaves a panel is cut at its frame."
    )
}

/// Several surfaces, laws or thicknesses.
fn many(
    page: &mut Page,
    results: &CompareResults,
    cases: &[&Case],
    series: &[Series],
    overview: Option<&Overview>,
) {
    let all: Vec<&Verdicts> = cases.iter().map(|case| case.verdicts).collect();
    let blocked = match all.iter().filter(|verdicts| verdicts.is_blocked).count() {
        0 => String::new(),
        count => format!(
            " {count} of these {} are on maps that fail a fitness check: no conclusion until those maps are fit.",
            all.len()
        ),
    };
    let sentence = over_all_cases(&all);
    page.lead(&escape_around_code(&format!("{sentence}{blocked}")));
    if let Some(overview) = overview {
        page.lead(&escape_around_code(&overview.nearer()));
    }
    let header = ["case", "valid loads", "real contact area", "separation", "stiffness"];
    if series.is_empty() {
        page.table(
            header,
            cases.iter().map(|case| {
                let mut row = vec![case.name.clone(), valid_loads(case.verdicts)];
                row.extend(ORDER.map(|quantity| of_one(case.verdicts, quantity)));
                row
            }),
        );
        let cases: Vec<(String, &Verdicts)> =
            cases.iter().map(|case| (case.name.clone(), case.verdicts)).collect();
        if !results.surfaces.iter().flat_map(|found| &found.first.cases).all(is_single) {
            figure(page, "verdicts", &cases, "", &sentence);
        }
        return;
    }
    page.table(
        header,
        series.iter().map(|series| {
            let all: Vec<&Verdicts> = series.verdicts().map(|(_, verdicts)| verdicts).collect();
            let mut row = vec![series.subject().to_owned(), format!("{} thicknesses", all.len())];
            row.extend(ORDER.map(|quantity| of_several(&all, quantity)));
            row
        }),
    );
    for series in series {
        let cases: Vec<(String, &Verdicts)> = series.named_verdicts();
        let counts = of_each(&series.verdicts().map(|(_, verdicts)| verdicts).collect::<Vec<_>>());
        figure(
            page,
            &format!("{}-verdicts", series.stem()),
            &cases,
            &format!("{}: ", series.subject()),
            &format!("{}: {counts}", series.subject()),
        );
    }
}

fn figure(page: &mut Page, file: &str, cases: &[(String, &Verdicts)], subject: &str, finding: &str) {
    let Some(figure) = differences::of_cases(cases, finding) else { return };
    let first = if subject.is_empty() { "Statistical".to_owned() } else { format!("{subject}statistical") };
    page.figure(
        &format!("{file}.svg"),
        figure.headed(format!("{subject}statistical − deterministic model at equal load, valid loads")),
        &format!(
            "{first} minus deterministic model at equal load, at valid loads. Green: accepted. In the table: the largest \
             difference; in part: at other loads the verdict differs."
        ),
    );
}

/// The valid loads from the lowest to the highest.
fn valid_loads(verdicts: &Verdicts) -> String {
    match (verdicts.valid.stretches.first(), verdicts.valid.stretches.last()) {
        (Some([low, _]), Some([_, high])) => loads([*low, *high]),
        _ => "none".to_owned(),
    }
}

/// The verdict on one quantity over all loads, with the largest difference.
fn of_one(verdicts: &Verdicts, quantity: ComparedQuantity) -> String {
    let stretches = || verdicts.stretches.iter().filter(|stretch| stretch.quantity == quantity);
    let has = |verdict: Verdict| stretches().any(|stretch| stretch.verdict == verdict);
    let largest = |verdict: Verdict| {
        let each =
            stretches().filter(|stretch| stretch.verdict == verdict).filter_map(|stretch| stretch.largest);
        let size = |estimate: f64| quantity.reported(estimate).abs();
        let found = each.max_by(|a, b| size(a.1.contrast).total_cmp(&size(b.1.contrast)));
        found.map_or_else(String::new, |(_, estimate)| format!(" ({})", signed(quantity, estimate.contrast)))
    };
    let blocked = if verdicts.is_blocked { "blocked: " } else { "" };
    let (verdict, word) = if has(Verdict::Beyond) {
        (Verdict::Beyond, "beyond")
    } else if has(Verdict::Within) {
        (Verdict::Within, "within")
    } else if has(Verdict::CannotTell) {
        (Verdict::CannotTell, "cannot tell")
    } else {
        return "–".to_owned();
    };
    let is_mixed = stretches().any(|stretch| stretch.verdict != verdict);
    let place = if is_mixed { " in part" } else { "" };
    format!("{blocked}{word}{place}{}", largest(verdict))
}

/// The verdicts on each quantity in several cases.
fn of_each(all: &[&Verdicts]) -> String {
    ORDER.map(|quantity| format!("{} {}", name(quantity), of_several(all, quantity))).join("; ")
}

/// The verdicts on one quantity in several cases.
fn of_several(all: &[&Verdicts], quantity: ComparedQuantity) -> String {
    let has = |verdicts: &Verdicts, verdict: Verdict| {
        verdicts.stretches.iter().any(|stretch| stretch.quantity == quantity && stretch.verdict == verdict)
    };
    let count = |is_it: &dyn Fn(&Verdicts) -> bool| all.iter().filter(|verdicts| is_it(verdicts)).count();
    let beyond = count(&|verdicts| has(verdicts, Verdict::Beyond));
    let within = count(&|verdicts| has(verdicts, Verdict::Within) && !has(verdicts, Verdict::Beyond));
    let open = all.len() - beyond - within;
    let parts = [(beyond, "beyond"), (within, "within"), (open, "cannot tell")];
    let parts: Vec<String> = parts
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, word)| format!("{word}: {count}"))
        .collect();
    parts.join(", ")
}
