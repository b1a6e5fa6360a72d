//! From a spec file to results: read, plan, run. No output to terminal or files.

use std::any::Any;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;
use std::{fmt, fs};

use asperity::Material;
use asperity::surface::{AnalysisDepth, Surface};
use asperity::topography::read::is_named_as_map;
use asperity::work::Counter;
use asperity_contact_framework::digest::{hexadecimal, sha256, watched_sha256_of_file};
use asperity_contact_framework::input::material::MaterialOrigin;
use asperity_contact_framework::input::{InputError, Source, SpecFile};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::{Progress, Silent};
use asperity_contact_framework::report::format::listed;
use asperity_contact_framework::report::store::{Store, StoreError, is_plain, plain};
use asperity_contact_framework::report::{Index, MARK};
use asperity_contact_framework::{Divided, Group, Kind, Outcome, Plan, RegisteredKind, RunContext};
use asperity_plot::Size;
use indexmap::IndexMap;
use sha2::{Digest, Sha256};

use crate::kind::compare::Compare;
use crate::kind::compare::results::CompareResults;
use crate::kind::compare::spec::{ComparePlan, described};
use crate::kind::{KINDS, REPORTED, SURFACES};
use crate::surface::{FileOptions, SurfaceFactory, SurfacesPlan, by_hand, files_of, surfaces};
use crate::sweep;

/// SHA-256 of the sources that this program was built from.
const SOURCES: &str = env!("ASPERITY_SOURCES");

/// SHA-256 of the sources of the library that this program was built from.
pub const LIBRARY: &str = env!("ASPERITY_LIBRARY");

/// A commented spec that runs as it stands.
pub const TEMPLATE: &str = include_str!("template.toml");

/// When a file was last written, and its size; `None` where it is not there.
pub(crate) type Modified = Option<(SystemTime, u64)>;

/// An experiment that can be run. `Display` prints what it will do and need.
pub struct Experiment {
    source: Source,
    stem: String,
    title: String,
    pub(crate) kind: &'static str,
    notes: String,
    figure: Option<Size>,
    is_long: bool,
    group: Option<Group>,
    seed: u64,
    materials: IndexMap<String, Material>,
    origins: IndexMap<String, MaterialOrigin>,
    pub(crate) plan: Arc<dyn Plan>,
    described: Option<PathBuf>,
}

