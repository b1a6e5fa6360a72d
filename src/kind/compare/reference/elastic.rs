//! Where the reference stays elastic although the law yields, so that its distance from a model includes that of yielding.

use asperity::study::CaseResults;
use asperity_contact_framework::report::format::{listed, percent};

use super::ElasticCase;
use crate::kind::compare::results::CompareResults;
use crate::kind::compare::rows::SurfaceCase;

/// Where a smaller share of the load is in contacts that yield, an elastic reference stands for the law.
pub const SMALL_YIELDING: f64 = 0.01;

impl CompareResults {
    /// Why the reference of a case is elastic although its law yields; `None` where it is not, and where no reference was run.
    pub(crate) fn elastic_reference(&self, case: SurfaceCase) -> Option<&ElasticCase> {
        let CaseResults { law, thickness, reference, .. } = case.first();
        reference.as_ref()?;
        let elastic = &self.reference.as_ref()?.elastic;
        elastic.iter().find(|elastic| elastic.law == *law && elastic.thickness == *thickness)
    }

    /// A warning on all cases in which both models were compared with an elastic reference while contacts of the sum yielded.
    pub(crate) fn elastic_reference_note(&self) -> Option<String> {
        let yielding = |case: SurfaceCase| {
            self.elastic_reference(case)?;
            Some((case.first().law.clone(), yielding_share(case.first())?))
        };
        let cases: Vec<(String, f64)> = SurfaceCase::all(self)
            .filter_map(yielding)
            .filter(|(_, share)| *share >= SMALL_YIELDING)
            .collect();
        let largest = cases.iter().map(|(_, share)| *share).reduce(f64::max)?;
        let mut laws: Vec<String> = cases.into_iter().map(|(law, _)| law).collect();
        laws.sort();
        laws.dedup();
        Some(format!(
            "reference: it stays elastic although contacts yield under law {} (up to {} of the load in the sum); which model is nearer leaves yielding out",
            listed(&laws),
            percent(largest)
        ))
    }
}

/// The largest share of the load that contacts of the sum carry which are not elastic, over the loads of the reference; `None` where both
/// models were not run at one of these.
fn yielding_share(case: &CaseResults) -> Option<f64> {
    let at_load = case.comparison.pairs_at_load();
    let compared = at_load.filter(|pair| case.reference_of(pair).is_some());
    compared.filter_map(|pair| Some(1.0 - pair.deterministic.pressure.shares()?[0])).reduce(f64::max)
}
