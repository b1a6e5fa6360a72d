//! The first spec of a file, and the example of whoever has none.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use asperity::topography::read::{LengthUnits, NamedUnits, ReadOptions, UnitOrigin, height_map, metadata};
use asperity::topography::{Level, thumbnail};
use asperity::units::Dimension;
use asperity::{contact_law, material_library};
use asperity_contact_framework::keys::Default;
use asperity_contact_framework::report::format::input_quantity;
use asperity_workbench::engine::Heights;
use asperity_workbench::{Example, Refused};
use serde_json::{Map, Value, json};

use super::view;
use crate::keys::all;
use crate::kind::KINDS;
use crate::surface::FileOptions;

/// The committed fine finish.
pub const EXAMPLE: Example = Example {
    files: &[
        ("measured-fine-finish.toml", include_bytes!("../../experiments/measured-fine-finish.toml")),
        ("surfaces/opd-1.npy", include_bytes!("../../experiments/surfaces/opd-1.npy")),
        ("surfaces/README.md", include_bytes!("../../experiments/surfaces/README.md")),
    ],
};

/// The kind of experiment of a spec, and its title.
pub fn kind(text: &str) -> Option<(String, String)> {
    let table: toml::Table = text.parse().ok()?;
    let title = table.get("title")?.as_str()?.to_owned();
    let kind = KINDS.iter().find(|kind| table.contains_key(kind.name))?;
    Some((kind.name.to_owned(), title))
}

/// The spec of a measured file or of a list of asperities, and the keys that the file leaves to its user.
pub fn spec_of(file: &Path, path: &str) -> Result<(String, Vec<String>), Refused> {
    let options = FileOptions::default();
    let name = |error: &dyn std::fmt::Display| Refused::new(format!("{path} {error}"));
    let text = options.source(Path::new(path)).text;
    if is_list(file) {
        return Ok((
            text.replacen(".file]", ".asperities]", 1).replacen("\npath = ", "\nfile = ", 1),
            vec!["nominal-area".to_owned()],
        ));
    }
    let found = metadata(file).map_err(|error| name(&error))?;
    let mut open = Vec::new();
    if found.pixel.is_none() {
        open.push("pixel".to_owned());
    }
    if !matches!(found.named, NamedUnits::Known(_))
        && found.unit_origin(&ReadOptions::default()) == UnitOrigin::Assumed
    {
        // Coordinates in the file have a unit, too.
        let units = if found.pixel.is_some() && !found.pixel_has_unit {
            &["unit.xy", "unit.z"][..]
        } else {
            &["unit"]
        };
        open.extend(units.iter().map(|&unit| unit.to_owned()));
    }
    Ok((text, open))
}

/// A small picture of a measured file, less its plane.
pub fn picture(file: &Path, most: usize) -> Result<Heights, Refused> {
    let refuse = |error: &dyn std::fmt::Display| Refused::new(error.to_string());
    let found = metadata(file).map_err(|error| refuse(&error))?;
    // A picture has no scale.
    let unit =
        (found.unit_origin(&ReadOptions::default()) == UnitOrigin::Assumed).then_some(LengthUnits::same(1.0));
    let options = ReadOptions { pixel: found.pixel.is_none().then_some([1e-6; 2]), unit };
    let map = height_map(file, options).map_err(|error| refuse(&error))?;
    let small = Level::Plane.apply(&thumbnail(&map, most)).map_err(|error| refuse(&error))?;
    Ok(view::heights(&small, most))
}

/// Whether a file is a list of asperities: a text whose first line names their heights and radii.
fn is_list(file: &Path) -> bool {
    /// As long as a line of names may be, bytes.
    const LINE: u64 = 4096;
    let mut begin = Vec::new();
    let read = File::open(file).and_then(|file| file.take(LINE).read_to_end(&mut begin));
    let first = begin.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let line = String::from_utf8_lossy(first).to_ascii_lowercase();
    read.is_ok() && ["height", "radius"].iter().all(|name| line.contains(name))
}

/// Keys by their names, materials, names of laws, units of length.
pub fn vocabulary() -> Value {
    let key = |key: &asperity_contact_framework::keys::Key| {
        let default = match &key.default {
            Default::Needed => json!("none; it is needed"),
            Default::Is(text) | Default::Words(text) => json!(text),
            Default::Open => Value::Null,
        };
        let fields = json!({
            "meaning": key.meaning,
            "kind": key.kind,
            "unit": key.unit,
            "range": key.range,
            "default": default,
            "examples": key.examples,
            "values": key.values,
        });
        (key.name(), fields)
    };
    let keys: Map<String, Value> = all().iter().map(key).collect();
    let materials: Vec<Value> = material_library::all()
        .map(|material| {
            json!({
                "name": material.name,
                "description": material.description,
                "class": material.class.name(),
                "young": input_quantity(material.young.value, "Pa"),
                "poisson": material.poisson.value,
                "hardness": material.hardness.as_ref().map(|hardness| input_quantity(hardness.value, "Pa")),
            })
        })
        .collect();
    let laws: Vec<[String; 2]> = contact_law::registry()
        .iter()
        .map(|law| {
            let papers: Vec<&str> = law.papers().iter().map(|paper| paper.short).collect();
            [law.name(), format!("{}: {}", law.name(), papers.join(", "))]
        })
        .collect();
    let lengths = Dimension::Length.documented();
    json!({ "keys": keys, "materials": materials, "laws": laws, "lengths": lengths })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_leaves_open_is_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let open = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            spec_of(&path, name).unwrap().1
        };
        let points = "0 0 1\n0 1 2\n0 2 1\n1 0 3\n1 1 1\n1 2 4\n2 0 1\n2 1 5\n2 2 9\n";
        assert_eq!(open("matrix.txt", "1 2 3 4\n4 5 6 3\n7 8 9 2\n2 1 2 1\n"), ["pixel", "unit"]);
        assert_eq!(open("points.xyz", points), ["unit.xy", "unit.z"]);
        assert_eq!(open("unclear.csv", &format!("x [px] y [px] z [um]\n{points}")), ["unit.xy", "unit.z"]);
        assert!(open("named.csv", &format!("x [um] y [um] z [nm]\n{points}")).is_empty());
    }
}
