//! Random rough surfaces: `[surface.NAME.generate]`, planned and made.

use std::f64::consts::TAU;
use std::ops::Range;

use asperity::numeric::stream_seed;
use asperity::progress::Progress;
use asperity::surface::GenerationFacts;
use asperity::topography::generate::{
    Plateau, Process, Seeds, SigmaOf, SpectrumOf, SurfaceGenerator, Target, TargetGenerator, Unreachable,
};
use asperity::topography::spectrum::{Lay, Spectrum, SpectrumShape};
use asperity::topography::summits::Neighbours;
use asperity::{HeightMap, Heights};
use asperity_contact_framework::input::bare::SigmaRange;
use asperity_contact_framework::input::heights::HeightsSpec;
use asperity_contact_framework::input::quantity::{
    Angle, ArealNumberDensity, Finite, Length, Pure, Quantity,
};
use asperity_contact_framework::input::{InputError, OneOrMany, Source, Spanned, Whole, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::Deserializer;
use serde_json::json;

use super::spec::PixelSpec;

/// How a random surface is made.
#[derive(Debug, Clone)]
pub struct Generation {
    /// By what it is, or by what its summits shall be.
    pub way: Way,
    pub neighbours: Neighbours,
    /// Position of its size, or of its summits, in the spec.
    pub key: Range<usize>,
}

#[derive(Debug, Clone)]
pub enum Way {
    SurfaceGenerator(SurfaceGenerator),
    /// By what its summits shall be.
    Target {
        /// What is left open.
        generator: TargetGenerator,
        /// What they shall be.
        target: Target,
    },
}

/// A surface and what it was made by.
pub struct Generated {
    pub map: HeightMap,
    pub facts: GenerationFacts,
    /// The bandwidth that met the target, if there is one.
    pub bandwidth: Option<f64>,
}

/// A grid that is worth making.
const FEWEST_POINTS: u64 = 8;
/// Larger maps do not fit in memory.
const MOST_POINTS: u64 = 1 << 20;

impl Generation {
    pub fn new(source: &Source, span: Range<usize>, raw: &GenerateSpec) -> Result<Self, InputError> {
        let points = points(source, raw)?;
        let heights = raw.heights.as_ref().map_or(Heights::GAUSSIAN, |heights| heights.0.clone());
        let way = match &raw.summits {
            Some(summits) => {
                let summits = summits.get_ref();
                let target = Target {
                    radius: summits.radius.value(),
                    sigma: summits.sigma.value(),
                    sigma_of: summits.heights,
                    density: summits.density.value(),
                };
                let generator = target_recipe(source, raw, points, heights)?;
                Way::Target { generator, target }
            }
            None => Way::SurfaceGenerator(generator(source, span, raw, points, heights)?),
        };
        let key = raw.summits.as_ref().map_or_else(|| raw.points.span(), Spanned::span);
        Ok(Self { way, neighbours: raw.neighbours, key })
    }

    pub fn points(&self) -> [usize; 2] {
        match &self.way {
            Way::SurfaceGenerator(generator) => generator.points,
            Way::Target { generator, .. } => generator.points,
        }
    }

    /// Distance of the points along x and y, m; `None` where it follows from the summits.
    pub fn pixel(&self) -> Option<[f64; 2]> {
        match &self.way {
            Way::SurfaceGenerator(generator) => Some(generator.pixel),
            Way::Target { .. } => None,
        }
    }

    /// Points per shortest wave: of the finer process of two; at least the two of the finest wave that a grid holds.
    pub fn points_per_wave(&self) -> f64 {
        /// Of the finest wave.
        const FEWEST: f64 = 2.0;
        let least = match &self.way {
            Way::SurfaceGenerator(SurfaceGenerator { pixel, process, plateau, .. }) => {
                let of = |process: &Process| process.spectrum.shortest_wave().unwrap_or(0.0);
                let finer = plateau.as_ref().map_or(f64::INFINITY, |plateau| of(&plateau.process));
                of(process).min(finer) / pixel[0].max(pixel[1])
            }
            Way::Target { generator, .. } => generator.cut_off * generator.lay.elongation.min(1.0),
        };
        least.max(FEWEST)
    }

    /// Arrays of the map's size that are in memory at once.
    pub fn arrays(&self) -> u128 {
        match &self.way {
            // The surface and its spectrum's table, or the table and the autocorrelation that it comes from; two
            // processes; two fields and a third one where they do not bracket the target.
            Way::SurfaceGenerator(SurfaceGenerator { plateau: None, .. }) => 3,
            Way::SurfaceGenerator(_) => 4,
            Way::Target { .. } => 4,
        }
    }

    /// What it is, for a plan that a person reads.
    pub fn describe(&self) -> String {
        let [nx, ny] = self.points();
        match &self.way {
            Way::SurfaceGenerator(_) => format!("random surface, {nx} x {ny} points"),
            Way::Target { target: Target { radius, sigma, sigma_of, density }, .. } => {
                let whose = match sigma_of {
                    SigmaOf::Summits => "",
                    SigmaOf::Surface => " (of the surface heights)",
                };
                format!(
                    "random surface, {nx} x {ny} points, whose summits have radius {radius:.4e} m, sigma {sigma:.4e} m{whose}, \
                     density {density:.4e} /m^2"
                )
            }
        }
    }

    /// Makes realisation `realisation` (from 1) of the surface called `name`. `first` is a bandwidth that met the target
    /// before.
    pub fn make(
        &self,
        seed: u64,
        name: &str,
        realisation: usize,
        first: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<Generated, Unreachable> {
        let seed = |what: &str| stream_seed(seed, &format!("{what} {name} realisation {realisation}"));
        let seeds = Seeds { process: seed("surface"), plateau: seed("plateau") };
        /// The product of a small map steps as single summits come and go: other random numbers step elsewhere.
        const ATTEMPTS: usize = 8;
        match &self.way {
            Way::SurfaceGenerator(generator) => {
                progress.stage("generating", if generator.plateau.is_some() { 2.0 } else { 1.0 });
                let (map, cut) = generator.watched_surface(seeds, progress)?;
                let facts = GenerationFacts { generator: generator.clone(), target: None, cut };
                Ok(Generated { map, facts, bandwidth: None })
            }
            Way::Target { generator, target } => {
                let mut found = generator.watched_surface(target, seeds.process, first, progress);
                for attempt in 2..=ATTEMPTS {
                    if !matches!(found, Err(Unreachable::Jump { .. })) {
                        break;
                    }
                    let seed = seed(&format!("attempt {attempt} at surface"));
                    found = generator.watched_surface(target, seed, first, progress);
                }
                let found = found?;
                let process = Process {
                    spectrum: found.spectrum,
                    of: SpectrumOf::Gaussian,
                    sigma: found.sigma,
                    heights: generator.heights.clone(),
                };
                let made = SurfaceGenerator {
                    points: generator.points,
                    pixel: found.map.pixel(),
                    process,
                    plateau: None,
                };
                let target = Some((*target, found.tried));
                let facts = GenerationFacts { generator: made, target, cut: None };
                Ok(Generated { map: found.map, facts, bandwidth: Some(found.bandwidth) })
            }
        }
    }
}

fn points(source: &Source, raw: &GenerateSpec) -> Result<[usize; 2], InputError> {
    let counts = raw.points.get_ref().0;
    if counts.iter().all(|count| (FEWEST_POINTS..=MOST_POINTS).contains(count)) {
        return Ok(counts.map(|count| count as usize));
    }
    let message = format!(
        "found {} x {} points; allowed: {FEWEST_POINTS} to {MOST_POINTS} along x and y",
        counts[0], counts[1]
    );
    Err(source.error_at(raw.points.span(), message))
}

fn generator(
    source: &Source,
    span: Range<usize>,
    raw: &GenerateSpec,
    points: [usize; 2],
    heights: Heights,
) -> Result<SurfaceGenerator, InputError> {
    let missing = |key: &str| {
        source.error_at(
            span.clone(),
            format!("found no {key}; allowed: pixel and sigma, or summits = {{ radius, sigma, density }}"),
        )
    };
    let pixel = raw.pixel.as_ref().ok_or_else(|| missing("pixel"))?.get_ref().0;
    let sigma = raw.sigma.as_ref().ok_or_else(|| missing("sigma"))?.get_ref().value();
    let of = raw.spectrum_of.as_ref().map(|of| *of.get_ref()).unwrap_or_default();
    let process = Process { spectrum: spectrum(source, &raw.spectrum, points, pixel)?, of, sigma, heights };
    let plateau = raw.plateau.as_ref().map(|plateau| {
        let PlateauSpec { sigma, spectrum: raw, height } = plateau.get_ref();
        let spectrum = spectrum(source, raw, points, pixel)?;
        let process =
            Process { spectrum, of: SpectrumOf::Heights, sigma: sigma.value(), heights: Heights::GAUSSIAN };
        Ok(Plateau { process, height: height.value() })
    });
    Ok(SurfaceGenerator { points, pixel, process, plateau: plateau.transpose()? })
}

/// A spectrum by its lengths, which the grid must show.
fn spectrum(
    source: &Source,
    raw: &Spanned<SpectrumSpec>,
    points: [usize; 2],
    pixel: [f64; 2],
) -> Result<Spectrum, InputError> {
    let refuse = |message: &dyn std::fmt::Display| source.error_at(raw.span(), message);
    let made = match raw.get_ref() {
        SpectrumSpec::SelfAffine(self_affine) => {
            let SelfAffineSpec { hurst, roll_off, cut_off, cut_off_pixels, .. } = self_affine;
            if cut_off_pixels.is_some() {
                return Err(refuse(
                    &"found cut-off-pixels without summits; allowed here: roll-off and cut-off, as wavelengths",
                ));
            }
            let (Some(roll_off), Some(cut_off)) = (roll_off, cut_off) else {
                let missing = if roll_off.is_none() { "roll-off" } else { "cut-off" };
                return Err(refuse(&format!(
                    "found a self-affine spectrum without {missing}; allowed: hurst, roll-off and cut-off, the longest and \
                     the shortest wavelength of the power law"
                )));
            };
            let (roll_off, cut_off) = (roll_off.value(), cut_off.value());
            let lay = lay(self_affine.elongation.map_or(1.0, |e| e.value()), self_affine.angle);
            let lay = lay.map_err(|error| refuse(&error))?;
            Spectrum::new(SpectrumShape::SelfAffine { hurst: hurst.value(), roll_off, cut_off }, lay)
        }
        SpectrumSpec::Gaussian(CorrelationSpec { correlation_length, angle })
        | SpectrumSpec::Exponential(CorrelationSpec { correlation_length, angle }) => {
            let [along, across] = correlation_length.0;
            let is_gaussian = matches!(raw.get_ref(), SpectrumSpec::Gaussian(_));
            let shape = if is_gaussian {
                SpectrumShape::Gaussian(across)
            } else {
                SpectrumShape::Exponential(across)
            };
            Spectrum::new(shape, lay(along / across, *angle).map_err(|error| refuse(&error))?)
        }
    };
    let made = made.and_then(|spectrum| spectrum.check(points, pixel).map(|()| spectrum));
    made.map_err(|error| refuse(&error))
}

/// A lay by its lengths along over those across, and its angle.
fn lay(elongation: f64, angle: Option<Quantity<Angle, Finite>>) -> Result<Lay, String> {
    let Some(angle) = angle.map(|angle| angle.value()) else { return Ok(Lay { elongation, angle: 0.0 }) };
    if angle.abs() > TAU {
        return Err(format!(
            "found an angle of {angle} rad; allowed: at most a full turn, such as \"30 deg\" (a bare number is in rad)"
        ));
    }
    if elongation == 1.0 {
        return Err("found an angle without a lay; allowed: with two different correlation lengths, along the lay and across \
                    it, or with an elongation"
            .to_owned());
    }
    Ok(Lay { elongation, angle })
}

/// A generator whose scales and bandwidth follow from a target.
fn target_recipe(
    source: &Source,
    raw: &GenerateSpec,
    points: [usize; 2],
    heights: Heights,
) -> Result<TargetGenerator, InputError> {
    /// A quarter of the Nyquist wave number: summits are well resolved.
    const CUT_OFF: f64 = 8.0;
    let with_summits = |span: Range<usize>, key: &str| {
        source.error_at(
            span,
            format!("found {key} together with summits, which determine it; allowed: one of the two"),
        )
    };
    if let Some(pixel) = &raw.pixel {
        return Err(with_summits(pixel.span(), "pixel"));
    }
    if let Some(sigma) = &raw.sigma {
        return Err(with_summits(sigma.span(), "sigma"));
    }
    if let Some(of) = &raw.spectrum_of {
        return Err(with_summits(of.span(), "spectrum-of"));
    }
    if let Some(plateau) = &raw.plateau {
        return Err(source.error_at(
            plateau.span(),
            "found plateau together with summits, which are only available for a single process; allowed: one of the two",
        ));
    }
    let refuse = |message: &dyn std::fmt::Display| source.error_at(raw.spectrum.span(), message);
    let SpectrumSpec::SelfAffine(self_affine) = raw.spectrum.get_ref() else {
        return Err(refuse(
            &"found a spectrum of fixed bandwidth; allowed with summits: self-affine, whose bandwidth can be adjusted",
        ));
    };
    if self_affine.roll_off.is_some() || self_affine.cut_off.is_some() {
        return Err(refuse(
            &"found roll-off or cut-off together with summits, which determine them; allowed: hurst, cut-off-pixels, elongation, angle",
        ));
    }
    let generator = TargetGenerator {
        points,
        hurst: self_affine.hurst.value(),
        cut_off: self_affine.cut_off_pixels.map_or(CUT_OFF, |pixels| pixels.value()),
        lay: lay(self_affine.elongation.map_or(1.0, |e| e.value()), self_affine.angle)
            .map_err(|error| refuse(&error))?,
        heights,
        neighbours: raw.neighbours,
    };
    generator.check().map_err(|error| refuse(&error))?;
    Ok(generator)
}

/// A random rough surface: either pixel, sigma and the lengths of its spectrum, or what its summits shall be.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table with points, spectrum, and either pixel and sigma or summits"
)]
pub struct GenerateSpec {
    /// Points along both axes, or along x and along y.
    #[schemars(extend("x-range" = "8 to 1048576", "examples" = [1024, [1024, 512]]))]
    pub points: Spanned<PointsSpec>,
    /// Distance of the points; not with `summits`.
    #[schemars(extend("examples" = ["0.5 um"]))]
    pub pixel: Option<Spanned<PixelSpec>>,
    /// Standard deviation of the surface heights; not with `summits`.
    #[schemars(extend("examples" = ["0.25 um"]))]
    pub sigma: Option<Spanned<Quantity<Length, SigmaRange>>>,
    /// How the variance is spread over the wavelengths.
    #[schemars(extend("examples" = [{ "self-affine": { "hurst": 0.8, "roll-off": "40 um", "cut-off": "4 um" } }]))]
    pub spectrum: Spanned<SpectrumSpec>,
    /// Distribution of the surface heights.
    #[schemars(extend("default" = "gaussian", "examples" = [{ "johnson": { "skewness": -1, "kurtosis": 4.5 } }]))]
    pub heights: Option<HeightsSpec>,
    /// Which field has the spectrum, where heights are transformed; not with `summits`.
    #[schemars(extend("default" = "heights", "examples" = ["gaussian"]))]
    pub spectrum_of: Option<Spanned<SpectrumOf>>,
    /// A finer process that cuts the summits off, as in plateau honing; not with `summits`.
    #[schemars(extend("x-default" = "none", "examples" = [{ "sigma": "0.05 um", "height": "0.2 um", "spectrum": { "gaussian": { "correlation-length": "5 um" } } }]))]
    pub plateau: Option<Spanned<PlateauSpec>>,
    /// What the summits found on the surface shall have; pixel and wavelengths follow.
    #[schemars(extend("x-default" = "none", "examples" = [{ "radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2" }]))]
    pub summits: Option<Spanned<TargetSpec>>,
    /// Which neighbours a summit is higher than.
    #[serde(default)]
    #[schemars(extend("default" = "four", "examples" = ["eight"]))]
    pub neighbours: Neighbours,
    /// How many surfaces are generated; their scatter gives the intervals.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 1, "examples" = [8]))]
    pub realisations: Option<Spanned<Whole>>,
}

