//! A layer on the flat or on the rough body: its spec, its plan, and what is cautioned of it.

use std::fmt;

use asperity::compare::{GOOD_RATIO, ModulusFindings};
use asperity::law::Body;
use asperity::layer::Coating;
use asperity::{LayerError, Material, ModulusModel, units};
use asperity_contact_framework::input::bare::{ThicknessOrNone, ThicknessRange};
use asperity_contact_framework::input::quantity::{Length, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{Forms, InputError, Source, Spanned, SpecFile, schema};
use asperity_contact_framework::report::format::{input_quantity, number, quantity};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use crate::study_plan::{Breakdowns, ShearStrengthSpec};

/// A layer on one of the bodies, of one thickness or several.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a layer such as { material = \"lead\", thickness = [0, \"50 nm\", \"inf\"] }"
)]
pub struct LayerSpec {
    /// The name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["lead"]))]
    pub material: Spanned<String>,
    /// One thickness, or several, as an ascending list or spaced by equal ratios; 0 is the bare body, `"inf"` the bulk of the layer.
    #[schemars(extend("examples" = [[0, "50 nm", "inf"], { "from": "10 nm", "to": "10 um", "points": 7 }]))]
    pub thickness: Thicknesses,
    /// The effective-modulus model of layer and substrate.
    #[serde(default)]
    #[schemars(extend("default" = "gao", "examples" = ["series"]))]
    pub rule: ModulusModel,
    /// The body that has the layer. On the rough body it follows the surface, whose heights are those of the coated one; each coated asperity is taken as a layered half-space.
    #[schemars(extend("default" = "flat", "examples" = ["rough"]))]
    pub on: Option<Spanned<Body>>,
    /// Shear strength of the layer, in which spots shear until they break through it; beside that of the interface, `compare.shear-strength`.
    #[schemars(extend("x-default" = "that of the interface", "examples" = [{ "tau0": "8 MPa" }]))]
    pub shear_strength: Option<Spanned<ShearStrengthSpec>>,
    /// Indentation over the thickness of the layer from which on a spot has broken through it and shears as the interface; of several the first
    /// counts for verdicts, and the friction by thickness is shown for each.
    #[schemars(extend("default" = 1, "examples" = [[1, 0.5, 2]]))]
    pub breakdown: Option<Spanned<Breakdowns>>,
}

/// One thickness, m: 0 is uncoated, infinity the bulk layer material.
struct Thickness(f64);

/// What a thickness may be.
fn allowed() -> String {
    let units = units::Dimension::Length;
    format!(
        "0, \"inf\", or a positive finite length such as \"50 nm\" ({}; a bare number is in {})",
        units.documented().join(", "),
        units.si_unit()
    )
}

fn named(text: &str) -> Result<f64, String> {
    match text.trim() {
        "inf" => Ok(f64::INFINITY),
        _ => Quantity::<Length, ThicknessOrNone>::parse(text)
            .map(|length| length.value())
            .map_err(|_| format!("found \"{text}\"; allowed: {}", allowed())),
    }
}

/// The thickness that a number without a unit stands for.
fn bare(value: f64, found: &str) -> Result<f64, String> {
    if value.is_nan() || value < 0.0 {
        return Err(format!("found {value}; allowed: {}", allowed()));
    }
    match value {
        f64::INFINITY => Ok(value),
        value => Quantity::<Length, ThicknessOrNone>::bare(value, found).map(|length| length.value()),
    }
}

impl<'de> Deserialize<'de> for Thickness {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new(&allowed())
            .text(|text| named(text).map(Self))
            .number(|value, found| bare(value, found).map(Self))
            .read(deserializer)
    }
}

/// One thickness or a list of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Thicknesses {
    /// m, ascending, none twice.
    pub values: Vec<f64>,
    /// Whether it is a thickness that stands alone, not in a list.
    pub stands_alone: bool,
}

written_schema!(Thicknesses, |generator| {
    let mut one = schema::quantity::<Length, ThicknessOrNone>();
    one[schema::RANGE] = json!("0, positive, or \"inf\"");
    one["anyOf"][1]["pattern"] = json!(r"^\s*(inf|[-+]?[0-9.]+.*)\s*$");
    let mut thicknesses =
        schema::one_or_many(one, "length, an ascending list, or { from, to, points } spaced by equal ratios");
    let sweep = LogSweep::<Length, ThicknessRange>::json_schema(generator).to_value();
    let tables = sweep["anyOf"].as_array().into_iter().flatten().filter(|form| form["type"] == "object");
    if let Some(forms) = thicknesses["anyOf"].as_array_mut() {
        forms.extend(tables.cloned());
    }
    thicknesses
});

