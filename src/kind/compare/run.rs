//! Running `[compare]`: both models, and the reference, on every realisation of every surface, under every law and thickness.

use std::time::Instant;

use asperity::bem::{Boundary, Solver};
use asperity::compare::{AgainstReference, CaseSampling, Control, Controls, ModelKind, Models, compare};
use asperity::spot::{Joint, SpotProperties};
use asperity::study::{
    CaseResults, CaseStudy, LawFindings, LayerQuestion, RealisationResults, Setup, SurfaceModels, attribute,
    decreases, differ, film_friction, greenwood_tripp_curves, models_of, rank, run_surface, sampling,
    shortcuts, thresholds,
};
use asperity::surface::{AnalysisDepth, PreparedMap, Surface};
use asperity::work::Counter;
use asperity::{Heights, LOWEST_SEPARATION, MicroContact, Model, Paper, Response, literature};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{Timing, contact_metadata, papers_of};

use super::contact_map::{ContactMap, Covered};
use super::correlations::Formula;
use super::reference::{ContactView, ReferenceRun};
use super::results::{CompareResults, Described, ReferenceMetadata, SurfaceResults, treatments};
use super::spec::{ComparePlan, Scope, thinned};
use crate::layer::LayerPlan;
use crate::plausibility;
use crate::study_plan::{inapplicable, layer_metadata, unreachable_load};
use crate::surface::{Files, SurfaceFactory, SurfacePlan, by_hand, files_of, points_per_wave_on};

/// Runs a comparison and counts its work.
pub fn run(
    context: &RunContext,
    compare: &ComparePlan,
    counter: &Counter,
) -> Result<CompareResults, InputError> {
    run_within(context, compare, counter, Scope::default())
}

pub fn run_within(
    context: &RunContext,
    compare: &ComparePlan,
    counter: &Counter,
    scope: Scope,
) -> Result<CompareResults, InputError> {
    let start = Instant::now();
    let Ran { results: surfaces, mut timing, mut papers } =
        surfaces_within(context, compare, counter, scope, |results| results)?;
    timing.total = start.elapsed();
    let layer_metadata = layer_metadata(context, &compare.study, &mut papers)?;
    let contact =
        contact_metadata(context.materials, &compare.study.laws, &compare.study.bodies, layer_metadata);
    let mut implausible = compare.study.implausible.clone();
    implausible.extend(
        surfaces.iter().flat_map(|results| {
            plausibility::of_made(&results.surface, compare.study.statistical.mean_radius)
        }),
    );
    let is_unfiltered = |plan: &&SurfacePlan| plan.is_measured() && plan.points_per_wave().is_none();
    let on_map = |(plan, results): (&SurfacePlan, &SurfaceResults)| {
        let map = results.surface.map.as_ref().filter(|_| is_unfiltered(&plan))?;
        Some((plan.name.clone(), points_per_wave_on(map)))
    };
    implausible.extend(compare.reference.iter().find_map(|reference| {
        reference.warning(compare.study.surfaces.iter().zip(&surfaces).filter_map(on_map))
    }));
    implausible.extend(
        surfaces
            .iter()
            .filter_map(|results| plausibility::of_overlap(&results.surface.name, at_separations(results))),
    );
    let described = compare.described.as_ref();
    let fit = surfaces.first().and_then(|results| results.surface.fit.as_ref());
    let text = &context.source.text;
    let spec = fit.map_or_else(|| text.clone(), |fit| by_hand(text, fit));
    Ok(CompareResults {
        metadata: context.metadata(papers, timing, Some(counter.work())),
        spots: compare.study.laws[0].contact.spot_properties().cloned().unwrap_or_default(),
        contact,
        implausible,
        surfaces,
        lines: compare.lines.clone(),
        figures_of_paper: compare.figures_of_paper.clone(),
        reference: compare.reference.as_deref().filter(|_| scope.has_everything()).map(|reference| {
            ReferenceMetadata { refine: reference.refine, elastic: reference.elastic.clone() }
        }),
        described: described.map(|file| Described { file: file.clone(), spec }),
    })
}

/// The joint of a surface with a flat, for correlations; `None` without a map.
fn joint(surface: &Surface, contact: &dyn MicroContact) -> Option<Joint> {
    let roughness = &surface.map.as_ref()?.roughness;
    let (modulus, hardness) = (contact.reference_modulus(), contact.reference_hardness());
    Some(Joint::isotropic(roughness.moments.sq, roughness.rms_slope(), modulus, hardness))
}

/// The points at prescribed separations of all cases on the first realisation of a surface.
fn at_separations(results: &SurfaceResults) -> impl Iterator<Item = &Response> {
    let curves = results.cases.iter().flat_map(|case| &case.first().comparison.curves);
    curves.filter(|point| point.control == Control::Separation).map(|point| &point.response)
}

