//! `[sweep]`: an experiment for several values of some of its keys, in one report.

mod find;
mod outline;
mod plan;
mod results;
mod spec;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Instant, SystemTime};

use asperity::literature;
use asperity::work::Counter;
use asperity_contact_framework::digest::sha256_of_file;
use asperity_contact_framework::input::{InputError, Source, Spanned, SpecFile};
use asperity_contact_framework::kept::Kept;
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::Progress;
use asperity_contact_framework::report::table::{Heading, Schema, Table};
use asperity_contact_framework::{Divided, Kind, Memory, Outcome, Plan, RunContext};
use plan::{SweepPlan, VariedCase};
use rayon::prelude::*;
use results::{ChangeRow, CrossingRow, FILE, ROWS, SweepResults};
use serde::{Deserialize, Serialize};

use crate::experiment::tables;
use crate::kind::KINDS;
use crate::kind::compare::{Compare, Extent, Scope, run_within};
use crate::surface::{OfSpec, Surfaces};

pub const NAME: &str = "sweep";

pub struct Sweep;

impl Sweep {
    /// What a sweep has of an experiment of a kind: the columns of the one table.
    fn schema_of(kind: &str) -> Option<Schema> {
        let kind = KINDS.iter().find(|known| known.name == kind)?;
        Some(Schema { file: FILE, rows: ROWS, records: None, is_long: false, ..(kind.swept)()? })
    }
}

/// The variations of a spec with a sweep: the values of its keys, and its spec without the sweep.
pub fn variations(source: Source) -> Result<Vec<[toml::Table; 2]>, InputError> {
    let spec = SpecFile::parse(source, &tables())?;
    let plan = SweepPlan::new(&spec, &spec.required_table(NAME)?)?;
    let one = |variation: &plan::Variation| {
        let keys = plan.keys.iter().zip(&variation.places);
        let values = keys.map(|(key, &place)| (key.name.clone(), key.values[place].clone())).collect();
        let table = plan.spec(&variation.places);
        Ok([values, table.map_err(|message| InputError::file(&spec.source.path, message))?])
    };
    plan.variations.iter().map(one).collect()
}

impl Kind for Sweep {
    const NAME: &'static str = NAME;
    type Spec = spec::SweepSpec;
    type Plan = SweepPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<SweepPlan, InputError> {
        SweepPlan::new(file, table)
    }

    /// The one table has the columns of the kind that is swept; listed are those of all kinds.
    fn tables() -> Vec<Schema> {
        tables_of(KINDS.iter().filter_map(|kind| Self::schema_of(kind.name)))
    }
}

/// The tables of a sweep of comparisons, as documentation lists them.
pub fn documented() -> Vec<Schema> {
    tables_of(Sweep::schema_of(Compare::NAME))
}

/// The tables of a sweep whose one table has the columns of any of some schemas.
fn tables_of(schemas: impl IntoIterator<Item = Schema>) -> Vec<Schema> {
    let mut columns: Vec<Heading> = Vec::new();
    for heading in schemas.into_iter().flat_map(|schema| schema.columns) {
        if columns.iter().all(|known| known.name != heading.name) {
            columns.push(heading);
        }
    }
    let one = Schema { file: FILE, rows: ROWS, records: None, is_long: false, columns };
    vec![one, Schema::of::<ChangeRow>(), Schema::of::<CrossingRow>()]
}

impl Plan for SweepPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        self.inputs()
    }

    fn memory(&self) -> Memory {
        self.memory()
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        let run = Run::new(self, context);
        let found = run.variations(0..self.variations.len())?;
        Ok(Box::new(run.finish(&found)?))
    }

    fn divided(&self) -> Option<&dyn Divided> {
        Some(self)
    }
}

/// A task is a variation.
impl Divided for SweepPlan {
    fn tasks(&self) -> usize {
        self.variations.len()
    }

