//! Contact of a rough surface with a flat, computed in two ways from the same micro-contact law: by the statistical
//! integral over a height density (Greenwood and Williamson 1966; Zhao, Maietta and Chang 2000) and by the
//! deterministic sum over the individual asperities (Pasaribu and Schipper 2005).
//!
//! ```
//! use asperity::{Deterministic, Draw, Heights, Interface, Material, Model, Population, Statistical, Zmc};
//!
//! let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?; // E in Pa, Poisson's ratio, hardness in Pa
//! let contact = Interface::bare(Zmc::default(), &steel, &steel)?;
//! let population = Population { radius: 20e-6, sigma: 48e-9, density: 6e10, heights: Heights::GAUSSIAN };
//! let set = population.set(10_000, Draw::Random([7; 32]))?;
//!
//! let sum = Deterministic::new(&contact, set.spheres(), (&population).into()).respond(1.5); // d in sigma
//! let integral = Statistical::new(&contact, population).respond(1.5);
//! println!("pressure {:.3e} and {:.3e} Pa", integral.pressure.total(), sum.pressure.total());
//! # let sampling = sum.sampling.ok_or("a sum has a sampling error")?;
//! # assert!((integral.pressure.total() - sum.pressure.total()).abs() < 4.0 * sampling.pressure);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How it fits together
//!
//! **One micro-contact, two ways of summing it.** A [`MicroContact`] gives area, load, stiffness and regime of one
//! asperity as functions of its indentation w and radius b. The [`Statistical`] model integrates it over a height
//! density, the [`Deterministic`] model sums it over asperities. Both use the same micro-contact, so that any
//! difference between them is due to the summation.
//!
//! ```text
//! HeightMap --> summits --> AsperitySet --> Deterministic --\
//!                               |                            +--> Response --> compare
//!                     Statistics, Population --> Statistical --/
//! Material, LayeredFlat, Law --> MicroContact --> (both models)
//! ```
//!
//! | step | items |
//! |---|---|
//! | two bodies | [`Material`], or one of [`material_library`]; a layer on the flat: [`Flat::with_layer`], [`layer`]; on the rough body: [`ContactLaw::interface_of`] |
//! | a law | [`Zmc`], [`Hertz`], [`Ceb`], [`KogutEtsion`], [`JacksonGreen`], [`FullyPlastic`], by name in [`contact_law`], or your own [`Law`] |
//! | the micro-contact | [`Interface::bare`]; [`Flat::under`] for a flat that may be layered |
//! | asperities | a [`Population`] with a height distribution ([`distribution`]), an [`AsperitySet`] from lists, or the summits of a [`HeightMap`] ([`topography`]) |
//! | the models | [`Statistical`] and [`Deterministic`] implement [`Model`]: [`Model::respond`] at a separation, [`at_pressure`] at a load |
//! | the result | [`Response`]: contacts, area, pressure, stiffness, shares of the regimes, standard errors for independent asperities, [`LoadSharing`]; the limits of admissible loads that it exceeds: [`Response::exceeded`] |
//! | what spots conduct, and their friction | [`spot`]; [`WithSpots`] adds it to a micro-contact, and [`Response::spots`] holds the sums |
//! | one asperity | [`sphere`]: its curve, its critical indentations |
//! | comparison of both models | [`compare`]: pairs at equal load and separation, [`Difference`](compare::Difference) with its 95 % interval, [`AdmissibleRange`](compare::AdmissibleRange), [`Stretch`](compare::Stretch) of loads with one [`Verdict`](compare::Verdict) |
//! | a surface with all that is known of it | [`surface`]: its asperities, the fitness of its map, blocks; [`study`]: both models on it, with sampling errors, causes and verdicts; [`study::verdicts`] does all of it |
//! | the map itself | [`bem`]: boundary elements without asperities; [`analytical`]: closed results from its r.m.s. gradient |
//! | files and units | [`topography::read`], [`AsperityList::read`], [`npy`], [`units`] |
//! | tools | [`numeric`], [`literature`], [`work`] |
//!
//! The directory `examples/` has a sphere, a population, a measured map, a user-defined law and a generated surface.
//!
//! # Units, signs, errors
//!
//! - All quantities are SI in `f64`: m, Pa, N, 1/m^2. A *separation* is the distance of the flat from the mean
//!   **asperity** height; the models take it as d/sigma, in units of the standard deviation of the asperity heights
//!   ([`ReferencePlane`]). Indentation w = z - d is positive in contact.
//! - Loads and areas of a surface are per nominal area: a pressure and an area ratio. The area ratio is never clamped;
//!   beyond [`INTERACTION`] neighbouring asperities interact and asperity models do not hold. The other limits are
//!   [`MIN_CONTACTS`] effective contacts, [`LARGEST_LOAD_SHARE`] and [`LARGE_STRAIN_SHARE`]; results beyond a
//!   [`Limit`] are returned, not rejected.
//! - Invalid input is rejected by the constructors, with an error that states what was found and what is allowed
//!   ([`MaterialError`], [`SetError`], [`MapError`], [`Inapplicable`], ...). No result is NaN, and no input causes a
//!   panic.
//!
//! # Accuracy, threads, reproducibility
//!
//! The integral has a relative error of at most 1e-13 from d = -10 to 20 sigma and of 2e-13 to 35 sigma; the sum is
//! within 4 ulp of the exact sum of its terms. Models run on rayon's threads and the widest vector registers of the
//! machine. Results and random numbers are **the same to the last bit for any number of threads**; across machines they
//! may differ in the last digits, depending on the registers and the system's elementary functions.
//!
//! # Features
//!
//! `serde` (off by default): deserialisation of options, serialisation of work counts, and both of sums over a part of
//! the asperities ([`Total`], [`AsperitySums`]).
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod accumulator;
pub mod analytical;
mod asperity;
pub mod bem;
pub mod compare;
mod contact;
pub mod contact_law;
pub mod distribution;
mod interface;
pub mod law;
pub mod layer;
mod legible;
pub mod literature;
mod material;
pub mod material_library;
mod memory;
mod model;
mod named_enum;
pub mod npy;
pub mod numeric;
pub mod progress;
mod shape;
pub mod sphere;
pub mod spot;
pub mod study;
pub mod surface;
pub mod topography;
pub mod units;
pub mod work;

