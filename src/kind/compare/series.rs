//! One surface under one law: a case for each layer thickness; names on a page.

use asperity::Exceeded;
use asperity::compare::{AdmissibleRange, ComparedQuantity, ModelKind};
use asperity::law::Body;
use asperity::study::{CaseResults, CaseStudy, FilmFriction, LawFindings, LayerFindings, Verdicts};
use asperity_contact_framework::metadata::LayerMetadata;
use asperity_contact_framework::report::format::{input_quantity, range, thickness};

use super::figures::curves::Units;
use super::results::{CompareResults, SurfaceResults};

/// One surface under one law: a case for each thickness.
pub struct Series<'a> {
    pub findings: &'a LayerFindings,
    pub subject: String,
    pub surface: &'a str,
    pub stem: String,
    pub cases: Vec<&'a CaseResults>,
    /// The friction by thickness; empty where it is not asked for.
    pub friction: Vec<&'a FilmFriction>,
    pub realisations: usize,
    pub repeats: &'static str,
    pub modulus: f64,
    pub units: Units,
    /// Whether separation and area by thickness are the main figure of the page, as Fig. 6 of the paper.
    pub is_figure_of_paper: bool,
    verdicts: Vec<&'a Verdicts>,
}

impl<'a> Series<'a> {
    /// Every surface under every law with several thicknesses.
    pub fn all(results: &'a CompareResults) -> Vec<Self> {
        let laws = |surface: &'a SurfaceResults| {
            surface.laws.iter().filter_map(move |law| Self::new(results, surface, law))
        };
        results.surfaces.iter().flat_map(laws).filter(|series| series.cases.len() > 1).collect()
    }

    /// At which thicknesses a coefficient is least: all that its 95 % interval does not tell apart. "at 80 to 150 nm", "without the layer".
    pub fn least_friction_at(&self, friction: &FilmFriction) -> Option<String> {
        let (least_at, least) = friction.least()?;
        let half_width = self.verdicts().find(|(t, _)| *t == least_at).and_then(|(_, verdicts)| {
            let at = verdicts.differences.iter().find(|at| at.load == friction.pressure)?;
            let model = usize::from(friction.kind == ModelKind::Deterministic);
            Some(at.of_models[model]?[ComparedQuantity::Friction as usize])
        });
        let most = least * half_width.unwrap_or(0.0).exp();
        let mut alike = friction
            .points
            .iter()
            .filter(|(t, coefficient)| *t > 0.0 && t.is_finite() && *coefficient <= most);
        let first = alike.next().map(|(t, _)| *t);
        let last = alike.next_back().map(|(t, _)| *t);
        let ends = [friction.points.first()?.0, friction.points.last()?.0];
        let at_end = match ends {
            [thinnest, _] if thinnest > 0.0 && first == Some(thinnest) => " (the thinnest run)",
            [_, thickest] if thickest.is_finite() && last.or(first) == Some(thickest) => {
                " (the thickest run)"
            }
            _ => "",
        };
        Some(match (first, last) {
            _ if least_at == 0.0 => "without the layer".to_owned(),
            _ if least_at == f64::INFINITY => "on the bulk of the layer's material".to_owned(),
            (Some(first), Some(last)) => format!("at {}{at_end}", range([first, last], "m")),
            _ => format!("at {}{at_end}", thickness(least_at)),
        })
    }

    /// Whether a load is admissible under all thicknesses.
    pub fn is_admissible(&self, load: f64) -> bool {
        self.verdicts
            .iter()
            .all(|verdicts| verdicts.differences.iter().any(|at| at.load == load && at.exceeded().is_none()))
    }

    fn new(results: &'a CompareResults, surface: &'a SurfaceResults, law: &'a LawFindings) -> Option<Self> {
        let cases = || surface.cases.iter().filter(|case| case.first().law == law.law);
        Some(Self {
            findings: law.layer.as_ref()?,
            subject: subject(results, surface, &law.law),
            surface: &surface.surface.name,
            stem: stem(surface, &law.law),
            cases: cases().map(CaseStudy::first).collect(),
            friction: surface.friction.iter().filter(|found| found.law == law.law).collect(),
            realisations: surface.realisations.len(),
            repeats: surface.surface.repeats.name(),
            modulus: results.contact.reduced_modulus,
            units: Units::new(results, surface),
            is_figure_of_paper: results.figures_of_paper.contains(&6),
            verdicts: cases().map(|case| &case.verdicts).collect(),
        })
    }

    /// The verdicts by thickness (m).
    pub fn verdicts(&self) -> impl Iterator<Item = (f64, &'a Verdicts)> {
        let each = self.cases.iter().zip(&self.verdicts);
        each.filter_map(|(case, &verdicts)| Some((case.thickness?, verdicts)))
    }

    /// The admissible loads of each case.
    pub fn valid(&self) -> impl Iterator<Item = &'a AdmissibleRange> {
        self.verdicts.iter().map(|verdicts| &verdicts.admissible)
    }

    /// Cases with a layer of finite thickness.
    pub fn finite(&self) -> impl Iterator<Item = (f64, &'a CaseResults)> {
        let is_finite = |t: &f64| *t > 0.0 && t.is_finite();
        self.cases.iter().filter_map(move |case| Some((case.thickness.filter(is_finite)?, *case)))
    }
}

/// Whether both models are within their limits at a prescribed pressure (Pa).
pub fn is_valid_at(case: &CaseResults, load: f64) -> bool {
    let points = case.comparison.curves.iter().filter(|point| point.prescribed_pressure == Some(load));
    points.map(|point| point.response.exceeded()).all(Exceeded::is_none)
}

/// The surface, and the law where there are several.
pub fn subject(results: &CompareResults, surface: &SurfaceResults, law: &str) -> String {
    let has_one_law = results.surfaces.iter().all(|surface| surface.laws.len() == 1);
    let name = &surface.surface.name;
    if has_one_law { name.clone() } else { format!("{name}, law {law}") }
}

/// The same as the beginning of a file's name.
pub fn stem(surface: &SurfaceResults, law: &str) -> String {
    let name = &surface.surface.name;
    if surface.laws.len() == 1 { name.clone() } else { format!("{name}-{}", slug(law)) }
}

/// A law's label as part of a file name.
fn slug(label: &str) -> String {
    let kept: String = label.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    kept.trim_matches('-').to_owned()
}

/// "under 50 nm of lead", or "50 nm of lead on the rough body".
pub fn under(layer: &LayerMetadata, t: f64) -> String {
    let of = || format!("{} of {}", input_quantity(t, "m"), layer.name);
    match (layer.on, t) {
        (Body::Flat, 0.0) => "on the uncoated flat".to_owned(),
        (Body::Flat, f64::INFINITY) => format!("on bulk {}", layer.name),
        (Body::Flat, _) => format!("under {}", of()),
        (Body::Rough, 0.0) => "rough body uncoated".to_owned(),
        (Body::Rough, f64::INFINITY) => format!("rough body of bulk {}", layer.name),
        (Body::Rough, _) => format!("{} on the rough body", of()),
    }
}
