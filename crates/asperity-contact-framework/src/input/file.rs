//! The spec file as a whole: what every experiment has, and tables that its kind reads by name.

use std::fmt;
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use asperity::topography::Rows;
use asperity::{AsperityList, Material};
use asperity_plot::Size;
use indexmap::IndexMap;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use toml::de::{DeTable, DeValue, Deserializer, ValueDeserializer};

use super::accept::FigureSpec;
use super::error::{InputError, Source, gone};
use super::forms::Spanned;
use super::material::{MaterialOrigin, MaterialSpec};
use super::quantity::Whole;
use super::schema::without_null;
use crate::metadata::Group;
use crate::progress::{Progress, Silent};

/// A spec file whose common keys are read; the table of its kind is read by [`SpecFile::table`].
pub struct SpecFile<'a> {
    /// The text, for errors that name a line.
    pub source: Source,
    /// Whoever watches while its files are looked at.
    pub progress: &'a dyn Progress,
    /// Title of the report.
    pub title: String,
    /// The author's notes; a blank line separates paragraphs.
    pub notes: String,
    /// Every random number is drawn from it.
    pub seed: u64,
    /// The size of its figures in print; `None` of figures for the page only.
    pub figure: Option<Size>,
    /// Whether it runs only where it is named or long runs are asked for.
    pub is_long: bool,
    /// Where the index lists its report.
    pub group: Option<Group>,
    materials: IndexMap<Spanned<String>, MaterialSpec>,
    /// Names and positions of the other tables, in file order.
    tables: Vec<(String, Range<usize>)>,
}

/// The keys that every spec may hold.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct CommonKeys {
    /// Title of the report.
    #[schemars(extend("examples" = ["A ground shaft on a soft coating"]))]
    title: String,
    /// Your notes, printed in the report as Markdown; a blank line separates paragraphs.
    #[serde(default)]
    #[schemars(extend("examples" = ["Measured on 12 May, after running in."]))]
    notes: String,
    /// Every random number is drawn from it: the same seed gives the same results.
    #[serde(default)]
    #[schemars(extend("default" = 0, "examples" = [1]))]
    seed: Whole,
    /// Figures in a size for print.
    #[schemars(extend("x-default" = "SVG as wide as the page", "examples" = [{ "width": "85 mm", "font": "8 pt" }]))]
    figure: Option<FigureSpec>,
    /// Whether `experiment` without a file runs it: always, or only with `--full`.
    #[serde(default)]
    #[schemars(extend("examples" = ["long"]))]
    run: RunSpec,
    /// Where the index of reports lists it.
    #[schemars(extend("x-default" = "your surfaces; of kinds that measure the program `trust`, of `[causes]` `why`", "examples" = ["layers"]))]
    group: Option<Group>,
    /// The bodies by name.
    #[serde(default)]
    material: IndexMap<Spanned<String>, MaterialSpec>,
}

/// When a spec runs that no command names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum RunSpec {
    /// With all others.
    #[default]
    Always,
    /// Only with `--full`: it takes minutes.
    Long,
}

/// The longest spec, bytes.
const MOST_BYTES: u64 = 500_000;

/// Names of the fields of [`CommonKeys`].
const COMMON: [&str; 7] = ["title", "notes", "seed", "figure", "run", "group", "material"];

