//! `reference = { ... }` and the reference resolved: its loads, the contacts that it solves, and what that takes.

use std::fmt;
use std::ops::Range;
use std::time::Duration;

use asperity::bem::{Boundary, Options, Solver};
use asperity::compare::Control;
use asperity::law::Property;
use asperity::spot::SpotProperties;
use asperity::study::LawContact;
use asperity::{Flat, Material, softer_hardness};
use asperity_contact_framework::input::quantity::{Pure, Quantity};
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, Whole, materials};
use asperity_contact_framework::report::format::{number, quantity};
use schemars::JsonSchema;
use serde::Deserialize;

use super::super::spec::Models;
use crate::layer::thickness_words;
use crate::study_plan::StudyPlan;
use crate::surface::SurfacePlan;

/// The boundary element reference of a comparison.
#[derive(Debug)]
pub struct ReferencePlan {
    /// Loads of a separation sweep at which it runs.
    pub loads: usize,
    /// The relative dual gap that is reached at each load.
    pub error: f64,
    /// What lies beyond the edge of a map; by the surface where the spec says nothing.
    boundary: Option<Boundary>,
    /// Points along an axis for each of the map's.
    pub refine: usize,
    /// The prescribed loads at which it runs, Pa or N.
    pub prescribed: Vec<(Control, f64)>,
    /// Number of separations in the spec.
    separations: usize,
    /// The different contacts.
    pub solutions: Vec<Solution>,
    /// The solution that serves each law and thickness, by its index.
    pub serves: Vec<usize>,
    /// Laws that yield while the reference is elastic.
    pub elastic: Vec<ElasticCase>,
    /// Position in the spec, for errors that only a run can find.
    pub key: Range<usize>,
}

/// One contact of the reference; laws of the same largest pressure share it.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// The largest pressure, Pa; `None` for an elastic contact.
    pub cap: Option<f64>,
}

/// A law that yields beside an elastic reference.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticCase {
    /// The law, as tables name it.
    pub law: String,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    pub reason: ElasticReason,
}

/// Why the reference is elastic beside a law that yields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElasticReason {
    /// There is no perfectly plastic limit under a layer of finite thickness.
    Layer,
    /// Neither body has a hardness.
    NoHardness,
    /// The spec asks for it.
    Asked,
}

impl ElasticReason {
    pub const fn name(self) -> &'static str {
        match self {
            Self::Layer => "layer",
            Self::NoHardness => "no-hardness",
            Self::Asked => "asked",
        }
    }
}

impl fmt::Display for ElasticCase {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { law, thickness, reason } = self;
        write!(f, "law {law}")?;
        if let Some(thickness) = thickness {
            write!(f, ", thickness {}", thickness_words(*thickness))?;
        }
        f.write_str(match reason {
            ElasticReason::Layer => ": the reference is elastic under a layer of finite thickness",
            ElasticReason::NoHardness => ": the reference is elastic, since neither body has a hardness",
            ElasticReason::Asked => ": the reference is elastic, as the spec asks (cap = \"none\")",
        })
    }
}

/// Wall time of a load at an error of 1e-6 on two cores, per point of the map, s (docs/theory.md, section 9): of a periodic map
/// 34 convolutions of 8 ns, of a mirrored one 46 of 11 ns and more where waves of two pixels are left in it, of a finite patch
/// 46 of 22 ns; and a third more for the stiffness.
const fn seconds_per_point(boundary: Boundary) -> f64 {
    match boundary {
        Boundary::Periodic => 3.7e-7,
        Boundary::Mirrored => 9e-7,
        Boundary::Finite => 1.3e-6,
    }
}

impl ReferencePlan {
    /// What lies beyond the edge of the map of a surface: that of a map that continues periodically, else mirrored, unless the
    /// spec says otherwise.
    pub fn boundary(&self, surface: &SurfacePlan) -> Boundary {
        let own = if surface.is_periodic() { Boundary::Periodic } else { Boundary::Mirrored };
        self.boundary.unwrap_or(own)
    }

    /// Loads at which it is solved on each realisation of a surface, at most: those of a separation sweep differ between laws.
    fn solves(&self) -> usize {
        self.prescribed.len() * self.solutions.len() + self.loads.min(self.separations) * self.serves.len()
    }

    /// Points of the map that it solves on.
    fn points(&self, surface: &SurfacePlan) -> [usize; 2] {
        surface.map_points().map_or([0; 2], |points| points.map(|count| count * self.refine))
    }

