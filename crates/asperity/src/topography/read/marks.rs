//! Marks of missing points: heights such as -9999 that an instrument writes where it measured nothing.

use super::error::ReadError;

/// Marks that programs write.
const USUAL: [f64; 13] = [
    -9999.0, 9999.0, -99_999.0, 99_999.0, -999.0, 999.0, -32_768.0, -32_767.0, 32_767.0, 65_535.0, 1e30,
    -1e30, 1e10,
];

/// Replaces heights that are one of `missing` to single precision by NaN.
pub(super) fn mark_missing(heights: &mut [f64], missing: &[f64]) {
    const SINGLE: f64 = 1e-7;
    if missing.is_empty() {
        return;
    }
    for z in heights {
        if missing.iter().any(|mark| (*z - mark).abs() <= SINGLE * mark.abs()) {
            *z = f64::NAN;
        }
    }
}

/// The lowest height or, of heights with the sign reversed, the highest: how often it stands, and the next one.
#[derive(Debug, Clone, Copy)]
struct End {
    value: f64,
    count: usize,
    next: f64,
}

impl End {
    const NONE: Self = Self { value: f64::INFINITY, count: 0, next: f64::INFINITY };

    fn add(&mut self, z: f64) {
        if z < self.value {
            *self = Self { value: z, count: 1, next: self.value };
        } else if z == self.value {
            self.count += 1;
        } else if z < self.next {
            self.next = z;
        }
    }

    fn joined(self, other: Self) -> Self {
        let (low, high) = if self.value <= other.value { (self, other) } else { (other, self) };
        if low.value == high.value {
            Self { count: low.count + high.count, next: low.next.min(high.next), ..low }
        } else {
            Self { next: low.next.min(high.value), ..low }
        }
    }
}

/// The lowest and the highest heights of a map.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extremes {
    low: End,
    /// Of heights with the sign reversed.
    high: End,
}

impl Extremes {
    pub const NONE: Self = Self { low: End::NONE, high: End::NONE };

    /// Of heights; NaN is none.
    pub fn new<'a>(heights: impl IntoIterator<Item = &'a f64>) -> Self {
        let mut all = Self::NONE;
        for &z in heights {
            all.low.add(z);
            all.high.add(-z);
        }
        all
    }

    pub fn joined(self, other: Self) -> Self {
        Self { low: self.low.joined(other.low), high: self.high.joined(other.high) }
    }

    /// The largest magnitude; `None` without a height.
    pub fn tallest(&self) -> Option<f64> {
        (self.low.count > 0).then(|| self.low.value.abs().max(self.high.value.abs()))
    }

    /// The error of a height that is a mark of missing points rather than a height; `unit` is what a height of one in the
    /// file is here. Two heights that a map alternates between are heights.
    pub fn mark(&self, unit: f64) -> Option<ReadError> {
        /// Points that hold a mark, unless it is one that programs write.
        const MANY: usize = 3;
        let ends = [(self.low, -self.high.value, 1.0), (self.high, self.low.value, -1.0)];
        ends.into_iter().find_map(|(end, other, sign)| {
            let range = sign * other - end.next;
            let value = rounded(sign * end.value / unit, 9);
            let is_usual = USUAL.iter().any(|usual| (value / usual - 1.0).abs() < 1e-6);
            // Distance of a mark from the other heights over their range.
            let least = match (is_usual, end.count >= MANY) {
                (true, true) => 0.2,
                (true, false) => 1.0,
                (false, true) => 5.0,
                (false, false) => f64::INFINITY,
            };
            let is_mark = range > 0.0 && end.next - end.value > least * range;
            let [next, other] = [sign * end.next, other].map(|z| rounded(z / unit, 4));
            is_mark.then(|| ReadError::Mark {
                value,
                count: end.count,
                low: next.min(other),
                high: next.max(other),
            })
        })
    }
}

/// A height to some significant digits, without the rounding of a conversion of units.
fn rounded(z: f64, digits: usize) -> f64 {
    format!("{z:.*e}", digits - 1).parse().unwrap_or(z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mark(heights: &[f64]) -> Option<(f64, usize)> {
        let whole = Extremes::new(heights);
        let parts = heights.chunks(3).map(Extremes::new).fold(Extremes::NONE, Extremes::joined);
        assert_eq!(format!("{whole:?}"), format!("{parts:?}"));
        match whole.mark(1.0) {
            Some(ReadError::Mark { value, count, .. }) => Some((value, count)),
            _ => None,
        }
    }

    #[test]
    fn a_repeated_height_far_from_all_others_is_a_mark() {
        assert_eq!(mark(&[1.0, 2.0, -9999.0, 3.0, 5.0, 2.5, -9999.0]), Some((-9999.0, 2)));
        assert_eq!(mark(&[20e3, 30e3, 25e3, 65_535.0, 22e3]), Some((65_535.0, 1)));
        assert_eq!(mark(&[10e3, 40e3, 65_535.0, 65_535.0, 65_535.0]), Some((65_535.0, 3)));
        assert_eq!(mark(&[12.0, 0.0, 12.5, 0.0, 12.3, 0.0, 12.1]), Some((0.0, 3)));
        assert_eq!(mark(&[-1.0, 1.0, 50.0, 0.5, 50.0, 50.0]), Some((50.0, 3)));
    }

    #[test]
    fn heights_are_no_marks() {
        // Twice only, near the others, two levels, a single spike, steps.
        for heights in [
            &[12.0, 0.0, 12.5, 0.0, 12.3][..],
            &[12.0, 10.0, 12.5, 10.0, 12.3, 10.0],
            &[0.0, 1.0, 0.0, 1.0, 1.0, 1.0],
            &[1.0, 2.0, 3.0, 500.0],
            &[1.0, 2.0, 3.0, 3.0, 3.0],
            &[-999.0, -500.0, 600.0],
            &[65_535.0, 65_535.0, 65_535.0, 65_000.0, 20e3],
            &[0.0; 4],
            &[],
        ] {
            assert_eq!(mark(heights), None, "{heights:?}");
        }
        assert_eq!(Extremes::NONE.tallest(), None);
    }

    #[test]
    fn marks_are_compared_to_single_precision() {
        let mut heights = [f64::from(-3.4e10f32), -3.4e10, 0.0, 1.0];
        mark_missing(&mut heights, &[-3.4e10, 0.0]);
        assert_eq!(heights.map(f64::is_nan), [true, true, true, false]);
    }
}
