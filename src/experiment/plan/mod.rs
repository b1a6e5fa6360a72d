//! From the words of a spec to things that run: names resolved, files looked at, memory counted.

mod generate;
mod indentation;
mod laws;
mod layer;
mod precision;
mod resolver;
mod stability;
mod surface;

pub use indentation::{IndentationPlan, OverlayPlan};
pub use laws::{Critical, LawsPlan};
pub use layer::{LayerPlan, thickness_words};
pub use precision::PrecisionPlan;
pub use stability::StabilityPlan;
pub use surface::SurfacePlan;

use std::fmt;
use std::path::{Path, PathBuf};

use super::input_error::{InputError, Source};
use super::overview::AnalysisDepth;
use super::results::Bodies;
use super::spec::{self, LawSpec, Spec};
use asperity::asperity::{HeightDensity, Population};
use asperity::compare::{Controls, Kind};
use asperity::interface::MicroContact;
use asperity::material::Material;
use asperity::model::MeanRadius;
use indexmap::IndexMap;
use toml::Spanned;

/// What a spec must hold.
const ONE_OF_THE_KINDS: &str =
    "exactly one of [compare], [indentation], [laws], [limit], [precision], [stability]";

/// A spec that can be run.
pub struct Plan {
    /// The spec's text, for refusals that only a run can find.
    pub source: Source,
    /// Stem of the file: the name of the report's folder.
    pub stem: String,
    /// What the report is called.
    pub title: String,
    /// What the spec's author says of it.
    pub notes: String,
    /// Every random number comes from it.
    pub seed: u64,
    /// The bodies that are used, in file order.
    pub materials: IndexMap<String, Material>,
    /// What is run.
    pub kind: PlanKind,
}

/// The kinds of experiment.
pub enum PlanKind {
    /// `[compare]`
    Compare(ComparePlan),
    /// `[limit]`
    Limit(LimitPlan),
    /// `[indentation]`
    Indentation(IndentationPlan),
    /// `[laws]`
    Laws(LawsPlan),
    /// `[precision]`
    Precision(Box<PrecisionPlan>),
    /// `[stability]`
    Stability(StabilityPlan),
    /// A look at surfaces, whatever the spec's kind.
    Surfaces(Vec<SurfacePlan>),
}

/// A law and the micro-contact that it makes of the two bodies.
pub struct LawPlan {
    /// How tables and plots name it.
    pub label: String,
    /// Thickness of the layer, m; `None` where no layer is asked for.
    pub thickness: Option<f64>,
    /// The micro-contact.
    pub contact: Box<dyn MicroContact>,
    /// The law in the words of a spec.
    pub spec: LawSpec,
}

/// Both models on given surfaces.
pub struct ComparePlan {
    /// Who touches whom.
    pub bodies: Bodies,
    /// The rough body and the flat.
    pub pair: [Material; 2],
    /// What lies on the flat.
    pub layer: Option<Box<LayerPlan>>,
    /// The laws, each under every thickness of the layer.
    pub laws: Vec<LawPlan>,
    /// The laws alone.
    pub law_specs: Vec<LawSpec>,
    /// The models that are asked for.
    pub models: Vec<Kind>,
    /// Height density of the statistical model, where the spec names one.
    pub heights: Option<HeightDensity>,
    /// Which mean stands for the radii.
    pub mean_radius: MeanRadius,
    /// What the surfaces are pressed to.
    pub controls: Controls,
    /// Where the spec asks for pressures and forces, for a load that is not reached.
    pub load_keys: [Option<std::ops::Range<usize>>; 2],
    /// The surfaces.
    pub surfaces: Vec<SurfacePlan>,
}

/// Sets of growing size against their limit.
pub struct LimitPlan {
    /// Who touches whom.
    pub bodies: Bodies,
    /// The laws.
    pub laws: Vec<LawPlan>,
    /// What the sets are drawn from.
    pub population: Population,
    /// d/sigma.
    pub separations: Vec<f64>,
    /// Sizes of the sets.
    pub counts: Vec<usize>,
    /// Random sets of each size.
    pub draws: usize,
}

