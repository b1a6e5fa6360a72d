//! What a sweep has of a comparison, and the tables of a layer.

use asperity::ModulusModel;
use asperity::compare::{
    ByQuantity, ComparedQuantity, Difference, Estimate, ModelKind, ModulusError, Verdict,
};
use asperity::study::{DecreaseResults, FilmFriction, LoadResults, Threshold, Verdicts};
use asperity_contact_framework::report::table::{Column, Row, Value};
use asperity_contact_framework::{columns, rows};

use super::super::results::CompareResults;
use super::{CaseKey, SurfaceCase, case_columns};
use crate::model_tables::{ELECTRICAL, FRICTION, REFERENCE, THERMAL, limits};

pub(crate) struct SweptRow<'a> {
    key: CaseKey<'a>,
    verdicts: &'a Verdicts,
    at_load: &'a Difference,
    results: LoadResults,
    is_reported: bool,
}

impl SweptRow<'_> {
    fn value(&self, quantity: ComparedQuantity, model: Option<ModelKind>) -> Option<f64> {
        self.results.models.iter().find(|result| result.model == model)?.point.value(quantity)
    }

    fn estimate(&self, quantity: ComparedQuantity) -> Option<Estimate> {
        self.at_load.estimates[quantity as usize]
    }

    fn end(&self, quantity: ComparedQuantity, end: usize) -> Option<f64> {
        Some(quantity.reported(self.estimate(quantity)?.interval()?[end]))
    }

    /// `None` where the load is not admissible.
    fn verdict(&self, quantity: ComparedQuantity) -> Option<&'static str> {
        let estimate = self.estimate(quantity).filter(|_| self.at_load.exceeded().is_none())?;
        Some(self.verdicts.name(Verdict::from_estimate(&estimate, self.verdicts.accepted.band(quantity))))
    }
}

/// The quantities as columns begin with them: the name without and with the unit, the unit, and the part of a run without which they are not there.
const QUANTITIES: ByQuantity<(&str, &str, &str, Option<&str>)> = [
    ("separation", "separation_over_sigma", "1", None),
    ("area", "area_ratio", "1", None),
    ("stiffness", "stiffness_pa_per_m", "Pa/m", None),
    ("electrical_conductance", "electrical_conductance_s_per_m2", "S/m²", Some(ELECTRICAL)),
    ("thermal_conductance", "thermal_conductance_w_per_m2_k", "W/(m² K)", Some(THERMAL)),
    ("friction", "friction", "1", Some(FRICTION)),
];

/// The name of a column: of a `model` (`statistical`, `deterministic`, `reference`), or `difference`, `low`, `high` or `verdict`.
pub(crate) fn swept_name(quantity: ComparedQuantity, what: &str) -> String {
    let (short, with_unit, ..) = QUANTITIES[quantity as usize];
    match what {
        "statistical" | "deterministic" | REFERENCE => format!("{what}_{with_unit}"),
        other => format!("{short}_{other}"),
    }
}

impl Row for SweptRow<'_> {
    const FILE: &'static str = "swept.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness and load, over all realisations: both models, the difference with its 95 % interval, and the verdict.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
            pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.at_load.load, "Nominal pressure.";
            reported["true/false"] = row.is_reported, "Whether results are reported at this load: that of the spec, of several the middle one of those that are admissible.";
            limits["text"] = limits(row.at_load.exceeded()), "Limits of admissible loads that are exceeded, as in `curves.csv`.";
        });
        for quantity in ComparedQuantity::REPORTED {
            columns.extend(of_quantity(quantity));
        }
        columns
    }
}