impl Experiment {
    /// Reads a spec and everything about its files that can be known without running it.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        Self::watched_read(path, &Silent)
    }

    /// The same with progress where its files are large.
    pub fn watched_read(path: &Path, progress: &dyn Progress) -> Result<Self, InputError> {
        let spec = SpecFile::read(path, &tables()).map_err(|error| {
            if path.is_file() && is_named_as_map(path) {
                let name = path.display();
                InputError::file(
                    path,
                    format!("is no spec; a measured map is for `experiment surface {name}`"),
                )
            } else {
                error
            }
        })?;
        Self::of_spec(spec.watched_by(progress), stem_of(path)?)
    }

    /// The same, whose files must lie in the folder `root` (an absolute path without links).
    #[cfg(feature = "serve")]
    pub(crate) fn read_confined(path: &Path, root: &Path) -> Result<Self, InputError> {
        let text = std::fs::read_to_string(path)
            .map_err(|error| InputError::file(path, format!("cannot be read: {error}")))?;
        let source = Source::file(path, text).confined_to(root);
        Self::of_spec(SpecFile::parse(source, &tables())?, stem_of(path)?)
    }

    /// An experiment from a text, whose report is called `stem`.
    pub fn parse(source: Source, stem: &str) -> Result<Self, InputError> {
        Self::watched_parse(source, stem, &Silent)
    }

    /// The same with progress where its files are large.
    pub fn watched_parse(source: Source, stem: &str, progress: &dyn Progress) -> Result<Self, InputError> {
        Self::of_spec(SpecFile::parse(source, &tables())?.watched_by(progress), stem.to_owned())
    }

    /// An experiment from a text, with its comparison where it is one, which can be run to an extent.
    pub(crate) fn with_comparison(
        source: Source,
        stem: &str,
        progress: &dyn Progress,
    ) -> Result<(Self, Option<Arc<ComparePlan>>), InputError> {
        let spec = SpecFile::parse(source, &tables())?.watched_by(progress);
        if kind(&spec)?.name != Compare::NAME {
            return Ok((Self::of_spec(spec, stem.to_owned())?, None));
        }
        let plan = Arc::new(<Compare as Kind>::plan(&spec, &spec.required_table(Compare::NAME)?)?);
        Ok((Self::new(spec, stem.to_owned(), Compare::NAME, plan.clone())?, Some(plan)))
    }

    fn of_spec(spec: SpecFile, stem: String) -> Result<Self, InputError> {
        let kind = kind(&spec)?;
        let plan = (kind.plan)(&spec)?;
        let group = spec.group.or(kind.group);
        Ok(Self { group, ..Self::new(spec, stem, kind.name, plan)? })
    }

    /// Describes the surfaces of a spec; or that of a measured file with `options`, as in `[surface.NAME.file]`, and compares both
    /// models on it. The report is called `name`, or after the file.
    pub fn describe(
        path: &Path,
        options: &FileOptions,
        name: Option<&str>,
        progress: &dyn Progress,
    ) -> Result<Self, InputError> {
        let is_spec = path.extension().is_some_and(|ending| ending == "toml");
        if is_spec && *options != FileOptions::default() {
            return Err(InputError::file(
                path,
                "is a spec, which defines its surfaces completely; allowed: --name, --out, --force, --threads and --quiet; other options only \
                 with a measured file",
            ));
        }
        let (spec, stem) = if is_spec {
            (SpecFile::read(path, &tables())?, format!("{}-surfaces", plain(&file_stem(path)?)))
        } else {
            options.check()?;
            (
                SpecFile::parse(options.source(path), &tables())?,
                file_stem(path).map(|_| surface_report(path))?,
            )
        };
        let stem = match name {
            None => stem,
            Some(name) if !is_plain(name) => {
                let message = format!(
                    "found the report name \"{name}\"; allowed: a name such as my-surface, {NOT_IN_NAMES} and no point at its \
                     beginning"
                );
                return Err(InputError::file(Path::new("--name"), message));
            }
            Some(name) => name.to_owned(),
        };
        let spec = spec.watched_by(progress);
        let plan: Arc<dyn Plan> =
            if is_spec { Arc::new(SurfacesPlan::new(&spec)?) } else { Arc::new(described(&spec)?) };
        let described = if is_spec { Some(path.to_owned()) } else { plan.inputs().into_iter().next() };
        Ok(Self { described, ..Self::new(spec, stem, SURFACES, plan)? })
    }

    fn new(
        spec: SpecFile,
        stem: String,
        kind: &'static str,
        plan: Arc<dyn Plan>,
    ) -> Result<Self, InputError> {
        let materials = spec.materials().map(|(name, body)| (name.get_ref().clone(), *body)).collect();
        let origins = spec.origins();
        let SpecFile { source, title, notes, figure, is_long, seed, .. } = spec;
        check_memory(&*plan, &source)?;
        Ok(Self {
            source,
            stem,
            title,
            kind,
            notes,
            figure,
            is_long,
            group: None,
            seed,
            materials,
            origins,
            plan,
            described: None,
        })
    }

    /// The file whose surfaces it only describes; `None` of an experiment that does more.
    pub fn described_file(&self) -> Option<PathBuf> {
        self.described.clone()
    }

    /// A text for its user, with the keys that it advises in the form of where it is read.
    pub fn for_its_user(&self, text: &str) -> String {
        self.source.front_end().text(text)
    }

    /// Whether it runs only where it is named or long runs are asked for.
    pub fn is_long(&self) -> bool {
        self.is_long
    }

    /// An estimate of the work of a run: micro-contacts evaluated.
    pub fn work(&self) -> u128 {
        self.plan.work()
    }

    /// An estimate of the memory of a run at its peak, bytes.
    pub fn memory(&self) -> u128 {
        self.plan.memory().bytes
    }

    pub(crate) fn path(&self) -> &Path {
        &self.source.path
    }

    /// When its input files were last written, and their sizes.
    pub(crate) fn modified(&self) -> Vec<Modified> {
        let of = |path: &PathBuf| {
            let metadata = std::fs::metadata(path).ok()?;
            Some((metadata.modified().ok()?, metadata.len()))
        };
        self.plan.inputs().iter().map(of).collect()
    }

    pub fn stem(&self) -> &str {
        &self.stem
    }

    pub fn title(&self) -> &str {
        &self.title
    }

    /// What its report depends on: its name, the spec, how it is run, its input files and the program's own sources, as a
    /// hexadecimal SHA-256.
    pub fn key(&self) -> Result<String, InputError> {
        self.watched_key(&Silent)
    }

    /// The same with progress where its files are large.
    pub fn watched_key(&self, progress: &dyn Progress) -> Result<String, InputError> {
        Ok(self.key_of(&self.watched_input(progress)?))
    }

    /// The same on an [`Self::input`] that was hashed before.
    pub fn key_of(&self, input: &str) -> String {
        let mut hash = Sha256::new();
        hash.update(SOURCES);
        hash.update(sha256(self.stem.as_bytes()));
        hash.update(input);
        hexadecimal(&hash.finalize())
    }

    /// The part of [`Self::key`] that is the same for every build of the program: the spec, how it is run, and its input files.
    pub fn input(&self) -> Result<String, InputError> {
        self.watched_input(&Silent)
    }

    /// The same with progress where its files are large.
    pub fn watched_input(&self, progress: &dyn Progress) -> Result<String, InputError> {
        self.input_by(|path| watched_sha256_of_file(path, progress))
    }

    /// The same with the SHA-256 of each file from `of_file`.
    pub(crate) fn input_by(
        &self,
        of_file: impl Fn(&Path) -> std::io::Result<[u8; 32]>,
    ) -> Result<String, InputError> {
        let mut hash = Sha256::new();
        hash.update(sha256(self.source.text.as_bytes()));
        for path in self.plan.inputs() {
            let content = match self.source.content_in_memory(&path) {
                Some(content) => content.sha256(),
                None => of_file(&path)
                    .map_err(|error| InputError::file(&path, format!("cannot be read: {error}")))?,
            };
            hash.update(content);
        }
        Ok(hexadecimal(&hash.finalize()))
    }

    pub fn run(&self, progress: &dyn Progress) -> Result<Box<dyn Outcome>, InputError> {
        let input = self.watched_input(progress)?;
        self.plan.run(&self.context(&input, progress))
    }

    /// Runs it, and makes something of the results and of its key, where its input files stay the same. The hash of its
    /// [`Self::input`] may be `known`. What it has done is kept in the folder `kept`, and what is kept there is not done again.
    pub fn run_on<T>(
        &self,
        known: Option<String>,
        kept: Option<&Path>,
        progress: &dyn Progress,
        make: impl FnOnce(&dyn Outcome, &str) -> T,
    ) -> Result<(T, Box<dyn Outcome>), InputError> {
        let before = self.modified();
        let input = known.map_or_else(|| self.watched_input(progress), Ok)?;
        let results = self.plan.run(&RunContext { kept, ..self.context(&input, progress) });
        self.check_unchanged(&before)?;
        let results = results?;
        let made = make(&*results, &self.key_of(&input));
        // What is on a page may be read from a map on the disk.
        self.check_unchanged(&before)?;
        Ok((made, results))
    }

    /// Refuses input files that have been written or removed since they were `before`.
    pub(crate) fn check_unchanged(&self, before: &[Modified]) -> Result<(), InputError> {
        let changed = self.modified().iter().zip(before).position(|(now, before)| now != before);
        match changed.and_then(|place| self.plan.inputs().into_iter().nth(place)) {
            Some(path) => Err(InputError::file(&path, "changed while it was read; run again")),
            None => Ok(()),
        }
    }

    /// Whether it runs variations, which it keeps.
    pub fn is_sweep(&self) -> bool {
        self.kind == sweep::NAME
    }

    pub(crate) fn inputs(&self) -> Vec<PathBuf> {
        self.plan.inputs()
    }

    /// Looks for what a run would refuse, such as a load that a population does not reach, without running it.
    pub fn check(&self) -> Result<(), InputError> {
        // Nothing is written, so that its input needs no name.
        self.plan.check(&self.context("", &Silent))
    }

    /// Its division into tasks.
    pub(crate) fn divided(&self) -> Result<&dyn Divided, InputError> {
        self.plan.divided().ok_or_else(|| {
            let message = format!(
                "found [{}], which needs its whole input at once and has no tasks; allowed: [tiled], which sums a surface tile by tile, and [sweep]",
                self.kind
            );
            InputError::file(&self.source.path, message)
        })
    }

    pub(crate) fn context<'a>(&'a self, input_sha256: &'a str, progress: &'a dyn Progress) -> RunContext<'a> {
        let Self { source, stem, title, kind, notes, figure, seed, materials, origins, .. } = self;
        RunContext {
            title,
            stem,
            kind,
            input_sha256,
            notes,
            figure: *figure,
            is_long: self.is_long,
            group: self.group,
            library_sha256: LIBRARY,
            seed: *seed,
            materials,
            origins,
            source,
            progress,
            kept: None,
        }
    }
}

