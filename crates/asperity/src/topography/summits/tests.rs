//! Against the definitions, point by point.

use super::*;
use crate::topography::HeightMap;
use rand::{RngExt, SeedableRng};
use std::collections::{BTreeMap, BTreeSet};

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

/// The same by words: every connected set of equal heights, tested point by point.
fn oracle(map: &HeightMap, neighbours: Neighbours) -> (BTreeMap<usize, f64>, usize, usize, usize) {
    let [nx, ny] = map.points().map(|count| count as isize);
    let is_periodic = map.boundary() == Boundary::Periodic;
    let z = |[ix, iy]: [isize; 2]| map.heights()[(ix.rem_euclid(nx) * ny + iy.rem_euclid(ny)) as usize];
    let around = |[ix, iy]: [isize; 2]| neighbours.steps().iter().map(move |[dx, dy]| [ix + dx, iy + dy]);
    let inside = |[ix, iy]: [isize; 2]| is_periodic || (ix > 0 && iy > 0 && ix + 1 < nx && iy + 1 < ny);
    let is_tested =
        |point| inside(point) && !z(point).is_nan() && around(point).all(|other| !z(other).is_nan());
    let (mut summits, mut tested, mut plateaus, mut dropped) = (BTreeMap::new(), 0, 0, 0);
    for point in (0..nx).flat_map(|ix| (0..ny).map(move |iy| [ix, iy])) {
        tested += usize::from(is_tested(point));
        let mut set = vec![point];
        let mut seen = BTreeSet::from([point]);
        let mut k = 0;
        while k < set.len() {
            for other in around(set[k]) {
                let is_on = is_periodic || ((0..nx).contains(&other[0]) && (0..ny).contains(&other[1]));
                let other = [other[0].rem_euclid(nx), other[1].rem_euclid(ny)];
                if is_on && z(other) == z(point) && seen.insert(other) {
                    set.push(other);
                }
            }
            k += 1;
        }
        let is_first = set.iter().all(|&other| other >= point);
        let is_top =
            set.iter().all(|&member| is_tested(member) && around(member).all(|other| z(other) <= z(member)));
        if !(is_first && is_top) {
            continue;
        }
        let bend = |[a, b]: [isize; 2]| {
            0.5 * ((2.0 * z([a, b]) - z([a - 1, b]) - z([a + 1, b]))
                + (2.0 * z([a, b]) - z([a, b - 1]) - z([a, b + 1])) / 4.0)
        };
        let mean = set.iter().map(|&member| bend(member)).sum::<f64>() / set.len() as f64;
        plateaus += usize::from(set.len() > 1);
        if mean > 0.0 {
            summits.insert((point[0] * ny + point[1]) as usize, mean);
        } else {
            dropped += 1;
        }
    }
    (summits, tested, plateaus, dropped)
}

#[test]
fn random_maps_full_of_plateaus() {
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(5);
    let mut all_plateaus = [0; 4];
    for levels in [2, 3, 5, 50, 100_000] {
        for holes in [0.0, 0.02] {
            let heights =
                (0..45 * 31)
                    .map(|_| {
                        if rng.random_bool(holes) { f64::NAN } else { f64::from(rng.random_range(0..levels)) }
                    })
                    .collect();
            let open = map([45, 31], heights);
            for (k, (map, neighbours)) in [&open, &open.clone().periodic()]
                .into_iter()
                .flat_map(|map| [(map, Neighbours::Four), (map, Neighbours::Eight)])
                .enumerate()
            {
                let found = find(map, neighbours, Detail::ALL);
                let (summits, tested, plateaus, dropped) = oracle(map, neighbours);
                assert_eq!(found.positions, summits.keys().copied().collect::<Vec<_>>());
                assert!(found.positions.iter().zip(&found.heights).all(|(&at, &z)| map.heights()[at] == z));
                for (a, b) in found.curvatures.iter().zip(summits.values()) {
                    assert!((a - b).abs() < 1e-12);
                }
                for (curvature, principal) in found.curvatures.iter().zip(&found.principal) {
                    assert!((0.5 * (principal[0] + principal[1]) - curvature).abs() < 1e-9 * principal[0]);
                }
                assert_eq!((found.tested, found.plateaus, found.dropped), (tested, plateaus, dropped));
                all_plateaus[k] += plateaus;
            }
        }
    }
    assert!(all_plateaus.iter().all(|&count| count > 50), "{all_plateaus:?}");
}

