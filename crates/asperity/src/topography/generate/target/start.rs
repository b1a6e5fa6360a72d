//! The bandwidth at which a target is expected to be met: that of the discrete spectrum, by theory.
//!
//! Heights and curvatures of the summits of a Gaussian surface have a known joint density (Greenwood 1984). A transform
//! z = T(g) of the heights keeps the summits and changes their heights and drops.

use std::f64::consts::{PI, TAU};

use super::{SigmaOf, Target, TargetGenerator};
use crate::topography::joint::{JointDensity, nodes};
use crate::topography::roughness::Drops;
use crate::topography::summits::Neighbours;
use crate::topography::theory::nayak;

/// Nodes and weights of a standard normal (Gauss-Hermite, exact up to the ninth power).
const NORMAL: [[f64; 2]; 5] = [
    [0.0, 8.0 / 15.0],
    [1.355_626_179_974_266, 0.222_075_922_005_612_64],
    [-1.355_626_179_974_266, 0.222_075_922_005_612_64],
    [2.856_970_013_872_805_6, 0.011_257_411_327_720_69],
    [-2.856_970_013_872_805_6, 0.011_257_411_327_720_69],
];

impl TargetGenerator {
    /// The logarithm of the bandwidth at which a target is expected to be met. `None` where the product is out of the expected range, or
    /// theory says nothing.
    ///
    /// Iterates over the product of the simple surface, near which that of the grid and the heights is a power of it.
    pub(super) fn expected_bandwidth(&self, target: &Target) -> Option<f64> {
        const ROUNDS: usize = 5;
        /// Accuracy of the logarithm of the product; a map of 10^5 summits scatters by twice as much.
        const ACCURACY: f64 = 1e-3;
        /// A deviation at an end of the bandwidths that a map may have by chance.
        const BY_CHANCE: f64 = 0.03;
        /// Powers; below the least, the bandwidth hardly changes the product.
        const POWERS: [f64; 2] = [0.2, 2.0];
        let last = self.widest().ln();
        let simple = |log: f64| Some(self.simple_product(log, target.sigma_of)?.ln());
        let off = |log: f64| Some((self.expected_product(log, target.sigma_of)? / target.product()).ln());
        let mut log_bandwidth = root(last, |log| Some(simple(log)? - target.product().ln()))?;
        let (mut at, mut found) = (simple(log_bandwidth)?, off(log_bandwidth)?);
        let mut power = 1.0f64;
        for _ in 0..ROUNDS {
            if found.abs() < ACCURACY {
                break;
            }
            let wanted = at - found / power;
            log_bandwidth = root(last, |log| Some(simple(log)? - wanted))?;
            let next = (simple(log_bandwidth)?, off(log_bandwidth)?);
            if (next.0 - at).abs() > ACCURACY {
                power = ((next.1 - found) / (next.0 - at)).clamp(POWERS[0], POWERS[1]);
            }
            (at, found) = next;
        }
        (found.abs() < BY_CHANCE).then_some(log_bandwidth)
    }

    /// Density over mean curvature times sigma of a continuous isotropic Gaussian surface of the same moments.
    fn simple_product(&self, log_bandwidth: f64, sigma_of: SigmaOf) -> Option<f64> {
        let drops = self.expected_drops(log_bandwidth);
        let mean = |[x, y]: [f64; 2]| 0.5 * (x + y);
        let summits = nayak([1.0, mean(drops.first), mean(drops.second)])?;
        let sigma = match sigma_of {
            SigmaOf::Summits => summits.height_variance.sqrt(),
            SigmaOf::Surface => 1.0,
        };
        Some(summits.density / summits.curvature * sigma)
    }

