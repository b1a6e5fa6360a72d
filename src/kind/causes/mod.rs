//! `[causes]`: why the models differ, and which is nearer to the reference, over a grid of generated surfaces.

mod outline;
mod process;
mod results;
mod rows;

use std::fmt;

use asperity::compare::{Control, Controls};
use asperity::distribution::Johnson;
use asperity::topography::summits::Neighbours;
use asperity::{Heights, reduced_modulus};
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::{NominalPressureRange, SigmaRange};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Finite, Length, Pressure, Pure, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile, Whole};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Group, Kind, Memory, Outcome, Plan, Reads, RunContext};
use process::{GridProcess, ascending};
use schemars::JsonSchema;
use serde::Deserialize;

use super::compare::reference::ReferenceSpec;
use super::compare::reference::plan::{ReferenceKeys, Resolved, reference};
use super::compare::spec::{ComparePlan, Models};
use crate::study_plan::{RoughBody, SpotKeys, StudyKeys, StudyPlan};
use crate::surface::{Generation, SurfacePlan, TargetSpec};

pub struct Causes;

impl Kind for Causes {
    const NAME: &'static str = "causes";
    const GROUP: Option<Group> = Some(Group::Why);
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = CausesSpec;
    type Plan = CausesPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<CausesPlan, InputError> {
        let raw = table.get_ref();
        file.spheres_only(&raw.law, "the asperities of [causes] are taken as spheres")?;
        let process = GridProcess::new(file, table)?;
        let realisations = file.whole_within(&raw.realisations, REALISATIONS, "realisations")? as usize;
        let pair = [
            file.body(&raw.rough.get_ref().0, raw.rough.span())?,
            file.body(raw.flat.get_ref(), raw.flat.span())?,
        ];
        let unit = process.gradient().map(|gradient| reduced_modulus(&pair[0], &pair[1]) * gradient);
        let pressures = pressures(file, table, unit)?;
        let mut points = process.points(file, raw)?;
        let mut surfaces = Vec::new();
        for point in &mut points {
            let key = process.key();
            match point.heights().and_then(|heights| process.way(heights, point.wavelengths)) {
                Ok(way) => {
                    let generation = Generation { way, neighbours: Neighbours::Four, key: key.clone() };
                    surfaces.push(SurfacePlan::generated(point.name(), key, realisations, false, generation));
                }
                Err(reason) => point.without_surface = Some(reason),
            }
        }
        if surfaces.is_empty() {
            let reason = points.iter().find_map(|point| point.without_surface.as_deref()).unwrap_or_default();
            let message = format!(
                "found no point of the grid that has a surface ({reason}); allowed: moments of which at least one has"
            );
            return Err(file.source.error_at(raw.skewness.span(), message));
        }
        let keys = StudyKeys {
            table: table.span(),
            rough: &raw.rough,
            flat: &raw.flat,
            law: &raw.law,
            layer: None,
            spots: SpotKeys::default(),
            statistical: None,
            accept: raw.accept,
            surfaces: None,
            controls: Controls::at_pressures(pressures.clone()),
            nominal_area: None,
            load_keys: [raw.pressure.as_ref().map(Spanned::span), None],
        };
        let study = StudyPlan::on(file, keys, |_| Ok(surfaces))?;
        let reference_keys = ReferenceKeys {
            models: raw.models.as_ref(),
            reference: raw.reference.as_ref(),
            separations: None,
            loads: vec![(Control::Pressure, &pressures, true)],
            bodies: [&raw.rough.get_ref().0, raw.flat.get_ref()],
        };
        let [bare, _] = study.bare_and_coated();
        let resolved = Resolved { bare, flats: &study.flats, laws: &study.laws, surfaces: &study.surfaces };
        let reference = reference(file, &reference_keys, &resolved)?.map(Box::new);
        Ok(CausesPlan {
            axis: process.axis(),
            common: process.to_string(),
            compare: ComparePlan { reference, is_attributed: true, ..ComparePlan::of_models(study) },
            points,
            unit,
        })
    }

