//! `fit = "auto"` in words: the steps by which a preparation was found, and the keys of a spec that do the same by hand.

use asperity::surface::{Fit, FitStep, NotApplied, Preparation, Surface};
use asperity::topography::Filter;
use asperity::topography::fitness::Finding;
use asperity_contact_framework::input::quantity::{Length, Quantity};
use asperity_contact_framework::report::format::{count, input_quantity, listed, number, percent};
use asperity_contact_framework::report::table::Table;
use asperity_contact_framework::rows;
use serde_json::Value;

use super::{fit, fitness};

/// The preparation as a spec has it: nesting indices rounded as they are written.
pub fn as_written(preparation: &Preparation) -> Preparation {
    let rounded = |index: f64| parsed(&length(index)).unwrap_or(index);
    let filter = preparation
        .filter
        .and_then(|filter| Filter::new(filter.s().map(rounded), filter.l().map(rounded)).ok());
    Preparation { filter: filter.or(preparation.filter), ..*preparation }
}

/// A length (m) as a spec has it, with all of its digits.
fn length(length: f64) -> String {
    let short = input_quantity(length, "m");
    let is_exact = parsed(&short).is_some_and(|value| (value / length - 1.0).abs() < 1e-12);
    if is_exact { short } else { format!("{length:e} m") }
}

fn parsed(text: &str) -> Option<f64> {
    Quantity::<Length>::parse(text).ok().map(|quantity| quantity.value())
}

/// The keys of the preparation found, as lines of `[surface.NAME.file]`.
pub fn keys(fit: &Fit) -> Vec<String> {
    let Preparation { removes_spikes, aligned, level, filter, .. } = fit.preparation;
    let outliers = if removes_spikes { "remove" } else { "keep" };
    let mut lines = vec![format!("outliers = \"{outliers}\"")];
    lines.extend(aligned.map(|lines| format!("align-lines = \"{}\"", lines.name())));
    lines.push(format!("level = \"{}\"", level.name()));
    lines.extend(filter.map(|filter| {
        let index =
            |key: &str, index: Option<f64>| index.map(|index| format!("{key} = \"{}\"", length(index)));
        let indices: Vec<String> =
            [index("s", filter.s()), index("l", filter.l())].into_iter().flatten().collect();
        format!("filter = {{ {} }}", indices.join(", "))
    }));
    lines
}

/// A spec whose last table is that of the file, with one key per line, as it is without `fit`: with the keys found.
pub fn by_hand(spec: &str, fit: &Fit) -> String {
    const FOUND: [&str; 5] = ["fit", "outliers", "align-lines", "level", "filter"];
    let is_found = |line: &&str| {
        let key = line.split_once(" = ").map_or("", |(key, _)| key);
        FOUND.contains(&key)
    };
    let kept = spec.lines().filter(|line| !is_found(line)).map(str::to_owned);
    kept.chain(keys(fit)).map(|line| line + "\n").collect()
}

/// What a reader of the results should know of a preparation that was found.
pub fn caveat(fit: &Fit) -> String {
    let applied: Vec<String> = fit
        .steps
        .iter()
        .filter(|step| step.not_applied.is_none())
        .filter_map(|step| Some(format!("`{}`", fitness::written(step.remedy?))))
        .collect();
    match (applied.is_empty(), fit.is_fit) {
        (true, true) => "`fit` found nothing to remedy.".to_owned(),
        (true, false) => "`fit` found no remedy that helps.".to_owned(),
        (false, true) => format!(
            "its preparation was found by `fit`: {}; look at the map before and after.",
            listed(&applied)
        ),
        (false, false) => format!(
            "`fit` applied {}, and the map still fails {}: no verdict may rest on it.",
            listed(&applied),
            still_failed(fit)
        ),
    }
}

/// The checks for which `fit` found no remedy.
fn still_failed(fit: &Fit) -> String {
    let mut names: Vec<String> = Vec::new();
    for step in fit.steps.iter().filter(|step| step.not_applied.is_some()) {
        let name = step.before.check.name();
        if !names.iter().any(|other| other == name) {
            names.push(name.to_owned());
        }
    }
    let checks = if names.len() == 1 { "the check" } else { "the checks" };
    format!("{checks} {}", listed(&names))
}

