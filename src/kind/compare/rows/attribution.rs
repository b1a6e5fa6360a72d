//! `attribution.csv`: the differences between the models at equal load divided among their causes.

use asperity::compare::{Attribution, Cause, ComparedQuantity, Contribution, Contributions, Order};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;

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
    /// The rows of a quantity at a load: each cause, and the radii together.
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

impl Row for AttributionRow<'_> {
    const FILE: &'static str = "attribution.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, load, quantity and cause, over all realisations: what each cause contributes to the difference between the models at equal load. Heights, radii and correlation add up to the difference; the row `radii-and-correlation` holds the last two together; loads that fewer than 30 effective contacts carry, or one contact with more than 10 % of the load, have none.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
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
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = AttributionRow<'_>> {
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
