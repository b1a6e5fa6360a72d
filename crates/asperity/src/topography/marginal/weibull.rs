//! Weibull heights: worn surfaces from sharp peaks (small shapes) to plateaus (large ones).

use std::array::from_fn;
use std::f64::consts::{PI, SQRT_2};
use std::fmt;
use std::sync::LazyLock;

use libm::erfc;
use statrs::function::gamma::gamma;

use super::NoSuchHeights;

/// The shapes that are allowed. At 0.5 the kurtosis is 88, and nearly all of the fourth moment lies in
/// heights that no map has for smaller ones; from 20 on the heights hardly differ from their limit
/// (Gumbel's, skewness -1.14), and the moments cancel.
pub const SHAPES: [f64; 2] = [0.5, 20.0];

/// Weibull's distribution (1951), 1 - exp(-x^k), shifted and scaled to zero mean and unit standard
/// deviation: T(g) = ((-ln Phi(-g))^(1/k) - mean)/sd.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weibull {
    shape: f64,
    power: f64,
    mean: f64,
    sd: f64,
    skewness: f64,
    kurtosis: f64,
}

impl Weibull {
    /// Heights of the shape k.
    ///
    /// # Errors
    /// A shape outside [`SHAPES`].
    pub fn new(shape: f64) -> Result<Self, NoSuchHeights> {
        if !(SHAPES[0]..=SHAPES[1]).contains(&shape) {
            return Err(NoSuchHeights::WeibullShape(shape));
        }
        let raw = |order: f64| gamma(1.0 + order / shape);
        let (mean, second) = (raw(1.0), raw(2.0));
        let sd = (second - mean * mean).sqrt();
        let third = raw(3.0) - mean * (3.0 * second - 2.0 * mean * mean);
        let fourth = raw(4.0) - mean * (4.0 * raw(3.0) - mean * (6.0 * second - 3.0 * mean * mean));
        let [skewness, kurtosis] = [third / sd.powi(3), fourth / sd.powi(4)];
        Ok(Self { shape, power: 1.0 / shape, mean, sd, skewness, kurtosis })
    }

    /// The height of the standard normal `g`.
    pub fn map(&self, g: f64) -> f64 {
        self.height(log_hazard(&PANELS, g))
    }

    #[inline]
    fn height(&self, log_hazard: f64) -> f64 {
        ((self.power * log_hazard).exp() - self.mean) / self.sd
    }

    /// Replaces every standard normal by `scale` times its height.
    pub(super) fn apply(&self, field: &mut [f64], scale: f64) {
        let panels = &*PANELS;
        field.iter_mut().for_each(|z| *z = scale * self.height(log_hazard(panels, *z)));
    }

    /// The slope dT/dg.
    pub fn derivative(&self, g: f64) -> f64 {
        let density = (-0.5 * g * g).exp() / (2.0 * PI).sqrt();
        let above = 0.5 * erfc(g / SQRT_2);
        self.power / self.sd * hazard(g).powf(self.power - 1.0) * density / above
    }

    /// The shape k.
    pub const fn shape(&self) -> f64 {
        self.shape
    }

    /// Skewness of the heights.
    pub const fn skewness(&self) -> f64 {
        self.skewness
    }

    /// Kurtosis of the heights (3 if normal).
    pub const fn kurtosis(&self) -> f64 {
        self.kurtosis
    }
}

impl fmt::Display for Weibull {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { shape, skewness, kurtosis, .. } = self;
        write!(f, "Weibull, shape {shape}, skewness {skewness:.4}, kurtosis {kurtosis:.4}")
    }
}

/// -ln Phi(-g), from the tail that is the smaller, so that neither loses a digit. The error function
/// is that of libm, to an ulp; that of statrs 0.19 is off by up to 2e-9 in the tail.
fn hazard(g: f64) -> f64 {
    let tail = 0.5 * erfc(g.abs() / SQRT_2);
    if g < 0.0 { -(-tail).ln_1p() } else { -tail.ln() }
}

/// Half the number of panels, and where they end.
const HALF: usize = 36;
const END: f64 = 9.0;

/// Terms of a panel.
const TERMS: usize = 10;

