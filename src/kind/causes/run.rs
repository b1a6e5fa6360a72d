//! Running `[causes]`: both models, the states between them and the reference on every surface of the grid.

use std::time::Instant;

use asperity::compare::{Accepted, Attribution, ComparedQuantity, Pairing, Verdict};
use asperity::study::{CaseStudy, Verdicts};
use asperity::work::Counter;
use asperity::{Exceeded, Limit};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact::contact_metadata;
use asperity_contact_framework::input::InputError;

use super::plan::CausesPlan;
use super::results::{AtLoad, CausesResults, GridPoint, GridSurfaces, QUANTITIES, QuantityAtLoad, Reached};
use crate::kind::compare::each_surface;
use crate::kind::compare::results::SurfaceResults;

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
