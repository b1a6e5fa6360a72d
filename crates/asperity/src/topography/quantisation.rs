//! Detection of height steps of the instrument. On a quantised map levelling turns steps into summits, whose radii are
//! artefacts.

use super::rows::{Rows, strips};
use super::summits::Summits;
use crate::numeric::parallel;
use crate::numeric::sort::sort;
use crate::progress::Share;

/// Quantisation of the heights of a map and of the curvatures of its summits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quantisation {
    /// Step between neighbouring height levels, m; `None` if the heights are not quantised.
    pub step: Option<f64>,
    /// Number of distinct heights in the sample.
    pub levels: usize,
    /// Number of distinct summit curvatures, different by more than the rounding of the stored heights.
    pub distinct_curvatures: usize,
    /// Number of summits.
    pub summits: usize,
    /// Median drop from a summit to its lower neighbours, m.
    pub median_drop: f64,
    /// A height that far more points have than those next to it.
    pub shared: Option<SharedHeight>,
}

/// A height that many points have exactly, far more than the heights next to it: the limit of a saturated instrument, or missing
/// points that were written as a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharedHeight {
    /// The height in the frame of the map, m.
    pub height: f64,
    /// Number of points.
    pub points: usize,
    /// Share of the points that are not missing.
    pub share: f64,
    /// Where it lies among all heights.
    pub place: HeightPlace,
}

/// Where a height lies among all heights of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeightPlace {
    /// None is higher.
    Highest,
    /// None is lower.
    Lowest,
    /// Between others.
    Between,
}

/// Share of the points that have one height exactly from which it is no chance.
pub const SHARED: f64 = 1e-3;

impl Quantisation {
    /// Analyses the raw heights of `map` and the summits found on it after levelling and, if it `is_filtered`, filtering: two units of work
    /// for whoever watches the map.
    pub fn new(map: &dyn Rows, summits: &Summits, is_filtered: bool) -> Self {
        let progress = map.progress();
        let goes_on = || progress.advance(0.0);
        let mut heights = sample(map);
        sort(&mut heights, progress);
        let points = heights.len();
        let largest = heights.iter().fold(0.0f64, |a, z| a.max(z.abs()));
        // Rounding error of a stored height, with a margin for an offset subtracted before.
        let rounding = 4.0 * map.precision() * largest;
        goes_on();
        let levels = usize::from(points > 0)
            + over_pairs(&heights, 0, |low, high| usize::from(high > low), |a, b| a + b);
        let shared = shared(&heights, map.points());
        goes_on();
        heights.dedup_by(|height, first| is_near(*height, *first, rounding));
        goes_on();
        let step = lattice(&heights, points, &goes_on);

        let mut curvatures = summits.curvatures.clone();
        sort(&mut curvatures, &Share { progress, units: 0.0 });
        let [dx, dy] = map.pixel();
        let noise = match step {
            // On a lattice curvatures are multiples of half a step over a squared pixel; a filter leaves no lattice.
            Some(step) if !is_filtered => 0.01 * step / (dx * dx).max(dy * dy),
            _ => 2.0 * rounding * (1.0 / (dx * dx) + 1.0 / (dy * dy)),
        };
        goes_on();
        curvatures.dedup_by(|curvature, first| is_near(*curvature, *first, noise));
        let mut drops = summits.drops.clone();
        let middle = drops.len() / 2;
        let median_drop =
            drops.get(middle).is_some().then(|| *drops.select_nth_unstable_by(middle, f64::total_cmp).1);
        goes_on();
        Self {
            step,
            levels,
            distinct_curvatures: curvatures.len(),
            summits: summits.curvatures.len(),
            median_drop: median_drop.unwrap_or_default(),
            shared,
        }
    }
}

/// Whether a value belongs to the cluster of a `first` one below it: a cluster ends `tolerance` above its first value, so that clusters
/// do not chain.
fn is_near(value: f64, first: f64, tolerance: f64) -> bool {
    value <= first + tolerance
}

