//! The results, and what follows from them: the largest errors, differences from published areas, warnings.

use crate::solver::ensemble::{EnsemblePoint, EnsembleResults, Mean};
use crate::solver::grid::{GridPoint, MAY_EXCEED};
use crate::solver::published::{PublishedArea, published};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, BenchmarkQuantity, Problem, Profile};
use asperity::compare::SlopeFit;
use asperity::numeric::extremes;
use asperity_contact_framework::metadata::Metadata;
use asperity_contact_framework::report::format::{number, percent};

/// The lowest order of convergence of Hertz's indentation that is accepted; 2 is expected.
pub const LOWEST_ORDER: f64 = 1.7;

/// How far extrapolated areas may be from the published ones: two files of the authors differ by as much.
pub const PUBLISHED_WITHIN: f64 = 0.05;

/// Standard errors by which a difference from a published area may exceed [`PUBLISHED_WITHIN`].
pub const ERRORS: f64 = 2.0;

/// Kinds of area are ranked at pressures whose standard error of the area is at most this.
pub const MOST_SAMPLING: f64 = 0.015;

/// Comparisons of the solver.
#[derive(Debug)]
pub struct SolverResults {
    /// What every experiment has.
    pub metadata: Metadata,
    /// Problems with a known solution, problem by problem, resolution by resolution.
    pub benchmarks: Vec<Benchmark>,
    /// Hertz's pressures on the coarsest grid.
    pub hertz_profile: Option<Profile>,
    /// Pressures of a wave, load by load.
    pub wave_profiles: Vec<Profile>,
    pub ensemble: Option<EnsembleResults>,
    /// Case by case, grid by grid.
    pub grid: Vec<GridPoint>,
    pub work: Vec<WorkPoint>,
}

/// The benchmarks, resolution by resolution.
pub fn errors(benchmarks: &[Benchmark]) -> impl DoubleEndedIterator<Item = ErrorRow<'_>> {
    benchmarks.chunk_by(|a, b| (a.problem, a.points) == (b.problem, b.points)).map(ErrorRow)
}

/// Order of convergence of Hertz's indentation, from the two finest grids.
pub fn order(benchmarks: &[Benchmark]) -> Option<f64> {
    let hertz = errors(benchmarks).rev().filter(|errors| errors.problem() == Problem::Hertz);
    let mut indentation = hertz.filter_map(|errors| errors.largest(BenchmarkQuantity::Indentation));
    let (fine, coarse) = (indentation.next()?, indentation.next()?);
    let order = (coarse.error / fine.error).abs().ln() / (fine.points as f64 / coarse.points as f64).ln();
    order.is_finite().then_some(order)
}

/// Order of convergence of the largest error of a quantity, fitted over all grids; `None` of fewer than three.
pub fn fitted_order(benchmarks: &[Benchmark], problem: Problem, quantity: BenchmarkQuantity) -> Option<f64> {
    let errors = errors(benchmarks).filter(|errors| errors.problem() == problem);
    let points = errors.filter_map(|errors| Some((errors.points() as f64, errors.error(quantity)?.abs())));
    SlopeFit::through(points).map(|fit| -fit.slope)
}

/// The quantities of [`GridPoint`], in a sentence.
pub const GRID_QUANTITIES: [&str; 3] = ["area", "separation", "stiffness"];

/// The part of all contacts on coarse grids whose error exceeds its bound, by quantity; none without contacts.
pub fn exceeded(grid: &[GridPoint]) -> Option<[f64; 3]> {
    let contacts: usize = grid.iter().map(|point| point.contacts).sum();
    let part = |quantity: usize| {
        grid.iter().map(|point| point.checks[quantity].exceeded).sum::<usize>() as f64 / contacts as f64
    };
    (contacts > 0).then(|| [0, 1, 2].map(part))
}

/// The kind of surface and grid on which the largest part of the errors of a quantity exceeds its bound.
pub fn worst(grid: &[GridPoint], quantity: usize) -> Option<&GridPoint> {
    let part = |point: &GridPoint| point.checks[quantity].exceeded as f64 / point.contacts as f64;
    grid.iter().max_by(|a, b| part(a).total_cmp(&part(b)))
}

/// Bounds by the grid that too many errors exceed, a line each.
pub fn grid_warnings(grid: &[GridPoint]) -> Vec<String> {
    let parts = exceeded(grid).into_iter().flat_map(|parts| GRID_QUANTITIES.into_iter().zip(parts));
    let line = |(quantity, part): (&str, f64)| {
        let (part, allowed) = (percent(part), percent(MAY_EXCEED));
        format!("grid: {part} of the errors of the {quantity} exceed their bound; allowed: {allowed}")
    };
    parts.filter(|(_, part)| *part > MAY_EXCEED).map(line).collect()
}

