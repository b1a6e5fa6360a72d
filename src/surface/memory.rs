//! Estimates of the memory that surfaces need, and filters that a map is too coarse for.

use asperity::surface::{AnalysisDepth, MOST_ANALYSED_POINTS, usual_long_filter};
use asperity::topography::Filter;
use asperity_contact_framework::report::format::input_quantity;
use asperity_contact_framework::{Memory, set_memory};

use super::files::is_copied;
use super::plan::{MapPlan, Origin, SurfacePlan};

impl SurfacePlan {
    /// What its file takes as long as another surface needs it too, bytes.
    pub fn kept_file(&self) -> u128 {
        const BYTES_PER_POINT: u128 = 8;
        const BYTES_PER_ROW: u128 = 32;
        match &self.origin {
            Origin::List { .. } => self.most_asperities() * BYTES_PER_ROW,
            Origin::Map(map) if !map.is_on_disk || is_copied(map.points) => {
                area(map.points) * BYTES_PER_POINT
            }
            _ => 0,
        }
    }

    pub fn most_asperities(&self) -> u128 {
        /// Four neighbours cannot all be summits.
        const POINTS_PER_SUMMIT: u128 = 2;
        match &self.origin {
            Origin::List { rows, .. } => *rows as u128,
            Origin::Population { count, .. } => *count as u128,
            Origin::Generated(generation) => area(generation.points()) / POINTS_PER_SUMMIT,
            Origin::Map(map) => area(map.points) / POINTS_PER_SUMMIT,
            Origin::Pair(pair) => area(pair.grid().0) / POINTS_PER_SUMMIT,
        }
    }

    /// An estimate of the memory that it needs at its peak, bytes, with as many summits as a rough surface has: on
    /// noise there are twice as many. `is_treated` is whether other treatments of a measured map are examined.
    pub fn memory(&self, depth: AnalysisDepth, is_treated: bool) -> u128 {
        /// A map that is read at once and transposed.
        const BYTES_PER_READ_POINT: u128 = 32;
        /// The transforms of an autocorrelation, over one and a half times the side of an open map.
        const BYTES_PER_ANALYSED_POINT: u128 = 96;
        /// A copy of a random surface, which its spectrum is made from.
        const BYTES_PER_POINT_OF_SPECTRUM: u128 = 8;
        const BYTES_PER_HEIGHT: u128 = 8;
        /// Both erosions of a map by a tip, with the apexes of each.
        const BYTES_PER_ERODED_POINT: u128 = 72;
        /// What is found of a summit, room for a fifth more, and the models' copies.
        const BYTES_PER_SUMMIT: u128 = 200;
        /// Its curvatures, and the ordered copy of the spheres that stand for it.
        const BYTES_PER_ELLIPSE: u128 = 64;
        /// Of an asperity of a list or population where both models are compared: halves, smoothed heights, and the
        /// sets of the causes. All together are 220 bytes as measured on 10^7 asperities.
        const BYTES_COMPARED: u128 = 160;
        let summits = self.likely_asperities() * BYTES_PER_SUMMIT;
        match &self.origin {
            Origin::Map(map) => {
                let &MapPlan { points, read, pixel, is_on_disk, preparation, fit, .. } = &**map;
                let filtering = |filter: Filter| filter.memory(points, pixel);
                let own = match fit {
                    None => preparation.filter.map_or(0, filtering),
                    // The map as it was, and filters that are tried.
                    Some(_) => area(points) * BYTES_PER_HEIGHT + longest(points, pixel).map_or(0, filtering),
                };
                let treated = self.short_filter().filter(|_| is_treated).map_or(0, filtering);
                let is_analysed =
                    depth == AnalysisDepth::Everything && area(points) <= MOST_ANALYSED_POINTS as u128;
                let analysis = if is_analysed { area(points) * BYTES_PER_ANALYSED_POINT } else { 0 };
                // The map as read stays until its last treatment.
                let raw = if is_on_disk && !is_copied(points) { 0 } else { area(points) };
                let reading = if is_on_disk { 0 } else { read as u128 * BYTES_PER_READ_POINT };
                let eroding =
                    if preparation.tip.is_some() { area(points) * BYTES_PER_ERODED_POINT } else { 0 };
                reading.max(raw * BYTES_PER_HEIGHT + own.max(treated) + analysis + eroding) + summits
            }
            Origin::Generated(generation) => {
                let depth = match depth {
                    AnalysisDepth::Everything => BYTES_PER_ANALYSED_POINT,
                    _ => BYTES_PER_POINT_OF_SPECTRUM,
                };
                area(generation.points()) * (BYTES_PER_HEIGHT * generation.arrays() + depth) + summits
            }
            Origin::Pair(pair) => {
                let bodies = pair.bodies.iter().map(|body| body.memory(AnalysisDepth::Asperities, false));
                let kept = pair.bodies.iter().filter_map(Self::map_points).map(area).sum::<u128>();
                let is_analysed = depth == AnalysisDepth::Everything;
                let analysis = if is_analysed { BYTES_PER_ANALYSED_POINT } else { 0 };
                let sum = area(pair.grid().0) * (BYTES_PER_HEIGHT + analysis);
                bodies.max().unwrap_or(0).max(sum) + kept * BYTES_PER_HEIGHT + summits
            }
            _ => {
                let ellipses = if self.as_ellipses { BYTES_PER_ELLIPSE } else { 0 };
                let compared = if depth == AnalysisDepth::Asperities { 0 } else { BYTES_COMPARED };
                set_memory(self.most_asperities()) + self.most_asperities() * (ellipses + compared)
            }
        }
    }

