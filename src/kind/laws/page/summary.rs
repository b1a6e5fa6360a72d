//! Summary: which matters more, contact law or summation method.

use super::measures::size;
use crate::kind::laws::results::{LawsResults, SurfaceInfluence};
use asperity::compare::{Dominance, Dominant, Group, Measure};
use asperity_framework::report::format::{input_quantity, listed, number};
use asperity_framework::report::page::escape;

/// On which surfaces the law matters more, and on which the summation method: one line per measure.
pub fn verdict(results: &LawsResults) -> Vec<String> {
    Measure::ALL.into_iter().filter_map(|measure| verdict_by(results, measure)).collect()
}

fn verdict_by(results: &LawsResults, measure: Measure) -> Option<String> {
    let what = quantity(measure);
    let found = results.compare.surfaces.iter().filter_map(|found| {
        Some((escape(&found.surface.name), results.of_first(&found.surface.name)?.dominance(measure)?))
    });
    let found: Vec<(String, &Dominance)> = found.collect();
    let names = |is_it: &dyn Fn(&Dominance) -> bool| -> Vec<String> {
        found.iter().filter(|(_, found)| is_it(found)).map(|(name, _)| name.clone()).collect()
    };
    let part = |(what, dominant): (&str, Dominant)| {
        let on = names(&|found| found.dominant() == dominant);
        (!on.is_empty()).then(|| format!("{what} on {}", listed(&on)))
    };
    let parts = [
        ("the contact law matters more than the summation method", Dominant::Law),
        ("the summation method matters more than the contact law", Dominant::Summation),
        ("contact law and summation method matter equally", Dominant::Equal),
        ("no conclusion is drawn", Dominant::Undecided),
    ];
    let parts: Vec<String> = parts.into_iter().filter_map(part).collect();
    // Of the surfaces on which the law matters more: where it still does without the most deviating law.
    let law = || found.iter().filter(|(_, found)| found.dominant() == Dominant::Law);
    let mut rest = String::new();
    if law().any(|(_, found)| found.without_furthest.is_some()) {
        let on = names(&|found| {
            found.dominant() == Dominant::Law && found.is_law_without_furthest() == Some(true)
        });
        let on = if on.is_empty() { "no surface".to_owned() } else { listed(&on) };
        rest = format!(" Without the most deviating law, the contact law matters more on {on}.");
    }
    (!parts.is_empty()).then(|| format!("**By {what}** {}.{rest}", parts.join(", ")))
}

/// The columns of [`rows`].
pub const HEADER: [&str; 5] =
    ["surface", "measured by", "matters more", "mean range over the laws", "mean difference of the models"];

/// One row per surface and measure.
pub fn rows(results: &LawsResults) -> Vec<Vec<String>> {
    let of_surface = |found: &SurfaceInfluence| -> Vec<Vec<String>> {
        let row = |dominance: &Dominance| {
            let what = match dominance.dominant() {
                Dominant::Law => "contact law",
                Dominant::Summation => "summation method",
                Dominant::Equal => "both equally",
                Dominant::Undecided => "cannot tell",
            };
            vec![
                found.surface.clone(),
                quantity(dominance.measure).to_owned(),
                what.to_owned(),
                size(dominance.measure, dominance.law.mean),
                size(dominance.measure, dominance.summation.mean),
            ]
        };
        found.dominances.iter().map(row).collect()
    };
    let all = results.compare.surfaces.iter().filter_map(|found| results.of_first(&found.surface.name));
    all.flat_map(of_surface).collect()
}

fn quantity(measure: Measure) -> &'static str {
    match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area",
    }
}

/// Which matters more on one surface, by how much, and within which sampling uncertainty: one line per measure.
pub fn summary_lines(results: &LawsResults, surface: &str) -> Vec<String> {
    let Some(found) = results.of_first(surface) else { return Vec::new() };
    if found.dominances.is_empty() {
        return vec![format!(
            "**{}**: no load is within the valid range under every law, so no conclusion is drawn.",
            escape(surface)
        )];
    }
    found.dominances.iter().map(|dominance| line(found, dominance)).collect()
}

fn line(found: &SurfaceInfluence, dominance: &Dominance) -> String {
    let &Dominance { measure, group, law, summation, without_furthest, .. } = dominance;
    let what = match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area (inversely, mean contact pressure)",
    };
    let members = match group {
        Group::ElasticPlastic => "The elastic-plastic laws",
        Group::All => "The laws",
    };
    let laws = &found.influence.laws;
    let rest = without_furthest.map_or_else(String::new, |(furthest, rest)| {
        format!(
            ", {} without {}, which deviates most from {}",
            size(measure, rest.mean),
            escape(&laws[furthest]),
            escape(&laws[0])
        )
    });
    format!(
        "**{}, {what}**: {}. {members} differ by {} on average in the deterministic model (at most {}, at {}){rest}. Under \
         {} the statistical and the deterministic model differ by {} on average (at most {}, at {}). {}",
        escape(&found.surface),
        which(dominance),
        size(measure, law.mean),
        size(measure, law.largest),
        input_quantity(law.at, "Pa"),
        escape(&laws[0]),
        size(measure, summation.mean),
        size(measure, summation.largest),
        input_quantity(summation.at, "Pa"),
        chance(dominance),
    )
}

/// Which matters more, and how many times as much.
fn which(dominance: &Dominance) -> String {
    let ratio = dominance.ratio();
    let times = if ratio < 10.0 { format!("{ratio:.1} times") } else { format!("{} times", number(ratio)) };
    let logarithms = match dominance.measure {
        Measure::Separation => "",
        Measure::Area => " (ratio of logarithms)",
    };
    match dominance.dominant() {
        Dominant::Law => format!("the contact law matters {times} as much as the summation method{logarithms}"),
        Dominant::Summation => format!("the summation method matters {times} as much as the contact law{logarithms}"),
        Dominant::Equal => "contact law and summation method matter equally".to_owned(),
        Dominant::Undecided if dominance.sampling.is_none() => {
            "no interval of the difference between the models is claimed, so no conclusion is drawn on which matters more".to_owned()
        }
        Dominant::Undecided => {
            "the models cannot be distinguished within sampling uncertainty, so no conclusion is drawn on which matters \
             more"
                .to_owned()
        }
    }
}

/// The sampling error of the difference between the models.
fn chance(dominance: &Dominance) -> String {
    let error = dominance.sampling.map(|error| size(dominance.measure, error.mean));
    error.map_or_else(String::new, |error| format!("The mean standard error of that difference is {error}."))
}
