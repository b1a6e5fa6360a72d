//! Plateaus: connected points of equal height, which may form a summit.

use super::{CurvatureTensor, Finder, Summits};

/// A point that is equal to some of its neighbours and not lower than any.
pub(super) struct LevelPoint {
    pub(super) position: usize,
    /// Number of summits, without plateaus, before it in file order.
    pub(super) rank: usize,
    pub(super) height: f64,
    pub(super) curvature_tensor: CurvatureTensor,
    /// A bit for each neighbour of equal height.
    pub(super) equal: u8,
    pub(super) drops: [f64; 4],
}

impl Finder {
    /// The position at `step`, wrapped around a periodic border; `None` beyond an open one.
    fn neighbour(&self, position: usize, step: [isize; 2]) -> Option<usize> {
        let here = [position / self.points[1], position % self.points[1]];
        let mut there = [0; 2];
        for axis in 0..2 {
            let count = self.points[axis] as isize;
            let index = here[axis] as isize + step[axis];
            if !self.is_periodic && !(0..count).contains(&index) {
                return None;
            }
            there[axis] = index.rem_euclid(count) as usize;
        }
        Some(there[0] * self.points[1] + there[1])
    }

    /// Adds the plateaus that are summits: those whose points are all in `level`, a list in file order. Each plateau is
    /// traversed once.
    pub(super) fn add_plateaus(&self, level: &[LevelPoint], found: &mut Summits) {
        // The start of each row of the map in the list, so that a neighbour is searched in its row only.
        let columns = self.points[1];
        let mut starts = vec![0; self.points[0] + 1];
        for point in level {
            starts[point.position / columns + 1] += 1;
        }
        for row in 0..self.points[0] {
            starts[row + 1] += starts[row];
        }
        let place = |position: usize, from: usize| {
            // On a wide plateau the neighbour along the row is adjacent in the list.
            for near in [from.wrapping_sub(1), from + 1] {
                if level.get(near).is_some_and(|point| point.position == position) {
                    return Some(near);
                }
            }
            let row = position / columns;
            let found =
                level[starts[row]..starts[row + 1]].binary_search_by_key(&position, |point| point.position);
            found.ok().map(|place| starts[row] + place)
        };
        let mut seen = vec![false; level.len()];
        let mut summits = Vec::new();
        for start in 0..level.len() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            let mut plateau = vec![start];
            let mut is_summit = true;
            let mut next = 0;
            while let Some(&member) = plateau.get(next) {
                next += 1;
                let point = &level[member];
                for (bit, &step) in self.neighbours.steps().iter().enumerate() {
                    if point.equal & (1 << bit) == 0 {
                        continue;
                    }
                    // An equal point that is not in the list has a higher neighbour or was not tested: the plateau is
                    // not a summit.
                    let neighbour = self.neighbour(point.position, step);
                    match neighbour.and_then(|position| place(position, member)) {
                        Some(other) if !seen[other] => {
                            seen[other] = true;
                            plateau.push(other);
                        }
                        Some(_) => {}
                        None => is_summit = false,
                    }
                }
            }
            // The traversal began at its first point in file order.
            if is_summit && self.rows.contains(&(level[start].position / columns)) {
                summits.push(plateau);
            }
        }
        found.plateaus = summits.len();
        let mut kept = Vec::new();
        for plateau in summits {
            let mut mean = CurvatureTensor::default();
            for &member in &plateau {
                for (sum, part) in mean.0.iter_mut().zip(level[member].curvature_tensor.0) {
                    *sum += part / plateau.len() as f64;
                }
            }
            if mean.curvature() <= 0.0 {
                found.dropped += 1;
                continue;
            }
            if self.detail.drops {
                let drops = plateau.iter().flat_map(|&member| level[member].drops);
                found.drops.extend(drops.filter(|&drop| drop > 0.0));
            }
            kept.push((&level[plateau[0]], mean));
        }
        self.merge(found, &kept);
    }

    /// Merges plateaus, in file order, into the other summits.
    fn merge(&self, found: &mut Summits, plateaus: &[(&LevelPoint, CurvatureTensor)]) {
        insert(&mut found.heights, plateaus, |(point, _)| point.height);
        insert(&mut found.curvatures, plateaus, |(_, curvature_tensor)| curvature_tensor.curvature());
        if self.detail.positions {
            insert(&mut found.positions, plateaus, |(point, _)| point.position);
        }
        if self.detail.principal {
            insert(&mut found.principal, plateaus, |(_, curvature_tensor)| curvature_tensor.principal());
        }
    }
}

/// Inserts a value for each plateau at its rank in a list of the other summits.
fn insert<T: Copy>(
    list: &mut Vec<T>,
    plateaus: &[(&LevelPoint, CurvatureTensor)],
    value: impl Fn(&(&LevelPoint, CurvatureTensor)) -> T,
) {
    let mut all = Vec::with_capacity(list.len() + plateaus.len());
    let mut from = 0;
    for plateau in plateaus {
        all.extend_from_slice(&list[from..plateau.0.rank]);
        all.push(value(plateau));
        from = plateau.0.rank;
    }
    all.extend_from_slice(&list[from..]);
    *list = all;
}