/// The spec, to be saved at `spec`, that gives `results` on the file at `path` as `options` did: with the preparation that was found.
pub fn saved_spec(options: &FileOptions, path: &Path, spec: &Path, results: &dyn Outcome) -> String {
    let text = options.saved_spec(path, spec);
    let results = (results as &dyn Any).downcast_ref::<CompareResults>();
    let fit = results.and_then(|results| results.surfaces.first()?.surface.fit.as_ref());
    match fit {
        Some(fit) => by_hand(&text, fit),
        None => text,
    }
}

/// Makes or reads realisation `realisation` (from 1) of the one surface of a spec without an experiment, with its prepared map
/// where it has one.
pub fn make_surface(
    source: Source,
    realisation: usize,
    as_ellipses: bool,
    progress: &dyn Progress,
) -> Result<Surface, InputError> {
    let spec = SpecFile::parse(source, &[SURFACES])?.watched_by(progress);
    let plans = surfaces(&spec, None, 0..0, as_ellipses)?;
    let [plan] = &plans[..] else {
        return Err(InputError::file(&spec.source.path, "found several surfaces; allowed: one"));
    };
    let counter = Counter::default();
    let mut factory =
        SurfaceFactory::from_seed(plan, &spec.source, spec.seed, &counter, progress).keeping_map(true);
    let (mut files, mut timing) = (files_of(&plans, &counter), Timing::default());
    factory.make(realisation, AnalysisDepth::Comparison, &mut files, &mut timing)
}

