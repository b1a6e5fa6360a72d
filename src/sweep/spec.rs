//! `[sweep]` as it stands in a spec.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::input::bare::NominalPressureRange;
use asperity_contact_framework::input::quantity::{Pressure, Quantity};
use asperity_contact_framework::input::{plain_message, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;
use toml::{Table, Value};

/// The keys of a sweep that are no keys of a spec.
pub const COMBINE: &str = "combine";
/// See [`COMBINE`].
pub const FIND: &str = "find";

/// `[sweep]`: keys of the spec with their values, how they are combined, and what is to be found.
#[derive(Debug)]
pub struct SweepSpec(pub Table);

impl<'de> Deserialize<'de> for SweepSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Table::deserialize(deserializer).map(Self)
    }
}

written_schema!(SweepSpec, |generator| {
    let one = generator.subschema_for::<FindSpec>();
    let mut combine = generator.subschema_for::<Combine>().to_value();
    combine["default"] = json!("all");
    let values = json!({
        "anyOf": [
            { "type": "array", "minItems": 1 },
            {
                "type": "object",
                "description": "Without quotes around a key its parts are tables; a range is spread by equal ratios.",
            },
        ],
        "description": "A key of the spec, in quotes, with the values that it takes: a list, or `{ from, to, points }` spaced by equal ratios.",
        schema::TYPE: "a list of values, or { from, to, points }",
        "examples": [["2 GPa", "4 GPa", "8 GPa"]],
    });
    json!({
        "type": "object",
        "description": "The experiment beside it is run for several values of some of its keys, and one report compares them: `\"KEY\" = [...]` for each key.",
        schema::TYPE: "table of keys of the spec",
        "examples": [{ "seed": [1, 2, 3] }],
        "properties": {
            COMBINE: combine,
            FIND: {
                "anyOf": [one, { "type": "array", "items": one }],
                "description": "A value of a swept key that is to be found between its values: where a quantity is a given one, or a verdict changes. One or a list; only with `[compare]`.",
                schema::TYPE: "a table of `key`, `at` and what is looked for, or a list of such",
                schema::DEFAULT: "nothing is looked for",
                "examples": [{ "key": "compare.layer.thickness", "quantity": "area", "ratio": 0.5, "to": "uncoated", "at": "1 MPa" }],
            },
        },
        "additionalProperties": values,
    })
});

/// How the values of several keys are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Combine {
    /// Each value of a key with each of the others.
    #[default]
    All,
    /// The first values of all keys, the second values, and so on.
    Zip,
}

/// What is looked for between the values of a key.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct FindSpec {
    /// The swept key.
    pub key: String,
    /// The nominal pressure.
    pub at: Quantity<Pressure, NominalPressureRange>,
    /// The quantity that has a given `ratio` or `value`; without `verdict`.
    pub quantity: Option<FoundQuantity>,
    /// By which model; `difference` is that of the statistical from the deterministic model.
    #[serde(default)]
    pub model: FoundModel,
    /// The quantity over that of `to`.
    pub ratio: Option<f64>,
    /// What `ratio` refers to: `uncoated`, or a value of the key.
    #[schemars(with = "String")]
    pub to: Option<Value>,
    /// The quantity itself: area over nominal area, separation over sigma, else SI.
    pub value: Option<f64>,
    /// The quantity whose verdict changes.
    pub verdict: Option<FoundQuantity>,
}

/// A quantity that is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FoundQuantity {
    /// Real contact area over nominal area.
    Area,
    /// Separation over sigma.
    Separation,
    /// Stiffness.
    Stiffness,
    /// Electrical conductance per nominal area.
    ElectricalConductance,
    /// Thermal conductance per nominal area.
    ThermalConductance,
    /// Coefficient of boundary friction.
    Friction,
}

impl From<FoundQuantity> for ComparedQuantity {
    fn from(found: FoundQuantity) -> Self {
        match found {
            FoundQuantity::Area => Self::Area,
            FoundQuantity::Separation => Self::Separation,
            FoundQuantity::Stiffness => Self::Stiffness,
            FoundQuantity::ElectricalConductance => Self::ElectricalConductance,
            FoundQuantity::ThermalConductance => Self::ThermalConductance,
            FoundQuantity::Friction => Self::Friction,
        }
    }
}

/// Whose result is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FoundModel {
    /// The sum.
    #[default]
    Deterministic,
    /// The integral.
    Statistical,
    /// Boundary elements.
    Reference,
    /// The integral less the sum: relative, of the separation in sigma.
    Difference,
}

impl FoundModel {
    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Deterministic => "deterministic",
            Self::Statistical => "statistical",
            Self::Reference => "reference",
            Self::Difference => "difference",
        }
    }
}

impl SweepSpec {
    /// How values are combined.
    pub fn combine(&self) -> Result<Combine, String> {
        let found = self.0.get(COMBINE).cloned();
        found.map_or(Ok(Combine::All), |value| {
            Combine::deserialize(value.clone()).map_err(|_| {
                format!("found {value}; allowed: \"all\" (each value with each other) or \"zip\"")
            })
        })
    }

    /// What is looked for.
    ///
    /// # Errors
    /// A table that asks for nothing that can be found.
    pub fn find(&self) -> Result<Vec<FindSpec>, String> {
        let Some(found) = self.0.get(FIND).cloned() else { return Ok(Vec::new()) };
        let read = |value| {
            FindSpec::deserialize(value).map_err(|error: toml::de::Error| plain_message(error.message()))
        };
        match found {
            Value::Array(all) => all.into_iter().map(read).collect(),
            one => read(one).map(|one| vec![one]),
        }
    }

    /// The dotted keys with what stands at them, in file order.
    pub fn keys(&self) -> Vec<(String, Value)> {
        let mut keys = Vec::new();
        for (name, value) in self.0.iter().filter(|(name, _)| *name != COMBINE && *name != FIND) {
            flatten(name.clone(), value, &mut keys);
        }
        keys
    }
}

/// A key without quotes makes a table of each of its parts.
fn flatten(path: String, value: &Value, keys: &mut Vec<(String, Value)>) {
    match value {
        Value::Table(table) if !super::values::is_range(table) => {
            for (name, value) in table {
                flatten(format!("{path}.{name}"), value, keys);
            }
        }
        other => keys.push((path, other.clone())),
    }
}
