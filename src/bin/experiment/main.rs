//! The command line: arguments, progress, exit code; nothing else.

mod arguments;
mod export;
mod interrupt;
mod output;
#[cfg(feature = "serve")]
mod serve;
mod several;
mod surfaces;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use arguments::{Cli, Command, RunOptions};
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::progress::{Progress, Silent};
use asperity_contact_framework::report::store::{Folder, Store, StoreError};
use asperity_contact_framework::report::{Index, MARK, verify};
use asperity_contact_framework::{Outcome, ReportError, folder as report_folder};
use asperity_experiment::keys::{explain, spec_schema};
use asperity_experiment::kind::REPORTED;
use asperity_experiment::materials::{all_materials, one_material};
use asperity_experiment::terminal::Monitor;
use asperity_experiment::{Experiment, TEMPLATE, write_index};
use clap::{CommandFactory, Parser};
use output::{print, print_error, print_text, say, write_new};
use several::{Counts, Done, Place, listed, quick_first};
use surfaces::Answered;

const SPECS: &str = "experiments";

/// Folder of what long runs have done so far, in that of the reports.
const KEPT: &str = ".kept";

enum Failure {
    /// Invalid input: exit code 2.
    Input(String),
    /// A run failed: exit code 1.
    Run(String),
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::NotAFolder(_) | StoreError::LeadsNowhere { .. } => Self::Input(error.to_string()),
            _ => Self::Run(error.to_string()),
        }
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        Self::Run(error.to_string())
    }
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    if let Some(message) = arguments::misread(&words) {
        return Failure::Input(message).report();
    }
    let cli = Cli::parse();
    interrupt::handle();
    // A server has threads of its own for requests, and its first only waits for them.
    #[cfg(feature = "serve")]
    let waits = matches!(cli.command, Some(Command::Serve { .. }));
    #[cfg(not(feature = "serve"))]
    let waits = false;
    let outcome = set_threads(cli.threads, !waits).and_then(|()| perform(cli));
    let lost = |error| {
        Failure::Run(format!(
            "cannot write to the standard output: {error}; free some space or send it elsewhere"
        ))
    };
    match outcome.and_then(|()| output::lost().map_or(Ok(()), |error| Err(lost(error)))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Does what the command line says, on threads that are started.
fn perform(cli: Cli) -> Result<(), Failure> {
    match cli.command {
        None => specs_in(Path::new(SPECS)).and_then(|files| {
            let experiments = read_all(&files, cli.options.is_quiet())?;
            let is_run = |experiment: &Experiment| cli.full || !experiment.is_long();
            run(experiments.into_iter().filter(is_run).collect(), &cli.options)
        }),
        Some(Command::Run { files, options }) => {
            read_all(&files, options.is_quiet()).and_then(|experiments| run(experiments, &options))
        }
        Some(Command::List { out }) => list(&out),
        Some(Command::Check { files }) => check(&files),
        Some(Command::New { name }) => new(&name),
        Some(Command::Surface { files, arguments, name, save_spec, options }) => {
            surfaces::describe(&files, (*arguments).into(), name.as_deref(), save_spec.as_deref(), &options)
        }
        #[cfg(feature = "serve")]
        Some(Command::Serve { folder, port, no_open }) => serve::serve(&folder, port, no_open),
        Some(Command::Export { what }) => what.run(),
        Some(Command::Explain { name }) => {
            explain(&name).map_err(Failure::Input).map(|text| print_text(&text))
        }
        Some(Command::Schema) => {
            print(format_args!("{:#}", spec_schema()));
            Ok(())
        }
        Some(Command::Completions { shell }) => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "experiment", &mut script);
            print_text(&String::from_utf8_lossy(&script));
            Ok(())
        }
        Some(Command::Materials { name }) => materials(name.as_deref()),
        Some(Command::Verify { fresh, out }) => verify(&fresh, &out),
    }
}

impl Failure {
    fn message(&self) -> &str {
        match self {
            Self::Input(message) | Self::Run(message) => message,
        }
    }

    /// Prints the error and returns its exit code.
    fn report(self) -> ExitCode {
        match self {
            Self::Input(message) => {
                print_error(format_args!("error: {message}"));
                ExitCode::from(2)
            }
            Self::Run(message) => {
                print_error(format_args!("error: {message}"));
                ExitCode::FAILURE
            }
        }
    }
}

fn specs_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let unreadable = |error: std::io::Error| {
        Failure::Input(format!(
            "{}: {error}; allowed: a folder of specs here, or `experiment run FILE...`",
            folder.display()
        ))
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|ending| ending == "toml") {
            files.push(path);
        }
    }
    files.sort();
    if files.is_empty() {
        return Err(Failure::Input(format!("{}: found no .toml file", folder.display())));
    }
    Ok(files)
}

