//! The figures of a comparison.
//!
//! | module | what it draws |
//! |---|---|
//! | `axes` | axes and their units |
//! | `differences` | differences between the models, and from the reference, against load |
//! | `causes` | their causes against load |
//! | `curves` | separation, area, stiffness and regimes against load |
//! | `layers` | the same by layer thickness |
//! | `lines` | closed results beside the models |
//! | `filter` | differences against the S filter |
//! | `friction` | boundary friction against the thickness of a layer |
//! | `contact` | pressures of the reference |
//! | `verdict_map` | the verdicts on several cases over load |
//! | `contact_map` | the contacts on a measured map, load by load |
//! | `paper` | figures of Pasaribu and Schipper (2005) |
//! | `main_figure` | what a page is opened for |

pub mod axes;
pub mod causes;
pub mod contact;
mod contact_map;
pub mod curves;
pub mod differences;
pub mod filter;
pub mod friction;
pub mod layers;
pub mod lines;
pub(crate) mod main_figure;
mod paper;
pub mod verdict_map;
