//! Both models on a measured map under other treatments of it.

use crate::MeanRadius;
use crate::compare::{Controls, Difference};
use crate::progress::Silent;
use crate::surface::{Preparation, Surface};
use crate::work::Counter;

use super::results::CaseResults;
use super::run::study;
use super::setup::Setup;
use super::statistical::StatisticalModel;
use super::treatment::Treatment;

/// The differences between the models under one treatment of a map, case by case; empty where the treated map has no asperities
/// or a model does not reach a load.
pub type TreatedCases = (Treatment, Vec<Vec<Difference>>);

/// The most loads of a case at which verdicts are computed again.
const MOST_LOADS: usize = 9;

/// Compares the models on a measured map, which was prepared as `own` and gave `cases`, under other treatments; `prepare` gives the surface of
/// the map in another preparation, not checked, with blocks by the same correlation lengths. `None` unless both models were run and
/// compared at an admissible load of a map.
pub fn under_treatments(
    setup: Setup,
    surface: &Surface,
    own: &Preparation,
    cases: &[CaseResults],
    prepare: impl Fn(Preparation) -> Option<Surface>,
    counter: &Counter,
) -> Option<Vec<TreatedCases>> {
    let mut loads: Vec<f64> = cases.iter().flat_map(|case| some_loads(&case.differences)).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    if loads.is_empty() || !setup.has_both_models() {
        return None;
    }
    let controls = Controls::at_pressures(loads);
    let treatments = Treatment::all(own, setup.statistical, surface.map.as_ref()?);
    setup.progress.stage("robustness", treatments.len() as f64);
    let treated = treatments.into_iter().map(|treatment| {
        let model = match treatment {
            Treatment::MeanRadius(mean_radius) => with_radius(setup.statistical, mean_radius),
            _ => setup.statistical.clone(),
        };
        let treated = Setup {
            controls: &controls,
            statistical: &model,
            is_attributed: false,
            generates: false,
            progress: &Silent,
            ..setup
        };
        let treat = || {
            // The mean radius changes nothing on the surface.
            let prepared = match treatment {
                Treatment::MeanRadius(_) => None,
                _ => Some(prepare(treatment.preparation(*own))?),
            };
            let (realisation, _) = study(treated, prepared.as_ref().unwrap_or(surface), counter).ok()?;
            Some(realisation.cases.into_iter().map(|case| case.differences).collect())
        };
        let differences = treat().unwrap_or_default();
        setup.progress.advance(1.0);
        (treatment, differences)
    });
    Some(treated.collect())
}

fn with_radius(model: &StatisticalModel, mean_radius: MeanRadius) -> StatisticalModel {
    StatisticalModel { mean_radius, ..model.clone() }
}

/// At most [`MOST_LOADS`] of the admissible loads, evenly spread over their ranks.
fn some_loads(differences: &[Difference]) -> Vec<f64> {
    let mut loads: Vec<f64> =
        differences.iter().filter(|at| at.exceeded().is_none()).map(|at| at.load).collect();
    loads.sort_by(f64::total_cmp);
    let count = loads.len();
    if count <= MOST_LOADS {
        return loads;
    }
    (0..MOST_LOADS).map(|k| loads[(k * (count - 1) + (MOST_LOADS - 1) / 2) / (MOST_LOADS - 1)]).collect()
}
