//! Results of a comparison: everything that its report contains.

use std::path::PathBuf;

use asperity::analytical::AnalyticalLine;
use asperity::law::Body;
use asperity::spot::{Joint, SpotProperties};
use asperity::study::{
    CaseResults, CaseStudy, DecreaseResults, Dependence, FilmFriction, LawFindings, RealisationFacts,
    Threshold, Treated, TreatedCases, under_treatments,
};
use asperity::surface::Surface;
use asperity::work::Counter;
use asperity_contact_framework::RunContext;
use asperity_contact_framework::input::accept::AcceptSpec;
use asperity_contact_framework::metadata::{ContactMetadata, Metadata};
use asperity_contact_framework::progress::Progress;
use asperity_contact_framework::report::format::{percent, quantity};

use super::contact_map::ContactMap;
use super::reference::{ContactView, ElasticCase};
use super::spec::ComparePlan;
use crate::layer::{CoatedSurface, hardness_warning, rule_warning};
use crate::surface::rows::SurfaceRow;
use crate::surface::{SurfaceFactory, fitness, warnings};

#[derive(Debug)]
pub struct CompareResults {
    pub metadata: Metadata,
    pub contact: ContactMetadata,
    /// What is asked of the spots of the contact.
    pub spots: SpotProperties,
    /// Warnings about inputs that are hardly meant or too coarse.
    pub implausible: Vec<String>,
    /// Surface by surface, in file order.
    pub surfaces: Vec<SurfaceResults>,
    pub lines: Vec<AnalyticalLine>,
    /// How the reference was run; `None` where none was asked for.
    pub reference: Option<ReferenceMetadata>,
    /// Of a measured file that the command line named.
    pub described: Option<Described>,
    pub figures_of_paper: Vec<u8>,
}

#[derive(Debug)]
pub struct ReferenceMetadata {
    /// Points along an axis for each of the map's.
    pub refine: usize,
    /// Laws that yield beside an elastic reference.
    pub elastic: Vec<ElasticCase>,
}

/// What the command line made of a measured file.
#[derive(Debug)]
pub struct Described {
    pub file: PathBuf,
    /// The spec that runs the same.
    pub spec: String,
}

impl CompareResults {
    /// Whether the gap between the models is divided among its causes.
    pub fn is_attributed(&self) -> bool {
        let mut cases = self.surfaces.iter().flat_map(|surface| &surface.cases);
        cases.any(|case| !case.first().attribution.is_empty())
    }

