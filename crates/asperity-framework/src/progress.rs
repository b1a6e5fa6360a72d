//! Telling whoever watches how far a run is, without knowing who watches.

/// Progress of a run. All methods do nothing by default.
pub trait Progress: Sync {
    /// A stage begins, of so many steps.
    fn stage(&self, _what: &str, _steps: u64) {}
    /// So many steps of the stage are done.
    fn advance(&self, _steps: u64) {}
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {}
