//! Progress of long tasks: each sign of it is for a bounded amount of work, and a task that is ended at any of them leaves nothing behind.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use asperity::progress::{PIECE, Progress, Silent};
use asperity::topography::read::{LengthUnits, MapFile, ReadOptions};
use asperity::topography::write::MapFormat;
use asperity::topography::{Boundary, HeightMap, RoughnessParameters, Rows, Watched};
use asperity::{AsperityList, ListOptions, npy};

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

impl Signs {
    fn ended_at(last: usize) -> Self {
        Self { last: Some(last), ..Self::default() }
    }
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
    let heights = map.heights();
    let [nx, ny] = POINTS;
    for ending in ["gwy", "x3p", "xyz"] {
        let format = MapFormat::of_ending(ending).unwrap();
        format.write_file(&folder.join(format!("map.{ending}")), &map, &[]).unwrap();
    }
    let mut lines = String::new();
    for iy in 0..ny {
        let words: Vec<String> = (0..nx).map(|ix| format!("{:.3}", 1e9 * heights[ix * ny + iy])).collect();
        lines += &(words.join(" ") + "\n");
    }
    let head = |kind: char| {
        format!(
            "{kind}ISO-1.0\nNumPoints = {nx}\nNumProfiles = {ny}\nXscale = 1e-6\nYscale = 1e-6\nZscale = 1e-9\nZresolution = 1e-12\n\
             Compression = 0\nDataType = 7\nCheckType = 0\n*\n"
        )
    };
    let write = |name: &str, content: &[u8]| std::fs::write(folder.join(name), content).unwrap();
    write("map.txt", lines.as_bytes());
    // A micro sign in Latin-1, by which a text is no UTF-8.
    write("latin.txt", &[&b"# \xb5m\n"[..], lines.as_bytes()].concat());
    write("text.sdf", (head('a') + &lines + "*\n").as_bytes());
    let mut binary = b"bISO-1.0".to_vec();
    binary.resize(42, b' ');
    binary.extend([nx, ny].iter().flat_map(|count| (*count as u16).to_le_bytes()));
    binary.extend([1e-6f64, 1e-6, 1e-9, 1e-12].iter().flat_map(|scale| scale.to_le_bytes()));
    binary.extend([0, 7, 0]);
    let lines = (0..ny).flat_map(|iy| (0..nx).map(move |ix| ix * ny + iy));
    binary.extend(lines.flat_map(|k| (1e9 * heights[k]).to_le_bytes()));
    write("binary.sdf", &binary);
    let mut fortran = Vec::new();
    npy::write(&mut fortran, [ny, nx], (0..nx * ny).map(|k| heights[k % nx * ny + k / nx])).unwrap();
    let swapped = String::from_utf8_lossy(&fortran[..128]).into_owned();
    assert!(swapped.contains("False") && swapped.contains(&format!("({ny}, {nx})")), "{swapped}");
    // As long as it was.
    let at = |text: &[u8]| fortran.windows(text.len()).position(|window| window == text).unwrap();
    let (order, shape) = (at(b"False"), at(format!("({ny}, {nx})").as_bytes()));
    fortran[order..order + 5].copy_from_slice(b"True ");
    fortran[shape..shape + 12].copy_from_slice(format!("({nx}, {ny})").as_bytes());
    write("fortran.npy", &fortran);
    map.write_npy(&folder.join("map.npy")).unwrap();
    [
        "map.gwy",
        "map.x3p",
        "map.xyz",
        "map.txt",
        "latin.txt",
        "text.sdf",
        "binary.sdf",
        "fortran.npy",
        "map.npy",
    ]
    .map(|name| folder.join(name))
    .to_vec()
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
    for path in files(folder.path()) {
        let file = reader(&path);
        let signs = Signs::default();
        let rows = file.rows(&signs).unwrap();
        assert_eq!(rows.points(), POINTS, "{path:?}");
        let work = signs.work.into_inner().unwrap();
        let whole: f64 = work.iter().sum();
        assert!((0.97..1.03).contains(&whole), "{path:?}: {whole}");
        let largest = work.iter().fold(0.0f64, |a, &b| a.max(b));
        // Bytes of a text are more than points, so that their pieces are smaller parts.
        assert!(largest <= LARGEST_PASS * PIECE as f64 / points, "{path:?}: {largest} of {work:?}");
        for last in [0, work.len() / 3, work.len() / 2, work.len() - 1] {
            let signs = Signs::ended_at(last);
            let cause = catch_unwind(AssertUnwindSafe(|| file.rows(&signs).map(drop))).unwrap_err();
            assert!(cause.is::<Ended>(), "{path:?}: {last}");
            // Strips of a map on disk are read in parallel, each of which ends at its own sign.
            let after = signs.count.into_inner() - last;
            assert!(path.ends_with("map.npy") || after == 1, "{path:?}: {after} signs after it was ended");
        }
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
        let signs = Signs::ended_at(0);
        let watched = Watched { map: &counted, progress: &signs };
        let cause = catch_unwind(AssertUnwindSafe(|| pass(&watched))).unwrap_err();
        assert!(cause.is::<Ended>());
        // A strip of each thread with a row beside it on both sides.
        let most = rayon::current_num_threads() * (STRIP + 2);
        let rows = counted.rows.into_inner();
        assert!(rows <= most, "{rows} rows were read, {most} at most are under way");
    }
}

