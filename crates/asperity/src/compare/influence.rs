//! Effects of contact law and summation method: several laws on one surface at equal load.

use super::{ComparedQuantity, Difference, ModelKind, Pair, Pairing};
use crate::model::{Exceeded, Response};
use crate::named_enum;
use crate::numeric::extremes;

/// A gap between the models of at most this number of sampling errors is not detected.
pub const DETECTABLE: f64 = 2.0;

named_enum! {
    /// Quantities in which laws and models are compared at equal load. The mean contact pressure is not listed separately:
    /// at equal load it is inversely proportional to the area.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Measure {
        /// d/sigma, compared by difference.
        Separation = "separation_over_sigma",
        /// A/A_nom, compared by the logarithm of the ratio.
        Area = "area_ratio",
    }
}

impl Measure {
    /// The difference of `value` from `other`; 0 if they differ by rounding only.
    fn difference(self, value: &Response, other: &Response) -> f64 {
        /// Rounding error of a separation at a given load.
        const ROUNDING: f64 = 1e-9;
        let difference = match self {
            Self::Separation => value.separation_over_sigma - other.separation_over_sigma,
            Self::Area => (value.area_ratio.total() / other.area_ratio.total()).ln(),
        };
        if difference.abs() > ROUNDING { difference } else { 0.0 }
    }

    /// The standard error of the difference between the models, where an interval is claimed.
    fn sampling_error(self, difference: &Difference) -> Option<f64> {
        let quantity = match self {
            Self::Separation => ComparedQuantity::Separation,
            Self::Area => ComparedQuantity::Area,
        };
        difference.estimates[quantity as usize]?.error
    }
}

/// Both models on one surface under one law.
#[derive(Debug, Clone, Copy)]
pub struct UnderLaw<'a> {
    /// The law, as tables name it.
    pub law: &'a str,
    /// Whether contacts change from elastic to another regime; a law of one regime is a limiting case.
    pub is_elastic_plastic: bool,
    /// All pairs; those at equal load are used.
    pub pairs: &'a [Pair],
    /// The differences between the models at equal load, for their sampling errors.
    pub differences: &'a [Difference],
}

named_enum! {
    /// The laws included in a spread.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Group {
        /// All laws.
        All = "all",
        /// Elastic-plastic laws only.
        ElasticPlastic = "elastic-plastic",
    }
}

/// Differences between laws and between models, each defined by its [`Measure`].
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// The laws; the others are compared with the first.
    pub laws: Vec<String>,
    /// Whether contacts change from elastic to another regime, by law.
    pub is_elastic_plastic: Vec<bool>,
    /// The loads, ascending; the same for every law.
    pub loads: Vec<AtLoad>,
}

/// All laws and both models at one load.
#[derive(Debug, Clone, PartialEq)]
pub struct AtLoad {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// The smallest effective number of contacts over the laws.
    pub fewest_contacts: f64,
    /// The limits of admissible loads that are exceeded under some law.
    pub exceeded: Exceeded,
    /// A/A_nom of the deterministic model under the first law.
    pub area_ratio: f64,
    /// Which laws are elastic-plastic.
    elastic_plastic: Vec<bool>,
    /// By measure.
    differences: [Differences; 2],
}

/// All laws and both models at one load by one measure.
#[derive(Debug, Clone, PartialEq)]
struct Differences {
    /// Deviation of each law from the first, in both models.
    deviations: Vec<[f64; 2]>,
    /// Statistical minus deterministic, by law.
    gaps: Vec<f64>,
    /// Standard errors of the gaps, by law.
    errors: Vec<Option<f64>>,
}

impl AtLoad {
    fn differences(&self, measure: Measure) -> &Differences {
        &self.differences[measure as usize]
    }

    fn is_in(&self, group: Group, law: usize) -> bool {
        group == Group::All || self.elastic_plastic[law]
    }

    /// The range of the laws of a group under a model, from lowest to highest; `None` for fewer than two laws.
    pub fn spread(&self, measure: Measure, group: Group, kind: ModelKind) -> Option<f64> {
        self.spread_without(measure, group, kind, None)
    }

