//! Simultaneous search for the last points at which a decreasing curve reaches many levels: each round evaluates one
//! point per level.

use super::root::{WIDTH, closed};

/// A point of a curve and its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The abscissa.
    pub x: f64,
    /// The value, at least 0.
    pub value: f64,
    /// The slope; any number if it is unknown.
    pub slope: f64,
}

/// For each of `levels` (positive) the largest `x`, to rounding, at which a non-increasing curve is at least the level;
/// at a jump, the side that reaches the level. `None` for a level that is not reached at the last point of `grid`.
///
/// The grid descends from the largest `x` searched to the smallest; one of its `waves` after the other is evaluated, until
/// all levels are bracketed. Each bracket is closed by Newton's method on ln(value/level), with each step extended by its square so
/// that it passes the root, and by bisection where that does not halve the bracket.
pub fn last_reaching_all(
    mut curve: impl FnMut(&[f64]) -> Vec<Point>,
    levels: &[f64],
    waves: &[&[f64]],
) -> Vec<Option<f64>> {
    if levels.is_empty() {
        return Vec::new();
    }
    let highest = levels.iter().copied().fold(0.0, f64::max);
    let mut known: Vec<Point> = Vec::new();
    for wave in waves {
        if known.last().is_none_or(|last| last.value < highest) {
            known.extend(curve(wave));
        }
    }
    let start = |&level: &f64| {
        let reached = known.iter().position(|point| point.value >= level)?;
        Some(Search::new(level, known[reached], known[reached.saturating_sub(1)]))
    };
    let mut searches: Vec<Option<Search>> = levels.iter().map(start).collect();
    loop {
        let mut open: Vec<&mut Search> =
            searches.iter_mut().flatten().filter(|search| !search.ends()).collect();
        if open.is_empty() {
            return searches.iter().map(|search| search.as_ref().map(|search| search.near.x)).collect();
        }
        let places: Vec<f64> = open.iter().map(|search| search.next()).collect();
        for (search, point) in open.iter_mut().zip(curve(&places)) {
            search.update(point);
        }
    }
}

/// The search for one level.
#[derive(Debug)]
struct Search {
    level: f64,
    /// The end at which the level is reached.
    near: Point,
    /// The end at which it is not; equal to `near` if the search began where the level is reached.
    far: Point,
    /// Whether `near` was updated last.
    near_is_latest: bool,
    /// Whether the last step left more than half of the bracket.
    is_slow: bool,
}

impl Search {
    fn new(level: f64, near: Point, far: Point) -> Self {
        let gap = |point: &Point| (point.value / level).ln().abs();
        Self { level, near, far, near_is_latest: gap(&near) <= gap(&far), is_slow: false }
    }

    fn width(&self) -> f64 {
        self.far.x - self.near.x
    }

    fn ends(&self) -> bool {
        closed(self.near.x, self.far.x)
    }

    /// The next point to evaluate, inside the bracket.
    fn next(&self) -> f64 {
        let (low, high) = (self.near.x, self.far.x);
        let latest = if self.near_is_latest { self.near } else { self.far };
        let newton = -(latest.value / self.level).ln() * latest.value / latest.slope;
        let x = latest.x + newton + newton.abs() * newton;
        let least = 0.5 * WIDTH * low.abs().max(high.abs()).max(1.0);
        if self.is_slow || !(low..=high).contains(&x) {
            return 0.5 * (low + high);
        }
        x.max(low + least).min(high - least)
    }

    fn update(&mut self, point: Point) {
        let before = self.width();
        self.near_is_latest = point.value >= self.level;
        if self.near_is_latest {
            self.near = point;
        } else {
            self.far = point;
        }
        self.is_slow = self.width() > 0.5 * before;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(value: impl Fn(f64) -> [f64; 2]) -> impl Fn(&[f64]) -> Vec<Point> {
        move |places| places.iter().map(|&x| Point { x, value: value(x)[0], slope: value(x)[1] }).collect()
    }

    fn grid() -> Vec<f64> {
        (0..50).map(|k| 39.0 - f64::from(k)).collect()
    }

    #[test]
    fn smooth_levels_in_few_rounds() {
        let value = |x: f64| (-0.01 * x * x * x - 3.0 * x).exp();
        let mut rounds = 0;
        let exact = [-1.5, 0.1, 0.7, 1.9, 3.2, 20.0];
        let levels = exact.map(value);
        let curve = curve(|x| [value(x), -value(x) * (0.03 * x * x + 3.0)]);
        let found = last_reaching_all(
            |places| {
                rounds += 1;
                curve(places)
            },
            &levels,
            &[&grid()],
        );
        for ((found, exact), level) in found.into_iter().zip(exact).zip(levels) {
            let found = found.unwrap();
            assert!((found - exact).abs() < 4e-15 * exact.abs().max(1.0), "{found} for {exact}");
            assert!(value(found) >= level);
        }
        assert!(rounds <= 12, "{rounds} rounds");
    }

    /// For any reported slope.
    #[test]
    fn wrong_slopes_and_jumps_do_not_lead_astray() {
        for slope in [0.0, -1e300, 1.0, f64::NAN, f64::INFINITY] {
            let curve = curve(|x: f64| [if x <= 1.25 { 3.0 - x } else { 0.0 }, slope]);
            let found = last_reaching_all(curve, &[1.0, 1.75, 2.5, 40.0], &[&grid()]);
            for (found, exact) in found.iter().zip([1.25, 1.25, 0.5]) {
                let found = found.unwrap();
                assert!((found - exact).abs() < 1e-14, "{found} for {exact}");
            }
            assert_eq!(found[3], None);
        }
    }

    #[test]
    fn the_ends_of_the_grid() {
        let curve = curve(|x: f64| [5.0 - x, -1.0]);
        assert_eq!(last_reaching_all(&curve, &[1.0, 1.5], &[&[4.0]]), [Some(4.0), None]);
        assert_eq!(last_reaching_all(&curve, &[0.5], &[&[4.0], &[3.0]]), [Some(4.0)]);
        let never = |_: &[f64]| panic!("no level, no place");
        assert_eq!(last_reaching_all(never, &[], &[&[4.0, 3.0]]), []);
    }
}
