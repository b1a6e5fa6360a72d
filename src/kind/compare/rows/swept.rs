//! What a sweep has of a comparison: both models at each load, the difference with its interval, and the verdict.

use asperity::compare::{ByQuantity, ComparedQuantity, Difference, Estimate, ModelKind, Verdict};
use asperity::study::{LoadResults, Verdicts};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Value};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{ELECTRICAL, FRICTION, REFERENCE, THERMAL, limits};

pub(crate) struct SweptRow<'a> {
    key: CaseKey<'a>,
    verdicts: &'a Verdicts,
    at_load: &'a Difference,
    results: LoadResults,
    is_reported: bool,
}

impl SweptRow<'_> {
    fn value(&self, quantity: ComparedQuantity, model: Option<ModelKind>) -> Option<f64> {
        self.results.models.iter().find(|result| result.model == model)?.point.value(quantity)
    }

    fn estimate(&self, quantity: ComparedQuantity) -> Option<Estimate> {
        self.at_load.estimates[quantity as usize]
    }

    fn end(&self, quantity: ComparedQuantity, end: usize) -> Option<f64> {
        Some(quantity.reported(self.estimate(quantity)?.interval()?[end]))
    }

    /// `None` where the load is not admissible.
    fn verdict(&self, quantity: ComparedQuantity) -> Option<&'static str> {
        let estimate = self.estimate(quantity).filter(|_| self.at_load.exceeded().is_none())?;
        Some(self.verdicts.name(Verdict::from_estimate(&estimate, self.verdicts.accepted.band(quantity))))
    }
}

/// The quantities as columns begin with them: the name without and with the unit, the unit, and the part of a run without which they are not there.
const QUANTITIES: ByQuantity<(&str, &str, &str, Option<&str>)> = [
    ("separation", "separation_over_sigma", "1", None),
    ("area", "area_ratio", "1", None),
    ("stiffness", "stiffness_pa_per_m", "Pa/m", None),
    ("electrical_conductance", "electrical_conductance_s_per_m2", "S/m²", Some(ELECTRICAL)),
    ("thermal_conductance", "thermal_conductance_w_per_m2_k", "W/(m² K)", Some(THERMAL)),
    ("friction", "friction", "1", Some(FRICTION)),
];

/// The name of a column: of a `model` (`statistical`, `deterministic`, `reference`), or `difference`, `low`, `high` or `verdict`.
pub(crate) fn swept_name(quantity: ComparedQuantity, what: &str) -> String {
    let (short, with_unit, ..) = QUANTITIES[quantity as usize];
    match what {
        "statistical" | "deterministic" | REFERENCE => format!("{what}_{with_unit}"),
        other => format!("{short}_{other}"),
    }
}

impl Row for SweptRow<'_> {
    const FILE: &'static str = "swept.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness and load, over all realisations: both models, the difference with its 95 % interval, and the verdict.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.at_load.load, "Nominal pressure.";
            reported["true/false"] = row.is_reported, "Whether results are reported at this load: that of the spec, of several the middle one of those that are admissible.";
            limits["text"] = limits(row.at_load.exceeded()), "Limits of admissible loads that are exceeded, as in `curves.csv`.";
        });
        for quantity in ComparedQuantity::REPORTED {
            columns.extend(of_quantity(quantity));
        }
        columns
    }
}

fn of_quantity<'a>(quantity: ComparedQuantity) -> Vec<Column<SweptRow<'a>>> {
    let (short, _, unit, part) = QUANTITIES[quantity as usize];
    let name = |what: &str| swept_name(quantity, what);
    let words = short.replace('_', " ");
    let model = |model: Option<ModelKind>, title: &str| {
        let value = move |row: &SweptRow| Value::from(row.value(quantity, model));
        Column::new(name(model.map_or(REFERENCE, ModelKind::name)), unit, format!("{title}: {words}."), value)
    };
    let of_difference = |what: &str, meaning: &str, value: fn(&SweptRow, ComparedQuantity) -> Option<f64>| {
        let column =
            Column::new(name(what), "1", meaning, move |row: &SweptRow| Value::from(value(row, quantity)));
        let column = column.scale(1.0);
        if quantity == ComparedQuantity::Separation { column.signed() } else { column.signed_percent() }
    };
    let verdict = Column::new(
        name("verdict"),
        "text",
        "The verdict on the difference, as in `differences.csv`; empty where the load is not admissible.",
        move |row: &SweptRow| Value::from(row.verdict(quantity)),
    );
    let columns = vec![
        model(Some(ModelKind::Statistical), "Statistical model"),
        model(Some(ModelKind::Deterministic), "Deterministic model"),
        model(None, "Reference").part(REFERENCE),
        of_difference(
            "difference",
            "Statistical minus deterministic: relative, of the separation in sigma.",
            |row, quantity| Some(quantity.reported(row.estimate(quantity)?.contrast)),
        ),
        of_difference(
            "low",
            "Lower end of its 95 % interval; empty where none is claimed.",
            |row, quantity| row.end(quantity, 0),
        ),
        of_difference("high", "Upper end.", |row, quantity| row.end(quantity, 1)),
        verdict.verdict(),
    ];
    let with_part = |column: Column<SweptRow<'a>>| match part {
        Some(part) if column.heading.part.is_none() => column.part(part),
        _ => column,
    };
    columns.into_iter().map(with_part).collect()
}

pub(crate) fn rows(results: &CompareResults) -> impl Iterator<Item = SweptRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let reported = case.case.reported_load().map(|at| at.load);
        let mut loads: Vec<&Difference> = case.verdicts().differences.iter().collect();
        loads.sort_by(|a, b| a.load.total_cmp(&b.load));
        loads.into_iter().map(move |at_load| SweptRow {
            key: case.key(),
            verdicts: case.verdicts(),
            at_load,
            results: case.case.results_at(at_load.load),
            is_reported: reported == Some(at_load.load),
        })
    })
}
