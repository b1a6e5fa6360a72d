//! `[compare]` resolved: a study of surfaces, with reference, lines and what else is asked for.

use std::fmt;
use std::path::PathBuf;

use asperity::analytical::AnalyticalLine;
use asperity::compare::{Control, Controls, ModelKind};
use asperity::study::Setup;
use asperity::surface::AnalysisDepth;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::{InputError, Spanned, SpecFile};

use super::lines::lines;
use super::reference::ReferencePlan;
use super::reference::plan::{ReferenceKeys, Resolved, reference};
use super::spec::{CompareSpec, Models};
use crate::study_plan::{SpotKeys, StudyKeys, StudyPlan};
use crate::surface::SurfacePlan;

/// Both models on given surfaces, and the reference beside them.
pub struct ComparePlan {
    /// Bodies, laws, loads and surfaces.
    pub study: StudyPlan,
    pub models: Vec<ModelKind>,
    /// The reference beside them, where one is asked for.
    pub reference: Option<Box<ReferencePlan>>,
    /// Closed results beside the models.
    pub lines: Vec<AnalyticalLine>,
    /// Whether the verdicts on measured maps are computed again under other treatments of the map.
    pub is_robustness_examined: bool,
    /// Whether the gap between the models is divided among its causes.
    pub is_attributed: bool,
    /// Whether all statistical models are compared with sum and reference.
    pub is_ranked: bool,
    /// The measured file that the command line named: its surface is described in full.
    pub described: Option<PathBuf>,
    /// The figures of the paper that it reproduces.
    pub figures_of_paper: Vec<u8>,
}

impl ComparePlan {
    /// A study by both models alone.
    pub fn of_models(study: StudyPlan) -> Self {
        Self {
            study,
            models: Models::default().kinds,
            reference: None,
            lines: Vec::new(),
            is_robustness_examined: false,
            is_attributed: false,
            is_ranked: false,
            described: None,
            figures_of_paper: Vec::new(),
        }
    }

    /// How closely the first realisation of its surfaces is looked at.
    pub fn depth(&self) -> AnalysisDepth {
        if self.described.is_some() { AnalysisDepth::Everything } else { AnalysisDepth::Comparison }
    }

    /// Whether something follows the intervals: other treatments of a measured map, or boundary elements.
    #[cfg(feature = "serve")]
    pub(crate) fn goes_on(&self) -> bool {
        let is_treated =
            self.is_robustness_examined && self.study.surfaces.iter().any(SurfacePlan::is_measured);
        self.reference.is_some() || is_treated
    }

    /// What its models are run with.
    pub fn setup<'a>(&'a self, context: &RunContext<'a>) -> Setup<'a> {
        let layer = self.study.layer.as_ref();
        Setup {
            models: &self.models,
            is_attributed: self.is_attributed,
            // A table for each of several thicknesses would have no reader.
            is_ranked: self.is_ranked && layer.is_none_or(|layer| layer.thicknesses.len() == 1),
            ..self.study.setup(context)
        }
    }
}

impl fmt::Display for ComparePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.study.describe(&self.models, f)?;
        if let Some(reference) = &self.reference {
            reference.describe(&self.study.surfaces, f)?;
        }
        self.study.warn(f)
    }
}

pub(super) fn plan(file: &SpecFile, table: &Spanned<CompareSpec>) -> Result<ComparePlan, InputError> {
    let raw = table.get_ref();
    if let (Some(area), None, None) = (&raw.nominal_area, &raw.pressure, &raw.force) {
        let message = "found a nominal area without a load; allowed: beside `force`, which acts on it, or `pressure`, whose force it \
                       gives";
        return Err(file.source.error_at(area.span(), message));
    }
    let mut study = StudyPlan::new(file, keys(table))?;
    let [bare, _] = study.bare_and_coated();
    let models = raw.models.as_ref().map_or_else(Models::default, |models| models.get_ref().clone()).kinds;
    if models.contains(&ModelKind::Deterministic) {
        study.check_summed(file, raw.models.as_ref().map(Spanned::span))?;
    }
    let resolved = Resolved { bare, flats: &study.flats, laws: &study.laws, surfaces: &study.surfaces };
    let reference = reference(file, &reference_keys(raw), &resolved)?.map(Box::new);
    study.implausible.extend(reference.iter().find_map(|reference| {
        let known = |surface: &SurfacePlan| Some((surface.name.clone(), surface.points_per_wave()?));
        reference.warning(study.surfaces.iter().filter_map(known))
    }));
    study.implausible.extend(reference.iter().find_map(|reference| reference.cluster_warning(&study)));
    let lines = lines(file, raw, &study.surfaces, reference.as_deref())?;
    Ok(ComparePlan {
        models,
        reference,
        lines,
        is_robustness_examined: raw.robustness,
        is_attributed: raw.attribution,
        is_ranked: raw.rank_models,
        figures_of_paper: figures_of_paper(file, raw, &study)?,
        study,
        described: None,
    })
}

