//! `experiment export map|asperities|patches`: what the models see of a surface.

use std::path::PathBuf;

use asperity::progress::Progress;
use asperity::surface::Step;
use asperity::topography::Watched;
use asperity::topography::write::{FORMATS, MapFormat, Note};
use asperity_experiment::export::{ExportedContacts, ExportedMap, ExportedSurface, SurfaceChoice};
use asperity_experiment::surface::{ContactOptions, FileOptions};
use clap::Args;
use clap::builder::PossibleValuesParser;
use serde_json::{Map, Value, json};

use super::{Failure, Writer, Writing, say, watched};

/// The surface.
#[derive(Args)]
struct Chosen {
    /// A height map, or a spec
    file: PathBuf,
    /// Surface of a spec with several
    #[arg(long)]
    surface: Option<String>,
    /// Realisation of a surface with several, from 1
    #[arg(long)]
    realisation: Option<usize>,
}

impl Chosen {
    fn choice(&self) -> SurfaceChoice {
        SurfaceChoice { surface: self.surface.clone(), realisation: self.realisation }
    }

    /// What `read` makes of the file, with a display of its progress unless that is not wanted.
    fn read<T, E>(&self, is_quiet: bool, read: impl FnOnce(&dyn Progress) -> Result<T, E>) -> Result<T, E> {
        let name = self.file.file_stem().unwrap_or_default().to_string_lossy();
        watched(&name, is_quiet, read)
    }
}

/// Maps after the steps of their preparation.
#[derive(Args)]
pub struct MapExport {
    #[command(flatten)]
    chosen: Chosen,
    #[command(flatten)]
    arguments: FileOptions,
    /// gwy (Gwyddion), x3p (ISO 25178-72), xyz (text) or npy (NumPy, with a .json of pixel and origin beside it)
    #[arg(long, value_parser = PossibleValuesParser::new(FORMATS.map(|format| format.ending)), default_value = "gwy")]
    format: String,
    /// Only the map after this step; default: after each that the preparation has
    #[arg(long, value_parser = PossibleValuesParser::new(Step::ALL.map(Step::name)))]
    step: Option<String>,
    #[command(flatten)]
    writing: Writing,
}

impl MapExport {
    /// Writes them.
    pub fn run(self) -> Result<(), Failure> {
        let Self { chosen, arguments, format, step, writing } = self;
        let format = MapFormat::of_ending(&format).unwrap_or(FORMATS[0]);
        let surface = chosen.read(writing.quiet, |progress| {
            ExportedSurface::read(&chosen.file, &arguments, &chosen.choice(), progress)
        })?;
        let writer = writing.begin()?;
        surface.caveats().for_each(|caveat| say(&writer.options, &format!("{}: {caveat}", surface.name())));
        let is_wanted = |found: Step| step.as_ref().is_none_or(|step| step == found.name());
        let names = |name: &str, step: Step| {
            let name = format!("{name}-{}", step.name());
            let beside = (!format.holds_notes).then(|| format!("{name}.json"));
            [format!("{name}.{}", format.ending)].into_iter().chain(beside)
        };
        let known = surface.known_steps().into_iter().filter(|step| is_wanted(*step));
        let known: Vec<String> = known.flat_map(|step| names(&surface.name(), step)).collect();
        writer.check(&known)?;
        let mut found = Vec::new();
        watched(&surface.name(), writer.options.is_quiet(), |progress| {
            surface.each_map(progress, |ExportedMap { name, step, map, notes }| {
                found.push(step.name());
                if !is_wanted(*step) {
                    return Ok(());
                }
                let all: Vec<String> = names(name, *step).collect();
                writer.check(&all)?;
                progress.stage("writing", 1.0);
                writer.write(&all[0], |out| format.write(out, &Watched { map: *map, progress }, notes))?;
                let [points, pixel] = [json!(map.points()), json!(map.pixel())];
                all[1..].iter().try_for_each(|beside| {
                    let facts = [("points", points.clone()), ("pixel_m", pixel.clone())];
                    writer.write_notes(beside, "heights in m, the first index along x", facts, notes)
                })
            })
        })?;
        match step.filter(|step| !found.contains(&step.as_str())) {
            None => Ok(()),
            Some(step) => Err(Failure::Input(format!(
                "--step {step}: the preparation of {} has no such step; allowed: {}",
                chosen.file.display(),
                found.join(", ")
            ))),
        }
    }
}

/// Asperities.
#[derive(Args)]
pub struct AsperitiesExport {
    #[command(flatten)]
    chosen: Chosen,
    #[command(flatten)]
    arguments: FileOptions,
    /// csv (with places and principal curvatures), or npy (height, radius and principal curvatures, with a .json beside it)
    #[arg(long, value_parser = ["csv", "npy"], default_value = "csv")]
    format: String,
    #[command(flatten)]
    writing: Writing,
}

