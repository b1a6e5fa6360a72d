//! Radial power spectrum and autocorrelation of a map.

use std::f64::consts::{PI, TAU};

use asperity_fft::Complex;

use super::fourier::{analyse, change_waves, columns, weight, with_small_factors};
use super::spectrum::GridSpectrum;
use super::{Boundary, HeightMap, Rows};
use crate::numeric::parallel::{self, for_each_row};
use crate::progress::Progress;

/// Radially averaged power spectral density C(q), normalised so that its integral over the plane of wave vectors is the
/// variance of the heights.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RadialSpectrum {
    /// Wave number (rad/m) and density (m^4) of each ring that contains waves.
    pub rings: Vec<(f64, f64)>,
}

/// Rings of equal width in the logarithm of the wave number, from the longest wave to two pixels.
struct Rings {
    points: [usize; 2],
    /// Wave numbers of the longest waves along x and y, rad/m.
    step: [f64; 2],
    first: f64,
    ratio: f64,
    count: usize,
}

impl Rings {
    fn new(points: [usize; 2], pixel: [f64; 2]) -> Self {
        const PER_DECADE: f64 = 20.0;
        let step = [0, 1].map(|axis| TAU / (points[axis] as f64 * pixel[axis]));
        let first = step[0].min(step[1]) * 0.999;
        let last = PI / pixel[0].max(pixel[1]);
        let count = ((last / first).log10() * PER_DECADE).ceil().max(1.0);
        Self { points, step, first, ratio: count / (last / first).ln(), count: count as usize }
    }

    /// Sums of wave numbers, of variances and of numbers of waves of column `j`, by ring. `variance` takes the index of
    /// the wave number along x.
    fn column(&self, j: usize, variance: impl Fn(usize) -> f64) -> Vec<[f64; 3]> {
        let mut sums = vec![[0.0; 3]; self.count];
        let y = self.step[1] * j as f64;
        let times = weight(self.points, j);
        for i in 0..self.points[0] {
            let x = self.step[0] * i.min(self.points[0] - i) as f64;
            let q = x.hypot(y);
            let place = ((q / self.first).ln() * self.ratio).floor();
            if (0.0..self.count as f64).contains(&place) {
                let ring = &mut sums[place as usize];
                ring[0] += times * q;
                ring[1] += times * variance(i);
                ring[2] += times;
            }
        }
        sums
    }

    fn spectrum(&self, columns: Vec<Vec<[f64; 3]>>) -> RadialSpectrum {
        let mut sums = vec![[0.0; 3]; self.count];
        for column in columns {
            for (sum, part) in sums.as_flattened_mut().iter_mut().zip(column.as_flattened()) {
                *sum += part;
            }
        }
        let cell = self.step[0] * self.step[1];
        let held = sums.into_iter().filter(|[_, _, waves]| *waves > 0.0);
        RadialSpectrum { rings: held.map(|[q, p, waves]| (q / waves, p / waves / cell)).collect() }
    }
}

impl RadialSpectrum {
    /// The spectrum of a map about its `mean` (m). A Hann window is applied to an open map; missing points are replaced
    /// by the mean. One unit of work.
    pub fn from_map(map: HeightMap, mean: f64, progress: &dyn Progress) -> Self {
        let points = map.points();
        let rings = Rings::new(points, map.pixel());
        let window = [0, 1].map(|axis| match map.boundary() {
            Boundary::Periodic => vec![1.0; points[axis]],
            // The Hann window, sampled at the centres of the pixels.
            Boundary::Open => (0..points[axis])
                .map(|k| (PI * (k as f64 + 0.5) / points[axis] as f64).sin().powi(2))
                .collect(),
        });
        let mut heights = map.into_heights();
        for_each_row(&mut heights, points[1], &|ix, row| {
            let wx = window[0][ix];
            for (z, wy) in row.iter_mut().zip(&window[1]) {
                *z = if z.is_nan() { 0.0 } else { (*z - mean) * wx * wy };
            }
        });
        let count = (points[0] * points[1]) as f64;
        let power = window.map(|w| w.iter().map(|w| w * w).sum::<f64>() / w.len() as f64);
        let unit = count * count * power[0] * power[1];
        let ring = |j: usize, waves: &[Complex<f64>]| rings.column(j, |i| waves[i].norm_sqr() / unit);
        let columns = analyse(heights, points, ring, progress);
        rings.spectrum(columns)
    }

