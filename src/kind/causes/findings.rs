//! Which cause leads where.

use asperity::compare::{Cause, ComparedQuantity, Contribution, Contributions};

use super::results::{CausesResults, QUANTITIES};

/// One quantity at one load.
#[derive(Debug)]
pub struct Findings {
    /// What is compared.
    pub quantity: ComparedQuantity,
    /// Number of the load.
    pub load: usize,
    /// Points of the grid whose difference is divided.
    pub divided: usize,
    /// Causes that lead somewhere, the most frequent first, and last `None` for points where none does.
    pub leads: Vec<Lead>,
    /// Smallest and largest share of the spread of radii in the contributions, taken by magnitude; `None` without points.
    pub share_of_radii: Option<[f64; 2]>,
    /// Points at which spread and correlation of the radii together contribute more than the heights, by magnitude of the means.
    pub radii_larger: usize,
    /// Points at which they do so with 95 % intervals apart.
    pub radii_exceed: usize,
    /// Points at which the heights contribute more with 95 % intervals apart.
    pub heights_exceed: usize,
}

/// A cause and where it leads.
#[derive(Debug, PartialEq)]
pub struct Lead {
    /// `None`: no cause leads.
    pub cause: Option<Cause>,
    /// Number of points.
    pub points: usize,
    /// Skewnesses at which it leads at every bandwidth that is divided.
    pub at_every_bandwidth: Vec<f64>,
}

impl Findings {
    /// Load by load, quantity by quantity.
    pub fn all(results: &CausesResults) -> Vec<Self> {
        let quantities = |load| QUANTITIES.map(|quantity| Self::new(results, quantity, load));
        (0..results.loads.len()).flat_map(quantities).collect()
    }

    /// Of a quantity at the load of index `load`.
    fn new(results: &CausesResults, quantity: ComparedQuantity, load: usize) -> Self {
        let divided: Vec<(f64, Option<Cause>, f64)> = results
            .points
            .iter()
            .filter_map(|point| {
                let parts = point.parts(load, quantity)?;
                Some((point.skewness, parts.leading(), parts.share(Cause::Radii)))
            })
            .collect();
        let lead = |cause: Option<Cause>| {
            let leads_at = |skewness: f64| {
                let mut column = divided.iter().filter(|(at, _, _)| *at == skewness);
                column.all(|(_, leading, _)| *leading == cause)
            };
            let mut skewnesses: Vec<f64> =
                divided.iter().filter(|(_, leading, _)| *leading == cause).map(|(at, _, _)| *at).collect();
            let points = skewnesses.len();
            skewnesses.sort_by(f64::total_cmp);
            skewnesses.dedup();
            skewnesses.retain(|&skewness| leads_at(skewness));
            Lead { cause, points, at_every_bandwidth: skewnesses }
        };
        let mut leads: Vec<Lead> = Cause::ALL.into_iter().map(|cause| lead(Some(cause))).collect();
        leads.sort_by_key(|lead| std::cmp::Reverse(lead.points));
        leads.push(lead(None));
        leads.retain(|lead| lead.points > 0);
        let shares = || divided.iter().map(|(_, _, share)| *share);
        let share_of_radii = (!divided.is_empty())
            .then(|| [shares().fold(f64::INFINITY, f64::min), shares().fold(0.0, f64::max)]);
        let count = |holds: &dyn Fn(&Contributions) -> bool| {
            results
                .points
                .iter()
                .filter_map(|point| point.parts(load, quantity))
                .filter(|parts| holds(parts))
                .count()
        };
        let heights = |parts: &Contributions| *parts.of_cause(Cause::Heights);
        let size = |part: &Contribution| part.mean.contrast.abs();
        Self {
            quantity,
            load,
            divided: divided.len(),
            leads,
            share_of_radii,
            radii_larger: count(&|parts| size(&parts.radii) > size(&heights(parts))),
            radii_exceed: count(&|parts| parts.radii.exceeds(&heights(parts))),
            heights_exceed: count(&|parts| heights(parts).exceeds(&parts.radii)),
        }
    }
}
