//! What makes a load inadmissible, and what to do about it.

use asperity::compare::{AdmissibleRange, Difference};
use asperity::study::{CaseStudy, Treatment};
use asperity::{INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_contact_framework::report::format::{input_quantity, listed, number, percent, quantity};

use super::replace::stretch;
use super::{Card, nominal_area};

/// "12 effective contacts (at least 30)": the limits that are exceeded at a load, those of neither model alone where there are such.
pub(super) fn exceeded_words(at: &Difference) -> String {
    let all: Vec<Limit> = at.exceeded().limits().collect();
    let of_neither: Vec<Limit> = all.iter().copied().filter(|limit| !is_of_few(*limit)).collect();
    let named = if of_neither.is_empty() { all } else { of_neither };
    listed(&named.into_iter().map(|limit| words(limit, at)).collect::<Vec<_>>())
}

fn words(limit: Limit, at: &Difference) -> String {
    let sharing = at.sharing.as_ref();
    match limit {
        // Below the limit also as a reader sees it.
        Limit::FewContacts => {
            let contacts = sharing.map_or(0.0, |one| one.effective_contacts.min(MIN_CONTACTS - 0.1));
            let plural = if number(contacts) == "1" { "" } else { "s" };
            format!("{} effective contact{plural} (at least {MIN_CONTACTS})", number(contacts))
        }
        Limit::DominantContact => {
            let share = sharing.map_or(1.0, |one| one.largest_share);
            format!("{} of the load in one contact (at most {})", percent(share), percent(LARGEST_LOAD_SHARE))
        }
        Limit::Interaction => {
            format!(
                "contact area {} of the nominal (at most {})",
                percent(at.area_ratio),
                percent(INTERACTION)
            )
        }
        Limit::LargeStrain => {
            let share = sharing.map_or(1.0, |one| one.large_strain_share);
            format!(
                "{} of the load at a/R above 0.3 (at most {})",
                percent(share),
                percent(LARGE_STRAIN_SHARE)
            )
        }
    }
}

/// Whether more surface lifts a limit.
fn is_of_few(limit: Limit) -> bool {
    matches!(limit, Limit::FewContacts | Limit::DominantContact)
}

/// Whether contacts strain too much, for boundary elements too, which take slopes as small.
pub(super) fn is_steep(at: &Difference) -> bool {
    at.exceeded().limits().any(|limit| limit == Limit::LargeStrain)
}

impl Card<'_> {
    /// What to do where asperities strain or interact: boundary elements where they only interact, lower loads, or an S filter.
    pub(super) fn remedies(&self, at: &Difference) -> Vec<String> {
        let first = match &self.case.first().reference {
            Some(curve) if curve.unreached.contains(&at.load) => {
                Some("a load that the surface can bear: check it, its area and their units")
            }
            _ if is_steep(at) || self.leaves_yielding_out() => None,
            Some(_) => Some("boundary elements"),
            None if !self.can_be_pressed() => None,
            None => {
                Some("boundary elements (`models = [\"statistical\", \"deterministic\", \"reference\"]`)")
            }
        };
        let mut ways: Vec<String> = first.into_iter().map(str::to_owned).collect();
        let admissible = self.verdicts().admissible.stretches.iter();
        let lower = admissible.map(|stretch| stretch[1]).filter(|load| *load < at.load);
        if let Some(load) = lower.max_by(f64::total_cmp) {
            ways.push(format!("loads of at most {}", input_quantity(load, "Pa")));
        }
        ways.extend(filtered(self.case, at.load));
        if ways.is_empty() {
            let why = if is_steep(at) {
                "contacts are too wide for their asperities, for boundary elements too"
            } else {
                "asperities interact, and boundary elements stay elastic while contacts yield"
            };
            ways.push(format!("nothing here: {why}"));
        }
        ways
    }

    /// More surface, or a higher load, where contacts are too few.
    pub(super) fn more_contacts(&self, at: &Difference) -> Vec<String> {
        let verdicts = self.verdicts();
        let contacts = at.sharing.as_ref().map(|sharing| {
            let factors = at.exceeded().limits().map(|limit| match limit {
                Limit::FewContacts => MIN_CONTACTS / sharing.effective_contacts,
                _ => sharing.largest_share / LARGEST_LOAD_SHARE,
            });
            verdicts.area * factors.fold(1.0, f64::max)
        });
        let needed = contacts.into_iter().chain(at.area_needed).fold(0.0, f64::max);
        let higher =
            verdicts.admissible.stretches.iter().map(|stretch| stretch[0]).filter(|load| *load > at.load);
        let mut ways = Vec::new();
        ways.extend(
            higher
                .min_by(f64::total_cmp)
                .map(|load| format!("loads of at least {}", input_quantity(load, "Pa"))),
        );
        if needed > 0.0 && needed.is_finite() {
            let [needed, now] = [nominal_area(needed, true), nominal_area(verdicts.area, false)];
            ways.push(format!("at least {needed} of surface (now {now})"));
        } else {
            ways.push("a larger surface".to_owned());
        }
        ways
    }
}

