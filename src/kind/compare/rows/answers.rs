//! `answers.csv`: may the integral replace the sum, case by case.

use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::card::{CaseAnswer, Nearer};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{ELECTRICAL, FRICTION, THERMAL};

/// The answer on one case.
pub(crate) struct AnswerRow<'a> {
    key: CaseKey<'a>,
    answer: CaseAnswer,
}

impl AnswerRow<'_> {
    fn answer(&self, place: usize) -> Option<&'static str> {
        self.answer.quantities[place].map(|(answer, _)| answer.name())
    }

    fn difference(&self, place: usize) -> Option<f64> {
        self.answer.quantities[place]?.1
    }
}

impl Row for AnswerRow<'_> {
    const FILE: &'static str = "answers.csv";
    const ROWS: &'static str = "One row for each surface, law and layer thickness: may the integral replace the sum on such surfaces, over the admissible loads. `yes`: within what is accepted at all of them, surely or very likely; `no`: beyond it where that can be told; `yes/?`: within it where that can be told; `in part`: within at some and beyond at others; `?`: cannot be told; `outside`: no load is admissible; `unfit`: the map fails a fitness check.";
    const RECORDS: Option<&'static str> = Some("answers");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            area["text", label("contact area"), verdict] = row.answer(0), "The answer for the real contact area.";
            area_difference["1", label("largest"), signed_percent] = row.difference(0), "The largest difference of the integral from the sum at admissible loads, relative; where it is beyond what is accepted, at such loads.";
            separation["text", verdict] = row.answer(1), "The answer for the separation.";
            separation_difference["1", label("largest (σ)"), signed, scale(1.0)] = row.difference(1), "The largest difference, in sigma.";
            stiffness["text", verdict] = row.answer(2), "The answer for the stiffness.";
            stiffness_difference["1", label("largest"), signed_percent] = row.difference(2), "The largest difference, relative.";
            electrical_conductance["text", part(ELECTRICAL), verdict] = row.answer(3), "The answer for the electrical conductance; there only where it is asked for.";
            electrical_conductance_difference["1", part(ELECTRICAL), label("largest"), signed_percent] = row.difference(3), "The largest difference, relative.";
            thermal_conductance["text", part(THERMAL), verdict] = row.answer(4), "The answer for the thermal conductance, likewise.";
            thermal_conductance_difference["1", part(THERMAL), label("largest"), signed_percent] = row.difference(4), "The largest difference, relative.";
            friction["text", part(FRICTION), verdict] = row.answer(5), "The answer for the coefficient of friction, likewise.";
            friction_difference["1", part(FRICTION), label("largest"), signed_percent] = row.difference(5), "The largest difference, relative.";
            why["text"] = row.answer.why.as_str(), "The cause of the largest difference that is beyond what is accepted, in area or else in the named quantity: the leading one; with `(here)` the largest on the compared surface.";
            use_instead["text", label("use")] = row.answer.instead.as_str(), "What to use at that load: `the integral`, a statistical model of `ranking.csv` within what is accepted, `the sum`, or `boundary elements`.";
            nearer["text", label("nearer to boundary elements")] = row.answer.nearer.map(Nearer::name), "Which model is nearer to boundary elements in contact area: `the sum` or `the integral` at some admissible loads and the other at none, `depends on load`: each at some, `?`: undecided at all; on the compared surface, of several realisations in their mean; empty where they were not run, no such load is admissible, or the map is not fit.";
        });
        columns
    }
}

pub fn rows(results: &CompareResults) -> impl Iterator<Item = AnswerRow<'_>> {
    SurfaceCase::all(results)
        .filter_map(|case| Some(AnswerRow { key: case.key(), answer: CaseAnswer::new(case)? }))
}
