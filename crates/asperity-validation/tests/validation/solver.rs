//! Comparisons of the boundary element solver, on coarse grids.

use asperity::progress::Silent;
use asperity_validation::solver::ensemble::{EnsembleTask, ensemble};
use asperity_validation::solver::published::{ENSEMBLE, PUBLISHED, published};
use asperity_validation::solver::work::{WorkTask, work};
use asperity_validation::solver::{
    LAYERED_CASES, Measured, full_contact, hertz, hertz_profile, layered, partial_contact, wave_profile,
};

fn assert_within(measured: &[Measured]) {
    assert!(!measured.is_empty());
    for one in measured {
        assert!(one.holds(), "{one:?}");
        if let Some((exact, found)) = one.exact.zip(one.found) {
            let error = if one.problem.name() == "sinusoid" { found - exact } else { found / exact - 1.0 };
            assert_eq!(one.error, error, "{one:?}");
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

/// A bound that cannot be exceeded would show nothing: each is at most eight times the error found.
#[test]
fn bounds_are_near_the_errors() {
    let measured = hertz(32).unwrap();
    for one in measured.iter().filter(|one| one.allowed.is_some()) {
        assert!(one.error.abs() > one.allowed.unwrap() / 8.0, "{one:?}");
        let worse = Measured { error: 8.0 * one.error, ..one.clone() };
        assert!(!worse.holds());
    }
}

#[test]
fn profiles_lie_on_the_solutions() {
    let profiles = [hertz_profile(16).unwrap(), wave_profile(64, 0.3).unwrap()];
    for profile in profiles {
        for (x, p) in &profile.found {
            let near = profile.exact.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(x)).unwrap();
            // Near the edge a pixel is in contact as a whole or not at all.
            assert!((p - near[0].1).abs() < 0.2, "{}: {p} at {x}", profile.case);
        }
        let close = profile.found.iter().filter(|(x, p)| {
            profile
                .exact
                .windows(2)
                .any(|pair| (pair[0].0..=pair[1].0).contains(x) && (p - pair[0].1).abs() < 0.02)
        });
        assert!(close.count() * 10 > 8 * profile.found.len(), "{}", profile.case);
    }
}

#[test]
fn areas_of_the_ensemble_are_near_the_published_ones() {
    let task =
        EnsembleTask { points: vec![256, 512], realisations: 2, pressures: vec![0.065, 0.147], error: 1e-5 };
    let found = ensemble(&ENSEMBLE, &task, |realisation| [realisation as u8; 32], &Silent).unwrap();
    assert_eq!((found.points.len(), found.extrapolated.len()), (4, 2));
    for at in &found.extrapolated {
        let published = published(at.pressure).unwrap().area;
        assert!((at.raw_area.mean / published - 1.0).abs() < 0.06, "{at:?} for {published}");
        assert!((at.area.mean / at.raw_area.mean - 1.0).abs() < 0.01, "{at:?}");
        let on = |points: usize| {
            found.points.iter().find(|point| point.points == points && point.pressure == at.pressure).unwrap()
        };
        // Counting points overestimates the area, less so on finer grids.
        assert!(on(256).raw_area.mean > on(512).raw_area.mean && on(512).raw_area.mean > at.raw_area.mean);
        assert!(on(512).area.mean < on(512).raw_area.mean);
    }
    assert!(
        PUBLISHED.windows(2).all(|pair| pair[0].pressure < pair[1].pressure && pair[0].area < pair[1].area)
    );
}

#[test]
fn work_grows_with_the_points() {
    let task = WorkTask { points: vec![64, 128], pressures: vec![0.05], error: 1e-7 };
    let found = work(&task, [3; 32], &Silent).unwrap();
    assert!(found.iter().all(|point| point.error <= 1e-7 && point.convolutions >= point.steps));
    assert!(found[1].convolutions > found[0].convolutions, "{found:?}");
}
