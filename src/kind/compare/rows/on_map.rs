//! `on_map.csv`: what holds on the compared surface itself.

use asperity::compare::OnMap;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::limits;

/// A stretch of load on the compared surface.
pub(crate) struct OnMapRow<'a> {
    key: CaseKey<'a>,
    on_map: &'a OnMap,
    is_fit: bool,
}

impl OnMapRow<'_> {
    fn reported(&self, contrast: f64) -> f64 {
        self.on_map.quantity.reported(contrast)
    }
}

impl Row for OnMapRow<'_> {
    const FILE: &'static str = "on_map.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, quantity and stretch of load at which the statistical model is within what is accepted on the compared surface itself, or beyond it. There the sum over its asperities is exact, and the difference needs no interval; what holds of other samples of the surface is in `verdicts.csv`. Over several realisations the mean difference counts.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            quantity["text"] = row.on_map.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            from_pa["Pa", prefix("M"), label("from"), input] = row.on_map.loads[0], "Lowest nominal pressure of the stretch.";
            to_pa["Pa", prefix("M"), label("to"), input] = row.on_map.loads[1], "Highest nominal pressure of the stretch.";
            on_map["text", label("on this map"), verdict] = row.on_map.name(), "Whether the difference on the compared surface is `within` what is accepted or `beyond` it at all loads of the stretch.";
            difference["1", label("largest difference"), signed, scale(1.0)] = row.reported(row.on_map.largest.1), "The largest difference in the stretch: of the separation in sigma, of area and stiffness relative to the sum.";
            at_pa["Pa", prefix("M"), label("at")] = row.on_map.largest.0, "Nominal pressure of the largest difference.";
            accepted["1"] = row.on_map.accepted, "The largest difference that is accepted.";
            limits["text", label("exceeds")] = limits(row.on_map.exceeded), "Limits of admissible loads that are exceeded in the stretch, as in `curves.csv`; empty where its loads are admissible.";
            fit["true/false", label("map fit")] = row.is_fit, "Whether the surface passes the fitness checks that block a verdict.";
        });
        columns
    }
}

/// The rows, case by case.
pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = OnMapRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let is_fit = !case.verdicts().is_blocked;
        case.verdicts().on_map.iter().map(move |on_map| OnMapRow { key: case.key(), on_map, is_fit })
    })
}
