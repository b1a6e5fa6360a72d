//! `smooth_bodies.csv`: two rough bodies against each of them alone, the other taken smooth.

use asperity::compare::{ComparedQuantity, ModelKind};
use asperity::study::PointResult;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{ELECTRICAL, FRICTION, REFERENCE, THERMAL};

/// What taking one of two rough bodies smooth does to a result at one load.
pub(crate) struct SmoothBodyRow<'a> {
    key: CaseKey<'a>,
    smooth: &'a str,
    model: Option<ModelKind>,
    /// With both bodies rough, and with one of them smooth.
    points: [PointResult; 2],
}

impl SmoothBodyRow<'_> {
    fn error(&self, quantity: ComparedQuantity) -> Option<f64> {
        let [pair, alone] = [0, 1].map(|k| self.points[k].value(quantity));
        Some(alone? / pair? - 1.0)
    }
}

impl Row for SmoothBodyRow<'_> {
    const FILE: &'static str = "smooth_bodies.csv";
    const ROWS: &'static str = "One row for each pair of rough bodies, law, layer thickness, body that is taken smooth and model, where the other body is a surface of the comparison, too: the error of that at the load of the results.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            smooth["text", label("taken smooth")] = row.smooth, "The body that is taken smooth.";
            model["text"] = row.model.map_or(REFERENCE, ModelKind::name), "Model: `statistical`, `deterministic` or `reference`.";
            pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.points[0].pressure, "Nominal pressure.";
            area_error["1", label("real contact area"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::Area), "Real contact area with a smooth body over that with both rough, less 1.";
            stiffness_error["1", label("stiffness"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::Stiffness), "The same of the stiffness; empty where there is none.";
            electrical_conductance_error["1", part(ELECTRICAL), label("electrical conductance"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::ElectricalConductance), "The same of the electrical conductance.";
            thermal_conductance_error["1", part(THERMAL), label("thermal conductance"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::ThermalConductance), "The same of the thermal conductance.";
            friction_error["1", part(FRICTION), label("friction"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::Friction), "The same of the coefficient of friction.";
        });
        columns
    }
}

/// The rows.
pub(super) fn rows(results: &CompareResults) -> Vec<SmoothBodyRow<'_>> {
    let mut rows = Vec::new();
    for pair in SurfaceCase::all(results) {
        let Some(bodies) = &pair.surface.bodies else { continue };
        let at_load = pair.case.results_at_load();
        for (rough, smooth) in [(&bodies[0], &bodies[1]), (&bodies[1], &bodies[0])] {
            let is_alone = |case: &SurfaceCase| {
                let (own, key) = (case.key(), pair.key());
                own.surface == rough && own.law == key.law && own.thickness == key.thickness
            };
            let Some(alone) = SurfaceCase::all(results).find(is_alone) else { continue };
            for both in &at_load.models {
                let load = pair.case.reported_load().map_or(both.point.pressure, |at| at.load);
                let found = alone.case.results_at(load);
                let of_model = found.models.iter().find(|one| one.model == both.model);
                rows.extend(of_model.map(|one| SmoothBodyRow {
                    key: pair.key(),
                    smooth,
                    model: both.model,
                    points: [both.point, one.point],
                }));
            }
        }
    }
    rows
}
