//! Line offsets: lines of a scan, or parts of a stitched map, at wrong heights.

use super::NORMAL;
use crate::named_enum;
use crate::numeric::{median, parallel};
use crate::topography::rows::rows_from;
use crate::topography::{Moments, Rows, strips};

/// Points of a line that are compared with those of the next.
const SAMPLED: usize = 512;

/// Of coherent second differences between lines, the autocorrelation at the next line below which they are offsets: -2/3 for
/// independent offsets, -1/2 for a random walk, positive for a surface that the grid resolves.
const OFFSET_CORRELATION: f64 = -0.3;

/// Second differences beyond so many robust standard deviations are cut to them before their autocorrelation is taken: the walls of a few grooves
/// would decide it, and single offsets have a measure of their own.
const CUT: f64 = 5.0;

/// A single offset is at least this many times the standard deviation of all lines' medians (by their mean magnitude), and at least the scatter of
/// the points.
const LARGEST_OFFSET: f64 = 8.0;

/// A single offset is at least so many times the mean deviation of the steps of its own line from it. All points of a line share an offset: lines
/// of two measured maps reach 5 to 130. The wall of a groove is not straight to the pixel: at most 1.2 on two maps of steep walls.
const COHERENT: f64 = 2.5;

/// Offsets between neighbouring lines of a map.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LineOffsets {
    /// Share of the variance of second differences across lines along x that all points of a line, or of a third of it, have in
    /// common, beyond chance and only where it behaves as offsets do; the same for lines along y.
    pub shares: [f64; 2],
    /// Share of the variance of all heights that is in the mean heights of the lines along x and along y: what aligning them takes out.
    pub in_means: [f64; 2],
}

/// Aligning lines that takes out more of the variance than this takes out form or grooves, not offsets.
const MOST_ALIGNED: f64 = 1.0 / 3.0;

impl LineOffsets {
    /// Of lines along x and along y.
    pub fn new(map: &dyn Rows) -> Self {
        let [nx, ny] = map.points();
        // Lines along y are rows in memory.
        let strides = [nx, ny].map(|count| count.div_ceil(SAMPLED));
        let along_y = strips(map, 1, |strip| {
            let line =
                |k: isize| Some(strip.row(k)?.iter().copied().step_by(strides[1]).collect::<Vec<f64>>());
            let of = |k| Steps::of_parts(line(k - 1), line(k), line(k + 1));
            (0..strip.count as isize).map(of).collect::<Vec<_>>()
        });
        let sampled: Vec<Vec<f64>> = strips(map, 0, |strip| {
            let rows = (0..strip.count).filter(|k| (strip.first + k).is_multiple_of(strides[0]));
            rows.filter_map(|k| strip.row(k as isize).map(<[f64]>::to_vec)).collect::<Vec<_>>()
        })
        .concat();
        let line = |j: usize| (j < ny).then(|| sampled.iter().map(|row| row[j]).collect::<Vec<f64>>());
        let of = |j: usize| Steps::of_parts(j.checked_sub(1).and_then(line), line(j), line(j + 1));
        let along_x: Vec<[Steps; PARTS]> = parallel::map(ny, of);
        let largest = |lines: &[[Steps; PARTS]]| {
            let part = |part: usize| lines.iter().map(|line| line[part]).collect::<Vec<Steps>>();
            (0..PARTS).map(|index| share(&part(index))).fold(0.0, f64::max)
        };
        let moments = Moments::from_rows(map);
        let in_means = [Lines::X, Lines::Y].map(|lines| {
            let sums = lines.sums(map);
            let count = sums.iter().map(|line| line.count).sum::<usize>() as f64;
            let square = |line: &LineSum| line.count as f64 * (line.mean() - moments.mean).powi(2);
            sums.iter().map(square).sum::<f64>() / (count * moments.sq.powi(2))
        });
        Self { shares: [largest(&along_x), largest(&along_y.concat())], in_means }
    }

