//! Conductance and friction of `[compare]`, and tables of joints for other programs.

use asperity::HeightMap;
use asperity::bem::Boundary;
use asperity::compare::{Cause, ComparedQuantity, Order, Verdict};
use asperity::spot::{SpotQuantity, cluster_conductance};
use asperity_contact_framework::Outcome;
use asperity_contact_framework::report::format::quantity;
use asperity_experiment::export::{
    Format, InterfaceOptions, InterfaceTable, TableModel, UnitSystem, interface_files, interface_tables,
};
use asperity_experiment::kind::compare::results::{CompareResults, SurfaceResults};

use crate::Report;
use crate::results::{self, table};

const BODIES: &str = concat!("title = \"t\"\nseed = 3\n", conducting!());

const MAP: &str = generated!("map", 512, "1 um", "100 nm", "40 um" to "8 um");

const PRESSURES: &str = "pressure = { from = \"1 MPa\", to = \"20 MPa\", points = 5 }";

fn run(compare: &str, surface: &str) -> Result<Box<dyn Outcome>, String> {
    let compare = format!("[compare]\nrough = \"steel\"\nflat = \"steel\"\n{compare}\n");
    results::run(&[BODIES, &compare, surface].concat())
}

fn compared(compare: &str, surface: &str) -> CompareResults {
    crate::downcast(run(compare, surface).unwrap())
}

fn population(count: usize) -> String {
    results::population("a", count, "")
}

/// E* s of two steel bodies: conductances are stiffnesses over it where nothing yields.
fn electrical(results: &CompareResults) -> f64 {
    results.contact.reduced_modulus * 143e-9
}

#[test]
fn without_yielding_conductance_is_stiffness_in_models_and_reference() {
    let models = "models = [\"statistical\", \"deterministic\", \"reference\"]";
    let results = compared(
        &format!("law = \"hertz\"\nconductance = [\"electrical\", \"thermal\"]\n{models}\n{PRESSURES}"),
        MAP,
    );
    let case = results.surfaces[0].cases[0].first();
    let factor = electrical(&results);
    for pair in case.comparison.pairs_at_load() {
        for response in [pair.statistical, pair.deterministic] {
            let [electrical, thermal, shear, _] = response.spots;
            assert!((electrical * factor / response.stiffness - 1.0).abs() < 1e-11);
            // k = 50 W/(m K) on both sides.
            assert!((thermal / electrical / (143e-9 * 50.0) - 1.0).abs() < 1e-12 && shear == 0.0);
        }
    }
    let reference = case.reference.as_ref().unwrap();
    assert!(reference.boundary == Boundary::Periodic && reference.points.len() > 2);
    for point in &reference.points {
        let conductance = point.value(ComparedQuantity::ElectricalConductance).unwrap();
        assert!((conductance * factor / point.stiffness.unwrap() - 1.0).abs() < 1e-9);
    }
    // Their differences are those of the stiffness, and so are the verdicts.
    let verdicts = &results.surfaces[0].cases[0].verdicts;
    for at in &verdicts.differences {
        let of = |quantity: ComparedQuantity| at.estimates[quantity as usize].unwrap();
        let (stiffness, conductance) =
            (of(ComparedQuantity::Stiffness), of(ComparedQuantity::ElectricalConductance));
        assert!((stiffness.contrast - conductance.contrast).abs() < 1e-9);
        assert_eq!(stiffness.error.is_some(), conductance.error.is_some());
        let errors = stiffness.error.zip(conductance.error);
        assert!(errors.is_none_or(|(one, other)| (one / other - 1.0).abs() < 1e-6));
    }
    let [statistical, _] = &verdicts.reference.as_ref().unwrap().against.models;
    assert!(
        statistical.iter().all(|at| at.estimates[ComparedQuantity::ThermalConductance as usize].is_some())
    );
}

