//! Progress of long tasks, without knowledge of who watches.
//!
//! A sign of progress is also where a task ends that is no longer wanted: whoever watches then unwinds
//! ([`std::panic::resume_unwind`]). No stage goes on for long without one: work that is not divided into rows or other short tasks is counted
//! by a [`Count`]. Parallel tasks give their sign before they work: those that have not begun when one of them unwinds still begin.

/// Receives the progress of a run: its steps, if there are several of similar length, and within a step one stage after
/// the other. All methods do nothing by default and may be called from any thread; no result depends on them.
pub trait Progress: Sync {
    /// The run has `count` steps, such as the realisations of its surfaces.
    fn steps(&self, _count: u64) {}

    /// A step is done.
    fn step(&self) {}

    /// A stage begins, of `total` units of work.
    fn stage(&self, _name: &str, _total: f64) {}

    /// Units of work of the stage are done; none where a task only shows that it goes on.
    fn advance(&self, _work: f64) {}
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {}

/// A task within another one: its stages are shown with the task's name before theirs, and it has no steps.
pub struct Named<'a> {
    /// The name.
    pub name: String,
    /// Whoever watches the other one.
    pub progress: &'a dyn Progress,
}

impl Progress for Named<'_> {
    fn stage(&self, name: &str, total: f64) {
        self.progress.stage(&format!("{}: {name}", self.name), total);
    }

    fn advance(&self, work: f64) {
        self.progress.advance(work);
    }
}

/// A task within a stage of another one, of which a unit of its own work is `units`: it has neither steps nor stages. Of no units it only
/// shows that it goes on.
pub struct Share<'a> {
    /// Whoever watches the stage.
    pub progress: &'a dyn Progress,
    /// Units of work of the stage.
    pub units: f64,
}

impl Progress for Share<'_> {
    fn stage(&self, _: &str, _: f64) {
        self.progress.advance(0.0);
    }

    fn advance(&self, work: f64) {
        self.progress.advance(self.units * work);
    }
}

/// The most items, such as bytes of a file or points of a map, between two signs of progress.
pub const PIECE: usize = 1 << 20;

/// Counts items that are worked on one after the other, and tells of them in pieces.
pub struct Count<'a> {
    progress: &'a dyn Progress,
    /// Units of work of an item.
    item: f64,
    /// Items that are still to be told of.
    left: usize,
    /// Items that are done and not told of.
    done: usize,
}

impl<'a> Count<'a> {
    /// A count of `total` items, which are `work` units together.
    pub fn new(progress: &'a dyn Progress, work: f64, total: usize) -> Self {
        Self { progress, item: work / total.max(1) as f64, left: total, done: 0 }
    }

    /// More items are done.
    pub fn add(&mut self, items: usize) {
        self.done += items;
        if self.done >= PIECE {
            self.tell(self.done);
        }
    }

    /// All items are done, also those that were not counted.
    pub fn end(mut self) {
        self.tell(self.left);
    }

    /// Calls `task` with the values piece by piece, each of them an item: all that are counted.
    ///
    /// # Errors
    /// The first of `task`.
    pub fn pieces<T, E>(
        mut self,
        values: &mut [T],
        mut task: impl FnMut(&mut [T]) -> Result<(), E>,
    ) -> Result<(), E> {
        for piece in values.chunks_mut(PIECE) {
            task(piece)?;
            self.add(piece.len());
        }
        self.end();
        Ok(())
    }

    fn tell(&mut self, items: usize) {
        let told = items.min(self.left);
        self.left -= told;
        self.done = 0;
        self.progress.advance(self.item * told as f64);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[derive(Default)]
    struct Signs(Mutex<Vec<f64>>);

    impl Progress for Signs {
        fn advance(&self, work: f64) {
            self.0.lock().unwrap().push(work);
        }
    }

    #[test]
    fn items_are_told_of_in_pieces_and_all_in_the_end() {
        let signs = Signs::default();
        let half = Share { progress: &signs, units: 0.5 };
        let mut count = Count::new(&half, 1.0, 4 * PIECE);
        for _ in 0..10 {
            count.add(PIECE / 4);
        }
        assert_eq!(*signs.0.lock().unwrap(), [0.125; 2]);
        count.end();
        assert_eq!(*signs.0.lock().unwrap(), [0.125, 0.125, 0.25]);
    }

    #[test]
    fn more_items_than_there_should_be_are_signs_of_no_work() {
        let signs = Signs::default();
        let mut count = Count::new(&signs, 1.0, PIECE);
        (0..3).for_each(|_| count.add(PIECE));
        count.end();
        assert_eq!(*signs.0.lock().unwrap(), [1.0, 0.0, 0.0, 0.0]);
    }
}
