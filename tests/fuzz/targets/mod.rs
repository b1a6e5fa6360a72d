//! What is fuzzed: each reader of maps, lists of asperities, quantities and specs, and what holds on any bytes at all. The programs of
//! libFuzzer and the test on the stable compiler call the same functions.

mod prepare;

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use asperity::progress::Silent;
use asperity::topography::Rows;
use asperity::topography::read::{MapFile, ReadOptions};
use asperity::units::Dimension;
use asperity::{AsperityList, ListOptions};
use asperity_contact_framework::input::Source;
use asperity_experiment::Experiment;
use peak_alloc::PeakAlloc;

/// Counts the bytes on the heap of the whole program.
#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// The largest input that is fuzzed, bytes.
pub const MOST_BYTES: usize = 1 << 20;
/// The most time for so many bytes, and for fewer.
const MOST_TIME: Duration = Duration::from_secs(2);
/// The most memory for an input: so many bytes, and so many for each point or row that is read.
const MOST_MEMORY: usize = 64_000_000;
const MOST_PER_POINT: usize = 32;
/// The most points for a byte of a packed file that is refused.
const MOST_PACKED: usize = 200;
/// The most letters of a message.
const MOST_LETTERS: usize = 4000;
/// Times that an input is tried before its time counts: the machine may have been busy.
const TRIES: usize = 3;

/// What an input is given to.
enum Body {
    /// The reader of maps: points read. The function makes the bytes a file of one format.
    Map(fn(&[u8]) -> Vec<u8>),
    List,
    Quantity,
    Spec,
}

/// A part of the program that reads bytes of strangers.
pub struct Target {
    pub name: &'static str,
    body: Body,
}

/// All targets.
pub const TARGETS: [Target; 26] = [
    Target::map("any", <[u8]>::to_vec),
    Target::map("al3d", |bytes| prepare::begin(bytes, b"AliconaImaging\0\r\n")),
    Target::map("bcr", prepare::bcr),
    Target::map("datx", |bytes| prepare::begin(bytes, b"\x89HDF\r\n\x1a\n")),
    Target::map("gsf", |bytes| prepare::begin(bytes, b"Gwyddion Simple Field ")),
    Target::map("gwy", |bytes| prepare::begin(bytes, b"GWYP")),
    Target::map("ibw", prepare::ibw),
    Target::map("jpk", prepare::tiff),
    Target::map("metropro", prepare::metropro),
    Target::map("nanoscope", |bytes| prepare::begin(bytes, b"\\*File list\r\n")),
    Target::map("nid", |bytes| prepare::begin(bytes, b"[DataSet]")),
    Target::map("npy", |bytes| prepare::begin(bytes, b"\x93NUMPY")),
    Target::map("opd", |bytes| prepare::begin(bytes, b"\x01\0Directory\0")),
    Target::map("park", prepare::tiff),
    Target::map("plu", |bytes| prepare::begin(bytes, b"Mon Apr 19 11:40:13 2021\0")),
    Target::map("sdf", prepare::sdf),
    Target::map("sur", prepare::sur),
    Target::map("text", prepare::text),
    Target::map("vk", prepare::vk),
    Target::map("vk_packed", prepare::vk_packed),
    Target::map("x3p", |bytes| prepare::begin(bytes, b"PK\x03\x04")),
    Target::map("x3p_packed", prepare::x3p_packed),
    Target { name: "list", body: Body::List },
    Target { name: "list_npy", body: Body::List },
    Target { name: "quantity", body: Body::Quantity },
    Target { name: "spec", body: Body::Spec },
];

/// What an input took.
#[derive(Debug, Clone, Copy, Default)]
pub struct Taken {
    /// Points or rows that were read; none of an input that was refused.
    pub points: usize,
    pub time: Duration,
    /// Bytes of memory at the peak.
    pub memory: usize,
}

/// A folder of a target's own, in memory where there is one.
pub struct Place {
    folder: tempfile::TempDir,
    file: PathBuf,
}

impl Place {
    pub fn new() -> Self {
        let shared = Path::new("/dev/shm");
        let within = if shared.is_dir() { shared.to_owned() } else { std::env::temp_dir() };
        let folder = tempfile::tempdir_in(within).expect("a folder can be made");
        // Files that specs may name.
        std::fs::write(folder.path().join("list.csv"), "height [um]; radius [um]\n1; 20\n1.1; 21\n1.3; 19\n")
            .expect("a file can be written");
        let line =
            |y: u32| (0..9).map(|x| ((x * 7 + y * y * 3) % 11).to_string() + " ").collect::<String>() + "\n";
        std::fs::write(folder.path().join("map.txt"), (0..8).map(line).collect::<String>())
            .expect("a file can be written");
        let file = folder.path().join("input");
        Self { folder, file }
    }
}

impl Target {
    const fn map(name: &'static str, prepare: fn(&[u8]) -> Vec<u8>) -> Self {
        Self { name, body: Body::Map(prepare) }
    }

    /// Runs an input, which must keep the limits of time and memory.
    pub fn check(&self, place: &Place, bytes: &[u8]) -> Taken {
        let mut taken = self.run(place, bytes);
        let most_time = MOST_TIME * bytes.len().div_ceil(MOST_BYTES).max(1) as u32;
        for _ in 1..TRIES {
            if taken.time > most_time {
                taken.time = taken.time.min(self.run(place, bytes).time);
            }
        }
        let allowed = MOST_MEMORY + MOST_PER_POINT * taken.points;
        assert!(
            taken.memory <= allowed,
            "{}: {} bytes of memory for {} points of {} bytes; allowed: {allowed}",
            self.name,
            taken.memory,
            taken.points,
            bytes.len()
        );
        assert!(
            taken.time <= most_time,
            "{}: {:?} for {} bytes; allowed: {most_time:?}",
            self.name,
            taken.time,
            bytes.len()
        );
        taken
    }

