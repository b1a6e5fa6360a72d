//! The limit of admissible loads that binds, and what to do about it.

use asperity::study::Verdicts;
use asperity::{INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_contact_framework::report::format::{input_quantity, number, percent};

use super::lead::nominal_area;

/// What lies beyond a limit.
pub fn limit_words(limit: Limit) -> String {
    match limit {
        Limit::FewContacts => format!("fewer than {MIN_CONTACTS} effective contacts"),
        Limit::DominantContact => {
            format!("more than {} of the load in one contact", percent(LARGEST_LOAD_SHARE))
        }
        Limit::Interaction => format!("contact area above {}", percent(INTERACTION)),
        Limit::LargeStrain => {
            format!("more than {} of the load at a/R above 0.3", percent(LARGE_STRAIN_SHARE))
        }
    }
}

/// Why no load carries a verdict: the limit that binds, and its remedy.
pub fn none_admissible(verdicts: &Verdicts) -> String {
    let Some(limit) = verdicts.admissible.binding else { return "No load was compared.".to_owned() };
    let exceeds = |limit: Limit| {
        let loads =
            verdicts.differences.iter().filter(move |at| at.exceeded().limits().any(|one| one == limit));
        loads.map(|at| at.load)
    };
    let lowest = exceeds(limit).fold(f64::INFINITY, f64::min);
    let from = input_quantity(lowest, "Pa");
    let highest_contacts =
        verdicts.differences.iter().filter_map(|at| Some(at.sharing?.effective_contacts)).fold(0.0, f64::max);
    let why = match limit {
        Limit::FewContacts | Limit::DominantContact => {
            let area =
                verdicts.differences.iter().filter_map(|at| at.area_needed).fold(f64::INFINITY, f64::min);
            let remedy = if area.is_finite() {
                format!(
                    "a higher load, or a map of at least {} (now {})",
                    nominal_area(area, true),
                    nominal_area(verdicts.area, false)
                )
            } else {
                "a higher load or a larger surface".to_owned()
            };
            let contacts = number(highest_contacts);
            let few = match limit {
                Limit::FewContacts => {
                    format!("at most {contacts} effective contacts, below {MIN_CONTACTS}, carry the load")
                }
                _ => limit_words(limit),
            };
            format!("{few}. Remedy: {remedy}")
        }
        Limit::Interaction => format!(
            "{} from {from} on: neighbouring contacts interact. Remedy: lower loads, or boundary elements (`models`)",
            limit_words(limit)
        ),
        Limit::LargeStrain => format!(
            "a/R exceeds 0.3 from {from} on: contacts are not small against their asperities, and spheres are a poor model. Remedy: lower loads, or boundary elements (`models`)"
        ),
    };
    format!("No load is admissible: {why}.")
}
