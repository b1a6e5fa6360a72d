//! Height densities in about 32 digits, one table: a distribution is covered by an entry here.

use std::sync::LazyLock;

use super::ends;
use crate::wide::{PI, Wide};
use asperity::Heights;

/// The density of a height distribution of mean 0 and standard deviation 1, with one peak.
#[derive(Debug)]
pub struct Density {
    pub heights: Heights,
    /// ln f(z) within the support.
    pub ln: fn(Wide) -> Wide,
    /// -d ln f/dz within the support.
    pub steepness: fn(Wide) -> Wide,
    /// Smallest and largest height, where there is one.
    pub support: fn() -> [Option<Wide>; 2],
    /// The height at the peak.
    pub mode: fn() -> Wide,
}

/// All densities; groups of cases draw from them.
pub static COVERED: [Density; 2] = [
    // exp(-z^2/2)/(2 pi)^.5
    Density {
        heights: Heights::GAUSSIAN,
        ln: |z| {
            static LN_TWO_PI: LazyLock<Wide> = LazyLock::new(|| (PI * 2.0).ln());
            (z * z + *LN_TWO_PI) * -0.5
        },
        steepness: |z| z,
        support: || [None, None],
        mode: || Wide::ZERO,
    },
    // exp(-(1 + z)) from z = -1 on
    Density {
        heights: Heights::EXPONENTIAL,
        ln: |z| -(z + 1.0),
        steepness: |_| Wide::ONE,
        support: || [Some(Wide::new(-1.0)), None],
        mode: || Wide::new(-1.0),
    },
];

/// The density of these heights, where it is covered.
pub fn density_of(heights: &Heights) -> Option<&'static Density> {
    COVERED.iter().find(|density| density.heights == *heights)
}

/// A density above a separation, over its largest value there.
#[derive(Debug)]
pub struct Window {
    density: &'static Density,
    separation: Wide,
    /// ln of the largest value.
    peak: Wide,
    /// Where the density counts, as x = z - h.
    pub start: Wide,
    pub end: Wide,
    /// Heights of a step of the density at either end of its support, if it is within.
    pub steps: [Option<Wide>; 2],
    /// Places that part the window by how the density changes.
    pub cuts: Vec<Wide>,
}

/// E-foldings of the density that count: exp(-76) = 1e-33.
const FOLDINGS: f64 = 76.0;
/// E-foldings at which the window is cut: 1, 3, 6 and 9 standard deviations from the peak of Gaussian heights.
const CUTS: [f64; 4] = [0.5, 4.5, 18.0, 40.5];

impl Window {
    /// Of the heights above the separation `h`; `None` where there are none.
    pub fn above(h: f64, density: &'static Density) -> Option<Self> {
        let separation = Wide::new(h);
        let [low, high] = (density.support)().map(|end| end.map(|z| z - separation));
        if high.is_some_and(|high| high <= Wide::ZERO) {
            return None;
        }
        let lowest = low.filter(|low| *low > Wide::ZERO).unwrap_or(Wide::ZERO);
        let top = ((density.mode)() - separation).max(lowest);
        let peak = (density.ln)(separation + top);
        let mut window =
            Self { density, separation, peak, start: lowest, end: top, steps: [None; 2], cuts: vec![top] };
        let foldings = |x: Wide| window.foldings(x).hi();
        let right_of = |folds: f64| {
            let mut reach = Wide::new(1e-3);
            while foldings(top + reach) < folds && high.is_none_or(|high| top + reach < high) {
                reach *= 2.0;
            }
            let far = high.map_or(top + reach, |high| high.min(top + reach));
            place(|x| foldings(x) < folds, top, far)
        };
        let left_of = |folds: f64| place(|x| foldings(x) < folds, top, lowest);
        let cuts: Vec<Wide> = CUTS.into_iter().flat_map(|folds| [left_of(folds), right_of(folds)]).collect();
        let [start, end] = [left_of(FOLDINGS), right_of(FOLDINGS)];
        (window.start, window.end) = (start, end);
        window.cuts.extend(cuts);
        window.steps =
            [low.filter(|low| *low > Wide::ZERO && *low >= start), high.filter(|high| *high <= end)];
        Some(window)
    }

    /// ln of the largest value over the density at x.
    fn foldings(&self, x: Wide) -> Wide {
        self.peak - (self.density.ln)(self.separation + x)
    }

    pub fn relative(&self, x: Wide) -> Wide {
        (-self.foldings(x)).exp()
    }

    /// -d ln f/dx.
    pub fn steepness(&self, x: Wide) -> Wide {
        (self.density.steepness)(self.separation + x)
    }

    /// The square root of the largest value.
    pub fn root_of_peak(&self) -> Wide {
        (self.peak * 0.5).exp()
    }
}

/// Where `holds` ends on the way from `from`, where it holds, to `to`; `to` where it holds there too.
fn place(holds: impl Fn(Wide) -> bool, from: Wide, to: Wide) -> Wide {
    if holds(to) || from == to { to } else { ends(holds, from, to, 60)[1] }
}
