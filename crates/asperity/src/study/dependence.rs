//! Which choices in the analysis of a map decide its verdicts.

use crate::compare::{Accepted, ComparedQuantity, Difference, Estimate, Verdict};

use super::treatment::{Choice, Treatment};

/// The differences between the models in a case under one treatment of a map.
#[derive(Debug)]
pub struct Treated {
    /// The treatment.
    pub treatment: Treatment,
    /// At loads of the map's own verdicts; empty where the treated map has no asperities or a model does not reach a load.
    pub differences: Vec<Difference>,
}

/// A verdict that depends on a choice: at one load two ways of making it give different answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dependence {
    /// The choice.
    pub choice: Choice,
    /// The quantity.
    pub quantity: ComparedQuantity,
    /// The load (Pa) at which the answers are furthest apart.
    pub load: f64,
    /// Indices of the treatments with the lowest and the highest difference there; `None` for the map's own.
    pub treatments: [Option<usize>; 2],
    /// Their contrasts.
    pub contrasts: [f64; 2],
}

/// One answer at a load: the treatment, the contrast, and where it lies relative to what is accepted.
#[derive(Debug, Clone, Copy)]
struct Answer {
    treatment: Option<usize>,
    estimate: Estimate,
    side: Side,
}

/// Where a difference lies: below, inside or above the accepted band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Inside,
    Above,
    /// An interval that crosses an edge.
    Open,
}

impl Side {
    /// By the interval where there is one, else by the difference itself.
    fn from_estimate(estimate: &Estimate, band: [f64; 2]) -> Self {
        let is_known =
            estimate.interval().is_none() || Verdict::from_estimate(estimate, band) != Verdict::CannotTell;
        match estimate.contrast {
            _ if !is_known => Self::Open,
            below if below < band[0] => Self::Below,
            above if above > band[1] => Self::Above,
            _ => Self::Inside,
        }
    }
}

impl Dependence {
    /// Of the map's own `differences` in a case, and of those under other treatments: for each choice and quantity the one at which the
    /// answers are furthest apart.
    pub fn all(differences: &[Difference], treated: &[Treated], accepted: &Accepted) -> Vec<Self> {
        let each = Choice::ALL
            .into_iter()
            .flat_map(|choice| ComparedQuantity::ALL.map(|quantity| (choice, quantity)));
        let width = |found: &Self| found.contrasts[1] - found.contrasts[0];
        let furthest = |(choice, quantity)| {
            let at_load = |own| Self::at_load(choice, quantity, own, treated, accepted);
            differences.iter().filter_map(at_load).max_by(|a, b| width(a).total_cmp(&width(b)))
        };
        each.filter_map(furthest).collect()
    }

    /// At the load of one of the map's `own` differences: where two treatments give opposite answers, or one leaves open what the
    /// map's own decides.
    pub fn at_load(
        choice: Choice,
        quantity: ComparedQuantity,
        own: &Difference,
        treated: &[Treated],
        accepted: &Accepted,
    ) -> Option<Self> {
        if !own.exceeded().is_none() {
            return None;
        }
        let band = accepted.band(quantity);
        let answer = |treatment: Option<usize>, at: &Difference| {
            let estimate = at.estimates[quantity as usize].filter(|_| at.exceeded().is_none())?;
            Some(Answer { treatment, estimate, side: Side::from_estimate(&estimate, band) })
        };
        let treated = treated.iter().enumerate().filter(|(_, one)| one.treatment.choice() == choice);
        let others = treated.filter_map(|(place, one)| {
            let at = one.differences.iter().find(|at| at.load == own.load)?;
            answer(Some(place), at)
        });
        let own_answer = answer(None, own);
        let answers: Vec<Answer> = own_answer.into_iter().chain(others).collect();
        let by_contrast = |a: &&Answer, b: &&Answer| a.estimate.contrast.total_cmp(&b.estimate.contrast);
        let lowest = *answers.iter().min_by(by_contrast)?;
        let highest = *answers.iter().max_by(by_contrast)?;
        let between = |[a, b]: [Answer; 2]| Self {
            choice,
            quantity,
            load: own.load,
            treatments: [a, b].map(|answer| answer.treatment),
            contrasts: [a, b].map(|answer| answer.estimate.contrast),
        };
        if lowest.is_opposite(&highest, choice, band) {
            return Some(between([lowest, highest]));
        }
        let own_answer = own_answer.filter(|_| choice.leaves_open())?;
        let opened = answers.iter().filter(|answer| own_answer.is_opened_by(answer, band));
        let distance = |answer: &Answer| (answer.estimate.contrast - own_answer.estimate.contrast).abs();
        let furthest = *opened.max_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let mut pair = [own_answer, furthest];
        pair.sort_by(|a, b| a.estimate.contrast.total_cmp(&b.estimate.contrast));
        Some(between(pair))
    }
}

