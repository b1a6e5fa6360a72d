//! The answer in one sentence.

use asperity::compare::{ComparedQuantity, Stretch, Verdict};
use asperity::numeric::decades;
use asperity_framework::report::format::{capitalised, listed, percent};

use super::range::any_exceeded_words;
use super::words::{accepted, between, name, need, over, size, span};
use crate::kind::compare::findings::{Basis, LeadingCause, Verdicts};

/// The order in which quantities are spoken of.
const ORDER: [ComparedQuantity; 3] = ComparedQuantity::REPORTED;

/// The answer on one surface, with separations in units of `sigma` (m): of each quantity its widest stretch of load with a
/// conclusion, or the widest where there is none; with the leading causes.
pub fn headline(verdicts: &Verdicts, sigma: f64) -> String {
    answer(verdicts, sigma, true)
}

/// The same without causes, for where they follow.
pub fn verdict_alone(verdicts: &Verdicts, sigma: f64) -> String {
    answer(verdicts, sigma, false)
}

fn answer(verdicts: &Verdicts, sigma: f64, with_causes: bool) -> String {
    if verdicts.differences.is_empty() {
        return "The models were not compared at equal load.".to_owned();
    }
    if verdicts.valid.stretches.is_empty() {
        return format!(
            "Whether the statistical model agrees with the sum cannot be told at any load of this experiment: {}.{}",
            any_exceeded_words(verdicts.valid.below),
            verdicts
                .stretches
                .first()
                .and_then(|stretch| need(stretch, verdicts))
                .map_or_else(String::new, |need| format!(" It would take {need} at one of these loads."))
        );
    }
    let of = |compared: ComparedQuantity| {
        verdicts.stretches.iter().filter(move |stretch| stretch.quantity == compared)
    };
    let rank = |stretch: &Stretch| (stretch.verdict != Verdict::CannotTell, decades(stretch.loads));
    let widest = |compared: ComparedQuantity| {
        of(compared).max_by(|a, b| {
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    };
    let main: Vec<&Stretch> = ORDER.into_iter().filter_map(widest).collect();
    let common =
        main.first().map(|first| first.loads).filter(|loads| main.iter().all(|one| one.loads == *loads));
    let place = |stretch: &Stretch| {
        if common.is_some() { String::new() } else { format!(" {}", over(stretch.loads)) }
    };
    let mut clauses = Vec::new();
    clauses.extend(within(&by(&main, Verdict::Within), &place, sigma));
    clauses.extend(beyond(&by(&main, Verdict::Beyond), &place, sigma));
    let mut sentence = String::new();
    if !clauses.is_empty() {
        let start = common.map_or_else(|| "The".to_owned(), |range| capitalised(&between(range)) + " the");
        sentence = format!("{start} statistical model {}.", clauses.join(", but "));
    }
    let open = by(&main, Verdict::CannotTell);
    if !open.is_empty() {
        let names: Vec<String> =
            open.iter().map(|stretch| format!("{}{}", name(stretch.quantity), place(stretch))).collect();
        let range = common
            .filter(|_| sentence.is_empty())
            .map_or_else(String::new, |range| format!(" {}", between(range)));
        let needs = why_open(&open, verdicts);
        let joined = if sentence.is_empty() { "" } else { " " };
        sentence.push_str(&format!(
            "{joined}Whether it agrees in {}{range} cannot be told{needs}.",
            listed(&names)
        ));
        if joined.is_empty() {
            sentence = sentence.replacen(
                "Whether it agrees",
                "Whether the statistical model agrees with the sum",
                1,
            );
        }
    }
    if with_causes {
        sentence.extend(causes(&main, verdicts));
    }
    if main.iter().any(|widest| of(widest.quantity).count() > 1) {
        sentence.push_str(" At other loads the verdict differs: see the table.");
    }
    sentence
}

/// " Leading cause: the height distribution (separation and stiffness)." of the stretches that are not within what is accepted.
fn causes(main: &[&Stretch], verdicts: &Verdicts) -> Option<String> {
    let mut causes: Vec<(LeadingCause, Vec<String>)> = Vec::new();
    for stretch in main {
        let Some(cause) = verdicts.cause(stretch) else { continue };
        let quantity = name(stretch.quantity).to_owned();
        match causes.iter_mut().find(|(known, _)| *known == cause) {
            Some((_, quantities)) => quantities.push(quantity),
            None => causes.push((cause, vec![quantity])),
        }
    }
    let clause = |(cause, quantities): &(LeadingCause, Vec<String>)| {
        format!("the {} ({})", cause.label(), listed(quantities))
    };
    let clauses: Vec<String> = causes.iter().map(clause).collect();
    match clauses.len() {
        0 => None,
        1 => Some(format!(" Leading cause: {}.", clauses[0])),
        _ => Some(format!(" Leading causes: {}.", listed(&clauses))),
    }
}

fn by<'a>(main: &[&'a Stretch], verdict: Verdict) -> Vec<&'a Stretch> {
    main.iter().copied().filter(|stretch| stretch.verdict == verdict).collect()
}

