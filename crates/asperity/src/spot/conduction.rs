//! Electrical and thermal conductance of contact spots, and correlations for that of rough joints, as programs for finite elements use them.

use std::f64::consts::{PI, SQRT_2};

use super::layered::{LAYER_RATIOS, LayerFactor};
use crate::bem::ConductingPair;
use crate::literature::{self, Paper};
use crate::named_enum;
use crate::numeric::is_positive;
use crate::numeric::sum::sum_of;

/// Two half-spaces that conduct through the spots of their contact, electrically or thermally.
///
/// With the resistivities rho1 and rho2 of the bodies (thermally 1/k) the mean s = (rho1 + rho2)/2 alone counts: the potential on a
/// spot is constant whatever their ratio. A circular spot of radius a conducts 2 a/s (Holm 1967); each asperity counts by itself, as
/// if its spot were circular. A film of a resistance r per area lies in series with each spot: 1/(s/(2 a) + r/A). That is an upper bound
/// of the conductance of a spot, by at most 8 %: the current is neither that of a bare spot nor uniform.
///
/// A layer on one body changes the resistance of that body by [`LayerFactor`], which is exact for one body alone: the two sides of a spot
/// want different currents, so that the sum of both resistances is a bound, estimated to be within 8 %.
#[derive(Debug, Clone, PartialEq)]
pub struct Conduction {
    /// Resistivities of the body without a layer and of the other's substrate, ohm m or m K/W.
    bodies: [f64; 2],
    /// r, ohm m^2 or m^2 K/W.
    film: f64,
    layer: Option<ConductingLayer>,
}

/// A layer of finite thickness on one of the bodies.
#[derive(Debug, Clone, PartialEq)]
struct ConductingLayer {
    /// ohm m or m K/W.
    resistivity: f64,
    /// m.
    thickness: f64,
    factor: LayerFactor,
}

/// A property of conduction out of its range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConductionError {
    /// Resistivities must be positive and finite.
    #[error("resistivity {0} ohm m (thermally m K/W); allowed: positive and finite")]
    Resistivity(f64),
    /// The resistance of a film must not be negative.
    #[error("film resistance {0} ohm m^2 (thermally m^2 K/W); allowed: 0 or positive and finite")]
    Film(f64),
    /// Ratios of resistivities are limited.
    #[error(
        "a layer of {0:.2e} times the resistivity of its substrate; allowed: {min:e} to {max:e} times. A more resistive layer is \
         a film: its resistance per area is resistivity times thickness",
        min = LAYER_RATIOS[0], max = LAYER_RATIOS[1]
    )]
    LayerRatio(f64),
    /// The conductivity of a medium must be positive, the jump at its borders not negative.
    #[error("gap conductivity {0} W/(m K), temperature jump {1} m; allowed: positive, and 0 or positive")]
    Medium(f64, f64),
    /// The thickness of a layer must be positive.
    #[error("layer thickness {0} m; allowed: positive")]
    Thickness(f64),
}

/// A medium in the gap between two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapMedium {
    /// W/(m K).
    conductivity: f64,
    /// Thickness of the medium that resists as much as its borders, m.
    jump: f64,
}

impl GapMedium {
    /// Of a thermal conductivity (W/(m K)), and the thickness (m) that a gas resists more for the jump of temperature at both borders; 0 of
    /// liquids and solids.
    ///
    /// # Errors
    /// A conductivity that is not positive, a negative jump.
    pub fn new(conductivity: f64, jump: f64) -> Result<Self, ConductionError> {
        if is_positive(conductivity) && (jump == 0.0 || is_positive(jump)) {
            Ok(Self { conductivity, jump })
        } else {
            Err(ConductionError::Medium(conductivity, jump))
        }
    }

    /// Conductance per area (W/(m^2 K)) over a `gap` (m).
    pub fn conductance(&self, gap: f64) -> f64 {
        self.conductivity / (gap + self.jump)
    }
}

/// Resistivity times mean free path of free electrons of the density of copper, n = 8.5e28 /m^3: (3 pi^2)^(1/3) hbar/(e^2 n^(2/3)), ohm m^2.
/// Of silver and gold it is a quarter more, of aluminium two fifths less.
const FREE_PATH: f64 = 6.6e-16;

/// The exponent of [`tube_factor`].
const TUBE_EXPONENT: f64 = 1.5;

