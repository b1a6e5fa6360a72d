//! What every experiment has: title, seed, sources, time and work.

use crate::group::Group;
use crate::input::material::MaterialOrigin;
use asperity::Paper;
pub use asperity::work::Timing;
use asperity::work::Work;
use asperity_plot::Size;
use indexmap::IndexMap;

#[derive(Debug, Clone)]
pub struct Metadata {
    /// What the report is called.
    pub title: String,
    /// Name of the spec's table of its kind.
    pub kind: &'static str,
    /// Name of the spec's file, without its ending.
    pub stem: String,
    /// What runs it again.
    pub again: Again,
    /// Notes of the spec's author.
    pub notes: String,
    /// SHA-256 of the spec, hexadecimal.
    pub spec_sha256: String,
    /// SHA-256 of the spec, of how it is run, and of its input files, hexadecimal.
    pub input_sha256: String,
    /// The size of its figures in print; `None` of figures for the page only.
    pub figure: Option<Size>,
    /// Whether it runs only where it is named or long runs are asked for.
    pub is_long: bool,
    /// Where the index lists its report.
    pub group: Option<Group>,
    /// SHA-256 of the sources of the library, hexadecimal.
    pub library_sha256: &'static str,
    /// Every random number came from it.
    pub seed: u64,
    /// The materials whose values are from the library.
    pub origins: IndexMap<String, MaterialOrigin>,
    /// References for the run.
    pub papers: Vec<Paper>,
    /// Where the time went.
    pub timing: Timing,
    /// What was done; `None` where that depends on the clock, or is the experiment itself.
    pub work: Option<Work>,
}

/// What runs an experiment again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Again {
    Command(String),
    /// The spec itself, which has no file.
    Spec(String),
}
