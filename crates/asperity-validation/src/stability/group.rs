//! The groups of cases, with their error bounds.

use super::laws::CoveredLaw;
use super::quantity::CheckedQuantity;
use asperity::named_enum;

named_enum! {
    /// What a case evaluates.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub enum CheckKind {
        /// Single contacts.
        Contact = "single contact",
        /// Sums over asperities.
        Sum = "sum",
        /// Integrals over a height density.
        Integral = "integral",
        /// Load control.
        Load = "load control",
    }
}

/// The groups, a line each: name, kind, largest relative error allowed under laws in closed form (`docs/stability.md` gives the reason),
/// and description.
macro_rules! groups {
    ($($group:ident = $name:literal, $kind:ident, $bound:expr, $about:literal;)+) => {
        named_enum! {
            /// A group of cases.
            #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
            pub enum Group {
                $(#[doc = $about] $group = $name,)+
            }
        }

        impl Group {
            /// Description of its cases.
            pub const fn about(self) -> &'static str {
                match self { $(Self::$group => $about,)+ }
            }

            /// The kind of evaluation of its cases.
            pub const fn kind(self) -> CheckKind {
                match self { $(Self::$group => CheckKind::$kind,)+ }
            }

            const fn bound_in_closed_form(self) -> f64 {
                match self { $(Self::$group => $bound,)+ }
            }
        }
    };
}

groups! {
    Contacts = "any contact", Contact, 1e-14, "all laws, random material pairs, w from 1e-15 to 10 radii";
    LayeredContacts = "any contact, layer", Contact, 1e-12, "the same under a layer";
    Boundaries = "beside a boundary", Contact, 1e-14, "w within 1e-15 of a boundary between two formulas";
    LayeredBoundaries = "beside a boundary, layer", Contact, 1e-12, "the same under a layer, at every crossing of a boundary";
    Scales = "scales of the layer", Contact, 1e-12, "a/t within a few ulp of 1, layers 1e15 times thinner or thicker, w close to t";
    Ellipses = "ellipses", Contact, 1e-14, "curvature ratios from 1 + 1e-15 to 1e12";
    Denormals = "denormal indentation", Contact, 1e-14, "w from 5e-324 to 2e-293 m; errors relative to the result plus 1e-130 (SI)";
    Sums = "any sum", Sum, 1e-14, "1 to 300 Gaussian heights, radii within a factor of 4";
    LayeredSums = "any sum, layer", Sum, 1e-12, "the same under a layer";
    OneAsperity = "one asperity", Sum, 1e-14, "indentations of 1e-12 to 20 sigma";
    Offset = "offset heights", Sum, 1e-14, "mean height of 1 to 1e8 sigma above or below zero";
    Line = "on a line", Sum, 1e-14, "evenly spaced heights";
    Touching = "just touching", Sum, 1e-14, "all but one within 4 ulp of the flat";
    Equal = "equal", Sum, 1e-14, "1 to 300 asperities of equal height and radius";
    MillionEqual = "a million equal", Sum, 4.0 * f64::EPSILON, "compared with the exact sum of the terms";
    MillionLine = "a million on a line", Sum, 4.0 * f64::EPSILON, "compared with the exact sum of the terms";
    Integrals = "any integral", Integral, 1e-13, "Gaussian heights, d from -10 to 20 sigma";
    LayeredIntegrals = "any integral, layer", Integral, 1e-12, "the same under a layer";
    OtherHeights = "other heights", Integral, 1e-13, "other distributions that are covered, d from -10 to 20 sigma";
    Deep = "deep", Integral, 1e-13, "d from -20 to -10 sigma";
    Tail = "far tail", Integral, 2e-13, "d from 20 to 35 sigma";
    Last = "end of the tail", Integral, 3e-13, "d from 35 to 37 sigma";
    Vanishing = "denormal density", Integral, 1e-15, "d from 37 to 40 sigma; error relative to the value at 37 sigma";
    LoadsOfIntegrals = "pressure of an integral", Load, 1e-12, "load control at the pressures of d from -8 to 20 sigma";
    LoadsOfSums = "pressure of a sum", Load, 1e-12, "load control at the pressures of d from -4 to 2 sigma";
}

impl Group {
    /// Whether a layer lies on the flat.
    pub const fn is_layered(self) -> bool {
        matches!(
            self,
            Self::LayeredContacts
                | Self::LayeredBoundaries
                | Self::Scales
                | Self::LayeredSums
                | Self::LayeredIntegrals
        )
    }

    /// Whether its cases have a million asperities, so that a few cases are enough.
    pub const fn is_large(self) -> bool {
        matches!(self, Self::MillionEqual | Self::MillionLine)
    }

    /// Largest relative error allowed for a quantity, before the factor of a narrow transition; without a layer, under laws in closed form.
    pub fn bound(self, quantity: CheckedQuantity) -> f64 {
        self.bound_of_slope(quantity, self.is_layered())
    }

    /// The same under a law.
    pub fn bound_under(self, quantity: CheckedQuantity, law: &CoveredLaw) -> f64 {
        let has_tables = self.is_layered() || law.twin.has_tables;
        self.bound_of_slope(quantity, has_tables) * (law.twin.steepness)(law.chosen())
    }

    /// A stiffness that is the slope of a table has fewer digits.
    const fn bound_of_slope(self, quantity: CheckedQuantity, has_tables: bool) -> f64 {
        match quantity {
            CheckedQuantity::Stiffness if has_tables => 1e-11,
            _ => self.bound_in_closed_form(),
        }
    }
}
