//! The tables of a comparison besides curves and pairs: a type of rows in each file.

mod answers;
mod attribution;
mod cases;
mod correlations;
mod curves;
pub(crate) mod differences;
mod friction;
mod greenwood_tripp;
mod layer;
mod lines;
mod nearer;
mod on_map;
mod ranking;
mod readings;
mod reference;
mod results;
mod robustness;
mod spread;
mod standings;
mod swept;
mod two_bodies;
mod verdicts;

pub(crate) use answers::{AnswerRow, rows as answers};
pub(crate) use attribution::AttributionRow;
pub(crate) use cases::CaseRow;
pub(crate) use correlations::CorrelationRow;
pub(crate) use friction::FrictionRow;
pub(crate) use greenwood_tripp::GreenwoodTrippRow;
pub(crate) use layer::{DecreaseRow, RuleRow, ThresholdRow};
pub(crate) use lines::LineRow;
pub(crate) use nearer::{NearerRow, ReferenceCurveRow};
pub(crate) use on_map::OnMapRow;
pub(crate) use readings::ReadingRow;
pub(crate) use results::{GapRow, ResultRow};
pub(crate) use robustness::{RobustnessRow, words as treatment_words};
pub(crate) use spread::SpreadRow;
pub(crate) use standings::StandingRow;
pub(crate) use swept::{SweptRow, rows as swept, swept_name};
pub(crate) use two_bodies::{Simplification, TwoBodiesRow, rows as two_bodies};
pub(crate) use verdicts::VerdictRow;

use asperity::compare::ComparedQuantity;
use asperity::study::{CaseResults, CaseStudy, Verdicts};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Schema, Table};

use super::results::{CompareResults, SurfaceResults};
use crate::model_tables::{CAUSES, CurveRow, PairRow, REFERENCE, of_asked_spots};
use crate::surface::rows as surface_rows;
use differences::DifferenceRow;
use ranking::RankingRow;
use reference::ReferenceRow;

#[derive(Clone, Copy)]
pub(crate) struct SurfaceCase<'a> {
    pub(crate) surface: &'a SurfaceResults,
    /// What is known of it.
    pub(crate) case: &'a CaseStudy,
}

impl<'a> SurfaceCase<'a> {
    /// All cases, surface by surface.
    pub(crate) fn all(results: &'a CompareResults) -> impl Iterator<Item = Self> + Clone {
        results.surfaces.iter().flat_map(Self::on_surface)
    }

    /// The cases of one surface.
    pub(crate) fn on_surface(surface: &'a SurfaceResults) -> impl Iterator<Item = Self> + Clone {
        surface.cases.iter().map(move |case| Self { surface, case })
    }

    /// Results on the first realisation.
    pub(crate) fn first(&self) -> &'a CaseResults {
        self.case.first()
    }

    /// Whether the statistical model may be used.
    pub(crate) fn verdicts(&self) -> &'a Verdicts {
        &self.case.verdicts
    }

    /// Whether a quantity is compared: those that follow from spots are only where they are asked for.
    pub(crate) fn compares(&self, quantity: ComparedQuantity) -> bool {
        let has_estimate =
            || self.verdicts().differences.iter().any(|at| at.estimates[quantity as usize].is_some());
        quantity.spot().is_none() || has_estimate()
    }

    /// What it is called in tables.
    pub(crate) fn key(&self) -> CaseKey<'a> {
        let CaseResults { law, thickness, .. } = self.first();
        CaseKey { surface: &self.surface.surface.name, law, thickness: *thickness }
    }
}

/// The surface, law and layer thickness that a row belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CaseKey<'a> {
    pub(crate) surface: &'a str,
    pub(crate) law: &'a str,
    pub(crate) thickness: Option<f64>,
}

/// The columns of the case that a row belongs to.
fn case_columns<R>(key: impl for<'r> Fn(&'r R) -> CaseKey<'r> + Copy + 'static) -> Vec<Column<R>> {
    columns! { row: R =>
        surface["text"] = key(row).surface, "Name of the surface.";
        law["text"] = key(row).law, "Contact law of an asperity.";
        layer_thickness_m["m", label("layer"), thickness] = key(row).thickness, "Thickness of the layer, 0 for the bare substrate and inf for the bulk of the layer's material; empty where the spec has no layer.";
    }
}

/// The tables of a comparison.
pub(crate) fn schemas() -> Vec<Schema> {
    let mut schemas = vec![
        Schema::of::<AnswerRow>(),
        Schema::of::<OnMapRow>(),
        Schema::of::<VerdictRow>(),
        Schema::of::<CaseRow>(),
        Schema::of::<CurveRow>(),
        Schema::of::<PairRow>(),
        Schema::of::<GapRow>(),
        Schema::of::<DifferenceRow>(),
        Schema::of::<ResultRow>(),
        Schema::of::<SpreadRow>(),
        Schema::of::<AttributionRow>(),
        Schema::of::<RankingRow>(),
        Schema::of::<StandingRow>(),
        Schema::of::<ReferenceRow>(),
        Schema::of::<ReferenceCurveRow>(),
        Schema::of::<NearerRow>(),
        Schema::of::<RobustnessRow>(),
        Schema::of::<ThresholdRow>(),
        Schema::of::<DecreaseRow>(),
        Schema::of::<FrictionRow>(),
        Schema::of::<RuleRow>(),
        Schema::of::<ReadingRow>(),
        Schema::of::<LineRow>(),
        Schema::of::<CorrelationRow>(),
        Schema::of::<TwoBodiesRow>(),
        Schema::of::<GreenwoodTrippRow>(),
    ];
    schemas.extend(surface_rows::schemas());
    schemas
}

/// The tables of one comparison: curves, pairs, verdicts, differences and gaps always, all others where they have rows.
pub(crate) fn tables(results: &CompareResults) -> Vec<Table> {
    let asked = |table| of_asked_spots(table, &results.spots);
    let mut pairs = asked(Table::new(curves::pairs(results)));
    if !results.is_attributed() {
        pairs = pairs.without_part(CAUSES);
    }
    if results.reference.is_none() {
        pairs = pairs.without_part(REFERENCE);
    }
    let mut tables = vec![
        asked(Table::new(answers::rows(results))),
        Table::new(on_map::rows(results)),
        Table::new(verdicts::rows(results)),
        Table::new(cases::rows(results)),
        asked(Table::new(curves::curves(results))),
        pairs,
        Table::new(results::gaps(results)),
        Table::new(differences::rows(results)),
    ];
    let optional = [
        asked(Table::new(results::rows(results))),
        Table::new(spread::rows(results)),
        Table::new(attribution::rows(results)),
        Table::new(ranking::rows(results)),
        Table::new(standings::rows(results)),
        reference::table(results),
        Table::new(nearer::curves(results)),
        Table::new(nearer::rows(results)),
        Table::new(robustness::rows(results)),
        Table::new(layer::thresholds(results)),
        Table::new(layer::decreases(results)),
        Table::new(friction::rows(results)),
        Table::new(RuleRow::all(results)),
        Table::new(readings::rows(results)),
        Table::new(lines::rows(results)),
        Table::new(correlations::rows(results)),
        asked(Table::new(two_bodies(results))),
        Table::new(greenwood_tripp::rows(results)),
    ];
    tables.extend(optional.into_iter().filter(|table| table.rows() > 0));
    tables.extend(surface_rows::tables(results.surface_rows()));
    tables
}
