//! The summits that theory expects on a Gaussian surface: five-point summits on a grid (after Greenwood
//! 1984) and Nayak's on a continuous surface.

use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;
use libm::erfc;

use super::character::Drops;

/// Statistics of summits.
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

/// Summits of a continuous isotropic Gaussian surface (Nayak 1971) with the profile moments m0 (m^2), m2, m4
/// (1/m^2): density m4/(6 pi 3^.5 m2), mean curvature (8/3)(m4/pi)^.5, mean height 4 (m0/(pi alpha))^.5, variance
/// m0 (1 - (1 + 16/pi - 3 3^.5)/alpha). `None` if alpha = m0 m4/m2^2 is not above 1.5, which no such surface has.
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
/// A point is a summit if its drops to the four neighbours are all positive. Two common factors make the four
/// drops independent but for opposite ones: one that they share by as much as drops along x and along y correlate in the
/// mean, and one by which neighbouring drops differ where the lay is at an angle. Every mean over summits is then an
/// integral over the factors of moments of truncated bivariate normals. `None` on a flat surface, or where the
/// differences are those of no surface.
pub fn five_point(drops: &Drops, sigma: f64, pixel: [f64; 2]) -> Option<Expected> {
    let model = Model::new(drops)?;
    let sums = model.over_summits();
    // Sums of the two drops along an axis are in units of the drop's deviation.
    let unit = drops.first.map(f64::sqrt);
    let bend = [0, 1].map(|axis| 0.5 * unit[axis] / (pixel[axis] * pixel[axis]));
    // The height follows the drops by linear regression on their sums, with which it covaries by the drops' variance.
    // The sum of opposite drops is a second difference; of sums along x and y the covariance is that of four drops.
    let (own, cross) = (drops.second, drops.mixed);
    let determinant = own[0] * own[1] - cross * cross;
    if determinant <= 1e-12 * own[0] * own[1] {
        return None;
    }
    let first = drops.first;
    let weights = [
        (first[0] * own[1] - first[1] * cross) / determinant,
        (first[1] * own[0] - first[0] * cross) / determinant,
    ];
    let shares = [0, 1].map(|axis| weights[axis] * unit[axis]);
    let unexplained = sigma * sigma - weights[0] * first[0] - weights[1] * first[1];
    let explained = shares[0].powi(2) * sums.variance(0)
        + shares[1].powi(2) * sums.variance(1)
        + 2.0 * shares[0] * shares[1] * sums.covariance();
    Some(Expected {
        density: sums.probability / (pixel[0] * pixel[1]),
        curvature: bend[0] * sums.mean[0] + bend[1] * sums.mean[1],
        height: shares[0] * sums.mean[0] + shares[1] * sums.mean[1],
        height_variance: unexplained + explained,
    })
}

/// Drops of unit variance as sums of independent normals.
struct Model {
    /// Variance that the drops along x, along y have from the factor that all share.
    shared: [f64; 2],
    /// And from the one that is added to the drops east and north and taken off those west and south.
    turned: [f64; 2],
    /// Correlation of what is left, of opposite drops.
    pair: [f64; 2],
}

impl Model {
    fn new(drops: &Drops) -> Option<Self> {
        let Drops { first, second, mixed, skew } = *drops;
        if first.iter().chain(&second).any(|&square| square.is_nan() || square <= 0.0) {
            return None;
        }
        let scale = (first[0] * first[1]).sqrt();
        // Mean correlation of a drop along x with one along y, and half of what the two kinds of neighbours differ by.
        let adjacent = 0.25 * mixed / scale;
        let turned = 0.25 * skew.abs() / scale;
        // 1 + the correlation of opposite drops, without cancellation.
        let opposite = [0, 1].map(|axis| 0.5 * second[axis] / first[axis]);
        // The factors load on both axes as the opposite drops leave room.
        let ratio = (opposite[0] / opposite[1]).sqrt();
        let loads = [ratio, ratio.recip()];
        let shared = loads.map(|load| adjacent * load);
        let turned = loads.map(|load| turned * load);
        let rest = [0, 1].map(|axis| 1.0 - shared[axis] - turned[axis]);
        let pair = [0, 1].map(|axis| (opposite[axis] - 1.0 - shared[axis] + turned[axis]) / rest[axis]);
        let is_possible = adjacent >= 0.0
            && rest.iter().all(|&rest| rest > 0.0)
            && pair.iter().all(|&pair| pair > -1.0 && pair < 1.0);
        is_possible.then_some(Self { shared, turned, pair })
    }

