//! Paraboloids of R = 1 on a half-space and on a bonded layer; nothing repeats.

use std::f64::consts::PI;

use asperity::bem::{Boundary, Contact, ElasticPair, Options};
use asperity::layer::exact_sphere::LayeredSphere;
use asperity::{HeightMap, MapError, Material};

use super::{DUAL_GAP, Measured, Problem, Quantity, Unsolved, pressure_errors, solved, unit_pair};

/// Contact radius on the half-space, over R.
const RADIUS: f64 = 0.1;

/// Side of the map over the contact radius.
const SIDE: f64 = 2.5;

/// The place of the tip from the middle of the map, in pixels: off every symmetry of the grid.
const TIP: [f64; 2] = [0.317, -0.171];

/// Errors allowed at a number of pixels per contact radius, about 1.5 times those found; they fall with its square
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

/// A paraboloid with its tip at height 0 and the distance of each point from it.
struct Paraboloid {
    map: HeightMap,
    distances: Vec<f64>,
    nominal_area: f64,
}

impl Paraboloid {
    fn new(contact_radius: f64, pixels: usize) -> Result<Self, MapError> {
        let pixel = contact_radius / pixels as f64;
        let count = (SIDE * pixels as f64).ceil() as usize;
        let middle = TIP.map(|shift| 0.5 * count as f64 + shift);
        let distance =
            |k: usize| pixel * ((k / count) as f64 - middle[0]).hypot((k % count) as f64 - middle[1]);
        let distances: Vec<f64> = (0..count * count).map(distance).collect();
        let heights = distances.iter().map(|r| -0.5 * r * r).collect();
        let map = HeightMap::new([count; 2], [pixel; 2], heights, 0.0)?;
        Ok(Self { map, distances, nominal_area: (count as f64 * pixel).powi(2) })
    }

    fn contact(&self, pair: &ElasticPair, load: f64) -> Result<Contact, Unsolved> {
        let options = Options { boundary: Boundary::Finite, error: DUAL_GAP, cap: None };
        Ok(solved(&self.map, pair, options, load / self.nominal_area)?)
    }
}

/// Indentation and both areas.
fn approach_and_areas(
    contact: &Contact,
    nominal_area: f64,
    [indentation, contact_radius]: [f64; 2],
) -> [(Quantity, f64, f64); 3] {
    let area = PI * contact_radius * contact_radius;
    [
        (Quantity::Indentation, indentation, contact.approach()),
        (Quantity::RawArea, area, contact.raw_area_ratio() * nominal_area),
        (Quantity::Area, area, contact.area_ratio() * nominal_area),
    ]
}

fn allowed(bound: &Allowed, quantity: Quantity, pixels: usize) -> Option<f64> {
    let coarser = bound.pixels / pixels as f64;
    match quantity {
        Quantity::Indentation => Some(bound.indentation * coarser * coarser),
        Quantity::Area => Some(bound.area * coarser),
        Quantity::Pressures => Some(bound.pressures * coarser),
        Quantity::RawArea | Quantity::PeakPressure | Quantity::MeanGap => None,
    }
}

/// Hertz's contact at `pixels` per contact radius.
///
/// # Errors
/// See [`Unsolved`].
pub fn hertz(pixels: usize) -> Result<Vec<Measured>, Unsolved> {
    let (body, contact) = hertz_contact(pixels)?;
    let peak = 2.0 * RADIUS / PI;
    let [pressures, highest] = pressure_errors(contact.pressures(), |k| hertz_pressure(body.distances[k]));
    let measured = |quantity: Quantity, values: Option<[f64; 2]>, error: f64| Measured {
        problem: Problem::Hertz,
        case: "sphere".to_owned(),
        points: pixels,
        quantity,
        exact: values.map(|[exact, _]| exact),
        found: values.map(|[_, found]| found),
        error,
        allowed: allowed(&HERTZ_ALLOWED, quantity, pixels),
    };
    let known = approach_and_areas(&contact, body.nominal_area, [RADIUS * RADIUS, RADIUS]);
    let known = known.into_iter().chain([(Quantity::PeakPressure, peak, highest)]);
    let values = known.map(|(of, exact, found)| measured(of, Some([exact, found]), found / exact - 1.0));
    Ok(values.chain([measured(Quantity::Pressures, None, pressures)]).collect())
}

fn hertz_contact(pixels: usize) -> Result<(Paraboloid, Contact), Unsolved> {
    let body = Paraboloid::new(RADIUS, pixels)?;
    let contact = body.contact(&unit_pair()?, 4.0 / 3.0 * RADIUS.powi(3))?;
    Ok((body, contact))
}

fn hertz_pressure(distance: f64) -> f64 {
    2.0 * RADIUS / PI * (1.0 - (distance / RADIUS).powi(2)).max(0.0).sqrt()
}

/// Place and pressure over the highest one: of points, and of the solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Which of several.
    pub case: String,
    /// Points.
    pub found: Vec<(f64, f64)>,
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
    let (body, contact) = hertz_contact(pixels)?;
    let peak = 2.0 * RADIUS / PI;
    let near = body.distances.iter().zip(contact.pressures()).filter(|(r, _)| **r <= 1.2 * RADIUS);
    let mut found: Vec<(f64, f64)> = near.map(|(r, p)| (r / RADIUS, p / peak)).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let exact = (0..=DENSE).map(|k| {
        let r = 1.2 * k as f64 / DENSE as f64;
        (r, hertz_pressure(r * RADIUS) / peak)
    });
    Ok(Profile { case: format!("{pixels} pixels per contact radius"), found, exact: exact.collect() })
}

/// A rigid sphere on a layer at `pixels` per contact radius.
///
/// # Errors
/// See [`Unsolved`].
pub fn layered(case: &LayeredCase, pixels: usize) -> Result<Vec<Measured>, Unsolved> {
    /// A modulus beside which all others are small: its compliance is below rounding.
    const RIGID: f64 = 1e30;
    let body = |[young, poisson]: [f64; 2]| Material::new(young, poisson, None, None);
    let (layer, substrate) = (body(case.layer)?, body(case.substrate)?);
    let exact = LayeredSphere::new(None, 1.0, &layer, &substrate, 1.0);
    let Some(exact) = exact.at_contact_radius(case.contact_radius) else { return Ok(Vec::new()) };
    let paraboloid = Paraboloid::new(case.contact_radius, pixels)?;
    let pair = ElasticPair::new(&body([RIGID, 0.3])?, &substrate, Some((&layer, 1.0)));
    let contact = paraboloid.contact(&pair, exact.load)?;
    let known =
        approach_and_areas(&contact, paraboloid.nominal_area, [exact.indentation, case.contact_radius]);
    let measured = known.into_iter().map(|(quantity, exact, found)| Measured {
        problem: Problem::LayeredSphere,
        case: case.name(),
        points: pixels,
        quantity,
        exact: Some(exact),
        found: Some(found),
        error: found / exact - 1.0,
        allowed: allowed(&LAYERED_ALLOWED, quantity, pixels),
    });
    Ok(measured.collect())
}