    /// The spread over the group except one law.
    pub fn spread_without(
        &self,
        measure: Measure,
        group: Group,
        kind: ModelKind,
        without: Option<usize>,
    ) -> Option<f64> {
        let deviations = self.differences(measure).deviations.iter().enumerate();
        let members = deviations.filter(|(law, _)| self.is_in(group, *law) && Some(*law) != without);
        let values: Vec<f64> = members.map(|(_, deviation)| deviation[kind as usize]).collect();
        let [low, high] = extremes(values.iter().copied())?;
        (values.len() > 1).then_some(high - low)
    }

    /// Deviation of a law from the first one.
    pub fn deviation(&self, measure: Measure, law: usize, kind: ModelKind) -> f64 {
        self.differences(measure).deviations[law][kind as usize]
    }

    /// Statistical minus deterministic under a law.
    pub fn gap(&self, measure: Measure, law: usize) -> f64 {
        self.differences(measure).gaps[law]
    }

    /// The standard error of the gap under a law.
    pub fn sampling_error(&self, measure: Measure, law: usize) -> Option<f64> {
        self.differences(measure).errors[law]
    }

    /// The law of a group with the largest gap between the models, and that gap.
    pub fn largest_gap(&self, measure: Measure, group: Group) -> Option<(usize, f64)> {
        let gaps = self.differences(measure).gaps.iter().copied().enumerate();
        gaps.filter(|(law, _)| self.is_in(group, *law)).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }
}

/// A difference over the admissible loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// Mean magnitude.
    pub mean: f64,
    /// The value of largest magnitude, signed.
    pub largest: f64,
    /// The load of the largest magnitude, Pa.
    pub at: f64,
}

impl Influence {
    /// Compares at least one law on a surface.
    pub fn new(laws: &[UnderLaw]) -> Self {
        let at_load = |pairs: &'_ [Pair], target: f64| {
            pairs.iter().find(|pair| pair.pairing == Pairing::Load && pair.target == target).copied()
        };
        let first = laws.first().map_or(&[][..], |law| law.pairs).iter();
        let mut targets: Vec<f64> =
            first.filter(|pair| pair.pairing == Pairing::Load).map(|pair| pair.target).collect();
        targets.sort_unstable_by(f64::total_cmp);
        targets.dedup();
        let elastic_plastic: Vec<bool> = laws.iter().map(|law| law.is_elastic_plastic).collect();
        let at = |target: f64| {
            let pairs: Option<Vec<Pair>> = laws.iter().map(|law| at_load(law.pairs, target)).collect();
            let difference = |law: &UnderLaw| law.differences.iter().find(|at| at.load == target).cloned();
            let differences: Vec<Option<Difference>> = laws.iter().map(difference).collect();
            pairs.map(|pairs| compared(target, &pairs, &differences, &elastic_plastic))
        };
        Self {
            laws: laws.iter().map(|law| law.law.to_owned()).collect(),
            loads: targets.into_iter().filter_map(at).collect(),
            is_elastic_plastic: elastic_plastic,
        }
    }

    /// The admissible loads.
    pub fn counting(&self) -> impl Iterator<Item = &AtLoad> {
        self.loads.iter().filter(|at| at.exceeded.is_none())
    }

    /// Mean and largest magnitude of a difference over the admissible loads; `None` if it is known at none.
    pub fn effect(&self, difference: impl Fn(&AtLoad) -> Option<f64>) -> Option<Effect> {
        let known: Vec<(f64, f64)> =
            self.counting().filter_map(|at| Some((at.pressure, difference(at)?))).collect();
        let (at, largest) = *known.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        let mean = known.iter().map(|(_, value)| value.abs()).sum::<f64>() / known.len() as f64;
        Some(Effect { mean, largest, at })
    }

    /// The effect of the law under a model: the spread of the laws.
    pub fn of_law(&self, measure: Measure, group: Group, kind: ModelKind) -> Option<Effect> {
        self.effect(|at| at.spread(measure, group, kind))
    }

    /// The effect of the summation method under a law: statistical against deterministic.
    pub fn of_summation(&self, measure: Measure, law: usize) -> Option<Effect> {
        self.effect(|at| Some(at.gap(measure, law)))
    }

    /// The effect of a law instead of the first one under a model.
    pub fn of_choice(&self, measure: Measure, law: usize, kind: ModelKind) -> Option<Effect> {
        self.effect(|at| Some(at.deviation(measure, law, kind)))
    }

    /// The gap between the models under a law, in sampling errors of the sum.
    pub fn of_standard_errors(&self, measure: Measure, law: usize) -> Option<Effect> {
        self.effect(|at| Some(at.gap(measure, law) / at.sampling_error(measure, law)?))
    }

    /// The laws to compare: the elastic-plastic ones, or all if fewer than two are.
    pub fn group(&self) -> Group {
        let elastic_plastic = self.is_elastic_plastic.iter().filter(|passes| **passes).count();
        if elastic_plastic > 1 { Group::ElasticPlastic } else { Group::All }
    }

    /// The sampling errors of the sums under a law.
    pub fn of_sampling(&self, measure: Measure, law: usize) -> Option<Effect> {
        self.effect(|at| at.sampling_error(measure, law))
    }
}

