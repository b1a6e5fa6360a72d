//! Running `[tiled]`: sums over tiles, then the statistical model of the whole.

use std::ops::Range;

use asperity::study::LawContact;
use asperity::{AsperitySums, Deterministic, MeanRadius, Population, ReferencePlane, Total};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact;
use asperity_contact_framework::divided::{Divided, TileResult};
use asperity_contact_framework::input::InputError;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::plan::TiledPlan;
use super::results::{LawResults, TiledResults, TiledSurface, error_of_ratio};
use crate::plausibility;
use crate::study_plan::layer_metadata;
use crate::surface::{OpenTiles, SurfacePlan};

/// What is found in a tile.
#[derive(Serialize, Deserialize)]
struct TileSums {
    /// In the first pass.
    asperities: Option<AsperitySums>,
    /// Law by law, separation by separation, once the plane that separations are measured from is known.
    totals: Vec<Vec<Total>>,
}

impl TileSums {
    fn merge(&mut self, part: &Self) {
        if let (Some(sums), Some(part)) = (&mut self.asperities, &part.asperities) {
            sums.merge(part);
        }
        for (totals, part) in self.totals.iter_mut().zip(&part.totals) {
            totals.iter_mut().zip(part).for_each(|(total, part)| total.merge(part));
        }
    }
}

impl Divided for TiledPlan {
    type Outcome = TiledResults;

    fn tiles(&self) -> usize {
        self.tiles.count
    }

    /// Mean and sigma of a population are known; those of any other set take a pass of their own.
    fn passes(&self) -> usize {
        if self.surface().nominal().is_some() { 1 } else { 2 }
    }

    fn pass(
        &self,
        context: &RunContext,
        tiles: Range<usize>,
        earlier: &[Vec<TileResult>],
    ) -> Result<Vec<TileResult>, InputError> {
        let open = self.tiles.open(self.surface(), context.source, context.seed, context.progress)?;
        let plane = match (self.surface().nominal(), earlier.first()) {
            (Some((_, plane)), _) => Some(plane),
            (None, Some(first)) => Some(self.whole(context, &read(context, first)?)?.plane),
            (None, None) => None,
        };
        let name = format!("pass {} of {}", earlier.len() + 1, self.passes());
        context.progress.stage(&name, tiles.len() as f64);
        let mut results = Vec::new();
        for first in tiles.clone().step_by(self.tiles.at_once()) {
            let some = first..tiles.end.min(first + self.tiles.at_once());
            let progress = some.len() as f64;
            for found in self.some_tiles(&open, some, earlier.is_empty(), plane)? {
                results.push(TileResult::from_value(&found).map_err(|error| unreadable(context, error))?);
            }
            context.progress.advance(progress);
        }
        Ok(results)
    }

    fn merge(&self, context: &RunContext, passes: &[Vec<TileResult>]) -> Result<TiledResults, InputError> {
        let mut passes = passes.iter().map(|pass| read(context, pass));
        let first = passes.next().transpose()?.unwrap_or_default();
        let last = passes.next().transpose()?;
        let surface = self.whole(context, &first)?;
        let points = self.separations().len();
        let totals = vec![vec![Total::default(); points]; self.study.laws.len()];
        let mut all = TileSums { asperities: None, totals };
        let mut loads = vec![Vec::new(); points * self.study.laws.len()];
        for tile in last.as_ref().unwrap_or(&first) {
            let totals = tile.totals.iter().flatten();
            loads.iter_mut().zip(totals).for_each(|(loads, total)| loads.push(total.load().total()));
            all.merge(tile);
        }
        let area = |tile: &TileSums| tile.asperities.map_or(0.0, |sums| sums.nominal_area());
        let areas: Vec<f64> = first.iter().map(area).collect();
        // Quantiles are in the order of their heights: their tiles are no sample.
        let is_sample = !self.surface().is_at_quantiles();
        let error = |loads: &Vec<f64>| error_of_ratio(loads, &areas).filter(|_| is_sample);
        let errors: Vec<Option<f64>> = loads.iter().map(error).collect();
        let laws = self.study.laws.iter().zip(all.totals.iter().zip(errors.chunks(points)));
        let laws = laws.map(|(law, (totals, errors))| {
            LawResults::new(law, self.separations(), &surface, totals, errors.to_vec())
        });
        let mut papers = contact::papers_of(&self.study.laws);
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
            contact: contact::contact_metadata(
                context.materials,
                &self.study.laws,
                &self.study.bodies,
                layer,
            ),
            metadata: context.metadata(papers, Default::default(), None),
            surface,
        })
    }
}

impl TiledPlan {
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
        let Some(plane) = plane else { return Ok(TileSums { asperities, totals: Vec::new() }) };
        let separations: Vec<f64> = self.separations().iter().map(|h| plane.mean + h * plane.sigma).collect();
        let of_law = |law: &LawContact| match &found.set {
            Some(set) => Deterministic::new(&*law.contact, set.spheres(), plane).totals(&separations),
            None => vec![Total::default(); separations.len()],
        };
        Ok(TileSums { asperities, totals: self.study.laws.iter().map(of_law).collect() })
    }

    /// The whole surface, from the first pass.
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

fn read(context: &RunContext, tiles: &[TileResult]) -> Result<Vec<TileSums>, InputError> {
    tiles.iter().map(|tile| tile.value().map_err(|error| unreadable(context, error))).collect()
}

fn unreadable(context: &RunContext, error: serde_json::Error) -> InputError {
    InputError::file(&context.source.path, format!("the sums over a tile cannot be read: {error}"))
}
