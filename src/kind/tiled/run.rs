//! Running `[tiled]`: sums over tiles, then the statistical model of the whole.

use std::ops::Range;

use asperity::study::LawContact;
use asperity::{AsperitySums, Deterministic, MeanRadius, Population, ReferencePlane, Total};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{contact_metadata, papers_of};
use asperity_contact_framework::{Divided, Outcome, RunContext};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::TiledPlan;
use super::results::{LawResults, TiledResults, TiledSurface, error_of_ratio};
use crate::plausibility;
use crate::study_plan::layer_metadata;
use crate::surface::{OpenTiles, SurfacePlan};

/// What is found in a tile or in several, added in their order.
#[derive(Serialize, Deserialize)]
struct TileSums {
    /// In the first pass.
    asperities: Option<AsperitySums>,
    /// Law by law, separation by separation, once the plane that separations are measured from is known.
    totals: Vec<Vec<Total>>,
    /// Nominal area of each tile, m^2, in the first pass.
    areas: Vec<f64>,
    /// Load (N) of each tile, by law and separation.
    loads: Vec<Vec<f64>>,
}

impl TileSums {
    fn merge(&mut self, part: &Self) {
        if let (Some(sums), Some(part)) = (&mut self.asperities, &part.asperities) {
            sums.merge(part);
        }
        for (totals, part) in self.totals.iter_mut().zip(&part.totals) {
            totals.iter_mut().zip(part).for_each(|(total, part)| total.merge(part));
        }
        self.areas.extend(&part.areas);
        self.loads.extend(part.loads.iter().cloned());
    }

    /// Notes area and loads of a tile, whose scatter gives a standard error.
    fn end_tile(&mut self) {
        self.areas.extend(self.asperities.map(|sums| sums.nominal_area()));
        self.loads = vec![self.totals.iter().flatten().map(|total| total.load().total()).collect()];
    }
}

/// As many tasks at most: what they find is moved and added in their order.
const MOST_TASKS: usize = 256;

impl Divided for TiledPlan {
    fn tasks(&self) -> usize {
        self.tiles.count.div_ceil(self.tiles_per_task())
    }

    /// Mean and sigma of a population are known; those of any other set take a pass of their own.
    fn passes(&self) -> usize {
        if self.surface().nominal().is_some() { 1 } else { 2 }
    }

    fn run_task(
        &self,
        context: &RunContext,
        task: usize,
        earlier: &[Vec<String>],
    ) -> Result<String, InputError> {
        let first = earlier.first().map(|first| read(context, first)).transpose()?;
        let found = self.pass(context, task..task + 1, first.as_deref())?;
        serde_json::to_string(&found).map_err(|error| unreadable(context, error))
    }

    fn results(&self, context: &RunContext, passes: &[Vec<String>]) -> Result<Box<dyn Outcome>, InputError> {
        let passes: Result<Vec<_>, _> = passes.iter().map(|pass| read(context, pass)).collect();
        Ok(Box::new(self.merged(context, &passes?)?))
    }
}

impl TiledPlan {
    fn tiles_per_task(&self) -> usize {
        self.tiles.count.div_ceil(MOST_TASKS).max(1)
    }

    /// Runs all tasks in this process.
    pub(super) fn run_here(&self, context: &RunContext) -> Result<TiledResults, InputError> {
        let mut passes: Vec<Vec<TileSums>> = Vec::new();
        for _ in 0..self.passes() {
            let found = self.pass(context, 0..self.tasks(), passes.first().map(Vec::as_slice))?;
            passes.push(found);
        }
        self.merged(context, &passes)
    }

    /// The sums over the tiles of each of some tasks, in the first pass or after it.
    fn pass(
        &self,
        context: &RunContext,
        tasks: Range<usize>,
        first: Option<&[TileSums]>,
    ) -> Result<Vec<TileSums>, InputError> {
        let open = self.tiles.open(self.surface(), context.source, context.seed, context.progress)?;
        let plane = match (self.surface().nominal(), first) {
            (Some((_, plane)), _) => Some(plane),
            (None, Some(first)) => Some(self.whole(context, first)?.plane),
            (None, None) => None,
        };
        let of_task = self.tiles_per_task();
        let end = self.tiles.count.min(tasks.end * of_task);
        let tiles = tasks.start * of_task..end;
        let name = format!("pass {} of {}", 1 + usize::from(first.is_some()), self.passes());
        context.progress.stage(&name, tiles.len() as f64);
        let mut tasks: Vec<TileSums> = Vec::new();
        for start in tiles.step_by(self.tiles.at_once()) {
            let some = start..end.min(start + self.tiles.at_once());
            for (tile, found) in
                some.clone().zip(self.some_tiles(&open, some.clone(), first.is_none(), plane)?)
            {
                match tasks.last_mut().filter(|_| tile % of_task != 0) {
                    Some(task) => task.merge(&found),
                    None => tasks.push(found),
                }
            }
            context.progress.advance(some.len() as f64);
        }
        Ok(tasks)
    }