/// The height that stands out by the number of points that have it exactly: the highest one if it does, else the lowest one, else that
/// of most points; `None` if none stands out. The heights are those sampled of a map of `points`, sorted.
fn shared(heights: &[f64], [nx, ny]: [usize; 2]) -> Option<SharedHeight> {
    /// As few points may agree by chance.
    const FEWEST: usize = 10;
    /// Heights on either side that its number of points is compared with.
    const NEXT: usize = 8;
    /// On 23 measured maps without the fault, quantised ones among them, a height has at most 3 times as many points as those next to it; of
    /// three that were clipped or filled, 3600 times and more.
    const TIMES: usize = 10;
    let count = heights.len();
    let least = FEWEST.max((SHARED * count as f64).ceil() as usize);
    let mut found: Option<(HeightPlace, usize, usize)> = None;
    // A height of so many points is that of one of the places at this distance.
    let mut start = 0;
    for at in (0..count).step_by(least).map(|place| heights[place]) {
        let before = start + heights[start..].partition_point(|z| *z < at);
        let end = before + heights[before..].partition_point(|z| *z <= at);
        if end == start {
            continue;
        }
        start = before;
        let level = &heights[start..end];
        let place = match (start, end == count) {
            (0, true) => return None,
            (_, true) => HeightPlace::Highest,
            (0, _) => HeightPlace::Lowest,
            _ => HeightPlace::Between,
        };
        let rank = |place| match place {
            HeightPlace::Between => 0,
            HeightPlace::Lowest => 1,
            HeightPlace::Highest => 2,
        };
        let is_more =
            found.is_none_or(|(other, from, to)| (rank(place), level.len()) > (rank(other), to - from));
        if level.len() >= least && is_more {
            let below = heights[..start].chunk_by(|a, b| a == b).rev().take(NEXT).map(<[f64]>::len);
            let above = heights[end..].chunk_by(|a, b| a == b).take(NEXT).map(<[f64]>::len);
            let next: Vec<usize> = below.chain(above).collect();
            if next.len() >= NEXT && next.iter().all(|&other| level.len() >= TIMES * other) {
                found = Some((place, start, end));
            }
        }
        start = end;
    }
    let (place, start, end) = found?;
    let share = (end - start) as f64 / count as f64;
    let sampled = (nx * ny).div_ceil(ENOUGH);
    Some(SharedHeight { height: heights[start], points: sampled * (end - start), share, place })
}

/// The approximate largest number of heights sampled.
const ENOUGH: usize = 1 << 24;

/// The present heights of all rows or, on a very large map, of evenly spaced rows.
fn sample(map: &dyn Rows) -> Vec<f64> {
    let [nx, ny] = map.points();
    let stride = (nx * ny).div_ceil(ENOUGH);
    let parts = strips(map, 0, |strip| {
        let sampled = (0..strip.count).filter(|k| (strip.first + k).is_multiple_of(stride));
        let mut present = Vec::with_capacity(sampled.clone().count() * ny);
        for row in sampled.filter_map(|k| strip.row(k as isize)) {
            if row.iter().any(|z| z.is_nan()) {
                present.extend(row.iter().copied().filter(|z| !z.is_nan()));
            } else {
                present.extend_from_slice(row);
            }
        }
        present
    });
    parts.concat()
}

/// The step of the lattice of all levels; `None` if they form none.
fn lattice(levels: &[f64], points: usize, goes_on: &dyn Fn()) -> Option<f64> {
    /// RMS deviation of gaps from integer steps: 0 on a lattice, 0.289 for continuous heights.
    const ON_LATTICE: f64 = 0.1;
    /// With fewer gaps agreement may be by chance, unless each level has many points.
    const MANY_GAPS: usize = 20;
    const POINTS_PER_LEVEL: usize = 4;
    let gaps = levels.len().saturating_sub(1);
    if gaps == 0 || (gaps < MANY_GAPS && points < POINTS_PER_LEVEL * levels.len()) {
        return None;
    }
    let range = levels[gaps] - levels[0];
    let mut step =
        over_pairs(levels, f64::INFINITY, |low, high| high - low, |a, b| if b < a { b } else { a });
    // The smallest gap is a noisy first guess; the whole range over the number of steps is not.
    for _ in 0..3 {
        goes_on();
        step = range / over_pairs(levels, 0.0, |low, high| rounded((high - low) / step), |a, b| a + b);
    }
    goes_on();
    let residual = |low: f64, high: f64| ((high - low) / step - rounded((high - low) / step)).powi(2);
    let spread = (over_pairs(levels, 0.0, residual, |a, b| a + b) / gaps as f64).sqrt();
    (spread <= ON_LATTICE).then_some(step)
}

/// The integer next to a number that is not negative; halves go up.
fn rounded(value: f64) -> f64 {
    /// All larger numbers are integers; added to smaller ones it leaves no digits after the point.
    const LARGE: f64 = (1_u64 << 52) as f64;
    let even = if value < LARGE { (value + LARGE) - LARGE } else { value };
    if value - even >= 0.5 { even + 1.0 } else { even }
}