/// Reads all specs before anything runs: a single invalid one stops the run.
fn read_all(files: &[PathBuf], is_quiet: bool) -> Result<Vec<Experiment>, Failure> {
    let mut experiments: Vec<Experiment> = Vec::new();
    let mut errors = Vec::new();
    for file in files {
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        match watched(&name, is_quiet, |progress| Experiment::watched_read(file, progress)) {
            Ok(experiment) if experiments.iter().any(|other| other.stem() == experiment.stem()) => {
                errors.push(format!(
                    "{}: found a second file called {} in this run, which would write the same report; allowed: each name \
                     once",
                    file.display(),
                    experiment.stem()
                ));
            }
            Ok(experiment) => experiments.push(experiment),
            Err(error) => errors.push(error.to_string()),
        }
    }
    if errors.is_empty() { Ok(experiments) } else { Err(Failure::Input(errors.join("\nerror: "))) }
}

fn run(mut experiments: Vec<Experiment>, options: &RunOptions) -> Result<(), Failure> {
    let mut store = open_store(options)?;
    quick_first(&mut experiments, &store);
    let of = experiments.len();
    let mut counts = Counts::default();
    let mut failures = Vec::new();
    for (index, experiment) in experiments.iter().enumerate() {
        let place = Place { number: index + 1, of };
        // Each report can be opened as soon as it is written.
        let run = run_one(experiment, place, &mut store, options);
        match run.and_then(|done| update_index(&mut store, options).map(|()| done)) {
            Ok(done) => counts.add(done),
            Err(failure) => {
                counts.add(Done::Failed);
                failures.push(failure);
            }
        }
    }
    if of > 1 {
        counts.lines(&options.out).iter().for_each(|line| say(options, line));
    }
    // A failed run takes precedence over an invalid input and is reported last.
    failures.sort_by_key(|failure| matches!(failure, Failure::Run(_)));
    let Some(last) = failures.pop() else { return Ok(()) };
    for failure in failures {
        failure.report();
    }
    Err(last)
}

/// Runs with a display of progress, unless that is not wanted.
fn watched<T, E>(
    name: &str,
    is_quiet: bool,
    run: impl FnOnce(&dyn Progress) -> Result<T, E>,
) -> Result<T, E> {
    if is_quiet {
        return run(&Silent);
    }
    let monitor = Monitor::new(name);
    let done = run(&monitor);
    monitor.finish();
    done
}

/// Starts the threads, before anything is read: readers work with them. Where it `works`, this thread is one of them.
fn set_threads(threads: Option<u16>, works: bool) -> Result<(), Failure> {
    // Without a number as many as there are cores.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from));
    // It need not wake another and wait for it. On Windows its stack is too small for that.
    let pool = if works && !cfg!(windows) { pool.use_current_thread() } else { pool };
    pool.build_global().map_err(|error| {
        Failure::Run(format!(
            "cannot start the threads of a run: {error}; allowed: fewer of them (`--threads 1`), or higher limits of memory and \
             processes (`ulimit -v`, `ulimit -u`)"
        ))
    })
}

/// The folder of reports, recovered after an interrupted run, and checked to be writable by this program.
fn open_store(options: &RunOptions) -> Result<Store, Failure> {
    let mut store = Store::new(&options.out);
    store.recover()?;
    for page in Index::FILES {
        store.check_page(page, MARK)?;
    }
    Ok(store)
}

/// Writes the index of all reports, where it has changed.
fn update_index(store: &mut Store, options: &RunOptions) -> Result<(), Failure> {
    let _whole = interrupt::begin_writing();
    Ok(write_index(store, &options.out)?)
}

/// Runs an experiment and writes its report, unless it is up to date.
fn run_one(
    experiment: &Experiment,
    place: Place,
    store: &mut Store,
    options: &RunOptions,
) -> Result<Done, Failure> {
    let start = Instant::now();
    // Of a report that is not there the run finds the input itself.
    let mut known = None;
    if !options.force && store.has(experiment.stem()) {
        let input =
            watched(experiment.stem(), options.is_quiet(), |progress| experiment.watched_input(progress))?;
        if store.is_current(experiment.stem(), &experiment.key_of(&input)) {
            let folder = options.out.join(experiment.stem());
            say(options, &format!("{place}{} is unchanged ({} s)", folder.display(), seconds(start)));
            return Ok(Done::Unchanged);
        }
        known = Some(input);
    }
    store.check(experiment.stem())?;
    let results = run_and_write(experiment, place, known, store, options)?;
    if place.is_alone() {
        say_answer(experiment, &*results, options);
    }
    Ok(Done::Written)
}

