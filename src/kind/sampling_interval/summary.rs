//! `summary.json` of a study of sampling intervals.

use asperity::compare::{Cause, ComparedQuantity};
use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use serde::Serialize;
use serde_json::{Map, Value};

use super::findings::{Findings, Lead, Sign, main_load};
use super::results::{IntervalResults, Series, SurfaceResults};
use super::trend::Trend;

#[derive(Serialize)]
struct IntervalSummary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    law: &'a str,
    sampling_interval: Vec<SeriesSummary<'a>>,
}

/// One surface varied in one way.
#[derive(Serialize)]
struct SeriesSummary<'a> {
    surface: &'a str,
    variation: &'static str,
    lengths_m: Vec<f64>,
    /// Whether a failed check keeps the map from carrying a conclusion.
    blocked: bool,
    /// The load of the findings.
    pressure_pa: Option<f64>,
    limits: Vec<LimitSummary>,
    gap_sign: Option<&'static str>,
    leading_cause_of_separation: Option<LeadSummary>,
    leading_cause_of_area: Option<LeadSummary>,
}

#[derive(Serialize)]
struct LimitSummary {
    quantity: &'static str,
    change: f64,
    half_width: Option<f64>,
    previous_change: f64,
    exponent: Option<f64>,
    outcome: &'static str,
}

impl From<&Trend> for LimitSummary {
    fn from(trend: &Trend) -> Self {
        Self {
            quantity: trend.quantity.name(),
            change: trend.change,
            half_width: trend.half_width,
            previous_change: trend.previous,
            exponent: trend.exponent.map(|fit| fit.slope),
            outcome: trend.outcome.name(),
        }
    }
}

/// Where it can be told.
#[derive(Serialize)]
struct LeadSummary {
    /// From the finest length.
    causes: Vec<&'static str>,
    lengths_told: usize,
    lengths: usize,
}

impl From<&Lead> for LeadSummary {
    fn from(lead: &Lead) -> Self {
        let (causes, lengths_told, lengths) = match lead {
            Lead::One { cause, told, of } => (vec![cause.name()], *told, *of),
            Lead::Several { causes, told, of } => {
                (causes.iter().map(|(cause, _): &(Cause, _)| cause.name()).collect(), *told, *of)
            }
            Lead::Open { of } => (Vec::new(), 0, *of),
        };
        Self { causes, lengths_told, lengths }
    }
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &IntervalResults) -> serde_json::Result<Map<String, Value>> {
    let series = results
        .surfaces
        .iter()
        .flat_map(|surface| surface.series.iter().map(move |series| of_series(surface, series)));
    fields(&IntervalSummary {
        contact: ContactSummary::of(&results.contact),
        law: &results.law,
        sampling_interval: series.collect(),
    })
}

fn of_series<'a>(surface: &'a SurfaceResults, series: &Series) -> SeriesSummary<'a> {
    let load = main_load(surface);
    let findings = Findings::of(series, load);
    let lead = |quantity: ComparedQuantity| findings.leads[quantity as usize].as_ref().map(LeadSummary::from);
    SeriesSummary {
        surface: &surface.surface.name,
        variation: series.variation.name(),
        lengths_m: series.scales.iter().map(|scale| scale.length).collect(),
        blocked: surface.surface.is_blocked(),
        pressure_pa: load.map(|load| surface.loads[load]),
        limits: findings.trends.iter().map(LimitSummary::from).collect(),
        gap_sign: findings.sign.map(|sign| match sign {
            Sign::Kept(_) => "kept",
            Sign::Changed { .. } => "changes",
            Sign::Open { .. } => "cannot-tell",
        }),
        leading_cause_of_separation: lead(ComparedQuantity::Separation),
        leading_cause_of_area: lead(ComparedQuantity::Area),
    }
}