    /// An estimate of the bytes that it needs on a surface: a copy of the map, the refined map, and the solver's arrays.
    pub fn memory(&self, surface: &SurfacePlan) -> u128 {
        const BYTES_PER_HEIGHT: u128 = 8;
        let points = self.points(surface);
        let copy = surface.map_points().map_or(0, |[nx, ny]| nx as u128 * ny as u128 * BYTES_PER_HEIGHT);
        let finer = if self.refine > 1 { (points[0] * points[1]) as u128 * BYTES_PER_HEIGHT } else { 0 };
        let boundary = self.boundary(surface);
        let own = surface.map_points().filter(|_| self.refine > 1);
        let own = own.map_or(0, |points| Solver::memory(points, boundary));
        copy + finer + own + Solver::memory(points, boundary)
    }

    /// An estimate of the time that it takes on all realisations of a surface, on two cores.
    fn time(&self, surface: &SurfacePlan) -> Duration {
        let [nx, ny] = self.points(surface);
        // The map as it is, is solved beside the finer one.
        let both = if self.refine > 1 { 1.0 + (self.refine as f64).powi(-2) } else { 1.0 };
        let points = both * nx as f64 * ny as f64;
        // Steps grow as the logarithm of the error.
        let steps = self.error.ln() / ERROR.ln();
        let loads = (self.solves() * surface.realisations) as f64;
        Duration::from_secs_f64(points * loads * steps * seconds_per_point(self.boundary(surface)))
    }

    /// A warning where the grid resolves the shortest waves of surfaces, each with its points per wave, too coarsely for an area of contact.
    pub fn warning(&self, surfaces: impl Iterator<Item = (String, f64)>) -> Option<String> {
        /// Points per shortest wave that are enough for the corrected area.
        const ENOUGH: f64 = 4.0;
        // A nesting index over a pixel is rounded.
        const ROUNDING: f64 = 1e-9;
        let refined = surfaces.map(|(name, points)| (name, points * self.refine as f64));
        let coarse: Vec<(String, f64)> =
            refined.filter(|(_, points)| *points < ENOUGH * (1.0 - ROUNDING)).collect();
        let (first, least) = match &coarse[..] {
            [] => return None,
            [(name, points)] => (format!("surface {name}"), *points),
            several => {
                let least = several.iter().map(|(_, points)| *points).fold(f64::INFINITY, f64::min);
                (format!("{} surfaces", several.len()), least)
            }
        };
        Some(format!(
            "reference on {first}: {} points per shortest wave, fewer than {ENOUGH}: areas depend on the grid; \
             `reference = {{ refine = 2 }}` adds this to the error bar.",
            number(least),
        ))
    }

    /// A warning where the reference gives the conductance of finite maps, which the models do not.
    pub fn cluster_warning(&self, study: &StudyPlan) -> Option<String> {
        let conducts = |law: &LawContact| law.contact.spot_properties().is_some_and(SpotProperties::conducts);
        let mut surfaces = study.surfaces.iter();
        let finite = surfaces.find(|surface| self.boundary(surface) == Boundary::Finite)?;
        study.laws.iter().any(conducts).then(|| {
            format!(
                "reference on surface {}: a finite map conducts as one cluster of spots, not comparable with the models \
                 (`reference.csv`; not known under a layer)",
                finite.name
            )
        })
    }

    /// A line for each surface, for a plan that a person reads.
    pub fn describe(&self, surfaces: &[SurfacePlan], f: &mut fmt::Formatter) -> fmt::Result {
        for surface in surfaces {
            let [nx, ny] = self.points(surface);
            writeln!(
                f,
                "  reference on {}: boundary elements, {nx} x {ny} points, {}, dual gap {:e}, {} loads; about {} s on 2 cores, {:.0} MB",
                surface.name,
                self.boundary(surface).name(),
                self.error,
                self.solves() * surface.realisations,
                number(self.time(surface).as_secs_f64()),
                self.memory(surface) as f64 / 1e6,
            )?;
        }
        self.elastic.iter().try_for_each(|case| writeln!(f, "  {case}"))
    }
}

/// Loads of a sweep at which the reference runs where the spec does not say.
const LOADS: u64 = 9;
/// Relative dual gap where the spec does not say.
const ERROR: f64 = 1e-6;
/// The most loads of a sweep.
const MOST_LOADS: u64 = 1000;

/// The keys of a kind that say which models run, and at which loads.
pub struct ReferenceKeys<'a> {
    pub models: Option<&'a Spanned<Models>>,
    /// How the boundary elements run.
    pub reference: Option<&'a Spanned<ReferenceSpec>>,
    /// Number of the separations of a sweep, where there is one.
    pub separations: Option<usize>,
    /// Pressures and forces, and whether they are listed one by one.
    pub loads: Vec<(Control, &'a [f64], bool)>,
    /// Names of the rough body and the flat.
    pub bodies: [&'a str; 2],
}

/// What the reference is resolved with.
pub struct Resolved<'a> {
    /// The body without a layer.
    pub bare: &'a Material,
    /// The other one: without a layer, or under each thickness.
    pub flats: &'a [(Option<f64>, Flat)],
    /// Each law on each of them, the laws changing last.
    pub laws: &'a [LawContact],
    pub surfaces: &'a [SurfacePlan],
}

