//! `digest.csv`: sums of the columns of long tables. A long table is not kept under version control; its digest is, and `verify`
//! compares it as it would compare the table.

use sha2::{Digest, Sha256};

use super::table::{Table, Value};
use crate::rows;

/// One column of a long table.
#[derive(Debug, Clone)]
pub struct DigestRow {
    table: &'static str,
    column: String,
    rows: usize,
    empty: usize,
    sums: Sums,
}

/// Sums over the cells of a column.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    sum: f64,
    magnitude: f64,
    weighted: f64,
    extremes: Option<[f64; 2]>,
}

rows! { DigestRow => "digest.csv";
    "One row for each column of a table that is too long to be kept under version control: sums that tell whether a table made again is the same. A flag counts as 0 or 1, a name as a number from 0 to 1 that its SHA-256 gives.";
    row =>
    table["text"] = row.table, "File of the table.";
    column["text"] = row.column.as_str(), "Name of the column.";
    rows["count"] = row.rows, "Rows of the table.";
    empty["count"] = row.empty, "Empty cells.";
    sum["1", scale_of("magnitude")] = row.sums.sum, "Sum of the cells, in the unit of the column; infinite thicknesses are left out.";
    magnitude["1"] = row.sums.magnitude, "Sum of the magnitudes of the cells.";
    least["1"] = row.sums.extremes.map(|[least, _]| least), "Smallest cell.";
    largest["1"] = row.sums.extremes.map(|[_, largest]| largest), "Largest cell.";
    weighted["1", scale_of("magnitude")] = row.sums.weighted, "Sum of the cells times the position of the row, from 0 for the first to 1 for the last.";
}

/// The digest of the long ones among some tables; `None` where there is none.
pub fn digest<'a>(tables: impl IntoIterator<Item = &'a Table>) -> Option<Table> {
    let mut rows = Vec::new();
    for table in tables.into_iter().filter(|table| table.schema.is_long) {
        for (heading, cells) in table.columns() {
            let empty = cells.iter().filter(|cell| **cell == Value::Empty).count();
            rows.push(DigestRow {
                table: table.schema.file,
                column: heading.name.clone(),
                rows: cells.len(),
                empty,
                sums: Sums::new(cells),
            });
        }
    }
    (!rows.is_empty()).then(|| Table::new(rows))
}

impl Sums {
    fn new(cells: &[Value]) -> Self {
        let mut sums = Self::default();
        let last = cells.len().saturating_sub(1).max(1) as f64;
        for (position, value) in cells.iter().enumerate() {
            let Some(value) = number(value) else { continue };
            sums.sum += value;
            sums.magnitude += value.abs();
            sums.weighted += value * (position as f64 / last);
            let [least, largest] = sums.extremes.unwrap_or([value; 2]);
            sums.extremes = Some([least.min(value), largest.max(value)]);
        }
        sums
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => Some(*number).filter(|number| number.is_finite()),
        Value::Count(count) => Some(*count as f64),
        Value::Flag(flag) => Some(f64::from(u8::from(*flag))),
        Value::Text(text) => Some(fraction(text)),
        Value::List(names) => Some(fraction(&names.join("; "))),
        Value::Empty => None,
    }
}

/// A number from 0 to 1 that identifies a text, in eight digits.
fn fraction(text: &str) -> f64 {
    let hash = Sha256::digest(text.as_bytes());
    let bits = hash.iter().take(4).fold(0u32, |bits, &byte| bits << 8 | u32::from(byte));
    (f64::from(bits) / f64::from(u32::MAX) * 1e8).round() / 1e8
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Point(&'static str, f64, Option<f64>);

    rows! { Point => "points.csv", is_long true;
        "One row for each point.";
        row =>
        name["text"] = row.0, "Name.";
        x["1"] = row.1, "x.";
        y["1"] = row.2, "y.";
    }

    fn column(points: Vec<Point>, name: &str) -> DigestRow {
        let table = Table::new(points);
        let (_, cells) = table.column(name).unwrap();
        let empty = cells.iter().filter(|cell| **cell == Value::Empty).count();
        DigestRow {
            table: "points.csv",
            column: name.into(),
            rows: cells.len(),
            empty,
            sums: Sums::new(cells),
        }
    }

    #[test]
    fn sums_tell_changed_swapped_and_missing_cells() {
        let points =
            || vec![Point("a", 1.0, None), Point("b", -2.0, Some(f64::INFINITY)), Point("c", 4.0, Some(3.0))];
        let x = column(points(), "x");
        assert_eq!((x.rows, x.empty, x.sums.sum, x.sums.magnitude), (3, 0, 3.0, 7.0));
        assert_eq!((x.sums.extremes, x.sums.weighted), (Some([-2.0, 4.0]), 3.0));
        let y = column(points(), "y");
        assert_eq!((y.empty, y.sums.sum), (1, 3.0));
        let mut swapped = points();
        swapped.swap(0, 2);
        assert_ne!(column(swapped, "x").sums.weighted, x.sums.weighted);
        let names = |points| column(points, "name").sums.weighted;
        let mut renamed = points();
        renamed[1].0 = "d";
        assert_ne!(names(renamed), names(points()));
    }

    #[test]
    fn only_long_tables_have_a_digest() {
        let table = Table::new([Point("a", 1.0, None)]);
        let rows = digest([&table]).unwrap();
        assert_eq!(rows.rows(), 3);
        let mut short = table;
        short.schema.is_long = false;
        assert!(digest([&short]).is_none());
    }
}
