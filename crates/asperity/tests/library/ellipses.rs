//! A sum over elliptic asperities, against Hertz's ellipse written out.

use std::f64::consts::PI;

use crate::common::{Worst, bare_contact, steel};
use asperity::{AsperitySet, Deterministic, Ellipse, Ellipses, Model, ReferencePlane};

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
