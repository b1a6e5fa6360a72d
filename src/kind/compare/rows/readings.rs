//! `readings.csv`: sigma and d read as those of the asperities, or of the surface.

use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use crate::kind::compare::readings::{ReadLoads, loads_by_reading};
use crate::kind::compare::results::CompareResults;

/// One model at one d/sigma under both readings.
pub(crate) struct ReadingRow(ReadLoads);

impl Row for ReadingRow {
    const FILE: &'static str = "readings.csv";
    const ROWS: &'static str = "One row for each pair of surfaces with the same specified numbers, of which one reads sigma and d as those of the asperities and the other as those of the surface, law, layer thickness, separation and model; pressures are means over the realisations.";
    const RECORDS: Option<&'static str> = Some("readings");

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface_of_asperity_sigma["text", label("asperity reading")] = row.0.surfaces[0].as_str(), "The surface whose sigma is that of the asperities.";
            surface_of_surface_sigma["text", label("surface reading")] = row.0.surfaces[1].as_str(), "The surface whose sigma is that of the surface.";
            law["text"] = row.0.law.as_str(), "Contact law of an asperity.";
            layer_thickness_m["m", label("layer"), thickness] = row.0.thickness, "Thickness of the layer; empty where the spec has no layer.";
            model["text"] = row.0.kind.name(), "Model: `statistical` or `deterministic`.";
            separation_over_sigma["1", input] = row.0.separation, "Separation over sigma.";
            pressure_with_asperity_sigma_pa["Pa", prefix("M"), label("pressure, asperity reading")] = row.0.answers[0].pressure, "Nominal pressure with sigma and d of the asperities.";
            pressure_with_surface_sigma_pa["Pa", prefix("M"), label("pressure, surface reading")] = row.0.answers[1].pressure, "Nominal pressure with sigma and d of the surface.";
            ratio["1"] = row.0.ratio(), "The second over the first.";
            valid["true/false"] = row.0.is_admissible(), "Whether the load is admissible for both models under both readings, in every realisation.";
        }
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = ReadingRow> {
    loads_by_reading(&results.surfaces).into_iter().map(ReadingRow)
}
