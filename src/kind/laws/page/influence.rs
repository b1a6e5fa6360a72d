//! Law and summation on one surface: figure and tables.

use super::figures;
use super::words::{short, signed};
use crate::kind::compare::results::SurfaceResults;
use crate::kind::laws::results::{LawOnOne, LawsResults, SurfaceInfluence};
use asperity::compare::{AtLoad, Effect, Group, Influence, Kind, Measure, of_each_decade};
use asperity_framework::report::format::{listed, percent, quantity};
use asperity_framework::report::page::{Page, escape};

/// The picture and the tables of one surface.
pub fn section(page: &mut Page, results: &LawsResults, found: &SurfaceResults) {
    let Some(SurfaceInfluence { influence, .. }) = results.of_first(&found.surface.name) else { return };
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
    let most = at.largest_gap(measure, Group::ElasticPlastic);
    let error = at.sampling_error(measure, 0).map_or_else(dash, |error| match measure {
        Measure::Separation => short(error),
        Measure::Area => percent(error),
    });
    vec![
        format!("{}{}", quantity(at.pressure, "Pa"), remark(at)),
        spread(Group::All, Kind::Statistical),
        spread(Group::All, Kind::Deterministic),
        spread(Group::ElasticPlastic, Kind::Statistical),
        spread(Group::ElasticPlastic, Kind::Deterministic),
        signed(measure, at.gap(measure, 0)),
        most.map_or_else(dash, |(_, gap)| signed(measure, gap)),
        error,
        // Beside a gap that may be none, a ratio says nothing.
        at.law_over_summation(measure).map_or_else(dash, short),
    ]
}

/// Why a load does not count, as the picture has it.
fn remark(at: &AtLoad) -> &'static str {
    if at.counts {
        ""
    } else if at.has_few_contacts() {
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
    let told = |weight: Option<Effect>| {
        let words =
            |weight: Effect| format!("{} at {}", signed(measure, weight.largest), quantity(weight.at, "Pa"));
        weight.map_or_else(|| "-".to_owned(), words)
    };
    let row = |(index, law): (usize, &LawOnOne)| {
        let choice = |kind| {
            if index == 0 {
                "(the first)".to_owned()
            } else {
                told(influence.of_choice(measure, index, kind))
            }
        };
        let errors = influence.of_standard_errors(measure, index);
        vec![
            law.law.clone(),
            choice(Kind::Statistical),
            choice(Kind::Deterministic),
            told(influence.of_summation(measure, index)),
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
