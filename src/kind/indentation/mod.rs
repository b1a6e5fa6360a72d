//! `[indentation]`: one sphere on a layered flat.

mod outline;
mod rows;

use std::fmt;
use std::path::PathBuf;

use asperity::law::Body;
use asperity::numeric::is_positive;
use asperity::{ContactLaw, Inapplicable, Material};
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::quantity::{Length, Quantity};
use asperity_contact_framework::input::sweep::LogSweep;
use asperity_contact_framework::input::{InputError, OneOrMany, Spanned, SpecFile, schema};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory, Outcome, Plan, Reads, RunContext, written_schema};
use outline::OverlayPlan;
pub use rows::{IndentationResults, LawCurves, LayerResults};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

use crate::layer::{LayerPlan, LayerSpec, layer};
use crate::presentation::SphereFigure;

pub struct Indentation;

impl Kind for Indentation {
    const NAME: &'static str = "indentation";
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = IndentationSpec;
    type Plan = IndentationPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<IndentationPlan, InputError> {
        let raw = table.get_ref();
        let body =
            |name: &Spanned<String>| Ok((name.get_ref().clone(), file.body(name.get_ref(), name.span())?));
        let (ball, flat) = (body(&raw.ball)?, body(&raw.flat)?);
        let radius = raw.radius.value();
        let layers = raw.layer.get_ref().0.iter().map(|raw| layer(file, raw, &flat.1));
        let layers = layers.collect::<Result<Vec<_>, _>>()?;
        refuse_coated_ball(file, raw)?;
        raw.layer.get_ref().0.iter().try_for_each(|layer| layer.refuse_shear(&file.source))?;
        check_layers(file, raw, &layers)?;
        let indentations = file.growing(&raw.indentation)?;
        let last = indentations[indentations.len() - 1];
        if last > radius {
            let message =
                format!("found an indentation of {last:e} m; allowed: at most the radius, {radius:e} m");
            return Err(file.source.error_at(raw.indentation.span(), message));
        }
        check_laws(file, raw, &ball, &flat, &layers)?;
        let overlay =
            raw.overlay.as_ref().map(|overlay| OverlayPlan::new(&file.source, overlay)).transpose()?;
        let laws = raw.law.get_ref().0.clone();
        let IndentationSpec { show, figure_of_paper, .. } = *raw;
        let plan = IndentationPlan {
            ball,
            radius,
            flat,
            layers,
            laws,
            indentations,
            overlay,
            show,
            figure_of_paper,
        };
        check_overlay(file, raw, &plan)?;
        Ok(plan)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for IndentationPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        self.overlay.iter().map(|overlay| overlay.path.clone()).collect()
    }

    fn memory(&self) -> Memory {
        const BYTES_PER_POINT: u128 = 64;
        Memory { bytes: self.work() * BYTES_PER_POINT, key: None }
    }

    /// Each exact contact counts as one.
    fn work(&self) -> u128 {
        /// Uncoated, coated, all layer; plus the exact contact and both effective-modulus models.
        const CURVES: usize = 3;
        (CURVES * (self.laws.len() + 1) * self.indentations.len() * self.cases()) as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(rows::run(context, self)?))
    }
}

/// One sphere on layered flats.
pub struct IndentationPlan {
    pub ball: (String, Material),
    /// Of the ball, m.
    pub radius: f64,
    /// Name of the substrate's material, and the material.
    pub flat: (String, Material),
    /// The layers, each in thicknesses that are positive and finite.
    pub layers: Vec<LayerPlan>,
    pub laws: Vec<ContactLaw>,
    /// m, ascending, at least two, none beyond the radius.
    pub indentations: Vec<f64>,
    pub overlay: Option<OverlayPlan>,
    pub show: Show,
    pub figure_of_paper: Option<SphereFigure>,
}

impl IndentationPlan {
    /// Number of layers, each thickness by itself.
    pub fn cases(&self) -> usize {
        self.layers.iter().map(|layer| layer.thicknesses.len()).sum()
    }
}

impl fmt::Display for IndentationPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { ball, radius, flat, laws, indentations, .. } = self;
        let laws: Vec<String> = laws.iter().map(ContactLaw::label).collect();
        writeln!(f, "  a ball of {}, radius {radius:e} m, on {}, law {}", ball.0, flat.0, laws.join(", "))?;
        for layer in &self.layers {
            let thicknesses: Vec<String> = layer.thicknesses.iter().map(|t| format!("{t:e}")).collect();
            writeln!(f, "  layer {}: {} m, rule {}", layer.name, thicknesses.join(", "), layer.rule.name())?;
        }
        let count = indentations.len();
        writeln!(f, "  {count} indentations from {:e} to {:e} m", indentations[0], indentations[count - 1])?;
        self.overlay.iter().try_for_each(|OverlayPlan { path, points }| {
            writeln!(f, "  {} measured points in {}", points.len(), path.display())
        })
    }
}

/// Refuses a layer on the ball: it is the same contact as one of a ball of the other material on a coated flat.
fn refuse_coated_ball(file: &SpecFile, raw: &IndentationSpec) -> Result<(), InputError> {
    let on = raw.layer.get_ref().0.iter().filter_map(|layer| layer.on.as_ref());
    match on.into_iter().find(|on| *on.get_ref() == Body::Rough) {
        Some(on) => Err(file.source.error_at(
            on.span(),
            "found \"rough\", a layer on the ball; allowed here: \"flat\". Exchange `ball` and `flat`: a layer on either body is the same \
             contact as long as the radius is large against the thickness",
        )),
        None => Ok(()),
    }
}

