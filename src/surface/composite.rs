//! Two rough bodies that are populations: their composite, whose spectral moments are the sums of both (Nayak 1971), or where no surface has
//! such asperities the pairs of them that meet (Greenwood and Tripp 1971).

use asperity::surface::BodyAsperities;
use asperity::{Heights, Population, ReferencePlane, SurfaceHeights, meeting_pairs};
use asperity_contact_framework::input::{InputError, Source, Spanned};

use super::plan::{Origin, SurfacePlan, Surfaces, named_surface};
use super::spec::{DrawSpec, PairSpec, PopulationSpec, SurfaceSpec};

/// Asperities of the composite, of which the integral takes no notice.
const COUNT: usize = 1 << 16;

/// The composite of a pair of populations; `None` of other surfaces.
///
/// # Errors
/// One population alone, and two that are not Gaussian, or neither of an isotropic Gaussian surface nor alike enough to meet in pairs; keys
/// about positions.
pub(super) fn of_populations(
    source: &Source,
    raw: &PairSpec,
    all: &Surfaces,
) -> Result<Option<Origin>, InputError> {
    let body = |name: &Spanned<String>| {
        let (_, spec) = named_surface(source, all, name, |spec| !spec.is_pair())?;
        Ok::<_, InputError>(match spec.get_ref() {
            SurfaceSpec::Population(population) => Some((spec, population)),
            _ => None,
        })
    };
    let (Some(first), Some(second)) = (body(&raw.a)?, body(&raw.b)?) else { return Ok(None) };
    if let Some(shifts) = &raw.shifts {
        let message =
            "found `shifts` of two populations, whose asperities have no positions; allowed: no `shifts`";
        return Err(source.error_at(shifts.span(), message));
    }
    if raw.rotations {
        let message = "found `rotations` of two populations, whose asperities have no positions; allowed: no `rotations`";
        return Err(source.error_at(raw.b.span(), message));
    }
    let gaussian = |name: &Spanned<String>, (spec, raw): (&Spanned<SurfaceSpec>, &PopulationSpec)| {
        let refuse = |message: String| source.error_at(name.span(), message);
        let Origin::Population { population, ratio, .. } =
            SurfacePlan::population(source, spec.span(), raw, false)?
        else {
            return Err(refuse(format!("found \"{}\"; allowed: a population", name.get_ref())));
        };
        if ratio.is_some() || population.heights != Heights::GAUSSIAN {
            let what = if ratio.is_some() { "elliptic asperities" } else { "heights that are not Gaussian" };
            return Err(refuse(format!(
                "found {what} of \"{}\", whose composite is not known; allowed: spheres of Gaussian heights",
                name.get_ref()
            )));
        }
        Ok::<Population, InputError>(population)
    };
    let both = [gaussian(&raw.a, first)?, gaussian(&raw.b, second)?];
    let surface = |name: &Spanned<String>, population: &Population| {
        SurfaceHeights::of_asperities(population).map_err(|error| format!("{}: {error}", name.get_ref()))
    };
    let surfaces = surface(&raw.a, &both[0]).and_then(|a| Ok([a, surface(&raw.b, &both[1])?]));
    let composite = surfaces.and_then(|surfaces| {
        SurfaceHeights::composite(surfaces).population().map_err(|error| error.to_string())
    });
    let (population, no_composite) = match composite {
        Ok(composite) => (composite, None),
        Err(reason) => match meeting_pairs(&both) {
            Ok(pairs) => (pairs, Some(reason)),
            Err(error) => {
                let message = format!(
                    "{reason}; the integral of Greenwood and Tripp (1971), which needs no such surface, is not possible either: {error}"
                );
                return Err(source.error_at(raw.b.span(), message));
            }
        },
    };
    let bodies = [(&raw.a, &both[0]), (&raw.b, &both[1])]
        .map(|(name, population)| BodyAsperities::nominal(name.get_ref(), population));
    Ok(Some(Origin::Population {
        plane: ReferencePlane { mean: 0.0, sigma: population.sigma },
        population,
        ratio: None,
        count: COUNT,
        draw: DrawSpec::Quantiles,
        bodies: Some(Box::new(bodies)),
        no_composite,
    }))
}