impl AsperitiesExport {
    /// Writes them.
    pub fn run(self) -> Result<(), Failure> {
        let Self { chosen, arguments, format, writing } = self;
        let surface = chosen.read(writing.quiet, |progress| {
            ExportedSurface::read(&chosen.file, &arguments, &chosen.choice(), progress)
        })?;
        let writer = writing.begin()?;
        surface.caveats().for_each(|caveat| say(&writer.options, &format!("{}: {caveat}", surface.name())));
        let name = format!("{}-asperities", surface.name());
        let [file, beside] = [&format, "json"].map(|ending| format!("{name}.{ending}"));
        let is_text = format == "csv";
        writer.check([&file].into_iter().chain((!is_text).then_some(&beside)))?;
        let name = surface.name();
        let asperities = watched(&name, writer.options.is_quiet(), |progress| {
            let asperities = surface.asperities(progress)?;
            progress.stage("writing", 1.0);
            writer.write(&file, |out| {
                if is_text {
                    asperities.write_csv(out, progress)
                } else {
                    asperities.write_npy(out, progress)
                }
            })?;
            Ok::<_, Failure>(asperities)
        })?;
        if is_text {
            return Ok(());
        }
        let facts = [("columns", json!(asperities.of_array().map(|(name, _)| *name).collect::<Vec<_>>()))];
        writer.write_notes(&beside, "one row for each asperity", facts, &asperities.notes)
    }
}

/// Contact patches of the boundary elements.
#[derive(Args)]
pub struct PatchesExport {
    #[command(flatten)]
    chosen: Chosen,
    #[command(flatten)]
    arguments: FileOptions,
    #[command(flatten)]
    contact: ContactOptions,
    /// gwy (pressures, numbers of the patches and heights in one file), or npy (pressures and patches, with a .json beside them); a PNG in
    /// either case
    #[arg(long, value_parser = ["gwy", "npy"], default_value = "gwy")]
    format: String,
    #[command(flatten)]
    writing: Writing,
}

impl PatchesExport {
    /// Writes them.
    pub fn run(self) -> Result<(), Failure> {
        let Self { chosen, arguments, contact, format, writing } = self;
        let options = FileOptions { contact, ..arguments };
        let contacts = chosen.read(writing.quiet, |progress| {
            ExportedContacts::read(&chosen.file, &options, &chosen.choice(), progress)
        })?;
        let writer = writing.begin()?;
        let endings: &[&str] = if format == "gwy" {
            &["-contact.png", "-contact.gwy"]
        } else {
            &["-contact.png", "-pressures.npy", "-patches.npy", "-contact.json"]
        };
        let names = |name: &str| endings.iter().map(|ending| format!("{name}{ending}")).collect::<Vec<_>>();
        // Of several contacts the names follow from this one.
        writer.check(&names(&contacts.name()))?;
        let mut written = 0;
        let left_out = watched(&contacts.name(), writer.options.is_quiet(), |progress| {
            contacts.each(progress, |contact| {
                written += 1;
                let all = names(&contact.name);
                writer.check(&all)?;
                writer.write(&all[0], |out| contact.write_png(out))?;
                let [_, first, others @ ..] = &all[..] else { return Ok(()) };
                let [patches, beside] = others else {
                    return writer.write(first, |out| contact.write_gwy(out));
                };
                writer.write(first, |out| contact.write_pressures(out))?;
                writer.write(patches, |out| contact.write_patches(out))?;
                let content =
                    "pressures in Pa, numbers of patches (0 out of contact), the first index along x";
                writer.write_notes(beside, content, [], &contact.notes)
            })
        })?;
        left_out.iter().for_each(|reason| say(&writer.options, &format!("left out: {reason}")));
        match left_out.first().filter(|_| written == 0) {
            Some(reason) => Err(Failure::Input(format!("{}: {reason}", chosen.file.display()))),
            None => Ok(()),
        }
    }
}

impl Writer {
    /// Writes what an array does not hold.
    fn write_notes<const COUNT: usize>(
        &self,
        name: &str,
        content: &str,
        facts: [(&str, Value); COUNT],
        notes: &[Note],
    ) -> Result<(), Failure> {
        let notes = notes.iter().map(|(name, text)| ((*name).to_owned(), json!(text)));
        let facts = facts.into_iter().map(|(name, value)| (name.to_owned(), value));
        let all: Map<String, Value> =
            [("content".to_owned(), json!(content))].into_iter().chain(facts).chain(notes).collect();
        self.write(name, |out| writeln!(out, "{:#}", Value::Object(all)))
    }
}
