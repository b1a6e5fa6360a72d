//! What an experiment kind is: one trait for reading a spec's table, one for the plan of a run, one for its results.
//!
//! A kind implements [`Kind`], [`Plan`] and [`Outcome`] with its own types; the program keeps any of them as [`RegisteredKind`] and `dyn Plan`.

use std::any::Any;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity::numeric::stream_seed;
use asperity::work::Work;
use asperity::{Material, Paper};
use asperity_plot::Size;
use indexmap::IndexMap;
use schemars::{JsonSchema, SchemaGenerator};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::digest::{hexadecimal, sha256};
use crate::input::material::MaterialOrigin;
use crate::input::{InputError, Source, Spanned, SpecFile};
use crate::metadata::{Again, Group, Metadata, Timing};
use crate::progress::Progress;
use crate::report::Page;
use crate::report::table::{Schema, Table, Tables};

/// Tables of a spec that a kind reads besides its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reads {
    /// `[material.NAME]`
    pub materials: bool,
    /// `[surface.NAME]`
    pub surfaces: bool,
}

/// A kind of experiment: what the table `[NAME]` of a spec means. [`RegisteredKind`] is its entry in a registry.
pub trait Kind {
    const NAME: &'static str;

    /// What it reads besides its table.
    const READS: Reads = Reads { materials: true, surfaces: true };

    /// Where the index lists its reports, unless a spec says something else.
    const GROUP: Option<Group> = None;

    type Spec: DeserializeOwned + JsonSchema;

    type Plan: Plan + 'static;

    /// Reads what the table refers to, and checks everything that can be checked without running it.
    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<Self::Plan, InputError>;

    /// The tables that its reports may hold.
    fn tables() -> Vec<Schema>;

    /// The table of [`Outcome::swept`].
    fn swept() -> Option<Schema> {
        Self::tables().into_iter().next()
    }
}

/// A [`Kind`] in a registry.
pub struct RegisteredKind {
    pub name: &'static str,
    pub reads: Reads,
    pub group: Option<Group>,
    /// The JSON schema of its table.
    pub schema: fn(&mut SchemaGenerator) -> schemars::Schema,
    /// Reads its table of a spec, and makes a plan of it.
    pub plan: fn(&SpecFile) -> Result<Arc<dyn Plan>, InputError>,
    pub tables: fn() -> Vec<Schema>,
    pub swept: fn() -> Option<Schema>,
}

impl RegisteredKind {
    pub const fn of<K: Kind>() -> Self {
        Self {
            name: K::NAME,
            reads: K::READS,
            group: K::GROUP,
            schema: |generator| generator.subschema_for::<K::Spec>(),
            plan: |file| Ok(Arc::new(K::plan(file, &file.required_table::<K::Spec>(K::NAME)?)?)),
            tables: K::tables,
            swept: K::swept,
        }
    }
}

/// The memory that a run needs at its peak.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Memory {
    pub bytes: u128,
    /// Position in the spec of the largest part of it.
    pub key: Option<Range<usize>>,
}

/// An experiment that can be run. `Display` prints what it will do, one line per item, for `experiment check`.
pub trait Plan: fmt::Display + Send + Sync {
    /// The files that it reads, each once.
    fn inputs(&self) -> Vec<PathBuf> {
        Vec::new()
    }

    /// An estimate of the memory that it needs.
    fn memory(&self) -> Memory;

    /// An estimate of the work: micro-contacts evaluated.
    fn work(&self) -> u128;

    /// Looks for what a run would refuse, as far as that takes no more than a small part of the run's time.
    fn check(&self, _: &RunContext) -> Result<(), InputError> {
        Ok(())
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError>;

    /// The same, where its tasks can be run by many machines.
    fn divided(&self) -> Option<&dyn Divided> {
        None
    }
}

/// A plan whose work is divided into tasks. The input alone fixes them, so that results are the same to the bit wherever each runs.
pub trait Divided {
    fn tasks(&self) -> usize;

    /// Number of passes over all tasks. A pass needs what all tasks have found in the earlier ones.
    fn passes(&self) -> usize;

    /// What pass `earlier.len()` finds in a task (from 0), as JSON, which keeps every bit.
    fn run_task(
        &self,
        context: &RunContext,
        task: usize,
        earlier: &[Vec<String>],
    ) -> Result<String, InputError>;

    /// The results of a run, from what all tasks have found in all passes.
    fn results(&self, context: &RunContext, passes: &[Vec<String>]) -> Result<Box<dyn Outcome>, InputError>;
}

/// Results of a run: metadata, warnings, tables, and the outline of a page. A program that knows the kind can cast it to the
/// kind's own type through [`Any`].
pub trait Outcome: Any + Send + Sync {
    fn metadata(&self) -> &Metadata;

