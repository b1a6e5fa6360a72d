//! Axes of a comparison, each in the units in which a reader may want it.

use asperity_plot::Axis;

use crate::kind::compare::results::{CompareResults, SurfaceResults};

/// What one unit is in another.
#[derive(Clone, Copy)]
pub struct Units {
    /// E*, Pa.
    pub modulus: f64,
    /// Nominal area, m².
    pub area: f64,
    /// What separations are measured in, m.
    pub sigma: f64,
}

impl Units {
    pub fn new(results: &CompareResults, found: &SurfaceResults) -> Self {
        Self {
            modulus: results.contact.reduced_modulus,
            area: found.surface.set.nominal_area(),
            sigma: found.surface.plane.sigma,
        }
    }

    pub fn load_ratio(&self) -> Axis {
        Axis::log("load ratio P/(A_nom E*)")
            .or_in("nominal pressure (MPa)", 1e-6 * self.modulus)
            .or_in("load (N)", self.modulus * self.area)
    }

    /// Loads in MPa.
    pub fn pressure(&self) -> Axis {
        Axis::log("nominal pressure (MPa)")
            .or_in("load ratio P/(A_nom E*)", 1e6 / self.modulus)
            .or_in("load (N)", 1e6 * self.area)
    }

    pub fn separation(&self) -> Axis {
        Axis::linear("separation d/σ").or_in("separation d (nm)", 1e9 * self.sigma)
    }

    /// Differences of separations, called `what`.
    pub fn separation_difference(&self, what: &str) -> Axis {
        Axis::linear(format!("{what} (σ)")).or_in(format!("{what} (nm)"), 1e9 * self.sigma)
    }
}

/// An axis of loads.
pub struct Loads {
    pub axis: Axis,
    /// What 1 Pa is on it.
    pub per_pascal: f64,
}

impl Units {
    pub fn ratios(&self) -> Loads {
        Loads { axis: self.load_ratio(), per_pascal: self.modulus.recip() }
    }

    /// Loads in MPa.
    pub fn pressures(&self) -> Loads {
        Loads { axis: self.pressure(), per_pascal: 1e-6 }
    }
}
