//! JSON schemas of values that are read by hand, and what documentation says of them.

use schemars::generate::SchemaSettings;
use schemars::{Schema, SchemaGenerator};
use serde_json::{Value, json};

use super::quantity::{Dimension, Range};

/// What kind of value it is, in words.
pub const TYPE: &str = "x-type";
pub const UNIT: &str = "x-unit";
/// The values allowed, in words.
pub const RANGE: &str = "x-range";

/// What holds where it is left out, in words; a default that is a value is the `default` of the schema, which editors insert.
pub const DEFAULT: &str = "x-default";

/// A generator of schemas that editors understand (draft 7), each complete in itself.
pub fn generator() -> SchemaGenerator {
    SchemaSettings::draft07().with(|settings| settings.inline_subschemas = true).into_generator()
}

/// Implements [`schemars::JsonSchema`] of a type that is read by hand: an expression of JSON.
#[macro_export]
macro_rules! written_schema {
    ($type:ty, |$generator:pat_param| $schema:expr) => {
        impl schemars::JsonSchema for $type {
            fn inline_schema() -> bool {
                true
            }
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($type).into()
            }
            fn json_schema($generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $crate::input::schema::of($schema)
            }
        }
    };
}

/// A schema from JSON that is an object.
pub fn of(json: impl Into<Value>) -> Schema {
    Schema::try_from(json.into()).unwrap_or_default()
}

/// A quantity of a dimension: a number, or a number with a unit as text.
pub fn quantity<D: Dimension, R: Range>() -> Value {
    let mut number = json!({ "type": "number" });
    for (key, bound) in R::BOUNDS {
        number[key] = json!(bound);
    }
    let Some(units) = D::UNITS else {
        number[TYPE] = json!("number");
        number[RANGE] = json!(R::IN_SHORT);
        return number;
    };
    let documented = units.documented().join(", ");
    let first = units.name().trim_start_matches("an ").trim_start_matches("a ");
    json!({
        "anyOf": [number, { "type": "string", "pattern": r"^\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\s*\D.*$" }],
        TYPE: first,
        UNIT: format!("{documented}; a bare number is in {}", units.si_unit()),
        RANGE: R::IN_SHORT,
        "examples": [units.example()],
    })
}

/// One such value or a list of them, of which a person would say `words`.
pub fn one_or_many(one: impl Into<Value>, words: &str) -> Value {
    let one: Value = one.into();
    let mut schema = json!({ "anyOf": [one, { "type": "array", "items": one, "minItems": 1 }], TYPE: words });
    for key in [UNIT, RANGE, "examples"] {
        if let Some(value) = one.get(key) {
            schema[key] = value.clone();
        }
    }
    schema
}

/// One of some names.
pub fn names<'a>(names: impl IntoIterator<Item = &'a str>) -> Value {
    json!({ "type": "string", "enum": names.into_iter().collect::<Vec<_>>() })
}

/// Takes out what TOML has not: `null`, beside which optional keys stand in a generated schema.
pub fn without_null(schema: &mut Value) {
    match schema {
        Value::Object(fields) => {
            if let Some(Value::Array(types)) = fields.get_mut("type") {
                types.retain(|one| one != "null");
                if let [one] = &types[..] {
                    let one = one.clone();
                    fields.insert("type".to_owned(), one);
                }
            }
            if let Some(Value::Array(values)) = fields.get_mut("enum") {
                values.retain(|value| !value.is_null());
            }
            if fields.get("default").is_some_and(Value::is_null) {
                fields.remove("default");
            }
            if let Some(Value::Array(alternatives)) = fields.get_mut("anyOf") {
                alternatives.retain(|one| one.get("type").is_none_or(|of| of != "null"));
                if let [Value::Object(one)] = &mut alternatives[..] {
                    let one = std::mem::take(one);
                    fields.remove("anyOf");
                    // What the key says precedes what its type says.
                    for (key, value) in one {
                        fields.entry(key).or_insert(value);
                    }
                }
            }
            fields.values_mut().for_each(without_null);
        }
        Value::Array(values) => values.iter_mut().for_each(without_null),
        _ => {}
    }
}
