//! The difference between both models at one load, with its sampling uncertainty.

use super::sampling::{Generated, NotModelled, jackknife_error, jackknife_quantile, student_quantile};
use super::{Pair, Pairing};
use crate::model::{Exceeded, LoadSharing, MIN_CONTACTS, ReferencePlane, Response};
use crate::named_enum;
use crate::spot::{SpotQuantity, SpotValues};

named_enum! {
    /// A quantity in which the models are compared at equal load. Those from the conductances on are compared where they are asked for.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum ComparedQuantity {
        /// Separation.
        Separation = "separation",
        /// Real contact area.
        Area = "area",
        /// Stiffness -dp/dd.
        Stiffness = "stiffness",
        /// Electrical conductance per nominal area.
        ElectricalConductance = "electrical-conductance",
        /// Thermal conductance per nominal area.
        ThermalConductance = "thermal-conductance",
        /// Coefficient of friction.
        Friction = "friction",
    }
}

/// A value for each of [`ComparedQuantity::ALL`].
pub type ByQuantity<T> = [T; ComparedQuantity::ALL.len()];

/// What quantities are taken from: a result of a model, or of the reference.
#[derive(Debug, Clone, Copy)]
pub struct ContactResult {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    /// d/sigma; `None` where there is none.
    pub separation_over_sigma: Option<f64>,
    /// Real over nominal area.
    pub area_ratio: f64,
    /// -dp/dd, Pa/m; `None` where there is none.
    pub stiffness: Option<f64>,
    /// As in [`Response::spots`].
    pub spots: SpotValues,
}

impl From<&Response> for ContactResult {
    fn from(response: &Response) -> Self {
        Self {
            pressure: response.pressure.total(),
            separation_over_sigma: Some(response.separation_over_sigma),
            area_ratio: response.area_ratio.total(),
            stiffness: Some(response.stiffness),
            spots: response.spots,
        }
    }
}

impl ComparedQuantity {
    /// All of them, as they are reported: the area first.
    pub const REPORTED: ByQuantity<Self> = [
        Self::Area,
        Self::Separation,
        Self::Stiffness,
        Self::ElectricalConductance,
        Self::ThermalConductance,
        Self::Friction,
    ];

    /// The quantity of spots that it follows from; `None` of one that every comparison has.
    pub const fn spot(self) -> Option<SpotQuantity> {
        match self {
            Self::Separation | Self::Area | Self::Stiffness => None,
            Self::ElectricalConductance => Some(SpotQuantity::ElectricalConductance),
            Self::ThermalConductance => Some(SpotQuantity::ThermalConductance),
            Self::Friction => Some(SpotQuantity::ShearForce),
        }
    }

    /// Its value in a result: d/sigma, the area ratio, Pa/m, S/m^2, W/(m^2 K), the coefficient of friction. `None` where it is not
    /// positive, though it must be.
    pub fn value(self, result: impl Into<ContactResult>) -> Option<f64> {
        let ContactResult { pressure, separation_over_sigma, area_ratio, stiffness, spots } = result.into();
        let value = match self {
            Self::Separation => return separation_over_sigma,
            Self::Area => area_ratio,
            Self::Stiffness => stiffness?,
            Self::ElectricalConductance | Self::ThermalConductance => spots[self.spot()? as usize],
            Self::Friction => spots[self.spot()? as usize] / pressure,
        };
        (value > 0.0).then_some(value)
    }

    /// A value on the scale on which errors are symmetric: d/sigma, else its logarithm.
    pub fn scaled(self, value: f64) -> f64 {
        if self == Self::Separation { value } else { value.ln() }
    }

    /// The value of [`Self::scaled`].
    pub fn unscaled(self, scaled: f64) -> f64 {
        if self == Self::Separation { scaled } else { scaled.exp() }
    }

    /// One value less another on that scale; `None` where one of them is.
    pub fn contrast_between(self, one: Option<f64>, other: Option<f64>) -> Option<f64> {
        let (one, other) = (one?, other?);
        Some(if self == Self::Separation { one - other } else { (one / other).ln() })
    }

