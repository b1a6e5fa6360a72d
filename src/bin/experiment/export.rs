//! `experiment export`: results for other programs.

use std::path::{Path, PathBuf};

use asperity_experiment::Experiment;
use asperity_experiment::export::{
    Format, InterfaceOptions, TableModel, UnitSystem, interface_files, interface_tables,
};
use clap::Subcommand;
use clap::builder::PossibleValuesParser;

use super::{Failure, RunOptions, say, set_threads, watched, write_new};

/// What is exported.
#[derive(Subcommand)]
pub enum Export {
    /// Run a comparison and write pressure over closure, conductance and friction over pressure for programs for finite elements
    Interface {
        /// Spec file
        spec: PathBuf,
        /// csv, abaqus, calculix, moose or comsol; only files for calculix are tested in the program that reads them
        #[arg(long, value_parser = PossibleValuesParser::new(Format::ALL.map(Format::name)), default_value = "csv")]
        format: String,
        /// The model of the table
        #[arg(long, value_parser = PossibleValuesParser::new(TableModel::ALL.map(TableModel::name)), default_value = "deterministic")]
        model: String,
        /// si (m, Pa, W) or mm (mm, MPa, mW)
        #[arg(long, value_parser = PossibleValuesParser::new(UnitSystem::ALL.map(UnitSystem::name)), default_value = "si")]
        units: String,
        /// Keep loads that are not admissible, marked
        #[arg(long)]
        beyond: bool,
        /// Folder to write to
        #[arg(long, default_value = ".")]
        out: PathBuf,
        /// Replace files of the same name
        #[arg(long)]
        force: bool,
        /// Number of threads; default: all cores. Results do not depend on it
        #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
        threads: Option<u16>,
        /// Print errors only
        #[arg(long)]
        quiet: bool,
    },
}

/// The one of a list with a name; the first where the command line has checked it.
fn named<T: Copy>(all: &[T], name: impl Fn(T) -> &'static str, wanted: &str) -> T {
    all.iter().copied().find(|one| name(*one) == wanted).unwrap_or(all[0])
}

impl Export {
    /// Writes it.
    ///
    /// # Errors
    /// A spec that cannot be run, results without a table, files that are there already.
    pub fn run(self) -> Result<(), Failure> {
        let Self::Interface { spec, format, model, units, beyond, out, force, threads, quiet } = self;
        let format = named(&Format::ALL, Format::name, &format);
        let model = named(&TableModel::ALL, TableModel::name, &model);
        let units = named(&UnitSystem::ALL, UnitSystem::name, &units);
        let options = RunOptions { out, force, threads, quiet };
        set_threads(&options)?;
        let experiment = Experiment::read(&spec)?;
        std::fs::create_dir_all(&options.out).map_err(|error| {
            let message = format!(
                "--out {}: {error}; allowed: a folder, which is made if it is missing",
                options.out.display()
            );
            Failure::Input(message)
        })?;
        // The folder and the name of a single case are checked before the run; those of several cases follow from it.
        let probe = options.out.join(format!(".asperity.{}", std::process::id()));
        write_new(&probe, "")?;
        let _ = std::fs::remove_file(&probe);
        let first = options.out.join(format!("{}.{}", experiment.stem(), format.ending()));
        if !options.force && first.exists() {
            return Err(taken(&first));
        }
        let results = watched(experiment.stem(), &options, |progress| experiment.run(progress))?;
        let of = InterfaceOptions { model, beyond };
        let refuse = |message: String| Failure::Input(format!("{}: {message}", spec.display()));
        let found = interface_tables(&*results, of).map_err(refuse)?;
        found.left_out.iter().for_each(|reason| say(&options, &format!("left out: {reason}")));
        let files = interface_files(&found.tables, experiment.stem(), format, units);
        let paths: Vec<PathBuf> = files.iter().map(|file| options.out.join(&file.name)).collect();
        if let Some(path) = paths.iter().find(|path| !options.force && path.exists()) {
            return Err(taken(path));
        }
        for (file, path) in files.iter().zip(&paths) {
            replace(path, &file.text)?;
            say(&options, &format!("{} written", path.display()));
        }
        Ok(())
    }
}

fn taken(path: &Path) -> Failure {
    Failure::Input(format!(
        "{}: found a file of this name; allowed: --force to replace it, or another --out",
        path.display()
    ))
}

/// Writes a file beside its place first, so that no half of it is left.
fn replace(path: &Path, text: &str) -> Result<(), Failure> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let beside = path.with_file_name(format!(".{name}.{}", std::process::id()));
    write_new(&beside, text)?;
    std::fs::rename(&beside, path).map_err(|error| {
        let _ = std::fs::remove_file(&beside);
        Failure::Input(format!("{}: {error}", path.display()))
    })
}
