//! A random process fitted to a map: surfaces of its own autocorrelation and height distribution, of its size and with its missing points.
//! How much the roughness of a map varies from place to place, whatever its heights are distributed like, tells where such a process fails.

use std::f64::consts::PI;

use statrs::distribution::{ContinuousCDF, Normal};

use super::super::correlation::pairs;
use super::super::fourier::with_small_factors;
use super::super::height_transform::Distortion;
use super::super::spectrum::GridSpectrum;
use super::super::{Boundary, CorrelationLengths, HeightMap, Moments, Rows};
use super::gaussian;
use super::own_heights::OwnHeights;
use crate::compare::Scatter;
use crate::numeric::extremes;
use crate::numeric::parallel::for_each_row;
use crate::progress::{Progress, Silent};

/// The smallest number of correlation lengths along each side of a map that a process is fitted to.
pub const FEWEST_LENGTHS: f64 = 8.0;

/// Why no process is fitted to a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unfitted {
    /// The side of the map is shorter than eight correlation lengths, so that its longest waves are not seen.
    TooShort,
    /// The amplitude of its roughness varies from place to place, which the process does not.
    Patchy,
    /// Its heights do not scatter.
    Flat,
    /// It is periodic: a generated surface, of which more can be generated.
    Periodic,
}

/// A stationary process, Gaussian but for a transform of its heights, with the autocorrelation and the height distribution of a map.
#[derive(Debug, Clone)]
pub struct FittedProcess {
    points: [usize; 2],
    pixel: [f64; 2],
    /// Indices of missing points.
    missing: Vec<usize>,
    /// Of the Gaussian field, on a torus of one and a half times the sides.
    spectrum: GridSpectrum,
    heights: OwnHeights,
    sigma: f64,
    /// Correlation lengths along the sides of the map.
    lengths: [f64; 2],
    own_scatter: f64,
}

impl FittedProcess {
    /// The process of a levelled, filtered map with its moments and correlation lengths.
    ///
    /// The autocorrelation is that of the tapered map over that of the taper (a cosine over a quarter of each side at its ends), so that the edges
    /// leave no trace in the shortest waves. It is kept up to lags of 0.2 of the sides and goes smoothly to zero at half of them (a
    /// flat-top lag window: Politis and Romano 1995, J. Time Series Analysis 16, 67).
    ///
    /// # Errors
    /// Why none is fitted.
    pub fn new(
        map: &HeightMap,
        moments: &Moments,
        correlation: &CorrelationLengths,
    ) -> Result<Self, Unfitted> {
        let (points, pixel) = (map.points(), map.pixel());
        if map.boundary() == Boundary::Periodic {
            return Err(Unfitted::Periodic);
        }
        let lengths = [0, 1].map(|axis| points[axis] as f64 * pixel[axis] / correlation.lengths[axis]);
        if lengths.iter().any(|lengths| *lengths < FEWEST_LENGTHS) {
            return Err(Unfitted::TooShort);
        }
        if correlation.patches.is_some() {
            return Err(Unfitted::Patchy);
        }
        let heights = OwnHeights::new(map, lengths[0] * lengths[1]).ok_or(Unfitted::Flat)?;
        let torus = points.map(|count| with_small_factors(count + count / 2));
        let mut of_heights = autocorrelation(map, moments.mean, torus);
        let inverse = Distortion::by(|g| heights.at(g)).inverse();
        for_each_row(&mut of_heights, torus[1], &|_, row| {
            row.iter_mut().for_each(|rho| *rho = inverse.of(*rho))
        });
        let missing = map.heights().iter().enumerate().filter(|(_, z)| z.is_nan()).map(|(k, _)| k).collect();
        let spectrum = GridSpectrum::from_autocorrelation(torus, of_heights);
        let own_scatter = roughness_scatter(map);
        Ok(Self { points, pixel, missing, spectrum, heights, sigma: moments.sq, lengths, own_scatter })
    }

    /// Points of its surfaces along x and y.
    pub fn points(&self) -> [usize; 2] {
        self.points
    }

    /// The [scatter of the roughness](roughness_scatter()) over the map.
    pub fn own_scatter(&self) -> f64 {
        self.own_scatter
    }

