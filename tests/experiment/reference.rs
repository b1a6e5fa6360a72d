//! The boundary element reference beside the models: where it runs, what it gives, and that nothing changes without it.

use asperity_contact_framework::Outcome;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;

use crate::Report;
use crate::results::{self, Row, column, figure, number, table, write_map};

mod lines;
mod unscattered;
mod verdicts;

/// A smooth periodic surface of 128 x 128 points, 32 of them per shortest wave.
const SMOOTH: &str = generated!("a", 128, "0.25 um", "20 nm", "16 um" to "8 um");

/// A rough one of 64 x 64 points.
const ROUGH: &str = generated!("a", 64, "1 um", "100 nm", "40 um" to "8 um");

const THREE: &str = "models = [\"statistical\", \"deterministic\", \"reference\"]\n";

/// A comparison in a folder of its own, in which `map.npy` is a tilted map.
fn read(compare: &str, surfaces: &str) -> (tempfile::TempDir, Experiment) {
    let folder = tempfile::tempdir().unwrap();
    write_map(folder.path().join("map.npy"), [60, 50], tilted);
    let head =
        concat!("title = \"t\"\n", steel!(), lead!(), "[compare]\nrough = \"steel\"\nflat = \"steel\"\n");
    let experiment = results::read(folder.path(), &format!("{head}{compare}\n{surfaces}")).unwrap();
    (folder, experiment)
}

fn run(compare: &str, surfaces: &str) -> Box<dyn Outcome> {
    read(compare, surfaces).1.run(&Silent).unwrap()
}

/// Waves on a slope, of which three points are missing.
fn tilted(i: usize, j: usize) -> f64 {
    let (x, y) = (i as f64, j as f64);
    let wave = (0.5 * x).sin() * (0.4 * y).cos() + 0.6 * (0.31 * x + 0.23 * y).sin();
    if i == 20 && j < 3 { f64::NAN } else { 1e-7 * wave + 2e-8 * x }
}

fn of_model(outcome: &dyn Outcome, model: &str) -> Vec<Row> {
    let rows = table(outcome, "curves.csv").unwrap();
    rows.into_iter().filter(|row| row["model"] == model).collect()
}

const SWEEP: &str = "pressure = { from = \"1 MPa\", to = \"100 MPa\", points = 21 }\n";

#[test]
fn nothing_changes_where_no_reference_is_asked_for_and_the_models_do_not_where_it_is() {
    let without = run(&format!("law = \"hertz\"\n{SWEEP}"), ROUGH);
    let with = run(&format!("law = \"hertz\"\n{THREE}{SWEEP}"), ROUGH);
    assert!(table(&*without, "reference.csv").is_none() && table(&*with, "reference.csv").is_some());
    let [plain, beside] = [&without, &with].map(|outcome| table(&**outcome, "comparison.csv").unwrap());
    assert!(plain[0].keys().all(|name| !name.starts_with("reference")), "{:?}", plain[0].keys());
    for (plain, beside) in plain.iter().zip(&beside) {
        assert!(plain.iter().all(|(name, cell)| beside[name] == *cell));
    }
    for model in ["statistical", "deterministic"] {
        let rows = of_model(&*with, model);
        assert_eq!(rows, of_model(&*without, model));
        assert!(rows.iter().all(|row| row["raw_area_ratio"].is_empty()));
    }
    let [plain, beside] = [&without, &with].map(|outcome| table(&**outcome, "reference_curves.csv"));
    assert!(plain.is_none() && beside.unwrap()[0]["boundary"] == "periodic");
    let [plain, beside] = [&without, &with].map(|outcome| outcome.outline().markdown());
    let title = "Which model is nearer to the reference?";
    assert!(!plain.contains(title) && beside.contains(title));
}

