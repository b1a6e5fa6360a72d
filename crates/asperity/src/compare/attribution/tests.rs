use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::states::Arrangement;
use super::{Attribution, Cause, GroupsLeftOut, Inputs, Order, Rearranged, leading};
use crate::asperity::{AsperitySet, Draw, Population, Statistics};
use crate::compare::{ComparedQuantity, Division, Estimate, Pair, pairs_at};
use crate::contact_law::named;
use crate::distribution::Heights;
use crate::interface::{Flat, MicroContact};
use crate::layer::ModulusModel;
use crate::material::Material;
use crate::model::{Deterministic, Model, ReferencePlane, Statistical};
use crate::numeric::Sum;
use crate::shape::Shape;

const SIGMA: f64 = 48e-9;

/// Heights of a skewed density and log-normal radii, correlated with them.
fn set(count: usize, correlation: f64, spread: f64) -> AsperitySet {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut normal = || -> f64 { StandardNormal.sample(&mut rng) };
    let (heights, radii) = (0..count)
        .map(|_| {
            let [a, b] = [normal(), normal()];
            let height = SIGMA * (a + 0.1 * a * a);
            let other = correlation * a + (1.0 - correlation * correlation).sqrt() * b;
            (height, 2e-5 * (spread * other).exp())
        })
        .unzip();
    AsperitySet::new(heights, radii, count as f64 / 6e10).unwrap()
}

fn inputs(set: &AsperitySet) -> Inputs<'_> {
    let statistics = Statistics::new(set);
    let plane = ReferencePlane::from(&statistics);
    Inputs {
        asperities: set.spheres(),
        plane,
        population: Population {
            radius: statistics.mean_radius,
            sigma: statistics.sigma,
            density: set.density(),
            heights: Heights::GAUSSIAN,
        },
        mean_shape: Shape::sphere(statistics.mean_radius),
        reporting_plane: ReferencePlane { mean: 0.0, sigma: plane.sigma },
    }
}

fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), Some(2.5e9)).unwrap()
}

fn interface(law: &str) -> Box<dyn MicroContact> {
    named(law).unwrap().interface(&steel(), &Flat::Bare(steel())).unwrap()
}

/// The load of every height with every radius, Pa, at `separation` (m).
fn product(contact: &dyn MicroContact, set: &AsperitySet, separation: f64) -> f64 {
    let mut sum = Sum::default();
    for &z in set.heights().iter().filter(|&&z| z > separation) {
        for &b in set.radii() {
            sum += contact.contact(z - separation, Shape::sphere(b)).load;
        }
    }
    sum.value() / set.count() as f64 / set.nominal_area()
}

fn pairs(contact: &dyn MicroContact, set: &AsperitySet, loads: &[f64]) -> Vec<Pair> {
    let inputs = inputs(set);
    let integral = Statistical::new(contact, inputs.population.clone());
    let sum = Deterministic::new(contact, set.spheres(), inputs.plane);
    pairs_at(&integral, &sum, loads).into_iter().flatten().collect()
}

fn attributions(contact: &dyn MicroContact, set: &AsperitySet, loads: &[f64]) -> Vec<Attribution> {
    let states = Rearranged::new(inputs(set)).at_loads(contact, &pairs(contact, set, loads));
    states.attributions(None)
}

/// The largest relative error of the load of own heights and own radii, independent of each other.
fn error_of_product(contact: &dyn MicroContact, count: usize) -> f64 {
    let set = set(count, -0.4, 0.6);
    let rearranged = Rearranged::new(inputs(&set));
    let plane = inputs(&set).plane;
    let error = |&h: &f64| {
        let found = rearranged.independent_pressure(contact, h);
        (found / product(contact, &set, plane.mean + h * plane.sigma) - 1.0).abs()
    };
    [0.5, 1.5, 2.5].iter().map(error).fold(0.0, f64::max)
}

