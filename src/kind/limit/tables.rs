//! `curves.csv`, `comparison.csv` and `convergence.csv` of a limit.

use asperity::compare::{Control, CurvePoint, Kind, LimitPoint, Pair, Pairing, Quantity};
use asperity::model::Response;
use asperity_framework::report::table::{Table, TableError};
use asperity_framework::row;

use super::run::LimitResults;
use crate::kind::compare::tables::{CASE, Case, CurveRow, PairRow};

row! {
struct ConvergenceRow {
    law: String,
    quantity: &'static str,
    separation_over_sigma: f64,
    asperities: usize,
    expected_contacts: f64,
    random_mean_error: f64,
    random_rms_error: f64,
    quantile_error: f64,
    fitted: bool,
}
}

/// Each set of a limit as the surface and realisation that tables call it by, and its answer.
fn sets(point: &LimitPoint) -> impl Iterator<Item = (Case, &Response)> {
    let random = (1..)
        .zip(&point.random)
        .map(|(k, response)| (Case::bare(&format!("random-{}", point.count), k, &point.law), response));
    let quantiles = Case::bare(&format!("quantiles-{}", point.count), 1, &point.law);
    random.chain([(quantiles, &point.quantiles)])
}

/// `curves.csv` of a limit: a set is a surface, a random draw a realisation, and the integral the
/// surface `population`.
///
/// # Errors
/// See [`curves`].
pub fn curves(results: &LimitResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[CASE, CurveRow::COLUMNS])?;
    let mut row = |of: Case, kind, response: &Response| {
        let target = response.separation_over_sigma;
        let point = CurvePoint {
            kind,
            control: Control::Separation,
            target,
            asked: None,
            response: *response,
            in_jump: false,
        };
        table.row((of, CurveRow::new(&point, results.contact.reduced_modulus)))
    };
    let smallest = results.points.iter().map(|point| point.count).min();
    for point in results.points.iter().filter(|point| Some(point.count) == smallest) {
        row(Case::bare("population", 1, &point.law), Kind::Statistical, &point.exact.statistical)?;
    }
    for point in &results.points {
        for (of, response) in sets(point) {
            row(of, Kind::Deterministic, response)?;
        }
    }
    table.bytes()
}

/// `comparison.csv` of a limit: every set against the integral, at equal separation.
///
/// # Errors
/// See [`curves`].
pub fn comparison(results: &LimitResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[CASE, PairRow::COLUMNS])?;
    for point in &results.points {
        let area = point.count as f64 / results.population.density;
        for (of, response) in sets(point) {
            let statistical = point.exact.statistical;
            let target = statistical.separation_over_sigma;
            let pair = Pair { pairing: Pairing::Separation, target, statistical, deterministic: *response };
            table.row((of, PairRow::new(&pair, area, results.plasticity_index)))?;
        }
    }
    table.bytes()
}

/// `convergence.csv`: relative errors by law, quantity, separation and size of the set.
///
/// # Errors
/// See [`curves`].
pub fn convergence(results: &LimitResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[ConvergenceRow::COLUMNS])?;
    for quantity in Quantity::ALL {
        for point in &results.points {
            let (random_mean_error, random_rms_error) = point.scatter(quantity);
            table.row(ConvergenceRow {
                law: point.law.clone(),
                quantity: quantity.name(),
                separation_over_sigma: point.exact.statistical.separation_over_sigma,
                asperities: point.count,
                expected_contacts: point.expected_contacts(),
                random_mean_error,
                random_rms_error,
                quantile_error: point.quantile_error(quantity),
                fitted: point.is_fitted(),
            })?;
        }
    }
    table.bytes()
}