impl<'de> Deserialize<'de> for Thicknesses {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected =
            format!("a thickness ({}), a list of thicknesses, or {{ from, to, points }}", allowed());
        Forms::new(&expected)
            .text(|text| named(text).map(Self::one))
            .number(|value, found| bare(value, found).map(Self::one))
            .list(|list: Vec<Thickness>| {
                Self::several(list.into_iter().map(|thickness| thickness.0).collect())
            })
            .table(|sweep: LogSweep<Length, ThicknessRange>| Self::several(sweep.values))
            .read(deserializer)
    }
}

impl Thicknesses {
    fn one(value: f64) -> Self {
        Self { values: vec![value], stands_alone: true }
    }

    fn several(values: Vec<f64>) -> Result<Self, String> {
        if values.is_empty() {
            return Err("found an empty list; allowed: at least one thickness".to_owned());
        }
        if !values.is_sorted_by(|a, b| a < b) {
            return Err(
                "found thicknesses that are not ascending; allowed: each once, the thinnest first, \"inf\" last"
                    .to_owned(),
            );
        }
        Ok(Self { values, stands_alone: false })
    }
}

/// A layer of one thickness or several.
#[derive(Debug, Clone)]
pub struct LayerPlan {
    pub name: String,
    pub rule: ModulusModel,
    /// Thicknesses, m, ascending; 0 and infinity among them.
    pub thicknesses: Vec<f64>,
    pub on: Body,
    /// The layer in any thickness on its substrate.
    pub coating: Coating,
}

/// A thickness (m) as a spec gives it.
pub fn thickness_words(thickness: f64) -> String {
    match thickness {
        0.0 => "0".to_owned(),
        f64::INFINITY => "inf".to_owned(),
        t if (1e-10..1e-6).contains(&t) => format!("{} nm", (t * 1e13).round() / 1e4),
        t if (1e-6..1e-3).contains(&t) => format!("{} um", (t * 1e10).round() / 1e4),
        t => format!("{t:e} m"),
    }
}

const fn body_words(body: Body) -> &'static str {
    match body {
        Body::Rough => "the rough body",
        Body::Flat => "the flat",
    }
}

impl LayerSpec {
    /// Refuses what only `[compare]` asks of a layer.
    pub fn refuse_shear(&self, source: &Source) -> Result<(), InputError> {
        let span = self.shear_strength.as_ref().map(Spanned::span);
        match span.or_else(|| self.breakdown.as_ref().map(Spanned::span)) {
            Some(span) => Err(source.error_at(
                span,
                "found the shear of a layer, which only a comparison takes; allowed: in the layer of [compare]",
            )),
            None => Ok(()),
        }
    }

    pub fn body(&self) -> Body {
        self.on.as_ref().map_or(Body::Flat, |on| *on.get_ref())
    }
}

impl LayerPlan {
    /// Adds the uncoated body to a layer of finite thickness.
    pub fn add_uncoated(&mut self) {
        if self.thicknesses.iter().all(|&t| t > 0.0 && t.is_finite()) {
            self.thicknesses.insert(0, 0.0);
        }
    }
}

/// "0, 50 nm, inf of lead on the flat, rule gao".
impl fmt::Display for LayerPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let thicknesses: Vec<String> = self.thicknesses.iter().map(|&t| thickness_words(t)).collect();
        let (thicknesses, body) = (thicknesses.join(", "), body_words(self.on));
        write!(f, "{thicknesses} of {} on {body}, rule {}", self.name, self.rule.name())
    }
}

/// What a layer called `name` of this material lacks, or its substrate.
fn one_hardness(name: &str, material: &Material) -> String {
    /// Of the yield strength (Tabor 1951).
    const HARDNESS: f64 = 3.0;
    /// Of a soft polymer, Pa.
    const EXAMPLE: f64 = 5e7;
    if material.hardness().is_some() {
        return "; the substrate has none: give it a `hardness`".to_owned();
    }
    let (hardness, why) = match material.yield_strength() {
        Some(strength) => (HARDNESS * strength, " (three times its yield strength, Tabor 1951)"),
        None => (EXAMPLE, ""),
    };
    format!(
        "; \"{name}\" has none: state it, such as `material.{}.hardness = \"{}\"`{why}",
        if name.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c)) {
            name.to_owned()
        } else {
            format!("{name:?}")
        },
        input_quantity(hardness, "Pa")
    )
}

