//! The boundary element solver against closed forms, exact solutions and a published ensemble.
//!
//! Lengths, moduli and pressures are in units in which E* = 1 wherever the problem leaves the choice.
//!
//! | module | contents |
//! |---|---|
//! | `spheres` | paraboloids on a half-space (Hertz) and on a bonded layer |
//! | `waves` | a wavy surface in partial contact (Westergaard), waves in full contact |
//! | `surfaces` | self-affine surfaces of a given r.m.s. gradient |
//! | `published` | the published ensemble |
//! | `ensemble` | area, gap and kappa of the ensemble |
//! | `grid` | errors by the grid against the bounds that are stated |
//! | `work` | steps and convolutions against points |

pub mod ensemble;
pub mod grid;
pub mod published;
mod spheres;
mod surfaces;
mod waves;
pub mod work;

pub use spheres::{LAYERED_CASES, LayeredCase, Profile, hertz, hertz_profile, layered, sphere_points};
pub use surfaces::{SelfAffine, SurfaceError};
pub use waves::{full_contact, partial_contact, wave_profile};

use asperity::bem::{Boundary, Contact, ElasticPair, Options, Solver, SolverError};
use asperity::named_enum;
use asperity::progress::Silent;
use asperity::{HeightMap, MapError, Material, MaterialError};

/// Relative dual gap of the problems whose solution is known: far below the errors of discretisation.
pub const DUAL_GAP: f64 = 1e-11;

named_enum! {
    /// A problem whose solution is known.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Problem {
        /// A paraboloid on a half-space.
        Hertz = "hertz",
        /// A wave in partial contact.
        Sinusoid = "sinusoid",
        /// Waves in full contact.
        FullContact = "full-contact",
        /// A sphere on a bonded layer.
        LayeredSphere = "layered-sphere",
    }
}

named_enum! {
    /// What is compared with the solution.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum BenchmarkQuantity {
        /// Approach of distant points, relative.
        Indentation = "indentation",
        /// Points in contact, relative; of the sinusoid the width over the wavelength, absolute.
        RawArea = "raw-area",
        /// The same, corrected for the border.
        Area = "area",
        /// The highest pressure, relative.
        PeakPressure = "peak-pressure",
        /// Root mean square of the error of the pressures over that of the pressures.
        Pressures = "pressures",
        /// Mean gap over the height of the wave, absolute.
        MeanGap = "mean-gap",
    }
}

impl BenchmarkQuantity {
    /// In a sentence.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Indentation => "indentation",
            Self::RawArea => "area by counting points",
            Self::Area => "corrected area",
            Self::PeakPressure => "peak pressure",
            Self::Pressures => "pressures (r.m.s.)",
            Self::MeanGap => "mean gap",
        }
    }
}

/// One quantity of one problem at one resolution.
#[derive(Debug, Clone, PartialEq)]
pub struct Benchmark {
    /// The problem.
    pub problem: Problem,
    /// Which of its cases.
    pub case: String,
    /// Points per contact radius or per wavelength.
    pub points: usize,
    /// The quantity.
    pub quantity: BenchmarkQuantity,
    /// The exact value; `None` of a norm of an error.
    pub exact: Option<f64>,
    /// The value of the boundary elements; `None` of a norm of an error.
    pub computed: Option<f64>,
    /// The error, as [`BenchmarkQuantity`] defines it.
    pub error: f64,
    /// The largest error that is allowed.
    pub allowed: Option<f64>,
}

impl Benchmark {
    /// Whether the error is within its bound.
    pub fn is_within(&self) -> bool {
        self.allowed.is_none_or(|allowed| self.error.abs() <= allowed)
    }
}

/// A case of a problem at one resolution.
struct Case {
    problem: Problem,
    name: String,
    points: usize,
}

impl Case {
    /// A quantity: its exact and computed value (`None` of a norm of an error), its error, and the largest that is allowed.
    fn benchmark(
        &self,
        quantity: BenchmarkQuantity,
        values: Option<[f64; 2]>,
        error: f64,
        allowed: Option<f64>,
    ) -> Benchmark {
        let Self { problem, points, .. } = *self;
        let [exact, computed] = [0, 1].map(|k| values.map(|values| values[k]));
        Benchmark { problem, case: self.name.clone(), points, quantity, exact, computed, error, allowed }
    }
}

/// A problem that cannot be set up or solved.
#[derive(Debug, thiserror::Error)]
pub enum Unsolved {
    /// Bodies outside the range of materials.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// Heights that form no map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The solver's reason.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// A surface that cannot be made.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
}

/// Half-spaces with E* = 1.
fn unit_pair() -> Result<ElasticPair, MaterialError> {
    let body = Material::new(2.0, 0.0, None, None)?;
    Ok(ElasticPair::new(&body, &body, None))
}

/// A contact under a mean pressure, to [`DUAL_GAP`].
fn solved(
    map: &HeightMap,
    pair: &ElasticPair,
    boundary: Boundary,
    pressure: f64,
) -> Result<Contact, SolverError> {
    let options = Options { boundary, error: DUAL_GAP, cap: None };
    Solver::new(map, pair, &options)?.at_pressure(pressure, &Silent)
}

/// Root mean square of `computed - exact` over that of `exact`, and the highest of `computed`.
fn pressure_errors(computed: &[f64], exact: impl Fn(usize) -> f64) -> [f64; 2] {
    let [mut difference, mut norm, mut highest] = [0.0f64; 3];
    for (k, &p) in computed.iter().enumerate() {
        let exact = exact(k);
        difference += (p - exact).powi(2);
        norm += exact * exact;
        highest = highest.max(p);
    }
    [(difference / norm).sqrt(), highest]
}
