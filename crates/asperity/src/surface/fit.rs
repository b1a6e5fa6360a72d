//! The preparation that makes a measured map fit: remedies of the failed checks, one after the other.

use std::sync::Arc;

use super::search::MOST_SPIKE_POINTS;
use super::{
    AnalysisDepth, FoundSpikes, MapFacts, MapOverview, NoAsperities, Preparation, Remedy, SummitSearch,
};
use crate::HeightMap;
use crate::progress::{Named, Progress};
use crate::topography::fitness::Finding;
use crate::topography::{Rows, Watched};

/// Settings of a preparation that stay as they are, because someone chose them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Kept {
    /// Whether spikes are removed.
    pub spikes: bool,
    /// Which lines are aligned.
    pub lines: bool,
    /// The form removed.
    pub level: bool,
    /// The S filter.
    pub s: bool,
    /// The L filter.
    pub l: bool,
}

impl Kept {
    fn forbids(self, remedy: Remedy) -> bool {
        match remedy {
            Remedy::RemoveSpikes => self.spikes,
            Remedy::AlignLines(_) => self.lines,
            Remedy::Level(_) => self.level,
            Remedy::ShortWaves(_) => self.s,
            Remedy::LongWaves(_) => self.l,
        }
    }
}

/// Why a remedy was not applied.
#[derive(Debug, Clone, PartialEq)]
pub enum NotApplied {
    /// Heights and pixel size are in different units, or the pixel is wrong: nothing else is worth doing.
    Units,
    /// No preparation remedies the fault, or none further.
    NoRemedy,
    /// The setting was chosen.
    Kept,
    /// More points would be removed as spikes than [`MOST_SPIKE_POINTS`]: this share of them.
    ManyPoints(f64),
    /// The variance of heights would change by more than a fault explains: to this multiple of what it was.
    Variance(f64),
    /// So few summits would be left.
    FewSummits(usize),
    /// The check would not come out better.
    NotBetter,
    /// The check would still fail with the strongest filter tried.
    StillFails,
    /// The map would have no asperities, or does not hold the filter.
    Impossible(String),
}

/// A failed check, and what was done about it.
#[derive(Debug, Clone, PartialEq)]
pub struct FitStep {
    /// The check as it failed.
    pub before: Finding,
    /// The remedy; `None` where no preparation helps.
    pub remedy: Option<Remedy>,
    /// The same measure with the remedy, where it was tried and can still be taken: no form is searched beyond a cubic one.
    pub after: Option<Finding>,
    /// The worst measure of the same check with the remedy, which may be another one.
    pub check_after: Option<Finding>,
    /// Sq with the remedy over Sq before, where it was tried.
    pub sq_ratio: Option<f64>,
    /// Why the remedy was not applied; `None` where it was.
    pub not_applied: Option<NotApplied>,
}

impl FitStep {
    /// One that was not even tried.
    fn refused(before: Finding, remedy: Option<Remedy>, reason: NotApplied) -> Self {
        Self { before, remedy, after: None, check_after: None, sq_ratio: None, not_applied: Some(reason) }
    }

    /// Whether another step is about the same check and setting.
    fn is_of_same(&self, other: &Self) -> bool {
        let same = |a: &Option<Remedy>, b: &Option<Remedy>| {
            a.as_ref().map(std::mem::discriminant) == b.as_ref().map(std::mem::discriminant)
        };
        self.before.check == other.before.check && same(&self.remedy, &other.remedy)
    }
}

/// A preparation found by [`Self::new`], and how.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The preparation to use.
    pub preparation: Preparation,
    /// What was done, in this order. A remedy that was tried twice stands where it was tried last.
    pub steps: Vec<FitStep>,
    /// Whether no check blocks the map so prepared.
    pub is_fit: bool,
    /// The spikes as this preparation treats them.
    pub spikes: FoundSpikes,
    /// The map before, with the spikes to mark on it: heights (m) for an image, and places (m).
    pub before: Option<(HeightMap, Vec<[f64; 2]>)>,
}

