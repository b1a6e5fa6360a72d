//! Which statistical model is enough, in `summary.json`.

use asperity::compare::ComparedQuantity;
use serde::Serialize;

use super::Against;
use crate::kind::compare::layer_summary::Thickness;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// How the statistical models of one surface stand in one quantity, on the first realisation.
#[derive(Serialize)]
pub struct RankingSummary<'a> {
    surface: &'a str,
    law: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer_thickness_m: Option<Thickness>,
    nayak_alpha: Option<f64>,
    quantity: &'static str,
    against: &'static str,
    accepted: f64,
    /// The models within what is accepted, the simplest first.
    within: Vec<String>,
    cheapest_within: Option<String>,
    nearest: Option<String>,
    /// Its largest difference: of the separation in sigma, else relative.
    nearest_difference: Option<f64>,
}

/// Surface by surface.
pub fn ranking(results: &CompareResults) -> Vec<RankingSummary<'_>> {
    results.surfaces.iter().flat_map(of_surface).collect()
}

fn of_surface(found: &SurfaceResults) -> Vec<RankingSummary<'_>> {
    let alpha = found.surface.map.as_ref().and_then(|map| map.roughness.alpha());
    let mut all = Vec::new();
    let cases = found.first.cases.iter().zip(&found.findings.cases).zip(&found.rankings);
    for ((case, findings), ranking) in cases.filter(|(_, ranking)| !ranking.models.is_empty()) {
        let accepted = &findings.verdicts.accepted;
        for &against in ranking.against() {
            for quantity in ComparedQuantity::ALL {
                let standing = ranking.standing(against, quantity, accepted);
                let nearest = standing.nearest();
                all.push(RankingSummary {
                    surface: &found.surface.name,
                    law: &case.law,
                    layer_thickness_m: case.thickness.map(Thickness),
                    nayak_alpha: alpha,
                    quantity: quantity.name(),
                    against: match against {
                        Against::Sum => "deterministic",
                        Against::Reference => "reference",
                    },
                    accepted: accepted.of(quantity),
                    within: standing.within.iter().map(|(ranked, _)| ranked.model.name()).collect(),
                    cheapest_within: standing.cheapest().map(|(ranked, _)| ranked.model.name()),
                    nearest: nearest.map(|(ranked, _)| ranked.model.name()),
                    nearest_difference: nearest.map(|(_, contrast)| quantity.reported(contrast)),
                });
            }
        }
    }
    all
}
