//! Asperity heights from surface heights (Nayak 1971), where sigma is that of the surface.

use std::f64::consts::PI;

/// An isotropic Gaussian surface, given by its standard deviation and the density and mean curvature of its summits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceHeights {
    /// 1/(mean summit curvature), m.
    pub radius: f64,
    /// Standard deviation of the surface heights, m.
    pub sigma: f64,
    /// Summits per area, 1/m^2.
    pub density: f64,
}

/// No isotropic Gaussian surface has these three numbers.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "density * radius * sigma = {product:.4} with heights = \"surface\"; allowed: above {MIN_PRODUCT:.4}, where Nayak's alpha reaches 1.5"
)]
pub struct SurfaceHeightsError {
    product: f64,
}

/// (density radius sigma)^2 = alpha/(768 pi), and alpha is at least 1.5.
const MIN_PRODUCT: f64 = 0.024934;

impl SurfaceHeights {
    fn product(&self) -> f64 {
        self.density * self.radius * self.sigma
    }

    /// Nayak's bandwidth parameter alpha = m0 m4/m2^2, from eta = m4/(6 pi 3^.5 m2) and a mean
    /// curvature of (8/3)(m4/pi)^.5.
    pub fn alpha(&self) -> f64 {
        768.0 * PI * self.product().powi(2)
    }

    /// Standard deviation of the summit heights, m: sigma (1 - (1 + 16/pi - 3 3^.5)/alpha)^.5.
    ///
    /// # Errors
    /// `alpha` at most 1.5, which no surface has.
    pub fn asperity_sigma(&self) -> Result<f64, SurfaceHeightsError> {
        let alpha = self.alpha();
        if alpha > 1.5 {
            Ok(self.sigma * (1.0 - (1.0 + 16.0 / PI - 3.0 * 3f64.sqrt()) / alpha).sqrt())
        } else {
            Err(SurfaceHeightsError { product: self.product() })
        }
    }

    /// Mean summit height above the mean plane, m: 4 (m0/(pi alpha))^.5.
    pub fn mean_asperity_height(&self) -> f64 {
        4.0 * self.sigma / (PI * self.alpha()).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// PHYSICS part B gives these for Table 1 of Pasaribu and Schipper (2005).
    #[test]
    fn table_1_read_as_surface_heights() {
        for (radius, sigma, density, alpha, ratio, offset) in
            [(2e-5, 4.8e-8, 6e10, 8.00, 0.942, 0.798), (1.6e-6, 2.6e-7, 9e10, 3.38, 0.857, 1.227)]
        {
            let surface = SurfaceHeights { radius, sigma, density };
            assert!((surface.alpha() - alpha).abs() < 5e-3);
            assert!((surface.asperity_sigma().unwrap() / sigma - ratio).abs() < 5e-4);
            assert!((surface.mean_asperity_height() / sigma - offset).abs() < 5e-4);
        }
    }

    #[test]
    fn the_least_product_is_that_of_alpha_1_5() {
        let at = |product| SurfaceHeights { radius: product, sigma: 1.0, density: 1.0 };
        assert!((at(MIN_PRODUCT).alpha() - 1.5).abs() < 1e-4);
        assert!(at(0.99 * MIN_PRODUCT).asperity_sigma().is_err());
    }
}
