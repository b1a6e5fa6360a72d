//! Elliptic asperities: the equal spheres that they are to every law (docs/theory.md, section 1).

use crate::stability::wide::{PI, Wide};

/// So many equal spheres side by side.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// b, m.
    pub radius: Wide,
    /// n, 1 of a sphere.
    pub spheres: Wide,
}

impl Shape {
    /// A sphere of `radius` (m).
    pub fn sphere(radius: f64) -> Self {
        Self { radius: Wide::new(radius), spheres: Wide::ONE }
    }

    /// A paraboloid of mean curvature `mean_curvature` (1/m) and `ratio` = kmax/kmin: m from [E/(1-m) - K]/(K - E) =
    /// `ratio`, by bisection of ln(1 - m) and then by secants.
    pub fn ellipse(mean_curvature: f64, ratio: f64) -> Self {
        let wanted = Wide::new(ratio).ln();
        // ln(ratio) decreases as v = ln(1 - m) grows, by 3/4 at a circle to 1.
        let value = |v: Wide| {
            let [k, e] = complete(v.exp());
            let minor = v.exp();
            ((e / minor - k) / (k - e)).ln() - wanted
        };
        let (mut low, mut high) = (-wanted * 4.0 / 3.0 - 1e-3, -wanted / 2.0);
        for _ in 0..40 {
            let middle = (low + high) * 0.5;
            if value(middle) > Wide::ZERO { low = middle } else { high = middle }
        }
        let (mut before, mut now) = (low, high);
        let (mut of_before, mut of_now) = (value(before), value(now));
        for _ in 0..6 {
            let change = of_now - of_before;
            if change == Wide::ZERO || of_now == Wide::ZERO {
                break;
            }
            let next = now - of_now * (now - before) / change;
            (before, of_before) = (now, of_now);
            (now, of_now) = (next, value(next));
        }
        let minor = now.exp();
        let [k, e] = complete(minor);
        let half = PI / (k * 2.0);
        Self { radius: k * e * 4.0 / (PI * PI * mean_curvature), spheres: half * half / minor.sqrt() }
    }
}

/// K(m) and E(m), given 1 - m, by the arithmetic-geometric mean.
fn complete(minor: Wide) -> [Wide; 2] {
    let (mut arithmetic, mut geometric) = (Wide::ONE, minor.sqrt());
    let mut sum = (Wide::ONE - minor) * 0.5;
    let mut power = Wide::new(0.5);
    for _ in 0..60 {
        let difference = (arithmetic - geometric) * 0.5;
        (arithmetic, geometric) = ((arithmetic + geometric) * 0.5, (arithmetic * geometric).sqrt());
        power *= 2.0;
        sum += power * difference * difference;
        if difference.abs() < Wide::new(1e-17) * arithmetic {
            break;
        }
    }
    let k = PI / (arithmetic * 2.0);
    [k, k * (Wide::ONE - sum)]
}
