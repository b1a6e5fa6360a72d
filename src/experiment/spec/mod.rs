//! The input file: what a spec may say (DESIGN: external tags, unknown keys refused, file order kept).
//!
//! These types are the file, word for word; `plan` turns them into things that run.

mod compare;
mod generate;
mod indentation;
mod law;
mod laws;
mod layer;
mod limit;
mod material;
mod precision;
mod stability;
mod surface;
mod sweep;
mod tolerance;

use std::path::Path;

use indexmap::IndexMap;
use serde::Deserialize;
use toml::Spanned;

pub use compare::{CompareSpec, StatisticalSpec};
pub use generate::{
    CorrelationSpec, GenerateSpec, HeightsSpec, PlateauSpec, PointsSpec, SelfAffineSpec, SpectrumSpec,
    TargetSpec,
};
pub use indentation::{IndentationSpec, Layers, Show};
pub use law::{Equations, LawSpec, Laws, Summit};
pub use laws::{AsperitySpec, LawsSpec};
pub use layer::{LayerSpec, Thicknesses};
pub use limit::LimitSpec;
pub use material::MaterialSpec;
pub use precision::{
    CaseSpec, CurveSpec, GridSpec, IntegralSpec, ListsSpec, PrecisionSpec, SamplingSpec, SumSpec,
};
pub use stability::{SpanSpec, StabilitySpec};
pub use surface::{
    DrawSpec, FileSpec, FilterSpec, ListSpec, PixelSpec, PopulationHeights, PopulationSpec, SurfaceSpec,
};
pub use sweep::{LinearSweep, LogSweep};
pub use tolerance::{TOLERANCES, ToleranceSpec};

use super::input_error::{InputError, Source};

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Spec {
    /// What the report is called.
    pub title: String,
    /// What a reader of the report should know of it; a blank line parts paragraphs.
    #[serde(default)]
    pub notes: String,
    /// Every random number comes from it.
    #[serde(default)]
    pub seed: u64,
    /// The bodies by name.
    #[serde(default)]
    pub material: IndexMap<Spanned<String>, MaterialSpec>,
    /// Both models on given surfaces.
    pub compare: Option<Spanned<CompareSpec>>,
    /// The deterministic model against the statistical limit.
    pub limit: Option<Spanned<LimitSpec>>,
    /// Several laws on one asperity and on given surfaces.
    pub laws: Option<Spanned<LawsSpec>>,
    /// Run time against error.
    pub precision: Option<Spanned<PrecisionSpec>>,
    /// One sphere on a layered flat.
    pub indentation: Option<Spanned<IndentationSpec>>,
    /// How far `f64` is off.
    pub stability: Option<Spanned<StabilitySpec>>,
    /// The surfaces by name.
    #[serde(default)]
    pub surface: IndexMap<Spanned<String>, Spanned<SurfaceSpec>>,
}

/// Reads a spec.
///
/// # Errors
/// A file that cannot be read, is no TOML, or says what no spec may say.
pub fn read(path: &Path) -> Result<(Source, Spec), InputError> {
    let bytes =
        std::fs::read(path).map_err(|error| InputError::file(path, format!("cannot be read: {error}")))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        InputError::file(path, format!("is no UTF-8 text (byte {})", error.utf8_error().valid_up_to()))
    })?;
    parse(Source { path: path.to_owned(), text })
}

/// Reads words that the command line made; what they name is relative to the working directory.
///
/// # Errors
/// As [`read`].
pub fn from_command_line(text: String) -> Result<(Source, Spec), InputError> {
    parse(Source::command_line(text))
}

fn parse(source: Source) -> Result<(Source, Spec), InputError> {
    let spec: Spec = toml::from_str(&source.text).map_err(|error| source.parse_error(&error))?;
    Ok((source, spec))
}
