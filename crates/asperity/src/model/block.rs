//! Blocks of asperities, sorted by the separation at which an approaching flat touches them.

use crate::asperity::Asperities;
use crate::numeric::INTEGER_BIAS;
use crate::numeric::lanes::{Real, Work, run};

/// The separations of a curve, m, in descending order, and a grid over them. Capacities are powers of two, so that
/// indices modulo them need no bounds check.
pub(super) struct Levels {
    count: usize,
    /// Beyond the last separation, -infinity.
    separations: Box<[f64; PLACES]>,
    /// The smallest separation, m.
    lowest: f64,
    /// For each cell, the number of separations in higher cells.
    above: Box<[u16; CELLS]>,
    /// Whether a cell holds more than one separation.
    is_crowded: bool,
    cells_per_metre: f64,
    last_cell: f64,
}

/// Cells per separation: most are empty, so that a height is rarely compared twice.
const CELLS_PER_LEVEL: usize = 16;

/// Capacity for separations.
const PLACES: usize = 256;

/// Capacity for cells.
const CELLS: usize = CELLS_PER_LEVEL * PLACES;

impl Levels {
    /// The largest number of separations.
    pub(super) const MOST: usize = {
        assert!(PLACES.is_power_of_two() && CELLS.is_power_of_two() && CELLS <= 1 << 16);
        // One place and one cell more than separations are needed.
        PLACES / 2
    };

    /// Takes 1 to [`Self::MOST`] separations in descending order.
    pub(super) fn new(separations: &[f64]) -> Self {
        let count = separations.len();
        assert!((1..=Self::MOST).contains(&count), "{count} separations");
        let last_cell = (CELLS_PER_LEVEL * count) as f64;
        let span = separations[0] - separations[count - 1];
        // Finite also for adjacent separations.
        let cells_per_metre = if span > 0.0 { ((last_cell - 1.0) / span).min(f64::MAX) } else { 0.0 };
        let mut levels = Self {
            count,
            separations: Box::new([f64::NEG_INFINITY; PLACES]),
            lowest: separations[count - 1],
            above: Box::new([0; CELLS]),
            is_crowded: false,
            cells_per_metre,
            last_cell,
        };
        levels.separations[..count].copy_from_slice(separations);
        for &separation in separations {
            let cell = levels.cell_above(separation);
            levels.above[..usize::from(cell)].iter_mut().for_each(|above| *above += 1);
        }
        levels.is_crowded = levels.above.windows(2).any(|cells| cells[0] > cells[1] + 1);
        levels
    }

    /// The separations, m, in descending order.
    pub(super) fn separations(&self) -> &[f64] {
        &self.separations[..self.count]
    }

    /// The cell of a height (m): 0 up to the lowest separation, then increasing with height.
    #[inline(always)]
    fn cell(&self, height: f64) -> u16 {
        let cell = self.cell_above(height);
        if height > self.lowest { cell } else { 0 }
    }

    #[inline(always)]
    fn cell_above(&self, height: f64) -> u16 {
        let cell = ((height - self.lowest) * self.cells_per_metre + 1.0).min(self.last_cell);
        // Adding 2^52 leaves the nearest integer in the last bits.
        (cell + INTEGER_BIAS).to_bits() as u16
    }

    /// Number of separations at which an asperity in `cell` is not touched: those in higher cells and, if cells are
    /// `CROWDED`, possibly several in its own.
    #[inline(always)]
    fn untouched<const CROWDED: bool>(&self, height: f64, cell: u16) -> u16 {
        let mut place = self.above[usize::from(cell) % CELLS];
        // Branch-free, since the branch would be unpredictable.
        place += u16::from(self.separations[usize::from(place) % PLACES] >= height);
        while CROWDED && self.separations[usize::from(place) % PLACES] >= height {
            place += 1;
        }
        place
    }
}

/// A block of asperities sorted by the separation at which they are touched: those in contact at a separation are a
/// prefix. Arrays have their maximum length, and indices are taken modulo it, so that bounds checks are removed.
pub(super) struct Block {
    heights: Box<[f64; Self::MOST]>,
    radii: Box<[f64; Self::MOST]>,
    spheres: Box<[f64; Self::MOST]>,
    /// The cell of each asperity.
    cells: Box<[u16; Self::MOST]>,
    /// Indices of the asperities touched, and the number of separations at which each is not.
    touched: Box<[u16; Self::MOST]>,
    places: Box<[u16; Self::MOST]>,
    /// Number touched at each separation.
    ends: [usize; PLACES],
}

impl Default for Block {
    fn default() -> Self {
        Self {
            heights: zeroed(),
            radii: zeroed(),
            spheres: zeroed(),
            cells: zeroed(),
            touched: zeroed(),
            places: zeroed(),
            ends: [0; PLACES],
        }
    }
}

