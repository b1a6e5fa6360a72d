//! Asperities: sets, their statistics, and populations to draw from.

mod arrays;
mod ascending;
mod ellipse;
mod ellipses;
mod list;
mod nayak;
mod ordered;
mod population;
mod set;
mod statistics;
mod sums;

pub use arrays::Asperities;
pub use ascending::{Ascending, RadiiAbove};
pub use ellipse::Ellipse;
pub use ellipses::{Ellipses, Ellipticity};
pub use list::{AsperityList, ListColumn, ListError, ListOptions};
pub use nayak::{SurfaceHeights, SurfaceHeightsError};
pub use ordered::Ordered;
pub use population::{Draw, Population, STREAM};
pub(crate) use set::Places;
pub use set::{AsperitySet, SetError};
pub use statistics::Statistics;
pub(crate) use statistics::mean_and_sigma;
pub use sums::AsperitySums;
