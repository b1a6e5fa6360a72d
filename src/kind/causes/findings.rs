//! Which cause leads where, how often the models agree, and which is nearer to the reference.

use asperity::compare::{Cause, ComparedQuantity, Contribution, Contributions, ModelKind, Verdict};

use super::results::{CausesResults, GridPoint, QUANTITIES, QuantityAtLoad};

#[derive(Debug)]
pub struct Findings {
    pub quantity: ComparedQuantity,
    /// Indices of law and load.
    pub condition: [usize; 2],
    /// Points of the grid whose difference is divided, unless it is known to be within what is accepted.
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
    pub points: usize,
    /// Skewnesses at which it leads in every row of the grid.
    pub in_every_row: Vec<f64>,
}

impl Findings {
    /// Law by law, load by load, quantity by quantity.
    pub fn all(results: &CausesResults) -> Vec<Self> {
        let quantities = |condition| QUANTITIES.map(|quantity| Self::new(results, quantity, condition));
        results.conditions().flat_map(quantities).collect()
    }

    /// Of one quantity under a law at a load.
    pub fn new<'a>(results: &'a CausesResults, quantity: ComparedQuantity, condition: [usize; 2]) -> Self {
        let divided = |point: &'a GridPoint| Some((point.skewness, point.unaccepted(condition, quantity)?));
        let divided: Vec<(f64, &Contributions)> = results.points.iter().filter_map(divided).collect();
        let lead = |cause: Option<Cause>| {
            let with_it: Vec<f64> =
                divided.iter().filter(|(_, parts)| parts.leading() == cause).map(|(at, _)| *at).collect();
            let rows =
                |skewness: f64| results.points.iter().filter(|point| point.skewness == skewness).count();
            let mut in_every_row = with_it.clone();
            in_every_row.sort_by(f64::total_cmp);
            in_every_row.dedup();
            in_every_row
                .retain(|&skewness| with_it.iter().filter(|at| **at == skewness).count() == rows(skewness));
            Lead { cause, points: with_it.len(), in_every_row }
        };
        let mut leads: Vec<Lead> = Cause::ALL.into_iter().map(|cause| lead(Some(cause))).collect();
        leads.sort_by_key(|lead| std::cmp::Reverse(lead.points));
        leads.push(lead(None));
        leads.retain(|lead| lead.points > 0);
        let shares = || divided.iter().map(|(_, parts)| parts.share(Cause::Radii));
        let share_of_radii = (!divided.is_empty())
            .then(|| [shares().fold(f64::INFINITY, f64::min), shares().fold(0.0, f64::max)]);
        let count =
            |holds: &dyn Fn(&Contributions) -> bool| divided.iter().filter(|(_, parts)| holds(parts)).count();
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
    /// Of these, points beyond small strains, which stand for lower surfaces of the same shape.
    pub beyond_small_strains: usize,
    /// Where the statistical model is nearer.
    pub statistical: usize,
    /// Where the deterministic model is nearer.
    pub deterministic: usize,
}

impl NearerCounts {
    pub fn new(results: &CausesResults, quantity: ComparedQuantity) -> Self {
        let mut counts = Self::default();
        for condition in results.conditions() {
            for point in &results.points {
                let Some(stretch) = point.quantity(condition, quantity).and_then(|at| at.nearer.as_ref())
                else {
                    continue;
                };
                counts.compared += 1;
                counts.beyond_small_strains += usize::from(stretch.beyond.is_some());
                counts.statistical += usize::from(stretch.nearer == Some(ModelKind::Statistical));
                counts.deterministic += usize::from(stretch.nearer == Some(ModelKind::Deterministic));
            }
        }
        counts
    }
}

/// How often the integral may replace the sum in one quantity, over all laws, loads and points.
#[derive(Debug, Default, PartialEq)]
pub struct VerdictCounts {
    /// Points and loads at which the models are compared.
    pub compared: usize,
    /// Where they agree within what is accepted.
    pub within: usize,
    /// Where they differ by more.
    pub beyond: usize,
    /// The smallest and the largest difference, as a contrast; `None` without points.
    pub range: Option<[f64; 2]>,
}

impl VerdictCounts {
    pub fn new(results: &CausesResults, quantity: ComparedQuantity) -> Self {
        let mut counts = Self::default();
        let verdicts = results.conditions().flat_map(|condition| {
            let at = results.points.iter().filter_map(move |point| point.quantity(condition, quantity));
            let with_verdict = |at: &QuantityAtLoad| {
                let (estimate, verdict) = at.difference?;
                Some((estimate.contrast, verdict?))
            };
            at.filter_map(with_verdict).collect::<Vec<_>>()
        });
        for (contrast, verdict) in verdicts {
            let [low, high] = counts.range.unwrap_or([contrast; 2]);
            counts.range = Some([low.min(contrast), high.max(contrast)]);
            counts.compared += 1;
            counts.within += usize::from(verdict == Verdict::Within);
            counts.beyond += usize::from(verdict == Verdict::Beyond);
        }
        counts
    }
}
