//! Joint densities of height and curvature over the summits of a Gaussian surface, as classes of equal curvature.

use std::f64::consts::{PI, SQRT_2};

use gauss_quad::GaussLegendre;
use libm::erf;

use super::roughness::Drops;
use super::theory::{both_above, density as normal_density};

/// Summits of one curvature, whose heights are Gaussian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SummitClass {
    /// Share of all summits.
    pub share: f64,
    /// Principal curvatures, 1/m, the larger first.
    pub curvatures: [f64; 2],
    /// Mean height above the mean plane, m.
    pub height: f64,
    /// Standard deviation of the heights, m.
    pub sd: f64,
}

/// The joint density of height and curvature of summits.
#[derive(Debug, Clone, PartialEq)]
pub struct JointDensity {
    /// Summits per area, 1/m^2.
    pub density: f64,
    /// In a fixed order; their shares add up to 1.
    pub classes: Vec<SummitClass>,
}

/// Nodes over the mean curvature and over its difference from the principal ones.
const NODES: [usize; 2] = [40, 24];

/// The largest mean curvature, in standard deviations of that of any point of the surface: at separations up to 5 sigma the rest is
/// negligible.
const SHARPEST: f64 = 13.0;

/// e to the minus this is negligible.
const NEGLIGIBLE: f64 = 40.0;

/// Classes of a smaller share, relative to the largest one, are left out.
const SMALLEST: f64 = 1e-30;

impl JointDensity {
    /// Summits of a continuous isotropic Gaussian surface (Nayak 1971; Greenwood 2006) with the profile moments m0 (m^2), m2, m4
    /// (1/m^2); `None` unless alpha = m0 m4/m2^2 exceeds 1.5.
    ///
    /// The mean curvature km is normal of variance 2 m4/3, half the difference of the principal ones, delta, has a Rayleigh
    /// distribution of variance m4/3 in each component, and of all points those with zero gradient and delta < km are summits, with
    /// the weight k1 k2 = km^2 - delta^2 of the Jacobian: with t = km/(2 m4/3)^.5 and s = 3 delta^2/(2 m4), the density is
    /// m4/(3 pi m2) phi(t) (t^2 - s) e^-s over 0 < s < t^2. Given km the height is normal with the mean 3 m2 km/(2 m4) and the
    /// variance m0 (1 - 3/(2 alpha)), whatever delta.
    pub fn nayak([m0, m2, m4]: [f64; 3]) -> Option<Self> {
        let alpha = m0 * m4 / (m2 * m2);
        if alpha.is_nan() || alpha <= 1.5 {
            return None;
        }
        let unit = (2.0 * m4 / 3.0).sqrt();
        let sd = (m0 * (1.0 - 1.5 / alpha)).sqrt();
        let mut classes = Vec::new();
        for (t, along) in nodes(NODES[0], 0.0, SHARPEST) {
            for (s, across) in nodes(NODES[1], 0.0, (t * t).min(NEGLIGIBLE)) {
                let share = along * across * normal_density(t) * (t * t - s) * (-s).exp();
                let (mean, half) = (unit * t, unit * s.sqrt());
                classes.push(SummitClass {
                    share,
                    curvatures: [mean + half, mean - half],
                    height: 1.5 * m2 / m4 * mean,
                    sd,
                });
            }
        }
        Some(Self::normalised(classes, m4 / (3.0 * PI * m2)))
    }

