//! From a height map to asperities: preparation, checks, and the search for summits.

use std::sync::Arc;

use crate::asperity::mean_and_sigma;
use crate::compare::Division;
use crate::progress::{Progress, Silent};
use crate::topography::fitness::{
    Examined, Finding, LineOffsets, Lines, Measured, Spikes, Without, step_over_drop,
};
use crate::topography::generate::{FittedProcess, SigmaOf};
use crate::topography::summits::{Detail, Neighbours, Summits, find};
use crate::topography::{
    Autocorrelation, Blocks, CorrelationLengths, Filter, FilterError, Level, Quantisation,
    RoughnessParameters, Rows, Undetermined, Watched, Window, theory, thumbnail,
};
use crate::{AsperitySet, Ellipse, HeightMap, MIN_CONTACTS, ReferencePlane, SetError, Statistics};

use super::steps::PreparationSteps;
use super::{
    AnalysisDepth, GenerationFacts, Independence, MapFacts, MapOverview, PreparedMap, SmallMap, SpikeFacts,
    Surface, TipFacts,
};

/// A map on which no asperities are found.
#[derive(Debug, Clone, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum NoAsperities {
    /// A form that the map does not determine.
    #[error(transparent)]
    Level(#[from] Undetermined),
    /// A filter that the map does not hold.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// A map that is flat once it is levelled.
    #[error("has no summit: once levelled it is flat to the rounding of its heights")]
    Flat,
    /// An L filter that removes the roughness.
    #[error(
        "keeps {kept:.1e} of the variance of its heights after an L filter of {l:.4e} m, which is shorter than its waves (mean \
             wavelength {wavelength:.4e} m); allowed: a longer L filter, or none"
    )]
    LongFilter { l: f64, kept: f64, wavelength: f64 },
    /// No tested point is higher than its neighbours.
    #[error("has no summit: none of its {tested} tested points is higher than its neighbours")]
    NoSummit { tested: usize },
    /// One summit, or none because no point could be one.
    #[error(
        "has {} on {} x {} points{}: two of different heights are the least, a comparison needs hundreds; allowed: {}",
        if *summits == 0 { "no summit" } else { "one summit only" },
        points[0], points[1], missing_share(*missing, *points),
        if *missing == 0 { "a larger map" } else { "a larger map, or one with fewer missing points (a summit has none beside it)" },
    )]
    FewSummits { summits: usize, points: [usize; 2], missing: usize },
    /// Summits whose heights are equal but for rounding.
    #[error(
        "has {summits} summits that are equally high: separations are measured in their standard deviation; allowed: summits of \
             different heights"
    )]
    EqualHeights { summits: usize },
    /// A file that another program has made shorter since it was opened.
    #[error("became shorter while it was read; run again once it is written")]
    Shortened,
    /// Asperities that cannot be.
    #[error(transparent)]
    Set(#[from] SetError),
}

/// ", 60 % of which are missing"; nothing without missing points.
fn missing_share(missing: usize, [nx, ny]: [usize; 2]) -> String {
    match missing as f64 / (nx * ny) as f64 {
        0.0 => String::new(),
        share if share < 0.01 => ", less than 1 % of which are missing".to_owned(),
        share => format!(", {:.0} % of which are missing", 100.0 * share),
    }
}

/// What is done to a map before its summits are searched, and what a summit is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Preparation {
    /// Whether spikes become missing points.
    pub removes_spikes: bool,
    /// Whether single points that are as narrow as spikes, but lower, become missing points.
    pub removes_suspects: bool,
    /// The axis along which lines are aligned.
    pub aligned: Option<Lines>,
    /// Radius of the stylus or tip whose traces are eroded, m.
    pub tip: Option<f64>,
    /// The form removed.
    pub level: Level,
    /// The filters.
    pub filter: Option<Filter>,
    /// What a summit is.
    pub neighbours: Neighbours,
    /// The first or the second half of the map alone.
    pub half: Option<usize>,
}

