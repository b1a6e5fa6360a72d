//! Overview of a map: spectrum, autocorrelation, image.

use crate::topography::generate::{SpectrumOf, SurfaceGenerator};
use crate::topography::{
    Autocorrelation, RadialSpectrum, RoughnessParameters, Rows, Strip, strips, thumbnail,
};
use crate::{HeightMap, Heights};

/// Analysis depth of a map, beyond its asperities.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AnalysisDepth {
    /// Asperities only.
    Asperities,
    /// What a comparison needs: blocks for the sampling error and a small image; of a random surface, the target and the obtained
    /// spectrum.
    Comparison,
    /// Spectrum, autocorrelation and an image.
    Everything,
}

/// Beyond so many points a map is not brought into memory for its spectrum and autocorrelation.
pub const MOST_ANALYSED_POINTS: usize = 1 << 26;

/// Overview of a map.
#[derive(Debug, Clone, Default)]
pub struct MapOverview {
    /// The target spectrum.
    pub target: Option<RadialSpectrum>,
    /// Whether it is the target of the Gaussian field before the transform of its heights.
    pub is_target_of_gaussian: bool,
    /// The obtained spectrum.
    pub spectrum: Option<RadialSpectrum>,
    /// The autocorrelation.
    pub autocorrelation: Option<Autocorrelation>,
    /// The heights, at most 512 along each axis.
    pub picture: Option<HeightMap>,
    /// Number of heights in each of equal intervals over 5 Sq on both sides of the mean.
    pub distribution: Option<Vec<usize>>,
}

impl MapOverview {
    /// The heights for an image, at the size that `depth` asks for.
    pub(super) fn image(map: &dyn Rows, depth: AnalysisDepth) -> Option<HeightMap> {
        /// Points of an image along an axis, and of a small one.
        const PICTURE: usize = 512;
        const SMALL_PICTURE: usize = 96;
        let [nx, ny] = map.points();
        match depth {
            AnalysisDepth::Everything => Some(thumbnail(map, PICTURE)),
            // A map that is not in memory is not read once more for it.
            AnalysisDepth::Comparison if nx * ny <= MOST_ANALYSED_POINTS => {
                Some(thumbnail(map, SMALL_PICTURE))
            }
            _ => None,
        }
    }

    /// Analyses a map to the given `depth`; `generator` is set for a generated one.
    pub(super) fn new(
        map: &dyn Rows,
        roughness: &RoughnessParameters,
        generator: Option<&SurfaceGenerator>,
        depth: AnalysisDepth,
    ) -> Self {
        let [nx, ny] = map.points();
        let is_close = depth == AnalysisDepth::Everything;
        let progress = map.progress();
        if is_close {
            progress.stage("picture", 2.0);
        }
        let mut whole = Self {
            picture: Self::image(map, depth),
            distribution: is_close.then(|| distribution(map, roughness)),
            ..Self::default()
        };
        if depth == AnalysisDepth::Asperities
            || (!is_close && generator.is_none())
            || nx * ny > MOST_ANALYSED_POINTS
        {
            return whole;
        }
        // Two processes have two spectra: neither is that of what they leave.
        whole.target = generator.filter(|generator| generator.plateau.is_none()).map(|generator| {
            let &SurfaceGenerator { points, pixel, ref process, .. } = generator;
            RadialSpectrum::prescribed(
                &process.spectrum.on_grid(points, pixel),
                pixel,
                process.sigma,
                progress,
            )
        });
        whole.is_target_of_gaussian = generator.is_some_and(|SurfaceGenerator { process, .. }| {
            process.of == SpectrumOf::Gaussian && process.heights != Heights::GAUSSIAN
        });
        // One for the copy, one for the spectrum, two for the autocorrelation.
        progress.stage("spectrum and autocorrelation", if is_close { 4.0 } else { 2.0 });
        let (map, mean) = (HeightMap::from_rows(map), roughness.moments.mean);
        whole.autocorrelation = if is_close { Autocorrelation::from_map(&map, mean, progress) } else { None };
        whole.spectrum = Some(RadialSpectrum::from_map(map, mean, progress));
        whole
    }
}

/// Counts of heights in equal intervals over 5 Sq on both sides of the mean.
fn distribution(map: &dyn Rows, roughness: &RoughnessParameters) -> Vec<usize> {
    const INTERVALS: usize = 100;
    let (mean, sq) = (roughness.moments.mean, roughness.moments.sq);
    let count = |strip: Strip| {
        let mut counts = vec![0; INTERVALS];
        for z in (0..strip.count as isize).filter_map(|k| strip.row(k)).flatten() {
            let place = ((z - mean) / sq + 5.0) * 0.1 * INTERVALS as f64;
            if (0.0..INTERVALS as f64).contains(&place) {
                counts[place as usize] += 1;
            }
        }
        counts
    };
    let parts = strips(map, 0, count);
    (0..INTERVALS).map(|k| parts.iter().map(|part| part[k]).sum()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::Moments;

    fn map(points: [usize; 2], height: impl Fn(usize) -> f64) -> HeightMap {
        HeightMap::new(points, [1.0, 2.0], (0..points[0] * points[1]).map(height).collect(), 0.0).unwrap()
    }

    #[test]
    fn heights_are_counted_about_their_mean_over_ten_sq() {
        // A tenth of Sq is an interval, the first at -5.
        let map = map([4, 4], |k| [-1.05, 1.05, 0.05, f64::NAN][k % 4]);
        let moments = Moments { mean: 0.0, sa: 1.0, sq: 1.0, ssk: None, sku: None };
        let counts = distribution(&map, &RoughnessParameters { moments, ..RoughnessParameters::new(&map) });
        let held: Vec<(usize, usize)> =
            counts.iter().copied().enumerate().filter(|(_, count)| *count > 0).collect();
        assert_eq!((counts.len(), held), (100, vec![(39, 4), (50, 4), (60, 4)]));
    }
}
