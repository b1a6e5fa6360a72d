//! Surfaces in tiles, each small enough for any machine: stretches of a population or of a list, rows of a map, realisations.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use asperity::numeric::stream_seed;
use asperity::surface::{AnalysisDepth, Preparation};
use asperity::topography::read::ReadError;
use asperity::topography::summits::{Detail, find_in_rows};
use asperity::topography::{Filter, HeightMap, Level, Rows, Window};
use asperity::work::Counter;
use asperity::{
    AsperityList, AsperitySet, AsperitySums, Draw, ListOptions, MapError, Population, ReferencePlane, STREAM,
};
use asperity_contact_framework::input::{InMemory, InputError, Source};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::{Progress, Silent};

use super::factory::SurfaceFactory;
use super::files::Files;
use super::plan::{MapPlan, Origin, SurfacePlan};
use super::reading::{list_message, spec_message};
use super::spec::DrawSpec;

/// How a surface is divided into tiles. The input alone fixes it.
#[derive(Debug)]
pub struct SurfaceTiles {
    division: Division,
    pub count: usize,
}

#[derive(Debug)]
enum Division {
    /// Blocks of asperities of each realisation.
    Population {
        tiles: usize,
        blocks: usize,
    },
    /// Blocks of rows.
    List {
        blocks: usize,
    },
    /// Rows of a map, and those on either side that filters and plateaus need.
    Map {
        rows: usize,
        halo: usize,
    },
    Realisations,
}

/// Asperities of a block: whole streams, small enough for a cache.
const BLOCK: usize = 16 * STREAM;

/// Blocks of a tile, unless there would be too many tiles.
const BLOCKS: usize = 64;

/// As many tiles, so that a merge stays a matter of seconds.
const MOST_TILES: usize = 4096;

/// As many tiles as a small surface is divided into.
const FEW_TILES: usize = 64;

/// Rows on either side of those of a map's tile in which a plateau may end.
const PLATEAU: usize = 64;

/// Blocks of each of `most` tiles at most.
fn blocks_per_tile(blocks: usize, most: usize) -> usize {
    blocks.div_ceil(FEW_TILES).min(BLOCKS).max(blocks.div_ceil(most)).max(1)
}

impl SurfaceTiles {
    pub fn new(plan: &SurfacePlan, source: &Source) -> Result<Self, InputError> {
        let refuse = |message: &str| source.error_at(plan.size_key.clone(), message);
        match &plan.origin {
            Origin::Population { count, .. } => {
                let all = count.div_ceil(BLOCK);
                let blocks = blocks_per_tile(all, (MOST_TILES / plan.realisations).max(1));
                let tiles = all.div_ceil(blocks);
                let division = Division::Population { tiles, blocks };
                Ok(Self { division, count: tiles * plan.realisations })
            }
            Origin::List { path, rows, .. } => {
                let is_in_memory = source.content_in_memory(path).is_some();
                if !is_in_memory && !asperity::npy::is_npy(path).is_ok_and(|is_npy| is_npy) {
                    return Err(refuse(
                        "found a list of asperities in a text, whose rows cannot be read from the middle; allowed in [tiled]: an .npy \
                         with columns height and radius, as numpy.save writes it",
                    ));
                }
                let all = rows.div_ceil(BLOCK);
                let blocks = blocks_per_tile(all, MOST_TILES);
                Ok(Self { division: Division::List { blocks }, count: all.div_ceil(blocks) })
            }
            Origin::Map(map) => {
                check_local(map).map_err(|message| refuse(&message))?;
                let [nx, ny] = map.points;
                let halo = map.preparation.filter.map_or(0, |filter| filter.halo(map.pixel)) + PLATEAU;
                let rows = (BLOCKS * BLOCK).div_ceil(ny).min(nx.div_ceil(FEW_TILES));
                // At least as many rows as a halo, so that no more than two thirds are read for a neighbour.
                let rows = rows.max(halo).max(nx.div_ceil(MOST_TILES));
                Ok(Self { division: Division::Map { rows, halo }, count: nx.div_ceil(rows) })
            }
            Origin::Generated(_) if plan.realisations == 1 => Err(refuse(
                "found one realisation of a random surface, which is made by transforms of the whole map; allowed in [tiled]: realisations \
                 = 2 or more, each of which is a tile",
            )),
            Origin::Generated(_) => Ok(Self { division: Division::Realisations, count: plan.realisations }),
            Origin::Pair(_) => Err(refuse(
                "found a pair, whose maps are summed as a whole; allowed in [tiled]: a surface of one body",
            )),
        }
    }

