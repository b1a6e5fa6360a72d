//! A rough surface: its asperities, where they are from, and what is known of its height map.
//!
//! [`SummitSearch`] finds the asperities of a map: it prepares the map (spikes, lines, form, filter), checks its fitness, searches summits
//! and divides it into blocks for the sampling error. [`Fit`] finds the preparation that makes a measured map fit.
//! [`crate::study`] compares the models on a surface.

mod bodies;
mod fit;
mod independence;
mod overview;
mod remedy;
mod search;
mod steps;

pub use bodies::BodyAsperities;
pub use fit::{Fit, FitStep, Kept, NotApplied};
pub use independence::{Independence, MapBlocks};
pub use overview::{AnalysisDepth, MOST_ANALYSED_POINTS, MapOverview};
pub use remedy::{Remedy, usual_long_filter};
pub use search::{FoundSpikes, MOST_SPIKE_POINTS, NoAsperities, Preparation, SummitSearch};
pub use steps::Step;

use std::sync::Arc;

use crate::bem::MOST_MISSING;
use crate::compare::{Division, Repeats};
use crate::distribution::{HeightModel, HeightsError};
use crate::topography::fitness::{Finding, LineOffsets, Lines, Spikes};
use crate::topography::generate::{FittedProcess, SigmaOf, SurfaceGenerator, Target, Unfitted};
use crate::topography::spectrum::{Lay, SpectrumShape};
use crate::topography::summits::Neighbours;
use crate::topography::theory::Expected;
use crate::topography::tip::TipReach;
use crate::topography::{CorrelationLengths, Filter, Level, Quantisation, RoughnessParameters};
use crate::{
    AsperitySet, Ellipticity, HeightMap, Heights, MeanRadius, Paper, Population, ReferencePlane, Statistics,
    literature,
};

/// Asperities with their statistics and origin.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Its name in the spec.
    pub name: String,
    /// The asperities.
    pub set: AsperitySet,
    /// Their statistics.
    pub statistics: Statistics,
    /// Zero of the set's heights in the frame of the file, m: not zero where heights are far from zero.
    pub origin: f64,
    /// Where separations are measured from, in the frame of the set's heights.
    pub plane: ReferencePlane,
    /// Height of the mean plane of the surface in the frame of the set's heights, m, where it is known.
    pub mean_plane: Option<f64>,
    /// The population that it was drawn from: its parameters are then the inputs of the statistical model.
    pub nominal: Option<Population>,
    /// Whether that population is of pairs that meet (Greenwood and Tripp 1971), in place of a composite of both bodies.
    pub meets_in_pairs: bool,
    /// The asperities of both bodies whose sum it is.
    pub bodies: Option<Box<[BodyAsperities; 2]>>,
    /// The mean shape of its asperities as ellipses, for elliptic laws.
    pub ellipticity: Option<Ellipticity>,
    /// The map that it was found on.
    pub map: Option<MapFacts>,
    /// The map as prepared, where it is kept for more than its asperities.
    pub prepared: Option<PreparedMap>,
    /// What its sampling error rests on.
    pub independence: Independence,
    /// Both halves of the map that it was found on, or of a list with places, where it is divided for a sampling error.
    pub halves: Option<Division>,
    /// What stands for other samples of a measured map that is too small for blocks.
    pub small: Option<Box<SmallMap>>,
    /// Number of realisations of this surface.
    pub realisations: usize,
    /// What these are.
    pub repeats: Repeats,
    /// How its preparation was found, where it was not prescribed.
    pub fit: Option<Box<Fit>>,
    /// What of its file was taken for metres because nothing names a unit.
    pub taken_for_metres: Option<&'static str>,
    /// Why neither model applies, of a map whose summits do not scatter or that has none: separations are then from the mean plane, and
    /// nothing is in units of sigma. Its statistics, as far as they are not defined, are NaN.
    pub unscattered: Option<NoAsperities>,
    /// Caveats.
    pub warnings: Vec<String>,
}

/// What stands for other samples of a measured map that is too small for blocks.
#[derive(Debug, Clone)]
pub struct SmallMap {
    /// A process fitted to the map, or why none is.
    pub process: Result<FittedProcess, Unfitted>,
    /// Its halves, divided along x and along y.
    pub halves: [Division; 2],
}

