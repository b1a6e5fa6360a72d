//! The page of a description of surfaces.

use super::fitness;
use super::results::SurfacesResults;
use super::section::section;
use asperity::surface::Surface;
use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{count, quantity};
use asperity_contact_framework::report::page::{Page, escape_around_code};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::Tables;

pub fn page(results: &SurfacesResults, tables: &Tables) -> Page {
    let mut page = Page::new(&results.metadata.title);
    page.lead(&escape_around_code(&answer(&results.surfaces)));
    sections::warnings(&mut page, &results.warnings());
    for surface in &results.surfaces {
        let which = match surface.realisations {
            1 => String::new(),
            count => format!(", the first of {count} {}", surface.repeats.name()),
        };
        page.heading(2, &format!("Surface {}{which}", surface.name));
        section(&mut page, tables, surface, None);
        if surface.map.as_ref().is_some_and(|map| map.whole.spectrum.is_none()) {
            page.paragraph("No spectrum: the map is too large.");
        }
    }
    sections::notes(&mut page, &results.metadata);
    sections::run_again(&mut page, &results.metadata, None);
    page.paragraph(&sections::provenance(&results.metadata));
    sections::sources(&mut page, &results.metadata);
    page
}

/// Whether the maps may carry a verdict; of one surface what it is.
fn answer(surfaces: &[Surface]) -> String {
    let maps = surfaces.iter().filter(|surface| surface.map.is_some()).count();
    let unfit: Vec<&Surface> = surfaces.iter().filter(|surface| surface.is_blocked()).collect();
    let fitness = match (&unfit[..], maps) {
        (_, 0) => String::new(),
        ([only], 1) => format!(" {}", fitting(fitness::in_short(only))),
        ([], 1) => " The map is fit.".to_owned(),
        ([], _) => " All maps are fit.".to_owned(),
        (some, maps) => format!(" {} of {maps} maps are not fit.", some.len()),
    };
    match surfaces {
        [Surface { unscattered: Some(reason), .. }] => {
            format!("Neither model applies: the map {}.{fitness}", fitness::without_advice(reason))
        }
        [only] => format!(
            "{} asperities of mean radius {}, heights with σ = {}.{fitness}",
            count(only.set.count()),
            quantity(only.statistics.mean_radius, "m"),
            quantity(only.statistics.sigma, "m")
        ),
        several => format!("{} surfaces.{fitness}", several.len()),
    }
}
