//! `solver-validation`: known solutions, a published ensemble, bounds of the errors by the grid.

use asperity::literature;
use asperity::progress::Progress;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::{mean_and_deviation, number, percent};
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_plot::{Axis, Colour, Figure, Layer};

use super::ensemble::{Ensemble, EnsemblePoint, Mean, ensemble};
use super::grid::{self, GridPoint, Grids};
use super::{
    Benchmark, BenchmarkQuantity, LAYERED_CASES, Problem, full_contact, hertz, layered, partial_contact,
    plot, with_series,
};
use crate::program::{Drawing, Evidence, Failed, Form, Program, Task};

struct Size {
    hertz: &'static [usize],
    waves: &'static [usize],
    /// Their pressure over that which closes the gap.
    shares: &'static [f64],
    layered: usize,
    ensemble: Ensemble,
    grids: Grids,
}

const SHORT: Size = Size {
    hertz: &[4, 8],
    waves: &[16, 32],
    shares: &[0.3],
    layered: 8,
    ensemble: Ensemble { points: &[200, 240], realisations: 2, pressures: &[0.113, 0.147], error: 1e-3 },
    grids: Grids { points: 256, realisations: 2, pressures: &[0.02], error: 1e-6 },
};

const FULL: Size = Size {
    hertz: &[8, 16, 32, 64, 128],
    waves: &[32, 64, 128, 256, 512, 1024],
    shares: &[0.05, 0.3, 0.7, 0.95],
    layered: 102,
    // 17 pressures have a published area; 100 shortest waves lie along a side.
    ensemble: Ensemble {
        points: &[256, 512, 1024],
        realisations: 4,
        pressures: &[1e-4, 1e-3, 5e-3, 0.01, 0.025, 0.065, 0.147, 0.3],
        error: 1e-6,
    },
    grids: Grids { points: 1024, realisations: 5, pressures: &[0.002, 0.006, 0.02], error: 1e-6 },
};

/// The lowest order of convergence of Hertz's indentation that is accepted; 2 is expected.
const LOWEST_ORDER: f64 = 1.7;

/// How far extrapolated areas may be from the published ones, two files of whose authors differ by as much, and by how many standard
/// errors more.
const PUBLISHED_WITHIN: f64 = 0.05;
const ERRORS: f64 = 2.0;

pub const SOLVER_VALIDATION: Program = Program {
    name: "solver-validation",
    forms: [
        Form::new(
            "Hertz, waves, spheres on a layer, the published ensemble and grids on up to 256 points a side",
            8e6,
            8e7,
        ),
        Form::new(
            "Hertz, waves, spheres on a layer, the published ensemble and grids on up to 1024 points a side",
            1.08e8,
            7.3e9,
        ),
    ],
    tables: || vec![Schema::of::<&Benchmark>(), Schema::of::<&EnsemblePoint>(), Schema::of::<&GridPoint>()],
    run,
};

fn run(task: &Task) -> Result<Evidence, Failed> {
    let size = if task.is_full { &FULL } else { &SHORT };
    let benchmarks = known(size, task.progress)?;
    let of = &size.ensemble;
    task.progress.stage("ensemble", (of.points.len() * of.realisations * of.pressures.len()) as f64);
    let seed = |realisation: usize| task.stream_seed(&format!("solver ensemble {realisation}"));
    let ensemble = ensemble(of, seed, task.progress)?;
    let grid = grid::solved(&size.grids, task)?;
    let mut warnings = warnings(&benchmarks, &ensemble.extrapolated);
    warnings.extend(grid::warnings(&grid));
    Ok(Evidence {
        claim: [bounds_claim(&benchmarks), area_claim(&ensemble.extrapolated), grid::claim(&grid)].join(" "),
        warnings,
        drawings: vec![convergence(&benchmarks), grid::drawing(&grid)],
        tables: vec![
            Table::new(&benchmarks),
            Table::new(ensemble.points.iter().chain(&ensemble.extrapolated)),
            Table::new(&grid),
        ],
        set_up: vec!["Method: [theory](../../docs/theory.md#how-the-reference-is-checked).".to_owned()],
        papers: vec![
            literature::POLONSKY_KEER_1999,
            literature::YASTREBOV_2017,
            literature::JOHNSON_1985,
            literature::JOHNSON_GREENWOOD_HIGGINSON_1985,
            literature::PERRIOT_BARTHEL_2004,
            literature::XU_2024,
        ],
        ..Evidence::default()
    })
}

