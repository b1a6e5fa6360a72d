//! Five-point summits of a map (Greenwood 1984).

use rayon::prelude::*;

use super::HeightMap;

/// The summits of a map, in file order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Summits {
    /// Index of each summit in the map's heights; of a plateau its first point.
    pub positions: Vec<usize>,
    /// Heights, m.
    pub heights: Vec<f64>,
    /// Curvatures, 1/m, positive.
    pub curvatures: Vec<f64>,
    /// Drops from the summits to each of their lower neighbours, m.
    pub drops: Vec<f64>,
    /// Number of points that were tested: those that are present, inside the border, and have four
    /// present neighbours. The nominal area is this many pixels.
    pub tested: usize,
    /// Plateaus of equal heights among the summits, dropped ones included.
    pub plateaus: usize,
    /// Plateaus left out because their mean curvature is not positive.
    pub dropped: usize,
}

/// What the neighbourhood of a tested point says.
enum Rank {
    /// Higher than all four neighbours.
    Summit,
    /// As high as one or more of them, lower than none.
    Level,
    /// Lower than one.
    Below,
}

/// Finds the points that are strictly higher than their four neighbours. Equal heights form a
/// plateau: if all points around it are lower, it counts once, at its first point in file order, with
/// the mean of its points' curvatures. The curvature of a point is the mean of
/// (2 z0 - zW - zE)/dx^2 and (2 z0 - zS - zN)/dy^2.
///
/// The same on any number of threads.
pub fn five_point(map: &HeightMap) -> Summits {
    let [nx, ny] = map.points();
    let rows: Vec<(Vec<usize>, Vec<usize>, usize)> = (1..nx - 1)
        .into_par_iter()
        .map(|ix| {
            let (mut strict, mut level, mut tested) = (Vec::new(), Vec::new(), 0);
            for point in ix * ny + 1..(ix + 1) * ny - 1 {
                let Some(rank) = rank(map, point) else { continue };
                tested += 1;
                match rank {
                    Rank::Summit => strict.push(point),
                    Rank::Level => level.push(point),
                    Rank::Below => {}
                }
            }
            (strict, level, tested)
        })
        .collect();
    let tested = rows.iter().map(|row| row.2).sum();
    let mut summits: Vec<(usize, f64)> =
        rows.iter().flat_map(|row| &row.0).map(|&point| (point, curvature(map, point))).collect();
    let mut found = Summits { tested, ..Summits::default() };
    for &(point, _) in &summits {
        found.drops.extend(neighbours(map, point).map(|other| map.heights()[point] - map.heights()[other]));
    }
    let level: Vec<usize> = rows.into_iter().flat_map(|row| row.1).collect();
    if !level.is_empty() {
        add_plateaus(map, &level, &mut summits, &mut found);
    }
    for (point, curvature) in summits {
        found.positions.push(point);
        found.heights.push(map.heights()[point]);
        found.curvatures.push(curvature);
    }
    found
}

/// The points east, west, north and south of one inside the border.
fn neighbours(map: &HeightMap, point: usize) -> impl Iterator<Item = usize> {
    let ny = map.points()[1];
    [point - ny, point + ny, point - 1, point + 1].into_iter()
}

fn is_inside(map: &HeightMap, point: usize) -> bool {
    let [nx, ny] = map.points();
    let (ix, iy) = (point / ny, point % ny);
    (1..nx - 1).contains(&ix) && (1..ny - 1).contains(&iy)
}

/// `None` for a point that is not tested because it or a neighbour is missing.
fn rank(map: &HeightMap, point: usize) -> Option<Rank> {
    let z = map.heights()[point];
    let around = neighbours(map, point).map(|other| map.heights()[other]);
    let (mut highest, mut missing) = (f64::NEG_INFINITY, z.is_nan());
    for other in around {
        missing |= other.is_nan();
        highest = highest.max(other);
    }
    if missing {
        None
    } else if z > highest {
        Some(Rank::Summit)
    } else if z == highest {
        Some(Rank::Level)
    } else {
        Some(Rank::Below)
    }
}