    /// The product expected at a bandwidth.
    fn expected_product(&self, log_bandwidth: f64, sigma_of: SigmaOf) -> Option<f64> {
        /// Sum of the radii of the summits with eight lower neighbours over that of five-point summits.
        const OF_EIGHT: f64 = 0.69;
        /// Drops to the neighbours over their sum along an axis, which are distributed nearly evenly: Gauss-Legendre nodes.
        const DROPS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
        let drops = self.expected_drops(log_bandwidth);
        let summits = JointDensity::five_point(&drops, 1.0, [1.0; 2])?;
        let (mut radius, mut mean, mut square) = (0.0, 0.0, 0.0);
        for class in &summits.classes {
            let curvature = 0.5 * (class.curvatures[0] + class.curvatures[1]);
            for [node, weight] in NORMAL {
                let g = class.height + class.sd * node;
                let height = self.heights.height_at_normal(g);
                let lower = DROPS.map(|drop| self.heights.height_at_normal(g - drop * curvature));
                let share = class.share * weight;
                radius += share / (2.0 * height - lower[0] - lower[1]);
                mean += share * height;
                square += share * height * height;
            }
        }
        let sigma = match sigma_of {
            SigmaOf::Summits => (square - mean * mean).sqrt(),
            SigmaOf::Surface => 1.0,
        };
        let per_five_point = match self.neighbours {
            Neighbours::Four => 1.0,
            Neighbours::Eight => OF_EIGHT,
        };
        let product = per_five_point * summits.density * radius * sigma;
        product.is_finite().then_some(product)
    }

    /// Mean squares of differences between neighbours of the Gaussian surface, of unit variance: integrals of its spectrum.
    fn expected_drops(&self, log_bandwidth: f64) -> Drops {
        /// Nodes over wave numbers up to the roll-off, beyond it, and over half of the directions.
        const WAVES: [usize; 2] = [12, 24];
        const DIRECTIONS: usize = 24;
        let cut_off = TAU / self.cut_off;
        let roll_off = cut_off * (-log_bandwidth).exp();
        // Of the wave numbers' squares and, beyond the roll-off, their logarithms.
        let flat = nodes(WAVES[0], 0.0, roll_off).into_iter().map(|(q, weight)| (q, q * weight));
        let steep = nodes(WAVES[1], roll_off.ln(), cut_off.ln()).into_iter().map(|(log, weight)| {
            let q = log.exp();
            (q, q * q * (q / roll_off).powf(-2.0 * (1.0 + self.hurst)) * weight)
        });
        let (sin, cos) = self.lay.angle.sin_cos();
        let (mut total, mut sums) = (0.0, [0.0; 6]);
        for (q, variance) in flat.chain(steep) {
            for k in 0..DIRECTIONS {
                let (across, along) = (PI * (k as f64 + 0.5) / DIRECTIONS as f64).sin_cos();
                let (across, along) = (q * across, q * along / self.lay.elongation);
                let wave = [along * cos - across * sin, along * sin + across * cos];
                let [x, y] = wave.map(|q| 2.0 * (1.0 - q.cos()));
                let terms = [x, y, x * x, y * y, x * y, 4.0 * wave[0].sin() * wave[1].sin()];
                total += variance;
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += variance * term);
            }
        }
        let [x, y, xx, yy, mixed, skew] = sums.map(|sum| sum / total);
        Drops { first: [x, y], second: [xx, yy], mixed, skew }
    }
}

/// Where an increasing function of 0 to `last` is 0, by regula falsi with the Illinois weights (Dowell and Jarratt 1971); the
/// nearer end if it has one sign.
fn root(last: f64, of: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    const STEP: f64 = 0.7;
    const ACCURACY: f64 = 1e-4;
    const MOST: usize = 40;
    let (mut a, mut low) = (0.0, of(0.0)?);
    let (mut b, mut high) = (a, low);
    while high < 0.0 && b < last {
        (a, low) = (b, high);
        b = (a + STEP).min(last);
        high = of(b)?;
    }
    if high <= 0.0 || a == b {
        return Some(b);
    }
    let mut side = 0.0;
    for _ in 0..MOST {
        let x = (a * high - b * low) / (high - low);
        let found = of(x)?;
        if found.abs() < ACCURACY {
            return Some(x);
        }
        let stays = if side == found.signum() { 0.5 } else { 1.0 };
        if found < 0.0 {
            (a, low) = (x, found);
            high *= stays;
        } else {
            (b, high) = (x, found);
            low *= stays;
        }
        side = found.signum();
    }
    Some(0.5 * (a + b))
}
