//! `layer = { material = "lead", thickness = [0, "50 nm", "inf"] }`: the layer on the flat.

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use asperity::{ModulusModel, units};
use asperity_contact_framework::input::quantity::{Length, NotNegative, Quantity};
use asperity_contact_framework::input::schema;
use asperity_contact_framework::input::{Forms, OneOrMany, Spanned};
use asperity_contact_framework::written_schema;

/// A layer on the flat, of one thickness or several.
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
    /// One thickness, or several, ascending; 0 is the bare flat, `"inf"` the bulk of the layer.
    #[schemars(extend("examples" = [[0, "50 nm", "inf"]]))]
    pub thickness: Thicknesses,
    /// The effective-modulus model of layer and substrate.
    #[serde(default)]
    #[schemars(extend("default" = "gao", "examples" = ["series"]))]
    pub rule: ModulusModel,
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

impl<'de> Deserialize<'de> for Thickness {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let refused = |found: String| format!("found {found}; allowed: {}", allowed());
        Forms::new(&allowed())
            .text(|text| match text.trim() {
                "inf" => Ok(Self(f64::INFINITY)),
                _ => Quantity::<Length, NotNegative>::parse(text)
                    .map(|length| Self(length.value()))
                    .map_err(|_| refused(format!("\"{text}\""))),
            })
            .number(|value, found| match value {
                f64::INFINITY => Ok(Self(f64::INFINITY)),
                value => Quantity::<Length, NotNegative>::checked(value, &found)
                    .map(|length| Self(length.value()))
                    .map_err(|_| refused(value.to_string())),
            })
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

written_schema!(Thicknesses, |_| {
    let mut one = schema::quantity::<Length, NotNegative>();
    one[schema::RANGE] = json!("0, positive, or \"inf\"");
    one["anyOf"][1]["pattern"] = json!(r"^\s*(inf|[-+]?[0-9.]+.*)\s*$");
    schema::one_or_many(one, "length, or an ascending list")
});

impl<'de> Deserialize<'de> for Thicknesses {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = format!("a thickness ({}) or a list of thicknesses", allowed());
        let read = OneOrMany::<Thickness>::read(deserializer, &expected)?;
        let stands_alone = matches!(read, OneOrMany::One(_));
        let all = read.at_least_one("thickness")?;
        if !all.is_sorted_by(|a, b| a.0 < b.0) {
            return Err(D::Error::custom(
                "found thicknesses that are not ascending; allowed: each once, the thinnest first, \"inf\" last",
            ));
        }
        Ok(Self { values: all.into_iter().map(|thickness| thickness.0).collect(), stands_alone })
    }
}
