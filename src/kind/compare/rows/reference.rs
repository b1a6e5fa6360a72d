//! `reference.csv`: what the boundary element solver did at each load.

use asperity::compare::ReferencePoint;
use asperity::spot::SpotQuantity;
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
    /// Of the spots of the sum as a cluster, 1/m.
    greenwood: Option<f64>,
}

/// The columns of a finite map that conducts.
const CLUSTER: &str = "cluster";
const CLUSTER_ELECTRICAL: &str = "electrical cluster";
const CLUSTER_THERMAL: &str = "thermal cluster";

impl ReferenceRow {
    fn of_cluster(&self, quantity: SpotQuantity) -> Option<f64> {
        let value = self.point.of_cluster[quantity as usize];
        (value > 0.0).then_some(value)
    }
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
            cluster_electrical_conductance_s_per_m2["S/m²", part(CLUSTER_ELECTRICAL)] = row.of_cluster(SpotQuantity::ElectricalConductance), "Electrical conductance of a finite map between half-spaces over its nominal area: most of the resistance is that of the map as a whole, so that it does not compare with the models'; there only with a finite boundary and without a layer.";
            cluster_thermal_conductance_w_per_m2_k["W/(m² K)", part(CLUSTER_THERMAL)] = row.of_cluster(SpotQuantity::ThermalConductance), "Thermal conductance, likewise, without the medium in the gap.";
            greenwood_cluster_per_m["1/m", part(CLUSTER)] = row.greenwood, "Conductance times the mean resistivity s, over the nominal area, of the spots of the sum at the same load as a cluster between half-spaces (Greenwood 1966), without film and layer; empty where the sum was not run.";
            mean_gap_m["m"] = row.point.mean_gap, "Mean gap between the deformed surfaces, zero at points in contact.";
            undeformed_gap_m["m"] = row.point.undeformed_gap, "Distance of the flat from the mean plane of the undeformed heights: the mean gap less the mean deflection, which is that of the patch as a whole with a finite boundary.";
            plane_offset_m["m"] = row.offset, "Height of the plane that separations are measured from, the mean asperity height, above the mean plane of the map: the mean gap less this is the separation in `curves.csv`.";
            raw_area_ratio["1"] = row.point.raw_area_ratio, "Points in contact over all points.";
            area_ratio["1"] = row.point.area_ratio, "The same corrected for the perimeter of the contacts.";
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
    let has = |quantity: SpotQuantity| rows.iter().any(|row| row.of_cluster(quantity).is_some());
    let parts = [
        (CLUSTER_ELECTRICAL, has(SpotQuantity::ElectricalConductance)),
        (CLUSTER_THERMAL, has(SpotQuantity::ThermalConductance)),
        (CLUSTER, rows.iter().any(|row| row.greenwood.is_some())),
    ];
    let left_out = parts.into_iter().filter(|(_, is_there)| !is_there);
    left_out.fold(Table::new(rows), |table, (part, _)| table.without_part(part))
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
                greenwood: curve.clusters.get(index).copied().flatten(),
            })
        })
    })
}
