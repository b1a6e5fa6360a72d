//! Every time and every error, for machines.

use super::findings::Winner;
use super::names::candidate_words;
use crate::kind::precision::run::PrecisionResults;
use crate::precision::curve::CurvePoint;
use crate::precision::integral::{Effort, IntegralPoint};
use crate::precision::sampling;
use asperity::compare::{Kind, Quantity};
use asperity_framework::report::table::{Table, TableError};
use asperity_framework::row;

row! {
struct RuleRow {
    case: String,
    rule: &'static str,
    split: bool,
    substituted: bool,
    order: Option<usize>,
    tolerance: Option<f64>,
    evaluations_per_separation: Option<f64>,
    area_error: f64,
    load_error: f64,
    seconds_per_separation: f64,
}
}

row! {
struct SumRow {
    case: String,
    varied: &'static str,
    way: &'static str,
    asperities: usize,
    separations: usize,
    threads: usize,
    area_error: f64,
    load_error: f64,
    seconds_per_separation: f64,
}
}

row! {
struct CurveRow {
    case: String,
    model: &'static str,
    asperities: Option<usize>,
    tolerance: Option<f64>,
    separations: usize,
    asked: usize,
    area_error: f64,
    load_error: f64,
    seconds_per_curve: f64,
}
}

row! {
struct ListRow {
    case: String,
    asperities: usize,
    separations: usize,
    seconds_to_read: f64,
    seconds_to_sum: f64,
    peak_bytes: Option<u64>,
    added_bytes: Option<u64>,
}
}

row! {
struct SetRow {
    case: String,
    separation_over_sigma: f64,
    asperities: usize,
    expected_contacts: f64,
    area_scatter: f64,
    area_stated_error: f64,
    load_scatter: f64,
    load_stated_error: f64,
    seconds_per_set: f64,
}
}

row! {
struct MapRow {
    points_per_length: f64,
    lengths: f64,
    points: usize,
    summits: f64,
    density_bias: f64,
    radius_bias: f64,
    sigma_bias: f64,
    density_scatter: f64,
    radius_scatter: f64,
    sigma_scatter: f64,
    seconds_per_map: f64,
}
}

row! {
struct WinnerRow {
    case: String,
    of: &'static str,
    asperities: Option<usize>,
    largest_error: f64,
    fastest: Option<String>,
    error: Option<f64>,
    seconds_per_separation: Option<f64>,
    shipped_over_fastest: Option<f64>,
}
}

/// `integral.csv`, `sum.csv`, `curve.csv`, `list.csv`, `sampling.csv`, `grid.csv`, of what was asked for, and `winners.csv`.
///
/// # Errors
/// See [`TableError`].
pub fn tables(results: &PrecisionResults) -> Result<Vec<(&'static str, Vec<u8>)>, TableError> {
    let mut all = Vec::new();
    if results.cases.iter().any(|case| case.integral.is_some()) {
        all.push(("integral.csv", rules(results)?));
    }
    if results.cases.iter().any(|case| !case.sums.is_empty()) {
        all.push(("sum.csv", sums(results)?));
    }
    if !all.is_empty() {
        all.push(("winners.csv", best(results)?));
    }
    if results.cases.iter().any(|case| case.curve.is_some()) {
        all.push(("curve.csv", curves(results)?));
    }
    if results.cases.iter().any(|case| !case.lists.is_empty()) {
        all.push(("list.csv", lists(results)?));
    }
    if results.cases.iter().any(|case| case.sampling.is_some()) {
        all.push(("sampling.csv", sets(results)?));
    }
    if results.grid.is_some() {
        all.push(("grid.csv", maps(results)?));
    }
    Ok(all)
}

