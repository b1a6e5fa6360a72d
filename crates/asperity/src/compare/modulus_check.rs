//! Error of the effective-modulus models of a layered flat: their elastic load over the exact one.
//!
//! The elastic contact of a sphere with a layered flat has an exact solution. The load ratio depends on the materials
//! and a/t only, not on the sphere radius or the layer thickness.

use crate::interface::{ContactError, LayeredInterface, MicroContact};
use crate::law::Hertz;
use crate::layer::exact_sphere::{ElasticContact, LARGEST_RATIO, LayeredSphere};
use crate::layer::{LayeredFlat, ModulusModel};
use crate::literature::Paper;
use crate::material::Material;
use crate::shape::Shape;

/// Range of E_l/E_s in which the first-order weights of [`ModulusModel::Gao`] are accurate (Perriot and Barthel 2004).
pub const GOOD_RATIO: [f64; 2] = [0.5, 2.0];

/// Both effective-modulus models against the exact solution, for one sphere, layer and substrate.
pub struct ModulusCheck {
    /// Solved for a radius and a thickness of 1 m.
    exact: LayeredSphere,
    /// In the order of [`ModulusModel::ALL`].
    by_model: [LayeredInterface<Hertz>; 2],
    modulus_ratio: f64,
}

/// Values of a/t at which errors are reported.
const REPORTED: [f64; 12] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0];

/// The errors of each of [`ModulusModel::ALL`] for a layer, over a range of a/t.
#[derive(Debug, Clone)]
pub struct ModulusFindings {
    /// E_l/E_s.
    pub modulus_ratio: f64,
    /// The range of a/t.
    pub range: [f64; 2],
    /// Errors at round values of a/t within the range.
    pub reported: [Vec<ModulusError>; 2],
    /// The largest errors within the range.
    pub worst: [Option<ModulusError>; 2],
}

impl ModulusFindings {
    /// Whether E_l/E_s lies within [`GOOD_RATIO`].
    pub fn is_good(&self) -> bool {
        (GOOD_RATIO[0]..=GOOD_RATIO[1]).contains(&self.modulus_ratio)
    }

    /// The largest error of `model`.
    pub fn worst_of(&self, model: ModulusModel) -> Option<&ModulusError> {
        ModulusModel::ALL.into_iter().zip(&self.worst).find(|(of, _)| *of == model)?.1.as_ref()
    }
}

/// Separates the errors of the two models.
pub fn apart(errors: impl Iterator<Item = [ModulusError; 2]>) -> [Vec<ModulusError>; 2] {
    let (gao, series) = errors.map(|[gao, series]| (gao, series)).unzip();
    [gao, series]
}

/// A model's elastic load and the exact one at equal indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModulusError {
    /// a/t of the exact contact.
    pub contact_ratio: f64,
    /// w R/t^2.
    pub indentation_ratio: f64,
    /// Load by the model over the exact one.
    pub ratio: f64,
}

impl ModulusError {
    /// The factor, at least 1, by which the load is too large or too small.
    pub fn factor(&self) -> f64 {
        self.ratio.max(self.ratio.recip())
    }
}

impl ModulusCheck {
    /// An elastic sphere of material `rough` on `layer` on `substrate`; hardnesses are ignored.
    ///
    /// # Errors
    /// None for valid materials.
    pub fn new(rough: &Material, layer: &Material, substrate: &Material) -> Result<Self, ContactError> {
        let [rough, layer, substrate] = [rough, layer, substrate].map(Material::without_yielding);
        let by = |model| {
            let layered = LayeredFlat::new(&layer, &substrate, 1.0, model)?;
            Ok::<_, ContactError>(LayeredInterface::new(Hertz, &rough, &substrate, layered)?)
        };
        Ok(Self {
            exact: LayeredSphere::new(Some(&rough), 1.0, &layer, &substrate, 1.0),
            by_model: [by(ModulusModel::Gao)?, by(ModulusModel::Series)?],
            modulus_ratio: layer.young() / substrate.young(),
        })
    }

    /// The errors of both models, in the order of [`ModulusModel::ALL`], for an exact contact radius of `contact_ratio`
    /// layer thicknesses; `None` unless it is positive and at most [`LARGEST_RATIO`].
    pub fn at(&self, contact_ratio: f64) -> Option<[ModulusError; 2]> {
        self.exact.at_contact_radius(contact_ratio).map(|exact| self.beside(&exact, 1.0, 1.0))
    }

