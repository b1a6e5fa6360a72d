//! What must hold for any map.

use std::f64::consts::{PI, TAU};
use std::sync::atomic::{AtomicUsize, Ordering};

use asperity::analytical::mean_deflection;
use asperity::bem::{Boundary, ElasticPair, Options, Solver, SolverError, refined};
use asperity::progress::{Progress, Silent};
use asperity::{HeightMap, Material};
use rayon::ThreadPoolBuilder;

use super::{bare, options, rough, solved, unit_body};

#[test]
fn a_mirrored_map_is_a_quarter_of_a_periodic_one() {
    for points in [[24, 30], [25, 18]] {
        let [nx, ny] = points;
        let map = rough(points, 0.5, 0.3, 0.1, 7);
        let folded = |k: usize, n: usize| if k < n { k } else { 2 * n - 1 - k };
        let point = |k: usize| folded(k / (2 * ny), nx) * ny + folded(k % (2 * ny), ny);
        let heights = (0..4 * nx * ny).map(|k| map.heights()[point(k)]).collect();
        let whole = HeightMap::new([2 * nx, 2 * ny], map.pixel(), heights, 0.0).unwrap();
        let pair = bare();
        let quarter = Solver::new(&map, &pair, &options(Boundary::Mirrored, 1e-11, None)).unwrap();
        let whole = Solver::new(&whole, &pair, &options(Boundary::Periodic, 1e-11, None)).unwrap();
        for load in [1e-3, 0.05, 0.5] {
            let [a, b] = [&quarter, &whole].map(|solver| solver.at_pressure(load, &Silent).unwrap());
            let most = a.pressures().iter().fold(0.0f64, |most, &p| most.max(p));
            let apart = |k: usize| (b.pressures()[k] - a.pressures()[point(k)]).abs();
            assert!((0..4 * nx * ny).all(|k| apart(k) < 1e-7 * most), "{points:?} at {load}");
            assert!((a.mean_gap() / b.mean_gap() - 1.0).abs() < 1e-7);
            assert_eq!(4 * a.border(), b.border(), "no border of contact lies on the mirror");
            assert!((a.area_ratio() - b.area_ratio()).abs() < 1e-12);
        }
    }
}

/// In full contact pressures are linear in the heights: those of each wave are its height over the compliance.
#[test]
fn full_contact_of_waves_with_and_without_a_layer() {
    let body = unit_body();
    let soft = Material::new(0.3, 0.45, None, None).unwrap();
    let points = [48, 40];
    let pixel = [0.02, 0.03];
    let length = [0.96, 1.2];
    for layer in [None, Some((&soft, 0.05)), Some((&soft, f64::INFINITY)), Some((&soft, 0.0))] {
        let pair = ElasticPair::new(&body, &body, layer);
        let q = [TAU * 3.0 / length[0], TAU * 2.0 / length[1]];
        let wave = |k: usize| {
            let (x, y) = ((k / points[1]) as f64 * pixel[0], (k % points[1]) as f64 * pixel[1]);
            (q[0] * x).cos() * (q[1] * y).cos()
        };
        let heights = (0..points[0] * points[1]).map(|k| 0.01 * wave(k)).collect();
        let map = HeightMap::new(points, pixel, heights, 0.0).unwrap();
        let solver = Solver::new(&map, &pair, &options(Boundary::Periodic, 1e-12, None)).unwrap();
        let amplitude = 0.01 / pair.compliance(q[0].hypot(q[1]));
        let contact = solver.at_pressure(2.0 * amplitude, &Silent).unwrap();
        for (k, p) in contact.pressures().iter().enumerate() {
            assert!((p / amplitude - 2.0 - wave(k)).abs() < 1e-5, "{layer:?}");
        }
        assert_eq!((contact.raw_area_ratio(), contact.area_ratio(), contact.mean_gap()), (1.0, 1.0, 0.0));
    }
}