impl ComparePlan {
    /// Whether some contact is under a layer of finite thickness: of a listed one, or of one at which the layer begins to
    /// matter, which is looked for at given loads.
    pub fn uses_rule(&self, layer: &LayerPlan) -> bool {
        let has_loads = !(self.controls.pressures.is_empty() && self.controls.forces.is_empty());
        layer.thicknesses.iter().any(|&t| t > 0.0 && (t.is_finite() || has_loads))
    }

    /// An estimate of the asperities and nodes that are evaluated.
    fn work(&self) -> u128 {
        let all = |surface: &SurfacePlan| surface.most_asperities() * surface.realisations as u128;
        let asperities: u128 = self.surfaces.iter().map(all).sum();
        asperities * (self.controls.points() * self.laws.len()) as u128
    }
}

impl Plan {
    /// Reads a spec and everything about its files that can be known without running it; what stands behind --full is
    /// planned only if it is to be run in `full`.
    ///
    /// # Errors
    /// The first thing that keeps it from running.
    pub fn read(path: &Path, full: bool) -> Result<Self, InputError> {
        let (source, spec) = spec::read(path)?;
        let stem = stem_of(path)?;
        let resolver = resolver::Resolver { source: &source, spec: &spec };
        let kinds = [
            spec.compare.as_ref().map(Spanned::span),
            spec.indentation.as_ref().map(Spanned::span),
            spec.laws.as_ref().map(Spanned::span),
            spec.limit.as_ref().map(Spanned::span),
            spec.precision.as_ref().map(Spanned::span),
            spec.stability.as_ref().map(Spanned::span),
        ];
        let mut given: Vec<_> = kinds.into_iter().flatten().collect();
        given.sort_unstable_by_key(|span| span.start);
        if let Some(second) = given.into_iter().nth(1) {
            return Err(source
                .error_at(second, format!("found a second experiment; allowed: {ONE_OF_THE_KINDS} a file")));
        }
        let uses_none = [
            spec.indentation.is_some(),
            spec.limit.is_some(),
            spec.precision.is_some(),
            spec.stability.is_some(),
        ]
        .contains(&true);
        if let Some((name, _)) = spec.surface.first().filter(|_| uses_none) {
            let message =
                "found a surface, which only [compare] and [laws] use; allowed: no [surface.NAME] here";
            return Err(source.error_at(name.span(), message));
        }
        if let Some((name, _)) = spec.material.first().filter(|_| spec.stability.is_some()) {
            let message =
                "found a material, where [stability] draws its own; allowed: no [material.NAME] here";
            return Err(source.error_at(name.span(), message));
        }
        let kind = if let Some(compare) = &spec.compare {
            PlanKind::Compare(resolver.compare(compare.get_ref(), compare.span())?)
        } else if let Some(indentation) = &spec.indentation {
            PlanKind::Indentation(resolver.indentation(indentation.get_ref())?)
        } else if let Some(laws) = &spec.laws {
            PlanKind::Laws(resolver.laws_on_all(laws.get_ref(), laws.span())?)
        } else if let Some(limit) = &spec.limit {
            PlanKind::Limit(resolver.limit(limit.get_ref())?)
        } else if let Some(precision) = &spec.precision {
            PlanKind::Precision(Box::new(resolver.precision(precision.get_ref(), precision.span(), full)?))
        } else if let Some(stability) = &spec.stability {
            PlanKind::Stability(resolver.stability(stability.get_ref())?)
        } else {
            return Err(InputError::file(path, format!("found no experiment; allowed: {ONE_OF_THE_KINDS}")));
        };
        Self::checked(source, stem, spec, kind)
    }

