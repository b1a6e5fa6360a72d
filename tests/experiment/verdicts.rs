//! Verdicts of `[compare]` and `[laws]`: for each kind of statement a case in which it holds and one in which it does not.

use std::path::Path;

use asperity::compare::{Accepted, ComparedQuantity, Stretch, Verdict};
use asperity::contact_law::named;
use asperity::study::{self, Basis, LawContact, StudyError, Verdicts};
use asperity::surface::{Preparation, SummitSearch};
use asperity::topography::Level;
use asperity::topography::summits::Neighbours;
use asperity::{HeightMap, Limit, Material};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::answer::{Answer, CardLine, MOST_WORDS, words};
use asperity_experiment::kind::compare::results::CompareResults;

use crate::Report;
use crate::results::{ON_STEEL, population, run_in, waves, write_map};

/// Runs `[compare]` on `surfaces`, with files beside it in `folder`.
fn run(folder: &Path, compare: &str, surfaces: &str) -> Box<dyn Outcome> {
    run_in(folder, &format!("{ON_STEEL}{compare}\n{surfaces}")).unwrap()
}

fn compared(compare: &str, surfaces: &str) -> CompareResults {
    crate::downcast(run(tempfile::tempdir().unwrap().path(), compare, surfaces))
}

fn verdicts(results: &CompareResults, surface: usize) -> &Verdicts {
    &results.surfaces[surface].cases[0].verdicts
}

fn of(found: &Verdicts, quantity: ComparedQuantity) -> impl Iterator<Item = &Stretch> {
    found.stretches.iter().filter(move |stretch| stretch.quantity == quantity)
}

fn is(verdict: Verdict) -> impl Fn(&&Stretch) -> bool {
    move |stretch| stretch.verdict == verdict
}

const LOADS: &str = "pressure = { from = \"1 MPa\", to = \"60 MPa\", points = 10 }";

/// Heights that are all but Gaussian, a million of them: many standard errors, and of no consequence.
#[test]
fn a_trivial_gap_of_a_million_asperities_is_within() {
    let compare = format!("statistical = {{ heights = \"gaussian\" }}\n{LOADS}");
    let more = "heights.johnson = { skewness = 0.03, kurtosis = 3.002 }";
    let results = compared(&compare, &population("many", 1_000_000, more));
    let found = verdicts(&results, 0);
    for quantity in ComparedQuantity::ALL.into_iter().filter(|quantity| quantity.spot().is_none()) {
        let widest = of(found, quantity).filter(is(Verdict::Within)).map(|one| one.loads[1] / one.loads[0]);
        assert!(widest.fold(0.0, f64::max) > 10.0, "{quantity:?}: {:?}", found.stretches);
        assert_eq!(of(found, quantity).filter(is(Verdict::Beyond)).count(), 0, "{quantity:?}");
    }
    let is_significant = found.differences.iter().any(|at| {
        let estimate = at.estimates[ComparedQuantity::Separation as usize].unwrap();
        estimate.contrast.abs() > 3.0 * estimate.error.unwrap_or(f64::INFINITY)
    });
    assert!(is_significant, "the gap is there");
}

/// The same heights as of a plateau, 150 or 300,000 of them.
#[test]
fn a_large_gap_of_few_asperities_cannot_be_told_and_of_many_is_beyond() {
    let compare = format!("statistical = {{ heights = \"gaussian\" }}\n{LOADS}");
    let more = "heights.johnson = { skewness = -1, kurtosis = 4.5 }";
    let surfaces = population("few", 150, more) + &population("many", 300_000, more);
    let results = compared(&compare, &surfaces);
    let (few, many) = (verdicts(&results, 0), verdicts(&results, 1));
    assert!(
        few.stretches.iter().all(|stretch| stretch.verdict == Verdict::CannotTell),
        "{:?}",
        few.stretches
    );
    assert!(of(few, ComparedQuantity::Separation).next().unwrap().area_needed.is_some());
    let beyond = of(many, ComparedQuantity::Separation).find(is(Verdict::Beyond)).unwrap();
    assert!(beyond.loads[1] > 3.0 * beyond.loads[0] && beyond.largest.unwrap().1.contrast > 0.2);
    assert!(matches!(many.basis, Basis::Asperities));
}

