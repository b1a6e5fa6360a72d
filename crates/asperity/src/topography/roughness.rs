//! Roughness parameters of a map: height parameters, spectral moments, the autocorrelation at neighbours.

use super::rows::{Rows, Strip, first_present, strips};
use crate::numeric::lanes::Real;
use crate::numeric::sum::{Sum, Terms, sums_of_present};

/// Height parameters of a map (ISO 25178-2), about its mean, with divisor n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    /// Mean height, m.
    pub mean: f64,
    /// Mean absolute deviation Sa, m.
    pub sa: f64,
    /// Standard deviation Sq, m.
    pub sq: f64,
    /// Skewness Ssk; `None` for a flat map.
    pub ssk: Option<f64>,
    /// Kurtosis Sku (3 if Gaussian); `None` for a flat map.
    pub sku: Option<f64>,
}

/// Roughness parameters of a map, from two passes over its rows. Differences are taken where all heights are present,
/// also across the border of a periodic map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughnessParameters {
    /// Missing points.
    pub missing: usize,
    /// Height parameters.
    pub moments: Moments,
    /// Mean square of the slope along x and along y, by first differences: the profiles' second spectral moment.
    pub m2: [f64; 2],
    /// Mean square of the curvature along x and along y, by second differences, 1/m^2: the profiles' fourth
    /// spectral moment.
    pub m4: [f64; 2],
    /// Mean square differences between neighbours.
    pub drops: Drops,
}

/// Mean squares of differences between neighbouring heights, m^2: on which the five-point summits of a Gaussian surface
/// depend. Computed directly, not from an autocorrelation near 1, they lose no digits on a fine grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drops {
    /// First differences along x, along y.
    pub first: [f64; 2],
    /// Second differences along x, along y.
    pub second: [f64; 2],
    /// Mixed differences, of four points in a square: the difference along y of that along x.
    pub mixed: f64,
    /// Difference along the diagonal of increasing x and y minus that along the other diagonal: positive if heights
    /// change more along the first.
    pub skew: f64,
}

impl Drops {
    /// The drops on a surface of unit variance, from its autocorrelation at a lag of (i, j) points.
    pub fn from_correlation(correlation: impl Fn(f64, f64) -> f64) -> Self {
        let rho = correlation;
        let structure = |i: f64, j: f64| 2.0 * (1.0 - rho(i, j));
        let first = [structure(1.0, 0.0), structure(0.0, 1.0)];
        let two = [structure(2.0, 0.0), structure(0.0, 2.0)];
        let diagonals = [structure(1.0, 1.0), structure(1.0, -1.0)];
        Self {
            first,
            second: [0, 1].map(|axis| 4.0 * first[axis] - two[axis]),
            mixed: 2.0 * (first[0] + first[1]) - diagonals[0] - diagonals[1],
            skew: diagonals[0] - diagonals[1],
        }
    }

    /// Mean squares of the differences over two points along x and along y, and the negated mean of their product:
    /// those of the gradient times two pixels.
    pub fn over_two(&self) -> [f64; 3] {
        let [x, y] = [0, 1].map(|axis| 4.0 * self.first[axis] - self.second[axis]);
        [x, y, self.skew]
    }

    /// Magnitude of the correlation of slopes along x and along y, from 0 to 1; above 0 if the lay is oblique to both
    /// axes. 0 for a flat map.
    pub fn slope_correlation(&self) -> f64 {
        let [x, y, product] = self.over_two();
        let scale = (x * y).sqrt();
        if scale > 0.0 { (product / scale).abs() } else { 0.0 }
    }
}

impl Moments {
    /// Moments of the present points, bit-identical for any number of threads.
    pub fn from_rows(map: &dyn Rows) -> Self {
        RoughnessParameters::new(map).moments
    }
}

