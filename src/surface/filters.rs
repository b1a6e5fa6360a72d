//! Filters that a map is too coarse for, and those that memory must hold.

use asperity::surface::usual_long_filter;
use asperity::topography::Filter;
use asperity_contact_framework::report::format::input_quantity;

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
