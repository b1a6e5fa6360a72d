//! Elliptic asperities under both models, against Hertz's ellipse written out.

use std::f64::consts::PI;

use crate::common::{Worst, bare_contact, contact, lead, steel};
use asperity::{
    Accumulator, AsperitySet, Deterministic, Ellipse, Ellipses, Ellipticity, Flat, Heights, Law, LayeredFlat,
    Model, ModulusModel, Ordered, Pair, Population, ReferencePlane, Shape, Statistical, YieldLimits, Zmc,
};

/// K(m) and E(m) at q = 1 - m, by the arithmetic-geometric mean in its textbook form.
fn complete(q: f64) -> [f64; 2] {
    let (mut a, mut g, mut c, mut sum, mut power) = (1.0, q.sqrt(), (1.0 - q).sqrt(), 0.0, 0.5);
    for _ in 0..12 {
        sum += power * c * c;
        power *= 2.0;
        (a, g, c) = (0.5 * (a + g), (a * g).sqrt(), 0.5 * (a - g));
    }
    let first = PI / (2.0 * a);
    [first, first * (1.0 - sum)]
}

/// Area and load of a Hertz ellipse (m^2, N) at `w`, by bisection for q.
fn hertz(w: f64, ellipse: &Ellipse, modulus: f64) -> [f64; 2] {
    let ratio = |q: f64| {
        let [k, e] = complete(q);
        (e / q - k) / (k - e)
    };
    let (mut low, mut high) = (1e-12f64, 1.0 - 1e-9);
    for _ in 0..200 {
        let middle = (low * high).sqrt();
        if ratio(middle) > ellipse.curvature_ratio { low = middle } else { high = middle }
    }
    let q = low;
    let [k, e] = complete(q);
    let minor = (w * e / (ellipse.mean_curvature * k)).sqrt();
    let major = minor / q.sqrt();
    [PI * major * minor, 2.0 * PI / 3.0 * modulus * major * w / k]
}

fn ellipses() -> Vec<Ellipse> {
    let ratio = |k: usize| 1.5 + (k * k % 23) as f64;
    (0..200)
        .map(|k| Ellipse { mean_curvature: 5e4 * (1.0 + (k % 7) as f64), curvature_ratio: ratio(k) })
        .collect()
}

fn set() -> AsperitySet {
    let heights = (0..200).map(|k| 1e-8 * ((k * 37) % 200) as f64).collect();
    AsperitySet::new(heights, vec![1.0; 200], 1e-8).unwrap().with_ellipses(ellipses()).unwrap()
}

#[test]
fn a_sum_over_ellipses_is_that_of_hertz() {
    let contact = bare_contact("hertz", &[], &steel());
    let (set, modulus) = (set(), contact.reference_modulus());
    let ellipses = Ellipses::new(&set).unwrap();
    let sum = Deterministic::new(&*contact, ellipses.asperities(), ReferencePlane { mean: 0.0, sigma: 1e-7 });
    let mut worst = Worst::default();
    for h in [0.0, 3.3, 11.0] {
        let mut expected = [0.0; 2];
        for (z, ellipse) in set.heights().iter().zip(set.ellipses().unwrap()) {
            if *z > h * 1e-7 {
                let [area, load] = hertz(z - h * 1e-7, ellipse, modulus);
                expected = [expected[0] + area / 1e-8, expected[1] + load / 1e-8];
            }
        }
        let found = sum.respond(h);
        worst.see(found.area_ratio.total(), expected[0], || format!("area at {h}"));
        worst.see(found.pressure.total(), expected[1], || format!("pressure at {h}"));
    }
    // Bisection on a difference of integrals leaves some digits less.
    worst.assert_within(1e-11, 6);
}

