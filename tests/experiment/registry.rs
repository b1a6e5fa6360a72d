//! What is written by hand about the laws of the registry.

use std::fs;

use asperity::ContactLaw;
use asperity::contact_law::registry;

#[test]
fn every_law_is_documented() {
    for file in ["README.md", "docs/theory.md"] {
        let text = fs::read_to_string(file).unwrap();
        for name in registry().iter().map(ContactLaw::name) {
            assert!(text.contains(&format!("`{name}`")), "{name} is not in {file}");
        }
    }
}