/// Writes the index of all reports in `out`, where it has changed.
pub fn write_index(store: &mut Store, out: &Path) -> Result<(), StoreError> {
    let index = Index::read(out, REPORTED);
    if index.is_empty() {
        return Ok(());
    }
    for (page, content) in &index.pages {
        if std::fs::read(out.join(page)).ok().as_deref() != Some(content.as_bytes()) {
            store.write_page(page, content.as_bytes(), MARK)?;
        }
    }
    Ok(())
}

/// Names of the tables that a spec may contain besides the common keys.
pub(crate) fn tables() -> Vec<&'static str> {
    REPORTED.iter().map(|kind| kind.name).chain([SURFACES]).collect()
}

/// The tables of some kinds, as a spec has them.
fn bracketed(is_among: fn(&RegisteredKind) -> bool) -> Vec<String> {
    KINDS.iter().filter(|kind| is_among(kind)).map(|kind| format!("[{}]", kind.name)).collect()
}

/// The kind of the one experiment that a spec holds.
fn kind(spec: &SpecFile) -> Result<&'static RegisteredKind, InputError> {
    let of_name =
        |wanted: &str| REPORTED.iter().find(|kind| kind.name == wanted).expect("tables are those of kinds");
    // Its variations have the kind that it stands beside.
    if spec.tables().iter().any(|(name, _)| name == sweep::NAME) {
        return Ok(of_name(sweep::NAME));
    }
    let allowed = format!("exactly one of {}", bracketed(|_| true).join(", "));
    let mut found = spec.tables().iter().filter(|(name, _)| name != SURFACES);
    let Some((name, _)) = found.next() else {
        return Err(InputError::file(&spec.source.path, format!("found no experiment; allowed: {allowed}")));
    };
    if let Some((_, second)) = found.next() {
        let message = format!("found a second experiment; allowed: {allowed} per file");
        return Err(spec.source.error_at(second.clone(), message));
    }
    let kind = of_name(name);
    let reads = kind.reads;
    if let Some((_, span)) = spec.tables().iter().find(|(name, _)| name == SURFACES && !reads.surfaces) {
        let users = listed(&bracketed(|kind| kind.reads.surfaces));
        let message = format!("found a surface, which only {users} use; allowed: no [surface.NAME] here");
        return Err(spec.source.error_at(span.clone(), message));
    }
    if let Some((name, _)) = spec.materials().next().filter(|_| !reads.materials) {
        let message =
            format!("found a material, but [{}] has its own; allowed: no [material.NAME] here", kind.name);
        return Err(spec.source.error_at(name.span(), message));
    }
    Ok(kind)
}