pub fn layer(file: &SpecFile, spec: &LayerSpec, substrate: &Material) -> Result<LayerPlan, InputError> {
    let name = spec.material.get_ref().clone();
    let material = file.body(&name, spec.material.span())?;
    let coating = Coating::new(material, *substrate, spec.rule).map_err(|error| {
        let remedy = match error {
            LayerError::OneHardness => one_hardness(&name, &material),
            LayerError::Thickness(_) => String::new(),
        };
        file.source.error_at(spec.material.span(), format!("found \"{name}\": {error}{remedy}"))
    })?;
    let thicknesses = spec.thickness.values.clone();
    Ok(LayerPlan { name, rule: spec.rule, thicknesses, on: spec.body(), coating })
}

/// Warns where `rule` is inaccurate for the layer called `layer`; `None` where the moduli are close enough.
pub fn rule_warning(findings: &ModulusFindings, layer: &str, rule: ModulusModel) -> Option<String> {
    if findings.is_good() {
        return None;
    }
    let size = findings.worst_of(rule).map_or_else(String::new, |worst| {
        let direction = if worst.ratio > 1.0 { "stiff" } else { "compliant" };
        format!(
            "; rule `{}` is up to {:.2} times too {direction}, at a/t = {}",
            rule.name(),
            worst.factor(),
            number(worst.contact_ratio)
        )
    });
    let [from, to] = GOOD_RATIO;
    Some(format!(
        "layer {layer}: its modulus is {} times the substrate's; {from} to {to} suit rule `gao`{size}",
        number(findings.modulus_ratio)
    ))
}

/// Contact radius over thickness from which the effective hardness is cautioned: the largest shear stress, 0.48 contact radii deep under a
/// sphere (Hertz; Poisson's ratio 0.3), leaves the layer at about twice as much.
const WIDE: f64 = 1.0;

/// Warns where contacts that may yield are wide against the layer called `layer`; `ratios` are thicknesses (m) and the largest mean contact
/// radius over each. `None` where none is.
pub fn hardness_warning(layer: &str, ratios: impl Iterator<Item = (f64, f64)>) -> Option<String> {
    let wide: Vec<(f64, f64)> = ratios.filter(|(_, ratio)| *ratio >= WIDE).collect();
    let largest = wide.iter().map(|(_, ratio)| *ratio).reduce(f64::max)?;
    let thin = wide.iter().map(|(t, _)| *t).fold(f64::INFINITY, f64::min);
    let thick = wide.iter().map(|(t, _)| *t).fold(0.0, f64::max);
    let of = if thin == thick {
        quantity(thin, "m")
    } else {
        format!("{} to {}", quantity(thin, "m"), quantity(thick, "m"))
    };
    Some(format!(
        "layer {layer} of {of}: contacts are up to {} times as wide as it is thick (a/t); from {WIDE} on shares of yielding are uncertain",
        number(largest)
    ))
}

/// A rough body that has a layer.
#[derive(Debug, Clone, Copy)]
pub struct CoatedSurface<'a> {
    pub name: &'a str,
    /// Mean radius of its asperities, m.
    pub radius: f64,
    /// Sq of its map, m; `None` of a surface without one.
    pub sq: Option<f64>,
}

impl CoatedSurface<'_> {
    /// Warns where the layer called `layer` is, in one of the `thicknesses` (m), too thick to be taken as a layered half-space below each
    /// asperity, or to follow the surface.
    pub fn warnings(self, layer: &str, thicknesses: &[f64]) -> Vec<String> {
        /// Of the mean radius: the layer's lower side then still has nine tenths of the radius of the upper one.
        const THICK: f64 = 0.1;
        let Some(t) = thicknesses.iter().copied().filter(|t| t.is_finite()).reduce(f64::max) else {
            return Vec::new();
        };
        let of = format!("layer {layer} of {} on the rough body, surface {}", quantity(t, "m"), self.name);
        let curved = (t > THICK * self.radius).then(|| {
            format!(
                "{of}: it is {} times as thick as the mean radius, {}; above 0.1 what it changes is uncertain",
                number(t / self.radius),
                quantity(self.radius, "m")
            )
        });
        let filling = self.sq.filter(|sq| t > *sq).map(|sq| {
            format!(
                "{of}: it is {} times as thick as Sq, {}, and may fill valleys; thickness below summits may differ by {} %",
                number(t / sq),
                quantity(sq, "m"),
                number(100.0 * sq / t)
            )
        });
        curved.into_iter().chain(filling).collect()
    }
}
