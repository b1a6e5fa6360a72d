//! A comparison under a layer in several thicknesses: Fig. 6 of Pasaribu and Schipper (2005), and thickness as an axis.

mod answers;
mod figures;

use super::axes::Units;
use super::names::{stem, subject, under};
use super::{answer_over, headline_over};
use crate::kind::compare::answers::{CaseResults, Threshold};
use crate::kind::compare::findings::{
    AtThickness, GapRange, LawFindings, LayerFindings, PlasticRange, Verdicts,
};
use crate::kind::compare::results::{CompareResults, SurfaceResults};
use asperity::Exceeded;
use asperity::compare::{ComparedQuantity, GOOD_RATIO, ReferencePoint, ValidRange};
use asperity_framework::contact::LayerMetadata;
use asperity_framework::report::format::{
    input_quantity, listed, number, percent, quantity, ratio, thickness,
};
use asperity_framework::report::page::{Page, escape};

/// One surface under one law: a case for each thickness.
pub struct Series<'a> {
    layer: &'a LayerMetadata,
    found: &'a SurfaceResults,
    findings: &'a LayerFindings,
    subject: String,
    stem: String,
    law: &'a str,
    cases: Vec<&'a CaseResults>,
    thresholds: Vec<&'a Threshold>,
    modulus: f64,
    units: Units,
}

/// Accuracy of the effective-modulus models against the exact solution; nothing where no contact needs one.
pub fn rule_section(page: &mut Page, layer: &LayerMetadata) {
    let Some(check) = &layer.check else { return };
    page.heading(2, "Accuracy of the effective-modulus model");
    let place = if check.is_good() { "within" } else { "outside" };
    page.paragraph(&format!(
        "The layer modulus is {} times the substrate modulus, {place} the range {} to {} in which the model `gao` is \
         accurate (Perriot and Barthel 2004). Table: elastic load by both effective-modulus models over that of the exact \
         solution at equal indentation, where a is the exact contact radius. This experiment uses `{}`; a/t of its \
         contacts is in the tables below. The ball of the exact solution has the elastic constants of the rough body. The \
         load of a plastic contact does not depend on the modulus.",
        number(check.modulus_ratio),
        GOOD_RATIO[0],
        GOOD_RATIO[1],
        layer.rule.name(),
    ));
    let [gao, series] = &check.reported;
    page.table(
        ["a/t", "load by gao / exact", "load by series / exact"],
        gao.iter()
            .zip(series)
            .map(|(gao, series)| vec![number(gao.contact_ratio), ratio(gao.ratio), ratio(series.ratio)]),
    );
}

/// Every surface under every law; nothing without a layer.
pub fn all(results: &CompareResults) -> Vec<Series<'_>> {
    let Some(layer) = &results.contact.layer else { return Vec::new() };
    let laws =
        results.surfaces.iter().flat_map(|found| found.findings.laws.iter().map(move |law| (found, law)));
    laws.filter_map(|(found, law)| Series::new(results, layer, found, law)).collect()
}

impl<'a> Series<'a> {
    fn new(
        results: &'a CompareResults,
        layer: &'a LayerMetadata,
        found: &'a SurfaceResults,
        law: &'a LawFindings,
    ) -> Option<Self> {
        Some(Self {
            layer,
            found,
            findings: law.layer.as_ref()?,
            subject: subject(results, found, &law.law),
            stem: stem(found, &law.law),
            law: &law.law,
            cases: found.first.cases.iter().filter(|case| case.law == law.law).collect(),
            thresholds: found.thresholds.iter().filter(|threshold| threshold.law == law.law).collect(),
            modulus: results.contact.reduced_modulus,
            units: Units::of(results, found),
        })
    }

