//! Making and reading the realisations of a surface.

use std::sync::Arc;
use std::time::Instant;

use asperity::compare::Repeats;
use asperity::numeric::stream_seed;
use asperity::surface::{
    AnalysisDepth, Fit, Independence, MapFacts, NoAsperities, Preparation, Step, SummitSearch, Surface,
    usual_long_filter,
};
use asperity::topography::{Continued, CorrelationLengths, Filter, Rows};
use asperity::work::{Counter, Item};
use asperity::{AsperityList, Draw, Ellipse, Ellipticity, Statistics};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::{InMemory, InputError, Source};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::Progress;
use asperity_contact_framework::report::format::{input_quantity, quantity};

use super::files::{Files, StoredSurface, SurfaceStore};
use super::fit::{self, as_written};
use super::fitness;
use super::pair::{PairPlan, PreparedPair, greenwood_tripp_caveat};
use super::plan::{MapPlan, Origin, SurfacePlan};
use super::reading::{list_message, spec_message};
use super::spec::DrawSpec;

/// Makes or reads the realisations of a surface.
pub struct SurfaceFactory<'a> {
    plan: &'a SurfacePlan,
    source: &'a Source,
    seed: u64,
    progress: &'a dyn Progress,
    counter: &'a Counter,
    /// A bandwidth that met the target before.
    bandwidth: Option<f64>,
    /// Whether a surface keeps its prepared map.
    keeps_map: bool,
    /// The measured map that was made last, as read.
    raw: Option<Arc<dyn Rows>>,
    /// The preparation that was found for it.
    fitted: Option<Preparation>,
    /// Both bodies of a pair, prepared.
    pair: Option<PreparedPair>,
    /// What keeps its first realisation.
    store: Option<&'a dyn SurfaceStore>,
    /// Whether surfaces without summits of different heights are made, too.
    is_any: bool,
}

impl<'a> SurfaceFactory<'a> {
    /// A factory of the realisations of `plan`, made one after the other.
    pub fn new(plan: &'a SurfacePlan, context: &RunContext<'a>, counter: &'a Counter) -> Self {
        let &RunContext { source, seed, progress, .. } = context;
        Self::from_seed(plan, source, seed, counter, progress)
    }

    /// The same with what it takes from the context.
    pub fn from_seed(
        plan: &'a SurfacePlan,
        source: &'a Source,
        seed: u64,
        counter: &'a Counter,
        progress: &'a dyn Progress,
    ) -> Self {
        Self {
            plan,
            source,
            seed,
            progress,
            counter,
            bandwidth: None,
            keeps_map: false,
            raw: None,
            fitted: None,
            pair: None,
            store: None,
            is_any: false,
        }
    }

    /// The same, whose first realisation is taken from `store`, or made in full and kept there.
    pub fn with_store(self, store: Option<&'a dyn SurfaceStore>) -> Self {
        Self { store, ..self }
    }

    /// The same, of surfaces that keep their prepared map if they have one and `keeps_map`.
    pub fn keeping_map(self, keeps_map: bool) -> Self {
        Self { keeps_map, ..self }
    }

    /// The same, of surfaces to which neither model applies, too, where `is_any` ([`Surface::unscattered`]).
    pub fn of_any(self, is_any: bool) -> Self {
        Self { is_any, ..self }
    }

    /// Makes or reads realisation `realisation` (from 1).
    pub fn make(
        &mut self,
        realisation: usize,
        depth: AnalysisDepth,
        files: &mut Files,
        timing: &mut Timing,
    ) -> Result<Surface, InputError> {
        let surface = self.any(realisation, depth, files, timing)?;
        let Some(error) = surface.unscattered.as_ref().filter(|_| !self.is_any) else { return Ok(surface) };
        let error = match &self.plan.origin {
            Origin::Map(map) => {
                let preparation = self.fitted.unwrap_or(map.preparation);
                let error = no_asperities(error, map.size(), preparation.filter);
                format!("{} {error}", map.file.path.display())
            }
            _ => error.to_string(),
        };
        let error = format!(
            "{error}; or boundary elements alone, which need no asperities: `models = [\"reference\"]` in `[compare]`"
        );
        Err(self.source.error_at(self.plan.size_key.clone(), error))
    }

