//! The registry of contact laws, chosen by name at run time.
//!
//! Each law is one line of [`registry`], over which specs, conformance tests and benchmarks iterate. A law of another
//! crate becomes a [`ContactLaw`] in the same way:
//!
//! ```
//! use asperity::contact_law::{ContactLaw, named};
//! use asperity::{Flat, Material, Shape, Zmc};
//!
//! let steel = Material::new(210e9, 0.3, Some(7.6e9), None)?;
//! let by_name = named("zmc").unwrap().with_options(&[("transition-ratio", 110.0)])?;
//! let by_type = ContactLaw::scalable(Zmc::new(Zmc::ONSET, 110.0)?);
//! let [a, b] = [by_name, by_type].map(|law| law.interface(&steel, &Flat::Bare(steel)).unwrap());
//! let sphere = Shape::sphere(20e-6);
//! assert_eq!(a.contact(1e-9, sphere), b.contact(1e-9, sphere));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::fmt;
use std::sync::{Arc, LazyLock};

use crate::interface::{Flat, MicroContact};
use crate::law::{
    self, Body, Inapplicable, Law, LawOption, OptionError, Pair, ScalableLaw, Shape, YieldLimits,
};
use crate::literature::{self, Paper};
use crate::material::Material;

/// All laws, with their default options.
pub fn registry() -> &'static [ContactLaw] {
    static LAWS: LazyLock<Vec<ContactLaw>> = LazyLock::new(|| {
        vec![
            ContactLaw::scalable(law::Hertz),
            ContactLaw::scalable(law::Zmc::default()),
            ContactLaw::scalable(law::Ceb),
            ContactLaw::scalable(law::KogutEtsion),
            ContactLaw::homogeneous(law::JacksonGreen::default()),
            ContactLaw::scalable(law::FullyPlastic),
            ContactLaw::scalable(law::Hertz).on_ellipses(law::Hertz::ON_ELLIPSES),
            ContactLaw::scalable(law::Zmc::default()).on_ellipses(law::Zmc::ON_ELLIPSES),
        ]
    });
    &LAWS
}

/// The law called `name`, with its default options; `None` if there is none.
pub fn named(name: &str) -> Option<ContactLaw> {
    registry().iter().find(|law| law.name() == name).cloned()
}

/// A contact law of any type, with its options, for spheres or for ellipses.
///
/// Two laws are equal if their names and all option values are.
#[derive(Clone)]
pub struct ContactLaw {
    law: Arc<dyn AnyLaw>,
    /// Names of the options that were given.
    given: Vec<&'static str>,
    /// Description of the law for ellipses; `None` for a law on spheres.
    on_ellipses: Option<&'static str>,
}

impl ContactLaw {
    /// A law that applies to homogeneous bodies and to layered flats.
    pub fn scalable(law: impl ScalableLaw) -> Self {
        Self::new(OnFlat { law, on: Flat::under, supports_layers: true })
    }

    /// A law that applies to homogeneous bodies only.
    pub fn homogeneous(law: impl Law + Clone) -> Self {
        Self::new(OnFlat { law, on: Flat::homogeneous_under, supports_layers: false })
    }

    fn new(law: OnFlat<impl Law + Clone>) -> Self {
        Self { law: Arc::new(law), given: Vec::new(), on_ellipses: None }
    }

    /// The same law for elliptic paraboloids (see [`Shape`]), described by `about`.
    pub fn on_ellipses(self, about: &'static str) -> Self {
        Self { on_ellipses: Some(about), ..self }
    }

    /// The same law with options set by name; the others are unchanged.
    ///
    /// # Errors
    /// An unknown option, or a value out of range.
    pub fn with_options(&self, options: &[(&str, f64)]) -> Result<Self, OptionError> {
        let (mut values, mut given) = (self.law().option_values(), self.given.clone());
        for (name, value) in options {
            let place = self.option(name)?;
            values[place] = *value;
            given.push(self.law().options()[place].name);
        }
        Ok(Self { law: self.law.with_options(&values)?, given, ..self.clone() })
    }

