//! Rough-surface contact two ways: the statistical integral and the sum over the real asperities.
//!
//! One idea carries the crate: **one micro-contact, two ways of summing it.** A
//! [`MicroContact`](interface::MicroContact) answers "indentation w, radius b: what area, what load,
//! which regime?". The [statistical](model::Statistical) model integrates that answer over a height
//! density, the [deterministic](model::Deterministic) one sums it over asperities. Neither knows
//! which law it holds, so a difference between the two can come only from the summation.
//!
//! Data flows one way: `model` never sees a file, `law` never sees a model. Everything is SI in `f64`.
//!
//! ```
//! use asperity::asperity::Population;
//! use asperity::distribution::Heights;
//! use asperity::interface::Interface;
//! use asperity::law::Zmc;
//! use asperity::material::Material;
//! use asperity::model::{Statistical, at_pressure};
//!
//! let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
//! let contact = Interface::bare(Zmc::default(), &steel, &steel)?;
//! let population =
//!     Population { radius: 20e-6, sigma: 48e-9, density: 6e10, heights: Heights::GAUSSIAN };
//! let reached = at_pressure(&Statistical::new(&contact, population), 1e6)?;
//! assert!(reached.response.area_ratio.total() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod accumulator;
pub mod asperity;
pub mod compare;
pub mod contact;
pub mod distribution;
pub mod interface;
pub mod law;
pub mod layer;
pub mod literature;
pub mod material;
pub mod memory;
pub mod model;
pub mod numeric;
pub mod sphere;
pub mod topography;
pub mod work;
