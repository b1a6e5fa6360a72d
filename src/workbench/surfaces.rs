//! A surface of a spec as the page shows it.

use std::sync::Arc;

use asperity::surface::AnalysisDepth;
use asperity::work::Counter;
use asperity_contact_framework::input::{InputError, SpecFile};
use asperity_contact_framework::metadata::Timing;
use asperity_contact_framework::progress::Progress;
use asperity_workbench::{Refused, SpecText};

use super::{refused, source};
use crate::experiment::tables;
use crate::surface::{OfSpec, StoredSurface, SurfaceFactory, SurfaceStore, Surfaces, files_of, surfaces};

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
