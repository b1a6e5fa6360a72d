//! `[compare]`: both models on the same surfaces, and the reference beside them.

use std::fmt;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use asperity::analytical::AnalyticalLine;
use asperity::compare::{CaseSampling, Control, Controls, ModelKind};
use asperity::study::Setup;
use asperity::surface::AnalysisDepth;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::{NominalAreaRange, NominalPressureRange};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Area, Force, Pressure, Quantity};
use asperity_contact_framework::input::sweep::{LinearSweep, LogSweep};
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::{RunContext, written_schema};
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::json;

use super::correlations::lines;
use super::reference::plan::{ReferenceKeys, Resolved, reference};
use super::reference::{ReferencePlan, ReferenceSpec};
use crate::layer::LayerSpec;
use crate::presentation::SurfaceFigures;
use crate::study_plan::{
    ConductanceSpec, RoughBody, ShearStrengthSpec, SpotKeys, StatisticalSpec, StudyKeys, StudyPlan,
};
use crate::surface::{SurfacePlan, SurfaceStore};

/// Both models on the same surfaces, and the reference beside them: may the integral replace the sum?
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CompareSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws; all run on the same surfaces.
    pub law: Spanned<Laws>,
    /// A layer on the flat or on the rough body, of one thickness or several.
    #[schemars(extend("x-default" = "none: both bodies are bare", "examples" = [{ "material": "lead", "thickness": [0, "50 nm", "1 um", "inf"] }]))]
    pub layer: Option<LayerSpec>,
    /// Conductances of the contact that are compared, too: of spots that conduct by themselves, in the models; of the whole contact, in the
    /// reference.
    #[schemars(extend("x-default" = "none", "examples" = ["thermal", { "electrical": { "film": "1e-12 ohm m^2" } }]))]
    pub conductance: Option<Spanned<ConductanceSpec>>,
    /// Shear strength of the real contact area, tau0 + alpha p; the coefficient of boundary friction is compared, too.
    #[schemars(extend("x-default" = "none", "examples" = [{ "tau0": "20 MPa", "alpha": 0.05 }]))]
    pub shear_strength: Option<Spanned<ShearStrengthSpec>>,
    /// What runs: the integral, the sum, and the boundary elements of the reference.
    #[schemars(extend("default" = ["statistical", "deterministic"], "examples" = [["statistical", "deterministic", "reference"]]))]
    pub models: Option<Spanned<Models>>,
    /// How the boundary elements run; only with `"reference"` among the models.
    #[schemars(extend("examples" = [{ "loads": 9, "error": 1e-6 }]))]
    pub reference: Option<Spanned<ReferenceSpec>>,
    /// Analytical lines beside the models, on surfaces with a map.
    #[schemars(extend("x-default" = "none", "examples" = [["persson", "bush-gibson-thomas"]]))]
    pub lines: Option<Spanned<Lines>>,
    /// Which statistical model runs.
    #[schemars(extend("x-default" = "Gaussian heights, arithmetic mean radius", "examples" = [{ "heights": "own", "mean-radius": "in-contact" }]))]
    pub statistical: Option<Spanned<StatisticalSpec>>,
    /// The largest differences between the models that do not matter to you; verdicts refer to them.
    #[serde(default)]
    #[schemars(extend("examples" = [{ "area": "10 %", "separation": 0.1, "stiffness": "20 %" }]))]
    pub accept: AcceptSpec,
    /// Whether verdicts on measured maps are computed again under other treatments of the map.
    #[serde(default = "yes")]
    #[schemars(extend("examples" = [false]))]
    pub robustness: bool,
    /// Whether the difference between the models is divided among its causes.
    #[serde(default = "yes")]
    #[schemars(extend("examples" = [false]))]
    pub attribution: bool,
    /// Whether all statistical models are compared with the sum and the reference.
    #[serde(default = "yes")]
    #[schemars(extend("examples" = [false]))]
    pub rank_models: bool,
    /// The surfaces to run on, by name.
    #[schemars(extend("x-default" = "all of the file", "examples" = [["ground"]]))]
    pub surfaces: Option<Vec<Spanned<String>>>,
    /// The figures of Pasaribu and Schipper (2005) that the spec reproduces, by number: the main figure of its report shows them in the
    /// paper's axes. 3: radii against heights of the asperities; 4: separation against load; 6: separation and area by layer thickness.
    #[schemars(extend("x-default" = "none", "examples" = [[3, 4]]))]
    pub figure_of_paper: Option<Spanned<SurfaceFigures>>,
    /// Separations at which the models run, d/sigma from the mean asperity height. At least one of `separation`, `pressure` and `force` is needed.
    pub separation: Option<LinearSweep>,
    /// Nominal pressures at which the models are compared.
    #[schemars(extend("examples" = [{ "from": "0.1 MPa", "to": "100 MPa", "points": 31 }]))]
    pub pressure: Option<Spanned<LogSweep<Pressure, NominalPressureRange>>>,
    /// Forces on the nominal area at which the models are compared.
    #[schemars(extend("examples" = ["10 N"]))]
    pub force: Option<Spanned<LogSweep<Force>>>,
    /// Nominal area that `force` acts on: the nominal pressure is force over nominal area. Beside `pressure` it gives the force.
    #[schemars(extend("x-default" = "that of each surface", "examples" = ["4 mm^2"]))]
    pub nominal_area: Option<Spanned<Quantity<Area, NominalAreaRange>>>,
}

