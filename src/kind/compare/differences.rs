//! `differences.csv`: the differences between the models at equal load that the verdicts rest on.

use asperity::compare::{ComparedQuantity, Difference, Estimate, Verdict};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row};

use super::findings::Verdicts;
use super::results::CompareResults;
use super::tables::limits;

/// One quantity at one load of one surface under one law and thickness.
pub(crate) struct DifferenceRow<'a> {
    surface: &'a str,
    law: &'a str,
    thickness: Option<f64>,
    verdicts: &'a Verdicts,
    at: &'a Difference,
    quantity: ComparedQuantity,
    estimate: Estimate,
}

impl DifferenceRow<'_> {
    fn end(&self, index: usize) -> Option<f64> {
        self.estimate.interval().map(|ends| self.quantity.reported(ends[index]))
    }

    /// `None` beyond the valid range.
    fn verdict(&self) -> Option<&'static str> {
        let verdict = Verdict::of(&self.estimate, self.verdicts.accepted.band(self.quantity));
        self.at.exceeded().is_none().then(|| self.verdicts.name(verdict))
    }
}

impl Row for DifferenceRow<'_> {
    const FILE: &'static str = "differences.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, load and quantity, over all realisations: the difference of the statistical from the deterministic model at equal load, on which the verdicts rest.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface["text"] = row.surface, "Name of the surface.";
            law["text"] = row.law, "Contact law of an asperity.";
            layer_thickness_m["m"] = row.thickness, "Thickness of the layer, 0 for the bare substrate and inf for a flat of the layer's material; empty where the spec has no layer.";
            pressure_pa["Pa"] = row.at.load, "Nominal pressure.";
            force_n["N"] = row.at.load * row.verdicts.area, "The same as a force on the nominal area.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            difference["1"] = row.quantity.reported(row.estimate.contrast), "Statistical minus deterministic model; of the separation in sigma, of area and stiffness relative to the deterministic model. Over several realisations the mean (of areas and stiffnesses the geometric mean of the ratios).";
            low["1"] = row.end(0), "Lower end of the pointwise 95 % interval of the difference; empty where none is claimed.";
            high["1"] = row.end(1), "Upper end of the interval.";
            standard_error["1"] = row.estimate.error, "Standard error of the difference, of area and stiffness of the logarithm of the ratio; empty where no interval is claimed.";
            independent_standard_error["1"] = row.estimate.independent_error, "The same for asperities taken as independent draws.";
            accepted["1"] = row.verdicts.accepted.of(row.quantity), "The largest difference that is accepted.";
            verdict["text"] = row.verdict(), "Whether the interval lies inside what is accepted (`within`), outside (`beyond`) or neither (`cannot-tell`); `blocked` where the surface failed a fitness check; empty beyond the valid range.";
            effective_contacts["1"] = row.at.sharing.map(|sharing| sharing.effective_contacts), "Effective contacts of the deterministic model; over several realisations the mean.";
            limits["text"] = limits(row.at.exceeded()), "Limits of the valid range that are exceeded, as in `curves.csv`.";
        }
    }
}

/// The rows.
pub(crate) fn rows(results: &CompareResults) -> impl Iterator<Item = DifferenceRow<'_>> {
    results.surfaces.iter().flat_map(|found| {
        found.first.cases.iter().zip(&found.findings.cases).flat_map(move |(case, findings)| {
            let verdicts = &findings.verdicts;
            let (surface, law, thickness) = (&*found.surface.name, &*case.law, case.thickness);
            verdicts.differences.iter().flat_map(move |at| {
                let row = move |quantity: ComparedQuantity| {
                    let estimate = at.estimates[quantity as usize]?;
                    Some(DifferenceRow { surface, law, thickness, verdicts, at, quantity, estimate })
                };
                ComparedQuantity::ALL.into_iter().filter_map(row)
            })
        })
    })
}