fn of_quantity<'a>(quantity: ComparedQuantity) -> Vec<Column<SweptRow<'a>>> {
    let (short, _, unit, part) = QUANTITIES[quantity as usize];
    let name = |what: &str| swept_name(quantity, what);
    let words = short.replace('_', " ");
    let model = |model: Option<ModelKind>, title: &str| {
        let value = move |row: &SweptRow| Value::from(row.value(quantity, model));
        Column::new(name(model.map_or(REFERENCE, ModelKind::name)), unit, format!("{title}: {words}."), value)
    };
    let of_difference = |what: &str, meaning: &str, value: fn(&SweptRow, ComparedQuantity) -> Option<f64>| {
        let column =
            Column::new(name(what), "1", meaning, move |row: &SweptRow| Value::from(value(row, quantity)));
        let column = column.scale(1.0);
        if quantity == ComparedQuantity::Separation { column.signed() } else { column.signed_percent() }
    };
    let verdict = Column::new(
        name("verdict"),
        "text",
        "The verdict on the difference, as in `differences.csv`; empty where the load is not admissible.",
        move |row: &SweptRow| Value::from(row.verdict(quantity)),
    );
    let columns = vec![
        model(Some(ModelKind::Statistical), "Statistical model"),
        model(Some(ModelKind::Deterministic), "Deterministic model"),
        model(None, "Reference").part(REFERENCE),
        of_difference(
            "difference",
            "Statistical minus deterministic: relative, of the separation in sigma.",
            |row, quantity| Some(quantity.reported(row.estimate(quantity)?.contrast)),
        ),
        of_difference(
            "low",
            "Lower end of its 95 % interval; empty where none is claimed.",
            |row, quantity| row.end(quantity, 0),
        ),
        of_difference("high", "Upper end.", |row, quantity| row.end(quantity, 1)),
        verdict.verdict(),
    ];
    let with_part = |column: Column<SweptRow<'a>>| match part {
        Some(part) if column.heading.part.is_none() => column.part(part),
        _ => column,
    };
    columns.into_iter().map(with_part).collect()
}

pub(crate) fn rows(results: &CompareResults) -> impl Iterator<Item = SweptRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let reported = case.case.reported_load().map(|at| at.load);
        let mut loads: Vec<&Difference> = case.verdicts().differences.iter().collect();
        loads.sort_by(|a, b| a.load.total_cmp(&b.load));
        loads.into_iter().map(move |at_load| SweptRow {
            key: case.key(),
            verdicts: case.verdicts(),
            at_load,
            results: case.case.results_at(at_load.load),
            is_reported: reported == Some(at_load.load),
        })
    })
}

/// Up to which thickness a layer changes the area of a model by at most 5 %.
pub(crate) struct ThresholdRow<'a> {
    surface: &'a str,
    threshold: &'a Threshold,
}

rows! { ThresholdRow<'_> => "layer_thresholds.csv";
    "One row for each surface, law, model and load: the thickness up to which the layer changes the real contact area of the model at equal load by at most 5 %; found to within 1 %, on the first realisation. It is one of the model with its rule of the effective modulus and hardness. A load that is not admissible has none.";
    row =>
    surface["text"] = row.surface, "Name of the surface.";
    law["text"] = row.threshold.law.as_str(), "Contact law of an asperity.";
    model["text"] = row.threshold.kind.name(), "Model: `statistical` or `deterministic`.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.threshold.pressure, "Nominal pressure.";
    thickness_m["m", label("at most 5 % up to")] = row.threshold.thickness, "The thickness; inf where every layer changes the area by less; empty where even the thinnest one tested changes it by more, and at a load that is not admissible.";
    limits["text", label("not admissible")] = limits(row.threshold.exceeded), "Limits that one of the models exceeds at the load without the layer, as in `curves.csv`; empty at an admissible load.";
}

pub(super) fn thresholds(results: &CompareResults) -> impl Iterator<Item = ThresholdRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        let name = &surface.surface.name;
        surface.thresholds.iter().map(move |threshold| ThresholdRow { surface: name, threshold })
    })
}

/// A range in which a deeper asperity has less area or load.
pub(crate) struct DecreaseRow<'a> {
    surface: &'a str,
    decrease: &'a DecreaseResults,
}

