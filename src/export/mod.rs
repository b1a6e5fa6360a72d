//! Results for other programs: `experiment export`.
//!
//! | module | what it writes |
//! |---|---|
//! | `interface` | pressure, conductance and friction of a joint as a table over its closure |
//! | `formats` | that table as programs for finite elements read it |

mod formats;
mod interface;

pub use formats::{Format, UnitSystem};
pub use interface::{
    InterfaceOptions, InterfaceTable, InterfaceValue, TableModel, TablePoint, interface_tables,
};

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportedFile {
    /// Its name.
    pub name: String,
    /// Its content.
    pub text: String,
}

/// Tables of joints as files in a format; `stem` begins their names.
pub fn interface_files(
    tables: &[InterfaceTable],
    stem: &str,
    format: Format,
    units: UnitSystem,
) -> Vec<ExportedFile> {
    let files = tables.iter().flat_map(|table| {
        let name = if tables.len() > 1 { format!("{stem}-{}", table.case) } else { stem.to_owned() };
        formats::files(table, &name, format, units)
    });
    files.collect()
}