#[test]
fn a_sweep_runs_at_some_of_its_loads_and_a_list_at_all() {
    let loads = |compare: &str| {
        let outcome = run(&format!("law = \"hertz\"\n{THREE}{compare}"), ROUGH);
        let rows = of_model(&*outcome, "reference");
        let pairs = table(&*outcome, "comparison.csv").unwrap();
        let filled: Vec<f64> = pairs
            .iter()
            .filter(|row| !row["reference_area_ratio"].is_empty())
            .map(|row| {
                assert_eq!(row["pairing"], "load");
                assert_eq!(number(row, "target"), number(row, "reference_pressure_pa"));
                number(row, "target")
            })
            .collect();
        let pressures = column(&rows, "pressure_pa");
        // A row of each load of the reference.
        assert!(pressures.iter().all(|pressure| filled.contains(pressure)), "{pressures:?} {filled:?}");
        (pressures, filled.len(), pairs.len())
    };
    let (pressures, filled, pairs) = loads(SWEEP);
    assert_eq!((pressures.len(), filled, pairs), (9, 9, 21));
    assert_eq!((pressures[0], pressures[8]), (1e6, 1e8));
    let (pressures, ..) = loads(&format!("{SWEEP}reference = {{ loads = 3 }}"));
    assert_eq!(pressures.len(), 3);
    assert!((pressures[1] / 1e7 - 1.0).abs() < 1e-12);
    let (pressures, ..) = loads(&format!("{SWEEP}reference = {{ loads = 1 }}"));
    assert!(
        pressures.len() == 1 && (pressures[0] / 1e7 - 1.0).abs() < 1e-12,
        "the middle one: {pressures:?}"
    );
    let twelve: Vec<String> = (1..=12).map(|k| format!("\"{k} MPa\"")).collect();
    let (pressures, ..) = loads(&format!("pressure = [{}]", twelve.join(", ")));
    assert_eq!(pressures.len(), 12);
    // On an area of 64 x 64 um^2.
    let (pressures, ..) = loads("force = [\"4.096 mN\", \"40.96 mN\"]");
    assert!(pressures.iter().zip([1e6, 1e7]).all(|(found, asked)| (found / asked - 1.0).abs() < 1e-12));
}

#[test]
fn under_a_separation_sweep_it_runs_at_the_loads_of_a_model() {
    let spec = "separation = { from = 3, to = 0, points = 31 }\nreference = { loads = 4 }\n";
    for (models, kind) in
        [("\"deterministic\", \"statistical\", ", "deterministic"), ("\"statistical\", ", "statistical")]
    {
        let outcome = run(&format!("law = \"hertz\"\nmodels = [{models}\"reference\"]\n{spec}"), ROUGH);
        let carried: Vec<f64> = column(&of_model(&*outcome, kind), "pressure_pa");
        let rows = of_model(&*outcome, "reference");
        assert_eq!(rows.len(), 4, "{kind}");
        assert!(
            rows.iter()
                .all(|row| row["control"] == "pressure" && carried.contains(&number(row, "pressure_pa")))
        );
        assert_eq!(number(&rows[3], "pressure_pa"), carried[30], "{kind}");
        let pairs = table(&*outcome, "comparison.csv").unwrap();
        let filled = pairs.iter().filter(|row| !row["reference_area_ratio"].is_empty()).count();
        assert_eq!(filled, if kind == "deterministic" { 4 } else { 0 });
    }
}

