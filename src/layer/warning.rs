//! Warnings about the effective modulus and the effective hardness of a layered flat.

use asperity::ModulusModel;
use asperity::compare::{GOOD_RATIO, ModulusFindings};
use asperity_contact_framework::report::format::{number, quantity};

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

/// Contact radius over thickness from which the effective hardness is cautioned: the largest shear stress, 0.48 contact radii deep under a
/// sphere (Hertz; Poisson's ratio 0.3), leaves the layer at about twice as much.
const WIDE: f64 = 1.0;

/// Warns where contacts that may yield are wide against the layer called `layer`; `ratios` are thicknesses (m) and the largest mean contact
/// radius over each. `None` where none is.
pub fn hardness_warning(layer: &str, ratios: impl Iterator<Item = (f64, f64)>) -> Option<String> {
    let wide: Vec<(f64, f64)> = ratios.filter(|(_, ratio)| *ratio >= WIDE).collect();
    let largest = wide.iter().map(|(_, ratio)| *ratio).reduce(f64::max)?;
    let thin = wide.iter().map(|(t, _)| *t).fold(f64::INFINITY, f64::min);
    let thick = wide.iter().map(|(t, _)| *t).fold(0.0, f64::max);
    let of = if thin == thick {
        quantity(thin, "m")
    } else {
        format!("{} to {}", quantity(thin, "m"), quantity(thick, "m"))
    };
    Some(format!(
        "layer {layer} of {of}: the mean contact radius a reaches {} times the thickness t. The largest shear stress lies 0.48 a deep, \
         in the substrate from a/t of about 2, and the effective hardness, a rule in w/t, does not look there. From a/t = {WIDE} on \
         shares of yielding are uncertain",
        number(largest)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contacts_wider_than_the_layer_are_cautioned() {
        let text = hardness_warning("dlc", [(1e-8, 14.6), (1e-7, 1.46), (1e-6, 0.15)].into_iter()).unwrap();
        assert!(
            text.starts_with("layer dlc of 10 nm to 100 nm: the mean contact radius a reaches 14.6 times"),
            "{text}"
        );
        let text = hardness_warning("dlc", [(1e-8, 1.0)].into_iter()).unwrap();
        assert!(text.starts_with("layer dlc of 10 nm: the mean contact radius a reaches 1 times"), "{text}");
        assert_eq!(hardness_warning("dlc", [(1e-6, 0.99)].into_iter()), None);
    }
}