/// The constriction resistance of a circular spot in the middle of a tube over that without neighbours, (1 - e)^1.5 with e the square
/// root of the `area_ratio` of contact and tube (Cooper, Mikic and Yovanovich 1969): neighbours on an interface without end share the
/// flow and *lower* the resistance of each spot. Not for a cluster of spots between larger bodies, where neighbours raise it (Greenwood
/// 1966). 0 in full contact.
pub fn tube_factor(area_ratio: f64) -> f64 {
    (1.0 - area_ratio.clamp(0.0, 1.0).sqrt()).powf(TUBE_EXPONENT)
}

impl Conduction {
    /// Its sources.
    pub const PAPERS: &'static [Paper] = &[literature::HOLM_1967];

    /// Of bodies of the two `resistivities` (ohm m; thermally 1/k, m K/W), without a film.
    ///
    /// # Errors
    /// A resistivity that is not positive and finite.
    pub fn new(resistivities: [f64; 2]) -> Result<Self, ConductionError> {
        match resistivities.into_iter().find(|&value| !is_positive(value)) {
            Some(value) => Err(ConductionError::Resistivity(value)),
            None => Ok(Self { bodies: resistivities, film: 0.0, layer: None }),
        }
    }

    /// Of a `bare` body and one with a layer of a resistivity and a thickness (m, infinite: nothing but layer) on a `substrate`.
    ///
    /// # Errors
    /// A resistivity or a thickness that is not positive, resistivities too far apart.
    pub fn layered(bare: f64, substrate: f64, layer: f64, thickness: f64) -> Result<Self, ConductionError> {
        if thickness == f64::INFINITY {
            return Self::new([bare, layer]);
        }
        if !is_positive(thickness) {
            return Err(ConductionError::Thickness(thickness));
        }
        if !is_positive(layer) {
            return Err(ConductionError::Resistivity(layer));
        }
        let unlayered = Self::new([bare, substrate])?;
        let factor = LayerFactor::new(layer / substrate)?;
        Ok(Self { layer: Some(ConductingLayer { resistivity: layer, thickness, factor }), ..unlayered })
    }

    /// The same under a film of a resistance per area (ohm m^2; thermally m^2 K/W; 0: none).
    ///
    /// # Errors
    /// A negative or infinite resistance.
    pub fn with_film(self, film: f64) -> Result<Self, ConductionError> {
        if film == 0.0 || is_positive(film) {
            Ok(Self { film, ..self })
        } else {
            Err(ConductionError::Film(film))
        }
    }

    /// s = (rho1 + rho2)/2 without the layer, ohm m or m K/W.
    pub fn resistivity(&self) -> f64 {
        0.5 * (self.bodies[0] + self.bodies[1])
    }

    /// How much more a circular spot of a `radius` (m) between metals resists an electrical current than by diffusion alone, relative: the
    /// resistance 4 rho l/(3 pi a^2) of a spot smaller than the mean free path l of the electrons (Sharvin 1965), with rho l of free electrons.
    pub fn ballistic_excess(&self, radius: f64) -> f64 {
        8.0 * FREE_PATH / (3.0 * PI * self.resistivity() * radius)
    }

    /// Whether one of the bodies has a layer of finite thickness.
    pub fn is_layered(&self) -> bool {
        self.layer.is_some()
    }

    /// The bodies, for boundary elements.
    pub fn pair(&self) -> ConductingPair {
        let [bare, substrate] = self.bodies;
        ConductingPair::new(
            bare,
            substrate,
            self.layer.as_ref().map(|layer| (layer.resistivity, layer.thickness)),
        )
    }

    /// Resistance of the film per area, ohm m^2 or m^2 K/W.
    pub fn film(&self) -> f64 {
        self.film
    }

    /// The conductance (S or W/K) of an asperity of a contact `area` (m^2) that counts as a number of `spheres`: of an ellipse in elastic
    /// contact it is exact.
    #[inline]
    pub fn conductance(&self, area: f64, spheres: f64) -> f64 {
        let diameters = 2.0 * (area * spheres / PI).sqrt();
        let [bare, substrate] = self.bodies;
        let factor =
            self.layer.as_ref().map_or(1.0, |layer| layer.factor.at(layer.thickness / (area / PI).sqrt()));
        let resistivity = 0.5 * (bare + substrate * factor);
        if self.film == 0.0 {
            return diameters / resistivity;
        }
        if area > 0.0 { (resistivity / diameters + self.film / area).recip() } else { 0.0 }
    }
}

