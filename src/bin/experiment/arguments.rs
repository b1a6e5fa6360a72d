//! The command line as clap reads it.

use std::path::PathBuf;

use asperity::topography::read::format_names;
use asperity::units::Dimension;
use asperity_experiment::surface::{ContactOptions, FileOptions};
use clap::{Args, CommandFactory, Parser, Subcommand};

use super::export::Export;

/// Runs the statistical and the deterministic contact model on the same rough surface.
///
/// Without a command it runs every spec in experiments/ and writes reports/.
#[derive(Parser)]
#[command(name = "experiment", version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Include specs with `run = "long"`, which take minutes each
    #[arg(long)]
    pub full: bool,
    #[command(flatten)]
    pub options: RunOptions,
    /// Number of threads; default: all cores. Results do not depend on it
    #[arg(long, global = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// What to do.
#[derive(Subcommand)]
pub enum Command {
    /// Run specs and write a report for each
    Run {
        /// Spec files
        #[arg(required = true)]
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// List the specs in experiments/ and whether their reports are up to date
    List {
        /// Folder that holds the reports
        #[arg(long, default_value = "reports")]
        out: PathBuf,
    },
    /// Check specs and print what they would run and need, without running them
    Check {
        /// Spec files
        #[arg(required = true)]
        files: Vec<PathBuf>,
    },
    /// Write a commented spec that is ready to run
    New {
        /// Name of the spec; NAME.toml is written
        name: PathBuf,
    },
    /// Check a measured map, compare both models on it and analyse its surface; or analyse all surfaces of a spec
    Surface {
        /// Height maps, or a spec
        #[arg(required = true, long_help = formats())]
        files: Vec<PathBuf>,
        #[command(flatten)]
        arguments: Box<FileArguments>,
        /// Name of the report folder; default: from the name of the file
        #[arg(long)]
        name: Option<String>,
        /// Write the spec that runs the same to this file
        #[arg(long)]
        save_spec: Option<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Serve the workbench, a page on this machine alone: drop a map, move a slider, see the verdict
    #[cfg(feature = "serve")]
    Serve {
        /// Folder of maps, specs and reports
        #[arg(default_value = ".")]
        folder: PathBuf,
        /// Port; default: 8642, or another where it is taken
        #[arg(long)]
        port: Option<u16>,
        /// Do not open the browser
        #[arg(long)]
        no_open: bool,
    },
    /// Write results for other programs
    Export {
        /// What
        #[command(subcommand)]
        what: Export,
    },
    /// Explain a key of a spec (type, unit, range, default, example), a table of a report, or a column
    Explain {
        /// Its name: thickness, compare.layer.thickness, curves.csv, area_ratio
        name: String,
    },
    /// Print the JSON schema of a spec, with which editors complete and check keys
    Schema,
    /// Print a script that completes commands and options in a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// List the materials of the library, each value with its source (Markdown)
    Materials {
        /// Only this one
        name: Option<String>,
    },
    /// Compare new reports with those in another folder, number by number
    Verify {
        /// Folder of new reports
        fresh: PathBuf,
        /// Folder to compare them with
        #[arg(long, default_value = "reports")]
        out: PathBuf,
    },
}

/// Options of a measured file, as in a spec.
#[derive(Args)]
pub struct FileArguments {
    #[command(flatten)]
    map: FileOptions,
    #[command(flatten)]
    contact: ContactOptions,
    /// Solve the contact of the map by boundary elements too, which know no asperities (seconds to minutes)
    #[arg(long)]
    reference: bool,
}

/// What is read of measured files.
fn formats() -> String {
    format!(
        "Height maps, each with a report of its own, or a spec. Read are {}; what a file holds is found by its content",
        format_names()
    )
}

/// Commands and options of earlier versions, and what to use in their place.
const GONE: [(&str, &str); 5] = [
    (
        "merge",
        "`asperity.distributed.sweep` of the Python package divides a run among machines (docs/clusters.md)",
    ),
    (
        "--part",
        "`asperity.distributed.sweep` of the Python package divides a run among machines (docs/clusters.md)",
    ),
    ("keys", "`experiment explain KEY` explains a key, `experiment schema` prints all"),
    (
        "columns",
        "`experiment explain curves.csv` lists the columns of a table, `experiment explain COLUMN` explains one",
    ),
    ("man", "`experiment COMMAND --help` says what a command does"),
];

/// What is wrong with arguments that are not what they seem: a command or an option that is gone; another option where a value of an option of a
/// file should be, since values may begin with a hyphen, as -9999 does; a load after `--force`, which has no value.
pub fn misread(words: &[String]) -> Option<String> {
    let is_typed = |name: &str| {
        words.get(1).is_some_and(|word| word == name)
            || name.starts_with("--") && words.iter().any(|word| word == name)
    };
    if let Some((name, instead)) = GONE.into_iter().find(|(name, _)| is_typed(name)) {
        return Some(format!("{name} is gone: {instead}"));
    }
    let command = Cli::command();
    // The options of a file are those of `surface` wherever they are.
    let takes_file = |word: &String| ["surface", "export"].contains(&word.as_str());
    let surface = command.find_subcommand("surface").filter(|_| words.iter().any(takes_file))?;
    let is_load = |word: &str| word.parse::<f64>().is_ok() || Dimension::Force.parse(word).is_some();
    let load = words.windows(2).find(|pair| pair[0] == "--force" && is_load(&pair[1]));
    if let Some([_, load]) = load {
        return Some(format!(
            "--force: found \"{load}\" after it; --force has no value; a load is --load \"{load}\""
        ));
    }
    let is_open = |word: &str| {
        let mut options = surface.get_arguments().filter(|option| option.is_allow_hyphen_values_set());
        options.any(|option| option.get_long().is_some_and(|long| word.strip_prefix("--") == Some(long)))
    };
    let (option, next) = words
        .iter()
        .zip(words.iter().skip(1))
        .find(|(word, next)| is_open(word) && next.starts_with("--"))?;
    Some(format!("{option}: found the option {next}; allowed: a value, see `experiment surface --help`"))
}

impl From<FileArguments> for FileOptions {
    fn from(FileArguments { map, contact, reference }: FileArguments) -> Self {
        Self { contact: ContactOptions { reference, ..contact }, ..map }
    }
}

/// How to run it.
#[derive(Args)]
pub struct RunOptions {
    /// Folder to write reports to
    #[arg(long, default_value = "reports")]
    pub out: PathBuf,
    /// Run unchanged specs too
    #[arg(long)]
    pub force: bool,
    /// Print the answer and errors only
    #[arg(long)]
    pub quiet: bool,
    /// Print errors only
    #[arg(long)]
    pub silent: bool,
}

impl RunOptions {
    /// Whether nothing but the answer is printed, if that.
    pub fn is_quiet(&self) -> bool {
        self.quiet || self.silent
    }
}
