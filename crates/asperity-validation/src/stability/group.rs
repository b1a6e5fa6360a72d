//! The groups of cases, what is measured in each, and how far it may be off.

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

    /// As sentences name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Contact => "single contact",
            Self::Sum => "sum",
            Self::Integral => "integral",
            Self::Load => "load control",
        }
    }
}

/// How far a slope may be off that a table gives.
const SLOPE_OF_A_TABLE: f64 = 1e-11;

/// A group of cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Group {
    /// Anything, bare.
    Contacts,
    /// Anything, under a layer.
    LayeredContacts,
    /// Within 1e-15 of a boundary between two formulas.
    Boundaries,
    /// The same under a layer.
    LayeredBoundaries,
    /// Contacts as wide, or as deep, as the layer is thick, and layers 1e15 times thinner and thicker.
    Scales,
    /// Elliptic asperities.
    Ellipses,
    /// Indentations at the end of what `f64` can hold.
    Denormals,
    /// Sets of up to 300, bare.
    Sums,
    /// The same under a layer.
    LayeredSums,
    /// One asperity.
    OneAsperity,
    /// Heights that lie up to 1e6 sigma from zero.
    Offset,
    /// Evenly spaced heights.
    Line,
    /// All but one within a few ulp of the flat.
    Touching,
    /// All the same.
    Equal,
    /// A million of the same.
    MillionEqual,
    /// A million on a line.
    MillionLine,
    /// Gaussian heights, -10 to 20 sigma, bare.
    Integrals,
    /// The same under a layer.
    LayeredIntegrals,
    /// Heights of other distributions.
    OtherHeights,
    /// -20 to -10 sigma.
    Deep,
    /// 20 to 35 sigma.
    Tail,
    /// 35 to 37 sigma.
    Last,
    /// 37 to 40 sigma, where numbers turn denormal.
    Vanishing,
    /// Pressures of integrals.
    LoadsOfIntegrals,
    /// Pressures of sums.
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

    /// As tables name it.
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

    /// What its cases are.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Contacts => "any law, any pair, w from 1e-15 to 10 radii",
            Self::LayeredContacts => "the same under a layer",
            Self::Boundaries => "w within 1e-15 of a boundary between two formulas",
            Self::LayeredBoundaries => "the same under a layer, at every crossing",
            Self::Scales => "a/t within a few ulp of 1, layers 1e15 times thinner or thicker, w close to t",
            Self::Ellipses => "curvature ratios from 1 + 1e-15 to 1e12",
            Self::Denormals => "w from 5e-324 to 2e-293 m; errors relative to the result plus 1e-130 (SI)",
            Self::Sums => "1 to 300 Gaussian heights, radii within a factor of 4",
            Self::LayeredSums => "the same under a layer",
            Self::OneAsperity => "indentations of 1e-12 to 20 sigma",
            Self::Offset => "mean height of 1 to 1e6 sigma, either side of zero",
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
            Self::Vanishing => "d from 37 to 40 sigma; absolute error over that at 37 sigma",
            Self::LoadsOfIntegrals => "search for the pressure at d from -8 to 20 sigma",
            Self::LoadsOfSums => "search for the pressure at d from -4 to 2 sigma",
        }
    }

    /// What it evaluates.
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

    /// Whether its cases hold a million asperities: a few are enough.
    pub const fn is_large(self) -> bool {
        matches!(self, Self::MillionEqual | Self::MillionLine)
    }

    /// How far a quantity may be off under a law.
    pub fn bound_of(self, quantity: Quantity, law: &CoveredLaw) -> f64 {
        let is_slope = quantity == Quantity::Stiffness && law.twin.has_tables;
        let bound = if is_slope { SLOPE_OF_A_TABLE } else { self.bound(quantity) };
        bound * (law.twin.steepness)(law.chosen())
    }

    /// The same under laws of closed formulas; `docs/stability.md` says where each bound is from.
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
