//! The shape of one asperity: a sphere, or a number of equivalent spheres for an ellipse (elliptic ZMC, derived).

use std::ops::Range;
use std::sync::LazyLock;

use crate::numeric::table::Table;

/// The shape of an asperity: a number of equal spheres at the same indentation.
///
/// An elliptic paraboloid of principal curvatures kmax >= kmin > 0 and mean curvature km = (kmax + kmin)/2 touches a
/// flat in an ellipse of semi-axes a > c and parameter m = 1 - c^2/a^2 (Hertz; Johnson 1985, section 4.2). With the
/// complete elliptic integrals K(m) and E(m)
///
/// ```text
/// [E/(1-m) - K]/(K - E) = kmax/kmin,  c^2 = w E/(km K),  A = pi a c,  P = (2 pi/3) E* a w/K
/// ```
///
/// which is n times the area and the load of a sphere of radius b (Eqs. 6, 10 of Pasaribu and Schipper 2005):
///
/// ```text
/// b = (4/pi^2) K E/km,  n = (pi/2K)^2/(1-m)^.5
/// ```
///
/// Since n b w = a c at every w, the mean pressure is also that of the sphere, and a law that yields at a given mean
/// pressure yields at the w1 of b, for ZMC w1 = (0.6 H/E*)^2 K E/km.
///
/// Exact for elastic contacts with w much smaller than both radii. Using n spheres beyond w1 is an assumption made
/// here: Jeng and Wang (2003) fitted a law for ellipses, which was not available. It neglects that the mean pressure at
/// yield depends on the ellipticity, and the plastic area n 2 pi b w is smaller than the section 2 pi w/(kmax kmin)^.5
/// of the paraboloid: by 0.65 % at kmax/kmin = 2, 5.9 % at 10.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// b, m.
    pub radius: f64,
    /// n; 1 for a sphere.
    pub spheres: f64,
}

/// The octaves of kmax/kmin covered by the tables.
const OCTAVES: Range<i32> = 0..24;

/// b km and n as functions of kmax/kmin.
static TABLES: LazyLock<[Table; 2]> = LazyLock::new(|| {
    let of = |value: fn(Shape) -> f64| Table::new(OCTAVES, |ratio| value(Shape::solved(1.0, ratio)));
    [of(|shape| shape.radius), of(|shape| shape.spheres)]
});

impl Shape {
    /// A sphere of `radius` (m).
    pub const fn sphere(radius: f64) -> Self {
        Self { radius, spheres: 1.0 }
    }

    /// A paraboloid of mean curvature km = `mean_curvature` (1/m), positive, and kmax/kmin = `curvature_ratio`, from 1
    /// to 1e300: up to 2^24 by a table, within 4e-15 of [`Self::solved`].
    #[inline]
    pub fn ellipse(mean_curvature: f64, curvature_ratio: f64) -> Self {
        // Exact, unlike the table.
        if curvature_ratio == 1.0 {
            return Self::sphere(mean_curvature.recip());
        }
        let [radius, spheres] = &*TABLES;
        match (radius.at(curvature_ratio), spheres.at(curvature_ratio)) {
            (Some((radius, _)), Some((spheres, _))) => Self { radius: radius / mean_curvature, spheres },
            _ => Self::solved(mean_curvature, curvature_ratio),
        }
    }

    /// [`Self::ellipse`] from the equations instead of the table, within 2e-15.
    ///
    /// ln(kmax/kmin) is a convex function of ln(1 - m), its slope from -3/4 at a sphere to -1. Hence Newton's method
    /// from 1 - m = kmin/kmax, which is too large, passes the solution once and then converges monotonically; each step
    /// is at most a third of the previous one.
    pub fn solved(mean_curvature: f64, curvature_ratio: f64) -> Self {
        /// The square of a smaller step is below rounding.
        const LAST: f64 = 1e-8;
        /// Sufficient, since the first step is shorter than 6.
        const MOST: usize = 20;
        debug_assert!((1.0..=1e300).contains(&curvature_ratio));
        // 1 - m, accurate also for m near 1.
        let mut q = curvature_ratio.recip();
        for _ in 0..MOST {
            let [b, d] = integrals(q);
            let ratio = b / (q * d);
            // Bounded by its limit at m = 0, near which the quotient is rounding error or 0/0.
            let steepness = 1.5 - ((ratio - 1.0) * (ratio.recip() + q) / (2.0 * (1.0 - q))).min(0.75);
            let step = (ratio / curvature_ratio).ln() / steepness;
            q *= step.exp();
            if step.abs() <= LAST {
                break;
            }
        }
        let [b, d] = integrals(q);
        let (first, second) = (b + d, b + q * d);
        Self { radius: first * second / mean_curvature, spheres: (first * first * q.sqrt()).recip() }
    }
}