/// Prints what a run has to say in the terminal, or only the answer.
fn say_answer(experiment: &Experiment, results: &dyn Outcome, options: &RunOptions) {
    let text = if options.is_quiet() {
        Answered::of(&options.out.join(experiment.stem())).map(|answered| answered.answer.to_string())
    } else {
        results.terminal()
    };
    if let Some(text) = text.filter(|_| !options.silent) {
        print_text(&experiment.for_its_user(&text));
    }
}

/// Runs an experiment, whose input may be `known`, and writes its report.
fn run_and_write(
    experiment: &Experiment,
    place: Place,
    known: Option<String>,
    store: &mut Store,
    options: &RunOptions,
) -> Result<Box<dyn Outcome>, Failure> {
    let start = Instant::now();
    let name = format!("{place}{}", experiment.stem());
    interrupt::of_sweep(experiment.is_sweep());
    let kept = options.out.join(KEPT).join(experiment.stem());
    let report = |results: &dyn Outcome, key: &str| report_folder(results, key);
    let run = |progress: &dyn Progress| experiment.run_on(known, Some(&kept), progress, report);
    let (report, results) = watched(&name, options.is_quiet(), run)?;
    write_report(experiment, place, &*results, &report?, store, options, start)?;
    Ok(results)
}

fn write_report(
    experiment: &Experiment,
    place: Place,
    results: &dyn Outcome,
    report: &Folder,
    store: &mut Store,
    options: &RunOptions,
    start: Instant,
) -> Result<(), Failure> {
    let folder = options.out.join(experiment.stem());
    let writing = interrupt::begin_writing();
    let edited = store.write(report)?;
    interrupt::count_written();
    drop(writing);
    for kept in edited {
        print_error(format_args!(
            "warning: {}: a file of the last report was edited since it was written; it is kept as {}",
            experiment.stem(),
            folder.join(kept).display()
        ));
    }
    let warnings = results.warnings();
    // Of several reports the pages have them.
    let mut count = String::new();
    if !place.is_alone() && !warnings.is_empty() {
        let plural = if warnings.len() == 1 { "" } else { "s" };
        count = format!(", {} warning{plural}", warnings.len());
    } else if !options.is_quiet() {
        for warning in warnings {
            let warning = experiment.for_its_user(&warning);
            print_error(format_args!("warning: {}: {warning}", experiment.stem()));
        }
    }
    say(
        options,
        &format!(
            "{place}{} written: {} files in {} s{count}",
            folder.display(),
            report.names().count(),
            seconds(start)
        ),
    );
    Ok(())
}

fn seconds(start: Instant) -> String {
    format!("{:.2}", start.elapsed().as_secs_f64())
}

fn list(out: &Path) -> Result<(), Failure> {
    let store = Store::new(out);
    for file in specs_in(Path::new(SPECS))? {
        match Experiment::read(&file) {
            Ok(experiment) => print(format_args!("{}", listed(&experiment, &store)?)),
            Err(error) => print(format_args!("{:<28} invalid         {error}", file.display())),
        }
    }
    Ok(())
}

fn check(files: &[PathBuf]) -> Result<(), Failure> {
    let mut errors = Vec::new();
    for experiment in read_all(files, false)? {
        print_text(&experiment.to_string());
        errors.extend(experiment.check().err().map(|error| error.to_string()));
    }
    if errors.is_empty() { Ok(()) } else { Err(Failure::Input(errors.join("\nerror: "))) }
}

fn new(name: &Path) -> Result<(), Failure> {
    let path = name.with_extension("toml");
    write_new(&path, TEMPLATE)?;
    print(format_args!("{} written; run it with `experiment run {}`", path.display(), path.display()));
    Ok(())
}

fn materials(name: Option<&str>) -> Result<(), Failure> {
    let text = match name {
        None => all_materials(),
        Some(name) => one_material(name).map_err(Failure::Input)?,
    };
    print_text(&text);
    Ok(())
}

fn verify(fresh: &Path, committed: &Path) -> Result<(), Failure> {
    let verify::Verified { differences, not_run } = verify::verified(fresh, committed, REPORTED)
        .map_err(|error| Failure::Run(format!("{} and {}: {error}", fresh.display(), committed.display())))?;
    if !not_run.is_empty() {
        print(format_args!("not compared, long runs that were not made again: {}", not_run.join(", ")));
    }
    if differences.is_empty() {
        print(format_args!("{} agrees with {}", fresh.display(), committed.display()));
        return Ok(());
    }
    for difference in &differences {
        print_error(format_args!("{difference}"));
    }
    Err(Failure::Run(format!(
        "{} differences between {} and {}",
        differences.len(),
        fresh.display(),
        committed.display()
    )))
}
