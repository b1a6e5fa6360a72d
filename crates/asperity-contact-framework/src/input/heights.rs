//! `heights = "gaussian"`, or `heights.weibull = { shape = 2 }`: a distribution of the library's registry.

use std::fmt;

use asperity::Heights;
use asperity::distribution::{Entry, REGISTRY};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde_json::{Map, Value, json};

use super::Forms;
use super::quantity::{Finite, Pure, Quantity};
use super::schema::{self, TYPE};

#[derive(Debug, Clone, PartialEq)]
pub struct HeightsSpec(pub Heights);

impl HeightsSpec {
    /// The distribution without parameters called `name`.
    pub fn named(name: &str, also: &[&str]) -> Result<Self, String> {
        let entry = REGISTRY.iter().find(|entry| entry.name == name && entry.parameters.is_empty());
        let heights = entry.and_then(|entry| entry.example().ok());
        heights.map(Self).ok_or_else(|| format!("found \"{name}\"; allowed: {}", Self::allowed(also)))
    }

    pub fn allowed(also: &[&str]) -> String {
        let forms = REGISTRY.iter().map(|entry| match entry.parameters {
            [] => format!("\"{}\"", entry.name),
            parameters => table(entry.name, parameters),
        });
        forms.chain(also.iter().map(|name| format!("\"{name}\""))).collect::<Vec<_>>().join(", ")
    }
}

/// Heights as a spec writes them: a name, or a table of its parameters.
pub fn written(heights: &Heights) -> String {
    let parameters = heights.parameters();
    if parameters.is_empty() { heights.name().to_owned() } else { table(heights.name(), &parameters) }
}

/// The schema of a distribution, or one of the `also` names.
pub fn schema(also: &[&str]) -> Value {
    let names = REGISTRY.iter().filter(|entry| entry.parameters.is_empty()).map(|entry| entry.name);
    let tables = REGISTRY.iter().map(|entry| {
        let properties: Map<String, Value> = entry
            .parameters
            .iter()
            .map(|(name, value)| {
                ((*name).to_owned(), json!({ "type": "number", TYPE: "number", "examples": [value] }))
            })
            .collect();
        let required: Vec<&String> = properties.keys().collect();
        let parameters = json!({
            "type": "object", "properties": properties, "required": required, "additionalProperties": false,
        });
        json!({
            "type": "object", "properties": { entry.name: parameters }, "required": [entry.name], "additionalProperties": false,
        })
    });
    let alternatives: Vec<Value> =
        std::iter::once(schema::names(names.chain(also.iter().copied()))).chain(tables).collect();
    json!({ "anyOf": alternatives, TYPE: HeightsSpec::allowed(also), "examples": ["gaussian"] })
}

crate::written_schema!(HeightsSpec, |_| schema(&[]));

fn table(name: &str, parameters: &[(&str, f64)]) -> String {
    let values: Vec<String> = parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    format!("{{ {name} = {{ {} }} }}", values.join(", "))
}

