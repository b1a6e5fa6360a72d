//! `results.csv`: the answer where one load or one separation was asked for; `largest_gaps.csv`: the largest gaps between the models.

use asperity::Response;
use asperity::compare::{Gap, ReferencePoint};
use asperity::study::CaseResults;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::REFERENCE;

/// One model, or the reference, at the one load or separation of a spec.
pub(crate) struct ResultRow<'a> {
    key: CaseKey<'a>,
    model: &'static str,
    /// m²
    nominal_area: f64,
    pressure: f64,
    separation: Option<f64>,
    separation_over_sigma: Option<f64>,
    area_ratio: f64,
    stiffness: Option<f64>,
    /// Of a model.
    response: Option<&'a Response>,
    mean_real_pressure: Option<f64>,
}

impl Row for ResultRow<'_> {
    const FILE: &'static str = "results.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness and model of a spec that asks for one load or one separation, on the first realisation; the reference where it was run.";
    const RECORDS: Option<&'static str> = Some("results");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            model["text"] = row.model, "Model: `statistical`, `deterministic` or `reference`.";
            force_n["N", label("load")] = row.pressure * row.nominal_area, "Load on the nominal area.";
            pressure_pa["Pa", prefix("M"), label("nominal pressure")] = row.pressure, "Load over nominal area.";
            separation_m["m"] = row.separation, "Separation of the flat from the mean asperity height.";
            separation_over_sigma["1"] = row.separation_over_sigma, "The same over sigma, the standard deviation of the asperity heights.";
            real_area_m2["m²", prefix("µ"), label("real contact area")] = row.area_ratio * row.nominal_area, "Real contact area.";
            area_ratio["1", label("of the nominal area"), percent] = row.area_ratio, "Real contact area over nominal area.";
            contacts["1"] = row.response.map(|response| response.contact_density * row.nominal_area), "Number of contacts; empty for the reference.";
            mean_real_pressure_pa["Pa", prefix("M"), label("mean contact pressure")] = row.mean_real_pressure, "Load over real contact area; empty where there is no contact.";
            stiffness_n_per_m["N/m", label("stiffness")] = row.stiffness.map(|stiffness| stiffness * row.nominal_area), "Contact stiffness of the nominal area.";
            elastic_load_share["1", label("elastic"), percent] = share(row.response, 0), "Share of the load in elastic contacts; empty for the reference and where there is no contact.";
            elastic_plastic_load_share["1", label("elastic-plastic"), percent] = share(row.response, 1), "Share of the load in elastic-plastic contacts.";
            plastic_load_share["1", label("plastic"), percent] = share(row.response, 2), "Share of the load in plastic contacts.";
        });
        columns
    }
}

fn share(response: Option<&Response>, regime: usize) -> Option<f64> {
    response?.pressure.shares().map(|shares| shares[regime])
}

/// Whether each model, and the reference, was asked for one point only, so that its curves are points.
pub(crate) fn is_single(case: &CaseResults) -> bool {
    let curves = &case.comparison.curves;
    let points = |kind: &str| curves.iter().filter(|point| point.kind.name() == kind).count();
    let of_reference = case.reference.as_ref().map_or(0, |curve| curve.points.len());
    let most = ["statistical", "deterministic"].map(points).into_iter().chain([of_reference]).max();
    most == Some(1)
}

/// The rows.
pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = ResultRow<'_>> {
    SurfaceCase::all(results).filter(|case| is_single(case.first())).flat_map(|case| {
        let nominal_area = case.surface.surface.set.nominal_area();
        let models = case.first().comparison.curves.iter().map(move |point| {
            let response = &point.response;
            ResultRow {
                key: case.key(),
                model: point.kind.name(),
                nominal_area,
                pressure: response.pressure.total(),
                separation: Some(response.separation),
                separation_over_sigma: Some(response.separation_over_sigma),
                area_ratio: response.area_ratio.total(),
                stiffness: Some(response.stiffness),
                mean_real_pressure: response.mean_real_pressure(),
                response: Some(response),
            }
        });
        let reference = case.first().reference.iter().flat_map(|curve| &curve.points);
        models.chain(reference.map(move |point: &ReferencePoint| ResultRow {
            key: case.key(),
            model: REFERENCE,
            nominal_area,
            pressure: point.pressure,
            separation: point.separation,
            separation_over_sigma: point.separation_over_sigma,
            area_ratio: point.area_ratio,
            stiffness: point.stiffness,
            mean_real_pressure: point.mean_real_pressure(),
            response: None,
        }))
    })
}

/// The largest gap of a quantity between the models.
pub(crate) struct GapRow<'a> {
    key: CaseKey<'a>,
    realisation: usize,
    gap: &'a Gap,
}

impl Row for GapRow<'_> {
    const FILE: &'static str = "largest_gaps.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, realisation, quantity and pairing: the largest gap between the models.";
    const RECORDS: Option<&'static str> = Some("largest_gaps");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            realisation["count"] = row.realisation, "Number of the realisation of the surface, from 1.";
            quantity["text"] = row.gap.quantity.name(), "What is compared.";
            pairing["text"] = row.gap.pairing.name(), "What the models have in common: `load` or `separation`.";
            target["Pa or 1"] = row.gap.target, "Its value: nominal pressure, or separation over sigma.";
            statistical["SI"] = row.gap.statistical, "Statistical model.";
            deterministic["SI"] = row.gap.deterministic, "Deterministic model.";
            difference["SI", scale_of("statistical")] = row.gap.difference(), "Statistical minus deterministic.";
        });
        columns
    }
}

/// The rows of the largest gaps.
pub(super) fn gaps(results: &CompareResults) -> impl Iterator<Item = GapRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        (0..surface.realisations.len()).flat_map(move |realisation| {
            SurfaceCase::on_surface(surface).flat_map(move |case| {
                let gaps = case.case.realisations[realisation].gaps.largest.iter();
                gaps.map(move |gap| GapRow { key: case.key(), realisation: realisation + 1, gap })
            })
        })
    })
}
