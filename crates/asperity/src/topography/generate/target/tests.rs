use super::*;
use crate::asperity::{AsperitySet, Statistics};
use crate::distribution::Johnson;
use crate::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use crate::topography::roughness::Moments;
use crate::topography::summits::{Detail, find};
use std::f64::consts::PI;

const SEED: [u8; 32] = [5; 32];

fn gaussian_heights() -> TargetGenerator {
    TargetGenerator {
        points: [1024, 768],
        hurst: 0.8,
        cut_off: 8.0,
        lay: Lay::default(),
        heights: Heights::GAUSSIAN,
        neighbours: Neighbours::Four,
    }
}

fn cases() -> [(TargetGenerator, SigmaOf, f64); 6] {
    let worn = Heights::new(Johnson::from_moments(-1.0, 4.5).unwrap());
    let lay = Lay { elongation: 2.0, angle: 0.3 * PI };
    [
        (gaussian_heights(), SigmaOf::Summits, 3.6),
        (gaussian_heights(), SigmaOf::Surface, 2.5),
        (TargetGenerator { heights: worn.clone(), ..gaussian_heights() }, SigmaOf::Summits, 1.75),
        (TargetGenerator { heights: worn, ..gaussian_heights() }, SigmaOf::Surface, 6.0),
        (TargetGenerator { neighbours: Neighbours::Eight, ..gaussian_heights() }, SigmaOf::Summits, 3.6),
        (
            TargetGenerator { lay, points: [768, 960], cut_off: 6.0, ..gaussian_heights() },
            SigmaOf::Summits,
            2.7,
        ),
    ]
}

/// Density, mean radius and sigma of the summits that are found on a map.
fn of_map(map: &HeightMap, neighbours: Neighbours, sigma_of: SigmaOf) -> [f64; 3] {
    let summits = find(map, neighbours, Detail::default());
    let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
    let [dx, dy] = map.pixel();
    let set = AsperitySet::new(summits.heights, radii, dx * dy * summits.tested as f64).unwrap();
    let statistics = Statistics::new(&set);
    let sigma = match sigma_of {
        SigmaOf::Summits => statistics.sigma,
        SigmaOf::Surface => Moments::from_rows(map).sq,
    };
    [set.density(), statistics.mean_radius, sigma]
}

/// The product of a plain generation.
fn product(generator: &TargetGenerator, bandwidth: f64, sigma_of: SigmaOf, seed: [u8; 32]) -> f64 {
    let process = Process {
        spectrum: generator.spectrum(bandwidth).unwrap(),
        of: SpectrumOf::Gaussian,
        sigma: 1.0,
        heights: generator.heights.clone(),
    };
    let plain = SurfaceGenerator { points: generator.points, pixel: [1.0; 2], process, plateau: None };
    let (map, _) = plain.surface(Seeds { process: seed, plateau: seed }).unwrap();
    of_map(&map, generator.neighbours, sigma_of).iter().product()
}

/// What points alone say of any weight is what is found on its map; at the ends the map is that of a plain generation.
#[test]
fn summits_of_a_weight_are_those_of_its_map() {
    for (generator, sigma_of, bandwidth) in cases() {
        let origin = bandwidth.ln();
        for t in [0.0, 0.31, 0.5, 0.84, 1.0] {
            let ends = [origin - 0.05, origin + 0.05]
                .map(|log| generator.field(log, SEED, sigma_of, &Silent).unwrap());
            let mixtures = Mixtures::new(&generator, sigma_of, ends, &Silent).unwrap();
            let found = mixtures.summits(t);
            let log = mixtures.log_bandwidth(t);
            let (heights, _) = mixtures.into_heights(t, |_| 1.0, &Silent);
            let map = HeightMap::new(generator.points, [1.0; 2], heights, 0.0).unwrap().periodic();
            let [density, radius, sigma] = of_map(&map, generator.neighbours, sigma_of);
            assert_eq!(found.density, density, "{bandwidth} {sigma_of:?} {t}");
            assert!((found.mean_radius / radius - 1.0).abs() < 1e-11, "{bandwidth} {sigma_of:?} {t}");
            // Sq between two maps is interpolated.
            let allowed = if sigma_of == SigmaOf::Surface { 1e-4 } else { 1e-11 };
            let off = found.sigma / sigma - 1.0;
            println!("{bandwidth} {sigma_of:?} {t}: {off:e}");
            assert!(off.abs() < allowed, "{bandwidth} {sigma_of:?} {t}: {off:e}");
            if t == 0.0 || t == 1.0 {
                let plain = product(&generator, log.exp(), sigma_of, SEED);
                assert!((found.product() / plain - 1.0).abs() < 1e-9, "{bandwidth} {sigma_of:?} {t}");
            }
        }
    }
}

