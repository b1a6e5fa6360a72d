//! Growth of the curvature towards short wavelengths: whether the grid resolves the summits.

use crate::topography::{Filter, HeightMap, RoughnessParameters, Rows, Window};

/// Points along an axis of the part of a map that is examined.
const WINDOW: usize = 1024;

/// How fast the r.m.s. curvature of a map grows with its short-wavelength cut-off at the pixel: log2 of the ratio between S
/// filters of two and of four pixels. 0 for a surface whose shortest waves are much longer; 2 - H for a self-affine one of
/// Hurst exponent H that the pixel cuts off; 3 for white noise. `None` for a map of fewer than 16 points along an axis.
pub fn curvature_growth(map: &dyn Rows) -> Option<f64> {
    let window = HeightMap::of(&Window::centre(map, WINDOW));
    let pixel = map.pixel()[0].max(map.pixel()[1]);
    let curvature = |pixels: f64| {
        let filtered = Filter::new(Some(pixels * pixel), None).ok()?.apply(&window).ok()?;
        let [_, _, m4] = RoughnessParameters::of(&filtered).spectral_moments();
        (m4 > 0.0).then(|| m4.sqrt())
    };
    if window.points().iter().any(|&count| count < 16) {
        return None;
    }
    Some((curvature(2.0)? / curvature(4.0)?).log2())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};

    fn growth(shape: SpectrumShape) -> f64 {
        let spectrum = Spectrum::new(shape, Lay::default()).unwrap().on_grid([256; 2], [1.0; 2]);
        let heights = gaussian(&spectrum, 1.0, [7; 32]);
        curvature_growth(&HeightMap::new([256; 2], [1.0; 2], heights, 0.0).unwrap()).unwrap()
    }

    #[test]
    fn the_growth_tells_resolved_from_cut_off_and_from_noise() {
        let self_affine = |hurst, cut_off| SpectrumShape::SelfAffine { hurst, roll_off: 128.0, cut_off };
        assert!(growth(self_affine(0.8, 16.0)) < 0.1);
        assert!(growth(self_affine(0.8, 8.0)) < 0.3);
        let cut = [0.9, 0.5, 0.2].map(|hurst| growth(self_affine(hurst, 2.0)));
        assert!(cut[0] > 0.8 && cut[0] < cut[1] && cut[1] < cut[2] && cut[2] < 1.5, "{cut:?}");
        let noise = growth(SpectrumShape::SelfAffine { hurst: 0.0, roll_off: 2.0, cut_off: 2.0 });
        assert!(noise > 1.8, "{noise}");
    }
}
