//! From a spec file to results: read, plan, run. Nothing here knows a terminal or writes a file.

mod files;
mod indentation;
mod input_error;
mod laws;
mod models;
mod overview;
pub mod plan;
mod precision;
pub mod progress;
pub mod results;
mod run;
pub mod spec;
mod stability;
mod surface;
mod threshold;

pub use indentation::{IndentationResults, LARGEST_SLOPE, LawCurves, LayerResults};
pub use input_error::InputError;
pub use laws::{LawOnOne, LawsResults, SurfaceInfluence};
pub use overview::MapOverview;
pub use precision::{CasePrecision, PrecisionResults};
pub use stability::StabilityResults;
pub use surface::{GenerationFacts, MapFacts, Surface};

use std::io::Read;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use plan::{Plan, PlanKind};
use progress::Progress;
use results::Results;

/// SHA-256 of the sources that this program was built from.
const SOURCES: &str = env!("ASPERITY_SOURCES");

/// A commented spec that runs as it stands.
pub const TEMPLATE: &str = include_str!("template.toml");

/// An experiment that can be run.
pub struct Experiment {
    plan: Plan,
}

impl Experiment {
    /// Reads a spec and looks at its files.
    ///
    /// # Errors
    /// What keeps it from running, with file, line and key.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        Ok(Self { plan: Plan::read(path, false)? })
    }

    /// The same, to run also what takes minutes and gigabytes, where the spec has such a thing.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_in_full(path: &Path) -> Result<Self, InputError> {
        Ok(Self { plan: Plan::read(path, true)? })
    }

    /// Looks at the surfaces of a spec, or at a measured file in the words of a spec:
    /// `[surface.NAME.file]` and what stands below it. The report is called `name`, or after the file.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn look(path: &Path, words: &FileWords, name: Option<&str>) -> Result<Self, InputError> {
        let is_spec = path.extension().is_some_and(|ending| ending == "toml");
        if is_spec && *words != FileWords::default() {
            return Err(InputError::file(
                path,
                "is a spec, which says everything of its surfaces itself; allowed with a spec: no pixel, unit, level, \
                 filter or neighbours beside it",
            ));
        }
        let mut plan =
            if is_spec { Plan::look_at_spec(path)? } else { Plan::look_at_file(words.spec(path), path)? };
        if let Some(name) = name {
            if name.is_empty() || Path::new(name).file_name() != Some(name.as_ref()) {
                let message =
                    format!("found the name \"{name}\" for its report; allowed: one such as my-surface");
                return Err(InputError::file(path, message));
            }
            plan.stem = plan::stem_of(Path::new(&format!("{name}.toml")))?;
        }
        Ok(Self { plan })
    }

    /// The file that it looks at; `None` of an experiment that is more than a look.
    pub fn looked_at(&self) -> Option<PathBuf> {
        match &self.plan.kind {
            PlanKind::Surfaces(surfaces) => Some(self.plan.looked_at(surfaces)),
            _ => None,
        }
    }

    /// Name of its report's folder.
    pub fn stem(&self) -> &str {
        &self.plan.stem
    }

    /// Everything that it will do.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// What its report depends on: its name, the spec, whether it is run in full, its input files and the program's own
    /// sources, as a hexadecimal SHA-256.
    ///
    /// # Errors
    /// An input file that cannot be read.
    pub fn key(&self) -> Result<String, InputError> {
        let mut hash = Sha256::new();
        hash.update(SOURCES);
        hash.update(digest(self.plan.stem.as_bytes()));
        hash.update(digest(self.plan.source.text.as_bytes()));
        if matches!(&self.plan.kind, PlanKind::Precision(plan) if plan.full) {
            hash.update("full");
        }
        for path in self.plan.inputs() {
            let content = digest_file(&path)
                .map_err(|error| InputError::file(&path, format!("cannot be read: {error}")))?;
            hash.update(content);
        }
        Ok(hexadecimal(&hash.finalize()))
    }

    /// Runs it.
    ///
    /// # Errors
    /// What only a run can find: a map without a summit, a pressure that is not reached.
    pub fn run(&self, progress: &dyn Progress) -> Result<Results, InputError> {
        run::run(&self.plan, progress)
    }
}

/// What a person says of a measured file, besides its path; the words are those of a spec.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FileWords {
    /// A length, or two with a comma between them.
    pub pixel: Option<String>,
    /// Unit of the lengths in the file.
    pub unit: Option<String>,
    /// Form that is removed.
    pub level: Option<String>,
    /// S nesting index.
    pub s: Option<String>,
    /// L nesting index.
    pub l: Option<String>,
    /// Which neighbours a summit is higher than.
    pub neighbours: Option<String>,
}

impl FileWords {
    /// The spec that describes the file at `path`.
    fn spec(&self, path: &Path) -> String {
        let quoted = |text: &str| toml::Value::from(text).to_string();
        // A bare number is in metres, as in a spec.
        let length = |text: &str| match text.parse::<f64>() {
            Ok(number) if number.is_finite() => format!("{number:e}"),
            _ => quoted(text),
        };
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("surface");
        let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        let name: String = stem.chars().map(|c| if is_plain(c) { c } else { '-' }).collect();
        let mut lines = vec![
            format!("title = {}", quoted(&format!("The surface {stem}"))),
            format!("[surface.{}.file]", quoted(&name)),
            format!("path = {}", quoted(&path.to_string_lossy())),
        ];
        if let Some(pixel) = &self.pixel {
            let sizes: Vec<String> = pixel.split(',').map(|size| length(size.trim())).collect();
            lines.push(match &sizes[..] {
                [one] => format!("pixel = {one}"),
                several => format!("pixel = [{}]", several.join(", ")),
            });
        }
        for (key, value) in [("unit", &self.unit), ("level", &self.level), ("neighbours", &self.neighbours)] {
            lines.extend(value.as_ref().map(|value| format!("{key} = {}", quoted(value))));
        }
        for (key, value) in [("filter.s", &self.s), ("filter.l", &self.l)] {
            lines.extend(value.as_ref().map(|value| format!("{key} = {}", length(value))));
        }
        lines.join("\n") + "\n"
    }
}

fn digest(bytes: &[u8]) -> [u8; 32] {
    Sha256::digest(bytes).into()
}

fn digest_file(path: &Path) -> std::io::Result<[u8; 32]> {
    let mut file = std::fs::File::open(path)?;
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(hash.finalize().into()),
            length => hash.update(&buffer[..length]),
        }
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The seed of one stream of random numbers: it depends on the spec's seed and on what is drawn,
/// not on what else the spec holds.
fn stream_seed(seed: u64, what: &str) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(what);
    hash.finalize().into()
}
