//! Errors by the grid against the bounds that the reference states: the same waves on coarser grids and on a fine one.

use asperity::HeightMap;
use asperity::bem::{Boundary, GridError, Options, Solver};
use asperity::named_enum;
use asperity::progress::{Progress, Silent};

use super::{SelfAffine, Unsolved, unit_pair};

/// Points of the fine grid per shortest wave.
pub const FINE: usize = 32;

/// Elongation of the surfaces with a lay.
pub const ELONGATION: f64 = 3.0;

/// The cap over E* g.
pub const CAP: f64 = 0.2;

/// The part of the contacts whose error may exceed its bound.
pub const MAY_EXCEED: f64 = 0.05;

/// Points per shortest wave along x and y: square pixels, and pixels elongated along either axis.
pub const GRIDS: [[usize; 2]; 7] = [[8, 8], [4, 4], [2, 2], [8, 2], [2, 8], [16, 4], [4, 16]];

named_enum! {
    /// The surfaces and their contact.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum GridCase {
        /// Isotropic, elastic, periodic.
        Isotropic = "isotropic",
        /// Elongated along x, elastic, periodic.
        Elongated = "elongated",
        /// A quarter of an isotropic surface, mirrored, elastic.
        Mirrored = "mirrored",
        /// A quarter of an elongated surface, mirrored, elastic.
        MirroredElongated = "mirrored elongated",
        /// Isotropic, with a cap, periodic.
        Capped = "capped",
    }
}

impl GridCase {
    const fn boundary(self) -> Boundary {
        match self {
            Self::Mirrored | Self::MirroredElongated => Boundary::Mirrored,
            Self::Isotropic | Self::Elongated | Self::Capped => Boundary::Periodic,
        }
    }

    const fn elongation(self) -> f64 {
        if matches!(self, Self::Elongated | Self::MirroredElongated) { ELONGATION } else { 1.0 }
    }
}

/// The input.
#[derive(Debug, Clone, PartialEq)]
pub struct GridTask {
    /// Points along a side of the fine grid.
    pub points: usize,
    /// Surfaces of each case.
    pub realisations: usize,
    /// p/(E* g).
    pub pressures: Vec<f64>,
    /// Relative dual gap.
    pub error: f64,
}

/// Errors and bounds of one quantity over surfaces and loads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridCheck {
    /// Contacts whose error exceeds its bound.
    pub exceeded: usize,
    /// The error that 95 % of the contacts do not exceed.
    pub error: f64,
    /// Mean of the bounds.
    pub bound: f64,
}

impl GridCheck {
    /// From the error and the bound of each contact.
    fn new(contacts: &[[f64; 2]]) -> Self {
        let mut errors: Vec<f64> = contacts.iter().map(|[error, _]| error.abs()).collect();
        errors.sort_by(f64::total_cmp);
        let within = ((1.0 - MAY_EXCEED) * errors.len() as f64).ceil() as usize;
        Self {
            exceeded: contacts.iter().filter(|[error, bound]| error.abs() > *bound).count(),
            error: errors[within.max(1) - 1],
            bound: contacts.iter().map(|[_, bound]| bound).sum::<f64>() / contacts.len() as f64,
        }
    }
}

/// One case on one grid.
#[derive(Debug, Clone, PartialEq)]
pub struct GridPoint {
    /// The case.
    pub case: GridCase,
    /// Points per shortest wave along x and y.
    pub points: [usize; 2],
    /// Surfaces times loads.
    pub contacts: usize,
    /// Of ln(corrected area), of the mean gap over the r.m.s. height, of ln(stiffness).
    pub checks: [GridCheck; 3],
}

/// ln(area), mean gap over r.m.s. height and ln(stiffness), with the bounds of their errors.
type Sample = [[f64; 2]; 3];

impl GridTask {
    /// The surfaces of a case; g = 1.
    pub fn process(&self, case: GridCase) -> SelfAffine {
        // A little longer than 32 points: two points per wave are just more than enough.
        let cut_off = 1.04 * FINE as f64 / self.points as f64;
        SelfAffine {
            side: 1.0,
            hurst: 0.8,
            roll_off: 0.25,
            cut_off,
            gradient: 1.0,
            elongation: case.elongation(),
        }
    }

