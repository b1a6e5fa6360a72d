//! The tables of a comparison besides curves and pairs; here those of its cases.

mod ranking;
mod reference;
mod results;
mod swept;
mod two_bodies;
mod verdicts;

use asperity::Limit;
use asperity::compare::{ComparedQuantity, OnMap, PointCounts, Spread};
use asperity::study::{Basis, CaseResults, CaseStudy, Verdicts};
use asperity_contact_framework::report::table::{Column, Schema, Table};
use asperity_contact_framework::{columns, rows};
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

use super::card::{CaseAnswer, Nearer};
use super::results::{CompareResults, SurfaceResults};
use crate::model_tables::{
    CAUSES, CurveRow, ELECTRICAL, FRICTION, PairRow, REFERENCE, THERMAL, limits, of_asked_spots,
};
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
        asked(Table::new(answers(results))),
        Table::new(on_map(results)),
        Table::new(verdicts::rows(results)),
        Table::new(rows(results)),
        asked(Table::new(results::curves(results))),
        pairs,
        Table::new(results::gaps(results)),
        Table::new(verdicts::differences(results)),
    ];
    let optional = [
        asked(Table::new(results::rows(results))),
        Table::new(spread(results)),
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

/// One surface under one law and thickness.
pub(crate) struct CaseRow<'a> {
    key: CaseKey<'a>,
    verdicts: &'a Verdicts,
    plasticity_index: Option<f64>,
    counts: PointCounts,
}

impl CaseRow<'_> {
    fn end(&self, end: fn(&[[f64; 2]]) -> Option<f64>) -> Option<f64> {
        end(&self.verdicts.admissible.stretches)
    }

    fn groups(&self) -> Option<usize> {
        match self.verdicts.basis {
            Basis::Realisations(count) | Basis::Blocks { count, .. } => Some(count),
            Basis::TooSmall { .. } | Basis::Unstated | Basis::Asperities | Basis::ModelBased => None,
        }
    }

    fn block(&self, value: fn([f64; 2], [f64; 2]) -> f64) -> Option<f64> {
        match self.verdicts.basis {
            Basis::Blocks { sides, lengths, .. } => Some(value(sides, lengths)),
            _ => None,
        }
    }
}

rows! { CaseRow<'_> => "cases.csv";
    "One row for each surface, law and layer thickness, over all realisations: the admissible loads, and what the intervals of the verdicts rest on.";
    ..case_columns(|row: &Self| row.key);
    row =>
    plasticity_index["1"] = row.plasticity_index, "Plasticity index (E*/H)(sigma/R)^0.5 of Greenwood and Williamson (1966); empty where nothing yields.";
    nominal_area_m2["m²", prefix("m")] = row.verdicts.area, "Nominal area of one realisation.";
    admissible_from_pa["Pa", prefix("M"), input] = row.end(|all| all.first().map(|loads| loads[0])), "Lowest nominal pressure at which both models are within their limits; empty where there is none.";
    admissible_to_pa["Pa", prefix("M"), label("to"), input] = row.end(|all| all.last().map(|loads| loads[1])), "Highest such pressure.";
    limits_below["text"] = limits(row.verdicts.admissible.below), "Limits that are exceeded at lower loads, as in `curves.csv`.";
    limits_above["text"] = limits(row.verdicts.admissible.above), "Limits that are exceeded at higher loads.";
    basis["text", label("intervals from")] = row.verdicts.basis.name(), "What the intervals rest on: `blocks` of a map or of a list with places, `realisations`, `independent` asperities, `model-based` (surfaces generated with the spectrum and heights of a map too small for blocks), or `none` of a map too small for blocks and of a list that is not said to be one of independent draws.";
    groups["count"] = row.groups(), "Number of blocks or realisations.";
    block_x_m["m"] = row.block(|sides, _| sides[0]), "Side of a block along x.";
    block_y_m["m"] = row.block(|sides, _| sides[1]), "Side of a block along y.";
    block_lengths["1"] = row.block(|_, lengths| lengths[0].min(lengths[1])), "Shorter side of a block over the correlation length, of the heights or, where it is longer, of the amplitude of the roughness.";
    error_over_independent["1"] = row.verdicts.over_independent, "Standard error of the separation's difference over that of independent asperities: the median over the admissible loads.";
    points["count"] = row.counts.points, "Points of the curves of the first realisation.";
    few_contacts["count"] = row.counts.beyond(Limit::FewContacts), "Of them with fewer than 30 effective contacts.";
    dominant_contact["count"] = row.counts.beyond(Limit::DominantContact), "Of them with more than 10 % of the load in one contact.";
    interaction["count"] = row.counts.beyond(Limit::Interaction), "Of them with an area ratio above 0.05.";
    large_strain["count"] = row.counts.beyond(Limit::LargeStrain), "Of them with more than 10 % of the load at large strains.";
    in_jump["count"] = row.counts.in_jump, "Points whose load lies in a jump of the law, so that `pressure_pa` exceeds `target`.";
    unpaired["count"] = row.counts.unpaired, "Deterministic pressures that one of the models does not reach above -10 sigma.";
}

