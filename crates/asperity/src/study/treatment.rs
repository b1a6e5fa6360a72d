//! Treatments of a measured map that a colleague would question, and both models under them.

use super::models::StatisticalModel;
use super::results::CaseResults;
use super::run::study;
use super::setup::Setup;
use crate::compare::{Controls, Difference};
use crate::progress::{Named, Progress};
use crate::surface::{MapFacts, Preparation, Surface};
use crate::topography::summits::Neighbours;
use crate::topography::{Filter, Level};
use crate::work::Counter;
use crate::{MeanRadius, named_enum};

named_enum! {
    /// A choice made in the analysis of a map.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Choice {
        /// The nesting index of the S filter.
        ShortWaves = "short-wavelength-cut-off",
        /// What a summit is.
        Summits = "summits",
        /// The mean radius of the statistical model.
        MeanRadius = "mean-radius",
        /// The form removed.
        Level = "level",
        /// Whether spikes, and points that could be some, are removed.
        Spikes = "spikes",
        /// The part of the map.
        Part = "part",
    }
}

impl Choice {
    /// Whether a verdict depends on the choice already where another treatment leaves it open. Points that may be wrong decide nothing;
    /// other treatments move a difference by parts of its interval on any surface, and halves of a map are other samples.
    pub const fn leaves_open(self) -> bool {
        matches!(self, Self::Spikes)
    }
}

/// One other way to treat a map, or to take the mean radius of its asperities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Treatment {
    /// An S filter of this nesting index, m; or none.
    ShortWaves(Option<f64>),
    /// Other summits.
    Summits(Neighbours),
    /// The other mean radius.
    MeanRadius(MeanRadius),
    /// Another form removed.
    Level(Level),
    /// Spikes removed.
    SpikesRemoved,
    /// This many single points removed that are as narrow as spikes, but lower.
    SuspectsRemoved(usize),
    /// One half of the map, 0 or 1.
    Half(usize),
}

/// Nesting indices of S filters, in pixels.
const PIXELS: [f64; 4] = [2.0, 4.0, 8.0, 16.0];

impl Treatment {
    /// The treatments of a map that was prepared so, with the facts found, other than its own.
    pub fn all(own: &Preparation, model: &StatisticalModel, map: &MapFacts) -> Vec<Self> {
        let mut all = vec![Self::Summits(match own.neighbours {
            Neighbours::Four => Neighbours::Eight,
            Neighbours::Eight => Neighbours::Four,
        })];
        all.extend(model.joint.is_none().then_some(Self::MeanRadius(model.mean_radius.other())));
        all.extend(own.level.previous().map(Self::Level));
        all.extend(own.level.next().map(Self::Level));
        all.extend(short_waves(own.filter, map).into_iter().map(Self::ShortWaves));
        if let Some(spikes) = &map.spikes {
            all.extend((spikes.left.count() > 0).then_some(Self::SpikesRemoved));
            let suspects = spikes.left.suspects.len();
            all.extend((suspects > 0).then_some(Self::SuspectsRemoved(suspects)));
        }
        all.extend([0, 1].map(Self::Half));
        all
    }

    /// The choice that it makes in another way.
    pub fn choice(&self) -> Choice {
        match self {
            Self::ShortWaves(_) => Choice::ShortWaves,
            Self::Summits(_) => Choice::Summits,
            Self::MeanRadius(_) => Choice::MeanRadius,
            Self::Level(_) => Choice::Level,
            Self::SpikesRemoved | Self::SuspectsRemoved(_) => Choice::Spikes,
            Self::Half(_) => Choice::Part,
        }
    }

    /// The preparation of a map that is otherwise prepared as `own`.
    pub fn preparation(&self, own: Preparation) -> Preparation {
        match *self {
            Self::ShortWaves(s) => {
                let l = own.filter.and_then(|filter| filter.l());
                Preparation { filter: Filter::new(s, l).ok(), ..own }
            }
            Self::Summits(neighbours) => Preparation { neighbours, ..own },
            Self::MeanRadius(_) => own,
            Self::Level(level) => Preparation { level, ..own },
            Self::SpikesRemoved => Preparation { removes_spikes: true, ..own },
            Self::SuspectsRemoved(_) => Preparation { removes_suspects: true, ..own },
            Self::Half(half) => Preparation { half: Some(half), ..own },
        }
    }
}

/// Nesting indices other than that of `own`: none, and 2 to 16 pixels, as far as the L filter and the map allow.
fn short_waves(own: Option<Filter>, map: &MapFacts) -> Vec<Option<f64>> {
    /// Nesting indices closer than this ratio are the same.
    const SAME: f64 = 1.1;
    let s = own.and_then(|filter| filter.s());
    let l = own.and_then(|filter| filter.l());
    let pixel = map.pixel[0].max(map.pixel[1]);
    let is_other = |index: &f64| {
        s.is_none_or(|s| (s / index).max(index / s) > SAME) && l.is_none_or(|l| *index < 0.5 * l)
    };
    let is_allowed = |index: &f64| {
        Filter::new(Some(*index), l).is_ok_and(|filter| filter.check(map.points, map.pixel).is_ok())
    };
    let mut all: Vec<Option<f64>> = s.map(|_| None).into_iter().collect();
    all.extend(PIXELS.map(|pixels| pixels * pixel).into_iter().filter(is_other).filter(is_allowed).map(Some));
    all
}

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
            Treatment::MeanRadius(mean_radius) => {
                StatisticalModel { mean_radius, ..setup.statistical.clone() }
            }
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

/// At most `most` (at least two) of the loads, evenly spread over their ranks, ascending.
fn spread_over(mut loads: Vec<f64>, most: usize) -> Vec<f64> {
    loads.sort_by(f64::total_cmp);
    let count = loads.len();
    if count <= most {
        return loads;
    }
    (0..most).map(|k| loads[(k * (count - 1) + (most - 1) / 2) / (most - 1)]).collect()
}