/// Crests that lie next to the flat but do not touch it: rounding of the load presses none of them.
#[test]
fn light_loads_rest_on_the_highest_crest() {
    let count = 128;
    let height = |k: usize| 0.02 * (TAU * 3.0 * (k / count) as f64 / count as f64).cos();
    let heights = (0..count * count).map(height).collect();
    let map = HeightMap::new([count; 2], [(count as f64).recip(); 2], heights, 0.0).unwrap();
    for error in [1e-8, 1e-12] {
        // The last is borne by the crests of all three waves, of which a point of the grid lies on one only.
        for (load, crests) in [(1.3e-8, 1.0), (1.3e-7, 1.0), (1.3e-6, 1.0), (1.3e-5, 3.0)] {
            let contact = solved(&map, options(Boundary::Periodic, error, None), load);
            assert_eq!(contact.raw_area_ratio(), crests / count as f64, "{load} to {error}");
        }
    }
}

/// A layer of nothing, of everything, and of the substrate's own material.
#[test]
fn compliance_of_layers() {
    let body = unit_body();
    let soft = Material::new(0.3, 0.45, None, None).unwrap();
    let pair = |layer| ElasticPair::new(&body, &body, layer);
    for q in [1e-3, 1.0, 1e3] {
        let bare = 2.0 / q;
        assert!((pair(None).compliance(q) / bare - 1.0).abs() < 1e-15);
        assert_eq!(pair(Some((&soft, 0.0))).compliance(q), pair(None).compliance(q));
        assert!((pair(Some((&body, 0.7))).compliance(q) / bare - 1.0).abs() < 1e-14);
        let thick = pair(Some((&soft, f64::INFINITY))).compliance(q);
        let exact = 2.0 / q * (0.5 + (1.0 - 0.45 * 0.45) / 0.3);
        assert!((thick / exact - 1.0).abs() < 1e-14);
        let between = pair(Some((&soft, 1.0))).compliance(q);
        assert!(q != 1.0 || (between > 1.1 * bare && between < thick / 1.1), "{bare} {between} {thick}");
    }
    assert_eq!(pair(Some((&soft, 1.0))).reduced_modulus(), 1.0);
}

#[test]
fn the_same_bits_on_any_number_of_threads() {
    let map = rough([128, 100], 0.8, 0.5, 0.05, 1);
    let pair = bare();
    for (boundary, cap) in
        [(Boundary::Periodic, None), (Boundary::Mirrored, Some(0.2)), (Boundary::Finite, None)]
    {
        let options = options(boundary, 1e-8, cap);
        let on = |threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let solver = Solver::new(&map, &pair, &options).unwrap();
                let contact = solver.at_pressure(0.03, &Silent).unwrap();
                let tangent = solver.tangent(&contact, &Silent).unwrap();
                let bits = [contact.pressures(), tangent.pressures()]
                    .map(|all| all.iter().map(|p| p.to_bits()).collect::<Vec<_>>());
                let numbers = [contact.mean_gap(), tangent.stiffness()].map(f64::to_bits);
                (bits, numbers, contact.steps, tangent.steps)
            })
        };
        let alone = on(1);
        assert!([2, 3, 7].into_iter().all(|threads| on(threads) == alone), "{boundary:?}");
    }
}

/// Signs of progress.
#[derive(Default)]
struct Signs(AtomicUsize);

impl Progress for Signs {
    fn advance(&self, _: f64) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }
}

/// Not less often than for eight rows or columns of a convolution, so that no map is too large.
#[test]
fn each_convolution_shows_that_it_goes_on() {
    const SIDE: usize = 256;
    let map = rough([SIDE; 2], 0.8, 0.5, 0.08, 5);
    for boundary in [Boundary::Periodic, Boundary::Mirrored, Boundary::Finite] {
        let solver = Solver::new(&map, &bare(), &options(boundary, 1e-8, None)).unwrap();
        let signs = |task: &dyn Fn(&Signs)| {
            let signs = Signs::default();
            task(&signs);
            signs.0.into_inner()
        };
        let contact = solver.at_pressure(0.03, &Silent).unwrap();
        let tangent = solver.tangent(&contact, &Silent).unwrap();
        let of_load = signs(&|signs| drop(solver.at_pressure(0.03, signs).unwrap()));
        let of_tangent = signs(&|signs| drop(solver.tangent(&contact, signs).unwrap()));
        // Rows there and back, and half as many columns.
        let each = 5 * SIDE / 16;
        assert!(of_load >= contact.convolutions * each, "{boundary:?}: {of_load}");
        assert!(of_tangent >= tangent.steps * each, "{boundary:?}: {of_tangent}");
    }
}

