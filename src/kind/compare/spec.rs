//! `[compare]`: both models on the same surfaces, and the reference beside them.

use asperity::analytical::AnalyticalLine;
use asperity::compare::ModelKind;
use asperity_contact_framework::input::Spanned;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::bare::{NominalAreaRange, NominalPressureRange};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Area, Force, Pressure, Quantity};
use asperity_contact_framework::input::sweep::{LinearSweep, LogSweep};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::json;

use super::reference::ReferenceSpec;
use crate::layer::LayerSpec;
use crate::paper::SurfaceFigures;
use crate::study_plan::{ConductanceSpec, RoughBody, ShearStrengthSpec, StatisticalSpec};

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
