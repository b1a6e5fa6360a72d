//! The tables of a sphere on layers.

use std::f64::consts::PI;

use super::shown::Shown;
use crate::kind::indentation::run::{IndentationResults, LawCurves, LayerResults};
use asperity::ModulusModel;
use asperity::compare::ModulusError;
use asperity::layer::exact_sphere::ElasticContact;
use asperity::sphere::{Point, RegimeChange};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

/// The columns of the layer that a row belongs to.
fn layer_columns<R>(layer: impl Fn(&R) -> &LayerResults + Copy + 'static) -> Vec<Column<R>> {
    columns! { row: R =>
        layer["text"] = layer(row).name.as_str(), "Material of the layer.";
        layer_thickness_m["m"] = layer(row).thickness, "Thickness of the layer.";
        rule["text"] = layer(row).rule.name(), "Effective-modulus model of the layered flat: `gao` (Eqs. 14 and 15) or `series` (compliances in series).";
    }
}

/// A point of a curve.
struct CurveRow<'a> {
    layer: &'a LayerResults,
    law: &'a str,
    curve: Shown,
    indentation: f64,
    load: f64,
    area: f64,
    contact_radius: f64,
    stiffness: f64,
    regime: Option<&'static str>,
}

impl Row for CurveRow<'_> {
    const FILE: &'static str = "indentation.csv";
    const ROWS: &'static str = "One row for each layer, law, curve and indentation.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        let mut columns = layer_columns(|row: &Self| row.layer);
        columns.extend(columns! { row: Self =>
            law["text"] = row.law, "Contact law; empty for the exact elastic contact.";
            curve["text"] = row.curve.name(), "Curve: `coated`, `uncoated`, `all-layer` (a flat of the layer's material) or `exact-elastic`.";
            indentation_m["m"] = row.indentation, "Indentation w (Eq. 1).";
            load_n["N"] = row.load, "Load P on the sphere.";
            area_m2["m²"] = row.area, "Real contact area A.";
            contact_radius_m["m"] = row.contact_radius, "Contact radius (A/pi)^0.5.";
            mean_pressure_pa["Pa"] = row.load / row.area, "Mean contact pressure P/A.";
            stiffness_n_per_m["N/m"] = row.stiffness, "Contact stiffness dP/dw.";
            regime["text"] = row.regime, "Regime: `elastic`, `elastic-plastic` or `plastic`; empty for the exact elastic contact.";
        });
        columns
    }
}

impl<'a> CurveRow<'a> {
    fn new(layer: &'a LayerResults, law: &'a LawCurves, curve: Shown, point: &Point) -> Self {
        let contact = &point.contact;
        Self {
            layer,
            law: &law.law,
            curve,
            indentation: point.indentation,
            load: contact.load,
            area: contact.area,
            contact_radius: (contact.area / PI).sqrt(),
            stiffness: contact.stiffness,
            regime: Some(contact.regime.name()),
        }
    }

    fn exact(layer: &'a LayerResults, contact: &ElasticContact) -> Self {
        Self {
            layer,
            law: "",
            curve: Shown::Exact,
            indentation: contact.indentation,
            load: contact.load,
            area: PI * contact.contact_radius * contact.contact_radius,
            contact_radius: contact.contact_radius,
            stiffness: contact.stiffness,
            regime: None,
        }
    }
}

/// A change of the regime along a curve.
struct ChangeRow<'a> {
    layer: &'a LayerResults,
    law: &'a str,
    curve: Shown,
    change: &'a RegimeChange,
    is_within: bool,
}

impl Row for ChangeRow<'_> {
    const FILE: &'static str = "regimes.csv";
    const ROWS: &'static str = "One row for each change of the regime along a curve, also beyond the sweep.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = layer_columns(|row: &Self| row.layer);
        columns.extend(columns! { row: Self =>
            law["text"] = row.law, "Contact law.";
            curve["text"] = row.curve.name(), "Curve: `coated`, `uncoated` or `all-layer` (a flat of the layer's material).";
            indentation_m["m"] = row.change.indentation, "Indentation w at which the regime changes (coated: Eqs. 2 and 4 with the effective properties at w).";
            load_n["N"] = row.change.load, "Load just below that indentation.";
            from["text"] = row.change.from.name(), "Regime below it.";
            to["text"] = row.change.to.name(), "Regime above it.";
            within_sweep["true/false"] = row.is_within, "Whether it lies within the specified indentations.";
        });
        columns
    }
}

/// An effective-modulus model and the exact elastic contact.
struct RuleRow<'a> {
    layer: &'a LayerResults,
    rule: ModulusModel,
    indentation: f64,
    error: &'a ModulusError,
}

