//! A window as the program treats a measured map: its fitness checks, and its verdicts under other treatments.

use asperity::HeightMap;
use asperity::compare::{Accepted, ComparedQuantity, Controls, Difference, ModelKind, Verdict};
use asperity::progress::Silent;
use asperity::study::{
    Choice, Dependence, LawContact, Setup, StatisticalModel, Treated, study, under_treatments,
};
use asperity::surface::{AnalysisDepth, Preparation, SummitSearch};
use asperity::topography::Level;
use asperity::topography::fitness::{Check, Finding, LineOffsets, Measure, Spikes};
use asperity::topography::summits::Neighbours;
use asperity::work::Counter;

use super::process::Unusable;
use super::verdicts::WindowVerdict;

/// What is done with each window.
#[derive(Clone, Copy)]
pub struct StudyTask<'a> {
    /// The law on its bodies.
    pub law: &'a LawContact,
    /// Loads, Pa.
    pub loads: &'a [f64],
    /// Of random groups of asperities.
    pub seed: u64,
}

/// Results of one window.
#[derive(Debug, Clone, PartialEq)]
pub struct StudiedWindow {
    /// The fitness checks.
    pub findings: Vec<Finding>,
    /// The verdicts at admissible loads; none on a map that fails a check which blocks them.
    pub verdicts: Vec<WindowVerdict>,
}

impl StudyTask<'_> {
    /// Checks a window, and compares both models on it under all treatments.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn run(&self, window: &HeightMap) -> Result<StudiedWindow, Unusable> {
        let own = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
        let surface = SummitSearch::new(own).surface("window", window)?;
        let findings = surface.fitness().to_vec();
        if surface.is_blocked() {
            return Ok(StudiedWindow { findings, verdicts: Vec::new() });
        }
        let setup = Setup {
            laws: std::slice::from_ref(self.law),
            law_specs: std::slice::from_ref(&self.law.spec),
            models: &[ModelKind::Statistical, ModelKind::Deterministic],
            statistical: &StatisticalModel::default(),
            is_attributed: false,
            is_ranked: false,
            generates: false,
            controls: &Controls::at_pressures(self.loads.to_vec()),
            nominal_area: None,
            seed: self.seed,
            progress: &Silent,
        };
        let counter = Counter::default();
        let (realisation, _) = study(setup, &surface, &counter)?;
        let correlation = surface.map.as_ref().and_then(|map| map.correlation);
        let prepare = |preparation| {
            let depth = AnalysisDepth::Asperities;
            let search = SummitSearch { depth, correlation, ..SummitSearch::new(preparation) };
            search.surface("window", window).ok()
        };
        let treated = under_treatments(setup, &surface, &own, &realisation.cases, prepare, &counter);
        let treated = treated.into_iter().flatten().map(|(treatment, cases)| Treated {
            treatment,
            differences: cases.into_iter().flatten().collect(),
        });
        let treated: Vec<Treated> = treated.collect();
        let differences = &realisation.cases[0].differences;
        let verdicts = differences.iter().flat_map(|at| self.verdicts(at, &treated)).collect();
        Ok(StudiedWindow { findings, verdicts })
    }

    /// The verdicts at one load.
    fn verdicts(&self, at: &Difference, treated: &[Treated]) -> Vec<WindowVerdict> {
        let accepted = Accepted::DEFAULT;
        let Some(load) = self.loads.iter().position(|load| *load == at.load) else { return Vec::new() };
        if !at.exceeded().is_none() {
            return Vec::new();
        }
        let verdict = |quantity: ComparedQuantity| {
            let estimate = at.estimates[quantity as usize]?;
            let depends =
                |choice: &Choice| Dependence::at_load(*choice, quantity, at, treated, &accepted).is_some();
            Some(WindowVerdict {
                load,
                quantity,
                contrast: estimate.contrast,
                verdict: Verdict::from_estimate(&estimate, accepted.band(quantity)),
                depends_on: Choice::ALL.into_iter().filter(depends).collect(),
            })
        };
        ComparedQuantity::ALL.into_iter().filter_map(verdict).collect()
    }
}

/// The checks of a window that need neither its summits nor its correlation: spikes and lines.
pub fn quick_findings(window: &HeightMap) -> Vec<Finding> {
    let spikes = Spikes::find(window).count() as f64;
    let offsets = LineOffsets::new(window).largest();
    vec![
        Finding { check: Check::Spikes, measure: Measure::Spikes, value: spikes },
        Finding { check: Check::Lines, measure: Measure::LineOffsets, value: offsets },
    ]
}
