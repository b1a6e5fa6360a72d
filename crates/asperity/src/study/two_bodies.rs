//! What is usual for two rough bodies in place of their sum.

use super::PointResult;
use super::case::CaseStudy;
use super::setup::Setup;
use crate::compare::ModelKind;
use crate::interface::MicroContact;
use crate::model::GreenwoodTrippError;
use crate::surface::Surface;
use crate::{Heights, Model, Population, Statistical, named_enum};

named_enum! {
    /// An integral over the asperities of both bodies in place of one over those of their sum.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Shortcut {
        /// One rough body with the variances of both added, the radius of 1/R = 1/R1 + 1/R2, and the density of the rougher one.
        VariancesAdded = "variances-added",
        /// Every asperity of one body against every one of the other (Greenwood and Tripp 1971).
        GreenwoodTripp = "greenwood-tripp",
    }
}

impl Shortcut {
    /// Its integral of one contact.
    ///
    /// # Errors
    /// Bodies that the model of Greenwood and Tripp does not describe.
    pub fn model<'a>(
        self,
        contact: &'a dyn MicroContact,
        bodies: &[Population; 2],
    ) -> Result<Statistical<'a>, GreenwoodTrippError> {
        match self {
            Self::VariancesAdded => {
                let [first, second] = bodies;
                let rougher = if first.sigma >= second.sigma { first } else { second };
                let population = Population {
                    radius: (first.radius.recip() + second.radius.recip()).recip(),
                    sigma: first.sigma.hypot(second.sigma),
                    density: rougher.density,
                    heights: Heights::GAUSSIAN,
                };
                Ok(Statistical::new(contact, population))
            }
            Self::GreenwoodTripp => Statistical::greenwood_tripp(contact, bodies),
        }
    }
}

/// A shortcut on one case, at the load that its results are reported at.
#[derive(Debug, Clone, Copy)]
pub struct ShortcutResult {
    /// The shortcut.
    pub shortcut: Shortcut,
    /// What it finds; not the separation, which is from other planes.
    pub point: PointResult,
}

/// The shortcuts on each of `cases` of a surface, in their order; none of one body, of laws for ellipses, and where the bodies do not allow
/// one.
pub fn shortcuts(setup: Setup, surface: &Surface, cases: &[CaseStudy]) -> Vec<Vec<ShortcutResult>> {
    let Some(bodies) = &surface.bodies else { return vec![Vec::new(); cases.len()] };
    let bodies = bodies.each_ref().map(|body| body.population(setup.statistical.mean_radius));
    let of_case = |case: &CaseStudy, contact: &dyn MicroContact| -> Vec<ShortcutResult> {
        let at_load = case.results_at_load();
        let integral = at_load.models.iter().find(|found| found.model == Some(ModelKind::Statistical));
        let found = integral.or(at_load.models.first());
        let Some(load) = found.map(|found| found.point.pressure) else { return Vec::new() };
        let result = |shortcut: Shortcut| {
            let model = shortcut.model(contact, &bodies).ok()?;
            let response = model.respond(model.separation_at(load)?);
            Some(ShortcutResult { shortcut, point: PointResult { separation: None, ..(&response).into() } })
        };
        Shortcut::ALL.into_iter().filter_map(result).collect()
    };
    let laws = setup.laws.iter();
    cases
        .iter()
        .zip(laws)
        .map(|(case, law)| {
            let is_elliptic = law.spec.is_elliptic();
            // It knows of no mean plane, from which a medium in the gap would take its thickness.
            let has_medium =
                law.contact.spot_properties().is_some_and(|properties| properties.medium.is_some());
            if is_elliptic || has_medium { Vec::new() } else { of_case(case, &*law.contact) }
        })
        .collect()
}
