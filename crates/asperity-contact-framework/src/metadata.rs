//! What every experiment has: title, seed, sources, time and work.

use asperity::Paper;
pub use asperity::work::Timing;
use asperity::work::Work;
use asperity_plot::Size;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::input::material::MaterialOrigin;

#[derive(Debug, Clone)]
pub struct Metadata {
    pub title: String,
    /// Name of the spec's table of its kind.
    pub kind: &'static str,
    /// Name of the spec's file, without its ending.
    pub stem: String,
    pub again: Again,
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
    pub papers: Vec<Paper>,
    pub timing: Timing,
    /// What was done; `None` where that depends on the clock, or is the experiment itself.
    pub work: Option<Work>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Again {
    Command(String),
    /// The spec itself, which has no file.
    Spec(String),
}

/// What a report is about, by which the index groups reports; one without a group is about its user's surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// Figures and surfaces of Pasaribu and Schipper (2005).
    Paper,
    /// Layers.
    Layers,
    /// Joints: what the contact conducts and how it resists sliding.
    Joints,
    /// Contact laws.
    Laws,
    /// Why the models differ.
    Why,
    /// Both models beside boundary elements.
    RealityCheck,
    /// How far to trust the program.
    Trust,
}

impl Group {
    /// All groups, in the order of the index.
    pub const ALL: [Self; 7] =
        [Self::Paper, Self::Layers, Self::Joints, Self::Laws, Self::Why, Self::RealityCheck, Self::Trust];

    /// Its heading in the index.
    pub fn title(self) -> &'static str {
        match self {
            Self::Paper => "The paper",
            Self::Layers => "Layers",
            Self::Joints => "Conductance and friction",
            Self::Laws => "Laws",
            Self::Why => "Why the models differ",
            Self::RealityCheck => "Reality check",
            Self::Trust => "How far to trust the program",
        }
    }
}
