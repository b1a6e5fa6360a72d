//! Why the models differ: the differences divided among their causes.
//!
//! | module | what it writes |
//! |---|---|
//! | `figure` | contributions over the load |
//! | `overview` | the leading causes over all surfaces, laws and thicknesses |

mod figure;
mod overview;

pub use figure::colour;
pub use overview::Overview;

use asperity::compare::{Cause, ComparedQuantity, Contributions, of_each_decade};
use asperity_framework::report::format::{listed, number, percent};
use asperity_framework::report::page::{Page, escape_around_code};

use super::axes::Units;
use super::verdict::{distance, loads, name, over, signed};
use crate::kind::compare::findings::Verdicts;

/// Why loads are not divided.
const FEW: &str = "fewer than 30 effective contacts carry the load, or one contact more than 10 % of it, so that the parts would be those of \
                   single asperities";

/// Loads per decade in the table.
const PER_DECADE: f64 = 2.0;

/// The quantities that are divided on the page.
const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

/// Why the models differ on one surface under one law, called `name`, under a heading of `level`. `stem` begins the
/// name of the figure's file.
pub fn section(page: &mut Page, level: u8, verdicts: &Verdicts, title: &str, stem: &str, units: &Units) {
    if verdicts.attribution.is_empty() {
        return;
    }
    page.heading(level, &format!("{title}: why do the models differ?"));
    let Some(sentence) = sentence(verdicts, units.sigma) else {
        page.paragraph(&format!("The differences are not divided among their causes: {FEW}."));
        return;
    };
    page.paragraph(&escape_around_code(&sentence));
    page.bullets(QUANTITIES.into_iter().filter_map(|quantity| over_loads(verdicts, quantity)));
    if verdicts.attribution.len() > 1 {
        page.figure(
            &format!("{stem}-causes.svg"),
            figure::figure(verdicts, units, &format!("{title}: {sentence}"))
                .headed(format!("{title}: causes of the difference, statistical − deterministic model")),
            &format!(
                "{title}: contributions to the difference of the statistical from the deterministic model at equal load, stacked from \
                 zero in both directions; the line is their sum, the difference. Grey: beyond the valid range."
            ),
        );
    }
    page.details(level + 1, &format!("{title}: contributions load by load"), |page| {
        for quantity in QUANTITIES {
            table(page, verdicts, quantity);
        }
        page.paragraph(&notes(verdicts));
    });
}

/// Why a difference has no parts.
pub fn undivided(page: &mut Page, level: u8, title: &str, reason: &str) {
    page.heading(level, &format!("{title}: why do the models differ?"));
    page.paragraph(&format!("The differences are not divided among their causes: {reason}."));
}

/// The contributions at the load in the middle of the valid range: "At 10 MPa the statistical model puts the flat 0.31 σ (15 nm) higher
/// than the sum: +0.24 σ from the height distribution, ...". `None` where no valid load is divided.
pub fn sentence(verdicts: &Verdicts, sigma: f64) -> Option<String> {
    let load = middle(verdicts)?;
    let parts = |quantity| {
        let found = verdicts.contributions(quantity, load)?;
        Some((found.gap(), each(quantity, found)))
    };
    let (gap, each) = parts(ComparedQuantity::Separation)?;
    let mut sentence = format!(
        "At {} the statistical model puts the flat {} {} than the sum: {}.",
        loads([load; 2]),
        distance(gap, sigma),
        if gap < 0.0 { "lower" } else { "higher" },
        each
    );
    if let Some((gap, each)) = parts(ComparedQuantity::Area) {
        sentence.push_str(&format!(
            " It gives {} {} real contact area: as factors, {each}.",
            percent(gap.exp_m1().abs()),
            if gap < 0.0 { "less" } else { "more" },
        ));
    }
    Some(sentence)
}

/// "+0.24 σ from the height distribution, +0.07 σ from ... and ...", the largest first.
fn each(quantity: ComparedQuantity, parts: &Contributions) -> String {
    let mut all = Cause::ALL.map(|cause| (cause, parts.of(cause)));
    all.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let clause =
        |(cause, part): &(Cause, f64)| format!("{} from the {}", signed(quantity, *part), cause.label());
    listed(&all.iter().map(clause).collect::<Vec<_>>())
}

/// The valid load nearest to the geometric middle of those that are divided.
fn middle(verdicts: &Verdicts) -> Option<f64> {
    let all: Vec<f64> = verdicts.divided(ComparedQuantity::Separation).map(|(load, _)| load.ln()).collect();
    let centre = 0.5 * (all.first()? + all.last()?);
    let nearest = all.into_iter().min_by(|a, b| (a - centre).abs().total_cmp(&(b - centre).abs()))?;
    verdicts.divided(ComparedQuantity::Separation).map(|(load, _)| load).find(|load| load.ln() == nearest)
}

