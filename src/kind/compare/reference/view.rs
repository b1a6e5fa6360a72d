//! The contact of the reference at one load: a part of the map, and the distribution of pressures.

use asperity::bem::Contact;
use asperity::compare::ModelKind;
use asperity::study::CaseResults;

use super::plan::Solution;
use super::run::ReferenceRun;

/// The contact at the load whose contact area is nearest to 2 %.
#[derive(Debug)]
pub struct ContactView {
    /// Thickness of the layer, m; `None` without a layer in the spec.
    pub thickness: Option<f64>,
    /// The largest pressure, Pa; `None` for an elastic contact.
    pub cap: Option<f64>,
    /// Nominal pressure, Pa.
    pub load: f64,
    /// Points in contact over all points.
    pub raw_area_ratio: f64,
    /// How far the area is from 2 %, as the absolute logarithm of their ratio.
    pub(super) distance: f64,
    /// Mean pressure of the points in contact, Pa.
    pub mean_pressure: f64,
    /// The part of the map that is shown.
    pub part: Part,
    /// What the sum takes to be in contact at the same load; `None` where it was not run.
    pub sum: Option<SummitsInContact>,
    /// Share of the points in contact per unit of p over its mean, in bins of equal width from 0.
    pub density: Vec<f64>,
    pub bin: f64,
}

/// A rectangle of points of the map.
#[derive(Debug)]
pub struct Part {
    /// Its first corner on the map, m.
    pub corner: [f64; 2],
    /// Its sides, m.
    pub sides: [f64; 2],
    pub points: [usize; 2],
    /// Contact pressures, Pa, y running fastest.
    pub pressures: Vec<f64>,
    /// Whether it is the whole map.
    pub is_whole: bool,
}

/// The asperities in contact in the sum, and whether the reference touches them.
#[derive(Debug)]
pub struct SummitsInContact {
    pub law: String,
    /// Number of asperities in contact on the whole map.
    pub count: usize,
    /// Those of them at or beside a point of the map in contact.
    pub touched: usize,
    /// Share of the points in contact that lie in patches without any of them.
    pub without: f64,
    /// Places of those on the part that is shown, m, and whether they are touched.
    pub places: Vec<([f64; 2], bool)>,
}

/// The sum at the load of a view: its law, and its separation, m.
pub(super) struct SumAtLoad {
    law: String,
    pub(super) separation: f64,
}

impl SumAtLoad {
    /// The sum of a case at the nominal pressure `pressure` (Pa), where it was run there.
    pub(super) fn new(case: &CaseResults, pressure: f64) -> Option<Self> {
        let mut curves = case.comparison.curves.iter().filter(|point| point.kind == ModelKind::Deterministic);
        let point = curves.find(|point| {
            point.prescribed_pressure == Some(pressure) || point.response.pressure.total() == pressure
        })?;
        Some(Self { law: case.law.clone(), separation: point.response.separation })
    }
}

/// Area ratio that a view is wanted at.
const AREA: f64 = 0.02;
/// Points along the sides of the part that is shown: the most, and fewer where marks would hide the contacts.
const SIDES: [usize; 3] = [256, 128, 64];
/// Marks on the part that is shown, at most, unless it has the fewest points.
const MOST_MARKS: usize = 120;
/// Bins of the distribution of pressures.
const BINS: usize = 40;

impl ContactView {
    /// How far the area of a contact is from what is wanted.
    pub(super) fn distance(contact: &Contact) -> f64 {
        (contact.raw_area_ratio() / AREA).ln().abs()
    }

