//! The targets of fuzzing on the stable compiler: every input of the corpus, every sample and spec of the repository, and a fixed number of
//! changes to them. CONTRIBUTING.md says how to run more of them, and how to run libFuzzer.

mod large;
mod mutate;
#[path = "../specs/mod.rs"]
mod specs;
mod targets;

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use specs::BadSpec;
use targets::{MOST_BYTES, Place, TARGETS, Taken, Target};

/// Changed inputs a target; more by the environment variable `FUZZ_RUNS`.
const RUNS: usize = 8000;
/// After so long an input is called one that hangs.
const HANG: Duration = Duration::from_secs(60);

/// Folders of inputs besides the corpus, and the endings of names in them.
fn folders(target: &Target) -> (&[&str], &[&str]) {
    const FORMATS: &[&str] =
        &["crates/asperity/tests/library/formats/samples", "crates/asperity/tests/library/formats"];
    const DATA: &[&str] = &["tests/specs/data"];
    match target.name {
        "bcr" => (FORMATS, &["bcrf"]),
        "metropro" => (FORMATS, &["dat"]),
        "nanoscope" => (FORMATS, &["spm"]),
        "park" => (FORMATS, &["tiff"]),
        "npy" | "list_npy" => (DATA, &["npy"]),
        "text" => (DATA, &["txt", "csv"]),
        "list" => (DATA, &["csv"]),
        "spec" => (&["experiments", "src"], &["toml"]),
        _ => (FORMATS, std::slice::from_ref(&target.name)),
    }
}

/// All inputs of a target that are in the repository, by their paths.
fn inputs(target: &Target) -> Vec<(PathBuf, Vec<u8>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (others, endings) = folders(target);
    let corpus = root.join("tests/fuzz/corpus").join(target.name);
    let is_wanted =
        |path: &Path| path.extension().is_some_and(|ending| endings.iter().any(|wanted| ending == *wanted));
    let files = |folder: PathBuf| {
        let entries =
            std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file()).collect::<Vec<_>>()
    };
    let samples = others.iter().flat_map(|folder| files(root.join(folder))).filter(|path| is_wanted(path));
    let mut all: Vec<PathBuf> = files(corpus).into_iter().chain(samples).collect();
    all.sort();
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).unwrap();
        (path, bytes)
    };
    let mut inputs: Vec<_> = all.into_iter().map(read).collect();
    if target.name == "spec" {
        let text = std::fs::read_to_string(root.join("tests/specs/bad.txt")).unwrap();
        inputs.extend(BadSpec::all(&text).map(|bad| (bad.name.into(), bad.spec().into_bytes())));
    }
    inputs.retain(|(_, bytes)| bytes.len() <= MOST_BYTES);
    inputs
}

/// Runs inputs of a target, each in the file that a failure names.
struct Runner {
    place: Place,
    target: &'static Target,
    most: Taken,
    count: usize,
}

impl Runner {
    fn run(&mut self, name: &str, bytes: &[u8]) {
        let check = || self.target.check(&self.place, bytes);
        let taken = std::panic::catch_unwind(std::panic::AssertUnwindSafe(check)).unwrap_or_else(|_| {
            let kept = std::env::temp_dir().join(format!("failed-{}", self.target.name));
            std::fs::write(&kept, bytes).unwrap();
            panic!("{} fails at {name}, which is now {}", self.target.name, kept.display());
        });
        self.most.time = self.most.time.max(taken.time);
        self.most.memory = self.most.memory.max(taken.memory);
        self.count += 1;
    }
}

/// Memory is counted for the whole program, so that one test runs at a time.
static ALONE: Mutex<()> = Mutex::new(());

#[test]
fn a_large_file_takes_no_more_memory_than_its_points() {
    let _alone = ALONE.lock();
    for (name, file) in large::FILES {
        let target = TARGETS.iter().find(|target| target.name == name).expect("the name of a target");
        let file = file();
        let taken = target.check(&Place::new(), &file);
        assert_eq!(taken.points, large::POINTS[0] * large::POINTS[1]);
        let each = |bytes: usize| bytes as f64 / taken.points as f64;
        println!("{name:5} {:.1} bytes a point of {:.1} in the file", each(taken.memory), each(file.len()));
    }
}

#[test]
fn no_input_panics_hangs_or_takes_much_memory() {
    let _alone = ALONE.lock();
    let runs = std::env::var("FUZZ_RUNS").map_or(RUNS, |runs| runs.parse().expect("a number of runs"));
    let only = std::env::var("FUZZ_TARGET").ok();
    for (number, target) in
        (0..).zip(&TARGETS).filter(|(_, target)| only.as_deref().is_none_or(|only| only == target.name))
    {
        let start = Instant::now();
        let inputs = inputs(target);
        assert!(!inputs.is_empty(), "{} has no input", target.name);
        let mut runner = Runner { place: Place::new(), target, most: Taken::default(), count: 0 };
        for (path, bytes) in &inputs {
            runner.run(&path.display().to_string(), bytes);
        }
        let mut rng = ChaCha8Rng::seed_from_u64(number);
        for run in 0..runs {
            runner.run(&format!("run {run}"), &mutate::changed(&inputs, &mut rng));
        }
        assert!(
            start.elapsed() < HANG + runs as u32 * Duration::from_millis(20),
            "{} takes {:?}",
            target.name,
            start.elapsed()
        );
        println!(
            "{:10} {:7} inputs in {:5.1} s; at most {:6.1} ms and {:5.1} MB",
            target.name,
            runner.count,
            start.elapsed().as_secs_f64(),
            1e3 * runner.most.time.as_secs_f64(),
            1e-6 * runner.most.memory as f64
        );
    }
}
