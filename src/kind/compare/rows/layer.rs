//! Tables about the layer: thresholds, decreasing areas and loads, accuracy of the effective-modulus models.

use asperity::ModulusModel;
use asperity::compare::ModulusError;
use asperity::study::{DecreaseResults, FilmFriction, Threshold};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::limits;

/// Up to which thickness a layer changes the area of a model by at most 5 %.
pub(crate) struct ThresholdRow<'a> {
    surface: &'a str,
    threshold: &'a Threshold,
}

impl Row for ThresholdRow<'_> {
    const FILE: &'static str = "layer_thresholds.csv";
    const ROWS: &'static str = "One row for each surface, law, model and load: the thickness up to which the layer changes the real contact area of the model at equal load by at most 5 %; found to within 1 %, on the first realisation. It is one of the model with its rule of the effective modulus and hardness. A load that is not admissible has none.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface["text"] = row.surface, "Name of the surface.";
            law["text"] = row.threshold.law.as_str(), "Contact law of an asperity.";
            model["text"] = row.threshold.kind.name(), "Model: `statistical` or `deterministic`.";
            pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.threshold.pressure, "Nominal pressure.";
            thickness_m["m", label("at most 5 % up to")] = row.threshold.thickness, "The thickness; inf where every layer changes the area by less; empty where even the thinnest one tested changes it by more, and at a load that is not admissible.";
            limits["text", label("not admissible")] = limits(row.threshold.exceeded), "Limits that one of the models exceeds at the load without the layer, as in `curves.csv`; empty at an admissible load.";
        }
    }
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

impl Row for DecreaseRow<'_> {
    const FILE: &'static str = "decreases.csv";
    const ROWS: &'static str = "One row for each surface, law, layer thickness, asperity (the sharpest, one of the mean radius, the bluntest) and range of indentations in which its area or load decreases; a load that decreases is reached at several separations, of which the first on approach is reported.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| CaseKey {
            surface: row.surface,
            law: &row.decrease.law,
            thickness: row.decrease.thickness,
        });
        columns.extend(columns! { row: Self =>
            radius_m["m"] = row.decrease.radius, "Radius of the asperity.";
            of["text", label("decreasing")] = row.decrease.decrease.of.name(), "What decreases: `area` or `load`.";
            from_m["m", label("from indentation")] = row.decrease.decrease.from.indentation, "Indentation at which it begins.";
            to_m["m", label("to")] = row.decrease.decrease.to.indentation, "Indentation at which it ends.";
            loss["1", percent] = row.decrease.decrease.loss(), "Relative decrease.";
        });
        columns
    }
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

impl Row for RuleRow<'_> {
    const FILE: &'static str = "layer_rules.csv";
    const ROWS: &'static str = "One row for each effective-modulus model and contact radius over layer thickness: the elastic load of a ball by the model over that of the exact solution at equal indentation.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            rule["text"] = row.rule.name(), "The model: `gao` or `series`.";
            contact_radius_over_thickness["1", label("a/t")] = row.error.contact_ratio, "Exact contact radius over layer thickness.";
            load_over_exact["1"] = row.error.ratio, "Load by the model over the exact one.";
        }
    }
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

impl Row for FrictionRow<'_> {
    const FILE: &'static str = "friction_by_thickness.csv";
    const ROWS: &'static str = "One row for each surface, law, load, breakdown of the layer and model, on the first realisation: the layer thickness of the smallest coefficient of friction, of those that were run.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
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
    }
}

pub(super) fn friction(results: &CompareResults) -> impl Iterator<Item = FrictionRow<'_>> {
    results.surfaces.iter().flat_map(|surface| {
        let name = &surface.surface.name;
        surface.friction.iter().map(move |found| FrictionRow { surface: name, found })
    })
}
