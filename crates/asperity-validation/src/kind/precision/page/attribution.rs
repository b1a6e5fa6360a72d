//! The difference between the models divided among its causes: time, and error of the product of heights and radii.

use asperity_framework::report::format::{count, listed, number};
use asperity_framework::report::page::{Page, escape};

use super::{thread_count, time, two_digits};
use crate::kind::precision::run::{CasePrecision, PrecisionResults};
use crate::precision::attribution::{MULTIPLIED, SEPARATIONS};

/// The largest set, and the largest error under the law of the spec.
pub fn summary_line(case: &CasePrecision, law: &str) -> Option<String> {
    let found = case.attribution.as_ref()?;
    let largest = found.points.last()?;
    let error = found.products.iter().find(|product| product.law == law);
    let error = error.map_or_else(String::new, |product| {
        format!(
            "; own heights with own radii, independent of each other, are within {} of all {} pairs",
            number(two_digits(product.error)),
            count(MULTIPLIED * MULTIPLIED)
        )
    });
    Some(format!(
        "**Causes, {}**: dividing the difference of {} asperities at {} loads takes {}, {} times as long as both models{error}.",
        escape(&case.name),
        count(largest.asperities),
        largest.divided,
        time(two_digits(largest.attribution_seconds)),
        number(two_digits(largest.time_ratio()))
    ))
}

/// The section on causes.
pub fn section(page: &mut Page, results: &PrecisionResults) {
    let all = || results.cases.iter().filter_map(|case| Some((case, case.attribution.as_ref()?)));
    if all().next().is_none() {
        return;
    }
    page.heading(2, "Causes of the difference between the models");
    page.paragraph(&format!(
        "The difference at equal load is divided among height distribution, spread of radii and height-radius correlation on random sets of skewed \
         heights and log-normal radii, on {}. The time covers the rearrangement of the asperities and all states between the models. Own heights with own radii, \
         independent of each other, are condensed: the error is that of their pressure against the sum over every height with every radius of {} asperities, at {} sigma.",
        thread_count(results.threads),
        count(MULTIPLIED),
        listed(&SEPARATIONS.map(number))
    ));
    for (case, found) in all() {
        page.heading(3, &case.name);
        page.table(
            ["asperities", "loads", "both models", "causes", "over both models"],
            found.points.iter().map(|point| {
                vec![
                    count(point.asperities),
                    count(point.divided),
                    time(two_digits(point.model_seconds)),
                    time(two_digits(point.attribution_seconds)),
                    number(two_digits(point.time_ratio())),
                ]
            }),
        );
        page.table(
            ["law", "error of own heights with own radii", "times as fast as all pairs"],
            found.products.iter().map(|product| {
                vec![
                    escape(&product.law),
                    number(two_digits(product.error)),
                    number(two_digits(product.speedup)),
                ]
            }),
        );
    }
}
