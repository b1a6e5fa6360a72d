//! Views of tables for people: a choice of columns and rows, in units fit for reading.

use asperity::compare::of_each_decade;

use super::format::{self, Prefix};
use super::table::{Heading, Reading, Table, Value};

/// A choice of the columns and rows of a table. Columns without any value are left out.
#[derive(Debug, Clone, Default)]
pub struct View<'a> {
    /// `None` of a table that the report does not have.
    table: Option<&'a Table>,
    columns: Vec<Shown>,
    rows: Vec<usize>,
}

#[derive(Debug, Clone)]
struct Shown {
    place: usize,
    /// Its heading, which a view may change.
    heading: Heading,
}

/// A view in words: one text per cell.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ViewText {
    /// Label and unit of each column.
    pub header: Vec<String>,
    /// As many cells per row as columns.
    pub rows: Vec<Vec<String>>,
    /// Places of the columns whose cells are verdicts.
    pub verdicts: Vec<usize>,
}

impl<'a> View<'a> {
    pub(super) fn new(table: &'a Table) -> Self {
        let shown = |(place, heading): (usize, &Heading)| Shown { place, heading: heading.clone() };
        let columns = table.schema.columns.iter().enumerate().map(shown).collect();
        Self { table: Some(table), columns, rows: (0..table.rows()).collect() }
    }

    fn place(&self, name: &str) -> Option<usize> {
        let place = self.table?.schema.columns.iter().position(|heading| heading.name == name);
        debug_assert!(place.is_some() || self.table.is_none(), "no column {name}");
        place
    }

    fn cells(&self, place: usize) -> &'a [Value] {
        self.table.and_then(|table| table.columns().nth(place)).map_or(&[], |(_, cells)| cells)
    }

    /// These columns by name, in this order.
    #[must_use]
    pub fn columns(mut self, names: &[&str]) -> Self {
        let places: Vec<usize> = names.iter().filter_map(|name| self.place(name)).collect();
        let shown = |&place: &usize| self.columns.iter().find(|column| column.place == place).cloned();
        self.columns = places.iter().filter_map(shown).collect();
        self
    }

    #[must_use]
    pub fn without(mut self, names: &[&str]) -> Self {
        let places: Vec<Option<usize>> = names.iter().map(|name| self.place(name)).collect();
        self.columns.retain(|column| !places.contains(&Some(column.place)));
        self
    }

    /// The same with another label for a column, without its unit.
    #[must_use]
    pub fn label(self, name: &str, label: &'static str) -> Self {
        self.with(name, |heading| heading.label = Some(label))
    }

    /// The same with another reading of a column.
    #[must_use]
    pub fn read_as(self, name: &str, reading: Reading) -> Self {
        self.with(name, |heading| heading.reading = reading)
    }

    /// The same with the unit of a column whose rows have one of several, and its prefix.
    #[must_use]
    pub fn unit(self, name: &str, unit: &'static str, prefix: &'static str) -> Self {
        self.with(name, |heading| {
            heading.unit = unit;
            heading.prefix = Some(prefix);
        })
    }

    fn with(mut self, name: &str, change: impl FnOnce(&mut Heading)) -> Self {
        let place = self.place(name);
        if let Some(column) = self.columns.iter_mut().find(|column| Some(column.place) == place) {
            change(&mut column.heading);
        }
        self
    }

    /// The rows whose cell in a column is this name or number, and the same without that column.
    #[must_use]
    pub fn only(self, name: &str, value: impl Into<Value>) -> Self {
        let value = value.into();
        self.filter(name, |cell| *cell == value).without(&[name])
    }

    /// The rows for whose cell in a column `is_kept` holds.
    #[must_use]
    pub fn filter(mut self, name: &str, is_kept: impl Fn(&Value) -> bool) -> Self {
        if let Some(place) = self.place(name) {
            let cells = self.cells(place);
            self.rows.retain(|&row| is_kept(&cells[row]));
        }
        self
    }

    /// The first rows in each stretch of rows that are alike in some columns.
    #[must_use]
    pub fn first_of_each(mut self, names: &[&str]) -> Self {
        let columns: Vec<&[Value]> =
            names.iter().filter_map(|name| Some(self.cells(self.place(name)?))).collect();
        self.rows.dedup_by(|next, row| columns.iter().all(|cells| cells[*next] == cells[*row]));
        self
    }

    /// The same without columns that have the same value in all rows, among these.
    #[must_use]
    pub fn without_constant(self, names: &[&str]) -> Self {
        let is_constant = |name: &&&str| {
            let Some(place) = self.place(name) else { return false };
            let cells = self.cells(place);
            self.rows.windows(2).all(|pair| cells[pair[0]] == cells[pair[1]])
        };
        let constant: Vec<&str> = names.iter().filter(is_constant).copied().collect();
        self.without(&constant)
    }

    /// The rows nearest to so many values of a column per decade, ascending.
    #[must_use]
    pub fn each_decade(mut self, name: &str, per_decade: f64) -> Self {
        let Some(place) = self.place(name) else { return self };
        let cells = self.cells(place);
        let number = |row: &usize| cells[*row].number().unwrap_or(f64::NAN);
        self.rows.sort_by(|a, b| number(a).total_cmp(&number(b)));
        self.rows = of_each_decade(self.rows, number, per_decade);
        self
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// The first row as a table of two columns, property and value with its unit.
    pub fn properties(&self) -> ViewText {
        let property = |Shown { place, heading }: &Shown| {
            let cell = &self.cells(*place)[*self.rows.first()?];
            let unit = Unit::new(heading, &[cell]);
            let value = unit.cell(cell, heading.reading);
            let value = match &unit.name {
                Some(name) => format!("{value} {}", name.strip_prefix('1').unwrap_or(name)),
                None => value,
            };
            (!cell.is_empty()).then(|| vec![heading.words(), value])
        };
        ViewText {
            header: vec!["property".to_owned(), "value".to_owned()],
            rows: self.columns.iter().filter_map(property).collect(),
            verdicts: Vec::new(),
        }
    }

    pub fn text(&self) -> ViewText {
        let mut text = ViewText { rows: vec![Vec::new(); self.rows.len()], ..ViewText::default() };
        for Shown { place, heading } in &self.columns {
            let cells: Vec<&Value> = self.rows.iter().map(|&row| &self.cells(*place)[row]).collect();
            if cells.iter().all(|cell| cell.is_empty()) {
                continue;
            }
            let unit = Unit::new(heading, &cells);
            if heading.reading == Reading::Verdict {
                text.verdicts.push(text.header.len());
            }
            let label = heading.words();
            text.header.push(unit.name.as_ref().map_or(label.clone(), |name| format!("{label} ({name})")));
            for (row, cell) in text.rows.iter_mut().zip(cells) {
                row.push(unit.cell(cell, heading.reading));
            }
        }
        text
    }
}

