//! Words and colours that pages of several kinds share.

use asperity::Regime;
use asperity::compare::{Cause, ComparedQuantity};
use asperity_plot::Colour;

pub fn quantity_name(compared: ComparedQuantity) -> &'static str {
    match compared {
        ComparedQuantity::Separation => "separation",
        ComparedQuantity::Area => "real contact area",
        ComparedQuantity::Stiffness => "stiffness",
        ComparedQuantity::ElectricalConductance => "electrical conductance",
        ComparedQuantity::ThermalConductance => "thermal conductance",
        ComparedQuantity::Friction => "coefficient of friction",
    }
}

/// The unit of a difference in a quantity, and the factor to it from sigma or from a relative difference.
pub fn difference_unit(compared: ComparedQuantity) -> (&'static str, f64) {
    match compared {
        ComparedQuantity::Separation => ("σ", 1.0),
        _ => ("%", 100.0),
    }
}

pub fn cause_colour(cause: Cause) -> Colour {
    match cause {
        Cause::Heights => Colour::Heights,
        Cause::Radii => Colour::Radii,
        Cause::Correlation => Colour::Correlation,
    }
}

pub fn regime_colour(regime: Regime) -> Colour {
    match regime {
        Regime::Elastic => Colour::Elastic,
        Regime::ElasticPlastic => Colour::ElasticPlastic,
        Regime::Plastic => Colour::Plastic,
    }
}