    /// By how much the scatter of samples exceeds that of generated surfaces: the map shows its longest waves only in part, the less the fewer
    /// correlation lengths it holds (`coverage`).
    pub fn widening(&self) -> f64 {
        /// Of the geometric mean of 1/lengths along both sides.
        const PER_LENGTH: f64 = 1.4;
        1.0 + PER_LENGTH / (self.lengths[0] * self.lengths[1]).sqrt()
    }

    /// A surface of the process, of the size of the map and with its missing points, not levelled.
    /// One unit of work.
    pub fn surface(&self, seed: [u8; 32], progress: &dyn Progress) -> HeightMap {
        let torus = self.spectrum.points();
        let field = gaussian::watched(&self.spectrum, 1.0, seed, progress);
        let [nx, ny] = self.points;
        let rows = field.chunks(torus[1]).take(nx);
        let mut heights: Vec<f64> = rows.flat_map(|row| &row[..ny]).copied().collect();
        for_each_row(&mut heights, ny, &|_, row| {
            row.iter_mut().for_each(|g| *g = self.sigma * self.heights.at(*g));
        });
        self.missing.iter().for_each(|&point| heights[point] = f64::NAN);
        HeightMap::of_checked(self.points, self.pixel, heights)
    }
}

/// The autocorrelation of an open map about its `mean` (m) on a torus, times the lag window.
fn autocorrelation(map: &HeightMap, mean: f64, torus: [usize; 2]) -> Vec<f64> {
    let points = map.points();
    let tapers = points.map(taper);
    let tapered = |of: &(dyn Fn(f64) -> f64 + Sync)| {
        let mut field = map.embedded(torus, of);
        for_each_row(&mut field[..points[0] * torus[1]], torus[1], &|ix, row| {
            row.iter_mut().zip(&tapers[1]).for_each(|(value, taper)| *value *= tapers[0][ix] * taper);
        });
        pairs(field, torus, &Silent)
    };
    let products = tapered(&|z| z - mean);
    let weights = tapered(&|_| 1.0);
    let variance = products[0] / weights[0];
    let mut correlation = products;
    for_each_row(&mut correlation, torus[1], &|i, row| {
        for (j, (value, weight)) in row.iter_mut().zip(&weights[i * torus[1]..]).enumerate() {
            let lag = |place: usize, axis: usize| {
                place.min(torus[axis] - place) as f64 / (0.5 * points[axis] as f64)
            };
            let window = lag_window(lag(i, 0).hypot(lag(j, 1)));
            *value = if window > 0.0 { window * *value / (weight * variance) } else { 0.0 };
        }
    });
    correlation
}

/// One over the middle half, a cosine from zero over a quarter at each end.
fn taper(count: usize) -> Vec<f64> {
    let at = |k: usize| {
        let from_end = (k.min(count - 1 - k) as f64 + 0.5) / (0.25 * count as f64);
        if from_end < 1.0 { 0.5 - 0.5 * (PI * from_end).cos() } else { 1.0 }
    };
    (0..count).map(at).collect()
}

/// One up to 0.4 of the largest lag, and with all derivatives zero at it.
fn lag_window(lag: f64) -> f64 {
    const FLAT: f64 = 0.4;
    if lag >= 1.0 {
        return 0.0;
    }
    if lag <= FLAT {
        return 1.0;
    }
    let u = (lag - FLAT) / (1.0 - FLAT);
    let bump = |x: f64| (-x.recip()).exp();
    bump(1.0 - u) / (bump(u) + bump(1.0 - u))
}

/// How much the mean square slope of the blocks of a map (four along each side) scatters: standard deviation over mean. Short waves are so many in
/// a block that it scatters little unless their amplitude varies. The slopes are those of the normal scores of the heights, because slopes of a
/// transformed Gaussian surface vary with the height. Not a number for a flat map.
pub fn roughness_scatter(map: &HeightMap) -> f64 {
    const ALONG: usize = 4;
    let ([nx, ny], pixel) = (map.points(), map.pixel());
    let Some(scores) = normal_scores(map) else { return f64::NAN };
    let mut sums = [(0.0, 0usize); ALONG * ALONG];
    for (ix, row) in scores.chunks(ny).enumerate() {
        let next = scores.get((ix + 1) * ny..(ix + 2) * ny);
        for (iy, g) in row.iter().enumerate() {
            let (sum, count) = &mut sums[ix * ALONG / nx * ALONG + iy * ALONG / ny];
            let along_x = next.map(|next| (next[iy] - g) / pixel[0]);
            let along_y = row.get(iy + 1).map(|after| (after - g) / pixel[1]);
            for slope in along_x.into_iter().chain(along_y).filter(|slope| !slope.is_nan()) {
                *sum += slope * slope;
                *count += 1;
            }
        }
    }
    let blocks: Vec<f64> =
        sums.iter().filter(|(_, count)| *count > 0).map(|(sum, count)| sum / *count as f64).collect();
    let Scatter { mean, deviation } = Scatter::new(&blocks);
    deviation / mean
}

