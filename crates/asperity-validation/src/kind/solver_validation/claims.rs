//! What the tests show, in a sentence each from typed facts.

use asperity_contact_framework::report::format::{mean_and_deviation, percent};

use super::results::{ERRORS, ErrorRow, PUBLISHED_WITHIN, SolverResults, errors, exceeded, is_near, worst};
use crate::solver::ensemble::EnsemblePoint;
use crate::solver::grid::{GridPoint, MAY_EXCEED};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, BenchmarkQuantity, Problem};

/// What was tested; the work alone where nothing else was.
pub fn answer(results: &SolverResults) -> String {
    let extrapolated = results.ensemble.as_ref().map_or(&[][..], |ensemble| &ensemble.extrapolated);
    let claims = bounds_claim(&results.benchmarks).into_iter().chain(area_claim(extrapolated));
    let claims: Vec<String> = claims.chain(grid_claim(&results.grid)).collect();
    if claims.is_empty() { work_claim(&results.work).unwrap_or_default() } else { claims.join(" ") }
}

/// Errors against known solutions, with that of Hertz's area on the finest grid.
fn bounds_claim(benchmarks: &[Benchmark]) -> Option<String> {
    let bounds = benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()).count();
    let exceeded = benchmarks.iter().filter(|benchmark| !benchmark.is_within()).count();
    let finest = errors(benchmarks).filter(|errors| errors.problem() == Problem::Hertz);
    let hertz = finest.max_by_key(ErrorRow::points).and_then(|errors| {
        let (area, points) = (errors.error(BenchmarkQuantity::Area)?.abs(), errors.points());
        Some(format!("; Hertz's area is within {} at {points} pixels per contact radius", percent(area)))
    });
    let hertz = hertz.unwrap_or_default();
    match (bounds, exceeded) {
        (0, _) => None,
        (_, 0) => {
            Some(format!("All {bounds} errors against known solutions are within their bounds{hertz}."))
        }
        _ => Some(format!(
            "Of {bounds} errors against known solutions, {exceeded} exceed their bounds{hertz}."
        )),
    }
}

/// How far extrapolated areas are from the published ones.
fn area_claim(extrapolated: &[EnsemblePoint]) -> Option<String> {
    let differences = || extrapolated.iter().filter_map(EnsemblePoint::difference);
    let largest = differences().max_by(|a, b| a.mean.abs().total_cmp(&b.mean.abs()))?;
    Some(format!(
        "Of {} published areas, {} are met within {} plus {ERRORS} standard errors; the largest difference is {} %.",
        differences().count(),
        differences().filter(|it| is_near(*it)).count(),
        percent(PUBLISHED_WITHIN),
        mean_and_deviation(100.0 * largest.mean, 100.0 * largest.error),
    ))
}

/// How many errors by the grid exceed the bounds that the reference states.
fn grid_claim(grid: &[GridPoint]) -> Option<String> {
    let parts = exceeded(grid)?;
    let contacts: usize = grid.iter().map(|point| point.contacts).sum();
    let (quantity, part) = parts.into_iter().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let worst = worst(grid, quantity).filter(|_| part > 0.0).map_or_else(String::new, |point| {
        let share = point.checks[quantity].exceeded as f64 / point.contacts as f64;
        format!("; of {} surfaces on the worst grid, {}", point.case.name(), percent(share))
    });
    Some(format!(
        "At most {} of the errors on {contacts} coarse contacts exceed their stated bound (allowed: {}){worst}.",
        percent(part),
        percent(MAY_EXCEED),
    ))
}

fn work_claim(work: &[WorkPoint]) -> Option<String> {
    let WorkPoint { points, convolutions, .. } = work.iter().max_by_key(|point| point.convolutions)?;
    Some(format!("A contact on {points} x {points} points takes at most {convolutions} convolutions."))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::ensemble::Mean;
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
            benchmark(Problem::Hertz, BenchmarkQuantity::Area, 7e-4, None),
            benchmark(Problem::Hertz, BenchmarkQuantity::Pressures, 0.004, Some(0.003)),
        ];
        let hertz = "; Hertz's area is within 0.07 % at 64 pixels per contact radius.";
        let some = format!("Of 2 errors against known solutions, 1 exceed their bounds{hertz}");
        assert_eq!(bounds_claim(&all).unwrap(), some);
        let none = format!("All 1 errors against known solutions are within their bounds{hertz}");
        assert_eq!(bounds_claim(&all[..2]).unwrap(), none);
        assert!(bounds_claim(&all[2..]).unwrap().ends_with("exceed their bounds."));
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
        let claim = area_claim(&[near.clone(), point(0.025, 0.2, 1e-4)]).unwrap();
        assert!(
            claim.starts_with("Of 2 published areas, 1 are met within 5 % plus 2 standard errors; "),
            "{claim}"
        );
        let claim = area_claim(&[near]).unwrap();
        assert!(claim.ends_with("the largest difference is -2.09 ± 0.13 %."), "{claim}");
        assert_eq!(area_claim(&[point(0.02, 0.1, 0.0)]), None);
    }

    #[test]
    fn parts_beyond_the_bounds_of_the_grid() {
        let check = |exceeded: usize| GridCheck { exceeded, error: 0.1, bound: 0.1 };
        let point = |exceeded: [usize; 3]| GridPoint {
            case: GridCase::Isotropic,
            points: [4, 4],
            contacts: 40,
            checks: exceeded.map(check),
        };
        let claim = grid_claim(&[point([1, 0, 2]), point([0, 0, 0])]).unwrap();
        assert_eq!(
            claim,
            "At most 2.5 % of the errors on 80 coarse contacts exceed their stated bound (allowed: 5 %); of isotropic surfaces on the \
             worst grid, 5 %."
        );
        assert!(grid_claim(&[point([0; 3])]).unwrap().ends_with("(allowed: 5 %)."));
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
        let claim = work_claim(&[64, 128, 256].map(contact)).unwrap();
        assert_eq!(claim, "A contact on 256 x 256 points takes at most 256 convolutions.");
        assert_eq!(work_claim(&[]), None);
    }
}
