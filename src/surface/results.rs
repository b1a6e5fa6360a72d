//! What a description of surfaces found.

use std::path::PathBuf;

use asperity_contact_framework::metadata::Metadata;

use asperity::surface::Surface;

/// Surfaces described, without any contact.
#[derive(Debug)]
pub struct SurfacesResults {
    pub metadata: Metadata,
    pub file: PathBuf,
    /// The surfaces, in file order.
    pub surfaces: Vec<Surface>,
}
