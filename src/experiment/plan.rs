//! From the words of a spec to things that run: names resolved, files looked at, memory counted.

use std::fmt;
use std::path::{Path, PathBuf};

use indexmap::IndexMap;
use toml::Spanned;

use super::refusal::{Refusal, Source};
use super::spec::{self, CompareSpec, LawSpec, Laws, LimitSpec, Spec};
use super::surfaces::SurfacePlan;
use crate::asperity::{HeightDensity, Population};
use crate::compare::{Controls, Kind};
use crate::interface::MicroContact;
use crate::material::Material;
use crate::model::MeanRadius;

/// A spec that can be run.
pub struct Plan {
    /// The spec's text, for refusals that only a run can find.
    pub source: Source,
    /// Stem of the file: the name of the report's folder.
    pub stem: String,
    /// What the report is called.
    pub title: String,
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
}

/// A law and the micro-contact that it makes of the two bodies.
pub struct LawPlan {
    /// How tables and plots name it.
    pub label: String,
    /// The micro-contact.
    pub contact: Box<dyn MicroContact>,
    /// Whether it is purely elastic, with a closed form for Gaussian heights.
    pub is_hertz: bool,
}

/// The two bodies, by name.
#[derive(Debug, Clone)]
pub struct Bodies {
    /// Material of the rough body.
    pub rough: String,
    /// Material of the flat.
    pub flat: String,
}

/// Both models on given surfaces.
pub struct ComparePlan {
    /// Who touches whom.
    pub bodies: Bodies,
    /// The laws.
    pub laws: Vec<LawPlan>,
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

impl Plan {
    /// Reads a spec and everything about its files that can be known without running it.
    ///
    /// # Errors
    /// The first thing that keeps it from running.
    pub fn read(path: &Path) -> Result<Self, Refusal> {
        let (source, spec) = spec::read(path)?;
        let stem = path.file_stem().and_then(|stem| stem.to_str()).filter(|stem| !stem.starts_with('.'));
        let stem = stem.ok_or_else(|| {
            Refusal::file(
                path,
                "has no name to call the report by; allowed: a file name such as my-surface.toml",
            )
        })?;
        let reader = Reader { source: &source, spec: &spec };
        let kind = match (&spec.compare, &spec.limit) {
            (Some(compare), None) => PlanKind::Compare(reader.compare(compare.get_ref(), compare.span())?),
            (None, Some(limit)) => PlanKind::Limit(reader.limit(limit.get_ref())?),
            (None, None) => {
                return Err(Refusal::file(
                    path,
                    "found no experiment; allowed: exactly one of [compare], [limit]",
                ));
            }
            (Some(_), Some(second)) => {
                return Err(source.refuse(
                    second.span(),
                    "found a second experiment; allowed: exactly one of [compare], [limit] a file",
                ));
            }
        };
        let Spec { title, seed, material: materials, .. } = spec;
        let plan = Self { source, stem: stem.to_owned(), title, seed, materials, kind };
        plan.check_memory()?;
        Ok(plan)
    }

    /// The measured files that it reads.
    pub fn inputs(&self) -> Vec<PathBuf> {
        match &self.kind {
            PlanKind::Compare(compare) => compare.surfaces.iter().filter_map(SurfacePlan::input).collect(),
            PlanKind::Limit(_) => Vec::new(),
        }
    }

    /// An estimate of the memory that a run needs at its peak, bytes.
    pub fn memory(&self) -> u128 {
        match &self.kind {
            PlanKind::Compare(compare) => compare.surfaces.iter().map(SurfacePlan::memory).max().unwrap_or(0),
            PlanKind::Limit(limit) => {
                let largest = limit.counts.iter().copied().max().unwrap_or(0);
                super::surfaces::set_memory(largest as u128)
            }
        }
    }

    /// An estimate of the work: asperities or nodes evaluated.
    pub fn work(&self) -> u128 {
        match &self.kind {
            PlanKind::Compare(compare) => {
                let asperities: u128 = compare.surfaces.iter().map(SurfacePlan::most_asperities).sum();
                asperities * (compare.controls.points() * compare.laws.len()) as u128
            }
            PlanKind::Limit(limit) => {
                let asperities: u128 = limit.counts.iter().map(|&count| count as u128).sum();
                asperities * ((limit.draws + 1) * limit.laws.len() * limit.separations.len()) as u128
            }
        }
    }

    /// Refuses what memory cannot hold, before anything is allocated.
    fn check_memory(&self) -> Result<(), Refusal> {
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
        let place = match &self.kind {
            PlanKind::Compare(compare) => compare
                .surfaces
                .iter()
                .max_by_key(|surface| surface.memory())
                .map(|surface| surface.size_key.clone()),
            PlanKind::Limit(_) => None,
        };
        Err(match place {
            Some(span) => self.source.refuse(span, message),
            None => Refusal::file(&self.source.path, message),
        })
    }
}

/// What it will do and need, for a person.
impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "{}: {}", self.source.path.display(), self.title)?;
        let laws = |laws: &[LawPlan]| laws.iter().map(|law| law.label.clone()).collect::<Vec<_>>().join(", ");
        match &self.kind {
            PlanKind::Compare(plan) => {
                let models: Vec<&str> = plan.models.iter().map(|model| model.name()).collect();
                writeln!(f, "  {} on {}, law {}", plan.bodies.rough, plan.bodies.flat, laws(&plan.laws))?;
                writeln!(
                    f,
                    "  {} at {} points a law and surface",
                    models.join(" and "),
                    plan.controls.points()
                )?;
                for surface in &plan.surfaces {
                    writeln!(f, "  surface {}: {}", surface.name, surface.describe())?;
                }
            }
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

/// Resolves the names of one spec.
struct Reader<'a> {
    source: &'a Source,
    spec: &'a Spec,
}

