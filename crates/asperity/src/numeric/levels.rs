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
/// all levels are bracketed. Each bracket is closed by Hermite's cubic for x over ln(value), and by bisection where that neither halves the
/// bracket nor comes much nearer in value. A search ends where the level is reached by no more than rounding.
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
    /// |ln(value/level)| at the nearer end in value.
    gap: f64,
    /// Whether the last step neither halved the bracket nor came much nearer in value.
    is_slow: bool,
    /// How far before an estimate the next point is, in units of rounding: more where the last one missed the level by rounding.
    margin: f64,
}

impl Search {
    const MARGIN: f64 = 1.5;

    /// Relative excess of a value by its own rounding, and that of one whose place is rounded too.
    const OF_VALUE: f64 = 4.0 * f64::EPSILON;
    const OF_PLACE: f64 = 16.0 * f64::EPSILON;

    /// The widths of a last bracket within which a value nearly at the level decides, where the curve is flat.
    const FLAT: f64 = 1e3;

    fn new(level: f64, near: Point, far: Point) -> Self {
        let gap = gap(level, &near).min(gap(level, &far));
        Self { level, near, far, gap, is_slow: false, margin: Self::MARGIN }
    }

    fn width(&self) -> f64 {
        self.far.x - self.near.x
    }

    /// Whether the bracket is closed to rounding, or the level reached by no more than rounding.
    fn ends(&self) -> bool {
        if closed(self.near.x, self.far.x) {
            return true;
        }
        let Point { x, value, slope } = self.near;
        let excess = value / self.level - 1.0;
        let distance = excess * value / slope.abs();
        let within = |most: f64, widths: f64| excess <= most && distance <= widths * WIDTH * x.abs().max(1.0);
        within(Self::OF_VALUE, Self::FLAT) || within(Self::OF_PLACE, 1.0)
    }

    /// The next point to evaluate, inside the bracket.
    fn next(&self) -> f64 {
        let (low, high) = (self.near.x, self.far.x);
        let unit = f64::EPSILON * low.abs().max(high.abs()).max(1.0);
        if self.is_slow {
            return 0.5 * (low + high);
        }
        match self.estimate() {
            // Towards the end that reaches the level, by the rounding of place and value.
            Some([x, per_relative]) => {
                let x = x - self.margin * unit.max(f64::EPSILON * per_relative);
                x.max(low + 2.0 * unit).min(high - 2.0 * unit)
            }
            None => 0.5 * (low + high),
        }
    }

    /// Where the curve is at the level, and |dx/d ln(value)| there: by Hermite's cubic for x over ln(value), from both ends of the
    /// bracket, or by Newton's step from the near end where the far one has no value; `None` outside the bracket.
    fn estimate(&self) -> Option<[f64; 2]> {
        let [near, far] = [&self.near, &self.far].map(|end| (end.value / self.level).ln());
        let [per_near, per_far] = [&self.near, &self.far].map(|end| end.value / end.slope);
        let width = near - far;
        let (low, high) = (self.near.x, self.far.x);
        let cubic = || {
            let t = near / width;
            let s = 1.0 - t;
            low * s * s * (1.0 + 2.0 * t) + high * t * t * (1.0 + 2.0 * s)
                - width * t * s * (per_near * s - per_far * t)
        };
        let newton = -near * per_near;
        let inside = |x: &f64| (low..=high).contains(x);
        let x = Some(cubic()).filter(inside).or(Some(newton + low).filter(inside))?;
        let per_relative = if near.abs() < far.abs() { per_near } else { per_far };
        Some([x, per_relative.abs()])
    }

    fn update(&mut self, point: Point) {
        let before = (self.width(), self.gap);
        self.gap = gap(self.level, &point);
        if point.value >= self.level {
            (self.near, self.margin) = (point, Self::MARGIN);
        } else {
            self.far = point;
            self.margin *= if self.gap < Self::OF_PLACE { 4.0 } else { 1.0 };
        }
        let is_nearer = self.gap < Self::OF_PLACE || self.gap < 0.1 * before.1;
        self.is_slow = self.width() > 0.5 * before.0 && !is_nearer;
    }
}

/// |ln(value/level)| at a point.
fn gap(level: f64, point: &Point) -> f64 {
    (point.value / level).ln().abs()
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
        assert!(rounds <= 6, "{rounds} rounds");
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