    /// The prescribed spectrum of a Gaussian surface of standard deviation `sigma` (m); to `progress` it shows that it goes on.
    pub fn prescribed(spectrum: &GridSpectrum, pixel: [f64; 2], sigma: f64, progress: &dyn Progress) -> Self {
        let points = spectrum.points();
        let rings = Rings::new(points, pixel);
        let columns = parallel::map(columns(points), |j| {
            let mut deviations = vec![0.0; points[0]];
            spectrum.column(j, &mut deviations);
            let total = deviations.iter().map(|d| d * d).sum::<f64>() * weight(points, j);
            progress.advance(0.0);
            (rings.column(j, |i| deviations[i] * deviations[i]), total)
        });
        let total = spectrum.mean_variance() + columns.iter().map(|column| column.1).sum::<f64>();
        let mut prescribed = rings.spectrum(columns.into_iter().map(|column| column.0).collect());
        for ring in &mut prescribed.rings {
            ring.1 *= sigma * sigma / total;
        }
        prescribed
    }

    /// Quartiles of the ratio of another spectrum to this one, over the rings whose density is at least a thousandth of
    /// the largest.
    pub fn quartiles_of(&self, other: &Self) -> [f64; 2] {
        const NEGLIGIBLE: f64 = 1e-3;
        let largest = self.rings.iter().fold(0.0f64, |a, ring| a.max(ring.1));
        let pairs = self.rings.iter().zip(&other.rings).filter(|(own, _)| own.1 > NEGLIGIBLE * largest);
        let mut ratios: Vec<f64> = pairs.map(|(own, other)| other.1 / own.1).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        [1, 3].map(|quarter| ratios.get(quarter * ratios.len() / 4).copied().unwrap_or(f64::NAN))
    }
}

/// The autocorrelation of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Autocorrelation {
    /// Lag (m) and autocorrelation along x, up to half of the map.
    pub along_x: Vec<(f64, f64)>,
    /// Lag (m) and autocorrelation along y.
    pub along_y: Vec<(f64, f64)>,
    /// Autocorrelation length Sal (ISO 25178-2, s = 0.2): the shortest distance at which the autocorrelation has
    /// decayed to 0.2, m; `None` if it does not within half of the map.
    pub length: Option<f64>,
    /// Texture aspect ratio Str: the shortest such distance over the longest; `None` if it does not decay to 0.2 in
    /// some direction.
    pub aspect: Option<f64>,
}

impl Autocorrelation {
    /// Str; of a map on which the autocorrelation does not decay along an axis, as on grooves along it, the largest value that Str can
    /// have: Sal over half of the side along that axis. `None` where it decays in no direction.
    pub fn largest_aspect(&self) -> Option<f64> {
        let undecayed = |points: &[(f64, f64)]| {
            let decays = points.iter().any(|point| point.1 <= DECAYED);
            points.last().filter(|_| !decays).map(|last| last.0)
        };
        let longest = [&self.along_x, &self.along_y].into_iter().filter_map(|points| undecayed(points));
        let longest = longest.reduce(f64::max);
        self.aspect.or_else(|| Some(self.length? / longest?))
    }

