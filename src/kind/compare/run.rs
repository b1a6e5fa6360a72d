//! Running `[compare]`: both models, and the reference, on every realisation of every surface, under every law and thickness.

use std::time::Instant;

use asperity::bem::Solver;
use asperity::compare::{
    AgainstReference, CaseSampling, ComparedQuantity, Control, Difference, Gaps, Kind, Models, ModulusCheck,
    ModulusFindings, NotReached, compare,
};
use asperity::distribution::HeightsError;
use asperity::sphere::{Curve, boundaries};
use asperity::work::{CountedContact, Counter};
use asperity::{ContactError, Heights, Model, Paper, plasticity_index};
use asperity_framework::RunContext;
use asperity_framework::contact::{LawPlan, LayerMetadata, contact_metadata, papers_of};
use asperity_framework::input::InputError;
use asperity_framework::metadata::Timing;

use super::answers::{CaseResults, DecreaseResults, RealisationResults};
use super::attribution::attribute;
use super::findings::{Readings, SurfaceFindings};
use super::implausible;
use super::models::SurfaceModels;
use super::plan::{ComparePlan, Setup};
use super::ranking::rank;
use super::reference::{ContactView, ReferenceRun};
use super::results::{CompareResults, Described, ReferenceMetadata, SurfaceResults};
use super::robustness;
use super::sampling::sampling;
use super::threshold;
use crate::layer::{LayerPlan, thickness_words};
use crate::plausibility;
use crate::surface::{AnalysisDepth, PreparedMap, Surface, SurfaceFactory, SurfacePlan, files_of};

/// Runs a comparison and counts its work.
///
/// # Errors
/// A surface that cannot be made; a load that a model does not reach.
pub fn run(
    context: &RunContext,
    compare: &ComparePlan,
    counter: &Counter,
) -> Result<CompareResults, InputError> {
    let start = Instant::now();
    let mut timing = Timing::default();
    let mut papers = papers_of(&compare.laws);
    let realisations = compare.surfaces.iter().map(|surface| surface.realisations as u64);
    context.progress.steps(realisations.sum());
    let mut files = files_of(&compare.surfaces, counter);
    let setup = compare.setup(context);
    let mut surfaces = Vec::new();
    for surface in &compare.surfaces {
        let has_reference = compare.reference.is_some();
        let mut factory = SurfaceFactory::new(surface, context, counter).keeping_map(has_reference);
        let mut first_surface = factory.make(1, compare.depth(), &mut files, &mut timing)?;
        let prepared = first_surface.prepared.take();
        let models = models_of(setup, &first_surface, &mut timing)
            .map_err(|error| inapplicable(context, compare, &first_surface.name, &error))?;
        let mut first = run_surface(setup, &first_surface, &models, counter, &mut timing)
            .map_err(|(law, error)| unreachable_load(context, compare, &first_surface.name, law, &error))?;
        let start = Instant::now();
        let samplings = sampling(setup, &first_surface, &models, &first.cases);
        differ(&mut first.cases, &samplings, setup.laws, &models);
        attribute(setup, &first_surface, &models, &mut first.cases, surface.realisations == 1);
        timing.sampling += start.elapsed();
        let thresholds = threshold::thresholds(compare, &first_surface, &models, &first, counter);
        let decreases = decreases(compare, &first_surface, &models, &first, counter);
        let heights = &models.population().heights;
        if *heights != Heights::GAUSSIAN {
            papers.extend(heights.papers());
        }
        drop(models);
        let contacts = with_reference(
            context,
            compare,
            surface,
            (&first_surface, prepared),
            (&mut first.cases, &samplings),
            true,
            &mut timing,
        )?;
        let rankings = rank(setup, &first_surface, &first.cases);
        let ranked = rankings.first().map_or(&[][..], |ranking| &ranking.models);
        papers.extend(ranked.iter().flat_map(|ranked| ranked.model.papers()));
        let robustness =
            robustness::robustness(context, compare, &factory, &first_surface, &first.cases, counter);
        context.progress.step();
        let mut others = Vec::new();
        for realisation in 2..=surface.realisations {
            let mut made = factory.make(realisation, AnalysisDepth::Asperities, &mut files, &mut timing)?;
            let prepared = made.prepared.take();
            let models = models_of(setup, &made, &mut timing)
                .map_err(|error| inapplicable(context, compare, &made.name, &error))?;
            let mut other = run_surface(setup, &made, &models, counter, &mut timing)
                .map_err(|(law, error)| unreachable_load(context, compare, &made.name, law, &error))?;
            // The scatter of the realisations is the error of each.
            differ(&mut other.cases, &vec![CaseSampling::default(); compare.laws.len()], setup.laws, &models);
            attribute(setup, &made, &models, &mut other.cases, false);
            with_reference(
                context,
                compare,
                surface,
                (&made, prepared),
                (&mut other.cases, &[]),
                false,
                &mut timing,
            )?;
            others.push(other);
            context.progress.step();
        }
        papers.extend(first_surface.papers());
        papers.extend(compare.statistical.papers());
        let all: Vec<&RealisationResults> = std::iter::once(&first).chain(&others).collect();
        let findings = SurfaceFindings::of(&first_surface, &all, &thresholds, compare.accept);
        surfaces.push(SurfaceResults {
            surface: first_surface,
            first,
            others,
            thresholds,
            decreases,
            findings,
            robustness,
            rankings,
            contacts,
        });
    }
    if let Some(reference) = compare.reference.as_deref() {
        papers.extend(Solver::papers(reference.solutions.iter().any(|solution| solution.cap.is_some())));
    }
    papers.extend(compare.lines.iter().map(|line| line.paper()));
    timing.total = start.elapsed();
    let layer_metadata = layer_metadata(context, compare, &mut papers)?;
    let contact = contact_metadata(context.materials, &compare.laws, &compare.bodies, layer_metadata);
    let tolerances = compare.controls.tolerances;
    let metadata = context.metadata(papers, timing, Some(counter.work()));
    let readings = Readings::of(&surfaces);
    let described = compare
        .described
        .as_ref()
        .map(|file| Described { file: file.clone(), spec: context.source.text.clone() });
    let mut implausible = compare.implausible.clone();
    implausible.extend(surfaces.iter().flat_map(|found| {
        let Surface { name, statistics, set, .. } = &found.surface;
        plausibility::of_surface(name, statistics.mean_radius, statistics.sigma, set.nominal_area())
    }));
    let reference = compare.reference.as_deref().map(|reference| ReferenceMetadata {
        error: reference.error,
        refine: reference.refine,
        elastic: reference.elastic.clone(),
    });
    Ok(CompareResults {
        metadata,
        contact,
        implausible,
        tolerances,
        surfaces,
        readings,
        lines: compare.lines.clone(),
        reference,
        described,
    })
}

