//! Running `[sampling-interval]`: both models on each surface at every length; and whether a quantity has a limit.

use std::time::Instant;

use asperity::compare::{CaseSampling, Division, LeftOut, SlopeFit, jackknife_error, jackknife_quantile};
use asperity::study::{Setup, StudyError, study};
use asperity::surface::{AnalysisDepth, Independence, Surface};
use asperity::topography::{Filter, FilterError, Rows, Sampled, Watched};
use asperity::work::Counter;
use asperity::{AsperitySet, HeightMap, Statistics, literature, named_enum, plasticity_index};
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::metadata::{Timing, contact_metadata, papers_of};
use asperity_contact_framework::progress::{Named, Progress};

use super::IntervalPlan;
use super::results::{
    Asperities, BlocksLeftOut, IntervalResults, Scale, ScaleResults, Series, SurfaceResults, TrendQuantity,
    Variation,
};
use crate::plausibility;
use crate::study_plan::StudyPlan;
use crate::surface::{SurfaceFactory, files_of};

pub(super) fn run(context: &RunContext, plan: &IntervalPlan) -> Result<IntervalResults, InputError> {
    let start = Instant::now();
    let (mut timing, counter) = (Timing::default(), Counter::default());
    let study = &plan.study;
    let mut papers = papers_of(&study.laws);
    papers.extend((!plan.multiples.is_empty()).then_some(literature::ISO_16610_61));
    context.progress.steps(study.surfaces.len() as u64);
    let mut files = files_of(&study.surfaces, &counter);
    let mut surfaces = Vec::new();
    for surface in &study.surfaces {
        let mut factory = SurfaceFactory::new(surface, context, &counter).keeping_map(true);
        let mut made = factory.make(1, AnalysisDepth::Comparison, &mut files, &mut timing)?;
        papers.extend(made.papers());
        let mut series = Vec::new();
        // Planned surfaces have a map, which is kept.
        if let Some(prepared) = made.prepared.take() {
            let (factory, counter, surface) = (&factory, &counter, &made);
            let variants = Variants { context, plan, factory, counter, surface, map: &prepared.map };
            series = variants.series().map_err(|error| {
                let message = format!("surface {}: {error}", made.name);
                context.source.error_at(plan.filter_key.clone(), message)
            })?;
        }
        context.progress.step();
        surfaces.push(SurfaceResults { surface: made, series });
    }
    timing.total = start.elapsed();
    let mut implausible = study.implausible.clone();
    implausible.extend(
        surfaces
            .iter()
            .flat_map(|results| plausibility::of_made(&results.surface, study.statistical.mean_radius)),
    );
    Ok(IntervalResults {
        metadata: context.metadata(papers, timing, Some(counter.work())),
        contact: contact_metadata(context.materials, &study.laws, &study.bodies, None),
        implausible,
        law: study.laws[0].label.clone(),
        loads: study.controls.pressures.clone(),
        surfaces,
    })
}

/// A surface with its prepared map, to be varied.
struct Variants<'a> {
    context: &'a RunContext<'a>,
    plan: &'a IntervalPlan,
    factory: &'a SurfaceFactory<'a>,
    counter: &'a Counter,
    surface: &'a Surface,
    map: &'a HeightMap,
}

