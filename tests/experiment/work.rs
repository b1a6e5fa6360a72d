//! What a run does, and what it leaves undone.

use std::fs;

use asperity::work::{CountedContact, Counter, Work};
use asperity::{
    Accumulator, Deterministic, Draw, Flat, Heights, MicroContact, Model, ModulusModel, Population,
    ReferencePlane, Shape, Statistical, Zmc,
};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;
use asperity_experiment::kind::compare::results::{CompareResults, SurfaceResults};
use asperity_experiment::surface::FileOptions;

use crate::common::{Random, bodies};
use crate::results::run_in;

const MATERIALS: &str = concat!(
    r#"
title = "work"
seed = 5
"#,
    steel!(),
    lead!()
);

const DRAWN: &str = concat!(
    r#"
[surface.drawn.population]
"#,
    case_1!(),
    r#"count = 3000
"#
);

const BODIES: &str = "[compare]\nrough = \"steel\"\nflat = \"steel\"\n";

/// A folder with two lists of asperities, a map and measured points.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, count) in [("list.csv", 400), ("other.csv", 300)] {
        let rows: String =
            (0..count).map(|i| format!("{:e},{:e}\n", f64::from(i * i % 97) * 1e-9, 2e-5)).collect();
        fs::write(folder.path().join(name), format!("height,radius\n{rows}")).unwrap();
    }
    let height = |ix: u32, iy: u32| format!("{:e}", f64::from((ix * 37 + iy * 91) % 53) * 1e-9);
    let rows = (0..40).map(|iy| (0..50).map(|ix| height(ix, iy)).collect::<Vec<_>>().join(" "));
    fs::write(folder.path().join("map.txt"), rows.collect::<Vec<_>>().join("\n")).unwrap();
    fs::write(folder.path().join("points.csv"), "indentation,load\n1e-8,1e-4\n3e-8,6e-4\n").unwrap();
    folder
}

fn run(spec: &str) -> Box<dyn Outcome> {
    run_in(folder().path(), &format!("{MATERIALS}{spec}")).unwrap()
}

fn work_of(spec: &str) -> Work {
    run(spec).metadata().work.unwrap()
}

/// Results of `[compare]` for steel on steel.
fn compare(words: &str, surfaces: &str) -> (Work, CompareResults) {
    let results: CompareResults = crate::downcast(run(&format!("{BODIES}{words}\n{surfaces}")));
    (results.metadata.work.unwrap(), results)
}

/// Number of asperities of all surfaces above the flat, separation by separation.
fn above(results: &CompareResults, separations: &[f64]) -> u64 {
    let mut count = 0;
    for found in &results.surfaces {
        let (surface, plane) = (&found.surface, found.surface.plane);
        for h in separations {
            let flat = plane.mean + h * plane.sigma;
            count += surface.set.heights().iter().filter(|z| **z > flat).count() as u64;
        }
    }
    count
}

#[test]
fn a_sum_touches_each_asperity_above_the_flat_once_and_nothing_below() {
    let separations = [3.0, 1.5, 0.0, -1.0];
    let list = "[surface.list.asperities]\nfile = \"list.csv\"\nnominal-area = \"1e-8 m^2\"";
    // A law whose load never decreases is not searched for the loads of its own points.
    for models in ["[\"deterministic\"]", "[\"statistical\", \"deterministic\"]"] {
        let words = format!(
            "law = [\"hertz\", \"kogut-etsion\", \"zmc\"]\nmodels = {models}\nseparation = {{ values = [3, 1.5, 0, -1] }}"
        );
        let (work, results) = compare(&words, &format!("{DRAWN}{list}"));
        let touched = above(&results, &separations);
        assert!(touched > 4000);
        assert_eq!(work.asperities_touched, 3 * touched, "{models}");
        assert_eq!((work.coating_calls, work.surfaces_made, work.files_read), (0, 2, 1));
    }
}

#[test]
fn a_flat_above_all_asperities_touches_none() {
    let (work, _) = compare(
        "law = [\"hertz\", \"zmc\"]\nmodels = [\"deterministic\"]\nseparation = { values = [50, 9] }",
        DRAWN,
    );
    assert_eq!(work, Work { surfaces_made: 1, ..Work::default() });
}