/// The variance of heights after over before that lines and filters may leave: at least half of it, and Sq at most a third above.
const VARIANCE: [f64; 2] = [0.5, 16.0 / 9.0];

/// As many summits are left at least, unless there were fewer before.
const LEAST_SUMMITS: usize = 100;

/// More steps than any map needs: each applied one goes further in one direction.
const MOST_STEPS: usize = 24;

impl Fit {
    /// Applies remedies to a measured map prepared by `preparation` until no check blocks it or none helps; settings that are `kept`
    /// stay as they are. `depth` is how large the image of the map before is.
    ///
    /// # Errors
    /// A map that has no asperities as it is prepared first.
    pub fn new(
        raw: &dyn Rows,
        preparation: Preparation,
        kept: Kept,
        depth: AnalysisDepth,
        progress: &dyn Progress,
    ) -> Result<Self, NoAsperities> {
        let mut analysis = Analysis { raw, progress, spikes: [None, None], trials: 0 };
        let (first, map) = analysis.facts(preparation, true)?;
        let before =
            map.and_then(|map| MapOverview::image(&map, depth)).map(|map| (map, first.spike_places()));
        let mut state = State { analysis, preparation, facts: first, kept };
        let mut steps: Vec<FitStep> = Vec::new();
        let mut refused: Vec<Remedy> = Vec::new();
        for _ in 0..MOST_STEPS {
            let Some((finding, remedy)) = state.next(&refused) else { break };
            let step = state.step(finding, remedy);
            // What was refused on the map as it was may help on the map as it is.
            steps.retain(|before| before.not_applied.is_none() || !before.is_of_same(&step));
            match step.not_applied {
                None => refused.clear(),
                Some(_) => refused.push(remedy),
            }
            steps.push(step);
        }
        let named = |check| steps.iter().any(|step| step.before.check == check && step.not_applied.is_some());
        let is_of_units = state.facts.blocking().any(Finding::is_of_units);
        let left: Vec<FitStep> = state
            .facts
            .blocking_in_order()
            .into_iter()
            .filter(|finding| !named(finding.check) && (!is_of_units || finding.is_of_units()))
            .map(|finding| {
                let not_applied =
                    if finding.is_of_units() { NotApplied::Units } else { NotApplied::NoRemedy };
                FitStep::refused(*finding, None, not_applied)
            })
            .collect();
        steps.extend(left);
        let is_fit = state.facts.blocking().next().is_none();
        // A check that came out fit by the remedy of another needs none any more.
        let is_open =
            |step: &FitStep| state.facts.blocking().any(|finding| finding.check == step.before.check);
        steps.retain(|step| step.not_applied.is_none() || is_open(step));
        let spikes =
            state.analysis.spikes[usize::from(state.preparation.removes_spikes)].take().unwrap_or_default();
        Ok(Self { preparation: state.preparation, steps, is_fit, spikes, before })
    }
}

/// A map under preparation.
struct State<'a> {
    analysis: Analysis<'a>,
    preparation: Preparation,
    facts: MapFacts,
    kept: Kept,
}

