//! The answer on one case, from typed facts: what the models say at the load, what holds on the map, and what holds of such surfaces.

use asperity::compare::{ComparedQuantity, NotModelled, OnMap, Stretch, Verdict};
use asperity::study::{Basis, CaseStudy, Choice, Verdicts};
use asperity::surface::Surface;
use asperity::topography::generate::Unfitted;
use asperity_contact_framework::report::format::{capitalised, input_quantity, listed, number, signed};

use super::at_load::{area as area_text, results};
use super::limit::none_admissible;
use crate::presentation::quantity_name;
use crate::surface::fitness;

/// The order in which quantities are spoken of.
pub const ORDER: [ComparedQuantity; 3] =
    [ComparedQuantity::Area, ComparedQuantity::Separation, ComparedQuantity::Stiffness];

/// The answer on one surface under one law and thickness: the results at the load, whether the integral may replace the sum on this
/// map, and on such surfaces. The load acts on `load_area` (m²).
pub fn answer(case: &CaseStudy, surface: &Surface, load_area: f64) -> Vec<String> {
    let verdicts = &case.verdicts;
    let mut sentences: Vec<String> = results(case, surface, load_area).into_iter().collect();
    sentences.extend(on_map(verdicts));
    let depends = if verdicts.is_blocked { None } else { dependence(case) };
    let of_surface = std::iter::once(on_surface(verdicts, surface)).chain(depends);
    sentences.push(of_surface.collect::<Vec<_>>().join(" "));
    sentences
}

/// What holds on the map: of each quantity the widest stretches within and beyond, at admissible loads if there are any.
fn on_map(verdicts: &Verdicts) -> Option<String> {
    let is_admissible = verdicts.on_map.iter().any(|one| one.is_admissible);
    let considered = || verdicts.on_map.iter().filter(|one| one.is_admissible == is_admissible);
    let widest = |compared: ComparedQuantity| {
        let of = move |is_within: bool| {
            let stretches =
                considered().filter(move |one| one.quantity == compared && one.is_within == is_within);
            stretches.max_by(|a, b| decades(a.loads).total_cmp(&decades(b.loads)))
        };
        [of(false), of(true)].into_iter().flatten()
    };
    let clauses: Vec<String> = ORDER.into_iter().flat_map(widest).map(map_clause).collect();
    let whose = match verdicts.basis {
        Basis::Realisations(count) => format!("On these {count} realisations"),
        Basis::Asperities | Basis::Unstated => "On these asperities".to_owned(),
        Basis::Blocks { .. } | Basis::TooSmall { .. } | Basis::ModelBased => "On this map".to_owned(),
    };
    let loads = if is_admissible { "" } else { ", at loads that are not admissible" };
    (!clauses.is_empty()).then(|| format!("{whose}{loads}: {}.", clauses.join("; ")))
}

/// "real contact area beyond (+12 to +36 %) from 1 MPa to 40 MPa".
fn map_clause(one: &OnMap) -> String {
    let range = ends(one.quantity, one.range);
    format!("{} {} ({range}) {}", quantity_name(one.quantity), one.name(), over(one.loads))
}