/// Resolves the reference; `None` where none is asked for.
pub fn reference(
    file: &SpecFile,
    keys: &ReferenceKeys,
    resolved: &Resolved,
) -> Result<Option<ReferencePlan>, InputError> {
    let Some(models) = keys.models.filter(|models| models.get_ref().has_reference) else {
        let Some(reference) = keys.reference else { return Ok(None) };
        let message = "found keys of the reference, which does not run; allowed: \"reference\" among the models (models = \
                       [\"statistical\", \"deterministic\", \"reference\"]), or no `reference`";
        return Err(file.source.error_at(reference.span(), message));
    };
    let refuse = |span: Range<usize>, message: String| Err(file.source.error_at(span, message));
    let default = ReferenceSpec::default();
    let spec = keys.reference.map_or(&default, Spanned::get_ref);
    if let Some(surface) = resolved.surfaces.iter().find(|surface| surface.map_points().is_none()) {
        let message = format!(
            "found the reference on surface {} ({}), which has no height map; allowed: surfaces made by [surface.NAME.generate] or \
             read by [surface.NAME.file], chosen by `surfaces = [...]`, or no \"reference\"",
            surface.name,
            surface.describe()
        );
        return refuse(models.span(), message);
    }
    if models.get_ref().kinds.is_empty() && keys.separations.is_some() {
        let span = file.source.value_at(&["compare", "separation"]).map_or(models.span(), |(span, _)| span);
        let message = "found separations, and only the reference, which runs at loads; allowed: `pressure` or `force`, or a \
                       model beside it, at whose loads it then runs";
        return refuse(span, message.to_owned());
    }
    let loads = whole(file, spec.loads.as_ref(), LOADS, 1..=MOST_LOADS)?;
    let refine = whole(file, spec.refine.as_ref(), 1, 1..=2)?;
    let error = match &spec.error {
        None => ERROR,
        Some(given) => {
            let (value, least, most) =
                (given.get_ref().value(), Options::ERRORS.start(), Options::ERRORS.end());
            if !Options::ERRORS.contains(&value) {
                return refuse(given.span(), format!("found {value:?}; allowed: {least:?} to {most:?}"));
            }
            value
        }
    };
    let cap = spec.cap.as_ref();
    if let Some(given) = cap.filter(|cap| *cap.get_ref() == CapSpec::Hardness) {
        refuse_cap(file, keys.bodies, resolved, given.span())?;
    }
    let mut plan = ReferencePlan {
        loads,
        error,
        boundary: spec.boundary,
        refine,
        prescribed: Vec::new(),
        separations: keys.separations.unwrap_or(0),
        solutions: Vec::new(),
        serves: Vec::new(),
        elastic: Vec::new(),
        key: keys.reference.map_or_else(|| models.span(), Spanned::span),
    };
    for &(control, values, is_listed) in &keys.loads {
        let chosen = if is_listed { values.to_vec() } else { spread_over(values, loads) };
        plan.prescribed.extend(chosen.into_iter().map(|value| (control, value)));
    }
    for (law, (thickness, flat)) in resolved.laws.iter().zip(resolved.flats.iter().cycle()) {
        let solution = plan.solution(law, resolved.bare, *thickness, flat, cap.map(|cap| *cap.get_ref()));
        let index = plan.solutions.iter().position(|known| *known == solution).unwrap_or_else(|| {
            plan.solutions.push(solution);
            plan.solutions.len() - 1
        });
        plan.serves.push(index);
    }
    let is_alone = models.get_ref().kinds.is_empty();
    let highest =
        plan.solutions.iter().map(|solution| solution.cap.unwrap_or(f64::INFINITY)).fold(0.0, f64::max);
    let pressures = || plan.prescribed.iter().filter(|(control, _)| *control == Control::Pressure);
    if is_alone
        && plan.prescribed.len() == pressures().count()
        && pressures().all(|(_, load)| *load >= highest)
    {
        let span = file.source.value_at(&["compare", "pressure"]).map_or(models.span(), |(span, _)| span);
        let message = format!(
            "found no load below {}, the largest contact pressure of the reference; allowed: a nominal pressure below it, or cap = \"none\"",
            quantity(highest, "Pa")
        );
        return refuse(span, message);
    }
    Ok(Some(plan))
}

