//! Curves within a tolerance: their errors and numbers of evaluations.

use crate::common::bare_contact;
use asperity::{
    AsperitySet, ByRegime, Deterministic, Draw, Heights, Material, MicroContact, Model, Population,
    ReferencePlane, Response, Shape, Statistical, respond_within,
};

const CASES: [Population; 2] = [
    Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN },
    Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: Heights::GAUSSIAN },
];

fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), None).unwrap()
}

fn bare(law: &str) -> Box<dyn MicroContact> {
    bare_contact(law, &[], &steel())
}

fn sweep(points: usize) -> Vec<f64> {
    (0..points).map(|k| 4.0 - 4.0 * k as f64 / (points - 1) as f64).collect()
}

/// The largest relative error of load and area, and the largest error of the shares of their regimes.
fn errors(found: &[Response], exact: &[Response]) -> [f64; 2] {
    let relative = |a: f64, b: f64| if a == b { 0.0 } else { (a / b - 1.0).abs() };
    let mut worst = [0.0f64; 2];
    for (found, exact) in found.iter().zip(exact) {
        assert_eq!(found.separation_over_sigma, exact.separation_over_sigma);
        assert_eq!(found.separation, exact.separation);
        for (found, exact) in [(found.pressure, exact.pressure), (found.area_ratio, exact.area_ratio)] {
            worst[0] = worst[0].max(relative(found.total(), exact.total()));
            let (found, exact) = (found.shares().unwrap_or_default(), exact.shares().unwrap_or_default());
            worst[1] = found.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(worst[1], f64::max);
        }
    }
    worst
}

/// The number of contacts evaluated, per area.
fn work(model: &dyn Model, separations: &[f64]) -> f64 {
    model.count_contacts(separations).unwrap().contacts.iter().sum()
}

#[test]
fn a_thousand_integrals_from_fewer_than_a_hundred() {
    let (zmc, hertz, ceb) = (bare("zmc"), bare("hertz"), bare("ceb"));
    for population in CASES {
        for contact in [&*zmc, &*hertz, &*ceb] {
            let model = Statistical::new(contact, population.clone());
            let curve = respond_within(&model, &sweep(1000), 1e-8);
            let off = errors(&curve.responses, &model.respond_all(&sweep(1000)));
            assert!(off.iter().all(|off| *off <= 1e-8), "{off:?}");
            assert!(curve.evaluated.len() <= 100, "{} of 1000", curve.evaluated.len());
        }
    }
}

#[test]
fn a_thousand_sums_for_no_more_than_twice_the_contacts_of_fifty() {
    let zmc = bare("zmc");
    for (population, seed) in CASES.into_iter().zip([1, 2]) {
        let set = population.set(1_000_000, Draw::Random([seed; 32])).unwrap();
        let model =
            Deterministic::new(&*zmc, set.spheres(), ReferencePlane { mean: 0.0, sigma: population.sigma });
        let curve = respond_within(&model, &sweep(1000), 1e-4);
        let exact = model.respond_all(&sweep(1000));
        let [off, shares] = errors(&curve.responses, &exact);
        let cost = work(&model, &curve.evaluated) / work(&model, &sweep(50));
        println!(
            "{} asked, {cost:.2} times the contacts of 50, off by {off:.1e}, shares by {shares:.1e}",
            curve.evaluated.len()
        );
        assert!(off <= 1e-4 && cost <= 1.5, "{off:e} {cost}");
        assert!(shares <= 1e-2, "{shares:e}");
        for (found, exact) in curve.responses.iter().zip(&exact) {
            // Contacts are counted.
            assert_eq!(found.contact_density, exact.contact_density);
            let beside = |response: &Response| {
                let sampling = response.sampling.unwrap();
                [response.stiffness, sampling.pressure, sampling.area_ratio]
            };
            for (found, exact) in beside(found).into_iter().zip(beside(exact)) {
                assert!((found - exact).abs() <= 1e-2 * exact, "{found:e} {exact:e}");
            }
        }
    }
}

/// At a large separation few asperities are touched: the response is that of these only.
#[test]
fn far_separations_are_those_of_the_asperities_that_stand_out() {
    let zmc = bare("zmc");
    let set = CASES[0].set(300_000, Draw::Random([4; 32])).unwrap();
    let plane = ReferencePlane { mean: 0.0, sigma: CASES[0].sigma };
    let highest = |z: &f64| *z > 2.5 * plane.sigma;
    let heights: Vec<f64> = set.heights().iter().copied().filter(highest).collect();
    let radii = vec![CASES[0].radius; heights.len()];
    let few = AsperitySet::new(heights, radii, set.nominal_area()).unwrap();
    let [all, few] = [&set, &few].map(|set| Deterministic::new(&*zmc, set.spheres(), plane));
    let far: Vec<f64> = (0..40).map(|k| 2.6 + 0.05 * f64::from(k)).collect();
    let (found, expected) = (all.respond_all(&far), few.respond_all(&far));
    assert!(errors(&found, &expected)[0] < 1e-14);
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found.contact_density, expected.contact_density);
        // Those that touch nothing count.
        let touching = set.heights().iter().map(|z| z - found.separation).filter(|w| *w > 0.0);
        let loads: Vec<f64> = touching.map(|w| zmc.contact(w, Shape::sphere(CASES[0].radius)).load).collect();
        let [sum, squares] = [1, 2].map(|power| loads.iter().map(|load| load.powi(power)).sum::<f64>());
        let error = (squares - sum * sum / set.count() as f64).sqrt() / set.nominal_area();
        let stated = found.sampling.unwrap().pressure;
        assert!((stated - error).abs() <= 1e-5 * error, "{stated} {error}");
    }
}