    /// The number of tiles that are worth doing at a time, so that threads seldom wait for each other: tiles of one block are
    /// parallel within, and large.
    pub fn at_once(&self) -> usize {
        /// Per thread: the last one to end keeps the others waiting for a small share of the time.
        const BLOCKS_PER_THREAD: usize = 16;
        match self.division {
            Division::Population { blocks, .. } | Division::List { blocks } => {
                (BLOCKS_PER_THREAD * rayon::current_num_threads()).div_ceil(blocks)
            }
            Division::Map { .. } | Division::Realisations => 1,
        }
    }

    /// The most blocks that are done at a time, whose sums are kept until they are added.
    pub fn most_blocks(&self) -> usize {
        match self.division {
            Division::Population { blocks, .. } | Division::List { blocks } => self.at_once() * blocks,
            Division::Map { .. } | Division::Realisations => 1,
        }
    }

    /// An estimate of the memory that one tile needs on the threads of this process, bytes.
    pub fn memory(&self, plan: &SurfacePlan) -> u128 {
        /// Heights and radii, drawn and sorted.
        const BYTES_PER_ASPERITY: u128 = 64;
        /// Heights of the window, and what is found of its summits.
        const BYTES_PER_POINT: u128 = 24;
        match (&self.division, &plan.origin) {
            (Division::Map { rows, halo }, Origin::Map(map)) => {
                let points = [(rows + 2 * halo).min(map.points[0]), map.points[1]];
                let area = points[0] as u128 * points[1] as u128;
                let filtering = map.preparation.filter.map_or(0, |filter| filter.memory(points, map.pixel));
                let whole =
                    if map.is_on_disk { 0 } else { map.points[0] as u128 * map.points[1] as u128 * 32 };
                whole + area * BYTES_PER_POINT + filtering
            }
            (Division::Realisations, _) => plan.memory(AnalysisDepth::Asperities, false),
            _ => (rayon::current_num_threads() * BLOCK) as u128 * BYTES_PER_ASPERITY,
        }
    }

    pub fn open<'a>(
        &'a self,
        plan: &'a SurfacePlan,
        source: &'a Source,
        seed: u64,
        progress: &dyn Progress,
    ) -> Result<OpenTiles<'a>, InputError> {
        let mut open = OpenTiles { tiles: self, plan, source, seed, map: None, origin: 0.0, radius: 0.0 };
        let refuse = |message: String| source.error_at(plan.size_key.clone(), message);
        match &plan.origin {
            Origin::Population { population, .. } => open.radius = population.radius,
            Origin::List { path, given, .. } => {
                let first = open.rows(path, 0..1, *given)?;
                let mut columns = first.columns().map(|column| column[0]);
                (open.origin, open.radius) = (columns.next().unwrap_or(0.0), columns.next().unwrap_or(0.0));
            }
            Origin::Map(map) => {
                let rows: Arc<dyn Rows> = match source.content_in_memory(&map.file.path) {
                    Some(InMemory::Map { rows, .. }) => Arc::clone(rows),
                    _ => {
                        progress.stage("reading", 1.0);
                        map.file.unchecked_rows(progress).map(Arc::from).map_err(|error| {
                            refuse(format!("{} {}", map.file.path.display(), spec_message(&error)))
                        })?
                    }
                };
                open.origin = first_height(&*rows).unwrap_or(0.0);
                open.map = Some(rows);
            }
            Origin::Generated(_) | Origin::Pair(_) => {}
        }
        Ok(open)
    }
}

