//! What each model says: `results.csv`, `largest_gaps.csv`, curves and pairs, `lines.csv` and `readings.csv`.

use asperity::Exceeded;
use asperity::analytical::AnalyticalLine;
use asperity::compare::{ComparedQuantity, CurvePoint, Gap, ModelKind, of_each_decade};
use asperity::spot::tube_factor;
use asperity::study::{CaseResults, ModelResult, RealisationFacts};
use asperity_contact_framework::rows;

use super::super::figures::curves::{KINDS, Rough, loads};
use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::figures::curves::curve;
use crate::kind::compare::readings::{ReadLoads, loads_by_reading};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{
    AnyPoint, CONDUCTION, CurveRow, ELECTRICAL, FRICTION, PairRow, REFERENCE, RowCase, THERMAL, limits,
    of_models,
};

/// One model, or the reference, at the load of a spec.
pub(crate) struct ResultRow<'a> {
    key: CaseKey<'a>,
    result: ModelResult,
    exceeded: Exceeded,
    is_fit: bool,
    /// m²
    nominal_area: f64,
}

impl ResultRow<'_> {
    fn share(&self, regime: usize) -> Option<f64> {
        self.result.point.shares.map(|shares| shares[regime])
    }

    fn end(&self, quantity: ComparedQuantity, end: usize) -> Option<f64> {
        self.result.intervals[quantity as usize].map(|ends| ends[end])
    }

    fn area_end(&self, end: usize) -> Option<f64> {
        Some(self.end(ComparedQuantity::Area, end)? * self.nominal_area)
    }

    fn tube_factor(&self) -> Option<f64> {
        self.result.model.map(|_| tube_factor(self.result.point.area_ratio))
    }

    /// A quantity that follows from the spots of the contact.
    fn of_spots(&self, quantity: ComparedQuantity) -> Option<f64> {
        self.result.point.value(quantity)
    }
}

rows! { ResultRow<'_> => "results.csv", records "results";
    "One row for each surface, law, layer thickness and model: its results at the load that was asked for, of several loads at the middle one of those that are admissible (and at which the reference was run), or of all where none is; over several realisations the mean. The reference where it was run.";
    ..case_columns(|row: &Self| row.key);
    row =>
    model["text"] = row.result.model.map_or(REFERENCE, ModelKind::name), "Model: `statistical`, `deterministic` or `reference`.";
    force_n["N", label("load")] = row.result.point.pressure * row.nominal_area, "Load on the nominal area.";
    nominal_area_m2["m²", prefix("m"), label("nominal area")] = row.nominal_area, "The area that the load acts on: `nominal-area` of the spec, or that of the surface.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure")] = row.result.point.pressure, "Load over nominal area.";
    separation_m["m"] = row.result.point.separation.map(|[d, _]| d), "Separation of the flat from the mean asperity height.";
    separation_over_sigma["1"] = row.result.point.separation.map(|[_, h]| h), "The same over sigma, the standard deviation of the asperity heights.";
    real_area_m2["m²", prefix("µ"), label("real contact area")] = row.result.point.area_ratio * row.nominal_area, "Real contact area; that of boundary elements on a map without summits of different heights is of the points in contact.";
    real_area_low_m2["m²", prefix("µ"), label("95 % interval from")] = row.area_end(0), "Lower end of its 95 % interval, from blocks of the map, independent asperities or realisations; empty where there is none.";
    real_area_high_m2["m²", prefix("µ"), label("to")] = row.area_end(1), "Upper end.";
    area_ratio["1", label("of the nominal area"), percent] = row.result.point.area_ratio, "Real contact area over nominal area.";
    contacts["1"] = row.result.point.contact_density.map(|density| density * row.nominal_area), "Number of contacts; empty for the reference.";
    mean_real_pressure_pa["Pa", prefix("M"), label("mean contact pressure")] = row.result.point.mean_real_pressure(), "Load over real contact area; empty where there is no contact.";
    stiffness_n_per_m["N/m", label("stiffness")] = row.result.point.stiffness.map(|stiffness| stiffness * row.nominal_area), "Contact stiffness of the nominal area.";
    electrical_conductance_s_per_m2["S/m²", part(ELECTRICAL), prefix("M"), label("electrical conductance")] = row.of_spots(ComparedQuantity::ElectricalConductance), "Electrical conductance per nominal area, of a sum or integral without interaction of the spots; there only where it is asked for.";
    electrical_conductance_low_s_per_m2["S/m²", part(ELECTRICAL), prefix("M"), label("95 % interval from")] = row.end(ComparedQuantity::ElectricalConductance, 0), "Lower end of its 95 % interval; empty where there is none.";
    electrical_conductance_high_s_per_m2["S/m²", part(ELECTRICAL), prefix("M"), label("to")] = row.end(ComparedQuantity::ElectricalConductance, 1), "Upper end.";
    thermal_conductance_w_per_m2_k["W/(m² K)", part(THERMAL), prefix("k"), label("thermal conductance")] = row.of_spots(ComparedQuantity::ThermalConductance), "Thermal conductance per nominal area, likewise.";
    thermal_conductance_low_w_per_m2_k["W/(m² K)", part(THERMAL), prefix("k"), label("95 % interval from")] = row.end(ComparedQuantity::ThermalConductance, 0), "Lower end of its 95 % interval; empty where there is none.";
    thermal_conductance_high_w_per_m2_k["W/(m² K)", part(THERMAL), prefix("k"), label("to")] = row.end(ComparedQuantity::ThermalConductance, 1), "Upper end.";
    tube_factor["1", part(CONDUCTION), label("tube factor")] = row.tube_factor(), "Factor of the constriction resistance of the spots by their neighbours on an interface without end, (1 - (A/A_nom)^0.5)^1.5 (Cooper, Mikic and Yovanovich 1969): the conductance of a model over it counts them; empty for the reference, which does.";
    friction["1", part(FRICTION), label("coefficient of friction")] = row.of_spots(ComparedQuantity::Friction), "Coefficient of boundary friction: shear forces of all spots over the load; there only where it is asked for.";
    friction_low["1", part(FRICTION), label("95 % interval from")] = row.end(ComparedQuantity::Friction, 0), "Lower end of its 95 % interval; empty where there is none.";
    friction_high["1", part(FRICTION), label("to")] = row.end(ComparedQuantity::Friction, 1), "Upper end.";
    elastic_load_share["1", label("elastic"), percent] = row.share(0), "Share of the load in elastic contacts; empty for the reference and where there is no contact.";
    elastic_plastic_load_share["1", label("elastic-plastic"), percent] = row.share(1), "Share of the load in elastic-plastic contacts.";
    plastic_load_share["1", label("plastic"), percent] = row.share(2), "Share of the load in plastic contacts.";
    limits["text", label("exceeds")] = limits(row.exceeded), "Limits of admissible loads that are exceeded at this load, as in `curves.csv`; empty where it is admissible.";
    fit["true/false", label("map fit")] = row.is_fit, "Whether the surface passes the fitness checks that block a verdict.";
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = ResultRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let surface = &case.surface.surface;
        let at_load = case.case.results_at_load();
        at_load.models.into_iter().map(move |result| ResultRow {
            key: case.key(),
            result,
            exceeded: at_load.exceeded,
            is_fit: !surface.is_blocked(),
            nominal_area: case.surface.load_area,
        })
    })
}

