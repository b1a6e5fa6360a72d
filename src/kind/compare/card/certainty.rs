//! How sure the answer is: its intervals, the contacts behind it, and the choices in the analysis that it depends on.

use asperity::compare::{ComparedQuantity, Difference, NotModelled, Verdict};
use asperity::numeric::two_digits;
use asperity::study::{Basis, Choice, Dependence, Treated};
use asperity::topography::generate::Unfitted;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{capitalised, number, quantity as quantity_text, signed};

use super::{Card, State, has_interval, name, nominal_area, with_additions};
use crate::kind::compare::rows::treatment_words;
use crate::presentation::difference_unit;

impl Card<'_> {
    pub(super) fn certainty(&self, at: &Difference) -> Option<String> {
        match self.state(at) {
            State::Unfit | State::NeitherModel => return None,
            State::FewContacts => return Some(format!("{}.", self.no_interval(at))),
            State::Admissible => {}
        }
        let [interval, short_interval] = self.interval(at);
        if let Some(dependence) = self.dependence() {
            let [full, short] = self.dependence_words(dependence, at.load);
            return Some(fitting([
                format!("{short_interval}; {full}."),
                format!("{full}."),
                format!("{short_interval}; {short}."),
            ]))
            .map(|text| capitalised(&text));
        }
        let robust = self.robust(at);
        let contacts = at
            .sharing
            .as_ref()
            .map(|sharing| format!("; {} effective contacts", number(sharing.effective_contacts.round())));
        let additions: Vec<String> = self.need(at).into_iter().chain(robust).chain(contacts).collect();
        Some(with_additions(&interval, &additions))
    }

    /// That no other treatment of the map reverses a verdict, of those with an admissible load; nothing where no verdict is told.
    fn robust(&self, at: &Difference) -> Option<String> {
        let is_told = self.of_such_surfaces(at).iter().any(|(_, verdict)| verdict.is_told());
        let has_load = |one: &&Treated| one.differences.iter().any(|at| at.exceeded().is_none());
        let tried = self.case.treated.iter().filter(has_load).count();
        (is_told && tried > 0)
            .then(|| format!("; none of {tried} other treatments of the map reverses a verdict"))
    }

    /// What the intervals rest on, or why there is none; and in short.
    fn interval(&self, at: &Difference) -> [String; 2] {
        if !has_interval(at) {
            return [self.no_interval(at), "No interval".to_owned()];
        }
        let short = "95 % intervals";
        match self.verdicts().basis {
            Basis::ModelBased => {
                ["Model-based 95 % intervals".to_owned(), "Model-based intervals".to_owned()]
            }
            Basis::Blocks { count, .. } if self.verdicts().shifts > 1 => {
                let shifts = self.verdicts().shifts;
                [
                    format!(
                        "{short} from {count} blocks of the sum of both maps and {shifts} relative positions"
                    ),
                    short.to_owned(),
                ]
            }
            Basis::Blocks { count, .. } => {
                [format!("{short} from {count} blocks of the map"), short.to_owned()]
            }
            Basis::Realisations(count) => [format!("{short} from {count} realisations"), short.to_owned()],
            _ => [format!("{short} from random groups of the asperities"), short.to_owned()],
        }
    }

    /// What would tell where an interval is across the edge of what is accepted: an area of surface, or a number of realisations.
    fn need(&self, at: &Difference) -> Option<String> {
        let verdicts = self.verdicts();
        let of_quantity = |quantity: ComparedQuantity| {
            let estimate = at.estimates[quantity as usize]?;
            let band = verdicts.accepted.band(quantity);
            let is_open = Verdict::from_estimate(&estimate, band) == Verdict::CannotTell;
            is_open.then(|| estimate.growth(band))
        };
        // All that are open, of which each has such a size.
        let open: Option<Vec<f64>> = ComparedQuantity::REPORTED.into_iter().filter_map(of_quantity).collect();
        let growth = open?.into_iter().reduce(f64::max)?;
        let needed = match verdicts.basis {
            Basis::Realisations(now) => {
                format!("about {} realisations", number((growth * now as f64).ceil().max(now as f64 + 1.0)))
            }
            _ => format!("about {}", nominal_area(growth * verdicts.area, true)),
        };
        Some(format!("; {needed} would tell at this load"))
    }

    fn no_interval(&self, at: &Difference) -> String {
        let verdicts = self.verdicts();
        let now = nominal_area(verdicts.area, false);
        match verdicts.basis {
            Basis::Unstated => {
                "No interval: the list needs `independent = true`, or columns `x` and `y`".to_owned()
            }
            Basis::TooSmall { not_modelled: Some(reason), .. } => {
                format!("No interval: {}", no_model(reason))
            }
            _ => match at.area_needed {
                Some(area) if area.is_finite() => {
                    format!("No interval: it needs {} of surface, now {now}", nominal_area(area, true))
                }
                Some(_) => {
                    "No interval: heights or their amplitude correlate over half of the map".to_owned()
                }
                None => "No interval".to_owned(),
            },
        }
    }

    /// The dependence that matters most: in the first quantity, on the first choice.
    fn dependence(&self) -> Option<&Dependence> {
        let place = |one: &&Dependence| {
            let quantity = ComparedQuantity::REPORTED.iter().position(|quantity| *quantity == one.quantity);
            (quantity, Choice::ALL.iter().position(|choice| *choice == one.choice))
        };
        self.case.dependences.iter().min_by_key(place)
    }

    /// "The answer depends on the S filter: contact area +10 % with S filter 3.15 µm, +79 % as analysed", and shorter.
    fn dependence_words(&self, dependence: &Dependence, of_card: f64) -> [String; 2] {
        let Dependence { choice, quantity, treatments, contrasts, load } = dependence;
        let at = if *load == of_card { String::new() } else { format!(" at {}", quantity_text(*load, "Pa")) };
        let treatment = |place: Option<usize>| {
            place.map_or_else(
                || "as analysed".to_owned(),
                |place| format!("with {}", treatment_words(self.case.treated[place].treatment)),
            )
        };
        let each = treatments.iter().zip(contrasts).map(|(place, contrast)| {
            format!("{} {}", in_two_digits(*quantity, *contrast), treatment(*place))
        });
        let each = each.collect::<Vec<_>>().join(", ");
        let short = format!("the answer depends on {}", choice_words(*choice));
        [format!("{short}: {}{at} {each}", name(*quantity)), short]
    }
}

