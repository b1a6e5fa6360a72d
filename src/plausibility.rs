//! Warnings about inputs that are allowed but hardly meant: mostly a unit that is missing or wrong. They refuse nothing.

use asperity::{Material, reduced_modulus};
use asperity_contact_framework::report::format::{number, quantity};

/// The rough body against each of the `flats` (substrate and layer), each with its name.
pub fn of_bodies(rough: (&str, &Material), flats: &[(&str, &Material)]) -> Vec<String> {
    let mut bodies = vec![rough];
    bodies.extend(flats.iter().filter(|flat| flat.0 != rough.0));
    let mut warnings: Vec<String> = bodies.iter().filter_map(|(name, body)| soft(name, body)).collect();
    warnings.extend(flats.iter().filter_map(|flat| hard(rough, *flat)));
    warnings
}

/// A modulus below that of any rubber.
fn soft(name: &str, body: &Material) -> Option<String> {
    /// Pa.
    const SOFTEST: f64 = 1e6;
    /// Moduli of engineering materials in GPa, as a number that lacks its unit.
    const GIGAPASCALS: std::ops::RangeInclusive<f64> = 0.01..=1500.0;
    let young = body.young();
    if young >= SOFTEST {
        return None;
    }
    let meant = if GIGAPASCALS.contains(&young) {
        format!("did you mean \"{} GPa\"?", number(young))
    } else {
        "check its unit".to_owned()
    };
    Some(format!(
        "material {name}: Young's modulus is {}, below 1 MPa and softer than rubber; a number without a unit is in Pa: {meant}",
        quantity(young, "Pa")
    ))
}

/// A hardness of the softer body that no material of its modulus has: above E*/5, of the pair and of two such bodies. A body
/// that is much more compliant, such as rubber, lowers the first only.
fn hard(rough: (&str, &Material), flat: (&str, &Material)) -> Option<String> {
    /// Of the reduced modulus; two diamonds have 0.19.
    const HARDEST: f64 = 0.2;
    let (name, body) = [rough, flat]
        .into_iter()
        .filter(|(_, body)| body.hardness().is_some())
        .min_by(|a, b| a.1.hardness().partial_cmp(&b.1.hardness()).unwrap_or(std::cmp::Ordering::Equal))?;
    let hardness = body.hardness()?;
    let limit = HARDEST * reduced_modulus(rough.1, flat.1).max(reduced_modulus(body, body));
    (hardness > limit).then(|| {
        format!(
            "material {name}: the hardness is {}, above E*/5 = {}; check the units of `hardness` and `young` (1 HV is 9.81 MPa), \
             or leave `hardness` out for a body that never yields",
            quantity(hardness, "Pa"),
            quantity(limit, "Pa")
        )
    })
}

/// The asperities of a surface: mean radius and standard deviation of the heights (m) on a nominal area (m^2). Radii above its
/// side are those of smooth surfaces, unless slopes, which are about the root of sigma over radius, are below those of
/// polished optics.
pub fn of_surface(name: &str, mean_radius: f64, sigma: f64, nominal_area: f64) -> Vec<String> {
    const FLAT: f64 = 1e-4;
    let side = nominal_area.sqrt();
    let mut warnings = Vec::new();
    if mean_radius > side && sigma < FLAT * FLAT * mean_radius {
        warnings.push(format!(
            "surface {name}: the mean asperity radius of {} is above the side of the nominal area of {}, and slopes are below those of \
             polished optics; check the units of radii, heights and area (a bare number is in metres)",
            quantity(mean_radius, "m"),
            quantity(side, "m")
        ));
    }
    if sigma > mean_radius {
        warnings.push(format!(
            "surface {name}: the standard deviation of the asperity heights, {}, is above their mean radius, {}: needles, for which \
             no contact law holds; check the units of heights and radii (lists are in metres)",
            quantity(sigma, "m"),
            quantity(mean_radius, "m")
        ));
    }
    warnings
}

/// Separations in units of sigma.
pub fn of_separations(separations: &[f64]) -> Option<String> {
    /// Beyond it a Gaussian population of the size of the Earth has no asperity.
    const FARTHEST: f64 = 40.0;
    let farthest = separations.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    (farthest.abs() > FARTHEST).then(|| {
        format!(
            "`separation` reaches {} σ, beyond ±40 σ, where no asperity or every one is in contact; separations are in units of \
             σ, not lengths: 4 to 0 covers most surfaces",
            number(farthest)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(young: f64, hardness: Option<f64>) -> Material {
        Material::new(young, 0.3, hardness, None).unwrap()
    }

    #[test]
    fn usual_inputs_raise_no_warning() {
        let (steel, diamond, rubber) = (body(210e9, Some(7.6e9)), body(960e9, Some(98e9)), body(2e6, None));
        assert!(of_bodies(("steel", &steel), &[("diamond", &diamond), ("rubber", &rubber)]).is_empty());
        assert!(of_bodies(("diamond", &diamond), &[("diamond", &diamond)]).is_empty());
        assert!(of_surface("a", 20e-6, 48e-9, 1e-6).is_empty());
        assert!(of_separations(&[4.0, 40.0, -40.0]).is_none() && of_separations(&[]).is_none());
    }

    #[test]
    fn a_missing_unit_is_named_with_its_remedy() {
        let (steel, bare) = (body(210e9, Some(7.6e9)), body(210.0, None));
        let found = of_bodies(("bare", &bare), &[("bare", &bare)]);
        assert!(
            matches!(&found[..], [one] if one.contains("210 Pa") && one.contains("\"210 GPa\"?")),
            "{found:?}"
        );
        assert!(of_bodies(("steel", &steel), &[("gel", &body(5e3, None))])[0].contains("check its unit"));
        let hard = body(210e9, Some(76e9));
        let found = of_bodies(("hard", &hard), &[("hard", &hard)]);
        assert!(matches!(&found[..], [one] if one.contains("76 GPa, above E*/5 = 23.1 GPa")), "{found:?}");
        // The softer body yields first.
        assert!(of_bodies(("hard", &hard), &[("steel", &steel)]).is_empty());
    }

    #[test]
    fn radii_heights_and_separations_out_of_scale_are_named() {
        assert!(
            of_surface("a", 20.0, 48e-9, 1e-6)[0]
                .contains("20 m is above the side of the nominal area of 1 mm")
        );
        // A polished surface.
        assert!(of_surface("a", 2e-3, 48e-9, 1e-6).is_empty());
        assert!(of_surface("a", 20e-6, 48e-6, 1e-6)[0].contains("48 µm, is above their mean radius, 20 µm"));
        assert!(of_separations(&[4.0, -200.0]).unwrap().contains("-200 σ"));
    }
}
