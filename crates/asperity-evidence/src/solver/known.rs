//! Problems whose solution is known: paraboloids of R = 1 on a half-space and on a bonded layer, where nothing repeats, and waves
//! h cos(2 pi x/lambda) with lambda = 1 and E* = 1.

use std::f64::consts::{PI, TAU};

use asperity::bem::{Boundary, Contact, ElasticPair, Options, Solver, SolverError};
use asperity::layer::exact_sphere::LayeredSphere;
use asperity::named_enum;
use asperity::progress::Silent;
use asperity::{HeightMap, Material};

use super::unit_pair;
use crate::Failed;

/// Relative dual gap: far below the errors of discretisation.
const DUAL_GAP: f64 = 1e-11;

named_enum! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Problem {
        Hertz = "hertz",
        Sinusoid = "sinusoid",
        FullContact = "full-contact",
        LayeredSphere = "layered-sphere",
        Ensemble = "ensemble",
    }
}

named_enum! {
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum BenchmarkQuantity {
        /// Approach of distant points, relative.
        Indentation = "indentation",
        /// Points in contact, relative; of the sinusoid the width over the wavelength, absolute.
        RawArea = "raw-area",
        /// The same, corrected for the border.
        Area = "area",
        /// Points in contact, extrapolated to infinitely many.
        LimitArea = "extrapolated-area",
        PeakPressure = "peak-pressure",
        /// Root mean square of the error of the pressures over that of the pressures.
        Pressures = "pressures",
        /// Mean gap over the height of the wave, absolute.
        MeanGap = "mean-gap",
    }
}

/// One quantity of one problem at one resolution.
#[derive(Debug, Clone, PartialEq)]
pub struct Benchmark {
    pub problem: Problem,
    pub case: String,
    /// Points per contact radius or per wavelength; of the ensemble along a side.
    pub points: usize,
    pub quantity: BenchmarkQuantity,
    /// The exact value and that of the boundary elements; `None` of a norm of an error.
    pub values: Option<[f64; 2]>,
    /// The error, as [`BenchmarkQuantity`] defines it.
    pub error: f64,
    /// The largest error that is allowed.
    pub allowed: Option<f64>,
}

impl Benchmark {
    pub fn is_within(&self) -> bool {
        self.allowed.is_none_or(|allowed| self.error.abs() <= allowed)
    }
}

pub(super) struct Case {
    pub(super) problem: Problem,
    pub(super) name: String,
    pub(super) points: usize,
}

impl Case {
    pub(super) fn benchmark(
        &self,
        quantity: BenchmarkQuantity,
        values: Option<[f64; 2]>,
        error: f64,
        allowed: Option<f64>,
    ) -> Benchmark {
        let Self { problem, points, .. } = *self;
        Benchmark { problem, case: self.name.clone(), points, quantity, values, error, allowed }
    }
}

/// A contact under a mean pressure, to [`DUAL_GAP`].
fn solved(
    map: &HeightMap,
    pair: &ElasticPair,
    boundary: Boundary,
    pressure: f64,
) -> Result<Contact, SolverError> {
    let options = Options { boundary, error: DUAL_GAP, cap: None };
    Solver::new(map, pair, &options)?.at_pressure(pressure, &Silent)
}

/// Root mean square of `computed - exact` over that of `exact`, and the highest of `computed`.
fn pressure_errors(computed: &[f64], exact: impl Fn(usize) -> f64) -> [f64; 2] {
    let [mut difference, mut norm, mut highest] = [0.0f64; 3];
    for (k, &p) in computed.iter().enumerate() {
        let exact = exact(k);
        difference += (p - exact).powi(2);
        norm += exact * exact;
        highest = highest.max(p);
    }
    [(difference / norm).sqrt(), highest]
}

/// Contact radius on the half-space, over R, and Hertz's highest pressure.
const RADIUS: f64 = 0.1;
const PEAK: f64 = 2.0 * RADIUS / PI;

/// Side of the map of a sphere over the contact radius.
const SIDE: f64 = 2.5;

/// The place of the tip from the middle of the map, in pixels: off every symmetry of the grid.
const TIP: [f64; 2] = [0.317, -0.171];

