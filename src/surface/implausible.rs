//! A length or a density of a surface that is in another unit than was meant, which explains why a load is not reached.

use asperity::topography::{RoughnessParameters, Rows};
use asperity::{AsperityList, Population, Statistics};
use asperity_contact_framework::input::{InMemory, InputError, Source};
use asperity_contact_framework::progress::Silent;
use asperity_contact_framework::report::format::{input_quantity, number, quantity};

use super::plan::{MapPlan, Origin, SurfacePlan};

/// R.m.s. slopes of a map below those of any polished surface.
const LEAST_SLOPE: f64 = 1e-5;

/// Density times mean radius times standard deviation of the heights of asperities, which is 0.01 to 0.1 on rough surfaces;
/// a prefix of a square that is missing makes it a million times smaller.
const LEAST_PRODUCT: f64 = 1e-6;

impl SurfacePlan {
    /// The error at the key that is probably in another unit, where a load is not reached as `message` says; `None` of a
    /// surface that can be. Files are read again.
    pub fn implausible_unit(&self, source: &Source, message: &str) -> Option<InputError> {
        match &self.origin {
            Origin::Map(map) => self.of_map(map, source, message),
            Origin::Population { population: Population { radius, sigma, density, .. }, .. } => {
                let product = density * radius * sigma;
                let words = format!(
                    "found a density of {}, a radius of {} and a sigma of {}",
                    quantity(*density, "1/m²"),
                    quantity(*radius, "m"),
                    quantity(*sigma, "m")
                );
                self.of_asperities(source, ["population", "density"], "/mm^2", product, &words, message)
            }
            Origin::List { path, given, nominal_area, .. } => {
                let list = match source.content_in_memory(path) {
                    Some(InMemory::List(list)) => AsperityList::clone(list),
                    _ => AsperityList::read(path, *given, &Silent).ok()?,
                };
                let density = list.count() as f64 / nominal_area;
                let statistics = Statistics::new(&list.set(*nominal_area).ok()?);
                let product = density * statistics.mean_radius * statistics.sigma;
                let words = format!(
                    "found a density of {}, a mean radius of {} and a standard deviation of heights of {}",
                    quantity(density, "1/m²"),
                    quantity(statistics.mean_radius, "m"),
                    quantity(statistics.sigma, "m")
                );
                self.of_asperities(source, ["asperities", "nominal-area"], "mm^2", product, &words, message)
            }
            Origin::Generated(_) | Origin::Pair(_) => None,
        }
    }

    fn of_map(&self, map: &MapPlan, source: &Source, message: &str) -> Option<InputError> {
        let slope = match source.content_in_memory(&map.file.path) {
            Some(InMemory::Map { rows, .. }) => rms_slope(&**rows),
            _ => rms_slope(&*map.file.rows(&Silent).ok()?),
        };
        if slope >= LEAST_SLOPE {
            return None;
        }
        let value = |key| source.value_at(&["surface", &self.name, "file", key]);
        let is_bare = |(_, text): &(_, &str)| text.parse::<f64>().is_ok();
        let (span, written) = match (value("pixel").filter(is_bare), value("unit")) {
            (Some((span, text)), _) => (span, remedy("pixel", text, "um", "m")),
            (None, Some((span, _))) => {
                (span, "check `unit`: the heights of the file may be in metres already".to_owned())
            }
            (None, None) => {
                (value("pixel").or_else(|| value("path"))?.0, "check `pixel` and `unit`".to_owned())
            }
        };
        let found = format!(
            "found an r.m.s. slope of {} with a pixel of {}: less than that of any polished surface, so that a load is not reached; \
             heights and pixel are probably in different units; {written}. {message}",
            number(slope),
            input_quantity(map.pixel[0], "m"),
        );
        Some(source.error_at(span, found))
    }

    /// The error at the key of a density or an area, where asperities are too few, too sharp or too even for a rough surface.
    fn of_asperities(
        &self,
        source: &Source,
        [kind, key]: [&str; 2],
        unit: &str,
        product: f64,
        words: &str,
        message: &str,
    ) -> Option<InputError> {
        if product >= LEAST_PRODUCT {
            return None;
        }
        let (span, text) = source.value_at(&["surface", &self.name, kind, key])?;
        let si = if key == "density" { "1/m²" } else { "m²" };
        let found = format!(
            "{words}: their product is {}, on rough surfaces 0.01 to 0.1, so that a load is not reached; {}, and check the other two. \
             {message}",
            number(product),
            remedy(key, text, unit, si),
        );
        Some(source.error_at(span, found))
    }
}

fn rms_slope(map: &dyn Rows) -> f64 {
    RoughnessParameters::new(map).rms_slope()
}

/// What to write instead of the `text` of a key.
fn remedy(key: &str, text: &str, unit: &str, si: &str) -> String {
    match text.parse::<f64>() {
        Ok(number) => {
            format!(
                "a bare number is in {si}; if you mean {number} {unit}, write {key} = \"{number} {unit}\""
            )
        }
        Err(_) => format!("check the unit of `{key}`"),
    }
}
