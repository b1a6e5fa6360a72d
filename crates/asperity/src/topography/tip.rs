//! The stylus or tip of the instrument: what it could not reach of a measured map.
//!
//! A tip that traces a surface moves along its dilation by the tip; erosion by the same tip gives the lowest surface that it can have
//! traced, which is the surface itself wherever the tip touched it (Villarrubia 1997). The tip is a paraboloid of the tip's radius: its
//! height over the apex differs from that of a sphere by a quarter of the squared slope, 1 % at a slope of 0.2, and it separates into
//! parabolas along both axes, so that a map is eroded in a time that grows with its points only. Between its points the map is
//! interpolated: on the grid alone a tip would leave summits as they are.

use rayon::prelude::*;

use super::{Boundary, HeightMap, Rows};
use crate::progress::{Count, Progress};

/// What a tip of a radius has reached of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipReach {
    /// Radius of the tip, m.
    pub radius: f64,
    /// Share of the points that the tip did not touch alone: from the same place of the tip it touched the surface elsewhere, so that
    /// the surface may lie lower.
    pub unreached: f64,
    /// Share of the points that lie higher than a tip of this radius can have traced any surface, by more than the grid and a hundredth of
    /// Sq: peaks sharper than the tip.
    pub untraced: f64,
    /// The largest height taken off, m.
    pub largest: f64,
}

/// Untraced heights below this part of Sq count as traced.
const PART_OF_SQ: f64 = 0.01;

/// Places of the tip per pixel.
const PARTS: usize = 4;

/// Units of work of [`eroded`]: the copy of the map, two erosions of three passes each, and what they have reached.
pub const WORK: f64 = 8.0;

/// Erodes a map by a tip of `radius` (m). Missing points stay missing and bound nothing. [`WORK`] units of work for whoever watches the map.
pub fn eroded(map: &dyn Rows, radius: f64) -> (HeightMap, TipReach) {
    let progress = map.progress();
    let traced = HeightMap::from_rows(map);
    let is_periodic = map.boundary() == Boundary::Periodic;
    let grid = Grid { points: map.points(), pixel: map.pixel(), is_periodic, radius };
    let heights = traced.heights();
    let (mut surface, apexes) = grid.eroded(heights, progress);
    let negated: Vec<f64> = surface.iter().map(|z| -z).collect();
    let (opened, _) = grid.eroded(&negated, progress);
    let goes_on = || progress.advance(0.0);
    let is_present = |k: &usize| !heights[*k].is_nan();
    let present: Vec<usize> = (0..heights.len()).filter(is_present).collect();
    goes_on();
    let count = present.len() as f64;
    let mean = present.iter().map(|&k| heights[k]).sum::<f64>() / count;
    let sq = (present.iter().map(|&k| (heights[k] - mean).powi(2)).sum::<f64>() / count).sqrt();
    goes_on();
    // Between points of the grid the tip touches lower than at the nearest of them by at most this.
    let of_grid: f64 = grid.pixel.iter().map(|pixel| pixel * pixel / (4.0 * radius)).sum();
    let is_untraced = |k: &&usize| heights[**k] + opened[**k] > PART_OF_SQ * sq + of_grid;
    let untraced = present.iter().filter(is_untraced).count() as f64 / count;
    goes_on();
    let unreached = grid.unreached(&apexes, &present, progress) as f64 / count;
    let largest = present.iter().map(|&k| heights[k] - surface[k]).fold(0.0, f64::max);
    goes_on();
    for (z, traced) in surface.iter_mut().zip(heights) {
        if traced.is_nan() {
            *z = f64::NAN;
        }
    }
    let made = HeightMap::new(grid.points, grid.pixel, surface, map.precision())
        .map(|made| made.with_offset(map.offset()));
    let made = made.map_or(traced, |made| if is_periodic { made.periodic() } else { made });
    (made, TipReach { radius, unreached, untraced, largest })
}

/// The grid of a map, and the tip.
struct Grid {
    points: [usize; 2],
    pixel: [f64; 2],
    is_periodic: bool,
    radius: f64,
}

