//! Expected summits of a Gaussian surface: five-point summits on a grid (after Greenwood 1984) and Nayak's on a
//! continuous surface.

use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;
use libm::erfc;

use super::roughness::Drops;

/// Expected statistics of summits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Expected {
    /// Summits per area, 1/m^2.
    pub density: f64,
    /// Mean curvature, 1/m.
    pub curvature: f64,
    /// Mean height above the mean plane, m.
    pub height: f64,
    /// Variance of the heights, m^2.
    pub height_variance: f64,
}

/// Summits of a continuous isotropic Gaussian surface (Nayak 1971) with the profile moments m0 (m^2), m2, m4 (1/m^2):
/// density m4/(6 pi 3^.5 m2), mean curvature (8/3)(m4/pi)^.5, mean height 4 (m0/(pi alpha))^.5, variance m0 (1 - (1 +
/// 16/pi - 3 3^.5)/alpha). `None` unless alpha = m0 m4/m2^2 is above 1.5, as for every such surface.
pub fn nayak([m0, m2, m4]: [f64; 3]) -> Option<Expected> {
    let alpha = m0 * m4 / (m2 * m2);
    (alpha > 1.5).then(|| Expected {
        density: m4 / (6.0 * PI * 3f64.sqrt() * m2),
        curvature: 8.0 / 3.0 * (m4 / PI).sqrt(),
        height: 4.0 * (m0 / (PI * alpha)).sqrt(),
        height_variance: m0 * (1.0 - (1.0 + 16.0 / PI - 3.0 * 3f64.sqrt()) / alpha),
    })
}

/// Five-point summits of a Gaussian surface of standard deviation `sigma` (m) on a grid of `pixel` (m), from the mean
/// squares of its differences between neighbours (m^2).
///
/// A point is a summit if its drops to the four neighbours are all positive. Sums of opposite drops, second
/// differences, are independent of their differences: the drops are positive where each sum exceeds the magnitude of
/// its difference. Means over summits are integrals over the two differences of moments of a bivariate normal beyond a
/// corner, which have a closed form. `None` if heights vary along one direction only, or if no surface has these
/// differences.
pub fn five_point(drops: &Drops, sigma: f64, pixel: [f64; 2]) -> Option<Expected> {
    let model = Model::new(drops)?;
    let sums = model.over_summits();
    // Sums are in units of their standard deviations.
    let unit = drops.second.map(f64::sqrt);
    let bend = [0, 1].map(|axis| 0.5 * unit[axis] / (pixel[axis] * pixel[axis]));
    // The height is given by linear regression on the sums; its covariance with each is the mean square of one drop.
    let covariances = [0, 1].map(|axis| drops.first[axis] / unit[axis]);
    let free = 1.0 - model.sums * model.sums;
    let weights = [
        (covariances[0] - model.sums * covariances[1]) / free,
        (covariances[1] - model.sums * covariances[0]) / free,
    ];
    let unexplained = sigma * sigma - weights[0] * covariances[0] - weights[1] * covariances[1];
    let explained = weights[0].powi(2) * sums.variance(0)
        + weights[1].powi(2) * sums.variance(1)
        + 2.0 * weights[0] * weights[1] * sums.covariance();
    Some(Expected {
        density: sums.probability / (pixel[0] * pixel[1]),
        curvature: bend[0] * sums.mean[0] + bend[1] * sums.mean[1],
        height: weights[0] * sums.mean[0] + weights[1] * sums.mean[1],
        height_variance: unexplained + explained,
    })
}

/// Sums and differences of opposite drops, each along x and along y.
struct Model {
    /// Correlation of the two sums.
    sums: f64,
    /// Variances of the differences in units of those of the sums, and their covariance.
    differences: [f64; 3],
}

impl Model {
    fn new(drops: &Drops) -> Option<Self> {
        /// A larger correlation is that of a profile.
        const PROFILE: f64 = 1.0 - 1e-9;
        let Drops { first, second, mixed, .. } = *drops;
        if first.iter().chain(&second).any(|&square| square.is_nan() || square <= 0.0) {
            return None;
        }
        let scale = (second[0] * second[1]).sqrt();
        let sums = mixed / scale;
        let [x, y, product] = drops.over_two();
        let (variances, covariance) = ([x / second[0], y / second[1]], product / scale);
        let is_possible = (-PROFILE..PROFILE).contains(&sums)
            && variances.iter().all(|&variance| variance >= 0.0)
            && covariance * covariance <= variances[0] * variances[1];
        is_possible.then_some(Self { sums, differences: [variances[0], variances[1], covariance] })
    }

