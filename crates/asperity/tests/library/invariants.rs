//! Properties of any surface, beyond those of every law (`conformance`).

use crate::common::{Worst, bare_contact, dense, relative_error, steel};
use asperity::distribution::gaussian_moment;
use asperity::{
    AsperitySet, Deterministic, Draw, Heights, Material, MicroContact, Model, Ordered, Population,
    ReferencePlane, Response, Shape, Statistical, Statistics, SurfaceHeights, Zmc, at_pressure,
};

const CASE_1: Population =
    Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };
const CASE_2: Population =
    Population { radius: 1.6e-6, sigma: 2.6e-7, density: 9e10, heights: Heights::GAUSSIAN };

fn zmc(onset: f64) -> Box<dyn MicroContact> {
    bare_contact("zmc", &[("onset", onset)], &steel())
}

fn drawn(population: Population, count: usize) -> AsperitySet {
    population.set(count, Draw::Random([7; 32])).unwrap()
}

fn plane(population: Population) -> ReferencePlane {
    ReferencePlane { mean: 0.0, sigma: population.sigma }
}

/// The exact sum of doubles, rounded once (Shewchuk 1997, as in Python's fsum).
fn exact_sum(terms: impl Iterator<Item = f64>) -> f64 {
    let mut partials: Vec<f64> = Vec::new();
    for mut x in terms {
        let mut kept = 0;
        for i in 0..partials.len() {
            let mut y = partials[i];
            if x.abs() < y.abs() {
                (x, y) = (y, x);
            }
            let high = x + y;
            let low = y - (high - x);
            if low != 0.0 {
                partials[kept] = low;
                kept += 1;
            }
            x = high;
        }
        partials.truncate(kept);
        partials.push(x);
    }
    partials.iter().sum()
}

#[test]
fn a_sum_over_a_million_asperities_is_exact_to_4_ulp() {
    let law = zmc(Zmc::ONSET);
    let drawn_set = drawn(CASE_2, 1_000_000);
    let equal = AsperitySet::new(vec![1.37e-7; 1_000_000], vec![1.1e-6; 1_000_000], 1.0).unwrap();
    for set in [drawn_set, equal] {
        let ordered = Ordered::new(set.spheres());
        for d in [-1e-6, 0.0, 1e-7] {
            let above = ordered.above(d);
            let contacts = || (0..above.count()).map(|i| law.contact(above.heights()[i] - d, above.shape(i)));
            let found = Deterministic::new(&*law, set.spheres(), plane(CASE_2)).total(d);
            let ulp = |exact: f64| exact * f64::EPSILON;
            let (area, load) = (exact_sum(contacts().map(|c| c.area)), exact_sum(contacts().map(|c| c.load)));
            assert!((found.area().total() - area).abs() <= 4.0 * ulp(area));
            assert!((found.load().total() - load).abs() <= 4.0 * ulp(load));
        }
    }
}

#[test]
fn a_sum_is_the_same_to_the_bit_on_any_number_of_threads() {
    let law = zmc(Zmc::ONSET);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let set = drawn(CASE_1, 300_001);
            let model = Deterministic::new(&*law, set.spheres(), plane(CASE_1));
            [2.5, 1.0, -0.5].map(|h| format!("{:?}", model.respond(h)))
        })
    };
    let one = on(1);
    for threads in 2..=8 {
        assert_eq!(on(threads), one);
    }
}

#[test]
fn partial_totals_merge_into_the_whole() {
    let law = zmc(Zmc::ONSET);
    let (heights, radii): (Vec<f64>, Vec<f64>) =
        (0..1000).map(|i| (f64::from(i) * 1e-10, 1e-6 + f64::from(i % 7) * 1e-7)).unzip();
    let set = |range: std::ops::Range<usize>| {
        AsperitySet::new(heights[range.clone()].to_vec(), radii[range].to_vec(), 1.0).unwrap()
    };
    let total = |set: &AsperitySet| Deterministic::new(&*law, set.spheres(), plane(CASE_1)).total(2e-8);
    let mut parts = total(&set(0..400));
    parts.merge(&total(&set(400..1000)));
    let whole = total(&set(0..1000));
    assert_eq!(parts.contacts(), whole.contacts());
    assert!(relative_error(parts.load().total(), whole.load().total()) < 4e-16);
    assert!(relative_error(parts.load_error(1000), whole.load_error(1000)) < 1e-14);
}

