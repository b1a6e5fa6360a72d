//! Both models on one window, with the intervals that the program claims there.

use asperity::compare::{
    Accepted, CONTACTS_PER_GROUP, CaseSampling, ComparedQuantity, Difference, Division, Estimate, GROUPS,
    LeftOut, OneStep, Pair, Repeats, Support, Verdict, jackknife_error, jackknife_quantile, pairs_at,
};
use asperity::progress::Silent;
use asperity::topography::{Blocks, CorrelationLengths};
use asperity::{
    AsperitySet, Deterministic, HeightMap, Heights, MicroContact, Model, Population, ReferencePlane,
    Response, Shape, Statistical, Statistics, Total,
};

use super::process::{Controls, Unusable, WindowAsperities};
use super::studied::{SmallWindow, StudyTask};
use super::verdicts::WindowVerdict;

/// A quantity with an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoveredQuantity {
    /// Statistical less deterministic result at equal load, as a verdict is given on it.
    Difference(ComparedQuantity),
    /// Logarithm of the area ratio of the sum at a load.
    AreaOfSum,
    /// Logarithm of the statistical over the deterministic load at a separation.
    LoadAtSeparation,
}

impl CoveredQuantity {
    /// All quantities.
    pub const ALL: [Self; 6] = [
        Self::Difference(ComparedQuantity::Separation),
        Self::Difference(ComparedQuantity::Area),
        Self::Difference(ComparedQuantity::Stiffness),
        Self::Difference(ComparedQuantity::ThermalConductance),
        Self::AreaOfSum,
        Self::LoadAtSeparation,
    ];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Difference(quantity) => quantity.name(),
            Self::AreaOfSum => "area-of-sum",
            Self::LoadAtSeparation => "load-at-separation",
        }
    }
}

/// A value for each of [`CoveredQuantity::ALL`].
pub type ByCovered<T> = [T; CoveredQuantity::ALL.len()];

/// A quantity in one window.
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

/// Results of one window.
#[derive(Debug, Clone, PartialEq)]
pub struct WindowResults {
    /// The larger correlation length of x and y over the side of the window; infinite where the autocorrelation does not
    /// decay.
    pub correlation: f64,
    /// Whether its roughness is found to be patchy.
    pub is_patchy: bool,
    /// Whether each load is admissible.
    pub admissible: Vec<bool>,
    /// For each load the quantities in the order of [`CoveredQuantity::ALL`]; `None` where one has no value.
    pub estimates: Vec<ByCovered<Option<QuantityEstimate>>>,
}

impl WindowResults {
    /// The verdicts at admissible loads.
    pub fn verdicts(&self) -> Vec<WindowVerdict> {
        let at_load = |(load, estimates): (usize, &ByCovered<Option<QuantityEstimate>>)| {
            let verdict = |quantity: ComparedQuantity| {
                let place = CoveredQuantity::ALL
                    .iter()
                    .position(|covered| *covered == CoveredQuantity::Difference(quantity))?;
                let estimate = estimates[place].filter(|_| self.admissible[load])?.estimate;
                Some(WindowVerdict {
                    load,
                    quantity,
                    contrast: estimate.contrast,
                    verdict: Verdict::from_estimate(&estimate, Accepted::DEFAULT.band(quantity)),
                    is_on_halves: matches!(estimate.support, Support::Halves(_)),
                    depends_on: Vec::new(),
                })
            };
            ComparedQuantity::ALL.map(verdict).into_iter().flatten().collect::<Vec<_>>()
        };
        self.estimates.iter().enumerate().flat_map(at_load).collect()
    }
}

/// What is done with each window.
pub struct WindowTask<'a> {
    /// The micro-contact.
    pub contact: &'a dyn MicroContact,
    /// Loads and separations.
    pub controls: Controls,
    /// How a window is studied that is too small for blocks, where model-based intervals are claimed.
    pub small: Option<StudyTask<'a>>,
}

/// Both models on a set of asperities.
struct Results {
    /// At the loads.
    pairs: Vec<Option<Pair>>,
    /// Statistical and deterministic response at the separations.
    at_separations: Vec<[Response; 2]>,
}

impl Results {
    /// Logarithm of the statistical over the deterministic load at a separation.
    fn log_load_ratio(&self, index: usize) -> Option<f64> {
        let [s, d] = self.at_separations[index].map(|response| response.pressure.total());
        (s > 0.0 && d > 0.0).then(|| (s / d).ln())
    }

    /// Logarithm of the area ratio of the sum at a load.
    fn log_area(&self, index: usize) -> Option<f64> {
        let area = self.pairs[index]?.deterministic.area_ratio.total();
        (area > 0.0).then(|| area.ln())
    }
}

/// Both models with each group of the asperities left out.
struct Groups {
    /// The differences at the loads, in one step from those of all, as the program finds them.
    left_out: LeftOut,
    /// All results, searched anew; `None` where nothing is left.
    results: Vec<Option<Results>>,
}