/// A difference that may change with the analysis: two digits.
fn in_two_digits(quantity: ComparedQuantity, contrast: f64) -> String {
    let (unit, factor) = difference_unit(quantity);
    format!("{} {unit}", signed(two_digits(factor * quantity.reported(contrast))))
}

/// A choice in the analysis of a map.
fn choice_words(choice: Choice) -> &'static str {
    match choice {
        Choice::ShortWaves => "the S filter",
        Choice::Summits => "the number of neighbours that a summit exceeds",
        Choice::MeanRadius => "the mean radius",
        Choice::Level => "the form removed",
        Choice::Spikes => "narrow points that may be wrong",
        Choice::Part => "the part of the map",
    }
}

/// Why there is no model-based interval.
fn no_model(reason: NotModelled) -> &'static str {
    match reason {
        NotModelled::Unfitted(Unfitted::TooShort) => {
            "a side of the map is shorter than 8 correlation lengths"
        }
        NotModelled::Unfitted(Unfitted::Patchy) | NotModelled::Patchy => {
            "the roughness varies from place to place"
        }
        NotModelled::Unfitted(Unfitted::Flat) => "the heights do not scatter",
        NotModelled::Unfitted(Unfitted::Periodic) => "it has fewer than 16 blocks of 9 correlation lengths",
        NotModelled::Failed => "surfaces of its spectrum and heights could not be compared",
    }
}

#[cfg(test)]
mod tests {
    use asperity::study::Treatment;

    use super::super::tests::{verdicts, with_card, with_case};
    use super::*;

    #[test]
    fn an_interval_has_its_basis_and_what_would_tell() {
        let text = |verdicts| with_card(verdicts, |card, at| card.certainty(at)).unwrap();
        let mut endless = verdicts(90.0, [0.2, 0.3], None);
        endless.differences[0].area_needed = Some(f64::INFINITY);
        for (verdicts, words) in [
            (verdicts(90.0, [0.2, 0.3], Some(0.01)), "intervals from random groups of the asperities; 90"),
            (verdicts(90.0, [0.13, 0.3], Some(0.03)), "; about 3 mm² would tell at this load"),
            (verdicts(90.0, [0.2, 0.3], None), "No interval: it needs 4 mm² of surface, now 1 mm²; 90"),
            (endless, "No interval: heights or their amplitude correlate over half"),
        ] {
            let text = text(verdicts);
            assert!(text.contains(words), "{text}");
        }
        // On the edge itself no area tells, and none is stated.
        let edge = text(verdicts(90.0, [0.1f64.ln_1p(), 0.3], Some(0.05)));
        assert!(!edge.contains("mm²"), "{edge}");
    }

    #[test]
    fn treatments_with_an_admissible_load_are_counted_where_a_verdict_is_told() {
        let treatment = Treatment::Half(0);
        let of = |error, contacts| {
            let differences = verdicts(contacts, [0.2, 0.3], Some(0.01)).differences;
            with_case(
                verdicts(90.0, [0.2, 0.3], error),
                |case| case.treated = vec![Treated { treatment, differences }],
                |card, at| card.certainty(at).unwrap(),
            )
        };
        assert!(of(Some(0.01), 90.0).contains("; none of 1 other treatments of the map reverses a verdict"));
        assert!(!of(Some(0.01), 9.0).contains("treatments"), "no load is admissible");
        assert!(!of(None, 90.0).contains("treatments"), "no verdict is told");
    }
}
