//! How far both models are from the boundary element reference at equal load, and which is nearer.
//!
//! All three are on the same map, so that the sampling error of a difference is that of leaving out the same block from
//! all three. Without a block the flat stays where it is; the reference of the rest is what the other blocks carry there,
//! brought back to the load along the slopes between its loads. That neglects how a block deforms the others.

use super::difference::{
    ByQuantity, CaseSampling, ComparedQuantity, Difference, Estimate, LeftOut, Repeats, Support,
};
use super::reference::{ReferenceCurve, ReferencePoint};
use super::sampling::jackknife_error;
use super::verdict::{Accepted, Verdict};
use super::{ModelKind, Pair, Pairing};
use crate::model::{Limit, ReferencePlane, Response};

/// The distances of both models from the reference, load by load.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AgainstReference {
    /// Statistical model and reference, and deterministic model and reference: contrasts of model over reference.
    pub models: [Vec<Difference>; 2],
    /// How much farther the statistical model is from the reference than the deterministic one: the difference of the
    /// absolute contrasts.
    pub nearness: Vec<Difference>,
}

/// A state of which some values may be missing.
type Partial = ByQuantity<Option<f64>>;

/// The values of the reference, scaled.
fn of_reference(point: &ReferencePoint) -> Partial {
    ComparedQuantity::ALL.map(|quantity| point.value(quantity).map(|value| quantity.scaled(value)))
}

/// The same of a model.
fn of_model(response: &Response) -> Partial {
    ComparedQuantity::ALL.map(|quantity| quantity.value(response).map(|value| quantity.scaled(value)))
}

impl AgainstReference {
    /// From the `pairs` of both models, their `differences` in the same order, the reference on the same surface, the
    /// models without each group, and the plane from which separations are measured.
    pub fn new(
        pairs: &[Pair],
        differences: &[Difference],
        curve: &ReferenceCurve,
        sampling: &CaseSampling,
        plane: ReferencePlane,
    ) -> Self {
        let mut found = Self::default();
        let without = sampling.groups.as_ref().map(|groups| (groups, curve.without(groups, plane)));
        let at_load = pairs.iter().filter(|pair| pair.pairing == Pairing::Load);
        for (index, (pair, both)) in at_load.zip(differences).enumerate() {
            let Some(place) = curve.points.iter().position(|point| point.pressure == pair.target) else {
                continue;
            };
            let point = &curve.points[place];
            let reference = of_reference(point);
            let models = [of_model(&pair.statistical), of_model(&pair.deterministic)];
            // Both contrasts of a quantity, without each group.
            let left_out = |quantity: usize| -> Option<Vec<[f64; 2]>> {
                let (groups, reference) = without.as_ref()?;
                let of_group = |group: usize| {
                    let reference = reference[group][place][quantity]?;
                    let models = groups.states[group][index]?;
                    Some(models.map(|state| state[quantity] - reference))
                };
                (0..groups.shares.len()).map(of_group).collect()
            };
            // Of both models, and of their distances.
            let mut estimates = [ByQuantity::<Option<Estimate>>::default(); 3];
            for quantity in ComparedQuantity::ALL.map(|quantity| quantity as usize) {
                // The interval of both models says whether there are contacts enough.
                let Some(of_both) = both.estimates[quantity] else { continue };
                let Some(reference) = reference[quantity] else { continue };
                let [Some(s), Some(d)] = models.map(|model| model[quantity]) else { continue };
                let contrasts = [s - reference, d - reference];
                let left_out = left_out(quantity).filter(|_| of_both.error.is_some());
                let shares = without.as_ref().map_or(&[][..], |(groups, _)| &groups.shares);
                let error = |full: f64, of: &dyn Fn(&[f64; 2]) -> f64| {
                    let without: Vec<f64> = left_out.as_ref()?.iter().map(of).collect();
                    Some(jackknife_error(full, &without, shares))
                };
                let bound = point.bounds[quantity];
                let estimate = |contrast, error, bound| Estimate {
                    contrast,
                    error,
                    quantile: of_both.quantile,
                    bound,
                    independent_error: None,
                    support: Support::Sampled,
                };
                for model in 0..2 {
                    let contrast = contrasts[model];
                    estimates[model][quantity] =
                        Some(estimate(contrast, error(contrast, &|both| both[model]), bound));
                }
                let nearness = |[s, d]: [f64; 2]| s.abs() - d.abs();
                // An error of the reference moves both the same way, and no distance where they are on one side.
                let is_one_side = contrasts[0].signum() == contrasts[1].signum()
                    && contrasts.iter().all(|contrast| contrast.abs() > bound);
                let bound = if is_one_side { 0.0 } else { 2.0 * bound };
                let full = nearness(contrasts);
                estimates[2][quantity] = Some(estimate(full, error(full, &|&both| nearness(both)), bound));
            }
            let [s, d, nearness] = estimates.map(|estimates| Difference {
                estimates,
                // Asperities interact where the reference says so, too.
                area_ratio: both.area_ratio.max(point.area_ratio),
                ..both.clone()
            });
            found.models[0].push(s);
            found.models[1].push(d);
            found.nearness.push(nearness);
        }
        found
    }