/// Draws of the population that the statistical model assumes.
#[test]
fn a_model_that_is_true_is_rarely_called_beyond() {
    const DRAWS: usize = 100;
    let surfaces: String = (0..DRAWS).map(|k| population(&format!("s{k}"), 3000, "")).collect();
    let loads = "pressure = { from = \"5 MPa\", to = \"60 MPa\", points = 5 }";
    let results = compared(loads, &surfaces);
    let all: Vec<&Verdicts> = (0..DRAWS).map(|k| verdicts(&results, k)).collect();
    let beyond =
        |found: &&&Verdicts| found.stretches.iter().any(|stretch| stretch.verdict == Verdict::Beyond);
    let within =
        |found: &&&Verdicts| found.stretches.iter().any(|stretch| stretch.verdict == Verdict::Within);
    assert!(all.iter().filter(beyond).count() <= DRAWS / 20);
    assert!(all.iter().filter(within).count() >= DRAWS - DRAWS / 20, "it is not silent either");
}

/// Cut at 512 to 2048 points: what a small window says, a large one does not deny.
#[test]
fn windows_of_one_surface_do_not_contradict_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let heights = waves(2048, [32.0, 8.0], 5);
    let mut surfaces = String::new();
    for count in [512, 1024, 2048] {
        write_map(folder.path().join(format!("w{count}.npy")), [count; 2], |i, j| heights[i * 2048 + j]);
        surfaces += &format!(
            "[surface.w{count}.file]\npath = \"w{count}.npy\"\npixel = \"1 um\"\nlevel = \"mean\"\n"
        );
    }
    let loads =
        "accept = { separation = 0.15 }\npressure = { from = \"1 MPa\", to = \"60 MPa\", points = 12 }";
    let results: CompareResults = crate::downcast(run(folder.path(), loads, &surfaces));
    let all: Vec<&Verdicts> = (0..3).map(|k| verdicts(&results, k)).collect();
    assert!(all.iter().all(|found| matches!(found.basis, Basis::Blocks { .. })));
    let told = |found: &Verdicts, quantity: ComparedQuantity, load: f64| {
        let at = of(found, quantity).find(|one| (one.loads[0]..=one.loads[1]).contains(&load))?;
        (at.verdict != Verdict::CannotTell).then_some(at.verdict)
    };
    let mut conclusions = [0; 3];
    for load in results.surfaces[0].cases[0].verdicts.differences.iter().map(|at| at.load) {
        for quantity in ComparedQuantity::ALL {
            let said: Vec<Option<Verdict>> = all.iter().map(|found| told(found, quantity, load)).collect();
            let concluded: Vec<Verdict> = said.iter().copied().flatten().collect();
            assert!(
                concluded.windows(2).all(|pair| pair[0] == pair[1]),
                "{quantity:?} at {load:e}: {said:?}"
            );
            said.iter().zip(&mut conclusions).for_each(|(said, count)| *count += usize::from(said.is_some()));
        }
    }
    assert!(conclusions[0] > 0 && conclusions[2] > conclusions[0], "{conclusions:?}");
}

/// Waves as long as the map: blocks of it are not independent.
#[test]
fn a_map_of_long_waves_claims_no_interval() {
    let folder = tempfile::tempdir().unwrap();
    let heights = waves(512, [256.0, 8.0], 5);
    write_map(folder.path().join("w.npy"), [256; 2], |i, j| heights[i * 512 + j]);
    let surface = "[surface.w.file]\npath = \"w.npy\"\npixel = \"1 um\"\n";
    let results: CompareResults = crate::downcast(run(folder.path(), LOADS, surface));
    let found = verdicts(&results, 0);
    assert!(matches!(found.basis, Basis::TooSmall { .. }), "{:?}", found.basis);
    assert!(found.stretches.iter().all(|stretch| stretch.verdict == Verdict::CannotTell));
    assert!(
        found.differences.iter().flat_map(|at| at.estimates).flatten().all(|one| one.interval().is_none())
    );
    let needed = found.area_needed(&found.stretches[0]).unwrap();
    assert!(needed > 2.0 * found.area, "{needed:e}");
}