/// What the name of a report does not have, because a file name does not have it on every system.
const NOT_IN_NAMES: &str = "without tabs and any of /\\:*?\"<>|";

/// Stem of a spec, by which its report is called.
fn stem_of(path: &Path) -> Result<String, InputError> {
    let stem = file_stem(path)?;
    if is_plain(&stem) {
        return Ok(stem);
    }
    let message = format!(
        "has a name that its report cannot take; allowed: a file name {NOT_IN_NAMES}; rename it, for example to {}.toml",
        plain(&stem)
    );
    Err(InputError::file(path, message))
}

/// Name of a file without its ending.
fn file_stem(path: &Path) -> Result<String, InputError> {
    let stem = path.file_stem().and_then(|stem| stem.to_str()).filter(|stem| !stem.starts_with('.'));
    stem.map(str::to_owned).ok_or_else(|| {
        InputError::file(
            path,
            "has no name that its report can take; allowed: a file name such as my-surface.toml",
        )
    })
}

/// The name of the report on a measured file, unless it is given.
pub fn surface_report(path: &Path) -> String {
    format!("surface-{}", plain(&crate::surface::file_name(path)))
}

/// What it will do and need, for a person.
impl fmt::Display for Experiment {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}: {}", self.source.path.display(), self.title)?;
        write!(f, "{}", self.plan)?;
        writeln!(
            f,
            "  memory: at most {:.1} MB; work: at most {:.1e} micro-contacts per pass",
            self.plan.memory().bytes as f64 / 1e6,
            self.plan.work() as f64
        )
    }
}

impl Experiment {
    /// Number of its tasks, and of the passes over all of them.
    pub fn tasks(&self) -> Result<[usize; 2], InputError> {
        self.divided().map(|divided| [divided.tasks(), divided.passes()])
    }

    /// What its task `task` (from 0) finds in the pass after those of `earlier`, which hold what all tasks have found: JSON.
    pub fn run_task(
        &self,
        task: usize,
        earlier: &[Vec<String>],
        progress: &dyn Progress,
    ) -> Result<String, InputError> {
        let divided = self.divided()?;
        self.check_passes(earlier)?;
        if task >= divided.tasks() || earlier.len() >= divided.passes() {
            let message = format!("found task {task} of {}; allowed: below", divided.tasks());
            return Err(InputError::file(self.path(), message));
        }
        divided.run_task(&self.context("", progress), task, earlier)
    }

