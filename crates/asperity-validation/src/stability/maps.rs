//! Errors over a plane: where in it the arithmetic is good, and where it is not.

use rayon::prelude::*;

use super::Ranges;
use super::bodies::{Bodies, Layer};
use super::exact::{Exact, Integral, Shape};
use super::laws::CoveredLaw;
use super::wide::relative_error;
use asperity::progress::Progress;
use asperity::{
    Heights, LayeredFlat, LayeredInterface, Material, MicroContact, Model, ModulusModel, Population,
    Statistical, Zmc, law, reduced_modulus,
};

/// Errors on a regular grid.
#[derive(Debug, Clone)]
pub struct Map {
    /// Name of its file and in its table.
    pub name: &'static str,
    /// The quantity whose error it shows.
    pub quantity: &'static str,
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
    /// Without errors.
    fn new(
        [name, quantity]: [&'static str; 2],
        axes: [&'static str; 2],
        ends: [[f64; 2]; 2],
        cells: [usize; 2],
    ) -> Self {
        Self { name, quantity, axes, ends, cells, errors: Vec::new() }
    }

    /// The middle of the column (axis 0) or row (axis 1) `k`.
    fn position(&self, k: usize, axis: usize) -> f64 {
        let [from, to] = self.ends[axis];
        from + (to - from) * k as f64 / (self.cells[axis] - 1) as f64
    }

    /// Position and error of each cell.
    pub fn points(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        let columns = self.cells[0];
        let point = move |(k, &error): (usize, &f64)| {
            ([self.position(k % columns, 0), self.position(k / columns, 1)], error)
        };
        self.errors.iter().enumerate().map(point)
    }

    /// The same with its errors, `row_done` being called after each row: `row` makes of y what all its cells share, `error` of that
    /// and x the error.
    fn computed<R>(
        self,
        row_done: &(dyn Fn() + Sync),
        row: impl Fn(f64) -> R + Sync,
        error: impl Fn(&R, f64) -> f64 + Sync,
    ) -> Self {
        let line = |k: usize| {
            let row = row(self.position(k, 1));
            let errors = (0..self.cells[0]).map(|column| error(&row, self.position(column, 0)));
            let errors = errors.collect::<Vec<f64>>();
            row_done();
            errors
        };
        let rows: Vec<Vec<f64>> = (0..self.cells[1]).into_par_iter().map(line).collect();
        Self { errors: rows.concat(), ..self }
    }
}

/// Steel of the paper, of any hardness.
fn body(young: f64, hardness: f64) -> Material {
    match Material::new(young, 0.3, Some(hardness), None) {
        Ok(body) => body,
        Err(_) => unreachable!("the ranges of a map are those of materials"),
    }
}

const YOUNG: f64 = 210e9;
const HARDNESS: f64 = 7.6e9;
const RADIUS: f64 = 2e-5;

/// Errors over the planes of the report, with `cells` cells along the longer side: one unit of work for `progress`.
pub fn maps(ranges: &Ranges, cells: usize, progress: &dyn Progress) -> Vec<Map> {
    // Rows: half as many of the first map.
    let part = (2.5 * cells as f64).recip();
    let row_done = || progress.advance(part);
    vec![
        separations(ranges, cells, &row_done),
        transitions(cells, &row_done),
        layers(ranges, cells, &row_done),
    ]
}

/// d/sigma and radius/sigma: the integral of a bare pair.
fn separations(ranges: &Ranges, cells: usize, row_done: &(dyn Fn() + Sync)) -> Map {
    const SIGMA: f64 = 1e-7;
    let steel = body(YOUNG, HARDNESS);
    let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
    let (exact, contact) = (Exact::new(&bodies), bodies.contact());
    let map = Map::new(
        ["separation", "nominal pressure of the integral"],
        ["d/σ", "log₁₀ R/σ"],
        [ranges.separation, ranges.radius_over_sigma.map(f64::log10)],
        [cells, cells / 2],
    );
    map.computed(
        row_done,
        |ratio| {
            let radius = SIGMA * 10f64.powf(ratio);
            Population { radius, sigma: SIGMA, density: 0.03 / (radius * SIGMA), heights: Heights::GAUSSIAN }
        },
        |population, h| {
            let Ok(contact) = &contact else { return f64::NAN };
            let pressure = Statistical::new(&**contact, population.clone()).respond(h).pressure.total();
            let of = Integral::new(population, h);
            let of = of.and_then(|of| exact.integral(&of, &Shape::sphere(population.radius)));
            of.map_or(f64::NAN, |of| relative_error(pressure, of.total_load()))
        },
    )
}

/// ln(w/w1)/ln c and c - 1: one contact of that pair.
fn transitions(cells: usize, row_done: &(dyn Fn() + Sync)) -> Map {
    let steel = body(YOUNG, HARDNESS);
    let strain = HARDNESS / reduced_modulus(&steel, &steel);
    let onset = Zmc::ONSET * RADIUS * strain * strain;
    let map = Map::new(
        ["transition", "load of a contact under ZMC"],
        ["ln(w/w₁) / ln c", "log₁₀ (c − 1)"],
        [[-0.5, 1.5], [-8.0, 6.0]],
        [cells, cells],
    );
    map.computed(
        row_done,
        |width| {
            let ratio = 1.0 + 10f64.powf(width);
            let law = CoveredLaw::zmc();
            let law = law.with_options(&[("transition-ratio", ratio)]).unwrap_or(law);
            let bodies = Bodies { law, rough: steel, flat: steel, layer: None };
            (ratio, bodies.contact(), Exact::new(&bodies))
        },
        |(ratio, contact, exact), place| {
            let Ok(contact) = contact else { return f64::NAN };
            contact_error(&**contact, exact, onset * ratio.powf(place))
        },
    )
}

/// t/a and H/E*: one contact under a layer, a tenth as stiff and as hard as the flat.
fn layers(ranges: &Ranges, cells: usize, row_done: &(dyn Fn() + Sync)) -> Map {
    const DEPTH: f64 = 2e-8;
    let wide = (RADIUS * DEPTH).sqrt();
    let modulus = reduced_modulus(&body(YOUNG, 1.0), &body(YOUNG, 1.0));
    let map = Map::new(
        ["layer", "load of a contact under a layer"],
        ["log₁₀ t/a", "log₁₀ H/E*"],
        [ranges.thickness.map(|t| (t / wide).log10()), ranges.hardness_over_modulus.map(f64::log10)],
        [cells, cells],
    );
    map.computed(
        row_done,
        |strain| {
            let hardness = modulus * 10f64.powf(strain);
            let (flat, material) = (body(YOUNG, hardness), body(0.1 * YOUNG, 0.1 * hardness));
            let layer = Layer { material, thickness: wide, rule: ModulusModel::Gao };
            (flat, layer, LayeredFlat::new(&material, &flat, wide, ModulusModel::Gao))
        },
        |(flat, layer, layered), ratio| {
            let layer = Layer { thickness: wide * 10f64.powf(ratio), ..*layer };
            // The tables of a pair serve every thickness.
            let layered =
                layered.as_ref().ok().and_then(|layered| layered.with_thickness(layer.thickness).ok());
            let contact =
                layered.and_then(|layered| LayeredInterface::new(Zmc::default(), flat, flat, layered).ok());
            let bodies = Bodies { law: CoveredLaw::zmc(), rough: *flat, flat: *flat, layer: Some(layer) };
            contact.map_or(f64::NAN, |contact| contact_error(&contact, &Exact::new(&bodies), DEPTH))
        },
    )
}

/// Of the load at indentation `w` (m); the least over the sides of a boundary.
fn contact_error(contact: &dyn MicroContact, exact: &Exact, w: f64) -> f64 {
    let load = contact.contact(w, law::Shape::sphere(RADIUS)).load;
    let sides = exact.contacts(w, &Shape::sphere(RADIUS));
    sides.iter().map(|side| relative_error(load, side.load)).fold(f64::INFINITY, f64::min)
}
