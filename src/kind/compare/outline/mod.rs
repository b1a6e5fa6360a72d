//! The page of a comparison: the card of one case, or the verdict map of several, then the main figure; all else is folded.
//!
//! | module | what it writes |
//! |---|---|
//! | `case` | one surface under one law |
//! | `series` | one surface under one law by layer thickness |
//! | `sections` | what is shown of all cases together |

mod case;
mod sections;
mod series;

pub(crate) use sections::verdicts;

use asperity::compare::{ModelKind, Tolerances};
use asperity::law::Body;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::answer::Answer;
use asperity_contact_framework::report::format::{input_quantity, listed, number, thickness};
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::sections as common;
use asperity_contact_framework::report::table::{Table, Tables};
use serde_json::{Map, Value, json};

use super::card::{Card, CaseAnswer, Counts};
use super::figures::main_figure;
use super::results::{CompareResults, SurfaceResults};
use super::rows::{RuleRow, SurfaceCase, answers, tables};
use super::series::Series;
use crate::surface::{rows as surface_rows, section};

impl Outcome for CompareResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.warnings()
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        let series = Series::all(self);
        let cases: Vec<SurfaceCase> = SurfaceCase::all(self).collect();
        match &cases[..] {
            [only] => {
                page.card(Card::new(*only).lines());
                main_figure::of_case_or_paper(&mut page, self, *only, &series);
            }
            several => {
                let friction = series.iter().find_map(least_friction).unwrap_or_default();
                page.lead(&format!("{friction}{}", count(several.iter().copied())));
                main_figure::of_paper(&mut page, self, &series);
                sections::friction(&mut page, tables, &series);
                page.view(&sections::answers(tables));
                main_figure::verdict_maps(&mut page, self, &series);
            }
        }
        for series in &series {
            page.details(2, &format!("{}: by layer thickness", series.subject), |page| {
                series::figures(series, page);
                series::table(series, page, tables);
            });
        }
        common::warnings(&mut page, &self.page_warnings());
        sections::smooth_bodies(&mut page, tables);
        sections::results(&mut page, tables);
        sections::verdicts(&mut page, tables);
        sections::reference(&mut page, tables);
        sections::models(&mut page, tables);
        sections::layer(&mut page, tables);
        if series.is_empty() {
            cases.iter().for_each(|case| case::section(&mut page, self, tables, *case));
        }
        for surface in &self.surfaces {
            let which = match surface.realisations.len() {
                1 => String::new(),
                count => format!(", the first of {count} {}", surface.surface.repeats.name()),
            };
            page.details(2, &format!("Surface {}{which}", surface.surface.name), |page| {
                section::section(page, tables, &surface.surface, Some(&surface.realisations[0].population));
                case::statistical_model(page, surface);
                case::contacts(page, self, surface);
            });
        }
        sections::readings(&mut page, tables);
        common::notes(&mut page, &self.metadata);
        common::what_was_run(&mut page, &self.metadata, &self.contact, |page| {
            sections::tolerance(page, self.tolerances);
        });
        let spec = self.described.as_ref().map(|described| described.spec.as_str());
        common::run_again(&mut page, &self.metadata, spec);
        common::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = asperity_contact_framework::fields(&ContactSummary::new(&self.contact))?;
        let mut add = |key: &str, value: Value| facts.insert(key.to_owned(), value);
        if let Some(described) = &self.described {
            add("looked_at", json!(described.file));
        }
        if let Some(layer) = &self.contact.layer {
            let finite = |t: &f64| if t.is_finite() { json!(t) } else { json!("inf") };
            let mut fields = json!({
                "material": layer.name,
                "rule": layer.rule.name(),
                "thicknesses_m": layer.thicknesses.iter().map(finite).collect::<Vec<_>>(),
                "modulus_ratio": layer.check.as_ref().map(|check| check.modulus_ratio),
                "rule_errors": Table::new(RuleRow::all(self)).records(),
            });
            if layer.on == Body::Rough {
                fields["on"] = json!(layer.on.name());
            }
            add("layer", fields);
        }
        let Tolerances { statistical, deterministic } = self.tolerances;
        if statistical.or(deterministic).is_some() {
            add("tolerance", json!({ "statistical": statistical, "deterministic": deterministic }));
        }
        add("surfaces", surface_rows::records(self.surface_rows()));
        Ok(facts)
    }

    fn terminal(&self) -> Option<String> {
        if self.described.is_none() {
            return Some(self.for_terminal(SurfaceCase::all(self).collect()));
        }
        let text = |surface: &SurfaceResults| {
            let cases = SurfaceCase::on_surface(surface).collect();
            format!(
                "\n{}\n\n{}",
                section::for_terminal(&surface.surface).trim_end(),
                self.for_terminal(cases)
            )
        };
        Some(self.surfaces.iter().map(text).collect::<Vec<_>>().join("\n"))
    }
}

