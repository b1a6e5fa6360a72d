//! The spec of the page, which is JSON, as TOML and as Python; and the other way around.

use serde_json::Value;

use crate::engine::Refused;

pub fn toml_of(spec: &Value) -> Result<String, Refused> {
    if !spec.is_object() {
        return Err(Refused::new("found no spec; allowed: a table of keys"));
    }
    let table: toml::Table =
        toml::Table::try_from(without_empty(spec)).map_err(|error| Refused::new(error.to_string()))?;
    toml::to_string(&table).map_err(|error| Refused::new(error.to_string()))
}

/// The same without keys that have no value: a field that was emptied.
fn without_empty(value: &Value) -> Value {
    match value {
        Value::Object(fields) => {
            let kept = fields.iter().filter(|(_, value)| !value.is_null());
            Value::Object(kept.map(|(key, value)| (key.clone(), without_empty(value))).collect())
        }
        other => other.clone(),
    }
}

pub fn json_of(text: &str) -> Result<Value, Refused> {
    let table: toml::Table =
        text.parse().map_err(|error: toml::de::Error| Refused::new(error.to_string()))?;
    json(toml::Value::Table(table), "")
}

fn json(value: toml::Value, key: &str) -> Result<Value, Refused> {
    /// Whole numbers up to here are numbers of a page.
    const LARGEST: u64 = 1 << 53;
    let refuse = |found: String, allowed: &str| Refused {
        key: Some(key.to_owned()),
        message: format!("found {found}; allowed in the workbench: {allowed}"),
    };
    Ok(match value {
        toml::Value::String(text) => text.into(),
        toml::Value::Integer(number) if number.unsigned_abs() > LARGEST => {
            return Err(refuse(number.to_string(), "a whole number up to 9007199254740992"));
        }
        toml::Value::Integer(number) => number.into(),
        toml::Value::Float(number) if number.is_finite() => number.into(),
        toml::Value::Float(number) => {
            return Err(refuse(number.to_string(), "a finite number, or \"inf\" in quotes"));
        }
        toml::Value::Boolean(flag) => flag.into(),
        toml::Value::Datetime(time) => {
            return Err(refuse(time.to_string(), "texts, numbers, true, false, lists, tables"));
        }
        toml::Value::Array(items) => {
            items.into_iter().map(|item| json(item, key)).collect::<Result<Vec<_>, _>>()?.into()
        }
        toml::Value::Table(table) => {
            let below = |name: &str| if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") };
            let fields = table.into_iter().map(|(name, item)| Ok((name.clone(), json(item, &below(&name))?)));
            Value::Object(fields.collect::<Result<_, Refused>>()?)
        }
    })
}

/// A program in Python that runs the spec in `folder`.
pub fn python_of(spec: &Value, folder: &str) -> String {
    let mut literal = String::new();
    write_python(&without_empty(spec), 0, &mut literal);
    format!(
        "# Paths in the spec are relative to {}.\nimport asperity\n\nspec = {literal}\nresults = asperity.run(spec)\n\
         print(results.summary[\"answer\"])\n",
        // A name of a folder may hold the end of a line.
        quoted(folder)
    )
}

fn write_python(value: &Value, depth: usize, text: &mut String) {
    let indent = |depth: usize| "    ".repeat(depth);
    match value {
        Value::Null => text.push_str("None"),
        Value::Bool(flag) => text.push_str(if *flag { "True" } else { "False" }),
        Value::Object(fields) if fields.is_empty() => text.push_str("{}"),
        Value::Object(fields) => {
            text.push_str("{\n");
            for (key, value) in fields {
                text.push_str(&format!("{}{}: ", indent(depth + 1), quoted(key)));
                write_python(value, depth + 1, text);
                text.push_str(",\n");
            }
            text.push_str(&format!("{}}}", indent(depth)));
        }
        Value::Array(items) => {
            text.push('[');
            for (place, item) in items.iter().enumerate() {
                if place > 0 {
                    text.push_str(", ");
                }
                write_python(item, depth + 1, text);
            }
            text.push(']');
        }
        Value::String(words) => text.push_str(&quoted(words)),
        Value::Number(number) => text.push_str(&number.to_string()),
    }
}

/// A text as a literal: those of JSON are those of Python.
fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_a_page_would_change_are_refused_with_their_key() {
        assert_eq!(json_of("[a]\nseed = 9007199254740993").unwrap_err().key.as_deref(), Some("a.seed"));
    }
}