/// How much surface it would take to tell of all these stretches, or why none would; nothing where that is not known.
fn why_open(open: &[&Stretch], verdicts: &Verdicts) -> String {
    let needs =
        open.iter().filter_map(|stretch| Some((verdicts.area_needed(stretch)?, need(stretch, verdicts)?)));
    match needs.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((_, need)) if need.starts_with("at least") => format!(": it would take {need}"),
        Some((_, need)) => format!(": it would take {need} to tell at half of these loads"),
        None if matches!(verdicts.basis, Basis::TooSmall { .. }) => {
            ": the map is too short, compared with its longest waves, for a sampling error".to_owned()
        }
        None => String::new(),
    }
}

/// "agrees with the sum in real contact area within 8 % (accepted: 10 %)".
fn within(stretches: &[&Stretch], place: &dyn Fn(&Stretch) -> String, sigma: f64) -> Option<String> {
    let part = |stretch: &&Stretch| {
        let [low, high] = stretch.bounds?;
        let reported = |contrast: f64| stretch.quantity.reported(contrast).abs();
        let outer = if reported(low) > reported(high) { low } else { high };
        let size = size(stretch.quantity, outer, sigma);
        let size = match size.strip_suffix(')') {
            Some(open) => format!("{open}; "),
            None => format!("{size} ("),
        };
        let accepted = accepted(stretch, sigma);
        Some(format!("in {} within {size}accepted: {accepted}){}", name(stretch.quantity), place(stretch)))
    };
    let parts: Vec<String> = stretches.iter().filter_map(part).collect();
    (!parts.is_empty()).then(|| format!("agrees with the sum {}", listed(&parts)))
}

/// "puts the flat 60 to 157 nm (0.2 to 0.55 σ) higher: beyond what is accepted (…)".
fn beyond(stretches: &[&Stretch], place: &dyn Fn(&Stretch) -> String, sigma: f64) -> Option<String> {
    let part = |stretch: &&Stretch| {
        let [low, high] = stretch.range?;
        let (near, far) = if low.abs() < high.abs() { (low, high) } else { (high, low) };
        let shares = || {
            let [near, far] = [near, far].map(|at| percent(stretch.quantity.reported(at).abs()));
            if near == far { far } else { span(&near, &far, " to ") }
        };
        let is_more = far > 0.0;
        let what = match stretch.quantity {
            ComparedQuantity::Separation => format!(
                "puts the flat {} {}",
                distances(near, far, sigma),
                if is_more { "higher" } else { "lower" }
            ),
            ComparedQuantity::Area => {
                format!("gives {} {} real contact area", shares(), if is_more { "more" } else { "less" })
            }
            ComparedQuantity::Stiffness => {
                format!("is {} {}", shares(), if is_more { "stiffer" } else { "softer" })
            }
        };
        Some(format!("{what}{}", place(stretch)))
    };
    let parts: Vec<String> = stretches.iter().filter_map(part).collect();
    let accepted: Vec<String> = stretches.iter().map(|stretch| accepted(stretch, sigma)).collect();
    (!parts.is_empty())
        .then(|| format!("{}: beyond what is accepted ({})", listed(&parts), listed(&accepted)))
}

/// "60 to 157 nm (0.2 to 0.55 σ)".
fn distances(near: f64, far: f64, sigma: f64) -> String {
    let [least, most] = [near, far].map(|at| size(ComparedQuantity::Separation, at, sigma));
    if least == most {
        return most;
    }
    let split = |text: &str| {
        let (length, part) = text.split_once(" (")?;
        Some((length.to_owned(), part.trim_end_matches(')').to_owned()))
    };
    match (split(&least), split(&most)) {
        (Some((a, b)), Some((c, d))) => format!("{} ({})", span(&a, &c, " to "), span(&b, &d, " to ")),
        _ => most,
    }
}