    pub fn found(&self) -> &'a SurfaceResults {
        self.found
    }

    /// The surface, and the law where there are several.
    pub fn subject(&self) -> &str {
        &self.subject
    }

    /// What the names of its files begin with.
    pub fn stem(&self) -> &str {
        &self.stem
    }

    /// The verdicts with the thickness of each.
    pub fn named_verdicts(&self) -> Vec<(String, &'a Verdicts)> {
        self.verdicts().map(|(t, verdicts)| (thickness(t), verdicts)).collect()
    }

    /// Whether there is more than one thickness to compare.
    pub fn has_several(&self) -> bool {
        self.cases.len() > 1
    }

    /// The findings, one line each.
    pub fn summary_lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        lines.extend(self.threshold_line());
        lines.extend(self.findings.plastic.as_ref().map(|found| self.plastic_line(found)));
        lines.extend(self.findings.gap.as_ref().map(|found| self.gap_line(found)));
        lines
    }

    fn threshold_line(&self) -> Option<String> {
        let at_load = |&load: &f64| {
            let each = self.thresholds.iter().filter(|threshold| threshold.pressure == load);
            let each: Vec<String> = each
                .map(|threshold| format!("{} ({})", depth(threshold.thickness), threshold.kind.name()))
                .collect();
            format!("at {} {}", input_quantity(load, "Pa"), each.join(" or "))
        };
        let parts: Vec<String> = self.findings.loads.iter().map(at_load).collect();
        (!parts.is_empty()).then(|| {
            format!(
                "**{}**: by the models the thickness of {} below which the layer has no effect (real contact area within 5 % of the \
                 uncoated one) is {}.{}",
                escape(&self.subject),
                escape(&self.layer.name),
                listed(&parts),
                self.thinnest_in_reference().unwrap_or_default(),
            )
        })
    }

    /// What the thinnest layer changes in the reference, whatever the models say.
    fn thinnest_in_reference(&self) -> Option<String> {
        let uncoated = self.cases.iter().find(|case| case.thickness == Some(0.0))?.reference.as_ref()?;
        let (thickness, thinnest) = self.finite().next()?;
        let valid = self.valid().next()?;
        let thinnest = thinnest.reference.as_ref()?.points.iter();
        let thinnest = thinnest
            .filter(|point| valid.stretches.iter().any(|[from, to]| (*from..=*to).contains(&point.pressure)));
        let change = |point: &'a ReferencePoint| {
            Some((point.area_ratio / uncoated.at_load(point.pressure)?.area_ratio - 1.0, point))
        };
        let (change, point) = thinnest.filter_map(change).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        let sign = if change < 0.0 { "−" } else { "+" };
        Some(format!(
            " In the reference {} of {} change it by up to {sign}{} (at {}; error of the grid up to {}).",
            input_quantity(thickness, "m"),
            escape(&self.layer.name),
            percent(change.abs()),
            input_quantity(point.pressure, "Pa"),
            percent(point.bounds[ComparedQuantity::Area as usize]),
        ))
    }

    fn plastic_line(&self, found: &PlasticRange) -> String {
        let under = |at: AtThickness| format!("{} ({})", under(self.layer, at.thickness), percent(at.value));
        format!(
            "**{}**: the plastic share of the load at {} ({}) is largest {} and smallest {}.",
            escape(&self.subject),
            input_quantity(found.load, "Pa"),
            found.model.name(),
            under(found.largest),
            under(found.smallest),
        )
    }

    fn gap_line(&self, found: &GapRange) -> String {
        let GapRange { largest, smallest } = found;
        let least = if largest.value > smallest.value {
            format!(
                " and by up to {} σ {} (smallest difference)",
                number(smallest.value),
                under(self.layer, smallest.thickness)
            )
        } else {
            String::new()
        };
        format!(
            "**{}**: at equal load the separations of the two models differ by up to {} σ {} (largest difference){least}, \
             over the valid loads.",
            escape(&self.subject),
            number(largest.value),
            under(self.layer, largest.thickness),
        )
    }

    /// Over all thicknesses in one sentence.
    pub fn headline(&self) -> Option<String> {
        let all: Vec<&Verdicts> = self.verdicts().map(|(_, verdicts)| verdicts).collect();
        headline_over(&self.subject, "thicknesses", &all, self.found)
    }

    /// The verdicts by thickness.
    pub fn answer(&self, page: &mut Page) {
        let all = self.named_verdicts();
        answer_over(page, &self.subject, "thickness", &all, self.found);
        if let Some(figure) = figures::against_reference(self) {
            page.figure(
                &format!("{}-against-reference.svg", self.stem),
                figure,
                &format!(
                    "{}: both models minus the reference at equal load, by layer thickness. Solid: deterministic model; dashed: \
                     statistical model; green: accepted. Valid loads only.",
                    self.subject
                ),
            );
        }
    }

    /// The valid range of each case.
    fn valid(&self) -> impl Iterator<Item = &'a ValidRange> {
        let each = self.found.first.cases.iter().zip(&self.found.findings.cases);
        let law = self.law;
        each.filter(move |(case, _)| case.law == law).map(|(_, findings)| &findings.verdicts.valid)
    }

    /// The verdicts by thickness (m).
    pub fn verdicts(&self) -> impl Iterator<Item = (f64, &'a Verdicts)> {
        let each = self.found.first.cases.iter().zip(&self.found.findings.cases);
        let law = self.law;
        let own = each.filter(move |(case, _)| case.law == law);
        own.filter_map(|(case, findings)| Some((case.thickness?, &findings.verdicts)))
    }

    /// Cases with a layer of finite thickness.
    fn finite(&self) -> impl Iterator<Item = (f64, &'a CaseResults)> {
        let finite =
            |case: &&'a CaseResults| case.thickness.filter(|t| *t > 0.0 && t.is_finite()).map(|t| (t, *case));
        self.cases.iter().filter_map(finite)
    }
}

/// Whether both models are within their valid range at a prescribed pressure (Pa).
fn is_valid_at(case: &CaseResults, load: f64) -> bool {
    let points = case.comparison.curves.iter().filter(|point| point.prescribed_pressure == Some(load));
    points.map(|point| point.response.exceeded()).all(Exceeded::is_none)
}

/// A threshold as text.
fn depth(thickness: Option<f64>) -> String {
    match thickness {
        None => "less than 1 pm".to_owned(),
        Some(f64::INFINITY) => "no effect up to 1 m".to_owned(),
        // It is known to 1 %.
        Some(t) => quantity(format!("{t:.1e}").parse().unwrap_or(t), "m"),
    }
}
