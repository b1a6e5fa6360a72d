//! Values that a spec may write in several forms: as text, as a number, as a list or as a table.

use std::fmt;

use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{DeserializeOwned, Error, IgnoredAny, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};

type Reader<'a, W, T> = Box<dyn FnOnce(W) -> Result<T, String> + 'a>;
type TextReader<'a, T> = Box<dyn FnOnce(&str) -> Result<T, String> + 'a>;
type NumberReader<'a, T> = Box<dyn FnOnce(f64, &str) -> Result<T, String> + 'a>;

/// How a value is read from each form that is allowed. Unlike `serde-untagged` it passes on errors of tables with their
/// position in the spec.
pub struct Forms<'a, T, Item = IgnoredAny, Table = IgnoredAny> {
    expected: &'a str,
    text: Option<TextReader<'a, T>>,
    number: Option<NumberReader<'a, T>>,
    list: Option<Reader<'a, Vec<Item>, T>>,
    table: Option<Reader<'a, Table, T>>,
}

impl<'a, T> Forms<'a, T> {
    /// No form yet; `expected` says in an error what is allowed.
    pub fn new(expected: &'a str) -> Self {
        Self { expected, text: None, number: None, list: None, table: None }
    }
}

impl<'a, T, Item, Table> Forms<'a, T, Item, Table> {
    /// Text is allowed.
    #[must_use]
    pub fn text(self, read: impl FnOnce(&str) -> Result<T, String> + 'a) -> Self {
        Self { text: Some(Box::new(read)), ..self }
    }

    /// A number is allowed: its value, and how the spec writes it.
    #[must_use]
    pub fn number(self, read: impl FnOnce(f64, &str) -> Result<T, String> + 'a) -> Self {
        Self { number: Some(Box::new(read)), ..self }
    }

    /// A list is allowed.
    #[must_use]
    pub fn list<I>(self, read: impl FnOnce(Vec<I>) -> Result<T, String> + 'a) -> Forms<'a, T, I, Table> {
        let Self { expected, text, number, table, .. } = self;
        Forms { expected, text, number, list: Some(Box::new(read)), table }
    }

    /// A table is allowed.
    #[must_use]
    pub fn table<M>(self, read: impl FnOnce(M) -> Result<T, String> + 'a) -> Forms<'a, T, Item, M> {
        let Self { expected, text, number, list, .. } = self;
        Forms { expected, text, number, list, table: Some(Box::new(read)) }
    }
}

impl<'de, T, Item: Deserialize<'de>, Table: Deserialize<'de>> Forms<'_, T, Item, Table> {
    /// Reads the value.
    ///
    /// # Errors
    /// A form that is not allowed, or what the form's reader says.
    pub fn read<D: Deserializer<'de>>(self, deserializer: D) -> Result<T, D::Error> {
        deserializer.deserialize_any(self)
    }

    fn read_number<E: Error>(self, value: f64, written: String, form: Unexpected) -> Result<T, E> {
        let read = self.number.ok_or_else(|| E::invalid_type(form, &self.expected))?;
        read(value, &written).map_err(E::custom)
    }
}

/// Reads one of some names, for `deserialize_with`: a number is an error that lists them, as another name is.
pub fn named<'de, D: Deserializer<'de>, T: DeserializeOwned>(deserializer: D) -> Result<T, D::Error> {
    let read = |name: &str| {
        T::deserialize(StrDeserializer::<serde::de::value::Error>::new(name))
            .map_err(|error| error.to_string())
    };
    Forms::new("a name in quotes").text(read).number(|_, written| read(written)).read(deserializer)
}

/// The same of a key that may be left out.
pub fn named_or_none<'de, D: Deserializer<'de>, T: DeserializeOwned>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    named(deserializer).map(Some)
}

impl<'de, T, Item: Deserialize<'de>, Table: Deserialize<'de>> Visitor<'de> for Forms<'_, T, Item, Table> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
        let read = self.text.ok_or_else(|| E::invalid_type(Unexpected::Str(text), &self.expected))?;
        read(text).map_err(E::custom)
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<T, E> {
        self.read_number(value, format!("{value:?}"), Unexpected::Float(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<T, E> {
        self.read_number(value as f64, value.to_string(), Unexpected::Signed(value))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<T, E> {
        self.read_number(value as f64, value.to_string(), Unexpected::Unsigned(value))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<T, A::Error> {
        let read = self.list.ok_or_else(|| A::Error::invalid_type(Unexpected::Seq, &self.expected))?;
        let mut items = Vec::new();
        while let Some(item) = list.next_element()? {
            items.push(item);
        }
        read(items).map_err(A::Error::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
        let read = self.table.ok_or_else(|| A::Error::invalid_type(Unexpected::Map, &self.expected))?;
        read(Table::deserialize(MapAccessDeserializer::new(map))?).map_err(A::Error::custom)
    }
}
