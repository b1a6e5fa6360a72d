//! The answer of a page in a sentence or two, from typed facts.

use asperity::compare::{ComparedQuantity, Stretch, Verdict};
use asperity::study::{Basis, Verdicts};
use asperity::surface::Surface;
use asperity::{INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE, Limit, MIN_CONTACTS};
use asperity_contact_framework::report::format::{
    alternatives, input_quantity, listed, number, percent, quantity, signed,
};

use crate::presentation::quantity_name;
use crate::surface::fitness;

/// The order in which quantities are spoken of.
pub const ORDER: [ComparedQuantity; 3] =
    [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness];

/// The answer on one surface under one law and thickness: of each quantity its widest stretch of load with a conclusion, or the
/// widest where there is none.
pub fn answer(verdicts: &Verdicts, surface: &Surface) -> String {
    if verdicts.admissible.stretches.is_empty() {
        return if_fit(surface, none_admissible(verdicts));
    }
    let widest = |compared: ComparedQuantity| {
        let stretches = verdicts.stretches.iter().filter(move |stretch| stretch.quantity == compared);
        stretches.max_by(|a, b| {
            let rank = |stretch: &Stretch| (stretch.verdict != Verdict::CannotTell, decades(stretch));
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    };
    let main: Vec<&Stretch> = ORDER.into_iter().filter_map(widest).collect();
    let with = |verdict: Verdict| main.iter().copied().filter(move |stretch| stretch.verdict == verdict);
    let mut sentences = Vec::new();
    sentences.extend(sentence("Beyond what is accepted", with(Verdict::Beyond).map(difference)));
    sentences.extend(sentence("Within what is accepted", with(Verdict::Within).map(difference)));
    sentences
        .extend(sentence("Cannot be told", with(Verdict::CannotTell).map(|stretch| open(stretch, verdicts))));
    if_fit(surface, sentences.join(" "))
}

/// "Beyond what is accepted: area ..., separation ...", of some clauses; `None` of none.
fn sentence(start: &str, clauses: impl Iterator<Item = String>) -> Option<String> {
    let clauses: Vec<String> = clauses.collect();
    (!clauses.is_empty()).then(|| format!("{start}: {}.", clauses.join("; ")))
}

/// "real contact area +12 to +36 % (accepted 10 %) from 1 MPa to 40 MPa".
fn difference(stretch: &Stretch) -> String {
    let (unit, size) = match stretch.quantity {
        ComparedQuantity::Separation => ("σ", 1.0),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => ("%", 100.0),
    };
    let ends = stretch.range.map(|ends| ends.map(|end| signed(size * stretch.quantity.reported(end))));
    let ends = ends.map_or_else(String::new, |[low, high]| {
        if low == high { format!(" {low} {unit}") } else { format!(" {low} to {high} {unit}") }
    });
    let accepted = number(size * stretch.accepted);
    format!("{}{ends} (accepted {accepted} {unit}) {}", quantity_name(stretch.quantity), over(stretch.loads))
}

/// "stiffness from 1 MPa to 40 MPa (needs about 2.5 mm² of surface, now 1 mm²)".
fn open(stretch: &Stretch, verdicts: &Verdicts) -> String {
    let need = match (verdicts.basis, stretch.growth, verdicts.area_needed(stretch)) {
        (Basis::Realisations(now), Some(growth), _) => {
            let needed = (growth * now as f64).ceil().max(now as f64 + 1.0);
            format!(" (needs about {} realisations, now {now})", number(needed))
        }
        (Basis::Unstated, ..) => {
            " (no interval: the list needs `independent = true`, or columns `x` and `y`)".to_owned()
        }
        (_, _, Some(area)) => {
            let least = if stretch.area_needed.is_some() { "at least" } else { "about" };
            let [area, now] = [area, verdicts.area].map(nominal_area);
            format!(" (needs {least} {area} of surface, now {now})")
        }
        _ => String::new(),
    };
    format!("{} {}{need}", quantity_name(stretch.quantity), over(stretch.loads))
}

/// A nominal area (m²) with two digits: in mm² from a tenth on.
fn nominal_area(area: f64) -> String {
    let rounded: f64 = format!("{area:.1e}").parse().unwrap_or(area);
    if (1e-8..1.0).contains(&rounded) {
        format!("{} mm²", number(1e6 * rounded))
    } else {
        quantity(rounded, "m²")
    }
}

/// Why no load carries a verdict.
fn none_admissible(verdicts: &Verdicts) -> String {
    let limits: Vec<String> = verdicts.admissible.below.limits().map(limit_words).collect();
    format!("Cannot be told at any load of this experiment: {}.", alternatives(&limits))
}

/// What lies beyond a limit.
fn limit_words(limit: Limit) -> String {
    match limit {
        Limit::FewContacts => format!("fewer than {MIN_CONTACTS} effective contacts"),
        Limit::DominantContact => {
            format!("more than {} of the load in one contact", percent(LARGEST_LOAD_SHARE))
        }
        Limit::Interaction => format!("contact area above {}", percent(INTERACTION)),
        Limit::LargeStrain => {
            format!("more than {} of the load at large strains", percent(LARGE_STRAIN_SHARE))
        }
    }
}

/// The width of a stretch on a logarithmic scale.
fn decades(stretch: &Stretch) -> f64 {
    (stretch.loads[1] / stretch.loads[0]).log10()
}

/// "from 0.5 MPa to 40 MPa", or "at 1 MPa".
fn over([from, to]: [f64; 2]) -> String {
    let [first, last] = [from, to].map(|load| input_quantity(load, "Pa"));
    if from == to { format!("at {first}") } else { format!("from {first} to {last}") }
}

/// A sentence on a surface, unless a failed check keeps it from carrying a verdict.
fn if_fit(surface: &Surface, sentence: String) -> String {
    match fitness::blocked_by(surface) {
        None => sentence,
        Some(faults) => {
            format!("No conclusion until the map is fit: {faults}. As the data stand: {sentence}")
        }
    }
}

/// The answer over several cases: for how many the models differ by more than is accepted at some load, for how many they agree
/// wherever that can be told.
pub fn count(all: &[&Verdicts]) -> String {
    let has = |verdicts: &Verdicts, compared: ComparedQuantity, wanted: Verdict| {
        verdicts.stretches.iter().any(|stretch| stretch.quantity == compared && stretch.verdict == wanted)
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
    let beyond = counted(&|verdicts, compared| has(verdicts, compared, Verdict::Beyond));
    let within = counted(&|verdicts, compared| {
        has(verdicts, compared, Verdict::Within) && !has(verdicts, compared, Verdict::Beyond)
    });
    let is_open = |verdicts: &Verdicts, compared: ComparedQuantity| {
        !has(verdicts, compared, Verdict::Beyond) && !has(verdicts, compared, Verdict::Within)
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
    let blocked = match all.iter().filter(|verdicts| verdicts.is_blocked).count() {
        0 => String::new(),
        count => {
            format!(" {count} are on maps that fail a fitness check: no conclusion until those are fit.")
        }
    };
    format!(
        "Of {} cases, beyond what is accepted at some load: {beyond}. Within it wherever that can be told: {within}.{open}{blocked}",
        all.len()
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
    use super::*;
    use asperity::LoadSharing;
    use asperity::compare::{Accepted, AdmissibleRange, Difference, Estimate};

    /// Verdicts on a surface of 1 mm² from contrasts and standard errors of the area at 1 and 10 MPa.
    fn verdicts(contacts: f64, contrasts: [f64; 2], error: Option<f64>) -> Verdicts {
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
                Some(Estimate { contrast, error, quantile: 2.0, bound: 0.0, independent_error: error }),
                None,
            ],
            area_needed: error.is_none().then_some(4e-6),
        };
        let differences: Vec<Difference> = [1e6, 1e7].into_iter().zip(contrasts).map(at_load).collect();
        Verdicts {
            stretches: Stretch::all(&differences, &accepted),
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

    #[test]
    fn each_verdict_has_a_form_with_its_range() {
        let clause = |verdicts: &Verdicts| difference(&verdicts.stretches[0]);
        let beyond = verdicts(90.0, [0.2f64.ln_1p(), 0.3f64.ln_1p()], Some(0.01));
        assert_eq!(beyond.stretches[0].verdict, Verdict::Beyond);
        assert!(clause(&beyond).starts_with("real contact area +"), "{}", clause(&beyond));
        assert!(clause(&beyond).ends_with("% (accepted 10 %) from 1 MPa to 10 MPa"), "{}", clause(&beyond));
        let within = verdicts(90.0, [0.01, 0.02], Some(0.01));
        assert_eq!(within.stretches[0].verdict, Verdict::Within);
    }

    #[test]
    fn what_cannot_be_told_names_what_it_needs() {
        let small = verdicts(90.0, [0.2, 0.3], None);
        let text = open(&small.stretches[0], &small);
        assert_eq!(
            text,
            "real contact area from 1 MPa to 10 MPa (needs at least 4 mm² of surface, now 1 mm²)"
        );
        let few = verdicts(9.0, [0.2, 0.3], Some(0.01));
        let text = none_admissible(&few);
        assert_eq!(text, "Cannot be told at any load of this experiment: fewer than 30 effective contacts.");
    }

    #[test]
    fn cases_are_counted_by_quantity() {
        let beyond = verdicts(90.0, [0.2, 0.3], Some(0.01));
        let within = verdicts(90.0, [0.01, 0.02], Some(0.01));
        let text = count(&[&beyond, &within, &within]);
        assert!(text.contains("at some load: real contact area 1, separation 0"), "{text}");
        assert!(text.contains("can be told: real contact area 2, separation 0"), "{text}");
        let open = verdicts(90.0, [0.2, 0.01], None);
        let text = count(&[&within, &open]);
        assert!(text.contains("at any load: real contact area 1, separation 2"), "{text}");
        assert!(text.contains("is accepted for real contact area 1, separation 0 and stiffness 0"), "{text}");
        let blocked = Verdicts { is_blocked: true, ..within };
        assert!(count(&[&beyond, &blocked]).contains("1 are on maps that fail a fitness check"));
    }
}
