//! The leading causes over all surfaces, laws and thicknesses.

use asperity::compare::{Cause, ComparedQuantity, Contributions, Verdict};
use asperity_framework::report::format::{listed, percent};
use asperity_framework::report::page::Page;

use super::{QUANTITIES, middle};
use crate::kind::compare::page::verdict::{Case, loads, name, signed};

/// Up to so many cases the names are given of those that a cause leads on; of more, how many they are.
const MOST_NAMES: usize = 6;

/// The contributions to the difference in several cases, each at the middle of its valid loads.
pub struct Overview<'a> {
    rows: Vec<Row<'a>>,
}

struct Row<'a> {
    case: &'a Case<'a>,
    load: f64,
    /// In the order of [`QUANTITIES`].
    parts: [&'a Contributions; 2],
}

impl<'a> Overview<'a> {
    /// Of those cases whose difference is divided at a valid load; `None` where there are not several.
    pub fn of(all: &'a [Case<'a>]) -> Option<Self> {
        let row = |case: &'a Case<'a>| {
            let load = middle(case.verdicts)?;
            let of = |quantity| case.verdicts.contributions(quantity, load);
            Some(Row { case, load, parts: [of(QUANTITIES[0])?, of(QUANTITIES[1])?] })
        };
        let rows: Vec<Row> = all.iter().filter_map(row).collect();
        (rows.len() > 1).then_some(Self { rows })
    }

    /// How often which cause leads, and what the spread of radii comes to; with Pasaribu and Schipper's statement beside it where the
    /// statistical model `is_of_paper`, with Gaussian heights and the arithmetic mean radius.
    pub fn sentence(&self, is_of_paper: bool) -> String {
        let beyond = QUANTITIES.map(|quantity| {
            let is_beyond = |row: &&Row| {
                let of = &row.case.verdicts.stretches;
                of.iter().any(|one| one.quantity == quantity && one.verdict == Verdict::Beyond)
            };
            format!("{} in {}", self.rows.iter().filter(is_beyond).count(), name(quantity))
        });
        let leading = [0, 1].map(|index| {
            let of = |cause: Option<Cause>| {
                let led = self.rows.iter().filter(|row| row.parts[index].leading() == cause);
                let names: Vec<String> = led.map(|row| row.case.name.clone()).collect();
                let cause = cause.map_or("no cause".to_owned(), |cause| format!("the {}", cause.label()));
                match names.len() {
                    0 => None,
                    count if self.rows.len() > MOST_NAMES => {
                        Some(format!("{cause} leads on {count} of them"))
                    }
                    _ => Some(format!("{cause} leads on {}", listed(&names))),
                }
            };
            let clauses: Vec<String> =
                Cause::ALL.map(Some).into_iter().chain([None]).filter_map(of).collect();
            format!("in {} {}", name(QUANTITIES[index]), clauses.join(", "))
        });
        let of_radii = [0, 1].map(|index| {
            let shares = || self.rows.iter().map(|row| row.parts[index].share(Cause::Radii));
            let ends = [shares().fold(f64::INFINITY, f64::min), shares().fold(0.0, f64::max)];
            format!("{} to {} in {}", percent(ends[0]), percent(ends[1]), name(QUANTITIES[index]))
        });
        let paper = if is_of_paper {
            "Pasaribu and Schipper (2005) find a significant difference and give the different radii of the asperities as its cause. "
        } else {
            ""
        };
        let blocked = match self.rows.iter().filter(|row| row.case.verdicts.is_blocked).count() {
            0 => String::new(),
            count => format!(" ({count} on maps that fail a fitness check)"),
        };
        format!(
            "of {} cases with valid loads{blocked} the difference is beyond what is accepted at some of them, beyond its sampling error, \
             in {}. At the middle of the valid loads, {}. {paper}Of the contributions, taken by magnitude, the spread of radii has {}.",
            self.rows.len(),
            listed(&beyond),
            leading.join("; "),
            listed(&of_radii),
        )
    }

    /// One row per case and quantity.
    pub fn section(&self, page: &mut Page) {
        page.heading(2, "Why do the models differ?");
        let has_reference = self.rows.iter().any(|row| row.case.verdicts.reference.is_some());
        let mut header = vec![
            "case".to_owned(),
            "load".to_owned(),
            "quantity".to_owned(),
            "statistical − deterministic".to_owned(),
        ];
        header.extend(Cause::ALL.map(|cause| cause.label().to_owned()));
        header.push("leading cause".to_owned());
        if has_reference {
            header.push("sum against the reference".to_owned());
        }
        let of_quantity = |row: &Row, index: usize| {
            let (quantity, parts) = (QUANTITIES[index], row.parts[index]);
            let mut cells = vec![
                named(row.case),
                loads([row.load; 2]),
                name(quantity).to_owned(),
                signed(quantity, parts.gap()),
            ];
            cells.extend(Cause::ALL.map(|cause| signed(quantity, parts.of(cause))));
            cells.push(parts.leading().map_or("none", Cause::label).to_owned());
            if has_reference {
                cells.push(missed(row, quantity));
            }
            cells
        };
        page.table(header, self.rows.iter().flat_map(|row| [0, 1].map(|index| of_quantity(row, index))));
        page.paragraph(
            "At the valid load nearest to the middle of the valid range on a logarithmic scale. Separations in σ add up, areas multiply. The \
             leading cause is the largest contribution in the direction of the difference, where its 95 % interval lies beyond zero and beyond \
             the intervals of the others.",
        );
    }
}

/// The name of a case, and whether its map is fit.
fn named(case: &Case) -> String {
    if case.verdicts.is_blocked { format!("{} (not fit)", case.name) } else { case.name.clone() }
}

/// What the sum misses of the reference, at the load of the reference nearest to that of the row.
fn missed(row: &Row, quantity: ComparedQuantity) -> String {
    let none = || "–".to_owned();
    let Some(reference) = &row.case.verdicts.reference else { return none() };
    let valid = reference.against.models[1].iter().filter(|at| at.exceeded().is_none());
    let away = |load: f64| (load / row.load).ln().abs();
    let nearest = valid.min_by(|a, b| away(a.load).total_cmp(&away(b.load)));
    let shown = nearest.and_then(|at| {
        let estimate = at.estimates[quantity as usize]?;
        Some(format!("{} at {}", signed(quantity, estimate.contrast), loads([at.load; 2])))
    });
    shown.unwrap_or_else(none)
}