/// tau0 A/F + alpha, exactly: ln(mu - alpha) differs as ln(A) does.
#[test]
fn friction_follows_the_area() {
    let results = compared(
        &format!("law = \"zmc\"\nshear-strength = {{ tau0 = \"20 MPa\", alpha = 0.05 }}\n{PRESSURES}"),
        &population(20_000),
    );
    let case = results.surfaces[0].cases[0].first();
    for pair in case.comparison.pairs_at_load() {
        for response in [pair.statistical, pair.deterministic] {
            let found = ComparedQuantity::Friction.value(&response).unwrap();
            let expected = 20e6 * response.area_ratio.total() / response.pressure.total() + 0.05;
            assert!((found / expected - 1.0).abs() < 1e-12);
            assert!(response.spots[SpotQuantity::TangentialStiffness as usize] > 0.0);
        }
    }
    let card = serde_json::to_string(&(&results as &dyn Outcome).records()["answer"]).unwrap();
    assert!(card.contains("Friction") && card.contains("Coefficient 0.0"), "{card}");
}

/// A difference of conductance is within what is accepted, or beyond it.
#[test]
fn what_is_accepted_decides_on_conductance() {
    let verdict = |accept: &str| {
        let heights = "heights.johnson = { skewness = -0.8, kurtosis = 3.8 }\n";
        let spec = format!(
            "law = \"zmc\"\nconductance = \"electrical\"\naccept = {{ conductance = \"{accept}\" }}\n\
             statistical = {{ heights = \"gaussian\" }}\npressure = \"30 MPa\""
        );
        let results = compared(&spec, &format!("{}{heights}", population(200_000)));
        let stretches = &results.surfaces[0].cases[0].verdicts.stretches;
        let mut of = stretches.iter().filter(|one| one.quantity == ComparedQuantity::ElectricalConductance);
        let found = of.next().unwrap();
        (found.verdict, found.largest.unwrap().1.contrast)
    };
    let (within, contrast) = verdict("60 %");
    assert_eq!((within, verdict("1 %").0), (Verdict::Within, Verdict::Beyond), "{contrast}");
}

/// Causes divide the difference in each quantity that is asked for.
#[test]
fn causes_of_a_difference_in_conductance_add_up() {
    let spec = format!("law = \"zmc\"\nconductance = \"thermal\"\n{PRESSURES}");
    let results = compared(&spec, MAP);
    let case = results.surfaces[0].cases[0].first();
    let divided: Vec<_> = case
        .attribution
        .iter()
        .filter_map(|at| at.contributions(ComparedQuantity::ThermalConductance))
        .collect();
    assert!(divided.len() >= 2);
    for parts in divided {
        for order in Order::ALL {
            let sum: f64 = Cause::ALL
                .into_iter()
                .map(|cause| parts.of_cause(cause).by_order[order as usize].contrast)
                .sum();
            assert!((sum - parts.gap()).abs() < 1e-10);
        }
    }
    assert!(case.attribution.iter().all(|at| at.contributions(ComparedQuantity::Friction).is_none()));
}

/// A film lowers each conductance, air in the gap raises the thermal one by its conductivity over the mean gap.
#[test]
fn films_and_gaps() {
    let of = |conductance: &str| {
        let spec = format!(
            "law = \"zmc\"\nconductance = {conductance}\nmodels = [\"statistical\", \"deterministic\", \"reference\"]\npressure = \"10 MPa\""
        );
        let results = compared(&spec, MAP);
        let surface = &results.surfaces[0];
        let case = surface.cases[0].first();
        let pair = *case.comparison.pairs_at_load().next().unwrap();
        let point = case.reference.as_ref().unwrap().points[0];
        let offset = surface.surface.plane_above_mean_plane().unwrap();
        let gaps =
            [pair.statistical.separation + offset, pair.deterministic.separation + offset, point.mean_gap];
        let spots = [pair.statistical.spots, pair.deterministic.spots, point.spots];
        (spots, gaps)
    };
    let (bare, gaps) = of("[\"electrical\", \"thermal\"]");
    let (filmed, _) =
        of("{ electrical = { film = \"1 mohm um^2\" }, thermal = { film = \"0.01 mm^2 K/W\" } }"
            .replace("1 mohm um^2", "1e-13 ohm m^2")
            .as_str());
    let (in_air, _) = of("{ thermal = { gap-conductivity = \"0.026 W/(m K)\", gap-jump = \"0.4 um\" } }");
    let (thermal_alone, _) = of("\"thermal\"");
    for model in 0..3 {
        for quantity in [SpotQuantity::ElectricalConductance, SpotQuantity::ThermalConductance] {
            let [bare, filmed] = [bare, filmed].map(|all| all[model][quantity as usize]);
            assert!(filmed > 0.0 && filmed < 0.9 * bare, "{model}: {filmed} {bare}");
        }
        let [bare, in_air] = [bare, in_air].map(|all| all[model][SpotQuantity::ThermalConductance as usize]);
        let expected = 0.026 / (gaps[model] + 4e-7);
        assert!(((in_air - bare) / expected - 1.0).abs() < 1e-6, "{model}");
        assert_eq!(thermal_alone[model][SpotQuantity::ElectricalConductance as usize], 0.0);
    }
}

