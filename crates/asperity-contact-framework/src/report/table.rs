//! Tables: each column is defined once, with name, unit, meaning, value, how a page shows it and how `verify` compares it. CSV
//! files, records in `summary.json`, views on pages and in the terminal, NumPy arrays and the documentation all follow from it.
//!
//! A kind of table is a type of rows that implements [`Row`]; [`columns!`](crate::columns) takes a line per column. [`Table`] holds the
//! cells of any kind.

use std::io;
use std::rc::Rc;

use serde::{Serialize, Serializer};
use serde_json::{Map, Number};

use super::view::View;

/// A table that cannot be written: a value that CSV cannot hold.
pub type TableError = csv::Error;

#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number, which reads back to the same f64.
    Number(f64),
    Count(u64),
    /// `true` or `false`.
    Flag(bool),
    Text(String),
    /// Names; in CSV separated by semicolons.
    List(Vec<String>),
    /// The quantity does not apply.
    Empty,
}

impl Value {
    /// The number in a cell of numbers; `None` of any other.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }

    /// The name in a cell of names; empty of any other.
    pub fn text(&self) -> &str {
        match self {
            Self::Text(text) => text,
            _ => "",
        }
    }

    /// Whether the quantity does not apply.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Empty => true,
            Self::Text(text) => text.is_empty(),
            Self::List(names) => names.is_empty(),
            Self::Number(_) | Self::Count(_) | Self::Flag(_) => false,
        }
    }

    /// A cell of a CSV file in a column of this unit.
    fn read(cell: &str, unit: &str) -> Self {
        match unit {
            "text" => Self::Text(cell.to_owned()),
            _ if cell.is_empty() => Self::Empty,
            "true/false" => Self::Flag(cell == "true"),
            "count" => cell.parse().map_or(Self::Empty, Self::Count),
            _ => cell.parse().map_or(Self::Empty, Self::Number),
        }
    }

    /// The value in JSON, which has no infinity: it is the word "inf", as in a spec.
    fn json(&self) -> serde_json::Value {
        use serde_json::Value as Json;
        match self {
            Self::Number(number) if number.is_infinite() => {
                Json::from(if *number > 0.0 { "inf" } else { "-inf" })
            }
            Self::Number(number) => Number::from_f64(*number).map_or(Json::Null, Json::Number),
            Self::Count(count) => Json::from(*count),
            Self::Flag(flag) => Json::from(*flag),
            Self::Text(text) => Json::from(text.as_str()),
            Self::List(names) => Json::from(names.clone()),
            Self::Empty => Json::Null,
        }
    }
}

/// As CSV holds it.
impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Count(count) => serializer.serialize_u64(*count),
            Self::Flag(flag) => serializer.serialize_bool(*flag),
            Self::Text(text) => serializer.serialize_str(text),
            Self::List(names) => serializer.serialize_str(&names.join("; ")),
            Self::Empty => serializer.serialize_none(),
        }
    }
}

/// A number that is not defined leaves its cell empty.
impl From<f64> for Value {
    fn from(number: f64) -> Self {
        if number.is_nan() { Self::Empty } else { Self::Number(number) }
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<Vec<String>> for Value {
    fn from(names: Vec<String>) -> Self {
        Self::List(names)
    }
}

impl<T: Into<Self>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// How a page shows the cells of a column; numbers have three significant digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Reading {
    /// Numbers in the unit of the column, with one prefix for all cells; counts, flags and names as they are.
    #[default]
    Plain,
    /// Inputs, with as many digits as the user gave.
    Input,
    OneDigit,
    Signed,
    Percent,
    /// Relative differences in percent, with a sign.
    SignedPercent,
    /// Thicknesses of a layer: "uncoated" for 0, "bulk" for infinity, else a length with its unit.
    Thickness,
    /// Names of verdicts, which HTML colours.
    Verdict,
}

/// How `verify` compares the cells of a column between two machines. Counts, flags and names are exact.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Comparison {
    /// Numbers relative to themselves.
    #[default]
    Relative,
    /// Numbers relative to the larger of themselves and a scale, in the unit of the column: what is a difference of such numbers.
    Scale(f64),
    /// The same with the scale from another column of the row.
    ScaleOf(String),
    /// Only whether a cell is empty: measured times, rounding errors and where they occur.
    Ignored,
}

