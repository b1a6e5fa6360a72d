//! How much the law matters beside the way of adding up, in words and tables: the numbers are those of
//! [`asperity::compare::Influence`].

use super::{figures, subject};
use crate::kind::compare::results::SurfaceResults;
use crate::kind::laws::run::LawsResults;
use asperity::compare::{AtLoad, Group, Influence, Kind, Measure, Weight, of_each_decade};
use asperity_framework::report::format::listed;
use asperity_framework::report::format::{number, percent, quantity};
use asperity_framework::report::page::{Page, escape};

/// A gap of fewer standard errors than this may be chance.
const SIGNIFICANT: f64 = 3.0;

/// A gap of fewer than this is not told from none.
const TOLD: f64 = 2.0;

/// The numbers of the first realisation.
fn of_first<'a>(results: &'a LawsResults, found: &SurfaceResults) -> Option<&'a Influence> {
    let name = &found.surface.name;
    results.influences.iter().find(|found| found.surface == *name).map(|found| &found.influence)
}

/// The laws that a finding is over: those that pass from elastic to plastic, or all where fewer than two do.
fn group(results: &LawsResults) -> Group {
    let passing = results.laws.iter().filter(|law| law.passes_regimes).count();
    if passing > 1 { Group::Passing } else { Group::All }
}

/// At most three significant digits.
fn short(value: f64) -> String {
    number(format!("{value:.2e}").parse().unwrap_or(value))
}

/// How many times one thing is another, in words that promise no more than they know.
fn times(ratio: f64) -> String {
    if ratio < 10.0 { format!("{ratio:.1} times") } else { format!("{} times", short(ratio)) }
}

/// A size in the words of its measure: "0.12 σ", "12.3 %".
fn size(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => format!("{} σ", short(value.abs())),
        Measure::Area => percent(value.abs().exp_m1()),
    }
}

/// A signed difference: "-0.12", "0.891".
fn signed(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => short(value),
        Measure::Area => short(value.exp()),
    }
}

/// What law and adding-up weigh on a surface: the spread of the sums, and the gap under the first law.
fn weights(results: &LawsResults, influence: &Influence, measure: Measure) -> Option<(Weight, Weight)> {
    let law = influence.of_law(measure, group(results), Kind::Deterministic)?;
    Some((law, influence.of_adding_up(measure, 0)?))
}

/// Where the law matters more, and where the adding-up: a line a measure.
pub fn verdict(results: &LawsResults) -> Vec<String> {
    Measure::ALL.into_iter().filter_map(|measure| verdict_by(results, measure)).collect()
}

fn verdict_by(results: &LawsResults, measure: Measure) -> Option<String> {
    let what = match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area",
    };
    let (mut law, mut model, mut neither) = (Vec::new(), Vec::new(), Vec::new());
    // Surfaces on which the law matters more though the one that lies furthest off is left out, if some are left then.
    let mut left: Option<Vec<String>> = None;
    for found in &results.compare.surfaces {
        let Some(influence) = of_first(results, found) else { continue };
        let Some(weights) = weights(results, influence, measure) else { continue };
        if !is_told(influence, measure, &weights.1) {
            neither.push(subject(found));
            continue;
        }
        if weights.0.mean <= weights.1.mean {
            model.push(subject(found));
            continue;
        }
        law.push(subject(found));
        if let Some((_, rest)) = without_furthest(results, influence, measure) {
            let left = left.get_or_insert_default();
            if rest.mean > weights.1.mean {
                left.push(subject(found));
            }
        }
    }
    let parts = [
        ("the law matters more than the adding-up", &law),
        ("the adding-up matters more than the law", &model),
        ("the models cannot be told apart for the sampling error of the sum", &neither),
    ];
    let parts = parts.into_iter().filter(|(_, on)| !on.is_empty());
    let told: Vec<String> = parts.map(|(what, on)| format!("{what} on {}", listed(on))).collect();
    let rest = left.map_or_else(String::new, |left| {
        let on = if left.is_empty() { "none".to_owned() } else { listed(&left) };
        format!(" Without the one law that lies furthest off, the law matters more on {on}.")
    });
    (!told.is_empty()).then(|| format!("**By {what}** {}.{rest}", told.join(", ")))
}

/// Which matters more, by how much, and how much of it is chance: a line a measure.
pub fn in_short(results: &LawsResults, found: &SurfaceResults) -> Vec<String> {
    let Some(influence) = of_first(results, found) else { return Vec::new() };
    let line = |measure| in_short_by(results, found, influence, measure);
    let lines: Vec<String> = Measure::ALL.into_iter().filter_map(line).collect();
    if lines.is_empty() {
        return vec![format!("**{}**: no load counts, so nothing is said of it.", subject(found))];
    }
    lines
}

