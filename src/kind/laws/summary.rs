//! Summary of several laws.

use serde::Serialize;
use serde_json::{Map, Value};

use crate::kind::laws::plan::Critical;
use crate::kind::laws::results::{LawsResults, SurfaceInfluence};
use asperity::compare::{Effect, Group, Kind, Measure};
use asperity::sphere::Boundary;

/// Several laws on one asperity and on surfaces.
#[derive(Serialize)]
struct LawsSummary<'a> {
    critical: CriticalSummary,
    boundaries: Vec<BoundarySummary<'a>>,
    influence: Vec<InfluenceSummary<'a>>,
}

/// The unit of indentation, load and area.
#[derive(Serialize)]
struct CriticalSummary {
    radius_m: f64,
    curvature_ratio: f64,
    indentation_m: f64,
    load_n: f64,
    area_m2: f64,
}

#[derive(Serialize)]
struct BoundarySummary<'a> {
    law: &'a str,
    indentation_over_critical: f64,
    regime_below: &'static str,
    regime_above: &'static str,
    load_jump: f64,
    area_jump: f64,
}

/// Over the loads that count: differences of d/sigma, logarithms of the ratios of areas.
#[derive(Serialize)]
struct InfluenceSummary<'a> {
    surface: &'a str,
    realisation: usize,
    measure: &'static str,
    loads: usize,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    spreads: Vec<SpreadSummary>,
    sampling_error: Option<WeightSummary>,
    laws: Vec<LawSummary<'a>>,
}

#[derive(Serialize)]
struct SpreadSummary {
    laws: &'static str,
    model: &'static str,
    #[serde(flatten)]
    weight: WeightSummary,
}

#[derive(Serialize)]
struct LawSummary<'a> {
    law: &'a str,
    statistical_from_first: Option<WeightSummary>,
    deterministic_from_first: Option<WeightSummary>,
    statistical_from_deterministic: Option<WeightSummary>,
}

#[derive(Serialize)]
struct WeightSummary {
    mean_size: f64,
    largest: f64,
    at_pressure_pa: f64,
}

impl From<Effect> for WeightSummary {
    fn from(weight: Effect) -> Self {
        Self { mean_size: weight.mean, largest: weight.largest, at_pressure_pa: weight.at }
    }
}

/// Its part of `summary.json`: that of a comparison, and what the laws did to it.
pub(super) fn summary(results: &LawsResults) -> serde_json::Result<Map<String, Value>> {
    let Critical { indentation, load, area } = results.critical;
    let boundary = |law, at: &Boundary| BoundarySummary {
        law,
        indentation_over_critical: at.indentation / indentation,
        regime_below: at.below.regime.name(),
        regime_above: at.above.regime.name(),
        load_jump: at.load_jump(),
        area_jump: at.area_jump(),
    };
    let of_law = results.laws.iter().flat_map(|law| law.boundaries.iter().map(|at| boundary(&*law.law, at)));
    let of_surface = |found| Measure::ALL.map(|measure| influence(found, measure));
    let laws = LawsSummary {
        critical: CriticalSummary {
            radius_m: results.radius,
            curvature_ratio: results.curvature_ratio,
            indentation_m: indentation,
            load_n: load,
            area_m2: area,
        },
        boundaries: of_law.collect(),
        influence: results.influences.iter().flat_map(of_surface).collect(),
    };
    let mut summary = asperity_framework::Outcome::facts(&results.compare)?;
    summary.insert("laws".to_owned(), serde_json::to_value(laws)?);
    Ok(summary)
}

fn influence(found: &SurfaceInfluence, measure: Measure) -> InfluenceSummary<'_> {
    let influence = &found.influence;
    let kinds = [Kind::Statistical, Kind::Deterministic];
    let each = Group::ALL.into_iter().flat_map(|group| kinds.map(|kind| (group, kind)));
    let spread = |(group, kind): (Group, Kind)| {
        let weight = influence.of_law(measure, group, kind)?.into();
        Some(SpreadSummary { laws: group.name(), model: kind.name(), weight })
    };
    let law = |(index, law)| LawSummary {
        law,
        statistical_from_first: influence.of_choice(measure, index, kinds[0]).map(WeightSummary::from),
        deterministic_from_first: influence.of_choice(measure, index, kinds[1]).map(WeightSummary::from),
        statistical_from_deterministic: influence.of_summation(measure, index).map(WeightSummary::from),
    };
    InfluenceSummary {
        surface: &found.surface,
        realisation: found.realisation,
        measure: measure.name(),
        loads: influence.counting().count(),
        spreads: each.filter_map(spread).collect(),
        sampling_error: influence.of_sampling(measure, 0).map(WeightSummary::from),
        laws: influence.laws.iter().map(String::as_str).enumerate().map(law).collect(),
    }
}
