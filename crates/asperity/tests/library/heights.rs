//! Every height distribution, in the statistical model and as sets.

use std::fmt;

use crate::common::{Worst, bare_contact, relative_error, steel};
use asperity::distribution::{Johnson, REGISTRY, Weibull};
use asperity::numeric::Sum;
use asperity::numeric::quadrature::{Variable, panels};
use asperity::{
    Deterministic, Draw, HeightDistribution, Heights, MicroContact, Model, Paper, Population, ReferencePlane,
    Shape, Statistical,
};

const RADIUS: f64 = 2e-5;

fn unit(sigma: f64, heights: Heights) -> Population {
    Population { radius: RADIUS, sigma, density: 6e10, heights }
}

fn weibull(shape: f64) -> Heights {
    Heights::new(Weibull::new(shape).unwrap())
}

fn johnson(skewness: f64, kurtosis: f64) -> Heights {
    Heights::new(Johnson::from_moments(skewness, kurtosis).unwrap())
}

/// Shapes and moments over their allowed ranges.
fn all() -> Vec<Heights> {
    let shapes = [0.5, 0.6, 0.75, 0.999, 1.0, 1.5, 2.0, 3.6, 7.3, 20.0];
    let moments = [
        (0.0, 3.0),
        (1e-5, 3.0),
        (0.0, 1.06),
        (0.0, 1.3),
        (0.0, 2.0),
        (0.0, 5.0),
        (0.0, 200.0),
        (-1.0, 2.2),
        (1.0, 2.2),
        (-1.0, 4.5),
        (1.0, 4.5),
        (1.0, 6.0),
        (-2.0, 20.0),
        (2.0, 10.863_462_451_016_1),
        (-2.0, 10.863_462_451_016_1),
        (6.0, 100.0),
        (-6.0, 100.0),
        (9.0, 180.0),
    ];
    let others = REGISTRY.iter().map(|entry| entry.example().unwrap());
    others.chain(shapes.map(weibull)).chain(moments.map(|(s, k)| johnson(s, k))).collect()
}

/// Area, load and stiffness per nominal area at the separation `h`: the contact at the height of each standard normal
/// number, by dense panels between those of the separation and of the indentations `kinks` (m). It uses the map of the
/// distribution only.
fn dense(contact: &dyn MicroContact, population: &Population, kinks: &[f64], h: f64) -> [f64; 3] {
    let Population { sigma, density, heights, .. } = population;
    let normal = |x: f64| {
        let (mut low, mut high) = (-42.0, 42.0);
        for _ in 0..70 {
            let middle = 0.5 * (low + high);
            *(if heights.height_at_normal(middle) < h + x { &mut low } else { &mut high }) = middle;
        }
        high
    };
    // Below, and 18 above, the normal density has no part even in the largest loads.
    let start = normal(0.0).max(-10.0);
    let base = start.max(0.0);
    let mut ends: Vec<f64> = kinks.iter().map(|w| normal(w / sigma)).collect();
    ends.extend((0..60).map(|k| start + 1.6f64.powi(-k) / (1.0 + base)));
    ends.extend((0..2800).map(|k| start + 0.01 * f64::from(k)));
    ends.retain(|g| (start..=base + 18.0).contains(g));
    ends.sort_by(f64::total_cmp);
    let mut sums = [Sum::default(); 3];
    for range in ends.windows(2).filter(|range| range[0] < range[1]) {
        for panel in panels(range[0] - start, range[1] - start, Variable::SquareRoot, 1) {
            for (v, weight) in panel.points.into_iter().zip(panel.weights) {
                let g = start + v;
                let share = weight * (-0.5 * (g - base) * (g + base)).exp();
                let x = (heights.height_at_normal(g) - h).max(0.0);
                let found = contact.contact(x * sigma, Shape::sphere(RADIUS));
                for (sum, value) in sums.iter_mut().zip([found.area, found.load, found.stiffness]) {
                    *sum += share * value;
                }
            }
        }
    }
    let scale = (-0.5 * base * base).exp() / std::f64::consts::TAU.sqrt();
    sums.map(|sum| sum.value() * scale * density)
}

/// Separations from below the support to where 1e-19 of the heights are left, but for those within 0.001 of the highest
/// height, and of the lowest one where many heights crowd: there the indentation is dominated by rounding of the
/// separation.
fn separations(heights: &Heights) -> Vec<f64> {
    let [low, high] = heights.support();
    let crowded = if heights.name() == "johnson" { 1e-3 } else { 0.0 };
    let numbers = [-7.0, -5.0, -2.0, -0.5, 0.0, 1.0, 3.0, 6.0, 9.0];
    let mut all: Vec<f64> = numbers.map(|g| heights.height_at_normal(g)).into_iter().collect();
    all.extend([-1.5, -2e-3, -1e-6, 0.0, 1e-6].map(|off| low.max(-10.0) + off));
    all.retain(|h| high - h > 1e-3 && (h - low).abs() >= crowded);
    all
}