impl State<'_> {
    /// The next fault with its remedy, of those that were not refused; none where the units are wrong.
    fn next(&self, refused: &[Remedy]) -> Option<(Finding, Remedy)> {
        let blocking = self.facts.blocking_in_order();
        if blocking.first().is_some_and(|finding| finding.is_of_units()) && !self.has_spikes() {
            return None;
        }
        let remedies =
            blocking.into_iter().filter_map(|finding| Some((*finding, Remedy::new(finding, &self.facts)?)));
        remedies.into_iter().find(|(_, remedy)| !refused.contains(remedy))
    }

    /// Whether spikes may be why slopes are steep.
    fn has_spikes(&self) -> bool {
        self.facts.spikes.as_ref().is_some_and(|spikes| spikes.left.count() > 0 && spikes.removed == 0)
    }

    /// Share of the points that are those of spikes.
    fn share_of_spikes(&self) -> f64 {
        let points = self.facts.spikes.as_ref().map_or(0, |spikes| spikes.left.points.len());
        points as f64 / (self.facts.points[0] * self.facts.points[1]) as f64
    }

    /// Tries a remedy, and keeps it unless it is refused. Of filters the gentlest is kept that remedies the fault.
    fn step(&mut self, before: Finding, remedy: Remedy) -> FitStep {
        let mut last = None;
        for remedy in remedy.gentle_first(&self.facts) {
            let step = self.try_one(before, remedy);
            let is_last = !matches!(step.not_applied, Some(NotApplied::StillFails));
            last = Some(step);
            if is_last {
                break;
            }
        }
        last.unwrap_or_else(|| FitStep::refused(before, Some(remedy), NotApplied::NoRemedy))
    }

    fn try_one(&mut self, before: Finding, remedy: Remedy) -> FitStep {
        let refused = |reason| FitStep::refused(before, Some(remedy), reason);
        if self.kept.forbids(remedy) {
            return refused(NotApplied::Kept);
        }
        // So many would be removed that nothing else of the map matters.
        let share = self.share_of_spikes();
        if remedy == Remedy::RemoveSpikes && share > MOST_SPIKE_POINTS {
            return refused(NotApplied::ManyPoints(share));
        }
        let tried = remedy
            .applied(self.preparation)
            .map_err(NoAsperities::from)
            .and_then(|preparation| Ok((preparation, self.analysis.facts(preparation, false)?.0)));
        let (preparation, facts) = match tried {
            Ok(tried) => tried,
            Err(error) => return refused(NotApplied::Impossible(error.to_string())),
        };
        let check_after = facts.fitness.iter().find(|finding| finding.check == before.check).copied();
        let after = facts.measures.iter().find(|finding| finding.measure == before.measure).copied();
        let sq_ratio = facts.roughness.moments.sq / self.facts.roughness.moments.sq;
        let not_applied = self.why_not(remedy, &facts, &before, check_after.as_ref(), sq_ratio);
        if not_applied.is_none() {
            (self.preparation, self.facts) = (preparation, facts);
        }
        FitStep { before, remedy: Some(remedy), after, check_after, sq_ratio: Some(sq_ratio), not_applied }
    }

    fn why_not(
        &self,
        remedy: Remedy,
        facts: &MapFacts,
        before: &Finding,
        after: Option<&Finding>,
        sq_ratio: f64,
    ) -> Option<NotApplied> {
        let variance = sq_ratio * sq_ratio;
        let points = (facts.points[0] * facts.points[1]) as f64;
        let removed = facts.spikes.as_ref().map_or(0, |spikes| spikes.removed) as f64 / points;
        match remedy {
            Remedy::RemoveSpikes if removed > MOST_SPIKE_POINTS => {
                return Some(NotApplied::ManyPoints(removed));
            }
            Remedy::AlignLines(_) | Remedy::ShortWaves(_) | Remedy::LongWaves(_)
                if !(VARIANCE[0]..=VARIANCE[1]).contains(&variance) =>
            {
                return Some(NotApplied::Variance(variance));
            }
            _ => {}
        }
        if facts.summits < LEAST_SUMMITS.min(self.facts.summits) {
            return Some(NotApplied::FewSummits(facts.summits));
        }
        let has_passed = after.is_none_or(Finding::has_passed);
        if remedy.is_filter() {
            return (!has_passed).then_some(NotApplied::StillFails);
        }
        let is_better = has_passed || after.is_some_and(|after| after.excess() < before.excess());
        (!is_better).then_some(NotApplied::NotBetter)
    }
}

/// Analyses a map under one preparation after the other.
struct Analysis<'a> {
    raw: &'a dyn Rows,
    progress: &'a dyn Progress,
    /// The spikes where they are kept and where they are removed: no other setting changes them.
    spikes: [Option<FoundSpikes>; 2],
    /// Number of preparations that were tried.
    trials: usize,
}