#[test]
fn missing_points_are_interpolated_up_to_a_hundredth() {
    let map = rough([80, 80], 0.8, 0.9, 0.2, 2);
    let with = |missing: &[usize]| {
        let mut heights = map.heights().to_vec();
        missing.iter().for_each(|&k| heights[k] = f64::NAN);
        HeightMap::new(map.points(), map.pixel(), heights, 0.0).unwrap()
    };
    let options = options(Boundary::Mirrored, 1e-9, None);
    let whole = solved(&map, options, 0.05);
    // A gap of 3 x 3, a corner, single ones.
    let few = [0, 1, 80, 2000, 2001, 2002, 2080, 2081, 2082, 2160, 2161, 2162, 5000, 6399];
    let map = with(&few);
    let solver = Solver::new(&map, &bare(), &options).unwrap();
    assert_eq!(solver.interpolated(), few.len());
    let found = solver.at_pressure(0.05, &Silent).unwrap();
    assert!((found.area_ratio() / whole.area_ratio() - 1.0).abs() < 0.02);
    let many: Vec<usize> = (0..65).map(|k| 97 * k).collect();
    let refused = Solver::new(&with(&many), &bare(), &options).err();
    assert_eq!(refused, Some(SolverError::Missing { missing: 65, points: 6400 }));
}

/// Waves of a refined map are those of the map, at its own points and between them.
#[test]
fn refined_maps_have_the_same_waves() {
    for points in [[12, 10], [9, 14]] {
        let pixel = [0.1, 0.2];
        let field = |boundary: Boundary, factor: f64| {
            let (turn, at) = match boundary {
                Boundary::Periodic => (TAU, 0.0),
                _ => (PI, 0.5),
            };
            move |k: usize, ny: usize| {
                let angle = |i: usize, count: usize| turn * (i as f64 + at) / (factor * count as f64);
                let (x, y) = (angle(k / ny, points[0]), angle(k % ny, points[1]));
                1.0 + (3.0 * x).cos() * y.cos() - 0.4 * (2.0 * x).cos() * (5.0 * y).cos()
            }
        };
        for boundary in Boundary::ALL {
            let heights = (0..points[0] * points[1]).map(|k| field(boundary, 1.0)(k, points[1])).collect();
            let map = HeightMap::new(points, pixel, heights, 0.0).unwrap();
            for factor in [1, 2, 3] {
                let fine = refined(&map, boundary, factor);
                assert_eq!(fine.points(), points.map(|count| factor * count));
                assert_eq!(fine.pixel(), pixel.map(|side| side / factor as f64));
                for (k, z) in fine.heights().iter().enumerate() {
                    let exact = field(boundary, factor as f64)(k, factor * points[1]);
                    assert!((z - exact).abs() < 1e-13, "{boundary:?} {points:?} x {factor}: {z} for {exact}");
                }
            }
        }
    }
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let map = rough([20, 20], 0.8, 0.5, 0.2, 2);
    let refused = |map: &HeightMap, pair: &ElasticPair, options| Solver::new(map, pair, &options).err();
    let periodic = options(Boundary::Periodic, 1e-8, None);
    let flat = HeightMap::new([5, 5], [1.0; 2], vec![3.0; 25], 0.0).unwrap();
    assert_eq!(refused(&flat, &bare(), periodic), Some(SolverError::Flat));
    assert_eq!(refused(&map, &bare(), Options { error: 1e-14, ..periodic }), Some(SolverError::Error(1e-14)));
    assert_eq!(refused(&map, &bare(), Options { cap: Some(-1.0), ..periodic }), Some(SolverError::Cap(-1.0)));
    let layered = ElasticPair::new(&unit_body(), &unit_body(), Some((&unit_body(), 1.0)));
    assert_eq!(
        refused(&map, &layered, Options { cap: Some(1.0), ..periodic }),
        Some(SolverError::CapUnderLayer)
    );
    let pair = bare();
    let solver = Solver::new(&map, &pair, &Options { cap: Some(0.5), ..periodic }).unwrap();
    for pressure in [0.0, -1.0, f64::NAN, 0.5, 1.0] {
        assert!(matches!(solver.at_pressure(pressure, &Silent), Err(SolverError::Pressure { .. })));
    }
    for cap in [None, Some(0.5)] {
        let solver = Solver::new(&map, &pair, &Options { cap, ..periodic }).unwrap();
        let found = solver.at_pressure(1e-30, &Silent).err();
        assert_eq!(found, Some(SolverError::TooLight(1e-30)), "{cap:?}");
    }
}

