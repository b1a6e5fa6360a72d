//! `experiment surface FILE`: options of the command line, with bodies, layer and load, as a spec that compares both models on the surface.

use std::path::Path;

use asperity::law::Body;
use asperity_contact_framework::input::{InputError, Source};

/// Options of a measured file, as in a spec.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(clap::Args))]
pub struct FileOptions {
    /// Pixel size, if the file does not contain it: "0.8 um", or "0.8 um, 0.5 um" along x and y. The first index of a .npy is x;
    /// in a text x runs along a line and y from line to line
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub pixel: Option<String>,
    /// Unit of the lengths in the file, if it does not contain it: um, or "xy=um, z=nm" of coordinates and heights
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub unit: Option<String>,
    /// Heights, in the unit of the file, and words that mark missing points: -9999, or "-9999, void"; none where all are heights
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub missing: Option<String>,
    /// Channel of a file that holds several, by its name there; default: that of the heights
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub channel: Option<String>,
    /// Part of the map to use along x, from and to, from its first point: "10 um, 200 um"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true, value_name = "FROM, TO"))]
    pub crop_x: Option<String>,
    /// The same along y
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true, value_name = "FROM, TO"))]
    pub crop_y: Option<String>,
    /// Exchange x and y of the file; the pixel is then that of the exchanged map
    #[cfg_attr(feature = "cli", arg(long))]
    pub transpose: bool,
    /// Find the preparation that makes the map fit: remedies of failed checks, one after the other; options below are kept
    #[cfg_attr(feature = "cli", arg(long))]
    pub fit: bool,
    /// What becomes of spikes: keep, remove
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true, value_name = "keep|remove"))]
    pub outliers: Option<String>,
    /// Axis along which lines of the scan are set to the same mean height: x, y
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true, value_name = "x|y"))]
    pub align_lines: Option<String>,
    /// Radius of the stylus or tip that traced the map, which is eroded: "5 um"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub tip: Option<String>,
    /// Form to remove: none, mean, plane, quadratic, cubic
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub level: Option<String>,
    /// S filter (ISO 16610-61), removes shorter wavelengths: "2.5 um"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub s: Option<String>,
    /// L filter (ISO 16610-61), removes longer wavelengths: "80 um"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub l: Option<String>,
    /// Number of neighbours that a summit must exceed: four, eight
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true, value_name = "four|eight"))]
    pub neighbours: Option<String>,
    /// Another key of the spec: compare.law=hertz, 'material.PTFE.hardness="50 MPa"'; may be given several times
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true, value_name = "KEY=VALUE"))]
    pub set: Vec<String>,
    /// Bodies, layer and load.
    #[cfg_attr(feature = "cli", arg(skip))]
    pub contact: ContactOptions,
}

impl FileOptions {
    /// Refuses options that contradict each other.
    pub fn check(&self) -> Result<(), InputError> {
        let is_path = |path: &str| path.starts_with("compare.") || path.starts_with("material.");
        let is_set = |set: &&String| set.split_once('=').is_some_and(|(path, _)| is_path(path));
        if let Some(set) = self.set.iter().find(|set| !is_set(set)) {
            return Err(InputError::file(
                Path::new(&typed("set", set)),
                "found no key of [compare] or [material]; allowed: PATH=VALUE, such as compare.law=hertz or 'material.PTFE.hardness=\"50 MPa\"'",
            ));
        }
        for (axis, ends) in ["x", "y"].into_iter().zip([&self.crop_x, &self.crop_y]) {
            let Some(ends) = ends.as_ref().filter(|ends| ends.split(',').count() != 2) else { continue };
            return Err(InputError::file(
                Path::new(&typed(&format!("crop-{axis}"), ends)),
                "found no pair of lengths; allowed: from and to with a comma between them, such as \"10 um, 200 um\"",
            ));
        }
        self.contact.check()
    }

    /// The keys of a table that are set, as lines of a spec.
    fn set_in<'a>(&'a self, table: &'a str) -> impl Iterator<Item = (String, String)> + 'a {
        self.set.iter().filter_map(move |set| {
            let (key, value) = set.strip_prefix(table)?.split_once('=')?;
            let value = value.trim();
            // A bare word is a text.
            let is_value = format!("v = {value}").parse::<toml::Table>().is_ok();
            let value = if is_value { value.to_owned() } else { quoted(value) };
            Some((format!("{} = {value}", key.trim()), typed("set", set)))
        })
    }