/// At light loads contacts are few and far apart, so that spheres on well resolved summits are near the reference: the
/// separation counts from the same plane, the area from the same pair.
#[test]
fn at_light_loads_it_is_near_the_sum() {
    let outcome =
        run(&format!("law = \"hertz\"\n{THREE}pressure = [\"2 MPa\", \"2.5 MPa\", \"3 MPa\"]"), SMOOTH);
    let [sum, reference] = ["deterministic", "reference"].map(|model| of_model(&*outcome, model));
    let solved = table(&*outcome, "reference.csv").unwrap();
    for ((sum, reference), solved) in sum.iter().zip(&reference).zip(&solved) {
        let area = number(reference, "area_ratio") / number(sum, "area_ratio");
        assert!((area - 1.0).abs() < 0.15, "{area}");
        let [far, near] = [reference, sum].map(|row| number(row, "separation_over_sigma"));
        assert!((far - near).abs() < 0.15, "{far} {near}");
        let d = number(solved, "mean_gap_m") - number(solved, "plane_offset_m");
        assert!((d - number(reference, "separation_m")).abs() < 1e-20);
        assert!(number(reference, "raw_area_ratio") > number(reference, "area_ratio"));
        assert!(number(solved, "dual_gap") <= 1e-6);
    }
    // At every load, and between the slopes to its neighbours.
    let [d, p] = ["separation_m", "pressure_pa"].map(|name| column(&reference, name));
    let slope = |k: usize| (p[k + 1] - p[k]) / (d[k] - d[k + 1]);
    let stiffness = column(&reference, "stiffness_pa_per_m");
    assert!(stiffness[0] < slope(0) && slope(0) < stiffness[1], "{stiffness:?}");
    assert!(stiffness[1] < slope(1) && slope(1) < stiffness[2], "{stiffness:?}");
    for (far, sum) in stiffness.iter().zip(&sum) {
        assert!((far / number(sum, "stiffness_pa_per_m") - 1.0).abs() < 0.3, "{far}");
    }
}

#[test]
fn laws_that_yield_have_the_hardness_as_cap_and_laws_of_one_cap_share_a_solution() {
    let spec = format!(
        "law = [\"hertz\", \"zmc\", \"kogut-etsion\"]\n{THREE}pressure = [\"10 MPa\", \"300 MPa\"]\n"
    );
    let caps = |keys: &str| {
        let outcome = run(&format!("{spec}{keys}"), &ROUGH.replace("100 nm", "400 nm"));
        let rows = table(&*outcome, "reference.csv").unwrap();
        let of = |law: &str| -> Vec<Row> {
            let own = rows.iter().filter(|row| row["law"] == law).cloned();
            own.map(|row| row.into_iter().filter(|(name, _)| name != "law").collect()).collect()
        };
        ["hertz", "zmc", "kogut-etsion"].map(of)
    };
    let [hertz, zmc, other] = caps("");
    assert!(hertz.iter().all(|row| row["cap_pa"].is_empty()));
    assert!(zmc.iter().all(|row| number(row, "cap_pa") == 7.6e9));
    assert_eq!(zmc, other);
    assert_ne!(hertz, zmc);
    assert!(number(&zmc[1], "capped_area_ratio") > 0.0 && number(&hertz[1], "capped_area_ratio") == 0.0);
    let all = caps("reference = { cap = \"none\" }");
    assert!(all.iter().all(|rows| *rows == hertz));
    let all = caps("reference = { cap = \"hardness\" }");
    assert!(all.iter().all(|rows| *rows == zmc));
}

#[test]
fn under_a_layer_it_is_elastic_and_says_so_and_loads_above_the_hardness_are_left_out() {
    let layer = "layer = { material = \"lead\", thickness = [0, \"200 nm\", \"inf\"] }\n";
    let spec = format!("law = \"zmc\"\n{THREE}{layer}pressure = [\"10 MPa\", \"200 MPa\"]\n");
    let (_folder, experiment) = read(&spec, ROUGH);
    let words = "law zmc, thickness 200 nm: the reference is elastic under a layer of finite thickness";
    assert!(experiment.to_string().contains(words), "{experiment}");
    let outcome = experiment.run(&Silent).unwrap();
    let text = outcome.outline().markdown();
    assert!(text.contains("it stays elastic although contacts yield under law zmc"), "{text}");
    let rows = table(&*outcome, "reference.csv").unwrap();
    let found: Vec<(&str, &str)> =
        rows.iter().map(|row| (&*row["layer_thickness_m"], &*row["cap_pa"])).collect();
    let [bare, layered, bulk] = [("0.0", "7600000000.0"), ("2e-7", ""), ("inf", "170000000.0")];
    assert_eq!(found, [bare, bare, layered, layered, bulk]);
    assert_eq!(table(&*outcome, "reference_curves.csv").unwrap()[2]["unreached_loads"], "1");
}

const MEASURED: &str = "[surface.m.file]\npath = \"map.npy\"\npixel = \"1 um\"\n";

