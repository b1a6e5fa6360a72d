//! May the integral replace the sum: on the compared surface itself, on such surfaces, and at other loads.

use asperity::compare::{ComparedQuantity, Difference, Verdict};
use asperity::study::Basis;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{listed, range};

use super::limit::exceeded_words;
use super::{Card, State, has_interval, names};
use crate::surface::fitness;

/// The answers in the order in which they are given.
const ANSWERS: [(Verdict, &str); 5] = [
    (Verdict::Beyond, "no"),
    (Verdict::VeryLikelyBeyond, "very likely not"),
    (Verdict::Within, "yes"),
    (Verdict::VeryLikelyWithin, "very likely yes"),
    (Verdict::CannotTell, "cannot be told"),
];

impl Card<'_> {
    /// A text for this map, one for such surfaces, and one for other loads, as far as each has something to say.
    pub(super) fn replace(&self, at: &Difference) -> Vec<String> {
        match self.state(at) {
            State::Unfit => vec![fitting(fitness::in_short(self.surface))],
            State::NeitherModel => {
                let mut texts = vec![format!("Neither model is for this load: {}.", exceeded_words(at))];
                texts.extend(self.over_loads());
                texts
            }
            State::FewContacts => {
                let such = format!("Such surfaces: cannot be told with {}.", exceeded_words(at));
                std::iter::once(self.on_map(at)).chain([such]).chain(self.over_loads()).collect()
            }
            State::Admissible => std::iter::once(self.on_map(at))
                .chain([self.on_surfaces(at)])
                .chain(self.over_loads())
                .collect(),
        }
    }

    /// "On this map: no for contact area; yes for separation and stiffness."
    fn on_map(&self, at: &Difference) -> String {
        format!("{}: {}.", self.scope(), in_words(&self.on_this_map(at)))
    }

    /// The verdict in each quantity on the compared surface, by the difference itself.
    pub(super) fn on_this_map(&self, at: &Difference) -> Vec<(ComparedQuantity, Verdict)> {
        let verdict = |quantity: ComparedQuantity| {
            let contrast = at.estimates[quantity as usize]?.contrast;
            let [low, high] = self.verdicts().accepted.band(quantity);
            let is_within = (low..=high).contains(&contrast);
            Some((quantity, if is_within { Verdict::Within } else { Verdict::Beyond }))
        };
        ComparedQuantity::REPORTED.into_iter().filter_map(verdict).collect()
    }

    /// "Such surfaces: very likely not for contact area; cannot be told for separation (model-based intervals)."
    fn on_surfaces(&self, at: &Difference) -> String {
        let intervals = match self.verdicts().basis {
            _ if !has_interval(at) => " (no interval)",
            Basis::ModelBased => " (model-based intervals)",
            _ => " (95 % intervals)",
        };
        let answers = in_words(&self.of_such_surfaces(at));
        fitting([intervals, ""].map(|intervals| format!("Such surfaces: {answers}{intervals}.")))
    }

    pub(super) fn of_such_surfaces(&self, at: &Difference) -> Vec<(ComparedQuantity, Verdict)> {
        let verdict = |quantity: ComparedQuantity| {
            let estimate = at.estimates[quantity as usize]?;
            Some((quantity, Verdict::from_estimate(&estimate, self.verdicts().accepted.band(quantity))))
        };
        ComparedQuantity::REPORTED.into_iter().filter_map(verdict).collect()
    }

    /// "All quantities, by load: no from 0.5 to 20 MPa, yes from 40 to 50 MPa, else cannot be told; admissible from 0.5 to 50 MPa."; of one load nothing.
    fn over_loads(&self) -> Option<String> {
        let verdicts = self.verdicts();
        if verdicts.differences.len() < 2 {
            return None;
        }
        let admissible: Vec<String> =
            verdicts.admissible.stretches.iter().map(|loads| stretch(*loads)).collect();
        if admissible.is_empty() {
            return Some("No compared load is admissible.".to_owned());
        }
        let answered = |at: &Difference| {
            let each = self.of_such_surfaces(at);
            let has = |is_wanted: fn(Verdict) -> bool| each.iter().any(|(_, verdict)| is_wanted(*verdict));
            let is_told = has(Verdict::is_beyond) || each.iter().all(|(_, verdict)| verdict.is_within());
            (at.exceeded().is_none() && !each.is_empty() && is_told).then(|| has(Verdict::is_beyond))
        };
        let mut sorted: Vec<&Difference> = verdicts.differences.iter().collect();
        sorted.sort_by(|a, b| a.load.total_cmp(&b.load));
        let mut told = [Vec::new(), Vec::new()];
        for group in sorted.chunk_by(|a, b| answered(a) == answered(b)) {
            if let Some(is_beyond) = answered(group[0]) {
                told[usize::from(!is_beyond)].push(stretch([group[0].load, group[group.len() - 1].load]));
            }
        }
        let is_open = sorted.iter().any(|at| at.exceeded().is_none() && answered(at).is_none());
        let parts = ["no", "yes"].into_iter().zip(&told).filter(|(_, loads)| !loads.is_empty());
        let mut parts: Vec<String> =
            parts.map(|(answer, loads)| format!("{answer} {}", listed(loads))).collect();
        if is_open {
            parts.push(if parts.is_empty() { "cannot be told" } else { "else cannot be told" }.to_owned());
        }
        let loads = parts.join(", ");
        let admissible = listed(&admissible);
        Some(fitting([
            format!("All quantities, by load: {loads}; admissible {admissible}."),
            format!("All quantities, by load: {loads}."),
            format!("The answer changes with the load, as the figure shows; admissible {admissible}."),
            "The answer changes with the load, as the figure shows.".to_owned(),
        ]))
    }
}

