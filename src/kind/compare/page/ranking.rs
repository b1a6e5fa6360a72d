//! Which statistical model is near enough to the sum and to the reference, and what each costs.

use asperity::compare::{Accepted, ComparedQuantity};
use asperity_framework::report::format::{capitalised, count, listed, number, percent};
use asperity_framework::report::page::{Page, escape};

use super::verdict::{loads, name, signed};
use crate::kind::compare::ranking::{Against, Largest, Ranked, Ranking, Standing, is_within};
use crate::kind::compare::results::CompareResults;
use crate::kind::compare::statistical::StatisticalModel;

/// The quantities that models are ranked in.
const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Area, ComparedQuantity::Separation];

fn label(against: Against) -> &'static str {
    match against {
        Against::Sum => "the sum",
        Against::Reference => "the reference",
    }
}

/// Over several surfaces and laws: the models that are most often within what is accepted, and how often that of Zhao et al. is.
/// `None` where there are not several on maps that are fit.
pub fn over_all(results: &CompareResults) -> Option<String> {
    let cases = results.surfaces.iter().flat_map(|found| found.findings.cases.iter().zip(&found.rankings));
    let all: Vec<(Accepted, &Ranking)> = cases
        .filter(|(findings, ranking)| !findings.verdicts.is_blocked && !ranking.loads.is_empty())
        .map(|(findings, ranking)| (findings.verdicts.accepted, ranking))
        .collect();
    if all.len() < 2 {
        return None;
    }
    let clause = |against: Against, quantity: ComparedQuantity| {
        let compared: Vec<Standing> = all
            .iter()
            .map(|(accepted, ranking)| ranking.standing(against, quantity, accepted))
            .filter(|standing| !standing.compared.is_empty())
            .collect();
        let models = StatisticalModel::all();
        let within = |model: &StatisticalModel| {
            let is_there =
                |standing: &&Standing| standing.within.iter().any(|(ranked, _)| ranked.model == *model);
            compared.iter().filter(is_there).count()
        };
        let most = models.iter().map(within).max().filter(|&most| most > 0)?;
        let best: Vec<String> =
            models.iter().filter(|model| within(model) == most).map(StatisticalModel::name).collect();
        Some(format!(
            "in {} most often {} ({most} of {} cases, the model of Zhao et al. in {})",
            name(quantity),
            named(&best),
            compared.len(),
            within(&models[0]),
        ))
    };
    let sentence = |against: Against| {
        let clauses: Vec<String> =
            QUANTITIES.into_iter().filter_map(|quantity| clause(against, quantity)).collect();
        (!clauses.is_empty()).then(|| {
            format!(
                "Within what is accepted of {} at all valid loads: {}.",
                label(against),
                clauses.join("; ")
            )
        })
    };
    let sentences: Vec<String> =
        [Against::Sum, Against::Reference].into_iter().filter_map(sentence).collect();
    (!sentences.is_empty()).then(|| {
        format!(
            "{} A model is named by its heights and its mean radius; that of Zhao et al. (2000) is `{}`.",
            sentences.join(" "),
            StatisticalModel::all()[0].name()
        )
    })
}

/// "`a` and `b`", or the first and how many others there are.
fn named(models: &[String]) -> String {
    const MOST: usize = 3;
    match models {
        [first, others @ ..] if models.len() > MOST => format!("`{first}` and {} others", others.len()),
        _ => listed(&models.iter().map(|model| format!("`{model}`")).collect::<Vec<_>>()),
    }
}

