//! `law = "zmc"`, `law.zmc = { transition-ratio = 110 }`, or a list of these: names and options of the registry.

use std::fmt;

use asperity::ContactLaw;
use asperity::contact_law::{named, registry};
use asperity::law::{LawOption, OptionError};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde_json::{Map, Value, json};

use crate::input::OneOrMany;
use crate::input::quantity::{Finite, Pure, Quantity};
use crate::input::schema::{self, RANGE, TYPE};

/// One law, or a list of distinct laws.
#[derive(Debug, Clone, PartialEq)]
pub struct Laws(pub Vec<ContactLaw>);

#[derive(Debug, Clone, PartialEq)]
pub struct OneLaw(pub ContactLaw);

/// The names of all laws, for an error.
fn allowed() -> String {
    let names: Vec<String> = registry().iter().map(|law| format!("\"{}\"", law.name())).collect();
    names.join(", ")
}

/// The law that another name stands for, as an error says it; empty for other names.
fn synonym(name: &str) -> String {
    const GW: &str = " With it the statistical model is that of Greenwood and Williamson";
    const SYNONYMS: [(&[&str], &str, &str); 7] = [
        (&["greenwood-williamson", "gw"], "hertz", GW),
        (&["hertzian", "elastic"], "hertz", ""),
        (&["zhao-maietta-chang"], "zmc", ""),
        (&["chang-etsion-bogy"], "ceb", ""),
        (&["ke"], "kogut-etsion", ""),
        (&["jg"], "jackson-green", ""),
        (&["abbott-firestone", "plastic"], "fully-plastic", ""),
    ];
    let plain = name.to_lowercase().replace(['_', ' '], "-");
    let is_meant =
        |(names, law, _): &&(&[&str], &str, &str)| names.contains(&plain.as_str()) || plain == *law;
    let found = SYNONYMS.iter().find(is_meant);
    found.map_or_else(String::new, |(_, law, remark)| format!("; did you mean \"{law}\"?{remark}"))
}

/// The error of a law that is not registered.
fn unknown(name: &str) -> String {
    format!("found \"{name}\"; allowed: {}{}", allowed(), synonym(name))
}

/// The last of some options as a table that sets it, `{ transition-ratio = 110 }`.
fn example(options: &[LawOption]) -> Option<String> {
    options.last().map(|option| format!("{{ {} = {} }}", option.name, option.example))
}

/// Which laws have options: "onset and transition-ratio are options of zmc and elliptic-zmc".
fn laws_with_options() -> String {
    let mut groups: Vec<(&[LawOption], Vec<String>)> = Vec::new();
    for law in registry().iter().filter(|law| !law.law().options().is_empty()) {
        let options = law.law().options();
        match groups.iter_mut().find(|(of_group, _)| *of_group == options) {
            Some((_, laws)) => laws.push(law.name()),
            None => groups.push((options, vec![law.name()])),
        }
    }
    let words = groups.iter().map(|(options, laws)| {
        let names: Vec<&str> = options.iter().map(|option| option.name).collect();
        let are = if names.len() == 1 { "is an option" } else { "are options" };
        format!("{} {are} of {}", names.join(" and "), laws.join(" and "))
    });
    words.collect::<Vec<String>>().join("; ")
}

fn refused<E: Error>(error: OptionError) -> E {
    match error {
        OptionError::NoOptions { .. } => E::custom(format!("found {error} ({})", laws_with_options())),
        _ => E::custom(format!("found {error}")),
    }
}

struct Options(ContactLaw);