impl RoughnessParameters {
    /// The parameters of a map, bit-identical for any number of threads.
    pub fn new(map: &dyn Rows) -> Self {
        let points = map.points();
        // Relative to a height of the map, so that a large offset costs no accuracy.
        let origin = first_present(map);
        let (mut total, mut present) = (Sum::default(), 0);
        for (sum, count) in strips(map, 0, |strip| row_sums(&strip, origin)).into_iter().flatten() {
            total += sum;
            present += count;
        }
        let count = present as f64;
        // In two parts: their sum, rounded, would cost deviations from it the digits of the offset.
        let mean = total.value() / count;

        let mut sums = Sums::default();
        for part in strips(map, 2, |strip| Sums::new(&strip, [origin, mean], points)) {
            sums.merge(&part);
        }
        let [sa, square, cube, fourth] = sums.powers.map(|sum| sum.value() / count);
        let sq = square.sqrt();
        let standardised = |moment: f64, power: i32| (sq > 0.0).then(|| moment / sq.powi(power));
        let moments =
            Moments { mean: origin + mean, sa, sq, ssk: standardised(cube, 3), sku: standardised(fourth, 4) };
        let mean_square = |lag: Lag| sums.lags[lag as usize].mean();
        let pixel = map.pixel();
        Self {
            missing: points[0] * points[1] - present,
            moments,
            m2: [mean_square(Lag::X) / pixel[0].powi(2), mean_square(Lag::Y) / pixel[1].powi(2)],
            m4: [mean_square(Lag::BendX) / pixel[0].powi(4), mean_square(Lag::BendY) / pixel[1].powi(4)],
            drops: Drops {
                first: [mean_square(Lag::X), mean_square(Lag::Y)],
                second: [mean_square(Lag::BendX), mean_square(Lag::BendY)],
                mixed: mean_square(Lag::Mixed),
                skew: mean_square(Lag::Rising) - mean_square(Lag::Falling),
            },
        }
    }

    /// Spectral moments m0 (m^2), m2, m4 (1/m^2): the means of those along x and y.
    pub fn spectral_moments(&self) -> [f64; 3] {
        [self.moments.sq.powi(2), 0.5 * (self.m2[0] + self.m2[1]), 0.5 * (self.m4[0] + self.m4[1])]
    }

    /// Nayak's bandwidth parameter alpha = m0 m4/m2^2; `None` for a flat map.
    pub fn alpha(&self) -> Option<f64> {
        let [m0, m2, m4] = self.spectral_moments();
        (m2 > 0.0).then(|| m0 * m4 / (m2 * m2))
    }

    /// Root mean square of the gradient.
    pub fn rms_slope(&self) -> f64 {
        (self.m2[0] + self.m2[1]).sqrt()
    }
}

/// The points of a difference.
#[derive(Clone, Copy)]
enum Lag {
    X,
    Y,
    Rising,
    Falling,
    Mixed,
    BendX,
    BendY,
}

const LAGS: usize = 7;

/// A sum of squares and the number of its terms.
#[derive(Clone, Copy, Default)]
struct MeanSquare {
    sum: Sum,
    count: usize,
}

impl MeanSquare {
    /// Adds the squares of differences between columns of equal length.
    fn add<const C: usize>(&mut self, columns: [&[f64]; C], squares: impl Terms<C, 1>) {
        let ([sum], count) = sums_of_present(columns, squares);
        self.sum += sum;
        self.count += count;
    }

    /// Adds the square of one difference.
    fn add_one(&mut self, difference: f64) {
        self.add([&[difference], &[0.0]], First);
    }

    fn mean(&self) -> f64 {
        if self.count == 0 { 0.0 } else { self.sum.value() / self.count as f64 }
    }
}

#[derive(Default)]
struct Sums {
    /// Absolute values, second, third, fourth powers about the mean.
    powers: [Sum; 4],
    lags: [MeanSquare; LAGS],
}

impl Sums {
    fn new(strip: &Strip, [origin, mean]: [f64; 2], points: [usize; 2]) -> Self {
        let mut sums = Self::default();
        for k in 0..strip.count as isize {
            let Some(row) = strip.row(k) else { continue };
            let (next, second) = (strip.row(k + 1), strip.row(k + 2));
            sums.add_row(row, next, second, Powers { origin, mean });
            if strip.is_periodic() {
                sums.add_border(row, next, points[1]);
            }
        }
        sums
    }