/// Pixels per contact radius, and the errors of indentation and area allowed there, about 1.5 times the present ones; that of Hertz's
/// pressures is that of the area. They fall with the square of the pixels (indentation) or their number.
const HERTZ_ALLOWED: [f64; 3] = [64.0, 2e-5, 3e-3];
const LAYERED_ALLOWED: [f64; 3] = [102.0, 1e-5, 2e-3];

/// Rigid spheres on a layer of thickness 1: Young's modulus and Poisson's ratio of layer and substrate, and the contact radius.
pub type LayeredCase = ([f64; 2], [f64; 2], f64);

/// Soft and stiff layers, and lead on steel.
pub const LAYERED_CASES: [LayeredCase; 10] = {
    const SOFT: [f64; 2] = [1.0, 0.3];
    const STIFF: [f64; 2] = [10.0, 0.3];
    const LEAD: [f64; 2] = [18.0, 0.35];
    const STEEL: [f64; 2] = [210.0, 0.3];
    [
        (SOFT, STIFF, 0.5),
        (SOFT, STIFF, 1.0),
        (SOFT, STIFF, 2.0),
        (STIFF, SOFT, 0.5),
        (STIFF, SOFT, 1.0),
        (STIFF, SOFT, 2.0),
        (SOFT, [2.0, 0.3], 1.0),
        (LEAD, STEEL, 0.2),
        (LEAD, STEEL, 1.0),
        (LEAD, STEEL, 5.0),
    ]
};

/// A flat pressed on the tip of a paraboloid with `case.points` pixels per (expected) contact radius: the distance of each point from the
/// tip, the contact, and the errors of the indentation and of both areas.
fn sphere(
    case: &Case,
    contact_radius: f64,
    pair: &ElasticPair,
    [load, indentation]: [f64; 2],
    allowed: [f64; 3],
) -> Result<(Vec<f64>, Contact, Vec<Benchmark>), Failed> {
    let pixel = contact_radius / case.points as f64;
    let count = (SIDE * case.points as f64).ceil() as usize;
    let middle = TIP.map(|shift| 0.5 * count as f64 + shift);
    let distance = |k: usize| pixel * ((k / count) as f64 - middle[0]).hypot((k % count) as f64 - middle[1]);
    let distances: Vec<f64> = (0..count * count).map(distance).collect();
    let heights = distances.iter().map(|r| -0.5 * r * r).collect();
    let map = HeightMap::new([count; 2], [pixel; 2], heights, 0.0)?;
    let nominal = (count as f64 * pixel).powi(2);
    let contact = solved(&map, pair, Boundary::Finite, load / nominal)?;
    let area = PI * contact_radius * contact_radius;
    let coarser = allowed[0] / case.points as f64;
    let benchmark = |quantity, exact: f64, computed: f64, allowed| {
        case.benchmark(quantity, Some([exact, computed]), computed / exact - 1.0, allowed)
    };
    let of_indentation = Some(allowed[1] * coarser * coarser);
    let benchmarks = vec![
        benchmark(BenchmarkQuantity::Indentation, indentation, contact.approach(), of_indentation),
        benchmark(BenchmarkQuantity::RawArea, area, contact.raw_area_ratio() * nominal, None),
        benchmark(BenchmarkQuantity::Area, area, contact.area_ratio() * nominal, Some(allowed[2] * coarser)),
    ];
    Ok((distances, contact, benchmarks))
}

/// Hertz's contact at `pixels` per contact radius.
pub fn hertz(pixels: usize) -> Result<Vec<Benchmark>, Failed> {
    let case = Case { problem: Problem::Hertz, name: "sphere".to_owned(), points: pixels };
    let hertz = [4.0 / 3.0 * RADIUS.powi(3), RADIUS * RADIUS];
    let (distances, contact, mut benchmarks) = sphere(&case, RADIUS, &unit_pair()?, hertz, HERTZ_ALLOWED)?;
    let pressure = |k: usize| PEAK * (1.0 - (distances[k] / RADIUS).powi(2)).max(0.0).sqrt();
    let [error, highest] = pressure_errors(contact.pressures(), pressure);
    let allowed = HERTZ_ALLOWED[2] * HERTZ_ALLOWED[0] / pixels as f64;
    benchmarks.extend([
        case.benchmark(BenchmarkQuantity::PeakPressure, Some([PEAK, highest]), highest / PEAK - 1.0, None),
        case.benchmark(BenchmarkQuantity::Pressures, None, error, Some(allowed)),
    ]);
    Ok(benchmarks)
}

