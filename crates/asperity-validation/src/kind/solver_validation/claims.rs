//! What each test shows, in a sentence from typed facts.

use asperity_contact_framework::report::format::{
    input_number, listed, mean_and_deviation, number, percent, ratio,
};

use super::results::{
    ERRORS, ErrorRow, GRID_QUANTITIES, LOWEST_ORDER, PUBLISHED_WITHIN, SolverResults, errors, exceeded,
    growth, is_near, order, worst,
};
use crate::solver::ensemble::{EnsemblePoint, Mean, bush_gibson_thomas, persson};
use crate::solver::grid::{GridPoint, MAY_EXCEED};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, BenchmarkQuantity, Problem};

/// What each test shows, a line each.
pub fn claims(results: &SolverResults) -> Vec<String> {
    let benchmarks = results.benchmarks.as_slice();
    let finest = Problem::ALL.into_iter().filter_map(|problem| {
        errors(benchmarks).filter(|errors| errors.problem() == problem).max_by_key(ErrorRow::points)
    });
    let extrapolated = results.ensemble.as_ref().map_or(&[][..], |ensemble| &ensemble.extrapolated);
    let mut claims: Vec<String> = bounds_claim(benchmarks).into_iter().collect();
    claims.extend(finest.map(error_claim));
    claims.extend(order(benchmarks).map(|order| {
        let order = ratio(order);
        format!("**Convergence**: Hertz's indentation with order {order} (allowed: at least {LOWEST_ORDER}).")
    }));
    claims.extend(area_claim(extrapolated));
    claims.extend(extrapolated.first().map(kappa_claim));
    claims.extend(grid_claim(&results.grid));
    claims.extend(work_claim(&results.work));
    claims
}

fn bounds_claim(benchmarks: &[Benchmark]) -> Option<String> {
    let bounds = benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()).count();
    let exceeded = benchmarks.iter().filter(|benchmark| !benchmark.is_within()).count();
    match (bounds, exceeded) {
        (0, _) => None,
        (_, 0) => Some(format!("**Known solutions**: all {bounds} errors that have a bound are within it.")),
        _ => Some(format!("**Known solutions**: {exceeded} of {bounds} errors exceed their bound.")),
    }
}

/// The errors at one resolution that have a bound. Those near rounding differ between machines and are not told apart.
fn error_claim(errors: ErrorRow) -> String {
    const ROUNDING: f64 = 1e-13;
    let (problem, points) = match errors.problem() {
        Problem::Hertz => ("Hertz", "pixels per contact radius"),
        Problem::Sinusoid => ("Wavy surface", "points per wavelength"),
        Problem::FullContact => ("Full contact, with and without a layer", "points per wavelength"),
        Problem::LayeredSphere => ("Sphere on a layer", "pixels per contact radius"),
    };
    let claim = |quantity: BenchmarkQuantity| {
        let Benchmark { error, allowed, .. } = errors.largest(quantity)?;
        let (error, allowed) = (number(error.abs().max(ROUNDING)), number((*allowed)?));
        let quantity = quantity.words().trim_end_matches(" (r.m.s.)");
        Some(format!("{quantity} within {error} (allowed: {allowed})"))
    };
    let bounded = [
        BenchmarkQuantity::Indentation,
        BenchmarkQuantity::Area,
        BenchmarkQuantity::MeanGap,
        BenchmarkQuantity::Pressures,
    ];
    let claims: Vec<String> = bounded.into_iter().filter_map(claim).collect();
    format!("**{problem}** ({} {points}): {}.", errors.points(), listed(&claims))
}

/// How far extrapolated areas are from the published ones.
fn area_claim(extrapolated: &[EnsemblePoint]) -> Option<String> {
    let differences = || extrapolated.iter().filter_map(|point| Some((point.pressure, point.difference()?)));
    let count = |is_counted: fn(Mean) -> bool| differences().filter(|(_, it)| is_counted(*it)).count();
    let (pressure, largest) = differences().max_by(|(_, a), (_, b)| a.mean.abs().total_cmp(&b.mean.abs()))?;
    Some(format!(
        "**Published ensemble**: {} of {} extrapolated areas are within {} plus two standard errors of the published ones; {} differ by \
         more than two standard errors. The largest difference is {} % (± standard error, at p/E\\* = {}).",
        count(is_near),
        differences().count(),
        percent(PUBLISHED_WITHIN),
        count(|it| it.mean.abs() > ERRORS * it.error),
        mean_and_deviation(100.0 * largest.mean, 100.0 * largest.error),
        input_number(pressure),
    ))
}

/// kappa at the lightest load.
fn kappa_claim(lightest: &EnsemblePoint) -> String {
    let kappa = lightest.kappa();
    format!(
        "**Light loads**: κ = A E\\* g/(A₀ p) is {} (± standard error) at p/(E\\* g) = {}; Bush, Gibson and Thomas's is {}, Persson's {}.",
        mean_and_deviation(kappa.mean, kappa.error),
        number(lightest.reduced_pressure()),
        ratio(bush_gibson_thomas()),
        ratio(persson()),
    )
}

