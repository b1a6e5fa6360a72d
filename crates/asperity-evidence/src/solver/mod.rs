//! The boundary element solver against closed forms, exact solutions and a published ensemble.
//!
//! Lengths, moduli and pressures are in units in which E* = 1 wherever the problem leaves the choice.

pub mod ensemble;
pub mod grid;
mod known;
mod surfaces;
mod validation;

pub use grid::GRID_BOUNDS;
pub use known::{
    Benchmark, BenchmarkQuantity, LAYERED_CASES, LayeredCase, Problem, full_contact, hertz, layered,
    partial_contact,
};
pub use surfaces::SelfAffine;
pub use validation::SOLVER_VALIDATION;

use asperity::bem::ElasticPair;
use asperity::{Material, MaterialError};
use asperity_plot::{Axis, Legend, Plot};

/// Half-spaces with E* = 1.
fn unit_pair() -> Result<ElasticPair, MaterialError> {
    let body = Material::new(2.0, 0.0, None, None)?;
    Ok(ElasticPair::new(&body, &body, None))
}

fn rms(heights: &[f64]) -> f64 {
    (heights.iter().map(|z| z * z).sum::<f64>() / heights.len() as f64).sqrt()
}

fn plot(title: &str, x: Axis, y: Axis) -> Plot {
    Plot::new(title, x, y).legend(Legend::Below).height(300.0)
}
