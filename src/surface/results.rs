//! What a description of surfaces found.

use std::path::PathBuf;

use asperity_contact_framework::metadata::Metadata;

use asperity::surface::Surface;

/// Surfaces described, without any contact.
#[derive(Debug)]
pub struct SurfacesResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The spec.
    pub file: PathBuf,
    /// The surfaces, in file order.
    pub surfaces: Vec<Surface>,
}
