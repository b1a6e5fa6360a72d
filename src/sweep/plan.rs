//! The plan of a sweep: its variations, each an experiment of its own, checked before any runs.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use asperity_contact_framework::input::{InputError, Source, Spanned, SpecFile};
use asperity_contact_framework::progress::Progress;
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Kind, Memory};
use toml::{Table, Value};

use super::find::Find;
use super::spec::{Combine, MOST, SweepSpec, SweptKey, set};
use super::{NAME, Sweep};
use crate::experiment::Experiment;
use crate::kind::compare::Compare;
use crate::kind::compare::spec::ComparePlan;

/// Tables and keys of a spec that no variation depends on, or that a sweep does not vary.
const NOT_VARIED: [&str; 7] = ["title", "notes", "figure", "run", "group", "tables", NAME];

/// A sweep that can be run.
pub struct SweepPlan {
    pub keys: Vec<SweptKey>,
    /// In order: the last key runs fastest.
    pub variations: Vec<Variation>,
    /// What is looked for between them.
    pub finds: Vec<Find>,
    /// The name of the kind that runs.
    pub kind: &'static str,
    pub schema: Schema,
    base: Base,
}

pub struct Variation {
    /// The place of the value of each key.
    pub places: Vec<usize>,
    pub case: VariedCase,
}

/// An experiment with other values of some keys.
pub struct VariedCase {
    pub experiment: Experiment,
    /// A comparison, which can share surfaces with others.
    pub comparison: Option<Arc<ComparePlan>>,
    pub text: String,
}

impl VariedCase {
    /// Whether it compares single surfaces, whose results need no mean.
    pub fn has_single_surfaces(&self) -> bool {
        let surfaces = self.comparison.iter().flat_map(|plan| &plan.study.surfaces);
        surfaces.map(|surface| surface.realisations).max() == Some(1)
    }
}

#[derive(Clone)]
pub struct Base {
    table: Table,
    source: Source,
}

impl Base {
    pub fn folder(&self) -> &Path {
        self.source.path.parent().unwrap_or(Path::new(""))
    }

    /// The experiment with other values at some keys.
    pub fn with(
        &self,
        progress: &dyn Progress,
        changes: impl FnOnce(&mut Table) -> Result<(), String>,
    ) -> Result<VariedCase, String> {
        /// What its report would be called.
        const STEM: &str = "variation";
        let mut table = self.table.clone();
        changes(&mut table)?;
        let text = table.to_string();
        let source = self.source.with_text(text.clone());
        let words = |error: InputError| match error.key() {
            Some(key) => format!("{key}: {}", error.message()),
            None => error.message().to_owned(),
        };
        let (experiment, comparison) = Experiment::with_comparison(source, STEM, progress).map_err(words)?;
        Ok(VariedCase { experiment, comparison, text })
    }
}

impl SweepPlan {
    /// Reads a sweep and plans all its variations.
    pub fn new(file: &SpecFile, sweep: &Spanned<SweepSpec>) -> Result<Self, InputError> {
        let source = &file.source;
        let at = |key: &str| {
            let value = source.value_at(&[NAME, key]);
            value.map_or_else(|| sweep.span(), |(span, _)| span)
        };
        let spec = sweep.get_ref();
        let combine = spec.combine().map_err(|message| source.error_at(at(super::spec::COMBINE), message))?;
        let mut keys = Vec::new();
        for (name, value) in spec.keys() {
            let refuse = |message: String| source.error_at(at(&name), format!("{name}: {message}"));
            let first = name.split('.').next().unwrap_or_default();
            if NOT_VARIED.contains(&first) {
                return Err(refuse(
                    "found a key that changes no result; allowed: seed, and keys of materials, surfaces and the experiment".to_owned(),
                ));
            }
            keys.push(SweptKey::new(name.clone(), &value).map_err(refuse)?);
        }
        if keys.is_empty() {
            let message = "found no key to vary; allowed: keys of this spec with their values, such as \"material.steel.hardness\" = [\"2 GPa\", \"4 GPa\"]";
            return Err(source.error_at(sweep.span(), message));
        }
        let choices = choices(&keys, combine).map_err(|message| source.error_at(sweep.span(), message))?;
        let base = Base::new(source)?;
        let mut variations = Vec::with_capacity(choices.len());
        for (number, places) in choices.into_iter().enumerate() {
            let put = |table: &mut Table| {
                put(table, &keys, &places)?;
                without_what_is_not_shown(table);
                Ok(())
            };
            let case = base.with(file.progress, put).map_err(|message| {
                let words = words(&keys, &places);
                source.error_at(at(&keys[0].name), format!("variation {} ({words}): {message}", number + 1))
            })?;
            variations.push(Variation { places, case });
        }
        let experiment = &variations[0].case.experiment;
        let kind = experiment.kind;
        let schema = Sweep::schema_of(kind).ok_or_else(|| {
            source
                .error_at(sweep.span(), format!("found [{kind}], which has no table; allowed: another kind"))
        })?;
        let finds = spec.find().and_then(|finds| {
            finds.into_iter().map(|find| Find::new(find, &keys, combine, kind)).collect::<Result<Vec<_>, _>>()
        });
        let finds = finds.map_err(|message| source.error_at(at(super::spec::FIND), message))?;
        Ok(Self { keys, variations, finds, kind, schema, base })
    }