    /// The results of a run, from what all tasks have found in all passes: the same to the bit as those of [`Self::run`]. `key` is
    /// [`Self::key`] from before the tasks ran.
    pub fn results_of_tasks(
        &self,
        passes: &[Vec<String>],
        key: &str,
        progress: &dyn Progress,
    ) -> Result<Box<dyn Outcome>, InputError> {
        let divided = self.divided()?;
        self.check_passes(passes)?;
        let input = self.watched_input(progress)?;
        if self.key_of(&input) != key {
            return Err(InputError::file(self.path(), "has an input file that changed; run again"));
        }
        divided.results(&self.context(&input, progress), passes)
    }

    fn check_passes(&self, passes: &[Vec<String>]) -> Result<(), InputError> {
        let tasks = self.divided()?.tasks();
        match passes.iter().find(|pass| pass.len() != tasks) {
            Some(pass) => {
                let message = format!("found the results of {} tasks; allowed: of all {tasks}", pass.len());
                Err(InputError::file(self.path(), message))
            }
            None => Ok(()),
        }
    }
}

/// Bytes; 0 where they are not known.
fn available_memory() -> u128 {
    let mut system = sysinfo::System::new();
    system.refresh_memory();
    // Not what its processes hold: `free_memory` would count the cache of files as taken.
    let container = system.cgroup_limits().map(|limits| limits.total_memory.saturating_sub(limits.rss));
    let process = fs::read_to_string("/proc/self/limits")
        .ok()
        .zip(fs::read_to_string("/proc/self/status").ok())
        .and_then(|(limits, status)| left_of_address_space(&limits, &status));
    let all = [Some(system.available_memory()), container, process];
    all.into_iter().flatten().min().map_or(0, u128::from)
}

/// Refuses what memory cannot hold, before anything is allocated.
fn check_memory(plan: &dyn Plan, source: &Source) -> Result<(), InputError> {
    let available = available_memory();
    let needed = plan.memory();
    // Without a known limit nothing is refused.
    if available == 0 || needed.bytes <= available {
        return Ok(());
    }
    let message = format!(
        "this needs about {:.1} GB of memory; available: {:.1} GB. Allowed: fewer asperities, a smaller map, where it compares models \
         on a measured map, robustness = false, or [tiled], which sums a surface of any size at given separations",
        needed.bytes as f64 / 1e9,
        available as f64 / 1e9
    );
    Err(match needed.key {
        Some(key) => source.error_at(key, message),
        None => InputError::file(&source.path, message),
    })
}

/// What is left of the address space that `ulimit -v` allows, by the texts of `/proc/self/limits` and `/proc/self/status`;
/// `None` without a limit.
fn left_of_address_space(limits: &str, status: &str) -> Option<u64> {
    let after = |text: &str, name: &str| {
        let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
        rest.split_whitespace().next()?.parse::<u64>().ok()
    };
    let limit = after(limits, "Max address space")?;
    Some(limit.saturating_sub(1024 * after(status, "VmSize:")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_of_the_address_space_leaves_what_is_not_taken() {
        let limits = |soft: &str| {
            format!(
                "Limit  Soft Limit  Hard Limit  Units\nMax address space         {soft}   unlimited   bytes\n"
            )
        };
        let status = "Name:\texperiment\nVmPeak:\t 9000 kB\nVmSize:\t    1000 kB\n";
        assert_eq!(left_of_address_space(&limits("5120000"), status), Some(4_096_000));
        assert_eq!(left_of_address_space(&limits("1000"), status), Some(0));
        assert_eq!(left_of_address_space(&limits("unlimited"), status), None);
        assert!(available_memory() > 0);
    }
}
