//! What it costs to read a list of asperities from a file and to add it up, by its length: time and memory.

use std::hint::black_box;
use std::io;
use std::path::Path;

use tempfile::NamedTempFile;

use super::memory::peak_of;
use super::sum::spread;
use super::timing::{Candidate, medians};
use asperity::{
    AsperityList, AsperitySet, Deterministic, Draw, ListError, ListOptions, MicroContact, Model, Population,
    ReferencePlane, Response, SetError, npy,
};

/// Settings of the list benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct ListTask {
    /// Asperities in the lists, ascending.
    pub counts: Vec<usize>,
    /// Separations at which each is summed.
    pub separations: usize,
}

/// A list of one length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListPoint {
    /// Asperities.
    pub asperities: usize,
    /// Separations.
    pub separations: usize,
    /// Seconds to read the file, cached by the system.
    pub read_seconds: f64,
    /// Seconds to add up at all separations.
    pub sum_seconds: f64,
    /// Peak memory while reading and summing, bytes; `None` where the system does not report it.
    pub peak_bytes: Option<u64>,
    /// So much more than just before, bytes.
    pub added_bytes: Option<u64>,
}

impl ListPoint {
    /// Seconds that an asperity takes to be read and added up.
    pub fn seconds_per_asperity(&self) -> f64 {
        (self.read_seconds + self.sum_seconds) / self.asperities as f64
    }
}

/// From this many asperities on, fixed costs of a run are negligible.
pub const LONG: usize = 100_000;

/// What long lists cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongLists {
    /// The shortest of them.
    pub shortest: ListPoint,
    /// The longest.
    pub longest: ListPoint,
    /// The fewest and the most seconds that an asperity takes to be read and added up.
    pub seconds_per_asperity: [f64; 2],
}

impl LongLists {
    /// Those of [`LONG`] asperities and more; `None` where there is none.
    pub fn of(lists: &[ListPoint]) -> Option<Self> {
        let long = || lists.iter().filter(|point| point.asperities >= LONG);
        let seconds = || long().map(ListPoint::seconds_per_asperity);
        Some(Self {
            shortest: *long().next()?,
            longest: *long().next_back()?,
            seconds_per_asperity: [seconds().fold(f64::INFINITY, f64::min), seconds().fold(0.0, f64::max)],
        })
    }
}

/// Why a list was not read back.
#[derive(Debug, thiserror::Error)]
pub enum Unlisted {
    /// A population that makes no set.
    #[error(transparent)]
    Set(#[from] SetError),
    /// There is no room, or no right, for the file.
    #[error(
        "a list of {count} asperities cannot be written to {}: {error}; allowed: a folder for temporary files (TMPDIR) with room for {} bytes",
        std::env::temp_dir().display(),
        16 * count
    )]
    Written {
        /// Asperities in the list.
        count: usize,
        /// Reason given by the system.
        error: io::Error,
    },
    /// The file is not what was written.
    #[error("the list that was just written {0}")]
    Read(#[from] ListError),
}

/// Writes random sets of growing size as lists, reads them back and adds them up; `seed(count)` seeds a set, `done` is
/// called after each. A list is removed whether or not it could be read.
///
/// # Errors
/// See [`Unlisted`].
pub fn lists_of(
    contact: &dyn MicroContact,
    population: &Population,
    task: &ListTask,
    seed: impl Fn(usize) -> [u8; 32],
    done: impl Fn(usize),
) -> Result<Vec<ListPoint>, Unlisted> {
    let mut points = Vec::new();
    for &count in &task.counts {
        let file = written(population, count, seed(count))?;
        points.push(point(contact, population, file.path(), task)?);
        done(count);
    }
    Ok(points)
}

