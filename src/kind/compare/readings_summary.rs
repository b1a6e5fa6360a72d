//! Readings of sigma and d in `summary.json`.

use serde::Serialize;

use super::findings::{ReadLoads, Readings};
use super::layer_summary::Thickness;

/// One model at one d/sigma under both readings.
#[derive(Serialize)]
pub struct ReadingSummary<'a> {
    surface_of_asperity_sigma: &'a str,
    surface_of_surface_sigma: &'a str,
    law: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    layer_thickness_m: Option<Thickness>,
    model: &'static str,
    separation_over_sigma: f64,
    pressure_with_asperity_sigma_pa: f64,
    pressure_with_surface_sigma_pa: f64,
    ratio: f64,
    valid: bool,
}

/// The loads, in the order of the report.
pub fn readings(found: Option<&Readings>) -> Vec<ReadingSummary<'_>> {
    found.iter().flat_map(|found| &found.loads).map(summary).collect()
}

fn summary(loads: &ReadLoads) -> ReadingSummary<'_> {
    let [asperities, surface] = &loads.surfaces;
    let [first, second] = loads.answers;
    ReadingSummary {
        surface_of_asperity_sigma: asperities,
        surface_of_surface_sigma: surface,
        law: &loads.law,
        layer_thickness_m: loads.thickness.map(Thickness),
        model: loads.kind.name(),
        separation_over_sigma: loads.separation,
        pressure_with_asperity_sigma_pa: first.pressure,
        pressure_with_surface_sigma_pa: second.pressure,
        ratio: loads.ratio(),
        valid: loads.is_valid(),
    }
}
