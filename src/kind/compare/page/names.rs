//! Names of surfaces, laws and thicknesses on a page.

use asperity_framework::contact::LayerMetadata;
use asperity_framework::report::format::input_quantity;
use asperity_framework::report::page::escape;

use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// Subject of a finding: the surface, and the law where there are several.
pub fn subject(results: &CompareResults, found: &SurfaceResults, law: &str) -> String {
    let one_law = results.surfaces.iter().all(|found| found.findings.laws.len() == 1);
    if one_law { found.surface.name.clone() } else { format!("{}, law {law}", found.surface.name) }
}

/// The same as the beginning of a file's name.
pub fn stem(found: &SurfaceResults, law: &str) -> String {
    let name = &found.surface.name;
    if found.findings.laws.len() == 1 { name.clone() } else { format!("{name}-{}", slug(law)) }
}

/// A law's label as part of a file name.
fn slug(label: &str) -> String {
    let kept: String = label.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    kept.trim_matches('-').to_owned()
}

/// "under 50 nm of lead".
pub fn under(layer: &LayerMetadata, t: f64) -> String {
    let name = escape(&layer.name);
    match t {
        0.0 => "on the uncoated flat".to_owned(),
        f64::INFINITY => format!("on bulk {name}"),
        t => format!("under {} of {name}", input_quantity(t, "m")),
    }
}