    /// The spec that describes the file at `path`; its errors cite these options as they were typed.
    pub fn source(&self, path: &Path) -> Source {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("surface");
        let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        let name: String = stem.chars().map(|c| if is_plain(c) { c } else { '-' }).collect();
        let file = path.to_string_lossy().into_owned();
        let of_file = |line: String| (line, file.clone());
        let mut lines = vec![of_file(format!("title = {}", quoted(&format!("The surface {stem}"))))];
        lines.extend(self.contact.materials());
        lines.extend(self.set_in("material.").map(|(line, option)| (format!("material.{line}"), option)));
        lines.push(of_file("[compare]".to_owned()));
        let set: Vec<(String, String)> = self.set_in("compare.").collect();
        let mut compare = self.contact.bodies();
        compare.push(of_file("law = \"zmc\"".to_owned()));
        compare.extend(self.contact.loads());
        compare.push(of_file("separation = { from = 4, to = 0, points = 41 }".to_owned()));
        let is_set = |line: &str| {
            let key = |line: &str| line.split([' ', '.']).next().map(str::to_owned);
            set.iter().any(|(other, _)| key(other) == key(line))
        };
        compare.retain(|(line, _)| !is_set(line));
        lines.extend(compare.into_iter().chain(set.iter().cloned()));
        lines.push(of_file(format!("[surface.{}.file]", quoted(&name))));
        lines.push(of_file(format!("path = {}", quoted(&file))));
        let one = |key: &str, given: &Option<String>, value: fn(&str) -> String| {
            given.as_ref().map(|given| (format!("{key} = {}", value(given)), typed(key, given)))
        };
        lines.extend(one("pixel", &self.pixel, pixels));
        lines.extend(one("unit", &self.unit, units));
        lines.extend(one("missing", &self.missing, numbers));
        lines.extend(one("channel", &self.channel, quoted));
        let ends = |ends: &str| format!("[{}]", written_sizes(ends).join(", "));
        let crop = [("x", "crop-x", &self.crop_x), ("y", "crop-y", &self.crop_y)];
        lines.extend(table("crop", crop, ends));
        if self.transpose {
            lines.push(("transpose = true".to_owned(), "--transpose".to_owned()));
        }
        if self.fit {
            lines.push(("fit = \"auto\"".to_owned(), "--fit".to_owned()));
        }
        lines.extend(one("outliers", &self.outliers, quoted));
        lines.extend(one("align-lines", &self.align_lines, quoted));
        lines.extend(one("level", &self.level, quoted));
        lines.extend(one("neighbours", &self.neighbours, quoted));
        lines.extend(one("tip", &self.tip, written));
        lines.extend(table("filter", [("s", "s", &self.s), ("l", "l", &self.l)], written));
        Source::command_line(lines)
    }

    /// The spec of the file at `path`, to be saved at `spec`: the file is named relative to it where it stands below.
    pub fn saved_spec(&self, path: &Path, spec: &Path) -> String {
        let whole = |path: &Path| std::fs::canonicalize(path).ok();
        let folder = spec.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let Some((file, folder)) = whole(path).zip(whole(folder)) else { return self.source(path).text };
        self.source(file.strip_prefix(&folder).unwrap_or(&file)).text
    }
}

/// The name that results on a file take of it: without its ending, unless that is a number, as instruments count files.
pub fn file_name(path: &Path) -> String {
    let is_number = |ending: &&std::ffi::OsStr| ending.as_encoded_bytes().iter().all(u8::is_ascii_digit);
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    match path.extension().filter(is_number) {
        Some(number) => format!("{stem}-{}", number.to_string_lossy()),
        None => stem,
    }
}

/// A line of the command line: an option and its value.
pub(super) fn typed(option: &str, value: &str) -> String {
    format!("--{option} \"{value}\"")
}

/// A text as a value of a spec.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// A quantity as a value of a spec, where a bare number is in SI.
pub(super) fn written(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => format!("{number:e}"),
        _ => quoted(text),
    }
}

/// A unit, or a table of those named by axis: `xy=um, z=nm`, or as a spec has it.
fn units(text: &str) -> String {
    if text.trim_start().starts_with('{') && format!("v = {text}").parse::<toml::Table>().is_ok() {
        return text.to_owned();
    }
    let part = |part: &str| {
        let (axes, unit) = part.split_once('=')?;
        let axes = axes.trim();
        let is_key = !axes.is_empty() && axes.chars().all(|c| c.is_ascii_alphanumeric());
        is_key.then(|| format!("{axes} = {}", quoted(unit.trim())))
    };
    let parts: Option<Vec<String>> = text.split(',').map(part).collect();
    parts.map_or_else(|| quoted(text), |parts| format!("{{ {} }}", parts.join(", ")))
}

/// The numbers and words between commas; an empty list of "none".
fn numbers(text: &str) -> String {
    if text.trim() == "none" {
        return "[]".to_owned();
    }
    let mark = |part: &str| match part.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => format!("{number:?}"),
        _ => quoted(part.trim()),
    };
    let marks: Vec<String> = text.split(',').map(mark).collect();
    if marks.len() == 1 { marks.concat() } else { format!("[{}]", marks.join(", ")) }
}

