//! Values that a spec may write in several forms: a text or a number, one or a list, with their positions.

use std::borrow::{Borrow, Cow};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::value::{F64Deserializer, I64Deserializer, MapAccessDeserializer, StrDeserializer};
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
    #[must_use]
    pub fn text(self, read: impl FnOnce(&str) -> Result<T, String> + 'a) -> Self {
        Self { text: Some(Box::new(read)), ..self }
    }

    /// A number is allowed: its value, and how the spec writes it.
    #[must_use]
    pub fn number(self, read: impl FnOnce(f64, &str) -> Result<T, String> + 'a) -> Self {
        Self { number: Some(Box::new(read)), ..self }
    }

    #[must_use]
    pub fn list<I>(self, read: impl FnOnce(Vec<I>) -> Result<T, String> + 'a) -> Forms<'a, T, I, Table> {
        let Self { expected, text, number, table, .. } = self;
        Forms { expected, text, number, list: Some(Box::new(read)), table }
    }

    #[must_use]
    pub fn table<M>(self, read: impl FnOnce(M) -> Result<T, String> + 'a) -> Forms<'a, T, Item, M> {
        let Self { expected, text, number, list, .. } = self;
        Forms { expected, text, number, list, table: Some(Box::new(read)) }
    }
}

impl<'de, T, Item: Deserialize<'de>, Table: Deserialize<'de>> Forms<'_, T, Item, Table> {
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

/// [`toml::Spanned`], which a schema describes as the value itself.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Deserialize)]
#[serde(transparent)]
pub struct Spanned<T>(toml::Spanned<T>);

impl<T> Spanned<T> {
    pub fn get_ref(&self) -> &T {
        self.0.get_ref()
    }

    /// The value alone.
    pub fn into_inner(self) -> T {
        self.0.into_inner()
    }

    /// Its bytes in the text of the spec.
    pub fn span(&self) -> Range<usize> {
        self.0.span()
    }
}

impl Borrow<str> for Spanned<String> {
    fn borrow(&self) -> &str {
        self.get_ref()
    }
}

impl<T: JsonSchema> JsonSchema for Spanned<T> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}
