//! Curves within a tolerance: their errors and numbers of evaluations.

use crate::common::{Random, bare_contact, contact};
use asperity::contact_law::registry;
use asperity::{
    AsperitySet, Curve, Deterministic, Draw, Flat, Heights, LayeredFlat, Material, MicroContact, Model,
    ModulusModel, Population, ReferencePlane, Response, Shape, Statistical, respond_within,
};

const CASES: [Population; 2] = [
    Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN },
    Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: Heights::GAUSSIAN },
];

fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), Some(2.7e9)).unwrap()
}

fn bare(law: &str) -> Box<dyn MicroContact> {
    bare_contact(law, &[], &steel())
}

fn plane(population: &Population) -> ReferencePlane {
    ReferencePlane { mean: 0.0, sigma: population.sigma }
}

fn sweep([from, to]: [f64; 2], points: usize) -> Vec<f64> {
    (0..points).map(|k| from + (to - from) * k as f64 / (points - 1) as f64).collect()
}

fn drawn(population: &Population, count: usize, seed: u8) -> AsperitySet {
    population.set(count, Draw::Random([seed; 32])).unwrap()
}

/// The largest relative error of load and area.
fn error(found: &[Response], exact: &[Response]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let totals = |response: &Response| [response.pressure.total(), response.area_ratio.total()];
    let each = found.iter().zip(exact).flat_map(|(found, exact)| {
        assert_eq!(found.separation_over_sigma, exact.separation_over_sigma);
        assert_eq!(found.separation, exact.separation);
        let [load, area] = totals(exact);
        totals(found).into_iter().zip([load, area])
    });
    each.map(|(found, exact)| if found == exact { 0.0 } else { (found / exact - 1.0).abs() }).fold(
        0.0,
        |a, b| {
            assert!(!b.is_nan());
            f64::max(a, b)
        },
    )
}

/// What holds for any response.
fn assert_sound(response: &Response) {
    let sampling = response.sampling.map_or([0.0; 2], |error| [error.pressure, error.area_ratio]);
    let parts = [response.pressure.0, response.area_ratio.0];
    let rest = [response.contact_density, response.stiffness];
    for value in parts.into_iter().flatten().chain(sampling).chain(rest) {
        assert!(value.is_finite() && value >= 0.0, "{response:?}");
    }
}

/// The curve, whose error is at most `tolerance` plus rounding.
fn checked(
    model: &dyn Model,
    separations: &[f64],
    exact: &[Response],
    tolerance: f64,
    place: &dyn Fn() -> String,
) -> Curve {
    let curve = respond_within(model, separations, tolerance);
    let error = error(&curve.responses, exact);
    assert!(error <= tolerance + 1e-14, "{error:e} > {tolerance:e} for {}", place());
    curve.responses.iter().for_each(assert_sound);
    curve
}

/// Lists in which loads change suddenly, and random ones.
fn lists(contact: &dyn MicroContact, population: &Population) -> Vec<(&'static str, Vec<f64>, Vec<f64>)> {
    let &Population { radius, sigma, .. } = population;
    let mut random = Random::new(7);
    let mut lists: Vec<_> = [("3", 3), ("30", 30), ("300", 300), ("30,000", 30_000)]
        .map(|(name, count)| {
            (name, drawn(population, count, count as u8).heights().to_vec(), vec![radius; count])
        })
        .into();
    let mut add = |name, heights: Vec<f64>, radii: Option<Vec<f64>>| {
        let radii = radii.unwrap_or_else(|| vec![radius; heights.len()]);
        lists.push((name, heights, radii));
    };
    let mut but_one = vec![sigma; 100];
    but_one[41] = 3.0 * sigma;
    add("all equal but one", but_one, None);
    add("two clusters", (0..200).map(|k| sigma * f64::from(k % 2) * 2.5).collect(), None);
    add("at the separations", (0..80).map(|k| sigma * (4.0 - 4.0 * f64::from(k) / 1999.0)).collect(), None);
    let spiky: Vec<f64> = (0..300).map(|_| random.log(1e-3 * radius, 10.0 * radius)).collect();
    add("spiky", drawn(population, 300, 9).heights().to_vec(), Some(spiky));
    // All change their regime at the same separation.
    let radii: Vec<f64> = (0..300).map(|_| random.log(0.1 * radius, 10.0 * radius)).collect();
    for (k, name) in ["coinciding at the first", "coinciding at the last"].into_iter().enumerate() {
        let critical = |&b: &f64| {
            let changes = contact.regime_changes(Shape::sphere(b));
            let change = if k == 0 { changes.first() } else { changes.last() };
            // Those of small spheres only are in reach.
            change.map_or(0.0, |w| w.min(100.0 * sigma))
        };
        add(name, radii.iter().map(|b| 1.03 * sigma + critical(b)).collect(), Some(radii.clone()));
    }
    lists
}

