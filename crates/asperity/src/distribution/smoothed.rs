//! The own heights of a set, smoothed by a Gaussian kernel.

use std::f64::consts::{PI, SQRT_2};
use std::fmt;
use std::ops::Range;
use std::sync::OnceLock;

use libm::erfc;
use statrs::distribution::ContinuousCDF;

use super::normal::normal_quantiles;
use super::{FOLDINGS, HeightDistribution};
use crate::literature::{Paper, SILVERMAN_1986};
use crate::numeric::condensed::{Node, condensed};
use crate::numeric::lanes::Real;
use crate::numeric::parallel;
use crate::numeric::sort::sort;
use crate::numeric::sum::{Terms, sum_of, sums_of_present};
use crate::progress::Silent;

/// Kernels per width of a kernel that stand for all heights.
const KERNELS: f64 = 10.0;

/// Steps of the tabulated ln(density) per width of a kernel.
const STEPS: f64 = 32.0;

/// Distance from a kernel, in its widths, at which it is negligible beside a nearer one.
const REACH: f64 = 9.0;

/// Distance of the ends of the table from the outermost kernels, in their widths.
const MARGIN: f64 = 12.0;

/// Widths of a kernel per panel in the root of the indentation.
const WIDTHS_PER_PANEL: f64 = 2.5;

/// Heights below this number of widths above the highest kernel touch nothing.
const HIGHEST: f64 = 38.0;

/// The heights of a set as a density: a Gaussian kernel at each, of Silverman's width 0.9 min(sd, IQR/1.34) n^-1/5 (Silverman
/// 1986, Eq. 3.31), drawn together so that mean and variance stay those of the heights (section 6.4.1).
#[derive(Clone)]
pub struct Smoothed {
    /// Centres with their shares, ascending; and both as columns.
    kernels: Vec<Node>,
    columns: [Vec<f64>; 2],
    /// Standard deviation of each.
    width: f64,
    count: usize,
    skewness: f64,
    kurtosis: f64,
    table: LogDensity,
    /// The share of the kernels before each, and of all.
    shares_below: Vec<f64>,
    /// Standard normal variables of ascending heights, once a height is asked for.
    normals: OnceLock<Vec<Normal>>,
}

/// A standard normal variable g and the height z of the same cumulative probability.
#[derive(Clone, Copy)]
struct Normal {
    g: f64,
    z: f64,
    /// dz/dg.
    slope: f64,
}

/// ln(density) and its slope at equal steps.
#[derive(Clone)]
struct LogDensity {
    start: f64,
    step: f64,
    values: Vec<[f64; 2]>,
    /// The largest value at each step or above it.
    highest: Vec<f64>,
}

/// Heights that are all equal have no smoothed density.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("heights that are all equal have no smoothed distribution")]
pub struct EqualHeights;

impl Smoothed {
    /// Of `heights`, in any unit and order.
    ///
    /// # Errors
    /// Heights that are all equal.
    pub fn new(heights: &[f64]) -> Result<Self, EqualHeights> {
        let mut sorted = heights.to_vec();
        sort(&mut sorted, &Silent);
        Self::of_ascending(&sorted)
    }

    /// Of heights in ascending order.
    ///
    /// # Errors
    /// Heights that are all equal.
    pub(crate) fn of_ascending(sorted: &[f64]) -> Result<Self, EqualHeights> {
        let count = sorted.len();
        let origin = sorted.first().copied().ok_or(EqualHeights)?;
        let mean = sum_of(count, |k| sorted[k] - origin) / count as f64;
        let variance = sum_of(count, |k| (sorted[k] - origin - mean).powi(2)) / count as f64;
        let sd = variance.sqrt();
        if sd == 0.0 {
            return Err(EqualHeights);
        }
        let standardised = |z: f64| (z - origin - mean) / sd;
        let quartile = |share: f64| standardised(sorted[((count - 1) as f64 * share).round() as usize]);
        let range = (quartile(0.75) - quartile(0.25)) / 1.34;
        // More than half of the heights may be equal.
        let spread = if range > 0.0 { range.min(1.0) } else { 1.0 };
        let bandwidth = 0.9 * spread * (count as f64).powf(-0.2);
        let shrink = (1.0 + bandwidth * bandwidth).sqrt().recip();
        let width = bandwidth * shrink;
        let mut kernels = condensed(sorted, bandwidth * sd / KERNELS);
        for one in &mut kernels {
            *one = Node { value: standardised(one.value) * shrink, weight: one.weight / count as f64 };
        }
        let moment = |power: i32| kernels.iter().map(|one| one.weight * one.value.powi(power)).sum::<f64>();
        let square = width * width;
        let kurtosis = moment(4) + 6.0 * square * moment(2) + 3.0 * square * square;
        let mut shares_below = vec![0.0];
        for one in &kernels {
            shares_below.push(shares_below[shares_below.len() - 1] + one.weight);
        }
        let mut smoothed = Self {
            skewness: moment(3) + 3.0 * square * moment(1),
            kurtosis,
            width,
            count,
            table: LogDensity { start: 0.0, step: 1.0, values: Vec::new(), highest: Vec::new() },
            shares_below,
            normals: OnceLock::new(),
            columns: [
                kernels.iter().map(|one| one.value).collect(),
                kernels.iter().map(|one| one.weight).collect(),
            ],
            kernels,
        };
        smoothed.table = LogDensity::new(&smoothed);
        Ok(smoothed)
    }

