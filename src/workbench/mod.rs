//! What the program is to the workbench: specs checked, surfaces described, contacts computed stage by stage, reports written.
//!
//! | module | what lives there |
//! |---|---|
//! | `surfaces` | a surface of a spec |
//! | `contact` | an experiment on its way from a slider to its whole report |
//! | `view` | results as the page shows them |
//! | `begin` | the first spec of a file, and the example |

mod begin;
mod contact;
mod surfaces;
mod view;

use std::path::Path;
use std::sync::Arc;

use asperity::topography::read::is_named_as_map;
use asperity_contact_framework::input::{InputError, Source};
use asperity_contact_framework::progress::Progress;
use asperity_contact_framework::remedy::FrontEnd;
use asperity_contact_framework::report::store::Store;
use asperity_contact_framework::{Outcome, folder as report_folder};
use asperity_workbench::engine::Heights;
use asperity_workbench::{Engine, Example, Prepared, Refused, SpecText};
use contact::Contact;
use serde_json::Value;
use surfaces::surface;

use crate::experiment::{Experiment, write_index};
use crate::surface::Surfaces;

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
