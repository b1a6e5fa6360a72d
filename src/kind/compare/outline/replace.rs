//! May the integral replace the sum at one load: on the compared surface itself, and on such surfaces.

use asperity::Limit;
use asperity::compare::{ComparedQuantity, Difference, Estimate, NotModelled, Verdict};
use asperity::study::{Basis, Verdicts};
use asperity::topography::generate::Unfitted;
use asperity_contact_framework::report::format::{listed, number, signed};

use super::lead::{ORDER, nominal_area};
use crate::presentation::quantity_name;

/// The answers in the order in which they are given, with their words.
const ANSWERS: [(Verdict, &str); 5] = [
    (Verdict::Beyond, "no"),
    (Verdict::VeryLikelyBeyond, "very likely not"),
    (Verdict::Within, "yes"),
    (Verdict::VeryLikelyWithin, "very likely yes"),
    (Verdict::CannotTell, "cannot be told"),
];

/// The answer in each quantity that is compared, with its figures.
type Answers = Vec<(ComparedQuantity, Verdict, String)>;

/// The words where the numbers agree or differ, and neither model is to be trusted.
const NUMBERS: [(Verdict, &str); 2] =
    [(Verdict::Beyond, "beyond what is accepted"), (Verdict::Within, "within what is accepted")];

/// "May the integral replace the sum at this load? On this map: no in real contact area (+193 %; accepted 10 %), yes in separation
/// (...)."; where the map is not fit or neither model is for the load, the numbers without an answer. `None` where nothing is compared.
pub fn on_map(at: &Difference, verdicts: &Verdicts) -> Option<String> {
    let answer = |quantity: ComparedQuantity| {
        let contrast = at.estimates[quantity as usize]?.contrast;
        let [low, high] = verdicts.accepted.band(quantity);
        let verdict = if (low..=high).contains(&contrast) { Verdict::Within } else { Verdict::Beyond };
        let (unit, size) = unit(quantity);
        let accepted = number(size * verdicts.accepted.limit(quantity));
        Some((quantity, verdict, format!("{}; accepted {accepted} {unit}", ends(quantity, [contrast; 2]))))
    };
    let answers: Answers = ORDER.into_iter().filter_map(answer).collect();
    let whose = match verdicts.basis {
        Basis::Realisations(count) => format!("In the mean of these {count} realisations"),
        Basis::Asperities | Basis::Unstated => "On these asperities".to_owned(),
        Basis::Blocks { .. } | Basis::TooSmall { .. } | Basis::ModelBased => "On this map".to_owned(),
    };
    let is_invalid = |limit| matches!(limit, Limit::Interaction | Limit::LargeStrain);
    let untrusted = if verdicts.is_blocked {
        Some("the map is not fit to tell")
    } else {
        at.exceeded().limits().any(is_invalid).then_some("neither model is admissible here")
    };
    let answer = match untrusted {
        Some(why) => {
            format!("No answer, because {why}. {whose} the difference is {}", in_words(&answers, &NUMBERS))
        }
        None => format!("{whose}: {}", in_words(&answers, &ANSWERS)),
    };
    (!answers.is_empty()).then(|| format!("May the integral replace the sum at this load? {answer}."))
}

/// "On such surfaces (model-based 95 % intervals): no in real contact area (+131 to +272 %), cannot be told in separation (...)."
pub fn on_surface(at: &Difference, verdicts: &Verdicts) -> String {
    let mut is_area_named = false;
    let answer = |quantity: ComparedQuantity| {
        let estimate = at.estimates[quantity as usize]?;
        let verdict = Verdict::from_estimate(&estimate, verdicts.accepted.band(quantity));
        let interval = estimate.interval().map(|interval| ends(quantity, interval));
        let need = (verdict == Verdict::CannotTell).then(|| need(&estimate, quantity, verdicts)).flatten();
        is_area_named |= need.is_some();
        let figures: Vec<String> = interval.into_iter().chain(need).collect();
        Some((quantity, verdict, figures.join("; ")))
    };
    let answers: Answers = ORDER.into_iter().filter_map(answer).collect();
    let is_open = answers.iter().any(|(_, verdict, _)| *verdict == Verdict::CannotTell);
    let why = if is_open { why_open(at, verdicts, is_area_named) } else { String::new() };
    format!("On such surfaces{}: {}{why}.", intervals(verdicts), in_words(&answers, &ANSWERS))
}

/// "no in real contact area (+193 %) and stiffness (+168 %), yes in separation (-0.05 σ)".
fn in_words(answers: &Answers, words: &[(Verdict, &str)]) -> String {
    let of = |(verdict, words): &(Verdict, &str)| {
        let with = answers.iter().filter(|(_, other, _)| other == verdict);
        let each: Vec<String> = with
            .map(|(quantity, _, figures)| {
                let name = quantity_name(*quantity);
                if figures.is_empty() { name.to_owned() } else { format!("{name} ({figures})") }
            })
            .collect();
        (!each.is_empty()).then(|| format!("{words} in {}", listed(&each)))
    };
    words.iter().filter_map(of).collect::<Vec<_>>().join(", ")
}

/// What would tell in a quantity whose interval is across the edge of what is accepted: an area of surface, or a number of realisations.
fn need(estimate: &Estimate, quantity: ComparedQuantity, verdicts: &Verdicts) -> Option<String> {
    let growth = estimate.growth(verdicts.accepted.band(quantity))?;
    Some(match verdicts.basis {
        Basis::Realisations(now) => {
            let needed = (growth * now as f64).ceil().max(now as f64 + 1.0);
            format!("about {} realisations would tell", number(needed))
        }
        _ => format!("about {} would tell", nominal_area(growth * verdicts.area, true)),
    })
}