/// What was made of the results on each surface, and what all of them took.
pub struct Ran<T> {
    /// Surface by surface, in the order of the plan.
    pub results: Vec<T>,
    /// Of all surfaces.
    pub timing: Timing,
    /// References of laws, models, surfaces and solver.
    pub papers: Vec<Paper>,
}

/// Runs a comparison surface by surface, and keeps what `keep` makes of the results on each.
pub fn each_surface<T>(
    context: &RunContext,
    compare: &ComparePlan,
    counter: &Counter,
    keep: impl Fn(Result<SurfaceResults, InputError>) -> Result<T, InputError>,
) -> Result<Ran<T>, InputError> {
    surfaces_within(context, compare, counter, Scope::default(), keep)
}

fn surfaces_within<T>(
    context: &RunContext,
    compare: &ComparePlan,
    counter: &Counter,
    scope: Scope,
    keep: impl Fn(Result<SurfaceResults, InputError>) -> Result<T, InputError>,
) -> Result<Ran<T>, InputError> {
    let realisations = compare.study.surfaces.iter().map(|surface| scope.realisations(surface) as u64);
    context.progress.steps(realisations.sum());
    let controls = scope.has_intervals().then_some(&compare.study.controls);
    let thin = thinned(&compare.study.controls);
    let setup = compare.setup(context);
    let setup = Setup {
        controls: controls.unwrap_or(&thin),
        is_attributed: setup.is_attributed && scope.has_intervals(),
        is_ranked: setup.is_ranked && scope.has_intervals(),
        ..setup
    };
    let mut run = Run {
        context,
        compare,
        scope,
        setup,
        counter,
        files: files_of(&compare.study.surfaces, counter),
        timing: Timing::default(),
        papers: papers_of(&compare.study.laws),
    };
    let surfaces = compare.study.surfaces.iter();
    let results: Result<Vec<T>, InputError> = surfaces.map(|surface| keep(run.surface(surface))).collect();
    let results = results?;
    let Run { timing, mut papers, .. } = run;
    if let Some(reference) = compare.reference.as_deref().filter(|_| scope.has_everything()) {
        papers.extend(Solver::papers(reference.solutions.iter().any(|solution| solution.cap.is_some())));
    }
    papers.extend(compare.lines.iter().map(|line| line.paper()));
    if compare
        .study
        .laws
        .iter()
        .any(|law| law.contact.spot_properties().is_some_and(SpotProperties::conducts))
    {
        let reference = compare.reference.as_deref();
        let mut planned = compare.study.surfaces.iter();
        let is_finite = reference
            .is_some_and(|reference| planned.any(|surface| reference.boundary(surface) == Boundary::Finite));
        let formulas = Formula::ALL.into_iter().filter(|one| is_finite || *one != Formula::Cluster);
        papers.extend(formulas.map(Formula::paper));
        papers.push(literature::BARBER_2003);
    }
    Ok(Ran { results, timing, papers })
}

struct Run<'a> {
    context: &'a RunContext<'a>,
    compare: &'a ComparePlan,
    scope: Scope<'a>,
    setup: Setup<'a>,
    counter: &'a Counter,
    files: Files<'a>,
    timing: Timing,
    papers: Vec<Paper>,
}

/// Points of a map that a picture of its contacts is made of.
const MOST_POINTS_OF_PICTURE: usize = 1 << 22;

/// What only the first realisation of a surface gives.
struct Sampled {
    samplings: Vec<CaseSampling>,
    is_viewed: bool,
}

