//! Running a plan.

use std::time::Instant;

use super::files::Files;
use super::models::SurfaceModels;
use super::overview::AnalysisDepth;
use super::plan::thickness_words;
use super::plan::{ComparePlan, LawPlan, LayerPlan, LimitPlan, Plan, PlanKind, SurfacePlan};
use super::progress::Progress;
use super::results::{
    Bodies, CaseResults, CompareResults, ContactMetadata, FallResults, LayerMetadata, LimitResults, Metadata,
    RealisationResults, Results, SurfaceResults, SurfacesResults, Timing,
};
use super::surface::Surface;
use super::{
    InputError, digest, hexadecimal, indentation, laws, precision, stability, stream_seed, threshold,
};
use asperity::asperity::{Population, gaussian_moment};
use asperity::compare::{
    Control, Exact, Gaps, Kind, LimitCase, Models, NotReached, RuleCheck, RuleFindings, compare, convergence,
};
use asperity::interface::{ContactError, Counted, MicroContact, plasticity_index};
use asperity::law::Property;
use asperity::literature::{self, Paper};
use asperity::model::{Model, Statistical};
use asperity::sphere::Curve;
use asperity::work::{Counter, Item, Work};

pub(super) fn run(plan: &Plan, progress: &dyn Progress) -> Result<Results, InputError> {
    match &plan.kind {
        PlanKind::Compare(compare) => {
            run_compare(plan, compare, &Counter::default(), progress).map(Results::Compare)
        }
        PlanKind::Indentation(sphere) => indentation::run(plan, sphere, progress).map(Results::Indentation),
        PlanKind::Laws(several) => laws::run(plan, several, progress).map(Results::Laws),
        PlanKind::Limit(limit) => run_limit(plan, limit, progress).map(Results::Limit),
        PlanKind::Precision(all) => precision::run(plan, all, progress).map(Results::Precision),
        PlanKind::Stability(scenes) => Ok(Results::Stability(stability::run(plan, scenes, progress))),
        PlanKind::Surfaces(surfaces) => look(plan, surfaces, progress).map(Results::Surfaces),
    }
}

pub(super) fn run_compare(
    plan: &Plan,
    compare: &ComparePlan,
    counter: &Counter,
    progress: &dyn Progress,
) -> Result<CompareResults, InputError> {
    let start = Instant::now();
    let mut timing = Timing::default();
    let mut papers = papers_of(&compare.laws);
    let realisations = compare.surfaces.iter().map(|surface| surface.realisations as u64);
    progress.stage(&plan.title, realisations.sum());
    let mut files = files_of(&compare.surfaces, counter);
    let mut surfaces = Vec::new();
    for surface in &compare.surfaces {
        let mut factory = surface.factory(&plan.source, plan.seed, counter);
        let first_surface = factory.make(1, AnalysisDepth::Spectrum, &mut files, &mut timing)?;
        let models = models_of(compare, &first_surface, &mut timing);
        let first = run_surface(plan, compare, &first_surface, &models, counter, &mut timing)?;
        let thresholds = threshold::thresholds(compare, &first_surface, &models, &first, counter);
        let falls = falls(compare, &first_surface, &models, &first, counter);
        drop(models);
        progress.advance(1);
        let mut others = Vec::new();
        for realisation in 2..=surface.realisations {
            let surface = factory.make(realisation, AnalysisDepth::Asperities, &mut files, &mut timing)?;
            let models = models_of(compare, &surface, &mut timing);
            others.push(run_surface(plan, compare, &surface, &models, counter, &mut timing)?);
            progress.advance(1);
        }
        papers.extend(first_surface.papers());
        surfaces.push(SurfaceResults { surface: first_surface, first, others, thresholds, falls });
    }
    timing.total = start.elapsed();
    let mut layer_metadata = None;
    if let Some(layer) = &compare.layer {
        let mut check = None;
        if compare.uses_rule(layer) {
            let (findings, rules) =
                rule_check(compare, layer).map_err(|error| InputError::file(&plan.source.path, error))?;
            papers.extend(rules);
            check = Some(findings);
        }
        layer_metadata = Some(LayerMetadata {
            name: layer.name.clone(),
            rule: layer.rule,
            thicknesses: layer.thicknesses.clone(),
            check,
        });
    }
    let contact = contact_metadata(plan, &compare.laws, &compare.bodies, layer_metadata);
    let tolerances = compare.controls.tolerances;
    let metadata = metadata(plan, papers, timing, Some(counter.work()));
    Ok(CompareResults { metadata, contact, tolerances, surfaces })
}