    /// Integrates over the differences t, in polar coordinates in which their density times the fraction of summits is
    /// isotropic: with their covariance V, t = L u where L L' = V (V + 1)^-1.
    fn over_summits(&self) -> Moments {
        /// Beyond it the fraction is below 1e-16.
        const REACH: f64 = 12.5;
        let [xx, yy, xy] = self.differences;
        let determinant = (xx + 1.0) * (yy + 1.0) - xy * xy;
        // V (V + 1)^-1 = 1 - (V + 1)^-1.
        let [cx, cy, cxy] =
            [1.0 - (yy + 1.0) / determinant, 1.0 - (xx + 1.0) / determinant, xy / determinant];
        let root = cx.max(0.0).sqrt();
        let (slant, rest) = if root > 0.0 {
            (cxy / root, (cy - (cxy / root).powi(2)).max(0.0).sqrt())
        } else {
            (0.0, cy.max(0.0).sqrt())
        };
        // The angle of u for a direction of t.
        let angle = |[x, y]: [f64; 2]| (y * root - x * slant).atan2(x * rest);
        let correlation: Vec<AtCorrelation> = AtCorrelation::up_to(self.sums).collect();
        let mut sums = Moments::default();
        // By symmetry half of the plane suffices; it is split where the integrand is not smooth.
        for [from, to] in [
            [[0.0, -1.0], [1.0, -1.0]],
            [[1.0, -1.0], [1.0, 0.0]],
            [[1.0, 0.0], [1.0, 1.0]],
            [[1.0, 1.0], [0.0, 1.0]],
        ] {
            for (angle, across) in QUADRATURE.nodes(angle(from), angle(to)) {
                let (sin, cos) = angle.sin_cos();
                let t = [root * cos, slant * cos + rest * sin];
                let fall = 1.0 - t[0] * t[0] - t[1] * t[1];
                let across = across / (PI * determinant.sqrt());
                let corner = t.map(f64::abs);
                for (r, along) in QUADRATURE.nodes(0.0, REACH) {
                    let weight = across * along * r * (-0.5 * fall * r * r).exp();
                    let [a, b] = corner.map(|t| r * t);
                    sums.add(weight, &Beyond::new([a, b], self.sums, normal(-a) * normal(-b)));
                }
                // What the correlation adds to the probability falls as a Gaussian along r: its integral has a closed form.
                let along_r = |q: f64| -(-(0.5 * fall + q) * REACH * REACH).exp_m1() / (fall + 2.0 * q);
                let added =
                    correlation.iter().map(|at| at.weight * along_r(at.exponent(corner))).sum::<f64>();
                sums.add(across * added, &Beyond::probability(self.sums));
            }
        }
        sums.over_probability()
    }
}

/// Moments over summits of the sums of drops along x and along y.
#[derive(Debug, Default)]
struct Moments {
    probability: f64,
    mean: [f64; 2],
    square: [f64; 2],
    product: f64,
}

impl Moments {
    fn add(&mut self, weight: f64, beyond: &Beyond) {
        self.probability += weight * beyond.probability;
        for axis in 0..2 {
            self.mean[axis] += weight * beyond.first[axis];
            self.square[axis] += weight * beyond.second[axis];
        }
        self.product += weight * beyond.product;
    }

    fn over_probability(self) -> Self {
        let p = self.probability;
        Self {
            probability: p,
            mean: self.mean.map(|m| m / p),
            square: self.square.map(|m| m / p),
            product: self.product / p,
        }
    }

    fn variance(&self, axis: usize) -> f64 {
        self.square[axis] - self.mean[axis].powi(2)
    }

    fn covariance(&self) -> f64 {
        self.product - self.mean[0] * self.mean[1]
    }
}

/// Moments of standard normals X and Y of correlation r where X > a and Y > b (Rosenbaum 1961).
struct Beyond {
    probability: f64,
    /// Means of X and of Y.
    first: [f64; 2],
    /// Means of their squares.
    second: [f64; 2],
    /// Mean of their product.
    product: f64,
}