/// Refuses a map whose tiles would need the whole of it.
fn check_local(map: &MapPlan) -> Result<(), String> {
    let Preparation { removes_spikes, aligned, tip, level, .. } = map.preparation;
    if map.fit.is_some() {
        return Err(
            "found `fit`, which needs the whole map; allowed in [tiled]: a map that needs no preparation"
                .to_owned(),
        );
    }
    if map.is_periodic {
        return Err("found a periodic map; allowed in [tiled]: a map with borders".to_owned());
    }
    if removes_spikes || aligned.is_some() || tip.is_some() {
        return Err(
            "found outliers = \"remove\", align-lines or tip, which need the whole map; allowed in [tiled]: a map without spikes, with \
             aligned lines and as traced"
                .to_owned(),
        );
    }
    match level {
        // Separations are measured from the mean asperity height: the mean of the map changes nothing.
        Level::None | Level::Mean => Ok(()),
        _ => Err(format!(
            "is levelled by a {}, which needs the whole map; allowed in [tiled]: level = \"none\" or \"mean\", for a map that was levelled \
             before",
            level.name()
        )),
    }
}

fn first_height(map: &dyn Rows) -> Option<f64> {
    let mut row = vec![0.0; map.points()[1]];
    (0..map.points()[0]).find_map(|ix| {
        map.read(ix, &mut row);
        row.iter().copied().find(|z| !z.is_nan())
    })
}

/// A surface whose tiles can be read or drawn, in any order.
pub struct OpenTiles<'a> {
    tiles: &'a SurfaceTiles,
    plan: &'a SurfacePlan,
    source: &'a Source,
    seed: u64,
    map: Option<Arc<dyn Rows>>,
    origin: f64,
    radius: f64,
}

/// Asperities of a part of a tile.
pub struct TileBlock {
    /// The asperities; `None` where there is none.
    pub set: Option<AsperitySet>,
    /// Their nominal area, m^2.
    pub nominal_area: f64,
}

impl From<AsperitySet> for TileBlock {
    fn from(set: AsperitySet) -> Self {
        Self { nominal_area: set.nominal_area(), set: Some(set) }
    }
}