#[test]
fn the_integral_is_that_over_the_map_from_the_normal() {
    let steel = steel();
    let hertz = bare_contact("hertz", &[], &steel);
    let zmc = bare_contact("zmc", &[], &steel);
    let mut worst = Worst::default();
    for heights in all() {
        for (contact, sigma) in [(&*hertz, 1e-7), (&*zmc, 2e-8), (&*zmc, 3e-7)] {
            let population = unit(sigma, heights.clone());
            let model = Statistical::new(contact, population.clone());
            let kinks = contact.regime_changes(Shape::sphere(RADIUS));
            for h in separations(&heights) {
                let exact = dense(contact, &population, &kinks, h);
                let found = model.respond(h);
                let found = [found.area_ratio.total(), found.pressure.total(), found.stiffness];
                for k in 0..3 {
                    worst.see(found[k], exact[k], || {
                        format!("{heights}, sigma = {sigma}, h = {h}, column {k}")
                    });
                }
            }
        }
    }
    worst.assert_within(1e-12, 1000);
}

/// Separations of all pressures are found again, though one may be near the highest height.
#[test]
fn pressures_lead_back_to_their_separations() {
    let steel = steel();
    let contact = bare_contact("ceb", &[], &steel);
    for heights in all() {
        let model = Statistical::new(&*contact, unit(1e-7, heights.clone()));
        for h in [-9.0, -1.0, 0.0, 0.7, 3.0, 8.0] {
            let pressure = model.respond(h).pressure.total();
            if pressure > 0.0 {
                let found = model.separation_at(pressure).unwrap();
                let again = model.respond(found).pressure.total();
                assert!(
                    found >= h - 1e-12 && relative_error(again, pressure) < 1e-10,
                    "{heights}: {found} for {h}"
                );
            }
        }
    }
}

/// The error of a sum over quantiles is that of the middle of strata: the tail beyond the last one.
#[test]
fn sums_over_quantiles_approach_the_integral() {
    let steel = steel();
    let contact = bare_contact("zmc", &[], &steel);
    for heights in REGISTRY.iter().map(|entry| entry.example().unwrap()).chain([
        weibull(0.7),
        weibull(5.0),
        johnson(1.0, 6.0),
    ]) {
        let population = unit(1e-7, heights.clone());
        let model = Statistical::new(&*contact, population.clone());
        let set = population.set(400_000, Draw::Quantiles).unwrap();
        let sum = Deterministic::new(&*contact, set.spheres(), ReferencePlane { mean: 0.0, sigma: 1e-7 });
        for h in [-1.0, 0.0, 1.0] {
            let [found, exact] = [sum.respond(h), model.respond(h)].map(|r| r.pressure.total());
            assert!(relative_error(found, exact) < 1e-4, "{heights} at {h}: {found} {exact}");
        }
    }
}

/// Uniform heights: a user-defined distribution.
#[derive(Debug)]
struct Uniform;

const HALF: f64 = 1.732_050_807_568_877_2;

impl fmt::Display for Uniform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

impl HeightDistribution for Uniform {
    fn name(&self) -> &'static str {
        "uniform"
    }
    fn label(&self) -> &'static str {
        "uniform"
    }
    fn papers(&self) -> &'static [Paper] {
        &[]
    }
    fn skewness(&self) -> f64 {
        0.0
    }
    fn kurtosis(&self) -> f64 {
        1.8
    }
    fn support(&self) -> [f64; 2] {
        [-HALF, HALF]
    }
    fn density(&self, z: f64) -> f64 {
        if z.abs() <= HALF { 0.5 / HALF } else { 0.0 }
    }
    fn survival(&self, z: f64) -> f64 {
        (0.5 - 0.5 * z / HALF).clamp(0.0, 1.0)
    }
    fn height_at_normal(&self, g: f64) -> f64 {
        HALF * (1.0 - 2.0 * Heights::GAUSSIAN.survival(g))
    }
    fn decreasing_from(&self) -> f64 {
        -HALF
    }
    fn highest_separation(&self) -> f64 {
        HALF
    }
    fn scale(&self, h: f64) -> f64 {
        if h < HALF { 0.5 / HALF } else { 0.0 }
    }
    fn window(&self, h: f64) -> [f64; 2] {
        [(-HALF - h).max(0.0), HALF - h]
    }
    fn panels(&self, _: f64, _: f64, _: f64) -> usize {
        1
    }
    fn relative_density(&self, _: f64, _: f64) -> f64 {
        1.0
    }
    fn apply_density(&self, _: f64, _: &mut [f64], _: &mut [f64]) {}
}

#[test]
fn a_distribution_from_outside_is_integrated_and_drawn() {
    let steel = steel();
    let contact = bare_contact("hertz", &[], &steel);
    let heights = Heights::new(Uniform);
    assert_eq!(heights, Heights::new(Uniform));
    assert_ne!(heights, Heights::GAUSSIAN);
    let population = unit(1e-7, heights);
    let model = Statistical::new(&*contact, population.clone());
    let set = population.set(100_000, Draw::Quantiles).unwrap();
    let sum = Deterministic::new(&*contact, set.spheres(), ReferencePlane { mean: 0.0, sigma: 1e-7 });
    for h in [-3.0, -1.0, 0.0, 1.7] {
        let excess = |z: f64| (z - h).max(0.0).powf(2.5);
        let moment = (excess(HALF) - excess(-HALF)) / (5.0 * HALF);
        let unit = contact.contact(1e-7, Shape::sphere(RADIUS)).load * population.density;
        let found = model.respond(h).pressure.total();
        assert!((found / (unit * moment) - 1.0).abs() < 1e-13, "{h}");
        assert!((sum.respond(h).pressure.total() / found - 1.0).abs() < 1e-6, "{h}");
    }
}
