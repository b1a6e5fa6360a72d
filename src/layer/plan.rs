//! A layer on one of the bodies.

use std::fmt;

use asperity::law::Body;
use asperity::layer::Coating;
use asperity::{LayerError, Material, ModulusModel};
use asperity_contact_framework::input::{InputError, Source, Spanned, SpecFile};
use asperity_contact_framework::report::format::input_quantity;

use crate::layer::spec::LayerSpec;

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

    /// The body that the layer is on.
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

/// Resolves a layer on `substrate`.
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