impl<'de> DeserializeSeed<'de> for Options {
    type Value = ContactLaw;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<ContactLaw, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Options {
    type Value = ContactLaw;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match example(self.0.law().options()) {
            Some(example) => write!(f, "a table of options, such as {example}"),
            None => f.write_str("an empty table {}: this law has no options"),
        }
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<ContactLaw, A::Error> {
        let mut law = self.0;
        let mut given = Vec::new();
        while let Some(name) = map.next_key::<String>()? {
            law.option(&name).map_err(refused)?;
            given.push((name, map.next_value::<Quantity<Pure, Finite>>()?.value()));
        }
        for (name, value) in &given {
            law = law.with_options(&[(name, *value)]).map_err(refused)?;
        }
        Ok(law)
    }
}

/// The schema of one law: its name, or a table with its name as the only key.
fn one_law() -> Value {
    let names: Vec<String> = registry().iter().map(ContactLaw::name).collect();
    let tables = registry().iter().map(|law| {
        let option = |option: &LawOption| {
            let schema = json!({
                "type": "number",
                "description": format!("{}.", option.about),
                TYPE: "number",
                RANGE: option.allowed,
                "default": option.default,
                "examples": [option.example],
            });
            (option.name.to_owned(), schema)
        };
        let options: Map<String, Value> = law.law().options().iter().map(option).collect();
        let table = json!({
            "type": "object", "description": law.about(), "properties": options, "additionalProperties": false,
        });
        json!({
            "type": "object", "properties": { law.name(): table }, "required": [law.name()], "additionalProperties": false,
        })
    });
    let alternatives: Vec<Value> =
        std::iter::once(schema::names(names.iter().map(String::as_str))).chain(tables).collect();
    json!({ "anyOf": alternatives, TYPE: format!("{}, or a table of one law with its options", allowed()) })
}

crate::written_schema!(Laws, |_| {
    let mut laws = schema::one_or_many(one_law(), "law, or a list of laws: a name, or a table with options");
    laws["examples"] = json!(["zmc", ["hertz", { "zmc": { "transition-ratio": 110 } }]]);
    laws
});

crate::written_schema!(OneLaw, |_| one_law());

impl<'de> Deserialize<'de> for OneLaw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NameOrTable;

        impl<'de> Visitor<'de> for NameOrTable {
            type Value = OneLaw;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "a law ({}), or a table of one law with its options", allowed())?;
                let with_options =
                    registry().iter().find_map(|law| Some((law, example(law.law().options())?)));
                with_options
                    .map_or(Ok(()), |(law, example)| write!(f, ", such as {{ {} = {example} }}", law.name()))
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<OneLaw, E> {
                let law = named(name);
                law.map(OneLaw).ok_or_else(|| E::custom(unknown(name)))
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<OneLaw, A::Error> {
                const ALLOWED: &str =
                    "allowed: one law per table; several laws as a list, each in a table or in quotes";
                let Some(name) = map.next_key::<String>()? else {
                    return Err(A::Error::custom(format!("found an empty table; {ALLOWED}")));
                };
                let law = named(&name).ok_or_else(|| A::Error::custom(unknown(&name)))?;
                let law = map.next_value_seed(Options(law))?;
                match map.next_key::<String>()? {
                    Some(second) => Err(A::Error::custom(format!(
                        "found two laws in one table, \"{name}\" and \"{second}\"; {ALLOWED}"
                    ))),
                    None => Ok(OneLaw(law)),
                }
            }
        }
        deserializer.deserialize_any(NameOrTable)
    }
}

impl<'de> Deserialize<'de> for Laws {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected =
            format!("a law ({}, or a table of one law with its options) or a list of laws", allowed());
        let mut laws = Vec::new();
        for OneLaw(law) in OneOrMany::read(deserializer, &expected)?.at_least_one("law")? {
            if laws.contains(&law) {
                let message = format!("found {} twice; allowed: each law once", law.label());
                return Err(D::Error::custom(message));
            }
            laws.push(law);
        }
        Ok(Self(laws))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_models_point_to_laws_that_are_registered() {
        for (name, law) in [
            ("greenwood-williamson", "hertz"),
            ("GW", "hertz"),
            ("Zhao Maietta Chang", "zmc"),
            ("Hertz", "hertz"),
            ("chang-etsion-bogy", "ceb"),
            ("ke", "kogut-etsion"),
            ("jg", "jackson-green"),
            ("abbott-firestone", "fully-plastic"),
        ] {
            assert!(named(law).is_some(), "{law}");
            assert!(unknown(name).contains(&format!("did you mean \"{law}\"?")), "{}", unknown(name));
        }
        assert!(unknown("gw").contains("Greenwood and Williamson"));
        assert!(!unknown("coulomb").contains("did you mean"), "{}", unknown("coulomb"));
    }
}