    /// The experiment with the values of one of its variations, changed further.
    pub fn varied(
        &self,
        progress: &dyn Progress,
        places: &[usize],
        changes: impl FnOnce(&mut Table) -> Result<(), String>,
    ) -> Result<VariedCase, String> {
        self.base.with(progress, |table| {
            put(table, &self.keys, places)?;
            changes(table)
        })
    }

    /// The spec of a variation, as a run by itself takes it.
    pub fn spec(&self, places: &[usize]) -> Result<Table, String> {
        let mut table = self.base.table.clone();
        put(&mut table, &self.keys, places)?;
        Ok(table)
    }

    /// The folder that paths of the spec are relative to.
    pub fn folder(&self) -> &Path {
        self.base.folder()
    }

    /// The values of a variation in words.
    pub fn words(&self, places: &[usize]) -> String {
        words(&self.keys, places)
    }

    /// The files that any variation reads, each once.
    pub fn inputs(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> =
            self.variations.iter().flat_map(|variation| variation.case.experiment.inputs()).collect();
        files.sort();
        files.dedup();
        files
    }

    /// Number of variations that run at once: all threads where they fit, else one after the other.
    pub fn at_once(&self) -> usize {
        /// Bytes that variations side by side may need.
        const MOST_BYTES: u128 = 1 << 30;
        // Not those of the pool, which this would start before its size is set.
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        if self.largest() * threads as u128 <= MOST_BYTES { threads } else { 1 }
    }

    fn largest(&self) -> u128 {
        self.variations.iter().map(|variation| variation.case.experiment.memory()).max().unwrap_or(0)
    }

    /// Bytes that a run needs: of the variations that run at once, and of surfaces that are kept for the next ones.
    pub fn memory(&self) -> Memory {
        Memory { bytes: self.largest() * (self.at_once() as u128 + 1), key: None }
    }

    pub fn work(&self) -> u128 {
        self.variations.iter().map(|variation| variation.case.experiment.work()).sum()
    }
}

impl Base {
    fn new(source: &Source) -> Result<Self, InputError> {
        let table: Table = source.text.parse().map_err(|error| source.parse_error(&error))?;
        let is_varied = |name: &String| !NOT_VARIED.contains(&name.as_str());
        let mut table: Table = table.into_iter().filter(|(name, _)| is_varied(name)).collect();
        table.insert("title".to_owned(), Value::String("variation of a sweep".to_owned()));
        Ok(Self { table, source: source.clone() })
    }
}

/// Leaves out of a comparison what a sweep does not show of it, which is most of the work of many.
pub fn without_what_is_not_shown(table: &mut Table) {
    if let Some(compare) = table.get_mut(Compare::NAME).and_then(Value::as_table_mut) {
        for key in ["robustness", "attribution", "rank-models"] {
            compare.insert(key.to_owned(), Value::Boolean(false));
        }
        compare.remove("figure-of-paper");
    }
}

fn put(table: &mut Table, keys: &[SweptKey], places: &[usize]) -> Result<(), String> {
    keys.iter().zip(places).try_for_each(|(key, &place)| set(table, &key.name, key.values[place].clone()))
}

fn words(keys: &[SweptKey], places: &[usize]) -> String {
    let one = |(key, &place): (&SweptKey, &usize)| format!("{} = {}", key.name, key.words(place));
    keys.iter().zip(places).map(one).collect::<Vec<_>>().join(", ")
}

/// The places of the values in each variation.
fn choices(keys: &[SweptKey], combine: Combine) -> Result<Vec<Vec<usize>>, String> {
    let counts: Vec<usize> = keys.iter().map(|key| key.values.len()).collect();
    if combine == Combine::Zip {
        if counts.windows(2).any(|pair| pair[0] != pair[1]) {
            let found: Vec<String> =
                keys.iter().map(|key| format!("{} of {}", key.values.len(), key.name)).collect();
            return Err(format!(
                "found lists of different lengths ({}); allowed: equal lengths with combine = \"zip\"",
                found.join(", ")
            ));
        }
        return Ok((0..counts[0]).map(|place| vec![place; keys.len()]).collect());
    }
    let of = counts.iter().try_fold(1usize, |product, count| product.checked_mul(*count));
    let of = of.filter(|of| *of <= MOST).ok_or_else(|| {
        format!("found more than {MOST} variations; allowed: fewer values, or combine = \"zip\"")
    })?;
    let place = |number: usize| {
        let mut rest = number;
        let mut places: Vec<usize> = counts
            .iter()
            .rev()
            .map(|count| {
                let place = rest % count;
                rest /= count;
                place
            })
            .collect();
        places.reverse();
        places
    };
    Ok((0..of).map(place).collect())
}

impl fmt::Display for SweepPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for key in &self.keys {
            let shown: Vec<String> = (0..key.values.len()).map(|place| key.words(place)).collect();
            writeln!(f, "  {}: {}", key.name, shown.join(", "))?;
        }
        writeln!(
            f,
            "  {} variations of [{}], {} at once; the first:",
            self.variations.len(),
            self.kind,
            self.at_once()
        )?;
        write!(f, "{}", self.variations[0].case.experiment.plan)
    }
}
