//! Closed results beside the models: analytical lines, and correlations of the conductance.

use asperity::analytical::AnalyticalLine;
use asperity::bem::Boundary;
use asperity::compare::{ComparedQuantity, Pair, ReferencePoint};
use asperity::literature;
use asperity::literature::Paper;
use asperity::spot::Correlation;
use asperity_contact_framework::input::{InputError, SpecFile};

use super::reference::ReferencePlan;
use super::rows::SurfaceCase;
use super::spec::CompareSpec;
use crate::model_tables::REFERENCE;
use crate::surface::SurfacePlan;

const CONDUCTANCES: [ComparedQuantity; 2] =
    [ComparedQuantity::ElectricalConductance, ComparedQuantity::ThermalConductance];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formula {
    /// A correlation for an interface without end: against a reference without end, or else the sum.
    Interface(Correlation),
    /// The spots of the sum as a cluster between half-spaces: against the reference on a finite map.
    Cluster,
}

impl Formula {
    /// All, in the order of tables.
    pub const ALL: [Self; 3] = [
        Self::Interface(Correlation::CooperMikicYovanovich),
        Self::Interface(Correlation::Mikic),
        Self::Cluster,
    ];

    pub const fn name(self) -> &'static str {
        match self {
            Self::Interface(correlation) => correlation.name(),
            Self::Cluster => "greenwood-cluster",
        }
    }

    pub const fn label(self) -> &'static str {
        match self {
            Self::Interface(correlation) => correlation.label(),
            Self::Cluster => "Greenwood's cluster of spots",
        }
    }

    pub const fn paper(self) -> Paper {
        match self {
            Self::Interface(correlation) => correlation.paper(),
            Self::Cluster => literature::GREENWOOD_1966,
        }
    }
}

/// An formula of a conductance against the reference, or else the sum, on one case.
#[derive(Debug, Clone)]
pub struct Correlated {
    pub quantity: ComparedQuantity,
    pub formula: Formula,
    pub against: &'static str,
    /// Admissible loads (Pa), ascending, the relative difference there, and the bound of the error of ln(conductance) of what it is compared with.
    pub differences: Vec<(f64, f64, f64)>,
    /// The largest difference that is accepted.
    pub accepted: f64,
}

impl Correlated {
    /// Of each conductance that is asked for and each formula, a cluster only with a reference on a finite map; none under a layer and without a
    /// map.
    pub fn all(case: SurfaceCase) -> Result<Vec<Self>, &'static str> {
        let compared = |&quantity: &ComparedQuantity| {
            let each = Formula::ALL.into_iter();
            each.filter_map(move |formula| match formula {
                Formula::Interface(correlation) => Self::of_interface(case, quantity, correlation),
                Formula::Cluster => Self::of_cluster(case, quantity),
            })
        };
        let all: Vec<Self> = CONDUCTANCES.iter().flat_map(compared).collect();
        let is_layered = case.first().thickness.is_some_and(|thickness| thickness > 0.0);
        let is_asked = case.surface.joint.is_some() && case.surface.spots.conducts() && !is_layered;
        if !all.is_empty() || !is_asked || case.verdicts().differences.is_empty() {
            return Ok(all);
        }
        let are_known = CONDUCTANCES.iter().any(|&quantity| {
            Correlation::ALL.into_iter().any(|one| conductance(case, quantity, one).is_some())
        });
        Err(if are_known {
            "compared at admissible loads, of which there are none"
        } else {
            "they are for joints without a film and a medium in the gap"
        })
    }

    fn of_interface(case: SurfaceCase, quantity: ComparedQuantity, correlation: Correlation) -> Option<Self> {
        let found = case.first();
        let value = conductance(case, quantity, correlation)?;
        let of_reference = found.reference.iter().flat_map(|curve| &curve.points);
        let with_bound = |point: &ReferencePoint| {
            Some((point.pressure, point.value(quantity)?, point.bounds[quantity as usize]))
        };
        let mut truth: Vec<Truth> = of_reference.filter_map(with_bound).collect();
        let against = if truth.is_empty() { "deterministic" } else { REFERENCE };
        if truth.is_empty() {
            let pairs = found.comparison.pairs_at_load();
            let of_pair = |pair: &Pair| Some((pair.target, quantity.value(&pair.deterministic)?, 0.0));
            truth = pairs.filter_map(of_pair).collect();
        }
        Self::new(case, quantity, Formula::Interface(correlation), against, truth, value)
    }

    fn of_cluster(case: SurfaceCase, quantity: ComparedQuantity) -> Option<Self> {
        let curve = case.first().reference.as_ref()?;
        let index = quantity.spot()? as usize;
        let truth = |point: &ReferencePoint| {
            let value = Some(point.of_cluster[index]).filter(|value| *value > 0.0)?;
            Some((point.pressure, value, point.bounds[quantity as usize]))
        };
        let value = |load: f64| {
            let at = curve.points.iter().position(|point| point.pressure == load)?;
            Some(curve.clusters.get(at)?[index]).filter(|value| *value > 0.0)
        };
        let truth = curve.points.iter().filter_map(truth).collect();
        Self::new(case, quantity, Formula::Cluster, REFERENCE, truth, value)
    }

    fn new(
        case: SurfaceCase,
        quantity: ComparedQuantity,
        formula: Formula,
        against: &'static str,
        mut truth: Vec<Truth>,
        value: impl Fn(f64) -> Option<f64>,
    ) -> Option<Self> {
        let is_admissible = |load: f64| {
            case.verdicts().differences.iter().any(|at| at.load == load && at.exceeded().is_none())
        };
        truth.retain(|(load, ..)| is_admissible(*load));
        truth.sort_by(|a, b| a.0.total_cmp(&b.0));
        truth.dedup_by(|a, b| a.0 == b.0);
        let difference = |&(load, truth, bound): &Truth| Some((load, value(load)? / truth - 1.0, bound));
        let differences: Vec<(f64, f64, f64)> = truth.iter().filter_map(difference).collect();
        let accepted = case.verdicts().accepted.limit(quantity);
        (!differences.is_empty()).then_some(Self { quantity, formula, against, differences, accepted })
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

    pub fn bound(&self) -> f64 {
        self.differences.iter().map(|(.., bound)| *bound).fold(0.0, f64::max)
    }
}

