//! Weibull heights, for worn surfaces: from sharp peaks (small shape) to plateaus (large shape).

use std::fmt;

use statrs::function::gamma::gamma;

use super::normal::{PANELS, log_hazard};
use super::{Entry, FOLDINGS, FOLDINGS_PER_PANEL, HeightDistribution, Heights, whole_panels};
use crate::literature::{Paper, WEIBULL_1951};

pub(super) const ENTRY: Entry = Entry {
    name: "weibull",
    parameters: &[("shape", 2.0)],
    make: |values| Ok(Heights::new(Weibull::new(values[0])?)),
};

/// The range of the shape k. Below 0.5 (kurtosis 88) nearly all of the fourth moment lies in heights that no map has;
/// above 20 the heights are close to their limit (Gumbel, skewness -1.14), and the moments cancel.
pub const SHAPES: [f64; 2] = [0.5, 20.0];

/// Value of a standard exponential variable that is negligible.
const NEGLIGIBLE: f64 = 1e-18;

/// A separation is at the lower end of the support if its u is at most this.
const LOWER_END: f64 = 1e-30;

/// The load of a contact grows by at most this power of the indentation.
const GROWTH: f64 = 2.0;

/// A shape outside [`SHAPES`].
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("Weibull shape {0}; allowed: {least} to {most}", least = SHAPES[0], most = SHAPES[1])]
pub struct ShapeError(pub f64);

/// A skewness that no shape within [`SHAPES`] has.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("skewness {skewness:.3}; Weibull heights have {least:.3} to {most:.3}")]
pub struct SkewnessError {
    skewness: f64,
    least: f64,
    most: f64,
}

/// Weibull's distribution (1951), 1 - exp(-t^k), shifted and scaled to zero mean and unit standard deviation: the height
/// is (t - mean)/sd.
///
/// u = t^k is a standard exponential variable, and the integral runs over v = u minus its value at the separation: the
/// density in v is exp(-v) for every shape, and the singularity in x at t = 0 becomes a power of u.
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
    pub fn new(shape: f64) -> Result<Self, ShapeError> {
        if !(SHAPES[0]..=SHAPES[1]).contains(&shape) {
            return Err(ShapeError(shape));
        }
        let raw = |order: f64| gamma(1.0 + order / shape);
        let (mean, second) = (raw(1.0), raw(2.0));
        let sd = (second - mean * mean).sqrt();
        let third = raw(3.0) - mean * (3.0 * second - 2.0 * mean * mean);
        let fourth = raw(4.0) - mean * (4.0 * raw(3.0) - mean * (6.0 * second - 3.0 * mean * mean));
        let [skewness, kurtosis] = [third / sd.powi(3), fourth / sd.powi(4)];
        Ok(Self { shape, power: 1.0 / shape, mean, sd, skewness, kurtosis })
    }

    /// Heights of this skewness, which falls as the shape grows.
    ///
    /// # Errors
    /// A skewness that no shape within [`SHAPES`] has.
    pub fn with_skewness(skewness: f64) -> Result<Self, SkewnessError> {
        /// Bisections of ln(shape), to rounding.
        const HALVINGS: usize = 60;
        let ends = SHAPES.map(Self::new).map(|end| end.map_or(f64::NAN, |weibull| weibull.skewness));
        let error = SkewnessError { skewness, least: ends[1], most: ends[0] };
        if !(ends[1]..=ends[0]).contains(&skewness) {
            return Err(error);
        }
        let [mut low, mut high] = SHAPES;
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            if Self::new(middle).map_err(|_| error)?.skewness > skewness {
                low = middle;
            } else {
                high = middle;
            }
        }
        Self::new((low * high).sqrt()).map_err(|_| error)
    }

    /// The shape k.
    pub const fn shape(&self) -> f64 {
        self.shape
    }

    #[inline]
    fn height(&self, t: f64) -> f64 {
        (t - self.mean) / self.sd
    }

    /// t of the height `z`: negative below the support.
    fn t(&self, z: f64) -> f64 {
        z.mul_add(self.sd, self.mean)
    }

    /// u of the height `z`, 0 below the support.
    fn u(&self, z: f64) -> f64 {
        self.t(z).max(0.0).powf(self.shape)
    }
}

