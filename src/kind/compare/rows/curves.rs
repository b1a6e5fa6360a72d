//! The rows of `curves.csv` and `comparison.csv`.

use asperity::study::{CaseResults, RealisationFacts};

use crate::kind::compare::results::CompareResults;
use crate::model_tables::{AnyPoint, CurveRow, PairRow, RowCase, of_models};

/// The rows of `curves.csv`.
pub(super) fn curves(results: &CompareResults) -> impl Iterator<Item = CurveRow> {
    let reduced_modulus = results.contact.reduced_modulus;
    cases(results).flat_map(move |(case, _, found)| {
        let reference = found.reference.iter().flat_map(|curve| curve.points.iter().copied());
        let all = of_models(&found.comparison).chain(reference.map(AnyPoint::Reference));
        all.map(move |point| CurveRow { case: case.clone(), point, reduced_modulus })
    })
}

/// The rows of `comparison.csv`.
pub(super) fn pairs(results: &CompareResults) -> impl Iterator<Item = PairRow> {
    cases(results).flat_map(|(case, realisation, found)| {
        let (nominal_area, plasticity_index) = (realisation.nominal_area, found.plasticity_index);
        found.comparison.pairs.iter().map(move |&pair| PairRow {
            case: case.clone(),
            pair,
            nominal_area,
            plasticity_index,
            attribution: found.attribution_of(&pair).cloned(),
            reference: found.reference_of(&pair).copied(),
        })
    })
}

/// Every case of every realisation of every surface, in file order.
pub(super) fn cases(
    results: &CompareResults,
) -> impl Iterator<Item = (RowCase, &RealisationFacts, &CaseResults)> {
    results.surfaces.iter().flat_map(|surface| {
        surface.realisations.iter().enumerate().flat_map(move |(index, realisation)| {
            surface.cases.iter().map(move |case| {
                let results = &case.realisations[index];
                (RowCase::from_results(&surface.surface.name, index + 1, results), realisation, results)
            })
        })
    })
}
