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
    /// Of the map's own `differences` in a case, and of those under other treatments.
    pub fn all(differences: &[Difference], treated: &[Treated], accepted: &Accepted) -> Vec<Self> {
        let each = Choice::ALL
            .into_iter()
            .flat_map(|choice| ComparedQuantity::ALL.map(|quantity| (choice, quantity)));
        each.filter_map(|(choice, quantity)| Self::new(choice, quantity, differences, treated, accepted))
            .collect()
    }

    fn new(
        choice: Choice,
        quantity: ComparedQuantity,
        differences: &[Difference],
        treated: &[Treated],
        accepted: &Accepted,
    ) -> Option<Self> {
        let band = accepted.band(quantity);
        let answer = |treatment: Option<usize>, at: &Difference| {
            let estimate = at.estimates[quantity as usize].filter(|_| at.exceeded().is_none())?;
            Some(Answer { treatment, estimate, side: Side::from_estimate(&estimate, band) })
        };
        let treated = || treated.iter().enumerate().filter(|(_, one)| one.treatment.choice() == choice);
        let at_load = |own: &Difference| {
            let others = treated().filter_map(|(place, one): (usize, &Treated)| {
                let at = one.differences.iter().find(|at| at.load == own.load)?;
                answer(Some(place), at)
            });
            let answers: Vec<Answer> = answer(None, own).into_iter().chain(others).collect();
            let by_contrast = |a: &&Answer, b: &&Answer| a.estimate.contrast.total_cmp(&b.estimate.contrast);
            let lowest = answers.iter().min_by(by_contrast)?;
            let highest = answers.iter().max_by(by_contrast)?;
            let is_apart = lowest.side != highest.side
                && ![lowest.side, highest.side].contains(&Side::Open)
                // Without intervals a difference at the edge of what is accepted decides nothing, nor does one between parts of
                // the map, which are other samples.
                && ([lowest, highest].iter().all(|one| one.estimate.interval().is_some())
                    || (choice != Choice::Part
                        && highest.estimate.contrast - lowest.estimate.contrast > band[1]));
            is_apart.then_some(Self {
                choice,
                quantity,
                load: own.load,
                treatments: [lowest.treatment, highest.treatment],
                contrasts: [lowest.estimate.contrast, highest.estimate.contrast],
            })
        };
        let width = |found: &Self| found.contrasts[1] - found.contrasts[0];
        differences.iter().filter_map(at_load).max_by(|a, b| width(a).total_cmp(&width(b)))
    }
}
