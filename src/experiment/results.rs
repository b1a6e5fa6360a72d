//! What an experiment found: everything that a report may say.

use std::time::Duration;

use indexmap::IndexMap;

use super::surface::Surface;
use crate::asperity::Population;
use crate::compare::{Comparison, Gaps, LimitPoint};
use crate::literature::Paper;
use crate::material::Material;

/// The two bodies, by name.
#[derive(Debug, Clone)]
pub struct Bodies {
    /// Material of the rough body.
    pub rough: String,
    /// Material of the flat.
    pub flat: String,
}

/// What every experiment has.
#[derive(Debug, Clone)]
pub struct Head {
    /// What the report is called.
    pub title: String,
    /// Name of the spec's file, without its ending.
    pub stem: String,
    /// SHA-256 of the spec, hexadecimal.
    pub spec_sha256: String,
    /// Every random number came from it.
    pub seed: u64,
    /// The bodies of the spec.
    pub materials: IndexMap<String, Material>,
    /// Who touches whom.
    pub bodies: Bodies,
    /// Reduced modulus of the pair, Pa.
    pub reduced_modulus: f64,
    /// Hardness of the softer body, Pa.
    pub hardness: Option<f64>,
    /// The papers behind what was run.
    pub papers: Vec<Paper>,
    /// Where the time went.
    pub timing: Timing,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default)]
pub struct Timing {
    /// Reading files.
    pub read: Duration,
    /// Drawing asperities.
    pub generate: Duration,
    /// Levelling, filtering, finding summits.
    pub summits: Duration,
    /// The integrals.
    pub statistical: Duration,
    /// The sums, ordering included.
    pub deterministic: Duration,
    /// From the spec to the results.
    pub total: Duration,
}

/// The results of one experiment.
#[derive(Debug)]
pub enum Results {
    /// Of `[compare]`.
    Compare(CompareResults),
    /// Of `[limit]`.
    Limit(LimitResults),
}

impl Results {
    /// What every experiment has.
    pub fn head(&self) -> &Head {
        match self {
            Self::Compare(results) => &results.head,
            Self::Limit(results) => &results.head,
        }
    }
}

impl Results {
    /// What makes the answers doubtful, a line each.
    pub fn warnings(&self) -> Vec<String> {
        match self {
            Self::Compare(results) => results.warnings(),
            Self::Limit(_) => Vec::new(),
        }
    }
}

impl CompareResults {
    /// What makes the answers doubtful, a line each.
    pub fn warnings(&self) -> Vec<String> {
        let of = |found: &SurfaceResults| {
            let name = found.surface.name.clone();
            found
                .surface
                .warnings
                .clone()
                .into_iter()
                .map(move |warning| format!("surface {name}: {warning}"))
        };
        self.surfaces.iter().flat_map(of).collect()
    }
}

/// Both models on given surfaces.
#[derive(Debug)]
pub struct CompareResults {
    /// What every experiment has.
    pub head: Head,
    /// Surface by surface, in file order.
    pub surfaces: Vec<SurfaceResults>,
}

/// One surface and what it answered.
#[derive(Debug)]
pub struct SurfaceResults {
    /// The surface.
    pub surface: Surface,
    /// The population that the statistical model stands on.
    pub population: Population,
    /// Law by law.
    pub cases: Vec<CaseResults>,
}

/// One surface under one law.
#[derive(Debug)]
pub struct CaseResults {
    /// The law, as tables name it.
    pub law: String,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// Both models' answers.
    pub comparison: Comparison,
    /// The largest gaps between them.
    pub gaps: Gaps,
}

/// Sets of growing size against their limit.
#[derive(Debug)]
pub struct LimitResults {
    /// What every experiment has.
    pub head: Head,
    /// What the sets were drawn from.
    pub population: Population,
    /// The laws, and what each one's limit was taken from.
    pub laws: Vec<(String, &'static str)>,
    /// Greenwood and Williamson's plasticity index; `None` where nothing yields.
    pub plasticity_index: Option<f64>,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Random sets of each size.
    pub draws: usize,
    /// Size by size, law by law, separation by separation.
    pub points: Vec<LimitPoint>,
}