    /// Warnings about the results, one per line.
    fn warnings(&self) -> Vec<String>;

    /// Its tables, each one of [`Kind::tables`].
    fn tables(&self) -> Vec<Table> {
        Vec::new()
    }

    /// What a sweep over keys of its spec has of it; by default its first table.
    fn swept(&self) -> Option<Table> {
        self.tables().into_iter().next()
    }

    /// The outline of its page, with views of its tables.
    fn page(&self, tables: &Tables) -> Page;

    /// What `summary.json` holds besides metadata, warnings and tables.
    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        Ok(Map::new())
    }

    /// What the terminal shows of it, if anything.
    fn terminal(&self) -> Option<String> {
        None
    }
}

/// What a run needs besides its plan.
pub struct RunContext<'a> {
    pub title: &'a str,
    /// Name of the spec's table of its kind.
    pub kind: &'static str,
    pub stem: &'a str,
    /// SHA-256 of the spec, of how it is run, and of its input files, hexadecimal.
    pub input_sha256: &'a str,
    pub notes: &'a str,
    /// The size of its figures in print; `None` of figures for the page only.
    pub figure: Option<Size>,
    /// Whether it runs only where it is named or long runs are asked for.
    pub is_long: bool,
    /// Where the index lists its report.
    pub group: Option<Group>,
    /// SHA-256 of the sources of the library, hexadecimal.
    pub library_sha256: &'static str,
    /// Every random number is drawn from it.
    pub seed: u64,
    /// The bodies of the spec, in file order.
    pub materials: &'a IndexMap<String, Material>,
    /// Those of them whose values are from the library.
    pub origins: &'a IndexMap<String, MaterialOrigin>,
    /// The spec's text, for errors that only a run can find.
    pub source: &'a Source,
    pub progress: &'a dyn Progress,
    /// The folder in which a run may keep what it has done, to continue if it is killed.
    pub kept: Option<&'a Path>,
}

impl RunContext<'_> {
    /// The metadata of the results: `papers` are what it used, sorted and each once; `work` is `None` where it depends on the
    /// clock, or is the experiment itself.
    pub fn metadata(&self, mut papers: Vec<Paper>, timing: Timing, work: Option<Work>) -> Metadata {
        papers.sort_by_key(|paper| paper.short);
        papers.dedup();
        Metadata {
            title: self.title.to_owned(),
            kind: self.kind,
            stem: self.stem.to_owned(),
            again: self.again(),
            notes: self.notes.to_owned(),
            spec_sha256: hexadecimal(&sha256(self.source.text.as_bytes())),
            input_sha256: self.input_sha256.to_owned(),
            seed: self.seed,
            figure: self.figure,
            is_long: self.is_long,
            group: self.group,
            library_sha256: self.library_sha256,
            origins: self.origins.clone(),
            papers,
            timing,
            work,
        }
    }

    /// The command that runs it: a spec of the repository in its folder, any other where it lies; or the spec.
    fn again(&self) -> Again {
        if self.source.is_in_memory() {
            return Again::Spec(self.source.text.clone());
        }
        const SPECS: &str = "experiments";
        let path = &self.source.path;
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let verb = if self.kind == "surface" { "surface" } else { "run" };
        let is_of_repository = path.parent().and_then(Path::file_name).is_some_and(|folder| folder == SPECS);
        Again::Command(if is_of_repository {
            format!("cargo run --release --bin experiment -- {verb} {SPECS}/{file}")
        } else {
            format!("experiment {verb} {file}")
        })
    }

    /// The seed of one stream of random numbers: it depends on the spec's seed and on what is drawn, not on the rest of the
    /// spec.
    pub fn stream_seed(&self, what: &str) -> [u8; 32] {
        stream_seed(self.seed, what)
    }
}

/// Bytes that a set of `count` asperities needs at its peak, which is where its ordered copy is made. A sum makes none unless
/// the load of an asperity may decrease.
pub fn set_memory(count: u128) -> u128 {
    /// Height and radius.
    const BYTES_OF_SET: u128 = 16;
    /// Height and shape while they are sorted, then in columns.
    const BYTES_OF_COPY: u128 = 24 + 16;
    count * (BYTES_OF_SET + BYTES_OF_COPY)
}

/// The fields of a serialisable struct, as a kind's part of a summary.
pub fn fields(value: &impl Serialize) -> serde_json::Result<Map<String, Value>> {
    match serde_json::to_value(value)? {
        Value::Object(fields) => Ok(fields),
        _ => Err(serde::ser::Error::custom("a summary consists of named fields")),
    }
}
