//! The figures of a comparison.
//!
//! | module | what it draws |
//! |---|---|
//! | `differences` | differences between the models and from the reference, and their causes, against load |
//! | `curves` | separation, area, stiffness and regimes against load |
//! | `layers` | the same and friction by layer thickness |
//! | `contact` | pressures of the reference, what is in contact on a map, differences over the S filter |
//! | `main_figure` | what a page is opened for |

pub mod contact;
pub mod curves;
pub mod differences;
pub mod layers;
pub(crate) mod main_figure;