/// Bounds that are exceeded, a line for each kind.
pub fn warnings(benchmarks: &[Benchmark], ensemble: Option<&EnsembleResults>) -> Vec<String> {
    let exceeded: Vec<&Benchmark> = benchmarks.iter().filter(|benchmark| !benchmark.is_within()).collect();
    let factor = |benchmark: &Benchmark| benchmark.error.abs() / benchmark.allowed.unwrap_or(f64::INFINITY);
    let farthest = exceeded.iter().max_by(|a, b| factor(a).total_cmp(&factor(b)));
    let known = farthest.map(|benchmark| {
        let Benchmark { problem, points, quantity, error, allowed, .. } = benchmark;
        format!(
            "{} errors against known solutions exceed their bounds, most that of the {} ({}, {points} points): {}; allowed: {}",
            exceeded.len(),
            quantity.words(),
            problem.name(),
            number(error.abs()),
            number(allowed.unwrap_or(f64::INFINITY)),
        )
    });
    let order = order(benchmarks).filter(|order| *order < LOWEST_ORDER).map(|order| {
        let order = number(order);
        format!("hertz: the indentation converges with order {order}; allowed: at least {LOWEST_ORDER}")
    });
    let areas = ensemble.into_iter().flat_map(|ensemble| &ensemble.extrapolated);
    let distant: Vec<Mean> =
        areas.filter_map(EnsemblePoint::difference).filter(|difference| !is_near(*difference)).collect();
    let farthest = distant.iter().map(|difference| difference.mean.abs()).reduce(f64::max);
    let distant = farthest.map(|farthest| {
        format!(
            "ensemble: {} extrapolated areas are further than {} and {ERRORS} standard errors from the published ones (at most {})",
            distant.len(),
            percent(PUBLISHED_WITHIN),
            percent(farthest),
        )
    });
    known.into_iter().chain(order).chain(distant).collect()
}

/// The benchmarks of a problem at one resolution; there is at least one.
#[derive(Debug, Clone, Copy)]
pub struct ErrorRow<'a>(pub &'a [Benchmark]);

impl<'a> ErrorRow<'a> {
    pub fn problem(&self) -> Problem {
        self.0[0].problem
    }

    /// Points per contact radius or per wavelength.
    pub fn points(&self) -> usize {
        self.0[0].points
    }

    /// The benchmark of a quantity with the largest error.
    pub fn largest(&self, quantity: BenchmarkQuantity) -> Option<&'a Benchmark> {
        let of_quantity = self.0.iter().filter(|benchmark| benchmark.quantity == quantity);
        of_quantity.max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))
    }

    /// The largest error of a quantity.
    pub fn error(&self, quantity: BenchmarkQuantity) -> Option<f64> {
        self.largest(quantity).map(|benchmark| benchmark.error)
    }
}

/// Whether a difference from a published area is at most [`PUBLISHED_WITHIN`] plus [`ERRORS`] standard errors.
pub fn is_near(difference: Mean) -> bool {
    difference.mean.abs() <= PUBLISHED_WITHIN + ERRORS * difference.error
}

/// Root mean square of the relative difference of areas of one kind from others, over the pressures within [`MOST_SAMPLING`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// `raw`, `corrected` or `extrapolated`.
    pub area: &'static str,
    /// Points along a side; `None` where extrapolated.
    pub points: Option<usize>,
    /// From the published areas.
    pub published: f64,
    /// From the earlier ones, where there are any.
    pub earlier: Option<f64>,
    /// From the published areas, at all pressures.
    pub at_all_pressures: f64,
}

/// Every kind of area, the nearest to the published ones first; none where no area is known within [`MOST_SAMPLING`].
pub fn deviations(ensemble: &EnsembleResults) -> Vec<Deviation> {
    let is_sampled = |pressure: f64| {
        let mut points = ensemble.points.iter().filter(|point| point.pressure == pressure);
        points.all(|point| point.raw_area.error <= MOST_SAMPLING * point.raw_area.mean)
    };
    let deviation = |area: &'static str, points: &[EnsemblePoint], mean: fn(&EnsemblePoint) -> Mean| {
        let sampled = || points.iter().filter(|point| is_sampled(point.pressure));
        let published = |published: &PublishedArea| Some(published.area);
        Some(Deviation {
            area,
            points: points.first()?.points,
            published: rms_difference(sampled(), mean, published)?,
            earlier: rms_difference(sampled(), mean, |published| published.earlier),
            at_all_pressures: rms_difference(points.iter(), mean, published)?,
        })
    };
    let on_grids = ensemble.grids().flat_map(|points| {
        [deviation("raw", points, |point| point.raw_area), deviation("corrected", points, |point| point.area)]
    });
    let extrapolated = deviation("extrapolated", &ensemble.extrapolated, |point| point.raw_area);
    let mut deviations: Vec<Deviation> = on_grids.chain([extrapolated]).flatten().collect();
    deviations.sort_by(|a, b| a.published.total_cmp(&b.published));
    deviations
}

