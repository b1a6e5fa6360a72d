//! Running `[causes]`: both models and the states between them on every surface of the grid.

use std::time::Instant;

use asperity::compare::{Attribution, Inputs, Pair, Rearranged, pairs_at};
use asperity::topography::generate::Seeds;
use asperity::topography::summits::{Detail, Neighbours, find};
use asperity::topography::{MapError, RoughnessParameters};
use asperity::{
    AsperitySet, Deterministic, Exceeded, Heights, MicroContact, Population, ReferencePlane, Shape,
    Statistical, Statistics, literature, plasticity_index,
};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::contact::{contact_metadata, papers_of};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::Timing;

use super::plan::{CausesPlan, PointPlan};
use super::results::{AtLoad, CausesResults, GridPoint, Reached};

/// One surface.
struct One {
    reached: Reached,
    /// Load by load; `None` where a model does not reach it.
    at: Vec<Option<(Exceeded, Attribution)>>,
}

/// Runs it.
///
/// # Errors
/// A surface without summits.
pub(super) fn run(context: &RunContext, plan: &CausesPlan) -> Result<CausesResults, InputError> {
    let start = Instant::now();
    context.progress.stage("surfaces", (plan.points.len() * plan.realisations) as f64);
    let point = |point| of_point(context, plan, point);
    let points = plan.points.iter().map(point).collect::<Result<Vec<_>, _>>()?;
    let laws = std::slice::from_ref(&plan.law);
    let mut papers = papers_of(laws);
    papers.extend([literature::GREENWOOD_1984, literature::NAYAK_1971]);
    papers.extend(plan.points.iter().flat_map(|point| point.generator.process.heights.papers()));
    let timing = Timing { total: start.elapsed(), ..Timing::default() };
    Ok(CausesResults {
        metadata: context.metadata(papers, timing, None),
        contact: contact_metadata(context.materials, laws, &plan.bodies, None),
        law: plan.law.label.clone(),
        loads: plan.loads.clone(),
        unit: plan.unit,
        realisations: plan.realisations,
        sigma: plan.sigma,
        gradient: plan.gradient,
        hurst: plan.hurst,
        points,
    })
}

fn of_point(context: &RunContext, plan: &CausesPlan, point: &PointPlan) -> Result<GridPoint, InputError> {
    let one = |realisation: usize| {
        let stream = format!("skewness {} wavelengths {} {realisation}", point.skewness, point.wavelengths);
        let found = of_surface(plan, point, context.stream_seed(&stream)).map_err(|error| {
            let what = format!("skewness {}, wavelengths {}", point.skewness, point.wavelengths);
            InputError::file(&context.source.path, format!("a surface of {what}: {error}"))
        });
        context.progress.advance(1.0);
        found
    };
    let all = (1..=plan.realisations).map(one).collect::<Result<Vec<One>, _>>()?;
    let mean =
        |of: fn(&Reached) -> f64| all.iter().map(|one| of(&one.reached)).sum::<f64>() / all.len() as f64;
    let at_load = |index: usize| {
        let reached = || all.iter().filter_map(|one| one.at[index].as_ref());
        let exceeded = reached().fold(Exceeded::default(), |union, (exceeded, _)| union.union(*exceeded));
        // Beyond the valid range of one, the point has none of the load.
        let is_valid = exceeded.is_none() && reached().count() == all.len();
        let each: Vec<Vec<Attribution>> = reached().map(|(_, found)| vec![found.clone()]).collect();
        let attribution = is_valid.then(|| Attribution::over(&each).into_iter().next()).flatten();
        AtLoad { load: plan.loads[index], exceeded, attribution }
    };
    Ok(GridPoint {
        skewness: point.skewness,
        kurtosis: point.kurtosis(),
        wavelengths: point.wavelengths,
        pixel: point.generator.pixel[0],
        points: point.generator.points[0],
        reached: Reached {
            asperities: mean(|one| one.asperities),
            skewness: mean(|one| one.skewness),
            kurtosis: mean(|one| one.kurtosis),
            alpha: mean(|one| one.alpha),
            gradient: mean(|one| one.gradient),
            asperity_skewness: mean(|one| one.asperity_skewness),
            radius_cv: mean(|one| one.radius_cv),
            height_radius_correlation: mean(|one| one.height_radius_correlation),
            plasticity_index: mean(|one| one.plasticity_index),
        },
        at: (0..plan.loads.len()).map(at_load).collect(),
    })
}

/// One surface, its five-point summits and both models on them.
fn of_surface(plan: &CausesPlan, point: &PointPlan, seed: [u8; 32]) -> Result<One, String> {
    let seeds = Seeds { process: seed, plateau: seed };
    let (map, _) = point.generator.surface(seeds).map_err(|error: MapError| error.to_string())?;
    let roughness = RoughnessParameters::new(&map);
    let summits = find(&map, Neighbours::Four, Detail::default());
    let radii = summits.curvatures.iter().map(|curvature| curvature.recip()).collect();
    let [width, length] = [0, 1].map(|axis| map.pixel()[axis] * map.points()[axis] as f64);
    let set = AsperitySet::new(summits.heights, radii, width * length).map_err(|error| error.to_string())?;
    let statistics = Statistics::new(&set);
    let population = Population {
        radius: statistics.mean_radius,
        sigma: statistics.sigma,
        density: set.density(),
        heights: Heights::GAUSSIAN,
    };
    let plane = ReferencePlane::from(&statistics);
    let contact: &dyn MicroContact = &*plan.law.contact;
    let statistical = Statistical::new(contact, population.clone());
    let deterministic = Deterministic::new(contact, set.spheres(), plane);
    let pairs = pairs_at(&statistical, &deterministic, &plan.loads);
    let rearranged = Rearranged::new(Inputs {
        asperities: set.spheres(),
        plane,
        mean_shape: Shape::sphere(population.radius),
        other_shape: Some(Shape::sphere(statistics.radius_of_mean_curvature)),
        population,
        reporting_plane: ReferencePlane { mean: 0.0, sigma: statistics.sigma },
    });
    let at = |pair: &Option<Pair>| {
        let pair = (*pair)?;
        let attribution = rearranged.at_loads(contact, &[pair]).attributions(None).into_iter().next()?;
        Some((pair.exceeded(), attribution))
    };
    let moments = roughness.moments;
    Ok(One {
        reached: Reached {
            asperities: set.count() as f64,
            skewness: moments.ssk.unwrap_or(0.0),
            kurtosis: moments.sku.unwrap_or(0.0),
            alpha: roughness.alpha().unwrap_or(0.0),
            gradient: roughness.rms_slope(),
            asperity_skewness: statistics.skewness.unwrap_or(0.0),
            radius_cv: statistics.radius_cv,
            height_radius_correlation: statistics.height_radius_correlation.unwrap_or(0.0),
            plasticity_index: plasticity_index(contact, statistics.sigma, statistics.mean_radius)
                .unwrap_or(0.0),
        },
        at: pairs.iter().map(at).collect(),
    })
}