/// One spike of 47 sigma carries most of the load.
#[test]
fn a_spike_is_no_valid_contact() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, spike: f64| {
        let heights = (0..4000).map(|k| 1e-8 * ((f64::from(k) * 0.618).fract() * 2.0 - 1.0));
        let rows: String = heights.map(|z| format!("{z:e},2e-5\n")).collect();
        std::fs::write(folder.path().join(name), format!("height,radius\n{rows}{spike:e},2e-5\n")).unwrap();
    };
    write("spiked.csv", 2.8e-7);
    write("even.csv", 1e-8);
    let list = |name: &str| {
        format!(
            "[surface.{name}.asperities]\nfile = \"{name}.csv\"\nnominal-area = \"1e-6 m^2\"\nindependent = true\n"
        )
    };
    let loads = "pressure = { values = [\"200 kPa\"] }";
    let results: CompareResults =
        crate::downcast(run(folder.path(), loads, &(list("spiked") + &list("even"))));
    let exceeded =
        |k: usize| -> Vec<Limit> { verdicts(&results, k).differences[0].exceeded().limits().collect() };
    assert!(exceeded(0).contains(&Limit::DominantContact) && exceeded(0).contains(&Limit::FewContacts));
    assert_eq!(exceeded(1), []);
    assert!(verdicts(&results, 0).admissible.stretches.is_empty());
    let share = verdicts(&results, 0).differences[0].sharing.unwrap().largest_share;
    assert!(share > 0.3, "{share}");
}

/// Sharp asperities pressed deep: a/R above 0.3.
#[test]
fn large_strains_end_the_valid_range() {
    let sharp = "[surface.sharp.population]\nradius = \"4 um\"\nsigma = \"260 nm\"\ndensity = \"9e10 /m^2\"\ncount = 30000\n";
    let results = compared("pressure = { from = \"100 kPa\", to = \"100 MPa\", points = 13 }", sharp);
    let found = verdicts(&results, 0);
    let limits = |load: usize| found.differences[load].exceeded().limits().collect::<Vec<_>>();
    assert!(limits(12).contains(&Limit::LargeStrain));
    let [_, highest] = *found.admissible.stretches.last().unwrap();
    assert!(highest < 5e7 && found.admissible.above.limits().any(|limit| limit == Limit::LargeStrain));
    let blunt = compared(LOADS, &population("blunt", 30_000, ""));
    let at_all =
        verdicts(&blunt, 0).differences.iter().flat_map(|at| at.exceeded().limits().collect::<Vec<_>>());
    assert!(!at_all.into_iter().any(|limit| limit == Limit::LargeStrain));
}

/// The same difference under two opinions of what matters.
#[test]
fn what_is_accepted_decides() {
    let verdict = |accept: &str| {
        let compare = format!(
            "accept = {{ {accept} }}\nstatistical = {{ heights = \"gaussian\" }}\npressure = {{ values = [\"20 MPa\"] }}"
        );
        let more = "heights.johnson = { skewness = -1, kurtosis = 4.5 }";
        let results = compared(&compare, &population("a", 100_000, more));
        let found = verdicts(&results, 0);
        of(found, ComparedQuantity::Separation).next().unwrap().verdict
    };
    assert_eq!(verdict("separation = 0.1"), Verdict::Beyond);
    assert_eq!(verdict("separation = \"4.8 nm\""), Verdict::Beyond);
    assert_eq!(verdict("separation = 2"), Verdict::Within);
    assert_eq!(verdict("separation = \"96 nm\""), Verdict::Within);
}

/// The mean over realisations has the interval of their scatter.
#[test]
fn realisations_give_the_interval_directly() {
    let surfaces = population("a", 3000, "realisations = 6") + &population("b", 3000, "");
    let results = compared("pressure = { values = [\"20 MPa\"] }", &surfaces);
    let [several, one] = [0, 1].map(|k| verdicts(&results, k));
    assert_eq!((several.basis, one.basis), (Basis::Realisations(6), Basis::Asperities));
    let half = |found: &Verdicts| found.differences[0].estimates[0].unwrap().half_width().unwrap();
    assert!(half(several) < half(one), "{} {}", half(several), half(one));
}