    /// `None` where no point may change its pressure.
    fn samples(&self, map: &HeightMap, case: GridCase, height: f64) -> Result<Vec<Option<Sample>>, Unsolved> {
        let pair = unit_pair()?;
        let cap = (case == GridCase::Capped).then_some(CAP);
        let options = Options { boundary: case.boundary(), error: self.error, cap };
        let solver = Solver::new(map, &pair, &options)?;
        let sample = |&pressure: &f64| -> Result<Option<Sample>, Unsolved> {
            let contact = solver.at_pressure(pressure, &Silent)?;
            let bounds = GridError::new(&contact);
            let Some(tangent) = solver.tangent(&contact) else { return Ok(None) };
            let stiffness = tangent.stiffness();
            Ok(Some([
                [contact.area_ratio().ln(), bounds.area],
                [contact.mean_gap() / height, bounds.load * pressure / stiffness / height],
                [stiffness.ln(), bounds.stiffness],
            ]))
        };
        self.pressures.iter().map(sample).collect()
    }
}

/// Errors and bounds of each case on each grid. One unit of progress for each surface.
///
/// # Errors
/// See [`Unsolved`].
pub fn grid_errors(
    task: &GridTask,
    seed: impl Fn(usize) -> [u8; 32],
    progress: &dyn Progress,
) -> Result<Vec<GridPoint>, Unsolved> {
    let mut points = Vec::new();
    for case in GridCase::ALL {
        let mut contacts: Vec<[Vec<[f64; 2]>; 3]> = vec![Default::default(); GRIDS.len()];
        for realisation in 0..task.realisations {
            let surface = task.process(case).surface(2 * task.points, seed(realisation))?;
            let fine = centres(&surface, case, [1, 1])?;
            let height = rms(fine.heights());
            let exact = task.samples(&fine, case, height)?;
            for (contacts, grid) in contacts.iter_mut().zip(GRIDS) {
                let coarse = centres(&surface, case, grid.map(|points| FINE / points))?;
                let found = task.samples(&coarse, case, height)?;
                for (found, exact) in found.iter().zip(&exact) {
                    let Some((found, exact)) = found.as_ref().zip(exact.as_ref()) else { continue };
                    for (quantity, contacts) in contacts.iter_mut().enumerate() {
                        let [value, bound] = found[quantity];
                        contacts.push([value - exact[quantity][0], bound]);
                    }
                }
            }
            progress.advance(1.0);
        }
        let on_grid = contacts.iter().zip(GRIDS).filter(|(contacts, _)| !contacts[0].is_empty());
        points.extend(on_grid.map(|(contacts, grid)| GridPoint {
            case,
            points: grid,
            contacts: contacts[0].len(),
            checks: [0, 1, 2].map(|quantity| GridCheck::new(&contacts[quantity])),
        }));
    }
    Ok(points)
}

fn rms(heights: &[f64]) -> f64 {
    (heights.iter().map(|z| z * z).sum::<f64>() / heights.len() as f64).sqrt()
}

/// The map of a case whose pixels are `steps` pixels of the fine grid, from a surface on twice as many points as that: pixels
/// of all sizes fill the same rectangle, which heights at their centres need points between those of the fine grid.
fn centres(surface: &HeightMap, case: GridCase, steps: [usize; 2]) -> Result<HeightMap, Unsolved> {
    let [nx, ny] = surface.points();
    let part = if case.boundary() == Boundary::Mirrored { 2 } else { 1 };
    let points = [nx / (2 * part * steps[0]), ny / (2 * part * steps[1])];
    let centre = |pixel: usize, axis: usize| (2 * pixel + 1) * steps[axis];
    let row = |i: usize| (0..points[1]).map(move |j| surface.heights()[centre(i, 0) * ny + centre(j, 1)]);
    let heights = (0..points[0]).flat_map(row).collect();
    let pixel = [0, 1].map(|axis| surface.pixel()[axis] * (2 * steps[axis]) as f64);
    let map = HeightMap::new(points, pixel, heights, 0.0)?;
    Ok(if part == 1 { map.periodic() } else { map })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_twentieth_of_the_errors_may_be_larger() {
        let contacts: Vec<[f64; 2]> = (1..=40).map(|k| [-0.01 * f64::from(k), 0.385]).collect();
        let check = GridCheck::new(&contacts);
        assert_eq!(check.exceeded, 2);
        assert!((check.error - 0.38).abs() < 1e-15 && (check.bound - 0.385).abs() < 1e-15);
        assert_eq!(GridCheck::new(&contacts[..1]).error, 0.01);
    }
}