impl Analysis<'_> {
    /// What is known of the map so prepared, and the map itself where it is kept.
    fn facts(
        &mut self,
        preparation: Preparation,
        keeps_map: bool,
    ) -> Result<(MapFacts, Option<HeightMap>), NoAsperities> {
        self.trials += 1;
        let progress = &Named { name: format!("fit, trial {}", self.trials), progress: self.progress };
        let search = SummitSearch { divides: false, keeps_map, progress, ..SummitSearch::new(preparation) };
        let raw = self.raw;
        let spikes = self.spikes[usize::from(preparation.removes_spikes)]
            .get_or_insert_with(|| search.spikes(&Watched { map: raw, progress }));
        let (facts, prepared) = SummitSearch { spikes: Some(spikes), ..search }.facts_and_map(raw)?;
        Ok((facts, prepared.map(|prepared| Arc::unwrap_or_clone(prepared.map))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::topography::Level;
    use crate::topography::fitness::{Check, Measure};
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};
    use crate::topography::summits::Neighbours;

    const SIDE: usize = 256;

    /// A map of Sq 0.1 um on pixels of 1 um, whose shortest waves are 8 um long, with what is `planted` (um).
    fn map(planted: impl Fn(usize, usize) -> f64) -> HeightMap {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 24.0, cut_off: 8.0 };
        let spectrum = Spectrum::new(shape, Lay::default()).unwrap().on_grid([SIDE; 2], [1.0; 2]);
        let heights = gaussian(&spectrum, 0.1, [9; 32]);
        let heights =
            heights.iter().enumerate().map(|(k, z)| 1e-6 * (z + planted(k / SIDE, k % SIDE))).collect();
        HeightMap::new([SIDE; 2], [1e-6; 2], heights, 0.0).unwrap()
    }

    fn fit(map: &HeightMap, kept: Kept) -> Fit {
        let preparation = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
        Fit::new(map, preparation, kept, AnalysisDepth::Comparison, &Silent).unwrap()
    }

    fn applied(fit: &Fit) -> Vec<Remedy> {
        let applied = fit.steps.iter().filter(|step| step.not_applied.is_none());
        applied.filter_map(|step| step.remedy).collect()
    }

    fn spikes(i: usize, j: usize) -> f64 {
        if i % 50 == 20 && j % 60 == 30 { 2.0 } else { 0.0 }
    }

    fn bow(i: usize, _: usize) -> f64 {
        0.3 * (i as f64 / 128.0 - 1.0).powi(2)
    }

    #[test]
    fn faults_are_remedied_in_order_until_the_map_is_fit() {
        let sound = fit(&map(|_, _| 0.0), Kept::default());
        assert!(sound.is_fit && sound.steps.is_empty(), "{:?}", sound.steps);
        let found = fit(&map(|i, j| spikes(i, j) + bow(i, j)), Kept::default());
        assert!(found.is_fit, "{:?}", found.steps);
        assert_eq!(applied(&found), [Remedy::RemoveSpikes, Remedy::Level(Level::Quadratic)]);
        let [first, second] = [0, 1].map(|k| found.steps[k].clone());
        assert!(first.before.value > 10.0 && first.after.unwrap().value == 0.0);
        assert!(second.before.value > 0.1 && second.after.unwrap().has_passed());
        assert!(found.preparation.removes_spikes && found.preparation.level == Level::Quadratic);
        let (image, marked) = found.before.unwrap();
        assert_eq!((image.points(), marked.len()), ([86; 2], first.before.value as usize));
    }

    #[test]
    fn settings_that_were_chosen_are_kept_and_the_map_stays_unfit() {
        let kept = Kept { level: true, l: true, ..Kept::default() };
        let found = fit(&map(|i, j| spikes(i, j) + bow(i, j)), kept);
        assert!(!found.is_fit && found.preparation.level == Level::Plane);
        assert_eq!(applied(&found), [Remedy::RemoveSpikes]);
        let refused = found.steps.iter().find(|step| step.before.check == Check::Form).unwrap();
        assert_eq!(refused.not_applied, Some(NotApplied::Kept));
    }

    #[test]
    fn remedies_that_change_more_than_a_fault_are_refused() {
        // Waves of the map's own length are most of it.
        let long = |i: usize, j: usize| 0.4 * ((i as f64 / 33.0).sin() + (j as f64 / 33.0).sin());
        let found = fit(&map(long), Kept { level: true, ..Kept::default() });
        let step = found.steps.iter().find(|step| step.before.check == Check::LongWaves).unwrap();
        assert!(
            matches!(step.not_applied, Some(NotApplied::Variance(ratio)) if ratio < 0.5),
            "{:?}",
            found.steps
        );
        assert!(!found.is_fit && found.preparation.filter.is_none());
        // One point in sixteen.
        let many = |i: usize, j: usize| if i % 4 + j % 4 == 0 { 5.0 } else { 0.0 };
        let found = fit(&map(many), Kept::default());
        let step = found.steps.iter().find(|step| step.before.check == Check::Spikes).unwrap();
        assert!(
            matches!(step.not_applied, Some(NotApplied::ManyPoints(share)) if share > 0.05),
            "{:?}",
            found.steps
        );
        assert!(!found.preparation.removes_spikes);
    }

    /// A step compares one measure before and after, also where another one of the check is the worst afterwards.
    #[test]
    fn a_step_has_the_same_measure_before_and_after() {
        let mut state = 1_u32;
        let noise: Vec<f64> = (0..SIDE * SIDE)
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                0.03 * (f64::from(state >> 8) / f64::from(1 << 24) - 0.5)
            })
            .collect();
        let found = fit(&map(|i, j| noise[i * SIDE + j]), Kept::default());
        let step = found.steps.iter().find(|step| step.before.check == Check::FinePixel).unwrap();
        let [after, worst] = [step.after.unwrap(), step.check_after.unwrap()];
        assert_eq!((step.before.measure, after.measure), (Measure::GrowthRise, Measure::GrowthRise));
        assert_eq!(worst.measure, Measure::NoiseGrowth);
        assert!(after.value < 0.1 && step.before.value > 0.1 && step.not_applied.is_none(), "{step:?}");
    }

    /// Whoever watches sees no stage begin twice, and the spikes of the map searched once.
    #[test]
    fn no_stage_begins_twice() {
        struct Stages(std::sync::Mutex<Vec<String>>);
        impl Progress for Stages {
            fn stage(&self, name: &str, _total: f64) {
                self.0.lock().unwrap().push(name.to_owned());
            }
        }
        let stages = Stages(Vec::new().into());
        let many = |i: usize, j: usize| if i % 4 + j % 4 == 0 { 5.0 } else { 0.3 * (j as f64 / 33.0).sin() };
        let preparation = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
        let found =
            Fit::new(&map(many), preparation, Kept::default(), AnalysisDepth::Comparison, &stages).unwrap();
        assert!(!found.is_fit && found.steps.len() > 1, "{:?}", found.steps);
        let stages = stages.0.into_inner().unwrap();
        let is_again = |k: usize| stages[..k].contains(&stages[k]);
        assert_eq!((0..stages.len()).find(|&k| is_again(k)), None, "{stages:?}");
        assert_eq!(stages.iter().filter(|stage| stage.contains("spikes")).count(), 1, "{stages:?}");
        assert!(stages.iter().any(|stage| stage == "fit, trial 2: levelling"), "{stages:?}");
    }

    #[test]
    fn wrong_units_are_reported_and_nothing_is_remedied() {
        let heights = map(bow).into_heights().iter().map(|z| 1e3 * z).collect();
        let found = fit(&HeightMap::new([SIDE; 2], [1e-6; 2], heights, 0.0).unwrap(), Kept::default());
        let refusals: Vec<_> =
            found.steps.iter().map(|step| (step.before.check, step.not_applied.clone())).collect();
        assert_eq!(refusals, [(Check::Slope, Some(NotApplied::Units))]);
        assert!(!found.is_fit && found.preparation.level == Level::Plane);
    }
}
