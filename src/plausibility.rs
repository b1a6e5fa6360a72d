//! Warnings about inputs that are allowed but hardly meant: mostly a unit that is missing or wrong. They refuse nothing.

use asperity::surface::Surface;
use asperity::{Material, MeanRadius, Response, reduced_modulus};
use asperity_contact_framework::report::format::{number, quantity};

/// A layer is thinner and a pixel smaller, m.
const LARGEST_LENGTH: f64 = 1e-3;

/// The rough body against each of the `flats` (substrate and layer), each with its name. `is_given` tells whether the spec itself
/// gives a key of a material, not the library.
pub fn of_bodies(
    rough: (&str, &Material),
    flats: &[(&str, &Material)],
    is_given: impl Fn(&str, &str) -> bool,
) -> Vec<String> {
    let mut bodies = vec![rough];
    bodies.extend(flats.iter().filter(|flat| flat.0 != rough.0));
    let mut warnings = Vec::new();
    for (name, body) in bodies {
        warnings.extend(modulus(name, body).filter(|_| is_given(name, "young")));
        warnings.extend(soft(name, body).filter(|_| is_given(name, "hardness")));
    }
    warnings.extend(flats.iter().filter_map(|flat| hard(rough, *flat)));
    warnings
}

/// A modulus far from those of solids.
fn modulus(name: &str, body: &Material) -> Option<String> {
    /// Below that of any rubber, Pa.
    const SOFTEST: f64 = 1e6;
    /// Between most solids and rubber, Pa.
    const COMPLIANT: f64 = 1e9;
    /// Above that of diamond, Pa.
    const STIFFEST: f64 = 2e12;
    /// Moduli of engineering materials in GPa, as a number that lacks its unit.
    const GIGAPASCALS: std::ops::RangeInclusive<f64> = 0.01..=1500.0;
    let young = body.young();
    let what = if young < SOFTEST {
        let meant = if GIGAPASCALS.contains(&young) {
            format!("did you mean \"{} GPa\"?", number(young))
        } else {
            "check its unit (mPa is milli, MPa mega)".to_owned()
        };
        format!("below 1 MPa and softer than rubber: {meant}")
    } else if young < COMPLIANT {
        "below 1 GPa, as of rubber and soft polymers; check its unit if that is not meant".to_owned()
    } else if young > STIFFEST {
        "above 2 TPa, stiffer than any material; check its unit unless a rigid body is meant".to_owned()
    } else {
        return None;
    };
    Some(format!("material {name}: Young's modulus is {}, {what}", quantity(young, "Pa")))
}

