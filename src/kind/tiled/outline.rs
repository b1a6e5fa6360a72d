//! The page of a surface in tiles: how far is the integral from the sum over all of it?

use asperity::compare::ModelKind;
use asperity::law::Body;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{count, input_number, percent, quantity, signed, thickness};
use asperity_contact_framework::report::page::{Page, escape};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Outcome, fields};
use asperity_plot::{Axis, Colour, Dash, Figure, Layer, Plot};
use serde_json::{Map, Value, json};

use super::results::{LawResults, TiledResults, TiledSurface};
use super::rows::{INTERVAL, SeparationRow, surface_row, tables};
use crate::layer::CoatedSurface;
use crate::surface::rows::{SurfaceRow, records};

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