    /// Its surfaces and their realisations as rows of `surfaces.csv`.
    pub fn surface_rows(&self) -> impl Iterator<Item = SurfaceRow<'_>> {
        self.surfaces.iter().flat_map(SurfaceResults::rows)
    }

    /// Warnings about the results, one per line.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = warnings(self.surfaces.iter().map(|results| &results.surface));
        lines.extend(self.warnings_of_contact());
        lines
    }

    /// The warnings of a page, which has a table of the faults of maps.
    pub fn page_warnings(&self) -> Vec<String> {
        let of_surface = |results: &SurfaceResults| {
            let failures = fitness::failures(&results.surface);
            let others = results.surface.warnings.iter().filter(|warning| !failures.contains(warning));
            others.map(|warning| format!("surface {}: {warning}", results.surface.name)).collect::<Vec<_>>()
        };
        let mut lines: Vec<String> = self.surfaces.iter().flat_map(of_surface).collect();
        lines.extend(self.warnings_of_contact());
        lines
    }

    fn warnings_of_contact(&self) -> Vec<String> {
        let mut lines = self.implausible.clone();
        lines.extend(self.elastic_reference_note());
        lines.extend(self.contact.caveats.iter().cloned());
        lines.extend(self.surfaces.iter().filter_map(SurfaceResults::ballistic_warning));
        lines.extend(
            self.contact
                .layer
                .as_ref()
                .and_then(|layer| rule_warning(layer.check.as_ref()?, &layer.name, layer.rule)),
        );
        let layer = self.contact.layer.as_ref();
        let yielding = layer.filter(|_| !self.is_uncoated_body_softest());
        lines.extend(yielding.and_then(|layer| hardness_warning(&layer.name, self.contact_ratios())));
        if let Some(layer) = layer.filter(|layer| layer.on == Body::Rough) {
            let surfaces = self.surfaces.iter().map(SurfaceResults::coated);
            lines.extend(surfaces.flat_map(|surface| surface.warnings(&layer.name, &layer.thicknesses)));
        }
        lines
    }

    /// Whether the body without the layer is softer than both layer and substrate: it then yields first under every thickness, and the
    /// effective hardness decides nothing.
    fn is_uncoated_body_softest(&self) -> bool {
        let ContactMetadata { materials, bodies, layer: Some(layer), .. } = &self.contact else {
            return false;
        };
        let (bare, substrate) = match layer.on {
            Body::Rough => (&bodies.flat, &bodies.rough),
            Body::Flat => (&bodies.rough, &bodies.flat),
        };
        let hardness = |name: &str| materials[name].hardness().unwrap_or(f64::INFINITY);
        hardness(bare) < hardness(substrate).min(hardness(&layer.name))
    }

    /// Each finite thickness (m) under which contacts may yield, with the largest mean contact radius over it: at prescribed loads, and at
    /// admissible ones of a separation sweep.
    fn contact_ratios(&self) -> impl Iterator<Item = (f64, f64)> {
        let cases = self.surfaces.iter().flat_map(|surface| &surface.cases).map(CaseStudy::first);
        cases.filter(|case| case.plasticity_index.is_some()).filter_map(|case| {
            let thickness = case.thickness.filter(|t| *t > 0.0 && t.is_finite())?;
            Some((thickness, mean_radii(case).reduce(f64::max)? / thickness))
        })
    }
}

/// The mean contact radii (m) of a case at prescribed loads, and at admissible ones of a separation sweep.
fn mean_radii(case: &CaseResults) -> impl Iterator<Item = f64> {
    let points = case.comparison.curves.iter().zip(case.comparison.exceeded());
    let points = points.filter(|(point, exceeded)| point.prescribed_pressure.is_some() || exceeded.is_none());
    points.filter_map(|(point, _)| point.response.mean_contact_radius())
}

#[derive(Debug)]
pub struct SurfaceResults {
    /// The first realisation, with its asperities.
    pub surface: Surface,
    /// The area that its load acts on, m²: its own nominal area, or that of the spec.
    pub load_area: f64,
    /// What is asked of the spots of its contacts, under the thinnest layer.
    pub spots: SpotProperties,
    /// What correlations of conductances take of it; `None` without a map.
    pub joint: Option<Joint>,
    /// Its realisations, the first first; the asperities of the others are not kept.
    pub realisations: Vec<RealisationFacts>,
    /// Every law under every thickness, in file order.
    pub cases: Vec<CaseStudy>,
    /// Law by law, in file order.
    pub laws: Vec<LawFindings>,
    /// The friction of the first by the thickness of the layer; empty where it is not asked for.
    pub friction: Vec<FilmFriction>,
    /// Up to which thickness the first takes no notice of the layer, law by law, load by load, model by model.
    pub thresholds: Vec<Threshold>,
    /// Where the sharpest, a mean and the bluntest asperity of the first carry less, or touch on less, as they are
    /// pressed deeper.
    pub decreases: Vec<DecreaseResults>,
    /// The nesting index (m) of the map's own S filter, `None` without one; where other treatments of a measured map were examined.
    pub own_cut_off: Option<Option<f64>>,
    /// The contact of each solution of the reference at one load, on the first.
    pub contacts: Vec<ContactView>,
    /// The contacts on its map in each case, where it was measured and there are few cases; else empty.
    pub contact_maps: Vec<Option<ContactMap>>,
}

