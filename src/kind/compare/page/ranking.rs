//! Which statistical model is near enough to the sum and to the reference, and what each costs.

use asperity::compare::{Accepted, ComparedQuantity};
use asperity_framework::report::format::{count, listed, number};
use asperity_framework::report::page::{Page, escape};

use super::verdict::{loads, name, signed};
use crate::kind::compare::ranking::{Largest, Ranked, Ranking};

/// The quantities that models are ranked in.
const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Area, ComparedQuantity::Separation];

/// What a model is compared with.
#[derive(Clone, Copy, PartialEq)]
enum Against {
    Sum,
    Reference,
}

impl Against {
    fn label(self) -> &'static str {
        match self {
            Self::Sum => "the sum",
            Self::Reference => "the reference",
        }
    }

    fn of(self, ranked: &Ranked, quantity: ComparedQuantity) -> Largest {
        match self {
            Self::Sum => ranked.from_sum[quantity as usize],
            Self::Reference => ranked.from_reference[quantity as usize],
        }
    }
}

/// The ranking of one surface under one law, called `title`.
pub fn section(page: &mut Page, ranking: &Ranking, accepted: &Accepted, title: &str, alpha: Option<f64>) {
    if ranking.loads.is_empty() || ranking.models.is_empty() {
        return;
    }
    page.heading(3, &format!("{title}: other statistical models"));
    let has_reference = ranking.models.iter().any(|ranked| ranked.from_reference.iter().any(Option::is_some));
    let against = if has_reference { vec![Against::Sum, Against::Reference] } else { vec![Against::Sum] };
    page.bullets(against.iter().flat_map(|&against| {
        QUANTITIES.map(|quantity| statement(ranking, accepted, against, quantity))
    }));
    let mut header = vec!["statistical model".to_owned()];
    for against in &against {
        header.extend(QUANTITIES.map(|quantity| format!("{} from {}", name(quantity), against.label())));
    }
    header.push("contacts per load".to_owned());
    let row = |ranked: &Ranked| {
        let mut row = vec![escape(&ranked.candidate.name())];
        for against in &against {
            row.extend(QUANTITIES.map(|quantity| {
                let largest = against.of(ranked, quantity);
                largest.map_or_else(|| "–".to_owned(), |(contrast, load)| {
                    let mark = if is_within(accepted, quantity, contrast) { " ✓" } else { "" };
                    format!("{} at {}{mark}", signed(quantity, contrast), loads([load; 2]))
                })
            }));
        }
        row.push(count(ranked.evaluations.round() as usize));
        row
    };
    page.table(header, ranking.models.iter().map(row));
    let bandwidth = alpha.map_or_else(String::new, |alpha| format!("Nayak's α of the map is {}. ", number(alpha)));
    let missing: Vec<String> = ranking
        .inapplicable
        .iter()
        .map(|(candidate, reason)| format!("{} ({})", escape(&candidate.name()), escape(reason)))
        .collect();
    let missing = if missing.is_empty() { String::new() } else { format!(" Not applicable: {}.", listed(&missing)) };
    page.paragraph(&format!(
        "{bandwidth}Largest difference over {} loads from {}, on the first realisation; ✓: within what is accepted. Contacts per load: those evaluated \
         with the search for the separation.{missing}",
        ranking.loads.len(),
        loads([ranking.loads[0], ranking.loads[ranking.loads.len() - 1]]),
    ));
}

fn is_within(accepted: &Accepted, quantity: ComparedQuantity, contrast: f64) -> bool {
    quantity.reported(contrast).abs() <= accepted.of(quantity)
}

/// The cheapest model within what is accepted, or the nearest one where none is.
fn statement(ranking: &Ranking, accepted: &Accepted, against: Against, quantity: ComparedQuantity) -> String {
    let found = |ranked: &&Ranked| against.of(ranked, quantity).is_some();
    let size = |ranked: &Ranked| against.of(ranked, quantity).map_or(f64::INFINITY, |(contrast, _)| quantity.reported(contrast).abs());
    let within: Vec<&Ranked> =
        ranking.models.iter().filter(found).filter(|ranked| size(ranked) <= accepted.of(quantity)).collect();
    let cheapest = within.iter().min_by(|a, b| a.evaluations.total_cmp(&b.evaluations));
    let nearest = ranking.models.iter().filter(found).min_by(|a, b| size(a).total_cmp(&size(b)));
    let shown = |ranked: &Ranked| {
        let largest = against.of(ranked, quantity).map_or_else(String::new, |(contrast, _)| signed(quantity, contrast));
        format!("{} ({largest} at most)", escape(&ranked.candidate.name()))
    };
    let label = against.label();
    match (cheapest, nearest) {
        (Some(cheapest), Some(nearest)) => format!(
            "In {}, {} of {} statistical models are within what is accepted of {label}; the cheapest is {}, the nearest {}.",
            name(quantity),
            within.len(),
            ranking.models.len(),
            shown(cheapest),
            shown(nearest)
        ),
        (None, Some(nearest)) => format!(
            "In {}, none of {} statistical models is within what is accepted of {label}; the nearest is {}.",
            name(quantity),
            ranking.models.len(),
            shown(nearest)
        ),
        _ => format!("In {}, no model is compared with {label}.", name(quantity)),
    }
}