/// The page answers first, with a card that `summary.json` and the terminal have too.
#[test]
fn the_card_stands_first_and_in_the_files() {
    let outcome = run(tempfile::tempdir().unwrap().path(), LOADS, &population("case", 100_000, ""));
    let page = outcome.outline().markdown();
    let first = page.lines().nth(4).unwrap();
    assert!(first.starts_with("| **Result at the middle admissible load** | "), "{first}");
    let answer = outcome.outline().answer();
    let keys: Vec<&str> = answer.lines.iter().map(|line| line.key.as_str()).collect();
    assert_eq!(keys, ["result", "answer", "difference", "instead", "nearer", "certainty"]);
    assert_eq!(answer.sentence, answer.lines[1].text());
    assert!(answer.sentence.contains("Such surfaces: yes (95 % intervals)."), "{answer}");
    for text in answer.lines.iter().flat_map(|line| &line.texts) {
        assert!(words(text) <= MOST_WORDS, "{text}");
    }
    assert_eq!(outcome.terminal().unwrap(), Answer { sentence: String::new(), ..answer.clone() }.to_string());
    assert!(page.contains("case-models.svg"));
    let json = serde_json::Value::Object(outcome.records());
    let all = json["verdicts"].as_array().unwrap();
    let area = all.iter().find(|one| one["quantity"] == "area" && one["verdict"] == "within").unwrap();
    assert_eq!((&area["against"], &area["model"]), (&"deterministic".into(), &"statistical".into()));
    assert!(area["low"].as_f64() < area["difference"].as_f64() && area["accepted"] == 0.1);
}

/// The card of a case.
fn card(compare: &str, surfaces: &str) -> Answer {
    run(tempfile::tempdir().unwrap().path(), compare, surfaces).outline().answer()
}

fn line(card: &Answer, key: &str) -> String {
    card.lines.iter().find(|line| line.key == key).map(CardLine::text).unwrap_or_default()
}

/// Why a load is not admissible, and what to do instead: lower loads where asperities interact, more surface where contacts are few.
#[test]
fn a_load_that_is_not_admissible_has_its_remedy() {
    let sweep = "separation = { from = 3, to = 1, points = 9 }";
    let surface = population("a", 30_000, "");
    let at = |load: &str| card(&format!("{sweep}\npressure = {{ values = [\"{load}\"] }}"), &surface);
    let high = at("600 MPa");
    let [answer, instead] = ["answer", "instead"].map(|key| line(&high, key));
    assert!(answer.starts_with("Neither model is for this load: contact area "), "{high}");
    assert!(answer.contains("% of the nominal (at most 5 %). All quantities, by load: "), "{high}");
    // Boundary elements need a map.
    assert!(instead.starts_with("Loads of at most "), "{high}");
    assert_eq!(line(&high, "certainty"), "");
    let low = at("2 kPa");
    assert!(line(&low, "answer").contains("Such surfaces: cannot be told with "), "{low}");
    assert!(line(&low, "answer").contains("effective contacts (at least 30)"), "{low}");
    let instead = line(&low, "instead");
    assert!(instead.starts_with("The sum on this surface; for such surfaces loads of at least "), "{low}");
    assert!(instead.contains("mm² of surface (now 0.5 mm²)"), "{low}");
    let admissible = at("20 MPa");
    assert!(
        !line(&admissible, "answer").contains("Neither")
            && line(&admissible, "certainty").starts_with("95 % intervals from "),
        "{admissible}"
    );
    assert!(line(&admissible, "result").starts_with("10 N on 0.5 mm² (20 MPa): "), "{admissible}");
}