impl fmt::Display for Weibull {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { shape, skewness, kurtosis, .. } = self;
        write!(f, "Weibull, shape {shape}, skewness {skewness:.4}, kurtosis {kurtosis:.4}")
    }
}

impl HeightDistribution for Weibull {
    fn name(&self) -> &'static str {
        ENTRY.name
    }

    fn label(&self) -> &'static str {
        "Weibull"
    }

    fn parameters(&self) -> Vec<(&'static str, f64)> {
        vec![("shape", self.shape)]
    }

    fn papers(&self) -> &'static [Paper] {
        &[WEIBULL_1951]
    }

    fn skewness(&self) -> f64 {
        self.skewness
    }

    fn kurtosis(&self) -> f64 {
        self.kurtosis
    }

    fn support(&self) -> [f64; 2] {
        [self.height(0.0), f64::INFINITY]
    }

    fn density(&self, z: f64) -> f64 {
        let (t, u) = (self.t(z), self.u(z));
        if t > 0.0 { self.sd * self.shape * u / t * (-u).exp() } else { 0.0 }
    }

    fn survival(&self, z: f64) -> f64 {
        (-self.u(z)).exp()
    }

    fn quantile(&self, p: f64) -> f64 {
        self.height((-(-p).ln_1p()).powf(self.power))
    }

    fn height_at_normal(&self, g: f64) -> f64 {
        self.height((self.power * log_hazard(&PANELS, g)).exp())
    }

    fn map_normals(&self, field: &mut [f64], scale: f64) {
        let panels = &*PANELS;
        field.iter_mut().for_each(|z| *z = scale * self.height((self.power * log_hazard(panels, *z)).exp()));
    }

    fn decreasing_from(&self) -> f64 {
        self.height((1.0 - self.power).max(0.0).powf(self.power))
    }

    fn highest_separation(&self) -> f64 {
        self.height(746f64.powf(self.power))
    }

    fn scale(&self, h: f64) -> f64 {
        self.survival(h)
    }

    fn window(&self, _h: f64) -> [f64; 2] {
        // The load grows by less than v to the power GROWTH/k.
        [0.0, FOLDINGS + 4.0 * GROWTH * self.power]
    }

    fn panels(&self, _h: f64, from: f64, to: f64) -> usize {
        whole_panels((to - from) / FOLDINGS_PER_PANEL)
    }

    /// x is singular at v = -u, u being that of the separation.
    fn breakpoints(&self, h: f64) -> Vec<f64> {
        vec![self.u(h).max(NEGLIGIBLE)]
    }

    fn variable(&self, h: f64, x: f64) -> f64 {
        let (t, u) = (self.t(h), self.u(h));
        if u > LOWER_END {
            u * (self.shape * (x * self.sd / t).ln_1p()).exp_m1()
        } else {
            (x * self.sd + t).max(0.0).powf(self.shape)
        }
    }

    fn relative_density(&self, h: f64, x: f64) -> f64 {
        let (v, t) = (self.variable(h, x), x * self.sd + self.t(h));
        if t > 0.0 { self.sd * self.shape * (self.u(h) + v) / t * (-v).exp() } else { 0.0 }
    }

    fn apply_density(&self, h: f64, nodes: &mut [f64], weights: &mut [f64]) {
        let (t, u) = (self.t(h), self.u(h));
        for (node, weight) in nodes.iter_mut().zip(weights) {
            *weight *= (-*node).exp();
            let x = if u > LOWER_END {
                t * (self.power * (*node / u).ln_1p()).exp_m1()
            } else {
                node.powf(self.power) - t
            };
            *node = x.max(0.0) / self.sd;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shape_of_a_skewness() {
        for shape in [0.6, 1.0, 2.0, 3.6, 5.0, 19.0] {
            let found = Weibull::with_skewness(Weibull::new(shape).unwrap().skewness()).unwrap();
            assert!((found.shape() / shape - 1.0).abs() < 1e-7, "{shape}: {}", found.shape());
        }
        let error = Weibull::with_skewness(-1.5).unwrap_err().to_string();
        assert!(error.starts_with("skewness -1.500; Weibull heights have -0."), "{error}");
    }

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
    fn shapes_out_of_range_are_refused() {
        let shapes = [0.49, 20.1, -1.0, 0.0, f64::NAN, f64::INFINITY];
        assert!(shapes.into_iter().all(|shape| Weibull::new(shape).is_err()));
    }
}
