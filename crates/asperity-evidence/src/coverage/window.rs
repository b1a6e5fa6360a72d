//! A window as the library treats a measured map: its fitness checks, both models on it with the intervals that are claimed, and its
//! verdicts under other treatments.

use asperity::HeightMap;
use asperity::compare::{
    Accepted, CONTACTS_PER_GROUP, CaseSampling, ComparedQuantity, Controls, Difference, Estimate, GROUPS,
    ModelKind, Repeats, Support, Verdict,
};
use asperity::progress::{Progress, Silent};
use asperity::study::{
    Choice, Dependence, LawContact, RealisationResults, Setup, StatisticalModel, Treated, differ, models_of,
    run_surface, study, under_treatments,
};
use asperity::surface::{AnalysisDepth, NoAsperities, Preparation, SummitSearch, Surface};
use asperity::topography::summits::Neighbours;
use asperity::topography::{CorrelationLengths, Level};
use asperity::work::{Counter, Timing};

use crate::Failed;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuantityEstimate {
    /// Its value, with the interval if one is claimed.
    pub estimate: Estimate,
    /// Standard error for independent asperities, where there are contacts enough for groups of them.
    pub independent_error: Option<f64>,
    /// Effective contacts of the sum.
    pub contacts: f64,
    /// The larger area ratio of both models.
    pub area_ratio: f64,
}

/// The verdict on one quantity at an admissible load of one window.
#[derive(Debug, Clone, PartialEq)]
pub struct WindowVerdict {
    /// Index of the load.
    pub load: usize,
    pub quantity: ComparedQuantity,
    pub contrast: f64,
    pub verdict: Verdict,
    /// Whether it rests on differences on the halves of the window, without an interval.
    pub is_on_halves: bool,
    /// The choices in the analysis of the map that it depends on, where these were examined.
    pub depends_on: Vec<Choice>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct WindowResults {
    /// The larger correlation length of x and y over the side of the window; infinite where the autocorrelation does not decay.
    pub correlation: f64,
    pub is_patchy: bool,
    /// The differences at the loads that both models reach.
    pub differences: Vec<Difference>,
    /// The verdicts at admissible loads, by themselves.
    pub verdicts: Vec<WindowVerdict>,
    /// The same with what they depend on, where other treatments were studied; none on a map that fails a check which blocks them.
    pub studied: Option<Vec<WindowVerdict>>,
}

impl WindowResults {
    /// A quantity at a load (Pa), where it has a value.
    pub fn estimate(&self, load: f64, quantity: ComparedQuantity) -> Option<QuantityEstimate> {
        let at = self.differences.iter().find(|at| at.load == load)?;
        let estimate = at.estimates[quantity as usize]?;
        let contacts = at.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
        let are_enough = contacts >= CONTACTS_PER_GROUP * GROUPS as f64;
        Some(QuantityEstimate {
            estimate,
            independent_error: estimate.independent_error.filter(|_| are_enough),
            contacts,
            area_ratio: at.area_ratio,
        })
    }
}

#[derive(Clone, Copy)]
pub struct WindowTask<'a> {
    pub law: &'a LawContact,
    /// Loads, Pa.
    pub loads: &'a [f64],
    /// Whether surfaces are generated for the interval of a window that is too small for blocks.
    pub generates: bool,
    /// Of random groups of asperities.
    pub seed: u64,
}

/// How a window is prepared: levelled by a plane.
fn own() -> Preparation {
    Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) }
}

/// The five-point summits of a window, which is not checked.
pub fn summits(window: &HeightMap) -> Result<Surface, NoAsperities> {
    let none = Preparation::none(Neighbours::Four);
    SummitSearch { depth: AnalysisDepth::Asperities, ..SummitSearch::new(none) }.surface("window", window)
}

