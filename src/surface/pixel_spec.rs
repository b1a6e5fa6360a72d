//! `pixel` and other lengths along x and y.

use asperity_contact_framework::input::OneOrMany;
use asperity_contact_framework::input::bare::PixelRange;
use asperity_contact_framework::input::quantity::{Length, Quantity};
use asperity_contact_framework::input::schema;
use asperity_contact_framework::written_schema;
use serde::{Deserialize, Deserializer};

/// One pixel size, or one along x and one along y.
#[derive(Debug, Clone, Copy)]
pub struct PixelSpec(pub [f64; 2]);

written_schema!(PixelSpec, |_| schema::one_or_many(
    schema::quantity::<Length, PixelRange>(),
    "length, or a list of two: along x and along y"
));

impl<'de> Deserialize<'de> for PixelSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a length such as \"0.8 um\", or a list of two: along x and along y";
        let sizes =
            OneOrMany::<Quantity<Length, PixelRange>>::read(deserializer, expected)?.along_both("sizes")?;
        Ok(Self(sizes.map(|size| size.value())))
    }
}