    /// Plans a look at all surfaces of a spec.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn look_at_spec(path: &Path) -> Result<Self, InputError> {
        let (source, spec) = spec::read(path)?;
        let stem = format!("{}-surfaces", stem_of(path)?);
        Self::surfaces_of(source, stem, spec)
    }

    /// Plans a look at the surface of a measured file, described in the words of a spec.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn look_at_file(words: String, path: &Path) -> Result<Self, InputError> {
        let (source, spec) = spec::from_command_line(words)?;
        let stem = format!("surface-{}", stem_of(path)?);
        Self::surfaces_of(source, stem, spec)
    }

    fn surfaces_of(source: Source, stem: String, spec: Spec) -> Result<Self, InputError> {
        let resolver = resolver::Resolver { source: &source, spec: &spec };
        let surfaces = resolver.surfaces(None, 0..0, false)?;
        Self::checked(source, stem, spec, PlanKind::Surfaces(surfaces))
    }

    fn checked(source: Source, stem: String, spec: Spec, kind: PlanKind) -> Result<Self, InputError> {
        let Spec { title, notes, seed, material, .. } = spec;
        let materials = material.into_iter().map(|(name, body)| (name.into_inner(), body.0)).collect();
        let plan = Self { source, stem, title, notes, seed, materials, kind };
        plan.check_memory()?;
        Ok(plan)
    }

    /// The measured files that it reads, each once.
    pub fn inputs(&self) -> Vec<PathBuf> {
        match &self.kind {
            PlanKind::Indentation(plan) => plan.overlay.iter().map(|overlay| overlay.path.clone()).collect(),
            _ => {
                let mut paths: Vec<PathBuf> = Vec::new();
                for path in self.surfaces().iter().filter_map(SurfacePlan::input) {
                    if !paths.contains(&path) {
                        paths.push(path);
                    }
                }
                paths
            }
        }
    }

    /// The surfaces that it makes or reads.
    fn surfaces(&self) -> &[SurfacePlan] {
        match &self.kind {
            PlanKind::Compare(compare) | PlanKind::Laws(LawsPlan { compare, .. }) => &compare.surfaces,
            PlanKind::Surfaces(surfaces) => surfaces,
            PlanKind::Indentation(_)
            | PlanKind::Limit(_)
            | PlanKind::Precision(_)
            | PlanKind::Stability(_) => &[],
        }
    }

    /// An estimate of the memory that a run needs at its peak, bytes.
    pub fn memory(&self) -> u128 {
        match &self.kind {
            PlanKind::Compare(_) | PlanKind::Laws(_) | PlanKind::Surfaces(_) => {
                // The asperities of every surface are kept for the report, one map at a time and those that are needed again.
                let readings: Vec<_> = self.surfaces().iter().map(SurfacePlan::reading).collect();
                let again = |k: usize| readings[k].is_some() && readings[k + 1..].contains(&readings[k]);
                let kept = self.surfaces().iter().enumerate();
                let kept =
                    kept.map(|(k, surface)| surface.kept() + if again(k) { surface.kept_file() } else { 0 });
                let kept: u128 = kept.sum();
                kept + self.surfaces().iter().map(|surface| surface.memory(self.look())).max().unwrap_or(0)
            }
            PlanKind::Indentation(plan) => plan.memory(),
            PlanKind::Precision(plan) => plan.memory(),
            PlanKind::Stability(plan) => plan.memory(),
            PlanKind::Limit(limit) => {
                let largest = limit.counts.iter().copied().max().unwrap_or(0);
                surface::set_memory(largest as u128)
            }
        }
    }

    /// The file that a look at `surfaces` is at: the one measured file that the command line named, or the spec.
    pub fn looked_at(&self, surfaces: &[SurfacePlan]) -> PathBuf {
        let measured =
            surfaces.first().and_then(SurfacePlan::input).filter(|_| self.source.is_command_line());
        measured.unwrap_or_else(|| self.source.path.clone())
    }

    /// How closely it looks at its surfaces.
    fn look(&self) -> AnalysisDepth {
        if matches!(self.kind, PlanKind::Surfaces(_)) {
            AnalysisDepth::Everything
        } else {
            AnalysisDepth::Spectrum
        }
    }

    /// An estimate of the work: asperities or nodes evaluated.
    pub fn work(&self) -> u128 {
        match &self.kind {
            PlanKind::Compare(compare) => compare.work(),
            PlanKind::Laws(plan) => plan.compare.work() + plan.points(),
            PlanKind::Indentation(plan) => plan.work(),
            PlanKind::Precision(plan) => plan.work(),
            PlanKind::Stability(plan) => plan.work(),
            PlanKind::Limit(limit) => {
                let asperities: u128 = limit.counts.iter().map(|&count| count as u128).sum();
                asperities * ((limit.draws + 1) * limit.laws.len() * limit.separations.len()) as u128
            }
            PlanKind::Surfaces(_) => 0,
        }
    }

    /// Refuses what memory cannot hold, before anything is allocated.
    fn check_memory(&self) -> Result<(), InputError> {
        let mut system = sysinfo::System::new();
        system.refresh_memory();
        let available = u128::from(system.available_memory());
        let needed = self.memory();
        // A system that does not tell how much there is refuses nothing.
        if available == 0 || needed <= available {
            return Ok(());
        }
        let message = format!(
            "this needs about {:.1} GB of memory; available: {:.1} GB. Allowed: fewer asperities or a smaller map",
            needed as f64 / 1e9,
            available as f64 / 1e9
        );
        let largest = self.surfaces().iter().max_by_key(|surface| surface.memory(self.look()));
        Err(match largest {
            Some(surface) => self.source.error_at(surface.size_key.clone(), message),
            None => InputError::file(&self.source.path, message),
        })
    }
}

