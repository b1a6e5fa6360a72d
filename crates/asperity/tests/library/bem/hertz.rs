//! A paraboloid on a half-space (Hertz): R = 1 m, E* = 1 Pa, contact radius 0.1 m, nothing repeats.

use std::f64::consts::PI;

use asperity::bem::{Boundary, Solver};
use asperity::progress::Silent;

use super::{bare, options, paraboloid};

const RADIUS: f64 = 0.1;

/// Relative errors of indentation, raw and corrected area, peak pressure and stiffness, and the r.m.s. error of the pressures over
/// their own r.m.s.
fn errors(pixels: usize) -> [f64; 6] {
    let pixel = RADIUS / pixels as f64;
    let count = 3 * pixels;
    let (map, distances) = paraboloid(count, pixel);
    let pair = bare();
    let solver = Solver::new(&map, &pair, &options(Boundary::Finite, 1e-10, None)).unwrap();
    let nominal = (count as f64 * pixel).powi(2);
    let contact = solver.at_pressure(4.0 / 3.0 * RADIUS.powi(3) / nominal, &Silent).unwrap();
    let stiffness = nominal * solver.tangent(&contact, &Silent).unwrap().stiffness_of_approach();
    let peak = 2.0 * RADIUS / PI;
    let area = PI * RADIUS * RADIUS / nominal;
    let [mut apart, mut norm, mut highest] = [0.0f64; 3];
    for (p, r) in contact.pressures().iter().zip(&distances) {
        let exact = peak * (1.0 - (r / RADIUS).powi(2)).max(0.0).sqrt();
        apart += (p - exact).powi(2);
        norm += exact.powi(2);
        highest = highest.max(*p);
    }
    [
        contact.approach() / (RADIUS * RADIUS) - 1.0,
        contact.raw_area_ratio() / area - 1.0,
        contact.area_ratio() / area - 1.0,
        highest / peak - 1.0,
        stiffness / (2.0 * RADIUS) - 1.0,
        (apart / norm).sqrt(),
    ]
}

#[test]
fn indentation_is_of_second_order() {
    let found = [8, 16, 32, 64].map(errors);
    let [_, _, middle, fine] = found.map(|[indentation, ..]| indentation.abs());
    assert!(fine < 2e-5, "{found:?}");
    let order = (middle / fine).log2();
    assert!((1.7..2.5).contains(&order), "order {order}: {found:?}");
    let [_, area, corrected, peak, _, pressures] = found[3];
    assert!(corrected.abs() < 2e-3 && area < 0.02, "{found:?}");
    assert!(peak.abs() < 1e-3 && pressures < 0.01, "{found:?}");
    for ([.., stiffness, _], allowed) in found.iter().zip([1e-2, 4e-3, 2e-3, 5e-4]) {
        assert!(stiffness.abs() < allowed, "{found:?}");
    }
}
