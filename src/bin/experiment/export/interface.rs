//! `experiment export interface`: joints for programs for finite elements.

use std::path::PathBuf;

use asperity_experiment::Experiment;
use asperity_experiment::export::{
    Format, InterfaceOptions, TableModel, UnitSystem, interface_files, interface_tables,
};
use clap::Args;
use clap::builder::PossibleValuesParser;

use super::{Failure, Writing, say, watched};

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
    /// Writes it.
    ///
    /// # Errors
    /// A spec that cannot be run, results without a table, files that are there already.
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