#[test]
fn exponential_moments_are_gamma_functions() {
    let body = Material::new(2.0, 0.0, None, None).unwrap();
    let hertz = bare_contact("hertz", &[], &body);
    let unit = Population { radius: 1.0, sigma: 1.0, density: 1.0, heights: Heights::EXPONENTIAL };
    for h in [-1.0, 0.0, 3.0, 100.0] {
        let found = Statistical::new(&*hertz, unit.clone()).respond(h);
        let tail = (-(h + 1.0f64)).exp();
        let pi = std::f64::consts::PI;
        assert!(relative_error(found.contact_density, tail) < 1e-14);
        assert!(relative_error(found.area_ratio.total(), pi * tail) < 1e-14);
        assert!(relative_error(found.pressure.total(), 4.0 / 3.0 * 0.75 * pi.sqrt() * tail) < 1e-14);
    }
    // Everything in contact: the mean indentation is the mean height above the flat.
    let deep = Statistical::new(&*hertz, unit.clone()).respond(-6.0);
    assert!(relative_error(deep.area_ratio.total(), 6.0 * std::f64::consts::PI) < 1e-14);
    assert!(relative_error(deep.contact_density, 1.0) < 1e-14);
}

#[test]
fn moments_of_gaussian_heights() {
    let mut worst = Worst::default();
    // Parabolic cylinder functions at 40 digits (mpmath), beside those of `reference`.
    for [n, h, exact] in MOMENTS {
        worst.see(gaussian_moment(n, h), exact, || format!("n = {n}, h = {h}"));
    }
    worst.assert_within(1e-13, 24);
    // n F_(n-1) = F_(n+1) + h F_n.
    for h in [-20.0, 0.5, 9.0, 30.0] {
        let [below, at, above] = [1.3, 2.3, 3.3].map(|n| gaussian_moment(n, h));
        assert!(relative_error(above + h * at, 2.3 * below) < 1e-11, "{h}");
    }
    for (n, h) in [(-1.0, 0.0), (f64::NAN, 0.0), (f64::INFINITY, 0.0), (1.0, f64::NAN), (1.0, -1e4)] {
        assert!(gaussian_moment(n, h).is_nan(), "{n} {h}");
    }
}

/// n, h and F_n(h).
const MOMENTS: [[f64; 3]; 24] = [
    [-0.9, -10.0, 0.12700093334909648],
    [-0.9, -3.3, 0.39511564269977373],
    [-0.9, 0.0, 4.020679210982993],
    [-0.9, 3.5, 0.007295301212721271],
    [-0.9, 6.0, 4.8250123144576376e-08],
    [-0.9, 12.5, 3.468582269308568e-34],
    [-0.9, 25.0, 5.27707204654109e-136],
    [-0.9, 37.0, 1.4055305090374155e-297],
    [3.7, -10.0, 5262.960618766208],
    [3.7, -3.3, 121.9551937883106],
    [3.7, 0.0, 1.223448922080574],
    [3.7, 3.5, 1.7102839185258684e-05],
    [3.7, 6.0, 1.4954842663172382e-11],
    [3.7, 12.5, 4.663724222858136e-39],
    [3.7, 25.0, 3.109961595225958e-142],
    [3.7, 37.0, 1.380271389224484e-304],
    [5.0, -10.0, 110150.0],
    [5.0, -3.3, 800.2239750340308],
    [5.0, 0.0, 3.1915382432114616],
    [5.0, 3.5, 1.7777223929408673e-05],
    [5.0, 6.0, 9.550364347214163e-12],
    [5.0, 12.5, 1.2989547923340495e-39],
    [5.0, 25.0, 3.639191249749515e-143],
    [5.0, 37.0, 9.765226541291827e-306],
];