/// Compares one pair per law at the load `pressure`.
fn compared(
    pressure: f64,
    pairs: &[Pair],
    differences: &[Option<Difference>],
    elastic_plastic: &[bool],
) -> AtLoad {
    let contacts = pairs.iter().filter_map(|pair| Some(pair.deterministic.sharing?.effective_contacts));
    AtLoad {
        pressure,
        fewest_contacts: contacts.reduce(f64::min).unwrap_or_default(),
        exceeded: pairs.iter().map(Pair::exceeded).fold(Exceeded::default(), Exceeded::union),
        area_ratio: pairs.first().map_or(0.0, |pair| pair.deterministic.area_ratio.total()),
        elastic_plastic: elastic_plastic.to_vec(),
        differences: Measure::ALL.map(|measure| differences_by(measure, pairs, differences)),
    }
}

fn differences_by(measure: Measure, pairs: &[Pair], differences: &[Option<Difference>]) -> Differences {
    let from_first = |pair: &Pair| {
        let first = &pairs[0];
        [
            measure.difference(&pair.statistical, &first.statistical),
            measure.difference(&pair.deterministic, &first.deterministic),
        ]
    };
    Differences {
        deviations: pairs.iter().map(from_first).collect(),
        gaps: pairs.iter().map(|pair| measure.difference(&pair.statistical, &pair.deterministic)).collect(),
        errors: differences.iter().map(|at| measure.sampling_error(at.as_ref()?)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::CaseSampling;
    use crate::compare::tests::{pair, response};

    /// (load, statistical d/sigma and area, deterministic ones)
    fn pairs<const N: usize>(points: [(f64, [f64; 2], [f64; 2]); N]) -> Vec<Pair> {
        let of = |[h, area]: [f64; 2]| response(h, area, Some(50.0));
        points.into_iter().map(|(load, s, d)| pair(load, of(s), of(d))).collect()
    }

    fn under<'a>(law: &'a str, is_elastic_plastic: bool, pairs: &'a [Pair]) -> UnderLaw<'a> {
        UnderLaw { law, is_elastic_plastic, pairs, differences: &[] }
    }

    #[test]
    fn spreads_gaps_and_errors_at_one_load() {
        let first = pairs([(1.0, [3.0, 2e-3], [2.5, 1e-3])]);
        let second = pairs([(1.0, [3.1, 1e-3], [2.7, 1.5e-3])]);
        let limit = pairs([(1.0, [2.0, 4e-3], [2.4, 9e-3])]);
        let laws = [under("a", true, &first), under("b", true, &second), under("c", false, &limit)];
        let found = Influence::new(&laws);
        let [at] = &found.loads[..] else { panic!("one load") };
        assert!(at.exceeded.is_none() && at.fewest_contacts == 50.0 && at.area_ratio == 1e-3);
        let (close, ln2) = (|a: f64, b: f64| (a - b).abs() < 1e-12, 2f64.ln());
        let spread = |measure, group, kind| at.spread(measure, group, kind).unwrap();
        assert!(close(spread(Measure::Separation, Group::All, ModelKind::Statistical), 1.1));
        assert!(close(spread(Measure::Area, Group::All, ModelKind::Deterministic), 9f64.ln()));
        assert!(close(spread(Measure::Area, Group::ElasticPlastic, ModelKind::Deterministic), 1.5f64.ln()));
        let without =
            |law| at.spread_without(Measure::Separation, Group::All, ModelKind::Statistical, Some(law));
        assert!(close(without(2).unwrap(), 0.1) && close(without(1).unwrap(), 1.0));
        assert_eq!(
            at.spread_without(Measure::Area, Group::ElasticPlastic, ModelKind::Statistical, Some(0)),
            None
        );
        assert!(close(at.deviation(Measure::Area, 1, ModelKind::Statistical), -ln2));
        assert!(close(at.gap(Measure::Separation, 0), 0.5) && close(at.gap(Measure::Area, 0), ln2));
        let (law, gap) = at.largest_gap(Measure::Area, Group::All).unwrap();
        assert!(law == 2 && close(gap, (4.0f64 / 9.0).ln()));
        assert_eq!(at.largest_gap(Measure::Area, Group::ElasticPlastic).unwrap().0, 0);
        assert_eq!(at.sampling_error(Measure::Separation, 0), None);
    }

    #[test]
    fn weights_are_over_the_loads_that_count_and_all_laws_have() {
        let first = pairs([
            (4.0, [3.0, 1e-2], [2.0, 1e-2]),
            (1.0, [3.0, 1e-3], [2.0, 1e-3]),
            (2.0, [3.0, 1e-3], [5.0, 1e-3]),
            (3.0, [9.0, 1e-3], [0.0, 1e-3]),
        ]);
        // At 4 asperities interact under this law; 3 it does not have.
        let second = pairs([
            (1.0, [3.5, 1e-3], [2.25, 1e-3]),
            (2.0, [3.0, 1e-3], [4.25, 1e-3]),
            (4.0, [3.0, 0.06], [2.0, 1e-2]),
        ]);
        let found = Influence::new(&[under("a", true, &first), under("b", false, &second)]);
        let loads: Vec<(f64, bool)> =
            found.loads.iter().map(|at| (at.pressure, at.exceeded.is_none())).collect();
        assert_eq!(loads, [(1.0, true), (2.0, true), (4.0, false)]);
        let gap = found.of_summation(Measure::Separation, 0).unwrap();
        assert_eq!(gap, Effect { mean: 1.5, largest: -2.0, at: 2.0 });
        let law = found.of_law(Measure::Separation, Group::All, ModelKind::Deterministic).unwrap();
        assert_eq!(law, Effect { mean: 0.5, largest: 0.75, at: 2.0 });
        let choice = found.of_choice(Measure::Separation, 1, ModelKind::Deterministic).unwrap();
        assert_eq!(choice, Effect { mean: 0.5, largest: -0.75, at: 2.0 });
        assert_eq!(found.of_law(Measure::Separation, Group::ElasticPlastic, ModelKind::Deterministic), None);
    }

    #[test]
    fn few_contacts_under_one_law_do_not_count() {
        let mut few = pairs([(1.0, [3.0, 1e-3], [2.0, 1e-3])]);
        let many = few.clone();
        few[0].deterministic.sharing.as_mut().unwrap().effective_contacts = 29.0;
        let found = Influence::new(&[under("a", true, &many), under("b", true, &few)]);
        assert!(!found.loads[0].exceeded.is_none() && found.loads[0].fewest_contacts == 29.0);
    }

    #[test]
    fn the_error_of_the_gap_is_that_of_the_interval() {
        let one = pairs([(1.0, [3.0, 2e-3], [2.5, 1e-3])]);
        let mut differences = Difference::at_loads(&one, &CaseSampling::default());
        let estimates = &mut differences[0].estimates;
        estimates[ComparedQuantity::Separation as usize].as_mut().unwrap().error = Some(0.2);
        estimates[ComparedQuantity::Separation as usize].as_mut().unwrap().independent_error = Some(0.1);
        estimates[ComparedQuantity::Area as usize].as_mut().unwrap().independent_error = Some(0.3);
        let law = UnderLaw { differences: &differences, ..under("a", true, &one) };
        let at = &Influence::new(&[law]).loads[0];
        assert_eq!(at.sampling_error(Measure::Separation, 0), Some(0.2));
        assert_eq!(at.sampling_error(Measure::Area, 0), None, "independent draws are no basis");
    }
}
