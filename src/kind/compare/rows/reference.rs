//! `reference.csv`: what the boundary element solver did at each load.

use asperity::compare::ReferencePoint;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Table};

use super::curves::cases;
use crate::kind::compare::results::CompareResults;
use crate::model_tables::RowCase;

/// One load of the reference.
pub(crate) struct ReferenceRow {
    case: RowCase,
    boundary: &'static str,
    cap: Option<f64>,
    interpolated: usize,
    /// Height of the plane of separations above the mean plane of the map, m.
    offset: Option<f64>,
    point: ReferencePoint,
    /// Conductances per nominal area of the spots of the sum as a cluster, electrical (S/m^2) and thermal (W/(m^2 K)); 0 where there is none.
    greenwood: [f64; 2],
}

/// The columns of finite maps that conduct a current, and heat.
const CLUSTERS: [&str; 2] = ["electrical cluster", "thermal cluster"];

fn positive(value: f64) -> Option<f64> {
    (value > 0.0).then_some(value)
}

impl Row for ReferenceRow {
    const FILE: &'static str = "reference.csv";
    const ROWS: &'static str = "One row for each surface, realisation, law, layer thickness and load at which the boundary element reference was run; the file is there only where it was.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = RowCase::columns(|row: &Self| &row.case);
        columns.extend(columns! { row: Self =>
            boundary["text"] = row.boundary, "What lies beyond the edge of the map: `periodic` (the map again), `mirrored` (its mirror image) or `finite` (nothing).";
            cap_pa["Pa"] = row.cap, "The largest contact pressure, the hardness of the softer body; empty for an elastic contact.";
            pressure_pa["Pa"] = row.point.pressure, "Nominal pressure.";
            cluster_electrical_conductance_s_per_m2["S/m²", part(CLUSTERS[0])] = positive(row.point.of_cluster[0]), "Electrical conductance of a finite map between half-spaces over its nominal area: its resistance holds that of the map as a whole, so that it does not compare with the models' and not with that of another area; this and the next columns are there only with a finite boundary and without a layer.";
            greenwood_electrical_conductance_s_per_m2["S/m²", part(CLUSTERS[0])] = positive(row.greenwood[0]), "The same of the spots of the sum at the same nominal pressure as a cluster (Greenwood 1966), over the nominal area of the sum, which is without the border of a map that does not repeat; empty with a film, and where the sum was not run.";
            cluster_thermal_conductance_w_per_m2_k["W/(m² K)", part(CLUSTERS[1])] = positive(row.point.of_cluster[1]), "Thermal conductance of a finite map, likewise, without the medium in the gap.";
            greenwood_thermal_conductance_w_per_m2_k["W/(m² K)", part(CLUSTERS[1])] = positive(row.greenwood[1]), "The same of the spots of the sum as a cluster, likewise.";
            mean_gap_m["m"] = row.point.mean_gap, "Mean gap between the deformed surfaces, zero at points in contact.";
            undeformed_gap_m["m"] = row.point.undeformed_gap, "Distance of the flat from the mean plane of the undeformed heights: the mean gap less the mean deflection, which is that of the patch as a whole with a finite boundary.";
            plane_offset_m["m"] = row.offset, "Height of the plane that separations are measured from, the mean asperity height, above the mean plane of the map: the mean gap less this is the separation in `curves.csv`; 0 of a map without summits of different heights.";
            raw_area_ratio["1"] = row.point.raw_area_ratio, "Points in contact over all points.";
            area_ratio["1"] = row.point.area_ratio, "The same corrected for the perimeter of the contacts; not corrected on a map without summits of different heights.";
            capped_area_ratio["1"] = row.point.capped_area_ratio, "Points at the largest pressure over all points.";
            dual_gap["1"] = row.point.error, "Relative dual gap: a bound of the error in energy.";
            steps["count"] = row.point.steps, "Steps of the solver.";
            convolutions["count"] = row.point.convolutions, "Convolutions of the solver.";
            interpolated_points["count"] = row.interpolated, "Missing points of the map that were interpolated for the reference alone.";
        });
        columns
    }
}

/// The table, without the columns that are empty unless the map is finite and conducts.
pub(crate) fn table(results: &CompareResults) -> Table {
    let rows: Vec<ReferenceRow> = rows(results).collect();
    let is_there = |index: usize| rows.iter().any(|row| row.point.of_cluster[index] > 0.0);
    let left_out = (0..CLUSTERS.len()).filter(|&index| !is_there(index));
    let left_out: Vec<&str> = left_out.map(|index| CLUSTERS[index]).collect();
    left_out.into_iter().fold(Table::new(rows), Table::without_part)
}

fn rows(results: &CompareResults) -> impl Iterator<Item = ReferenceRow> {
    cases(results).flat_map(|(case, _, found)| {
        let curves = found.reference.iter();
        curves.flat_map(move |curve| {
            let case = case.clone();
            curve.points.iter().enumerate().map(move |(index, &point)| ReferenceRow {
                case: case.clone(),
                boundary: curve.boundary.name(),
                cap: curve.cap,
                interpolated: curve.interpolated,
                offset: point.separation.map(|d| point.mean_gap - d),
                point,
                greenwood: curve.clusters.get(index).copied().unwrap_or_default(),
            })
        })
    })
}
