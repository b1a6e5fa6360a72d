//! The findings of one surface under one law in a few sentences.

use asperity::compare::{Departure, Gap, GapQuantity, SpreadFindings};
use asperity_framework::report::format::{number, quantity};

use super::names::subject;
use crate::kind::compare::findings::Recommendation;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// What a finding rests on.
pub const CONDITION: &str = "Only loads that at least 30 asperities carry within A/A_nom = 0.05 count.";

/// How far the models lie apart, and which to use: a line each.
pub fn in_short(results: &CompareResults, found: &SurfaceResults, index: usize) -> Vec<String> {
    let (case, findings) = (&found.first.cases[index], &found.findings.cases[index]);
    let subject = subject(results, found, &case.law);
    let mut lines = match &findings.over_realisations {
        Some(over) => over_realisations(&subject, over),
        None => case.gaps.largest.iter().map(|gap| format!("**{subject}**: {}", sentence(gap))).collect(),
    };
    lines.push(match &findings.recommendation {
        Some(recommendation) => trust(&subject, recommendation),
        None => format!(
            "**{subject}**: no pair of answers rests on at least 30 contacts within 5 % real area, so nothing is said \
             about the gap between the models."
        ),
    });
    lines
}

/// Which model to use.
pub fn trust(subject: &str, recommendation: &Recommendation) -> String {
    format!("**{subject}, which to trust**: {}", advice(recommendation))
}

fn over_realisations(subject: &str, found: &SpreadFindings) -> Vec<String> {
    let SpreadFindings { realisations, separation, area, .. } = found;
    vec![
        format!(
            "**{subject}**, over {realisations} realisations: at equal load the separations differ by up to {} ± {} σ (mean ± standard deviation of one \
             realisation) at {}, {} standard errors of the mean: {} σ statistical, {} σ deterministic. {CONDITION}",
            number(separation.difference.mean.abs()),
            number(separation.difference.deviation),
            quantity(separation.target, "Pa"),
            number(found.separation_standard_errors()),
            number(separation.statistical_separation.mean),
            number(separation.deterministic_separation.mean),
        ),
        format!(
            "**{subject}**: at equal load, where the real areas are furthest apart in the mean, the statistical one is {} times the \
             deterministic one, at {}.",
            number(area.area_ratio_of_means()),
            quantity(area.target, "Pa")
        ),
    ]
}

/// The largest gap of a quantity.
fn sentence(gap: &Gap) -> String {
    let errors = match gap.over_sampling_error {
        Some(errors) => format!(" ({} standard errors of the sum)", number(errors)),
        None => String::new(),
    };
    match gap.quantity {
        GapQuantity::Separation => format!(
            "at equal load the separations differ by up to {} σ: {} σ statistical, {} σ deterministic at {}{errors}. {CONDITION}",
            number(gap.difference().abs()),
            number(gap.statistical),
            number(gap.deterministic),
            quantity(gap.target, "Pa"),
        ),
        GapQuantity::AreaRatio => format!(
            "at equal load, where the real areas are furthest apart, the statistical one is {} times the deterministic one, at {}{errors}.",
            number(gap.ratio()),
            quantity(gap.target, "Pa"),
        ),
        GapQuantity::Pressure => format!(
            "at equal separation, where the loads are furthest apart, the statistical one is {} times the deterministic one, at d/σ = {}{errors}.",
            number(gap.ratio()),
            number(gap.target),
        ),
    }
}

fn advice(recommendation: &Recommendation) -> String {
    match recommendation {
        Recommendation::Neither => {
            "neither, before the warning above is dealt with: the numbers are not those of the surface."
                .to_owned()
        }
        Recommendation::Either => {
            "either. The models differ by less than three standard errors of the sum: another sample of the \
             same surface would move the sum as much."
                .to_owned()
        }
        Recommendation::Deterministic { departures } => {
            let causes: Vec<String> = departures.iter().map(cause).collect();
            let why = if causes.is_empty() {
                String::new()
            } else {
                format!(" The surface is not what the integral assumes: {}.", causes.join("; "))
            };
            format!("the deterministic sum. The gap exceeds its sampling error.{why}")
        }
    }
}

fn cause(departure: &Departure) -> String {
    match *departure {
        Departure::Heights { skewness, kurtosis } => format!(
            "its heights have skewness {} and kurtosis {} (0 and 3 if Gaussian)",
            number(skewness),
            number(kurtosis)
        ),
        Departure::Radii(cv) => format!("its radii scatter by {} % of their mean", number(100.0 * cv)),
        Departure::Correlation(correlation) => {
            format!("heights and radii correlate ({})", number(correlation))
        }
    }
}
