//! Both models against the reference, in words and in a table.

use asperity::compare::{ComparedQuantity, Estimate, Kind, NearerStretch, Verdict};
use asperity_framework::report::format::{listed, number, percent};
use asperity_framework::report::page::Page;

use super::words::{loads, name, over, signed};
use crate::kind::compare::findings::{ReferenceVerdicts, Verdicts};

/// The order in which quantities are spoken of.
const ORDER: [ComparedQuantity; 3] =
    [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness];

/// A model as sentences name it.
fn model(kind: Kind) -> &'static str {
    match kind {
        Kind::Statistical => "the statistical model",
        Kind::Deterministic => "the sum",
    }
}

fn decades(loads: [f64; 2]) -> f64 {
    (loads[1] / loads[0]).ln()
}

/// Which model is nearer to the reference, in one sentence: of each quantity its widest stretch of load with an answer, or
/// the widest where there is none. `None` where no reference was compared at a valid load.
pub fn nearer_sentence(verdicts: &Verdicts) -> Option<String> {
    let reference = verdicts.reference.as_ref()?;
    let widest = |quantity: ComparedQuantity| {
        let of = reference.nearer.iter().filter(move |stretch| stretch.quantity == quantity);
        let rank = |stretch: &NearerStretch| (stretch.nearer.is_some(), decades(stretch.loads));
        of.max_by(|a, b| {
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    };
    let main: Vec<&NearerStretch> = ORDER.into_iter().filter_map(widest).collect();
    if main.is_empty() {
        return None;
    }
    let (told, open): (Vec<&NearerStretch>, Vec<&NearerStretch>) =
        main.into_iter().partition(|stretch| stretch.nearer.is_some());
    let mut sentence = String::new();
    if !told.is_empty() {
        let clauses: Vec<String> = told.iter().filter_map(|stretch| clause(stretch)).collect();
        sentence = format!("Nearer to the reference: {}.", clauses.join("; "));
    }
    if !open.is_empty() {
        let space = if sentence.is_empty() { "" } else { " " };
        let names: Vec<String> = open.iter().map(|stretch| open_clause(stretch)).collect();
        sentence.push_str(&format!(
            "{space}Which model is nearer to the reference cannot be told in {}.",
            listed(&names)
        ));
    }
    Some(sentence)
}

/// "in real contact area from 1 to 20 MPa the statistical model (−9 %; the sum −40 %)".
fn clause(stretch: &NearerStretch) -> Option<String> {
    let nearer = stretch.nearer?;
    let (near, far) = match nearer {
        Kind::Statistical => (0, 1),
        Kind::Deterministic => (1, 0),
    };
    let other = [Kind::Statistical, Kind::Deterministic][far];
    let at = |model: usize| signed(stretch.quantity, stretch.largest[model].1.contrast);
    let end = match stretch.verdicts {
        [Verdict::Within, Verdict::Within] => ", both within what is accepted",
        [Verdict::Beyond, Verdict::Beyond] => ", neither within what is accepted",
        verdicts if verdicts[near] == Verdict::Within => ", within what is accepted",
        verdicts if verdicts[near] == Verdict::Beyond => ", beyond what is accepted",
        _ => "",
    };
    Some(format!(
        "in {} {} {} ({}; {} {}){end}",
        name(stretch.quantity),
        over(stretch.loads),
        model(nearer),
        at(near),
        model(other),
        at(far),
    ))
}

/// "stiffness at 1 MPa (statistical model −3 %, sum −5 %)".
fn open_clause(stretch: &NearerStretch) -> String {
    let at = |model: usize| signed(stretch.quantity, stretch.largest[model].1.contrast);
    format!("{} {} (statistical model {}, sum {})", name(stretch.quantity), over(stretch.loads), at(0), at(1))
}

/// One row per quantity and stretch of load at which both models stand alike.
pub fn nearer(page: &mut Page, verdicts: &Verdicts, reference: &ReferenceVerdicts) {
    let largest = |quantity: ComparedQuantity, (load, estimate): (f64, Estimate)| {
        let interval = estimate.interval().map_or_else(
            || " (no interval)".to_owned(),
            |ends| {
                let [low, high] = ends.map(|end| signed(quantity, end));
                format!(" ({low} to {high})")
            },
        );
        format!("{}{interval} at {}", signed(quantity, estimate.contrast), loads([load; 2]))
    };
    let verdict = |verdict: Verdict| match verdict {
        Verdict::Within => "within",
        Verdict::Beyond => "beyond",
        Verdict::CannotTell => "cannot tell",
    };
    let row = |stretch: &NearerStretch| {
        let nearer = match stretch.nearer {
            Some(Kind::Statistical) => "statistical",
            Some(Kind::Deterministic) => "sum",
            None => "cannot tell",
        };
        let blocked = if verdicts.is_blocked { "blocked: " } else { "" };
        vec![
            name(stretch.quantity).to_owned(),
            loads(stretch.loads),
            largest(stretch.quantity, stretch.largest[0]),
            verdict(stretch.verdicts[0]).to_owned(),
            largest(stretch.quantity, stretch.largest[1]),
            verdict(stretch.verdicts[1]).to_owned(),
            format!("{blocked}{nearer}"),
        ]
    };
    let of = |quantity| reference.nearer.iter().filter(move |stretch| stretch.quantity == quantity);
    page.table(
        [
            "quantity",
            "load",
            "statistical − reference (95 %)",
            "verdict",
            "sum − reference (95 %)",
            "verdict",
            "nearer",
        ],
        ORDER.into_iter().flat_map(of).map(row),
    );
}

/// What the sum misses of the reference at its lightest and heaviest valid load, with Nayak's `alpha` of the map.
pub fn misses(reference: &ReferenceVerdicts, alpha: Option<f64>) -> Option<String> {
    let valid = || reference.against.models[1].iter().filter(|at| at.exceeded().is_none());
    let (first, last) = (valid().next()?, valid().last()?);
    let of = |at: &asperity::compare::Difference| {
        let contrast = |quantity: ComparedQuantity| at.estimates[quantity as usize].map(|one| one.contrast);
        let parts: Vec<String> = [
            contrast(ComparedQuantity::Separation)
                .map(|h| format!("{} of separation", signed(ComparedQuantity::Separation, h))),
            contrast(ComparedQuantity::Area)
                .map(|log| format!("{} in ln(A) ({})", signed_number(log), percent(log.exp_m1().abs()))),
        ]
        .into_iter()
        .flatten()
        .collect();
        format!("{} at {}", listed(&parts), loads([at.load; 2]))
    };
    let what = if reference.includes_plasticity {
        "interaction, geometry and plasticity"
    } else {
        "interaction and geometry"
    };
    let values = if first.load == last.load { of(first) } else { format!("{}, {}", of(first), of(last)) };
    let alpha = alpha.map_or_else(String::new, |alpha| format!(" Nayak's α of the map: {}.", number(alpha)));
    Some(format!("What the sum misses ({what}; sum minus reference): {values}.{alpha}"))
}

fn signed_number(value: f64) -> String {
    let sign = if value < 0.0 { "−" } else { "+" };
    format!("{sign}{}", number(value.abs()))
}
