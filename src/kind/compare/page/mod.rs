//! The page of a comparison: summary, set-up, results and limits of validity.
//!
//! | module | what it writes |
//! |---|---|
//! | `head` | what a reader sees first |
//! | `axes` | axes and their units |
//! | `verdict` | the answer: headline, verdicts, valid range |
//! | `differences` | the figure behind the verdicts |
//! | `causes` | why the models differ |
//! | `decreasing` | area or load that decreases with increasing indentation |
//! | `layer` | results by layer thickness |
//! | `reference` | the boundary element reference |
//! | `ranking` | which statistical model is enough |
//! | `readings` | σ and d read as those of the asperities or of the surface |
//! | `robustness` | the verdicts under other treatments of a map |
//! | `single_load` | the answer at one load, in N, Pa, nm and µm² |
//! | `surface` | the surface, and the inputs of the statistical model |
//! | `answers` | results of both models |
//! | `limits` | limits of validity |
//! | `figures` | figures of one law and thickness |
//! | `lines` | closed results in these figures, and load by load |
//! | `names` | surfaces, laws and thicknesses |

mod answers;
mod axes;
pub mod causes;
mod decreasing;
mod differences;
pub mod figures;
mod head;
mod layer;
mod limits;
mod lines;
mod names;
mod ranking;
mod readings;
mod reference;
mod robustness;
mod single_load;
mod surface;
pub mod verdict;

pub use limits::{assumptions, limits_of};
pub use surface::surface;

use asperity::{Heights, MeanRadius};

use crate::kind::compare::answers::RealisationResults;
use crate::kind::compare::findings::Verdicts;
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::surface::{fitness, section};
use asperity_framework::report::format::{capitalised, listed};
use asperity_framework::report::page::{Page, escape, escape_around_code};
use asperity_framework::report::sections;
use axes::Units;
use names::{stem, subject};

/// The page: the verdict first, then why, how sure it is, the surfaces, and what the results rest on.
pub fn page(results: &CompareResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    let layered = layer::all(results);
    // A single thickness is shown in as much detail as an uncoated flat.
    let in_full = layered.iter().all(|series| !series.has_several());
    let cases = cases(results);
    let overview = verdict::Overview::of(&cases);
    head::head(&mut page, results, &cases, if in_full { &[] } else { &layered }, overview.as_ref());
    sections::warnings(&mut page, &results.warnings());
    let causes = causes::Overview::of(&cases);
    summary(&mut page, results, &layered, overview.as_ref(), causes.as_ref());
    if let Some(causes) = &causes {
        causes.section(&mut page);
    }
    if let Some(overview) = &overview {
        overview.section(&mut page);
    }
    single_load::answers(&mut page, results);
    if in_full {
        results.surfaces.iter().for_each(|found| answer(&mut page, results, found, cases.len()));
    } else {
        layered.iter().for_each(|series| series.answer(&mut page));
    }
    for found in &results.surfaces {
        surface(&mut page, found);
        for series in layered.iter().filter(|series| !in_full && std::ptr::eq(series.found(), found)) {
            series.answers(&mut page);
        }
        for index in (0..found.first.cases.len()).filter(|_| in_full) {
            answers::answers(&mut page, results, found, index);
        }
        reference::section(&mut page, results, found);
    }
    sections::notes(&mut page, &results.metadata);
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    if let Some(layer) = &results.contact.layer {
        layer::rule_section(&mut page, layer);
    }
    if let Some(found) = &results.readings {
        readings::section(&mut page, found);
    }
    limits::limits(&mut page, results);
    sections::run_again(
        &mut page,
        &results.metadata,
        results.described.as_ref().map(|described| described.spec.as_str()),
    );
    sections::sources(&mut page, &results.metadata);
    page
}

