//! Three columns of text: x, y and z of the points of a regular grid, in any order, x and y in one unit.
//!
//! The lines of the grid are determined from the coordinates, which may be rounded: a point may be up to a fifth of a
//! pixel off its line. Grid points that are not in the file are missing.

use super::content::{Measured, Metadata};
use super::error::ReadError;
use crate::numeric::sort::sort;
use crate::numeric::{LARGEST, is_positive};
use crate::progress::{Count, Progress, Share};

/// The largest distance of a point from its line of the grid, pixels.
const TOLERANCE: f64 = 0.2;
/// The largest number of grid places per point of the file.
const SPARSEST: usize = 4;

/// The grid of a file that states it, as [`write`](super::super::write) does: `# Grid: 128 x 96 points, 8e-7 x 8e-7`. Its first point is at zero.
pub(super) struct Grid {
    axes: [Axis; 2],
}

impl Grid {
    /// The grid that a comment states; `None` where there is none.
    pub(super) fn parse(text: &str) -> Result<Option<Self>, ReadError> {
        let comments = text.lines().map_while(|line| line.trim().strip_prefix('#'));
        let stated = comments.filter_map(|line| line.trim().strip_prefix("Grid:"));
        // A comment of another program may have this name, too.
        let Some(stated) = stated.map(str::trim).find(|stated| stated.contains(" points, ")) else {
            return Ok(None);
        };
        let both = |part: &str| {
            let (x, y) = part.split_once(" x ")?;
            Some([x.trim().to_owned(), y.trim().to_owned()])
        };
        let axes = stated.split_once(" points, ").and_then(|(points, pixel)| {
            let [[nx, ny], [dx, dy]] = [both(points)?, both(pixel)?];
            let axis = |count: &str, step: &str| {
                let (count, step) =
                    (count.parse().ok()?, step.parse().ok().filter(|&step| is_positive(step))?);
                Some(Axis { first: 0.0, step, count })
            };
            Some([axis(&nx, &dx)?, axis(&ny, &dy)?])
        });
        axes.map(|axes| Some(Self { axes })).ok_or_else(|| {
            corrupt!("has the grid \"{stated}\"; allowed: such as \"128 x 96 points, 8e-7 x 8e-7\", or no line of this name")
        })
    }
}

/// The map of points given as triples in `values`, in the unit of the file; on the grid that the file states, or on the one that is found:
/// one unit of work.
pub(super) fn measured(
    values: &[f64],
    stated: Option<Grid>,
    precision: f64,
    progress: &dyn Progress,
) -> Result<Measured, ReadError> {
    let (points, _) = values.as_chunks::<3>();
    let count = |work: f64| Count::new(progress, work, points.len());
    let mut checked = count(0.1);
    for (row, point) in (1..).zip(points) {
        checked.add(1);
        if let Some(found) = point[..2].iter().find(|value| value.is_nan() || value.abs() > LARGEST) {
            return Err(corrupt!(
                "point {row} of {}: found the coordinate {found}; allowed: a finite number",
                points.len()
            ));
        }
    }
    checked.end();
    let is_stated = stated.is_some();
    let of_axis = &Share { progress, units: 0.3 };
    let [x, y] = match stated {
        Some(Grid { axes }) => axes,
        None => [
            Axis::find("x", points.iter().map(|point| point[0]).collect(), of_axis)?,
            Axis::find("y", points.iter().map(|point| point[1]).collect(), of_axis)?,
        ],
    };
    let most = points.len().saturating_mul(SPARSEST);
    let size = x.count.checked_mul(y.count).filter(|&size| size <= most).ok_or_else(|| {
        no_grid(&format!(
            "{} points on {} lines along x and {} along y, more than three in four missing",
            points.len(),
            x.count,
            y.count
        ))
    })?;
    let mut heights = vec![f64::NAN; size];
    let mut seen = vec![false; size];
    let mut placed = count(if is_stated { 0.9 } else { 0.3 });
    for &[px, py, z] in points {
        placed.add(1);
        if is_stated && !(x.holds(px) && y.holds(py)) {
            return Err(no_grid(&format!("the point {px} {py} beside the grid that its head states")));
        }
        let place = x.line(px) * y.count + y.line(py);
        let (Some(height), Some(seen)) = (heights.get_mut(place), seen.get_mut(place)) else {
            return Err(no_grid(&format!("the point {px} {py} outside")));
        };
        if std::mem::replace(seen, true) {
            return Err(no_grid(&format!("two points at {px} {py}")));
        }
        *height = z;
    }
    placed.end();
    let metadata = Metadata {
        pixel: Some([x.step, y.step]),
        ..Metadata::new([x.count, y.count], "a text of x, y and z")
    };
    Ok(Measured { metadata, heights, scale: 1.0, offset: 0.0, precision })
}