/// The uncoated flat and the bulk layer material are always included.
fn check_layers(file: &SpecFile, raw: &IndentationSpec, layers: &[LayerPlan]) -> Result<(), InputError> {
    let refuse = |message: String| Err(file.source.error_at(raw.layer.span(), message));
    for (k, layer) in layers.iter().enumerate() {
        if let Some(t) = layer.thicknesses.iter().find(|t| !is_positive(**t)) {
            return refuse(format!(
                "layer {}: found a thickness of {t}; allowed: positive and finite (the uncoated flat and the bulk layer \
                 material are always shown too)",
                layer.name
            ));
        }
        let same = |other: &LayerPlan| {
            (&other.name, other.rule) == (&layer.name, layer.rule)
                && other.thicknesses.iter().any(|t| layer.thicknesses.contains(t))
        };
        if layers[..k].iter().any(same) {
            return refuse(format!(
                "found layer {} twice with the same thickness; allowed: once",
                layer.name
            ));
        }
    }
    Ok(())
}

fn check_laws(
    file: &SpecFile,
    raw: &IndentationSpec,
    ball: &(String, Material),
    flat: &(String, Material),
    layers: &[LayerPlan],
) -> Result<(), InputError> {
    file.spheres_only(&raw.law, "a ball is a sphere")?;
    let layer_materials = layers.iter().map(|layer| (layer.name.as_str(), &layer.coating.material));
    let flats: Vec<_> = std::iter::once((flat.0.as_str(), &flat.1)).chain(layer_materials).collect();
    file.check_laws(&raw.law, (&ball.0, &ball.1), &flats)?;
    // Each layer is of finite thickness.
    let coated = layers[0].coating.flat(layers[0].thicknesses[0]);
    let coated = coated.map_err(|error| InputError::file(&file.source.path, error))?;
    for law in &raw.law.get_ref().0 {
        law.interface(&ball.1, &coated).map_err(|error| match error {
            Inapplicable::Layer { law } => {
                let message = format!(
                    "found law {law}, which is not defined under a layer; allowed: a law that is ([laws] shows one asperity without \
                     a layer)"
                );
                file.source.error_at(raw.law.span(), message)
            }
            _ => file.inapplicable(&raw.law, &error, &ball.0, &flat.0),
        })?;
    }
    Ok(())
}

fn check_overlay(file: &SpecFile, raw: &IndentationSpec, plan: &IndentationPlan) -> Result<(), InputError> {
    let (Some(raw), Some(overlay)) = (&raw.overlay, &plan.overlay) else { return Ok(()) };
    let refuse = |message: String| Err(file.source.error_at(raw.span(), message));
    let (deepest, radius, cases) = (overlay.deepest(), plan.radius, plan.cases());
    if deepest > radius {
        return refuse(format!(
            "found a measured indentation of {deepest:e} m; allowed: at most the radius, {radius:e} m (the columns are in m and N)"
        ));
    }
    if cases > 1 {
        return refuse(format!(
            "found measured points with {cases} layers; allowed: a single layer of one thickness"
        ));
    }
    Ok(())
}

/// One ball on a layered flat: load, area and regimes, and the error of the effective-modulus models.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct IndentationSpec {
    /// The ball: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub ball: Spanned<String>,
    /// Radius of the ball.
    #[schemars(extend("examples" = ["5 mm"]))]
    pub radius: Quantity<Length>,
    /// The substrate: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The layers on the flat, each by itself.
    #[schemars(extend("examples" = [{ "material": "lead", "thickness": ["1 um", "10 um"] }]))]
    pub layer: Spanned<Layers>,
    /// The micro-contact laws.
    pub law: Spanned<Laws>,
    /// How far the ball is pressed in, ascending.
    #[schemars(extend("x-range" = "up to the radius", "examples" = [{ "from": "1 nm", "to": "1 um", "points": 100 }]))]
    pub indentation: Spanned<LogSweep<Length>>,
    /// A CSV of your measured points, laid over the curves: the columns indentation in m and load in N. Relative to the spec.
    #[schemars(extend("x-default" = "none", "examples" = ["points.csv"]))]
    pub overlay: Option<Spanned<PathBuf>>,
    /// Axes of the load figure.
    #[serde(default)]
    #[schemars(extend("default" = "load", "examples" = ["approach"]))]
    pub show: Show,
    /// The figure of Pasaribu and Schipper (2005) that the spec reproduces: the load figure is named after it.
    #[schemars(extend("x-default" = "none", "examples" = [5]))]
    pub figure_of_paper: Option<SphereFigure>,
}

/// Axes of the load figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Show {
    /// Load against indentation.
    #[default]
    Load,
    /// Normal approach against load.
    Approach,
}

/// One layer or a list of them.
#[derive(Debug)]
pub struct Layers(pub Vec<LayerSpec>);

written_schema!(Layers, |generator| schema::one_or_many(
    generator.subschema_for::<LayerSpec>(),
    "a layer, or a list of layers; keys as in `compare.layer`"
));

impl<'de> Deserialize<'de> for Layers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a layer such as { material = \"lead\", thickness = \"1.2 um\" }, or a list of layers";
        OneOrMany::read(deserializer, expected)?.at_least_one("layer").map(Self)
    }
}
