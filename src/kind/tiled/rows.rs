//! The tables of a surface in tiles.

use asperity::Statistics;
use asperity::compare::Pair;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};

use super::results::{LawResults, TiledResults, TiledSurface};
use crate::model_tables::{CurveRow, PairRow, RowCase, comparison_of_models, curves_of_models, limits};
use crate::surface::rows::SurfaceRow;

/// Half-width of a 95 % interval in standard errors.
pub const INTERVAL: f64 = 1.96;

pub struct SeparationRow<'a> {
    law: &'a LawResults,
    pair: &'a Pair,
    error: Option<f64>,
}

impl<'a> SeparationRow<'a> {
    pub fn all(law: &'a LawResults) -> impl Iterator<Item = Self> {
        law.at_separations().map(move |(pair, error)| Self { law, pair, error })
    }

    /// d/sigma.
    pub fn separation(&self) -> f64 {
        self.pair.target
    }

    fn over_sum(&self, pressure: f64) -> Option<f64> {
        Some(pressure / self.pair.deterministic.pressure.total()).filter(|ratio| ratio.is_finite())
    }

    /// Pressure of the integral over that of the sum.
    pub fn ratio(&self) -> Option<f64> {
        self.over_sum(self.pair.statistical.pressure.total())
    }

    /// Standard error of the sum's pressure, relative to it.
    pub fn relative_error(&self) -> Option<f64> {
        self.error.and_then(|error| self.over_sum(error))
    }

    /// Whether the integral is in the 95 % interval of the sum; `None` without one, or not admissible.
    pub fn is_within(&self) -> Option<bool> {
        let (ratio, error) = (self.ratio()?, self.relative_error().filter(|_| self.pair.is_admissible())?);
        Some((ratio - 1.0).abs() <= INTERVAL * error)
    }
}

impl Row for SeparationRow<'_> {
    const FILE: &'static str = "separations.csv";
    const ROWS: &'static str = "One row for each law, layer thickness and separation: both models at equal separation, with the sampling error of the sum from the scatter of its tiles.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            law["text"] = row.law.law.as_str(), "Contact law of an asperity.";
            layer_thickness_m["m", label("layer"), thickness] = row.law.thickness, "Thickness of the layer; empty where the spec has no layer.";
            separation_over_sigma["1", input] = row.separation(), "Separation over sigma.";
            deterministic_pressure_pa["Pa", label("pressure of the sum")] = row.pair.deterministic.pressure.total(), "Nominal pressure of the sum.";
            relative_standard_error_from_tiles["1", label("± s.e."), percent] = row.relative_error(), "Standard error of that pressure, relative to it, from the scatter of the tiles; empty where fewer than eight tiles carry load.";
            statistical_pressure_pa["Pa", label("pressure of the integral")] = row.pair.statistical.pressure.total(), "Nominal pressure of the integral.";
            statistical_over_deterministic_pressure["1", label("integral over sum")] = row.ratio(), "The second over the first.";
            deterministic_area_ratio["1", label("area ratio of the sum")] = row.pair.deterministic.area_ratio.total(), "Real contact area of the sum over nominal area.";
            within_interval["true/false", label("in the interval")] = row.is_within(), "Whether the integral lies in the 95 % interval of the sum; empty without one and where the load is not admissible.";
            limits["text"] = limits(row.pair.exceeded()), "Limits of admissible loads that are exceeded, as in `curves.csv`.";
        }
    }
}

pub fn surface_row(surface: &TiledSurface) -> SurfaceRow<'_> {
    let mean_height = surface.origin + surface.statistics.mean_height;
    SurfaceRow {
        name: &surface.name,
        realisation: 1,
        asperities: surface.count,
        nominal_area: surface.nominal_area,
        statistics: Statistics { mean_height, ..surface.statistics },
        moments: None,
        surface: None,
        plasticity_index: None,
        population: Some(&surface.population),
    }
}

pub fn tables(results: &TiledResults) -> Vec<Table> {
    let case = |law: &LawResults| RowCase::layered(&results.surface.name, &law.law, law.thickness);
    let modulus = results.contact.reduced_modulus;
    let curves = results.laws.iter().flat_map(|law| CurveRow::of_case(&case(law), &law.comparison, modulus));
    let pairs = results.laws.iter().flat_map(|law| {
        let case = case(law);
        let area = results.surface.nominal_area;
        law.comparison.pairs.iter().map(move |&pair| PairRow::of_models(case.clone(), pair, area, None))
    });
    vec![
        curves_of_models(curves),
        comparison_of_models(pairs),
        Table::new(results.laws.iter().flat_map(SeparationRow::all)),
        Table::new([surface_row(&results.surface)]),
    ]
}