#[test]
fn a_pressure_out_of_reach_says_what_can_be_reached() {
    let law = zmc(Zmc::ONSET);
    let model = Statistical::new(&*law, CASE_1);
    let error = at_pressure(&model, 1e15).unwrap_err();
    assert_eq!(error.largest, model.respond(-10.0).pressure.total());
    assert!(error.to_string().contains("-10 sigma"), "{error}");
    assert!(at_pressure(&model, error.largest).is_ok());
}

#[test]
fn nothing_is_nan_where_nothing_touches() {
    let law = zmc(Zmc::ONSET);
    let set = drawn(CASE_1, 1000);
    let models: [&dyn Model; 2] =
        [&Statistical::new(&*law, CASE_1), &Deterministic::new(&*law, set.spheres(), plane(CASE_1))];
    for model in models {
        let response = model.respond(1000.0);
        assert_eq!(response.pressure.total(), 0.0);
        assert_eq!(response.area_ratio.total(), 0.0);
        assert_eq!((response.mean_real_pressure(), response.pressure.shares()), (None, None));
    }
}

/// Contacts are exactly the asperities above the flat; one at its height is not in contact.
#[test]
fn asperities_at_or_below_the_flat_do_not_touch() {
    let law = zmc(Zmc::ONSET);
    let set = AsperitySet::new(vec![3.0, -1.0, 2.0, 1.0, 2.0], vec![1.0; 5], 1.0).unwrap();
    let model = Deterministic::new(&*law, set.spheres(), ReferencePlane { mean: 0.0, sigma: 1.0 });
    assert_eq!(model.total(2.0).contacts(), 1.0);
    assert_eq!(model.total(2f64.next_down()).contacts(), 3.0);
    assert_eq!(model.total(3.0).contacts(), 0.0);
}

/// Two contacts of loads P and 2P among three asperities: P^2 + 4P^2 - 9P^2/3 = 2P^2. Equal loads have no scatter.
#[test]
fn the_sampling_error_of_a_few_asperities() {
    let law = bare_contact("hertz", &[], &steel());
    let error = |radii: Vec<f64>, heights: Vec<f64>| {
        let set = AsperitySet::new(heights, radii, 2.0).unwrap();
        let found =
            Deterministic::new(&*law, set.spheres(), ReferencePlane { mean: 0.0, sigma: 1e-9 }).respond(0.0);
        let sampling = found.sampling.unwrap();
        (sampling.pressure / found.pressure.total(), sampling.area_ratio / found.area_ratio.total())
    };
    let (load, _) = error(vec![1e-6, 4e-6, 1e-6], vec![1e-9, 1e-9, -1e-9]);
    assert!((load - 2f64.sqrt() / 3.0).abs() < 1e-15);
    let (_, area) = error(vec![1e-6, 2e-6, 1e-6], vec![1e-9, 1e-9, -1e-9]);
    assert!((area - 2f64.sqrt() / 3.0).abs() < 1e-15);
    let (load, area) = error(vec![1e-6; 5000], vec![1e-9; 5000]);
    assert!(load < 1e-9 && area < 1e-9);
}

#[test]
fn the_sampling_error_is_the_scatter_of_independent_sets() {
    let law = zmc(Zmc::ONSET);
    let answers: Vec<_> = (0..400u16)
        .map(|k| {
            let mut seed = [0; 32];
            seed[..2].copy_from_slice(&k.to_le_bytes());
            let set = CASE_1.set(2000, Draw::Random(seed)).unwrap();
            Deterministic::new(&*law, set.spheres(), plane(CASE_1)).respond(1.0)
        })
        .collect();
    let mean = answers.iter().map(|r| r.pressure.total()).sum::<f64>() / 400.0;
    let scatter = (answers.iter().map(|r| (r.pressure.total() - mean).powi(2)).sum::<f64>() / 399.0).sqrt();
    let claimed = answers.iter().map(|r| r.sampling.unwrap().pressure).sum::<f64>() / 400.0;
    // A standard deviation from 400 draws has an error of 3.5 %.
    assert!((scatter / claimed - 1.0).abs() < 0.15, "{scatter:e} {claimed:e}");
}