impl SurfaceResults {
    pub(super) fn contact_map(&self, case: &CaseStudy) -> Option<&ContactMap> {
        let mut maps = self.cases.iter().zip(&self.contact_maps);
        maps.find(|(one, _)| std::ptr::eq(*one, case))?.1.as_ref()
    }

    /// A warning where electrical spots are so small against the mean free path of electrons that they resist noticeably more.
    fn ballistic_warning(&self) -> Option<String> {
        /// That of a spot as large as ten mean free paths.
        const SMALL: f64 = 0.085;
        let conduction = self.spots.electrical.as_ref()?;
        let cases = self.cases.iter().map(CaseStudy::first);
        let bare = cases.filter(|case| case.thickness.is_none_or(|thickness| thickness == 0.0));
        let smallest = bare.flat_map(mean_radii).reduce(f64::min)?;
        let excess = conduction.ballistic_excess(smallest);
        (excess > SMALL).then(|| {
            format!(
                "surface {}: spots of {} mean radius are below ten mean free paths of electrons in metals: they resist up to about \
                 {} more (Sharvin)",
                self.surface.name,
                quantity(smallest, "m"),
                percent(excess)
            )
        })
    }

    /// The first realisation as a rough body that has a layer.
    fn coated(&self) -> CoatedSurface<'_> {
        let facts = &self.realisations[0];
        CoatedSurface {
            name: &self.surface.name,
            radius: facts.population.radius,
            sq: facts.roughness.map(|roughness| roughness.moments.sq),
        }
    }

    fn rows(&self) -> impl Iterator<Item = SurfaceRow<'_>> {
        self.realisations.iter().zip(1..).map(|(facts, realisation)| SurfaceRow {
            name: &self.surface.name,
            realisation,
            asperities: facts.asperities,
            nominal_area: facts.nominal_area,
            statistics: facts.statistics,
            moments: facts.roughness.map(|roughness| roughness.moments),
            surface: (realisation == 1).then_some(&self.surface),
            plasticity_index: self
                .cases
                .first()
                .and_then(|case| case.realisations.get(realisation - 1)?.plasticity_index),
            // A joint density is named in the spec.
            population: Some(&facts.population)
                .filter(|_| facts.model.joint.is_none() && self.surface.unscattered.is_none()),
        })
    }
}

/// The differences between the models under other treatments of a map.
pub struct Treatments {
    /// Nesting index of the map's own S filter, m.
    own_cut_off: Option<f64>,
    treated: Vec<TreatedCases>,
}

/// Compares the models on a surface, which gave `cases`, under other treatments; `None` unless it is a measured map and both models
/// were run and compared at an admissible load.
pub fn treatments(
    context: &RunContext,
    plan: &ComparePlan,
    factory: &SurfaceFactory,
    surface: &Surface,
    cases: &[CaseResults],
    counter: &Counter,
) -> Option<Treatments> {
    let own = factory.preparation().filter(|_| plan.is_robustness_examined)?;
    let correlation = surface.map.as_ref()?.correlation;
    let prepare = |preparation, progress: &dyn Progress| factory.prepared(preparation, correlation, progress);
    let treated = under_treatments(plan.setup(context), surface, &own, cases, prepare, counter)?;
    Some(Treatments { own_cut_off: own.filter.and_then(|filter| filter.s()), treated })
}

impl Treatments {
    /// Adds the differences to the cases, with the choices that a verdict depends on; gives the nesting index of the map's own S
    /// filter.
    pub fn judge(self, cases: &mut [CaseStudy], surface: &Surface, accept: AcceptSpec) -> Option<f64> {
        let accepted = accept.on(surface.plane.sigma);
        for (treatment, differences) in self.treated {
            let mut differences = differences.into_iter();
            for case in cases.iter_mut() {
                let differences = differences.next().unwrap_or_default();
                case.treated.push(Treated { treatment, differences });
            }
        }
        for case in cases {
            case.dependences = Dependence::all(&case.first().differences, &case.treated, &accepted);
        }
        self.own_cut_off
    }
}