/// Looks at surfaces as closely as can be.
fn look(
    plan: &Plan,
    surfaces: &[SurfacePlan],
    progress: &dyn Progress,
) -> Result<SurfacesResults, InputError> {
    let start = Instant::now();
    let mut timing = Timing::default();
    progress.stage(&plan.title, surfaces.len() as u64);
    let counter = Counter::default();
    let mut files = files_of(surfaces, &counter);
    let mut seen = Vec::new();
    for surface in surfaces {
        let mut factory = surface.factory(&plan.source, plan.seed, &counter);
        seen.push(factory.make(1, AnalysisDepth::Everything, &mut files, &mut timing)?);
        progress.advance(1);
    }
    timing.total = start.elapsed();
    let papers = seen.iter().flat_map(Surface::papers).collect();
    let words = plan.source.is_command_line().then(|| plan.source.text.clone());
    let file = plan.looked_at(surfaces);
    let metadata = metadata(plan, papers, timing, Some(counter.work()));
    Ok(SurfacesResults { metadata, file, words, surfaces: seen })
}

/// The files of surfaces that are made one after the other.
fn files_of<'a>(surfaces: &[SurfacePlan], counter: &'a Counter) -> Files<'a> {
    Files::new(surfaces.iter().filter_map(SurfacePlan::reading).collect(), counter)
}

/// Both models on a surface, its asperities as the laws see them.
fn models_of<'a>(compare: &ComparePlan, surface: &'a Surface, timing: &mut Timing) -> SurfaceModels<'a> {
    let start = Instant::now();
    let population = surface.population(compare.heights, compare.mean_radius);
    let is_summed = compare.models.contains(&Kind::Deterministic);
    let models = SurfaceModels::new(surface, population, &compare.law_specs, is_summed);
    timing.deterministic += start.elapsed();
    models
}

fn run_surface(
    plan: &Plan,
    compare_plan: &ComparePlan,
    surface: &Surface,
    models: &SurfaceModels,
    counter: &Counter,
    timing: &mut Timing,
) -> Result<RealisationResults, InputError> {
    let asked = |kind| compare_plan.models.contains(&kind);
    let population = models.population();
    let area = surface.set.nominal_area();
    let mut cases = Vec::new();
    for law in &compare_plan.laws {
        let contact = &Counted::new(&*law.contact, counter);
        let statistical = asked(Kind::Statistical).then(|| models.statistical(contact, &law.spec));
        let deterministic = models.deterministic(contact, &law.spec);
        let models = Models {
            statistical: statistical.as_ref().map(|model| model as &dyn Model),
            deterministic: deterministic.as_ref().map(|model| model as &dyn Model),
        };
        let comparison = compare(models, &compare_plan.controls, area)
            .map_err(|error| unreachable_load(plan, compare_plan, &surface.name, law, &error))?;
        timing.statistical += comparison.statistical_time;
        timing.deterministic += comparison.deterministic_time;
        cases.push(CaseResults {
            law: law.label.clone(),
            thickness: law.thickness,
            plasticity_index: plasticity_index(contact, population.sigma, population.radius),
            gaps: Gaps::of(&comparison.pairs, area, surface.plane.sigma),
            comparison,
        });
    }
    Ok(RealisationResults {
        asperities: surface.set.count(),
        nominal_area: area,
        statistics: surface.statistics,
        sigma: surface.plane.sigma,
        moments: surface.map.as_ref().map(|map| map.character.moments),
        population,
        cases,
    })
}

