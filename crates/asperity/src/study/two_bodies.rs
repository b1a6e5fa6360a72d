//! What is usual for two rough bodies in place of their sum.

use super::PointResult;
use super::results::CaseStudy;
use super::setup::{LawContact, Setup};
use crate::compare::ModelKind;
use crate::distribution::gaussian_moment;
use crate::interface::MicroContact;
use crate::model::{GreenwoodTrippError, power_law};
use crate::surface::{BodyAsperities, Surface};
use crate::{Heights, Model, Population, Response, Statistical, named_enum};

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
    let scatter = |bodies: &&[BodyAsperities; 2]| bodies.iter().all(|body| body.sigma > 0.0);
    let Some(bodies) = surface.bodies.as_deref().filter(scatter) else {
        return vec![Vec::new(); cases.len()];
    };
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
        // It is the model itself where both have no composite.
        let is_other = |shortcut: &Shortcut| !surface.meets_in_pairs || *shortcut != Shortcut::GreenwoodTripp;
        Shortcut::ALL.into_iter().filter(is_other).filter_map(result).collect()
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

/// The integral of Greenwood and Tripp at one separation of both mean asperity heights.
#[derive(Debug, Clone, Copy)]
pub struct GreenwoodTrippPoint {
    /// What it gives under the law, d/sigma with the sigma of both asperity heights together.
    pub response: Response,
    /// F_5/2(d/sigma), to which the pressure of elastic contacts is proportional.
    pub moment: f64,
    /// The power law in its place.
    pub power_law: f64,
}

/// The curve of each law on two rough bodies, over the separations of the setup or over 0 to 4 where it has none; empty as
/// [`shortcuts`] are.
pub fn greenwood_tripp_curves(setup: Setup, surface: &Surface) -> Vec<Vec<GreenwoodTrippPoint>> {
    let bodies = surface.bodies.as_ref();
    let bodies =
        bodies.map(|both| both.each_ref().map(|body| body.population(setup.statistical.mean_radius)));
    let separations = match &setup.controls.separations {
        none if none.is_empty() => (0..=40).map(|tenths| f64::from(tenths) / 10.0).collect(),
        given => given.clone(),
    };
    let curve = |law: &LawContact| {
        let bodies = bodies.as_ref().filter(|_| !law.spec.is_elliptic())?;
        let model = Statistical::greenwood_tripp(&*law.contact, bodies).ok()?;
        let at = |&h: &f64| GreenwoodTrippPoint {
            response: model.respond(h),
            moment: gaussian_moment(2.5, h),
            power_law: power_law(h),
        };
        Some(separations.iter().map(at).collect())
    };
    setup.laws.iter().map(|law| curve(law).unwrap_or_default()).collect()
}
