//! `solver-validation`: errors against known solutions and a published ensemble.

use asperity::literature;
use asperity::progress::Progress;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::format::{number, percent};
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};
use asperity_plot::{Axis, Colour, Figure, Layer, Marker};

use super::ensemble::{PUBLISHED, ensemble};
use super::{
    Benchmark, BenchmarkQuantity, LAYERED_CASES, Problem, full_contact, hertz, layered, partial_contact, plot,
};
use crate::{Drawing, Evidence, Failed, Form, Program, Task};

struct Size {
    hertz: &'static [usize],
    waves: &'static [usize],
    /// Their pressure over that which closes the gap.
    shares: &'static [f64],
    layered: usize,
    /// Points along a side of the published ensemble, surfaces, and pressures.
    ensemble: (&'static [usize], usize, usize),
}

const SHORT: Size =
    Size { hertz: &[4, 8], waves: &[16, 32], shares: &[0.3], layered: 8, ensemble: (&[200, 240], 2, 2) };

const FULL: Size = Size {
    hertz: &[8, 16, 32, 64, 128],
    waves: &[32, 64, 128, 256, 512, 1024],
    shares: &[0.05, 0.3, 0.7, 0.95],
    layered: 102,
    // 100 shortest waves lie along a side.
    ensemble: (&[256, 512, 1024], 4, PUBLISHED.len()),
};

pub const SOLVER_VALIDATION: Program = Program {
    name: "solver-validation",
    forms: [
        Form::new(
            "Hertz, waves, spheres on a layer, a published ensemble on up to 240 points a side",
            8e6,
            6e7,
        ),
        Form::new(
            "Hertz, waves, spheres on a layer, a published ensemble on up to 1024 points a side",
            1.08e8,
            4e9,
        ),
    ],
    tables: || vec![Schema::of::<&Benchmark>()],
    run,
};

fn run(task: &Task) -> Result<Evidence, Failed> {
    let size = if task.is_full { &FULL } else { &SHORT };
    let mut benchmarks = known(size, task.progress)?;
    let (points, realisations, pressures) = size.ensemble;
    task.progress.stage("ensemble", (points.len() * realisations * pressures) as f64);
    let seed = |realisation: usize| task.stream_seed(&format!("solver ensemble {realisation}"));
    benchmarks.extend(ensemble(points, realisations, &PUBLISHED[..pressures], seed, task.progress)?);
    Ok(Evidence {
        claim: claim(&benchmarks),
        warnings: warning(&benchmarks).into_iter().collect(),
        drawings: vec![convergence(&benchmarks)],
        tables: vec![Table::new(&benchmarks)],
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

/// Errors against known solutions, with those of Hertz's area on the finest grid and of the extrapolated areas of the ensemble.
fn claim(benchmarks: &[Benchmark]) -> String {
    let bounds = benchmarks.iter().filter(|benchmark| benchmark.allowed.is_some()).count();
    let verdict = match benchmarks.iter().filter(|benchmark| !benchmark.is_within()).count() {
        0 => format!("All {bounds} errors against known solutions are within their bounds"),
        exceeded => format!("Of {bounds} errors against known solutions, {exceeded} exceed their bounds"),
    };
    let finest = |problem, quantity| largest_errors(benchmarks, problem, quantity).pop().unwrap_or_default();
    let (points, hertz) = finest(Problem::Hertz, BenchmarkQuantity::Area);
    let (_, published) = finest(Problem::Ensemble, BenchmarkQuantity::LimitArea);
    format!(
        "{verdict}. Hertz's area is within {} at {points} pixels per contact radius, extrapolated areas of a published ensemble within {}.",
        percent(hertz),
        percent(published),
    )
}

/// Says how many bounds are exceeded, and which most.
fn warning(benchmarks: &[Benchmark]) -> Option<String> {
    let factor = |benchmark: &Benchmark| benchmark.error.abs() / benchmark.allowed.unwrap_or(f64::INFINITY);
    let exceeded = || benchmarks.iter().filter(|benchmark| !benchmark.is_within());
    let farthest = exceeded().max_by(|a, b| factor(a).total_cmp(&factor(b)))?;
    let Benchmark { problem, points, quantity, error, allowed, .. } = farthest;
    Some(format!(
        "{} errors against known solutions exceed their bounds, most that of the {} ({}, {points} points): {}; allowed: {}",
        exceeded().count(),
        quantity.name(),
        problem.name(),
        number(error.abs()),
        number(allowed.unwrap_or(f64::INFINITY)),
    ))
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
            let (colour, name) = (Colour::Series(k), quantity.name());
            plot = plot.with(Layer::line(points.clone()).coloured(colour).named(name));
            plot = plot.with(Layer::points(points, Marker::Circle).coloured(colour).named(name));
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
            problem["text"] = row.problem.name(), "Problem: `hertz`, `sinusoid` (partial contact of a wave), `full-contact`, `layered-sphere` or `ensemble` (published areas of self-affine surfaces: Xu, Zhu, Xiao and Zhou 2024).";
            problem_case["text", label("case")] = row.case.as_str(), "Case of the problem; of `layered-sphere`: Young's modulus of the layer on that of the substrate, contact radius a over layer thickness t; of `ensemble` the pressure.";
            resolution["count"] = row.points, "Pixels per contact radius, or points per wavelength; of `ensemble` points along a side, 100 shortest waves, of the finest grid where areas are extrapolated.";
            benchmark_quantity["text", label("quantity")] = row.quantity.name(), "Quantity whose error is given: `indentation`, `raw-area` (points counted), `area` (corrected for the border), `extrapolated-area` (counted on the two finest grids, linearly in the pixel), `peak-pressure`, `pressures` (r.m.s. error over r.m.s. pressure; in full contact the largest error over the amplitude) or `mean-gap`.";
            exact_value["1"] = row.values.map(|[exact, _]| exact), "Exact or published value, with E* and R or the wavelength as units; of the mean gap over the height of the wave; empty for `pressures`.";
            found_value["1", label("computed value")] = row.values.map(|[_, computed]| computed), "Value of the boundary elements; of a sinusoid the mean over places of the crest between two points (areas) or the one farthest from the exact value (gap); of `ensemble` the mean over surfaces.";
            measured_error["1", label("error"), scale(1e-3)] = row.error, "Error: relative; of a sinusoid's areas (width over the wavelength) and gap the difference.";
            allowed_error["1", scale(1e-3)] = row.allowed, "Largest error allowed; empty where none is stated. Of extrapolated areas 5 %, by which the authors' own files differ, and two standard errors.";
        }
    }
}
