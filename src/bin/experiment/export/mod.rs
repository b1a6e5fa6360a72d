//! `experiment export`: results for other programs.

mod surface;

use std::io;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use asperity::topography::write::{Out, whole_file};
use asperity_contact_framework::kept::check_writable;
use asperity_experiment::Experiment;
use asperity_experiment::export::{
    Format, InterfaceOptions, TableModel, UnitSystem, interface_files, interface_tables,
};
use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use surface::{AsperitiesExport, MapExport, PatchesExport};

use crate::output::unwritten;
use crate::{Failure, RunOptions, interrupt, say, watched};

/// What is exported.
#[derive(Subcommand)]
pub enum Export {
    /// Write the map of a surface after each step of its preparation, with its pixel and where it comes from
    Map(Box<MapExport>),
    /// Write the asperities of a surface, as `[surface.NAME.asperities]` of a spec reads them
    Asperities(Box<AsperitiesExport>),
    /// Solve the contact by boundary elements and write its patches and pressures as a picture and as maps
    Patches(Box<PatchesExport>),
    /// Run a comparison and write pressure over closure, conductance and friction over pressure for programs for finite elements
    Interface(InterfaceExport),
}

/// Where files are written to, and how.
#[derive(Args)]
struct Writing {
    /// Folder to write to
    #[arg(long, default_value = ".")]
    out: PathBuf,
    /// Replace files of the same name
    #[arg(long)]
    force: bool,
    /// Print errors only
    #[arg(long)]
    quiet: bool,
}

impl Export {
    pub fn run(self) -> Result<(), Failure> {
        match self {
            Self::Map(export) => export.run(),
            Self::Asperities(export) => export.run(),
            Self::Patches(export) => export.run(),
            Self::Interface(export) => export.run(),
        }
    }
}

/// Writes the files of an export.
struct Writer {
    options: RunOptions,
}

impl Writing {
    /// A writer into the folder, which is made and checked.
    fn begin(self) -> Result<Writer, Failure> {
        let Self { out, force, quiet } = self;
        let options = RunOptions { out, force, quiet, silent: quiet };
        let place = format!("--out {}", options.out.display());
        std::fs::create_dir_all(&options.out).and_then(|()| check_writable(&options.out)).map_err(
            |error| match error.kind() {
                ErrorKind::AlreadyExists | ErrorKind::NotADirectory => Failure::Input(format!(
                    "{place}: {error}; allowed: a folder, which is made if it is missing"
                )),
                _ => unwritten(&place, &error),
            },
        )?;
        Ok(Writer { options })
    }
}

impl Writer {
    /// Refuses names of files that are there already, before anything is computed.
    fn check<'a>(&self, names: impl IntoIterator<Item = &'a String>) -> Result<(), Failure> {
        let mut paths = names.into_iter().map(|name| self.options.out.join(name));
        match paths.find(|path| !self.options.force && path.exists()) {
            Some(path) => Err(taken(&path)),
            None => Ok(()),
        }
    }

    /// Writes a file whole or not at all.
    fn write(&self, name: &str, content: impl FnOnce(&mut dyn Out) -> io::Result<()>) -> Result<(), Failure> {
        let path = self.options.out.join(name);
        self.check([&name.to_owned()])?;
        let writing = interrupt::begin_writing();
        let written = whole_file(&path, |out| content(&mut interrupt::GivenUp::new(out)));
        if written.is_err() && interrupt::has_come() {
            interrupt::wait_for_the_end(writing);
        }
        drop(writing);
        written.map_err(|error| unwritten(&path.display().to_string(), &error))?;
        say(&self.options, &format!("{} written", path.display()));
        Ok(())
    }
}

fn taken(path: &Path) -> Failure {
    Failure::Input(format!(
        "{}: found a file of this name; allowed: --force to replace it, or another --out",
        path.display()
    ))
}

/// What is exported of which comparison.
#[derive(Args)]
pub struct InterfaceExport {
    /// Spec file
    spec: PathBuf,
    /// csv, which every program takes, or calculix
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
    #[command(flatten)]
    writing: Writing,
}

/// The one of a list with a name; the first where the command line has checked it.
fn named<T: Copy>(all: &[T], name: impl Fn(T) -> &'static str, wanted: &str) -> T {
    all.iter().copied().find(|one| name(*one) == wanted).unwrap_or(all[0])
}

impl InterfaceExport {
    pub fn run(self) -> Result<(), Failure> {
        let Self { spec, format, model, units, beyond, writing } = self;
        let format = named(&Format::ALL, Format::name, &format);
        let model = named(&TableModel::ALL, TableModel::name, &model);
        let units = named(&UnitSystem::ALL, UnitSystem::name, &units);
        let name = spec.file_stem().unwrap_or_default().to_string_lossy();
        let experiment = watched(&name, writing.quiet, |progress| Experiment::watched_read(&spec, progress))?;
        let writer = writing.begin()?;
        // The name of a single case is checked before the run; those of several cases follow from it.
        writer.check([&format!("{}.{}", experiment.stem(), format.ending())])?;
        let results =
            watched(experiment.stem(), writer.options.is_quiet(), |progress| experiment.run(progress))?;
        let of = InterfaceOptions { model, beyond };
        let refuse = |message: String| Failure::Input(format!("{}: {message}", spec.display()));
        let found = interface_tables(&*results, of).map_err(refuse)?;
        found.left_out.iter().for_each(|reason| say(&writer.options, &format!("left out: {reason}")));
        let files = interface_files(&found.tables, experiment.stem(), format, units);
        writer.check(files.iter().map(|file| &file.name))?;
        files.iter().try_for_each(|file| writer.write(&file.name, |out| out.write_all(file.text.as_bytes())))
    }
}
