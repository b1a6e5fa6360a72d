//! What is shown of all cases together: views of tables.

use asperity::compare::ComparedQuantity;
use asperity_contact_framework::report::format::capitalised;
use asperity_contact_framework::report::page::Page;
use asperity_contact_framework::report::table::{Reading, Tables};
use asperity_contact_framework::report::view::View;

use crate::kind::compare::figures::layers;
use crate::kind::compare::rows::{
    AnswerRow, CaseRow, DecreaseRow, FrictionRow, GreenwoodTrippRow, NearerRow, ReadingRow,
    ReferenceCurveRow, ResultRow, RuleRow, StandingRow, ThresholdRow, TwoBodiesRow, VerdictRow,
};
use crate::kind::compare::series::Series;
use crate::model_tables::REFERENCE;
use crate::presentation::quantity_name;

/// Columns that name a case, which are left out where there is one.
const CASE: [&str; 3] = ["surface", "law", "layer_thickness_m"];

/// More rows are folded.
const MOST_OPEN: usize = 12;

/// May the integral replace the sum, case by case.
pub fn answers<'t>(tables: &'t Tables) -> View<'t> {
    tables.view::<AnswerRow>().without_constant(&CASE)
}

/// The answer at the one load or separation of a spec.
pub fn results(page: &mut Page, tables: &Tables) {
    let view = tables.view::<ResultRow>();
    if view.is_empty() {
        return;
    }
    let view = view.without_constant(&CASE);
    if view.len() > MOST_OPEN {
        page.details(2, "Results at one load", |page| {
            page.view(&view);
        });
    } else {
        page.heading(2, "Results").view(&view);
    }
}

/// What simplifications of two rough bodies do to the results.
pub fn two_bodies(page: &mut Page, tables: &Tables) {
    let view = tables.view::<TwoBodiesRow>().without_constant(&CASE);
    if !view.is_empty() {
        page.heading(2, "What if the two rough bodies are simplified?").view(&view);
    }
    let curve = tables.view::<GreenwoodTrippRow>().without_constant(&CASE);
    if !curve.is_empty() {
        page.details(2, "Pressure over separation by Greenwood and Tripp", |page| {
            page.view(&curve);
        });
    }
}

/// The friction of layers by their thickness: where it is least, and by which model.
pub fn friction(page: &mut Page, tables: &Tables, series: &[Series]) {
    let view = tables.view::<FrictionRow>();
    if view.is_empty() {
        return;
    }
    page.heading(2, "Boundary friction by layer thickness");
    for series in series {
        if let Some(figure) = layers::friction_by_thickness(series) {
            page.figure(
                &format!("{}-friction.svg", series.stem),
                figure,
                &format!(
                    "{}: coefficient of boundary friction against layer thickness. Thin layers are broken through, thick ones have more \
                     contact area. No ploughing, no growth of junctions.",
                    series.subject
                ),
            );
        }
    }
    let view = view.without_constant(&CASE[..2]);
    if view.len() > MOST_OPEN {
        page.details(3, "Least friction by load, breakdown and model", |page| {
            page.view(&view);
        });
    } else {
        page.view(&view);
    }
}

/// The verdicts on the statistical model against the sum, and how sure they are.
pub fn verdicts(page: &mut Page, tables: &Tables) {
    let view = tables.view::<VerdictRow>().only("against", "deterministic").without(&["model"]);
    if view.is_empty() {
        return;
    }
    page.heading(2, "May the integral replace the sum?");
    by_quantity(page, &view);
    page.details(3, "How sure are the verdicts?", |page| {
        page.view(&tables.view::<CaseRow>().without_constant(&CASE));
    });
}

/// A view of each quantity, whose differences have a unit of their own.
fn by_quantity(page: &mut Page, view: &View) {
    for quantity in ComparedQuantity::REPORTED {
        let view = view.clone().only("quantity", quantity.name()).without_constant(&CASE);
        let view = ["difference", "low", "high"].into_iter().fold(view, |view, column| match quantity {
            ComparedQuantity::Separation => view,
            _ => view.read_as(column, Reading::SignedPercent),
        });
        let view = match quantity {
            ComparedQuantity::Separation => view.label("difference", "largest difference (σ)"),
            _ => view.read_as("accepted", Reading::Percent),
        };
        if !view.is_empty() {
            let title = capitalised(quantity_name(quantity));
            if view.len() > MOST_OPEN {
                page.details(3, &title, |page| {
                    page.view(&view);
                });
            } else {
                page.heading(3, &title).view(&view);
            }
        }
    }
}

pub fn reference(page: &mut Page, tables: &Tables) {
    let solved = tables.view::<ReferenceCurveRow>();
    if solved.is_empty() {
        return;
    }
    page.heading(2, "Which model is nearer to the reference?");
    let nearer = tables.view::<NearerRow>().without_constant(&CASE);
    page.view(&nearer.clone().only("quantity", ComparedQuantity::Area.name()));
    page.details(3, "Separation, stiffness, and both models against the reference", |page| {
        page.view(&nearer.filter("quantity", |cell| cell.text() != ComparedQuantity::Area.name()));
        by_quantity(page, &tables.view::<VerdictRow>().only("against", REFERENCE));
        page.view(&solved.without_constant(&CASE));
    });
}

/// Which statistical models are within what is accepted.
pub fn models(page: &mut Page, tables: &Tables) {
    let view = tables.view::<StandingRow>().without(&["inapplicable", "within_in_sample"]);
    if view.is_empty() {
        return;
    }
    page.details(2, "Which statistical models are within what is accepted on this surface?", |page| {
        by_quantity_of_models(page, &view);
    });
}

fn by_quantity_of_models(page: &mut Page, view: &View) {
    for quantity in ComparedQuantity::REPORTED {
        let view =
            view.clone().only("quantity", quantity.name()).without_constant(&CASE).without(&["within"]);
        let view = match quantity {
            ComparedQuantity::Separation => view.label("nearest_difference", "its difference (σ)"),
            _ => view
                .read_as("nearest_difference", Reading::SignedPercent)
                .read_as("accepted", Reading::Percent),
        };
        if !view.is_empty() {
            page.heading(3, &capitalised(quantity_name(quantity))).view(&view);
        }
    }
}

/// What the layer changes, and how good its effective modulus is.
pub fn layer(page: &mut Page, tables: &Tables) {
    let thresholds = tables.view::<ThresholdRow>().without_constant(&CASE[..2]);
    if !thresholds.is_empty() {
        page.heading(2, "Up to which thickness does the layer change the model's area by at most 5 %?")
            .view(&thresholds);
    }
    let rules = tables.view::<RuleRow>();
    if !rules.is_empty() {
        page.details(2, "Accuracy of the effective-modulus models", |page| {
            page.view(&rules);
        });
    }
    let decreases = tables.view::<DecreaseRow>().without_constant(&CASE);
    if !decreases.is_empty() {
        page.details(2, "Asperities whose area or load decreases as they are pressed deeper", |page| {
            page.view(&decreases);
        });
    }
}

/// σ and d read as those of the asperities, or of the surface.
pub fn readings(page: &mut Page, tables: &Tables) {
    let view = tables.view::<ReadingRow>();
    if !view.is_empty() {
        page.heading(2, "Two readings of σ and d").view(&view);
    }
}
