//! What the comparisons of the solver amount to.

use crate::solver::ensemble::{EnsembleFindings, EnsemblePoint, Extrapolated, Mean};
use crate::solver::published::{PublishedArea, published};
use crate::solver::work::WorkPoint;
use crate::solver::{Measured, Problem, Quantity};
use asperity::compare::SlopeFit;
use asperity_framework::report::format::{input_number, number, percent};

/// The lowest order of convergence of Hertz's indentation that is accepted; 2 is expected.
pub const LOWEST_ORDER: f64 = 1.7;

/// How far extrapolated areas may be from the published ones: two files of the authors differ by as much.
pub const PUBLISHED_WITHIN: f64 = 0.05;

/// Standard errors by which a difference from a published area may exceed [`PUBLISHED_WITHIN`].
const ERRORS: f64 = 2.0;

/// Loads whose standard error of the area is larger do not count where kinds of area are ranked.
pub const MOST_SAMPLING: f64 = 0.015;

/// How an area is obtained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AreaOf {
    /// Points in contact on a grid.
    Raw(usize),
    /// The same, corrected for the border.
    Corrected(usize),
    /// Extrapolated from the raw areas of the two finest grids.
    Extrapolated,
}

/// Difference between areas of one kind and published ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    pub of: AreaOf,
    /// Root mean square of the relative difference from the published areas, over the pressures within [`MOST_SAMPLING`].
    pub published: f64,
    /// The same of the earlier ones, where there are any.
    pub earlier: Option<f64>,
    /// [`Self::published`] over all pressures, whatever their sampling error.
    pub at_all_loads: f64,
}

/// An extrapolated area beside the published one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    /// p/E*.
    pub pressure: f64,
    /// Extrapolated over published area, minus 1, with its standard error.
    pub difference: Mean,
}

impl Beside {
    /// Whether the areas agree within [`PUBLISHED_WITHIN`] and the sampling error.
    pub fn holds(&self) -> bool {
        self.difference.mean.abs() <= PUBLISHED_WITHIN + ERRORS * self.difference.error
    }
}

/// Findings over all problems.
#[derive(Debug, Clone)]
pub struct SolverFindings {
    /// Order of convergence of Hertz's indentation, from the two finest grids.
    pub order: Option<f64>,
    /// Every kind of area of the ensemble, the nearest to the published ones first; empty where no area is known within
    /// [`MOST_SAMPLING`].
    pub deviations: Vec<Deviation>,
    /// Pressure by pressure, where there is a published area.
    pub beside: Vec<Beside>,
    /// kappa of extrapolated areas by p/(E* g).
    pub kappa: Vec<(f64, Mean)>,
    /// Exponent with which convolutions grow with the points along a side, load by load (p/(E* g)).
    pub growth: Vec<(f64, SlopeFit)>,
}

impl SolverFindings {
    /// Findings over results.
    pub fn of(measured: &[Measured], ensemble: Option<&EnsembleFindings>, work: &[WorkPoint]) -> Self {
        let mut deviations = ensemble.map(deviations).unwrap_or_default();
        deviations.sort_by(|a, b| a.published.total_cmp(&b.published));
        let beside = ensemble.iter().flat_map(|found| &found.extrapolated).filter_map(beside).collect();
        let kappa = ensemble.iter().flat_map(|found| {
            let of = |at: &Extrapolated| {
                let reduced = at.pressure / found.gradient;
                (reduced, at.raw_area.times(reduced.recip()))
            };
            found.extrapolated.iter().map(of)
        });
        Self { order: order(measured), deviations, beside, kappa: kappa.collect(), growth: growth(work) }
    }

    /// The largest difference from a published area.
    pub fn farthest(&self) -> Option<&Beside> {
        self.beside.iter().max_by(|a, b| a.difference.mean.abs().total_cmp(&b.difference.mean.abs()))
    }

