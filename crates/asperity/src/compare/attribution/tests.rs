use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::states::Arrangement;
use super::{Attribution, Cause, GroupsLeftOut, Inputs, Order, Rearranged};
use crate::asperity::{AsperitySet, Draw, Population, Statistics};
use crate::compare::{ByQuantity, ComparedQuantity, Division, Pair, pairs_at};
use crate::contact_law::named;
use crate::distribution::Heights;
use crate::interface::{Flat, MicroContact, WithSpots};
use crate::layer::ModulusModel;
use crate::material::Material;
use crate::model::{Deterministic, Model, ReferencePlane, Response, Statistical};
use crate::numeric::Sum;
use crate::progress::Silent;
use crate::shape::Shape;
use crate::spot::{Conduction, Shear, ShearStrength, SpotProperties};

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
        set,
        plane,
        population: Population {
            radius: statistics.mean_radius,
            sigma: statistics.sigma,
            density: set.density(),
            heights: Heights::GAUSSIAN,
        },
        mean_shape: Shape::sphere(statistics.mean_radius),
        other_shape: Some(Shape::sphere(statistics.radius_of_mean_curvature)),
        reporting_plane: ReferencePlane { mean: 0.0, sigma: plane.sigma },
        medium: None,
    }
}

fn steel() -> Material {
    Material::new(210e9, 0.3, Some(7.6e9), Some(2.5e9)).unwrap()
}

/// A law on steel, with every quantity of spots.
fn interface(law: &str) -> Box<dyn MicroContact> {
    let contact = named(law).unwrap().interface(&steel(), &Flat::Bare(steel())).unwrap();
    let conduction = Conduction::new([2e-7; 2]).unwrap();
    let properties = SpotProperties {
        electrical: Some(conduction.clone().with_film(1e-13).unwrap()),
        thermal: Some(conduction),
        medium: None,
        shear: Some(Shear { strength: ShearStrength { tau0: 2e7, alpha: 0.05 }, broken: None }),
        tangential: None,
    };
    Box::new(WithSpots::new(contact, properties))
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
        let found = rearranged.with_models(contact, &[], |models| {
            models[Arrangement::Independent as usize].respond(h).pressure.total()
        });
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

/// The largest relative errors of the load and of what the causes divide, of own heights with one shape.
fn errors_of_own_heights(contact: &dyn MicroContact, count: usize) -> ByQuantity<f64> {
    let set = set(count, -0.4, 0.6);
    let inputs = inputs(&set);
    let radii = vec![inputs.mean_shape.radius; count];
    let equal = AsperitySet::new(set.heights().to_vec(), radii, set.nominal_area()).unwrap();
    let all = Deterministic::new(contact, equal.spheres(), inputs.plane);
    let separations = [-1.0, 0.5, 1.5, 2.5, 3.5];
    let found = Rearranged::new(inputs.clone()).with_models(contact, &[], |models| {
        models[Arrangement::OwnHeights as usize].respond_all(&separations)
    });
    let exact = all.respond_all(&separations);
    ComparedQuantity::ALL.map(|quantity| {
        // The separation is found from the load.
        let of = |response: &Response| match quantity {
            ComparedQuantity::Separation => Some(response.pressure.total()),
            _ => quantity.value(response),
        };
        let errors = found.iter().zip(&exact).filter_map(|(a, b)| Some((of(a)? / of(b)? - 1.0).abs()));
        errors.fold(0.0, f64::max)
    })
}

#[test]
fn own_heights_of_one_shape_are_those_of_all_asperities() {
    for (law, most) in [
        ("hertz", 1e-9),
        ("zmc", 1e-9),
        ("jackson-green", 1e-9),
        ("fully-plastic", 1e-9),
        // Area or load jumps.
        ("kogut-etsion", 1e-6),
        ("ceb", 1e-5),
    ] {
        let contact = interface(law);
        assert!(errors_of_own_heights(&*contact, 200).iter().all(|error| *error < 1e-15), "{law}");
        let errors = errors_of_own_heights(&*contact, 400_000);
        let [load, area, rest @ ..] = errors;
        assert!(load < most && area < most && rest.iter().all(|error| *error < 5e-5), "{law}: {errors:?}");
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
            let found = rearranged
                .with_models(&*contact, &[], |models| models[Arrangement::OwnRadii as usize].respond(h));
            let of_radius = |&radius: &f64| {
                let population = Population { radius, ..inputs.population.clone() };
                Statistical::new(&*contact, population).respond(h)
            };
            let each: Vec<Response> = set.radii().iter().map(of_radius).collect();
            let of = |response: &Response| {
                let [electrical, thermal, shear, _] = response.spots;
                [response.pressure.total(), electrical, thermal, shear]
            };
            for (k, found) in of(&found).into_iter().enumerate() {
                let mean = each.iter().map(|one| of(one)[k]).sum::<f64>() / set.count() as f64;
                let most = if k == 0 { 5e-8 } else { 1e-6 };
                assert!((found / mean - 1.0).abs() < most, "{law} {h} {k}: {:e}", found / mean - 1.0);
            }
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
                for order in Order::ALL {
                    let in_order = |cause: Cause| parts.of_cause(cause).by_order[order as usize].contrast;
                    let sum: f64 = Cause::ALL.into_iter().map(in_order).sum();
                    assert!((sum - gap).abs() < 1e-10, "{law} {}", quantity.name());
                    let radii = parts.radii.by_order[order as usize].contrast;
                    assert!((radii - in_order(Cause::Radii) - in_order(Cause::Correlation)).abs() < 1e-12);
                }
            }
            // The heights are skewed, the sharp asperities high.
            let parts = found.contributions(ComparedQuantity::Separation).unwrap();
            assert!(Cause::ALL.into_iter().all(|cause| parts.part(cause).abs() > 1e-3), "{law}: {parts:?}");
            let [low, high] = parts.of_cause(Cause::Heights).range();
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
        let in_order = |cause| parts.of_cause(cause).by_order[order as usize].contrast;
        let [heights, radii, correlation] = Cause::ALL.map(in_order);
        assert_eq!(radii, 0.0);
        assert!((correlation != 0.0) == (order == Order::HeightsLast) && correlation.abs() < 5e-3);
        assert!(heights.abs() > 0.05, "{heights}");
    }
    let population = inputs(&skewed).population;
    let quantiles = population.set(5000, Draw::Quantiles).unwrap();
    let found = attributions(&*contact, &quantiles, &[2e7]);
    let parts = found[0].contributions(ComparedQuantity::Separation).unwrap();
    assert!(parts.gap().abs() < 5e-3 && parts.of_cause(Cause::Radii).by_order[0].contrast == 0.0);
}

