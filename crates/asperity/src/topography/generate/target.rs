//! Surfaces whose summits have a prescribed mean radius and density, and a prescribed standard deviation of the heights of
//! the summits or of the surface.
//!
//! The product density * radius * sigma is invariant to scaling of heights and lengths and depends on the bandwidth of
//! the spectrum only. The bandwidth is found by a search; then heights are scaled to sigma and lengths to the density.

use super::field;
use crate::asperity::{AsperitySet, SetError, Statistics};
use crate::distribution::Heights;
use crate::progress::{Progress, Silent};
use crate::topography::roughness::Moments;
use crate::topography::spectrum::{Lay, Spectrum, SpectrumError, SpectrumShape};
use crate::topography::summits::{Detail, Neighbours, find};
use crate::topography::{HeightMap, MapError, Watched};

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
    /// Roll-off wavelength over cut-off wavelength.
    pub bandwidth: f64,
    /// Roll-off wavelength, m.
    pub roll_off: f64,
    /// Cut-off wavelength, m.
    pub cut_off: f64,
    /// Standard deviation of the surface heights of the process, m.
    pub sigma: f64,
    /// Number of trial surfaces.
    pub tried: usize,
}

/// A target that cannot be met.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unreachable {
    /// The product is outside the range found.
    #[error(
        "density * radius * sigma = {product:.5} is not reached: with this grid, these heights and Hurst exponent it ranges from \
         {least:.5} (a ratio of roll-off to cut-off of {from:.3}) to {most:.5} (of {to:.3}); allowed: a product in this range, or \
         other heights, another Hurst exponent, another cut-off-pixels or more points"
    )]
    Product {
        /// The prescribed product.
        product: f64,
        /// The smallest product found.
        least: f64,
        /// Its ratio of roll-off to cut-off wavelength.
        from: f64,
        /// The largest product found.
        most: f64,
        /// Its ratio of roll-off to cut-off wavelength.
        to: f64,
    },
    /// The product jumps across the prescribed value.
    #[error(
        "density * radius * sigma = {product:.5} lies in a jump, from {below:.5} to {above:.5}: the map holds too few summits; \
         allowed: more points"
    )]
    Jump {
        /// The prescribed product.
        product: f64,
        /// The nearest product below.
        below: f64,
        /// The nearest product above.
        above: f64,
    },
    /// The map is too small for a bandwidth above 1.
    #[error(
        "found {} x {} points; allowed with summits: more than {least} along each axis, so that four waves of the cut-off, and longer \
         ones, fit (fewer with a smaller cut-off-pixels or elongation)",
        points[0], points[1]
    )]
    TooFewPoints {
        /// Points along x and y.
        points: [usize; 2],
        /// The number of points that must be exceeded.
        least: usize,
    },
    /// A spectrum that the grid does not resolve.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// An invalid grid.
    #[error(transparent)]
    Map(#[from] MapError),
    /// No summit was found.
    #[error(transparent)]
    Set(#[from] SetError),
}

/// A surface of unit pixel and unit standard deviation.
struct Trial {
    log_bandwidth: f64,
    map: HeightMap,
    mean_radius: f64,
    /// Standard deviation of the heights that the target prescribes.
    sigma: f64,
    density: f64,
}

impl Trial {
    fn product(&self) -> f64 {
        self.density * self.mean_radius * self.sigma
    }
}

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
        self.spectrum(1.0, 1.0)?.check(self.points, [1.0; 2])?;
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

    fn spectrum(&self, bandwidth: f64, pixel: f64) -> Result<Spectrum, SpectrumError> {
        let cut_off = self.cut_off * pixel;
        let shape = SpectrumShape::SelfAffine { hurst: self.hurst, roll_off: bandwidth * cut_off, cut_off };
        Spectrum::new(shape, self.lay)
    }

    fn trial(
        &self,
        log_bandwidth: f64,
        seed: [u8; 32],
        sigma_of: SigmaOf,
        progress: &dyn Progress,
    ) -> Result<Trial, Unreachable> {
        let spectrum = self.spectrum(log_bandwidth.exp(), 1.0)?;
        spectrum.check(self.points, [1.0; 2])?;
        let heights = field(&spectrum.on_grid(self.points, [1.0; 2]), &self.heights, 1.0, seed, progress);
        let map = HeightMap::new(self.points, [1.0; 2], heights, f64::EPSILON)?.periodic();
        let summits = find(&Watched { map: &map, progress }, self.neighbours, Detail::default());
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        let set = AsperitySet::new(summits.heights, radii, summits.tested as f64)?;
        let statistics = Statistics::new(&set);
        let sigma = match sigma_of {
            SigmaOf::Summits => statistics.sigma,
            SigmaOf::Surface => Moments::from_rows(&map).sq,
        };
        Ok(Trial { log_bandwidth, map, mean_radius: statistics.mean_radius, sigma, density: set.density() })
    }

    /// The surface of a seed that meets the target. All trials use the same random numbers, so that the product is a
    /// function of the bandwidth only. Bandwidths are searched from narrow to wide, after those near `first`, a
    /// bandwidth that met the target with another seed.
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

    /// [`Self::surface`] with progress: a stage for each trial surface, since their number is not known before.
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
        let mut tried = 0;
        let mut trial = |log_bandwidth: f64| {
            tried += 1;
            progress.stage(&format!("trial surface {tried}"), 2.0);
            self.trial(log_bandwidth, seed, target.sigma_of, progress)
        };
        let [below, above] = match self.near(target, first, &mut trial)? {
            Some(bracket) => bracket,
            None => self.bracket(target, &mut trial)?,
        };
        let found = refine(target, below, above, &mut trial)?;
        self.scaled(found, target, tried)
    }

    /// A bracket about a bandwidth that met the target with another seed.
    fn near(
        &self,
        target: &Target,
        first: Option<f64>,
        trial: &mut impl FnMut(f64) -> Result<Trial, Unreachable>,
    ) -> Result<Option<[Trial; 2]>, Unreachable> {
        /// Relative half width: bandwidths of different seeds differ by some percent.
        const NEAR: f64 = 0.1;
        let Some(first) = first.map(f64::ln) else { return Ok(None) };
        let low = trial((first - NEAR).max(0.0))?;
        let high = trial((first + NEAR).min(self.widest().ln()))?;
        let holds = low.product() <= target.product() && target.product() <= high.product();
        Ok(holds.then_some([low, high]))
    }

    /// The first two bandwidths, from narrow to wide, that bracket the target.
    fn bracket(
        &self,
        target: &Target,
        trial: &mut impl FnMut(f64) -> Result<Trial, Unreachable>,
    ) -> Result<[Trial; 2], Unreachable> {
        /// Step of the scan in the logarithm of the bandwidth.
        const STEP: f64 = 0.4;
        let product = target.product();
        let last = self.widest().ln();
        let mut before = trial(0.0)?;
        let mut least = (before.product(), 1.0);
        let mut most = least;
        while before.log_bandwidth < last {
            let next = trial((before.log_bandwidth + STEP).min(last))?;
            if (before.product() <= product) != (next.product() <= product) {
                let rises = before.product() <= product;
                return Ok(if rises { [before, next] } else { [next, before] });
            }
            let found = (next.product(), next.log_bandwidth.exp());
            if found.0 < least.0 {
                least = found;
            }
            if found.0 > most.0 {
                most = found;
            }
            before = next;
        }
        Err(Unreachable::Product { product, least: least.0, from: least.1, most: most.0, to: most.1 })
    }

    /// Scales a trial to the target.
    fn scaled(&self, trial: Trial, target: &Target, tried: usize) -> Result<Reached, Unreachable> {
        let pixel = (trial.density / target.density).sqrt();
        let scale = target.sigma / trial.sigma;
        let mut heights = trial.map.into_heights();
        heights.iter_mut().for_each(|z| *z *= scale);
        let bandwidth = trial.log_bandwidth.exp();
        Ok(Reached {
            map: HeightMap::new(self.points, [pixel; 2], heights, f64::EPSILON)?.periodic(),
            bandwidth,
            roll_off: bandwidth * self.cut_off * pixel,
            cut_off: self.cut_off * pixel,
            sigma: scale,
            tried,
        })
    }
}