/// Why some quantity cannot be told: what there is of the surface, and why there is no interval.
fn why_open(at: &Difference, verdicts: &Verdicts, is_area_named: bool) -> String {
    let now = nominal_area(verdicts.area, false);
    let reason = match verdicts.basis {
        Basis::Unstated => {
            return "; no interval: the list needs `independent = true`, or columns `x` and `y`".to_owned();
        }
        Basis::Realisations(_) => return String::new(),
        Basis::TooSmall { not_modelled: Some(reason), .. } => {
            format!("; no model-based interval: {}", no_model(reason))
        }
        _ => String::new(),
    };
    let has_interval = at.estimates.iter().flatten().all(|one| one.interval().is_some());
    match at.area_needed.filter(|_| !has_interval) {
        Some(area) if area.is_finite() => {
            format!("; an interval needs at least {} of surface, now {now}{reason}", nominal_area(area, true))
        }
        Some(_) => {
            format!("; no interval: heights or their amplitude correlate over half of the map{reason}")
        }
        None if is_area_named => format!("; the surface has {now}{reason}"),
        None => reason,
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
        NotModelled::Unfitted(Unfitted::Periodic) => "the surface is periodic",
        NotModelled::Failed => "surfaces of its spectrum and heights could not be compared",
    }
}

/// What the intervals are.
fn intervals(verdicts: &Verdicts) -> &'static str {
    match verdicts.basis {
        Basis::ModelBased => " (model-based 95 % intervals)",
        Basis::Blocks { .. } | Basis::Realisations(_) | Basis::Asperities => " (95 % intervals)",
        Basis::TooSmall { .. } | Basis::Unstated => "",
    }
}

/// "+12 to +36 %" of contrasts of a quantity.
fn ends(quantity: ComparedQuantity, contrasts: [f64; 2]) -> String {
    let (unit, size) = unit(quantity);
    let [low, high] = contrasts.map(|end| signed(size * quantity.reported(end)));
    if low == high { format!("{low} {unit}") } else { format!("{low} to {high} {unit}") }
}

fn unit(quantity: ComparedQuantity) -> (&'static str, f64) {
    match quantity {
        ComparedQuantity::Separation => ("σ", 1.0),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => ("%", 100.0),
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::verdicts;
    use super::*;

    fn answers(verdicts: &Verdicts) -> [String; 2] {
        let at = &verdicts.differences[0];
        [on_map(at, verdicts).unwrap(), on_surface(at, verdicts)]
    }

    #[test]
    fn both_questions_are_answered_in_figures() {
        let [map, surface] = answers(&verdicts(90.0, [0.2, 0.3], Some(0.01)));
        assert_eq!(
            map,
            "May the integral replace the sum at this load? On these asperities: no in real contact area (+22.1 %; accepted 10 %)."
        );
        assert_eq!(surface, "On such surfaces (95 % intervals): no in real contact area (+19.7 to +24.6 %).");
        let [map, surface] = answers(&verdicts(90.0, [0.01, 0.3], Some(0.01)));
        assert!(map.contains(": yes in real contact area (+1.01 %; accepted 10 %)."), "{map}");
        assert!(surface.contains(": yes in real contact area (-0.995 to +3.05 %)."), "{surface}");
    }

    /// Models that agree where neither is admissible, or on a map with faults, do not make a yes.
    #[test]
    fn numbers_that_are_not_trusted_are_no_answer() {
        let mut crowded = verdicts(90.0, [0.01, 0.3], Some(0.01));
        crowded.differences[0].area_ratio = 0.2;
        let mut blocked = verdicts(90.0, [0.01, 0.3], Some(0.01));
        blocked.is_blocked = true;
        let few = verdicts(9.0, [0.01, 0.3], Some(0.01));
        let text = |verdicts: &Verdicts| on_map(&verdicts.differences[0], verdicts).unwrap();
        for (verdicts, why) in
            [(crowded, "neither model is admissible here"), (blocked, "the map is not fit to tell")]
        {
            assert_eq!(
                text(&verdicts),
                format!(
                    "May the integral replace the sum at this load? No answer, because {why}. On these asperities the difference is \
                     within what is accepted in real contact area (+1.01 %; accepted 10 %)."
                )
            );
        }
        assert!(text(&few).contains("On these asperities: yes"), "the sum over its own asperities is exact");
    }

    #[test]
    fn what_cannot_be_told_names_what_it_needs() {
        let [map, surface] = answers(&verdicts(90.0, [0.2, 0.3], None));
        assert!(map.contains(": no in real contact area (+22.1 %;"), "{map}");
        let expected =
            ": cannot be told in real contact area; an interval needs at least 4 mm² of surface, now 1 mm².";
        assert!(surface.ends_with(expected), "{surface}");
        let [_, surface] = answers(&verdicts(90.0, [0.13, 0.3], Some(0.03)));
        let expected = ": cannot be told in real contact area (+7.25 to +20.9 %; about 3 mm² would tell); the surface has 1 mm².";
        assert!(surface.ends_with(expected), "{surface}");
        let mut endless = verdicts(90.0, [0.2, 0.3], None);
        endless.differences[0].area_needed = Some(f64::INFINITY);
        let [_, surface] = answers(&endless);
        assert!(
            surface.ends_with("; no interval: heights or their amplitude correlate over half of the map."),
            "{surface}"
        );
        // On the edge itself no area tells, and none is stated.
        let [_, surface] = answers(&verdicts(90.0, [0.1f64.ln_1p(), 0.3], Some(0.05)));
        assert!(surface.contains("cannot be told") && !surface.contains("mm²"), "{surface}");
    }
}
