//! Searches for the point at which a curve reaches a level, for decreasing and for arbitrary curves.
//!
//! All methods keep a bracket, so that the value at the result has been evaluated and reaches the level.

use super::interval::Interval;

/// Relative width of the last bracket, a few units of rounding.
pub(crate) const WIDTH: f64 = 4.0 * f64::EPSILON;

/// Whether a bracket is closed to rounding.
pub(super) fn closed(low: f64, high: f64) -> bool {
    is_closed(low, high, WIDTH)
}

/// Whether a bracket is closed to a relative width.
fn is_closed(low: f64, high: f64, width: f64) -> bool {
    high - low <= width * low.abs().max(high.abs()).max(1.0)
}

/// The largest `x` in [low, high], to rounding, with `value(x) >= level`, for a non-increasing `value`; at a jump, the
/// side that reaches the level. `None` if `value(low)` does not reach the level.
///
/// Chandrupatla's method (Advances in Engineering Software 28, 145, 1997) on ln(value/level), with bisection where a
/// value is zero or infinite.
pub fn last_reaching(value: impl Fn(f64) -> f64, level: f64, low: f64, high: f64) -> Option<f64> {
    last_reaching_within(value, level, low, high, WIDTH)
}

/// [`last_reaching`] to a relative width instead of to rounding.
pub(crate) fn last_reaching_within(
    value: impl Fn(f64) -> f64,
    level: f64,
    low: f64,
    high: f64,
    width: f64,
) -> Option<f64> {
    // What is negative, or no number, does not reach the level.
    let gap = |x: f64| (value(x) / level).max(0.0).ln();
    let near_gap = gap(low);
    if near_gap < 0.0 {
        return None;
    }
    let far_gap = gap(high);
    if far_gap >= 0.0 {
        return Some(high);
    }
    Some(crossing(gap, [low, near_gap], [high, far_gap], width))
}

/// The last point, to a relative width, at which `gap` is not negative, between two ends `[x, gap]` with a non-negative and
/// a negative gap.
fn crossing(gap: impl Fn(f64) -> f64, low: [f64; 2], high: [f64; 2], width: f64) -> f64 {
    let ([mut near, mut near_gap], [mut far, mut far_gap]) = (low, high);
    // `latest` is the end that moved last, `other` the opposite end, `before` the one it replaced.
    let (mut latest, mut latest_gap, mut other, mut other_gap) = (near, near_gap, far, far_gap);
    let mut fraction: f64 = 0.5;
    while !is_closed(near, far, width) {
        let least = width * latest.abs().max(other.abs()).max(1.0) / (far - near) * 0.5;
        let x = latest + (other - latest) * fraction.clamp(least, 1.0 - least);
        let x_gap = gap(x);
        let (before, before_gap);
        if (x_gap >= 0.0) == (latest_gap >= 0.0) {
            (before, before_gap) = (latest, latest_gap);
        } else {
            (before, before_gap) = (other, other_gap);
            (other, other_gap) = (latest, latest_gap);
        }
        (latest, latest_gap) = (x, x_gap);
        if x_gap >= 0.0 {
            (near, near_gap) = (x, x_gap);
        } else {
            (far, far_gap) = (x, x_gap);
        }
        fraction = interpolate(latest, latest_gap, other, other_gap, before, before_gap).unwrap_or(0.5);
    }
    debug_assert!(near_gap >= 0.0 && far_gap < 0.0);
    near
}

/// All points in [low, high], ascending, at which `value`, of order 1 to 100, changes its sign. `over(a, b)` gives
/// bounds of the values and slopes of `value` on [a, b], which tighten as the interval shrinks.
///
/// An interval whose values have one sign is discarded; one whose slopes have one sign has at most one root; any other
/// is bisected. Hence no root is missed, except pairs closer than rounding can separate.
pub fn sign_changes(
    value: &impl Fn(f64) -> f64,
    over: &impl Fn(f64, f64) -> [Interval; 2],
    low: f64,
    high: f64,
) -> Vec<f64> {
    /// Rounding error of a value.
    const ROUNDING: f64 = 1e-13;
    let mut found = Vec::new();
    let mut pieces = vec![(low, high)];
    while let Some((from, to)) = pieces.pop() {
        let [values, slopes] = over(from, to);
        let values = values + Interval { low: -ROUNDING, high: ROUNDING };
        let start = value(from);
        // Near a multiple root the slopes bound the values more tightly than the bounds of the values.
        let change = slopes.low.abs().max(slopes.high.abs()) * (to - from);
        if !values.contains(0.0) || start.abs() > change + ROUNDING {
            continue;
        }
        if !slopes.contains(0.0) || change <= ROUNDING || closed(from, to) {
            let end = value(to);
            // Zero counts as positive.
            if start >= 0.0 && end < 0.0 {
                found.push(crossing(value, [from, start], [to, end], WIDTH));
            } else if start < 0.0 && end >= 0.0 {
                found.push(-crossing(|x| value(-x), [-to, end], [-from, start], WIDTH));
            }
            continue;
        }
        let middle = 0.5 * (from + to);
        pieces.extend([(middle, to), (from, middle)]);
    }
    found
}

