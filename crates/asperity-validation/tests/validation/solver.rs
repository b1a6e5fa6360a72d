//! Comparisons of the boundary element solver, on coarse grids.

use asperity::progress::Silent;
use asperity_validation::solver::ensemble::{EnsemblePoint, EnsembleTask, ensemble};
use asperity_validation::solver::grid::{GRIDS, GridCase, GridTask, MAY_EXCEED, grid_errors};
use asperity_validation::solver::published::PUBLISHED;
use asperity_validation::solver::work::{WorkTask, work};
use asperity_validation::solver::{
    Benchmark, LAYERED_CASES, full_contact, hertz, hertz_profile, layered, partial_contact, wave_profile,
};

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
fn profiles_lie_on_the_solutions() {
    let profiles = [hertz_profile(16).unwrap(), wave_profile(64, 0.3).unwrap()];
    for profile in profiles {
        for (x, p) in &profile.computed {
            let near = profile.exact.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(x)).unwrap();
            // Near the edge a pixel is in contact as a whole or not at all.
            assert!((p - near[0].1).abs() < 0.2, "{}: {p} at {x}", profile.case);
        }
        let close = profile.computed.iter().filter(|(x, p)| {
            profile
                .exact
                .windows(2)
                .any(|pair| (pair[0].0..=pair[1].0).contains(x) && (p - pair[0].1).abs() < 0.02)
        });
        assert!(close.count() * 10 > 8 * profile.computed.len(), "{}", profile.case);
    }
}

#[test]
fn areas_of_the_ensemble_are_near_the_published_ones() {
    let task =
        EnsembleTask { points: vec![256, 512], realisations: 2, pressures: vec![0.065, 0.147], error: 1e-5 };
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

#[test]
fn work_grows_with_the_points() {
    // Both begin on a coarser grid: one that does not needs more than the next finer one.
    let task = WorkTask { points: vec![128, 256], pressures: vec![0.05], error: 1e-7 };
    let contacts = work(&task, [3; 32], &Silent).unwrap();
    assert!(contacts.iter().all(|point| point.error <= 1e-7 && point.convolutions >= point.steps));
    assert!(contacts[1].convolutions > contacts[0].convolutions, "{contacts:?}");
}

/// The long form is the experiment `solver-validation`.
#[test]
fn few_errors_by_the_grid_exceed_their_bounds() {
    let task = GridTask { points: 512, realisations: 3, pressures: vec![0.004, 0.02], error: 1e-6 };
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
