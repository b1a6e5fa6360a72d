//! Sections of all pages: notes, set-up, provenance, references.

use asperity::Material;
use asperity::law::Body;
use indexmap::IndexMap;

use super::format::{input_number, input_quantity, quantity, thickness};
use super::page::{Page, escape, escape_around_code};
use crate::metadata::{Again, ContactMetadata, Metadata};

/// Notes of the author of the spec, folded.
pub fn notes(page: &mut Page, metadata: &Metadata) {
    page.details(2, "Notes", |page| {
        let paragraphs = metadata.notes.split("\n\n").map(str::trim);
        for paragraph in paragraphs.filter(|paragraph| !paragraph.is_empty()) {
            page.paragraph(&escape_around_code(&paragraph.replace('\n', " ")));
        }
    });
}

/// What a reader should know first: the first of the findings (inline Markdown) as the lead, the others as a list.
pub fn findings<T: AsRef<str>>(page: &mut Page, findings: impl IntoIterator<Item = T>) {
    let mut findings = findings.into_iter();
    if let Some(first) = findings.next() {
        page.lead(first.as_ref());
    }
    page.bullets(findings);
}

/// Warnings, folded where there are many.
pub fn warnings(page: &mut Page, warnings: &[String]) {
    /// So many are read by everybody.
    const MOST_SHOWN: usize = 2;
    let warnings: Vec<String> = warnings.iter().map(|warning| escape_around_code(warning)).collect();
    if warnings.len() <= MOST_SHOWN {
        warnings.iter().for_each(|warning| {
            page.warning(warning);
        });
        return;
    }
    page.details(2, &format!("{} warnings", warnings.len()), |page| {
        page.bullets(warnings);
    });
}

/// The command that runs the experiment again, and `spec` where it has no file.
pub fn run_again(page: &mut Page, metadata: &Metadata, spec: Option<&str>) {
    page.details(2, "How to run it again", |page| again(page, metadata, spec));
}

fn again(page: &mut Page, metadata: &Metadata, spec: Option<&str>) {
    if let Some(spec) = spec {
        page.paragraph("This spec runs the same (`--save-spec FILE` writes it):");
        page.code("toml", spec);
        return;
    }
    match &metadata.again {
        Again::Command(command) => {
            page.code("sh", command);
        }
        Again::Spec(spec) => {
            page.paragraph(
                "The spec, for `asperity.run` of the Python package as a dictionary, or for `experiment run` in a file. Surfaces that it names \
                 `map NAME` or `list NAME` were in memory.",
            );
            page.code("toml", spec);
        }
    }
}

/// The set-up: bodies and spec, and `more`, folded.
pub fn what_was_run(
    page: &mut Page,
    metadata: &Metadata,
    contact: &ContactMetadata,
    more: impl FnOnce(&mut Page),
) {
    page.details(2, "Set-up", |page| {
        set_up(page, metadata, contact);
        more(page);
    });
}

fn set_up(page: &mut Page, metadata: &Metadata, contact: &ContactMetadata) {
    let layer = contact.layer.as_ref();
    let [rough, flat] = match layer.map(|layer| layer.on) {
        None => ["rough", "flat"],
        Some(Body::Flat) => ["rough", "substrate"],
        Some(Body::Rough) => ["rough, substrate", "flat"],
    };
    let role = |name: &str| {
        let roles = [
            (name == contact.bodies.rough, rough),
            (name == contact.bodies.flat, flat),
            (layer.is_some_and(|layer| layer.name == name), "layer"),
        ];
        let roles: Vec<&str> = roles.into_iter().filter_map(|(is_it, role)| is_it.then_some(role)).collect();
        if roles.is_empty() { "not used".to_owned() } else { roles.join(" and ") }
    };
    materials(page, metadata, &contact.materials, contact.conducts, role);
    if let Some(layer) = layer {
        let thicknesses: Vec<String> = layer.thicknesses.iter().map(|&t| thickness(t)).collect();
        let (on, limits) = match layer.on {
            Body::Flat => ("", ""),
            Body::Rough => (
                " on the rough body",
                " The heights are those of the coated surface at every thickness. A coated asperity is taken as a layered half-space: its \
                 radius must be at least ten times the thickness.",
            ),
        };
        page.paragraph(&format!(
            "Layer of {}{on}: {}. Effective modulus of layer and substrate: rule `{}`.{limits}",
            escape(&layer.name),
            thicknesses.join(", "),
            layer.rule.name(),
        ));
    }
    let bare = if layer.is_some() { " without the layer" } else { "" };
    page.paragraph(&format!(
        "Reduced modulus E* = {}{bare}; hardness of the softer body: {}. {}",
        quantity(contact.reduced_modulus, "Pa"),
        hardness(contact.hardness),
        provenance(metadata),
    ));
}

