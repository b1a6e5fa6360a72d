//! Verdicts in a table.

use asperity::compare::{ComparedQuantity, Stretch, Verdict};
use asperity_framework::report::format::listed;
use asperity_framework::report::page::Page;

use super::words::{accepted, loads, name, need, signed, verdict};
use crate::kind::compare::findings::{LeadingCause, Verdicts};

/// One row per quantity and stretch of load; separations in units of `sigma` (m).
pub fn stretches(page: &mut Page, verdicts: &Verdicts, sigma: f64) {
    let row = |stretch: &Stretch| {
        vec![
            name(stretch.quantity).to_owned(),
            loads(stretch.loads),
            largest(stretch),
            format!("±{}", accepted(stretch, sigma)),
            if verdicts.is_blocked {
                format!("blocked ({})", verdict(stretch.verdict))
            } else {
                verdict(stretch.verdict).to_owned()
            },
            verdicts.cause(stretch).map_or("–", LeadingCause::label).to_owned(),
            // Where no load is valid, the need is that of one load, not of half of them.
            stretch.largest.map(|_| would_tell(stretch, verdicts)).unwrap_or_default(),
        ]
    };
    let header = [
        "quantity",
        "load",
        "largest difference (95 % interval)",
        "accepted",
        "verdict",
        "leading cause",
        "would tell (at half of the loads)",
    ];
    let order = [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness];
    let of = |compared| verdicts.stretches.iter().filter(move |stretch| stretch.quantity == compared);
    page.table(header, order.into_iter().flat_map(of).map(row));
}

/// What would tell, of a stretch that cannot be told.
fn would_tell(stretch: &Stretch, verdicts: &Verdicts) -> String {
    if stretch.verdict != Verdict::CannotTell {
        return String::new();
    }
    need(stretch, verdicts).unwrap_or_else(|| match stretch.bounds {
        Some(_) => "more than 100 times as much: the difference is about what is accepted".to_owned(),
        None => "–".to_owned(),
    })
}

/// "−7.9 % (−9.1 to −6.7 %) at 40 MPa".
fn largest(stretch: &Stretch) -> String {
    let Some((load, estimate)) = stretch.largest else { return "–".to_owned() };
    let interval = estimate.interval().map_or_else(
        || " (no interval)".to_owned(),
        |ends| {
            let [low, high] = ends.map(|end| signed(stretch.quantity, end));
            format!(" ({low} to {high})")
        },
    );
    format!("{}{interval} at {}", signed(stretch.quantity, estimate.contrast), loads([load; 2]))
}

/// The largest difference without its interval.
fn at_most(stretch: &Stretch) -> String {
    let largest = stretch.largest.map(|(_, estimate)| signed(stretch.quantity, estimate.contrast));
    largest.unwrap_or_else(|| "–".to_owned())
}

/// The valid stretches of load.
fn valid_loads(verdicts: &Verdicts) -> String {
    let each: Vec<String> = verdicts.valid.stretches.iter().map(|&stretch| loads(stretch)).collect();
    if each.is_empty() { "no load".to_owned() } else { listed(&each) }
}

/// One row per case, named by `what`: a thickness of a layer, or a law.
pub fn by_case(page: &mut Page, what: &str, all: &[(String, &Verdicts)]) {
    let cell = |verdicts: &Verdicts, compared: ComparedQuantity| {
        let of = verdicts.stretches.iter().filter(|stretch| stretch.quantity == compared);
        let each: Vec<String> = of
            .map(|stretch| {
                let blocked = if verdicts.is_blocked { "blocked: " } else { "" };
                let cause = verdicts.cause(stretch).map(|cause| format!(", {}", cause.label()));
                format!(
                    "{blocked}{} {} ({}{})",
                    verdict(stretch.verdict),
                    loads(stretch.loads),
                    at_most(stretch),
                    cause.unwrap_or_default()
                )
            })
            .collect();
        if each.is_empty() { "–".to_owned() } else { each.join("; ") }
    };
    let row = |(name, verdicts): &(String, &Verdicts)| {
        let mut row = vec![name.clone(), valid_loads(verdicts)];
        row.extend(
            [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness]
                .map(|compared| cell(verdicts, compared)),
        );
        row
    };
    page.table([what, "valid for", "real contact area", "separation", "stiffness"], all.iter().map(row));
}
