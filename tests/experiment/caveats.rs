//! What a run warns of though it has an answer: laws beyond their range, bodies and asperities that contradict themselves.

use asperity_contact_framework::progress::Silent;

use crate::results::{read, run_in};

/// The warnings of a spec whose steel has the given hardness and yield strength.
fn warnings(hardness: &str, strength: &str, kind: &str, list: &str) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("list.csv"), list).unwrap();
    let spec = format!(
        "title = \"t\"\n[material.steel]\nyoung = \"210 GPa\"\npoisson = 0.3\nhardness = \"{hardness}\"\n\
         yield-strength = \"{strength}\"\n{kind}"
    );
    run_in(folder.path(), &spec).unwrap().warnings()
}

fn compare(law: &str) -> String {
    format!(
        "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = {law}\nseparation = {{ values = [1] }}\n\
         [surface.a.asperities]\nfile = \"list.csv\"\nnominal-area = \"1e-8 m^2\"\nindependent = true\n"
    )
}

const SPHERES: &str = "height,radius,kx,ky\n0,1e-5,5e4,2e5\n1e-8,1e-5,1e5,1e5\n";

#[test]
fn hardness_and_yield_strength_of_different_bodies() {
    let both = compare("[\"zmc\", \"jackson-green\"]");
    assert_eq!(warnings("2.8 GPa", "0.9 GPa", &both, SPHERES), [""; 0]);
    let [warning] = &warnings("7.6 GPa", "0.9 GPa", &both, SPHERES)[..] else { panic!("one warning") };
    assert!(warning.starts_with("steel: the hardness is 8.44 times the yield strength"), "{warning}");
    // Laws that all take the same property agree, whatever the other is.
    assert_eq!(warnings("7.6 GPa", "0.9 GPa", &compare("[\"zmc\", \"ceb\"]"), SPHERES), [""; 0]);
    assert_eq!(warnings("7.6 GPa", "0.9 GPa", &compare("[\"hertz\", \"jackson-green\"]"), SPHERES), [""; 0]);
}

#[test]
fn a_law_beyond_what_it_was_fitted_for() {
    let limit = "[limit]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"jackson-green\"\nradius = \"20 um\"\n\
                 sigma = \"48 nm\"\ndensity = \"6e10 /m^2\"\nseparation = { values = [1] }\n\
                 count = { values = [100, 1000] }\ndraws = 2\n";
    for kind in [compare("\"jackson-green\""), limit.to_owned()] {
        let [warning] = &warnings("7.6 GPa", "2.7 GPa", &kind, SPHERES)[..] else { panic!("one warning") };
        assert!(warning.contains("law jackson-green: Y/E* = 0.0234"), "{warning}");
    }
}

#[test]
fn radii_beyond_both_principal_radii_of_curvature() {
    let elliptic = compare("\"elliptic-zmc\"");
    assert_eq!(warnings("7.6 GPa", "2.7 GPa", &elliptic, SPHERES), [""; 0]);
    let wrong = "height,radius,kx,ky\n0,1e-5,5e4,2e5\n1e-8,1e-5,1e8,2e8\n2e-8,1e-5,1e4,2e4\n";
    let [warning] = &warnings("7.6 GPa", "2.7 GPa", &elliptic, wrong)[..] else { panic!("one warning") };
    assert!(warning.contains("2 of 3 radii are outside the range from 1/kx to 1/ky"), "{warning}");
    // Laws for spheres do not see the curvatures.
    assert_eq!(warnings("7.6 GPa", "2.7 GPa", &compare("\"zmc\""), wrong), [""; 0]);
}

/// A comparison of a material in another unit, of needles on a small area, at separations as if in nanometres.
const IMPLAUSIBLE: &str = "title = \"t\"\n[material.steel]\nyoung = \"210 Pa\"\npoisson = 0.3\nhardness = \"76 GPa\"\n\
     [compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = \"hertz\"\nseparation = { values = [1, 50] }\n\
     [surface.a.population]\nradius = \"2 mm\"\nsigma = \"3 mm\"\ndensity = \"1e9 /m^2\"\ncount = 100\n";

#[test]
fn inputs_that_are_hardly_meant_are_named_by_check_and_by_a_run_and_refused_by_neither() {
    let folder = tempfile::tempdir().unwrap();
    let experiment = read(folder.path(), IMPLAUSIBLE).unwrap();
    let checked = experiment.to_string();
    let run = experiment.run(&Silent).unwrap().warnings();
    let all = [
        "Young's modulus is 210 Pa, below 1 MPa and softer than rubber: did you mean \"210 GPa\"?",
        "the hardness is 76 GPa, above E*/5 = 23.1 Pa",
        "`separation` reaches 50 σ",
        "is above their mean radius, 2 mm: needles",
    ];
    let of_run = "surface a: from d = 1 σ down the surfaces overlap completely";
    assert!(run.iter().any(|line| line.contains(of_run)), "{run:?}");
    for warning in all {
        assert!(checked.contains(warning), "{warning}: {checked}");
        assert!(run.iter().any(|line| line.contains(warning)), "{warning}: {run:?}");
    }
    assert_eq!(run.len(), all.len() + 1, "{run:?}");
    assert_eq!(checked.matches("  warning: ").count(), all.len());
}