impl OpenTiles<'_> {
    /// The height (m) in the file that all heights are relative to, so that an offset costs no digits: the first.
    pub fn origin(&self) -> f64 {
        self.origin
    }

    /// Sums over nothing yet, about a height and a radius near those of its asperities.
    pub fn sums(&self) -> AsperitySums {
        AsperitySums::about(0.0, self.radius)
    }

    /// The blocks of a tile, which are summed in their order.
    pub fn blocks(&self, tile: usize) -> Range<usize> {
        let stretch = |tile: usize, blocks: usize, all: usize| {
            tile * blocks..((tile + 1) * blocks).min(all.div_ceil(BLOCK))
        };
        match (&self.tiles.division, &self.plan.origin) {
            (Division::Population { tiles, blocks }, Origin::Population { count, .. }) => {
                stretch(tile % tiles, *blocks, *count)
            }
            (Division::List { blocks }, Origin::List { rows, .. }) => stretch(tile, *blocks, *rows),
            _ => 0..1,
        }
    }

    /// The asperities of one of the [`Self::blocks`] of a tile.
    pub fn block(&self, tile: usize, block: usize) -> Result<TileBlock, InputError> {
        match (&self.tiles.division, &self.plan.origin, &self.map) {
            (Division::Population { tiles, .. }, Origin::Population { population, count, draw, .. }, _) => {
                self.drawn(population, *count, *draw, tile / tiles + 1, block)
            }
            (_, Origin::List { path, given, rows, nominal_area, .. }, _) => {
                let stretch = block * BLOCK..((block + 1) * BLOCK).min(*rows);
                let share = nominal_area * stretch.len() as f64 / *rows as f64;
                let list = self.rows(path, stretch, *given)?;
                let set = list.set(share).map_err(|error| self.refuse(error))?;
                Ok(set.relative_to(self.origin).into())
            }
            (&Division::Map { rows, halo }, Origin::Map(plan), Some(map)) => {
                self.found(&**map, plan, tile * rows..((tile + 1) * rows).min(plan.points[0]), halo)
            }
            _ => self.realisation(tile + 1),
        }
    }

    fn refuse(&self, error: impl std::fmt::Display) -> InputError {
        self.source.error_at(self.plan.size_key.clone(), error)
    }

    fn drawn(
        &self,
        population: &Population,
        count: usize,
        draw: DrawSpec,
        realisation: usize,
        block: usize,
    ) -> Result<TileBlock, InputError> {
        let draw = match draw {
            DrawSpec::Random => Draw::Random(stream_seed(
                self.seed,
                &format!("population {} realisation {realisation}", self.plan.name),
            )),
            DrawSpec::Quantiles => Draw::Quantiles,
        };
        let streams = BLOCK / STREAM;
        let set = population.part(block * streams..(block + 1) * streams, count, draw);
        set.map(TileBlock::from).map_err(|error| self.refuse(error))
    }

    /// Some rows of a list in a file or in memory.
    fn rows(&self, path: &Path, rows: Range<usize>, given: ListOptions) -> Result<AsperityList, InputError> {
        if let Some(InMemory::List(list)) = self.source.content_in_memory(path) {
            let mut columns = list.columns().map(|column| column[rows.clone()].to_vec());
            let mut next = || columns.next().unwrap_or_default();
            return Ok(AsperityList::new(next(), next(), None));
        }
        AsperityList::read_rows(path, rows, given).map_err(|error| self.refuse(list_message(path, &error)))
    }

    /// The summits in some rows of a map.
    fn found(
        &self,
        map: &dyn Rows,
        plan: &MapPlan,
        rows: Range<usize>,
        halo: usize,
    ) -> Result<TileBlock, InputError> {
        let refuse =
            |error: &ReadError| self.refuse(format!("{} {}", plan.file.path.display(), spec_message(error)));
        let [nx, ny] = map.points();
        let first = rows.start.saturating_sub(halo);
        let points = [(rows.end + halo).min(nx) - first, ny];
        let window = Window { map, first: [first, 0], points };
        let nothing = TileBlock { set: None, nominal_area: 0.0 };
        match plan.file.check_rows(&window) {
            Ok(()) => {}
            Err(ReadError::Map(MapError::AllMissing)) => return Ok(nothing),
            Err(error) => return Err(refuse(&error)),
        }
        let mut heights = HeightMap::from_rows(&window).into_heights();
        heights.iter_mut().for_each(|z| *z -= self.origin);
        let mut window = HeightMap::new(points, map.pixel(), heights, map.precision())
            .map_err(|error| refuse(&error.into()))?;
        let filtered = |filter: Filter| filter.apply(&window);
        if let Some(filtered) = plan.preparation.filter.map(filtered) {
            window = filtered.map_err(|error| self.refuse(error))?;
        }
        let own = rows.start - first..rows.end - first;
        let summits = find_in_rows(&window, own, plan.preparation.neighbours, Detail::default());
        let nominal_area = map.pixel()[0] * map.pixel()[1] * summits.tested as f64;
        if summits.heights.is_empty() {
            return Ok(TileBlock { set: None, nominal_area });
        }
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        let set = AsperitySet::new(summits.heights, radii, nominal_area);
        set.map(TileBlock::from).map_err(|error| self.refuse(error))
    }

    fn realisation(&self, number: usize) -> Result<TileBlock, InputError> {
        let counter = Counter::default();
        // Its own factory, so that no realisation depends on those before it.
        let mut factory = SurfaceFactory::from_seed(self.plan, self.source, self.seed, &counter, &Silent);
        let mut files = Files::new(Vec::new(), &counter);
        let made = factory.make(number, AnalysisDepth::Asperities, &mut files, &mut Timing::default())?;
        // All in the same frame.
        Ok(made.set.relative_to(-made.origin).into())
    }
}

impl SurfacePlan {
    /// Whether its asperities are at the quantiles of a population, in their order.
    pub fn is_at_quantiles(&self) -> bool {
        matches!(self.origin, Origin::Population { draw: DrawSpec::Quantiles, .. })
    }

    /// The population that it is drawn from, and where separations are measured from then; `None` of other surfaces.
    pub fn nominal(&self) -> Option<(&Population, ReferencePlane)> {
        match &self.origin {
            Origin::Population { population, plane, .. } => Some((population, *plane)),
            _ => None,
        }
    }
}