rows! { DecreaseRow<'_> => "decreases.csv";
    "One row for each surface, law, layer thickness, asperity (the sharpest, one of the mean radius, the bluntest) and range of indentations in which its area or load decreases; a load that decreases is reached at several separations, of which the first on approach is reported.";
    ..case_columns(|row: &Self| CaseKey {
            surface: row.surface,
            law: &row.decrease.law,
            thickness: row.decrease.thickness,
        });
    row =>
    radius_m["m"] = row.decrease.radius, "Radius of the asperity.";
    of["text", label("decreasing")] = row.decrease.decrease.of.name(), "What decreases: `area` or `load`.";
    from_m["m", label("from indentation")] = row.decrease.decrease.from.indentation, "Indentation at which it begins.";
    to_m["m", label("to")] = row.decrease.decrease.to.indentation, "Indentation at which it ends.";
    loss["1", percent] = row.decrease.decrease.loss(), "Relative decrease.";
}

pub(super) fn decreases(results: &CompareResults) -> impl Iterator<Item = DecreaseRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        let name = &surface.surface.name;
        surface.decreases.iter().map(move |decrease| DecreaseRow { surface: name, decrease })
    })
}

/// An effective-modulus model against the exact solution.
pub(crate) struct RuleRow<'a> {
    rule: ModulusModel,
    error: &'a ModulusError,
}

rows! { RuleRow<'_> => "layer_rules.csv";
    "One row for each effective-modulus model and contact radius over layer thickness: the elastic load of a ball by the model over that of the exact solution at equal indentation.";
    row =>
    rule["text"] = row.rule.name(), "The model: `gao` or `series`.";
    contact_radius_over_thickness["1", label("a/t")] = row.error.contact_ratio, "Exact contact radius over layer thickness.";
    load_over_exact["1"] = row.error.ratio, "Load by the model over the exact one.";
}

impl<'a> RuleRow<'a> {
    /// The rows; none where no contact needs a model.
    pub(crate) fn all(results: &'a CompareResults) -> impl Iterator<Item = Self> {
        let check = results.contact.layer.iter().filter_map(|layer| layer.check.as_ref());
        check.flat_map(|check| {
            let each = ModulusModel::ALL.into_iter().zip(&check.reported);
            each.flat_map(|(rule, errors)| errors.iter().map(move |error| Self { rule, error }))
        })
    }
}

/// One law, model, load and breakdown.
pub(crate) struct FrictionRow<'a> {
    surface: &'a str,
    found: &'a FilmFriction,
}

rows! { FrictionRow<'_> => "friction_by_thickness.csv";
    "One row for each surface, law, load, breakdown of the layer and model, on the first realisation: the layer thickness of the smallest coefficient of friction, of those that were run.";
    row =>
    surface["text"] = row.surface, "Name of the surface.";
    law["text"] = row.found.law.as_str(), "Contact law of an asperity.";
    pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.found.pressure, "Nominal pressure.";
    breakdown["1", label("breakdown w/t")] = row.found.breakdown, "Indentation over the thickness from which on a spot has broken through the layer and shears as the interface without it.";
    model["text"] = row.found.kind.name(), "Model: `statistical` or `deterministic`.";
    least_at_m["m", label("least at"), thickness] = row.found.least().map(|(thickness, _)| thickness), "Thickness of the smallest coefficient.";
    least["1", label("least coefficient")] = row.found.least().map(|(_, coefficient)| coefficient), "The coefficient there.";
    uncoated["1"] = row.found.at(0.0), "Coefficient without the layer; empty where that was not run.";
    bulk["1"] = row.found.at(f64::INFINITY), "Coefficient on the bulk of the layer's material; empty where that was not run.";
}

pub(super) fn friction(results: &CompareResults) -> impl Iterator<Item = FrictionRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        let name = &surface.surface.name;
        surface.friction.iter().map(move |found| FrictionRow { surface: name, found })
    })
}
