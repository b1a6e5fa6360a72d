//! Paraboloids of R = 1 on a half-space and on a bonded layer; nothing repeats.

use std::f64::consts::PI;

use asperity::bem::{Boundary, Contact, ElasticPair};
use asperity::layer::exact_sphere::LayeredSphere;
use asperity::{HeightMap, Material};

use super::{Benchmark, BenchmarkQuantity, Case, Problem, Unsolved, pressure_errors, solved, unit_pair};

/// Contact radius on the half-space, over R.
const RADIUS: f64 = 0.1;

/// Side of the map over the contact radius.
const SIDE: f64 = 2.5;

/// Points along a side of the map of a sphere with `pixels` per contact radius.
pub fn sphere_points(pixels: usize) -> usize {
    (SIDE * pixels as f64).ceil() as usize
}

/// The place of the tip from the middle of the map, in pixels: off every symmetry of the grid.
const TIP: [f64; 2] = [0.317, -0.171];

/// Errors allowed at a number of pixels per contact radius, about 1.5 times the present ones; they fall with its square
/// (indentation) or its inverse.
struct Allowed {
    pixels: f64,
    indentation: f64,
    area: f64,
    pressures: f64,
}

const HERTZ_ALLOWED: Allowed = Allowed { pixels: 64.0, indentation: 2e-5, area: 3e-3, pressures: 3e-3 };

const LAYERED_ALLOWED: Allowed = Allowed { pixels: 102.0, indentation: 1e-5, area: 2e-3, pressures: 3e-3 };

/// A rigid sphere on a layer of thickness 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayeredCase {
    /// Young's modulus and Poisson's ratio of the layer.
    pub layer: [f64; 2],
    /// Those of the substrate.
    pub substrate: [f64; 2],
    /// Contact radius over thickness.
    pub contact_radius: f64,
}

/// Soft and stiff layers, and lead on steel.
pub const LAYERED_CASES: [LayeredCase; 10] = {
    const fn case(layer: [f64; 2], substrate: [f64; 2], contact_radius: f64) -> LayeredCase {
        LayeredCase { layer, substrate, contact_radius }
    }
    const SOFT: [f64; 2] = [1.0, 0.3];
    const STIFF: [f64; 2] = [10.0, 0.3];
    const LEAD: [f64; 2] = [18.0, 0.35];
    const STEEL: [f64; 2] = [210.0, 0.3];
    [
        case(SOFT, STIFF, 0.5),
        case(SOFT, STIFF, 1.0),
        case(SOFT, STIFF, 2.0),
        case(STIFF, SOFT, 0.5),
        case(STIFF, SOFT, 1.0),
        case(STIFF, SOFT, 2.0),
        case(SOFT, [2.0, 0.3], 1.0),
        case(LEAD, STEEL, 0.2),
        case(LEAD, STEEL, 1.0),
        case(LEAD, STEEL, 5.0),
    ]
};

impl LayeredCase {
    /// "18 on 210, a = 0.2 t"
    pub fn name(&self) -> String {
        format!("{}, a = {} t", self.bodies(), self.contact_radius)
    }

    /// Young's moduli of layer and substrate: "18 on 210".
    pub fn bodies(&self) -> String {
        format!("{} on {}", self.layer[0], self.substrate[0])
    }
}

/// A paraboloid in contact: a flat pressed on its tip.
struct Paraboloid {
    contact_radius: f64,
    nominal_area: f64,
    /// Of each point from the tip.
    distances: Vec<f64>,
    contact: Contact,
}

impl Paraboloid {
    /// Solves it under a load with `pixels` per (expected) contact radius.
    fn new(contact_radius: f64, pixels: usize, pair: &ElasticPair, load: f64) -> Result<Self, Unsolved> {
        let pixel = contact_radius / pixels as f64;
        let count = sphere_points(pixels);
        let middle = TIP.map(|shift| 0.5 * count as f64 + shift);
        let distance =
            |k: usize| pixel * ((k / count) as f64 - middle[0]).hypot((k % count) as f64 - middle[1]);
        let distances: Vec<f64> = (0..count * count).map(distance).collect();
        let heights = distances.iter().map(|r| -0.5 * r * r).collect();
        let map = HeightMap::new([count; 2], [pixel; 2], heights, 0.0)?;
        let nominal_area = (count as f64 * pixel).powi(2);
        let contact = solved(&map, pair, Boundary::Finite, load / nominal_area)?;
        Ok(Self { contact_radius, nominal_area, distances, contact })
    }

    /// Hertz's contact.
    fn hertz(pixels: usize) -> Result<Self, Unsolved> {
        Self::new(RADIUS, pixels, &unit_pair()?, 4.0 / 3.0 * RADIUS.powi(3))
    }