#[test]
fn models_that_are_not_requested_do_not_run() {
    let words = |model: &str| {
        format!(
            "law = [\"hertz\", \"zmc\"]\nmodels = [\"{model}\"]\nseparation = {{ values = [3, 0] }}\npressure = {{ values = [\"1 MPa\"] }}"
        )
    };
    let (integral, _) = compare(&words("statistical"), DRAWN);
    assert!(integral.asperities_touched == 0 && integral.nodes > 0, "{integral:?}");
    let (sum, _) = compare(&words("deterministic"), DRAWN);
    assert!(sum.nodes == 0 && sum.asperities_touched > 0, "{sum:?}");
    let (both, _) = compare(&words("statistical\", \"deterministic"), DRAWN);
    assert_eq!(both.asperities_touched, sum.asperities_touched);
    // Besides, the integral is pressed to the loads of the sum.
    assert!(both.nodes > integral.nodes);
}

/// Separation by separation, no load is searched.
#[test]
fn loads_that_are_not_requested_are_not_searched() {
    let words = |separations: &str, more: &str| {
        format!(
            "law = \"zmc\"\nmodels = [\"statistical\"]\nseparation = {{ values = {separations} }}\n{more}"
        )
    };
    let nodes = |separations: &str, more: &str| compare(&words(separations, more), DRAWN).0.nodes;
    let each = [nodes("[3]", ""), nodes("[1]", ""), nodes("[-2]", "")];
    assert_eq!(nodes("[3, 1, -2]", ""), each.iter().sum::<u64>());
    assert!(nodes("[3, 1, -2]", "force = { values = [\"1 mN\"] }") > nodes("[3, 1, -2]", ""));
    // Pressures and forces share the way down to the first.
    let load = |more: &str| nodes("[3]", more) - each[0];
    let (pressure, force) =
        (load("pressure = { values = [\"1 MPa\"] }"), load("force = { values = [\"1 mN\"] }"));
    let both = load("pressure = { values = [\"1 MPa\"] }\nforce = { values = [\"1 mN\"] }");
    assert!(both < pressure + force && both > pressure.max(force), "{both} of {pressure} and {force}");
}

#[test]
fn a_bare_flat_has_no_coating_call() {
    let words = |thickness: &str| {
        format!(
            "layer = {{ material = \"lead\", thickness = {thickness} }}\nlaw = [\"hertz\", \"zmc\"]\nseparation = {{ values = [3, 1] }}"
        )
    };
    let work = |thickness: &str| compare(&words(thickness), DRAWN).0;
    // A thickness in a list is run alone; one that stands alone has the uncoated flat beside it.
    let [none, thin, all] = ["0", "[\"50 nm\"]", "\"inf\""].map(work);
    for bare in [none, all, compare("law = \"zmc\"\nseparation = { values = [3, 1] }", DRAWN).0] {
        assert_eq!(bare.coating_calls, 0);
        assert!(bare.asperities_touched > 0 && bare.nodes > 0 && bare.single_contacts > 0);
    }
    assert!(thin.asperities_touched > 0 && thin.nodes > 0 && thin.single_contacts > 0);
    assert_eq!(thin.coating_calls, thin.asperities_touched + thin.nodes + thin.single_contacts);
    let listed = work("[0, \"50 nm\", \"inf\"]");
    assert_eq!(listed.coating_calls, thin.coating_calls);
    assert_eq!(listed.nodes, none.nodes + thin.nodes + all.nodes);
    assert_eq!(
        listed.asperities_touched,
        none.asperities_touched + thin.asperities_touched + all.asperities_touched
    );
    // What is said of a rule is found with it.
    let rule = |words: &str| compare(words, DRAWN).1.contact.layer.unwrap().check;
    assert!(rule(&words("[0, \"inf\"]")).is_none() && rule(&words("[0, \"50 nm\"]")).is_some());
    // Up to which thickness a layer does not matter is looked for under layers, at admissible loads.
    let searched = words("[0, \"inf\"]") + "\npressure = { values = [\"20 MPa\"] }";
    assert!(rule(&searched).is_some() && compare(&searched, DRAWN).0.coating_calls > 0);
    let bare = words("0") + "\npressure = { values = [\"1 MPa\"] }";
    assert!(rule(&bare).is_none() && compare(&bare, DRAWN).0.coating_calls == 0);
}

