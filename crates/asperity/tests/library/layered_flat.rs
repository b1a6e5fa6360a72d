//! Properties of a layered flat, beyond those of every law on it (`conformance`).

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::common::{Random, bodies, contact, dense, lead, relative_error, steel};
use asperity::numeric::Interval;
use asperity::{
    AsperitySet, Contact, Deterministic, Draw, Flat, Heights, LayeredFlat, LoadBounds, Material,
    MicroContact, Model, ModulusModel, Paper, Population, ReferencePlane, Regime, Shape, Shapes, Statistical,
    Zmc,
};

fn under_lead(thickness: f64, onset: f64) -> Box<dyn MicroContact> {
    let flat = Flat::with_layer(&lead(), &steel(), thickness, ModulusModel::Gao).unwrap();
    contact("zmc", &[("onset", onset)], &steel(), &flat)
}

/// The regimes of lead on steel that PHYSICS C lists for Table 1, and where its areas fall.
#[test]
fn regimes_of_lead_on_steel_come_again() {
    use Regime::{Elastic as E, ElasticPlastic as M, Plastic as P};
    let (back, twice, once) = (vec![E, M, E, M, P], vec![E, M, P, M, P], vec![E, M, P]);
    let cases = [
        (2e-5, [1e-9, 5e-9, 2e-8].to_vec(), &back, false),
        (2e-5, [5e-8, 1e-7, 2e-7].to_vec(), &twice, true),
        (2e-5, [1e-6].to_vec(), &twice, false),
        (1.6e-6, [1e-9].to_vec(), &back, false),
        (1.6e-6, [5e-9, 1e-8, 2e-8].to_vec(), &twice, true),
        (1.6e-6, [5e-8, 1e-7].to_vec(), &twice, false),
        (1.6e-6, [2e-7, 1e-6].to_vec(), &once, false),
    ];
    for (b, thicknesses, expected, falls) in cases {
        for t in thicknesses {
            let contact = under_lead(t, Zmc::ONSET);
            let changes = contact.regime_changes(Shape::sphere(b));
            let ends = [1e-30].into_iter().chain(changes.iter().copied()).chain([1.0]).collect::<Vec<_>>();
            let regimes: Vec<_> = ends
                .windows(2)
                .map(|w| contact.contact((w[0] * w[1]).sqrt(), Shape::sphere(b)).regime)
                .collect();
            assert_eq!(&regimes, expected, "{t:e} m on {b:e} m");
            let curve: Vec<_> =
                (0..20_000).map(|k| contact.contact(1e-13 * 1.0015f64.powi(k), Shape::sphere(b))).collect();
            let drops = |value: fn(&Contact) -> f64| {
                curve.windows(2).any(|pair| value(&pair[1]) < value(&pair[0]) * (1.0 - 1e-12))
            };
            assert_eq!(drops(|c| c.area), falls, "area under {t:e} m on {b:e} m");
            assert!(!drops(|c| c.load), "load under {t:e} m on {b:e} m");
        }
    }
}

#[test]
fn bounds_hold_what_they_bound() {
    let mut random = Random::new(1);
    for _ in 0..400 {
        let [_, layer, substrate] = bodies(&mut random);
        let (thickness, radius) = (random.log(1e-10, 1e-4), random.log(1e-9, 1e-2));
        let layered =
            LayeredFlat::new(&layer, &substrate, thickness, random.one_of(&ModulusModel::ALL)).unwrap();
        for _ in 0..20 {
            let low = thickness * random.log(1e-12, 1e12);
            let from = random.one_of(&[low, low, low, 0.0]);
            let w = Interval { low: from, high: low * random.log(1.0001, 1e4) };
            let b = Interval { low: radius, high: radius * random.one_of(&[1.0, 1.5]) };
            let bounds = layered.over(w, b);
            for k in 1..=20 {
                let at = w.high * (low / w.high).powf(f64::from(k - 1) / 20.0);
                let felt = layered.at(at, b.low + (b.high - b.low) * f64::from(k % 7) / 6.0);
                let holds = |range: Interval, value: f64, size: f64| {
                    let slack = 1e-12 * size;
                    assert!(value == range.low || (range.low - slack..=range.high + slack).contains(&value));
                };
                holds(bounds.compliance, felt.compliance, felt.compliance);
                holds(bounds.compliance_slope, felt.compliance_slope, felt.compliance);
                holds(bounds.hardness, felt.hardness, felt.hardness);
                holds(bounds.hardness_slope, felt.hardness_slope / felt.hardness, 1.0);
            }
        }
    }
}

