//! A surface for models and report: its asperities and their properties.

use super::independence::Independence;
use super::overview::{AnalysisDepth, MapOverview};
use asperity::compare::Division;
use asperity::topography::generate::{SigmaOf, SurfaceGenerator, Target};
use asperity::topography::spectrum::{Lay, SpectrumShape};
use asperity::topography::summits::{Detail, Neighbours, Summits, find};
use asperity::topography::theory::Expected;
use asperity::topography::{
    Filter, FilterError, Level, Levelled, Quantisation, RoughnessParameters, Rows, Undetermined, Watched,
    theory,
};
use asperity::{
    AsperitySet, Ellipse, Ellipticity, Heights, MeanRadius, Paper, Population, ReferencePlane, SetError,
    Statistics, literature,
};
use asperity_framework::progress::Progress;
use asperity_framework::report::format::{number, quantity};

/// Asperities with their statistics and origin.
#[derive(Debug)]
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
    /// The mean shape of its asperities as ellipses, for elliptic laws.
    pub ellipticity: Option<Ellipticity>,
    /// The map that it was found on.
    pub map: Option<MapFacts>,
    /// What its sampling error rests on.
    pub independence: Independence,
    /// Number of realisations of this surface.
    pub realisations: usize,
    /// Caveats.
    pub warnings: Vec<String>,
}

/// What is known of a height map.
#[derive(Debug, Clone)]
pub struct MapFacts {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Their distances, m.
    pub pixel: [f64; 2],
    /// Points tested for a summit.
    pub tested: usize,
    /// The form removed.
    pub level: Level,
    /// The filters, as text.
    pub filter: Option<String>,
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
    /// Of a random surface, what it was made by.
    pub generation: Option<GenerationFacts>,
    /// Overview of the map, where requested.
    pub whole: MapOverview,
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

/// A map on which no asperities are found.
#[derive(Debug, thiserror::Error)]
pub(super) enum NoAsperities {
    #[error(transparent)]
    Level(#[from] Undetermined),
    #[error(transparent)]
    Filter(#[from] FilterError),
    #[error("has no summit: once levelled it is flat to the rounding of its heights")]
    Flat,
    #[error("has no summit: none of its {tested} tested points is higher than its neighbours")]
    NoSummit { tested: usize },
    #[error(
        "has {summits} summits that are equally high: separations are measured in their standard deviation; allowed: summits of \
             different heights"
    )]
    EqualHeights { summits: usize },
    #[error(transparent)]
    Set(#[from] SetError),
}

/// How asperities are found on a map.
pub(super) struct SummitSearch<'a> {
    /// The form removed first.
    pub(super) level: Level,
    pub(super) filter: Option<Filter>,
    /// What a summit is.
    pub(super) neighbours: Neighbours,
    /// Whether the ellipses of the asperities are wanted.
    pub(super) as_ellipses: bool,
    /// What the map was made by, if it was made.
    pub(super) generation: Option<GenerationFacts>,
    pub(super) depth: AnalysisDepth,
    /// Whether the map is divided into blocks for a sampling error.
    pub(super) divides: bool,
    pub(super) progress: &'a dyn Progress,
}

/// What a map gives.
pub(super) struct Found {
    pub(super) set: AsperitySet,
    pub(super) facts: MapFacts,
    pub(super) independence: Independence,
}

impl SummitSearch<'_> {
    /// Levels and filters a map and finds its summits, row by row: only a filter and the closest depth need
    /// the map in memory.
    pub(super) fn asperities(&self, raw: &dyn Rows) -> Result<Found, NoAsperities> {
        let progress = self.progress;
        let raw: &dyn Rows = &Watched { map: raw, progress };
        progress.stage("levelling", 1.0);
        let levelled = Levelled { map: raw, form: self.level.form(raw)? };
        let filtered = match self.filter {
            Some(filter) => {
                progress.stage("filtering", filter.work(raw.pixel()));
                Some(filter.apply(&levelled)?)
            }
            None => None,
        };
        let map: &dyn Rows = filtered.as_ref().map_or(&levelled as &dyn Rows, |map| map);
        let map: &dyn Rows = &Watched { map, progress };
        progress.stage("roughness parameters", 2.0);
        let roughness = RoughnessParameters::of(map);
        if roughness.moments.sq <= levelled.form.magnitude() * raw.precision().max(f64::EPSILON) {
            return Err(NoAsperities::Flat);
        }
        // The drops reveal only height steps of an instrument.
        let detail = Detail { positions: self.divides, principal: true, drops: self.generation.is_none() };
        progress.stage("summits", 1.0);
        let summits = find(map, self.neighbours, detail);
        if summits.heights.is_empty() {
            return Err(NoAsperities::NoSummit { tested: summits.tested });
        }
        let independence = if self.divides {
            progress.stage("blocks", 2.0);
            Independence::of_map(map, &roughness, &summits)
        } else {
            Independence::Realisations
        };
        let facts = self.facts(raw, map, roughness, &summits);
        let [dx, dy] = map.pixel();
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        let set = AsperitySet::new(summits.heights, radii, dx * dy * summits.tested as f64)?;
        if !self.as_ellipses {
            return Ok(Found { set, facts, independence });
        }
        let ellipses = summits.principal.iter().copied().map(Ellipse::of_summit).collect();
        Ok(Found { set: set.with_ellipses(ellipses)?, facts, independence })
    }

