//! Fitness checks: whether a height map may carry a verdict on contact models.
//!
//! Each check compares one number with a threshold. Thresholds were set on ten measured maps, of which two have no fault and
//! two none but their height steps, on random surfaces with and without heavy tails, and on the same with faults planted.

mod growth;
mod lines;
mod spikes;

pub use growth::{CurvatureGrowth, step_over_drop};
pub use lines::{AlignedLines, LineOffsets, Lines};
pub use spikes::{Spikes, Without};

use super::generate::FEWEST_LENGTHS;
use super::theory::Expected;
use super::{CorrelationLengths, Level, Levelled, Moments, RoughnessParameters, Rows, SHARED};
use crate::named_enum;

/// The standard deviation of a Gaussian variable over the median of its magnitude.
const NORMAL: f64 = 1.4826;

named_enum! {
    /// What is checked.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Check {
        /// Points that have one height exactly: of a saturated instrument, or missing ones that were written as a number. Only on maps that have
        /// them.
        EqualHeights = "equal-heights",
        /// Points that the instrument got wrong.
        Spikes = "spikes",
        /// Form that levelling leaves.
        Form = "form",
        /// A lay at an angle to the grid, or too strong for spheres.
        Lay = "lay",
        /// Offsets between lines of a scan or between stitched parts.
        Lines = "lines",
        /// Heights quantised by the instrument.
        Steps = "steps",
        /// Summits that the pixel does not resolve.
        CoarsePixel = "coarse-pixel",
        /// Pixels so fine that noise makes the summits.
        FinePixel = "fine-pixel",
        /// Summits as sharp as the tip of the instrument.
        Tip = "tip",
        /// Waves as long as the map.
        LongWaves = "long-waves",
        /// Slopes beyond the theory of small slopes.
        Slope = "slope",
    }
}

named_enum! {
    /// The number that a check compares with its threshold.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Measure {
        /// Share of the points that have one height exactly, far more than have those next to it.
        SharedHeight = "shared-height-share",
        /// Number of spikes.
        Spikes = "spikes",
        /// Share of the variance of heights that the next higher polynomial explains.
        FormShare = "form-share-of-variance",
        /// Magnitude of the correlation of slopes along x and along y.
        SlopeCorrelation = "slope-correlation",
        /// Texture aspect ratio Str.
        AspectRatio = "str",
        /// Share of line offsets in the variance of second differences across lines.
        LineOffsets = "line-offset-share-of-variance",
        /// Height step, or what a filter leaves of it, over the median drop from a summit to its neighbours.
        StepOverDrop = "step-over-drop",
        /// log2 of the ratio of the r.m.s. curvatures at S filters of two and of four pixels.
        CurvatureGrowth = "curvature-growth",
        /// The same, held against the growth on any self-affine surface.
        NoiseGrowth = "curvature-growth",
        /// By how much it exceeds that at S filters of four and of eight pixels.
        GrowthRise = "curvature-growth-rise",
        /// Density of summits over that of a Gaussian surface with the same differences between neighbours.
        DensityOverTheory = "density-over-theory",
        /// The same of their mean curvature.
        CurvatureOverTheory = "curvature-over-theory",
        /// Mean radius of the summits, of all or of the highest, over that of the tip.
        RadiusOverTip = "summit-radius-over-tip",
        /// Share of points higher than the tip can have traced.
        Untraced = "untraced-share",
        /// Correlation length of the heights over the side of the map: geometric mean over both axes.
        LengthOverSide = "correlation-length-over-side",
        /// Root mean square slope.
        Slope = "rms-slope",
        /// The same, held against the smallest that a surface can have.
        LeastSlope = "rms-slope",
        /// Nominal area, m^2.
        NominalArea = "nominal-area-m2",
    }
}

