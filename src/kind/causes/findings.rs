//! Which cause leads where.

use asperity::compare::{Cause, ComparedQuantity, Contribution, Contributions, ModelKind, Verdict};

use super::results::{CausesResults, QUANTITIES};

/// One quantity at one load.
#[derive(Debug)]
pub struct Findings {
    /// What is compared.
    pub quantity: ComparedQuantity,
    /// Indices of law and load.
    pub condition: [usize; 2],
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
    /// Law by law, load by load, quantity by quantity.
    pub fn all(results: &CausesResults) -> Vec<Self> {
        let quantities = |condition| QUANTITIES.map(|quantity| Self::new(results, quantity, condition));
        results.conditions().flat_map(quantities).collect()
    }

    fn new(results: &CausesResults, quantity: ComparedQuantity, condition: [usize; 2]) -> Self {
        let divided: Vec<(f64, Option<Cause>, f64)> = results
            .points
            .iter()
            .filter_map(|point| {
                let parts = point.parts(condition, quantity)?;
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
                .filter_map(|point| point.parts(condition, quantity))
                .filter(|parts| holds(parts))
                .count()
        };
        let heights = |parts: &Contributions| *parts.of_cause(Cause::Heights);
        let size = |part: &Contribution| part.mean.contrast.abs();
        Self {
            quantity,
            condition,
            divided: divided.len(),
            leads,
            share_of_radii,
            radii_larger: count(&|parts| size(&parts.radii) > size(&heights(parts))),
            radii_exceed: count(&|parts| parts.radii.exceeds(&heights(parts))),
            heights_exceed: count(&|parts| heights(parts).exceeds(&parts.radii)),
        }
    }
}

/// How often each model is nearer to the reference in one quantity, over all laws, loads and points.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct NearerCounts {
    /// Points at which it can be compared.
    pub compared: usize,
    /// Where the statistical model is nearer.
    pub statistical: usize,
    /// Where the deterministic model is nearer.
    pub deterministic: usize,
    /// Both are within what is accepted of the reference.
    pub both_within: usize,
}

impl NearerCounts {
    /// Of a quantity under one law.
    pub fn new(results: &CausesResults, quantity: ComparedQuantity, law: usize) -> Self {
        let mut counts = Self::default();
        for condition in results.conditions().filter(|condition| condition[0] == law) {
            for point in &results.points {
                let Some(stretch) = point.quantity(condition, quantity).and_then(|at| at.nearer.as_ref())
                else {
                    continue;
                };
                counts.compared += 1;
                counts.statistical += usize::from(stretch.nearer == Some(ModelKind::Statistical));
                counts.deterministic += usize::from(stretch.nearer == Some(ModelKind::Deterministic));
                counts.both_within += usize::from(stretch.verdicts == [Verdict::Within; 2]);
            }
        }
        counts
    }
}

/// How often the integral may replace the sum in one quantity, over all laws, loads and points.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct VerdictCounts {
    /// Points at which the models are compared.
    pub compared: usize,
    /// Where they agree within what is accepted.
    pub within: usize,
    /// Where they differ by more.
    pub beyond: usize,
}

impl VerdictCounts {
    /// Of a quantity.
    pub fn new(results: &CausesResults, quantity: ComparedQuantity) -> Self {
        let mut counts = Self::default();
        let verdicts = results.conditions().flat_map(|condition| {
            let at = results.points.iter().filter_map(move |point| point.quantity(condition, quantity));
            at.filter_map(|at| at.difference?.1).collect::<Vec<_>>()
        });
        for verdict in verdicts {
            counts.compared += 1;
            counts.within += usize::from(verdict == Verdict::Within);
            counts.beyond += usize::from(verdict == Verdict::Beyond);
        }
        counts
    }
}
