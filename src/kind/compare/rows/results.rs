//! `results.csv`: what the models say at the load; `largest_gaps.csv`: the largest gaps between them.

use asperity::Exceeded;
use asperity::compare::{ComparedQuantity, Gap, ModelKind};
use asperity::spot::tube_factor;
use asperity::study::ModelResult;
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::{CONDUCTION, ELECTRICAL, FRICTION, REFERENCE, THERMAL, limits};

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

    /// An end of the interval of a quantity.
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

impl Row for ResultRow<'_> {
    const FILE: &'static str = "results.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness and model: its results at the load that was asked for, of several loads at the middle one of those that are admissible (and at which the reference was run), or of all where none is; over several realisations the mean. The reference where it was run.";
    const RECORDS: Option<&'static str> = Some("results");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
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
        });
        columns
    }
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

impl Row for GapRow<'_> {
    const FILE: &'static str = "largest_gaps.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, realisation, quantity and pairing: the largest gap between the models.";
    const RECORDS: Option<&'static str> = Some("largest_gaps");

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            realisation["count"] = row.realisation, "Number of the realisation of the surface, from 1.";
            quantity["text"] = row.gap.quantity.name(), "What is compared.";
            pairing["text"] = row.gap.pairing.name(), "What the models have in common: `load` or `separation`.";
            target["Pa or 1"] = row.gap.target, "Its value: nominal pressure, or separation over sigma.";
            statistical["SI"] = row.gap.statistical, "Statistical model.";
            deterministic["SI"] = row.gap.deterministic, "Deterministic model.";
            difference["SI", scale_of("statistical")] = row.gap.difference(), "Statistical minus deterministic.";
        });
        columns
    }
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