/// A table of those of some keys that are given, each by an option, and what was typed.
fn table(
    name: &str,
    keys: [(&str, &str, &Option<String>); 2],
    value: impl Fn(&str) -> String,
) -> Option<(String, String)> {
    let given = || keys.iter().filter_map(|(key, option, given)| Some((key, option, given.as_ref()?)));
    given().next()?;
    let values: Vec<String> = given().map(|(key, _, given)| format!("{key} = {}", value(given))).collect();
    let options: Vec<String> = given().map(|(_, option, given)| typed(option, given)).collect();
    Some((format!("{name} = {{ {} }}", values.join(", ")), options.join(" ")))
}

fn pixels(text: &str) -> String {
    match &written_sizes(text)[..] {
        [one] => one.clone(),
        several => format!("[{}]", several.join(", ")),
    }
}

/// The sizes between commas, as values of a spec.
fn written_sizes(text: &str) -> Vec<String> {
    sizes(text).iter().map(|size| written(size)).collect()
}

/// The sizes between commas. A comma right between two digits of which the first belongs to a number without a point is
/// a decimal comma, and stays, so that the error names it: nobody has pixels of whole metres.
fn sizes(pixel: &str) -> Vec<String> {
    let mut sizes: Vec<String> = Vec::new();
    for part in pixel.split(',') {
        match sizes.last_mut() {
            Some(last) if is_whole(last) && part.starts_with(|c: char| c.is_ascii_digit()) => {
                last.push(',');
                last.push_str(part.trim_end());
            }
            _ => sizes.push(part.trim().to_owned()),
        }
    }
    sizes
}

fn is_whole(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_digit())
}

/// Bodies, layer and load on a measured file, as in a spec.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(clap::Args))]
pub struct ContactOptions {
    /// Material of both bodies, a name of the library (`experiment materials`); default: steel-100Cr6
    #[cfg_attr(feature = "cli", arg(long))]
    pub material: Option<String>,
    /// Material of the rough body, which the file describes
    #[cfg_attr(feature = "cli", arg(long))]
    pub rough: Option<String>,
    /// Material of the flat
    #[cfg_attr(feature = "cli", arg(long))]
    pub flat: Option<String>,
    /// Material of a layer on the flat (or by --layer-on on the rough body), with --thickness
    #[cfg_attr(feature = "cli", arg(long))]
    pub layer: Option<String>,
    /// Thickness of the layer: "2 um"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub thickness: Option<String>,
    /// Body that the layer is on: flat, rough; default: flat
    #[cfg_attr(feature = "cli", arg(long, value_name = "BODY"))]
    pub layer_on: Option<String>,
    /// Force, on --area or else on the map's own area: "5 N"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub load: Option<String>,
    /// Nominal area that --load acts on: "4 mm2"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub area: Option<String>,
    /// Nominal pressure, instead of --load: "1.25 MPa"
    #[cfg_attr(feature = "cli", arg(long, allow_hyphen_values = true))]
    pub pressure: Option<String>,
    /// Whether boundary elements run beside both models.
    #[cfg_attr(feature = "cli", arg(skip))]
    pub reference: bool,
}

/// The material of both bodies where none is named.
const MATERIAL: &str = "steel-100Cr6";

/// A line of a spec, and the option that it stands for.
type Line = (String, String);

impl ContactOptions {
    /// Refuses options that contradict each other.
    pub fn check(&self) -> Result<(), InputError> {
        const TWO_LOADS: &str = "found together with --pressure; allowed: one of --load and --pressure";
        const NO_LOAD: &str = "found without a load; allowed: beside --load, which acts on it, or --pressure, whose force it gives";
        const NO_LAYER: &str = "found without a layer; allowed: beside --layer MATERIAL";
        const NO_BODY: &str = "found no body; allowed: \"flat\", \"rough\"";
        const NO_THICKNESS: &str =
            "found without its thickness; allowed: beside --thickness, such as \"2 um\"";
        const NO_BODY_LEFT: &str = "found together with --rough and --flat, which leave it no body; allowed: two of the three at most";
        let Self { material, rough, flat, layer, thickness, layer_on, load, area, pressure, .. } = self;
        let is_no_body = |name: &String| Body::ALL.iter().all(|body| body.name() != name.as_str());
        let conflicts = [
            ("load", load, pressure.is_some(), TWO_LOADS),
            ("area", area, load.is_none() && pressure.is_none(), NO_LOAD),
            ("thickness", thickness, layer.is_none(), NO_LAYER),
            ("layer-on", layer_on, layer.is_none(), NO_LAYER),
            ("layer-on", layer_on, layer_on.as_ref().is_some_and(is_no_body), NO_BODY),
            ("layer", layer, thickness.is_none(), NO_THICKNESS),
            ("material", material, rough.is_some() && flat.is_some(), NO_BODY_LEFT),
        ];
        for (option, given, is_conflict, message) in conflicts {
            if let Some(given) = given.as_deref().filter(|_| is_conflict) {
                return Err(InputError::file(Path::new(&typed(option, given)), message));
            }
        }
        Ok(())
    }