impl Measure {
    const fn limit(self) -> Limit {
        use Limit::{AtLeast, AtMost, Factor};
        match self {
            // One in a thousand; a height stands out by ten times as many points as those next to it have.
            Self::SharedHeight => AtMost(SHARED),
            // One is enough to carry the load.
            Self::Spikes => AtMost(0.0),
            // sigma is then 5 % too large. Random surfaces with a correlation length of 0.04 of the side have up to 0.02, of 0.12
            // up to 0.12.
            Self::FormShare => AtMost(0.1),
            // There are twice as many five-point summits as with the same lay along an axis.
            Self::SlopeCorrelation => AtMost(0.6),
            // Ridges ten times as long as wide.
            Self::AspectRatio => AtLeast(0.1),
            // Maps without faults stay below 0.002; offsets of a twentieth of Sq on every line reach 0.06 to 0.9.
            Self::LineOffsets => AtMost(0.01),
            // Levelled, two of three maps with a larger step have summits made by the step.
            Self::StepOverDrop => AtMost(1.0 / 3.0),
            // A filter of half the wavelength finds curvatures 1.4 times as large. Surfaces whose shortest waves are eight
            // pixels long have 0.1, those of four pixels 0.4, those that the pixel cuts off 1 and more.
            Self::CurvatureGrowth => AtMost(0.5),
            // Self-affine surfaces of Hurst exponents from 0.2 stay below; white noise has 2.3.
            Self::NoiseGrowth => AtMost(1.5),
            // Where the resolution cuts the roughness off, curvatures grow less and less towards the pixel: 288 Gaussian
            // surfaces rise by at most 0.007, sound measured maps by -0.15 and -0.12; noise of 0.05 Sq by 0.2 to 0.4.
            Self::GrowthRise => AtMost(0.1),
            // Resolved random surfaces of exponential heights have 0.71 to 1.6 of theory, of skewness -1.5 and kurtosis 7 0.41 to
            // 0.97; measured maps with pits, terraces or grooves 0.2 to 0.5.
            Self::DensityOverTheory | Self::CurvatureOverTheory => Factor(2.0),
            // Traced radii are larger by the tip's: a tip that is a fifth blunter than it is said to be then changes radii by a tenth.
            Self::RadiusOverTip => AtLeast(2.0),
            // Noise and spikes stand out of what a tip can trace, and so do all summits if it is said to be blunter than it is.
            Self::Untraced => AtMost(0.01),
            // 64 independent patches: from 8 correlation lengths on, model-based intervals hold (report `coverage-of-small-maps`).
            Self::LengthOverSide => AtMost(1.0 / FEWEST_LENGTHS),
            // Terms of second order in the slope, which contact mechanics of half-spaces leaves out, reach a tenth.
            Self::Slope => AtMost(LARGEST_SLOPE),
            // A tenth of that of polished optics.
            Self::LeastSlope => AtLeast(1e-5),
            // No instrument maps a larger one in points that resolve roughness.
            Self::NominalArea => AtMost(1.0),
        }
    }
}

/// The largest r.m.s. slope that passes.
pub const LARGEST_SLOPE: f64 = 0.3;

/// The largest r.m.s. slope of steep flanks: beyond it, heights and pixels are in different units.
pub const LARGEST_FLANKS: f64 = 10.0;

/// The values that pass.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Limit {
    AtMost(f64),
    AtLeast(f64),
    /// From one over it to it.
    Factor(f64),
}

/// The result of a check: that of its measures which is worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finding {
    /// The check.
    pub check: Check,
    /// What was measured.
    pub measure: Measure,
    /// The number.
    pub value: f64,
}

impl Finding {
    /// The threshold that the value is held against: at most, or at least, this value passes.
    pub fn threshold(&self) -> f64 {
        match self.measure.limit() {
            Limit::AtMost(limit) | Limit::AtLeast(limit) => limit,
            Limit::Factor(limit) => {
                if self.value < 1.0 {
                    limit.recip()
                } else {
                    limit
                }
            }
        }
    }

    /// Whether larger values are better.
    pub fn is_least(&self) -> bool {
        match self.measure.limit() {
            Limit::AtMost(_) => false,
            Limit::AtLeast(_) => true,
            Limit::Factor(_) => self.value < 1.0,
        }
    }

