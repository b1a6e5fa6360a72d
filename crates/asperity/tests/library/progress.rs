//! Progress of long tasks: each sign of it is for a bounded amount of work, and a task that is ended at any of them leaves nothing behind.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::files::array;
use crate::formats::{instrument::stored, sdf::Sdf};
use asperity::progress::{PIECE, Progress, Silent};
use asperity::topography::read::{LengthUnits, MapFile, ReadOptions};
use asperity::topography::write::MapFormat;
use asperity::topography::{Boundary, HeightMap, RoughnessParameters, Rows, Watched};
use asperity::{AsperityList, ListOptions, npy};

/// Formats that are written.
const ENDINGS: [&str; 4] = ["gwy", "x3p", "xyz", "npy"];

/// Points of a map along x and y: two pieces of them.
const POINTS: [usize; 2] = [1600, 1320];

/// The largest part of the work of reading that one pass over the heights is: that of parsing a text.
const LARGEST_PASS: f64 = 0.6;

/// Work, sign by sign; it is ended from a sign on, if one is given.
#[derive(Default)]
struct Signs {
    work: Mutex<Vec<f64>>,
    count: AtomicUsize,
    last: Option<usize>,
}

/// Carried by the unwinding of work that is ended.
struct Ended;

/// The work of a task.
fn work(task: impl FnOnce(&Signs)) -> Vec<f64> {
    let signs = Signs::default();
    task(&signs);
    signs.work.into_inner().unwrap()
}

/// Ends a task at a sign of its work; the number of signs from that one on.
fn signs_after(last: usize, task: impl FnOnce(&Signs)) -> usize {
    let signs = Signs { last: Some(last), ..Signs::default() };
    let cause = catch_unwind(AssertUnwindSafe(|| task(&signs))).unwrap_err();
    assert!(cause.is::<Ended>());
    signs.count.into_inner() - last
}

impl Progress for Signs {
    fn advance(&self, work: f64) {
        self.work.lock().unwrap().push(work);
        let count = self.count.fetch_add(1, Ordering::Relaxed);
        if self.last.is_some_and(|last| count >= last) {
            resume_unwind(Box::new(Ended));
        }
    }
}

/// A wave and noise of a few nanometres.
fn map() -> HeightMap {
    let mut state = 7u64;
    let height = |k: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        1e-9 * ((k % POINTS[1]) as f64 / 40.0).sin() + 1e-9 * (state >> 40) as f64 / (1u64 << 24) as f64
    };
    HeightMap::new(POINTS, [1e-6; 2], (0..POINTS[0] * POINTS[1]).map(height).collect(), 0.0).unwrap()
}

/// The map in a file of each way in which readers go through one.
fn files(folder: &Path) -> Vec<PathBuf> {
    let map = map();
    let [nx, ny] = POINTS;
    let along_x = || (0..nx * ny).map(|k| map.heights()[k % nx * ny + k / nx]);
    let numbers = |factor: f64| stored::<f64>(along_x().map(|z| factor * z), false);
    let words: Vec<String> = along_x().map(|z| format!("{:.3}", 1e9 * z)).collect();
    let lines: String = words.chunks(nx).map(|line| line.join(" ") + "\n").collect();
    let sdf = Sdf { size: [nx as u32, ny as u32], scales: [1e-6, 1e-6, 1e-9], ..Sdf::of("ISO-1.0", 7) };
    for (name, content) in [
        ("map.txt", lines.clone().into_bytes()),
        // A micro sign in Latin-1, by which a text is no UTF-8.
        ("latin.txt", [&b"# \xb5m\n"[..], lines.as_bytes()].concat()),
        ("text.sdf", sdf.text(&lines).into_bytes()),
        ("binary.sdf", sdf.binary(&numbers(1e9))),
        ("fortran.npy", array("<f8", true, &format!("({nx}, {ny})"), &numbers(1.0))),
    ] {
        std::fs::write(folder.join(name), content).unwrap();
    }
    for ending in ENDINGS {
        let format = MapFormat::of_ending(ending).unwrap();
        format.write_file(&folder.join(format!("map.{ending}")), &map, &[]).unwrap();
    }
    std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect()
}

fn reader(path: &Path) -> MapFile {
    let name = path.file_name().unwrap().to_string_lossy();
    let nanometres = Some(LengthUnits::same(1e-9));
    let (pixel, unit) = match &*name {
        "map.txt" | "latin.txt" => (Some([1e-6; 2]), nanometres),
        "map.npy" | "fortran.npy" => (Some([1e-6; 2]), None),
        _ => (None, None),
    };
    MapFile::new(path, ReadOptions { pixel, unit })
}

#[test]
fn readers_tell_of_their_work_piece_by_piece_and_can_be_ended_at_each() {
    let folder = tempfile::tempdir().unwrap();
    let points = (POINTS[0] * POINTS[1]) as f64;
    let map = map();
    for path in files(folder.path()) {
        let file = reader(&path);
        let work = work(|signs| assert_eq!(file.rows(signs).unwrap().points(), POINTS, "{path:?}"));
        let whole: f64 = work.iter().sum();
        assert!((0.97..1.03).contains(&whole), "{path:?}: {whole}");
        let largest = work.iter().fold(0.0f64, |a, &b| a.max(b));
        // Bytes of a text are more than points, so that their pieces are smaller parts.
        assert!(largest <= LARGEST_PASS * PIECE as f64 / points, "{path:?}: {largest} of {work:?}");
        for last in [0, work.len() / 3, work.len() / 2, work.len() - 1] {
            let after = signs_after(last, |signs| drop(file.rows(signs)));
            // Strips of a map on disk are read in parallel, each of which ends at its own sign.
            assert!(path.ends_with("map.npy") || after == 1, "{path:?}: {after} signs after it was ended");
        }
        // Pieces do not show in the heights, of which a text has three decimals of a nanometre.
        let found = file.height_map().unwrap();
        let error = map.heights().iter().zip(found.heights()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 0.51e-12, "{path:?}: {error:e}");
    }
}