    /// The statistical less the deterministic result of a pair at equal load, on that scale; 0 if they differ by rounding only. `None`
    /// where a ratio has no logarithm.
    pub fn contrast(self, pair: &Pair) -> Option<f64> {
        /// Rounding error of load control.
        const ROUNDING: f64 = 1e-9;
        let contrast = self.contrast_between(self.value(&pair.statistical), self.value(&pair.deterministic));
        contrast.map(|contrast| if contrast.abs() > ROUNDING { contrast } else { 0.0 })
    }

    /// A contrast as it is reported: in sigma, or relative to the deterministic result.
    pub fn reported(self, contrast: f64) -> f64 {
        if self == Self::Separation { contrast } else { contrast.exp_m1() }
    }

    /// The contrast of a reported difference.
    pub fn contrast_of(self, reported: f64) -> f64 {
        if self == Self::Separation { reported } else { reported.ln_1p() }
    }
}

/// The difference in one quantity, as a [contrast](ComparedQuantity::contrast).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The contrast; over several realisations their mean.
    pub contrast: f64,
    /// Its standard error; `None` where no interval is claimed.
    pub error: Option<f64>,
    /// Half-width of its pointwise 95 % interval in standard errors.
    pub quantile: f64,
    /// Bound of an error that is not one of sampling, such as that of a discretisation: widens the interval on both sides.
    pub bound: f64,
    /// Standard error for independent asperities, whether or not an interval is claimed.
    pub independent_error: Option<f64>,
    /// What is known of other samples of the surface.
    pub support: Support,
}

/// What is known of the difference on other samples of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Support {
    /// Its standard error, where there is one, is that of groups of asperities, or of realisations.
    #[default]
    Sampled,
    /// Its standard error is that of surfaces generated by a process that was fitted to the map: model-based.
    Generated,
    /// There is no standard error, but the contrast has one sign on all halves of the map (left, right, top, bottom), and at least this magnitude.
    Halves(f64),
}

impl Estimate {
    /// Half-width of the pointwise 95 % interval; `None` where none is claimed.
    pub fn half_width(&self) -> Option<f64> {
        self.error.map(|error| self.quantile * error + self.bound)
    }

    /// What holds on the very surface that was compared, whatever another sample of it would give: the bound alone is its error.
    #[must_use]
    pub fn here(&self) -> Self {
        Self { error: Some(0.0), quantile: 0.0, support: Support::Sampled, ..*self }
    }

    /// The mean over `repeats` of a surface (at least two): of several relative positions of two bodies the error is that
    /// of [`error_over_positions`].
    pub fn over(each: &[Self], repeats: Repeats) -> Self {
        let count = each.len() as f64;
        let contrast = each.iter().map(|one| one.contrast).sum::<f64>() / count;
        let squares: f64 = each.iter().map(|one| (one.contrast - contrast).powi(2)).sum();
        let variance = squares / (count - 1.0);
        let bound = each.iter().map(|one| one.bound).sum::<f64>() / count;
        if repeats == Repeats::Shifts {
            let of_bodies = each[0].error;
            return Self {
                contrast,
                error: of_bodies.map(|own| error_over_positions(own, variance, each.len())),
                bound,
                ..each[0].without_halves()
            };
        }
        // Of those realisations that have one.
        let independent: Vec<f64> = each.iter().filter_map(|one| one.independent_error).collect();
        let of_one = independent.iter().sum::<f64>() / independent.len() as f64;
        let independent_error = (!independent.is_empty()).then(|| of_one / count.sqrt());
        Self {
            contrast,
            error: Some((variance / count).sqrt()),
            quantile: student_quantile(each.len()),
            bound,
            independent_error,
            support: Support::Sampled,
        }
    }

    /// Halves of one of several surfaces say nothing of their mean.
    fn without_halves(self) -> Self {
        let support = match self.support {
            Support::Halves(_) => Support::Sampled,
            support => support,
        };
        Self { support, ..self }
    }

    /// The ends of the 95 % interval.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.half_width().map(|half| [self.contrast - half, self.contrast + half])
    }
}

named_enum! {
    /// What several results on a surface are of, and how sure their mean is.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Repeats {
        /// Independent surfaces of a process: their scatter is the error.
        #[default]
        Realisations = "realisations",
        /// The same two bodies at several relative positions. They share their heights: the error of the first alone, by its blocks, holds what
        /// other bodies would change, and more than the mean has of it; the scatter over the positions is added.
        Shifts = "relative positions",
    }
}