    /// Adds a row, with its differences from the two that follow.
    fn add_row(&mut self, row: &[f64], next: Option<&[f64]>, second: Option<&[f64]>, powers: Powers) {
        let (powers, _) = sums_of_present([row], powers);
        for (sum, part) in self.powers.iter_mut().zip(powers) {
            *sum += part;
        }
        let lag = |lag: Lag| lag as usize;
        // Without so many points at the beginning and at the end; nothing of a row that is too short.
        let [head, tail] = [[0, 1], [1, 0]].map(|ends| inner(row, ends));
        let [first, middle, last] = [[0, 2], [1, 1], [2, 0]].map(|ends| inner(row, ends));
        self.lags[lag(Lag::Y)].add([tail, head], First);
        self.lags[lag(Lag::BendY)].add([last, middle, first], Second);
        let Some(next) = next else { return };
        let [next_head, next_tail] = [[0, 1], [1, 0]].map(|ends| inner(next, ends));
        self.lags[lag(Lag::X)].add([next, row], First);
        self.lags[lag(Lag::Rising)].add([next_tail, head], First);
        self.lags[lag(Lag::Falling)].add([next_head, tail], First);
        self.lags[lag(Lag::Mixed)].add([next_tail, tail, next_head, head], Mixed);
        let Some(second) = second else { return };
        self.lags[lag(Lag::BendX)].add([second, next, row], Second);
    }

    /// Adds the differences of a row across the border of a periodic map.
    fn add_border(&mut self, row: &[f64], next: Option<&[f64]>, ny: usize) {
        let at = |iy: usize| row[iy % ny];
        self.lags[Lag::Y as usize].add_one(at(ny) - at(ny - 1));
        for iy in [ny - 2, ny - 1] {
            self.lags[Lag::BendY as usize].add_one(at(iy + 2) - 2.0 * at(iy + 1) + at(iy));
        }
        let Some(next) = next else { return };
        self.lags[Lag::Rising as usize].add_one(next[0] - row[ny - 1]);
        self.lags[Lag::Falling as usize].add_one(next[ny - 1] - row[0]);
        self.lags[Lag::Mixed as usize].add_one((next[0] - row[0]) - (next[ny - 1] - row[ny - 1]));
    }

    fn merge(&mut self, other: &Self) {
        for (sum, part) in self.powers.iter_mut().zip(&other.powers) {
            *sum += *part;
        }
        for (lag, part) in self.lags.iter_mut().zip(&other.lags) {
            lag.sum += part.sum;
            lag.count += part.count;
        }
    }
}

/// A height above an origin.
#[derive(Clone, Copy)]
struct Above(f64);

impl Terms<1, 1> for Above {
    #[inline(always)]
    fn of<N: Real>(self, [z]: [N; 1]) -> [N; 1] {
        [z - self.0]
    }
}

/// Absolute value, second, third, fourth power about the mean, which is relative to an origin.
#[derive(Clone, Copy)]
struct Powers {
    origin: f64,
    mean: f64,
}

impl Terms<1, 4> for Powers {
    #[inline(always)]
    fn of<N: Real>(self, [z]: [N; 1]) -> [N; 4] {
        let z = (z - self.origin) - self.mean;
        let square = z * z;
        let size = N::select(z.lt(z.splat(0.0)), -z, z);
        [size, square, square * z, square * square]
    }
}

/// The square of a first difference.
#[derive(Clone, Copy)]
struct First;

impl Terms<2, 1> for First {
    #[inline(always)]
    fn of<N: Real>(self, [a, b]: [N; 2]) -> [N; 1] {
        let difference = a - b;
        [difference * difference]
    }
}

/// The square of a second difference.
#[derive(Clone, Copy)]
struct Second;

impl Terms<3, 1> for Second {
    #[inline(always)]
    fn of<N: Real>(self, [a, b, c]: [N; 3]) -> [N; 1] {
        let difference = a - b * 2.0 + c;
        [difference * difference]
    }
}

/// The square of a mixed difference.
#[derive(Clone, Copy)]
struct Mixed;

impl Terms<4, 1> for Mixed {
    #[inline(always)]
    fn of<N: Real>(self, [a, b, c, d]: [N; 4]) -> [N; 1] {
        let difference = (a - b) - (c - d);
        [difference * difference]
    }
}

/// A row without so many points at its beginning and at its end.
fn inner(row: &[f64], [begin, end]: [usize; 2]) -> &[f64] {
    row.get(begin..row.len().saturating_sub(end)).unwrap_or_default()
}

