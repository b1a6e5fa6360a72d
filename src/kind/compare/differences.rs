//! `differences.csv`: the differences between the models at equal load that the verdicts rest on.

use asperity::compare::{ComparedQuantity, Difference, Estimate, Kind, Verdict};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row};

use super::findings::Verdicts;
use super::results::CompareResults;
use super::tables::{REFERENCE, limits};

/// One quantity at one load of one surface under one law and thickness.
pub(crate) struct DifferenceRow<'a> {
    surface: &'a str,
    law: &'a str,
    thickness: Option<f64>,
    verdicts: &'a Verdicts,
    at: &'a Difference,
    /// The model, and what it is compared with.
    names: [&'static str; 2],
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
    const ROWS: &'static str = "One row for each surface, law, layer thickness, load and quantity, over all realisations: the difference of the statistical from the deterministic model at equal load, on which the verdicts rest; where a reference was run, that of each model from the reference, too.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface["text"] = row.surface, "Name of the surface.";
            law["text"] = row.law, "Contact law of an asperity.";
            layer_thickness_m["m"] = row.thickness, "Thickness of the layer, 0 for the bare substrate and inf for a flat of the layer's material; empty where the spec has no layer.";
            pressure_pa["Pa"] = row.at.load, "Nominal pressure.";
            force_n["N"] = row.at.load * row.verdicts.area, "The same as a force on the nominal area.";
            quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            model["text"] = row.names[0], "The model that is compared: `statistical` or `deterministic`.";
            against["text"] = row.names[1], "What it is compared with: `deterministic` or `reference`.";
            difference["1"] = row.quantity.reported(row.estimate.contrast), "The model minus what it is compared with; of the separation in sigma, of area and stiffness relative to what it is compared with. Over several realisations the mean (of areas and stiffnesses the geometric mean of the ratios).";
            low["1"] = row.end(0), "Lower end of the pointwise 95 % interval of the difference; empty where none is claimed.";
            high["1"] = row.end(1), "Upper end of the interval.";
            bound["1"] = row.estimate.bound, "Part of the half-width of the interval that bounds errors of solver and discretisation of the reference, of area and stiffness of the logarithm of the ratio.";
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
pub(crate) fn rows<'a>(results: &'a CompareResults) -> impl Iterator<Item = DifferenceRow<'a>> {
    results.surfaces.iter().flat_map(|found| {
        found.first.cases.iter().zip(&found.findings.cases).flat_map(move |(case, findings)| {
            let verdicts = &findings.verdicts;
            let (surface, law, thickness) = (&*found.surface.name, &*case.law, case.thickness);
            let [statistical, deterministic] = [Kind::Statistical.name(), Kind::Deterministic.name()];
            let of = move |names: [&'static str; 2],
                           differences: &'a [Difference]|
                  -> Vec<DifferenceRow<'a>> {
                let row = |at: &'a Difference, quantity: ComparedQuantity| {
                    let estimate = at.estimates[quantity as usize]?;
                    Some(DifferenceRow { surface, law, thickness, verdicts, at, names, quantity, estimate })
                };
                let of_load = |at| ComparedQuantity::ALL.map(|quantity| row(at, quantity));
                differences.iter().flat_map(of_load).flatten().collect()
            };
            let mut rows = of([statistical, deterministic], &verdicts.differences);
            if let Some(reference) = &verdicts.reference {
                rows.extend(of([statistical, REFERENCE], &reference.against.models[0]));
                rows.extend(of([deterministic, REFERENCE], &reference.against.models[1]));
            }
            rows
        })
    })
}