/// What is known of a height map.
#[derive(Debug, Clone)]
pub struct MapFacts {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Their distances, m.
    pub pixel: [f64; 2],
    /// Whether its file holds pixel and unit of length, so that neither can be stated.
    pub is_held: [bool; 2],
    /// Points tested for a summit.
    pub tested: usize,
    /// The form removed.
    pub level: Level,
    /// The filters.
    pub filter: Option<Filter>,
    /// The axis along which lines were aligned.
    pub aligned: Option<Lines>,
    /// Height of the frame of its heights above that of the file, m, where no levelling removed it.
    pub offset: f64,
    /// Of the levelled, filtered map.
    pub roughness: RoughnessParameters,
    /// What a summit is.
    pub neighbours: Neighbours,
    /// Number of summits.
    pub summits: usize,
    /// Plateaus among them, dropped ones included.
    pub plateaus: usize,
    /// Plateaus dropped for a curvature that is not positive.
    pub dropped: usize,
    /// Summits whose smaller principal curvature is not positive.
    pub saddles: usize,
    /// Five-point summits of a Gaussian surface with the same autocorrelation at neighbours; `None` where other
    /// summits were searched.
    pub expected: Option<Expected>,
    /// Summits of a continuous isotropic Gaussian surface with the same spectral moments.
    pub nayak: Option<Expected>,
    /// Of a measured map, the check for heights on steps.
    pub quantisation: Option<Quantisation>,
    /// Of a measured map, its spikes.
    pub spikes: Option<SpikeFacts>,
    /// Of a map that was eroded by the tip of the instrument, what the tip has reached.
    pub tip: Option<TipFacts>,
    /// Of a measured map that was checked, the offsets between its lines.
    pub offsets: Option<LineOffsets>,
    /// Whether it may carry a verdict: of each check the worst of its measures; empty where nothing was checked.
    pub fitness: Vec<Finding>,
    /// Every measure of these checks.
    pub measures: Vec<Finding>,
    /// Its correlation lengths, where they were needed.
    pub correlation: Option<CorrelationLengths>,
    /// Of a random surface, what it was made by.
    pub generation: Option<GenerationFacts>,
    /// Overview of the map, where requested.
    pub whole: MapOverview,
}

/// Spikes of a measured map.
#[derive(Debug, Clone)]
pub struct SpikeFacts {
    /// Points that were removed as spikes.
    pub removed: usize,
    /// Those that are there.
    pub left: Spikes,
}

/// What the tip of an instrument has reached of a map.
#[derive(Debug, Clone, Copy)]
pub struct TipFacts {
    /// Of the whole map.
    pub reach: TipReach,
    /// Mean radius of the summits of the prepared map, of all or of the highest, whichever is smaller, m.
    pub radius: f64,
}

/// What a random surface was made by.
#[derive(Debug, Clone)]
pub struct GenerationFacts {
    /// The generator; for a target, the one found.
    pub generator: SurfaceGenerator,
    /// Target of its summits, and the number of surfaces tried.
    pub target: Option<(Target, usize)>,
    /// Share of the points truncated by a finer process.
    pub cut: Option<f64>,
}

/// Numbers that a spec gives of a surface, whichever heights sigma refers to.
#[derive(Debug, Clone, PartialEq)]
pub struct Specified {
    /// Radius of the asperities, m.
    pub radius: f64,
    /// Standard deviation of the heights of the asperities or of the surface, m.
    pub sigma: f64,
    /// Asperities per area, 1/m^2.
    pub density: f64,
    /// Distribution of the heights.
    pub heights: Heights,
    /// Hurst exponent and lay of a random surface.
    pub spectrum: Option<(f64, Lay)>,
}

impl MapFacts {
    /// Whether so few points are missing that boundary elements can be run.
    pub fn is_nearly_complete(&self) -> bool {
        self.roughness.missing as f64 <= MOST_MISSING * (self.points[0] * self.points[1]) as f64
    }

    /// The places of the peaks of spikes on the map, m.
    pub fn spike_places(&self) -> Vec<[f64; 2]> {
        let points = self.spikes.as_ref().map_or(&[][..], |spikes| &spikes.left.peaks);
        let place = |&point: &usize| {
            let at = [point / self.points[1], point % self.points[1]];
            [0, 1].map(|axis| (at[axis] as f64 + 0.5) * self.pixel[axis])
        };
        points.iter().map(place).collect()
    }

    /// The checks that failed so that no verdict may rest on the map.
    pub fn blocking(&self) -> impl Iterator<Item = &Finding> {
        self.fitness.iter().filter(|finding| finding.is_blocking())
    }

    fn papers(&self) -> Vec<Paper> {
        let mut papers = vec![literature::GREENWOOD_1984, literature::NAYAK_1971];
        if self.tip.is_some() {
            papers.extend([literature::VILLARRUBIA_1997, literature::FELZENSZWALB_HUTTENLOCHER_2012]);
        }
        if self.filter.is_some() {
            papers.push(literature::ISO_16610_61);
        }
        if let Some(made) = &self.generation {
            let heights = &made.generator.process.heights;
            if *heights != Heights::GAUSSIAN {
                papers.extend(heights.papers());
            }
        }
        papers
    }
}