impl Beyond {
    /// Of a `probability`.
    fn new([a, b]: [f64; 2], r: f64, probability: f64) -> Self {
        let root = (1.0 - r * r).sqrt();
        // Densities along the two edges and at the corner.
        let edges = [density(a) * normal((r * a - b) / root), density(b) * normal((r * b - a) / root)];
        let corner =
            density(((a * a - 2.0 * r * a * b + b * b) / (1.0 - r * r)).sqrt()) * root / (2.0 * PI).sqrt();
        Self {
            probability,
            first: [edges[0] + r * edges[1], edges[1] + r * edges[0]],
            second: [
                probability + a * edges[0] + r * r * b * edges[1] + r * corner,
                probability + b * edges[1] + r * r * a * edges[0] + r * corner,
            ],
            product: r * probability + r * a * edges[0] + r * b * edges[1] + corner,
        }
    }

    /// What one more in the probability makes of the moments.
    fn probability(r: f64) -> Self {
        Self { probability: 1.0, first: [0.0; 2], second: [1.0; 2], product: r }
    }
}

/// Probability that standard normals of correlation r exceed -t1 and -t2: the product of the single probabilities plus
/// an integral over the correlation (Plackett 1954), with r = sin(angle).
pub(super) fn both_above(t1: f64, t2: f64, r: f64) -> f64 {
    let at = |at: AtCorrelation| at.weight * (-at.exponent([t1, t2])).exp();
    normal(t1) * normal(t2) + AtCorrelation::up_to(r).map(at).sum::<f64>()
}

/// A node of the integral over the correlation.
struct AtCorrelation {
    sin: f64,
    /// 2 cos^2 of the angle.
    twice_square_cos: f64,
    weight: f64,
}

impl AtCorrelation {
    /// The nodes from no correlation to `r`.
    fn up_to(r: f64) -> impl Iterator<Item = Self> {
        QUADRATURE.nodes(0.0, r.asin()).map(|(angle, weight)| {
            let (sin, cos) = angle.sin_cos();
            Self { sin, twice_square_cos: 2.0 * cos * cos, weight: weight / (2.0 * PI) }
        })
    }

    /// Minus the exponent of the bivariate normal density at a corner.
    fn exponent(&self, [a, b]: [f64; 2]) -> f64 {
        (a * a - 2.0 * a * b * self.sin + b * b) / self.twice_square_cos
    }
}

/// Quadrature with an error of 1e-11, and of 1e-8 for an elongation of 1000.
static QUADRATURE: LazyLock<Quadrature> = LazyLock::new(Quadrature::new);

struct Quadrature(Vec<(f64, f64)>);

impl Quadrature {
    const NODES: std::num::NonZeroUsize = std::num::NonZeroUsize::new(48).unwrap();

    fn new() -> Self {
        Self(GaussLegendre::new(Self::NODES).as_node_weight_pairs().to_vec())
    }

    /// Nodes and weights between two bounds.
    fn nodes(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let (half, middle) = (0.5 * (to - from), 0.5 * (from + to));
        self.0.iter().map(move |(node, weight)| (middle + half * node, half * weight))
    }
}

pub(super) fn density(x: f64) -> f64 {
    (-0.5 * x * x).exp() / (2.0 * PI).sqrt()
}

