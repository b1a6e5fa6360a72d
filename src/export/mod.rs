//! Results for other programs: `experiment export`.

mod formats;
mod patches;
mod surface;

pub use formats::{
    Format, InterfaceOptions, InterfaceTable, InterfaceValue, Interfaces, TableModel, TablePoint, UnitSystem,
    interface_tables,
};
pub use patches::{ExportedContact, ExportedContacts};
pub use surface::{ExportedAsperities, ExportedMap, ExportedSurface, SurfaceChoice};

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportedFile {
    pub name: String,
    pub text: String,
}

/// Tables of joints as files in a format; `stem` begins their names.
pub fn interface_files(
    tables: &[InterfaceTable],
    stem: &str,
    format: Format,
    units: UnitSystem,
) -> Vec<ExportedFile> {
    let mut names: Vec<String> = Vec::new();
    let mut files = Vec::new();
    for table in tables.iter().filter(|table| !table.points.is_empty()) {
        let mut name =
            identifier(&if tables.len() > 1 { format!("{stem}-{}", table.case) } else { stem.to_owned() });
        if names.contains(&name) {
            name = format!("{name}-{}", names.len() + 1);
        }
        files.extend(formats::files(table, &name, format, units));
        names.push(name);
    }
    files
}

/// A name of ASCII letters, digits, dashes and underscores that begins with a letter, as all programs read it: "10 MPa, 2 µm" is
/// "j-10-MPa-2-um".
fn identifier(name: &str) -> String {
    let letters = name.replace('µ', "u");
    let words = letters.split(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '-');
    let made = words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-");
    if made.starts_with(|c: char| c.is_ascii_alphabetic()) { made } else { format!("j-{made}") }
}

#[cfg(test)]
mod tests {
    use super::identifier;

    #[test]
    fn names_are_those_of_all_programs() {
        assert_eq!(identifier("joint-ground, law zmc"), "joint-ground-law-zmc");
        assert_eq!(identifier("10 MPa, 1.5 µm"), "j-10-MPa-1-5-um");
        assert_eq!((identifier("Fläche").as_str(), identifier("").as_str()), ("Fl-che", "j-"));
    }
}