/// Their heights are those of the map, whatever pieces they were read in.
#[test]
fn pieces_do_not_show_in_the_heights() {
    let folder = tempfile::tempdir().unwrap();
    let map = map();
    for path in files(folder.path()) {
        let found = reader(&path).height_map().unwrap();
        let error = map.heights().iter().zip(found.heights()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Three decimals of a nanometre in a text.
        assert!(error < 0.51e-12, "{path:?}: {error:e}");
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
            let signs = Signs::default();
            assert_eq!(task(path, &signs), COUNT);
            let work = signs.work.into_inner().unwrap();
            let whole: f64 = work.iter().sum();
            assert!(
                (whole - 1.0).abs() < 1e-9 && work.len() > 2,
                "{path:?}: {whole} in {} signs",
                work.len()
            );
            assert!(work.iter().all(|&work| work <= 1.001 * most), "{path:?}: {work:?}");
            let ended = Signs::ended_at(work.len() / 2);
            let cause = catch_unwind(AssertUnwindSafe(|| task(path, &ended))).unwrap_err();
            assert!(cause.is::<Ended>(), "{path:?}");
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
    for ending in ["gwy", "x3p", "xyz", "npy"] {
        let format = MapFormat::of_ending(ending).unwrap();
        let path = folder.path().join(format!("map.{ending}"));
        let write = |progress: &dyn Progress| format.write_file(&path, &Watched { map: &map, progress }, &[]);
        let ended_at = |last: usize| {
            let signs = Signs::ended_at(last);
            let cause = catch_unwind(AssertUnwindSafe(|| write(&signs).unwrap())).unwrap_err();
            assert!(cause.is::<Ended>(), "{ending}");
        };
        ended_at(20);
        assert_eq!(names(), Vec::<String>::new(), "{ending}");
        let signs = Signs::default();
        write(&signs).unwrap();
        let work = signs.work.into_inner().unwrap();
        let whole: f64 = work.iter().sum();
        assert!((whole - 1.0).abs() < 1e-9 && work.len() >= 48, "{ending}: {whole} in {} signs", work.len());
        let old = std::fs::read(&path).unwrap();
        ended_at(47);
        assert_eq!(names(), [format!("map.{ending}")]);
        assert_eq!(std::fs::read(&path).unwrap(), old);
        std::fs::remove_file(&path).unwrap();
        write(&Silent).unwrap();
        std::fs::remove_file(&path).unwrap();
    }
}
