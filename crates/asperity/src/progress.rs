//! Progress of long tasks, without knowledge of who watches.

/// Receives the progress of a run: its steps, if there are several of similar length, and within a step one stage after
/// the other. All methods do nothing by default and may be called from any thread; no result depends on them.
pub trait Progress: Sync {
    /// The run has `count` steps, such as the realisations of its surfaces.
    fn steps(&self, _count: u64) {}

    /// A step is done.
    fn step(&self) {}

    /// A stage begins, of `total` units of work.
    fn stage(&self, _name: &str, _total: f64) {}

    /// Units of work of the stage are done.
    fn advance(&self, _work: f64) {}
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {}
