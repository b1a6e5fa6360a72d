//! Random rough surfaces: periodic, of a given spectrum, with Gaussian or other heights.

mod gaussian;
mod target;

pub use gaussian::gaussian;
pub use target::{Reached, Target, TargetGenerator, Unreachable};

use std::sync::atomic::{AtomicUsize, Ordering};

use super::height_transform::{Distortion, map_normals};
use super::spectrum::{GridSpectrum, Spectrum, SpectrumError};
use super::{HeightMap, MapError};
use crate::distribution::Heights;
use crate::numeric::parallel::for_each_row;
use crate::numeric::sum::{CHUNK, sum_of};

/// A process that makes rough surfaces: a Gaussian surface whose heights are mapped to a distribution.
#[derive(Debug, Clone, PartialEq)]
pub struct Process {
    /// How the variance is spread over the waves, of the field that [`Self::of`] names.
    pub spectrum: Spectrum,
    /// Whose spectrum it is.
    pub of: SpectrumOf,
    /// Standard deviation of the heights of an endless surface, m.
    pub sigma: f64,
    /// Distribution of the heights.
    pub heights: Heights,
}

/// The field that has the prescribed spectrum. Mapping the heights to a distribution distorts it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SpectrumOf {
    /// The surface: the Gaussian field is given the spectrum that becomes it, as far as there is one.
    #[default]
    Heights,
    /// The Gaussian field before its heights are mapped.
    Gaussian,
}

/// A finer process that cuts the summits of a coarser one, as honing does: the lower of the two surfaces is
/// left.
#[derive(Debug, Clone, PartialEq)]
pub struct Plateau {
    /// The process that cuts.
    pub process: Process,
    /// Height of its mean plane above that of the coarser surface, m.
    pub height: f64,
}

/// What makes a surface on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceGenerator {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Their distances along x and y, m.
    pub pixel: [f64; 2],
    /// The process, the coarser one of two.
    pub process: Process,
    /// The process that cuts it.
    pub plateau: Option<Plateau>,
}

/// Seeds of the one or two processes of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seeds {
    /// Seed of the process.
    pub process: [u8; 32],
    /// Seed of the process that cuts it.
    pub plateau: [u8; 32],
}

impl SurfaceGenerator {
    /// Whether the grid can show the spectra.
    ///
    /// # Errors
    /// The first that it cannot.
    pub fn check(&self) -> Result<(), SpectrumError> {
        self.process.spectrum.check(self.points, self.pixel)?;
        match &self.plateau {
            Some(plateau) => plateau.process.spectrum.check(self.points, self.pixel),
            None => Ok(()),
        }
    }

    /// The surface, periodic, its mean plane at zero, and which share of its points a finer process has cut; the same to
    /// the bit on any number of threads.
    ///
    /// # Errors
    /// A grid that makes no map.
    pub fn surface(&self, seeds: Seeds) -> Result<(HeightMap, Option<f64>), MapError> {
        let mut heights = self.process.heights(self.points, self.pixel, seeds.process);
        let share = self.plateau.as_ref().map(|plateau| {
            let finer = plateau.process.heights(self.points, self.pixel, seeds.plateau);
            let cut = AtomicUsize::new(0);
            for_each_row(&mut heights, CHUNK, &|k, heights| {
                for (z, finer) in heights.iter_mut().zip(&finer[k * CHUNK..]) {
                    let finer = finer + plateau.height;
                    if finer < *z {
                        *z = finer;
                        cut.fetch_add(1, Ordering::Relaxed);
                    }
                }
            });
            centre(&mut heights);
            cut.into_inner() as f64 / heights.len() as f64
        });
        let map = HeightMap::new(self.points, self.pixel, heights, f64::EPSILON)?.periodic();
        Ok((map, share))
    }
}

impl Process {
    fn heights(&self, points: [usize; 2], pixel: [f64; 2], seed: [u8; 32]) -> Vec<f64> {
        let mut spectrum = self.spectrum.on_grid(points, pixel);
        if self.heights != Heights::GAUSSIAN && self.of == SpectrumOf::Heights {
            spectrum = spectrum.before(&Distortion::new(&*self.heights));
        }
        field(&spectrum, &self.heights, self.sigma, seed)
    }
}

/// Heights of a distribution on a Gaussian surface of a spectrum.
fn field(spectrum: &GridSpectrum, heights: &Heights, sigma: f64, seed: [u8; 32]) -> Vec<f64> {
    if *heights == Heights::GAUSSIAN {
        return gaussian(spectrum, sigma, seed);
    }
    let mut field = gaussian(spectrum, 1.0, seed);
    map_normals(&**heights, &mut field, sigma);
    centre(&mut field);
    field
}

/// Moves the mean to zero.
fn centre(heights: &mut [f64]) {
    let mean = sum_of(heights.len(), |k| heights[k]) / heights.len() as f64;
    for_each_row(heights, CHUNK, &|_, heights| heights.iter_mut().for_each(|z| *z -= mean));
}
