//! Areal Gaussian filters (ISO 16610-61): an S filter removes wavelengths shorter than its nesting index, an L filter
//! longer ones.

mod direct;
mod transform;

use std::fmt;

use super::{HeightMap, Rows, Watched};
use crate::memory::zeros;
use crate::numeric::parallel::for_each_row;

/// An S filter, an L filter, or both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Filter {
    s: Option<f64>,
    l: Option<f64>,
}

/// Invalid nesting indices.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum FilterError {
    /// At least one index is required.
    #[error("found no nesting index; allowed: s, l, or both")]
    Missing,
    /// The S index must be below the L index.
    #[error("found s = {s:.4e} m and l = {l:.4e} m; allowed: s below l")]
    Order { s: f64, l: f64 },
    /// An index must not exceed the map.
    #[error("found a nesting index of {index:.4e} m on a map of {:.4e} x {:.4e} m; allowed: at most its shorter side", size[0], size[1])]
    TooLarge { index: f64, size: [f64; 2] },
}

impl Filter {
    /// Filters with nesting indices in m, positive.
    ///
    /// # Errors
    /// No index at all, or an S index that is not below the L index.
    pub fn new(s: Option<f64>, l: Option<f64>) -> Result<Self, FilterError> {
        match (s, l) {
            (None, None) => Err(FilterError::Missing),
            (Some(s), Some(l)) if s >= l => Err(FilterError::Order { s, l }),
            _ => Ok(Self { s, l }),
        }
    }

    /// The S nesting index, m.
    pub fn s(&self) -> Option<f64> {
        self.s
    }

    /// The L nesting index, m.
    pub fn l(&self) -> Option<f64> {
        self.l
    }

    /// Checks the filter for a map of `points` at a distance of `pixel` (m).
    ///
    /// # Errors
    /// An index larger than the map.
    pub fn check(&self, points: [usize; 2], pixel: [f64; 2]) -> Result<(), FilterError> {
        let size = [0, 1].map(|axis| points[axis] as f64 * pixel[axis]);
        let too_large = |&index: &f64| index > size[0].min(size[1]);
        match [self.s, self.l].into_iter().flatten().find(too_large) {
            Some(index) => Err(FilterError::TooLarge { index, size }),
            None => Ok(()),
        }
    }

    /// Number of points along x on either side that a filtered height depends on, at a distance of `pixel` (m).
    pub fn halo(&self, pixel: [f64; 2]) -> usize {
        let reach = |index: f64| weights_of(index, pixel)[0].len() - 1;
        [self.s, self.l].into_iter().flatten().map(reach).sum()
    }

    /// Units of work of [`Self::apply`] on a map of pixels of `pixel` (m), for its progress.
    pub fn work(&self, pixel: [f64; 2]) -> f64 {
        /// Two transforms; a map with missing points takes four.
        const TRANSFORMS: f64 = 2.0;
        let of = |index: f64| if is_direct(&weights_of(index, pixel)) { 1.0 } else { TRANSFORMS };
        [self.s, self.l].into_iter().flatten().map(of).sum()
    }

    /// Bytes that [`Self::apply`] takes at its peak, the result included, on a map of `points` at a distance of `pixel` (m): 8 per
    /// point for a short index, and for a transform the map and its present points besides, both padded.
    pub fn memory(&self, points: [usize; 2], pixel: [f64; 2]) -> u128 {
        const BYTES: u128 = size_of::<f64>() as u128;
        let area = |points: [usize; 2]| BYTES * points[0] as u128 * points[1] as u128;
        let of = |index: f64| {
            let weights = weights_of(index, pixel);
            let padded = [0, 1].map(|axis| points[axis].saturating_add(weights[axis].len()));
            area(points) + if is_direct(&weights) { 0 } else { 2 * area(padded) }
        };
        let short = self.s.map_or(0, of);
        // The S filter's result stays while the L filter runs.
        let long = self.l.map_or(0, |l| of(l) + if self.s.is_some() { area(points) } else { 0 });
        short.max(long)
    }

    /// The filtered map; missing points stay missing and are ignored. Bit-identical for any number of threads.
    ///
    /// # Errors
    /// An index larger than the map.
    pub fn apply(&self, map: &dyn Rows) -> Result<HeightMap, FilterError> {
        self.check(map.points(), map.pixel())?;
        let progress = map.progress();
        let short = self.s.map(|s| low_pass(map, s));
        let Some(l) = self.l else { return Ok(short.unwrap_or_else(|| HeightMap::from_rows(map))) };
        let map = short.as_ref().map_or(map, |short| short);
        let watched = Watched { map, progress };
        let mut rest = low_pass(&watched, l);
        for_each_row(&mut rest.heights, map.points()[1], &|ix, row| {
            let mut heights = vec![0.0; row.len()];
            map.read(ix, &mut heights);
            row.iter_mut().zip(heights).for_each(|(form, z)| *form = z - *form);
        });
        Ok(rest)
    }
}

