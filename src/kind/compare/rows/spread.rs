//! `spread.csv`: the scatter of both models over several realisations.

use asperity::compare::Spread;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;

/// Both models at a load that all realisations have in common.
pub(crate) struct SpreadRow<'a> {
    key: CaseKey<'a>,
    spread: &'a Spread,
}

impl Row for SpreadRow<'_> {
    const FILE: &'static str = "spread.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness and load of a surface with several realisations: means and standard deviations over them, at equal load.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.spread.target, "Nominal pressure.";
            statistical_separation_over_sigma["1", label("d/σ, statistical")] = row.spread.statistical_separation.mean, "Statistical model: mean separation over sigma.";
            deterministic_separation_over_sigma["1", label("d/σ, deterministic")] = row.spread.deterministic_separation.mean, "Deterministic model: mean separation over sigma.";
            deterministic_separation_deviation["1", label("± s.d.")] = row.spread.deterministic_separation.deviation, "Its standard deviation over the realisations.";
            estimated_error["1"] = row.spread.sampling_error, "The sampling error of the separation estimated from a single sum, for independent asperities.";
            difference["1", label("difference (σ)"), signed, scale(1.0)] = row.spread.difference.mean, "Mean difference of the separations, in sigma.";
            difference_deviation["1", label("± s.d.")] = row.spread.difference.deviation, "Its standard deviation.";
            statistical_area_ratio["1", label("A/A_nom, statistical")] = row.spread.statistical_area.mean, "Statistical model: mean real contact area over nominal area.";
            deterministic_area_ratio["1", label("A/A_nom, deterministic")] = row.spread.deterministic_area.mean, "Deterministic model: the same.";
            deterministic_area_deviation["1", label("± s.d.")] = row.spread.deterministic_area.deviation, "Its standard deviation.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = SpreadRow<'_>> {
    SurfaceCase::all(results)
        .flat_map(|case| case.case.spread.iter().map(move |spread| SpreadRow { key: case.key(), spread }))
}