    fn passes(&self) -> usize {
        1
    }

    fn run_task(&self, context: &RunContext, task: usize, _: &[Vec<String>]) -> Result<String, InputError> {
        let found = Run::new(self, context).variations(task..task + 1)?;
        serde_json::to_string(&found).map_err(|error| InputError::file(&context.source.path, error))
    }

    fn results(&self, context: &RunContext, passes: &[Vec<String>]) -> Result<Box<dyn Outcome>, InputError> {
        let found: Result<Vec<Vec<Found>>, _> =
            passes.iter().flatten().map(|text| serde_json::from_str(text)).collect();
        let found = found.map_err(|error| InputError::file(&context.source.path, error))?;
        Ok(Box::new(Run::new(self, context).finish(&found.concat())?))
    }
}

/// What a sweep keeps of a variation.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Found {
    /// Its table as CSV; empty where it failed.
    csv: String,
    pub warnings: Vec<String>,
    /// The papers that it used, as cited.
    papers: Vec<String>,
    /// Why it could not be run to its end.
    pub failure: Option<String>,
}

impl Found {
    fn of(outcome: &dyn Outcome) -> Result<Self, String> {
        let table = outcome.swept().ok_or("found no table")?;
        let csv = table.csv().map_err(|error| error.to_string())?;
        Ok(Self {
            csv: String::from_utf8(csv).map_err(|error| error.to_string())?,
            warnings: outcome.warnings(),
            papers: outcome.metadata().papers.iter().map(|paper| paper.short.to_owned()).collect(),
            failure: None,
        })
    }

    fn failed(reason: String) -> Self {
        Self { csv: String::new(), warnings: Vec::new(), papers: Vec::new(), failure: Some(reason) }
    }

    /// Its table; `None` where it failed.
    pub fn table(&self, plan: &SweepPlan) -> Option<Table> {
        let is_there = self.failure.is_none();
        is_there.then(|| Table::read(&plan.schema, self.csv.as_bytes()).ok()).flatten()
    }
}

/// When a file was last written, and its size.
type State = (SystemTime, u64);

pub struct Run<'a> {
    plan: &'a SweepPlan,
    context: &'a RunContext<'a>,
    surfaces: Surfaces,
    kept: Option<Kept>,
    /// The names of all pieces that belong to this run.
    used: Mutex<BTreeSet<String>>,
    /// SHA-256 of input files, each hashed once in a state.
    files: Mutex<BTreeMap<PathBuf, (State, [u8; 32])>>,
}

/// The progress of a variation as a part of a run: its own steps do not count.
struct OfVariation<'a>(&'a dyn Progress);

impl Progress for OfVariation<'_> {
    fn stage(&self, name: &str, total: f64) {
        self.0.stage(name, total);
    }

    fn advance(&self, work: f64) {
        self.0.advance(work);
    }
}

impl<'a> Run<'a> {
    pub fn new(plan: &'a SweepPlan, context: &'a RunContext<'a>) -> Self {
        Self {
            plan,
            context,
            surfaces: Surfaces::default(),
            kept: context.kept.map(Kept::new),
            used: Mutex::default(),
            files: Mutex::default(),
        }
    }

    /// What is found in some variations, in their order.
    pub fn variations(&self, numbers: std::ops::Range<usize>) -> Result<Vec<Found>, InputError> {
        self.context.progress.steps(numbers.len() as u64);
        let one = |number: usize| {
            let found = self.one(&self.plan.variations[number].case, Extent::Everything);
            self.context.progress.step();
            found
        };
        let numbers: Vec<usize> = numbers.collect();
        let found: Vec<_> = if self.plan.at_once() > 1 {
            numbers.into_par_iter().map(one).collect()
        } else {
            numbers.into_iter().map(one).collect()
        };
        found.into_iter().collect()
    }

