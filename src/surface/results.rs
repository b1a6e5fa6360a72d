//! What a description of surfaces found.

use std::path::PathBuf;

use asperity_framework::metadata::Metadata;

use super::found::Surface;

/// Surfaces described, without any contact.
#[derive(Debug)]
pub struct SurfacesResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// The measured file, or the spec.
    pub file: PathBuf,
    /// The spec that the command line made for a measured file.
    pub spec_text: Option<String>,
    /// The surfaces, in file order.
    pub surfaces: Vec<Surface>,
}