    fn run(&self, place: &Place, bytes: &[u8]) -> Taken {
        match &self.body {
            Body::Map(prepare) => {
                std::fs::write(&place.file, prepare(bytes)).expect("an input can be written");
                measured(|clock| map(clock, &place.file))
            }
            Body::List => {
                std::fs::write(&place.file, bytes).expect("an input can be written");
                measured(|clock| list(clock, &place.file))
            }
            Body::Quantity => measured(|clock| quantity(clock, bytes)),
            Body::Spec => measured(|clock| spec(clock, place.folder.path(), bytes)),
        }
    }
}

/// Runs a function that says how many points it read, and how long the longest of its steps took.
fn measured(run: impl FnOnce(&mut Clock) -> usize) -> Taken {
    HEAP.reset_peak_usage();
    let before = HEAP.current_usage();
    let mut clock = Clock { longest: Duration::ZERO };
    let points = run(&mut clock);
    Taken { points, time: clock.longest, memory: HEAP.peak_usage().saturating_sub(before) }
}

/// Times the steps of a run, each of which a user waits for.
struct Clock {
    longest: Duration,
}

impl Clock {
    fn step<T>(&mut self, step: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = step();
        self.longest = self.longest.max(start.elapsed());
        result
    }
}

/// An error is a text that a person can read.
fn refused(error: impl fmt::Display) -> usize {
    let text = error.to_string();
    assert!(!text.trim().is_empty(), "an error without a text");
    assert!(text.chars().count() <= MOST_LETTERS, "an error of {} letters: {text:.400}", text.len());
    assert!(!text.contains(|c: char| c.is_control() && !"\n\t".contains(c)), "{text:?}");
    0
}

/// Reads the map of a file, with a pixel where it states none, and another channel, if it has one: its header and its map have the same
/// size, heights are finite or missing, and reading by rows gives the same.
fn map(clock: &mut Clock, path: &Path) -> usize {
    let mut file = MapFile::new(path, ReadOptions::default());
    let head = match clock.step(|| file.metadata()) {
        Ok(head) => head,
        Err(error) => return refused(error),
    };
    if head.pixel.is_none() {
        file.options.pixel = Some([1e-6; 2]);
    }
    // A refused file whose header fits its length holds the points of its header, packed at most as far as heights may be.
    let length = std::fs::metadata(path).map_or(0, |found| found.len() as usize);
    let claimed = head.points[0].saturating_mul(head.points[1]).min(MOST_PACKED * length);
    let points = match clock.step(|| file.height_map()) {
        Ok(map) => {
            assert_eq!(map.points(), head.points);
            assert!(
                map.offset().is_finite() && map.pixel().iter().all(|size| size.is_finite() && *size > 0.0)
            );
            assert!(map.heights().iter().all(|z| z.is_nan() || z.is_finite()));
            map.heights().len()
        }
        Err(error) => refused(error),
    };
    // By rows only a map that stays on disk is read otherwise.
    if file.stays_on_disk().is_ok_and(|stays| stays) {
        let by_rows =
            clock.step(|| file.rows(&Silent)).map_or_else(refused, |rows| rows.points().iter().product());
        assert_eq!(by_rows, points);
    }
    let points = if points == 0 { claimed } else { points };
    if let Some(other) = head.channel.and_then(|channel| channel.others.into_iter().next()) {
        file.channel = Some(other.name);
        file.transpose = true;
        let others = clock.step(|| file.height_map()).map_or_else(refused, |map| map.heights().len());
        return points.max(others);
    }
    points
}

/// Reads a list: whole and by its check alike, as spheres and as ellipses.
fn list(clock: &mut Clock, path: &Path) -> usize {
    let mut both = |as_ellipses: bool, unit: Option<f64>| {
        let options = ListOptions { as_ellipses, unit };
        let checked = clock.step(|| AsperityList::check(path, options, &Silent));
        match clock.step(|| AsperityList::read(path, options, &Silent)) {
            Ok(list) => {
                assert_eq!(checked.ok(), Some(list.count()));
                let count = list.count();
                list.set(1e-6).map_or_else(refused, |_| 1);
                count
            }
            Err(error) => {
                assert_eq!(checked.err().map(|error| error.to_string()), Some(error.to_string()));
                refused(error)
            }
        }
    };
    both(false, None).max(both(true, Some(1e-6)))
}

/// Parses a quantity in each dimension.
fn quantity(clock: &mut Clock, bytes: &[u8]) -> usize {
    let Ok(text) = std::str::from_utf8(bytes) else { return 0 };
    for dimension in Dimension::ALL {
        assert!(dimension.factor(text).is_none_or(|factor| factor.is_finite() && factor > 0.0), "{text}");
        assert!(
            dimension.documented_factor(text).is_none_or(|factor| dimension.factor(text) == Some(factor))
        );
        clock.step(|| dimension.parse(text));
    }
    0
}

/// Plans a spec; where it is refused, the message begins with its file.
fn spec(clock: &mut Clock, folder: &Path, bytes: &[u8]) -> usize {
    let Ok(text) = String::from_utf8(bytes.to_vec()) else { return 0 };
    let source = Source::in_memory(folder, text).confined_to(folder);
    match clock.step(|| Experiment::parse(source, "fuzzed")) {
        Ok(experiment) => {
            assert!(experiment.work() < u128::MAX && !experiment.stem().is_empty());
            let _ = experiment.input();
        }
        Err(error) => {
            let words = error.to_string();
            assert!(words.starts_with(&*folder.to_string_lossy()), "{words:.400}");
            return refused(words);
        }
    }
    0
}