impl ViewText {
    /// The table as lines of text, columns of numbers right-aligned.
    pub fn lines(&self) -> String {
        let length = |cell: &str| cell.chars().count();
        let column = |place: usize| {
            let cells = || self.rows.iter().map(move |row| row[place].as_str());
            let width = cells().map(length).chain([length(&self.header[place])]).max();
            (width.unwrap_or(0), cells().all(is_number))
        };
        let columns: Vec<(usize, bool)> = (0..self.header.len()).map(column).collect();
        let line = |cells: &Vec<String>| {
            let cells = cells.iter().zip(&columns).map(|(cell, &(width, is_numeric))| {
                let blanks = " ".repeat(width - length(cell));
                if is_numeric { format!("  {blanks}{cell}") } else { format!("  {cell}{blanks}") }
            });
            cells.collect::<String>().trim_end().to_owned() + "\n"
        };
        line(&self.header) + &self.rows.iter().map(line).collect::<String>()
    }
}

/// Whether a cell is empty or holds a number without a unit.
fn is_number(cell: &str) -> bool {
    let digits = |c: char| c.is_ascii_digit() || matches!(c, '.' | ',' | '-' | '+' | 'e' | '−' | '∞' | '–');
    cell.chars().all(digits)
}

impl Heading {
    /// What pages call it: its label, or its name without the suffix of its unit.
    pub fn words(&self) -> String {
        if let Some(label) = self.label {
            return label.to_owned();
        }
        const SUFFIXES: [&str; 9] =
            ["_pa_per_m", "_per_m2", "_per_m", "_over_sigma", "_pa", "_m2", "_m", "_n", "_s"];
        let suffix = SUFFIXES.into_iter().find(|suffix| self.name.ends_with(suffix)).unwrap_or("");
        let words = self.name.trim_end_matches(suffix).replace('_', " ");
        if suffix == "_over_sigma" { format!("{words}/σ") } else { words }
    }
}

/// The unit that all cells of a column are shown in.
struct Unit {
    /// `None` of what has no unit.
    name: Option<String>,
    /// A number is divided by it.
    size: f64,
}

