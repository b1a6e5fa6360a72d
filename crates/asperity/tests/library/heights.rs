//! Every height distribution, in the statistical model and as sets.

use crate::common::{Worst, relative_error};
use asperity::asperity::{Draw, Population};
use asperity::distribution::{Heights, Johnson, REGISTRY, Weibull};
use asperity::interface::{Interface, MicroContact};
use asperity::law::{Ceb, FullyPlastic, Hertz, KogutEtsion, Shape, Zmc};
use asperity::material::Material;
use asperity::model::{Deterministic, Model, ReferencePlane, Statistical};
use asperity::numeric::Sum;
use asperity::numeric::quadrature::{Variable, panels};

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

/// Shapes and moments over all that is allowed.
fn all() -> Vec<Heights> {
    let shapes = [0.5, 0.6, 0.75, 0.999, 1.0, 1.5, 2.0, 3.6, 7.3, 20.0];
    let moments = [
        (0.0, 3.0),
        (1e-5, 3.0),
        (0.0, 1.05),
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
    let others = REGISTRY.map(|entry| entry.example().unwrap()).into_iter();
    others.chain(shapes.map(weibull)).chain(moments.map(|(s, k)| johnson(s, k))).collect()
}

/// Area, load and stiffness per nominal area at the separation `h`: the contact at the height of each standard normal number, by
/// dense panels between those of the separation and the indentations `kinks` (m). It knows the distribution by its map alone.
fn dense(contact: &dyn MicroContact, population: &Population, kinks: &[f64], h: f64) -> [f64; 3] {
    let Population { sigma, density, heights, .. } = population;
    /// Beyond, the normal density has no part even in the largest heights.
    const END: f64 = 42.0;
    let normal = |x: f64| {
        let (mut low, mut high) = (-END, END);
        while {
            let middle = 0.5 * (low + high);
            *(if heights.from_normal(middle) < h + x { &mut low } else { &mut high }) = middle;
            low < 0.5 * (low + high) && 0.5 * (low + high) < high
        } {}
        high
    };
    let start = normal(0.0);
    let mut ends: Vec<f64> = kinks.iter().map(|w| normal(w / sigma)).collect();
    let size = 1.0 / (1.0 + start.abs());
    ends.extend((0..60).map(|k| start + size * 1.6f64.powi(-k)));
    ends.extend((0..4000).map(|k| start + 0.01 * f64::from(k)));
    ends.retain(|g| (start..=start + 18.0).contains(g));
    ends.sort_by(f64::total_cmp);
    let relative = |g: f64| (-0.5 * (g - start) * (g + start)).exp();
    let mut sums = [Sum::default(); 3];
    for range in ends.windows(2).filter(|range| range[0] < range[1]) {
        for panel in panels(range[0] - start, range[1] - start, Variable::SquareRoot, 1) {
            for (v, weight) in panel.points.into_iter().zip(panel.weights) {
                let x = heights.from_normal(start + v) - h;
                let found = contact.contact(x.max(0.0) * sigma, Shape::sphere(RADIUS));
                for (sum, value) in sums.iter_mut().zip([found.area, found.load, found.stiffness]) {
                    sum.add(weight * relative(start + v) * value);
                }
            }
        }
    }
    let scale = (-0.5 * start * start).exp() / std::f64::consts::TAU.sqrt();
    sums.map(|sum| sum.value() * scale * density)
}

#[test]
fn look() {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let hertz = Interface::bare(Hertz, &steel, &steel).unwrap();
    let zmc = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
    for heights in all() {
        for (contact, sigma) in [(&hertz as &dyn MicroContact, 1e-7), (&zmc, 2e-8), (&zmc, 3e-7)] {
            let population = unit(sigma, heights.clone());
            let model = Statistical::new(contact, population.clone());
            let mut line = String::new();
            for g in [-12.0, -5.0, -2.0, -0.5, 0.0, 1.0, 3.0, 6.0, 9.0, 20.0] {
                let h = if g < -10.0 { heights.from_normal(-7.0) - 1.5 } else { heights.from_normal(g) };
                if model.respond(h).pressure.total() == 0.0 { line += " -"; continue; }
                let exact = dense(contact, &population, &contact.regime_changes(Shape::sphere(RADIUS)), h);
                let found = model.respond(h);
                let found = [found.area_ratio.total(), found.pressure.total(), found.stiffness];
                let error = (0..3).map(|k| relative_error(found[k], exact[k])).fold(0.0, f64::max);
                line += &format!(" {error:.0e}");
            }
            println!("{heights}, {sigma:e}: {line}");
        }
    }
}