/// The ranking of one surface under one law, called `title`.
pub fn section(
    page: &mut Page,
    level: u8,
    ranking: &Ranking,
    accepted: &Accepted,
    title: &str,
    alpha: Option<f64>,
) {
    let [Some(first), Some(last)] = [ranking.loads.first(), ranking.loads.last()] else { return };
    page.heading(level, &format!("{title}: which statistical model is enough?"));
    let against = ranking.against();
    let statements = against.iter().flat_map(|&against| QUANTITIES.map(|quantity| (against, quantity)));
    page.bullets(statements.map(|(against, quantity)| statement(ranking, accepted, against, quantity)));
    let mut header = vec!["model".to_owned()];
    for &against in against {
        header.extend(QUANTITIES.map(|quantity| format!("{} − {}", name(quantity), label(against))));
    }
    header.push("contacts per load".to_owned());
    let cell = |quantity: ComparedQuantity, largest: Largest| {
        largest.map_or_else(
            || "–".to_owned(),
            |(contrast, load)| {
                let mark = if is_within(accepted, quantity, contrast) { " ✓" } else { "" };
                format!("{} at {}{mark}", signed(quantity, contrast), loads([load; 2]))
            },
        )
    };
    let row = |ranked: &Ranked| {
        let mut row = vec![escape(&ranked.model.name())];
        for &against in against {
            row.extend(QUANTITIES.map(|quantity| cell(quantity, ranked.largest(against, quantity))));
        }
        row.push(count(ranked.evaluations.round() as usize));
        row
    };
    let sum = against.contains(&Against::Reference).then(|| {
        let mut row = vec!["sum of the asperities".to_owned()];
        row.extend(QUANTITIES.map(|_| "–".to_owned()));
        row.extend(QUANTITIES.map(|quantity| cell(quantity, ranking.sum_from_reference[quantity as usize])));
        row.push("–".to_owned());
        row
    });
    let size = |ranked: &Ranked| {
        let largest = ranked.largest(Against::Sum, QUANTITIES[0]);
        largest.map_or(f64::INFINITY, |(contrast, _)| QUANTITIES[0].reported(contrast).abs())
    };
    let mut models: Vec<&Ranked> = ranking.models.iter().collect();
    models.sort_by(|a, b| size(a).total_cmp(&size(b)));
    let bandwidth =
        alpha.map_or_else(String::new, |alpha| format!("Nayak's α of the map is {}. ", number(alpha)));
    let missing: Vec<String> = ranking
        .inapplicable
        .iter()
        .map(|(model, reason)| format!("{} ({})", escape(&model.name()), escape(reason)))
        .collect();
    let missing =
        if missing.is_empty() { String::new() } else { format!(" Not applicable: {}.", listed(&missing)) };
    page.details(level + 1, &format!("{title}: statistical models compared"), |page| {
        page.table(header, models.into_iter().map(row).chain(sum));
        page.paragraph(&format!(
            "{bandwidth}A model is named by its heights and its mean radius; in the order of the difference in area from the sum. Each difference is the largest in magnitude over {} valid loads \
             from {}, on this very surface, without sampling error; ✓: within what is accepted. Contacts per load: micro-contacts \
             evaluated, the search for the separation included.{missing}",
            ranking.loads.len(),
            loads([*first, *last]),
        ));
    });
}

/// How many models are within what is accepted, the cheapest of them, and the nearest of all.
fn statement(ranking: &Ranking, accepted: &Accepted, against: Against, quantity: ComparedQuantity) -> String {
    let about = format!("**{} from {}**", capitalised(name(quantity)), label(against));
    let standing = ranking.standing(against, quantity, accepted);
    let shown = |(ranked, contrast): (&Ranked, f64)| {
        format!("{} ({})", escape(&ranked.model.name()), signed(quantity, contrast))
    };
    let Some(nearest) = standing.nearest() else {
        return format!("{about}: no model is compared.");
    };
    let limit = match quantity {
        ComparedQuantity::Separation => format!("{} σ", number(accepted.of(quantity))),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => percent(accepted.of(quantity)),
    };
    let sum = ranking.sum_from_reference[quantity as usize].filter(|_| against == Against::Reference);
    let sum =
        sum.map_or_else(String::new, |(contrast, _)| format!("; the sum has {}", signed(quantity, contrast)));
    match standing.cheapest() {
        Some(cheapest) => format!(
            "{about}: {} of {} statistical models {} within ±{limit}; the cheapest {}{sum}.",
            standing.within.len(),
            standing.compared.len(),
            if standing.within.len() == 1 { "stays" } else { "stay" },
            if cheapest.0.model == nearest.0.model {
                format!("and nearest is {}", shown(nearest))
            } else {
                format!("is {}, the nearest {}", shown(cheapest), shown(nearest))
            }
        ),
        None => format!(
            "{about}: none of {} statistical models stays within ±{limit}; the nearest is {}{sum}.",
            standing.compared.len(),
            shown(nearest)
        ),
    }
}
