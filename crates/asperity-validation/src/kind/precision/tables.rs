//! Every time and every error, for machines.

use super::findings::Winner;
use super::names::candidate_name;
use crate::kind::precision::run::{CasePrecision, PrecisionResults};
use crate::precision::attribution::{AttributionPoint, ProductPoint};
use crate::precision::curve::CurvePoint;
use crate::precision::grid::GridPoint;
use crate::precision::integral::{Effort, IntegralPoint};
use crate::precision::list::ListPoint;
use crate::precision::sampling;
use crate::precision::sum::SumPoint;
use asperity::compare::{Kind, LimitPoint, Quantity};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

/// A point of a case.
struct OfCase<'a, P> {
    case: &'a str,
    point: P,
}

/// The column of the case that a row belongs to.
fn case_column<'a, P>() -> Vec<Column<OfCase<'a, P>>> {
    columns! { row: OfCase<P> => case["text"] = row.case, "Case: the population that is summed and integrated."; }
}

type RuleRow<'a> = OfCase<'a, &'a IntegralPoint>;

impl Row for RuleRow<'_> {
    const FILE: &'static str = "integral.csv";
    const ROWS: &'static str =
        "One row for each case, quadrature rule and effort; written where integrals are timed.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            rule["text"] = row.point.rule.family.name(), "Quadrature rule; `shipped` is the default of this program.";
            split["true/false"] = row.point.rule.split, "Whether the integral is split where the law changes its formula.";
            substituted["true/false"] = row.point.rule.substituted, "Whether the variable is the square root of the indentation.";
            order["count"] = order(row.point.rule.effort), "Order of the rule; empty where it has a tolerance or is fixed.";
            tolerance["1"] = tolerance(row.point.rule.effort), "Tolerance of the rule; empty where it has an order or is fixed.";
            evaluations_per_separation["1"] = row.point.evaluations, "Mean number of contacts evaluated per separation; empty where the rule does not report it.";
            area_error["1"] = row.point.area_error, "Largest relative error of the area over the separations, against 32 digits.";
            load_error["1"] = row.point.load_error, "Largest relative error of the load over the separations, against 32 digits.";
            seconds_per_separation["s"] = row.point.cost.seconds, "Time per separation.";
        });
        columns
    }
}

fn order(effort: Effort) -> Option<usize> {
    match effort {
        Effort::Order(order) => Some(order),
        Effort::Tolerance(_) | Effort::Fixed => None,
    }
}

fn tolerance(effort: Effort) -> Option<f64> {
    match effort {
        Effort::Tolerance(tolerance) => Some(tolerance),
        Effort::Order(_) | Effort::Fixed => None,
    }
}

type SumRow<'a> = OfCase<'a, &'a SumPoint>;

impl Row for SumRow<'_> {
    const FILE: &'static str = "sum.csv";
    const ROWS: &'static str =
        "One row for each case, summation method and size; written where sums are timed.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            varied["text"] = row.point.sweep.name(), "What is varied: `asperities`, `separations` or `threads`.";
            way["text"] = row.point.way.name(), "Summation method; `shipped` is the default of this program.";
            asperities["count"] = row.point.asperities, "Asperities in the set.";
            separations["count"] = row.point.separations, "Separations evaluated together.";
            threads["count"] = row.point.threads, "Threads.";
            area_error["1"] = row.point.area_error, "Largest relative error of the area over the separations.";
            load_error["1"] = row.point.load_error, "Largest relative error of the load over the separations.";
            seconds_per_separation["s"] = row.point.cost.seconds, "Time per separation, the ordering of the asperities included.";
        });
        columns
    }
}

/// A curve of one model, and the number of asperities of its set.
type CurveRow<'a> = OfCase<'a, (usize, &'a CurvePoint)>;

impl Row for CurveRow<'_> {
    const FILE: &'static str = "curve.csv";
    const ROWS: &'static str =
        "One row for each case, model and tolerance of a curve; written where curves are timed.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            model["text"] = row.point.1.kind.name(), "Model: `statistical` or `deterministic`.";
            asperities["count"] = (row.point.1.kind == Kind::Deterministic).then_some(row.point.0), "Asperities in the set; empty for the integral.";
            tolerance["1"] = row.point.1.tolerance, "Relative tolerance of the curve; empty where every separation is evaluated.";
            separations["count"] = row.point.1.separations, "Separations of the curve.";
            asked["count"] = row.point.1.evaluated, "Separations at which the model was evaluated.";
            area_error["1"] = row.point.1.area_error, "Largest relative error of the area against the exact curve.";
            load_error["1"] = row.point.1.load_error, "Largest relative error of the load against the exact curve.";
            seconds_per_curve["s"] = row.point.1.seconds, "Time for the whole curve.";
        });
        columns
    }
}

type ListRow<'a> = OfCase<'a, &'a ListPoint>;