    /// The larger share.
    pub fn largest(&self) -> f64 {
        self.shares[0].max(self.shares[1])
    }

    /// The lines with the larger share.
    pub fn lines(&self) -> Lines {
        if self.shares[1] > self.shares[0] { Lines::Y } else { Lines::X }
    }

    /// Share of the variance of all heights that aligning these lines takes out.
    pub fn aligned_variance(&self) -> f64 {
        match self.lines() {
            Lines::X => self.in_means[0],
            Lines::Y => self.in_means[1],
        }
    }

    /// Whether aligning these lines takes out so little that they are offsets rather than form or grooves.
    pub fn can_be_aligned(&self) -> bool {
        self.aligned_variance() <= MOST_ALIGNED
    }
}

/// Medians over the points of a line, m.
#[derive(Debug, Clone, Copy, Default)]
struct Steps {
    /// Of the step to the next line, and the typical and the mean magnitude of its deviations from the median.
    first: Option<[f64; 3]>,
    /// The same of the height above the mean of both neighbouring lines; with the number of points.
    second: Option<([f64; 2], usize)>,
}

/// A line as a whole, and its thirds: an offset may end within a line.
const PARTS: usize = 4;

impl Steps {
    /// Of each part of a line.
    fn of_parts(before: Option<Vec<f64>>, line: Option<Vec<f64>>, after: Option<Vec<f64>>) -> [Self; PARTS] {
        let count = line.as_ref().map_or(0, Vec::len);
        let third = |k: usize| k * count / 3;
        let parts = [(0, count), (0, third(1)), (third(1), third(2)), (third(2), count)];
        parts.map(|(from, to)| {
            let [before, line, after] =
                [&before, &line, &after].map(|line| line.as_ref().map(|line| &line[from..to]));
            Self::between(before, line, after)
        })
    }

    fn between(before: Option<&[f64]>, line: Option<&[f64]>, after: Option<&[f64]>) -> Self {
        let (Some(line), Some(after)) = (line, after) else { return Self::default() };
        let first = spread(line.iter().zip(after).map(|(z, next)| next - z)).map(|(spread, _)| spread);
        let second = before.and_then(|before| {
            let others = before.iter().zip(after).map(|(before, after)| 0.5 * (before + after));
            spread(line.iter().zip(others).map(|(z, mean)| z - mean))
        });
        let second = second.map(|([middle, typical, _], count)| ([middle, typical], count));
        Self { first, second }
    }
}

/// Median, typical and mean magnitude of the deviations from it, and number of the values that are there; `None` where most are missing, as at
/// the ends of a round field of view: the median of a few points tells no offset of a line.
fn spread(values: impl ExactSizeIterator<Item = f64>) -> Option<([f64; 3], usize)> {
    /// Of a line or a part of it.
    const PRESENT: usize = 2;
    let length = values.len();
    let mut values: Vec<f64> = values.filter(|value| !value.is_nan()).collect();
    if PRESENT * values.len() < length {
        return None;
    }
    let middle = median(&mut values)?;
    values.iter_mut().for_each(|value| *value = (*value - middle).abs());
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    Some(([middle, typical(&mut values)?, mean], values.len()))
}

/// The median of magnitudes; their mean where most are zero, as on height steps.
fn typical(magnitudes: &mut [f64]) -> Option<f64> {
    let middle = median(magnitudes)?;
    Some(if middle > 0.0 { middle } else { magnitudes.iter().sum::<f64>() / magnitudes.len() as f64 })
}

