//! A table as Apache Parquet: one column for each, plain values, not packed; what is empty is null.
//!
//! A file is `PAR1`, the values of each column in a page with a header, the description of all of it, its length and `PAR1`. Headers and
//! description are in the compact protocol of Thrift (<https://parquet.apache.org/docs/file-format/>).

use serde_json::{Map, json};

use super::PROGRAM;
use super::table::{Heading, Table, Value};

/// Rows of a group: a page holds less than 2 GB.
const ROWS: usize = 1 << 20;

const MAGIC: &[u8] = b"PAR1";
/// Values as they are, in the numbers of the format.
const PLAIN: i64 = 0;
/// Runs of levels.
const RLE: i64 = 3;

/// A type of values, in the numbers of the format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Flag = 0,
    Count = 2,
    Number = 5,
    Text = 6,
}

impl Kind {
    /// By the unit of a column, as its CSV file is read.
    fn of(heading: &Heading) -> Self {
        match heading.unit {
            "text" => Self::Text,
            "true/false" => Self::Flag,
            "count" => Self::Count,
            _ => Self::Number,
        }
    }
}

/// The name of the file of a table, next to its CSV file.
pub fn file_name(table: &Table) -> String {
    let name = table.schema.file;
    format!("{}.parquet", name.strip_suffix(".csv").unwrap_or(name))
}

/// The file of a table; numbers are those of the CSV file, to the bit. Units and meanings are the key `columns` of its metadata.
pub fn parquet(table: &Table) -> Vec<u8> {
    let mut file = MAGIC.to_vec();
    let mut groups = Vec::new();
    for first in (0..table.rows()).step_by(ROWS) {
        let count = ROWS.min(table.rows() - first);
        let start = file.len();
        let columns = table.columns().map(|(heading, cells)| {
            let at = file.len();
            write_page(&mut file, Kind::of(heading), &cells[first..first + count]);
            (heading, [at, file.len() - at])
        });
        let columns: Vec<Compact> = columns.map(|(heading, place)| chunk(heading, place, count)).collect();
        let mut group = Compact::default();
        group.structs(1, &columns);
        group.int(2, Compact::I64, (file.len() - start) as i64);
        group.int(3, Compact::I64, count as i64);
        groups.push(group);
    }
    let description = description(table, &groups).end();
    file.extend(&description);
    file.extend((description.len() as u32).to_le_bytes());
    file.extend(MAGIC);
    file
}

/// What the file holds.
fn description(table: &Table, groups: &[Compact]) -> Compact {
    let mut root = Compact::default();
    root.text(4, "table");
    root.int(5, Compact::I32, table.schema.columns.len() as i64);
    let columns = table.schema.columns.iter().map(|heading| {
        let kind = Kind::of(heading);
        let mut column = Compact::default();
        column.int(1, Compact::I32, kind as i64);
        let optional = 1;
        column.int(3, Compact::I32, optional);
        column.text(4, &heading.name);
        if kind == Kind::Text {
            // UTF-8, in the older way and the newer one.
            column.int(6, Compact::I32, 0);
            let mut logical = Compact::default();
            logical.structure(1, Compact::default());
            column.structure(10, logical);
        }
        column
    });
    let schema: Vec<Compact> = [root].into_iter().chain(columns).collect();
    let mut all = Compact::default();
    let version = 1;
    all.int(1, Compact::I32, version);
    all.structs(2, &schema);
    all.int(3, Compact::I64, table.rows() as i64);
    all.structs(4, groups);
    let meanings: Map<_, _> = table
        .schema
        .columns
        .iter()
        .map(|heading| (heading.name.clone(), json!({ "unit": heading.unit, "meaning": heading.meaning })))
        .collect();
    let notes = [("rows", table.schema.rows.to_owned()), ("columns", json!(meanings).to_string())];
    let notes = notes.map(|(key, value)| {
        let mut note = Compact::default();
        note.text(1, key);
        note.text(2, &value);
        note
    });
    all.structs(5, &notes);
    all.text(6, &format!("{PROGRAM} version {}", env!("CARGO_PKG_VERSION")));
    all
}

/// Where a column is in the file, and how it is written.
fn chunk(heading: &Heading, [at, bytes]: [usize; 2], rows: usize) -> Compact {
    let mut facts = Compact::default();
    facts.int(1, Compact::I32, Kind::of(heading) as i64);
    facts.ints(2, &[PLAIN, RLE]);
    facts.texts(3, &[&heading.name]);
    let not_packed = 0;
    facts.int(4, Compact::I32, not_packed);
    facts.int(5, Compact::I64, rows as i64);
    facts.int(6, Compact::I64, bytes as i64);
    facts.int(7, Compact::I64, bytes as i64);
    facts.int(9, Compact::I64, at as i64);
    let mut chunk = Compact::default();
    chunk.int(2, Compact::I64, at as i64);
    chunk.structure(3, facts);
    chunk
}