fn known(size: &Size, progress: &dyn Progress) -> Result<Vec<Benchmark>, Failed> {
    let mut benchmarks = Vec::new();
    let mut extend = |more: Vec<Benchmark>| {
        benchmarks.extend(more);
        progress.advance(1.0);
    };
    progress.stage("spheres", (size.hertz.len() + LAYERED_CASES.len()) as f64);
    for &pixels in size.hertz {
        extend(hertz(pixels)?);
    }
    for case in &LAYERED_CASES {
        extend(layered(case, size.layered)?);
    }
    progress.stage("waves", (size.waves.len() * size.shares.len()) as f64);
    for &count in size.waves {
        for &share in size.shares {
            extend(partial_contact(count, share)?);
        }
    }
    benchmarks.extend(full_contact()?);
    Ok(benchmarks)
}

/// The largest error of a quantity of a problem at each resolution, over its cases.
fn largest_errors(
    benchmarks: &[Benchmark],
    problem: Problem,
    quantity: BenchmarkQuantity,
) -> Vec<(f64, f64)> {
    let at_resolution = benchmarks.chunk_by(|a, b| (a.problem, a.points) == (b.problem, b.points));
    let largest = |benchmarks: &[Benchmark]| {
        let of_quantity = benchmarks.iter().filter(|of| of.problem == problem && of.quantity == quantity);
        let largest = of_quantity.map(|of| of.error.abs()).reduce(f64::max)?;
        Some((benchmarks[0].points as f64, largest))
    };
    at_resolution.filter_map(largest).collect()
}

/// Errors against known solutions, with that of Hertz's area on the finest grid.
fn bounds_claim(benchmarks: &[Benchmark]) -> String {
    let bounds = benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()).count();
    let hertz =
        largest_errors(benchmarks, Problem::Hertz, BenchmarkQuantity::Area).last().map(|(points, area)| {
            format!("; Hertz's area is within {} at {points} pixels per contact radius", percent(*area))
        });
    let hertz = hertz.unwrap_or_default();
    match benchmarks.iter().filter(|benchmark| !benchmark.is_within()).count() {
        0 => format!("All {bounds} errors against known solutions are within their bounds{hertz}."),
        exceeded => {
            format!("Of {bounds} errors against known solutions, {exceeded} exceed their bounds{hertz}.")
        }
    }
}

/// How far extrapolated areas are from the published ones.
fn area_claim(extrapolated: &[EnsemblePoint]) -> String {
    let differences: Vec<Mean> = extrapolated.iter().filter_map(EnsemblePoint::difference).collect();
    let largest = differences.iter().max_by(|a, b| a.mean.abs().total_cmp(&b.mean.abs()));
    let largest = largest
        .map_or_else(String::new, |largest| mean_and_deviation(100.0 * largest.mean, 100.0 * largest.error));
    format!(
        "Of {} published areas, {} are met within {} plus {ERRORS} standard errors; the largest difference is {largest} %.",
        differences.len(),
        differences.iter().filter(|difference| is_near(**difference)).count(),
        percent(PUBLISHED_WITHIN),
    )
}

/// Whether a difference from a published area is at most what is allowed.
fn is_near(difference: Mean) -> bool {
    difference.mean.abs() <= PUBLISHED_WITHIN + ERRORS * difference.error
}

