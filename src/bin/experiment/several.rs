//! Several specs: their order, the place of each, what became of all, and their list.

use std::fmt;
use std::path::Path;

use asperity_contact_framework::input::InputError;
use asperity_contact_framework::report::store::{State, Store};
use asperity_experiment::terminal::words;
use asperity_experiment::{Experiment, LIBRARY};

/// Puts those first that take least: long ones last, each by the seconds of its last run, else by its work.
pub fn quick_first(experiments: &mut [Experiment], store: &Store) {
    // Of a micro-contact in a sum, on two cores.
    const SECONDS: f64 = 3e-9;
    let seconds = |experiment: &Experiment| {
        let estimate = SECONDS * experiment.work() as f64;
        store.seconds(experiment.stem()).unwrap_or(estimate)
    };
    let order = |experiment: &Experiment| (experiment.is_long(), seconds(experiment));
    experiments.sort_by(|a, b| {
        let ((a_long, a), (b_long, b)) = (order(a), order(b));
        a_long.cmp(&b_long).then(a.total_cmp(&b))
    });
}

/// The place of a spec in a run.
#[derive(Clone, Copy)]
pub struct Place {
    /// From 1.
    pub number: usize,
    /// How many there are.
    pub of: usize,
}

impl Place {
    pub const ALONE: Self = Self { number: 1, of: 1 };

    pub fn is_alone(self) -> bool {
        self.of == 1
    }
}

/// The beginning of a line; empty of a single spec.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.is_alone() { Ok(()) } else { write!(f, "{} of {}: ", self.number, self.of) }
    }
}

#[derive(Clone, Copy)]
pub enum Done {
    Written,
    /// Its report is that of the same spec, files and program.
    Unchanged,
    Failed,
}

/// Numbers of specs by what became of them.
#[derive(Default)]
pub struct Counts([usize; 3]);

impl Counts {
    pub fn add(&mut self, done: Done) {
        self.0[done as usize] += 1;
    }

    /// How many, where, and how to look at them.
    pub fn lines(&self, out: &Path) -> [String; 3] {
        let [written, unchanged, failed] = self.0;
        let opener = if cfg!(windows) {
            "start"
        } else if cfg!(target_os = "macos") {
            "open"
        } else {
            "xdg-open"
        };
        let all = written + unchanged + failed;
        [
            format!("{all} reports: {written} written, {unchanged} unchanged, {failed} failed"),
            format!("folder: {}", out.display()),
            format!("open the index: {opener} {}", out.join("index.html").display()),
        ]
    }
}

/// A line of a list: name, state of its report, of a long one what it took, title.
pub fn listed(experiment: &Experiment, store: &Store) -> Result<String, InputError> {
    let stem = experiment.stem();
    let state = store.state(stem, &experiment.key()?, &experiment.input()?);
    // A long report is not made again with each change of a page, but its numbers rest on the library.
    let is_older = || store.library(stem).is_none_or(|library| library != LIBRARY);
    let state = match state {
        State::UpToDate | State::ProgramChanged if experiment.is_long() && is_older() => "older library",
        State::ProgramChanged if experiment.is_long() => "up to date",
        State::UpToDate => "up to date",
        State::Missing => "to run",
        State::InputChanged => "input changed",
        State::ProgramChanged => "program changed",
        State::Edited => "edited",
    };
    let extent = match (experiment.is_long(), store.seconds(stem)) {
        (false, _) => String::new(),
        (true, Some(seconds)) => format!("long, {}", words(seconds)),
        (true, None) => "long, not run here".to_owned(),
    };
    Ok(format!("{stem:<28} {state:<15} {extent:<18} {}", experiment.title()))
}