    /// Whether the map is fit in this respect.
    pub fn has_passed(&self) -> bool {
        if self.is_least() { self.value >= self.threshold() } else { self.value <= self.threshold() }
    }

    /// Whether it failed so that no verdict may rest on the map. A short-wavelength cut-off that decides is found by varying
    /// it; slopes limit both models alike, unless they are so steep that neither holds; a lay along
    /// an axis makes ridges of summits, but finds those that are there.
    pub fn is_blocking(&self) -> bool {
        /// The largest r.m.s. slope at which contact mechanics of small slopes says anything.
        const STEEP: f64 = 1.0;
        let can_decide = match self.measure {
            Measure::CurvatureGrowth
            | Measure::DensityOverTheory
            | Measure::CurvatureOverTheory
            | Measure::RadiusOverTip
            | Measure::Untraced
            | Measure::AspectRatio => false,
            Measure::Slope => self.value > STEEP,
            _ => true,
        };
        can_decide && !self.has_passed()
    }

    /// Whether it says that heights and pixel size are in different units, which no preparation remedies.
    pub fn is_of_units(&self) -> bool {
        let is_other = match self.measure {
            Measure::LeastSlope | Measure::NominalArea => true,
            Measure::Slope => self.value > LARGEST_FLANKS,
            _ => false,
        };
        is_other && !self.has_passed()
    }

    /// How far the value is on the wrong side of its threshold; above 1 where it failed.
    pub fn excess(&self) -> f64 {
        let (value, threshold) = (self.value, self.threshold());
        if threshold == 0.0 {
            value
        } else if self.is_least() {
            threshold / value
        } else {
            // A value may be negative, a threshold not.
            value / threshold
        }
    }

    /// The worst one of each check, in order.
    pub fn worst_of_each(findings: &[Self]) -> Vec<Self> {
        let of_check = findings.chunk_by(|a, b| a.check == b.check);
        of_check
            .filter_map(|of| of.iter().copied().max_by(|a, b| a.excess().total_cmp(&b.excess())))
            .collect()
    }
}

/// What the checks of a map rest on, besides the map as it is analysed: levelled and filtered.
pub struct Examined<'a> {
    /// The map, levelled and filtered.
    pub map: &'a dyn Rows,
    /// Indices of the points of spikes in it, ascending: they tell nothing of its form.
    pub spikes: &'a [usize],
    /// Its parameters.
    pub roughness: &'a RoughnessParameters,
    /// The form that was removed.
    pub level: Level,
    /// Density (1/m^2) and mean curvature (1/m) of the summits.
    pub found: [f64; 2],
    /// What theory expects of them; `None` where other summits than five-point ones were searched.
    pub expected: Option<Expected>,
    /// Correlation lengths of the heights, where they are known.
    pub correlation: Option<CorrelationLengths>,
    /// Texture aspect ratio Str, where it is known.
    pub aspect: Option<f64>,
}

/// What only a measured map has.
pub struct Measured {
    /// Share of the points that have one height exactly, where one stands out by them.
    pub shared_height: Option<f64>,
    /// Number of spikes in the map as read.
    pub spikes: usize,
    /// Offsets between its lines.
    pub offsets: LineOffsets,
    /// The step over the median drop, see [`step_over_drop`].
    pub step_over_drop: Option<f64>,
    /// The radius of the summits over that of the tip, and the share of points that the tip cannot have traced; where a tip is given.
    pub tip: Option<[f64; 2]>,
}