/// A layer that differs from its substrate in nothing but its conductivity: the conductance lies between those of both.
#[test]
fn a_layer_conducts_between_substrate_and_bulk() {
    let spec = "law = \"hertz\"\nconductance = \"thermal\"\nlayer = { material = \"clad\", thickness = [0, \"1 nm\", \"100 nm\", \"100 um\", \"inf\"] }\n\
                models = [\"statistical\", \"deterministic\", \"reference\"]\npressure = \"10 MPa\"";
    let clad = "[material.clad]\nyoung = \"210 GPa\"\npoisson = 0.3\nthermal-conductivity = \"5 W/(m K)\"\nhardness = \"7.6 GPa\"\n";
    let results = compared(spec, &[MAP, clad].concat());
    let conductances = |case: usize| {
        let found = results.surfaces[0].cases[case].first();
        let pair = found.comparison.pairs_at_load().next().unwrap();
        let point = &found.reference.as_ref().unwrap().points[0];
        let quantity = ComparedQuantity::ThermalConductance;
        [quantity.value(&pair.statistical), quantity.value(&pair.deterministic), point.value(quantity)]
            .map(Option::unwrap)
    };
    let all: Vec<[f64; 3]> = (0..5).map(conductances).collect();
    for model in 0..3 {
        let of = |case: usize| all[case][model];
        assert!((1..5).all(|case| of(case) < of(case - 1)), "{model}: {all:?}");
        // s is (1/50 + 1/50)/2 without and (1/50 + 1/5)/2 with nothing but the layer.
        assert!((of(0) / of(4) / 5.5 - 1.0).abs() < 1e-6, "{model}: {all:?}");
        assert!(of(1) > 0.95 * of(0) && of(3) < 1.05 * of(4), "{model}: {all:?}");
    }
}

#[test]
fn what_is_not_asked_for_is_not_there() {
    let results = compared(&format!("law = \"zmc\"\n{PRESSURES}"), &population(2000));
    for (file, content) in (&results as &dyn Outcome).files() {
        let head = String::from_utf8(content).unwrap().lines().next().unwrap_or_default().to_owned();
        assert!(!head.contains("conductance") && !head.contains("friction"), "{file}: {head}");
        assert!(file != "correlations.csv" && file != "friction_by_thickness.csv");
    }
}

