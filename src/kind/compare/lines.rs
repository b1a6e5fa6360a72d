//! `lines = [...]` in `[compare]`: closed results beside the models.

use asperity::analytical::AnalyticalLine;
use asperity::bem::Boundary;
use asperity_contact_framework::input::{InputError, SpecFile};

use super::reference::ReferencePlan;
use super::spec::CompareSpec;
use crate::surface::SurfacePlan;

/// Resolves the lines of `[compare]`; none where none are asked for.
///
/// # Errors
/// A surface without a map; a layer; interaction where the surface has no end, or no model.
pub fn lines(
    file: &SpecFile,
    raw: &CompareSpec,
    surfaces: &[SurfacePlan],
    reference: Option<&ReferencePlan>,
) -> Result<Vec<AnalyticalLine>, InputError> {
    let Some(asked) = &raw.lines else { return Ok(Vec::new()) };
    let lines = &asked.get_ref().0;
    let refuse = |message: String| Err(file.source.error_at(asked.span(), message));
    if let Some(surface) = surfaces.iter().find(|surface| surface.map_points().is_none()) {
        return refuse(format!(
            "found analytical lines on surface {} ({}), which has no height map to take an r.m.s. gradient from; allowed: surfaces made by \
             [surface.NAME.generate] or read by [surface.NAME.file], chosen by `surfaces = [...]`, or no `lines`",
            surface.name,
            surface.describe()
        ));
    }
    if raw.layer.is_some() {
        return refuse(
            "found analytical lines with a layer, which hold for homogeneous bodies; allowed: no `layer`, or no `lines`".to_owned(),
        );
    }
    let interacting = AnalyticalLine::GreenwoodWilliamsonInteracting;
    if !lines.contains(&interacting) {
        return Ok(lines.clone());
    }
    if raw.models.as_ref().is_some_and(|models| models.get_ref().kinds.is_empty()) {
        return refuse(format!(
            "found \"{}\" without a model, whose separation it corrects; allowed: \"statistical\" or \"deterministic\" among the models",
            interacting.name()
        ));
    }
    let endless = surfaces.iter().find_map(|surface| {
        let boundary = reference.map(|reference| reference.boundary(surface));
        (boundary != Some(Boundary::Finite)).then_some((surface, boundary))
    });
    let Some((surface, boundary)) = endless else { return Ok(lines.clone()) };
    let found = match boundary {
        None => "without a reference".to_owned(),
        Some(boundary) => {
            format!("with the boundary \"{}\" of the reference on surface {}", boundary.name(), surface.name)
        }
    };
    refuse(format!(
        "found \"{}\" {found}; allowed: \"reference\" among the models with reference = {{ boundary = \"finite\" }}. The line lowers the \
         separation by the mean deflection of the patch under the nominal pressure, which grows with the side of the patch: on a surface \
         without end it has no meaning",
        interacting.name()
    ))
}
