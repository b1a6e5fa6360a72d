//! A function tabulated as piecewise polynomials.

use std::ops::Range;
use std::sync::LazyLock;

use super::lanes::{MOST, Mask, Real};

/// Bits of the mantissa that select a polynomial: 32 in each octave.
const BITS: u32 = 5;
const INTERVALS: usize = 1 << BITS;
const TERMS: usize = 8;
const OCTAVES: usize = 64;

/// A smooth positive function of x > 0 and its slope, with 32 polynomials per octave.
///
/// Accurate to rounding where the function is analytic within a complex disc around x of radius |x|: the truncation
/// error of eight terms is then 130^-8.
#[derive(Debug, PartialEq)]
pub struct Table {
    /// Where it begins and ends, powers of two at most 64 octaves apart.
    range: [f64; 2],
    /// Each at its [`place`], so that no index needs a check; places outside the range are unused.
    pieces: Box<[Piece; INTERVALS * OCTAVES]>,
}

/// The coefficients of a polynomial in the distance of the mantissa of x from the middle of its interval, the lowest power
/// first: a cache line.
type Piece = [[f64; 4]; TERMS / 4];

/// The exponent of `x` and the first bits of its mantissa, modulo the number of pieces.
#[inline(always)]
fn place(x: f64) -> usize {
    (x.to_bits() >> (f64::MANTISSA_DIGITS - 1 - BITS)) as usize % (INTERVALS * OCTAVES)
}

impl Table {
    /// A table of `value` from 2^start (included) to 2^end, which must be normal numbers, at most 64 octaves.
    pub fn new(octaves: Range<i32>, value: impl Fn(f64) -> f64) -> Self {
        assert!(octaves.len() <= OCTAVES, "{} octaves", octaves.len());
        let mut pieces = Box::new([[[0.0; 4]; TERMS / 4]; INTERVALS * OCTAVES]);
        for power in octaves.clone().map(|power| 2f64.powi(power)) {
            for k in 0..INTERVALS {
                let middle = 1.0 + (k as f64 + 0.5) / INTERVALS as f64;
                pieces[place(power * middle)] = piece(|mantissa| value(power * mantissa), middle);
            }
        }
        Self { range: [octaves.start, octaves.end].map(|power| 2f64.powi(power)), pieces }
    }

    /// The value at each `x`, and x times the slope there; `None` if one is outside the table.
    #[inline(always)]
    pub fn at<N: Real>(&self, x: N) -> Option<(N, N)> {
        let [from, to] = self.range;
        if !(x.splat(from).le(x) & x.lt(x.splat(to))).all() {
            return None;
        }
        let mut lanes = [from; MOST];
        x.store(&mut lanes);
        let (mut low, mut high) = ([&self.pieces[0][0]; MOST], [&self.pieces[0][1]; MOST]);
        for lane in 0..N::LANES {
            [low[lane], high[lane]] = self.pieces[place(lanes[lane])].each_ref();
        }
        let (low, high) = (x.columns(low), x.columns(high));
        let (mantissa, middle) = x.mantissa_and_middle::<BITS>();
        let r = mantissa - middle;
        let (mut value, mut slope) = (high[3], x.splat(0.0));
        for term in [high[2], high[1], high[0], low[3], low[2], low[1], low[0]] {
            slope = slope.mul_add(r, value);
            value = value.mul_add(r, term);
        }
        Some((value, slope * mantissa))
    }
}

/// T_k at the Chebyshev point j: the cosine of k times its angle.
static COSINES: LazyLock<[[f64; TERMS]; TERMS]> = LazyLock::new(|| {
    let angle = |j: usize| std::f64::consts::PI * (j as f64 + 0.5) / TERMS as f64;
    std::array::from_fn(|k| std::array::from_fn(|j| (k as f64 * angle(j)).cos()))
});

