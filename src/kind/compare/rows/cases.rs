//! `cases.csv`: what the verdicts on a case rest on.

use asperity::Limit;
use asperity::compare::PointCounts;
use asperity::study::{Basis, Verdicts};
use asperity_contact_framework::columns;
use asperity_contact_framework::report::table::{Column, Row};

use super::{CaseKey, SurfaceCase, case_columns};
use crate::kind::compare::results::CompareResults;
use crate::model_tables::limits;

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

impl Row for CaseRow<'_> {
    const FILE: &'static str = "cases.csv";
    const ROWS: &'static str = "One row for each surface, law and layer thickness, over all realisations: the admissible loads, and what the intervals of the verdicts rest on.";

    fn columns() -> Vec<Column<Self>> {
        let mut columns = case_columns(|row: &Self| row.key);
        columns.extend(columns! { row: Self =>
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
        });
        columns
    }
}

pub(super) fn rows(results: &CompareResults) -> impl Iterator<Item = CaseRow<'_>> {
    SurfaceCase::all(results).map(|case| CaseRow {
        key: case.key(),
        verdicts: case.verdicts(),
        plasticity_index: case.first().plasticity_index,
        counts: PointCounts::new(&case.first().comparison),
    })
}
