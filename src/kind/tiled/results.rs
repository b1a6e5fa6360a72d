//! Results of both models on a surface in tiles, and their table.

use asperity::compare::{Comparison, CurvePoint, ModelKind, Pair, Pairing};
use asperity::study::LawContact;
use asperity::{Model, Population, ReferencePlane, Response, Shape, Statistical, Statistics, Total};
use asperity_contact_framework::metadata::{ContactMetadata, Metadata};
use asperity_contact_framework::report::table::Table;
use asperity_contact_framework::rows;

use crate::model_tables::{CurveRow, PairRow, RowCase, comparison_of_models, curves_of_models, limits};
use crate::surface::rows::SurfaceRow;

/// Both models on a surface in tiles.
#[derive(Debug)]
pub struct TiledResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    pub surface: TiledSurface,
    /// Law by law, thickness by thickness.
    pub laws: Vec<LawResults>,
    /// Warnings about materials and separations that are hardly meant.
    pub implausible: Vec<String>,
}

/// A surface, from the sums over its tiles.
#[derive(Debug)]
pub struct TiledSurface {
    pub name: String,
    pub tiles: usize,
    pub count: usize,
    /// Nominal area, m^2.
    pub nominal_area: f64,
    /// Height in the file that heights are relative to, m.
    pub origin: f64,
    /// Statistics of all asperities, heights relative to `origin`.
    pub statistics: Statistics,
    pub population: Population,
    /// Where separations are measured from, heights relative to `origin`.
    pub plane: ReferencePlane,
    /// The same relative to the mean height of `population`.
    pub reporting_plane: ReferencePlane,
}

#[derive(Debug)]
pub struct LawResults {
    pub law: String,
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// Curves at the separations; pairs there and at the pressures of the sum.
    pub comparison: Comparison,
    /// Standard error of the nominal pressure of the sum at each separation, Pa, from the scatter of the tiles; `None` where too
    /// few tiles are in contact.
    pub errors: Vec<Option<f64>>,
}

impl LawResults {
    /// The statistical model beside the sums `totals` at separations d/sigma.
    pub(super) fn new(
        law: &LawContact,
        separations: &[f64],
        surface: &TiledSurface,
        totals: &[Total],
        errors: Vec<Option<f64>>,
    ) -> Self {
        let shape = Shape::sphere(surface.population.radius);
        let integral = Statistical::of_shape(&*law.contact, surface.population.clone(), shape)
            .reported_from(surface.reporting_plane);
        let of_sum = |(&h, total): (&f64, &Total)| {
            Response::of_sum(h, surface.plane, total, surface.count, surface.nominal_area)
        };
        let sums: Vec<Response> = separations.iter().zip(totals).map(of_sum).collect();
        let integrals = integral.respond_all(separations);
        let mut comparison = Comparison::default();
        let curve = |kind| move |response: &Response| CurvePoint::at_separation(kind, *response);
        comparison.curves.extend(integrals.iter().map(curve(ModelKind::Statistical)));
        comparison.curves.extend(sums.iter().map(curve(ModelKind::Deterministic)));
        let pair = |(statistical, sum): (&Response, &Response)| Pair::at_separation(*statistical, *sum);
        comparison.pairs.extend(integrals.iter().zip(&sums).map(pair));
        let loaded: Vec<&Response> = sums.iter().filter(|sum| sum.pressure.total() > 0.0).collect();
        let pressures: Vec<f64> = loaded.iter().map(|sum| sum.pressure.total()).collect();
        for ((sum, &pressure), found) in
            loaded.iter().zip(&pressures).zip(integral.separations_at(&pressures))
        {
            match found {
                Some(h) => comparison.pairs.push(Pair {
                    pairing: Pairing::Load,
                    target: pressure,
                    statistical: integral.respond(h),
                    deterministic: **sum,
                }),
                None => comparison.unpaired.push(pressure),
            }
        }
        Self { law: law.label.clone(), thickness: law.thickness, comparison, errors }
    }

    /// Pairs at equal separation, each with the standard error of the sum's pressure (Pa).
    pub fn at_separations(&self) -> impl Iterator<Item = (&Pair, Option<f64>)> {
        let pairs = self.comparison.pairs.iter().filter(|pair| pair.pairing == Pairing::Separation);
        pairs.zip(self.errors.iter().copied())
    }
}

/// Standard error of the ratio of the sums of `loads` and `areas` over independent tiles (Cochran 1977, Eq. 6.13); `None` where
/// fewer than eight tiles carry load.
pub(super) fn error_of_ratio(loads: &[f64], areas: &[f64]) -> Option<f64> {
    /// Fewer say little of a scatter.
    const FEWEST: usize = 8;
    if loads.iter().filter(|&&load| load > 0.0).count() < FEWEST {
        return None;
    }
    let (area, tiles) = (areas.iter().sum::<f64>(), loads.len() as f64);
    let ratio = loads.iter().sum::<f64>() / area;
    let squares: f64 = loads.iter().zip(areas).map(|(load, area)| (load - ratio * area).powi(2)).sum();
    Some((squares * tiles / (tiles - 1.0)).sqrt() / area)
}

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

rows! { SeparationRow<'_> => "separations.csv";
    "One row for each law, layer thickness and separation: both models at equal separation, with the sampling error of the sum from the scatter of its tiles.";
    row =>
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_ratio_is_that_of_a_mean_for_equal_areas() {
        let loads: Vec<f64> = (1..=9).map(f64::from).collect();
        // The standard deviation of 1 to 9 is sqrt(7.5).
        let found = error_of_ratio(&loads, &[2.0; 9]).unwrap();
        assert!((found - (7.5f64 / 9.0).sqrt() / 2.0).abs() < 1e-15);
        // Loads in proportion to areas have none; seven tiles say too little.
        assert_eq!(error_of_ratio(&loads, &loads), Some(0.0));
        assert_eq!(error_of_ratio(&[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0], &[1.0; 8]), None);
    }
}
