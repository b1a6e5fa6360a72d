//! Names, counts and laws of a spec, resolved and checked.

use std::ops::Range;

use asperity::law::{Body, Property};
use asperity::study::LawContact;
use asperity::{ContactLaw, Flat, Inapplicable, Material};

use super::error::InputError;
use super::file::SpecFile;
use super::forms::Spanned;
use super::law::Laws;
use super::quantity::{Pure, Whole};
use super::sweep::LogSweep;

/// Names of two materials for an error, or of the one used for both bodies.
pub fn materials(rough: &str, flat: &str) -> String {
    if rough == flat {
        format!("[material.{rough}]")
    } else {
        format!("[material.{rough}], nor in [material.{flat}]")
    }
}

impl SpecFile<'_> {
    /// The material `name`; `span` is where it is used.
    pub fn body(&self, name: &str, span: Range<usize>) -> Result<Material, InputError> {
        let defined_material = self.materials().find(|(defined, _)| defined.get_ref() == name);
        defined_material.map(|(_, material)| *material).ok_or_else(|| {
            let defined: Vec<&str> = self.materials().map(|(name, _)| name.get_ref().as_str()).collect();
            let allowed = if defined.is_empty() {
                "a material defined in this file as [material.NAME]; none is".to_owned()
            } else {
                format!("a material of this file: {}", defined.join(", "))
            };
            self.source.error_at(span, format!("found \"{name}\"; allowed: {allowed}"))
        })
    }

    /// Checks each law against its bodies, as if each flat were homogeneous. Whether it is valid under a
    /// layer of finite thickness is checked when the contact is built.
    pub fn check_laws(
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
    pub fn inapplicable(
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
        let key = property.name();
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
                "found no `{key}` in {}, which law {law} needs for at least one body; allowed: {key} = \"...\" with a unit of \
                 pressure",
                materials(rough, flat)
            ),
        };
        self.source.error_at(self.material_at(name).unwrap_or_else(|| laws.span()), message)
    }

    /// Where a material is defined.
    pub fn material_at(&self, name: &str) -> Option<Range<usize>> {
        self.materials().find(|(defined, _)| defined.get_ref() == name).map(|(defined, _)| defined.span())
    }

    /// Each law on each flat, given with its layer thickness.
    pub fn law_plans(
        &self,
        laws: &Spanned<Laws>,
        rough: (&str, &Material),
        flats: &[(Option<f64>, Flat)],
        flat: &str,
    ) -> Result<Vec<LawContact>, InputError> {
        let plan = |law: &ContactLaw, (thickness, on): &(Option<f64>, Flat)| {
            let contact = law.interface(rough.1, on);
            Ok(LawContact {
                label: law.label(),
                thickness: *thickness,
                contact: contact.map_err(|error| self.inapplicable(laws, &error, rough.0, flat))?,
                spec: law.clone(),
            })
        };
        laws.get_ref().0.iter().flat_map(|law| flats.iter().map(move |flat| plan(law, flat))).collect()
    }

    /// Refuses laws for ellipses where all asperities are spheres.
    pub fn spheres_only(&self, laws: &Spanned<Laws>, what: &str) -> Result<(), InputError> {
        match laws.get_ref().0.iter().find(|law| law.is_elliptic()) {
            Some(law) => {
                let message = format!("found \"{}\", but {what}; allowed: a law for spheres", law.label());
                Err(self.source.error_at(laws.span(), message))
            }
            None => Ok(()),
        }
    }

    /// A whole number from `least` to `most`.
    pub fn whole_within(
        &self,
        found: &Spanned<Whole>,
        [least, most]: [u64; 2],
        what: &str,
    ) -> Result<u64, InputError> {
        let Whole(count) = *found.get_ref();
        if (least..=most).contains(&count) {
            return Ok(count);
        }
        Err(self.source.error_at(found.span(), format!("found {count}; allowed: {least} to {most} {what}")))
    }

    /// Sizes of sets.
    pub fn counts(&self, raw: &Spanned<LogSweep<Pure>>) -> Result<Vec<usize>, InputError> {
        /// Larger sets do not fit in memory.
        const LARGEST_COUNT: f64 = 1e12;
        self.whole(raw, "a count of", LARGEST_COUNT)
    }

    /// A sweep of whole numbers from 1 to `most`. Values that round to the same number are merged.
    pub fn whole(
        &self,
        raw: &Spanned<LogSweep<Pure>>,
        what: &str,
        most: f64,
    ) -> Result<Vec<usize>, InputError> {
        let values = &raw.get_ref().values;
        if let Some(value) = values.iter().find(|value| !(1.0..=most).contains(*value)) {
            return Err(self
                .source
                .error_at(raw.span(), format!("found {what} {value:e}; allowed: 1 to {most:e}")));
        }
        let mut whole: Vec<usize> = values.iter().map(|value| value.round() as usize).collect();
        whole.dedup();
        Ok(whole)
    }

    /// Number of random realisations, 2 to 1000.
    pub fn several(&self, raw: &Spanned<Whole>, what: &str) -> Result<usize, InputError> {
        let Whole(count) = *raw.get_ref();
        if !(2..=1000).contains(&count) {
            return Err(self
                .source
                .error_at(raw.span(), format!("found {count}; allowed: 2 to 1000 {what}")));
        }
        Ok(count as usize)
    }

    /// Indentations, at least two, the smallest first.
    pub fn growing<D>(&self, raw: &Spanned<LogSweep<D>>) -> Result<Vec<f64>, InputError> {
        let indentations = &raw.get_ref().values;
        if indentations.len() < 2 || indentations.windows(2).any(|pair| pair[0] >= pair[1]) {
            let message = "found fewer than two indentations, or not in ascending order; allowed: two or more, the smallest first";
            return Err(self.source.error_at(raw.span(), message));
        }
        Ok(indentations.clone())
    }
}