/// Friction over the thickness of a soft film has its least value between the bare body and the bulk of the film.
#[test]
fn friction_of_a_film_is_least_between_its_limits() {
    let spec = "law = \"zmc\"\nshear-strength = { tau0 = \"300 MPa\" }\npressure = \"5 MPa\"\n\
                layer = { material = \"lead\", thickness = [0, \"5 nm\", \"20 nm\", \"100 nm\", \"1 um\", \"inf\"], \
                shear-strength = { tau0 = \"33 MPa\" }, breakdown = [1, 2] }";
    let results = compared(spec, &population(20_000));
    let page = (&results as &dyn Outcome).outline().markdown();
    assert!(page.contains("Friction at 5 MPa is least at "), "{page}");
    assert!(page.contains("Assumed: a film breaks at an indentation of 1 times its thickness"), "{page}");
    // A minimum at the end of the thicknesses may lie beyond.
    let thin = spec.replace(", \"20 nm\", \"100 nm\", \"1 um\", \"inf\"", "").replace("[1, 2]", "1");
    let page = (&compared(&thin, &population(20_000)) as &dyn Outcome).outline().markdown();
    assert!(page.contains("least at 5 nm (the thickest run) by the sum"), "{page}");
    let found = &results.surfaces[0].friction;
    assert_eq!(found.len(), 4);
    for one in found {
        let (thickness, least) = one.least().unwrap();
        assert!(thickness > 0.0 && thickness < 1e-6, "{one:?}");
        assert!(least < 0.8 * one.at(0.0).unwrap() && least < 0.8 * one.at(f64::INFINITY).unwrap());
        // The first breakdown is that of the comparison.
        let case =
            results.surfaces[0].cases.iter().find(|case| case.first().thickness == Some(1e-7)).unwrap();
        let at = case.first().comparison.at_load(one.kind, 5e6).unwrap();
        if one.breakdown == 1.0 {
            let of_case = ComparedQuantity::Friction.value(&at.response).unwrap();
            assert!((one.at(1e-7).unwrap() / of_case - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn correlations_stand_beside_a_conductance() {
    let spec = format!(
        "law = \"zmc\"\nconductance = \"thermal\"\nmodels = [\"statistical\", \"deterministic\", \"reference\"]\n{PRESSURES}"
    );
    let results = compared(&spec, MAP);
    let tables = (&results as &dyn Outcome).files();
    let (_, content) = tables.iter().find(|(file, _)| *file == "correlations.csv").unwrap();
    let text = String::from_utf8(content.clone()).unwrap();
    assert!(text.contains("mikic,reference") && text.contains("cooper-mikic-yovanovich,reference"), "{text}");
    let with_film = spec.replace("\"thermal\"", "{ thermal = { film = \"1 mm^2 K/W\" } }");
    let with_medium = spec.replace("\"thermal\"", "{ thermal = { gap-conductivity = \"0.026 W/(m K)\" } }");
    // At loads that few contacts carry nothing is said.
    let light = spec.replace("from = \"1 MPa\", to = \"20 MPa\"", "from = \"1 kPa\", to = \"2 kPa\"");
    for (other, reason) in [
        (with_film, "they are for joints without a film and a medium in the gap"),
        (with_medium, "they are for joints without a film and a medium in the gap"),
        (light, "compared at admissible loads, of which there are none"),
    ] {
        let found = compared(&other, MAP);
        assert!(table(&found, "correlations.csv").is_none(), "{other}");
        let page = (&found as &dyn Outcome).outline().markdown();
        assert!(page.contains(&format!("Correlations: {reason}.")), "{page}");
    }
    let page = (&results as &dyn Outcome).outline().markdown();
    assert!(
        page.contains("Correlations on this map, against boundary elements: ")
            && !page.contains("Correlations: "),
        "{page}"
    );
}

/// Spots of some mean free paths of electrons conduct less than by diffusion; heat is not examined.
#[test]
fn spots_of_a_few_free_paths_are_a_warning() {
    let fine = "[surface.a.population]\nradius = \"200 nm\"\nsigma = \"1 nm\"\ndensity = \"6e14 /m^2\"\ncount = 2000\n";
    let warned = |conductance: &str, surface: &str| {
        let spec = format!("law = \"hertz\"\nconductance = \"{conductance}\"\n{PRESSURES}");
        let warnings = compared(&spec, surface).warnings();
        warnings.iter().any(|warning| warning.contains("below ten mean free paths of electrons in metals"))
    };
    assert!(warned("electrical", fine) && !warned("thermal", fine));
    assert!(!warned("electrical", &population(2000)));
}

/// A finite map between half-spaces conducts less than its spots alone, and compares with their cluster; a surface without end does not.
#[test]
fn a_finite_map_conducts_as_a_cluster_of_spots() {
    const MODELS: &str = "models = [\"statistical\", \"deterministic\", \"reference\"]\n";
    const FINITE: &str = "reference = { boundary = \"finite\" }\n";
    let of = |more: &str, conductance: &str, surface: &str| {
        let spec = format!("law = \"hertz\"\nconductance = {conductance}\n{MODELS}{more}{PRESSURES}");
        compared(&spec, surface)
    };
    let both = "[\"electrical\", \"thermal\"]";
    let finite = of(&format!("{FINITE}accept = {{ conductance = 0.6 }}\n"), both, MAP);
    let case = finite.surfaces[0].cases[0].first();
    let curve = case.reference.as_ref().unwrap();
    let factor = 143e-9 * 50.0;
    let mut last = 1.0;
    for (point, clusters) in curve.points.iter().zip(&curve.clusters) {
        let [electrical, thermal] = point.of_cluster;
        assert!((thermal / electrical / factor - 1.0).abs() < 1e-9);
        assert_eq!(point.value(ComparedQuantity::ElectricalConductance), None);
        let pair = case.comparison.pairs_at_load().find(|pair| pair.target == point.pressure).unwrap();
        let (spots, cluster) = (pair.deterministic.spots[0], clusters[0]);
        assert!((clusters[1] / cluster / factor - 1.0).abs() < 1e-12);
        // Spots of the sum: 2 a each, less what their neighbours take, and the more the more there are.
        assert!(cluster / spots < last, "{spots:e} {cluster:e}");
        last = cluster / spots;
        assert!((cluster / electrical).ln().abs() < 0.25, "{cluster:e} {electrical:e}");
    }
    assert!(last < 0.7, "{last}");
    let rows = table(&finite, "correlations.csv").unwrap();
    let clusters: Vec<_> = rows.iter().filter(|row| row["correlation"] == "greenwood-cluster").collect();
    assert!(clusters.len() == 2 && clusters.iter().all(|row| row["against"] == "reference"));
    assert!(clusters.iter().all(|row| !row["from_pa"].is_empty()), "{clusters:?}");
    // A correlation of an interface without end is no match for a finite map.
    assert!(
        rows.iter().filter(|row| row["correlation"] == "mikic").all(|row| row["against"] == "deterministic")
    );
    let page = (&finite as &dyn Outcome).outline().markdown();
    assert!(page.contains("Finite map, against boundary elements: Greenwood's cluster of spots "), "{page}");
    let options = InterfaceOptions { model: TableModel::Reference, ..InterfaceOptions::default() };
    assert!(interface_tables(&finite, options).unwrap_err().contains("found a reference on a finite map"));
    assert!(
        page.contains("a finite map conducts as one cluster of spots") && page.contains("1621"),
        "{page}"
    );
    assert_eq!(page.matches("Finite map, against").count(), 1, "both conductances differ alike: {page}");
    // Of a film the reference knows, the cluster does not.
    let small = MAP.replace("512", "256");
    let of_first = |results: &CompareResults, case: usize| {
        results.surfaces[0].cases[case].first().reference.as_ref().unwrap().points[0].of_cluster[0]
    };
    let filmed = of(FINITE, "{ electrical = { film = \"1e-13 ohm m^2\" } }", &small);
    let bare = of_first(&of(FINITE, both, &small), 0);
    assert!(0.0 < of_first(&filmed, 0) && of_first(&filmed, 0) < 0.99 * bare);
    // Without yielding and film the stiffness gives the conductance, with a film the potential on the patch.
    let hardly_filmed = of(FINITE, "{ electrical = { film = \"1e-22 ohm m^2\" } }", &small);
    assert!(
        (of_first(&hardly_filmed, 0) / bare - 1.0).abs() < 1e-4,
        "{}",
        of_first(&hardly_filmed, 0) / bare
    );
    let in_air = of(FINITE, "{ thermal = { gap-conductivity = \"0.026 W/(m K)\" } }", &small);
    let page = (&in_air as &dyn Outcome).outline().markdown();
    assert!(
        page.contains("Thermal, 0.0655 mm² between") && !page.contains("spots without each other"),
        "{page}"
    );
    assert!(table(&filmed, "correlations.csv").is_none());
    let of_film = &filmed.surfaces[0].cases[0].first().reference.as_ref().unwrap().clusters;
    assert!(of_film.iter().all(|clusters| *clusters == [0.0; 2]));
    let periodic = of("", both, &small);
    let curve = periodic.surfaces[0].cases[0].first().reference.as_ref().unwrap();
    assert!(curve.clusters.is_empty() && curve.points.iter().all(|point| point.of_cluster == [0.0; 2]));
    assert!(
        !table(&periodic, "reference.csv").unwrap()[0]
            .contains_key("greenwood_electrical_conductance_s_per_m2")
    );
    // Under a layer there is none.
    let clad = "[material.clad]\nyoung = \"210 GPa\"\npoisson = 0.3\nresistivity = \"300 nohm m\"\nhardness = \"7.6 GPa\"\n";
    let layer = "layer = { material = \"clad\", thickness = [0, \"100 nm\"] }\n";
    let layered = of(&format!("{FINITE}{layer}"), "\"electrical\"", &[&small, clad].concat());
    assert!(of_first(&layered, 0) > 0.0 && of_first(&layered, 1) == 0.0);
    let of_layer = &layered.surfaces[0].cases[1].first().reference.as_ref().unwrap().clusters;
    assert!(of_layer.iter().all(|clusters| *clusters == [0.0; 2]));
}

/// Three caps at known places on pixels that are twice as long along y: 2 a of each, and the terms of the pairs.
#[test]
fn a_cluster_takes_the_places_of_its_spots() {
    const RADIUS: f64 = 100e-6;
    let caps = [([20.0, 10.0], 3e-7), ([70.0, 12.0], 2.8e-7), ([40.0, 50.0], 2.9e-7)];
    let place = |[x, y]: [f64; 2]| [1e-6 * x, 2e-6 * y];
    let height = |k: usize| {
        let [x, y] = place([(k / 64) as f64, (k % 64) as f64]);
        let cap = |&(at, top): &([f64; 2], f64)| {
            let [u, v] = place(at);
            top - ((x - u).powi(2) + (y - v).powi(2)) / (2.0 * RADIUS)
        };
        caps.iter().map(cap).fold(f64::NEG_INFINITY, f64::max)
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("caps.npy");
    let heights = (0..96 * 64).map(height).collect();
    HeightMap::new([96, 64], [1e-6, 2e-6], heights, 0.0).unwrap().write_npy(&path).unwrap();
    let surface = format!(
        "[surface.caps.file]\npath = {:?}\npixel = [\"1 um\", \"2 um\"]\nlevel = \"mean\"\n",
        path.display().to_string()
    );
    let spec = "law = \"hertz\"\nconductance = \"electrical\"\nmodels = [\"deterministic\", \"reference\"]\n\
                reference = { boundary = \"finite\" }\npressure = \"1 MPa\"";
    let results = compared(spec, &surface);
    let SurfaceResults { surface, cases, .. } = &results.surfaces[0];
    let case = cases[0].first();
    let flat = surface.plane.mean + case.comparison.curves[0].response.separation;
    let tops = surface.set.heights();
    assert_eq!(tops.len(), 3);
    let lift = caps[0].1 - tops.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let spots = caps.map(|(at, top)| ((RADIUS * (top - lift - flat)).sqrt(), place(at)));
    assert!(spots.iter().all(|(a, _)| *a > 0.0));
    let curve = case.reference.as_ref().unwrap();
    let found = curve.clusters[0][0] * surface.set.nominal_area();
    let expected = cluster_conductance(&spots) / 143e-9;
    assert!((found / expected - 1.0).abs() < 1e-6, "{found:e} {expected:e}");
    // The sum is without the border of the map, which the boundary elements have.
    let whole = (curve.points[0].of_cluster[0] * 96e-6 * 128e-6).recip();
    let [whole, cluster] = [whole, expected.recip()].map(|resistance| quantity(resistance, "Ω"));
    let text = format!(
        "0.0123 mm² between larger bodies: {whole} (boundary elements), Greenwood's cluster {cluster}, "
    );
    let page = (&results as &dyn Outcome).outline().markdown();
    assert!(page.contains(&text), "{text}\n{page}");
}

#[test]
fn a_table_of_a_joint_grows_from_its_first_load() {
    let spec = format!(
        "law = \"ceb\"\nconductance = \"thermal\"\nshear-strength = {{ tau0 = \"20 MPa\" }}\n{}",
        PRESSURES.replace("points = 5", "points = 30")
    );
    let results = run(&spec, &population(20_000)).unwrap();
    let tables = interface_tables(&*results, InterfaceOptions::default()).unwrap().tables;
    let [table] = &tables[..] else { panic!("one case") };
    assert_eq!((table.points.len(), table.points[0].closure.value), (30, 0.0));
    assert!(table.points.windows(2).all(|pair| {
        pair[1].pressure > pair[0].pressure && pair[1].closure.value > pair[0].closure.value
    }));
    for point in &table.points {
        let [low, high] = point.thermal.unwrap().interval.unwrap();
        assert!(low < point.thermal.unwrap().value && point.thermal.unwrap().value < high);
        let [low, high] = point.closure.interval.unwrap();
        assert!(low <= point.closure.value && point.closure.value <= high);
    }
    for format in Format::ALL {
        let files = interface_files(&tables, "joint", format, UnitSystem::Mm);
        // CalculiX: the value and both ends of the intervals.
        let expected = if format == Format::Csv { 1 } else { 3 };
        assert_eq!(files.len(), expected, "{}", format.name());
        for file in files {
            assert!(
                file.text.contains("law ceb") && file.text.contains("May the integral replace the sum (")
            );
            let first = "Closure 0: the separation of the first load.";
            assert_eq!(format == Format::Csv, file.text.contains(first), "{}", file.name);
        }
    }
    let si = interface_files(&tables, "joint", Format::Csv, UnitSystem::Si);
    let rows = si[0].text.lines().filter(|line| !line.starts_with('#'));
    let mut reader = csv::Reader::from_reader(rows.collect::<Vec<_>>().join("\n").leak().as_bytes());
    let records: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(records.len(), 30);
    assert_eq!(records[0][0].parse::<f64>().unwrap(), 1e6);
}

/// One joint in both systems of units. `tests/test_calculix.py` solves contacts by the tables for CalculiX.
#[test]
fn units_hold_the_same_joint() {
    let spec = format!("law = \"zmc\"\nconductance = \"thermal\"\n{PRESSURES}");
    let results = run(&spec, &population(20_000)).unwrap();
    let tables = interface_tables(&*results, InterfaceOptions::default()).unwrap().tables;
    let last = tables[0].points.last().unwrap();
    let [si, mm] = [UnitSystem::Si, UnitSystem::Mm].map(|units| {
        let text = interface_files(&tables, "joint", Format::Csv, units)[0].text.clone();
        let head = text.lines().find(|line| !line.starts_with('#')).unwrap().to_owned();
        let column = |name: &str| head.split(',').position(|cell| cell == name).unwrap();
        let row = text.lines().last().unwrap().split(',').map(str::to_owned).collect::<Vec<String>>();
        ["pressure", "closure", "thermal_conductance"].map(|name| row[column(name)].parse::<f64>().unwrap())
    });
    for ((si, mm), scale) in si.into_iter().zip(mm).zip([1e-6, 1e3, 1e-3]) {
        assert!((mm / si / scale - 1.0).abs() < 1e-12, "{si} {mm}");
    }
    assert!((si[0] / last.pressure - 1.0).abs() < 1e-12 && (si[1] / last.closure.value - 1.0).abs() < 1e-12);
    // The ends of the intervals are files of their own, on both sides of the value.
    let keyword = interface_files(&tables, "joint", Format::Calculix, UnitSystem::Si);
    let conductance = |ending: &str| {
        let text = &keyword.iter().find(|file| file.name == format!("joint{ending}.inp")).unwrap().text;
        let (_, table) = text.split_once("*GAP CONDUCTANCE").unwrap();
        let rows = table.lines().filter(|line| !line.starts_with('*'));
        let mut values = rows.filter_map(|row| row.split(',').next()?.trim().parse::<f64>().ok());
        values.next_back().unwrap()
    };
    let [low, value, high] = ["-low", "", "-high"].map(conductance);
    assert!(low < value && value < high, "{low} {value} {high}");
}

/// What is written into headers and names cannot end a comment, nor hide a file behind another one.
#[test]
fn headers_and_names_of_joints_are_safe() {
    let results = run(&format!("law = \"zmc\"\n{PRESSURES}"), &population(20_000)).unwrap();
    let mut table = interface_tables(&*results, InterfaceOptions::default()).unwrap().tables.remove(0);
    table.header[0] = "one line\n*STEP\nand another".to_owned();
    let empty = InterfaceTable { points: Vec::new(), ..table.clone() };
    let files = interface_files(&[table.clone(), table, empty], "joint", Format::Calculix, UnitSystem::Si);
    let mut names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!((names.len(), files.len() % 2), (files.len(), 0), "{names:?}");
    assert!(files.iter().all(|file| file.text.lines().all(|line| line != "*STEP")), "{}", files[0].text);
}

#[test]
fn loads_that_are_not_admissible_are_refused_or_marked() {
    let spec = "law = \"zmc\"\nconductance = \"electrical\"\npressure = { from = \"1 kPa\", to = \"5 kPa\", points = 5 }";
    let results = run(spec, &population(20_000)).unwrap();
    let refused = interface_tables(&*results, InterfaceOptions::default()).unwrap_err();
    assert!(refused.contains("0 admissible loads of 5") && refused.contains("--beyond"), "{refused}");
    let beyond = InterfaceOptions { beyond: true, ..InterfaceOptions::default() };
    let marked = &interface_tables(&*results, beyond).unwrap().tables[0];
    assert!(marked.points.iter().all(|point| point.limits.contains("few-contacts")));
    let of_reference = InterfaceOptions { model: TableModel::Reference, beyond: true };
    let refused = interface_tables(&*results, of_reference).unwrap_err();
    assert!(refused.contains("no load of the reference model"), "{refused}");
    assert!(
        marked
            .header
            .iter()
            .any(|line| line == "Not admissible: 1 to 5 kPa (few-contacts dominant-contact)."),
        "{:?}",
        marked.header
    );
    let one = run("law = \"zmc\"\npressure = \"5 MPa\"", &population(20_000)).unwrap();
    assert!(interface_tables(&*one, beyond).unwrap_err().contains("found one load"));
}

/// Cases with a table are written although others have none, under names that all programs read.
#[test]
fn tables_of_several_cases() {
    let spec = "law = [\"zmc\", \"hertz\"]\npressure = [\"5 MPa\", \"10 MPa\"]";
    let surfaces = [population(20_000), population(200).replace("surface.a", "surface.few")].concat();
    let results = run(spec, &surfaces).unwrap();
    let found = interface_tables(&*results, InterfaceOptions::default()).unwrap();
    assert_eq!((found.tables.len(), found.left_out.len()), (2, 2), "{:?}", found.left_out);
    let files = interface_files(&found.tables, "my joint", Format::Calculix, UnitSystem::Si);
    assert!(files.iter().any(|file| file.text.contains("NAME=MY-JOINT-A-LAW-ZMC\n")), "{}", files[0].text);
    assert!(files.iter().all(|file| !file.name.contains([',', ' '])));
}