    fn facts(
        &self,
        raw: &dyn Rows,
        map: &dyn Rows,
        roughness: RoughnessParameters,
        summits: &Summits,
    ) -> MapFacts {
        let sq = roughness.moments.sq;
        if self.generation.is_none() {
            // A pass over the heights, and sorting them.
            self.progress.stage("height steps", 2.0);
        }
        let quantisation = self.generation.is_none().then(|| Quantisation::of(raw, summits));
        let is_five_point = self.neighbours == Neighbours::Four;
        MapFacts {
            points: map.points(),
            pixel: map.pixel(),
            offset: map.offset(),
            tested: summits.tested,
            level: self.level,
            filter: self.filter.map(|filter| filter.to_string()),
            neighbours: self.neighbours,
            summits: summits.heights.len(),
            plateaus: summits.plateaus,
            dropped: summits.dropped,
            saddles: summits.principal.iter().filter(|principal| principal[1] <= 0.0).count(),
            expected: is_five_point.then(|| theory::five_point(&roughness.drops, sq, map.pixel())).flatten(),
            nayak: theory::nayak(roughness.spectral_moments()),
            quantisation,
            generation: self.generation.clone(),
            whole: MapOverview::of(
                map,
                &roughness,
                self.generation.as_ref().map(|made| &made.generator),
                self.depth,
            ),
            roughness,
        }
    }
}

impl MapFacts {
    /// Caveats.
    pub fn warnings(&self) -> Vec<String> {
        /// Largest plausible r.m.s. slope.
        const STEEP: f64 = 1.0;
        /// Largest plausible point spacing, m.
        const WIDE: f64 = 1e-3;
        let mut warnings = Vec::new();
        let widest = self.pixel[0].max(self.pixel[1]);
        if widest > WIDE {
            warnings.push(format!(
                "its points are {} apart: the unit of its lengths is probably wrong (set unit = \"um\" next to path).",
                quantity(widest, "m"),
            ));
        }
        let slope = self.roughness.rms_slope();
        if slope > STEEP {
            warnings.push(format!(
                "the r.m.s. slope is {}: heights and pixel size are probably in different units, or the unit is wrong.",
                number(slope),
            ));
        }
        warnings.extend(self.lay_warning());
        warnings.extend(self.step_warning());
        warnings
    }

    /// Warns that five-point summits may be an artefact of the grid.
    fn lay_warning(&self) -> Option<String> {
        /// There are twice as many five-point summits as with the same lay along an axis.
        const OBLIQUE: f64 = 0.6;
        let correlation = self.roughness.drops.slope_correlation();
        (self.neighbours == Neighbours::Four && correlation > OBLIQUE).then(|| {
            format!(
                "the lay lies at an angle to the grid (slopes along x and y correlate by {correlation:.2}): five-point \
                 summits are found in rows along the ridges where the surface has none, more than twice too many. \
                 neighbours = \"eight\" finds far fewer; best is to rotate the map so that the lay is parallel to x or y."
            )
        })
    }

    /// Warns that the radii may be an artefact of the instrument.
    fn step_warning(&self) -> Option<String> {
        let found = self.quantisation.as_ref()?;
        let step = found.step.map_or_else(String::new, |step| {
            format!(" The instrument stores one height level every {}.", quantity(step, "m"))
        });
        if let Some(step) = found.step.filter(|_| found.has_coarse_step()) {
            return Some(format!(
                "the radii are set by the instrument's height step of {}, not by the surface: the median drop from a summit \
                 to its neighbours is {}, and the {} summits have {} distinct curvatures. Neither model describes this \
                 surface; measure with a finer step, or filter out the wavelengths affected by it.",
                quantity(step, "m"),
                quantity(found.median_drop, "m"),
                found.summits,
                found.distinct_curvatures,
            ));
        }
        found.has_few_curvatures().then(|| {
            format!(
                "the {} summits have only {} distinct curvatures: the radii are set by the instrument, not by the \
                 surface.{step}",
                found.summits, found.distinct_curvatures,
            )
        })
    }

