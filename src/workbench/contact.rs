//! An experiment on its way from a slider to its whole report.

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use asperity::surface::AnalysisDepth;
use asperity::work::Counter;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::progress::{Progress, Silent};
use asperity_contact_framework::report::table::Tables;
use asperity_workbench::{Prepared, Refused, SpecText, Stage};
use serde_json::{Value, json};

use super::{refused, source, view};
use crate::experiment::Experiment;
use crate::kind::compare::plan::ComparePlan;
use crate::kind::compare::{Extent, Samplings, Scope, run_within};
use crate::surface::{OfSpec, Surfaces, memory};

/// The name of its report, which is not written.
const NAME: &str = "workbench";

/// An experiment whose spec is checked.
pub struct Contact {
    experiment: Experiment,
    /// A comparison, which has stages; `None` of an experiment of another kind.
    compare: Option<Arc<ComparePlan>>,
    spec: SpecText,
    surfaces: Arc<Surfaces>,
    samplings: Samplings,
}

impl Contact {
    pub fn new(spec: &SpecText, surfaces: Arc<Surfaces>) -> Result<Self, InputError> {
        let (experiment, compare) = Experiment::with_comparison(source(spec), NAME, &Silent)?;
        Ok(Self { experiment, compare, spec: spec.clone(), surfaces, samplings: Samplings::default() })
    }
}

impl Prepared for Contact {
    /// Surfaces are made in full, so that they can be shown and kept.
    fn memory(&self) -> u128 {
        let in_full = |compare: &Arc<ComparePlan>| {
            memory(&compare.study.surfaces, AnalysisDepth::Everything, false).bytes
        };
        self.experiment.memory().max(self.compare.as_ref().map_or(0, in_full))
    }

    fn inputs(&self) -> Value {
        let since =
            |time: SystemTime| time.duration_since(UNIX_EPOCH).map_or(0.0, |since| since.as_secs_f64());
        let files = self.experiment.modified().into_iter();
        files.map(|file| file.map(|(time, bytes)| (since(time), bytes))).map(|file| json!(file)).collect()
    }

    fn stages(&self) -> &'static [Stage] {
        match &self.compare {
            Some(compare) if compare.goes_on() => &[Stage::Models, Stage::Intervals, Stage::Everything],
            Some(_) => &[Stage::Models, Stage::Intervals],
            None => &[Stage::Everything],
        }
    }

    fn run(&self, stage: Stage, progress: &dyn Progress) -> Result<Value, Refused> {
        let Some(compare) = &self.compare else {
            let outcome = self.experiment.run(progress).map_err(|error| refused(&error, &self.spec))?;
            let tables = Tables::new(outcome.tables());
            return Ok(view::page(outcome.page(&tables), outcome.warnings()));
        };
        let extent = match stage {
            Stage::Models => Extent::Models,
            Stage::Intervals => Extent::Intervals,
            Stage::Everything => Extent::Everything,
        };
        let of_spec = OfSpec::new(&self.surfaces, &self.spec.folder, &self.spec.text);
        let scope = Scope {
            extent,
            store: Some(&of_spec),
            samplings: Some(&self.samplings),
            pictures: view::MOST_CARDS,
        };
        // Nothing is written, so that its input needs no name.
        let context = self.experiment.context("", progress);
        let results = run_within(&context, compare, &Counter::default(), scope)
            .map_err(|error| refused(&error, &self.spec))?;
        Ok(view::comparison(&results, extent))
    }
}