/// For each row the sum of its heights above `origin` and their number.
fn row_sums(strip: &Strip, origin: f64) -> Vec<(f64, usize)> {
    let sum = |row: &[f64]| {
        let ([sum], count) = sums_of_present([row], Above(origin));
        (sum, count)
    };
    (0..strip.count as isize).filter_map(|k| strip.row(k).map(sum)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::{Boundary, HeightMap};

    /// Over more than two strips, with holes.
    fn map() -> HeightMap {
        let height = |k: usize| if k % 41 == 7 { f64::NAN } else { 5.0 + ((k * k) % 89) as f64 };
        HeightMap::new([70, 9], [0.5, 2.0], (0..70 * 9).map(height).collect(), 0.0).unwrap()
    }

    #[test]
    fn differences_are_those_of_the_definition() {
        for map in [map(), map().periodic()] {
            let is_periodic = map.boundary() == Boundary::Periodic;
            let z = |i: isize, j: isize| {
                let is_inside = (0..70).contains(&i) && (0..9).contains(&j);
                if !is_inside && !is_periodic {
                    return f64::NAN;
                }
                map.heights()[(i.rem_euclid(70) * 9 + j.rem_euclid(9)) as usize]
            };
            let mean_square = |difference: &dyn Fn(isize, isize) -> f64| {
                let all = (0..70).flat_map(|i| (0..9).map(move |j| (i, j)));
                let there: Vec<f64> = all.map(|(i, j)| difference(i, j)).filter(|d| !d.is_nan()).collect();
                there.iter().map(|d| d * d).sum::<f64>() / there.len() as f64
            };
            let first =
                [mean_square(&|i, j| z(i + 1, j) - z(i, j)), mean_square(&|i, j| z(i, j + 1) - z(i, j))];
            let second = [
                mean_square(&|i, j| z(i + 2, j) - 2.0 * z(i + 1, j) + z(i, j)),
                mean_square(&|i, j| z(i, j + 2) - 2.0 * z(i, j + 1) + z(i, j)),
            ];
            let mixed = mean_square(&|i, j| z(i + 1, j + 1) - z(i, j + 1) - z(i + 1, j) + z(i, j));
            let skew = mean_square(&|i, j| z(i + 1, j + 1) - z(i, j))
                - mean_square(&|i, j| z(i + 1, j) - z(i, j + 1));
            let close = |found: f64, exact: f64| {
                assert!((found - exact).abs() < 1e-12 * exact.abs(), "{is_periodic}: {found} for {exact}");
            };
            let found = RoughnessParameters::new(&map);
            for axis in 0..2 {
                let pixel: f64 = map.pixel()[axis];
                close(found.drops.first[axis], first[axis]);
                close(found.drops.second[axis], second[axis]);
                close(found.m2[axis], first[axis] / pixel.powi(2));
                close(found.m4[axis], second[axis] / pixel.powi(4));
            }
            close(found.drops.mixed, mixed);
            assert!((found.drops.skew - skew).abs() < 1e-12 * mixed, "{} for {skew}", found.drops.skew);
        }
    }

    /// 10 nm at a height of 1 m, against the same stored heights near zero.
    #[test]
    fn an_offset_costs_no_digits() {
        let near = |k: usize| f64::EPSILON * ((k * k * 7) % 1009 * 4096) as f64;
        let of = |offset: f64| {
            let heights = (0..70 * 9).map(|k| offset + near(k)).collect();
            RoughnessParameters::new(&HeightMap::new([70, 9], [0.5, 2.0], heights, 0.0).unwrap()).moments
        };
        let (wanted, found) = (of(0.0), of(1.0));
        for (found, wanted) in [
            (found.sa, wanted.sa),
            (found.sq, wanted.sq),
            (1.0 + found.ssk.unwrap(), 1.0 + wanted.ssk.unwrap()),
            (found.sku.unwrap(), wanted.sku.unwrap()),
        ] {
            assert!((found - wanted).abs() <= 2e-15 * wanted, "{found} for {wanted}");
        }
    }

    #[test]
    fn spectral_moments_are_means_over_both_axes() {
        let found = RoughnessParameters::new(&map());
        let [m0, m2, m4] = found.spectral_moments();
        assert_eq!(m0, found.moments.sq.powi(2));
        assert_eq!([2.0 * m2, 2.0 * m4], [found.m2, found.m4].map(|m| m[0] + m[1]));
        assert_eq!(found.alpha(), Some(m0 * m4 / (m2 * m2)));
        assert_eq!(found.rms_slope(), (2.0 * m2).sqrt());
    }
}