/// What holds of such surfaces: of each quantity its widest stretch of load with a conclusion, or the widest where there is none.
fn on_surface(verdicts: &Verdicts, surface: &Surface) -> String {
    if let Some(fault) = fitness::next_step(surface) {
        return format!("For such surfaces: no conclusion until the map is fit. Next step: {fault}.");
    }
    if verdicts.admissible.stretches.is_empty() {
        return format!("For such surfaces: cannot be told. {}", none_admissible(verdicts));
    }
    let widest = |compared: ComparedQuantity| {
        let stretches = verdicts.stretches.iter().filter(move |stretch| stretch.quantity == compared);
        stretches.max_by(|a, b| {
            let rank = |stretch: &Stretch| (stretch.verdict.is_told(), decades(stretch.loads));
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    };
    let main: Vec<&Stretch> = ORDER.into_iter().filter_map(widest).collect();
    let clauses = |verdict: Verdict, name: &str, clause: &dyn Fn(&Stretch) -> String| {
        let with: Vec<String> =
            main.iter().filter(|stretch| stretch.verdict == verdict).map(|stretch| clause(stretch)).collect();
        (!with.is_empty()).then(|| format!("{name}: {}", with.join("; ")))
    };
    let sentences = [
        clauses(Verdict::Beyond, "beyond what is accepted", &difference),
        clauses(Verdict::VeryLikelyBeyond, "very likely beyond", &difference),
        clauses(Verdict::Within, "within what is accepted", &difference),
        clauses(Verdict::VeryLikelyWithin, "very likely within", &difference),
        all_open(&main, verdicts),
    ];
    let sentences = sentences.into_iter().flatten().enumerate();
    let sentences: Vec<String> =
        sentences.map(|(k, said)| if k == 0 { said } else { capitalised(&said) }).collect();
    format!("For such surfaces{}: {}.", intervals(verdicts), sentences.join(". "))
}

/// The choices in the analysis of the map on which a verdict depends.
fn dependence(case: &CaseStudy) -> Option<String> {
    let is_one = |choice: &&Choice| case.dependences.iter().any(|one| one.choice == **choice);
    let names: Vec<String> =
        Choice::ALL.iter().filter(is_one).map(|choice| choice_words(*choice).to_owned()).collect();
    (!names.is_empty()).then(|| format!("A verdict depends on {}.", listed(&names)))
}

/// A choice in the analysis of a map.
fn choice_words(choice: Choice) -> &'static str {
    match choice {
        Choice::ShortWaves => "the S filter",
        Choice::Summits => "the number of neighbours that a summit exceeds",
        Choice::MeanRadius => "the mean radius",
        Choice::Level => "the form removed",
        Choice::Spikes => "narrow points that may be wrong",
        Choice::Part => "the part of the map",
    }
}

/// "cannot be told: real contact area and stiffness from 1 MPa to 40 MPa (needs ...)": quantities of which the same is said together.
fn all_open(main: &[&Stretch], verdicts: &Verdicts) -> Option<String> {
    let mut grouped: Vec<(Vec<String>, String)> = Vec::new();
    for stretch in main.iter().filter(|stretch| stretch.verdict == Verdict::CannotTell) {
        let (name, rest) = (quantity_name(stretch.quantity).to_owned(), open(stretch, verdicts));
        match grouped.iter_mut().find(|(_, other)| *other == rest) {
            Some((names, _)) => names.push(name),
            None => grouped.push((vec![name], rest)),
        }
    }
    let clauses: Vec<String> =
        grouped.iter().map(|(names, rest)| format!("{} {rest}", listed(names))).collect();
    (!clauses.is_empty()).then(|| format!("cannot be told: {}", clauses.join("; ")))
}

/// What the intervals are.
fn intervals(verdicts: &Verdicts) -> &'static str {
    match verdicts.basis {
        Basis::ModelBased => " (model-based 95 % intervals)",
        Basis::Blocks { .. } | Basis::Realisations(_) | Basis::Asperities => " (95 % intervals)",
        Basis::TooSmall { .. } | Basis::Unstated => "",
    }
}

/// "+12 to +36 %" of contrasts of a quantity.
fn ends(compared: ComparedQuantity, contrasts: [f64; 2]) -> String {
    let (unit, size) = unit(compared);
    let [low, high] = contrasts.map(|end| signed(size * compared.reported(end)));
    if low == high { format!("{low} {unit}") } else { format!("{low} to {high} {unit}") }
}

fn unit(compared: ComparedQuantity) -> (&'static str, f64) {
    match compared {
        ComparedQuantity::Separation => ("σ", 1.0),
        ComparedQuantity::Area | ComparedQuantity::Stiffness => ("%", 100.0),
    }
}

/// "real contact area +12 to +36 % (accepted 10 %) from 1 MPa to 40 MPa": the outermost ends of the intervals, or of the differences.
fn difference(stretch: &Stretch) -> String {
    let range = stretch.bounds.or(stretch.range);
    let range = range.map_or_else(String::new, |range| format!(" {}", ends(stretch.quantity, range)));
    let (unit, size) = unit(stretch.quantity);
    let accepted = number(size * stretch.accepted);
    format!("{}{range} (accepted {accepted} {unit}) {}", quantity_name(stretch.quantity), over(stretch.loads))
}