pub use accumulator::{Accumulator, ContactSums, Total};
pub use asperity::{
    Asperities, AsperityList, AsperitySet, AsperitySums, ByHeight, Draw, Ellipse, Ellipses, Ellipticity,
    ListColumn, ListError, ListOptions, Ordered, Population, RadiiAbove, STREAM, SetError, Statistics,
    SurfaceHeights, SurfaceHeightsError,
};
pub use contact::{ByRegime, Contact, ContactColumns, Contacts, Regime};
pub use contact_law::ContactLaw;
pub use distribution::{HeightDistribution, Heights};
pub use interface::{
    ContactError, Flat, Interface, LayeredInterface, LoadBounds, MicroContact, Shapes, WithSpots,
    plasticity_index,
};
pub use law::{
    Ceb, FullyPlastic, Hertz, Inapplicable, JacksonGreen, KogutEtsion, Law, Pair, Pairs, ScalableLaw,
    YieldLimits, Zmc,
};
pub use layer::{LayerError, LayeredFlat, ModulusModel};
pub use legible::legible;
pub use literature::Paper;
pub use material::{Material, MaterialError, reduced_modulus, softer_hardness};
pub use model::{
    Deterministic, Exceeded, GreenwoodTrippError, INTERACTION, LARGE_STRAIN_SHARE, LARGEST_LOAD_SHARE,
    LOWEST_SEPARATION, Limit, LoadSharing, MIN_CONTACTS, MeanRadius, Medium, Model, RadiusInContact, Reached,
    ReferencePlane, Response, SamplingError, Statistical, SummitShape, Unreachable, at_pressure,
    at_pressures, joint_model, meeting_pairs, reached_at,
};
pub use shape::Shape;
pub use topography::{HeightMap, MapError};
