//! Fewer points for the same picture.

/// No line needs more points than this.
const MOST: usize = 1500;

/// Leaves out points that lie within `tolerance` of the line through the rest, doubling the
/// tolerance until the line is short enough; first and last stay.
pub(super) fn thin(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let mut kept = simplify(&by_column(points, tolerance), tolerance);
    let mut tolerance = tolerance;
    while kept.len() > MOST && tolerance < 1e3 {
        tolerance *= 2.0;
        kept = simplify(&kept, tolerance);
    }
    kept
}

/// Of each run of points in one column keeps first, lowest, highest and last, in their order.
fn by_column(points: &[(f64, f64)], width: f64) -> Vec<(f64, f64)> {
    let mut kept = Vec::new();
    for run in points.chunk_by(|a, b| (a.0 / width).floor() == (b.0 / width).floor()) {
        let least = (0..run.len()).min_by(|a, b| run[*a].1.total_cmp(&run[*b].1)).unwrap_or(0);
        let most = (0..run.len()).max_by(|a, b| run[*a].1.total_cmp(&run[*b].1)).unwrap_or(0);
        let mut places = [0, least, most, run.len() - 1];
        places.sort_unstable();
        for (k, place) in places.iter().enumerate() {
            if k == 0 || places[k - 1] != *place {
                kept.push(run[*place]);
            }
        }
    }
    kept
}

/// Ramer, Douglas and Peucker: keep the point farthest from the chord while it is too far.
fn simplify(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let Some(last) = points.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[last] = true;
    let mut spans = vec![(0, last)];
    while let Some((from, to)) = spans.pop() {
        let mut farthest = (tolerance, None);
        for place in from + 1..to {
            let distance = from_chord(points[place], points[from], points[to]);
            if distance > farthest.0 {
                farthest = (distance, Some(place));
            }
        }
        if let Some(place) = farthest.1 {
            keep[place] = true;
            spans.extend([(from, place), (place, to)]);
        }
    }
    points.iter().zip(keep).filter_map(|(point, keep)| keep.then_some(*point)).collect()
}

fn from_chord(point: (f64, f64), from: (f64, f64), to: (f64, f64)) -> f64 {
    let (along, across) = (to.0 - from.0, to.1 - from.1);
    let (dx, dy) = (point.0 - from.0, point.1 - from.1);
    let length2 = along * along + across * across;
    let part = if length2 > 0.0 { ((dx * along + dy * across) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (dx - part * along).hypot(dy - part * across)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line_needs_its_ends() {
        let line: Vec<_> = (0..1000).map(|k| (k as f64, 2.0 * k as f64)).collect();
        assert_eq!(thin(&line, 0.1), [line[0], line[999]]);
        assert!(thin(&[], 0.1).is_empty());
        assert_eq!(thin(&[(1.0, 1.0)], 0.1).len(), 1);
    }

    #[test]
    fn every_point_stays_near_the_thinned_line() {
        let curve: Vec<_> = (0..5000).map(|k| (k as f64 * 0.1, 100.0 * (k as f64 * 0.01).sin())).collect();
        let thinned = thin(&curve, 0.2);
        assert!(thinned.len() < 500, "{}", thinned.len());
        for point in &curve {
            let near =
                thinned.windows(2).map(|w| from_chord(*point, w[0], w[1])).fold(f64::INFINITY, f64::min);
            assert!(near <= 0.5, "{near}");
        }
    }

    #[test]
    fn a_spike_survives_and_noise_is_bounded() {
        let mut line: Vec<_> = (0..100_000).map(|k| (k as f64 * 0.01, 0.0)).collect();
        line[50_000].1 = 80.0;
        assert!(thin(&line, 0.2).contains(&line[50_000]));
        let noise: Vec<_> =
            (0..100_000u64).map(|k| (k as f64 * 0.02, (k * 2_654_435_761 % 1000) as f64)).collect();
        assert!(thin(&noise, 0.2).len() <= 2 * MOST);
    }
}