/// Closes a bracket, whose first product is not above the target's and whose second is not below it, by
/// regula falsi with the Illinois weights (Dowell and Jarratt 1971).
fn refine(
    target: &Target,
    mut below: Trial,
    mut above: Trial,
    trial: &mut impl FnMut(f64) -> Result<Trial, Unreachable>,
) -> Result<Trial, Unreachable> {
    /// Smallest bracket: the product is a step function on the scale of single summits.
    const CLOSEST: f64 = 1e-7;
    let off = |trial: &Trial| trial.product() / target.product() - 1.0;
    let (mut low, mut high) = (off(&below), off(&above));
    let mut last = None;
    loop {
        let nearest = if off(&below).abs() < off(&above).abs() { &below } else { &above };
        let is_closed = (above.log_bandwidth - below.log_bandwidth).abs() < CLOSEST;
        if off(nearest).abs() < TOLERANCE || (is_closed && off(nearest).abs() < TOLERANCE_AT_JUMP) {
            return Ok(if off(&below).abs() < off(&above).abs() { below } else { above });
        }
        if is_closed {
            let product = target.product();
            return Err(Unreachable::Jump { product, below: below.product(), above: above.product() });
        }
        let secant = (below.log_bandwidth * high - above.log_bandwidth * low) / (high - low);
        let next = trial(secant)?;
        let found = off(&next);
        let is_below = found <= 0.0;
        // The Illinois weight: an end retained twice counts half.
        let stays = if last == Some(is_below) { 0.5 } else { 1.0 };
        if is_below {
            (below, low) = (next, found);
            high *= stays;
        } else {
            (above, high) = (next, found);
            low *= stays;
        }
        last = Some(is_below);
    }
}
