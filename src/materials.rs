//! The library of materials as `experiment materials` prints it: Markdown whose tables are aligned for a terminal.

use std::fmt::Write;

use asperity::material_library::{self, Class, LibraryMaterial, Sourced};
use asperity_contact_framework::report::format::{capitalised, input_number, input_quantity};
use asperity_contact_framework::report::sections::by_source;

/// All materials of the library: their values, then the source of each.
pub fn all_materials() -> String {
    let mut text = String::from(
        "# Materials of the library\n\n\
         `experiment materials` prints this page, `experiment materials NAME` one material. A spec takes a material by its name; \
         other keys beside `from` replace single values:\n\n\
         ```toml\n\
         [material]\n\
         ball = { from = \"steel-100Cr6\" }\n\
         disc = { from = \"steel-C45-normalised\", hardness = \"2.4 GPa\" }   # measured on the part\n\
         ```\n\n\
         Values are typical of the named condition at room temperature; a hardness that was measured on the part in question is \
         better. Annealed metals have no yield strength here: they harden with strain, so that laws that use the hardness and laws \
         that use the 0.2 % proof stress would describe different materials. Sources marked as quoted were not at hand: check their values before you rely on them.\n",
    );
    for class in Class::ALL {
        let of_class: Vec<&LibraryMaterial> =
            material_library::all().filter(|material| material.class == class).collect();
        let _ = write!(text, "\n## {}\n\n{}", capitalised(class.name()), table(&of_class));
    }
    text.push_str("\n## Sources\n\n");
    for material in material_library::all() {
        let sources: Vec<(&str, String)> =
            rows(material).into_iter().map(|row| (row.symbol, row.source)).collect();
        let _ = writeln!(text, "- `{}`: {}.", material.name, by_source(&sources));
    }
    text
}

/// One material of the library, each value with its source.
pub fn one_material(name: &str) -> Result<String, String> {
    let Some(material) = material_library::find(name) else {
        let similar = material_library::similar(name);
        let near =
            if similar.is_empty() { String::new() } else { format!(" (similar: {})", similar.join(", ")) };
        return Err(format!(
            "found the material \"{name}\"; allowed: a name of the library{near}; `experiment materials` lists them"
        ));
    };
    let mut text = format!("{}: {}\n", material.name, material.description);
    for row in rows(material) {
        let _ = writeln!(text, "  {:<21} {:<12} {}", row.key, row.value, row.source);
    }
    let _ = writeln!(text, "In a spec: material.NAME = {{ from = \"{}\" }}", material.name);
    Ok(text)
}

struct Row {
    key: &'static str,
    symbol: &'static str,
    value: String,
    source: String,
}

fn rows(material: &LibraryMaterial) -> Vec<Row> {
    let pressure = |value: Sourced| input_quantity(value.value, "Pa");
    let row = |key, symbol, value, source: Sourced| Row { key, symbol, value, source: source.source() };
    let mut rows = vec![
        row("young", "E", pressure(material.young), material.young),
        row("poisson", "ν", input_number(material.poisson.value), material.poisson),
    ];
    rows.extend(material.hardness.map(|found| row("hardness", "H", pressure(found), found)));
    rows.extend(material.yield_strength.map(|found| row("yield-strength", "Y", pressure(found), found)));
    let resistivity = |found: Sourced| input_quantity(found.value, "ohm m");
    rows.extend(material.resistivity.map(|found| row("resistivity", "ρ", resistivity(found), found)));
    let conductivity = |found: Sourced| format!("{} W/(m K)", input_number(found.value));
    rows.extend(
        material
            .thermal_conductivity
            .map(|found| row("thermal-conductivity", "k", conductivity(found), found)),
    );
    rows
}

fn table(materials: &[&LibraryMaterial]) -> String {
    let mut lines = vec![["name", "what it is", "E", "ν", "H", "Y", "ρ", "k"].map(str::to_owned)];
    lines.extend(materials.iter().map(|material| {
        let value = |key: &str| {
            let row = rows(material).into_iter().find(|row| row.key == key);
            row.map_or_else(|| "–".to_owned(), |row| row.value)
        };
        [
            format!("`{}`", material.name),
            material.description.to_owned(),
            value("young"),
            value("poisson"),
            value("hardness"),
            value("yield-strength"),
            value("resistivity"),
            value("thermal-conductivity"),
        ]
    }));
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; 8] = std::array::from_fn(width);
    let mut text = String::new();
    for (index, line) in lines.iter().enumerate() {
        let cells = line.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}"));
        let _ = writeln!(text, "| {} |", cells.collect::<Vec<_>>().join(" | "));
        if index == 0 {
            let rules = widths.map(|width| "-".repeat(width));
            let _ = writeln!(text, "| {} |", rules.join(" | "));
        }
    }
    text
}