impl<'a> Run<'a> {
    /// All realisations of a surface, with what follows from them.
    fn surface(&mut self, plan: &'a SurfacePlan) -> Result<SurfaceResults, InputError> {
        let (context, compare, scope) = (self.context, self.compare, self.scope);
        let factory = SurfaceFactory::new(plan, context, self.counter).with_store(scope.store);
        // A picture of few cases needs the map; a large one is not brought into memory for it.
        let has_picture = factory.preparation().is_some()
            && [compare.study.surfaces.len(), plan.realisations] == [1; 2]
            && compare.study.laws.len() <= scope.pictures
            && plan.map_points().is_some_and(|[nx, ny]| nx * ny <= MOST_POINTS_OF_PICTURE);
        let mut factory = factory
            .keeping_map(compare.reference.is_some() || has_picture)
            .of_any(compare.models.is_empty() || compare.described.is_some());
        let mut surface = factory.make(1, compare.depth(), &mut self.files, &mut self.timing)?;
        if surface.unscattered.is_some() {
            self.setup.models = &[];
        }
        let setup = self.setup;
        let models = self.models(&surface)?;
        let mut first = self.both_models(&surface, &models)?;
        let start = Instant::now();
        let find = || sampling(setup, &surface, &models, &first.cases);
        let samplings = match scope.samplings {
            _ if !scope.has_intervals() => vec![CaseSampling::default(); setup.laws.len()],
            Some(known) => known.of(&plan.name, find),
            None => find(),
        };
        differ(&mut first.cases, &samplings, setup.laws, &models);
        attribute(setup, &surface, &models, &mut first.cases, plan.is_one());
        self.timing.sampling += start.elapsed();
        let [bare, _] = compare.study.bare_and_coated();
        let layer = compare
            .study
            .layer
            .as_deref()
            .map(|LayerPlan { coating, thicknesses, .. }| LayerQuestion { coating, thicknesses, bare });
        let thresholds = layer
            .filter(|layer| {
                layer.thicknesses != [0.0] && scope.has_intervals() && surface.unscattered.is_none()
            })
            .map_or_else(Vec::new, |layer| thresholds(layer, setup, &surface, &models, &first, self.counter));
        let friction = layer.zip(compare.study.film.as_ref()).map_or_else(Vec::new, |(layer, film)| {
            film_friction(layer, film, setup, &surface, &models, &first)
        });
        let decreases = if scope.has_intervals() && surface.unscattered.is_none() {
            decreases(setup.laws, &surface, &models, &first, self.counter)
        } else {
            Vec::new()
        };
        let heights = &models.population().heights;
        if *heights != Heights::GAUSSIAN {
            self.papers.extend(heights.papers());
        }
        drop(models);
        let prepared = surface.prepared.take();
        let sampled = Sampled { samplings, is_viewed: true };
        let (contacts, covered) =
            self.reference(plan, &surface, prepared.as_ref(), &mut first.cases, &sampled)?;
        let treatments = scope
            .has_everything()
            .then(|| treatments(context, compare, &factory, &surface, &first.cases, self.counter))
            .flatten();
        context.progress.step();
        let mut realisations = vec![first];
        for number in 2..=scope.realisations(plan) {
            realisations.push(self.realisation(plan, &mut factory, number)?);
            context.progress.step();
        }
        self.papers.extend(surface.papers());
        self.papers.extend(compare.study.statistical.papers());
        let (realisations, mut cases) =
            CaseStudy::all(&surface, realisations, compare.study.accept.on(surface.plane.sigma));
        let rankings = rank(setup, &surface, &cases);
        let ranked = rankings.first().map_or(&[][..], |ranking| &ranking.models);
        self.papers.extend(ranked.iter().flat_map(|ranked| ranked.model.papers()));
        for (case, ranking) in cases.iter_mut().zip(rankings) {
            case.ranking = Some(ranking).filter(|ranking| !ranking.models.is_empty());
        }
        let found = shortcuts(setup, &surface, &cases);
        let curves = greenwood_tripp_curves(setup, &surface);
        if curves.iter().any(|curve| !curve.is_empty()) {
            self.papers.push(literature::GREENWOOD_TRIPP_1971);
        }
        for (case, (found, curve)) in cases.iter_mut().zip(found.into_iter().zip(curves)) {
            (case.shortcuts, case.greenwood_tripp) = (found, curve);
        }
        let own_cut_off =
            treatments.map(|treatments| treatments.judge(&mut cases, &surface, compare.study.accept));
        let laws = LawFindings::all(&cases, &thresholds);
        let contact_maps = prepared.filter(|_| has_picture).map_or_else(Vec::new, |prepared| {
            // The reference has one picture, of its first case.
            let covered = if cases.len() == 1 { &covered[..] } else { &[] };
            let cases = cases.iter().zip(setup.laws);
            // Beside the reported one.
            let loads = if scope.has_intervals() { 16 } else { 3 };
            cases.map(|(case, law)| ContactMap::new(&surface, &prepared, case, law, covered, loads)).collect()
        });
        Ok(SurfaceResults {
            contact_maps,
            load_area: setup.load_area(&surface),
            spots: setup.laws[0].contact.spot_properties().cloned().unwrap_or_default(),
            joint: joint(&surface, &*setup.laws[0].contact),
            surface,
            realisations,
            cases,
            laws,
            friction,
            thresholds,
            decreases,
            own_cut_off,
            contacts,
        })
    }