impl Row for ListRow<'_> {
    const FILE: &'static str = "list.csv";
    const ROWS: &'static str =
        "One row for each case and length of a list of asperities; written where lists are timed.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            asperities["count"] = row.point.asperities, "Asperities in the list.";
            separations["count"] = row.point.separations, "Separations at which it is summed.";
            seconds_to_read["s"] = row.point.read_seconds, "Time to read the file, cached by the system.";
            seconds_to_sum["s"] = row.point.sum_seconds, "Time to sum at all separations.";
            peak_bytes["B"] = row.point.peak_bytes, "Peak memory of the program meanwhile; empty where the system does not report it.";
            added_bytes["B"] = row.point.added_bytes, "Peak memory above that just before.";
        });
        columns
    }
}

/// The difference of a set of one size divided among its causes.
type AttributionRow<'a> = OfCase<'a, &'a AttributionPoint>;

impl Row for AttributionRow<'_> {
    const FILE: &'static str = "attribution_times.csv";
    const ROWS: &'static str = "One row for each case and size of a set whose difference is divided among its causes; written where `attribution` is given.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            asperities["count"] = row.point.asperities, "Asperities in the set.";
            loads["count"] = row.point.loads, "Loads at which the difference is divided.";
            loads_divided["count"] = row.point.divided, "Loads of them that enough contacts carry.";
            seconds_of_both_models["s"] = row.point.model_seconds, "Time of both models at these loads.";
            seconds_of_attribution["s"] = row.point.attribution_seconds, "Time to rearrange the asperities, and of the states between the models at these loads.";
        });
        columns
    }
}

/// Own heights with own radii under one law.
type ProductRow<'a> = OfCase<'a, &'a ProductPoint>;

impl Row for ProductRow<'_> {
    const FILE: &'static str = "attribution_errors.csv";
    const ROWS: &'static str = "One row for each case and law for spheres that the materials allow: the error of the pressure of own heights and own radii, independent of each other; written where `attribution` is given.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            law["text"] = row.point.law.as_str(), "Contact law of an asperity.";
            asperities["count"] = row.point.asperities, "Asperities in the set.";
            relative_error["1"] = row.point.error, "Largest relative error at two separations (0.5 and 2 sigma) against the sum over every height with every radius.";
            times_as_fast["1"] = row.point.speedup, "Time of that sum over the time of the condensed one.";
        });
        columns
    }
}

/// Random sets of one size at one separation, and the time per set.
type SetRow<'a> = OfCase<'a, (&'a LimitPoint, f64)>;

impl Row for SetRow<'_> {
    const FILE: &'static str = "sampling.csv";
    const ROWS: &'static str =
        "One row for each case, separation and size of random sets; written where `sampling` is given.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            separation_over_sigma["1"] = sampling::separation(row.point.0), "Separation over sigma, the standard deviation of the asperity heights.";
            asperities["count"] = row.point.0.count, "Asperities in a set.";
            expected_contacts["1"] = row.point.0.expected_contacts(), "Expected number of contacts.";
            area_scatter["1"] = row.point.0.scatter(Quantity::Area).1, "Root mean square of the area's error over the random sets, relative to the integral.";
            area_stated_error["1"] = sampling::stated(row.point.0, Quantity::Area), "Mean standard error of the area that the sums state, relative to the integral.";
            load_scatter["1"] = row.point.0.scatter(Quantity::Load).1, "Root mean square of the load's error over the random sets, relative to the integral.";
            load_stated_error["1"] = sampling::stated(row.point.0, Quantity::Load), "Mean standard error of the load that the sums state, relative to the integral.";
            seconds_per_set["s"] = row.point.1, "Time to draw a set and sum it at all separations.";
        });
        columns
    }
}

impl Row for &GridPoint {
    const FILE: &'static str = "grid.csv";
    const ROWS: &'static str =
        "One row for each resolution and size of random maps; written where `grid` is given.";

    fn columns() -> Vec<Column<Self>> {
        columns! { map: Self =>
            points_per_length["1"] = map.per_length, "Points per correlation length.";
            lengths["1"] = map.lengths, "Side of the map in correlation lengths.";
            points["count"] = map.points, "Points along a side.";
            summits["1"] = map.summits, "Mean number of summits found.";
            density_bias["1"] = map.bias[0], "Expected summit density on this grid over that on a fine grid, minus 1.";
            radius_bias["1"] = map.bias[1], "Expected radius 1/(mean curvature) on this grid over that on a fine grid, minus 1.";
            sigma_bias["1"] = map.bias[2], "Expected standard deviation of summit heights on this grid over that on a fine grid, minus 1.";
            density_scatter["1"] = map.scatter[0], "Root mean square error of the summit density found, relative to that expected on this grid.";
            radius_scatter["1"] = map.scatter[1], "Root mean square error of the radius found, relative to that expected on this grid.";
            sigma_scatter["1"] = map.scatter[2], "Root mean square error of the standard deviation found, relative to that expected on this grid.";
            seconds_per_map["s"] = map.seconds, "Median time for a map and its summits.";
        }
    }
}