/// Name, unit and meaning of a column, and how it is shown and compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Name in the header line; a unit is its suffix.
    pub name: String,
    /// SI unit; `1` of a ratio, or `count`, `text`, `true/false`.
    pub unit: &'static str,
    /// One sentence, without a vertical bar.
    pub meaning: String,
    /// What pages call it, without its unit; by default its name.
    pub label: Option<&'static str>,
    pub reading: Reading,
    /// The prefix of its unit on pages; `None` where the cells decide.
    pub prefix: Option<&'static str>,
    /// How `verify` compares it.
    pub comparison: Comparison,
    /// The part of a run without which a table does not have it; see [`Table::without_part`].
    pub part: Option<&'static str>,
}

impl Heading {
    /// That of a key of a spec, whose values tables of a sweep have: SI in `unit`, or `text`.
    pub fn of_key(key: &str, unit: &'static str) -> Self {
        Self {
            name: key.to_owned(),
            unit,
            meaning: "Value of this key of the spec.".to_owned(),
            label: None,
            reading: Reading::Input,
            prefix: None,
            comparison: Comparison::default(),
            part: None,
        }
    }
}

/// A column of rows `R`: its heading, and its value in a row.
pub struct Column<R> {
    /// Name, unit and meaning, and how it is shown and compared.
    pub heading: Heading,
    value: Rc<dyn Fn(&R) -> Value>,
}

impl<R> Clone for Column<R> {
    fn clone(&self) -> Self {
        Self { heading: self.heading.clone(), value: self.value.clone() }
    }
}

impl<R> Column<R> {
    /// A column whose cells hold `value` of their row.
    pub fn new(
        name: impl Into<String>,
        unit: &'static str,
        meaning: impl Into<String>,
        value: impl Fn(&R) -> Value + 'static,
    ) -> Self {
        let heading = Heading {
            name: name.into(),
            unit,
            meaning: meaning.into(),
            label: None,
            reading: Reading::default(),
            prefix: None,
            comparison: Comparison::default(),
            part: None,
        };
        Self { heading, value: Rc::new(value) }
    }

    pub fn value(&self, row: &R) -> Value {
        (self.value)(row)
    }

    /// The same with another name for pages.
    pub fn label(mut self, label: &'static str) -> Self {
        self.heading.label = Some(label);
        self
    }

    /// The same, shown in its unit with this prefix, such as "M".
    pub fn prefix(mut self, prefix: &'static str) -> Self {
        self.heading.prefix = Some(prefix);
        self
    }

    /// The same, in a table only where this part of a run was asked for.
    pub fn part(mut self, part: &'static str) -> Self {
        self.heading.part = Some(part);
        self
    }

    fn read_as(mut self, reading: Reading) -> Self {
        self.heading.reading = reading;
        self
    }

    /// The same, shown with as many digits as the user gave.
    pub fn input(self) -> Self {
        self.read_as(Reading::Input)
    }

    /// The same, shown with one digit.
    pub fn one_digit(self) -> Self {
        self.read_as(Reading::OneDigit)
    }

    /// The same, shown with a sign.
    pub fn signed(self) -> Self {
        self.read_as(Reading::Signed)
    }

    pub fn percent(self) -> Self {
        self.read_as(Reading::Percent)
    }

    /// The same, shown in percent with a sign.
    pub fn signed_percent(self) -> Self {
        self.read_as(Reading::SignedPercent)
    }

    /// The same, shown as the thickness of a layer.
    pub fn thickness(self) -> Self {
        self.read_as(Reading::Thickness)
    }

    /// The same, shown as a verdict.
    pub fn verdict(self) -> Self {
        self.read_as(Reading::Verdict)
    }

    fn compared_by(mut self, comparison: Comparison) -> Self {
        self.heading.comparison = comparison;
        self
    }

    /// The same, compared relative to a scale.
    pub fn scale(self, scale: f64) -> Self {
        self.compared_by(Comparison::Scale(scale))
    }

    /// The same, compared relative to another column.
    pub fn scale_of(self, column: impl Into<String>) -> Self {
        self.compared_by(Comparison::ScaleOf(column.into()))
    }

    pub fn ignored(self) -> Self {
        self.compared_by(Comparison::Ignored)
    }
}

