//! `law = "zmc"`, `law.zmc = { transition-ratio = 110 }`, or a list of these.

use std::fmt;

use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use crate::input::quantity::{Finite, Pure, Quantity};
use asperity::interface::{Flat, MicroContact};
use asperity::law::{
    Ceb, FullyPlastic, Hertz, Inapplicable, JacksonGreen, KogutEtsion, Law, Pair, Property, Zmc, ZmcError,
};
use asperity::literature::{self, Paper};
use asperity::material::Material;

/// A law as a spec names it, with its options checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawSpec {
    /// The equations.
    pub equations: Equations,
    /// What it takes asperities for.
    pub summit: Summit,
}

/// What a law takes asperities for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Summit {
    /// Spheres of the mean curvature.
    Sphere,
    /// Paraboloids of two principal curvatures.
    Ellipse,
}

/// The equations of a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Equations {
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
    /// Chang, Etsion and Bogy.
    Ceb,
    /// Kogut and Etsion.
    KogutEtsion,
    /// Jackson and Green.
    JacksonGreen,
    /// Abbott and Firestone.
    FullyPlastic,
}

impl LawSpec {
    /// All laws, without options.
    fn all() -> [Self; 8] {
        let zmc = Equations::Zmc { law: Zmc::default(), onset: None, transition_ratio: None };
        let sphere = |equations| Self { equations, summit: Summit::Sphere };
        let ellipse = |equations| Self { equations, summit: Summit::Ellipse };
        [
            sphere(Equations::Hertz),
            sphere(zmc),
            sphere(Equations::Ceb),
            sphere(Equations::KogutEtsion),
            sphere(Equations::JacksonGreen),
            sphere(Equations::FullyPlastic),
            ellipse(Equations::Hertz),
            ellipse(zmc),
        ]
    }

    /// The law of a name, without options.
    fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|law| law.label() == name)
    }

    /// The law of the equations.
    fn law(&self) -> Box<dyn AnyLaw> {
        match self.equations {
            Equations::Hertz => Box::new(On(Hertz, Flat::under)),
            Equations::Zmc { law, .. } => Box::new(On(law, Flat::under)),
            Equations::Ceb => Box::new(On(Ceb, Flat::under)),
            Equations::KogutEtsion => Box::new(On(KogutEtsion, Flat::under)),
            Equations::JacksonGreen => Box::new(On(JacksonGreen::default(), Flat::homogeneous_under)),
            Equations::FullyPlastic => Box::new(On(FullyPlastic, Flat::under)),
        }
    }

    /// How tables and plots name the law: its options stand behind it.
    pub fn label(&self) -> String {
        let shape = if self.summit == Summit::Ellipse { "elliptic-" } else { "" };
        let mut options = Vec::new();
        if let Equations::Zmc { onset, transition_ratio, .. } = self.equations {
            let given = [("onset", onset), ("transition-ratio", transition_ratio)].into_iter();
            options.extend(given.filter_map(|(name, value)| Some(format!("{name}={}", value?))));
        }
        let options = if options.is_empty() { String::new() } else { format!("({})", options.join(" ")) };
        format!("{shape}{}{options}", self.law().name())
    }

    /// Whether it is the same law, whatever options its words spell out.
    fn is_same(&self, other: &Self) -> bool {
        let same = match (self.equations, other.equations) {
            (Equations::Zmc { law, .. }, Equations::Zmc { law: other, .. }) => law == other,
            (equations, other) => equations == other,
        };
        same && self.summit == other.summit
    }

    /// Whether it is purely elastic spheres, with a closed form for Gaussian heights.
    pub fn is_greenwood_williamson(&self) -> bool {
        *self == Self { equations: Equations::Hertz, summit: Summit::Sphere }
    }

    /// The property of the bodies that it takes their yielding from.
    pub fn takes(&self) -> Option<Property> {
        match self.equations {
            Equations::Hertz => None,
            Equations::JacksonGreen => Some(Property::YieldStrength),
            _ => Some(Property::Hardness),
        }
    }

    /// Whether contacts under it pass from elastic to something else.
    pub fn passes_regimes(&self) -> bool {
        !matches!(self.equations, Equations::Hertz | Equations::FullyPlastic)
    }

    /// Whether the law says anything of a rough and a homogeneous flat body.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn check(&self, rough: &Material, flat: &Material) -> Result<(), Inapplicable> {
        self.law().check(rough, flat)
    }

    /// The micro-contact of a rough and a flat body under this law. The law is chosen here, once a run.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn interface(&self, rough: &Material, flat: &Flat) -> Result<Box<dyn MicroContact>, Inapplicable> {
        self.law().on(flat, rough)
    }

    /// What it is and where it holds, in a line of a report.
    pub fn about(&self) -> &'static str {
        match (self.summit, self.equations) {
            (Summit::Ellipse, Equations::Zmc { .. }) => {
                "The regimes of Zhao, Maietta and Chang on an elliptic paraboloid: Hertz's ellipse of the two principal \
                 curvatures, its own onset of yield. Derived here from Hertz's solution, not fitted."
            }
            (Summit::Ellipse, Equations::Hertz) => {
                "Hertz's elastic contact of an elliptic paraboloid of two principal curvatures. Holds below the onset of \
                 yield."
            }
            _ => self.law().about(),
        }
    }

    /// The papers behind what it takes asperities for.
    pub fn papers(&self) -> &'static [Paper] {
        match self.summit {
            Summit::Sphere => &[],
            Summit::Ellipse => &[literature::JOHNSON_1985],
        }
    }
}