/// The largest gap of a quantity between the models.
pub(crate) struct GapRow<'a> {
    key: CaseKey<'a>,
    realisation: usize,
    gap: &'a Gap,
}

rows! { GapRow<'_> => "largest_gaps.csv", records "largest_gaps";
    "One row for each surface, law, layer thickness, realisation, quantity and pairing: the largest gap between the models.";
    ..case_columns(|row: &Self| row.key);
    row =>
    realisation["count"] = row.realisation, "Number of the realisation of the surface, from 1.";
    quantity["text"] = row.gap.quantity.name(), "What is compared.";
    pairing["text"] = row.gap.pairing.name(), "What the models have in common: `load` or `separation`.";
    target["Pa or 1"] = row.gap.target, "Its value: nominal pressure, or separation over sigma.";
    statistical["SI"] = row.gap.statistical, "Statistical model.";
    deterministic["SI"] = row.gap.deterministic, "Deterministic model.";
    difference["SI", scale_of("statistical")] = row.gap.difference(), "Statistical minus deterministic.";
}

/// The rows of the largest gaps.
pub(super) fn gaps(results: &CompareResults) -> impl Iterator<Item = GapRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        (0..surface.realisations.len()).flat_map(move |realisation| {
            SurfaceCase::on_surface(surface).flat_map(move |case| {
                let gaps = case.case.realisations[realisation].gaps.largest.iter();
                gaps.map(move |gap| GapRow { key: case.key(), realisation: realisation + 1, gap })
            })
        })
    })
}

/// The rows of `curves.csv`.
pub(super) fn curves(results: &CompareResults) -> impl Iterator<Item = CurveRow> {
    let reduced_modulus = results.contact.reduced_modulus;
    cases(results).flat_map(move |(case, _, found)| {
        let reference = found.reference.iter().flat_map(|curve| curve.points.iter().copied());
        let all = of_models(&found.comparison).chain(reference.map(AnyPoint::Reference));
        all.map(move |point| CurveRow { case: case.clone(), point, reduced_modulus })
    })
}