/// Columns, a line each: `name["unit"] = value, "Meaning.";`, where the value is an expression of the row. Behind the unit stand
/// methods of [`Column`]: how the column is shown and compared.
///
/// ```text
/// columns! { point: Point =>
///     indentation_m["m"] = point.indentation, "Indentation w (Eq. 1).";
///     load_n["N", label("load")] = point.load, "Load P.";
///     error["1", percent, scale(1e-3)] = point.error, "Relative error of the load.";
/// }
/// ```
#[macro_export]
macro_rules! columns {
    ($row:ident: $rows:ty => $($name:ident[$unit:literal $(, $method:ident $(($argument:expr))?)*] = $value:expr, $meaning:literal;)*) => {
        vec![$($crate::report::table::Column::new(stringify!($name), $unit, $meaning, move |$row: &$rows| {
            $crate::report::table::Value::from($value)
        })$(.$method($($argument)?))*),*]
    };
}

/// The table of a row: its file, the meaning of a row, and its columns as for [`columns!`](crate::columns), after those that others have in
/// common with it.
///
/// ```text
/// rows! { PointRow<'_> => "points.csv", records "points";
///     "One row for each point.";
///     ..case_columns(|row: &Self| row.case);
///     row =>
///     load_n["N", label("load")] = row.point.load, "Load P.";
/// }
/// ```
#[macro_export]
macro_rules! rows {
    (
        $row:ty => $file:expr $(, records $records:expr)? $(, is_long $is_long:expr)?; $meaning:expr;
        $(..$common:expr;)?
        $name:ident => $($column:tt)*
    ) => {
        impl $crate::report::table::Row for $row {
            const FILE: &'static str = $file;
            const ROWS: &'static str = $meaning;
            $(const RECORDS: Option<&'static str> = Some($records);)?
            $(const IS_LONG: bool = $is_long;)?

            fn columns() -> Vec<$crate::report::table::Column<Self>> {
                let common: [Vec<$crate::report::table::Column<Self>>; _] = [$($common)?];
                let own = $crate::columns! { $name: Self => $($column)* };
                common.into_iter().flatten().chain(own).collect()
            }
        }
    };
}

pub trait Row: Sized {
    const FILE: &'static str;

    /// Meaning of a row, in one sentence that begins with "One row".
    const ROWS: &'static str;

    /// The key of its records in `summary.json`; `None` of a table that is there as CSV only.
    const RECORDS: Option<&'static str> = None;

    /// Whether it has thousands of rows: such a table is not committed, only the sums of its columns (`digest.csv`).
    const IS_LONG: bool = false;

    fn columns() -> Vec<Column<Self>>;
}

#[derive(Debug, Clone, PartialEq)]
pub struct Schema {
    pub file: &'static str,
    pub rows: &'static str,
    /// The key of its records in `summary.json`.
    pub records: Option<&'static str>,
    /// Whether it has thousands of rows.
    pub is_long: bool,
    pub columns: Vec<Heading>,
}

impl Schema {
    /// That of the table with these rows.
    pub fn of<R: Row>() -> Self {
        let columns = R::columns().into_iter().map(|column| column.heading).collect();
        Self { file: R::FILE, rows: R::ROWS, records: R::RECORDS, is_long: R::IS_LONG, columns }
    }
}

/// A table: its schema and its cells.
#[derive(Debug, Clone)]
pub struct Table {
    pub schema: Schema,
    /// Column by column, as many cells as rows.
    cells: Vec<Vec<Value>>,
    rows: usize,
}

impl Table {
    pub fn new<R: Row>(rows: impl IntoIterator<Item = R>) -> Self {
        let columns = R::columns();
        let mut cells: Vec<Vec<Value>> = columns.iter().map(|_| Vec::new()).collect();
        let mut count = 0;
        for row in rows {
            count += 1;
            for (cells, column) in cells.iter_mut().zip(&columns) {
                cells.push(column.value(&row));
            }
        }
        Self { schema: Schema::of::<R>(), cells, rows: count }
    }

    /// The table of these columns, of equal length.
    pub fn from_columns(
        file: &'static str,
        rows: &'static str,
        columns: impl IntoIterator<Item = (Heading, Vec<Value>)>,
    ) -> Self {
        let (columns, cells): (Vec<_>, Vec<Vec<Value>>) = columns.into_iter().unzip();
        let count = cells.first().map_or(0, Vec::len);
        let schema = Schema { file, rows, records: None, is_long: false, columns };
        Self { schema, cells, rows: count }
    }

    /// The same without the columns of a part that was not run.
    #[must_use]
    pub fn without_part(mut self, part: &str) -> Self {
        let is_kept: Vec<bool> =
            self.schema.columns.iter().map(|heading| heading.part != Some(part)).collect();
        let mut kept = is_kept.iter();
        self.schema.columns.retain(|_| *kept.next().unwrap_or(&true));
        let mut kept = is_kept.iter();
        self.cells.retain(|_| *kept.next().unwrap_or(&true));
        self
    }

    /// The table that [`Self::csv`] has written, which may lack columns of `schema`, and have columns of swept keys.
    pub fn read(schema: &Schema, csv: &[u8]) -> Result<Self, TableError> {
        let mut reader = csv::Reader::from_reader(csv);
        let names = reader.headers()?.clone();
        let records = reader.records().collect::<Result<Vec<_>, _>>()?;
        let heading = |(place, name): (usize, &str)| {
            let heading = schema.columns.iter().find(|heading| heading.name == name).cloned();
            let of_key = || {
                let mut cells = records.iter().filter_map(|record| record.get(place));
                let are_numbers = cells.all(|cell| cell.is_empty() || cell.parse::<f64>().is_ok());
                (name == "seed" || name.contains('.'))
                    .then(|| Heading::of_key(name, if are_numbers { "SI" } else { "text" }))
            };
            let unknown = || io::Error::other(format!("{}: unknown column {name}", schema.file));
            heading.or_else(of_key).ok_or_else(|| TableError::from(unknown()))
        };
        let columns = names.iter().enumerate().map(heading).collect::<Result<Vec<_>, _>>()?;
        let mut cells: Vec<Vec<Value>> = vec![Vec::new(); columns.len()];
        for record in &records {
            for ((cells, heading), cell) in cells.iter_mut().zip(&columns).zip(record.iter()) {
                cells.push(Value::read(cell, heading.unit));
            }
        }
        Ok(Self { schema: Schema { columns, ..schema.clone() }, cells, rows: records.len() })
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The columns with their cells, in file order.
    pub fn columns(&self) -> impl Iterator<Item = (&Heading, &[Value])> {
        self.schema.columns.iter().zip(self.cells.iter().map(Vec::as_slice))
    }

    pub fn column(&self, name: &str) -> Option<(&Heading, &[Value])> {
        self.columns().find(|(heading, _)| heading.name == name)
    }

    /// A choice of its columns and rows, for people.
    pub fn view(&self) -> View<'_> {
        View::new(self)
    }

    /// As CSV; the header is there also when there are no rows.
    pub fn csv(&self) -> Result<Vec<u8>, TableError> {
        let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
        writer.write_record(self.schema.columns.iter().map(|heading| &heading.name))?;
        for row in 0..self.rows {
            let cells: Vec<&Value> = self.cells.iter().map(|column| &column[row]).collect();
            writer.serialize(cells)?;
        }
        writer.into_inner().map_err(|error| error.into_error().into())
    }

    /// As records of JSON, one per row.
    pub fn records(&self) -> serde_json::Value {
        let record = |row: usize| {
            let fields = self.columns().map(|(heading, cells)| (heading.name.clone(), cells[row].json()));
            serde_json::Value::Object(fields.collect::<Map<_, _>>())
        };
        (0..self.rows).map(record).collect()
    }
}

impl IntoIterator for Tables {
    type Item = Table;
    type IntoIter = std::vec::IntoIter<Table>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

#[derive(Debug, Clone, Default)]
pub struct Tables(Vec<Table>);

impl Tables {
    pub fn new(tables: Vec<Table>) -> Self {
        Self(tables)
    }

    pub fn iter(&self) -> impl Iterator<Item = &Table> {
        self.0.iter()
    }

    /// The table with these rows, where the report has it.
    pub fn get<R: Row>(&self) -> Option<&Table> {
        self.0.iter().find(|table| table.schema.file == R::FILE)
    }

    /// A view of the table with these rows; empty where the report has none.
    pub fn view<R: Row>(&self) -> View<'_> {
        self.get::<R>().map_or_else(View::default, Table::view)
    }
}

#[cfg(test)]
mod tests;
