//! `[sampling-interval]`: the same surfaces at growing sampling intervals and under growing S filters: which results have a limit?

mod outline;
mod results;
mod rows;
mod run;

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use asperity::compare::Controls;
use asperity::surface::AnalysisDepth;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::NominalPressureRange;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Length, Pressure, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, Whole};
use asperity_contact_framework::report::format::listed;
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, RunContext};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::study_plan::{RoughBody, SpotKeys, StatisticalSpec, StudyKeys, StudyPlan};
use crate::surface::{SurfacePlan, inputs, memory};

pub struct SamplingInterval;

impl Kind for SamplingInterval {
    const NAME: &'static str = "sampling-interval";
    type Spec = SamplingIntervalSpec;
    type Plan = IntervalPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<IntervalPlan, InputError> {
        let (raw, span) = (table.get_ref(), table.span());
        let laws = &raw.law.get_ref().0;
        if laws.len() > 1 {
            let message = format!("found {} laws; allowed: one", laws.len());
            return Err(file.source.error_at(raw.law.span(), message));
        }
        let mut pressures = raw.pressure.get_ref().values.clone();
        pressures.sort_by(f64::total_cmp);
        pressures.dedup();
        let study = StudyPlan::new(
            file,
            StudyKeys {
                table: span.clone(),
                rough: &raw.rough,
                flat: &raw.flat,
                law: &raw.law,
                layer: None,
                spots: SpotKeys::default(),
                statistical: raw.statistical.as_ref(),
                accept: raw.accept,
                surfaces: raw.surfaces.as_deref(),
                controls: Controls::at_pressures(pressures),
                nominal_area: None,
                load_keys: [Some(raw.pressure.span()), None],
            },
        )?;
        const INTERVALS: &str = "whole numbers of pixels, ascending, from 1, such as [1, 2, 4, 8]";
        let intervals =
            ascending(file, raw.intervals.as_ref(), |&Whole(value)| value as f64, 1.0, INTERVALS)?;
        let intervals: Vec<usize> = intervals.into_iter().map(|interval| interval as usize).collect();
        let multiples = multiples(file, raw)?;
        let index = raw.nesting_index.as_ref();
        let filter_keys = [index.map(Spanned::span), raw.s_filter.as_ref().map(Spanned::span)];
        let intervals_key = raw.intervals.as_ref().map(Spanned::span);
        for surface in &study.surfaces {
            check_map(surface, &intervals, intervals_key.as_ref())
                .map_err(|(key, message)| file.source.error_at(key, message))?;
        }
        Ok(IntervalPlan {
            study,
            intervals,
            multiples,
            nesting_index: index.map(|index| index.get_ref().value()),
            filter_key: filter_keys.into_iter().flatten().next().unwrap_or(span),
        })
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for IntervalPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.study.surfaces)
    }

    fn memory(&self) -> Memory {
        /// The prepared map and a filtered one.
        const BYTES_PER_POINT: u128 = 16;
        let of_models = memory(&self.study.surfaces, AnalysisDepth::Comparison, true);
        let points = |surface: &SurfacePlan| surface.map_points().map(|[nx, ny]| nx as u128 * ny as u128);
        let maps = self.study.surfaces.iter().filter_map(points).max().unwrap_or(0) * BYTES_PER_POINT;
        Memory { bytes: of_models.bytes + maps, ..of_models }
    }

    fn work(&self) -> u128 {
        self.study.work() * self.scales() as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}

/// The intervals and multiples of a spec that gives none.
const DEFAULT: [f64; 4] = [1.0, 2.0, 4.0, 8.0];

/// The smallest nesting index in pixels of a spec that gives none: it leaves 0.5^(5/2)^2 = 1.3 % of the amplitude of waves of two
/// pixels, so that the filter and not the pixel ends the spectrum.
const PIXELS: f64 = 5.0;

/// The criterion for a limit compares two changes.
const FEWEST: usize = 3;

/// More are a sweep that no table shows.
const MOST: usize = 32;

/// The same surfaces at several sampling intervals and under several S filters.
pub struct IntervalPlan {
    /// Both models on the surfaces as they are, under one law, at ascending pressures.
    pub study: StudyPlan,
    /// Sampling intervals in pixels, ascending.
    pub intervals: Vec<usize>,
    /// Nesting indices of S filters, ascending, in units of [`Self::nesting_index`]; empty where no filters are asked for.
    pub multiples: Vec<f64>,
    /// m; `None` for [`PIXELS`] pixels of each map.
    nesting_index: Option<f64>,
    /// Position in the spec of what set the indices, for errors about maps that do not hold them.
    pub filter_key: Range<usize>,
}

impl IntervalPlan {
    /// The unit of the nesting indices on a map of `pixel` (m), m.
    pub fn nesting_index(&self, pixel: [f64; 2]) -> f64 {
        self.nesting_index.unwrap_or(PIXELS * pixel[0].max(pixel[1]))
    }

    /// Number of variants of each surface.
    pub fn scales(&self) -> usize {
        self.intervals.len() + self.multiples.len()
    }
}