fn rows(results: &CompareResults) -> impl Iterator<Item = CaseRow<'_>> {
    SurfaceCase::all(results).map(|case| CaseRow {
        key: case.key(),
        verdicts: case.verdicts(),
        plasticity_index: case.first().plasticity_index,
        counts: PointCounts::new(&case.first().comparison),
    })
}

pub(crate) struct AnswerRow<'a> {
    key: CaseKey<'a>,
    answer: CaseAnswer,
}

impl AnswerRow<'_> {
    fn answer(&self, place: usize) -> Option<&'static str> {
        self.answer.quantities[place].map(|(answer, _)| answer.name())
    }

    fn difference(&self, place: usize) -> Option<f64> {
        self.answer.quantities[place]?.1
    }
}

rows! { AnswerRow<'_> => "answers.csv", records "answers";
    "One row for each surface, law and layer thickness: may the integral replace the sum on such surfaces, over the admissible loads. `yes`: within what is accepted at all of them, surely or very likely; `no`: beyond it where that can be told; `yes/?`: within it where that can be told; `in part`: within at some and beyond at others; `?`: cannot be told; `outside`: no load is admissible; `unfit`: the map fails a fitness check.";
    ..case_columns(|row: &Self| row.key);
    row =>
    area["text", label("contact area"), verdict] = row.answer(0), "The answer for the real contact area.";
    area_difference["1", label("largest"), signed_percent] = row.difference(0), "The largest difference of the integral from the sum at admissible loads, relative; where it is beyond what is accepted, at such loads.";
    separation["text", verdict] = row.answer(1), "The answer for the separation.";
    separation_difference["1", label("largest (σ)"), signed, scale(1.0)] = row.difference(1), "The largest difference, in sigma.";
    stiffness["text", verdict] = row.answer(2), "The answer for the stiffness.";
    stiffness_difference["1", label("largest"), signed_percent] = row.difference(2), "The largest difference, relative.";
    electrical_conductance["text", part(ELECTRICAL), verdict] = row.answer(3), "The answer for the electrical conductance; there only where it is asked for.";
    electrical_conductance_difference["1", part(ELECTRICAL), label("largest"), signed_percent] = row.difference(3), "The largest difference, relative.";
    thermal_conductance["text", part(THERMAL), verdict] = row.answer(4), "The answer for the thermal conductance, likewise.";
    thermal_conductance_difference["1", part(THERMAL), label("largest"), signed_percent] = row.difference(4), "The largest difference, relative.";
    friction["text", part(FRICTION), verdict] = row.answer(5), "The answer for the coefficient of friction, likewise.";
    friction_difference["1", part(FRICTION), label("largest"), signed_percent] = row.difference(5), "The largest difference, relative.";
    why["text"] = row.answer.why.as_str(), "The cause of the largest difference that is beyond what is accepted, in area or else in the named quantity: the leading one; with `(here)` the largest on the compared surface.";
    use_instead["text", label("use")] = row.answer.instead.as_str(), "What to use at that load: `the integral`, a statistical model of `ranking.csv` within what is accepted, `the sum`, or `boundary elements`.";
    nearer["text", label("nearer to boundary elements")] = row.answer.nearer.map(Nearer::name), "Which model is nearer to boundary elements in contact area: `the sum` or `the integral` at some admissible loads and the other at none, `depends on load`: each at some, `?`: undecided at all; on the compared surface, of several realisations in their mean; empty where they were not run, no such load is admissible, or the map is not fit.";
}

pub fn answers(results: &CompareResults) -> impl Iterator<Item = AnswerRow<'_>> {
    SurfaceCase::all(results)
        .filter_map(|case| Some(AnswerRow { key: case.key(), answer: CaseAnswer::new(case)? }))
}