    fn tables() -> Vec<Schema> {
        vec![Schema::of::<rows::LeadRow>(), Schema::of::<rows::CauseRow>()]
    }
}

impl Plan for CausesPlan {
    fn memory(&self) -> Memory {
        Plan::memory(&self.compare)
    }

    fn work(&self) -> u128 {
        self.compare.study.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(results::run(context, self)?))
    }
}

/// At least two give a scatter.
const REALISATIONS: [u64; 2] = [2, 1000];

/// Both models, and the reference, on surfaces of a grid.
pub struct CausesPlan {
    /// The surfaces that can be made, under all laws and loads.
    pub compare: ComparePlan,
    /// Every point of the grid, row by row of the second axis.
    pub points: Vec<PointPlan>,
    /// What the rows of the grid differ in.
    pub axis: Axis,
    /// What loads are multiples of: E* times the gradient, Pa; `None` of given pressures.
    pub unit: Option<f64>,
    /// What all surfaces have in common, in words.
    pub common: String,
}

/// What the rows of a grid differ in, beside the skewness.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Longest over shortest wavelength; the kurtosis is that of a gamma distribution of the skewness.
    Bandwidth,
    /// Kurtosis of the surface heights.
    Kurtosis,
}

pub struct PointPlan {
    /// Skewness of the surface heights.
    pub skewness: f64,
    pub kurtosis: f64,
    /// Longest over shortest wavelength; `None` where it follows from the summits.
    pub wavelengths: Option<f64>,
    /// Why it has no surfaces; those of the others are the surfaces of the plan, in the same order.
    pub without_surface: Option<String>,
}

impl fmt::Display for CausesPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let study = &self.compare.study;
        let laws: Vec<String> = study.laws.iter().map(|law| law.label.clone()).collect();
        writeln!(f, "  {} on {}, law {}", study.bodies.rough, study.bodies.flat, laws.join(", "))?;
        let surfaces: usize = study.surfaces.iter().map(|surface| surface.realisations).sum();
        writeln!(
            f,
            "  {surfaces} surfaces of {} points of the grid, {} loads",
            study.surfaces.len(),
            study.controls.pressures.len()
        )?;
        match &self.compare.reference {
            Some(reference) => reference.describe(&study.surfaces[..1], f),
            None => Ok(()),
        }
    }
}

/// The loads, Pa.
fn pressures(
    file: &SpecFile,
    table: &Spanned<CausesSpec>,
    unit: Option<f64>,
) -> Result<Vec<f64>, InputError> {
    let raw = table.get_ref();
    match (&raw.loads, &raw.pressure, unit) {
        (Some(loads), None, Some(unit)) => {
            let loads = ascending(file, loads, Quantity::value, 1)?;
            Ok(loads.into_iter().map(|load| load * unit).collect())
        }
        (None, Some(pressure), None) => Ok(pressure.get_ref().values.clone()),
        (_, _, Some(_)) => Err(file.source.error_at(
            table.span(),
            "found no loads, or a pressure; allowed with sigma and gradient: loads = [...], multiples of E* times the gradient",
        )),
        (_, _, None) => Err(file.source.error_at(
            table.span(),
            "found no pressure, or loads; allowed with summits: pressure = [\"0.8 MPa\", \"2 MPa\"]",
        )),
    }
}

impl PointPlan {
    /// The name of its surfaces, which sets their random numbers.
    fn name(&self) -> String {
        let row =
            self.wavelengths.map_or(format!("kurtosis {}", self.kurtosis), |w| format!("wavelengths {w}"));
        format!("skewness {} {row}", self.skewness)
    }

    fn heights(&self) -> Result<Heights, String> {
        if self.skewness == 0.0 && self.kurtosis == 3.0 {
            return Ok(Heights::GAUSSIAN);
        }
        Johnson::from_moments(self.skewness, self.kurtosis)
            .map(Heights::new)
            .map_err(|error| error.to_string())
    }
}

