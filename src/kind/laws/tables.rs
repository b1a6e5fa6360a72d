//! The tables of several laws, besides those of a comparison.

use crate::kind::compare::tables;
use crate::kind::laws::results::{LawsResults, SurfaceInfluence};
use asperity::compare::{AtLoad, Group, Influence, Kind, Measure};
use asperity::sphere::{Boundary, Point};
use asperity_framework::report::table::{Table, TableError};
use asperity_framework::row;

row! {
struct CurveRow {
    law: String,
    indentation_over_critical: f64,
    indentation_m: f64,
    load_n: f64,
    area_m2: f64,
    load_over_critical: f64,
    area_over_critical: f64,
    mean_pressure_pa: f64,
    stiffness_n_per_m: f64,
    regime: &'static str,
    beyond_small_strains: bool,
}
}

row! {
struct BoundaryRow {
    law: String,
    indentation_over_critical: f64,
    indentation_m: f64,
    regime_below: &'static str,
    regime_above: &'static str,
    load_below_n: f64,
    load_above_n: f64,
    area_below_m2: f64,
    area_above_m2: f64,
    load_jump: f64,
    area_jump: f64,
    beyond_small_strains: bool,
}
}

row! {
struct InfluenceRow {
    surface: String,
    realisation: usize,
    measure: &'static str,
    pressure_pa: f64,
    counts: bool,
    fewest_contacts: f64,
    all_laws_statistical: Option<f64>,
    all_laws_deterministic: Option<f64>,
    passing_laws_statistical: Option<f64>,
    passing_laws_deterministic: Option<f64>,
    models_first_law: f64,
    passing_laws_models_most: Option<f64>,
    passing_laws_models_most_law: Option<String>,
    sampling_error: Option<f64>,
}
}

/// `curves.csv` and `comparison.csv` as of a comparison, `laws.csv`, `boundaries.csv` and `influence.csv`.
///
/// # Errors
/// See [`TableError`].
pub fn tables(results: &LawsResults) -> Result<Vec<(&'static str, Vec<u8>)>, TableError> {
    Ok(vec![
        ("curves.csv", tables::curves(&results.compare)?),
        ("comparison.csv", tables::comparison(&results.compare)?),
        ("laws.csv", curves(results)?),
        ("boundaries.csv", boundaries(results)?),
        ("influence.csv", influences(results)?),
    ])
}

fn curves(results: &LawsResults) -> Result<Vec<u8>, TableError> {
    let critical = &results.critical;
    let mut table = Table::new(&[CurveRow::COLUMNS])?;
    for law in &results.laws {
        for Point { indentation, contact } in &law.curve.points {
            table.row(CurveRow {
                law: law.law.clone(),
                indentation_over_critical: indentation / critical.indentation,
                indentation_m: *indentation,
                load_n: contact.load,
                area_m2: contact.area,
                load_over_critical: contact.load / critical.load,
                area_over_critical: contact.area / critical.area,
                mean_pressure_pa: contact.load / contact.area,
                stiffness_n_per_m: contact.stiffness,
                regime: contact.regime.name(),
                beyond_small_strains: results.is_beyond_small_strains(contact),
            })?;
        }
    }
    table.bytes()
}

fn boundaries(results: &LawsResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[BoundaryRow::COLUMNS])?;
    for law in &results.laws {
        for at in &law.boundaries {
            let Boundary { indentation, below, above } = at;
            table.row(BoundaryRow {
                law: law.law.clone(),
                indentation_over_critical: indentation / results.critical.indentation,
                indentation_m: *indentation,
                regime_below: below.regime.name(),
                regime_above: above.regime.name(),
                load_below_n: below.load,
                load_above_n: above.load,
                area_below_m2: below.area,
                area_above_m2: above.area,
                load_jump: at.load_jump(),
                area_jump: at.area_jump(),
                beyond_small_strains: results.is_beyond_small_strains(above),
            })?;
        }
    }
    table.bytes()
}

fn influences(results: &LawsResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[InfluenceRow::COLUMNS])?;
    for found in &results.influences {
        for measure in Measure::ALL {
            for at in &found.influence.loads {
                table.row(InfluenceRow::new(found, &found.influence, at, measure))?;
            }
        }
    }
    table.bytes()
}

impl InfluenceRow {
    /// Separations as differences, areas as ratios; the sampling error of an area relative to it.
    fn new(found: &SurfaceInfluence, influence: &Influence, at: &AtLoad, measure: Measure) -> Self {
        let told = |difference: f64| match measure {
            Measure::Separation => difference,
            Measure::Area => difference.exp(),
        };
        let spread = |group, kind| at.spread(measure, group, kind).map(told);
        let most = at.largest_gap(measure, Group::Passing);
        let gap = at.gap(measure, 0);
        Self {
            surface: found.surface.clone(),
            realisation: found.realisation,
            measure: measure.name(),
            pressure_pa: at.pressure,
            counts: at.counts,
            fewest_contacts: at.fewest_contacts.round(),
            all_laws_statistical: spread(Group::All, Kind::Statistical),
            all_laws_deterministic: spread(Group::All, Kind::Deterministic),
            passing_laws_statistical: spread(Group::Passing, Kind::Statistical),
            passing_laws_deterministic: spread(Group::Passing, Kind::Deterministic),
            models_first_law: told(gap),
            passing_laws_models_most: most.map(|(_, gap)| told(gap)),
            passing_laws_models_most_law: most.map(|(law, _)| influence.laws[law].clone()),
            sampling_error: at.sampling_error(measure, 0),
        }
    }
}
