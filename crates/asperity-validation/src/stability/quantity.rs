//! The quantities whose errors are measured.

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// Area of a contact, area ratio.
    Area,
    /// Load of a contact, nominal pressure.
    Load,
    /// dP/dw of a contact, -dp/dd.
    Stiffness,
    /// Contacts per nominal area.
    Density,
    /// Parts of area and load that each regime has: the absolute error.
    Shares,
    /// Sampling errors of a sum: the error of the variance over the mean square.
    Sampling,
    /// The pressure that load control ends on.
    Reached,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 7] =
        [Self::Area, Self::Load, Self::Stiffness, Self::Density, Self::Shares, Self::Sampling, Self::Reached];

    /// As tables name it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Load => "load",
            Self::Stiffness => "stiffness",
            Self::Density => "contact density",
            Self::Shares => "regime shares",
            Self::Sampling => "sampling error",
            Self::Reached => "pressure reached",
        }
    }
}
