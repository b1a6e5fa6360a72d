//! How far the curve of a separation sweep may be off.

use serde::{Deserialize, Deserializer};
use serde_json::json;

use asperity::compare::Tolerances;

use super::Forms;
use super::schema::{RANGE, TYPE};

/// One number for both models, or one for each.
#[derive(Debug, Clone, Copy, Default)]
pub struct ToleranceSpec(pub Tolerances);

/// The tolerances that mean anything: a sum of a million asperities has a sampling error of 1e-3, rounding is 1e-15.
pub const TOLERANCES: [f64; 2] = [1e-12, 0.01];

fn checked(tolerance: f64) -> Result<f64, String> {
    let [least, most] = TOLERANCES;
    if (least..=most).contains(&tolerance) {
        Ok(tolerance)
    } else {
        Err(format!("found the tolerance {tolerance}; allowed: {least:e} to {most}"))
    }
}

crate::written_schema!(ToleranceSpec, |_| {
    let one = json!({ "type": "number", "minimum": TOLERANCES[0], "maximum": TOLERANCES[1] });
    json!({
        "anyOf": [
            one,
            {
                "type": "object",
                "properties": { "statistical": one, "deterministic": one },
                "additionalProperties": false,
            },
        ],
        TYPE: "number, or { statistical, deterministic }",
        RANGE: "1e-12 to 0.01",
        "examples": [{ "deterministic": 0.01 }],
    })
});

impl<'de> Deserialize<'de> for ToleranceSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "kebab-case")]
        struct Each {
            statistical: Option<f64>,
            deterministic: Option<f64>,
        }

        Forms::new("a number such as 1e-4, or { statistical = 1e-8, deterministic = 1e-4 }")
            .number(|value, _| {
                let tolerance = Some(checked(value)?);
                Ok(Self(Tolerances { statistical: tolerance, deterministic: tolerance }))
            })
            .table(|each: Each| {
                Ok(Self(Tolerances {
                    statistical: each.statistical.map(checked).transpose()?,
                    deterministic: each.deterministic.map(checked).transpose()?,
                }))
            })
            .read(deserializer)
    }
}