/// Why the models differ, and with a reference which is nearer, over a grid of generated surfaces: of skewness and bandwidth, or with
/// `summits` of skewness and kurtosis.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CausesSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, for spheres.
    #[schemars(extend("examples" = ["zmc"]))]
    pub law: Spanned<Laws>,
    /// What runs: the integral and the sum, and the boundary elements of the reference.
    #[schemars(extend("default" = ["statistical", "deterministic"], "examples" = [["statistical", "deterministic", "reference"]]))]
    pub models: Option<Spanned<Models>>,
    /// How the boundary elements run; only with `"reference"` among the models.
    #[schemars(extend("x-default" = "those of [compare]", "examples" = [{ "error": 1e-6 }]))]
    pub reference: Option<Spanned<ReferenceSpec>>,
    /// The largest differences between the models that do not matter to you.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1 }]))]
    pub accept: AcceptSpec,
    /// Skewnesses of the surface heights, ascending.
    #[schemars(extend("x-range" = "2 to 32 numbers", "examples" = [[-1.5, 0, 1.5]]))]
    pub skewness: Spanned<Vec<Quantity<Pure, Finite>>>,
    /// Longest over shortest wavelength of the power law, ascending: they set the bandwidth. Not with `summits`.
    #[schemars(extend("x-default" = "none: `kurtosis` is the other axis", "x-range" = "2 to 32 numbers above 1", "examples" = [[2, 8, 32]]))]
    pub wavelengths: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// Kurtoses of the surface heights, ascending; only with `summits`.
    #[schemars(extend("x-default" = "that of a gamma distribution of the skewness", "x-range" = "2 to 32 numbers", "examples" = [[3, 4.5, 6]]))]
    pub kurtosis: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// Nominal pressures over E* times the root mean square gradient, ascending; not with `summits`.
    #[schemars(extend("x-default" = "none: by `pressure`", "x-range" = "1 to 32 numbers", "examples" = [[0.001, 0.01]]))]
    pub loads: Option<Spanned<Vec<Quantity<Pure>>>>,
    /// Nominal pressures, with `summits`.
    #[schemars(extend("x-default" = "none: by `loads`", "examples" = [["0.8 MPa", "2 MPa"]]))]
    pub pressure: Option<Spanned<LogSweep<Pressure, NominalPressureRange>>>,
    /// Surfaces of each point of the grid.
    #[schemars(extend("x-range" = "2 to 1000", "examples" = [8]))]
    pub realisations: Spanned<Whole>,
    /// Points along each side of a surface.
    #[schemars(extend("x-range" = "64 to 4096", "examples" = [1024]))]
    pub points: Spanned<Whole>,
    /// The shortest wavelength in pixels.
    #[schemars(extend("x-range" = "at least 2", "examples" = [8]))]
    pub cut_off_pixels: Spanned<Quantity<Pure>>,
    /// Hurst exponent.
    #[schemars(extend("x-range" = "0 to 1", "examples" = [0.8]))]
    pub hurst: Spanned<Quantity<Pure, Finite>>,
    /// Standard deviation of the surface heights; not with `summits`.
    #[schemars(extend("x-default" = "none: by `summits`", "examples" = ["0.25 um"]))]
    pub sigma: Option<Spanned<Quantity<Length, SigmaRange>>>,
    /// Root mean square gradient of the surface; not with `summits`.
    #[schemars(extend("x-default" = "none: by `summits`", "examples" = [0.1]))]
    pub gradient: Option<Spanned<Quantity<Pure>>>,
    /// What the summits found on every surface shall have; the bandwidth follows.
    #[schemars(extend("x-default" = "none: by `sigma`, `gradient` and `wavelengths`", "examples" = [{ "radius": "20 um", "sigma": "48 nm", "density": "6e10 /m^2" }]))]
    pub summits: Option<Spanned<TargetSpec>>,
}
