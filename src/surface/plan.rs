//! The surfaces of an experiment: planned from the spec, then made or read.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use asperity::surface::{BodyAsperities, Kept, MapFacts, Preparation};
use asperity::topography::read::{MapFile, Metadata, ReadError, ReadOptions, ReadOptionsError, UnitOrigin};
use asperity::topography::{Boundary, Filter, Level, read};
use asperity::{
    AsperityList, Heights, ListError, ListOptions, MapError, Population, ReferencePlane, SurfaceHeights,
};
use asperity_contact_framework::input::quantity::{Length, Pure, Quantity};
use asperity_contact_framework::input::{InMemory, InputError, Source, Spanned, SpecFile, Whole};
use indexmap::IndexMap;

use crate::plausibility;
use crate::surface::files::Reading;
use crate::surface::generation::Generation;
use crate::surface::pair::{self, PairPlan};
use crate::surface::reading::{list_message, options_message, spec_message};
use crate::surface::spec::{
    DrawSpec, FileSpec, FitSpec, ListSpec, Outliers, PopulationHeights, PopulationSpec, SurfaceSpec,
};
use crate::surface::{memory, reading};

/// A surface that can be made.
#[derive(Debug)]
pub struct SurfacePlan {
    pub name: String,
    /// Its position in the spec.
    pub size_key: Range<usize>,
    /// Number of realisations; 1 for a given or measured surface.
    pub realisations: usize,
    /// Whether a law treats its asperities as ellipses.
    pub(super) as_ellipses: bool,
    pub(super) origin: Origin,
}

#[derive(Debug)]
pub(super) enum Origin {
    List {
        path: PathBuf,
        given: ListOptions,
        rows: usize,
        nominal_area: f64,
        is_independent: bool,
    },
    Population {
        population: Population,
        ratio: Option<f64>,
        count: usize,
        draw: DrawSpec,
        plane: ReferencePlane,
        /// Those whose composite it is.
        bodies: Option<Box<[BodyAsperities; 2]>>,
        /// Why these have none, so that it is of their pairs that meet.
        no_composite: Option<String>,
    },
    Generated(Box<Generation>),
    Map(Box<MapPlan>),
    Pair(Box<PairPlan>),
}

#[derive(Debug)]
pub(super) struct MapPlan {
    pub(super) file: MapFile,
    /// What of its text was taken for metres because nothing names a unit.
    pub(super) taken_for_metres: Option<&'static str>,
    /// What a reader should know of how it is read.
    pub(super) caveats: Vec<String>,
    pub(super) points: [usize; 2],
    /// Points that are read of its file, of which these may be a part.
    pub(super) read: usize,
    /// Their distances, m.
    pub(super) pixel: [f64; 2],
    /// Whether its file holds pixel and unit.
    pub(super) is_held: [bool; 2],
    /// Whether its heights stay on disk.
    pub(super) is_on_disk: bool,
    pub(super) is_periodic: bool,
    pub(super) preparation: Preparation,
    /// What stays of the preparation where the rest of it is found on the map.
    pub(super) fit: Option<Kept>,
}

impl MapPlan {
    /// Its sides, m.
    pub(super) fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.points[axis] as f64 * self.pixel[axis])
    }
}

/// The stage in which a file is looked through before a run.
const CHECKING: &str = "checking the file";

/// Points of the shortest wave that a grid holds.
const FEWEST_PER_WAVE: f64 = 2.0;

/// Points of a map per shortest wave of a self-affine surface of Hurst exponent 0.8 that has the r.m.s. slope and curvature of the map.
pub fn points_per_wave_on(map: &MapFacts) -> f64 {
    /// Square of the mean wave number of the slope over that of the curvature's cut-off, (2 - 2 H)/(4 - 2 H) inverted.
    const SHARE: f64 = 6.0;
    let [_, m2, m4] = map.roughness.spectral_moments();
    let wavelength = std::f64::consts::TAU * (m2 / (SHARE * m4)).sqrt();
    (wavelength / map.pixel[0].max(map.pixel[1])).max(FEWEST_PER_WAVE)
}

/// More are a study of their own.
const MOST_REALISATIONS: u64 = 1000;