/// "from 0.5 to 40 MPa", or "at 1 MPa".
pub(super) fn stretch(loads: [f64; 2]) -> String {
    let preposition = if loads[0] == loads[1] { "at" } else { "from" };
    format!("{preposition} {}", range(loads, "Pa"))
}

/// "no for contact area; yes for separation and stiffness"; "no" where all are alike.
fn in_words(answers: &[(ComparedQuantity, Verdict)]) -> String {
    let of = |(verdict, words): &(Verdict, &str)| {
        let alike: Vec<ComparedQuantity> =
            answers.iter().filter(|(_, other)| other == verdict).map(|(quantity, _)| *quantity).collect();
        match alike.len() {
            0 => None,
            all if all == answers.len() => Some((*words).to_owned()),
            _ => Some(format!("{words} for {}", names(alike))),
        }
    };
    ANSWERS.iter().filter_map(of).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use asperity::study::Verdicts;

    use super::super::tests::{verdicts, with_card};
    use super::*;

    fn texts(verdicts: Verdicts) -> Vec<String> {
        with_card(verdicts, |card, at| card.replace(at))
    }

    #[test]
    fn the_question_is_answered_for_these_asperities_for_such_surfaces_and_for_all_loads() {
        assert_eq!(
            texts(verdicts(90.0, [0.2, 0.01], Some(0.01))),
            [
                "On these asperities: no.",
                "Such surfaces: no (95 % intervals).",
                "All quantities, by load: no at 1 MPa, yes at 10 MPa; admissible from 1 to 10 MPa."
            ]
        );
        let open = texts(verdicts(90.0, [0.2, 0.3], None));
        assert_eq!(open[1], "Such surfaces: cannot be told (no interval).");
        assert_eq!(open[2], "All quantities, by load: cannot be told; admissible from 1 to 10 MPa.");
    }

    /// Models that agree where neither is admissible, or on a map with faults, do not make a yes.
    #[test]
    fn numbers_that_are_not_trusted_are_no_answer() {
        let mut crowded = verdicts(90.0, [0.01, 0.3], Some(0.01));
        crowded.differences.iter_mut().for_each(|at| at.area_ratio = 0.2);
        crowded.admissible.stretches.clear();
        assert_eq!(
            texts(crowded),
            [
                "Neither model is for this load: contact area 20 % of the nominal (at most 5 %).",
                "No compared load is admissible."
            ]
        );
        let unfit = Verdicts { is_blocked: true, ..verdicts(90.0, [0.01, 0.3], Some(0.01)) };
        assert_eq!(texts(unfit), ["No conclusion until the map is fit."]);
        let few = texts(verdicts(9.0, [0.01, 0.3], Some(0.01)));
        assert_eq!(few[0], "On these asperities: yes.", "the sum over its own asperities is exact");
        assert_eq!(few[1], "Such surfaces: cannot be told with 9 effective contacts (at least 30).");
    }

    #[test]
    fn quantities_with_one_answer_are_named_together() {
        use ComparedQuantity::{Area, Separation, Stiffness};
        let words = |verdicts: [Verdict; 3]| {
            in_words(&[Area, Separation, Stiffness].into_iter().zip(verdicts).collect::<Vec<_>>())
        };
        assert_eq!(words([Verdict::Within; 3]), "yes");
        assert_eq!(
            words([Verdict::Beyond, Verdict::Within, Verdict::Within]),
            "no for contact area; yes for separation and stiffness"
        );
    }
}
