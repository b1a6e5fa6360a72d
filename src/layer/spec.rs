//! `layer = { material = "lead", thickness = [0, "50 nm", "inf"] }`: the layer on the flat, or with `on = "rough"` on the
//! rough body.

use asperity::law::Body;
use asperity::{ModulusModel, units};
use asperity_contact_framework::input::bare::{ThicknessOrNone, ThicknessRange};
use asperity_contact_framework::input::quantity::{Length, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{Forms, Spanned, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use crate::study_plan::{Breakdowns, ShearStrengthSpec};

/// A layer on one of the bodies, of one thickness or several.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a layer such as { material = \"lead\", thickness = [0, \"50 nm\", \"inf\"] }"
)]
pub struct LayerSpec {
    /// The name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["lead"]))]
    pub material: Spanned<String>,
    /// One thickness, or several, as an ascending list or spaced by equal ratios; 0 is the bare body, `"inf"` the bulk of the layer.
    #[schemars(extend("examples" = [[0, "50 nm", "inf"], { "from": "10 nm", "to": "10 um", "points": 7 }]))]
    pub thickness: Thicknesses,
    /// The effective-modulus model of layer and substrate.
    #[serde(default)]
    #[schemars(extend("default" = "gao", "examples" = ["series"]))]
    pub rule: ModulusModel,
    /// The body that has the layer. On the rough body it follows the surface, whose heights are those of the coated one; each coated asperity is taken as a layered half-space.
    #[schemars(extend("default" = "flat", "examples" = ["rough"]))]
    pub on: Option<Spanned<Body>>,
    /// Shear strength of the layer, in which spots shear until they break through it; beside that of the interface, `compare.shear-strength`.
    #[schemars(extend("x-default" = "that of the interface", "examples" = [{ "tau0": "8 MPa" }]))]
    pub shear_strength: Option<Spanned<ShearStrengthSpec>>,
    /// Indentation over the thickness of the layer from which on a spot has broken through it and shears as the interface; of several the first
    /// counts for verdicts, and the friction by thickness is shown for each.
    #[schemars(extend("default" = 1, "examples" = [[1, 0.5, 2]]))]
    pub breakdown: Option<Spanned<Breakdowns>>,
}

/// One thickness, m: 0 is uncoated, infinity the bulk layer material.
struct Thickness(f64);

/// What a thickness may be.
fn allowed() -> String {
    let units = units::Dimension::Length;
    format!(
        "0, \"inf\", or a positive finite length such as \"50 nm\" ({}; a bare number is in {})",
        units.documented().join(", "),
        units.si_unit()
    )
}

/// The thickness that a text names.
fn named(text: &str) -> Result<f64, String> {
    match text.trim() {
        "inf" => Ok(f64::INFINITY),
        _ => Quantity::<Length, ThicknessOrNone>::parse(text)
            .map(|length| length.value())
            .map_err(|_| format!("found \"{text}\"; allowed: {}", allowed())),
    }
}

/// The thickness that a number without a unit stands for.
fn bare(value: f64, found: &str) -> Result<f64, String> {
    if value.is_nan() || value < 0.0 {
        return Err(format!("found {value}; allowed: {}", allowed()));
    }
    match value {
        f64::INFINITY => Ok(value),
        value => Quantity::<Length, ThicknessOrNone>::bare(value, found).map(|length| length.value()),
    }
}

impl<'de> Deserialize<'de> for Thickness {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new(&allowed())
            .text(|text| named(text).map(Self))
            .number(|value, found| bare(value, found).map(Self))
            .read(deserializer)
    }
}

/// One thickness or a list of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Thicknesses {
    /// m, ascending, none twice.
    pub values: Vec<f64>,
    /// Whether it is a thickness that stands alone, not in a list.
    pub stands_alone: bool,
}

written_schema!(Thicknesses, |generator| {
    let mut one = schema::quantity::<Length, ThicknessOrNone>();
    one[schema::RANGE] = json!("0, positive, or \"inf\"");
    one["anyOf"][1]["pattern"] = json!(r"^\s*(inf|[-+]?[0-9.]+.*)\s*$");
    let mut thicknesses =
        schema::one_or_many(one, "length, an ascending list, or { from, to, points } spaced by equal ratios");
    let sweep = LogSweep::<Length, ThicknessRange>::json_schema(generator).to_value();
    let tables = sweep["anyOf"].as_array().into_iter().flatten().filter(|form| form["type"] == "object");
    if let Some(forms) = thicknesses["anyOf"].as_array_mut() {
        forms.extend(tables.cloned());
    }
    thicknesses
});

impl<'de> Deserialize<'de> for Thicknesses {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected =
            format!("a thickness ({}), a list of thicknesses, or {{ from, to, points }}", allowed());
        Forms::new(&expected)
            .text(|text| named(text).map(Self::one))
            .number(|value, found| bare(value, found).map(Self::one))
            .list(|list: Vec<Thickness>| {
                Self::several(list.into_iter().map(|thickness| thickness.0).collect())
            })
            .table(|sweep: LogSweep<Length, ThicknessRange>| Self::several(sweep.values))
            .read(deserializer)
    }
}

impl Thicknesses {
    fn one(value: f64) -> Self {
        Self { values: vec![value], stands_alone: true }
    }

    fn several(values: Vec<f64>) -> Result<Self, String> {
        if values.is_empty() {
            return Err("found an empty list; allowed: at least one thickness".to_owned());
        }
        if !values.is_sorted_by(|a, b| a < b) {
            return Err(
                "found thicknesses that are not ascending; allowed: each once, the thinnest first, \"inf\" last"
                    .to_owned(),
            );
        }
        Ok(Self { values, stands_alone: false })
    }
}
