//! Limits of validity of a comparison.

use asperity::Limit;
use asperity::compare::{Kind, PointCounts};
use asperity_framework::report::page::Page;

use super::names::subject;
use super::verdict::limit_words;
use crate::kind::compare::results::CompareResults;

/// Limits of validity, with the number of points affected.
pub fn limits(page: &mut Page, results: &CompareResults) {
    page.heading(2, "Limits of validity");
    let mut lines = Vec::new();
    for found in &results.surfaces {
        for findings in &found.findings.laws {
            lines.extend(limits_of(&subject(results, found, &findings.law), &findings.counts));
        }
    }
    lines.extend(tolerance(results));
    lines.extend(assumptions(results));
    page.bullets(lines);
}

/// Error of interpolated curves.
fn tolerance(results: &CompareResults) -> Option<String> {
    let of = |kind: Kind| {
        let tolerance = results.tolerances.of(kind)?;
        Some(format!("to {tolerance:e} for the {} model", kind.name()))
    };
    let held: Vec<String> = [Kind::Statistical, Kind::Deterministic].into_iter().filter_map(of).collect();
    (!held.is_empty()).then(|| {
        format!(
            "Load and area of the curves over d/σ agree with direct evaluation {}: points are interpolated only between two \
             exact ones that differ by no more than this. No bound holds for shares of the regimes, number of contacts, \
             stiffness and sampling errors of interpolated points.",
            held.join(", ")
        )
    })
}

/// Assumptions of all results.
pub fn assumptions(results: &CompareResults) -> [String; 2] {
    let flat = if results.contact.layer.is_some() {
        ", its layer perfectly bonded and free of cracks and residual stress"
    } else {
        " and homogeneous"
    };
    let is_elliptic = results.surfaces.iter().any(|found| found.surface.ellipticity.is_some());
    let asperities = if is_elliptic { "spheres, or ellipses under elliptic laws," } else { "spheres" };
    [
        format!(
            "The flat is smooth{flat}; asperities are {asperities} and do not interact; adhesion, friction and hardening \
             are neglected.",
        ),
        "The standard errors of the tables and the bands of the curves assume independent asperities. Those of a real surface \
         are correlated: long waves increase the scatter, short ones can reduce it. The intervals of the verdicts account for \
         it on maps and over realisations."
            .to_owned(),
    ]
}

/// The points of one surface at which a model is not valid, or does not reach the requested load.
pub fn limits_of(subject: &str, counts: &PointCounts) -> Vec<String> {
    let &PointCounts { points, load_points, in_jump, unpaired, .. } = counts;
    let mut lines = Vec::new();
    for limit in Limit::ALL.into_iter().filter(|limit| counts.beyond(*limit) > 0) {
        lines.push(format!(
            "{subject}: {} of {points} points are beyond the valid range ({}){}; `{}` in the column `limits` of the tables.",
            counts.beyond(limit),
            limit_words(limit),
            consequence(limit),
            limit.name(),
        ));
    }
    if in_jump > 0 {
        lines.push(format!(
            "{subject}: at {in_jump} of {load_points} points the requested load lies within a jump of the law; the result \
             is the largest separation that carries at least this load, and `pressure_pa` exceeds `target`."
        ));
    }
    if unpaired > 0 {
        lines.push(format!(
            "{subject}: {unpaired} deterministic pressures have no counterpart at equal load: one of the models does not \
             reach them at separations above −10 σ."
        ));
    }
    lines
}

/// Why results beyond a limit do not hold.
fn consequence(limit: Limit) -> &'static str {
    match limit {
        Limit::FewContacts | Limit::DominantContact => ": they depend on a few peaks",
        Limit::Interaction => ", where neighbouring asperities interact and no asperity model is valid",
        Limit::LargeStrain => ": the laws assume small strains",
    }
}
