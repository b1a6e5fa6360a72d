//! `summary.json` of a map of causes.

use asperity_framework::contact::ContactSummary;
use asperity_framework::fields;
use serde::Serialize;
use serde_json::{Map, Value};

use asperity::compare::Cause;

use super::findings::Findings;
use super::results::{CausesResults, QUANTITIES};

#[derive(Serialize)]
struct CausesSummary<'a> {
    #[serde(flatten)]
    contact: ContactSummary,
    law: &'a str,
    surfaces: usize,
    causes: Vec<FindingsSummary>,
}

/// One quantity at one load.
#[derive(Serialize)]
struct FindingsSummary {
    quantity: &'static str,
    pressure_pa: f64,
    points_divided: usize,
    leads: Vec<LeadSummary>,
    share_of_radii: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct LeadSummary {
    cause: &'static str,
    points: usize,
    skewness_at_every_bandwidth: Vec<f64>,
}

/// Its part of `summary.json`.
pub(super) fn summary(results: &CausesResults) -> serde_json::Result<Map<String, Value>> {
    let of = |load: usize| {
        QUANTITIES.map(|quantity| {
            let found = Findings::of(results, quantity, load);
            FindingsSummary {
                quantity: quantity.name(),
                pressure_pa: results.loads[load],
                points_divided: found.divided,
                leads: found
                    .leads
                    .into_iter()
                    .map(|lead| LeadSummary {
                        cause: lead.cause.map_or("none", Cause::name),
                        points: lead.points,
                        skewness_at_every_bandwidth: lead.at_every_bandwidth,
                    })
                    .collect(),
                share_of_radii: found.share_of_radii,
            }
        })
    };
    fields(&CausesSummary {
        contact: ContactSummary::of(&results.contact),
        law: &results.law,
        surfaces: results.points.len() * results.realisations,
        causes: (0..results.loads.len()).flat_map(of).collect(),
    })
}
