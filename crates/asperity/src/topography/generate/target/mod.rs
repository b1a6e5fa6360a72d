//! Surfaces whose summits have a prescribed mean radius and density, and a prescribed standard deviation of the heights of
//! the summits or of the surface.
//!
//! The product density * radius * sigma is invariant to scaling of heights and lengths and depends on the bandwidth of
//! the spectrum only. The product of a map scatters about that of its spectrum as summits come and go, on every scale of the
//! bandwidth, so that a secant from map to map gains little. Therefore two fields of the same random numbers are made, on both
//! sides of the bandwidth at which the product is expected, and the surface is a weighted sum of both; then heights are
//! scaled to sigma and lengths to the density.

mod mix;
mod start;
#[cfg(test)]
mod tests;

use mix::{Field, Mixtures};

use super::gaussian;
use crate::distribution::Heights;
use crate::numeric::parallel::map;
use crate::numeric::sum::CHUNK;
use crate::progress::{Progress, Silent};
use crate::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use crate::topography::summits::Neighbours;
use crate::topography::{HeightMap, MapError};

/// The heights that a prescribed standard deviation refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize))]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SigmaOf {
    /// Those of the summits.
    #[default]
    Summits,
    /// Those of all points of the map, about their mean: sigma is Sq.
    Surface,
}

/// Prescribed statistics of a surface and its summits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// Arithmetic mean of the radii, m.
    pub radius: f64,
    /// Standard deviation of the heights, m.
    pub sigma: f64,
    /// Of which heights.
    pub sigma_of: SigmaOf,
    /// Summits per area, 1/m^2.
    pub density: f64,
}

impl Target {
    /// density * radius * sigma.
    pub fn product(&self) -> f64 {
        self.density * self.radius * self.sigma
    }
}

/// A generator of self-affine surfaces whose scales and bandwidth follow from a [`Target`].
#[derive(Debug, Clone, PartialEq)]
pub struct TargetGenerator {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Hurst exponent.
    pub hurst: f64,
    /// Shortest wavelength, in pixels.
    pub cut_off: f64,
    /// The lay.
    pub lay: Lay,
    /// Distribution of the heights.
    pub heights: Heights,
    /// Neighbours that define a summit.
    pub neighbours: Neighbours,
}

/// A surface that meets a target.
#[derive(Debug, Clone)]
pub struct Reached {
    /// The surface.
    pub map: HeightMap,
    /// The spectrum of the Gaussian field, between two whose roll-offs differ by at most a fifth.
    pub spectrum: Spectrum,
    /// Roll-off wavelength, weighted, over cut-off wavelength.
    pub bandwidth: f64,
    /// Standard deviation of the surface heights of the process, m.
    pub sigma: f64,
    /// Number of fields generated.
    pub tried: usize,
}

/// A target that cannot be met.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum Unreachable {
    /// The product is outside the range found.
    #[error(
        "density * radius * sigma = {product:.5} is not reached: with this grid, these heights and Hurst exponent it ranges from \
         {least:.5} (a ratio of roll-off to cut-off of {from:.3}) to {most:.5} (of {to:.3}); allowed: a product in this range, or \
         other heights, another Hurst exponent, another cut-off-pixels or more points"
    )]
    Product { product: f64, least: f64, from: f64, most: f64, to: f64 },
    /// The product jumps across the prescribed value.
    #[error(
        "density * radius * sigma = {product:.5} lies in a jump, from {below:.5} to {above:.5}: the map holds too few summits; \
         allowed: more points"
    )]
    Jump { product: f64, below: f64, above: f64 },
    /// The map is too small for a bandwidth above 1.
    #[error(
        "found {} x {} points; allowed with summits: more than {least} along each axis, so that four waves of the cut-off, and longer \
         ones, fit (fewer with a smaller cut-off-pixels or elongation)",
        points[0], points[1]
    )]
    TooFewPoints { points: [usize; 2], least: usize },
    /// A spectrum that the grid does not resolve.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// An invalid grid.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// The widest difference of the logarithms of the bandwidths of two fields whose sum is a surface.