/// Contacts are counted at thousands of separations at once.
#[test]
fn contacts_are_counted_at_any_number_of_separations() {
    let zmc = bare("zmc");
    let set = CASES[0].set(3000, Draw::Random([6; 32])).unwrap();
    let plane = ReferencePlane { mean: 0.0, sigma: CASES[0].sigma };
    let model = Deterministic::new(&*zmc, set.spheres(), plane);
    let separations: Vec<f64> = (0..5000).map(|k| 5.0 - f64::from((k * 7919) % 5000) * 0.002).collect();
    let counted = model.count_contacts(&separations).unwrap();
    for (h, contacts) in separations.iter().zip(&counted.contacts) {
        let above = set.heights().iter().filter(|z| **z > h * plane.sigma).count();
        assert_eq!(*contacts, above as f64, "{h}");
    }
}

/// For few asperities, and a law whose load jumps, every point is evaluated and exact.
#[test]
fn what_cannot_be_foretold_is_asked() {
    let ceb = bare("ceb");
    let set = CASES[1].set(30, Draw::Random([3; 32])).unwrap();
    let model = Deterministic::new(&*ceb, set.spheres(), ReferencePlane { mean: 0.0, sigma: CASES[1].sigma });
    let curve = respond_within(&model, &sweep(300), 1e-6);
    assert!(errors(&curve.responses, &model.respond_all(&sweep(300)))[0] <= 1e-6);
    assert!(curve.evaluated.len() > 100);
}

/// A smooth pressure with a maximum, whose regimes change faster.
struct Wave;

impl Model for Wave {
    fn plane(&self) -> ReferencePlane {
        ReferencePlane { mean: 0.0, sigma: 1.0 }
    }

    fn respond_all(&self, separations: &[f64]) -> Vec<Response> {
        let at = |&h: &f64| {
            let pressure = 2.0 + (3.0 * h).cos();
            let share = 0.5 + 0.5 * (20.0 * (h - 1.3)).tanh();
            Response {
                separation_over_sigma: h,
                separation: h,
                contact_density: 1.0,
                area_ratio: ByRegime([0.01, 0.0, 0.0]),
                pressure: ByRegime([pressure * (1.0 - share), 0.0, pressure * share]),
                stiffness: 3.0 * (3.0 * h).sin(),
                sampling: None,
            }
        };
        separations.iter().map(at).collect()
    }

    fn may_decrease(&self) -> bool {
        true
    }

    fn separations_at(&self, pressures: &[f64]) -> Vec<Option<f64>> {
        vec![None; pressures.len()]
    }
}

/// A stiffness is negative where the load decreases.
#[test]
fn a_pressure_that_rises_and_falls() {
    let curve = respond_within(&Wave, &sweep(1000), 1e-8);
    let exact = Wave.respond_all(&sweep(1000));
    let off = errors(&curve.responses, &exact);
    assert!(off.iter().all(|off| *off <= 1e-8), "{off:?}");
    for (found, exact) in curve.responses.iter().zip(&exact) {
        let off = (found.stiffness - exact.stiffness).abs();
        assert!(off <= 1e-7, "{} {} {}", found.separation, found.stiffness, exact.stiffness);
    }
    assert!(curve.evaluated.len() < 400, "{}", curve.evaluated.len());
}

/// Separations in any order, repeated, beyond the highest asperity, or few.
#[test]
fn any_list_of_separations() {
    let zmc = bare("zmc");
    let set = CASES[0].set(20_000, Draw::Quantiles).unwrap();
    let model = Deterministic::new(&*zmc, set.spheres(), ReferencePlane { mean: 0.0, sigma: CASES[0].sigma });
    let mixed: Vec<f64> = (0..400).map(|k| f64::from((k * 37) % 200) * 0.05 - 2.0).collect();
    for separations in [&mixed[..], &mixed[..5], &[9.0; 40], &[]] {
        let curve = respond_within(&model, separations, 1e-3);
        assert_eq!(curve.responses.len(), separations.len());
        assert!(errors(&curve.responses, &model.respond_all(separations))[0] <= 1e-3);
    }
}