/// The layer, and the check of its rule where some contact is under it, whose sources are added to `papers`.
///
/// # Errors
/// A layer that the exact solution does not apply to.
pub(crate) fn layer_metadata(
    context: &RunContext,
    compare: &ComparePlan,
    papers: &mut Vec<Paper>,
) -> Result<Option<LayerMetadata>, InputError> {
    let Some(layer) = &compare.layer else { return Ok(None) };
    let mut check = None;
    if compare.uses_rule(layer) {
        let (findings, rules) =
            rule_check(compare, layer).map_err(|error| InputError::file(&context.source.path, error))?;
        papers.extend(rules);
        check = Some(findings);
    }
    let thicknesses = layer.thicknesses.clone();
    Ok(Some(LayerMetadata { name: layer.name.clone(), rule: layer.rule, thicknesses, check }))
}

/// Both models on a surface, its asperities as the laws see them.
///
/// # Errors
/// A statistical model that does not apply to the surface.
pub(crate) fn models_of<'a>(
    setup: Setup,
    surface: &'a Surface,
    timing: &mut Timing,
) -> Result<SurfaceModels<'a>, HeightsError> {
    let start = Instant::now();
    let is_summed = setup.models.contains(&Kind::Deterministic);
    let models = SurfaceModels::new(surface, setup.statistical, setup.law_specs, is_summed);
    timing.deterministic += start.elapsed();
    models
}

/// Points at the statistical model that does not apply to a surface.
pub(crate) fn inapplicable(
    context: &RunContext,
    compare: &ComparePlan,
    surface: &str,
    error: &HeightsError,
) -> InputError {
    let message = format!("the statistical model does not apply to surface {surface}: {error}");
    match &compare.statistical_key {
        Some(span) => context.source.error_at(span.clone(), message),
        None => InputError::file(&context.source.path, message),
    }
}

/// Both models under every law.
///
/// # Errors
/// A load that a model does not reach, and under which law.
pub(crate) fn run_surface<'a>(
    setup: Setup<'a>,
    surface: &Surface,
    models: &SurfaceModels,
    counter: &Counter,
    timing: &mut Timing,
) -> Result<RealisationResults, (&'a LawPlan, NotReached)> {
    let is_run = |kind| setup.models.contains(&kind);
    let population = models.population();
    let area = surface.set.nominal_area();
    let mut cases = Vec::new();
    setup.progress.stage("both models", setup.laws.len() as f64);
    for law in setup.laws {
        let contact = &CountedContact::new(&*law.contact, counter);
        let statistical = is_run(Kind::Statistical).then(|| models.statistical(contact, &law.spec));
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
            plasticity_index: plasticity_index(contact, population.sigma, population.radius),
            gaps: Gaps::of(&comparison.pairs),
            differences: Vec::new(),
            attribution: Vec::new(),
            reference: None,
            against_reference: AgainstReference::default(),
            comparison,
        });
        setup.progress.advance(1.0);
    }
    Ok(RealisationResults {
        asperities: surface.set.count(),
        nominal_area: area,
        statistics: surface.reported_statistics(),
        sigma: surface.plane.sigma,
        moments: surface.map.as_ref().map(|map| map.roughness.moments),
        population: population.clone(),
        model: setup.statistical.clone(),
        cases,
    })
}

