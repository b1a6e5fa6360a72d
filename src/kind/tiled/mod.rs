//! `[tiled]`: both models on a surface that may be larger than a machine.

mod results;
mod run;

use std::fmt;
use std::path::PathBuf;

use asperity::Total;
use asperity::compare::{Controls, ModelKind};
use asperity::law::Body;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::input::law::Laws;
use asperity_contact_framework::input::sweep::LinearSweep;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::metadata::{ContactSummary, Metadata};
use asperity_contact_framework::report::format::{count, input_number, percent, quantity, signed, thickness};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Schema, Table, Tables};
use asperity_contact_framework::{Divided, Kind, Memory, Outcome, Plan, RunContext, fields};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Plot};
use results::{INTERVAL, LawResults, SeparationRow, TiledResults, TiledSurface, surface_row, tables};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::{Map, Value, json};

use crate::layer::{CoatedSurface, LayerSpec};
use crate::model_tables::{CurveRow, PairRow};
use crate::study_plan::{RoughBody, SpotKeys, StudyKeys, StudyPlan};
use crate::surface::rows::{SurfaceRow, records};
use crate::surface::{SurfacePlan, SurfaceTiles, inputs};

pub struct Tiled;

impl Kind for Tiled {
    const NAME: &'static str = "tiled";
    type Spec = TiledSpec;
    type Plan = TiledPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<TiledPlan, InputError> {
        let (raw, span) = (table.get_ref(), table.span());
        let elliptic = raw.law.get_ref().0.iter().find(|law| law.is_elliptic());
        if let Some(law) = elliptic {
            let message =
                format!("found {}, a law of ellipses; allowed in [tiled]: laws of spheres", law.label());
            return Err(file.source.error_at(raw.law.span(), message));
        }
        raw.layer.iter().try_for_each(|layer| layer.refuse_shear(&file.source))?;
        let surfaces = raw.surface.clone().map(|surface| vec![surface]);
        let study = StudyPlan::new(
            file,
            StudyKeys {
                table: span.clone(),
                rough: &raw.rough,
                flat: &raw.flat,
                law: &raw.law,
                layer: raw.layer.as_ref(),
                spots: SpotKeys::default(),
                statistical: None,
                accept: AcceptSpec::default(),
                surfaces: surfaces.as_deref(),
                controls: Controls { separations: raw.separation.get_ref().0.clone(), ..Controls::default() },
                nominal_area: None,
                load_keys: [None, None],
            },
        )?;
        study.check_summed(file, None)?;
        let [surface] = &study.surfaces[..] else {
            let names: Vec<&str> = study.surfaces.iter().map(|surface| surface.name.as_str()).collect();
            let message = format!(
                "found {} surfaces ({}); allowed: surface = \"NAME\" of one of them",
                names.len(),
                names.join(", ")
            );
            return Err(file.source.error_at(span, message));
        };
        let tiles = SurfaceTiles::new(surface, &file.source)?;
        Ok(TiledPlan { study, tiles })
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<CurveRow>(),
            Schema::of::<PairRow>(),
            Schema::of::<results::SeparationRow>(),
            Schema::of::<SurfaceRow>(),
        ]
    }
}

impl Plan for TiledPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.study.surfaces)
    }

    /// Of any task too: tiles are done one after the other.
    fn memory(&self) -> Memory {
        // Over each block of the tiles that are under way, and over each tile.
        let sums = self.tiles.most_blocks() + self.tiles.count;
        let totals = sums * self.separations().len() * self.study.laws.len() * size_of::<Total>();
        let bytes = self.tiles.memory(self.surface()) + totals as u128;
        Memory { bytes, key: Some(self.surface().size_key.clone()) }
    }

    fn work(&self) -> u128 {
        self.study.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(self.run_here(context)?))
    }

    fn divided(&self) -> Option<&dyn Divided> {
        Some(self)
    }
}

/// Both models on a surface in tiles.
pub struct TiledPlan {
    pub study: StudyPlan,
    pub tiles: SurfaceTiles,
}

impl TiledPlan {
    pub fn surface(&self) -> &SurfacePlan {
        &self.study.surfaces[0]
    }

    /// d/sigma.
    pub fn separations(&self) -> &[f64] {
        &self.study.controls.separations
    }
}

impl fmt::Display for TiledPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.study)?;
        let count = self.tiles.count;
        let passes = if self.surface().nominal().is_some() { "one pass" } else { "two passes" };
        writeln!(f, "  {count} tiles, {passes}")
    }
}

/// Both models on one surface that may be larger than memory: it is summed tile by tile, in one process or on many machines (docs/clusters.md).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TiledSpec {
    /// The rough body: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub rough: Spanned<RoughBody>,
    /// The smooth flat: the name of a `[material.NAME]` of this file.
    #[schemars(extend("examples" = ["steel"]))]
    pub flat: Spanned<String>,
    /// The micro-contact laws, of spheres.
    pub law: Spanned<Laws>,
    /// A layer on the flat or on the rough body, of one thickness or several.
    #[schemars(extend("x-default" = "none: both bodies are bare", "examples" = [{ "material": "lead", "thickness": [0, "50 nm", "1 um", "inf"] }]))]
    pub layer: Option<LayerSpec>,
    /// Separations at which the sum runs, d/sigma from the mean asperity height; the integral runs there and at the pressures of the sum.
    pub separation: Spanned<LinearSweep>,
    /// The surface, by name.
    #[schemars(extend("x-default" = "the only one of the file", "examples" = ["ground"]))]
    pub surface: Option<Spanned<String>>,
}