impl Variants<'_> {
    fn series(&self) -> Result<Vec<Series>, FilterError> {
        let Self { plan: IntervalPlan { study, intervals, multiples, .. }, surface, .. } = self;
        let accepted = study.accept.on(surface.plane.sigma);
        let series = |variation, scales| {
            let series = Series { surface: surface.name.clone(), variation, scales, trends: Vec::new() };
            series.with_trends(&study.controls.pressures, &accepted)
        };
        let named = |number: usize| Named {
            name: format!("interval or filter {number} of {}", self.plan.scales()),
            progress: self.context.progress,
        };
        let each = |(&every, number)| self.sampled(every, &named(number));
        let sampled = intervals.iter().zip(1..).map(each).collect();
        let each = |(&multiple, number)| self.filtered(multiple, &named(number));
        let filtered: Result<Vec<Scale>, _> = multiples.iter().zip(intervals.len() + 1..).map(each).collect();
        let mut all = vec![series(Variation::Interval, sampled), series(Variation::Filter, filtered?)];
        all.retain(|series| !series.scales.is_empty());
        Ok(all)
    }

    /// Every so many points of the map.
    fn sampled(&self, every: usize, progress: &dyn Progress) -> Scale {
        let pixel = self.map.pixel();
        let length = every as f64 * pixel[0].max(pixel[1]);
        self.scale(every as f64, length, &Sampled { map: self.map, every }, progress)
    }

    /// The map under an S filter.
    fn filtered(&self, multiple: f64, progress: &dyn Progress) -> Result<Scale, FilterError> {
        let length = multiple * self.plan.nesting_index(self.map.pixel());
        let filter = Filter::new(Some(length), None)?;
        progress.stage("filtering", filter.work(self.map.pixel()));
        let filtered = filter.apply(&Watched { map: self.map, progress })?;
        Ok(self.scale(multiple, length, &filtered, progress))
    }

    fn scale(&self, multiple: f64, length: f64, map: &dyn Rows, progress: &dyn Progress) -> Scale {
        Scale { multiple, length, results: self.results(map, progress) }
    }

    /// Both models on a variant of the map.
    fn results(&self, map: &dyn Rows, progress: &dyn Progress) -> Result<ScaleResults, String> {
        let facts = self.surface.map.as_ref();
        let surface = facts.and_then(|facts| self.factory.derived(map, facts, progress));
        let surface = &surface.ok_or("no summit is left, or all are equally high")?;
        let setup = Setup { progress, generates: false, ..self.plan.study.setup(self.context) };
        let results = study(setup, surface, self.counter).map_err(|error| match error {
            StudyError::Inapplicable(error) => error.to_string(),
            StudyError::NotReached(_, error) => error.to_string(),
            error @ StudyError::NoEllipses(_) => error.to_string(),
        });
        let (mut realisation, samplings) = results?;
        let case = realisation.cases.swap_remove(0);
        let blocks = match (&surface.independence, samplings.into_iter().next()) {
            (Independence::Blocks(blocks), Some(CaseSampling { groups: Some(models), .. })) => {
                Some(self.without_blocks(surface, &blocks.division, models))
            }
            _ => None,
        };
        let asperities = Asperities {
            density: surface.set.density(),
            statistics: surface.reported_statistics(),
            alpha: surface.map.as_ref().and_then(|map| map.roughness.alpha()),
            plasticity_index: case.plasticity_index,
        };
        Ok(ScaleResults { count: surface.set.count(), asperities, sigma: surface.plane.sigma, case, blocks })
    }

    fn without_blocks(&self, surface: &Surface, division: &Division, models: LeftOut) -> BlocksLeftOut {
        let StudyPlan { laws, statistical, .. } = &self.plan.study;
        let asperities = |set: &AsperitySet| {
            let statistics = Statistics::new(set);
            let plasticity_index = plasticity_index(
                &*laws[0].contact,
                statistics.sigma,
                statistical.mean_radius.radius(&statistics),
            );
            // The moments of the map are not known without a block.
            Asperities { density: set.density(), statistics, alpha: None, plasticity_index }
        };
        let rest = |group| division.without(&surface.set, group).as_ref().map(asperities);
        BlocksLeftOut { asperities: division.for_each_group(rest), models }
    }
}

/// A change has shrunk if it is at most this many times the one before, over equal ratios of lengths: a quantity that approaches
/// its limit as length^p does so with 2^-p per halving, p = 1/2 here; a power law without a limit has 1.
const SHRINKS: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The ratio of successive changes of a smooth surface, p = 2: a smaller one is an accident.
const FASTEST: f64 = 0.25;

/// Halvings over which changes that do not shrink must add up to no more than the tolerance: a factor of 16 in length.
const HALVINGS: f64 = 4.0;

/// A quantity at one scale, on the scale on which changes are formed.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Sampling interval or nesting index, m.
    pub length: f64,
    /// Its value, or the logarithm of what is positive.
    pub value: f64,
    /// Without each block of the map.
    pub without: Option<Vec<f64>>,
}

named_enum! {
    /// Whether a quantity has a limit as the length shrinks, from its values at the three shortest lengths.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Convergence {
        /// The last change is within the tolerance, its interval included, and so is what is left of a smooth surface after the change
        /// before; and it cannot be told from none, or it shrinks and what is left is within the tolerance too, or it is small over
        /// [`HALVINGS`].
        Limit = "limit",
        /// The last change shrinks, its interval included, but it or what is left exceeds the tolerance.
        Approaching = "approaching",
        /// The last change exceeds the tolerance, its interval included, and does not shrink.
        NoLimit = "no-limit",
        /// Anything else.
        CannotTell = "cannot-tell",
    }
}