/// Chebyshev coefficients of ln(-ln Phi(-g)) on panels over [-9, 9]. The nearest complex zeros of Phi
/// are 2.8 away, 22 times the half width of a panel, so ten terms reach rounding, four times faster than
/// an error function, a logarithm and a power.
static PANELS: LazyLock<[[f64; TERMS]; 2 * HALF]> = LazyLock::new(|| {
    let angle = |node: usize| PI * (node as f64 + 0.5) / TERMS as f64;
    from_fn(|panel| {
        let at = |t: f64| hazard((panel as f64 + 0.5 + 0.5 * t) * (END / HALF as f64) - END).ln();
        // Less the value in the middle, so that roundings are relative to the change across a panel.
        let middle = at(0.0);
        let values: [f64; TERMS] = from_fn(|node| at(angle(node).cos()) - middle);
        from_fn(|order| {
            let sum: f64 = (0..TERMS).map(|node| values[node] * (order as f64 * angle(node)).cos()).sum();
            if order == 0 { middle + sum / TERMS as f64 } else { 2.0 * sum / TERMS as f64 }
        })
    })
});

/// ln(-ln Phi(-g)).
#[inline]
fn log_hazard(panels: &[[f64; TERMS]; 2 * HALF], g: f64) -> f64 {
    let place = (g + END) * (HALF as f64 / END);
    // A negative or missing place becomes a panel whose t is out of range.
    let panel = place as usize;
    let t = 2.0 * (place - panel as f64) - 1.0;
    match panels.get(panel) {
        // Clenshaw's sum.
        Some(terms) if t >= -1.0 => {
            let (mut next, mut after) = (0.0, 0.0);
            for &term in terms[1..].iter().rev() {
                (next, after) = (term + 2.0 * t * next - after, next);
            }
            terms[0] + t * next - after
        }
        _ => hazard(g).ln(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::marginal::tests::moments;

    #[test]
    fn skewness_and_kurtosis_of_known_shapes() {
        let known = [(1.0, 2.0, 9.0), (1.5, 1.072, 4.390), (2.0, 0.631, 3.245), (3.0, 0.168, 2.729)];
        for (shape, skewness, kurtosis) in
            known.into_iter().chain([(5.0, -0.254, 2.880), (3.60235, 0.0, 2.717)])
        {
            let weibull = Weibull::new(shape).unwrap();
            assert!((weibull.skewness() - skewness).abs() < 5e-4, "{weibull}");
            assert!((weibull.kurtosis() - kurtosis).abs() < 5e-4, "{weibull}");
        }
    }

    #[test]
    fn the_map_has_the_moments_of_the_gamma_function() {
        for shape in [0.5, 0.7, 1.0, 1.5, 2.0, 3.60235, 5.0, 10.0, 20.0] {
            let weibull = Weibull::new(shape).unwrap();
            let wanted = [0.0, 1.0, weibull.skewness(), weibull.kurtosis()];
            for (found, wanted) in moments(|g| weibull.map(g)).into_iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-9 * wanted.abs().max(1.0), "{weibull}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn both_tails_keep_their_digits() {
        // The shape 1 is the exponential: T + 1 = -ln Phi(-g); mpmath.
        for (g, exact) in [
            (-9.0, 1.1285884059538406e-19),
            (-3.0, 0.0013508099647481938),
            (0.0, std::f64::consts::LN_2),
            (3.0, 6.607726221510343),
            (9.0, 43.628149113332115),
        ] {
            assert!((hazard(g) / exact - 1.0).abs() < 4e-15, "{g}: {}", hazard(g));
        }
    }

    #[test]
    fn panels_are_the_function_to_rounding() {
        for k in -95_000..=95_000 {
            let g = f64::from(k) * 1e-4;
            let exact = hazard(g).ln();
            let gap = (log_hazard(&PANELS, g) - exact).abs();
            assert!(gap <= 4e-15 * exact.abs().max(1.0), "{g}: {gap:e} of {exact}");
        }
        assert!(log_hazard(&PANELS, f64::NAN).is_nan());
    }

    #[test]
    fn shapes_out_of_range_are_refused() {
        for shape in [0.49, 20.1, -1.0, 0.0, f64::NAN, f64::INFINITY] {
            assert_eq!(
                Weibull::new(shape).unwrap_err().to_string(),
                format!("Weibull shape {shape}; allowed: 0.5 to 20")
            );
        }
    }
}