/// Shuffled radii leave a correlation within its sampling error, the original ones one far beyond it.
#[test]
fn shuffled_radii_have_no_correlation() {
    let contact = interface("zmc");
    let own = set(5000, -0.4, 0.6);
    let division = Division::independent(own.count(), [5; 32], &Silent).unwrap();
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
        let estimate =
            found[0].contributions(ComparedQuantity::Separation).unwrap().of_cause(Cause::Correlation).mean;
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

#[test]
fn few_contacts_are_not_attributed() {
    let contact = interface("zmc");
    let found = attributions(&*contact, &set(5000, -0.4, 0.6), &[1e4, 2e7]);
    assert!(found[0].quantities.iter().all(Option::is_none) && found[0].load == 1e4);
    assert!(found[1].quantities.iter().all(Option::is_some));
}

/// The other mean radius moves the spread by what it moves the statistical model, and leaves the parts adding up to the difference
/// of that model.
#[test]
fn the_other_mean_radius() {
    let contact = interface("zmc");
    let set = set(5000, -0.4, 0.6);
    let load = [2e7];
    let found = attributions(&*contact, &set, &load);
    let parts = found[0].contributions(ComparedQuantity::Area).unwrap();
    let other = parts.with_other_radius.unwrap();
    let statistics = Statistics::new(&set);
    let radius = statistics.radius_of_mean_curvature;
    assert!(radius < 0.9 * statistics.mean_radius);
    let population = Population { radius, ..inputs(&set).population };
    let integral = Statistical::new(&*contact, population);
    let sum = Deterministic::new(&*contact, set.spheres(), inputs(&set).plane);
    let pair = pairs_at(&integral, &sum, &load)[0].unwrap();
    let gap = ComparedQuantity::Area.contrast(&pair).unwrap();
    assert!((other.iter().sum::<f64>() - gap).abs() < 1e-9, "{other:?} {gap}");
    let shift = other[Cause::Radii as usize] - parts.part(Cause::Radii);
    assert!(shift.abs() > 0.02 && (shift - (gap - parts.gap())).abs() < 0.1 * shift.abs(), "{shift}");
}
