//! Some asperities in the order in which an approaching flat touches them.

use crate::asperity::Asperities;

/// The separations of a curve, m, largest first.
pub(super) struct Levels {
    separations: Vec<f64>,
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
        let span = separations[0] - separations[separations.len() - 1];
        let cells_per_metre = if span > 0.0 { (count - 1) as f64 / span } else { 0.0 };
        let mut levels = Self { separations, above: vec![0; count], cells_per_metre };
        for k in 0..levels.count() {
            let cell = levels.cell(levels.separations[k]);
            levels.above[..cell].iter_mut().for_each(|above| *above += 1);
        }
        levels
    }

    fn count(&self) -> usize {
        self.separations.len()
    }

    /// How many of `heights` (m) lie above each separation.
    pub(super) fn count_above(&self, heights: &[f64]) -> Vec<u64> {
        let mut counts = vec![0; self.count() + 1];
        for &z in heights {
            counts[usize::from(self.untouched(z))] += 1;
        }
        counts.pop();
        let mut above = 0;
        counts.iter_mut().for_each(|count| {
            above += *count;
            *count = above;
        });
        counts
    }

    fn lowest(&self) -> f64 {
        self.separations[self.count() - 1]
    }

    /// The cell of a height (m), which grows with it.
    #[inline(always)]
    fn cell(&self, height: f64) -> usize {
        // What lies below is in the first cell.
        (((height - self.lowest()) * self.cells_per_metre) as usize).min(self.above.len() - 1)
    }

    /// How many separations an asperity is not touched at; all that lie in cells above its own are among them.
    #[inline(always)]
    fn untouched(&self, height: f64) -> u16 {
        let mut place = self.above[self.cell(height)];
        while self.separations.get(usize::from(place)).is_some_and(|&separation| separation >= height) {
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
    /// At how many separations each of the touched asperities is not, and which it is.
    places: Vec<(u16, u16)>,
    /// How many are touched at each separation.
    ends: Vec<usize>,
}

impl Block {
    /// How many asperities there may be at the most: they stay in the cache from one separation to the next.
    pub(super) const MOST: usize = 8192;

    /// Takes in up to [`Self::MOST`] asperities.
    pub(super) fn fill(&mut self, asperities: Asperities<'_>, levels: &Levels) {
        let (heights, lowest) = (asperities.heights(), levels.lowest());
        self.places.resize(heights.len(), (0, 0));
        self.ends.clear();
        self.ends.resize(levels.count() + 1, 0);
        let mut count = 0;
        for (index, &z) in heights.iter().enumerate() {
            self.places[count].1 = index as u16;
            count += usize::from(z > lowest);
        }
        self.places.truncate(count);
        for (place, index) in &mut self.places {
            *place = levels.untouched(heights[usize::from(*index)]);
            self.ends[usize::from(*place) + 1] += 1;
        }
        // Where those of each place begin; each start moves on to become an end.
        for k in 1..self.ends.len() {
            self.ends[k] += self.ends[k - 1];
        }
        let radii = asperities.radii();
        self.heights.resize(count, 0.0);
        self.radii.resize(count, 0.0);
        match asperities.spheres() {
            None => self.place(|block, to, from| {
                (block.heights[to], block.radii[to]) = (heights[from], radii[from]);
            }),
            Some(spheres) => {
                self.spheres.resize(count, 0.0);
                self.place(|block, to, from| {
                    (block.heights[to], block.radii[to]) = (heights[from], radii[from]);
                    block.spheres[to] = spheres[from];
                });
            }
        }
    }

    #[inline(always)]
    fn place(&mut self, put: impl Fn(&mut Self, usize, usize)) {
        for k in 0..self.places.len() {
            let (place, index) = self.places[k];
            let end = &mut self.ends[usize::from(place)];
            let to = *end;
            *end += 1;
            put(self, to, usize::from(index));
        }
    }

    /// Those that are touched at the separation `level`, in the arrays and on the area of `asperities`.
    pub(super) fn above(&self, level: usize, asperities: &Asperities<'_>) -> Asperities<'_> {
        let count = self.ends[level];
        let spheres = asperities.spheres().map(|_| &self.spheres[..count]);
        Asperities::new(&self.heights[..count], &self.radii[..count], spheres, asperities.nominal_area())
    }
}
