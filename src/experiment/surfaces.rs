//! The surfaces of an experiment: planned from the spec, then made or read.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sha2::{Digest, Sha256};
use toml::Spanned;

use super::refusal::{Refusal, Source};
use super::spec::{DrawSpec, FileSpec, ListSpec, PopulationHeights, PopulationSpec, SurfaceSpec};
use crate::asperity::{
    AsperitySet, Draw, HeightDensity, Ordered, Population, Statistics, SurfaceHeights, read_list,
};
use crate::model::{Datum, MeanRadius};
use crate::surface::filter::Filter;
use crate::surface::level::Level;

/// A surface that can be made.
#[derive(Debug)]
pub struct SurfacePlan {
    /// Its name in the spec.
    pub name: String,
    /// Where the spec says how large it is.
    pub size_key: Range<usize>,
    origin: Origin,
}

#[derive(Debug)]
enum Origin {
    List { path: PathBuf, nominal_area: f64 },
    Population { population: Population, count: usize, draw: DrawSpec, datum: Datum },
    Map { path: PathBuf, pixel: Option<[f64; 2]>, level: Level, filter: Filter },
}

/// Bytes that a set of `count` asperities and its ordered copies need at their peak.
pub fn set_memory(count: u128) -> u128 {
    const BYTES_PER_ASPERITY: u128 = 48;
    count * BYTES_PER_ASPERITY
}

impl SurfacePlan {
    /// Looks at everything about a surface that can be known before it is made.
    ///
    /// # Errors
    /// A file that is missing or is not what it should be; numbers that make no surface.
    pub fn new(
        source: &Source,
        name: &Spanned<String>,
        words: &Spanned<SurfaceSpec>,
    ) -> Result<Self, Refusal> {
        let (origin, size_key) = match words.get_ref() {
            SurfaceSpec::Asperities(list) => (Self::list(source, list)?, list.file.span()),
            SurfaceSpec::Population(population) => {
                (Self::population(source, words.span(), population)?, population.count.span())
            }
            SurfaceSpec::File(file) => (Self::map(source, file)?, file.path.span()),
        };
        Ok(Self { name: name.get_ref().clone(), size_key, origin })
    }

    fn list(source: &Source, words: &ListSpec) -> Result<Origin, Refusal> {
        let path = existing(source, &words.file)?;
        Ok(Origin::List { path, nominal_area: words.nominal_area.value() })
    }

    fn population(source: &Source, span: Range<usize>, words: &PopulationSpec) -> Result<Origin, Refusal> {
        let count = *words.count.get_ref();
        let count = usize::try_from(count).ok().filter(|&count| count > 0).ok_or_else(|| {
            source.refuse(words.count.span(), format!("found {count}; allowed: at least one asperity"))
        })?;
        let (radius, sigma, density) = (words.radius.value(), words.sigma.value(), words.density.value());
        let mut population = Population { radius, sigma, density, heights: HeightDensity::Gaussian };
        let mut datum = Datum { mean: 0.0, sigma };
        match words.heights {
            PopulationHeights::Gaussian => {}
            PopulationHeights::Exponential => population.heights = HeightDensity::Exponential,
            PopulationHeights::Surface => {
                let surface = SurfaceHeights { radius, sigma, density };
                population.sigma = surface.asperity_sigma().map_err(|error| source.refuse(span, error))?;
                datum.mean = -surface.mean_asperity_height();
            }
        }
        Ok(Origin::Population { population, count, draw: words.draw, datum })
    }

    fn map(source: &Source, words: &FileSpec) -> Result<Origin, Refusal> {
        let path = existing(source, &words.path)?;
        let pixel = words.pixel.as_ref().map(|pixel| pixel.get_ref().0);
        let filter = match &words.filter {
            None => Filter::default(),
            Some(filter) => {
                let index = |quantity: Option<crate::units::Quantity<_>>| quantity.map(|q| q.value());
                Filter::new(index(filter.get_ref().s), index(filter.get_ref().l))
                    .map_err(|error| source.refuse(filter.span(), error))?
            }
        };
        Ok(Origin::Map { path, pixel, level: words.level, filter })
    }

    /// The file that it is read from.
    pub fn input(&self) -> Option<PathBuf> {
        match &self.origin {
            Origin::List { path, .. } | Origin::Map { path, .. } => Some(path.clone()),
            Origin::Population { .. } => None,
        }
    }
}
