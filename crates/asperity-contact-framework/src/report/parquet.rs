//! A table as Apache Parquet: one column for each; what is empty is null.

use std::sync::Arc;

use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::Type;
use serde_json::{Map, json};

use super::PROGRAM;
use super::table::{Heading, Table, Value};

/// The type of the values of a column, by its unit, as its CSV file is read.
fn physical(heading: &Heading) -> Physical {
    match heading.unit {
        "text" => Physical::BYTE_ARRAY,
        "true/false" => Physical::BOOLEAN,
        "count" => Physical::INT64,
        _ => Physical::DOUBLE,
    }
}

/// The name of the file of a table, next to its CSV file.
pub fn file_name(table: &Table) -> String {
    let name = table.schema.file;
    format!("{}.parquet", name.strip_suffix(".csv").unwrap_or(name))
}

/// The file of a table; numbers are those of the CSV file, to the bit. Units and meanings are the key `columns` of its metadata.
///
/// # Errors
/// None that a table can cause.
pub fn parquet(table: &Table) -> Result<Vec<u8>, ParquetError> {
    let field = |heading: &Heading| {
        let text = (heading.unit == "text").then_some(LogicalType::String);
        let field = Type::primitive_type_builder(&heading.name, physical(heading));
        field.with_repetition(Repetition::OPTIONAL).with_logical_type(text).build().map(Arc::new)
    };
    let fields = table.schema.columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("table").with_fields(fields).build()?;
    let meaning = |heading: &Heading| {
        (heading.name.clone(), json!({ "unit": heading.unit, "meaning": heading.meaning }))
    };
    let meanings: Map<_, _> = table.schema.columns.iter().map(meaning).collect();
    let notes = [("rows", table.schema.rows.to_owned()), ("columns", json!(meanings).to_string())];
    let notes = notes.map(|(key, value)| KeyValue::new(key.to_owned(), value));
    let properties = WriterProperties::builder()
        .set_created_by(format!("{PROGRAM} version {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(notes.to_vec()));
    let mut file = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    for (heading, cells) in table.columns() {
        let Some(mut column) = group.next_column()? else { break };
        match physical(heading) {
            Physical::BOOLEAN => {
                write::<BoolType>(&mut column, cells, |cell| *cell == Value::Flag(true))?;
            }
            Physical::INT64 => write::<Int64Type>(&mut column, cells, count)?,
            Physical::BYTE_ARRAY => write::<ByteArrayType>(&mut column, cells, text)?,
            _ => write::<DoubleType>(&mut column, cells, number)?,
        }
        column.close()?;
    }
    group.close()?;
    file.into_inner()
}

/// The cells of a column: which of them hold a value, and the values.
fn write<T: DataType>(
    column: &mut SerializedColumnWriter,
    cells: &[Value],
    value: impl Fn(&Value) -> T::T,
) -> Result<(), ParquetError> {
    let values: Vec<T::T> = cells.iter().filter(|cell| !cell.is_empty()).map(value).collect();
    let is_held: Vec<i16> = cells.iter().map(|cell| i16::from(!cell.is_empty())).collect();
    column.typed::<T>().write_batch(&values, Some(&is_held), None).map(|_| ())
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
fn text(value: &Value) -> ByteArray {
    let text = match value {
        Value::Text(text) => text.clone(),
        Value::List(names) => names.join("; "),
        Value::Number(number) => number.to_string(),
        Value::Count(count) => count.to_string(),
        Value::Flag(flag) => flag.to_string(),
        Value::Empty => String::new(),
    };
    ByteArray::from(text.into_bytes())
}

#[cfg(test)]
mod tests {
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::Field;

    use super::*;

    #[test]
    fn cells_are_read_back_and_empty_ones_are_null() {
        let heading = |name: &str, unit| Heading::of_key(name, unit);
        let numbers = vec![Value::from(0.1 + 0.2), Value::Empty, Value::from(f64::INFINITY)];
        let names = vec![Value::from("a, b"), Value::from(""), Value::from("c")];
        let flags = vec![Value::from(true), Value::from(false), Value::Empty];
        let counts = vec![Value::from(3usize), Value::Empty, Value::from(0usize)];
        let columns = [
            (heading("load_n", "N"), numbers),
            (heading("name", "text"), names),
            (heading("is_one", "true/false"), flags),
            (heading("count", "count"), counts),
        ];
        let bytes = parquet(&Table::from_columns("t.csv", "One row for each.", columns)).unwrap();
        let file = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
        let notes = file.metadata().file_metadata().key_value_metadata().unwrap();
        assert!(
            notes
                .iter()
                .any(|note| note.key == "columns" && note.value.as_ref().unwrap().contains("\"unit\":\"N\""))
        );
        let rows: Vec<Vec<Field>> = file
            .get_row_iter(None)
            .unwrap()
            .map(|row| row.unwrap().get_column_iter().map(|(_, field)| field.clone()).collect())
            .collect();
        let text = |text: &str| Field::Str(text.to_owned());
        let expected = [
            vec![Field::Double(0.1 + 0.2), text("a, b"), Field::Bool(true), Field::Long(3)],
            vec![Field::Null, Field::Null, Field::Bool(false), Field::Null],
            vec![Field::Double(f64::INFINITY), text("c"), Field::Null, Field::Long(0)],
        ];
        assert_eq!(rows, expected);
    }
}