/// Every law: those whose loads and areas increase are interpolated, the others are not.
#[test]
fn load_and_area_are_within_the_tolerance_for_any_law_and_list() {
    /// 0.05 is between Kogut and Etsion's jumps of load (0.03) and area (0.07) at the onset of yield.
    const TOLERANCES: [f64; 5] = [1e-1, 5e-2, 1e-2, 1e-3, 1e-4];
    let mut interpolated = 0;
    for (law, population) in registry().iter().flat_map(|law| CASES.iter().map(move |case| (law, case))) {
        let contact = bare(&law.name());
        for (name, heights, radii) in lists(&*contact, population) {
            let points = if heights.len() > 1000 { 300 } else { 2000 };
            let set = AsperitySet::new(heights, radii, 1e-6).unwrap();
            let sum = Deterministic::new(&*contact, set.spheres(), plane(population));
            for range in [[4.0, 0.0], [1.06, 1.0], [1.0, 1.002], [-1.0, 9.0]] {
                let separations = sweep(range, points);
                let exact = sum.respond_all(&separations);
                for tolerance in TOLERANCES {
                    let place = || format!("{} on {name} over {range:?}", law.name());
                    let curve = checked(&sum, &separations, &exact, tolerance, &place);
                    assert!(sum.is_monotonic() || curve.evaluated == separations);
                    interpolated += points - curve.evaluated.len();
                }
            }
        }
    }
    assert!(interpolated > 100_000, "{interpolated}");
}

#[test]
fn integrals_are_within_the_tolerance_too() {
    let heights: Vec<Heights> =
        asperity::distribution::REGISTRY.iter().map(|entry| entry.example().unwrap()).collect();
    let mut interpolated = 0;
    for (law, case) in registry().iter().flat_map(|law| CASES.iter().map(move |case| (law, case))) {
        let contact = bare(&law.name());
        for heights in &heights {
            let model = Statistical::new(&*contact, Population { heights: heights.clone(), ..case.clone() });
            for range in [[4.0, 0.0], [1.01, 1.0], [60.0, -3.0], [39.0, 36.5], [38.7, 38.6]] {
                let separations = sweep(range, 1000);
                let exact = model.respond_all(&separations);
                for tolerance in [1e-1, 1e-2, 1e-4, 1e-11, 1e-12] {
                    let place = || format!("{}, {heights:?} over {range:?}", law.name());
                    let curve = checked(&model, &separations, &exact, tolerance, &place);
                    interpolated += separations.len() - curve.evaluated.len();
                }
            }
        }
    }
    assert!(interpolated > 10_000, "{interpolated}");
}

/// Small lists and laws that jump, at a thousand separations and at so many that they are interpolated.
#[test]
fn few_asperities_and_jumping_laws_are_within_the_tolerance() {
    let equal = AsperitySet::new(vec![0.0; 500], vec![CASES[0].radius; 500], 1e-8).unwrap();
    let mut cases = vec![
        ("ceb", drawn(&CASES[0], 3000, 1), 1e-3),
        ("kogut-etsion", drawn(&CASES[0], 3000, 1), 1e-3),
        ("zmc", equal.clone(), 1e-2),
        ("kogut-etsion", equal, 1e-2),
    ];
    cases.extend((0..12).map(|seed| ("zmc", drawn(&CASES[0], 300, seed), 1e-4)));
    for (law, set, tolerance) in cases {
        let contact = bare(law);
        let model = Deterministic::new(&*contact, set.spheres(), plane(&CASES[0]));
        for (range, points) in [([4.0, 0.0], 1000), ([4.0, -0.5], 20_000), ([1.7, 1.65], 20_000)] {
            let separations = sweep(range, points);
            let exact = model.respond_all(&separations);
            for tolerance in [tolerance, 0.01] {
                let curve =
                    checked(&model, &separations, &exact, tolerance, &|| format!("{law} over {range:?}"));
                let is_interpolated = curve.evaluated.len() < points;
                if points > 1000 && (tolerance == 0.01 || range[0] < 2.0) {
                    assert_eq!(is_interpolated, law != "kogut-etsion", "{law} over {range:?}");
                }
            }
        }
    }
}

#[test]
fn a_million_asperities_are_within_the_tolerance() {
    let zmc = bare("zmc");
    let set = drawn(&CASES[0], 1_000_000, 1);
    let model = Deterministic::new(&*zmc, set.spheres(), plane(&CASES[0]));
    for (range, tolerance, is_interpolated) in [([4.0, 0.0], 1e-4, false), ([1.7, 1.65], 1e-3, true)] {
        let separations = sweep(range, 1000);
        let exact = model.respond_all(&separations);
        let curve = checked(&model, &separations, &exact, tolerance, &|| format!("{range:?}"));
        assert_eq!(curve.evaluated.len() < 1000, is_interpolated, "{}", curve.evaluated.len());
    }
}

