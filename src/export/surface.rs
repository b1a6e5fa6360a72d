//! Maps and asperities of a surface, as the models see them: which is exported, and where it comes from.

use std::path::{Path, PathBuf};

use asperity::progress::Count;
use asperity::surface::{AnalysisDepth, Preparation, Step, Surface};
use asperity::topography::read::is_named_as_map;
use asperity::topography::write::{Note, Out};
use asperity::topography::{Boundary, Level, Rows};
use asperity::work::Counter;
use asperity::{Ellipse, npy};
use asperity_contact_framework::digest::{hexadecimal, sha256, sha256_of_file};
use asperity_contact_framework::input::{InputError, Source, SpecFile};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::{Progress, Silent};

use super::identifier;
use crate::experiment::tables;
use crate::surface::{FileOptions, SurfaceFactory, SurfacePlan, files_of, surfaces};

/// One surface of a spec, or that of a measured file.
pub struct ExportedSurface {
    source: Source,
    seed: u64,
    /// The spec or the measured file.
    path: PathBuf,
    plan: SurfacePlan,
    realisation: usize,
    /// Whether the spec has others.
    is_one_of_several: bool,
}

/// A map after a step of its preparation.
pub struct ExportedMap<'a> {
    /// How the names of its files begin.
    pub name: &'a str,
    pub step: Step,
    pub map: &'a dyn Rows,
    /// Where they come from.
    pub notes: &'a [Note],
}

/// Asperities with where they come from.
pub struct ExportedAsperities {
    /// How the names of their files begin.
    pub name: String,
    /// Where they come from.
    pub notes: Vec<Note>,
    columns: Vec<(&'static str, Vec<f64>)>,
}

impl ExportedSurface {
    /// The chosen surface of the spec at `path`, or the surface of a measured file with `options`.
    pub fn read(
        path: &Path,
        options: &FileOptions,
        choice: &SurfaceChoice,
        progress: &dyn Progress,
    ) -> Result<Self, InputError> {
        let spec = if is_spec(path) {
            refuse_options(path, options)?;
            SpecFile::read(path, &tables())?
        } else {
            options.check()?;
            SpecFile::parse(options.source(path), &tables())?
        };
        let spec = spec.watched_by(progress);
        let mut all = surfaces(&spec, None, 0..0, false)?;
        let is_one_of_several = all.len() > 1;
        let (place, realisation) = chosen(path, &all, choice)?;
        let plan = all.swap_remove(place);
        let SpecFile { source, seed, .. } = spec;
        Ok(Self { source, seed, path: path.to_owned(), plan, realisation, is_one_of_several })
    }

    /// How the names of its files begin: the name of the spec or the file, of the surface where there are several, and the realisation.
    pub fn name(&self) -> String {
        file_name(&self.path, &self.plan, self.is_one_of_several, self.realisation)
    }

    /// What a reader should know of how its file is read.
    pub fn caveats(&self) -> impl Iterator<Item = String> {
        self.plan.caveats().iter().map(|caveat| self.source.front_end().text(caveat))
    }

    /// The steps that its preparation has, as far as that is known before it is made.
    pub fn known_steps(&self) -> Vec<Step> {
        let counter = Counter::default();
        let preparation = self.factory(&counter, &Silent).preparation();
        Step::ALL.into_iter().filter(|step| preparation.is_some_and(|known| known.has(*step))).collect()
    }

    /// Calls `take` with the map after each step of its preparation, in order.
    pub fn each_map<E: From<InputError>>(
        &self,
        progress: &dyn Progress,
        mut take: impl FnMut(&ExportedMap) -> Result<(), E>,
    ) -> Result<(), E> {
        let counter = Counter::default();
        let mut files = files_of(std::slice::from_ref(&self.plan), &counter);
        let (name, origin) = (self.name(), self.origin()?);
        let mut result = Ok(());
        self.factory(&counter, progress).each_step(
            self.realisation,
            &mut files,
            |preparation, step, map| {
                if result.is_ok() {
                    let mut notes = origin.clone();
                    notes.extend(self.of_map(preparation, step, map));
                    result = take(&ExportedMap { name: &name, step, map, notes: &notes });
                }
            },
        )?;
        result
    }

    pub fn asperities(mut self, progress: &dyn Progress) -> Result<ExportedAsperities, InputError> {
        if self.plan.is_list() {
            let message = format!(
                "surface {}: {}; allowed: a surface whose asperities are found on a map or drawn of a population",
                self.plan.name,
                self.plan.describe()
            );
            return Err(self.source.error_at(self.plan.size_key.clone(), message));
        }
        self.plan = self.plan.with_own_ellipses();
        let counter = Counter::default();
        let (mut files, mut timing) =
            (files_of(std::slice::from_ref(&self.plan), &counter), Timing::default());
        let mut factory = self.factory(&counter, progress).keeping_map(true);
        let surface = factory.make(self.realisation, AnalysisDepth::Asperities, &mut files, &mut timing)?;
        let mut notes = self.origin()?;
        if let Some(preparation) = factory.preparation() {
            notes.push(("Preparation", described(&preparation, Step::Filtered)));
        }
        notes.push(("Nominal area (m^2)", format!("{:e}", surface.set.nominal_area())));
        let lost = surface.map.as_ref().map_or(0.0, |map| map.offset);
        if lost != 0.0 {
            notes.push(("Height of zero (m)", format!("{:e}", surface.origin)));
        }
        Ok(ExportedAsperities { name: self.name(), notes, columns: columns(&surface, lost) })
    }