#[test]
fn a_measured_map_is_levelled_and_mirrored_and_a_finite_patch_has_no_separation() {
    let spec = format!(
        "law = \"hertz\"\n{THREE}pressure = [\"5 MPa\", \"8 MPa\", \"12 MPa\"]\nrobustness = false\n"
    );
    let mirrored = run(&spec, MEASURED);
    let rows = table(&*mirrored, "reference.csv").unwrap();
    assert!(rows.iter().all(|row| row["boundary"] == "mirrored" && row["interpolated_points"] == "3"));
    let level = of_model(&*mirrored, "reference");
    let tilted = of_model(&*run(&spec, &format!("{MEASURED}level = \"mean\"\n")), "reference");
    // On its slope of 1.2 um one side of the map alone is in contact.
    assert!(number(&tilted[0], "separation_m") > 2.0 * number(&level[0], "separation_m").abs());
    let periodic = run(&format!("{spec}reference = {{ boundary = \"periodic\" }}\n"), MEASURED);
    assert!(table(&*periodic, "reference.csv").unwrap().iter().all(|row| row["boundary"] == "periodic"));
    let finite = run(&format!("{spec}reference = {{ boundary = \"finite\" }}\n"), MEASURED);
    for row in of_model(&*finite, "reference") {
        for name in ["separation_m", "separation_over_sigma", "stiffness_pa_per_m"] {
            assert!(row[name].is_empty(), "{name}");
        }
        assert!(number(&row, "area_ratio") > 0.0);
    }
}

/// On well resolved waves four times the points change little; the correction for the perimeter shrinks.
#[test]
fn a_refined_map_gives_nearly_the_same_on_twice_the_points() {
    let spec = format!("law = \"hertz\"\n{THREE}pressure = [\"20 MPa\"]\nrobustness = false\n");
    for (surface, name) in [(SMOOTH, "a"), (MEASURED, "m")] {
        let coarse = run(&spec, surface);
        let fine = run(&format!("{spec}reference = {{ refine = 2 }}"), surface);
        let [coarse, fine] = [&coarse, &fine].map(|outcome| {
            assert!(figure(&**outcome, &format!("{name}-reference-contact.svg")).is_some());
            let row = &table(&**outcome, "reference.csv").unwrap()[0];
            (
                row["interpolated_points"].clone(),
                ["area_ratio", "raw_area_ratio", "mean_gap_m"].map(|name| number(row, name)),
            )
        });
        assert_eq!(coarse.0, fine.0);
        let ([area, raw, gap], [finer, finer_raw, finer_gap]) = (coarse.1, fine.1);
        assert!(area != finer && (finer / area - 1.0).abs() < 0.04, "{area} {finer}");
        assert!((finer_gap / gap - 1.0).abs() < 0.01, "{gap} {finer_gap}");
        assert!(finer_raw - finer < 0.7 * (raw - area), "{raw} {area} {finer_raw} {finer}");
    }
    let (_folder, experiment) = read(&format!("{spec}reference = {{ refine = 2 }}"), SMOOTH);
    assert!(experiment.to_string().contains("256 x 256 points"), "{experiment}");
    assert_eq!(table(&*experiment.run(&Silent).unwrap(), "reference_curves.csv").unwrap()[0]["refine"], "2");
}

#[test]
fn a_map_with_many_missing_points_is_refused() {
    let (folder, experiment) =
        read("law = \"hertz\"\nmodels = [\"reference\"]\npressure = \"5 MPa\"\n", MEASURED);
    write_map(folder.path().join("map.npy"), [60, 50], |i, j| {
        let k = 50 * i + j;
        if k % 80 == 0 { f64::NAN } else { 1e-7 * (k as f64).sin() }
    });
    let Err(error) = experiment.run(&Silent) else { panic!("it ran") };
    let error = error.to_string();
    assert!(error.contains("compare.models: surface m: reference: 38 of 3000 points are missing"), "{error}");
}