/// A tolerance pays where it needs fewer separations than are given; else all are evaluated.
#[test]
fn evaluations_are_those_of_the_change_of_load_over_the_tolerance() {
    let zmc = bare("zmc");
    for (population, seed) in CASES.iter().zip([1, 2]) {
        let set = drawn(population, 30_000, seed);
        let sum = Deterministic::new(&*zmc, set.spheres(), plane(population));
        let integral = Statistical::new(&*zmc, population.clone());
        let separations = sweep([3.0, 0.0], 20_000);
        for model in [&sum as &dyn Model, &integral] {
            let exact = model.respond_all(&separations);
            let curve = checked(model, &separations, &exact, 1e-2, &|| "many".to_owned());
            let [near, far] = [&exact[19_999], &exact[0]].map(|response| response.pressure.total());
            let required = (near / far).ln() / 1e-2;
            let evaluated = curve.evaluated.len() as f64;
            println!("{evaluated} evaluated, {required:.0} required");
            assert!((1.0..1.6).contains(&(evaluated / required)), "{evaluated} for {required}");
            let stiffness = |curve: &[Response]| curve.iter().map(|response| response.stiffness).sum::<f64>();
            assert!((stiffness(&curve.responses) / stiffness(&exact) - 1.0).abs() < 1e-3);
            // Dearer than all.
            for (points, tolerance) in [(20_000, 1e-4), (1000, 1e-2), (20, 0.1)] {
                let separations = sweep([3.0, 0.0], points);
                let curve = respond_within(model, &separations, tolerance);
                assert_eq!(curve.evaluated, separations);
                assert_eq!(curve.responses, model.respond_all(&separations));
            }
        }
    }
}

/// Neither is bounded by its neighbours' values if the load or the area of an asperity may decrease.
#[test]
fn contacts_that_may_decrease_are_evaluated_at_every_separation() {
    let lead = Material::new(18e9, 0.42, Some(0.17e9), None).unwrap();
    let layered = LayeredFlat::new(&lead, &steel(), 5e-8, ModulusModel::default()).unwrap();
    let flat = Flat::Layered { substrate: steel(), layered };
    let drop_of_load = bare_contact("zmc", &[("onset", 0.89)], &steel());
    let contacts = [
        ("kogut-etsion", bare("kogut-etsion"), true),
        ("under a layer", contact("hertz", &[], &steel(), &flat), true),
        ("zmc of a rounded onset", drop_of_load, false),
    ];
    let set = drawn(&CASES[0], 1000, 3);
    for (name, contact, area_may_decrease) in contacts {
        assert_eq!(contact.area_may_decrease(), area_may_decrease, "{name}");
        let sum = Deterministic::new(&*contact, set.spheres(), plane(&CASES[0]));
        let integral = Statistical::new(&*contact, CASES[0].clone());
        for model in [&sum as &dyn Model, &integral] {
            assert!(!model.is_monotonic(), "{name}");
            let separations = sweep([2.0, 1.0], 300);
            let curve = respond_within(model, &separations, 0.01);
            assert_eq!(curve.evaluated, separations, "{name}");
            assert_eq!(curve.responses, model.respond_all(&separations), "{name}");
        }
    }
    for law in ["hertz", "zmc", "ceb", "jackson-green", "fully-plastic"] {
        assert!(!bare(law).area_may_decrease(), "{law}");
    }
}

/// At a large separation few asperities are touched: the response is that of these only.
#[test]
fn far_separations_are_those_of_the_asperities_that_stand_out() {
    let zmc = bare("zmc");
    let set = drawn(&CASES[0], 300_000, 4);
    let plane = plane(&CASES[0]);
    let highest = |z: &f64| *z > 2.5 * plane.sigma;
    let heights: Vec<f64> = set.heights().iter().copied().filter(highest).collect();
    let radii = vec![CASES[0].radius; heights.len()];
    let few = AsperitySet::new(heights, radii, set.nominal_area()).unwrap();
    let [all, few] = [&set, &few].map(|set| Deterministic::new(&*zmc, set.spheres(), plane));
    let far: Vec<f64> = (0..40).map(|k| 2.6 + 0.05 * f64::from(k)).collect();
    let (found, expected) = (all.respond_all(&far), few.respond_all(&far));
    assert!(error(&found, &expected) < 1e-14);
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

/// Separations in any order, repeated, beyond the highest asperity, or few.
#[test]
fn any_list_of_separations() {
    let zmc = bare("zmc");
    let set = CASES[0].set(20_000, Draw::Quantiles).unwrap();
    let model = Deterministic::new(&*zmc, set.spheres(), plane(&CASES[0]));
    let mixed: Vec<f64> = (0..4000).map(|k| f64::from((k * 37) % 2000) * 0.0005 - 0.5).collect();
    for (separations, tolerance) in [
        (&mixed[..], 1e-2),
        (&mixed[..], 3e-3),
        (&mixed[..5], 1e-2),
        (&[9.0; 4000], 1e-3),
        (&[1.0; 4000], 1e-3),
        (&[], 1e-3),
    ] {
        let exact = model.respond_all(separations);
        let curve = checked(&model, separations, &exact, tolerance, &|| format!("{} given", exact.len()));
        let is_interpolated = curve.evaluated.len() < separations.len();
        assert_eq!(is_interpolated, separations.len() == 4000, "{}", curve.evaluated.len());
    }
}
