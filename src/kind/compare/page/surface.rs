//! The section on a surface.

use asperity_framework::report::format::{count, number, quantity};
use asperity_framework::report::page::Page;

use crate::kind::compare::results::SurfaceResults;
use crate::surface::section;

/// What the surface is, and what the statistical model makes of it.
pub fn surface(page: &mut Page, found: &SurfaceResults) {
    let surface = &found.surface;
    let population = &found.first.population;
    page.heading(2, &format!("Surface {}", surface.name));
    if !found.others.is_empty() {
        page.paragraph(&format!(
            "This is the first of {} realisations; all are in `summary.json` and the tables.",
            found.count()
        ));
    }
    section(page, surface, Some(population));
    if surface.is_quoted_as_surface() {
        page.paragraph(
            "Separations are measured from the mean plane of the surface, in the standard deviation of the surface heights; \
             asperity heights follow from Nayak (1971).",
        );
    }
    page.paragraph(&format!(
        "The statistical model stands on {} heights with σ = {}, one radius of {} and η = {} /m².",
        population.heights.label(),
        quantity(population.sigma, "m"),
        quantity(population.radius, "m"),
        number(population.density),
    ));
    if let Some(mean) = &surface.ellipticity {
        let spheres = surface.map.as_ref().filter(|map| map.saddles > 0).map(|map| {
            format!(
                " {} of {} summits are no ellipses, since one of their principal curvatures is not positive: elliptic laws \
                 take them as spheres of their mean curvature.",
                count(map.saddles),
                count(map.summits)
            )
        });
        page.paragraph(&format!(
            "Under an elliptic law it stands on asperities of the mean curvature {} /m (a radius of {}) and the mean ratio \
             of the smaller to the larger principal curvature, {}.{}",
            number(mean.mean_curvature),
            quantity(mean.mean_curvature.recip(), "m"),
            number(mean.mean_ratio),
            spheres.unwrap_or_default()
        ));
    }
}