    fn ends(&self) -> [f64; 2] {
        [self.kernels[0].value, self.kernels[self.kernels.len() - 1].value]
    }

    /// ln(density) at `z` and its slope, from the kernels.
    fn by_kernels(&self, z: f64) -> [f64; 2] {
        let (nearest, near) = self.near(z);
        let columns = self.columns.each_ref().map(|column| &column[near.clone()]);
        let ([sum, slope], _) = sums_of_present(columns, Kernels { z, width: self.width, nearest });
        let unit = (2.0 * PI).sqrt() * self.width;
        [(sum / unit).ln() - 0.5 * nearest * nearest, -slope / (sum * self.width)]
    }

    fn log_density(&self, z: f64) -> f64 {
        self.table.at(z).unwrap_or_else(|| self.by_kernels(z)[0])
    }

    /// ln of the largest density at or above `h`.
    fn log_highest(&self, h: f64) -> f64 {
        let place = (h - self.table.start) / self.table.step;
        if place < 0.0 {
            return self.table.highest[0];
        }
        let own = self.log_density(h);
        self.table.highest.get(place as usize + 1).map_or(own, |highest| own.max(*highest))
    }

    /// The distance of the nearest kernel from `z`, in widths, and the kernels that are not negligible beside it.
    fn near(&self, z: f64) -> (f64, Range<usize>) {
        let above = self.kernels.partition_point(|one| one.value < z);
        let distance = |index: usize| ((z - self.kernels[index].value) / self.width).abs();
        let around = [above.checked_sub(1), Some(above).filter(|&k| k < self.kernels.len())];
        let nearest = around.into_iter().flatten().map(distance).fold(f64::INFINITY, f64::min);
        // exp(-(u^2 - nearest^2)/2) is negligible where u is beyond (nearest^2 + REACH^2)^.5.
        let reach = nearest.hypot(REACH) * self.width;
        let from = self.kernels.partition_point(|one| one.value < z - reach);
        (nearest, from..self.kernels.partition_point(|one| one.value <= z + reach))
    }

    /// The fractions of heights below and above `z`, each with its own digits.
    fn tails(&self, z: f64) -> [f64; 2] {
        let (_, near) = self.near(z);
        let tail = |sign: f64| -> f64 {
            let of = |one: &Node| one.weight * 0.5 * erfc(sign * (one.value - z) / (self.width * SQRT_2));
            self.kernels[near.clone()].iter().map(of).sum()
        };
        let last = self.kernels.len();
        let beyond = [self.shares_below[near.start], self.shares_below[last] - self.shares_below[near.end]];
        // Differences of sums of all shares leave rounding where there is none.
        let beyond_above = if near.end == last { 0.0 } else { beyond[1] };
        [beyond[0] + tail(1.0), beyond_above + tail(-1.0)]
    }

    /// At the steps of the density, as far as both tails are above the smallest numbers.
    fn tabulated_normals(&self) -> Vec<Normal> {
        let LogDensity { start, step, values, .. } = &self.table;
        // Not in parallel: the thread that makes the table would take up other tasks meanwhile, and could wait for itself in one.
        let all = (0..values.len()).map(|k| {
            let z = start + step * k as f64;
            let [below, above] = self.tails(z);
            let standard = statrs::distribution::Normal::standard();
            let g = if below < above { standard.inverse_cdf(below) } else { -standard.inverse_cdf(above) };
            let slope = (-0.5 * g * g - 0.5 * (2.0 * PI).ln() - values[k][0]).exp();
            Normal { g, z, slope }
        });
        let mut normals: Vec<Normal> = Vec::with_capacity(values.len());
        for one in all {
            let rises = normals.last().is_none_or(|last| one.g > last.g);
            if one.g.is_finite() && one.slope.is_finite() && rises {
                normals.push(one);
            }
        }
        normals
    }
}