/// Where area or load of the sharpest asperity, of one of the mean radius and of the bluntest falls, as deep as the
/// highest asperity is pressed.
fn falls(
    plan: &ComparePlan,
    surface: &Surface,
    models: &SurfaceModels,
    answered: &RealisationResults,
    counter: &Counter,
) -> Vec<FallResults> {
    /// The first indentation that is looked at, of the deepest.
    const SHALLOWEST: f64 = 1e-4;
    let extremes = |values: &[f64]| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        values.iter().fold(ends, |(low, high), &value| (low.min(value), high.max(value)))
    };
    let highest = extremes(surface.set.heights()).1 - surface.plane.mean;
    let mut found = Vec::new();
    let cases: Vec<_> = plan.laws.iter().zip(&answered.cases).collect();
    // Laws that see the same asperities, whatever the layer.
    for alike in cases.chunk_by(|a, b| a.0.spec.summit == b.0.spec.summit) {
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
            let contact = Counted::new(&*law.contact, counter);
            for &shape in &shapes {
                let falls = Curve::of(&contact, shape, &[SHALLOWEST * deepest, deepest]).falls;
                found.extend(falls.into_iter().map(|fall| FallResults {
                    law: case.law.clone(),
                    thickness: case.thickness,
                    radius: shape.radius,
                    fall,
                }));
            }
        }
    }
    found
}

/// Points at the sweep that asks for more than a model reaches.
fn unreachable_load(
    plan: &Plan,
    compare: &ComparePlan,
    surface: &str,
    law: &LawPlan,
    error: &NotReached,
) -> InputError {
    let layer =
        law.thickness.map_or_else(String::new, |t| format!(", layer of thickness {}", thickness_words(t)));
    let message = format!("surface {surface}, law {}{layer}: {error}", law.label);
    let span = match error.control {
        Control::Pressure => compare.load_keys[0].clone(),
        Control::Force => compare.load_keys[1].clone(),
        Control::Separation => None,
    };
    match span {
        Some(span) => plan.source.error_at(span, message),
        None => InputError::file(&plan.source.path, message),
    }
}

fn run_limit(plan: &Plan, limit: &LimitPlan, progress: &dyn Progress) -> Result<LimitResults, InputError> {
    let start = Instant::now();
    let mut timing = Timing::default();
    let counter = Counter::default();
    let contacts: Vec<Counted> = limit.laws.iter().map(|law| Counted::new(&*law.contact, &counter)).collect();
    let integrals = Instant::now();
    let laws = limit.laws.iter().zip(&contacts);
    let cases: Vec<LimitCase> = laws
        .map(|(law, contact)| LimitCase {
            law: law.label.clone(),
            contact,
            exact: limit.separations.iter().map(|&h| exact(law, contact, limit.population, h)).collect(),
        })
        .collect();
    timing.statistical = integrals.elapsed();

    let sets = (limit.draws + 1) as u64;
    progress.stage(&plan.title, limit.counts.iter().map(|&count| count as u64 * sets).sum());
    let sums = Instant::now();
    let seed = |count, draw| stream_seed(plan.seed, &format!("limit {count} {draw}"));
    let points = convergence(&cases, &limit.population, &limit.counts, limit.draws, seed, |count| {
        counter.add(Item::Surfaces, 1);
        progress.advance(count as u64);
    })
    .map_err(|error| InputError::file(&plan.source.path, error))?;
    timing.deterministic = sums.elapsed();
    timing.total = start.elapsed();
    Ok(LimitResults {
        metadata: metadata(plan, papers_of(&limit.laws), timing, Some(counter.work())),
        contact: contact_metadata(plan, &limit.laws, &limit.bodies, None),
        population: limit.population,
        plasticity_index: plasticity_index(
            &*limit.laws[0].contact,
            limit.population.sigma,
            limit.population.radius,
        ),
        laws: limit.laws.iter().map(|law| (law.label.clone(), reference(law))).collect(),
        separations: limit.separations.clone(),
        draws: limit.draws,
        points,
    })
}

fn reference(law: &LawPlan) -> &'static str {
    if law.spec.is_greenwood_williamson() {
        "the closed form of Greenwood and Williamson"
    } else {
        "the statistical integral"
    }
}

