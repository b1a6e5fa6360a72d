//! Names of surfaces, laws and thicknesses on a page.

use asperity::law::Body;
use asperity_contact_framework::contact::LayerMetadata;
use asperity_contact_framework::report::format::input_quantity;

use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// The surface, and the law where there are several.
pub fn subject(results: &CompareResults, surface: &SurfaceResults, law: &str) -> String {
    let has_one_law = results.surfaces.iter().all(|surface| surface.laws.len() == 1);
    let name = &surface.surface.name;
    if has_one_law { name.clone() } else { format!("{name}, law {law}") }
}

/// The same as the beginning of a file's name.
pub fn stem(surface: &SurfaceResults, law: &str) -> String {
    let name = &surface.surface.name;
    if surface.laws.len() == 1 { name.clone() } else { format!("{name}-{}", slug(law)) }
}

/// A law's label as part of a file name.
fn slug(label: &str) -> String {
    let kept: String = label.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    kept.trim_matches('-').to_owned()
}

/// "under 50 nm of lead", or "50 nm of lead on the rough body".
pub fn under(layer: &LayerMetadata, t: f64) -> String {
    let of = || format!("{} of {}", input_quantity(t, "m"), layer.name);
    match (layer.on, t) {
        (Body::Flat, 0.0) => "on the uncoated flat".to_owned(),
        (Body::Flat, f64::INFINITY) => format!("on bulk {}", layer.name),
        (Body::Flat, _) => format!("under {}", of()),
        (Body::Rough, 0.0) => "rough body uncoated".to_owned(),
        (Body::Rough, f64::INFINITY) => format!("rough body of bulk {}", layer.name),
        (Body::Rough, _) => format!("{} on the rough body", of()),
    }
}
