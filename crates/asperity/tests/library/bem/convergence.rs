//! Every load converges, from a few points in contact to all.

use asperity::Material;
use asperity::bem::{Boundary, ElasticPair, Solver};
use asperity::progress::Silent;

use super::{options, rough, solved, unit_body, with_heights};

#[test]
fn maps_of_all_kinds_at_all_loads() {
    let body = unit_body();
    let [soft, stiff] = [0.1, 20.0].map(|young| Material::new(young, 0.3, None, None).unwrap());
    let sizes = [[96, 96], [100, 130], [127, 97], [64, 160], [128, 128]];
    let loads = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.05, 0.2, 0.5, 1.0, 3.0];
    let (mut solved, mut most_steps) = (0, 0);
    // Sizes, spectra, borders and layers come together again after sixty.
    for seed in 0..60 {
        let points = sizes[seed % sizes.len()];
        let hurst = [0.3, 0.8][seed % 2];
        let shortest = [2.0, 4.0, 8.0][seed % 3] / points[0] as f64;
        let map = rough(points, hurst, [0.25, 0.9][seed / 2 % 2], shortest, seed as u8);
        let boundary = Boundary::ALL[seed % 3];
        let layer = [None, Some((&soft, 0.02)), Some((&stiff, 0.01)), None][seed % 4];
        let pair = ElasticPair::new(&body, &body, layer);
        let cap = (layer.is_none() && seed % 5 < 2).then_some(0.3);
        let solver = Solver::new(&map, &pair, &options(boundary, 1e-9, cap)).unwrap();
        for load in loads.into_iter().filter(|&load| cap.is_none_or(|cap| load < cap)) {
            let contact = solver.at_pressure(load, &Silent);
            let contact = contact.unwrap_or_else(|error| panic!("map {seed}: {error}"));
            let found = contact.pressure() / load - 1.0;
            assert!(contact.error <= 1e-9 && found.abs() < 1e-12, "{seed}: {load}: {found:e}");
            let limit = cap.unwrap_or(f64::INFINITY);
            assert!(contact.pressures().iter().all(|&p| (0.0..=limit).contains(&p)), "{seed}: {load}");
            most_steps = most_steps.max(contact.steps);
            solved += 1;
        }
    }
    assert!(solved > 540, "{solved}");
    assert!(most_steps < 400, "{most_steps} steps");
}

/// Users of a peer report that it stops converging above p = 0.07 E* there.
#[test]
fn a_hardness_of_a_tenth_and_a_gradient_of_eight_hundredths() {
    let map = with_heights(&rough([128, 128], 0.8, 0.25, 8.0 / 128.0, 3), |z| 0.08 * z);
    let mut before = 0.0;
    for load in [0.01, 0.05, 0.07, 0.08, 0.09, 0.095, 0.099] {
        let contact = solved(&map, options(Boundary::Periodic, 1e-9, Some(0.1)), load);
        assert!(contact.raw_area_ratio() > before && contact.raw_area_ratio() >= load / 0.1);
        before = contact.raw_area_ratio();
    }
}

/// A low cap: all points in contact are at it, but for one that carries the rest of the load, or none where the load is that
/// of a whole number of points.
#[test]
fn all_contacts_at_the_cap() {
    let map = rough([64, 64], 0.8, 0.9, 0.1, 4);
    for boundary in Boundary::ALL {
        for cap in [1e-2, 1e-3, 1e-4, 1e-6] {
            for points in [1.0, 64.0, 100.5, 2048.0, 4095.0] {
                let load = cap * points / 4096.0;
                let contact = solved(&map, options(boundary, 1e-9, Some(cap)), load);
                assert!((contact.pressure() / load - 1.0).abs() < 1e-12, "{boundary:?} {cap} {points}");
            }
        }
    }
}

/// Full contact under a load ten thousand times what flattens the map: displacements in single precision are then known no better
/// than to the heights.
#[test]
fn displacements_far_larger_than_the_heights() {
    let map = with_heights(&rough([96, 96], 0.8, 0.25, 8.0 / 96.0, 5), |z| 1e-4 * z);
    for boundary in Boundary::ALL {
        for load in [0.1, 1.0] {
            let contact = solved(&map, options(boundary, 1e-8, None), load);
            assert_eq!(contact.area_ratio(), 1.0, "{boundary:?} {load}");
            assert!(contact.error <= 1e-8 && contact.steps < 400, "{boundary:?} {load}: {}", contact.steps);
        }
    }
}

/// Terraces below a low cap at a moderate error: points that a step has left a small pressure are no contacts. With those there were 31
/// too many, of which 5 are left.
#[test]
fn small_pressures_of_open_points_are_no_contacts() {
    let count = 192;
    let mut apart = 0.0;
    for seed in 0..4 {
        let map = rough([count; 2], 0.8, 0.9, 8.0 / count as f64, seed);
        let squares: f64 = map.heights().iter().map(|z| z * z).sum();
        let terrace = 0.3 * squares.sqrt() / count as f64;
        let map = with_heights(&map, |z| (z / terrace).round() * terrace);
        for boundary in [Boundary::Periodic, Boundary::Mirrored] {
            let [area, exact] = [1e-6, 1e-10]
                .map(|error| solved(&map, options(boundary, error, Some(0.1)), 0.03).raw_area_ratio());
            apart += (area - exact).abs() * (count * count) as f64;
        }
    }
    assert!(apart < 12.0, "{apart}");
}
