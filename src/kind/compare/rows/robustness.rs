//! `robustness.csv`: the differences under other treatments of a measured map.

use asperity::MeanRadius;
use asperity::compare::{ComparedQuantity, Difference, Estimate, Verdict};
use asperity::study::{Treated, Treatment, Verdicts};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::quantity;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;

/// One quantity at one load under one treatment.
pub(crate) struct RobustnessRow<'a> {
    key: CaseKey<'a>,
    treated: &'a Treated,
    at_load: &'a Difference,
    quantity: ComparedQuantity,
    estimate: Estimate,
    verdicts: &'a Verdicts,
}

impl RobustnessRow<'_> {
    fn end(&self, index: usize) -> Option<f64> {
        self.estimate.interval().map(|ends| self.quantity.reported(ends[index]))
    }
}

impl Row for RobustnessRow<'_> {
    const FILE: &'static str = "robustness.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, other treatment of a measured map, load and quantity: the difference of the statistical from the deterministic model at equal load.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            choice["text"] = row.treated.treatment.choice().name(), "The choice that is made in another way: `short-wavelength-cut-off`, `summits`, `mean-radius`, `level`, `spikes` or `part`.";
            treatment["text"] = words(row.treated.treatment), "How it is made.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            at_pa["Pa", prefix("M"), label("at")] = row.at_load.load, "Nominal pressure.";
            valid["true/false"] = row.at_load.exceeded().is_none(), "Whether the load is admissible under this treatment.";
            difference["1", signed, scale(1.0)] = row.quantity.reported(row.estimate.contrast), "The difference: of the separation in sigma, of area and stiffness relative to the deterministic model.";
            low["1", label("95 % interval from"), signed, scale(1.0)] = row.end(0), "Lower end of its 95 % interval; empty where none is claimed.";
            high["1", label("to"), signed, scale(1.0)] = row.end(1), "Upper end of the interval.";
            verdict["text", verdict] = Verdict::from_estimate(&row.estimate, row.verdicts.accepted.band(row.quantity)).name(), "The verdict by the interval: `within`, `beyond` or `cannot-tell`.";
        });
        columns
    }
}

/// The rows: case by case, treatment by treatment.
pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = RobustnessRow<'_>> {
    SurfaceCase::all(results)
        .flat_map(|case| case.case.treated.iter().flat_map(move |treated| with_treatment(case, treated)))
}

fn with_treatment<'a>(
    case: SurfaceCase<'a>,
    treated: &'a Treated,
) -> impl Iterator<Item = RobustnessRow<'a>> {
    treated.differences.iter().flat_map(move |at_load| {
        ComparedQuantity::ALL.into_iter().filter_map(move |quantity| {
            let estimate = at_load.estimates[quantity as usize]?;
            let verdicts = case.verdicts();
            Some(RobustnessRow { key: case.key(), treated, at_load, quantity, estimate, verdicts })
        })
    })
}

pub fn words(treatment: Treatment) -> String {
    match treatment {
        Treatment::ShortWaves(None) => "no S filter".to_owned(),
        Treatment::ShortWaves(Some(s)) => format!("S filter {}", quantity(s, "m")),
        Treatment::Summits(neighbours) => format!("{} summits", neighbours.name()),
        Treatment::MeanRadius(MeanRadius::InverseMeanCurvature) => "1/(mean curvature)".to_owned(),
        Treatment::MeanRadius(mean) => format!("{} mean radius", mean.name()),
        Treatment::Level(level) => format!("level {}", level.name()),
        Treatment::SpikesRemoved => "spikes removed".to_owned(),
        Treatment::SuspectsRemoved(1) => "1 narrow point removed".to_owned(),
        Treatment::SuspectsRemoved(count) => format!("{count} narrow points removed"),
        Treatment::Half(half) => format!("half {} of the map", half + 1),
    }
}
