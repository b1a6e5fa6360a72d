//! A window as the program treats a measured map: its fitness checks, and its verdicts under other treatments.

use asperity::HeightMap;
use asperity::compare::{Accepted, ComparedQuantity, Controls, Difference, ModelKind, Support, Verdict};
use asperity::progress::{Progress, Silent};
use asperity::study::{
    Choice, Dependence, LawContact, Setup, StatisticalModel, Treated, study, under_treatments,
};
use asperity::surface::{AnalysisDepth, Preparation, SummitSearch};
use asperity::topography::fitness::{Check, Finding, LineOffsets, Measure, Spikes};
use asperity::topography::summits::Neighbours;
use asperity::topography::{CorrelationLengths, Level};
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

/// Both models on a window that is too small for blocks.
#[derive(Debug, Clone)]
pub struct SmallWindow {
    /// Its correlation lengths.
    pub correlation: CorrelationLengths,
    /// The differences at the loads.
    pub differences: Vec<Difference>,
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
        let controls = Controls::at_pressures(self.loads.to_vec());
        let statistical = StatisticalModel::default();
        let setup = self.setup(&statistical, &controls, false);
        let counter = Counter::default();
        let (realisation, _) = study(setup, &surface, &counter)?;
        let correlation = surface.map.as_ref().and_then(|map| map.correlation);
        let prepare = |preparation, progress: &dyn Progress| {
            let depth = AnalysisDepth::Asperities;
            let search = SummitSearch { depth, correlation, progress, ..SummitSearch::new(preparation) };
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

    /// Both models on a window that is too small for blocks, with the intervals that the program claims there.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn small(&self, window: &HeightMap) -> Result<SmallWindow, Unusable> {
        let own = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
        let surface = SummitSearch::new(own).surface("window", window)?;
        let controls = Controls::at_pressures(self.loads.to_vec());
        let (mut realisation, _) =
            study(self.setup(&StatisticalModel::default(), &controls, true), &surface, &Counter::default())?;
        let correlation = surface.map.as_ref().and_then(|map| map.correlation);
        Ok(SmallWindow {
            correlation: correlation.unwrap_or(CorrelationLengths::NONE),
            differences: realisation.cases.remove(0).differences,
        })
    }

    fn setup<'b>(
        &'b self,
        statistical: &'b StatisticalModel,
        controls: &'b Controls,
        generates: bool,
    ) -> Setup<'b> {
        Setup {
            laws: std::slice::from_ref(self.law),
            law_specs: std::slice::from_ref(&self.law.spec),
            models: &[ModelKind::Statistical, ModelKind::Deterministic],
            statistical,
            is_attributed: false,
            is_ranked: false,
            generates,
            controls,
            nominal_area: None,
            seed: self.seed,
            progress: &Silent,
        }
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
                is_on_halves: matches!(estimate.support, Support::Halves(_)),
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