/// Densities of kernels at `z` relative to that of the nearest, whose distance is in widths, and their slopes.
#[derive(Clone, Copy)]
struct Kernels {
    z: f64,
    width: f64,
    nearest: f64,
}

impl Terms<2, 2> for Kernels {
    #[inline(always)]
    fn of<N: Real>(self, [value, weight]: [N; 2]) -> [N; 2] {
        let u = -(value - self.z) / self.width;
        let part = weight * ((u - self.nearest) * (u + self.nearest) * -0.5).exp();
        [part, part * u]
    }
}

impl LogDensity {
    fn new(smoothed: &Smoothed) -> Self {
        let [low, high] = smoothed.ends();
        let step = smoothed.width / STEPS;
        let start = low - MARGIN * smoothed.width;
        let count = ((high - low + 2.0 * MARGIN * smoothed.width) / step).ceil() as usize + 1;
        let values = parallel::map(count, |k| smoothed.by_kernels(start + step * k as f64));
        let mut highest: Vec<f64> = values.iter().map(|[value, _]| *value).collect();
        for k in (0..count - 1).rev() {
            highest[k] = highest[k].max(highest[k + 1]);
        }
        Self { start, step, values, highest }
    }

    /// Cubic between the steps; `None` beyond the table.
    fn at(&self, z: f64) -> Option<f64> {
        let place = (z - self.start) / self.step;
        let cell = place as usize;
        if place < 0.0 || cell + 1 >= self.values.len() {
            return None;
        }
        Some(cubic(self.values[cell], self.values[cell + 1], self.step, place - cell as f64))
    }
}

/// Hermite's cubic over a `step`, at its fraction `t`, from values and slopes at both ends.
fn cubic([a, slope_a]: [f64; 2], [b, slope_b]: [f64; 2], step: f64, t: f64) -> f64 {
    let s = 1.0 - t;
    a * s * s * (1.0 + 2.0 * t) + b * t * t * (3.0 - 2.0 * t) + step * t * s * (slope_a * s - slope_b * t)
}

impl fmt::Debug for Smoothed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for Smoothed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, width, skewness, kurtosis, .. } = self;
        write!(
            f,
            "own smoothed heights ({count} kernels of width {width:.3}, skewness {skewness:.4}, kurtosis {kurtosis:.4})"
        )
    }
}