impl Preparation {
    /// None, of a map that needs none.
    pub fn none(neighbours: Neighbours) -> Self {
        Self {
            removes_spikes: false,
            removes_suspects: false,
            aligned: None,
            tip: None,
            level: Level::None,
            filter: None,
            neighbours,
            half: None,
        }
    }
}

/// How asperities are found on a map.
pub struct SummitSearch<'a> {
    /// What is done to the map first.
    pub preparation: Preparation,
    /// Whether the ellipses of the asperities are wanted.
    pub as_ellipses: bool,
    /// What the map was made by, if it was made.
    pub generation: Option<GenerationFacts>,
    /// How closely the map is analysed and checked.
    pub depth: AnalysisDepth,
    /// Whether the map is divided into blocks for a sampling error.
    pub divides: bool,
    /// Correlation lengths of the heights, where they are known already.
    pub correlation: Option<CorrelationLengths>,
    /// The spikes of a measured map, where they are known already: of the same map and the same removal of spikes, and without suspects.
    pub spikes: Option<&'a FoundSpikes>,
    /// Whether the prepared map is kept.
    pub keeps_map: bool,
    /// Whoever watches.
    pub progress: &'a dyn Progress,
}

/// The spikes of a measured map as one preparation treats them.
#[derive(Debug, Clone, Default)]
pub struct FoundSpikes {
    /// Points that are removed as spikes, ascending.
    pub(super) removed: Vec<usize>,
    /// The spikes that are left; `None` where they are not searched.
    left: Option<Spikes>,
}

/// What is found on a map.
struct SearchedMap {
    set: AsperitySet,
    facts: MapFacts,
    independence: Independence,
    halves: Option<Division>,
    small: Option<Box<SmallMap>>,
    /// The prepared map, where it is kept.
    prepared: Option<PreparedMap>,
    /// Why the heights of its summits do not scatter, where they do not.
    unscattered: Option<NoAsperities>,
}

/// Heights that scatter by less, relative to themselves, are equal but for rounding.
const ROUNDING: f64 = 1e-12;

/// Spikes of a map beside spikes stand out only once those are gone: they are searched so many times at most.
const PASSES: usize = 20;

/// Share of the points beyond which no further spikes are searched: what stands out of so many points is no fault of single ones.
pub const MOST_SPIKE_POINTS: f64 = 0.01;

