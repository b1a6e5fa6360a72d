//! Warnings about the effective modulus and the effective hardness of a layered body, and about layers that are thick for a rough one.

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
            "; rule `{}` is up to {:.2} times too {direction}, at a/t = {}",
            rule.name(),
            worst.factor(),
            number(worst.contact_ratio)
        )
    });
    let [from, to] = GOOD_RATIO;
    Some(format!(
        "layer {layer}: its modulus is {} times the substrate's; {from} to {to} suit rule `gao`{size}",
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
        "layer {layer} of {of}: contacts are up to {} times as wide as it is thick (a/t); from {WIDE} on shares of yielding are uncertain",
        number(largest)
    ))
}

/// A rough body that has a layer.
#[derive(Debug, Clone, Copy)]
pub struct CoatedSurface<'a> {
    pub name: &'a str,
    /// Mean radius of its asperities, m.
    pub radius: f64,
    /// Sq of its map, m; `None` of a surface without one.
    pub sq: Option<f64>,
}

impl CoatedSurface<'_> {
    /// Warns where the layer called `layer` is, in one of the `thicknesses` (m), too thick to be taken as a layered half-space below each
    /// asperity, or to follow the surface.
    pub fn warnings(self, layer: &str, thicknesses: &[f64]) -> Vec<String> {
        /// Of the mean radius: the layer's lower side then still has nine tenths of the radius of the upper one.
        const THICK: f64 = 0.1;
        let Some(t) = thicknesses.iter().copied().filter(|t| t.is_finite()).reduce(f64::max) else {
            return Vec::new();
        };
        let of = format!("layer {layer} of {} on the rough body, surface {}", quantity(t, "m"), self.name);
        let curved = (t > THICK * self.radius).then(|| {
            format!(
                "{of}: it is {} times as thick as the mean radius, {}; above 0.1 what it changes is uncertain",
                number(t / self.radius),
                quantity(self.radius, "m")
            )
        });
        let filling = self.sq.filter(|sq| t > *sq).map(|sq| {
            format!(
                "{of}: it is {} times as thick as Sq, {}, and may fill valleys; thickness below summits may differ by {} %",
                number(t / sq),
                quantity(sq, "m"),
                number(100.0 * sq / t)
            )
        });
        curved.into_iter().chain(filling).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_too_thick_for_a_rough_body_are_cautioned() {
        let surface = CoatedSurface { name: "a", radius: 10e-6, sq: Some(0.4e-6) };
        let warnings = |thicknesses: &[f64]| surface.warnings("dlc", thicknesses);
        assert_eq!(warnings(&[0.0, 0.4e-6, f64::INFINITY]), Vec::<String>::new());
        let between = warnings(&[0.0, 1e-6]);
        assert!(
            matches!(&between[..], [one] if one.starts_with("layer dlc of 1 µm on the rough body, surface a: it is 2.5 times as thick as Sq, 400 nm") && one.contains("by 40 %")),
            "{between:?}"
        );
        let thick = warnings(&[1e-7, 2e-6]);
        assert!(thick[0].contains("0.2 times as thick as the mean radius, 10 µm"), "{thick:?}");
        assert!(thick[1].contains("5 times as thick as Sq"), "{thick:?}");
        assert_eq!(CoatedSurface { sq: None, ..surface }.warnings("dlc", &[1e-6]), Vec::<String>::new());
    }

    #[test]
    fn contacts_wider_than_the_layer_are_cautioned() {
        let text = hardness_warning("dlc", [(1e-8, 14.6), (1e-7, 1.46), (1e-6, 0.15)].into_iter()).unwrap();
        assert!(
            text.starts_with("layer dlc of 10 nm to 100 nm: contacts are up to 14.6 times as wide"),
            "{text}"
        );
        let text = hardness_warning("dlc", [(1e-8, 1.0)].into_iter()).unwrap();
        assert!(text.starts_with("layer dlc of 10 nm: contacts are up to 1 times as wide"), "{text}");
        assert_eq!(hardness_warning("dlc", [(1e-6, 0.99)].into_iter()), None);
    }
}