impl fmt::Display for Filter {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        // Twelve digits are those of the spec: a change of units rounds the last ones.
        let rounded = |index: f64| format!("{:.11e}", index * 1e6).parse().unwrap_or(index * 1e6);
        let part = |name, index: Option<f64>| index.map(|index| format!("{name} = {} um", rounded(index)));
        let parts: Vec<String> = [part("S", self.s), part("L", self.l)].into_iter().flatten().collect();
        f.write_str(&parts.join(", "))
    }
}

/// Number of weights along x and y together up to which sums are direct: nesting indices up to about 70 pixels, where
/// transforms of maps of 4096 x 4096 and 8192 x 8192 points take as long.
const DIRECT: usize = 200;

/// The Gaussian mean of a map: weights exp(-pi (x/(alpha index))^2) along x and y (ISO 16610-61,
/// Eq. 1; a Gaussian separates), normalised by the weights of the present points.
fn low_pass(map: &dyn Rows, index: f64) -> HeightMap {
    let [nx, ny] = map.points();
    let weights = weights_of(index, map.pixel());
    let mut means = zeros(nx * ny);
    if is_direct(&weights) {
        direct::means(map, &weights, &mut means);
    } else {
        transform::means(map, &weights, &mut means);
    }
    HeightMap::like(map, means)
}

fn is_direct(weights: &[Vec<f64>; 2]) -> bool {
    weights[0].len() + weights[1].len() <= DIRECT
}

/// The weights of an index (m) along x and y.
fn weights_of(index: f64, pixel: [f64; 2]) -> [Vec<f64>; 2] {
    pixel.map(|pixel| weights(index / pixel))
}

