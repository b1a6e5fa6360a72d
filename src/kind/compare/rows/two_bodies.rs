//! `two_bodies.csv`: two rough bodies against what is usual in their place: one of them alone, or an integral over the asperities of both.

use asperity::compare::{ComparedQuantity, ModelKind};
use asperity::study::{GreenwoodTrippPoint, ModelResult, PointResult, Shortcut};
use asperity_contact_framework::rows;

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{ELECTRICAL, FRICTION, REFERENCE, THERMAL};

/// What a simplification of two rough bodies does to a result at one load.
pub(crate) struct TwoBodiesRow<'a> {
    key: CaseKey<'a>,
    simplification: Simplification<'a>,
    model: Option<ModelKind>,
    /// With both bodies rough, and simplified.
    points: [PointResult; 2],
    /// 95 % intervals of both areas, where there are any.
    areas: Option<[[f64; 2]; 2]>,
}

/// What stands in the place of two rough bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Simplification<'a> {
    /// One rough body against the one of this name, taken smooth.
    Smooth(&'a str),
    /// An integral over the asperities of both.
    Shortcut(Shortcut),
}

impl TwoBodiesRow<'_> {
    /// The model; `None` is the reference.
    pub(crate) fn model(&self) -> Option<ModelKind> {
        self.model
    }

    pub(crate) fn simplification(&self) -> Simplification<'_> {
        self.simplification
    }

    /// Nominal pressure, Pa.
    pub(crate) fn pressure(&self) -> f64 {
        self.points[0].pressure
    }

    pub(crate) fn error(&self, quantity: ComparedQuantity) -> Option<f64> {
        let [pair, simplified] = [0, 1].map(|k| self.points[k].value(quantity));
        Some(simplified? / pair? - 1.0)
    }

    /// The 95 % interval of [`Self::error`] of the area. That both areas are of the same heights would make it narrower.
    fn area_interval(&self) -> Option<[f64; 2]> {
        let half = |[low, high]: [f64; 2]| 0.5 * (high / low).ln();
        let [pair, simplified] = self.areas?.map(half);
        let (middle, half) = (1.0 + self.error(ComparedQuantity::Area)?, pair.hypot(simplified));
        (half.is_finite()).then(|| [-half, half].map(|half| middle * half.exp() - 1.0))
    }

    fn name(&self) -> String {
        match self.simplification {
            Simplification::Smooth(body) => format!("smooth {body}"),
            Simplification::Shortcut(shortcut) => shortcut.name().to_owned(),
        }
    }
}

