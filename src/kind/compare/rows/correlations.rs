//! `correlations.csv`: correlations of the conductance, and on a finite map the cluster of spots, against the contact.

use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::correlations::Correlated;
use crate::kind::compare::results::CompareResults;

/// One correlation of one conductance.
pub(crate) struct CorrelationRow<'a> {
    key: CaseKey<'a>,
    found: Correlated,
}

impl Row for CorrelationRow<'_> {
    const FILE: &'static str = "correlations.csv";
    const ROWS: &'static str = "One row for each surface, law, conductance and correlation in use for it, on the first realisation with the r.m.s. height and gradient of its map.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            conductance["text"] = row.found.quantity.name(), "The conductance.";
            correlation["text"] = row.found.formula.name(), "The correlation: `cooper-mikic-yovanovich` for plastic contact, 1.25 (m/sigma) (p/H)^0.95/s, or `mikic` for elastic contact, 1.55 (m/sigma) (2^0.5 p/(E* m))^0.94/s; m is the mean absolute slope, s the mean resistivity. With a reference on a finite map also `greenwood-cluster`: the spots of the sum at the same load as a cluster between half-spaces (Greenwood 1966).";
            against["text"] = row.found.against, "What it is compared with: the `reference`; for a correlation of an interface without end, where none without end was run, the `deterministic` model.";
            accepted["1", percent] = row.found.accepted, "The largest difference that is accepted.";
            from_pa["Pa", prefix("M"), label("within from")] = row.found.within().map(|loads| loads[0]), "Lowest nominal pressure of the longest stretch of admissible loads that were run at which it is within what is accepted, also where what it is compared with is off by its bound; empty where it is at none.";
            to_pa["Pa", prefix("M"), label("to")] = row.found.within().map(|loads| loads[1]), "Highest such pressure.";
            lowest_difference["1", signed_percent] = row.found.range()[0], "Smallest relative difference over the admissible loads.";
            bound["1", percent] = row.found.bound(), "Largest bound of the error of the reference, relative; 0 of the sum.";
            highest_difference["1", signed_percent] = row.found.range()[1], "Largest relative difference over the admissible loads.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = CorrelationRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let all = Correlated::all(case).unwrap_or_default().into_iter();
        all.map(move |found| CorrelationRow { key: case.key(), found })
    })
}