/// A map as its summits were searched.
#[derive(Debug, Clone)]
pub struct PreparedMap {
    /// Aligned, levelled and filtered, spikes missing.
    pub map: Arc<HeightMap>,
    /// Index of the point of each summit, in the order of the asperities.
    pub positions: Vec<usize>,
}

impl Surface {
    /// A set that separations are measured in by its own statistics.
    pub fn new(name: &str, set: AsperitySet, statistics: Statistics) -> Self {
        let ellipticity = Ellipticity::new(&set);
        Self {
            name: name.to_owned(),
            set,
            plane: ReferencePlane::from(&statistics),
            statistics,
            origin: 0.0,
            mean_plane: None,
            nominal: None,
            meets_in_pairs: false,
            bodies: None,
            ellipticity,
            map: None,
            prepared: None,
            independence: Independence::Asperities,
            halves: None,
            small: None,
            realisations: 1,
            repeats: Repeats::Realisations,
            fit: None,
            taken_for_metres: None,
            unscattered: None,
            warnings: Vec::new(),
        }
    }

    /// The statistics with the mean height in the frame of the file.
    pub fn reported_statistics(&self) -> Statistics {
        Statistics { mean_height: self.origin + self.statistics.mean_height, ..self.statistics }
    }

    /// The same surface without one group of its asperities and their area; `None` where none is left. Separations are
    /// measured from the mean of the rest, in its sigma, if they are measured so on the surface.
    pub fn without(&self, division: &Division, group: usize) -> Option<Self> {
        // Of half of them and more the rest is summed sooner than the group.
        let is_most = 2 * division.count_of(group) >= self.set.count();
        let part = if is_most { None } else { division.only(&self.set, group) };
        self.rest(division, group, part.as_ref())
    }

    /// [`Self::without`] a group, and the group on its area in the plane of all; `None` for each that has no asperities.
    pub fn divided(&self, division: &Division, group: usize) -> [Option<Self>; 2] {
        let part = division.only(&self.set, group);
        let rest = self.rest(division, group, part.as_ref());
        let of_part = |set| {
            let statistics = Statistics::new(&set);
            Self { plane: self.plane, ..Self::new(&self.name, set, statistics) }
        };
        [rest, part.map(of_part)]
    }

    /// [`Self::without`] a group, from the asperities of the group where they are known.
    fn rest(&self, division: &Division, group: usize, part: Option<&AsperitySet>) -> Option<Self> {
        let set = division.without(&self.set, group)?;
        let statistics = match part {
            Some(part) => self.statistics.without(part, &set),
            None if set.count() == self.set.count() => self.statistics,
            None => Statistics::new(&set),
        };
        let is_own = self.plane == ReferencePlane::from(&self.statistics);
        let mut rest = Self::new(&self.name, set, statistics);
        if !is_own {
            rest.plane = self.plane;
        }
        if self.nominal.is_some() {
            rest.ellipticity = self.ellipticity;
        }
        Some(Self { origin: self.origin, mean_plane: self.mean_plane, nominal: self.nominal.clone(), ..rest })
    }

    /// Inputs of the statistical model: the nominal numbers of a population, the statistics of
    /// any other set.
    ///
    /// # Errors
    /// Heights that the distribution cannot be fitted to.
    pub fn population(
        &self,
        heights: Option<&HeightModel>,
        mean_radius: MeanRadius,
    ) -> Result<Population, HeightsError> {
        let own = Population {
            radius: mean_radius.radius(&self.statistics),
            sigma: self.statistics.sigma,
            density: self.set.density(),
            heights: Heights::GAUSSIAN,
        };
        let population = self.nominal.clone().unwrap_or(own);
        let Some(heights) = heights.filter(|_| !self.meets_in_pairs && self.unscattered.is_none()) else {
            return Ok(population);
        };
        let moments = self.statistics.skewness.zip(self.statistics.kurtosis).map(|(s, k)| [s, k]);
        Ok(Population { heights: heights.fit_by(|| self.set.smoothed_heights(), moments)?, ..population })
    }

    /// Mean height of the statistical model's population in the frame of the set's heights, m.
    fn population_mean(&self) -> f64 {
        if self.nominal.is_some() { 0.0 } else { self.statistics.mean_height }
    }