impl Unit {
    fn new(heading: &Heading, cells: &[&Value]) -> Self {
        let none = Self { name: None, size: 1.0 };
        match (heading.reading, heading.unit) {
            (Reading::Percent | Reading::SignedPercent, _) => Self { name: Some("%".to_owned()), size: 0.01 },
            (Reading::Thickness | Reading::Verdict, _)
            | (_, "1" | "SI" | "count" | "text" | "true/false") => none,
            (_, unit) if heading.prefix.is_some() => {
                let Prefix { name, size } = Prefix::named(heading.prefix.unwrap_or_default(), unit);
                Self { name: Some(name), size }
            }
            (_, unit) => {
                let mut sizes: Vec<f64> = cells
                    .iter()
                    .filter_map(|cell| cell.number())
                    .map(f64::abs)
                    .filter(|size| *size > 0.0 && size.is_finite())
                    .collect();
                sizes.sort_by(f64::total_cmp);
                let middle = sizes.get(sizes.len() / 2).copied().unwrap_or(1.0);
                let Prefix { name, size } = Prefix::for_value(middle, unit);
                Self { name: Some(name), size }
            }
        }
    }

    fn cell(&self, cell: &Value, reading: Reading) -> String {
        match cell {
            Value::Number(number) => match reading {
                Reading::Thickness => format::thickness(*number),
                Reading::Input => format::input_number(number / self.size),
                Reading::OneDigit => format::one_digit(number / self.size),
                Reading::Signed => format::signed_or_small(number / self.size, 1e-3),
                Reading::SignedPercent => format::signed_or_small(number / self.size, 0.1),
                Reading::Plain | Reading::Percent | Reading::Verdict => format::number(number / self.size),
            },
            Value::Count(count) => format::count(*count as usize),
            Value::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
            Value::Text(text) if reading == Reading::Verdict => text.replace('-', " "),
            Value::Text(text) => text.clone(),
            Value::List(names) => names.join(", "),
            Value::Empty => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::table::Table;
    use crate::rows;

    struct Contact(&'static str, f64, Option<f64>, f64);

    rows! { Contact => "contacts.csv";
        "One row for each contact.";
        row =>
        law["text"] = row.0, "Law.";
        pressure_pa["Pa", label("nominal pressure")] = row.1, "Pressure.";
        stiffness_pa_per_m["Pa/m"] = row.2, "Stiffness.";
        error["1", signed_percent] = row.3, "Error.";
        verdict["text", verdict] = if row.3 > 0.5 { "cannot-tell" } else { "within" }, "Verdict.";
    }

    fn table() -> Table {
        Table::new([
            Contact("zmc", 2e5, None, 0.1),
            Contact("zmc", 2.5e6, None, -0.02),
            Contact("hertz", 1e8, None, 0.6),
        ])
    }

    #[test]
    fn a_column_has_one_unit_and_empty_columns_are_left_out() {
        let text = table().view().text();
        assert_eq!(text.header, ["law", "nominal pressure (MPa)", "error (%)", "verdict"]);
        assert_eq!(text.rows[0], ["zmc", "0.2", "+10", "within"]);
        assert_eq!(text.rows[2], ["hertz", "100", "+60", "cannot tell"]);
        assert_eq!(text.verdicts, [3]);
        assert_eq!(
            text.lines().lines().nth(1).unwrap(),
            "  zmc                       0.2        +10  within"
        );
    }

    #[test]
    fn columns_and_rows_are_chosen() {
        let table = table();
        let view = table.view().columns(&["error", "law"]).only("law", "zmc").label("error", "difference");
        let text = view.text();
        assert_eq!(
            (text.header, text.rows),
            (vec!["difference (%)".into()], vec![vec!["+10".into()], vec!["-2".into()]])
        );
        assert_eq!(table.view().first_of_each(&["law"]).len(), 2);
        let constant = table
            .view()
            .filter("law", |law| law.text() == "zmc")
            .without_constant(&["law", "verdict", "error"]);
        assert_eq!(
            constant.text().header,
            ["pressure (MPa)".replace("pressure", "nominal pressure"), "error (%)".into()]
        );
        assert!(table.view().filter("error", |cell| cell.number() > Some(1.0)).is_empty());
    }

    #[test]
    fn a_row_is_a_list_of_properties() {
        let table = table();
        let properties = table.view().only("law", "hertz").properties();
        assert_eq!(properties.rows[0], ["nominal pressure", "100 MPa"]);
        assert_eq!(properties.rows[1..], [["error", "+60 %"], ["verdict", "cannot tell"]]);
        assert!(table.view().only("law", "none").properties().rows.is_empty());
    }
}
