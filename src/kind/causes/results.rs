//! Both models at every point of the grid: run, and everything that the report contains.

use std::time::Instant;

use asperity::compare::{
    Accepted, Attribution, ComparedQuantity, Contributions, Estimate, ModelKind, NearerStretch, Pairing,
    Verdict,
};
use asperity::study::{CaseStudy, Verdicts};
use asperity::work::Counter;
use asperity::{Exceeded, Limit};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{ContactMetadata, Metadata, contact_metadata};

use super::super::compare::each_surface;
use super::super::compare::results::SurfaceResults;
use super::{Axis, CausesPlan};

/// The quantities whose differences are shown.
pub const QUANTITIES: [ComparedQuantity; 2] = [ComparedQuantity::Separation, ComparedQuantity::Area];

#[derive(Debug)]
pub struct CausesResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// The laws, as tables name them.
    pub laws: Vec<String>,
    /// Nominal pressures, Pa, ascending.
    pub loads: Vec<f64>,
    /// What they are multiples of: E* times the gradient, Pa; `None` of given pressures.
    pub unit: Option<f64>,
    /// Surfaces of each point.
    pub realisations: usize,
    /// What all surfaces have in common, in words.
    pub common: String,
    /// What the rows of the grid differ in.
    pub axis: Axis,
    pub has_reference: bool,
    /// Row by row of the second axis, by skewness.
    pub points: Vec<GridPoint>,
}

impl CausesResults {
    /// Every law at every load: their indices.
    pub fn conditions(&self) -> impl Iterator<Item = [usize; 2]> {
        let loads = self.loads.len();
        (0..self.laws.len()).flat_map(move |law| (0..loads).map(move |load| [law, load]))
    }
}

#[derive(Debug)]
pub struct GridPoint {
    pub skewness: f64,
    pub kurtosis: f64,
    /// Longest over shortest wavelength; `None` where it follows from the summits.
    pub wavelengths: Option<f64>,
    /// The surfaces, or why there are none.
    pub surfaces: Result<GridSurfaces, String>,
}

/// Both models on the surfaces of a point.
#[derive(Debug)]
pub struct GridSurfaces {
    pub reached: Reached,
    /// Law by law, load by load.
    pub at: Vec<Vec<AtLoad>>,
}

/// What a surface is found to be, or the mean of several.
#[derive(Debug, Clone, Copy, Default)]
pub struct Reached {
    /// m.
    pub pixel: f64,
    pub asperities: f64,
    pub skewness: f64,
    pub kurtosis: f64,
    /// Nayak's bandwidth parameter.
    pub alpha: f64,
    /// Root mean square.
    pub gradient: f64,
    pub asperity_skewness: f64,
    /// Standard deviation of the radii over their mean.
    pub radius_cv: f64,
    pub height_radius_correlation: f64,
    /// Greenwood and Williamson's; 0 where nothing yields.
    pub plasticity_index: f64,
}

#[derive(Debug)]
pub struct AtLoad {
    /// The limits of admissible loads that are exceeded on some of the surfaces.
    pub exceeded: Exceeded,
    /// The mean over the surfaces, with the interval of their scatter; `None` where the load is not admissible on one.
    pub attribution: Option<Attribution>,
    /// In the order of [`QUANTITIES`].
    pub quantities: [QuantityAtLoad; 2],
}

/// How far the models are apart in one quantity, and from the reference, means over the surfaces.
#[derive(Debug, Clone, Default)]
pub struct QuantityAtLoad {
    /// The difference between the models; its verdict where the load is admissible on all surfaces.
    pub difference: Option<(Estimate, Option<Verdict>)>,
    /// Statistical and deterministic model less the reference, and the difference of their magnitudes.
    pub against: Option<[Estimate; 3]>,
    /// Where the reference was run: which model is nearer, as far as it can be told.
    pub nearer: Option<NearerStretch>,
}

impl QuantityAtLoad {
    /// Whether the models are known to agree within what is accepted.
    pub fn is_within(&self) -> bool {
        self.difference.is_some_and(|(_, verdict)| verdict == Some(Verdict::Within))
    }

    /// The nearer model, where it can be told.
    pub fn nearer_model(&self) -> Option<ModelKind> {
        self.nearer.as_ref()?.nearer
    }
}

impl GridPoint {
    /// Both models under a law at a load, by their indices; `None` without surfaces.
    pub fn at(&self, [law, load]: [usize; 2]) -> Option<&AtLoad> {
        Some(&self.surfaces.as_ref().ok()?.at[law][load])
    }

    pub fn parts(&self, condition: [usize; 2], quantity: ComparedQuantity) -> Option<&Contributions> {
        self.at(condition)?.attribution.as_ref()?.contributions(quantity)
    }

    /// The parts of the difference in a quantity, unless it is known to be within what is accepted: such a difference needs no cause.
    pub fn unaccepted(&self, condition: [usize; 2], quantity: ComparedQuantity) -> Option<&Contributions> {
        let is_within = self.quantity(condition, quantity)?.is_within();
        self.parts(condition, quantity).filter(|_| !is_within)
    }

    /// How far the models are apart in a quantity.
    pub fn quantity(&self, condition: [usize; 2], quantity: ComparedQuantity) -> Option<&QuantityAtLoad> {
        let place = QUANTITIES.iter().position(|one| *one == quantity)?;
        Some(&self.at(condition)?.quantities[place])
    }
}

