//! Both models on one realisation of a surface under every law, with sampling errors and causes.

use std::time::Instant;

use super::setup::{LawContact, Setup};
use crate::compare::{
    Accepted, AgainstReference, CaseSampling, ComparedQuantity, Controls, Difference, Gaps, ModelKind,
    Models, NotReached, compare,
};
use crate::distribution::HeightsError;
use crate::numeric::interval::Interval;
use crate::progress::Silent;
use crate::sphere::{Curve, boundaries};
use crate::work::{CountedContact, Counter, Timing};
use crate::{ContactLaw, Model, plasticity_index};

use super::attribution::attribute;
use super::layer::DecreaseResults;
use super::models::{StatisticalModel, SurfaceModels};
use super::results::{CaseResults, CaseStudy, RealisationFacts, RealisationResults};
use super::sampling::sampling;
use crate::surface::Surface;

/// Why both models cannot be compared on a surface.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The statistical model does not apply to it.
    #[error("the statistical model does not apply: {0}")]
    Inapplicable(HeightsError),
    /// A load that a model does not reach under a law.
    #[error("law {0}: {1}")]
    NotReached(String, NotReached),
    /// A law for ellipses on a surface whose asperities are spheres.
    #[error("law {0} needs the ellipses of the asperities; a `SummitSearch` finds them with `as_ellipses`")]
    NoEllipses(String),
}

/// Whether the integral over Gaussian heights and a mean radius may replace the sum on a surface, at nominal pressures (Pa): a case for
/// each law, with verdicts and causes.
///
/// ```
/// use asperity::compare::Accepted;
/// use asperity::study::{LawContact, verdicts};
/// use asperity::surface::{Preparation, SummitSearch};
/// use asperity::topography::{Level, summits::Neighbours};
/// # use asperity::{Material, contact_law, topography::read::{ReadOptions, height_map}};
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../experiments/surfaces/opd-1.npy").as_ref();
/// # let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
/// let map = height_map(path, ReadOptions { pixel: Some([0.1967e-6; 2]), unit: None })?;
/// let preparation = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
/// let surface = SummitSearch::new(preparation).surface("shaft", &map)?;
/// let laws = [LawContact::bare(contact_law::named("zmc").ok_or("no such law")?, &steel, &steel)?];
/// let cases = verdicts(&surface, &laws, &[1e6, 1e7], Accepted::DEFAULT)?;
/// for stretch in &cases[0].verdicts.stretches {
///     println!("{}: {} from {:e} to {:e} Pa", stretch.quantity.name(), stretch.verdict.name(), stretch.loads[0], stretch.loads[1]);
/// }
/// # assert!(!cases[0].verdicts.stretches.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`StudyError`].
pub fn verdicts(
    surface: &Surface,
    laws: &[LawContact],
    pressures: &[f64],
    accepted: Accepted,
) -> Result<Vec<CaseStudy>, StudyError> {
    let law_specs: Vec<ContactLaw> = laws.iter().map(|law| law.spec.clone()).collect();
    let controls = Controls::at_pressures(pressures.to_vec());
    let setup = Setup {
        laws,
        law_specs: &law_specs,
        models: &[ModelKind::Statistical, ModelKind::Deterministic],
        statistical: &StatisticalModel::default(),
        is_attributed: true,
        is_ranked: false,
        generates: true,
        controls: &controls,
        nominal_area: None,
        seed: 0,
        progress: &Silent,
    };
    let (realisation, _) = study(setup, surface, &Counter::default())?;
    Ok(CaseStudy::all(surface, vec![realisation], accepted).1)
}

/// Both models on a surface with the differences between them, their sampling errors and, where they are asked for, their causes.
///
/// # Errors
/// See [`StudyError`].
pub fn study(
    setup: Setup,
    surface: &Surface,
    counter: &Counter,
) -> Result<(RealisationResults, Vec<CaseSampling>), StudyError> {
    let is_summed = setup.models.contains(&ModelKind::Deterministic);
    let elliptic = setup.laws.iter().find(|law| law.spec.is_elliptic());
    if let Some(law) = elliptic.filter(|_| is_summed && surface.set.ellipses().is_none()) {
        return Err(StudyError::NoEllipses(law.label.clone()));
    }
    let timing = &mut Timing::default();
    let models = models_of(setup, surface, timing).map_err(StudyError::Inapplicable)?;
    let mut realisation = run_surface(setup, surface, &models, counter, timing)
        .map_err(|(law, error)| StudyError::NotReached(law.label.clone(), error))?;
    let samplings = sampling(setup, surface, &models, &realisation.cases);
    differ(&mut realisation.cases, &samplings, setup.laws, &models);
    attribute(setup, surface, &models, &mut realisation.cases, true);
    Ok((realisation, samplings))
}

/// Both models on a surface, its asperities as the laws see them.
///
/// # Errors
/// A statistical model that does not apply to the surface.
pub fn models_of<'a>(
    setup: Setup,
    surface: &'a Surface,
    timing: &mut Timing,
) -> Result<SurfaceModels<'a>, HeightsError> {
    let start = Instant::now();
    let is_summed = setup.models.contains(&ModelKind::Deterministic);
    let models = SurfaceModels::new(surface, setup.statistical, setup.law_specs, is_summed);
    timing.deterministic += start.elapsed();
    models
}