/// `None` without a common pressure.
fn rms_difference<'a>(
    points: impl Iterator<Item = &'a EnsemblePoint>,
    mean: fn(&EnsemblePoint) -> Mean,
    other: impl Fn(&PublishedArea) -> Option<f64>,
) -> Option<f64> {
    let square =
        |point: &EnsemblePoint| Some((mean(point).mean / other(published(point.pressure)?)? - 1.0).powi(2));
    let squares: Vec<f64> = points.filter_map(square).collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// The loads of `work`, ascending.
pub fn loads(work: &[WorkPoint]) -> Vec<f64> {
    let mut loads: Vec<f64> = work.iter().map(|point| point.pressure).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup();
    loads
}

/// Convolutions against points along a side, at one load.
pub fn convolutions(work: &[WorkPoint], load: f64) -> impl Iterator<Item = (f64, f64)> {
    let at_load = work.iter().filter(move |point| point.pressure == load);
    at_load.map(|point| (point.points as f64, point.convolutions as f64))
}

/// The lowest and the highest exponent, over the loads, with which convolutions grow with the points along a side.
pub fn growth(work: &[WorkPoint]) -> Option<[f64; 2]> {
    let slopes = loads(work).into_iter().filter_map(|load| SlopeFit::through(convolutions(work, load)));
    extremes(slopes.map(|fit| fit.slope))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::grid::{GridCase, GridCheck};

    fn indentation(points: usize, error: f64, allowed: f64) -> Benchmark {
        Benchmark {
            problem: Problem::Hertz,
            case: "sphere".to_owned(),
            points,
            quantity: BenchmarkQuantity::Indentation,
            exact: Some(1.0),
            computed: Some(1.0 + error),
            error,
            allowed: Some(allowed),
        }
    }

    #[test]
    fn errors_beyond_their_bounds_and_a_low_order_are_warned_of() {
        let good = [indentation(32, -8e-5, 1e-4), indentation(64, -2e-5, 2.5e-5)];
        assert!((order(&good).unwrap() - 2.0).abs() < 1e-12);
        assert!(warnings(&good, None).is_empty());
        let poor = [indentation(32, 8e-5, 1e-4), indentation(64, -4e-5, 2.5e-5)];
        let lines = warnings(&poor, None);
        assert_eq!(lines.len(), 2, "{lines:?}");
        assert!(
            lines[0].starts_with("1 errors")
                && lines[0].contains("(hertz, 64 points): 4e-5; allowed: 2.5e-5"),
            "{lines:?}"
        );
        assert_eq!(order(&poor[..1]), None);
    }

    fn ensemble(share: f64, error: f64) -> EnsembleResults {
        let mean = |mean: f64| Mean { mean, error };
        let area = 0.077_926_64;
        let point = |points, share| EnsemblePoint {
            points,
            pressure: 0.01,
            raw_area: mean(share * area),
            area: mean(0.9 * area),
            gap: None,
        };
        EnsembleResults {
            realisations: 3,
            height: mean(6e-6),
            points: vec![point(Some(512), 1.0)],
            extrapolated: vec![point(None, share)],
        }
    }

    #[test]
    fn published_areas_are_compared_within_sampling_error() {
        let near = ensemble(0.96, 1e-5);
        assert!(warnings(&[], Some(&near)).is_empty());
        let nearest = deviations(&near)[0];
        assert_eq!((nearest.area, nearest.points, nearest.published), ("raw", Some(512), 0.0));
        assert!((near.extrapolated[0].kappa().mean - 0.96 * 0.077_926_64 * 27.66).abs() < 1e-12);
        assert_eq!(warnings(&[], Some(&ensemble(0.92, 1e-5))).len(), 1);
        // Two standard errors of 2 %; too much to rank kinds of area by.
        let scattered = ensemble(0.92, 0.0016);
        assert!(deviations(&scattered).is_empty() && warnings(&[], Some(&scattered)).is_empty());
    }

    #[test]
    fn a_twentieth_of_the_errors_by_the_grid_may_exceed_their_bounds() {
        let check = |exceeded: usize| GridCheck { exceeded, error: 0.1, bound: 0.1 };
        let point = |exceeded: [usize; 3]| GridPoint {
            case: GridCase::Isotropic,
            points: [4, 4],
            contacts: 20,
            checks: exceeded.map(check),
        };
        let grid = [point([1, 0, 1]), point([1, 0, 2])];
        assert_eq!(exceeded(&grid), Some([0.05, 0.0, 0.075]));
        let lines = grid_warnings(&grid);
        assert_eq!(lines, ["grid: 7.5 % of the errors of the stiffness exceed their bound; allowed: 5 %"]);
        assert!(exceeded(&[]).is_none() && grid_warnings(&grid[..1]).is_empty());
    }

    #[test]
    fn convolutions_grow_with_a_power_of_the_points() {
        let contact = |points: usize, pressure: f64| WorkPoint {
            points,
            pressure,
            area: 0.1,
            steps: 1,
            convolutions: if pressure < 0.1 { points } else { points * points },
            error: 1e-8,
        };
        let work: Vec<WorkPoint> = [64, 128, 256]
            .into_iter()
            .flat_map(|points| [contact(points, 0.2), contact(points, 0.02)])
            .collect();
        assert_eq!(loads(&work), [0.02, 0.2]);
        let [low, high] = growth(&work).unwrap();
        assert!((low - 1.0).abs() < 1e-12 && (high - 2.0).abs() < 1e-12);
        assert_eq!(growth(&work[..4]), None);
    }
}
