//! `[sweep]` as it stands in a spec, and the values of its keys.

use asperity::compare::ComparedQuantity;
use asperity::units::Dimension;
use asperity_contact_framework::input::bare::NominalPressureRange;
use asperity_contact_framework::input::quantity::{Pressure, Quantity};
use asperity_contact_framework::input::{plain_message, schema};
use asperity_contact_framework::report::format::{input_number, input_quantity};
use asperity_contact_framework::report::table::{Heading, Value as Cell};
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
        Value::Table(table) if !(table.contains_key("from") && table.contains_key("to")) => {
            for (name, value) in table {
                flatten(format!("{path}.{name}"), value, keys);
            }
        }
        other => keys.push((path, other.clone())),
    }
}

/// The most values of a key, and the most variations.
pub const MOST: usize = 10_000;

#[derive(Debug, Clone)]
pub struct SweptKey {
    pub name: String,
    /// As they stand in a spec, in their order.
    pub values: Vec<Value>,
    /// The same in SI; `None` where one of them is no quantity.
    pub numbers: Option<Vec<f64>>,
    /// Their dimension; `None` of pure numbers, and of what is no quantity.
    pub dimension: Option<Dimension>,
}

impl SweptKey {
    /// A key with what stands at it.
    pub fn new(name: String, found: &Value) -> Result<Self, String> {
        const ALLOWED: &str = "a list of values such as [\"2 GPa\", \"4 GPa\"], or { from, to, points }";
        let values = match found {
            Value::Array(values) if values.is_empty() => {
                return Err(format!("found an empty list; allowed: {ALLOWED}"));
            }
            Value::Array(values) if values.len() > MOST => {
                return Err(format!("found {} values; allowed: at most {MOST}", values.len()));
            }
            Value::Array(values) => values.clone(),
            Value::Table(table) => range(table)?,
            other => return Err(format!("found {other}; allowed: {ALLOWED}")),
        };
        let (numbers, dimension) = match quantities(&values) {
            Some((numbers, dimension)) => (Some(numbers), dimension),
            None => (None, None),
        };
        Ok(Self { name, values, numbers, dimension })
    }

    pub fn heading(&self) -> Heading {
        let unit = match (&self.numbers, self.dimension) {
            (None, _) => "text",
            (Some(_), Some(dimension)) => dimension.si_unit(),
            (Some(_), None) => "1",
        };
        Heading::of_key(&self.name, unit)
    }

    /// The cell of a value in that column.
    pub fn cell(&self, place: usize) -> Cell {
        match &self.numbers {
            Some(numbers) => Cell::Number(numbers[place]),
            None => Cell::Text(as_text(&self.values[place])),
        }
    }

    pub fn words(&self, place: usize) -> String {
        self.numbers
            .as_ref()
            .map_or_else(|| as_text(&self.values[place]), |numbers| self.in_words(numbers[place]))
    }

    /// A number in SI for people.
    pub fn in_words(&self, number: f64) -> String {
        match self.dimension {
            Some(_) if number.is_infinite() => "inf".to_owned(),
            Some(dimension) => input_quantity(number, dimension.si_unit()),
            None => input_number(number),
        }
    }

    /// A number in SI as a spec has it.
    pub fn written(&self, number: f64) -> Value {
        match self.dimension {
            Some(dimension) => Value::String(format!("{number:e} {}", dimension.si_unit())),
            None => Value::Float(number),
        }
    }

    /// A value of this key, which need not be among its values, in SI.
    pub fn number_of(&self, value: &Value) -> Option<f64> {
        number(value, self.dimension)
    }
}

/// A value as a spec has it, a text without its quotes.
pub fn as_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// The values in SI with their one dimension, where all are quantities of it or pure numbers.
fn quantities(values: &[Value]) -> Option<(Vec<f64>, Option<Dimension>)> {
    let all = |dimension| values.iter().map(|value| number(value, dimension)).collect::<Option<Vec<f64>>>();
    if let Some(numbers) = all(None) {
        return Some((numbers, None));
    }
    // "inf" has no unit that would tell which.
    let states = |value: &Value, dimension: Dimension| {
        value.as_str().is_some_and(|text| dimension.parse(text).is_some())
    };
    let mut stated = Dimension::ALL.into_iter().filter(|one| values.iter().any(|value| states(value, *one)));
    stated.find_map(|dimension| Some((all(Some(dimension))?, Some(dimension))))
}