/// The cells of a column: which of them hold a value, and the values.
fn write_page(file: &mut Vec<u8>, kind: Kind, cells: &[Value]) {
    let values: Vec<&Value> = cells.iter().filter(|cell| !cell.is_empty()).collect();
    let is_held = bits(cells.iter().map(|cell| !cell.is_empty()));
    // One run of groups of eight levels of one bit.
    let mut levels = Vec::new();
    varint(&mut levels, (is_held.len() as u64) << 1 | 1);
    levels.extend(is_held);
    let mut page = (levels.len() as u32).to_le_bytes().to_vec();
    page.extend(levels);
    match kind {
        Kind::Flag => page.extend(bits(values.iter().map(|value| **value == Value::Flag(true)))),
        Kind::Count => values.iter().for_each(|value| page.extend(count(value).to_le_bytes())),
        Kind::Number => values.iter().for_each(|value| page.extend(number(value).to_le_bytes())),
        Kind::Text => values.iter().for_each(|value| {
            let text = text(value);
            page.extend((text.len() as u32).to_le_bytes());
            page.extend(text.bytes());
        }),
    }
    let mut data = Compact::default();
    data.int(1, Compact::I32, cells.len() as i64);
    data.int(2, Compact::I32, PLAIN);
    data.int(3, Compact::I32, RLE);
    data.int(4, Compact::I32, RLE);
    let mut header = Compact::default();
    let data_page = 0;
    header.int(1, Compact::I32, data_page);
    header.int(2, Compact::I32, page.len() as i64);
    header.int(3, Compact::I32, page.len() as i64);
    header.structure(5, data);
    file.extend(header.end());
    file.extend(page);
}

/// The count of a cell in a column of counts.
fn count(value: &Value) -> i64 {
    match value {
        Value::Count(count) => *count as i64,
        other => number(other) as i64,
    }
}

/// The number of a cell in a column of numbers.
fn number(value: &Value) -> f64 {
    match value {
        Value::Number(number) => *number,
        Value::Count(count) => *count as f64,
        Value::Flag(_) | Value::Text(_) | Value::List(_) | Value::Empty => f64::NAN,
    }
}

/// The text of a cell in a column of names, as CSV has it.
fn text(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        Value::List(names) => names.join("; "),
        Value::Number(number) => number.to_string(),
        Value::Count(count) => count.to_string(),
        Value::Flag(flag) => flag.to_string(),
        Value::Empty => String::new(),
    }
}

/// Bits in bytes, the first one lowest.
fn bits(flags: impl Iterator<Item = bool>) -> Vec<u8> {
    let flags: Vec<bool> = flags.collect();
    let byte = |part: &[bool]| part.iter().rev().fold(0, |byte, &flag| byte << 1 | u8::from(flag));
    flags.chunks(8).map(byte).collect()
}

/// A number in as many bytes as it needs.
fn varint(bytes: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        bytes.push(value as u8 | 0x80);
        value >>= 7;
    }
    bytes.push(value as u8);
}

/// A structure in Thrift's compact protocol; fields are added by growing number.
#[derive(Default)]
struct Compact {
    bytes: Vec<u8>,
    last: u8,
}

impl Compact {
    const I32: u8 = 5;
    const I64: u8 = 6;
    const BINARY: u8 = 8;
    const LIST: u8 = 9;
    const STRUCT: u8 = 12;

    fn field(&mut self, id: u8, kind: u8) {
        self.bytes.push((id - self.last) << 4 | kind);
        self.last = id;
    }

    fn int(&mut self, id: u8, kind: u8, value: i64) {
        self.field(id, kind);
        self.push_int(value);
    }

    fn push_int(&mut self, value: i64) {
        varint(&mut self.bytes, (value << 1 ^ value >> 63) as u64);
    }

    fn text(&mut self, id: u8, text: &str) {
        self.field(id, Self::BINARY);
        self.push_text(text);
    }

    fn push_text(&mut self, text: &str) {
        varint(&mut self.bytes, text.len() as u64);
        self.bytes.extend(text.bytes());
    }

    fn structure(&mut self, id: u8, value: Self) {
        self.field(id, Self::STRUCT);
        self.bytes.extend(value.end());
    }

    fn list(&mut self, id: u8, kind: u8, count: usize) {
        /// From so many on the length has bytes of its own.
        const LONG: usize = 15;
        self.field(id, Self::LIST);
        self.bytes.push((count.min(LONG) as u8) << 4 | kind);
        if count >= LONG {
            varint(&mut self.bytes, count as u64);
        }
    }

    fn structs(&mut self, id: u8, values: &[Self]) {
        self.list(id, Self::STRUCT, values.len());
        for value in values {
            self.bytes.extend(&value.bytes);
            self.bytes.push(0);
        }
    }

    fn ints(&mut self, id: u8, values: &[i64]) {
        self.list(id, Self::I32, values.len());
        values.iter().for_each(|value| self.push_int(*value));
    }

    fn texts(&mut self, id: u8, values: &[&str]) {
        self.list(id, Self::BINARY, values.len());
        values.iter().for_each(|value| self.push_text(value));
    }

    /// Its bytes.
    fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of the specification of varints, and zigzag.
    #[test]
    fn numbers_take_as_many_bytes_as_they_need() {
        let mut bytes = Vec::new();
        varint(&mut bytes, 300);
        assert_eq!(bytes, [0xac, 0x02]);
        let mut fields = Compact::default();
        fields.int(1, Compact::I32, -1);
        fields.int(10, Compact::I64, 64);
        assert_eq!(fields.end(), [0x15, 1, 0x96, 0x80, 1, 0]);
    }

    #[test]
    fn flags_are_bits_the_first_lowest() {
        assert_eq!(bits([true, false, true].into_iter()), [0b101]);
        assert_eq!(bits([false; 8].into_iter().chain([true])), [0, 1]);
    }

    #[test]
    fn a_page_says_which_cells_are_empty() {
        let mut file = Vec::new();
        let cells = [Value::from(1.5), Value::Empty, Value::from(f64::INFINITY)];
        write_page(&mut file, Kind::Number, &cells);
        let page =
            [&[2, 0, 0, 0, 3, 0b101][..], &1.5f64.to_le_bytes(), &f64::INFINITY.to_le_bytes()].concat();
        assert!(file.ends_with(&page), "{file:?}");
    }
}