    /// What is found in one to an extent, which is kept.
    pub fn one(&self, case: &VariedCase, extent: Extent) -> Result<Found, InputError> {
        let before = case.experiment.modified();
        let input = case.experiment.input_by(|path| self.hash(path))?;
        let key = case.experiment.key_of(&input);
        let name = if extent == Extent::Everything { key } else { format!("{key}-without-intervals") };
        let refuse = |error: String| InputError::file(&self.context.source.path, error);
        self.used.lock().map_err(|error| refuse(error.to_string()))?.insert(name.clone());
        let known = self.kept.as_ref().and_then(|kept| kept.read(&name));
        if let Some(found) = known.and_then(|bytes| serde_json::from_slice(&bytes).ok()) {
            return Ok(found);
        }
        let found = self.run(case, &input, extent);
        // A failure may be one of the disk, and what was read of a file that changed meanwhile is of neither state.
        let is_sound = found.failure.is_none() && case.experiment.modified() == before;
        if let Some(kept) = self.kept.as_ref().filter(|_| is_sound) {
            let bytes = serde_json::to_vec(&found).map_err(|error| refuse(error.to_string()))?;
            kept.write(&name, &bytes).map_err(|error| refuse(error.to_string()))?;
        }
        Ok(found)
    }

    fn run(&self, case: &VariedCase, input: &str, extent: Extent) -> Found {
        let progress = OfVariation(self.context.progress);
        let context = case.experiment.context(input, &progress);
        let outcome: Result<Box<dyn Outcome>, InputError> = match &case.comparison {
            None => case.experiment.run(&progress),
            Some(plan) => {
                let store = OfSpec::new(&self.surfaces, self.plan.folder(), &case.text);
                let scope = Scope { extent, store: Some(&store), pictures: 0, ..Scope::default() };
                run_within(&context, plan, &Counter::default(), scope).map(|results| Box::new(results) as _)
            }
        };
        let found =
            outcome.map_err(|error| error.message().to_owned()).and_then(|outcome| Found::of(&*outcome));
        found.unwrap_or_else(Found::failed)
    }

    fn hash(&self, path: &Path) -> std::io::Result<[u8; 32]> {
        let metadata = std::fs::metadata(path)?;
        let state = (metadata.modified()?, metadata.len());
        let known = self.files.lock().ok().and_then(|files| files.get(path).copied());
        if let Some((_, hash)) = known.filter(|(known, _)| *known == state) {
            return Ok(hash);
        }
        let hash = sha256_of_file(path)?;
        if let Ok(mut files) = self.files.lock() {
            files.insert(path.to_owned(), (state, hash));
        }
        Ok(hash)
    }

    /// The results, from what was found in all variations.
    pub fn finish(self, found: &[Found]) -> Result<SweepResults, InputError> {
        let start = Instant::now();
        if let Some(failure) = found.iter().find_map(|one| one.failure.as_ref())
            && found.iter().all(|one| one.failure.is_some())
        {
            let message = format!("no variation could be run; the first: {failure}");
            return Err(InputError::file(&self.context.source.path, message));
        }
        let crossings = self.plan.finds.iter().map(|find| find.run(&self)).collect::<Result<Vec<_>, _>>()?;
        let papers = literature::ALL.into_iter();
        let is_used = |short: &str| found.iter().flat_map(|one| &one.papers).any(|paper| paper == short);
        let papers = papers.filter(|paper| is_used(paper.short)).collect();
        if let (Some(kept), Ok(used)) = (&self.kept, self.used.lock()) {
            kept.retain(&used);
        }
        let timing = Timing { total: start.elapsed(), ..Timing::default() };
        let metadata = self.context.metadata(papers, timing, None);
        Ok(SweepResults::new(metadata, self.plan, found, crossings.into_iter().flatten().collect()))
    }

    pub fn progress(&self) -> &'a dyn Progress {
        self.context.progress
    }

    pub fn plan(&self) -> &SweepPlan {
        self.plan
    }
}