impl SurfacePlan {
    /// Checks everything about a surface that is known before it is made; a pair is of two of `all`.
    pub(super) fn new(
        file: &SpecFile,
        name: &Spanned<String>,
        raw: &Spanned<SurfaceSpec>,
        all: &Surfaces,
        as_ellipses: bool,
    ) -> Result<Self, InputError> {
        let source = &file.source;
        // The name becomes part of file names.
        let is_plain = |name: &str| {
            !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '-' || c == '_')
        };
        if !is_plain(name.get_ref()) {
            return Err(source.error_at(
                name.span(),
                format!("found the surface name \"{}\"; allowed: letters, digits, - and _", name.get_ref()),
            ));
        }
        let (origin, size_key, realisations) = match raw.get_ref() {
            SurfaceSpec::Asperities(list) => (Self::list(file, list, as_ellipses)?, list.file.span(), &None),
            SurfaceSpec::Population(population) => {
                let origin = Self::population(source, raw.span(), population, as_ellipses)?;
                (origin, population.count.span(), &population.realisations)
            }
            SurfaceSpec::Generate(generate) => {
                let origin = Origin::Generated(Box::new(Generation::new(source, raw.span(), generate)?));
                (origin, generate.points.span(), &generate.realisations)
            }
            SurfaceSpec::File(map) => (Self::map(file, map)?, map.path.span(), &None),
            SurfaceSpec::Pair(pair) => match pair::of_populations(source, pair, all)? {
                Some(composite) => (composite, pair.a.span(), &None),
                None => {
                    let plan = PairPlan::new(file, pair, all, as_ellipses)?;
                    (Origin::Pair(Box::new(plan)), pair.a.span(), &pair.shifts)
                }
            },
        };
        let realisations = match realisations {
            None if matches!(origin, Origin::Pair(_)) => pair::SHIFTS as usize,
            None => 1,
            Some(count) if (1..=MOST_REALISATIONS).contains(&count.get_ref().0) => count.get_ref().0 as usize,
            Some(count) => {
                let message = format!("found {}; allowed: 1 to {MOST_REALISATIONS}", count.get_ref().0);
                return Err(source.error_at(count.span(), message));
            }
        };
        Ok(Self { name: name.get_ref().clone(), size_key, realisations, as_ellipses, origin })
    }

    /// A surface that is generated; `size_key` is the position of its size in the spec.
    pub fn generated(
        name: String,
        size_key: Range<usize>,
        realisations: usize,
        as_ellipses: bool,
        generation: Generation,
    ) -> Self {
        Self { name, size_key, realisations, as_ellipses, origin: Origin::Generated(Box::new(generation)) }
    }

    fn list(file: &SpecFile, raw: &ListSpec, as_ellipses: bool) -> Result<Origin, InputError> {
        let source = &file.source;
        let path = beside(source, &raw.file)?;
        let unit = raw.unit.as_ref().map(|unit| unit.get_ref().0);
        let given = ListOptions { as_ellipses, unit };
        let refuse =
            |message: &str| source.error_at(raw.file.span(), format!("{} {message}", path.display()));
        let rows = match source.content_in_memory(&path) {
            Some(InMemory::Map { .. }) => {
                return Err(refuse("is a height map; allowed: a list of asperities"));
            }
            Some(InMemory::List(list)) if as_ellipses && !list.has_curvatures() => {
                return Err(refuse(
                    "has no principal curvatures, which a law for ellipses needs; allowed: kx and ky beside the radii",
                ));
            }
            Some(InMemory::List(list)) => list.count(),
            None => {
                file.progress.stage(CHECKING, 1.0);
                AsperityList::check(&path, given, file.progress).map_err(|error| {
                    let key = raw.unit.as_ref().filter(|_| matches!(error, ListError::UnitHeld { .. }));
                    let key = key.map_or_else(|| raw.file.span(), Spanned::span);
                    source.error_at(key, list_message(&path, &error))
                })?
            }
        };
        let nominal_area = raw.nominal_area.value();
        Ok(Origin::List { path, given, rows, nominal_area, is_independent: raw.independent })
    }

    pub(super) fn population(
        source: &Source,
        span: Range<usize>,
        raw: &PopulationSpec,
        as_ellipses: bool,
    ) -> Result<Origin, InputError> {
        let ratio = curvature_ratio(source, &span, raw.curvature_ratio.as_ref(), as_ellipses)?;
        let Whole(count) = *raw.count.get_ref();
        let count = usize::try_from(count).ok().filter(|&count| count > 0).ok_or_else(|| {
            source.error_at(raw.count.span(), format!("found {count}; allowed: at least one asperity"))
        })?;
        let (radius, sigma, density) = (raw.radius.value(), raw.sigma.value(), raw.density.value());
        let mut population = Population { radius, sigma, density, heights: Heights::GAUSSIAN };
        let mut plane = ReferencePlane { mean: 0.0, sigma };
        match &raw.heights {
            PopulationHeights::Asperities(heights) => population.heights = heights.clone(),
            PopulationHeights::Surface => {
                let surface = SurfaceHeights { radius, sigma, density };
                population.sigma = surface.asperity_sigma().map_err(|error| source.error_at(span, error))?;
                plane.mean = -surface.mean_asperity_height();
            }
        }
        Ok(Origin::Population {
            population,
            ratio,
            count,
            draw: raw.draw,
            plane,
            bodies: None,
            no_composite: None,
        })
    }

    fn map(spec: &SpecFile, raw: &FileSpec) -> Result<Origin, InputError> {
        let source = &spec.source;
        let path = beside(source, &raw.path)?;
        let refuse = |error: &dyn std::fmt::Display| {
            source.error_at(raw.path.span(), format!("{} {error}", path.display()))
        };
        let in_memory = match source.content_in_memory(&path) {
            Some(InMemory::Map { rows, caveats }) => Some((rows, caveats)),
            Some(InMemory::List(_)) => return Err(refuse(&"is a list of asperities; allowed: a height map")),
            None => None,
        };
        let options = ReadOptions {
            pixel: raw.pixel.as_ref().map(|pixel| pixel.get_ref().0),
            unit: raw.unit.as_ref().map(|unit| unit.get_ref().0),
        };
        let missing = raw.missing.as_ref().map(|missing| missing.get_ref().0.clone());
        let channel = raw.channel.as_ref().map(|channel| channel.get_ref().clone());
        let crop = raw.crop.as_ref().map(|crop| crop.get_ref().part()).unwrap_or_default();
        let file = MapFile { path: path.clone(), options, missing, transpose: raw.transpose, crop, channel };
        let metadata = match in_memory {
            Some(_) if file != MapFile::new(&path, ReadOptions::default()) => {
                return Err(refuse(
                    &"is a map in memory; allowed: leave pixel, unit, missing, channel, transpose and crop out",
                ));
            }
            Some((map, _)) => Metadata::in_memory(&**map),
            None => {
                spec.progress.stage(CHECKING, 1.0);
                file.watched_metadata(spec.progress).map_err(|error| {
                    let key = match error {
                        ReadError::Channel { .. } | ReadError::NoChannels { .. } => {
                            raw.channel.as_ref().map(Spanned::span)
                        }
                        ReadError::Crop { .. } => raw.crop.as_ref().map(Spanned::span),
                        ReadError::NoWords { .. } => raw.missing.as_ref().map(Spanned::span),
                        _ => None,
                    };
                    let message = format!("{} {}", path.display(), spec_message(&error));
                    source.error_at(key.unwrap_or_else(|| raw.path.span()), message)
                })?
            }
        };
        let points = metadata.points;
        if points.iter().any(|&count| count < 3) {
            return Err(refuse(&MapError::TooSmall(points)));
        }
        let pixel = metadata.pixel(&options).map_err(|error| {
            let lacks_both = matches!(error, ReadOptionsError::NoUnit { .. })
                && metadata.pixel.or(options.pixel).is_none();
            let pixel = if lacks_both { "; and the pixel, such as `pixel = \"0.8 um\"`" } else { "" };
            let notes: String = metadata.notes.iter().map(|note| format!(". It {note}")).collect();
            refuse(&(options_message(&error) + pixel + &notes))
        })?;
        let filter = match &raw.filter {
            None => None,
            Some(filter) => {
                let index = |quantity: Option<Quantity<Length>>| quantity.map(|q| q.value());
                let indices = filter.get_ref();
                let made = Filter::new(index(indices.s), index(indices.l)).and_then(|made| {
                    made.check(points, pixel)?;
                    Ok(made)
                });
                let made = made.map_err(|error| source.error_at(filter.span(), error))?;
                memory::check_long(made, points, pixel)
                    .map_err(|message| source.error_at(filter.span(), message))?;
                Some(made)
            }
        };
        let continues =
            raw.periodic || in_memory.is_some_and(|(map, _)| map.boundary() == Boundary::Periodic);
        let is_periodic = continues && crop.is_whole();
        let preparation = Preparation {
            removes_spikes: raw.outliers == Some(Outliers::Remove),
            removes_suspects: false,
            aligned: raw.align_lines,
            tip: raw.tip.map(|radius| radius.value()),
            level: raw.level.unwrap_or(if is_periodic { Level::None } else { Level::default() }),
            filter,
            neighbours: raw.neighbours,
            half: None,
        };
        // What is in memory takes no more of it.
        let is_on_disk = match in_memory {
            Some(_) => true,
            None => file.stays_on_disk().map_err(|error| refuse(&spec_message(&error)))?,
        };
        let mut caveats = reading::caveats(&metadata, pixel, &file);
        caveats.extend(in_memory.into_iter().flat_map(|(_, caveats)| caveats.clone()));
        caveats.extend(filter.and_then(|filter| memory::short_caveat(filter, pixel)));
        let fit = raw.fit.map(|FitSpec::Auto| Kept {
            spikes: raw.outliers.is_some(),
            lines: raw.align_lines.is_some(),
            level: raw.level.is_some(),
            s: filter.is_some_and(|filter| filter.s().is_some()),
            l: filter.is_some_and(|filter| filter.l().is_some()),
        });
        let is_held = [metadata.pixel.is_some(), metadata.has_unit];
        // An array is in metres, as its users know; what a text is in nobody does.
        let is_assumed = metadata.unit_origin(&options) == UnitOrigin::Assumed && !metadata.has_x_first();
        let has_coordinates = metadata.pixel.is_some() && !metadata.pixel_has_unit;
        Ok(Origin::Map(Box::new(MapPlan {
            file,
            taken_for_metres: is_assumed.then_some(if has_coordinates {
                "Coordinates and heights"
            } else {
                "Heights"
            }),
            caveats,
            points,
            read: metadata.read,
            pixel,
            is_held,
            is_on_disk,
            is_periodic,
            preparation,
            fit,
        })))
    }

    /// The files that it is read from.
    pub fn inputs(&self) -> Vec<PathBuf> {
        match &self.origin {
            Origin::List { path, .. } => vec![path.clone()],
            Origin::Map(map) => vec![map.file.path.clone()],
            Origin::Population { .. } | Origin::Generated(_) => Vec::new(),
            Origin::Pair(pair) => pair.bodies.iter().flat_map(Self::inputs).collect(),
        }
    }

    /// The same with the ellipses of its asperities, where it has a map or ellipses of its own.
    #[must_use]
    pub fn with_own_ellipses(mut self) -> Self {
        self.as_ellipses |= match &self.origin {
            Origin::Population { ratio, .. } => ratio.is_some(),
            Origin::List { .. } => false,
            Origin::Generated(_) | Origin::Map(_) | Origin::Pair(_) => true,
        };
        self
    }

    /// What a reader should know of how its file is read.
    pub fn caveats(&self) -> &[String] {
        match &self.origin {
            Origin::Map(map) => &map.caveats,
            Origin::List { .. } | Origin::Population { .. } | Origin::Generated(_) | Origin::Pair(_) => &[],
        }
    }

    /// Whether it is a list of asperities.
    pub fn is_list(&self) -> bool {
        matches!(self.origin, Origin::List { .. })
    }

    /// Whether its asperities are given, by a list or a population, not found on a map.
    pub fn has_given_asperities(&self) -> bool {
        matches!(self.origin, Origin::List { .. } | Origin::Population { .. })
    }

    /// Points of its height map along x and y; `None` of given asperities.
    pub fn map_points(&self) -> Option<[usize; 2]> {
        match &self.origin {
            Origin::Generated(generation) => Some(generation.points()),
            Origin::Map(map) => Some(map.points),
            Origin::Pair(pair) => Some(pair.grid().0),
            Origin::List { .. } | Origin::Population { .. } => None,
        }
    }

    /// Points of its height map per shortest wave: the cut-off of a random surface, the S filter's nesting index of a measured
    /// one, without which only the map tells; `None` of given asperities.
    pub fn points_per_wave(&self) -> Option<f64> {
        match &self.origin {
            Origin::Generated(generation) => Some(generation.points_per_wave()),
            Origin::Map(map) => {
                let shortest = map.preparation.filter.and_then(|filter| filter.s())?;
                Some((shortest / map.pixel[0].max(map.pixel[1])).max(FEWEST_PER_WAVE))
            }
            Origin::Pair(pair) => pair.bodies.iter().filter_map(Self::points_per_wave).reduce(f64::min),
            Origin::List { .. } | Origin::Population { .. } => None,
        }
    }

    /// Distance of the points of its height map along x and y, m; `None` without a map, and where it follows from summits.
    pub fn pixel(&self) -> Option<[f64; 2]> {
        match &self.origin {
            Origin::Generated(generation) => generation.pixel(),
            Origin::Map(map) => Some(map.pixel),
            Origin::Pair(pair) => Some(pair.grid().1),
            Origin::List { .. } | Origin::Population { .. } => None,
        }
    }

    /// Its nominal area, m²: that of the points inside the border of a map that does not continue, of which points beside missing ones
    /// are not yet taken away. `None` where it follows from the summits of a random surface, and of a pair of maps that do not repeat.
    pub fn nominal_area(&self) -> Option<f64> {
        match &self.origin {
            Origin::List { nominal_area, .. } => Some(*nominal_area),
            Origin::Population { bodies: Some(_), .. } => None,
            Origin::Population { population, count, .. } => Some(*count as f64 / population.density),
            Origin::Pair(pair) if !pair.is_periodic() => None,
            Origin::Generated(_) | Origin::Map(_) | Origin::Pair(_) => {
                let border = if self.is_periodic() { 0 } else { 2 };
                let side = |points: usize, pixel: f64| (points - border) as f64 * pixel;
                let ([nx, ny], [dx, dy]) = (self.map_points()?, self.pixel()?);
                Some(side(nx, dx) * side(ny, dy))
            }
        }
    }

    /// Whether it has a height map that continues periodically.
    pub fn is_periodic(&self) -> bool {
        match &self.origin {
            Origin::Generated(_) => true,
            Origin::Map(map) => map.is_periodic,
            Origin::Pair(pair) => pair.is_periodic(),
            Origin::List { .. } | Origin::Population { .. } => false,
        }
    }

    /// Whether it is a measured height map.
    pub fn is_measured(&self) -> bool {
        matches!(self.origin, Origin::Map(_))
    }

    /// Warnings about radius, heights and area that are hardly meant; they are known before a run of a population only.
    pub fn implausible(&self) -> Vec<String> {
        let Origin::Population { population: Population { radius, sigma, density, .. }, count, .. } =
            &self.origin
        else {
            return Vec::new();
        };
        plausibility::of_asperities(&self.name, *radius, *sigma, *count as f64 / density)
    }

    /// What it is found in, as far as that are files.
    pub fn readings(&self) -> Vec<Reading> {
        match &self.origin {
            Origin::List { path, given, .. } => vec![Reading::list(path, *given)],
            Origin::Map(map) => vec![Reading::map(&map.file)],
            Origin::Population { .. } | Origin::Generated(_) => Vec::new(),
            Origin::Pair(pair) => pair.bodies.iter().flat_map(Self::readings).collect(),
        }
    }

    /// Whether one surface is made, or one pair of bodies, whose own parts give the sampling error.
    pub fn is_one(&self) -> bool {
        self.realisations == 1 || self.is_pair()
    }

    /// Whether its realisations are two bodies at several relative positions.
    pub fn is_pair(&self) -> bool {
        matches!(self.origin, Origin::Pair(_))
    }

    /// Whether it is the composite of two populations, whose asperities have no positions to be summed at.
    pub fn is_composite(&self) -> bool {
        matches!(self.origin, Origin::Population { bodies: Some(_), .. })
    }

    /// What it is, for a plan that a person reads.
    pub fn describe(&self) -> String {
        let what = match &self.origin {
            Origin::List { path, rows, .. } => format!("{rows} asperities listed in {}", path.display()),
            Origin::Population { bodies: Some(bodies), no_composite, .. } => {
                let what = if no_composite.is_some() { "pairs of asperities" } else { "composite" };
                format!("{what} of the populations {} and {}", bodies[0].name, bodies[1].name)
            }
            Origin::Population { count, .. } => format!("{count} asperities of a population"),
            Origin::Generated(generation) => generation.describe(),
            Origin::Map(map) => {
                let fit = if map.fit.is_some() { ", prepared as its checks ask for" } else { "" };
                format!("height map {}{}{fit}", map.file.path.display(), reading::part(&map.file.crop))
            }
            Origin::Pair(pair) => return format!("{}, {} of them", pair.describe(), self.realisations),
        };
        if self.realisations > 1 { format!("{what}, {} realisations", self.realisations) } else { what }
    }
}