#[test]
fn a_layer_is_made_only_where_there_is_one() {
    let [rough, layer, substrate] = bodies(&mut Random::new(1));
    for thickness in [0.0, f64::INFINITY] {
        let flat = Flat::in_thickness(&layer, &substrate, thickness, || panic!("no layer")).unwrap();
        assert!(!flat.under(Zmc::default(), &rough).unwrap().is_layered());
    }
    let flat = Flat::with_layer(&layer, &substrate, 1e-7, ModulusModel::Gao).unwrap();
    assert!(flat.under(Zmc::default(), &rough).unwrap().is_layered());
}

#[test]
fn a_surface_is_made_once_for_all_laws_layers_and_models() {
    let words = "layer = { material = \"lead\", thickness = [0, \"50 nm\", \"inf\"] }\nlaw = [\"hertz\", \"zmc\"]\n\
                 separation = { values = [2] }\npressure = { values = [\"1 MPa\"] }";
    let random = "[surface.random.generate]\npoints = [80, 80]\npixel = \"1 um\"\nsigma = \"0.1 um\"\n\
                  spectrum.gaussian = { correlation-length = \"6 um\" }\nrealisations = 2";
    let (work, results) = compare(words, &format!("{DRAWN}realisations = 3\n{random}"));
    assert_eq!(results.surfaces.iter().map(|found| found.realisations.len()).sum::<usize>(), 5);
    assert_eq!((work.surfaces_made, work.files_read), (5, 0));
    // Of each size some random sets, and one at the quantiles, for all laws.
    let limit = work_of(
        "[limit]\nrough = \"steel\"\nflat = \"steel\"\nlaw = [\"hertz\", \"zmc\"]\nradius = \"20 um\"\nsigma = \"48 nm\"\n\
         density = \"6e10 /m^2\"\nseparation = { values = [1, 0] }\ncount = { values = [100, 1000] }\ndraws = 4",
    );
    assert_eq!((limit.surfaces_made, limit.coating_calls), (2 * 5, 0));
    assert!(limit.nodes > 0 && limit.asperities_touched > 0);
}

#[test]
fn a_file_is_read_once_by_all_surfaces_found_in_it() {
    let list = |name: &str, file: &str, area: f64| {
        format!("[surface.{name}.asperities]\nfile = \"{file}\"\nnominal-area = \"{area:e} m^2\"\n")
    };
    let map = |name: &str, level: &str, pixel: &str| {
        format!("[surface.{name}.file]\npath = \"map.txt\"\npixel = \"{pixel}\"\nlevel = \"{level}\"\n")
    };
    let words = "law = \"hertz\"\nseparation = { values = [2, 0] }\nrobustness = false";
    let files = |surfaces: &[String]| {
        let (work, results) = compare(words, &surfaces.concat());
        assert_eq!(work.surfaces_made, surfaces.len() as u64);
        let numbers = |found: &SurfaceResults| {
            (found.surface.set.clone(), found.cases[0].first().comparison.curves.clone())
        };
        (work.files_read, results.surfaces.iter().map(numbers).collect::<Vec<_>>())
    };
    let all = [
        list("a", "list.csv", 1e-8),
        map("b", "mean", "1 um"),
        list("c", "./list.csv", 2e-8),
        list("d", "other.csv", 1e-8),
        map("e", "plane", "1 um"),
        list("f", "list.csv", 1e-8),
        map("g", "mean", "2 um"),
    ];
    // Two lists, and a map with two pixels.
    let (read, found) = files(&all);
    assert_eq!(read, 4);
    for (surface, found) in all.into_iter().zip(found) {
        assert_eq!(files(&[surface]), (1, vec![found]));
    }
}