/// "from 1 MPa to 40 MPa (needs about 2.5 mm² of surface, now 1 mm²)".
fn open(stretch: &Stretch, verdicts: &Verdicts) -> String {
    let need = match (verdicts.basis, stretch.growth, verdicts.area_needed(stretch)) {
        (Basis::Realisations(now), Some(growth), _) => {
            let needed = (growth * now as f64).ceil().max(now as f64 + 1.0);
            format!(" (needs about {} realisations, now {now})", number(needed))
        }
        (Basis::Unstated, ..) => {
            " (no interval: the list needs `independent = true`, or columns `x` and `y`)".to_owned()
        }
        (basis, _, Some(area)) => {
            let least = if stretch.area_needed.is_some() { "at least" } else { "about" };
            let [area, now] = [nominal_area(area, true), nominal_area(verdicts.area, false)];
            let why = match basis {
                Basis::TooSmall { not_modelled: Some(reason), .. } => {
                    format!("; no model-based interval: {}", no_model(reason))
                }
                _ => String::new(),
            };
            format!(" (needs {least} {area} of surface, now {now}{why})")
        }
        _ => String::new(),
    };
    format!("{}{need}", over(stretch.loads))
}

/// Why there is no model-based interval.
fn no_model(reason: NotModelled) -> &'static str {
    match reason {
        NotModelled::Unfitted(Unfitted::TooShort) => {
            "a side of the map is shorter than 8 correlation lengths"
        }
        NotModelled::Unfitted(Unfitted::Patchy) | NotModelled::Patchy => {
            "the roughness varies from place to place"
        }
        NotModelled::Unfitted(Unfitted::Flat) => "the heights do not scatter",
        NotModelled::Unfitted(Unfitted::Periodic) => "the surface is periodic",
        NotModelled::Unlike => "surfaces of its spectrum and heights have other asperities",
        NotModelled::Failed => "surfaces of its spectrum and heights could not be compared",
    }
}

/// A nominal area (m²) with two digits, rounded `up` or to the nearest.
pub fn nominal_area(area: f64, up: bool) -> String {
    let nearest: f64 = format!("{area:.1e}").parse().unwrap_or(area);
    let unit = 10f64.powf(area.log10().floor() - 1.0);
    let rounded = if up && nearest < area { nearest + unit } else { nearest };
    area_text(rounded)
}

/// The width of a stretch on a logarithmic scale.
fn decades([from, to]: [f64; 2]) -> f64 {
    (to / from).log10()
}

/// "from 0.5 MPa to 40 MPa", or "at 1 MPa".
pub fn over([from, to]: [f64; 2]) -> String {
    let [first, last] = [from, to].map(|load| input_quantity(load, "Pa"));
    if from == to { format!("at {first}") } else { format!("from {first} to {last}") }
}

#[cfg(test)]
mod tests {
    use super::super::count::count;
    use super::*;
    use asperity::LoadSharing;
    use asperity::compare::{Accepted, AdmissibleRange, Difference, Estimate, Support};

    /// Verdicts at an area ratio.
    fn verdicts_of(contacts: f64, area_ratio: f64) -> Verdicts {
        let mut all = verdicts(contacts, [0.2, 0.3], Some(0.01));
        all.differences.iter_mut().for_each(|at| at.area_ratio = area_ratio);
        all.admissible = AdmissibleRange::new(all.differences.iter().map(|at| (at.load, at.exceeded())));
        all
    }

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
        assert_eq!(text, "from 1 MPa to 10 MPa (needs at least 4 mm² of surface, now 1 mm²)");
        let few = verdicts(9.0, [0.2, 0.3], Some(0.01));
        let text = super::none_admissible(&few);
        assert_eq!(
            text,
            "No load is admissible: fewer than 30 effective contacts from 1 MPa to 10 MPa. Remedy: a higher load, or a larger surface."
        );
        let large = verdicts_of(90.0, 0.2);
        let text = super::none_admissible(&large);
        assert!(
            text.starts_with(
                "No load is admissible: contact area above 5 % from 1 MPa to 10 MPa. Remedy: lower"
            ),
            "{text}"
        );
        let unsampled = verdicts(9.0, [0.2, 0.3], None);
        let text = super::none_admissible(&unsampled);
        assert!(text.ends_with("a map of at least 4 mm² (now 1 mm²)."), "{text}");
    }

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
        assert!(count(&[&beyond, &blocked]).contains("1 are on maps that fail a fitness check"));
    }
}
