//! What is in contact on a measured map, load by load, for a picture of it.

use std::f64::consts::PI;

use asperity::compare::{CurvePoint, ModelKind};
use asperity::study::{CaseStudy, LawContact};
use asperity::surface::{PreparedMap, Surface};
use asperity::topography::thumbnail;
use asperity::{HeightMap, Shape};

use super::figures::curves::curve;
use super::reference::plan::spread_over;

/// What is in contact on a measured map, load by load.
#[derive(Debug)]
pub struct ContactMap {
    /// The heights of the map, at most [`MOST_POINTS`] along each axis.
    pub heights: HeightMap,
    /// Whether it is in contact in the sum, and not in the reference.
    pub is_of_sum: bool,
    pub loads: Vec<MapLoad>,
    /// Index of the load at which results are reported.
    pub reported: usize,
    /// What is in contact at each of them.
    pub patches: MapPatches,
}

#[derive(Debug)]
pub struct MapLoad {
    /// Nominal pressure, Pa.
    pub pressure: f64,
    pub area_ratio: f64,
    /// Number of contacts, in the sum.
    pub contacts: Option<usize>,
}

#[derive(Debug)]
pub enum MapPatches {
    /// Few asperities.
    Circles {
        /// Their places, the highest first, m.
        places: Vec<[f64; 2]>,
        /// At each load the contact radii of those in contact, m: (A/pi)^.5.
        radii: Vec<Vec<f64>>,
    },
    /// Many asperities, or the points of the reference.
    Cells {
        cells: [usize; 2],
        /// At each load how much of each cell is in contact, of 255, y fastest.
        covered: Vec<Vec<u8>>,
    },
}

/// Points of the picture along an axis.
pub const MOST_POINTS: usize = 256;
/// Asperities that are shown as circles.
const MOST_CIRCLES: usize = 1500;

/// What is in contact at a nominal pressure (Pa) in the reference.
pub type Covered = (f64, [usize; 2], Vec<u8>);

impl ContactMap {
    /// Of a case on a measured map at `most_loads` and the reported one: by the reference where it was run, else by the sum under `law`. `None` where neither was.
    pub fn new(
        surface: &Surface,
        prepared: &PreparedMap,
        case: &CaseStudy,
        law: &LawContact,
        covered: &[Covered],
        most_loads: usize,
    ) -> Option<Self> {
        if covered.is_empty() {
            Self::of_sum(surface, prepared, (case, law), most_loads)
        } else {
            Self::of_reference(prepared, case, covered, most_loads)
        }
    }

    fn of_reference(
        prepared: &PreparedMap,
        case: &CaseStudy,
        covered: &[Covered],
        most_loads: usize,
    ) -> Option<Self> {
        let curve = case.first().reference.as_ref()?;
        let all: Vec<(MapLoad, &Covered)> = covered
            .iter()
            .filter_map(|one| {
                Some((
                    MapLoad { pressure: one.0, area_ratio: curve.at_load(one.0)?.area_ratio, contacts: None },
                    one,
                ))
            })
            .collect();
        let (loads, reported) =
            chosen(case, all.iter().map(|(load, _)| load.pressure).collect(), most_loads)?;
        let chosen = all.into_iter().filter(|(load, _)| loads.contains(&load.pressure));
        let (loads, covered): (Vec<MapLoad>, Vec<&Covered>) = chosen.unzip();
        let patches = MapPatches::Cells {
            cells: covered.first()?.1,
            covered: covered.into_iter().map(|one| one.2.clone()).collect(),
        };
        Some(Self {
            heights: thumbnail(&*prepared.map, MOST_POINTS),
            is_of_sum: false,
            loads,
            reported,
            patches,
        })
    }

    fn of_sum(
        surface: &Surface,
        prepared: &PreparedMap,
        (case, law): (&CaseStudy, &LawContact),
        most_loads: usize,
    ) -> Option<Self> {
        let set = &surface.set;
        let points = curve(&case.first().comparison, ModelKind::Deterministic);
        let load = |point: &CurvePoint| {
            let pressure = point.prescribed_pressure.unwrap_or(point.response.pressure.total());
            MapLoad { pressure, area_ratio: point.response.area_ratio.total(), contacts: None }
        };
        let (loads, reported) =
            chosen(case, points.iter().map(|point| load(point).pressure).collect(), most_loads)?;
        let at_load = |wanted: &f64| points.iter().find(|point| load(point).pressure == *wanted);
        let points: Vec<&CurvePoint> = loads.iter().filter_map(at_load).copied().collect();
        let flat = |point: &CurvePoint| surface.plane.mean + point.response.separation;
        let lowest = points.iter().map(|point| flat(point)).reduce(f64::min)?;
        let mut touching: Vec<usize> =
            (0..set.count()).filter(|&asperity| set.heights()[asperity] > lowest).collect();
        touching.sort_by(|&a, &b| set.heights()[b].total_cmp(&set.heights()[a]));
        let ellipses = set.ellipses().filter(|_| law.spec.is_elliptic());
        let radius = |asperity: usize, w: f64| {
            let shape = ellipses.map_or(Shape::sphere(set.radii()[asperity]), |all| all[asperity].shape());
            (law.contact.contact(w, shape).area / PI).sqrt()
        };
        let radii = |point: &&CurvePoint| -> Vec<f64> {
            let indented = touching.iter().map(|&asperity| (asperity, set.heights()[asperity] - flat(point)));
            indented.take_while(|(_, w)| *w > 0.0).map(|(asperity, w)| radius(asperity, w)).collect()
        };
        let radii: Vec<Vec<f64>> = points.iter().map(radii).collect();
        let place = |&asperity: &usize| {
            let (position, columns) = (prepared.positions[asperity], prepared.map.points()[1]);
            let at = [position / columns, position % columns];
            [0, 1].map(|axis| (at[axis] as f64 + 0.5) * prepared.map.pixel()[axis])
        };
        let places: Vec<[f64; 2]> = touching.iter().map(place).collect();
        let heights = thumbnail(&*prepared.map, MOST_POINTS);
        let loads = points.iter().zip(&radii);
        Some(Self {
            is_of_sum: true,
            loads: loads
                .map(|(point, radii)| MapLoad { contacts: Some(radii.len()), ..load(point) })
                .collect(),
            reported,
            patches: if places.len() <= MOST_CIRCLES {
                MapPatches::Circles { places, radii }
            } else {
                let covered = radii.iter().map(|radii| covered_by(&heights, &places, radii)).collect();
                MapPatches::Cells { cells: heights.points(), covered }
            },
            heights,
        })
    }
}

