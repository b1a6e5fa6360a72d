//! The tables of a sphere on layers.

use std::f64::consts::PI;

use serde::Serialize;

use super::shown::Shown;
use crate::kind::indentation::run::{IndentationResults, LawCurves, LayerResults};
use asperity::layer::Rule;
use asperity::layer::exact_sphere::ElasticContact;
use asperity::sphere::Point;
use asperity_framework::report::table::{Table, TableError};
use asperity_framework::row;

/// What a row belongs to.
#[derive(Clone, Serialize)]
struct Of {
    layer: String,
    layer_thickness_m: f64,
    rule: &'static str,
    /// Empty of what no law has a part in.
    law: String,
}

const OF: &[&str] = &["layer", "layer_thickness_m", "rule", "law"];

impl Of {
    fn new(found: &LayerResults, law: &str) -> Self {
        let (layer, layer_thickness_m) = (found.name.clone(), found.thickness);
        Self { layer, layer_thickness_m, rule: found.rule.name(), law: law.to_owned() }
    }
}

row! {
struct CurveRow {
    curve: &'static str,
    indentation_m: f64,
    load_n: f64,
    area_m2: f64,
    contact_radius_m: f64,
    mean_pressure_pa: f64,
    stiffness_n_per_m: f64,
    regime: Option<&'static str>,
}
}

impl CurveRow {
    fn new(curve: &'static str, point: &Point) -> Self {
        let contact = &point.contact;
        Self {
            curve,
            indentation_m: point.indentation,
            load_n: contact.load,
            area_m2: contact.area,
            contact_radius_m: (contact.area / PI).sqrt(),
            mean_pressure_pa: contact.load / contact.area,
            stiffness_n_per_m: contact.stiffness,
            regime: Some(contact.regime.name()),
        }
    }

    fn exact(contact: &ElasticContact) -> Self {
        let area_m2 = PI * contact.contact_radius * contact.contact_radius;
        Self {
            curve: Shown::Exact.name(),
            indentation_m: contact.indentation,
            load_n: contact.load,
            area_m2,
            contact_radius_m: contact.contact_radius,
            mean_pressure_pa: contact.load / area_m2,
            stiffness_n_per_m: contact.stiffness,
            regime: None,
        }
    }
}

row! {
struct ChangeRow {
    curve: &'static str,
    indentation_m: f64,
    load_n: f64,
    from: &'static str,
    to: &'static str,
    within_sweep: bool,
}
}

row! {
struct RuleRow {
    layer: String,
    layer_thickness_m: f64,
    rule: &'static str,
    indentation_m: f64,
    contact_radius_over_thickness: f64,
    load_over_exact: f64,
}
}

row! {
struct OverlayRow {
    indentation_m: f64,
    measured_load_n: f64,
    coated_load_n: f64,
    measured_over_coated: f64,
}
}

/// `indentation.csv`, `regimes.csv`, `rule.csv`, and `overlay.csv` where points were measured.
///
/// # Errors
/// See [`TableError`].
pub fn tables(results: &IndentationResults) -> Result<Vec<(&'static str, Vec<u8>)>, TableError> {
    let mut tables = vec![
        ("indentation.csv", curves(results)?),
        ("regimes.csv", changes(results)?),
        ("rule.csv", rules(results)?),
    ];
    if let Some((_, points)) = &results.overlay {
        tables.push(("overlay.csv", overlay(results, points)?));
    }
    Ok(tables)
}

/// Each law's curves; then the exact one, once a layer, without a law.
fn curves(results: &IndentationResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[OF, CurveRow::COLUMNS])?;
    for found in &results.layers {
        for law in &found.laws {
            let of = Of::new(found, &law.law);
            for (shown, curve) in Shown::of(law) {
                for point in &curve.points {
                    table.row((&of, CurveRow::new(shown.name(), point)))?;
                }
            }
        }
        let of = Of::new(found, "");
        for contact in found.exact.iter().flatten() {
            table.row((&of, CurveRow::exact(contact)))?;
        }
    }
    table.bytes()
}

fn changes(results: &IndentationResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[OF, ChangeRow::COLUMNS])?;
    let mut of_law = |found: &LayerResults, law: &LawCurves| -> Result<(), TableError> {
        let of = Of::new(found, &law.law);
        for (shown, curve) in Shown::of(law) {
            for change in &curve.changes {
                let row = ChangeRow {
                    curve: shown.name(),
                    indentation_m: change.indentation,
                    load_n: change.load,
                    from: change.from.name(),
                    to: change.to.name(),
                    within_sweep: curve.is_within(change),
                };
                table.row((&of, row))?;
            }
        }
        Ok(())
    };
    for found in &results.layers {
        for law in &found.laws {
            of_law(found, law)?;
        }
    }
    table.bytes()
}

fn rules(results: &IndentationResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[RuleRow::COLUMNS])?;
    for found in &results.layers {
        for (rule, errors) in Rule::ALL.into_iter().zip(&found.errors) {
            // The exact contact is solved up to some indentation.
            for (&indentation_m, error) in results.indentations.iter().zip(errors) {
                table.row(RuleRow {
                    layer: found.name.clone(),
                    layer_thickness_m: found.thickness,
                    rule: rule.name(),
                    indentation_m,
                    contact_radius_over_thickness: error.contact_ratio,
                    load_over_exact: error.ratio,
                })?;
            }
        }
    }
    table.bytes()
}

fn overlay(results: &IndentationResults, points: &[(f64, f64)]) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[OF, OverlayRow::COLUMNS])?;
    for found in &results.layers {
        for law in &found.laws {
            let of = Of::new(found, &law.law);
            for (&(indentation_m, measured_load_n), &coated_load_n) in points.iter().zip(&law.at_overlay) {
                let measured_over_coated = measured_load_n / coated_load_n;
                table.row((
                    &of,
                    OverlayRow { indentation_m, measured_load_n, coated_load_n, measured_over_coated },
                ))?;
            }
        }
    }
    table.bytes()
}