    /// The index of the option called `name` in [`Law::options`].
    ///
    /// # Errors
    /// The law has no such option.
    pub fn option(&self, name: &str) -> Result<usize, OptionError> {
        let options = self.law().options();
        options.iter().position(|option| option.name == name).ok_or_else(|| {
            let (option, names) =
                (name.to_owned(), options.iter().map(|option| format!("`{}`", option.name)));
            match names.collect::<Vec<String>>().join(" or ") {
                none if none.is_empty() => OptionError::NoOptions { option },
                allowed => OptionError::Unknown { option, allowed },
            }
        })
    }

    /// The options that were given or differ from their defaults, with their values.
    pub fn options_given(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let options = self.law().options().iter().zip(self.law().option_values());
        let is_given = |option: &LawOption| self.given.contains(&option.name);
        let given = options.filter(move |(option, value)| is_given(option) || option.default != *value);
        given.map(|(option, value)| (option.name, value))
    }

    /// The value of an option that was given or differs from its default.
    pub fn given(&self, option: &str) -> Option<f64> {
        self.options_given().find(|(name, _)| *name == option).map(|(_, value)| value)
    }

    /// The law itself.
    pub fn law(&self) -> &dyn Law {
        self.law.law()
    }

    /// The name in specs.
    pub fn name(&self) -> String {
        let shape = if self.is_elliptic() { "elliptic-" } else { "" };
        format!("{shape}{}", self.law().name())
    }

    /// The name in tables and plots: the name followed by the options that were set, as in
    /// "zmc(transition-ratio=110)".
    pub fn label(&self) -> String {
        let options: Vec<String> =
            self.options_given().map(|(name, value)| format!("{name}={value}")).collect();
        let name = self.name();
        if options.is_empty() { name } else { format!("{name}({})", options.join(" ")) }
    }