impl SummitSearch<'_> {
    /// Summits of a map that is checked, and divided into blocks for a sampling error.
    pub fn new(preparation: Preparation) -> Self {
        Self {
            preparation,
            as_ellipses: false,
            generation: None,
            depth: AnalysisDepth::Comparison,
            divides: true,
            correlation: None,
            spikes: None,
            keeps_map: false,
            progress: &Silent,
        }
    }

    /// The surface of the asperities that are found on a map, in the order of its points; without warnings.
    ///
    /// # Errors
    /// A map on which no asperities are found.
    pub fn surface(&self, name: &str, map: &dyn Rows) -> Result<Surface, NoAsperities> {
        let mut surface = self.any_surface(name, map)?;
        surface.unscattered.take().map_or(Ok(surface), Err)
    }

    /// The same, also of a map whose summits do not scatter, or that has none: neither model applies to it, boundary elements do
    /// ([`Surface::unscattered`]).
    ///
    /// # Errors
    /// A map that cannot be prepared, is flat, or has no point that could be a summit.
    pub fn any_surface(&self, name: &str, map: &dyn Rows) -> Result<Surface, NoAsperities> {
        let SearchedMap { set, facts, independence, halves, small, prepared, unscattered } =
            self.asperities(map)?;
        let (set, origin) = set.near_zero();
        let statistics = Statistics::new(&set);
        let mut surface = Surface::new(name, set, statistics);
        let moments = &facts.roughness.moments;
        let mean = moments.mean - origin;
        let plane = ReferencePlane { mean, sigma: moments.sq };
        surface.origin = origin + facts.offset;
        surface.mean_plane = Some(mean);
        surface.map = Some(facts);
        surface.independence = independence;
        surface.halves = halves;
        surface.small = small;
        surface.prepared = prepared;
        if surface.separations_of() == SigmaOf::Surface {
            surface.plane = plane;
        }
        if unscattered.is_some() {
            surface.plane = ReferencePlane { mean, sigma: f64::NAN };
        }
        surface.unscattered = unscattered;
        Ok(surface)
    }

    /// What is known of a map, and the map as prepared where it is kept.
    ///
    /// # Errors
    /// As of [`Self::surface`].
    pub(super) fn facts_and_map(
        &self,
        map: &dyn Rows,
    ) -> Result<(MapFacts, Option<PreparedMap>), NoAsperities> {
        self.asperities(map).map(|SearchedMap { facts, prepared, .. }| (facts, prepared))
    }

    /// Prepares and checks a map and finds its summits, row by row: only a filter and the closest depth need the map in
    /// memory.
    fn asperities(&self, raw: &dyn Rows) -> Result<SearchedMap, NoAsperities> {
        let progress = self.progress;
        let raw: &dyn Rows = &Watched { map: raw, progress };
        let halves = Window::halves(raw);
        let raw: &dyn Rows = self.preparation.half.map_or(raw, |half| &halves[half]);
        let FoundSpikes { removed, left } =
            if self.generation.is_none() { self.spikes(raw) } else { FoundSpikes::default() };
        self.preparation
            .steps(raw, &removed, progress, |steps| self.searched(raw, steps, removed.len(), left))
    }

    /// Checks a prepared map and finds its summits; so many spikes were removed of it, and these are left.
    fn searched(
        &self,
        raw: &dyn Rows,
        PreparationSteps { without, reach, levelled, last, .. }: PreparationSteps,
        removed: usize,
        left: Option<Spikes>,
    ) -> Result<SearchedMap, NoAsperities> {
        let progress = self.progress;
        let is_checked = self.depth != AnalysisDepth::Asperities;
        let map: &dyn Rows = &Watched { map: last, progress };
        progress.stage("roughness parameters", 2.0);
        let roughness = RoughnessParameters::new(map);
        if is_checked && self.generation.is_none() {
            self.check_long_filter(levelled, &roughness)?;
        }
        if roughness.moments.sq <= levelled.form.magnitude() * raw.precision().max(f64::EPSILON) {
            return Err(NoAsperities::Flat);
        }
        // The drops reveal only height steps of an instrument.
        let detail = Detail {
            positions: self.divides || self.keeps_map,
            principal: true,
            drops: self.generation.is_none() && is_checked,
        };
        progress.stage("summits", 1.0);
        let summits = find(map, self.preparation.neighbours, detail);
        let unscattered = unscattered(&summits, map, &roughness);
        if let Some(reason) = unscattered.as_ref().filter(|_| summits.tested == 0) {
            return Err(reason.clone());
        }
        let divides = self.divides && unscattered.is_none();
        let mut correlation = self.correlation;
        let mut aspect = None;
        if correlation.is_none() && (divides || is_checked) {
            // One for the copy, four of the correlation, two for blocks and halves.
            progress.stage("correlation", 7.0);
            let points = left.as_ref().map_or(&[][..], |left| &left.points);
            let found = correlation_of(&Without { map, points }, roughness.moments.mean, progress);
            aspect = found.as_ref().and_then(|(_, heights)| heights.largest_aspect());
            correlation = Some(found.map_or(CorrelationLengths::NONE, |(lengths, _)| lengths));
        }
        let independence = match correlation.filter(|_| divides) {
            Some(correlation) => Independence::of_map(map, correlation, &summits),
            None => Independence::Realisations,
        };
        let halves = (divides && is_checked).then(|| {
            let halves = Blocks::halves(map.points(), map.pixel());
            Division::of_blocks(&halves, &summits.positions, halves.shares(map))
        });
        let small = correlation.filter(|_| {
            is_checked && self.generation.is_none() && matches!(independence, Independence::TooSmall(_))
        });
        let small = small.map(|correlation| {
            progress.stage("process of the map", 1.0);
            Box::new(SmallMap {
                process: FittedProcess::new(&HeightMap::from_rows(map), &roughness.moments, &correlation),
                halves: [0, 1].map(|axis| {
                    let halves = Blocks::halves_along(map.points(), axis);
                    Division::of_blocks(&halves, &summits.positions, halves.shares(map))
                }),
            })
        });
        let spikes = left.map(|left| SpikeFacts { removed, left });
        let mut facts = self.facts(without, map, roughness, &summits, spikes);
        facts.correlation = correlation;
        facts.tip = reach.map(|reach| TipFacts { reach, radius: sharper_radius(&summits) });
        if is_checked {
            progress.stage("fitness checks", 4.0);
            facts.offsets = facts.spikes.is_some().then(|| LineOffsets::new(map));
            facts.measures = measures(map, &facts, &summits, aspect);
            facts.fitness = Finding::worst_of_each(&facts.measures);
        }
        let prepared = self.keeps_map.then(|| {
            progress.stage("copying the map", 1.0);
            PreparedMap { map: Arc::new(HeightMap::from_rows(map)), positions: summits.positions.clone() }
        });
        if !raw.is_whole() {
            return Err(NoAsperities::Shortened);
        }
        let [dx, dy] = map.pixel();
        let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
        let area = dx * dy * summits.tested as f64;
        let mut set = if summits.heights.is_empty() {
            AsperitySet::none_on(area)
        } else {
            AsperitySet::new(summits.heights, radii, area)?
        };
        if self.as_ellipses && unscattered.is_none() {
            set = set.with_ellipses(summits.principal.iter().copied().map(Ellipse::of_summit).collect())?;
        }
        Ok(SearchedMap { set, facts, independence, halves, small, prepared, unscattered })
    }

    /// Refuses an L filter that removes the waves of the `levelled` map.
    fn check_long_filter(
        &self,
        levelled: &dyn Rows,
        filtered: &RoughnessParameters,
    ) -> Result<(), NoAsperities> {
        /// Share of the variance of heights that a filter leaves of a surface with form.
        const LEAST_KEPT: f64 = 0.01;
        let Some(l) = self.preparation.filter.and_then(|filter| filter.l()) else { return Ok(()) };
        let before = RoughnessParameters::new(levelled);
        let [_, m2, m4] = before.spectral_moments();
        let wavelength = std::f64::consts::TAU * (m2 / m4).sqrt();
        let kept = (filtered.moments.sq / before.moments.sq).powi(2);
        // Form may be nearly all of the variance, but hardly adds to slopes.
        if kept < LEAST_KEPT && l < wavelength {
            return Err(NoAsperities::LongFilter { l, kept, wavelength });
        }
        Ok(())
    }

    /// The spikes of a measured map.
    pub(super) fn spikes(&self, raw: &dyn Rows) -> FoundSpikes {
        let Preparation { removes_spikes, removes_suspects, .. } = self.preparation;
        let mut removed = Vec::new();
        if self.depth == AnalysisDepth::Asperities && !removes_spikes && !removes_suspects {
            return FoundSpikes::default();
        }
        if let Some(known) = self.spikes {
            return known.clone();
        }
        self.progress.stage("spikes", 2.0);
        let mut left = Spikes::find(raw);
        let [nx, ny] = raw.points();
        let most = (MOST_SPIKE_POINTS * (nx * ny) as f64) as usize;
        let passes = if removes_spikes { PASSES } else { 0 };
        for pass in 0..passes {
            if left.count() == 0 || (pass > 0 && removed.len() + left.points.len() > most) {
                break;
            }
            removed.append(&mut left.points);
            removed.sort_unstable();
            self.progress.stage(&format!("spikes, pass {}", pass + 2), 2.0);
            left = Spikes::find(&Without { map: raw, points: &removed });
        }
        if removes_suspects {
            removed.append(&mut left.suspects);
            removed.sort_unstable();
        }
        FoundSpikes { removed, left: Some(left) }
    }

    fn facts(
        &self,
        raw: &dyn Rows,
        map: &dyn Rows,
        roughness: RoughnessParameters,
        summits: &Summits,
        spikes: Option<SpikeFacts>,
    ) -> MapFacts {
        let sq = roughness.moments.sq;
        let Preparation { aligned, level, filter, neighbours, .. } = self.preparation;
        let is_five_point = neighbours == Neighbours::Four;
        let is_checked = self.generation.is_none() && self.depth != AnalysisDepth::Asperities;
        // Two for the steps, one for the image.
        self.progress.stage("height steps and image", if is_checked { 3.0 } else { 1.0 });
        MapFacts {
            points: map.points(),
            pixel: map.pixel(),
            offset: map.offset(),
            tested: summits.tested,
            level,
            filter,
            aligned,
            neighbours,
            summits: summits.heights.len(),
            plateaus: summits.plateaus,
            dropped: summits.dropped,
            saddles: summits.principal.iter().filter(|principal| principal[1] <= 0.0).count(),
            expected: is_five_point.then(|| theory::five_point(&roughness.drops, sq, map.pixel())).flatten(),
            nayak: theory::nayak(roughness.spectral_moments()),
            quantisation: is_checked.then(|| Quantisation::new(raw, summits, filter.is_some())),
            spikes,
            fitness: Vec::new(),
            measures: Vec::new(),
            offsets: None,
            tip: None,
            correlation: None,
            is_held: [false; 2],
            generation: self.generation.clone(),
            whole: MapOverview::new(
                map,
                &roughness,
                self.generation.as_ref().map(|made| &made.generator),
                self.depth,
            ),
            roughness,
        }
    }
}

