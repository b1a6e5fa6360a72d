//! A function tabulated as piecewise polynomials.

use std::ops::Range;

use super::lanes::Real;

const INTERVALS: usize = 32;
const TERMS: usize = 8;
const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// A smooth positive function of x > 0 and its slope, with 32 polynomials per octave.
///
/// Accurate to rounding where the function is analytic within a complex disc around x of radius |x|: the truncation
/// error of eight terms is then 130^-8.
#[derive(Debug, PartialEq)]
pub struct Table {
    /// Exponent and leading mantissa bits of the start of the table.
    first: u64,
    pieces: Vec<Piece>,
}

/// Middle, inverse half width, and coefficients.
#[derive(Debug, PartialEq)]
struct Piece([f64; TERMS + 2]);

/// The index of the interval of `x`: exponent and leading mantissa bits.
#[inline(always)]
fn place(x: f64) -> u64 {
    x.to_bits() >> (MANTISSA_BITS - INTERVALS.ilog2())
}

impl Table {
    /// A table of `value` from 2^start (included) to 2^end, which must be normal numbers.
    pub fn new(octaves: Range<i32>, value: impl Fn(f64) -> f64) -> Self {
        let octave = |power: i32| (0..INTERVALS).map(move |k| (power, k));
        let piece = |(power, k): (i32, usize)| {
            let width = 2f64.powi(power) / INTERVALS as f64;
            Piece::through(&value, 2f64.powi(power) + (k as f64 + 0.5) * width, 0.5 * width)
        };
        Self { first: place(2f64.powi(octaves.start)), pieces: octaves.flat_map(octave).map(piece).collect() }
    }

    /// The value at each `x`, and x times the slope there; `None` if one is outside the table.
    #[inline(always)]
    pub fn at<N: Real>(&self, x: N) -> Option<(N, N)> {
        let mut is_inside = true;
        let numbers: [N; TERMS + 2] = x.each(|x| {
            let piece =
                usize::try_from(place(x).wrapping_sub(self.first)).ok().and_then(|k| self.pieces.get(k));
            is_inside &= piece.is_some();
            piece.map_or([0.0; TERMS + 2], |piece| piece.0)
        });
        if !is_inside {
            return None;
        }
        let [middle, inverse, coefficients @ ..] = numbers;
        let r = (x - middle) * inverse;
        let (mut value, mut slope) = (coefficients[TERMS - 1], x.splat(0.0));
        for &term in coefficients[..TERMS - 1].iter().rev() {
            slope = slope.mul_add(r, value);
            value = value.mul_add(r, term);
        }
        Some((value, slope * x * inverse))
    }
}

impl Piece {
    /// Interpolates at the Chebyshev points of middle +- half.
    fn through(value: &impl Fn(f64) -> f64, middle: f64, half: f64) -> Self {
        use std::f64::consts::PI;
        let angle = |j: usize| PI * (j as f64 + 0.5) / TERMS as f64;
        // Values differ from that in the middle by 1/64 at most: differences have smaller rounding errors.
        let centre = value(middle);
        let steps: [f64; TERMS] = std::array::from_fn(|j| value(middle + half * angle(j).cos()) - centre);
        let mut coefficients = [0.0; TERMS];
        // T_0 and T_1 as powers of r; each next one is 2 r T_k - T_(k-1).
        let (mut before, mut chebyshev) = ([0.0; TERMS], [0.0; TERMS]);
        chebyshev[0] = 1.0;
        for k in 0..TERMS {
            let double = if k == 0 { 1.0 } else { 2.0 };
            let sum: f64 = (0..TERMS).map(|j| steps[j] * (k as f64 * angle(j)).cos()).sum();
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
        let mut numbers = [0.0; TERMS + 2];
        [numbers[0], numbers[1]] = [middle, half.recip()];
        numbers[2..].copy_from_slice(&coefficients);
        Self(numbers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    #[test]
    fn the_ends() {
        let table = Table::new(0..3, |x| 1.0 + x);
        let value = |x: f64| table.at(x).map(|(value, _)| value);
        assert!((value(1.0).unwrap() - 2.0).abs() < 1e-15);
        assert!((value(8f64.next_down()).unwrap() - 9.0).abs() < 4e-15);
        assert_eq!([value(1f64.next_down()), value(8.0)], [None; 2]);
    }
}