    /// Integrates over the factors.
    fn over_summits(&self) -> Moments {
        let mut sums = Moments::default();
        let one = [(0.0, 1.0)];
        // Without a lay at an angle the second factor is nothing.
        let turns: &[(f64, f64)] = if self.turned[0] < 1e-9 { &one } else { &NORMAL };
        for &(v, weight_v) in NORMAL.iter() {
            for &(u, weight_u) in turns {
                let pairs = [0, 1].map(|axis| {
                    let rest = (1.0 - self.shared[axis] - self.turned[axis]).sqrt();
                    let (shared, turned) = (v * self.shared[axis].sqrt(), u * self.turned[axis].sqrt());
                    Truncated::new(
                        [(shared + turned) / rest, (shared - turned) / rest],
                        self.pair[axis],
                        rest,
                    )
                });
                sums.add(weight_v * weight_u, &pairs);
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
    fn add(&mut self, weight: f64, [x, y]: &[Truncated; 2]) {
        self.probability += weight * x.probability * y.probability;
        self.mean[0] += weight * x.sum * y.probability;
        self.mean[1] += weight * x.probability * y.sum;
        self.square[0] += weight * x.square * y.probability;
        self.square[1] += weight * x.probability * y.square;
        self.product += weight * x.sum * y.sum;
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

/// Moments of two normals of deviation `unit`, correlation r and means t1 and t2 units, over the quadrant where both
/// are positive (Rosenbaum 1961).
struct Truncated {
    probability: f64,
    /// Of their sum.
    sum: f64,
    /// Of its square.
    square: f64,
}

impl Truncated {
    fn new([t1, t2]: [f64; 2], r: f64, unit: f64) -> Self {
        let probability = both_above(t1, t2, r);
        let root = (1.0 - r * r).sqrt();
        // Densities along the two edges, X = -t1 and Y = -t2, and at the corner.
        let edges = [density(t1) * normal((t2 - r * t1) / root), density(t2) * normal((t1 - r * t2) / root)];
        let corner = density(((t1 * t1 - 2.0 * r * t1 * t2 + t2 * t2) / (1.0 - r * r)).sqrt()) * root
            / (2.0 * PI).sqrt();
        // Moments of X and Y about their means.
        let x = edges[0] + r * edges[1];
        let y = edges[1] + r * edges[0];
        let xx = probability - t1 * edges[0] - r * r * t2 * edges[1] + r * corner;
        let yy = probability - t2 * edges[1] - r * r * t1 * edges[0] + r * corner;
        let xy = r * probability - r * t1 * edges[0] - r * t2 * edges[1] + corner;
        let t = t1 + t2;
        Self {
            probability,
            sum: unit * (x + y + t * probability),
            square: unit * unit * (xx + yy + 2.0 * xy + 2.0 * t * (x + y) + t * t * probability),
        }
    }
}

/// Probability that standard normals of correlation r exceed -t1 and -t2: the product of the single ones, and
/// what their correlation adds (Plackett 1954), with r = sin(angle).
fn both_above(t1: f64, t2: f64, r: f64) -> f64 {
    let at = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        (-(t1 * t1 - 2.0 * t1 * t2 * sin + t2 * t2) / (2.0 * cos * cos)).exp()
    };
    normal(t1) * normal(t2) + RULE.integrate(0.0, r.asin(), at) / (2.0 * PI)
}

/// Nodes of an integral over a standard normal, with the density in the weights: beyond 8.5 it is below 1e-16.
static NORMAL: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    const REACH: f64 = 8.5;
    let both = [-REACH, 0.0].into_iter().flat_map(|from| RULE.nodes(from, from + REACH));
    both.map(|(x, weight)| (x, weight * density(x))).collect()
});

/// Enough nodes for 1e-11 in all integrals here.
static RULE: LazyLock<Rule> = LazyLock::new(Rule::new);

struct Rule(Vec<(f64, f64)>);

impl Rule {
    const NODES: std::num::NonZeroUsize = std::num::NonZeroUsize::new(48).unwrap();

    fn new() -> Self {
        Self(GaussLegendre::new(Self::NODES).as_node_weight_pairs().to_vec())
    }

    /// Nodes and weights between two bounds.
    fn nodes(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let (half, middle) = (0.5 * (to - from), 0.5 * (from + to));
        self.0.iter().map(move |(node, weight)| (middle + half * node, half * weight))
    }

    fn integrate(&self, from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
        self.nodes(from, to).map(|(x, weight)| weight * of(x)).sum()
    }
}

fn density(x: f64) -> f64 {
    (-0.5 * x * x).exp() / (2.0 * PI).sqrt()
}

fn normal(x: f64) -> f64 {
    0.5 * erfc(-x * FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn isotropic(rho: impl Fn(f64) -> f64) -> Drops {
        Drops::of(|i, j| rho(i.hypot(j)))
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
        let drops = |dx: f64, dy: f64| Drops::of(|i, j| rho(i * dx, j * dy));
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

    /// A lay along an axis is stretched away; one along a diagonal is the other's mirror image.
    #[test]
    fn lays() {
        let rho = |x: f64, y: f64| (-(x * x + 0.04 * y * y)).exp();
        let found = five_point(&Drops::of(|i, j| rho(0.4 * i, 2.0 * j)), 1.0, [0.4, 2.0]).unwrap();
        let round = five_point(&isotropic(|r| (-0.16 * r * r).exp()), 1.0, [1.0; 2]).unwrap();
        assert!((found.density * 0.8 / round.density - 1.0).abs() < 1e-12);
        let turned = |sign: f64| {
            let along = move |i: f64, j: f64| (i + sign * j, i - sign * j);
            let drops = Drops::of(|i, j| {
                let (u, v) = along(i, j);
                (-(0.02 * u * u + 0.3 * v * v)).exp()
            });
            five_point(&drops, 1.0, [1.0; 2]).unwrap()
        };
        let (one, other) = (turned(1.0), turned(-1.0));
        assert!((one.density / other.density - 1.0).abs() < 1e-12);
        assert!((one.height / other.height - 1.0).abs() < 1e-12);
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