impl fmt::Display for IntervalPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.study)?;
        writeln!(f, "  each surface at sampling intervals of {} pixels", listed(&texts(&self.intervals)))?;
        if self.multiples.is_empty() {
            return Ok(());
        }
        let index =
            self.nesting_index.map_or_else(|| format!("{PIXELS} pixels"), |index| format!("{index:e} m"));
        writeln!(f, "  and under S filters of {} times {index}", listed(&texts(&self.multiples)))
    }
}

fn texts(values: &[impl fmt::Display]) -> Vec<String> {
    values.iter().map(ToString::to_string).collect()
}

/// The values of a list, ascending from `least`, or the default.
fn ascending<T>(
    file: &SpecFile,
    list: Option<&Spanned<Vec<T>>>,
    value: impl Fn(&T) -> f64,
    least: f64,
    allowed: &str,
) -> Result<Vec<f64>, InputError> {
    let Some(list) = list else { return Ok(DEFAULT.to_vec()) };
    let values: Vec<f64> = list.get_ref().iter().map(value).collect();
    let is_ascending = values.windows(2).all(|pair| pair[0] < pair[1]) && values.first() >= Some(&least);
    if (FEWEST..=MOST).contains(&values.len()) && is_ascending {
        return Ok(values);
    }
    let message = format!("found [{}]; allowed: {FEWEST} to {MOST} {allowed}", texts(&values).join(", "));
    Err(file.source.error_at(list.span(), message))
}

/// Refuses a surface without a map, of several realisations, or with too few points at an interval; with the position of the key.
fn check_map(
    surface: &SurfacePlan,
    intervals: &[usize],
    intervals_key: Option<&Range<usize>>,
) -> Result<(), (Range<usize>, String)> {
    /// Points that a five-point summit needs, three times over.
    const LEAST: usize = 9;
    let (name, key) = (&surface.name, &surface.size_key);
    let Some(points) = surface.map_points() else {
        let message = format!(
            "found surface {name} ({}), which has no height map to sample; allowed: surfaces made by [surface.NAME.generate] or read by \
             [surface.NAME.file], chosen by `surfaces = [...]`",
            surface.describe()
        );
        return Err((key.clone(), message));
    };
    if surface.realisations > 1 {
        let message = format!(
            "found {} realisations of surface {name}; allowed: one, whose blocks give the uncertainty: more points make it smaller",
            surface.realisations
        );
        return Err((key.clone(), message));
    }
    let shorter = points[0].min(points[1]);
    let Some(interval) = intervals.iter().find(|&&interval| shorter.div_ceil(interval) < LEAST) else {
        return Ok(());
    };
    let message = format!(
        "found an interval of {interval} pixels, which leaves {} points along an axis of surface {name}; allowed: at most {} pixels there",
        shorter.div_ceil(*interval),
        shorter / LEAST
    );
    Err((intervals_key.unwrap_or(key).clone(), message))
}

/// Nesting indices in units of `nesting-index`; none of an empty list.
fn multiples(file: &SpecFile, raw: &SamplingIntervalSpec) -> Result<Vec<f64>, InputError> {
    const ALLOWED: &str =
        "multiples of the nesting index, ascending, such as [1, 2, 4, 8], or [] for no filters";
    let list = raw.s_filter.as_ref();
    if list.is_none_or(|list| !list.get_ref().is_empty()) {
        return ascending(file, list, Quantity::<Pure>::value, 0.0, ALLOWED);
    }
    raw.nesting_index.as_ref().map_or(Ok(Vec::new()), |index| {
        let message =
            "found a nesting index, and no filters (s-filter = []); allowed: both, or neither of them";
        Err(file.source.error_at(index.span(), message))
    })
}

/// The same surfaces at growing sampling intervals and under growing S filters: which results have a limit?
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SamplingIntervalSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact law: one.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// Nominal pressures at which both models run.
    #[schemars(extend("examples" = [{ "from": "0.1 MPa", "to": "100 MPa", "points": 31 }]))]
    pub pressure: Spanned<LogSweep<Pressure, NominalPressureRange>>,
    /// Sampling intervals in pixels, ascending.
    #[schemars(extend("x-range" = "3 to 32 numbers, from 1", "default" = [1, 2, 4, 8], "examples" = [[1, 2, 3, 4]]))]
    pub intervals: Option<Spanned<Vec<Whole>>>,
    /// Nesting indices of S filters in multiples of `nesting-index`, ascending; none of an empty list.
    #[schemars(extend("x-range" = "3 to 32 numbers", "default" = [1, 2, 4, 8], "examples" = [[1, 1.5, 2]]))]
    pub s_filter: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// The nesting index that `s-filter` multiplies.
    #[schemars(extend("x-default" = "five pixels", "examples" = ["2.5 um"]))]
    pub nesting_index: Option<Spanned<Quantity<Length>>>,
    /// Which statistical model runs.
    #[schemars(extend("x-default" = "Gaussian heights, arithmetic mean radius", "examples" = [{ "heights": "own" }]))]
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest changes of the difference between the models that do not matter to you.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1, "stiffness": "20 %" }]))]
    pub accept: AcceptSpec,
    /// The surfaces to run on, by name.
    #[schemars(extend("x-default" = "all of the file", "examples" = [["ground"]]))]
    pub surfaces: Option<Vec<Spanned<String>>>,
}
