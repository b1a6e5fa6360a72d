//! Both models.

use asperity::{
    AsperitySet, Deterministic, Draw, Ellipse, Ellipses, Heights, MicroContact, Model, Population,
    ReferencePlane, Shape, Statistical, at_pressure,
};

use super::case::Case;
use super::contact::each;
use super::laws::Entry;
use crate::common::{Random, Worst, dense, relative_error, scan_and_levels};

/// A population in which some asperities are pressed far less than the law's boundaries, some far more, or all about
/// there.
fn population(entry: &Entry, case: &Case, random: &mut Random) -> Population {
    let heights = random.one_of(&[Heights::GAUSSIAN, Heights::EXPONENTIAL]);
    let sigma = case.scale(entry, random) * random.log(1e-6, 1e6);
    Population { radius: case.shape.radius, sigma, density: 1e10, heights }
}

#[test]
fn exponential_heights_make_area_proportional_to_load() {
    let mut worst = Worst::default();
    each(1, 30, |entry, case, contact, random| {
        let population = Population { heights: Heights::EXPONENTIAL, ..population(entry, case, random) };
        if case.layered.is_some() {
            return;
        }
        let model = Statistical::of_shape(contact, population.clone(), case.shape);
        let mean_pressure = |h| model.respond(h).mean_real_pressure().unwrap();
        let exact = mean_pressure(0.5);
        for h in [-1.0, 0.0, 1.5, 4.0, 30.0] {
            worst.see(mean_pressure(h), exact, || format!("{} at h = {h} of {case:?}", entry.label));
        }
    });
    worst.assert_within(1e-14, 800);
}

/// Whether the load jumps somewhere.
fn jumps(contact: &dyn MicroContact, shape: Shape) -> bool {
    let load = |w: f64| contact.contact(w, shape).load;
    let jumps = |w: f64| relative_error(load(w * (1.0 + 1e-11)), load(w * (1.0 - 1e-11))) > 1e-8;
    contact.regime_changes(shape).into_iter().any(jumps)
}

/// Against panels a fifth of an octave wide between everything that a scan finds.
#[test]
fn integrals_are_those_of_dense_panels() {
    let mut worst = [Worst::default(), Worst::default(), Worst::default()];
    each(2, 60, |entry, case, contact, random| {
        let population = population(entry, case, random);
        let mut kinks = case.changes(|w| case.state(entry, w));
        kinks.extend(contact.regime_changes(case.shape));
        let model = Statistical::of_shape(contact, population.clone(), case.shape);
        // Where the load jumps, its slope has a share that no panel sees.
        let columns = if jumps(contact, case.shape) { 2 } else { 3 };
        for h in [-10.0, -3.0, 0.0, 3.0, 20.0, 35.0] {
            let found = model.respond(h);
            let exact = dense(contact, case.shape, &kinks, &population, h);
            let found = [found.area_ratio.total(), found.pressure.total(), found.stiffness];
            for k in 0..columns {
                worst[k].see(found[k], exact[k], || {
                    format!("{} at h = {h}, {:?} of {case:?}", entry.label, population)
                });
            }
        }
    });
    for (worst, bound) in worst.iter().zip([2e-13, 2e-13, 1e-11]) {
        worst.assert_within(bound, 1000);
    }
}

/// The integral is smooth in the separation, whatever the load does, but for where a jump meets the end of the heights.
#[test]
fn stiffness_is_the_slope_of_the_pressure() {
    const STEP: f64 = 2e-3;
    let (mut worst, mut jumping) = (0.0f64, 0);
    each(3, 40, |entry, case, contact, random| {
        let population = population(entry, case, random);
        let model = Statistical::of_shape(contact, population.clone(), case.shape);
        jumping += usize::from(jumps(contact, case.shape));
        let lowest = if population.heights == Heights::EXPONENTIAL { -0.5 } else { -6.0 };
        for h in [lowest, 0.4 * lowest, 0.0, 1.0, 2.5, 6.0] {
            let pressure = |steps: f64| model.respond(h + steps * STEP).pressure.total();
            let slope = (8.0 * (pressure(-1.0) - pressure(1.0)) - (pressure(-2.0) - pressure(2.0)))
                / (12.0 * STEP * population.sigma);
            let found = model.respond(h);
            let size = found.stiffness.abs() + found.pressure.total() / population.sigma;
            let error = (found.stiffness - slope).abs() / size;
            worst = worst.max(error);
            let place = || format!("{} at h = {h}, {population:?} of {case:?}", entry.label);
            assert!(error < 1e-8, "{:e} for {slope:e}: {}", found.stiffness, place());
        }
    });
    println!("worst {worst:e}, {jumping} jumping");
    assert!(jumping > 50, "{jumping}");
}