impl Row for RuleRow<'_> {
    const FILE: &'static str = "rule.csv";
    const ROWS: &'static str = "One row for each layer, effective-modulus model and indentation at which the exact elastic contact is solved.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            layer["text"] = row.layer.name.as_str(), "Material of the layer.";
            layer_thickness_m["m"] = row.layer.thickness, "Thickness of the layer.";
            rule["text"] = row.rule.name(), "Effective-modulus model: `gao` (Eqs. 14 and 15) or `series` (compliances in series).";
            indentation_m["m"] = row.indentation, "Indentation w (Eq. 1).";
            contact_radius_over_thickness["1"] = row.error.contact_ratio, "Contact radius of the exact contact over the thickness of the layer.";
            load_over_exact["1"] = row.error.ratio, "Elastic load by the model over the exact one.";
        }
    }
}

/// A measured point and the coated curve.
struct OverlayRow<'a> {
    layer: &'a LayerResults,
    law: &'a str,
    indentation: f64,
    measured_load: f64,
    coated_load: f64,
}

impl Row for OverlayRow<'_> {
    const FILE: &'static str = "overlay.csv";
    const ROWS: &'static str =
        "One row for each layer, law and measured point; written where `overlay` names a file of points.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = layer_columns(|row: &Self| row.layer);
        columns.extend(columns! { row: Self =>
            law["text"] = row.law, "Contact law.";
            indentation_m["m"] = row.indentation, "Measured indentation.";
            measured_load_n["N"] = row.measured_load, "Measured load.";
            coated_load_n["N"] = row.coated_load, "Load of the coated curve at that indentation.";
            measured_over_coated["1"] = row.measured_load / row.coated_load, "Measured over computed load.";
        });
        columns
    }
}

/// `indentation.csv`, `regimes.csv`, `rule.csv` and `overlay.csv`.
pub(super) fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<CurveRow>(),
        Schema::of::<ChangeRow>(),
        Schema::of::<RuleRow>(),
        Schema::of::<OverlayRow>(),
    ]
}

/// The files of [`schemas`], the last one only where points were measured.
pub(super) fn tables(results: &IndentationResults) -> Vec<Table> {
    let mut tables =
        vec![Table::new(curves(results)), Table::new(changes(results)), Table::new(rules(results))];
    if let Some((_, points)) = &results.overlay {
        tables.push(Table::new(overlay(results, points)));
    }
    tables
}

/// Each law's curves; then the exact one, once a layer, without a law.
fn curves(results: &IndentationResults) -> impl Iterator<Item = CurveRow<'_>> {
    results.layers.iter().flat_map(|layer| {
        let of_laws = layer.laws.iter().flat_map(move |law| {
            Shown::of(law).into_iter().flat_map(move |(shown, curve)| {
                curve.points.iter().map(move |point| CurveRow::new(layer, law, shown, point))
            })
        });
        of_laws.chain(layer.exact.iter().flatten().map(move |contact| CurveRow::exact(layer, contact)))
    })
}

fn changes(results: &IndentationResults) -> impl Iterator<Item = ChangeRow<'_>> {
    with_laws(results).flat_map(|(layer, law)| {
        Shown::of(law).into_iter().flat_map(move |(shown, curve)| {
            curve.changes.iter().map(move |change| ChangeRow {
                layer,
                law: &law.law,
                curve: shown,
                change,
                is_within: curve.is_within(change),
            })
        })
    })
}

/// The exact contact is solved up to some indentation only.
fn rules(results: &IndentationResults) -> impl Iterator<Item = RuleRow<'_>> {
    results.layers.iter().flat_map(move |layer| {
        ModulusModel::ALL.into_iter().zip(&layer.errors).flat_map(move |(rule, errors)| {
            let solved = results.indentations.iter().zip(errors);
            solved.map(move |(&indentation, error)| RuleRow { layer, rule, indentation, error })
        })
    })
}

fn overlay<'a>(
    results: &'a IndentationResults,
    points: &'a [(f64, f64)],
) -> impl Iterator<Item = OverlayRow<'a>> {
    with_laws(results).flat_map(move |(layer, law)| {
        points.iter().zip(&law.at_overlay).map(move |(&(indentation, measured_load), &coated_load)| {
            OverlayRow { layer, law: &law.law, indentation, measured_load, coated_load }
        })
    })
}

/// Every layer under every law.
fn with_laws(results: &IndentationResults) -> impl Iterator<Item = (&LayerResults, &LawCurves)> {
    results.layers.iter().flat_map(|layer| layer.laws.iter().map(move |law| (layer, law)))
}