/// What else was found, in sentences; nothing where the head of the page says all.
fn summary(
    page: &mut Page,
    results: &CompareResults,
    layered: &[layer::Series],
    overview: Option<&verdict::Overview>,
    causes: Option<&causes::Overview>,
) {
    let in_full = layered.iter().all(|series| !series.has_several());
    let is_of_paper = results.surfaces.iter().all(|found| {
        let RealisationResults { population, model, .. } = &found.first;
        population.heights == Heights::GAUSSIAN
            && model.mean_radius == MeanRadius::Arithmetic
            && model.joint.is_none()
    });
    let mut lines: Vec<String> = Vec::new();
    if in_full && cases(results).len() > 1 {
        lines.extend(results.surfaces.iter().flat_map(|found| uncompared(results, found)));
    } else if !in_full {
        lines.extend(layered.iter().filter_map(layer::Series::headline));
        lines.extend(reference::alone(results));
    }
    lines.extend(
        overview.map(|found| format!("**Against the reference**: {}", escape_around_code(&found.sentence()))),
    );
    lines.extend(causes.map(|causes| {
        format!("**Why the models differ**: {}", escape_around_code(&causes.sentence(is_of_paper)))
    }));
    lines.extend(
        ranking::over_all(results).map(|sentence| {
            format!("**Which statistical model is enough**: {}", escape_around_code(&sentence))
        }),
    );
    lines.extend(layered.iter().flat_map(layer::Series::summary_lines));
    lines.extend(decreasing::lines(results));
    lines.extend(results.readings.as_ref().and_then(readings::finding));
    if results.surfaces.iter().any(|found| found.findings.laws.len() > 1) {
        lines.push(
            "An experiment of kind `[laws]` compares the effect of the contact law with that of the summation method."
                .to_owned(),
        );
    }
    if !lines.is_empty() {
        page.heading(2, "Findings");
        page.bullets(lines);
    }
}

/// The verdicts on every surface under every law and thickness, with their names and Nayak's alpha.
fn cases(results: &CompareResults) -> Vec<verdict::Case<'_>> {
    let mut all = Vec::new();
    let one_law = results.surfaces.iter().all(|found| found.findings.laws.len() == 1);
    for found in &results.surfaces {
        for (case, findings) in found.first.cases.iter().zip(&found.findings.cases) {
            let layer = results.contact.layer.as_ref().zip(case.thickness);
            let layer = layer.map_or_else(String::new, |(layer, t)| format!(", {}", names::under(layer, t)));
            all.push(verdict::Case {
                name: if one_law {
                    format!("{}{layer}", found.surface.name)
                } else {
                    format!("{}, {}{layer}", found.surface.name, case.law)
                },
                alpha: found.surface.map.as_ref().and_then(|map| map.roughness.alpha()),
                verdicts: &findings.verdicts,
            });
        }
    }
    all
}

/// What is said of one surface under laws for which no models are compared.
fn uncompared(results: &CompareResults, found: &SurfaceResults) -> impl Iterator<Item = String> {
    let marked = |(name, sentence): (String, String)| {
        format!("**{}**: {}", escape(&name), escape_around_code(&sentence))
    };
    let is_uncompared = |index: &usize| found.findings.cases[*index].verdicts.differences.is_empty();
    let indices = (0..found.first.cases.len()).filter(is_uncompared);
    indices.flat_map(|index| sentences_of(results, found, index)).map(marked)
}

/// Descriptions and answers as text.
pub fn for_terminal(results: &CompareResults) -> String {
    let of = |found: &SurfaceResults| {
        let mut text = format!("\n{}", section::for_terminal(&found.surface));
        for (name, sentence) in sentences(results, found) {
            text.push_str(&format!("\n{name}: {sentence}\n"));
        }
        text.trim_end().to_owned()
    };
    let texts: Vec<String> = results.surfaces.iter().map(of).collect();
    texts.join("\n")
}

/// The answer on one surface: for each law its subject and a sentence, and another against the reference.
fn sentences(results: &CompareResults, found: &SurfaceResults) -> Vec<(String, String)> {
    (0..found.first.cases.len()).flat_map(|index| sentences_of(results, found, index)).collect()
}

/// The same under one law.
fn sentences_of(results: &CompareResults, found: &SurfaceResults, index: usize) -> Vec<(String, String)> {
    let (case, verdicts) = (&found.first.cases[index], &found.findings.cases[index].verdicts);
    let name = subject(results, found, &case.law);
    let has_pairs = !case.comparison.pairs.is_empty();
    let sentence = if verdicts.differences.is_empty() && has_pairs && found.others.is_empty() {
        "both models are in contact at none of the separations, so that they are not compared at equal load."
            .to_owned()
    } else if verdicts.differences.is_empty() && has_pairs {
        "the realisations have no load in common, so that the models are not compared at equal load; add `pressure` or \
             `force` to the spec."
                .to_owned()
    } else if case.comparison.curves.is_empty() {
        reference::alone_sentence(case)
    } else if verdicts.differences.is_empty() {
        format!("one model was run, so that no models are compared. {}", verdict::range_line(verdicts))
    } else {
        let mut sentence = verdict::headline(verdicts, found.surface.plane.sigma);
        sentence.extend(robustness::sentence(found, index).map(|depends| format!(" {depends}")));
        if_fit(found, sentence)
    };
    let nearer = nearer(verdicts).map(|nearer| (format!("{name}, against the reference"), nearer));
    std::iter::once((name, sentence)).chain(nearer).collect()
}