fn yes() -> bool {
    true
}

/// A list of models and the reference, none twice, at least one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Vec<ModelName>")]
pub struct Models {
    /// The models.
    pub kinds: Vec<ModelKind>,
    /// Whether the reference runs.
    pub has_reference: bool,
}

/// One of `models`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum ModelName {
    Statistical,
    Deterministic,
    Reference,
}

impl Default for Models {
    fn default() -> Self {
        Self { kinds: vec![ModelKind::Statistical, ModelKind::Deterministic], has_reference: false }
    }
}

impl TryFrom<Vec<ModelName>> for Models {
    type Error = String;

    fn try_from(names: Vec<ModelName>) -> Result<Self, String> {
        const ALLOWED: &str =
            "allowed: one or more of \"statistical\", \"deterministic\" and \"reference\", each once";
        if names.is_empty() {
            return Err(format!("found an empty list; {ALLOWED}"));
        }
        if (1..names.len()).any(|k| names[..k].contains(&names[k])) {
            return Err(format!("found a model twice; {ALLOWED}"));
        }
        let kind = |name: &ModelName| match name {
            ModelName::Statistical => Some(ModelKind::Statistical),
            ModelName::Deterministic => Some(ModelKind::Deterministic),
            ModelName::Reference => None,
        };
        Ok(Self {
            kinds: names.iter().filter_map(kind).collect(),
            has_reference: names.contains(&ModelName::Reference),
        })
    }
}

written_schema!(Models, |_| json!({
    "type": "array",
    "items": { "type": "string", "enum": ["statistical", "deterministic", "reference"] },
    "minItems": 1,
    "uniqueItems": true,
}));

/// A list of lines, none twice, at least one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Vec<AnalyticalLine>")]
pub struct Lines(pub Vec<AnalyticalLine>);

written_schema!(Lines, |generator| json!({
    "type": "array", "items": generator.subschema_for::<AnalyticalLine>(), "minItems": 1, "uniqueItems": true,
}));

impl TryFrom<Vec<AnalyticalLine>> for Lines {
    type Error = String;

    fn try_from(lines: Vec<AnalyticalLine>) -> Result<Self, String> {
        let names: Vec<String> =
            AnalyticalLine::ALL.iter().map(|line| format!("\"{}\"", line.name())).collect();
        let allowed = format!("allowed: one or more of {}, each once", names.join(", "));
        if lines.is_empty() {
            return Err(format!("found an empty list; {allowed}"));
        }
        if (1..lines.len()).any(|k| lines[..k].contains(&lines[k])) {
            return Err(format!("found a line twice; {allowed}"));
        }
        Ok(Self(lines))
    }
}

/// Both models on given surfaces, and the reference beside them.
pub struct ComparePlan {
    /// Bodies, laws, loads and surfaces.
    pub study: StudyPlan,
    pub models: Vec<ModelKind>,
    /// The reference beside them, where one is asked for.
    pub reference: Option<Box<ReferencePlan>>,
    /// Closed results beside the models.
    pub lines: Vec<AnalyticalLine>,
    /// Whether the verdicts on measured maps are computed again under other treatments of the map.
    pub is_robustness_examined: bool,
    /// Whether the gap between the models is divided among its causes.
    pub is_attributed: bool,
    /// Whether all statistical models are compared with sum and reference.
    pub is_ranked: bool,
    /// The measured file that the command line named: its surface is described in full.
    pub described: Option<PathBuf>,
    pub figures_of_paper: Vec<u8>,
}

impl ComparePlan {
    /// A study by both models alone.
    pub fn of_models(study: StudyPlan) -> Self {
        Self {
            study,
            models: Models::default().kinds,
            reference: None,
            lines: Vec::new(),
            is_robustness_examined: false,
            is_attributed: false,
            is_ranked: false,
            described: None,
            figures_of_paper: Vec::new(),
        }
    }

