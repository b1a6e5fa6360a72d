//! Errors over a plane: where in it the arithmetic is good, and where it is not.

use rayon::prelude::*;

use super::CellRow;
use super::cases::{HARDNESS_OVER_MODULUS, RADIUS_OVER_SIGMA, SEPARATIONS, THICKNESSES};
use crate::exact::{Bodies, CoveredLaw, Exact, Integral, Layer, Shape};
use crate::program::Drawing;
use crate::wide::relative_error;
use asperity::progress::Progress;
use asperity::{
    Heights, LayeredFlat, LayeredInterface, Material, MicroContact, Model, ModulusModel, Population,
    Statistical, Zmc, law, reduced_modulus,
};
use asperity_contact_framework::report::format::number;
use asperity_plot::{Axis, ColourMap, Layer as Drawn, Plot, Raster};

/// Errors on a regular grid.
#[derive(Debug, Clone)]
pub struct Map {
    /// Its name in the table of cells, the file of its figure, the quantity whose error it shows, and the caption.
    words: [&'static str; 4],
    /// What stands along x and y; logarithms to the base of ten where they say so.
    axes: [&'static str; 2],
    /// Middles of the first and the last column, of the first and the last row.
    ends: [[f64; 2]; 2],
    cells: [usize; 2],
    /// Relative errors, x fastest; NaN where the wide rule does not settle.
    errors: Vec<f64>,
}

impl Map {
    /// The middle of the column (axis 0) or row (axis 1) `k`.
    fn position(&self, k: usize, axis: usize) -> f64 {
        let [from, to] = self.ends[axis];
        from + (to - from) * k as f64 / (self.cells[axis] - 1) as f64
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = CellRow> {
        let columns = self.cells[0];
        let row = move |(k, &error): (usize, &f64)| CellRow {
            map: self.words[0],
            position: [self.position(k % columns, 0), self.position(k / columns, 1)],
            error,
        };
        self.errors.iter().enumerate().map(row)
    }

    /// The same with its errors, `row_done` being called after each row: `row` makes of y what all its cells share, `error` of that
    /// and x the error.
    fn computed<R>(
        mut self,
        row_done: &(dyn Fn() + Sync),
        row: impl Fn(f64) -> R + Sync,
        error: impl Fn(&R, f64) -> f64 + Sync,
    ) -> Self {
        let line = |k: usize| {
            let row = row(self.position(k, 1));
            let errors: Vec<f64> =
                (0..self.cells[0]).map(|column| error(&row, self.position(column, 0))).collect();
            row_done();
            errors
        };
        self.errors = (0..self.cells[1]).into_par_iter().map(line).collect::<Vec<_>>().concat();
        self
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
pub fn maps(cells: usize, progress: &dyn Progress) -> Vec<Map> {
    // Rows: half as many of the first map.
    let part = (2.5 * cells as f64).recip();
    let row_done = || progress.advance(part);
    vec![separations(cells, &row_done), transitions(cells, &row_done), layers(cells, &row_done)]
}

/// d/sigma and radius/sigma: the integral of a bare pair.
fn separations(cells: usize, row_done: &(dyn Fn() + Sync)) -> Map {
    const SIGMA: f64 = 1e-7;
    let steel = body(YOUNG, HARDNESS);
    let bodies = Bodies { law: CoveredLaw::zmc(), rough: steel, flat: steel, layer: None };
    let (exact, contact) = (Exact::new(&bodies), bodies.contact());
    let map = Map {
        words: [
            "separation",
            "separation-errors.svg",
            "nominal pressure of the integral",
            "Relative error of the integral for steel on steel under ZMC. White: below a tenth of the unit roundoff, or zero.",
        ],
        axes: ["d/σ", "log₁₀ R/σ"],
        ends: [SEPARATIONS, RADIUS_OVER_SIGMA.map(f64::log10)],
        cells: [cells, cells / 2],
        errors: Vec::new(),
    };
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
    let map = Map {
        words: [
            "transition",
            "transition-errors.svg",
            "load of a contact under ZMC",
            "Relative error of a single steel contact for any ratio c = w₂/w₁: elastic left of w₁, plastic right of w₂. Between them it \
             grows as 1/(c − 1), by the rounding of w₁ alone.",
        ],
        axes: ["ln(w/w₁) / ln c", "log₁₀ (c − 1)"],
        ends: [[-0.5, 1.5], [-8.0, 6.0]],
        cells: [cells, cells],
        errors: Vec::new(),
    };
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
fn layers(cells: usize, row_done: &(dyn Fn() + Sync)) -> Map {
    const DEPTH: f64 = 2e-8;
    let wide = (RADIUS * DEPTH).sqrt();
    let modulus = reduced_modulus(&body(YOUNG, 1.0), &body(YOUNG, 1.0));
    let map = Map {
        words: [
            "layer",
            "layer-errors.svg",
            "load of a contact under a layer",
            "Relative error of a single contact under a layer a tenth as stiff and as hard as the flat, from uncoated (left) to bulk \
             layer material (right). Stripes: elastic (top) and plastic (bottom) contacts.",
        ],
        axes: ["log₁₀ t/a", "log₁₀ H/E*"],
        ends: [THICKNESSES.map(|t| (t / wide).log10()), HARDNESS_OVER_MODULUS.map(f64::log10)],
        cells: [cells, cells],
        errors: Vec::new(),
    };
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

/// log10 of the errors at both ends of the colours: a tenth of a rounding, and a hundred roundings or the worst.
const COLOURS: [f64; 2] = [-17.0, -14.0];

impl Map {
    /// The errors as colours.
    pub fn drawing(&self) -> Drawing {
        let [columns, rows] = self.cells;
        // Outer edges of the outermost cells.
        let edges = |axis: usize| {
            let [from, to] = self.ends[axis];
            let half = 0.5 * (to - from) / (self.cells[axis] - 1) as f64;
            (from - half, to + half)
        };
        let (x, y) = (edges(0), edges(1));
        let axis = |label: &str, (from, to): (f64, f64)| Axis::linear(label).range(from, to);
        let worst = self.errors.iter().copied().filter(|error| error.is_finite()).fold(0.0, f64::max);
        let raster = Raster {
            x,
            y,
            columns,
            rows,
            values: self.errors.iter().map(|error| error.max(1e-30).log10()).collect(),
            map: ColourMap::Sequential,
            limits: Some((COLOURS[0], worst.log10().ceil().max(COLOURS[1]))),
            label: "log₁₀ of the relative error".into(),
        };
        let title = format!(
            "Error of the {}: at most {} ({} units of rounding)",
            self.words[2],
            number(worst),
            number((worst / (0.5 * f64::EPSILON)).round())
        );
        let plot = Plot::new(title, axis(self.axes[0], x), axis(self.axes[1], y)).with(Drawn::raster(raster));
        Drawing { file: self.words[1], figure: plot.into(), caption: self.words[3].to_owned() }
    }
}
