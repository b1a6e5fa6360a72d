//! Warning about the effective modulus of a layered flat.

use asperity::ModulusModel;
use asperity::compare::{GOOD_RATIO, ModulusFindings};
use asperity_contact_framework::report::format::number;

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
            number(findings.range[0]),
            number(findings.range[1]),
            number(worst.contact_ratio),
        )
    });
    let [from, to] = GOOD_RATIO;
    Some(format!(
        "layer {layer}: its modulus is {} times the substrate's, outside the {from} to {to} in which rule \"gao\" is \
         accurate{size}",
        number(findings.modulus_ratio)
    ))
}
