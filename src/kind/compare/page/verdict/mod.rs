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

pub use headline::{headline, over_cases};
pub use nearer::{misses, nearer, nearer_sentence};
pub use overview::{Case, Overview};
pub use range::{accepted_line, basis_line, limit_words, range_line, stiffness_line};
pub use table::{by_case, stretches};
pub use words::{loads, name, signed, verdict};

#[cfg(test)]
pub mod examples {
    //! Verdicts for tests of the sentences.

    use asperity::LoadSharing;
    use asperity::compare::{Accepted, Difference, Estimate, Stretch, ValidRange};

    use crate::kind::compare::findings::{Basis, Verdicts};

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
            differences,
        }
    }
}
