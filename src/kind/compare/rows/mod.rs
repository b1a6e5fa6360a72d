//! The tables of a comparison besides curves and pairs: a type of rows in each file.

mod cases;
mod ranking;
mod reference;
mod results;
mod swept;
mod two_bodies;
mod verdicts;

use asperity::compare::ComparedQuantity;
use asperity::study::{CaseResults, CaseStudy, Verdicts};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Schema, Table};
pub(crate) use cases::{AnswerRow, CaseRow, OnMapRow, SpreadRow, answers};
use ranking::RankingRow;
pub(crate) use ranking::{RobustnessRow, StandingRow, words as treatment_words};
use reference::ReferenceRow;
pub(crate) use reference::{CorrelationRow, NearerRow, ReferenceCurveRow};
pub(crate) use results::{GapRow, LineRow, ReadingRow, ResultRow};
pub(crate) use swept::{
    DecreaseRow, FrictionRow, RuleRow, SweptRow, ThresholdRow, rows as swept, swept_name,
};
pub(crate) use two_bodies::{GreenwoodTrippRow, Simplification, TwoBodiesRow, rows as two_bodies};
use verdicts::DifferenceRow;
pub(crate) use verdicts::{AttributionRow, VerdictRow};

use super::results::{CompareResults, SurfaceResults};
use crate::model_tables::{CAUSES, CurveRow, PairRow, REFERENCE, of_asked_spots};
use crate::surface::rows as surface_rows;

#[derive(Clone, Copy)]
pub(crate) struct SurfaceCase<'a> {
    pub(crate) surface: &'a SurfaceResults,
    pub(crate) case: &'a CaseStudy,
}

impl<'a> SurfaceCase<'a> {
    pub(crate) fn all(results: &'a CompareResults) -> impl Iterator<Item = Self> + Clone {
        results.surfaces.iter().flat_map(Self::on_surface)
    }

    pub(crate) fn on_surface(surface: &'a SurfaceResults) -> impl Iterator<Item = Self> + Clone {
        surface.cases.iter().map(move |case| Self { surface, case })
    }

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
    let mut pairs = asked(Table::new(results::pairs(results)));
    if !results.is_attributed() {
        pairs = pairs.without_part(CAUSES);
    }
    if results.reference.is_none() {
        pairs = pairs.without_part(REFERENCE);
    }
    let mut tables = vec![
        asked(Table::new(cases::answers(results))),
        Table::new(cases::on_map(results)),
        Table::new(verdicts::rows(results)),
        Table::new(cases::rows(results)),
        asked(Table::new(results::curves(results))),
        pairs,
        Table::new(results::gaps(results)),
        Table::new(verdicts::differences(results)),
    ];
    let optional = [
        asked(Table::new(results::rows(results))),
        Table::new(cases::spread(results)),
        Table::new(verdicts::attribution(results)),
        Table::new(ranking::rows(results)),
        Table::new(ranking::standings(results)),
        reference::table(results),
        Table::new(reference::curves(results)),
        Table::new(reference::nearer(results)),
        Table::new(ranking::robustness(results)),
        Table::new(swept::thresholds(results)),
        Table::new(swept::decreases(results)),
        Table::new(swept::friction(results)),
        Table::new(RuleRow::all(results)),
        Table::new(results::readings(results)),
        Table::new(results::lines(results)),
        Table::new(reference::correlations(results)),
        asked(Table::new(two_bodies(results))),
        Table::new(two_bodies::greenwood_tripp(results)),
    ];
    tables.extend(optional.into_iter().filter(|table| table.rows() > 0));
    tables.extend(surface_rows::tables(results.surface_rows()));
    tables
}
