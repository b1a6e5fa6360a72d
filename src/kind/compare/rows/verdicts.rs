//! `verdicts.csv`: whether the statistical model may replace the sum.

use asperity::compare::{ModelKind, Stretch};
use asperity::study::{LeadingCause, StatedCause};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::reference::ElasticCase;
use crate::kind::compare::results::CompareResults;
use crate::model_tables::REFERENCE;

/// A stretch of load with one verdict.
pub(crate) struct VerdictRow<'a> {
    key: CaseKey<'a>,
    stretch: &'a Stretch,
    /// The model, and what it is compared with.
    names: [&'static str; 2],
    verdict: &'static str,
    area_needed: Option<f64>,
    cause: Option<StatedCause>,
    depends_on: Vec<String>,
    elastic: Option<&'a ElasticCase>,
}

impl VerdictRow<'_> {
    fn largest(&self) -> Option<f64> {
        self.stretch.largest.map(|(_, estimate)| self.stretch.quantity.reported(estimate.contrast))
    }

    fn end(&self, index: usize) -> Option<f64> {
        let ends = self.stretch.largest.and_then(|(_, estimate)| estimate.interval())?;
        Some(self.stretch.quantity.reported(ends[index]))
    }
}

impl Row for VerdictRow<'_> {
    const FILE: &'static str = "verdicts.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, quantity, model, what it is compared with and stretch of load with one verdict, over all realisations.";
    const RECORDS: Option<&'static str> = Some("verdicts");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            quantity["text"] = row.stretch.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            against["text"] = row.names[1], "What the model is compared with: `deterministic` or `reference`.";
            model["text"] = row.names[0], "The model that is judged: `statistical` or `deterministic`.";
            from_pa["Pa", prefix("M"), label("from"), input] = row.stretch.loads[0], "Lowest nominal pressure of the stretch.";
            to_pa["Pa", prefix("M"), label("to"), input] = row.stretch.loads[1], "Highest nominal pressure of the stretch.";
            verdict["text", verdict] = row.verdict, "Whether the 95 % interval of the difference lies inside what is accepted (`within`), outside (`beyond`) or neither (`cannot-tell`) at all loads of the stretch; `very-likely-within` and `very-likely-beyond` of a model-based interval that does not decide at twice its width, the latter also of a difference of ten times what is accepted (of the logarithm of a ratio) on all halves of a map without interval; `blocked` on a surface that failed a fitness check.";
            difference["1", label("largest difference"), signed, scale(1.0)] = row.largest(), "The largest difference in the stretch: of the separation in sigma, of area and stiffness relative to what the model is compared with.";
            low["1", label("95 % interval from"), signed, scale(1.0)] = row.end(0), "Lower end of its 95 % interval; empty where none is claimed.";
            high["1", label("to"), signed, scale(1.0)] = row.end(1), "Upper end of the interval.";
            at_pa["Pa", prefix("M"), label("at")] = row.stretch.largest.map(|(load, _)| load), "Nominal pressure of the largest difference.";
            accepted["1"] = row.stretch.accepted, "The largest difference that is accepted.";
            area_needed_m2["m²", prefix("m"), label("needs at least")] = row.area_needed, "Nominal area at which half of the loads of a stretch that cannot be told have an interval, or one that no longer crosses the edge of the band; more where another sample differs more. Empty of other stretches, and where contacts are not what is missing. A blocked map must be fit first.";
            cause["text", label("leading cause there")] = row.cause.and_then(StatedCause::leading).map(LeadingCause::name), "The leading cause of the largest difference, not of the whole stretch: `heights`, `radii` (their spread), `correlation` or, of the statistical model against the reference, `left-out` (what the sum leaves out: interaction and shape of the asperities, under a cap also the law, under a layer also the rule of the effective modulus). Empty unless the 95 % interval of the difference excludes zero and that of the cause, all orders of replacement included, is apart from those of the others; and on a blocked map.";
            largest_on_map["text", label("largest on this map, there")] = row.cause.and_then(StatedCause::largest_on_surface).map(LeadingCause::name), "Where no cause leads, the cause with the largest contribution to that difference on the one surface that was compared; empty unless it is the same in every order of replacement and wherever the reference lies in its bounds.";
            depends_on["text", label("depends on")] = row.depends_on.clone(), "Choices in the analysis of the map that reverse the verdict on this quantity; `spikes` also where a verdict is left open without points that may be wrong.";
            elastic_reference["text", label("elastic reference")] = row.elastic.map(|elastic| elastic.reason.name()), "Against the reference: why it stays elastic although the law yields, as in `nearer_to_reference.csv`; empty otherwise.";
        });
        columns
    }
}

/// The rows, case by case; those against the reference last.
pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = VerdictRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| of_case(case, results.elastic_reference(case)))
}

fn of_case<'a>(case: SurfaceCase<'a>, elastic: Option<&'a ElasticCase>) -> Vec<VerdictRow<'a>> {
    let verdicts = case.verdicts();
    let mut rows = Vec::new();
    for stretch in &verdicts.stretches {
        let dependences = case.case.dependences.iter().filter(|one| one.quantity == stretch.quantity);
        rows.push(VerdictRow {
            key: case.key(),
            stretch,
            names: [ModelKind::Statistical.name(), ModelKind::Deterministic.name()],
            verdict: verdicts.name(stretch.verdict),
            area_needed: verdicts.area_needed(stretch),
            cause: verdicts.cause(stretch),
            depends_on: dependences.map(|one| one.choice.name().to_owned()).collect(),
            elastic: None,
        });
    }
    let Some(reference) = &verdicts.reference else { return rows };
    for (kind, stretches) in
        [ModelKind::Statistical, ModelKind::Deterministic].into_iter().zip(&reference.stretches)
    {
        rows.extend(stretches.iter().map(|stretch| VerdictRow {
            key: case.key(),
            stretch,
            names: [kind.name(), REFERENCE],
            verdict: verdicts.name(stretch.verdict),
            area_needed: verdicts.area_needed(stretch),
            // The difference of the sum has one part only.
            cause:
                (kind == ModelKind::Statistical).then(|| verdicts.cause_against_reference(stretch)).flatten(),
            depends_on: Vec::new(),
            elastic,
        }));
    }
    rows
}