/// Mean of the curvatures along x and y, 1/m.
fn curvature(map: &HeightMap, point: usize) -> f64 {
    let (heights, ny) = (map.heights(), map.points()[1]);
    let [dx, dy] = map.pixel();
    let bend = |step: usize| 2.0 * heights[point] - heights[point - step] - heights[point + step];
    0.5 * (bend(ny) / (dx * dx) + bend(1) / (dy * dy))
}

/// Each plateau is walked once, from its first point that is lower than none of its neighbours.
fn add_plateaus(map: &HeightMap, level: &[usize], summits: &mut Vec<(usize, f64)>, found: &mut Summits) {
    let heights = map.heights();
    let mut seen = vec![false; heights.len()];
    for &start in level {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let mut plateau = vec![start];
        let mut is_summit = true;
        let mut next = 0;
        while let Some(&point) = plateau.get(next) {
            next += 1;
            // A point that is not tested has unknown neighbours: the plateau may go on or rise there.
            if !is_inside(map, point) || !matches!(rank(map, point), Some(Rank::Level)) {
                is_summit = false;
            }
            for other in neighbours_within(map, point) {
                if heights[other] == heights[start] && !seen[other] {
                    seen[other] = true;
                    plateau.push(other);
                }
            }
        }
        if !is_summit {
            continue;
        }
        found.plateaus += 1;
        let mean = plateau.iter().map(|&point| curvature(map, point)).sum::<f64>() / plateau.len() as f64;
        if mean <= 0.0 {
            found.dropped += 1;
            continue;
        }
        for &point in &plateau {
            let drops = neighbours(map, point).map(|other| heights[point] - heights[other]);
            found.drops.extend(drops.filter(|&drop| drop > 0.0));
        }
        let first = plateau.iter().copied().min().unwrap_or(start);
        summits.push((first, mean));
    }
    summits.sort_unstable_by_key(|summit| summit.0);
}