    /// Over `repeats` of a surface: their mean.
    pub fn over(realisations: &[Self], repeats: Repeats) -> Self {
        let over = |of: &dyn Fn(&Self) -> &Vec<Difference>| {
            let each: Vec<Vec<Difference>> = realisations.iter().map(|one| of(one).clone()).collect();
            if let [only] = &each[..] { only.clone() } else { Difference::over(&each, repeats) }
        };
        Self {
            models: [over(&|one| &one.models[0]), over(&|one| &one.models[1])],
            nearness: over(&|one| &one.nearness),
        }
    }

    /// By growing load.
    #[must_use]
    pub fn sorted(mut self) -> Self {
        let [statistical, deterministic] = &mut self.models;
        for all in [statistical, deterministic, &mut self.nearness] {
            all.sort_by(|a, b| a.load.total_cmp(&b.load));
        }
        self
    }
}

impl ReferenceCurve {
    /// The reference without each group, at each of its points, scaled.
    fn without(&self, groups: &LeftOut, plane: ReferencePlane) -> Vec<Vec<Partial>> {
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        order.sort_by(|&a, &b| self.points[a].pressure.total_cmp(&self.points[b].pressure));
        let none = vec![Partial::default(); self.points.len()];
        let of_group = |group: usize| {
            let (Some(Some(rest)), false) = (groups.planes.get(group), self.blocks.is_empty()) else {
                return none.clone();
            };
            let mut found = none.clone();
            for (rank, &k) in order.iter().enumerate() {
                let neighbours = [order[rank.saturating_sub(1)], order[(rank + 1).min(order.len() - 1)]];
                found[k] = self.rest(k, neighbours, group, groups.shares[group], [plane, *rest]);
            }
            found
        };
        (0..groups.shares.len()).map(of_group).collect()
    }

    /// The reference at point `k`, between its `neighbours` in load, without a block that holds `share` of the area.
    fn rest(
        &self,
        k: usize,
        neighbours: [usize; 2],
        block: usize,
        share: f64,
        [all, rest]: [ReferencePlane; 2],
    ) -> Partial {
        let [low, high] = neighbours.map(|k| &self.points[k]);
        let (point, part) = (&self.points[k], self.blocks[k][block]);
        let without = |whole: f64, part: f64| Some((whole - part) / (1.0 - share)).filter(|rest| *rest > 0.0);
        let log_ratio = (high.pressure / low.pressure).ln();
        let Some(pressure) = without(point.pressure, part.pressure).filter(|_| log_ratio > 0.0) else {
            return Partial::default();
        };
        let step = (point.pressure / pressure).ln();
        let spot = |quantity: ComparedQuantity| {
            let spot = quantity.spot()? as usize;
            without(point.spots[spot], part.spots[spot])
        };
        ComparedQuantity::ALL.map(|quantity| {
            let ends = [low, high].map(|point| Some(quantity.scaled(point.value(quantity)?)));
            let slope = (ends[1]? - ends[0]?) / log_ratio;
            let value = match quantity {
                ComparedQuantity::Separation => {
                    (all.mean + point.separation_over_sigma? * all.sigma - rest.mean) / rest.sigma
                }
                ComparedQuantity::Area => without(point.area_ratio, part.area_ratio)?,
                ComparedQuantity::Stiffness => point.stiffness? * without(1.0, part.stiffness_share)?,
                ComparedQuantity::Friction => spot(quantity)? / pressure,
                ComparedQuantity::ElectricalConductance | ComparedQuantity::ThermalConductance => {
                    spot(quantity)?
                }
            };
            Some(quantity.scaled(value) + step * slope)
        })
    }
}

/// A model is nearer if its distance is smaller by more than this part of what is accepted; less is of no relevance.
pub const NEARER: f64 = 0.1;

