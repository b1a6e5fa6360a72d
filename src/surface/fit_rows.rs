//! The table of the steps by which a preparation was found.

use asperity::surface::{FitStep, Surface};
use asperity::topography::fitness::Finding;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};
use serde_json::Value;

use super::{fit, fitness};

/// A failed check, and what was done about it.
pub struct FitStepRow<'a> {
    surface: &'a Surface,
    /// From 1.
    number: usize,
    step: &'a FitStep,
}

/// Columns of the steps for people.
pub const STEP: [&str; 8] =
    ["check", "measured", "remedy", "value_before", "value_after", "allowed", "result", "reason"];

impl<'a> FitStepRow<'a> {
    /// None of a surface whose preparation is prescribed.
    pub fn all(surface: &'a Surface) -> impl Iterator<Item = Self> {
        let steps = surface.fit.iter().flat_map(|fit| &fit.steps);
        steps.zip(1..).map(move |(step, number)| Self { surface, number, step })
    }

    fn result(&self) -> &'static str {
        match (&self.step.not_applied, self.step.remedy) {
            (None, _) => "applied",
            (Some(_), Some(_)) => "refused",
            (Some(_), None) => "left",
        }
    }
}

impl Row for FitStepRow<'_> {
    const FILE: &'static str = "fit_steps.csv";
    const ROWS: &'static str = "One row for each surface with `fit` and remedy of a failed check, in the order in which they were tried.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface["text"] = row.surface.name.as_str(), "Name of the surface.";
            step["count"] = row.number, "Number of the step, from 1.";
            check["text"] = row.step.before.check.name(), "The check that failed.";
            measure["text"] = row.step.before.measure.name(), "What it measured.";
            measured["text"] = fitness::measured(row.step.before.measure), "The same in words.";
            remedy["text"] = row.step.remedy.map(fitness::written), "The remedy as a spec has it; empty where no preparation helps.";
            value_before["1", label("before")] = row.step.before.value, "Value of this measure without the remedy.";
            value_after["1", label("after")] = row.step.after.map(|finding| finding.value), "Value of the same measure with it; empty where it was not tried, and of form where `cubic` leaves none of a higher degree to look for.";
            allowed["text"] = fitness::allowed(&row.step.before), "The values of this measure that pass.";
            passed_after["true/false"] = row.step.check_after.as_ref().map(Finding::has_passed), "Whether the map passes the check, all of its measures, with the remedy.";
            sq_after_over_before["1"] = row.step.sq_ratio, "Sq with the remedy over Sq without it.";
            result["text"] = row.result(), "The result: `applied`, `refused`, or `left` where no preparation helps.";
            reason["text"] = fit::reason(row.step), "Why the remedy was not applied.";
        }
    }
}

/// The steps of a surface as in `summary.json`.
pub fn fit_records(surface: &Surface) -> Value {
    Table::new(FitStepRow::all(surface)).records()
}