/// The lowest of parabolas at a point of a line: its height and the nearest point to its apex, counted on beyond the ends of a periodic line.
#[derive(Clone, Copy)]
struct Lowest {
    height: f64,
    apex: i32,
}

impl Grid {
    /// The lowest of the tips at all points at each point, with the displacement of its apex along x and y.
    fn eroded(&self, heights: &[f64], progress: &dyn Progress) -> (Vec<f64>, Vec<[i32; 2]>) {
        let [nx, ny] = self.points;
        let [row, line] = [nx, ny].map(|count| (count as f64).recip());
        let along_y: Vec<Vec<Lowest>> = heights
            .par_chunks(ny)
            .map(|heights| {
                progress.advance(row);
                self.lowest(heights, self.pixel[1])
            })
            .collect();
        let along_x: Vec<Vec<Lowest>> = (0..ny)
            .into_par_iter()
            .map(|iy| {
                progress.advance(line);
                let heights: Vec<f64> = along_y.iter().map(|row| row[iy].height).collect();
                self.lowest(&heights, self.pixel[0])
            })
            .collect();
        let each = (0..nx * ny).into_par_iter().map(|k| {
            let (ix, iy) = (k / ny, k % ny);
            if iy == 0 {
                progress.advance(row);
            }
            let Lowest { height, apex } = along_x[iy][ix];
            let apex_row = apex.rem_euclid(nx as i32) as usize;
            (height, [apex - ix as i32, along_y[apex_row][iy].apex - iy as i32])
        });
        each.unzip()
    }

    /// The lower envelope of a parabola at each place of a line (Felzenszwalb and Huttenlocher 2012), at its points. Places are a fraction of
    /// the pixel apart, and the lowest of three neighbouring ones is refined by a parabola: beside a summit the tip is displaced by
    /// less than a pixel.
    fn lowest(&self, line: &[f64], pixel: f64) -> Vec<Lowest> {
        let fine = self.refined(line);
        let (count, steepness) = (fine.len() as i32, (pixel / PARTS as f64).powi(2) / (2.0 * self.radius));
        let (first, end) = if self.is_periodic { (-count, 2 * count) } else { (0, count) };
        let height = |at: i32| fine[at.rem_euclid(count) as usize];
        // Apexes of the envelope, ascending, each from the place at which it becomes the lowest.
        let mut envelope: Vec<(i32, f64)> = Vec::new();
        for apex in first..end {
            let own = height(apex);
            if !own.is_finite() {
                continue;
            }
            let crossing = |other: i32| {
                let distance = f64::from(apex - other);
                0.5 * f64::from(apex + other) + (own - height(other)) / (2.0 * steepness * distance)
            };
            while envelope.last().is_some_and(|&(last, from)| crossing(last) <= from) {
                envelope.pop();
            }
            let from = envelope.last().map_or(f64::NEG_INFINITY, |&(last, _)| crossing(last));
            envelope.push((apex, from));
        }
        let mut index = 0;
        let at = |k: i32| {
            let place = k * PARTS as i32;
            while envelope.get(index + 1).is_some_and(|(_, from)| *from <= f64::from(place)) {
                index += 1;
            }
            let Some(&(apex, _)) = envelope.get(index) else {
                return Lowest { height: f64::INFINITY, apex: k };
            };
            let tip = |apex: i32| {
                let is_there = (first..end).contains(&apex);
                let height = if is_there { height(apex) } else { f64::NAN };
                height + steepness * f64::from(place - apex).powi(2)
            };
            let [before, lowest, after] = [apex - 1, apex, apex + 1].map(tip);
            let bend = before - 2.0 * lowest + after;
            // Not a number where a neighbour is missing.
            let below = (after - before).powi(2) / (8.0 * bend);
            let height = if below.is_finite() && bend > 0.0 { lowest - below } else { lowest };
            Lowest { height, apex: (f64::from(apex) / PARTS as f64).round() as i32 }
        };
        (0..line.len() as i32).map(at).collect()
    }

