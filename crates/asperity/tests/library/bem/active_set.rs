//! A second algorithm: the matrix of displacements written out, and the points in contact guessed, solved for and
//! corrected until none pulls and none overlaps.

use std::f64::consts::{PI, TAU};

use asperity::bem::{Boundary, ElasticPair, Solver};
use asperity::progress::Silent;
use asperity::{HeightMap, Material};
use nalgebra::{DMatrix, DVector};

use super::{options, unit_body};

/// Displacement at each point under unit pressure at each other, by sums over waves.
fn matrix(points: [usize; 2], pixel: [f64; 2], pair: &ElasticPair, is_mirrored: bool) -> DMatrix<f64> {
    let [nx, ny] = points;
    let (turn, period) = if is_mirrored { (PI, 1.0) } else { (TAU, 0.0) };
    let unit = |axis: usize| turn / (points[axis] as f64 * pixel[axis]);
    let mut matrix = DMatrix::zeros(nx * ny, nx * ny);
    for wave in 1..nx * ny {
        let (i, j) = (wave / ny, wave % ny);
        let fold = |k: usize, n: usize| if is_mirrored { k } else { k.min(n - k) };
        let q = (unit(0) * fold(i, nx) as f64).hypot(unit(1) * fold(j, ny) as f64);
        let scale = pair.compliance(q) / (nx * ny) as f64;
        let angle = |k: usize| {
            let at = |index: usize, wave: usize, count: usize| {
                turn * wave as f64 * (index as f64 + 0.5 * period) / count as f64
            };
            (at(k / ny, i, nx), at(k % ny, j, ny))
        };
        let all: Vec<(f64, f64)> = (0..nx * ny).map(angle).collect();
        if is_mirrored {
            let weight = if i == 0 || j == 0 { 2.0 } else { 4.0 };
            let field = DVector::from_iterator(nx * ny, all.iter().map(|(x, y)| x.cos() * y.cos()));
            matrix += weight * scale * &field * field.transpose();
        } else {
            for turned in [0.0, 0.5 * PI] {
                let field = DVector::from_iterator(nx * ny, all.iter().map(|(x, y)| (x + y - turned).cos()));
                matrix += scale * &field * field.transpose();
            }
        }
    }
    matrix
}

#[derive(Clone, Copy, PartialEq)]
enum Of {
    Gap,
    Contact,
    Cap,
}

/// The pressures by pivoting between gap, contact and cap.
fn pressures(k: &DMatrix<f64>, heights: &[f64], mean: f64, cap: f64) -> Vec<f64> {
    let count = heights.len();
    let mut of = vec![Of::Contact; count];
    for _ in 0..200 {
        let inside: Vec<usize> = (0..count).filter(|&k| of[k] == Of::Contact).collect();
        let capped: Vec<usize> = (0..count).filter(|&k| of[k] == Of::Cap).collect();
        // Pressures of the points in contact, and the gap there.
        let n = inside.len();
        let mut system = DMatrix::zeros(n + 1, n + 1);
        let mut right = DVector::zeros(n + 1);
        for (row, &a) in inside.iter().enumerate() {
            for (column, &b) in inside.iter().enumerate() {
                system[(row, column)] = k[(a, b)];
            }
            system[(row, n)] = -1.0;
            system[(n, row)] = 1.0;
            right[row] = heights[a] - cap.min(1e300) * capped.iter().map(|&b| k[(a, b)]).sum::<f64>();
        }
        right[n] = mean * count as f64 - if capped.is_empty() { 0.0 } else { cap * capped.len() as f64 };
        let solved = system.full_piv_lu().solve(&right).unwrap();
        let mut p = DVector::zeros(count);
        inside.iter().enumerate().for_each(|(row, &a)| p[a] = solved[row]);
        capped.iter().for_each(|&a| p[a] = cap);
        let gap = k * &p - DVector::from_column_slice(heights);
        let level = solved[n];
        let scale = 1e-12 * heights.iter().fold(0.0f64, |most, z| most.max(z.abs()));
        let now: Vec<Of> = (0..count)
            .map(|a| match of[a] {
                Of::Contact if p[a] < 0.0 => Of::Gap,
                Of::Contact if p[a] > cap => Of::Cap,
                Of::Gap if gap[a] < level - scale => Of::Contact,
                Of::Cap if gap[a] > level + scale => Of::Contact,
                same => same,
            })
            .collect();
        if now == of {
            return p.as_slice().to_vec();
        }
        of = now;
    }
    panic!("the pivots cycle")
}

#[test]
fn pressures_are_those_of_a_second_algorithm() {
    let body = unit_body();
    let soft = Material::new(0.2, 0.4, None, None).unwrap();
    let bare = ElasticPair::new(&body, &body, None);
    let layered = ElasticPair::new(&body, &body, Some((&soft, 0.05)));
    let mut compared = 0;
    for (points, pixel) in [([16, 12], [0.05, 0.08]), ([13, 15], [0.06, 0.06]), ([11, 16], [0.1, 0.05])] {
        let height = |k: usize| {
            let (x, y) = ((k / points[1]) as f64, (k % points[1]) as f64);
            0.01 * ((1.3 * x + 0.4).sin()
                + (0.9 * y).cos() * (0.5 * x).sin()
                + 0.3 * (2.1 * x + 1.7 * y).sin())
        };
        let heights: Vec<f64> = (0..points[0] * points[1]).map(height).collect();
        let map = HeightMap::new(points, pixel, heights.clone(), 0.0).unwrap();
        for boundary in [Boundary::Periodic, Boundary::Mirrored] {
            for (pair, caps) in [(&bare, vec![None, Some(0.15)]), (&layered, vec![None])] {
                let k = matrix(points, pixel, pair, boundary == Boundary::Mirrored);
                for cap in caps {
                    for mean in [1e-4, 3e-3, 0.03, 0.1] {
                        let exact = pressures(&k, &heights, mean, cap.unwrap_or(f64::INFINITY));
                        let solver = Solver::new(&map, pair, &options(boundary, 1e-10, cap)).unwrap();
                        let found = solver.at_pressure(mean, &Silent).unwrap();
                        let most = exact.iter().fold(0.0f64, |most, &p| most.max(p));
                        let apart = found.pressures().iter().zip(&exact).map(|(a, b)| (a - b).abs());
                        let error = apart.fold(0.0, f64::max) / most;
                        assert!(error < 1e-8, "{points:?} {boundary:?} {cap:?} {mean}: {error:e}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert_eq!(compared, 3 * 2 * 3 * 4);
}