/// `[surface.NAME]`, in file order.
pub(super) type Surfaces = IndexMap<Spanned<String>, Spanned<SurfaceSpec>>;

/// The surfaces that are named, or all of the file.
pub fn surfaces(
    file: &SpecFile,
    named: Option<&[Spanned<String>]>,
    span: Range<usize>,
    as_ellipses: bool,
) -> Result<Vec<SurfacePlan>, InputError> {
    let all: Surfaces = file.table("surface")?.map(Spanned::into_inner).unwrap_or_default();
    let plan = |name: &Spanned<String>, raw| SurfacePlan::new(file, name, raw, &all, as_ellipses);
    let Some(named) = named else {
        if all.is_empty() {
            return Err(file.source.error_at(
                span,
                "found no surface; allowed: at least one [surface.NAME.asperities], [surface.NAME.population], \
                 [surface.NAME.generate] or [surface.NAME.file]",
            ));
        }
        return all.iter().map(|(name, raw)| plan(name, raw)).collect();
    };
    if named.is_empty() {
        return Err(file.source.error_at(span, "found an empty list of surfaces; allowed: at least one"));
    }
    let mut surfaces = Vec::new();
    for (k, wanted) in named.iter().enumerate() {
        if named[..k].iter().any(|earlier| earlier.get_ref() == wanted.get_ref()) {
            let message = format!("found \"{}\" twice; allowed: each surface once", wanted.get_ref());
            return Err(file.source.error_at(wanted.span(), message));
        }
        let (name, raw) = named_surface(&file.source, &all, wanted, |_| true)?;
        surfaces.push(plan(name, raw)?);
    }
    Ok(surfaces)
}

