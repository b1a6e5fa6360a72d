//! The tables of several laws, besides those of a comparison.

use crate::kind::compare::rows;
use crate::kind::compare::tables::limits;
use crate::kind::laws::results::{LawsResults, SurfaceInfluence};
use asperity::compare::{AtLoad, Group, Kind, Measure};
use asperity::sphere::{Boundary, Point};
use asperity_framework::columns;
use asperity_framework::report::table::{Column, Row, Schema, Table};

/// A point of one asperity under one law.
struct LawRow<'a> {
    results: &'a LawsResults,
    law: &'a str,
    point: &'a Point,
}

impl Row for LawRow<'_> {
    const FILE: &'static str = "laws.csv";
    const ROWS: &'static str = "One row for each law and indentation of the single asperity.";
    const IS_LONG: bool = true;

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            law["text"] = row.law, "Contact law.";
            indentation_over_critical["1"] = row.point.indentation / row.results.critical.indentation, "Indentation over the critical indentation, at which yield begins.";
            indentation_m["m"] = row.point.indentation, "Indentation w (Eq. 1).";
            load_n["N"] = row.point.contact.load, "Load P of the asperity.";
            area_m2["m²"] = row.point.contact.area, "Real contact area A of the asperity.";
            load_over_critical["1"] = row.point.contact.load / row.results.critical.load, "Load over the load at the critical indentation.";
            area_over_critical["1"] = row.point.contact.area / row.results.critical.area, "Area over the area at the critical indentation.";
            mean_pressure_pa["Pa"] = row.point.contact.load / row.point.contact.area, "Mean contact pressure P/A.";
            stiffness_n_per_m["N/m"] = row.point.contact.stiffness, "Contact stiffness dP/dw within the regime.";
            regime["text"] = row.point.contact.regime.name(), "Regime: `elastic`, `elastic-plastic` or `plastic`.";
            beyond_small_strains["true/false"] = row.results.is_beyond_small_strains(&row.point.contact), "Whether the contact radius exceeds 0.3 of the asperity radius, beyond which strains are not small.";
        }
    }
}

/// A boundary between two formulas of a law.
struct BoundaryRow<'a> {
    results: &'a LawsResults,
    law: &'a str,
    boundary: &'a Boundary,
}

impl Row for BoundaryRow<'_> {
    const FILE: &'static str = "boundaries.csv";
    const ROWS: &'static str =
        "One row for each indentation at which a law changes from one formula to the next.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            law["text"] = row.law, "Contact law.";
            indentation_over_critical["1"] = row.boundary.indentation / row.results.critical.indentation, "Indentation of the boundary over the critical indentation, at which yield begins.";
            indentation_m["m"] = row.boundary.indentation, "Indentation w of the boundary.";
            regime_below["text"] = row.boundary.below.regime.name(), "Regime just below the boundary.";
            regime_above["text"] = row.boundary.above.regime.name(), "Regime just above the boundary.";
            load_below_n["N"] = row.boundary.below.load, "Load just below the boundary.";
            load_above_n["N"] = row.boundary.above.load, "Load just above the boundary.";
            area_below_m2["m²"] = row.boundary.below.area, "Real contact area just below the boundary.";
            area_above_m2["m²"] = row.boundary.above.area, "Real contact area just above the boundary.";
            load_jump["1", scale(1.0)] = row.boundary.load_jump(), "Jump of the load over the load below; 0 where it is continuous.";
            area_jump["1", scale(1.0)] = row.boundary.area_jump(), "Jump of the area over the area below; 0 where it is continuous.";
            beyond_small_strains["true/false"] = row.results.is_beyond_small_strains(&row.boundary.above), "Whether the contact radius exceeds 0.3 of the asperity radius, beyond which strains are not small.";
        }
    }
}

/// All laws and both models on a surface at one load, by one measure.
struct InfluenceRow<'a> {
    found: &'a SurfaceInfluence,
    measure: Measure,
    at: &'a AtLoad,
}