/// The conductance times s (m) of a cluster of circular spots between two half-spaces: `spots` of radii (m) at places (m). Neighbours
/// raise the resistance: 1/(2 sum a) + sum a_i a_j/s_ij/(pi (sum a)^2) over all pairs i, j (Greenwood 1966), with the current through
/// each spot in proportion to its radius. For a finite patch only; on an interface without end neighbours lower it ([`tube_factor`]).
/// 0 without spots. Takes time in proportion to the square of their number: about two seconds for 40,000 on two cores.
pub fn cluster_conductance(spots: &[(f64, [f64; 2])]) -> f64 {
    let sum = sum_of(spots.len(), |k| spots[k].0);
    let weighted = |p: [f64; 2], (a, q): &(f64, [f64; 2])| {
        let [x, y] = [p[0] - q[0], p[1] - q[1]];
        a / (x * x + y * y).sqrt()
    };
    let pairs = sum_of(spots.len(), |k| {
        let (a, p) = spots[k];
        a * spots[..k].iter().map(|other| weighted(p, other)).sum::<f64>()
    });
    if sum > 0.0 { ((2.0 * sum).recip() + 2.0 * pairs / (PI * sum * sum)).recip() } else { 0.0 }
}

named_enum! {
    /// A correlation of the conductance with the load.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Correlation {
        /// Plastic contact (Cooper, Mikic and Yovanovich 1969): 1.25 (m/sigma) (p/H)^0.95/s.
        CooperMikicYovanovich = "cooper-mikic-yovanovich",
        /// Elastic contact (Mikic 1974): 1.55 (m/sigma) (2^0.5 p/(E* m))^0.94/s.
        Mikic = "mikic",
    }
}

/// What the correlations take of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// r.m.s. height sigma of the sum of both surfaces, m.
    pub sigma: f64,
    /// Mean absolute slope m of profiles of that surface.
    pub slope: f64,
    /// E*, Pa.
    pub modulus: f64,
    /// Hardness of the softer body, Pa; infinite if neither yields.
    pub hardness: f64,
}

impl Joint {
    /// Of a surface of r.m.s. height `sigma` (m) and r.m.s. `gradient` of both directions together, whose slopes are Gaussian and the same
    /// in all directions: m = gradient/pi^0.5.
    pub fn isotropic(sigma: f64, gradient: f64, modulus: f64, hardness: f64) -> Self {
        Self { sigma, slope: gradient / PI.sqrt(), modulus, hardness }
    }
}

impl Correlation {
    /// Conductance per nominal area times the mean resistivity s of the bodies (1/m) at a nominal `pressure` (Pa); `None` of a plastic contact
    /// of bodies that never yield. The exponents and factors are those in use, of Mikic's also 1.54; the original
    /// of Mikic was not consulted.
    pub fn conductance(self, joint: &Joint, pressure: f64) -> Option<f64> {
        let Joint { sigma, slope, modulus, hardness } = *joint;
        let of = |factor: f64, ratio: f64, exponent: f64| factor * slope / sigma * ratio.powf(exponent);
        match self {
            Self::CooperMikicYovanovich => hardness.is_finite().then(|| of(1.25, pressure / hardness, 0.95)),
            Self::Mikic => Some(of(1.55, SQRT_2 * pressure / (modulus * slope), 0.94)),
        }
    }