impl Reader<'_> {
    fn body(&self, name: &str, span: std::ops::Range<usize>) -> Result<Material, Refusal> {
        self.spec.material.get(name).copied().ok_or_else(|| {
            let defined: Vec<&str> = self.spec.material.keys().map(String::as_str).collect();
            let allowed = if defined.is_empty() {
                "a material defined in this file as [material.NAME]; none is".to_owned()
            } else {
                format!("a material of this file: {}", defined.join(", "))
            };
            self.source.refuse(span, format!("found \"{name}\"; allowed: {allowed}"))
        })
    }

    fn laws(&self, laws: &Laws, rough: &Material, flat: &Material) -> Vec<LawPlan> {
        laws.0
            .iter()
            .map(|law| LawPlan {
                label: law.label(),
                contact: law.interface(rough, flat),
                is_hertz: *law == LawSpec::Hertz,
            })
            .collect()
    }

    fn compare(&self, words: &CompareSpec, span: std::ops::Range<usize>) -> Result<ComparePlan, Refusal> {
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
        };
        if controls.points() == 0 {
            return Err(self.source.refuse(
                span,
                "found nothing to press the surfaces to; allowed: at least one of separation, pressure, force",
            ));
        }
        Ok(ComparePlan {
            bodies: Bodies { rough: rough_name.clone(), flat: words.flat.get_ref().clone() },
            laws: self.laws(&words.law, &rough, &flat),
            models: words.models.0.clone(),
            heights: words.statistical.heights,
            mean_radius: words.statistical.mean_radius,
            controls,
            load_keys: [words.pressure.as_ref().map(Spanned::span), words.force.as_ref().map(Spanned::span)],
            surfaces: self.surfaces(words.surfaces.as_deref(), span)?,
        })
    }

    /// The surfaces that are named, or all of the file.
    fn surfaces(
        &self,
        named: Option<&[Spanned<String>]>,
        span: std::ops::Range<usize>,
    ) -> Result<Vec<SurfacePlan>, Refusal> {
        let plan = |name: &Spanned<String>, words| SurfacePlan::new(self.source, name, words);
        let Some(named) = named else {
            if self.spec.surface.is_empty() {
                return Err(self.source.refuse(
                    span,
                    "found no surface; allowed: at least one [surface.NAME.asperities], [surface.NAME.population] or [surface.NAME.file]",
                ));
            }
            return self.spec.surface.iter().map(|(name, words)| plan(name, words)).collect();
        };
        if named.is_empty() {
            return Err(self.source.refuse(span, "found an empty list of surfaces; allowed: at least one"));
        }
        let mut surfaces = Vec::new();
        for (k, wanted) in named.iter().enumerate() {
            if named[..k].iter().any(|earlier| earlier.get_ref() == wanted.get_ref()) {
                let message = format!("found \"{}\" twice; allowed: each surface once", wanted.get_ref());
                return Err(self.source.refuse(wanted.span(), message));
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
                self.source.refuse(wanted.span(), message)
            })?;
            surfaces.push(plan(name, words)?);
        }
        Ok(surfaces)
    }

    fn limit(&self, words: &LimitSpec) -> Result<LimitPlan, Refusal> {
        /// Beyond this, counts are no longer exact as f64, and no memory holds them.
        const LARGEST_COUNT: f64 = 1e12;
        let rough = self.body(words.rough.get_ref(), words.rough.span())?;
        let flat = self.body(words.flat.get_ref(), words.flat.span())?;
        let mut counts = Vec::new();
        for &count in &words.count.get_ref().values {
            if !(1.0..=LARGEST_COUNT).contains(&count) {
                let message = format!("found a count of {count:e}; allowed: 1 to {LARGEST_COUNT:e}");
                return Err(self.source.refuse(words.count.span(), message));
            }
            counts.push(count.round() as usize);
        }
        let draws = *words.draws.get_ref();
        if !(2..=1000).contains(&draws) {
            let message = format!("found {draws}; allowed: 2 to 1000 random sets of each size");
            return Err(self.source.refuse(words.draws.span(), message));
        }
        Ok(LimitPlan {
            bodies: Bodies { rough: words.rough.get_ref().clone(), flat: words.flat.get_ref().clone() },
            laws: self.laws(&words.law, &rough, &flat),
            population: Population {
                radius: words.radius.value(),
                sigma: words.sigma.value(),
                density: words.density.value(),
                heights: HeightDensity::Gaussian,
            },
            separations: words.separation.0.clone(),
            counts,
            draws: draws as usize,
        })
    }
}