    /// The S filters that other treatments of a measured map have: of a few pixels, before its own L filter.
    fn short_filter(&self) -> Option<Filter> {
        const PIXELS: f64 = 2.0;
        let Origin::Map(map) = &self.origin else { return None };
        let l = map.preparation.filter.and_then(|filter| filter.l());
        Filter::new(Some(PIXELS * map.pixel[0].max(map.pixel[1])), l).ok()
    }

    /// An estimate of the bytes of its asperities, which are kept for the report.
    pub fn kept(&self) -> u128 {
        const BYTES_PER_ASPERITY: u128 = 16;
        const BYTES_PER_ELLIPSE: u128 = 16;
        let ellipses = if self.as_ellipses { BYTES_PER_ELLIPSE } else { 0 };
        self.likely_asperities() * (BYTES_PER_ASPERITY + ellipses)
    }

    /// As many asperities as a rough surface of its size has.
    fn likely_asperities(&self) -> u128 {
        const POINTS_PER_SUMMIT: u128 = 10;
        match &self.origin {
            Origin::Generated(generation) => area(generation.points()) / POINTS_PER_SUMMIT,
            Origin::Map(map) => area(map.points) / POINTS_PER_SUMMIT,
            Origin::Pair(pair) => area(pair.grid().0) / POINTS_PER_SUMMIT,
            Origin::List { .. } | Origin::Population { .. } => self.most_asperities(),
        }
    }
}

/// An estimate of the memory that surfaces need, analysed to `depth`: the asperities of each are kept for the report, one map
/// at a time and those that are needed again. `is_treated` is whether other treatments of measured maps are examined.
pub fn memory(surfaces: &[SurfacePlan], depth: AnalysisDepth, is_treated: bool) -> Memory {
    let readings: Vec<_> = surfaces.iter().map(SurfacePlan::readings).collect();
    let again =
        |k: usize| readings[k].iter().any(|one| readings[k + 1..].iter().any(|later| later.contains(one)));
    let kept = surfaces.iter().enumerate();
    let kept: u128 =
        kept.map(|(k, surface)| surface.kept() + if again(k) { surface.kept_file() } else { 0 }).sum();
    let largest = surfaces.iter().max_by_key(|surface| surface.memory(depth, is_treated));
    Memory {
        bytes: kept + largest.map_or(0, |surface| surface.memory(depth, is_treated)),
        key: largest.map(|surface| surface.size_key.clone()),
    }
}

fn area([nx, ny]: [usize; 2]) -> u128 {
    nx as u128 * ny as u128
}

/// Refuses an L filter that leaves waves of a few points only.
pub fn check_long(filter: Filter, points: [usize; 2], pixel: [f64; 2]) -> Result<(), String> {
    /// Of its nesting index, pixels.
    const FEWEST: f64 = 4.0;
    let least = FEWEST * pixel[0].max(pixel[1]);
    let Some(l) = filter.l().filter(|l| *l < least) else { return Ok(()) };
    let usual = usual_long_filter([0, 1].map(|axis| points[axis] as f64 * pixel[axis]));
    let is_possible = usual >= least;
    let [l, apart, least, usual] =
        [l, pixel[0].max(pixel[1]), least, usual].map(|length| input_quantity(length, "m"));
    let usually = match is_possible {
        true => format!("usually a sixth of the shorter side ({usual})"),
        false => "or none: the map has too few points for one".to_owned(),
    };
    Err(format!(
        "found an L filter of {l}, which removes all waves longer than that and so the roughness: the points are {apart} apart; allowed: \
         at least {FEWEST} pixels ({least}), {usually}"
    ))
}

/// Warns of an S filter that is shorter than any wave of a map.
pub fn short_caveat(filter: Filter, pixel: [f64; 2]) -> Option<String> {
    /// Of the shortest wave that a map holds, pixels.
    const SHORTEST: f64 = 2.0;
    let shortest = SHORTEST * pixel[0].min(pixel[1]);
    let s = filter.s().filter(|s| *s < shortest)?;
    let [s, shortest, enough] = [s, shortest, 2.0 * shortest].map(|length| input_quantity(length, "m"));
    Some(format!(
        "its S filter of {s} has hardly any effect: the shortest wave that its points can hold is {shortest} long (two pixels); an S filter \
         of at least four pixels, {enough}, removes noise."
    ))
}

/// Filters as long as any that a fit tries.
pub fn longest(points: [usize; 2], pixel: [f64; 2]) -> Option<Filter> {
    const SHORT_PIXELS: f64 = 4.0;
    let side = [0, 1].map(|axis| points[axis] as f64 * pixel[axis]);
    Filter::new(Some(SHORT_PIXELS * pixel[0].max(pixel[1])), Some(0.5 * side[0].min(side[1]))).ok()
}
