//! The answer on one case, from typed facts: what the models say at the load, what holds on the map, and what holds of such surfaces.

use asperity::compare::{ComparedQuantity, Stretch};
use asperity::numeric::{two_digits, two_digits_up};
use asperity::study::{CaseStudy, Choice, Verdicts};
use asperity::surface::Surface;
use asperity_contact_framework::report::format::{input_quantity, listed};

use super::at_load::{area as area_text, results};
use super::limit::not_admissible;
use super::replace;
use crate::presentation::quantity_name;
use crate::surface::fitness;

/// The order in which quantities are spoken of.
pub const ORDER: [ComparedQuantity; 3] =
    [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness];

/// The answer on one surface under one law and thickness: the results at the load, whether the integral may replace the sum there on this
/// map, and on such surfaces, and what holds of such surfaces at the other loads. The load acts on `load_area` (m²).
pub fn answer(case: &CaseStudy, surface: &Surface, load_area: f64) -> Vec<String> {
    let verdicts = &case.verdicts;
    let mut sentences: Vec<String> = results(case, surface, load_area).into_iter().collect();
    let Some(at) = case.reported_load() else { return sentences };
    sentences.extend(replace::on_map(at, verdicts));
    if let Some(fault) = fitness::next_step(surface) {
        sentences.push(format!("On such surfaces: no conclusion until the map is fit. Next step: {fault}."));
        return sentences;
    }
    let is_admissible = at.exceeded().is_none();
    let here = if is_admissible { replace::on_surface(at, verdicts) } else { not_admissible(case, at) };
    let of_surface = std::iter::once(here).chain(by_load(verdicts)).chain(dependence(case));
    sentences.push(of_surface.collect::<Vec<_>>().join(" "));
    sentences
}

/// What holds of such surfaces over several loads, surely or very likely: every stretch of load with a conclusion; `None` where no load
/// is admissible.
fn by_load(verdicts: &Verdicts) -> Option<String> {
    if verdicts.differences.len() < 2 || verdicts.admissible.stretches.is_empty() {
        return None;
    }
    let told: Vec<String> = ORDER.into_iter().filter_map(|quantity| told(verdicts, quantity)).collect();
    let admissible: Vec<String> = verdicts.admissible.stretches.iter().map(|loads| over(*loads)).collect();
    let admissible = listed(&admissible);
    if told.is_empty() {
        return Some(format!("It cannot be told at any admissible load ({admissible})."));
    }
    let is_open = verdicts.stretches.iter().any(|one| !one.verdict.is_told());
    let rest = if is_open { "; elsewhere it cannot be told" } else { "" };
    Some(format!("At admissible loads ({admissible}), surely or very likely: {}{rest}.", told.join("; ")))
}

/// "real contact area beyond from 0.5 MPa to 4 MPa and within from 9 MPa to 40 MPa".
fn told(verdicts: &Verdicts, quantity: ComparedQuantity) -> Option<String> {
    let stretches: Vec<&Stretch> = verdicts.stretches.iter().filter(|one| one.quantity == quantity).collect();
    let side = |one: &Stretch| {
        let is_above = one.largest.is_some_and(|(_, estimate)| estimate.contrast > 0.0);
        (one.verdict.is_beyond(), one.verdict.is_within(), one.verdict.is_beyond() && is_above)
    };
    let are_neighbours = |a: &Stretch, b: &Stretch| {
        let mut admissible = verdicts.admissible.stretches.iter();
        admissible.any(|[from, to]| *from <= a.loads[0] && b.loads[1] <= *to)
    };
    let sides = stretches.chunk_by(|a, b| side(a) == side(b) && are_neighbours(a, b));
    let mut said = "";
    let words = |stretches: &[&Stretch]| {
        let loads = over([stretches[0].loads[0], stretches[stretches.len() - 1].loads[1]]);
        let name = if stretches[0].verdict.is_beyond() { "beyond " } else { "within " };
        stretches[0].verdict.is_told().then(|| {
            let name = if std::mem::replace(&mut said, name) == name { "" } else { name };
            format!("{name}{loads}")
        })
    };
    let each: Vec<String> = sides.filter_map(words).collect();
    (!each.is_empty()).then(|| format!("{} {}", quantity_name(quantity), listed(&each)))
}

/// The choices in the analysis of the map on which a verdict depends.
fn dependence(case: &CaseStudy) -> Option<String> {
    let is_one = |choice: &&Choice| case.dependences.iter().any(|one| one.choice == **choice);
    let names: Vec<String> =
        Choice::ALL.iter().filter(is_one).map(|choice| choice_words(*choice).to_owned()).collect();
    (!names.is_empty()).then(|| format!("A verdict depends on {}.", listed(&names)))
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

/// A nominal area (m²) with two digits, rounded `up` or to the nearest.
pub fn nominal_area(area: f64, up: bool) -> String {
    area_text(if up { two_digits_up(area) } else { two_digits(area) })
}

/// "from 0.5 MPa to 40 MPa", or "at 1 MPa".
pub fn over([from, to]: [f64; 2]) -> String {
    let [first, last] = [from, to].map(|load| input_quantity(load, "Pa"));
    if from == to { format!("at {first}") } else { format!("from {first} to {last}") }
}

#[cfg(test)]
mod tests {
    use asperity::compare::{AdmissibleRange, Difference};

    use super::super::examples::verdicts;
    use super::*;

    #[test]
    fn every_stretch_of_loads_with_a_conclusion_is_named() {
        let text = |contrasts, error| by_load(&verdicts(90.0, contrasts, error)).unwrap();
        let admissible =
            "At admissible loads (from 1 MPa to 10 MPa), surely or very likely: real contact area ";
        assert_eq!(text([0.2, 0.3], Some(0.01)), format!("{admissible}beyond from 1 MPa to 10 MPa."));
        assert_eq!(
            text([0.2, 0.01], Some(0.01)),
            format!("{admissible}beyond at 1 MPa and within at 10 MPa.")
        );
        assert_eq!(
            text([0.2, 0.1], Some(0.01)),
            format!("{admissible}beyond at 1 MPa; elsewhere it cannot be told.")
        );
        assert_eq!(
            text([0.2, 0.3], None),
            "It cannot be told at any admissible load (from 1 MPa to 10 MPa)."
        );
        assert_eq!(by_load(&verdicts(9.0, [0.2, 0.3], Some(0.01))), None);
    }

    #[test]
    fn a_stretch_ends_at_a_load_that_is_not_admissible() {
        let mut with_few = verdicts(90.0, [0.2, 0.3], Some(0.01));
        let few = verdicts(9.0, [0.2, 0.3], Some(0.01)).differences.remove(0);
        with_few.differences.insert(1, Difference { load: 3e6, ..few });
        with_few.stretches = Stretch::all(&with_few.differences, &with_few.accepted);
        let loads = with_few.differences.iter().map(|at| (at.load, at.exceeded()));
        with_few.admissible = AdmissibleRange::new(loads);
        assert_eq!(
            by_load(&with_few).unwrap(),
            "At admissible loads (at 1 MPa and at 10 MPa), surely or very likely: real contact area beyond at 1 MPa and at 10 MPa."
        );
    }
}
