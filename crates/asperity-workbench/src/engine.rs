//! What the server asks of the program.

use std::path::{Path, PathBuf};

use asperity_contact_framework::progress::Progress;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A spec as the page holds it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpecText {
    /// The folder of the workbench, an absolute path without links, which its files must lie in.
    pub root: PathBuf,
    /// The folder that its paths are relative to, in the root.
    pub folder: PathBuf,
    pub text: String,
}

/// Input that is not accepted, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{message}")]
pub struct Refused {
    /// The dotted key of the spec that it is about.
    pub key: Option<String>,
    /// What was found, what is allowed.
    pub message: String,
}

impl Refused {
    /// About no key of the spec.
    pub fn new(message: impl Into<String>) -> Self {
        Self { key: None, message: message.into() }
    }
}

/// How far an analysis goes; each stage repeats those before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// What follows a slider: both models.
    Models,
    /// Intervals and causes.
    Intervals,
    /// Other treatments of the map, boundary elements.
    Everything,
}

/// A spec whose keys are checked.
pub trait Prepared: Send + Sync {
    /// The memory that it needs at its peak, bytes.
    fn memory(&self) -> u128;

    /// The state of each of its files: when it was last written, and its size.
    fn inputs(&self) -> Value;

    /// The stages that its analysis has, in their order.
    fn stages(&self) -> &'static [Stage];

    /// What the page shows of it after a stage.
    fn run(&self, stage: Stage, progress: &dyn Progress) -> Result<Value, Refused>;
}

/// A spec with a map of its own that whoever has nothing can begin with.
pub struct Example {
    /// Name and content of each file, the spec first.
    pub files: &'static [(&'static str, &'static [u8])],
}

pub trait Engine: Send + Sync + 'static {
    /// What the page needs once: keys, materials, laws.
    fn vocabulary(&self) -> Value;

    /// Whether names of files of maps and of lists of asperities end like that of `path`.
    fn is_surface(&self, path: &Path) -> bool;

    /// The kind of experiment of a spec, and its title; `None` of another text.
    fn kind(&self, text: &str) -> Option<(String, String)>;

    /// The spec that a measured file begins with, which names it by `path`, and what the file leaves open: `pixel`, and `unit`, or
    /// `unit.xy` and `unit.z` where it has coordinates.
    fn begin(&self, file: &Path, path: &str) -> Result<(String, Vec<String>), Refused>;

    /// A small picture of a measured file, whose pixel need not be known: heights, less a plane, at most `most` along an axis.
    fn picture(&self, file: &Path, most: usize) -> Result<Heights, Refused>;

    fn prepare(&self, spec: &SpecText) -> Result<Box<dyn Prepared>, Refused>;

    /// What the page shows of one surface of a spec.
    fn surface(&self, spec: &SpecText, name: &str, progress: &dyn Progress) -> Result<Value, Refused>;

    /// The prepared heights of a surface with at most `most` points along an axis, as [`Heights`].
    fn heights(
        &self,
        spec: &SpecText,
        name: &str,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Heights, Refused>;

    /// Runs the spec at `path`, whose files must lie in `root`, and writes its report into `out`; gives the name of its folder.
    fn report(
        &self,
        path: &Path,
        root: &Path,
        out: &Path,
        progress: &dyn Progress,
    ) -> Result<String, Refused>;

    /// Forgets the surfaces that it keeps.
    fn forget(&self);

    /// A first spec with its map.
    fn example(&self) -> Example;
}

#[derive(Debug, Clone, PartialEq)]
pub struct Heights {
    pub points: [usize; 2],
    /// Their distances, m.
    pub pixel: [f64; 2],
    /// Each of them stands for so many points of the map along an axis.
    pub every: usize,
    /// The heights, m, in single precision, y fastest; NaN where missing.
    pub heights: Vec<f32>,
}

impl Heights {
    /// As bytes: points as two `u32`, `every` as `u32`, four bytes of zeros, pixel as two `f64`, heights as `f32`, all little endian.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(32 + 4 * self.heights.len());
        let counts = [self.points[0], self.points[1], self.every, 0];
        counts.iter().for_each(|&count| bytes.extend((count as u32).to_le_bytes()));
        self.pixel.iter().for_each(|size| bytes.extend(size.to_le_bytes()));
        self.heights.iter().for_each(|height| bytes.extend(height.to_le_bytes()));
        bytes
    }
}