fn number(value: &Value, dimension: Option<Dimension>) -> Option<f64> {
    match value {
        Value::Integer(number) => Some(*number as f64),
        Value::Float(number) => Some(*number),
        Value::String(text) if text == "inf" => dimension.map(|_| f64::INFINITY),
        Value::String(text) => dimension?.parse(text),
        _ => None,
    }
}

/// The values of a range, by equal ratios; its ends are as they stand.
fn range(table: &Table) -> Result<Vec<Value>, String> {
    const ALLOWED: &str =
        "{ from, to, points } with two positive quantities of one unit and 2 points or more";
    let refused = || format!("found {}; allowed: {ALLOWED}", Value::Table(table.clone()));
    let [from, to, points] = ["from", "to", "points"].map(|name| table.get(name));
    let (Some(from), Some(to), Some(points), 3) = (from, to, points, table.len()) else {
        return Err(refused());
    };
    let points = points.as_integer().and_then(|points| usize::try_from(points).ok());
    let points = points.filter(|points| (2..=MOST).contains(points)).ok_or_else(refused)?;
    let ends = [from.clone(), to.clone()];
    let (numbers, dimension) = quantities(&ends).ok_or_else(refused)?;
    if !numbers.iter().all(|number| *number > 0.0 && number.is_finite()) {
        return Err(refused());
    }
    let key = SweptKey { name: String::new(), values: Vec::new(), numbers: None, dimension };
    let between = |k: usize| {
        let fraction = k as f64 / (points - 1) as f64;
        key.written(numbers[0] * (numbers[1] / numbers[0]).powf(fraction))
    };
    Ok((0..points)
        .map(|k| match k {
            0 => ends[0].clone(),
            k if k == points - 1 => ends[1].clone(),
            k => between(k),
        })
        .collect())
}

/// Sets the value at a dotted path.
pub fn set(spec: &mut Table, path: &str, value: Value) -> Result<(), String> {
    let (tables, last) = path.rsplit_once('.').map_or((None, path), |(tables, last)| (Some(tables), last));
    let mut table = spec;
    let mut above = String::new();
    for name in tables.into_iter().flat_map(|tables| tables.split('.')) {
        above = if above.is_empty() { name.to_owned() } else { format!("{above}.{name}") };
        let inner = table.entry(name).or_insert_with(|| Value::Table(Table::new()));
        table = inner.as_table_mut().ok_or_else(|| {
            format!("found a path through `{above}`, which is no table of the spec; allowed: a key of the spec, such as compare.law")
        })?;
    }
    table.insert(last.to_owned(), value);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(text: &str) -> SweptKey {
        let table: Table = format!("v = {text}").parse().unwrap();
        SweptKey::new("compare.x".to_owned(), &table["v"]).unwrap()
    }

    #[test]
    fn quantities_of_one_dimension_are_numbers() {
        let of = |text| key(text).numbers;
        assert_eq!(of("[\"2 GPa\", 4e9]"), Some(vec![2e9, 4e9]));
        assert_eq!(of("[0, \"5 nm\", \"inf\"]"), Some(vec![0.0, 5e-9, f64::INFINITY]));
        assert_eq!(of("[1, 2.5]"), Some(vec![1.0, 2.5]));
        for text in ["[\"2 GPa\", \"1 nm\"]", "[\"zmc\", \"hertz\"]", "[true]", "[\"inf\", 1]"] {
            assert_eq!(of(text), None, "{text}");
        }
    }

    #[test]
    fn numbers_are_written_as_they_are_read() {
        let lengths = key("[\"1 nm\", \"3 um\"]");
        for number in [8.3e-8, 0.1 + 0.2, 1.0 / 3.0] {
            assert_eq!(lengths.number_of(&lengths.written(number)), Some(number));
        }
    }
}