impl<'a> SpecFile<'a> {
    /// Reads a spec that may hold, besides the common keys, the tables named in `tables`.
    pub fn read(path: &Path, tables: &[&str]) -> Result<Self, InputError> {
        let mut bytes = Vec::new();
        // One byte more than is allowed.
        let read =
            std::fs::File::open(path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
        read.map_err(|error| InputError::file(path, format!("cannot be read: {error}")))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            InputError::file(path, format!("is no UTF-8 text (byte {})", error.utf8_error().valid_up_to()))
        })?;
        Self::parse(Source::file(path, text), tables)
    }

    /// The same of a text.
    pub fn parse(source: Source, tables: &[&str]) -> Result<Self, InputError> {
        if source.text.len() as u64 > MOST_BYTES {
            let message = format!(
                "is longer than a spec is; allowed: at most {MOST_BYTES} bytes, heights and lists in files of their own"
            );
            return Err(InputError::file(&source.path, message));
        }
        let mut document = DeTable::parse(&source.text).map_err(|error| source.parse_error(&error))?;
        let mut found: Vec<(String, Range<usize>)> = Vec::new();
        for (key, value) in document.get_ref().iter() {
            let name: &str = key.get_ref();
            if tables.contains(&name) {
                found.push((name.to_owned(), value.span()));
            } else if !COMMON.contains(&name) {
                let allowed: Vec<String> =
                    COMMON.iter().chain(tables).map(|name| format!("`{name}`")).collect();
                let unknown = || format!("found the key `{name}`; allowed: {}", allowed.join(", "));
                return Err(source.error_at(key.span(), gone(name).unwrap_or_else(unknown)));
            }
        }
        found.sort_by_key(|(_, span)| span.start);
        for (name, _) in &found {
            document.get_mut().remove(name.as_str());
        }
        let keys = CommonKeys::deserialize(Deserializer::from(document));
        let CommonKeys { title, notes, seed, figure, run, group, material } =
            keys.map_err(|error| source.parse_error(&error))?;
        Ok(Self {
            source,
            progress: &Silent,
            title,
            notes,
            seed: seed.0,
            figure: figure.map(|figure| figure.size()),
            is_long: run == RunSpec::Long,
            group,
            materials: material,
            tables: found,
        })
    }

    /// The same, while whose files are looked at `progress` watches.
    #[must_use]
    pub fn watched_by(self, progress: &'a dyn Progress) -> Self {
        Self { progress, ..self }
    }

    /// The JSON schema of a spec: the common keys, exactly one of the tables `kinds`, and `others`.
    pub fn schema(
        generator: SchemaGenerator,
        kinds: Vec<(&str, Schema)>,
        others: Vec<(&str, Schema)>,
    ) -> Value {
        let mut schema = generator.into_root_schema_for::<CommonKeys>().to_value();
        schema["title"] = json!("Spec of asperity");
        schema["oneOf"] = kinds.iter().map(|(name, _)| json!({ "required": [name] })).collect();
        for (name, table) in others.into_iter().chain(kinds) {
            schema["properties"][name] = table.to_value();
        }
        without_null(&mut schema);
        schema
    }

    /// Names and positions of the tables besides the common keys, in file order.
    pub fn tables(&self) -> &[(String, Range<usize>)] {
        &self.tables
    }

    /// The table `name` as a `T`; `None` if the file has no such table.
    pub fn table<T: DeserializeOwned>(&self, name: &str) -> Result<Option<Spanned<T>>, InputError> {
        let mut document =
            DeTable::parse(&self.source.text).map_err(|error| self.source.parse_error(&error))?;
        let value: Option<toml::Spanned<DeValue>> = document.get_mut().remove(name);
        let read = value.map(|value| Spanned::<T>::deserialize(ValueDeserializer::from(value))).transpose();
        read.map_err(|error| self.source.parse_error(&error))
    }

    /// The table `name`, which must be present.
    pub fn required_table<T: DeserializeOwned>(&self, name: &str) -> Result<Spanned<T>, InputError> {
        let missing = || InputError::file(&self.source.path, format!("found no [{name}], which is needed"));
        self.table(name)?.ok_or_else(missing)
    }

    /// The materials in file order.
    pub fn materials(&self) -> impl Iterator<Item = (&Spanned<String>, &Material)> {
        self.materials.iter().map(|(name, material)| (name, &material.body))
    }

    /// The materials whose values are from the library, in file order.
    pub fn origins(&self) -> IndexMap<String, MaterialOrigin> {
        let origin = |(name, material): (&Spanned<String>, &MaterialSpec)| {
            Some((name.get_ref().clone(), material.origin.clone()?))
        };
        self.materials.iter().filter_map(origin).collect()
    }
}

/// What lies in memory instead of a file.
#[derive(Clone)]
pub enum InMemory {
    Map {
        rows: Arc<dyn Rows>,
        /// What a reader should know of how it was read, in words of a spec.
        caveats: Vec<String>,
    },
    List(Arc<AsperityList>),
}

impl InMemory {
    /// SHA-256 of its numbers.
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        let mut add = |values: &[f64]| values.iter().for_each(|value| hash.update(value.to_le_bytes()));
        match self {
            Self::Map { rows: map, .. } => {
                let [nx, ny] = map.points();
                add(&[nx as f64, ny as f64]);
                add(&map.pixel());
                let mut row = vec![0.0; ny];
                for ix in 0..nx {
                    map.read(ix, &mut row);
                    add(&row);
                }
            }
            Self::List(list) => list.columns().for_each(add),
        }
        hash.finalize().into()
    }
}

impl fmt::Debug for InMemory {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Map { rows, .. } => write!(f, "map of {:?} points", rows.points()),
            Self::List(list) => write!(f, "list of {} asperities", list.count()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spec_is_at_most_half_a_megabyte() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long.toml");
        let spec = |length: usize| {
            let title = "title = \"long\"\n# ";
            std::fs::write(&path, format!("{title}{}", "x".repeat(length - title.len()))).unwrap();
            SpecFile::read(&path, &[])
        };
        assert_eq!(spec(500_000).unwrap().title, "long");
        let error = spec(500_001).err().unwrap().to_string();
        assert!(error.ends_with("long.toml: is longer than a spec is; allowed: at most 500000 bytes, heights and lists in files of their own"), "{error}");
    }

    #[test]
    fn a_message_shows_a_part_of_a_long_line() {
        let source = |text: String| Source::file(Path::new("a.toml"), text);
        for text in [format!("title = \"{}", "x".repeat(100_000)), format!("{} = 1", "x".repeat(100_000))] {
            let error = SpecFile::parse(source(text), &[]).err().unwrap().to_string();
            assert!(error.len() < 3000 && error.starts_with("a.toml, line 1"), "{error}");
        }
        let error =
            SpecFile::parse(source("title = \"a\u{1b}[31m\"".to_owned()), &[]).err().unwrap().to_string();
        assert!(error.contains("a\\u{1b}[31m") && !error.contains('\u{1b}'), "{error}");
    }
}