    /// How closely the first realisation of its surfaces is looked at.
    pub fn depth(&self) -> AnalysisDepth {
        if self.described.is_some() { AnalysisDepth::Everything } else { AnalysisDepth::Comparison }
    }

    /// Whether something follows the intervals: other treatments of a measured map, or boundary elements.
    #[cfg(feature = "serve")]
    pub(crate) fn goes_on(&self) -> bool {
        let is_treated =
            self.is_robustness_examined && self.study.surfaces.iter().any(SurfacePlan::is_measured);
        self.reference.is_some() || is_treated
    }

    pub fn setup<'a>(&'a self, context: &RunContext<'a>) -> Setup<'a> {
        let layer = self.study.layer.as_ref();
        Setup {
            models: &self.models,
            is_attributed: self.is_attributed,
            // A table for each of several thicknesses would have no reader.
            is_ranked: self.is_ranked && layer.is_none_or(|layer| layer.thicknesses.len() == 1),
            ..self.study.setup(context)
        }
    }
}

impl fmt::Display for ComparePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.study.describe(&self.models, f)?;
        if let Some(reference) = &self.reference {
            reference.describe(&self.study.surfaces, f)?;
        }
        self.study.warn(f)
    }
}

pub(super) fn plan(file: &SpecFile, table: &Spanned<CompareSpec>) -> Result<ComparePlan, InputError> {
    let raw = table.get_ref();
    if let (Some(area), None, None) = (&raw.nominal_area, &raw.pressure, &raw.force) {
        let message = "found a nominal area without a load; allowed: beside `force`, which acts on it, or `pressure`, whose force it \
                       gives";
        return Err(file.source.error_at(area.span(), message));
    }
    let mut study = StudyPlan::new(file, keys(table))?;
    let [bare, _] = study.bare_and_coated();
    let models = raw.models.as_ref().map_or_else(Models::default, |models| models.get_ref().clone()).kinds;
    if models.contains(&ModelKind::Deterministic) {
        study.check_summed(file, raw.models.as_ref().map(Spanned::span))?;
    }
    let resolved = Resolved { bare, flats: &study.flats, laws: &study.laws, surfaces: &study.surfaces };
    let reference = reference(file, &reference_keys(raw), &resolved)?.map(Box::new);
    study.implausible.extend(reference.iter().find_map(|reference| {
        let known = |surface: &SurfacePlan| Some((surface.name.clone(), surface.points_per_wave()?));
        reference.warning(study.surfaces.iter().filter_map(known))
    }));
    study.implausible.extend(reference.iter().find_map(|reference| reference.cluster_warning(&study)));
    let lines = lines(file, raw, &study.surfaces, reference.as_deref())?;
    Ok(ComparePlan {
        models,
        reference,
        lines,
        is_robustness_examined: raw.robustness,
        is_attributed: raw.attribution,
        is_ranked: raw.rank_models,
        figures_of_paper: figures_of_paper(file, raw, &study)?,
        study,
        described: None,
    })
}

/// The figures of the paper, which the comparison must be able to show.
fn figures_of_paper(file: &SpecFile, raw: &CompareSpec, study: &StudyPlan) -> Result<Vec<u8>, InputError> {
    let Some(figures) = &raw.figure_of_paper else { return Ok(Vec::new()) };
    let has_thicknesses = study.layer.as_ref().is_some_and(|layer| layer.thicknesses.len() > 1);
    let has_both = raw.models.as_ref().is_none_or(|models| models.get_ref().kinds.len() == 2);
    let needed = |figure: &u8| match figure {
        4 if has_thicknesses || !has_both => {
            Some("both models and no layer of several thicknesses, as Fig. 4 compares the models")
        }
        6 if !has_thicknesses => Some("a layer of several thicknesses, as Fig. 6 compares thicknesses"),
        _ => None,
    };
    let numbers = &figures.get_ref().0;
    match numbers.iter().find_map(|figure| Some((figure, needed(figure)?))) {
        None => Ok(numbers.clone()),
        Some((figure, needed)) => {
            let message = format!("found the figure {figure} of the paper; allowed: with {needed}");
            Err(file.source.error_at(figures.span(), message))
        }
    }
}

fn keys(table: &Spanned<CompareSpec>) -> StudyKeys<'_> {
    let raw = table.get_ref();
    StudyKeys {
        table: table.span(),
        rough: &raw.rough,
        flat: &raw.flat,
        law: &raw.law,
        layer: raw.layer.as_ref(),
        spots: SpotKeys {
            conductance: raw.conductance.as_ref(),
            shear_strength: raw.shear_strength.as_ref(),
        },
        statistical: raw.statistical.as_ref(),
        accept: raw.accept,
        surfaces: raw.surfaces.as_deref(),
        controls: Controls {
            separations: raw.separation.as_ref().map(|sweep| sweep.0.clone()).unwrap_or_default(),
            pressures: raw.pressure.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
            forces: raw.force.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
        },
        nominal_area: raw.nominal_area.as_ref().map(|area| area.get_ref().value()),
        load_keys: [raw.pressure.as_ref().map(Spanned::span), raw.force.as_ref().map(Spanned::span)],
    }
}

