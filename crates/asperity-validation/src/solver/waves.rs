//! Waves h cos(2 pi x/lambda) with lambda = 1 and E* = 1: partial contact, and full contact with and without a layer.

use std::f64::consts::{PI, TAU};

use asperity::bem::{Boundary, Contact, ElasticPair, Options, Solver};
use asperity::progress::Silent;
use asperity::{HeightMap, Material};

use super::{
    Benchmark, BenchmarkQuantity, Case, Problem, Profile, Unsolved, pressure_errors, solved, unit_pair,
};

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

    /// Pressure at x from a crest.
    fn pressure_at(&self, x: f64) -> f64 {
        let inside = (self.share - (PI * x).sin().powi(2)).max(0.0);
        2.0 * self.pressure() / self.share * (PI * x).cos().abs() * inside.sqrt()
    }
}

/// The places of the points, from a crest.
fn places(points: usize, shift: f64) -> Vec<f64> {
    (0..points * ALONG_Y).map(|k| ((k / ALONG_Y) as f64 + shift) / points as f64 - 0.5).collect()
}

fn contact(wave: &Wave, x: &[f64], points: usize) -> Result<Contact, Unsolved> {
    let heights = x.iter().map(|x| HEIGHT * (TAU * x).cos()).collect();
    let map = HeightMap::new([points, ALONG_Y], [(points as f64).recip(); 2], heights, 0.0)?;
    Ok(solved(&map, &unit_pair()?, Boundary::Periodic, wave.pressure())?)
}

/// A wave of `points` under `share` of the pressure that closes the gap: of the width the mean over places of the crest between
/// two points, of the others the largest error.
///
/// # Errors
/// See [`Unsolved`].
pub fn partial_contact(points: usize, share: f64) -> Result<Vec<Benchmark>, Unsolved> {
    let wave = Wave { share };
    let (mut widths, mut gap, mut pressures) = ([0.0; 2], wave.mean_gap(), 0.0f64);
    for shift in 0..SHIFTS {
        let x = places(points, (shift as f64 + 0.317) / SHIFTS as f64);
        let contact = contact(&wave, &x, points)?;
        widths[0] += contact.raw_area_ratio() / SHIFTS as f64;
        widths[1] += contact.area_ratio() / SHIFTS as f64;
        let computed = contact.mean_gap() / HEIGHT;
        if (computed - wave.mean_gap()).abs() > (gap - wave.mean_gap()).abs() {
            gap = computed;
        }
        let [error, _] = pressure_errors(contact.pressures(), |k| wave.pressure_at(x[k]));
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

/// Pressures of a wave of `points` over the place in wavelengths, both over the highest pressure in full contact, 2 p*.
///
/// # Errors
/// See [`Unsolved`].
pub fn wave_profile(points: usize, share: f64) -> Result<Profile, Unsolved> {
    /// Points of the solution.
    const DENSE: usize = 400;
    let wave = Wave { share };
    let x = places(points, 0.317);
    let contact = contact(&wave, &x, points)?;
    let highest = TAU * HEIGHT;
    let row = |k: usize| (x[k * ALONG_Y], contact.pressures()[k * ALONG_Y] / highest);
    let exact = (0..=DENSE).map(|k| {
        let x = k as f64 / DENSE as f64 - 0.5;
        (x, wave.pressure_at(x) / highest)
    });
    Ok(Profile { case: wave.name(), computed: (0..points).map(row).collect(), exact: exact.collect() })
}

/// Waves along both axes in full contact, without a layer and with soft and stiff ones: the largest error of the pressures,
/// whose amplitude is the height over the compliance of the wave.
///
/// # Errors
/// See [`Unsolved`].
pub fn full_contact() -> Result<Vec<Benchmark>, Unsolved> {
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
    let benchmark = |(name, young): (&str, Option<f64>)| -> Result<Benchmark, Unsolved> {
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
