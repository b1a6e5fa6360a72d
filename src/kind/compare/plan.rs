//! `[compare]` resolved: laws on their bodies, layers, loads and surfaces.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;

use asperity::analytical::AnalyticalLine;
use asperity::compare::{Controls, Kind};
use asperity::study::LawContact;
use asperity::{ContactLaw, Flat, Material};
use asperity_framework::RunContext;
use asperity_framework::contact::Bodies;
use asperity_framework::input::Spanned;
use asperity_framework::input::accept::AcceptSpec;
use asperity_framework::input::{InputError, SpecFile};

use super::lines::lines;
use super::reference::ReferencePlan;
use super::reference::plan::{Resolved, reference};
use super::spec::{CompareSpec, Models};
use crate::layer::{LayerPlan, layer};
use crate::plausibility;
use crate::study::{Setup, StatisticalModel};
use crate::surface::{AnalysisDepth, SurfacePlan, describe, surfaces};

/// Both models on given surfaces.
pub struct ComparePlan {
    /// Names of the two bodies.
    pub bodies: Bodies,
    /// The rough body and the flat.
    pub pair: [Material; 2],
    /// The layer on the flat.
    pub layer: Option<Box<LayerPlan>>,
    /// The laws, each under every thickness of the layer.
    pub laws: Vec<LawContact>,
    /// The laws alone.
    pub law_specs: Vec<ContactLaw>,
    /// The models to run.
    pub models: Vec<Kind>,
    /// The reference beside them, where one is asked for.
    pub reference: Option<Box<ReferencePlan>>,
    /// Closed results beside the models.
    pub lines: Vec<AnalyticalLine>,
    /// The statistical model.
    pub statistical: StatisticalModel,
    /// Its position in the spec, for surfaces that it does not apply to.
    pub statistical_key: Option<Range<usize>>,
    /// The largest differences between the models that are accepted.
    pub accept: AcceptSpec,
    /// Whether the verdicts on measured maps are computed again under other treatments of the map.
    pub is_robustness_examined: bool,
    /// Whether the gap between the models is divided among its causes.
    pub is_attributed: bool,
    /// Whether all statistical models are compared with sum and reference.
    pub is_ranked: bool,
    /// What the surfaces are pressed to.
    pub controls: Controls,
    /// Position of pressures and forces in the spec, for errors about loads out of reach.
    pub load_keys: [Option<std::ops::Range<usize>>; 2],
    /// The surfaces.
    pub surfaces: Vec<SurfacePlan>,
    /// Warnings about materials and separations that are hardly meant, and maps too coarse for the reference.
    pub implausible: Vec<String>,
    /// The measured file that the command line named: its surface is described in full.
    pub described: Option<PathBuf>,
}

impl ComparePlan {
    /// How closely the first realisation of its surfaces is looked at.
    pub fn depth(&self) -> AnalysisDepth {
        if self.described.is_some() { AnalysisDepth::Everything } else { AnalysisDepth::Comparison }
    }

    /// What its models are run with.
    pub fn setup<'a>(&'a self, context: &RunContext<'a>) -> Setup<'a> {
        Setup {
            laws: &self.laws,
            law_specs: &self.law_specs,
            models: &self.models,
            statistical: &self.statistical,
            is_attributed: self.is_attributed,
            // A table for each of several thicknesses would have no reader.
            is_ranked: self.is_ranked && self.layer.as_ref().is_none_or(|layer| layer.thicknesses.len() == 1),
            controls: &self.controls,
            seed: context.seed,
            progress: context.progress,
        }
    }

    /// Whether some contact is under a layer of finite thickness: of a listed one, or of one at which the layer begins to
    /// matter, which is looked for at given loads.
    pub fn uses_rule(&self, layer: &LayerPlan) -> bool {
        let has_loads = !(self.controls.pressures.is_empty() && self.controls.forces.is_empty());
        layer.thicknesses.iter().any(|&t| t > 0.0 && (t.is_finite() || has_loads))
    }

    /// An estimate of the asperities and nodes that are evaluated.
    pub fn work(&self) -> u128 {
        let all = |surface: &SurfacePlan| surface.most_asperities() * surface.realisations as u128;
        let asperities: u128 = self.surfaces.iter().map(all).sum();
        asperities * (self.controls.points() * self.laws.len()) as u128
    }
}

impl fmt::Display for ComparePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let models: Vec<&str> = self.models.iter().map(|model| model.name()).collect();
        let laws: Vec<String> = self.law_specs.iter().map(ContactLaw::label).collect();
        writeln!(f, "  {} on {}, law {}", self.bodies.rough, self.bodies.flat, laws.join(", "))?;
        let each = match &self.layer {
            Some(layer) => {
                writeln!(f, "  under {layer}")?;
                "law, thickness and surface"
            }
            None => "law and surface",
        };
        let points = self.controls.points();
        let unit = if points == 1 { "point" } else { "points" };
        if !models.is_empty() {
            writeln!(f, "  {} at {points} {unit} a {each}", models.join(" and "))?;
        }
        describe(&self.surfaces, f)?;
        if let Some(reference) = &self.reference {
            reference.describe(&self.surfaces, f)?;
        }
        let surfaces = self.surfaces.iter().flat_map(SurfacePlan::implausible);
        self.implausible
            .iter()
            .cloned()
            .chain(surfaces)
            .try_for_each(|warning| writeln!(f, "  warning: {warning}"))
    }
}

