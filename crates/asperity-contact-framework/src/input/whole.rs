//! Whole numbers: 1000, or 1e3.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde_json::json;

use super::schema::{RANGE, TYPE};

/// A whole number from zero on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Whole(pub u64);

const ALLOWED: &str = "a whole number such as 1000 or 1e3, without quotes, up to 18446744073709551615";

fn refused<E: Error>(found: impl fmt::Display) -> E {
    E::custom(format!("found {found}; allowed: {ALLOWED}"))
}

crate::written_schema!(Whole, |_| json!({
    "type": "integer", "minimum": 0, TYPE: "whole number", RANGE: "0 to 18446744073709551615", "examples": [1000],
}));

impl<'de> Deserialize<'de> for Whole {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Reader;

        impl Visitor<'_> for Reader {
            type Value = Whole;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(ALLOWED)
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Whole, E> {
                Ok(Whole(value))
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Whole, E> {
                u64::try_from(value).map(Whole).map_err(|_| refused(value))
            }
            fn visit_u128<E: Error>(self, value: u128) -> Result<Whole, E> {
                u64::try_from(value).map(Whole).map_err(|_| refused(value))
            }
            fn visit_i128<E: Error>(self, value: i128) -> Result<Whole, E> {
                u64::try_from(value).map(Whole).map_err(|_| refused(value))
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Whole, E> {
                /// 2^64.
                const END: f64 = 18_446_744_073_709_551_616.0;
                let is_whole = (0.0..END).contains(&value) && value.fract() == 0.0;
                if is_whole { Ok(Whole(value as u64)) } else { Err(refused(format!("{value:?}"))) }
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Whole, E> {
                Err(refused(format!("\"{text}\"")))
            }
        }
        deserializer.deserialize_any(Reader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<u64, String> {
        let value = toml::de::ValueDeserializer::parse(text).map_err(|error| error.message().to_owned())?;
        Whole::deserialize(value).map(|whole| whole.0).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn a_whole_number_may_be_written_as_a_float() {
        assert_eq!(read("1000"), Ok(1000));
        assert_eq!(read("1e3"), Ok(1000));
        assert_eq!(read("1e18"), Ok(1_000_000_000_000_000_000));
        assert_eq!(read("18446744073709551615"), Ok(u64::MAX));
    }

    #[test]
    fn other_numbers_are_refused_in_plain_words() {
        for text in
            ["-3", "2.5", "1e20", "18446744073709551616", "nan", "inf", "\"1e3\"", "true", "[1]", "{ a = 1 }"]
        {
            let message = read(text).unwrap_err();
            assert!(message.contains("a whole number such as 1000"), "{text}: {message}");
        }
    }
}