/// How a quantity changes towards the finest scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    pub quantity: TrendQuantity,
    /// Nominal pressure, Pa, of a quantity at a load.
    pub load: Option<f64>,
    /// The change from the second finest scale to the finest.
    pub change: f64,
    /// Half-width of the 95 % interval of the change, from the same blocks at both scales; `None` where none is claimed.
    pub half_width: Option<f64>,
    /// The change from the third finest to the second finest scale, over the same ratio of lengths as the last one.
    pub previous: f64,
    /// The exponent of the power law through the values over all lengths; `None` of what may be negative.
    pub exponent: Option<SlopeFit>,
    /// The largest change that does not matter.
    pub tolerance: f64,
    /// Whether the values have a limit as the sampling interval shrinks.
    pub outcome: Convergence,
}

impl Trend {
    /// Of a quantity at its scales, from the finest; `shares` are those of the blocks in the area at the finest. `None` of fewer
    /// than three scales.
    pub fn new(
        quantity: TrendQuantity,
        load: Option<f64>,
        points: &[Point],
        shares: &[f64],
        tolerance: f64,
    ) -> Option<Self> {
        let [finest, second, third, ..] = points else { return None };
        let change = finest.value - second.value;
        let octaves = |fine: &Point, coarse: &Point| (coarse.length / fine.length).log2();
        let last = octaves(finest, second);
        let previous = (second.value - third.value) * last / octaves(second, third);
        let half_width = finest.without.as_ref().zip(second.without.as_ref()).and_then(|(fine, coarse)| {
            let is_paired = fine.len() == coarse.len() && fine.len() == shares.len();
            let changes: Vec<f64> = fine.iter().zip(coarse).map(|(fine, coarse)| fine - coarse).collect();
            let error = is_paired.then(|| jackknife_error(change, &changes, shares))?;
            Some(jackknife_quantile(shares.len()) * error)
        });
        let values = points.iter().map(|point| (point.length, point.value.exp()));
        Some(Self {
            quantity,
            load,
            change,
            half_width,
            previous,
            exponent: if quantity.is_positive() { SlopeFit::through(values) } else { None },
            tolerance,
            outcome: outcome(change, half_width, previous, last, tolerance),
        })
    }

    /// What is left of the change from the finest scale to the limit if changes shrink on as the last one did; `None` where it did
    /// not shrink.
    pub fn remainder(&self) -> Option<f64> {
        remainder(self.change, self.previous).map(|left| left.copysign(self.change))
    }
}

/// The size of all further changes if they shrink as the last one did, as a geometric series whose ratio is at least [`FASTEST`].
/// `None` where it did not shrink.
fn remainder(change: f64, previous: f64) -> Option<f64> {
    let ratio = (change / previous).abs().max(FASTEST);
    (ratio <= SHRINKS).then(|| previous.abs() * ratio * ratio / (1.0 - ratio))
}

