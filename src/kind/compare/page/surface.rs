//! The section on a surface.

use asperity::MeanRadius;
use asperity::topography::generate::SigmaOf;
use asperity_framework::report::format::{count, input_number, input_quantity, number, quantity};
use asperity_framework::report::page::Page;

use crate::kind::compare::results::SurfaceResults;
use crate::surface::section::section;

/// The surface, and the inputs of the statistical model.
pub fn surface(page: &mut Page, found: &SurfaceResults) {
    let surface = &found.surface;
    let population = &found.first.population;
    page.heading(2, &format!("Surface {}", surface.name));
    if !found.others.is_empty() {
        page.paragraph(&format!(
            "Shown: the first of {} realisations; all are in `summary.json` and the tables.",
            found.count()
        ));
    }
    section(page, surface, Some(population));
    if surface.separations_of() == SigmaOf::Surface {
        let asperities = if surface.map.is_some() {
            "asperity heights are those of the summits found"
        } else {
            "asperity heights follow from Nayak (1971)"
        };
        page.paragraph(&format!(
            "Separations are measured from the mean plane of the surface and normalised by the standard deviation of the \
             surface heights; {asperities}. The distribution of asperity heights above is about their own mean, in units of their \
             own σ."
        ));
    }
    let model = &found.first.model;
    page.paragraph(&match model.joint {
        Some(joint) => format!("The statistical model has the joint density of height and curvature of {}.", joint.label()),
        None => format!(
            "Inputs of the statistical model: {} heights with σ = {}, radius {}{}, density η = {} /m².",
            population.heights.label(),
            input_quantity(population.sigma, "m"),
            input_quantity(population.radius, "m"),
            match model.mean_radius {
                MeanRadius::InContact =>
                    " (arithmetic mean of all; at each separation the mean of the asperities in contact is used)",
                MeanRadius::Arithmetic | MeanRadius::InverseMeanCurvature => "",
            },
            input_number(population.density),
        ),
    });
    if let Some(mean) = &surface.ellipticity {
        let spheres = surface.map.as_ref().filter(|map| map.saddles > 0).map(|map| {
            format!(
                " {} of {} summits have a principal curvature that is not positive; elliptic laws treat them as spheres of \
                 their mean curvature.",
                count(map.saddles),
                count(map.summits)
            )
        });
        page.paragraph(&format!(
            "Inputs under an elliptic law: mean curvature {} /m (radius {}) and mean ratio of the smaller to the larger \
             principal curvature {}.{}",
            number(mean.mean_curvature),
            quantity(mean.mean_curvature.recip(), "m"),
            number(mean.mean_ratio),
            spheres.unwrap_or_default()
        ));
    }
}