/// The share of offsets in the variance of second differences across lines.
fn share(lines: &[Steps]) -> f64 {
    /// Variance of a median of n Gaussian values times n over their variance.
    const MEDIAN_VARIANCE: f64 = std::f64::consts::FRAC_PI_2;
    /// The share that chance reaches rarely, in means over all lines.
    const CHANCE: f64 = 3.0;
    let seconds: Vec<([f64; 2], usize)> = lines.iter().filter_map(|steps| steps.second).collect();
    let Some(mut scales) =
        (seconds.len() > 2).then(|| seconds.iter().map(|at| at.0[1]).collect::<Vec<f64>>())
    else {
        return 0.0;
    };
    let within = (NORMAL * typical(&mut scales).unwrap_or_default()).powi(2);
    let points = seconds.iter().map(|at| at.1).sum::<usize>() as f64 / seconds.len() as f64;
    let bends: Vec<f64> = seconds.iter().map(|at| at.0[0]).collect();
    let square = |pairs: &mut dyn Iterator<Item = (f64, f64)>, count: usize| {
        pairs.map(|(a, b)| a * b).sum::<f64>() / count as f64
    };
    let between = square(&mut bends.iter().map(|&bend| (bend, bend)), bends.len());
    if between <= 0.0 {
        return 0.0;
    }
    let mut sizes: Vec<f64> = bends.iter().map(|bend| bend.abs()).collect();
    let most = CUT * NORMAL * typical(&mut sizes).unwrap_or_default();
    let cut: Vec<f64> = bends.iter().map(|bend| bend.clamp(-most, most)).collect();
    let next = square(&mut cut.windows(2).map(|pair| (pair[0], pair[1])), cut.len() - 1);
    let all = square(&mut cut.iter().map(|&bend| (bend, bend)), cut.len());
    if next > OFFSET_CORRELATION * all && !has_single_offset(lines) {
        return 0.0;
    }
    (between / (between + within) - CHANCE * MEDIAN_VARIANCE / points).max(0.0)
}

/// Whether one line, or one part of a stitched map, is far off.
fn has_single_offset(lines: &[Steps]) -> bool {
    /// The standard deviation of a Gaussian variable over the mean of its magnitude.
    const MEAN_NORMAL: f64 = 1.2533;
    /// A step that is an offset differs from the mean of the steps beside it by at least this share of itself. On the flank of a
    /// high summit the next steps are nearly as large: no offset was found on 3,000 maps of exponential heights.
    const ALONE: f64 = 0.75;
    let firsts: Vec<[f64; 3]> = lines.iter().filter_map(|steps| steps.first).collect();
    let mut medians: Vec<f64> = firsts.iter().map(|at| at[0]).collect();
    let mut scales: Vec<f64> = firsts.iter().map(|at| at[1]).collect();
    let (Some(middle), Some(scatter)) = (median(&mut medians), typical(&mut scales)) else { return false };
    let offsets: Vec<f64> = firsts.iter().map(|at| at[0] - middle).collect();
    // Of the mean, because most medians are equal on height steps: a few large ones hardly raise it.
    let usual = MEAN_NORMAL * offsets.iter().map(|offset| offset.abs()).sum::<f64>() / offsets.len() as f64;
    let is_alone = |k: usize| {
        let beside = [k.checked_sub(1), Some(k + 1)];
        let beside = beside.into_iter().flatten().filter_map(|k| offsets.get(k));
        let mean = beside.clone().sum::<f64>() / beside.count().max(1) as f64;
        (offsets[k] - mean).abs() >= ALONE * offsets[k].abs()
    };
    (0..offsets.len()).any(|k| {
        let offset = offsets[k].abs();
        let is_shared = offset > COHERENT * firsts[k][2];
        offset > LARGEST_OFFSET * usual && offset > NORMAL * scatter && is_shared && is_alone(k)
    })
}

named_enum! {
    /// The lines of a map along one axis.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(feature = "serde", derive(serde::Deserialize))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    #[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
    pub enum Lines {
        /// Lines of constant y.
        X = "x",
        /// Lines of constant x.
        Y = "y",
    }
}

