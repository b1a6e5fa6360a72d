//! The difference between both models at one load, with its sampling uncertainty.

use super::sampling::{jackknife_error, jackknife_quantile, student_quantile};
use super::{Pair, Pairing};
use crate::model::{Exceeded, LoadSharing, MIN_CONTACTS};

/// A quantity in which the models are judged at equal load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Judged {
    /// Separation.
    Separation,
    /// Real contact area.
    Area,
    /// Stiffness -dp/dd.
    Stiffness,
}

impl Judged {
    /// All quantities.
    pub const ALL: [Self; 3] = [Self::Separation, Self::Area, Self::Stiffness];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Separation => "separation",
            Self::Area => "area",
            Self::Stiffness => "stiffness",
        }
    }

    /// The statistical less the deterministic result of a pair at equal load, on the scale on which errors are symmetric:
    /// d/sigma, or the logarithm of the ratio. `None` where a ratio has none.
    pub fn contrast(self, pair: &Pair) -> Option<f64> {
        let (s, d) = (&pair.statistical, &pair.deterministic);
        let log_ratio = |s: f64, d: f64| (s > 0.0 && d > 0.0).then(|| (s / d).ln());
        match self {
            Self::Separation => Some(s.separation_over_sigma - d.separation_over_sigma),
            Self::Area => log_ratio(s.area_ratio.total(), d.area_ratio.total()),
            Self::Stiffness => log_ratio(s.stiffness, d.stiffness),
        }
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

/// The difference in one quantity, as a [contrast](Judged::contrast).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The contrast; over several realisations their mean.
    pub contrast: f64,
    /// Its standard error; `None` where no interval is claimed.
    pub error: Option<f64>,
    /// Half-width of its pointwise 95 % interval in standard errors.
    pub quantile: f64,
    /// Standard error for independent asperities, whether or not an interval is claimed.
    pub independent_error: Option<f64>,
}

impl Estimate {
    /// Half-width of the pointwise 95 % interval; `None` where none is claimed.
    pub fn half_width(&self) -> Option<f64> {
        self.error.map(|error| self.quantile * error)
    }

    /// The ends of the 95 % interval.
    pub fn interval(&self) -> Option<[f64; 2]> {
        self.half_width().map(|half| [self.contrast - half, self.contrast + half])
    }
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
    /// In the order of [`Judged::ALL`]; `None` where a quantity cannot be compared.
    pub estimates: [Option<Estimate>; 3],
    /// Area (m^2) of the surface that would allow an interval, where none is claimed for want of area.
    pub area_needed: Option<f64>,
}

/// The smallest number of effective contacts per group at which an interval is claimed.
pub const CONTACTS_PER_GROUP: f64 = 4.0;

/// Both models at the same loads, with each group of the asperities left out: a pair for each load, `None` where a model
/// does not reach it.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// For each group its pairs, in the order of the loads.
    pub pairs: Vec<Vec<Option<Pair>>>,
    /// The groups' shares of the nominal area.
    pub shares: Vec<f64>,
}

impl LeftOut {
    /// The standard error of a contrast at the load of index `load`; `None` where a group's is not known.
    fn error(&self, judged: Judged, contrast: f64, load: usize) -> Option<f64> {
        let of = |pairs: &Vec<Option<Pair>>| judged.contrast(pairs[load].as_ref()?);
        let without: Option<Vec<f64>> = self.pairs.iter().map(of).collect();
        Some(jackknife_error(contrast, &without?, &self.shares))
    }
}

/// The sampling uncertainty of one surface.
#[derive(Debug, Clone, PartialEq)]
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
    /// The limits of the valid range that are exceeded.
    pub fn exceeded(&self) -> Exceeded {
        Exceeded::of(self.sharing.as_ref(), self.area_ratio)
    }

    /// The differences at the loads of the `pairs` at equal load, in their order, which is that of the loads in `sampling`.
    pub fn of(pairs: &[Pair], sampling: &CaseSampling) -> Vec<Self> {
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
        let estimate = |judged: Judged| {
            let contrast = judged.contrast(pair)?;
            let error = |groups: &LeftOut| groups.error(judged, contrast, index);
            Some(Estimate {
                contrast,
                error: groups.and_then(error),
                quantile: groups.map_or(f64::INFINITY, |groups| jackknife_quantile(groups.shares.len())),
                independent_error: sampling.independent.as_ref().and_then(error),
            })
        };
        let by_contacts = sampling.area * (contacts_needed / effective_contacts).max(1.0);
        Self {
            load: pair.target,
            sharing: d.sharing,
            area_ratio: s.area_ratio.total().max(d.area_ratio.total()),
            estimates: Judged::ALL.map(estimate),
            area_needed: groups.is_none().then(|| by_contacts.max(sampling.area_needed.unwrap_or(0.0))),
        }
    }

    /// The mean differences over realisations (at least two), at the loads that all of them have, with the interval that
    /// their scatter gives.
    pub fn over(realisations: &[Vec<Self>]) -> Vec<Self> {
        let Some((first, others)) = realisations.split_first() else { return Vec::new() };
        let at = |one: &Self| {
            let same = |other: &Vec<Self>| other.iter().find(|at| at.load == one.load).cloned();
            let others: Option<Vec<Self>> = others.iter().map(same).collect();
            let mut all = vec![one.clone()];
            all.extend(others?);
            Some(Self::mean(&all))
        };
        first.iter().filter_map(at).collect()
    }

    fn mean(all: &[Self]) -> Self {
        let count = all.len() as f64;
        let mean_of = |of: &dyn Fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / count;
        let estimate = |judged: Judged| {
            let each: Option<Vec<Estimate>> = all.iter().map(|one| one.estimates[judged as usize]).collect();
            let each = each?;
            let contrast = each.iter().map(|one| one.contrast).sum::<f64>() / count;
            let squares: f64 = each.iter().map(|one| (one.contrast - contrast).powi(2)).sum();
            let error = (squares / (count - 1.0) / count).sqrt();
            // Of those realisations that have one.
            let independent: Vec<f64> = each.iter().filter_map(|one| one.independent_error).collect();
            let of_one = independent.iter().sum::<f64>() / independent.len() as f64;
            let independent_error = (!independent.is_empty()).then(|| of_one / count.sqrt());
            Some(Estimate {
                contrast,
                error: Some(error),
                quantile: student_quantile(all.len()),
                independent_error,
            })
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
            estimates: Judged::ALL.map(estimate),
            area_needed: None,
        }
    }
}