fn in_short_by(
    results: &LawsResults,
    found: &SurfaceResults,
    influence: &Influence,
    measure: Measure,
) -> Option<String> {
    let (law, model) = weights(results, influence, measure)?;
    let what = match measure {
        Measure::Separation => "d/σ",
        Measure::Area => "real area and, turned over, mean real pressure",
    };
    let members = match group(results) {
        Group::Passing => "the laws that go beyond elastic contact",
        Group::All => "the laws",
    };
    let verdict = if !is_told(influence, measure, &model) {
        "Integral and sum cannot be told apart here, so that nothing is said of which matters more".to_owned()
    } else if law.mean > model.mean {
        format!("The law matters {} as much as the adding-up", times(law.mean / model.mean))
    } else {
        format!("The adding-up matters {} as much as the law", times(model.mean / law.mean))
    };
    let left = without_furthest(results, influence, measure).map_or_else(String::new, |(furthest, left)| {
        format!(
            ", {} without {}, which lies furthest from {}",
            size(measure, left.mean),
            escape(&influence.laws[furthest]),
            escape(&influence.laws[0])
        )
    });
    Some(format!(
        "**{}, {what}**: {members} lie {} apart in the mean under the sum ({} at most, at {}){}. Integral and sum under {} lie {} apart \
         in the mean ({} at most, at {}). {verdict}{}. {}",
        subject(found),
        size(measure, law.mean),
        size(measure, law.largest),
        quantity(law.at, "Pa"),
        left,
        escape(&influence.laws[0]),
        size(measure, model.mean),
        size(measure, model.largest),
        quantity(model.at, "Pa"),
        match measure {
            Measure::Area if is_told(influence, measure, &model) => ", in logarithms",
            _ => "",
        },
        chance(measure, influence, &model),
    ))
}

/// The law whose sums lie furthest from those of the first, and what is left of the spread without it.
fn without_furthest(
    results: &LawsResults,
    influence: &Influence,
    measure: Measure,
) -> Option<(usize, Weight)> {
    let group = group(results);
    let members =
        (1..results.laws.len()).filter(|&law| group == Group::All || results.laws[law].passes_regimes);
    let weight = |law| Some((law, influence.of_choice(measure, law, Kind::Deterministic)?.mean));
    let (furthest, _) = members.filter_map(weight).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let left =
        influence.weight(|at| at.spread_without(measure, group, Kind::Deterministic, Some(furthest)))?;
    Some((furthest, left))
}

/// Whether the gap between the models is more than the sampling error of the sum leaves.
fn is_told(influence: &Influence, measure: Measure, model: &Weight) -> bool {
    let error = influence.of_sampling(measure, 0).map_or(0.0, |error| error.mean);
    model.mean > TOLD * error
}

/// How much of the gap between the models may be chance.
fn chance(measure: Measure, influence: &Influence, model: &Weight) -> String {
    let Some(error) = influence.of_sampling(measure, 0) else { return String::new() };
    let errors = model.mean / error.mean;
    let bound = match measure {
        Measure::Separation => "is",
        Measure::Area => "is at most",
    };
    let judged = if errors < SIGNIFICANT { ", which leaves room for chance" } else { "" };
    format!(
        "The sampling error of the sum {bound} {} in the mean: the gap between the models is {errors:.1} times that{judged}.",
        size(measure, error.mean),
    )
}

/// The picture and the tables of one surface.
pub fn section(page: &mut Page, results: &LawsResults, found: &SurfaceResults) {
    let Some(influence) = of_first(results, found) else { return };
    let name = &found.surface.name;
    page.heading(3, &format!("{name}: law or adding-up?"));
    page.figure(
        &format!("{name}-law-or-model.svg"),
        figures::law_or_model(results, influence),
        &format!(
            "At equal load, beside the sum under {}: coloured, the sums under the other laws; black, the integral under the same \
             law, and where 95 % of other samples of the surface would lie, asperities taken as independent draws. Where the \
             coloured lines lie wider apart than the black one from zero (or one), the law matters more. Shaded: few contacts \
             (fewer than 30), and asperities that interact.{}",
            influence.laws[0],
            outside(results, influence)
        ),
    );
    for measure in Measure::ALL {
        load_by_load(page, influence, measure);
    }
    for measure in Measure::ALL {
        law_by_law(page, results, influence, measure);
    }
    if let Some(mean) = &found.surface.ellipticity {
        page.paragraph(&format!(
            "Under an elliptic law the integral stands on the mean curvature, a radius of {}, under the others on the radius {}: this \
             is a part of what the law changes there.",
            quantity(mean.mean_curvature.recip(), "m"),
            quantity(found.first.population.radius, "m"),
        ));
    }
}

