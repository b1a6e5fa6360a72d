//! The page of a comparison: summary, set-up, results and limits of validity.
//!
//! | module | what it writes |
//! |---|---|
//! | `summary` | summary: difference between the models, recommendation |
//! | `decreasing` | area or load that decreases with increasing indentation |
//! | `layer` | results by layer thickness |
//! | `readings` | σ and d read as those of the asperities or of the surface |
//! | `surface` | the surface, and the inputs of the statistical model |
//! | `answers` | results of both models |
//! | `limits` | limits of validity |
//! | `figures` | figures of one law and thickness |
//! | `names` | surfaces, laws and thicknesses |

mod answers;
mod decreasing;
pub mod figures;
mod layer;
mod limits;
mod names;
mod readings;
mod summary;
mod surface;

pub use limits::{assumptions, limits_of};
pub use summary::CONDITION;
pub use surface::surface;

use crate::kind::compare::results::CompareResults;
use asperity_framework::report::page::{Page, escape};
use asperity_framework::report::sections;

/// The page.
pub fn page(results: &CompareResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::notes(&mut page, &results.metadata);
    for warning in results.warnings() {
        page.warning(&escape(&warning));
    }
    let layered = layer::all(results);
    // A single thickness is shown in as much detail as an uncoated flat.
    let in_full = layered.iter().all(|series| !series.has_several());
    page.heading(2, "Summary");
    for series in &layered {
        page.bullets(series.summary_lines());
    }
    for found in results.surfaces.iter().filter(|_| in_full) {
        for index in 0..found.first.cases.len() {
            page.bullets(summary::summary_lines(results, found, index));
        }
    }
    decreasing::bullets(&mut page, results);
    if let Some(found) = &results.readings {
        page.bullets(readings::finding(found));
    }
    if results.surfaces.iter().any(|found| found.findings.laws.len() > 1) {
        page.paragraph(
            "An experiment of kind `[laws]` compares the effect of the contact law with that of the summation method.",
        );
    }
    sections::what_was_run(&mut page, &results.metadata, &results.contact);
    if let Some(layer) = &results.contact.layer {
        layer::rule_section(&mut page, layer);
    }
    if let Some(found) = &results.readings {
        readings::section(&mut page, found);
    }
    for found in &results.surfaces {
        surface(&mut page, found);
        for series in layered.iter().filter(|series| !in_full && std::ptr::eq(series.found(), found)) {
            series.answers(&mut page);
        }
        for index in (0..found.first.cases.len()).filter(|_| in_full) {
            answers::answers(&mut page, results, found, index);
        }
    }
    limits::limits(&mut page, results);
    sections::sources(&mut page, &results.metadata);
    page
}
