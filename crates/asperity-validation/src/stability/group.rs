//! The groups of cases, with the quantities compared in each and their error bounds.

use super::laws::CoveredLaw;
use super::quantity::Quantity;

/// What a case evaluates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// Single contacts.
    Contact,
    /// Sums over asperities.
    Sum,
    /// Integrals over a height density.
    Integral,
    /// Load control.
    Load,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Contact, Self::Sum, Self::Integral, Self::Load];

    /// The name in sentences.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Contact => "single contact",
            Self::Sum => "sum",
            Self::Integral => "integral",
            Self::Load => "load control",
        }
    }
}

/// Largest relative error allowed for a stiffness that is computed from a table.
const SLOPE_OF_A_TABLE: f64 = 1e-11;

/// A group of cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Group {
    /// Any law and material pair, uncoated.
    Contacts,
    /// Any law and material pair, under a layer.
    LayeredContacts,
    /// Within 1e-15 of a boundary between two formulas.
    Boundaries,
    /// The same under a layer.
    LayeredBoundaries,
    /// Contact radii or indentations equal to the layer thickness, and layers 1e15 times thinner and thicker.
    Scales,
    /// Elliptic asperities.
    Ellipses,
    /// Indentations down to the smallest denormal `f64`.
    Denormals,
    /// Sets of up to 300 asperities, uncoated.
    Sums,
    /// The same under a layer.
    LayeredSums,
    /// One asperity.
    OneAsperity,
    /// Heights with a mean of up to 1e8 sigma.
    Offset,
    /// Evenly spaced heights.
    Line,
    /// All asperities but one within a few ulp of the flat.
    Touching,
    /// Asperities of equal height and radius.
    Equal,
    /// A million equal asperities.
    MillionEqual,
    /// A million evenly spaced heights.
    MillionLine,
    /// Gaussian heights, separations from -10 to 20 sigma, uncoated.
    Integrals,
    /// The same under a layer.
    LayeredIntegrals,
    /// Heights of other distributions.
    OtherHeights,
    /// Separations from -20 to -10 sigma.
    Deep,
    /// Separations from 20 to 35 sigma.
    Tail,
    /// Separations from 35 to 37 sigma.
    Last,
    /// Separations from 37 to 40 sigma, where results become denormal.
    Vanishing,
    /// Load control of integrals.
    LoadsOfIntegrals,
    /// Load control of sums.
    LoadsOfSums,
}

impl Group {
    /// All groups.
    pub const ALL: [Self; 25] = [
        Self::Contacts,
        Self::LayeredContacts,
        Self::Boundaries,
        Self::LayeredBoundaries,
        Self::Scales,
        Self::Ellipses,
        Self::Denormals,
        Self::Sums,
        Self::LayeredSums,
        Self::OneAsperity,
        Self::Offset,
        Self::Line,
        Self::Touching,
        Self::Equal,
        Self::MillionEqual,
        Self::MillionLine,
        Self::Integrals,
        Self::LayeredIntegrals,
        Self::OtherHeights,
        Self::Deep,
        Self::Tail,
        Self::Last,
        Self::Vanishing,
        Self::LoadsOfIntegrals,
        Self::LoadsOfSums,
    ];