fn describe(surfaces: &[SurfacePlan], f: &mut fmt::Formatter) -> fmt::Result {
    surfaces.iter().try_for_each(|surface| writeln!(f, "  surface {}: {}", surface.name, surface.describe()))
}

/// Stem of a file, by which its report is called.
pub(super) fn stem_of(path: &Path) -> Result<String, InputError> {
    let stem = path.file_stem().and_then(|stem| stem.to_str()).filter(|stem| !stem.starts_with('.'));
    stem.map(str::to_owned).ok_or_else(|| {
        InputError::file(
            path,
            "has no name to call the report by; allowed: a file name such as my-surface.toml",
        )
    })
}

impl fmt::Display for ComparePlan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let models: Vec<&str> = self.models.iter().map(|model| model.name()).collect();
        let laws: Vec<String> = self.law_specs.iter().map(LawSpec::label).collect();
        writeln!(f, "  {} on {}, law {}", self.bodies.rough, self.bodies.flat, laws.join(", "))?;
        let each = match &self.layer {
            Some(layer) => {
                writeln!(f, "  under {layer}")?;
                "law, thickness and surface"
            }
            None => "law and surface",
        };
        writeln!(f, "  {} at {} points a {each}", models.join(" and "), self.controls.points())?;
        describe(&self.surfaces, f)
    }
}

/// What it will do and need, for a person.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}: {}", self.source.path.display(), self.title)?;
        let laws = |laws: &[LawPlan]| laws.iter().map(|law| law.label.clone()).collect::<Vec<_>>().join(", ");
        match &self.kind {
            PlanKind::Compare(plan) => write!(f, "{plan}")?,
            PlanKind::Laws(plan) => write!(f, "{}{plan}", plan.compare)?,
            PlanKind::Indentation(plan) => write!(f, "{plan}")?,
            PlanKind::Precision(plan) => write!(f, "{plan}")?,
            PlanKind::Stability(plan) => write!(f, "{plan}")?,
            PlanKind::Surfaces(surfaces) => describe(surfaces, f)?,
            PlanKind::Limit(plan) => {
                writeln!(f, "  {} on {}, law {}", plan.bodies.rough, plan.bodies.flat, laws(&plan.laws))?;
                writeln!(
                    f,
                    "  {} random sets and one at the quantiles of each of {:?} asperities",
                    plan.draws, plan.counts
                )?;
            }
        }
        writeln!(
            f,
            "  memory: at most {:.1} MB; work: at most {:.1e} micro-contacts a pass",
            self.memory() as f64 / 1e6,
            self.work() as f64
        )
    }
}
