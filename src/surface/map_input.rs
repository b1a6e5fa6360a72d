//! What a spec says of a file of heights: its units, and the heights that mark missing points.

use asperity::topography::read::{LengthUnits, Marks};
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

/// `missing`: heights that mark missing points, in the unit of the file, and words of a text that do.
#[derive(Debug, Clone)]
pub struct MissingSpec(pub Marks);

written_schema!(MissingSpec, |_| {
    let one = json!({ "type": ["number", "string"] });
    let kind = "number or word, or a list of them";
    json!({ "anyOf": [one, { "type": "array", "items": one }], schema::TYPE: kind })
});

/// A height or a word.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a number or a word")]
enum Mark {
    Height(f64),
    Word(String),
}

impl<'de> Deserialize<'de> for MissingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number such as -9999, a word such as \"***\", or a list of them; [] where every number is a height";
        let found = Forms::new(expected)
            .number(|value, _| Ok(vec![Mark::Height(value)]))
            .text(|word| Ok(vec![Mark::Word(word.to_owned())]))
            .list(Ok)
            .read(deserializer)?;
        let mut marks = Marks::default();
        for mark in found {
            match mark {
                Mark::Height(height) if height.is_finite() => marks.heights.push(height),
                Mark::Word(word) if !word.trim().is_empty() => marks.words.push(word.trim().to_owned()),
                _ => {
                    return Err(serde::de::Error::custom(
                        "found NaN, an infinite height or an empty word, which are missing points in any case; allowed: finite numbers and words",
                    ));
                }
            }
        }
        Ok(Self(marks))
    }
}
