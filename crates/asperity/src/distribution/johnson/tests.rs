use super::*;
use crate::distribution::tests::moments;

fn fit(skewness: f64, kurtosis: f64) -> Johnson {
    Johnson::from_moments(skewness, kurtosis).unwrap()
}

fn line(skewness: f64) -> f64 {
    unbounded_moments(lognormal_excess(skewness.abs()), 1.0)[1]
}

#[test]
fn every_pair_is_fitted_or_refused_with_the_reason() {
    for i in -16..=16 {
        let skewness = 0.25 * f64::from(i);
        let bound = skewness * skewness + 1.0;
        for above in [0.11, 0.3, 0.8, 1.4, 1.9, 1.999, 2.001, 2.2, 3.0, 5.0, 9.0, 24.0, 90.0, 183.0] {
            let kurtosis = bound + above;
            match Johnson::from_moments(skewness, kurtosis) {
                Ok(johnson) => {
                    let found = moments(|g| johnson.map(g));
                    let wanted = [0.0, 1.0, skewness, kurtosis];
                    for (found, wanted) in found.into_iter().zip(wanted) {
                        assert!((found - wanted).abs() < 1e-11 * kurtosis, "{johnson}: {found}");
                    }
                }
                Err(MomentsError::TwoLevels { least, .. }) => {
                    assert!(kurtosis < least && least < bound + 0.09 + 0.02 * skewness * skewness);
                    let least = fit(skewness, least * (1.0 + 1e-12));
                    assert!((least.rate - MAX_RATE).abs() < 1e-8, "{least}");
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
}

#[test]
fn pairs_close_to_the_normal_and_to_the_lognormal_line() {
    for skewness in [0.0, 1e-12, 1e-7, 1e-4, 0.01, 0.3, 3.0, 6.0, 10.0] {
        for off in [1e-12, 1e-10, 1.1e-9, 1e-8, 1e-6, 1e-4] {
            for kurtosis in [line(skewness) * (1.0 + off), line(skewness) * (1.0 - off)] {
                if kurtosis > LARGEST[1] {
                    continue;
                }
                let johnson = Johnson::from_moments(skewness, kurtosis);
                let johnson = johnson.unwrap_or_else(|e| panic!("{e}"));
                let lognormal = Johnson::from_moments(skewness, line(skewness)).unwrap();
                for g in [-9.0, -4.0, -1.0, 0.0, 1e-9, 0.5, 2.0, 4.0] {
                    let change = (johnson.map(g) - lognormal.map(g)).abs();
                    assert!(change < 1e4 * (off + 1e-9), "{johnson}, g = {g}: {change}");
                }
            }
        }
    }
    assert_eq!(fit(0.0, 3.0).curve, Curve::Normal);
    assert_eq!(fit(2.0, line(2.0)).curve, Curve::Lognormal);
    assert_eq!(fit(2.0, line(2.0) * (1.0 + 1e-8)).curve, Curve::Unbounded);
    assert_eq!(fit(2.0, line(2.0) * (1.0 - 1e-8)).curve, Curve::Bounded);
}

/// The skewness of symmetric heights is their rounding, below that of the integrals.
#[test]
fn a_skewness_of_rounding_is_none() {
    let fitted = Johnson::from_moments(1e-17, 1.7).unwrap();
    let symmetric = Johnson::from_moments(0.0, 1.7).unwrap();
    assert!((fitted.map(1.0) - symmetric.map(1.0)).abs() < 1e-9);
}

#[test]
fn curves_that_are_known() {
    // omega = e^.25: skewness (omega + 2)(omega - 1)^.5, and delta = 2.
    let omega = 0.25f64.exp();
    let lognormal = fit((omega + 2.0) * (omega - 1.0).sqrt(), line((omega + 2.0) * (omega - 1.0).sqrt()));
    for g in [-9.0f64, -1.0, 0.0, 2.0, 9.0] {
        let exact = ((0.5 * g).exp() - omega.sqrt()) / (omega * (omega - 1.0)).sqrt();
        assert!((lognormal.map(g) / exact - 1.0).abs() < 1e-12, "{g}: {} {exact}", lognormal.map(g));
    }
    // gamma = 0: kurtosis (omega^4 + 2 omega^2 + 3)/2.
    let unbounded = fit(0.0, 0.5 * (omega.powi(4) + 2.0 * omega * omega + 3.0));
    assert!((unbounded.rate - 0.5).abs() < 1e-14);
    assert!(
        (unbounded.map(3.0) / (1.5f64.sinh() / (0.5 * (omega * omega - 1.0)).sqrt()) - 1.0).abs() < 1e-13
    );
    // The logit-normal of delta = 1, gamma = 1, straight from its definition.
    let [_, _, skewness, kurtosis] = moments(|g| 1.0 / (1.0 + (1.0 - g).exp()));
    let bounded = fit(skewness, kurtosis);
    assert_eq!(bounded.curve, Curve::Bounded);
    assert!((bounded.rate - 1.0).abs() < 1e-12 && (bounded.weights[0] - logistic(1.0)[0]).abs() < 1e-12);
    assert_eq!(
        bounded.to_string(),
        format!("Johnson SB, skewness {skewness}, kurtosis {kurtosis} (gamma = 1.000000, delta = 1.000000)")
    );
}

#[test]
fn the_quick_exponential_is_the_library_one() {
    for k in 0..300_000 {
        let u = f64::from(k) * 1e-3;
        for u in [u, u * 1e-2, u * 1e-9] {
            let exact = u.exp_m1();
            assert!((exp_m1(u) - exact).abs() <= 4.0 * f64::EPSILON * exact, "{u}");
        }
    }
    assert_eq!(exp_m1(1e9), exp_m1(SATURATED));
    assert!(fit(0.0, 2.0).map(f64::NAN).is_nan() && fit(0.0, 4.0).map(f64::NAN).is_nan());
}

#[test]
fn a_negative_skewness_mirrors_the_heights() {
    for (skewness, kurtosis) in [(0.7, 3.2), (1.0, 4.5), (1.5, line(1.5)), (2.0, 12.0)] {
        let (up, down) = (fit(skewness, kurtosis), fit(-skewness, kurtosis));
        for k in -90..=90 {
            let g = 0.1 * f64::from(k);
            assert_eq!(down.map(g), -up.map(-g));
            assert_eq!(down.derivative(g), up.derivative(-g));
        }
    }
}

#[test]
fn what_nothing_has_is_refused_and_said() {
    let say = |skewness, kurtosis| Johnson::from_moments(skewness, kurtosis).unwrap_err().to_string();
    assert!(say(1.0, 1.5).ends_with("a kurtosis is at least skewness^2 + 1 = 2"));
    assert!(say(1.0, 2.0).contains("two levels; allowed at this skewness is a kurtosis from 2.0"));
    assert!(say(0.0, 201.0).ends_with("allowed are a skewness from -10 to 10 and a kurtosis up to 200"));
    assert!(say(-10.5, 150.0).contains("a skewness from -10 to 10"));
    for (skewness, kurtosis) in [(f64::NAN, 3.0), (0.0, f64::INFINITY), (f64::NEG_INFINITY, 3.0)] {
        assert!(say(skewness, kurtosis).ends_with("allowed are finite numbers"));
    }
    let wrong = Johnson::new(Curve::Unbounded, 0.5, [0.5, 0.5], [0.0, 3.5]);
    assert!(matches!(wrong.checked(), Err(MomentsError::NotReached { found, .. }) if found.kurtosis > 4.0));
}