impl Answer {
    /// Whether `higher` is another answer than this lower one.
    fn is_opposite(&self, higher: &Self, choice: Choice, band: [f64; 2]) -> bool {
        self.side != higher.side
            && ![self.side, higher.side].contains(&Side::Open)
            // Without intervals a difference at the edge of what is accepted decides nothing, nor does one between parts of the map,
            // which are other samples.
            && ([self, higher].iter().all(|one| one.estimate.interval().is_some())
                || (choice != Choice::Part
                    && higher.estimate.contrast - self.estimate.contrast > band[1]))
    }

    /// Whether this answer rests on an interval which, moved to the difference of `other`, would cross an edge of the `band`: an
    /// interval that is only wider, because the treatment leaves fewer contacts, opens nothing.
    fn is_opened_by(&self, other: &Self, band: [f64; 2]) -> bool {
        let moved = Estimate { contrast: other.estimate.contrast, ..self.estimate };
        self.estimate.interval().is_some()
            && self.side != Side::Open
            && Side::from_estimate(&moved, band) == Side::Open
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MeanRadius;
    use crate::compare::tests::{self, sharing};

    /// A separation that differs by `contrast`, with an interval of twice `error` on both sides.
    fn at(contrast: f64, error: f64) -> Difference {
        tests::at(1.0, 90.0, contrast, Some(error))
    }

    /// What the verdict on `own` depends on, if `treatment` gives `other`; 0.1 sigma are accepted.
    fn dependence(own: &Difference, treatment: Treatment, other: Difference) -> Option<[f64; 2]> {
        let treated = [Treated { treatment, differences: vec![other] }];
        let quantity = ComparedQuantity::Separation;
        Dependence::at_load(treatment.choice(), quantity, own, &treated, &Accepted::DEFAULT)
            .map(|found| found.contrasts)
    }

    #[test]
    fn opposite_answers_are_a_dependence_on_any_choice() {
        let radius = Treatment::MeanRadius(MeanRadius::InverseMeanCurvature);
        for treatment in [radius, Treatment::SuspectsRemoved(3), Treatment::Half(0)] {
            assert_eq!(dependence(&at(0.2, 0.01), treatment, at(0.05, 0.01)), Some([0.05, 0.2]));
            assert_eq!(dependence(&at(0.2, 0.01), treatment, at(0.25, 0.01)), None);
            assert_eq!(dependence(&at(0.11, 0.02), treatment, at(0.05, 0.01)), None, "the own is open");
        }
    }

    /// Where the map's own load is not admissible there is no verdict that could depend on anything.
    #[test]
    fn no_verdict_depends_on_nothing() {
        let own = Difference { sharing: Some(sharing(9.0)), ..at(0.2, 0.01) };
        let filters = [at(0.05, 0.01), at(0.3, 0.01)]
            .map(|other| Treated { treatment: Treatment::ShortWaves(None), differences: vec![other] });
        let found = |own: &Difference| {
            let quantity = ComparedQuantity::Separation;
            Dependence::at_load(Choice::ShortWaves, quantity, own, &filters, &Accepted::DEFAULT).is_some()
        };
        assert!(!found(&own) && found(&at(0.2, 0.01)));
    }

    #[test]
    fn points_that_may_be_wrong_open_a_verdict_that_others_do_not() {
        let (decided, open) = (at(0.2, 0.01), at(0.11, 0.01));
        assert_eq!(dependence(&decided, Treatment::SuspectsRemoved(3), open.clone()), Some([0.11, 0.2]));
        assert_eq!(dependence(&decided, Treatment::SpikesRemoved, open.clone()), Some([0.11, 0.2]));
        assert_eq!(dependence(&decided, Treatment::Half(1), open.clone()), None);
        assert_eq!(dependence(&decided, Treatment::ShortWaves(None), open.clone()), None);
        assert_eq!(dependence(&open, Treatment::SuspectsRemoved(3), open.clone()), None);
        // The interval is wider, but the difference has not moved.
        assert_eq!(dependence(&decided, Treatment::SuspectsRemoved(3), at(0.2, 0.09)), None);
    }
}