/// At this ratio of hardnesses, under equal moduli, ln(w/w1) has a place where it nor rises nor bends: three roots
/// become one. The search must neither take long nor make up roots out of rounding.
#[test]
fn three_roots_that_merge_are_one() {
    const MERGING: f64 = 0.470_749_992_671_771_3;
    let body = |hardness: f64| Material::new(1e11, 0.3, Some(hardness), None).unwrap();
    let rough = Material::new(1e11, 0.3, None, None).unwrap();
    let (w, modulus) = (1.262_129_028_277_342_4e-7, 1e11 / 0.91 / 2.0);
    for (apart, expected) in [(1e-3, 3..=3), (1e-6, 3..=3), (0.0, 1..=7), (-1e-6, 1..=1)] {
        let layered =
            LayeredFlat::new(&body(1e9 * MERGING * (1.0 - apart)), &body(1e9), 1e-7, ModulusModel::Gao)
                .unwrap();
        let b = w * (modulus / layered.at(w, 1e-5).hardness).powi(2) / Zmc::ONSET;
        let contact = contact("zmc", &[], &rough, &Flat::Layered { substrate: body(1e9), layered });
        // Of these one is the end of the elastic-plastic range.
        let found = contact.regime_changes(Shape::sphere(b)).len() - 1;
        assert!(expected.contains(&found), "{found} roots at {apart:e}");
    }
}

/// Where Poisson's ratio counts, the onset of yield may be that of the flat though it is the harder body: the way of its
/// hardness to that of the substrate is resolved then too.
#[test]
fn a_harder_flat_may_yield_first() {
    let body = |young, poisson, hardness| Material::new(young, poisson, Some(hardness), None).unwrap();
    let (rough, substrate) = (body(1e8, 0.499, 1e9), body(4e13, 0.14, 1e9));
    let layered = LayeredFlat::new(&body(2e13, 0.25, 2e11), &substrate, 3e-7, ModulusModel::Gao).unwrap();
    let contact = contact("ceb", &[], &rough, &Flat::Layered { substrate, layered });
    let shape = Shape::sphere(5e-8);
    let population =
        Population { radius: shape.radius, sigma: 2e-3, density: 1e10, heights: Heights::GAUSSIAN };
    let model = Statistical::new(&*contact, population.clone());
    for h in [0.0, 10.0, 20.0] {
        let found = model.respond(h);
        let [area, load, _] = dense(&*contact, shape, &contact.breakpoints(shape), &population, h);
        assert!(relative_error(found.area_ratio.total(), area) < 1e-13, "h = {h}");
        assert!(relative_error(found.pressure.total(), load) < 1e-13, "h = {h}");
    }
}

/// Crossing the onset of yield backwards turns an upward jump of the load into a drop.
#[test]
fn a_jump_that_is_passed_backwards_is_a_fall() {
    let contact = under_lead(1e-9, 0.4);
    let back = contact.regime_changes(Shape::sphere(2e-5))[1];
    let load = |w: f64| contact.contact(w, Shape::sphere(2e-5)).load;
    assert!(load(back * (1.0 + 1e-9)) < 0.7 * load(back * (1.0 - 1e-9)));
    assert!(contact.may_decrease(Shape::sphere(2e-5).into()).iter().any(|range| range.contains(back)));
}

/// Counts the bounds that a search evaluates.
struct Counted<'a>(&'a dyn MicroContact, AtomicUsize);

impl MicroContact for Counted<'_> {
    fn contact(&self, w: f64, shape: Shape) -> Contact {
        self.0.contact(w, shape)
    }
    fn regime_changes(&self, shape: Shape) -> Vec<f64> {
        self.0.regime_changes(shape)
    }
    fn breakpoints(&self, shape: Shape) -> Vec<f64> {
        self.0.breakpoints(shape)
    }
    fn may_decrease(&self, shapes: Shapes) -> Vec<Interval> {
        self.0.may_decrease(shapes)
    }
    fn load_over(&self, from: f64, to: f64, shape: Shape) -> LoadBounds {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.load_over(from, to, shape)
    }
    fn reference_modulus(&self) -> f64 {
        self.0.reference_modulus()
    }
    fn reference_hardness(&self) -> f64 {
        self.0.reference_hardness()
    }
    fn papers(&self) -> Vec<Paper> {
        self.0.papers()
    }
}