/// A law, which one it may be.
trait AnyLaw {
    fn name(&self) -> &'static str;
    fn about(&self) -> &'static str;
    fn check(&self, rough: &Material, flat: &Material) -> Result<(), Inapplicable>;
    fn on(&self, flat: &Flat, rough: &Material) -> OnFlat;
}

/// A law and how it is put on a flat.
struct On<L>(L, fn(&Flat, L, &Material) -> OnFlat);

type OnFlat = Result<Box<dyn MicroContact>, Inapplicable>;

impl<L: Law> AnyLaw for On<L> {
    fn name(&self) -> &'static str {
        self.0.name()
    }
    fn about(&self) -> &'static str {
        self.0.about()
    }
    fn check(&self, rough: &Material, flat: &Material) -> Result<(), Inapplicable> {
        Pair::between(&self.0, rough, flat).map(|_| ())
    }
    fn on(&self, flat: &Flat, rough: &Material) -> OnFlat {
        (self.1)(flat, self.0.clone(), rough)
    }
}

/// The options of a law.
enum Options {
    None(Equations, Summit),
    Zmc(ZmcOptions, Summit),
}

/// The options of the law of a name.
struct Named<'a>(&'a str);

impl<'de> DeserializeSeed<'de> for Named<'_> {
    type Value = Options;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Options, D::Error> {
        let law = LawSpec::named(self.0).ok_or_else(|| {
            D::Error::custom(format!("found the law \"{}\"; allowed: {}", self.0, allowed()))
        })?;
        if matches!(law.equations, Equations::Zmc { .. }) {
            return ZmcOptions::deserialize(deserializer).map(|options| Options::Zmc(options, law.summit));
        }
        NoOptions::deserialize(deserializer).map(|NoOptions {}| Options::None(law.equations, law.summit))
    }
}

/// The table of a law that has no options.
struct NoOptions {}

impl<'de> Deserialize<'de> for NoOptions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Nothing;

        impl<'de> Visitor<'de> for Nothing {
            type Value = NoOptions;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an empty table {}: this law has no options")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<NoOptions, A::Error> {
                match map.next_key::<String>()? {
                    None => Ok(NoOptions {}),
                    Some(option) => Err(A::Error::custom(format!(
                        "found the option `{option}`; allowed: none of this law (onset and transition-ratio are options of \
                         zmc and elliptic-zmc)"
                    ))),
                }
            }
        }
        deserializer.deserialize_map(Nothing)
    }
}

#[derive(Deserialize, Default)]
#[serde(
    deny_unknown_fields,
    rename_all = "kebab-case",
    expecting = "a table of options, such as { transition-ratio = 110 }"
)]
struct ZmcOptions {
    onset: Option<Quantity<Pure, Finite>>,
    transition_ratio: Option<Quantity<Pure, Finite>>,
}

impl TryFrom<ZmcOptions> for Equations {
    type Error = ZmcError;

    fn try_from(options: ZmcOptions) -> Result<Self, ZmcError> {
        let value = |quantity: Option<Quantity<Pure, Finite>>| quantity.map(|q| q.value());
        let (onset, transition_ratio) = (value(options.onset), value(options.transition_ratio));
        let law = Zmc::new(onset.unwrap_or(Zmc::ONSET), transition_ratio.unwrap_or(Zmc::TRANSITION_RATIO))?;
        Ok(Self::Zmc { law, onset, transition_ratio })
    }
}

impl TryFrom<Options> for LawSpec {
    type Error = ZmcError;

    fn try_from(options: Options) -> Result<Self, ZmcError> {
        Ok(match options {
            Options::None(equations, summit) => Self { equations, summit },
            Options::Zmc(options, summit) => Self { equations: options.try_into()?, summit },
        })
    }
}

/// The names of all laws, for a error.
fn allowed() -> String {
    LawSpec::all().map(|law| format!("\"{}\"", law.label())).join(", ")
}

impl<'de> Deserialize<'de> for LawSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct OneLaw;

        impl<'de> Visitor<'de> for OneLaw {
            type Value = LawSpec;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(
                    f,
                    "a law ({}), or a table of one law with its options, such as {{ zmc = {{ transition-ratio = 110 }} }}",
                    allowed()
                )
            }
            fn visit_str<E: Error>(self, name: &str) -> Result<LawSpec, E> {
                LawSpec::named(name)
                    .ok_or_else(|| E::custom(format!("found \"{name}\"; allowed: {}", allowed())))
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<LawSpec, A::Error> {
                const ALLOWED: &str =
                    "allowed: one law a table; several laws as a list, each in a table or in quotes";
                let Some(name) = map.next_key::<String>()? else {
                    return Err(A::Error::custom(format!("found an empty table; {ALLOWED}")));
                };
                let words = map.next_value_seed(Named(&name))?;
                if let Some(second) = map.next_key::<String>()? {
                    return Err(A::Error::custom(format!(
                        "found two laws in one table, \"{name}\" and \"{second}\"; {ALLOWED}"
                    )));
                }
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
                write!(f, "a law ({}, or a table of one law with its options) or a list of laws", allowed())
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
                    if laws.iter().any(|other: &LawSpec| other.is_same(&law)) {
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