    /// The autocorrelation of the present points, about their `mean` (m). On an open map only pairs of points within
    /// the map are included. `None` for a flat map. Two units of work, four on a map with missing points.
    pub fn from_map(map: &HeightMap, mean: f64, progress: &dyn Progress) -> Option<Self> {
        let points = map.points();
        let boundary = map.boundary();
        let padded = points.map(|count| padded(count, boundary));
        let products = pairs(map.embedded(padded, |z| z - mean), padded, progress);
        let has_holes = map.heights().iter().any(|z| z.is_nan());
        let counts = has_holes.then(|| pairs(map.embedded(padded, |_| 1.0), padded, progress));
        // Pairs along an axis at a lag that does not wrap around.
        let pairs_along = |axis: usize, place: usize| match boundary {
            Boundary::Periodic => points[axis],
            Boundary::Open => points[axis].saturating_sub(place.min(padded[axis] - place)),
        };
        let at = |i: usize, j: usize| {
            let place = i * padded[1] + j;
            let count = match &counts {
                Some(counts) => counts[place].round(),
                None => (pairs_along(0, i) * pairs_along(1, j)) as f64,
            };
            products[place] / count.max(1.0)
        };
        let variance = at(0, 0);
        if variance.is_nan() || variance <= 0.0 {
            return None;
        }
        let pixel = map.pixel();
        let half = points.map(|count| count / 2);
        let rho = |i: isize, j: isize| {
            at(i.rem_euclid(padded[0] as isize) as usize, j.rem_euclid(padded[1] as isize) as usize)
                / variance
        };
        let decays = decay(&rho, half, pixel);
        let shortest = decays.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let longest = decays.iter().copied().collect::<Option<Vec<f64>>>();
        let longest = longest.map(|all| all.into_iter().fold(0.0, f64::max));
        Some(Self {
            along_x: (0..=half[0]).map(|i| (i as f64 * pixel[0], rho(i as isize, 0))).collect(),
            along_y: (0..=half[1]).map(|j| (j as f64 * pixel[1], rho(0, j as isize))).collect(),
            length: shortest.is_finite().then_some(shortest),
            aspect: longest.map(|longest| shortest / longest),
        })
    }
}

/// Points of a transform of `count` points, of which lags up to half do not wrap around.
fn padded(count: usize, boundary: Boundary) -> usize {
    match boundary {
        Boundary::Periodic => count,
        Boundary::Open => with_small_factors(count + count / 2 + 1),
    }
}

/// The autocorrelation of a function `of` the heights along x and along y alone, at lags (m) up to half of the map, over the present
/// points: two units of work. `None` where the function is constant.
pub(super) fn along_axes(
    map: &HeightMap,
    of: &(dyn Fn(f64) -> f64 + Sync),
    progress: &dyn Progress,
) -> Option<[Vec<(f64, f64)>; 2]> {
    let has_holes = map.heights().iter().any(|z| z.is_nan());
    let along = |axis: usize| {
        let count = map.points()[axis];
        let part = if has_holes { 0.5 } else { 1.0 };
        let products = pairs_along(map, axis, of, part, progress);
        let counts = has_holes.then(|| pairs_along(map, axis, &|_| 1.0, part, progress));
        let lines = map.points()[1 - axis];
        let mean = |lag: usize| {
            let wraps = map.boundary() == Boundary::Periodic;
            let all = (lines * if wraps { count } else { count - lag }) as f64;
            products[lag] / counts.as_ref().map_or(all, |counts| counts[lag].round()).max(1.0)
        };
        let variance = mean(0);
        let is_known = variance > 0.0;
        let at = |lag: usize| (lag as f64 * map.pixel()[axis], mean(lag) / variance);
        is_known.then(|| (0..=count / 2).map(at).collect())
    };
    Some([along(0)?, along(1)?])
}

/// Sums over all pairs of points on lines along an axis of the products of a function of their heights, by lag; `part` of a unit of work.
fn pairs_along(
    map: &HeightMap,
    axis: usize,
    of: &(dyn Fn(f64) -> f64 + Sync),
    part: f64,
    progress: &dyn Progress,
) -> Vec<f64> {
    /// Lines transformed together: columns are read in whole cache lines.
    const LINES: usize = 64;
    let [nx, ny] = map.points();
    let (count, lines) = if axis == 0 { (nx, ny) } else { (ny, nx) };
    let length = padded(count, map.boundary());
    let transform = asperity_fft::real_to_complex(length);
    let power_of = |task: usize| {
        let some = task * LINES..lines.min((task + 1) * LINES);
        let mut values = vec![0.0; some.len() * count];
        let value = |z: f64| if z.is_nan() { 0.0 } else { of(z) };
        if axis == 0 {
            for (i, row) in map.heights().chunks(ny).enumerate() {
                for (k, &z) in row[some.clone()].iter().enumerate() {
                    values[k * nx + i] = value(z);
                }
            }
        } else {
            let rows = &map.heights()[some.start * ny..some.end * ny];
            values.iter_mut().zip(rows).for_each(|(of, &z)| *of = value(z));
        }
        let mut power = vec![0.0; length / 2 + 1];
        let (mut line, mut waves) = (transform.make_input_vec(), transform.make_output_vec());
        let mut scratch = transform.make_scratch_vec();
        for values in values.chunks(count) {
            line[..count].copy_from_slice(values);
            line[count..].fill(0.0);
            // Cannot fail: the lengths are those of the plan.
            let _ = transform.process_with_scratch(&mut line, &mut waves, &mut scratch);
            power.iter_mut().zip(&waves).for_each(|(sum, wave)| *sum += wave.norm_sqr());
        }
        progress.advance(part * some.len() as f64 / lines as f64);
        power
    };
    let mut power = vec![0.0; length / 2 + 1];
    for some in parallel::map(lines.div_ceil(LINES), power_of) {
        power.iter_mut().zip(some).for_each(|(sum, part)| *sum += part);
    }
    let mut waves: Vec<Complex<f64>> = power.into_iter().map(|power| Complex::new(power, 0.0)).collect();
    let back = asperity_fft::complex_to_real(length);
    let mut products = back.make_output_vec();
    let _ = back.process(&mut waves, &mut products);
    products.iter_mut().for_each(|product| *product /= length as f64);
    products
}