    fn merged(&self, context: &RunContext, passes: &[Vec<TileSums>]) -> Result<TiledResults, InputError> {
        let [first, last] = [passes.first(), passes.last()].map(|pass| pass.map_or(&[][..], Vec::as_slice));
        let surface = self.whole(context, first)?;
        let points = self.separations().len();
        let totals = vec![vec![Total::default(); points]; self.study.laws.len()];
        let mut all = TileSums { asperities: None, totals, areas: Vec::new(), loads: Vec::new() };
        last.iter().for_each(|task| all.merge(task));
        let areas: Vec<f64> = first.iter().flat_map(|task| &task.areas).copied().collect();
        let of_tiles = |place: usize| all.loads.iter().map(|loads| loads[place]).collect::<Vec<f64>>();
        // Quantiles are in the order of their heights: their tiles are no sample.
        let is_sample = !self.surface().is_at_quantiles();
        let error = |place| error_of_ratio(&of_tiles(place), &areas).filter(|_| is_sample);
        let errors: Vec<Option<f64>> = (0..points * self.study.laws.len()).map(error).collect();
        let laws = self.study.laws.iter().zip(all.totals.iter().zip(errors.chunks(points)));
        let laws = laws.map(|(law, (totals, errors))| {
            LawResults::new(law, self.separations(), &surface, totals, errors.to_vec())
        });
        let mut papers = papers_of(&self.study.laws);
        papers
            .extend(self.surface().nominal().iter().flat_map(|(population, _)| population.heights.papers()));
        let layer = layer_metadata(context, &self.study, &mut papers)?;
        let mut implausible = self.study.implausible.clone();
        let TiledSurface { name, statistics, nominal_area, .. } = &surface;
        implausible.extend(plausibility::of_asperities(
            name,
            statistics.mean_radius,
            statistics.sigma,
            *nominal_area,
        ));
        Ok(TiledResults {
            laws: laws.collect(),
            implausible,
            contact: contact_metadata(context.materials, &self.study.laws, &self.study.bodies, layer),
            metadata: context.metadata(papers, Default::default(), None),
            surface,
        })
    }

    /// The sums over each of some tiles: their blocks side by side, added in their order, so that no bit depends on the threads.
    fn some_tiles(
        &self,
        open: &OpenTiles,
        tiles: Range<usize>,
        is_first: bool,
        plane: Option<ReferencePlane>,
    ) -> Result<Vec<TileSums>, InputError> {
        let blocks: Vec<(usize, usize)> =
            tiles.flat_map(|tile| open.blocks(tile).map(move |block| (tile, block))).collect();
        let found: Vec<Result<TileSums, InputError>> =
            blocks.par_iter().map(|&(tile, block)| self.block(open, tile, block, is_first, plane)).collect();
        let mut sums: Vec<TileSums> = Vec::new();
        let mut last = None;
        for (&(tile, _), found) in blocks.iter().zip(found) {
            match sums.last_mut().filter(|_| last == Some(tile)) {
                Some(sum) => sum.merge(&found?),
                None => sums.push(found?),
            }
            last = Some(tile);
        }
        sums.iter_mut().for_each(TileSums::end_tile);
        Ok(sums)
    }

    fn block(
        &self,
        open: &OpenTiles,
        tile: usize,
        block: usize,
        is_first: bool,
        plane: Option<ReferencePlane>,
    ) -> Result<TileSums, InputError> {
        let found = open.block(tile, block)?;
        let mut asperities = is_first.then(|| open.sums());
        if let Some(sums) = &mut asperities {
            match &found.set {
                Some(set) => sums.add(set),
                None => sums.add_area(found.nominal_area),
            }
        }
        let sums = |totals| TileSums { asperities, totals, areas: Vec::new(), loads: Vec::new() };
        let Some(plane) = plane else { return Ok(sums(Vec::new())) };
        let separations: Vec<f64> = self.separations().iter().map(|h| plane.mean + h * plane.sigma).collect();
        let of_law = |law: &LawContact| match &found.set {
            Some(set) => Deterministic::new(&*law.contact, set.spheres(), plane).totals(&separations),
            None => vec![Total::default(); separations.len()],
        };
        Ok(sums(self.study.laws.iter().map(of_law).collect()))
    }

    fn whole(&self, context: &RunContext, first: &[TileSums]) -> Result<TiledSurface, InputError> {
        let open = self.tiles.open(self.surface(), context.source, context.seed, context.progress)?;
        let mut sums = open.sums();
        first.iter().filter_map(|tile| tile.asperities.as_ref()).for_each(|tile| sums.merge(tile));
        let refuse = |message: &str| {
            let plan: &SurfacePlan = self.surface();
            context.source.error_at(plan.size_key.clone(), message)
        };
        let statistics = sums.statistics().ok_or_else(|| refuse("has no summit in any of its tiles"))?;
        if statistics.sigma == 0.0 {
            return Err(refuse(
                "has asperities of equal height: separations are measured in their standard deviation; allowed: asperities of different \
                 heights",
            ));
        }
        let own = Population {
            radius: MeanRadius::Arithmetic.radius(&statistics),
            sigma: statistics.sigma,
            density: sums.count() as f64 / sums.nominal_area(),
            heights: asperity::Heights::GAUSSIAN,
        };
        let (population, plane, population_mean) = match self.surface().nominal() {
            Some((population, plane)) => (population.clone(), plane, 0.0),
            None => (own, ReferencePlane::from(&statistics), statistics.mean_height),
        };
        Ok(TiledSurface {
            name: self.surface().name.clone(),
            tiles: self.tiles.count,
            count: sums.count(),
            nominal_area: sums.nominal_area(),
            origin: open.origin(),
            statistics,
            reporting_plane: ReferencePlane { mean: plane.mean - population_mean, sigma: plane.sigma },
            population,
            plane,
        })
    }
}

fn read(context: &RunContext, tasks: &[String]) -> Result<Vec<TileSums>, InputError> {
    let found: Result<Vec<Vec<TileSums>>, _> = tasks.iter().map(|text| serde_json::from_str(text)).collect();
    found.map(|found| found.into_iter().flatten().collect()).map_err(|error| unreadable(context, error))
}

fn unreadable(context: &RunContext, error: serde_json::Error) -> InputError {
    InputError::file(&context.source.path, format!("the sums over a tile cannot be read: {error}"))
}
