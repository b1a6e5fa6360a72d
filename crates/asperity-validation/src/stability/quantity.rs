//! The quantities whose errors are measured.

use asperity::named_enum;

named_enum! {
    /// What is measured.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum CheckedQuantity {
        /// Area of a contact, area ratio.
        Area = "area",
        /// Load of a contact, nominal pressure.
        Load = "load",
        /// dP/dw of a contact, -dp/dd.
        Stiffness = "stiffness",
        /// Contacts per nominal area.
        Density = "contact density",
        /// Parts of area and load that each regime has: the absolute error.
        Shares = "regime shares",
        /// Sampling errors of a sum: the error of the variance over the mean square.
        Sampling = "sampling error",
        /// The pressure that load control ends on.
        Reached = "pressure reached",
    }
}
