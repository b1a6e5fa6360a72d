//! Sweeps: one value, a list of values, `{ from, to, points }` or `{ values = [...] }`.

use std::borrow::Cow;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::quantity::Whole;
use crate::input::Forms;
use crate::input::quantity::{Dimension, Positive, Pure, Quantity, Range, SeparationRange};
use crate::input::schema::{self, RANGE, TYPE, UNIT};

/// The most points that one sweep may have.
const MOST_POINTS: usize = 100_000;

const TABLES: &str = "{ from, to, points } or { values = [...] }";

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "Quantity<D, R>: Deserialize<'de>"))]
struct Keys<D, R> {
    from: Option<Quantity<D, R>>,
    to: Option<Quantity<D, R>>,
    points: Option<Whole>,
    values: Option<Vec<Quantity<D, R>>>,
}

/// A sweep as it stands in a spec: one value, a list of values, or a table of [`Keys`].
struct Written<D, R>(Keys<D, R>);

impl<'de, D: Dimension, R: Range> Deserialize<'de> for Written<D, R> {
    fn deserialize<T: Deserializer<'de>>(deserializer: T) -> Result<Self, T::Error> {
        let example = D::UNITS.map_or_else(|| "2.5".to_owned(), |units| format!("\"{}\"", units.example()));
        Forms::new(&format!("one value such as {example}, a list of values, {TABLES}"))
            .text(|text| Quantity::parse(text).map(|value| Self::new(vec![value])))
            .number(|value, found| Quantity::bare(value, found).map(|value| Self::new(vec![value])))
            .list(|values| Ok(Self::new(values)))
            .table(|keys| Ok(Self(keys)))
            .read(deserializer)
    }
}

/// What a sweep may be; `spacing` says how the values of `{ from, to, points }` are spread.
fn written_schema<D: Dimension, R: Range>(spacing: &str, example: serde_json::Value) -> Schema {
    let one = schema::quantity::<D, R>();
    let name = one[TYPE].as_str().unwrap_or_default();
    let mut written = json!({
        "anyOf": [
            one,
            { "type": "array", "items": one, "minItems": 1, "maxItems": MOST_POINTS },
            {
                "type": "object",
                "properties": {
                    "from": one, "to": one, "points": { "type": "integer", "minimum": 2, "maximum": MOST_POINTS },
                },
                "required": ["from", "to", "points"],
                "additionalProperties": false,
            },
            {
                "type": "object",
                "properties": { "values": { "type": "array", "items": one, "minItems": 1, "maxItems": MOST_POINTS } },
                "required": ["values"],
                "additionalProperties": false,
            },
        ],
        TYPE: format!("{name}, a list, {{ from, to, points }} {spacing}, or {{ values }}"),
        "examples": [example],
    });
    for key in [UNIT, RANGE] {
        if let Some(value) = one.get(key) {
            written[key] = value.clone();
        }
    }
    schema::of(written)
}

crate::written_schema!(LinearSweep, |_| written_schema::<Pure, SeparationRange>(
    "evenly spaced",
    json!({ "from": 4, "to": 0, "points": 81 })
));

impl<D: Dimension, R: Range> JsonSchema for LogSweep<D, R> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "sweep".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let one = D::UNITS.map_or(json!(10), |units| json!(units.example()));
        written_schema::<D, R>("spaced by equal ratios", one)
    }
}

impl<D, R> Written<D, R> {
    fn new(values: Vec<Quantity<D, R>>) -> Self {
        Self(Keys { from: None, to: None, points: None, values: Some(values) })
    }
}