/// Why the heights of the summits of a map do not scatter, so that neither model applies; `None` where they do.
fn unscattered(summits: &Summits, map: &dyn Rows, roughness: &RoughnessParameters) -> Option<NoAsperities> {
    let count = summits.heights.len();
    if count == 1 || summits.tested == 0 {
        let missing = roughness.missing;
        return Some(NoAsperities::FewSummits { summits: count, points: map.points(), missing });
    }
    if count == 0 {
        return Some(NoAsperities::NoSummit { tested: summits.tested });
    }
    let (mean, sigma) = mean_and_sigma(&summits.heights);
    let is_rounding = sigma <= ROUNDING * (mean.abs() + roughness.moments.sq);
    is_rounding.then_some(NoAsperities::EqualHeights { summits: count })
}

/// The measures of the checks of a map that was searched.
fn measures(map: &dyn Rows, facts: &MapFacts, summits: &Summits, aspect: Option<f64>) -> Vec<Finding> {
    let [dx, dy] = facts.pixel;
    let count = summits.curvatures.len() as f64;
    let examined = Examined {
        map,
        spikes: facts.spikes.as_ref().map_or(&[], |spikes| &spikes.left.points),
        roughness: &facts.roughness,
        level: facts.level,
        found: [count / (dx * dy * summits.tested as f64), summits.curvatures.iter().sum::<f64>() / count],
        expected: facts.expected.filter(|_| count > 0.0),
        correlation: facts.correlation,
        aspect,
    };
    let measured = facts.spikes.as_ref().zip(facts.quantisation).map(|(spikes, quantisation)| Measured {
        shared_height: quantisation.shared.map(|shared| shared.share),
        spikes: spikes.left.count(),
        offsets: facts.offsets.unwrap_or_default(),
        step_over_drop: step_over_drop(map, &quantisation, facts.filter.as_ref()).filter(|_| count > 0.0),
        tip: facts.tip.map(|tip| [tip.radius / tip.reach.radius, tip.reach.untraced]),
    });
    examined.findings(measured.as_ref())
}