#[test]
fn independent_heights_and_radii_are_those_of_all_pairs() {
    for (law, most) in [
        ("hertz", 1e-7),
        ("zmc", 1e-7),
        ("jackson-green", 1e-7),
        ("kogut-etsion", 1e-7),
        ("fully-plastic", 1e-9),
        // The load jumps by half where yield begins.
        ("ceb", 1e-6),
    ] {
        let contact = interface(law);
        assert!(error_of_product(&*contact, 200) < 1e-14, "{law}");
        let error = error_of_product(&*contact, 3000);
        assert!(error < most, "{law}: {error:e}");
    }
}

#[test]
fn under_a_layer_too() {
    let lead = Material::new(18e9, 0.35, Some(0.17e9), None).unwrap();
    let flat = Flat::with_layer(&lead, &steel(), 100e-9, ModulusModel::default()).unwrap();
    for (law, most) in [("zmc", 1e-6), ("kogut-etsion", 1e-4)] {
        let contact = named(law).unwrap().interface(&steel(), &flat).unwrap();
        let error = error_of_product(&*contact, 3000);
        assert!(error < most, "{law}: {error:e}");
    }
}

/// The integral with own radii is the mean of the integrals with each of them.
#[test]
fn gaussian_heights_with_own_radii() {
    for law in ["zmc", "ceb"] {
        let contact = interface(law);
        let set = set(2000, -0.4, 0.6);
        let inputs = inputs(&set);
        let rearranged = Rearranged::new(inputs.clone());
        for h in [0.0, 2.0, 4.0] {
            let found = rearranged.with_models(&*contact, |models| {
                models[Arrangement::OwnRadii as usize].respond(h).pressure.total()
            });
            let of_radius = |&radius: &f64| {
                let population = Population { radius, ..inputs.population.clone() };
                Statistical::new(&*contact, population).respond(h).pressure.total()
            };
            let mean = set.radii().iter().map(of_radius).sum::<f64>() / set.count() as f64;
            assert!((found / mean - 1.0).abs() < 5e-8, "{law} {h}: {:e}", found / mean - 1.0);
        }
    }
}

#[test]
fn the_parts_add_up_to_the_gap_in_every_order() {
    for law in ["hertz", "zmc", "ceb"] {
        let contact = interface(law);
        let set = set(5000, -0.4, 0.6);
        let loads = [5e6, 2e7, 1e8];
        let pairs = pairs(&*contact, &set, &loads);
        let found = attributions(&*contact, &set, &loads);
        for (pair, found) in pairs.iter().zip(&found) {
            for quantity in ComparedQuantity::ALL {
                let gap = quantity.contrast(pair).unwrap();
                let parts = found.contributions(quantity).unwrap();
                assert!((parts.gap() - gap).abs() < 1e-10, "{law} {}", quantity.name());
                for order in parts.by_order {
                    assert!((order.iter().sum::<f64>() - gap).abs() < 1e-10, "{law} {}", quantity.name());
                }
            }
            // The heights are skewed, the sharp asperities high.
            let parts = found.contributions(ComparedQuantity::Separation).unwrap();
            assert!(Cause::ALL.into_iter().all(|cause| parts.part(cause).abs() > 1e-3), "{law}: {parts:?}");
            let [low, high] = parts.range(Cause::Heights);
            assert!(low <= parts.part(Cause::Heights) && parts.part(Cause::Heights) <= high && low < high);
        }
    }
}

/// With equal radii their spread contributes nothing; with heights at the quantiles of the density, nothing but what
/// replacing a sum by its integral leaves.
#[test]
fn equal_radii() {
    let contact = interface("zmc");
    let skewed = set(5000, 0.0, 0.0);
    let found = attributions(&*contact, &skewed, &[2e7]);
    let parts = found[0].contributions(ComparedQuantity::Separation).unwrap();
    for order in Order::ALL {
        let [heights, radii, correlation] = parts.by_order[order as usize];
        assert_eq!(radii, 0.0);
        assert!((correlation != 0.0) == (order == Order::HeightsLast) && correlation.abs() < 5e-3);
        assert!(heights.abs() > 0.05, "{heights}");
    }
    let population = inputs(&skewed).population;
    let quantiles = population.set(5000, Draw::Quantiles).unwrap();
    let found = attributions(&*contact, &quantiles, &[2e7]);
    let parts = found[0].contributions(ComparedQuantity::Separation).unwrap();
    assert!(parts.gap().abs() < 5e-3 && parts.by_order[0][Cause::Radii as usize] == 0.0);
}

