//! How much the law matters beside the way of adding up, in words and tables: the numbers are those of
//! [`crate::compare::Influence`].

use super::super::compare::CONDITION;
use super::super::format::{number, percent, quantity};
use super::super::page::{Page, escape};
use super::{figures, subject};
use crate::compare::{AtLoad, Group, Influence, Kind, Measure, Weight, of_each_decade};
use crate::experiment::LawsResults;
use crate::experiment::results::SurfaceResults;

/// A gap of fewer standard errors than this may be chance.
const SIGNIFICANT: f64 = 3.0;

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

/// A size in the words of its measure: "0.12 σ", "12.3 %".
fn size(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => format!("{} σ", number(value.abs())),
        Measure::Area => percent(value.abs().exp_m1()),
    }
}

/// A signed difference: "-0.12", "0.891".
fn signed(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Separation => number(value),
        Measure::Area => number(value.exp()),
    }
}

/// Which matters more, by how much, and how much of it is chance: a line a measure.
pub fn in_short(results: &LawsResults, found: &SurfaceResults) -> Vec<String> {
    let Some(influence) = of_first(results, found) else { return Vec::new() };
    let line = |measure| in_short_by(results, found, influence, measure);
    let lines: Vec<String> = Measure::ALL.into_iter().filter_map(line).collect();
    if lines.is_empty() {
        return vec![format!(
            "**{}**: no load is carried by at least 30 asperities within A/A_nom = 0.05 under every law, so nothing is said of it.",
            subject(found)
        )];
    }
    lines
}

fn in_short_by(
    results: &LawsResults,
    found: &SurfaceResults,
    influence: &Influence,
    measure: Measure,
) -> Option<String> {
    let group = group(results);
    let law = influence.of_law(measure, group, Kind::Deterministic)?;
    let model = influence.of_adding_up(measure, 0)?;
    let at = influence.loads.iter().find(|at| at.pressure == law.at)?;
    let ends = at.spread(measure, group, Kind::Deterministic)?;
    let (what, verb) = match measure {
        Measure::Separation => ("separation", "lie"),
        Measure::Area => ("real area, and mean real pressure", "lie"),
    };
    let members = match group {
        Group::Passing => "the laws that pass from elastic to plastic",
        Group::All => "the laws",
    };
    let verdict = if law.mean > model.mean {
        format!("The law matters {} times as much as the adding-up", number(law.mean / model.mean))
    } else {
        format!("The adding-up matters {} times as much as the law", number(model.mean / law.mean))
    };
    Some(format!(
        "**{}, {what}**: {members} {verb} {} apart in the mean under the sum ({} at most, at {}, from {} to {}); integral and \
         sum under {} lie {} apart in the mean ({} at most, at {}). {verdict}{}. {}{CONDITION}",
        subject(found),
        size(measure, law.mean),
        size(measure, law.largest),
        quantity(law.at, "Pa"),
        escape(&influence.laws[ends.lowest]),
        escape(&influence.laws[ends.highest]),
        escape(&influence.laws[0]),
        size(measure, model.mean),
        size(measure, model.largest),
        quantity(model.at, "Pa"),
        match measure {
            Measure::Separation => "",
            Measure::Area => " (in logarithms)",
        },
        chance(measure, influence, &model),
    ))
}

/// How much of the gap between the models may be chance.
fn chance(measure: Measure, influence: &Influence, model: &Weight) -> String {
    let Some(error) = influence.of_sampling(measure, 0) else { return String::new() };
    let errors = model.mean / error.mean;
    let judged = if errors < SIGNIFICANT {
        "so that another sample of the same surface may change the gap between the models as much"
    } else {
        "so that the gap between the models is no chance"
    };
    format!(
        "The sampling error of the sum is {} in the mean, {} of that gap, {judged}. ",
        size(measure, error.mean),
        percent(errors.recip()),
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
             law. Where the coloured lines lie wider apart than the black one from zero (or one), the law matters more.",
            influence.laws[0]
        ),
    );
    for measure in Measure::ALL {
        load_by_load(page, influence, measure);
    }
    for measure in Measure::ALL {
        law_by_law(page, results, influence, measure);
    }
}

/// Spread over the laws, gap between the models and sampling error at loads near the powers of ten.
fn load_by_load(page: &mut Page, influence: &Influence, measure: Measure) {
    let first = escape(&influence.laws[0]);
    page.paragraph(&match measure {
        Measure::Separation => format!(
            "**d/σ at equal load**: the largest minus the smallest over the laws under each model, all laws and those that pass from \
             elastic to plastic; integral minus sum under {first} and under the law where it is largest; the standard error of the \
             sum under {first}. Last: passing laws under the sum over the gap under {first}."
        ),
        Measure::Area => format!(
            "**Real area at equal load**, the same in ratios: the largest over the smallest; integral over sum; the standard error in \
             percent. The mean real pressure has the same ratios turned over, since it is the nominal pressure over A/A_nom. Last: \
             the ratio of the logarithms."
        ),
    });
    let head = [
        "p",
        "all laws, integral",
        "all laws, sum",
        "passing, integral",
        "passing, sum",
        "models, first law",
        "models, most",
        "s.e. of the sum",
        "law / adding-up",
        "",
    ];
    let rows = of_each_decade(&influence.loads, |at| at.pressure, 1.0);
    page.table(head, rows.into_iter().map(|at| load_row(influence, at, measure)));
}

fn load_row(influence: &Influence, at: &AtLoad, measure: Measure) -> Vec<String> {
    let dash = || "-".to_owned();
    let spread = |group, kind| {
        let found = at.spread(measure, group, kind);
        found.map_or_else(dash, |spread| signed(measure, spread.size))
    };
    let (law, largest) = at.largest_gap(measure);
    let error = at.sampling_error(measure, 0).map_or_else(dash, |error| match measure {
        Measure::Separation => number(error),
        Measure::Area => percent(error),
    });
    let gap = at.gap(measure, 0);
    let ratio = at.spread(measure, Group::Passing, Kind::Deterministic).map(|law| law.size / gap.abs());
    vec![
        quantity(at.pressure, "Pa"),
        spread(Group::All, Kind::Statistical),
        spread(Group::All, Kind::Deterministic),
        spread(Group::Passing, Kind::Statistical),
        spread(Group::Passing, Kind::Deterministic),
        signed(measure, gap),
        format!("{} ({})", signed(measure, largest), influence.laws[law]),
        error,
        ratio.map_or_else(dash, number),
        remark(at).to_owned(),
    ]
}

/// Why a load does not count.
fn remark(at: &AtLoad) -> &'static str {
    if at.counts {
        ""
    } else if at.fewest_contacts.round() < crate::compare::FEWEST_CONTACTS {
        "few contacts"
    } else {
        "asperities interact"
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
         itself. {CONDITION}",
        escape(&influence.laws[0])
    ));
    let told = |weight: Option<Weight>| {
        let words =
            |weight: Weight| format!("{} at {}", signed(measure, weight.largest), quantity(weight.at, "Pa"));
        weight.map_or_else(|| "-".to_owned(), words)
    };
    let row = |(index, law): (usize, &crate::experiment::LawOnOne)| {
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
            errors.map_or_else(|| "-".to_owned(), |errors| number(errors.largest.abs())),
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