const WIDEST: f64 = 0.2;
/// One of so many chunks gives a sign of progress.
const SIGNS: usize = 64;
/// Tolerance of the product, and thus of the radius, relative.
const TOLERANCE: f64 = 5e-5;
/// Relative deviation accepted where the product jumps.
const TOLERANCE_AT_JUMP: f64 = 1e-3;

impl TargetGenerator {
    /// Checks whether the grid resolves the spectra.
    ///
    /// # Errors
    /// A cut-off below two pixels, an invalid spectrum, or a map too small for longer waves.
    pub fn check(&self) -> Result<(), Unreachable> {
        self.spectrum(1.0)?.check(self.points, [1.0; 2])?;
        if self.widest() > 1.0 {
            return Ok(());
        }
        let least = (self.points[0].min(self.points[1]) as f64 / self.widest()).round() as usize;
        Err(Unreachable::TooFewPoints { points: self.points, least })
    }

    /// The largest bandwidth: four of the longest waves fit into the shorter side.
    fn widest(&self) -> f64 {
        let side = self.points[0].min(self.points[1]) as f64;
        side / (4.0 * self.cut_off * self.lay.elongation.max(1.0))
    }

    fn spectrum(&self, bandwidth: f64) -> Result<Spectrum, SpectrumError> {
        let shape = SpectrumShape::SelfAffine {
            hurst: self.hurst,
            roll_off: bandwidth * self.cut_off,
            cut_off: self.cut_off,
        };
        Spectrum::new(shape, self.lay)
    }

    /// A spectrum between those of two bandwidths.
    fn between(&self, bandwidths: [f64; 2], weight: f64, pixel: f64) -> Result<Spectrum, SpectrumError> {
        let cut_off = self.cut_off * pixel;
        let roll_offs = bandwidths.map(|bandwidth| bandwidth * cut_off);
        Spectrum::new(SpectrumShape::Between { hurst: self.hurst, roll_offs, weight, cut_off }, self.lay)
    }

    fn field(
        &self,
        log_bandwidth: f64,
        seed: [u8; 32],
        sigma_of: SigmaOf,
        progress: &dyn Progress,
    ) -> Result<Field, Unreachable> {
        let spectrum = self.spectrum(log_bandwidth.exp())?;
        spectrum.check(self.points, [1.0; 2])?;
        let heights = gaussian::watched(&spectrum.on_grid(self.points, [1.0; 2]), 1.0, seed, progress);
        let transformed_sq = (sigma_of == SigmaOf::Surface && self.heights != Heights::GAUSSIAN).then(|| {
            let chunks = map(heights.len().div_ceil(CHUNK), |k| {
                if k.is_multiple_of(SIGNS) {
                    progress.advance(0.0);
                }
                let mut chunk = heights[k * CHUNK..heights.len().min((k + 1) * CHUNK)].to_vec();
                self.heights.map_normals(&mut chunk, 1.0);
                sums(&chunk)
            });
            mean_and_sq(&chunks, heights.len())[1]
        });
        Ok(Field { log_bandwidth, heights, transformed_sq })
    }

    /// The surface of a seed that meets the target. All fields have the same random numbers, so that the product is a
    /// function of the bandwidth only. The search begins at `first`, a bandwidth that met the target with another seed, or
    /// where the product is expected; where that fails, bandwidths are searched from narrow to wide.
    ///
    /// # Errors
    /// See [`Unreachable`].
    pub fn surface(
        &self,
        target: &Target,
        seed: [u8; 32],
        first: Option<f64>,
    ) -> Result<Reached, Unreachable> {
        self.watched_surface(target, seed, first, &Silent)
    }

