//! The reference in `summary.json`.

use asperity::compare::Kind;
use serde::Serialize;

use crate::kind::compare::layer_summary::Thickness;
use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// The reference on one surface under one law and thickness, over all realisations.
#[derive(Serialize)]
pub(in crate::kind::compare) struct ReferenceSummary<'a> {
    surface: &'a str,
    law: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer_thickness_m: Option<Thickness>,
    boundary: &'static str,
    refine: usize,
    cap_pa: Option<f64>,
    /// Solved loads of one realisation.
    loads: usize,
    from_pa: Option<f64>,
    to_pa: Option<f64>,
    /// Loads at or above the cap, which no contact carries.
    unreached_loads: usize,
    /// The largest relative dual gap.
    dual_gap: Option<f64>,
    convolutions: usize,
    interpolated_points: usize,
}

/// Loads at which both models stand alike against the reference.
#[derive(Serialize)]
pub(in crate::kind::compare) struct NearerSummary<'a> {
    surface: &'a str,
    law: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer_thickness_m: Option<Thickness>,
    quantity: &'static str,
    from_pa: f64,
    to_pa: f64,
    /// The nearer model, with the sampling error of such surfaces; null where it cannot be told or both are as near.
    nearer: Option<&'static str>,
    /// The same on this very map; null over several realisations.
    nearer_on_this_map: Option<&'static str>,
}

/// Which model is nearer, on all surfaces.
pub(in crate::kind::compare) fn nearer(results: &CompareResults) -> Vec<NearerSummary<'_>> {
    let cases = results
        .surfaces
        .iter()
        .flat_map(|found| found.first.cases.iter().zip(&found.findings.cases).map(move |case| (found, case)));
    cases
        .flat_map(|(found, (case, findings))| {
            let verdicts = &findings.verdicts;
            let stretches = verdicts.reference.iter().flat_map(|reference| &reference.nearer);
            stretches.map(move |stretch| NearerSummary {
                surface: &found.surface.name,
                law: &case.law,
                layer_thickness_m: case.thickness.map(Thickness),
                quantity: stretch.quantity.name(),
                from_pa: stretch.loads[0],
                to_pa: stretch.loads[1],
                nearer: stretch.nearer.map(Kind::name),
                nearer_on_this_map: stretch
                    .nearer_here
                    .filter(|_| verdicts.has_one_surface())
                    .map(Kind::name),
            })
        })
        .collect()
}

/// Of all surfaces; empty where no reference was run.
pub(in crate::kind::compare) fn summary(results: &CompareResults) -> Vec<ReferenceSummary<'_>> {
    let Some(metadata) = &results.reference else { return Vec::new() };
    results.surfaces.iter().flat_map(|found| of_surface(found, metadata.refine)).collect()
}

fn of_surface(found: &SurfaceResults, refine: usize) -> impl Iterator<Item = ReferenceSummary<'_>> {
    found.first.cases.iter().enumerate().filter_map(move |(index, case)| {
        let first = case.reference.as_ref()?;
        let curves: Vec<_> = found
            .realisations()
            .filter_map(|(_, answered)| answered.cases[index].reference.as_ref())
            .collect();
        let points: Vec<_> = curves.iter().flat_map(|curve| &curve.points).collect();
        let loads = || points.iter().map(|point| point.pressure);
        Some(ReferenceSummary {
            surface: &found.surface.name,
            law: &case.law,
            layer_thickness_m: case.thickness.map(Thickness),
            boundary: first.boundary.name(),
            refine,
            cap_pa: first.cap,
            loads: first.points.len(),
            from_pa: loads().reduce(f64::min),
            to_pa: loads().reduce(f64::max),
            unreached_loads: curves.iter().map(|curve| curve.unreached.len()).sum(),
            dual_gap: points.iter().map(|point| point.error).reduce(f64::max),
            convolutions: points.iter().map(|point| point.convolutions).sum(),
            interpolated_points: first.interpolated,
        })
    })
}