/// `of` all pairs of neighbours, joined from `none`, in chunks on all threads.
fn over_pairs<T: Copy + Send + Sync>(
    values: &[f64],
    none: T,
    of: impl Fn(f64, f64) -> T + Sync,
    join: impl Fn(T, T) -> T + Sync,
) -> T {
    const CHUNK: usize = 1 << 14;
    /// Written to be vectorised by the compiler, which keeps the order of a single sum.
    const LANES: usize = 8;
    let pairs = values.len().saturating_sub(1);
    let part = |k: usize| {
        let (from, to) = (k * CHUNK, pairs.min((k + 1) * CHUNK));
        let (low, low_rest) = values[from..to].as_chunks::<LANES>();
        let (high, high_rest) = values[from + 1..=to].as_chunks::<LANES>();
        let mut lanes = [none; LANES];
        for (low, high) in low.iter().zip(high) {
            for k in 0..LANES {
                lanes[k] = join(lanes[k], of(low[k], high[k]));
            }
        }
        let rest = low_rest.iter().zip(high_rest).map(|(&low, &high)| of(low, high));
        lanes.into_iter().chain(rest).fold(none, &join)
    };
    parallel::map(pairs.div_ceil(CHUNK), part).into_iter().fold(none, &join)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::HeightMap;
    use crate::topography::summits::five_point;
    use rand::{RngExt, SeedableRng};

    fn analyse(points: [usize; 2], step: Option<f64>, precision: f64) -> Quantisation {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let heights = (0..points[0] * points[1])
            .map(|_| {
                let z: f64 = rng.random_range(-1.0..1.0) + rng.random_range(-1.0..1.0);
                let z = step.map_or(z, |step| (z / step).round() * step) * 1e-7;
                if precision > 1e-10 { f64::from(z as f32) } else { z }
            })
            .collect();
        let map = HeightMap::new(points, [1e-6; 2], heights, precision).unwrap();
        Quantisation::new(&map, &five_point(&map), false)
    }

    #[test]
    fn steps_are_found_where_there_are_some() {
        for points in [[5, 5], [8, 9], [30, 30], [300, 200]] {
            assert_eq!(analyse(points, None, f64::EPSILON).step, None, "{points:?}");
        }
        let single = f64::from(f32::EPSILON);
        for (step, precision, within, curvatures) in [
            (0.8, f64::EPSILON, 1e-4, 0..100),
            (0.8, single, 1e-4, 0..100),
            (0.13, f64::EPSILON, 1e-4, 100..usize::MAX),
            (0.13, single, 1e-4, 100..usize::MAX),
            (1e-3, f64::EPSILON, 1e-6, 1001..usize::MAX),
        ] {
            let found = analyse([200, 150], Some(step), precision);
            assert!((found.step.unwrap() / (step * 1e-7) - 1.0).abs() < within, "{found:?}");
            assert!(curvatures.contains(&found.distinct_curvatures), "{found:?}");
        }
    }

    #[test]
    fn halves_are_rounded_up() {
        let largest = (1_u64 << 53) as f64;
        let large = [0.25 * largest + 0.5, largest - 1.0, 3.0 * largest];
        for value in [0.0, 0.49, 0.5, 1.5, 2.5, 2.4999, 3.7, 1e9 + 0.5].into_iter().chain(large) {
            assert_eq!(rounded(value), value.round(), "{value}");
        }
    }

    /// Heights cut off at the top, at the bottom or filled with one number share a height; those on steps do not, however coarse.
    #[test]
    fn heights_that_were_cut_off_or_filled_are_shared() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(3);
        let heights: Vec<f64> =
            (0..40_000).map(|_| (0..6).map(|_| rng.random_range(-1.0..1.0)).sum::<f64>()).collect();
        let of = |height: &dyn Fn(usize, f64) -> f64| {
            let mut heights: Vec<f64> = heights.iter().enumerate().map(|(k, &z)| height(k, z)).collect();
            heights.sort_unstable_by(f64::total_cmp);
            shared(&heights, [200; 2])
        };
        assert_eq!(of(&|_, z| z), None);
        let found = of(&|_, z| z.min(3.0)).unwrap();
        assert_eq!((found.height, found.place), (3.0, HeightPlace::Highest));
        assert!(found.share > SHARED && found.points as f64 == 40_000.0 * found.share, "{found:?}");
        assert_eq!(of(&|_, z| z.max(-3.0)).map(|found| found.place), Some(HeightPlace::Lowest));
        assert_eq!(of(&|_, z| z.clamp(-2.0, 3.0)).map(|found| found.place), Some(HeightPlace::Highest));
        let filled = of(&|k, z| if k < 100 { 0.0 } else { z }).unwrap();
        assert_eq!((filled.points, filled.place), (100, HeightPlace::Between));
        assert_eq!(of(&|k, z| if k < 30 { 0.0 } else { z }), None, "fewer than one in a thousand");
        for step in [0.01, 0.1, 1.0, 5.0] {
            let rounded = |z: f64| (z / step).round() * step;
            assert_eq!(of(&|_, z| rounded(z)), None, "{step}");
            assert_eq!(of(&|_, z| rounded(z.exp())), None, "{step}");
            if step < 1.0 {
                let cut = of(&|_, z| rounded(z).min(rounded(2.0)));
                assert_eq!(
                    cut.map(|found| found.place),
                    Some(HeightPlace::Highest).filter(|_| step < 0.1),
                    "{step}"
                );
            }
        }
        assert_eq!(of(&|_, _| 1.0), None);
    }
}