    fn any(
        &mut self,
        realisation: usize,
        depth: AnalysisDepth,
        files: &mut Files,
        timing: &mut Timing,
    ) -> Result<Surface, InputError> {
        let Some(store) = self.store.filter(|_| realisation == 1) else {
            let surface = self.one(realisation, depth, files, timing)?;
            self.counter.add(Item::Surfaces, 1);
            return Ok(Surface { realisations: self.plan.realisations, ..surface });
        };
        let identity = store.identity(self.plan);
        if let Some(stored) = store.get(&identity) {
            self.raw.clone_from(&stored.raw);
            (self.fitted, self.bandwidth) = (stored.fitted, stored.bandwidth);
            return Ok(stored.surface.clone());
        }
        self.keeps_map = true;
        let surface = self.one(realisation, AnalysisDepth::Everything, files, timing)?;
        self.counter.add(Item::Surfaces, 1);
        let surface = Surface { realisations: self.plan.realisations, ..surface };
        // What was read of a file that changed meanwhile is of neither state.
        if store.identity(self.plan) == identity {
            store.put(identity, self.stored(surface.clone()));
        }
        Ok(surface)
    }

    /// A first realisation that it has made, with what other runs need of how it was made.
    pub fn stored(&self, surface: Surface) -> StoredSurface {
        StoredSurface { surface, raw: self.raw.clone(), fitted: self.fitted, bandwidth: self.bandwidth }
    }

    /// How a measured map is prepared; of one whose preparation is found on it, once it was made. `None` of other surfaces.
    pub fn preparation(&self) -> Option<Preparation> {
        match &self.plan.origin {
            Origin::Map(map) => Some(self.fitted.unwrap_or(map.preparation)),
            Origin::List { .. } | Origin::Population { .. } | Origin::Generated(_) | Origin::Pair(_) => None,
        }
    }

    /// The surface of the measured map that was made last, prepared in another way and not checked; its blocks are those of the
    /// `correlation` lengths given. `None` where it has no asperities, or no map was made.
    pub fn prepared(
        &self,
        preparation: Preparation,
        correlation: Option<CorrelationLengths>,
        progress: &dyn Progress,
    ) -> Option<Surface> {
        let search = SummitSearch { correlation, progress, ..SummitSearch::new(preparation) };
        self.treated(&**self.raw.as_ref()?, search)
    }

    /// The surface of a `map` that was derived from the prepared map of a surface with these `facts`: not prepared further and not
    /// checked; summits are searched and separations measured as there, and its blocks are those of the same correlation
    /// lengths. `None` where it has no asperities.
    pub fn derived(&self, map: &dyn Rows, facts: &MapFacts, progress: &dyn Progress) -> Option<Surface> {
        let preparation = Preparation::none(facts.neighbours);
        let (generation, correlation) = (facts.generation.clone(), facts.correlation);
        let search = SummitSearch { generation, correlation, progress, ..SummitSearch::new(preparation) };
        self.treated(map, search)
    }

    fn treated(&self, map: &dyn Rows, search: SummitSearch) -> Option<Surface> {
        let (as_ellipses, depth) = (self.plan.as_ellipses, AnalysisDepth::Asperities);
        let search = SummitSearch { as_ellipses, depth, ..search };
        self.counter.add(Item::Surfaces, 1);
        let surface = found(&self.plan.name, &search, (map, [false; 2]), &mut Timing::default()).ok()?;
        surface.unscattered.is_none().then_some(surface)
    }