/// Runs it. A point whose surfaces cannot be made, or do not reach a load, has none.
pub(super) fn run(context: &RunContext, plan: &CausesPlan) -> Result<CausesResults, InputError> {
    let start = Instant::now();
    let (counter, study) = (Counter::default(), &plan.compare.study);
    let loads = &study.controls.pressures;
    let ran = each_surface(context, &plan.compare, &counter, |results| {
        Ok(results.map(|results| surfaces(&results, loads)).map_err(|error| error.message().to_owned()))
    })?;
    // In the order of the points that have surfaces.
    let mut made = ran.results.into_iter();
    let points = plan.points.iter().filter_map(|point| {
        let surfaces = match &point.without_surface {
            None => made.next()?,
            Some(reason) => Err(reason.clone()),
        };
        let (skewness, kurtosis, wavelengths) = (point.skewness, point.kurtosis, point.wavelengths);
        Some(GridPoint { skewness, kurtosis, wavelengths, surfaces })
    });
    let points = points.collect();
    let mut timing = ran.timing;
    timing.total = start.elapsed();
    Ok(CausesResults {
        metadata: context.metadata(ran.papers, timing, Some(counter.work())),
        contact: contact_metadata(context.materials, &study.laws, &study.bodies, None),
        laws: study.laws.iter().map(|law| law.label.clone()).collect(),
        loads: loads.clone(),
        unit: plan.unit,
        realisations: study.surfaces.first().map_or(0, |surface| surface.realisations),
        common: plan.common.clone(),
        axis: plan.axis,
        has_reference: plan.compare.reference.is_some(),
        points,
    })
}

/// What is kept of the results on the surfaces of a point.
fn surfaces(results: &SurfaceResults, loads: &[f64]) -> GridSurfaces {
    let of_law = |case: &CaseStudy| loads.iter().map(|&load| at_load(case, load)).collect();
    GridSurfaces { reached: reached(results), at: results.cases.iter().map(of_law).collect() }
}

fn reached(results: &SurfaceResults) -> Reached {
    let all = &results.realisations;
    let mean = |of: &dyn Fn(usize) -> f64| (0..all.len()).map(of).sum::<f64>() / all.len() as f64;
    let statistics = |k: usize| &all[k].statistics;
    let roughness = |k: usize| all[k].roughness.as_ref();
    let plasticity_index =
        |k: usize| results.cases.iter().find_map(|case| case.realisations[k].plasticity_index).unwrap_or(0.0);
    Reached {
        pixel: results.surface.map.as_ref().map_or(0.0, |map| map.pixel[0]),
        asperities: mean(&|k| all[k].asperities as f64),
        skewness: mean(&|k| roughness(k).and_then(|map| map.moments.ssk).unwrap_or(0.0)),
        kurtosis: mean(&|k| roughness(k).and_then(|map| map.moments.sku).unwrap_or(0.0)),
        alpha: mean(&|k| roughness(k).and_then(|map| map.alpha()).unwrap_or(0.0)),
        gradient: mean(&|k| roughness(k).map_or(0.0, |map| map.rms_slope())),
        asperity_skewness: mean(&|k| statistics(k).skewness.unwrap_or(0.0)),
        radius_cv: mean(&|k| statistics(k).radius_cv),
        height_radius_correlation: mean(&|k| statistics(k).height_radius_correlation.unwrap_or(0.0)),
        plasticity_index: mean(&plasticity_index),
    }
}

fn at_load(case: &CaseStudy, load: f64) -> AtLoad {
    let verdicts = &case.verdicts;
    let on_each = case.realisations.iter().filter_map(|realisation| {
        let pairs = &realisation.comparison.pairs;
        pairs.iter().find(|pair| pair.pairing == Pairing::Load && pair.target == load)
    });
    let exceeded = on_each.fold(Exceeded::default(), |union, pair| union.union(pair.exceeded()));
    let attribution: Option<&Attribution> = verdicts.attribution.iter().find(|at| at.load == load);
    AtLoad {
        exceeded,
        attribution: attribution.filter(|_| exceeded.is_none()).cloned(),
        quantities: QUANTITIES.map(|quantity| quantity_at_load(verdicts, load, quantity, exceeded)),
    }
}

fn quantity_at_load(
    verdicts: &Verdicts,
    load: f64,
    quantity: ComparedQuantity,
    exceeded: Exceeded,
) -> QuantityAtLoad {
    let accepted: &Accepted = &verdicts.accepted;
    let difference = verdicts.differences.iter().find(|at| at.load == load);
    let with_verdict = difference.and_then(|at| at.estimates[quantity as usize]).map(|estimate| {
        let verdict = Verdict::from_estimate(&estimate, accepted.band(quantity));
        (estimate, exceeded.is_none().then_some(verdict))
    });
    let reference = verdicts.reference.as_ref();
    let against = reference.and_then(|reference| {
        let [statistical, deterministic] = &reference.against.models;
        let of = |all: &[asperity::compare::Difference]| {
            all.iter().find(|at| at.load == load)?.estimates[quantity as usize]
        };
        Some([of(statistical)?, of(deterministic)?, of(&reference.against.nearness)?])
    });
    let nearer = reference.and_then(|reference| {
        let holds_load = |[from, to]: [f64; 2]| (from..=to).contains(&load);
        let mut stretches = reference.nearer.iter().filter(|stretch| stretch.quantity == quantity);
        let mut found = stretches.find(|stretch| holds_load(stretch.loads)).cloned()?;
        // Admissible on all surfaces, not in their mean.
        let is_homogeneous = !reference.yields && !reference.is_layered;
        let is_compared = exceeded.is_none() || is_homogeneous && exceeded.is_at_most(Limit::LargeStrain);
        found.beyond = exceeded.limits().next();
        is_compared.then_some(found)
    });
    QuantityAtLoad { difference: with_verdict, against: against.filter(|_| nearer.is_some()), nearer }
}
