//! Which parts of a surface may be taken as independent of each other, for the sampling error of a comparison.

use crate::compare::Division;
use crate::topography::summits::Summits;
use crate::topography::{Blocks, CorrelationLengths, MIN_BLOCKS, Rows, TooSmall};

/// What a surface offers for its sampling error.
#[derive(Debug, Clone)]
pub enum Independence {
    /// Asperities of a list or a population, taken as independent draws.
    Asperities,
    /// Blocks of a map.
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