    /// A line at [`PARTS`] places per pixel: between its points the cubic through them with the slopes between their neighbours; NaN beside
    /// a missing point.
    fn refined(&self, line: &[f64]) -> Vec<f64> {
        let n = line.len() as isize;
        let height = |at: isize| {
            let at = if self.is_periodic { at.rem_euclid(n) } else { at };
            let found = usize::try_from(at).ok().and_then(|at| line.get(at));
            found.copied().filter(|z| z.is_finite()).unwrap_or(f64::NAN)
        };
        let places = if self.is_periodic { line.len() * PARTS } else { (line.len() - 1) * PARTS + 1 };
        let at = |place: usize| {
            let (k, t) = ((place / PARTS) as isize, (place % PARTS) as f64 / PARTS as f64);
            let [b, c] = [height(k), height(k + 1)];
            if t == 0.0 {
                return b;
            }
            // Beyond an end, and a missing point, the line goes on straight.
            let or = |z: f64, straight: f64| if z.is_nan() { straight } else { z };
            let (a, d) = (or(height(k - 1), 2.0 * b - c), or(height(k + 2), 2.0 * c - b));
            b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)))
        };
        (0..places).map(at).collect()
    }

    /// The number of `present` points whose place of the tip touches points that are not neighbours.
    fn unreached(&self, apexes: &[[i32; 2]], present: &[usize], progress: &dyn Progress) -> usize {
        let count = || Count::new(progress, 0.5, present.len());
        let [nx, ny] = self.points.map(|count| count as i32);
        let apex = |k: usize| {
            let at = [(k / self.points[1]) as i32 + apexes[k][0], (k % self.points[1]) as i32 + apexes[k][1]];
            (at[0].rem_euclid(nx) * ny + at[1].rem_euclid(ny)) as usize
        };
        let none = ([i32::MAX; 2], [i32::MIN; 2]);
        let mut extents = vec![none; apexes.len()];
        let mut joined = count();
        for &k in present {
            joined.add(1);
            let (low, high) = &mut extents[apex(k)];
            for axis in 0..2 {
                low[axis] = low[axis].min(apexes[k][axis]);
                high[axis] = high[axis].max(apexes[k][axis]);
            }
        }
        joined.end();
        let mut looked_at = count();
        let is_unreached = |k: &&usize| {
            looked_at.add(1);
            let (low, high) = extents[apex(**k)];
            (0..2).any(|axis| high[axis] - low[axis] > 1)
        };
        let unreached = present.iter().filter(is_unreached).count();
        looked_at.end();
        unreached
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::topography::summits::{Detail, Neighbours, find};

    const PIXEL: f64 = 0.5e-6;

    /// Three crossed waves along a side of `n` points, of `amplitude` (m), with sharp valleys.
    fn waves(n: usize, amplitude: f64) -> Vec<f64> {
        let wave = |k: usize| (std::f64::consts::TAU * 3.0 * k as f64 / n as f64).cos();
        let height = |k: usize| {
            let z = wave(k / n) + wave(k % n);
            amplitude * if z < 0.0 { 4.0 * z } else { z }
        };
        (0..n * n).map(height).collect()
    }

    fn map(heights: Vec<f64>) -> HeightMap {
        HeightMap::new([120; 2], [PIXEL; 2], heights, 0.0).unwrap().periodic()
    }

    /// What a tip traces of the surface between the points too: of one of 10 times as many.
    fn dilated(amplitude: f64, radius: f64) -> HeightMap {
        const FINER: usize = 10;
        let n = 120 * FINER;
        let negated = waves(n, -amplitude);
        let grid = Grid { points: [n; 2], pixel: [PIXEL / FINER as f64; 2], is_periodic: true, radius };
        let fine = grid.eroded(&negated, &Silent).0;
        map((0..120 * 120).map(|k| -fine[k / 120 * FINER * n + k % 120 * FINER]).collect())
    }

    /// The same by all places between the points of a smooth line.
    #[test]
    fn the_envelope_is_the_lowest_of_all_tips() {
        let height = |x: f64| 2e-7 * (0.4 * x).sin() + 1e-7 * (0.9 * x).cos();
        let line: Vec<f64> = (0..60).map(|k| height(f64::from(k))).collect();
        for radius in [1e-6, 5e-6, 1e-4] {
            let grid = Grid { points: [1, 60], pixel: [1e-6; 2], is_periodic: false, radius };
            let found = grid.lowest(&line, 1e-6);
            for k in 0..60 {
                let tip = |at: i32| {
                    let x = f64::from(at) / 100.0;
                    height(x) + ((f64::from(k) - x) * 1e-6).powi(2) / (2.0 * radius)
                };
                let apex = (0..=5900).min_by(|a, b| tip(*a).total_cmp(&tip(*b))).unwrap();
                // The last pixels are interpolated with less.
                if !(200..=5700).contains(&apex) {
                    continue;
                }
                let Lowest { height, apex: nearest } = found[k as usize];
                assert!((height - tip(apex)).abs() < 2e-9, "{radius} {k}: {height:e} {:e}", tip(apex));
                assert!((f64::from(nearest) - f64::from(apex) / 100.0).abs() < 1.0, "{radius} {k}");
            }
        }
    }

    /// A map that a tip has traced can be traced by it and by sharper tips, and not by blunter ones.
    #[test]
    fn a_traced_map_tells_blunter_tips_from_its_own() {
        let traced = dilated(3e-7, 5e-6);
        let untraced = |radius: f64| eroded(&traced, radius).1.untraced;
        assert_eq!([2.5e-6, 5e-6].map(untraced), [0.0, 0.0]);
        assert!(untraced(2e-4) > 0.1, "{}", untraced(2e-4));
    }

    /// Summits are as they were, valleys narrower than the tip are not, and a tip that fits into them reaches all.
    #[test]
    fn summits_are_recovered_and_valleys_are_not_reached() {
        let own = map(waves(120, 2e-7));
        let radius_of_summits = |map: &HeightMap| {
            let curvatures = find(map, Neighbours::Four, Detail::ALL).curvatures;
            curvatures.len() as f64 / curvatures.iter().sum::<f64>()
        };
        let tip = 2e-5;
        let traced = dilated(2e-7, tip);
        let (recovered, reach) = eroded(&traced, tip);
        let [own_radius, traced_radius, recovered_radius] =
            [&own, &traced, &recovered].map(radius_of_summits);
        assert!((traced_radius / (own_radius + tip) - 1.0).abs() < 0.05, "{traced_radius:e} {own_radius:e}");
        assert!((recovered_radius / own_radius - 1.0).abs() < 0.05, "{recovered_radius:e} {own_radius:e}");
        assert!(reach.unreached > 0.1 && reach.largest > 0.0, "{reach:?}");
        let above = |is_counted: fn(f64) -> bool| {
            let both = recovered.heights().iter().zip(own.heights());
            both.filter(|(_, own)| is_counted(**own))
                .map(|(found, own)| (found - own).abs())
                .fold(0.0, f64::max)
        };
        let [on_summits, in_valleys] = [above(|z| z > 1e-7), above(|z| z < -1e-6)];
        assert!(on_summits < 1e-9 && in_valleys > 1e-8, "{on_summits:e} {in_valleys:e}");
        let (_, sharp) = eroded(&dilated(2e-7, 1e-6), 1e-6);
        assert_eq!((sharp.unreached, sharp.untraced), (0.0, 0.0));
    }

    #[test]
    fn missing_points_stay_missing_and_bound_nothing() {
        let height = |k: usize| if k == 40 { f64::NAN } else { 1e-8 * (k % 9) as f64 };
        let map = HeightMap::new([9, 9], [1e-6; 2], (0..81).map(height).collect(), 0.0).unwrap();
        let (found, reach) = eroded(&map, 1e-6);
        assert!(found.heights()[40].is_nan() && found.heights().iter().filter(|z| z.is_nan()).count() == 1);
        assert_eq!(reach.untraced, 0.0);
    }
}
