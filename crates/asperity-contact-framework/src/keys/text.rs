//! Keys for a person: an explanation in a terminal, and one page of all of them.

use std::fmt::Write;

use super::{Default, Key};

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

/// All keys in Markdown, a section for each table.
pub fn markdown(keys: &[Key]) -> String {
    let mut tables: Vec<&[String]> = Vec::new();
    for key in keys {
        let table = above(key);
        if !tables.contains(&table) {
            tables.push(table);
        }
    }
    let section = |table: &&[String]| {
        let rows: String = keys.iter().filter(|key| above(key) == *table).map(row).collect();
        heading(keys, table) + &rows
    };
    tables.iter().map(section).collect()
}

/// The table that a key stands in.
fn above(key: &Key) -> &[String] {
    &key.path[..key.path.len() - 1]
}

/// The heading of a table, with its meaning and the head of its rows.
fn heading(keys: &[Key], table: &[String]) -> String {
    let meaning = keys.iter().find(|key| key.path == *table).map(|key| {
        let example = key.examples.first().map(|example| format!(" Example: `{}`.", key.line(example)));
        format!("{}{}\n\n", key.meaning, example.unwrap_or_default())
    });
    let name = if table.is_empty() { "Every spec".to_owned() } else { format!("`[{}]`", table.join(".")) };
    format!(
        "\n## {name}\n\n{}| key | meaning | type | units | range | default | example |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        meaning.unwrap_or_default()
    )
}

fn row(key: &Key) -> String {
    let code = |text: &str| format!("`{text}`");
    let default = match &key.default {
        Default::Needed => "needed".to_owned(),
        Default::Words(default) => default.clone(),
        Default::Is(default) => code(default),
        Default::Open => String::new(),
    };
    let mut meaning = key.meaning.clone();
    for (value, of_value) in &key.values {
        let _ = write!(meaning, " `{value}`: {of_value}");
    }
    // The bare number is explained once, at the head of the page.
    let units = key.unit.as_deref().and_then(|unit| unit.split(';').next()).unwrap_or_default();
    let cells = [
        code(key.path.last().map_or("", String::as_str)),
        meaning,
        key.kind.clone(),
        units.to_owned(),
        key.range.clone().unwrap_or_default(),
        default,
        key.examples.iter().map(|example| code(example)).collect::<Vec<_>>().join(", "),
    ];
    format!("| {} |\n", cells.map(|cell| cell.replace('|', "\\|")).join(" | "))
}
