//! Properties of a layered flat, beyond those of every law on it (`conformance`).

use crate::common::{Random, contact, dense, lead, relative_error, scan_and_levels, steel};
use asperity::work::{CountedContact, Counter};
use asperity::{
    AsperitySet, Contact, Deterministic, Draw, Flat, Heights, LayeredFlat, Material, Model, ModulusModel,
    Population, ReferencePlane, Regime, Shape, Statistical, Zmc,
};

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
            let flat = Flat::with_layer(&lead(), &steel(), t, ModulusModel::Gao).unwrap();
            let contact = contact("zmc", &[], &steel(), &flat);
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

/// Hard films more than 1 + e^2 times as hard as what is below, under one asperity and under many, at loads next to each peak
/// and anywhere: some hundred bounds of a sum. What a search finds is tested in `conformance`.
#[test]
fn where_the_load_falls_a_search_needs_few_bounds() {
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
        let counter = Counter::default();
        let contact = CountedContact::new(&*contact, &counter);
        let population = Population { radius: 1e-5, sigma, density: 1e10, heights: Heights::GAUSSIAN };
        let count = random.one_of(&[1, 3, 30, 600]);
        let drawn = population.set(count, Draw::Random([k as u8; 32])).unwrap();
        let radii = drawn.radii().iter().map(|b| b * random.log(0.3, 3.0)).collect();
        let set = AsperitySet::new(drawn.heights().to_vec(), radii, drawn.nominal_area()).unwrap();
        let deterministic = Deterministic::new(&contact, set.spheres(), ReferencePlane { mean: 0.0, sigma });
        let statistical = Statistical::new(&contact, population);
        for model in [&statistical as &dyn Model, &deterministic] {
            let (_, levels) = scan_and_levels(|h| model.respond(h).pressure.total(), &mut random);
            peaks += (levels.len() - 3) / 2;
            for level in levels {
                let before = counter.work().single_contacts;
                model.separation_at(level);
                most = most.max((counter.work().single_contacts - before) / count as u64);
            }
        }
    }
    println!("{peaks} peaks, at most {most} bounds");
    assert!(peaks > 10, "{peaks}");
    assert!(most < 1500, "{most} bounds of a sum in one search");
}
