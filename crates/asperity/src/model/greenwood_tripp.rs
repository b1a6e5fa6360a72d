//! Two rough bodies whose asperities meet at an offset (Greenwood and Tripp 1971).

use std::f64::consts::PI;

use super::Statistical;
use crate::asperity::Population;
use crate::distribution::Heights;
use crate::interface::MicroContact;

/// Two populations that the model does not describe.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum GreenwoodTrippError {
    /// Another distribution than the normal one.
    #[error("heights that are not Gaussian")]
    NotGaussian,
    /// One body much smoother than the other: towards a smooth one the load of the model grows without bound.
    #[error(
        "one body has {ratio:.2} of the standard deviation of the other; allowed: at least {LEAST_RATIO}"
    )]
    Smooth {
        /// The smaller standard deviation over the larger one.
        ratio: f64,
    },
}

impl GreenwoodTrippError {
    /// Why the model does not describe two bodies, where it does not.
    pub fn of([first, second]: &[Population; 2]) -> Option<Self> {
        if [first, second].iter().any(|body| body.heights != Heights::GAUSSIAN) {
            return Some(Self::NotGaussian);
        }
        let larger = first.sigma.max(second.sigma);
        let ratio = if larger > 0.0 { first.sigma.min(second.sigma) / larger } else { 0.0 };
        (ratio < LEAST_RATIO).then_some(Self::Smooth { ratio })
    }
}

/// The smallest ratio of both standard deviations; towards 0 the load grows without bound.
const LEAST_RATIO: f64 = 0.5;

impl<'a> Statistical<'a> {
    /// Every asperity of one body against every one of the other, at places independent of each other: a pair at the offset r touches with the
    /// indentation w = z1 + z2 - d - r^2/(2 (R1 + R2)) and the radius R1 R2/(R1 + R2), so that for any law
    ///
    /// ```text
    /// p = 2 pi (R1 + R2) eta1 eta2 int P(w) Q((d + w)/sigma) dw,   sigma^2 = sigma1^2 + sigma2^2
    /// ```
    ///
    /// with the survival function Q of the normal distribution; the same of the area. Separations are between both mean asperity heights, in
    /// units of sigma. An asperity that meets several counts each time, without interaction.
    ///
    /// # Errors
    /// [`GreenwoodTrippError`].
    pub fn greenwood_tripp(
        contact: &'a dyn MicroContact,
        bodies: &[Population; 2],
    ) -> Result<Self, GreenwoodTrippError> {
        Ok(Self::new(contact, meeting_pairs(bodies)?).weighed_by_survival())
    }
}

/// Every asperity of one body with every one of the other, as the population over which the model integrates.
///
/// # Errors
/// [`GreenwoodTrippError`].
pub fn meeting_pairs(bodies: &[Population; 2]) -> Result<Population, GreenwoodTrippError> {
    let [first, second] = bodies;
    if let Some(error) = GreenwoodTrippError::of(bodies) {
        return Err(error);
    }
    let (sigma, radii) = (first.sigma.hypot(second.sigma), first.radius + second.radius);
    Ok(Population {
        radius: first.radius * second.radius / radii,
        sigma,
        density: 2.0 * PI * radii * first.density * second.density * sigma,
        heights: Heights::GAUSSIAN,
    })
}

/// The fit 4.4086e-5 (4 - h)^6.804 to F_5/2(h) that codes of mixed lubrication use, 0 from h = 4 on.
pub(crate) fn power_law(h: f64) -> f64 {
    4.4086e-5 * (4.0 - h).max(0.0).powf(6.804)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::gaussian_moment;
    use crate::interface::Interface;
    use crate::law::Hertz;
    use crate::{Material, Model};

    fn contact() -> impl MicroContact {
        let steel = Material::new(210e9, 0.3, Some(7.6e9), None).unwrap();
        Interface::bare(Hertz, &steel, &steel).unwrap()
    }

    fn body(radius: f64, sigma: f64, density: f64) -> Population {
        Population { radius, sigma, density, heights: Heights::GAUSSIAN }
    }

    /// p = (16 pi/15) E* eta1 eta2 ((R1 + R2) R1 R2)^.5 sigma^2.5 F_2.5(h), A/A_nom = pi^2 eta1 eta2 R1 R2 sigma^2 F_2(h).
    #[test]
    fn elastic_contact_has_closed_forms() {
        let contact = contact();
        let bodies = [body(2e-5, 4.8e-8, 6e10), body(8e-6, 6e-8, 4e10)];
        let model = Statistical::greenwood_tripp(&contact, &bodies).unwrap();
        let [first, second] = &bodies;
        let sigma = first.sigma.hypot(second.sigma);
        let product = first.radius * second.radius;
        let densities = first.density * second.density;
        for h in [-2.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0] {
            let response = model.respond(h);
            let load = 16.0 * PI / 15.0
                * contact.reference_modulus()
                * densities
                * ((first.radius + second.radius) * product).sqrt()
                * sigma.powf(2.5)
                * gaussian_moment(2.5, h);
            let area = PI * PI * densities * product * sigma * sigma * gaussian_moment(2.0, h);
            assert!((response.pressure.total() / load - 1.0).abs() < 1e-9, "{h}");
            assert!((response.area_ratio.total() / area - 1.0).abs() < 1e-9, "{h}");
            // d F_2.5/dh = -2.5 F_1.5.
            let stiffness = load * 2.5 * gaussian_moment(1.5, h) / gaussian_moment(2.5, h) / sigma;
            assert!((response.stiffness / stiffness - 1.0).abs() < 1e-9, "{h}");
        }
        // The far tail is without underflow, and a load gives its separation.
        let far = model.respond(20.0);
        assert!(far.pressure.total() > 0.0 && far.stiffness > 0.0);
        let back = model.separations_at(&[model.respond(1.5).pressure.total()])[0].unwrap();
        assert!((back - 1.5).abs() < 1e-12);
    }

    #[test]
    fn a_smooth_body_is_refused() {
        let contact = contact();
        let of = |sigma| {
            Statistical::greenwood_tripp(&contact, &[body(1e-5, 1e-7, 1e10), body(1e-5, sigma, 1e10)])
        };
        assert!(of(5e-8).is_ok() && of(2e-7).is_ok());
        for sigma in [4e-8, 3e-7, 0.0] {
            assert!(matches!(of(sigma), Err(GreenwoodTrippError::Smooth { .. })), "{sigma}");
        }
        let exponential = Population { heights: Heights::EXPONENTIAL, ..body(1e-5, 1e-7, 1e10) };
        let found = Statistical::greenwood_tripp(&contact, &[exponential, body(1e-5, 1e-7, 1e10)]);
        assert!(matches!(found, Err(GreenwoodTrippError::NotGaussian)));
    }
}