    pub(super) fn materials(&self) -> Vec<Line> {
        let mut named: Vec<(&str, &str)> = Vec::new();
        for (name, option) in [self.rough(), self.flat()].into_iter().chain(self.layer()) {
            if named.iter().all(|(other, _)| *other != name) {
                named.push((name, option));
            }
        }
        let line = |(name, option): (&str, &str)| {
            (format!("material.{}.from = {}", quoted(name), quoted(name)), typed(option, name))
        };
        named.into_iter().map(line).collect()
    }

    /// `rough`, `flat` and `layer`.
    pub(super) fn bodies(&self) -> Vec<Line> {
        let body = |key: &str, (name, option): (&str, &str)| {
            (format!("{key} = {}", quoted(name)), typed(option, name))
        };
        let mut lines = vec![body("rough", self.rough()), body("flat", self.flat())];
        if let Some(((name, _), thickness)) = self.layer().zip(self.thickness.as_deref()) {
            let on = self.layer_on.as_deref().map_or_else(String::new, |on| format!(", on = {}", quoted(on)));
            let line =
                format!("layer = {{ material = {}, thickness = {}{on} }}", quoted(name), written(thickness));
            lines.push((line, typed("thickness", thickness)));
        }
        lines
    }

    /// `models`, where boundary elements run, `force`, `pressure` and `nominal-area`.
    pub(super) fn loads(&self) -> Vec<Line> {
        let Self { load, pressure, area, .. } = self;
        let given =
            [("force", "load", load), ("pressure", "pressure", pressure), ("nominal-area", "area", area)];
        let line = |(key, option, given): (&str, &str, &Option<String>)| {
            let given = given.as_deref()?;
            Some((format!("{key} = {}", written(given)), typed(option, given)))
        };
        let models = r#"models = ["statistical", "deterministic", "reference"]"#;
        let reference = self.reference.then(|| (models.to_owned(), "--reference".to_owned()));
        reference.into_iter().chain(given.into_iter().filter_map(line)).collect()
    }

    /// The material of the rough body, and the option that names it.
    fn rough(&self) -> (&str, &'static str) {
        self.rough.as_deref().map_or_else(|| self.of_both(), |name| (name, "rough"))
    }

    fn flat(&self) -> (&str, &'static str) {
        self.flat.as_deref().map_or_else(|| self.of_both(), |name| (name, "flat"))
    }

    fn layer(&self) -> Option<(&str, &'static str)> {
        Some((self.layer.as_deref()?, "layer"))
    }

    fn of_both(&self) -> (&str, &'static str) {
        (self.material.as_deref().unwrap_or(MATERIAL), "material")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_and_marks_are_values_of_a_spec() {
        for (found, value) in [
            (units("um"), "\"um\""),
            (units("xy=um,z=nm"), "{ xy = \"um\", z = \"nm\" }"),
            (units("z = nm, xy = um"), "{ z = \"nm\", xy = \"um\" }"),
            (units("{ xy = \"um\", z = \"nm\" }"), "{ xy = \"um\", z = \"nm\" }"),
            (units("xy=um,nm"), "\"xy=um,nm\""),
            (numbers("-9999"), "-9999.0"),
            (numbers("-9999, 1e30"), "[-9999.0, 1e30]"),
            (numbers("none"), "[]"),
            (numbers("nan"), "\"nan\""),
            (numbers("***, -9999"), "[\"***\", -9999.0]"),
            (numbers(""), "\"\""),
        ] {
            assert_eq!(found, value);
        }
    }

    #[test]
    fn a_comma_separates_sizes_unless_it_is_decimal() {
        for (pixel, found) in [
            ("0.8 um", &["0.8 um"][..]),
            ("0.8 um, 0.5 um", &["0.8 um", "0.5 um"]),
            ("0.8um,0.5um", &["0.8um", "0.5um"]),
            ("2e-7,3e-7", &["2e-7", "3e-7"]),
            ("1 um,2 um", &["1 um", "2 um"]),
            ("0,5 um", &["0,5 um"]),
            ("0,8 um, 0,5 um", &["0,8 um", "0,5 um"]),
            ("", &[""]),
        ] {
            assert_eq!(sizes(pixel), found, "{pixel}");
        }
    }
}
