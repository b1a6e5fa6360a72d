//! The command line as clap reads it.

use std::path::PathBuf;

use asperity::topography::read::format_names;
use asperity::units::Dimension;
use asperity_contact_framework::divided::Part;
use asperity_experiment::kind::REPORTED;
use asperity_experiment::surface::{ContactOptions, FileOptions};
use clap::builder::PossibleValuesParser;
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
        /// Run one part of `[tiled]` specs, such as 3/16, and write it to --parts instead of a report
        #[arg(long)]
        part: Option<Part>,
        /// Folder of parts
        #[arg(long, default_value = "parts", requires = "part")]
        parts: PathBuf,
    },
    /// Merge the parts of `[tiled]` specs and write a report for each
    Merge {
        /// Spec files
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Folder of parts
        #[arg(long, default_value = "parts")]
        parts: PathBuf,
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
    /// Print a Markdown reference of the report tables: every column with its unit and meaning
    Columns {
        /// Only tables of this kind of experiment
        #[arg(value_parser = PossibleValuesParser::new(REPORTED.iter().map(|kind| kind.name())))]
        kind: Option<String>,
    },
    /// Explain a key of a spec: type, unit, range, default, example
    Explain {
        /// Its name, or its whole path: thickness, compare.layer.thickness
        key: String,
    },
    /// Print a Markdown reference of all keys of a spec
    Keys,
    /// Print the JSON schema of a spec, with which editors complete and check keys
    Schema,
    /// Print a script that completes commands and options in a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or write those of all commands into a folder
    Man {
        /// Folder for the pages, such as ~/.local/share/man/man1
        #[arg(long)]
        out: Option<PathBuf>,
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
    map: MapArguments,
    #[command(flatten)]
    contact: ContactArguments,
    /// Solve the contact of the map by boundary elements too, which know no asperities (seconds to minutes)
    #[arg(long)]
    reference: bool,
}

/// Options of a measured file, as in a spec.
#[derive(Args)]
pub struct MapArguments {
    /// Pixel size, if the file does not contain it: "0.8 um", or "0.8 um, 0.5 um" along x and y. The first index of a .npy is x;
    /// in a text x runs along a line and y from line to line
    #[arg(long, allow_hyphen_values = true)]
    pixel: Option<String>,
    /// Unit of the lengths in the file, if it does not contain it: um, or "xy=um, z=nm" of coordinates and heights
    #[arg(long, allow_hyphen_values = true)]
    unit: Option<String>,
    /// Heights, in the unit of the file, and words that mark missing points: -9999, or "-9999, void"; none where all are heights
    #[arg(long, allow_hyphen_values = true)]
    missing: Option<String>,
    /// Channel of a file that holds several, by its name there; default: that of the heights
    #[arg(long, allow_hyphen_values = true)]
    channel: Option<String>,
    /// Part of the map to use along x, from and to, from its first point: "10 um, 200 um"
    #[arg(long, allow_hyphen_values = true, value_name = "FROM, TO")]
    crop_x: Option<String>,
    /// The same along y
    #[arg(long, allow_hyphen_values = true, value_name = "FROM, TO")]
    crop_y: Option<String>,
    /// Exchange x and y of the file; the pixel is then that of the exchanged map
    #[arg(long)]
    transpose: bool,
    /// Find the preparation that makes the map fit: remedies of failed checks, one after the other; options below are kept
    #[arg(long)]
    fit: bool,
    /// What becomes of spikes: keep, remove
    #[arg(long, allow_hyphen_values = true, value_name = "keep|remove")]
    outliers: Option<String>,
    /// Axis along which lines of the scan are set to the same mean height: x, y
    #[arg(long, allow_hyphen_values = true, value_name = "x|y")]
    align_lines: Option<String>,
    /// Radius of the stylus or tip that traced the map, which is eroded: "5 um"
    #[arg(long, allow_hyphen_values = true)]
    tip: Option<String>,
    /// Form to remove: none, mean, plane, quadratic, cubic
    #[arg(long, allow_hyphen_values = true)]
    level: Option<String>,
    /// S filter (ISO 16610-61), removes shorter wavelengths: "2.5 um"
    #[arg(long, allow_hyphen_values = true)]
    s: Option<String>,
    /// L filter (ISO 16610-61), removes longer wavelengths: "80 um"
    #[arg(long, allow_hyphen_values = true)]
    l: Option<String>,
    /// Number of neighbours that a summit must exceed: four, eight
    #[arg(long, allow_hyphen_values = true, value_name = "four|eight")]
    neighbours: Option<String>,
    /// Another key of the spec: compare.law=hertz, 'material.PTFE.hardness="50 MPa"'; may be given several times
    #[arg(long, allow_hyphen_values = true, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// Bodies, layer and load on a measured file, as in a spec.
#[derive(Args)]
pub struct ContactArguments {
    /// Material of both bodies, a name of the library (`experiment materials`); default: steel-100Cr6
    #[arg(long)]
    material: Option<String>,
    /// Material of the rough body, which the file describes
    #[arg(long)]
    rough: Option<String>,
    /// Material of the flat
    #[arg(long)]
    flat: Option<String>,
    /// Material of a layer on the flat (or by --layer-on on the rough body), with --thickness
    #[arg(long)]
    layer: Option<String>,
    /// Thickness of the layer: "2 um"
    #[arg(long, allow_hyphen_values = true)]
    thickness: Option<String>,
    /// Body that the layer is on: flat, rough; default: flat
    #[arg(long, value_name = "BODY")]
    layer_on: Option<String>,
    /// Force, on --area or else on the map's own area: "5 N"
    #[arg(long, allow_hyphen_values = true)]
    load: Option<String>,
    /// Nominal area that --load acts on: "4 mm2"
    #[arg(long, allow_hyphen_values = true)]
    area: Option<String>,
    /// Nominal pressure, instead of --load: "1.25 MPa"
    #[arg(long, allow_hyphen_values = true)]
    pressure: Option<String>,
}

/// What is read of measured files.
fn formats() -> String {
    format!(
        "Height maps, each with a report of its own, or a spec. Read are {}; what a file holds is found by its content",
        format_names()
    )
}

/// What is wrong with the options of a file that are not what they seem: another option where a value should be, since values may begin with a
/// hyphen, as -9999 does; a load after `--force`, which has no value.
pub fn misread(words: &[String]) -> Option<String> {
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

impl From<MapArguments> for FileOptions {
    fn from(arguments: MapArguments) -> Self {
        Self {
            pixel: arguments.pixel,
            unit: arguments.unit,
            missing: arguments.missing,
            channel: arguments.channel,
            transpose: arguments.transpose,
            crop: [arguments.crop_x, arguments.crop_y],
            fit: arguments.fit,
            outliers: arguments.outliers,
            align_lines: arguments.align_lines,
            tip: arguments.tip,
            level: arguments.level,
            s: arguments.s,
            l: arguments.l,
            neighbours: arguments.neighbours,
            set: arguments.set,
            contact: ContactOptions::default(),
        }
    }
}

impl From<ContactArguments> for ContactOptions {
    fn from(arguments: ContactArguments) -> Self {
        Self {
            material: arguments.material,
            rough: arguments.rough,
            flat: arguments.flat,
            layer: arguments.layer,
            thickness: arguments.thickness,
            layer_on: arguments.layer_on,
            load: arguments.load,
            area: arguments.area,
            pressure: arguments.pressure,
            reference: false,
        }
    }
}

impl From<FileArguments> for FileOptions {
    fn from(FileArguments { map, contact, reference }: FileArguments) -> Self {
        Self { contact: ContactOptions { reference, ..contact.into() }, ..map.into() }
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
