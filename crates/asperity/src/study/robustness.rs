//! Both models on a measured map under other treatments of it.

use crate::MeanRadius;
use crate::compare::{Controls, Difference};
use crate::progress::{Named, Progress};
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

/// The most at which it is found out whether an S filter makes them admissible.
const MOST_UNTIL_ADMISSIBLE: usize = 41;

/// Compares the models on a measured map, which was prepared as `own` and gave `cases`, under other treatments; `prepare` gives the surface of
/// the map in another preparation, not checked, with blocks by the same correlation lengths, and shows its progress. Where no load is admissible, only S filters, with
/// which some may be, if the map is fit. `None` unless both models were run and compared at equal load on a map.
pub fn under_treatments(
    setup: Setup,
    surface: &Surface,
    own: &Preparation,
    cases: &[CaseResults],
    prepare: impl Fn(Preparation, &dyn Progress) -> Option<Surface>,
    counter: &Counter,
) -> Option<Vec<TreatedCases>> {
    let is_admissible = |at: &Difference| at.exceeded().is_none();
    let any_is_admissible = cases.iter().flat_map(|case| &case.differences).any(is_admissible);
    if !any_is_admissible && surface.is_blocked() {
        return None;
    }
    let considered = |case: &CaseResults| -> Vec<f64> {
        let all = case.differences.iter();
        all.filter(|at| !any_is_admissible || is_admissible(at)).map(|at| at.load).collect()
    };
    let most = if any_is_admissible { MOST_LOADS } else { MOST_UNTIL_ADMISSIBLE };
    let mut loads: Vec<f64> = cases.iter().flat_map(|case| spread_over(considered(case), most)).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    if loads.is_empty() || !setup.has_both_models() {
        return None;
    }
    let controls = Controls::at_pressures(loads);
    let mut treatments = Treatment::all(own, setup.statistical, surface.map.as_ref()?);
    treatments.retain(|one| any_is_admissible || matches!(one, Treatment::ShortWaves(Some(_))));
    let count = treatments.len();
    let treated = treatments.into_iter().zip(1..).map(|(treatment, number)| {
        let progress = &Named { name: format!("robustness, {number} of {count}"), progress: setup.progress };
        let model = match treatment {
            Treatment::MeanRadius(mean_radius) => with_radius(setup.statistical, mean_radius),
            _ => setup.statistical.clone(),
        };
        let treated = Setup {
            controls: &controls,
            statistical: &model,
            is_attributed: false,
            generates: false,
            progress,
            ..setup
        };
        let treat = || {
            // The mean radius changes nothing on the surface.
            let prepared = match treatment {
                Treatment::MeanRadius(_) => None,
                _ => Some(prepare(treatment.preparation(*own), progress)?),
            };
            let (realisation, _) = study(treated, prepared.as_ref().unwrap_or(surface), counter).ok()?;
            Some(realisation.cases.into_iter().map(|case| case.differences).collect())
        };
        (treatment, treat().unwrap_or_default())
    });
    Some(treated.collect())
}

fn with_radius(model: &StatisticalModel, mean_radius: MeanRadius) -> StatisticalModel {
    StatisticalModel { mean_radius, ..model.clone() }
}

/// At most `most` (at least two) of the loads, evenly spread over their ranks, ascending.
fn spread_over(mut loads: Vec<f64>, most: usize) -> Vec<f64> {
    loads.sort_by(f64::total_cmp);
    let count = loads.len();
    if count <= most {
        return loads;
    }
    (0..most).map(|k| loads[(k * (count - 1) + (most - 1) / 2) / (most - 1)]).collect()
}
