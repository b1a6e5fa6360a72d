//! What the program is to the workbench: specs checked, surfaces described, contacts computed stage by stage, reports written.

mod begin;
mod view;

use std::path::Path;
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use asperity::surface::AnalysisDepth;
use asperity::topography::read::is_named_as_map;
use asperity::work::Counter;
use asperity_contact_framework::input::{InputError, Source, SpecFile};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::{Progress, Silent};
use asperity_contact_framework::remedy::FrontEnd;
use asperity_contact_framework::report::store::Store;
use asperity_contact_framework::report::table::Tables;
use asperity_contact_framework::{Outcome, folder as report_folder};
use asperity_workbench::engine::Heights;
use asperity_workbench::{Engine, Example, Prepared, Refused, SpecText, Stage};
use serde_json::{Value, json};

use crate::experiment::{Experiment, tables, write_index};
use crate::kind::compare::spec::ComparePlan;
use crate::kind::compare::{Extent, Samplings, Scope, run_within};
use crate::surface::{
    OfSpec, StoredSurface, SurfaceFactory, SurfaceStore, Surfaces, files_of, memory, surfaces,
};

#[derive(Default)]
pub struct Workbench {
    surfaces: Arc<Surfaces>,
}

/// A text of the page as the source of a spec, whose files lie in the folder of the workbench.
fn source(spec: &SpecText) -> Source {
    Source::in_memory(&spec.folder, spec.text.clone()).confined_to(&spec.root).read_in(FrontEnd::Workbench)
}

/// An error at its key, without the name of the file that the page is; other files are named from the folder of the workbench.
fn refused(error: &InputError, spec: &SpecText) -> Refused {
    let root = format!("{}{}", spec.root.display(), std::path::MAIN_SEPARATOR);
    Refused { key: error.key().map(str::to_owned), message: error.message().replace(&root, "") }
}

impl Engine for Workbench {
    fn vocabulary(&self) -> Value {
        begin::vocabulary()
    }

    fn is_surface(&self, path: &Path) -> bool {
        is_named_as_map(path)
    }

    fn kind(&self, text: &str) -> Option<(String, String)> {
        begin::kind(text)
    }

    fn begin(&self, file: &Path, path: &str) -> Result<(String, Vec<String>), Refused> {
        begin::spec_of(file, path)
    }

    fn picture(&self, file: &Path, most: usize) -> Result<Heights, Refused> {
        begin::picture(file, most)
    }

    fn prepare(&self, spec: &SpecText) -> Result<Box<dyn Prepared>, Refused> {
        let contact =
            Contact::new(spec, Arc::clone(&self.surfaces)).map_err(|error| refused(&error, spec))?;
        Ok(Box::new(contact))
    }

    fn surface(&self, spec: &SpecText, name: &str, progress: &dyn Progress) -> Result<Value, Refused> {
        let surface = surface(&self.surfaces, spec, name, progress)?;
        Ok(view::surface(&surface.surface))
    }

    fn heights(
        &self,
        spec: &SpecText,
        name: &str,
        most: usize,
        progress: &dyn Progress,
    ) -> Result<Heights, Refused> {
        let surface = surface(&self.surfaces, spec, name, progress)?;
        let prepared = surface.surface.prepared.as_ref();
        let map = prepared.ok_or_else(|| Refused::new(format!("{name}: found no height map")))?;
        Ok(view::heights(&map.map, most))
    }

    fn report(
        &self,
        path: &Path,
        root: &Path,
        out: &Path,
        progress: &dyn Progress,
    ) -> Result<String, Refused> {
        let input = |error: InputError| Refused::new(error.to_string());
        let failed = |error: &dyn std::fmt::Display| Refused::new(error.to_string());
        let experiment = Experiment::read_confined(path, root).map_err(input)?;
        let content = experiment.watched_input(progress).map_err(input)?;
        let key = experiment.key_of(&content);
        let mut store = Store::new(out);
        store.recover().map_err(|error| failed(&error))?;
        if !store.is_current(experiment.stem(), &key) {
            store.check(experiment.stem()).map_err(|error| failed(&error))?;
            let report = |results: &dyn Outcome, key: &str| report_folder(results, key);
            let (report, _) = experiment.run_on(Some(content), None, progress, report).map_err(input)?;
            store.write(&report.map_err(|error| failed(&error))?).map_err(|error| failed(&error))?;
        }
        write_index(&mut store, out).map_err(|error| failed(&error))?;
        Ok(experiment.stem().to_owned())
    }

    fn forget(&self) {
        self.surfaces.forget();
    }

    fn example(&self) -> Example {
        begin::EXAMPLE
    }
}

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

/// The first realisation of one surface of a spec, in full.
pub fn surface(
    all: &Surfaces,
    spec: &SpecText,
    name: &str,
    progress: &dyn Progress,
) -> Result<Arc<StoredSurface>, Refused> {
    let refuse = |error: InputError| refused(&error, spec);
    let file = SpecFile::parse(source(spec), &tables()).map_err(refuse)?;
    // Ellipses, which some laws need, do not change what is shown.
    let plans = surfaces(&file, None, 0..0, false).map_err(refuse)?;
    let found = plans.iter().find(|plan| plan.name == name);
    let plan = found.ok_or_else(|| Refused::new(format!("found no surface \"{name}\" in the spec")))?;
    let of_spec = OfSpec::new(all, &spec.folder, &spec.text);
    let identity = of_spec.identity(plan);
    if let Some(kept) = of_spec.get(&identity) {
        return Ok(kept);
    }
    let counter = Counter::default();
    let (mut files, mut timing) = (files_of(std::slice::from_ref(plan), &counter), Timing::default());
    let mut factory = SurfaceFactory::from_seed(plan, &file.source, file.seed, &counter, progress)
        .with_store(Some(&of_spec))
        .of_any(true);
    let surface = factory.make(1, AnalysisDepth::Everything, &mut files, &mut timing).map_err(refuse)?;
    Ok(of_spec.get(&identity).unwrap_or_else(|| Arc::new(factory.stored(surface))))
}
