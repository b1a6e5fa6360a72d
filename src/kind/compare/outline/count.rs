//! The answer over several cases, counted.

use asperity::compare::{ComparedQuantity, Verdict};
use asperity::study::Verdicts;
use asperity_contact_framework::report::format::listed;

use super::lead::ORDER;
use crate::presentation::quantity_name;

/// The answer over several cases: for how many the models differ by more than is accepted at some load, for how many they agree
/// wherever that can be told; of those on maps that are fit.
pub fn count(cases: &[&Verdicts]) -> String {
    let all: Vec<&Verdicts> = cases.iter().copied().filter(|verdicts| !verdicts.is_blocked).collect();
    let blocked = match cases.len() - all.len() {
        0 => String::new(),
        count if all.is_empty() => {
            return format!(
                "The maps of all {count} cases fail a fitness check: no conclusion until they are fit."
            );
        }
        count => {
            format!(" The maps of {count} more fail a fitness check: no conclusion until they are fit.")
        }
    };
    let has = |verdicts: &Verdicts, compared: ComparedQuantity, is_wanted: fn(Verdict) -> bool| {
        verdicts.stretches.iter().any(|stretch| stretch.quantity == compared && is_wanted(stretch.verdict))
    };
    let counted = |holds: &dyn Fn(&Verdicts, ComparedQuantity) -> bool| {
        let part = |compared: ComparedQuantity| {
            format!(
                "{} {}",
                quantity_name(compared),
                all.iter().filter(|verdicts| holds(verdicts, compared)).count()
            )
        };
        listed(&ORDER.map(part))
    };
    let beyond = counted(&|verdicts, compared| has(verdicts, compared, Verdict::is_beyond));
    let within = counted(&|verdicts, compared| {
        has(verdicts, compared, Verdict::is_within) && !has(verdicts, compared, Verdict::is_beyond)
    });
    let is_open = |verdicts: &Verdicts, compared: ComparedQuantity| {
        !has(verdicts, compared, Verdict::is_beyond) && !has(verdicts, compared, Verdict::is_within)
    };
    let open = if all.iter().any(|verdicts| ORDER.iter().any(|&compared| is_open(verdicts, compared))) {
        let open = counted(&is_open);
        let more = counted(&|verdicts, compared| {
            is_open(verdicts, compared) && differs_on_surface(verdicts, compared)
        });
        format!(
            " Cannot be told of such surfaces at any load: {open}; on the compared surface itself the models differ by more than is accepted for {more} of these."
        )
    } else {
        String::new()
    };
    format!(
        "Of {} case{}, beyond what is accepted at some load, surely or very likely: {beyond}. Within it wherever that can be told: {within}.{open}{blocked}",
        all.len(),
        if all.len() == 1 { "" } else { "s" }
    )
}

/// Whether the models differ by more than is accepted on the compared surface, at some admissible load.
fn differs_on_surface(verdicts: &Verdicts, compared: ComparedQuantity) -> bool {
    let accepted = verdicts.accepted.limit(compared);
    let admissible = verdicts.differences.iter().filter(|at| at.exceeded().is_none());
    let mut differences = admissible.filter_map(|at| at.estimates[compared as usize]);
    differences.any(|estimate| compared.reported(estimate.contrast).abs() > accepted)
}

#[cfg(test)]
mod tests {
    use super::super::examples::verdicts;
    use super::*;

    #[test]
    fn cases_are_counted_by_quantity() {
        let beyond = verdicts(90.0, [0.2, 0.3], Some(0.01));
        let within = verdicts(90.0, [0.01, 0.02], Some(0.01));
        let text = count(&[&beyond, &within, &within]);
        assert!(
            text.contains("at some load, surely or very likely: real contact area 1, separation 0"),
            "{text}"
        );
        assert!(text.contains("can be told: real contact area 2, separation 0"), "{text}");
        let open = verdicts(90.0, [0.2, 0.01], None);
        let text = count(&[&within, &open]);
        assert!(text.contains("at any load: real contact area 1, separation 2"), "{text}");
        assert!(text.contains("is accepted for real contact area 1, separation 0 and stiffness 0"), "{text}");
        let blocked = Verdicts { is_blocked: true, ..within };
        let text = count(&[&beyond, &blocked]);
        assert!(
            text.starts_with("Of 1 case, ") && text.contains("The maps of 1 more fail a fitness check"),
            "{text}"
        );
        assert!(text.contains("can be told: real contact area 0,"), "{text}");
        assert!(count(&[&blocked, &blocked]).starts_with("The maps of all 2 cases fail a fitness check"));
    }
}
