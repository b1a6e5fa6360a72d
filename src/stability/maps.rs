//! Errors over a plane: where in it the arithmetic is good, and where it is not.

use rayon::prelude::*;

use super::Ranges;
use super::bodies::{Bodies, Law, Layer};
use super::exact::{Exact, Integral, Shape};
use crate::asperity::{HeightDensity, Population};
use crate::coating::Rule;
use crate::law;
use crate::material::{Material, reduced_modulus};
use crate::model::{Model, Statistical};
use crate::numeric::wide::relative_error;

/// Errors on a regular grid.
#[derive(Debug, Clone)]
pub struct Map {
    /// Of its file and in its table.
    pub name: &'static str,
    /// What the error is of.
    pub of: &'static str,
    /// What stands along x and y; logarithms to the base of ten where they say so.
    pub axes: [&'static str; 2],
    /// Middles of the first and the last column, of the first and the last row.
    pub ends: [[f64; 2]; 2],
    /// Columns and rows.
    pub cells: [usize; 2],
    /// Relative errors, x fastest; NaN where the wide rule does not settle.
    pub errors: Vec<f64>,
}

impl Map {
    fn of(
        name: &'static str,
        of: &'static str,
        axes: [&'static str; 2],
        ends: [[f64; 2]; 2],
        cells: [usize; 2],
        error: impl Fn(f64, f64) -> f64 + Sync,
    ) -> Self {
        let place = |k: usize, axis: usize| {
            let [from, to] = ends[axis];
            from + (to - from) * k as f64 / (cells[axis] - 1) as f64
        };
        let errors = (0..cells[0] * cells[1])
            .into_par_iter()
            .map(|k| error(place(k % cells[0], 0), place(k / cells[0], 1)))
            .collect();
        Self { name, of, axes, ends, cells, errors }
    }
}

/// Steel of the paper.
fn body(young: f64, hardness: f64) -> Material {
    match Material::new(young, 0.3, Some(hardness), None) {
        Ok(body) => body,
        Err(_) => unreachable!("the ranges of a map are those of materials"),
    }
}

const ZMC: Law = Law::Zmc { onset: None, transition_ratio: 54.0 };
const YOUNG: f64 = 210e9;

/// All maps; `resolution` columns each.
pub(super) fn maps(ranges: &Ranges, resolution: usize) -> Vec<Map> {
    vec![separations(ranges, resolution), transitions(resolution), layers(ranges, resolution)]
}

/// d/sigma and radius/sigma: the integral of a bare pair.
fn separations(ranges: &Ranges, resolution: usize) -> Map {
    const SIGMA: f64 = 1e-7;
    let steel = body(YOUNG, 7.6e9);
    let bodies = Bodies { law: ZMC, rough: steel, flat: steel, layer: None };
    let (exact, contact) = (Exact::new(&bodies), bodies.contact());
    Map::of(
        "separation",
        "nominal pressure of the integral",
        ["d/σ", "log₁₀ R/σ"],
        [ranges.separation, ranges.radius_over_sigma.map(f64::log10)],
        [resolution, resolution / 2],
        |h, ratio| {
            let radius = SIGMA * 10f64.powf(ratio);
            let heights = HeightDensity::Gaussian;
            let population = Population { radius, sigma: SIGMA, density: 0.03 / (radius * SIGMA), heights };
            let Ok(contact) = &contact else { return f64::NAN };
            let found = Statistical::new(&**contact, population).respond(h).pressure.total();
            let of = Integral { sigma: SIGMA, density: population.density, heights, separation: h };
            let of = exact.integral(&of, &Shape::sphere(radius));
            of.map_or(f64::NAN, |of| relative_error(found, of.whole_load()))
        },
    )
}

/// w/w1 and c - 1: one contact of a bare pair.
fn transitions(resolution: usize) -> Map {
    const RADIUS: f64 = 2e-5;
    let steel = body(YOUNG, 7.6e9);
    let strain = 7.6e9 / reduced_modulus(&steel, &steel);
    let onset = 0.09 * std::f64::consts::PI.powi(2) * RADIUS * strain * strain;
    Map::of(
        "transition",
        "load of a contact under ZMC",
        ["log₁₀ w/w₁", "log₁₀ (c − 1)"],
        [[-2.0, 7.0], [-6.0, 6.0]],
        [2 * resolution, resolution],
        |place, width| {
            let law = Law::Zmc { onset: None, transition_ratio: 1.0 + 10f64.powf(width) };
            let bodies = Bodies { law, rough: steel, flat: steel, layer: None };
            contact_error(&bodies, onset * 10f64.powf(place), RADIUS)
        },
    )
}

/// t/a and H/E*: one contact under a layer, a tenth as stiff and as hard as the flat.
fn layers(ranges: &Ranges, resolution: usize) -> Map {
    const RADIUS: f64 = 2e-5;
    const DEPTH: f64 = 2e-8;
    let contact = (RADIUS * DEPTH).sqrt();
    let modulus = reduced_modulus(&body(YOUNG, 1.0), &body(YOUNG, 1.0));
    let ends = ranges.thickness.map(|thickness| (thickness / contact).log10());
    Map::of(
        "layer",
        "load of a contact under a layer",
        ["log₁₀ t/a", "log₁₀ H/E*"],
        [ends, ranges.hardness_over_modulus.map(f64::log10)],
        [2 * resolution, resolution],
        |thickness, strain| {
            let hardness = modulus * 10f64.powf(strain);
            let flat = body(YOUNG, hardness);
            let material = body(0.1 * YOUNG, 0.1 * hardness);
            let layer = Layer { material, thickness: contact * 10f64.powf(thickness), rule: Rule::Gao };
            contact_error(&Bodies { law: ZMC, rough: flat, flat, layer: Some(layer) }, DEPTH, RADIUS)
        },
    )
}

/// Of the load; the least over the sides of a boundary.
fn contact_error(bodies: &Bodies, w: f64, radius: f64) -> f64 {
    let Ok(contact) = bodies.contact() else { return f64::NAN };
    let found = contact.contact(w, law::Shape::sphere(radius)).load;
    let exact = Exact::new(bodies).contacts(w, &Shape::sphere(radius));
    exact.iter().map(|side| relative_error(found, side.load)).fold(f64::INFINITY, f64::min)
}
