//! Whether the contact law or the summation method (statistical or deterministic) has the larger effect on a surface.

use super::{DETECTABLE, Effect, Group, Influence, Measure, ModelKind};
use crate::named_enum;

named_enum! {
    /// The choice with the larger effect.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Dominant {
        /// The contact law.
        Law = "contact-law",
        /// Integral against sum.
        Summation = "summation-method",
        /// Neither: their effects differ by less than 5 %.
        Equal = "equal",
        /// Not decidable: the gap between the models is within its sampling error, or that is unknown.
        Undecided = "cannot-tell",
    }
}

/// The effects of contact law and summation method on one measure, over the admissible loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dominance {
    /// The quantity compared.
    pub measure: Measure,
    /// The laws included in the spread.
    pub group: Group,
    /// Spread of these laws in the deterministic model.
    pub law: Effect,
    /// Gap between the models under the first law.
    pub summation: Effect,
    /// Standard error of the gap under the first law, where it is known.
    pub sampling: Option<Effect>,
    /// The law of the group that differs most from the first in the deterministic model, and the spread without it;
    /// `None` if fewer than two laws remain.
    pub without_furthest: Option<(usize, Effect)>,
}

/// Effects of a smaller ratio count as equal.
const EQUAL: f64 = 1.05;

impl Dominance {
    /// The effects on one measure; `None` if no load is admissible or fewer than two laws are compared.
    pub fn new(influence: &Influence, measure: Measure) -> Option<Self> {
        let group = influence.group();
        Some(Self {
            measure,
            group,
            law: influence.of_law(measure, group, ModelKind::Deterministic)?,
            summation: influence.of_summation(measure, 0)?,
            sampling: influence.of_sampling(measure, 0),
            without_furthest: without_furthest(influence, measure, group),
        })
    }

    /// The choice with the larger mean effect.
    pub fn dominant(&self) -> Dominant {
        let is_detectable = self.sampling.is_some_and(|error| self.summation.mean > DETECTABLE * error.mean);
        if !is_detectable {
            Dominant::Undecided
        } else if self.ratio() < EQUAL {
            Dominant::Equal
        } else if self.law.mean > self.summation.mean {
            Dominant::Law
        } else {
            Dominant::Summation
        }
    }

    /// The larger mean effect over the smaller one.
    pub fn ratio(&self) -> f64 {
        let (law, summation) = (self.law.mean, self.summation.mean);
        if law > summation { law / summation } else { summation / law }
    }
}

fn without_furthest(influence: &Influence, measure: Measure, group: Group) -> Option<(usize, Effect)> {
    let is_member = |law: &usize| group == Group::All || influence.is_elastic_plastic[*law];
    let members = (1..influence.laws.len()).filter(is_member);
    let effect = |law| Some((law, influence.of_choice(measure, law, ModelKind::Deterministic)?.mean));
    let (furthest, _) = members.filter_map(effect).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let rest =
        influence.effect(|at| at.spread_without(measure, group, ModelKind::Deterministic, Some(furthest)))?;
    Some((furthest, rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests::{pair, response};
    use crate::compare::{CaseSampling, Difference, Pair, UnderLaw};

    /// One load; d/sigma of the integral and of the sum, whose difference has the standard error `error` sigma.
    fn under(statistical: f64, deterministic: f64, error: f64) -> (Vec<Pair>, Vec<Difference>) {
        let response = |h| response(h, 1e-3, None);
        let pairs = vec![pair(1.0, response(statistical), response(deterministic))];
        let mut differences = Difference::at_loads(&pairs, &CaseSampling::default());
        for estimate in differences[0].estimates.iter_mut().flatten() {
            estimate.error = Some(error);
        }
        (pairs, differences)
    }

    fn dominance(all: &[(Vec<Pair>, Vec<Difference>)]) -> Option<Dominance> {
        let laws: Vec<UnderLaw> = all
            .iter()
            .map(|(pairs, differences)| UnderLaw { law: "law", is_elastic_plastic: true, pairs, differences })
            .collect();
        Dominance::new(&Influence::new(&laws), Measure::Separation)
    }

    #[test]
    fn the_law_the_summation_or_neither() {
        let of = |second: f64, error: f64| {
            dominance(&[under(3.0, 2.5, error), under(3.0, second, error)]).unwrap()
        };
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let law = of(4.0, 0.1);
        assert!(law.dominant() == Dominant::Law && close(law.ratio(), 3.0));
        assert_eq!((law.group, law.without_furthest), (Group::ElasticPlastic, None));
        let summation = of(2.75, 0.2);
        assert!(summation.dominant() == Dominant::Summation && close(summation.ratio(), 2.0));
        assert!(close(summation.summation.mean / summation.sampling.unwrap().mean, 2.5));
        assert_eq!(of(3.01, 0.1).dominant(), Dominant::Equal);
        assert_eq!(of(4.0, 0.25).dominant(), Dominant::Undecided);
        assert_eq!(dominance(&[under(3.0, 2.5, 0.1)]), None);
    }

    #[test]
    fn one_law_that_lies_far_off_is_named() {
        let pairs = [under(3.0, 2.5, 0.0), under(3.0, 2.625, 0.0), under(3.0, 9.5, 0.0)];
        let found = dominance(&pairs).unwrap();
        let (furthest, rest) = found.without_furthest.unwrap();
        assert_eq!((furthest, rest.mean, found.law.mean), (2, 0.125, 7.0));
        assert!(rest.mean < found.summation.mean);
    }
}