/// As [`neighbours`], for any point of the map.
fn neighbours_within(map: &HeightMap, point: usize) -> impl Iterator<Item = usize> {
    let [nx, ny] = map.points();
    let (ix, iy) = (point / ny, point % ny);
    [
        (ix > 0).then(|| point - ny),
        (ix + 1 < nx).then(|| point + ny),
        (iy > 0).then(|| point - 1),
        (iy + 1 < ny).then(|| point + 1),
    ]
    .into_iter()
    .flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use std::collections::BTreeMap;

    fn map(points: [usize; 2], heights: Vec<f64>) -> HeightMap {
        HeightMap::new(points, [1.0, 2.0], heights, 0.0).unwrap()
    }

    #[test]
    fn one_summit_and_its_curvature() {
        let mut heights = vec![0.0; 25];
        heights[12] = 4.0;
        heights[11] = 1.0;
        let found = five_point(&map([5, 5], heights));
        assert_eq!((found.positions, found.heights, found.tested), (vec![12], vec![4.0], 9));
        assert_eq!(found.curvatures, [0.5 * (8.0 / 1.0 + 7.0 / 4.0)]);
        assert_eq!(found.drops, [4.0, 4.0, 3.0, 4.0]);
    }

    #[test]
    fn borders_and_points_beside_missing_ones_are_not_tested() {
        let mut heights = vec![0.0; 30];
        heights[1] = 9.0;
        heights[8] = 5.0;
        heights[16] = 5.0;
        heights[22] = f64::NAN;
        let found = five_point(&map([5, 6], heights));
        assert_eq!(found.positions, [8]);
        // 3 x 4 inside the border, less the missing point and its two neighbours inside.
        assert_eq!(found.tested, 12 - 3);
    }

    /// The same by words: every 4-connected set of equal heights, tested point by point.
    fn oracle(map: &HeightMap) -> (BTreeMap<usize, f64>, usize, usize, usize) {
        let [nx, ny] = map.points();
        let z = |ix: usize, iy: usize| map.heights()[ix * ny + iy];
        let around = |ix: usize, iy: usize| [(ix - 1, iy), (ix + 1, iy), (ix, iy - 1), (ix, iy + 1)];
        let inside = |ix: usize, iy: usize| ix > 0 && iy > 0 && ix + 1 < nx && iy + 1 < ny;
        let is_tested = |ix: usize, iy: usize| {
            inside(ix, iy) && !z(ix, iy).is_nan() && around(ix, iy).iter().all(|&(a, b)| !z(a, b).is_nan())
        };
        let (mut summits, mut tested, mut plateaus, mut dropped) = (BTreeMap::new(), 0, 0, 0);
        for ix in 0..nx {
            for iy in 0..ny {
                tested += usize::from(is_tested(ix, iy));
                let mut set = vec![(ix, iy)];
                let mut k = 0;
                while k < set.len() {
                    let (a, b) = set[k];
                    for (c, d) in [(a.wrapping_sub(1), b), (a + 1, b), (a, b.wrapping_sub(1)), (a, b + 1)] {
                        if c < nx && d < ny && z(c, d) == z(ix, iy) && !set.contains(&(c, d)) {
                            set.push((c, d));
                        }
                    }
                    k += 1;
                }
                let is_first = set.iter().all(|&other| other >= (ix, iy));
                let is_top = set
                    .iter()
                    .all(|&(a, b)| is_tested(a, b) && around(a, b).iter().all(|&(c, d)| z(c, d) <= z(a, b)));
                if !(is_first && is_top) {
                    continue;
                }
                let bend = |a: usize, b: usize| {
                    0.5 * ((2.0 * z(a, b) - z(a - 1, b) - z(a + 1, b))
                        + (2.0 * z(a, b) - z(a, b - 1) - z(a, b + 1)) / 4.0)
                };
                let mean = set.iter().map(|&(a, b)| bend(a, b)).sum::<f64>() / set.len() as f64;
                plateaus += usize::from(set.len() > 1);
                if mean > 0.0 {
                    summits.insert(ix * ny + iy, mean);
                } else {
                    dropped += 1;
                }
            }
        }
        (summits, tested, plateaus, dropped)
    }

    #[test]
    fn random_maps_full_of_plateaus() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut all_plateaus = 0;
        for levels in [2, 3, 5, 50] {
            for holes in [0.0, 0.02] {
                let heights = (0..40 * 37)
                    .map(|_| {
                        if rng.random_bool(holes) { f64::NAN } else { f64::from(rng.random_range(0..levels)) }
                    })
                    .collect();
                let map = map([40, 37], heights);
                let found = five_point(&map);
                let (summits, tested, plateaus, dropped) = oracle(&map);
                assert_eq!(found.positions, summits.keys().copied().collect::<Vec<_>>());
                for (a, b) in found.curvatures.iter().zip(summits.values()) {
                    assert!((a - b).abs() < 1e-12);
                }
                assert_eq!((found.tested, found.plateaus, found.dropped), (tested, plateaus, dropped));
                all_plateaus += plateaus;
            }
        }
        assert!(all_plateaus > 100);
    }

    #[test]
    fn one_giant_plateau_is_walked_once() {
        let mut heights = vec![1.0; 1000 * 1000];
        let found = five_point(&map([1000, 1000], heights.clone()));
        assert_eq!((found.positions.len(), found.plateaus), (0, 0));
        // Lower borders make a mesa of it: one summit, at its first point.
        for k in 0..1000 {
            for point in [k, 999_000 + k, k * 1000, k * 1000 + 999] {
                heights[point] = 0.0;
            }
        }
        let found = five_point(&map([1000, 1000], heights));
        assert_eq!((found.positions, found.plateaus), (vec![1001], 1));
    }

    #[test]
    fn zeros_of_both_signs_are_equal() {
        let mut heights = vec![-1.0; 36];
        heights[14] = 0.0;
        heights[15] = -0.0;
        let found = five_point(&map([6, 6], heights));
        assert_eq!((found.positions, found.plateaus), (vec![14], 1));
    }
}
