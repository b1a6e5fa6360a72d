//! What the variation of a surface shows: which quantities have a limit, whether the gap keeps its sign, which cause leads.

#[cfg(doc)]
use asperity::compare::Contributions;
use asperity::compare::{Cause, ComparedQuantity, Estimate};

use super::quantity::Quantity;
use super::results::{Found, Scale, Series, SurfaceResults};
use super::trend::{Outcome, Trend};

/// The load of the findings of a surface: the highest of those at which most scales are within the valid range, and of these most
/// have intervals: more contacts carry it. `None` where no scale is valid at any load.
pub fn main_load(surface: &SurfaceResults) -> Option<usize> {
    let found = || surface.series.iter().flat_map(Series::found).map(|(_, found)| found);
    let rank = |load: usize| {
        let estimates = found().filter_map(|found| gap(found, load, ComparedQuantity::Separation));
        let is_bounded: Vec<bool> = estimates.map(|estimate| estimate.error.is_some()).collect();
        (is_bounded.len(), is_bounded.iter().filter(|bounded| **bounded).count())
    };
    let best = (0..surface.loads.len()).max_by_key(|&load| rank(load))?;
    (rank(best).0 > 0).then_some(best)
}

/// The gap in a quantity at a load, within the valid range.
pub fn gap(found: &Found, load: usize, quantity: ComparedQuantity) -> Option<Estimate> {
    let at = found.differences.get(load).filter(|at| at.exceeded().is_none())?;
    at.estimates[quantity as usize]
}

/// The sign of the gap over the scales.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sign {
    /// The same at all scales: the smallest and the largest gap.
    Kept([f64; 2]),
    /// Beyond their intervals, the gap at one scale is negative and at another positive: length (m) and gap.
    Changed { negative: (f64, f64), positive: (f64, f64) },
    /// An interval holds zero at so many scales of so many.
    Open { open: usize, of: usize },
}

/// A scale as the sign of its gap sees it: length (m), gap, half-width of its interval.
pub type SignedGap = (f64, f64, Option<f64>);

impl Sign {
    /// Of gaps at at least two scales.
    pub fn of(gaps: &[SignedGap]) -> Option<Self> {
        if gaps.len() < 2 {
            return None;
        }
        let is_open = |&&(_, gap, half): &&SignedGap| gap.abs() <= half.unwrap_or(0.0);
        let decided = || gaps.iter().filter(|gap| !is_open(gap)).map(|&(length, gap, _)| (length, gap));
        let by_gap = |a: &(f64, f64), b: &(f64, f64)| a.1.total_cmp(&b.1);
        if let Some((negative, positive)) = decided().min_by(by_gap).zip(decided().max_by(by_gap))
            && negative.1 < 0.0
            && positive.1 > 0.0
        {
            return Some(Self::Changed { negative, positive });
        }
        let open = gaps.iter().filter(is_open).count();
        if open > 0 {
            return Some(Self::Open { open, of: gaps.len() });
        }
        let each = || gaps.iter().map(|&(_, gap, _)| gap);
        Some(Self::Kept([each().fold(f64::INFINITY, f64::min), each().fold(f64::NEG_INFINITY, f64::max)]))
    }
}

/// The leading cause over the scales, as [`Contributions::leading`] tells it at each.
#[derive(Debug, Clone, PartialEq)]
pub enum Lead {
    /// One cause at all scales of which it can be told, so many of so many.
    One { cause: Cause, told: usize, of: usize },
    /// The causes that lead, each with the lengths (m) at which it does, from the finest scale.
    Several { causes: Vec<(Cause, Vec<f64>)>, told: usize, of: usize },
    /// It can be told at none of so many scales.
    Open { of: usize },
}

impl Lead {
    /// Of the cause that leads at each scale with its length (m), as far as it can be told; `None` without any scale.
    pub fn of(scales: &[(f64, Option<Cause>)]) -> Option<Self> {
        let of = scales.len();
        let leading: Vec<(f64, Cause)> =
            scales.iter().filter_map(|&(length, cause)| Some((length, cause?))).collect();
        let mut causes: Vec<(Cause, Vec<f64>)> = Vec::new();
        for &(length, cause) in &leading {
            match causes.iter_mut().find(|(known, _)| *known == cause) {
                Some((_, lengths)) => lengths.push(length),
                None => causes.push((cause, vec![length])),
            }
        }
        let told = leading.len();
        match causes.len() {
            _ if of == 0 => None,
            0 => Some(Self::Open { of }),
            1 => Some(Self::One { cause: causes[0].0, told, of }),
            _ => Some(Self::Several { causes, told, of }),
        }
    }
}