    /// Bounds that are exceeded, a line each.
    pub fn warnings(&self, measured: &[Measured]) -> Vec<String> {
        let beyond = measured.iter().filter(|one| !one.holds()).map(|one| {
            format!(
                "{}, {}, {} points: the error of the {} is {}; allowed: {}",
                one.problem.name(),
                one.case,
                one.points,
                one.quantity.words(),
                number(one.error.abs()),
                number(one.allowed.unwrap_or(f64::INFINITY)),
            )
        });
        let order = self.order.filter(|order| *order < LOWEST_ORDER).map(|order| {
            format!(
                "hertz: the indentation converges with order {}; allowed: at least {LOWEST_ORDER}",
                number(order)
            )
        });
        let apart = self.beside.iter().filter(|one| !one.holds()).map(|one| {
            format!(
                "ensemble, p/E* = {}: the extrapolated area is {} ± {} from the published one; allowed: {} and {ERRORS} standard \
                 errors",
                input_number(one.pressure),
                percent(one.difference.mean),
                percent(one.difference.error),
                percent(PUBLISHED_WITHIN)
            )
        });
        beyond.chain(order).chain(apart).collect()
    }
}

/// Order of convergence of the largest error of a quantity over the cases, fitted over all resolutions.
pub fn fitted_order(measured: &[Measured], problem: Problem, quantity: Quantity) -> Option<f64> {
    let of_quantity = || measured.iter().filter(|one| (one.problem, one.quantity) == (problem, quantity));
    let mut points: Vec<usize> = of_quantity().map(|one| one.points).collect();
    points.dedup();
    let largest = points.into_iter().map(|points| {
        let errors = of_quantity().filter(|one| one.points == points).map(|one| one.error.abs());
        (points as f64, errors.fold(0.0, f64::max))
    });
    SlopeFit::through(largest).map(|fit| -fit.slope)
}

fn order(measured: &[Measured]) -> Option<f64> {
    let mut of_indentation =
        measured.iter().filter(|one| (one.problem, one.quantity) == (Problem::Hertz, Quantity::Indentation));
    let fine = of_indentation.next_back()?;
    let coarse = of_indentation.next_back()?;
    let order = (coarse.error / fine.error).abs().ln() / (fine.points as f64 / coarse.points as f64).ln();
    order.is_finite().then_some(order)
}

fn beside(at: &Extrapolated) -> Option<Beside> {
    let published = published(at.pressure)?;
    let ratio = at.raw_area.times(published.area.recip());
    let difference = Mean { mean: ratio.mean - 1.0, ..ratio };
    Some(Beside { pressure: at.pressure, difference })
}

fn deviations(found: &EnsembleFindings) -> Vec<Deviation> {
    let sampled = |pressure: f64| {
        let mut at = found.points.iter().filter(|point| point.pressure == pressure);
        at.all(|point| point.raw_area.error <= MOST_SAMPLING * point.raw_area.mean)
    };
    let mut grids: Vec<usize> = found.points.iter().map(|point| point.points).collect();
    grids.dedup();
    let on_grid = |grid: usize, of: fn(&EnsemblePoint) -> Mean| -> Vec<(f64, f64)> {
        let points = found.points.iter().filter(|point| point.points == grid);
        points.map(|point| (point.pressure, of(point).mean)).collect()
    };
    let of_grids = grids.into_iter().flat_map(|grid| {
        [
            (AreaOf::Raw(grid), on_grid(grid, |point| point.raw_area)),
            (AreaOf::Corrected(grid), on_grid(grid, |point| point.area)),
        ]
    });
    let extrapolated = found.extrapolated.iter().map(|at| (at.pressure, at.raw_area.mean)).collect();
    let all = of_grids.chain([(AreaOf::Extrapolated, extrapolated)]);
    all.filter_map(|(of, mut areas): (AreaOf, Vec<(f64, f64)>)| {
        let at_all_loads = apart(&areas, |published| Some(published.area))?;
        areas.retain(|(pressure, _)| sampled(*pressure));
        Some(Deviation {
            of,
            published: apart(&areas, |published| Some(published.area))?,
            earlier: apart(&areas, |published| published.earlier),
            at_all_loads,
        })
    })
    .collect()
}

