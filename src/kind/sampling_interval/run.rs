//! Running `[sampling-interval]`: both models on each surface at every sampling interval and under every S filter.

use std::time::Instant;

use asperity::compare::{CaseSampling, Division, LeftOut};
use asperity::study::{Setup, StudyError, study};
use asperity::surface::{AnalysisDepth, Independence, Surface};
use asperity::topography::{Filter, FilterError, Rows, Sampled, Watched};
use asperity::work::Counter;
use asperity::{AsperitySet, HeightMap, Statistics, literature, plasticity_index};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{Timing, contact_metadata, papers_of};
use asperity_contact_framework::progress::{Named, Progress};

use super::IntervalPlan;
use super::results::{
    Asperities, BlocksLeftOut, IntervalResults, Scale, ScaleResults, Series, SurfaceResults, Variation,
};
use crate::plausibility;
use crate::study_plan::StudyPlan;
use crate::surface::{SurfaceFactory, files_of};

pub(super) fn run(context: &RunContext, plan: &IntervalPlan) -> Result<IntervalResults, InputError> {
    let start = Instant::now();
    let (mut timing, counter) = (Timing::default(), Counter::default());
    let study = &plan.study;
    let mut papers = papers_of(&study.laws);
    papers.extend((!plan.multiples.is_empty()).then_some(literature::ISO_16610_61));
    context.progress.steps(study.surfaces.len() as u64);
    let mut files = files_of(&study.surfaces, &counter);
    let mut surfaces = Vec::new();
    for surface in &study.surfaces {
        let mut factory = SurfaceFactory::new(surface, context, &counter).keeping_map(true);
        let mut made = factory.make(1, AnalysisDepth::Comparison, &mut files, &mut timing)?;
        papers.extend(made.papers());
        let mut series = Vec::new();
        // Planned surfaces have a map, which is kept.
        if let Some(prepared) = made.prepared.take() {
            let (factory, counter, surface) = (&factory, &counter, &made);
            let variants = Variants { context, plan, factory, counter, surface, map: &prepared.map };
            series = variants.series().map_err(|error| {
                let message = format!("surface {}: {error}", made.name);
                context.source.error_at(plan.filter_key.clone(), message)
            })?;
        }
        context.progress.step();
        surfaces.push(SurfaceResults { surface: made, series });
    }
    timing.total = start.elapsed();
    let mut implausible = study.implausible.clone();
    implausible.extend(
        surfaces
            .iter()
            .flat_map(|results| plausibility::of_made(&results.surface, study.statistical.mean_radius)),
    );
    Ok(IntervalResults {
        metadata: context.metadata(papers, timing, Some(counter.work())),
        contact: contact_metadata(context.materials, &study.laws, &study.bodies, None),
        implausible,
        law: study.laws[0].label.clone(),
        loads: study.controls.pressures.clone(),
        surfaces,
    })
}

/// A surface with its prepared map, to be varied.
struct Variants<'a> {
    context: &'a RunContext<'a>,
    plan: &'a IntervalPlan,
    factory: &'a SurfaceFactory<'a>,
    counter: &'a Counter,
    surface: &'a Surface,
    map: &'a HeightMap,
}

impl Variants<'_> {
    fn series(&self) -> Result<Vec<Series>, FilterError> {
        let Self { plan: IntervalPlan { study, intervals, multiples, .. }, surface, .. } = self;
        let accepted = study.accept.on(surface.plane.sigma);
        let series = |variation, scales| {
            let series = Series { surface: surface.name.clone(), variation, scales, trends: Vec::new() };
            series.with_trends(&study.controls.pressures, &accepted)
        };
        let named = |number: usize| Named {
            name: format!("interval or filter {number} of {}", self.plan.scales()),
            progress: self.context.progress,
        };
        let each = |(&every, number)| self.sampled(every, &named(number));
        let sampled = intervals.iter().zip(1..).map(each).collect();
        let each = |(&multiple, number)| self.filtered(multiple, &named(number));
        let filtered: Result<Vec<Scale>, _> = multiples.iter().zip(intervals.len() + 1..).map(each).collect();
        let mut all = vec![series(Variation::Interval, sampled), series(Variation::Filter, filtered?)];
        all.retain(|series| !series.scales.is_empty());
        Ok(all)
    }

    /// Every so many points of the map.
    fn sampled(&self, every: usize, progress: &dyn Progress) -> Scale {
        let pixel = self.map.pixel();
        let length = every as f64 * pixel[0].max(pixel[1]);
        self.scale(every as f64, length, &Sampled { map: self.map, every }, progress)
    }

    /// The map under an S filter.
    fn filtered(&self, multiple: f64, progress: &dyn Progress) -> Result<Scale, FilterError> {
        let length = multiple * self.plan.nesting_index(self.map.pixel());
        let filter = Filter::new(Some(length), None)?;
        progress.stage("filtering", filter.work(self.map.pixel()));
        let filtered = filter.apply(&Watched { map: self.map, progress })?;
        Ok(self.scale(multiple, length, &filtered, progress))
    }

    fn scale(&self, multiple: f64, length: f64, map: &dyn Rows, progress: &dyn Progress) -> Scale {
        Scale { multiple, length, results: self.results(map, progress) }
    }

    /// Both models on a variant of the map.
    fn results(&self, map: &dyn Rows, progress: &dyn Progress) -> Result<ScaleResults, String> {
        let facts = self.surface.map.as_ref();
        let surface = facts.and_then(|facts| self.factory.derived(map, facts, progress));
        let surface = &surface.ok_or("no summit is left, or all are equally high")?;
        let setup = Setup { progress, generates: false, ..self.plan.study.setup(self.context) };
        let results = study(setup, surface, self.counter).map_err(|error| match error {
            StudyError::Inapplicable(error) => error.to_string(),
            StudyError::NotReached(_, error) => error.to_string(),
            error @ StudyError::NoEllipses(_) => error.to_string(),
        });
        let (mut realisation, samplings) = results?;
        let case = realisation.cases.swap_remove(0);
        let blocks = match (&surface.independence, samplings.into_iter().next()) {
            (Independence::Blocks(blocks), Some(CaseSampling { groups: Some(models), .. })) => {
                Some(self.without_blocks(surface, &blocks.division, models))
            }
            _ => None,
        };
        let asperities = Asperities {
            density: surface.set.density(),
            statistics: surface.reported_statistics(),
            alpha: surface.map.as_ref().and_then(|map| map.roughness.alpha()),
            plasticity_index: case.plasticity_index,
        };
        Ok(ScaleResults { count: surface.set.count(), asperities, sigma: surface.plane.sigma, case, blocks })
    }

    fn without_blocks(&self, surface: &Surface, division: &Division, models: LeftOut) -> BlocksLeftOut {
        let StudyPlan { laws, statistical, .. } = &self.plan.study;
        let asperities = |set: &AsperitySet| {
            let statistics = Statistics::new(set);
            let plasticity_index = plasticity_index(
                &*laws[0].contact,
                statistics.sigma,
                statistical.mean_radius.radius(&statistics),
            );
            // The moments of the map are not known without a block.
            Asperities { density: set.density(), statistics, alpha: None, plasticity_index }
        };
        let rest = |group| division.without(&surface.set, group).as_ref().map(asperities);
        BlocksLeftOut { asperities: division.for_each_group(rest), models }
    }
}