/// Neighbouring loads at which both models stand alike against the reference.
#[derive(Debug, Clone, PartialEq)]
pub struct NearerStretch {
    /// What is compared.
    pub quantity: ComparedQuantity,
    /// From and to, Pa.
    pub loads: [f64; 2],
    /// The one limit of admissible loads that is exceeded, where the comparison is homogeneous in the heights: it holds of lower
    /// surfaces of the same shape.
    pub beyond: Option<Limit>,
    /// The nearer model, by more than [`NEARER`]; `None` where that cannot be told of such surfaces, or both are as near.
    pub nearer: Option<ModelKind>,
    /// The nearer model on this very surface, whatever another sample of it would give; `None` where the reference is not
    /// accurate enough. Over several realisations that of their mean.
    pub nearer_here: Option<ModelKind>,
    /// Whether the statistical and the deterministic model agree with the reference within what is accepted.
    pub verdicts: [Verdict; 2],
    /// The same on this very surface.
    pub verdicts_here: [Verdict; 2],
    /// The largest difference of each from the reference, and its load, Pa.
    pub largest: [(f64, Estimate); 2],
}

impl NearerStretch {
    /// The stretches of all quantities over the admissible loads; `against` is sorted by load. Where the comparison `is_homogeneous`
    /// (elastic contacts on a homogeneous half-space, whose laws scale with the heights), loads at which only strains are large have
    /// stretches of their own.
    pub fn all(against: &AgainstReference, accepted: &Accepted, is_homogeneous: bool) -> Vec<Self> {
        let of = |quantity| Self::of(quantity, against, accepted, is_homogeneous);
        ComparedQuantity::ALL.into_iter().flat_map(of).collect()
    }

    fn of(
        quantity: ComparedQuantity,
        against: &AgainstReference,
        accepted: &Accepted,
        is_homogeneous: bool,
    ) -> Vec<Self> {
        let band = accepted.band(quantity);
        let index = quantity as usize;
        let [statistical, deterministic] = &against.models;
        let valid = statistical.iter().zip(deterministic).zip(&against.nearness);
        let each: Vec<Self> = valid
            .filter(|(_, at)| {
                at.exceeded().is_none() || is_homogeneous && at.exceeded().is_at_most(Limit::LargeStrain)
            })
            .filter_map(|((s, d), at)| {
                let (estimates, nearness) =
                    ([s.estimates[index]?, d.estimates[index]?], at.estimates[index]?);
                let least = NEARER * band[1];
                let side = |[low, high]: [f64; 2]| match () {
                    () if high < -least => Some(ModelKind::Statistical),
                    () if low > least => Some(ModelKind::Deterministic),
                    () => None,
                };
                let Estimate { contrast, bound, .. } = nearness;
                Some(Self {
                    quantity,
                    loads: [at.load; 2],
                    beyond: at.exceeded().limits().next(),
                    nearer: nearness.interval().and_then(side),
                    nearer_here: side([contrast - bound, contrast + bound]),
                    verdicts: estimates.map(|estimate| Verdict::from_estimate(&estimate, band)),
                    verdicts_here: estimates.map(|estimate| Verdict::from_estimate(&estimate.here(), band)),
                    largest: estimates.map(|estimate| (at.load, estimate)),
                })
            })
            .collect();
        let key = |one: &Self| (one.beyond, one.nearer, one.nearer_here, one.verdicts, one.verdicts_here);
        let alike = |a: &Self, b: &Self| key(a) == key(b);
        each.chunk_by(alike).map(Self::joined).collect()
    }