/// The numbers that a surface and its found summits shall have.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { radius, sigma, density, heights }")]
pub struct TargetSpec {
    /// Arithmetic mean of the radii of the summits.
    #[schemars(extend("examples" = ["20 um"]))]
    pub radius: Quantity<Length>,
    /// Standard deviation of the heights of the summits, or of the surface.
    #[schemars(extend("examples" = ["48 nm"]))]
    pub sigma: Quantity<Length, SigmaRange>,
    /// Summits per area.
    #[schemars(extend("examples" = ["6e10 /m^2"]))]
    pub density: Quantity<ArealNumberDensity>,
    /// Whose standard deviation sigma is, and whose mean separations are measured from.
    #[serde(default)]
    #[schemars(extend("default" = "summits", "examples" = ["surface"]))]
    pub heights: SigmaOf,
}

/// A process that cuts the summits off.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { sigma, spectrum, height }")]
pub struct PlateauSpec {
    /// Standard deviation of its heights.
    #[schemars(extend("examples" = ["0.05 um"]))]
    pub sigma: Quantity<Length, SigmaRange>,
    /// Its spectrum.
    #[schemars(extend("x-type" = "a table as `spectrum` of the surface", "examples" = [{ "gaussian": { "correlation-length": "5 um" } }]))]
    pub spectrum: Spanned<SpectrumSpec>,
    /// Height of its mean plane above that of the surface that it cuts.
    #[schemars(extend("examples" = ["0.2 um"]))]
    pub height: Quantity<Length, Finite>,
}