/// Interpolates a function of the mantissa at the Chebyshev points of the interval around `middle`.
fn piece(value: impl Fn(f64) -> f64, middle: f64) -> Piece {
    /// Half the width.
    const HALF: f64 = 0.5 / INTERVALS as f64;
    let cosines = &*COSINES;
    // Values differ from that in the middle by 1/64 at most: differences have smaller rounding errors.
    let centre = value(middle);
    let steps: [f64; TERMS] = std::array::from_fn(|j| value(middle + HALF * cosines[1][j]) - centre);
    let mut coefficients = [0.0; TERMS];
    // T_0 and T_1 as powers of the distance over half the width; each next one is 2 r T_k - T_(k-1).
    let (mut before, mut chebyshev) = ([0.0; TERMS], [0.0; TERMS]);
    chebyshev[0] = 1.0;
    for (k, cosines) in cosines.iter().enumerate() {
        let double = if k == 0 { 1.0 } else { 2.0 };
        let sum: f64 = steps.iter().zip(cosines).map(|(step, cosine)| step * cosine).sum();
        for (total, power) in coefficients.iter_mut().zip(chebyshev) {
            *total += double / TERMS as f64 * sum * power;
        }
        let mut next = before.map(|c: f64| -c);
        for j in 0..TERMS - 1 {
            next[j + 1] += double * chebyshev[j];
        }
        (before, chebyshev) = (chebyshev, next);
    }
    coefficients[0] += centre;
    let scaled = |j: usize| coefficients[j] / HALF.powi(j as i32);
    std::array::from_fn(|half| std::array::from_fn(|j| scaled(4 * half + j)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::lanes::{Work, run};

    #[test]
    fn a_power_and_its_slope() {
        let table = Table::new(-24..24, |x| x.powf(-0.7));
        for k in -100_000..100_000 {
            let x = (f64::from(k) * 1.66e-4).exp();
            let (value, slope) = table.at(x).unwrap();
            assert!((value / x.powf(-0.7) - 1.0).abs() < 2e-15);
            assert!((slope / value + 0.7).abs() < 1e-12);
        }
        for outside in [0.0, 1e-300, 1e-8, 1e8, 1e300, f64::INFINITY, f64::NAN, -1.0] {
            assert_eq!(table.at(outside), None);
        }
    }
    /// At each x; NaN if one of a register is outside.
    struct At<'a>(&'a Table, &'a [f64]);

    impl Work for At<'_> {
        type Output = Vec<[f64; 2]>;

        #[inline(always)]
        fn with<N: Real>(self, zero: N) -> Vec<[f64; 2]> {
            let mut found = Vec::new();
            for x in self.1.chunks_exact(N::LANES) {
                let (mut values, mut slopes) = ([f64::NAN; MOST], [f64::NAN; MOST]);
                if let Some((value, slope)) = self.0.at(zero.load(x)) {
                    value.store(&mut values);
                    slope.store(&mut slopes);
                }
                found.extend(values.into_iter().zip(slopes).map(<[f64; 2]>::from).take(N::LANES));
            }
            found
        }
    }

    /// Whatever the registers of the machine, each lane has the polynomial of its own interval.
    #[test]
    fn lanes_are_evaluated_one_by_one() {
        let table = Table::new(-8..8, |x| 1.0 + x.atan());
        let x: Vec<f64> = (0..8000).map(|k| (f64::from((k * 7919) % 8000 - 4000) * 1.3e-3).exp()).collect();
        for (&x, [value, slope]) in x.iter().zip(run(At(&table, &x))) {
            let (one, of_one) = table.at(x).unwrap();
            assert!((value / one - 1.0).abs() < 1e-15 && (slope - of_one).abs() < 1e-14, "{x}");
        }
        let mut outside = [1.0; MOST];
        outside[0] = 300.0;
        assert!(run(At(&table, &outside))[0][0].is_nan());
    }

    #[test]
    fn the_ends() {
        let table = Table::new(0..3, |x| 1.0 + x);
        let value = |x: f64| table.at(x).map(|(value, _)| value);
        assert!((value(1.0).unwrap() - 2.0).abs() < 1e-15);
        assert!((value(8f64.next_down()).unwrap() - 9.0).abs() < 4e-15);
        assert_eq!([value(1f64.next_down()), value(8.0)], [None; 2]);
    }
}