/// The rows of `comparison.csv`.
pub(super) fn pairs(results: &CompareResults) -> impl Iterator<Item = PairRow> {
    cases(results).flat_map(|(case, realisation, found)| {
        let (nominal_area, plasticity_index) = (realisation.nominal_area, found.plasticity_index);
        found.comparison.pairs.iter().map(move |&pair| PairRow {
            case: case.clone(),
            pair,
            nominal_area,
            plasticity_index,
            attribution: found.attribution_of(&pair).cloned(),
            reference: found.reference_of(&pair).copied(),
        })
    })
}

/// Every case of every realisation of every surface, in file order.
pub(super) fn cases(
    results: &CompareResults,
) -> impl Iterator<Item = (RowCase, &RealisationFacts, &CaseResults)> {
    results.surfaces.iter().flat_map(|surface| {
        surface.realisations.iter().enumerate().flat_map(move |(index, realisation)| {
            surface.cases.iter().map(move |case| {
                let results = &case.realisations[index];
                (RowCase::from_results(&surface.surface.name, index + 1, results), realisation, results)
            })
        })
    })
}

pub(crate) struct LineRow<'a> {
    key: CaseKey<'a>,
    line: &'static str,
    /// The model whose separation is corrected.
    model: Option<&'static str>,
    pressure: f64,
    area_ratio: Option<f64>,
    separation: Option<f64>,
}

rows! { LineRow<'_> => "lines.csv";
    "One row for each surface, law, layer thickness, analytical line and load, on the first realisation, for elastic bodies under any law.";
    ..case_columns(|row: &Self| row.key);
    row =>
    line["text"] = row.line, "The line: `persson`, A/A_nom = erf(2^0.5 p/(E* g)); `bush-gibson-thomas`, (2 pi)^0.5 p/(E* g), at most 1; or `greenwood-williamson-interacting`, the separation less the mean deflection of the patch. g is the r.m.s. gradient of the prepared map.";
    model["text"] = row.model, "The model whose separation is corrected for interaction, or the reference, whose separation is that to the undeformed mean plane.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure")] = row.pressure, "Nominal pressure.";
    area_ratio["1"] = row.area_ratio, "Real contact area over nominal area.";
    separation_over_sigma["1"] = row.separation, "Separation over sigma.";
}

pub(super) fn lines(results: &CompareResults) -> impl Iterator<Item = LineRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| of_case(results, case))
}

fn of_case<'a>(results: &'a CompareResults, case: SurfaceCase<'a>) -> Vec<LineRow<'a>> {
    /// Loads per decade.
    const PER_DECADE: f64 = 2.0;
    /// A load is met to rounding.
    const ROUNDING: f64 = 1e-9;
    let Some(rough) = Rough::new(results, case.surface).filter(|_| !results.lines.is_empty()) else {
        return Vec::new();
    };
    let loads: Vec<f64> = match &case.first().reference {
        Some(curve) => curve.points.iter().map(|point| point.pressure).collect(),
        None => of_each_decade(loads(case.first()), |&load| load, PER_DECADE),
    };
    let row = |line: AnalyticalLine, model, pressure, area_ratio, separation| LineRow {
        key: case.key(),
        line: line.name(),
        model,
        pressure,
        area_ratio,
        separation,
    };
    let mut lines = Vec::new();
    for &line in &results.lines {
        let area = |load: f64| line.area_ratio(load / rough.modulus, rough.gradient);
        let areas = loads.iter().filter_map(|&load| Some(row(line, None, load, Some(area(load)?), None)));
        lines.extend(areas);
        if line != AnalyticalLine::GreenwoodWilliamsonInteracting {
            continue;
        }
        for kind in KINDS {
            let is_at_load = |point: &&CurvePoint| {
                let pressure = point.response.pressure.total();
                loads.iter().any(|load| (load / pressure - 1.0).abs() < ROUNDING)
            };
            let points = curve(&case.first().comparison, kind).into_iter().filter(is_at_load);
            lines.extend(points.map(|point| {
                let pressure = point.response.pressure.total();
                let separation = rough.interacting(point.response.separation_over_sigma, pressure);
                row(line, Some(kind.name()), pressure, None, Some(separation))
            }));
        }
        let points = case.first().reference.iter().flat_map(|curve| &curve.points);
        lines.extend(points.filter_map(|point| {
            Some(row(line, Some(REFERENCE), point.pressure, None, Some(rough.undeformed(point)?)))
        }));
    }
    lines
}

/// One model at one d/sigma under both readings.
pub(crate) struct ReadingRow(ReadLoads);

rows! { ReadingRow => "readings.csv";
    "One row for each pair of surfaces with the same specified numbers, of which one reads sigma and d as those of the asperities and the other as those of the surface, law, layer thickness, separation and model; pressures are means over the realisations.";
    row =>
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

pub(super) fn readings(results: &CompareResults) -> impl Iterator<Item = ReadingRow> {
    loads_by_reading(&results.surfaces).into_iter().map(ReadingRow)
}