/// The autocorrelation has decayed at this value (ISO 25178-2).
const DECAYED: f64 = 0.2;

/// Sums over all pairs of points of the products of their values, by lag around the border.
pub(super) fn pairs(mut field: Vec<f64>, points: [usize; 2], progress: &dyn Progress) -> Vec<f64> {
    let scale = ((points[0] * points[1]) as f64).recip();
    let power = |_: usize, waves: &mut [Complex<f64>]| {
        waves.iter_mut().for_each(|wave| *wave = Complex::new(wave.norm_sqr(), 0.0));
    };
    change_waves(&mut field, points, scale, &power, progress);
    field
}

/// The distance (m) at which the autocorrelation first decays to 0.2, in each of 180 directions over the half plane.
fn decay(rho: &impl Fn(isize, isize) -> f64, half: [usize; 2], pixel: [f64; 2]) -> Vec<Option<f64>> {
    const DIRECTIONS: u32 = 180;
    let stride = 0.5 * pixel[0].min(pixel[1]);
    let along = |direction: u32| {
        let (sin, cos) = (PI * f64::from(direction) / f64::from(DIRECTIONS)).sin_cos();
        let value = |r: f64| {
            let place = [r * cos / pixel[0], r * sin / pixel[1]];
            let inside = place.iter().zip(half).all(|(p, half)| p.abs() + 1.0 < half as f64);
            inside.then(|| bilinear(rho, place))
        };
        let mut before = 1.0;
        for step in 1.. {
            let now = value(stride * f64::from(step))?;
            if now <= DECAYED {
                let part = (before - DECAYED) / (before - now);
                return Some(stride * (f64::from(step) - 1.0 + part));
            }
            before = now;
        }
        None
    };
    (0..DIRECTIONS).map(along).collect()
}