#[test]
fn deep_below_the_mean_a_wide_transition_is_resolved_too() {
    for ratio in [2.0, 54.0, 110.0, 1e4, 1e10] {
        let law = bare_contact("zmc", &[("transition-ratio", ratio)], &steel());
        for h in [-10.0, -8.0, -5.0, -3.0, -1.0] {
            for radius in [1.6e-6, 1e-4, 1e-2] {
                let population = Population { radius, ..CASE_2 };
                let found = Statistical::new(&*law, population.clone()).respond(h).pressure.total();
                let shape = Shape::sphere(radius);
                let [_, exact, _] = dense(&*law, shape, &law.regime_changes(shape), &population, h);
                let error = relative_error(found, exact);
                assert!(error < 3e-14, "c = {ratio}, h = {h}, R = {radius}: {error:e}");
            }
        }
    }
}

#[test]
fn breakpoints_next_to_nothing_cost_nothing() {
    let soft = Material::new(1e30, 0.3, Some(1e-30), None).unwrap();
    let law = bare_contact("zmc", &[], &soft);
    let population = Population { radius: 1e-30, sigma: 1e30, ..CASE_1 };
    let found = Statistical::new(&*law, population.clone()).respond(1.0);
    assert!(found.area_ratio.0[2] > 0.0 && found.area_ratio.total().is_finite());
}

/// A law whose load drops strongly: the pressure has a maximum below the mean height.
#[test]
fn a_peak_within_a_step_of_the_search_is_found() {
    let law = zmc(100.0);
    let sigma = law.breakpoints(Shape::sphere(2e-5))[0] / 2.0;
    let model = Statistical::new(&*law, Population { sigma, ..CASE_1 });
    let pressure = |h: f64| model.respond(h).pressure.total();
    let peak = (0..4000).map(|k| pressure(-1e-3 * f64::from(k))).take_while(|&p| p > 0.0);
    let (mut highest, mut at) = (0.0, 0.0);
    for (k, p) in peak.enumerate() {
        if p > highest {
            (highest, at) = (p, -1e-3 * k as f64);
        }
    }
    assert!(at < -0.1 && pressure(at - 0.5) < highest, "no peak to be found at {at}");
    let h = model.separation_at(0.99999 * highest).unwrap();
    assert!((h - at).abs() < 0.05, "{h} for a peak at {at}");
}

/// Near or far, out of order, or beyond the heights: where a search begins does not matter.
#[test]
fn searches_that_begin_elsewhere_find_the_same() {
    let set = CASE_1.set(5000, Draw::Random([3; 32])).unwrap();
    let plane = ReferencePlane::from(&Statistics::new(&set));
    for law in [zmc(Zmc::ONSET), bare_contact("ceb", &[], &steel())] {
        let sum = || Deterministic::new(&*law, set.spheres(), plane);
        let pressures: Vec<f64> = (0..40).map(|k| 1e3 * 1.5f64.powi(k)).collect();
        let known = sum().separations_at(&pressures);
        assert!(known.iter().flatten().count() > 20);
        let near: Vec<f64> = known.iter().flatten().map(|h| h + 1e-3).collect();
        for near in [near, vec![0.0, 2.5, 0.3], vec![100.0, -100.0, f64::NAN], vec![3.0]] {
            let found = sum().searched_near(&near).separations_at(&pressures);
            for (a, b) in found.iter().zip(&known) {
                assert_eq!(a.is_some(), b.is_some());
                let apart = a.zip(*b).map_or(0.0, |(a, b)| (a - b).abs());
                assert!(apart < 1e-12, "{a:?} for {b:?} from {near:?}");
            }
        }
    }
}