/// A hardness below that of most solids.
fn soft(name: &str, body: &Material) -> Option<String> {
    /// Pa; indium has about 9 MPa.
    const SOFTEST: f64 = 1e7;
    let hardness = body.hardness().filter(|&hardness| hardness < SOFTEST)?;
    Some(format!(
        "material {name}: the hardness is {}, below 10 MPa and softer than lead; check its unit (mPa is milli, MPa mega, 1 HV is \
         9.81 MPa)",
        quantity(hardness, "Pa")
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

/// R.m.s. slopes below those of polished optics.
const FLAT: f64 = 1e-4;

/// A surface that was made, on which the statistical model has this mean radius: of a map by its own slope, unless its file states its
/// units.
pub fn of_made(surface: &Surface, mean_radius: MeanRadius) -> Vec<String> {
    /// The ratio is 1.2 for Gaussian heights, and 1.5 for those of machined surfaces.
    const FEW_FLAT_TOPS: f64 = 4.0;
    let Surface { name, statistics, set, map, unscattered, .. } = surface;
    if unscattered.is_some() {
        return Vec::new();
    }
    let is_flat = match map {
        Some(map) => map.is_held != [true; 2] && map.roughness.rms_slope() < FLAT,
        None => is_flat(statistics.mean_radius, statistics.sigma),
    };
    let mut warnings = of_surface(
        name,
        statistics.mean_radius,
        statistics.sigma,
        set.nominal_area(),
        is_flat,
        map.is_some(),
    );
    let spread = statistics.mean_radius / statistics.radius_of_mean_curvature;
    if map.is_some() && spread > FEW_FLAT_TOPS && mean_radius == MeanRadius::default() {
        warnings.push(format!(
            "surface {name}: the mean radius is {spread:.1} times the radius of the mean curvature: it is dominated by a few nearly flat \
             summits. `statistical = {{ mean-radius = \"inverse-mean-curvature\" }}` selects the other mean."
        ));
    }
    warnings
}

/// Asperities without a map, whose slopes are about the root of sigma over radius.
pub fn of_asperities(name: &str, mean_radius: f64, sigma: f64, nominal_area: f64) -> Vec<String> {
    of_surface(name, mean_radius, sigma, nominal_area, is_flat(mean_radius, sigma), false)
}

fn is_flat(mean_radius: f64, sigma: f64) -> bool {
    sigma < FLAT * FLAT * mean_radius
}

/// The asperities of a surface: mean radius and standard deviation of the heights (m) on a nominal area (m^2). Radii above its
/// side are those of smooth surfaces, unless slopes are below those of polished optics.
fn of_surface(
    name: &str,
    mean_radius: f64,
    sigma: f64,
    nominal_area: f64,
    is_flat: bool,
    is_map: bool,
) -> Vec<String> {
    let side = nominal_area.sqrt();
    let mut warnings = Vec::new();
    if mean_radius > side && is_flat {
        warnings.push(format!(
            "surface {name}: the mean asperity radius of {} is above the side of the nominal area of {}, and slopes are below those of \
             polished optics; check the units of radii, heights and area (a bare number is in metres)",
            quantity(mean_radius, "m"),
            quantity(side, "m")
        ));
    }
    if sigma > mean_radius {
        let check = match is_map {
            true => {
                "noise of the instrument, which an S filter removes, or heights and pixel in different units"
            }
            false => "check the units of heights and radii (lists are in metres)",
        };
        warnings.push(format!(
            "surface {name}: the standard deviation of the asperity heights, {}, is above their mean radius, {}: needles, for which \
             no contact law holds; {check}",
            quantity(sigma, "m"),
            quantity(mean_radius, "m")
        ));
    }
    warnings
}

/// The thicknesses (m) of the layer called `name`.
pub fn of_thicknesses(name: &str, thicknesses: &[f64]) -> Option<String> {
    let thickest = thicknesses.iter().copied().filter(|t| t.is_finite()).max_by(f64::total_cmp)?;
    (thickest > LARGEST_LENGTH).then(|| {
        format!(
            "layer {name}: a thickness of {}, above 1 mm; check its unit (\"inf\" is the bulk of the layer)",
            quantity(thickest, "m")
        )
    })
}

/// The distance of the points of a map (m) along x and y.
pub fn of_pixel(surface: &str, pixel: [f64; 2]) -> Option<String> {
    let largest = pixel[0].max(pixel[1]);
    (largest > LARGEST_LENGTH).then(|| {
        format!("surface {surface}: a pixel of {}, above 1 mm; check its unit", quantity(largest, "m"))
    })
}

/// Nominal pressures, Pa.
pub fn of_pressures(pressures: &[f64]) -> Option<String> {
    /// Less than the weight of a sheet of paper.
    const LEAST: f64 = 1.0;
    let least = pressures.iter().copied().min_by(f64::total_cmp)?;
    (least < LEAST).then(|| {
        format!(
            "the nominal pressure is {}, below 1 Pa; check its unit (mPa is milli, MPa mega)",
            quantity(least, "Pa")
        )
    })
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

/// The responses at prescribed separations, where asperities would cover more than the nominal area.
pub fn of_overlap<'a>(surface: &str, responses: impl Iterator<Item = &'a Response>) -> Option<String> {
    let overlapping: Vec<&Response> =
        responses.filter(|response| response.area_ratio.total() >= 1.0).collect();
    let nearest =
        overlapping.iter().max_by(|a, b| a.separation_over_sigma.total_cmp(&b.separation_over_sigma))?;
    let largest = overlapping.iter().map(|response| response.area_ratio.total()).fold(0.0, f64::max);
    Some(format!(
        "surface {surface}: from d = {} σ down the surfaces overlap completely: the contact area of the asperities is up to {} times \
         the nominal area, which no model of separate asperities describes; separations of 4 to 0 σ cover most surfaces",
        number(nearest.separation_over_sigma),
        number(largest)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(young: f64, hardness: Option<f64>) -> Material {
        Material::new(young, 0.3, hardness, None).unwrap()
    }

    fn given(rough: (&str, &Material), flat: (&str, &Material)) -> Vec<String> {
        of_bodies(rough, &[flat], |_, _| true)
    }

    #[test]
    fn usual_inputs_raise_no_warning() {
        let (steel, diamond, rubber) = (body(210e9, Some(7.6e9)), body(960e9, Some(98e9)), body(2e6, None));
        assert!(given(("steel", &steel), ("diamond", &diamond)).is_empty());
        assert!(given(("diamond", &diamond), ("diamond", &diamond)).is_empty());
        assert!(of_bodies(("steel", &steel), &[("rubber", &rubber)], |_, _| false).is_empty());
        assert!(of_asperities("a", 20e-6, 48e-9, 1e-6).is_empty());
        assert!(of_separations(&[4.0, 40.0, -40.0]).is_none() && of_separations(&[]).is_none());
        assert!(of_thicknesses("dlc", &[0.0, 1e-3, f64::INFINITY]).is_none());
        assert!(of_pixel("a", [1e-3, 1e-6]).is_none() && of_pressures(&[1.0, 1e6]).is_none());
    }

    /// What `check` and a run say of them is in `tests/experiment/caveats.rs`.
    #[test]
    fn inputs_out_of_scale_are_named() {
        let (steel, hard) = (body(210e9, Some(7.6e9)), body(210e9, Some(76e9)));
        let beside_steel = |young, hardness| given(("steel", &steel), ("other", &body(young, hardness)));
        for (warnings, words) in [
            (beside_steel(5e3, None), "check its unit (mPa"),
            (beside_steel(2e6, None), "2 MPa, below 1 GPa"),
            (beside_steel(1e18, None), "above 2 TPa"),
            (beside_steel(210e9, Some(7.6e-3)), "the hardness is 7.6 mPa, below 10 MPa"),
            (given(("hard", &hard), ("hard", &hard)), "76 GPa, above E*/5 = 23.1 GPa"),
            (of_asperities("a", 20.0, 48e-9, 1e-6), "20 m is above the side of the nominal area of 1 mm"),
            (of_thicknesses("dlc", &[0.0, 2.0, f64::INFINITY]).into_iter().collect(), "a thickness of 2 m"),
            (of_pixel("a", [1e-6, 0.196733]).into_iter().collect(), "a pixel of 197 mm"),
            (of_pressures(&[1e6, 1e-3]).into_iter().collect(), "1 mPa, below 1 Pa"),
            (of_separations(&[4.0, -200.0]).into_iter().collect(), "-200 σ"),
        ] {
            assert!(warnings.first().is_some_and(|first| first.contains(words)), "{words}: {warnings:?}");
        }
        // The softer body yields first; a polished surface has large radii.
        assert!(given(("hard", &hard), ("steel", &steel)).is_empty());
        assert!(of_asperities("a", 2e-3, 48e-9, 1e-6).is_empty());
    }
}
