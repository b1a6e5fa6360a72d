//! Which matters more, law or summation, in sentences.

use super::words::{short, size};
use crate::kind::laws::results::{LawsResults, SurfaceInfluence};
use asperity::compare::{Attribution, Dominant, Group, Measure};
use asperity_framework::report::format::{listed, quantity};
use asperity_framework::report::page::escape;

/// Where the law matters more, and where the adding-up: a line a measure.
pub fn verdict(results: &LawsResults) -> Vec<String> {
    Measure::ALL.into_iter().filter_map(|measure| verdict_by(results, measure)).collect()
}

fn verdict_by(results: &LawsResults, measure: Measure) -> Option<String> {
    let what = match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area",
    };
    let found = results.compare.surfaces.iter().filter_map(|found| {
        Some((escape(&found.surface.name), results.of_first(&found.surface.name)?.attribution(measure)?))
    });
    let found: Vec<(String, &Attribution)> = found.collect();
    let names = |is_it: &dyn Fn(&Attribution) -> bool| -> Vec<String> {
        found.iter().filter(|(_, found)| is_it(found)).map(|(name, _)| name.clone()).collect()
    };
    let part = |(what, dominant): (&str, Dominant)| {
        let on = names(&|found| found.dominant() == dominant);
        (!on.is_empty()).then(|| format!("{what} on {}", listed(&on)))
    };
    let parts = [
        ("the law matters more than the adding-up", Dominant::Law),
        ("the adding-up matters more than the law", Dominant::Summation),
        ("the models cannot be told apart for the sampling error of the sum", Dominant::Undecided),
    ];
    let parts: Vec<String> = parts.into_iter().filter_map(part).collect();
    // Of the surfaces on which the law matters more: where it still does without the law that lies furthest off.
    let law = || found.iter().filter(|(_, found)| found.dominant() == Dominant::Law);
    let mut rest = String::new();
    if law().any(|(_, found)| found.without_furthest.is_some()) {
        let on = names(&|found| {
            found.dominant() == Dominant::Law && found.is_law_without_furthest() == Some(true)
        });
        let on = if on.is_empty() { "none".to_owned() } else { listed(&on) };
        rest = format!(" Without the one law that lies furthest off, the law matters more on {on}.");
    }
    (!parts.is_empty()).then(|| format!("**By {what}** {}.{rest}", parts.join(", ")))
}

/// Which matters more on one surface, by how much, and how much of it is chance: a line a measure.
pub fn in_short(results: &LawsResults, surface: &str) -> Vec<String> {
    let Some(found) = results.of_first(surface) else { return Vec::new() };
    if found.attributions.is_empty() {
        return vec![format!("**{}**: no load counts, so nothing is said of it.", escape(surface))];
    }
    found.attributions.iter().map(|attribution| line(found, attribution)).collect()
}

fn line(found: &SurfaceInfluence, attribution: &Attribution) -> String {
    let &Attribution { measure, group, law, summation, without_furthest, .. } = attribution;
    let what = match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area and, turned over, mean real pressure",
    };
    let members = match group {
        Group::ElasticPlastic => "the laws that go beyond elastic contact",
        Group::All => "the laws",
    };
    let laws = &found.influence.laws;
    let rest = without_furthest.map_or_else(String::new, |(furthest, rest)| {
        format!(
            ", {} without {}, which lies furthest from {}",
            size(measure, rest.mean),
            escape(&laws[furthest]),
            escape(&laws[0])
        )
    });
    format!(
        "**{}, {what}**: {members} lie {} apart in the mean under the sum ({} at most, at {}){rest}. Integral and sum under {} lie {} apart \
         in the mean ({} at most, at {}). {}. {}",
        escape(&found.surface),
        size(measure, law.mean),
        size(measure, law.largest),
        quantity(law.at, "Pa"),
        escape(&laws[0]),
        size(measure, summation.mean),
        size(measure, summation.largest),
        quantity(summation.at, "Pa"),
        which(attribution),
        chance(attribution),
    )
}

/// Which matters more, and how many times as much.
fn which(attribution: &Attribution) -> String {
    let ratio = attribution.ratio();
    let times = if ratio < 10.0 { format!("{ratio:.1} times") } else { format!("{} times", short(ratio)) };
    let logarithms = match attribution.measure {
        Measure::Separation => "",
        Measure::Area => ", in logarithms",
    };
    match attribution.dominant() {
        Dominant::Law => format!("The law matters {times} as much as the adding-up{logarithms}"),
        Dominant::Summation => format!("The adding-up matters {times} as much as the law{logarithms}"),
        Dominant::Undecided => {
            "Integral and sum cannot be told apart here, so that nothing is said of which matters more"
                .to_owned()
        }
    }
}

/// How much of the gap between the models may be chance.
fn chance(attribution: &Attribution) -> String {
    let Some((error, errors)) = attribution.sampling.zip(attribution.standard_errors()) else {
        return String::new();
    };
    let bound = match attribution.measure {
        Measure::Separation => "is",
        Measure::Area => "is at most",
    };
    let judged = if attribution.is_significant() { "" } else { ", which leaves room for chance" };
    format!(
        "The sampling error of the sum {bound} {} in the mean: the gap between the models is {errors:.1} times that{judged}.",
        size(attribution.measure, error.mean),
    )
}