    /// Five-point summits of a Gaussian surface of standard deviation `sigma` (m) on a grid of `pixel` (m), from the mean squares of its
    /// differences between neighbours (Greenwood 1984); `None` where heights vary along one direction only, or no surface has these
    /// differences.
    ///
    /// The curvatures along x and y are second differences, whose joint density is weighted with the probability that the first
    /// differences across the point are smaller; both principal curvatures of a class are their mean, as in the deterministic model.
    /// Given them the height is normal, by linear regression.
    pub fn five_point(drops: &Drops, sigma: f64, pixel: [f64; 2]) -> Option<Self> {
        let expected = super::theory::five_point(drops, sigma, pixel)?;
        let unit = drops.second.map(f64::sqrt);
        let sums = drops.mixed / (unit[0] * unit[1]);
        let free = 1.0 - sums * sums;
        let covariances = [0, 1].map(|axis| drops.first[axis] / unit[axis]);
        let weights = [
            (covariances[0] - sums * covariances[1]) / free,
            (covariances[1] - sums * covariances[0]) / free,
        ];
        let variance = sigma * sigma - weights[0] * covariances[0] - weights[1] * covariances[1];
        let bend = [0, 1].map(|axis| 0.5 * unit[axis] / (pixel[axis] * pixel[axis]));
        let [across_x, across_y, product] = drops.over_two();
        let spreads = [across_x.sqrt(), across_y.sqrt()];
        let slant = product / (spreads[0] * spreads[1]);
        let is_summit = |x: f64, y: f64| {
            let [a, b] = [unit[0] * x / spreads[0], unit[1] * y / spreads[1]];
            if slant == 0.0 {
                return erf(a / SQRT_2) * erf(b / SQRT_2);
            }
            let corner = |a, b| both_above(a, b, slant);
            corner(a, b) - corner(-a, b) - corner(a, -b) + corner(-a, -b)
        };
        let mut classes: Vec<SummitClass> = Vec::new();
        for (sum, along) in nodes(NODES[0], 0.0, SQRT_2 * SHARPEST) {
            let first = classes.len();
            for (part, across) in nodes(NODES[1], -1.0, 1.0) {
                let [x, y] = [0.5 * sum * (1.0 + part), 0.5 * sum * (1.0 - part)];
                let exponent = -0.5 * (x * x - 2.0 * sums * x * y + y * y) / free;
                let share = along * across * 0.5 * sum * exponent.exp() * is_summit(x, y);
                let curvature = bend[0] * x + bend[1] * y;
                let height = weights[0] * x + weights[1] * y;
                let class =
                    SummitClass { share, curvatures: [curvature; 2], height, sd: variance.max(0.0).sqrt() };
                // On a square grid without a lay both depend on the sum alone.
                let same = |one: &&mut SummitClass| {
                    (one.curvatures[0] - curvature).abs() <= SAME * curvature
                        && (one.height - height).abs() <= SAME * sigma
                };
                match classes[first..].iter_mut().find(same) {
                    Some(one) => one.share += share,
                    None => classes.push(class),
                }
            }
        }
        let total: f64 = classes.iter().map(|class| class.share).sum();
        Some(Self::normalised(classes, expected.density / total))
    }

    /// Classes whose shares times `density` (1/m^2) are numbers per area.
    fn normalised(mut classes: Vec<SummitClass>, density: f64) -> Self {
        let total: f64 = classes.iter().map(|class| class.share).sum();
        let largest = classes.iter().map(|class| class.share).fold(0.0, f64::max);
        classes.retain(|class| class.share > SMALLEST * largest);
        classes.iter_mut().for_each(|class| class.share /= total);
        Self { density: density * total, classes }
    }

    /// Mean of a property of the summits.
    pub fn mean(&self, of: impl Fn(&SummitClass) -> f64) -> f64 {
        self.classes.iter().map(|class| class.share * of(class)).sum()
    }
}

/// Relative difference of equal curvatures, and of equal heights over sigma.
const SAME: f64 = 1e-12;

/// Greenwood's joint density of height and curvature (2006) of the summits of a continuous isotropic Gaussian surface of bandwidth `alpha` >
/// 1.5: of the height over m0^.5, `xi`, and of `g` = (k1 k2/m4)^.5, per unit of both.
pub fn greenwood(alpha: f64, xi: f64, g: f64) -> f64 {
    let narrow = (alpha - 1.0) / (2.0 * (2.0 * alpha - 3.0));
    let place = g - xi * alpha.sqrt() / (3.0 * (alpha - 1.0));
    let exponent = 1.5 * g * g - alpha * xi * xi / (2.0 * (alpha - 1.0));
    let u = 3.0 * narrow.sqrt() * place;
    // exp(1.5 g^2) alone overflows where erfc underflows.
    let tail =
        if u > 0.0 { scaled_erfc(u) * (exponent - u * u).exp() } else { libm::erfc(u) * exponent.exp() };
    4.5 / (2.0 * PI).sqrt() * (alpha / (alpha - 1.0)).sqrt() * g.powi(3) * tail
}

/// exp(u^2) erfc(u) for u >= 0: from its definition up to 5, beyond by the continued fraction (DLMF 7.9.2).
fn scaled_erfc(u: f64) -> f64 {
    const NEAR: f64 = 5.0;
    const TERMS: usize = 60;
    if u < NEAR {
        return (u * u).exp() * libm::erfc(u);
    }
    let mut fraction = u;
    for k in (1..=TERMS).rev() {
        fraction = u + 0.5 * k as f64 / fraction;
    }
    1.0 / (PI.sqrt() * fraction)
}