/// Inverse quadratic interpolation through the last three points, as a fraction of the distance from `a` to `b`; `None`
/// if Chandrupatla's criterion rejects it.
fn interpolate(a: f64, fa: f64, b: f64, fb: f64, c: f64, fc: f64) -> Option<f64> {
    if !(fa.is_finite() && fb.is_finite() && fc.is_finite()) {
        return None;
    }
    let xi = (a - b) / (c - b);
    let phi = (fa - fb) / (fc - fb);
    if !(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi) {
        return None;
    }
    let t = fa / (fb - fa) * (fc / (fb - fc)) + (c - a) / (b - a) * (fa / (fc - fa)) * (fb / (fc - fb));
    t.is_finite().then_some(t)
}

/// The largest `x` in [low, high], to rounding, with `value(x) >= level`, for an arbitrary `value`. `bound(a, b)` gives
/// an upper bound of `value` and bounds of its slopes on [a, b], which tighten as the interval shrinks. Halves are
/// searched from above; an interval whose bound is below the level is skipped, and one whose slopes have one sign is
/// not bisected. `None` if the level is not reached.
pub fn last_reaching_bounded(
    value: &impl Fn(f64) -> f64,
    bound: &impl Fn(f64, f64) -> (f64, Interval),
    level: f64,
    low: f64,
    high: f64,
) -> Option<f64> {
    let (highest, slopes) = bound(low, high);
    if highest < level {
        return None;
    }
    if slopes.high <= 0.0 {
        return last_reaching(value, level, low, high);
    }
    if slopes.low >= 0.0 {
        return (value(high) >= level).then_some(high);
    }
    if closed(low, high) {
        return (value(low) >= level).then_some(low);
    }
    let middle = 0.5 * (low + high);
    last_reaching_bounded(value, bound, level, middle, high)
        .or_else(|| last_reaching_bounded(value, bound, level, low, middle))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    const ANY: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };

    #[test]
    fn finds_a_smooth_level_in_few_steps() {
        let calls = Cell::new(0);
        let value = |x: f64| {
            calls.set(calls.get() + 1);
            (-0.01 * x * x * x - 3.0 * x).exp()
        };
        for exact in [-1.5, 0.1, 0.7, 1.9, 3.2] {
            calls.set(0);
            let found = last_reaching(value, value(exact), -10.0, 39.0).unwrap();
            assert!((found - exact).abs() < 4e-15, "{found} for {exact}");
            assert!(value(found) >= value(exact));
            assert!(calls.get() < 40, "{} calls for {exact}", calls.get());
        }
    }

    #[test]
    fn what_is_negative_or_no_number_does_not_reach_a_level() {
        for beyond in [-1e-17, f64::NAN] {
            let value = |x: f64| if x < 1.0 { 1.0 - x } else { beyond };
            let found = last_reaching(value, 1e-3, 0.0, 2.0).unwrap();
            assert!((found - 0.999).abs() < 1e-12, "{found}");
            assert_eq!(last_reaching(value, 1e-3, 1.0, 2.0), None);
        }
    }

    #[test]
    fn a_jump_ends_on_its_near_side() {
        let value = |x: f64| if x <= 1.25 { 3.0 - x } else { 0.0 };
        let found = last_reaching(value, 1.0, -10.0, 10.0).unwrap();
        assert!(found <= 1.25 && 1.25 - found < 1e-14);
    }

    #[test]
    fn a_level_out_of_reach_is_said() {
        assert_eq!(last_reaching(|x| -x, 11.0, -10.0, 10.0), None);
        assert_eq!(last_reaching(|_| f64::NAN, 1.0, -10.0, 10.0), None);
        assert_eq!(last_reaching_bounded(&|x| -x, &|a, _| (-a, ANY), 11.0, -10.0, 10.0), None);
    }

    /// Roots of a cubic, two of them close together or one, none or a touching pair.
    #[test]
    fn every_change_of_sign_is_found() {
        for (shift, expected) in [(0.0, 3), (1e-13, 1), (-1e-9, 3), (1e-3, 1), (-4.0, 3), (-9.0, 1)] {
            // (x - 1)^2 (x + 2) + shift, of which x = 1 is a double root and x = -1 the peak of 4.
            let value = |x: f64| (x - 1.0) * (x - 1.0) * (x + 2.0) + shift;
            let over = |a: f64, b: f64| {
                let x = Interval { low: a, high: b };
                let less = x + -1.0;
                let square = if less.contains(0.0) {
                    Interval { low: 0.0, high: (less * less).high }
                } else {
                    less * less
                };
                [square * (x + 2.0) + shift, less * (x + 1.0) * 3.0]
            };
            let found = sign_changes(&value, &over, -10.0, 10.0);
            let count = if shift == 0.0 || shift == -4.0 { 1..=3 } else { expected..=expected };
            assert!(count.contains(&found.len()), "{shift}: {found:?}");
            assert!(found.is_sorted());
            for x in found {
                let width = 1e-14 * x.abs().max(1.0);
                assert!(value(x - width) * value(x + width) <= 0.0, "{shift}: {x}");
            }
        }
    }

    #[test]
    fn a_curve_that_falls_on_the_way_is_reached_where_it_first_is() {
        // Rises to 1 at x = 2, drops by half, rises again: 0.8 is first reached at 2.2.
        let value = |x: f64| if x >= 2.0 { 3.0 - x } else { 2.5 - x };
        let bound = |a: f64, b: f64| {
            if a < 2.0 && b >= 2.0 { (value(a).max(1.0), ANY) } else { (value(a), Interval::point(-1.0)) }
        };
        let found = last_reaching_bounded(&value, &bound, 0.8, -10.0, 10.0).unwrap();
        assert!((found - 2.2).abs() < 1e-14);
    }
}