fn zeroed<T: Default + Copy>() -> Box<[T; Block::MOST]> {
    Box::new([T::default(); Block::MOST])
}

/// Computes the cells of heights in vector registers.
struct FindCells<'a> {
    levels: &'a Levels,
    heights: &'a [f64],
    cells: &'a mut [u16],
}

impl Work for FindCells<'_> {
    type Output = ();

    #[inline(always)]
    fn with<N: Real>(self, _: N) {
        for (cell, &z) in self.cells.iter_mut().zip(self.heights) {
            *cell = self.levels.cell(z);
        }
    }
}

/// Writes the indices of the `cells` whose asperities are touched to `touched`, without a branch, and returns their number.
#[inline(always)]
fn keep_touched<const MOST: usize>(cells: &[u16], touched: &mut [u16; MOST]) -> usize {
    let mut count = 0;
    for (index, &cell) in cells.iter().enumerate() {
        touched[count % MOST] = index as u16;
        count += usize::from(cell > 0);
    }
    count
}

impl Block {
    /// The largest number of asperities, which fit in the cache.
    pub(super) const MOST: usize = 8192;

    /// Fills the block with up to [`Self::MOST`] asperities.
    pub(super) fn fill(&mut self, asperities: Asperities<'_>, levels: &Levels) {
        if levels.is_crowded {
            self.fill_by::<true>(asperities, levels);
        } else {
            self.fill_by::<false>(asperities, levels);
        }
    }

    fn fill_by<const CROWDED: bool>(&mut self, asperities: Asperities<'_>, levels: &Levels) {
        let all = asperities.count();
        let (z, b) = (&asperities.heights()[..all], &asperities.radii()[..all]);
        let Self { heights, radii, spheres, cells, touched, places, ends } = self;
        run(FindCells { levels, heights: z, cells: &mut cells[..] });

        let count = keep_touched(&cells[..all], touched);
        let touched = &touched[..count];

        ends.fill(0);
        for (place, &index) in places.iter_mut().zip(touched) {
            let index = usize::from(index);
            *place = levels.untouched::<CROWDED>(z[index], cells[index % Self::MOST]);
            ends[usize::from(*place) % PLACES] += 1;
        }
        let mut start = 0;
        for end in ends.iter_mut() {
            (*end, start) = (start, start + *end);
        }

        // Each start advances to the end of its range.
        let order = places.iter().zip(touched).map(|(&place, &index)| {
            let end = &mut ends[usize::from(place) % PLACES];
            let to = *end % Self::MOST;
            *end += 1;
            (to, usize::from(index))
        });
        match asperities.spheres() {
            None => order.for_each(|(to, index)| (heights[to], radii[to]) = (z[index], b[index])),
            Some(n) => order.for_each(|(to, index)| {
                (heights[to], radii[to], spheres[to]) = (z[index], b[index], n[index]);
            }),
        }
    }

    /// The asperities touched at the separation `level`, from the arrays of `asperities`.
    pub(super) fn above(&self, level: usize, asperities: &Asperities<'_>) -> Asperities<'_> {
        let count = self.ends[level];
        let spheres = asperities.spheres().map(|_| &self.spheres[..count]);
        Asperities::new(&self.heights[..count], &self.radii[..count], spheres, asperities.nominal_area())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Separations far apart, equal, and next to each other; heights on them, beside them and far away.
    #[test]
    fn at_each_separation_those_above_it_are_a_prefix() {
        let tiny = f64::MIN_POSITIVE;
        let lists: [&[f64]; 6] = [
            &[4.0, 3.0, 2.5, 1.0, 0.0],
            &[1e30, 1.0, 1.0, -1e30],
            &[2.0 * tiny, tiny, 0.0],
            &[1.0, 1f64.next_down()],
            &[0.5],
            &[7.0, 7.0, 7.0],
        ];
        let mut heights: Vec<f64> = (0..400).map(|k| f64::from((k * 37) % 101) * 0.07 - 2.0).collect();
        for separations in lists {
            heights.extend(separations.iter().flat_map(|&z| [z, z.next_up(), z.next_down(), -z]));
        }
        let radii: Vec<f64> = (1..=heights.len()).map(|k| k as f64).collect();
        let all = Asperities::new(&heights, &radii, Some(&radii), 1.0);
        let mut block = Block::default();
        for separations in lists {
            let levels = Levels::new(separations);
            block.fill(all, &levels);
            for (level, &separation) in separations.iter().enumerate() {
                let mut found: Vec<_> =
                    block.above(level, &all).each().map(|(z, shape)| (shape.radius as usize, z)).collect();
                found.sort_by_key(|(index, _)| *index);
                let exact = (1..).zip(heights.iter().copied()).filter(|(_, z)| *z > separation);
                assert_eq!(found, exact.collect::<Vec<_>>(), "{separation} of {separations:?}");
            }
        }
    }
}
