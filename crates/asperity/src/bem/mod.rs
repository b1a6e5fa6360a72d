//! Boundary elements: the frictionless contact of a height map with a flat, without asperities.
//!
//! Both bodies are elastic half-spaces, one of them with or without a bonded layer, slopes are small, and pressures are
//! constant (Love) or band-limited (waves) between the points of the map. Given a mean pressure, [`Solver`] finds the
//! pressures that no point pulls and under which no two points overlap (Polonsky and Keer 1999); with a cap H they stay
//! below it and overlap where they reach it, which is plastic flow in its simplest form (Almqvist et al. 2007).
//!
//! ```
//! use asperity::bem::{Boundary, ElasticPair, Options, Solver};
//! use asperity::progress::Silent;
//! use asperity::{HeightMap, Material};
//!
//! let steel = Material::new(210e9, 0.3, None, None)?;
//! let height = |k: usize| 1e-7 * ((k / 64) as f64 * 0.3).sin() * ((k % 64) as f64 * 0.2).cos();
//! let map = HeightMap::new([64, 64], [1e-6; 2], (0..64 * 64).map(height).collect(), 0.0)?;
//! let pair = ElasticPair::new(&steel, &steel, None);
//! let solver = Solver::new(&map, &pair, &Options { boundary: Boundary::Mirrored, error: 1e-8, cap: None })?;
//! let contact = solver.at_pressure(50e6, &Silent)?;
//! assert!((contact.pressure() / 50e6 - 1.0).abs() < 1e-12);
//! assert!(contact.area_ratio() > 0.0 && contact.area_ratio() < 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod active;
mod compliance;
mod conduction;
mod contact;
mod convolution;
mod descent;
mod influence;
mod patch;
mod preconditioner;
mod refine;
mod row;
mod solver;
mod tangent;

use std::ops::RangeInclusive;

use crate::named_enum;

pub use compliance::{ConductingPair, ElasticPair};
pub use conduction::{Conductor, Current};
pub use contact::Contact;
pub use refine::{GridError, refined};
pub use solver::{MOST_MISSING, Solver};
pub use tangent::Tangent;

named_enum! {
    /// What lies beyond the border of the map.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
    #[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
    pub enum Boundary {
        /// The map again: for maps that are periodic.
        Periodic = "periodic",
        /// The map reflected at its border, half a pixel beyond the last point: for measured maps.
        Mirrored = "mirrored",
        /// Nothing: the map is alone. The mean gap then includes the deflection of the whole patch, and the pressures rise towards the border as
        /// under a rigid punch: neither separation nor stiffness compares with those of a surface without end.
        Finite = "finite",
    }
}

impl Boundary {
    /// Whether points on opposite borders are neighbours.
    pub fn wraps(self) -> bool {
        self == Self::Periodic
    }
}

/// How a contact is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// What lies beyond the border.
    pub boundary: Boundary,
    /// Dual gap at which a load is solved, over mean pressure and standard deviation of the heights.
    pub error: f64,
    /// The highest pressure of a point, Pa; `None`: elastic.
    pub cap: Option<f64>,
}

impl Options {
    /// Errors that can be asked for: the lowest is near rounding.
    pub const ERRORS: RangeInclusive<f64> = 1e-12..=1e-2;
}

/// A contact that cannot be solved.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[allow(missing_docs)] // The texts say what fields are.
pub enum SolverError {
    /// At most 1 % of the points may be missing.
    #[error(
        "{missing} of {points} points are missing; allowed for boundary elements: at most 1 %. Use a part of the map (`crop`), or fill \
         the points with the program that wrote it"
    )]
    Missing { missing: usize, points: usize },
    /// Heights must differ.
    #[error("all heights are equal; boundary elements need a rough map")]
    Flat,
    /// Errors range from rounding to a hundredth.
    #[error("error {0}; allowed: 1e-12 to 1e-2")]
    Error(f64),
    /// The cap must be positive and finite.
    #[error("cap {0} Pa; allowed: positive and finite")]
    Cap(f64),
    /// Under a layer there is no single hardness.
    #[error(
        "a cap under a layer of finite thickness: boundary elements solve a layered flat elastically only; leave the \
         cap out (cap = \"none\")"
    )]
    CapUnderLayer,
    /// The current under a layer is known on maps that repeat.
    #[error(
        "a conducting layer of finite thickness on a finite map; allowed: boundary \"periodic\" or \"mirrored\""
    )]
    LayeredConductor,
    /// The mean pressure must be positive and below the cap.
    #[error("mean pressure {pressure} Pa; allowed: above 0 and below the cap of {cap} Pa")]
    Pressure { pressure: f64, cap: f64 },
    /// Under such a load a point yields less than rounding.
    #[error("mean pressure {0} Pa is lost in rounding; allowed: a larger one, of 1e-12 of E* or more")]
    TooLight(f64),
    /// The error did not fall to the one asked for.
    #[error(
        "no convergence at a mean pressure of {pressure} Pa: error {error:.1e} after {steps} steps; asked for: {wanted:.1e}. \
         Ask for a larger error"
    )]
    NotConverged { pressure: f64, error: f64, steps: usize, wanted: f64 },
}
