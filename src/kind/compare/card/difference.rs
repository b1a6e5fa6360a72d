//! By how much the integral differs from the sum.

use asperity::compare::{ComparedQuantity, Difference, Estimate};
use asperity::numeric::two_digits;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{capitalised, number, signed};

use super::{Card, State, has_interval, name, names};
use crate::presentation::difference_unit;

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
            capitalised_after(&scope, &format!("{}.", text.join("; ")))
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

/// A text with a capital letter, or after a scope as it is.
fn capitalised_after(scope: &str, text: &str) -> String {
    if scope.is_empty() { capitalised(text) } else { format!("{scope}{text}") }
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
    use super::*;

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
