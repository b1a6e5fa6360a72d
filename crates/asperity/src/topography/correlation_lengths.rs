//! Correlation lengths of a map: of its heights, and of the amplitude of its roughness where that varies from place to place.

use super::correlation::along_axes;
use super::{Autocorrelation, HeightMap};
use crate::progress::Progress;

/// The correlation length is the lag at which the autocorrelation has decayed to this value.
const DECAY: f64 = 0.2;

/// Roughness is patchy where the autocorrelation of the magnitudes of its heights exceeds the square of that of the heights by more
/// than this, in the mean over lags from two to four correlation lengths. Of a Gaussian surface both are equal within 0.02 (the
/// autocorrelation of |z| is its square within 0.03 at any value), of transformed heights within 0.03 where the heights hardly
/// correlate. An amplitude that scatters by a fifth gives 0.06, and the intervals of maps below the limit hold (`coverage`).
const PATCHY: f64 = 0.03;

/// Correlation lengths of a map along x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrelationLengths {
    /// Of the heights along x and y, m; infinite where the autocorrelation does not decay within half of the map.
    pub lengths: [f64; 2],
    /// Of the amplitude of the roughness along x and y, m, as above; `None` where it does not vary.
    pub patches: Option<[f64; 2]>,
}

impl CorrelationLengths {
    /// Of heights whose correlation does not decay.
    pub const NONE: Self = Self { lengths: [f64::INFINITY; 2], patches: None };

    /// Of the present points of a map about their `mean` (m), with the autocorrelation of the heights; `None` for a flat map.
    /// Four units of work, six on a map with missing points.
    pub fn from_map(map: &HeightMap, mean: f64, progress: &dyn Progress) -> Option<(Self, Autocorrelation)> {
        let heights = Autocorrelation::from_map(map, mean, progress)?;
        let lengths = Self::from_autocorrelation(&heights);
        let patches = magnitudes(map, mean, progress).and_then(|of| lengths.patches(&heights, &of));
        Some((Self { patches, ..lengths }, heights))
    }

    /// The lags at which `autocorrelation` has decayed to 0.2 along x and y.
    pub fn from_autocorrelation(autocorrelation: &Autocorrelation) -> Self {
        let decay = |points: &[(f64, f64)]| {
            let first = points.iter().position(|&(_, value)| value < DECAY)?;
            let [before, after] = [first.checked_sub(1)?, first].map(|k| points[k]);
            Some(before.0 + (after.0 - before.0) * (before.1 - DECAY) / (before.1 - after.1))
        };
        let axis = |points: &[(f64, f64)]| decay(points).unwrap_or(f64::INFINITY);
        Self { lengths: [axis(&autocorrelation.along_x), axis(&autocorrelation.along_y)], patches: None }
    }

    /// The longer of the lengths of heights and amplitude along x and y, m.
    pub fn longest(&self) -> [f64; 2] {
        let patches = self.patches.unwrap_or_default();
        [0, 1].map(|axis| self.lengths[axis].max(patches[axis]))
    }

    /// The lags at which what `magnitudes` correlate beyond the square of the correlation of `heights` has decayed to 0.2 of what it
    /// is at twice to four times the correlation length; `None` where that is little.
    fn patches(&self, heights: &Autocorrelation, [x, y]: &[Vec<(f64, f64)>; 2]) -> Option<[f64; 2]> {
        let axes = [
            Excess::new(&heights.along_x, x, self.lengths[0]),
            Excess::new(&heights.along_y, y, self.lengths[1]),
        ];
        // An axis along which the heights correlate over half of the map tells nothing.
        let onsets: Vec<f64> = axes.iter().flatten().map(|axis| axis.onset).collect();
        let onset = onsets.iter().sum::<f64>() / onsets.len() as f64;
        (onset > PATCHY).then(|| axes.map(|axis| axis.map_or(0.0, |axis| axis.decay(DECAY * onset))))
    }
}

/// The autocorrelation along both axes of the magnitudes of the heights of a map about their `mean` (m).
fn magnitudes(map: &HeightMap, mean: f64, progress: &dyn Progress) -> Option<[Vec<(f64, f64)>; 2]> {
    let present = || map.heights().iter().filter(|z| !z.is_nan());
    let average = present().map(|z| (z - mean).abs()).sum::<f64>() / present().count() as f64;
    along_axes(map, &|z| (z - mean).abs() - average, progress)
}

/// What the magnitudes of the heights correlate beyond the square of the correlation of the heights, along an axis.
struct Excess {
    /// By lag, in points.
    values: Vec<f64>,
    /// Distance of the points, m.
    step: f64,
    /// Correlation length of the heights, in points.
    length: usize,
    /// Mean over lags from two to four correlation lengths.
    onset: f64,
}