/// Bounds that are exceeded, a line for each kind.
fn warnings(benchmarks: &[Benchmark], extrapolated: &[EnsemblePoint]) -> Vec<String> {
    let exceeded: Vec<&Benchmark> = benchmarks.iter().filter(|benchmark| !benchmark.is_within()).collect();
    let factor = |benchmark: &Benchmark| benchmark.error.abs() / benchmark.allowed.unwrap_or(f64::INFINITY);
    let farthest = exceeded.iter().max_by(|a, b| factor(a).total_cmp(&factor(b)));
    let known = farthest.map(|benchmark| {
        let Benchmark { problem, points, quantity, error, allowed, .. } = benchmark;
        format!(
            "{} errors against known solutions exceed their bounds, most that of the {} ({}, {points} points): {}; allowed: {}",
            exceeded.len(),
            quantity.name(),
            problem.name(),
            number(error.abs()),
            number(allowed.unwrap_or(f64::INFINITY)),
        )
    });
    let indentation = largest_errors(benchmarks, Problem::Hertz, BenchmarkQuantity::Indentation);
    let order = match indentation[..] {
        [.., coarse, fine] => (coarse.1 / fine.1).ln() / (fine.0 / coarse.0).ln(),
        _ => f64::INFINITY,
    };
    let order = (order < LOWEST_ORDER).then(|| {
        let order = number(order);
        format!("hertz: the indentation converges with order {order}; allowed: at least {LOWEST_ORDER}")
    });
    let differences = extrapolated.iter().filter_map(EnsemblePoint::difference);
    let distant: Vec<f64> =
        differences.filter(|difference| !is_near(*difference)).map(|one| one.mean.abs()).collect();
    let farthest = distant.iter().copied().reduce(f64::max);
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

/// The largest errors against resolution, with lines of the orders that are expected.
fn convergence(benchmarks: &[Benchmark]) -> Drawing {
    use BenchmarkQuantity::{Area, Indentation, MeanGap, PeakPressure, Pressures, RawArea};
    const QUANTITIES: [(BenchmarkQuantity, Option<f64>); 6] = [
        (Indentation, Some(2.0)),
        (RawArea, None),
        (Area, None),
        (PeakPressure, None),
        (Pressures, Some(1.0)),
        (MeanGap, Some(2.0)),
    ];
    let panel = |title: &str, problem: Problem, resolution: &str| {
        let mut plot = plot(title, Axis::log(resolution), Axis::log("largest error"));
        for (k, (quantity, order)) in QUANTITIES.into_iter().enumerate() {
            let points = largest_errors(benchmarks, problem, quantity);
            let Some(&(x, y)) = points.first() else { continue };
            plot = with_series(plot, points, Colour::Series(k), quantity.name());
            if let Some(order) = order {
                plot = plot.with(Layer::slope((x, 0.6 * y), -order, format!("order {order}")));
            }
        }
        plot
    };
    let panels = vec![
        panel("Hertz", Problem::Hertz, "pixels per contact radius"),
        panel("Wavy surface", Problem::Sinusoid, "points per wavelength"),
    ];
    Drawing {
        file: "known-solutions.svg",
        figure: Figure::row("Errors against known solutions", panels),
        caption: "Errors against resolution, with lines of orders 1 and 2.".to_owned(),
    }
}

impl Row for &Benchmark {
    const FILE: &'static str = "benchmarks.csv";
    const ROWS: &'static str =
        "One row for each problem with a known solution, case, resolution and quantity.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            problem["text"] = row.problem.name(), "Problem: `hertz`, `sinusoid` (partial contact of a wave), `full-contact` or `layered-sphere`.";
            problem_case["text", label("case")] = row.case.as_str(), "Case of the problem; of `layered-sphere`: Young's modulus of the layer on that of the substrate, contact radius a over layer thickness t.";
            resolution["count"] = row.points, "Pixels per contact radius, or points per wavelength.";
            benchmark_quantity["text", label("quantity")] = row.quantity.name(), "Quantity whose error is given: `indentation`, `raw-area` (points counted), `area` (corrected for the border), `peak-pressure`, `pressures` (r.m.s. error over r.m.s. pressure; in full contact the largest error over the amplitude) or `mean-gap`.";
            exact_value["1"] = row.exact, "Exact value, with E* and R or the wavelength as units; of the mean gap over the height of the wave; empty for `pressures`.";
            found_value["1", label("computed value")] = row.computed, "Value of the boundary elements; of a sinusoid the mean over places of the crest between two points (areas) or the one farthest from the exact value (gap).";
            measured_error["1", label("error"), scale(1e-3)] = row.error, "Error: relative; of a sinusoid's areas (width over the wavelength) and gap the difference.";
            allowed_error["1", scale(1e-3)] = row.allowed, "Largest error allowed; empty where none is stated.";
        }
    }
}
