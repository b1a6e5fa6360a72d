//! Progress of a whole run: its parts show their own stages, and it ends where it is no longer wanted.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use asperity_contact_framework::progress::Progress;
use asperity_experiment::Experiment;

use crate::results::{ON_STEEL, waves, write_map};

const SIDE: usize = 320;

/// Stages with their signs, in order; the run is ended from a sign on, if one is given.
#[derive(Default)]
struct Stages {
    all: Mutex<Vec<(String, usize)>>,
    signs: AtomicUsize,
    last: Option<usize>,
}

/// Carried by the unwinding of a run that is ended.
struct Ended;

impl Stages {
    fn sign(&self) {
        let count = self.signs.fetch_add(1, Ordering::Relaxed);
        if self.last.is_some_and(|last| count >= last) {
            resume_unwind(Box::new(Ended));
        }
    }

    /// Signs of the stages whose name begins so and goes on.
    fn signs_within(&self, beginning: &str) -> usize {
        let all = self.all.lock().unwrap();
        all.iter().filter(|(name, _)| name.starts_with(beginning)).map(|(_, signs)| signs).sum()
    }
}

impl Progress for Stages {
    fn stage(&self, name: &str, _: f64) {
        self.all.lock().unwrap().push((name.to_owned(), 0));
        self.sign();
    }

    fn advance(&self, _: f64) {
        if let Some((_, signs)) = self.all.lock().unwrap().last_mut() {
            *signs += 1;
        }
        self.sign();
    }
}

/// A comparison on a measured map, as text, with everything that follows from it.
fn spec(folder: &Path) -> PathBuf {
    let heights = waves(SIDE, [16.0, 5.0], 9);
    write_map(folder.join("map.npy"), [SIDE; 2], |i, j| heights[i * SIDE + j]);
    let text = format!(
        "{ON_STEEL}pressure = {{ from = \"1 MPa\", to = \"40 MPa\", points = 3 }}\n\
         [surface.a.file]\npath = \"map.npy\"\npixel = \"1 um\"\n"
    );
    let path = folder.join("progress.toml");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn treatments_show_their_stages_and_a_run_ends_in_each_of_its_parts() {
    let folder = tempfile::tempdir().unwrap();
    let experiment = Experiment::read(&spec(folder.path())).unwrap();
    let stages = Stages::default();
    drop(experiment.run(&stages).unwrap());
    let names: Vec<String> = stages.all.lock().unwrap().iter().map(|(name, _)| name.clone()).collect();
    let treatment = |number: usize, of: &str| {
        names.iter().any(|name| name.starts_with(&format!("robustness, {number} of ")) && name.ends_with(of))
    };
    assert!(treatment(1, ": summits") && treatment(2, ": both models"), "{names:?}");
    // A strip of 32 rows each.
    assert!(stages.signs_within("robustness, 1 of ") > SIDE / 32, "{names:?}");
    for stage in [
        "reading",
        "correlation",
        "height steps and image",
        "fitness checks",
        "causes",
        "other statistical models",
    ] {
        assert!(stages.signs_within(stage) > 0, "{stage}: {names:?}");
    }
    let count = stages.signs.into_inner();
    for part in 0..10 {
        let stages = Stages { last: Some(part * count / 10), ..Stages::default() };
        let cause = catch_unwind(AssertUnwindSafe(|| experiment.run(&stages).map(drop))).unwrap_err();
        assert!(cause.is::<Ended>(), "{part}: {:?}", stages.all.lock().unwrap().last());
    }
}

#[test]
fn files_are_looked_through_and_compared_with_progress() {
    let folder = tempfile::tempdir().unwrap();
    let path = spec(folder.path());
    let stages = Stages::default();
    let experiment = Experiment::watched_read(&path, &stages).unwrap();
    assert_eq!(experiment.watched_key(&stages).unwrap(), experiment.key().unwrap());
    assert!(stages.signs_within("checking the file") + stages.signs_within("comparing files") > 0);
    for last in 0..stages.signs.into_inner() {
        let stages = Stages { last: Some(last), ..Stages::default() };
        let work = || Experiment::watched_read(&path, &stages)?.watched_key(&stages).map(drop);
        assert!(catch_unwind(AssertUnwindSafe(work)).unwrap_err().is::<Ended>());
    }
}