impl HeightDistribution for Smoothed {
    fn name(&self) -> &'static str {
        "own"
    }

    fn label(&self) -> &'static str {
        "own smoothed"
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("count", self.count as f64),
            ("width", self.width),
            ("skewness", self.skewness),
            ("kurtosis", self.kurtosis),
        ]
    }

    fn papers(&self) -> &'static [Paper] {
        &[SILVERMAN_1986]
    }

    fn skewness(&self) -> f64 {
        self.skewness
    }

    fn kurtosis(&self) -> f64 {
        self.kurtosis
    }

    fn support(&self) -> [f64; 2] {
        [f64::NEG_INFINITY, f64::INFINITY]
    }

    fn density(&self, z: f64) -> f64 {
        self.log_density(z).exp()
    }

    fn survival(&self, z: f64) -> f64 {
        self.tails(z)[1]
    }

    /// From a table, within 1e-7; beyond it along the tail of the outermost kernel.
    fn map_probabilities(&self, field: &mut [f64], scale: f64) {
        normal_quantiles(field);
        self.map_normals(field, scale);
    }

    fn height_at_normal(&self, g: f64) -> f64 {
        let normals = self.normals.get_or_init(|| self.tabulated_normals());
        let next = normals.partition_point(|one| one.g < g);
        let (Some(low), Some(high)) = (next.checked_sub(1).map(|k| normals[k]), normals.get(next)) else {
            let end = normals[next.saturating_sub(1).min(normals.len() - 1)];
            return end.z + end.slope * (g - end.g);
        };
        let step = high.g - low.g;
        cubic([low.z, low.slope], [high.z, high.slope], step, (g - low.g) / step)
    }

    fn decreasing_from(&self) -> f64 {
        let rises = self.table.values.windows(2).rposition(|pair| pair[1][0] > pair[0][0]);
        self.table.start + self.table.step * rises.map_or(0.0, |k| k as f64 + 2.0)
    }

    fn highest_separation(&self) -> f64 {
        self.ends()[1] + HIGHEST * self.width
    }

    fn scale(&self, h: f64) -> f64 {
        self.log_highest(h).exp()
    }

    fn window(&self, h: f64) -> [f64; 2] {
        let [low, high] = self.ends();
        let reach = (2.0 * FOLDINGS).sqrt();
        let start = (low - h - reach * self.width).max(0.0);
        // Above the highest kernel the density is its tail.
        let u = ((h - high) / self.width).max(0.0);
        let beyond = reach * reach / (u + u.hypot(reach));
        [start, (high - h).max(0.0) + beyond * self.width]
    }

    fn panels(&self, _h: f64, from: f64, to: f64) -> usize {
        ((to - from) / (WIDTHS_PER_PANEL * self.width)).ceil().max(1.0) as usize
    }

    fn variable_is_indentation(&self) -> bool {
        true
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        (self.log_density(h + x) - self.log_highest(h)).exp()
    }

    fn apply_density(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        let highest = self.log_highest(h);
        for (x, weight) in nodes.iter().zip(weights) {
            *weight *= (self.log_density(h + x) - highest).exp();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::Gaussian;

    /// Skewed heights with an outlier.
    fn smoothed(count: usize) -> Smoothed {
        let heights = (0..count).map(|k| {
            let g = Gaussian.quantile((k as f64 + 0.5) / count as f64);
            1e-7 * (3.0 + g - 0.15 * g * g)
        });
        Smoothed::new(&heights.chain([1.4e-6]).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn mean_and_variance_are_those_of_the_heights() {
        let own = smoothed(20_000);
        let step = 1e-3;
        let mean_of = |term: fn(f64) -> f64| {
            (-10_000..40_000)
                .map(|k| f64::from(k) * step)
                .map(|z| term(z) * own.density(z) * step)
                .sum::<f64>()
        };
        assert!((mean_of(|_| 1.0) - 1.0).abs() < 1e-9, "{}", mean_of(|_| 1.0));
        assert!(mean_of(|z| z).abs() < 1e-9);
        assert!((mean_of(|z| z * z) - 1.0).abs() < 1e-9);
        assert!((mean_of(|z| z.powi(3)) - own.skewness()).abs() < 1e-8);
        assert!((mean_of(|z| z.powi(4)) - own.kurtosis()).abs() < 1e-7);
    }

    #[test]
    fn density_survival_and_quantiles_belong_together() {
        let own = smoothed(3000);
        for z in [-3.0, -0.7, 0.0, 0.4, 1.9, 8.0, 11.2] {
            let step = 1e-4;
            let slope = (own.survival(z - step) - own.survival(z + step)) / (2.0 * step);
            assert!((slope - own.density(z)).abs() < 1e-6 * own.density(z) + 1e-14, "{z}");
        }
        for p in [1e-5, 1e-3, 0.2, 0.5, 0.9, 0.9999] {
            let z = own.quantile(p);
            assert!((own.survival(z) - (1.0 - p)).abs() < 1e-7 * p.min(1.0 - p) + 1e-12, "{p}");
        }
    }

    #[test]
    fn relative_densities_are_densities_over_the_scale() {
        let own = smoothed(3000);
        for h in [-6.0, 0.0, 2.0, 6.0, 12.0, 16.0] {
            let [start, end] = own.window(h);
            assert!(start >= 0.0 && end > start, "{h}");
            for t in [0.01, 0.3, 0.7, 0.99] {
                let x = start + t * (end - start);
                let found = own.scale(h) * own.relative_density(h, x);
                assert!((found - own.density(h + x)).abs() <= 1e-12 * own.scale(h), "{h} {x}");
            }
            assert!(own.relative_density(h, end * 1.001) < 1e-16);
        }
        let from = own.decreasing_from();
        let densities = (0..2000).map(|k| own.density(from + 1e-3 * f64::from(k)));
        assert!(densities.clone().zip(densities.skip(1)).all(|(low, high)| high <= low));
    }

    #[test]
    fn equal_heights_have_none() {
        assert_eq!(Smoothed::new(&[0.3; 9]).unwrap_err(), EqualHeights);
        // More than half of them equal.
        let mut heights = vec![0.0; 90];
        heights.extend([1.0, 2.0, 3.0]);
        assert!(Smoothed::new(&heights).unwrap().density(0.0).is_finite());
    }
}