/// A rigid sphere on a layer at `pixels` per contact radius.
pub fn layered(
    &(layer, substrate, contact_radius): &LayeredCase,
    pixels: usize,
) -> Result<Vec<Benchmark>, Failed> {
    /// A modulus beside which all others are small: its compliance is below rounding.
    const RIGID: f64 = 1e30;
    let name = format!("{} on {}, a = {contact_radius} t", layer[0], substrate[0]);
    let body = |[young, poisson]: [f64; 2]| Material::new(young, poisson, None, None);
    let (layer, substrate) = (body(layer)?, body(substrate)?);
    let exact = LayeredSphere::new(None, 1.0, &layer, &substrate, 1.0);
    let Some(exact) = exact.at_contact_radius(contact_radius) else { return Ok(Vec::new()) };
    let pair = ElasticPair::new(&body([RIGID, 0.3])?, &substrate, Some((&layer, 1.0)));
    let case = Case { problem: Problem::LayeredSphere, name, points: pixels };
    let solution = [exact.load, exact.indentation];
    Ok(sphere(&case, contact_radius, &pair, solution, LAYERED_ALLOWED)?.2)
}

/// Height of the wave over its length.
const HEIGHT: f64 = 0.01;

/// Points across the wave, along which nothing changes.
const ALONG_Y: usize = 4;

/// Places of the crest between two points over which errors are taken, in pixels.
const SHIFTS: usize = 8;

/// Errors allowed, times the points per wavelength: of the width over the wavelength.
const WIDTH_ALLOWED: f64 = 0.25;

/// Of the mean gap over the height of the wave, times the square of the points.
const GAP_ALLOWED: f64 = 4.0;

/// Of the pressures, times the points per half the width of the contact.
const PRESSURES_ALLOWED: f64 = 0.25;

/// Error of the pressures allowed in full contact, where they are linear in the heights.
const FULL_ALLOWED: f64 = 1e-12;

/// The closed form at p = `share` p* (Westergaard 1939; Johnson, Greenwood and Higginson 1985).
struct Wave {
    share: f64,
}

impl Wave {
    fn name(&self) -> String {
        format!("p = {} p*", self.share)
    }

    /// Mean pressure; p* = pi E* h/lambda.
    fn pressure(&self) -> f64 {
        self.share * PI * HEIGHT
    }

    /// Width of the contact 2 a over the wavelength, from sin^2(pi a/lambda) = p/p*.
    fn width(&self) -> f64 {
        2.0 * self.share.sqrt().asin() / PI
    }

    /// Mean gap over h: cos^2(pi a) + 2 sin^2(pi a) ln sin(pi a).
    fn mean_gap(&self) -> f64 {
        1.0 - self.share + self.share * self.share.ln()
    }
}

/// The places of the points, from a crest.
fn places(points: usize, shift: f64) -> Vec<f64> {
    (0..points * ALONG_Y).map(|k| ((k / ALONG_Y) as f64 + shift) / points as f64 - 0.5).collect()
}