/// How much of each point of a coarse map is covered by circles that are hardly larger than one, of 255.
fn covered_by(map: &HeightMap, places: &[[f64; 2]], radii: &[f64]) -> Vec<u8> {
    let ([rows, columns], pixel) = (map.points(), map.pixel());
    let mut covered = vec![0.0; rows * columns];
    for (place, radius) in places.iter().zip(radii) {
        let at = [0, 1].map(|axis| ((place[axis] / pixel[axis]) as usize).min(map.points()[axis] - 1));
        covered[at[0] * columns + at[1]] += PI * radius * radius / (pixel[0] * pixel[1]);
    }
    covered.into_iter().map(|share: f64| (255.0 * share).ceil().min(255.0) as u8).collect()
}

/// Some of the loads at which a contact is known, the admissible ones where there are such, and the index of the reported one, or of
/// the middle one where that is not among them.
fn chosen(case: &CaseStudy, mut all: Vec<f64>, most: usize) -> Option<(Vec<f64>, usize)> {
    let stretches = &case.verdicts.admissible.stretches;
    let is_admissible = |load: &f64| stretches.iter().any(|[from, to]| (*from..=*to).contains(load));
    if all.iter().any(is_admissible) {
        all.retain(is_admissible);
    }
    all.sort_by(f64::total_cmp);
    all.dedup();
    let reported = case.reported_load().map(|at| at.load).filter(|load| all.contains(load));
    let reported = reported.or_else(|| all.get(all.len() / 2).copied())?;
    let mut loads = spread_over(&all, most);
    if !loads.contains(&reported) {
        loads.push(reported);
        loads.sort_by(f64::total_cmp);
    }
    let index = loads.iter().position(|&load| load == reported)?;
    Some((loads, index))
}

/// How much of each of at most [`MOST_POINTS`] cells along each axis is in contact, of 255, from pressures with y running fastest.
pub fn covered(pressures: &[f64], points: [usize; 2]) -> ([usize; 2], Vec<u8>) {
    let block = points.map(|count| count.div_ceil(MOST_POINTS));
    let cells = [0, 1].map(|axis| points[axis].div_ceil(block[axis]));
    let mut counts = vec![[0_u32; 2]; cells[0] * cells[1]];
    for (row, line) in pressures.chunks(points[1]).enumerate() {
        for (column, &pressure) in line.iter().enumerate() {
            let [touching, all] = &mut counts[row / block[0] * cells[1] + column / block[1]];
            *touching += u32::from(pressure > 0.0);
            *all += 1;
        }
    }
    (cells, counts.into_iter().map(|[touching, all]| (touching * 255).div_ceil(all) as u8).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_covered_by_the_share_of_their_points_in_contact() {
        // Twice as many points along x as there are cells.
        let points = [2 * MOST_POINTS, 3];
        let mut pressures = vec![0.0; points[0] * points[1]];
        pressures[0] = 1.0;
        pressures[3 + 1] = 1.0;
        pressures[1] = 2.0;
        let (cells, covered) = super::covered(&pressures, points);
        assert_eq!(cells, [MOST_POINTS, 3]);
        assert_eq!(&covered[..4], [128, 255, 0, 0]);
        assert!(covered[4..].iter().all(|&one| one == 0));
    }

    #[test]
    fn circles_cover_the_cells_that_they_lie_in() {
        let map = HeightMap::new([3, 3], [1.0; 2], vec![0.0; 9], 0.0).unwrap();
        let places = [[0.5, 1.5], [0.4, 1.6], [1.5, 2.5], [1.5, 0.5]];
        let half = (0.5 / PI).sqrt();
        assert_eq!(covered_by(&map, &places, &[half, half, 1e-3]), [0, 255, 0, 0, 0, 1, 0, 0, 0]);
    }
}
