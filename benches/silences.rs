//! Runs specs and prints the longest times between two signs of progress, per stage: `silences SPEC...`.

use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use asperity_contact_framework::folder as report_folder;
use asperity_contact_framework::progress::Progress;
use asperity_experiment::Experiment;

/// Notes when each sign of progress comes.
struct Recorder(Mutex<Record>);

struct Record {
    stage: String,
    last: Instant,
    /// Of each stage, in order of first appearance: its longest silence, its duration and its signs.
    stages: Vec<(String, Duration, Duration, u64)>,
}

impl Recorder {
    fn new() -> Self {
        Self(Mutex::new(Record { stage: "start".to_owned(), last: Instant::now(), stages: Vec::new() }))
    }

    fn record(&self) -> MutexGuard<'_, Record> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn sign(&self, next: Option<&str>) {
        let mut record = self.record();
        let silence = record.last.elapsed();
        record.last = Instant::now();
        let stage = record.stage.clone();
        match record.stages.iter_mut().find(|(name, ..)| *name == stage) {
            Some((_, longest, sum, signs)) => {
                *longest = silence.max(*longest);
                *sum += silence;
                *signs += 1;
            }
            None => record.stages.push((stage, silence, silence, 1)),
        }
        if let Some(next) = next {
            next.clone_into(&mut record.stage);
        }
    }
}

impl Progress for Recorder {
    fn step(&self) {
        self.sign(None);
    }

    fn stage(&self, name: &str, _: f64) {
        self.sign(Some(name));
    }

    fn advance(&self, _: f64) {
        self.sign(None);
    }
}

fn main() {
    for path in std::env::args().skip(1) {
        let recorder = Recorder::new();
        let phase = |name: &str| recorder.sign(Some(name));
        phase("plan");
        let experiment = match Experiment::watched_read(Path::new(&path), &recorder) {
            Ok(experiment) => experiment,
            Err(error) => {
                println!("{path}: {error}");
                continue;
            }
        };
        phase("hash of input files");
        let key = experiment.watched_key(&recorder);
        phase("run");
        let results = experiment.run(&recorder);
        phase("pages and tables");
        match (key, results) {
            (Ok(key), Ok(results)) => drop(report_folder(&*results, &key).map(|r| r.names().count())),
            (_, Err(error)) => println!("{path}: {error}"),
            (Err(error), _) => println!("{path}: {error}"),
        }
        phase("end");
        for (name, longest, sum, signs) in &recorder.record().stages {
            println!("{path}\t{name}\t{:.3}\t{:.3}\t{signs}", longest.as_secs_f64(), sum.as_secs_f64());
        }
    }
}
