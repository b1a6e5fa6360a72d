//! Verdicts in words: headline, table, valid range, and what the intervals rest on.
//!
//! | module | what it writes |
//! |---|---|
//! | `headline` | the answer in one sentence |
//! | `table` | the verdicts, one row per stretch of load; one row per thickness or law |
//! | `range` | the valid range, what is accepted, and what the intervals rest on |
//! | `nearer` | both models against the reference |
//! | `overview` | the same over all surfaces, laws and thicknesses |
//! | `words` | differences, loads and needs |

mod headline;
mod nearer;
mod overview;
mod range;
mod table;
mod words;

pub use headline::{headline, over_all_cases, over_cases, verdict_alone};
pub use nearer::{misses, nearer, nearer_sentence};
pub use overview::{Case, Overview};
pub use range::{accepted_line, basis_line, limit_words, range_line, stiffness_line};
pub use table::{by_case, stretches, would_tell};
pub use words::{distance, loads, name, over, signed, verdict};

#[cfg(test)]
pub mod examples {
    //! Verdicts for tests of the sentences.

    use asperity::LoadSharing;
    use asperity::compare::{
        Accepted, AgainstReference, Difference, Estimate, NearerStretch, Stretch, ValidRange,
    };

    use crate::kind::compare::findings::{Basis, ReferenceVerdicts, Verdicts};

    /// What is accepted by default.
    pub const ACCEPTED: Accepted = Accepted { separation: 0.1, area: 0.1, stiffness: 0.2 };

    /// One load of `contacts` effective contacts: contrasts and standard errors of separation, area and stiffness.
    pub fn at(load: f64, contacts: f64, estimates: [(f64, Option<f64>); 3]) -> Difference {
        let estimate = |(contrast, error)| {
            Some(Estimate { contrast, error, quantile: 2.0, bound: 0.0, independent_error: error })
        };
        Difference {
            load,
            sharing: Some(LoadSharing {
                effective_contacts: contacts,
                largest_share: 0.01,
                large_strain_share: 0.0,
            }),
            area_ratio: 0.01,
            estimates: estimates.map(estimate),
            area_needed: estimates[0].1.is_none().then_some(4e-6),
        }
    }

    /// The verdicts on these loads of a surface of 1 mm².
    pub fn verdicts(differences: Vec<Difference>, basis: Basis) -> Verdicts {
        Verdicts {
            accepted: ACCEPTED,
            valid: ValidRange::of(differences.iter().map(|at| (at.load, at.exceeded()))),
            stretches: Stretch::all(&differences, &ACCEPTED),
            basis,
            over_independent: Some(1.5),
            area: 1e-6,
            is_blocked: false,
            reference: None,
            attribution: Vec::new(),
            differences,
        }
    }
    /// The verdicts of two models that agree, whose contrasts (separation, area) over the reference are given, at 1 and 10 MPa,
    /// with or without intervals.
    pub fn against_reference(
        statistical: [f64; 2],
        sum: [f64; 2],
        error: Option<f64>,
        basis: Basis,
    ) -> Verdicts {
        let loads = [1e6, 1e7];
        let differences = |contrasts: [f64; 2]| -> Vec<Difference> {
            let of = |load| at(load, 90.0, [(contrasts[0], error), (contrasts[1], error), (0.0, error)]);
            loads
                .map(of)
                .map(|one| Difference { estimates: [one.estimates[0], one.estimates[1], None], ..one })
                .to_vec()
        };
        let nearness = [0, 1].map(|k| statistical[k].abs() - sum[k].abs());
        let against = AgainstReference {
            models: [differences(statistical), differences(sum)],
            nearness: differences(nearness),
        };
        let mut all = verdicts(differences([0.0; 2]), basis);
        let nearer = NearerStretch::all(&against, &all.accepted);
        all.reference = Some(ReferenceVerdicts {
            stretches: [Vec::new(), Vec::new()],
            nearer,
            against,
            yields: false,
            is_layered: false,
        });
        all
    }
}