    /// The plane relative to the mean height of the statistical model's population.
    pub fn reporting_plane(&self) -> ReferencePlane {
        ReferencePlane { mean: self.plane.mean - self.population_mean(), sigma: self.plane.sigma }
    }

    /// Height of the mean asperity above the mean plane of the surface, m, where known.
    pub fn offset_to_mean_plane(&self) -> Option<f64> {
        self.mean_plane.map(|plane| self.population_mean() - plane)
    }

    /// Height of the plane that separations are measured from above the mean plane of the surface, m, where known.
    pub fn plane_above_mean_plane(&self) -> Option<f64> {
        self.mean_plane.map(|mean| self.plane.mean - mean)
    }

    /// Whose mean and standard deviation separations are measured by.
    pub fn separations_of(&self) -> SigmaOf {
        let target = self.map.as_ref().and_then(|map| map.generation.as_ref()?.target.as_ref());
        match target {
            Some((target, _)) => target.sigma_of,
            None if self.is_converted() || self.unscattered.is_some() => SigmaOf::Surface,
            None => SigmaOf::Summits,
        }
    }

    /// Whether its nominal population follows from the numbers of a surface by Nayak's theory.
    fn is_converted(&self) -> bool {
        self.nominal.is_some() && self.mean_plane.is_some()
    }

    /// The numbers that the spec gives of it; `None` where it gives a file, or a spectrum and its lengths.
    pub fn specified(&self) -> Option<Specified> {
        if let Some(population) = &self.nominal {
            let &Population { radius, density, ref heights, .. } = population;
            let sigma = self.plane.sigma;
            return Some(Specified { radius, sigma, density, heights: heights.clone(), spectrum: None });
        }
        let made = self.map.as_ref()?.generation.as_ref()?;
        let (Target { radius, sigma, density, .. }, _) = made.target?;
        let process = &made.generator.process;
        let hurst = match process.spectrum.shape() {
            SpectrumShape::SelfAffine { hurst, .. } | SpectrumShape::Between { hurst, .. } => hurst,
            SpectrumShape::Gaussian(_) | SpectrumShape::Exponential(_) => return None,
        };
        let spectrum = Some((hurst, process.spectrum.lay()));
        Some(Specified { radius, sigma, density, heights: process.heights.clone(), spectrum })
    }

    /// The fitness checks of its map.
    pub fn fitness(&self) -> &[Finding] {
        self.map.as_ref().map_or(&[], |map| &map.fitness)
    }

    /// Whether a failed check keeps it from carrying a verdict.
    pub fn is_blocked(&self) -> bool {
        self.fitness().iter().any(Finding::is_blocking)
    }

    /// References for its asperities.
    pub fn papers(&self) -> Vec<Paper> {
        let mut papers: Vec<Paper> = self.map.iter().flat_map(MapFacts::papers).collect();
        let is_composite = self.bodies.is_some() && self.nominal.is_some() && !self.meets_in_pairs;
        if self.is_converted() || is_composite {
            papers.push(literature::NAYAK_1971);
        }
        papers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;

    /// Groups of a sixteenth, halves, and the statistics of what is left from its own asperities.
    #[test]
    fn a_group_and_the_rest_make_up_the_surface() {
        let value = |k: u32, m: u32| f64::from((k * m) % 10_007) / 1e4;
        let heights: Vec<f64> = (0..4001).map(|k| 1e-7 * (value(k, 7919) - value(k, 13))).collect();
        let radii: Vec<f64> = (0..4001).map(|k| 1e-5 * (1.0 + value(k, 31))).collect();
        let set = AsperitySet::new(heights, radii, 1.0).unwrap();
        let statistics = Statistics::new(&set);
        let surface = Surface::new("a", set, statistics);
        let divisions =
            [Division::independent(4001, [1; 32], &Silent), Division::random_halves(4001, [2; 32], &Silent)];
        for division in divisions.map(Option::unwrap) {
            for group in 0..division.shares().len() {
                let [rest, part] = surface.divided(&division, group).map(Option::unwrap);
                assert_eq!(rest.set.count() + part.set.count(), 4001);
                assert_eq!(part.statistics, Statistics::new(&part.set));
                assert_eq!(part.plane, surface.plane);
                let without = surface.without(&division, group).unwrap();
                assert_eq!(without.set, rest.set);
                let wanted = Statistics::new(&rest.set);
                for found in [rest, without] {
                    assert_eq!(found.plane, ReferencePlane::from(&found.statistics));
                    assert!((found.statistics.sigma / wanted.sigma - 1.0).abs() < 1e-13);
                    assert!((found.statistics.mean_radius / wanted.mean_radius - 1.0).abs() < 1e-13);
                }
            }
        }
    }
}
