//! What every experiment has: title, seed, sources, bodies, time and work.

use asperity::compare::ModulusFindings;
use asperity::law::{Body, Property};
use asperity::study::LawContact;
pub use asperity::work::Timing;
use asperity::work::Work;
use asperity::{Material, ModulusModel, Paper, literature};
use asperity_plot::Size;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::input::material::MaterialOrigin;

#[derive(Debug, Clone)]
pub struct Metadata {
    pub title: String,
    /// Name of the spec's table of its kind.
    pub kind: &'static str,
    /// Name of the spec's file, without its ending.
    pub stem: String,
    pub again: Again,
    pub notes: String,
    /// SHA-256 of the spec, hexadecimal.
    pub spec_sha256: String,
    /// SHA-256 of the spec, of how it is run, and of its input files, hexadecimal.
    pub input_sha256: String,
    /// The size of its figures in print; `None` of figures for the page only.
    pub figure: Option<Size>,
    /// Whether it runs only where it is named or long runs are asked for.
    pub is_long: bool,
    /// Where the index lists its report.
    pub group: Option<Group>,
    /// SHA-256 of the sources of the library, hexadecimal.
    pub library_sha256: &'static str,
    /// Every random number came from it.
    pub seed: u64,
    /// The materials whose values are from the library.
    pub origins: IndexMap<String, MaterialOrigin>,
    pub papers: Vec<Paper>,
    pub timing: Timing,
    /// What was done; `None` where that depends on the clock, or is the experiment itself.
    pub work: Option<Work>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Again {
    Command(String),
    /// The spec itself, which has no file.
    Spec(String),
}

/// What a report is about, by which the index groups reports; one without a group is about its user's surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Group {
    /// Figures and surfaces of Pasaribu and Schipper (2005).
    Paper,
    /// Layers.
    Layers,
    /// Joints: what the contact conducts and how it resists sliding.
    Joints,
    /// Contact laws.
    Laws,
    /// Why the models differ.
    Why,
    /// Both models beside boundary elements.
    RealityCheck,
    /// How far to trust the program.
    Trust,
}

impl Group {
    /// All groups, in the order of the index.
    pub const ALL: [Self; 7] =
        [Self::Paper, Self::Layers, Self::Joints, Self::Laws, Self::Why, Self::RealityCheck, Self::Trust];

    /// Its heading in the index.
    pub fn title(self) -> &'static str {
        match self {
            Self::Paper => "The paper",
            Self::Layers => "Layers",
            Self::Joints => "Conductance and friction",
            Self::Laws => "Laws",
            Self::Why => "Why the models differ",
            Self::RealityCheck => "Reality check",
            Self::Trust => "How far to trust the program",
        }
    }
}

#[derive(Debug, Clone)]
pub struct Bodies {
    pub rough: String,
    pub flat: String,
}

#[derive(Debug, Clone)]
pub struct LayerMetadata {
    pub name: String,
    pub rule: ModulusModel,
    pub on: Body,
    /// Thicknesses, m, ascending; 0 and infinity among them.
    pub thicknesses: Vec<f64>,
    /// Accuracy of the effective-modulus models for these materials, a/t from 0.1 to 10; `None` without a finite thickness.
    pub check: Option<ModulusFindings>,
}

/// The two bodies of a contact.
#[derive(Debug, Clone)]
pub struct ContactMetadata {
    pub materials: IndexMap<String, Material>,
    pub bodies: Bodies,
    /// Reduced modulus of the pair, Pa.
    pub reduced_modulus: f64,
    /// Hardness of the softer body, Pa.
    pub hardness: Option<f64>,
    /// Whether its electrical and its thermal conductance are asked for.
    pub conducts: [bool; 2],
    pub layer: Option<LayerMetadata>,
    /// Laws used outside their range of validity, one per line.
    pub caveats: Vec<String>,
}

/// The fields of a summary that every contact has.
#[derive(Debug, Clone, Serialize)]
pub struct ContactSummary {
    reduced_modulus_pa: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    hardness_pa: Option<f64>,
}

impl ContactSummary {
    /// Of the bodies of an experiment.
    pub fn new(contact: &ContactMetadata) -> Self {
        Self { reduced_modulus_pa: contact.reduced_modulus, hardness_pa: contact.hardness }
    }
}

/// References for the laws and both models.
pub fn papers_of(laws: &[LawContact]) -> Vec<Paper> {
    let models = [literature::PASARIBU_SCHIPPER_2005, literature::ZHAO_MAIETTA_CHANG_2000];
    laws.iter().flat_map(papers_of_law).chain(models).collect()
}

fn papers_of_law(law: &LawContact) -> Vec<Paper> {
    law.contact.papers().into_iter().chain(law.spec.papers()).collect()
}

/// Description of two bodies under laws, for a report.
pub fn contact_metadata(
    materials: &IndexMap<String, Material>,
    laws: &[LawContact],
    bodies: &Bodies,
    layer: Option<LayerMetadata>,
) -> ContactMetadata {
    // All laws of an experiment have the same two bodies.
    let contact = &laws[0].contact;
    let mut caveats: Vec<String> = laws.iter().filter_map(|law| law.contact.caveat()).collect();
    caveats.extend(inconsistent_strengths(materials, laws, bodies, layer.as_ref()));
    caveats.sort_unstable();
    caveats.dedup();
    ContactMetadata {
        materials: materials.clone(),
        bodies: bodies.clone(),
        reduced_modulus: contact.reference_modulus(),
        hardness: Some(contact.reference_hardness()).filter(|hardness| hardness.is_finite()),
        conducts: contact
            .spot_properties()
            .map_or([false; 2], |properties| [properties.electrical.is_some(), properties.thermal.is_some()]),
        layer,
        caveats,
    }
}

/// Warns of materials whose hardness and yield strength are inconsistent, where laws use both.
fn inconsistent_strengths(
    materials: &IndexMap<String, Material>,
    laws: &[LawContact],
    bodies: &Bodies,
    layer: Option<&LayerMetadata>,
) -> Vec<String> {
    /// H/Y of metals; Chang, Etsion and Bogy (1987) take 2.8.
    const METALS: [f64; 2] = [2.0, 4.0];
    let takes = |property| laws.iter().any(|law| law.spec.law().yields_by() == Some(property));
    if !(takes(Property::Hardness) && takes(Property::YieldStrength)) {
        return Vec::new();
    }
    let names = [Some(&bodies.rough), Some(&bodies.flat), layer.map(|layer| &layer.name)];
    let caveat = |name: &String| {
        let body = materials.get(name)?;
        let ratio = body.hardness()? / body.yield_strength()?;
        let [from, to] = METALS;
        (!(from..=to).contains(&ratio)).then(|| {
            format!(
                "{name}: the hardness is {ratio:.2} times the yield strength (metals: {from} to {to}); laws that use the hardness \
                 and laws that use the yield strength then describe different materials"
            )
        })
    };
    names.into_iter().flatten().filter_map(caveat).collect()
}