/// `octaves` is the ratio of the lengths of the last change, as a power of two.
fn outcome(change: f64, half_width: Option<f64>, previous: f64, octaves: f64, tolerance: f64) -> Convergence {
    let half = half_width.unwrap_or(0.0);
    let (largest, smallest) = (change.abs() + half, change.abs() - half);
    let is_seen = half_width.is_none() || smallest > 0.0;
    let is_left = |change| remainder(change, previous).is_some_and(|left| left <= tolerance);
    let is_small = HALVINGS * largest <= tolerance * octaves;
    // At least as much is left as of a smooth surface, whatever the last change.
    let may_be_near = largest <= tolerance && (previous == 0.0 || is_left(0.0));
    if may_be_near && (!is_seen || is_small || is_left(change)) {
        Convergence::Limit
    } else if remainder(largest, previous).is_some() {
        Convergence::Approaching
    } else if smallest > tolerance && remainder(smallest, previous).is_none() {
        Convergence::NoLimit
    } else {
        Convergence::CannotTell
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: f64 = 0.05;

    fn trend(value: impl Fn(f64) -> f64, lengths: &[f64]) -> Trend {
        let point = |&length: &f64| Point { length, value: value(length).ln(), without: None };
        let points: Vec<Point> = lengths.iter().map(point).collect();
        Trend::new(TrendQuantity::Density, None, &points, &[], TOLERANCE).unwrap()
    }

    /// 1 + c h^2, as of a smooth surface: the change from 2 to 1 is 3 c, what is left c.
    #[test]
    fn what_converges_has_a_limit_once_little_is_left() {
        let of = |c: f64| trend(|h| 1.0 + c * h * h, &[1.0, 2.0, 4.0, 8.0]);
        assert_eq!(of(0.015).outcome, Convergence::Limit);
        let close = of(1e-3);
        assert!((close.change + 3e-3).abs() < 1e-4 && close.outcome == Convergence::Limit);
        assert!((close.remainder().unwrap() / -1e-3 - 1.0).abs() < 0.02);
        // Of a change of 28 % another 23 % is left.
        let far = of(0.15);
        assert_eq!(far.outcome, Convergence::Approaching);
        assert!(far.remainder().unwrap() < -TOLERANCE);
    }

    #[test]
    fn a_power_law_has_no_limit() {
        let steep = trend(|h| 3.0 * h.powf(-1.6), &[1.0, 2.0, 4.0, 8.0]);
        assert_eq!((steep.outcome, steep.remainder()), (Convergence::NoLimit, None));
        let exponent = steep.exponent.unwrap();
        assert!((exponent.slope + 1.6).abs() < 1e-12 && exponent.points == 4);
        assert!((steep.change - 1.6 * 2f64.ln()).abs() < 1e-12);
        // The same whatever the ratios of the lengths.
        let uneven = trend(|h| 3.0 * h.powf(-1.6), &[1.0, 3.0, 4.0]);
        assert!((uneven.change - uneven.previous).abs() < 1e-12 && uneven.outcome == Convergence::NoLimit);
        // 2 % for each halving: neither seen to diverge nor to converge.
        assert_eq!(trend(|h| h.powf(-0.03), &[1.0, 2.0, 4.0]).outcome, Convergence::CannotTell);
        // 0.7 % for each halving is within 5 % over more of them.
        assert_eq!(trend(|h| h.powf(-0.01), &[1.0, 2.0, 4.0]).outcome, Convergence::Limit);
    }

    #[test]
    fn an_interval_leaves_open_what_it_covers() {
        let at = |half: f64| outcome(0.1, Some(half), 0.11, 1.0, TOLERANCE);
        assert_eq!((at(0.01), at(0.06)), (Convergence::NoLimit, Convergence::CannotTell));
        // Shrinks, unless the change is at the upper end of its interval.
        let shrunk = |half: f64| outcome(0.03, Some(half), 0.1, 1.0, TOLERANCE);
        let outcomes = [0.01, 0.025, 0.05].map(shrunk);
        assert_eq!(outcomes, [Convergence::Limit, Convergence::Approaching, Convergence::CannotTell]);
        // Nothing is seen to change.
        let still = |half: f64| outcome(0.01, Some(half), 0.0, 1.0, TOLERANCE);
        assert_eq!((still(0.02), still(0.045)), (Convergence::Limit, Convergence::CannotTell));
    }

    /// A change of nearly nothing after a large one is no sign of a limit at hand.
    #[test]
    fn an_accident_is_no_limit() {
        let after = |previous: f64| outcome(1e-4, None, previous, 1.0, TOLERANCE);
        assert_eq!((after(0.3), after(0.9)), (Convergence::Limit, Convergence::Approaching));
        assert!((remainder(1e-4, 0.9).unwrap() - 0.9 / 12.0).abs() < 1e-12);
    }

    #[test]
    fn the_interval_of_a_change_is_that_of_the_same_blocks() {
        let shares = [0.25; 4];
        let without = |values: [f64; 4]| Some(values.to_vec());
        let point = |length, value, without| Point { length, value, without };
        // Blocks that move both scales alike do not move the change.
        let alike = [
            point(1.0, 1.0, without([1.1, 0.9, 1.2, 0.8])),
            point(2.0, 0.7, without([0.8, 0.6, 0.9, 0.5])),
            point(4.0, 0.4, None),
        ];
        let found = Trend::new(TrendQuantity::Density, None, &alike, &shares, TOLERANCE).unwrap();
        assert!(found.half_width.unwrap() < 1e-12);
        let mut apart = alike.clone();
        apart[1].without = without([0.6, 0.8, 0.5, 0.9]);
        let found = Trend::new(TrendQuantity::Density, None, &apart, &shares, TOLERANCE).unwrap();
        assert!(found.half_width.unwrap() > 0.5 && found.outcome == Convergence::CannotTell);
        apart[1].without = without([0.6; 4]).map(|all| all[..3].to_vec());
        let found = Trend::new(TrendQuantity::Density, None, &apart, &shares, TOLERANCE).unwrap();
        assert_eq!(found.half_width, None, "other blocks");
        assert_eq!(Trend::new(TrendQuantity::Density, None, &alike[..2], &shares, TOLERANCE), None);
    }
}