    fn papers(&self) -> Vec<Paper> {
        let mut papers = vec![literature::GREENWOOD_1984, literature::NAYAK_1971];
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

impl Surface {
    /// A set that separations are measured in by its own statistics.
    pub(super) fn new(name: &str, set: AsperitySet, statistics: Statistics) -> Self {
        let ellipticity = Ellipticity::of(&set);
        Self {
            name: name.to_owned(),
            set,
            plane: ReferencePlane::from(&statistics),
            statistics,
            origin: 0.0,
            mean_plane: None,
            nominal: None,
            ellipticity,
            map: None,
            independence: Independence::Asperities,
            realisations: 1,
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
        let set = division.without(&self.set, group)?;
        let statistics = Statistics::of(&set);
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

    /// One group of its asperities on their area, in the plane of all; `None` where it has none.
    pub fn only(&self, division: &Division, group: usize) -> Option<Self> {
        let set = division.only(&self.set, group)?;
        let statistics = Statistics::of(&set);
        Some(Self { plane: self.plane, ..Self::new(&self.name, set, statistics) })
    }

    /// Inputs of the statistical model: the nominal numbers of a population, the statistics of
    /// any other set.
    pub fn population(&self, heights: Option<&Heights>, mean_radius: MeanRadius) -> Population {
        let own = Population {
            radius: mean_radius.of(&self.statistics),
            sigma: self.statistics.sigma,
            density: self.set.density(),
            heights: Heights::GAUSSIAN,
        };
        let population = self.nominal.clone().unwrap_or(own);
        Population { heights: heights.unwrap_or(&population.heights).clone(), ..population }
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

    /// Whose mean and standard deviation separations are measured by.
    pub fn separations_of(&self) -> SigmaOf {
        let target = self.map.as_ref().and_then(|map| map.generation.as_ref()?.target.as_ref());
        match target {
            Some((target, _)) => target.sigma_of,
            None if self.is_converted() => SigmaOf::Surface,
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
            SpectrumShape::SelfAffine { hurst, .. } => hurst,
            SpectrumShape::Gaussian(_) | SpectrumShape::Exponential(_) => return None,
        };
        let spectrum = Some((hurst, process.spectrum.lay()));
        Some(Specified { radius, sigma, density, heights: process.heights.clone(), spectrum })
    }

    /// References for its asperities.
    pub fn papers(&self) -> Vec<Paper> {
        let mut papers: Vec<Paper> = self.map.iter().flat_map(MapFacts::papers).collect();
        if self.is_converted() {
            papers.push(literature::NAYAK_1971);
        }
        papers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::HeightMap;
    use asperity::topography::generate::{Plateau, Process, Seeds, SpectrumOf};
    use asperity::topography::spectrum::Spectrum;
    use asperity_framework::progress::Silent;

    fn map(points: [usize; 2], height: impl Fn(usize) -> f64) -> HeightMap {
        HeightMap::new(points, [1.0, 2.0], (0..points[0] * points[1]).map(height).collect(), 0.0).unwrap()
    }

    fn facts(plateau: Option<Plateau>, neighbours: Neighbours) -> (HeightMap, MapFacts) {
        let generator =
            SurfaceGenerator { points: [64, 48], pixel: [1.0, 0.8], process: process(3.0), plateau };
        let (map, cut) = generator.surface(Seeds { process: [1; 32], plateau: [2; 32] }).unwrap();
        let generation = Some(GenerationFacts { generator, target: None, cut });
        let search = SummitSearch {
            level: Level::None,
            filter: None,
            neighbours,
            generation,
            as_ellipses: false,
            depth: AnalysisDepth::Everything,
            divides: false,
            progress: &Silent,
        };
        let facts = search.asperities(&map).unwrap().facts;
        (map, facts)
    }

    fn process(length: f64) -> Process {
        let spectrum = Spectrum::new(SpectrumShape::Exponential(length), Lay::default()).unwrap();
        Process { spectrum, of: SpectrumOf::Heights, sigma: 1.0, heights: Heights::GAUSSIAN }
    }

    #[test]
    fn a_surface_of_two_processes_has_no_target_spectrum() {
        let one = facts(None, Neighbours::Four).1;
        assert!(one.whole.target.is_some() && !one.whole.is_target_of_gaussian);
        let two = facts(Some(Plateau { process: process(2.0), height: 0.0 }), Neighbours::Four).1;
        assert!(two.whole.target.is_none() && two.whole.spectrum.is_some());
    }

    #[test]
    fn saddles_are_summits_whose_smaller_curvature_is_not_positive() {
        for neighbours in [Neighbours::Four, Neighbours::Eight] {
            let (map, facts) = facts(None, neighbours);
            let principal = find(&map, neighbours, Detail::ALL).principal;
            let [larger, smaller] =
                [0, 1].map(|k| principal.iter().filter(|curvatures| curvatures[k] <= 0.0).count());
            assert_eq!((facts.saddles, larger), (smaller, 0));
            assert!(smaller > 0);
        }
    }

    /// What is left of a plane far from zero is its rounding.
    #[test]
    fn a_plane_far_from_zero_is_flat_once_it_is_levelled() {
        let map = map([40, 30], |k| 1.0 + 1e-3 * (k / 30) as f64 + f64::EPSILON * ((k * k) % 2) as f64);
        let search = |level| {
            let neighbours = Neighbours::Four;
            SummitSearch {
                level,
                filter: None,
                neighbours,
                generation: None,
                as_ellipses: false,
                depth: AnalysisDepth::Asperities,
                divides: false,
                progress: &Silent,
            }
            .asperities(&map)
        };
        assert!(matches!(search(Level::Plane), Err(NoAsperities::Flat)));
        assert!(matches!(search(Level::Quadratic), Err(NoAsperities::Flat)));
    }
}