/// Both models under every law.
///
/// # Errors
/// A load that a model does not reach, and under which law.
pub fn run_surface<'a>(
    setup: Setup<'a>,
    surface: &Surface,
    models: &SurfaceModels,
    counter: &Counter,
    timing: &mut Timing,
) -> Result<RealisationResults, (&'a LawContact, NotReached)> {
    let is_run = |kind| setup.models.contains(&kind);
    let population = models.population();
    let area = setup.load_area(surface);
    let mut cases = Vec::new();
    setup.progress.stage("both models", setup.laws.len() as f64);
    for law in setup.laws {
        let contact = &CountedContact::new(&*law.contact, counter).watched_by(setup.progress);
        let statistical = is_run(ModelKind::Statistical).then(|| models.statistical(contact, &law.spec));
        let deterministic = models.deterministic(contact, &law.spec);
        let models = Models {
            statistical: statistical.as_deref(),
            deterministic: deterministic.as_ref().map(|model| model as &dyn Model),
        };
        let comparison = compare(models, setup.controls, area).map_err(|error| (law, error))?;
        timing.statistical += comparison.statistical_time;
        timing.deterministic += comparison.deterministic_time;
        cases.push(CaseResults {
            law: law.label.clone(),
            yields: law.spec.law().yields_by().is_some(),
            thickness: law.thickness,
            plasticity_index: plasticity_index(contact, population.sigma, population.radius)
                .filter(|_| surface.unscattered.is_none()),
            gaps: Gaps::largest(&comparison.pairs),
            differences: Vec::new(),
            not_modelled: None,
            attribution: Vec::new(),
            reference: None,
            against_reference: AgainstReference::default(),
            comparison,
        });
        setup.progress.advance(1.0);
    }
    let facts = RealisationFacts {
        asperities: surface.set.count(),
        nominal_area: surface.set.nominal_area(),
        statistics: surface.reported_statistics(),
        sigma: surface.plane.sigma,
        roughness: surface.map.as_ref().map(|map| map.roughness),
        population: population.clone(),
        model: setup.statistical.clone(),
    };
    Ok(RealisationResults { facts, cases })
}

/// The differences of each case with their sampling uncertainty, where both models were run.
pub fn differ(
    cases: &mut [CaseResults],
    samplings: &[CaseSampling],
    laws: &[LawContact],
    models: &SurfaceModels,
) {
    /// Larger jumps of the load make the stiffness of a sum, which leaves them out, another than that of the integral.
    const JUMP: f64 = 0.01;
    for ((case, law), sampling) in cases.iter_mut().zip(laws).zip(samplings) {
        case.differences = Difference::at_loads(&case.comparison.pairs, sampling);
        case.not_modelled =
            sampling.generated.as_ref().and_then(|generated| generated.as_ref().err().copied());
        let shape = models.mean_shape(&law.spec);
        if boundaries(&*law.contact, shape).iter().any(|at| at.load_jump().abs() > JUMP) {
            let stiffnesses =
                case.differences.iter_mut().map(|at| &mut at.estimates[ComparedQuantity::Stiffness as usize]);
            stiffnesses.for_each(|stiffness| *stiffness = None);
        }
    }
}

/// Where area or load of the sharpest asperity, of one of the mean radius and of the bluntest falls, as deep as the
/// highest asperity is pressed.
pub fn decreases(
    laws: &[LawContact],
    surface: &Surface,
    models: &SurfaceModels,
    realisation: &RealisationResults,
    counter: &Counter,
) -> Vec<DecreaseResults> {
    /// Smallest indentation examined over the largest.
    const SHALLOWEST: f64 = 1e-4;
    let highest = Interval::new(surface.set.heights()).high - surface.plane.mean;
    let mut all = Vec::new();
    let cases: Vec<_> = laws.iter().zip(&realisation.cases).collect();
    // Laws of the same kind of asperities, for any layer.
    for alike in cases.chunk_by(|a, b| a.0.spec.is_elliptic() == b.0.spec.is_elliptic()) {
        let spec = &alike[0].0.spec;
        let [sharpest, bluntest] = models.extreme_shapes(spec);
        let mut shapes = vec![sharpest, models.mean_shape(spec), bluntest];
        shapes.dedup();
        for (law, case) in alike {
            let separations = case.comparison.curves.iter().map(|point| point.response.separation);
            let deepest = highest - separations.fold(f64::INFINITY, f64::min);
            if !(deepest > 0.0 && deepest.is_finite()) {
                continue;
            }
            let contact = CountedContact::new(&*law.contact, counter);
            for &shape in &shapes {
                let decreases = Curve::new(&contact, shape, &[SHALLOWEST * deepest, deepest]).decreases;
                all.extend(decreases.into_iter().map(|decrease| DecreaseResults {
                    law: case.law.clone(),
                    thickness: case.thickness,
                    radius: shape.radius,
                    decrease,
                }));
            }
        }
    }
    all
}
