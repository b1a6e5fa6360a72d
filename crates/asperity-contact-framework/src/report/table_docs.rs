//! The documentation of tables, as Markdown.

use super::table::Schema;

/// Text common to all tables.
const INTRODUCTION: &str = "\
# The tables of a report

Printed by `experiment columns`; `experiment columns KIND` prints those of one kind of experiment.

Every table is a CSV file with a header line. Numbers are in SI units and read back to the same `f64`. A cell is empty where
a quantity does not apply. Unit `1` marks a ratio. Equation numbers are those of Pasaribu and Schipper (2005);
[theory.md](theory.md) explains the symbols.
";

/// A table and the kinds that write it.
struct Documented {
    schema: Schema,
    kinds: Vec<String>,
}

/// Documents the tables of `kinds`, each a name with its tables. A table that several kinds share is documented once.
pub fn markdown<'a>(kinds: impl IntoIterator<Item = (&'a str, Vec<Schema>)>) -> String {
    let mut tables: Vec<Documented> = Vec::new();
    for (kind, schemas) in kinds {
        let kind = format!("`[{kind}]`");
        for schema in schemas {
            match tables.iter_mut().find(|table| table.schema == schema) {
                Some(table) => table.kinds.push(kind.clone()),
                None => tables.push(Documented { schema, kinds: vec![kind.clone()] }),
            }
        }
    }
    let overview: String = tables.iter().map(Documented::line).collect();
    let sections: String = tables.iter().map(Documented::section).collect();
    format!("{INTRODUCTION}\n| table | written by | rows |\n|---|---|---|\n{overview}{sections}")
}

impl Documented {
    /// The line of the overview.
    fn line(&self) -> String {
        let Schema { file, rows, .. } = self.schema;
        let anchor = file.replace('.', "");
        format!("| [`{file}`](#{anchor}) | {} | {rows} |\n", self.kinds.join(", "))
    }

    fn section(&self) -> String {
        let columns = self.schema.columns.iter();
        let lines =
            columns.map(|column| format!("| `{}` | {} | {} |\n", column.name, column.unit, column.meaning));
        let Schema { file, rows, .. } = self.schema;
        format!(
            "\n## `{file}`\n\n{rows}\n\n| column | unit | meaning |\n|---|---|---|\n{}",
            lines.collect::<String>()
        )
    }
}
