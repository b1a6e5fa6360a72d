//! Errors of all groups of cases: everything that the report contains.

use crate::stability::{GroupResults, Map};
use asperity_contact_framework::metadata::Metadata;

/// Errors against an evaluation of about 32 digits.
#[derive(Debug)]
pub struct StabilityResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// Group by group.
    pub groups: Vec<GroupResults>,
    /// Errors over planes.
    pub maps: Vec<Map>,
}
