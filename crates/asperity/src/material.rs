//! Materials and the reduced properties of a pair.

use crate::numeric::is_positive;

/// The elastic and plastic properties of one body, checked by [`Material::new`], and how it conducts, where that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    young: f64,
    poisson: f64,
    hardness: Option<f64>,
    yield_strength: Option<f64>,
    resistivity: Option<f64>,
    thermal_conductivity: Option<f64>,
}

/// A property out of its physical range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum MaterialError {
    /// Young's modulus must be positive and finite.
    #[error("Young's modulus {0} Pa; allowed: positive and finite")]
    Young(f64),
    /// Poisson's ratio must lie in [0, 0.5].
    #[error("Poisson's ratio {0}; allowed: 0 to 0.5")]
    Poisson(f64),
    /// Hardness must be positive and finite; a body that never yields has none.
    #[error("hardness {0} Pa; allowed: positive and finite, or left out for a body that never yields")]
    Hardness(f64),
    /// Yield strength must be positive and finite.
    #[error("yield strength {0} Pa; allowed: positive and finite, or left out")]
    YieldStrength(f64),
    /// A resistivity must be positive and finite.
    #[error("resistivity {0} ohm m; allowed: positive and finite, or left out")]
    Resistivity(f64),
    /// A thermal conductivity must be positive and finite.
    #[error("thermal conductivity {0} W/(m K); allowed: positive and finite, or left out")]
    ThermalConductivity(f64),
}

impl Material {
    /// A body of Young's modulus (Pa), Poisson's ratio in [0, 0.5], and hardness and yield
    /// strength (Pa) where they are known. Without a hardness it never yields.
    ///
    /// # Errors
    /// The first property that is out of range.
    pub fn new(
        young: f64,
        poisson: f64,
        hardness: Option<f64>,
        yield_strength: Option<f64>,
    ) -> Result<Self, MaterialError> {
        let unusable = |value: Option<f64>| value.filter(|&v| !is_positive(v));
        if !is_positive(young) {
            return Err(MaterialError::Young(young));
        }
        if !(0.0..=0.5).contains(&poisson) {
            return Err(MaterialError::Poisson(poisson));
        }
        if let Some(value) = unusable(hardness) {
            return Err(MaterialError::Hardness(value));
        }
        if let Some(value) = unusable(yield_strength) {
            return Err(MaterialError::YieldStrength(value));
        }
        Ok(Self { young, poisson, hardness, yield_strength, resistivity: None, thermal_conductivity: None })
    }

    /// The same body with an electrical resistivity (ohm m) and a thermal conductivity (W/(m K)), where they are known.
    ///
    /// # Errors
    /// The first of them that is not positive and finite.
    pub fn conducting(
        self,
        resistivity: Option<f64>,
        thermal_conductivity: Option<f64>,
    ) -> Result<Self, MaterialError> {
        let unusable = |value: Option<f64>| value.filter(|&v| !is_positive(v));
        if let Some(value) = unusable(resistivity) {
            return Err(MaterialError::Resistivity(value));
        }
        if let Some(value) = unusable(thermal_conductivity) {
            return Err(MaterialError::ThermalConductivity(value));
        }
        Ok(Self { resistivity, thermal_conductivity, ..self })
    }

    /// Young's modulus, Pa.
    pub fn young(&self) -> f64 {
        self.young
    }

    /// Poisson's ratio.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Hardness, Pa; `None` for a body that never yields.
    pub fn hardness(&self) -> Option<f64> {
        self.hardness
    }

    /// Yield strength, Pa, where it is known.
    pub fn yield_strength(&self) -> Option<f64> {
        self.yield_strength
    }

    /// Electrical resistivity, ohm m, where it is known.
    pub fn resistivity(&self) -> Option<f64> {
        self.resistivity
    }

    /// Thermal conductivity, W/(m K), where it is known.
    pub fn thermal_conductivity(&self) -> Option<f64> {
        self.thermal_conductivity
    }

    /// The same body without hardness and yield strength.
    pub fn without_yielding(&self) -> Self {
        Self { hardness: None, yield_strength: None, ..*self }
    }

    /// The body's contribution (1 - nu^2)/E to 1/E*, 1/Pa.
    pub fn plane_compliance(&self) -> f64 {
        (1.0 - self.poisson) * (1.0 + self.poisson) / self.young
    }
}

/// Reduced modulus of two bodies, Pa (Pasaribu and Schipper 2005, Eq. 3):
/// 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
pub fn reduced_modulus(one: &Material, other: &Material) -> f64 {
    (one.plane_compliance() + other.plane_compliance()).recip()
}

/// Hardness of the softer body, Pa; infinite if neither yields.
pub fn softer_hardness(one: &Material, other: &Material) -> f64 {
    let hardness = |body: &Material| body.hardness.unwrap_or(f64::INFINITY);
    hardness(one).min(hardness(other))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub fn steel() -> Material {
        Material::new(210e9, 0.3, Some(7.6e9), None).unwrap()
    }

    #[test]
    fn impossible_bodies_are_refused() {
        for young in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Material::new(young, 0.3, None, None), Err(MaterialError::Young(_))));
        }
        for poisson in [-0.1, 0.5f64.next_up(), f64::NAN] {
            assert!(matches!(Material::new(1e9, poisson, None, None), Err(MaterialError::Poisson(_))));
        }
        assert!(
            steel().conducting(Some(0.0), None).is_err() && steel().conducting(None, Some(-1.0)).is_err()
        );
        assert_eq!(steel().conducting(Some(2e-7), None).unwrap().resistivity(), Some(2e-7));
        assert!(Material::new(1e9, 0.0, Some(0.0), None).is_err());
        assert!(Material::new(1e9, 0.0, None, Some(f64::NAN)).is_err());
    }
}