    /// [`Self::surface`] with progress: a stage for each field, since their number is not known before.
    ///
    /// # Errors
    /// See [`Unreachable`].
    pub fn watched_surface(
        &self,
        target: &Target,
        seed: [u8; 32],
        first: Option<f64>,
        progress: &dyn Progress,
    ) -> Result<Reached, Unreachable> {
        self.check()?;
        let mut tried = 0;
        let field = &mut |log_bandwidth: f64| {
            tried += 1;
            progress.stage(&format!("trial surface {tried}"), 1.0);
            self.field(log_bandwidth, seed, target.sigma_of, progress)
        };
        let search = Search { generator: self, target, progress };
        /// Where a jump lies across the target, other fields about it are tried, whose middles are off by these
        /// differences of the logarithm of the bandwidth.
        const SHIFTS: [f64; 4] = [0.03, -0.03, 0.06, -0.06];
        let mut first = first;
        let mut shifts = SHIFTS.into_iter();
        loop {
            let bracket = match search.near(first, field)? {
                Some(bracket) => bracket,
                None => search.scan(field)?,
            };
            let bracket = search.narrow(bracket, field)?;
            match (bracket.weight(target), shifts.next()) {
                (Ok(weight), _) => return self.scaled(bracket.mixtures, weight, target, tried, progress),
                (Err(jump), Some(shift)) => {
                    first = Some((bracket.mixtures.log_bandwidth(jump.weight) + shift).exp());
                }
                (Err(jump), None) => {
                    let product = target.product();
                    let [low, high] = jump.off.map(|off| product * (1.0 + off));
                    return Err(Unreachable::Jump { product, below: low.min(high), above: low.max(high) });
                }
            }
        }
    }

    /// Scales the mixture of a weight to the target.
    fn scaled(
        &self,
        mixtures: Mixtures,
        weight: f64,
        target: &Target,
        tried: usize,
        progress: &dyn Progress,
    ) -> Result<Reached, Unreachable> {
        let summits = mixtures.summits(weight);
        let bandwidth = mixtures.log_bandwidth(weight).exp();
        let bandwidths = mixtures.ends.each_ref().map(|end| end.log_bandwidth.exp());
        let pixel = (summits.density / target.density).sqrt();
        let scale = |sq: f64| match target.sigma_of {
            SigmaOf::Summits => target.sigma / summits.sigma,
            SigmaOf::Surface => target.sigma / sq,
        };
        let (heights, scale) = mixtures.into_heights(weight, scale, progress);
        Ok(Reached {
            map: HeightMap::new(self.points, [pixel; 2], heights, f64::EPSILON)?.periodic(),
            spectrum: self.between(bandwidths, weight, pixel)?,
            bandwidth,
            sigma: scale,
            tried,
        })
    }
}

/// The sum of values and that of their squares.
fn sums(values: &[f64]) -> [f64; 2] {
    let (eights, rest) = values.as_chunks::<8>();
    let mut lanes = [[0.0; 8]; 2];
    for eight in eights {
        for k in 0..8 {
            lanes[0][k] += eight[k];
            lanes[1][k] += eight[k] * eight[k];
        }
    }
    let [sum, square] = lanes.map(|lanes| lanes.iter().sum::<f64>());
    rest.iter().fold([sum, square], |[sum, square], z| [sum + z, square + z * z])
}

/// Mean and standard deviation of `count` values, from the sums of parts and of their squares.
fn mean_and_sq(parts: &[[f64; 2]], count: usize) -> [f64; 2] {
    let [mean, square] = [0, 1].map(|k| parts.iter().map(|part| part[k]).sum::<f64>() / count as f64);
    [mean, (square - mean * mean).sqrt()]
}

/// A search for two fields on both sides of a target. Fields are made by functions of the logarithm of the bandwidth.
struct Search<'a> {
    generator: &'a TargetGenerator,
    target: &'a Target,
    progress: &'a dyn Progress,
}

/// Mixtures with the relative deviations of their ends' products from the target's.
struct Bracket<'a> {
    mixtures: Mixtures<'a>,
    off: [f64; 2],
}

/// A weight at which the product jumps across the target, and its deviations on both sides.
struct Jump {
    weight: f64,
    off: [f64; 2],
}