    /// The search on a map of its own, in full.
    fn search(&self, preparation: Preparation, depth: AnalysisDepth) -> SummitSearch<'a> {
        SummitSearch {
            as_ellipses: self.plan.as_ellipses,
            depth,
            divides: self.divides(depth),
            keeps_map: self.keeps_map,
            progress: self.progress,
            ..SummitSearch::new(preparation)
        }
    }

    /// Calls `take` with the map of realisation `realisation` (from 1) after each step of its preparation, in order; of a surface that is
    /// not measured with its map alone, which is not prepared. Where the preparation is found on the map, it is known from then on.
    pub fn each_step(
        &mut self,
        realisation: usize,
        files: &mut Files,
        mut take: impl FnMut(&Preparation, Step, &dyn Rows),
    ) -> Result<(), InputError> {
        let refuse = |error: String| self.source.error_at(self.plan.size_key.clone(), error);
        let mut timing = Timing::default();
        let Origin::Map(map) = &self.plan.origin else {
            if self.plan.has_given_asperities() {
                let message = format!(
                    "surface {} has no height map: {}; allowed: a surface of [surface.NAME.file], [surface.NAME.generate] or \
                     [surface.NAME.pair]",
                    self.plan.name,
                    self.plan.describe()
                );
                return Err(refuse(message));
            }
            self.keeps_map = true;
            let surface = self.one(realisation, AnalysisDepth::Asperities, files, &mut timing)?;
            if let (Some(prepared), Some(facts)) = (&surface.prepared, &surface.map) {
                take(&Preparation::none(facts.neighbours), Step::Measured, &*prepared.map);
            }
            return Ok(());
        };
        let (rows, fit) = self.measured(map, AnalysisDepth::Comparison, files, &mut timing)?;
        self.fitted = fit.as_ref().map(|fit| as_written(&fit.preparation));
        let preparation = self.fitted.unwrap_or(map.preparation);
        let search = SummitSearch {
            depth: AnalysisDepth::Asperities,
            spikes: fit.as_ref().map(|fit| &fit.spikes),
            progress: self.progress,
            ..SummitSearch::new(preparation)
        };
        let steps = search.each_step(&*rows, |step, map| take(&preparation, step, map));
        steps.map_err(|error| {
            let error = no_asperities(&error, map.size(), preparation.filter);
            refuse(format!("{} {error}", map.file.path.display()))
        })
    }

    /// A measured map as read, and the preparation that is found on it where the spec leaves it open.
    fn measured(
        &self,
        map: &MapPlan,
        depth: AnalysisDepth,
        files: &mut Files,
        timing: &mut Timing,
    ) -> Result<(Arc<dyn Rows>, Option<Fit>), InputError> {
        let refuse = |error: &dyn std::fmt::Display| {
            let message = format!("{} {error}", map.file.path.display());
            self.source.error_at(self.plan.size_key.clone(), message)
        };
        let start = Instant::now();
        self.progress.stage("reading", 1.0);
        let mut rows = match self.source.content_in_memory(&map.file.path) {
            Some(InMemory::Map { rows, .. }) => Arc::clone(rows),
            _ => files.map(&map.file, self.progress).map_err(|error| refuse(&spec_message(&error)))?,
        };
        if map.is_periodic {
            rows = Arc::new(Continued(rows));
        }
        timing.read += start.elapsed();
        let Some(kept) = map.fit else { return Ok((rows, None)) };
        let found = Fit::new(&*rows, map.preparation, kept, depth, self.progress);
        let filter = map.preparation.filter;
        let fit = found.map_err(|error| refuse(&no_asperities(&error, map.size(), filter)))?;
        Ok((rows, Some(fit)))
    }

    /// Whether a map is divided into blocks: unless its realisations give the sampling error. Relative positions of two bodies alone do not.
    fn divides(&self, depth: AnalysisDepth) -> bool {
        depth != AnalysisDepth::Asperities && self.plan.is_one()
    }

    fn one(
        &mut self,
        realisation: usize,
        depth: AnalysisDepth,
        files: &mut Files,
        timing: &mut Timing,
    ) -> Result<Surface, InputError> {
        let (name, source) = (&self.plan.name, self.source);
        let key = &self.plan.size_key;
        let refuse = |error: &dyn std::fmt::Display| source.error_at(key.clone(), error);
        let start = Instant::now();
        match &self.plan.origin {
            Origin::List { path, given, nominal_area, is_independent, .. } => {
                self.progress.stage("reading", 1.0);
                let list = match source.content_in_memory(path) {
                    Some(InMemory::List(list)) => AsperityList::clone(list),
                    _ => files
                        .list(path, *given, self.progress)
                        .map_err(|error| refuse(&list_message(path, &error)))?,
                };
                timing.read += start.elapsed();
                let takes_metres = list.takes_metres();
                let (contradictions, count) = (list.contradictions(), list.count());
                let spread = list.places().and_then(|places| misplaced(places, *nominal_area));
                let independence = match list.places() {
                    _ if *is_independent => (Independence::Asperities, None),
                    Some(places) => Independence::of_places(list.heights(), places),
                    None => (Independence::Unstated, None),
                };
                let (set, origin) = list.set(*nominal_area).map_err(|error| refuse(&error))?.near_zero();
                let statistics = Statistics::new(&set);
                if statistics.sigma == 0.0 {
                    return Err(refuse(&format!(
                        "{}: all heights are equal: both models search and report separations, under load control too, in \
                         standard deviations of the heights, which are zero here; allowed: asperities of different heights",
                        path.display()
                    )));
                }
                if statistics.sigma > nominal_area.sqrt() {
                    return Err(refuse(&format!(
                        "{}: the standard deviation of heights, {}, is above the side of the nominal area, {}: heights and area are in \
                         different units{}",
                        path.display(),
                        quantity(statistics.sigma, "m"),
                        quantity(nominal_area.sqrt(), "m"),
                        if takes_metres {
                            "; heights and radii were read as metres: `unit = \"um\"` next to `file` says otherwise"
                        } else {
                            ""
                        }
                    )));
                }
                let mut surface = Surface::new(name, set, statistics);
                surface.taken_for_metres = takes_metres.then_some("Heights and radii");
                surface.origin = origin;
                (surface.independence, surface.halves) = independence;
                surface.warnings.extend(spread);
                if matches!(surface.independence, Independence::Unstated) {
                    surface.warnings.push(UNSTATED.to_owned());
                }
                if contradictions > 0 {
                    surface.warnings.push(format!(
                        "{contradictions} of {count} radii are outside the range from 1/kx to 1/ky: laws for spheres use the radius, \
                         elliptic laws use kx and ky, so that the two describe different asperities"
                    ));
                }
                Ok(surface)
            }
            Origin::Population { population, ratio, count, draw, plane, bodies, no_composite } => {
                let draw = match draw {
                    DrawSpec::Random => Draw::Random(stream_seed(
                        self.seed,
                        &format!("population {name} realisation {realisation}"),
                    )),
                    DrawSpec::Quantiles => Draw::Quantiles,
                };
                let mut set = population.set(*count, draw).map_err(|error| refuse(&error))?;
                let mean_curvature = population.radius.recip();
                let ratio = ratio.filter(|_| self.plan.as_ellipses);
                if let Some(curvature_ratio) = ratio {
                    let ellipse = Ellipse { mean_curvature, curvature_ratio };
                    set = set.with_ellipses(vec![ellipse; *count]).map_err(|error| refuse(&error))?;
                }
                timing.generate += start.elapsed();
                let statistics = Statistics::new(&set);
                let mut surface = Surface::new(name, set, statistics);
                surface.ellipticity =
                    ratio.map(|ratio| Ellipticity { mean_curvature, mean_ratio: ratio.recip() });
                surface.plane = *plane;
                surface.mean_plane = Some(plane.mean).filter(|&mean| mean != 0.0);
                surface.nominal = Some(population.clone());
                surface.bodies = bodies.clone();
                surface.warnings.extend(surface.bodies.as_deref().and_then(greenwood_tripp_caveat));
                surface.meets_in_pairs = no_composite.is_some();
                surface.warnings.extend(no_composite.iter().map(|reason| {
                    format!(
                        "no isotropic Gaussian surface has these asperities ({reason}): in place of their composite the statistical model is \
                         the integral of Greenwood and Tripp (1971), and its radius, sigma and density are those of pairs that meet."
                    )
                }));
                Ok(surface)
            }
            Origin::Generated(generation) => {
                let made = generation
                    .make(self.seed, name, realisation, self.bandwidth, self.progress)
                    .map_err(|error| source.error_at(generation.key.clone(), error))?;
                timing.generate += start.elapsed();
                self.bandwidth = made.bandwidth;
                let search = self.search(Preparation::none(generation.neighbours), depth);
                let search = SummitSearch { generation: Some(made.facts), ..search };
                found(name, &search, (&made.map, [false; 2]), timing).map_err(|error| refuse(&error))
            }
            Origin::Pair(plan) => {
                let pair = match self.pair.take() {
                    Some(pair) => pair,
                    None => plan.make(source, files, |body, files| {
                        let (seed, counter, progress) = (self.seed, self.counter, self.progress);
                        let mut factory = SurfaceFactory::from_seed(body, source, seed, counter, progress)
                            .keeping_map(true)
                            .of_any(true);
                        factory.make(1, AnalysisDepth::Comparison, files, timing)
                    })?,
                };
                let start = Instant::now();
                let map = pair.maps.sum(PairPlan::placement(&pair.maps, self.seed, name, realisation));
                timing.generate += start.elapsed();
                let search = self.search(Preparation::none(plan.neighbours), depth);
                let mut surface =
                    timed(name, &search, (&map, [true; 2]), timing).map_err(|error| refuse(&error))?;
                surface.repeats = Repeats::Shifts;
                surface.warnings = own_warnings(&surface);
                surface.warnings.extend(greenwood_tripp_caveat(&pair.bodies));
                surface.bodies = Some(Box::new(pair.bodies.clone()));
                if let Some(facts) = &mut surface.map {
                    facts.fitness.extend(pair.faults.iter().cloned());
                }
                surface.warnings.extend(pair.warnings.iter().cloned());
                surface.warnings.push(plan.caveat(&pair.maps, self.seed, name, self.plan.realisations));
                self.pair = Some(pair);
                Ok(surface)
            }
            Origin::Map(map) => {
                let refuse =
                    |error: &dyn std::fmt::Display| refuse(&format!("{} {error}", map.file.path.display()));
                let (rows, fit) = self.measured(map, depth, files, timing)?;
                self.fitted = fit.as_ref().map(|fit| as_written(&fit.preparation));
                let preparation = self.fitted.unwrap_or(map.preparation);
                let spikes = fit.as_ref().map(|fit| &fit.spikes);
                let search = SummitSearch { spikes, ..self.search(preparation, depth) };
                let mut surface = timed(name, &search, (&*rows, map.is_held), timing)
                    .map_err(|error| refuse(&no_asperities(&error, map.size(), preparation.filter)))?;
                let [width, length] = map.size();
                let sq = surface.map.as_ref().map_or(0.0, |map| map.roughness.moments.sq);
                if let Some(what) = map.taken_for_metres.filter(|_| sq > (width * length).sqrt()) {
                    let unit = if what == "Heights" {
                        "unit = \"um\""
                    } else {
                        "unit = { xy = \"mm\", z = \"um\" }"
                    };
                    return Err(refuse(&format!(
                        "has heights of {} (Sq) on a map of {} x {}; {} were read as metres: `{unit}` says otherwise",
                        quantity(sq, "m"),
                        quantity(width, "m"),
                        quantity(length, "m"),
                        what.to_lowercase()
                    )));
                }
                surface.taken_for_metres = map.taken_for_metres;
                surface.fit = fit.map(Box::new);
                surface.warnings = own_warnings(&surface);
                surface.warnings.extend(surface.fit.as_deref().map(fit::caveat));
                surface.warnings.extend(map.caveats.iter().cloned());
                self.raw = Some(rows);
                Ok(surface)
            }
        }
    }
}