impl<D: Dimension, R: Range> Keys<D, R> {
    /// The values, spaced by `between(from, to, fraction)`.
    fn values(self, between: fn(f64, f64, f64) -> f64) -> Result<Vec<f64>, String> {
        match (self.from, self.to, self.points, self.values) {
            (None, None, None, Some(values)) => match values.len() {
                0 => Err("found an empty list; allowed: at least one value".to_owned()),
                count if count > MOST_POINTS => {
                    Err(format!("found {count} values; allowed: at most {MOST_POINTS}"))
                }
                _ => Ok(values.iter().map(Quantity::value).collect()),
            },
            (Some(from), Some(to), Some(Whole(points)), None) => {
                let allowed = usize::try_from(points).ok().filter(|count| (2..=MOST_POINTS).contains(count));
                let points =
                    allowed.ok_or_else(|| format!("found points = {points}; allowed: 2 to {MOST_POINTS}"))?;
                let (from, to) = (from.value(), to.value());
                let value = |k: usize| match k {
                    0 => from,
                    k if k == points - 1 => to,
                    k => between(from, to, k as f64 / (points - 1) as f64),
                };
                Ok((0..points).map(value).collect())
            }
            (None, None, None, None) => Err(format!("found nothing; allowed: {TABLES}")),
            (.., Some(_)) => {
                Err(format!("found `values` together with `from`, `to` or `points`; allowed: {TABLES}"))
            }
            _ => Err(format!("found only some of `from`, `to` and `points`; allowed: {TABLES}")),
        }
    }
}

/// Evenly spaced separations, in sigma.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Written<Pure, SeparationRange>")]
pub struct LinearSweep(pub Vec<f64>);

impl TryFrom<Written<Pure, SeparationRange>> for LinearSweep {
    type Error = String;

    fn try_from(Written(keys): Written<Pure, SeparationRange>) -> Result<Self, String> {
        keys.values(|from, to, fraction| from + (to - from) * fraction).map(Self)
    }
}

/// Logarithmically spaced positive quantities, SI.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "Written<D, R>", bound(deserialize = "D: Dimension, R: Range"))]
pub struct LogSweep<D, R = Positive> {
    /// The values, SI.
    pub values: Vec<f64>,
    /// Whether they were given one by one.
    #[serde(skip)]
    pub is_listed: bool,
    #[serde(skip)]
    kind: PhantomData<(D, R)>,
}

impl<D: Dimension, R: Range> LogSweep<D, R> {
    /// The values, and whether they are listed one by one.
    pub fn loads(&self) -> (&[f64], bool) {
        (&self.values, self.is_listed)
    }
}

impl<D: Dimension, R: Range> TryFrom<Written<D, R>> for LogSweep<D, R> {
    type Error = String;

    fn try_from(Written(keys): Written<D, R>) -> Result<Self, String> {
        let is_listed = keys.values.is_some();
        let values = keys.values(|from, to, fraction| from * (to / from).powf(fraction))?;
        Ok(Self { values, is_listed, kind: PhantomData })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::quantity::Force;

    fn forces(text: &str) -> Result<Vec<f64>, String> {
        let value = toml::de::ValueDeserializer::parse(text).map_err(|error| error.message().to_owned())?;
        let read = LogSweep::<Force>::deserialize(value);
        read.map(|sweep| sweep.values).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn one_value_and_a_list_are_sweeps_too() {
        for (text, values) in [
            ("\"5 N\"", vec![5.0]),
            ("5", vec![5.0]),
            ("0.5", vec![0.5]),
            ("[\"5 N\", 7]", vec![5.0, 7.0]),
            ("{ values = [\"5 N\"] }", vec![5.0]),
            ("{ from = 1, to = \"4 N\", points = 3.0 }", vec![1.0, 2.0, 4.0]),
        ] {
            assert_eq!(forces(text), Ok(values), "{text}");
        }
        let separation = toml::de::ValueDeserializer::parse("2.5").unwrap();
        assert_eq!(LinearSweep::deserialize(separation).unwrap(), LinearSweep(vec![2.5]));
    }

    #[test]
    fn what_is_no_sweep_says_what_one_is() {
        let half = forces("{ from = 1, to = 4, points = 1.5 }").unwrap_err();
        assert!(half.contains("a whole number such as 1000"), "{half}");
        let nothing = forces("{}").unwrap_err();
        assert!(nothing.contains("found nothing; allowed: { from, to, points } or"), "{nothing}");
    }
}
