//! The difference between both models at one load, with its sampling uncertainty.

use super::sampling::{jackknife_error, jackknife_quantile, student_quantile};
use super::{Pair, Pairing};
use crate::model::{Exceeded, LoadSharing, MIN_CONTACTS, ReferencePlane};
use crate::named_enum;

named_enum! {
    /// A quantity in which the models are compared at equal load.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum ComparedQuantity {
        /// Separation.
        Separation = "separation",
        /// Real contact area.
        Area = "area",
        /// Stiffness -dp/dd.
        Stiffness = "stiffness",
    }
}

impl ComparedQuantity {
    /// All of them, as they are reported: the area first.
    pub const REPORTED: [Self; 3] = [Self::Area, Self::Separation, Self::Stiffness];

    /// The statistical less the deterministic result of a pair at equal load, on the scale on which errors are symmetric:
    /// d/sigma, or the logarithm of the ratio; 0 if they differ by rounding only. `None` where a ratio has no logarithm.
    pub fn contrast(self, pair: &Pair) -> Option<f64> {
        /// Rounding error of load control.
        const ROUNDING: f64 = 1e-9;
        let (s, d) = (&pair.statistical, &pair.deterministic);
        let log_ratio = |s: f64, d: f64| (s > 0.0 && d > 0.0).then(|| (s / d).ln());
        let contrast = match self {
            Self::Separation => Some(s.separation_over_sigma - d.separation_over_sigma),
            Self::Area => log_ratio(s.area_ratio.total(), d.area_ratio.total()),
            Self::Stiffness => log_ratio(s.stiffness, d.stiffness),
        };
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
}

impl Estimate {
    /// Half-width of the pointwise 95 % interval; `None` where none is claimed.
    pub fn half_width(&self) -> Option<f64> {
        self.error.map(|error| self.quantile * error + self.bound)
    }

    /// What holds on the very surface that was compared, whatever another sample of it would give: the bound alone is its error.
    #[must_use]
    pub fn here(&self) -> Self {
        Self { error: Some(0.0), quantile: 0.0, ..*self }
    }

    /// The mean over realisations (at least two), with the interval that their scatter gives.
    pub(super) fn over(each: &[Self]) -> Self {
        let count = each.len() as f64;
        let contrast = each.iter().map(|one| one.contrast).sum::<f64>() / count;
        let squares: f64 = each.iter().map(|one| (one.contrast - contrast).powi(2)).sum();
        let error = (squares / (count - 1.0) / count).sqrt();
        // Of those realisations that have one.
        let independent: Vec<f64> = each.iter().filter_map(|one| one.independent_error).collect();
        let of_one = independent.iter().sum::<f64>() / independent.len() as f64;
        let independent_error = (!independent.is_empty()).then(|| of_one / count.sqrt());
        Self {
            contrast,
            error: Some(error),
            quantile: student_quantile(each.len()),
            bound: each.iter().map(|one| one.bound).sum::<f64>() / count,
            independent_error,
        }
    }

    /// The ends of the 95 % interval.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.half_width().map(|half| [self.contrast - half, self.contrast + half])
    }
}

/// The `mean` of the results of all realisations at each load that all of them have.
pub(super) fn over_realisations<T: Clone>(
    realisations: &[Vec<T>],
    load: fn(&T) -> f64,
    mean: fn(&[T]) -> T,
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
    pub estimates: [Option<Estimate>; 3],
    /// Area (m^2) of the surface that would allow an interval, where none is claimed for want of area.
    pub area_needed: Option<f64>,
}

/// The smallest number of effective contacts per group at which an interval is claimed.
pub const CONTACTS_PER_GROUP: f64 = 4.0;

