//! The tables: pure writers, results to bytes. Columns are the contract of DESIGN section 5.

use asperity_framework::report::table::{Table, TableError};
use asperity_framework::row;
use serde::Serialize;

use crate::kind::compare::answers::CaseResults;
use crate::kind::compare::results::CompareResults;

use asperity::compare::{CurvePoint, Pair};
use asperity::model::Response;

/// What a row belongs to.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Case {
    surface: String,
    /// From 1; a given or measured surface is its own only realisation.
    realisation: usize,
    law: String,
    /// Empty where no layer is asked for.
    layer_thickness_m: Option<f64>,
}

impl Case {
    pub(crate) fn bare(surface: &str, realisation: usize, law: &str) -> Self {
        Self { surface: surface.to_owned(), realisation, law: law.to_owned(), layer_thickness_m: None }
    }

    pub(crate) fn of(surface: &str, realisation: usize, case: &CaseResults) -> Self {
        Self { layer_thickness_m: case.thickness, ..Self::bare(surface, realisation, &case.law) }
    }
}

row! {
struct CurveRow {
    model: &'static str,
    control: &'static str,
    target: f64,
    separation_m: f64,
    separation_over_sigma: f64,
    pressure_pa: f64,
    load_ratio: f64,
    area_ratio: f64,
    contact_density_per_m2: f64,
    mean_real_pressure_pa: Option<f64>,
    stiffness_pa_per_m: f64,
    elastic_load_share: Option<f64>,
    elastic_plastic_load_share: Option<f64>,
    plastic_load_share: Option<f64>,
    elastic_area_share: Option<f64>,
    elastic_plastic_area_share: Option<f64>,
    plastic_area_share: Option<f64>,
    pressure_standard_error_pa: Option<f64>,
    area_ratio_standard_error: Option<f64>,
    beyond_model: bool,
}
}

impl CurveRow {
    pub(crate) fn new(point: &CurvePoint, reduced_modulus: f64) -> Self {
        let response = &point.response;
        let [elastic_load_share, elastic_plastic_load_share, plastic_load_share] =
            parts(response.pressure.shares());
        let [elastic_area_share, elastic_plastic_area_share, plastic_area_share] =
            parts(response.area_ratio.shares());
        let pressure_pa = response.pressure.total();
        Self {
            model: point.kind.name(),
            control: point.control.name(),
            target: point.target,
            separation_m: response.separation,
            separation_over_sigma: response.separation_over_sigma,
            pressure_pa,
            load_ratio: pressure_pa / reduced_modulus,
            area_ratio: response.area_ratio.total(),
            contact_density_per_m2: response.contact_density,
            mean_real_pressure_pa: response.mean_real_pressure(),
            stiffness_pa_per_m: response.stiffness,
            elastic_load_share,
            elastic_plastic_load_share,
            plastic_load_share,
            elastic_area_share,
            elastic_plastic_area_share,
            plastic_area_share,
            pressure_standard_error_pa: response.sampling.map(|error| error.pressure),
            area_ratio_standard_error: response.sampling.map(|error| error.area_ratio),
            beyond_model: response.is_beyond_model(),
        }
    }
}

fn parts(shares: Option<[f64; 3]>) -> [Option<f64>; 3] {
    shares.map_or([None; 3], |shares| shares.map(Some))
}

row! {
struct PairRow {
    pairing: &'static str,
    target: f64,
    statistical_separation_over_sigma: f64,
    deterministic_separation_over_sigma: f64,
    difference_separation_over_sigma: f64,
    statistical_area_ratio: f64,
    deterministic_area_ratio: f64,
    difference_area_ratio: f64,
    statistical_contact_density_per_m2: f64,
    deterministic_contact_density_per_m2: f64,
    difference_contact_density_per_m2: f64,
    statistical_mean_real_pressure_pa: Option<f64>,
    deterministic_mean_real_pressure_pa: Option<f64>,
    difference_mean_real_pressure_pa: Option<f64>,
    statistical_pressure_pa: f64,
    deterministic_pressure_pa: f64,
    difference_pressure_pa: f64,
    statistical_stiffness_pa_per_m: f64,
    deterministic_stiffness_pa_per_m: f64,
    difference_stiffness_pa_per_m: f64,
    statistical_contacts: f64,
    deterministic_contacts: f64,
    difference_contacts: f64,
    plasticity_index: Option<f64>,
    beyond_model: bool,
}
}