    /// The errors of both models, in the order of [`ModulusModel::ALL`], against an exact contact of a sphere of
    /// `radius` (m) on a layer of `thickness` (m).
    pub fn beside(&self, exact: &ElasticContact, radius: f64, thickness: f64) -> [ModulusError; 2] {
        let scale = radius / thickness;
        let indentation_ratio = exact.indentation / thickness * scale;
        let load_ratio = exact.load / thickness / thickness * scale;
        self.by_model.each_ref().map(|contact| ModulusError {
            contact_ratio: exact.contact_radius / thickness,
            indentation_ratio,
            ratio: contact.contact(indentation_ratio, Shape::sphere(1.0)).load / load_ratio,
        })
    }

    /// The largest error of each model over a/t from `from` to `to`, at logarithmically spaced points including both
    /// ends, at least 20 per decade; `None` for an empty range or one beyond [`LARGEST_RATIO`].
    pub fn worst(&self, from: f64, to: f64) -> [Option<ModulusError>; 2] {
        const PER_DECADE: f64 = 20.0;
        /// Errors within this tolerance are equal, so that rounding does not choose the worst.
        const ROUNDING: f64 = 1e-9;
        let to = to.min(LARGEST_RATIO);
        if !(from > 0.0 && from <= to) {
            return [None; 2];
        }
        let steps = ((to / from).log10() * PER_DECADE).ceil();
        let place = |k: i32| match f64::from(k) {
            0.0 => from,
            k if k == steps => to,
            k => from * (to / from).powf(k / steps),
        };
        let errors = (0..=steps as i32).filter_map(|k| self.at(place(k)));
        let worse = |worst: ModulusError, next: ModulusError| {
            if next.factor() > worst.factor() + ROUNDING { next } else { worst }
        };
        apart(errors).map(|errors| errors.into_iter().reduce(worse))
    }

    /// Both models over a/t from `from` to `to`; no errors where the range is empty.
    pub fn findings(&self, from: f64, to: f64) -> ModulusFindings {
        let reported = REPORTED.into_iter().filter(|reported| (from..=to).contains(reported));
        ModulusFindings {
            modulus_ratio: self.modulus_ratio,
            range: [from, to],
            reported: apart(reported.filter_map(|reported| self.at(reported))),
            worst: self.worst(from, to),
        }
    }

    /// The papers behind both models and the exact solution.
    pub fn papers(&self) -> Vec<Paper> {
        let models = self.by_model.iter().flat_map(MicroContact::papers);
        models.chain(LayeredSphere::papers().iter().copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(young: f64, poisson: f64) -> Material {
        Material::new(young, poisson, None, None).unwrap()
    }

    #[test]
    fn the_papers_model_is_far_too_stiff_for_lead_on_steel() {
        let rigid = body(1e20, 0.3);
        let check = ModulusCheck::new(&rigid, &body(18e9, 0.35), &body(210e9, 0.3)).unwrap();
        assert!(!check.findings(0.1, 10.0).is_good());
        let [gao, _] = check.at(1.0).unwrap();
        assert!((gao.ratio - 2.8).abs() < 0.05, "{gao:?}");
        // w R/t^2 of the exact table.
        assert!((gao.indentation_ratio - 0.67683676).abs() < 1e-8);
        // The ratio does not depend on the size.
        let sphere = LayeredSphere::new(Some(&rigid), 3e-6, &body(18e9, 0.35), &body(210e9, 0.3), 2e-8);
        let [same, _] = check.beside(&sphere.at_contact_radius(2e-8).unwrap(), 3e-6, 2e-8);
        assert!((same.ratio / gao.ratio - 1.0).abs() < 1e-12 && (same.contact_ratio - 1.0).abs() < 1e-15);
        let [worst, of_series] = check.worst(0.1, 10.0).map(|worst| worst.unwrap().factor());
        assert!(worst >= gao.factor() && of_series < worst);
    }

    #[test]
    fn without_a_difference_there_is_no_error() {
        let steel = body(210e9, 0.3);
        let check = ModulusCheck::new(&steel, &steel, &steel).unwrap();
        let found = check.findings(0.1, 10.0);
        let worst = found.worst_of(ModulusModel::Gao).unwrap();
        assert!((worst.ratio - 1.0).abs() < 1e-12 && worst.contact_ratio == 0.1 && found.is_good());
        assert_eq!(check.worst(0.0, 1.0), [None; 2]);
        assert_eq!(check.worst(2e3, 3e3), [None; 2]);
        assert_eq!(check.worst(2.0, 2.0).map(|at| at.map(|at| at.contact_ratio)), [Some(2.0); 2]);
    }
}
