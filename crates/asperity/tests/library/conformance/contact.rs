//! One asperity on flats of all kinds: homogeneous, under a layer, all layer.

use asperity::numeric::Interval;
use asperity::{
    Accumulator, AsperitySet, Contact, Deterministic, Draw, Ellipse, Ellipses, Heights, Inapplicable,
    Material, MicroContact, Model, Ordered, Population, ReferencePlane, Shape, Shapes, Statistical, Total,
};

use super::case::Case;
use super::laws::{Entry, all};
use crate::common::{Random, Worst, slope};

/// Shows `see` every law on `count` flats.
pub fn each(seed: u64, count: usize, mut see: impl FnMut(&Entry, &Case, &dyn MicroContact, &mut Random)) {
    for entry in all() {
        let mut random = Random::new(seed);
        for _ in 0..count {
            let case = Case::of(&entry, &mut random);
            see(&entry, &case, &*case.contact(&entry), &mut random);
        }
    }
}

fn values(contact: &Contact) -> [f64; 3] {
    [contact.area, contact.load, contact.stiffness]
}

/// An asperity is a number of spheres, each on the effective homogeneous body of a contact of the asperity's width.
#[test]
fn the_law_is_asked_with_what_is_felt() {
    let mut worst = [Worst::default(), Worst::default()];
    each(1, 100, |entry, case, contact, random| {
        let Shape { radius, spheres } = case.shape;
        for _ in 0..30 {
            let w = case.scale(entry, random) * random.log(1e-8, 1e8);
            let found = contact.contact(w, case.shape);
            let exact = entry.law().contact(w, radius, &case.pair(entry, w));
            // Next to a boundary rounding may lie on its other side.
            if found.regime == exact.regime {
                let worst = &mut worst[usize::from(case.layered.is_some())];
                worst.see(found.area, spheres * exact.area, || {
                    format!("{} at {w:e} of {case:?}", entry.label)
                });
                worst.see(found.load, spheres * exact.load, || {
                    format!("{} at {w:e} of {case:?}", entry.label)
                });
            }
        }
    });
    for worst in worst {
        worst.assert_within(1e-13, 10_000);
    }
}

/// Against a scan of 10 000 indentations: none is missed, none is invented.
#[test]
fn every_change_of_formula_is_found() {
    let mut most = 0;
    each(2, 40, |entry, case, contact, _| {
        let found = contact.regime_changes(case.shape);
        assert!(found.is_sorted());
        most = most.max(found.len());
        let formula = |w: f64| case.state(entry, w).0;
        for &w in &found {
            let [below, above] = [1.0 - 1e-11, 1.0 + 1e-11].map(|side| formula(w * side));
            assert_ne!(below, above, "{}: {w:e} is none of {case:?}", entry.label);
        }
        for w in case.changes(formula) {
            let near = |found: &f64| (found / w - 1.0).abs() < 1e-11;
            assert!(found.iter().any(near), "{}: {w:e} of {case:?} is not in {found:?}", entry.label);
        }
    });
    assert!(most >= 6, "{most} changes at the most");
}

#[test]
fn stiffness_is_the_slope_of_the_load() {
    const REACH: f64 = 4e-4;
    let mut worst = 0.0f64;
    each(3, 40, |entry, case, contact, random| {
        let state = |w: f64| case.state(entry, w);
        for _ in 0..30 {
            let w = case.scale(entry, random) * random.log(1e-6, 1e6);
            if state(w * (-REACH).exp()) != state(w * REACH.exp()) {
                continue;
            }
            // The narrow transition is not longer than thirty steps.
            let reach = if entry.label == "zmc, narrow" { 1e-5 } else { REACH };
            let exact = slope(|w| contact.contact(w, case.shape).load, w, reach);
            let found = contact.contact(w, case.shape);
            let error = (found.stiffness * w - exact).abs() / exact.abs().max(found.load);
            worst = worst.max(error);
            assert!(error < 1e-9, "{error:e}: {} at {w:e} of {case:?}", entry.label);
        }
    });
    println!("worst {worst:e}");
}

