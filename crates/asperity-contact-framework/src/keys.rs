//! The keys of a spec as documentation lists them, read from its JSON schema.

use std::fmt::Write;

use serde_json::{Map, Value};

use crate::input::schema::{DEFAULT, RANGE, TYPE, UNIT};

/// What a name chosen by the user stands as.
const NAME: &str = "NAME";

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Key {
    /// The names from the top, as in `surface.NAME.file.pixel`.
    pub path: Vec<String>,
    pub meaning: String,
    /// What kind of value it takes.
    pub kind: String,
    pub unit: Option<String>,
    /// The values allowed, if its kind does not say so.
    pub range: Option<String>,
    /// What holds where it is left out.
    pub default: Default,
    /// Values as TOML.
    pub examples: Vec<String>,
    /// Its named values, each with its meaning.
    pub values: Vec<(String, String)>,
    /// Whether it is a table of keys that are listed themselves.
    pub is_table: bool,
}

/// What holds where a key is left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Default {
    /// It may not be left out of its table.
    Needed,
    /// This value, as TOML.
    Is(String),
    Words(String),
    /// Nothing is to be said of it.
    Open,
}

impl Key {
    pub fn name(&self) -> String {
        self.path.join(".")
    }

    /// An example as a line of a spec.
    pub fn line(&self, example: &str) -> String {
        let key = self.path.last().map_or("", String::as_str);
        format!("{key} = {example}")
    }
}

/// All keys of a schema, each table before its keys.
pub fn keys(schema: &Value) -> Vec<Key> {
    let mut keys = Vec::new();
    walk(schema, &mut Vec::new(), &mut keys);
    keys
}

/// The keys that `wanted` names by the whole path, or, where there is none, by its end.
pub fn find<'a>(keys: &'a [Key], wanted: &str) -> Vec<&'a Key> {
    let trimmed = wanted.trim_matches(['[', ']']);
    let words: Vec<&str> = trimmed.split('.').collect();
    let whole: Vec<&Key> = keys.iter().filter(|key| matches(&key.path, &words)).collect();
    if !whole.is_empty() {
        return whole;
    }
    keys.iter()
        .filter(|key| {
            key.path.len() >= words.len() && matches(&key.path[key.path.len() - words.len()..], &words)
        })
        .collect()
}

/// Whether a path is `words`, any of which may stand for a name that the user chooses.
fn matches(path: &[String], words: &[&str]) -> bool {
    path.len() == words.len()
        && path.iter().zip(words).all(|(of_path, word)| of_path == word || of_path == NAME)
}

/// The `words` that resemble `wanted`, the most similar first.
pub fn similar<'a>(words: impl Iterator<Item = &'a str>, wanted: &str) -> Vec<&'a str> {
    /// Of 1 for the same word.
    const ALIKE: f64 = 0.75;
    let mut found: Vec<(f64, &str)> = words
        .map(|word| (strsim::jaro_winkler(word, wanted), word))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    found.dedup_by_key(|(_, word)| *word);
    found.into_iter().take(5).map(|(_, word)| word).collect()
}

/// A key in a terminal; of a table also the `below` that stand in it.
pub fn explanation(key: &Key, below: &[&Key]) -> String {
    let mut text = format!("{}\n  {}\n", key.name(), key.meaning);
    let mut row = |name: &str, value: &str| {
        let _ = writeln!(text, "  {:<9}{value}", format!("{name}:"));
    };
    row("type", &key.kind);
    for (name, value) in [("unit", &key.unit), ("range", &key.range)] {
        if let Some(value) = value {
            row(name, value);
        }
    }
    match &key.default {
        Default::Needed => row("default", "none; it is needed"),
        Default::Is(default) | Default::Words(default) => row("default", default),
        Default::Open => {}
    }
    for example in &key.examples {
        row("example", &key.line(example));
    }
    for (value, meaning) in &key.values {
        row("value", &format!("{value}: {meaning}"));
    }
    if !below.is_empty() {
        let names: Vec<&str> = below.iter().filter_map(|key| key.path.last()).map(String::as_str).collect();
        row("keys", &names.join(", "));
    }
    text
}