impl PairRow {
    pub(crate) fn new(pair: &Pair, nominal_area: f64, plasticity_index: Option<f64>) -> Self {
        let (s, d) = (&pair.statistical, &pair.deterministic);
        let of = |value: fn(&Response) -> f64| (value(s), value(d), value(s) - value(d));
        let separation = of(|r| r.separation_over_sigma);
        let area = of(|r| r.area_ratio.total());
        let contacts = of(|r| r.contact_density);
        // The sum's are a count: the rounding of the density goes.
        let (statistical_contacts, deterministic_contacts) =
            (contacts.0 * nominal_area, (contacts.1 * nominal_area).round());
        let real = (s.mean_real_pressure(), d.mean_real_pressure());
        let pressure = of(|r| r.pressure.total());
        let stiffness = of(|r| r.stiffness);
        Self {
            pairing: pair.pairing.name(),
            target: pair.target,
            statistical_separation_over_sigma: separation.0,
            deterministic_separation_over_sigma: separation.1,
            difference_separation_over_sigma: separation.2,
            statistical_area_ratio: area.0,
            deterministic_area_ratio: area.1,
            difference_area_ratio: area.2,
            statistical_contact_density_per_m2: contacts.0,
            deterministic_contact_density_per_m2: contacts.1,
            difference_contact_density_per_m2: contacts.2,
            statistical_mean_real_pressure_pa: real.0,
            deterministic_mean_real_pressure_pa: real.1,
            difference_mean_real_pressure_pa: real.0.zip(real.1).map(|(s, d)| s - d),
            statistical_pressure_pa: pressure.0,
            deterministic_pressure_pa: pressure.1,
            difference_pressure_pa: pressure.2,
            statistical_stiffness_pa_per_m: stiffness.0,
            deterministic_stiffness_pa_per_m: stiffness.1,
            difference_stiffness_pa_per_m: stiffness.2,
            statistical_contacts,
            deterministic_contacts,
            difference_contacts: statistical_contacts - deterministic_contacts,
            plasticity_index,
            beyond_model: pair.is_beyond_model(),
        }
    }
}

/// The columns that say what a row belongs to.
pub(crate) const CASE: &[&str] = &["surface", "realisation", "law", "layer_thickness_m"];

/// `curves.csv` of a comparison.
///
/// # Errors
/// See [`TableError`]; the same holds for every table here.
pub fn curves(results: &CompareResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[CASE, CurveRow::COLUMNS])?;
    for found in &results.surfaces {
        for (realisation, answered) in found.realisations() {
            for case in &answered.cases {
                let of = Case::of(&found.surface.name, realisation, case);
                for point in &case.comparison.curves {
                    table.row((&of, CurveRow::new(point, results.contact.reduced_modulus)))?;
                }
            }
        }
    }
    table.bytes()
}

/// `comparison.csv` of a comparison.
///
/// # Errors
/// See [`curves`].
pub fn comparison(results: &CompareResults) -> Result<Vec<u8>, TableError> {
    let mut table = Table::new(&[CASE, PairRow::COLUMNS])?;
    for found in &results.surfaces {
        for (realisation, answered) in found.realisations() {
            for case in &answered.cases {
                let of = Case::of(&found.surface.name, realisation, case);
                for pair in &case.comparison.pairs {
                    table.row((&of, PairRow::new(pair, answered.nominal_area, case.plasticity_index)))?;
                }
            }
        }
    }
    table.bytes()
}