impl Bracket<'_> {
    /// Whether the target lies between the ends.
    fn holds(&self) -> bool {
        (self.off[0] <= 0.0) != (self.off[1] <= 0.0)
    }

    /// The relative deviation at a weight.
    fn off(&self, weight: f64, target: &Target) -> f64 {
        self.mixtures.summits(weight).product() / target.product() - 1.0
    }

    /// A weight that meets the target.
    fn weight(&self, target: &Target) -> Result<f64, Jump> {
        /// Equal parts of all weights, and halvings of the distance from a jump, in which others are looked for: the radius of
        /// the summit that appears there falls fast, and with it the product.
        const PARTS: u32 = 32;
        const HALVINGS: i32 = 20;
        let jump = match self.weight_between([0.0, 1.0], self.off, target) {
            Ok(weight) => return Ok(weight),
            Err(jump) => jump,
        };
        let parts = (0..=PARTS).map(|k| f64::from(k) / f64::from(PARTS));
        let near = (1..HALVINGS).flat_map(|k| [-1.0, 1.0].map(|side| jump.weight + side * 0.5f64.powi(k)));
        let mut weights: Vec<f64> = parts.chain(near).filter(|weight| (0.0..=1.0).contains(weight)).collect();
        weights.sort_by(f64::total_cmp);
        let ends: Vec<[f64; 2]> = weights.iter().map(|&weight| [weight, self.off(weight, target)]).collect();
        let parts = ends.windows(2).map(|pair| [0, 1].map(|k| [pair[0][k], pair[1][k]]));
        let mut found = parts
            .filter(|[_, off]| (off[0] <= 0.0) != (off[1] <= 0.0))
            .filter_map(|[weights, off]| self.weight_between(weights, off, target).ok());
        found.next().ok_or(jump)
    }

    /// A weight between two on both sides of the target, by regula falsi with the Illinois weights (Dowell and Jarratt 1971).
    fn weight_between(&self, mut weights: [f64; 2], mut off: [f64; 2], target: &Target) -> Result<f64, Jump> {
        /// Smallest difference of weights: the product is a step function on the scale of single summits.
        const CLOSEST: f64 = 1e-6;
        // Those of the secant.
        let mut values = off;
        let mut last = None;
        loop {
            let nearest = usize::from(off[1].abs() < off[0].abs());
            let is_closed = weights[1] - weights[0] < CLOSEST;
            if off[nearest].abs() < TOLERANCE || (is_closed && off[nearest].abs() < TOLERANCE_AT_JUMP) {
                return Ok(weights[nearest]);
            }
            if is_closed {
                return Err(Jump { weight: weights[nearest], off });
            }
            let secant = (weights[0] * values[1] - weights[1] * values[0]) / (values[1] - values[0]);
            let found = self.off(secant, target);
            let end = usize::from((found <= 0.0) == (off[1] <= 0.0));
            (weights[end], off[end], values[end]) = (secant, found, found);
            // An end retained twice counts half.
            if last == Some(end) {
                values[1 - end] *= 0.5;
            }
            last = Some(end);
        }
    }
}

impl<'a> Search<'a> {
    /// The widest step of the logarithm of the bandwidth.
    const STEP: f64 = 0.4;