/// Where no load is admissible, the shortest S filter with which this `load` (Pa) is, or else some other.
fn filtered(case: &CaseStudy, load: f64) -> Option<String> {
    if !case.verdicts.admissible.stretches.is_empty() {
        return None;
    }
    let found = case.treated.iter().filter_map(|one| match one.treatment {
        Treatment::ShortWaves(Some(index)) => {
            let loads = one.differences.iter().map(|at| (at.load, at.exceeded()));
            Some((index, AdmissibleRange::new(loads).stretches))
                .filter(|(_, stretches)| !stretches.is_empty())
        }
        _ => None,
    });
    let found: Vec<(f64, Vec<[f64; 2]>)> = found.collect();
    let (index, stretches) = shortest_filter(&found, load)?;
    let other = if holds(stretches, load) { "" } else { ", not this one" };
    let loads: Vec<String> = stretches.iter().map(|loads| stretch(*loads)).collect();
    Some(format!("an S filter of {} (loads {}, roughly{other})", quantity(*index, "m"), listed(&loads)))
}

/// The shortest filter whose stretches of admissible loads hold a load, or else the shortest.
fn shortest_filter(filters: &[(f64, Vec<[f64; 2]>)], load: f64) -> Option<&(f64, Vec<[f64; 2]>)> {
    let shortest = |only_here: bool| {
        let suitable = filters.iter().filter(|(_, stretches)| !only_here || holds(stretches, load));
        suitable.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    shortest(true).or_else(|| shortest(false))
}

fn holds(stretches: &[[f64; 2]], load: f64) -> bool {
    stretches.iter().any(|[from, to]| (*from..=*to).contains(&load))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{verdicts, with_card};
    use super::*;

    #[test]
    fn more_surface_lifts_the_limits_of_few_contacts() {
        let words =
            |contacts: f64| exceeded_words(&verdicts(contacts, [0.2, 0.3], Some(0.01)).differences[0]);
        assert_eq!(words(9.0), "9 effective contacts (at least 30)");
        assert_eq!(words(29.98), "29.9 effective contacts (at least 30)");
        let needed = |error| with_card(verdicts(9.0, [0.2, 0.3], error), |card, at| card.more_contacts(at));
        assert_eq!(needed(Some(0.01)), ["at least 3.4 mm² of surface (now 1 mm²)"]);
        assert_eq!(needed(None), ["at least 4 mm² of surface (now 1 mm²)"]);
    }

    #[test]
    fn a_filter_that_helps_at_the_load_comes_before_a_shorter_one() {
        let filters =
            [(1e-6, vec![[1e6, 2e6], [8e6, 9e6]]), (2e-6, vec![[1e6, 9e6]]), (4e-6, vec![[1e6, 9e6]])];
        let index = |load: f64| shortest_filter(&filters, load).unwrap().0;
        assert_eq!([2e6, 5e6, 1e8].map(index), [1e-6, 2e-6, 1e-6]);
        assert!(shortest_filter(&[], 1e6).is_none());
    }
}