/// The figures of the paper, which the comparison must be able to show.
fn figures_of_paper(file: &SpecFile, raw: &CompareSpec, study: &StudyPlan) -> Result<Vec<u8>, InputError> {
    let Some(figures) = &raw.figure_of_paper else { return Ok(Vec::new()) };
    let has_thicknesses = study.layer.as_ref().is_some_and(|layer| layer.thicknesses.len() > 1);
    let has_both = raw.models.as_ref().is_none_or(|models| models.get_ref().kinds.len() == 2);
    let needed = |figure: &u8| match figure {
        4 if has_thicknesses || !has_both => {
            Some("both models and no layer of several thicknesses, as Fig. 4 compares the models")
        }
        6 if !has_thicknesses => Some("a layer of several thicknesses, as Fig. 6 compares thicknesses"),
        _ => None,
    };
    let numbers = &figures.get_ref().0;
    match numbers.iter().find_map(|figure| Some((figure, needed(figure)?))) {
        None => Ok(numbers.clone()),
        Some((figure, needed)) => {
            let message = format!("found the figure {figure} of the paper; allowed: with {needed}");
            Err(file.source.error_at(figures.span(), message))
        }
    }
}

fn keys(table: &Spanned<CompareSpec>) -> StudyKeys<'_> {
    let raw = table.get_ref();
    StudyKeys {
        table: table.span(),
        rough: &raw.rough,
        flat: &raw.flat,
        law: &raw.law,
        layer: raw.layer.as_ref(),
        spots: SpotKeys {
            conductance: raw.conductance.as_ref(),
            shear_strength: raw.shear_strength.as_ref(),
        },
        statistical: raw.statistical.as_ref(),
        accept: raw.accept,
        surfaces: raw.surfaces.as_deref(),
        controls: Controls {
            separations: raw.separation.as_ref().map(|sweep| sweep.0.clone()).unwrap_or_default(),
            pressures: raw.pressure.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
            forces: raw.force.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
        },
        nominal_area: raw.nominal_area.as_ref().map(|area| area.get_ref().value()),
        load_keys: [raw.pressure.as_ref().map(Spanned::span), raw.force.as_ref().map(Spanned::span)],
    }
}

fn reference_keys(raw: &CompareSpec) -> ReferenceKeys<'_> {
    let pressures = raw.pressure.as_ref().map(|sweep| (Control::Pressure, sweep.get_ref().loads()));
    let forces = raw.force.as_ref().map(|sweep| (Control::Force, sweep.get_ref().loads()));
    let loads = pressures.into_iter().chain(forces);
    ReferenceKeys {
        models: raw.models.as_ref(),
        reference: raw.reference.as_ref(),
        separations: raw.separation.as_ref().map(|sweep| sweep.0.len()),
        loads: loads.map(|(control, (values, is_listed))| (control, values, is_listed)).collect(),
        bodies: [&raw.rough.get_ref().0, raw.flat.get_ref()],
    }
}

/// Both models on the one surface of `file`, which the command line named and which is described in full.
pub fn described(file: &SpecFile) -> Result<ComparePlan, InputError> {
    let plan = plan(file, &file.required_table("compare")?)?;
    let described = plan.study.surfaces.first().and_then(|surface| surface.inputs().into_iter().next());
    Ok(ComparePlan { described, ..plan })
}