rows! { TwoBodiesRow<'_> => "two_bodies.csv";
    "One row for each pair of rough bodies, law, layer thickness, simplification and model of the pair, at the load of the results. A body taken smooth is by the same model, and there where the other body is a surface of the comparison, too; `variances-added` and `greenwood-tripp` are integrals, compared with each model.";
    ..case_columns(|row: &Self| row.key);
    row =>
    simplification["text"] = row.name(), "In place of the sum of both bodies: `smooth NAME`, one body taken smooth; `variances-added`, one rough body with the variances of both asperity heights added, the radius of 1/R = 1/R1 + 1/R2 and the density of the rougher body; `greenwood-tripp`, every asperity of one against every one of the other (1971), where neither has less than half the standard deviation of the other.";
    model["text"] = row.model.map_or(REFERENCE, ModelKind::name), "Model of the pair: `statistical`, `deterministic` or `reference`.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.points[0].pressure, "Nominal pressure.";
    area_error["1", label("real contact area"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::Area), "Real contact area of the simplification over that of the model with both rough, less 1.";
    area_error_low["1", label("95 % interval from"), signed_percent, scale(1.0)] = row.area_interval().map(|[low, _]| low), "Lower end of its 95 % interval, of the intervals of both areas as if they were independent; empty where one has none, and of integrals over the asperities of both bodies.";
    area_error_high["1", label("to"), signed_percent, scale(1.0)] = row.area_interval().map(|[_, high]| high), "Upper end.";
    stiffness_error["1", label("stiffness"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::Stiffness), "The same of the stiffness; empty where there is none.";
    electrical_conductance_error["1", part(ELECTRICAL), label("electrical conductance"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::ElectricalConductance), "The same of the electrical conductance.";
    thermal_conductance_error["1", part(THERMAL), label("thermal conductance"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::ThermalConductance), "The same of the thermal conductance.";
    friction_error["1", part(FRICTION), label("friction"), signed_percent, scale(1.0)] = row.error(ComparedQuantity::Friction), "The same of the coefficient of friction.";
}

/// Loads that differ by less are the same.
const SAME: f64 = 1e-6;

pub(crate) fn rows(results: &CompareResults) -> Vec<TwoBodiesRow<'_>> {
    let mut rows = Vec::new();
    for pair in SurfaceCase::all(results) {
        let Some(bodies) = &pair.surface.surface.bodies else { continue };
        let [first, second] = bodies.each_ref().map(|body| body.name.as_str());
        let key = pair.key();
        let at_load = pair.case.results_at_load();
        let row = |simplification, both: &ModelResult, point, area: Option<[f64; 2]>| TwoBodiesRow {
            key,
            simplification,
            model: both.model,
            points: [both.point, point],
            areas: both.intervals[ComparedQuantity::Area as usize].zip(area).map(<[_; 2]>::from),
        };
        for (rough, smooth) in [(first, second), (second, first)] {
            let is_alone = |case: &SurfaceCase| {
                let own = case.key();
                own.surface == rough && own.law == key.law && own.thickness == key.thickness
            };
            let Some(alone) = SurfaceCase::all(results).find(is_alone) else { continue };
            let found = match pair.case.reported_load() {
                Some(at) => alone.case.results_at(at.load),
                None => alone.case.results_at_load(),
            };
            for both in &at_load.models {
                let is_its = |one: &&ModelResult| {
                    one.model == both.model && (one.point.pressure / both.point.pressure - 1.0).abs() < SAME
                };
                let of_model = found.models.iter().find(is_its);
                rows.extend(of_model.map(|one| {
                    let area = one.intervals[ComparedQuantity::Area as usize];
                    row(Simplification::Smooth(smooth), both, one.point, area)
                }));
            }
        }
        for found in &pair.case.shortcuts {
            let simplification = Simplification::Shortcut(found.shortcut);
            rows.extend(at_load.models.iter().map(|both| row(simplification, both, found.point, None)));
        }
    }
    rows
}

/// One separation of two rough bodies.
pub(crate) struct GreenwoodTrippRow<'a> {
    key: CaseKey<'a>,
    point: &'a GreenwoodTrippPoint,
}

rows! { GreenwoodTrippRow<'_> => "greenwood_tripp.csv";
    "One row for each pair of rough bodies, law for spheres, layer thickness and separation (those of the spec, else 0 to 4 by 0.1): the integral of Greenwood and Tripp (1971) over the asperities of both, where neither body has less than half the standard deviation of the other.";
    ..case_columns(|row: &Self| row.key);
    row =>
    separation_over_sigma["1", label("h/σ"), input] = row.point.response.separation_over_sigma, "Distance of both mean asperity heights over sigma, sigma^2 being the sum of the variances of both asperity heights.";
    separation_m["m", label("h")] = row.point.response.separation, "The same distance.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure")] = row.point.response.pressure.total(), "Nominal pressure under the law. Of elastic contacts (`hertz`) it is K F_5/2, of equal bodies K = 16 2^.5 pi/15 (eta R sigma)^2 (sigma/R)^.5 E*.";
    area_ratio["1", label("real contact area"), percent] = row.point.response.area_ratio.total(), "Real contact area over nominal area under the law.";
    f_5_2["1", label("F_5/2")] = row.point.moment, "F_5/2(h/sigma), the integral of (s - h/sigma)^2.5 over the standard normal density from s = h/sigma on.";
    power_law["1", label("4.4086e-5 (4 - h/σ)^6.804")] = row.point.power_law, "The fit 4.4086e-5 (4 - h/sigma)^6.804, which codes of mixed lubrication use in place of F_5/2; 0 from 4 on.";
    power_law_error["1", label("its error"), signed_percent, scale(1.0)] = row.point.power_law / row.point.moment - 1.0, "The power law over F_5/2, less 1: the relative error of the elastic pressure by it.";
}

pub(super) fn greenwood_tripp(results: &CompareResults) -> impl Iterator<Item = GreenwoodTrippRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        case.case.greenwood_tripp.iter().map(move |point| GreenwoodTrippRow { key: case.key(), point })
    })
}