impl Groups {
    /// Standard error of a value that is `full` on all asperities; `None` where it has none without a group.
    fn error(&self, full: f64, value: impl Fn(&Results) -> Option<f64>) -> Option<f64> {
        let without: Option<Vec<f64>> = self.results.iter().map(|results| value(results.as_ref()?)).collect();
        Some(jackknife_error(full, &without?, &self.left_out.shares))
    }
}

/// Whether `contacts` effective contacts are enough for an interval from `groups` groups.
fn are_enough(contacts: f64, groups: usize) -> bool {
    contacts >= CONTACTS_PER_GROUP * groups as f64
}

impl WindowTask<'_> {
    /// Runs both models on a window, on one of two bodies at all their relative positions: intervals are then those of the first position,
    /// with the scatter of all, as the program claims them.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn run_at_positions(
        &self,
        positions: &[HeightMap],
        seed: Option<[u8; 32]>,
    ) -> Result<WindowResults, Unusable> {
        let (window, others) = (&positions[0], &positions[1..]);
        let first = self.run(window, seed)?;
        if others.is_empty() {
            return Ok(first);
        }
        let without_groups = |window| {
            let set = WindowAsperities::from_summits(window)?.set;
            Ok(self.estimates(&self.results(&set), None, None, set.nominal_area()).1)
        };
        let others: Result<Vec<Vec<_>>, Unusable> = others.iter().map(without_groups).collect();
        let others = others?;
        let over_positions = |load: usize, quantity: usize| {
            let of_first: QuantityEstimate = first.estimates[load][quantity]?;
            let rest = others.iter().map(|estimates| Some(estimates[load][quantity]?.estimate));
            let all: Option<Vec<Estimate>> = std::iter::once(Some(of_first.estimate)).chain(rest).collect();
            Some(QuantityEstimate { estimate: Estimate::over(&all?, Repeats::Shifts), ..of_first })
        };
        let at_load = |load: usize| std::array::from_fn(|quantity| over_positions(load, quantity));
        Ok(WindowResults { estimates: (0..first.estimates.len()).map(at_load).collect(), ..first })
    }

    /// Runs both models on a window; with a seed, also the errors of asperities taken as independent, in random groups.
    ///
    /// # Errors
    /// See [`Unusable`].
    pub fn run(&self, window: &HeightMap, seed: Option<[u8; 32]>) -> Result<WindowResults, Unusable> {
        if let Some(study) = &self.small {
            return Ok(self.small_window(window, study.small(window)?));
        }
        let WindowAsperities { set, positions } = WindowAsperities::from_summits(window)?;
        let correlation = CorrelationLengths::from_map(window, 0.0)
            .map_or(CorrelationLengths::NONE, |(lengths, _)| lengths);
        let blocks = Blocks::new(window.points(), window.pixel(), correlation).ok();
        let of_blocks = |blocks: &Blocks| Division::of_blocks(blocks, &positions, blocks.shares(window));
        let results = self.results(&set);
        let step = self.one_step(&set, &results);
        let groups = blocks.as_ref().map(|blocks| self.groups(&set, &of_blocks(blocks), &step));
        let draws = seed.and_then(|seed| Division::independent(set.count(), seed, &Silent));
        let independent = draws.map(|draws| self.groups(&set, &draws, &step));
        let side = window.pixel()[0] * window.points()[0] as f64;
        let (admissible, estimates) = self.estimates(&results, groups, independent, set.nominal_area());
        Ok(WindowResults {
            correlation: correlation.lengths[0].max(correlation.lengths[1]) / side,
            is_patchy: correlation.patches.is_some(),
            admissible,
            estimates,
        })
    }

    /// The differences on a small window; other quantities have no model-based interval.
    fn small_window(&self, window: &HeightMap, found: SmallWindow) -> WindowResults {
        let SmallWindow { correlation, differences } = found;
        let at_load = |load: &f64| differences.iter().find(|at| at.load == *load);
        let estimates = |load: &f64| {
            CoveredQuantity::ALL.map(|quantity| {
                let CoveredQuantity::Difference(quantity) = quantity else { return None };
                let at = at_load(load)?;
                let contacts = at.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
                let estimate = at.estimates[quantity as usize]?;
                Some(QuantityEstimate {
                    estimate,
                    independent_error: None,
                    contacts,
                    area_ratio: at.area_ratio,
                })
            })
        };
        let loads = || self.controls.loads.iter();
        let side = window.pixel()[0] * window.points()[0] as f64;
        WindowResults {
            correlation: correlation.lengths[0].max(correlation.lengths[1]) / side,
            is_patchy: correlation.patches.is_some(),
            admissible: loads().map(|load| at_load(load).is_some_and(|at| at.exceeded().is_none())).collect(),
            estimates: loads().map(estimates).collect(),
        }
    }

    fn estimates(
        &self,
        results: &Results,
        groups: Option<Groups>,
        independent: Option<Groups>,
        area: f64,
    ) -> (Vec<bool>, Vec<ByCovered<Option<QuantityEstimate>>>) {
        let pairs: Option<Vec<Pair>> = results.pairs.iter().copied().collect();
        // Differences are numbered by the loads that are reached.
        let Some(pairs) = pairs else {
            let count = self.controls.loads.len();
            return (vec![false; count], vec![[None; CoveredQuantity::ALL.len()]; count]);
        };
        let of_groups = |groups: &Option<Groups>| groups.as_ref().map(|groups| groups.left_out.clone());
        let sampling = CaseSampling {
            groups: of_groups(&groups),
            independent: of_groups(&independent),
            area,
            ..CaseSampling::default()
        };
        let claim = |at: &Response, full: f64, value: &dyn Fn(&Results) -> Option<f64>| {
            let contacts = at.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
            let enough = groups.as_ref().filter(|groups| are_enough(contacts, groups.results.len()));
            Estimate {
                contrast: full,
                error: enough.and_then(|groups| groups.error(full, value)),
                quantile: enough.map_or(f64::INFINITY, |groups| jackknife_quantile(groups.results.len())),
                bound: 0.0,
                independent_error: independent.as_ref().and_then(|groups| groups.error(full, value)),
                support: Support::Sampled,
            }
        };
        let at_load = |(index, difference): (usize, &Difference)| {
            let pair = &pairs[index];
            let [s, d] = &results.at_separations[index];
            CoveredQuantity::ALL.map(|quantity| {
                let (sum, integral) = match quantity {
                    CoveredQuantity::LoadAtSeparation => (d, s),
                    CoveredQuantity::Difference(_) | CoveredQuantity::AreaOfSum => {
                        (&pair.deterministic, &pair.statistical)
                    }
                };
                let estimate = match quantity {
                    CoveredQuantity::Difference(quantity) => difference.estimates[quantity as usize]?,
                    CoveredQuantity::AreaOfSum => {
                        claim(sum, results.log_area(index)?, &|without| without.log_area(index))
                    }
                    CoveredQuantity::LoadAtSeparation => {
                        claim(sum, results.log_load_ratio(index)?, &|without| without.log_load_ratio(index))
                    }
                };
                let contacts = sum.sharing.map_or(0.0, |sharing| sharing.effective_contacts);
                Some(QuantityEstimate {
                    estimate,
                    independent_error: estimate.independent_error.filter(|_| are_enough(contacts, GROUPS)),
                    contacts,
                    area_ratio: sum.area_ratio.total().max(integral.area_ratio.total()),
                })
            })
        };
        let differences = Difference::at_loads(&pairs, &sampling);
        let admissible = differences.iter().map(|at| at.exceeded().is_none()).collect();
        (admissible, differences.iter().enumerate().map(at_load).collect())
    }

    /// The state from which groups are left out, at those loads that both models reach.
    fn one_step(&self, set: &AsperitySet, results: &Results) -> OneStep {
        let (integral, sum) = self.models(set);
        let pairs = results.pairs.iter().copied().flatten().collect();
        OneStep::new(pairs, &integral, &sum, set.nominal_area())
    }

    fn groups(&self, set: &AsperitySet, division: &Division, step: &OneStep) -> Groups {
        let shares = division.shares();
        let without = |group: usize| {
            let separations = step.deterministic_separations();
            let Some(rest) = division.without(set, group) else {
                return (vec![None; separations.len()], None, None);
            };
            let (integral, sum) = self.models(&rest);
            let part = division.only(set, group).map(|part| self.models(&part).1.totals(separations));
            let part = part.unwrap_or_else(|| vec![Total::default(); separations.len()]);
            let responses = integral.respond_all(&step.statistical_separations());
            let states = step.without(&responses, &part, shares[group], sum.plane());
            (states, Some(sum.plane()), Some(self.results(&rest)))
        };
        let mut left_out = LeftOut { shares: shares.to_vec(), ..LeftOut::default() };
        let mut all = Vec::new();
        for (states, plane, results) in division.for_each_group(without) {
            left_out.states.push(states);
            left_out.planes.push(plane);
            all.push(results);
        }
        Groups { left_out, results: all }
    }

    /// Both models of a set, whose own statistics are the inputs of the statistical one: mean radius, sigma, density, and
    /// Gaussian heights.
    fn models<'b>(&'b self, set: &'b AsperitySet) -> (Statistical<'b>, Deterministic<'b>) {
        let statistics = Statistics::new(set);
        let population = Population {
            radius: statistics.mean_radius,
            sigma: statistics.sigma,
            density: set.density(),
            heights: Heights::GAUSSIAN,
        };
        let shape = Shape::sphere(population.radius);
        (
            Statistical::of_shape(self.contact, population, shape),
            Deterministic::new(self.contact, set.spheres(), ReferencePlane::from(&statistics)),
        )
    }

    fn results(&self, set: &AsperitySet) -> Results {
        let Controls { loads, separations } = &self.controls;
        let (integral, sum) = self.models(set);
        let pairs = pairs_at(&integral, &sum, loads);
        let [s, d] = [&integral as &dyn Model, &sum].map(|model| model.respond_all(separations));
        Results { pairs, at_separations: s.into_iter().zip(d).map(|(s, d)| [s, d]).collect() }
    }
}
