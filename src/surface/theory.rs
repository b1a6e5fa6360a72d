//! The summits that theory expects on a Gaussian surface: five-point summits on a grid (after Greenwood
//! 1984) and Nayak's on a continuous surface.

use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;
use libm::erfc;

use super::character::NeighbourCorrelation;

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

/// Five-point summits of a Gaussian surface of standard deviation `sigma` (m) on a grid of `pixel` (m), from its
/// autocorrelation at neighbours.
///
/// A point is a summit if its drops to the four neighbours are all positive. Drops along x and along y correlate
/// alike where the lay, if any, is along an axis: then, given one common factor v, the two pairs are
/// independent, and every mean over summits is an integral over v of moments of truncated bivariate
/// normals. `None` where neighbours do not correlate as those of a surface do.
pub fn five_point(correlation: &NeighbourCorrelation, sigma: f64, pixel: [f64; 2]) -> Option<Expected> {
    let NeighbourCorrelation { one, two, diagonal } = *correlation;
    // Variances of the drops, and their correlations: of a drop along x with one along y, and of opposite ones.
    let variance = one.map(|rho| 2.0 * (1.0 - rho));
    if variance.iter().any(|&variance| variance.is_nan() || variance <= 0.0) {
        return None;
    }
    let deviation = variance.map(f64::sqrt);
    let adjacent = (1.0 + diagonal - one[0] - one[1]) / (deviation[0] * deviation[1]);
    let opposite = [0, 1].map(|axis| 1.0 - (1.0 - two[axis]) / variance[axis]);
    let rest = 1.0 - adjacent;
    let pair = opposite.map(|correlation| (correlation - adjacent) / rest);
    if !(0.0..1.0).contains(&adjacent) || pair.iter().any(|&r| !(-1.0..1.0).contains(&r)) {
        return None;
    }
    let sums = Moments::over_summits(adjacent, pair);

    // Sums of the two drops along an axis are u_x, u_y in units of the deviation of the uncommon part.
    let unit = [0, 1].map(|axis| sigma * deviation[axis] * rest.sqrt());
    let bend = [0, 1].map(|axis| 0.5 * unit[axis] / (pixel[axis] * pixel[axis]));
    let curvature = bend[0] * sums.mean[0] + bend[1] * sums.mean[1];
    // The height follows the drops by linear regression on their sums.
    let weights = regression(variance, deviation, opposite, adjacent)?;
    let shares = [0, 1].map(|axis| weights[axis] * unit[axis] / sigma);
    let height = sigma * (shares[0] * sums.mean[0] + shares[1] * sums.mean[1]);
    let unexplained = 1.0 - weights[0] * variance[0] - weights[1] * variance[1];
    let explained = shares[0].powi(2) * sums.variance(0)
        + shares[1].powi(2) * sums.variance(1)
        + 2.0 * shares[0] * shares[1] * sums.covariance();
    Some(Expected {
        density: sums.probability / (pixel[0] * pixel[1]),
        curvature,
        height,
        height_variance: sigma * sigma * (unexplained + explained),
    })
}

/// Weights of the sums of drops along x and along y in the height, for sigma = 1. A height covaries with each
/// drop by half of the drop's variance.
fn regression(
    variance: [f64; 2],
    deviation: [f64; 2],
    opposite: [f64; 2],
    adjacent: f64,
) -> Option<[f64; 2]> {
    let own = [0, 1].map(|axis| 2.0 * variance[axis] * (1.0 + opposite[axis]));
    let cross = 4.0 * adjacent * deviation[0] * deviation[1];
    let determinant = own[0] * own[1] - cross * cross;
    let is_regular = determinant > 1e-12 * own[0] * own[1];
    is_regular.then(|| {
        [
            (variance[0] * own[1] - variance[1] * cross) / determinant,
            (variance[1] * own[0] - variance[0] * cross) / determinant,
        ]
    })
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
    /// Integrates over the common factor v of all four drops.
    fn over_summits(adjacent: f64, pair: [f64; 2]) -> Self {
        /// Beyond, the density of v is below 1e-17.
        const REACH: f64 = 8.5;
        let threshold = (adjacent / (1.0 - adjacent)).sqrt();
        let integral = |term: &dyn Fn(&[Truncated; 2]) -> f64| {
            let at = |v: f64| {
                let pairs = pair.map(|r| Truncated::new(v * threshold, r));
                density(v) * term(&pairs)
            };
            RULE.integrate(-REACH, 0.0, at) + RULE.integrate(0.0, REACH, at)
        };
        let probability = integral(&|[x, y]| x.probability * y.probability);
        let over = |term: &dyn Fn(&[Truncated; 2]) -> f64| integral(term) / probability;
        Self {
            probability,
            mean: [over(&|[x, y]| x.sum * y.probability), over(&|[x, y]| x.probability * y.sum)],
            square: [over(&|[x, y]| x.square * y.probability), over(&|[x, y]| x.probability * y.square)],
            product: over(&|[x, y]| x.sum * y.sum),
        }
    }

    fn variance(&self, axis: usize) -> f64 {
        self.square[axis] - self.mean[axis].powi(2)
    }

    fn covariance(&self) -> f64 {
        self.product - self.mean[0] * self.mean[1]
    }
}

