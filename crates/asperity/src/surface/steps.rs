//! The steps of a preparation: from a map as it was measured to the map whose summits are searched.

use super::NoAsperities;
use super::search::{Preparation, SummitSearch};
use crate::progress::Progress;
use crate::topography::fitness::{AlignedLines, Without};
use crate::topography::tip::{TipReach, WORK, eroded};
use crate::topography::{Levelled, Rows, Watched, Window};
use crate::{HeightMap, named_enum};

named_enum! {
    /// A step of the preparation of a map.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Step {
        /// None yet: the map as it was measured, or generated.
        Measured = "measured",
        /// Spikes became missing points.
        SpikesRemoved = "spikes-removed",
        /// Lines of the scan were set to the same mean height.
        LinesAligned = "lines-aligned",
        /// What the tip of the instrument added was eroded.
        Eroded = "eroded",
        /// The form was removed.
        Levelled = "levelled",
        /// Filters were applied.
        Filtered = "filtered",
    }
}

/// A map during its preparation.
pub(super) struct PreparationSteps<'a> {
    /// Without its spikes.
    pub(super) without: &'a dyn Rows,
    /// What the tip has reached, where it was eroded.
    pub(super) reach: Option<TipReach>,
    /// Without its form, and what that was.
    pub(super) levelled: &'a Levelled<'a>,
    /// The last of the steps.
    pub(super) last: &'a dyn Rows,
    /// Those that the preparation has, in order.
    all: Vec<(Step, &'a dyn Rows)>,
}

impl Preparation {
    /// Whether it has this step.
    pub fn has(&self, step: Step) -> bool {
        match step {
            Step::Measured => true,
            Step::SpikesRemoved => self.removes_spikes || self.removes_suspects,
            Step::LinesAligned => self.aligned.is_some(),
            Step::Eroded => self.tip.is_some(),
            Step::Levelled => self.level != crate::topography::Level::None,
            Step::Filtered => self.filter.is_some(),
        }
    }

    /// The steps of the preparation of a map, of which the spikes at `removed` are missing points.
    pub(super) fn steps<T>(
        &self,
        raw: &dyn Rows,
        removed: &[usize],
        progress: &dyn Progress,
        of: impl FnOnce(PreparationSteps) -> Result<T, NoAsperities>,
    ) -> Result<T, NoAsperities> {
        let without = Without { map: raw, points: removed };
        let aligned = self.aligned.map(|lines| AlignedLines::new(&without, lines));
        let straight: &dyn Rows = aligned.as_ref().map_or(&without as &dyn Rows, |aligned| aligned);
        let eroded: Option<(HeightMap, TipReach)> = self.tip.map(|radius| {
            progress.stage("tip", WORK);
            eroded(straight, radius)
        });
        let cleaned: &dyn Rows = eroded.as_ref().map_or(straight, |(map, _)| map);
        let cleaned: &dyn Rows = &Watched { map: cleaned, progress };
        progress.stage("levelling", 1.0);
        let levelled = Levelled { map: cleaned, form: self.level.form(cleaned)? };
        let filtered = match self.filter {
            Some(filter) => {
                progress.stage("filtering", filter.work(raw.pixel()));
                Some(filter.apply(&levelled)?)
            }
            None => None,
        };
        let last: &dyn Rows = filtered.as_ref().map_or(&levelled as &dyn Rows, |map| map);
        let maps = [raw, &without, straight, cleaned, &levelled, last];
        let all = Step::ALL.into_iter().zip(maps).filter(|(step, _)| self.has(*step)).collect();
        of(PreparationSteps {
            without: &without,
            reach: eroded.as_ref().map(|(_, reach)| *reach),
            levelled: &levelled,
            last,
            all,
        })
    }
}

impl SummitSearch<'_> {
    /// Calls `take` with the map after each step of its preparation, in order, also where the map has no asperities. Only the tip and
    /// filters need it in memory.
    ///
    /// # Errors
    /// A form that the map does not determine, a filter that it does not hold, a file that became shorter.
    pub fn each_step(
        &self,
        map: &dyn Rows,
        mut take: impl FnMut(Step, &dyn Rows),
    ) -> Result<(), NoAsperities> {
        let map: &dyn Rows = &Watched { map, progress: self.progress };
        let halves = Window::halves(map);
        let map: &dyn Rows = self.preparation.half.map_or(map, |half| &halves[half]);
        let removed = self.spikes(map).removed;
        self.preparation.steps(map, &removed, self.progress, |steps| {
            steps.all.into_iter().for_each(|(step, map)| take(step, map));
            if map.is_whole() { Ok(()) } else { Err(NoAsperities::Shortened) }
        })
    }
}
