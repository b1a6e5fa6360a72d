//! A wavy surface on a half-space: the closed form of Westergaard for heights h cos(2 pi x/lambda), with lambda = 1 m and
//! E* = 1 Pa (Johnson, Greenwood and Higginson 1985).

use std::f64::consts::{PI, TAU};

use asperity::HeightMap;
use asperity::bem::Boundary;

use super::{options, solved};

const HEIGHT: f64 = 0.01;

/// At p = share p*: errors of the contact's width over the wavelength, of the mean gap over the height, and of the pressures
/// (r.m.s. over r.m.s.).
fn errors(points: usize, share: f64) -> [f64; 3] {
    let along_y = 4;
    let x = |k: usize| ((k / along_y) as f64 + 0.317) / points as f64 - 0.5;
    let heights = (0..points * along_y).map(|k| HEIGHT * (TAU * x(k)).cos()).collect();
    let map = HeightMap::new([points, along_y], [(points as f64).recip(); 2], heights, 0.0).unwrap();
    let mean = share * PI * HEIGHT;
    let contact = solved(&map, options(Boundary::Periodic, 1e-11, None), mean);
    // sin^2(pi a/lambda) = p/p*, half the width a.
    let sine = share.sqrt();
    let a = sine.asin() / PI;
    let gap = 2.0 * HEIGHT * (0.5 * (1.0 - share) + share * sine.ln());
    let [mut apart, mut norm] = [0.0; 2];
    for (k, p) in contact.pressures().iter().enumerate() {
        let inside = (share - (PI * x(k)).sin().powi(2)).max(0.0);
        let exact = 2.0 * mean / share * (PI * x(k)).cos() * inside.sqrt();
        apart += (p - exact).powi(2);
        norm += exact.powi(2);
    }
    [contact.raw_area_ratio() - 2.0 * a, (contact.mean_gap() - gap) / HEIGHT, (apart / norm).sqrt()]
}

#[test]
fn width_pressures_and_gap_of_a_wave() {
    for share in [0.05, 0.3, 0.7, 0.95] {
        let found = [64, 256, 1024].map(|points| (points as f64, errors(points, share)));
        for (points, [width, gap, pressures]) in found {
            assert!(width.abs() < 2.0 / points, "{share}: {found:?}");
            assert!(gap.abs() < 4.0 / (points * points), "{share}: {found:?}");
            assert!(pressures < 4.0 / points, "{share}: {found:?}");
        }
    }
}
