//! The reference: `reference.csv`, `reference_curves.csv`, `nearer_to_reference.csv`, and `correlations.csv` of its conductances.

use asperity::Limit;
use asperity::compare::{ModelKind, NearerStretch, ReferenceCurve, ReferencePoint, Verdict};
use asperity_contact_framework::report::table::Table;
use asperity_contact_framework::rows;

use super::results::cases;
use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::correlations::Correlated;
use crate::kind::compare::reference::ElasticCase;
use crate::kind::compare::results::CompareResults;
use crate::model_tables::RowCase;

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

rows! { ReferenceRow => "reference.csv";
    "One row for each surface, realisation, law, layer thickness and load at which the boundary element reference was run; the file is there only where it was.";
    ..RowCase::columns(|row: &Self| &row.case);
    row =>
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

/// The reference on one surface under one law and thickness, over all realisations.
pub(crate) struct ReferenceCurveRow<'a> {
    key: CaseKey<'a>,
    refine: usize,
    curves: Vec<&'a ReferenceCurve>,
}

impl ReferenceCurveRow<'_> {
    fn load(&self, either: fn(f64, f64) -> f64) -> Option<f64> {
        self.curves.iter().flat_map(|curve| &curve.points).map(|point| point.pressure).reduce(either)
    }

    fn dual_gap(&self) -> Option<f64> {
        self.curves.iter().flat_map(|curve| &curve.points).map(|point| point.error).reduce(f64::max)
    }

    fn convolutions(&self) -> usize {
        self.curves.iter().flat_map(|curve| &curve.points).map(|point| point.convolutions).sum()
    }
}

rows! { ReferenceCurveRow<'_> => "reference_curves.csv";
    "One row for each surface, law and layer thickness on which the boundary element reference was run, over all realisations.";
    ..case_columns(|row: &Self| row.key);
    row =>
    boundary["text"] = row.curves[0].boundary.name(), "What lies beyond the edge of the map: `periodic` (the map again), `mirrored` (its mirror image) or `finite` (nothing).";
    refine["count"] = row.refine, "Points along an axis for each of the map's.";
    cap_pa["Pa", label("largest pressure")] = row.curves[0].cap, "The largest contact pressure, the hardness of the softer body; empty for an elastic contact.";
    loads["count"] = row.curves[0].points.len(), "Solved loads of one realisation.";
    from_pa["Pa", prefix("M"), label("from")] = row.load(f64::min), "Lowest solved nominal pressure.";
    to_pa["Pa", prefix("M"), label("to")] = row.load(f64::max), "Highest solved nominal pressure.";
    unreached_loads["count"] = row.curves.iter().map(|curve| curve.unreached.len()).sum::<usize>(), "Loads at or above the largest pressure, which no contact carries.";
    dual_gap["1", ignored] = row.dual_gap(), "The largest relative dual gap, a bound of the error in energy.";
    convolutions["count", ignored] = row.convolutions(), "Convolutions of the solver.";
    interpolated_points["count"] = row.curves[0].interpolated, "Missing points of the map that were interpolated for the reference alone.";
}

/// What was solved, model by model.
pub(super) fn curves(results: &CompareResults) -> impl Iterator<Item = ReferenceCurveRow<'_>> {
    let refine = results.reference.as_ref().map_or(1, |reference| reference.refine);
    SurfaceCase::all(results).filter(|case| case.first().reference.is_some()).map(move |case| {
        let curves =
            case.case.realisations.iter().filter_map(|realisation| realisation.reference.as_ref()).collect();
        ReferenceCurveRow { key: case.key(), refine, curves }
    })
}

/// Loads at which both models stand alike against the reference.
pub(crate) struct NearerRow<'a> {
    key: CaseKey<'a>,
    stretch: &'a NearerStretch,
    /// Whether one surface was compared, not several realisations.
    is_one_map: bool,
    is_blocked: bool,
    elastic: Option<&'a ElasticCase>,
}

