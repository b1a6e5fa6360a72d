//! The figures of a comparison.
//!
//! | module | what it draws |
//! |---|---|
//! | `axes` | axes and their units |
//! | `differences` | differences between the models, and from the reference, against load |
//! | `causes` | their causes against load |
//! | `curves` | separation, area and regimes against load |
//! | `layers` | the same by layer thickness |
//! | `lines` | closed results beside the models |
//! | `filter` | differences against the S filter |
//! | `contact` | pressures of the reference |
//! | `verdict_map` | the verdicts on several cases over load |

pub mod axes;
pub mod causes;
pub mod contact;
pub mod curves;
pub mod differences;
pub mod filter;
pub mod layers;
pub mod lines;
pub mod verdict_map;
