//! `[sweep]`: an experiment for several values of some of its keys, in one report.
//!
//! | module | what lives there |
//! |---|---|
//! | `spec` | the table of a spec |
//! | `plan` | variations, each an experiment of its own |
//! | `run` | each variation once, kept as soon as it is there |
//! | `find` | where a quantity is a given one, or a verdict changes |
//! | `results` | one tidy table, where the answer changes |
//! | `figures`, `outline` | the report |

mod figures;
mod find;
mod outline;
mod plan;
mod results;
mod run;
mod spec;

use std::path::PathBuf;

use asperity_contact_framework::input::{InputError, Source, Spanned, SpecFile};
use asperity_contact_framework::report::table::{Heading, Schema};
use asperity_contact_framework::{Divided, Kind, Memory, Outcome, Plan, RunContext};
use plan::SweepPlan;
use results::{ChangeRow, CrossingRow, FILE, ROWS};
use run::{Found, Run};
use toml::Table;

use crate::experiment::tables;
use crate::kind::KINDS;
use crate::kind::compare::Compare;

pub const NAME: &str = "sweep";

pub struct Sweep;

impl Sweep {
    /// What a sweep has of an experiment of a kind: the columns of the one table.
    fn schema_of(kind: &str) -> Option<Schema> {
        let kind = KINDS.iter().find(|known| known.name == kind)?;
        Some(Schema { file: FILE, rows: ROWS, records: None, is_long: false, ..(kind.swept)()? })
    }
}

/// The variations of a spec with a sweep: the values of its keys, and its spec without the sweep.
pub fn variations(source: Source) -> Result<Vec<[Table; 2]>, InputError> {
    let spec = SpecFile::parse(source, &tables())?;
    let plan = SweepPlan::new(&spec, &spec.required_table(NAME)?)?;
    let one = |variation: &plan::Variation| {
        let keys = plan.keys.iter().zip(&variation.places);
        let values = keys.map(|(key, &place)| (key.name.clone(), key.values[place].clone())).collect();
        let table = plan.spec(&variation.places);
        Ok([values, table.map_err(|message| InputError::file(&spec.source.path, message))?])
    };
    plan.variations.iter().map(one).collect()
}

impl Kind for Sweep {
    const NAME: &'static str = NAME;
    type Spec = spec::SweepSpec;
    type Plan = SweepPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>) -> Result<SweepPlan, InputError> {
        SweepPlan::new(file, table)
    }

    /// The one table has the columns of the kind that is swept; listed are those of all kinds.
    fn tables() -> Vec<Schema> {
        tables_of(KINDS.iter().filter_map(|kind| Self::schema_of(kind.name)))
    }
}

/// The tables of a sweep of comparisons, as documentation lists them.
pub fn documented() -> Vec<Schema> {
    tables_of(Sweep::schema_of(Compare::NAME))
}

/// The tables of a sweep whose one table has the columns of any of some schemas.
fn tables_of(schemas: impl IntoIterator<Item = Schema>) -> Vec<Schema> {
    let mut columns: Vec<Heading> = Vec::new();
    for heading in schemas.into_iter().flat_map(|schema| schema.columns) {
        if columns.iter().all(|known| known.name != heading.name) {
            columns.push(heading);
        }
    }
    let one = Schema { file: FILE, rows: ROWS, records: None, is_long: false, columns };
    vec![one, Schema::of::<ChangeRow>(), Schema::of::<CrossingRow>()]
}

impl Plan for SweepPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        self.inputs()
    }

    fn memory(&self) -> Memory {
        self.memory()
    }

    fn work(&self) -> u128 {
        self.work()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        let run = Run::new(self, context);
        let found = run.variations(0..self.variations.len())?;
        Ok(Box::new(run.finish(&found)?))
    }

    fn divided(&self) -> Option<&dyn Divided> {
        Some(self)
    }
}

/// A task is a variation.
impl Divided for SweepPlan {
    fn tasks(&self) -> usize {
        self.variations.len()
    }

    fn passes(&self) -> usize {
        1
    }

    fn run_task(&self, context: &RunContext, task: usize, _: &[Vec<String>]) -> Result<String, InputError> {
        let found = Run::new(self, context).variations(task..task + 1)?;
        serde_json::to_string(&found).map_err(|error| InputError::file(&context.source.path, error))
    }

    fn results(&self, context: &RunContext, passes: &[Vec<String>]) -> Result<Box<dyn Outcome>, InputError> {
        let found: Result<Vec<Vec<Found>>, _> =
            passes.iter().flatten().map(|text| serde_json::from_str(text)).collect();
        let found = found.map_err(|error| InputError::file(&context.source.path, error))?;
        Ok(Box::new(Run::new(self, context).finish(&found.concat())?))
    }
}