/// The answer over several cases in a line or two: for how many the models differ by more than is accepted, and for how many they agree.
pub fn over_all_cases(all: &[&Verdicts]) -> String {
    let has = |verdicts: &Verdicts, compared: ComparedQuantity, wanted: Verdict| {
        verdicts.stretches.iter().any(|one| one.quantity == compared && one.verdict == wanted)
    };
    let is_beyond = |verdicts: &Verdicts, compared| has(verdicts, compared, Verdict::Beyond);
    let is_within = |verdicts: &Verdicts, compared| {
        has(verdicts, compared, Verdict::Within) && !is_beyond(verdicts, compared)
    };
    let beyond = of_cases(all, &is_beyond);
    let within = of_cases(all, &is_within);
    match (beyond, within) {
        (None, None) => {
            format!("Whether the models agree cannot be told for any of the {} cases.", all.len())
        }
        (Some(beyond), None) => {
            format!("At some valid load the models differ by more than is accepted {beyond}.")
        }
        (None, Some(within)) => {
            format!(
                "The models agree within what is accepted, wherever that can be told, {within}; they differ by more in none."
            )
        }
        (Some(beyond), Some(within)) => format!(
            "At some valid load the models differ by more than is accepted {beyond}. They agree within it, wherever that can be told, {within}."
        ),
    }
}

/// "in real contact area for 2 of 7 cases, in separation for none": for how many cases something holds, by quantity; `None` where it
/// holds for none at all.
fn of_cases(all: &[&Verdicts], holds: &dyn Fn(&Verdicts, ComparedQuantity) -> bool) -> Option<String> {
    let count = |compared: ComparedQuantity| all.iter().filter(|verdicts| holds(verdicts, compared)).count();
    let counts = ORDER.map(|compared| (name(compared), count(compared)));
    let first = counts.iter().position(|(_, count)| *count > 0)?;
    let part = |(index, (name, count)): (usize, &(&str, usize))| match count {
        0 => format!("in {name} for none"),
        count => {
            format!("in {name} for {count} of {}{}", all.len(), if index == first { " cases" } else { "" })
        }
    };
    Some(listed(&counts.iter().enumerate().map(part).collect::<Vec<_>>()))
}

/// The answer over several cases (`what`: thicknesses, laws): for how many of them the models agree wherever that can be
/// told, for how many they do not at some load, and for how many it cannot be told at any.
pub fn over_cases(what: &str, all: &[&Verdicts]) -> String {
    let parts: Vec<String> = ORDER.into_iter().filter_map(|compared| counted(compared, what, all)).collect();
    format!("the difference between the models is {}.", parts.join("; "))
}

fn counted(compared: ComparedQuantity, what: &str, all: &[&Verdicts]) -> Option<String> {
    let of = |verdicts: &Verdicts, wanted: Option<Verdict>| {
        let mut stretches = verdicts.stretches.iter().filter(|stretch| stretch.quantity == compared);
        stretches.any(|stretch| wanted.is_none_or(|wanted| stretch.verdict == wanted))
    };
    let number = |is_it: &dyn Fn(&Verdicts) -> bool| all.iter().filter(|verdicts| is_it(verdicts)).count();
    let told = number(&|verdicts| of(verdicts, None));
    let beyond = number(&|verdicts| of(verdicts, Some(Verdict::Beyond)));
    let within =
        number(&|verdicts| of(verdicts, Some(Verdict::Within)) && !of(verdicts, Some(Verdict::Beyond)));
    let open = told - within - beyond;
    let parts = [
        (within, "within what is accepted wherever it can be told"),
        (beyond, "beyond what is accepted at some load"),
        (open, "unknown at every load"),
    ];
    let parts = parts.into_iter().filter(|(count, _)| *count > 0);
    let parts: Vec<String> = parts
        .map(|(count, word)| {
            let which =
                if count == told { format!("all {told} {what}") } else { format!("{count} of {told}") };
            format!("{word} for {which}")
        })
        .collect();
    (told > 0).then(|| format!("in {} {}", name(compared), listed(&parts)))
}

#[cfg(test)]
mod tests {
    use super::super::examples::{at, verdicts};
    use super::*;
    use crate::kind::compare::findings::Basis;

    const BLOCKS: Basis = Basis::Blocks { count: 16, sides: [1e-4; 2], lengths: [9.0; 2] };

    #[test]
    fn what_is_within_and_what_is_beyond_at_the_same_loads() {
        let found = verdicts(
            vec![
                at(0.5e6, 100.0, [(0.2, Some(0.01)), (0.05, Some(0.005)), (0.01, Some(0.01))]),
                at(40e6, 200.0, [(0.55, Some(0.01)), (-0.06, Some(0.005)), (-0.1, Some(0.01))]),
            ],
            BLOCKS,
        );
        assert_eq!(
            headline(&found, 285e-9),
            "Between 500 kPa and 40 MPa the statistical model agrees with the sum in real contact area within 6.76 % \
             (accepted: 10 %) and in stiffness within 11.3 % (accepted: 20 %), but puts the flat 57 to 157 nm (0.2 to 0.55 σ) \
             higher: beyond what is accepted (28.5 nm = 0.1 σ)."
        );
    }

