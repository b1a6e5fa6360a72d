//! One surface under one law by layer thickness: Fig. 6 of Pasaribu and Schipper (2005), and thickness as an axis.

use asperity::Exceeded;
use asperity::compare::ValidRange;
use asperity_framework::report::format::thickness;
use asperity_framework::report::page::Page;
use asperity_framework::report::table::Tables;

use super::{stem, subject};
use crate::kind::compare::figures::axes::Units;
use crate::kind::compare::figures::layers;
use crate::study::{CaseResults, CaseStudy, LawFindings, LayerFindings, Verdicts};

use crate::kind::compare::results::{CompareResults, SurfaceResults};
use crate::model_tables::CurveRow;

/// One surface under one law: a case for each thickness.
pub struct Series<'a> {
    pub findings: &'a LayerFindings,
    pub subject: String,
    /// Name of the surface.
    pub surface: &'a str,
    pub stem: String,
    pub cases: Vec<&'a CaseResults>,
    pub modulus: f64,
    pub units: Units,
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

    fn new(results: &'a CompareResults, surface: &'a SurfaceResults, law: &'a LawFindings) -> Option<Self> {
        let cases = || surface.cases.iter().filter(|case| case.first().law == law.law);
        Some(Self {
            findings: law.layer.as_ref()?,
            subject: subject(results, surface, &law.law),
            surface: &surface.surface.name,
            stem: stem(surface, &law.law),
            cases: cases().map(CaseStudy::first).collect(),
            modulus: results.contact.reduced_modulus,
            units: Units::new(results, surface),
            verdicts: cases().map(|case| &case.verdicts).collect(),
        })
    }

    /// The verdicts with the thickness of each.
    pub fn named_verdicts(&self) -> Vec<(String, &'a Verdicts)> {
        self.verdicts().map(|(t, verdicts)| (thickness(t), verdicts)).collect()
    }

    /// The verdicts by thickness (m).
    pub fn verdicts(&self) -> impl Iterator<Item = (f64, &'a Verdicts)> {
        let each = self.cases.iter().zip(&self.verdicts);
        each.filter_map(|(case, &verdicts)| Some((case.thickness?, verdicts)))
    }

    /// The admissible loads of each case.
    pub fn valid(&self) -> impl Iterator<Item = &'a ValidRange> {
        self.verdicts.iter().map(|verdicts| &verdicts.valid)
    }

    /// Cases with a layer of finite thickness.
    pub fn finite(&self) -> impl Iterator<Item = (f64, &'a CaseResults)> {
        let is_finite = |t: &f64| *t > 0.0 && t.is_finite();
        self.cases.iter().filter_map(move |case| Some((case.thickness.filter(is_finite)?, *case)))
    }

    /// The figures by load and by thickness.
    pub fn figures(&self, page: &mut Page) {
        if let Some(figure) = layers::against_reference(self) {
            page.figure(
                &format!("{}-against-reference.svg", self.stem),
                figure,
                &format!(
                    "{}: each model minus the reference at equal load, by layer thickness; green: accepted.",
                    self.subject
                ),
            );
        }
        page.figure(
            &format!("{}-layers.svg", self.stem),
            layers::by_load(self),
            "Separation and real contact area against load, by layer thickness; thin lines: loads that are not admissible.",
        );
        if self.findings.loads.is_empty() || self.findings.models.is_empty() || self.finite().count() < 2 {
            return;
        }
        page.figure(
            &format!("{}-thickness.svg", self.stem),
            layers::by_thickness(self),
            "Area, mean contact pressure and plastic share of the load against layer thickness; circles: admissible loads; markers at the \
             edges: uncoated and bulk.",
        );
        page.figure(
            &format!("{}-regimes.svg", self.stem),
            layers::regimes(self),
            &format!(
                "Share of the load by contact regime against layer thickness ({} model); an asterisk marks a load that is not admissible \
                 at some thickness.",
                self.findings.main_model().name()
            ),
        );
    }
}

impl Series<'_> {
    /// Both models at the loads at which thicknesses are compared.
    pub fn table(&self, page: &mut Page, tables: &Tables) {
        let loads = &self.findings.loads;
        if loads.is_empty() {
            page.paragraph(
                "Without `pressure` or `force` in the spec thicknesses are not compared at equal load.",
            );
            return;
        }
        let view =
            tables.view::<CurveRow>().only("surface", self.surface).only("law", self.cases[0].law.as_str());
        let view = view.only("realisation", 1usize).only("control", "pressure");
        let view = view.filter("target", |cell| cell.number().is_some_and(|load| loads.contains(&load)));
        page.view(&view.label("target", "nominal pressure").unit("target", "Pa", "M").columns(&[
            "target",
            "layer_thickness_m",
            "model",
            "contact_radius_over_thickness",
            "separation_over_sigma",
            "area_ratio",
            "mean_real_pressure_pa",
            "elastic_load_share",
            "elastic_plastic_load_share",
            "plastic_load_share",
            "limits",
        ]));
    }
}

/// Whether both models are within their limits at a prescribed pressure (Pa).
pub fn is_valid_at(case: &CaseResults, load: f64) -> bool {
    let points = case.comparison.curves.iter().filter(|point| point.prescribed_pressure == Some(load));
    points.map(|point| point.response.exceeded()).all(Exceeded::is_none)
}