    /// The name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Contacts => "any contact",
            Self::LayeredContacts => "any contact, layer",
            Self::Boundaries => "beside a boundary",
            Self::LayeredBoundaries => "beside a boundary, layer",
            Self::Scales => "scales of the layer",
            Self::Ellipses => "ellipses",
            Self::Denormals => "denormal indentation",
            Self::Sums => "any sum",
            Self::LayeredSums => "any sum, layer",
            Self::OneAsperity => "one asperity",
            Self::Offset => "offset heights",
            Self::Line => "on a line",
            Self::Touching => "just touching",
            Self::Equal => "equal",
            Self::MillionEqual => "a million equal",
            Self::MillionLine => "a million on a line",
            Self::Integrals => "any integral",
            Self::LayeredIntegrals => "any integral, layer",
            Self::OtherHeights => "other heights",
            Self::Deep => "deep",
            Self::Tail => "far tail",
            Self::Last => "end of the tail",
            Self::Vanishing => "denormal density",
            Self::LoadsOfIntegrals => "pressure of an integral",
            Self::LoadsOfSums => "pressure of a sum",
        }
    }

    /// Description of its cases.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Contacts => "all laws, random material pairs, w from 1e-15 to 10 radii",
            Self::LayeredContacts => "the same under a layer",
            Self::Boundaries => "w within 1e-15 of a boundary between two formulas",
            Self::LayeredBoundaries => "the same under a layer, at every crossing of a boundary",
            Self::Scales => "a/t within a few ulp of 1, layers 1e15 times thinner or thicker, w close to t",
            Self::Ellipses => "curvature ratios from 1 + 1e-15 to 1e12",
            Self::Denormals => "w from 5e-324 to 2e-293 m; errors relative to the result plus 1e-130 (SI)",
            Self::Sums => "1 to 300 Gaussian heights, radii within a factor of 4",
            Self::LayeredSums => "the same under a layer",
            Self::OneAsperity => "indentations of 1e-12 to 20 sigma",
            Self::Offset => "mean height of 1 to 1e8 sigma above or below zero",
            Self::Line => "evenly spaced heights",
            Self::Touching => "all but one within 4 ulp of the flat",
            Self::Equal => "1 to 300 asperities of equal height and radius",
            Self::MillionEqual => "compared with the exact sum of the terms",
            Self::MillionLine => "compared with the exact sum of the terms",
            Self::Integrals => "Gaussian heights, d from -10 to 20 sigma",
            Self::LayeredIntegrals => "the same under a layer",
            Self::OtherHeights => "other distributions that are covered, d from -10 to 20 sigma",
            Self::Deep => "d from -20 to -10 sigma",
            Self::Tail => "d from 20 to 35 sigma",
            Self::Last => "d from 35 to 37 sigma",
            Self::Vanishing => "d from 37 to 40 sigma; error relative to the value at 37 sigma",
            Self::LoadsOfIntegrals => "load control at the pressures of d from -8 to 20 sigma",
            Self::LoadsOfSums => "load control at the pressures of d from -4 to 2 sigma",
        }
    }

    /// The kind of evaluation of its cases.
    pub const fn kind(self) -> Kind {
        match self {
            Self::Contacts
            | Self::LayeredContacts
            | Self::Boundaries
            | Self::LayeredBoundaries
            | Self::Scales
            | Self::Ellipses
            | Self::Denormals => Kind::Contact,
            Self::Sums
            | Self::LayeredSums
            | Self::OneAsperity
            | Self::Offset
            | Self::Line
            | Self::Touching
            | Self::Equal
            | Self::MillionEqual
            | Self::MillionLine => Kind::Sum,
            Self::Integrals
            | Self::LayeredIntegrals
            | Self::OtherHeights
            | Self::Deep
            | Self::Tail
            | Self::Last
            | Self::Vanishing => Kind::Integral,
            Self::LoadsOfIntegrals | Self::LoadsOfSums => Kind::Load,
        }
    }

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

    /// Largest relative error allowed for a quantity under a law.
    pub fn bound_of(self, quantity: Quantity, law: &CoveredLaw) -> f64 {
        let is_slope = quantity == Quantity::Stiffness && law.twin.has_tables;
        let bound = if is_slope { SLOPE_OF_A_TABLE } else { self.bound(quantity) };
        bound * (law.twin.steepness)(law.chosen())
    }

    /// The same for laws in closed form; `docs/stability.md` gives the reason for each bound.
    pub fn bound(self, quantity: Quantity) -> f64 {
        match self {
            _ if quantity == Quantity::Stiffness && self.is_layered() => SLOPE_OF_A_TABLE,
            Self::Contacts | Self::Boundaries | Self::Ellipses | Self::Denormals => 1e-14,
            Self::Sums | Self::OneAsperity | Self::Offset | Self::Line | Self::Touching | Self::Equal => {
                1e-14
            }
            Self::LayeredContacts | Self::LayeredBoundaries | Self::Scales | Self::LayeredSums => 1e-12,
            Self::MillionEqual | Self::MillionLine => 4.0 * f64::EPSILON,
            Self::Integrals | Self::OtherHeights | Self::Deep => 1e-13,
            Self::LayeredIntegrals => 1e-12,
            Self::Tail => 2e-13,
            Self::Last => 3e-13,
            Self::Vanishing => 1e-15,
            Self::LoadsOfIntegrals | Self::LoadsOfSums => 1e-12,
        }
    }
}