/// A map that counts the rows that are read of it.
struct Counted<'a> {
    map: &'a HeightMap,
    rows: AtomicUsize,
}

impl Rows for Counted<'_> {
    fn points(&self) -> [usize; 2] {
        self.map.points()
    }

    fn pixel(&self) -> [f64; 2] {
        self.map.pixel()
    }

    fn precision(&self) -> f64 {
        self.map.precision()
    }

    fn boundary(&self) -> Boundary {
        self.map.boundary()
    }

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.rows.fetch_add(1, Ordering::Relaxed);
        self.map.read(ix, row);
    }
}

/// Tasks that have not begun when another one ends still begin: each looks before it works.
#[test]
fn a_parallel_pass_that_is_ended_does_no_more_work() {
    const STRIP: usize = 32;
    let map =
        HeightMap::new([3000, 40], [1e-6; 2], (0..120_000).map(|k| 1e-9 * f64::from(k % 11)).collect(), 0.0)
            .unwrap();
    let passes: [fn(&dyn Rows); 2] = [
        |map| {
            RoughnessParameters::new(map);
        },
        |map| {
            HeightMap::from_rows(map);
        },
    ];
    for pass in passes {
        let counted = Counted { map: &map, rows: AtomicUsize::new(0) };
        signs_after(0, |signs| pass(&Watched { map: &counted, progress: signs }));
        // A strip of each thread with a row beside it on both sides.
        let most = rayon::current_num_threads() * (STRIP + 2);
        let rows = counted.rows.into_inner();
        assert!(rows <= most, "{rows} rows were read, {most} at most are under way");
    }
}

#[test]
fn lists_tell_of_their_work_piece_by_piece() {
    const COUNT: usize = 150_000;
    let folder = tempfile::tempdir().unwrap();
    let [text, array] = ["list.csv", "list.npy"].map(|name| folder.path().join(name));
    let row = |k: usize| [1e-9 * (k % 977) as f64, 1e-5 + 1e-9 * (k % 31) as f64];
    let lines: String = (0..COUNT).map(|k| format!("{:e},{:e}\n", row(k)[0], row(k)[1])).collect();
    let text_length = lines.len();
    std::fs::write(&text, "height,radius\n".to_owned() + &lines).unwrap();
    npy::write(std::fs::File::create(&array).unwrap(), [COUNT, 2], (0..COUNT).flat_map(row)).unwrap();
    for (path, most) in [(&text, PIECE as f64 / text_length as f64), (&array, 0.1)] {
        type Task = fn(&Path, &dyn Progress) -> usize;
        let read: Task =
            |path, progress| AsperityList::read(path, ListOptions::default(), progress).unwrap().count();
        let check: Task =
            |path, progress| AsperityList::check(path, ListOptions::default(), progress).unwrap();
        for task in [read, check] {
            let work = work(|signs| assert_eq!(task(path, signs), COUNT));
            let whole: f64 = work.iter().sum();
            assert!(
                (whole - 1.0).abs() < 1e-9 && work.len() > 2,
                "{path:?}: {whole} in {} signs",
                work.len()
            );
            assert!(work.iter().all(|&work| work <= 1.001 * most), "{path:?}: {work:?}");
            signs_after(work.len() / 2, |signs| assert_eq!(task(path, signs), COUNT));
        }
    }
}

/// The old file stays, or none is there, and nothing beside it.
#[test]
fn a_file_that_is_no_longer_wanted_is_not_left_half_written() {
    let folder = tempfile::tempdir().unwrap();
    let map =
        HeightMap::new([64, 48], [1e-6; 2], (0..64 * 48).map(|k| 1e-9 * f64::from(k % 7)).collect(), 0.0)
            .unwrap();
    let names = || {
        let entries = std::fs::read_dir(folder.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
    };
    for ending in ENDINGS {
        let format = MapFormat::of_ending(ending).unwrap();
        let path = folder.path().join(format!("map.{ending}"));
        let write = |progress: &dyn Progress| format.write_file(&path, &Watched { map: &map, progress }, &[]);
        signs_after(20, |signs| write(signs).unwrap());
        assert_eq!(names(), Vec::<String>::new(), "{ending}");
        let work = work(|signs| write(signs).unwrap());
        let whole: f64 = work.iter().sum();
        assert!((whole - 1.0).abs() < 1e-9 && work.len() >= 48, "{ending}: {whole} in {} signs", work.len());
        let old = std::fs::read(&path).unwrap();
        signs_after(47, |signs| write(signs).unwrap());
        assert_eq!(names(), [format!("map.{ending}")]);
        assert_eq!(std::fs::read(&path).unwrap(), old);
        std::fs::remove_file(&path).unwrap();
        write(&Silent).unwrap();
        std::fs::remove_file(&path).unwrap();
    }
}