/// The border of a disc of radius r has 8 r sides of pixels, and the correction is that of a straight border on average.
#[test]
fn the_area_of_a_sphere_is_corrected_for_its_border() {
    let points = [64, 64];
    let mut errors = [0.0; 2];
    let count = 24;
    for shift in 0..count {
        let centre = [31.0 + 0.37 * f64::from(shift), 31.0 + 0.61 * f64::from(shift)].map(|c| c % 2.0 + 31.0);
        let height = |k: usize| {
            let (x, y) = ((k / 64) as f64 - centre[0], (k % 64) as f64 - centre[1]);
            -0.5 * (x * x + y * y) / 1000.0
        };
        let map = HeightMap::new(points, [1.0; 2], (0..64 * 64).map(height).collect(), 0.0).unwrap();
        let a: f64 = 12.0;
        let load = 4.0 / 3.0 * a.powi(3) / 1000.0 / 4096.0;
        let contact = solved(&map, options(Boundary::Finite, 1e-8, None), load);
        let exact = PI * a * a / 4096.0;
        errors[0] += (contact.raw_area_ratio() / exact - 1.0) / f64::from(count);
        errors[1] += (contact.area_ratio() / exact - 1.0) / f64::from(count);
    }
    assert!(errors[0] > 0.015, "{errors:?}");
    assert!(errors[1].abs() < 0.35 * errors[0], "{errors:?}");
}

/// A point at the cap bears it on all of its pixel: its sides are no border, and no area is less than the load needs.
#[test]
fn the_area_at_the_cap_is_not_corrected() {
    let map = rough([96, 96], 0.8, 0.25, 8.0 / 96.0, 5);
    let cap = 0.05;
    for load in [1e-4, 1e-3, 0.01, 0.03, 0.045] {
        let [contact, without] =
            [Some(cap), None].map(|cap| solved(&map, options(Boundary::Periodic, 1e-9, cap), load));
        let least = (load / cap).max(contact.capped_area_ratio());
        assert!(contact.area_ratio() >= least, "{load}: {} < {least}", contact.area_ratio());
        let correction = contact.raw_area_ratio() - contact.area_ratio();
        let of_elastic = 1.0 - without.area_ratio() / without.raw_area_ratio();
        assert!(correction / contact.raw_area_ratio() < 0.5 * of_elastic, "{load}");
    }
}

/// The distance of the flat from the undeformed mean plane is the mean gap where the surface has no end; a finite patch sinks
/// on average as under a uniform pressure, or less, since a rigid flat presses on its edges.
#[test]
fn a_finite_patch_sinks_as_a_whole() {
    let map = rough([64, 48], 0.5, 0.3, 0.1, 7);
    for boundary in [Boundary::Periodic, Boundary::Mirrored] {
        let contact = solved(&map, options(boundary, 1e-10, None), 0.05);
        assert!((contact.undeformed_gap() / contact.mean_gap() - 1.0).abs() < 1e-6, "{boundary:?}");
    }
    let sides = [0, 1].map(|axis| map.points()[axis] as f64 * map.pixel()[axis]);
    for load in [1e-3, 0.05, 0.5] {
        let contact = solved(&map, options(Boundary::Finite, 1e-10, None), load);
        let deflection = contact.mean_gap() - contact.undeformed_gap();
        let of_uniform = deflection / mean_deflection(load, sides);
        assert!((0.7..1.1).contains(&of_uniform), "{load}: {of_uniform}");
    }
}
