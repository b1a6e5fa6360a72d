//! `pixel` and other lengths along x and y.

use asperity_framework::input::quantity::{Length, Quantity};
use serde::Deserialize;

/// One pixel size, or one along x and one along y.
#[derive(Debug, Clone, Copy)]
pub struct PixelSpec(pub [f64; 2]);

impl<'de> Deserialize<'de> for PixelSpec {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        use serde::de::value::{F64Deserializer, I64Deserializer, StrDeserializer};
        use serde::de::{Error, SeqAccess, Visitor};
        struct OneOrTwo;

        impl<'de> Visitor<'de> for OneOrTwo {
            type Value = PixelSpec;

            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a length such as \"0.8 um\", or a list of two: along x and along y")
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<PixelSpec, E> {
                let size = Quantity::<Length>::deserialize(StrDeserializer::new(text))?.value();
                Ok(PixelSpec([size; 2]))
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<PixelSpec, E> {
                let size = Quantity::<Length>::deserialize(F64Deserializer::new(value))?.value();
                Ok(PixelSpec([size; 2]))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<PixelSpec, E> {
                let size = Quantity::<Length>::deserialize(I64Deserializer::new(value))?.value();
                Ok(PixelSpec([size; 2]))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<PixelSpec, A::Error> {
                let mut sizes = Vec::new();
                while let Some(size) = list.next_element::<Quantity<Length>>()? {
                    sizes.push(size.value());
                }
                <[f64; 2]>::try_from(sizes).map(PixelSpec).map_err(|sizes| {
                    A::Error::custom(format!("found {} sizes; allowed: one or two", sizes.len()))
                })
            }
        }
        deserializer.deserialize_any(OneOrTwo)
    }
}