    /// One-line description and range of validity, for reports.
    pub fn about(&self) -> &'static str {
        self.on_ellipses.unwrap_or_else(|| self.law().about())
    }

    /// The sources of the law.
    pub fn papers(&self) -> Vec<Paper> {
        let ellipse = self.is_elliptic().then_some(literature::JOHNSON_1985);
        self.law().papers().iter().copied().chain(ellipse).collect()
    }

    /// Whether asperities are elliptic paraboloids rather than spheres of the mean curvature.
    pub fn is_elliptic(&self) -> bool {
        self.on_ellipses.is_some()
    }

    /// The shape of an asperity of mean curvature 1/`radius` (m) and a ratio of principal curvatures: a sphere unless
    /// [`Self::is_elliptic`].
    pub fn shape(&self, radius: f64, curvature_ratio: f64) -> Shape {
        if self.is_elliptic() {
            Shape::ellipse(radius.recip(), curvature_ratio)
        } else {
            Shape::sphere(radius)
        }
    }

    /// Whether the law applies to a flat with a layer of finite thickness.
    pub fn supports_layers(&self) -> bool {
        self.law.supports_layers()
    }

    /// Whether the law has several ranges, such as elastic and plastic.
    pub fn has_ranges(&self) -> bool {
        let yielding = Pair { reduced_modulus: 1.0, yield_limits: YieldLimits { onset: 1.0, strength: 1.0 } };
        !self.law().critical_ratios(&yielding).is_empty()
    }

    /// Whether the law is Hertz on spheres, whose sums over Gaussian heights have a closed form.
    pub fn is_greenwood_williamson(&self) -> bool {
        self.law().is_hertz() && !self.is_elliptic()
    }

    /// Checks whether the law applies to a rough and a homogeneous flat body.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn check(&self, rough: &Material, flat: &Material) -> Result<(), Inapplicable> {
        Pair::between(self.law(), rough, flat).map(|_| ())
    }

    /// The micro-contact of a rough and a flat body under this law.
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn interface(&self, rough: &Material, flat: &Flat) -> Result<Box<dyn MicroContact>, Inapplicable> {
        self.law.on(flat, rough)
    }

    /// The micro-contact of the `body` that may have a layer and of the `bare` one under this law.
    ///
    /// A contact of two bodies depends on the sum of their compliances and on the weaker of their yield limits only, so that
    /// the micro-contact of a coated rough body on a bare flat is that of [`Self::interface`] with the bodies exchanged. The coated
    /// asperity is then taken as a layered half-space, as the coated flat is: its radius must be large against the thickness
    /// of the layer, which follows the surface.
    ///
    /// ```
    /// use asperity::contact_law::named;
    /// use asperity::law::Body;
    /// use asperity::{Flat, Material, ModulusModel, Shape};
    ///
    /// let (steel, bronze) = (Material::new(210e9, 0.3, Some(7.6e9), None)?, Material::new(110e9, 0.34, Some(1.9e9), None)?);
    /// let dlc = Material::new(160e9, 0.2, Some(16e9), None)?;
    /// let coated_steel = Flat::with_layer(&dlc, &steel, 1e-6, ModulusModel::Gao)?;
    /// let contact = named("zmc").unwrap().interface_of(&coated_steel, Body::Rough, &bronze)?;
    /// assert!(contact.contact(1e-9, Shape::sphere(50e-6)).load > 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// See [`Inapplicable`].
    pub fn interface_of(
        &self,
        layered: &Flat,
        body: Body,
        bare: &Material,
    ) -> Result<Box<dyn MicroContact>, Inapplicable> {
        let contact = self.interface(bare, layered);
        match body {
            Body::Flat => contact,
            Body::Rough => contact.map_err(Inapplicable::exchanged),
        }
    }

    /// See [`Law::tuned`].
    pub fn tuned(&self, pair: &Pair) -> Self {
        Self { law: self.law.tuned(pair), ..self.clone() }
    }
}

impl PartialEq for ContactLaw {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name() && self.law().option_values() == other.law().option_values()
    }
}

impl fmt::Debug for ContactLaw {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.label())
    }
}

/// Type-erased operations on a law.
trait AnyLaw: Send + Sync {
    fn law(&self) -> &dyn Law;
    fn supports_layers(&self) -> bool;
    fn with_options(&self, values: &[f64]) -> Result<Arc<dyn AnyLaw>, OptionError>;
    fn tuned(&self, pair: &Pair) -> Arc<dyn AnyLaw>;
    fn on(&self, flat: &Flat, rough: &Material) -> Result<Box<dyn MicroContact>, Inapplicable>;
}

/// Constructs the micro-contact of a law on a flat.
type PutOnFlat<L> = fn(&Flat, L, &Material) -> Result<Box<dyn MicroContact>, Inapplicable>;

/// A law and the constructor of its micro-contacts.
#[derive(Clone)]
struct OnFlat<L> {
    law: L,
    on: PutOnFlat<L>,
    supports_layers: bool,
}

impl<L: Law + Clone> AnyLaw for OnFlat<L> {
    fn law(&self) -> &dyn Law {
        &self.law
    }
    fn supports_layers(&self) -> bool {
        self.supports_layers
    }
    fn with_options(&self, values: &[f64]) -> Result<Arc<dyn AnyLaw>, OptionError> {
        Ok(Arc::new(Self { law: self.law.clone().with_options(values)?, ..*self }))
    }
    fn tuned(&self, pair: &Pair) -> Arc<dyn AnyLaw> {
        Arc::new(Self { law: self.law.clone().tuned(pair), ..*self })
    }
    fn on(&self, flat: &Flat, rough: &Material) -> Result<Box<dyn MicroContact>, Inapplicable> {
        (self.on)(flat, self.law.clone(), rough)
    }
}
