//! A surface as the models and the report see it: its asperities and what is known of them.

use crate::asperity::{AsperitySet, HeightDensity, Population, SetError, Statistics};
use crate::literature::{self, Paper};
use crate::model::{Datum, MeanRadius};
use crate::surface::filter::{Filter, FilterError};
use crate::surface::level::{Level, Undetermined};
use crate::surface::quantisation::Quantisation;
use crate::surface::summits::five_point;
use crate::surface::character::Character;
use crate::surface::{HeightMap, Moments, Rows};

/// Asperities with their statistics and origin.
#[derive(Debug)]
pub struct Surface {
    /// Its name in the spec.
    pub name: String,
    /// The asperities.
    pub set: AsperitySet,
    /// Their statistics.
    pub statistics: Statistics,
    /// Where separations are measured from, in the frame of the set's heights.
    pub datum: Datum,
    /// Height of the mean plane of the surface in the frame of the set's heights, m, where it is known.
    pub mean_plane: Option<f64>,
    /// The population that it was drawn from: the statistical model then stands on its numbers.
    pub nominal: Option<Population>,
    /// The map that it was found on.
    pub map: Option<MapFacts>,
    /// What makes its numbers doubtful.
    pub warnings: Vec<String>,
}

/// What is known of a height map.
#[derive(Debug, Clone)]
pub struct MapFacts {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Their distances, m.
    pub pixel: [f64; 2],
    /// Missing points.
    pub missing: usize,
    /// Points tested for a summit.
    pub tested: usize,
    /// What was taken out.
    pub level: Level,
    /// The filters, in words.
    pub filter: Option<String>,
    /// Of the levelled, filtered map.
    pub moments: Moments,
    /// Number of summits.
    pub summits: usize,
    /// Plateaus among them, dropped ones included.
    pub plateaus: usize,
    /// Plateaus dropped for a curvature that is not positive.
    pub dropped: usize,
    /// The check for heights on steps.
    pub quantisation: Quantisation,
}

/// A map on which no asperities are found.
#[derive(Debug, thiserror::Error)]
pub(super) enum NoAsperities {
    #[error(transparent)]
    Level(#[from] Undetermined),
    #[error(transparent)]
    Filter(#[from] FilterError),
    #[error("has no summit: none of its {tested} tested points is higher than its four neighbours")]
    NoSummit { tested: usize },
    #[error(transparent)]
    Set(#[from] SetError),
}

/// Levels and filters a map and finds its summits.
pub(super) fn summits_of(
    map: &HeightMap,
    level: Level,
    filter: Option<Filter>,
) -> Result<(AsperitySet, MapFacts), NoAsperities> {
    let mut levelled = level.apply(map)?;
    if let Some(filter) = filter {
        levelled = filter.apply(levelled)?;
    }
    let summits = five_point(&levelled);
    if summits.heights.is_empty() {
        return Err(NoAsperities::NoSummit { tested: summits.tested });
    }
    let [dx, dy] = map.pixel();
    let character = Character::of(&levelled);
    let facts = MapFacts {
        points: map.points(),
        pixel: map.pixel(),
        missing: character.missing,
        tested: summits.tested,
        level,
        filter: filter.map(|filter| filter.to_string()),
        moments: character.moments,
        summits: summits.heights.len(),
        plateaus: summits.plateaus,
        dropped: summits.dropped,
        quantisation: Quantisation::of(map, &summits),
    };
    let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
    let set = AsperitySet::new(summits.heights, radii, dx * dy * summits.tested as f64)?;
    Ok((set, facts))
}

impl MapFacts {
    /// Why its radii may be the instrument's.
    pub fn warnings(&self) -> Vec<String> {
        let found = &self.quantisation;
        let nanometres = |length: f64| format!("{:.4} nm", length * 1e9);
        let mut warnings = Vec::new();
        let step = found.step.map_or_else(String::new, |step| {
            format!(" The instrument stores one height level every {}.", nanometres(step))
        });
        if let Some(step) = found.step.filter(|_| found.has_coarse_step()) {
            warnings.push(format!(
                "the radii are set by the instrument's height step of {}, not by the surface: the median drop from a summit \
                 to its neighbours is {}, and the {} summits have {} distinct curvatures. Neither model's answer \
                 describes this surface; measure with a finer step, or filter out the wavelengths that the step spoils.",
                nanometres(step),
                nanometres(found.median_drop),
                found.summits,
                found.distinct_curvatures,
            ));
        } else if found.has_few_curvatures() {
            warnings.push(format!(
                "the {} summits have only {} distinct curvatures: the radii are set by the instrument, not by the \
                 surface.{step}",
                found.summits, found.distinct_curvatures,
            ));
        }
        warnings
    }
}

impl Surface {
    /// A set that separations are measured in by its own statistics.
    pub(super) fn new(name: &str, set: AsperitySet, statistics: Statistics) -> Self {
        Self {
            name: name.to_owned(),
            set,
            datum: Datum::from(&statistics),
            statistics,
            mean_plane: None,
            nominal: None,
            map: None,
            warnings: Vec::new(),
        }
    }

    /// What the statistical model stands on: the nominal numbers of a population, the statistics of
    /// any other set.
    pub fn population(&self, heights: Option<HeightDensity>, mean_radius: MeanRadius) -> Population {
        let own = Population {
            radius: mean_radius.of(&self.statistics),
            sigma: self.statistics.sigma,
            density: self.set.density(),
            heights: HeightDensity::Gaussian,
        };
        let population = self.nominal.unwrap_or(own);
        Population { heights: heights.unwrap_or(population.heights), ..population }
    }

    /// The datum relative to the mean height of the statistical model's population.
    pub fn quoting_datum(&self) -> Datum {
        let mean = if self.nominal.is_some() { self.datum.mean } else { 0.0 };
        Datum { mean, sigma: self.datum.sigma }
    }

    /// How far the mean asperity stands above the mean plane of the surface, m, where that is known.
    pub fn offset_to_mean_plane(&self) -> Option<f64> {
        let mean = if self.nominal.is_some() { 0.0 } else { self.statistics.mean_height };
        self.mean_plane.map(|plane| mean - plane)
    }

    /// Whether separations are measured from the mean plane of the surface in its sigma.
    pub fn is_quoted_as_surface(&self) -> bool {
        self.nominal.is_some() && self.mean_plane.is_some()
    }

    /// The papers behind its asperities.
    pub fn papers(&self) -> Vec<Paper> {
        let mut papers = Vec::new();
        if let Some(map) = &self.map {
            papers.push(literature::GREENWOOD_1984);
            if map.filter.is_some() {
                papers.push(literature::ISO_16610_61);
            }
        }
        if self.is_quoted_as_surface() {
            papers.push(literature::NAYAK_1971);
        }
        papers
    }
}