/// The smaller one of the mean radii (m) of all summits and of the highest, as few as carry an admissible load; infinite without any.
fn sharper_radius(summits: &Summits) -> f64 {
    if summits.heights.is_empty() {
        return f64::INFINITY;
    }
    let mut by_height: Vec<(f64, f64)> = summits
        .heights
        .iter()
        .zip(&summits.curvatures)
        .map(|(&z, curvature)| (z, curvature.recip()))
        .collect();
    by_height.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.total_cmp(&b.1)));
    let mean =
        |radii: &[(f64, f64)]| radii.iter().map(|(_, radius)| radius).sum::<f64>() / radii.len() as f64;
    mean(&by_height).min(mean(&by_height[..by_height.len().min(MIN_CONTACTS as usize)]))
}

/// The correlation lengths of a coarse map, and the autocorrelation of its heights.
fn correlation_of(
    map: &dyn Rows,
    mean: f64,
    progress: &dyn Progress,
) -> Option<(CorrelationLengths, Autocorrelation)> {
    /// Points along an axis of the coarse map.
    const MOST: usize = 1024;
    CorrelationLengths::from_map(&thumbnail(map, MOST), mean, progress)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Heights;
    use crate::topography::generate::{Plateau, Process, Seeds, SpectrumOf, SurfaceGenerator};
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};

    fn map(points: [usize; 2], height: impl Fn(usize) -> f64) -> HeightMap {
        HeightMap::new(points, [1.0, 2.0], (0..points[0] * points[1]).map(height).collect(), 0.0).unwrap()
    }

    fn facts(plateau: Option<Plateau>, neighbours: Neighbours) -> (HeightMap, MapFacts) {
        let generator =
            SurfaceGenerator { points: [64, 48], pixel: [1.0, 0.8], process: process(3.0), plateau };
        let (map, cut) = generator.surface(Seeds { process: [1; 32], plateau: [2; 32] }).unwrap();
        let generation = Some(GenerationFacts { generator, target: None, cut });
        let search = SummitSearch {
            generation,
            depth: AnalysisDepth::Everything,
            divides: false,
            ..SummitSearch::new(Preparation::none(neighbours))
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

    #[test]
    fn a_map_with_a_single_summit_says_why() {
        let refused = |points, height: &dyn Fn(usize) -> f64| {
            let preparation = Preparation { level: Level::None, ..Preparation::none(Neighbours::Four) };
            SummitSearch::new(preparation).surface("a", &map(points, height)).err().unwrap().to_string()
        };
        let small = refused([8, 8], &|k| if k == 27 { 1.0 } else { 0.0 });
        assert!(
            small.starts_with("has one summit only on 8 x 8 points: two of different heights are"),
            "{small}"
        );
        assert!(small.ends_with("; allowed: a larger map"), "{small}");
        let holes = refused([8, 8], &|k| if k % 2 == 0 { f64::NAN } else { k as f64 });
        assert!(
            holes.starts_with("has no summit on 8 x 8 points, 50 % of which are missing: two"),
            "{holes}"
        );
        assert!(holes.contains("fewer missing points"), "{holes}");
    }

    /// What is left of a plane far from zero is its rounding.
    #[test]
    fn a_plane_far_from_zero_is_flat_once_it_is_levelled() {
        let map = map([40, 30], |k| 1.0 + 1e-3 * (k / 30) as f64 + f64::EPSILON * ((k * k) % 2) as f64);
        let search = |level| {
            let preparation = Preparation { level, ..Preparation::none(Neighbours::Four) };
            SummitSearch {
                depth: AnalysisDepth::Asperities,
                divides: false,
                ..SummitSearch::new(preparation)
            }
            .asperities(&map)
        };
        assert!(matches!(search(Level::Plane), Err(NoAsperities::Flat)));
        assert!(matches!(search(Level::Quadratic), Err(NoAsperities::Flat)));
    }
}
