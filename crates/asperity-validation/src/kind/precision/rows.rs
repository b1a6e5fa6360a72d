//! Every time and every error.

use super::run::PrecisionResults;
use crate::precision::integral::IntegralPoint;
use crate::precision::reference::ReferencePoint;
use crate::precision::sum::SumPoint;
use crate::precision::surface::SurfacePoint;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row, Schema, Table};

impl Row for &IntegralPoint {
    const FILE: &'static str = "integral.csv";
    const ROWS: &'static str =
        "One row for each case, quadrature rule and effort; written where `integral` is given.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case.as_str(), "Case: the population that is integrated.";
            rule["text"] = row.rule.name(), "Quadrature rule, over the whole range, or split where the law changes its formula with the square root of the indentation as variable; `shipped` is the rule of this program.";
            order["count"] = row.rule.order(), "Nodes per piece of the range; empty where the rule has a tolerance or is fixed.";
            tolerance["1", input] = row.rule.tolerance(), "Tolerance of the rule; empty where it has an order or is fixed.";
            evaluations_per_separation["1"] = row.evaluations, "Mean number of contacts evaluated per separation; empty where the rule does not report it.";
            area_error["1", scale(1.0)] = row.cost.area_error, "Largest relative error of the area over the separations, against 32 digits.";
            load_error["1", scale(1.0)] = row.cost.load_error, "Largest relative error of the load over the separations, against 32 digits.";
            seconds_per_separation["s", label("time per separation"), ignored] = row.cost.seconds, "Time per separation.";
        }
    }
}

impl Row for &SumPoint {
    const FILE: &'static str = "sum.csv";
    const ROWS: &'static str =
        "One row for each case, number of asperities and summation method; written where `sum` is given.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            case["text"] = row.case.as_str(), "Case: the population of which a random set is summed.";
            method["text"] = row.method.name(), "Summation method, on one thread: `naive`, one term after the other; `compensated`, the same with the rounding error of each addition kept; `shipped`, the sum of this program at all separations together.";
            asperities["count"] = row.asperities, "Asperities in the set.";
            area_error["1", scale(1.0)] = row.cost.area_error, "Largest relative error of the area over the separations, against 32 digits.";
            load_error["1", scale(1.0)] = row.cost.load_error, "Largest relative error of the load over the separations, against 32 digits.";
            seconds_per_separation["s", label("time per separation"), ignored] = row.cost.seconds, "Time per separation.";
        }
    }
}

impl Row for &SurfacePoint {
    const FILE: &'static str = "surface.csv";
    const ROWS: &'static str =
        "One row for each resolution and size of random maps; written where `surface` is given.";

    fn columns() -> Vec<Column<Self>> {
        columns! { map: Self =>
            points_per_length["1", input] = map.per_length, "Points per correlation length.";
            lengths["1", label("side [l]"), input] = map.lengths, "Side of the map in correlation lengths.";
            points["count"] = map.points, "Points along a side.";
            summits["1"] = map.summits, "Mean number of summits.";
            density_bias["1", signed_percent] = map.bias[0], "Expected summit density on this grid over that on a fine grid, minus 1.";
            radius_bias["1", signed_percent] = map.bias[1], "Expected radius 1/(mean curvature) on this grid over that on a fine grid, minus 1.";
            sigma_bias["1", label("σ bias"), signed_percent] = map.bias[2], "Expected standard deviation of summit heights on this grid over that on a fine grid, minus 1.";
            density_scatter["1", percent] = map.scatter[0], "Root mean square error of the summit density of a map, relative to that expected on this grid.";
            radius_scatter["1", percent] = map.scatter[1], "Root mean square error of the radius of a map, relative to that expected on this grid.";
            sigma_scatter["1", label("σ scatter"), percent] = map.scatter[2], "Root mean square error of the standard deviation of the heights of a map, relative to that expected on this grid.";
            seconds_per_map["s", label("time per map"), ignored] = map.seconds, "Median time for a map and its summits.";
        }
    }
}

impl Row for &ReferencePoint {
    const FILE: &'static str = "boundary_elements.csv";
    const ROWS: &'static str = "One row for each resolution of Hertz's contact solved by boundary elements; written where `reference` is given.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            pixels_per_contact_radius["count"] = row.pixels, "Pixels per contact radius.";
            counted_area_error["1", percent, scale(1.0)] = row.counted_area_error, "Relative error of the area of the points in contact.";
            area_error["1", percent, scale(1.0)] = row.cost.area_error, "Relative error of the area corrected for its border.";
            load_error["1", percent, scale(1.0)] = row.cost.load_error, "Relative error of the load at the computed indentation, against Hertz's load there.";
            seconds_per_contact["s", label("time per contact"), ignored] = row.cost.seconds, "Time for map, kernel and contact.";
        }
    }
}

/// The tables, in the order in which they are written.
pub(super) fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<&IntegralPoint>(),
        Schema::of::<&SumPoint>(),
        Schema::of::<&SurfacePoint>(),
        Schema::of::<&ReferencePoint>(),
    ]
}

/// Those that the spec requests.
pub(super) fn tables(results: &PrecisionResults) -> Vec<Table> {
    let tables = [
        Table::new(&results.integrals),
        Table::new(&results.sums),
        Table::new(&results.maps),
        Table::new(&results.contacts),
    ];
    tables.into_iter().filter(|table| table.rows() > 0).collect()
}