#[test]
fn it_runs_alone_at_one_load_and_at_several() {
    for loads in ["\"5 MPa\"", "[\"5 MPa\", \"20 MPa\"]"] {
        for layer in ["", "layer = { material = \"lead\", thickness = [0, \"200 nm\"] }\n"] {
            let spec = format!("law = \"zmc\"\n{layer}models = [\"reference\"]\npressure = {loads}\n");
            let outcome = run(&spec, &format!("{ROUGH}realisations = 2\n"));
            let count = loads.matches("MPa").count() * if layer.is_empty() { 1 } else { 2 };
            assert_eq!(table(&*outcome, "curves.csv").unwrap().len(), 2 * count);
            assert_eq!(of_model(&*outcome, "reference").len(), 2 * count);
            let text = outcome.outline().markdown();
            let said = ["boundary elements alone were run", "not compared at equal load in any case"];
            assert!(text.contains(said[usize::from(!layer.is_empty())]), "{text}");
            assert!(!text.contains("NaN") && !text.contains("inf,"), "{text}");
            assert!(outcome.records()["verdicts"].as_array().unwrap().is_empty());
        }
    }
}

#[test]
fn one_load_is_answered_beside_both_models() {
    let outcome = run(&format!("law = \"hertz\"\n{THREE}force = \"8 mN\"\n"), SMOOTH);
    let rows = table(&*outcome, "results.csv").unwrap();
    let models: Vec<&str> = rows.iter().map(|row| row["model"].as_str()).collect();
    assert_eq!(models, ["statistical", "deterministic", "reference"]);
    for row in &rows {
        assert!((number(row, "force_n") / 8e-3 - 1.0).abs() < 1e-6, "{row:?}");
        let ratio =
            number(row, "force_n") / number(row, "real_area_m2") / number(row, "mean_real_pressure_pa");
        assert!((ratio - 1.0).abs() < 1e-9, "{row:?}");
    }
    assert!(rows[2]["contacts"].is_empty());
    let [sum, reference] = [1, 2].map(|model| number(&rows[model], "stiffness_n_per_m"));
    assert!((reference / sum - 1.0).abs() < 0.3, "{reference} {sum}");
    assert!(outcome.outline().markdown().contains("## Results"));
}

#[test]
fn results_are_the_same_on_any_number_of_threads() {
    let spec = format!("law = [\"hertz\", \"zmc\"]\n{THREE}pressure = [\"10 MPa\", \"100 MPa\"]\n");
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let outcome = run(&spec, SMOOTH);
            let figures: Vec<String> =
                outcome.outline().files(None).figures.into_iter().map(|(_, svg)| svg).collect();
            (outcome.files(), figures)
        })
    };
    assert!(on(1) == on(3));
}

#[test]
fn the_contact_is_shown_with_the_asperities_of_the_sum() {
    let outcome = run(&format!("law = \"hertz\"\n{THREE}{SWEEP}"), SMOOTH);
    let contact = figure(&*outcome, "a-reference-contact.svg").unwrap();
    assert!(contact.contains("in contact in the sum and in the reference"));
    assert!(figure(&*outcome, "a-reference-pressures.svg").is_some());
    assert!(figure(&*outcome, "a-models.svg").unwrap().contains("reference"));
    assert!(outcome.outline().markdown().contains("touch here (rings"));
    let (_folder, experiment) = read(&format!("law = \"hertz\"\nmodels = [\"reference\"]\n{SWEEP}"), SMOOTH);
    assert!(!experiment.run(&Silent).unwrap().outline().markdown().contains("touch here (rings"));
}

#[test]
fn a_check_says_its_size_time_and_memory() {
    let (_folder, experiment) = read(&format!("law = [\"hertz\", \"ceb\"]\n{THREE}{SWEEP}"), SMOOTH);
    let line = experiment.to_string();
    let line = line.lines().find(|line| line.contains("reference on a")).unwrap();
    for words in ["128 x 128 points", "periodic", "dual gap 1e-6", "18 loads", " s on 2 cores", " MB"] {
        assert!(line.contains(words), "{words}: {line}");
    }
}

