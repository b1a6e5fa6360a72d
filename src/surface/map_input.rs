//! What a spec says of a file of heights: its units, and the heights that mark missing points.

use asperity::topography::read::LengthUnits;
use asperity::units::Dimension;
use asperity_contact_framework::input::{Forms, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::spec::UnitSpec;

/// `unit` of a map: one of all lengths, or one of coordinates and one of heights.
#[derive(Debug, Clone, Copy)]
pub struct MapUnitSpec(pub LengthUnits);

/// Units of coordinates and heights.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { xy, z }")]
struct Both {
    /// Unit of x and y.
    xy: UnitSpec,
    /// Unit of heights.
    z: UnitSpec,
}

written_schema!(MapUnitSpec, |generator| {
    let one = UnitSpec::json_schema(generator);
    let both = Both::json_schema(generator);
    json!({
        "anyOf": [one, both],
        schema::TYPE: "unit of length, or a table of two: xy and z",
        schema::RANGE: Dimension::Length.documented().join(", "),
    })
});

impl<'de> Deserialize<'de> for MapUnitSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new("a unit of length such as \"um\", or { xy = \"um\", z = \"nm\" }")
            .text(|text| UnitSpec::try_from(text.to_owned()).map(|unit| Self(LengthUnits::same(unit.0))))
            .table(|Both { xy, z }| Ok(Self(LengthUnits { xy: xy.0, z: z.0 })))
            .read(deserializer)
    }
}

/// `missing`: heights that mark missing points, in the unit of the file.
#[derive(Debug, Clone)]
pub struct MissingSpec(pub Vec<f64>);

written_schema!(MissingSpec, |_| {
    let one = json!({ "type": "number" });
    json!({ "anyOf": [one, { "type": "array", "items": one }], schema::TYPE: "number, or a list of numbers" })
});

impl<'de> Deserialize<'de> for MissingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let found =
            Forms::new("a number such as -9999, or a list of numbers; [] where every number is a height")
                .number(|value, _| Ok(vec![value]))
                .list(Ok)
                .read(deserializer)?;
        match found.iter().find(|mark| !mark.is_finite()) {
            Some(mark) => Err(serde::de::Error::custom(format!(
                "found {mark}; allowed: finite numbers (NaN and infinite heights are missing points in any case)"
            ))),
            None => Ok(Self(found)),
        }
    }
}
