//! How far the curve of a separation sweep may be off.

use std::fmt;

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde_json::json;

use asperity::compare::Tolerances;

use super::schema::{RANGE, TYPE};

/// One number for both models, or one for each.
#[derive(Debug, Clone, Copy, Default)]
pub struct ToleranceSpec(pub Tolerances);

/// The tolerances that mean anything: a sum of a million asperities has a sampling error of 1e-3, rounding is 1e-15.
pub const TOLERANCES: [f64; 2] = [1e-12, 0.01];

fn check<E: Error>(tolerance: f64) -> Result<f64, E> {
    let [least, most] = TOLERANCES;
    if (least..=most).contains(&tolerance) {
        Ok(tolerance)
    } else {
        Err(E::custom(format!("found the tolerance {tolerance}; allowed: {least:e} to {most}")))
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

        struct OneOrEach;

        impl<'de> Visitor<'de> for OneOrEach {
            type Value = ToleranceSpec;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a number such as 1e-4, or { statistical = 1e-8, deterministic = 1e-4 }")
            }

            fn visit_f64<E: Error>(self, tolerance: f64) -> Result<ToleranceSpec, E> {
                let tolerance = Some(check(tolerance)?);
                Ok(ToleranceSpec(Tolerances { statistical: tolerance, deterministic: tolerance }))
            }

            fn visit_i64<E: Error>(self, tolerance: i64) -> Result<ToleranceSpec, E> {
                self.visit_f64(tolerance as f64)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ToleranceSpec, A::Error> {
                let each = Each::deserialize(MapAccessDeserializer::new(map))?;
                let checked = |tolerance: Option<f64>| tolerance.map(check::<A::Error>).transpose();
                Ok(ToleranceSpec(Tolerances {
                    statistical: checked(each.statistical)?,
                    deterministic: checked(each.deterministic)?,
                }))
            }
        }
        deserializer.deserialize_any(OneOrEach)
    }
}
