//! `[precision]`: run time against error.

mod outline;
mod plan;
mod rows;
mod run;
mod spec;

use asperity::bem::Boundary;
use asperity_contact_framework::contact::ContactSummary;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::Page;
use asperity_contact_framework::report::table::{Schema, Table, Tables};
use asperity_contact_framework::set_memory;
use asperity_contact_framework::{Group, Kind, Outcome, Planned, Reads, fields};
use asperity_contact_framework::{Memory, Plan, RunContext};
use serde_json::{Map, Value};

use crate::kind::boundary_elements::contact_memory;
use crate::precision::sum::POINTS;
use plan::PrecisionPlan;
use run::PrecisionResults;

/// `[precision]`
pub struct Precision;

impl Kind for Precision {
    const NAME: &'static str = "precision";
    const GROUP: Option<Group> = Some(Group::Trust);
    const IS_TIMED: bool = true;
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::PrecisionSpec;
    type Plan = PrecisionPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, huge: bool) -> Result<PrecisionPlan, InputError> {
        plan::plan(file, table, huge)
    }

    fn planned(plan: PrecisionPlan) -> Planned {
        let variant = if plan.huge { "huge" } else { "" };
        Planned { variant, ..Planned::new(plan) }
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Outcome for PrecisionResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        self.contact.caveats.clone()
    }

    fn page(&self, tables: &Tables) -> Page {
        outline::page(self, tables)
    }

    fn tables(&self) -> Vec<Table> {
        rows::tables(self)
    }

    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        fields(&ContactSummary::new(&self.contact))
    }
}

impl Plan for PrecisionPlan {
    fn memory(&self) -> Memory {
        /// The map, its half spectrum, and what finding summits takes.
        const BYTES_PER_POINT: u128 = 32;
        let asperities = self.counts.iter().max().copied().unwrap_or(0);
        let maps = self.maps().map(|points| points * BYTES_PER_POINT);
        let contacts = self.hertz().map(|points| contact_memory(points, Boundary::Finite));
        let bytes = maps.chain(contacts).fold(set_memory(asperities as u128), u128::max);
        Memory { bytes, key: None }
    }

    /// In one pass over everything; a convolution of boundary elements counts as one contact per point.
    fn work(&self) -> u128 {
        const CONVOLUTIONS: u128 = 200;
        let sums = self.counts.iter().sum::<usize>() * POINTS * self.cases.len();
        sums as u128 + self.hertz().map(|points| CONVOLUTIONS * (points as u128).pow(2)).sum::<u128>()
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