/// The materials, the role of each, and the sources of values from the library; `conducts`: whether their electrical and their thermal
/// conduction count.
pub fn materials(
    page: &mut Page,
    metadata: &Metadata,
    materials: &IndexMap<String, Material>,
    conducts: [bool; 2],
    role: impl Fn(&str) -> String,
) {
    type Property = (&'static str, fn(&Material) -> Option<String>);
    let [electrical, thermal] = conducts;
    let has_yield_strength = materials.values().any(|body| body.yield_strength().is_some());
    let optional: [(bool, Property); 3] = [
        (has_yield_strength, ("Y", |body| body.yield_strength().map(|y| input_quantity(y, "Pa")))),
        (electrical, ("ρ", |body| body.resistivity().map(|rho| format!("{} Ω m", input_number(rho))))),
        (thermal, ("k", |body| body.thermal_conductivity().map(|k| format!("{} W/(m K)", input_number(k))))),
    ];
    let shown = || optional.iter().filter(|(is_shown, _)| *is_shown).map(|(_, property)| property);
    let row = |(name, body): (&String, &Material)| {
        let mut row = vec![
            name.clone(),
            role(name),
            input_quantity(body.young(), "Pa"),
            input_number(body.poisson()),
            hardness(body.hardness()),
        ];
        row.extend(shown().map(|(_, value)| value(body).unwrap_or_else(|| "-".to_owned())));
        row
    };
    let mut columns = vec!["material", "body", "E", "ν", "H"];
    columns.extend(shown().map(|(symbol, _)| *symbol));
    page.table(&columns, materials.iter().map(row));
    page.bullets(metadata.origins.iter().map(|(name, origin)| {
        let sources = [origin.sources(), origin.sources_of_conduction(conducts)].concat();
        format!(
            "{}: `{}` of the library, {}. {}.",
            escape(name),
            origin.from.name,
            escape(origin.from.description),
            escape(&by_source(&sources)),
        )
    }));
}

/// "young, poisson: a handbook; hardness: a data sheet", of values (in their order) and the source of each.
pub fn by_source(sources: &[(&str, String)]) -> String {
    let of_one = sources.chunk_by(|one, next| one.1 == next.1).map(|alike| {
        let keys: Vec<&str> = alike.iter().map(|(key, _)| *key).collect();
        format!("{}: {}", keys.join(", "), alike[0].1)
    });
    of_one.collect::<Vec<_>>().join("; ")
}

fn hardness(value: Option<f64>) -> String {
    value.map_or_else(|| "never yields".to_owned(), |v| input_quantity(v, "Pa"))
}

/// Seed, spec and program, in a sentence.
pub fn provenance(metadata: &Metadata) -> String {
    format!(
        "Seed {}; spec `{}.toml`, SHA-256 `{}`. Asperity {}.",
        metadata.seed,
        metadata.stem,
        metadata.spec_sha256,
        env!("CARGO_PKG_VERSION"),
    )
}

/// The papers that the experiment is based on.
pub fn sources(page: &mut Page, metadata: &Metadata) {
    page.details(2, "References", |page| {
        page.bullets(metadata.papers.iter().map(|paper| paper.full));
    });
}
