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

/// The tables of all cases of a comparison as files in a format; `stem` begins their names.
///
/// # Errors
/// Results that have no table; see [`interface_tables`].
pub fn interface_files(
    results: &dyn asperity_contact_framework::Outcome,
    stem: &str,
    options: InterfaceOptions,
    format: Format,
    units: UnitSystem,
) -> Result<Vec<ExportedFile>, String> {
    let tables = interface_tables(results, options)?;
    let several = tables.len() > 1;
    let files = tables.iter().flat_map(|table| {
        let name = if several { format!("{stem}-{}", table.case) } else { stem.to_owned() };
        formats::files(table, &name, format, units)
    });
    Ok(files.collect())
}