/// The one of `all` surfaces that is `wanted`, among those that are allowed.
pub(super) fn named_surface<'a>(
    source: &Source,
    all: &'a Surfaces,
    wanted: &Spanned<String>,
    is_allowed: impl Fn(&SurfaceSpec) -> bool,
) -> Result<(&'a Spanned<String>, &'a Spanned<SurfaceSpec>), InputError> {
    let mut allowed = all.iter().filter(|(_, spec)| is_allowed(spec.get_ref()));
    allowed.clone().find(|(name, _)| name.get_ref() == wanted.get_ref()).ok_or_else(|| {
        let names: Vec<&str> = allowed.by_ref().map(|(name, _)| name.get_ref().as_str()).collect();
        let message = format!(
            "found \"{}\"; allowed: a surface of this file ({})",
            wanted.get_ref(),
            if names.is_empty() { "none is defined".to_owned() } else { names.join(", ") }
        );
        source.error_at(wanted.span(), message)
    })
}

/// The files that surfaces are read from, each once.
pub fn inputs(surfaces: &[SurfacePlan]) -> Vec<PathBuf> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for path in surfaces.iter().flat_map(SurfacePlan::inputs) {
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    paths
}

/// A line for each surface, for a plan that a person reads.
pub fn describe(surfaces: &[SurfacePlan], f: &mut fmt::Formatter) -> fmt::Result {
    surfaces.iter().try_for_each(|surface| writeln!(f, "  surface {}: {}", surface.name, surface.describe()))
}