impl Lines {
    /// The sum of the present heights of each line of `map`.
    fn sums(self, map: &dyn Rows) -> Vec<LineSum> {
        let sums = strips(map, 0, |strip| {
            let rows = (0..strip.count as isize).filter_map(|k| strip.row(k));
            match self {
                Self::Y => rows.map(|row| LineSum::default().plus(row)).collect(),
                Self::X => rows.fold(vec![LineSum::default(); map.points()[1]], |mut sums, row| {
                    sums.iter_mut().zip(row).for_each(|(sum, z)| *sum = sum.plus(&[*z]));
                    sums
                }),
            }
        });
        match self {
            Self::Y => sums.concat(),
            Self::X => sums.into_iter().fold(Vec::new(), |mut all: Vec<LineSum>, part| {
                all.resize(part.len(), LineSum::default());
                all.iter_mut().zip(part).for_each(|(sum, part)| {
                    sum.total += part.total;
                    sum.count += part.count;
                });
                all
            }),
        }
    }
}

/// Sum of the heights (m) of a line, and the number of points that are there.
#[derive(Debug, Clone, Copy, Default)]
struct LineSum {
    total: f64,
    count: usize,
}

impl LineSum {
    fn plus(self, heights: &[f64]) -> Self {
        heights
            .iter()
            .filter(|z| !z.is_nan())
            .fold(self, |sum, z| Self { total: sum.total + z, count: sum.count + 1 })
    }

    /// The mean height, m; zero where all points are missing. A median would jump from line to line on a smooth surface.
    fn mean(&self) -> f64 {
        if self.count == 0 { 0.0 } else { self.total / self.count as f64 }
    }
}

/// A map whose lines along one axis all have the mean height zero.
pub struct AlignedLines<'a> {
    map: &'a dyn Rows,
    lines: Lines,
    means: Vec<f64>,
}

impl<'a> AlignedLines<'a> {
    /// The lines of `map` along an axis, aligned.
    pub fn new(map: &'a dyn Rows, lines: Lines) -> Self {
        Self { map, lines, means: lines.sums(map).iter().map(LineSum::mean).collect() }
    }
}

