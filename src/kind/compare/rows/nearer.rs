//! `reference_curves.csv`: what was solved; `nearer_to_reference.csv`: which model is nearer to the reference.

use asperity::Limit;
use asperity::compare::{ModelKind, NearerStretch, ReferenceCurve, Verdict};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::reference::ElasticCase;
use crate::kind::compare::results::CompareResults;

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

impl Row for ReferenceCurveRow<'_> {
    const FILE: &'static str = "reference_curves.csv";
    const ROWS: &'static str = "One row for each surface, law and layer thickness on which the boundary element reference was run, over all realisations.";
    const RECORDS: Option<&'static str> = Some("reference");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
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
        });
        columns
    }
}

/// The rows of what was solved.
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

impl Row for NearerRow<'_> {
    const FILE: &'static str = "nearer_to_reference.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, quantity and stretch of load at which the same model is nearer to the reference.";
    const RECORDS: Option<&'static str> = Some("nearer_to_reference");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            quantity["text"] = row.stretch.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
            from_pa["Pa", prefix("M"), label("from"), input] = row.stretch.loads[0], "Lowest nominal pressure of the stretch.";
            to_pa["Pa", prefix("M"), label("to"), input] = row.stretch.loads[1], "Highest nominal pressure of the stretch.";
            nearer["text", label("nearer, on such surfaces")] = row.stretch.nearer.filter(|_| !row.is_blocked).map(ModelKind::name), "The nearer model, with the sampling error of such surfaces; empty where it cannot be told, or both are as near; and on a blocked map.";
            nearer_on_this_map["text"] = row.stretch.nearer_here.filter(|_| row.is_one_map && !row.is_blocked).map(ModelKind::name), "The same on this very map; empty over several realisations.";
            both_beyond["true/false", label("both beyond")] = row.stretch.verdicts_here == [Verdict::Beyond; 2], "Whether both models differ from the reference on this map (over realisations: in the mean) by more than is accepted, so that the nearer one is not good either.";
            limits["text"] = row.stretch.beyond.map(Limit::name), "The limit of admissible loads that is exceeded: `large-strain` where the loads exceed that one alone, and contacts are elastic on a homogeneous half-space: the comparison is homogeneous in the heights and holds for lower surfaces of the same shape. Else empty.";
            elastic_reference["text", label("elastic reference")] = row.elastic.map(|elastic| elastic.reason.name()), "Why the reference stays elastic although the law yields, so that the row leaves yielding out: `layer` (of finite thickness), `no-hardness` or `asked` by the spec; empty where it does not, or the law does not yield.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = NearerRow<'_>> {
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