impl<'de> Deserialize<'de> for HeightsSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;

        impl<'de> Visitor<'de> for NameOrTable {
            type Value = HeightsSpec;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(&HeightsSpec::allowed(&[]))
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<HeightsSpec, E> {
                HeightsSpec::named(name, &[]).map_err(E::custom)
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<HeightsSpec, A::Error> {
                let refuse = |what: String| {
                    A::Error::custom(format!("{what}; allowed: {}", HeightsSpec::allowed(&[])))
                };
                let Some(name) = map.next_key::<String>()? else {
                    return Err(refuse("found an empty table".to_owned()));
                };
                let Some(entry) = REGISTRY.iter().find(|entry| entry.name == name) else {
                    return Err(refuse(format!("found the distribution \"{name}\"")));
                };
                let values = map.next_value_seed(Parameters(entry))?;
                if let Some(second) = map.next_key::<String>()? {
                    return Err(refuse(format!("found two distributions, \"{name}\" and \"{second}\"")));
                }
                (entry.make)(&values)
                    .map(HeightsSpec)
                    .map_err(|error| A::Error::custom(format!("found {error}")))
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

/// Reads a name of `others` as its value, and a distribution as what `otherwise` makes of it.
pub fn read_or<'de, T: Clone, D: Deserializer<'de>>(
    deserializer: D,
    others: &[(&str, T)],
    otherwise: fn(Heights) -> T,
) -> Result<T, D::Error> {
    let names: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
    Forms::new(&HeightsSpec::allowed(&names))
        .text(|text| match others.iter().find(|(name, _)| *name == text) {
            Some((_, value)) => Ok(value.clone()),
            None => HeightsSpec::named(text, &names).map(|heights| otherwise(heights.0)),
        })
        .table(|heights: HeightsSpec| Ok(otherwise(heights.0)))
        .read(deserializer)
}

/// The values of the parameters of a family, in its order.
struct Parameters(&'static Entry);

impl Parameters {
    fn names(&self) -> String {
        self.0.parameters.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
    }
}

impl<'de> DeserializeSeed<'de> for Parameters {
    type Value = Vec<f64>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<f64>, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Parameters {
    type Value = Vec<f64>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.0.parameters {
            [] => f.write_str("an empty table {}: these heights have no parameters"),
            _ => write!(f, "a table {{ {} }}", self.names()),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Vec<f64>, A::Error> {
        let mut values = vec![None; self.0.parameters.len()];
        while let Some(key) = map.next_key::<String>()? {
            let place = self.0.parameters.iter().position(|(name, _)| *name == key).ok_or_else(|| {
                let names = if values.is_empty() { "none".to_owned() } else { self.names() };
                A::Error::custom(format!("found the parameter `{key}` of {}; allowed: {names}", self.0.name))
            })?;
            values[place] = Some(map.next_value::<Quantity<Pure, Finite>>()?.value());
        }
        let named = values.into_iter().zip(self.0.parameters);
        let needed = |(value, (name, _)): (Option<f64>, &(&str, f64))| {
            value.ok_or_else(|| A::Error::custom(format!("found no `{name}`, which {} needs", self.0.name)))
        };
        named.map(needed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(words: &str) -> Result<Heights, String> {
        #[derive(Deserialize)]
        struct Words {
            heights: HeightsSpec,
        }
        let words: Result<Words, _> = toml::from_str(&format!("heights = {words}"));
        words.map(|words| words.heights.0).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn every_distribution_is_read_by_its_name_and_parameters() {
        for entry in REGISTRY {
            let heights = entry.example().unwrap();
            let words = if entry.parameters.is_empty() {
                format!("{{ {} = {{}} }}", entry.name)
            } else {
                written(&heights)
            };
            assert_eq!(of(&words), Ok(heights));
            let alone = of(&format!("\"{}\"", entry.name));
            assert_eq!(alone.is_ok(), entry.parameters.is_empty(), "{alone:?}");
        }
        assert_ne!(of("{ weibull = { shape = 3 } }"), of("{ weibull = { shape = 2 } }"));
    }

    /// Others stand among the bad specs.
    #[test]
    fn errors_say_what_was_found() {
        for (words, found, allowed) in [
            (
                "{ cauchy = {} }",
                "found the distribution \"cauchy\"",
                "{ johnson = { skewness = -1, kurtosis = 4.5 } }",
            ),
            ("{}", "found an empty table", "allowed: \"gaussian\""),
            ("{ gaussian = {}, exponential = {} }", "found two distributions", "allowed: \"gaussian\""),
            ("{ gaussian = { mean = 2 } }", "found the parameter `mean` of gaussian", "allowed: none"),
            ("{ johnson = { skewness = 1 } }", "found no `kurtosis`", "which johnson needs"),
            ("{ weibull = { shape = 0.4 } }", "found Weibull shape 0.4", "allowed: 0.5 to 20"),
        ] {
            let error = of(words).unwrap_err();
            assert!(error.contains(found) && error.contains(allowed), "{words}: {error}");
        }
    }
}
