//! Random specs, of keys that are known and values that are allowed: each is planned or refused with its line and key, runs or is refused with
//! them, and gives the same report on any number of threads.

use std::fs;
use std::path::Path;

use asperity_contact_framework::folder;
use asperity_contact_framework::input::InputError;
use asperity_contact_framework::progress::Silent;
use asperity_experiment::Experiment;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::{Config, RngSeed};

/// Keys, each with some of its values.
type Keys = &'static [(&'static str, &'static [&'static str])];

const MATERIAL: Keys = &[
    ("hardness", &[r#""7.6 GPa""#, r#""0.17 GPa""#, r#""1 TPa""#, r#""1 MPa""#]),
    ("yield-strength", &[r#""60 MPa""#, r#""2.7 GPa""#]),
    ("resistivity", &[r#""143 nohm m""#]),
    ("thermal-conductivity", &[r#""50 W/(m K)""#]),
];

const LAWS: &[&str] = &[
    r#""zmc""#,
    r#""hertz""#,
    r#""ceb""#,
    r#""kogut-etsion""#,
    r#""jackson-green""#,
    r#""fully-plastic""#,
    r#""elliptic-hertz""#,
    r#"["hertz", { zmc = { transition-ratio = 110 } }]"#,
];

/// Keys of `[compare]` beside bodies, law and loads.
const COMPARE: Keys = &[
    (
        "layer",
        &[
            r#"{ material = "b", thickness = "50 nm" }"#,
            r#"{ material = "a", thickness = [0, "1 nm", "inf"], rule = "series" }"#,
            r#"{ material = "a", thickness = "1 um", on = "rough" }"#,
        ],
    ),
    ("conductance", &[r#""electrical""#, r#"{ thermal = {}, electrical = { film = "1e-12 ohm m^2" } }"#]),
    ("shear-strength", &[r#"{ tau0 = "20 MPa", alpha = 0.05 }"#, r#"{ tau0 = 0, alpha = 0.1 }"#]),
    ("models", &[r#"["deterministic", "statistical"]"#, r#"["statistical"]"#]),
    ("lines", &[r#"["persson"]"#, r#"["persson", "bush-gibson-thomas"]"#]),
    (
        "statistical",
        &[
            r#"{ heights = "own" }"#,
            r#"{ heights = "fitted-weibull", mean-radius = "in-contact" }"#,
            r#"{ model = "five-point" }"#,
        ],
    ),
    ("accept", &[r#"{ area = "5 %" }"#, r#"{ separation = "20 nm", stiffness = 1 }"#]),
    ("robustness", &["false", "true"]),
    ("attribution", &["false", "true"]),
    ("rank-models", &["false", "true"]),
];

/// Loads, of which `[compare]` needs one.
const LOADS: &[&str] = &[
    r#"pressure = "1 MPa""#,
    "separation = { from = 3, to = -3, points = 7 }",
    "separation = [2, 1, 0]\npressure = [\"1 MPa\", \"10 MPa\"]",
    r#"pressure = { from = "1 kPa", to = "10 GPa", points = 5 }"#,
    r#"force = ["1 mN", "1 N"]"#,
    "force = \"1 N\"\nnominal-area = \"1 mm^2\"",
    "separation = { from = 38, to = 20, points = 2 }",
    "separation = 1\nforce = \"1e-20 N\"",
];

const POPULATION: Keys = &[
    ("curvature-ratio", &["2", "1", "1e6"]),
    (
        "heights",
        &[
            r#""exponential""#,
            r#""surface""#,
            "{ weibull = { shape = 2 } }",
            "{ weibull = { shape = 0.1 } }",
            "{ johnson = { skewness = -1, kurtosis = 4.5 } }",
        ],
    ),
    ("draw", &[r#""quantiles""#, r#""random""#]),
    ("realisations", &["2", "3"]),
];

const SPECTRA: &[&str] = &[
    r#"self-affine = { hurst = 0.8, roll-off = "20 um", cut-off = "4 um" }"#,
    r#"self-affine = { hurst = 0, roll-off = "4 um", cut-off = "2 um", elongation = 4 }"#,
    r#"gaussian = { correlation-length = ["4 um", "2 um"], angle = "30 deg" }"#,
    r#"exponential = { correlation-length = "3 um" }"#,
];

const GENERATED: Keys = &[
    ("heights", &[r#""exponential""#, "{ johnson = { skewness = -1, kurtosis = 4.5 } }"]),
    ("neighbours", &[r#""eight""#, r#""four""#]),
    ("realisations", &["2"]),
];

const MEASURED: Keys = &[
    ("missing", &["3", "[]"]),
    ("transpose", &["true"]),
    ("periodic", &["true"]),
    ("outliers", &[r#""remove""#]),
    ("align-lines", &[r#""x""#, r#""y""#]),
    ("tip", &[r#""1 um""#, r#""1 mm""#]),
    ("level", &[r#""none""#, r#""plane""#, r#""cubic""#]),
    (
        "filter",
        &[r#"{ s = "3 um" }"#, r#"{ l = "20 um" }"#, r#"{ s = "1 mm" }"#, r#"{ s = "9 um", l = "3 um" }"#],
    ),
];

/// A `share` of the keys, each with one of its values.
fn some(keys: Keys, share: f64) -> impl Strategy<Value = String> {
    let line = move |&(name, values): &(&'static str, &'static [&'static str])| {
        let value = proptest::option::weighted(share, select(values));
        value.prop_map(move |value| value.map_or_else(String::new, |value| format!("{name} = {value}\n")))
    };
    keys.iter().map(line).collect::<Vec<_>>().prop_map(|lines| lines.concat())
}

fn material(name: &'static str) -> impl Strategy<Value = String> {
    let young = select(&[r#""210 GPa""#, r#""18 GPa""#, r#""1 MPa""#, r#""100 TPa""#][..]);
    (young, select(&["0.3", "0", "0.5"][..]), some(MATERIAL, 0.9)).prop_map(
        move |(young, poisson, others)| {
            format!("[material.{name}]\nyoung = {young}\npoisson = {poisson}\n{others}\n")
        },
    )
}

/// A surface, `with_map` one of a height map.
fn surface(with_map: bool) -> impl Strategy<Value = String> {
    let sigma = select(&[r#""48 nm""#, r#""1 um""#, r#""1 pm""#][..]);
    let population = (1u32..600, sigma, some(POPULATION, 0.3)).prop_map(|(count, sigma, others)| {
        let heights = format!("radius = \"20 um\"\nsigma = {sigma}\ndensity = \"6e10 /m^2\"\n");
        format!("population]\n{heights}count = {count}\n{others}")
    });
    let file = select(&["list.csv", "list.npy"][..]);
    let listed = file.prop_map(|file| format!("asperities]\nfile = \"{file}\"\nnominal-area = \"1 mm^2\"\n"));
    let generated =
        (40u32..80, select(SPECTRA), some(GENERATED, 0.3)).prop_map(|(points, spectrum, others)| {
            let size = format!("points = {points}\npixel = \"1 um\"\nsigma = \"0.1 um\"\n");
            format!("generate]\n{size}spectrum.{spectrum}\n{others}")
        });
    let measured = some(MEASURED, 0.2)
        .prop_map(|others| format!("file]\npath = \"map.txt\"\npixel = \"1 um\"\nunit = \"nm\"\n{others}"));
    let maps = prop_oneof![generated, measured].boxed();
    let table = if with_map { maps } else { prop_oneof![population, listed, maps].boxed() };
    table.prop_map(|table| format!("[surface.s.{table}\n"))
}

/// A spec of one of the kinds that take surfaces.
fn spec() -> impl Strategy<Value = String> {
    let bodies = |law: &str| format!("rough = \"a\"\nflat = \"b\"\nlaw = {law}\n");
    let compare = (some(COMPARE, 0.2), select(LOADS), select(LAWS), surface(false)).prop_map(
        move |(others, loads, law, surface)| format!("[compare]\n{}{others}{loads}\n{surface}", bodies(law)),
    );
    let laws = (select(LAWS), surface(false)).prop_map(move |(law, surface)| {
        let asperity = "asperity = { radius = \"20 um\", curvature-ratio = 3 }\n\
                        indentation = { from = 1e-2, to = 1e3, points = 9 }\n";
        let law = if law.starts_with('[') { law.to_owned() } else { format!("[\"ceb\", {law}]") };
        format!("[laws]\n{}{asperity}pressure = \"1 MPa\"\n{surface}", bodies(&law))
    });
    let tiled = (select(LAWS), surface(false)).prop_map(move |(law, surface)| {
        let surface = surface.replace("list.csv", "list.npy");
        format!("[tiled]\n{}separation = {{ from = 3, to = 0, points = 4 }}\n{surface}", bodies(law))
    });
    let intervals = select(&["[1, 2, 4]", "[1, 2, 3, 5]", "[1]"][..]);
    let interval =
        (intervals, select(&LAWS[..7]), surface(true)).prop_map(move |(intervals, law, surface)| {
            format!(
                "[sampling-interval]\n{}pressure = \"1 MPa\"\nintervals = {intervals}\n{surface}",
                bodies(law)
            )
        });
    let kind = prop_oneof![6 => compare, 1 => laws, 2 => tiled, 1 => interval];
    let parts = (any::<u32>(), material("a"), material("b"), kind);
    parts.prop_map(|(seed, a, b, kind)| format!("title = \"random\"\nseed = {seed}\n\n{a}{b}{kind}"))
}

/// A folder with the files that specs name.
fn place() -> tempfile::TempDir {
    let place = tempfile::tempdir().unwrap();
    let row = |k: u32| format!("{}, {}, {}, {}\n", f64::from(k * k % 97), 20_000 + k % 7, 6e-5, 4e-5);
    let rows: String = (0..200).map(row).collect();
    let header = "height [nm], radius [nm], kx [1/nm], ky [1/nm]\n";
    fs::write(place.path().join("list.csv"), header.to_owned() + &rows).unwrap();
    let value = |k: u32| [f64::from(k * k % 97) * 1e-9, 2e-5, 6e4, 4e4][k as usize % 4];
    let list = fs::File::create(place.path().join("list.npy")).unwrap();
    asperity::npy::write(list, [200, 4], (0..800).map(value)).unwrap();
    // Waves, with steps of a nanometre.
    let z = |x: u32, y: u32| {
        (90.0 * (f64::from(x) / 3.0).sin() * (f64::from(y) / 4.0 + f64::from(x * y % 7)).cos()).round()
    };
    let line = |y: u32| (0..64).map(|x| z(x, y).to_string() + " ").collect::<String>() + "\n";
    fs::write(place.path().join("map.txt"), (0..60).map(line).collect::<String>()).unwrap();
    place
}

/// Whether an error names a line and a key, and no type of the program.
fn is_of_a_key(error: &InputError, path: &Path) -> bool {
    let text = error.to_string();
    text.starts_with(&format!("{}, line ", path.display()))
        && error.key().is_some()
        && !text.contains("struct ")
}

/// All files of the report, but for times.
fn report(experiment: &Experiment, threads: usize) -> Result<Vec<(String, Vec<u8>)>, InputError> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let results = experiment.run(&Silent)?;
        let folder = folder(&*results, "key").expect("a report of any results");
        let files = folder.files().filter(|(name, _)| *name != "timing.json");
        Ok(files.map(|(name, content)| (name.to_owned(), content.to_vec())).collect())
    })
}

/// The same specs in every run; others and more by the environment variable `PROPTEST_CASES`.
fn config() -> Config {
    let config = Config { failure_persistence: None, ..Config::default() };
    match std::env::var("PROPTEST_CASES") {
        Ok(_) => config,
        Err(_) => Config { cases: 60, rng_seed: RngSeed::Fixed(44), ..config },
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_spec_runs_or_is_refused_with_its_key(spec in spec()) {
        let place = place();
        let path = place.path().join("random.toml");
        fs::write(&path, &spec).unwrap();
        match Experiment::read(&path) {
            Err(error) => { prop_assert!(is_of_a_key(&error, &path), "{error}") }
            Ok(experiment) => match [1, 3].map(|threads| report(&experiment, threads)) {
                [Ok(one), Ok(three)] => {
                    prop_assert!(one.len() > 3);
                    for ((name, one), (_, three)) in one.iter().zip(&three) {
                        prop_assert!(one == three, "{name} on 1 and 3 threads");
                    }
                    prop_assert_eq!(one.len(), three.len());
                }
                [Err(one), Err(three)] => {
                    prop_assert_eq!(&one, &three);
                    prop_assert!(is_of_a_key(&one, &path), "{one}");
                }
                _ => prop_assert!(false, "runs on 1 or on 3 threads only"),
            },
        }
    }
}
