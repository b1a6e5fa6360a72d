//! Asperities: sets, their statistics, and populations to draw from.

mod arrays;
mod by_height;
mod ellipses;
mod list;
mod population;
mod set;
mod statistics;
mod sums;

pub use arrays::Asperities;
pub use by_height::{ByHeight, Ordered, RadiiAbove};
pub use ellipses::{Ellipse, Ellipses, Ellipticity};
pub use list::{AsperityList, ListColumn, ListError, ListOptions};
pub use population::{Draw, Population, STREAM, SurfaceHeights, SurfaceHeightsError};
pub(crate) use set::Places;
pub use set::{AsperitySet, SetError};
pub use statistics::Statistics;
pub(crate) use statistics::mean_and_sigma;
pub use sums::AsperitySums;