    /// Of a contact at the nominal pressure `load` (Pa), beside a sum at the same load.
    pub(super) fn new(
        on: &ReferenceRun,
        solution: &Solution,
        load: f64,
        contact: &Contact,
        sum: Option<SumAtLoad>,
    ) -> Self {
        let (pressures, grid) = (contact.pressures(), contact.points());
        let refine = grid[0] / on.prepared.map.points()[0];
        let pixel = on.prepared.map.pixel().map(|size| size / refine as f64);
        let touching = pressures.iter().filter(|&&p| p > 0.0);
        let (count, total) = touching.fold((0_usize, 0.0), |(count, total), p| (count + 1, total + p));
        let mean_pressure = if count > 0 { total / count as f64 } else { 0.0 };
        let (bin, density) = distribution(pressures, mean_pressure, count);
        let mut sum = sum.map(|sum| SummitsInContact::new(on, &sum, contact, refine));
        let marks = |part: &Part| {
            let places = sum.iter().flat_map(|sum| &sum.places);
            places.filter(|(place, _)| part.holds(*place)).count()
        };
        let mut part = Part::new(pressures, grid, pixel, SIDES[0]);
        for side in &SIDES[1..] {
            if marks(&part) > MOST_MARKS {
                part = Part::new(pressures, grid, pixel, *side);
            }
        }
        if let Some(sum) = &mut sum {
            sum.places.retain(|(place, _)| part.holds(*place));
        }
        Self {
            thickness: solution.thickness,
            cap: solution.cap,
            load,
            raw_area_ratio: contact.raw_area_ratio(),
            distance: Self::distance(contact),
            mean_pressure,
            part,
            sum,
            density,
            bin,
        }
    }
}

/// Width of the bins of p/mean, and the share of the `count` points in contact per unit of it in each.
fn distribution(pressures: &[f64], mean: f64, count: usize) -> (f64, Vec<f64>) {
    let highest = pressures.iter().fold(0.0_f64, |highest, &p| highest.max(p));
    if count == 0 {
        return (1.0, Vec::new());
    }
    let bin = highest / mean / BINS as f64;
    let mut counts = vec![0_usize; BINS];
    for p in pressures.iter().filter(|&&p| p > 0.0) {
        counts[((p / mean / bin) as usize).min(BINS - 1)] += 1;
    }
    (bin, counts.into_iter().map(|inside| inside as f64 / (count as f64 * bin)).collect())
}

impl Part {
    /// The whole map, or of a large one the part whose share of points in contact is nearest to that of the map.
    fn new(pressures: &[f64], grid: [usize; 2], pixel: [f64; 2], side: usize) -> Self {
        let points = grid.map(|count| count.min(side));
        let blocks = [0, 1].map(|axis| grid[axis] / points[axis]);
        let first = |block: usize| [block / blocks[1] * points[0], block % blocks[1] * points[1]];
        let rows = |[x, y]: [usize; 2]| {
            (x..x + points[0]).map(move |ix| &pressures[ix * grid[1] + y..ix * grid[1] + y + points[1]])
        };
        let touching = |row: &[f64]| row.iter().filter(|&&p| p > 0.0).count();
        let of_map = pressures.chunks(grid[1]).map(touching).sum::<usize>() as f64 / pressures.len() as f64;
        let away = |block: usize| {
            let share =
                rows(first(block)).map(touching).sum::<usize>() as f64 / (points[0] * points[1]) as f64;
            (share - of_map).abs()
        };
        let nearest =
            (0..blocks[0] * blocks[1]).map(|block| (away(block), block)).min_by(|a, b| a.0.total_cmp(&b.0));
        let at = first(nearest.map_or(0, |(_, block)| block));
        Self {
            corner: [0, 1].map(|axis| at[axis] as f64 * pixel[axis]),
            sides: [0, 1].map(|axis| points[axis] as f64 * pixel[axis]),
            points,
            pressures: rows(at).flatten().copied().collect(),
            is_whole: points == grid,
        }
    }

    fn holds(&self, place: [f64; 2]) -> bool {
        (0..2).all(|axis| {
            let along = place[axis] - self.corner[axis];
            (0.0..self.sides[axis]).contains(&along)
        })
    }
}

impl SummitsInContact {
    fn new(on: &ReferenceRun, sum: &SumAtLoad, contact: &Contact, refine: usize) -> Self {
        let (pressures, grid) = (contact.pressures(), contact.points());
        let flat = on.surface.plane.mean + sum.separation;
        let (columns, pixel) = (on.prepared.map.points()[1], on.prepared.map.pixel());
        let wraps = contact.boundary().wraps();
        let mut patches = Patches { pressures, grid, wraps, seen: vec![false; pressures.len()] };
        let mut found = Self { law: sum.law.clone(), count: 0, touched: 0, without: 0.0, places: Vec::new() };
        for (&position, &height) in on.prepared.positions.iter().zip(on.surface.set.heights()) {
            if height <= flat {
                continue;
            }
            let at = [position / columns, position % columns];
            // At or beside a point of the map: as many points of the grid as one of the map has.
            let touched = patches.visit(at.map(|index| index * refine), refine);
            found.count += 1;
            found.touched += usize::from(touched);
            found.places.push(([0, 1].map(|axis| (at[axis] as f64 + 0.5) * pixel[axis]), touched));
        }
        let all = pressures.iter().filter(|&&p| p > 0.0).count();
        let seen = patches.seen.iter().filter(|seen| **seen).count();
        found.without = if all > 0 { (all - seen) as f64 / all as f64 } else { 0.0 };
        found
    }
}

