//! The tables of a limit.

use asperity::compare::{ErrorSlope, LimitPoint, LimitQuantity, ModelKind};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};

use super::run::LimitResults;
use crate::model_tables::{CurveRow, PairRow, RowCase, comparison_of_models, curves_of_models};

/// The errors of sets of one size at one separation.
pub struct ConvergenceRow<'a> {
    point: &'a LimitPoint,
    quantity: LimitQuantity,
}

impl Row for ConvergenceRow<'_> {
    const FILE: &'static str = "convergence.csv";
    const ROWS: &'static str = "One row for each quantity, law, number of asperities and separation: errors of the sum relative to the integral.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            law["text"] = row.point.law.as_str(), "Contact law of an asperity.";
            quantity["text"] = row.quantity.name(), "Quantity whose error is given: `area` or `load`.";
            separation_over_sigma["1", label("d/σ"), input] = row.point.separation_over_sigma(), "Separation over sigma, the standard deviation of the asperity heights.";
            asperities["count"] = row.point.count, "Asperities in a set.";
            expected_contacts["1"] = row.point.expected_contacts(), "Expected number of contacts.";
            random_mean_error["1", scale(1e-3)] = row.point.scatter(row.quantity).0, "Mean relative error of the random sets.";
            random_rms_error["1", scale(1e-3)] = row.point.scatter(row.quantity).1, "Root mean square of the relative errors of the random sets.";
            quantile_error["1", scale(1e-3)] = row.point.quantile_error(row.quantity), "Relative error, without sign, of the set with heights at the quantiles.";
            expected_quantile_error["1", scale(1e-3)] = row.point.expected_quantile_error(row.quantity), "Leading term of that error, of the midpoint rule in probability at the tail of the heights.";
            fitted["true/false"] = row.point.is_fitted(), "Whether more than 30 contacts are expected, so that the row takes part in the fit of the slopes.";
        }
    }
}

/// A slope fitted to the errors.
pub struct SlopeRow<'a>(&'a ErrorSlope);

impl Row for SlopeRow<'_> {
    const FILE: &'static str = "slopes.csv";
    const ROWS: &'static str = "One row for each law, separation, quantity and way to take the heights: the slope of the logarithm of the error over that of the number of asperities.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            law["text"] = row.0.law.as_str(), "Contact law of an asperity.";
            quantity["text"] = row.0.quantity.name(), "Quantity whose error is fitted: `area` or `load`.";
            heights["text"] = row.0.sampling.name(), "How the heights are taken: `random` or at the `quantiles`.";
            separation_over_sigma["1", label("d/σ"), input] = row.0.separation, "Separation over sigma.";
            slope["1"] = row.0.fit.slope, "Slope of the root mean square error of the random sets, or of the error of the set at the quantiles.";
            standard_error["1", label("± s.e."), scale(1.0)] = row.0.fit.standard_error, "Its standard error.";
            expected_slope["1"] = row.0.expected, "Slope that theory expects over the fitted numbers of asperities.";
            deviation["1", signed, scale(1.0)] = row.0.fit.slope - row.0.expected, "Slope less the expected one.";
            points["count"] = row.0.fit.points, "Numbers of asperities fitted.";
        }
    }
}

/// In `curves.csv` and `comparison.csv` a set is a surface, a random draw a realisation, and the integral the surface `population`.
pub fn tables(results: &LimitResults) -> Vec<Table> {
    let LimitResults { points, contact, slopes, .. } = results;
    let integrals = points.iter().take_while(|point| point.count == points[0].count);
    let integrals = integrals.map(|LimitPoint { law, exact, .. }| {
        (RowCase::bare("population", 1, law), ModelKind::Statistical, exact.statistical)
    });
    let sums = pairs(results).map(|row| (row.case, ModelKind::Deterministic, row.pair.deterministic));
    let curves = integrals
        .chain(sums)
        .map(|(case, kind, response)| CurveRow::at_separation(case, kind, response, contact.reduced_modulus));
    let errors =
        LimitQuantity::ALL.map(|quantity| points.iter().map(move |point| ConvergenceRow { point, quantity }));
    let tables = [
        curves_of_models(curves),
        comparison_of_models(pairs(results)),
        Table::new(errors.into_iter().flatten()),
        Table::new(slopes.iter().map(SlopeRow)),
    ];
    tables.into_iter().filter(|table| table.rows() > 0).collect()
}

fn pairs(results: &LimitResults) -> impl Iterator<Item = PairRow> {
    results.points.iter().flat_map(move |point| {
        let area = point.count as f64 / results.sets.population.density;
        point.pairs().map(move |(sampling, draw, pair)| {
            let case = RowCase::bare(&format!("{}-{}", sampling.name(), point.count), draw, &point.law);
            PairRow::of_models(case, pair, area, results.plasticity_index)
        })
    })
}
