//! `[solver-validation]`: the boundary element solver against closed forms, exact solutions and a published ensemble.

mod claims;
mod figures;
mod outline;
mod plan;
mod results;
mod rows;
mod run;
mod spec;

use asperity::bem::Boundary;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};
use asperity_contact_framework::report::table::Schema;
use asperity_contact_framework::{Group, Kind, Outcome, Reads};
use asperity_contact_framework::{Memory, Plan, RunContext};

use crate::kind::boundary_elements::contact_memory;
use crate::solver::ensemble::EnsembleTask;
use crate::solver::grid::{GridCase, GridTask};
use crate::solver::work::WorkTask;
use crate::solver::{LAYERED_CASES, sphere_points};
use plan::SolverPlan;

/// `[solver-validation]`
pub struct SolverValidation;

impl Kind for SolverValidation {
    const NAME: &'static str = "solver-validation";
    const GROUP: Option<Group> = Some(Group::Trust);
    const READS: Reads = Reads { materials: false, surfaces: false };
    type Spec = spec::SolverSpec;
    type Plan = SolverPlan;

    fn plan(file: &SpecFile, table: &Spanned<Self::Spec>, _: bool) -> Result<SolverPlan, InputError> {
        plan::plan(file, table)
    }

    fn tables() -> Vec<Schema> {
        rows::schemas()
    }
}

impl Plan for SolverPlan {
    fn memory(&self) -> Memory {
        let spheres = self.hertz.iter().chain(&self.layered);
        let spheres = spheres.map(|&pixels| contact_memory(sphere_points(pixels), Boundary::Finite));
        let of_ensemble = self.ensemble.iter().flat_map(|task| &task.points);
        let of_work = self.work.iter().flat_map(|task| &task.points);
        let of_grid = self.grid.iter().map(|task| &task.points);
        let rough = of_ensemble
            .chain(of_work)
            .chain(of_grid)
            .map(|&points| contact_memory(points, Boundary::Periodic));
        Memory { bytes: spheres.chain(rough).max().unwrap_or(0), key: None }
    }

    /// Points of all maps that are solved, times the convolutions of each: about as many micro-contacts would take as long.
    fn work(&self) -> u128 {
        const CONVOLUTIONS: u128 = 50;
        let points = |sides: &[usize], contacts: usize| {
            contacts as u128 * sides.iter().map(|&side| (side as u128).pow(2)).sum::<u128>()
        };
        let layered = self.layered.map_or(0, |pixels| points(&[pixels], LAYERED_CASES.len()));
        let of_ensemble =
            |task: &EnsembleTask| points(&task.points, task.realisations * task.pressures.len());
        let of_work = |task: &WorkTask| points(&task.points, task.pressures.len());
        // A fine grid, and coarser ones with about a fifth as many points.
        let of_grid = |task: &GridTask| {
            let contacts = GridCase::ALL.len() * task.realisations * task.pressures.len();
            points(&[task.points], contacts) * 6 / 5
        };
        let rough = self.ensemble.as_ref().map_or(0, of_ensemble)
            + self.grid.as_ref().map_or(0, of_grid)
            + self.work.as_ref().map_or(0, of_work);
        CONVOLUTIONS * (25 * (points(&self.hertz, 1) + layered) + rough)
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        Ok(Box::new(run::run(context, self)?))
    }
}