    /// Another realisation of a surface; the scatter of all is the error of each.
    fn realisation(
        &mut self,
        plan: &'a SurfacePlan,
        factory: &mut SurfaceFactory,
        number: usize,
    ) -> Result<RealisationResults, InputError> {
        let setup = self.setup;
        let mut surface =
            factory.make(number, AnalysisDepth::Asperities, &mut self.files, &mut self.timing)?;
        let models = self.models(&surface)?;
        let mut realisation = self.both_models(&surface, &models)?;
        let samplings = vec![CaseSampling::default(); setup.laws.len()];
        differ(&mut realisation.cases, &samplings, setup.laws, &models);
        attribute(setup, &surface, &models, &mut realisation.cases, false);
        drop(models);
        let prepared = surface.prepared.take();
        let sampled = Sampled { samplings: Vec::new(), is_viewed: false };
        self.reference(plan, &surface, prepared.as_ref(), &mut realisation.cases, &sampled)?;
        Ok(realisation)
    }

    fn models<'s>(&mut self, surface: &'s Surface) -> Result<SurfaceModels<'s>, InputError> {
        models_of(self.setup, surface, &mut self.timing)
            .map_err(|error| inapplicable(self.context, &self.compare.study, &surface.name, &error))
    }

    fn both_models(
        &mut self,
        surface: &Surface,
        models: &SurfaceModels,
    ) -> Result<RealisationResults, InputError> {
        run_surface(self.setup, surface, models, self.counter, &mut self.timing).map_err(|(law, error)| {
            unreachable_load(self.context, &self.compare.study, &surface.name, law, &error)
        })
    }

    /// Adds the reference to the cases of a surface with its prepared map, and how far both models are from it. Gives a view of each
    /// contact, and what is in contact at each load, where they are viewed. Nothing where no reference is asked for.
    fn reference(
        &mut self,
        plan: &'a SurfacePlan,
        surface: &Surface,
        prepared: Option<&PreparedMap>,
        cases: &mut [CaseResults],
        sampled: &Sampled,
    ) -> Result<(Vec<ContactView>, Vec<Covered>), InputError> {
        let compare = self.compare;
        let reference = compare.reference.as_deref().filter(|_| self.scope.has_everything());
        let Some((reference, prepared)) = reference.zip(prepared) else {
            return Ok(Default::default());
        };
        let run = ReferenceRun { reference, compare, plan, surface, prepared, is_viewed: sampled.is_viewed };
        let views = run.run(self.context, cases, &mut self.timing)?;
        let none = CaseSampling::default();
        for (index, case) in cases.iter_mut().enumerate() {
            let Some(curve) = &case.reference else { continue };
            let sampling = sampled.samplings.get(index).unwrap_or(&none);
            let (pairs, differences) = (&case.comparison.pairs, &case.differences);
            case.against_reference =
                AgainstReference::new(pairs, differences, curve, sampling, surface.plane);
        }
        Ok(views)
    }
}

/// Refuses a load that a population or a list does not reach, as a run would; of several realisations the first is tried.
pub(super) fn check(context: &RunContext, plan: &ComparePlan) -> Result<(), InputError> {
    if plan.study.controls.pressures.is_empty() && plan.study.controls.forces.is_empty() {
        return Ok(());
    }
    let (counter, mut timing) = (Counter::default(), Timing::default());
    let mut files = files_of(&plan.study.surfaces, &counter);
    for surface in plan.study.surfaces.iter().filter(|surface| surface.has_given_asperities()) {
        let mut factory = SurfaceFactory::new(surface, context, &counter);
        let surface = factory.make(1, AnalysisDepth::Asperities, &mut files, &mut timing)?;
        let models = models_of(plan.setup(context), &surface, &mut timing)
            .map_err(|error| inapplicable(context, &plan.study, &surface.name, &error))?;
        let area = plan.setup(context).load_area(&surface);
        for law in &plan.study.laws {
            let statistical = plan
                .models
                .contains(&ModelKind::Statistical)
                .then(|| models.statistical(&*law.contact, &law.spec));
            let deterministic = models.deterministic(&*law.contact, &law.spec);
            let statistical = statistical.as_deref();
            let deterministic = deterministic.as_ref().map(|model| model as &dyn Model);
            for (model, alone) in [
                (statistical, Models { statistical, deterministic: None }),
                (deterministic, Models { statistical: None, deterministic }),
            ] {
                let Some(model) = model else { continue };
                compare(alone, &doubtful(&plan.study.controls, model, area), area)
                    .map_err(|error| unreachable_load(context, &plan.study, &surface.name, law, &error))?;
            }
        }
    }
    Ok(())
}

/// The loads above that at the lowest separation, which `model` reaches only if its load decreases on approach.
fn doubtful(controls: &Controls, model: &dyn Model, area: f64) -> Controls {
    let reached = model.respond(LOWEST_SEPARATION).pressure.total();
    let above = |loads: &[f64], per_area: f64| {
        loads.iter().copied().filter(|load| load * per_area > reached).collect()
    };
    Controls {
        separations: Vec::new(),
        pressures: above(&controls.pressures, 1.0),
        forces: above(&controls.forces, area.recip()),
    }
}
