//! Summary of one surface under one law.

use asperity::compare::{Departure, Gap, GapQuantity, SpreadFindings};
use asperity_framework::report::format::{
    input_number, input_quantity, listed, mean_and_deviation, number, percent,
};

use super::names::subject;
use crate::kind::compare::findings::Recommendation;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// Range of validity of a finding.
pub const CONDITION: &str = "Valid at loads with at least 30 contacts and a contact area of at most 5 %.";

/// The same with the stretches of loads (Pa) that are valid.
fn validity(loads: &[[f64; 2]]) -> String {
    if loads.is_empty() {
        return CONDITION.to_owned();
    }
    let range = |&[from, to]: &[f64; 2]| {
        let [first, last] = [from, to].map(|load| input_quantity(load, "Pa"));
        if from == to { first } else { format!("{first} to {last}") }
    };
    let ranges = listed(&loads.iter().map(range).collect::<Vec<_>>());
    format!("Valid for {ranges} (at least 30 contacts, contact area at most 5 %).")
}

/// Difference between the models, and which to use: one line each.
pub fn summary_lines(results: &CompareResults, found: &SurfaceResults, index: usize) -> Vec<String> {
    let (case, findings) = (&found.first.cases[index], &found.findings.cases[index]);
    let subject = subject(results, found, &case.law);
    let valid = validity(&findings.valid_loads);
    let mut lines = match &findings.over_realisations {
        Some(over) => over_realisations(&subject, over, &valid),
        None => {
            let line = |gap: &Gap| format!("**{subject}**: {}", sentence(gap, &valid));
            case.gaps.largest.iter().map(line).collect()
        }
    };
    lines.push(match &findings.recommendation {
        Some(recommendation) => trust(&subject, recommendation),
        None => format!(
            "**{subject}**: no result has at least 30 contacts and a contact area of at most 5 %, so no conclusion on the \
             difference between the models is drawn."
        ),
    });
    lines
}

/// Which model to use.
pub fn trust(subject: &str, recommendation: &Recommendation) -> String {
    format!("**{subject}, recommendation**: {}", advice(recommendation))
}

fn over_realisations(subject: &str, found: &SpreadFindings, validity: &str) -> Vec<String> {
    let SpreadFindings { realisations, separation, area, .. } = found;
    vec![
        format!(
            "**{subject}**, over {realisations} realisations: at equal load the separations differ by up to {} σ (mean ± standard deviation of one \
             realisation) at {}, {} standard errors of the mean: {} σ statistical, {} σ deterministic. {validity}",
            mean_and_deviation(separation.difference.mean.abs(), separation.difference.deviation),
            input_quantity(separation.target, "Pa"),
            number(found.separation_standard_errors()),
            number(separation.statistical_separation.mean),
            number(separation.deterministic_separation.mean),
        ),
        format!(
            "**{subject}**: at equal load {} at {}, where the mean areas differ most.",
            deviation("real contact area", area.area_ratio_of_means()),
            input_quantity(area.target, "Pa")
        ),
    ]
}

/// The largest difference in a quantity.
fn sentence(gap: &Gap, validity: &str) -> String {
    let errors = match gap.over_sampling_error {
        Some(errors) => format!(" ({} standard errors of the sum)", number(errors)),
        None => String::new(),
    };
    match gap.quantity {
        GapQuantity::Separation => format!(
            "at equal load the separations differ by up to {} σ: {} σ statistical, {} σ deterministic at {}{errors}. {validity}",
            number(gap.difference().abs()),
            number(gap.statistical),
            number(gap.deterministic),
            input_quantity(gap.target, "Pa"),
        ),
        GapQuantity::AreaRatio => format!(
            "at equal load {} at {}{errors}, where the areas differ most.",
            deviation("real contact area", gap.ratio()),
            input_quantity(gap.target, "Pa"),
        ),
        GapQuantity::Pressure => format!(
            "at equal separation {} at d/σ = {}{errors}, where the loads differ most.",
            deviation("load", gap.ratio()),
            input_number(gap.target),
        ),
    }
}

/// "the statistical model underestimates the load 170-fold", from statistical over deterministic.
fn deviation(of: &str, ratio: f64) -> String {
    if (0.5..=2.0).contains(&ratio) {
        let direction = if ratio < 1.0 { "lower" } else { "higher" };
        let size = percent((ratio - 1.0).abs());
        return format!("the statistical model gives a {of} {size} {direction} than the deterministic model");
    }
    let (verb, fold) = if ratio < 1.0 { ("underestimates", ratio.recip()) } else { ("overestimates", ratio) };
    format!("the statistical model {verb} the {of} {}-fold", number(fold))
}

fn advice(recommendation: &Recommendation) -> String {
    match recommendation {
        Recommendation::Neither => {
            "neither model, until the warning above is resolved: the input data do not represent the surface."
                .to_owned()
        }
        Recommendation::Either => {
            "either model. The difference is within sampling uncertainty (three standard errors of the sum)."
                .to_owned()
        }
        Recommendation::Deterministic { departures } => {
            let causes: Vec<String> = departures.iter().map(cause).collect();
            let why = if causes.is_empty() {
                String::new()
            } else {
                format!(
                    " The surface departs from the assumptions of the statistical model: {}.",
                    causes.join("; ")
                )
            };
            format!("the deterministic model. The models differ beyond sampling uncertainty.{why}")
        }
    }
}

fn cause(departure: &Departure) -> String {
    match *departure {
        Departure::Heights { skewness, kurtosis } => format!(
            "heights have skewness {} and kurtosis {} (Gaussian: 0 and 3)",
            number(skewness),
            number(kurtosis)
        ),
        Departure::Radii(cv) => format!("radii scatter by {} % of their mean", number(100.0 * cv)),
        Departure::Correlation(correlation) => {
            format!("heights and radii are correlated ({})", number(correlation))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_between_valid_stretches_are_not_called_valid() {
        let found = validity(&[[1e6, 3e6], [5e6, 5e6]]);
        assert!(found.starts_with("Valid for 1 MPa to 3 MPa and 5 MPa ("), "{found}");
        assert_eq!(validity(&[]), CONDITION);
    }
}