/// Why a remedy was not applied.
pub fn reason(step: &FitStep) -> Option<String> {
    Some(match step.not_applied.as_ref()? {
        NotApplied::Units => "units and pixel are for you to state".to_owned(),
        NotApplied::NoRemedy => "no preparation remedies it further".to_owned(),
        NotApplied::Kept => "the spec states this key".to_owned(),
        NotApplied::ManyPoints(share) => {
            format!("{} of the points would be removed: more than single wrong points", percent(*share))
        }
        NotApplied::Variance(ratio) if *ratio < 1.0 => {
            format!(
                "it would take out {} of the variance of heights: a feature of the surface, not a fault",
                percent(1.0 - ratio)
            )
        }
        NotApplied::Variance(ratio) => {
            format!("it would add {} to the variance of heights", percent(ratio - 1.0))
        }
        NotApplied::FewSummits(summits) => format!("{} summits would be left", count(*summits)),
        NotApplied::NotBetter => "the check does not come out better".to_owned(),
        NotApplied::StillFails => {
            let other = step.check_after.filter(|worst| worst.measure != step.before.measure);
            let other = other.map_or_else(String::new, |worst| {
                let measured = fitness::measured(worst.measure);
                format!(" ({measured}: {}, allowed {})", number(worst.value), fitness::allowed(&worst))
            });
            format!("the check still fails{other}, with weaker filters too")
        }
        NotApplied::Impossible(why) => format!("the map {why}"),
    })
}

/// A failed check, and what was done about it.
pub struct FitStepRow<'a> {
    surface: &'a Surface,
    /// From 1.
    number: usize,
    step: &'a FitStep,
}

/// Columns of the steps for people.
pub const STEP: [&str; 8] =
    ["check", "measured", "remedy", "value_before", "value_after", "allowed", "result", "reason"];

impl<'a> FitStepRow<'a> {
    /// None of a surface whose preparation is prescribed.
    pub fn all(surface: &'a Surface) -> impl Iterator<Item = Self> {
        let steps = surface.fit.iter().flat_map(|fit| &fit.steps);
        steps.zip(1..).map(move |(step, number)| Self { surface, number, step })
    }

    fn result(&self) -> &'static str {
        match (&self.step.not_applied, self.step.remedy) {
            (None, _) => "applied",
            (Some(_), Some(_)) => "refused",
            (Some(_), None) => "left",
        }
    }
}

rows! { FitStepRow<'_> => "fit_steps.csv";
    "One row for each surface with `fit` and remedy of a failed check, in the order in which they were tried.";
    row =>
    surface["text"] = row.surface.name.as_str(), "Name of the surface.";
    step["count"] = row.number, "Number of the step, from 1.";
    check["text"] = row.step.before.check.name(), "The check that failed.";
    measure["text"] = row.step.before.measure.name(), "What it measured.";
    measured["text"] = fitness::measured(row.step.before.measure), "The same in words.";
    remedy["text"] = row.step.remedy.map(fitness::written), "The remedy as a spec has it; empty where no preparation helps.";
    value_before["1", label("before")] = row.step.before.value, "Value of this measure without the remedy.";
    value_after["1", label("after")] = row.step.after.map(|finding| finding.value), "Value of the same measure with it; empty where it was not tried, and of form where `cubic` leaves none of a higher degree to look for.";
    allowed["text"] = fitness::allowed(&row.step.before), "The values of this measure that pass.";
    passed_after["true/false"] = row.step.check_after.as_ref().map(Finding::has_passed), "Whether the map passes the check, all of its measures, with the remedy.";
    sq_after_over_before["1"] = row.step.sq_ratio, "Sq with the remedy over Sq without it.";
    result["text"] = row.result(), "The result: `applied`, `refused`, or `left` where no preparation helps.";
    reason["text"] = fit::reason(row.step), "Why the remedy was not applied.";
}

/// The steps of a surface as in `summary.json`.
pub fn fit_records(surface: &Surface) -> Value {
    Table::new(FitStepRow::all(surface)).records()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_read_as_it_is_written() {
        for (value, text) in [(2.5e-6, "2.5 µm"), (2.123456789e-6, "2.123456789e-6 m")] {
            assert_eq!(length(value), text);
            assert!((parsed(text).unwrap() / value - 1.0).abs() < 1e-15, "{text}");
        }
    }
}