/// The standard error of a mean over `count` relative positions of two bodies, from the error `own` of one position that its blocks give and the
/// `variance` between positions.
///
/// The error of one position has a part of each body, which all positions share, and one of the position, which is the variance between them
/// and averages out: V/n + (own^2 - V). Both are estimates, so that the shared part is taken as at least a quarter of own^2. The
/// experiment `coverage` counts how often the intervals of two pairs of known processes hold the mean.
pub fn error_over_positions(own: f64, variance: f64, count: usize) -> f64 {
    const LEAST_SHARED: f64 = 0.25;
    let own = own * own;
    (variance / count as f64 + (own - variance).max(LEAST_SHARED * own)).sqrt()
}

/// The `mean` of the results of all realisations at each load that all of them have.
pub(super) fn over_realisations<T: Clone>(
    realisations: &[Vec<T>],
    load: fn(&T) -> f64,
    mean: impl Fn(&[T]) -> T,
) -> Vec<T> {
    let Some((first, others)) = realisations.split_first() else { return Vec::new() };
    let at = |one: &T| {
        let same = |other: &Vec<T>| other.iter().find(|at| load(at) == load(one)).cloned();
        let others: Option<Vec<T>> = others.iter().map(same).collect();
        let mut all = vec![one.clone()];
        all.extend(others?);
        Some(mean(&all))
    };
    first.iter().filter_map(at).collect()
}

/// The difference between both models at one load.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// The load, Pa.
    pub load: f64,
    /// How the contacts of the deterministic model share the load; over several realisations the mean.
    pub sharing: Option<LoadSharing>,
    /// The larger area ratio of both models; over several realisations the mean.
    pub area_ratio: f64,
    /// In the order of [`ComparedQuantity::ALL`]; `None` where a quantity cannot be compared.
    pub estimates: ByQuantity<Option<Estimate>>,
    /// Half-widths of the 95 % intervals of the [`State`]s of the statistical and of the deterministic model by themselves, where groups
    /// of asperities give them; of several relative positions those of the first.
    pub of_models: [Option<State>; 2],
    /// Area (m^2) of the surface that would allow an interval, where none is claimed for want of area.
    pub area_needed: Option<f64>,
}

/// The smallest number of effective contacts per group at which an interval is claimed.
pub const CONTACTS_PER_GROUP: f64 = 4.0;

/// A model at one load: the values of [`ComparedQuantity::ALL`], [scaled](ComparedQuantity::scaled); 0 of a quantity that is not asked for.
pub type State = ByQuantity<f64>;

/// Both models at the same loads, with each group of the asperities left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LeftOut {
    /// Without each group, at each load, the statistical and the deterministic model; `None` where one has no contact.
    pub states: Vec<Vec<Option<[State; 2]>>>,
    /// The plane from which separations are measured without each group; `None` where nothing is left.
    pub planes: Vec<Option<ReferencePlane>>,
    /// The groups' shares of the nominal area.
    pub shares: Vec<f64>,
}

impl LeftOut {
    /// Half-widths of the 95 % intervals of both models by themselves at the load of index `load`; `None` where a group's is not known.
    fn of_models(&self, states: Option<[State; 2]>, load: usize) -> [Option<State>; 2] {
        let without: Option<Vec<[State; 2]>> = self.states.iter().map(|states| states[load]).collect();
        let of_model = |model: usize| {
            let (full, without) = (states?[model], without.as_ref()?);
            Some(std::array::from_fn(|quantity| {
                let each: Vec<f64> = without.iter().map(|both| both[model][quantity]).collect();
                jackknife_quantile(self.shares.len()) * jackknife_error(full[quantity], &each, &self.shares)
            }))
        };
        [0, 1].map(of_model)
    }

    /// The standard error of a contrast at the load of index `load`; `None` where a group's is not known.
    fn error(&self, quantity: ComparedQuantity, contrast: f64, load: usize) -> Option<f64> {
        let of = |states: &Vec<Option<[State; 2]>>| {
            states[load].map(|[integral, sum]| integral[quantity as usize] - sum[quantity as usize])
        };
        let without: Option<Vec<f64>> = self.states.iter().map(of).collect();
        Some(jackknife_error(contrast, &without?, &self.shares))
    }
}