fn bilinear(rho: &impl Fn(isize, isize) -> f64, place: [f64; 2]) -> f64 {
    let corner = place.map(|p| p.floor() as isize);
    let [u, v] = [place[0] - corner[0] as f64, place[1] - corner[1] as f64];
    let at = |i, j| rho(corner[0] + i, corner[1] + j);
    (1.0 - u) * ((1.0 - v) * at(0, 0) + v * at(0, 1)) + u * ((1.0 - v) * at(1, 0) + v * at(1, 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Silent;
    use crate::topography::Moments;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};

    const POINTS: [usize; 2] = [256, 200];
    const PIXEL: [f64; 2] = [0.5, 0.8];

    fn surface(shape: SpectrumShape, lay: Lay, seed: u8) -> (HeightMap, GridSpectrum) {
        let spectrum = Spectrum::new(shape, lay).unwrap().on_grid(POINTS, PIXEL);
        let heights = gaussian(&spectrum, 3.0, [seed; 32]);
        (HeightMap::new(POINTS, PIXEL, heights, 0.0).unwrap().periodic(), spectrum)
    }

    #[test]
    fn the_spectrum_adds_up_to_the_variance_and_is_the_one_asked_for() {
        let (hurst, roll_off, cut_off) = (0.7, 20.0, 2.0);
        let shape = SpectrumShape::SelfAffine { hurst, roll_off, cut_off };
        let (_, grid) = surface(shape, Lay::default(), 1);
        let asked = RadialSpectrum::prescribed(&grid, PIXEL, 3.0, &Silent);
        let mut reached = vec![0.0; asked.rings.len()];
        for seed in 0..20 {
            let map = surface(shape, Lay::default(), seed).0;
            for (sum, ring) in reached.iter_mut().zip(RadialSpectrum::from_map(map, 0.0, &Silent).rings) {
                *sum += ring.1 / 20.0;
            }
        }
        let plateau: Vec<f64> = asked.rings.iter().map(|ring| ring.1).filter(|&c| c > 0.0).collect();
        assert!((plateau[0] / plateau[3] - 1.0).abs() < 1e-12, "constant up to the roll-off");
        for ((q, asked), reached) in asked.rings.iter().zip(&reached) {
            // A ring of few waves scatters: 4 sigma of 20 maps with at least 2 independent waves each.
            let waves = (q / (TAU / 128.0)).max(1.0) * 20.0;
            assert!((reached - asked).abs() <= 4.0 * asked / waves.sqrt() + 1e-25, "{q}: {asked} {reached}");
        }
        // The integral of the density over the plane of wave vectors, with the level C0 up to the roll-off.
        let q: f64 = TAU / roll_off;
        let falling = (1.0 - (roll_off / cut_off).powf(-2.0 * hurst)) / hurst;
        let level = 9.0 / (PI * q * q * (1.0 + falling));
        assert!((plateau[0] / level - 1.0).abs() < 0.01, "{} {level}", plateau[0]);
    }

    #[test]
    fn lay_and_length_are_found() {
        let lay = Lay { elongation: 4.0, angle: 0.5 };
        let mut found = [0.0; 2];
        for seed in 0..20 {
            let map = surface(SpectrumShape::Gaussian(3.0), lay, seed).0;
            let of = Autocorrelation::from_map(&map, 0.0, &Silent).unwrap();
            found[0] += of.length.unwrap() / 20.0;
            found[1] += of.aspect.unwrap() / 20.0;
        }
        let exact = 3.0 * 5f64.ln().sqrt();
        assert!((found[0] / exact - 1.0).abs() < 0.03, "{} {exact}", found[0]);
        assert!((found[1] / 0.25 - 1.0).abs() < 0.1, "{}", found[1]);
    }

    /// Grooves along y hold their heights over the whole side: Str is at most Sal over half of it.
    #[test]
    fn grooves_along_an_axis_bound_the_aspect_ratio() {
        let roughness = surface(SpectrumShape::Gaussian(1.0), Lay::default(), 1).0.into_heights();
        let groove = |k: usize| 20.0 * (TAU * (k / POINTS[1]) as f64 / 16.0).sin();
        let heights = roughness.iter().enumerate().map(|(k, z)| z + groove(k)).collect();
        let map = HeightMap::new(POINTS, PIXEL, heights, 0.0).unwrap();
        let found = Autocorrelation::from_map(&map, Moments::from_rows(&map).mean, &Silent).unwrap();
        assert_eq!(found.aspect, None);
        let bound = found.largest_aspect().unwrap();
        assert!((bound / (found.length.unwrap() / 80.0) - 1.0).abs() < 1e-12 && bound < 0.1, "{bound}");
        let isotropic = surface(SpectrumShape::Gaussian(3.0), Lay::default(), 1).0;
        let isotropic = Autocorrelation::from_map(&isotropic, 0.0, &Silent).unwrap();
        assert_eq!(isotropic.largest_aspect(), isotropic.aspect);
    }

    /// On an open map with holes pairs are counted one by one.
    #[test]
    fn pairs_of_an_open_map_with_missing_points() {
        let (map, _) = surface(SpectrumShape::Exponential(3.0), Lay::default(), 3);
        let mut heights = map.into_heights();
        heights.iter_mut().step_by(17).for_each(|z| *z = f64::NAN);
        let map = HeightMap::new(POINTS, PIXEL, heights, 0.0).unwrap();
        let mean = Moments::from_rows(&map).mean;
        let z = |i: usize, j: usize| map.heights()[i * POINTS[1] + j] - mean;
        let covariance = |lag: usize| {
            let (mut sum, mut count) = (0.0, 0.0);
            for i in 0..POINTS[0] - lag {
                for j in 0..POINTS[1] {
                    let product = z(i, j) * z(i + lag, j);
                    if !product.is_nan() {
                        sum += product;
                        count += 1.0;
                    }
                }
            }
            sum / count
        };
        let found = Autocorrelation::from_map(&map, mean, &Silent).unwrap();
        for lag in [1, 5, 40, 128] {
            let exact = covariance(lag) / covariance(0);
            assert!((found.along_x[lag].1 - exact).abs() < 1e-12, "{lag}");
        }
    }

    /// sigma^2 over all wave vectors that the grid has.
    #[test]
    fn white_noise_has_its_density_within_open_borders_too() {
        let mut found = [0.0; 2];
        for seed in 0..8 {
            let map = surface(SpectrumShape::Gaussian(0.05), Lay::default(), seed).0;
            let open = HeightMap::new(POINTS, PIXEL, map.heights().to_vec(), 0.0).unwrap();
            for (found, map) in found.iter_mut().zip([map, open]) {
                let mean = Moments::from_rows(&map).mean;
                let rings = RadialSpectrum::from_map(map, mean, &Silent).rings;
                *found += rings[rings.len() - 10..].iter().map(|ring| ring.1 / 80.0).sum::<f64>();
            }
        }
        let exact = 9.0 * PIXEL[0] * PIXEL[1] / TAU.powi(2);
        // Four standard errors of the open maps.
        assert!(found.iter().all(|found| (found / exact - 1.0).abs() < 0.03), "{found:?} for {exact}");
    }

    /// C(q) = sigma^2 l^2/(4 pi) exp(-(q l/2)^2); the longest wave is alone in its ring.
    #[test]
    fn the_spectrum_asked_for_is_that_of_an_endless_surface() {
        let spectrum = Spectrum::new(SpectrumShape::Gaussian(10.0), Lay::default()).unwrap();
        let (q, density) =
            RadialSpectrum::prescribed(&spectrum.on_grid(POINTS, PIXEL), PIXEL, 3.0, &Silent).rings[0];
        assert!((q / (TAU / 160.0) - 1.0).abs() < 1e-12);
        let exact = 9.0 * 100.0 / (4.0 * PI) * (-(5.0 * q).powi(2)).exp();
        assert!((density / exact - 1.0).abs() < 1e-6, "{density} for {exact}");
    }

    #[test]
    fn quartiles_are_those_of_found_over_asked() {
        let of = |density: &dyn Fn(usize) -> f64| RadialSpectrum {
            rings: (0..8).map(|k| (1.0 + k as f64, density(k))).collect(),
        };
        assert_eq!(of(&|_| 2.0).quartiles_of(&of(&|k| 2.0 * k as f64)), [2.0, 6.0]);
        let negligible = of(&|k| if k < 4 { 1.0 } else { 1e-4 });
        assert_eq!(negligible.quartiles_of(&of(&|k| if k < 4 { 3.0 } else { 9.0 })), [3.0, 3.0]);
    }

    /// Against the autocorrelation in all directions.
    #[test]
    fn along_the_axes_alone_it_is_the_same() {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 16.0, cut_off: 3.0 };
        let periodic = surface(shape, Lay::default(), 7).0;
        let open = HeightMap::new(POINTS, PIXEL, periodic.heights().to_vec(), 0.0).unwrap();
        let holed = |k: usize, z: f64| if k % 41 == 7 || k > 40_000 { f64::NAN } else { z };
        let heights = open.heights().iter().enumerate().map(|(k, &z)| holed(k, z)).collect();
        for map in [&periodic, &open, &HeightMap::new(POINTS, PIXEL, heights, 0.0).unwrap()] {
            let wanted = Autocorrelation::from_map(map, 0.1, &Silent).unwrap();
            let found = along_axes(map, &|z| z - 0.1, &Silent).unwrap();
            for (found, wanted) in found.iter().zip([&wanted.along_x, &wanted.along_y]) {
                assert_eq!(found.len(), wanted.len());
                for (found, wanted) in found.iter().zip(wanted) {
                    let off = (found.1 - wanted.1).abs();
                    assert!(found.0 == wanted.0 && off < 1e-13, "{found:?} {wanted:?}");
                }
            }
        }
        let flat = HeightMap::new([8, 8], [1.0; 2], vec![1.0; 64], 0.0).unwrap();
        assert_eq!(along_axes(&flat, &|z| z - 1.0, &Silent), None);
    }
}