/// The differences of each case with their sampling uncertainty, where both models were run.
pub(crate) fn differ(
    cases: &mut [CaseResults],
    samplings: &[CaseSampling],
    laws: &[LawPlan],
    models: &SurfaceModels,
) {
    /// Larger jumps of the load make the stiffness of a sum, which leaves them out, another than that of the integral.
    const JUMP: f64 = 0.01;
    for ((case, law), sampling) in cases.iter_mut().zip(laws).zip(samplings) {
        case.differences = Difference::of(&case.comparison.pairs, sampling);
        let shape = models.mean_shape(&law.spec);
        if boundaries(&*law.contact, shape).iter().any(|at| at.load_jump().abs() > JUMP) {
            let stiffnesses =
                case.differences.iter_mut().map(|at| &mut at.estimates[ComparedQuantity::Stiffness as usize]);
            stiffnesses.for_each(|stiffness| *stiffness = None);
        }
    }
}

/// Adds the reference to the cases of a surface with its prepared map, and how far both models are from it; without
/// sampling errors where there are no `samplings`. Gives a view of each contact where it `is_viewed`. Nothing where no
/// reference is asked for.
///
/// # Errors
/// A map that cannot be solved, and a load at which the solver does not converge.
fn with_reference(
    context: &RunContext,
    compare: &ComparePlan,
    plan: &SurfacePlan,
    (surface, prepared): (&Surface, Option<PreparedMap>),
    (cases, samplings): (&mut [CaseResults], &[CaseSampling]),
    is_viewed: bool,
    timing: &mut Timing,
) -> Result<Vec<ContactView>, InputError> {
    let Some((reference, prepared)) = compare.reference.as_deref().zip(prepared) else {
        return Ok(Vec::new());
    };
    let run = ReferenceRun { reference, compare, plan, surface, prepared, is_viewed };
    let views = run.run(context, cases, timing)?;
    let none = CaseSampling::default();
    for (index, case) in cases.iter_mut().enumerate() {
        let Some(curve) = &case.reference else { continue };
        let sampling = samplings.get(index).unwrap_or(&none);
        let (pairs, differences) = (&case.comparison.pairs, &case.differences);
        case.against_reference = AgainstReference::of(pairs, differences, curve, sampling, surface.plane);
    }
    Ok(views)
}

/// Where area or load of the sharpest asperity, of one of the mean radius and of the bluntest falls, as deep as the
/// highest asperity is pressed.
fn decreases(
    plan: &ComparePlan,
    surface: &Surface,
    models: &SurfaceModels,
    answered: &RealisationResults,
    counter: &Counter,
) -> Vec<DecreaseResults> {
    /// Smallest indentation examined over the largest.
    const SHALLOWEST: f64 = 1e-4;
    let extremes = |values: &[f64]| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        values.iter().fold(ends, |(low, high), &value| (low.min(value), high.max(value)))
    };
    let highest = extremes(surface.set.heights()).1 - surface.plane.mean;
    let mut found = Vec::new();
    let cases: Vec<_> = plan.laws.iter().zip(&answered.cases).collect();
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
                let decreases = Curve::of(&contact, shape, &[SHALLOWEST * deepest, deepest]).decreases;
                found.extend(decreases.into_iter().map(|decrease| DecreaseResults {
                    law: case.law.clone(),
                    thickness: case.thickness,
                    radius: shape.radius,
                    decrease,
                }));
            }
        }
    }
    found
}

/// Points at the sweep with a load out of reach.
pub(super) fn unreachable_load(
    context: &RunContext,
    compare: &ComparePlan,
    surface: &str,
    law: &LawPlan,
    error: &NotReached,
) -> InputError {
    let layer =
        law.thickness.map_or_else(String::new, |t| format!(", layer of thickness {}", thickness_words(t)));
    let message = format!("surface {surface}, law {}{layer}: {error}", law.label);
    if let Some(error) = implausible::error(context, compare, &message) {
        return error;
    }
    let span = match error.control {
        Control::Pressure => compare.load_keys[0].clone(),
        Control::Force => compare.load_keys[1].clone(),
        Control::Separation => None,
    };
    match span {
        Some(span) => context.source.error_at(span, message),
        None => InputError::file(&context.source.path, message),
    }
}

/// How good both rules are between the materials of a comparison.
fn rule_check(
    compare: &ComparePlan,
    layer: &LayerPlan,
) -> Result<(ModulusFindings, Vec<Paper>), ContactError> {
    /// a/t, from and to.
    const RANGE: [f64; 2] = [0.1, 10.0];
    let [rough, flat] = &compare.pair;
    let check = ModulusCheck::new(rough, &layer.material, flat)?;
    Ok((check.findings(RANGE[0], RANGE[1]), check.papers()))
}