    fn joined(stretch: &[Self]) -> Self {
        let largest = |model: usize| {
            let each = stretch.iter().map(|one| one.largest[model]);
            each.max_by(|a, b| a.1.contrast.abs().total_cmp(&b.1.contrast.abs()))
        };
        let (first, last) = (&stretch[0], &stretch[stretch.len() - 1]);
        Self {
            loads: [first.loads[0], last.loads[1]],
            largest: [0, 1].map(|model| largest(model).unwrap_or(first.largest[model])),
            ..first.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bem::Boundary;
    use crate::compare::tests::{pair, response};
    use crate::compare::{BlockShare, Control};

    const PLANE: ReferencePlane = ReferencePlane { mean: 3e-8, sigma: 1e-8 };
    const ACCEPTED: Accepted = Accepted::DEFAULT;
    const LOADS: [f64; 3] = [1e6, 2e6, 4e6];

    /// At each load the separations and areas of integral, sum and reference; four blocks of equal parts, or one that
    /// carries twice as much.
    fn against(separations: [f64; 3], areas: [f64; 3], heavy: bool, bound: f64) -> AgainstReference {
        let share = |k: usize| if heavy { [0.4, 0.2, 0.2, 0.2][k] } else { 0.25 };
        let drift = |k: usize| -0.5 * (LOADS[k] / LOADS[0]).ln();
        let at = |k: usize| {
            let of = |model: usize, contacts| {
                response(separations[model] + drift(k), areas[model] * LOADS[k] / 1e6, contacts)
            };
            pair(LOADS[k], of(0, None), of(1, Some(200.0)))
        };
        let pairs: Vec<Pair> = (0..3).map(at).collect();
        let point = |k: usize| ReferencePoint {
            control: Control::Pressure,
            target: LOADS[k],
            pressure: LOADS[k],
            mean_gap: 1e-8,
            undeformed_gap: 1e-8,
            separation: Some(1e-8 * (separations[2] + drift(k))),
            separation_over_sigma: Some(separations[2] + drift(k)),
            area_ratio: areas[2] * LOADS[k] / 1e6,
            raw_area_ratio: 1.1 * areas[2] * LOADS[k] / 1e6,
            capped_area_ratio: 0.0,
            stiffness: None,
            spots: Default::default(),
            of_cluster: [0.0; 2],
            bounds: [bound, bound, 0.0, 0.0, 0.0, 0.0],
            error: 1e-6,
            steps: 1,
            convolutions: 1,
        };
        let block = |k: usize, b: usize| BlockShare {
            pressure: share(b) * LOADS[k],
            area_ratio: share(b) * areas[2] * LOADS[k] / 1e6,
            stiffness_share: share(b),
            spots: Default::default(),
        };
        let curve = ReferenceCurve {
            boundary: Boundary::Periodic,
            cap: None,
            interpolated: 0,
            points: (0..3).map(point).collect(),
            blocks: (0..3).map(|k| (0..4).map(|b| block(k, b)).collect()).collect(),
            clusters: Vec::new(),
            unreached: Vec::new(),
        };
        // Without a block the sum is as the reference; the integral knows of no block.
        let state = |pair: &Pair, b: usize| {
            let of = |response: &Response, lighter: f64| {
                let logs = [response.area_ratio.total().ln(), response.stiffness.ln()];
                [response.separation_over_sigma + 0.5 * lighter, logs[0], logs[1], 0.0, 0.0, 0.0]
            };
            let lighter = ((1.0 - share(b)) / 0.75).ln();
            Some([of(&pair.statistical, 0.0), of(&pair.deterministic, lighter)])
        };
        let groups = LeftOut {
            states: (0..4).map(|b| pairs.iter().map(|pair| state(pair, b)).collect()).collect(),
            planes: vec![Some(PLANE); 4],
            shares: vec![0.25; 4],
        };
        let sampling = CaseSampling { groups: Some(groups), area: 1e-6, ..CaseSampling::default() };
        let differences = Difference::at_loads(&pairs, &sampling);
        AgainstReference::new(&pairs, &differences, &curve, &sampling, PLANE).sorted()
    }

    fn nearer(
        against: &AgainstReference,
        quantity: ComparedQuantity,
    ) -> Vec<(Option<ModelKind>, [Verdict; 2])> {
        let all = NearerStretch::all(against, &ACCEPTED, false);
        let of = all.iter().filter(|stretch| stretch.quantity == quantity);
        of.map(|stretch| (stretch.nearer, stretch.verdicts)).collect()
    }

    #[test]
    fn equal_blocks_leave_no_sampling_error_and_the_nearer_model_is_told() {
        use Verdict::{Beyond, Within};
        let found = against([2.3, 2.05, 2.0], [1.2e-3, 0.9e-3, 1e-3], false, 0.0);
        let separation = ComparedQuantity::Separation;
        assert_eq!(nearer(&found, separation), [(Some(ModelKind::Deterministic), [Beyond, Within])]);
        let estimate = found.models[0][1].estimates[0].unwrap();
        assert!((estimate.contrast - 0.3).abs() < 1e-12 && estimate.error.unwrap() < 1e-12, "{estimate:?}");
        // ln 1.2 is farther than ln 0.9; -10 % is just what is accepted.
        let area = found.models[0][0].estimates[1].unwrap();
        assert!((area.contrast - 1.2f64.ln()).abs() < 1e-12);
        assert_eq!(nearer(&found, ComparedQuantity::Area)[0].0, Some(ModelKind::Deterministic));
        let found = against([2.02, 1.7, 2.0], [1e-3; 3], false, 0.0);
        assert_eq!(nearer(&found, separation), [(Some(ModelKind::Statistical), [Within, Beyond])]);
        // Nearer by less than a tenth of what is accepted.
        let found = against([2.02, 2.015, 2.0], [1e-3; 3], false, 0.0);
        assert_eq!(nearer(&found, separation), [(None, [Within, Within])]);
        // Equally far.
        assert_eq!(nearer(&found, ComparedQuantity::Area), [(None, [Within, Within])]);
    }

    /// At loads at which only strains are large elastic contacts on a half-space are compared, marked; others are not.
    #[test]
    fn large_strains_leave_a_comparison_that_is_homogeneous_in_the_heights() {
        let mut found = against([2.3, 2.05, 2.0], [1.2e-3, 0.9e-3, 1e-3], false, 0.0);
        let [statistical, deterministic] = &mut found.models;
        for at in statistical.iter_mut().chain(deterministic).chain(&mut found.nearness) {
            let sharing = at.sharing.as_mut().unwrap();
            sharing.large_strain_share = if at.load > LOADS[0] { 0.5 } else { 0.0 };
        }
        let stretches = |is_homogeneous| {
            let all = NearerStretch::all(&found, &ACCEPTED, is_homogeneous);
            let of_area = all.into_iter().filter(|stretch| stretch.quantity == ComparedQuantity::Area);
            of_area.map(|stretch| (stretch.loads, stretch.beyond)).collect::<Vec<_>>()
        };
        assert_eq!(stretches(false), [([LOADS[0]; 2], None)]);
        let beyond = ([LOADS[1], LOADS[2]], Some(Limit::LargeStrain));
        assert_eq!(stretches(true), [([LOADS[0]; 2], None), beyond]);
        for at in &mut found.nearness {
            at.sharing.as_mut().unwrap().effective_contacts = 20.0;
        }
        assert_eq!(NearerStretch::all(&found, &ACCEPTED, true), []);
    }

    #[test]
    fn the_bound_of_the_reference_widens_intervals_but_shifts_both_models() {
        let told = |separations, bound| {
            let found = against(separations, [1e-3; 3], false, bound);
            nearer(&found, ComparedQuantity::Separation)[0]
        };
        use Verdict::{CannotTell, Within};
        // Both on one side: an error of the reference moves both.
        assert_eq!(told([2.15, 2.08, 2.0], 0.06), (Some(ModelKind::Deterministic), [CannotTell; 2]));
        // On both sides: it may turn the order.
        assert_eq!(told([2.08, 1.95, 2.0], 0.06).0, None);
        assert_eq!(told([2.08, 1.95, 2.0], 0.01), (Some(ModelKind::Deterministic), [Within; 2]));
    }

    /// What block and sum share cancels: the sum's distance has less error than the integral's.
    #[test]
    fn a_heavy_block_moves_sum_and_reference_together() {
        let found = against([2.3, 2.05, 2.0], [1e-3; 3], true, 0.0);
        let error = |model: usize| found.models[model][1].estimates[0].unwrap().error.unwrap();
        assert!(error(0) > 0.05 && error(1) < 0.02 * error(0), "{} {}", error(0), error(1));
        assert_eq!(nearer(&found, ComparedQuantity::Stiffness), []);
    }

    #[test]
    fn without_groups_there_is_no_interval_but_a_nearer_model_on_this_surface() {
        let whole = against([2.3, 2.05, 2.0], [1e-3; 3], false, 0.0);
        let strip = |all: &[Difference]| -> Vec<Difference> {
            let without = |one: &Difference| {
                let estimates = one.estimates.map(|at| at.map(|at| Estimate { error: None, ..at }));
                Difference { estimates, ..one.clone() }
            };
            all.iter().map(without).collect()
        };
        let [s, d] = &whole.models;
        let bare = AgainstReference { models: [strip(s), strip(d)], nearness: strip(&whole.nearness) };
        let first = &NearerStretch::all(&bare, &ACCEPTED, false)[0];
        assert_eq!((first.nearer, first.nearer_here), (None, Some(ModelKind::Deterministic)));
        assert_eq!((first.verdicts, first.loads), ([Verdict::CannotTell; 2], [1e6, 4e6]));
    }
}
