//! Shear force of contact spots under boundary friction.

use std::f64::consts::PI;

use crate::contact::Contact;
use crate::literature::{self, Paper};
use crate::material::Material;

/// Shear strength that grows with the pressure: tau = tau0 + alpha p.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearStrength {
    /// tau0, Pa, not negative.
    pub tau0: f64,
    /// alpha, not negative.
    pub alpha: f64,
}

impl ShearStrength {
    /// Whether nothing resists sliding.
    pub fn is_none(&self) -> bool {
        self.tau0 == 0.0 && self.alpha == 0.0
    }
}

/// What shears where a spot has broken through a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrokenFilm {
    /// The indentation from which on it has, m.
    pub from: f64,
    /// The strength there: of the bodies without the film.
    pub strength: ShearStrength,
}

/// The shear strength of an interface. A spot resists sliding by tau0 A + alpha P (Bowden and Tabor 1950): the coefficient of friction is
/// tau0 A/F + alpha of the whole contact. Ploughing and growth of junctions are neglected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shear {
    /// The strength of the interface, or of the film on it.
    pub strength: ShearStrength,
    /// Where spots break through the film; `None` where there is none.
    pub broken: Option<BrokenFilm>,
}

impl Shear {
    /// Of an interface under a `film` of a thickness (m; 0: none, infinite: nothing but film), broken through from `breakdown` times the
    /// thickness on.
    pub fn under_film(interface: ShearStrength, film: ShearStrength, thickness: f64, breakdown: f64) -> Self {
        let broken = BrokenFilm { from: breakdown * thickness, strength: interface };
        match thickness {
            0.0 => Self { strength: interface, broken: None },
            f64::INFINITY => Self { strength: film, broken: None },
            _ => Self { strength: film, broken: Some(broken) },
        }
    }

    /// Its sources.
    pub const PAPERS: &'static [Paper] = &[literature::BOWDEN_TABOR_1950];

    /// The shear force (N) of a spot at the indentation `w` (m).
    #[inline]
    pub fn force(&self, w: f64, contact: &Contact) -> f64 {
        let broken = self.broken.filter(|broken| w >= broken.from);
        let ShearStrength { tau0, alpha } = broken.map_or(self.strength, |broken| broken.strength);
        tau0 * contact.area + alpha * contact.load
    }

    /// The indentation (m) at which a spot breaks through the film.
    pub fn breakthrough(&self) -> Option<f64> {
        self.broken.map(|broken| broken.from)
    }
}

/// The tangential stiffness of spots that stick: 8 G* a of a circular one of radius a, 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2 (Mindlin 1949). Of
/// equal bodies it is 2 (1 - nu)/(2 - nu) times the normal one of elastic contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangential {
    /// G*, Pa.
    modulus: f64,
}

impl Tangential {
    /// Its source.
    pub const PAPERS: &'static [Paper] = &[literature::MINDLIN_1949];

    /// Of two homogeneous bodies.
    pub fn new(one: &Material, other: &Material) -> Self {
        let compliance = |body: &Material| {
            let nu = body.poisson();
            (2.0 - nu) * 2.0 * (1.0 + nu) / body.young()
        };
        Self { modulus: (compliance(one) + compliance(other)).recip() }
    }

    /// Of an asperity of a contact `area` (m^2) that counts as a number of `spheres`, N/m.
    #[inline]
    pub fn stiffness(&self, area: f64, spheres: f64) -> f64 {
        8.0 * self.modulus * (area * spheres / PI).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Regime;

    #[test]
    fn a_spot_shears_in_the_film_until_it_breaks_through() {
        let film = ShearStrength { tau0: 2.0, alpha: 0.1 };
        let steel = ShearStrength { tau0: 50.0, alpha: 0.0 };
        let contact = Contact { area: 3.0, load: 10.0, stiffness: 1.0, regime: Regime::Elastic };
        let shear = Shear { strength: film, broken: Some(BrokenFilm { from: 0.5, strength: steel }) };
        assert_eq!([0.4, 0.5].map(|w| shear.force(w, &contact)), [7.0, 150.0]);
        assert_eq!((shear.breakthrough(), Shear { broken: None, ..shear }.breakthrough()), (Some(0.5), None));
    }
}
