//! `[precision]`: run time against error.

mod outline;
mod plan;
mod run;
mod spec;
mod rows;

use asperity_framework::contact::ContactSummary;
use asperity_framework::input::{InputError, Spanned, SpecFile};
use asperity_framework::metadata::Metadata;
use asperity_framework::report::Page;
use asperity_framework::report::table::{Schema, Table, Tables};
use asperity_framework::{Kind, Outcome, Planned, Reads, fields};
use serde_json::{Map, Value};

use plan::PrecisionPlan;
use run::PrecisionResults;

/// `[precision]`
pub struct Precision;

impl Kind for Precision {
    const NAME: &'static str = "precision";
    const IS_TIMED: bool = true;
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::PrecisionSpec;
    type Plan = PrecisionPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, full: bool) -> Result<PrecisionPlan, InputError> {
        plan::plan(file, table, full)
    }

    fn planned(plan: PrecisionPlan) -> Planned {
        let variant = if plan.full { "full" } else { "" };
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