/// 2/pi times the complete elliptic integrals B = (E - (1-m) K)/m and D = (K - E)/m, where `q` = 1 - m > 0: B + D = K,
/// B + q D = E, and B/(q D) = kmax/kmin.
///
/// By the arithmetic-geometric mean without subtractions (Bulirsch, Numerische Mathematik 7, 78, 1965), accurate for
/// any m.
fn integrals(q: f64) -> [f64; 2] {
    /// Relative difference of the two means from which the next step is below rounding.
    const CLOSE: f64 = 1e-8;
    let mut means = [1.0, q.sqrt()];
    // For B and for D.
    let (mut sum, mut last, mut rest) = ([1.0; 2], [1.0, 0.0], [0.0, 1.0]);
    loop {
        let [arithmetic, geometric] = means;
        let double = arithmetic + geometric;
        let apart = (arithmetic - geometric).abs() > CLOSE * arithmetic;
        for k in 0..2 {
            rest[k] = 2.0 * (last[k] * geometric + rest[k]);
            last[k] = sum[k];
            sum[k] += rest[k] / double;
        }
        if !apart {
            return sum.map(|sum| 0.5 * sum / double);
        }
        means = [double, 2.0 * (arithmetic * geometric).sqrt()];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// kmax/kmin, b km and n, from 160 digits (mpmath), rounded once.
    const EXACT: [[f64; 3]; 17] = [
        [1.0, 1.0, 1.0],
        [1.0009765625, 1.0000000529302109, 1.0000000529302129],
        [1.125, 1.0007703425462866, 1.000770787817087],
        [1.5, 1.0090817478593332, 1.0091439355614729],
        [2.0, 1.0262574154234987, 1.0267825219953604],
        [3.0, 1.064408076509151, 1.0676398543710084],
        [5.0, 1.132482810571701, 1.1467297173689892],
        [10.0, 1.251810175671677, 1.3072523004906709],
        [31.0, 1.4855867097783348, 1.7262379095570868],
        [100.0, 1.7484284766218696, 2.438882386558741],
        [1e3, 2.2725448196054416, 5.33224493899625],
        [1e4, 2.7873118340815686, 12.648158937612788],
        [1e6, 3.791647721419575, 81.48756899367392],
        [1e7, 4.285852086654735, 215.900388097151],
        [1e9, 5.264633380089472, 1601.1531980430093],
        [1e12, 6.71744308527341, 35445.497363910414],
        [1e60, 29.42342468078153, 3.9612154844996895e27],
    ];

    #[test]
    fn against_many_digits() {
        let mut worst = [0.0f64; 2];
        for [ratio, radius, spheres] in EXACT {
            for (worst, shape) in
                worst.iter_mut().zip([Shape::solved(1.0, ratio), Shape::ellipse(1.0, ratio)])
            {
                let error = (shape.radius / radius - 1.0).abs().max((shape.spheres / spheres - 1.0).abs());
                *worst = worst.max(error);
            }
        }
        assert!(worst[0] < 2e-15 && worst[1] < 3e-15, "{worst:?}");
    }

    #[test]
    fn the_table_is_the_solution() {
        let mut worst = 0.0f64;
        for k in 0..100_000 {
            let ratio = (f64::from(k) * 1.612e-4).exp();
            let (table, exact) = (Shape::ellipse(1.0, ratio), Shape::solved(1.0, ratio));
            worst = worst.max((table.radius / exact.radius - 1.0).abs());
            worst = worst.max((table.spheres / exact.spheres - 1.0).abs());
        }
        assert!(worst < 4e-15, "{worst:e}");
    }

    /// Bit for bit.
    #[test]
    fn equal_curvatures_are_a_sphere() {
        for curvature in [3.7e5f64, 1.0, 1.0 / 3.0] {
            let sphere = Shape::sphere(curvature.recip());
            assert_eq!(Shape::ellipse(curvature, 1.0), sphere);
            assert_eq!(Shape::solved(curvature, 1.0), sphere);
        }
    }

    #[test]
    fn longer_ellipses_are_more_and_larger_spheres() {
        for of in [Shape::ellipse, Shape::solved] {
            let shapes: Vec<Shape> = (0..30_000).map(|k| of(1.0, (f64::from(k) * 1e-3).exp())).collect();
            let grows = |value: fn(&Shape) -> f64| shapes.is_sorted_by(|a, b| value(a) < value(b));
            assert!(grows(|shape| shape.radius) && grows(|shape| shape.spheres));
        }
    }

    /// Next to a sphere, and far from it.
    #[test]
    fn every_ratio_has_a_solution() {
        let near = std::iter::successors(Some(1f64), |ratio| Some(ratio.next_up())).take(1000);
        for ratio in near {
            for shape in [Shape::ellipse(1.0, ratio), Shape::solved(1.0, ratio)] {
                assert!((shape.radius - 1.0).abs() < 1e-15 && (shape.spheres - 1.0).abs() < 1e-15);
            }
        }
        for ratio in (0..=996).map(|power| 2f64.powi(power)).chain([1e300]) {
            let shape = Shape::ellipse(1.0, ratio);
            assert!(shape.radius.is_finite() && shape.spheres.is_finite());
        }
    }

    /// The plastic area of n spheres beside the section of the paraboloid, 2 pi w/(kmax kmin)^.5.
    #[test]
    fn a_plastic_ellipse_falls_short_of_its_section() {
        for (ratio, shortfall) in [(2.0, 0.0065), (10.0, 0.059), (100.0, 0.16), (1e6, 0.38)] {
            let shape = Shape::ellipse(1.0, ratio);
            let section = (1.0 + ratio) / (2.0 * f64::sqrt(ratio));
            let found = 1.0 - shape.spheres * shape.radius / section;
            assert!((found / shortfall - 1.0).abs() < 0.04, "{ratio}: {found}");
        }
    }
}
