//! The limit of admissible loads that binds, and what to do about it.

use asperity::compare::Difference;
use asperity::study::Verdicts;
use asperity::{INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_contact_framework::report::format::percent;

use super::lead::{nominal_area, over};

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

/// Why no load carries a verdict: the limit that binds, where it is exceeded, and its remedy.
pub fn none_admissible(verdicts: &Verdicts) -> String {
    let Some(limit) = verdicts.admissible.binding else { return "No load was compared.".to_owned() };
    let exceeds = |at: &&Difference| at.exceeded().limits().any(|one| one == limit);
    let beyond: Vec<&Difference> = verdicts.differences.iter().filter(exceeds).collect();
    let lowest = beyond.iter().map(|at| at.load).fold(f64::INFINITY, f64::min);
    let highest = beyond.iter().map(|at| at.load).fold(0.0, f64::max);
    let remedy = match limit {
        Limit::FewContacts | Limit::DominantContact => {
            // Of loads at which more contacts are all that is missing.
            let is_few =
                |one| matches!(one, Limit::FewContacts | Limit::DominantContact);
            let few = beyond.iter().filter(|at| at.exceeded().limits().all(is_few));
            let area = few.filter_map(|at| at.area_needed).fold(f64::INFINITY, f64::min);
            if area.is_finite() {
                let [area, now] = [nominal_area(area, true), nominal_area(verdicts.area, false)];
                format!("a higher load, or a map of at least {area} (now {now})")
            } else {
                "a higher load, or a larger surface".to_owned()
            }
        }
        Limit::Interaction => "lower loads, or boundary elements (`models`): neighbouring contacts interact".to_owned(),
        Limit::LargeStrain => {
            "lower loads, or boundary elements (`models`): contacts are not small against their asperities, of which spheres are a poor model"
                .to_owned()
        }
    };
    format!("No load is admissible: {} {}. Remedy: {remedy}.", limit_words(limit), over([lowest, highest]))
}
