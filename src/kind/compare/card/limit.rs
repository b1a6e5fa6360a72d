//! By how much the integral differs from the sum, what makes a load inadmissible, and what to do about it.

use asperity::compare::{AdmissibleRange, ComparedQuantity, Difference, Estimate};
use asperity::numeric::two_digits;
use asperity::study::{CaseStudy, Treatment};
use asperity::{INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{
    capitalised, input_quantity, listed, number, percent, quantity, signed,
};

use super::replace::stretch;
use super::{Card, State, has_interval, name, names, nominal_area};
use crate::presentation::difference_unit;

/// "12 effective contacts (at least 30)": the limits that are exceeded at a load, those of neither model alone where there are such.
pub(super) fn exceeded_words(at: &Difference) -> String {
    let all: Vec<Limit> = at.exceeded().limits().collect();
    let of_neither: Vec<Limit> = all
        .iter()
        .copied()
        .filter(|limit| !matches!(limit, Limit::FewContacts | Limit::DominantContact))
        .collect();
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

impl Card<'_> {
    /// "Contact area 12 to 36 % too large (accepted ±10 %); separation and stiffness within what is accepted."; of a case without interval, or on an
    /// unfit map: "On this map, without an interval: ..."
    pub(super) fn difference(&self, at: &Difference) -> Option<String> {
        let accepted = &self.verdicts().accepted;
        let is_sampled = self.state(at) == State::Admissible;
        let compared: Vec<(ComparedQuantity, Estimate)> = ComparedQuantity::REPORTED
            .into_iter()
            .filter_map(|quantity| Some((quantity, at.estimates[quantity as usize]?)))
            .collect();
        let ends = |estimate: &Estimate| {
            estimate.interval().filter(|_| is_sampled).unwrap_or([estimate.contrast; 2])
        };
        let has_interval = is_sampled && has_interval(at);
        // Where others have an interval, a number without one is not known to be within.
        let is_within = |(quantity, estimate): &(ComparedQuantity, Estimate)| {
            let [low, high] = accepted.band(*quantity);
            let [from, to] = ends(estimate);
            low <= from && to <= high && (estimate.interval().is_some() || !has_interval)
        };
        let (within, others): (Vec<_>, Vec<_>) = compared.iter().partition(|one| is_within(one));
        let scope =
            if has_interval { String::new() } else { format!("{}, without an interval: ", self.scope()) };
        let each = |in_words: bool| {
            let texts = others.iter().enumerate().map(|(place, (quantity, estimate))| {
                let size = if in_words { size_in_words } else { size_in_signs };
                let (unit, factor) = difference_unit(*quantity);
                let limit = number(factor * accepted.limit(*quantity));
                let accepted = if in_words || place == 0 { "accepted " } else { "" };
                format!("{} {} ({accepted}±{limit} {unit})", name(*quantity), size(*quantity, ends(estimate)))
            });
            let rest = names(within.iter().map(|(quantity, _)| *quantity));
            let rest = match (within.is_empty(), others.is_empty()) {
                (true, _) => None,
                (false, true) => Some(self.all_within(&compared, &ends)),
                (false, false) => Some(format!("{rest} within what is accepted")),
            };
            let text: Vec<String> = texts.chain(rest).collect();
            let text = format!("{}.", text.join("; "));
            if scope.is_empty() { capitalised(&text) } else { scope.clone() + &text }
        };
        (!compared.is_empty()).then(|| fitting([each(true), each(false)]))
    }

    /// "contact area -1 to +3 %, separation ...: all within what is accepted".
    fn all_within(
        &self,
        compared: &[(ComparedQuantity, Estimate)],
        ends: &dyn Fn(&Estimate) -> [f64; 2],
    ) -> String {
        let each: Vec<String> = compared
            .iter()
            .map(|(quantity, estimate)| {
                format!("{} {}", name(*quantity), size_in_signs(*quantity, ends(estimate)))
            })
            .collect();
        format!("{}: within what is accepted", each.join(", "))
    }
}

/// A contrast as it is reported, in its unit; of an interval each end to its second digit, and at most one digit beyond that of the larger one.
fn reported(quantity: ComparedQuantity, [low, high]: [f64; 2]) -> [f64; 2] {
    let (_, factor) = difference_unit(quantity);
    let ends = [low, high].map(|end| factor * quantity.reported(end));
    if low == high {
        return ends;
    }
    let step = |size: f64| 10f64.powf(size.log10().floor() - 1.0);
    let least = 0.1 * step(ends[0].abs().max(ends[1].abs()));
    ends.map(|end| {
        let step = step(end.abs().max(f64::MIN_POSITIVE)).max(least);
        two_digits((end / step).round() * step)
    })
}

/// "12 to 36 % too large"; an interval across zero has signs.
fn size_in_words(quantity: ComparedQuantity, contrasts: [f64; 2]) -> String {
    let (unit, _) = difference_unit(quantity);
    let [low, high] = reported(quantity, contrasts);
    if low < 0.0 && high > 0.0 {
        return size_in_signs(quantity, contrasts);
    }
    let (ends, side) = if high > 0.0 { ([low, high], "large") } else { ([-high, -low], "small") };
    let [least, most] = ends.map(number);
    let range = if least == most { most } else { format!("{least} to {most}") };
    format!("{range} {unit} too {side}")
}

/// "-3.7 to +19 %"; what is below a hundredth of what matters anywhere is "< 0.001 σ", "< 0.1 %".
pub(super) fn size_in_signs(quantity: ComparedQuantity, contrasts: [f64; 2]) -> String {
    let (unit, factor) = difference_unit(quantity);
    let [low, high] = reported(quantity, contrasts);
    let least = LEAST * factor;
    if low.abs().max(high.abs()) < least {
        return format!("< {} {unit}", number(least));
    }
    let [from, to] = [low, high].map(|end| if end.abs() < least { "0".to_owned() } else { signed(end) });
    if from == to { format!("{to} {unit}") } else { format!("{from} to {to} {unit}") }
}

/// Smaller differences are not written out, in sigma or relative.
const LEAST: f64 = 1e-3;

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

    #[test]
    fn a_size_has_its_side_in_words_and_across_zero_its_signs() {
        let area = |ends: [f64; 2]| size_in_words(ComparedQuantity::Area, ends.map(f64::ln_1p));
        assert_eq!(area([0.123, 0.361]), "12 to 36 % too large");
        assert_eq!(area([-0.4, -0.2]), "20 to 40 % too small");
        assert_eq!(area([-0.037, 0.19]), "-3.7 to +19 %");
        assert_eq!(area([0.1234; 2]), "12.3 % too large");
        let separation = |ends| size_in_signs(ComparedQuantity::Separation, ends);
        assert_eq!(separation([9.5e-4, 9.5e-4]), "< 0.001 σ");
        assert_eq!(separation([-9.52e-4, 0.12]), "-0.001 to +0.12 σ");
        assert_eq!(separation([-1.52, -0.414]), "-1.5 to -0.41 σ");
    }
}