/// A spectrum: a table with its name as the only key.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpectrumSpec {
    /// A power law between two wavelengths, constant above the longer one.
    SelfAffine(SelfAffineSpec),
    /// The autocorrelation exp(-(r/l)^2), l the correlation length.
    Gaussian(CorrelationSpec),
    /// The autocorrelation exp(-r/l).
    Exponential(CorrelationSpec),
}

/// A self-affine spectrum; with `summits` its wavelengths are found and only `cut-off-pixels` may be given.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { hurst, roll-off, cut-off }")]
pub struct SelfAffineSpec {
    /// Hurst exponent.
    #[schemars(extend("x-range" = "0 to 1", "examples" = [0.8]))]
    pub hurst: Quantity<Pure, Finite>,
    /// Longest wavelength of the power law; not with `summits`.
    #[schemars(extend("examples" = ["40 um"]))]
    pub roll_off: Option<Quantity<Length>>,
    /// Shortest wavelength; not with `summits`.
    #[schemars(extend("examples" = ["4 um"]))]
    pub cut_off: Option<Quantity<Length>>,
    /// Shortest wavelength in pixels; only with `summits`.
    #[schemars(extend("default" = 8, "x-range" = "at least 2", "examples" = [8]))]
    pub cut_off_pixels: Option<Quantity<Pure, Finite>>,
    /// Lengths along the lay over those across it.
    #[schemars(extend("default" = 1, "examples" = [4]))]
    pub elongation: Option<Quantity<Pure, Finite>>,
    /// From the x axis to the lay; only with a lay.
    #[schemars(extend("default" = 0, "x-range" = "up to a full turn", "examples" = ["30 deg"]))]
    pub angle: Option<Quantity<Angle, Finite>>,
}

/// One correlation length, or one along the lay and one across it.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", expecting = "a table { correlation-length }")]
pub struct CorrelationSpec {
    /// One correlation length, or one along the lay and one across it.
    #[schemars(extend("x-type" = "length, or a list of two: along the lay and across it", "examples" = ["20 um", ["20 um", "5 um"]]))]
    pub correlation_length: PixelSpec,
    /// From the x axis to the lay; only with a lay.
    #[schemars(extend("default" = 0, "x-range" = "up to a full turn", "examples" = ["30 deg"]))]
    pub angle: Option<Quantity<Angle, Finite>>,
}

/// One number of points, or one along x and one along y.
#[derive(Debug, Clone, Copy)]
pub struct PointsSpec(pub [u64; 2]);

written_schema!(PointsSpec, |_| schema::one_or_many(
    json!({ "type": "integer", "minimum": 1 }),
    "whole number, or a list of two: along x and along y"
));

impl<'de> Deserialize<'de> for PointsSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number of points such as 1024, or a list of two: along x and along y";
        let counts = OneOrMany::<Whole>::read(deserializer, expected)?.along_both("numbers")?;
        Ok(Self(counts.map(|count| count.0)))
    }
}