fn normal(x: f64) -> f64 {
    0.5 * erfc(-x * FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn isotropic(rho: impl Fn(f64) -> f64) -> Drops {
        Drops::from_correlation(|i, j| rho(i.hypot(j)))
    }

    /// The table of five-point summits in PHYSICS part B, of which all digits are right.
    #[test]
    fn the_table_of_five_point_summits() {
        type Case = (fn(f64) -> f64, [f64; 4]);
        let cases: [Case; 4] = [
            (|r| (-r).exp(), [0.1616, 2.246, 1.060, 0.593]),
            (|r| (-r * r / 4.0).exp(), [0.0514, 0.951, 1.200, 0.650]),
            (|r| (-r * r).exp(), [0.1365, 2.179, 1.174, 0.541]),
            (|_| 0.0, [0.2000, 2.907, 1.163, 0.447]),
        ];
        for (rho, [probability, curvature, height, variance]) in cases {
            let found = five_point(&isotropic(rho), 1.0, [1.0; 2]).unwrap();
            assert!((found.density - probability).abs() < 6e-5);
            assert!((found.curvature - curvature).abs() < 6e-4);
            assert!((found.height - height).abs() < 6e-4);
            assert!((found.height_variance - variance).abs() < 6e-4);
        }
    }

    #[test]
    fn white_noise_has_a_fifth_of_its_points_as_summits() {
        let found = five_point(&isotropic(|_| 0.0), 1.0, [1.0; 2]).unwrap();
        assert!((found.density - 0.2).abs() < 1e-11, "{}", found.density);
    }

    #[test]
    fn units_and_rectangular_pixels() {
        let rho = |x: f64, y: f64| (-(x * x + 4.0 * y * y)).exp();
        let drops = |dx: f64, dy: f64| Drops::from_correlation(|i, j| rho(i * dx, j * dy));
        let one = five_point(&drops(0.5, 0.2), 1.0, [0.5, 0.2]).unwrap();
        let three = |mut drops: Drops| {
            drops.first = drops.first.map(|square| 9.0 * square);
            drops.second = drops.second.map(|square| 9.0 * square);
            (drops.mixed, drops.skew) = (9.0 * drops.mixed, 9.0 * drops.skew);
            drops
        };
        let other = five_point(&three(drops(0.5, 0.2)), 3.0, [1.0, 0.4]).unwrap();
        assert!((other.density / one.density - 0.25).abs() < 1e-14);
        assert!((other.curvature / one.curvature - 0.75).abs() < 1e-14);
        assert!((other.height / one.height - 3.0).abs() < 1e-14);
        assert!((other.height_variance / one.height_variance - 9.0).abs() < 1e-12);
        // A stretch that makes it isotropic changes neither which points are summits nor their heights.
        let square = five_point(&drops(0.4, 0.2), 1.0, [0.4, 0.2]).unwrap();
        let isotropic = five_point(&isotropic(|r| (-0.16 * r * r).exp()), 1.0, [1.0; 2]).unwrap();
        assert!((square.density * 0.08 - isotropic.density).abs() < 1e-14);
        assert!((square.height - isotropic.height).abs() < 1e-13);
    }

    /// A lay along an axis is stretched away; a mirror image, or x for y, changes nothing.
    #[test]
    fn lays() {
        let gaussian = |elongation: f64, angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let drops = Drops::from_correlation(|i, j| {
                let (along, across) = ((i * cos + j * sin) / elongation, j * cos - i * sin);
                (-0.02 * (along * along + across * across)).exp()
            });
            five_point(&drops, 1.0, [1.0; 2]).unwrap()
        };
        let rho = |x: f64, y: f64| (-(x * x + 0.04 * y * y)).exp();
        let found =
            five_point(&Drops::from_correlation(|i, j| rho(0.4 * i, 2.0 * j)), 1.0, [0.4, 2.0]).unwrap();
        let round = five_point(&isotropic(|r| (-0.16 * r * r).exp()), 1.0, [1.0; 2]).unwrap();
        assert!((found.density * 0.8 / round.density - 1.0).abs() < 1e-12);
        let near = |a: Expected, b: Expected, most: f64| {
            let pairs = [
                (a.density, b.density),
                (a.curvature, b.curvature),
                (a.height, b.height),
                (a.height_variance, b.height_variance),
            ];
            assert!(pairs.iter().all(|(a, b)| (a / b - 1.0).abs() < most), "{a:?} {b:?}");
        };
        let half = std::f64::consts::FRAC_PI_2;
        for angle in [0.1, 0.3, 0.5, 0.7] {
            for elongation in [1.5, 5.0, 20.0] {
                let one = gaussian(elongation, angle);
                near(one, gaussian(elongation, -angle), 1e-11);
                near(one, gaussian(elongation, half - angle), 1e-11);
            }
        }
        // A small turn is a small change.
        near(gaussian(5.0, 1e-7), gaussian(5.0, 0.0), 1e-6);
    }

    /// As the grid shrinks, five points count 1.30639 times Nayak's summits: saddles too.
    #[test]
    fn on_a_fine_grid_five_points_count_saddles_too() {
        let h: f64 = 0.02;
        let found = five_point(&isotropic(|r| (-(h * r).powi(2)).exp()), 1.0, [h; 2]).unwrap();
        let nayak = nayak([1.0, 2.0, 12.0]).unwrap();
        assert!((found.density / nayak.density - 1.30639).abs() < 3e-3, "{}", found.density / nayak.density);
    }
}