impl Outcome for TiledResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        let mut warnings: Vec<String> =
            self.implausible.iter().chain(&self.contact.caveats).cloned().collect();
        if let Some(layer) = self.contact.layer.as_ref().filter(|layer| layer.on == Body::Rough) {
            let TiledSurface { name, population, .. } = &self.surface;
            let surface = CoatedSurface { name, radius: population.radius, sq: None };
            warnings.extend(surface.warnings(&layer.name, &layer.thicknesses));
        }
        warnings
    }

    fn tables(&self) -> Vec<Table> {
        tables(self)
    }

    fn page(&self, tables: &Tables) -> Page {
        let mut page = Page::new(&self.metadata.title);
        page.lead(&answer(&self.laws));
        for law in &self.laws {
            let name = name(law);
            let layer = law.thickness.map_or_else(String::new, |at| format!("-layer-{at:e}"));
            let file = format!("{}{layer}-pressure.svg", law.law).replace(['(', ')', ' ', '=', ','], "-");
            page.figure(
                &file,
                figure(&name, law),
                "Left: nominal pressure against separation. Right: pressure of the integral over that of the sum, less one, with the 95 % \
                 interval of the sum from the scatter of the tiles.",
            );
        }
        sections::warnings(&mut page, &self.warnings());
        page.details(2, "Both models at equal separation", |page| {
            page.view(&tables.view::<SeparationRow>().without_constant(&["law", "layer_thickness_m"]));
        });
        let TiledSurface { name, count: asperities, nominal_area, tiles, .. } = &self.surface;
        page.details(2, &format!("Surface {name}"), |page| {
            page.properties(&tables.view::<SurfaceRow>().without(&["surface", "realisation"]));
        });
        sections::notes(&mut page, &self.metadata);
        sections::what_was_run(&mut page, &self.metadata, &self.contact, |page| {
            page.paragraph(&format!(
                "{} asperities on {} in {} tiles. Method: [theory](../../docs/theory.md#surfaces-in-tiles).",
                count(*asperities),
                quantity(*nominal_area, "m²"),
                count(*tiles)
            ));
        });
        sections::run_again(&mut page, &self.metadata, None);
        sections::sources(&mut page, &self.metadata);
        page
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = fields(&ContactSummary::new(&self.contact))?;
        facts.insert("surfaces".to_owned(), records([surface_row(&self.surface)]));
        facts.insert("tiles".to_owned(), json!(self.surface.tiles));
        Ok(facts)
    }
}

/// A law and its layer, in words.
fn name(law: &LawResults) -> String {
    match law.thickness {
        None => law.law.clone(),
        Some(at) => format!("{}, layer {}", law.law, thickness(at)),
    }
}

/// How far the models are apart at equal separation, as far as the sampling error lets that be known.
fn answer(laws: &[LawResults]) -> String {
    let rows: Vec<(String, SeparationRow)> = laws
        .iter()
        .flat_map(|law| SeparationRow::all(law).map(|row| (name(law), row)))
        .filter(|(_, row)| row.is_within().is_some())
        .collect();
    let excess = |row: &SeparationRow| row.ratio().map_or(0.0, |ratio| ratio - 1.0);
    let largest = rows.iter().max_by(|a, b| excess(&a.1).abs().total_cmp(&excess(&b.1).abs()));
    let Some((law, largest)) = largest else {
        return "The sum has no interval at any admissible load: its heights are at the quantiles, or fewer than eight tiles carry load."
            .to_owned();
    };
    let within = rows.iter().filter(|(_, row)| row.is_within() == Some(true)).count();
    format!(
        "At equal separation the integral is within the 95 % interval of the sum's pressure at {within} of {} separations. It differs most \
         at d/σ = {} ({}): by {} % (interval ±{}).",
        rows.len(),
        input_number(largest.separation()),
        escape(law),
        signed(100.0 * excess(largest)),
        percent(INTERVAL * largest.relative_error().unwrap_or(0.0)),
    )
}

fn figure(name: &str, law: &LawResults) -> Figure {
    let curve = |kind: ModelKind| {
        let points = law.comparison.curves.iter().filter(move |point| point.kind == kind);
        points.map(|point| (point.target, point.response.pressure.total())).collect::<Vec<_>>()
    };
    let loaded = |points: Vec<(f64, f64)>| points.into_iter().filter(|(_, p)| *p > 0.0).collect::<Vec<_>>();
    let curves = Plot::new(
        format!("{name}: both models"),
        Axis::linear("separation d/σ"),
        Axis::log("nominal pressure in Pa"),
    )
    .with(
        Layer::line(loaded(curve(ModelKind::Deterministic)))
            .coloured(Colour::Deterministic)
            .named("deterministic"),
    )
    .with(
        Layer::line(loaded(curve(ModelKind::Statistical)))
            .coloured(Colour::Statistical)
            .dashed(Dash::Dashed)
            .named("statistical"),
    );
    let differences: Vec<_> =
        SeparationRow::all(law).filter_map(|row| Some((row.separation(), row.ratio()? - 1.0))).collect();
    let band: Vec<_> = SeparationRow::all(law)
        .filter_map(|row| {
            let (excess, half) = (row.ratio()? - 1.0, INTERVAL * row.relative_error()?);
            Some((row.separation(), excess - half, excess + half))
        })
        .collect();
    let difference = Plot::new(
        format!("{name}: difference"),
        Axis::linear("separation d/σ"),
        Axis::linear("integral over sum, less one"),
    )
    .with(Layer::band(band).coloured(Colour::Statistical))
    .with(Layer::line(differences).coloured(Colour::Statistical).named("difference"))
    .with_zero();
    Figure::row(format!("Both models under {name}"), vec![curves, difference])
}
