//! Resolving the names of a spec.

use std::ops::Range;

use toml::Spanned;

use super::{ComparePlan, LawPlan, LimitPlan, SurfacePlan};
use crate::experiment::input_error::{InputError, Source};
use crate::experiment::results::Bodies;
use crate::experiment::spec::{CompareSpec, LawSpec, Laws, LimitSpec, LogSweep, Spec, Summit};
use crate::units::Pure;
use asperity::asperity::{HeightDensity, Population};
use asperity::compare::Controls;
use asperity::interface::Flat;
use asperity::law::{Body, Inapplicable, Property};
use asperity::material::Material;

/// Two materials as a error names them, or one that both bodies are of.
pub(super) fn materials(rough: &str, flat: &str) -> String {
    if rough == flat {
        format!("[material.{rough}]")
    } else {
        format!("[material.{rough}], nor in [material.{flat}]")
    }
}

/// Resolves the names of one spec.
pub(super) struct Resolver<'a> {
    pub(super) source: &'a Source,
    pub(super) spec: &'a Spec,
}

impl Resolver<'_> {
    pub(super) fn body(&self, name: &str, span: Range<usize>) -> Result<Material, InputError> {
        let found = self.spec.material.iter().find(|(defined, _)| defined.get_ref() == name);
        found.map(|(_, material)| material.0).ok_or_else(|| {
            let defined: Vec<&str> = self.spec.material.keys().map(|name| name.get_ref().as_str()).collect();
            let allowed = if defined.is_empty() {
                "a material defined in this file as [material.NAME]; none is".to_owned()
            } else {
                format!("a material of this file: {}", defined.join(", "))
            };
            self.source.error_at(span, format!("found \"{name}\"; allowed: {allowed}"))
        })
    }

    /// Holds each law against the bodies that it will meet, as if each flat were homogeneous. Whether it stands under a
    /// layer of finite thickness is seen when the contact is made.
    pub(super) fn check_laws(
        &self,
        laws: &Spanned<Laws>,
        rough: (&str, &Material),
        flats: &[(&str, &Material)],
    ) -> Result<(), InputError> {
        for law in &laws.get_ref().0 {
            for flat in flats {
                law.check(rough.1, flat.1)
                    .map_err(|error| self.inapplicable(laws, &error, rough.0, flat.0))?;
            }
        }
        Ok(())
    }

    /// Points at the body that lacks a property, else at the laws.
    pub(super) fn inapplicable(
        &self,
        laws: &Spanned<Laws>,
        error: &Inapplicable,
        rough: &str,
        flat: &str,
    ) -> InputError {
        let Inapplicable::Lacking { law, property, body } = error else {
            return self.source.error_at(laws.span(), format!("found {error}"));
        };
        let name = if *body == Some(Body::Flat) { flat } else { rough };
        let key = property.key();
        let message = match body {
            Some(_) => format!(
                "found no `{key}` in [material.{name}], which law {law} needs there; allowed: {key} = \"...\" with a unit of \
                 pressure{}",
                match property {
                    Property::YieldStrength => ", or no hardness either, for a body that never yields",
                    Property::Hardness => "",
                }
            ),
            None => format!(
                "found no `{key}` in {}, which law {law} needs of one body at least; allowed: {key} = \"...\" with a unit of \
                 pressure",
                materials(rough, flat)
            ),
        };
        self.source.error_at(self.material_at(name).unwrap_or_else(|| laws.span()), message)
    }

    /// Where a material is defined.
    pub(super) fn material_at(&self, name: &str) -> Option<Range<usize>> {
        self.spec.material.keys().find(|defined| defined.get_ref() == name).map(Spanned::span)
    }

    /// Each law against each flat, which has a layer of the thickness beside it.
    fn laws(
        &self,
        laws: &Spanned<Laws>,
        rough: (&str, &Material),
        flats: &[(Option<f64>, Flat)],
        flat: &str,
    ) -> Result<Vec<LawPlan>, InputError> {
        let plan = |law: &LawSpec, (thickness, on): &(Option<f64>, Flat)| {
            let contact = law.interface(rough.1, on);
            Ok(LawPlan {
                label: law.label(),
                thickness: *thickness,
                contact: contact.map_err(|error| self.inapplicable(laws, &error, rough.0, flat))?,
                spec: *law,
            })
        };
        laws.get_ref().0.iter().flat_map(|law| flats.iter().map(move |flat| plan(law, flat))).collect()
    }

    /// Refuses laws for ellipses where all asperities are spheres.
    pub(super) fn spheres_only(&self, laws: &Spanned<Laws>, what: &str) -> Result<(), InputError> {
        match laws.get_ref().0.iter().find(|law| law.summit == Summit::Ellipse) {
            Some(law) => {
                let message = format!("found \"{}\", but {what}; allowed: a law for spheres", law.label());
                Err(self.source.error_at(laws.span(), message))
            }
            None => Ok(()),
        }
    }

    pub(super) fn compare(&self, words: &CompareSpec, span: Range<usize>) -> Result<ComparePlan, InputError> {
        let rough_name = &words.rough.get_ref().0;
        let rough = self.body(rough_name, words.rough.span())?;
        let flat = self.body(words.flat.get_ref(), words.flat.span())?;
        let controls = Controls {
            separations: words.separation.as_ref().map(|sweep| sweep.0.clone()).unwrap_or_default(),
            pressures: words
                .pressure
                .as_ref()
                .map(|sweep| sweep.get_ref().values.clone())
                .unwrap_or_default(),
            forces: words.force.as_ref().map(|sweep| sweep.get_ref().values.clone()).unwrap_or_default(),
            tolerances: words.tolerance.0,
        };
        if controls.points() == 0 {
            return Err(self.source.error_at(
                span,
                "found nothing to press the surfaces to; allowed: at least one of separation, pressure, force",
            ));
        }
        let layer = words.layer.as_ref().map(|layer| self.layer(layer, &flat).map(Box::new)).transpose()?;
        let flats = match &layer {
            None => vec![(None, Flat::Bare(flat))],
            Some(layer) => {
                let on = |&t: &f64| layer.flat(t).map(|flat| (Some(t), flat));
                let flats: Result<Vec<_>, _> = layer.thicknesses.iter().map(on).collect();
                flats.map_err(|error| InputError::file(&self.source.path, error))?
            }
        };
        let flat_name = words.flat.get_ref();
        // Under a layer of no thickness nothing feels it, under one of any nothing the substrate.
        let coat = layer.as_deref().filter(|layer| layer.thicknesses.iter().any(|&t| t > 0.0));
        let feels_substrate =
            layer.as_deref().is_none_or(|layer| layer.thicknesses.iter().any(|t| t.is_finite()));
        let substrate = feels_substrate.then_some((flat_name.as_str(), &flat));
        let coat = coat.map(|layer| (layer.name.as_str(), &layer.material));
        let met: Vec<_> = substrate.into_iter().chain(coat).collect();
        self.check_laws(&words.law, (rough_name, &rough), &met)?;
        let law_specs = words.law.get_ref().0.clone();
        let as_ellipses = law_specs.iter().any(|law| law.summit == Summit::Ellipse);
        Ok(ComparePlan {
            bodies: Bodies { rough: rough_name.clone(), flat: flat_name.clone() },
            pair: [rough, flat],
            law_specs,
            laws: self.laws(&words.law, (rough_name, &rough), &flats, flat_name)?,
            layer,
            models: words.models.0.clone(),
            heights: words.statistical.heights,
            mean_radius: words.statistical.mean_radius,
            controls,
            load_keys: [words.pressure.as_ref().map(Spanned::span), words.force.as_ref().map(Spanned::span)],
            surfaces: self.surfaces(words.surfaces.as_deref(), span, as_ellipses)?,
        })
    }

    /// The surfaces that are named, or all of the file.
    pub(super) fn surfaces(
        &self,
        named: Option<&[Spanned<String>]>,
        span: Range<usize>,
        as_ellipses: bool,
    ) -> Result<Vec<SurfacePlan>, InputError> {
        let plan = |name: &Spanned<String>, words| SurfacePlan::new(self.source, name, words, as_ellipses);
        let Some(named) = named else {
            if self.spec.surface.is_empty() {
                return Err(self.source.error_at(
                    span,
                    "found no surface; allowed: at least one [surface.NAME.asperities], [surface.NAME.population], \
                     [surface.NAME.generate] or [surface.NAME.file]",
                ));
            }
            return self.spec.surface.iter().map(|(name, words)| plan(name, words)).collect();
        };
        if named.is_empty() {
            return Err(self.source.error_at(span, "found an empty list of surfaces; allowed: at least one"));
        }
        let mut surfaces = Vec::new();
        for (k, wanted) in named.iter().enumerate() {
            if named[..k].iter().any(|earlier| earlier.get_ref() == wanted.get_ref()) {
                let message = format!("found \"{}\" twice; allowed: each surface once", wanted.get_ref());
                return Err(self.source.error_at(wanted.span(), message));
            }
            let found = self.spec.surface.iter().find(|(name, _)| name.get_ref() == wanted.get_ref());
            let (name, words) = found.ok_or_else(|| {
                let defined: Vec<&str> =
                    self.spec.surface.keys().map(|name| name.get_ref().as_str()).collect();
                let message = format!(
                    "found \"{}\"; allowed: a surface of this file ({})",
                    wanted.get_ref(),
                    if defined.is_empty() { "none is defined".to_owned() } else { defined.join(", ") }
                );
                self.source.error_at(wanted.span(), message)
            })?;
            surfaces.push(plan(name, words)?);
        }
        Ok(surfaces)
    }

    /// Sizes of sets.
    pub(super) fn counts(&self, words: &Spanned<LogSweep<Pure>>) -> Result<Vec<usize>, InputError> {
        /// Beyond this, counts are no longer exact as f64, and no memory holds them.
        const LARGEST_COUNT: f64 = 1e12;
        self.whole(words, "a count of", LARGEST_COUNT)
    }

    /// A sweep of whole numbers from 1 to `most`. Close ones may round to one: it stands once.
    pub(super) fn whole(
        &self,
        words: &Spanned<LogSweep<Pure>>,
        what: &str,
        most: f64,
    ) -> Result<Vec<usize>, InputError> {
        let values = &words.get_ref().values;
        if let Some(value) = values.iter().find(|value| !(1.0..=most).contains(*value)) {
            return Err(self
                .source
                .error_at(words.span(), format!("found {what} {value:e}; allowed: 1 to {most:e}")));
        }
        let mut whole: Vec<usize> = values.iter().map(|value| value.round() as usize).collect();
        whole.dedup();
        Ok(whole)
    }

    /// How many random ones of a kind.
    pub(super) fn several(&self, words: &Spanned<u64>, what: &str) -> Result<usize, InputError> {
        let count = *words.get_ref();
        if !(2..=1000).contains(&count) {
            return Err(self
                .source
                .error_at(words.span(), format!("found {count}; allowed: 2 to 1000 {what}")));
        }
        Ok(count as usize)
    }

    pub(super) fn limit(&self, words: &LimitSpec) -> Result<LimitPlan, InputError> {
        let rough = self.body(words.rough.get_ref(), words.rough.span())?;
        let flat = self.body(words.flat.get_ref(), words.flat.span())?;
        let counts = self.counts(&words.count)?;
        let draws = self.several(&words.draws, "random sets of each size")?;
        self.spheres_only(&words.law, "the sets of [limit] are spheres of one radius")?;
        let (rough_name, flat_name) = (words.rough.get_ref(), words.flat.get_ref());
        self.check_laws(&words.law, (rough_name, &rough), &[(flat_name, &flat)])?;
        let laws = self.laws(&words.law, (rough_name, &rough), &[(None, Flat::Bare(flat))], flat_name)?;
        Ok(LimitPlan {
            bodies: Bodies { rough: words.rough.get_ref().clone(), flat: words.flat.get_ref().clone() },
            laws,
            population: Population {
                radius: words.radius.value(),
                sigma: words.sigma.value(),
                density: words.density.value(),
                heights: HeightDensity::Gaussian,
            },
            separations: words.separation.0.clone(),
            counts,
            draws,
        })
    }
}