/// Which laws the picture leaves out.
fn outside(results: &LawsResults, influence: &Influence) -> String {
    let of = |measure| {
        let all = figures::outside(results, influence, measure).into_iter();
        let what = match measure {
            Measure::Separation => "separation",
            Measure::Area => "area",
        };
        let names: Vec<String> =
            all.map(|(law, [low, high])| format!("{law} ({} to {})", short(low), short(high))).collect();
        (!names.is_empty()).then(|| format!(" Outside the picture of the {what}: {}.", listed(&names)))
    };
    Measure::ALL.into_iter().filter_map(of).collect()
}

/// Spread over the laws, gap between the models and sampling error at loads near the powers of ten.
fn load_by_load(page: &mut Page, influence: &Influence, measure: Measure) {
    let first = escape(&influence.laws[0]);
    page.paragraph(&match measure {
        Measure::Separation => format!(
            "**d/σ at equal load**: the largest minus the smallest over the laws under each model, all laws and those that go beyond \
             elastic contact; integral minus sum under {first} and under the passing law where it is largest; the standard error of the \
             sum under {first}. Last: passing laws under the sum over the gap under {first}. Loads with a word beside them do not count."
        ),
        Measure::Area => "**Real area at equal load**, the same in ratios: the largest over the smallest; integral over sum; the \
             standard error in percent. The mean real pressure has the same ratios turned over, since it is the nominal pressure \
             over A/A_nom. Last: the ratio of the logarithms."
            .to_owned(),
    });
    let metadata = [
        "p",
        "all laws, integral",
        "all laws, sum",
        "passing, integral",
        "passing, sum",
        "models, first law",
        "models, most",
        "s.e. of the sum",
        "law / adding-up",
    ];
    let rows = of_each_decade(&influence.loads, |at| at.pressure, 1.0);
    page.table(metadata, rows.into_iter().map(|at| load_row(at, measure)));
}

fn load_row(at: &AtLoad, measure: Measure) -> Vec<String> {
    let dash = || "-".to_owned();
    let spread = |group, kind| {
        let found = at.spread(measure, group, kind);
        found.map_or_else(dash, |spread| signed(measure, spread))
    };
    let most = at.largest_gap(measure, Group::Passing);
    let error = at.sampling_error(measure, 0).map_or_else(dash, |error| match measure {
        Measure::Separation => short(error),
        Measure::Area => percent(error),
    });
    let gap = at.gap(measure, 0);
    // Beside a gap that may be none, a ratio says nothing.
    let is_told = gap.abs() > TOLD * at.sampling_error(measure, 0).unwrap_or(0.0);
    let ratio = at.spread(measure, Group::Passing, Kind::Deterministic).map(|law| law / gap.abs());
    let ratio = ratio.filter(|_| is_told);
    vec![
        format!("{}{}", quantity(at.pressure, "Pa"), remark(at)),
        spread(Group::All, Kind::Statistical),
        spread(Group::All, Kind::Deterministic),
        spread(Group::Passing, Kind::Statistical),
        spread(Group::Passing, Kind::Deterministic),
        signed(measure, gap),
        most.map_or_else(dash, |(_, gap)| signed(measure, gap)),
        error,
        ratio.map_or_else(dash, short),
    ]
}

/// Why a load does not count, as the picture has it.
fn remark(at: &AtLoad) -> &'static str {
    if at.counts {
        ""
    } else if at.fewest_contacts.round() < asperity::compare::FEWEST_CONTACTS {
        " (few)"
    } else {
        " (interact)"
    }
}

/// What the choice of each law instead of the first changes, and the gap between the models under it.
fn law_by_law(page: &mut Page, results: &LawsResults, influence: &Influence, measure: Measure) {
    let what = match measure {
        Measure::Separation => "d/σ, as differences",
        Measure::Area => "real area, as ratios",
    };
    page.paragraph(&format!(
        "**Law by law, {what}**: the largest deviation from {} under each model, and the largest gap between the models under the law \
         itself, over the loads that count.",
        escape(&influence.laws[0])
    ));
    let told = |weight: Option<Weight>| {
        let words =
            |weight: Weight| format!("{} at {}", signed(measure, weight.largest), quantity(weight.at, "Pa"));
        weight.map_or_else(|| "-".to_owned(), words)
    };
    let row = |(index, law): (usize, &crate::kind::laws::run::LawOnOne)| {
        let choice = |kind| {
            if index == 0 {
                "(the first)".to_owned()
            } else {
                told(influence.of_choice(measure, index, kind))
            }
        };
        let errors = influence.weight(|at| Some(at.gap(measure, index) / at.sampling_error(measure, index)?));
        vec![
            law.law.clone(),
            choice(Kind::Statistical),
            choice(Kind::Deterministic),
            told(influence.of_adding_up(measure, index)),
            errors.map_or_else(|| "-".to_owned(), |errors| format!("{:.1}", errors.largest.abs())),
        ]
    };
    page.table(
        [
            "law",
            "integral, from the first",
            "sum, from the first",
            "integral from sum",
            "most standard errors",
        ],
        results.laws.iter().enumerate().map(row),
    );
}
