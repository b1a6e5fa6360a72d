//! Contact law and summation method on one surface: figure and tables.

use super::measures::signed;
use super::{figures, summary};
use crate::kind::compare::results::SurfaceResults;
use crate::kind::laws::results::{LawOnOne, LawsResults, SurfaceInfluence};
use asperity::compare::{AtLoad, Effect, Group, Influence, Kind, Measure, of_each_decade};
use asperity_framework::report::format::{input_quantity, listed, number, percent, quantity};
use asperity_framework::report::page::{Page, escape};

/// The figure and the tables of one surface.
pub fn section(page: &mut Page, results: &LawsResults, found: &SurfaceResults) {
    let Some(SurfaceInfluence { influence, .. }) = results.of_first(&found.surface.name) else { return };
    let name = &found.surface.name;
    page.heading(2, &format!("{name}: contact law or summation method?"));
    page.bullets(summary::summary_lines(results, name));
    page.figure(
        &format!("{name}-law-or-model.svg"),
        figures::law_or_model(results, influence),
        &format!(
            "The contact law matters more where the coloured lines lie further apart than the black line from zero (or \
             one). All at equal load, relative to the deterministic model under {}. Coloured: deterministic model under \
             the other laws; black: statistical model under the same law, with 1.96 standard errors of the \
             difference where one is claimed. Shaded: loads beyond the valid range.{}",
            influence.laws[0],
            outside(results, influence)
        ),
    );
    page.details(3, &format!("{name}: contact law and summation method load by load"), |page| {
        for measure in Measure::ALL {
            load_by_load(page, influence, measure);
        }
        for measure in Measure::ALL {
            law_by_law(page, results, influence, measure);
        }
    });
    if let Some(mean) = &found.surface.ellipticity {
        page.paragraph(&format!(
            "Under an elliptic law the statistical model uses the mean curvature (radius {}), under the others the radius \
             {}; part of the effect of the law is due to this.",
            quantity(mean.mean_curvature.recip(), "m"),
            input_quantity(found.realisations[0].population.radius, "m"),
        ));
    }
}

/// Laws outside the axes of the figure.
fn outside(results: &LawsResults, influence: &Influence) -> String {
    let of = |measure| {
        let all = figures::outside(results, influence, measure).into_iter();
        let what = match measure {
            Measure::Separation => "separation",
            Measure::Area => "area",
        };
        let names: Vec<String> =
            all.map(|(law, [low, high])| format!("{law} ({} to {})", number(low), number(high))).collect();
        (!names.is_empty()).then(|| format!(" Outside the axes of the {what}: {}.", listed(&names)))
    };
    Measure::ALL.into_iter().filter_map(of).collect()
}

/// Range over the laws, difference between the models and sampling error at loads near the powers of ten.
fn load_by_load(page: &mut Page, influence: &Influence, measure: Measure) {
    let first = escape(&influence.laws[0]);
    page.paragraph(&match measure {
        Measure::Separation => format!(
            "**d/σ at equal load**: range over the laws (largest minus smallest) in each model, for all laws and for the \
             elastic-plastic laws; integral minus sum under {first} and under the elastic-plastic law where it is largest; \
             standard error of that difference under {first}, where an interval is claimed. Last column: range of the elastic-plastic laws in the sum over the \
             difference between the models under {first}. Loads with a remark are outside the range of validity."
        ),
        Measure::Area => "**Real area at equal load**, the same as ratios: largest over smallest; integral over sum; \
        standard error in percent. The mean contact pressure, the nominal pressure over A/A_nom, has the inverse ratios. \
        Last column: ratio of the logarithms."
            .to_owned(),
    });
    let header = [
        "p",
        "all laws, integral",
        "all laws, sum",
        "elastic-plastic, integral",
        "elastic-plastic, sum",
        "model difference, reference law",
        "model difference, largest",
        "s.e. of the difference",
        "law / summation",
    ];
    let rows = of_each_decade(&influence.loads, |at| at.pressure, 1.0);
    page.table(header, rows.into_iter().map(|at| load_row(at, measure)));
}

fn load_row(at: &AtLoad, measure: Measure) -> Vec<String> {
    let dash = || "-".to_owned();
    let spread = |group, kind| {
        let found = at.spread(measure, group, kind);
        found.map_or_else(dash, |spread| signed(measure, spread))
    };
    let most = at.largest_gap(measure, Group::ElasticPlastic);
    let error = at.sampling_error(measure, 0).map_or_else(dash, |error| match measure {
        Measure::Separation => number(error),
        Measure::Area => percent(error),
    });
    vec![
        format!("{}{}", input_quantity(at.pressure, "Pa"), remark(at)),
        spread(Group::All, Kind::Statistical),
        spread(Group::All, Kind::Deterministic),
        spread(Group::ElasticPlastic, Kind::Statistical),
        spread(Group::ElasticPlastic, Kind::Deterministic),
        signed(measure, at.gap(measure, 0)),
        most.map_or_else(dash, |(_, gap)| signed(measure, gap)),
        error,
        // Over a difference that may be zero, a ratio is meaningless.
        at.law_over_summation(measure).map_or_else(dash, number),
    ]
}

/// Why a load is outside the range of validity, as in the figure.
fn remark(at: &AtLoad) -> String {
    match at.exceeded.limits().next() {
        None => String::new(),
        Some(limit) => format!(" ({})", limit.name().replace('-', " ")),
    }
}

/// Effect of each law relative to the first, and the difference between the models under it.
fn law_by_law(page: &mut Page, results: &LawsResults, influence: &Influence, measure: Measure) {
    let what = match measure {
        Measure::Separation => "d/σ, as differences",
        Measure::Area => "real area, as ratios",
    };
    page.paragraph(&format!(
        "**Law by law, {what}**: largest deviation from {} in each model, and largest difference between the models under \
         the law itself, at the loads that are valid under every law.",
        escape(&influence.laws[0])
    ));
    let shown = |weight: Option<Effect>| {
        let text = |weight: Effect| {
            format!("{} at {}", signed(measure, weight.largest), input_quantity(weight.at, "Pa"))
        };
        weight.map_or_else(|| "-".to_owned(), text)
    };
    let row = |(index, law): (usize, &LawOnOne)| {
        let choice = |kind| {
            if index == 0 {
                "(reference)".to_owned()
            } else {
                shown(influence.of_choice(measure, index, kind))
            }
        };
        let errors = influence.of_standard_errors(measure, index);
        vec![
            law.law.clone(),
            choice(Kind::Statistical),
            choice(Kind::Deterministic),
            shown(influence.of_summation(measure, index)),
            errors.map_or_else(|| "-".to_owned(), |errors| number(errors.largest.abs())),
        ]
    };
    page.table(
        [
            "law",
            "integral, relative to reference",
            "sum, relative to reference",
            "integral, relative to sum",
            "largest in standard errors",
        ],
        results.laws.iter().enumerate().map(row),
    );
}