    fn factory<'a>(&'a self, counter: &'a Counter, progress: &'a dyn Progress) -> SurfaceFactory<'a> {
        SurfaceFactory::from_seed(&self.plan, &self.source, self.seed, counter, progress)
    }

    fn origin(&self) -> Result<Vec<Note>, InputError> {
        origin(&self.path, &self.source.text, self.seed, &self.plan, self.realisation)
    }

    /// What is said of a map.
    fn of_map(&self, preparation: &Preparation, step: Step, map: &dyn Rows) -> Vec<Note> {
        let mut notes = vec![("Step", step.name().to_owned())];
        notes.push(("Preparation", described(preparation, step)));
        if map.offset() != 0.0 {
            notes.push(("Height of zero (m)", format!("{:e}", map.offset())));
        }
        notes.push(("Read by a spec with", keys(map)));
        notes
    }
}

/// The keys of `[surface.NAME.file]` that read a map as it is.
fn keys(map: &dyn Rows) -> String {
    let periodic = if map.boundary() == Boundary::Periodic { ", periodic = true" } else { "" };
    format!("level = \"none\"{periodic}")
}

/// The columns of a list of asperities; places where they are known, principal curvatures of ellipses.
fn columns(surface: &Surface, lost: f64) -> Vec<(&'static str, Vec<f64>)> {
    let mut columns = Vec::new();
    if let Some(prepared) = &surface.prepared {
        let ([_, ny], [dx, dy]) = (prepared.map.points(), prepared.map.pixel());
        let along = |of: &dyn Fn(usize) -> f64| prepared.positions.iter().map(|&at| of(at)).collect();
        columns.push(("x [m]", along(&|at| (at / ny) as f64 * dx)));
        columns.push(("y [m]", along(&|at| (at % ny) as f64 * dy)));
    }
    // The heights of the file, exactly, unless it keeps an offset apart.
    let origin = if lost == 0.0 { surface.origin } else { 0.0 };
    let height = |z: &f64| if origin == 0.0 { *z } else { z + origin };
    columns.push(("height [m]", surface.set.heights().iter().map(height).collect()));
    columns.push(("radius [m]", surface.set.radii().to_vec()));
    if let Some(ellipses) = surface.set.ellipses() {
        let (larger, smaller) =
            ellipses.iter().map(Ellipse::exact_principal).map(|[larger, smaller]| (larger, smaller)).unzip();
        columns.extend([("kx [1/m]", larger), ("ky [1/m]", smaller)]);
    }
    columns
}

impl ExportedAsperities {
    pub fn count(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// As a text with a line for each, which a spec reads by `[surface.NAME.asperities]`.
    pub fn write_csv(&self, out: &mut dyn Out, progress: &dyn Progress) -> std::io::Result<()> {
        let mut count = Count::new(progress, 1.0, self.count() * self.columns.len());
        for (name, text) in &self.notes {
            writeln!(out, "# {name}: {text}")?;
        }
        let names: Vec<&str> = self.columns.iter().map(|(name, _)| *name).collect();
        writeln!(out, "{}", names.join(","))?;
        for row in 0..self.count() {
            for (k, (_, column)) in self.columns.iter().enumerate() {
                write!(out, "{}{:e}", if k > 0 { "," } else { "" }, column[row])?;
            }
            writeln!(out)?;
            count.add(self.columns.len());
        }
        count.end();
        Ok(())
    }

    /// As an array with the columns that a spec reads of one: height, radius, and kx and ky where they are known.
    pub fn write_npy(&self, out: &mut dyn Out, progress: &dyn Progress) -> std::io::Result<()> {
        let mut count = Count::new(progress, 1.0, self.count());
        let columns: Vec<&Vec<f64>> = self.of_array().map(|(_, column)| column).collect();
        let rows = (0..self.count()).inspect(|_| count.add(1));
        let values = rows.flat_map(|row| columns.iter().map(move |column| column[row]));
        npy::write(out, [self.count(), columns.len()], values)
    }

    pub fn of_array(&self) -> impl Iterator<Item = &(&'static str, Vec<f64>)> {
        self.columns.iter().filter(|(name, _)| !name.starts_with(['x', 'y']))
    }
}

/// Which surface of a spec is exported.
#[derive(Debug, Clone, Default)]
pub struct SurfaceChoice {
    /// Its name; not needed where there is one.
    pub surface: Option<String>,
    /// From 1; not needed where there is one.
    pub realisation: Option<usize>,
}

/// Whether a file is a spec, by the ending of its name.
pub(super) fn is_spec(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "toml")
}