/// The patch that each point of a contact belongs to, from 1 in the order of their first points, 0 out of contact; and how many there are.
pub fn numbered_patches(contact: &Contact) -> (Vec<u32>, u32) {
    let (pressures, grid) = (contact.pressures(), contact.points());
    let wraps = contact.boundary().wraps();
    let mut patches = Patches { pressures, grid, wraps, seen: vec![false; pressures.len()] };
    let (mut numbers, mut count) = (vec![0; pressures.len()], 0);
    for (point, &p) in pressures.iter().enumerate() {
        if p > 0.0 && !patches.seen[point] {
            count += 1;
            patches.visit_each([point / grid[1], point % grid[1]], 0, |point| numbers[point] = count);
        }
    }
    (numbers, count)
}

/// Connected points in contact, over sides and corners.
struct Patches<'a> {
    pressures: &'a [f64],
    grid: [usize; 2],
    /// Whether points on opposite borders are neighbours.
    wraps: bool,
    /// Points in contact that were visited.
    seen: Vec<bool>,
}

impl Patches<'_> {
    /// Visits the patches with a point at most `reach` points from `at`; whether there is one.
    fn visit(&mut self, at: [usize; 2], reach: usize) -> bool {
        self.visit_each(at, reach, |_| {})
    }

    /// The same, which calls `each` with the points that were not visited before.
    fn visit_each(&mut self, at: [usize; 2], reach: usize, mut each: impl FnMut(usize)) -> bool {
        let mut ahead: Vec<usize> = self.contacts(at, reach).collect();
        let is_touched = !ahead.is_empty();
        while let Some(point) = ahead.pop() {
            if !std::mem::replace(&mut self.seen[point], true) {
                each(point);
                let around = self.contacts([point / self.grid[1], point % self.grid[1]], 1);
                let new: Vec<usize> = around.filter(|&point| !self.seen[point]).collect();
                ahead.extend(new);
            }
        }
        is_touched
    }

    /// Points in contact at most `reach` points from `at` along both axes.
    fn contacts(&self, at: [usize; 2], reach: usize) -> impl Iterator<Item = usize> + '_ {
        let [rows, columns] = [0, 1].map(|axis| {
            let (at, count) = (at[axis], self.grid[axis]);
            // A map is larger than what is reached: no point comes twice.
            let (first, end) = if self.wraps {
                (at + count - reach, at + count + reach + 1)
            } else {
                (at.saturating_sub(reach), (at + reach + 1).min(count))
            };
            (first..end).map(move |index| index % count)
        });
        let places = rows.flat_map(move |ix| columns.clone().map(move |iy| ix * self.grid[1] + iy));
        places.filter(|&point| self.pressures[point] > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patches_without_a_summit_are_left() {
        let rows = ["1100", "0010", "0000", "1001"];
        let pressures: Vec<f64> =
            rows.iter().flat_map(|row| row.bytes()).map(|p| f64::from(p - b'0')).collect();
        let visited = |wraps, at, reach| {
            let mut patches = Patches { pressures: &pressures, grid: [4, 4], wraps, seen: vec![false; 16] };
            let is_touched = patches.visit(at, reach);
            (is_touched, (0..16).filter(|&point| patches.seen[point]).collect::<Vec<usize>>())
        };
        assert_eq!(visited(false, [1, 0], 0), (false, vec![]));
        assert_eq!(visited(false, [1, 0], 1), (true, vec![0, 1, 6]), "over the corner, not the last row");
        assert_eq!(
            visited(true, [1, 0], 1),
            (true, vec![0, 1, 6, 12, 15]),
            "over the border of a map that repeats"
        );
        assert_eq!(visited(true, [2, 0], 0), (false, vec![]));
    }
}
