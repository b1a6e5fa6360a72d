//! The stiffness of a contact from its fixed points.

use asperity::Material;
use asperity::bem::{Boundary, Contact, ElasticPair, Solver};
use asperity::progress::Silent;
use asperity::topography::Blocks;

use super::{bare, options, paraboloid, rough, unit_body, with_heights};

/// Hertz: 2 a E*, at any load. The border of a patch that is given acts a tenth of a pixel inside of it: of first order.
#[test]
fn a_flat_punch() {
    const RADIUS: f64 = 0.1;
    let nominal = (3.0 * RADIUS).powi(2);
    let pair = bare();
    for pixels in [8, 16, 32, 64] {
        let (paraboloid, _) = paraboloid(3 * pixels, RADIUS / pixels as f64);
        let punch = with_heights(&paraboloid, |z| if z >= -0.5 * RADIUS * RADIUS { 0.0 } else { -1.0 });
        let solver = Solver::new(&punch, &pair, &options(Boundary::Finite, 1e-10, None)).unwrap();
        let [light, heavy] = [1e-4, 1e-3].map(|load| {
            let contact = solver.at_pressure(load / nominal, &Silent).unwrap();
            nominal * solver.tangent(&contact, &Silent).unwrap().stiffness_of_approach() / (2.0 * RADIUS)
        });
        let inside = (1.0 - light) * pixels as f64;
        assert!((0.07..0.15).contains(&inside), "{pixels} pixels: {inside}");
        assert!((light - heavy).abs() < 1e-9);
    }
}

/// Between two changes of its points the contact is linear in the load.
#[test]
fn it_is_the_derivative_by_the_load() {
    const STEP: f64 = 1e-6;
    let body = unit_body();
    let soft = Material::new(0.3, 0.45, None, None).unwrap();
    let bare = bare();
    let layered = ElasticPair::new(&body, &body, Some((&soft, 0.02)));
    let map = rough([96, 80], 0.8, 0.25, 8.0 / 96.0, 8);
    for (pair, boundary, cap) in [
        (&bare, Boundary::Periodic, None),
        (&bare, Boundary::Mirrored, None),
        (&bare, Boundary::Finite, None),
        (&layered, Boundary::Periodic, None),
        (&layered, Boundary::Mirrored, None),
        (&bare, Boundary::Periodic, Some(0.4)),
        (&bare, Boundary::Mirrored, Some(0.2)),
        (&bare, Boundary::Finite, Some(0.2)),
    ] {
        let solver = Solver::new(&map, pair, &options(boundary, 1e-12, cap)).unwrap();
        for p in [0.002, 0.01, 0.05, 0.15] {
            let at = |factor: f64| solver.at_pressure(factor * p, &Silent).unwrap();
            let tangent = solver.tangent(&at(1.0), &Silent).unwrap();
            let [low, high] = [at(1.0 - STEP), at(1.0 + STEP)];
            let slope = |of: fn(&Contact) -> f64| (of(&high) - of(&low)) / (2.0 * STEP * p);
            let gap = -slope(Contact::mean_gap) * tangent.stiffness() - 1.0;
            let approach = slope(Contact::approach) * tangent.stiffness_of_approach() - 1.0;
            let case = format!("{boundary:?} {cap:?} {p}");
            assert!(gap.abs() < 1e-4 && approach.abs() < 1e-4, "{case}: {gap:e} {approach:e}");
            let is_one = boundary != Boundary::Finite && cap.is_none();
            let apart = tangent.stiffness() / tangent.stiffness_of_approach() - 1.0;
            assert_eq!(apart == 0.0, is_one, "{case}: {apart}");
            let most = tangent.pressures().iter().fold(0.0f64, |most, p| most.max(*p));
            assert!(tangent.pressures().iter().all(|p| *p > -1e-6 * most), "{case}");
        }
    }
}

/// At the default error the points in contact are nearly those of the exact solution.
#[test]
fn the_error_of_the_solver_hardly_counts() {
    let pair = bare();
    let map = rough([128, 128], 0.8, 0.25, 8.0 / 128.0, 3);
    for boundary in Boundary::ALL {
        for p in [0.003, 0.03, 0.3] {
            let [coarse, fine] = [1e-6, 1e-12].map(|error| {
                let solver = Solver::new(&map, &pair, &options(boundary, error, None)).unwrap();
                let contact = solver.at_pressure(p, &Silent).unwrap();
                (solver.tangent(&contact, &Silent).unwrap(), contact.steps)
            });
            let error = (coarse.0.stiffness_of_approach() / fine.0.stiffness_of_approach()).ln();
            assert!(error.abs() < 1e-6 && coarse.0.error < 1e-6, "{boundary:?} {p}: {error:e}");
            assert!(coarse.0.steps <= coarse.1, "{boundary:?} {p}: {} of {}", coarse.0.steps, coarse.1);
        }
    }
}

#[test]
fn blocks_share_an_increase_of_the_load() {
    let pair = bare();
    let map = rough([96, 96], 0.8, 0.25, 8.0 / 96.0, 8);
    let blocks = Blocks { points: map.points(), counts: [3, 2] };
    let solver = Solver::new(&map, &pair, &options(Boundary::Periodic, 1e-9, Some(0.4))).unwrap();
    let at = |p: f64| solver.at_pressure(p, &Silent).unwrap();
    let tangent = solver.tangent(&at(0.05), &Silent).unwrap();
    let shares = tangent.block_shares(&blocks);
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{shares:?}");
    let [low, high] = [0.0499, 0.0501].map(|p| at(p).block_sums(&blocks));
    for ((share, low), high) in shares.iter().zip(&low).zip(&high) {
        assert!((share - (high[0] - low[0]) / 0.0002).abs() < 0.01, "{share} {low:?} {high:?}");
    }
}

#[test]
fn there_is_none_in_full_contact_and_where_no_point_may_change() {
    let pair = bare();
    let map = rough([64, 64], 0.8, 0.9, 0.1, 4);
    let tangent = |boundary: Boundary, cap: Option<f64>, p: f64| {
        let solver = Solver::new(&map, &pair, &options(boundary, 1e-9, cap)).unwrap();
        solver.tangent(&solver.at_pressure(p, &Silent).unwrap(), &Silent).map(|tangent| tangent.stiffness())
    };
    for boundary in [Boundary::Periodic, Boundary::Mirrored] {
        assert!(tangent(boundary, None, 50.0).is_none() && tangent(boundary, None, 0.5).is_some());
        // The load of 64 points at the cap.
        assert!(tangent(boundary, Some(1e-4), 64.0 * 1e-4 / 4096.0).is_none(), "{boundary:?}");
    }
    // A single point in contact.
    assert!(tangent(Boundary::Periodic, None, 1e-7).is_some_and(|stiffness| stiffness > 0.0));
}
