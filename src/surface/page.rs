//! The page of a description of surfaces.

use super::results::SurfacesResults;
use super::section::section;
use asperity_framework::Outcome;
use asperity_framework::metadata::Metadata;
use asperity_framework::report::page::{Page, escape_around_code};
use asperity_framework::report::sections;

pub fn page(results: &SurfacesResults) -> Page {
    let mut page = Page::new(&results.metadata.title);
    sections::notes(&mut page, &results.metadata);
    for warning in results.warnings() {
        page.warning(&escape_around_code(&warning));
    }
    for surface in &results.surfaces {
        page.heading(2, &format!("Surface {}", surface.name));
        if surface.realisations > 1 {
            page.paragraph(&format!("First of {} realisations.", surface.realisations));
        }
        section(&mut page, surface, None);
        if surface.map.as_ref().is_some_and(|map| map.whole.spectrum.is_none()) {
            page.paragraph("The map is too large to compute its spectrum and autocorrelation in memory.");
        }
    }
    page.heading(2, "How to reproduce");
    let Metadata { stem, seed, spec_sha256, .. } = &results.metadata;
    let version = env!("CARGO_PKG_VERSION");
    page.paragraph(&format!(
        "`{stem}`: seed {seed}, SHA-256 of the spec `{spec_sha256}`. Asperity {version}."
    ));
    sections::sources(&mut page, &results.metadata);
    page
}
