//! From a value to a place along an axis.

use super::{Axis, Spread};

/// Values beyond this are not shown: their differences would overflow.
const LARGEST: f64 = 1e300;

/// A range of values laid on a stretch of the page. The ends are in the axis's own measure: values,
/// or their decimal logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) spread: Spread,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Scale {
    /// The axis's own range, or that of the values with some room at both ends. `tight` leaves no
    /// room below a lowest value of zero, where bars and shares stand.
    pub(super) fn new(axis: &Axis, values: impl Iterator<Item = f64>, tight: bool) -> Self {
        let spread = axis.spread;
        if let Some((from, to)) = axis.range
            && let (Some(from), Some(to)) = (measure(spread, from), measure(spread, to))
            && apart(from, to)
        {
            return Self { spread, from, to };
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let zero = axis.zero.then_some(0.0);
        for value in values.chain(zero).filter_map(|value| measure(spread, value)) {
            low = low.min(value);
            high = high.max(value);
        }
        if low > high {
            return Self { spread, from: 0.0, to: 1.0 };
        }
        if !apart(low, high) {
            // One value only: it stands in the middle.
            let room = match spread {
                Spread::Log => 0.5,
                Spread::Linear if low == 0.0 => 1.0,
                Spread::Linear => 0.5 * low.abs(),
            };
            return Self { spread, from: low - room, to: high + room };
        }
        let room = 0.03 * (high - low);
        let from = if tight && low == 0.0 && spread == Spread::Linear { low } else { low - room };
        Self { spread, from, to: high + room }
    }

    /// Position of a value, 0 at the beginning of the axis and 1 at its end; values outside lie
    /// beyond. None for what the axis cannot show.
    pub(super) fn place(&self, value: f64) -> Option<f64> {
        measure(self.spread, value).map(|value| self.place_measured(value))
    }

    /// As [`Scale::place`], for a value in the axis's own measure.
    pub(super) fn place_measured(&self, value: f64) -> f64 {
        (value - self.from) / (self.to - self.from)
    }

    /// The lowest and highest shown, in the axis's own measure.
    pub(super) fn bounds(&self) -> (f64, f64) {
        (self.from.min(self.to), self.from.max(self.to))
    }
}

/// A value in the axis's own measure, if it has one.
pub(super) fn measure(spread: Spread, value: f64) -> Option<f64> {
    match spread {
        Spread::Linear => (value.abs() <= LARGEST).then_some(value),
        Spread::Log => (value > 0.0 && value <= LARGEST).then(|| value.log10()),
    }
}

/// Whether two values differ by more than the last digits, which no axis can divide.
fn apart(from: f64, to: f64) -> bool {
    (to - from).abs() > 1e-9 * from.abs().max(to.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(axis: Axis, values: &[f64]) -> Scale {
        Scale::new(&axis, values.iter().copied(), false)
    }

    #[test]
    fn log_axes_skip_what_has_no_logarithm() {
        let scale = scale(Axis::log(""), &[-1.0, 0.0, f64::NAN, f64::INFINITY, 1e-6, 1e-2]);
        assert!(scale.from < -6.0 && scale.from > -6.2);
        assert!(scale.to > -2.0 && scale.to < -1.8);
        assert_eq!(scale.place(0.0), None);
        assert_eq!(scale.place(-1.0), None);
    }

    #[test]
    fn one_value_stands_in_the_middle() {
        for (axis, value) in [(Axis::linear(""), 3.0), (Axis::linear(""), 0.0), (Axis::log(""), 1e-9)] {
            let place = scale(axis, &[value, value]).place(value).unwrap();
            assert!((place - 0.5).abs() < 1e-12);
        }
    }

    #[test]
    fn a_falling_range_turns_the_axis() {
        let scale = scale(Axis::linear("").range(4.0, 0.0), &[]);
        assert_eq!(scale.place(4.0), Some(0.0));
        assert_eq!(scale.place(1.0), Some(0.75));
    }

    #[test]
    fn a_range_that_cannot_be_shown_gives_way_to_the_data() {
        assert_eq!(scale(Axis::log("").range(0.0, 1.0), &[1.0, 10.0]).from, -0.03);
        assert_eq!(scale(Axis::linear("").range(2.0, 2.0), &[0.0, 1.0]).to, 1.03);
        assert_eq!(scale(Axis::linear("").range(f64::NAN, 2.0), &[0.0, 1.0]).to, 1.03);
    }
}