rows! { NearerRow<'_> => "nearer_to_reference.csv";
    "One row for each surface, law, layer thickness, quantity and stretch of load at which the same model is nearer to the reference.";
    ..case_columns(|row: &Self| row.key);
    row =>
    quantity["text"] = row.stretch.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
    from_pa["Pa", prefix("M"), label("from"), input] = row.stretch.loads[0], "Lowest nominal pressure of the stretch.";
    to_pa["Pa", prefix("M"), label("to"), input] = row.stretch.loads[1], "Highest nominal pressure of the stretch.";
    nearer["text", label("nearer, on such surfaces")] = row.stretch.nearer.filter(|_| !row.is_blocked).map(ModelKind::name), "The nearer model, with the sampling error of such surfaces; empty where it cannot be told, or both are as near; and on a blocked map.";
    nearer_on_this_map["text"] = row.stretch.nearer_here.filter(|_| row.is_one_map && !row.is_blocked).map(ModelKind::name), "The same on this very map; empty over several realisations.";
    both_beyond["true/false", label("both beyond")] = row.stretch.verdicts_here == [Verdict::Beyond; 2], "Whether both models differ from the reference on this map (over realisations: in the mean) by more than is accepted, so that the nearer one is not good either.";
    limits["text"] = row.stretch.beyond.map(Limit::name), "The limit of admissible loads that is exceeded: `large-strain` where the loads exceed that one alone, and contacts are elastic on a homogeneous half-space: the comparison is homogeneous in the heights and holds for lower surfaces of the same shape. Else empty.";
    elastic_reference["text", label("elastic reference")] = row.elastic.map(|elastic| elastic.reason.name()), "Why the reference stays elastic although the law yields, so that the row leaves yielding out: `layer` (of finite thickness), `no-hardness` or `asked` by the spec; empty where it does not, or the law does not yield.";
}

pub(super) fn nearer(results: &CompareResults) -> impl Iterator<Item = NearerRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let verdicts = case.verdicts();
        let stretches = verdicts.reference.iter().flat_map(|reference| &reference.nearer);
        let is_one_map = verdicts.has_one_surface();
        let elastic = results.elastic_reference(case);
        stretches.map(move |stretch| NearerRow {
            key: case.key(),
            stretch,
            is_one_map,
            is_blocked: verdicts.is_blocked,
            elastic,
        })
    })
}

pub(crate) struct CorrelationRow<'a> {
    key: CaseKey<'a>,
    found: Correlated,
}

rows! { CorrelationRow<'_> => "correlations.csv";
    "One row for each surface, law, conductance and correlation in use for it, on the first realisation with the r.m.s. height and gradient of its map.";
    ..case_columns(|row: &Self| row.key);
    row =>
    conductance["text"] = row.found.quantity.name(), "The conductance.";
    correlation["text"] = row.found.formula.name(), "The correlation: `cooper-mikic-yovanovich` for plastic contact, 1.25 (m/sigma) (p/H)^0.95/s, or `mikic` for elastic contact, 1.55 (m/sigma) (2^0.5 p/(E* m))^0.94/s; m is the mean absolute slope, s the mean resistivity. With a reference on a finite map also `greenwood-cluster`: the spots of the sum at the same load as a cluster between half-spaces (Greenwood 1966).";
    against["text"] = row.found.against, "What it is compared with: the `reference`; for a correlation of an interface without end, where none without end was run, the `deterministic` model.";
    accepted["1", percent] = row.found.accepted, "The largest difference that is accepted.";
    from_pa["Pa", prefix("M"), label("within from")] = row.found.within().map(|loads| loads[0]), "Lowest nominal pressure of the longest stretch of admissible loads that were run at which it is within what is accepted, also where what it is compared with is off by its bound; empty where it is at none.";
    to_pa["Pa", prefix("M"), label("to")] = row.found.within().map(|loads| loads[1]), "Highest such pressure.";
    lowest_difference["1", signed_percent] = row.found.range()[0], "Smallest relative difference over the admissible loads.";
    bound["1", percent] = row.found.bound(), "Largest bound of the error of the reference, relative; 0 of the sum.";
    highest_difference["1", signed_percent] = row.found.range()[1], "Largest relative difference over the admissible loads.";
}

pub(super) fn correlations(results: &CompareResults) -> impl Iterator<Item = CorrelationRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let all = Correlated::all(case).unwrap_or_default().into_iter();
        all.map(move |found| CorrelationRow { key: case.key(), found })
    })
}
