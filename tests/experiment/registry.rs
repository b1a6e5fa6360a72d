//! What is written by hand about the laws, the height distributions and the kinds of experiment.

use std::fs;

use asperity::ContactLaw;
use asperity::contact_law::registry;
use asperity::distribution::REGISTRY;
use asperity_experiment::Experiment;
use asperity_experiment::kind::KINDS;

fn assert_named(files: &[&str], names: impl Iterator<Item = String> + Clone) {
    for file in files {
        let text = fs::read_to_string(file).unwrap().to_lowercase();
        for name in names.clone() {
            assert!(text.contains(&name), "{name} is not in {file}");
        }
    }
}

#[test]
fn documents_name_every_law() {
    let names = registry().iter().map(ContactLaw::name);
    assert_named(&["docs/specs.md", "docs/theory.md"], names.clone().map(|name| format!("`{name}`")));
    // The comment of the template that `experiment new` writes.
    assert_named(&["src/template.toml"], names.map(|name| format!("\"{name}\"")));
}

#[test]
fn documents_name_every_height_distribution() {
    let names = REGISTRY.iter().map(|entry| entry.name.to_owned());
    assert_named(&["docs/specs.md", "docs/theory.md", "src/template.toml"], names);
}

#[test]
fn documents_and_messages_name_every_kind() {
    let names = KINDS.iter().map(|kind| format!("[{}]", kind.name()));
    assert_named(&["docs/specs.md"], names.clone());
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("empty.toml");
    fs::write(&spec, "title = \"t\"\n").unwrap();
    let message = Experiment::read(&spec).err().unwrap().to_string();
    let all = names.collect::<Vec<_>>().join(", ");
    assert!(message.contains(&format!("exactly one of {all}")), "{message}");
}
