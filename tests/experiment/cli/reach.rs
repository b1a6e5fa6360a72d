//! Loads out of reach, which `check` finds as a run does.

use super::*;

/// A list of two asperities and a population, both under the loads of `compare`.
fn both(compare: &str) -> String {
    let list = "[surface.list.asperities]\nfile = \"list.csv\"\nnominal-area = \"1e-8 m^2\"\n";
    let contact = "[compare]\nrough = \"steel\"\nflat = \"steel\"\nlaw = [\"hertz\", \"zmc\"]\n";
    ["title = \"t\"\n", steel!(), list, &results::population("drawn", 1000, ""), contact, compare, "\n"]
        .concat()
}

#[test]
fn check_refuses_a_load_out_of_reach_with_the_message_of_a_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("list.csv"), "height,radius\n0,2e-5\n5e-8,1e-5\n").unwrap();
    let spec = folder.path().join("t.toml");
    let out = folder.path().join("reports");
    let cases = [
        (
            "force = { values = [\"1 uN\", \"1e5 N\", \"1e6 N\"] }",
            Some("compare.force: surface list, law hertz"),
        ),
        // 1 GPa is within reach of the population only.
        ("pressure = { values = [\"1 GPa\"] }\nsurfaces = [\"drawn\", \"list\"]", Some("surface list")),
        ("pressure = { values = [\"1e15 Pa\"] }\nmodels = [\"statistical\"]", Some("statistical model")),
        ("pressure = { values = [\"1e15 Pa\"] }\nmodels = [\"deterministic\"]", Some("deterministic model")),
        ("pressure = { from = \"1 kPa\", to = \"1 MPa\", points = 5 }", None),
        ("separation = { values = [-20, 4] }", None),
    ];
    for (compare, wanted) in cases {
        fs::write(&spec, both(compare)).unwrap();
        let checked = experiment(&["check", "t.toml"], folder.path());
        let ran = experiment(&["run", "t.toml", "--out", out.to_str().unwrap(), "--quiet"], folder.path());
        assert!(text(&checked.stdout).contains("surface list:"), "the plan is printed all the same");
        let message = text(&checked.stderr);
        assert_eq!(checked.status.code(), Some(if wanted.is_some() { 2 } else { 0 }), "{compare}: {message}");
        assert_eq!((checked.status.code(), &message), (ran.status.code(), &text(&ran.stderr)), "{compare}");
        if let Some(wanted) = wanted {
            assert!(message.contains(wanted) && message.contains("is not reached"), "{message}");
        }
    }
}
