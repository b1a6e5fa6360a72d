//! Warning about the effective modulus of a layered flat.

use asperity::ModulusModel;
use asperity::compare::{GOOD_RATIO, ModulusFindings};

/// Warns where `rule` is inaccurate for the layer called `layer`; `None` where the moduli are close enough.
pub fn rule_warning(findings: &ModulusFindings, layer: &str, rule: ModulusModel) -> Option<String> {
    if findings.is_good() {
        return None;
    }
    let size = findings.worst_of(rule).map_or_else(String::new, |worst| {
        let direction = if worst.ratio > 1.0 { "stiff" } else { "compliant" };
        format!(
            ". Without yielding, rule \"{}\" is up to {:.2} times too {direction} (load at equal indentation relative to \
             the exact solution, a/t from {} to {}; largest at a/t = {})",
            rule.name(),
            worst.factor(),
            short(findings.range[0]),
            short(findings.range[1]),
            short(worst.contact_ratio),
        )
    });
    let [from, to] = GOOD_RATIO;
    Some(format!(
        "layer {layer}: its modulus is {} times the substrate's, outside the {from} to {to} in which rule \"gao\" is \
         accurate{size}",
        short(findings.modulus_ratio)
    ))
}

/// To three digits.
fn short(value: f64) -> String {
    format!("{value:.2e}").parse::<f64>().unwrap_or(value).to_string()
}