/// A weighted sum has a product like those of plain generations of the bandwidths about it.
#[test]
fn products_of_sums_are_those_of_bandwidths_between() {
    for (generator, sigma_of, bandwidth) in cases() {
        let origin = bandwidth.ln();
        let ends =
            [origin - 0.05, origin + 0.05].map(|log| generator.field(log, SEED, sigma_of, &Silent).unwrap());
        let mixtures = Mixtures::new(&generator, sigma_of, ends, &Silent).unwrap();
        for t in [0.25, 0.5, 0.75] {
            let plain = product(&generator, mixtures.log_bandwidth(t).exp(), sigma_of, SEED);
            let off = mixtures.summits(t).product() / plain - 1.0;
            println!("{bandwidth} {sigma_of:?} {t}: {off:e}");
            assert!(off.abs() < 0.02, "{bandwidth} {sigma_of:?} {t}: {off:e}");
        }
    }
}

/// Theory predicts the mean of several maps: it needs to be near, not exact.
#[test]
fn the_expected_bandwidth_is_that_of_maps() {
    for (generator, sigma_of, bandwidth) in cases() {
        let mean = (1..=6).map(|k| product(&generator, bandwidth, sigma_of, [k; 32])).sum::<f64>() / 6.0;
        let target = Target { radius: mean, sigma: 1.0, sigma_of, density: 1.0 };
        let off = generator.expected_bandwidth(&target).unwrap() - bandwidth.ln();
        println!("{bandwidth} {sigma_of:?}: {off}");
        assert!(off.abs() < 0.05, "{bandwidth} {sigma_of:?}: {off}");
    }
}

/// From a start far off, from none (of bandwidths that a scan finds) and from theory.
#[test]
fn targets_are_met_from_any_start() {
    for (generator, sigma_of, bandwidth) in cases() {
        let wanted = product(&generator, 1.03 * bandwidth, sigma_of, SEED);
        let target = Target { radius: wanted, sigma: 1.0, sigma_of, density: 1.0 };
        for first in [None, Some(bandwidth), Some(1.4 * bandwidth), Some(generator.widest())] {
            // A target may lie in a jump of the map of one seed.
            let of = |k: u8| generator.surface(&target, [k; 32], first).ok();
            let reached = (5..9).find_map(of).unwrap();
            println!("{bandwidth} {sigma_of:?} {first:?}: {} {}", reached.bandwidth, reached.tried);
            let [density, radius, sigma] = of_map(&reached.map, generator.neighbours, sigma_of);
            for (found, wanted) in [(density, 1.0), (radius, wanted), (sigma, 1.0)] {
                assert!((found / wanted - 1.0).abs() < TOLERANCE_AT_JUMP, "{found} {wanted}");
            }
            assert!((reached.bandwidth / bandwidth - 1.03).abs() < 0.1, "{}", reached.bandwidth);
        }
        let scanned = {
            let search = Search { generator: &generator, target: &target, progress: &Silent };
            let field = &mut |log: f64| generator.field(log, SEED, sigma_of, &Silent);
            let bracket = search.scan(field).unwrap();
            let bracket = search.narrow(bracket, field).unwrap();
            assert!(bracket.holds() && bracket.mixtures.width() < 1.01 * WIDEST);
            bracket.mixtures.log_bandwidth(0.5).exp()
        };
        assert!((scanned / bandwidth - 1.03).abs() < 0.2, "{scanned}");
    }
}

/// Maps that hold hardly more than four waves, or fewer: what a map of their own has is met on half of them, the rest has an error.
#[test]
fn the_smallest_maps_have_an_answer() {
    let (mut met, mut asked) = (0, 0);
    for points in [[31, 40], [32, 32], [33, 40], [36, 36], [48, 33], [64, 48]] {
        let generator = TargetGenerator { points, ..gaussian_heights() };
        let is_large_enough = generator.check().is_ok();
        let own = [0.3, 0.5, 0.7].map(|part| generator.widest().max(1.0).powf(part));
        let own = own.map(|bandwidth| product(&generator, bandwidth, SigmaOf::Summits, SEED));
        for (product, is_own) in own.map(|product| (product, true)).into_iter().chain([(0.07, false)]) {
            for first in [None, Some(1.0), Some(3.0)] {
                let target = Target { radius: product, sigma: 1.0, sigma_of: SigmaOf::Summits, density: 1.0 };
                let reached = generator.surface(&target, SEED, first);
                if !is_large_enough {
                    assert!(matches!(reached, Err(Unreachable::TooFewPoints { .. })), "{points:?}");
                    continue;
                }
                asked += usize::from(is_own);
                let Ok(reached) = reached else { continue };
                met += usize::from(is_own);
                let [density, radius, _] = of_map(&reached.map, Neighbours::Four, SigmaOf::Summits);
                assert!((density - 1.0).abs() < 1e-9 && (radius / product - 1.0).abs() < 2e-3, "{points:?}");
            }
        }
    }
    assert!(2 * met >= asked && asked > 0, "{met} of {asked}");
}
