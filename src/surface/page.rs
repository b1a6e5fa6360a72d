//! The page of a description of surfaces.

use super::results::SurfacesResults;
use super::section::{section, sentence};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::page::{Page, escape, escape_around_code};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::Tables;

pub fn page(results: &SurfacesResults, tables: &Tables) -> Page {
    let mut page = Page::new(&results.metadata.title);
    for surface in &results.surfaces {
        let sentence = escape_around_code(&sentence(surface));
        page.lead(&format!("**{}**: {sentence}", escape(&surface.name)));
    }
    sections::warnings(&mut page, &results.warnings());
    for surface in &results.surfaces {
        page.heading(2, &format!("Surface {}", surface.name));
        if surface.realisations > 1 {
            page.paragraph(&format!("First of {} realisations.", surface.realisations));
        }
        section(&mut page, tables, surface, None);
        if surface.map.as_ref().is_some_and(|map| map.whole.spectrum.is_none()) {
            page.paragraph("The map is too large to compute its spectrum and autocorrelation in memory.");
        }
    }
    sections::notes(&mut page, &results.metadata);
    sections::run_again(&mut page, &results.metadata, None);
    page.paragraph(&sections::provenance(&results.metadata));
    sections::sources(&mut page, &results.metadata);
    page
}
