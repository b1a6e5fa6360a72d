//! The page of a comparison: the answer first, then its figure, the verdicts, why, how sure, the surfaces, and what the results rest on.
//!
//! | module | what it writes |
//! |---|---|
//! | `lead`, `at_load`, `replace`, `limit` | the answer on one case: results at the load, on this map, on such surfaces; why a load is not admissible |
//! | `count` | the answer over several cases |
//! | `case` | one surface under one law |
//! | `series` | one surface under one law by layer thickness |
//! | `sections` | what is shown of all cases together |

mod at_load;
mod case;
mod count;
#[cfg(test)]
mod examples;
mod lead;
mod limit;
mod replace;
mod sections;
mod series;

pub use case::inputs;
pub(crate) use sections::verdicts;

use asperity::compare::Tolerances;
use asperity::law::Body;
use asperity::study::Verdicts;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::page::{Page, escape_around_code};
use asperity_contact_framework::report::sections as common;
use asperity_contact_framework::report::table::{Table, Tables};
use serde_json::{Map, Value, json};

use super::figures::main_figure;
use super::results::{CompareResults, SurfaceResults};
use super::rows::{RuleRow, SurfaceCase, tables};
use super::series::Series;
use crate::presentation::limits_note;
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
        for sentence in answer(self).into_iter().chain(self.elastic_reference_note()) {
            page.lead(&escape_around_code(&sentence));
        }
        common::warnings(&mut page, &self.warnings());
        main_figure::main_figure(&mut page, self, &series);
        sections::results(&mut page, tables);
        sections::verdicts(&mut page, tables);
        sections::reference(&mut page, self, tables);
        sections::models(&mut page, tables);
        sections::layer(&mut page, self, tables);
        for series in &series {
            page.details(2, &format!("{}: by layer thickness", series.subject), |page| {
                series::figures(series, page);
                series::table(series, page, tables);
            });
        }
        if series.is_empty() {
            SurfaceCase::all(self).for_each(|case| case::section(&mut page, self, tables, case));
            sections::causes(&mut page, self);
        }
        for surface in &self.surfaces {
            page.heading(2, &format!("Surface {}", surface.surface.name));
            section::section(&mut page, tables, &surface.surface, Some(&surface.realisations[0].population));
            case::inputs(&mut page, surface);
            case::contacts(&mut page, self, surface);
        }
        sections::readings(&mut page, tables);
        common::notes(&mut page, &self.metadata);
        common::what_was_run(&mut page, &self.metadata, &self.contact);
        limits_note(&mut page);
        sections::tolerance(&mut page, self.tolerances);
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
            return Some(answer(self).join("\n"));
        }
        let text = |surface: &SurfaceResults| {
            let answers: String = SurfaceCase::on_surface(surface)
                .map(|case| format!("\n{}\n{}\n", case.name(self), case::answer(case).join("\n")))
                .collect();
            format!("\n{}{}", section::for_terminal(&surface.surface), answers).trim_end().to_owned()
        };
        Some(self.surfaces.iter().map(text).collect::<Vec<_>>().join("\n"))
    }
}

/// The most cases of which each is answered by itself.
const FEW: usize = 3;

/// The answer: of few cases each by itself, of more counted.
fn answer(results: &CompareResults) -> Vec<String> {
    let cases: Vec<SurfaceCase> = SurfaceCase::all(results).collect();
    let compared = |case: &&SurfaceCase| !case.verdicts().differences.is_empty();
    let verdicts: Vec<&Verdicts> = cases.iter().filter(compared).map(|case| case.verdicts()).collect();
    match (&cases[..], verdicts.len()) {
        ([only], _) => case::answer(*only),
        // Of few cases each by itself.
        (all, compared) if compared == 0 || all.len() <= FEW => {
            let each = cases.iter().flat_map(|case| {
                let mut sentences = case::answer(*case);
                if let Some(first) = sentences.first_mut() {
                    first.insert_str(0, &format!("{}: ", case.name(results)));
                }
                sentences
            });
            each.collect()
        }
        _ => vec![count::count(&verdicts)],
    }
}