type WinnerRow<'a> = OfCase<'a, &'a Winner>;

impl Row for WinnerRow<'_> {
    const FILE: &'static str = "winners.csv";
    const ROWS: &'static str = "One row for each case and largest error: the fastest quadrature rule or summation method within it; written where integrals or sums are timed.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_column();
        columns.extend(columns! { row: Self =>
            of["text"] = row.point.of.name(), "What is timed: `integral` or `sum`.";
            asperities["count"] = row.point.asperities, "Asperities in the set; empty for the integral.";
            largest_error["1"] = row.point.level, "Largest relative error that is allowed.";
            fastest["text"] = row.point.fastest.map(|(candidate, _)| candidate_name(&candidate)), "The fastest rule or method within it; empty where there is none.";
            error["1"] = row.point.fastest.map(|(_, cost)| cost.error), "Its error, the larger of area and load.";
            seconds_per_separation["s"] = row.point.fastest.map(|(_, cost)| cost.seconds), "Its time per separation.";
            shipped_over_fastest["1"] = row.point.shipped_over_fastest, "Time of the default rule or method over that of the fastest; empty where the default exceeds the error.";
        });
        columns
    }
}

/// The tables, in the order in which they are written.
pub(super) fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<RuleRow>(),
        Schema::of::<SumRow>(),
        Schema::of::<WinnerRow>(),
        Schema::of::<CurveRow>(),
        Schema::of::<ListRow>(),
        Schema::of::<AttributionRow>(),
        Schema::of::<ProductRow>(),
        Schema::of::<SetRow>(),
        Schema::of::<&GridPoint>(),
    ]
}

/// The files of [`schemas`] that the spec requests.
pub(super) fn tables(results: &PrecisionResults) -> Vec<Table> {
    let cases = &results.cases;
    let mut all = Vec::new();
    if cases.iter().any(|case| case.integral.is_some()) {
        all.push(Table::new(cases.iter().flat_map(rules)));
    }
    if cases.iter().any(|case| !case.sums.is_empty()) {
        all.push(Table::new(cases.iter().flat_map(sums)));
    }
    if !all.is_empty() {
        all.push(Table::new(cases.iter().flat_map(winners)));
    }
    if cases.iter().any(|case| case.curve.is_some()) {
        all.push(Table::new(cases.iter().flat_map(curves)));
    }
    if cases.iter().any(|case| !case.lists.is_empty()) {
        all.push(Table::new(cases.iter().flat_map(lists)));
    }
    if cases.iter().any(|case| case.attribution.is_some()) {
        all.push(Table::new(cases.iter().flat_map(attributions)));
        all.push(Table::new(cases.iter().flat_map(products)));
    }
    if cases.iter().any(|case| case.sampling.is_some()) {
        all.push(Table::new(cases.iter().flat_map(sets)));
    }
    if let Some(grid) = &results.grid {
        all.push(Table::new(&grid.points));
    }
    all
}

fn rules(case: &CasePrecision) -> impl Iterator<Item = RuleRow<'_>> {
    let points = case.integral.iter().flat_map(|integral| &integral.points);
    points.map(|point| OfCase { case: &case.name, point })
}

fn sums(case: &CasePrecision) -> impl Iterator<Item = SumRow<'_>> {
    case.sums.iter().map(|point| OfCase { case: &case.name, point })
}

fn winners(case: &CasePrecision) -> impl Iterator<Item = WinnerRow<'_>> {
    case.findings.winners.iter().map(|point| OfCase { case: &case.name, point })
}

fn curves(case: &CasePrecision) -> impl Iterator<Item = CurveRow<'_>> {
    case.curve.iter().flat_map(|found| {
        found.points.iter().map(|point| OfCase { case: &case.name, point: (found.asperities, point) })
    })
}

fn attributions(case: &CasePrecision) -> impl Iterator<Item = AttributionRow<'_>> {
    let points = case.attribution.iter().flat_map(|found| &found.points);
    points.map(|point| OfCase { case: &case.name, point })
}

fn products(case: &CasePrecision) -> impl Iterator<Item = ProductRow<'_>> {
    let products = case.attribution.iter().flat_map(|found| &found.products);
    products.map(|point| OfCase { case: &case.name, point })
}

fn lists(case: &CasePrecision) -> impl Iterator<Item = ListRow<'_>> {
    case.lists.iter().map(|point| OfCase { case: &case.name, point })
}

fn sets(case: &CasePrecision) -> impl Iterator<Item = SetRow<'_>> {
    case.sampling.iter().flat_map(|found| {
        found.points.iter().map(|point| {
            let seconds = found.seconds.iter().find(|(count, _)| *count == point.count);
            let seconds = seconds.map_or(0.0, |(_, seconds)| *seconds);
            OfCase { case: &case.name, point: (point, seconds) }
        })
    })
}