/// The standard normal quantile at the share of heights below each height, linear between equal steps of height; `None` of a flat map. Missing
/// points stay so.
fn normal_scores(map: &HeightMap) -> Option<Vec<f64>> {
    const STEPS: usize = 4096;
    let heights = map.heights();
    let [lowest, highest] = extremes(heights.iter().copied().filter(|z| !z.is_nan()))?;
    let per_height = STEPS as f64 / (highest - lowest);
    if !per_height.is_finite() {
        return None;
    }
    let mut counts = [0u32; STEPS];
    for z in heights.iter().filter(|z| !z.is_nan()) {
        counts[(((z - lowest) * per_height) as usize).min(STEPS - 1)] += 1;
    }
    let present: u32 = counts.iter().sum();
    let normal = Normal::standard();
    let of_count = |below: u32| normal.inverse_cdf((f64::from(below) + 0.5) / (f64::from(present) + 1.0));
    let mut below = 0;
    let mut ends = vec![of_count(0)];
    ends.extend(counts.iter().map(|count| {
        below += count;
        of_count(below)
    }));
    let mut scores = heights.to_vec();
    for_each_row(&mut scores, map.points()[1], &|_, row| {
        for z in row.iter_mut().filter(|z| !z.is_nan()) {
            let place = (*z - lowest) * per_height;
            let step = (place as usize).min(STEPS - 1);
            *z = ends[step] + (place - step as f64) * (ends[step + 1] - ends[step]);
        }
    });
    Some(scores)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::{Heights, Johnson};
    use crate::topography::generate::{Process, Seeds, SpectrumOf, SurfaceGenerator};
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};
    use crate::topography::{Level, RoughnessParameters};

    /// A levelled window of half the side of a periodic self-affine map.
    fn window(roll_off: f64, heights: Heights, seed: u8) -> HeightMap {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off, cut_off: 4.0 };
        let spectrum = Spectrum::new(shape, Lay::default()).unwrap();
        let process = Process { spectrum, of: SpectrumOf::Gaussian, sigma: 0.1, heights };
        let generator = SurfaceGenerator { points: [384; 2], pixel: [1.0; 2], process, plateau: None };
        let (map, _) = generator.surface(Seeds { process: [seed; 32], plateau: [0; 32] }).unwrap();
        let rows = map.heights().chunks(384).take(192);
        let heights = rows.flat_map(|row| &row[..192]).copied().collect();
        Level::Plane.apply(&HeightMap::new([192; 2], [1.0; 2], heights, 0.0).unwrap()).unwrap()
    }

    fn fit(map: &HeightMap) -> Result<FittedProcess, Unfitted> {
        let roughness = RoughnessParameters::new(map);
        let (correlation, _) = CorrelationLengths::from_map(map, roughness.moments.mean, &Silent).unwrap();
        FittedProcess::new(map, &roughness.moments, &correlation)
    }

    /// Correlation lengths, mean squares of slope and curvature, skewness: in the mean over generated surfaces those of the map.
    #[test]
    fn generated_surfaces_are_like_the_map() {
        let worn = Heights::new(Johnson::from_moments(-1.0, 4.5).unwrap());
        for heights in [Heights::GAUSSIAN, worn] {
            let map = window(40.0, heights, 3);
            let process = fit(&map).unwrap();
            let facts = |map: &HeightMap| {
                let roughness = RoughnessParameters::new(map);
                let (correlation, _) =
                    CorrelationLengths::from_map(map, roughness.moments.mean, &Silent).unwrap();
                let [m0, m2, m4] = roughness.spectral_moments();
                [m0.sqrt(), m2.sqrt(), m4.sqrt(), correlation.lengths[0] + correlation.lengths[1]]
            };
            let own = facts(&map);
            let mut mean = [0.0; 4];
            let mut skewness = 0.0;
            for seed in 0..24 {
                let surface = Level::Plane.apply(&process.surface([seed; 32], &Silent)).unwrap();
                mean.iter_mut().zip(facts(&surface)).for_each(|(sum, value)| *sum += value / 24.0);
                skewness += RoughnessParameters::new(&surface).moments.ssk.unwrap() / 24.0;
            }
            for ((mean, own), tolerance) in mean.iter().zip(own).zip([0.1, 0.1, 0.1, 0.15]) {
                assert!((mean / own - 1.0).abs() < tolerance, "{mean} for {own}");
            }
            let of_map = RoughnessParameters::new(&map).moments.ssk.unwrap();
            assert!((skewness - of_map).abs() < 0.25, "{skewness} for {of_map}");
        }
    }

    #[test]
    fn a_surface_has_the_missing_points_and_follows_from_the_seed() {
        let map = window(40.0, Heights::GAUSSIAN, 3);
        let mut heights = map.into_heights();
        heights[700] = f64::NAN;
        let process = fit(&HeightMap::new([192; 2], [1.0; 2], heights, 0.0).unwrap()).unwrap();
        let surface = process.surface([1; 32], &Silent);
        assert!(surface.heights().iter().enumerate().all(|(k, z)| z.is_nan() == (k == 700)));
        let other = process.surface([1; 32], &Silent);
        assert!(surface.heights()[..700] == other.heights()[..700]);
    }

    #[test]
    fn no_process_is_fitted_where_the_longest_waves_are_not_seen() {
        assert_eq!(fit(&window(190.0, Heights::GAUSSIAN, 3)).err(), Some(Unfitted::TooShort));
        assert_eq!(fit(&window(40.0, Heights::GAUSSIAN, 3).periodic()).err(), Some(Unfitted::Periodic));
    }

    /// The roughness of a map whose amplitude swells and sinks (by 30 %, in stripes) scatters more than over generated surfaces, that of a stationary
    /// one does not, whatever the heights are distributed like.
    #[test]
    fn the_roughness_of_a_patchy_map_scatters_more() {
        for heights in [Heights::GAUSSIAN, Heights::EXPONENTIAL] {
            let map = window(40.0, heights.clone(), 3);
            let swelling = |(k, z): (usize, &f64)| z * (1.0 + 0.3 * (PI * (k / 192) as f64 / 48.0).sin());
            let patchy: Vec<f64> = map.heights().iter().enumerate().map(swelling).collect();
            let maps = [map, HeightMap::new([192; 2], [1.0; 2], patchy, 0.0).unwrap()];
            let [plain, patchy] = maps.map(|map| {
                let process = fit(&map).unwrap();
                let levelled = |seed| Level::Plane.apply(&process.surface([seed; 32], &Silent)).unwrap();
                let generated: Vec<f64> = (0..16).map(|seed| roughness_scatter(&levelled(seed))).collect();
                let Scatter { mean, deviation } = Scatter::new(&generated);
                (process.own_scatter() - mean) / deviation
            });
            assert!(plain < 2.0 && patchy > 4.0, "{heights}: {plain} {patchy}");
        }
    }

    fn map(heights: Vec<f64>) -> HeightMap {
        HeightMap::new([200; 2], [1.0; 2], heights, 0.0).unwrap()
    }

    /// Of quantiles of a distribution they are those of the normal one; missing points and levels do no harm.
    #[test]
    fn scores_are_normal_whatever_the_heights() {
        let normal = Normal::standard();
        let share = |k: usize| (k as f64 + 0.5) / 40_000.0;
        let exponential = |k: usize| if k == 7 { f64::NAN } else { -(1.0 - share(k)).ln() };
        let scores = normal_scores(&map((0..40_000).map(exponential).collect())).unwrap();
        assert!(scores[7].is_nan());
        for k in [400, 20_000, 39_000, 39_990] {
            assert!((scores[k] - normal.inverse_cdf(share(k))).abs() < 0.01, "{k}: {}", scores[k]);
        }
        let levels = normal_scores(&map((0..40_000).map(|k| f64::from(k % 3)).collect())).unwrap();
        assert!(levels.iter().all(|g| g.is_finite()));
        assert!(roughness_scatter(&map(vec![1.0; 40_000])).is_nan());
    }
}
