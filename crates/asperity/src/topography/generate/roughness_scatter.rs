//! How much the roughness of a map varies from place to place, whatever its heights are distributed like.

use statrs::distribution::{ContinuousCDF, Normal};

use super::super::HeightMap;
use crate::compare::Scatter;
use crate::numeric::extremes;
use crate::numeric::parallel::for_each_row;

/// How much the mean square slope of the blocks of a map (four along each side) scatters: standard deviation over mean. Short waves are so many in
/// a block that it scatters little unless their amplitude varies. The slopes are those of the normal scores of the heights, because slopes of a
/// transformed Gaussian surface vary with the height. Not a number for a flat map.
pub fn roughness_scatter(map: &HeightMap) -> f64 {
    const ALONG: usize = 4;
    let ([nx, ny], pixel) = (map.points(), map.pixel());
    let Some(scores) = normal_scores(map) else { return f64::NAN };
    let mut sums = [(0.0, 0usize); ALONG * ALONG];
    for (ix, row) in scores.chunks(ny).enumerate() {
        let next = scores.get((ix + 1) * ny..(ix + 2) * ny);
        for (iy, g) in row.iter().enumerate() {
            let (sum, count) = &mut sums[ix * ALONG / nx * ALONG + iy * ALONG / ny];
            let along_x = next.map(|next| (next[iy] - g) / pixel[0]);
            let along_y = row.get(iy + 1).map(|after| (after - g) / pixel[1]);
            for slope in along_x.into_iter().chain(along_y).filter(|slope| !slope.is_nan()) {
                *sum += slope * slope;
                *count += 1;
            }
        }
    }
    let blocks: Vec<f64> =
        sums.iter().filter(|(_, count)| *count > 0).map(|(sum, count)| sum / *count as f64).collect();
    let Scatter { mean, deviation } = Scatter::new(&blocks);
    deviation / mean
}

/// The standard normal quantile at the share of heights below each height, linear between equal steps of height; `None` of a flat map. Missing
/// points stay so.
fn normal_scores(map: &HeightMap) -> Option<Vec<f64>> {
    const STEPS: usize = 4096;
    let heights = map.heights();
    let [lowest, highest] = extremes(heights.iter().copied().filter(|z| !z.is_nan()))?;
    let per_height = STEPS as f64 / (highest - lowest);
    if !per_height.is_finite() {
        return None;
    }
    let mut counts = [0u32; STEPS];
    for z in heights.iter().filter(|z| !z.is_nan()) {
        counts[(((z - lowest) * per_height) as usize).min(STEPS - 1)] += 1;
    }
    let present: u32 = counts.iter().sum();
    let normal = Normal::standard();
    let of_count = |below: u32| normal.inverse_cdf((f64::from(below) + 0.5) / (f64::from(present) + 1.0));
    let mut below = 0;
    let mut ends = vec![of_count(0)];
    ends.extend(counts.iter().map(|count| {
        below += count;
        of_count(below)
    }));
    let mut scores = heights.to_vec();
    for_each_row(&mut scores, map.points()[1], &|_, row| {
        for z in row.iter_mut().filter(|z| !z.is_nan()) {
            let place = (*z - lowest) * per_height;
            let step = (place as usize).min(STEPS - 1);
            *z = ends[step] + (place - step as f64) * (ends[step + 1] - ends[step]);
        }
    });
    Some(scores)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(heights: Vec<f64>) -> HeightMap {
        HeightMap::new([200; 2], [1.0; 2], heights, 0.0).unwrap()
    }

    /// Of quantiles of a distribution they are those of the normal one; missing points and levels do no harm.
    #[test]
    fn scores_are_normal_whatever_the_heights() {
        let normal = Normal::standard();
        let share = |k: usize| (k as f64 + 0.5) / 40_000.0;
        let exponential = |k: usize| if k == 7 { f64::NAN } else { -(1.0 - share(k)).ln() };
        let scores = normal_scores(&map((0..40_000).map(exponential).collect())).unwrap();
        assert!(scores[7].is_nan());
        for k in [400, 20_000, 39_000, 39_990] {
            assert!((scores[k] - normal.inverse_cdf(share(k))).abs() < 0.01, "{k}: {}", scores[k]);
        }
        let levels = normal_scores(&map((0..40_000).map(|k| f64::from(k % 3)).collect())).unwrap();
        assert!(levels.iter().all(|g| g.is_finite()));
        assert!(roughness_scatter(&map(vec![1.0; 40_000])).is_nan());
    }
}
