//! Tables: rows to CSV, with the header also where there is no row.

use serde::Serialize;

/// A table that cannot be written: a value that CSV cannot hold.
pub type TableError = csv::Error;

/// A row of a table: a struct whose fields name the columns in `COLUMNS`.
#[macro_export]
macro_rules! row {
    (struct $name:ident { $($field:ident: $kind:ty,)* }) => {
        #[derive(serde::Serialize)]
        pub(crate) struct $name { $(pub(crate) $field: $kind,)* }

        impl $name {
            pub(crate) const COLUMNS: &'static [&'static str] = &[$(stringify!($field)),*];
        }
    };
}

/// A CSV that has its header also when it has no rows.
pub struct Table(csv::Writer<Vec<u8>>);

impl Table {
    /// A table with these groups of columns.
    ///
    /// # Errors
    /// See [`TableError`]; the same holds for every method.
    pub fn new(columns: &[&[&str]]) -> Result<Self, TableError> {
        let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
        writer.write_record(columns.concat())?;
        Ok(Self(writer))
    }

    /// Adds a row, a struct or a tuple of them, field by field.
    pub fn row(&mut self, row: impl Serialize) -> Result<(), TableError> {
        self.0.serialize(row)
    }

    /// The file.
    pub fn bytes(self) -> Result<Vec<u8>, TableError> {
        self.0.into_inner().map_err(|error| error.into_error().into())
    }
}