/// A model at one load: d/sigma, and the logarithms of area ratio and stiffness, in the order of [`ComparedQuantity::ALL`].
pub type State = [f64; 3];

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
        let estimate = |quantity: ComparedQuantity| {
            let contrast = quantity.contrast(pair)?;
            let error = |groups: &LeftOut| groups.error(quantity, contrast, index);
            Some(Estimate {
                contrast,
                error: groups.and_then(error),
                quantile: groups.map_or(f64::INFINITY, |groups| jackknife_quantile(groups.shares.len())),
                bound: 0.0,
                independent_error: sampling.independent.as_ref().and_then(error),
            })
        };
        let by_contacts = sampling.area * (contacts_needed / effective_contacts).max(1.0);
        Self {
            load: pair.target,
            sharing: d.sharing,
            area_ratio: s.area_ratio.total().max(d.area_ratio.total()),
            estimates: ComparedQuantity::ALL.map(estimate),
            area_needed: groups.is_none().then(|| by_contacts.max(sampling.area_needed.unwrap_or(0.0))),
        }
    }

    /// The mean differences over realisations (at least two), at the loads that all of them have, with the interval that
    /// their scatter gives.
    pub fn over(realisations: &[Vec<Self>]) -> Vec<Self> {
        over_realisations(realisations, |one| one.load, Self::mean)
    }

    fn mean(all: &[Self]) -> Self {
        let count = all.len() as f64;
        let mean_of = |of: &dyn Fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / count;
        let estimate = |quantity: ComparedQuantity| {
            let each: Option<Vec<Estimate>> =
                all.iter().map(|one| one.estimates[quantity as usize]).collect();
            each.map(|each| Estimate::over(&each))
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
            estimates: ComparedQuantity::ALL.map(estimate),
            area_needed: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::ByRegime;
    use crate::model::Response;

    fn response(h: f64, area: f64, contacts: Option<f64>) -> Response {
        Response {
            separation_over_sigma: h,
            separation: h * 1e-8,
            contact_density: 100.0,
            area_ratio: ByRegime([area, 0.0, 0.0]),
            pressure: ByRegime([1.0, 0.0, 0.0]),
            stiffness: 1.0,
            sampling: None,
            sharing: contacts.map(|effective_contacts| LoadSharing {
                effective_contacts,
                largest_share: 0.01,
                large_strain_share: 0.0,
            }),
        }
    }

    fn pair(load: f64, difference: f64, contacts: f64) -> Pair {
        Pair {
            pairing: Pairing::Load,
            target: load,
            statistical: response(2.0 + difference, 2e-3, None),
            deterministic: response(2.0, 1e-3, Some(contacts)),
        }
    }

    /// Sixteen equal groups; without each of them the difference is 0.2 plus or minus `scatter`.
    fn left_out(scatter: f64, missing: bool) -> LeftOut {
        let without = |k: usize| {
            let sign = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let states = [[0.2 + sign * scatter, 2f64.ln(), 0.0], [0.0; 3]];
            vec![(!(missing && k == 3)).then_some(states)]
        };
        LeftOut {
            states: (0..16).map(without).collect(),
            planes: vec![None; 16],
            shares: vec![1.0 / 16.0; 16],
        }
    }

    fn sampling(groups: Option<LeftOut>) -> CaseSampling {
        CaseSampling { groups, independent: Some(left_out(0.01, false)), area: 2.0, area_needed: None }
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
        let found = Difference::over(&lacking);
        assert_eq!(found.len(), 1, "a load that one of them does not reach");
        let estimate = found[0].estimates[0].unwrap();
        let error = ((0.2f64.powi(2) + 0.1f64.powi(2) + 0.3f64.powi(2)) / 2.0 / 3.0).sqrt();
        assert!((estimate.contrast - 0.3).abs() < 1e-15 && (estimate.error.unwrap() - error).abs() < 1e-15);
        assert!((estimate.quantile - 4.302_652_73).abs() < 1e-6);
        assert_eq!(Difference::over(&[]), []);
    }

    #[test]
    fn rounding_is_no_difference() {
        let mut close = pair(1.0, 1e-12, 90.0);
        close.statistical.area_ratio = ByRegime([1e-3 * (1.0 + 1e-13), 0.0, 0.0]);
        assert_eq!(ComparedQuantity::ALL.map(|quantity| quantity.contrast(&close)), [Some(0.0); 3]);
        close.deterministic.stiffness = 0.0;
        assert_eq!(ComparedQuantity::Stiffness.contrast(&close), None);
        assert!(
            (ComparedQuantity::Area.reported(ComparedQuantity::Area.contrast_of(-0.3)) + 0.3).abs() < 1e-15
        );
    }
}
