use tempfile::TempDir;

use super::{BY_EXCHANGE, BY_TWO_RENAMES, INTO_FREE_PLACE, Step, take, *};

fn folder(key: &str, text: &str) -> Folder {
    let mut folder = Folder::new("lead", key);
    folder.file("curves.csv", format!("a\n{text}\n")).file("report.md", text);
    folder.file(
        "summary.json",
        r#"{"program": "asperity", "files": ["curves.csv", "report.md", "summary.json"]}"#,
    );
    folder
}

/// A store that holds a report of key "old".
fn stored() -> (TempDir, Store) {
    let home = tempfile::tempdir().unwrap();
    let mut store = Store::new(home.path().join("out"));
    store.write(&folder("old", "old")).unwrap();
    (home, store)
}

fn entries(store: &Store) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(&store.directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn not_generated<T: std::fmt::Debug>(result: Result<T, StoreError>) -> PathBuf {
    match result {
        Err(StoreError::NotGenerated(path)) => path,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_report_is_replaced_whole() {
    let (_home, mut store) = stored();
    assert!(store.is_current("lead", "old") && !store.is_current("lead", "new"));
    let mut next = Folder::new("lead", "new");
    next.file("only.txt", "x");
    store.write(&next).unwrap();
    assert!(store.is_current("lead", "new"));
    assert!(!store.directory.join("lead/curves.csv").exists());
    assert_eq!(entries(&store), [".lock", "lead"]);
}

#[test]
fn missing_or_altered_files_are_not_current() {
    let (_home, store) = stored();
    let file = store.directory.join("lead/curves.csv");
    fs::write(&file, "a\nolD\n").unwrap();
    assert!(!store.is_current("lead", "old"));
    fs::write(&file, "a\nold\n").unwrap();
    assert!(store.is_current("lead", "old"));
    fs::remove_file(&file).unwrap();
    assert!(!store.is_current("lead", "old"));
    assert!(!store.is_current("../out/lead", "old") && !store.is_current("", "old"));
}

#[test]
fn no_manifest_makes_trouble() {
    let (_home, mut store) = stored();
    let path = store.directory.join("lead/manifest.json");
    let outside = r#"{"program": "asperity", "key": "old", "files": {"../.lock": "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"}}"#;
    let deep = "[".repeat(100_000);
    for garbage in ["", "{", "null", "[1]", r#"{"key": 3}"#, "\u{0}\u{1}", outside, &deep] {
        fs::write(&path, garbage).unwrap();
        assert!(!store.is_current("lead", "old"), "{garbage:.40}");
    }
    fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
    assert!(!store.is_current("lead", "old"));
    // The summary still says whose folder it is.
    store.write(&folder("new", "new")).unwrap();
    assert!(store.is_current("lead", "new"));
    fs::remove_file(&path).unwrap();
    assert!(!store.is_current("lead", "new"));
    store.write(&folder("newer", "newer")).unwrap();
    assert!(store.is_current("lead", "newer"));
}

#[test]
fn a_report_that_came_with_a_clone_is_recognised_by_its_input() {
    let (_home, store) = stored();
    let report = store.directory.join("lead");
    fs::write(report.join("report.md"), "abc").unwrap();
    // Of "abc"; pages for the browser and long tables do not come with a clone.
    let hash = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    let summary = format!(
        r#"{{"program": "asperity", "input_sha256": "abc", "committed": {{"report.md": "{hash}"}}, "files": ["report.html", "report.md"]}}"#
    );
    fs::write(report.join("summary.json"), summary).unwrap();
    // With a manifest it was written here, and its key decides.
    let state = |input: &str| store.state("lead", "another key", input);
    assert_eq!(state("abc"), State::ProgramChanged);
    fs::remove_file(report.join("manifest.json")).unwrap();
    assert_eq!((state("abc"), state("abd")), (State::UpToDate, State::InputChanged));
    assert_eq!(store.state("gold", "key", "abc"), State::Missing);
    // A page or picture of another run is noticed.
    fs::write(report.join("report.md"), "abd").unwrap();
    assert_eq!(state("abc"), State::Edited);
    fs::remove_file(report.join("report.md")).unwrap();
    assert_eq!(state("abc"), State::Edited);
}

#[test]
fn the_time_of_the_last_run_and_its_library_are_known_where_they_are_written() {
    let (_home, store) = stored();
    assert_eq!((store.seconds("lead"), store.library("lead")), (None, None));
    let report = store.directory.join("lead");
    fs::write(report.join("timing.json"), r#"{ "read_s": 1.0, "total_s": 2.5 }"#).unwrap();
    fs::write(report.join("summary.json"), r#"{ "program": "asperity", "library_sha256": "abc" }"#).unwrap();
    assert_eq!((store.seconds("lead"), store.library("lead").as_deref()), (Some(2.5), Some("abc")));
}

#[test]
fn what_was_edited_is_kept_beside_the_new_version() {
    let (_home, mut store) = stored();
    let read =
        |store: &Store, name: &str| fs::read_to_string(store.directory.join("lead").join(name)).unwrap();
    assert!(store.write(&folder("same", "old")).unwrap().is_empty());
    fs::write(store.directory.join("lead/report.md"), "my remarks").unwrap();
    assert_eq!(store.write(&folder("new", "new")).unwrap(), ["report.md.bak"]);
    assert_eq!((&*read(&store, "report.md"), &*read(&store, "report.md.bak")), ("new", "my remarks"));
    assert!(store.is_current("lead", "new"));
    // What was kept stays, also beside a second edit.
    fs::write(store.directory.join("lead/report.md"), "more remarks").unwrap();
    assert_eq!(store.write(&folder("newer", "newer")).unwrap(), ["report.md.bak2"]);
    assert_eq!(read(&store, "report.md.bak"), "my remarks");
    assert_eq!(read(&store, "report.md.bak2"), "more remarks");
    // Where version control has put another run in its place, nothing was edited.
    fs::write(store.directory.join("lead/report.md"), "of another run").unwrap();
    let summary = r#"{"program": "asperity", "files": ["curves.csv", "report.md"]}"#;
    fs::write(store.directory.join("lead/summary.json"), summary).unwrap();
    assert!(store.write(&folder("last", "last")).unwrap().is_empty());
    // A foreign file is none of them.
    fs::write(store.directory.join("lead/notes.bak"), "mine").unwrap();
    not_generated(store.write(&folder("newest", "newest")));
}

#[test]
fn nothing_foreign_is_destroyed() {
    let (_home, mut store) = stored();
    let report = store.directory.join("lead");
    let notes = report.join("notes.txt");
    fs::write(&notes, "mine").unwrap();
    assert_eq!(not_generated(store.write(&folder("new", "new"))), notes);
    assert_eq!(not_generated(store.check("lead")), notes);
    fs::remove_file(&notes).unwrap();

    // A subfolder is foreign whatever its name.
    fs::remove_file(report.join("report.md")).unwrap();
    fs::create_dir(report.join("report.md")).unwrap();
    assert_eq!(not_generated(store.write(&folder("new", "new"))), report.join("report.md"));
    fs::remove_dir(report.join("report.md")).unwrap();

    store.write(&folder("new", "new")).unwrap();
    assert!(store.is_current("lead", "new"));
}

#[test]
fn records_of_another_program_prove_nothing() {
    let home = tempfile::tempdir().unwrap();
    let mut store = Store::new(home.path());
    let report = home.path().join("lead");
    fs::create_dir(&report).unwrap();
    for (name, content) in [
        ("manifest.json", r#"{"program": "other", "key": "k", "files": {}}"#),
        ("manifest.json", r#"{"name": "a web application"}"#),
        ("summary.json", r#"{"program": "other", "files": ["summary.json"]}"#),
        ("summary.json", r#"{"files": ["summary.json"]}"#),
    ] {
        let file = report.join(name);
        fs::write(&file, content).unwrap();
        assert_eq!(not_generated(store.write(&folder("k", "x"))), file);
        assert_eq!(fs::read_to_string(&file).unwrap(), content);
        fs::remove_file(&file).unwrap();
    }
    // An empty folder holds nothing to lose, and a refused run has left nothing behind.
    assert_eq!(entries(&store), ["lead"]);
    store.write(&folder("k", "x")).unwrap();
    assert!(store.is_current("lead", "k"));
}

#[test]
fn a_file_in_the_place_of_a_report_stays() {
    let home = tempfile::tempdir().unwrap();
    let mut store = Store::new(home.path());
    let place = home.path().join("lead");
    fs::write(&place, "mine").unwrap();
    assert_eq!(not_generated(store.write(&folder("k", "x"))), place);
    assert_eq!(fs::read_to_string(&place).unwrap(), "mine");
}

#[cfg(unix)]
#[test]
fn links_are_foreign() {
    let (home, mut store) = stored();
    let target = home.path().join("elsewhere");
    fs::rename(store.directory.join("lead"), &target).unwrap();
    std::os::unix::fs::symlink(&target, store.directory.join("lead")).unwrap();
    assert_eq!(not_generated(store.write(&folder("new", "new"))), store.directory.join("lead"));
    assert!(target.join("curves.csv").exists());
    fs::remove_file(store.directory.join("lead")).unwrap();

    fs::rename(&target, store.directory.join("lead")).unwrap();
    let file = store.directory.join("lead/report.md");
    fs::rename(&file, home.path().join("kept.md")).unwrap();
    std::os::unix::fs::symlink(home.path().join("kept.md"), &file).unwrap();
    assert_eq!(not_generated(store.write(&folder("new", "new"))), file);
}

#[test]
fn bad_names_are_refused_before_anything_is_written() {
    let home = tempfile::tempdir().unwrap();
    let mut store = Store::new(home.path().join("out"));
    for stem in ["", ".", "..", ".hidden", "a/b", "a\\b", "a\nb"] {
        assert!(matches!(store.write(&Folder::new(stem, "k")), Err(StoreError::BadName(_))), "{stem:?}");
    }
    for name in ["../x", "manifest.json", "a/b", ""] {
        let mut folder = Folder::new("lead", "k");
        folder.file(name, "x");
        assert!(matches!(store.write(&folder), Err(StoreError::BadName(_))), "{name:?}");
    }
    let mut twice = Folder::new("lead", "k");
    twice.file("a", "1").file("a", "2");
    assert!(matches!(store.write(&twice), Err(StoreError::BadName(_))));
    store.recover().unwrap();
    assert!(!home.path().join("out").exists());
}

#[test]
fn a_kill_at_any_step_leaves_one_report_whole() {
    for plan in [BY_EXCHANGE, BY_TWO_RENAMES] {
        for steps in 0..=plan.len() {
            let (_home, store) = stored();
            let places = Places::new(&store.directory, "lead");
            write_all(&places.new, &folder("new", "new"), &Kept::default()).unwrap();
            match take(&plan[..steps], &places) {
                // A file system that cannot exchange takes the other plan.
                Err(StoreError::Io { source, .. }) if source.kind() == io::ErrorKind::Unsupported => {
                    continue;
                }
                done => done.unwrap(),
            }
            // The kill releases the lock.
            let directory = store.directory.clone();
            drop(store);
            let mut store = Store::new(directory);
            store.recover().unwrap();
            let moved_in = plan[..steps].iter().any(|step| matches!(step, Step::Exchange | Step::MoveIn));
            let key = if moved_in { "new" } else { "old" };
            assert!(store.is_current("lead", key), "{plan:?} {steps}");
            assert_eq!(entries(&store), [".lock", "lead"], "{plan:?} {steps}");
        }
    }
}

#[test]
fn a_kill_before_the_first_report_is_there_leaves_none_or_all() {
    for steps in 0..=1 {
        let home = tempfile::tempdir().unwrap();
        let mut store = Store::new(home.path());
        let places = Places::new(home.path(), "lead");
        write_all(&places.new, &folder("new", "new"), &Kept::default()).unwrap();
        take(&INTO_FREE_PLACE[..steps], &places).unwrap();
        store.recover().unwrap();
        assert_eq!(store.is_current("lead", "new"), steps == 1);
        assert_eq!(entries(&store).len(), 1 + steps);
    }
}

#[test]
fn a_kill_while_writing_or_discarding_leaves_the_report_alone() {
    for leftover in [".lead.asperity-new", ".lead.asperity-old"] {
        let (_home, store) = stored();
        let directory = store.directory.clone();
        drop(store);
        // Half a report: no manifest, one file cut short.
        fs::create_dir(directory.join(leftover)).unwrap();
        fs::write(directory.join(leftover).join("curves.csv"), "a").unwrap();
        fs::write(directory.join(".index.md.asperity-new"), "half").unwrap();
        let mut store = Store::new(directory);
        store.write_page("index.md", b"<!-- m -->", "<!-- m -->").unwrap();
        assert!(store.is_current("lead", "old"));
        assert_eq!(entries(&store), [".lock", "index.md", "lead"]);
    }
}

#[test]
fn a_failed_write_changes_nothing() {
    let (_home, mut store) = stored();
    let mut broken = folder("new", "new");
    // No file system takes a name of this length.
    broken.file("n".repeat(5000), "x");
    let error = store.write(&broken).unwrap_err();
    assert!(error.to_string().contains(".lead.asperity-new"), "{error}");
    assert!(store.is_current("lead", "old"));
    assert_eq!(entries(&store), [".lock", "lead"]);
}

#[test]
fn one_run_writes_at_a_time() {
    let (_home, store) = stored();
    let mut other = Store::new(store.directory.clone());
    let error = other.write(&folder("new", "new")).unwrap_err();
    assert!(matches!(error, StoreError::Busy(_)) && error.to_string().contains("another run"));
    assert!(matches!(other.recover(), Err(StoreError::Busy(_))));
    assert!(other.is_current("lead", "old"));
    drop(store);
    other.write(&folder("new", "new")).unwrap();
}

#[test]
fn only_pages_of_runs_are_replaced() {
    let home = tempfile::tempdir().unwrap();
    let mut store = Store::new(home.path().join("out"));
    store.write_page("README.md", b"<!-- generated --> one", "<!-- generated -->").unwrap();
    store.write_page("README.md", b"<!-- generated --> two", "<!-- generated -->").unwrap();
    let path = store.directory.join("README.md");
    assert_eq!(fs::read(&path).unwrap(), b"<!-- generated --> two");
    fs::write(&path, "mine").unwrap();
    assert_eq!(
        not_generated(store.write_page("README.md", b"<!-- generated --> three", "<!-- generated -->")),
        path
    );
    assert_eq!(fs::read(&path).unwrap(), b"mine");
    assert_eq!(entries(&store), [".lock", "README.md"]);
}

#[test]
fn a_file_is_no_folder_of_reports() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("file");
    fs::write(&file, "").unwrap();
    for out in [file.clone(), file.join("out")] {
        let error = Store::new(out).recover().unwrap_err();
        assert!(matches!(&error, StoreError::NotAFolder(found) if *found == file), "{error}");
    }
    assert!(Store::new(home.path().join("new")).recover().is_ok());
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_refused_before_a_run() {
    let home = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink("gone", home.path().join("out")).unwrap();
    let error = Store::new(home.path().join("out/reports")).recover().unwrap_err();
    assert!(matches!(error, StoreError::LeadsNowhere { .. }) && error.to_string().contains("link to gone"));
    assert!(!home.path().join("gone").exists());
}

/// The lock of the folder that was removed is not that of the new one, which another run may hold.
#[cfg(unix)]
#[test]
fn a_folder_that_is_removed_during_a_run_is_made_again() {
    let (_home, mut store) = stored();
    fs::remove_dir_all(&store.directory).unwrap();
    store.write(&folder("new", "new")).unwrap();
    assert!(store.is_current("lead", "new"));
    let mut other = Store::new(store.directory.clone());
    assert!(matches!(other.recover(), Err(StoreError::Busy(_))));
    fs::remove_dir_all(&store.directory).unwrap();
    other.write(&folder("other", "other")).unwrap();
    assert!(matches!(store.write(&folder("new", "new")), Err(StoreError::Busy(_))));
    assert!(store.is_current("lead", "other"));
}

#[test]
fn an_error_of_the_disk_says_what_to_do() {
    let text =
        |kind: io::ErrorKind| failed::<()>("write", Path::new("a"), kind.into()).unwrap_err().to_string();
    assert!(text(io::ErrorKind::StorageFull).contains("free some space"));
    assert!(text(io::ErrorKind::ReadOnlyFilesystem).contains("choose another folder"));
    assert!(text(io::ErrorKind::NotFound).ends_with("it was removed meanwhile: run again"));
}
