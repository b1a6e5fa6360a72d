//! Changes, lengths and findings in words.

use asperity::compare::Estimate;
use asperity_framework::report::format::{input_quantity, listed, number, quantity, signed, with_sign};
use asperity_framework::report::page::escape;

use super::super::findings::{Findings, Lead, Sign, main_load};
use super::super::quantity::Quantity;
use super::super::results::{IntervalResults, Series, SurfaceResults, Variation};
use super::super::trend::{Outcome, Trend};
use crate::surface::fitness;

/// An outcome in a table.
pub fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Limit => "limit",
        Outcome::Approaching => "still changing, less and less",
        Outcome::NoLimit => "no limit",
        Outcome::CannotTell => "cannot be told",
    }
}

/// The order of sentences.
const ORDER: [Outcome; 4] = [Outcome::NoLimit, Outcome::Approaching, Outcome::CannotTell, Outcome::Limit];

/// A change of a quantity with its interval: "+153 ± 1.2 %", "−0.02 ± 0.04 σ".
pub fn change(of: Quantity, change: f64, half_width: Option<f64>) -> String {
    let value = of.change_shown(change);
    match of {
        Quantity::Correlation => with_interval(value, half_width),
        Quantity::SeparationGap => format!("{} σ", with_interval(value, half_width)),
        // That of the logarithm, as a share of what is there before.
        _ => {
            let half_width = half_width.map(|half| 100.0 * (1.0 + value) * half);
            format!("{} %", with_interval(100.0 * value, half_width))
        }
    }
}

/// A gap or a part of it with its interval: "+0.12 ± 0.04".
pub fn estimate(estimate: &Estimate, scale: f64) -> String {
    with_interval(scale * estimate.contrast, estimate.half_width().map(|half| scale * half))
}

/// "+0.12 ± 0.04": the half-width with two significant digits, the value with at most three and no more decimals than that.
fn with_interval(value: f64, half_width: Option<f64>) -> String {
    let Some(half) = half_width.filter(|half| *half > 0.0) else { return with_sign(value, number) };
    let decimals = |value: f64, significant: i32| significant - 1 - value.abs().log10().floor() as i32;
    let of_half = decimals(half, 2);
    let of_value = if value == 0.0 { of_half } else { decimals(value, 3).min(of_half) };
    let half = number(format!("{half:.1e}").parse().unwrap_or(half));
    let rounded = format!("{:.*}", of_value.max(0) as usize, value.abs());
    let sign = match value {
        _ if rounded.chars().all(|digit| matches!(digit, '0' | '.')) => "",
        negative if negative < 0.0 => "−",
        _ => "+",
    };
    format!("{sign}{rounded} ± {half}")
}

/// The length that is varied.
pub fn varied(variation: Variation) -> &'static str {
    match variation {
        Variation::Interval => "sampling interval",
        Variation::Filter => "nesting index of the S filter",
    }
}

/// The statement of the page: on which surfaces the first quantities have a limit as the sampling interval shrinks.
pub fn over_surfaces(results: &IntervalResults) -> Option<String> {
    const OF: [Quantity; 3] = [Quantity::Density, Quantity::MeanRadius, Quantity::AreaOfSum];
    let of_interval = |surface: &'_ SurfaceResults| {
        let series = surface.series.iter().find(|series| series.variation == Variation::Interval)?;
        Some((escape(&surface.surface.name), Findings::of(series, main_load(surface))))
    };
    let sound = results.surfaces.iter().filter(|surface| !surface.surface.is_blocked());
    let found: Vec<(String, Findings)> = sound.filter_map(of_interval).collect();
    let clause = |of: Quantity| {
        let on = |wanted: Outcome| {
            let has = |findings: &Findings| findings.with(wanted).any(|trend| trend.quantity == of);
            let names: Vec<String> =
                found.iter().filter(|(_, findings)| has(findings)).map(|(name, _)| name.clone()).collect();
            (!names.is_empty()).then(|| format!("{} on {}", has_words(wanted), listed(&names)))
        };
        let parts: Vec<String> = ORDER.into_iter().filter_map(on).collect();
        let at = if of.is_at_load() { " (at the load given below)" } else { "" };
        (!parts.is_empty()).then(|| format!("the {}{at} {}", of.label(), listed(&parts)))
    };
    let clauses: Vec<String> = OF.into_iter().filter_map(clause).collect();
    (!clauses.is_empty()).then(|| format!("**As the sampling interval shrinks**, {}.", clauses.join("; ")))
}

fn has_words(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Limit => "has a limit",
        Outcome::Approaching => "still changes, less and less,",
        Outcome::NoLimit => "has no limit down to the finest interval",
        Outcome::CannotTell => "does not tell whether it has one",
    }
}

/// The summary of a surface: a line for each variation.
pub fn summary(surface: &SurfaceResults) -> Vec<String> {
    let name = escape(&surface.surface.name);
    if let Some(faults) = fitness::blocked_by(&surface.surface) {
        return vec![format!("**{name}**: no conclusion is drawn, because its map is not fit: {faults}.")];
    }
    let load = main_load(surface);
    surface.series.iter().map(|series| of_series(&name, surface, series, load)).collect()
}

