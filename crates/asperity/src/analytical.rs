//! Closed results for rough surfaces in elastic contact, to be drawn beside the models: real area against load from the
//! r.m.s. gradient alone, and how far a finite patch as a whole is deflected.

use std::f64::consts::{PI, SQRT_2, TAU};

use libm::erf;

use crate::literature::{self, Paper};
use crate::named_enum;

named_enum! {
    /// A closed result beside the models.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    pub enum AnalyticalLine {
        /// Area against load by Persson, see [`persson`].
        Persson = "persson",
        /// Area against load by Bush, Gibson and Thomas, see [`bush_gibson_thomas`].
        BushGibsonThomas = "bush-gibson-thomas",
        /// The models' separation less the deflection of a finite patch as a whole, [`mean_deflection`].
        GreenwoodWilliamsonInteracting = "greenwood-williamson-interacting",
    }
}

impl AnalyticalLine {
    /// Real over nominal area at a nominal pressure over E* on a surface of an r.m.s. `gradient`; `None` of a line that
    /// gives a separation.
    pub fn area_ratio(self, pressure: f64, gradient: f64) -> Option<f64> {
        match self {
            Self::Persson => Some(persson(pressure, gradient)),
            Self::BushGibsonThomas => Some(bush_gibson_thomas(pressure, gradient)),
            Self::GreenwoodWilliamsonInteracting => None,
        }
    }

    /// Its source.
    pub const fn paper(self) -> Paper {
        match self {
            Self::Persson => literature::PERSSON_2001,
            Self::BushGibsonThomas => literature::BUSH_GIBSON_THOMAS_1975,
            Self::GreenwoodWilliamsonInteracting => literature::CIAVARELLA_GREENWOOD_PAGGI_2008,
        }
    }
}

/// Real over nominal area by Persson's theory, erf(sqrt(2) p/(E* g)), at a nominal pressure over E* on a surface of an r.m.s.
/// `gradient` g, of both directions together (Persson 2001, with the variance of the pressure in full contact, (E* g)^2/4).
/// At light load sqrt(8/pi) p/(E* g), in full contact 1. 0 without a load.
pub fn persson(pressure: f64, gradient: f64) -> f64 {
    let ratio = pressure / gradient;
    if ratio > 0.0 { erf(SQRT_2 * ratio) } else { 0.0 }
}

/// Real over nominal area by the asperity model of Bush, Gibson and Thomas (1975) in the limit of light load,
/// sqrt(2 pi) p/(E* g), at a nominal pressure over E* on a surface of an r.m.s. `gradient` g, of both directions together; at
/// most 1. 0 without a load.
pub fn bush_gibson_thomas(pressure: f64, gradient: f64) -> f64 {
    let ratio = pressure / gradient;
    if ratio > 0.0 { (TAU.sqrt() * ratio).min(1.0) } else { 0.0 }
}

/// Mean deflection (m) of a rectangle of the given `sides` (m) on an elastic half-space under a uniform pressure over E*: that
/// of a square is 0.9464 p side/E*. By which the asperities of a finite patch are further from the flat than the
/// undeformed mean plane is (the idea of Ciavarella, Greenwood and Paggi 2008; the constant is that of Boussinesq's
/// displacement 1/(pi E* r) of a unit load, averaged twice over the rectangle, not taken from the paper).
pub fn mean_deflection(pressure: f64, sides: [f64; 2]) -> f64 {
    let [a, b] = sides;
    let diagonal = a.hypot(b);
    let logarithms = 0.5 * (a * (b / a).asinh() + b * (a / b).asinh());
    let corners = (a.powi(3) + b.powi(3) - diagonal.powi(3)) / (6.0 * a * b);
    pressure * 4.0 / PI * (logarithms + corners)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_linear_at_light_load_and_full_under_a_heavy_one() {
        for gradient in [0.01, 0.3] {
            let light = 1e-9 * gradient;
            for (line, slope) in [
                (AnalyticalLine::Persson, (8.0 / PI).sqrt()),
                (AnalyticalLine::BushGibsonThomas, (2.0 * PI).sqrt()),
            ] {
                let area = |pressure| line.area_ratio(pressure, gradient).unwrap();
                assert!((area(light) / (slope * 1e-9) - 1.0).abs() < 1e-12, "{}", line.name());
                assert_eq!((area(10.0 * gradient), area(0.0)), (1.0, 0.0));
            }
        }
        assert_eq!((persson(0.0, 0.0), persson(1.0, 0.0)), (0.0, 1.0));
        // erf(1) to 16 digits.
        assert!((persson(0.5_f64.sqrt(), 1.0) - 0.842_700_792_949_714_9).abs() < 1e-15);
        assert_eq!(AnalyticalLine::GreenwoodWilliamsonInteracting.area_ratio(1e-3, 0.1), None);
    }

    /// The double average of 1/(pi r), by the midpoint rule over the distances of two points.
    #[test]
    fn the_deflection_is_the_mean_of_boussinesqs() {
        let averaged = |[a, b]: [f64; 2]| {
            const STEPS: usize = 2000;
            let at = |k: usize, side: f64| side * (k as f64 + 0.5) / STEPS as f64;
            let term = |(i, j): (usize, usize)| {
                let (x, y) = (at(i, a), at(j, b));
                (a - x) * (b - y) / x.hypot(y)
            };
            let all = (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j)));
            4.0 / (PI * STEPS.pow(2) as f64) * all.map(term).sum::<f64>()
        };
        for sides in [[1.0, 1.0], [3.0, 1.0], [1.0, 0.2]] {
            let found = mean_deflection(1.0, sides);
            assert!((found / averaged(sides) - 1.0).abs() < 2e-3, "{sides:?}: {found}");
            assert_eq!(found, mean_deflection(1.0, [sides[1], sides[0]]));
        }
        let square = mean_deflection(2.0, [3.0, 3.0]) / 6.0;
        let exact = 4.0 / PI * ((1.0 + SQRT_2).ln() - (SQRT_2 - 1.0) / 3.0);
        assert!((square - exact).abs() < 1e-15 && (square - 0.9464).abs() < 5e-5, "{square}");
    }
}