    /// Its authors.
    pub const fn label(self) -> &'static str {
        match self {
            Self::CooperMikicYovanovich => "Cooper-Mikic-Yovanovich (plastic)",
            Self::Mikic => "Mikic (elastic)",
        }
    }

    /// Its source.
    pub const fn paper(self) -> Paper {
        match self {
            Self::CooperMikicYovanovich => literature::COOPER_MIKIC_YOVANOVICH_1969,
            Self::Mikic => literature::MIKIC_1974,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spot::tube_factor;

    #[test]
    fn a_film_lies_in_series_with_each_spot() {
        let bare = Conduction::new([2.0, 4.0]).unwrap();
        let filmed = bare.clone().with_film(5.0).unwrap();
        let area = 0.7;
        let expected = bare.conductance(area, 1.0).recip() + 5.0 / area;
        assert!((filmed.conductance(area, 1.0).recip() / expected - 1.0).abs() < 1e-15);
        assert_eq!(filmed.conductance(0.0, 1.0), 0.0);
        assert_eq!(bare.clone().with_film(0.0), Ok(bare.clone()));
        assert!(bare.with_film(-1.0).is_err() && Conduction::new([0.0, 1.0]).is_err());
        assert!(Conduction::new([1.0, f64::INFINITY]).is_err());
    }

    /// Thin and thick layers conduct as the bodies without one of both materials.
    #[test]
    fn a_layer_between_its_limits() {
        let of = |thickness: f64| Conduction::layered(1.0, 2.0, 8.0, thickness).unwrap().conductance(PI, 1.0);
        let [substrate, layer] =
            [2.0, 8.0].map(|rho| Conduction::new([1.0, rho]).unwrap().conductance(PI, 1.0));
        assert!((of(1e-9) / substrate - 1.0).abs() < 1e-6 && (of(1e6) / layer - 1.0).abs() < 1e-5);
        assert_eq!(of(f64::INFINITY), layer);
        assert!(layer < of(1.0) && of(1.0) < substrate);
        assert!(
            Conduction::layered(1.0, 2.0, 8.0, 0.0).is_err()
                && Conduction::layered(1.0, 2.0, 8e9, 1.0).is_err()
        );
    }

    /// Of copper the mean free path is 39 nm.
    #[test]
    fn spots_of_ten_free_paths_resist_a_twelfth_more() {
        let copper = Conduction::new([1.7e-8; 2]).unwrap();
        assert!((copper.ballistic_excess(390e-9) - 0.085).abs() < 1e-3);
        let [e, hbar, n] = [1.602_176_634e-19, 1.054_571_817e-34, 8.49e28_f64];
        let free = (3.0 * PI * PI).cbrt() * hbar / (e * e * n.powf(2.0 / 3.0));
        assert!((free / FREE_PATH - 1.0).abs() < 0.01, "{free:e}");
    }

    #[test]
    fn neighbours_share_the_flow() {
        assert_eq!((tube_factor(0.0), tube_factor(1.0), tube_factor(2.0)), (1.0, 0.0, 0.0));
        assert!((tube_factor(0.04) - 0.8f64.powf(1.5)).abs() < 1e-15);
    }

    /// x of erfc(x)/2 = `tail`.
    fn quantile(tail: f64) -> f64 {
        let (mut low, mut high) = (-6.0, 6.0);
        for _ in 0..100 {
            let x = 0.5 * (low + high);
            if 0.5 * libm::erfc(x) > tail { low = x } else { high = x }
        }
        low
    }

    /// The fits are within 2 % of their models: h sigma s/m = exp(-x^2)/(2 (2 pi)^0.5 psi), erfc(x)/2 = p/H = A/A_nom; of elastic contact
    /// exp(-x^2)/(4 pi^0.5 psi), erfc(x)/4 = A/A_nom = 2^0.5 p/(E* m).
    #[test]
    fn the_fits_are_those_of_their_models() {
        let joint = Joint { sigma: 2e-6, slope: 0.15, modulus: 1e11, hardness: 2e9 };
        for area in [1e-5, 1e-4, 1e-3, 1e-2] {
            let plastic = |x: f64| (-x * x).exp() / (2.0 * (2.0 * PI).sqrt() * tube_factor(area));
            let elastic = |x: f64| (-x * x).exp() / (4.0 * PI.sqrt() * tube_factor(area));
            let unit = joint.slope / joint.sigma;
            let found =
                Correlation::CooperMikicYovanovich.conductance(&joint, area * joint.hardness).unwrap();
            assert!((found / unit / plastic(quantile(area)) - 1.0).abs() < 0.02, "{area}");
            let pressure = area * joint.modulus * joint.slope / SQRT_2;
            let found = Correlation::Mikic.conductance(&joint, pressure).unwrap();
            assert!((found / unit / elastic(quantile(2.0 * area)) - 1.0).abs() < 0.02, "{area}");
        }
        let rigid = Joint { hardness: f64::INFINITY, ..joint };
        assert_eq!(Correlation::CooperMikicYovanovich.conductance(&rigid, 1e6), None);
        assert!((Joint::isotropic(1.0, 0.2, 1.0, 1.0).slope - 0.2 / PI.sqrt()).abs() < 1e-15);
    }
}
