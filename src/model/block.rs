//! Some asperities in the order in which an approaching flat touches them.

use crate::asperity::Asperities;
use crate::numeric::WHOLES;

/// The separations of a curve, m, largest first.
pub(super) struct Levels {
    /// With one below all heights at the end.
    separations: Vec<f64>,
    /// m.
    lowest: f64,
    /// Of each cell of a grid over the separations, how many lie in cells above it.
    above: Vec<u16>,
    cells_per_metre: f64,
}

/// Cells of the grid a separation: most hold none, so that a height is seldom compared twice.
const CELLS: usize = 16;

impl Levels {
    /// How many separations there may be at the most.
    pub(super) const MOST: usize = 128;

    /// From 1 to [`Self::MOST`] separations, largest first.
    pub(super) fn new(separations: Vec<f64>) -> Self {
        let count = CELLS * separations.len();
        let (highest, lowest) = (separations[0], separations[separations.len() - 1]);
        let span = highest - lowest;
        // Finite also where separations are next to each other.
        let cells_per_metre = if span > 0.0 { ((count - 1) as f64 / span).min(f64::MAX) } else { 0.0 };
        let mut levels = Self { separations, lowest, above: vec![0; count], cells_per_metre };
        for k in 0..levels.count() {
            let cell = levels.cell(levels.separations[k]);
            levels.above[..usize::from(cell)].iter_mut().for_each(|above| *above += 1);
        }
        // Below every height.
        levels.separations.push(f64::NEG_INFINITY);
        levels
    }

    fn count(&self) -> usize {
        self.above.len() / CELLS
    }

    /// The separations, m, largest first.
    pub(super) fn separations(&self) -> &[f64] {
        &self.separations[..self.count()]
    }

    /// How many of `heights` (m) lie above each separation.
    pub(super) fn count_above(&self, heights: &[f64]) -> Vec<u64> {
        let mut counts = vec![0; self.count() + 1];
        for &z in heights.iter().filter(|&&z| z > self.lowest) {
            counts[usize::from(self.untouched(z, self.cell(z)))] += 1;
        }
        counts.pop();
        let mut above = 0;
        counts.iter_mut().for_each(|count| {
            above += *count;
            *count = above;
        });
        counts
    }

    /// The cell of a height (m) above the lowest separation, which grows with it.
    #[inline(always)]
    fn cell(&self, height: f64) -> u16 {
        let last = (self.above.len() - 1) as f64;
        // Its last bits are the whole number next to what is added.
        (((height - self.lowest) * self.cells_per_metre).min(last) + WHOLES).to_bits() as u16
    }

    /// How many separations an asperity in `cell` is not touched at; all that lie in cells above its own are among them.
    #[inline(always)]
    fn untouched(&self, height: f64, cell: u16) -> u16 {
        let mut place = self.above[usize::from(cell)];
        while self.separations[usize::from(place)] >= height {
            place += 1;
        }
        place
    }
}

/// A block of asperities, those that the first separation touches first: at each they are a prefix.
#[derive(Default)]
pub(super) struct Block {
    heights: Vec<f64>,
    radii: Vec<f64>,
    spheres: Vec<f64>,
    /// Those that are touched: which they are, their heights, and at how many separations each is not touched.
    touched: Vec<u16>,
    touched_heights: Vec<f64>,
    places: Vec<u16>,
    /// How many are touched at each separation.
    ends: Vec<usize>,
}

impl Block {
    /// How many asperities there may be at the most: they stay in the cache from one separation to the next.
    pub(super) const MOST: usize = 8192;

    /// Takes in up to [`Self::MOST`] asperities.
    pub(super) fn fill(&mut self, asperities: Asperities<'_>, levels: &Levels) {
        let count = self.touch(asperities.heights(), levels.lowest);
        self.find_places(levels);
        self.heights.resize(count, 0.0);
        self.radii.resize(count, 0.0);
        let Self { heights, radii, spheres, touched, touched_heights, places, ends } = self;
        let order = places.iter().zip(&*touched).map(|(&place, &index)| {
            let end = &mut ends[usize::from(place)];
            let to = *end;
            *end += 1;
            (to, usize::from(index))
        });
        let from = asperities.radii();
        match asperities.spheres() {
            None => order.zip(&*touched_heights).for_each(|((to, index), &z)| {
                (heights[to], radii[to]) = (z, from[index]);
            }),
            Some(counts) => {
                spheres.resize(count, 0.0);
                order.zip(&*touched_heights).for_each(|((to, index), &z)| {
                    (heights[to], radii[to], spheres[to]) = (z, from[index], counts[index]);
                });
            }
        }
    }

    /// Collects those above `lowest` (m), and says how many.
    fn touch(&mut self, heights: &[f64], lowest: f64) -> usize {
        self.touched.resize(heights.len(), 0);
        self.touched_heights.resize(heights.len(), 0.0);
        let (touched, touched_heights) = (&mut self.touched[..], &mut self.touched_heights[..]);
        let mut count = 0;
        for (index, &z) in heights.iter().enumerate() {
            (touched[count], touched_heights[count]) = (index as u16, z);
            count += usize::from(z > lowest);
        }
        self.touched.truncate(count);
        self.touched_heights.truncate(count);
        count
    }

    /// Finds at how many separations each is not touched, and where those of each place begin: each start moves on to
    /// become an end while they are put there.
    fn find_places(&mut self, levels: &Levels) {
        self.ends.clear();
        self.ends.resize(levels.count() + 2, 0);
        self.places.resize(self.touched.len(), 0);
        let Self { touched_heights, places, ends, .. } = self;
        // In a pass of its own, which compilers make one of many heights at a time.
        for (place, &z) in places.iter_mut().zip(&*touched_heights) {
            *place = levels.cell(z);
        }
        for (place, &z) in places.iter_mut().zip(&*touched_heights) {
            *place = levels.untouched(z, *place);
            ends[usize::from(*place) + 1] += 1;
        }
        let mut start = 0;
        for end in ends {
            start += *end;
            *end = start;
        }
    }

    /// Those that are touched at the separation `level`, in the arrays and on the area of `asperities`.
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
            let levels = Levels::new(separations.to_vec());
            block.fill(all, &levels);
            let counts = levels.count_above(&heights);
            for (level, &separation) in separations.iter().enumerate() {
                let mut found: Vec<_> =
                    block.above(level, &all).each().map(|(z, shape)| (shape.radius as usize, z)).collect();
                found.sort_by_key(|(index, _)| *index);
                let exact = (1..).zip(heights.iter().copied()).filter(|(_, z)| *z > separation);
                assert_eq!(found, exact.collect::<Vec<_>>(), "{separation} of {separations:?}");
                assert_eq!(counts[level], found.len() as u64);
            }
        }
    }
}