/// Hard films more than 1 + e^2 times as hard as what is below, under one asperity and under many: against a scan from
/// above, at loads next to each peak and anywhere. A search of a sum takes some hundred bounds of it.
#[test]
fn where_the_load_falls_the_first_reach_counts() {
    let mut random = Random::new(5);
    let (mut peaks, mut most) = (0, 0);
    for k in 0..36 {
        // With the second of the ratios of Poisson the load of Kogut and Etsion falls as it becomes plastic.
        let poisson = random.one_of(&[0.3, 0.45]);
        let substrate =
            Material::new(random.log(5e10, 4e11), poisson, Some(random.log(1e8, 1e9)), None).unwrap();
        let hardness = substrate.hardness().unwrap() * random.log(9.0, 60.0);
        let layer =
            Material::new(substrate.young() * random.log(0.5, 10.0), 0.25, Some(hardness), None).unwrap();
        let rough = Material::new(1.1e12, 0.1, None, None).unwrap();
        let sigma = random.log(3e-9, 3e-7);
        let layered =
            LayeredFlat::new(&layer, &substrate, sigma * random.log(0.03, 10.0), ModulusModel::Gao).unwrap();
        let onset = random.one_of(&[Zmc::ONSET, Zmc::ONSET, 0.4, 0.89]);
        let flat = Flat::Layered { substrate, layered };
        let contact = match k % 6 {
            4 => contact("ceb", &[], &rough, &flat),
            5 => contact("kogut-etsion", &[], &rough, &flat),
            _ => contact("zmc", &[("onset", onset)], &rough, &flat),
        };
        let contact = Counted(&*contact, AtomicUsize::new(0));
        let population = Population { radius: 1e-5, sigma, density: 1e10, heights: Heights::GAUSSIAN };
        let count = random.one_of(&[1, 3, 30, 600]);
        let drawn = population.set(count, Draw::Random([k as u8; 32])).unwrap();
        let radii = drawn.radii().iter().map(|b| b * random.log(0.3, 3.0)).collect();
        let set = AsperitySet::new(drawn.heights().to_vec(), radii, drawn.nominal_area()).unwrap();
        let deterministic = Deterministic::new(&contact, set.spheres(), ReferencePlane { mean: 0.0, sigma });
        let statistical = Statistical::new(&contact, population);
        for model in [&statistical as &dyn Model, &deterministic] {
            let pressure = |h: f64| model.respond(h).pressure.total();
            let scan: Vec<_> =
                (0..=1400).map(|k| 4.0 - 0.01 * f64::from(k)).map(|h| (h, pressure(h))).collect();
            let is_peak = |w: &[(f64, f64)]| w[1].1 >= w[0].1 && w[1].1 > w[2].1;
            let tops = scan.windows(3).filter(|w| is_peak(w)).map(|w| w[1].1).take(3);
            let mut levels: Vec<f64> = tops.flat_map(|top| [0.999 * top, 1.0005 * top]).collect();
            peaks += levels.len() / 2;
            levels.extend((0..3).map(|_| scan[1400].1 * random.log(1e-3, 1.0)));
            for level in levels {
                contact.1.store(0, Ordering::Relaxed);
                let found = model.separation_at(level);
                most = most.max(contact.1.load(Ordering::Relaxed) / count);
                let first = scan.iter().find(|point| point.1 >= level);
                let Some(h) = found else {
                    assert!(first.is_none(), "{level:e} is reached at {first:?}");
                    continue;
                };
                assert!(first.is_none_or(|point| h >= point.0 - 1e-12), "{level:e}: {h} behind {first:?}");
                assert!(pressure(h) >= level * (1.0 - 1e-12));
                assert!(pressure(h + 1e-12 * h.abs().max(1.0)) < level * (1.0 + 1e-11), "{level:e} at {h}");
            }
        }
    }
    println!("{peaks} peaks, at most {most} bounds");
    assert!(peaks > 10, "{peaks}");
    assert!(most < 1500, "{most} bounds of a sum in one search");
}