/// What a list without `independent` and places lacks.
const UNSTATED: &str = "neighbouring asperities of a surface are alike, and nothing says that those of this list are not: no interval is \
     claimed and no verdict given. `independent = true` next to `file` says that they are independent draws, whose scatter gives \
     intervals; columns `x` and `y` in the file divide them into blocks instead.";

/// Warns where the rectangle that holds the places of a list (m) is not about the nominal area (m^2).
fn misplaced(places: [&[f64]; 2], nominal_area: f64) -> Option<String> {
    /// Beyond this ratio, either way, one of them is in another unit.
    const FACTOR: f64 = 4.0;
    let side = |places: &[f64]| {
        let (low, high) = places
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &at| (low.min(at), high.max(at)));
        high - low
    };
    let held = side(places[0]) * side(places[1]);
    let ratio = held / nominal_area;
    (!(FACTOR.recip()..=FACTOR).contains(&ratio)).then(|| {
        format!(
            "the columns x and y span {}, the nominal area is {}: one of them is probably in another unit.",
            quantity(held, "m²"),
            quantity(nominal_area, "m²")
        )
    })
}

/// Why a map of this size (m) has no asperities, with the S filter as the likely cause where there is one.
fn no_asperities(error: &NoAsperities, size: [f64; 2], filter: Option<Filter>) -> String {
    if let &NoAsperities::LongFilter { l, kept, wavelength } = error {
        return format!(
            "has no roughness left after the L filter of {}: it is shorter than the waves of the map (mean wavelength {}) and leaves \
             {kept:.0e} of their variance; allowed: a longer one, such as `filter = {{ l = \"{}\" }}` (a sixth of the shorter side), or none",
            input_quantity(l, "m"),
            quantity(wavelength, "m"),
            input_quantity(usual_long_filter(size), "m")
        );
    }
    match (error, filter.and_then(|filter| filter.s())) {
        (NoAsperities::Flat | NoAsperities::NoSummit { .. }, Some(s)) => format!(
            "{error}, after the S filter of {}, which removes all shorter waves: write a shorter one, as in `filter = {{ s = \"{}\" }}`, \
             or none",
            input_quantity(s, "m"),
            input_quantity(0.1 * s, "m")
        ),
        _ => error.to_string(),
    }
}