impl WindowTask<'_> {
    /// Both models on a window, on one of two bodies at all their relative positions; `name` decides the random groups of asperities.
    pub fn run(
        &self,
        name: &str,
        positions: &[HeightMap],
        is_studied: bool,
    ) -> Result<WindowResults, Failed> {
        let (window, others) = (&positions[0], &positions[1..]);
        // The bodies of a pair are levelled, their sum is not.
        let own = if others.is_empty() { own() } else { Preparation::none(Neighbours::Four) };
        let surface = SummitSearch::new(own).surface(name, window)?;
        let controls = Controls::at_pressures(self.loads.to_vec());
        let statistical = StatisticalModel::default();
        let setup = self.setup(&statistical, &controls);
        let (mut first, _) = study(setup, &surface, &Counter::default())?;
        let studied = is_studied.then(|| self.studied(setup, window, &surface, &first));
        let mut differences = std::mem::take(&mut first.cases[0].differences);
        if !others.is_empty() {
            let others = others.iter().map(|window| Self::differences(setup, window));
            let all: Result<Vec<_>, Failed> = std::iter::once(Ok(differences)).chain(others).collect();
            differences = Difference::over(&all?, Repeats::Shifts);
        }
        let correlation = surface.map.as_ref().and_then(|map| map.correlation);
        let correlation = correlation.unwrap_or(CorrelationLengths::NONE);
        let side = window.pixel()[0] * window.points()[0] as f64;
        Ok(WindowResults {
            correlation: correlation.lengths[0].max(correlation.lengths[1]) / side,
            is_patchy: correlation.patches.is_some(),
            verdicts: differences.iter().flat_map(|at| self.verdicts(at, &[])).collect(),
            differences,
            studied,
        })
    }

    /// The differences at another relative position, whose sampling error is that of the first.
    fn differences(setup: Setup, window: &HeightMap) -> Result<Vec<Difference>, Failed> {
        let (surface, timing) = (summits(window)?, &mut Timing::default());
        let models = models_of(setup, &surface, timing)?;
        let results = run_surface(setup, &surface, &models, &Counter::default(), timing);
        let mut results = results.map_err(|(_, error)| error)?;
        differ(&mut results.cases, &[CaseSampling::default()], setup.laws, &models);
        Ok(results.cases.remove(0).differences)
    }

    /// The verdicts with what they depend on.
    fn studied(
        &self,
        setup: Setup,
        window: &HeightMap,
        surface: &Surface,
        found: &RealisationResults,
    ) -> Vec<WindowVerdict> {
        if surface.is_blocked() {
            return Vec::new();
        }
        let correlation = surface.map.as_ref().and_then(|map| map.correlation);
        let prepare = |preparation, progress: &dyn Progress| {
            let depth = AnalysisDepth::Asperities;
            let search = SummitSearch { depth, correlation, progress, ..SummitSearch::new(preparation) };
            search.surface("window", window).ok()
        };
        let treated = under_treatments(setup, surface, &own(), &found.cases, prepare, &Counter::default());
        let treated = treated.into_iter().flatten().map(|(treatment, cases)| Treated {
            treatment,
            differences: cases.into_iter().flatten().collect(),
        });
        let treated: Vec<Treated> = treated.collect();
        let verdicts = found.cases[0].differences.iter().flat_map(|at| self.verdicts(at, &treated));
        // Conductance is proportional to the stiffness.
        verdicts.filter(|verdict| verdict.quantity != ComparedQuantity::ThermalConductance).collect()
    }

    fn setup<'b>(&'b self, statistical: &'b StatisticalModel, controls: &'b Controls) -> Setup<'b> {
        Setup {
            laws: std::slice::from_ref(self.law),
            law_specs: std::slice::from_ref(&self.law.spec),
            models: &[ModelKind::Statistical, ModelKind::Deterministic],
            statistical,
            is_attributed: false,
            is_ranked: false,
            generates: self.generates,
            controls,
            nominal_area: None,
            seed: self.seed,
            progress: &Silent,
        }
    }

    /// The verdicts at one load, if it is admissible.
    fn verdicts(&self, at: &Difference, treated: &[Treated]) -> Vec<WindowVerdict> {
        let accepted = Accepted::DEFAULT;
        let load = self.loads.iter().position(|load| *load == at.load);
        let Some(load) = load.filter(|_| at.exceeded().is_none()) else { return Vec::new() };
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
