//! Verdicts in a table.

use asperity::compare::{ComparedQuantity, Stretch, Verdict};
use asperity_framework::report::format::listed;
use asperity_framework::report::page::Page;

use super::words::{accepted, loads, name, need, over, signed, verdict};
use crate::kind::compare::findings::{LeadingCause, Verdicts};

/// One row per quantity and stretch of load; separations in units of `sigma` (m).
pub fn stretches(page: &mut Page, verdicts: &Verdicts, sigma: f64) {
    let row = |stretch: &Stretch| {
        vec![
            name(stretch.quantity).to_owned(),
            if verdicts.is_blocked {
                format!("blocked ({})", verdict(stretch.verdict))
            } else {
                verdict(stretch.verdict).to_owned()
            },
            loads(stretch.loads),
            largest(stretch),
            format!("±{}", accepted(stretch, sigma)),
            verdicts.cause(stretch).map_or("–", LeadingCause::label).to_owned(),
        ]
    };
    let header =
        ["quantity", "verdict", "load", "largest difference (95 % interval)", "accepted", "leading cause"];
    let order = [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness];
    let of = |compared| verdicts.stretches.iter().filter(move |stretch| stretch.quantity == compared);
    page.table(header, order.into_iter().flat_map(of).map(row));
}

/// What would tell of the stretches that cannot be told, a line for each need; nothing where there are none.
pub fn would_tell(verdicts: &Verdicts) -> Vec<String> {
    let mut needs: Vec<(String, Vec<String>)> = Vec::new();
    let open = |stretch: &&Stretch| stretch.verdict == Verdict::CannotTell && stretch.largest.is_some();
    for stretch in verdicts.stretches.iter().filter(open) {
        let what = format!("{} {}", name(stretch.quantity), over(stretch.loads));
        let need = need(stretch, verdicts);
        let need = need.or_else(|| stretch.bounds.map(|_| TOO_CLOSE.to_owned()));
        let Some(need) = need else { continue };
        match needs.iter_mut().find(|(known, _)| *known == need) {
            Some((_, all)) => all.push(what),
            None => needs.push((need, vec![what])),
        }
    }
    let line = |(need, all): (String, Vec<String>)| {
        format!("To tell at half of the loads, in {}: {need}.", listed(&all))
    };
    needs.into_iter().map(line).collect()
}

/// The need of a stretch whose difference is that which is accepted.
const TOO_CLOSE: &str = "more than 100 times as much surface, since the difference is about what is accepted";

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