/// Which model is nearer to the reference; nothing where none was run.
fn nearer(verdicts: &Verdicts) -> Option<String> {
    let sentence = verdict::nearer_sentence(verdicts)?;
    Some(if verdicts.is_blocked { format!("as the data stand, {sentence}") } else { sentence })
}

/// The verdict on one compared case, and which model is nearer to the reference, as Markdown.
fn verdict_of(found: &SurfaceResults, index: usize) -> Vec<String> {
    let verdicts = &found.findings.cases[index].verdicts;
    let answer = if_fit(found, verdict::verdict_alone(verdicts, found.surface.plane.sigma));
    let mut all = vec![escape_around_code(&capitalised(&answer))];
    all.extend(
        nearer(verdicts).map(|nearer| format!("Against the reference: {}", escape_around_code(&nearer))),
    );
    all
}

/// What the figure behind the verdicts on a case shows, in words.
pub fn finding(found: &SurfaceResults, index: usize) -> String {
    let sentence = verdict::headline(&found.findings.cases[index].verdicts, found.surface.plane.sigma);
    if_fit(found, sentence)
}

/// The answer on one surface under every law, the whole of a page on `all` cases.
fn answer(page: &mut Page, results: &CompareResults, found: &SurfaceResults, all: usize) {
    for index in 0..found.first.cases.len() {
        let verdicts = &found.findings.cases[index].verdicts;
        if verdicts.differences.is_empty() {
            continue;
        }
        let name = subject(results, found, &found.first.cases[index].law);
        let title = format!("{name}: verdicts");
        match all {
            // Its verdicts are at the head of the page.
            1 => behind(page, 2, results, found, index),
            2..=MOST_OPEN => {
                page.heading(2, &title);
                verdicts_of(page, results, found, index, &name);
                behind(page, 3, results, found, index);
            }
            _ => {
                page.details(2, &title, |page| {
                    verdicts_of(page, results, found, index, &name);
                    behind(page, 3, results, found, index);
                });
            }
        }
    }
}

/// More cases are folded, each by itself.
const MOST_OPEN: usize = 2;

/// The verdicts on one case: sentences, table and figure.
fn verdicts_of(page: &mut Page, results: &CompareResults, found: &SurfaceResults, index: usize, name: &str) {
    let verdicts = &found.findings.cases[index].verdicts;
    let case = &found.first.cases[index];
    for sentence in verdict_of(found, index) {
        page.paragraph(&sentence);
    }
    verdict::stretches(page, verdicts, found.surface.plane.sigma);
    if !single_load::is_single(case) {
        page.figure(
            &format!("{}-differences.svg", stem(found, &case.law)),
            differences::differences(name, verdicts, &Units::of(results, found), &finding(found, index)),
            &head::differences_caption(name),
        );
    }
}

/// What is behind the verdicts on one case: why, the reference, how sure, and which statistical model is enough.
fn behind(page: &mut Page, level: u8, results: &CompareResults, found: &SurfaceResults, index: usize) {
    let (case, verdicts) = (&found.first.cases[index], &found.findings.cases[index].verdicts);
    let (name, stem) = (subject(results, found, &case.law), stem(found, &case.law));
    let units = Units::of(results, found);
    if let Some(reason) = found.first.model.undivided() {
        causes::undivided(page, level, &name, reason);
    } else {
        causes::section(page, level, verdicts, &name, &stem, &units);
    }
    against_reference(page, level, &units, found, index, &name);
    page.heading(level, &format!("{name}: how sure are the verdicts?"));
    let mut lines = vec![
        verdict::range_line(verdicts),
        verdict::accepted_line(&verdicts.accepted, found.surface.plane.sigma),
        verdict::basis_line(verdicts),
    ];
    lines.extend(verdict::would_tell(verdicts));
    lines.extend(verdict::stiffness_line(verdicts).map(|line| format!("{}: {line}", escape(&case.law))));
    page.bullets(lines);
    if !single_load::is_single(case) {
        robustness::section(page, found, index, &name, &stem);
    }
    let alpha = found.surface.map.as_ref().and_then(|map| map.roughness.alpha());
    if let Some(ranked) = found.rankings.get(index) {
        ranking::section(page, level, ranked, &verdicts.accepted, &name, alpha);
    }
}

