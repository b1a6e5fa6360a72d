//! Verdicts to test sentences with.

use asperity::LoadSharing;
use asperity::compare::{Accepted, AdmissibleRange, Difference, Estimate, OnMap, Stretch, Support};
use asperity::study::{Basis, Verdicts};

/// Verdicts on a surface of 1 mm² from contrasts and standard errors of the area at 1 and 10 MPa.
pub fn verdicts(contacts: f64, contrasts: [f64; 2], error: Option<f64>) -> Verdicts {
    let accepted = Accepted { separation: 0.1, area: 0.1, stiffness: 0.2 };
    let at_load = |(load, contrast)| Difference {
        load,
        sharing: Some(LoadSharing {
            effective_contacts: contacts,
            largest_share: 0.01,
            large_strain_share: 0.0,
        }),
        area_ratio: 0.01,
        estimates: [
            None,
            Some(Estimate {
                contrast,
                error,
                quantile: 2.0,
                bound: 0.0,
                independent_error: error,
                support: Support::Sampled,
            }),
            None,
        ],
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
        is_blocked: false,
        reference: None,
    }
}
