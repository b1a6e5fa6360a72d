//! The measured files of a run: each is read once, however many surfaces are found in it; and surfaces that are kept between runs.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use asperity::npy::NpyError;
use asperity::progress::Progress;
use asperity::surface::{Preparation, Surface};
use asperity::topography::Rows;
use asperity::topography::read::{LengthUnits, MapFile, Marks, ReadError};
use asperity::units::Dimension;
use asperity::work::{Counter, Item};
use asperity::{AsperityList, HeightMap, ListError, ListOptions};
use asperity_contact_framework::input::{Forms, schema};
use asperity_contact_framework::written_schema;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};
use serde_json::json;

use super::plan::SurfacePlan;
use super::spec::UnitSpec;

/// What a surface is found in.
#[derive(Debug, Clone, PartialEq)]
pub enum Reading {
    List(PathBuf, ListOptions),
    Map(MapFile),
}

impl Reading {
    pub fn list(path: &Path, given: ListOptions) -> Self {
        Self::List(whole(path), given)
    }

    pub fn map(file: &MapFile) -> Self {
        Self::Map(MapFile { path: whole(&file.path), ..file.clone() })
    }
}

/// Whether a map of so many points along x and y is copied into memory even where it could be read row by row: each treatment reads it
/// several times.
pub fn is_copied([nx, ny]: [usize; 2]) -> bool {
    const MOST: usize = 1 << 21;
    nx * ny <= MOST
}

/// A path that is the same for all ways to a file.
fn whole(path: &Path) -> PathBuf {
    std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())
}

/// What was read, as long as a surface that is yet to be made needs it again.
pub struct Files<'a> {
    awaited: Vec<Reading>,
    lists: Vec<(Reading, Arc<AsperityList>)>,
    maps: Vec<(Reading, Arc<dyn Rows>)>,
    counter: &'a Counter,
}

impl<'a> Files<'a> {
    /// The files of surfaces that will be made of `awaited`.
    pub fn new(awaited: Vec<Reading>, counter: &'a Counter) -> Self {
        Self { awaited, lists: Vec::new(), maps: Vec::new(), counter }
    }

    pub fn list(
        &mut self,
        path: &Path,
        given: ListOptions,
        progress: &dyn Progress,
    ) -> Result<AsperityList, ListError> {
        let reading = Reading::list(path, given);
        let is_needed_again = self.take(&reading);
        let read = || {
            self.counter.add(Item::Files, 1);
            AsperityList::read(path, given, progress).map(Arc::new)
        };
        let list = once(&mut self.lists, reading, is_needed_again, read)?;
        Ok(Arc::unwrap_or_clone(list))
    }

    pub fn map(&mut self, file: &MapFile, progress: &dyn Progress) -> Result<Arc<dyn Rows>, ReadError> {
        let reading = Reading::map(file);
        let is_needed_again = self.take(&reading);
        let read = || -> Result<Arc<dyn Rows>, ReadError> {
            self.counter.add(Item::Files, 1);
            let map = file.rows(progress)?;
            if !is_copied(map.points()) || map.block(0..1).is_some() {
                return Ok(Arc::from(map));
            }
            let copy = HeightMap::from_rows(&*map);
            if map.is_whole() { Ok(Arc::new(copy)) } else { Err(ReadError::from(NpyError::Shortened)) }
        };
        once(&mut self.maps, reading, is_needed_again, read)
    }

    /// Awaits a reading once less, and says whether it is still awaited.
    fn take(&mut self, reading: &Reading) -> bool {
        if let Some(place) = self.awaited.iter().position(|awaited| awaited == reading) {
            self.awaited.swap_remove(place);
        }
        self.awaited.contains(reading)
    }
}

/// What `kept` holds of a reading, else what `read` finds; it is kept where it `is_needed_again`.
fn once<T: ?Sized, E>(
    kept: &mut Vec<(Reading, Arc<T>)>,
    reading: Reading,
    is_needed_again: bool,
    read: impl FnOnce() -> Result<Arc<T>, E>,
) -> Result<Arc<T>, E> {
    let content = match kept.iter().position(|(known, _)| *known == reading) {
        Some(place) => kept.swap_remove(place).1,
        None => read()?,
    };
    if is_needed_again {
        kept.push((reading, Arc::clone(&content)));
    }
    Ok(content)
}

/// `unit` of a map: one of all lengths, or one of coordinates and one of heights.
#[derive(Debug, Clone, Copy)]
pub struct MapUnitSpec(pub LengthUnits);

/// Units of coordinates and heights.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table { xy, z }")]
struct Both {
    /// Unit of x and y.
    xy: UnitSpec,
    /// Unit of heights.
    z: UnitSpec,
}

written_schema!(MapUnitSpec, |generator| {
    let one = UnitSpec::json_schema(generator);
    let both = Both::json_schema(generator);
    json!({
        "anyOf": [one, both],
        schema::TYPE: "unit of length, or a table of two: xy and z",
        schema::RANGE: Dimension::Length.documented().join(", "),
    })
});

impl<'de> Deserialize<'de> for MapUnitSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Forms::new("a unit of length such as \"um\", or { xy = \"um\", z = \"nm\" }")
            .text(|text| UnitSpec::try_from(text.to_owned()).map(|unit| Self(LengthUnits::same(unit.0))))
            .table(|Both { xy, z }| Ok(Self(LengthUnits { xy: xy.0, z: z.0 })))
            .read(deserializer)
    }
}

/// `missing`: heights that mark missing points, in the unit of the file, and words of a text that do.
#[derive(Debug, Clone)]
pub struct MissingSpec(pub Marks);

written_schema!(MissingSpec, |_| {
    let one = json!({ "type": ["number", "string"] });
    let kind = "number or word, or a list of them";
    json!({ "anyOf": [one, { "type": "array", "items": one }], schema::TYPE: kind })
});

/// A height or a word.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a number or a word")]
enum Mark {
    Height(f64),
    Word(String),
}

impl<'de> Deserialize<'de> for MissingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number such as -9999, a word such as \"***\", or a list of them; [] where every number is a height";
        let found = Forms::new(expected)
            .number(|value, _| Ok(vec![Mark::Height(value)]))
            .text(|word| Ok(vec![Mark::Word(word.to_owned())]))
            .list(Ok)
            .read(deserializer)?;
        let mut marks = Marks::default();
        for mark in found {
            match mark {
                Mark::Height(height) if height.is_finite() => marks.heights.push(height),
                Mark::Word(word) if !word.trim().is_empty() => marks.words.push(word.trim().to_owned()),
                _ => {
                    return Err(serde::de::Error::custom(
                        "found NaN, an infinite height or an empty word, which are missing points in any case; allowed: finite numbers and words",
                    ));
                }
            }
        }
        Ok(Self(marks))
    }
}

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
        format!("{folder}|{name}|{}|{seed:?}|{keys:?}|{files:?}", plan.as_ellipses)
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
