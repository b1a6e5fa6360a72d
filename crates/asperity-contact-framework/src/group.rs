//! Groups of reports.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