/// A stretch of load on the compared surface.
pub(crate) struct OnMapRow<'a> {
    key: CaseKey<'a>,
    on_map: &'a OnMap,
    is_fit: bool,
}

impl OnMapRow<'_> {
    fn reported(&self, contrast: f64) -> f64 {
        self.on_map.quantity.reported(contrast)
    }
}

rows! { OnMapRow<'_> => "on_map.csv";
    "One row for each surface, law, layer thickness, quantity and stretch of load at which the statistical model is within what is accepted on the compared surface itself, or beyond it. There the sum over its asperities is exact, and the difference needs no interval; what holds of other samples of the surface is in `verdicts.csv`. Over several realisations the mean difference counts.";
    ..case_columns(|row: &Self| row.key);
    row =>
    quantity["text"] = row.on_map.quantity.name(), "What is compared: `separation`, `area` (real contact area) or `stiffness`.";
    from_pa["Pa", prefix("M"), label("from"), input] = row.on_map.loads[0], "Lowest nominal pressure of the stretch.";
    to_pa["Pa", prefix("M"), label("to"), input] = row.on_map.loads[1], "Highest nominal pressure of the stretch.";
    on_map["text", label("on this map"), verdict] = row.on_map.name(), "Whether the difference on the compared surface is `within` what is accepted or `beyond` it at all loads of the stretch.";
    difference["1", label("largest difference"), signed, scale(1.0)] = row.reported(row.on_map.largest.1), "The largest difference in the stretch: of the separation in sigma, of area and stiffness relative to the sum.";
    at_pa["Pa", prefix("M"), label("at")] = row.on_map.largest.0, "Nominal pressure of the largest difference.";
    accepted["1"] = row.on_map.accepted, "The largest difference that is accepted.";
    limits["text", label("exceeds")] = limits(row.on_map.exceeded), "Limits of admissible loads that are exceeded in the stretch, as in `curves.csv`; empty where its loads are admissible.";
    fit["true/false", label("map fit")] = row.is_fit, "Whether the surface passes the fitness checks that block a verdict.";
}

fn on_map(results: &CompareResults) -> impl Iterator<Item = OnMapRow<'_>> {
    SurfaceCase::all(results).flat_map(|case| {
        let is_fit = !case.verdicts().is_blocked;
        case.verdicts().on_map.iter().map(move |on_map| OnMapRow { key: case.key(), on_map, is_fit })
    })
}

/// Both models at a load that all realisations have in common.
pub(crate) struct SpreadRow<'a> {
    key: CaseKey<'a>,
    spread: &'a Spread,
}

rows! { SpreadRow<'_> => "spread.csv";
    "One row for each surface, law, layer thickness and load of a surface with several realisations: means and standard deviations over them, at equal load.";
    ..case_columns(|row: &Self| row.key);
    row =>
    pressure_pa["Pa", prefix("M"), label("nominal pressure"), input] = row.spread.target, "Nominal pressure.";
    statistical_separation_over_sigma["1", label("d/σ, statistical")] = row.spread.statistical_separation.mean, "Statistical model: mean separation over sigma.";
    deterministic_separation_over_sigma["1", label("d/σ, deterministic")] = row.spread.deterministic_separation.mean, "Deterministic model: mean separation over sigma.";
    deterministic_separation_deviation["1", label("± s.d.")] = row.spread.deterministic_separation.deviation, "Its standard deviation over the realisations.";
    estimated_error["1"] = row.spread.sampling_error, "The sampling error of the separation estimated from a single sum, for independent asperities.";
    difference["1", label("difference (σ)"), signed, scale(1.0)] = row.spread.difference.mean, "Mean difference of the separations, in sigma.";
    difference_deviation["1", label("± s.d.")] = row.spread.difference.deviation, "Its standard deviation.";
    statistical_area_ratio["1", label("A/A_nom, statistical")] = row.spread.statistical_area.mean, "Statistical model: mean real contact area over nominal area.";
    deterministic_area_ratio["1", label("A/A_nom, deterministic")] = row.spread.deterministic_area.mean, "Deterministic model: the same.";
    deterministic_area_deviation["1", label("± s.d.")] = row.spread.deterministic_area.deviation, "Its standard deviation.";
}

fn spread(results: &CompareResults) -> impl Iterator<Item = SpreadRow<'_>> {
    SurfaceCase::all(results)
        .flat_map(|case| case.case.spread.iter().map(move |spread| SpreadRow { key: case.key(), spread }))
}
