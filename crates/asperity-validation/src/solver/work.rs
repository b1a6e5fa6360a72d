//! Steps and convolutions of the solver against the number of points.

use asperity::bem::{Boundary, Options, Solver};
use asperity::progress::{Progress, Silent};

use super::{SelfAffine, Unsolved, unit_pair};

/// Points per shortest wave of the maps.
pub const POINTS_PER_WAVE: f64 = 8.0;

/// The input.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkTask {
    /// Points along a side, ascending.
    pub points: Vec<usize>,
    /// p/(E* g).
    pub pressures: Vec<f64>,
    /// Relative dual gap.
    pub error: f64,
}

/// One contact.
#[derive(Debug, Clone, PartialEq)]
pub struct WorkPoint {
    /// Points along a side.
    pub points: usize,
    /// p/(E* g).
    pub pressure: f64,
    /// Corrected area ratio.
    pub area: f64,
    /// Steps on the finest grid.
    pub steps: usize,
    /// Convolutions on the finest grid.
    pub convolutions: usize,
    /// Relative dual gap reached.
    pub error: f64,
}

impl WorkTask {
    /// A surface whose waves reach from the side to 8 points; g = 1.
    pub fn process(points: usize) -> SelfAffine {
        let cut_off = POINTS_PER_WAVE / points as f64;
        SelfAffine { side: 1.0, hurst: 0.8, roll_off: 1.0, cut_off, gradient: 1.0, elongation: 1.0 }
    }
}

/// The work of each contact. One unit of progress for each.
///
/// # Errors
/// See [`Unsolved`].
pub fn work(task: &WorkTask, seed: [u8; 32], progress: &dyn Progress) -> Result<Vec<WorkPoint>, Unsolved> {
    let pair = unit_pair()?;
    let options = Options { boundary: Boundary::Periodic, error: task.error, cap: None };
    let mut contacts = Vec::new();
    for &points in &task.points {
        let map = WorkTask::process(points).surface(points, seed)?;
        let solver = Solver::new(&map, &pair, &options)?;
        for &pressure in &task.pressures {
            let contact = solver.at_pressure(pressure, &Silent)?;
            contacts.push(WorkPoint {
                points,
                pressure,
                area: contact.area_ratio(),
                steps: contact.steps,
                convolutions: contact.convolutions,
                error: contact.error,
            });
            progress.advance(1.0);
        }
    }
    Ok(contacts)
}
