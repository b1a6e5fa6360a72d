//! Surfaces that are kept between changes of a spec: what has not changed is not made again.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use asperity::surface::AnalysisDepth;
use asperity::work::Counter;
use asperity_contact_framework::input::{InputError, SpecFile};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::Progress;
use asperity_workbench::{Refused, SpecText};

use crate::experiment::tables;
use crate::surface::{StoredSurface, SurfaceFactory, SurfacePlan, SurfaceStore, files_of, surfaces};

/// Bytes that all surfaces together may keep.
const MOST_BYTES: usize = 1 << 30;

/// A surface that nobody has asked for so long is dropped when another is made.
const IDLE: Duration = Duration::from_secs(15 * 60);

/// The surfaces, the last used last.
#[derive(Default)]
pub struct Surfaces(Mutex<Vec<Entry>>);

struct Entry {
    identity: String,
    used: Instant,
    surface: Arc<StoredSurface>,
}

impl Surfaces {
    fn entries(&self) -> MutexGuard<'_, Vec<Entry>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn get(&self, identity: &str) -> Option<Arc<StoredSurface>> {
        let mut entries = self.entries();
        let place = entries.iter().position(|entry| entry.identity == identity)?;
        let entry = Entry { used: Instant::now(), ..entries.remove(place) };
        let surface = Arc::clone(&entry.surface);
        entries.push(entry);
        Some(surface)
    }

    fn put(&self, identity: String, surface: Arc<StoredSurface>) {
        let mut entries = self.entries();
        entries.retain(|entry| entry.identity != identity && entry.used.elapsed() < IDLE);
        entries.push(Entry { identity, used: Instant::now(), surface });
        let bytes = |entries: &[Entry]| entries.iter().map(|entry| entry.surface.bytes()).sum::<usize>();
        while entries.len() > 1 && bytes(&entries) > MOST_BYTES {
            entries.remove(0);
        }
    }

    /// Forgets all.
    pub fn forget(&self) {
        self.entries().clear();
    }

    /// The first realisation of one surface of a spec, in full.
    pub fn surface(
        &self,
        spec: &SpecText,
        name: &str,
        progress: &dyn Progress,
    ) -> Result<Arc<StoredSurface>, Refused> {
        let refuse = |error: InputError| super::refused(&error, spec);
        let file = SpecFile::parse(super::source(spec), &tables()).map_err(refuse)?;
        // Ellipses, which some laws need, do not change what is shown.
        let plans = surfaces(&file, None, 0..0, false).map_err(refuse)?;
        let found = plans.iter().find(|plan| plan.name == name);
        let plan = found.ok_or_else(|| Refused::new(format!("found no surface \"{name}\" in the spec")))?;
        let of_spec = OfSpec::new(self, spec);
        let identity = of_spec.identity(plan);
        if let Some(kept) = of_spec.get(&identity) {
            return Ok(kept);
        }
        let counter = Counter::default();
        let (mut files, mut timing) = (files_of(std::slice::from_ref(plan), &counter), Timing::default());
        let mut factory = SurfaceFactory::from_seed(plan, &file.source, file.seed, &counter, progress)
            .with_store(Some(&of_spec));
        let surface = factory.make(1, AnalysisDepth::Everything, &mut files, &mut timing).map_err(refuse)?;
        Ok(of_spec.get(&identity).unwrap_or_else(|| Arc::new(factory.stored(surface))))
    }
}

/// The surfaces of one spec among those that are kept.
pub struct OfSpec<'a> {
    all: &'a Surfaces,
    folder: PathBuf,
    table: toml::Table,
}

impl<'a> OfSpec<'a> {
    pub fn new(all: &'a Surfaces, spec: &SpecText) -> Self {
        Self { all, folder: spec.folder.clone(), table: spec.text.parse().unwrap_or_default() }
    }
}

impl SurfaceStore for OfSpec<'_> {
    /// Of a pair the keys of all surfaces.
    fn identity(&self, plan: &SurfacePlan) -> String {
        let all = self.table.get("surface");
        let is_of_several = plan.is_pair() || plan.is_composite();
        let keys = if is_of_several { all } else { all.and_then(|all| all.get(&plan.name)) };
        let seed = self.table.get("seed");
        let files: Vec<_> = plan.inputs().iter().map(|path| state(path)).collect();
        let (folder, name) = (self.folder.display(), &plan.name);
        format!("{folder}|{name}|{}|{seed:?}|{keys:?}|{files:?}", plan.has_ellipses())
    }

    fn get(&self, identity: &str) -> Option<Arc<StoredSurface>> {
        self.all.get(identity)
    }

    fn put(&self, identity: String, made: StoredSurface) {
        self.all.put(identity, Arc::new(made));
    }
}

/// When a file was last written, and its size.
fn state(path: &Path) -> (PathBuf, Option<(SystemTime, u64)>) {
    let metadata = std::fs::metadata(path).ok();
    (path.to_owned(), metadata.and_then(|metadata| Some((metadata.modified().ok()?, metadata.len()))))
}