fn rules(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[RuleRow::COLUMNS])?;
    for case in &results.cases {
        for point in case.integral.iter().flat_map(|integral| &integral.points) {
            let IntegralPoint { rule, evaluations, area_error, load_error, cost } = *point;
            let (order, tolerance) = match rule.effort {
                Effort::Order(order) => (Some(order), None),
                Effort::Tolerance(tolerance) => (None, Some(tolerance)),
                Effort::Fixed => (None, None),
            };
            table.row(RuleRow {
                case: case.name.clone(),
                rule: rule.family.name(),
                split: rule.split,
                substituted: rule.substituted,
                order,
                tolerance,
                evaluations_per_separation: evaluations,
                area_error,
                load_error,
                seconds_per_separation: cost.seconds,
            })?;
        }
    }
    table.bytes()
}

fn sums(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[SumRow::COLUMNS])?;
    for case in &results.cases {
        for point in &case.sums {
            table.row(SumRow {
                case: case.name.clone(),
                varied: point.sweep.name(),
                way: point.way.name(),
                asperities: point.asperities,
                separations: point.separations,
                threads: point.threads,
                area_error: point.area_error,
                load_error: point.load_error,
                seconds_per_separation: point.cost.seconds,
            })?;
        }
    }
    table.bytes()
}

fn curves(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[CurveRow::COLUMNS])?;
    for case in &results.cases {
        let Some(found) = &case.curve else { continue };
        for point in &found.points {
            let CurvePoint { kind, tolerance, separations, asked, area_error, load_error, seconds } = *point;
            table.row(CurveRow {
                case: case.name.clone(),
                model: kind.name(),
                asperities: (kind == Kind::Deterministic).then_some(found.asperities),
                tolerance,
                separations,
                asked,
                area_error,
                load_error,
                seconds_per_curve: seconds,
            })?;
        }
    }
    table.bytes()
}

fn lists(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[ListRow::COLUMNS])?;
    for case in &results.cases {
        for point in &case.lists {
            table.row(ListRow {
                case: case.name.clone(),
                asperities: point.asperities,
                separations: point.separations,
                seconds_to_read: point.read_seconds,
                seconds_to_sum: point.sum_seconds,
                peak_bytes: point.peak_bytes,
                added_bytes: point.added_bytes,
            })?;
        }
    }
    table.bytes()
}

fn sets(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[SetRow::COLUMNS])?;
    for case in &results.cases {
        let Some(found) = &case.sampling else { continue };
        for point in &found.points {
            let scatter = |quantity| point.scatter(quantity).1;
            let seconds = found.seconds.iter().find(|(count, _)| *count == point.count);
            table.row(SetRow {
                case: case.name.clone(),
                separation_over_sigma: sampling::separation(point),
                asperities: point.count,
                expected_contacts: point.expected_contacts(),
                area_scatter: scatter(Quantity::Area),
                area_stated_error: sampling::stated(point, Quantity::Area),
                load_scatter: scatter(Quantity::Load),
                load_stated_error: sampling::stated(point, Quantity::Load),
                seconds_per_set: seconds.map_or(0.0, |(_, seconds)| *seconds),
            })?;
        }
    }
    table.bytes()
}

fn maps(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[MapRow::COLUMNS])?;
    for point in results.grid.iter().flat_map(|grid| &grid.points) {
        let [density_bias, radius_bias, sigma_bias] = point.bias;
        let [density_scatter, radius_scatter, sigma_scatter] = point.scatter;
        table.row(MapRow {
            points_per_length: point.per_length,
            lengths: point.lengths,
            points: point.points,
            summits: point.summits,
            density_bias,
            radius_bias,
            sigma_bias,
            density_scatter,
            radius_scatter,
            sigma_scatter,
            seconds_per_map: point.seconds,
        })?;
    }
    table.bytes()
}

fn best(results: &PrecisionResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[WinnerRow::COLUMNS])?;
    for case in &results.cases {
        for &Winner { of, asperities, level, fastest, shipped_over_fastest } in &case.findings.winners {
            table.row(WinnerRow {
                case: case.name.clone(),
                of: of.name(),
                asperities,
                largest_error: level,
                fastest: fastest.map(|(candidate, _)| candidate_words(&candidate)),
                error: fastest.map(|(_, cost)| cost.error),
                seconds_per_separation: fastest.map(|(_, cost)| cost.seconds),
                shipped_over_fastest,
            })?;
        }
    }
    table.bytes()
}
