//! Verdicts and cards to test sentences with.

use asperity::compare::{
    Accepted, AdmissibleRange, AgainstReference, Comparison, Difference, Estimate, Gaps, OnMap, Stretch,
    Support,
};
use asperity::study::{Basis, CaseResults, CaseStudy, Verdicts};
use asperity::surface::Surface;
use asperity::{AsperitySet, LoadSharing, Statistics};

use super::Card;

/// Verdicts on a surface of 1 mm² from contrasts and standard errors of the area at 1 and 10 MPa.
pub fn verdicts(contacts: f64, contrasts: [f64; 2], error: Option<f64>) -> Verdicts {
    let accepted = Accepted::DEFAULT;
    let at_load = |(load, contrast)| Difference {
        load,
        sharing: Some(LoadSharing {
            effective_contacts: contacts,
            largest_share: 0.01,
            large_strain_share: 0.0,
        }),
        area_ratio: 0.01,
        estimates: [None, Some(estimate(contrast, error)), None, None, None, None],
        of_models: [None; 2],
        area_needed: error.is_none().then_some(4e-6),
    };
    let differences: Vec<Difference> = [1e6, 1e7].into_iter().zip(contrasts).map(at_load).collect();
    Verdicts {
        stretches: Stretch::all(&differences, &accepted),
        on_map: OnMap::all(&differences, &accepted),
        admissible: AdmissibleRange::new(differences.iter().map(|at| (at.load, at.exceeded()))),
        differences,
        attribution: Vec::new(),
        accepted,
        basis: Basis::Asperities,
        over_independent: None,
        area: 1e-6,
        shifts: 1,
        is_blocked: false,
        reference: None,
    }
}

pub fn estimate(contrast: f64, error: Option<f64>) -> Estimate {
    Estimate {
        contrast,
        error,
        quantile: 2.0,
        bound: 0.0,
        independent_error: error,
        support: Support::Sampled,
    }
}

/// What a card of these verdicts says, of a set of asperities whose high ones are sharper.
pub fn with_card<T>(verdicts: Verdicts, read: impl FnOnce(&Card, &Difference) -> T) -> T {
    with_case(verdicts, |_| (), read)
}

/// The same after a change to the case.
pub fn with_case<T>(
    verdicts: Verdicts,
    change: impl FnOnce(&mut CaseStudy),
    read: impl FnOnce(&Card, &Difference) -> T,
) -> T {
    let set = AsperitySet::new(vec![0.0, 1e-6, 2e-6], vec![3e-6, 2e-6, 1e-6], 1e-6).unwrap();
    let statistics = Statistics::new(&set);
    let surface = Surface::new("a", set, statistics);
    let results = CaseResults {
        law: "zmc".to_owned(),
        yields: true,
        thickness: None,
        plasticity_index: None,
        comparison: Comparison::default(),
        gaps: Gaps::default(),
        differences: Vec::new(),
        not_modelled: None,
        attribution: Vec::new(),
        reference: None,
        against_reference: AgainstReference::default(),
    };
    let mut case = CaseStudy {
        greenwood_tripp: Vec::new(),
        realisations: vec![results],
        spread: Vec::new(),
        verdicts,
        ranking: None,
        shortcuts: Vec::new(),
        treated: Vec::new(),
        dependences: Vec::new(),
    };
    change(&mut case);
    let card = Card {
        case: &case,
        surface: &surface,
        load_area: 1e-6,
        undivided: None,
        has_medium: false,
        correlations: Ok(Vec::new()),
    };
    read(&card, &case.verdicts.differences[0])
}