/// Rounding of a separation far from zero is no jump.
#[test]
fn an_offset_of_the_heights_makes_no_jumps() {
    let law = bare_contact("hertz", &[], &steel());
    let drawn = CASE_1.set(5000, Draw::Random([9; 32])).unwrap();
    let shifted = drawn.heights().iter().map(|z| z + 1e-3).collect();
    let set = AsperitySet::new(shifted, drawn.radii().to_vec(), drawn.nominal_area()).unwrap();
    let plane = ReferencePlane::from(&Statistics::new(&set));
    let model = Deterministic::new(&*law, set.spheres(), plane);
    for pressure in [1e-2, 1.0, 1e3, 1e6] {
        assert!(!at_pressure(&model, pressure).unwrap().in_jump, "{pressure}");
    }
}

/// A population whose sigma is the surface's: both models report separations from the mean plane.
#[test]
fn surface_heights_are_quoted_alike_by_both_models() {
    let surface = SurfaceHeights { radius: CASE_2.radius, sigma: CASE_2.sigma, density: CASE_2.density };
    let population = Population { sigma: surface.asperity_sigma().unwrap(), ..CASE_2 };
    let plane = ReferencePlane { mean: -surface.mean_asperity_height(), sigma: CASE_2.sigma };
    let law = zmc(Zmc::ONSET);
    let set = population.set(200_000, Draw::Quantiles).unwrap();
    let statistical = Statistical::new(&*law, population.clone()).reported_from(plane);
    let deterministic = Deterministic::new(&*law, set.spheres(), plane);
    for h in [0.0, 1.0, 2.0] {
        let (s, d) = (statistical.respond(h), deterministic.respond(h));
        assert!(relative_error(s.pressure.total(), d.pressure.total()) < 2e-4, "h = {h}");
        assert_eq!((s.separation, d.separation), (h * CASE_2.sigma, h * CASE_2.sigma));
        // From the mean asperity height the flat is nearer by that height.
        let own = (h * CASE_2.sigma - surface.mean_asperity_height()) / population.sigma;
        let same = Statistical::new(&*law, population.clone()).respond(own).pressure.total();
        assert!(relative_error(s.pressure.total(), same) < 1e-13);
        let reached = at_pressure(&statistical, s.pressure.total()).unwrap().response;
        assert!(reached.pressure.total() >= s.pressure.total());
        assert!((reached.separation_over_sigma - h).abs() < 1e-13);
    }
}

/// At a large separation few asperities are touched: the response is that of these only.
#[test]
fn far_separations_are_those_of_the_asperities_that_stand_out() {
    let (law, plane) = (zmc(Zmc::ONSET), plane(CASE_1));
    let set = CASE_1.set(300_000, Draw::Random([4; 32])).unwrap();
    let highest = |z: &f64| *z > 2.5 * plane.sigma;
    let heights: Vec<f64> = set.heights().iter().copied().filter(highest).collect();
    let radii = vec![CASE_1.radius; heights.len()];
    let few = AsperitySet::new(heights, radii, set.nominal_area()).unwrap();
    let [all, few] = [&set, &few].map(|set| Deterministic::new(&*law, set.spheres(), plane));
    let far: Vec<f64> = (0..40).map(|k| 2.6 + 0.05 * f64::from(k)).collect();
    for (found, expected) in all.respond_all(&far).iter().zip(&few.respond_all(&far)) {
        assert_eq!(found.contact_density, expected.contact_density);
        for part in [|response: &Response| response.pressure, |response: &Response| response.area_ratio] {
            let [found, expected] = [found, expected].map(|response| part(response).total());
            assert!((found - expected).abs() <= 1e-14 * expected, "{found} {expected}");
        }
        // Those that touch nothing count.
        let touching = set.heights().iter().map(|z| z - found.separation).filter(|w| *w > 0.0);
        let loads: Vec<f64> = touching.map(|w| law.contact(w, Shape::sphere(CASE_1.radius)).load).collect();
        let [sum, squares] = [1, 2].map(|power| loads.iter().map(|load| load.powi(power)).sum::<f64>());
        let error = (squares - sum * sum / set.count() as f64).sqrt() / set.nominal_area();
        let stated = found.sampling.unwrap().pressure;
        assert!((stated - error).abs() <= 1e-5 * error, "{stated} {error}");
    }
}