/// n spheres per summit: the integral is n times that over the spheres, and the sum over quantiles converges to it.
#[test]
fn an_integral_over_ellipses_is_that_over_their_spheres() {
    let contact = bare_contact("zmc", &[], &steel());
    let mean = Ellipticity { mean_curvature: 5e4, mean_ratio: 0.2 };
    let shape = mean.shape();
    assert!(shape.spheres > 1.1);
    let population =
        Population { radius: shape.radius, sigma: 5e-8, density: 6e10, heights: Heights::GAUSSIAN };
    let spheres = Statistical::new(&*contact, population.clone());
    let ellipses = Statistical::of_shape(&*contact, Population { radius: 1.0, ..population }, shape);
    for h in [-1.0, 0.5, 3.0] {
        let (one, all) = (spheres.respond(h), ellipses.respond(h));
        assert!((all.pressure.total() / one.pressure.total() / shape.spheres - 1.0).abs() < 1e-14);
        assert!((all.area_ratio.total() / one.area_ratio.total() / shape.spheres - 1.0).abs() < 1e-14);
        assert!((all.contact_density / one.contact_density - 1.0).abs() < 1e-14);
    }
}

/// On a layer an ellipse has the effective properties of a sphere of equal elastic area, in single contacts and in
/// blocks.
#[test]
fn under_a_layer_an_ellipse_feels_the_circle_of_its_area() {
    let (steel, lead) = (steel(), lead());
    let layered = LayeredFlat::new(&lead, &steel, 5e-8, ModulusModel::Gao).unwrap();
    let flat = Flat::Layered { substrate: steel, layered: layered.clone() };
    let contact = contact("zmc", &[], &steel, &flat);
    let set = set();
    let all = Ordered::new(Ellipses::new(&set).unwrap().asperities());
    let touching = all.above(5e-7);
    let (mut block, mut single) = (Accumulator::default(), Accumulator::default());
    contact.accumulate(touching, 5e-7, &mut block);
    touching.each().for_each(|(z, shape)| {
        let (w, n) = (z - 5e-7, shape.spheres);
        let found = contact.contact(w, shape);
        single.add(&found, shape);
        let flat = layered.at(w, n * shape.radius);
        let hardness = flat.hardness.min(7.6e9);
        let pair = Pair {
            reduced_modulus: (steel.plane_compliance() + flat.compliance).recip(),
            yield_limits: YieldLimits { onset: hardness, strength: hardness },
        };
        let law = Zmc::default().contact(w, shape.radius, &pair);
        assert!((found.load / (n * law.load) - 1.0).abs() < 1e-14);
        assert!((found.area / (n * law.area) - 1.0).abs() < 1e-14);
        assert_eq!(found.regime, law.regime);
    });
    let (block, single) = (block.total(), single.total());
    assert!(touching.count() > 100 && !touching.count().is_multiple_of(8));
    for k in 0..3 {
        assert!((block.load().0[k] - single.load().0[k]).abs() <= 4e-15 * single.load().0[k]);
        assert!((block.area().0[k] - single.area().0[k]).abs() <= 4e-15 * single.area().0[k]);
    }
    let mut weighed = Accumulator::default();
    let shape = Shape::ellipse(5e4, 7.0);
    let indentations: Vec<f64> = (1..=19).map(|k| 3e-9 * f64::from(k)).collect();
    contact.accumulate_weighted(&indentations, &[2.0; 19], shape, &mut weighed);
    let loads = indentations.iter().map(|&w| 2.0 * contact.contact(w, shape).load);
    assert!((weighed.total().load().total() / loads.sum::<f64>() - 1.0).abs() < 1e-14);
}

#[test]
fn ellipses_of_ratio_one_are_spheres_to_the_bit() {
    let heights: Vec<f64> = (0..50).map(|k| 1e-8 * f64::from((k * 17) % 50)).collect();
    let radii: Vec<f64> = (1..=50).map(|k| 1e-6 * f64::from(k)).collect();
    let round = |b: &f64| Ellipse { mean_curvature: b.recip(), curvature_ratio: 1.0 };
    let ellipses = radii.iter().map(round).collect();
    let radii = radii.iter().map(|b| b.recip().recip()).collect();
    let set = AsperitySet::new(heights, radii, 1e-8).unwrap().with_ellipses(ellipses).unwrap();
    let contact = bare_contact("zmc", &[], &steel());
    let ellipses = Ellipses::new(&set).unwrap();
    let plane = ReferencePlane { mean: 0.0, sigma: 1e-7 };
    let [one, other] = [set.spheres(), ellipses.asperities()]
        .map(|set| Deterministic::new(&*contact, set, plane).respond(0.5));
    assert_eq!(one, other);
}