/// Load (Pa), conductance per nominal area, and the bound of the error of its logarithm.
type Truth = (f64, f64, f64);

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

/// Resolves the lines of `[compare]`; none where none are asked for.
pub fn lines(
    file: &SpecFile,
    raw: &CompareSpec,
    surfaces: &[SurfacePlan],
    reference: Option<&ReferencePlan>,
) -> Result<Vec<AnalyticalLine>, InputError> {
    let Some(asked) = &raw.lines else { return Ok(Vec::new()) };
    let lines = &asked.get_ref().0;
    let refuse = |message: String| Err(file.source.error_at(asked.span(), message));
    if let Some(surface) = surfaces.iter().find(|surface| surface.map_points().is_none()) {
        return refuse(format!(
            "found analytical lines on surface {} ({}), which has no height map to take an r.m.s. gradient from; allowed: surfaces made by \
             [surface.NAME.generate] or read by [surface.NAME.file], chosen by `surfaces = [...]`, or no `lines`",
            surface.name,
            surface.describe()
        ));
    }
    if raw.layer.is_some() {
        return refuse(
            "found analytical lines with a layer, which hold for homogeneous bodies; allowed: no `layer`, or no `lines`".to_owned(),
        );
    }
    let interacting = AnalyticalLine::GreenwoodWilliamsonInteracting;
    if !lines.contains(&interacting) {
        return Ok(lines.clone());
    }
    if raw.models.as_ref().is_some_and(|models| models.get_ref().kinds.is_empty()) {
        return refuse(format!(
            "found \"{}\" without a model, whose separation it corrects; allowed: \"statistical\" or \"deterministic\" among the models",
            interacting.name()
        ));
    }
    let endless = surfaces.iter().find_map(|surface| {
        let boundary = reference.map(|reference| reference.boundary(surface));
        (boundary != Some(Boundary::Finite)).then_some((surface, boundary))
    });
    let Some((surface, boundary)) = endless else { return Ok(lines.clone()) };
    let found = match boundary {
        None => "without a reference".to_owned(),
        Some(boundary) => {
            format!("with the boundary \"{}\" of the reference on surface {}", boundary.name(), surface.name)
        }
    };
    refuse(format!(
        "found \"{}\" {found}; allowed: \"reference\" among the models with reference = {{ boundary = \"finite\" }}. The line lowers the \
         separation by the mean deflection of the patch under the nominal pressure, which grows with the side of the patch: on a surface \
         without end it has no meaning",
        interacting.name()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn correlated(differences: &[(f64, f64, f64)]) -> Correlated {
        Correlated {
            quantity: ComparedQuantity::ThermalConductance,
            formula: Formula::Interface(Correlation::Mikic),
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
