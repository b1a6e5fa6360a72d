//! What a message advises its user to change, in the form of the front end in which the message is read.
//!
//! Messages name keys of a spec between backticks, alone or with a value: `` `unit` ``, `` `unit = "um"` ``. [`FrontEnd::text`]
//! makes flags, arguments or controls of those that [`REMEDIES`] lists.

use toml::{Table, Value};

/// A key of a spec that messages advise.
#[derive(Debug, Clone, Copy)]
pub struct Remedy {
    /// Its table in a spec: `file` of `[surface.NAME.file]`, `compare`, `material`, `asperities`.
    pub table: &'static str,
    /// The key; of a table of keys with a point, as in `filter.s`.
    pub key: &'static str,
    /// The flag of the command line; without one `--set TABLE.KEY=VALUE` sets it. Lists have no command line.
    pub flag: Option<&'static str>,
    /// The argument of the Python package.
    pub argument: &'static str,
    /// The label of the control in the workbench.
    pub control: &'static str,
    /// A value, as a spec has it.
    pub example: &'static str,
}

const fn remedy(
    [table, key]: [&'static str; 2],
    flag: Option<&'static str>,
    argument: &'static str,
    control: &'static str,
    example: &'static str,
) -> Remedy {
    Remedy { table, key, flag, argument, control, example }
}

pub const REMEDIES: [Remedy; 22] = [
    remedy(["file", "pixel"], Some("--pixel"), "pixel", "Pixel size", r#""0.8 um""#),
    remedy(["file", "unit"], Some("--unit"), "unit", "Unit", r#"{ xy = "mm", z = "um" }"#),
    remedy(["file", "missing"], Some("--missing"), "missing", "Missing points", "-9999"),
    remedy(["file", "channel"], Some("--channel"), "channel", "Channel", r#""Height""#),
    remedy(["file", "transpose"], Some("--transpose"), "transpose", "Exchange x and y", "true"),
    remedy(["file", "crop.x"], Some("--crop-x"), "crop", "Part along x", r#"["10 um", "200 um"]"#),
    remedy(["file", "crop.y"], Some("--crop-y"), "crop", "Part along y", r#"["10 um", "200 um"]"#),
    remedy(["file", "fit"], Some("--fit"), "fit", "Find the preparation", r#""auto""#),
    remedy(["file", "outliers"], Some("--outliers"), "outliers", "Spikes", r#""remove""#),
    remedy(["file", "align-lines"], Some("--align-lines"), "align_lines", "Align lines", r#""x""#),
    remedy(["file", "tip"], Some("--tip"), "tip", "Tip radius", r#""5 um""#),
    remedy(["file", "level"], Some("--level"), "level", "Form removed", r#""quadratic""#),
    remedy(["file", "filter.s"], Some("--s"), "filter", "S filter", r#""2.5 um""#),
    remedy(["file", "filter.l"], Some("--l"), "filter", "L filter", r#""80 um""#),
    remedy(["compare", "law"], None, "law", "Contact law", r#""elliptic-zmc""#),
    remedy(["compare", "models"], Some("--reference"), "models", "Boundary elements", REFERENCE),
    remedy(
        ["compare", "statistical"],
        None,
        "statistical",
        "Spec",
        r#"{ mean-radius = "inverse-mean-curvature" }"#,
    ),
    remedy(["compare", "reference"], None, "reference", "Spec", "{ refine = 2 }"),
    remedy(["compare", "pressure"], Some("--pressure"), "pressures", "Pressure", r#"["1 MPa"]"#),
    remedy(["compare", "force"], Some("--load"), "forces", "Force", r#"["5 N"]"#),
    remedy(["material", "hardness"], None, "hardness", "Hardness", r#""50 MPa""#),
    remedy(["asperities", "independent"], None, "independent", "independent", "true"),
];

/// The models with boundary elements among them.
const REFERENCE: &str = r#"["statistical", "deterministic", "reference"]"#;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FrontEnd {
    /// A spec: keys and values stay.
    #[default]
    Spec,
    /// The command line that describes a measured file.
    Terminal,
    Python,
    Workbench,
}

impl FrontEnd {
    /// A message with each key of [`REMEDIES`] between backticks in the form of this front end.
    pub fn text(self, message: &str) -> String {
        if self == Self::Spec {
            return message.to_owned();
        }
        let parts = message.split('`').enumerate();
        let parts: Vec<String> = parts
            .map(|(k, part)| {
                if k % 2 == 1 { self.of_code(part) } else { None }.unwrap_or_else(|| part.to_owned())
            })
            .collect();
        parts.join("`")
    }

    /// The form of keys with or without values; `None` of other code.
    fn of_code(self, code: &str) -> Option<String> {
        let Some(table) = code.contains('=').then(|| code.parse::<Table>().ok()).flatten() else {
            return self.of_key(code, None);
        };
        if let Some(Value::Table(materials)) = table.get("material") {
            return self.of_material(materials);
        }
        let forms: Option<Vec<String>> =
            table.iter().map(|(key, value)| self.of_key(key, Some(value))).collect();
        forms
            .filter(|forms| !forms.is_empty())
            .map(|forms| forms.join(if self == Self::Terminal { " " } else { ", " }))
    }

    /// The form of a key of a material, as in `material.PTFE.hardness = "50 MPa"`.
    fn of_material(self, materials: &Table) -> Option<String> {
        let (name, Value::Table(keys)) = materials.iter().next()? else { return None };
        let (key, value) = keys.iter().next()?;
        match self {
            Self::Terminal => Some(format!("--set 'material.{name}.{key}={value}'")),
            Self::Spec | Self::Python | Self::Workbench => self.of_key(key, Some(value)),
        }
    }

    fn of_key(self, key: &str, value: Option<&Value>) -> Option<String> {
        let Some(remedy) = REMEDIES.iter().find(|remedy| remedy.key == key) else {
            return self.of_inner_keys(key, value);
        };
        let Some(value) = value else { return Some(self.name(remedy)) };
        Some(match self {
            Self::Spec => format!("{key} = {value}"),
            Self::Terminal => match (remedy.flag, value) {
                (None, value) => format!("--set '{}.{key}={value}'", remedy.table),
                // Flags that are there or not.
                (Some(flag), _) if ["fit", "models", "transpose"].contains(&key) => flag.to_owned(),
                (Some(flag), Value::Array(items)) if items.is_empty() => format!("{flag} none"),
                (Some(flag), value) => format!("{flag} {}", quoted(&words(value, "="))),
            },
            Self::Python => format!("{}={}", remedy.argument, python(value)),
            Self::Workbench => format!("{}: {}", remedy.control, words(value, " ")),
        })
    }

    /// A table of keys that have rows of their own, such as `filter`.
    fn of_inner_keys(self, key: &str, value: Option<&Value>) -> Option<String> {
        let inner = |name: &str| format!("{key}.{name}");
        let all: Vec<&Remedy> = REMEDIES
            .iter()
            .filter(|remedy| remedy.key.split_once('.').is_some_and(|(outer, _)| outer == key))
            .collect();
        let first = all.first()?;
        match (self, value) {
            (Self::Python, None) => Some(first.argument.to_owned()),
            (Self::Python, Some(value)) => Some(format!("{}={}", first.argument, python(value))),
            (_, None) => Some(all.iter().map(|remedy| self.name(remedy)).collect::<Vec<_>>().join("`, `")),
            (_, Some(Value::Table(table))) => {
                let forms: Option<Vec<String>> =
                    table.iter().map(|(name, value)| self.of_key(&inner(name), Some(value))).collect();
                Some(forms?.join(if self == Self::Terminal { " " } else { ", " }))
            }
            (_, Some(_)) => None,
        }
    }

    fn name(self, remedy: &Remedy) -> String {
        match self {
            Self::Spec => remedy.key.to_owned(),
            Self::Terminal => {
                remedy.flag.map_or_else(|| format!("--set {}.{}=", remedy.table, remedy.key), str::to_owned)
            }
            Self::Python => remedy.argument.to_owned(),
            Self::Workbench => remedy.control.to_owned(),
        }
    }
}

/// A value in words: items between commas, keys of a table before their values.
fn words(value: &Value, equals: &str) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(items) => items.iter().map(|item| words(item, equals)).collect::<Vec<_>>().join(", "),
        Value::Table(table) => {
            let parts: Vec<String> =
                table.iter().map(|(key, value)| format!("{key}{equals}{}", words(value, equals))).collect();
            parts.join(", ")
        }
        Value::Float(number) if number.abs() >= 1e15 => format!("{number:e}"),
        other => other.to_string(),
    }
}

/// A word of a command line, in quotes where a shell needs them.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_.+/".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) { word.to_owned() } else { format!("\"{word}\"") }
}

fn python(value: &Value) -> String {
    match value {
        Value::Boolean(true) => "True".to_owned(),
        Value::Boolean(false) => "False".to_owned(),
        Value::Array(items) => format!("[{}]", items.iter().map(python).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let items: Vec<String> =
                table.iter().map(|(key, value)| format!("\"{key}\": {}", python(value))).collect();
            format!("{{{}}}", items.join(", "))
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_front_end_has_its_own_form() {
        for (message, terminal, python, workbench) in [
            ("`unit`", "`--unit`", "`unit`", "`Unit`"),
            (
                "give `unit = { xy = \"mm\", z = \"um\" }`.",
                "give `--unit \"xy=mm, z=um\"`.",
                "give `unit={\"xy\": \"mm\", \"z\": \"um\"}`.",
                "give `Unit: xy mm, z um`.",
            ),
            ("`missing = []`", "`--missing none`", "`missing=[]`", "`Missing points: `"),
            ("`missing = -9999`", "`--missing -9999`", "`missing=-9999`", "`Missing points: -9999`"),
            (
                "`filter = { s = \"3 µm\", l = \"80 µm\" }`",
                "`--s \"3 µm\" --l \"80 µm\"`",
                "`filter={\"s\": \"3 µm\", \"l\": \"80 µm\"}`",
                "`S filter: 3 µm, L filter: 80 µm`",
            ),
            ("`crop`", "`--crop-x`, `--crop-y`", "`crop`", "`Part along x`, `Part along y`"),
            (
                "`fit = \"auto\"` and `outliers = \"remove\"`",
                "`--fit` and `--outliers remove`",
                "`fit=\"auto\"` and `outliers=\"remove\"`",
                "`Find the preparation: auto` and `Spikes: remove`",
            ),
            (
                "`law = \"elliptic-zmc\"`",
                "`--set 'compare.law=\"elliptic-zmc\"'`",
                "`law=\"elliptic-zmc\"`",
                "`Contact law: elliptic-zmc`",
            ),
            (
                "`material.PTFE.hardness = \"50 MPa\"`",
                "`--set 'material.PTFE.hardness=\"50 MPa\"'`",
                "`hardness=\"50 MPa\"`",
                "`Hardness: 50 MPa`",
            ),
            ("`verify` and a = `b`", "`verify` and a = `b`", "`verify` and a = `b`", "`verify` and a = `b`"),
        ] {
            assert_eq!(FrontEnd::Terminal.text(message), terminal);
            assert_eq!(FrontEnd::Python.text(message), python);
            assert_eq!(FrontEnd::Workbench.text(message), workbench);
            assert_eq!(FrontEnd::Spec.text(message), message);
        }
    }
}