impl Rows for AlignedLines<'_> {
    rows_from!(map: points pixel precision boundary offset progress is_whole);

    fn read(&self, ix: usize, row: &mut [f64]) {
        self.map.read(ix, row);
        match self.lines {
            Lines::Y => row.iter_mut().for_each(|z| *z -= self.means[ix]),
            Lines::X => row.iter_mut().zip(&self.means).for_each(|(z, mean)| *z -= mean),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topography::HeightMap;
    use crate::topography::generate::gaussian;
    use crate::topography::spectrum::{Lay, Spectrum, SpectrumShape};
    use rand::{RngExt, SeedableRng};

    const POINTS: [usize; 2] = [240, 200];
    const PASSED: f64 = 0.01;

    fn surface(cut_off: f64, elongation: f64) -> Vec<f64> {
        let shape = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 24.0, cut_off };
        let lay = Lay { elongation, angle: 0.0 };
        gaussian(&Spectrum::new(shape, lay).unwrap().on_grid(POINTS, [1.0; 2]), 1.0, [3; 32])
    }

    fn shares(heights: Vec<f64>) -> [f64; 2] {
        LineOffsets::new(&HeightMap::new(POINTS, [1.0; 2], heights, 0.0).unwrap()).shares
    }

    fn with(heights: &[f64], offset: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        heights.iter().enumerate().map(|(k, z)| z + offset(k / POINTS[1], k % POINTS[1])).collect()
    }

    #[test]
    fn surfaces_without_faults_have_no_offsets() {
        for (cut_off, elongation) in [(2.0, 1.0), (4.0, 1.0), (8.0, 1.0), (4.0, 8.0)] {
            let found = shares(surface(cut_off, elongation));
            assert!(found.iter().all(|share| *share < PASSED), "{cut_off} {elongation}: {found:?}");
        }
        // A steep ridge, whose flanks the grid resolves.
        let ridge = with(&surface(4.0, 1.0), |i, _| 8.0 * (-((i as f64 - 100.0) / 4.0).powi(2)).exp());
        assert!(shares(ridge).iter().all(|share| *share < PASSED));
        // Grooves along y that the grid resolves.
        let grooves = with(&surface(4.0, 1.0), |i, _| 3.0 * (i as f64 / 3.0).sin());
        assert!(shares(grooves).iter().all(|share| *share < PASSED));
        // Grooves of steep walls, which wander by a pixel or two along them: the heights of whole lines jump at each wall.
        let wander = surface(24.0, 1.0);
        let steep = with(&surface(4.0, 1.0), |i, j| {
            let place = i as f64 + 1.5 * wander[j];
            if (place / 16.0).rem_euclid(2.0) < 1.0 { 0.0 } else { 30.0 }
        });
        let found = LineOffsets::new(&HeightMap::new(POINTS, [1.0; 2], steep, 0.0).unwrap());
        assert!(found.largest() < PASSED, "{found:?}");
        assert!(found.in_means[1] > 0.8 && found.in_means[0] < 0.1, "{found:?}");
    }

    /// Points at the rim of a round field of view are often wrong: lines that only touch it hold few others.
    #[test]
    fn the_ends_of_a_round_field_have_no_offsets() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(2);
        let base = surface(4.0, 1.0);
        let mut edge = |i: usize, j: usize| {
            let from_middle = (i as f64 - 120.0).hypot(j as f64 - 100.0);
            let wrong = 20.0 * rng.random_range(-1.0..1.0);
            if from_middle > 98.0 {
                f64::NAN
            } else if from_middle > 96.0 {
                wrong
            } else {
                0.0
            }
        };
        let round = base.iter().enumerate().map(|(k, z)| z + edge(k / POINTS[1], k % POINTS[1])).collect();
        assert!(shares(round).iter().all(|share| *share < PASSED));
    }

    #[test]
    fn offsets_are_found_along_the_axis_they_are_on() {
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let random: Vec<f64> = (0..240).map(|_| rng.random_range(-0.5..0.5)).collect();
        for cut_off in [4.0, 8.0] {
            let base = surface(cut_off, 1.0);
            let every = shares(with(&base, |_, j| random[j]));
            assert!(every[0] > 0.3 && every[1] < PASSED, "{every:?}");
            let stitched = shares(with(&base, |i, _| if i < 100 { 0.0 } else { 1.0 }));
            assert!(stitched[1] > PASSED && stitched[0] < PASSED, "{stitched:?}");
            // Eight lines at a wrong height over half of their length.
            let halves = shares(with(&base, |i, j| if i % 30 == 7 && j < 100 { 2.0 } else { 0.0 }));
            assert!(halves[1] > PASSED && halves[0] < PASSED, "{halves:?}");
            let few = shares(with(&base, |i, _| if [20, 77, 140].contains(&i) { 1.0 } else { 0.0 }));
            assert!(few[1] > PASSED && few[0] < PASSED, "{few:?}");
        }
    }

    #[test]
    fn aligned_lines_have_no_offsets_left() {
        let base = surface(4.0, 1.0);
        for lines in [Lines::X, Lines::Y] {
            let offset = |i: usize, j: usize| {
                if lines == Lines::X { ((j * j) % 7) as f64 } else { ((i * i) % 7) as f64 }
            };
            let map = HeightMap::new(POINTS, [1.0; 2], with(&base, offset), 0.0).unwrap();
            let found = LineOffsets::new(&map);
            assert_eq!(found.lines(), lines);
            // Offsets of 1.4 times the roughness: two thirds of the variance, of which nobody can tell whether they are form.
            assert!(found.aligned_variance() > 0.6 && !found.can_be_aligned(), "{found:?}");
            let aligned = HeightMap::from_rows(&AlignedLines::new(&map, lines));
            assert!(LineOffsets::new(&aligned).largest() < PASSED);
            // The surface itself stays, but for the means of its lines.
            let off = aligned.heights().iter().zip(&base).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
            assert!((off / 48_000.0).sqrt() < 0.4, "{off}");
        }
    }
}
