//! The exact sphere on a bonded layer, against solutions made otherwise and against Hertz.

use crate::common::{Row, Worst, rows};
use asperity::layer::exact_sphere::{ElasticContact, LARGEST_RATIO, LayeredSphere};
use asperity::{Material, reduced_modulus};
use rayon::prelude::*;

fn body(young: f64, poisson: f64) -> Material {
    Material::new(young, poisson, None, None).unwrap()
}

/// E1*, Pa.
fn plane(body: &Material) -> f64 {
    body.young() / (1.0 - body.poisson() * body.poisson())
}

/// The contact of a row at R = t = 1, and its layer's E1*.
fn contact(row: &Row, ball: Option<&Material>) -> (ElasticContact, f64) {
    let layer = body(row.number("layer_young"), row.number("layer_poisson"));
    let substrate = body(row.number("substrate_young"), row.number("substrate_poisson"));
    let sphere = LayeredSphere::new(ball, 1.0, &layer, &substrate, 1.0);
    (sphere.at_contact_radius(row.number("contact_radius")).unwrap(), plane(&layer))
}

#[test]
fn rigid_sphere() {
    let rows = rows("layered_sphere");
    assert_eq!(rows.len(), 10);
    for (k, row) in rows.iter().enumerate() {
        let (found, modulus) = contact(row, None);
        // To the last of the eight decimals that are given.
        assert!((found.indentation - row.number("indentation")).abs() < 5.01e-9, "w of row {k}: {found:?}");
        assert!((found.load / modulus - row.number("load")).abs() < 5.01e-9, "P of row {k}: {found:?}");
    }
}

#[test]
fn dense_matrix() {
    let mut worst = Worst::default();
    for (k, row) in rows("layered_ball").iter().enumerate() {
        let elastic = !row.text("ball_young").is_empty();
        let ball = elastic.then(|| body(row.number("ball_young"), row.number("ball_poisson")));
        let (found, modulus) = contact(row, ball.as_ref());
        worst.see(found.indentation, row.number("indentation"), || format!("w of row {k}"));
        worst.see(found.load / modulus, row.number("load"), || format!("P of row {k}"));
        worst.see(found.stiffness / modulus, row.number("stiffness"), || format!("stiffness of row {k}"));
    }
    worst.assert_within(6e-12, 18);
}

/// w, P and dP/dw of Hertz at contact radius a.
fn hertz(a: f64, radius: f64, modulus: f64) -> [f64; 3] {
    [a * a / radius, 4.0 / 3.0 * modulus * a * a * a / radius, 2.0 * modulus * a]
}

fn values(contact: &ElasticContact) -> [f64; 3] {
    [contact.indentation, contact.load, contact.stiffness]
}

#[test]
fn equal_materials_are_hertz() {
    let (steel, radius, thickness) = (body(210e9, 0.3), 12.75e-3, 1.2e-6);
    let rigid = (LayeredSphere::new(None, radius, &steel, &steel, thickness), plane(&steel));
    let ball = body(70e9, 0.2);
    let elastic = LayeredSphere::new(Some(&ball), radius, &steel, &steel, thickness);
    let mut worst = Worst::default();
    for (sphere, modulus) in [rigid, (elastic, reduced_modulus(&ball, &steel))] {
        for ratio in [1e-6, 1e-3, 0.1, 1.0, 10.0, 210.0, 999.0] {
            let a = ratio * thickness;
            let found = values(&sphere.at_contact_radius(a).unwrap());
            for (found, exact) in found.into_iter().zip(hertz(a, radius, modulus)) {
                worst.see(found, exact, || format!("a/t = {ratio}"));
            }
        }
    }
    worst.assert_within(1e-13, 42);
}

