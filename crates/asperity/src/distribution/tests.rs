use std::f64::consts::PI;

use super::*;

/// Mean, standard deviation, skewness and kurtosis of `map(g)`, by a plain sum.
pub(crate) fn moments(map: impl Fn(f64) -> f64) -> [f64; 4] {
    let mean_of = |term: &dyn Fn(f64) -> f64| {
        let at = |k: i32| f64::from(k) * 1.4e-3;
        let weigh = |g: f64| (-0.5 * g * g).exp() / (2.0 * PI).sqrt() * 1.4e-3;
        (-10_000..=10_000).map(|k| term(map(at(k))) * weigh(at(k))).sum::<f64>()
    };
    let mean = mean_of(&|z| z);
    let sd = mean_of(&|z| (z - mean).powi(2)).sqrt();
    [mean, sd, mean_of(&|z| ((z - mean) / sd).powi(3)), mean_of(&|z| ((z - mean) / sd).powi(4))]
}

/// One of each family and curve.
pub(crate) fn all() -> Vec<Heights> {
    let johnson =
        [(0.0, 3.0), (1e-5, 3.0), (1.0, 4.0), (-1.0, 4.5), (-2.0, 20.0), (0.0, 1.3), (0.0, 200.0)];
    let lognormal = Johnson::from_moments(2.0, 10.863_462_451_016_1).unwrap();
    std::iter::once(Heights::GAUSSIAN)
        .chain(johnson.map(|(s, k)| Heights::new(Johnson::from_moments(s, k).unwrap())))
        .chain([Heights::new(lognormal)])
        .chain([0.5, 1.0, 3.6, 20.0].map(|shape| Heights::new(Weibull::new(shape).unwrap())))
        .chain([Heights::EXPONENTIAL])
        .collect()
}

#[test]
fn names_in_words() {
    let names: Vec<String> = all().iter().map(ToString::to_string).collect();
    assert_eq!(names[0], "Gaussian");
    assert_eq!(names[1], "Johnson SN, skewness 0, kurtosis 3");
    assert!(names[4].starts_with("Johnson SB, skewness -1, kurtosis 4.5 (gamma = -"), "{}", names[4]);
    assert!(names[5].starts_with("Johnson SU, skewness -2, kurtosis 20 (gamma = "), "{}", names[5]);
    assert!(names[8].starts_with("Johnson SL, skewness 2, kurtosis 10.86"), "{}", names[8]);
    assert_eq!(names[10], "Weibull, shape 1, skewness 2.0000, kurtosis 9.0000");
    assert_eq!(names[13], "exponential");
}