/// Lists are put together over many strips, and hold no more than is requested.
#[test]
fn a_tall_map_and_less_detail() {
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(6);
    let heights = (0..1500 * 5).map(|_| f64::from(rng.random_range(0..9))).collect();
    let map = map([1500, 5], heights).periodic();
    let found = find(&map, Neighbours::Four, Detail::ALL);
    let (summits, tested, plateaus, dropped) = oracle(&map, Neighbours::Four);
    assert!(plateaus > 100 && found.positions.is_sorted());
    assert_eq!(found.positions, summits.keys().copied().collect::<Vec<_>>());
    assert_eq!((found.tested, found.plateaus, found.dropped), (tested, plateaus, dropped));
    let less = find(&map, Neighbours::Four, Detail::default());
    let nothing = Summits { positions: vec![], principal: vec![], drops: vec![], ..found };
    assert_eq!(less, nothing);
}

/// On a paraboloid with any axes the nine points give both curvatures exactly, also where corners are missing.
#[test]
fn parts_of_a_map_with_halos_have_the_summits_of_the_whole() {
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(7);
    let [nx, ny] = [60, 17];
    let height = |_| if rng.random_bool(0.02) { f64::NAN } else { f64::from(rng.random_range(0..5)) };
    let map = map([nx, ny], (0..nx * ny).map(height).collect());
    for neighbours in [Neighbours::Four, Neighbours::Eight] {
        let whole = find(&map, neighbours, Detail::ALL);
        assert!(whole.plateaus > 10);
        let mut parts = Summits::default();
        for rows in [0..1, 1..20, 20..41, 41..60] {
            const HALO: usize = 12;
            let first = usize::saturating_sub(rows.start, HALO);
            let points = [nx.min(rows.end + HALO) - first, ny];
            let window = crate::topography::Window { map: &map, first: [first, 0], points };
            let mut found =
                find_in_rows(&window, rows.start - first..rows.end - first, neighbours, Detail::ALL);
            parts.positions.extend(found.positions.iter().map(|position| position + first * ny));
            parts.heights.append(&mut found.heights);
            parts.curvatures.append(&mut found.curvatures);
            parts.principal.append(&mut found.principal);
            parts.tested += found.tested;
            parts.plateaus += found.plateaus;
            parts.dropped += found.dropped;
        }
        let whole = Summits { drops: Vec::new(), ..whole };
        assert_eq!(parts, whole);
    }
}

#[test]
fn principal_curvatures_of_a_paraboloid() {
    for (large, small, angle) in [(3.0, 1.0, 0.0), (3.0, 1.0, 0.4), (2.0, 2.0, 1.0), (5.0, -0.2, 0.3)] {
        let (sin, cos) = f64::sin_cos(angle);
        let height = |k: usize| {
            let (x, y) = ((k / 5) as f64 - 2.0, 2.0 * ((k % 5) as f64 - 2.0));
            let (u, v) = (x * cos + y * sin, y * cos - x * sin);
            -0.5 * (large * u * u + small * v * v)
        };
        for missing in [vec![], vec![6], vec![6, 18], vec![6, 8, 16, 18]] {
            let mut heights: Vec<f64> = (0..25).map(height).collect();
            missing.iter().for_each(|&k: &usize| heights[k] = f64::NAN);
            let found = find(&map([5, 5], heights), Neighbours::Four, Detail::ALL);
            let place = found.positions.iter().position(|&at| at == 12).unwrap();
            let [k1, k2] = found.principal[place];
            if missing.len() < 4 {
                assert!((k1 - large).abs() < 1e-12 && (k2 - small).abs() < 1e-12, "{missing:?}: {k1} {k2}");
            }
            assert!((0.5 * (k1 + k2) - found.curvatures[place]).abs() < 1e-12);
        }
    }
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

#[test]
fn a_plateau_has_the_drops_to_the_lower_points_around_it() {
    let mut heights = vec![0.0; 30];
    (heights[14], heights[15], heights[13]) = (3.0, 3.0, 1.0);
    let found = five_point(&map([5, 6], heights));
    assert_eq!((found.positions, found.plateaus), (vec![14], 1));
    assert_eq!(found.drops, [3.0, 3.0, 2.0, 3.0, 3.0, 3.0]);
}

#[test]
fn a_flat_map_has_no_summit_even_where_it_goes_on() {
    for neighbours in [Neighbours::Four, Neighbours::Eight] {
        let found = find(&map([6, 5], vec![1.0; 30]).periodic(), neighbours, Detail::ALL);
        assert_eq!((found.heights.len(), found.drops.len(), found.plateaus, found.dropped), (0, 0, 1, 1));
    }
}