#[test]
fn small_contacts_approach_hertz_on_the_layer_and_large_ones_on_the_substrate() {
    for (layer, substrate) in [(body(18e9, 0.35), body(140e9, 0.3)), (body(400e9, 0.2), body(70e9, 0.33))] {
        let ball = body(210e9, 0.3);
        let sphere = LayeredSphere::new(Some(&ball), 1e-2, &layer, &substrate, 1e-6);
        let gaps = |ratio: f64, far: &Material| {
            let found = values(&sphere.at_contact_radius(ratio * 1e-6).unwrap());
            let exact = hertz(ratio * 1e-6, 1e-2, reduced_modulus(&ball, far));
            [0, 1, 2].map(|k| found[k] / exact[k] - 1.0)
        };
        // w and dP/dw in proportion to a/t, P at given a to its cube.
        let (near, nearer) = (gaps(1e-3, &layer), gaps(1e-4, &layer));
        for k in [0, 2] {
            assert!(
                near[k].abs() < 1e-2 && (near[k] / nearer[k] / 10.0 - 1.0).abs() < 1e-2,
                "{near:?} {nearer:?}"
            );
        }
        assert!(near[1].abs() < 1e-8 && nearer[1].abs() < 1e-11, "{near:?} {nearer:?}");
        // As t/a, with a logarithm.
        let (far, farther) = (gaps(90.0, &substrate), gaps(900.0, &substrate));
        for k in 0..3 {
            assert!(
                farther[k].abs() < 3e-2 && (4.0..20.0).contains(&(far[k] / farther[k])),
                "{far:?} {farther:?}"
            );
        }
    }
}

const RATIOS: [f64; 5] = [1e-3, 18.0 / 140.0, 1.5, 10.0, 1e3];

#[test]
fn deeper_is_wider_and_heavier() {
    for ratio in RATIOS {
        let sphere = LayeredSphere::new(None, 1.0, &body(ratio, 0.35), &body(1.0, 0.3), 1.0);
        let curve: Vec<_> = (-30..24)
            .map(|k| sphere.at_contact_radius(1.25f64.powi(k)).unwrap())
            .map(|c| values(&c))
            .collect();
        assert!(curve.windows(2).all(|pair| (0..3).all(|k| pair[0][k] < pair[1][k])), "{ratio}");
    }
}

#[test]
fn stiffness_is_the_slope_of_the_load() {
    for ratio in RATIOS {
        let sphere = LayeredSphere::new(Some(&body(0.7, 0.1)), 1.0, &body(ratio, 0.35), &body(1.0, 0.3), 1.0);
        for a in [1e-3, 0.3, 1.0, 4.0, 30.0] {
            let at = |a| sphere.at_contact_radius(a).unwrap();
            let (below, above) = (at(a * (1.0 - 1e-4)), at(a * (1.0 + 1e-4)));
            let slope = (above.load - below.load) / (above.indentation - below.indentation);
            assert!((at(a).stiffness / slope - 1.0).abs() < 1e-7, "a/t = {a}, E1/E2 = {ratio}");
        }
    }
}

#[test]
fn an_indentation_finds_its_contact_radius() {
    let mut worst = Worst::default();
    for ratio in RATIOS {
        let sphere = LayeredSphere::new(None, 3.0, &body(ratio, 0.35), &body(1.0, 0.3), 0.1);
        for a in [1e-9, 1e-3, 0.05, 0.1, 0.7, 3.0, 20.0] {
            let exact = sphere.at_contact_radius(a).unwrap();
            let found = sphere.at_indentation(exact.indentation).unwrap();
            worst.see(found.contact_radius, a, || format!("a = {a}, E1/E2 = {ratio}"));
            worst.see(found.indentation, exact.indentation, || format!("w at {a}, E1/E2 = {ratio}"));
            worst.see(found.load, exact.load, || format!("P at {a}, E1/E2 = {ratio}"));
            worst.see(found.stiffness, exact.stiffness, || format!("dP/dw at {a}, E1/E2 = {ratio}"));
        }
    }
    worst.assert_within(2e-12, 140);
}

#[test]
fn what_is_out_of_range_is_refused() {
    let sphere = LayeredSphere::new(None, 1.0, &body(1.0, 0.3), &body(2.0, 0.3), 1e-3);
    for a in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.001 * LARGEST_RATIO * 1e-3] {
        assert_eq!(sphere.at_contact_radius(a), None);
    }
    for w in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.1] {
        assert_eq!(sphere.at_indentation(w), None);
    }
}

#[test]
fn the_same_bits_on_one_thread_and_on_four() {
    let curve = |threads| -> Vec<[u64; 3]> {
        let sphere = LayeredSphere::new(
            Some(&body(210e9, 0.3)),
            12.75e-3,
            &body(18e9, 0.35),
            &body(140e9, 0.3),
            1.2e-6,
        );
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let at = |k: i32| values(&sphere.at_indentation(1e-10 * 1.5f64.powi(k)).unwrap()).map(f64::to_bits);
        pool.install(|| (0..26).into_par_iter().map(at).collect())
    };
    assert_eq!(curve(1), curve(4));
}
