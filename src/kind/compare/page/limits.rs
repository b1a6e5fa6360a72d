//! Where the answers of a comparison do not hold.

use asperity::compare::{Kind, PointCounts};
use asperity_framework::report::page::Page;

use super::names::subject;
use crate::kind::compare::results::CompareResults;

/// Where the answers should not be trusted, with numbers.
pub fn limits(page: &mut Page, results: &CompareResults) {
    page.heading(2, "Where not to trust this");
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

/// How far curves are off that were not asked everywhere.
fn tolerance(results: &CompareResults) -> Option<String> {
    let of = |kind: Kind| {
        let tolerance = results.tolerances.of(kind)?;
        Some(format!("of the {} model within {tolerance:e} of its own answer", kind.name()))
    };
    let held: Vec<String> = [Kind::Statistical, Kind::Deterministic].into_iter().filter_map(of).collect();
    (!held.is_empty()).then(|| {
        format!(
            "Over d/σ the models were asked at some of the points, the rest is interpolated and checked: load and area are \
             {}; shares of the regimes, stiffness and sampling errors are interpolated alike.",
            held.join(", ")
        )
    })
}

/// What all answers take for granted.
pub fn assumptions(results: &CompareResults) -> [String; 2] {
    let flat = if results.contact.layer.is_some() {
        ", its layer bonded everywhere and free of cracks and residual stress"
    } else {
        " and homogeneous"
    };
    let sees_ellipses = results.surfaces.iter().any(|found| found.surface.ellipticity.is_some());
    let asperities = if sees_ellipses { "spheres, or ellipses under elliptic laws," } else { "spheres" };
    [
        format!(
            "The flat is smooth{flat}; asperities are {asperities} that do not touch each other; there is no adhesion, friction or \
             hardening.",
        ),
        "Standard errors take the asperities as independent draws; those of a real surface are neighbours, and a surface with long \
         waves scatters more."
            .to_owned(),
    ]
}

/// The points of one surface at which a model does not hold, or does not answer what was asked.
pub fn limits_of(subject: &str, counts: &PointCounts) -> Vec<String> {
    let &PointCounts { points, beyond_model, sum_points, few_contacts, load_points, in_jump, unpaired } =
        counts;
    let mut lines = Vec::new();
    if beyond_model > 0 {
        lines.push(format!(
            "{subject}: {beyond_model} of {points} points lie beyond A/A_nom = 0.05, where neighbouring asperities interact and \
             no asperity model holds. They are marked `beyond_model` in the tables."
        ));
    }
    if few_contacts > 0 {
        lines.push(format!(
            "{subject}: at {few_contacts} of {sum_points} points fewer than 30 asperities carry the sum; they tell of the highest few."
        ));
    }
    if in_jump > 0 {
        lines.push(format!(
            "{subject}: at {in_jump} of {load_points} points the load asked for lies in a jump of the law; the answer is the largest \
             separation that carries at least as much, and `pressure_pa` exceeds `target`."
        ));
    }
    if unpaired > 0 {
        lines.push(format!(
            "{subject}: {unpaired} deterministic pressures have no pair at equal load: one of the models does not reach \
             them above −10 σ."
        ));
    }
    lines
}