    /// Indentation and both areas.
    fn benchmarks(&self, case: &Case, indentation: f64, allowed: &Allowed) -> Vec<Benchmark> {
        let area = PI * self.contact_radius * self.contact_radius;
        let values = [
            (BenchmarkQuantity::Indentation, indentation, self.contact.approach()),
            (BenchmarkQuantity::RawArea, area, self.contact.raw_area_ratio() * self.nominal_area),
            (BenchmarkQuantity::Area, area, self.contact.area_ratio() * self.nominal_area),
        ];
        let benchmark = |(quantity, exact, computed)| {
            let allowed = allowed.error(quantity, case.points);
            case.benchmark(quantity, Some([exact, computed]), computed / exact - 1.0, allowed)
        };
        values.map(benchmark).to_vec()
    }
}

impl Allowed {
    fn error(&self, quantity: BenchmarkQuantity, pixels: usize) -> Option<f64> {
        let coarser = self.pixels / pixels as f64;
        match quantity {
            BenchmarkQuantity::Indentation => Some(self.indentation * coarser * coarser),
            BenchmarkQuantity::Area => Some(self.area * coarser),
            BenchmarkQuantity::Pressures => Some(self.pressures * coarser),
            BenchmarkQuantity::RawArea | BenchmarkQuantity::PeakPressure | BenchmarkQuantity::MeanGap => None,
        }
    }
}

/// Hertz's contact at `pixels` per contact radius.
///
/// # Errors
/// See [`Unsolved`].
pub fn hertz(pixels: usize) -> Result<Vec<Benchmark>, Unsolved> {
    let body = Paraboloid::hertz(pixels)?;
    let case = Case { problem: Problem::Hertz, name: "sphere".to_owned(), points: pixels };
    let [error, highest] = pressure_errors(body.contact.pressures(), |k| hertz_pressure(body.distances[k]));
    let mut benchmarks = body.benchmarks(&case, RADIUS * RADIUS, &HERTZ_ALLOWED);
    benchmarks.extend([
        case.benchmark(BenchmarkQuantity::PeakPressure, Some([PEAK, highest]), highest / PEAK - 1.0, None),
        case.benchmark(
            BenchmarkQuantity::Pressures,
            None,
            error,
            HERTZ_ALLOWED.error(BenchmarkQuantity::Pressures, pixels),
        ),
    ]);
    Ok(benchmarks)
}

/// Hertz's highest pressure.
const PEAK: f64 = 2.0 * RADIUS / PI;

fn hertz_pressure(distance: f64) -> f64 {
    PEAK * (1.0 - (distance / RADIUS).powi(2)).max(0.0).sqrt()
}

/// Place and pressure over the highest one: of points, and of the solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Which of several.
    pub case: String,
    /// Points of the boundary elements.
    pub computed: Vec<(f64, f64)>,
    /// The solution, densely.
    pub exact: Vec<(f64, f64)>,
}

/// Hertz's pressures over distance from the axis in contact radii.
///
/// # Errors
/// See [`Unsolved`].
pub fn hertz_profile(pixels: usize) -> Result<Profile, Unsolved> {
    /// Points of the solution.
    const DENSE: usize = 200;
    let body = Paraboloid::hertz(pixels)?;
    let near = body.distances.iter().zip(body.contact.pressures()).filter(|(r, _)| **r <= 1.2 * RADIUS);
    let mut computed: Vec<(f64, f64)> = near.map(|(r, p)| (r / RADIUS, p / PEAK)).collect();
    computed.sort_by(|a, b| a.0.total_cmp(&b.0));
    let exact = (0..=DENSE).map(|k| {
        let r = 1.2 * k as f64 / DENSE as f64;
        (r, hertz_pressure(r * RADIUS) / PEAK)
    });
    Ok(Profile { case: format!("{pixels} pixels per contact radius"), computed, exact: exact.collect() })
}

/// A rigid sphere on a layer at `pixels` per contact radius.
///
/// # Errors
/// See [`Unsolved`].
pub fn layered(case: &LayeredCase, pixels: usize) -> Result<Vec<Benchmark>, Unsolved> {
    /// A modulus beside which all others are small: its compliance is below rounding.
    const RIGID: f64 = 1e30;
    let body = |[young, poisson]: [f64; 2]| Material::new(young, poisson, None, None);
    let (layer, substrate) = (body(case.layer)?, body(case.substrate)?);
    let exact = LayeredSphere::new(None, 1.0, &layer, &substrate, 1.0);
    let Some(exact) = exact.at_contact_radius(case.contact_radius) else { return Ok(Vec::new()) };
    let pair = ElasticPair::new(&body([RIGID, 0.3])?, &substrate, Some((&layer, 1.0)));
    let body = Paraboloid::new(case.contact_radius, pixels, &pair, exact.load)?;
    let case = Case { problem: Problem::LayeredSphere, name: case.name(), points: pixels };
    Ok(body.benchmarks(&case, exact.indentation, &LAYERED_ALLOWED))
}
