//! Running `[sampling-interval]`: both models on each surface at every sampling interval and under every S filter.

use std::time::Instant;

use asperity::compare::{CaseSampling, Division, Pair, Pairing};
use asperity::plasticity_index;
use asperity::topography::{Filter, Rows, Sampled};
use asperity::work::Counter;
use asperity::{HeightMap, Statistics};
use asperity_framework::RunContext;
use asperity_framework::contact::{contact_metadata, papers_of};
use asperity_framework::input::InputError;
use asperity_framework::metadata::Timing;
use asperity_framework::progress::Silent;

use super::plan::IntervalPlan;
use super::quantity::Quantity;
use super::results::{BlocksLeftOut, Found, IntervalResults, Scale, Series, SurfaceResults, Variation};
use super::trend::{Point, Trend};
use crate::plausibility;
use crate::study::{Setup, StudyError, study};
use crate::surface::{AnalysisDepth, Independence, MapFacts, Surface, SurfaceFactory, files_of};
use asperity::compare::Accepted;

/// Runs it.
///
/// # Errors
/// A surface that cannot be made; a filter that a map does not hold.
pub(super) fn run(context: &RunContext, plan: &IntervalPlan) -> Result<IntervalResults, InputError> {
    let start = Instant::now();
    let (mut timing, counter) = (Timing::default(), Counter::default());
    let compare = &plan.compare;
    let mut papers = papers_of(&compare.laws);
    context.progress.steps(compare.surfaces.len() as u64);
    let mut files = files_of(&compare.surfaces, &counter);
    let mut surfaces = Vec::new();
    for surface in &compare.surfaces {
        let mut factory = SurfaceFactory::new(surface, context, &counter).keeping_map(true);
        let mut made = factory.make(1, AnalysisDepth::Comparison, &mut files, &mut timing)?;
        let prepared = made.prepared.take();
        papers.extend(made.papers());
        let setup = Setup { progress: &Silent, ..compare.setup(context) };
        context.progress.stage("intervals and filters", plan.scales() as f64);
        let mut series = Vec::new();
        let loads = sorted(&compare.controls.pressures);
        let accepted = compare.accept.on(made.plane.sigma);
        // Planned surfaces have a map, which is kept.
        if let Some((map, facts)) = prepared.as_ref().map(|prepared| &prepared.map).zip(made.map.as_ref()) {
            let varied =
                Varied { context, setup, factory: &factory, counter: &counter, facts, loads: &loads };
            let of_interval = plan.intervals.iter().map(|&every| varied.sampled(map, every));
            series.push(Series::new(Variation::Interval, of_interval.collect(), &loads, &accepted));
            if let Some(filters) = &plan.filters {
                let base = filters.base(map.pixel());
                let of_filter = |&multiple: &f64| {
                    let filtered = varied.filtered(map, multiple, base);
                    let refuse = |error| {
                        let message = format!("surface {}: {error}", surface.name);
                        context.source.error_at(filters.key.clone(), message)
                    };
                    filtered.map_err(refuse)
                };
                let scales: Result<Vec<Scale>, InputError> =
                    filters.multiples.iter().map(of_filter).collect();
                series.push(Series::new(Variation::Filter, scales?, &loads, &accepted));
                papers.push(asperity::literature::ISO_16610_61);
            }
        }
        context.progress.step();
        surfaces.push(SurfaceResults { surface: made, loads, accepted, series });
    }
    timing.total = start.elapsed();
    let mut implausible = compare.implausible.clone();
    implausible.extend(surfaces.iter().flat_map(|found| {
        let Surface { name, statistics, set, .. } = &found.surface;
        plausibility::of_surface(name, statistics.mean_radius, statistics.sigma, set.nominal_area())
    }));
    Ok(IntervalResults {
        metadata: context.metadata(papers, timing, Some(counter.work())),
        contact: contact_metadata(context.materials, &compare.laws, &compare.bodies, None),
        implausible,
        law: compare.laws[0].label.clone(),
        surfaces,
    })
}

fn sorted(loads: &[f64]) -> Vec<f64> {
    let mut loads = loads.to_vec();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    loads
}

/// A prepared map, to be varied.
struct Varied<'a> {
    context: &'a RunContext<'a>,
    setup: Setup<'a>,
    factory: &'a SurfaceFactory<'a>,
    counter: &'a Counter,
    facts: &'a MapFacts,
    loads: &'a [f64],
}

