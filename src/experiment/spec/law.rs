//! `law = "zmc"`, `law.zmc = { transition-ratio = 110 }`, or a list of these.

use std::fmt;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};

use crate::interface::{Flat, MicroContact};
use crate::law::{Hertz, Zmc};
use crate::material::Material;
use crate::units::{Finite, Pure, Quantity};

/// A law as a spec names it, with its options checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawSpec {
    /// Hertz.
    Hertz,
    /// Zhao, Maietta and Chang, and its options where they differ from the default.
    Zmc {
        /// The law.
        law: Zmc,
        /// Onset coefficient, if given.
        onset: Option<f64>,
        /// w2/w1, if given.
        transition_ratio: Option<f64>,
    },
}

impl LawSpec {
    /// How tables and plots name the law: its options stand behind it.
    pub fn label(&self) -> String {
        match self {
            Self::Hertz => "hertz".to_owned(),
            Self::Zmc { onset, transition_ratio, .. } => {
                let options: Vec<String> = [("onset", onset), ("transition-ratio", transition_ratio)]
                    .into_iter()
                    .filter_map(|(name, value)| value.map(|value| format!("{name}={value}")))
                    .collect();
                if options.is_empty() { "zmc".to_owned() } else { format!("zmc({})", options.join(" ")) }
            }
        }
    }

    /// The micro-contact of a rough and a flat body under this law. The law is chosen here, once a run.
    pub fn interface(&self, rough: &Material, flat: &Flat) -> Box<dyn MicroContact> {
        match *self {
            Self::Hertz => flat.under(Hertz, rough),
            Self::Zmc { law, .. } => flat.under(law, rough),
        }
    }
}

/// The file's words: a one-key table names the law and holds its options.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Words {
    Hertz(NoOptions),
    Zmc(ZmcOptions),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct NoOptions {}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ZmcOptions {
    onset: Option<Quantity<Pure, Finite>>,
    transition_ratio: Option<Quantity<Pure, Finite>>,
}

impl TryFrom<Words> for LawSpec {
    type Error = crate::law::ZmcError;

    fn try_from(words: Words) -> Result<Self, Self::Error> {
        Ok(match words {
            Words::Hertz(NoOptions {}) => Self::Hertz,
            Words::Zmc(ZmcOptions { onset, transition_ratio }) => {
                let (onset, transition_ratio) =
                    (onset.map(|q| q.value()), transition_ratio.map(|q| q.value()));
                let law =
                    Zmc::new(onset.unwrap_or(Zmc::ONSET), transition_ratio.unwrap_or(Zmc::TRANSITION_RATIO))?;
                Self::Zmc { law, onset, transition_ratio }
            }
        })
    }
}

impl<'de> Deserialize<'de> for LawSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneLaw;

        impl<'de> Visitor<'de> for OneLaw {
            type Value = LawSpec;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(
                    "a law: \"hertz\" or \"zmc\", or a table of one law with its options, such as { zmc = { transition-ratio = 110 } }",
                )
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<LawSpec, E> {
                match name {
                    "hertz" => Ok(LawSpec::Hertz),
                    "zmc" => Ok(LawSpec::Zmc { law: Zmc::default(), onset: None, transition_ratio: None }),
                    _ => Err(E::custom(format!("found \"{name}\"; allowed: \"hertz\", \"zmc\""))),
                }
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<LawSpec, A::Error> {
                let words = Words::deserialize(MapAccessDeserializer::new(map))?;
                LawSpec::try_from(words).map_err(|error| A::Error::custom(format!("found {error}")))
            }
        }
        deserializer.deserialize_any(OneLaw)
    }
}

/// One law or a list of them, none twice.
#[derive(Debug, Clone, PartialEq)]
pub struct Laws(pub Vec<LawSpec>);

impl<'de> Deserialize<'de> for Laws {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct SomeLaws;

        impl<'de> Visitor<'de> for SomeLaws {
            type Value = Laws;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str(
                    "a law (\"hertz\", \"zmc\", or a table of one law with its options) or a list of laws",
                )
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<Laws, E> {
                Ok(Laws(vec![LawSpec::deserialize(StrDeserializer::new(name))?]))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Laws, A::Error> {
                Ok(Laws(vec![LawSpec::deserialize(MapAccessDeserializer::new(map))?]))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Laws, A::Error> {
                let mut laws = Vec::new();
                while let Some(law) = list.next_element::<LawSpec>()? {
                    if laws.contains(&law) {
                        return Err(A::Error::custom(format!(
                            "found {} twice; allowed: each law once",
                            law.label()
                        )));
                    }
                    laws.push(law);
                }
                if laws.is_empty() {
                    return Err(A::Error::custom("found an empty list; allowed: at least one law"));
                }
                Ok(Laws(laws))
            }
        }
        deserializer.deserialize_any(SomeLaws)
    }
}