/// A wave of `points` under `share` of the pressure that closes the gap: of the width the mean over places of the crest between
/// two points, of the others the largest error.
pub fn partial_contact(points: usize, share: f64) -> Result<Vec<Benchmark>, Failed> {
    let wave = Wave { share };
    let (mut widths, mut gap, mut pressures) = ([0.0; 2], wave.mean_gap(), 0.0f64);
    for shift in 0..SHIFTS {
        let x = places(points, (shift as f64 + 0.317) / SHIFTS as f64);
        let heights = x.iter().map(|x| HEIGHT * (TAU * x).cos()).collect();
        let map = HeightMap::new([points, ALONG_Y], [(points as f64).recip(); 2], heights, 0.0)?;
        let contact = solved(&map, &unit_pair()?, Boundary::Periodic, wave.pressure())?;
        widths[0] += contact.raw_area_ratio() / SHIFTS as f64;
        widths[1] += contact.area_ratio() / SHIFTS as f64;
        let computed = contact.mean_gap() / HEIGHT;
        if (computed - wave.mean_gap()).abs() > (gap - wave.mean_gap()).abs() {
            gap = computed;
        }
        let [error, _] = pressure_errors(contact.pressures(), |k| {
            let inside = (wave.share - (PI * x[k]).sin().powi(2)).max(0.0);
            2.0 * wave.pressure() / wave.share * (PI * x[k]).cos().abs() * inside.sqrt()
        });
        pressures = pressures.max(error);
    }
    let case = Case { problem: Problem::Sinusoid, name: wave.name(), points };
    let difference = |quantity, [exact, computed]: [f64; 2], allowed| {
        case.benchmark(quantity, Some([exact, computed]), computed - exact, allowed)
    };
    let finer = (points as f64).recip();
    let pressures_allowed = PRESSURES_ALLOWED * finer / (0.5 * wave.width());
    Ok(vec![
        difference(BenchmarkQuantity::RawArea, [wave.width(), widths[0]], None),
        difference(BenchmarkQuantity::Area, [wave.width(), widths[1]], Some(WIDTH_ALLOWED * finer)),
        difference(BenchmarkQuantity::MeanGap, [wave.mean_gap(), gap], Some(GAP_ALLOWED * finer * finer)),
        case.benchmark(BenchmarkQuantity::Pressures, None, pressures, Some(pressures_allowed)),
    ])
}

/// Waves along both axes in full contact, without a layer and with soft and stiff ones: the largest error of the pressures,
/// whose amplitude is the height over the compliance of the wave.
pub fn full_contact() -> Result<Vec<Benchmark>, Failed> {
    const POINTS: [usize; 2] = [64, 48];
    const PIXEL: f64 = 1.0 / 64.0;
    /// Over the wavelength.
    const THICKNESS: f64 = 0.1;
    let cases = [
        ("bare", None),
        ("soft layer of 0.1 wavelengths", Some(0.2)),
        ("stiff layer of 0.1 wavelengths", Some(20.0)),
    ];
    let substrate = Material::new(2.0, 0.0, None, None)?;
    let waves = [3.0 * TAU, 2.0 * TAU / 0.75];
    let length = TAU / waves[0].hypot(waves[1]);
    let wave = |k: usize| {
        (waves[0] * PIXEL * (k / POINTS[1]) as f64).cos() * (waves[1] * PIXEL * (k % POINTS[1]) as f64).cos()
    };
    let heights: Vec<f64> = (0..POINTS[0] * POINTS[1]).map(|k| HEIGHT * wave(k)).collect();
    let map = HeightMap::new(POINTS, [PIXEL; 2], heights, 0.0)?;
    let benchmark = |(name, young): (&str, Option<f64>)| -> Result<Benchmark, Failed> {
        let layer = young.map(|young| Material::new(young, 0.3, None, None)).transpose()?;
        let layer = layer.as_ref().map(|layer| (layer, THICKNESS * length));
        let pair = ElasticPair::new(&substrate, &substrate, layer);
        let amplitude = HEIGHT / pair.compliance(TAU / length);
        // As near to rounding as can be asked for.
        let options = Options { boundary: Boundary::Periodic, error: *Options::ERRORS.start(), cap: None };
        let contact = Solver::new(&map, &pair, &options)?.at_pressure(2.0 * amplitude, &Silent)?;
        let error = |(k, p): (usize, &f64)| (p / amplitude - 2.0 - wave(k)).abs();
        let largest = contact.pressures().iter().enumerate().map(error).fold(0.0, f64::max);
        let case = Case { problem: Problem::FullContact, name: name.to_owned(), points: POINTS[0] / 3 };
        Ok(case.benchmark(BenchmarkQuantity::Pressures, None, largest, Some(FULL_ALLOWED)))
    };
    cases.into_iter().map(benchmark).collect()
}
