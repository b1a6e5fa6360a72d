//! `[coverage]`: how often 95 % intervals hold the mean over many windows of one endless surface.

mod figures;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Group, Kind, Outcome, Reads};
use asperity_contact_framework::{Memory, Plan, RunContext};

use crate::coverage::WINDOWS_PER_MAP;
use plan::{CasePlan, CoveragePlan};

/// `[coverage]`
pub struct IntervalCoverage;

impl Kind for IntervalCoverage {
    const NAME: &'static str = "coverage";
    const GROUP: Option<Group> = Some(Group::Trust);
    const READS: Reads = Reads { materials: true, surfaces: false };
    type Spec = spec::CoverageSpec;
    type Plan = CoveragePlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<CoveragePlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        vec![
            Schema::of::<rows::ProcessRow>(),
            Schema::of::<rows::CoverageRow>(),
            Schema::of::<rows::VerdictRow>(),
            Schema::of::<rows::CheckRow>(),
            Schema::of::<rows::SpikeRow>(),
        ]
    }
}

impl Plan for CoveragePlan {
    fn memory(&self) -> Memory {
        /// The map, its patches, its windows, and what the autocorrelation of one takes.
        const BYTES_PER_POINT: u128 = 48;
        let map = (2 * self.windows.points as u128).pow(2);
        Memory { bytes: map * BYTES_PER_POINT * rayon::current_num_threads() as u128, key: None }
    }

    fn work(&self) -> u128 {
        /// Areas of a square of the shortest wavelength per summit.
        const SQUARES_PER_SUMMIT: f64 = 4.0;
        /// Without each of 16 blocks, and with all.
        const EVALUATIONS: f64 = 17.0;
        /// Separations per load, most of them in its search.
        const SEPARATIONS: f64 = 10.0;
        let summits = (self.windows.side() / self.windows.cut_off).powi(2) / SQUARES_PER_SUMMIT;
        /// Times a window costs under all treatments.
        const TREATMENTS: f64 = 6.0;
        let of_maps = |case: &CasePlan, maps: f64| (WINDOWS_PER_MAP * case.contacts.len()) as f64 * maps;
        let studied = self.windows.studied_maps as f64;
        let own: f64 =
            self.cases.iter().map(|case| of_maps(case, case.maps as f64 + TREATMENTS * studied)).sum();
        let spiked = self.spikes.as_ref().map_or(0.0, |spikes| {
            let studies = (spikes.maps * (1 + spikes.planted.len())) as f64;
            of_maps(&self.cases[spikes.case], TREATMENTS * studies)
        });
        ((own + spiked) * summits * EVALUATIONS * SEPARATIONS) as u128
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