    fn bracket(&self, ends: [Field; 2]) -> Result<Bracket<'a>, Unreachable> {
        let mixtures = Mixtures::new(self.generator, self.target.sigma_of, ends, self.progress)?;
        let off = [0.0, 1.0].map(|t| mixtures.summits(t).product() / self.target.product() - 1.0);
        Ok(Bracket { mixtures, off })
    }

    /// A bracket about a bandwidth that met the target with another seed, or where it is expected. `None` where the product does
    /// not rise, or an end of the bandwidths is met.
    fn near(
        &self,
        first: Option<f64>,
        field: &mut impl FnMut(f64) -> Result<Field, Unreachable>,
    ) -> Result<Option<Bracket<'a>>, Unreachable> {
        const SHIFTS: usize = 4;
        /// Half the difference of the first two, in units of the root of the square of the cut-off over the area of the map:
        /// the bandwidths of different seeds differ by about a third of it.
        const HALF: f64 = 9.0;
        const HALVES: [f64; 2] = [0.02, 0.5 * WIDEST];
        let TargetGenerator { points, cut_off, .. } = self.generator;
        let start = match first {
            Some(first) => first.ln(),
            None => match self.generator.expected_bandwidth(self.target) {
                Some(log) => log,
                None => return Ok(None),
            },
        };
        let last = self.generator.widest().ln();
        let half = HALF * cut_off / ((points[0] * points[1]) as f64).sqrt();
        let half = half.clamp(HALVES[0], HALVES[1]);
        let start = start.max(0.0).min(last);
        let mut bracket =
            self.bracket([field((start - half).max(0.0))?, field((start + half).min(last))?])?;
        for _ in 0..SHIFTS {
            if bracket.holds() {
                return Ok(Some(bracket));
            }
            let Bracket { mixtures, off: [low, high] } = bracket;
            let slope = (high - low) / mixtures.width();
            let is_above = high < 0.0;
            let from = mixtures.ends[usize::from(is_above)].log_bandwidth;
            // Beyond where a line meets the target.
            let step = (1.3 * low.abs().min(high.abs()) / slope).clamp(2.0 * half, Self::STEP);
            let next = if is_above { (from + step).min(last) } else { (from - step).max(0.0) };
            if slope <= 0.0 || next == from {
                return Ok(None);
            }
            let [a, b] = mixtures.ends;
            bracket = self.bracket(if is_above { [b, field(next)?] } else { [field(next)?, a] })?;
        }
        Ok(bracket.holds().then_some(bracket))
    }

    /// The first two bandwidths, from narrow to wide, that bracket the target.
    fn scan(
        &self,
        field: &mut impl FnMut(f64) -> Result<Field, Unreachable>,
    ) -> Result<Bracket<'a>, Unreachable> {
        let last = self.generator.widest().ln();
        let mut before = field(0.0)?;
        let mut found = Vec::new();
        while before.log_bandwidth < last {
            let next = field((before.log_bandwidth + Self::STEP).min(last))?;
            let bracket = self.bracket([before, next])?;
            if bracket.holds() {
                return Ok(bracket);
            }
            let [before_that, next] = bracket.mixtures.ends;
            let logs = [before_that.log_bandwidth, next.log_bandwidth];
            found.extend(bracket.off.into_iter().zip(logs));
            before = next;
        }
        let product = self.target.product();
        let by_product = |a: &&(f64, f64), b: &&(f64, f64)| a.0.total_cmp(&b.0);
        let [least, most] = [found.iter().min_by(by_product), found.iter().max_by(by_product)]
            .map(|end| end.map_or([f64::NAN; 2], |&(off, log)| [product * (1.0 + off), log.exp()]));
        Err(Unreachable::Product { product, least: least[0], from: least[1], most: most[0], to: most[1] })
    }

    /// Brings the ends of a bracket together until their weighted sums have the spectrum of a bandwidth in between.
    fn narrow(
        &self,
        mut bracket: Bracket<'a>,
        field: &mut impl FnMut(f64) -> Result<Field, Unreachable>,
    ) -> Result<Bracket<'a>, Unreachable> {
        /// Allowance for rounding.
        const ROUNDING: f64 = 1e-9;
        while bracket.mixtures.width() > WIDEST + ROUNDING {
            let Bracket { mixtures, off: [low, high] } = bracket;
            let next = field(mixtures.log_bandwidth((low / (low - high)).clamp(0.2, 0.8)))?;
            let [a, b] = mixtures.ends;
            bracket = self.bracket([a, next])?;
            if !bracket.holds() {
                let [_, next] = bracket.mixtures.ends;
                bracket = self.bracket([next, b])?;
            }
        }
        Ok(bracket)
    }
}