/// Which cause leads at which loads, and where causes cancel each other.
fn over_loads(verdicts: &Verdicts, quantity: ComparedQuantity) -> Option<String> {
    /// Parts that add up to more than this many times the magnitude of their sum cancel each other.
    const CANCELLING: f64 = 3.0;
    let all: Vec<(f64, &Contributions)> = verdicts.divided(quantity).collect();
    let stretches = all.chunk_by(|a, b| a.1.leading() == b.1.leading());
    let clause = |stretch: &[(f64, &Contributions)]| {
        let range = over([stretch[0].0, stretch[stretch.len() - 1].0]);
        match stretch[0].1.leading() {
            Some(cause) => format!("the {} leads {range}", cause.label()),
            None => format!("no cause leads {range}"),
        }
    };
    let clauses: Vec<String> = stretches.map(clause).collect();
    let cancelling: Vec<f64> = all
        .iter()
        .filter(|(_, parts)| {
            let sum: f64 = Cause::ALL.into_iter().map(|cause| parts.of(cause).abs()).sum();
            sum > CANCELLING * parts.gap().abs()
        })
        .map(|(load, _)| *load)
        .collect();
    let cancels = match cancelling[..] {
        [] => String::new(),
        [first, ..] => format!(
            " {}the causes cancel each other: together they are more than {} times the difference.",
            match cancelling.len() {
                count if count == all.len() => "At all of these loads ".to_owned(),
                1 => format!("At {} ", loads([first; 2])),
                count => format!("At {count} of these {} loads ", all.len()),
            },
            number(CANCELLING)
        ),
    };
    (!clauses.is_empty()).then(|| format!("In {} {}.{cancels}", name(quantity), listed(&clauses)))
}

/// One row for some loads: the difference and its parts.
fn table(page: &mut Page, verdicts: &Verdicts, quantity: ComparedQuantity) {
    let all: Vec<(f64, &Contributions)> = verdicts.divided(quantity).collect();
    let rows = of_each_decade(all, |(load, _)| *load, PER_DECADE);
    if rows.is_empty() {
        return;
    }
    let has_reference = verdicts.reference.is_some();
    let mut header = vec![
        "load".to_owned(),
        match quantity {
            ComparedQuantity::Separation => "separation, statistical − deterministic".to_owned(),
            _ => format!("{}, statistical over deterministic", name(quantity)),
        },
    ];
    header.extend(Cause::ALL.map(|cause| cause.label().to_owned()));
    header.push("largest spread over the orders".to_owned());
    if has_reference {
        header.push("sum against the reference".to_owned());
    }
    let row = |(load, parts): &(f64, &Contributions)| {
        let part = |cause: Cause| {
            let estimate = parts.estimates[cause as usize];
            let interval = estimate.interval().map_or_else(String::new, |ends| {
                let [low, high] = ends.map(|end| signed(quantity, end));
                format!(" ({low} to {high})")
            });
            format!("{}{interval}", signed(quantity, estimate.contrast))
        };
        let width = |cause: Cause| parts.range(cause)[1] - parts.range(cause)[0];
        let spread = Cause::ALL.map(width).into_iter().fold(0.0, f64::max);
        let mut row = vec![loads([*load; 2]), signed(quantity, parts.gap())];
        row.extend(Cause::ALL.map(part));
        row.push(match quantity {
            ComparedQuantity::Separation => format!("{} σ", number(spread)),
            _ => percent(spread.exp_m1()),
        });
        if has_reference {
            let missed = verdicts.missed(quantity, *load);
            row.push(missed.map_or_else(|| "–".to_owned(), |missed| signed(quantity, missed.contrast)));
        }
        row
    };
    page.table(header, rows.iter().map(row));
}

/// What the parts rest on, and where there are none.
fn notes(verdicts: &Verdicts) -> String {
    let mut notes = "Separations in σ add up to the difference, areas multiply to the ratio. A contribution is the mean over three orders in which heights, radii \
                     and their correlation are changed from those of the statistical to those of the deterministic model; in brackets its 95 % \
                     interval, where one can be claimed."
        .to_owned();
    let without = verdicts.attribution.iter().filter(|at| at.quantities.iter().all(Option::is_none)).count();
    if without > 0 {
        notes.push_str(&format!(
            " At {without} of {} loads there are no parts: {}.",
            verdicts.attribution.len(),
            FEW
        ));
    }
    notes
}
