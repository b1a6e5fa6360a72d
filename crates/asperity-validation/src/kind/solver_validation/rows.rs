//! The tables: errors against known solutions, areas of the ensemble, and the work of the solver.

use super::results::{Deviation, ErrorRow, SolverResults, deviations, errors, is_near};
use crate::solver::ensemble::EnsemblePoint;
use crate::solver::grid::GridPoint;
use crate::solver::published::{ENSEMBLE, published};
use crate::solver::work::WorkPoint;
use crate::solver::{Benchmark, BenchmarkQuantity};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};

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

impl Row for ErrorRow<'_> {
    const FILE: &'static str = "errors.csv";
    const ROWS: &'static str =
        "One row for each problem with a known solution and resolution: the largest error over the cases.";
    const RECORDS: Option<&'static str> = Some("errors");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            problem["text"] = row.problem().name(), "Problem, as in `benchmarks.csv`.";
            resolution["count"] = row.points(), "Pixels per contact radius, or points per wavelength.";
            comparisons["count"] = row.0.len(), "Cases times quantities.";
            within_bounds["true/false"] = row.0.iter().all(Benchmark::is_within), "Whether all errors that have a bound are within it.";
            indentation_error["1", label("indentation"), scale(1e-3)] = row.error(BenchmarkQuantity::Indentation), "Relative error of the indentation.";
            raw_area_error["1", label("area by counting points"), scale(1e-3)] = row.error(BenchmarkQuantity::RawArea), "Error of the area of the points in contact: relative; of a sinusoid that of the width over the wavelength.";
            area_error["1", label("corrected area"), scale(1e-3)] = row.error(BenchmarkQuantity::Area), "The same of the area corrected for the border of the contact.";
            peak_pressure_error["1", label("peak pressure"), scale(1e-3)] = row.error(BenchmarkQuantity::PeakPressure), "Relative error of the highest pressure.";
            pressures_error["1", label("pressures (r.m.s.)"), scale(1e-3)] = row.error(BenchmarkQuantity::Pressures), "R.m.s. error of the pressures over the r.m.s. pressure; in full contact the largest error over the amplitude.";
            mean_gap_error["1", label("mean gap"), scale(1e-3)] = row.error(BenchmarkQuantity::MeanGap), "Error of the mean gap over the height of the wave.";
        }
    }
}

fn points_per_wave(points: Option<usize>) -> Option<f64> {
    points.map(|points| points as f64 * ENSEMBLE.cut_off / ENSEMBLE.side)
}

impl Row for &EnsemblePoint {
    const FILE: &'static str = "ensemble.csv";
    const ROWS: &'static str = "One row for each grid and pressure of the published ensemble, and for each pressure where areas are extrapolated.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            grid_points["count", label("points")] = row.points, "Points along a side of the map; empty where the areas are extrapolated linearly in the pixel from the two finest grids.";
            points_per_shortest_wave["1"] = points_per_wave(row.points), "Points per shortest wave of the surface.";
            pressure_over_modulus["1", label("p/E*"), input] = row.pressure, "Mean pressure over E*.";
            reduced_pressure["1", label("p/(E* g)")] = row.reduced_pressure(), "Mean pressure over E* times the r.m.s. gradient.";
            raw_area_mean["1", label("raw area")] = row.raw_area.mean, "Points in contact over all points, mean over the surfaces.";
            raw_area_standard_error["1", label("± s.e."), scale(1e-3)] = row.raw_area.error, "Its standard error.";
            area_mean["1", label("corrected area")] = row.area.mean, "Area ratio corrected for the border of the contact, mean over the surfaces.";
            area_standard_error["1", label("± s.e."), scale(1e-3)] = row.area.error, "Its standard error.";
            kappa["1", label("κ")] = row.kappa().mean, "Area ratio over the reduced pressure: of the corrected area, of the raw one where extrapolated.";
            gap_over_rms_height["1", label("gap/r.m.s. height")] = row.gap.map(|gap| gap.mean), "Mean gap over the r.m.s. height of the surface, mean over the surfaces.";
            gap_standard_error["1", label("± s.e."), scale(1e-3)] = row.gap.map(|gap| gap.error), "Its standard error.";
            published_area["1"] = published(row.pressure).map(|published| published.area), "Published area ratio (Xu, Zhu, Xiao and Zhou 2024); empty at other pressures.";
            published_deviation["1"] = published(row.pressure).map(|published| published.deviation), "Published standard deviation over the surfaces.";
            earlier_area["1"] = published(row.pressure).and_then(|published| published.earlier), "Area ratio of an earlier file of the same authors, which does not say whether its surfaces are the same.";
        }
    }
}

/// The ensemble at one pressure, extrapolated from the two finest grids.
pub struct AreaRow<'a>(&'a EnsemblePoint);

impl Row for AreaRow<'_> {
    const FILE: &'static str = "areas.csv";
    const ROWS: &'static str = "One row for each pressure of the published ensemble: the extrapolated area beside the published one.";
    const RECORDS: Option<&'static str> = Some("areas");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            pressure_over_modulus["1", label("p/E*"), input] = row.0.pressure, "Mean pressure over E*.";
            reduced_pressure["1", label("p/(E* g)")] = row.0.reduced_pressure(), "Mean pressure over E* times the r.m.s. gradient.";
            extrapolated_area["1"] = row.0.raw_area.mean, "Area ratio extrapolated linearly in the pixel from the raw areas of the two finest grids.";
            published_area["1"] = published(row.0.pressure).map(|published| published.area), "Published area ratio; empty at other pressures.";
            difference["1", signed_percent, scale(1.0)] = row.0.difference().map(|difference| difference.mean), "Extrapolated over published area, minus 1.";
            standard_error["1", label("± s.e."), percent, scale(1.0)] = row.0.difference().map(|difference| difference.error), "Its standard error over the surfaces.";
            within["true/false"] = row.0.difference().map(is_near), "Whether the difference is at most 5 % plus two standard errors.";
            kappa["1", label("κ")] = row.0.kappa().mean, "Extrapolated area over the reduced pressure.";
            kappa_standard_error["1", label("± s.e."), scale(1e-3)] = row.0.kappa().error, "Its standard error.";
        }
    }
}

