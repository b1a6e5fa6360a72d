//! `tables = ["csv", "parquet"]`: the formats of the tables of a report.

use schemars::JsonSchema;
use serde::Deserialize;

/// A format of tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
enum TableFormat {
    /// Text, which pages, `verify` and people read.
    Csv,
    /// Apache Parquet, with types and null cells.
    Parquet,
}

/// The formats of the tables of a report: CSV, and others beside it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(try_from = "Vec<TableFormat>")]
pub(super) struct TablesSpec(Vec<TableFormat>);

impl TablesSpec {
    /// Whether tables are written as Parquet, too.
    pub(super) fn has_parquet(&self) -> bool {
        self.0.contains(&TableFormat::Parquet)
    }
}

impl Default for TablesSpec {
    fn default() -> Self {
        Self(vec![TableFormat::Csv])
    }
}

impl TryFrom<Vec<TableFormat>> for TablesSpec {
    type Error = &'static str;

    fn try_from(formats: Vec<TableFormat>) -> Result<Self, Self::Error> {
        let is_twice = (1..formats.len()).any(|k| formats[..k].contains(&formats[k]));
        if is_twice || !formats.contains(&TableFormat::Csv) {
            return Err(
                "found tables without \"csv\", or a format twice; allowed: [\"csv\"], or [\"csv\", \"parquet\"], \
                        since pages and `verify` read CSV",
            );
        }
        Ok(Self(formats))
    }
}
