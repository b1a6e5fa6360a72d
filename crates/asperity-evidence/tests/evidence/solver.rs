//! Comparisons of the boundary element solver, on coarse grids.

use asperity::progress::Silent;
use asperity_evidence::solver::ensemble::{Ensemble, EnsemblePoint, PUBLISHED, ensemble};
use asperity_evidence::solver::grid::{GRIDS, GridCase, Grids, MAY_EXCEED, grid_errors};
use asperity_evidence::solver::{Benchmark, LAYERED_CASES, full_contact, hertz, layered, partial_contact};

fn assert_within(benchmarks: &[Benchmark]) {
    assert!(!benchmarks.is_empty());
    for benchmark in benchmarks {
        assert!(benchmark.is_within(), "{benchmark:?}");
        if let Some((exact, computed)) = benchmark.exact.zip(benchmark.computed) {
            let is_difference = benchmark.problem.name() == "sinusoid";
            let error = if is_difference { computed - exact } else { computed / exact - 1.0 };
            assert_eq!(benchmark.error, error, "{benchmark:?}");
        }
    }
}

#[test]
fn known_solutions_are_within_their_bounds() {
    for pixels in [8, 16, 32] {
        assert_within(&hertz(pixels).unwrap());
    }
    for case in &LAYERED_CASES {
        assert_within(&layered(case, 24).unwrap());
    }
    for points in [32, 64, 128] {
        for share in [0.05, 0.3, 0.7, 0.95] {
            assert_within(&partial_contact(points, share).unwrap());
        }
    }
    assert_within(&full_contact().unwrap());
}

/// A bound that cannot be exceeded would show nothing: each is at most eight times the error.
#[test]
fn bounds_are_near_the_errors() {
    let benchmarks = hertz(32).unwrap();
    for benchmark in benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()) {
        assert!(benchmark.error.abs() > benchmark.allowed.unwrap() / 8.0, "{benchmark:?}");
        let worse = Benchmark { error: 8.0 * benchmark.error, ..benchmark.clone() };
        assert!(!worse.is_within());
    }
}

#[test]
fn areas_of_the_ensemble_are_near_the_published_ones() {
    let task = Ensemble { points: &[256, 512], realisations: 2, pressures: &[0.065, 0.147], error: 1e-5 };
    let results = ensemble(&task, |realisation| [realisation as u8; 32], &Silent).unwrap();
    assert_eq!((results.points.len(), results.extrapolated.len()), (4, 2));
    for limit in &results.extrapolated {
        assert!(limit.difference().unwrap().mean.abs() < 0.06, "{limit:?}");
        assert!((limit.area.mean / limit.raw_area.mean - 1.0).abs() < 0.01, "{limit:?}");
        let on_grid = |points: usize| {
            let is_it =
                |point: &&EnsemblePoint| point.points == Some(points) && point.pressure == limit.pressure;
            results.points.iter().find(is_it).unwrap()
        };
        // Counting points overestimates the area, less so on finer grids.
        let [coarse, fine] = [256, 512].map(on_grid);
        assert!(coarse.raw_area.mean > fine.raw_area.mean && fine.raw_area.mean > limit.raw_area.mean);
        assert!(fine.area.mean < fine.raw_area.mean);
    }
    assert!(
        PUBLISHED.windows(2).all(|pair| pair[0].pressure < pair[1].pressure && pair[0].area < pair[1].area)
    );
}

/// The long form is the experiment `grid-bounds`.
#[test]
fn few_errors_by_the_grid_exceed_their_bounds() {
    let task = Grids { points: 512, realisations: 3, pressures: &[0.004, 0.02], error: 1e-6 };
    let found = grid_errors(&task, |realisation| [realisation as u8 + 40; 32], &Silent).unwrap();
    assert_eq!(found.len(), GridCase::ALL.len() * GRIDS.len());
    let contacts: usize = found.iter().map(|point| point.contacts).sum();
    assert_eq!(contacts, found.len() * 6);
    for quantity in 0..3 {
        let exceeded: usize = found.iter().map(|point| point.checks[quantity].exceeded).sum();
        assert!(exceeded as f64 <= MAY_EXCEED * contacts as f64, "{quantity}: {exceeded} of {contacts}");
        // On the coarsest grids the bounds are at most six times the errors.
        let coarse = found.iter().filter(|point| point.points == [2, 2]);
        let checks = coarse.map(|point| point.checks[quantity]);
        for check in checks {
            assert!(check.bound < 6.0 * check.error, "{quantity}: {check:?}");
        }
    }
}