/// Reads `[compare]`.
pub(super) fn plan(file: &SpecFile, table: &Spanned<CompareSpec>) -> Result<ComparePlan, InputError> {
    compared(file, table.get_ref(), table.span())
}

/// Both models on the one surface of `file`, which the command line named and which is described in full.
///
/// # Errors
/// As of any comparison.
pub fn described(file: &SpecFile) -> Result<ComparePlan, InputError> {
    let plan = plan(file, &file.required_table("compare")?)?;
    let described = plan.surfaces.first().and_then(SurfacePlan::input);
    Ok(ComparePlan { described, ..plan })
}

/// Resolves the table at `span`.
pub(crate) fn compared(
    file: &SpecFile,
    raw: &CompareSpec,
    span: Range<usize>,
) -> Result<ComparePlan, InputError> {
    let rough_name = &raw.rough.get_ref().0;
    let rough = file.body(rough_name, raw.rough.span())?;
    let flat = file.body(raw.flat.get_ref(), raw.flat.span())?;
    let controls = Controls {
        separations: raw.separation.as_ref().map(|sweep| sweep.0.clone()).unwrap_or_default(),
        pressures: raw.pressure.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
        forces: raw.force.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
        tolerances: raw.tolerance.0,
    };
    if controls.points() == 0 {
        return Err(file.source.error_at(
            span,
            "found no separation, pressure or force; allowed: at least one of separation, pressure, force",
        ));
    }
    let mut layer = raw.layer.as_ref().map(|raw| layer(file, raw, &flat).map(Box::new)).transpose()?;
    if raw.layer.as_ref().is_some_and(|raw| raw.thickness.stands_alone) {
        // One thickness is compared with none.
        layer.iter_mut().for_each(|layer| layer.add_uncoated());
    }
    let flats = match &layer {
        None => vec![(None, Flat::Bare(flat))],
        Some(layer) => {
            let on = |&t: &f64| layer.coating.flat(t).map(|flat| (Some(t), flat));
            let flats: Result<Vec<_>, _> = layer.thicknesses.iter().map(on).collect();
            flats.map_err(|error| InputError::file(&file.source.path, error))?
        }
    };
    let flat_name = raw.flat.get_ref();
    // Zero thickness needs no layer properties, infinite thickness no substrate properties.
    let coat = layer.as_deref().filter(|layer| layer.thicknesses.iter().any(|&t| t > 0.0));
    let feels_substrate =
        layer.as_deref().is_none_or(|layer| layer.thicknesses.iter().any(|t| t.is_finite()));
    let substrate = feels_substrate.then_some((flat_name.as_str(), &flat));
    let coat = coat.map(|layer| (layer.name.as_str(), &layer.coating.material));
    let flat_materials: Vec<_> = substrate.into_iter().chain(coat).collect();
    file.check_laws(&raw.law, (rough_name, &rough), &flat_materials)?;
    let mut implausible = plausibility::of_bodies((rough_name, &rough), &flat_materials);
    implausible.extend(plausibility::of_separations(&controls.separations));
    let law_specs = raw.law.get_ref().0.clone();
    let as_ellipses = law_specs.iter().any(ContactLaw::is_elliptic);
    let surfaces = surfaces(file, raw.surfaces.as_deref(), span, as_ellipses)?;
    let laws = file.law_plans(&raw.law, (rough_name, &rough), &flats, flat_name)?;
    let resolved = Resolved { rough: &rough, flats: &flats, laws: &laws, surfaces: &surfaces };
    let reference = reference(file, raw, &resolved)?.map(Box::new);
    implausible.extend(reference.iter().flat_map(|reference| reference.warnings(&surfaces)));
    let lines = lines(file, raw, &surfaces, reference.as_deref())?;
    Ok(ComparePlan {
        bodies: Bodies { rough: rough_name.clone(), flat: flat_name.clone() },
        pair: [rough, flat],
        law_specs,
        laws,
        layer,
        models: raw.models.as_ref().map_or_else(Models::default, |models| models.get_ref().clone()).kinds,
        reference,
        lines,
        statistical: statistical_model(file, raw)?,
        statistical_key: raw.statistical.as_ref().map(Spanned::span),
        accept: raw.accept,
        is_robustness_examined: raw.robustness,
        is_attributed: raw.attribution,
        is_ranked: raw.rank_models,
        controls,
        load_keys: [raw.pressure.as_ref().map(Spanned::span), raw.force.as_ref().map(Spanned::span)],
        surfaces,
        implausible,
        described: None,
    })
}

fn statistical_model(file: &SpecFile, raw: &CompareSpec) -> Result<StatisticalModel, InputError> {
    let Some(spec) = &raw.statistical else { return Ok(StatisticalModel::default()) };
    spec.get_ref().model().map_err(|message| file.source.error_at(spec.span(), message))
}