/// Root mean square of the relative differences; `None` without a common pressure.
fn apart(areas: &[(f64, f64)], of: impl Fn(&PublishedArea) -> Option<f64>) -> Option<f64> {
    let squares: Vec<f64> = areas
        .iter()
        .filter_map(|&(pressure, area)| Some((area / of(published(pressure)?)? - 1.0).powi(2)))
        .collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

fn growth(work: &[WorkPoint]) -> Vec<(f64, SlopeFit)> {
    let mut pressures: Vec<f64> = Vec::new();
    for point in work {
        if !pressures.contains(&point.pressure) {
            pressures.push(point.pressure);
        }
    }
    let fit = |pressure: f64| {
        let of_load = work.iter().filter(|point| point.pressure == pressure);
        let fit = SlopeFit::through(of_load.map(|point| (point.points as f64, point.convolutions as f64)))?;
        Some((pressure, fit))
    };
    pressures.into_iter().filter_map(fit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn indentation(points: usize, error: f64, allowed: f64) -> Measured {
        Measured {
            problem: Problem::Hertz,
            case: "sphere".to_owned(),
            points,
            quantity: Quantity::Indentation,
            exact: Some(1.0),
            found: Some(1.0 + error),
            error,
            allowed: Some(allowed),
        }
    }

    #[test]
    fn errors_beyond_their_bounds_and_a_low_order_are_warned_of() {
        let good = [indentation(32, -8e-5, 1e-4), indentation(64, -2e-5, 2.5e-5)];
        let findings = SolverFindings::of(&good, None, &[]);
        assert!((findings.order.unwrap() - 2.0).abs() < 1e-12);
        assert!(findings.warnings(&good).is_empty());
        let poor = [indentation(32, 8e-5, 1e-4), indentation(64, -4e-5, 2.5e-5)];
        let findings = SolverFindings::of(&poor, None, &[]);
        let warnings = findings.warnings(&poor);
        assert_eq!(warnings.len(), 2, "{warnings:?}");
        assert!(
            warnings[0].contains("64 points: the error of the indentation is 4e-5; allowed: 2.5e-5"),
            "{warnings:?}"
        );
        assert_eq!(SolverFindings::of(&poor[..1], None, &[]).order, None);
    }

    fn ensemble(share: f64, error: f64) -> EnsembleFindings {
        let mean = |mean: f64| Mean { mean, error };
        let area = 0.077_926_64;
        EnsembleFindings {
            realisations: 3,
            gradient: 0.2766,
            height: mean(6e-6),
            points: vec![EnsemblePoint {
                points: 512,
                pressure: 0.01,
                raw_area: mean(area),
                area: mean(0.9 * area),
                gap: mean(0.8),
            }],
            extrapolated: vec![Extrapolated {
                pressure: 0.01,
                raw_area: mean(share * area),
                area: mean(area),
            }],
        }
    }

    #[test]
    fn published_areas_are_compared_within_sampling_error() {
        let within = SolverFindings::of(&[], Some(&ensemble(0.96, 1e-5)), &[]);
        assert!(within.warnings(&[]).is_empty());
        assert_eq!(within.deviations[0].of, AreaOf::Raw(512));
        assert!((within.kappa[0].1.mean - 0.96 * 0.077_926_64 * 27.66).abs() < 1e-12);
        assert_eq!(SolverFindings::of(&[], Some(&ensemble(0.92, 1e-5)), &[]).warnings(&[]).len(), 1);
        // Two standard errors of 2 %; too much to rank kinds of area by.
        assert!(SolverFindings::of(&[], Some(&ensemble(0.92, 0.0016)), &[]).deviations.is_empty());
        assert!(SolverFindings::of(&[], Some(&ensemble(0.92, 0.0016)), &[]).warnings(&[]).is_empty());
    }
}
