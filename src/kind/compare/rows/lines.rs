//! `lines.csv`: closed results beside the models.

use asperity::analytical::AnalyticalLine;
use asperity::compare::{CurvePoint, of_each_decade};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::figures::curves::curve;
use crate::kind::compare::figures::lines::{KINDS, Rough, loads};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::REFERENCE;

/// One line at one load.
pub(crate) struct LineRow<'a> {
    key: CaseKey<'a>,
    line: &'static str,
    /// The model whose separation is corrected.
    model: Option<&'static str>,
    pressure: f64,
    area_ratio: Option<f64>,
    separation: Option<f64>,
}

impl Row for LineRow<'_> {
    const FILE: &'static str = "lines.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, analytical line and load, on the first realisation, for elastic bodies under any law.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            line["text"] = row.line, "The line: `persson`, A/A_nom = erf(2^0.5 p/(E* g)); `bush-gibson-thomas`, (2 pi)^0.5 p/(E* g), at most 1; or `greenwood-williamson-interacting`, the separation less the mean deflection of the patch. g is the r.m.s. gradient of the prepared map.";
            model["text"] = row.model, "The model whose separation is corrected for interaction, or the reference, whose separation is that to the undeformed mean plane.";
            pressure_pa["Pa", prefix("M"), label("nominal pressure")] = row.pressure, "Nominal pressure.";
            area_ratio["1"] = row.area_ratio, "Real contact area over nominal area.";
            separation_over_sigma["1"] = row.separation, "Separation over sigma.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = LineRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| of_case(results, case))
}

fn of_case<'a>(results: &'a CompareResults, case: SurfaceCase<'a>) -> Vec<LineRow<'a>> {
    /// Loads per decade.
    const PER_DECADE: f64 = 2.0;
    /// A load is met to rounding.
    const ROUNDING: f64 = 1e-9;
    let Some(rough) = Rough::new(results, case.surface).filter(|_| !results.lines.is_empty()) else {
        return Vec::new();
    };
    let loads: Vec<f64> = match &case.first().reference {
        Some(curve) => curve.points.iter().map(|point| point.pressure).collect(),
        None => of_each_decade(loads(case.first()), |&load| load, PER_DECADE),
    };
    let row = |line: AnalyticalLine, model, pressure, area_ratio, separation| LineRow {
        key: case.key(),
        line: line.name(),
        model,
        pressure,
        area_ratio,
        separation,
    };
    let mut rows = Vec::new();
    for &line in &results.lines {
        let area = |load: f64| line.area_ratio(load / rough.modulus, rough.gradient);
        let areas = loads.iter().filter_map(|&load| Some(row(line, None, load, Some(area(load)?), None)));
        rows.extend(areas);
        if line != AnalyticalLine::GreenwoodWilliamsonInteracting {
            continue;
        }
        for kind in KINDS {
            let is_at_load = |point: &&CurvePoint| {
                let pressure = point.response.pressure.total();
                loads.iter().any(|load| (load / pressure - 1.0).abs() < ROUNDING)
            };
            let points = curve(&case.first().comparison, kind).into_iter().filter(is_at_load);
            rows.extend(points.map(|point| {
                let pressure = point.response.pressure.total();
                let separation = rough.interacting(point.response.separation_over_sigma, pressure);
                row(line, Some(kind.name()), pressure, None, Some(separation))
            }));
        }
        let points = case.first().reference.iter().flat_map(|curve| &curve.points);
        rows.extend(points.filter_map(|point| {
            Some(row(line, Some(REFERENCE), point.pressure, None, Some(rough.undeformed(point)?)))
        }));
    }
    rows
}
