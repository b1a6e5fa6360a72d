//! Where an export comes from: the surface that is chosen of a spec or a file, and what is said of it.

use std::path::Path;

use asperity::surface::{Preparation, Step};
use asperity::topography::Level;
use asperity::topography::read::is_named_as_map;
use asperity::topography::write::Note;
use asperity_contact_framework::digest::{hexadecimal, sha256, sha256_of_file};
use asperity_contact_framework::input::InputError;

use super::identifier;
use crate::surface::{FileOptions, SurfacePlan};

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
