//! What is not done again, and how much is said to be done.

use super::*;

#[test]
fn an_unchanged_experiment_does_nothing() {
    let (_folder, spec, out) = small();
    let output = run(&spec, &out, &[]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = &summary(&out, "small")["work"];
    let count = |item: &str| summary[item].as_u64().unwrap();
    assert_eq!((count("files_read"), count("surfaces_made"), count("coating_calls")), (1, 2, 0));
    assert!(["asperities_touched", "nodes", "single_contacts"].iter().all(|item| count(item) > 0));
    let times = || {
        let files = fs::read_dir(out.join("small")).unwrap().chain(fs::read_dir(&out).unwrap());
        let mut times: Vec<_> = files
            .map(|entry| {
                let entry = entry.unwrap();
                (entry.path(), entry.metadata().unwrap().modified().unwrap())
            })
            .collect();
        times.sort();
        times
    };
    let before = times();
    assert!(before.len() > 8);
    let output = run(&spec, &out, &[]);
    assert!(text(&output.stdout).contains("is unchanged") && !text(&output.stdout).contains("written"));
    assert_eq!(times(), before);
    // Only then is a written report new.
    assert!(text(&run(&spec, &out, &["--force"]).stdout).contains("written"));
    assert!(times() != before);
}
