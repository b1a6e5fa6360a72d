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
    let johnson = [(0.0, 3.0), (1e-5, 3.0), (1.0, 4.0), (-1.0, 4.5), (-2.0, 20.0), (0.0, 1.3), (0.0, 200.0)];
    let lognormal = Johnson::from_moments(2.0, 10.863_462_451_016_1).unwrap();
    std::iter::once(Heights::GAUSSIAN)
        .chain(johnson.map(|(s, k)| Heights::new(Johnson::from_moments(s, k).unwrap())))
        .chain([Heights::new(lognormal)])
        .chain([0.5, 1.0, 3.6, 20.0].map(|shape| Heights::new(Weibull::new(shape).unwrap())))
        .chain([Heights::EXPONENTIAL])
        .chain(REGISTRY.iter().map(|entry| entry.example().unwrap()))
        .collect()
}

#[test]
fn skewness_and_kurtosis_are_those_of_the_map() {
    for heights in all() {
        let wanted = [0.0, 1.0, heights.skewness(), heights.kurtosis()];
        for (found, wanted) in moments(|g| heights.height_at_normal(g)).into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 2e-9 * wanted.abs().max(1.0), "{heights}: {found} {wanted}");
        }
    }
}

/// The quantile function of the normal distribution (statrs) is the least exact of what meets here.
#[test]
fn as_many_heights_lie_above_a_quantile_as_it_says() {
    for heights in all() {
        let [low, high] = heights.support();
        for p in [1e-9, 1e-4, 0.01, 0.2, 0.5, 0.77, 0.99, 0.9999] {
            let z = heights.quantile(p);
            let rounding = 1e-15 * (1.0 + z.abs());
            let [most, least] = [z - rounding, z + rounding].map(|z| heights.survival(z));
            let tolerance = 1e-10 * p.min(1.0 - p) + 1e-15;
            assert!((low..=high).contains(&z), "{heights}, {p}: {z}");
            assert!(
                (least - tolerance..=most + tolerance).contains(&(1.0 - p)),
                "{heights}, {p}: {least} to {most}"
            );
        }
        assert_eq!((heights.survival(low - 1.0), heights.survival(high + 1.0)), (1.0, 0.0));
    }
}

#[test]
fn many_quantiles_are_those_one_by_one() {
    for heights in all() {
        let probabilities: Vec<f64> = (0..1003).map(|k| (f64::from(k) + 0.5) / 1003.0).collect();
        let mut field = probabilities.clone();
        heights.map_probabilities(&mut field, 3.0);
        for (found, p) in field.into_iter().zip(probabilities) {
            let wanted = 3.0 * heights.quantile(p);
            assert!(
                (found - wanted).abs() <= 1e-13 * wanted.abs().max(1.0),
                "{heights:?} {p}: {found} {wanted}"
            );
        }
    }
}

#[test]
fn the_density_is_the_slope_of_the_survival_function() {
    for heights in all() {
        for end in heights.support() {
            assert!(end.is_infinite() || heights.density(end + 1e-9 * end.signum()) == 0.0, "{heights}");
        }
        for g in [-2.0, -0.6, 0.1, 0.9, 1.7, 3.0] {
            let [low, middle, high] = [g - 1e-3, g, g + 1e-3].map(|g| heights.height_at_normal(g));
            let normal = |g: f64| Gaussian.survival(g - 1e-3) - Gaussian.survival(g + 1e-3);
            let found = heights.density(middle) * (high - low);
            assert!((found / normal(g) - 1.0).abs() < 2e-4, "{heights} at {g}: {found} {}", normal(g));
            let spread = (heights.survival(low) - heights.survival(high)) / normal(g);
            assert!((spread - 1.0).abs() < 1e-8, "{heights} at {g}: {spread}");
        }
    }
}

#[test]
fn relative_densities_are_densities_over_the_scale() {
    for heights in all() {
        for h in [-20.0, -0.9, 0.0, 0.6] {
            let [start, end] = heights.window(h);
            for x in [1e-3, 0.1, 0.35, 12.0, 20.0] {
                let v = heights.variable(h, x);
                if !(v > start && v < end) {
                    continue;
                }
                let found = heights.scale(h) * heights.relative_density(h, x);
                let density = heights.density(h + x);
                assert!(
                    (found - density).abs() <= 1e-10 * density,
                    "{heights} at {h} + {x}: {found:e} {density:e}"
                );
            }
        }
    }
}

#[test]
fn no_density_rises_above_the_height_that_it_names() {
    for heights in all() {
        let from = heights.decreasing_from();
        let densities = (0..2000).map(|k| heights.density(from + 1e-12 + 2e-3 * f64::from(k)));
        assert!(
            densities.clone().zip(densities.skip(1)).all(|(low, high)| high <= low * (1.0 + 1e-12)),
            "{heights}"
        );
    }
}

#[test]
fn examples_of_the_registry_have_its_name_and_parameters() {
    for entry in REGISTRY {
        let heights = entry.example().unwrap();
        assert_eq!((heights.name(), heights.parameters()), (entry.name, entry.parameters.to_vec()));
        assert!(!heights.papers().is_empty() && !heights.label().is_empty());
    }
}

/// Without a breakpoint the window of Gaussian heights holds twice the foldings of a panel, to rounding.
#[test]
fn rounding_adds_no_panel() {
    for k in 0..5000 {
        let h = 1e-3 * f64::from(k);
        let [from, to] = Gaussian.window(h);
        assert_eq!(Gaussian.panels(h, from, to), 2, "{h}");
    }
}
