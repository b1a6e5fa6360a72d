//! The card of one case: at most nine labelled lines of at most 25 words, from typed facts.

mod cause;
mod certainty;
mod instead;
mod limit;
mod nearer;
mod replace;
mod row;
mod spots;
#[cfg(test)]
mod tests;

use asperity::Limit;
use asperity::compare::{ComparedQuantity, Difference};
use asperity::numeric::{two_digits, two_digits_up};
use asperity::study::{Basis, CaseStudy, Verdicts};
use asperity::surface::{MapFacts, Surface};
use asperity_contact_framework::report::answer::{CardLine, fitting};
use asperity_contact_framework::report::format::{listed, number, quantity};
pub use nearer::Nearer;
pub use row::{CaseAnswer, Counts};

use super::correlations::Correlated;
use super::rows::SurfaceCase;
use crate::presentation::quantity_name;
use crate::surface::fitness::without_advice;

/// One case with what its card needs.
#[derive(Clone)]
pub struct Card<'a> {
    case: &'a CaseStudy,
    surface: &'a Surface,
    /// The area that the load acts on, m².
    load_area: f64,
    /// Why the difference is not divided among causes; `None` where it is.
    undivided: Option<&'static str>,
    /// Whether heat flows through a medium in the gap, too.
    has_medium: bool,
    /// The correlations of the conductances that are asked for, or why there are none.
    correlations: Result<Vec<Correlated>, &'static str>,
}

/// What the load of a card allows to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Unfit,
    /// Asperities interact or strain too much: neither model is for this load.
    NeitherModel,
    /// Too few contacts for a statement about such surfaces; the sum over this one is exact.
    FewContacts,
    Admissible,
}

impl<'a> Card<'a> {
    pub fn new(case: SurfaceCase<'a>) -> Self {
        let results = case.surface;
        Self {
            case: case.case,
            surface: &results.surface,
            load_area: results.load_area,
            undivided: results.realisations[0].model.undivided(),
            has_medium: results.spots.medium.is_some(),
            correlations: Correlated::all(case),
        }
    }

    pub fn lines(&self) -> Vec<CardLine> {
        let result = match self.case.reported_load() {
            _ if self.is_asked() => "Result at your load",
            Some(at) if at.exceeded().is_none() => "Result at the middle admissible load",
            _ => "Result at the middle load",
        };
        let line = |key, label, texts: Vec<String>| {
            (!texts.is_empty()).then(|| CardLine { texts, ..CardLine::new(key, label, "") })
        };
        let one = |text: Option<String>| text.into_iter().collect();
        let units = self
            .surface
            .taken_for_metres
            .map(|what| format!("{what} read as metres: the file names no unit."));
        let units = line("units", "Units", one(units));
        let Some(at) = self.case.reported_load() else {
            let lines = [
                units,
                line("result", result, one(self.result())),
                line("conductance", "Conductance", self.conductances()),
                line("friction", "Friction", one(self.friction())),
                line(CardLine::ANSWER, REPLACE, vec![self.uncompared()]),
            ];
            return lines.into_iter().flatten().collect();
        };
        let lines = [
            units,
            line("result", result, one(self.result())),
            line("conductance", "Conductance", self.conductances()),
            line("friction", "Friction", one(self.friction())),
            line(CardLine::ANSWER, REPLACE, self.replace(at)),
            line("difference", "Difference", one(self.difference(at))),
            line("why", "Why", one(self.cause(at))),
            line("instead", "Use instead", one(self.instead(at))),
            line(
                "nearer",
                "Nearer to boundary elements",
                [self.nearer(at), self.nearer_in_conductance(at)].into_iter().flatten().collect(),
            ),
            line("certainty", "How sure", one(self.certainty(at))),
        ];
        lines.into_iter().flatten().collect()
    }

    /// Whether the load of the card is the one load that was asked for.
    fn is_asked(&self) -> bool {
        let curves = &self.case.first().comparison.curves;
        let mut asked: Vec<f64> = curves.iter().filter_map(|point| point.prescribed_pressure).collect();
        asked.sort_by(f64::total_cmp);
        asked.dedup();
        asked.len() == 1 || self.case.first().is_single()
    }