#[test]
fn a_ball_is_pressed_once_into_the_flat_without_a_layer_and_all_of_it() {
    let work = |thickness: &str, more: &str| {
        work_of(&format!(
            "[indentation]\nball = \"steel\"\nradius = \"1 mm\"\nflat = \"steel\"\nlaw = [\"hertz\", \"zmc\"]\n\
             layer = {{ material = \"lead\", thickness = {thickness} }}\n\
             indentation = {{ from = \"1 nm\", to = \"100 nm\", points = 3 }}\n{more}"
        ))
    };
    let [one, other, both] = ["\"1 um\"", "\"2 um\"", "[\"1 um\", \"2 um\"]"].map(|t| work(t, ""));
    assert_eq!(one.files_read, 0);
    assert_eq!(both.coating_calls, one.coating_calls + other.coating_calls);
    let bare = |work: &Work| work.single_contacts - work.coating_calls;
    assert!(bare(&one) > 0 && bare(&one) == bare(&other) && bare(&both) == bare(&one));
    let measured = work("\"1 um\"", "overlay = \"points.csv\"");
    assert_eq!((measured.files_read, measured.coating_calls), (1, one.coating_calls + 2 * 2));
}

#[test]
fn a_surface_description_evaluates_no_contacts() {
    let folder = folder();
    let spec = folder.path().join("spec.toml");
    fs::write(&spec, "title = \"t\"\n[surface.a.file]\npath = \"map.txt\"\npixel = \"1 um\"\n").unwrap();
    let found =
        Experiment::describe(&spec, &FileOptions::default(), None, &Silent).unwrap().run(&Silent).unwrap();
    assert_eq!(found.metadata().work, Some(Work { files_read: 1, surfaces_made: 1, ..Work::default() }));
}

/// Counting changes no bit of a result.
#[test]
fn counting_does_not_change_results() {
    let mut random = Random::new(7);
    let [rough, layer, substrate] = bodies(&mut random);
    for thickness in [0.0, 3e-8, f64::INFINITY] {
        let flat = Flat::with_layer(&layer, &substrate, thickness, ModulusModel::Gao).unwrap();
        let contact = flat.under(Zmc::default(), &rough).unwrap();
        let counter = Counter::default();
        let counted = CountedContact::new(&*contact, &counter);
        let population = Population { radius: 2e-5, sigma: 5e-8, density: 6e10, heights: Heights::GAUSSIAN };
        let set = population.set(20_000, Draw::Random([3; 32])).unwrap();
        let plane = ReferencePlane { mean: 0.0, sigma: population.sigma };
        let separations = [2.5, 1.0, 0.0];
        let sum = |contact| Deterministic::new(contact, set.spheres(), plane).respond_all(&separations);
        let integral = |contact| Statistical::new(contact, population.clone()).respond_all(&separations);
        assert_eq!(sum(&counted as &dyn MicroContact), sum(&*contact));
        assert_eq!(integral(&counted as &dyn MicroContact), integral(&*contact));
        let shape = Shape::sphere(2e-5);
        assert_eq!(counted.contact(1e-8, shape), contact.contact(1e-8, shape));
        assert_eq!(counted.load_over(1e-9, 1e-8, shape), contact.load_over(1e-9, 1e-8, shape));
        assert_eq!(counted.breakpoints(shape), contact.breakpoints(shape));
        assert_eq!(counted.regime_changes(shape), contact.regime_changes(shape));
        assert_eq!(counted.may_decrease(shape.into()), contact.may_decrease(shape.into()));
        assert_eq!(counted.reference_modulus(), contact.reference_modulus());
        assert_eq!(counted.reference_hardness(), contact.reference_hardness());
        assert_eq!((counted.papers(), counted.caveat()), (contact.papers(), contact.caveat()));
        assert_eq!(counted.is_layered(), thickness == 3e-8);

        let before = counter.work();
        counted.accumulate_weighted(&[1e-9, 2e-9, 3e-9], &[1.0; 3], shape, &mut Accumulator::default());
        counted.contact(1e-8, shape);
        counted.accumulate(set.spheres(), -1.0, &mut Accumulator::default());
        let work = counter.work();
        assert_eq!(work.nodes - before.nodes, 3);
        assert_eq!(work.single_contacts - before.single_contacts, 1);
        assert_eq!(work.asperities_touched - before.asperities_touched, 20_000);
        let layered = if thickness == 3e-8 { 20_004 } else { 0 };
        assert_eq!(work.coating_calls - before.coating_calls, layered);
    }
}