impl Row for InfluenceRow<'_> {
    const FILE: &'static str = "influence.csv";
    const ROWS: &'static str = "One row for each surface, realisation, measure and load: the range of the laws under each model, and the difference between the models under each law. Separations are compared by their difference, areas by their ratio.";

    fn columns() -> Vec<Column<Self>> {
        columns! { row: Self =>
            surface["text"] = row.found.surface.as_str(), "Name of the surface.";
            realisation["count"] = row.found.realisation, "Number of the realisation of the surface, from 1.";
            measure["text"] = row.measure.name(), "What is compared at equal load: `separation_over_sigma` or `area_ratio`.";
            pressure_pa["Pa"] = row.at.pressure, "Nominal pressure.";
            counts["true/false"] = row.at.exceeded.is_none(), "Whether the load is within the valid range under every law.";
            limits["text"] = limits(row.at.exceeded), "Limits of the valid range that are exceeded under some law, as in `curves.csv`.";
            fewest_contacts["1", scale(1.0)] = row.at.fewest_contacts, "Fewest effective contacts of the deterministic model under any law.";
            all_laws_statistical["1", scale(1.0)] = row.spread(Group::All, Kind::Statistical), "Highest over lowest of all laws under the statistical model.";
            all_laws_deterministic["1", scale(1.0)] = row.spread(Group::All, Kind::Deterministic), "Highest over lowest of all laws under the deterministic model.";
            passing_laws_statistical["1", scale(1.0)] = row.spread(Group::ElasticPlastic, Kind::Statistical), "Highest over lowest of the elastic-plastic laws, without the limits `hertz` and `fully-plastic`, under the statistical model.";
            passing_laws_deterministic["1", scale(1.0)] = row.spread(Group::ElasticPlastic, Kind::Deterministic), "Highest over lowest of the elastic-plastic laws under the deterministic model.";
            models_first_law["1", scale(1.0)] = row.compared(row.at.gap(row.measure, 0)), "Statistical over deterministic model under the first law.";
            passing_laws_models_most["1", scale(1.0)] = row.largest_gap().map(|(_, gap)| row.compared(gap)), "Statistical over deterministic model under the elastic-plastic law for which they differ most.";
            passing_laws_models_most_law["text"] = row.largest_gap().map(|(law, _)| row.found.influence.laws[law].as_str()), "The law of the previous column.";
            sampling_error["1", scale(1.0)] = row.at.sampling_error(row.measure, 0), "Standard error of the difference between the models under the first law, of an area relative to it.";
        }
    }
}

impl InfluenceRow<'_> {
    /// Separations are compared by their difference, areas by their ratio.
    fn compared(&self, difference: f64) -> f64 {
        match self.measure {
            Measure::Separation => difference,
            Measure::Area => difference.exp(),
        }
    }

    fn spread(&self, group: Group, kind: Kind) -> Option<f64> {
        self.at.spread(self.measure, group, kind).map(|spread| self.compared(spread))
    }

    /// The elastic-plastic law under which the models differ most.
    fn largest_gap(&self) -> Option<(usize, f64)> {
        self.at.largest_gap(self.measure, Group::ElasticPlastic)
    }
}

/// Those of a comparison, `laws.csv`, `boundaries.csv` and `influence.csv`.
pub(super) fn schemas() -> Vec<Schema> {
    let mut schemas = rows::schemas();
    schemas.extend([Schema::of::<LawRow>(), Schema::of::<BoundaryRow>(), Schema::of::<InfluenceRow>()]);
    schemas
}

/// The files of [`schemas`].
pub(super) fn tables(results: &LawsResults) -> Vec<Table> {
    let mut tables = rows::tables(&results.compare);
    tables.extend([
        Table::new(curves(results)),
        Table::new(boundaries(results)),
        Table::new(influences(results)),
    ]);
    tables
}

fn curves(results: &LawsResults) -> impl Iterator<Item = LawRow<'_>> {
    results.laws.iter().flat_map(move |law| {
        law.curve.points.iter().map(move |point| LawRow { results, law: &law.law, point })
    })
}

fn boundaries(results: &LawsResults) -> impl Iterator<Item = BoundaryRow<'_>> {
    results.laws.iter().flat_map(move |law| {
        law.boundaries.iter().map(move |boundary| BoundaryRow { results, law: &law.law, boundary })
    })
}

fn influences(results: &LawsResults) -> impl Iterator<Item = InfluenceRow<'_>> {
    results.influences.iter().flat_map(|found| {
        Measure::ALL.into_iter().flat_map(move |measure| {
            found.influence.loads.iter().map(move |at| InfluenceRow { found, measure, at })
        })
    })
}