/// The surface of the asperities that are found on a map, and whether its file holds pixel and unit, with its warnings.
fn found(
    name: &str,
    search: &SummitSearch,
    map: (&dyn Rows, [bool; 2]),
    timing: &mut Timing,
) -> Result<Surface, NoAsperities> {
    let surface = timed(name, search, map, timing)?;
    Ok(Surface { warnings: own_warnings(&surface), ..surface })
}

/// The same without warnings.
fn timed(
    name: &str,
    search: &SummitSearch,
    (map, is_held): (&dyn Rows, [bool; 2]),
    timing: &mut Timing,
) -> Result<Surface, NoAsperities> {
    let start = Instant::now();
    let mut surface = search.any_surface(name, map)?;
    timing.summits += start.elapsed();
    if let Some(map) = &mut surface.map {
        map.is_held = is_held;
    }
    Ok(surface)
}

/// What a reader should know of the map and the asperities of a surface.
fn own_warnings(surface: &Surface) -> Vec<String> {
    let mut warnings = surface.map.as_ref().map_or_else(Vec::new, fitness::warnings);
    warnings.extend(fitness::failures(surface));
    warnings.extend(surface.unscattered.as_ref().map(|reason| {
        let pressed = if surface.map.as_ref().is_some_and(MapFacts::is_nearly_complete) {
            "; boundary elements need no asperities (`models = [\"reference\"]`), separations are from the mean plane, areas those of the \
             points in contact"
        } else {
            ""
        };
        format!(
            "neither the integral nor the sum over asperities applies: the map {}{pressed}.",
            fitness::without_advice(reason)
        )
    }));
    warnings
}