/// The larger principal curvature over the smaller one, where a spec gives it; `span` is where it belongs.
pub fn curvature_ratio(
    source: &Source,
    span: &Range<usize>,
    raw: Option<&Spanned<Quantity<Pure>>>,
    is_needed: bool,
) -> Result<Option<f64>, InputError> {
    /// Beyond this an asperity is a ridge.
    const LONGEST: f64 = 1e6;
    let Some(raw) = raw else {
        let message = "found no `curvature-ratio`, which a law for ellipses needs; allowed: curvature-ratio = 1 or \
                       above, the larger principal curvature of an asperity over the smaller one";
        return if is_needed { Err(source.error_at(span.clone(), message)) } else { Ok(None) };
    };
    let ratio = raw.get_ref().value();
    if (1.0..=LONGEST).contains(&ratio) {
        return Ok(Some(ratio));
    }
    Err(source.error_at(raw.span(), format!("found {ratio}; allowed: 1 to {LONGEST:e}")))
}

/// A file named relative to the spec, there and not empty; or the name of what is in memory.
pub fn beside(source: &Source, raw: &Spanned<PathBuf>) -> Result<PathBuf, InputError> {
    if source.content_in_memory(raw.get_ref()).is_some() {
        return Ok(raw.get_ref().clone());
    }
    let folder = source.path.parent().unwrap_or_else(|| std::path::Path::new(""));
    let path = folder.join(raw.get_ref());
    if !source.may_read(&path) {
        let message = format!("found {}; allowed: a file in the folder of the workbench", path.display());
        return Err(source.error_at(raw.span(), message));
    }
    read::existing(&path)
        .map_err(|error| source.error_at(raw.span(), format!("{} {error}", path.display())))?;
    Ok(path)
}
