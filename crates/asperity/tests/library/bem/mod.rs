//! Boundary elements.

mod active_set;
mod conduction;
mod convergence;
mod grid_error;
mod hertz;
mod layered_sphere;
mod solver;
mod tangent;
mod westergaard;

use asperity::bem::{Boundary, Contact, ElasticPair, Options, Solver};
use asperity::progress::Silent;
use asperity::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::{HeightMap, Heights, Material};

/// Two of them have E* = 1 Pa.
fn unit_body() -> Material {
    Material::new(2.0, 0.0, None, None).unwrap()
}

fn bare() -> ElasticPair {
    ElasticPair::new(&unit_body(), &unit_body(), None)
}

fn options(boundary: Boundary, error: f64, cap: Option<f64>) -> Options {
    Options { boundary, error, cap }
}

/// The contact of two unit bodies under a mean pressure.
fn solved(map: &HeightMap, options: Options, load: f64) -> Contact {
    Solver::new(map, &bare(), &options).unwrap().at_pressure(load, &Silent).unwrap()
}

/// A map with other heights on the same points.
fn with_heights(map: &HeightMap, height: impl Fn(f64) -> f64) -> HeightMap {
    let heights = map.heights().iter().map(|z| height(*z)).collect();
    HeightMap::new(map.points(), map.pixel(), heights, 0.0).unwrap()
}

/// A paraboloid of R = 1 on `count` x `count` points at a distance of `pixel`, its tip at height 0 and off the symmetry of the
/// grid, with the distance of each point from it.
fn paraboloid(count: usize, pixel: f64) -> (HeightMap, Vec<f64>) {
    let middle = [0.5 * count as f64 + 0.317, 0.5 * count as f64 - 0.171];
    let distance = |k: usize| pixel * ((k / count) as f64 - middle[0]).hypot((k % count) as f64 - middle[1]);
    let distances: Vec<f64> = (0..count * count).map(distance).collect();
    let heights = distances.iter().map(|r| -0.5 * r * r).collect();
    (HeightMap::new([count; 2], [pixel; 2], heights, 0.0).unwrap(), distances)
}

/// A periodic self-affine surface of unit length along x and an r.m.s. gradient of about 1, with waves from `longest` to
/// `shortest`, over the length.
fn rough(points: [usize; 2], hurst: f64, longest: f64, shortest: f64, seed: u8) -> HeightMap {
    let pixel = [(points[0] as f64).recip(); 2];
    let shape = SpectrumShape::SelfAffine { hurst, roll_off: longest, cut_off: shortest };
    let process = Process {
        spectrum: Spectrum::new(shape, Lay::default()).unwrap(),
        of: SpectrumOf::Heights,
        sigma: 1.0,
        heights: Heights::GAUSSIAN,
    };
    let generator = SurfaceGenerator { points, pixel, process, plateau: None };
    let (map, _) = generator.surface(Seeds { process: [seed; 32], plateau: [0; 32] }).unwrap();
    let [nx, ny] = points;
    let z = map.heights();
    let slope = |i: usize, j: usize| {
        let (here, x, y) = (z[i * ny + j], z[(i + 1) % nx * ny + j], z[i * ny + (j + 1) % ny]);
        ((x - here) / pixel[0]).powi(2) + ((y - here) / pixel[1]).powi(2)
    };
    let mean = (0..nx * ny).map(|k| slope(k / ny, k % ny)).sum::<f64>() / (nx * ny) as f64;
    let heights = z.iter().map(|z| z / mean.sqrt()).collect();
    HeightMap::new(points, pixel, heights, 0.0).unwrap().periodic()
}