/// Many at once, and blocks of them, are the single ones.
#[test]
fn many_answer_as_one_does() {
    let mut worst = Worst::default();
    let mut see = |found: Total, single: Total, place: &dyn Fn() -> String| {
        assert_eq!(found.contacts(), single.contacts());
        worst.see(found.stiffness(), single.stiffness(), place);
        let parts = |total: Total| [total.area().0, total.load().0].concat();
        parts(found).into_iter().zip(parts(single)).for_each(|(a, b)| worst.see(a, b, place));
        // Of single contacts; of weighted ones both are zero.
        let of_contacts =
            |total: Total| [total.largest_load(), total.large_strain_load(), total.load_squared()];
        for (a, b) in of_contacts(found).into_iter().zip(of_contacts(single)) {
            assert!((a - b).abs() <= 1e-13 * b, "{a:e} {b:e}: {}", place());
        }
    };
    each(4, 10, |entry, case, contact, random| {
        let scale = case.scale(entry, random);
        let heights: Vec<f64> = (0..61).map(|_| scale * random.log(1e-4, 1e4)).collect();
        let radii = heights.iter().map(|_| case.shape.radius * random.log(0.1, 10.0)).collect();
        let ellipses =
            heights.iter().map(|_| Ellipse::new(case.shape.radius.recip(), random.log(1e-3, 1e9))).collect();
        let spheres = AsperitySet::new(heights, radii, 1.0).unwrap();
        let ellipses = spheres.clone().with_ellipses(ellipses).unwrap();
        let ellipses = Ellipses::new(&ellipses).unwrap();
        for set in [spheres.spheres(), ellipses.asperities()] {
            let separation = 0.3 * scale;
            let ordered = Ordered::new(set);
            let touching = ordered.above(separation);
            let mut found = Accumulator::default();
            contact.accumulate(touching, separation, &mut found);
            let mut single = Accumulator::default();
            touching.each().for_each(|(z, shape)| single.add(&contact.contact(z - separation, shape), shape));
            see(found.total(), single.total(), &|| format!("{} of {case:?}", entry.label));
        }
        let indentations: Vec<f64> = (0..29).map(|_| scale * random.log(1e-4, 1e4)).collect();
        let (mut found, mut single) = (Accumulator::default(), Accumulator::default());
        contact.accumulate_weighted(&indentations, &indentations, case.shape, &mut found);
        indentations.iter().for_each(|&w| single.accumulate_weighted(&contact.contact(w, case.shape), w));
        see(found.total(), single.total(), &|| format!("{} of {case:?}", entry.label));
    });
    worst.assert_within(1e-13, 1000);
}

#[test]
fn bounds_of_the_load_hold() {
    let mut closed = 0;
    each(5, 60, |entry, case, contact, random| {
        let changes = contact.regime_changes(case.shape);
        for _ in 0..15 {
            let low = case.scale(entry, random) * random.log(1e-6, 1e6);
            let from = random.one_of(&[low, low, low, 0.0]);
            let to = low * (1.0 + random.log(1e-6, 1e3));
            let mut places: Vec<f64> =
                (0..=60).map(|k| low * (to / low).powf(f64::from(k) / 60.0)).map(|w| w.min(to)).collect();
            places.extend(changes.iter().flat_map(|w| [1.0 - 1e-12, 1.0 + 1e-12].map(|side| w * side)));
            places.retain(|w| (from..=to).contains(w));
            places.sort_by(f64::total_cmp);
            let points: Vec<(f64, Contact)> =
                places.into_iter().map(|w| (w, contact.contact(w, case.shape))).collect();
            let bounds = contact.load_over(from, to, case.shape);
            let place = || format!("{}: {bounds:?} from {from:e} to {to:e} of {case:?}", entry.label);
            let highest = points.iter().map(|(_, found)| found.load).fold(0.0, f64::max);
            assert!(highest <= bounds.highest * (1.0 + 1e-12), "{highest:e} {}", place());
            let Interval { low: least, high: most } = bounds.slopes;
            for (w, found) in &points {
                let slack = 1e-10 * found.load / w;
                let holds = (least - slack..=most + slack).contains(&found.stiffness);
                assert!(holds, "{found:?} at {w:e}: {}", place());
            }
            for pair in points.windows(2).filter(|pair| pair[1].0 > pair[0].0) {
                let [(w, below), (next, above)] = [pair[0], pair[1]];
                let change = (above.load - below.load) / (next - w);
                let slack = 1e-14 * above.load / (next - w) + 1e-10 * above.load / w;
                assert!((least - slack..=most + slack).contains(&change), "{change:e}: {}", place());
            }
            if from > 0.0 && to < from * (1.0 + 1e-4) && !changes.iter().any(|w| (from..=to).contains(w)) {
                assert!(bounds.highest < highest * (1.0 + 1e-2), "{highest:e} {}", place());
                closed += 1;
            }
        }
    });
    assert!(closed > 500, "{closed}");
}

