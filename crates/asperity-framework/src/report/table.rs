//! Tables: each column is defined once, with name, unit, meaning and value. The CSV files and the documentation of their
//! columns are both written from that definition.
//!
//! A kind of table is a type of rows that implements [`Row`]; [`columns!`](crate::columns) takes a line per column.

use std::rc::Rc;

use serde::Serialize;

/// A table that cannot be written: a value that CSV cannot hold.
pub type TableError = csv::Error;

/// The content of a cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A number, which reads back to the same f64.
    Number(f64),
    /// A count.
    Count(u64),
    /// `true` or `false`.
    Flag(bool),
    /// A name.
    Text(String),
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
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
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

impl<T: Into<Self>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// Name, unit, meaning and value of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Heading {
    /// Name in the header line; a unit is its suffix.
    pub name: String,
    /// SI unit; `1` of a ratio, or `count`, `text`, `true/false`.
    pub unit: &'static str,
    /// One sentence, without a vertical bar.
    pub meaning: String,
}

/// A column of rows `R`: its heading, and its value in a row.
pub struct Column<R> {
    /// Name, unit and meaning.
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
        let heading = Heading { name: name.into(), unit, meaning: meaning.into() };
        Self { heading, value: Rc::new(value) }
    }

    /// The cell of a row.
    pub fn value(&self, row: &R) -> Value {
        (self.value)(row)
    }
}

/// Columns, a line each: `name["unit"] = value, "Meaning.";`, where the value is an expression of the row.
///
/// ```text
/// columns! { point: Point =>
///     indentation_m["m"] = point.indentation, "Indentation w (Eq. 1).";
///     load_n["N"] = point.load, "Load P.";
/// }
/// ```
#[macro_export]
macro_rules! columns {
    ($row:ident: $rows:ty => $($name:ident[$unit:literal] = $value:expr, $meaning:literal;)*) => {
        vec![$($crate::report::table::Column::new(stringify!($name), $unit, $meaning, move |$row: &$rows| {
            $crate::report::table::Value::from($value)
        })),*]
    };
}

/// The rows of one table.
pub trait Row: Sized {
    /// Name of its file.
    const FILE: &'static str;

    /// Meaning of a row, in one sentence that begins with "One row".
    const ROWS: &'static str;

    /// Its columns, in file order.
    fn columns() -> Vec<Column<Self>>;
}

/// Documentation of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Schema {
    /// Name of its file.
    pub file: &'static str,
    /// Meaning of a row.
    pub rows: &'static str,
    /// Its columns, in file order.
    pub columns: Vec<Heading>,
}

impl Schema {
    /// That of the table with these rows.
    pub fn of<R: Row>() -> Self {
        let columns = R::columns().into_iter().map(|column| column.heading).collect();
        Self { file: R::FILE, rows: R::ROWS, columns }
    }
}

/// The file of a table, name and content; the header is there also when there are no rows.
///
/// # Errors
/// See [`TableError`].
pub fn csv_file<R: Row>(rows: impl IntoIterator<Item = R>) -> Result<(&'static str, Vec<u8>), TableError> {
    csv_file_with(rows, |_| true)
}

/// The same with the columns that `is_kept` holds for, for columns about something that was not run.
///
/// # Errors
/// See [`TableError`].
pub fn csv_file_with<R: Row>(
    rows: impl IntoIterator<Item = R>,
    is_kept: impl Fn(&Heading) -> bool,
) -> Result<(&'static str, Vec<u8>), TableError> {
    let columns: Vec<Column<R>> =
        R::columns().into_iter().filter(|column| is_kept(&column.heading)).collect();
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
    writer.write_record(columns.iter().map(|column| &column.heading.name))?;
    for row in rows {
        let cells: Vec<Value> = columns.iter().map(|column| column.value(&row)).collect();
        writer.serialize(cells)?;
    }
    Ok((R::FILE, writer.into_inner().map_err(|error| error.into_error())?))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sphere {
        name: &'static str,
        radius: f64,
        load: Option<f64>,
    }

    impl Row for Sphere {
        const FILE: &'static str = "spheres.csv";
        const ROWS: &'static str = "One row for each sphere.";

        fn columns() -> Vec<Column<Self>> {
            columns! { sphere: Self =>
                name["text"] = sphere.name, "Name of the sphere.";
                radius_m["m"] = sphere.radius, "Radius.";
                load_n["N"] = sphere.load, "Load; empty where there is no contact.";
                in_contact["true/false"] = sphere.load.is_some(), "Whether there is contact.";
                letters["count"] = sphere.name.len(), "Letters of the name.";
            }
        }
    }

    #[test]
    fn header_and_cells_come_from_the_columns() {
        let rows = [
            Sphere { name: "a, b", radius: 1e-6, load: Some(0.1 + 0.2) },
            Sphere { name: "c", radius: 2.0, load: None },
        ];
        let (name, file) = csv_file(rows).unwrap();
        let expected = "name,radius_m,load_n,in_contact,letters\n\"a, b\",1e-6,0.30000000000000004,true,4\nc,2.0,,false,1\n";
        assert_eq!((name, String::from_utf8(file).unwrap().as_str()), ("spheres.csv", expected));
        let (_, two) =
            csv_file_with::<Sphere>([], |heading| heading.unit == "m" || heading.unit == "N").unwrap();
        assert_eq!(two, b"radius_m,load_n\n");
        let (_, empty) = csv_file::<Sphere>([]).unwrap();
        assert_eq!(empty, b"name,radius_m,load_n,in_contact,letters\n");
    }

    #[test]
    fn a_schema_has_the_headings_in_file_order() {
        let schema = Schema::of::<Sphere>();
        let units: Vec<&str> = schema.columns.iter().map(|column| column.unit).collect();
        assert_eq!(units, ["text", "m", "N", "true/false", "count"]);
        assert_eq!(schema.columns[1].meaning, "Radius.");
    }
}
