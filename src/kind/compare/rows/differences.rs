//! `differences.csv`: the differences between the models at equal load that the verdicts rest on.

use asperity::compare::{ComparedQuantity, Difference, Estimate, ModelKind, Verdict};
use asperity::study::Verdicts;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{REFERENCE, limits};

/// One quantity at one load of one surface under one law and thickness.
pub(crate) struct DifferenceRow<'a> {
    key: CaseKey<'a>,
    verdicts: &'a Verdicts,
    at_load: &'a Difference,
    /// m²
    load_area: f64,
    /// The model, and what it is compared with.
    names: [&'static str; 2],
    quantity: ComparedQuantity,
    estimate: Estimate,
}

impl DifferenceRow<'_> {
    fn end(&self, index: usize) -> Option<f64> {
        self.estimate.interval().map(|ends| self.quantity.reported(ends[index]))
    }

    /// `None` where the load is not admissible.
    fn verdict(&self) -> Option<&'static str> {
        let verdict = Verdict::from_estimate(&self.estimate, self.verdicts.accepted.band(self.quantity));
        self.at_load.exceeded().is_none().then(|| self.verdicts.name(verdict))
    }
}

impl Row for DifferenceRow<'_> {
    const FILE: &'static str = "differences.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, load and quantity, over all realisations: the difference of the statistical from the deterministic model at equal load, on which the verdicts rest; where a reference was run, that of each model from the reference, too.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            pressure_pa["Pa", prefix("M")] = row.at_load.load, "Nominal pressure.";
            force_n["N"] = row.at_load.load * row.load_area, "The same as a force on the area that the load acts on: `nominal-area` of the spec, or that of the surface.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            model["text"] = row.names[0], "The model that is compared: `statistical` or `deterministic`.";
            against["text"] = row.names[1], "What it is compared with: `deterministic` or `reference`.";
            difference["1", signed, scale(1.0)] = row.quantity.reported(row.estimate.contrast), "The model minus what it is compared with; of the separation in sigma, of area and stiffness relative to what it is compared with. Over several realisations the mean (of areas and stiffnesses the geometric mean of the ratios).";
            low["1", signed, scale(1.0)] = row.end(0), "Lower end of the pointwise 95 % interval of the difference; empty where none is claimed.";
            high["1", signed, scale(1.0)] = row.end(1), "Upper end of the interval.";
            bound["1"] = row.estimate.bound, "Part of the half-width of the interval that bounds errors of solver and discretisation of the reference, of area and stiffness of the logarithm of the ratio.";
            standard_error["1"] = row.estimate.error, "Standard error of the difference, of area and stiffness of the logarithm of the ratio; empty where no interval is claimed.";
            independent_standard_error["1"] = row.estimate.independent_error, "The same for asperities taken as independent draws.";
            accepted["1"] = row.verdicts.accepted.limit(row.quantity), "The largest difference that is accepted.";
            verdict["text", verdict] = row.verdict(), "Whether the interval lies inside what is accepted (`within`), outside (`beyond`) or neither (`cannot-tell`); `blocked` where the surface failed a fitness check; empty where the load is not admissible.";
            effective_contacts["1"] = row.at_load.sharing.map(|sharing| sharing.effective_contacts), "Effective contacts of the deterministic model; over several realisations the mean.";
            limits["text"] = limits(row.at_load.exceeded()), "Limits of admissible loads that are exceeded, as in `curves.csv`.";
        });
        columns
    }
}

pub(crate) fn rows(results: &CompareResults) -> impl Iterator<Item = DifferenceRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let verdicts = case.verdicts();
        let [statistical, deterministic] = [ModelKind::Statistical.name(), ModelKind::Deterministic.name()];
        let mut compared = vec![([statistical, deterministic], &verdicts.differences)];
        if let Some(reference) = &verdicts.reference {
            let [of_statistical, of_deterministic] = &reference.against.models;
            compared.push(([statistical, REFERENCE], of_statistical));
            compared.push(([deterministic, REFERENCE], of_deterministic));
        }
        compared.into_iter().flat_map(move |(names, differences)| {
            differences.iter().flat_map(move |at_load| {
                ComparedQuantity::ALL.into_iter().filter_map(move |quantity| {
                    let estimate = at_load.estimates[quantity as usize]?;
                    let load_area = case.surface.load_area;
                    Some(DifferenceRow {
                        key: case.key(),
                        verdicts,
                        at_load,
                        load_area,
                        names,
                        quantity,
                        estimate,
                    })
                })
            })
        })
    })
}
