//! Values that stand alone or in a list.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{F64Deserializer, I64Deserializer, MapAccessDeserializer, StrDeserializer};
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// One value, or a list of values.
#[derive(Debug)]
pub enum OneOrMany<T> {
    /// A value that stands alone.
    One(T),
    /// A list, which may be empty.
    Many(Vec<T>),
}

impl<T> OneOrMany<T> {
    /// Reads one value or a list, of which a message says `expected`.
    pub fn read<'de, D: Deserializer<'de>>(deserializer: D, expected: &str) -> Result<Self, D::Error>
    where
        T: Deserialize<'de>,
    {
        deserializer.deserialize_any(Either { expected, value: PhantomData })
    }

    /// The values, one at least; `name` is that of a value in a message.
    pub fn at_least_one<E: Error>(self, name: &str) -> Result<Vec<T>, E> {
        match self {
            Self::One(value) => Ok(vec![value]),
            Self::Many(values) if values.is_empty() => {
                Err(E::custom(format!("found an empty list; allowed: at least one {name}")))
            }
            Self::Many(values) => Ok(values),
        }
    }

    /// The values along x and along y: one for both, or one for each; `names` is that of values in a message.
    pub fn along_both<E: Error>(self, names: &str) -> Result<[T; 2], E>
    where
        T: Copy,
    {
        match self {
            Self::One(value) => Ok([value; 2]),
            Self::Many(values) => <[T; 2]>::try_from(values)
                .map_err(|values| E::custom(format!("found {} {names}; allowed: one or two", values.len()))),
        }
    }
}

struct Either<'a, T> {
    expected: &'a str,
    value: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for Either<'_, T> {
    type Value = OneOrMany<T>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }
    fn visit_str<E: Error>(self, text: &str) -> Result<OneOrMany<T>, E> {
        T::deserialize(StrDeserializer::new(text)).map(OneOrMany::One)
    }
    fn visit_f64<E: Error>(self, value: f64) -> Result<OneOrMany<T>, E> {
        T::deserialize(F64Deserializer::new(value)).map(OneOrMany::One)
    }
    fn visit_i64<E: Error>(self, value: i64) -> Result<OneOrMany<T>, E> {
        T::deserialize(I64Deserializer::new(value)).map(OneOrMany::One)
    }
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<OneOrMany<T>, A::Error> {
        T::deserialize(MapAccessDeserializer::new(map)).map(OneOrMany::One)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<OneOrMany<T>, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        Ok(OneOrMany::Many(values))
    }
}
