//! Bounds of the error by the grid against the same waves on eight times as many points along each axis.

use asperity::bem::{Boundary, GridError, Options, Solver};
use asperity::progress::Silent;
use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::{HeightMap, Heights};

use super::{bare, paraboloid};

/// Points along a side of the finest grid.
const FINEST: usize = 512;

/// A surface of unit side whose waves reach from a quarter of it to 16 points of the finest grid, elongated along x.
fn surface(elongation: f64, seed: u8) -> HeightMap {
    let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 0.25, cut_off: 16.1 / FINEST as f64 };
    let lay = Lay { elongation, angle: 0.0 };
    let process = Process {
        spectrum: Spectrum::new(shape, lay).unwrap(),
        of: SpectrumOf::Heights,
        sigma: 3e-3,
        heights: Heights::GAUSSIAN,
    };
    let pixel = [(FINEST as f64).recip(); 2];
    let generator = SurfaceGenerator { points: [FINEST; 2], pixel, process, plateau: None };
    generator.surface(Seeds { process: [seed; 32], plateau: [0; 32] }).unwrap().0
}

/// Every `steps`th point along x and y: the waves are the same.
fn coarser(map: &HeightMap, steps: [usize; 2]) -> HeightMap {
    let [nx, ny] = map.points();
    let row = |i: usize| map.heights()[i * ny..][..ny].iter().step_by(steps[1]).copied();
    let heights = (0..nx).step_by(steps[0]).flat_map(row).collect();
    let pixel = [0, 1].map(|axis| map.pixel()[axis] * steps[axis] as f64);
    HeightMap::new([nx / steps[0], ny / steps[1]], pixel, heights, 0.0).unwrap()
}

/// Logarithms of area and stiffness, and the mean gap over load by stiffness, at each load; with the bounds.
fn solved(map: &HeightMap, cap: Option<f64>, loads: &[f64]) -> Vec<([f64; 3], GridError)> {
    let pair = bare();
    let solver =
        Solver::new(map, &pair, &Options { boundary: Boundary::Periodic, error: 1e-6, cap }).unwrap();
    let at = |&load: &f64| {
        let contact = solver.at_pressure(load, &Silent).unwrap();
        let stiffness = solver.tangent(&contact, &Silent).unwrap().stiffness();
        let values = [contact.area_ratio().ln(), contact.mean_gap() * stiffness / load, stiffness.ln()];
        (values, GridError::new(&contact))
    };
    loads.iter().map(at).collect()
}

#[test]
fn few_errors_exceed_their_bounds() {
    let mut exceeded = [0; 3];
    let (mut all, mut near) = (0, 0);
    for (elongation, cap) in [(1.0, None), (3.0, None), (1.0, Some(0.1))] {
        for seed in 0..3 {
            let map = surface(elongation, seed);
            let loads = [0.001, 0.004];
            let exact = solved(&map, cap, &loads);
            // 2 and 4 points per shortest wave, square and elongated.
            for steps in [[8, 8], [4, 4], [2, 8], [8, 2]] {
                let found = solved(&coarser(&map, steps), cap, &loads);
                for ((found, bound), (exact, _)) in found.iter().zip(&exact) {
                    // The gaps over the same load and stiffness.
                    let of_gap = found[1] - exact[1] * (found[2] - exact[2]).exp();
                    let errors = [found[0] - exact[0], of_gap, found[2] - exact[2]];
                    let bounds = [bound.area, bound.load, bound.stiffness];
                    for (count, (error, bound)) in exceeded.iter_mut().zip(errors.iter().zip(bounds)) {
                        *count += usize::from(error.abs() > bound);
                    }
                    near += usize::from(errors[0].abs() > bound.area / 3.0);
                    all += 1;
                }
            }
        }
    }
    assert_eq!(all, 72);
    assert!(exceeded.iter().all(|count| 20 * count <= all), "{exceeded:?} of {all}");
    // The bounds are no wider than they need to be.
    assert!(5 * near > all, "{near} of {all}");
}

/// The narrower the contact in points and the fewer there are, the larger the bounds; full contact has no border.
#[test]
fn bounds_grow_with_the_pixel_and_vanish_without_a_border() {
    let pair = bare();
    let of = |pixels: usize| {
        let (map, _) = paraboloid(3 * pixels, 0.1 / pixels as f64);
        let options = Options { boundary: Boundary::Finite, error: 1e-8, cap: None };
        let solver = Solver::new(&map, &pair, &options).unwrap();
        GridError::new(&solver.at_pressure(4.0 / 3.0 * 1e-3 / 0.09, &Silent).unwrap())
    };
    let all = [4, 8, 16, 32].map(of);
    for pair in all.windows(2) {
        assert!(pair[1].area < pair[0].area && pair[1].load < pair[0].load);
        assert!(pair[1].stiffness < pair[0].stiffness);
    }
    let map = coarser(&surface(1.0, 0), [4, 4]);
    let solver =
        Solver::new(&map, &pair, &Options { boundary: Boundary::Periodic, error: 1e-8, cap: None }).unwrap();
    let full = GridError::new(&solver.at_pressure(50.0, &Silent).unwrap());
    assert_eq!(full, GridError { area: 0.0, load: 0.0, stiffness: 0.0 });
}