#[test]
fn no_load_falls_but_where_it_is_said_to() {
    let (mut free, mut falling) = (0, 0);
    each(6, 60, |entry, case, contact, random| {
        let Shape { radius, spheres } = case.shape;
        let radii = Interval { low: radius, high: radius * random.one_of(&[1.0, 1.5]) };
        let numbers = Interval { low: spheres, high: spheres * random.one_of(&[1.0, 1.2]) };
        let within = contact.may_decrease(Shapes { radii, spheres: numbers });
        assert!(within.windows(2).all(|pair| pair[0].high < pair[1].low));
        free += usize::from(within.is_empty());
        for shape in [case.shape, Shape { radius: radii.high, spheres: numbers.high }] {
            let middle = case.scale(entry, random);
            let place = |k: i32| middle * (f64::from(k - 1500) * 0.01).exp();
            for k in 0..3000 {
                let [low, high] = [place(k), place(k + 1)];
                if contact.contact(high, shape).load < contact.contact(low, shape).load * (1.0 - 1e-12) {
                    falling += 1;
                    let is_said = within.iter().any(|range| range.overlaps(Interval { low, high }));
                    assert!(is_said, "{} falls at {low:e}, said {within:?}: {case:?}", entry.label);
                }
            }
        }
    });
    assert!(free > 200 && falling > 200, "{free} {falling}");
}

/// A layer of the substrate's material.
#[test]
fn a_layer_of_the_same_material_is_none() {
    let mut worst = [Worst::default(), Worst::default(), Worst::default()];
    each(7, 60, |entry, case, _, random| {
        if case.layered.is_none() {
            return;
        }
        let same = Case { layer: case.substrate, ..case.clone() };
        let both = [case.thickness, 0.0]
            .map(|thickness| entry.law.interface(&case.rough, &same.flat(thickness)).unwrap());
        for _ in 0..30 {
            let w = case.scale(entry, random) * random.log(1e-8, 1e8);
            let [found, bare] = both.each_ref().map(|contact| contact.contact(w, case.shape));
            if found.regime == bare.regime {
                for (k, worst) in worst.iter_mut().enumerate() {
                    worst.see(values(&found)[k], values(&bare)[k], || format!("{} of {case:?}", entry.label));
                }
            }
        }
    });
    for worst in worst {
        worst.assert_within(1e-13, 1000);
    }
}

/// From the least to the largest thickness that is a number here, both ends included.
#[test]
fn thin_and_thick_layers_end_in_their_limits() {
    each(8, 16, |entry, case, _, _| {
        if case.layered.is_none() {
            return;
        }
        let sigma = 1e-2 * case.shape.radius;
        let population =
            Population { radius: case.shape.radius, sigma, density: 1e10, heights: Heights::GAUSSIAN };
        let set = population.set(50, Draw::Quantiles).unwrap();
        let loads = |thickness: f64| {
            let contact = entry.law.interface(&case.rough, &case.flat(thickness)).unwrap();
            let sum = Deterministic::new(&*contact, set.spheres(), ReferencePlane { mean: 0.0, sigma });
            [&Statistical::new(&*contact, population.clone()) as &dyn Model, &sum]
                .map(|model| model.respond(1.0).pressure.total())
        };
        for (end, sign) in [(0.0, -1), (f64::INFINITY, 1)] {
            let limits = loads(end);
            let mut before = [f64::INFINITY; 2];
            for power in 0..=30 {
                let found = loads(10f64.powi(sign * power));
                for k in 0..2 {
                    let off = (found[k] / limits[k] - 1.0).abs();
                    let place = || format!("{}: 10^{} m of {case:?}", entry.label, sign * power);
                    assert!(off.is_finite() && found[k] > 0.0, "{}", place());
                    // Nearer with each decade, once the contact is small or large beside the layer.
                    if power >= 20 {
                        assert!(off <= before[k].max(2e-14), "{off:e} at {}", place());
                    }
                    before[k] = off;
                }
            }
            assert!(before.iter().all(|&off| off < 1e-12), "{}: {before:?} of {case:?}", entry.label);
        }
    });
}

#[test]
fn a_law_of_homogeneous_bodies_is_refused_under_a_layer() {
    let body = |hardness: f64| Material::new(2e11, 0.3, Some(hardness), Some(hardness / 3.0)).unwrap();
    for entry in all() {
        let case = Case {
            rough: body(8e9),
            layer: body(1e8),
            substrate: body(8e9),
            ..Case::of(&entry, &mut Random::new(9))
        };
        for (thickness, may_be) in [(0.0, true), (1e-7, entry.law.supports_layers()), (f64::INFINITY, true)] {
            let found = entry.law.interface(&case.rough, &case.flat(thickness));
            assert_eq!(found.is_ok(), may_be, "{}", entry.label);
            assert!(found.is_ok() || matches!(found, Err(Inapplicable::Layer { .. })), "{}", entry.label);
        }
    }
}
