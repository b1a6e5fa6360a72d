//! Bodies, layer and load of `experiment surface FILE`, as lines of a spec.

use std::path::Path;

use asperity::law::Body;
use asperity_contact_framework::input::InputError;

use super::options::{quoted, typed, written};

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