/// Shuffled radii leave a correlation within its sampling error, the original ones one far beyond it.
#[test]
fn shuffled_radii_have_no_correlation() {
    let contact = interface("zmc");
    let own = set(5000, -0.4, 0.6);
    let division = Division::independent(own.count(), [5; 32]).unwrap();
    let correlation = |set: &AsperitySet| {
        let all = Rearranged::new(inputs(set));
        let states = all.at_loads(&*contact, &pairs(&*contact, set, &[2e7]));
        let slopes = states.slopes(&all, &*contact);
        let without = |group: usize| {
            let rest = division.without(set, group).unwrap();
            states.without(&Rearranged::new(inputs(&rest)).coarse(), &*contact, &slopes)
        };
        let states_left = (0..division.shares().len()).map(without).collect();
        let groups = GroupsLeftOut { states: states_left, shares: division.shares().to_vec() };
        let found = states.attributions(Some(&groups));
        let estimate = found[0].contributions(ComparedQuantity::Separation).unwrap().estimates[2];
        estimate.contrast / estimate.error.unwrap()
    };
    let of_shuffled = |seed: u64| {
        let mut radii = own.radii().to_vec();
        radii.shuffle(&mut ChaCha8Rng::seed_from_u64(seed));
        correlation(&AsperitySet::new(own.heights().to_vec(), radii, own.nominal_area()).unwrap())
    };
    let scores: Vec<f64> = (0..16).map(of_shuffled).collect();
    let square = scores.iter().map(|score| score * score).sum::<f64>() / 16.0;
    assert!((0.4..2.0).contains(&square), "{scores:?}");
    assert!(correlation(&own).abs() > 5.0);
}

/// The part that leads is in the direction of the sum, and its interval lies beyond those of the others.
#[test]
fn the_leading_part() {
    let part = |contrast: f64, error: Option<f64>| Estimate {
        contrast,
        error,
        quantile: 2.0,
        bound: 0.0,
        independent_error: None,
    };
    let of = |parts: [(f64, f64); 3]| {
        let named = ["a", "b", "c"].into_iter().zip(parts);
        leading(&named.map(|(name, (size, error))| (name, part(size, Some(error)))).collect::<Vec<_>>())
    };
    assert_eq!(of([(0.2, 0.01), (0.1, 0.01), (-0.05, 0.01)]), Some("a"));
    // The largest one is against the direction of the sum.
    assert_eq!(of([(-0.2, 0.01), (0.3, 0.01), (-0.25, 0.01)]), Some("c"));
    assert_eq!(of([(-0.2, 0.01), (0.3, 0.01), (-0.21, 0.01)]), None);
    assert_eq!(of([(0.2, 0.06), (0.1, 0.01), (0.0, 0.0)]), None);
    assert_eq!(of([(0.2, 0.01), (0.1, 0.06), (0.0, 0.0)]), None);
    assert_eq!(of([(0.0, 0.0); 3]), None);
    // Without an interval, what holds on this very surface.
    assert_eq!(leading(&[("a", part(0.2, None)), ("b", part(0.19, None))]), Some("a"));
}

#[test]
fn few_contacts_are_not_attributed() {
    let contact = interface("zmc");
    let found = attributions(&*contact, &set(5000, -0.4, 0.6), &[1e4, 2e7]);
    assert!(found[0].quantities.iter().all(Option::is_none) && found[0].load == 1e4);
    assert!(found[1].quantities.iter().all(Option::is_some));
}
