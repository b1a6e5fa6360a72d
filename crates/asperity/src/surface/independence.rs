//! Which parts of a surface may be taken as independent of each other, for the sampling error of a comparison.

use crate::HeightMap;
use crate::compare::Division;
use crate::progress::Silent;
use crate::topography::summits::Summits;
use crate::topography::{Autocorrelation, Blocks, CorrelationLengths, MIN_BLOCKS, Rows, TooSmall};

/// What a surface offers for its sampling error.
#[derive(Debug, Clone)]
pub enum Independence {
    /// Asperities of a population, or of a list that is said to be one of independent draws.
    Asperities,
    /// A list of which nothing is known: neighbours may be alike.
    Unstated,
    /// Blocks of a map, or of a list with places.
    Blocks(Box<MapBlocks>),
    /// A map that is too small to hold enough blocks.
    TooSmall(TooSmall),
    /// Not examined: the realisations of a surface give the error.
    Realisations,
}

/// Blocks of a map that are long compared with its correlation length.
#[derive(Debug, Clone)]
pub struct MapBlocks {
    /// The asperities and areas of the blocks.
    pub division: Division,
    /// Number of blocks along x and y.
    pub counts: [usize; 2],
    /// Sides of a block, m.
    pub sides: [f64; 2],
    /// Correlation lengths of the map.
    pub correlation: CorrelationLengths,
}

impl Independence {
    /// Of asperities of `heights` (m) at `places` along x and y (m), with both halves of them: blocks as of a map, by the correlation of
    /// their own heights.
    pub fn of_places(heights: &[f64], places: [&[f64]; 2]) -> (Self, Option<Division>) {
        let Some(grid) = PlaceGrid::new(heights.len(), places) else { return (Self::Unstated, None) };
        let positions = grid.positions(places);
        let halves = Blocks::halves(grid.points, grid.pixel);
        let halves = Division::of_blocks(&halves, &positions, vec![0.5; 2]);
        let correlation = grid.correlation(heights, places);
        let independence = match Blocks::new(grid.points, grid.pixel, correlation) {
            Ok(blocks) => {
                let shares = vec![1.0 / blocks.count() as f64; blocks.count()];
                let sides = [0, 1]
                    .map(|axis| grid.points[axis] as f64 * grid.pixel[axis] / blocks.counts[axis] as f64);
                let division = Division::of_blocks(&blocks, &positions, shares);
                Self::Blocks(Box::new(MapBlocks { division, counts: blocks.counts, sides, correlation }))
            }
            Err(error) => Self::TooSmall(error),
        };
        (independence, Some(halves))
    }

    /// Of a levelled, filtered map with its `correlation` lengths, and its summits with their positions.
    pub(super) fn of_map(map: &dyn Rows, correlation: CorrelationLengths, summits: &Summits) -> Self {
        let (points, pixel) = (map.points(), map.pixel());
        let blocks = match Blocks::new(points, pixel, correlation) {
            Ok(blocks) => blocks,
            Err(error) => return Self::TooSmall(error),
        };
        let shares = blocks.shares(map);
        // A block without a point is none.
        let filled = shares.iter().filter(|share| **share > 0.0).count();
        if filled < MIN_BLOCKS {
            let area = pixel[0] * pixel[1] * (points[0] * points[1]) as f64;
            let area_needed = area * MIN_BLOCKS as f64 / filled as f64;
            return Self::TooSmall(TooSmall { correlation, area_needed });
        }
        let sides = [0, 1].map(|axis| points[axis] as f64 * pixel[axis] / blocks.counts[axis] as f64);
        let division = Division::of_blocks(&blocks, &summits.positions, shares);
        Self::Blocks(Box::new(MapBlocks { division, counts: blocks.counts, sides, correlation }))
    }
}

/// A grid over the rectangle that holds the places of a list.
struct PlaceGrid {
    /// The corner of the lowest places, m.
    origin: [f64; 2],
    points: [usize; 2],
    pixel: [f64; 2],
    /// Cells along x and y that hold some asperities each.
    cells: [usize; 2],
}

impl PlaceGrid {
    /// `None` of places on a line or a point.
    fn new(count: usize, places: [&[f64]; 2]) -> Option<Self> {
        /// Fine against any block.
        const POINTS: usize = 4096;
        /// Asperities per cell of which a mean height is taken: what neighbours have in common stands out of what each has alone.
        const PER_CELL: f64 = 4.0;
        /// Cells along an axis, at least: fewer have no autocorrelation.
        const FEWEST: usize = 3;
        let ends = places.map(|places| {
            places
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &at| (low.min(at), high.max(at)))
        });
        let sides = ends.map(|(low, high)| high - low);
        if !sides.iter().all(|side| *side > 0.0) {
            return None;
        }
        let cell = (PER_CELL * sides[0] * sides[1] / count as f64).sqrt();
        Some(Self {
            origin: ends.map(|(low, _)| low),
            points: [POINTS; 2],
            pixel: sides.map(|side| side / POINTS as f64),
            cells: sides.map(|side| ((side / cell).round() as usize).clamp(FEWEST, POINTS)),
        })
    }

    /// The cells of a division of the grid by `counts` along x and y that hold each place, the y index running fastest.
    fn places_among(&self, counts: [usize; 2], places: [&[f64]; 2]) -> Vec<usize> {
        let index = |axis: usize, at: f64| {
            let side = self.points[axis] as f64 * self.pixel[axis];
            let place = (at - self.origin[axis]) / side * counts[axis] as f64;
            (place as usize).min(counts[axis] - 1)
        };
        let each = places[0].iter().zip(places[1]);
        each.map(|(&x, &y)| index(0, x) * counts[1] + index(1, y)).collect()
    }

    /// The point of each asperity.
    fn positions(&self, places: [&[f64]; 2]) -> Vec<usize> {
        self.places_among(self.points, places)
    }

    /// Correlation lengths of the mean heights of cells.
    fn correlation(&self, heights: &[f64], places: [&[f64]; 2]) -> CorrelationLengths {
        let [nx, ny] = self.cells;
        let mut sums = vec![(0.0, 0.0); nx * ny];
        for (cell, z) in self.places_among(self.cells, places).into_iter().zip(heights) {
            sums[cell].0 += z;
            sums[cell].1 += 1.0;
        }
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        // A cell without asperities is missing: 0/0.
        let heights = sums.into_iter().map(|(sum, count)| sum / count).collect();
        let pixel = [0, 1].map(|axis| self.pixel[axis] * self.points[axis] as f64 / self.cells[axis] as f64);
        let found = HeightMap::new(self.cells, pixel, heights, f64::EPSILON).ok();
        let found = found.and_then(|map| Autocorrelation::from_map(&map, mean, &Silent));
        found.as_ref().map_or(CorrelationLengths::NONE, CorrelationLengths::from_autocorrelation)
    }
}
