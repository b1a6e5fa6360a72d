//! Surfaces that are kept between runs of specs that differ: what has not changed is not made again.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use asperity::surface::{Preparation, Surface};
use asperity::topography::Rows;

use super::plan::SurfacePlan;

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

    pub fn forget(&self) {
        self.entries().clear();
    }
}

/// The surfaces of one spec among those that are kept.
pub struct OfSpec<'a> {
    all: &'a Surfaces,
    folder: PathBuf,
    table: toml::Table,
}

impl<'a> OfSpec<'a> {
    /// Of the spec `text`, whose paths are relative to `folder`.
    pub fn new(all: &'a Surfaces, folder: &Path, text: &str) -> Self {
        Self { all, folder: folder.to_owned(), table: text.parse().unwrap_or_default() }
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

/// Keeps the first realisations of surfaces.
pub trait SurfaceStore: Sync {
    /// Everything that a surface is made of: its keys, the seed, and the present state of its files.
    fn identity(&self, plan: &SurfacePlan) -> String;

    /// The surface of this identity, if it was made before.
    fn get(&self, identity: &str) -> Option<Arc<StoredSurface>>;

    fn put(&self, identity: String, made: StoredSurface);
}

/// A surface with what other runs need of how it was made.
pub struct StoredSurface {
    /// The surface, with its prepared map.
    pub surface: Surface,
    pub(super) raw: Option<Arc<dyn Rows>>,
    pub(super) fitted: Option<Preparation>,
    pub(super) bandwidth: Option<f64>,
}

impl StoredSurface {
    /// About the bytes that it keeps: its maps and asperities.
    pub fn bytes(&self) -> usize {
        /// A height as read, prepared and in the image of a fit; height, radius and curvatures of an asperity.
        const OF_POINT: usize = 16;
        const OF_ASPERITY: usize = 64;
        let points = self.surface.map.as_ref().map_or(0, |map| map.points[0] * map.points[1]);
        OF_POINT * points + OF_ASPERITY * self.surface.set.count()
    }
}
