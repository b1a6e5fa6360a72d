//! What a spec may hold, as its JSON schema, and what its keys, the tables of a report and their columns mean.

use std::sync::LazyLock;

use asperity_contact_framework::Kind;
use asperity_contact_framework::input::law::OneLaw;
use asperity_contact_framework::input::{SpecFile, schema};
use asperity_contact_framework::keys::{self, Default, Key};
use asperity_contact_framework::report::digest::DigestRow;
use asperity_contact_framework::report::meanings;
use asperity_contact_framework::report::table::{Heading, Schema};
use indexmap::IndexMap;
use serde_json::Value;

use crate::kind::{KINDS, REPORTED, SURFACES};
use crate::surface::SurfaceSpec;
use crate::sweep::{self, Sweep};

/// The JSON schema (draft 7) of a spec, for editors.
pub fn spec_schema() -> Value {
    let mut generator = schema::generator();
    let kinds = KINDS.iter().map(|kind| (kind.name, (kind.schema)(&mut generator))).collect();
    let mut surfaces = generator.subschema_for::<IndexMap<String, SurfaceSpec>>();
    surfaces
        .insert("description".to_owned(), "Where asperities come from, by name: each of one kind.".into());
    let sweeps = generator.subschema_for::<<Sweep as Kind>::Spec>();
    SpecFile::schema(generator, kinds, vec![(SURFACES, surfaces), (sweep::NAME, sweeps)])
}

/// All keys: those of every spec, materials and surfaces, the kinds of experiment, and the options of laws.
static ALL: LazyLock<Vec<Key>> = LazyLock::new(|| {
    let mut keys = keys::keys(&spec_schema());
    let law = schema::generator().subschema_for::<OneLaw>();
    let options = keys::keys(&law.to_value()).into_iter().map(|mut key| {
        key.path.insert(0, "law".to_owned());
        // One law of them is needed, none by itself.
        if key.is_table {
            key.default = Default::Open;
        }
        key
    });
    keys.extend(options);
    keys
});

/// All keys, each table before its keys.
#[cfg(feature = "serve")]
pub(crate) fn all() -> &'static [Key] {
    &ALL
}

struct WrittenTable {
    schema: Schema,
    kinds: Vec<String>,
}

/// The tables of all kinds of experiment; one that several kinds write stands once.
fn tables() -> Vec<WrittenTable> {
    let mut tables: Vec<WrittenTable> = Vec::new();
    for kind in REPORTED {
        let name = format!("[{}]", kind.name);
        let mut schemas = if kind.name == sweep::NAME { sweep::documented() } else { (kind.tables)() };
        if schemas.iter().any(|schema| schema.is_long) {
            schemas.push(Schema::of::<DigestRow>());
        }
        for schema in schemas {
            match tables.iter_mut().find(|table| table.schema == schema) {
                Some(table) => table.kinds.push(name.clone()),
                None => tables.push(WrittenTable { schema, kinds: vec![name.clone()] }),
            }
        }
    }
    tables
}

fn table_explanation(WrittenTable { schema, kinds }: &WrittenTable) -> String {
    let longest = |text: fn(&Heading) -> &str| {
        schema.columns.iter().map(|column| text(column).chars().count()).max().unwrap_or_default()
    };
    let (name, unit) = (longest(|column| &column.name), longest(|column| column.unit));
    let row =
        |column: &Heading| format!("  {:<name$}  {:<unit$}  {}\n", column.name, column.unit, column.meaning);
    let rows: String = schema.columns.iter().map(row).collect();
    format!("{} of {}\n  {}\n{rows}", schema.file, kinds.join(", "), schema.rows)
}

/// The columns of a name: once for each meaning, with the tables that have it.
fn column_explanations(tables: &[WrittenTable], name: &str) -> Vec<String> {
    let mut found: Vec<(&Heading, Vec<&str>)> = Vec::new();
    for table in tables {
        for column in table.schema.columns.iter().filter(|column| column.name == name) {
            match found.iter_mut().find(|(one, _)| one.unit == column.unit && one.meaning == column.meaning) {
                Some((_, files)) => files.push(table.schema.file),
                None => found.push((column, vec![table.schema.file])),
            }
        }
    }
    let text = |(column, files): (&Heading, Vec<&str>)| {
        format!("{name}\n  {}\n  unit:    {}\n  tables:  {}\n", column.meaning, column.unit, files.join(", "))
    };
    found.into_iter().map(text).collect()
}

/// Explains the keys of a spec, the tables of a report and their columns, and the terms that `wanted` names.
pub fn explain(wanted: &str) -> Result<String, String> {
    let (keys, tables) = (&*ALL, tables());
    let below = |key: &Key| -> Vec<&Key> {
        keys.iter()
            .filter(|other| other.path.len() == key.path.len() + 1 && other.path.starts_with(&key.path))
            .collect()
    };
    let mut texts: Vec<String> =
        keys::find(keys, wanted).iter().map(|key| keys::explanation(key, &below(key))).collect();
    let is_wanted = |file: &str| file == wanted || file.strip_suffix(".csv") == Some(wanted);
    texts.extend(tables.iter().filter(|table| is_wanted(table.schema.file)).map(table_explanation));
    texts.extend(column_explanations(&tables, wanted));
    let terms = meanings();
    texts.extend(terms.get(&wanted.replace(' ', "-")).map(|meaning| format!("{wanted}\n  {meaning}\n")));
    if !texts.is_empty() {
        return Ok(texts.join("\n"));
    }
    let words = keys.iter().filter_map(|key| key.path.last()).map(String::as_str);
    let files = tables.iter().map(|table| table.schema.file);
    let columns = tables.iter().flat_map(|table| &table.schema.columns).map(|column| column.name.as_str());
    let all = words.chain(files).chain(columns).chain(terms.keys().map(String::as_str));
    let similar = keys::similar(all, wanted.rsplit('.').next().unwrap_or(wanted));
    let near = if similar.is_empty() { String::new() } else { format!(" (similar: {})", similar.join(", ")) };
    Err(format!(
        "found the name \"{wanted}\"; allowed: a key of a spec, such as compare.pressure or pixel, a table, such as curves.csv, or a \
         column of one{near}"
    ))
}