/// The sampling uncertainty of one surface under one law.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CaseSampling {
    /// Groups whose contributions are independent: blocks of a map, or of independent draws any groups. `None` where the
    /// surface allows no interval.
    pub groups: Option<LeftOut>,
    /// Groups of asperities taken as independent draws.
    pub independent: Option<LeftOut>,
    /// Nominal area, m^2.
    pub area: f64,
    /// Area (m^2) that would hold enough independent groups, where this surface does not.
    pub area_needed: Option<f64>,
    /// Both models on surfaces of a process that was fitted to the map, where it allows no interval of its own.
    pub generated: Option<Result<Generated, NotModelled>>,
    /// At each load both models on the halves of the map (left, right, bottom, top), where it allows no interval of its own.
    pub halves: Vec<[Option<[State; 2]>; 4]>,
}

impl CaseSampling {
    /// The least magnitude of the contrast on the halves of the map, if all have the sign of `contrast`.
    fn least_on_halves(&self, quantity: ComparedQuantity, contrast: f64, load: usize) -> Option<f64> {
        let halves = self.halves.get(load)?;
        let along = |states: &Option<[State; 2]>| {
            let [integral, sum] = (*states)?;
            let of_half = integral[quantity as usize] - sum[quantity as usize];
            (of_half * contrast > 0.0).then(|| of_half.abs())
        };
        let each: Option<Vec<f64>> = halves.iter().map(along).collect();
        each?.into_iter().reduce(f64::min)
    }
}

impl Difference {
    /// The limits of admissible loads that are exceeded.
    pub fn exceeded(&self) -> Exceeded {
        Exceeded::new(self.sharing.as_ref(), self.area_ratio)
    }

    /// The differences at the loads of the `pairs` at equal load, in their order, which is that of the loads in `sampling`.
    pub fn at_loads(pairs: &[Pair], sampling: &CaseSampling) -> Vec<Self> {
        let at_load = pairs.iter().filter(|pair| pair.pairing == Pairing::Load);
        at_load.enumerate().map(|(index, pair)| Self::at(index, pair, sampling)).collect()
    }

    fn at(index: usize, pair: &Pair, sampling: &CaseSampling) -> Self {
        let (s, d) = (&pair.statistical, &pair.deterministic);
        let effective_contacts = d.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
        let contacts_needed = sampling
            .groups
            .as_ref()
            .map_or(MIN_CONTACTS, |groups| CONTACTS_PER_GROUP * groups.shares.len() as f64);
        let groups = sampling.groups.as_ref().filter(|_| effective_contacts >= contacts_needed);
        let generated = sampling.generated.as_ref().and_then(|generated| generated.as_ref().ok());
        let generated = generated.filter(|_| groups.is_none() && effective_contacts >= MIN_CONTACTS);
        let estimate = |quantity: ComparedQuantity| {
            let contrast = quantity.contrast(pair)?;
            let error = |groups: &LeftOut| groups.error(quantity, contrast, index);
            let mut estimate = Estimate {
                contrast,
                error: groups.and_then(error),
                quantile: groups.map_or(f64::INFINITY, |groups| jackknife_quantile(groups.shares.len())),
                bound: 0.0,
                independent_error: sampling.independent.as_ref().and_then(error),
                support: Support::Sampled,
            };
            if let Some((error, quantile)) =
                generated.and_then(|generated| generated.error(quantity, contrast, index))
            {
                estimate = Estimate { error: Some(error), quantile, support: Support::Generated, ..estimate };
            } else if let Some(least) =
                sampling.least_on_halves(quantity, contrast, index).filter(|_| groups.is_none())
            {
                estimate.support = Support::Halves(least);
            }
            Some(estimate)
        };
        let by_contacts = sampling.area * (contacts_needed / effective_contacts).max(1.0);
        Self {
            load: pair.target,
            sharing: d.sharing,
            area_ratio: s.area_ratio.total().max(d.area_ratio.total()),
            of_models: groups.map_or([None; 2], |groups| groups.of_models(pair.states(), index)),
            estimates: ComparedQuantity::ALL.map(estimate),
            area_needed: groups.is_none().then(|| by_contacts.max(sampling.area_needed.unwrap_or(0.0))),
        }
    }