impl Excess {
    /// Of heights of the correlation `length` (m); `None` where four times that is more than the lags known.
    fn new(heights: &[(f64, f64)], magnitudes: &[(f64, f64)], length: f64) -> Option<Self> {
        let step = heights.get(1)?.0;
        let values: Vec<f64> =
            heights.iter().zip(magnitudes).map(|((_, rho), (_, of))| of - rho * rho).collect();
        let place = |lengths: f64| (lengths * length / step).ceil();
        if place(4.0) >= values.len() as f64 {
            return None;
        }
        let range = &values[place(2.0) as usize..=place(4.0) as usize];
        let onset = range.iter().sum::<f64>() / range.len() as f64;
        Some(Self { onset, length: place(1.0) as usize, step, values })
    }

    /// The first lag (m) from twice the correlation length on about which the mean over two correlation lengths is below `least`; infinite
    /// where there is none.
    fn decay(&self, least: f64) -> f64 {
        let mean = |lag: usize| {
            let around = &self.values[lag - self.length..=lag + self.length];
            around.iter().sum::<f64>() / around.len() as f64
        };
        let lags = 2 * self.length..self.values.len() - self.length;
        lags.into_iter().find(|lag| mean(*lag) < least).map_or(f64::INFINITY, |lag| lag as f64 * self.step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::stream_seed;
    use crate::progress::Silent;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};

    const POINTS: [usize; 2] = [512, 512];

    fn field(shape: SpectrumShape, elongation: f64, name: &str) -> Vec<f64> {
        let spectrum = Spectrum::new(shape, Lay { elongation, angle: 0.0 }).unwrap();
        gaussian(&spectrum.on_grid(POINTS, [1.0; 2]), 1.0, stream_seed(1, name))
    }

    fn rough(elongation: f64) -> Vec<f64> {
        field(SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 16.0, cut_off: 3.0 }, elongation, "rough")
    }

    fn patches(heights: Vec<f64>) -> Option<[f64; 2]> {
        let map = HeightMap::new(POINTS, [1.0; 2], heights, 0.0).unwrap();
        CorrelationLengths::from_map(&map, 0.0, &Silent).unwrap().0.patches
    }

    /// Heights whose amplitude varies as exp(`modulation` f), f with the correlation `length`.
    fn patchy(modulation: f64, length: f64) -> Vec<f64> {
        let amplitude = field(SpectrumShape::Gaussian(length), 1.0, "amplitude");
        rough(1.0).iter().zip(amplitude).map(|(z, f)| z * (modulation * f).exp()).collect()
    }

    #[test]
    fn an_amplitude_that_varies_is_found_with_its_length() {
        for (modulation, length) in [(0.5, 40.0), (0.3, 40.0), (0.3, 20.0)] {
            let [x, y] = patches(patchy(modulation, length)).unwrap();
            // exp(-(r/l)^2) has decayed to 0.2 at 1.27 l.
            assert!((0.7..2.0).contains(&(x / length)) && (0.7..2.0).contains(&(y / length)), "{x} {y}");
        }
        assert_eq!(patches(patchy(0.05, 40.0)), None);
    }

    #[test]
    fn homogeneous_surfaces_of_any_heights_have_no_patches() {
        for elongation in [1.0, 4.0] {
            let gaussian = rough(elongation);
            let tailed = gaussian.iter().map(|z| (0.8 * z).exp()).collect();
            let worn = gaussian.iter().map(|z| z.min(0.5)).collect();
            assert_eq!([gaussian, tailed, worn].map(patches), [None; 3], "{elongation}");
        }
    }

    /// Waves of one length in all directions correlate over many of it, positively and negatively, and so do their magnitudes.
    #[test]
    fn long_correlations_of_the_heights_are_no_patches() {
        const WAVES: usize = 48;
        let wave = |k: usize| {
            let direction = std::f64::consts::TAU * (k as f64 + 0.5) / WAVES as f64;
            let phase = std::f64::consts::TAU * (k as f64 * 0.754_877_666_246_692_7).fract();
            // Whole numbers of waves on the map, so that its border tells nothing.
            let [x, y] = [direction.cos(), direction.sin()].map(|part| (20.0 * part).round());
            move |i: usize, j: usize| {
                (std::f64::consts::TAU * (x * i as f64 + y * j as f64) / POINTS[0] as f64 + phase).cos()
            }
        };
        let waves: Vec<_> = (0..WAVES).map(wave).collect();
        let height = |k: usize| waves.iter().map(|wave| wave(k / POINTS[1], k % POINTS[1])).sum::<f64>();
        let heights: Vec<f64> = (0..POINTS[0] * POINTS[1]).map(height).collect();
        assert_eq!(patches(heights), None);
    }

    #[test]
    fn the_correlation_length_is_where_the_autocorrelation_is_a_fifth() {
        let along_x = vec![(0.0, 1.0), (1.0, 0.6), (2.0, 0.1), (3.0, 0.4)];
        let along_y = vec![(0.0, 1.0), (1.0, 0.9)];
        let found = CorrelationLengths::from_autocorrelation(&Autocorrelation {
            along_x,
            along_y,
            length: None,
            aspect: None,
        });
        assert!((found.lengths[0] - 1.8).abs() < 1e-15 && found.lengths[1] == f64::INFINITY);
        let patchy = CorrelationLengths { lengths: [2.0, 3.0], patches: Some([5.0, 1.0]) };
        assert_eq!(patchy.longest(), [5.0, 3.0]);
    }
}