/// Weights at 0, 1, 2, ... pixels, down to 1e-12 of the first. The index is in pixels.
fn weights(index: f64) -> Vec<f64> {
    /// alpha = (ln 2/pi)^.5: the amplitude transmission is 50 % at the cut-off wavelength.
    const ALPHA_SQUARED: f64 = std::f64::consts::LN_2 / std::f64::consts::PI;
    const NEGLIGIBLE: f64 = 1e-12;
    (0..)
        .map(|k| (-std::f64::consts::PI * f64::from(k).powi(2) / (ALPHA_SQUARED * index * index)).exp())
        .take_while(|&weight| weight > NEGLIGIBLE)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::Boundary;
    use crate::topography::roughness::RoughnessParameters;

    const POINTS: [usize; 2] = [120, 80];
    const PIXEL: [f64; 2] = [0.5, 0.8];

    fn map(height: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |k: usize| height((k / 80) as f64 * PIXEL[0], (k % 80) as f64 * PIXEL[1]);
        HeightMap::new(POINTS, PIXEL, (0..120 * 80).map(at).collect(), f64::EPSILON).unwrap()
    }

    fn centre(map: &HeightMap) -> f64 {
        map.heights()[60 * 80 + 40]
    }

    fn filtered(map: &HeightMap, s: Option<f64>, l: Option<f64>) -> HeightMap {
        Filter::new(s, l).unwrap().apply(map).unwrap()
    }

    #[test]
    fn a_short_filter_needs_its_result_only() {
        let per_point = |s: Option<f64>, l: Option<f64>| {
            let memory = Filter::new(s, l).unwrap().memory([4096; 2], [1.0; 2]);
            memory as f64 / 4096f64.powi(2)
        };
        assert_eq!(per_point(Some(16.0), None), 8.0);
        assert_eq!(per_point(Some(2.0), Some(60.0)), 16.0);
        // The transforms pad by 0.14 and 3.5 of the side.
        let long = per_point(None, Some(400.0));
        assert!(long > 28.0 && long < 33.0, "{long}");
        let whole = per_point(Some(2.0), Some(4096.0));
        assert!(whole > 80.0 && whole < 120.0, "{whole}");
    }

    /// exp(-pi (alpha index/length)^2) of a wave passes.
    #[test]
    fn waves_pass_as_the_standard_says() {
        for length in [6.0, 8.0, 16.0] {
            let turn = std::f64::consts::TAU / length;
            let along_x = map(|x, _| (turn * (x - 30.0)).cos());
            let along_y = map(|_, y| (turn * (y - 32.0)).cos());
            let passes = 0.5f64.powf((8.0 / length).powi(2));
            for wave in [along_x, along_y] {
                assert!((centre(&filtered(&wave, Some(8.0), None)) - passes).abs() < 1e-6, "{length}");
                assert!((centre(&filtered(&wave, None, Some(8.0))) - (1.0 - passes)).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_flat_map_stays_flat_to_its_borders_and_around_holes() {
        let holed = map(|x, y| if (x - 30.0).abs() + (y - 20.0).abs() < 5.0 { f64::NAN } else { 7.0 });
        let flat = filtered(&holed, Some(8.0), None);
        assert_eq!(RoughnessParameters::new(&flat).missing, RoughnessParameters::new(&holed).missing);
        assert!(flat.heights().iter().all(|z| z.is_nan() || (z - 7.0).abs() < 1e-13));
        let nothing = filtered(&holed, Some(2.0), Some(8.0));
        assert!(nothing.heights().iter().all(|z| z.is_nan() || z.abs() < 1e-13));
    }

    #[test]
    fn indices_that_make_no_filter_are_refused() {
        assert_eq!(Filter::new(None, None), Err(FilterError::Missing));
        assert!(matches!(Filter::new(Some(2.0), Some(2.0)), Err(FilterError::Order { .. })));
        let small = map(|x, _| x);
        assert!(matches!(
            Filter::new(Some(61.0), None).unwrap().apply(&small),
            Err(FilterError::TooLarge { .. })
        ));
    }

    /// Both ways of summing, also where weights reach beyond the map or the strips and tiles end within it.
    #[test]
    fn direct_sums_are_those_of_transforms() {
        for (points, index) in [([70, 45], [3.0, 4.4]), ([90, 33], [40.0, 21.0]), ([5, 7], [6.0, 9.0])] {
            for hole in [usize::MAX, 29] {
                let height = |k: usize| if k % hole == 3 { f64::NAN } else { ((k * k) % 97) as f64 - 40.0 };
                let heights = (0..points[0] * points[1]).map(height).collect();
                let open = HeightMap::new(points, PIXEL, heights, 0.0).unwrap();
                for map in [open.clone(), open.periodic()] {
                    let weights = index.map(weights);
                    let mut found = [vec![0.0; map.heights.len()], vec![0.0; map.heights.len()]];
                    direct::means(&map, &weights, &mut found[0]);
                    transform::means(&map, &weights, &mut found[1]);
                    for (k, z) in map.heights.iter().enumerate() {
                        let [direct, transform] = [found[0][k], found[1][k]];
                        assert_eq!([direct.is_nan(), transform.is_nan()], [z.is_nan(); 2]);
                        assert!(z.is_nan() || (direct - transform).abs() < 1e-12 * 57.0, "{points:?} {k}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_same_on_any_number_of_threads_and_from_rows_that_are_not_in_memory() {
        let holed = map(|x, y| if x == 30.0 { f64::NAN } else { 1e-3 * x + (x * y).sin() });
        let filter = Filter::new(Some(2.0), Some(20.0)).unwrap();
        let form = crate::topography::Level::Plane.form(&holed).unwrap();
        let levelled = crate::topography::Levelled { map: &holed, form };
        let bits = |map: HeightMap| map.heights.into_iter().map(f64::to_bits).collect::<Vec<u64>>();
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| bits(filter.apply(&levelled).unwrap()))
        };
        let one = on(1);
        assert_eq!(one, on(3));
        assert_eq!(one, bits(filter.apply(&HeightMap::from_rows(&levelled)).unwrap()));
    }

    /// The definition, point by point.
    #[test]
    fn the_same_as_by_the_definition() {
        let (points, pixel, index) = ([40, 37], [1e-6, 1.5e-6], 7e-6);
        let height = |k: usize| if k % 29 == 3 { f64::NAN } else { ((k * k) % 97) as f64 * 1e-9 };
        let open = HeightMap::new(points, pixel, (0..40 * 37).map(height).collect(), 0.0).unwrap();
        for map in [open.clone(), open.periodic()] {
            let found = low_pass(&map, index);
            let half = map.points().map(|count| count as isize);
            for k in (0..40 * 37).step_by(13).filter(|k| !height(*k).is_nan()) {
                let (mut sum, mut total) = (0.0, 0.0);
                for other in (0..40 * 37).filter(|other| !height(*other).is_nan()) {
                    let steps = [other / 37, other % 37].into_iter().zip([k / 37, k % 37]);
                    let distance: Vec<isize> = steps.map(|(a, b)| a as isize - b as isize).collect();
                    // Two images each way: the weights end within them.
                    let reach = if map.boundary() == Boundary::Periodic { 2 } else { 0 };
                    for i in -reach..=reach {
                        for j in -reach..=reach {
                            let x = (distance[0] + i * half[0]) as f64 * pixel[0];
                            let y = (distance[1] + j * half[1]) as f64 * pixel[1];
                            let alpha2 = std::f64::consts::LN_2 / std::f64::consts::PI;
                            let weight =
                                (-std::f64::consts::PI * (x * x + y * y) / (alpha2 * index * index)).exp();
                            sum += weight * height(other);
                            total += weight;
                        }
                    }
                }
                assert!((found.heights()[k] / (sum / total) - 1.0).abs() < 1e-11, "{k}");
            }
        }
    }
}