impl CompareResults {
    /// The cards of few cases, or a sentence and a table of many.
    fn for_terminal(&self, cases: Vec<SurfaceCase>) -> String {
        /// The most cases of which each has its card.
        const FEW: usize = 3;
        let card = |case: &SurfaceCase| Answer { lines: Card::new(*case).lines(), ..Answer::default() };
        match &cases[..] {
            [only] => card(only).to_string(),
            few if few.len() <= FEW => {
                let each = few.iter().map(|case| format!("{}\n{}", case.name(self), card(case)));
                each.collect::<Vec<_>>().join("\n\n")
            }
            many => {
                let answers = Tables::new(vec![Table::new(answers(self))]);
                format!("{}\n{}", count(many.iter().copied()), sections::answers(&answers).text().lines())
            }
        }
    }
}

/// "Friction at 5 MPa (breakdown 1 t) is least at 100 nm by the sum (0.066, uncoated 0.124) and at 80 nm by the integral (0.0705). ", at the middle one of the loads that are admissible under all; `None` where it is not asked for.
fn least_friction(series: &Series) -> Option<String> {
    let first = series.friction.first()?;
    let mut loads: Vec<f64> = series.friction.iter().map(|found| found.pressure).collect();
    loads.dedup();
    let admissible: Vec<f64> = loads.iter().copied().filter(|&load| series.is_admissible(load)).collect();
    let among = if admissible.is_empty() { &loads } else { &admissible };
    let load = among[among.len() / 2];
    let of = |kind: ModelKind, name: &str| {
        let at_load = series.friction.iter().filter(|found| found.pressure == load);
        let mut of_model = at_load.filter(|found| found.breakdown == first.breakdown && found.kind == kind);
        let found = of_model.next()?;
        let (least_at, least) = found.least()?;
        let uncoated = found.at(0.0).map_or_else(String::new, |bare| format!(", uncoated {}", number(bare)));
        Some(format!("at {} by {name} ({}{uncoated})", thickness(least_at), number(least)))
    };
    let models = [of(ModelKind::Deterministic, "the sum"), of(ModelKind::Statistical, "the integral")];
    let models: Vec<String> = models.into_iter().flatten().collect();
    Some(format!(
        "Friction at {}{} (breakdown {} t) is least {}. ",
        input_quantity(load, "Pa"),
        if admissible.is_empty() { ", not admissible," } else { "" },
        number(first.breakdown),
        listed(&models)
    ))
}

/// How many cases have which answer, in one or two sentences.
fn count<'a>(cases: impl IntoIterator<Item = SurfaceCase<'a>>) -> String {
    let answers: Vec<CaseAnswer> = cases.into_iter().filter_map(CaseAnswer::new).collect();
    if answers.is_empty() {
        return "The models are not compared at equal load in any case.".to_owned();
    }
    Counts::new(&answers).sentences()
}
