//! `greenwood_tripp.csv`: pressure over separation of two rough bodies by Greenwood and Tripp (1971).

use asperity::study::GreenwoodTrippPoint;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;

/// One separation of two rough bodies.
pub(crate) struct GreenwoodTrippRow<'a> {
    key: CaseKey<'a>,
    point: &'a GreenwoodTrippPoint,
}

impl Row for GreenwoodTrippRow<'_> {
    const FILE: &'static str = "greenwood_tripp.csv";
    const ROWS: &'static str = "One row for each pair of rough bodies, law for spheres, layer thickness and separation (those of the spec, else 0 to 4 by 0.1): the integral of Greenwood and Tripp (1971) over the asperities of both, where neither body has less than half the standard deviation of the other.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            separation_over_sigma["1", label("h/σ"), input] = row.point.response.separation_over_sigma, "Distance of both mean asperity heights over sigma, sigma^2 being the sum of the variances of both asperity heights.";
            separation_m["m", label("h")] = row.point.response.separation, "The same distance.";
            pressure_pa["Pa", prefix("M"), label("nominal pressure")] = row.point.response.pressure.total(), "Nominal pressure under the law. Of elastic contacts (`hertz`) it is K F_5/2, of equal bodies K = 16 2^.5 pi/15 (eta R sigma)^2 (sigma/R)^.5 E*.";
            area_ratio["1", label("real contact area"), percent] = row.point.response.area_ratio.total(), "Real contact area over nominal area under the law.";
            f_5_2["1", label("F_5/2")] = row.point.moment, "F_5/2(h/sigma), the integral of (s - h/sigma)^2.5 over the standard normal density from s = h/sigma on.";
            power_law["1", label("4.4086e-5 (4 - h/σ)^6.804")] = row.point.power_law, "The fit 4.4086e-5 (4 - h/sigma)^6.804, which codes of mixed lubrication use in place of F_5/2; 0 from 4 on.";
            power_law_error["1", label("its error"), signed_percent, scale(1.0)] = row.point.power_law / row.point.moment - 1.0, "The power law over F_5/2, less 1: the relative error of the elastic pressure by it.";
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = GreenwoodTrippRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        case.case.greenwood_tripp.iter().map(move |point| GreenwoodTrippRow { key: case.key(), point })
    })
}