impl Varied<'_> {
    /// Every so many points of the map.
    fn sampled(&self, map: &HeightMap, every: usize) -> Scale {
        let length = every as f64 * map.pixel()[0].max(map.pixel()[1]);
        let found = self.found(&Sampled { map, every });
        Scale { multiple: every as f64, length, found }
    }

    /// The map under an S filter of `multiple` times `base` (m).
    fn filtered(
        &self,
        map: &HeightMap,
        multiple: f64,
        base: f64,
    ) -> Result<Scale, asperity::topography::FilterError> {
        let length = multiple * base;
        let filtered = Filter::new(Some(length), None)?.apply(map)?;
        Ok(Scale { multiple, length, found: self.found(&filtered) })
    }

    fn found(&self, map: &dyn Rows) -> Result<Found, String> {
        let surface = self.factory.derived(map, self.facts);
        let found = surface.map_or_else(
            || Err("no summit is left, or all are equally high".to_owned()),
            |surface| self.compared(&surface),
        );
        self.context.progress.advance(1.0);
        found
    }

    /// Both models on one variant.
    fn compared(&self, surface: &Surface) -> Result<Found, String> {
        let (realisation, samplings) =
            study(self.setup, surface, true, self.counter).map_err(|error| match error {
                StudyError::Inapplicable(error) => error.to_string(),
                StudyError::NotReached(_, error) => error.to_string(),
            })?;
        let mut cases = realisation.cases;
        let case = cases.swap_remove(0);
        let at_load = |&load: &f64| {
            let is_there = |pair: &&Pair| pair.pairing == Pairing::Load && pair.target == load;
            case.comparison.pairs.iter().find(is_there).copied()
        };
        let place = |&load: &f64| case.differences.iter().position(|at| at.load == load);
        let places: Vec<usize> = self.loads.iter().filter_map(place).collect();
        let blocks = match (&surface.independence, samplings.first()) {
            (Independence::Blocks(blocks), Some(CaseSampling { groups: Some(groups), .. })) => {
                let quantities = self.without_blocks(surface, &blocks.division);
                let at_loads = |states: &Vec<_>| places.iter().map(|&place| states[place]).collect();
                let states = groups.states.iter().map(at_loads).collect();
                Some(BlocksLeftOut { shares: groups.shares.clone(), quantities, states })
            }
            _ => None,
        };
        Ok(Found {
            asperities: surface.set.count(),
            density: surface.set.density(),
            statistics: surface.reported_statistics(),
            sigma: surface.plane.sigma,
            alpha: surface.map.as_ref().and_then(|map| map.roughness.alpha()),
            plasticity_index: case.plasticity_index,
            pairs: self.loads.iter().filter_map(at_load).collect(),
            differences: places.iter().map(|&place| case.differences[place].clone()).collect(),
            attributions: places.iter().filter_map(|&place| case.attribution.get(place).cloned()).collect(),
            blocks,
        })
    }

    /// The quantities of the asperities without each block.
    fn without_blocks(&self, surface: &Surface, division: &Division) -> Vec<[Option<f64>; Quantity::COUNT]> {
        let (contact, mean_radius) = (&*self.setup.laws[0].contact, self.setup.statistical.mean_radius);
        let set = &surface.set;
        division.for_each_group(|group| {
            let Some(set) = division.without(set, group) else { return [None; Quantity::COUNT] };
            let statistics = Statistics::of(&set);
            let index = plasticity_index(contact, statistics.sigma, mean_radius.of(&statistics));
            // The moments of the map are not known without a block.
            Quantity::ALL.map(|quantity| quantity.of_asperities(set.density(), &statistics, None, index))
        })
    }
}

impl Series {
    /// The trends of all quantities over `scales`, at each of the `loads` (Pa).
    fn new(variation: Variation, scales: Vec<Scale>, loads: &[f64], accepted: &Accepted) -> Self {
        let mut series = Self { variation, scales, trends: Vec::new() };
        for quantity in Quantity::ALL {
            let at = if quantity.is_at_load() { 0..loads.len() } else { 0..1 };
            let of_load = |load| series.trend_of(quantity, load, accepted);
            let trends: Vec<Trend> = at.filter_map(of_load).collect();
            series.trends.extend(trends);
        }
        series
    }

    /// From the finest scale to the coarsest at which the quantity is known without a gap.
    fn trend_of(&self, quantity: Quantity, load: usize, accepted: &Accepted) -> Option<Trend> {
        let point = |scale: &Scale| {
            let found = scale.found.as_ref().ok()?;
            let (value, without) = (found.value(quantity, load)?, found.without(quantity, load));
            Some(Point { length: scale.length, value, without })
        };
        let points: Vec<Point> = self.scales.iter().map_while(point).collect();
        let finest = self.scales.first()?.found.as_ref().ok()?;
        let shares = finest.blocks.as_ref().map_or(&[][..], |blocks| &blocks.shares);
        let load = quantity.is_at_load().then_some(load);
        Trend::of(quantity, load, &points, shares, quantity.tolerance(accepted))
    }
}