    /// The mean differences over `repeats` of a surface (at least two), at the loads that all of them have.
    pub fn over(realisations: &[Vec<Self>], repeats: Repeats) -> Vec<Self> {
        over_realisations(realisations, |one| one.load, |all| Self::mean(all, repeats))
    }

    fn mean(all: &[Self], repeats: Repeats) -> Self {
        let count = all.len() as f64;
        let mean_of = |of: &dyn Fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / count;
        let estimate = |quantity: ComparedQuantity| {
            let each: Option<Vec<Estimate>> =
                all.iter().map(|one| one.estimates[quantity as usize]).collect();
            each.map(|each| Estimate::over(&each, repeats))
        };
        let sharings: Option<Vec<LoadSharing>> = all.iter().map(|one| one.sharing).collect();
        let sharing = sharings.map(|each| {
            let mean = |of: fn(&LoadSharing) -> f64| each.iter().map(of).sum::<f64>() / count;
            LoadSharing {
                effective_contacts: mean(|one| one.effective_contacts),
                largest_share: mean(|one| one.largest_share),
                large_strain_share: mean(|one| one.large_strain_share),
            }
        });
        Self {
            load: all[0].load,
            sharing,
            area_ratio: mean_of(&|one| one.area_ratio),
            // Of shifts those of the first.
            of_models: if repeats == Repeats::Shifts { all[0].of_models } else { [None; 2] },
            estimates: ComparedQuantity::ALL.map(estimate),
            area_needed: if repeats == Repeats::Shifts { all[0].area_needed } else { None },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::tests::response;
    use crate::contact::ByRegime;

    fn pair(load: f64, difference: f64, contacts: f64) -> Pair {
        let sum = response(2.0, 1e-3, Some(contacts));
        crate::compare::tests::pair(load, response(2.0 + difference, 2e-3, None), sum)
    }

    /// Sixteen equal groups; without each of them the difference is 0.2 plus or minus `scatter`.
    fn left_out(scatter: f64, missing: bool) -> LeftOut {
        let without = |k: usize| {
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let states = [[0.2 + sign * scatter, 2f64.ln(), 0.0, 0.0, 0.0, 0.0], [0.0; 6]];
            vec![(!(missing && k == 3)).then_some(states)]
        };
        LeftOut {
            states: (0..16).map(without).collect(),
            planes: vec![None; 16],
            shares: vec![1.0 / 16.0; 16],
        }
    }

    fn sampling(groups: Option<LeftOut>) -> CaseSampling {
        CaseSampling {
            groups,
            independent: Some(left_out(0.01, false)),
            area: 2.0,
            ..CaseSampling::default()
        }
    }

    #[test]
    fn the_interval_is_the_jackknife_of_both_models() {
        let found = Difference::at_loads(&[pair(1.0, 0.2, 64.0)], &sampling(Some(left_out(0.02, false))));
        let estimate = found[0].estimates[ComparedQuantity::Separation as usize].unwrap();
        // The jackknife of 16 values of one magnitude: 15 times their scatter over 16 times 15, in the root.
        let error = (15.0f64 * 15.0 * 16.0 * 0.02 * 0.02 / 15.0 / 16.0).sqrt();
        assert!(
            (estimate.contrast - 0.2).abs() < 1e-15 && (estimate.error.unwrap() / error - 1.0).abs() < 1e-12
        );
        assert!((estimate.independent_error.unwrap() / error - 0.5).abs() < 1e-12);
        let [low, high] = estimate.interval().unwrap();
        assert!((high - low - 2.0 * 2.228_138_852 * error).abs() < 1e-9);
        // The scatter is that of the integral alone; the areas of both models stay.
        let [integral, sum] = found[0].of_models.map(Option::unwrap);
        assert!(
            (integral[0] / (2.228_138_852 * error) - 1.0).abs() < 1e-9 && sum[0].abs() < 1e-9,
            "{integral:?} {sum:?}"
        );
        assert!(integral[1].abs() < 1e-9);
        // The areas differ by a factor of two everywhere: no scatter.
        let area = found[0].estimates[ComparedQuantity::Area as usize].unwrap();
        assert!(
            (ComparedQuantity::Area.reported(area.contrast) - 1.0).abs() < 1e-14
                && area.error.unwrap() < 1e-14
        );
        assert_eq!(found[0].area_needed, None);
    }

    #[test]
    fn no_interval_is_claimed_of_few_contacts_without_groups_or_where_a_load_is_not_reached() {
        let estimate = |contacts, groups| {
            let found = Difference::at_loads(&[pair(1.0, 0.2, contacts)], &sampling(groups)).remove(0);
            (found.estimates[0].unwrap().interval(), found.area_needed)
        };
        assert_eq!(estimate(32.0, Some(left_out(0.02, false))), (None, Some(4.0)));
        assert_eq!(estimate(90.0, None), (None, Some(2.0)));
        assert_eq!(estimate(15.0, None), (None, Some(4.0)), "30 contacts take twice the area");
        assert_eq!(estimate(90.0, Some(left_out(0.02, true))).0, None);
    }

    /// Without groups: from generated surfaces, and without these from the halves of the map, if all have the sign of the difference.
    #[test]
    fn a_small_map_has_the_scatter_of_generated_surfaces_or_the_least_difference_of_its_halves() {
        let estimate = |contacts: f64, sampling: &CaseSampling| {
            Difference::at_loads(&[pair(1.0, 0.2, contacts)], sampling).remove(0).estimates[0].unwrap()
        };
        let state = |difference: f64| Some([[difference, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]]);
        let states = [0.1, 0.2, 0.3].map(|difference| vec![state(difference)]).to_vec();
        let generated = Some(Ok(Generated { states, widening: 2.0 }));
        let by_surfaces = CaseSampling { generated, ..sampling(None) };
        let found = estimate(30.0, &by_surfaces);
        assert_eq!(found.support, Support::Generated);
        assert!((found.error.unwrap() - 0.2).abs() < 1e-12, "twice 0.1: {found:?}");
        assert_eq!(estimate(29.0, &by_surfaces).support, Support::Sampled);
        let by_halves = |least: f64| CaseSampling {
            halves: vec![[state(0.5), state(least), state(0.4), state(0.3)]],
            ..sampling(None)
        };
        assert_eq!(estimate(90.0, &by_halves(0.15)).support, Support::Halves(0.15));
        assert_eq!(estimate(90.0, &by_halves(-0.15)).support, Support::Sampled);
    }

    #[test]
    fn realisations_give_the_interval_of_their_mean() {
        let each = [0.1, 0.2, 0.6].map(|difference| {
            Difference::at_loads(
                &[pair(1.0, difference, 20.0), pair(2.0, 0.1, 20.0)],
                &CaseSampling::default(),
            )
        });
        let mut lacking = each.clone();
        lacking[2].remove(1);
        let found = Difference::over(&lacking, Repeats::Realisations);
        assert_eq!(found.len(), 1, "a load that one of them does not reach");
        let estimate = found[0].estimates[0].unwrap();
        let error = ((0.2f64.powi(2) + 0.1f64.powi(2) + 0.3f64.powi(2)) / 2.0 / 3.0).sqrt();
        assert!((estimate.contrast - 0.3).abs() < 1e-15 && (estimate.error.unwrap() - error).abs() < 1e-15);
        assert!((estimate.quantile - 4.302_652_73).abs() < 1e-6);
        assert_eq!(Difference::over(&[], Repeats::Realisations), []);
    }

    #[test]
    fn rounding_is_no_difference() {
        let mut close = pair(1.0, 1e-12, 90.0);
        close.statistical.area_ratio = ByRegime([1e-3 * (1.0 + 1e-13), 0.0, 0.0]);
        let [first @ .., _, _, _] = ComparedQuantity::ALL.map(|quantity| quantity.contrast(&close));
        assert_eq!(first, [Some(0.0); 3]);
        close.deterministic.stiffness = 0.0;
        assert_eq!(ComparedQuantity::Stiffness.contrast(&close), None);
        assert!(
            (ComparedQuantity::Area.reported(ComparedQuantity::Area.contrast_of(-0.3)) + 0.3).abs() < 1e-15
        );
    }
}
