//! Curves of many separations, and lists of many asperities.

use super::{figures, file, thread_count, time, two_digits};
use crate::kind::precision::run::{CasePrecision, PrecisionResults};
use crate::precision::curve::{CurveFindings, CurvePoint};
use crate::precision::list::{LONG, ListPoint, LongLists};
use crate::precision::sum::SEPARATIONS;
use asperity::compare::Kind;
use asperity_framework::report::format::{count, input_number, number, quantity};
use asperity_framework::report::page::{Page, escape};

/// Time of curves and lists.
pub fn summary_lines(case: &CasePrecision) -> Vec<String> {
    let curve = case.curve.as_ref().and_then(curve_cost);
    let curve = curve.map(|text| format!("**A curve, {}**: {text}.", escape(&case.name)));
    let list = list_cost(&case.lists).map(|text| format!("**Lists, {}**: {text}.", escape(&case.name)));
    curve.into_iter().chain(list).collect()
}

/// Name of the model on this page.
const fn model(kind: Kind) -> &'static str {
    match kind {
        Kind::Statistical => "integral",
        Kind::Deterministic => "sum",
    }
}

/// The cost of both models at the loosest tolerance and at the tightest one at which separations were interpolated.
fn curve_cost(found: &CurveFindings) -> Option<String> {
    let of = |kind: Kind| {
        let first = found.points.iter().find(|point| point.kind == kind)?;
        let asperities = match kind {
            Kind::Statistical => String::new(),
            Kind::Deterministic => format!(" of {} asperities", count(found.asperities)),
        };
        let name = format!("{} separations of the {}{asperities}", count(first.separations), model(kind));
        let interpolated: Vec<&CurvePoint> = found.interpolated(kind).collect();
        let Some((loosest, others)) = interpolated.split_last() else {
            return Some(format!("{name} are all evaluated within each tolerance"));
        };
        let at = |point: &CurvePoint, of: &str| {
            Some(format!(
                "{}{of} within {} (error found: {})",
                number(two_digits(found.time_ratio(point))),
                input_number(point.tolerance?),
                number(two_digits(point.error())),
            ))
        };
        let tightest = others.first().and_then(|point| at(point, ""));
        let tightest = tightest.map_or_else(String::new, |text| format!(" and {text}"));
        Some(format!("{name} take {}{tightest}", at(loosest, " times the time of the exact curve")?))
    };
    let parts: Vec<String> = [Kind::Statistical, Kind::Deterministic].into_iter().filter_map(of).collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

fn list_cost(lists: &[ListPoint]) -> Option<String> {
    let LongLists { shortest: first, longest: last, seconds_per_asperity } = LongLists::of(lists)?;
    let memory = last.peak_bytes.map_or_else(String::new, |bytes| {
        format!(" and at most {} of memory", quantity(two_digits(bytes as f64), "B"))
    });
    let [least, most] = seconds_per_asperity.map(|each| time(two_digits(each)));
    let spread = if least == most { most } else { format!("{least} to {most}") };
    let range = if first.asperities == last.asperities {
        format!("{spread} per asperity with {} asperities", count(first.asperities))
    } else {
        format!(
            "{spread} per asperity from {} to {} asperities",
            count(first.asperities),
            count(last.asperities)
        )
    };
    Some(format!(
        "reading a file and summing at {} separations takes {range}; {} asperities take {}{memory}",
        last.separations,
        count(last.asperities),
        time(two_digits(last.read_seconds + last.sum_seconds)),
    ))
}

/// The section on curves within a tolerance.
pub fn curves(page: &mut Page, results: &PrecisionResults) {
    let all = || results.cases.iter().filter_map(|case| Some((case, case.curve.as_ref()?)));
    let Some((_, first)) = all().next() else { return };
    let Some(exact) = first.points.first() else { return };
    let [from, to] = SEPARATIONS;
    page.heading(2, "A curve within a tolerance");
    page.paragraph(&format!(
        "{} separations spread evenly from {from} to {to} σ, of the integral and of the sum of {} asperities, on {}. With \
         a tolerance the model is evaluated at some of them, such that load and area change by at most the tolerance from each to \
         the next; the others are interpolated. Where this takes more than half of the separations, all are evaluated. *Error*: the \
         largest relative difference from the exact curve, which cannot exceed the tolerance.",
        count(exact.separations),
        count(first.asperities),
        thread_count(results.threads),
    ));
    for (case, found) in all() {
        page.heading(3, &case.name);
        page.figure(
            &format!("{}-curve.svg", file(&case.name)),
            figures::curves(found),
            &format!(
                "Time of a curve of {} separations against its tolerance (line) and, where separations are interpolated, against \
                 the error found (crosses). Horizontal line: the exact curve.",
                count(exact.separations),
            ),
        );
        page.table(
            [
                "model",
                "tolerance",
                "separations",
                "evaluated",
                "area error",
                "load error",
                "time",
                "over exact",
            ],
            found.points.iter().map(|point| {
                vec![
                    model(point.kind).to_owned(),
                    point.tolerance.map_or_else(|| "exact".to_owned(), input_number),
                    count(point.separations),
                    count(point.evaluated),
                    number(two_digits(point.area_error)),
                    number(two_digits(point.load_error)),
                    time(point.seconds),
                    number(two_digits(found.time_ratio(point))),
                ]
            }),
        );
    }
}

/// The section on lists.
pub fn lists(page: &mut Page, results: &PrecisionResults) {
    let all = || results.cases.iter().filter(|case| !case.lists.is_empty());
    let Some(first) = all().next().and_then(|case| case.lists.first()) else { return };
    page.heading(2, "Lists from files");
    page.paragraph(&format!(
        "Random sets are written as lists of heights and radii (`.npy`, 16 bytes per asperity), read back and summed at {} separations, on {}. \
         The file is mapped into memory, not copied, and is still in the cache of the system: reading from disk may be \
         slower. The sum makes no copy of the list. *Memory*: peak of the program, the mapped file included; *added*: the \
         increase over the state before.",
        first.separations,
        thread_count(results.threads),
    ));
    for case in all() {
        page.heading(3, &case.name);
        page.figure(
            &format!("{}-lists.svg", file(&case.name)),
            figures::lists(&case.lists),
            "Time per asperity against the length of the list. Horizontal: the time is proportional to the length.",
        );
        page.table(
            [
                "asperities",
                "to read",
                "per asperity",
                "to sum",
                "per asperity",
                "memory",
                "added",
                "per asperity",
            ],
            case.lists.iter().map(|point| {
                let of_each = |value: f64| value / point.asperities as f64;
                let bytes = |bytes: Option<f64>| {
                    bytes.map_or_else(String::new, |bytes| quantity(two_digits(bytes), "B"))
                };
                let taken = point.added_bytes.map(|bytes| bytes as f64);
                vec![
                    count(point.asperities),
                    time(point.read_seconds),
                    time(of_each(point.read_seconds)),
                    time(point.sum_seconds),
                    time(of_each(point.sum_seconds)),
                    bytes(point.peak_bytes.map(|bytes| bytes as f64)),
                    bytes(taken),
                    // Not reliable for short lists.
                    bytes(taken.filter(|_| point.asperities >= LONG).map(of_each)),
                ]
            }),
        );
    }
}