    fn verdicts(&self) -> &'a Verdicts {
        &self.case.verdicts
    }

    fn state(&self, at: &Difference) -> State {
        let exceeded = at.exceeded();
        if self.verdicts().is_blocked {
            State::Unfit
        } else if exceeded.limits().any(|limit| matches!(limit, Limit::Interaction | Limit::LargeStrain)) {
            State::NeitherModel
        } else if !exceeded.is_none() {
            State::FewContacts
        } else {
            State::Admissible
        }
    }

    /// What was compared: "On this map", "On these asperities", "In the mean of 8 realisations".
    fn scope(&self) -> String {
        let shifts = self.verdicts().shifts;
        if shifts > 1 {
            return format!("In the mean of {shifts} relative positions");
        }
        match self.verdicts().basis {
            Basis::Realisations(count) => format!("In the mean of {count} realisations"),
            Basis::Asperities | Basis::Unstated => "On these asperities".to_owned(),
            Basis::Blocks { .. } | Basis::TooSmall { .. } | Basis::ModelBased => "On this map".to_owned(),
        }
    }

    /// Whether boundary elements can be run on the surface.
    fn can_be_pressed(&self) -> bool {
        self.surface.map.as_ref().is_some_and(MapFacts::is_nearly_complete)
    }

    /// What there is to say where the models are not compared at equal load.
    fn uncompared(&self) -> String {
        let comparison = &self.case.first().comparison;
        if let Some(reason) = &self.surface.unscattered {
            let reason = without_advice(reason);
            let runs = if self.case.first().reference.is_some() || !self.can_be_pressed() {
                ""
            } else {
                "; run boundary elements: `models = [\"reference\"]`"
            };
            return format!("Neither applies: the map {reason}{runs}.");
        }
        if comparison.curves.is_empty() {
            "Not asked: boundary elements alone were run."
        } else if comparison.pairs.is_empty() {
            "Not asked: one model was run."
        } else if !comparison.unpaired.is_empty() {
            "Not told: at these separations one model never reaches the load of the other; separations of 4 to 0 σ suit most surfaces."
        } else if self.case.realisations.len() == 1 {
            "Not told: both models are in contact at none of the separations; give `pressure` or `force`."
        } else {
            "Not told: the realisations have no load in common; give `pressure` or `force`."
        }
        .to_owned()
    }
}

/// Whether some quantity has an interval at a load.
fn has_interval(at: &Difference) -> bool {
    at.estimates.iter().flatten().any(|one| one.interval().is_some())
}

const REPLACE: &str = "May the integral replace the sum?";

fn name(quantity: ComparedQuantity) -> &'static str {
    match quantity {
        ComparedQuantity::Area => "contact area",
        ComparedQuantity::Friction => "friction",
        other => quantity_name(other),
    }
}

fn names(quantities: impl IntoIterator<Item = ComparedQuantity>) -> String {
    listed(&quantities.into_iter().map(|one| name(one).to_owned()).collect::<Vec<_>>())
}

/// An area (m²): in mm² from 0.01 mm² to 1 m², in µm² from 0.01 µm².
fn area(area: f64) -> String {
    if (1e-8..1.0).contains(&area) {
        format!("{} mm²", number(1e6 * area))
    } else if (1e-14..1e-8).contains(&area) {
        format!("{} µm²", number(1e12 * area))
    } else {
        quantity(area, "m²")
    }
}

/// A nominal area (m²) with two digits, rounded `up` or to the nearest.
fn nominal_area(nominal: f64, up: bool) -> String {
    area(if up { two_digits_up(nominal) } else { two_digits(nominal) })
}

/// A sentence with as many of its `additions` at the end, in their order, as fit.
fn with_additions(sentence: &str, additions: &[String]) -> String {
    let text = |count: usize| format!("{sentence}{}.", additions[..count].concat());
    fitting((0..=additions.len()).rev().map(text))
}
