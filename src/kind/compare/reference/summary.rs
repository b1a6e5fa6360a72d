//! The reference in `summary.json`.

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