/// Moments of X + Y + 2t over X > -t and Y > -t, for standard normal X, Y of correlation r (Rosenbaum 1961).
struct Truncated {
    probability: f64,
    /// Of X + Y + 2t.
    sum: f64,
    /// Of its square.
    square: f64,
}

impl Truncated {
    fn new(t: f64, r: f64) -> Self {
        let probability = both_above(t, r);
        let edge = density(t) * normal(t * ((1.0 - r) / (1.0 + r)).sqrt());
        let corner = density(t * (2.0 / (1.0 + r)).sqrt()) * (1.0 - r * r).sqrt() / (2.0 * PI).sqrt();
        // First moment of X, second moments of X and of X Y.
        let first = (1.0 + r) * edge;
        let square = probability - t * (1.0 + r * r) * edge + r * corner;
        let product = r * probability - 2.0 * t * r * edge + corner;
        Self {
            probability,
            sum: 2.0 * (first + t * probability),
            square: 2.0 * (square + product) + 8.0 * t * first + 4.0 * t * t * probability,
        }
    }
}

/// Probability that two standard normals of correlation r both exceed -t: the product of the single ones, and
/// what their correlation adds (Plackett 1954), with r = sin(angle).
fn both_above(t: f64, r: f64) -> f64 {
    let correlated = RULE.integrate(0.0, r.asin(), |angle| (-t * t / (1.0 + angle.sin())).exp()) / (2.0 * PI);
    normal(t).powi(2) + correlated
}

/// Enough nodes for 1e-11 in all integrals here.
static RULE: LazyLock<Rule> = LazyLock::new(Rule::new);

struct Rule(Vec<(f64, f64)>);

impl Rule {
    const NODES: std::num::NonZeroUsize = std::num::NonZeroUsize::new(48).unwrap();

    fn new() -> Self {
        Self(GaussLegendre::new(Self::NODES).as_node_weight_pairs().to_vec())
    }

    fn integrate(&self, from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
        let (half, middle) = (0.5 * (to - from), 0.5 * (from + to));
        half * self.0.iter().map(|(node, weight)| weight * of(middle + half * node)).sum::<f64>()
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
    use std::f64::consts::SQRT_2;

    fn isotropic(rho: impl Fn(f64) -> f64) -> NeighbourCorrelation {
        NeighbourCorrelation { one: [rho(1.0); 2], two: [rho(2.0); 2], diagonal: rho(SQRT_2) }
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
            println!("{found:?}");
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
        let correlation = |dx: f64, dy: f64| NeighbourCorrelation {
            one: [rho(dx, 0.0), rho(0.0, dy)],
            two: [rho(2.0 * dx, 0.0), rho(0.0, 2.0 * dy)],
            diagonal: rho(dx, dy),
        };
        let one = five_point(&correlation(0.5, 0.2), 1.0, [0.5, 0.2]).unwrap();
        let other = five_point(&correlation(0.5, 0.2), 3.0, [1.0, 0.4]).unwrap();
        assert!((other.density / one.density - 0.25).abs() < 1e-14);
        assert!((other.curvature / one.curvature - 0.75).abs() < 1e-14);
        assert!((other.height / one.height - 3.0).abs() < 1e-14);
        assert!((other.height_variance / one.height_variance - 9.0).abs() < 1e-13);
        // A stretch that makes it isotropic changes neither which points are summits nor their heights.
        let square = five_point(&correlation(0.4, 0.2), 1.0, [0.4, 0.2]).unwrap();
        let isotropic = five_point(&isotropic(|r| (-0.16 * r * r).exp()), 1.0, [1.0; 2]).unwrap();
        assert!((square.density * 0.08 - isotropic.density).abs() < 1e-14);
        assert!((square.height - isotropic.height).abs() < 1e-13);
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