impl Row for Deviation {
    const FILE: &'static str = "deviations.csv";
    const ROWS: &'static str = "One row for each kind of area of the ensemble, the nearest to the published ones first. Differences are relative, root mean squares over the pressures with a standard error of at most 1.5 % on every grid.";
    const RECORDS: Option<&'static str> = Some("deviations");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            area["text"] = row.area, "Kind of area: `raw` (points counted), `corrected` for the border of the contact, or `extrapolated` from the raw areas of the two finest grids.";
            grid_points["count", label("points")] = row.points, "Points along a side of the map; empty where extrapolated.";
            points_per_shortest_wave["1"] = points_per_wave(row.points), "Points per shortest wave of the surface.";
            difference_from_published["1", percent] = row.published, "Difference from the published areas.";
            difference_from_earlier["1", percent] = row.earlier, "Difference from the areas of an earlier file of the same authors.";
            difference_at_all_pressures["1", percent] = row.at_all_pressures, "Difference from the published areas at all pressures.";
        }
    }
}

impl Row for &GridPoint {
    const FILE: &'static str = "grid.csv";
    const ROWS: &'static str = "One row for each case and coarse grid: errors against 32 points per shortest wave, and the bounds that the reference states.";
    const RECORDS: Option<&'static str> = Some("grid");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            grid_case["text", label("surfaces")] = row.case.name(), "Surfaces and contact: `isotropic`, `elongated` (lengths along x three times those along y), a quarter of such a surface `mirrored`, or `capped` (isotropic, pressures up to 0.2 E* g).";
            points_per_wave_x["count", label("points per wave, x")] = row.points[0], "Points along x per shortest wave; of elongated surfaces per shortest wave across the lay.";
            points_per_wave_y["count", label("y")] = row.points[1], "The same along y.";
            contacts["count"] = row.contacts, "Surfaces times loads.";
            area_exceeded["count", label("area: beyond bound")] = row.checks[0].exceeded, "Contacts whose error of ln(corrected area) exceeds its bound.";
            area_error["1", label("95 % of errors")] = row.checks[0].error, "Error of ln(corrected area) that 95 % of the contacts do not exceed.";
            area_bound["1", label("mean bound")] = row.checks[0].bound, "Mean of the bounds.";
            separation_exceeded["count", label("separation: beyond bound")] = row.checks[1].exceeded, "Contacts whose error of the mean gap exceeds its bound.";
            separation_error["1", label("95 % of errors")] = row.checks[1].error, "Error of the mean gap over the r.m.s. height that 95 % of the contacts do not exceed.";
            separation_bound["1", label("mean bound")] = row.checks[1].bound, "Mean of the bounds over the r.m.s. height.";
            stiffness_exceeded["count", label("stiffness: beyond bound")] = row.checks[2].exceeded, "Contacts whose error of ln(stiffness) exceeds its bound.";
            stiffness_error["1", label("95 % of errors")] = row.checks[2].error, "Error of ln(stiffness) that 95 % of the contacts do not exceed.";
            stiffness_bound["1", label("mean bound")] = row.checks[2].bound, "Mean of the bounds.";
        }
    }
}

impl Row for &WorkPoint {
    const FILE: &'static str = "work.csv";
    const ROWS: &'static str = "One row for each map and load: what solving it took on the finest grid.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            points_along_side["count"] = row.points, "Points along a side of the map.";
            reduced_pressure["1", label("p/(E* g)"), input] = row.pressure, "Mean pressure over E* times the r.m.s. gradient.";
            corrected_area["1", percent] = row.area, "Area ratio corrected for the border of the contact.";
            steps["count"] = row.steps, "Steps of conjugate gradients.";
            convolutions["count"] = row.convolutions, "Convolutions of pressures or directions with the response.";
            dual_gap["1"] = row.error, "Relative dual gap reached.";
        }
    }
}

/// All tables.
pub(super) fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<ErrorRow>(),
        Schema::of::<&Benchmark>(),
        Schema::of::<AreaRow>(),
        Schema::of::<Deviation>(),
        Schema::of::<&EnsemblePoint>(),
        Schema::of::<&GridPoint>(),
        Schema::of::<&WorkPoint>(),
    ]
}

/// Those that have rows: of the problems that were run.
pub(super) fn tables(results: &SolverResults) -> Vec<Table> {
    let ensemble = results.ensemble.as_ref();
    let extrapolated = || ensemble.iter().flat_map(|ensemble| &ensemble.extrapolated);
    let on_grids = ensemble.iter().flat_map(|ensemble| &ensemble.points);
    let tables = [
        Table::new(errors(&results.benchmarks)),
        Table::new(&results.benchmarks),
        Table::new(extrapolated().map(AreaRow)),
        Table::new(ensemble.map(deviations).unwrap_or_default()),
        Table::new(on_grids.chain(extrapolated())),
        Table::new(&results.grid),
        Table::new(&results.work),
    ];
    tables.into_iter().filter(|table| table.rows() > 0).collect()
}
