//! The tables of a comparison besides curves and pairs: a type of rows in each file.

mod cases;
mod layer;
mod lines;
mod nearer;
mod readings;
mod results;
mod robustness;
mod spread;
mod standings;
mod verdicts;

pub(crate) use cases::CaseRow;
pub(crate) use layer::{DecreaseRow, RuleRow, ThresholdRow};
pub(crate) use lines::LineRow;
pub(crate) use nearer::{NearerRow, ReferenceCurveRow};
pub(crate) use readings::ReadingRow;
pub(crate) use results::{GapRow, ResultRow, is_single};
pub(crate) use robustness::RobustnessRow;
pub(crate) use spread::SpreadRow;
pub(crate) use standings::StandingRow;
pub(crate) use verdicts::VerdictRow;

use asperity_framework::columns;
use asperity_framework::report::table::{Column, Schema, Table};

use super::answers::CaseResults;
use super::attribution::tables::AttributionRow;
use super::differences::DifferenceRow;
use super::findings::CaseFindings;
use super::ranking::Ranking;
use super::ranking::tables::RankingRow;
use super::reference::tables::ReferenceRow;
use super::results::{CompareResults, SurfaceResults};
use super::robustness::Dependence;
use super::tables::{CAUSES, CurveRow, PairRow, REFERENCE};

/// One surface under one law and layer thickness, with all that is known of it.
#[derive(Clone, Copy)]
pub(crate) struct StudiedCase<'a> {
    /// Its surface.
    pub(crate) surface: &'a SurfaceResults,
    /// Its place among the cases of the surface.
    pub(crate) index: usize,
    /// Results on the first realisation.
    pub(crate) first: &'a CaseResults,
    /// Findings over all realisations.
    pub(crate) findings: &'a CaseFindings,
}

impl<'a> StudiedCase<'a> {
    /// All cases, surface by surface.
    pub(crate) fn all(results: &'a CompareResults) -> impl Iterator<Item = Self> + Clone {
        results.surfaces.iter().flat_map(Self::of_surface)
    }

    /// The cases of one surface.
    pub(crate) fn of_surface(surface: &'a SurfaceResults) -> impl Iterator<Item = Self> + Clone {
        let cases = surface.first.cases.iter().zip(&surface.findings.cases).enumerate();
        cases.map(move |(index, (first, findings))| Self { surface, index, first, findings })
    }

    /// The same case on every realisation.
    pub(crate) fn realisations(&self) -> impl Iterator<Item = &'a CaseResults> + use<'a> {
        let index = self.index;
        self.surface.realisations().map(move |(_, realisation)| &realisation.cases[index])
    }

    /// The other statistical models, where they were ranked.
    pub(crate) fn ranking(&self) -> Option<&'a Ranking> {
        self.surface.rankings.get(self.index).filter(|ranking| !ranking.models.is_empty())
    }

    /// The choices in the analysis of the map that decide a verdict.
    pub(crate) fn dependences(&self) -> &'a [Dependence] {
        let robustness = self.surface.robustness.as_ref();
        robustness.and_then(|robustness| robustness.dependences.get(self.index)).map_or(&[], Vec::as_slice)
    }

    /// What it is called in tables.
    pub(crate) fn key(&self) -> CaseKey<'a> {
        CaseKey { surface: &self.surface.surface.name, law: &self.first.law, thickness: self.first.thickness }
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
        layer_thickness_m["m", label("layer"), thickness] = key(row).thickness, "Thickness of the layer, 0 for the bare substrate and inf for a flat of the layer's material; empty where the spec has no layer.";
    }
}

/// The tables of a comparison.
pub(crate) fn schemas() -> Vec<Schema> {
    vec![
        Schema::of::<VerdictRow>(),
        Schema::of::<CaseRow>(),
        Schema::of::<ResultRow>(),
        Schema::of::<CurveRow>(),
        Schema::of::<PairRow>(),
        Schema::of::<GapRow>(),
        Schema::of::<SpreadRow>(),
        Schema::of::<DifferenceRow>(),
        Schema::of::<AttributionRow>(),
        Schema::of::<RankingRow>(),
        Schema::of::<StandingRow>(),
        Schema::of::<ReferenceRow>(),
        Schema::of::<ReferenceCurveRow>(),
        Schema::of::<NearerRow>(),
        Schema::of::<RobustnessRow>(),
        Schema::of::<ThresholdRow>(),
        Schema::of::<DecreaseRow>(),
        Schema::of::<RuleRow>(),
        Schema::of::<ReadingRow>(),
        Schema::of::<LineRow>(),
    ]
}

/// The tables of one comparison: curves, pairs, verdicts, differences and gaps always, all others where they have rows.
pub(crate) fn tables(results: &CompareResults) -> Vec<Table> {
    let mut pairs = Table::new(super::tables::comparison(results));
    if !results.is_attributed() {
        pairs = pairs.without_part(CAUSES);
    }
    if results.reference.is_none() {
        pairs = pairs.without_part(REFERENCE);
    }
    let mut tables = vec![
        Table::new(verdicts::rows(results)),
        Table::new(cases::rows(results)),
        Table::new(super::tables::curves(results)),
        pairs,
        Table::new(results::gaps(results)),
        Table::new(super::differences::rows(results)),
    ];
    let optional = [
        Table::new(results::rows(results)),
        Table::new(spread::rows(results)),
        Table::new(super::attribution::tables::rows(results)),
        Table::new(super::ranking::tables::rows(results)),
        Table::new(standings::rows(results)),
        Table::new(super::reference::tables::rows(results)),
        Table::new(nearer::curves(results)),
        Table::new(nearer::rows(results)),
        Table::new(robustness::rows(results)),
        Table::new(layer::thresholds(results)),
        Table::new(layer::decreases(results)),
        Table::new(RuleRow::all(results)),
        Table::new(readings::rows(results)),
        Table::new(lines::rows(results)),
    ];
    tables.extend(optional.into_iter().filter(|table| table.rows() > 0));
    tables
}
