//! Full description of the surfaces of a spec, without any contact: `experiment surface SPEC`; and what is hardly meant by its numbers.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Instant;

use asperity::surface::{AnalysisDepth, Surface};
use asperity::topography::{RoughnessParameters, Rows};
use asperity::work::Counter;
use asperity::{AsperityList, Population, Statistics};
use asperity_contact_framework::input::{InMemory, InputError, Source, SpecFile};
use asperity_contact_framework::metadata::{Metadata, Timing};
use asperity_contact_framework::progress::Silent;
use asperity_contact_framework::report::answer::fitting;
use asperity_contact_framework::report::format::{count, input_quantity, number, quantity};
use asperity_contact_framework::report::page::{Page, escape_around_code};
use asperity_contact_framework::report::sections;
use asperity_contact_framework::report::table::{Table, Tables};
use asperity_contact_framework::{Memory, Outcome, Plan, RunContext};
use serde_json::{Map, Value, json};

use super::plan::{MapPlan, Origin, SurfacePlan};
use super::rows::SurfaceRow;
use super::section::section;
use super::{SurfaceFactory, describe, files_of, fitness, inputs, memory, rows, section, surfaces, warnings};

pub struct SurfacesPlan {
    surfaces: Vec<SurfacePlan>,
    file: PathBuf,
}

impl SurfacesPlan {
    pub fn new(spec: &SpecFile) -> Result<Self, InputError> {
        let surfaces = surfaces(spec, None, 0..0, false)?;
        Ok(Self { file: spec.source.path.clone(), surfaces })
    }
}

impl fmt::Display for SurfacesPlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        describe(&self.surfaces, f)
    }
}

impl Plan for SurfacesPlan {
    fn inputs(&self) -> Vec<PathBuf> {
        inputs(&self.surfaces)
    }

    fn memory(&self) -> Memory {
        memory(&self.surfaces, AnalysisDepth::Everything, false)
    }

    fn work(&self) -> u128 {
        0
    }

    fn run(&self, context: &RunContext) -> Result<Box<dyn Outcome>, InputError> {
        let start = Instant::now();
        let mut timing = Timing::default();
        context.progress.steps(self.surfaces.len() as u64);
        let counter = Counter::default();
        let mut files = files_of(&self.surfaces, &counter);
        let mut seen = Vec::new();
        for surface in &self.surfaces {
            let mut factory = SurfaceFactory::new(surface, context, &counter).of_any(true);
            seen.push(factory.make(1, AnalysisDepth::Everything, &mut files, &mut timing)?);
            context.progress.step();
        }
        timing.total = start.elapsed();
        let papers = seen.iter().flat_map(Surface::papers).collect();
        Ok(Box::new(SurfacesResults {
            metadata: context.metadata(papers, timing, Some(counter.work())),
            file: self.file.clone(),
            surfaces: seen,
        }))
    }
}

impl Outcome for SurfacesResults {
    fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    fn warnings(&self) -> Vec<String> {
        warnings(&self.surfaces)
    }

    fn tables(&self) -> Vec<Table> {
        rows::tables(self.surfaces.iter().map(SurfaceRow::new))
    }

    fn page(&self, tables: &Tables) -> Page {
        page(self, tables)
    }

    /// The key `looked_at` is the contract of older reports.
    fn facts(&self) -> serde_json::Result<Map<String, Value>> {
        let mut facts = Map::new();
        facts.insert("looked_at".to_owned(), json!(self.file));
        facts.insert("surfaces".to_owned(), rows::records(self.surfaces.iter().map(SurfaceRow::new)));
        Ok(facts)
    }

    fn terminal(&self) -> Option<String> {
        let texts =
            self.surfaces.iter().map(|surface| format!("\n{}", section::for_terminal(surface).trim_end()));
        Some(texts.collect::<Vec<_>>().join("\n"))
    }
}

/// The file that the report in `folder` describes; `None` if there is no such report.
pub fn described_file(folder: &Path) -> Option<PathBuf> {
    #[derive(serde::Deserialize)]
    struct Report {
        looked_at: PathBuf,
    }
    let summary = std::fs::read(folder.join("summary.json")).ok()?;
    serde_json::from_slice::<Report>(&summary).ok().map(|report| report.looked_at)
}

#[derive(Debug)]
pub struct SurfacesResults {
    pub metadata: Metadata,
    pub file: PathBuf,
    pub surfaces: Vec<Surface>,
}

fn page(results: &SurfacesResults, tables: &Tables) -> Page {
    let mut page = Page::new(&results.metadata.title);
    page.lead(&escape_around_code(&answer(&results.surfaces)));
    sections::warnings(&mut page, &results.warnings());
    for surface in &results.surfaces {
        let which = match surface.realisations {
            1 => String::new(),
            count => format!(", the first of {count} {}", surface.repeats.name()),
        };
        page.heading(2, &format!("Surface {}{which}", surface.name));
        section(&mut page, tables, surface, None);
        if surface.map.as_ref().is_some_and(|map| map.whole.spectrum.is_none()) {
            page.paragraph("No spectrum: the map is too large.");
        }
    }
    sections::notes(&mut page, &results.metadata);
    sections::run_again(&mut page, &results.metadata, None);
    page.paragraph(&sections::provenance(&results.metadata));
    sections::sources(&mut page, &results.metadata);
    page
}

