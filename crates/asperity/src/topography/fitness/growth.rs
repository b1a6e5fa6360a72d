//! Growth of the curvature towards short wavelengths: whether the grid resolves the summits. What the height steps of an instrument do to
//! them.

use crate::progress::Share;
use crate::topography::{Filter, HeightMap, Quantisation, RoughnessParameters, Rows, Watched, Window};

/// Points along an axis of the part of a map that is examined.
const WINDOW: usize = 1024;

/// The same for the height steps.
const STEPS_WINDOW: usize = 512;

/// How fast the r.m.s. curvature of a map grows with its short-wavelength cut-off near the pixel: log2 of the ratio between S
/// filters of n and of 2 n pixels. 0 for a surface whose shortest waves are much longer; 2 - H for a self-affine one of Hurst
/// exponent H that the pixel cuts off; 3 for white noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureGrowth {
    /// Between four pixels and two.
    pub at_pixel: f64,
    /// Between eight pixels and four; `None` for a map of fewer than 32 points along an axis.
    pub beyond: Option<f64>,
}

impl CurvatureGrowth {
    /// Of a map; `None` for one of fewer than 16 points along an axis.
    pub fn new(map: &dyn Rows) -> Option<Self> {
        let window = HeightMap::from_rows(&Window::centre(map, WINDOW));
        let shorter = window.points()[0].min(window.points()[1]);
        let pixel = map.pixel()[0].max(map.pixel()[1]);
        // A small part of what else is done to the map.
        let progress = &Share { progress: map.progress(), units: 0.0 };
        let curvature = |pixels: f64| {
            let filter = Filter::new(Some(pixels * pixel), None).ok()?;
            let filtered = filter.apply(&Watched { map: &window, progress }).ok()?;
            let [_, _, m4] =
                RoughnessParameters::new(&Watched { map: &filtered, progress }).spectral_moments();
            (m4 > 0.0).then(|| m4.sqrt())
        };
        if shorter < 16 {
            return None;
        }
        let [two, four] = [curvature(2.0)?, curvature(4.0)?];
        let beyond = if shorter < 32 { None } else { curvature(8.0).map(|eight| (four / eight).log2()) };
        Some(Self { at_pixel: (two / four).log2(), beyond })
    }

    /// By how much the growth rises towards the pixel: negative where the resolution cuts the roughness off.
    pub fn rise(&self) -> Option<f64> {
        self.beyond.map(|beyond| self.at_pixel - beyond)
    }
}

/// The height step of `quantisation` over the median drop from a summit to its neighbours. After a `filter` the step is what
/// the filter leaves of it: the rounding errors of the steps on the `map` are filtered alike, and the root mean square
/// difference between neighbours is expressed as the step that has it without a filter (of independent errors, step/6^.5).
/// `None` without a step.
pub fn step_over_drop(map: &dyn Rows, quantisation: &Quantisation, filter: Option<&Filter>) -> Option<f64> {
    let step = quantisation.step?;
    let left = filter.and_then(|filter| {
        let window = HeightMap::from_rows(&Window::centre(map, STEPS_WINDOW));
        let error = |z: &f64| (z / step).round() * step - z;
        let errors = window.heights().iter().map(error).collect();
        let errors = HeightMap::new(window.points(), window.pixel(), errors, 0.0).ok()?;
        let [x, y] = RoughnessParameters::new(&filter.apply(&errors).ok()?).drops.first;
        Some((6.0 * 0.5 * (x + y)).sqrt())
    });
    Some(left.unwrap_or(step) / quantisation.median_drop)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};
    use crate::topography::summits::five_point;

    fn heights(shape: SpectrumShape) -> Vec<f64> {
        gaussian(&Spectrum::new(shape, Lay::default()).unwrap().on_grid([256; 2], [1.0; 2]), 1.0, [7; 32])
    }

    fn of(heights: Vec<f64>) -> CurvatureGrowth {
        CurvatureGrowth::new(&HeightMap::new([256; 2], [1.0; 2], heights, 0.0).unwrap()).unwrap()
    }

    fn growth(shape: SpectrumShape) -> f64 {
        let found = of(heights(shape));
        assert!(found.rise().unwrap() < 0.02, "no noise: {found:?}");
        found.at_pixel
    }

    #[test]
    fn the_growth_tells_resolved_from_cut_off_and_from_noise() {
        let self_affine = |hurst, cut_off| SpectrumShape::SelfAffine { hurst, roll_off: 128.0, cut_off };
        assert!(growth(self_affine(0.8, 16.0)) < 0.1);
        assert!(growth(self_affine(0.8, 8.0)) < 0.3);
        let cut = [0.9, 0.5, 0.2].map(|hurst| growth(self_affine(hurst, 2.0)));
        assert!(cut[0] > 0.8 && cut[0] < cut[1] && cut[1] < cut[2] && cut[2] < 1.5, "{cut:?}");
        let noise = heights(SpectrumShape::SelfAffine { hurst: 0.0, roll_off: 2.0, cut_off: 2.0 });
        assert!(of(noise.clone()).at_pixel > 1.8);
        // Little noise on a surface that the grid resolves: the growth rises towards the pixel.
        let good = heights(self_affine(0.8, 8.0));
        let noisy = of(good.iter().zip(&noise).map(|(z, noise)| z + 0.03 * noise).collect());
        assert!(noisy.at_pixel < 1.5 && noisy.rise().unwrap() > 0.1, "{noisy:?}");
        let small = HeightMap::new([20, 40], [1.0; 2], good[..800].to_vec(), 0.0).unwrap();
        assert_eq!(CurvatureGrowth::new(&small).unwrap().beyond, None);
    }

    /// The remedy clears the check, and the step without it is the one of the instrument.
    #[test]
    fn a_filter_takes_the_steps_out() {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 64.0, cut_off: 12.0 };
        let spectrum = Spectrum::new(shape, Lay::default()).unwrap().on_grid([256; 2], [1.0; 2]);
        let heights = gaussian(&spectrum, 1.0, [5; 32]);
        let over = |step: f64, filter: Option<f64>| {
            let stepped = heights.iter().map(|z| (z / step).round() * step).collect();
            let raw = HeightMap::new([256; 2], [1.0; 2], stepped, 0.0).unwrap();
            let filter = filter.map(|s| Filter::new(Some(s), None).unwrap());
            let map = filter.map_or(raw.clone(), |filter| filter.apply(&raw).unwrap());
            let quantisation = Quantisation::new(&raw, &five_point(&map), filter.is_some());
            assert!(filter.is_none() || quantisation.distinct_curvatures > 100);
            step_over_drop(&map, &quantisation, filter.as_ref()).unwrap()
        };
        let bare = over(0.05, None);
        assert!(bare > 0.5, "{bare}");
        let [little, more] = [6.0, 12.0].map(|s| over(0.05, Some(s)));
        assert!(more < little && little < bare && more < 0.2, "{bare} {little} {more}");
        assert!(over(1e-4, None) < 0.02);
    }
}
