//! `verdicts.csv`, `differences.csv` and `attribution.csv`: how far the models are apart, and why.

use asperity::compare::{
    Attribution, Cause, ComparedQuantity, Contribution, Contributions, Difference, Estimate, ModelKind,
    Order, Stretch, Verdict,
};
use asperity::study::{LeadingCause, StatedCause, Verdicts};
use asperity_contact_framework::rows;

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::reference::ElasticCase;
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{REFERENCE, limits};

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

rows! { VerdictRow<'_> => "verdicts.csv", records "verdicts";
    "One row for each surface, law, layer thickness, quantity, model, what it is compared with and stretch of load with one verdict, over all realisations.";
    ..case_columns(|row: &Self| row.key);
    row =>
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

rows! { DifferenceRow<'_> => "differences.csv", is_long true;
    "One row for each surface, law, layer thickness, load and quantity, over all realisations: the difference of the statistical from the deterministic model at equal load, on which the verdicts rest; where a reference was run, that of each model from the reference, too.";
    ..case_columns(|row: &Self| row.key);
    row =>
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
}

pub(crate) fn differences(results: &CompareResults) -> impl Iterator<Item = DifferenceRow<'_>> {
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

/// The contribution of one cause to one quantity at one load.
pub(crate) struct AttributionRow<'a> {
    key: CaseKey<'a>,
    at_load: &'a Attribution,
    quantity: ComparedQuantity,
    cause: &'static str,
    contribution: &'a Contribution,
    with_other_radius: Option<f64>,
}

/// The name of the spread of radii and their correlation with the heights together.
const RADII_TOGETHER: &str = "radii-and-correlation";

impl<'a> AttributionRow<'a> {
    /// The attribution of a quantity at a load: each cause, and the radii together.
    fn all(
        key: CaseKey<'a>,
        at_load: &'a Attribution,
        quantity: ComparedQuantity,
        parts: &'a Contributions,
    ) -> [Self; 4] {
        let row = |cause, contribution, causes: &[Cause]| {
            let with_other_radius =
                parts.with_other_radius.map(|parts| causes.iter().map(|&cause| parts[cause as usize]).sum());
            Self { key, at_load, quantity, cause, contribution, with_other_radius }
        };
        let of_cause = |cause: Cause| row(cause.name(), parts.of_cause(cause), &[cause]);
        let [heights, radii, correlation] = Cause::ALL.map(of_cause);
        let together = row(RADII_TOGETHER, &parts.radii, &[Cause::Radii, Cause::Correlation]);
        [heights, radii, correlation, together]
    }

    fn end(&self, index: usize) -> Option<f64> {
        self.contribution.interval().map(|ends| ends[index])
    }

    fn in_order(&self, order: Order) -> f64 {
        self.contribution.by_order[order as usize].contrast
    }
}

rows! { AttributionRow<'_> => "attribution.csv", is_long true;
    "One row for each surface, law, layer thickness, load, quantity and cause, over all realisations: what each cause contributes to the difference between the models at equal load. Heights, radii and correlation add up to the difference; the row `radii-and-correlation` holds the last two together; loads that fewer than 30 effective contacts carry, or one contact with more than 10 % of the load, have none.";
    ..case_columns(|row: &Self| row.key);
    row =>
    pressure_pa["Pa"] = row.at_load.load, "Nominal pressure.";
    quantity["text"] = row.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
    cause["text"] = row.cause, "The cause: `heights` (the heights do not follow the density of the statistical model), `radii` (the radii are not all equal to the mean radius) or `correlation` (heights and radii are correlated; with equal radii, what replacing a sum by its integral leaves); `radii-and-correlation` is the sum of the last two: different radii in the sense of Fig. 3 of Pasaribu and Schipper (2005).";
    contribution["1", signed, scale(1.0)] = row.contribution.mean.contrast, "Mean contribution over the three orders: of the separation in sigma, of area and stiffness to ln(statistical/deterministic).";
    low["1", signed, scale(1.0)] = row.end(0), "Lower end of the pointwise 95 % interval of the contribution, which holds the intervals of all three orders; empty where none is claimed.";
    high["1", signed, scale(1.0)] = row.end(1), "Upper end of the interval.";
    standard_error["1"] = row.contribution.mean.error, "Standard error of the mean over the orders, from blocks of a map, groups of independent asperities or realisations; empty where no interval is claimed.";
    heights_radii_correlation["1", signed, scale(1.0)] = row.in_order(Order::HeightsFirst), "Contribution where first the heights, then the radii, then the correlation is changed.";
    radii_heights_correlation["1", signed, scale(1.0)] = row.in_order(Order::RadiiFirst), "Contribution where first the radii, then the heights, then the correlation is changed.";
    radii_correlation_heights["1", signed, scale(1.0)] = row.in_order(Order::HeightsLast), "Contribution where first the radii, then the correlation, then the heights are changed.";
    with_other_mean_radius["1", signed, scale(1.0)] = row.with_other_radius, "Mean contribution over the orders if the statistical model took the other mean radius: 1/(mean curvature) for the arithmetic mean, and the reverse. Empty of nominal populations and elliptic laws.";
}

pub(super) fn attribution(results: &CompareResults) -> impl Iterator<Item = AttributionRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        case.verdicts().attribution.iter().flat_map(move |at_load| {
            let quantities = ComparedQuantity::ALL.into_iter();
            let divided =
                quantities.filter_map(|quantity| Some((quantity, at_load.contributions(quantity)?)));
            divided
                .flat_map(move |(quantity, parts)| AttributionRow::all(case.key(), at_load, quantity, parts))
        })
    })
}
