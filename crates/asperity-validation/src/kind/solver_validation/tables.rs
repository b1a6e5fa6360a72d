//! `benchmarks.csv`, `ensemble.csv` and `work.csv`.

use super::run::SolverResults;
use crate::solver::Measured;
use crate::solver::ensemble::{EnsembleFindings, EnsemblePoint, Extrapolated, Mean};
use crate::solver::published::{ENSEMBLE, PublishedArea, published};
use crate::solver::work::WorkPoint;
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

/// One quantity of one problem.
struct BenchmarkRow<'a>(&'a Measured);

impl Row for BenchmarkRow<'_> {
    const FILE: &'static str = "benchmarks.csv";
    const ROWS: &'static str =
        "One row for each problem with a known solution, case, resolution and quantity.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            problem["text"] = row.0.problem.name(), "Problem: `hertz`, `sinusoid` (partial contact of a wave), `full-contact` or `layered-sphere`.";
            problem_case["text"] = row.0.case.as_str(), "Case of the problem; of `layered-sphere`: Young's modulus of the layer on that of the substrate, contact radius a over layer thickness t.";
            resolution["count"] = row.0.points, "Pixels per contact radius, or points per wavelength.";
            benchmark_quantity["text"] = row.0.quantity.name(), "Quantity whose error is given: `indentation`, `raw-area` (points counted), `area` (corrected for the border), `peak-pressure`, `pressures` (r.m.s. error over r.m.s. pressure; in full contact the largest error over the amplitude) or `mean-gap`.";
            exact_value["1"] = row.0.exact, "Exact value, with E* and R or the wavelength as units; of the mean gap over the height of the wave; empty for `pressures`.";
            found_value["1"] = row.0.found, "Value of the boundary elements; of a sinusoid the mean over places of the crest between two points (areas) or the one farthest from the exact value (gap).";
            measured_error["1", scale(1e-3)] = row.0.error, "Error: relative; of a sinusoid's areas (width over the wavelength) and gap the difference.";
            allowed_error["1", scale(1e-3)] = row.0.allowed, "Largest error allowed; empty where none is stated.";
        }
    }
}

/// Areas of the ensemble at one pressure.
struct EnsembleRow {
    /// Points along a side; `None` where extrapolated.
    points: Option<usize>,
    pressure: f64,
    raw_area: Mean,
    area: Mean,
    gap: Option<Mean>,
}

impl EnsembleRow {
    fn published(&self) -> Option<&'static PublishedArea> {
        published(self.pressure)
    }

    fn pixels_per_wave(&self) -> Option<f64> {
        self.points.map(|points| points as f64 * ENSEMBLE.cut_off / ENSEMBLE.side)
    }

    /// Of corrected areas, and of raw ones where they are extrapolated.
    fn kappa(&self) -> f64 {
        let area = if self.points.is_some() { self.area } else { self.raw_area };
        area.mean * ENSEMBLE.gradient / self.pressure
    }
}

impl From<&EnsemblePoint> for EnsembleRow {
    fn from(at: &EnsemblePoint) -> Self {
        let &EnsemblePoint { points, pressure, raw_area, area, gap } = at;
        Self { points: Some(points), pressure, raw_area, area, gap: Some(gap) }
    }
}

impl From<&Extrapolated> for EnsembleRow {
    fn from(at: &Extrapolated) -> Self {
        let &Extrapolated { pressure, raw_area, area } = at;
        Self { points: None, pressure, raw_area, area, gap: None }
    }
}

impl Row for EnsembleRow {
    const FILE: &'static str = "ensemble.csv";
    const ROWS: &'static str = "One row for each grid and pressure of the published ensemble, and for each pressure where areas are extrapolated.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            grid_points["count"] = row.points, "Points along a side of the map; empty where the areas are extrapolated linearly in the pixel from the two finest grids.";
            points_per_shortest_wave["1"] = row.pixels_per_wave(), "Points per shortest wave of the surface.";
            pressure_over_modulus["1"] = row.pressure, "Mean pressure over E*.";
            reduced_pressure["1"] = row.pressure / ENSEMBLE.gradient, "Mean pressure over E* times the r.m.s. gradient.";
            raw_area_mean["1"] = row.raw_area.mean, "Points in contact over all points, mean over the surfaces.";
            raw_area_standard_error["1", scale(1e-3)] = row.raw_area.error, "Its standard error.";
            area_mean["1"] = row.area.mean, "Area ratio corrected for the border of the contact, mean over the surfaces.";
            area_standard_error["1", scale(1e-3)] = row.area.error, "Its standard error.";
            kappa["1"] = row.kappa(), "Area ratio over the reduced pressure: of the corrected area, of the raw one where extrapolated.";
            gap_over_rms_height["1"] = row.gap.map(|gap| gap.mean), "Mean gap over the r.m.s. height of the surface, mean over the surfaces.";
            gap_standard_error["1", scale(1e-3)] = row.gap.map(|gap| gap.error), "Its standard error.";
            published_area["1"] = row.published().map(|published| published.area), "Published area ratio (Xu, Zhu, Xiao and Zhou 2024); empty at other pressures.";
            published_deviation["1"] = row.published().map(|published| published.deviation), "Published standard deviation over the surfaces.";
            earlier_area["1"] = row.published().and_then(|published| published.earlier), "Area ratio of an earlier file of the same authors, which does not say whether its surfaces are the same.";
        }
    }
}

/// The work of one contact.
struct WorkRow<'a>(&'a WorkPoint);

impl Row for WorkRow<'_> {
    const FILE: &'static str = "work.csv";
    const ROWS: &'static str = "One row for each map and load: what solving it took on the finest grid.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            points_along_side["count"] = row.0.points, "Points along a side of the map.";
            reduced_pressure["1"] = row.0.pressure, "Mean pressure over E* times the r.m.s. gradient.";
            corrected_area["1"] = row.0.area, "Area ratio corrected for the border of the contact.";
            steps["count"] = row.0.steps, "Steps of conjugate gradients.";
            convolutions["count"] = row.0.convolutions, "Convolutions of pressures or directions with the response.";
            dual_gap["1"] = row.0.error, "Relative dual gap reached.";
        }
    }
}

/// All tables.
pub(super) fn schemas() -> Vec<Schema> {
    vec![Schema::of::<BenchmarkRow>(), Schema::of::<EnsembleRow>(), Schema::of::<WorkRow>()]
}

/// The files of [`schemas`]; those of problems that were not run have no rows.
pub(super) fn tables(results: &SolverResults) -> Vec<Table> {
    let of_ensemble = |found: &EnsembleFindings| -> Vec<EnsembleRow> {
        found
            .points
            .iter()
            .map(EnsembleRow::from)
            .chain(found.extrapolated.iter().map(EnsembleRow::from))
            .collect()
    };
    vec![
        Table::new(results.measured.iter().map(BenchmarkRow)),
        Table::new(results.ensemble.iter().flat_map(of_ensemble)),
        Table::new(results.work.iter().map(WorkRow)),
    ]
}