/// The limit at d/sigma = `h`: Greenwood and Williamson's closed form for Hertz, else the integral.
fn exact(law: &LawPlan, contact: &dyn MicroContact, population: Population, h: f64) -> Exact {
    let Population { radius, sigma, density, .. } = population;
    let integral = Statistical::new(contact, population).respond(h);
    let limit = Exact::of_integral(integral, density);
    if !law.spec.is_greenwood_williamson() {
        return limit;
    }
    let modulus = contact.reference_modulus();
    Exact {
        area_ratio: std::f64::consts::PI * density * radius * sigma * gaussian_moment(1.0, h),
        pressure: 4.0 / 3.0 * density * modulus * radius.sqrt() * sigma.powf(1.5) * gaussian_moment(1.5, h),
        ..limit
    }
}

pub(super) fn papers_of(laws: &[LawPlan]) -> Vec<Paper> {
    let models = [literature::PASARIBU_SCHIPPER_2005, literature::ZHAO_MAIETTA_CHANG_2000];
    laws.iter().flat_map(papers_of_law).chain(models).collect()
}

/// The papers behind one law.
pub(super) fn papers_of_law(law: &LawPlan) -> Vec<Paper> {
    law.contact.papers().into_iter().chain(law.spec.papers().iter().copied()).collect()
}

pub(super) fn metadata(plan: &Plan, mut papers: Vec<Paper>, timing: Timing, work: Option<Work>) -> Metadata {
    papers.sort_by_key(|paper| paper.short);
    papers.dedup();
    Metadata {
        title: plan.title.clone(),
        stem: plan.stem.clone(),
        notes: plan.notes.clone(),
        spec_sha256: hexadecimal(&digest(plan.source.text.as_bytes())),
        seed: plan.seed,
        papers,
        timing,
        work,
    }
}

/// How good both rules are between the materials of a comparison.
fn rule_check(compare: &ComparePlan, layer: &LayerPlan) -> Result<(RuleFindings, Vec<Paper>), ContactError> {
    /// a/t, from and to.
    const RANGE: [f64; 2] = [0.1, 10.0];
    let [rough, flat] = &compare.pair;
    let check = RuleCheck::new(rough, &layer.material, flat)?;
    Ok((check.findings(RANGE[0], RANGE[1]), check.papers()))
}

/// Bodies of which laws that take the hardness and one that takes the yield strength make two different ones.
fn apart_in_strength(
    plan: &Plan,
    laws: &[LawPlan],
    bodies: &Bodies,
    layer: Option<&LayerMetadata>,
) -> Vec<String> {
    /// H/Y of metals; Chang, Etsion and Bogy (1987) take 2.8.
    const METALS: [f64; 2] = [2.0, 4.0];
    let takes = |property| laws.iter().any(|law| law.spec.takes() == Some(property));
    if !(takes(Property::Hardness) && takes(Property::YieldStrength)) {
        return Vec::new();
    }
    let names = [Some(&bodies.rough), Some(&bodies.flat), layer.map(|layer| &layer.name)];
    let caveat = |name: &String| {
        let body = plan.materials.get(name)?;
        let ratio = body.hardness()? / body.yield_strength()?;
        let [from, to] = METALS;
        (!(from..=to).contains(&ratio)).then(|| {
            format!(
                "{name}: the hardness is {ratio:.2} times the yield strength, where metals have {from} to {to}: laws that take the one \
                 and laws that take the other speak of different bodies"
            )
        })
    };
    names.into_iter().flatten().filter_map(caveat).collect()
}

pub(super) fn contact_metadata(
    plan: &Plan,
    laws: &[LawPlan],
    bodies: &Bodies,
    layer: Option<LayerMetadata>,
) -> ContactMetadata {
    // Every law of an experiment stands on the same two bodies.
    let contact = &laws[0].contact;
    let mut caveats: Vec<String> = laws.iter().filter_map(|law| law.contact.caveat()).collect();
    caveats.extend(apart_in_strength(plan, laws, bodies, layer.as_ref()));
    caveats.sort_unstable();
    caveats.dedup();
    ContactMetadata {
        materials: plan.materials.clone(),
        bodies: bodies.clone(),
        reduced_modulus: contact.reference_modulus(),
        hardness: Some(contact.reference_hardness()).filter(|hardness| hardness.is_finite()),
        layer,
        caveats,
    }
}