fn point(
    contact: &dyn MicroContact,
    population: &Population,
    path: &Path,
    task: &ListTask,
) -> Result<ListPoint, Unlisted> {
    let separations = spread(task.separations);
    let (first, peak) = peak_of(|| {
        let set = read(path, population)?;
        black_box(sums(contact, &set, population, &separations));
        Ok::<_, Unlisted>(set)
    });
    let asperities = first?.count();
    let mut set = None;
    let read_seconds = median(&mut || {
        // Freed first: there is room for one.
        set = None;
        // It was read above.
        set = read(path, population).ok();
    });
    let sum_seconds = median(&mut || {
        if let Some(set) = &set {
            black_box(sums(contact, set, population, black_box(&separations)));
        }
    });
    Ok(ListPoint {
        asperities,
        separations: separations.len(),
        read_seconds,
        sum_seconds,
        peak_bytes: peak.map(|peak| peak.highest),
        added_bytes: peak.map(|peak| peak.highest.saturating_sub(peak.before)),
    })
}

fn median(work: &mut dyn FnMut()) -> f64 {
    let mut candidates: [Candidate; 1] = [Box::new(work)];
    medians(&mut candidates)[0]
}

/// A random set as an n x 2 `.npy` of heights and radii, which is removed when the value is dropped.
fn written(population: &Population, count: usize, seed: [u8; 32]) -> Result<NamedTempFile, Unlisted> {
    let set = population.set(count, Draw::Random(seed))?;
    let write = || {
        let file = tempfile::Builder::new().prefix("asperities-").suffix(".npy").tempfile()?;
        let values = set.heights().iter().zip(set.radii()).flat_map(|(&height, &radius)| [height, radius]);
        npy::write(file.as_file(), [set.count(), 2], values).map(|()| file)
    };
    write().map_err(|error| Unlisted::Written { count, error })
}

fn read(path: &Path, population: &Population) -> Result<AsperitySet, Unlisted> {
    let list = AsperityList::read(path, ListOptions::default())?;
    let nominal_area = list.count() as f64 / population.density;
    Ok(list.set(nominal_area)?)
}

fn sums(
    contact: &dyn MicroContact,
    set: &AsperitySet,
    population: &Population,
    separations: &[f64],
) -> Vec<Response> {
    let plane = ReferencePlane { mean: 0.0, sigma: population.sigma };
    Deterministic::new(contact, set.spheres(), plane).respond_all(separations)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::{Heights, Interface, Material, Zmc};

    const CASE: Population =
        Population { radius: 2e-5, sigma: 4.8e-8, density: 6e10, heights: Heights::GAUSSIAN };

    #[test]
    fn a_list_is_read_as_it_was_drawn_and_then_removed() {
        let file = written(&CASE, 20_000, [4; 32]).unwrap();
        let drawn = CASE.set(20_000, Draw::Random([4; 32])).unwrap();
        assert_eq!(read(file.path(), &CASE).unwrap(), drawn);
        let path = file.path().to_owned();
        drop(file);
        assert!(!path.exists());
    }

    #[test]
    fn a_longer_list_takes_longer() {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        let contact = Interface::bare(Zmc::default(), &steel, &steel).unwrap();
        let task = ListTask { counts: vec![1000, 1_000_000], separations: 3 };
        let points = lists_of(&contact, &CASE, &task, |_| [5; 32], |_| ()).unwrap();
        let [small, large] = points[..] else { panic!("{points:?}") };
        assert_eq!((small.asperities, large.asperities, large.separations), (1000, 1_000_000, 3));
        assert!(small.read_seconds > 0.0 && large.read_seconds > small.read_seconds);
        assert!(small.sum_seconds > 0.0 && large.sum_seconds > small.sum_seconds);
        assert!(large.added_bytes <= large.peak_bytes);
        assert_eq!(large.peak_bytes.is_some(), cfg!(target_os = "linux"));
    }

    #[test]
    fn a_population_that_makes_no_set_makes_no_list() {
        assert!(matches!(written(&CASE, 0, [0; 32]), Err(Unlisted::Set(SetError::Empty))));
    }
}