fn of_series(name: &str, surface: &SurfaceResults, series: &Series, load: Option<usize>) -> String {
    let findings = Findings::of(series, load);
    let lengths =
        [series.scales.last(), series.scales.first()].map(|scale| scale.map_or(0.0, |at| at.length));
    let mut parts = vec![format!(
        "**{name}, {} from {} to {}**:",
        varied(series.variation),
        quantity(lengths[0], "m"),
        quantity(lengths[1], "m")
    )];
    parts.extend(ORDER.into_iter().filter_map(|outcome| trends(&findings, outcome)));
    if findings.trends.is_empty() {
        parts.push(
            "there are no asperities at the three finest lengths, so that nothing is said of limits."
                .to_owned(),
        );
    } else {
        let [finest, second] = [0, 1].map(|index| series.scales.get(index).map_or(0.0, |at| at.length));
        parts.push(format!(
            "(In brackets: changes from {} to {}.)",
            quantity(second, "m"),
            quantity(finest, "m")
        ));
    }
    match load {
        None => parts.push(
            "No load is within the valid range at any length, so that nothing is said of both models."
                .to_owned(),
        ),
        Some(load) => parts.extend(models(&findings, surface.loads[load])),
    }
    if findings.has_no_interval {
        parts.push(
            "The map is too small for intervals of all changes: what has none holds for this map alone."
                .to_owned(),
        );
    }
    parts.join(" ")
}

/// "No limit: asperity density (+153 ± 1 %, as length^−1.63), mean radius (...)."
fn trends(findings: &Findings, of: Outcome) -> Option<String> {
    let item = |trend: &Trend| {
        let power = trend.exponent.filter(|_| matches!(of, Outcome::NoLimit | Outcome::Approaching));
        let power = power.map_or_else(String::new, |fit| {
            format!(", as length^{}", with_sign(fit.slope, number).trim_start_matches('+'))
        });
        format!(
            "{} ({}{power})",
            trend.quantity.label(),
            change(trend.quantity, trend.change, trend.half_width)
        )
    };
    let items: Vec<String> = findings.with(of).map(item).collect();
    let title = match of {
        Outcome::NoLimit => "No limit",
        Outcome::Approaching => "Still changing, less and less",
        Outcome::CannotTell => "Cannot be told whether there is a limit",
        Outcome::Limit => "Limit",
    };
    (!items.is_empty()).then(|| format!("{title}: {}.", items.join(", ")))
}

/// What becomes of the gap and of its causes at a load (Pa).
fn models(findings: &Findings, load: f64) -> Vec<String> {
    let load = input_quantity(load, "Pa");
    if ![Quantity::SeparationGap, Quantity::AreaGap]
        .iter()
        .any(|of| findings.trends.iter().any(|trend| trend.quantity == *of))
    {
        let mut parts = vec![format!(
            "At {load} one of the three finest lengths is beyond the valid range, so that nothing is said of limits of areas and gaps."
        )];
        parts.extend(findings.sign.map(|found| format!("Where it is valid, {}.", sign(found))));
        return parts;
    }
    let mut parts: Vec<String> =
        findings.sign.map(|found| format!("At {load}, {}.", sign(found))).into_iter().collect();
    let [separation, area] = findings.leads.each_ref().map(|found| found.as_ref().map(lead));
    match (separation, area) {
        (Some(separation), Some(area)) if separation == area => {
            parts.push(format!("The leading part of the gap in separation and in area {separation}."));
        }
        (separation, area) => {
            parts.extend(separation.map(|lead| format!("The leading part of the gap in separation {lead}.")));
            parts.extend(area.map(|lead| format!("The leading part of the gap in area {lead}.")));
        }
    }
    parts
}

fn sign(found: Sign) -> String {
    let shown = |gap: f64| format!("{} σ", signed(gap));
    match found {
        Sign::Kept([low, high]) => {
            format!("the gap in separation keeps its sign ({} to {})", shown(low), shown(high))
        }
        Sign::Changed { negative, positive } => {
            let [at_negative, at_positive] = [negative, positive].map(|(length, _)| quantity(length, "m"));
            format!(
                "the gap in separation changes its sign: {} at {at_negative}, {} at {at_positive}",
                shown(negative.1),
                shown(positive.1)
            )
        }
        Sign::Open { open, of } => {
            format!(
                "the sign of the gap in separation is not known: at {open} of {of} lengths its interval holds zero"
            )
        }
    }
}

fn lead(found: &Lead) -> String {
    let rest = |told: &usize, of: &usize| {
        if told == of {
            format!("at all {of} lengths")
        } else {
            format!("at {told} of {of} lengths (elsewhere it cannot be told)")
        }
    };
    match found {
        Lead::One { cause, told, of } => format!("is that of the {} {}", cause.label(), rest(told, of)),
        Lead::Several { causes, told, of } => {
            let each = causes.iter().map(|(cause, lengths)| {
                let lengths: Vec<String> = lengths.iter().map(|&length| quantity(length, "m")).collect();
                format!("that of the {} at {}", cause.label(), listed(&lengths))
            });
            let each: Vec<String> = each.collect();
            let open = if told == of { "" } else { " (elsewhere it cannot be told)" };
            format!("changes: {}{open}", each.join(", "))
        }
        Lead::Open { of } => {
            format!("cannot be told at any of {of} lengths")
        }
    }
}