/// Gauss-Legendre nodes and weights.
pub(super) fn nodes(count: usize, from: f64, to: f64) -> Vec<(f64, f64)> {
    let Some(count) = std::num::NonZeroUsize::new(count) else { return Vec::new() };
    let (half, middle) = (0.5 * (to - from), 0.5 * (from + to));
    let rule = GaussLegendre::new(count);
    rule.as_node_weight_pairs().iter().map(|(node, weight)| (middle + half * node, half * weight)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::theory;

    fn moments_of(joint: &JointDensity) -> [f64; 4] {
        let curvature = joint.mean(|one| 0.5 * (one.curvatures[0] + one.curvatures[1]));
        let height = joint.mean(|one| one.height);
        let variance = joint.mean(|one| one.sd * one.sd + (one.height - height).powi(2));
        [joint.density, curvature, height, variance]
    }

    #[test]
    fn nayak_s_density_means_and_variance() {
        for alpha in [1.51, 2.0, 3.38, 8.0, 40.0, 1000.0] {
            let [m0, m2] = [4e-18, 1e-4];
            let m4 = alpha * m2 * m2 / m0;
            let wanted = theory::nayak([m0, m2, m4]).unwrap();
            let wanted = [wanted.density, wanted.curvature, wanted.height, wanted.height_variance];
            let joint = JointDensity::nayak([m0, m2, m4]).unwrap();
            for (found, wanted) in moments_of(&joint).into_iter().zip(wanted) {
                assert!((found / wanted - 1.0).abs() < 1e-12, "{alpha}: {found:e} {wanted:e}");
            }
            assert!((joint.mean(|_| 1.0) - 1.0).abs() < 1e-14);
        }
        assert!(JointDensity::nayak([1.0, 1.0, 1.5]).is_none());
    }

    /// Integrates Greenwood's density, which is smooth, by panels.
    fn over_greenwood(alpha: f64, of: impl Fn(f64, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for i in 0..16 {
            for (xi, along) in nodes(24, -8.0 + f64::from(i), -7.0 + f64::from(i)) {
                for k in 0..10 {
                    for (g, across) in nodes(24, f64::from(k), f64::from(k + 1)) {
                        sum += along * across * greenwood(alpha, xi, g) * of(xi, g);
                    }
                }
            }
        }
        sum
    }

    #[test]
    fn greenwood_s_density_is_that_of_the_classes() {
        for alpha in [1.6f64, 3.0, 10.0] {
            let joint = JointDensity::nayak([1.0, 1.0, alpha]).unwrap();
            assert!((over_greenwood(alpha, |_, _| 1.0) - 1.0).abs() < 1e-12, "{alpha}");
            let geometric = |one: &SummitClass| (one.curvatures[0] * one.curvatures[1] / alpha).sqrt();
            let pairs = [
                (over_greenwood(alpha, |xi, _| xi), joint.mean(|one| one.height)),
                (over_greenwood(alpha, |_, g| g * g), joint.mean(|one| geometric(one).powi(2))),
                (
                    over_greenwood(alpha, |xi, g| xi * g * g),
                    joint.mean(|one| one.height * geometric(one).powi(2)),
                ),
            ];
            for (closed, classes) in pairs {
                assert!((closed / classes - 1.0).abs() < 1e-11, "{alpha}: {closed} {classes}");
            }
        }
    }

    #[test]
    fn five_point_summits_have_the_expected_moments() {
        let isotropic =
            |scale: f64| Drops::from_correlation(move |i: f64, j: f64| (-(i * i + j * j) / scale).exp());
        let oblique = Drops::from_correlation(|i, j| (-0.3 * i * i - 0.1 * j * j - 0.15 * i * j).exp());
        for (drops, pixel) in
            [(isotropic(1.0), [1.0, 1.0]), (isotropic(25.0), [1.0, 1.0]), (oblique, [0.5, 0.8])]
        {
            let wanted = theory::five_point(&drops, 1.0, pixel).unwrap();
            let wanted = [wanted.density, wanted.curvature, wanted.height, wanted.height_variance];
            let joint = JointDensity::five_point(&drops, 1.0, pixel).unwrap();
            for (found, wanted) in moments_of(&joint).into_iter().zip(wanted) {
                assert!((found / wanted - 1.0).abs() < 1e-9, "{found} {wanted}");
            }
        }
        assert!(JointDensity::five_point(&isotropic(25.0), 1.0, [1.0; 2]).unwrap().classes.len() <= NODES[0]);
    }
}