fn no_grid(found: &str) -> ReadError {
    unsupported!(
        "holds three columns that are no points x y z of a regular grid: {found}; allowed: every point \
         within {TOLERANCE} of a pixel of a line, one point a place (or a matrix of heights that is not \
         three wide)"
    )
}

/// Equidistant lines of a grid.
struct Axis {
    first: f64,
    step: f64,
    count: usize,
}

impl Axis {
    /// Finds the lines that all `positions` lie on. Rounded positions of one line are first clustered by a trial
    /// distance, which is increased until equidistant lines result. One unit of work.
    fn find(name: &str, mut positions: Vec<f64>, progress: &dyn Progress) -> Result<Self, ReadError> {
        sort(&mut positions, progress);
        let (Some(&first), Some(&last)) = (positions.first(), positions.last()) else {
            return Err(no_grid("no point"));
        };
        if last <= first {
            return Err(no_grid(&format!("all at {name} = {first}")));
        }
        let trials = (1..=12).rev().map(|power| 0.1f64.powi(power) * (last - first));
        let mut found = trials.filter_map(|distance| Self::with_lines(&positions, distance));
        found.next().ok_or_else(|| no_grid(&format!("no equidistant lines along {name}")))
    }

    fn with_lines(positions: &[f64], distance: f64) -> Option<Self> {
        let lines: Vec<f64> = positions
            .chunk_by(|a, b| b - a <= distance)
            .map(|line| line.iter().map(|x| x / line.len() as f64).sum())
            .collect();
        let (&first, &last) = (lines.first()?, lines.last()?);
        // Gaps close to the smallest are mostly one step; their median is the first estimate.
        let mut gaps: Vec<f64> = lines.windows(2).map(|pair| pair[1] - pair[0]).collect();
        gaps.sort_unstable_by(f64::total_cmp);
        let smallest = *gaps.first()?;
        let single = gaps.partition_point(|&gap| gap < 1.5 * smallest);
        let estimate = *gaps.get(single / 2)?;
        let steps: f64 = lines.windows(2).map(|pair| ((pair[1] - pair[0]) / estimate).round()).sum();
        // A stray point would result in a finer grid of mostly empty lines.
        if steps.is_nan() || steps >= 2.0 * lines.len() as f64 {
            return None;
        }
        let step = (last - first) / steps;
        let axis = Self { first, step, count: steps as usize + 1 };
        let beside = |x: &f64| ((x - first) / step - ((x - first) / step).round()).abs();
        positions.iter().all(|x| beside(x) <= TOLERANCE).then_some(axis)
    }

    /// Whether `x` lies on a line.
    fn holds(&self, x: f64) -> bool {
        let line = (x - self.first) / self.step;
        (line - line.round()).abs() <= TOLERANCE && (0.0..self.count as f64).contains(&line.round())
    }

    /// The index of the line that `x` lies on.
    fn line(&self, x: f64) -> usize {
        ((x - self.first) / self.step).round() as usize
    }
}
