//! Which statistical model is near enough to the sum and to the reference, and what each costs.

use asperity::compare::{Accepted, ComparedQuantity};
use asperity_framework::report::format::{capitalised, count, listed, number, percent};
use asperity_framework::report::page::{Page, escape};

use super::verdict::{loads, name, signed};
use crate::kind::compare::ranking::{Against, Largest, Ranked, Ranking, is_within};

/// The quantities that models are ranked in.
const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Area, ComparedQuantity::Separation];

fn label(against: Against) -> &'static str {
    match against {
        Against::Sum => "the sum",
        Against::Reference => "the reference",
    }
}

/// The ranking of one surface under one law, called `title`.
pub fn section(page: &mut Page, ranking: &Ranking, accepted: &Accepted, title: &str, alpha: Option<f64>) {
    let [Some(first), Some(last)] = [ranking.loads.first(), ranking.loads.last()] else { return };
    page.heading(3, &format!("{title}: which statistical model is enough"));
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
    page.table(header, ranking.models.iter().map(row).chain(sum));
    let bandwidth =
        alpha.map_or_else(String::new, |alpha| format!("Nayak's α of the map is {}. ", number(alpha)));
    let missing: Vec<String> = ranking
        .inapplicable
        .iter()
        .map(|(model, reason)| format!("{} ({})", escape(&model.name()), escape(reason)))
        .collect();
    let missing =
        if missing.is_empty() { String::new() } else { format!(" Not applicable: {}.", listed(&missing)) };
    page.paragraph(&format!(
        "{bandwidth}A model is named by its heights and its mean radius. Each difference is the largest in magnitude over {} valid loads \
         from {}, on this very surface, without sampling error; ✓: within what is accepted. Contacts per load: micro-contacts \
         evaluated, the search for the separation included.{missing}",
        ranking.loads.len(),
        loads([*first, *last]),
    ));
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
