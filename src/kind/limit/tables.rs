//! `curves.csv`, `comparison.csv` and `convergence.csv` of a limit.

use asperity::Response;
use asperity::compare::{Control, CurvePoint, Kind, LimitPoint, Pair, Pairing, Quantity};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

use super::run::LimitResults;
use crate::kind::compare::tables::{AnyPoint, Case, CurveRow, PairRow, comparison_of_models};

/// The errors of sets of one size at one separation.
struct ConvergenceRow<'a> {
    point: &'a LimitPoint,
    quantity: Quantity,
}

impl Row for ConvergenceRow<'_> {
    const FILE: &'static str = "convergence.csv";
    const ROWS: &'static str = "One row for each quantity, law, number of asperities and separation: errors of the sum relative to the integral.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            law["text"] = row.point.law.as_str(), "Contact law of an asperity.";
            quantity["text"] = row.quantity.name(), "Quantity whose error is given: `area` or `load`.";
            separation_over_sigma["1"] = row.point.exact.statistical.separation_over_sigma, "Separation over sigma, the standard deviation of the asperity heights.";
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

/// Each set with its surface and realisation in the tables, and its result.
fn sets(point: &LimitPoint) -> impl Iterator<Item = (Case, &Response)> {
    let random = (1..)
        .zip(&point.random)
        .map(|(k, response)| (Case::bare(&format!("random-{}", point.count), k, &point.law), response));
    let quantiles = Case::bare(&format!("quantiles-{}", point.count), 1, &point.law);
    random.chain([(quantiles, &point.quantiles)])
}

/// The files of [`schemas`].
pub(super) fn tables(results: &LimitResults) -> Vec<Table> {
    vec![
        Table::new(curves(results)),
        comparison_of_models(comparison(results)),
        Table::new(convergence(results)),
    ]
}

/// Those of a comparison and `convergence.csv`.
pub(super) fn schemas() -> Vec<Schema> {
    vec![Schema::of::<CurveRow>(), Schema::of::<PairRow>(), Schema::of::<ConvergenceRow>()]
}

/// A set is a surface, a random draw a realisation, and the integral the surface `population`.
fn curves(results: &LimitResults) -> impl Iterator<Item = CurveRow> {
    let reduced_modulus = results.contact.reduced_modulus;
    let row = move |case, kind, response: &Response| {
        let (control, target) = (Control::Separation, response.separation_over_sigma);
        let point = CurvePoint {
            kind,
            control,
            target,
            prescribed_pressure: None,
            response: *response,
            in_jump: false,
        };
        CurveRow { case, point: AnyPoint::Model(point, response.exceeded()), reduced_modulus }
    };
    let smallest = results.points.iter().map(|point| point.count).min();
    let of_smallest = results.points.iter().filter(move |point| Some(point.count) == smallest);
    let integral = of_smallest.map(move |point| {
        row(Case::bare("population", 1, &point.law), Kind::Statistical, &point.exact.statistical)
    });
    let sums = results.points.iter().flat_map(sets);
    integral.chain(sums.map(move |(case, response)| row(case, Kind::Deterministic, response)))
}

/// Every set against the integral, at equal separation.
fn comparison(results: &LimitResults) -> impl Iterator<Item = PairRow> {
    let row = |point: &LimitPoint, case, deterministic: &Response| {
        let statistical = point.exact.statistical;
        let (target, deterministic) = (statistical.separation_over_sigma, *deterministic);
        PairRow {
            case,
            pair: Pair { pairing: Pairing::Separation, target, statistical, deterministic },
            nominal_area: point.count as f64 / results.population.density,
            plasticity_index: results.plasticity_index,
            attribution: None,
            reference: None,
        }
    };
    results
        .points
        .iter()
        .flat_map(move |point| sets(point).map(move |(case, response)| row(point, case, response)))
}

fn convergence(results: &LimitResults) -> impl Iterator<Item = ConvergenceRow<'_>> {
    let rows = |quantity| results.points.iter().map(move |point| ConvergenceRow { point, quantity });
    Quantity::ALL.into_iter().flat_map(rows)
}
