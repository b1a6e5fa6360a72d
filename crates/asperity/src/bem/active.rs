//! Sets of points of a map, a bit each; heights of missing points, for the solver alone.

use rayon::prelude::*;

/// Points of a map, by rows.
#[derive(Debug, Clone)]
pub struct Points {
    /// Words of a row.
    stride: usize,
    words: Vec<u64>,
}

impl Points {
    /// No point of a map.
    pub fn none([nx, ny]: [usize; 2]) -> Self {
        let stride = ny.div_ceil(64);
        Self { stride, words: vec![0; nx * stride] }
    }

    /// The points of a map, by their index, that `is_member` holds for.
    pub fn selected([nx, ny]: [usize; 2], is_member: impl Fn(usize) -> bool + Sync) -> Self {
        let mut points = Self::none([nx, ny]);
        points.rows_mut().enumerate().for_each(|(i, words)| {
            for j in (0..ny).filter(|j| is_member(i * ny + j)) {
                words[j / 64] |= 1 << (j % 64);
            }
        });
        points
    }

    /// Bytes for a map.
    pub fn memory([nx, ny]: [usize; 2]) -> u128 {
        (nx * ny.div_ceil(64) * size_of::<u64>()) as u128
    }

    /// The words of row `i`.
    pub fn row(&self, i: usize) -> &[u64] {
        &self.words[i * self.stride..][..self.stride]
    }

    /// The words of each row.
    pub fn rows(&self) -> rayon::slice::Chunks<'_, u64> {
        self.words.par_chunks(self.stride)
    }

    /// The words of each row.
    pub fn rows_mut(&mut self) -> rayon::slice::ChunksMut<'_, u64> {
        self.words.par_chunks_mut(self.stride)
    }
}

/// The points of a row, in order.
pub fn members(words: &[u64]) -> impl Iterator<Item = usize> {
    words.iter().enumerate().flat_map(|(k, &word)| Bits(word).map(move |bit| 64 * k + bit))
}

struct Bits(u64);

impl Iterator for Bits {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        (self.0 != 0).then(|| {
            let bit = self.0.trailing_zeros() as usize;
            self.0 &= self.0 - 1;
            bit
        })
    }
}

/// Fills missing points (NaN) from the border of each gap inwards, with the mean of the neighbours that are known.
pub fn filled(heights: &[f64], [nx, ny]: [usize; 2]) -> Vec<f64> {
    let mut filled = heights.to_vec();
    let mut missing: Vec<usize> = (0..heights.len()).filter(|&k| heights[k].is_nan()).collect();
    while !missing.is_empty() {
        let mean = |k: usize| {
            let (i, j) = (k / ny, k % ny);
            let rows = i.saturating_sub(1)..(i + 2).min(nx);
            let around = rows.flat_map(|i| (j.saturating_sub(1)..(j + 2).min(ny)).map(move |j| i * ny + j));
            let known = around.map(|k| filled[k]).filter(|z| !z.is_nan());
            let (sum, count) = known.fold((0.0, 0), |(sum, count), z| (sum + z, count + 1));
            (count > 0).then(|| sum / f64::from(count))
        };
        let means: Vec<Option<f64>> = missing.iter().map(|&k| mean(k)).collect();
        let before = missing.len();
        let mut values = means.into_iter();
        missing.retain(|&k| match values.next().flatten() {
            Some(z) => {
                filled[k] = z;
                false
            }
            None => true,
        });
        if missing.len() == before {
            break;
        }
    }
    filled
}
