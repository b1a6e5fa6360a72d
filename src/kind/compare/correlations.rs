//! Correlations of the conductance beside the models: those that programs for finite elements use.

use asperity::compare::{ComparedQuantity, Pair, ReferencePoint};
use asperity::spot::Correlation;

use super::rows::SurfaceCase;
use crate::model_tables::REFERENCE;

/// The conductances.
const CONDUCTANCES: [ComparedQuantity; 2] =
    [ComparedQuantity::ElectricalConductance, ComparedQuantity::ThermalConductance];

/// A correlation against the reference, or else the sum, on one case.
#[derive(Debug, Clone)]
pub struct Correlated {
    /// The conductance.
    pub quantity: ComparedQuantity,
    /// The correlation.
    pub correlation: Correlation,
    /// What it is compared with.
    pub against: &'static str,
    /// Admissible loads (Pa), ascending, the relative difference there, and the bound of the error of ln(conductance) of what it is compared with.
    pub differences: Vec<(f64, f64, f64)>,
    /// The largest difference that is accepted.
    pub accepted: f64,
}

impl Correlated {
    /// Of each conductance that is asked for and each correlation; none under a layer, with a film, of a thermal one with a medium in the gap, and
    /// without a map.
    pub fn all(case: SurfaceCase) -> Vec<Self> {
        let compared = |&quantity: &ComparedQuantity| {
            let each = Correlation::ALL.into_iter();
            each.filter_map(move |correlation| Self::new(case, quantity, correlation))
        };
        CONDUCTANCES.iter().flat_map(compared).collect()
    }

    fn new(case: SurfaceCase, quantity: ComparedQuantity, correlation: Correlation) -> Option<Self> {
        let found = case.first();
        let value = conductance(case, quantity, correlation)?;
        let of_reference = found.reference.iter().flat_map(|curve| &curve.points);
        let with_bound = |point: &ReferencePoint| {
            Some((point.pressure, point.value(quantity)?, point.bounds[quantity as usize]))
        };
        let mut truth: Vec<(f64, f64, f64)> = of_reference.filter_map(with_bound).collect();
        let against = if truth.is_empty() { "deterministic" } else { REFERENCE };
        if truth.is_empty() {
            let pairs = found.comparison.pairs_at_load();
            let of_pair = |pair: &Pair| Some((pair.target, quantity.value(&pair.deterministic)?, 0.0));
            truth = pairs.filter_map(of_pair).collect();
        }
        let is_admissible = |load: f64| {
            case.verdicts().differences.iter().any(|at| at.load == load && at.exceeded().is_none())
        };
        truth.retain(|(load, ..)| is_admissible(*load));
        truth.sort_by(|a, b| a.0.total_cmp(&b.0));
        truth.dedup_by(|a, b| a.0 == b.0);
        let difference =
            |&(load, truth, bound): &(f64, f64, f64)| Some((load, value(load)? / truth - 1.0, bound));
        let differences: Vec<(f64, f64, f64)> = truth.iter().filter_map(difference).collect();
        let accepted = case.verdicts().accepted.limit(quantity);
        (!differences.is_empty()).then_some(Self { quantity, correlation, against, differences, accepted })
    }

    /// The longest stretch of neighbouring loads (Pa) at which it is within what is accepted, also at the ends of the bound.
    pub fn within(&self) -> Option<[f64; 2]> {
        let is_within = |&(_, difference, bound): &(f64, f64, f64)| {
            [-bound, bound].iter().all(|end| ((1.0 + difference) * end.exp() - 1.0).abs() <= self.accepted)
        };
        let stretches = self.differences.chunk_by(|a, b| is_within(a) == is_within(b));
        let within = stretches.filter(|stretch| is_within(&stretch[0]));
        let longest =
            within.max_by(|a, b| (a[a.len() - 1].0 / a[0].0).total_cmp(&(b[b.len() - 1].0 / b[0].0)))?;
        Some([longest[0].0, longest[longest.len() - 1].0])
    }

    /// The smallest and the largest difference.
    pub fn range(&self) -> [f64; 2] {
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        self.differences.iter().fold(ends, |[low, high], &(_, at, _)| [low.min(at), high.max(at)])
    }

    /// The largest bound.
    pub fn bound(&self) -> f64 {
        self.differences.iter().map(|(.., bound)| *bound).fold(0.0, f64::max)
    }
}

/// The conductance per nominal area by a correlation at a nominal pressure (Pa); `None` under a layer, with a film or a medium in
/// the gap, without a map, and of a conductance that is not asked for.
pub fn conductance(
    case: SurfaceCase,
    quantity: ComparedQuantity,
    correlation: Correlation,
) -> Option<impl Fn(f64) -> Option<f64>> {
    let is_bare = case.first().thickness.is_none_or(|thickness| thickness == 0.0);
    let conduction = case.surface.spots.conduction(quantity.spot()?).filter(|_| is_bare)?;
    let (joint, resistivity) = (case.surface.joint?, conduction.resistivity());
    // They know of no film, and what is compared with would hold the medium.
    let has_medium = quantity == ComparedQuantity::ThermalConductance && case.surface.spots.medium.is_some();
    (conduction.film() == 0.0 && !has_medium)
        .then_some(move |pressure| Some(correlation.conductance(&joint, pressure)? / resistivity))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn correlated(differences: &[(f64, f64, f64)]) -> Correlated {
        Correlated {
            quantity: ComparedQuantity::ThermalConductance,
            correlation: Correlation::Mikic,
            against: REFERENCE,
            differences: differences.to_vec(),
            accepted: 0.2,
        }
    }

    #[test]
    fn the_longest_stretch_within_what_is_accepted() {
        let found = correlated(
            &[(1.0, 0.1), (2.0, 0.3), (4.0, -0.2), (8.0, 0.0), (16.0, 0.19), (32.0, 0.21)]
                .map(|(load, at)| (load, at, 0.0)),
        );
        assert_eq!((found.within(), found.range()), (Some([4.0, 16.0]), [-0.2, 0.3]));
        assert_eq!(correlated(&[(1.0, 0.5, 0.0)]).within(), None);
        // What it is compared with may be off.
        assert_eq!(correlated(&[(1.0, 0.1, 0.08), (2.0, 0.1, 0.09)]).within(), Some([1.0, 1.0]));
    }
}
