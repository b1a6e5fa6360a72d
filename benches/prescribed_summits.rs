//! Surfaces with prescribed summits over plain generations of the same surfaces, in turn: medians of the ratio of times. The
//! first surface of each case begins where theory expects its bandwidth, the others at that of the one before.

use std::hint::black_box;
use std::time::Instant;

use asperity::Heights;
use asperity::distribution::Johnson;
use asperity::topography::generate::{
    Process, Reached, Seeds, SigmaOf, SpectrumOf, SurfaceGenerator, Target, TargetGenerator,
};
use asperity::topography::spectrum::Lay;
use asperity::topography::summits::Neighbours;

const SURFACES: u8 = 9;

fn main() {
    let worn = Heights::new(Johnson::from_moments(-1.0, 4.5).expect("a distribution"));
    let case_1 = Target { radius: 2e-5, sigma: 4.8e-8, sigma_of: SigmaOf::Summits, density: 6e10 };
    let case_2 = Target { radius: 1.6e-6, sigma: 2.6e-7, sigma_of: SigmaOf::Summits, density: 9e10 };
    let of_surface = Target { sigma_of: SigmaOf::Surface, ..case_1 };
    for points in [512, 1024, 2048, 4096] {
        for (case, target, heights) in [
            ("case 1", case_1, Heights::GAUSSIAN),
            ("case 1, sigma of the surface", of_surface, Heights::GAUSSIAN),
            ("case 2", case_2, worn.clone()),
        ] {
            let generator = TargetGenerator {
                points: [points; 2],
                hurst: 0.8,
                cut_off: 8.0,
                lay: Lay::default(),
                heights,
                neighbours: Neighbours::Four,
            };
            println!("{points} x {points}, {case}: {}", ratios(&generator, &target));
        }
    }
}

/// Medians over some surfaces.
fn ratios(generator: &TargetGenerator, target: &Target) -> String {
    let mut first = None;
    let (mut ratios, mut times, mut maps) = (Vec::new(), Vec::new(), Vec::new());
    for seed in 1..=SURFACES {
        let start = Instant::now();
        let Ok(reached) = generator.surface(target, [seed; 32], first) else { continue };
        let searched = start.elapsed().as_secs_f64();
        first = Some(reached.bandwidth);
        let plain = plain(generator, &reached);
        let start = Instant::now();
        black_box(plain.surface(Seeds { process: [seed; 32], plateau: [seed; 32] }).expect("a surface"));
        let generated = start.elapsed().as_secs_f64();
        ratios.push(searched / generated);
        times.push(1e3 * generated);
        maps.push(reached.tried as f64);
    }
    let [most, failed] = [maps.iter().copied().fold(0.0, f64::max), f64::from(SURFACES) - maps.len() as f64];
    let [ratio, time, maps] = [ratios, times, maps].map(|mut all| {
        all.sort_unstable_by(f64::total_cmp);
        all[all.len() / 2]
    });
    format!("{ratio:.2} plain generations of {time:.1} ms, {maps} fields (at most {most}), {failed} not met")
}

/// The generator of the surface that was reached.
fn plain(generator: &TargetGenerator, reached: &Reached) -> SurfaceGenerator {
    let process = Process {
        spectrum: reached.spectrum,
        of: SpectrumOf::Gaussian,
        sigma: reached.sigma,
        heights: generator.heights.clone(),
    };
    SurfaceGenerator { points: generator.points, pixel: reached.map.pixel(), process, plateau: None }
}
