//! The statistical integral against another crate's adaptive rule.

use asperity::{Heights, Interface, Material, MicroContact, Model, Population, Shape, Statistical, Zmc};

use crate::common::relative_error;

const CASE_1: Population =
    Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
const CASE_2: Population =
    Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: Heights::GAUSSIAN };

struct Integrand<F>(F);

impl<F: Fn(f64) -> f64> quad_rs::Integrable for Integrand<F> {
    type Float = f64;
    type Input = f64;
    type Output = f64;

    fn integrand(&self, x: &f64) -> f64 {
        self.0(*x)
    }
}

fn adaptive(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    // quad-rs also stops on an absolute error: the integrand is brought to the order of 1.
    let scale = f(0.5 * (from + to)) * (to - from);
    let config = quad_rs::IntegratorConfig::default()
        .with_relative_tolerance(1e-13)
        .with_absolute_tolerance(1e-15)
        .with_max_function_evalutions(1_000_000);
    let scaled = Integrand(|x| f(x) / scale);
    quad_rs::integrate_interval(scaled, from..to, config).unwrap().integral * scale
}

/// quad-rs' adaptive Gauss-Kronrod shares neither nodes nor panels with the model.
#[test]
fn an_adaptive_integration_agrees() {
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let law = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
    for (h, population) in [(0.0, CASE_1), (2.0, CASE_1), (0.5, CASE_2), (3.0, CASE_2)] {
        let Population { radius, sigma, density, .. } = population;
        let integrand = |x: f64| {
            let z = h + x;
            law.contact(x * sigma, Shape::sphere(radius)).load * (-0.5 * z * z).exp()
                / (2.0 * std::f64::consts::PI).sqrt()
        };
        let mut ends = vec![1e-12];
        ends.extend(law.breakpoints(Shape::sphere(radius)).iter().map(|w| w / sigma).filter(|&x| x < 9.0));
        ends.push(9.0);
        let exact: f64 = ends.windows(2).map(|end| adaptive(integrand, end[0], end[1])).sum();
        let found = Statistical::new(&law, population).respond(h).pressure.total();
        assert!(relative_error(found, density * exact) < 1e-9, "h = {h}: {found:e} {:e}", density * exact);
    }
}