/// The largest separation that carries a pressure, against a scan from above, at pressures next to each peak and
/// anywhere; of one asperity, of some, and of the integral.
#[test]
fn the_first_reach_counts() {
    let (mut peaks, mut reached) = (0, 0);
    each(4, 20, |entry, case, contact, random| {
        // Boundaries are passed somewhere on the way.
        let sigma = case.scale(entry, random) * random.log(0.1, 100.0);
        let population =
            Population { radius: case.shape.radius, sigma, density: 1e10, heights: Heights::GAUSSIAN };
        let count = random.one_of(&[1, 3, 30, 100]);
        let drawn = population.set(count, Draw::Random([count as u8; 32])).unwrap();
        let radii = drawn.radii().iter().map(|b| b * random.log(0.3, 3.0)).collect();
        let ellipses = (0..count)
            .map(|_| Ellipse::new(random.log(0.3, 3.0) / case.shape.radius, case.shape.radius.recip()))
            .collect();
        let set = AsperitySet::new(drawn.heights().to_vec(), radii, drawn.nominal_area()).unwrap();
        let ellipses = set.clone().with_ellipses(ellipses).unwrap();
        let ellipses = Ellipses::new(&ellipses).unwrap();
        let sets = [set.spheres(), ellipses.asperities()];
        let plane = ReferencePlane { mean: 0.0, sigma };
        let sums = sets.map(|set| Deterministic::new(contact, set, plane));
        let integral = Statistical::of_shape(contact, population, case.shape);
        for model in [&integral as &dyn Model, &sums[0], &sums[1]] {
            let pressure = |h: f64| model.respond(h).pressure.total();
            let (scan, levels) = scan_and_levels(pressure, random);
            peaks += (levels.len() - 3) / 2;
            for level in levels {
                let first = scan.iter().find(|point| point.1 >= level);
                let place = || format!("{level:e}, sigma {sigma:e} {}: {case:?}", entry.label);
                let Ok(found) = at_pressure(model, level) else {
                    assert!(first.is_none(), "{first:?} for {}", place());
                    continue;
                };
                reached += 1;
                let h = found.response.separation_over_sigma;
                let excess = found.response.pressure.total() / level - 1.0;
                // Between them rounding decides.
                assert!(found.in_jump || excess < 1e-8, "{found:?} for {}", place());
                assert!(!found.in_jump || excess > 1e-12, "{found:?} for {}", place());
                assert!(
                    first.is_none_or(|point| h >= point.0 - 1e-12),
                    "{h} behind {first:?} for {}",
                    place()
                );
                assert!(pressure(h) >= level * (1.0 - 1e-12), "{h} for {}", place());
                let beyond = pressure(h + 1e-12 * h.abs().max(1.0));
                assert!(beyond < level * (1.0 + 1e-11), "{h} for {}", place());
            }
        }
    });
    println!("{peaks} peaks, {reached} levels");
    assert!(peaks > 30 && reached > 500, "{peaks} {reached}");
}

/// One asperity at each boundary where its load jumps higher than it ever was.
#[test]
fn a_pressure_in_a_jump_is_said_to_be_in_one() {
    let mut count = 0;
    each(5, 40, |entry, case, contact, _| {
        let shape = Shape::sphere(case.shape.radius);
        let set = AsperitySet::new(vec![0.0], vec![shape.radius], 1.0).unwrap();
        let load = |w: f64| contact.contact(w, shape).load;
        let changes = contact.regime_changes(shape);
        for &w in &changes {
            let before = changes.iter().map(|w| w * (1.0 + 1e-11)).filter(|&other| other < w);
            let scan = (0..3000).map(|k| w * (-0.01 * f64::from(k)).exp());
            let below = before.chain(scan).map(|w| load(w * (1.0 - 1e-11))).fold(0.0, f64::max);
            let above = load(w * (1.0 + 1e-11));
            if above < below * (1.0 + 1e-6) {
                continue;
            }
            let model = Deterministic::new(contact, set.spheres(), ReferencePlane { mean: 0.0, sigma: w });
            let reached = at_pressure(&model, 0.5 * (below + above)).unwrap();
            assert!(reached.in_jump, "{}: {reached:?} at {w:e} of {case:?}", entry.label);
            assert!(relative_error(-reached.response.separation, w) < 1e-11, "{}: {case:?}", entry.label);
            count += 1;
        }
    });
    assert!(count > 100, "{count}");
}