#[test]
fn a_map_too_coarse_for_its_shortest_wave_is_warned_of() {
    let of = |reference: &str, surface: &str| {
        let spec = format!("law = \"hertz\"\n{THREE}pressure = \"10 MPa\"\nrobustness = false\n{reference}");
        let (_folder, experiment) = read(&spec, surface);
        let plan = experiment.to_string();
        let warnings = experiment.run(&Silent).unwrap().warnings();
        let found = warnings.into_iter().find(|warning| warning.contains("points per shortest wave"));
        assert_eq!(found.is_some(), plan.contains("points per shortest wave"), "{plan}");
        assert!(found.as_ref().is_none_or(|warning| plan.contains(&format!("  warning: {warning}"))));
        found
    };
    let spectrum = |shape: &str| {
        let self_affine = "self-affine = { hurst = 0.8, roll-off = \"40 um\", cut-off = \"8 um\" }";
        ROUGH.replace(self_affine, &format!("{shape} = {{ correlation-length = \"5 um\" }}"))
    };
    let cut_off = |points: &str| ROUGH.replace("\"8 um\"", &format!("\"{points} um\""));
    let filtered = |s: &str| format!("{MEASURED}filter = {{ s = \"{s} um\" }}\n");
    let finer = "reference = { refine = 2 }\n";
    // Resolved: four points and more.
    for (reference, surface) in [
        ("", cut_off("4")),
        ("", filtered("4")),
        (finer, cut_off("2")),
        (finer, filtered("2")),
        (finer, MEASURED.to_owned()),
        // Waves of twelve points, as the map itself says.
        ("", MEASURED.to_owned()),
        ("", spectrum("gaussian")),
    ] {
        assert_eq!(of(reference, &surface), None, "{surface}");
    }
    for (surface, points) in [
        (cut_off("3.9"), "3.9 points per shortest wave, fewer"),
        (filtered("3"), "3 points per shortest wave, fewer"),
        (spectrum("exponential"), "2 points per shortest wave, fewer"),
    ] {
        let warning = of("", &surface).unwrap();
        assert!(
            !warning.contains("  ")
                && warning.contains(points)
                && warning.contains("`reference = { refine = 2 }`"),
            "{warning}"
        );
    }
}

#[test]
fn a_measured_map_of_noise_is_too_coarse() {
    let (folder, _) = read("law = \"hertz\"\npressure = \"10 MPa\"", MEASURED);
    let noise = |k: usize| 1e-8 * ((k * k * 7919 % 104729) as f64 / 104729.0);
    write_map(folder.path().join("map.npy"), [50, 60], |i, j| noise(60 * i + j));
    let spec = std::fs::read_to_string(folder.path().join("t.toml")).unwrap();
    let results = results::run_in(folder.path(), &spec.replace("law =", &format!("{THREE}law ="))).unwrap();
    let is_told = |warning: &String| warning.contains("reference on surface m: 2 points per shortest wave");
    assert!(results.warnings().iter().any(is_told), "{:?}", results.warnings());
}

/// At a pressure that no contact carries the answer says why there are no boundary elements, and does not send the reader to them.
#[test]
fn a_pressure_above_the_hardness_is_named_in_the_answer() {
    let fine = ROUGH.replace("40 um", "20 um").replace("8 um", "3 um");
    let at = |pressure: &str| {
        let sweep = "separation = { from = 3, to = 1, points = 5 }\nreference = { loads = 2 }";
        run(&format!("law = \"zmc\"\n{THREE}pressure = {{ values = [\"{pressure}\"] }}\n{sweep}"), &fine)
            .terminal()
            .unwrap()
    };
    let above = at("8 GPa");
    assert!(above.contains("None: no contact carries so high a pressure."), "{above}");
    assert!(
        above.contains("A load that the surface can bear") && !above.contains("Boundary elements."),
        "{above}"
    );
    let below = at("2 GPa");
    assert!(
        below.contains("boundary elements ")
            && below.contains("Use instead                        Boundary elements"),
        "{below}"
    );
    assert!(!below.contains("so high a pressure") && !below.contains("can bear"), "{below}");
}
