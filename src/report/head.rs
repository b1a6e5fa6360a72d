//! What every page says: the bodies, the sources, the files.

use super::format::{number, quantity};
use super::page::{Page, escape};
use crate::experiment::results::{ContactHead, Head};

/// What the spec's author says of it.
pub fn notes(page: &mut Page, head: &Head) {
    for paragraph in head.notes.split("\n\n").map(str::trim).filter(|paragraph| !paragraph.is_empty()) {
        page.paragraph(&escape(&paragraph.replace('\n', " ")));
    }
}

/// The bodies and the spec.
pub fn what_was_run(page: &mut Page, head: &Head, contact: &ContactHead) {
    page.heading(2, "What was run");
    let value = |value: Option<f64>| value.map_or_else(|| "never yields".to_owned(), |v| quantity(v, "Pa"));
    let roles = |name: &str| match (name == contact.bodies.rough, name == contact.bodies.flat) {
        (true, true) => "rough and flat",
        (true, false) => "rough",
        (false, true) => "flat",
        (false, false) => "not used",
    };
    page.table(
        ["material", "body", "E", "ν", "H"],
        contact.materials.iter().map(|(name, body)| {
            vec![
                name.clone(),
                roles(name).to_owned(),
                quantity(body.young(), "Pa"),
                number(body.poisson()),
                value(body.hardness()),
            ]
        }),
    );
    page.paragraph(&format!(
        "Reduced modulus E* = {}; hardness of the softer body: {}. Seed {}; spec `{}.toml`, SHA-256 `{}`. Asperity {}.",
        quantity(contact.reduced_modulus, "Pa"),
        value(contact.hardness),
        head.seed,
        head.stem,
        head.spec_sha256,
        env!("CARGO_PKG_VERSION"),
    ));
}

/// The papers behind what was run.
pub fn sources(page: &mut Page, head: &Head) {
    page.heading(2, "Sources");
    page.bullets(head.papers.iter().map(|paper| paper.full));
}