fn walk(schema: &Value, path: &mut Vec<String>, keys: &mut Vec<Key>) {
    let needed: Vec<&str> =
        schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    for (name, of_key) in schema["properties"].as_object().into_iter().flatten() {
        path.push(name.clone());
        keys.push(key(of_key, path, needed.contains(&name.as_str())));
        if is_table(of_key) {
            walk(of_key, path, keys);
        }
        path.pop();
    }
    if let Some(of_name) = schema.get("additionalProperties").filter(|of_name| of_name.is_object()) {
        path.push(NAME.to_owned());
        walk(of_name, path, keys);
        path.pop();
    }
    for alternative in alternatives(schema).filter(|one| one.get("properties").is_some()) {
        walk(alternative, path, keys);
    }
}

fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    ["anyOf", "oneOf"].into_iter().filter_map(|key| schema[key].as_array()).flatten()
}

/// Whether its keys are to be listed: what has a kind in words says all in them.
fn is_table(schema: &Value) -> bool {
    schema.get(TYPE).is_none()
        && (schema.get("properties").is_some()
            || schema["additionalProperties"].is_object()
            || alternatives(schema).any(|one| one.get("properties").is_some()))
}

fn key(schema: &Value, path: &[String], is_needed: bool) -> Key {
    let text = |key: &str| schema.get(key).and_then(Value::as_str).map(str::to_owned);
    let default = match schema.get("default") {
        _ if is_needed => Default::Needed,
        None => text(DEFAULT).map_or(Default::Open, Default::Words),
        Some(Value::Object(fields)) if fields.is_empty() => Default::Open,
        Some(Value::String(text)) if text.is_empty() => Default::Open,
        Some(default) => Default::Is(toml(default)),
    };
    Key {
        path: path.to_vec(),
        meaning: sentence(schema),
        kind: kind(schema),
        unit: text(UNIT),
        range: text(RANGE),
        default,
        examples: schema["examples"].as_array().into_iter().flatten().map(toml).collect(),
        values: alternatives(schema)
            .filter_map(|one| Some((toml(one.get("const")?), sentence(one))))
            .collect(),
        is_table: is_table(schema),
    }
}

/// The description in one line, without the links of source documentation.
fn sentence(schema: &Value) -> String {
    let text = schema["description"].as_str().unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace("[`", "`").replace("`]", "`")
}

fn kind(schema: &Value) -> String {
    if let Some(words) = schema.get(TYPE).and_then(Value::as_str) {
        return words.to_owned();
    }
    if is_table(schema) {
        let is_named = schema["additionalProperties"].is_object();
        return if is_named { "tables by name" } else { "table" }.to_owned();
    }
    let names: Vec<String> = alternatives(schema).filter_map(|one| one.get("const").map(toml)).collect();
    if !names.is_empty() {
        return names.join(", ");
    }
    if let Some(names) = schema["enum"].as_array() {
        return names.iter().map(toml).collect::<Vec<_>>().join(", ");
    }
    match schema["type"].as_str() {
        Some("array") => format!("list of: {}", kind(&schema["items"])),
        Some("boolean") => "true, false".to_owned(),
        Some("string") => "text".to_owned(),
        Some(other) => other.to_owned(),
        None => "any".to_owned(),
    }
}

/// A value as TOML writes it in a line.
fn toml(value: &Value) -> String {
    let listed = |values: &[Value]| values.iter().map(toml).collect::<Vec<_>>().join(", ");
    let fields = |fields: &Map<String, Value>| {
        fields.iter().map(|(key, value)| format!("{key} = {}", toml(value))).collect::<Vec<_>>().join(", ")
    };
    match value {
        Value::Array(values) => format!("[{}]", listed(values)),
        Value::Object(map) if map.is_empty() => "{}".to_owned(),
        Value::Object(map) => format!("{{ {} }}", fields(map)),
        // A whole number needs no decimals.
        Value::Number(number) => match number.as_f64() {
            Some(value) if value.fract() == 0.0 && value.abs() < 1e15 => format!("{value:.0}"),
            _ => number.to_string(),
        },
        other => other.to_string(),
    }
}