fn reference_keys(raw: &CompareSpec) -> ReferenceKeys<'_> {
    let pressures = raw.pressure.as_ref().map(|sweep| (Control::Pressure, sweep.get_ref().loads()));
    let forces = raw.force.as_ref().map(|sweep| (Control::Force, sweep.get_ref().loads()));
    let loads = pressures.into_iter().chain(forces);
    ReferenceKeys {
        models: raw.models.as_ref(),
        reference: raw.reference.as_ref(),
        separations: raw.separation.as_ref().map(|sweep| sweep.0.len()),
        loads: loads.map(|(control, (values, is_listed))| (control, values, is_listed)).collect(),
        bodies: [&raw.rough.get_ref().0, raw.flat.get_ref()],
    }
}

/// Both models on the one surface of `file`, which the command line named and which is described in full.
pub fn described(file: &SpecFile) -> Result<ComparePlan, InputError> {
    let plan = plan(file, &file.required_table("compare")?)?;
    let described = plan.study.surfaces.first().and_then(|surface| surface.inputs().into_iter().next());
    Ok(ComparePlan { described, ..plan })
}

/// How far a run goes; a longer one repeats the shorter ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Extent {
    /// Both models at some of the loads on the first realisation, without intervals and what follows from them.
    Models,
    /// With intervals, causes and other statistical models, on all realisations.
    Intervals,
    /// With other treatments of maps and the reference.
    #[default]
    Everything,
}

/// What a run does, and what it takes from earlier ones.
#[derive(Clone, Copy)]
pub struct Scope<'a> {
    pub extent: Extent,
    pub store: Option<&'a dyn SurfaceStore>,
    /// Sampling errors that a shorter run of the same spec has found.
    pub samplings: Option<&'a Samplings>,
    /// The most cases of which each has a picture of its contacts.
    pub pictures: usize,
}

/// The sampling errors of the cases of each surface, between the runs of one spec.
#[derive(Default)]
pub struct Samplings(Mutex<IndexMap<String, Vec<CaseSampling>>>);

impl Samplings {
    /// Those of a surface, or what `find` finds, which is kept.
    pub(super) fn of(&self, surface: &str, find: impl FnOnce() -> Vec<CaseSampling>) -> Vec<CaseSampling> {
        let all = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = all().get(surface).cloned();
        known.unwrap_or_else(|| {
            let found = find();
            all().insert(surface.to_owned(), found.clone());
            found
        })
    }
}

impl Default for Scope<'_> {
    /// A whole run by itself; of one case there is a picture.
    fn default() -> Self {
        Self { extent: Extent::Everything, store: None, samplings: None, pictures: 1 }
    }
}

impl Scope<'_> {
    pub(super) fn has_intervals(self) -> bool {
        self.extent >= Extent::Intervals
    }

    pub(super) fn has_everything(self) -> bool {
        self.extent == Extent::Everything
    }

    pub(super) fn realisations(self, surface: &SurfacePlan) -> usize {
        if self.has_intervals() { surface.realisations } else { 1 }
    }
}

/// At most so many points of a sweep where the models alone are run.
const FEW: usize = 11;

/// At most `FEW` points of each sweep, its ends among them.
pub fn thinned(controls: &Controls) -> Controls {
    let few = |values: &[f64]| match values.len() {
        0..=FEW => values.to_vec(),
        count => (0..FEW).map(|k| values[k * (count - 1) / (FEW - 1)]).collect(),
    };
    let Controls { separations, pressures, forces } = controls;
    Controls { separations: few(separations), pressures: few(pressures), forces: few(forces) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_sweep_has_its_ends_and_no_point_of_its_own() {
        let long: Vec<f64> = (0..61).map(f64::from).collect();
        let thin = thinned(&Controls { separations: vec![3.0, 2.0], ..Controls::at_pressures(long.clone()) });
        assert_eq!((thin.separations, thin.pressures.len()), (vec![3.0, 2.0], FEW));
        assert_eq!((thin.pressures[0], thin.pressures[FEW - 1]), (0.0, 60.0));
        assert!(
            thin.pressures.is_sorted_by(|a, b| a < b) && thin.pressures.iter().all(|one| long.contains(one))
        );
    }
}