/// Whether the maps may carry a verdict; of one surface what it is.
fn answer(surfaces: &[Surface]) -> String {
    let maps = surfaces.iter().filter(|surface| surface.map.is_some()).count();
    let unfit: Vec<&Surface> = surfaces.iter().filter(|surface| surface.is_blocked()).collect();
    let fitness = match (&unfit[..], maps) {
        (_, 0) => String::new(),
        ([only], 1) => format!(" {}", fitting(fitness::in_short(only))),
        ([], 1) => " The map is fit.".to_owned(),
        ([], _) => " All maps are fit.".to_owned(),
        (some, maps) => format!(" {} of {maps} maps are not fit.", some.len()),
    };
    match surfaces {
        [Surface { unscattered: Some(reason), .. }] => {
            format!("Neither model applies: the map {}.{fitness}", fitness::without_advice(reason))
        }
        [only] => format!(
            "{} asperities of mean radius {}, heights with σ = {}.{fitness}",
            count(only.set.count()),
            quantity(only.statistics.mean_radius, "m"),
            quantity(only.statistics.sigma, "m")
        ),
        several => format!("{} surfaces.{fitness}", several.len()),
    }
}

/// R.m.s. slopes of a map below those of any polished surface.
const LEAST_SLOPE: f64 = 1e-5;

/// Density times mean radius times standard deviation of the heights of asperities, which is 0.01 to 0.1 on rough surfaces;
/// a prefix of a square that is missing makes it a million times smaller.
const LEAST_PRODUCT: f64 = 1e-6;

impl SurfacePlan {
    /// The error at the key that is probably in another unit, where a load is not reached as `message` says; `None` of a
    /// surface that can be. Files are read again.
    pub fn implausible_unit(&self, source: &Source, message: &str) -> Option<InputError> {
        match &self.origin {
            Origin::Map(map) => self.of_map(map, source, message),
            Origin::Population { population: Population { radius, sigma, density, .. }, .. } => {
                let product = density * radius * sigma;
                let words = format!(
                    "found a density of {}, a radius of {} and a sigma of {}",
                    quantity(*density, "1/m²"),
                    quantity(*radius, "m"),
                    quantity(*sigma, "m")
                );
                self.of_asperities(source, ["population", "density"], "/mm^2", product, &words, message)
            }
            Origin::List { path, given, nominal_area, .. } => {
                let list = match source.content_in_memory(path) {
                    Some(InMemory::List(list)) => AsperityList::clone(list),
                    _ => AsperityList::read(path, *given, &Silent).ok()?,
                };
                let density = list.count() as f64 / nominal_area;
                let statistics = Statistics::new(&list.set(*nominal_area).ok()?);
                let product = density * statistics.mean_radius * statistics.sigma;
                let words = format!(
                    "found a density of {}, a mean radius of {} and a standard deviation of heights of {}",
                    quantity(density, "1/m²"),
                    quantity(statistics.mean_radius, "m"),
                    quantity(statistics.sigma, "m")
                );
                self.of_asperities(source, ["asperities", "nominal-area"], "mm^2", product, &words, message)
            }
            Origin::Generated(_) | Origin::Pair(_) => None,
        }
    }

    fn of_map(&self, map: &MapPlan, source: &Source, message: &str) -> Option<InputError> {
        let slope = match source.content_in_memory(&map.file.path) {
            Some(InMemory::Map { rows, .. }) => rms_slope(&**rows),
            _ => rms_slope(&*map.file.rows(&Silent).ok()?),
        };
        if slope >= LEAST_SLOPE {
            return None;
        }
        let value = |key| source.value_at(&["surface", &self.name, "file", key]);
        let is_bare = |(_, text): &(_, &str)| text.parse::<f64>().is_ok();
        let (span, written) = match (value("pixel").filter(is_bare), value("unit")) {
            (Some((span, text)), _) => (span, remedy("pixel", text, "um", "m")),
            (None, Some((span, _))) => {
                (span, "check `unit`: the heights of the file may be in metres already".to_owned())
            }
            (None, None) => {
                (value("pixel").or_else(|| value("path"))?.0, "check `pixel` and `unit`".to_owned())
            }
        };
        let found = format!(
            "found an r.m.s. slope of {} with a pixel of {}: less than that of any polished surface, so that a load is not reached; \
             heights and pixel are probably in different units; {written}. {message}",
            number(slope),
            input_quantity(map.pixel[0], "m"),
        );
        Some(source.error_at(span, found))
    }

    /// The error at the key of a density or an area, where asperities are too few, too sharp or too even for a rough surface.
    fn of_asperities(
        &self,
        source: &Source,
        [kind, key]: [&str; 2],
        unit: &str,
        product: f64,
        words: &str,
        message: &str,
    ) -> Option<InputError> {
        if product >= LEAST_PRODUCT {
            return None;
        }
        let (span, text) = source.value_at(&["surface", &self.name, kind, key])?;
        let si = if key == "density" { "1/m²" } else { "m²" };
        let found = format!(
            "{words}: their product is {}, on rough surfaces 0.01 to 0.1, so that a load is not reached; {}, and check the other two. \
             {message}",
            number(product),
            remedy(key, text, unit, si),
        );
        Some(source.error_at(span, found))
    }
}

fn rms_slope(map: &dyn Rows) -> f64 {
    RoughnessParameters::new(map).rms_slope()
}

/// What to write instead of the `text` of a key.
fn remedy(key: &str, text: &str, unit: &str, si: &str) -> String {
    match text.parse::<f64>() {
        Ok(number) => {
            format!(
                "a bare number is in {si}; if you mean {number} {unit}, write {key} = \"{number} {unit}\""
            )
        }
        Err(_) => format!("check the unit of `{key}`"),
    }
}