impl ReferencePlan {
    /// The contact beside `law`; notes where it is elastic although the law yields.
    fn solution(
        &mut self,
        law: &LawContact,
        bare: &Material,
        thickness: Option<f64>,
        flat: &Flat,
        asked: Option<CapSpec>,
    ) -> Solution {
        let yields = law.spec.law().yields_by().is_some();
        let hardness = homogeneous(flat).map(|flat| softer_hardness(bare, flat));
        let (cap, reason) = match (asked, hardness) {
            (Some(CapSpec::None), _) => (None, Some(ElasticReason::Asked)),
            (_, None) => (None, Some(ElasticReason::Layer)),
            (asked, Some(hardness)) if asked.is_some() || yields => {
                let cap = Some(hardness).filter(|hardness| hardness.is_finite());
                (cap, cap.is_none().then_some(ElasticReason::NoHardness))
            }
            (_, Some(_)) => (None, None),
        };
        if let Some(reason) = reason.filter(|_| yields) {
            self.elastic.push(ElasticCase { law: law.label.clone(), thickness, reason });
        }
        Solution { thickness, cap }
    }
}

/// The material of a body without a layer of finite thickness.
fn homogeneous(flat: &Flat) -> Option<&Material> {
    match flat {
        Flat::Bare(material) | Flat::AllLayer { layer: material, .. } => Some(material),
        Flat::Layered { .. } => None,
    }
}

/// Refuses a cap that is asked for under a layer, or where no body has a hardness.
fn refuse_cap(
    file: &SpecFile,
    bodies: [&str; 2],
    resolved: &Resolved,
    span: Range<usize>,
) -> Result<(), InputError> {
    for (thickness, flat) in resolved.flats {
        let Some(flat) = homogeneous(flat) else {
            let message = format!(
                "found \"hardness\" under a layer of {}, where the reference is elastic; allowed: cap = \"none\", or thicknesses of 0 \
                 and \"inf\"",
                thickness.map_or_else(String::new, thickness_words)
            );
            return Err(file.source.error_at(span, message));
        };
        if softer_hardness(resolved.bare, flat).is_infinite() {
            let message = format!(
                "found \"hardness\", but no `{}` in {}; allowed: cap = \"none\", or hardness = \"...\" with a unit of pressure in a material",
                Property::Hardness.name(),
                materials(bodies[0], bodies[1])
            );
            return Err(file.source.error_at(span, message));
        }
    }
    Ok(())
}

/// A whole number within a range, or its default.
fn whole(
    file: &SpecFile,
    raw: Option<&Spanned<Whole>>,
    otherwise: u64,
    allowed: std::ops::RangeInclusive<u64>,
) -> Result<usize, InputError> {
    let Some(raw) = raw else { return Ok(otherwise as usize) };
    let Whole(value) = *raw.get_ref();
    if allowed.contains(&value) {
        return Ok(value as usize);
    }
    let message = format!("found {value}; allowed: {} to {}", allowed.start(), allowed.end());
    Err(file.source.error_at(raw.span(), message))
}

/// At most `count` of the values, evenly spread over their indices, with both ends; of one the middle.
pub fn spread_over<T: Clone>(values: &[T], count: usize) -> Vec<T> {
    let last = values.len().saturating_sub(1);
    match count {
        _ if values.len() <= count => values.to_vec(),
        1 => vec![values[last / 2].clone()],
        _ => (0..count).map(|k| values[(k * last + (count - 1) / 2) / (count - 1)].clone()).collect(),
    }
}

/// How the boundary element reference is run; each key may be left out.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    expecting = "a table such as { loads = 9, error = 1e-6, cap = \"none\", boundary = \"mirrored\" }"
)]
pub struct ReferenceSpec {
    /// Number of the loads of a sweep at which it runs; all of a list.
    #[schemars(extend("x-range" = "1 to 1000", "default" = 9, "examples" = [5]))]
    pub loads: Option<Spanned<Whole>>,
    /// Relative dual gap at which an iteration ends.
    #[schemars(extend("x-range" = "1e-12 to 0.01", "default" = 1e-6, "examples" = [1e-4]))]
    pub error: Option<Spanned<Quantity<Pure>>>,
    /// The largest contact pressure.
    #[schemars(extend("x-default" = "the hardness where the law yields and no layer of finite thickness is there, else none", "examples" = ["none"]))]
    pub cap: Option<Spanned<CapSpec>>,
    /// What lies beyond the border of the map.
    #[schemars(extend("x-default" = "periodic on generated and periodic maps, else mirrored", "examples" = ["mirrored"]))]
    pub boundary: Option<Boundary>,
    /// Points along an axis for each of the map; with 2 the map itself is solved too, and the difference is part of the error bar.
    #[schemars(extend("x-range" = "1 to 2", "default" = 1, "examples" = [2]))]
    pub refine: Option<Spanned<Whole>>,
}

/// The largest pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CapSpec {
    /// The hardness of the softer body: perfectly plastic contacts.
    Hardness,
    /// Elastic contacts.
    None,
}