    #[test]
    fn what_cannot_be_told_says_how_much_surface_would_tell() {
        let found = verdicts(vec![at(1e6, 100.0, [(0.05, Some(0.05)), (0.5, None), (0.5, None)])], BLOCKS);
        assert_eq!(
            headline(&found, 1e-7),
            "Whether the statistical model agrees with the sum in real contact area, separation and stiffness at 1 MPa \
             cannot be told: it would take about 4 mm² of surface (now 1 mm²) to tell at half of these loads."
        );
        let loads = [1e6, 2e6].map(|load| {
            let mut at = at(load, 100.0, [(0.5, None); 3]);
            at.area_needed = Some(f64::INFINITY);
            at
        });
        let too_small = Basis::TooSmall { correlation: [1e-5, f64::INFINITY] };
        let sentence = headline(&verdicts(loads.to_vec(), too_small), 1e-7);
        assert!(
            sentence.contains("stiffness between 1 and 2 MPa cannot be told: the map is too short"),
            "{sentence}"
        );
    }

    #[test]
    fn differences_of_both_signs_are_told_apart() {
        let [more, less] = [(0.4, Some(0.01)), (-0.5, Some(0.01))].map(|found| [found, found, found]);
        let found = verdicts(vec![at(1e6, 100.0, more), at(2e6, 100.0, less), at(4e6, 100.0, less)], BLOCKS);
        let sentence = headline(&found, 1e-7);
        assert!(
            sentence.contains("gives 39.3 % less real contact area")
                && sentence.contains("lower")
                && sentence.ends_with("see the table."),
            "{sentence}"
        );
    }

    #[test]
    fn without_a_valid_load_there_is_no_answer() {
        let few = [(1.0, Some(0.01)); 3];
        let found = verdicts(vec![at(1e6, 12.0, few), at(2e6, 20.0, few)], BLOCKS);
        assert!(headline(&found, 1e-7).starts_with(
            "Whether the statistical model agrees with the sum cannot be told at any load of this experiment: fewer than 30"
        ));
        assert_eq!(
            headline(&verdicts(Vec::new(), BLOCKS), 1e-7),
            "The models were not compared at equal load."
        );
    }

    #[test]
    fn stretches_of_different_loads_have_their_own_range() {
        let found = verdicts(
            vec![
                at(1e6, 100.0, [(0.01, Some(0.001)); 3]),
                at(1e7, 100.0, [(0.5, Some(0.001)), (0.01, Some(0.001)), (0.01, Some(0.001))]),
                at(1e8, 100.0, [(0.6, Some(0.001)), (0.01, Some(0.001)), (0.01, Some(0.001))]),
            ],
            BLOCKS,
        );
        let sentence = headline(&found, 1e-7);
        assert!(
            sentence.starts_with("The statistical model agrees with the sum in real contact area within"),
            "{sentence}"
        );
        assert!(
            sentence.contains("from 1 to 100 MPa") && sentence.contains("higher from 10 to 100 MPa"),
            "{sentence}"
        );
        assert!(sentence.ends_with("see the table."), "{sentence}");
    }

    #[test]
    fn cases_are_counted() {
        let good = verdicts(vec![at(1e6, 100.0, [(0.01, Some(0.001)); 3])], BLOCKS);
        let bad =
            verdicts(vec![at(1e6, 100.0, [(0.5, Some(0.001)), (0.01, Some(0.001)), (0.01, None)])], BLOCKS);
        assert_eq!(
            over_all_cases(&[&good, &bad]),
            "At some valid load the models differ by more than is accepted in real contact area for none, in separation for 1 of 2 cases \
             and in stiffness for none. They agree within it, wherever that can be told, in real contact area for 2 of 2 cases, in \
             separation for 1 of 2 and in stiffness for 1 of 2."
        );
    }

    #[test]
    fn the_verdict_alone_has_no_causes() {
        let far = verdicts(vec![at(1e6, 100.0, [(0.5, Some(0.001)); 3])], BLOCKS);
        assert!(
            !verdict_alone(&far, 1e-7).contains("cause")
                && headline(&far, 1e-7).starts_with(&verdict_alone(&far, 1e-7))
        );
    }

    #[test]
    fn thicknesses_are_counted() {
        let good = verdicts(vec![at(1e6, 100.0, [(0.01, Some(0.001)); 3])], BLOCKS);
        let bad =
            verdicts(vec![at(1e6, 100.0, [(0.5, Some(0.001)), (0.01, Some(0.001)), (0.01, None)])], BLOCKS);
        assert_eq!(
            over_cases("thicknesses", &[&good, &bad]),
            "the difference between the models is in real contact area within what is accepted wherever it can be told for all 2 \
             thicknesses; in separation within what is accepted wherever it can be told for 1 of 2 and beyond what is accepted at some load for \
             1 of 2; in stiffness within what is accepted wherever it can be told for 1 of 2 and unknown at every load for 1 \
             of 2."
        );
    }
}