/// The findings of one variation at one load.
#[derive(Debug)]
pub struct Findings {
    /// Trends of [`KEY`] quantities, as far as they are known.
    pub trends: Vec<Trend>,
    /// Of the gap in separation.
    pub sign: Option<Sign>,
    /// Of the gap in separation and in area.
    pub leads: [Option<Lead>; 2],
    /// Whether some change has no interval.
    pub has_no_interval: bool,
}

/// The quantities of the summary.
pub const KEY: [Quantity; 6] = [
    Quantity::Density,
    Quantity::MeanRadius,
    Quantity::AreaOfSum,
    Quantity::AreaOfIntegral,
    Quantity::SeparationGap,
    Quantity::AreaGap,
];

impl Findings {
    /// Of a variation at the load of index `load`; without one only of the asperities.
    pub fn of(series: &Series, load: Option<usize>) -> Self {
        let trend = |quantity: Quantity| match load {
            Some(load) => series.trend(quantity, load).copied(),
            None => series.trend(quantity, 0).copied().filter(|_| !quantity.is_at_load()),
        };
        let trends: Vec<Trend> = KEY.into_iter().filter_map(trend).collect();
        let scales = || series.found().filter_map(|(scale, found)| Some((scale, found, load?)));
        let signed = |(scale, found, load): (&Scale, &Found, usize)| {
            let estimate = gap(found, load, ComparedQuantity::Separation)?;
            Some((scale.length, estimate.contrast, estimate.half_width()))
        };
        let lead = |quantity| {
            let parts = |(scale, found, load): (&Scale, &Found, usize)| {
                gap(found, load, quantity)?;
                Some((scale.length, found.parts(load, quantity)?.leading()))
            };
            Lead::of(&scales().filter_map(parts).collect::<Vec<_>>())
        };
        Self {
            sign: Sign::of(&scales().filter_map(signed).collect::<Vec<_>>()),
            leads: [ComparedQuantity::Separation, ComparedQuantity::Area].map(lead),
            has_no_interval: trends.iter().any(|trend| trend.half_width.is_none()),
            trends,
        }
    }

    /// The trends of one outcome.
    pub fn with(&self, outcome: Outcome) -> impl Iterator<Item = &Trend> {
        self.trends.iter().filter(move |trend| trend.outcome == outcome)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sign_is_kept_or_changes_only_beyond_the_intervals() {
        let sign = |gaps: &[(f64, Option<f64>)]| {
            let gaps: Vec<SignedGap> =
                (1..).zip(gaps).map(|(length, &(gap, half))| (f64::from(length), gap, half)).collect();
            Sign::of(&gaps)
        };
        assert_eq!(sign(&[(0.2, Some(0.1)), (0.3, None)]), Some(Sign::Kept([0.2, 0.3])));
        let changed = Sign::Changed { negative: (2.0, -0.3), positive: (1.0, 0.2) };
        assert_eq!(sign(&[(0.2, Some(0.1)), (-0.3, None), (-0.1, None)]), Some(changed));
        let open = sign(&[(0.2, Some(0.1)), (-0.3, Some(0.4)), (0.1, None)]);
        assert_eq!(open, Some(Sign::Open { open: 1, of: 3 }));
        assert_eq!(sign(&[(0.2, None)]), None);
    }

    #[test]
    fn a_lead_that_cannot_be_told_is_counted_but_not_named() {
        let lead = |each: &[Option<Cause>]| {
            let scales: Vec<_> = (1..).map(f64::from).zip(each.iter().copied()).collect();
            Lead::of(&scales)
        };
        let [heights, correlation] = [Some(Cause::Heights), Some(Cause::Correlation)];
        let one = Lead::One { cause: Cause::Heights, told: 2, of: 3 };
        assert_eq!(lead(&[heights, None, heights]), Some(one));
        let causes = vec![(Cause::Heights, vec![1.0, 3.0]), (Cause::Correlation, vec![2.0])];
        let several = Lead::Several { causes, told: 3, of: 3 };
        assert_eq!(lead(&[heights, correlation, heights]), Some(several));
        assert_eq!(lead(&[None]), Some(Lead::Open { of: 1 }));
        assert_eq!(lead(&[]), None);
    }
}