impl Examined<'_> {
    /// Every measure of every check of a map, check by check; those of an instrument's faults only where it was `measured`.
    pub fn findings(&self, measured: Option<&Measured>) -> Vec<Finding> {
        let growth = CurvatureGrowth::new(&Without { map: self.map, points: self.spikes });
        let at_pixel = growth.map(|growth| growth.at_pixel);
        let of_check = |check, measures: &[(Measure, Option<f64>)]| {
            let of =
                |&(measure, value): &(Measure, Option<f64>)| Some(Finding { check, measure, value: value? });
            let known = measures.iter().filter_map(of).filter(|finding| !finding.value.is_nan());
            known.collect::<Vec<Finding>>()
        };
        let mut all = Vec::new();
        if let Some(measured) = measured {
            all.extend(of_check(Check::EqualHeights, &[(Measure::SharedHeight, measured.shared_height)]));
            all.extend(of_check(Check::Spikes, &[(Measure::Spikes, Some(measured.spikes as f64))]));
            all.extend(of_check(Check::Form, &[(Measure::FormShare, self.form_share())]));
        }
        // Eight neighbours find far fewer false summits on ridges, but still several times too many.
        let slopes = Some(self.roughness.drops.slope_correlation());
        all.extend(of_check(
            Check::Lay,
            &[(Measure::SlopeCorrelation, slopes), (Measure::AspectRatio, self.aspect)],
        ));
        if let Some(measured) = measured {
            let offsets = measured.offsets.largest();
            all.extend(of_check(Check::Lines, &[(Measure::LineOffsets, Some(offsets))]));
            let step = Some(measured.step_over_drop.unwrap_or_default());
            all.extend(of_check(Check::Steps, &[(Measure::StepOverDrop, step)]));
        }
        let [density, curvature] = match &self.expected {
            Some(expected) => {
                [Some(self.found[0] / expected.density), Some(self.found[1] / expected.curvature)]
            }
            None => [None; 2],
        };
        all.extend(of_check(
            Check::CoarsePixel,
            &[
                (Measure::CurvatureGrowth, at_pixel),
                (Measure::DensityOverTheory, density),
                (Measure::CurvatureOverTheory, curvature),
            ],
        ));
        if measured.is_some() {
            let rise = growth.and_then(|growth| growth.rise());
            all.extend(of_check(
                Check::FinePixel,
                &[(Measure::NoiseGrowth, at_pixel), (Measure::GrowthRise, rise)],
            ));
            let tip = |k: usize| measured.and_then(|measured| measured.tip).map(|tip| tip[k]);
            all.extend(of_check(
                Check::Tip,
                &[(Measure::RadiusOverTip, tip(0)), (Measure::Untraced, tip(1))],
            ));
            let length = self.correlation.map(|correlation| self.length_over_side(correlation));
            all.extend(of_check(Check::LongWaves, &[(Measure::LengthOverSide, length)]));
        }
        all.extend(self.slope(measured.is_some()));
        all
    }

    /// The check of slopes; of a map that `was_measured` too small ones and a large area too, which other units explain.
    fn slope(&self, was_measured: bool) -> Option<Finding> {
        let finding = |measure, value| Finding { check: Check::Slope, measure, value };
        let slope = self.roughness.rms_slope();
        let sides = [0, 1].map(|axis| self.map.points()[axis] as f64 * self.map.pixel()[axis]);
        let units = [finding(Measure::NominalArea, sides[0] * sides[1]), finding(Measure::LeastSlope, slope)];
        let failed = units.into_iter().find(|finding| was_measured && !finding.has_passed());
        failed.or_else(|| (!slope.is_nan()).then(|| finding(Measure::Slope, slope)))
    }

    /// Share of the variance that the next higher polynomial explains.
    fn form_share(&self) -> Option<f64> {
        // A mean explains no variance about it.
        let next = if self.level == Level::None { Level::Plane } else { self.level.next()? };
        let map = &Without { map: self.map, points: self.spikes };
        let rest = Moments::from_rows(&Levelled { map, form: next.form(map).ok()? });
        Some(1.0 - (rest.sq / Moments::from_rows(map).sq).powi(2))
    }

    /// Correlation length over side; a correlation that does not decay counts as the side.
    fn length_over_side(&self, correlation: CorrelationLengths) -> f64 {
        let [x, y] = [0, 1].map(|axis| {
            let side = self.map.points()[axis] as f64 * self.map.pixel()[axis];
            (correlation.lengths[axis] / side).min(1.0)
        });
        (x * y).sqrt()
    }
}
