//! Comparisons of the boundary element solver, on coarse grids.

use asperity::progress::Silent;
use asperity_evidence::solver::ensemble::{PUBLISHED, ensemble};
use asperity_evidence::solver::grid::{CASES, GRIDS, Grids, MAY_EXCEED, grid_errors};
use asperity_evidence::solver::{
    Benchmark, BenchmarkQuantity, LAYERED_CASES, full_contact, hertz, layered, partial_contact,
};

fn assert_within(benchmarks: &[Benchmark]) {
    assert!(!benchmarks.is_empty());
    for benchmark in benchmarks {
        assert!(benchmark.is_within(), "{benchmark:?}");
        if let Some([exact, computed]) = benchmark.values {
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
    use BenchmarkQuantity::{Area, LimitArea, RawArea};
    let benchmarks = ensemble(&[256, 512], 2, &PUBLISHED[5..7], |k| [k as u8; 32], &Silent).unwrap();
    assert_within(&benchmarks);
    assert_eq!(benchmarks.len(), 2 * (2 * 2 + 1));
    for limit in benchmarks.iter().filter(|benchmark| benchmark.quantity == LimitArea) {
        let of = |points: usize, quantity: BenchmarkQuantity| {
            let is_it =
                |one: &&Benchmark| (&one.case, one.points, one.quantity) == (&limit.case, points, quantity);
            benchmarks.iter().find(is_it).unwrap().values.unwrap()[1]
        };
        let [coarse, fine] = [256, 512].map(|points| of(points, RawArea));
        let linear = 2.0 * fine - coarse;
        assert!((of(512, LimitArea) - linear).abs() < 1e-14 && limit.allowed.unwrap() > 0.05, "{limit:?}");
        // Counting points overestimates the area, less so on finer grids.
        assert!(coarse > fine && fine > linear && of(512, Area) < fine, "{limit:?}");
    }
    assert!(PUBLISHED.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] < pair[1][1]));
}

/// The long form is the experiment `grid-bounds`.
#[test]
fn few_errors_by_the_grid_exceed_their_bounds() {
    let task = Grids { points: 512, realisations: 3, pressures: &[0.004, 0.02], error: 1e-6 };
    let found = grid_errors(&task, |realisation| [realisation as u8 + 40; 32], &Silent).unwrap();
    assert_eq!(found.len(), CASES.len() * GRIDS.len());
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
