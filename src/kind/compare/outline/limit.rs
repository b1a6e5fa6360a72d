//! Why a load is not admissible, and what to do about it.

use asperity::compare::{AdmissibleRange, Difference};
use asperity::study::{CaseStudy, Treatment, Verdicts};
use asperity::{Exceeded, INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_contact_framework::report::format::{input_quantity, listed, number, percent};

use super::lead::{nominal_area, over};

/// What lies beyond a limit.
pub fn limit_words(limit: Limit) -> String {
    match limit {
        Limit::FewContacts => format!("fewer than {MIN_CONTACTS} effective contacts"),
        Limit::DominantContact => {
            format!("more than {} of the load in one contact", percent(LARGEST_LOAD_SHARE))
        }
        Limit::Interaction => format!("contact area of either model above {}", percent(INTERACTION)),
        Limit::LargeStrain => {
            format!("more than {} of the load at a/R above 0.3", percent(LARGE_STRAIN_SHARE))
        }
    }
}

/// Of a load at which limits are exceeded: which, and the remedy; where contacts are too few a larger surface, else neither model is for it.
pub fn not_admissible(case: &CaseStudy, at: &Difference) -> String {
    let verdicts = &case.verdicts;
    let none = verdicts.admissible.stretches.is_empty() && verdicts.differences.len() > 1;
    let exceeded = at.exceeded();
    let limits: Vec<String> = exceeded.limits().map(|limit| beyond(limit, at)).collect();
    let limits = listed(&limits);
    if exceeded.limits().all(is_of_few) {
        let which = if none { "no compared load is" } else { "this load is not" };
        let more = more_surface(at, verdicts, exceeded);
        return format!(
            "On such surfaces: no verdict, because {which} admissible: {limits}. Remedy: {more}."
        );
    }
    let which = if none { "at any compared load" } else { "at this load" };
    let why = if exceeded.limits().any(|limit| limit == Limit::LargeStrain) {
        "contacts are not small against their asperities, of which spheres are a poor model"
    } else {
        "neighbouring contacts interact"
    };
    format!(
        "On such surfaces: neither model is admissible {which}: {limits}; {why}. Remedy: {}.",
        remedy(case, at)
    )
}

/// A limit that is exceeded, with the value at the load.
fn beyond(limit: Limit, at: &Difference) -> String {
    let words = limit_words(limit);
    let value = match (limit, &at.sharing) {
        (Limit::Interaction, _) => percent(at.area_ratio),
        // Below the limit also as a reader sees it.
        (Limit::FewContacts, Some(sharing)) => number(sharing.effective_contacts.min(MIN_CONTACTS - 0.1)),
        (Limit::DominantContact, Some(sharing)) => percent(sharing.largest_share),
        (Limit::LargeStrain, Some(sharing)) => percent(sharing.large_strain_share),
        (_, None) => return words,
    };
    format!("{words} ({value})")
}

/// What to do where asperities strain or interact: lower loads, an S filter, or boundary elements.
fn remedy(case: &CaseStudy, at: &Difference) -> String {
    let mut ways = Vec::new();
    let admissible = case.verdicts.admissible.stretches.iter();
    let lower = admissible.map(|stretch| stretch[1]).filter(|load| *load < at.load);
    if let Some(load) = lower.max_by(f64::total_cmp) {
        ways.push(format!("loads of at most {}", input_quantity(load, "Pa")));
    }
    ways.extend(filtered(case, at.load));
    match &case.first().reference {
        Some(_) if is_unreached(case, at.load) => {
            ways.push("a load that the surface can bear: check it, its area and their units".to_owned());
        }
        Some(_) => ways.push("the boundary elements".to_owned()),
        None => ways.push("boundary elements (`\"reference\"` among the `models`)".to_owned()),
    }
    ways.join(", or ")
}

/// Whether a load (Pa) is more than any contact of the reference carries.
pub fn is_unreached(case: &CaseStudy, load: f64) -> bool {
    case.first().reference.as_ref().is_some_and(|curve| curve.unreached.contains(&load))
}

/// Whether more surface lifts a limit.
fn is_of_few(limit: Limit) -> bool {
    matches!(limit, Limit::FewContacts | Limit::DominantContact)
}

/// More surface, of which the area is said where contacts and their shares of the load tell it.
fn more_surface(at: &Difference, verdicts: &Verdicts, exceeded: Exceeded) -> String {
    let contacts = at.sharing.as_ref().map(|sharing| {
        let factors = exceeded.limits().map(|limit| match limit {
            Limit::FewContacts => MIN_CONTACTS / sharing.effective_contacts,
            _ => sharing.largest_share / LARGEST_LOAD_SHARE,
        });
        verdicts.area * factors.fold(1.0, f64::max)
    });
    let needed = contacts.into_iter().chain(at.area_needed).fold(0.0, f64::max);
    let higher =
        verdicts.admissible.stretches.iter().map(|stretch| stretch[0]).filter(|load| *load > at.load);
    let higher = higher.min_by(f64::total_cmp);
    let higher = match higher {
        Some(load) => format!("a load of at least {}, or ", input_quantity(load, "Pa")),
        None if verdicts.differences.len() == 1 => "a higher load, or ".to_owned(),
        None => String::new(),
    };
    if needed > 0.0 && needed.is_finite() {
        let [needed, now] = [nominal_area(needed, true), nominal_area(verdicts.area, false)];
        format!("{higher}at least {needed} of surface (now {now})")
    } else {
        format!("{higher}a larger surface")
    }
}

/// Where no load is admissible, the shortest S filter with which this `load` (Pa) is, or else some other.
fn filtered(case: &CaseStudy, load: f64) -> Option<String> {
    if !case.verdicts.admissible.stretches.is_empty() {
        return None;
    }
    let found = case.treated.iter().filter_map(|one| match one.treatment {
        Treatment::ShortWaves(Some(index)) => {
            let loads = one.differences.iter().map(|at| (at.load, at.exceeded()));
            Some((index, AdmissibleRange::new(loads).stretches))
                .filter(|(_, stretches)| !stretches.is_empty())
        }
        _ => None,
    });
    let found: Vec<(f64, Vec<[f64; 2]>)> = found.collect();
    let (index, stretches) = shortest_filter(&found, load)?;
    let other = if holds(stretches, load) { "" } else { ", this one is not" };
    let loads: Vec<String> = stretches.iter().map(|loads| over(*loads)).collect();
    Some(format!(
        "an S filter of {}, where shorter waves do not matter, with which loads {} are admissible{other}",
        input_quantity(*index, "m"),
        listed(&loads)
    ))
}

/// The shortest filter whose stretches of admissible loads hold a load, or else the shortest.
fn shortest_filter(filters: &[(f64, Vec<[f64; 2]>)], load: f64) -> Option<&(f64, Vec<[f64; 2]>)> {
    let shortest = |only_here: bool| {
        let suitable = filters.iter().filter(|(_, stretches)| !only_here || holds(stretches, load));
        suitable.min_by(|a, b| a.0.total_cmp(&b.0))
    };
    shortest(true).or_else(|| shortest(false))
}

fn holds(stretches: &[[f64; 2]], load: f64) -> bool {
    stretches.iter().any(|[from, to]| (*from..=*to).contains(&load))
}

#[cfg(test)]
mod tests {
    use super::super::examples::verdicts;
    use super::*;

    #[test]
    fn more_surface_lifts_the_limits_of_few_contacts() {
        let few = verdicts(9.0, [0.2, 0.3], Some(0.01));
        let at = &few.differences[0];
        assert_eq!(beyond(Limit::FewContacts, at), "fewer than 30 effective contacts (9)");
        let nearly = verdicts(29.98, [0.2, 0.3], Some(0.01));
        let text = beyond(Limit::FewContacts, &nearly.differences[0]);
        assert_eq!(text, "fewer than 30 effective contacts (29.9)");
        let needed = more_surface(at, &few, at.exceeded());
        assert_eq!(needed, "at least 3.4 mm² of surface (now 1 mm²)");
        let unsampled = verdicts(9.0, [0.2, 0.3], None);
        let at = &unsampled.differences[0];
        let needed = more_surface(at, &unsampled, at.exceeded());
        assert_eq!(needed, "at least 4 mm² of surface (now 1 mm²)");
    }
    #[test]
    fn a_filter_that_helps_at_the_load_comes_before_a_shorter_one() {
        let filters =
            [(1e-6, vec![[1e6, 2e6], [8e6, 9e6]]), (2e-6, vec![[1e6, 9e6]]), (4e-6, vec![[1e6, 9e6]])];
        let index = |load: f64| shortest_filter(&filters, load).unwrap().0;
        assert_eq!([2e6, 5e6, 1e8].map(index), [1e-6, 2e-6, 1e-6]);
        assert!(shortest_filter(&[], 1e6).is_none());
    }
}