/// How many errors by the grid exceed the bounds that the reference states.
fn grid_claim(grid: &[GridPoint]) -> Option<String> {
    let parts = exceeded(grid)?;
    let contacts: usize = grid.iter().map(|point| point.contacts).sum();
    let of = |(index, part): (usize, f64)| {
        let worst = worst(grid, index).map_or_else(String::new, |point| {
            let GridPoint { case, points: [x, y], contacts, checks } = point;
            let exceeded = checks[index].exceeded;
            format!(" (most: {exceeded} of {contacts}, {}, {x} x {y} points per wave)", case.name())
        });
        format!("{} of the errors of the {}{worst}", percent(part), GRID_QUANTITIES[index])
    };
    let parts: Vec<String> = parts.into_iter().enumerate().map(of).collect();
    Some(format!(
        "**Grid**: of {contacts} contacts on coarse grids, {} exceed the bound that the reference states (allowed: {} of all).",
        listed(&parts),
        percent(MAY_EXCEED),
    ))
}

fn work_claim(work: &[WorkPoint]) -> Option<String> {
    let WorkPoint { points, pressure, convolutions, error, .. } =
        work.iter().max_by_key(|point| point.convolutions)?;
    let growth = growth(work).map_or_else(String::new, |[low, high]| {
        let (low, high) = (ratio(low), ratio(high));
        let power = if low == high { low } else { format!("{low} to {high}") };
        format!("; their number grows with the points along a side to the power {power}")
    });
    Some(format!(
        "**Work**: at most {convolutions} convolutions, to a relative dual gap of {}, on {points} x {points} points at p/(E\\* g) = {}{growth}.",
        number(*error),
        number(*pressure)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::grid::{GridCase, GridCheck};

    fn benchmark(
        problem: Problem,
        quantity: BenchmarkQuantity,
        error: f64,
        allowed: Option<f64>,
    ) -> Benchmark {
        Benchmark {
            problem,
            case: String::new(),
            points: 64,
            quantity,
            exact: None,
            computed: None,
            error,
            allowed,
        }
    }

    #[test]
    fn errors_and_their_bounds() {
        let all = [
            benchmark(Problem::Hertz, BenchmarkQuantity::Indentation, -1e-5, Some(2e-5)),
            benchmark(Problem::Hertz, BenchmarkQuantity::RawArea, 0.01, None),
            benchmark(Problem::Hertz, BenchmarkQuantity::Pressures, 0.004, Some(0.003)),
        ];
        assert_eq!(
            error_claim(ErrorRow(&all)),
            "**Hertz** (64 pixels per contact radius): indentation within 1e-5 (allowed: 2e-5) and pressures within 0.004 (allowed: 0.003)."
        );
        let rounding = [benchmark(Problem::FullContact, BenchmarkQuantity::Pressures, 3e-15, Some(1e-12))];
        assert!(error_claim(ErrorRow(&rounding)).ends_with("pressures within 1e-13 (allowed: 1e-12)."));
        assert!(bounds_claim(&all).unwrap().contains("1 of 2 errors exceed"));
        assert!(bounds_claim(&all[..2]).unwrap().contains("all 1 errors"));
        assert_eq!(bounds_claim(&all[1..2]), None);
    }

    #[test]
    fn areas_beside_the_published_ones() {
        let point = |pressure: f64, mean: f64, error: f64| {
            let area = Mean { mean, error };
            EnsemblePoint { points: None, pressure, raw_area: area, area, gap: None }
        };
        // Published: 0.077_926_64 and 0.185_244_2.
        let near = point(0.01, 0.0763, 1e-4);
        assert!(area_claim(&[near.clone(), point(0.025, 0.2, 1e-4)]).unwrap().starts_with(
            "**Published ensemble**: 1 of 2 extrapolated areas are within 5 % plus two standard errors of the published ones; 2 differ"
        ));
        let claim = area_claim(std::slice::from_ref(&near)).unwrap();
        assert!(
            claim.ends_with("The largest difference is -2.09 ± 0.13 % (± standard error, at p/E\\* = 0.01)."),
            "{claim}"
        );
        assert_eq!(area_claim(&[point(0.02, 0.1, 0.0)]), None);
        assert!(
            kappa_claim(&near).contains("is 2.11 ± 0.0028 (± standard error) at p/(E\\* g) = 0.0362"),
            "{}",
            kappa_claim(&near)
        );
    }

    #[test]
    fn parts_beyond_the_bounds_of_the_grid() {
        let check = |exceeded: usize| GridCheck { exceeded, error: 0.1, bound: 0.1 };
        let point = GridPoint {
            case: GridCase::Isotropic,
            points: [4, 4],
            contacts: 40,
            checks: [1, 0, 2].map(check),
        };
        let claim = grid_claim(&[point]).unwrap();
        assert!(
            claim.contains("of 40 contacts on coarse grids, 2.5 % of the errors of the area (most: 1 of 40, isotropic, 4 x 4 "),
            "{claim}"
        );
        assert_eq!(grid_claim(&[]), None);
    }

    #[test]
    fn the_most_work() {
        let contact = |points: usize| WorkPoint {
            points,
            pressure: 0.02,
            area: 0.1,
            steps: 9,
            convolutions: points,
            error: 1e-8,
        };
        let work = [64, 128, 256].map(contact);
        let claim = work_claim(&work).unwrap();
        assert!(claim.contains("256 convolutions") && claim.ends_with("to the power 1.00."), "{claim}");
        assert!(work_claim(&work[..2]).unwrap().ends_with("g) = 0.02."));
        assert_eq!(work_claim(&[]), None);
    }
}