/// Several cases are counted, with a row of a table each; of few the terminal has the cards.
#[test]
fn several_cases_are_counted_and_have_a_row_each() {
    let surfaces = |names: &[&str]| names.iter().map(|name| population(name, 3000, "")).collect::<String>();
    let outcome = |names: &[&str]| run(tempfile::tempdir().unwrap().path(), LOADS, &surfaces(names));
    let few = outcome(&["a", "b", "c"]);
    let page = few.outline();
    assert!(page.answer().sentence.starts_with("May the integral replace the sum? Of 3 cases: "));
    assert!(page.answer().lines.is_empty() && page.markdown().contains("![Verdict map](verdicts.svg)"));
    assert_eq!(few.records()["answers"].as_array().unwrap().len(), 3);
    let terminal = few.terminal().unwrap();
    assert_eq!(terminal.matches("May the integral replace the sum?  ").count(), 3, "{terminal}");
    let many = outcome(&["a", "b", "c", "d"]).terminal().unwrap();
    assert!(many.contains("Of 4 cases") && !many.contains("Such surfaces"), "{many}");
}

/// A sweep of separations gives each realisation loads of its own.
#[test]
fn realisations_without_a_common_load_are_not_compared() {
    let several = population("a", 3000, "realisations = 2");
    let page =
        |compare: &str| run(tempfile::tempdir().unwrap().path(), compare, &several).outline().markdown();
    assert!(page("separation = { values = [2, 1] }").contains("the realisations have no load in common"));
    assert!(!page("pressure = { values = [\"20 MPa\"] }").contains("no load in common"));
    let one = page("models = [\"deterministic\"]\npressure = { values = [\"20 MPa\"] }");
    assert!(one.contains("one model was run"), "{one}");
}

/// The library needs no spec: the same map, laws and loads give the same verdicts as the program.
#[test]
fn the_library_gives_the_verdicts_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let map = HeightMap::new([512; 2], [1e-6; 2], waves(512, [32.0, 8.0], 5), 0.0).unwrap();
    map.write_npy(&folder.path().join("map.npy")).unwrap();
    let compare = format!("robustness = false\nrank-models = false\n{LOADS}");
    let surfaces = "[surface.map.file]\npath = \"map.npy\"\npixel = \"1 um\"\n";
    let program: CompareResults = crate::downcast(run(folder.path(), &compare, surfaces));

    let pressures: Vec<f64> =
        program.surfaces[0].cases[0].verdicts.differences.iter().map(|at| at.load).collect();
    let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
    let preparation = Preparation { level: Level::Plane, ..Preparation::none(Neighbours::Four) };
    let surface = SummitSearch::new(preparation).surface("map", &map).unwrap();
    let laws = [LawContact::bare(named("zmc").unwrap(), &steel, &steel).unwrap()];
    let cases = study::verdicts(&surface, &laws, &pressures, Accepted::DEFAULT).unwrap();
    let stretches = |verdicts: &Verdicts| -> Vec<(ComparedQuantity, Verdict, [f64; 2])> {
        verdicts.stretches.iter().map(|stretch| (stretch.quantity, stretch.verdict, stretch.loads)).collect()
    };
    assert_eq!(stretches(&cases[0].verdicts), stretches(verdicts(&program, 0)));
    assert!(
        of(&cases[0].verdicts, ComparedQuantity::Area).any(|stretch| stretch.verdict != Verdict::CannotTell)
    );

    // Its asperities are spheres: an elliptic law has nothing to sum.
    let elliptic = [LawContact::bare(named("elliptic-zmc").unwrap(), &steel, &steel).unwrap()];
    let refused = study::verdicts(&surface, &elliptic, &pressures, Accepted::DEFAULT);
    assert!(matches!(refused, Err(StudyError::NoEllipses(law)) if law == "elliptic-zmc"));
    let with_ellipses = SummitSearch { as_ellipses: true, ..SummitSearch::new(preparation) };
    let surface = with_ellipses.surface("map", &map).unwrap();
    let cases = study::verdicts(&surface, &elliptic, &pressures, Accepted::DEFAULT).unwrap();
    let mut always = ComparedQuantity::ALL.into_iter().filter(|quantity| quantity.spot().is_none());
    assert!(always.all(|quantity| of(&cases[0].verdicts, quantity).next().is_some()));
}