/// Refuses options of a measured file beside a spec.
pub(super) fn refuse_options(path: &Path, options: &FileOptions) -> Result<(), InputError> {
    if *options == FileOptions::default() {
        return Ok(());
    }
    let message = "is a spec, which defines its surfaces and bodies completely; allowed: --surface, --realisation, and of patches \
                   --pressure, --load and --area; other options only with a measured file";
    Err(InputError::file(path, message))
}

/// The index of the surface that is wanted of those of a spec, and its realisation.
pub(super) fn chosen(
    path: &Path,
    all: &[SurfacePlan],
    choice: &SurfaceChoice,
) -> Result<(usize, usize), InputError> {
    let refuse = |message: String| Err(InputError::file(path, message));
    let names = || all.iter().map(|plan| plan.name.as_str()).collect::<Vec<_>>().join(", ");
    let place = match &choice.surface {
        None if all.len() == 1 => 0,
        None => {
            return refuse(format!("has {} surfaces; allowed: --surface with one of {}", all.len(), names()));
        }
        Some(wanted) => match all.iter().position(|plan| plan.name == *wanted) {
            Some(place) => place,
            None => {
                return refuse(format!(
                    "has no surface \"{wanted}\"; allowed: --surface with one of {}",
                    names()
                ));
            }
        },
    };
    let SurfacePlan { name, realisations, .. } = &all[place];
    let allowed = match realisations {
        1 => "no --realisation".to_owned(),
        count => format!("--realisation 1 to {count}"),
    };
    match choice.realisation {
        None if *realisations == 1 => Ok((place, 1)),
        None => refuse(format!("has {realisations} realisations of surface {name}; allowed: {allowed}")),
        Some(number) if (1..=*realisations).contains(&number) => Ok((place, number)),
        Some(number) => refuse(format!("has no realisation {number} of surface {name}; allowed: {allowed}")),
    }
}

/// Whether the folder of a map holds another of the same name but for its ending.
fn has_namesake(path: &Path) -> bool {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut others = folder.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
    others.any(|other| {
        other.file_stem() == path.file_stem()
            && other.extension() != path.extension()
            && is_named_as_map(&other)
    })
}

/// How the names of files begin: the name of the spec or the file at `path`, of the surface where it `is_one_of_several`, and of several
/// realisations the number.
pub(super) fn file_name(
    path: &Path,
    plan: &SurfacePlan,
    is_one_of_several: bool,
    realisation: usize,
) -> String {
    let mut name = crate::surface::file_name(path);
    if let Some(ending) = path.extension().filter(|_| !is_spec(path) && has_namesake(path)) {
        name += &format!("-{}", ending.to_string_lossy());
    }
    if is_one_of_several {
        name += &format!("-{}", plan.name);
    }
    if plan.realisations > 1 {
        name += &format!("-{realisation}");
    }
    identifier(&name)
}

/// The program, and the file or the spec (of this text and seed) at `path` that a surface comes from.
pub(super) fn origin(
    path: &Path,
    text: &str,
    seed: u64,
    plan: &SurfacePlan,
    realisation: usize,
) -> Result<Vec<Note>, InputError> {
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut notes = vec![("Program", format!("asperity {}", env!("CARGO_PKG_VERSION")))];
    if is_spec(path) {
        notes.push(("Spec", format!("{}, SHA-256 {}", name(path), hexadecimal(&sha256(text.as_bytes())))));
        notes.push(("Surface", format!("{}: {}", plan.name, plan.describe())));
    }
    if plan.realisations > 1 {
        notes.push(("Realisation", realisation.to_string()));
    }
    let inputs = plan.inputs();
    if inputs.is_empty() {
        notes.push(("Seed", seed.to_string()));
    }
    for input in inputs {
        let sum = sha256_of_file(&input)
            .map_err(|error| InputError::file(&input, format!("cannot be read: {error}")))?;
        notes.push(("File", format!("{}, SHA-256 {}", name(&input), hexadecimal(&sum))));
    }
    Ok(notes)
}

/// The steps of a preparation up to one of them, as keys of a spec.
pub(super) fn described(preparation: &Preparation, last: Step) -> String {
    let until = Step::ALL.iter().position(|step| *step == last).unwrap_or_default();
    let key = |step: &Step| match step {
        Step::Measured => None,
        Step::SpikesRemoved => Some("outliers = \"remove\"".to_owned()),
        Step::LinesAligned => Some(format!("align-lines = \"{}\"", preparation.aligned?.name())),
        Step::Eroded => Some(format!("tip = \"{:e} m\"", preparation.tip?)),
        Step::Levelled => Some(format!("level = \"{}\"", preparation.level.name())),
        Step::Filtered => {
            let filter = preparation.filter?;
            let index = |name, index: Option<f64>| index.map(|index| format!("{name} = \"{index:e} m\""));
            let indices: Vec<String> =
                [index("s", filter.s()), index("l", filter.l())].into_iter().flatten().collect();
            Some(format!("filter = {{ {} }}", indices.join(", ")))
        }
    };
    let done = Step::ALL[..=until].iter().filter(|step| preparation.has(**step));
    let keys: Vec<String> = done.filter_map(key).collect();
    if keys.is_empty() { format!("level = \"{}\"", Level::None.name()) } else { keys.join(", ") }
}