/// Both models against the reference; nothing where none was run.
fn against_reference(
    page: &mut Page,
    level: u8,
    units: &Units,
    found: &SurfaceResults,
    index: usize,
    name: &str,
) {
    let verdicts = &found.findings.cases[index].verdicts;
    let Some(reference) = &verdicts.reference else { return };
    page.heading(level, &format!("{name}: against the reference"));
    if reference.nearer.is_empty() {
        page.paragraph("At none of the loads of the reference are both models valid, so that they get no verdict against it.");
        return;
    }
    verdict::nearer(page, verdicts, reference);
    let case = &found.first.cases[index];
    if !single_load::is_single(case) {
        page.figure(
            &format!("{}-against-reference.svg", stem(found, &case.law)),
            differences::against_reference(
                verdicts,
                &reference.against,
                units,
                &format!("{name}: each model minus the reference"),
            )
            .headed(format!("{name}: each model minus the reference at equal load")),
            &format!(
                "{name}: each model minus the reference at equal load, with 95 % intervals where they can be claimed. Green: accepted; \
                 grey: beyond the valid range; what leaves a panel is cut at its frame."
            ),
        );
    }
    let alpha = found.surface.map.as_ref().and_then(|map| map.roughness.alpha());
    page.bullets(verdict::misses(reference, alpha));
}

/// The answer on one surface, a row for each law.
pub fn answer_by_law(page: &mut Page, found: &SurfaceResults) {
    let each = found.first.cases.iter().zip(&found.findings.cases);
    let all: Vec<(String, &Verdicts)> =
        each.map(|(case, findings)| (case.law.clone(), &findings.verdicts)).collect();
    answer_over(page, &found.surface.name, "law", &all, found);
}

/// Over all laws in one sentence.
pub fn headline_over_laws(found: &SurfaceResults) -> Option<String> {
    let all: Vec<&Verdicts> = found.findings.cases.iter().map(|findings| &findings.verdicts).collect();
    headline_over(&found.surface.name, "laws", &all, found)
}

/// Over several `cases` (thicknesses, laws) of one surface in one sentence; `None` where nothing was compared.
fn headline_over(name: &str, cases: &str, all: &[&Verdicts], found: &SurfaceResults) -> Option<String> {
    let all: Vec<&Verdicts> =
        all.iter().copied().filter(|verdicts| !verdicts.differences.is_empty()).collect();
    if all.is_empty() {
        return None;
    }
    let mut sentence = verdict::over_cases(cases, &all);
    sentence.extend(robustness::over_cases(found, cases).map(|depends| format!(" {depends}")));
    Some(format!("**{}**: {}", escape(name), escape_around_code(&if_fit(found, sentence))))
}

/// A sentence on a surface, unless a failed check keeps it from carrying a verdict.
fn if_fit(found: &SurfaceResults, sentence: String) -> String {
    match fitness::blocked_by(&found.surface) {
        None => sentence,
        Some(faults) => {
            format!("no conclusion until the map is fit: {faults}. As the data stand: {sentence}")
        }
    }
}

/// The verdicts over several cases of one surface, each called `case`.
fn answer_over(page: &mut Page, name: &str, case: &str, all: &[(String, &Verdicts)], found: &SurfaceResults) {
    let all: Vec<(String, &Verdicts)> =
        all.iter().filter(|(_, verdicts)| !verdicts.differences.is_empty()).cloned().collect();
    let Some((first_name, first)) = all.first() else { return };
    page.heading(2, &format!("{name}: verdicts by {case}"));
    verdict::by_case(page, case, &all);
    let mut lines = vec![
        format!("{}: {} The table lists valid loads only.", escape(first_name), verdict::range_line(first)),
        verdict::accepted_line(&first.accepted, found.surface.plane.sigma),
        verdict::basis_line(first),
    ];
    let is_without = |(_, verdicts): &&(String, &Verdicts)| verdict::stiffness_line(verdicts).is_some();
    let without: Vec<String> = all.iter().filter(is_without).map(|(name, _)| escape(name)).collect();
    let line = all.iter().find_map(|(_, verdicts)| verdict::stiffness_line(verdicts));
    lines.extend(line.map(|line| format!("{}: {line}", listed(&without))));
    page.bullets(lines);
}
