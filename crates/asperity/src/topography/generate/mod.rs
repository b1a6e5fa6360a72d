//! Periodic random rough surfaces of a given spectrum and height distribution.

mod fitted;
mod gaussian;
mod own_heights;
mod target;

pub use fitted::{FEWEST_LENGTHS, FittedProcess, Unfitted, roughness_scatter};
pub use gaussian::gaussian;
pub use target::{Reached, SigmaOf, Target, TargetGenerator, Unreachable};

use std::sync::atomic::{AtomicUsize, Ordering};

use super::height_transform::{Distortion, map_normals};
use super::spectrum::{GridSpectrum, Spectrum, SpectrumError};
use super::{HeightMap, MapError};
use crate::distribution::Heights;
use crate::numeric::parallel::for_each_row;
use crate::numeric::sum::{CHUNK, sum_of};
use crate::progress::{Progress, Share, Silent};

/// A random process: a Gaussian surface whose heights are transformed to a distribution.
#[derive(Debug, Clone, PartialEq)]
pub struct Process {
    /// The prescribed spectrum, of the field given by [`Self::of`].
    pub spectrum: Spectrum,
    /// The field that has the spectrum.
    pub of: SpectrumOf,
    /// Standard deviation of the heights of an infinite surface, m.
    pub sigma: f64,
    /// Distribution of the heights.
    pub heights: Heights,
}

/// The field that has the prescribed spectrum, which the transform of heights distorts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize))]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SpectrumOf {
    /// The surface: the spectrum of the Gaussian field is corrected for the transform, as far as possible.
    #[default]
    Heights,
    /// The Gaussian field, before its heights are transformed.
    Gaussian,
}

/// A finer process that truncates the summits of a coarser one, as in plateau honing: the surface is the lower of both.
#[derive(Debug, Clone, PartialEq)]
pub struct Plateau {
    /// The finer process.
    pub process: Process,
    /// Height of its mean plane above that of the coarser surface, m.
    pub height: f64,
}

/// A generator of surfaces on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceGenerator {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Distance of neighbouring points along x and y, m.
    pub pixel: [f64; 2],
    /// The process; the coarser one of two.
    pub process: Process,
    /// The process that truncates it.
    pub plateau: Option<Plateau>,
}

/// Seeds of the one or two processes of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Seeds {
    /// Seed of the process.
    pub process: [u8; 32],
    /// Seed of the process that truncates it.
    pub plateau: [u8; 32],
}

impl SurfaceGenerator {
    /// Checks whether the grid resolves the spectra.
    ///
    /// # Errors
    /// The first spectrum that it does not resolve.
    pub fn check(&self) -> Result<(), SpectrumError> {
        self.process.spectrum.check(self.points, self.pixel)?;
        match &self.plateau {
            Some(plateau) => plateau.process.spectrum.check(self.points, self.pixel),
            None => Ok(()),
        }
    }

    /// The periodic surface, of zero mean, and the fraction of its points that belong to the plateau process, if any.
    /// Bit-identical for any number of threads.
    ///
    /// # Errors
    /// See [`MapError`].
    pub fn surface(&self, seeds: Seeds) -> Result<(HeightMap, Option<f64>), MapError> {
        self.watched_surface(seeds, &Silent)
    }

    /// [`Self::surface`] with progress: one unit of work for each process.
    ///
    /// # Errors
    /// See [`MapError`].
    pub fn watched_surface(
        &self,
        seeds: Seeds,
        progress: &dyn Progress,
    ) -> Result<(HeightMap, Option<f64>), MapError> {
        let mut heights = self.process.heights(self.points, self.pixel, seeds.process, progress);
        let share = self.plateau.as_ref().map(|plateau| {
            let finer = plateau.process.heights(self.points, self.pixel, seeds.plateau, progress);
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
    fn heights(
        &self,
        points: [usize; 2],
        pixel: [f64; 2],
        seed: [u8; 32],
        progress: &dyn Progress,
    ) -> Vec<f64> {
        let mut spectrum = self.spectrum.on_grid(points, pixel);
        if self.heights != Heights::GAUSSIAN && self.of == SpectrumOf::Heights {
            spectrum = spectrum.before(&Distortion::new(&*self.heights), progress);
        }
        field(&spectrum, &self.heights, self.sigma, seed, progress)
    }
}

/// A Gaussian surface of a spectrum with its heights transformed to a distribution.
fn field(
    spectrum: &GridSpectrum,
    heights: &Heights,
    sigma: f64,
    seed: [u8; 32],
    progress: &dyn Progress,
) -> Vec<f64> {
    if *heights == Heights::GAUSSIAN {
        return gaussian::watched(spectrum, sigma, seed, progress);
    }
    let half = &Share { progress, units: 0.5 };
    let mut field = gaussian::watched(spectrum, 1.0, seed, half);
    map_normals(&**heights, &mut field, sigma, half);
    centre(&mut field);
    field
}

/// Moves the mean to zero.
fn centre(heights: &mut [f64]) {
    let mean = sum_of(heights.len(), |k| heights[k]) / heights.len() as f64;
    for_each_row(heights, CHUNK, &|_, heights| heights.iter_mut().for_each(|z| *z -= mean));
}
